//! Names of joint variables, as a person writes them.

use super::inputs::Variable;
use super::result::{TraceError, TraceOptions};
use kutzbach_model::mechanism::Mechanism;
use strsim::levenshtein;

/// What was asked for, found in the mechanism.
#[derive(Clone, Debug, Default)]
pub(super) struct RequestedVariables {
    pub drive: Option<Variable>,
    pub hold: Vec<Variable>,
}

pub(super) fn requested_variables(
    mechanism: &Mechanism,
    options: &TraceOptions,
) -> Result<RequestedVariables, TraceError> {
    let drive = options
        .drive
        .as_deref()
        .map(|name| variable_named(mechanism, name))
        .transpose()?;
    let mut hold = Vec::new();
    for name in &options.hold {
        let variable = variable_named(mechanism, name)?;
        if drive.as_ref() == Some(&variable) {
            return Err(TraceError::NothingLeft {
                drive: variable.name.clone(),
                held: format!("`{}`", variable.name),
            });
        }
        if !hold.contains(&variable) {
            hold.push(variable);
        }
    }
    Ok(RequestedVariables { drive, hold })
}

/// The variable of a name: a joint of one freedom, or a part of a joint such as `slider.rot`.
///
/// # Errors
/// [`TraceError::UnknownVariable`], with the name that comes closest.
pub fn variable_named(mechanism: &Mechanism, name: &str) -> Result<Variable, TraceError> {
    let all = Variable::all(mechanism);
    if let Some(found) = all.iter().find(|v| v.name == name) {
        return Ok(found.clone());
    }
    let several = mechanism.joint_named(name).map_or_else(Vec::new, |id| {
        all.iter()
            .filter(|v| v.joint == id.0)
            .map(|v| v.name.clone())
            .collect()
    });
    let nearest = all
        .iter()
        .map(|v| (levenshtein(name, &v.name), &v.name))
        .filter(|(d, known)| *d <= 2.max(known.chars().count() / 3))
        .min()
        .map(|(_, known)| known.clone());
    Err(TraceError::UnknownVariable {
        name: name.to_owned(),
        nearest,
        several,
    })
}
