//! Which warnings belong before everything else: what was taken for granted where the file does not say it, and what may make the
//! answer one about another mechanism than the one meant.

use super::mentions::MAY_JOIN;

/// Says what the world is that a file names and does not have.
pub(super) const IS_GROUND: &str = "it is the ground, as in Drake";

/// Says that a link is placed by no joint.
pub(super) const FLOATS: &str = "such a link floats, as in Drake";

/// Says what a loop without a type is.
pub(super) const IS_REVOLUTE: &str = "it is read as revolute";

/// Says that a joint follows one that is not there.
pub(super) const NO_LEADER: &str = "which the file does not have: it is free, as in ROS";

/// Parts of the warnings that are told first.
const FIRST: [&str; 5] = [MAY_JOIN, IS_GROUND, FLOATS, IS_REVOLUTE, NO_LEADER];

/// Whether a warning of a reading is to be told before everything else.
#[must_use]
pub fn is_told_first(warning: &str) -> bool {
    FIRST.iter().any(|part| warning.contains(part))
}
