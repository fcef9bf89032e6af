//! Branches that are infinitesimally mobile all along (shaky): dim ker J exceeds the branch's dimension at every pose.
//!
//! There the Jacobian A of the equations has rank r everywhere on the branch and more beside it, so that its kernel does not
//! tell the tangent and Newton's method slows down: the equations are satisfied to second order by what is wrong to first.
//! The rank itself is the missing equation. With A bordered by bases U, V of its left and right kernel at a pose nearby,
//!
//! ```text
//! ⎡ A   U ⎤ ⎡ X ⎤   ⎡ 0 ⎤
//! ⎣ Vᵀ  0 ⎦ ⎣ G ⎦ = ⎣ 1 ⎦
//! ```
//!
//! the matrix G(z) vanishes exactly where A(z) has rank r (Griewank & Reddien 1984; Govaerts 2000, section 3.3), to first
//! order in the distance. Its entries are added to the equations: deflation by bordering (Leykin, Verschelde & Zhao 2006
//! add the same information with more unknowns). Where even these leave more than one direction, the branch cannot be
//! followed by this means.
//!
//! Derivatives of G follow from those of A, which are Lie brackets of its columns; only the rows of held balls take
//! symmetric differences, with steps of 1e-5, off by about 1e-10 of themselves. The chart of a rod turns about it on the
//! way, which the derivative leaves out: that changes A by a factor from the right, and G not at all to first order where
//! it vanishes.

use super::system::{Evaluation, LoopSystem, SystemPose};
use nalgebra::{DMatrix, DVector};

/// Step of a difference (metric).
const DIFFERENCE: f64 = 1e-5;

/// Parts with more unknowns are not deflated: the entries of G are products of two kernels and grow with them.
const MOST_UNKNOWNS: usize = 60;

/// The equations that say that the rank is what it is all along the branch.
#[derive(Clone, Debug)]
pub(super) struct Deflation {
    /// Left and right kernels at the anchor.
    left: DMatrix<f64>,
    right: DMatrix<f64>,
    holds: Vec<(usize, f64)>,
    rank: usize,
}

fn jacobian(system: &LoopSystem, pose: &SystemPose, holds: &[(usize, f64)]) -> DMatrix<f64> {
    let n = system.unknowns();
    let first = system.equations();
    let mut evaluation = Evaluation::default();
    system.evaluate(pose, &mut evaluation);
    let mut rows = vec![0.0; (first + holds.len()) * n];
    system.fill_dense(&evaluation, &mut rows);
    for (index, (unknown, _)) in holds.iter().enumerate() {
        let at = (first + index) * n;
        system.value_row(pose, *unknown, &mut rows[at..at + n]);
    }
    DMatrix::from_row_slice(first + holds.len(), n, &rows)
}

impl Deflation {
    /// `excess` is by how many the freedom at every pose exceeds the branch's dimension.
    pub fn new(
        system: &LoopSystem,
        pose: &SystemPose,
        holds: &[(usize, f64)],
        excess: usize,
    ) -> Option<Self> {
        let n = system.unknowns();
        let rank = n.checked_sub(1 + excess)?;
        if n > MOST_UNKNOWNS || system.equations() + holds.len() < rank {
            return None;
        }
        let mut deflation = Self {
            left: DMatrix::zeros(0, 0),
            right: DMatrix::zeros(0, 0),
            holds: holds.to_vec(),
            rank,
        };
        deflation.anchor(system, pose, holds);
        Some(deflation)
    }

    /// Takes the kernels at another pose of the branch.
    pub fn anchor(&mut self, system: &LoopSystem, pose: &SystemPose, holds: &[(usize, f64)]) {
        let a = jacobian(system, pose, holds);
        let size = a.nrows().max(a.ncols());
        let (rows, columns) = a.shape();
        // Squared off with zeros, so that both bases are complete.
        let square = a.resize(size, size, 0.0);
        let svd = square.svd(true, true);
        let (Some(u), Some(v)) = (svd.u, svd.v_t) else {
            return;
        };
        // Zeros that were added have kernels of their own; what belongs to A is orthonormalised anew.
        let mut order: Vec<usize> = (0..size).collect();
        order.sort_by(|a, b| svd.singular_values[*b].total_cmp(&svd.singular_values[*a]));
        let range = &order[..self.rank];
        let kept = DMatrix::from_fn(rows, self.rank, |i, j| u[(i, range[j])]);
        self.left = complement(&kept);
        let kept = DMatrix::from_fn(columns, self.rank, |i, j| v[(range[j], i)]);
        self.right = complement(&kept);
    }

