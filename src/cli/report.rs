//! `kutzbach report FILE`: the mobility report.

use super::accuracy::measured;
use super::failure::Failure;
use super::pose::{self, Pose};
use super::progress::Progress;
use super::trace::drawn;
use super::units::ValueUnits;
use super::{DONE, UNDECIDED, interrupt, load, output, terminal};
use clap::{Args, ValueEnum};
use kutzbach::accuracy::AccuracyOptions;
use kutzbach::format::{Numbers, Reading, WriteOptions, write_with};
use kutzbach::mechanism::{FreedomPart, Mechanism};
use kutzbach::mobility::{Analysis, AnalysisOptions, ExactBudget};
use kutzbach::report::convert::in_full;
use kutzbach::report::html::{Assets, Facts, Prepared};
use kutzbach::report::text::{Layout, render, visible};
use kutzbach::report::{Options, PlayAsked, Report, ReportDepth, assembled_file};
use kutzbach::report::{Warning, WarningKind};
use kutzbach::simulate::verification::{
    Moment, Observer, Passage, Verification, VerificationOptions, verify,
};
use std::ops::ControlFlow;

/// Say how a mechanism can move, and why
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: load::Source,
    /// Form of the report
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    destination: output::Destination,
    #[command(flatten)]
    pose: Pose,
    #[command(flatten)]
    closing: load::Closing,
    /// Write the mechanism to a file too, with a configuration `assembled` that holds the joint values at the pose analysed
    #[arg(long, value_name = "OUT", help_heading = "Files written besides")]
    write_assembled: Option<std::path::PathBuf>,
    /// Where the verdict hangs on how the file's numbers were rounded, write the nearest mechanism found that moves to a file too
    #[arg(long, value_name = "OUT", help_heading = "Files written besides")]
    nearest: Option<std::path::PathBuf>,
    /// Write these files without expressions, for programs that read none: numbers that do not end are rounded to
    /// double precision, and an answer that hangs on less changes
    #[arg(long, help_heading = "Files written besides")]
    decimal: bool,
    /// End with exit code 2 where anything unusual of the file is not read, and with 3 where the verdict or the motion of a
    /// link is undecided, or the mechanism does not assemble
    #[arg(long)]
    strict: bool,
    /// How much to say; what is not said is not computed
    #[arg(long, value_enum, default_value_t = Asked::Everything)]
    depth: Asked,
    /// Show every row and every detail: proofs, loops, independent sub-mechanisms, margins, and what of the file was skipped
    #[arg(long)]
    verbose: bool,
    /// Units of ranges in the text
    #[arg(long, value_enum, default_value_t = ValueUnits::DegMm)]
    units: ValueUnits,
    /// Say how long the stages took
    #[arg(long, help_heading = "Proofs and limits of work")]
    timing: bool,
    /// Tell what every engine found, with its figures
    #[arg(long, help_heading = "Proofs and limits of work")]
    evidence: bool,
    /// Work budget for exact proofs, per independent sub-mechanism, in seconds of a usual machine (deterministic); 0 leaves
    /// them out [default: 0.2]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, help_heading = "Proofs and limits of work")]
    exact: Option<f64>,
    /// Say how link A moves, seen from link B, on every branch; may be repeated
    #[arg(long, num_args = 2, value_names = ["A", "B"], help_heading = "Further questions")]
    between: Vec<String>,
    /// Take these joints, or single freedoms such as `slider.trans`, for the inputs, and say what they do [default: those
    /// that the file names]
    #[arg(
        long,
        value_name = "JOINT,...",
        value_delimiter = ',',
        help_heading = "Further questions"
    )]
    inputs: Vec<String>,
    /// Say what play the joints need for the motion to go through with the numbers as written
    #[arg(long, help_heading = "Further questions")]
    play: bool,
    /// Say whether a clearance of the joints suffices for that (`0.1mm`; metres without a unit)
    #[arg(long, value_name = "LENGTH", value_parser = length, help_heading = "Further questions")]
    clearance: Option<f64>,
    /// Distance of the two ends of every joint's bearing, by half of which tilts count as play [default: the length of the
    /// loops for half of it]
    #[arg(long, value_name = "LENGTH", value_parser = length, help_heading = "Further questions")]
    bearing: Option<f64>,
    /// Let the physics engine put the prediction to the test too, and show what it says (with `--format html`)
    #[arg(long, help_heading = "In the page")]
    verify: bool,
    /// Show a point fixed to a link, and its path, instead of the paths of joints, its coordinates in the link's frame (m, or with a unit):
    /// `coupler:1,0.5` or `coupler:20mm,0,5mm`; may be repeated (with `--format html`)
    #[arg(
        long = "curve",
        value_name = "LINK:X,Y[,Z]",
        allow_hyphen_values = true,
        help_heading = "In the page"
    )]
    curves: Vec<String>,
    /// Measure what every way to an answer costs, and show it in the page (with `--format html`)
    #[arg(long, help_heading = "In the page")]
    accuracy: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A page for a person
    Text,
    /// Everything, for a program
    Json,
    /// One page that shows how the mechanism moves, for any browser
    Html,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Asked {
    /// Counts, and the freedom at the pose with its margin
    Counts,
    /// The verdict and why, without branches, joints and advice
    Verdict,
    /// All of it
    Everything,
}

