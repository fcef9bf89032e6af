//! Fractions of any length. They are those of the crate `dashu`, in which the mechanism's numbers are, and whose greatest
//! common divisors are fast: sixty decimals grow to thousands of bits in a cycle.

use crate::Rational;
use dashu_base::{Gcd, Sign, SquareRoot};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use num_bigint::BigInt;

/// A fraction in lowest terms.
pub(super) type Fraction = RBig;

/// `numerator / denominator`; a denominator of zero counts as one.
pub(super) fn fraction(numerator: i64, denominator: u64) -> Fraction {
    RBig::from_parts(numerator.into(), denominator.max(1).into())
}

/// One over a fraction that is not zero.
pub(super) fn inverse(x: &Fraction) -> Fraction {
    RBig::ONE / x
}

/// The square root of a fraction that is a square.
pub(super) fn root(x: &Fraction) -> Option<Fraction> {
    let (sign, numerator) = x.numerator().clone().into_parts();
    let exact = |n: &UBig| {
        let root = n.sqrt();
        (&root * &root == *n).then_some(root)
    };
    if sign == Sign::Negative {
        return None;
    }
    let (n, d) = (exact(&numerator)?, exact(x.denominator())?);
    Some(RBig::from_parts(n.into(), d))
}

/// The nearest double; infinite beyond their range.
pub(super) fn to_f64(x: &Fraction) -> f64 {
    x.to_f64().value()
}

pub(super) fn lcm(a: &UBig, b: &UBig) -> UBig {
    let shared = a.gcd(b);
    a / shared * b
}

/// The size of a numerator.
pub(super) fn size(x: &Fraction) -> UBig {
    x.numerator().clone().into_parts().1
}

/// An integer of the crate `num-bigint`.
fn to_bigint(n: &IBig) -> BigInt {
    let (sign, size) = n.clone().into_parts();
    let sign = match sign {
        Sign::Positive => num_bigint::Sign::Plus,
        Sign::Negative => num_bigint::Sign::Minus,
    };
    BigInt::from_bytes_le(sign, &size.to_le_bytes())
}

/// The same fraction for [`crate::Polynomial`].
pub(super) fn to_rational(x: &Fraction) -> Rational {
    // Both libraries keep lowest terms and a positive denominator.
    Rational::new_raw(
        to_bigint(x.numerator()),
        to_bigint(&IBig::from(x.denominator().clone())),
    )
}

/// And back.
pub(super) fn from_rational(x: &Rational) -> Fraction {
    let size = |n: &BigInt| UBig::from_le_bytes(&n.magnitude().to_bytes_le());
    let numerator = IBig::from(size(x.numer()));
    let signed = if x.numer().sign() == num_bigint::Sign::Minus {
        -numerator
    } else {
        numerator
    };
    RBig::from_parts(signed, size(x.denom()))
}

/// The remainder modulo a prime; `None` where it divides the denominator.
pub(super) fn residue(x: &Fraction, p: u64) -> Option<u64> {
    let (sign, numerator) = x.numerator().clone().into_parts();
    let modulus = UBig::from(p);
    let image = |n: &UBig| u64::try_from(n % &modulus).ok();
    let (n, d) = (image(&numerator)?, image(x.denominator())?);
    let n = if sign == Sign::Negative && n > 0 {
        p - n
    } else {
        n
    };
    (d != 0).then(|| multiply_modulo(n, power_modulo(d, p - 2, p), p))
}

pub(super) fn multiply_modulo(a: u64, b: u64, p: u64) -> u64 {
    // The remainder of a u64 is a u64.
    (u128::from(a) * u128::from(b) % u128::from(p)) as u64
}

pub(super) fn power_modulo(base: u64, mut exponent: u64, p: u64) -> u64 {
    let (mut result, mut square) = (1 % p, base % p);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = multiply_modulo(result, square, p);
        }
        square = multiply_modulo(square, square, p);
        exponent >>= 1;
    }
    result
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn fractions_survive_the_change_of_library() {
        for (n, d) in [(0, 1), (-7, 3), (22, 7), (i64::MAX, 2), (-1, u64::MAX)] {
            let x = fraction(n, d);
            let x = &x * &x * &x;
            assert_eq!(from_rational(&to_rational(&x)), x);
        }
        assert_eq!(to_rational(&fraction(-6, 4)).to_string(), "-3/2");
    }

    #[test]
    fn roots_and_remainders() {
        assert_eq!(root(&fraction(4, 9)), Some(fraction(2, 3)));
        assert_eq!(root(&fraction(-4, 9)), None);
        assert_eq!(root(&fraction(2, 9)), None);
        assert_eq!(residue(&fraction(-1, 2), 7), Some(3));
        assert_eq!(residue(&fraction(1, 14), 7), None);
    }
}
