//! The engine's own units.
//!
//! The engine takes inverses below 1e-20 for zero and has margins in absolute energy. In units of the mechanism's own
//! length and mass the numbers it meets are near one, so that a mechanism of a micrometre is simulated like one of a
//! kilometre. Time stays in seconds.

use kutzbach_closure::Rigid;
use rapier3d_f64::prelude::Pose;

use super::convert::pose;

/// One unit of the engine in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Units {
    /// m.
    pub length: f64,
    /// kg.
    pub mass: f64,
}

impl Units {
    /// kg m².
    pub fn moment(&self) -> f64 {
        self.mass * self.length * self.length
    }

    /// N (kg m/s²) for a force along an axis, N m for a torque about one.
    pub fn effort(&self, axis: usize) -> f64 {
        if axis < 3 {
            self.mass * self.length
        } else {
            self.moment()
        }
    }

    /// m or rad, and their rates.
    pub fn travel(&self, axis: usize) -> f64 {
        if axis < 3 { self.length } else { 1.0 }
    }

    /// N s/m or N m s.
    pub fn damping(&self, axis: usize) -> f64 {
        self.effort(axis) / self.travel(axis)
    }

    /// A displacement for the engine.
    pub fn pose(&self, rigid: &Rigid<f64>) -> Pose {
        let mut placed = pose(rigid);
        placed.translation /= self.length;
        placed
    }

    /// A displacement from the engine (m).
    pub fn rigid(&self, pose: &Pose) -> Rigid<f64> {
        let mut placed = super::convert::rigid(pose);
        placed.translation = placed.translation.map(|x| x * self.length);
        placed
    }
}