impl From<Asked> for ReportDepth {
    fn from(asked: Asked) -> Self {
        match asked {
            Asked::Counts => Self::Counts,
            Asked::Verdict => Self::Verdict,
            Asked::Everything => Self::Everything,
        }
    }
}

impl Arguments {
    /// A mechanism without the configuration that the command line asks for, which is none of the file's.
    fn of_file(&self, mechanism: &Mechanism, configuration: Option<&str>) -> Mechanism {
        match configuration.filter(|_| !self.pose.items().is_empty()) {
            Some(asked) => mechanism.without_configuration(asked),
            None => mechanism.clone(),
        }
    }

    /// Refuses what a depth below everything does not look at.
    fn shallow(&self) -> Result<(), Failure> {
        if self.depth == Asked::Everything {
            return Ok(());
        }
        let asked = [
            (self.format == Format::Html, "--format html"),
            (!self.between.is_empty(), "--between"),
            (!self.inputs.is_empty(), "--inputs"),
            (self.play_asked().is_some(), "play"),
            (self.nearest.is_some(), "--nearest"),
            (self.evidence && self.depth == Asked::Counts, "--evidence"),
            (self.strict && self.depth == Asked::Counts, "--strict"),
            (
                self.exact.is_some() && self.depth == Asked::Counts,
                "--exact",
            ),
        ];
        match asked.into_iter().find(|(asked, _)| *asked) {
            Some((_, what)) => Err(Failure::Plain {
                message: format!("`--depth` leaves out what {what} needs"),
                help: Some("ask for everything, which is the default".to_owned()),
            }),
            None => Ok(()),
        }
    }

    /// How files are written back.
    fn written<'a>(&self, reading: &'a Reading) -> WriteOptions<'a> {
        WriteOptions {
            kept: Some(&reading.kept),
            numbers: match self.decimal {
                true => Numbers::Decimals,
                false => Numbers::Short,
            },
        }
    }

    fn play_asked(&self) -> Option<PlayAsked> {
        let asked = self.play || self.clearance.is_some() || self.bearing.is_some();
        asked.then_some(PlayAsked {
            clearance: self.clearance,
            bearing: self.bearing,
        })
    }
}

/// A length that is none is a slip.
fn length(text: &str) -> Result<f64, String> {
    let wanted = "a length above 0, such as `0.1mm` (metres without a unit)";
    let number = pose::measured(text, FreedomPart::Translation).map_err(|_| wanted.to_owned())?;
    Some(number.value())
        .filter(|length| *length > 0.0 && length.is_finite())
        .ok_or_else(|| wanted.to_owned())
}

/// A time that is none is a slip, not a wish for no limit.
pub fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds >= 0.0 && seconds.is_finite() => Ok(seconds),
        _ => Err("a number of seconds, 0 or more".to_owned()),
    }
}

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read, has no such configuration, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let mut reading = arguments.source.read_strictly(arguments.strict)?;
    let (configuration, elsewhere) = arguments.pose.configured(&mut reading)?;
    arguments.shallow()?;
    let options = Options {
        depth: arguments.depth.into(),
        configuration,
        exact: arguments
            .exact
            .map_or_else(ExactBudget::default, ExactBudget::seconds)
            .within(arguments.source.memory),
        timing: arguments.timing,
        evidence: arguments.evidence,
        between: arguments
            .between
            .chunks_exact(2)
            .map(|pair| (pair[0].clone(), pair[1].clone()))
            .collect(),
        closure_tolerance: arguments.closing.closure_tolerance,
        inputs: arguments.inputs.clone(),
        ranges: arguments.format != Format::Html,
        play: arguments.play_asked(),
    };
    if arguments.verify && arguments.format != Format::Html {
        return Err(Failure::Plain {
            message: "`--verify` shows its evidence in a page".to_owned(),
            help: Some(
                "add `--format html`; `kutzbach simulate FILE` tells it in words".to_owned(),
            ),
        });
    }
    if !arguments.curves.is_empty() && arguments.format != Format::Html {
        return Err(Failure::Plain {
            message: "`--curve` shows its path in a page".to_owned(),
            help: Some(
                "add `--format html`; `kutzbach trace FILE --curve` has it as text, CSV, JSON and SVG"
                    .to_owned(),
            ),
        });
    }
    if arguments.accuracy && arguments.format != Format::Html {
        return Err(Failure::Plain {
            message: "`--accuracy` shows its figure in a page".to_owned(),
            help: Some(
                "add `--format html`; `kutzbach accuracy FILE` has it as text, JSON and SVG"
                    .to_owned(),
            ),
        });
    }
    let (mut report, analysis) = load::analysed(&reading, &arguments.source.file, &options)?;
    if report.assembly.proven_open {
        report.assembly.misfits = arguments.source.misfits();
    }
    let elsewhere = elsewhere.map(|told| Warning::new(WarningKind::OtherConfiguration, told));
    report.warnings.extend(elsewhere);
    let text = match arguments.format {
        Format::Text => {
            let to_file = arguments.destination.file().is_some();
            let layout = Layout {
                units: arguments.units.into(),
                ..terminal::layout(to_file, arguments.verbose)
            };
            render(&report, layout)
        }
        Format::Json => output::json(&report)?,
        Format::Html => {
            let configuration = options.configuration.as_deref();
            page(arguments, &reading, &report, &analysis, configuration)?
        }
    };
    arguments.destination.put(&text)?;
    write_besides(arguments, &reading, &options, &analysis)?;
    Ok(match arguments.strict && !report.is_decided() {
        // The page says that its verification, or its measurement, was broken off.
        _ if interrupt::asked() => interrupt::INTERRUPTED,
        true => UNDECIDED,
        false => DONE,
    })
}

