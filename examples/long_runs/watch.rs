//! Watching a world for a long time: what is measured at a step, and how it is kept, window by window.
//!
//! The closure error is looked at after every step, the rest at every [`Play::compared`]th: following the predicted motion
//! is Newton's method, which takes longer than a step. A run is as long as many periods of its motion, and a window holds
//! whole periods, so that windows differ by what has changed since and by nothing else.

use kutzbach::closure::JointState;
use kutzbach::simulate::World;
use kutzbach::simulate::verification::{Prediction, largest_gap};
use serde::{Deserialize, Serialize};
use std::error::Error;

/// What is measured may fail only where the repository is broken: any error ends the program.
pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// What a run compares with the traced motion, beside where the links are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Compared {
    /// By how much the energy is too large, as a share of the motion's own: see the runs.
    pub energy: f64,
    /// How far what is driven is from where it is driven to (rad, characteristic lengths); zero where nothing is driven.
    pub behind: f64,
}

/// A motion that can be watched.
pub trait Play {
    /// A world about to begin, with so many substeps.
    fn world(&self, substeps: usize) -> Result<World>;
    /// The prediction at the start.
    fn prediction(&self) -> Result<Prediction<'_>>;
    /// The states at the start.
    fn start(&self) -> &[JointState<f64>];
    /// The characteristic length (m).
    fn length(&self) -> f64;
    /// Motion and prediction are compared after every so many steps.
    fn compared(&self) -> usize;
    /// What the drives are told before a step; steps count from zero.
    fn command(&self, world: &mut World, step: usize) -> Result<()>;
    /// What is compared after `steps` steps; the states are continued over whole turns.
    fn compare(&self, world: &World, states: &[JointState<f64>], steps: usize) -> Compared;
}

/// What a run shows; each list has one number per window.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seen {
    /// Largest gap of a joint (characteristic lengths, rad).
    pub closure: Vec<f64>,
    /// Largest distance of a link from the predicted motion (characteristic lengths, rad).
    pub distance: Vec<f64>,
    /// Least [`Compared::energy`].
    pub energy_least: Vec<f64>,
    /// Mean [`Compared::energy`].
    pub energy_mean: Vec<f64>,
    /// Largest [`Compared::energy`].
    pub energy_most: Vec<f64>,
    /// The [`Compared::behind`] that is farthest from zero.
    pub behind: Vec<f64>,
}

/// Watches a world step by step, in windows of as many steps each.
///
/// # Errors
/// Where a world cannot be made, or its numbers run away.
pub fn watch(play: &impl Play, substeps: usize, steps: usize, windows: usize) -> Result<Seen> {
    let mut world = play.world(substeps)?;
    let mut prediction = play.prediction()?;
    let mut states = play.start().to_vec();
    let mut seen = Seen::default();
    let window = steps / windows.max(1);
    for first in (0..windows).map(|index| index * window) {
        let mut closure = 0.0f64;
        let mut distance = 0.0f64;
        let mut behind = 0.0f64;
        let mut energies = Vec::with_capacity(window / play.compared() + 1);
        for step in first..first + window {
            play.command(&mut world, step)?;
            world.step()?;
            closure = closure.max(largest_gap(&world.gaps(), play.length()));
            if (step + 1) % play.compared() == 0 {
                states = world.states(&states);
                prediction.follow(&states)?;
                distance = distance.max(prediction.distance(&world.link_poses()));
                let compared = play.compare(&world, &states, step + 1);
                energies.push(compared.energy);
                if compared.behind.abs() > behind.abs() {
                    behind = compared.behind;
                }
            }
        }
        seen.closure.push(closure);
        seen.distance.push(distance);
        let extreme = |pick: fn(f64, f64) -> f64| energies.iter().copied().reduce(pick);
        seen.energy_least.push(extreme(f64::min).unwrap_or(0.0));
        seen.energy_most.push(extreme(f64::max).unwrap_or(0.0));
        let count = energies.len().max(1) as f64;
        seen.energy_mean.push(energies.iter().sum::<f64>() / count);
        seen.behind.push(behind);
    }
    Ok(seen)
}
