//! Newton's method on the chosen equations of a part, some joint variables held.
//!
//! A step is the shortest one that the chosen equations ask for, plus what is needed along the tangent so that one further
//! condition holds: that the pose does not move along a given direction, or that a joint variable has a given value. The
//! factors of one pose serve for the steps after it as long as every step is a hundredth of the one before; so a pose that is
//! predicted to six digits costs one factorization and two or three residuals.
//!
//! Convergence is measured by the step, not by the residual, which a redundant equation may keep above rounding; all
//! equations, chosen or not, are held against what is allowed at the end.

use super::deflation::Deflation;
use super::result::TraceOptions;
use super::rows::DenseRows;
use super::sparse_rows::SparseRows;
use super::system::{Evaluation, LoopSystem, SystemPose};
use super::vectors::dot;
use std::sync::Arc;

/// Parts with more unknowns are factored sparsely.
const DENSE_UNKNOWNS: usize = 150;

/// Steps of Newton's method before it is given up. Quadratic convergence from the worst prediction that is accepted needs
/// five or six.
const STEP_LIMIT: usize = 16;

/// A step longer than this (metric) is no correction.
const LONGEST_STEP: f64 = 1.0;

/// Singular values below this share of the largest ask for no step in [`Solver::polish`].
const NEARLY_VANISHING: f64 = 1e-3;

#[derive(Clone, Debug)]
enum Rows {
    Dense(DenseRows),
    Sparse(Box<SparseRows>),
}

/// The condition that singles out one pose of the curve.
#[derive(Clone, Copy, Debug)]
pub(super) enum Along<'r> {
    /// Corrections do not move along this unit vector of the metric.
    Across(&'r [f64]),
    /// An unknown has this value (rad, m).
    Value(usize, f64),
}

/// What a correction came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corrected {
    /// Length of all steps together, in the metric.
    pub way: f64,
    /// Largest equation left.
    pub closure: f64,
}

/// Solves the equations of a part about poses of one branch.
#[derive(Clone, Debug)]
pub(super) struct Solver {
    pub system: Arc<LoopSystem>,
    /// Unknowns that are held, with their values.
    holds: Vec<(usize, f64)>,
    rows: Rows,
    deflation: Option<Deflation>,
    evaluation: Evaluation,
    right: Vec<f64>,
    step: Vec<f64>,
    row: Vec<f64>,
    /// Largest closure that counts as closed: rounding, or what the file's digits leave.
    pub allowed: f64,
    /// A pose whose equations and condition are met to this is taken as it is; zero asks for rounding.
    pub tolerance: f64,
    /// How far a variable may go from its start (metric).
    pub reach: f64,
    /// Poses computed each way before a curve has been followed far enough.
    pub poses: usize,
}

impl Solver {
    /// `None` where the equations cannot be chosen at `start`, a generic pose of the branch closed as well as can be.
    /// `excess` is by how many the instantaneous freedom exceeds the dimension all along the branch.
    pub fn new(
        system: Arc<LoopSystem>,
        start: &SystemPose,
        holds: Vec<(usize, f64)>,
        excess: usize,
        allowed: f64,
    ) -> Option<Self> {
        Self::with_dense_up_to(DENSE_UNKNOWNS, system, start, holds, excess, allowed)
    }

    /// As [`Self::new`]; parts of more unknowns than `dense` are factored sparsely.
    pub fn with_dense_up_to(
        dense: usize,
        system: Arc<LoopSystem>,
        start: &SystemPose,
        holds: Vec<(usize, f64)>,
        excess: usize,
        allowed: f64,
    ) -> Option<Self> {
        let unknowns = system.unknowns();
        let plain = system.equations() + holds.len();
        let mut evaluation = Evaluation::default();
        system.evaluate(start, &mut evaluation);
        let deflation = match excess {
            0 => None,
            _ => Some(Deflation::new(&system, start, &holds, excess)?),
        };
        let equations = plain + deflation.as_ref().map_or(0, Deflation::equations);
        let rows = if unknowns <= dense || deflation.is_some() {
            Rows::Dense(DenseRows::new(unknowns, equations))
        } else {
            let mut sparse = SparseRows::new(unknowns, equations);
            let held = held_triplets(&system, start, &holds);
            let entries = system.triplets(&evaluation).chain(held);
            if !sparse.choose(entries).ok()? {
                return None;
            }
            Rows::Sparse(Box::new(sparse))
        };
        let mut solver = Self {
            system,
            holds,
            rows,
            deflation,
            evaluation,
            right: vec![0.0; equations],
            step: vec![0.0; unknowns],
            row: vec![0.0; unknowns],
            allowed,
            tolerance: 0.0,
            reach: TraceOptions::default().reach,
            poses: TraceOptions::default().poses,
        };
        solver.linearise(start).then_some(solver)
    }