    /// Number of equations added.
    pub fn equations(&self) -> usize {
        self.left.ncols() * self.right.ncols()
    }

    /// The bordered matrix, factored, with the number of rows and columns of A.
    fn bordered(&self, a: &DMatrix<f64>) -> DMatrix<f64> {
        let (rows, columns) = a.shape();
        let size = rows + self.right.ncols();
        let mut bordered = DMatrix::zeros(size, size);
        bordered.view_mut((0, 0), (rows, columns)).copy_from(a);
        bordered
            .view_mut((0, columns), (rows, self.left.ncols()))
            .copy_from(&self.left);
        bordered
            .view_mut((rows, 0), (self.right.ncols(), columns))
            .copy_from(&self.right.transpose());
        bordered
    }

    /// Appends −G at a pose.
    pub fn residual(&self, system: &LoopSystem, pose: &SystemPose, right: &mut Vec<f64>) {
        let a = jacobian(system, pose, &self.holds);
        let (rows, columns) = a.shape();
        let size = rows + self.right.ncols();
        let mut unit = DMatrix::zeros(size, self.right.ncols());
        for column in 0..self.right.ncols() {
            unit[(rows + column, column)] = 1.0;
        }
        match self.bordered(&a).lu().solve(&unit) {
            Some(x) => right.extend(x.rows(columns, self.left.ncols()).iter().map(|x| -x)),
            None => right.extend(std::iter::repeat_n(f64::NAN, self.equations())),
        }
    }

    /// Writes the derivatives of G, one row per equation: dG = −W dA X, where X solves the bordered system and W its
    /// transpose.
    pub fn rows(&self, system: &LoopSystem, pose: &SystemPose, into: &mut [f64]) {
        let n = system.unknowns();
        into.fill(0.0);
        let a = jacobian(system, pose, &self.holds);
        let (rows, columns) = a.shape();
        let size = rows + self.right.ncols();
        let bordered = self.bordered(&a);
        let mut unit = DMatrix::zeros(size, self.right.ncols());
        for column in 0..self.right.ncols() {
            unit[(rows + column, column)] = 1.0;
        }
        let mut turned = DMatrix::zeros(size, self.left.ncols());
        for column in 0..self.left.ncols() {
            turned[(columns + column, column)] = 1.0;
        }
        let (Some(x), Some(w)) = (
            bordered.clone().lu().solve(&unit),
            bordered.transpose().lu().solve(&turned),
        ) else {
            return;
        };
        let x = x.rows(0, columns).into_owned();
        let w = w.rows(0, rows).transpose();
        let mut evaluation = Evaluation::default();
        system.evaluate(pose, &mut evaluation);
        let mut add = |row: usize, column: usize, unknown: usize, change: f64| {
            for b in 0..x.ncols() {
                let seen = change * x[(column, b)];
                for a in 0..w.nrows() {
                    into[(b * w.nrows() + a) * n + unknown] -= w[(a, row)] * seen;
                }
            }
        };
        system.visit_changes(&evaluation, &mut add);
        // The values of balls are no linear functions of a step; held ones change their rows.
        let mut z = vec![0.0; n];
        for (index, (held, _)) in self.holds.iter().enumerate() {
            if system.is_scalar(*held) {
                continue;
            }
            let mut at = |unknown: usize, way: f64| {
                z[unknown] = way;
                let mut there = pose.clone();
                system.advance(&mut there, &z);
                z[unknown] = 0.0;
                let mut row = vec![0.0; n];
                system.value_row(&there, *held, &mut row);
                row
            };
            for unknown in 0..n {
                let (ahead, behind) = (at(unknown, DIFFERENCE), at(unknown, -DIFFERENCE));
                for (column, (p, q)) in ahead.iter().zip(&behind).enumerate() {
                    let change = (p - q) / (2.0 * DIFFERENCE);
                    if change != 0.0 {
                        add(system.equations() + index, column, unknown, change);
                    }
                }
            }
        }
    }
}

