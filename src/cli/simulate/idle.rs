//! Options of `simulate` that contradict one another, or that change nothing where they are given.

use super::choices::{Effect, Format, IntegratorChoice, SolverChoice};
use super::{Arguments, choices};
use crate::cli::failure::{Failure, refuse_idle};
use clap::ValueEnum;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::Verdict;
use kutzbach::simulate::verification::VerificationOptions;
use kutzbach::simulate::{Effects, effect_names};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// An option that was given and changes nothing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Idle {
    /// As it was given.
    pub option: String,
    /// Why.
    pub because: &'static str,
}

/// Refuses what can be seen to be idle or contradictory from the command line alone.
///
/// # Errors
/// For the first of them.
pub fn refuse(arguments: &Arguments) -> Result<(), Failure> {
    let (text, log) = (arguments.format == Format::Text, arguments.mcap.is_some());
    refuse_idle(&[
        (
            arguments.samples.is_some() && !log,
            "--samples",
            "`--mcap LOG`",
        ),
        (
            arguments.timing && text,
            "--timing",
            "`--format json`: the text has times",
        ),
        (
            arguments.verbose && !text,
            "--verbose",
            "`--format text`: JSON has every detail",
        ),
        (
            arguments.whole_ladder && arguments.substeps.0.len() == 1,
            "--whole-ladder",
            "more than one number of `--substeps`",
        ),
    ])?;
    let refused = |message: String| Failure::Plain {
        message,
        help: Some("see `kutzbach simulate --help`".to_owned()),
    };
    if let Some(contradiction) = choices::contradiction(&arguments.with, &arguments.without) {
        return Err(refused(contradiction));
    }
    let file = &arguments.source.file;
    let others = [
        ("the mechanism is read from", Some(file.as_path())),
        ("`--output` writes to", arguments.destination.file()),
    ];
    for (what, other) in others {
        if let Some((log, other)) = arguments.mcap.as_deref().zip(other)
            && is_same(log, other)
        {
            let message = format!("`--mcap {}` is the file that {what}", log.display());
            return Err(refused(message));
        }
    }
    Ok(())
}

/// Whether two paths lead to one regular file, there or to be made.
fn is_same(one: &Path, other: &Path) -> bool {
    let resolved = |path: &Path| -> PathBuf {
        let there = std::fs::canonicalize(path);
        there.unwrap_or_else(|_| std::path::absolute(path).unwrap_or_else(|_| path.to_owned()))
    };
    let (one, other) = (resolved(one), resolved(other));
    let special = std::fs::metadata(&one).is_ok_and(|known| !known.is_file());
    one == other && !special
}

/// Options that change nothing for a mechanism of this verdict, simulated with these effects, and drives or none.
pub fn idle(
    arguments: &Arguments,
    mechanism: &Mechanism,
    verdict: Verdict,
    (effects, called_for): (&Effects, bool),
) -> Vec<Idle> {
    let mut found = Vec::new();
    let mut add = |given: bool, option: &str, because| {
        if given {
            let option = option.to_owned();
            found.push(Idle { option, because });
        }
    };
    if !called_for {
        let because = "nothing calls for a scene";
        let integrator = arguments.integrator != IntegratorChoice::Auto;
        add(integrator, "--integrator", because);
        add(arguments.duration.is_some(), "--duration", because);
    }
    let bounces = arguments.restitution.is_some();
    add(
        bounces && !effects.contact,
        "--restitution",
        "the scene has no contact",
    );
    let there = effect_names(&Effects::of_scene(mechanism));
    let word = |effect: &Effect| {
        let value = effect.to_possible_value();
        value.map_or(String::new(), |value| value.get_name().to_owned())
    };
    for (option, chosen, on, because) in [
        (
            "--with",
            &arguments.with,
            true,
            "the file's scene has it already",
        ),
        (
            "--without",
            &arguments.without,
            false,
            "the file's scene does not have it",
        ),
    ] {
        for (index, effect) in chosen.iter().enumerate() {
            let word = word(effect);
            let name = format!("{option} {word}");
            let again = chosen.get(..index).is_some_and(|b| b.contains(effect));
            add(again, &name, "it is given twice");
            let idle = there.contains(&word.as_str()) == on;
            add(idle && !again, &name, because);
        }
    }
    let usual = VerificationOptions::default();
    let of_motion = [
        ("--drive", arguments.drive.is_some()),
        ("--seed", arguments.seed != usual.seed),
        ("--whole-ladder", arguments.whole_ladder),
        ("--samples", arguments.samples.is_some()),
    ];
    let of_both = [
        ("--solver", arguments.solver != SolverChoice::Auto),
        ("--substeps", arguments.substeps.0 != usual.ladder),
    ];
    match verdict {
        Verdict::Mobile => {}
        Verdict::Rigid => {
            for (option, given) in of_motion {
                let because = "no motion is predicted: joints are pushed one by one";
                add(given, option, because);
            }
        }
        Verdict::Undecided | Verdict::Unassembled => {
            for (option, given) in of_motion.into_iter().chain(of_both) {
                // The solver holds the scene too.
                let scene = option == "--solver" && called_for && verdict == Verdict::Undecided;
                add(given && !scene, option, "nothing is predicted");
            }
        }
    }
    found
}
