//! Real roots: isolated by Descartes' rule of signs on halved intervals, then refined by bisection.
//!
//! Collins and Akritas 1976: the number of sign changes among the coefficients of (x+1)ⁿ·f(1/(x+1)) is at least the number
//! of roots of f in (0, 1), of the same parity, and exact when it is 0 or 1. For a squarefree f halving ends.

use super::{Rational, Univariate, dyadic, fraction};
use crate::engine::{Budget, Stop};
use num_bigint::{BigInt, Sign};
use num_traits::{One, Signed, Zero};

/// An interval that contains exactly one real root of a squarefree polynomial: in its inside, or the interval is a point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RealRoot {
    /// Lower end.
    pub low: Rational,
    /// Upper end; equal to the lower one where the root is known exactly.
    pub high: Rational,
}

impl RealRoot {
    fn exact(value: Rational) -> Self {
        Self {
            low: value.clone(),
            high: value,
        }
    }

    /// Whether the root is known exactly.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.low == self.high
    }

    /// The root in double precision: half way between the ends.
    #[must_use]
    pub fn value(&self) -> f64 {
        to_f64(&self.middle())
    }

    /// Half way between the ends.
    #[must_use]
    pub fn middle(&self) -> Rational {
        (&self.low + &self.high) / BigInt::from(2)
    }
}

impl Univariate {
    /// The real roots of a squarefree polynomial, ascending; the intervals have no inner point in common.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn real_roots(&self, budget: &Budget) -> Result<Vec<RealRoot>, Stop> {
        if self.degree() == 0 {
            return Ok(Vec::new());
        }
        let mut rest = self.clone();
        let mut zero = None;
        if rest.0[0].is_zero() {
            zero = Some(RealRoot::exact(Rational::zero()));
            rest.0.remove(0);
        }
        let mirrored = rest
            .0
            .iter()
            .enumerate()
            .map(|(i, c)| if i % 2 == 1 { -c } else { c.clone() });
        let mut roots: Vec<RealRoot> = Self(mirrored.collect())
            .positive_roots(budget)?
            .into_iter()
            .map(|root| RealRoot {
                low: -root.high,
                high: -root.low,
            })
            .collect();
        roots.reverse();
        roots.extend(zero);
        roots.extend(rest.positive_roots(budget)?);
        Ok(roots)
    }

    /// The positive roots where zero is none.
    fn positive_roots(&self, budget: &Budget) -> Result<Vec<RealRoot>, Stop> {
        if self.degree() == 0 {
            return Ok(Vec::new());
        }
        let bits = self.bound_bits();
        // Roots of f(2^bits·x) lie in (0, 1); every interval below is (position, position + 1)·2^(bits - level).
        let scaled = self
            .0
            .iter()
            .enumerate()
            .map(|(i, c)| c << (bits * i as u64));
        let place =
            |position: &BigInt, level: u64| Rational::new(position << bits, BigInt::one() << level);
        let mut roots = Vec::new();
        let mut waiting = vec![(scaled.collect::<Vec<BigInt>>(), BigInt::zero(), 0_u64)];
        while let Some((inside, position, level)) = waiting.pop() {
            budget.multiply((inside.len() * inside.len()) as u64)?;
            match sign_changes(&inside) {
                0 => {}
                1 => roots.push(RealRoot {
                    low: place(&position, level),
                    high: place(&(&position + 1), level),
                }),
                _ => {
                    let degree = inside.len() as u64 - 1;
                    let lower: Vec<BigInt> = inside
                        .iter()
                        .enumerate()
                        .map(|(i, c)| c << (degree - i as u64))
                        .collect();
                    let mut upper = lower.clone();
                    shift_by_one(&mut upper);
                    let middle: BigInt = 2 * &position + 1;
                    if upper[0].is_zero() {
                        roots.push(RealRoot::exact(place(&middle, level + 1)));
                        upper.remove(0);
                    }
                    waiting.push((upper, middle, level + 1));
                    waiting.push((lower, 2 * position, level + 1));
                }
            }
        }
        roots.sort_by(|a, b| (&a.low, &a.high).cmp(&(&b.low, &b.high)));
        Ok(roots)
    }

    /// All positive roots are below 2 to this power: Lagrange's bound, twice the largest |a(n-i)/a(n)|^(1/i).
    fn bound_bits(&self) -> u64 {
        let degree = self.degree();
        let head = self.leading().bits() as i64;
        let largest = self.0[..degree]
            .iter()
            .enumerate()
            .filter(|(_, c)| !c.is_zero())
            .map(|(i, c)| {
                let excess = c.bits() as i64 - head + 1;
                let power = (degree - i) as i64;
                excess.div_euclid(power) + 1
            })
            .max()
            .unwrap_or(0);
        (largest + 1).max(0) as u64
    }

    /// Halves the interval of a root until it is no wider than 2^-bits.
    #[must_use]
    pub fn refine(&self, root: &RealRoot, bits: u64) -> RealRoot {
        if root.is_exact() {
            return root.clone();
        }
        // An end may be another root: then the sign just inside is that of the derivative.
        let mut below = self.sign_at(&root.low);
        if below == 0 {
            below = self.derivative().sign_at(&root.low);
        }
        // Integers over one denominator, which doubles in every step: no fractions are reduced on the way.
        let unit = root.low.denom() * root.high.denom();
        let mut low = root.low.numer() * root.high.denom();
        let mut high = root.high.numer() * root.low.denom();
        let mut halvings = 0;
        while (&high - &low) << bits > &unit << halvings {
            let middle = &low + &high;
            halvings += 1;
            match self.sign_over(&middle, &unit, halvings) {
                0 => return RealRoot::exact(over(middle, &unit, halvings)),
                sign if sign == below => {
                    low = middle;
                    high <<= 1;
                }
                _ => {
                    high = middle;
                    low <<= 1;
                }
            }
        }
        RealRoot {
            low: over(low, &unit, halvings),
            high: over(high, &unit, halvings),
        }
    }

    /// The sign at `numerator / (unit·2^halvings)`.
    fn sign_over(&self, numerator: &BigInt, unit: &BigInt, halvings: u64) -> i8 {
        let mut scale = BigInt::one();
        let mut shift = 0;
        let mut sum = BigInt::zero();
        for c in self.0.iter().rev() {
            sum = sum * numerator + ((c * &scale) << shift);
            scale *= unit;
            shift += halvings;
        }
        sign(&sum)
    }
}

