//! Systems of quadratic forms whose common zeros are linear spaces.
//!
//! Where modes of motion exclude one another, the lowest terms that the equations leave over are products of coordinates, but in a
//! basis that nobody knows: x y, x z of a line and a plane. Their zeros are linear spaces, each the kernel of the forms' derivatives at
//! any general point of it, which Newton's method finds. That none is missing, and none counted more than once, is then *proved*, up
//! to margins, in one of two ways: [`coordinates`] and [`regularity`].

mod coordinates;
mod regularity;

use kutzbach_math::matrix::SplitMix64;
use nalgebra::{DMatrix, DVector};

/// What is below the first, relative to unit vectors and forms, is zero, what is above the second is not. Zeros are found to
/// some 1e-13, and spaces at smaller angles than the second are not told apart.
const ZERO: f64 = 1e-9;
const CLEAR: f64 = 1e-3;

/// Unit forms whose singular values exceed this are independent.
const INDEPENDENT: f64 = 1e-4;

/// Most variables, and most spaces.
const MOST_VARIABLES: usize = 16;
const MOST_SPACES: usize = 64;

/// Starts of Newton's method, and steps of each.
const STARTS: usize = 1000;
const STEPS: usize = 60;

/// A linear space by an orthonormal basis, in columns.
pub type Space = DMatrix<f64>;

/// The linear spaces whose union is the common zeros of some quadratic forms, simply but for the origin; the forms are given as
/// symmetric matrices, each clear of its noise. `None` where the zeros are not linear spaces, or that is not proved.
#[must_use]
pub fn linear_arrangement(forms: &[DMatrix<f64>]) -> Option<Vec<Space>> {
    let size = forms.first()?.nrows();
    if !(2..=MOST_VARIABLES).contains(&size) {
        return None;
    }
    let forms = independent(forms)?;
    let mut random = SplitMix64::named("arrangement");
    let mut spaces: Vec<Space> = Vec::new();
    for index in 0..STARTS {
        // Many forms together have minima beside their zeros, a few random combinations of them hardly any.
        let few = mixed(&forms, 1 + index % (size - 1), &mut random);
        let start = DVector::from_fn(size, |_, _| random.symmetric());
        let Some(point) = zero_near(&few, start).and_then(|near| zero_near(&forms, near)) else {
            continue;
        };
        let Some(space) = kernel(&derivative(&forms, &point)) else {
            // A point of two spaces, or one where zeros are multiple.
            continue;
        };
        let left = largest_on(&forms, &space);
        if left > CLEAR {
            return None;
        }
        if left > ZERO {
            // The point lies close to where spaces meet, and is not known well enough.
            continue;
        }
        if known(&spaces, &space)? {
            continue;
        }
        spaces.push(space);
        if spaces.len() > MOST_SPACES {
            return None;
        }
        if coordinates::are_all(&forms, &spaces) || regularity::are_all(&forms, &spaces) {
            return Some(spaces);
        }
    }
    None
}

/// An orthonormal basis, in the Frobenius product, of the space that the forms span; `None` where some are neither dependent nor
/// clearly independent.
fn independent(forms: &[DMatrix<f64>]) -> Option<Vec<DMatrix<f64>>> {
    let rows: Vec<_> = forms
        .iter()
        .map(|form| {
            DVector::from_column_slice(form.as_slice())
                .normalize()
                .transpose()
        })
        .collect();
    let (size, svd) = (
        forms.first()?.nrows(),
        DMatrix::from_rows(&rows).svd(false, true),
    );
    let vectors = svd.v_t?;
    let mut basis = Vec::new();
    for (index, value) in svd.singular_values.iter().enumerate() {
        if *value > INDEPENDENT {
            let vector: Vec<f64> = vectors.row(index).iter().copied().collect();
            basis.push(DMatrix::from_column_slice(size, size, &vector));
        } else if *value > ZERO {
            return None;
        }
    }
    Some(basis)
}

/// Random combinations of forms, as many as are wanted.
fn mixed(forms: &[DMatrix<f64>], count: usize, random: &mut SplitMix64) -> Vec<DMatrix<f64>> {
    let zero = || DMatrix::zeros(forms[0].nrows(), forms[0].ncols());
    let mut one = || {
        forms
            .iter()
            .fold(zero(), |sum, form| sum + form * random.symmetric())
    };
    (0..count).map(|_| one()).collect()
}

/// Half the derivatives of the forms at a point, a row for each.
fn derivative(forms: &[DMatrix<f64>], point: &DVector<f64>) -> DMatrix<f64> {
    let mut rows = DMatrix::zeros(forms.len(), point.len());
    for (index, form) in forms.iter().enumerate() {
        rows.set_row(index, &(form * point).transpose());
    }
    rows
}

/// A common zero on the unit sphere, by the Levenberg–Marquardt method.
fn zero_near(forms: &[DMatrix<f64>], start: DVector<f64>) -> Option<DVector<f64>> {
    let mut point = start.normalize();
    let mut damping = 0.1;
    let values = |rows: &DMatrix<f64>, point: &DVector<f64>| rows * point;
    let mut rows = derivative(forms, &point);
    let mut size = values(&rows, &point).norm();
    for _ in 0..STEPS {
        if size < 1e-15 {
            break;
        }
        let normal = rows.transpose() * &rows * 4.0
            + DMatrix::identity(point.len(), point.len()) * (damping * size);
        let step = normal
            .cholesky()?
            .solve(&(rows.transpose() * values(&rows, &point) * 2.0));
        let there = (&point - step).normalize();
        let rows_there = derivative(forms, &there);
        let size_there = values(&rows_there, &there).norm();
        if size_there < size {
            (point, rows, size) = (there, rows_there, size_there);
            damping *= 0.2;
        } else {
            damping *= 5.0;
        }
    }
    (size < 1e-12).then_some(point)
}

