//! The range and the friction of an `<axis>` of SDFormat, in a file of its own and inside `<gazebo>`.

use super::element::{Element, only};
use super::error::Outcome;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Dynamics, Limit};

/// What is told of a range whose lower end is above the upper one.
const CROSSED: &str = "the lower limit is above the upper one, which means none";

/// What is told of the range of a joint that has none by its type. SDFormat's specification has the bounds left out there; libsdformat hands
/// them on, and Drake heeds them no more than URDF's readers do.
pub(super) const ENDLESS: &str =
    "a continuous joint turns without end: `lower` and `upper` are ignored";

/// What an axis says of its joint's range and friction.
#[derive(Default)]
pub(super) struct OfAxis {
    pub(super) limit: Limit,
    pub(super) dynamics: Dynamics,
    /// Why bounds that are written are none.
    pub(super) no_limit: Option<&'static str>,
}

impl OfAxis {
    /// Whether the axis stops anywhere.
    pub(super) fn is_bounded(&self) -> bool {
        self.limit.lower.is_some() || self.limit.upper.is_some()
    }
}

/// Reads `<limit>` and `<dynamics>` of an axis of a joint of some type. `number` reads what stands in an element, `None` where that bounds
/// nothing.
///
/// # Errors
/// A second element where there is one; what `number` refuses.
pub(super) fn of_axis<'a>(
    axis: Option<Element<'a>>,
    word: &str,
    mut number: impl FnMut(Element<'a>) -> Outcome<Option<Number>>,
) -> Outcome<OfAxis> {
    let Some(axis) = axis else {
        return Ok(OfAxis::default());
    };
    let mut said = |part: Option<Element<'a>>, name: &str| -> Outcome<Option<Number>> {
        let value = part.map(|part| only(part, name)).transpose()?.flatten();
        let read = value.map(&mut number).transpose()?.flatten();
        let is_rate = matches!(name, "effort" | "velocity");
        Ok(read.filter(|number| is_limit(number, is_rate)))
    };
    let (limit, dynamics) = (only(axis, "limit")?, only(axis, "dynamics")?);
    let mut found = OfAxis {
        limit: Limit {
            lower: said(limit, "lower")?,
            upper: said(limit, "upper")?,
            effort: said(limit, "effort")?,
            velocity: said(limit, "velocity")?,
        },
        dynamics: Dynamics {
            damping: said(dynamics, "damping")?,
            friction: said(dynamics, "friction")?,
        },
        no_limit: None,
    };
    found.no_limit = match (&found.limit.lower, &found.limit.upper) {
        (None, None) => None,
        _ if word == "continuous" => Some(ENDLESS),
        (Some(lower), Some(upper)) if lower.value() > upper.value() => Some(CROSSED),
        _ => None,
    };
    if found.no_limit.is_some() {
        (found.limit.lower, found.limit.upper) = (None, None);
    }
    Ok(found)
}

/// Whether a number limits: 1e16 is written where nothing does, and an effort or a rate of -1.
fn is_limit(number: &Number, is_rate: bool) -> bool {
    number.value().abs() < 1e15 && !(is_rate && number.value() < 0.0)
}
