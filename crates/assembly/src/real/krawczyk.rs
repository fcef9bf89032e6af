//! Krawczyk's operator: whether a box holds one solution, none, or may be made smaller.
//!
//! For a square system f with slopes in the interval matrix J over a box X with middle m, and any matrix C,
//! K = m − C f(m) + (I − C J)(X − m) holds every solution that X does. If K lies in the interior of X there is exactly one
//! (Krawczyk 1969; Moore 1977). Boxes are unit cubes of their own coordinates here.

use super::interval::Interval;
use super::tensor::Tensor;

/// What the operator says of a unit cube.
pub(super) struct Image {
    /// K.
    pub(super) image: Vec<Interval>,
    /// The equations that were used, as many as there are variables.
    pub(super) used: Vec<usize>,
}

/// Applies the operator on the unit cube; among more equations than variables those are taken that are most independent in
/// the middle, by elimination with complete pivoting. `None` where they are dependent there.
pub(super) fn image(tensors: &[Tensor], count: usize) -> Option<Image> {
    let slopes: Vec<Vec<Interval>> = tensors
        .iter()
        .map(|t| {
            (0..count)
                .map(|v| t.slope(v))
                .map(|(a, b)| Interval::new(a, b))
                .collect()
        })
        .collect();
    let middle: Vec<Vec<f64>> = slopes
        .iter()
        .map(|row| row.iter().map(|s| s.middle()).collect())
        .collect();
    let used = most_independent(&middle, count)?;
    let square: Vec<Vec<f64>> = used.iter().map(|&r| middle[r].clone()).collect();
    let inverse = inverted(square)?;
    let values: Vec<Interval> = used
        .iter()
        .map(|&r| {
            let (value, radius) = tensors[r].middle();
            Interval::about(value, radius)
        })
        .collect();
    let half = Interval::new(-0.5, 0.5);
    let zero = Interval::point(0.0);
    let image = inverse
        .iter()
        .enumerate()
        .map(|(i, row)| {
            let step = row
                .iter()
                .zip(&values)
                .fold(zero, |sum, (&c, f)| sum.plus(Interval::point(c).times(*f)));
            let mut k = Interval::point(0.5).minus(step);
            for (j, unit) in (0..count).map(|j| (j, f64::from(u8::from(i == j)))) {
                let product = row.iter().zip(&used).fold(zero, |sum, (&c, &r)| {
                    sum.plus(Interval::point(c).times(slopes[r][j]))
                });
                k = k.plus(Interval::point(unit).minus(product).times(half));
            }
            k
        })
        .collect();
    Some(Image { image, used })
}

/// Rows that are most independent, as many as columns.
fn most_independent(matrix: &[Vec<f64>], count: usize) -> Option<Vec<usize>> {
    if matrix.len() < count {
        return None;
    }
    let mut rows: Vec<Vec<f64>> = matrix.to_vec();
    // Equations have units of their own.
    for row in &mut rows {
        let size = row.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        if size > 0.0 {
            row.iter_mut().for_each(|x| *x /= size);
        }
    }
    let mut used = Vec::new();
    for _ in 0..count {
        let mut best = (0.0, 0, 0);
        for (r, row) in rows.iter().enumerate().filter(|(r, _)| !used.contains(r)) {
            for (c, x) in row.iter().enumerate() {
                if x.abs() > best.0 {
                    best = (x.abs(), r, c);
                }
            }
        }
        let (size, pivot, column) = best;
        // What rounding alone may leave of rows of size one.
        if size < 1e-13 {
            return None;
        }
        used.push(pivot);
        let lead = rows[pivot].clone();
        for (r, row) in rows.iter_mut().enumerate() {
            if !used.contains(&r) {
                let factor = row[column] / lead[column];
                row.iter_mut()
                    .zip(&lead)
                    .for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    used.sort_unstable();
    Some(used)
}

/// The inverse by elimination with partial pivoting; its quality is no matter of proof.
pub(super) fn inverted(mut rows: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let n = rows.len();
    for (i, row) in rows.iter_mut().enumerate() {
        row.extend((0..n).map(|j| f64::from(u8::from(i == j))));
    }
    for column in 0..n {
        let pivot =
            (column..n).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))?;
        rows.swap(column, pivot);
        let lead = rows[column][column];
        if !(lead.abs() > 0.0) || !lead.is_finite() {
            return None;
        }
        rows[column].iter_mut().for_each(|x| *x /= lead);
        let own = rows[column].clone();
        for (r, row) in rows.iter_mut().enumerate() {
            if r != column {
                let factor = row[column];
                row.iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    let inverse: Vec<Vec<f64>> = rows.into_iter().map(|row| row[n..].to_vec()).collect();
    inverse
        .iter()
        .flatten()
        .all(|x| x.is_finite())
        .then_some(inverse)
}
