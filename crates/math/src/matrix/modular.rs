//! Rank over a prime field: exact, fast, and right for generic geometry.
//!
//! A matrix of polynomials evaluated at random elements of a large field has, with probability at
//! least 1 − degree/p, the rank it has at a generic point (Schwartz 1980; Zippel 1979), and never a
//! larger one. With p = 2⁶¹ − 1 and degrees of some ten thousands the chance of a wrong answer is
//! below 10⁻¹³. There is no rounding, no tolerance, and no gap to judge.
//!
//! Elimination follows the same plan of fronts as the real one, so it is linear for chains.

use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_int::IBig;

use super::multifrontal::{Dense, Kernel, Triangle, eliminate, prepare};
use super::random::SplitMix64;
use super::real::Ring;
use super::sparse::SparseMatrix;

/// An integer modulo the Mersenne prime 2⁶¹ − 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Field61(u64);

impl Field61 {
    /// The prime 2⁶¹ − 1.
    pub const PRIME: u64 = (1 << 61) - 1;
    /// Zero.
    pub const ZERO: Self = Self(0);
    /// One.
    pub const ONE: Self = Self(1);

    /// The residue of an integer.
    #[must_use]
    pub fn new(value: i128) -> Self {
        // The remainder lies in 0..PRIME, so it fits.
        Self(value.rem_euclid(i128::from(Self::PRIME)) as u64)
    }

    /// The residue of an integer of any size.
    #[must_use]
    pub fn from_integer(value: &IBig) -> Self {
        // The remainder is smaller than the prime in magnitude, so the conversion cannot fail.
        i128::try_from(value % IBig::from(Self::PRIME)).map_or(Self::ZERO, Self::new)
    }

    /// The residue of numerator / denominator; `None` if the prime divides the denominator.
    #[must_use]
    pub fn from_fraction(numerator: i128, denominator: i128) -> Option<Self> {
        Self::new(denominator)
            .inverse()
            .map(|inverse| Self::new(numerator) * inverse)
    }

    /// A uniformly distributed element.
    pub fn random(random: &mut SplitMix64) -> Self {
        loop {
            // 61 bits; only the value 2⁶¹ − 1 itself is not a residue.
            let bits = random.next_u64() >> 3;
            if bits < Self::PRIME {
                return Self(bits);
            }
        }
    }

    /// The representative in 0..PRIME.
    #[must_use]
    pub fn value(self) -> u64 {
        self.0
    }

    /// `self` to the given power; 0⁰ is 1.
    #[must_use]
    pub fn power(self, mut exponent: u64) -> Self {
        let (mut base, mut result) = (self, Self::ONE);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result * base;
            }
            base = base * base;
            exponent >>= 1;
        }
        result
    }

    /// The multiplicative inverse; `None` for zero.
    #[must_use]
    pub fn inverse(self) -> Option<Self> {
        // Fermat: a^(p−1) = 1.
        (self.0 != 0).then(|| self.power(Self::PRIME - 2))
    }

    /// A square root, if there is one.
    #[must_use]
    pub fn square_root(self) -> Option<Self> {
        // p ≡ 3 (mod 4), so a^((p+1)/4) is a root of every square.
        let root = self.power((Self::PRIME + 1) / 4);
        (root * root == self).then_some(root)
    }
}

impl Add for Field61 {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        Self(if sum >= Self::PRIME {
            sum - Self::PRIME
        } else {
            sum
        })
    }
}

impl Sub for Field61 {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Field61 {
    type Output = Self;
    fn neg(self) -> Self {
        Self(if self.0 == 0 { 0 } else { Self::PRIME - self.0 })
    }
}

impl Mul for Field61 {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = u128::from(self.0) * u128::from(other.0);
        // 2⁶¹ ≡ 1: add the upper 61 bits to the lower 61.
        let low = product as u64 & Self::PRIME;
        let high = (product >> 61) as u64;
        Self(low) + Self(high)
    }
}

impl Div for Field61 {
    type Output = Self;
    /// The quotient. Division by zero, which no elimination does, gives zero.
    // Division in a field is multiplication by the inverse.
    #[allow(clippy::suspicious_arithmetic_impl)]
    fn div(self, other: Self) -> Self {
        match other.inverse() {
            Some(inverse) => self * inverse,
            None => Self::ZERO,
        }
    }
}

impl Ring for Field61 {
    fn zero_like(&self) -> Self {
        Self::ZERO
    }

    fn one_like(&self) -> Self {
        Self::ONE
    }

    fn is_zero(&self) -> bool {
        self.0 == 0
    }
}

/// The triangular form of a matrix over the prime field.
#[derive(Clone, Debug)]
pub struct ModularFactorization {
    triangle: Triangle<Field61>,
}

impl ModularFactorization {
    /// The rank over the field: a lower bound of the generic rank, and equal to it but for the
    /// probability stated above.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.triangle.rank()
    }

    /// The columns that depend on the others: free unknowns of A x = 0.
    #[must_use]
    pub fn dropped_columns(&self) -> &[usize] {
        self.triangle.dropped()
    }

    /// `count` null vectors with random values on the dropped columns.
    #[must_use]
    pub fn random_null_vectors(&self, count: usize, seed: u64) -> Vec<Vec<Field61>> {
        self.triangle
            .random_null_vectors(count, seed, Field61::random)
    }

    /// Columns that are zero in all null vectors, increasing: the generic coloops.
    ///
    /// One random null vector is enough: another column is taken for a coloop with probability
    /// 1/p. The same seed gives the same vector.
    #[must_use]
    pub fn coloops(&self, seed: u64) -> Vec<usize> {
        let sample = self.random_null_vectors(1, seed);
        (0..self.triangle.columns())
            .filter(|&column| sample.iter().all(|vector| vector[column].is_zero()))
            .collect()
    }
}

