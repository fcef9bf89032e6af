//! How much numbers have to change for a part that holds fast as written to give way, if only to first order.
//!
//! Where the equations as written leave no velocity, and their digits are too coarse for the bound of a whole matrix to say so, each
//! number is asked by itself. With `E` the derivative of the equations' matrix `J` by one number, in units of what its digits leave open,
//! along which the pose follows so that the loops stay as closed as they are, a velocity `v` satisfies the changed equations if
//!
//! ```text
//! J v + Σ zᵢ Eᵢ v = 0
//! ```
//!
//! For a given `v` the least largest `|zᵢ|` is a linear problem (`least_largest.rs`), and for given `z` the velocity nearest to one is the
//! last singular vector of `J + Σ zᵢ Eᵢ`. Both in turn lead from each of the directions that give way most to the least change nearby.
//! What is more than a few units away to first order is not within the digits.

use super::dimensions::{Dimensions, turns};
use super::drowned::drowned;
use super::least_largest::least_largest;
use super::poses::Loops;
use faer::Mat;
use kutzbach_closure::{Geometry, JointState, linearised};
use kutzbach_math::matrix::MatrixError;

/// Rounds of both in turn.
const ROUNDS: usize = 8;

/// Rounds that gain less than this share are the last.
const GAIN: f64 = 1e-2;

/// More numbers, or variables, than these are not asked.
const MOST_NUMBERS: usize = 300;
const MOST_VARIABLES: usize = 60;

/// Difference quotients are taken over this (rad, part lengths): what they leave out, and rounding, are both below 1e-7 of the derivative.
const QUOTIENT: f64 = 1e-5;

/// A part whose smallest singular value is below this share of the largest has a velocity as written, or nearly.
const NO_VELOCITY: f64 = 1e-9;

/// The equations of a part in the metric of its home pose.
struct Here {
    matrix: Mat<f64>,
    residual: Vec<f64>,
}

impl Loops<'_> {
    fn here(
        &self,
        geometry: &Geometry<f64>,
        states: &[JointState<f64>],
    ) -> Result<Here, MatrixError> {
        let here = linearised(geometry, states, self.part)?;
        let mut matrix = Mat::<f64>::zeros(here.matrix.rows(), here.matrix.columns());
        for (row, column, entry) in here.matrix.triplets() {
            let unit = here.unit(self.mechanism, column);
            matrix[(row, column)] += entry / (unit * self.metric.weights[column]);
        }
        Ok(Here {
            matrix,
            residual: here.residual,
        })
    }
}

/// What some number has to change by at least, in units of what its digits leave open and to first order, for a part to have a velocity
/// at its pose; `None` where that is not computed, or where the part has one as written. `directions` of those that give way most are
/// tried.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn least_change_to_give_way(
    loops: &Loops<'_>,
    dimensions: &Dimensions<'_>,
    (geometry, states): (&Geometry<f64>, &[JointState<f64>]),
    length: f64,
    directions: usize,
) -> Result<Option<f64>, MatrixError> {
    let here = loops.here(geometry, states)?;
    let (rows, columns) = (here.matrix.nrows(), here.matrix.ncols());
    if rows < columns || columns > MOST_VARIABLES || dimensions.all.len() > MOST_NUMBERS {
        return Ok(None);
    }
    let Some(changes) = changes(loops, dimensions, (geometry, states), length, &here)? else {
        return Ok(None);
    };
    let Ok(svd) = here.matrix.thin_svd() else {
        return Ok(None);
    };
    let last = |v: faer::MatRef<'_, f64>, j: usize| (0..columns).map(|i| v[(i, j)]).collect();
    let mut least = f64::INFINITY;
    for direction in 0..directions.clamp(1, columns) {
        let mut velocity: Vec<f64> = last(svd.V(), columns - 1 - direction);
        let mut before = f64::INFINITY;
        for _ in 0..ROUNDS {
            let each = changes.iter().map(|change| product(change, &velocity));
            let each: Vec<Vec<f64>> = each.collect();
            let a = Mat::from_fn(rows, each.len(), |i, j| each[j][i]);
            let b: Vec<f64> = product(&here.matrix, &velocity)
                .iter()
                .map(|x| -x)
                .collect();
            let Some(found) = least_largest(&a, &b, drowned) else {
                return Ok(None);
            };
            least = least.min(found.at_least);
            if found.at_least > (1.0 - GAIN) * before {
                break;
            }
            before = found.at_least;
            let mut changed = here.matrix.clone();
            for (change, z) in changes.iter().zip(&found.z) {
                changed += change * faer::Scale(*z);
            }
            let Ok(svd) = changed.thin_svd() else {
                return Ok(None);
            };
            velocity = last(svd.V(), columns - 1);
        }
    }
    Ok(least.is_finite().then_some(least))
}

