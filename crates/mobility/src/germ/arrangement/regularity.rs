//! Zeros that are linear spaces in any position, counted by the forms of one degree that vanish on them.
//!
//! The ideal of all forms that vanish on m linear spaces is m-regular (Derksen and Sidman, *A sharp bound for the
//! Castelnuovo–Mumford regularity of subspace arrangements*, 2002); so its forms of degree m generate those of all higher degrees. If the
//! quadratic forms generate all of those of degree m, they have the same zeros, simply, but perhaps for the origin itself.
//!
//! Both sides are bounded from below by ranks: the forms generated, and what evaluation on the spaces leaves of all forms. They never
//! exceed the number of monomials together, so that bounds that reach it are proofs.

use super::Space;
use kutzbach_math::group::Monomials;
use kutzbach_math::matrix::SplitMix64;
use nalgebra::{DMatrix, DVector};

/// Matrices of more monomials are not ranked.
const MOST_MONOMIALS: usize = 500;

/// Singular values above this share of the largest count. Squares of them stand clear of rounding.
const CLEAR: f64 = 1e-5;

/// Whether the spaces, on which the forms vanish, are proved to be all their zeros but for the origin.
pub(super) fn are_all(forms: &[DMatrix<f64>], spaces: &[Space]) -> bool {
    let degree = spaces.len().max(2);
    let Some(size) = spaces.first().map(Space::nrows) else {
        return false;
    };
    let count = (0..degree).fold(1, |count, k| count * (size + k) / (k + 1));
    if count > MOST_MONOMIALS {
        return false;
    }
    let Ok(table) = Monomials::new(size, degree) else {
        return false;
    };
    rank(generated(forms, &table)) + rank(evaluated(spaces, &table)) == count
}

/// The products of the forms with all monomials that lead to the table's degree, a row for each.
fn generated(forms: &[DMatrix<f64>], table: &Monomials) -> Vec<DVector<f64>> {
    let (size, degree) = (table.variables(), table.degree());
    let first = table.of_degree(degree).start;
    let mut rows = Vec::new();
    for factor in table.of_degree(degree - 2) {
        for form in forms {
            let mut row = DVector::zeros(table.of_degree(degree).len());
            for (i, j) in (0..size).flat_map(|i| (0..size).map(move |j| (i, j))) {
                let mut exponents = table.exponents(factor).to_vec();
                exponents[i] += 1;
                exponents[j] += 1;
                if let Some(index) = table.index_of(&exponents) {
                    row[index - first] += form[(i, j)] / weight(&exponents);
                }
            }
            rows.push(row);
        }
    }
    rows
}

/// All monomials of the table's degree at points of the spaces, as many in each as its forms have coefficients.
fn evaluated(spaces: &[Space], table: &Monomials) -> Vec<DVector<f64>> {
    let mut random = SplitMix64::named("regularity");
    let mut rows = Vec::new();
    for space in spaces {
        let points = (0..table.degree()).fold(1, |count, k| count * (space.ncols() + k) / (k + 1));
        for _ in 0..2 * points {
            let weights = DVector::from_fn(space.ncols(), |_, _| random.symmetric());
            let point = (space * weights).normalize();
            let values = table.of_degree(table.degree()).map(|index| {
                let exponents = table.exponents(index);
                let powers = exponents.iter().zip(point.iter());
                let value: f64 = powers.map(|(e, x)| x.powi(i32::from(*e))).product();
                value * weight(exponents)
            });
            rows.push(DVector::from_iterator(
                table.of_degree(table.degree()).len(),
                values,
            ));
        }
    }
    rows
}

/// The root of a multinomial coefficient: so weighted, monomials are as large as the powers of linear forms that they come from.
fn weight(exponents: &[u8]) -> f64 {
    let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
    let total: u32 = exponents.iter().map(|e| u32::from(*e)).sum();
    let each: f64 = exponents.iter().map(|e| factorial(u32::from(*e))).product();
    (factorial(total) / each).sqrt()
}

/// At least so many rows are independent.
fn rank(rows: Vec<DVector<f64>>) -> usize {
    let Some(size) = rows.first().map(DVector::len) else {
        return 0;
    };
    let matrix = DMatrix::from_fn(size, rows.len(), |i, j| rows[j][i]);
    let values = (&matrix * matrix.transpose()).symmetric_eigenvalues();
    let least = CLEAR * CLEAR * values.max();
    values.iter().filter(|value| **value > least).count()
}
