//! From a path to a mechanism and its report.

use super::contacts;
use super::failure::Failure;
use clap::Args;
use kutzbach::format::{
    Corrections, ReadOptions, Reading, largest_file, property_names, read_file_with, read_with,
};
use kutzbach::mobility::Analysis;
use kutzbach::report::html::Prepared;
use kutzbach::report::{Misfit, Options, Report, analysed_report, misfits};
use std::io::Read;
use std::path::{Path, PathBuf};

/// Which mechanism: a file, and properties of it that are to differ.
#[derive(Clone, Debug, Args)]
pub struct Source {
    /// Mechanism file; `-` for standard input
    pub file: PathBuf,
    /// Give a property of the file another value, a number or an expression; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting, help_heading = "Reading the file")]
    pub settings: Vec<(String, String)>,
    /// Take decimals as written: `1.5707963267948966` is not read as π/2, nor `6.123e-17` as 0
    #[arg(long, help_heading = "Reading the file")]
    pub literal: bool,
    /// State how well the file's decimals are known, in metres and radians, whatever their digits say; 0 for exactly
    #[arg(long, value_name = "SIZE", value_parser = precision, help_heading = "Reading the file")]
    pub precision: Option<f64>,
    /// Say where a ROS package is that a xacro file includes from; may be repeated
    #[arg(long = "package", value_name = "NAME=PATH", value_parser = package, help_heading = "Reading the file")]
    pub packages: Vec<(String, PathBuf)>,
    /// Correct which joints the contacts of a STEP file are, by JSON as `kutzbach contacts FILE --json` writes it
    #[arg(long, value_name = "FILE", value_parser = contacts::corrections, help_heading = "Reading the file")]
    pub contacts: Option<Corrections>,
    /// Fill at most so many gigabytes: a file that would take more is refused, and what would not fit of exact algebra, which takes most,
    /// stays undecided
    #[arg(long, value_name = "GIGABYTES", default_value = "2", value_parser = gigabytes, help_heading = "Reading the file")]
    pub memory: u64,
}

impl Source {
    /// Reads the file.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn read(&self) -> Result<Reading, Failure> {
        self.read_with(&[], false)
    }

    /// Reads the file; if `strict`, what would be skipped is a fault.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_strictly(&self, strict: bool) -> Result<Reading, Failure> {
        self.read_with(&[], strict)
    }

    /// Reads the file, leaving some of its properties open.
    ///
    /// # Errors
    /// As [`Self::read`]; also a name that the file does not define.
    pub fn read_symbolic(&self, symbolic: &[String]) -> Result<Reading, Failure> {
        self.read_with(symbolic, false)
    }

    /// Measures whose values rule a pose out, each by itself; none of a file on standard input, which can be read once only.
    pub fn misfits(&self) -> Vec<Misfit> {
        let text = std::fs::read_to_string(&self.file).unwrap_or_default();
        let mut names = property_names(&text);
        // What was set is what is asked about.
        names.sort_by_key(|name| !self.settings.iter().any(|(set, _)| set == name));
        misfits(&names, |name| {
            let reading = self.read_symbolic(&[name.to_owned()]).ok()?;
            Some(reading.mechanism)
        })
    }

    /// How to read it.
    pub fn options(&self, symbolic: &[String], strict: bool) -> ReadOptions {
        ReadOptions {
            settings: self.settings.clone(),
            symbolic: symbolic.to_vec(),
            literal: self.literal,
            precision: self.precision,
            strict,
            packages: self.packages.clone(),
            without_environment: false,
            contacts: self.contacts.clone().unwrap_or_default(),
            memory: Some(self.memory),
        }
    }

    fn read_with(&self, symbolic: &[String], strict: bool) -> Result<Reading, Failure> {
        let options = self.options(symbolic, strict);
        if self.file == Path::new("-") {
            let text = standard_input(self.memory)?;
            return Ok(read_with(&text, STANDARD_INPUT, &options)?);
        }
        Ok(read_file_with(&self.file, &options)?)
    }
}

