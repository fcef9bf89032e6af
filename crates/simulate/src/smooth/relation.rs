//! Coordinates of joints with one freedom: in couplings, in drives, and for damping.

use super::constraint::{Gradient, Moving, Placed, Turning, along, along_bias};
use nalgebra::Vector3;

/// The variable of a joint with one freedom.
#[derive(Clone, Debug)]
pub(super) struct Coordinate {
    pub joint: usize,
    pub measure: Measure,
}

#[derive(Clone, Debug)]
pub(super) enum Measure {
    /// About an axis (rad).
    Turn(Turning),
    /// Along an axis of the predecessor (m).
    Travel(Vector3<f64>),
}

/// Σ factor · coordinate = offset + rate · time.
#[derive(Clone, Debug)]
pub(super) struct Relation {
    pub terms: Vec<(Coordinate, f64)>,
    pub offset: f64,
    pub rate: f64,
}

impl Coordinate {
    /// Its value (rad, m).
    pub fn value(&self, placed: &Placed) -> f64 {
        match &self.measure {
            Measure::Turn(turning) => turning.angle(placed),
            Measure::Travel(axis) => (placed.turns[0] * axis).dot(&placed.apart),
        }
    }

    /// Its derivatives.
    pub fn gradient(&self, placed: &Placed) -> Gradient {
        match &self.measure {
            Measure::Turn(turning) => {
                let axis = turning.direction(placed);
                Gradient {
                    linear: [Vector3::zeros(); 2],
                    angular: [-axis, axis],
                }
            }
            Measure::Travel(axis) => along(placed.turns[0] * axis, 0, placed),
        }
    }

    /// What its second derivative has beside its gradient times the accelerations. A turn has nothing: see the helix.
    pub fn bias(&self, placed: &Placed, moving: &Moving) -> f64 {
        match &self.measure {
            Measure::Turn(_) => 0.0,
            Measure::Travel(axis) => along_bias(placed.turns[0] * axis, 0, placed, moving),
        }
    }
}

impl Relation {
    /// One over the sum of the factors' sizes, so that relations are numbers near one.
    pub fn scale(&self, length: f64) -> f64 {
        let size = |(coordinate, factor): &(Coordinate, f64)| match coordinate.measure {
            Measure::Turn(_) => factor.abs(),
            Measure::Travel(_) => factor.abs() * length,
        };
        1.0 / self.terms.iter().map(size).sum::<f64>()
    }
}
