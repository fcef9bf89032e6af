//! How far factors of one pose serve.
//!
//! A step with the factors of a pose p, taken at a pose q of the same curve, leaves E e of an error e, with
//! E = A(p)⁺ (A(q) − A(p)) to first order. Along the curve A changes by A′ = Σ tⱼ ∂A/∂zⱼ per unit of arclength (Lie brackets of its
//! columns, second derivatives of couplings), so that ‖E‖ ≤ s ‖A(p)⁺ A′‖ at the arclength s from p. Where that is a tenth, a step's length is within a tenth of the
//! distance from the curve, *whatever the margin*: an error along a direction that the equations hardly see is divided by what they see
//! of it at p, which differs little from what they see at q. A residual tells nothing of the kind: divided by a margin of 1e-8, what is
//! met to rounding is open to 1e-7.

use super::rows::DenseRows;
use super::sparse_rows::SparseRows;
use super::system::{Evaluation, LoopSystem};
use super::vectors::{dot, length};
use kutzbach_math::matrix::SplitMix64;

/// Sweeps of the power method on a large part: from a start in general position its norm comes out within n^(1/(4·6)), a third for a
/// thousand unknowns; from the direction found at the pose before, which changes little, fewer do.
const SWEEPS: usize = 6;
const MORE_SWEEPS: usize = 2;

/// Where factors were made, and what they are worth beside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kept {
    /// Arclength (metric).
    pub arc: f64,
    /// ‖A⁺ A′‖: what a step leaves of an error, per arclength from there.
    pub rate: f64,
    /// How close to the curve (metric) rounding lets a pose come.
    pub close: f64,
}

impl Kept {
    /// What a step at an arclength leaves of an error.
    pub fn share(&self, arc: f64) -> f64 {
        self.rate * (arc - self.arc).abs()
    }
}

/// A′ as (equation, unknown, value), from the Jacobian last evaluated.
fn changes(
    system: &LoopSystem,
    evaluation: &Evaluation,
    tangent: &[f64],
) -> Vec<(usize, usize, f64)> {
    let mut found = Vec::new();
    system.visit_changes(evaluation, |row, column, by, change| {
        let value = tangent[by] * change;
        if value != 0.0 {
            found.push((row, column, value));
        }
    });
    found
}

/// ‖A⁺ A′‖, from above: the root of the sum of the squares of its entries.
pub(super) fn dense_rate(
    rows: &DenseRows,
    system: &LoopSystem,
    evaluation: &Evaluation,
    equations: usize,
) -> f64 {
    let n = system.unknowns();
    let mut columns = vec![0.0; n * equations];
    for (equation, unknown, value) in changes(system, evaluation, &rows.tangent) {
        columns[unknown * equations + equation] += value;
    }
    let mut image = vec![0.0; n];
    let squares = columns.chunks_exact(equations.max(1)).map(|column| {
        rows.solve(column, &mut image);
        dot(&image, &image)
    });
    squares.sum::<f64>().sqrt()
}

/// ‖A⁺ A′‖ of a large part, by the power method from a direction `x`, which becomes the one for which it is largest.
pub(super) fn sparse_rate(
    rows: &SparseRows,
    system: &LoopSystem,
    evaluation: &Evaluation,
    x: &mut Vec<f64>,
) -> f64 {
    let places: Vec<(usize, usize, f64)> = changes(system, evaluation, &rows.tangent)
        .into_iter()
        .filter_map(|(equation, unknown, value)| Some((rows.place(equation)?, unknown, value)))
        .collect();
    let known = x.len() == system.unknowns();
    if !known {
        let mut random = SplitMix64::new(1);
        *x = (0..system.unknowns()).map(|_| random.symmetric()).collect();
    }
    let mut rate = 0.0;
    for _ in 0..if known { MORE_SWEEPS } else { SWEEPS } {
        let size = length(x);
        if !(size > 0.0) {
            x.clear();
            return rate;
        }
        let mut right = vec![0.0; rows.chosen().len()];
        for &(place, unknown, value) in &places {
            right[place] += value * x[unknown] / size;
        }
        let image = rows.shortest(&right);
        rate = length(&image);
        let back = rows.shortest_transposed(&image);
        x.fill(0.0);
        for &(place, unknown, value) in &places {
            x[unknown] += value * back[place];
        }
    }
    rate
}
