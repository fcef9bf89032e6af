//! The equations and their derivatives at a pose.

use super::rotations::inverse_right_jacobian;
use super::{CompiledCycle, CompiledFactor, LoopSystem, SystemPose};
use kutzbach_closure::{CouplingShare, Rigid, cross_product};

/// The equations of a part at a pose.
#[derive(Clone, Debug, Default)]
pub struct Evaluation {
    /// One number per equation: rad, cycle lengths; couplings in the metric.
    pub residual: Vec<f64>,
    /// Six entries per factor variable passed, in the order of [`LoopSystem::pattern`].
    entries: Vec<[f64; 6]>,
    /// First and second derivatives of the couplings, term by term.
    slopes: Vec<[f64; 2]>,
}

impl Evaluation {
    /// The largest equation left.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.residual.iter().fold(0.0f64, |m, x| {
            if m.is_nan() || x.abs() <= m {
                m
            } else {
                x.abs()
            }
        })
    }
}

/// A share of a coupling at a value of its variable, its slope there and its second derivative.
fn developed(share: &CouplingShare<f64>, at: f64) -> [f64; 3] {
    if let [factor] = share.coefficients[..] {
        return [factor * at, factor, 0.0];
    }
    let taylor = share.taylor(&at);
    [taylor[0], taylor[1], 2.0 * taylor[2]]
}

impl LoopSystem {
    /// Residual and Jacobian at a pose. Allocates only the first time.
    pub fn evaluate(&self, pose: &SystemPose, out: &mut Evaluation) {
        self.walk(pose, out, true);
    }

    /// The residual alone, at half the cost: no Jacobian is in `out` then.
    pub(crate) fn residual(&self, pose: &SystemPose, out: &mut Evaluation) {
        self.walk(pose, out, false);
    }

    fn walk(&self, pose: &SystemPose, out: &mut Evaluation, jacobian: bool) {
        out.residual.clear();
        out.entries.clear();
        out.slopes.clear();
        for cycle in &self.cycles {
            let mut here = Rigid::identity(&1.0);
            let mut start = true;
            for passage in &cycle.passages {
                here = if start {
                    passage.before.clone()
                } else {
                    here.compose(&passage.before)
                };
                start = false;
                let factor = &self.factors[passage.factor];
                let frame = &pose.frames[passage.factor];
                if passage.forward {
                    here = here.compose(frame);
                }
                if jacobian {
                    let sign = if passage.forward { 1.0 } else { -1.0 };
                    self.push_entries(cycle, factor, (&here, sign), &mut out.entries);
                }
                if !passage.forward {
                    here = here.compose(&frame.inverse());
                }
            }
            here = here.compose(&cycle.after);
            let turn = here.rotation_vector();
            let moved = here.apply(&cycle.centre);
            out.residual.extend(turn);
            out.residual
                .extend((0..3).map(|i| (moved[i] - cycle.centre[i]) * cycle.inverse_length));
        }
        for coupling in &self.couplings {
            let mut sum = -coupling.offset;
            for (unknown, share) in &coupling.terms {
                let [value, slope, curvature] = developed(share, pose.values[*unknown]);
                sum += value;
                if jacobian {
                    let weight = self.weights[*unknown];
                    let metric = [slope / weight, curvature / (weight * weight)];
                    out.slopes.push(metric);
                }
            }
            out.residual.push(sum);
        }
    }