    /// Unknowns that are held, with their values.
    pub fn holds(&self) -> &[(usize, f64)] {
        &self.holds
    }

    /// Evaluates and factors at a pose. False where the chosen equations depend on one another there.
    pub fn linearise(&mut self, pose: &SystemPose) -> bool {
        self.look(pose);
        self.factor(pose)
    }

    fn look(&mut self, pose: &SystemPose) {
        self.system.evaluate(pose, &mut self.evaluation);
        self.read_right(pose);
    }

    /// What the equations and conditions are off by at the pose last evaluated.
    fn read_right(&mut self, pose: &SystemPose) {
        self.right.clear();
        self.right
            .extend(self.evaluation.residual.iter().map(|r| -r));
        for (unknown, value) in &self.holds {
            let off = (value - pose.values[*unknown]) * self.system.weights()[*unknown];
            self.right.push(off);
        }
        if let Some(deflation) = &self.deflation {
            deflation.residual(&self.system, pose, &mut self.right);
        }
    }

    fn factor(&mut self, pose: &SystemPose) -> bool {
        let n = self.system.unknowns();
        let first = self.system.equations();
        match &mut self.rows {
            Rows::Dense(dense) => {
                self.system.fill_dense(&self.evaluation, &mut dense.rows);
                for (index, (unknown, _)) in self.holds.iter().enumerate() {
                    let at = (first + index) * n;
                    self.system
                        .value_row(pose, *unknown, &mut dense.rows[at..at + n]);
                }
                if let Some(deflation) = &self.deflation {
                    let at = (first + self.holds.len()) * n;
                    deflation.rows(&self.system, pose, &mut dense.rows[at..]);
                }
                dense.factor()
            }
            Rows::Sparse(sparse) => {
                let held = held_triplets(&self.system, pose, &self.holds);
                let entries = self.system.triplets(&self.evaluation).chain(held);
                matches!(sparse.factor(entries), Ok(true))
            }
        }
    }

    /// The unit tangent found by the last factorization, in the metric; its sign is open.
    pub fn tangent(&self) -> &[f64] {
        match &self.rows {
            Rows::Dense(dense) => &dense.tangent,
            Rows::Sparse(sparse) => &sparse.tangent,
        }
    }

    /// The least singular value of the chosen equations at the last factorization.
    pub fn margin(&self) -> f64 {
        match &self.rows {
            Rows::Dense(dense) => dense.least_singular_value(),
            Rows::Sparse(sparse) => sparse.least_singular_value(),
        }
    }

    /// The equations chosen by the last factorization.
    pub fn chosen(&self) -> Vec<usize> {
        match &self.rows {
            Rows::Dense(dense) => dense.chosen().to_vec(),
            Rows::Sparse(sparse) => sparse.chosen().to_vec(),
        }
    }

    /// Number of equations, held variables and those of the deflation included.
    pub fn equations(&self) -> usize {
        self.right.len()
    }

    /// Chooses these equations from now on, or the most independent ones each time.
    pub fn fix(&mut self, chosen: Option<Vec<usize>>) {
        if let Rows::Dense(dense) = &mut self.rows {
            dense.fix(chosen);
        }
    }

    /// The sign of the determinant of certain equations at a pose, with the curve's tangent there as the last row: it
    /// changes where an odd number of other branches cross. Zero where that is not known (large or shaky parts).
    pub fn orientation(&mut self, chosen: &[usize], pose: &SystemPose, tangent: &[f64]) -> f64 {
        if self.deflation.is_some() || matches!(self.rows, Rows::Sparse(_)) {
            return 0.0;
        }
        self.fix(Some(chosen.to_vec()));
        let sound = self.linearise(pose);
        self.fix(None);
        match &self.rows {
            Rows::Dense(dense) if sound => dense.orientation(tangent),
            _ => 0.0,
        }
    }

