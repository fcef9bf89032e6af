//! Small mechanisms under construction, for the tests of this folder.

use super::{JointBuilder, MechanismBuilder};
use crate::mechanism::{Frame, JointKind, Mechanism, MechanismError};
use kutzbach_math::number::Number;

/// A decimal literal.
pub(super) fn number(text: &str) -> Number {
    match Number::decimal(text) {
        Ok(number) => number,
        Err(error) => panic!("{text}: {error}"),
    }
}

/// A frame whose position cannot be computed with.
pub(super) fn far_away() -> Frame {
    Frame::at([Number::zero(), number("1e200"), Number::zero()])
}

/// Links without any joint.
pub(super) fn links(names: &[&str]) -> MechanismBuilder {
    let mut builder = MechanismBuilder::new("sample");
    for name in names {
        builder.link(name);
    }
    builder
}

/// A tree hinge.
pub(super) fn hinge(name: &str, parent: &str, child: &str) -> JointBuilder {
    JointBuilder::tree(name, JointKind::Revolute, parent, child)
}

/// Links `a`, `b`, `c` in a chain with tree joints `ab` and `bc` of the kinds given.
pub(super) fn chain(ab: JointKind, bc: JointKind) -> MechanismBuilder {
    let mut builder = links(&["a", "b", "c"]);
    builder.joint(JointBuilder::tree("ab", ab, "a", "b"));
    builder.joint(JointBuilder::tree("bc", bc, "b", "c"));
    builder
}

/// Links `a`, `b`, `c` in a chain of hinges `ab` and `bc`.
pub(super) fn hinges() -> MechanismBuilder {
    chain(JointKind::Revolute, JointKind::Revolute)
}

/// What is wrong with it.
pub(super) fn error_of(builder: MechanismBuilder) -> MechanismError {
    match builder.build() {
        Ok(mechanism) => panic!("`{}` was built", mechanism.name()),
        Err(error) => error,
    }
}

/// Entity and problem in one line.
pub(super) fn fault(builder: MechanismBuilder) -> String {
    error_of(builder).to_string()
}

/// How to mend it.
pub(super) fn help(builder: MechanismBuilder) -> String {
    error_of(builder).help.unwrap_or_default()
}

/// The equation of the first coupling by joint names.
pub(super) fn terms(mechanism: &Mechanism) -> Vec<(&str, f64)> {
    mechanism.couplings()[0]
        .terms
        .iter()
        .map(|term| {
            let joint = mechanism.joint(term.joint);
            (joint.name.as_str(), term.factor.value())
        })
        .collect()
}