    /// (row, unknown, first and second derivative) of every term of a coupling.
    fn coupling_terms<'a>(
        &'a self,
        evaluation: &'a Evaluation,
    ) -> impl Iterator<Item = (usize, usize, [f64; 2])> + 'a {
        let first = 6 * self.cycles.len();
        let terms = self.couplings.iter().enumerate().flat_map(move |(i, c)| {
            c.terms
                .iter()
                .map(move |(unknown, _)| (first + i, *unknown))
        });
        terms
            .zip(&evaluation.slopes)
            .map(|((row, unknown), slopes)| (row, unknown, *slopes))
    }

    /// The derivatives of a cycle's closure by a factor's variables, passed at a displacement.
    fn push_entries(
        &self,
        cycle: &CompiledCycle,
        factor: &CompiledFactor,
        (here, sign): (&Rigid<f64>, f64),
        entries: &mut Vec<[f64; 6]>,
    ) {
        let arm = [0, 1, 2].map(|i| here.translation[i] - cycle.centre[i]);
        for (offset, (angular, linear)) in factor.generators.iter().enumerate() {
            let unit = sign / self.weights[factor.first + offset];
            let turn = here.rotate(angular);
            let slide = here.rotate(linear);
            let moment = cross_product(&arm, &turn);
            let inverse = unit * cycle.inverse_length;
            entries.push([
                unit * turn[0],
                unit * turn[1],
                unit * turn[2],
                inverse * (moment[0] + slide[0]),
                inverse * (moment[1] + slide[1]),
                inverse * (moment[2] + slide[2]),
            ]);
        }
    }

    /// Writes the Jacobian row by row into a dense array of `equations × unknowns` numbers.
    pub fn fill_dense(&self, evaluation: &Evaluation, rows: &mut [f64]) {
        let columns = self.unknowns();
        rows[..self.equations() * columns].fill(0.0);
        for (&(cycle, unknown), entry) in self.pattern.iter().zip(&evaluation.entries) {
            for (row, value) in entry.iter().enumerate() {
                rows[(6 * cycle + row) * columns + unknown] = *value;
            }
        }
        for (row, unknown, [slope, _]) in self.coupling_terms(evaluation) {
            rows[row * columns + unknown] = slope;
        }
    }

    /// The entries of the Jacobian as (row, column, value).
    pub fn triplets<'a>(
        &'a self,
        evaluation: &'a Evaluation,
    ) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
        let cycles =
            self.pattern
                .iter()
                .zip(&evaluation.entries)
                .flat_map(|(&(cycle, unknown), entry)| {
                    entry
                        .iter()
                        .enumerate()
                        .map(move |(row, value)| (6 * cycle + row, unknown, *value))
                });
        let couplings = self.coupling_terms(evaluation);
        let couplings = couplings.map(|(row, unknown, [slope, _])| (row, unknown, slope));
        cycles.chain(couplings)
    }

    /// How the Jacobian changes: calls `visit(row, column, unknown, change)` for every entry and every unknown that changes it.
    ///
    /// A joint on the way around a cycle carries along the screws of all joints behind it, so that the derivative of a
    /// screw is the Lie bracket of both (Herve 1978; Selig 2005, section 4.3). A coupling's slope changes with its own variable only.
    pub(crate) fn visit_changes(
        &self,
        evaluation: &Evaluation,
        mut visit: impl FnMut(usize, usize, usize, f64),
    ) {
        for (row, unknown, [_, curvature]) in self.coupling_terms(evaluation) {
            if curvature != 0.0 {
                visit(row, unknown, unknown, curvature);
            }
        }
        let mut first = 0;
        for (cycle, compiled) in self.cycles.iter().enumerate() {
            // Place of every factor's screws among the entries; a ball passed forward carries along its own.
            let mut passed: Vec<usize> = Vec::new();
            let mut next = first;
            for passage in &compiled.passages {
                let own = next..next + self.factors[passage.factor].generators.len();
                next = own.end;
                if passage.forward {
                    passed.extend(own.clone());
                }
                for column in own.clone() {
                    for &by in &passed {
                        let change = bracket(&evaluation.entries[by], &evaluation.entries[column]);
                        let (column, by) = (self.pattern[column].1, self.pattern[by].1);
                        for (row, value) in change.into_iter().enumerate() {
                            visit(6 * cycle + row, column, by, value);
                        }
                    }
                }
                if !passage.forward {
                    passed.extend(own);
                }
            }
            first = next;
        }
    }

    /// The derivative of an unknown's *value* with respect to the metric unknowns, in the metric: a unit vector for hinges
    /// and slides; for a ball the row of the rotation vector's derivative. Written to `row`.
    pub fn value_row(&self, pose: &SystemPose, unknown: usize, row: &mut [f64]) {
        row.fill(0.0);
        let Some(factor) = self
            .factors
            .iter()
            .find(|f| (f.first..f.first + f.generators.len()).contains(&unknown))
        else {
            return;
        };
        if factor.generators.len() == 1 {
            row[unknown] = 1.0;
            return;
        }
        let own = factor.first..factor.first + factor.generators.len();
        let mut turn = [0.0; 3];
        for (value, (angular, _)) in pose.values[own.clone()].iter().zip(&factor.generators) {
            for (t, a) in turn.iter_mut().zip(angular) {
                *t += a * value;
            }
        }
        let wanted = factor.generators[unknown - factor.first].0;
        for (slot, (angular, _)) in row[own].iter_mut().zip(&factor.generators) {
            let image = inverse_right_jacobian(&turn, angular);
            *slot = wanted.iter().zip(&image).map(|(w, i)| w * i).sum();
        }
    }
}

/// The Lie bracket of two twists (ω; v) about one point.
fn bracket(a: &[f64; 6], b: &[f64; 6]) -> [f64; 6] {
    let (turn_a, slide_a) = ([a[0], a[1], a[2]], [a[3], a[4], a[5]]);
    let (turn_b, slide_b) = ([b[0], b[1], b[2]], [b[3], b[4], b[5]]);
    let turn = cross_product(&turn_a, &turn_b);
    let (one, two) = (
        cross_product(&turn_a, &slide_b),
        cross_product(&slide_a, &turn_b),
    );
    [
        turn[0],
        turn[1],
        turn[2],
        one[0] + two[0],
        one[1] + two[1],
        one[2] + two[2],
    ]
}
