//! `kutzbach report FILE`: the mobility report.

use super::failure::Failure;
use super::{DONE, UNDECIDED, load, output, terminal};
use clap::{Args, ValueEnum};
use kutzbach::mobility::ExactBudget;
use kutzbach::report::text::render;
use kutzbach::report::{Options, Verdict};

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
    /// Analyse a configuration of the file instead of the home pose
    #[arg(long, value_name = "CONFIGURATION")]
    at: Option<String>,
    /// End with exit code 3 where the verdict is undecided
    #[arg(long)]
    strict: bool,
    /// Show every row and every detail, and what of the file was skipped
    #[arg(long)]
    verbose: bool,
    /// Say how long the stages took
    #[arg(long)]
    timing: bool,
    /// Tell what every engine found, with its figures
    #[arg(long)]
    evidence: bool,
    /// Give exact algebra about so many seconds for each block, counted in work so that the answer is the same on every
    /// machine; 0 leaves it out [default: 0.2]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    exact: Option<f64>,
    /// Say how link A moves, seen from link B, on every branch; may be repeated
    #[arg(long, num_args = 2, value_names = ["A", "B"])]
    between: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A page for a person
    Text,
    /// Everything, for a program
    Json,
}

/// A time that is none is a slip, not a wish for no limit.
fn seconds(text: &str) -> Result<f64, String> {
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
    let reading = arguments.source.read()?;
    let options = Options {
        configuration: arguments.at.clone(),
        exact: arguments
            .exact
            .map_or_else(ExactBudget::default, ExactBudget::seconds),
        timing: arguments.timing,
        evidence: arguments.evidence,
        between: arguments
            .between
            .chunks_exact(2)
            .map(|pair| (pair[0].clone(), pair[1].clone()))
            .collect(),
    };
    let report = load::report_on(&reading, &arguments.source.file, &options)?;
    let text = match arguments.format {
        Format::Text => render(
            &report,
            terminal::layout(arguments.destination.file().is_some(), arguments.verbose),
        ),
        Format::Json => output::json(&report)?,
    };
    arguments.destination.put(&text)?;
    let undecided = report.mobility.verdict == Verdict::Undecided;
    Ok(if arguments.strict && undecided {
        UNDECIDED
    } else {
        DONE
    })
}
