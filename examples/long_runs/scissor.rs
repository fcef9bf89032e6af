//! A scissor of three stages that swings under gravity, with no drive and no damping.
//!
//! A lift that stands falls flat in a moment: all bars come to lie in one line, a singular pose from which several motions
//! go on, and what happens there depends on the last digit. So the scissor hangs. Its rail slopes, so that the
//! slider runs outwards while the bars want to hang straight down; between these two it has a stable pose of rest, and about
//! it the scissor swings from the pose in which it is drawn, far from both of its singular poses:
//!
//! ```text
//!    o-----[]      rail on the sloping ceiling
//!     \\ //
//!     // \\        three stages
//!      ...
//!    o-----[]      platform
//! ```
//!
//! The energy is that of the whole motion, less what it was at the start, as a share of the height of the swing: of the energy
//! that goes from potential to kinetic and back.

use super::traced::Traced;
use super::watch::{Compared, Play, Result};
use kutzbach::closure::JointState;
use kutzbach::families::scissor_lift;
use kutzbach::simulate::verification::Prediction;
use kutzbach::simulate::{Effects, Solver, World, WorldOptions};

/// Crossed pairs of bars.
pub const STAGES: usize = 3;

/// Steps per second.
pub const STEP_RATE: f64 = 240.0;

/// Standard gravity (m/s²).
pub const GRAVITY: f64 = 9.80665;

/// Slope of the rail (rad).
pub const SLOPE: f64 = 65.0 * std::f64::consts::PI / 180.0;

/// Poses of the traced motion among which the lowest is sought.
const LOOKED_AT: usize = 400;

/// A hanging scissor.
pub struct Scissor {
    traced: Traced,
    solver: Solver,
    /// Potential energy at the start (J).
    start: f64,
    /// What of it becomes kinetic (J).
    pub height: f64,
}

impl Scissor {
    /// Drawn up to the pose of the file.
    pub fn new(solver: Solver) -> Result<Self> {
        let traced = Traced::new(&scissor_lift(STAGES)?)?;
        let start = traced.energy(traced.start(), None, effects())?.potential;
        let mut curve = traced.curve("lower_pin")?;
        let (first, last) = curve.arclengths();
        let mut least = start;
        for index in 0..=LOOKED_AT {
            let arc = first + (last - first) * index as f64 / LOOKED_AT as f64;
            // The ends of the curve are singular poses.
            let Some(found) = curve.pose_at_arclength(arc) else {
                continue;
            };
            let energy = traced.energy(&curve.states(&found.pose), None, effects())?;
            least = least.min(energy.potential);
        }
        Ok(Self {
            traced,
            solver,
            start,
            height: start - least,
        })
    }
}

/// Gravity as the ground sees it: the mechanism's y axis points away from the ceiling, its x axis along the rail.
fn effects() -> Effects {
    Effects {
        gravity: Some([GRAVITY * SLOPE.sin(), GRAVITY * SLOPE.cos(), 0.0]),
        ..Effects::default()
    }
}

impl Play for Scissor {
    fn world(&self, substeps: usize) -> Result<World> {
        let options = WorldOptions {
            solver: self.solver,
            effects: effects(),
            time_step: 1.0 / STEP_RATE,
            substeps,
        };
        self.traced.world(&options)
    }

    fn prediction(&self) -> Result<Prediction<'_>> {
        self.traced.prediction(1)
    }

    fn start(&self) -> &[JointState<f64>] {
        self.traced.start()
    }

    fn length(&self) -> f64 {
        self.traced.length
    }

    fn compared(&self) -> usize {
        // No part of a swing, so that all of it is seen.
        7
    }

    fn command(&self, _: &mut World, _: usize) -> Result<()> {
        Ok(())
    }

    fn compare(&self, world: &World, _: &[JointState<f64>], _: usize) -> Compared {
        Compared {
            energy: (world.energy().total() - self.start) / self.height,
            behind: 0.0,
        }
    }
}