/// Writes the mechanism at the pose found, and the nearest one that moves, where these were asked for.
fn write_besides(
    arguments: &Arguments,
    reading: &Reading,
    options: &Options,
    analysis: &Analysis,
) -> Result<(), Failure> {
    let written = arguments.written(reading);
    let own =
        |mechanism: &Mechanism| arguments.of_file(mechanism, options.configuration.as_deref());
    if let Some(out) = &arguments.write_assembled {
        let asked = AnalysisOptions {
            configuration: options.configuration.clone(),
            closure_tolerance: options.closure_tolerance,
            ..AnalysisOptions::default()
        };
        let meant = in_full(&reading.mechanism, &asked);
        let assembly = meant.assembly.as_ref().unwrap_or(&analysis.assembly);
        let file = assembled_file(&own(&meant.mechanism), assembly, &written);
        let file = file.ok_or_else(|| Failure::Plain {
            message: format!(
                "{}: no closed pose is known, so there is none to write",
                arguments.source.file.display()
            ),
            help: None,
        })?;
        if let Some(note) = meant.note {
            eprintln!("note: {}: {}", out.display(), visible(&note));
        }
        output::put(&file, Some(out))?;
    }
    if let Some(out) = &arguments.nearest {
        let nearest = analysis.nearest.as_ref().ok_or_else(|| Failure::Plain {
            message: format!(
                "{}: no nearest mechanism to write",
                arguments.source.file.display()
            ),
            help: Some(
                "one is looked for where rounded numbers decide whether it moves, and it may not be found"
                    .to_owned(),
            ),
        })?;
        output::put(&write_with(&own(&nearest.mechanism), &written), Some(out))?;
    }
    Ok(())
}

/// The page, with a verification where it was asked for.
fn page(
    arguments: &Arguments,
    reading: &Reading,
    report: &Report,
    analysis: &Analysis,
    configuration: Option<&str>,
) -> Result<String, Failure> {
    let verification = match arguments.verify {
        true => Some(verified(
            arguments,
            &reading.mechanism,
            analysis,
            configuration,
        )?),
        false => None,
    };
    let accuracy = match arguments.accuracy {
        true => {
            let options = AccuracyOptions {
                configuration: configuration.map(str::to_owned),
                ..AccuracyOptions::default()
            };
            let measured = measured(&reading.mechanism, analysis, &options);
            Some(measured.map_err(|error| Failure::Plain {
                message: format!("{}: {error}", arguments.source.file.display()),
                help: None,
            })?)
        }
        false => None,
    };
    let facts = Facts {
        mechanism: &reading.mechanism,
        report,
        analysis,
        configuration,
        verification: verification.as_ref(),
        accuracy: accuracy.as_ref(),
    };
    let points = arguments.curves.iter();
    let points = points.map(|text| drawn::point(&reading.mechanism, text));
    let points = points.collect::<Result<Vec<_>, _>>()?;
    load::html(&Prepared::new(facts, Assets::Inside).with_points(points))
}

fn verified(
    arguments: &Arguments,
    mechanism: &Mechanism,
    analysis: &Analysis,
    configuration: Option<&str>,
) -> Result<Verification, Failure> {
    let options = VerificationOptions {
        configuration: configuration.map(str::to_owned),
        ..VerificationOptions::default()
    };
    let mut watch = Watch(Progress::new("simulating"));
    let verification = verify(
        mechanism,
        &analysis.geometry,
        analysis,
        &options,
        &mut watch,
    );
    watch.0.finish();
    verification.map_err(|error| Failure::Plain {
        message: format!("{}: {error}", arguments.source.file.display()),
        help: None,
    })
}

/// Shows how far a simulation has come, and breaks it off at Ctrl-C.
struct Watch(Progress);

impl Observer for Watch {
    fn begin(&mut self, _: &Passage) -> ControlFlow<()> {
        self.0.tick(0, 1000)
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        self.0
            .tick((moment.done.clamp(0.0, 1.0) * 1e3) as u64, 1000)
    }
}
