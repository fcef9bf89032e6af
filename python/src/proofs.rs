//! All configurations, and what polynomials prove.

use crate::asked::{self, Assemble, Prove};
use crate::failure::Failure;
use crate::reading::Subject;
use kutzbach::algebra::{Budget, ExactOptions, Formulation, Limits, SystemError, SystemOptions};
use kutzbach::assembly::modes::{Question, assembly_modes};
use kutzbach::assembly::words;
use kutzbach::mechanism::{JointId, JointKind, Mechanism};
use kutzbach::number::Number;
use kutzbach::report::exact::{Request, proved};

/// Work where none is stated, as the command line has it (s).
const SECONDS_TO_ASSEMBLE: f64 = 10.0;
const SECONDS_TO_PROVE: f64 = 30.0;

/// What `kutzbach assemble --format json` writes.
///
/// # Errors
/// Joints that there are not or that cannot be held, and values that are none.
pub fn assembled(subject: &Subject, asked: &str) -> Result<String, Failure> {
    let asked: Assemble = asked::parsed(asked)?;
    let mechanism = subject.mechanism();
    let held = match &asked.hold {
        Some(hold) => Some(
            hold.iter()
                .map(|(joint, value)| held(mechanism, joint, value))
                .collect::<Result<Vec<_>, _>>()?,
        ),
        None => None,
    };
    let question = Question {
        held,
        limits: Limits::seconds(asked.budget.unwrap_or(SECONDS_TO_ASSEMBLE)),
    };
    let modes = assembly_modes(mechanism, &question).map_err(|error| {
        Failure::plain(
            error.to_string(),
            "only joints that turn or slide can be held",
        )
    })?;
    Ok(words::data(mechanism, &modes).to_string())
}

/// A joint and the value that it is held at (rad, m).
fn held(mechanism: &Mechanism, name: &str, value: &str) -> Result<(JointId, Number), Failure> {
    let Some(joint) = mechanism.joint_named(name) else {
        return Err(Failure::plain(
            format!("there is no joint named `{name}`"),
            "`Mechanism.joints` lists them",
        ));
    };
    let kind = mechanism.joint(joint).kind;
    if !matches!(kind, JointKind::Revolute | JointKind::Prismatic) {
        return Err(Failure::plain(
            format!("joint `{name}` is {}", kind.word()),
            "only revolute and prismatic joints can be held at a value",
        ));
    }
    let number = Number::decimal(value)
        .or_else(|_| Number::expression(value, &mut |_| Ok(None)))
        .map_err(|error| {
            Failure::plain(
                format!("`{value}` is no value for joint `{name}`: {error}"),
                "a number or an expression such as \"pi/4\", in radians and metres",
            )
        })?;
    Ok((joint, number))
}

/// What `kutzbach exact --format json` writes.
///
/// # Errors
/// Numbers that are not algebraic, where no part of the mechanism has others.
pub fn exact(subject: &Subject, asked: &str) -> Result<String, Failure> {
    let asked: Prove = asked::parsed(asked)?;
    let configuration = asked::named(asked.configuration);
    let plain = configuration.is_none();
    let request = Request {
        file: subject.source.file.clone(),
        options: ExactOptions {
            system: SystemOptions {
                formulation: Formulation::Canonical,
                configuration,
                ..SystemOptions::default()
            },
            ..ExactOptions::default()
        },
        ..Request::default()
    };
    let budget = Budget::new(Limits::seconds(asked.budget.unwrap_or(SECONDS_TO_PROVE)));
    let (report, _) = proved(subject.mechanism(), &request, plain, &budget).map_err(|error| {
        let help = matches!(
            error,
            SystemError::NotAlgebraic { .. } | SystemError::Degree { .. }
        )
        .then(|| "`analyse` gives the verdict within the digits".to_owned());
        subject.failed(&error.to_string(), help)
    })?;
    Ok(serde_json::to_string(&report)?)
}