/// `numerator / (unit·2^halvings)`.
fn over(numerator: BigInt, unit: &BigInt, halvings: u64) -> Rational {
    if unit.trailing_zeros().map(|zeros| zeros + 1) == Some(unit.bits()) {
        return dyadic(numerator, unit.bits() - 1 + halvings);
    }
    fraction(numerator, &(unit << halvings))
}

fn sign(value: &BigInt) -> i8 {
    match value.sign() {
        Sign::Minus => -1,
        Sign::NoSign => 0,
        Sign::Plus => 1,
    }
}

/// f(x + 1) in place of f(x).
fn shift_by_one(coefficients: &mut [BigInt]) {
    let n = coefficients.len();
    for i in 0..n {
        for j in (i..n - 1).rev() {
            let (left, right) = coefficients.split_at_mut(j + 1);
            left[j] += &right[0];
        }
    }
}

/// Sign changes of (x+1)ⁿ·f(1/(x+1)).
fn sign_changes(coefficients: &[BigInt]) -> usize {
    let mut turned: Vec<BigInt> = coefficients.iter().rev().cloned().collect();
    shift_by_one(&mut turned);
    let mut changes = 0;
    let mut last = Sign::NoSign;
    for c in turned.iter().filter(|c| !c.is_zero()) {
        if last != Sign::NoSign && c.sign() != last {
            changes += 1;
        }
        last = c.sign();
    }
    changes
}

