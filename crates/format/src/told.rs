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

/// Says which direction stands for one that is left out.
pub(super) const TAKEN_AS_X: &str = "x is taken";

/// Says that an angle may be another one.
pub(super) const LOOKS_LIKE: &str = "in `rpy` looks like";

/// Says that no loop is closed by what is named so.
pub(super) const IS_TREE: &str = "it is read as a tree";

/// Says that two links look like two sides of a loop.
pub(super) const LIKE_SIDES: &str =
    "look like the two sides of a loop, which the file does not state";

/// Says where two joints hold the child that both have.
pub(super) const AT_ORIGIN: &str = "both hold it at its origin";

/// Says that a limit without bounds would let nothing move.
pub(super) const NO_BOUNDS: &str = "which is 0…0 in URDF";

/// Says from where the rates of a coupling are seen.
pub(super) const SEEN_FROM: &str = "the rates are taken as seen from";

/// Says in which direction the rates of a coupling count.
pub(super) const SAME_DIRECTION: &str = "both rates count in the same direction";

/// Parts of the warnings that are told first.
const FIRST: [&str; 13] = [
    MAY_JOIN,
    IS_GROUND,
    FLOATS,
    IS_REVOLUTE,
    NO_LEADER,
    TAKEN_AS_X,
    LOOKS_LIKE,
    IS_TREE,
    LIKE_SIDES,
    AT_ORIGIN,
    NO_BOUNDS,
    SEEN_FROM,
    SAME_DIRECTION,
];

/// Whether a warning of a reading is to be told before everything else.
#[must_use]
pub fn is_told_first(warning: &str) -> bool {
    FIRST.iter().any(|part| warning.contains(part))
}