/// Eliminates a matrix over the prime field. Any shape is accepted.
#[must_use]
pub fn factor_modular(matrix: &SparseMatrix<Field61>) -> ModularFactorization {
    ModularFactorization {
        triangle: eliminate(matrix, &prepare(matrix), &mut Gauss),
    }
}

/// The rank of a matrix over the prime field.
#[must_use]
pub fn modular_rank(matrix: &SparseMatrix<Field61>) -> usize {
    factor_modular(matrix).rank()
}

/// Gaussian elimination; any nonzero pivot is as good as another.
struct Gauss;

impl Kernel<Field61> for Gauss {
    fn eliminate_pivots(
        &mut self,
        dense: &mut Dense<Field61>,
        columns: &mut [usize],
        pivots: usize,
    ) -> usize {
        let mut kept = 0;
        for column in 0..pivots {
            // A column without a pivot stays where it is and those after it move forward, which
            // leaves the dropped ones behind the kept.
            if self.eliminate_column(dense, column, kept) {
                dense.swap_columns(kept, column);
                columns.swap(kept, column);
                kept += 1;
            }
        }
        kept
    }

    fn eliminate_column(&mut self, dense: &mut Dense<Field61>, column: usize, top: usize) -> bool {
        let rows = dense.rows;
        let Some(found) = dense.tail(column, top).iter().position(|x| !x.is_zero()) else {
            return false;
        };
        let pivot_row = top + found;
        let inverse = Field61::ONE / dense.values[column * rows + pivot_row];
        let own = &mut dense.values[column * rows..(column + 1) * rows];
        own.swap(top, pivot_row);
        let multipliers: Vec<Field61> = own[top + 1..].iter().map(|&x| x * inverse).collect();
        own[top + 1..].fill(Field61::ZERO);
        for target in dense.values[(column + 1) * rows..].chunks_exact_mut(rows) {
            target.swap(top, pivot_row);
            let head = target[top];
            if !head.is_zero() {
                (-head).add_scaled(&multipliers, &mut target[top + 1..]);
            }
        }
        true
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_agrees_with_wide_integers() {
        let mut random = SplitMix64::new(3);
        let p = i128::from(Field61::PRIME);
        for _ in 0..2000 {
            let a = Field61::random(&mut random);
            let b = Field61::random(&mut random);
            let (wide_a, wide_b) = (i128::from(a.value()), i128::from(b.value()));
            assert_eq!(a + b, Field61::new(wide_a + wide_b));
            assert_eq!(a - b, Field61::new(wide_a - wide_b));
            assert_eq!(a * b, Field61::new(wide_a * wide_b % p));
            assert_eq!(a / b * b, a);
        }
    }

    #[test]
    fn corner_cases_of_the_field() {
        let last = Field61::new(-1);
        assert_eq!(last.value(), Field61::PRIME - 1);
        assert_eq!(last * last, Field61::ONE);
        assert_eq!(last + Field61::ONE, Field61::ZERO);
        assert_eq!(Field61::new(i128::from(Field61::PRIME)), Field61::ZERO);
        assert_eq!(Field61::new(i128::MIN) + Field61::new(i128::MAX), last);
        assert_eq!(Field61::from_integer(&(IBig::from(-1) << 61)), last);
        assert_eq!(
            Field61::from_integer(&(IBig::from(3) << 183)),
            Field61::new(3)
        );
        assert_eq!(-Field61::ZERO, Field61::ZERO);
        assert_eq!(Field61::ZERO.inverse(), None);
        assert_eq!(Field61::from_fraction(1, 0), None);
        let third = Field61::from_fraction(-1, 3).unwrap();
        assert_eq!(third * Field61::new(3), last);
        assert_eq!(last.square_root(), None, "−1 is no square modulo 3 (mod 4)");
        let four = Field61::new(4).square_root().unwrap();
        assert_eq!(four * four, Field61::new(4));
    }

    #[test]
    fn known_ranks_and_null_vectors() {
        // [1 2 3; 2 4 6; 1 1 1; 0 0 0] and one column of its own
        let rows = [[1, 2, 3, 0], [2, 4, 6, 0], [1, 1, 1, 0], [0, 0, 0, 5]];
        let entries = (0..16).map(|i| (i / 4, i % 4, Field61::new(rows[i / 4][i % 4])));
        let matrix = SparseMatrix::from_triplets(4, 4, Field61::ZERO, entries).unwrap();
        let factorization = factor_modular(&matrix);
        assert_eq!(factorization.rank(), 3);
        assert_eq!(factorization.coloops(1), [3]);
        for vector in factorization.random_null_vectors(3, 7) {
            assert_eq!(matrix.multiply(&vector).unwrap(), [Field61::ZERO; 4]);
            assert_eq!(vector[0] * Field61::new(-2), vector[1]);
        }
    }

    #[test]
    fn degenerate_shapes() {
        for (rows, columns) in [(0, 0), (0, 4), (4, 0), (3, 3)] {
            let zero = SparseMatrix::from_triplets(rows, columns, Field61::ZERO, vec![]).unwrap();
            let factorization = factor_modular(&zero);
            assert_eq!(factorization.rank(), 0);
            assert_eq!(factorization.dropped_columns().len(), columns);
            assert!(factorization.coloops(1).is_empty());
        }
    }
}
