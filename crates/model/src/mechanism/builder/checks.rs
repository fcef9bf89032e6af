//! Rules about single values that many entities share.

use crate::mechanism::{Entity, Frame, Joint, MechanismError};
use kutzbach_math::number::Number;

/// Sizes beyond this cannot be squared and summed in floating point.
const LARGEST: f64 = 1e100;

/// Exact numbers are always finite, but may be too large to compute with.
pub(super) fn check_finite(
    entity: &Entity,
    what: &str,
    value: &Number,
) -> Result<(), MechanismError> {
    if value.value().abs() <= LARGEST {
        return Ok(());
    }
    Err(MechanismError::new(
        entity.clone(),
        format!(
            "{what} is {:e}, beyond the largest number accepted, 1e100",
            value.value()
        ),
    ))
}

/// [`check_finite`] for every number of a list.
pub(super) fn check_all_finite<'a>(
    entity: &Entity,
    what: &str,
    values: impl IntoIterator<Item = &'a Number>,
) -> Result<(), MechanismError> {
    values
        .into_iter()
        .try_for_each(|value| check_finite(entity, what, value))
}

/// A part of a whole.
pub(super) fn check_share(
    entity: &Entity,
    what: &str,
    value: Option<&Number>,
) -> Result<(), MechanismError> {
    match value.map(Number::value) {
        Some(share) if !(0.0..=1.0).contains(&share) => Err(MechanismError::new(
            entity.clone(),
            format!("{what} is {share}, not from 0 to 1"),
        )),
        _ => Ok(()),
    }
}

/// Every number of a frame.
pub(super) fn check_frame(entity: &Entity, frame: &Frame) -> Result<(), MechanismError> {
    check_all_finite(
        entity,
        "origin",
        frame.position.iter().chain(&frame.roll_pitch_yaw),
    )
}

/// A coupling or a drive speaks of a joint's rate, so there must be exactly one.
pub(super) fn check_one_freedom(entity: &Entity, joint: &Joint) -> Result<(), MechanismError> {
    if joint.freedom() == 1 {
        return Ok(());
    }
    Err(MechanismError::new(
        entity.clone(),
        format!(
            "joint `{}` is {} with {} degrees of freedom; only a joint with one has a single rate",
            joint.name,
            joint.kind,
            joint.freedom()
        ),
    ))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn numbers_up_to_the_largest_pass() {
        let check = |text: &str| {
            let number = Number::decimal(text).unwrap();
            check_finite(&Entity::Mechanism, "it", &number).map_err(|error| error.problem)
        };
        assert_eq!(check("1e100"), Ok(()));
        assert_eq!(check("-1e100"), Ok(()));
        let beyond = |value: f64| {
            Err(format!(
                "it is {value:e}, beyond the largest number accepted, 1e100"
            ))
        };
        assert_eq!(check("1.5e100"), beyond(1.5e100));
        assert_eq!(check("-2e100"), beyond(-2e100));
        // Too large for a double, yet a number.
        assert_eq!(check("1e400"), beyond(f64::INFINITY));
    }
}
