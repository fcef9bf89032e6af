//! Named poses.

use super::model::JointId;
use kutzbach_math::number::Number;

/// A named set of joint values; joints not named are free to follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Unique among configurations.
    pub name: String,
    /// Joint and one value per freedom (rad, m).
    pub positions: Vec<(JointId, Vec<Number>)>,
}
