//! Hilbert series of monomial ideals: how many monomials of each degree are no multiple of a leading monomial.
//!
//! For an order that compares degrees first, the leading ideal has the Hilbert function of the ideal itself, and so tells
//! degree and number of solutions. The numerator of the series comes from the recursion
//! `N(I) = N(I + p) + t^deg(p) N(I : p)` over a pivot monomial `p` (Bayer and Stillman 1992; Bigatti 1997), here a power of
//! the variable that occurs most often.

use super::budget::{Budget, Stop};
use crate::polynomial::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// The Hilbert series of the polynomials modulo an ideal: `numerator(t) / (1 - t)^dimension` counts the monomials of each
/// degree that are no multiple of a leading monomial.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HilbertSeries {
    numerator: Vec<BigInt>,
    dimension: usize,
}

impl HilbertSeries {
    /// Of the ideal of some monomials in a ring of `variables` variables; `None` where the ideal is the whole ring.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice: the recursion is exponential in the worst case.
    pub(super) fn of(
        monomials: Vec<Vec<u32>>,
        variables: usize,
        budget: &Budget,
    ) -> Result<Option<Self>, Stop> {
        let mut numerator = numerator(minimal(monomials), budget)?;
        if numerator.is_empty() {
            return Ok(None);
        }
        let mut dimension = variables;
        // N(1) = 0 means that 1 - t divides it.
        while dimension > 0 && numerator.iter().sum::<BigInt>().is_zero() {
            let mut sum = BigInt::zero();
            for c in &mut numerator {
                sum += &*c;
                *c = sum.clone();
            }
            trim(&mut numerator);
            dimension -= 1;
        }
        Ok(Some(Self {
            numerator,
            dimension,
        }))
    }

    /// Coefficients of the numerator, constant first.
    #[must_use]
    pub fn numerator(&self) -> &[BigInt] {
        &self.numerator
    }

    /// The Krull dimension.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The degree of the part of highest dimension, multiplicities counted: in dimension 0 the number of complex solutions
    /// with multiplicity, in dimension d the number of intersections with a general linear space of codimension d.
    #[must_use]
    pub fn degree(&self) -> BigInt {
        self.numerator.iter().sum()
    }

    /// Number of monomials of degree at most `degree` that are no multiple of a leading monomial: the affine Hilbert
    /// function.
    #[must_use]
    pub fn count_up_to(&self, degree: usize) -> BigInt {
        // Dividing by one more 1 - t adds up the degrees.
        let terms = self.numerator.iter().enumerate().take(degree + 1);
        terms
            .map(|(j, c)| c * binomial(degree - j + self.dimension, self.dimension))
            .sum()
    }

    /// The Hilbert polynomial: the polynomial in `s`, constant coefficient first, that [`Self::count_up_to`] follows from
    /// `s = numerator degree - dimension` on.
    #[must_use]
    pub fn polynomial(&self) -> Vec<Rational> {
        let mut sum = vec![Rational::zero(); self.dimension + 1];
        for (j, c) in self.numerator.iter().enumerate() {
            // c * (s - j + 1) (s - j + 2) ... (s - j + d) / d!
            let mut product = vec![Rational::from_integer(c.clone())];
            for i in 1..=self.dimension {
                let shift = Rational::from_integer(BigInt::from(i) - BigInt::from(j));
                let scale = Rational::new(BigInt::one(), BigInt::from(i));
                let mut next = vec![Rational::zero(); product.len() + 1];
                for (k, value) in product.iter().enumerate() {
                    next[k] += value * &shift * &scale;
                    next[k + 1] += value * &scale;
                }
                product = next;
            }
            for (total, value) in sum.iter_mut().zip(product) {
                *total += value;
            }
        }
        while sum.last().is_some_and(Zero::is_zero) {
            sum.pop();
        }
        sum
    }
}

fn binomial(n: usize, k: usize) -> BigInt {
    (1..=k).fold(BigInt::one(), |value, i| value * (n - k + i) / i)
}

fn trim(polynomial: &mut Vec<BigInt>) {
    while polynomial.last().is_some_and(Zero::is_zero) {
        polynomial.pop();
    }
}

/// The monomials that are no multiple of another.
fn minimal(mut monomials: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    monomials.sort_by_key(|m| m.iter().sum::<u32>());
    let mut kept: Vec<Vec<u32>> = Vec::new();
    for monomial in monomials {
        let multiple = |smaller: &Vec<u32>| smaller.iter().zip(&monomial).all(|(a, b)| a <= b);
        if !kept.iter().any(multiple) {
            kept.push(monomial);
        }
    }
    kept
}

