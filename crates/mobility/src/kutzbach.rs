//! Kutzbach's count: constraints subtracted from freedoms as if each were independent.

use kutzbach_model::mechanism::Mechanism;

/// `6 (links − 1) − Σ (6 − freedom) − couplings`, the spatial formula for every mechanism (Kutzbach 1929).
///
/// Right where all constraints are independent, wrong by the number of dependent ones.
#[must_use]
pub fn kutzbach_count(mechanism: &Mechanism) -> i64 {
    let moving = mechanism.links().len() as i64 - 1;
    let constraints: i64 = mechanism
        .joints()
        .iter()
        .map(|joint| 6 - joint.freedom() as i64)
        .sum();
    6 * moving - constraints - mechanism.couplings().len() as i64
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_closure::samples::{four_bar, sarrus};
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{JointBuilder, JointKind, MechanismBuilder};

    #[test]
    fn known_counts() {
        assert_eq!(kutzbach_count(&four_bar()), -2);
        assert_eq!(kutzbach_count(&sarrus()), 0);
    }

    #[test]
    fn every_constraint_counts_once() {
        let mut builder = MechanismBuilder::new("arm");
        builder.link("ground");
        assert_eq!(kutzbach_count(&builder.clone().build().unwrap()), 0);
        builder.link("arm").link("hand");
        builder.joint(JointBuilder::tree(
            "a",
            JointKind::Revolute,
            "ground",
            "arm",
        ));
        builder.joint(JointBuilder::tree("b", JointKind::Prismatic, "arm", "hand"));
        assert_eq!(kutzbach_count(&builder.clone().build().unwrap()), 2);
        builder.mimic("b", "a", Number::one(), Number::zero());
        assert_eq!(kutzbach_count(&builder.clone().build().unwrap()), 1);
        builder.joint(JointBuilder::closing(
            "c",
            JointKind::Fixed,
            "ground",
            "hand",
        ));
        assert_eq!(kutzbach_count(&builder.build().unwrap()), -5);
    }
}
