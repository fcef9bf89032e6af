//! `kutzbach trace FILE`: the predicted motion along a branch.

mod csv;
pub mod drawn;
mod table;

use super::failure::{Failure, refuse_idle};
use super::pose::{Pose, measured};
use super::units::ValueUnits;
use super::{DONE, load, output};
use clap::{Args, ValueEnum};
use kutzbach::mechanism::{FreedomPart, Mechanism};
use kutzbach::mobility::{AnalysisOptions, Depth, Followed, analyse_to_follow};
use kutzbach::motion::{TraceOptions, trace};
use kutzbach::report::traced;

/// Follow a branch: poses, ranges and extreme positions of the joints, singular poses
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: load::Source,
    #[command(flatten)]
    closing: load::Closing,
    /// Name of the branch; the first if not given
    #[arg(long)]
    branch: Option<String>,
    /// Joint that is driven, and the values wanted (rad and m without a unit), such as `crank=0..2*pi`, `crank=-90deg..90deg`
    /// or `slide=0..5mm`
    #[arg(long, value_name = "JOINT[=FROM..TO]", value_parser = drive, allow_hyphen_values = true)]
    drive: Option<Drive>,
    /// Joint that is held, where the branch has more than one degree of freedom; may be repeated
    #[arg(long = "hold", value_name = "JOINT")]
    hold: Vec<String>,
    /// Number of poses
    #[arg(long, default_value_t = 100, help_heading = "How it is traced")]
    samples: usize,
    /// How well the loops of each pose have to close (rad, loop lengths); as well as numbers allow if not given
    #[arg(
        long,
        value_name = "TOLERANCE",
        default_value_t = 0.0,
        hide_default_value = true,
        help_heading = "How it is traced"
    )]
    tolerance: f64,
    #[command(flatten)]
    drawn: drawn::Drawn,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Units of values in the text; data are in radians and metres [default: rad-m]
    #[arg(long, value_enum)]
    units: Option<ValueUnits>,
    #[command(flatten)]
    destination: output::Destination,
    #[command(flatten)]
    pose: Pose,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// What was traced, what was met, and the range of every joint
    Text,
    /// One row per pose
    Csv,
    /// Everything, for a program
    Json,
    /// The pictures that `--plot` and `--curve` ask for
    Svg,
}

/// What `--drive` says.
#[derive(Clone, Debug)]
struct Drive {
    joint: String,
    /// From and to, as written.
    range: Option<[String; 2]>,
}

/// Reads `joint` or `joint=from..to`.
fn drive(text: &str) -> Result<Drive, String> {
    let Some((joint, range)) = text.split_once('=') else {
        return Ok(Drive {
            joint: text.to_owned(),
            range: None,
        });
    };
    let (from, to) = range.split_once("..").ok_or_else(|| DRIVEN.to_owned())?;
    Ok(Drive {
        joint: joint.trim().to_owned(),
        range: Some([from, to].map(|end| end.trim().to_owned())),
    })
}

/// How a driven joint is written.
const DRIVEN: &str =
    "write it as joint=from..to, for example `crank=0..2*pi`, `crank=0..90deg` or `slide=0..5mm`";

impl Drive {
    /// The values wanted (rad, m); of a joint that is not known, or has several freedoms, those that units say.
    fn values(&self, mechanism: &Mechanism) -> Result<Option<(f64, f64)>, Failure> {
        let Some(range) = &self.range else {
            return Ok(None);
        };
        let joint = mechanism.joint_named(&self.joint);
        let part = match joint.map(|joint| mechanism.joint(joint).kind.freedoms()) {
            Some([part]) => *part,
            _ if self.joint.contains(".trans") => FreedomPart::Translation,
            _ => FreedomPart::Rotation,
        };
        let value = |text: &String| {
            let number = measured(text, part).map(|number| number.value());
            let number = number.and_then(|x| match x.is_finite() {
                true => Ok(x),
                false => Err("it is not finite".to_owned()),
            });
            number.map_err(|why| Failure::Plain {
                message: format!(
                    "`--drive`: `{text}` is no value for `{}`: {why}",
                    self.joint
                ),
                help: Some(DRIVEN.to_owned()),
            })
        };
        let [from, to] = range;
        Ok(Some((value(from)?, value(to)?)))
    }
}

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read, has no such configuration, branch or joint, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let text = arguments.format == Format::Text;
    refuse_idle(&[(
        arguments.units.is_some() && !text,
        "--units",
        "`--format text`: data are in radians and metres",
    )])?;
    let mut reading = arguments.source.read()?;
    let configuration = arguments.pose.configure(&mut reading)?;
    let mechanism = &reading.mechanism;
    let plain = |message: String, help: String| Failure::Plain {
        message: format!("{}: {message}", arguments.source.file.display()),
        help: Some(help),
    };
    let Followed {
        mechanism,
        analysis,
        changed,
    } = analyse_to_follow(
        mechanism,
        &AnalysisOptions {
            configuration: configuration.clone(),
            depth: Depth::Motions,
            closure_tolerance: arguments.closing.closure_tolerance,
            ..AnalysisOptions::default()
        },
    )
    .map_err(|error| {
        plain(
            error.to_string(),
            "`kutzbach report FILE` tells more".to_owned(),
        )
    })?;
    let mechanism = &mechanism;
    let options = TraceOptions {
        branch: arguments.branch.clone(),
        drive: arguments.drive.as_ref().map(|d| d.joint.clone()),
        range: match &arguments.drive {
            Some(drive) => drive.values(mechanism)?,
            None => None,
        },
        hold: arguments.hold.clone(),
        samples: arguments.samples,
        tolerance: arguments.tolerance,
        configuration,
        ..TraceOptions::default()
    };
    let drawn = arguments
        .drawn
        .find(mechanism, arguments.format == Format::Svg)?;
    let traced = trace(mechanism, &analysis, &options)
        .map_err(|error| plain(error.to_string(), error.help()))?;
    let text = match arguments.format {
        Format::Text => {
            let units = arguments.units.unwrap_or(ValueUnits::RadM);
            table::text(mechanism, changed, &traced, &drawn.points, units)
        }
        Format::Csv => csv::csv(mechanism, &traced, &drawn.points),
        Format::Json => output::json(&traced::data(mechanism, changed, &traced, &drawn.points))?,
        Format::Svg => drawn.svg(mechanism, &traced)?,
    };
    arguments.destination.put(&text)?;
    Ok(DONE)
}
