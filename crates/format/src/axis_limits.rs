//! The range and the friction of an `<axis>` of SDFormat, in a file of its own and inside `<gazebo>`.

use super::element::Element;
use super::error::Outcome;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Dynamics, Limit};

/// What is told of a range whose lower end is above the upper one.
pub(super) const CROSSED: &str = "the lower limit is above the upper one, which means none";

/// What an axis says of its joint's range and friction.
pub(super) struct OfAxis {
    pub(super) limit: Limit,
    pub(super) dynamics: Dynamics,
    /// Whether the lower limit is above the upper one; then there is neither.
    pub(super) is_crossed: bool,
}

/// Reads `<limit>` and `<dynamics>` of an axis. `number` reads what stands in an element, `None` where that bounds nothing.
pub(super) fn of_axis<'a>(
    axis: Option<Element<'a>>,
    mut number: impl FnMut(Element<'a>) -> Outcome<Option<Number>>,
) -> Outcome<OfAxis> {
    let (mut limit, mut dynamics) = (Limit::default(), Dynamics::default());
    for part in axis.into_iter().flat_map(|axis| axis.elements()) {
        for value in part.elements() {
            let into = match (part.name(), value.name()) {
                ("limit", "lower") => &mut limit.lower,
                ("limit", "upper") => &mut limit.upper,
                ("limit", "effort") => &mut limit.effort,
                ("limit", "velocity") => &mut limit.velocity,
                ("dynamics", "damping") => &mut dynamics.damping,
                ("dynamics", "friction") => &mut dynamics.friction,
                _ => continue,
            };
            let is_rate = matches!(value.name(), "effort" | "velocity");
            *into = number(value)?.filter(|number| is_limit(number, is_rate));
        }
    }
    let is_crossed = matches!(
        (&limit.lower, &limit.upper),
        (Some(lower), Some(upper)) if lower.value() > upper.value()
    );
    if is_crossed {
        (limit.lower, limit.upper) = (None, None);
    }
    Ok(OfAxis {
        limit,
        dynamics,
        is_crossed,
    })
}

/// Whether a number limits: 1e16 is written where nothing does, and an effort or a rate of -1.
fn is_limit(number: &Number, is_rate: bool) -> bool {
    number.value().abs() < 1e15 && !(is_rate && number.value() < 0.0)
}
