//! Cubics: what predicts the next pose, and the poses between two nodes.

use super::node::Node;
use super::solver::Solver;
use super::vectors::{dot, length};

/// The cubic that leaves a pose with its tangent and came from the one before with that one's.
pub(super) struct Predictor {
    first: Vec<f64>,
    second: Vec<f64>,
    third: Vec<f64>,
}

impl Predictor {
    pub(super) fn new(solver: &Solver, before: Option<&Node>, here: &Node) -> Self {
        let n = here.tangent.len();
        let mut predictor = Self {
            first: here.tangent.clone(),
            second: vec![0.0; n],
            third: vec![0.0; n],
        };
        if let Some(before) = before {
            let mut back = vec![0.0; n];
            solver.system.way(&here.pose, &before.pose, &mut back);
            let tangent = solver.system.chart_velocity(&back, &before.tangent);
            let gap = here.arc - before.arc;
            if gap.abs() > 1e-12 {
                let gap = gap.abs();
                for i in 0..n {
                    let a = (back[i] + here.tangent[i] * gap) / (gap * gap);
                    let b = (here.tangent[i] - tangent[i]) / gap;
                    predictor.third[i] = (2.0 * a - b) / gap;
                    predictor.second[i] = 3.0 * a - b;
                }
            }
        }
        predictor
    }

    pub(super) fn at(&self, u: f64) -> Vec<f64> {
        (0..self.first.len())
            .map(|i| u * (self.first[i] + u * (self.second[i] + u * self.third[i])))
            .collect()
    }

    pub(super) fn direction(&self, u: f64) -> Vec<f64> {
        let mut d: Vec<f64> = (0..self.first.len())
            .map(|i| self.first[i] + u * (2.0 * self.second[i] + u * 3.0 * self.third[i]))
            .collect();
        let size = length(&d);
        d.iter_mut().for_each(|x| *x /= size);
        d
    }
}

/// The cubic Hermite interpolant between two nodes, in the chart of the first; `u` from 0 to 1.
#[derive(Clone, Debug)]
pub(super) struct Cubic {
    first: Vec<f64>,
    last: Vec<f64>,
    chord: Vec<f64>,
}

impl Cubic {
    pub fn between(solver: &Solver, from: &Node, to: &Node) -> Self {
        let n = from.tangent.len();
        let mut chord = vec![0.0; n];
        solver.system.way(&from.pose, &to.pose, &mut chord);
        let size = length(&chord);
        // The chord of an arc that turns by τ is shorter than the arc by a part of τ²/24.
        let turned: Vec<f64> = from
            .tangent
            .iter()
            .zip(&to.tangent)
            .map(|(a, b)| a - b)
            .collect();
        let arc = size * (1.0 + dot(&turned, &turned) / 24.0);
        let last = solver.system.chart_velocity(&chord, &to.tangent);
        Self {
            first: from.tangent.iter().map(|t| t * arc).collect(),
            last: last.iter().map(|t| t * arc).collect(),
            chord,
        }
    }

    pub fn at(&self, u: f64) -> Vec<f64> {
        let (a, b, c) = (
            u * (1.0 - u) * (1.0 - u),
            u * u * (3.0 - 2.0 * u),
            u * u * (u - 1.0),
        );
        (0..self.chord.len())
            .map(|i| a * self.first[i] + b * self.chord[i] + c * self.last[i])
            .collect()
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.chord.len()
    }

    /// One component of [`Self::at`].
    pub fn component(&self, i: usize, u: f64) -> f64 {
        u * (1.0 - u) * (1.0 - u) * self.first[i]
            + u * u * (3.0 - 2.0 * u) * self.chord[i]
            + u * u * (u - 1.0) * self.last[i]
    }

    /// One component of [`Self::velocity`].
    pub fn speed(&self, i: usize, u: f64) -> f64 {
        (1.0 - u) * (1.0 - 3.0 * u) * self.first[i]
            + 6.0 * u * (1.0 - u) * self.chord[i]
            + u * (3.0 * u - 2.0) * self.last[i]
    }

    pub fn velocity(&self, u: f64) -> Vec<f64> {
        let (a, b, c) = (
            (1.0 - u) * (1.0 - 3.0 * u),
            6.0 * u * (1.0 - u),
            u * (3.0 * u - 2.0),
        );
        (0..self.chord.len())
            .map(|i| a * self.first[i] + b * self.chord[i] + c * self.last[i])
            .collect()
    }
}

/// The length of the cubic between two nodes, in the chart of the first: Gauss quadrature with three points, off by the
/// seventh power of the step.
pub(super) fn arc_between(solver: &Solver, from: &Node, to: &Node) -> f64 {
    let cubic = Cubic::between(solver, from, to);
    let root = 0.6f64.sqrt() / 2.0;
    [(0.5 - root, 5.0), (0.5, 8.0), (0.5 + root, 5.0)]
        .into_iter()
        .map(|(u, weight)| length(&cubic.velocity(u)) * weight / 18.0)
        .sum()
}