/// An orthonormal basis of what is orthogonal to orthonormal columns.
fn complement(columns: &DMatrix<f64>) -> DMatrix<f64> {
    let (size, count) = columns.shape();
    let mut basis: Vec<DVector<f64>> = (0..count).map(|c| columns.column(c).into_owned()).collect();
    let mut added = Vec::new();
    // What a unit vector has outside the span, squared: one less the squares of the basis along it.
    let mut outside: Vec<f64> = (0..size)
        .map(|axis| basis.iter().fold(1.0, |left, b| left - b[axis] * b[axis]))
        .collect();
    while basis.len() < size {
        // The unit vector that is farthest from what is spanned already.
        let farthest = (0..size).fold(0, |best, axis| match outside[axis] > outside[best] {
            true => axis,
            false => best,
        });
        let mut vector = DVector::zeros(size);
        vector[farthest] = 1.0;
        for _ in 0..2 {
            for b in &basis {
                let along = b.dot(&vector);
                vector.axpy(-along, b, 1.0);
            }
        }
        let length = vector.norm();
        if !(length > 1e-8) {
            break;
        }
        let unit = vector / length;
        for (left, along) in outside.iter_mut().zip(unit.iter()) {
            *left -= along * along;
        }
        outside[farthest] = f64::NEG_INFINITY;
        basis.push(unit.clone());
        added.push(unit);
    }
    DMatrix::from_fn(size, added.len(), |i, j| added[j][i])
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::samples::system;

    fn shaky() -> (std::sync::Arc<LoopSystem>, SystemPose) {
        let text = include_str!("../../../tests/zoo/permanently_shaky_fourbar.urdf");
        let mechanism = kutzbach_format::read(text, "shaky", &[]).unwrap().mechanism;
        system(&mechanism)
    }

    #[test]
    fn the_bordered_matrix_vanishes_where_the_rank_is_what_it_was() {
        let (system, pose) = shaky();
        let deflation = Deflation::new(&system, &pose, &[], 1).unwrap();
        assert!(deflation.equations() > 0);
        let mut right = Vec::new();
        deflation.residual(&system, &pose, &mut right);
        assert_eq!(right.len(), deflation.equations());
        assert!(right.iter().all(|g| g.abs() < 1e-13), "{right:?}");
    }

    #[test]
    fn rows_are_the_derivative_of_the_bordered_matrix() {
        let mechanism = kutzbach_closure::samples::sarrus();
        for (system, home) in [shaky(), system(&mechanism)] {
            let n = system.unknowns();
            let deflation = Deflation::new(&system, &home, &[], 1).unwrap();
            let mut pose = home.clone();
            let off: Vec<f64> = (0..n).map(|i| 0.03 * (i as f64 + 1.0).sin()).collect();
            system.advance(&mut pose, &off);
            let count = deflation.equations();
            let mut rows = vec![0.0; count * n];
            deflation.rows(&system, &pose, &mut rows);
            for unknown in 0..n {
                let at = |way: f64| {
                    let mut z = vec![0.0; n];
                    z[unknown] = way;
                    let mut there = pose.clone();
                    system.advance(&mut there, &z);
                    let mut right = Vec::new();
                    deflation.residual(&system, &there, &mut right);
                    right
                };
                let (ahead, behind) = (at(1e-5), at(-1e-5));
                for equation in 0..count {
                    // `residual` is −G.
                    let quotient = (behind[equation] - ahead[equation]) / 2e-5;
                    let row = rows[equation * n + unknown];
                    assert!((quotient - row).abs() < 1e-7, "{quotient} {row}");
                }
            }
        }
    }

    #[test]
    fn a_complement_is_orthonormal() {
        let columns = DMatrix::from_columns(&[DVector::from_vec(vec![0.6, 0.0, 0.8])]);
        let rest = complement(&columns);
        assert_eq!(rest.shape(), (3, 2));
        let gram = rest.transpose() * &rest - DMatrix::identity(2, 2);
        assert!(gram.norm() < 1e-14 && (columns.transpose() * rest).norm() < 1e-14);
        let mut random = kutzbach_math::matrix::SplitMix64::new(5);
        for (size, count) in [(7, 3), (30, 27), (12, 0), (9, 9)] {
            let full = DMatrix::from_fn(size, size, |_, _| random.symmetric());
            let all = full.qr().q();
            let columns = all.columns(0, count).into_owned();
            let rest = complement(&columns);
            assert_eq!(rest.shape(), (size, size - count));
            let gram = rest.transpose() * &rest - DMatrix::identity(size - count, size - count);
            assert!(gram.norm() < 1e-13, "{size} {count}");
            assert!(
                (columns.transpose() * rest).norm() < 1e-13,
                "{size} {count}"
            );
        }
    }
}