/// The derivatives of the matrix by each number, per unit, the pose following; `None` where the pose as written leaves a velocity.
fn changes(
    loops: &Loops<'_>,
    dimensions: &Dimensions<'_>,
    (geometry, states): (&Geometry<f64>, &[JointState<f64>]),
    length: f64,
    here: &Here,
) -> Result<Option<Vec<Mat<f64>>>, MatrixError> {
    let columns = here.matrix.ncols();
    let Ok(svd) = here.matrix.thin_svd() else {
        return Ok(None);
    };
    let (u, s, v) = (svd.U(), svd.S().column_vector(), svd.V());
    let count = s.nrows();
    if count == 0 || !(s[count - 1] > NO_VELOCITY * s[0]) {
        return Ok(None);
    }
    let along: Vec<Mat<f64>> = (0..columns)
        .map(|column| {
            let at = |sign: f64| -> Result<Mat<f64>, MatrixError> {
                let mut moved = states.to_vec();
                let mut step = vec![0.0; columns];
                step[column] = sign * QUOTIENT;
                loops.advance(geometry, &mut moved, &step);
                Ok(loops.here(geometry, &moved)?.matrix)
            };
            Ok((at(1.0)? - at(-1.0)?) * faer::Scale(0.5 / QUOTIENT))
        })
        .collect::<Result<_, MatrixError>>()?;
    let mut geometry = geometry.clone();
    let mut states = states.to_vec();
    let mut all = Vec::new();
    for dimension in &dimensions.all {
        let joint = dimension.joint;
        let step = match turns(dimension.place) {
            true => QUOTIENT,
            false => QUOTIENT * length,
        };
        let kept = (
            states[joint].clone(),
            geometry.displacements[joint].clone(),
            geometry.sides[joint].clone(),
        );
        let mut at = |sign: f64| {
            let mut numbers = dimensions.numbers(joint, &[]);
            numbers.0[dimension.place] += sign * step;
            dimensions.set(&mut geometry, joint, &numbers, [&mut states[joint]]);
            let there = loops.here(&geometry, &states);
            states[joint] = kept.0.clone();
            geometry.displacements[joint] = kept.1.clone();
            geometry.sides[joint] = kept.2.clone();
            there
        };
        let (more, less) = (at(1.0)?, at(-1.0)?);
        let per_unit = 0.5 * dimension.unit / step;
        let mut change = (more.matrix - less.matrix) * faer::Scale(per_unit);
        let slope: Vec<f64> = more
            .residual
            .iter()
            .zip(&less.residual)
            .map(|(more, less)| (more - less) * per_unit)
            .collect();
        for j in 0..s.nrows() {
            let share: f64 = (0..slope.len()).map(|i| u[(i, j)] * slope[i]).sum::<f64>() / s[j];
            for (column, along) in along.iter().enumerate() {
                change -= along * faer::Scale(share * v[(column, j)]);
            }
        }
        all.push(change);
    }
    Ok(Some(all))
}

fn product(matrix: &Mat<f64>, vector: &[f64]) -> Vec<f64> {
    let row = |i| (0..vector.len()).map(|j| matrix[(i, j)] * vector[j]).sum();
    (0..matrix.nrows()).map(row).collect()
}
