//! Passages through singular poses: polynomials through poses on both sides.

use super::solver::Solver;
use super::system::SystemPose;
use super::vectors::length;

/// Nearer to the middle than this, in units of the half width, poses are interpolated and not corrected.
const BESIDE: f64 = 0.3;

/// A polynomial in one variable with vector coefficients, passing through a singular pose.
#[derive(Clone, Debug)]
pub(super) struct Bridge {
    /// The pose whose chart the coefficients are in.
    reference: SystemPose,
    /// Where the window begins and ends, in its own unit; the singular pose is at zero.
    window: (f64, f64),
    /// Coefficients of 1, x, x², …
    coefficients: Vec<Vec<f64>>,
}

impl Bridge {
    fn x(&self, u: f64) -> f64 {
        self.window.0 + u * (self.window.1 - self.window.0)
    }

    /// Whether a place is far enough from the middle for corrections.
    pub fn is_beside(&self, u: f64) -> bool {
        self.x(u).abs() > BESIDE * 0.5 * (self.window.1 - self.window.0)
    }

    /// Where the singular pose is, from 0 to 1.
    pub fn middle(&self) -> f64 {
        -self.window.0 / (self.window.1 - self.window.0)
    }

    fn at(&self, x: f64) -> Vec<f64> {
        horner(&self.coefficients, x)
    }

    pub fn pose(&self, solver: &Solver, u: f64) -> SystemPose {
        let mut pose = self.reference.clone();
        solver.system.advance(&mut pose, &self.at(self.x(u)));
        pose
    }

    /// The same passage, with turns counted on by this much.
    pub fn shift(&mut self, around: &[f64]) {
        for (value, way) in self.reference.values.iter_mut().zip(around) {
            *value += way;
        }
    }

    /// The velocity in the chart of the reference, per unit of `u`.
    pub fn velocity(&self, u: f64) -> Vec<f64> {
        let x = self.x(u);
        let unit = self.window.1 - self.window.0;
        let derivative: Vec<Vec<f64>> = self
            .coefficients
            .iter()
            .enumerate()
            .skip(1)
            .map(|(k, c)| c.iter().map(|v| v * k as f64 * unit).collect())
            .collect();
        horner(&derivative, x)
    }

    pub fn direction(&self, u: f64) -> Vec<f64> {
        let mut v = self.velocity(u);
        let mut size = length(&v);
        if !(size > 1e-12) {
            // At a cusp: as just behind it.
            v = self.velocity(u + 1e-6);
            size = length(&v);
        }
        v.iter_mut().for_each(|x| *x /= size);
        v
    }

    /// Length of the passage in the metric, by Gauss quadrature with three points in ten pieces.
    pub fn arc(&self) -> f64 {
        let root = 0.6f64.sqrt() / 2.0;
        (0..10)
            .flat_map(|piece| {
                [(0.5 - root, 5.0), (0.5, 8.0), (0.5 + root, 5.0)]
                    .map(|(u, weight)| ((f64::from(piece) + u) / 10.0, weight / 180.0))
            })
            .map(|(u, weight)| length(&self.velocity(u)) * weight)
            .sum()
    }

    /// A passage through poses at places in `[−1, 1]`, the singular one at zero.
    pub fn through(reference: SystemPose, places: &[f64], values: &[Vec<f64>]) -> Self {
        Self {
            reference,
            window: (
                places.first().copied().unwrap_or(-1.0),
                places.last().copied().unwrap_or(1.0),
            ),
            coefficients: interpolate(places, values),
        }
    }

    /// The same passage, the other way.
    pub fn reverse(&mut self) {
        self.window = (-self.window.1, -self.window.0);
        for coefficient in self.coefficients.iter_mut().skip(1).step_by(2) {
            coefficient.iter_mut().for_each(|c| *c = -*c);
        }
    }
}

pub(super) fn horner(coefficients: &[Vec<f64>], x: f64) -> Vec<f64> {
    let size = coefficients.first().map_or(0, Vec::len);
    coefficients.iter().rev().fold(vec![0.0; size], |sum, c| {
        sum.iter().zip(c).map(|(s, c)| s * x + c).collect()
    })
}

/// The polynomial through values at places, by divided differences (Higham 2002, section 5.3).
pub(super) fn interpolate(places: &[f64], values: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let count = places.len();
    let mut table = values.to_vec();
    for order in 1..count {
        for i in (order..count).rev() {
            let gap = places[i] - places[i - order];
            let (low, high) = table.split_at_mut(i);
            for (entry, before) in high[0].iter_mut().zip(&low[i - 1]) {
                *entry = (*entry - before) / gap;
            }
        }
    }
    let size = values.first().map_or(0, Vec::len);
    let mut coefficients = vec![vec![0.0; size]; count];
    for i in (0..count).rev() {
        // p ← p (x − xᵢ) + dᵢ
        for k in (1..count).rev() {
            let (low, high) = coefficients.split_at_mut(k);
            for (c, before) in high[0].iter_mut().zip(&low[k - 1]) {
                *c = before - places[i] * *c;
            }
        }
        for (c, d) in coefficients[0].iter_mut().zip(&table[i]) {
            *c = d - places[i] * *c;
        }
    }
    coefficients
}
