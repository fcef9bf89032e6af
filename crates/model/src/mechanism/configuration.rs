//! Named poses.

use super::model::JointId;
use kutzbach_math::number::Number;
use std::collections::BTreeSet;

/// A named set of joint values; joints not named are free to follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Unique among configurations.
    pub name: String,
    /// Joint and one value per freedom (rad, m).
    pub positions: Vec<(JointId, Vec<Number>)>,
    /// Of these, the joints whose values are only where assembly begins: it may move them.
    pub free: BTreeSet<JointId>,
}

impl Configuration {
    /// The joints that keep their values.
    pub fn held(&self) -> impl Iterator<Item = JointId> {
        let joints = self.positions.iter().map(|(joint, _)| *joint);
        joints.filter(|joint| !self.free.contains(joint))
    }
}