/// The kernel of a matrix of rows; `None` where its rank is in doubt, or zero is all there is.
fn kernel(rows: &DMatrix<f64>) -> Option<Space> {
    let (vectors, values) = spectrum(&(rows.transpose() * rows));
    let of = |i: usize| values[i].max(0.0).sqrt();
    // Squares of singular values are known to rounding only.
    let in_kernel = (0..values.len()).filter(|&i| of(i) < ZERO.sqrt()).count();
    let clear = (0..values.len()).filter(|&i| of(i) > CLEAR).count();
    (in_kernel + clear == values.len() && in_kernel > 0)
        .then(|| vectors.columns(0, in_kernel).into_owned())
}

/// Eigenvectors and eigenvalues of a symmetric matrix, the least first.
fn spectrum(matrix: &DMatrix<f64>) -> (DMatrix<f64>, Vec<f64>) {
    let eigen = matrix.clone().symmetric_eigen();
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let columns: Vec<DVector<f64>> = order
        .iter()
        .map(|&i| eigen.eigenvectors.column(i).into_owned())
        .collect();
    let values = order.iter().map(|&i| eigen.eigenvalues[i]).collect();
    (DMatrix::from_columns(&columns), values)
}

/// How far the forms are from vanishing on a space.
fn largest_on(forms: &[DMatrix<f64>], space: &Space) -> f64 {
    forms
        .iter()
        .map(|form| (space.transpose() * form * space).norm())
        .fold(0.0, f64::max)
}

/// Whether one space is another, where that is clear.
fn known(spaces: &[Space], space: &Space) -> Option<bool> {
    for other in spaces {
        let apart = (projector(space) - projector(other)).norm();
        if apart < ZERO.sqrt() {
            return Some(true);
        }
        if apart < CLEAR {
            return None;
        }
    }
    Some(false)
}

fn projector(space: &Space) -> DMatrix<f64> {
    space * space.transpose()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// The products x_a x_b in coordinates turned and sheared at random, mixed with one another.
    fn hidden(size: usize, products: &[(usize, usize)], seed: u64) -> Vec<DMatrix<f64>> {
        let mut random = SplitMix64::new(seed);
        let skew = DMatrix::from_fn(size, size, |i, j| {
            f64::from(i == j) + 0.4 * random.symmetric()
        });
        let plain: Vec<DMatrix<f64>> = products
            .iter()
            .map(|&(a, b)| {
                let mut form = DMatrix::zeros(size, size);
                form[(a, b)] = 1.0;
                form[(b, a)] = 1.0;
                skew.transpose() * form * &skew
            })
            .collect();
        (0..products.len())
            .map(|_| {
                plain
                    .iter()
                    .fold(DMatrix::zeros(size, size), |sum: DMatrix<f64>, form| {
                        sum + form * random.symmetric()
                    })
            })
            .collect()
    }

    fn dimensions(size: usize, products: &[(usize, usize)]) -> Option<Vec<usize>> {
        let spaces = linear_arrangement(&hidden(size, products, 7))?;
        let mut dimensions: Vec<usize> = spaces.iter().map(Space::ncols).collect();
        dimensions.sort_unstable();
        Some(dimensions)
    }

    #[test]
    fn all_spaces_are_found() {
        let star: Vec<(usize, usize)> = (1..8).map(|i| (0, i)).collect();
        assert_eq!(dimensions(8, &star).unwrap(), [1, 7]);
        for n in 3..6 {
            let axes: Vec<(usize, usize)> =
                (0..n).flat_map(|a| (0..a).map(move |b| (a, b))).collect();
            assert_eq!(dimensions(n, &axes).unwrap(), vec![1; n]);
        }
        // A path: planes that share lines.
        assert_eq!(dimensions(4, &[(0, 1), (1, 2), (2, 3)]).unwrap(), [2; 3]);
        assert_eq!(dimensions(2, &[(0, 1)]).unwrap(), [1, 1]);
    }

    #[test]
    fn what_is_no_arrangement_is_none() {
        let cone = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 1.0, -1.0]));
        assert!(linear_arrangement(&[cone]).is_none());
        let square = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 0.0]));
        assert!(linear_arrangement(&[square]).is_none());
        let definite = DMatrix::identity(3, 3);
        assert!(linear_arrangement(&[definite]).is_none());
    }

    #[test]
    fn lines_without_a_common_basis_are_counted_by_regularity() {
        // x² = y² = z²: four lines in space.
        let of = |squares: [f64; 3]| DMatrix::from_diagonal(&DVector::from_vec(squares.to_vec()));
        let forms = [of([1.0, -1.0, 0.0]), of([0.0, 1.0, -1.0])];
        let lines = linear_arrangement(&forms).unwrap();
        assert_eq!(lines.len(), 4);
        assert!(lines.iter().all(|line| line.ncols() == 1));
        assert!(!coordinates::are_all(&forms, &lines));
        // Three of them are not all, and all four are not those of one form.
        assert!(!regularity::are_all(&forms, &lines[..3]));
        assert!(!regularity::are_all(&forms[..1], &lines));
    }

    #[test]
    fn a_form_too_few_is_seen() {
        // Without x y the plane z = 0 is whole: two products of three.
        let two = dimensions(3, &[(0, 2), (1, 2)]).unwrap();
        assert_eq!(two, [1, 2]);
    }
}
