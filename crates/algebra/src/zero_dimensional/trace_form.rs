//! Hermite's quadratic form: the trace of multiplication by the product of two elements.
//!
//! Its rank is the number of distinct complex zeros, its signature the number of distinct real ones (Hermite 1853; Pedersen,
//! Roy and Szpirglas 1993; Basu, Pollack and Roy, "Algorithms in Real Algebraic Geometry", section 4.6).

use super::quotient::{Products, Quotient, Scaled, words};
use crate::engine::{Budget, Stop};
use crate::polynomial::Rational;
use crate::univariate::{fraction, integer_gcd};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// What the trace form says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TraceForm {
    /// Its rank: distinct complex zeros.
    pub rank: usize,
    /// Its signature: distinct real zeros.
    pub signature: usize,
}

/// The traces of multiplication by the standard monomials.
pub(super) fn traces(quotient: &Quotient, products: &Products) -> Scaled {
    let traces: Vec<Rational> = quotient
        .monomials
        .iter()
        .map(|a| {
            let diagonal = quotient.monomials.iter().enumerate().map(|(i, b)| {
                let product = products.of(a, b);
                (&product.values[i], &product.denominator)
            });
            sum(diagonal)
        })
        .collect();
    Scaled::of(&traces)
}

/// The sum of fractions.
fn sum<'a>(parts: impl Iterator<Item = (&'a BigInt, &'a BigInt)>) -> Rational {
    let (mut numerator, mut denominator) = (BigInt::zero(), BigInt::one());
    for (n, d) in parts.filter(|(n, _)| !n.is_zero()) {
        if !(&denominator % d).is_zero() {
            let factor = d / integer_gcd(&denominator, d);
            numerator *= &factor;
            denominator *= factor;
        }
        numerator += n * (&denominator / d);
    }
    fraction(numerator, &denominator)
}

/// The matrix of the trace form, times a positive integer.
pub(super) fn trace_matrix(
    quotient: &Quotient,
    products: &Products,
    traces: &Scaled,
) -> Vec<Vec<BigInt>> {
    let monomials = &quotient.monomials;
    let entries: Vec<Rational> = monomials
        .iter()
        .flat_map(|a| monomials.iter().map(|b| traces.dot(products.of(a, b))))
        .collect();
    Scaled::of(&entries)
        .values
        .chunks(monomials.len().max(1))
        .map(<[BigInt]>::to_vec)
        .collect()
}

/// Rank and signature of a symmetric matrix of integers, by elimination without fractions (Bareiss 1968).
///
/// After k steps an entry is a minor of order k + 1; the sign of a diagonal entry of the eliminated form is that of the
/// quotient of two pivots that follow one another.
pub(super) fn rank_and_signature(
    mut matrix: Vec<Vec<BigInt>>,
    budget: &Budget,
) -> Result<TraceForm, Stop> {
    let n = matrix.len();
    let mut last = BigInt::one();
    let (mut rank, mut signature) = (0, 0_isize);
    for step in 0..n {
        if !bring_pivot(&mut matrix, step) {
            break;
        }
        let pivot = matrix[step][step].clone();
        let size = words(&pivot);
        budget.multiply((n - step).pow(2) as u64 * size * size)?;
        for i in step + 1..n {
            for j in i..n {
                let value = (&pivot * &matrix[i][j] - &matrix[i][step] * &matrix[step][j]) / &last;
                matrix[i][j] = value.clone();
                matrix[j][i] = value;
            }
        }
        rank += 1;
        signature += if pivot.is_positive() == last.is_positive() {
            1
        } else {
            -1
        };
        last = pivot;
    }
    Ok(TraceForm {
        rank,
        signature: usize::try_from(signature).unwrap_or(0),
    })
}

/// Makes the diagonal entry at `step` nonzero by a change of basis; `false` where all that is left is zero.
fn bring_pivot(matrix: &mut [Vec<BigInt>], step: usize) -> bool {
    let n = matrix.len();
    if let Some(place) = (step..n).find(|&i| !matrix[i][i].is_zero()) {
        matrix.swap(step, place);
        for row in matrix.iter_mut() {
            row.swap(step, place);
        }
        return true;
    }
    let Some((i, j)) = (step..n)
        .flat_map(|i| (i + 1..n).map(move |j| (i, j)))
        .find(|&(i, j)| !matrix[i][j].is_zero())
    else {
        return false;
    };
    // With zeros on the diagonal, adding the j-th vector to the i-th gives twice the entry.
    let added = matrix[j].clone();
    for (entry, value) in matrix[i].iter_mut().zip(&added) {
        *entry += value;
    }
    for row in matrix.iter_mut() {
        let value = row[j].clone();
        row[i] += value;
    }
    bring_pivot(matrix, step)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn signatures_of_small_forms() {
        let form = |rows: &[&[i64]]| {
            let matrix = rows
                .iter()
                .map(|row| row.iter().map(|&v| v.into()).collect())
                .collect();
            let form = rank_and_signature(matrix, &Budget::unlimited()).unwrap();
            (form.rank, form.signature)
        };
        assert_eq!(form(&[&[0, 1], &[1, 0]]), (2, 0));
        assert_eq!(form(&[&[0, 0, 0], &[0, 2, 2], &[0, 2, 2]]), (1, 1));
        assert_eq!(form(&[&[2, 1, 0], &[1, 2, 1], &[0, 1, 2]]), (3, 3));
        assert_eq!(form(&[&[0, 1, 1], &[1, 0, 0], &[1, 0, 5]]), (3, 1));
    }
}
