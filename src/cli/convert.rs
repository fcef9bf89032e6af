//! `kutzbach convert FILE --to FORMAT`: the mechanism in the words of another program.

use super::failure::Failure;
use super::{DONE, load, output};
use clap::{Args, ValueEnum};
use kutzbach::format::{Numbers, Reading, WriteOptions, write_with};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::AnalysisOptions;
use kutzbach::report::convert::{
    Converted, Hinges, in_full, relaxed, to_mjcf, to_pinocchio, to_sdf, to_urdf,
};
use kutzbach::report::text::visible;

/// Write a mechanism in another format; what that cannot say is told on standard error
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: load::Source,
    /// The format to write
    #[arg(long, value_enum)]
    to: Target,
    /// Change joints so that no constraint is redundant and the mobility stays: the report's set of changes, of joints that close loops
    /// where one of these suffices
    #[arg(long)]
    relax: bool,
    #[command(flatten)]
    destination: output::Destination,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Target {
    /// URDF with loops, as this program reads it
    Native,
    /// URDF as every program reads it: the open tree
    Urdf,
    /// MuJoCo's format: loops are equalities
    Mjcf,
    /// Gazebo's format: loops are joints like others
    Sdf,
    /// A Python program that makes Pinocchio's models of the open tree and of its loops
    Pinocchio,
}

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let mut reading = arguments.source.read()?;
    let mut notes = not_read(&reading);
    let mut hinges = Hinges::TwoPoints;
    if arguments.relax {
        let file = arguments.source.file.display().to_string();
        let found = relaxed(&reading, &file).map_err(|error| Failure::Plain {
            message: format!("{file}: {error}"),
            help: Some(error.help()),
        })?;
        notes.extend(found.notes);
        reading.mechanism = found.mechanism;
        if found.independent {
            hinges = Hinges::Body;
        }
    }
    let found = in_full(&reading.mechanism, &AnalysisOptions::default());
    notes.extend(found.note);
    reading.mechanism = found.mechanism;
    let converted = written(&reading, arguments.to, hinges)?;
    let not_said = converted.not_said.iter();
    notes.extend(not_said.map(|what| format!("not said: {what}")));
    for note in notes {
        eprintln!("note: {}", visible(&note));
    }
    arguments.destination.put(&converted.text)?;
    Ok(DONE)
}

fn written(reading: &Reading, to: Target, hinges: Hinges) -> Result<Converted, Failure> {
    let mechanism: &Mechanism = &reading.mechanism;
    match to {
        Target::Native => {
            let options = WriteOptions {
                kept: Some(&reading.kept),
                numbers: Numbers::Short,
            };
            Ok(Converted {
                text: write_with(mechanism, &options),
                not_said: Vec::new(),
            })
        }
        Target::Urdf => to_urdf(mechanism).map_err(|error| Failure::Plain {
            message: format!("cannot be written as URDF: {error}"),
            help: error.help,
        }),
        Target::Mjcf => Ok(to_mjcf(mechanism, hinges)),
        Target::Sdf => to_sdf(mechanism).map_err(|error| Failure::Plain {
            message: format!("cannot be written as SDF: {error}"),
            help: Some(
                "`kutzbach report FILE` says whether and why its loops do not close".to_owned(),
            ),
        }),
        Target::Pinocchio => to_pinocchio(mechanism).map_err(|error| Failure::Plain {
            message: format!("cannot be written for Pinocchio: {error}"),
            help: error.help,
        }),
    }
}

/// What of the file was not read, and so is not written, and what was read in doubt.
fn not_read(reading: &Reading) -> Vec<String> {
    let doubtful = reading.warnings.iter().filter(|w| w.kind.is_told_first());
    let mut notes: Vec<String> = doubtful
        .map(|w| format!("line {}, column {}: {}", w.line, w.column, w.message))
        .collect();
    let skipped = reading.skipped.iter().map(|skipped| skipped.what.as_str());
    let skipped: Vec<&str> = skipped.collect();
    if !skipped.is_empty() {
        notes.push(format!("not read, so not written: {}", skipped.join(", ")));
    }
    notes
}
