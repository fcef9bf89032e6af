//! `kutzbach assemble FILE`: every way in which it closes.

mod page;

use super::failure::Failure;
use super::interrupt::{self, INTERRUPTED};
use super::pose::measured;
use super::progress::Sign;
use super::units::ValueUnits;
use super::{DONE, UNDECIDED, load, output};
use clap::{Args, ValueEnum};
use kutzbach::algebra::{Limits, Reader};
use kutzbach::assembly::modes::{
    Complete, Modes, ModesError, Question, assembly_modes, reduced_equations,
};
use kutzbach::assembly::words;
use kutzbach::mechanism::{JointId, JointKind, Mechanism};
use kutzbach::number::Number;
use kutzbach::report::text::visible;
use std::sync::mpsc;
use std::time::Duration;

/// Find every configuration in which the mechanism closes, with proof that there is no other
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: load::Source,
    /// Hold a joint at a value, such as `crank=30deg`; may be repeated [default: a set of inputs, where they are drawn]
    #[arg(long, value_name = "JOINT=VALUE")]
    hold: Vec<String>,
    /// Hold no joint, and say what moves
    #[arg(long, conflicts_with = "hold")]
    free: bool,
    /// Stop after the work of about so many seconds, the same on every machine, and say what is known
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    budget: f64,
    /// Exit with code 3 if it is not known whether these are all
    #[arg(long)]
    strict: bool,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Units of values in the text; data are in radians and metres
    #[arg(long, value_enum, default_value_t = ValueUnits::RadM)]
    units: ValueUnits,
    #[command(flatten)]
    destination: output::Destination,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Lists for a person
    Text,
    /// Everything, for a program
    Json,
    /// The equations of the incidence tree, for Singular
    Singular,
    /// The same for msolve
    Msolve,
    /// One page that shows the configurations side by side, and how each moves, for any browser
    Html,
}

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read, a joint cannot be held, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let reading = arguments.source.read()?;
    let mechanism = &reading.mechanism;
    let held = match (arguments.hold.is_empty(), arguments.free) {
        (true, false) => None,
        _ => Some(
            arguments
                .hold
                .iter()
                .map(|item| held(mechanism, item))
                .collect::<Result<Vec<_>, _>>()?,
        ),
    };
    let reader = match arguments.format {
        Format::Singular => Some(Reader::Singular),
        Format::Msolve => Some(Reader::Msolve),
        _ => None,
    };
    if let Some(reader) = reader {
        let equations =
            reduced_equations(mechanism, held.as_deref()).map_err(|why| Failure::Plain {
                message: format!("no equations of an incidence tree: {why}"),
                help: Some("`kutzbach exact` writes those of the loops".to_owned()),
            })?;
        arguments.destination.put(&equations.written_for(reader))?;
        return Ok(DONE);
    }
    let question = Question {
        held,
        limits: Limits {
            cancelled: Some(interrupt::flag()),
            ..Limits::seconds(arguments.budget)
        },
    };
    let modes = watched(mechanism, question, arguments.budget).map_err(|error| Failure::Plain {
        message: error.to_string(),
        help: Some("`--hold joint=value` takes joints that turn or slide".to_owned()),
    })?;
    let text = match arguments.format {
        Format::Text => words::text(mechanism, &modes, arguments.units.into())
            .lines()
            .map(|line| format!("{}\n", visible(line)))
            .collect(),
        Format::Json => output::json(&words::data(mechanism, &modes))?,
        Format::Html | Format::Singular | Format::Msolve => {
            page::page(&reading, &arguments.source.file, &modes)?
        }
    };
    arguments.destination.put(&text)?;
    Ok(match modes.complete {
        _ if interrupt::asked() => INTERRUPTED,
        Complete::Unknown(_) if arguments.strict => UNDECIDED,
        _ => DONE,
    })
}

/// Steps that do not ask whether to go on may take so many seconds after Ctrl-C.
const GRACE: f64 = 2.0;

/// Works while Ctrl-C and a sign of life are seen to. Work that does not end soon after Ctrl-C is left alone, and ends with the program.
/// Nothing else depends on the clock.
fn watched(mechanism: &Mechanism, question: Question, budget: f64) -> Result<Modes, ModesError> {
    interrupt::listen();
    let (send, receive) = mpsc::channel();
    let (own, asked) = (mechanism.clone(), question.clone());
    std::thread::spawn(move || {
        // Nobody may be listening any more.
        let _ = send.send(assembly_modes(&own, &asked));
    });
    let mut sign = Sign::new(budget);
    let mut pressed = None;
    loop {
        match receive.recv_timeout(Duration::from_millis(50)) {
            Ok(result) => return result,
            Err(mpsc::RecvTimeoutError::Disconnected) => return Ok(Modes::interrupted(&question)),
            Err(mpsc::RecvTimeoutError::Timeout) => {}
        }
        if interrupt::asked() && sign.seconds() > *pressed.get_or_insert(sign.seconds()) + GRACE {
            return Ok(Modes::interrupted(&question));
        }
        sign.tick(|| "looking for configurations".to_owned());
    }
}

/// Reads `joint=value`.
pub fn held(mechanism: &Mechanism, item: &str) -> Result<(JointId, Number), Failure> {
    let wrong = |message: String, help: &str| Failure::Plain {
        message,
        help: Some(help.to_owned()),
    };
    let Some((name, text)) = item.split_once('=') else {
        return Err(wrong(
            format!("`--hold {item}` states no value"),
            "write it as joint=value, for example `crank=0.3` or `crank=30deg`",
        ));
    };
    let Some(joint) = mechanism.joint_named(name.trim()) else {
        return Err(wrong(
            format!("`--hold`: there is no joint named `{}`", name.trim()),
            "`kutzbach report FILE --verbose` lists the joints",
        ));
    };
    let described = mechanism.joint(joint);
    let (JointKind::Revolute | JointKind::Prismatic, [part]) =
        (described.kind, described.kind.freedoms())
    else {
        return Err(wrong(
            format!(
                "`--hold`: joint `{}` is {}",
                described.name,
                described.kind.word()
            ),
            "only revolute and prismatic joints can be held at a value",
        ));
    };
    let value = measured(text.trim(), *part).map_err(|why| {
        wrong(
            format!(
                "`--hold`: `{}` is no value for joint `{}`: {why}",
                text.trim(),
                described.name
            ),
            "a number or an expression such as `pi/4`; with `deg` or `rad`, `mm` or `m` after it",
        )
    })?;
    Ok((joint, value))
}
