//! Watching a simulation while it runs: logs and progress bars.

use crate::JointGap;
use kutzbach_closure::{JointState, Rigid};
use kutzbach_motion::Variable;
use std::ops::ControlFlow;

/// A predicted pose: `world_from_link` by link, states by joint.
pub type PredictedPose<'a> = (&'a [Rigid<f64>], &'a [JointState<f64>]);

/// One moment of a simulation, and what was predicted for it.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// Seconds since the beginning of the passage.
    pub time: f64,
    /// Share of the passage that is done, from 0 to 1.
    pub done: f64,
    /// `world_from_link` of every link as simulated, by link index.
    pub simulated: &'a [Rigid<f64>],
    /// State of every joint as simulated, by joint index.
    pub states: &'a [JointState<f64>],
    /// `world_from_link` of every link and the state of every joint as predicted, where anything is.
    pub predicted: Option<PredictedPose<'a>>,
    /// How far every joint is from what it allows, by joint index.
    pub gaps: &'a [JointGap],
    /// The largest gap (characteristic lengths, rad).
    pub closure_error: f64,
    /// Distance from the predicted motion (characteristic lengths, rad).
    pub distance: f64,
}

/// What a passage simulates.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage {
    /// What is shown, for people.
    pub title: String,
    /// Name of the branch that is followed; empty where none is.
    pub branch: String,
    /// What is driven, if anything.
    pub driven: Option<Variable>,
    /// Substeps per step.
    pub substeps: usize,
    /// Seconds it is to last.
    pub duration: f64,
}

/// Whoever wants to know how a simulation goes. Breaking off is always possible: what was simulated so far counts.
pub trait Observer {
    /// A new simulation begins, from rest.
    fn begin(&mut self, passage: &Passage) -> ControlFlow<()>;
    /// The simulation has come to a moment.
    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()>;
    /// About how far the passage that was shown is off, moment by moment: seconds since its beginning, and characteristic lengths or rad.
    /// Told after its moments, where other runs showed it.
    fn estimated(&mut self, over_time: &[(f64, f64)]) -> ControlFlow<()> {
        let _ = over_time;
        ControlFlow::Continue(())
    }
}

/// Nobody watches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unobserved;

impl Observer for Unobserved {
    fn begin(&mut self, _: &Passage) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn moment(&mut self, _: &Moment<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
