//! From a path to a mechanism and its report.

use super::failure::Failure;
use clap::Args;
use kutzbach::format::{ReadOptions, Reading, read_file, read_file_with};
use kutzbach::mobility::Analysis;
use kutzbach::report::html::Prepared;
use kutzbach::report::{Options, Report, analysed_report};
use std::path::{Path, PathBuf};

/// Which mechanism: a file, and properties of it that are to differ.
#[derive(Clone, Debug, Args)]
pub struct Source {
    /// Mechanism file
    pub file: PathBuf,
    /// Give a property of the file another value, a number or an expression; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting)]
    pub settings: Vec<(String, String)>,
}

impl Source {
    /// Reads the file.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn read(&self) -> Result<Reading, Failure> {
        mechanism(&self.file, &self.settings)
    }

    /// Reads the file, leaving some of its properties open.
    ///
    /// # Errors
    /// As [`Self::read`]; also a name that the file does not define.
    pub fn read_symbolic(&self, symbolic: &[String]) -> Result<Reading, Failure> {
        let options = ReadOptions {
            settings: self.settings.clone(),
            symbolic: symbolic.to_vec(),
        };
        Ok(read_file_with(&self.file, &options)?)
    }
}

/// Reads a mechanism file.
///
/// # Errors
/// What is wrong with the file, and where.
pub fn mechanism(file: &Path, settings: &[(String, String)]) -> Result<Reading, Failure> {
    Ok(read_file(file, settings)?)
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