    /// The shortest x with (chosen equations) x = right, at the last factorization.
    pub fn shortest(&self, right: &[f64], x: &mut [f64]) {
        match &self.rows {
            Rows::Dense(dense) => dense.solve(right, x),
            Rows::Sparse(sparse) => sparse.solve(right, x, true),
        }
    }

    /// Largest loop equation at the pose last looked at.
    pub fn closure(&self) -> f64 {
        self.evaluation.largest()
    }

    /// Largest loop equation at a pose.
    pub fn closure_of(&mut self, pose: &SystemPose) -> f64 {
        self.system.residual(pose, &mut self.evaluation);
        self.evaluation.largest()
    }

    /// One step of least length on all equations at once, close to a singular pose: what nearly vanishing singular values
    /// would ask for is left out, so that the step is short and closes the loops without moving the pose along the curve
    /// or off it.
    pub fn polish(&mut self, pose: &mut SystemPose) -> f64 {
        let rows = self.dense_jacobian(pose);
        self.look(pose);
        let n = self.system.unknowns();
        if n > 2 * DENSE_UNKNOWNS {
            return self.closure_of(pose);
        }
        let matrix = faer::Mat::from_fn(rows.len() / n.max(1), n, |i, j| rows[i * n + j]);
        if let Ok(parts) = matrix.thin_svd() {
            let values = parts.S().column_vector();
            let least = NEARLY_VANISHING * values.iter().fold(0.0, |m: f64, s| m.max(*s));
            let mut step = vec![0.0; n];
            for (k, value) in values.iter().enumerate().filter(|(_, s)| **s > least) {
                let left = parts.U().col(k);
                let along: f64 = left.iter().zip(&self.right).map(|(u, r)| u * r).sum();
                let right = parts.V().col(k);
                step.iter_mut()
                    .zip(right.iter())
                    .for_each(|(s, v)| *s += along / value * v);
            }
            self.system.advance(pose, &step);
        }
        self.closure_of(pose)
    }

    /// The Jacobian of the loop equations and held variables at a pose, row by row.
    pub fn dense_jacobian(&mut self, pose: &SystemPose) -> Vec<f64> {
        let n = self.system.unknowns();
        let first = self.system.equations();
        self.system.evaluate(pose, &mut self.evaluation);
        let mut rows = vec![0.0; (first + self.holds.len()) * n];
        self.system.fill_dense(&self.evaluation, &mut rows);
        for (index, (unknown, _)) in self.holds.iter().enumerate() {
            let at = (first + index) * n;
            self.system.value_row(pose, *unknown, &mut rows[at..at + n]);
        }
        rows
    }

    /// Whether the branch is shaky all along.
    pub fn is_deflated(&self) -> bool {
        self.deflation.is_some()
    }

    /// Takes a pose of the branch as the one about which directions of a shaky branch are told apart.
    pub fn anchor(&mut self, pose: &SystemPose) {
        if let Some(deflation) = &mut self.deflation {
            deflation.anchor(&self.system, pose, &self.holds);
        }
    }

    /// Moves a pose onto the curve. `None` where that does not converge or some equation stays open; the pose is then of no
    /// use.
    pub fn correct(&mut self, pose: &mut SystemPose, along: Along<'_>) -> Option<Corrected> {
        let mut way = 0.0;
        let mut before = f64::INFINITY;
        let mut factored = false;
        for _ in 0..STEP_LIMIT {
            if factored {
                self.system.residual(pose, &mut self.evaluation);
                self.read_right(pose);
            } else {
                self.look(pose);
            }
            let rest = self.fill_condition(pose, along);
            let closure = self.closure();
            if self.is_good_enough(rest) {
                return Some(Corrected { way, closure });
            }
            if !factored && !self.factor(pose) {
                return None;
            }
            let length = self.find_step(rest)?;
            self.system.advance(pose, &self.step);
            way += length;
            // Rounding: residuals are off by some 1e-16 per joint passed, so that steps do not fall below about as much.
            let stalled = length >= 0.5 * before && before < 1e-11;
            if length < 1e-15 || stalled {
                before = before.min(length);
                break;
            }
            if length > 1e-2 && before < 1e-3 {
                return None;
            }
            factored = length < 1e-2 * before.min(1.0) || length < 1e-7;
            before = length;
        }
        self.system.residual(pose, &mut self.evaluation);
        let closure = self.closure();
        (closure <= self.allowed && before < 1e-6).then_some(Corrected { way, closure })
    }

