//! The families that depend on a small number, with what is true of their members.

use super::truth::Truth;
use super::{
    double_planar, flat_change_point, flattening_parallelogram, near_dead_centre, spoiled_bennett,
    spoiled_parallelogram,
};
use crate::PoseKind;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Mechanism, MechanismError};

/// A mechanism for every small number.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// The name of the function that builds its members.
    pub name: &'static str,
    /// What `epsilon` is, with its unit.
    pub epsilon: &'static str,
    /// What is true where `epsilon` vanishes.
    pub limit: Truth,
    /// What is true of all other members, however small `epsilon` is.
    pub elsewhere: Truth,
    build: fn(&Number) -> Result<Mechanism, MechanismError>,
}

impl Family {
    /// The member for a given `epsilon` from 0 to 1.
    ///
    /// # Errors
    /// None in practice.
    pub fn member(&self, epsilon: &Number) -> Result<Mechanism, MechanismError> {
        (self.build)(epsilon)
    }

    /// What is true of that member.
    #[must_use]
    pub fn truth(&self, epsilon: &Number) -> &Truth {
        if epsilon.is_zero() {
            &self.limit
        } else {
            &self.elsewhere
        }
    }
}

/// `10^-exponent`, exactly: no digit of it is open, so that even the fourteenth decimal is meant.
#[must_use]
pub fn negative_power_of_ten(exponent: u32) -> Number {
    let exponent = i32::try_from(exponent).unwrap_or(i32::MAX);
    // Ten does not vanish, and so does none of its powers.
    Number::integer(10)
        .power(-exponent)
        .unwrap_or_else(|_| Number::zero())
}

/// All families that depend on a small number. Why their truths are true is told at the functions that build them.
#[must_use]
pub fn continuous_families() -> [Family; 6] {
    let regular = |freedom: usize| Truth {
        finite: freedom,
        instantaneous: freedom,
        pose: PoseKind::Regular,
        branches: usize::from(freedom > 0),
    };
    let crossing = Truth {
        finite: 1,
        instantaneous: 2,
        pose: PoseKind::Singular,
        branches: 2,
    };
    let family = |name, epsilon, limit, elsewhere, build| Family {
        name,
        epsilon,
        limit,
        elsewhere,
        build,
    };
    [
        family(
            "flattening_parallelogram",
            "crank angle out of the flat pose (rad)",
            crossing,
            regular(1),
            flattening_parallelogram,
        ),
        family(
            "spoiled_parallelogram",
            "coupler too long by (m)",
            crossing,
            regular(1),
            spoiled_parallelogram,
        ),
        family(
            "flat_change_point",
            "coupler and rocker longer by (m)",
            crossing,
            crossing,
            flat_change_point,
        ),
        family(
            "near_dead_centre",
            "crank angle past the dead centre (rad)",
            regular(1),
            regular(1),
            near_dead_centre,
        ),
        family(
            "spoiled_bennett",
            "twist of one side off by (rad)",
            regular(1),
            regular(0),
            spoiled_bennett,
        ),
        family(
            "double_planar",
            "skew of the two planes (rad)",
            regular(3),
            regular(1),
            double_planar,
        ),
    ]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_offset_is_no_rounded_number() {
        let epsilon = negative_power_of_ten(14);
        let text = Number::decimal("0.00000000000001").unwrap();
        assert!((&epsilon - &text).is_zero());
        assert!(epsilon.stated().is_none(), "no digit of it is open");
        for family in continuous_families() {
            let member = family.member(&epsilon).unwrap();
            assert_eq!(member.name(), family.name);
            assert!(member.precision().is_exact());
            assert_eq!(member.precision().decimals, None, "{}", family.name);
            // It is not the limit: some number of it differs.
            let limit = family.member(&Number::zero()).unwrap();
            assert_ne!(
                format!("{:?}", member.joints()),
                format!("{:?}", limit.joints()),
                "{}",
                family.name
            );
        }
    }

    #[test]
    fn the_limit_is_at_zero_only() {
        for family in continuous_families() {
            assert_eq!(*family.truth(&Number::zero()), family.limit);
            let small = negative_power_of_ten(300);
            assert_eq!(*family.truth(&small), family.elsewhere);
        }
    }
}
