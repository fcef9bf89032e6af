//! Joints, couplings, and what to change about them.

use super::super::change_sets::RedundantDirection;
use serde::{Deserialize, Serialize};

/// One joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointRow {
    /// Its name.
    pub name: String,
    /// Its class in short, such as `R`.
    pub class: String,
    /// Its kind in words, such as `revolute`.
    pub kind: String,
    /// The links it connects, predecessor first.
    pub links: [String; 2],
    /// Its freedoms.
    pub freedom: usize,
    /// Whether none of its freedoms moves (D9) on any branch; at the pose where no branch is known.
    pub locked: Option<bool>,
    /// The single freedoms that do not move, such as `slider.rot`.
    pub locked_parts: Vec<String>,
    /// Directions in which its reaction is statically undetermined.
    pub redundant_wrenches: Option<usize>,
    /// The directions of these.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub redundant_directions: Vec<RedundantDirection>,
    /// Whether the file writes it as the closure of a loop.
    pub closes_loop: bool,
    /// The label of its block ([`Block::label`](super::Block::label)); `null` where it is in no loop and no coupling, and moves by itself.
    #[serde(default)]
    pub block: Option<String>,
    /// How far it goes on each branch that is a curve, one entry for each of its freedoms that moves; empty where that was not
    /// followed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ranges: Vec<JointRange>,
}

/// How far a joint goes along a branch that is a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointRange {
    /// The branch.
    pub branch: String,
    /// Which of its freedoms, such as `trans`; `null` for a joint of one.
    pub part: Option<String>,
    /// Least value (rad, m), counted through full turns.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// Full turns in one cycle; zero where it swings.
    pub turns: i64,
    /// Whether it is an angle.
    pub angle: bool,
    /// Whether the motion goes on beyond what was followed.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub at_least: bool,
}

/// One coupling.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CouplingRow {
    /// Its name.
    pub name: String,
    /// Its equation.
    pub text: String,
}

/// A joint to relax.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Advice {
    /// The advice as a sentence.
    pub text: String,
    /// The joint; a link or coupling where `from` says so.
    pub joint: String,
    /// Its class now; `link` or `coupling` for what is none.
    pub from: String,
    /// The class it should get; `none` where it may be removed.
    pub to: String,
    /// Redundant equations now.
    pub redundant_before: i64,
    /// Redundant equations afterwards.
    pub redundant_after: i64,
}
