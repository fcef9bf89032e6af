//! Elements of a number field as polynomials in its generators.

use crate::algebra::Rational;
use num_bigint::{BigInt, BigUint, Sign};
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// Exponents of the generators, without zeros at the end, so that a field may grow under its elements.
pub(super) type Exponents = Vec<u16>;

/// A polynomial in the generators of a [`Field`](super::field::Field). Reduced by it, equal elements look equal.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Element(pub(super) BTreeMap<Exponents, Rational>);

impl Element {
    pub(super) fn zero() -> Self {
        Self::default()
    }

    pub(super) fn rational(value: Rational) -> Self {
        let mut terms = BTreeMap::new();
        if !value.is_zero() {
            terms.insert(Vec::new(), value);
        }
        Self(terms)
    }

    pub(super) fn integer(value: i64) -> Self {
        Self::rational(Rational::from_integer(value.into()))
    }

    /// The generator with this index.
    pub(super) fn generator(index: usize) -> Self {
        let mut exponents = vec![0; index + 1];
        exponents[index] = 1;
        Self(BTreeMap::from([(exponents, Rational::one())]))
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The value of an element in which no generator occurs.
    pub(super) fn as_rational(&self) -> Option<Rational> {
        match self.0.len() {
            0 => Some(Rational::zero()),
            1 => self.0.get(&Vec::new()).cloned(),
            _ => None,
        }
    }

    /// Number of generators up to the last one that occurs.
    pub(super) fn level(&self) -> usize {
        self.0.keys().map(Vec::len).max().unwrap_or(0)
    }

    pub(super) fn scaled(&self, factor: &Rational) -> Self {
        if factor.is_zero() {
            return Self::zero();
        }
        Self(
            self.0
                .iter()
                .map(|(e, c)| (e.clone(), c * factor))
                .collect(),
        )
    }

    pub(super) fn negated(&self) -> Self {
        Self(self.0.iter().map(|(e, c)| (e.clone(), -c)).collect())
    }

    /// Adds a multiple of a monomial.
    pub(super) fn add_term(&mut self, exponents: Exponents, coefficient: Rational) {
        if coefficient.is_zero() {
            return;
        }
        match self.0.entry(exponents) {
            std::collections::btree_map::Entry::Vacant(place) => {
                place.insert(coefficient);
            }
            std::collections::btree_map::Entry::Occupied(mut place) => {
                *place.get_mut() += coefficient;
                if place.get().is_zero() {
                    place.remove();
                }
            }
        }
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        let (mut sum, rest) = if self.0.len() >= other.0.len() {
            (self.clone(), other)
        } else {
            (other.clone(), self)
        };
        for (exponents, coefficient) in &rest.0 {
            sum.add_term(exponents.clone(), coefficient.clone());
        }
        sum
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    /// Coefficients by the power of one generator.
    pub(super) fn by_power(&self, generator: usize) -> Vec<Self> {
        let mut parts: Vec<Self> = Vec::new();
        for (exponents, coefficient) in &self.0 {
            let power = usize::from(exponents.get(generator).copied().unwrap_or(0));
            if parts.len() <= power {
                parts.resize(power + 1, Self::zero());
            }
            let mut rest = exponents.clone();
            if let Some(exponent) = rest.get_mut(generator) {
                *exponent = 0;
            }
            trim(&mut rest);
            parts[power].add_term(rest, coefficient.clone());
        }
        parts
    }

    /// Whether a generator occurs.
    pub(super) fn mentions(&self, generator: usize) -> bool {
        self.0
            .keys()
            .any(|exponents| exponents.get(generator).is_some_and(|e| *e > 0))
    }

    /// The least common multiple of the denominators, at least 1.
    pub(super) fn denominator(&self) -> BigInt {
        self.0.values().fold(BigInt::one(), |lcm, c| {
            let shared = gcd(lcm.clone(), c.denom().clone());
            lcm / shared * c.denom()
        })
    }

    /// The greatest common divisor of integral coefficients.
    pub(super) fn content(&self) -> BigInt {
        self.0
            .values()
            .fold(BigInt::zero(), |g, c| gcd(g, c.numer().clone()))
    }

    /// The value where every generator has one, in doubles.
    pub(super) fn approximate(&self, generators: &[f64]) -> f64 {
        self.0
            .iter()
            .map(|(exponents, coefficient)| {
                exponents
                    .iter()
                    .zip(generators)
                    .fold(to_f64(coefficient), |product, (e, x)| {
                        product * x.powi(i32::from(*e))
                    })
            })
            .sum()
    }
}

pub(super) fn trim(exponents: &mut Exponents) {
    while exponents.last() == Some(&0) {
        exponents.pop();
    }
}

/// Exponents of a product.
pub(super) fn product(a: &[u16], b: &[u16]) -> Exponents {
    let (long, short) = if a.len() >= b.len() { (a, b) } else { (b, a) };
    let mut sum = long.to_vec();
    for (x, y) in sum.iter_mut().zip(short) {
        *x += y;
    }
    sum
}

pub(super) fn gcd(mut a: BigInt, mut b: BigInt) -> BigInt {
    while !b.is_zero() {
        (a, b) = (b.clone(), a % b);
    }
    if a.sign() == Sign::Minus { -a } else { a }
}

/// A rational in doubles, also where numerator and denominator leave their range.
pub(super) fn to_f64(x: &Rational) -> f64 {
    use num_traits::ToPrimitive;
    if let (Some(n), Some(d)) = (x.numer().to_f64(), x.denom().to_f64())
        && n.is_finite()
        && d.is_finite()
        && d != 0.0
    {
        return n / d;
    }
    // Sixty-odd bits of either suffice.
    let excess = |n: &BigInt| n.bits().saturating_sub(64);
    let shift = excess(x.numer()).min(excess(x.denom()));
    let (n, d) = (x.numer() >> shift, x.denom() >> shift);
    n.to_f64().unwrap_or(f64::NAN) / d.to_f64().unwrap_or(f64::NAN)
}

/// A fraction of the crate [`dashu`] as one of the crate [`num_rational`].
pub(super) fn from_dashu(x: &dashu::rational::RBig) -> Rational {
    let (sign, size) = x.numerator().clone().into_parts();
    let numerator = BigUint::from_bytes_le(&size.to_le_bytes());
    let denominator = BigUint::from_bytes_le(&x.denominator().to_le_bytes());
    let sign = match sign {
        dashu::base::Sign::Positive => Sign::Plus,
        dashu::base::Sign::Negative => Sign::Minus,
    };
    Rational::new(
        BigInt::from_biguint(sign, numerator),
        BigInt::from(denominator),
    )
}

/// The other way round.
pub(super) fn to_dashu(x: &Rational) -> dashu::rational::RBig {
    use dashu::integer::{IBig, UBig};
    let size = |n: &BigInt| UBig::from_le_bytes(&n.magnitude().to_bytes_le());
    let numerator = IBig::from(size(x.numer()));
    let signed = if x.numer().sign() == Sign::Minus {
        -numerator
    } else {
        numerator
    };
    dashu::rational::RBig::from_parts(signed, size(x.denom()))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn rationals_survive_the_change_of_library() {
        for (n, d) in [(0, 1), (-7, 3), (22, 7), (i64::MAX, 2), (-1, i64::MAX)] {
            let x = Rational::new(n.into(), d.into());
            let x = &x * &x * &x;
            assert_eq!(from_dashu(&to_dashu(&x)), x);
        }
    }

    #[test]
    fn large_fractions_have_doubles() {
        let huge = BigInt::one() << 4000;
        let x = Rational::new(&huge * 3, huge * 4);
        assert_eq!(to_f64(&x), 0.75);
        assert_eq!(to_f64(&Rational::new((-1).into(), 8.into())), -0.125);
    }

    #[test]
    fn parts_by_power_add_up() {
        let x = Element::generator(1);
        let y = Element::generator(0);
        let sum = x.plus(&y.scaled(&Rational::from_integer(3.into())));
        let parts = sum.by_power(1);
        assert_eq!(parts.len(), 2);
        assert_eq!(parts[1], Element::integer(1));
        assert!(parts[0].mentions(0) && !parts[0].mentions(1));
        assert_eq!(sum.minus(&sum), Element::zero());
        assert_eq!(sum.level(), 2);
    }
}