/// The nearest number of double precision to a rational.
pub(crate) fn to_f64(value: &Rational) -> f64 {
    // Both parts may exceed the range of f64: keep 64 bits more than the quotient needs.
    let excess = value.numer().bits() as i64 - value.denom().bits() as i64;
    let shift = 64 - excess;
    let scaled = if shift >= 0 {
        (value.numer() << shift.unsigned_abs()) / value.denom()
    } else {
        value.numer() / (value.denom() << shift.unsigned_abs())
    };
    let digits: i128 = i128::try_from(&scaled).unwrap_or_else(|_| {
        if scaled.is_negative() {
            i128::MIN
        } else {
            i128::MAX
        }
    });
    let exponent = i32::try_from(-shift).unwrap_or(0);
    // Two steps: 2^exponent alone may underflow where the product does not.
    let half = exponent / 2;
    digits as f64 * 2_f64.powi(half) * 2_f64.powi(exponent - half)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn linear(numerator: i64, denominator: i64) -> Univariate {
        Univariate::from_integers(&[-numerator, denominator])
    }

    #[test]
    fn square_roots() {
        let p = Univariate::from_integers(&[0, -2, 0, 1]);
        let roots = p.real_roots(&Budget::unlimited()).unwrap();
        assert_eq!(roots.len(), 3);
        let values: Vec<f64> = roots
            .iter()
            .map(|r| to_f64(&p.refine(r, 80).middle()))
            .collect();
        assert_eq!(values[1], 0.0);
        assert!((values[2] - 2_f64.sqrt()).abs() < 1e-15);
        assert_eq!(values[0], -values[2]);
        let none = Univariate::from_integers(&[1, 1, 1]);
        assert!(none.real_roots(&Budget::unlimited()).unwrap().is_empty());
    }

    #[test]
    fn mignotte_roots_lie_close_together() {
        // x^9 - 2·(50x - 1)^2 has two roots near 1/50 that agree to 9 digits.
        let close = Univariate::from_integers(&[-1, 50]);
        let mut coefficients = vec![0; 10];
        coefficients[9] = 1;
        let p = &Univariate::from_integers(&coefficients) - &(&close * &close).scaled(&2.into());
        let roots = p.real_roots(&Budget::unlimited()).unwrap();
        assert_eq!(roots.len(), 3);
        let fine: Vec<RealRoot> = roots.iter().map(|r| p.refine(r, 60)).collect();
        assert!(fine[0].high < fine[1].low);
    }

    #[test]
    fn rationals_of_any_size_become_floats() {
        let huge = BigInt::one() << 3000_u64;
        assert_eq!(to_f64(&Rational::new(&huge * 3, &huge * 2)), 1.5);
        assert_eq!(
            to_f64(&Rational::new(BigInt::from(-7), BigInt::from(4))),
            -1.75
        );
        assert_eq!(to_f64(&Rational::zero()), 0.0);
        assert_eq!(to_f64(&Rational::new(BigInt::one(), huge)), 0.0);
    }

    proptest! {
        #[test]
        fn known_roots_are_isolated(numerators in proptest::collection::btree_set(-200_i64..200, 1..8)) {
            let product = numerators
                .iter()
                .fold(Univariate::from_integers(&[3, 1, 1]), |p, &n| &p * &linear(n, 16));
            let roots = product.real_roots(&Budget::unlimited()).unwrap();
            prop_assert_eq!(roots.len(), numerators.len());
            for (root, &n) in roots.iter().zip(&numerators) {
                let value = Rational::new(n.into(), 16.into());
                prop_assert!(root.low <= value && value <= root.high);
                let fine = product.refine(root, 30);
                prop_assert!(fine.low <= value && value <= fine.high);
                prop_assert!(to_f64(&(fine.high - fine.low)) <= 1e-9);
            }
        }
    }
}