/// The name of a file that is read from standard input.
pub const STANDARD_INPUT: &str = "standard input";

/// All of standard input; more than the memory (bytes) holds when it is read is cut off, and refused as too large.
pub fn standard_input(memory: u64) -> Result<String, Failure> {
    let mut text = String::new();
    let most = largest_file(memory).saturating_add(1);
    let read = std::io::stdin().lock().take(most).read_to_string(&mut text);
    read.map_err(|error| Failure::Plain {
        message: format!("{STANDARD_INPUT} cannot be read: {error}"),
        help: None,
    })?;
    Ok(text)
}

/// What counts as closed.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct Closing {
    /// Take loops with gaps up to this as closed (m; angles count by the length of the loop), instead of what the digits of
    /// the file say; ranks are then only as certain as that
    #[arg(long, value_name = "METRES", value_parser = gap, help_heading = "Reading the file")]
    pub closure_tolerance: Option<f64>,
}

/// Bytes; no memory at all is a slip.
pub fn gigabytes(text: &str) -> Result<u64, String> {
    match text.parse::<f64>() {
        Ok(size) if size > 0.0 && size.is_finite() => Ok((size * 1e9) as u64),
        _ => Err("a number of gigabytes, more than 0".to_owned()),
    }
}

/// A gap that is none is a slip, not a wish for exactness.
fn gap(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(gap) if gap > 0.0 && gap.is_finite() => Ok(gap),
        _ => Err("a length in metres, more than 0".to_owned()),
    }
}

/// Reads a mechanism file; if `strict`, what would be skipped is a fault.
///
/// # Errors
/// What is wrong with the file, and where.
pub fn mechanism(
    file: &Path,
    settings: &[(String, String)],
    strict: bool,
) -> Result<Reading, Failure> {
    let options = ReadOptions {
        settings: settings.to_vec(),
        strict,
        ..ReadOptions::default()
    };
    Ok(read_file_with(file, &options)?)
}

/// Analyses what was read.
///
/// # Errors
/// Where the options ask for what the mechanism does not have.
pub fn report_on(reading: &Reading, file: &Path, options: &Options) -> Result<Report, Failure> {
    analysed(reading, file, options).map(|(report, _)| report)
}

/// Analyses what was read; the report, and the analysis that it tells of.
///
/// # Errors
/// As [`report_on`].
pub fn analysed(
    reading: &Reading,
    file: &Path,
    options: &Options,
) -> Result<(Report, Analysis), Failure> {
    analysed_report(reading, &file.display().to_string(), options).map_err(|error| Failure::Plain {
        message: format!("{}: {error}", file.display()),
        help: Some(error.help()),
    })
}

/// A report as a page.
///
/// # Errors
/// Where data have no JSON form, which would be a fault of this program.
pub fn html(prepared: &Prepared<'_>) -> Result<String, Failure> {
    prepared.page().map_err(|error| Failure::Plain {
        message: format!("cannot be written as a page: {error}"),
        help: None,
    })
}

/// Reads the size of a `--precision`.
fn precision(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(size) if size >= 0.0 && size.is_finite() => Ok(size),
        _ => Err("a size in metres and radians, 0 or more, for example `1e-6`".to_owned()),
    }
}

/// Reads `name=path` of a `--package`.
///
/// # Errors
/// Where there is no `=`, or nothing before or after it.
pub fn package(text: &str) -> Result<(String, PathBuf), String> {
    match text.split_once('=') {
        Some((name, path)) if !name.trim().is_empty() && !path.trim().is_empty() => {
            Ok((name.trim().to_owned(), PathBuf::from(path.trim())))
        }
        _ => {
            Err("write it as name=path, for example `ur_description=../ur_description`".to_owned())
        }
    }
}

/// Reads `name=value` of a `--set`.
///
/// # Errors
/// Where there is no `=`, or nothing before it.
pub fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("write it as name=value, for example `twist=pi/4`".to_owned()),
    }
}
