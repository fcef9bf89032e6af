//! Branches of the configuration space, and how links move on them.

use serde::{Deserialize, Serialize};

/// A branch of the configuration space through the pose, described at a generic pose of its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Branch {
    /// Its name in this report.
    pub name: String,
    /// Its dimension: the freedoms a mechanism has while on it.
    pub dimension: usize,
    /// Instantaneous freedom at a generic pose of it; `null` where the margin does not tell.
    pub instantaneous: Option<usize>,
    /// Redundant equations there.
    pub redundant: Option<i64>,
    /// In how many directions it leaves the pose, for branches of dimension one.
    pub half_branches: Option<usize>,
    /// Joints that move nowhere on it (D9).
    pub locked: Vec<String>,
    /// Idle freedoms on it (D10).
    pub idle: Vec<Idle>,
    /// Freedoms that move these links a thousand times as much as all others: nearly idle, and counted as useful.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub nearly_idle: Vec<Idle>,
}

/// Links that can move while every other link stays.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Idle {
    /// The links that move together, the one that gives its name first.
    pub links: Vec<String>,
    /// In how many ways.
    pub freedom: usize,
    /// Whether they hang between balls: a rod or a leg that spins about its own line.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub rod: bool,
}

/// How one link moves relative to another along a branch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// The branch.
    pub branch: String,
    /// The link.
    pub link: String,
    /// The link it is seen from.
    pub relative_to: String,
    /// Its degrees of freedom: the dimension of the set of its relative displacements; `None` where that is not decided.
    pub freedom: Option<usize>,
    /// Hervé's letter, such as `R` or `T3`, where these displacements are a subgroup; otherwise how many of its degrees of
    /// freedom turn it and how many do not, such as `1R` or `1R 2T`; `?` where that is not decided.
    pub class: String,
    /// The same in words, with axes in the frame of `relative_to`.
    pub text: String,
    /// Hervé's letter of the smallest subgroup that is known to hold all its displacements.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub within: Option<String>,
    /// The joint whose motion this is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// How many of its degrees of freedom turn it, at a generic pose; `None` where that is not decided.
    pub rotations: Option<usize>,
    /// The others.
    pub translations: Option<usize>,
    /// Least and greatest pitch (m/rad) of the screws of a motion of one degree of freedom, at the generic poses of the branch that
    /// were looked at; zeros where it turns without sliding.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitches: Option<[f64; 2]>,
    /// Of a motion of several freedoms that translates but for a tilt: the most it turns at the poses seen (rad/m), which does not
    /// count among its rotations.
    pub tilts: Option<f64>,
    /// Whether [`pitches`](Self::pitches) are the extremes of the whole branch, which was followed from end to end.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub whole_branch: bool,
    /// Whether this pair of links was asked for by name.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub asked: bool,
}
