//! Coordinates of joints with one freedom: in couplings, in drives, and for damping.

use super::constraint::{Gradient, Moving, Placed, Turning, along, along_bias};
use kutzbach_closure::CouplingShare;
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

/// Σ share of a coordinate = offset + rate · time.
#[derive(Clone, Debug)]
pub(super) struct Relation {
    pub terms: Vec<(Coordinate, Share)>,
    pub offset: f64,
    pub rate: f64,
}

/// What a coordinate gives to a relation: a polynomial in it without a constant term.
#[derive(Clone, Debug)]
pub(super) struct Share(pub CouplingShare<f64>);

impl Share {
    /// A factor of the coordinate.
    pub fn linear(joint: usize, factor: f64) -> Self {
        let coefficients = vec![factor];
        Self(CouplingShare {
            joint,
            coefficients,
        })
    }

    /// Its value, slope and second derivative.
    pub fn at(&self, coordinate: f64) -> [f64; 3] {
        if let [factor] = self.0.coefficients[..] {
            return [factor * coordinate, factor, 0.0];
        }
        let taylor = self.0.taylor(&coordinate);
        [taylor[0], taylor[1], 2.0 * taylor[2]]
    }
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
    /// One over the sum of the factors' sizes, for a radian or the mechanism's length, so that relations are numbers near one.
    pub fn scale(&self, length: f64) -> f64 {
        let size = |(coordinate, share): &(Coordinate, Share)| {
            let unit = match coordinate.measure {
                Measure::Turn(_) => 1.0,
                Measure::Travel(_) => length,
            };
            let factors = (1..).zip(&share.0.coefficients);
            factors
                .map(|(power, factor)| factor.abs() * f64::powi(unit, power))
                .sum::<f64>()
        };
        1.0 / self.terms.iter().map(size).sum::<f64>()
    }
}