/// The numerator over `(1 - t)^variables`, for minimal generators; empty where 1 is among them.
fn numerator(generators: Vec<Vec<u32>>, budget: &Budget) -> Result<Vec<BigInt>, Stop> {
    budget.spend(generators.len() as u64 + 1)?;
    let variables = generators.first().map_or(0, Vec::len);
    let uses = |v: usize| generators.iter().filter(|m| m[v] > 0).count();
    let most = (0..variables).max_by_key(|&v| (uses(v), std::cmp::Reverse(v)));
    let Some(variable) = most.filter(|&v| uses(v) > 1) else {
        // No two have a variable in common: the product of 1 - t^degree.
        let mut product = vec![BigInt::one()];
        for generator in &generators {
            let degree = generator.iter().sum::<u32>() as usize;
            let mut next = product.clone();
            next.resize(product.len() + degree, BigInt::zero());
            for (i, c) in product.iter().enumerate() {
                next[i + degree] -= c;
            }
            product = next;
        }
        trim(&mut product);
        return Ok(product);
    };
    // The middle one of the exponents splits the generators most evenly.
    let mut exponents: Vec<u32> = generators
        .iter()
        .map(|m| m[variable])
        .filter(|&e| e > 0)
        .collect();
    exponents.sort_unstable();
    let middle = exponents[exponents.len() / 2];
    let largest_mixed = generators
        .iter()
        .filter(|m| m.iter().enumerate().any(|(v, &e)| v != variable && e > 0))
        .map(|m| m[variable])
        .max()
        .unwrap_or(0);
    let power = middle.min(largest_mixed).max(1);
    let mut pivot = vec![0; variables];
    pivot[variable] = power;
    let mut with_pivot: Vec<Vec<u32>> = generators
        .iter()
        .filter(|m| m[variable] < power)
        .cloned()
        .collect();
    with_pivot.push(pivot);
    let quotient: Vec<Vec<u32>> = generators
        .into_iter()
        .map(|mut m| {
            m[variable] = m[variable].saturating_sub(power);
            m
        })
        .collect();
    let mut sum = numerator(minimal(with_pivot), budget)?;
    let shifted = numerator(minimal(quotient), budget)?;
    let length = sum.len().max(shifted.len() + power as usize);
    sum.resize(length, BigInt::zero());
    for (i, c) in shifted.into_iter().enumerate() {
        sum[i + power as usize] += c;
    }
    trim(&mut sum);
    Ok(sum)
}

/// A count as a machine number, where it is one.
pub(super) fn small(count: &BigInt) -> Option<usize> {
    (!count.is_negative())
        .then(|| usize::try_from(count).ok())
        .flatten()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn series(monomials: &[&[u32]], variables: usize) -> HilbertSeries {
        let monomials = monomials.iter().map(|m| m.to_vec()).collect();
        HilbertSeries::of(monomials, variables, &Budget::unlimited())
            .unwrap()
            .unwrap()
    }

    #[test]
    fn points_and_curves() {
        // x², y³: six points.
        let points = series(&[&[2, 0], &[0, 3]], 2);
        assert_eq!((points.dimension(), points.degree()), (0, 6.into()));
        // x²: a double line in the plane; 2s + 1 monomials up to degree s.
        let line = series(&[&[2, 0]], 2);
        assert_eq!((line.dimension(), line.degree()), (1, 2.into()));
        let whole = |v: i64| Rational::from_integer(v.into());
        assert_eq!(line.polynomial(), [whole(1), whole(2)]);
        // The twisted cubic, leading monomials xz, yz, z² up to names.
        let cubic = series(&[&[0, 2, 0], &[0, 1, 1], &[0, 0, 2]], 3);
        assert_eq!((cubic.dimension(), cubic.degree()), (1, 3.into()));
    }

    #[test]
    fn the_whole_space_and_nothing() {
        let space = series(&[], 3);
        assert_eq!((space.dimension(), space.degree()), (3, 1.into()));
        assert_eq!(space.count_up_to(2), 10.into());
        let nothing = HilbertSeries::of(vec![vec![0, 0]], 2, &Budget::unlimited());
        assert_eq!(nothing, Ok(None));
    }

    proptest! {
        #[test]
        fn the_series_counts_monomials(
            monomials in prop::collection::vec(prop::collection::vec(0_u32..4, 3), 1..6)
        ) {
            prop_assume!(monomials.iter().all(|m| m.iter().any(|&e| e > 0)));
            let series = HilbertSeries::of(monomials.clone(), 3, &Budget::unlimited())
                .unwrap()
                .unwrap();
            let most = 7_u32;
            let mut count = 0;
            for x in 0..=most {
                for y in 0..=most - x {
                    for z in 0..=most - x - y {
                        let divides = |m: &Vec<u32>| m[0] <= x && m[1] <= y && m[2] <= z;
                        count += u32::from(!monomials.iter().any(divides));
                    }
                }
            }
            prop_assert_eq!(series.count_up_to(most as usize), BigInt::from(count));
            let s = 20;
            let at = Rational::from_integer(s.into());
            let value = series
                .polynomial()
                .iter()
                .rev()
                .fold(Rational::zero(), |sum, c| sum * &at + c);
            prop_assert_eq!(value, Rational::from_integer(series.count_up_to(s)));
        }
    }
}
