//! Cycles and the spanning tree.

use serde::{Deserialize, Serialize};

/// One basic cycle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cycle {
    /// Its name in this report: `C1`, `C2`, …
    pub name: String,
    /// Its joints in order.
    pub joints: Vec<String>,
    /// The subgroup its displacements generate, in short (such as `G`); `null` where that is all of SE(3).
    pub space: Option<String>,
    /// The same in words, with its axis, plane or point; empty where not found.
    pub space_text: String,
    /// The subgroup's dimension; `null` where not found.
    pub dimension: Option<usize>,
    /// Rank of its six equations when taken alone; `null` where not decided.
    pub rank: Option<usize>,
    /// Its dependent equations when taken alone.
    pub redundant: Option<i64>,
    /// Its instantaneous freedom when taken alone.
    pub mobility: Option<usize>,
    /// Joints that this cycle locks by itself.
    pub locks: Vec<String>,
}

/// The spanning tree: that of the file, rooted at the ground (D15). The joints that are not in it close the loops; they are
/// those with [`JointRow::closes_loop`](crate::JointRow::closes_loop), unless a link is held by such joints alone.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tree {
    /// The root link.
    pub root: String,
    /// The most joints between the root and any link.
    pub depth: usize,
    /// How each other link hangs on the tree.
    pub links: Vec<TreeLink>,
}

/// How one link hangs on the spanning tree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TreeLink {
    /// The link.
    pub link: String,
    /// The link next to it on the way to the root.
    pub parent: String,
    /// The joint between the two.
    pub joint: String,
    /// Joints between it and the root.
    pub depth: usize,
}