    /// The step that the last factorization asks for, in `self.step`, and its length; `None` for one that is no correction. That of a large
    /// part is rough: what it leaves is for the next one.
    fn find_step(&mut self, rest: f64) -> Option<f64> {
        let mut step = std::mem::take(&mut self.step);
        match &self.rows {
            Rows::Dense(dense) => dense.solve(&self.right, &mut step),
            Rows::Sparse(sparse) => sparse.solve(&self.right, &mut step, false),
        }
        let tangent = self.tangent();
        let amount = (rest - dot(&self.row, &step)) / dot(&self.row, tangent);
        step.iter_mut()
            .zip(tangent)
            .for_each(|(s, t)| *s += amount * t);
        let length = dot(&step, &step).sqrt();
        self.step = step;
        (length <= LONGEST_STEP).then_some(length)
    }

    /// Whether every equation, and the condition that is off by `rest`, is met to the tolerance.
    fn is_good_enough(&self, rest: f64) -> bool {
        let met = |off: &f64| off.abs() <= self.tolerance;
        self.tolerance > 0.0 && met(&rest) && self.right.iter().all(met)
    }

    /// Puts the row of the further condition into `self.row`; returns how far it is from being met, in the metric.
    fn fill_condition(&mut self, pose: &SystemPose, along: Along<'_>) -> f64 {
        match along {
            Along::Across(direction) => {
                self.row.copy_from_slice(direction);
                0.0
            }
            Along::Value(unknown, value) => {
                self.system.value_row(pose, unknown, &mut self.row);
                (value - pose.values[unknown]) * self.system.weights()[unknown]
            }
        }
    }
}

fn held_triplets(
    system: &LoopSystem,
    pose: &SystemPose,
    holds: &[(usize, f64)],
) -> Vec<(usize, usize, f64)> {
    let mut row = vec![0.0; system.unknowns()];
    let mut triplets = Vec::new();
    for (index, (unknown, _)) in holds.iter().enumerate() {
        system.value_row(pose, *unknown, &mut row);
        let filled = row.iter().enumerate().filter(|(_, v)| **v != 0.0);
        triplets.extend(filled.map(|(c, v)| (system.equations() + index, c, *v)));
    }
    triplets
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::follow::follow;
    use crate::node::node_at;
    use crate::samples::system;
    use kutzbach_mobility::families::{miura_sheet, scissor_lift};

    #[test]
    fn a_curve_is_the_same_factored_densely_and_sparsely() {
        for mechanism in [scissor_lift(6).unwrap(), miura_sheet(3, 3).unwrap()] {
            let (system, home) = system(&mechanism);
            let mut toward = vec![0.0; system.unknowns()];
            toward[0] = 1.0;
            let reached: Vec<Vec<f64>> = [usize::MAX, 0]
                .into_iter()
                .map(|dense| {
                    let mut solver = Solver::with_dense_up_to(
                        dense,
                        Arc::clone(&system),
                        &home,
                        Vec::new(),
                        0,
                        1e-12,
                    )
                    .unwrap();
                    assert_eq!(matches!(solver.rows, Rows::Sparse(_)), dense == 0);
                    let start = node_at(&mut solver, home.clone(), &toward, 0.0).unwrap();
                    let (nodes, _) = follow(&mut solver, &start, &start, &[], 0.5);
                    let mut pose = nodes.last().unwrap().pose.clone();
                    let value = home.values[0] + 0.1;
                    solver.correct(&mut pose, Along::Value(0, value)).unwrap();
                    pose.values
                })
                .collect();
            for (a, b) in reached[0].iter().zip(&reached[1]) {
                assert!((a - b).abs() < 1e-11, "{a} {b}");
            }
        }
    }
}
