//! Bit length of a number: the smallest offset that it can have been written to hold.

use super::{Exact, Form, Number};
use dashu_base::{BitTest, PowerOfTwo};
use dashu_ratio::RBig;

/// Fractions of powers of two that somebody writes have fewer significant bits than this; of a thousand doubles that were computed one has.
const CHOSEN_BITS: usize = 43;

impl Number {
    /// Whether it is a double with its bits in use, as programs compute them: nothing is meant by the last ones.
    #[must_use]
    pub fn is_full_double(&self) -> bool {
        self.rational().is_some_and(|x| {
            let numerator = x.numerator();
            let significant = numerator.bit_len() - numerator.trailing_zeros().unwrap_or(0);
            x.denominator().is_power_of_two() && (CHOSEN_BITS..=53).contains(&significant)
        })
    }

    /// Bits of the longest integer the number is written with: how small an offset can be meant by it. `1/3` has 2, the
    /// expression `1e-14` has 47; larger expressions have that of their longest part. Nothing is meant by the last bits of what
    /// a double holds (fractions whose denominator is a power of two, numerators of up to 53 significant bits) or of what was
    /// computed from decimals: these have 0.
    #[must_use]
    pub fn height(&self) -> usize {
        if self.0.coarsest.is_some() {
            return 0;
        }
        let of_fraction = |x: &RBig| {
            let numerator = x.numerator();
            let significant = numerator.bit_len() - numerator.trailing_zeros().unwrap_or(0);
            if x.denominator().is_power_of_two() && significant <= 53 {
                return 0;
            }
            numerator.bit_len().max(x.denominator().bit_len())
        };
        match &self.0.form {
            Form::Exact(Exact::Rational(x)) => of_fraction(x),
            Form::Exact(Exact::Surd(surd)) => surd
                .terms()
                .map(|(root, factor)| of_fraction(factor).max(root.bit_len()))
                .max()
                .unwrap_or(0),
            Form::Exact(Exact::Angle(angle)) => angle
                .parts()
                .map(|(direction, factor)| of_fraction(factor).max(direction.cos().height()))
                .fold(of_fraction(angle.pi_multiple()), usize::max),
            Form::Exact(Exact::Algebraic(tree)) | Form::Symbolic(tree) => {
                tree.operands.iter().map(Self::height).max().unwrap_or(0)
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn read(text: &str) -> Number {
        Number::expression(text, &mut |_| Ok(None)).unwrap()
    }

    #[test]
    fn heights_are_the_bits_that_something_may_be_meant_by() {
        for (text, bits) in [
            ("0", 0),
            ("3", 0),
            ("1/3", 2),
            ("-22/7", 5),
            // A decimal in an expression is exact.
            ("1e-14", 47),
            ("1 + 1e-14", 47),
            // Dyadic numbers of up to 53 bits are doubles, and could be anything rounded.
            ("3/8", 0),
            ("2**52 + 1", 0),
            ("2**53 + 1", 54),
            ("sqrt(2)", 2),
            ("sqrt(1000003)", 20),
            ("sqrt(2)/1025", 11),
            ("1/1000 + sqrt(3)/5", 10),
            ("pi", 0),
            ("pi/6", 3),
            ("acos(1/3)/1000000", 21),
            ("sqrt(1 + sqrt(2)/1025)", 11),
            ("cos(1/1000)", 10),
            ("pi**2 + 1e-14", 47),
        ] {
            assert_eq!(read(text).height(), bits, "{text}");
            assert_eq!((-read(text)).height(), bits, "-({text})");
        }
    }

    #[test]
    fn nothing_is_meant_by_the_last_bits_of_a_rounded_number() {
        for text in [
            "0.1",
            "0.86602540378443864676372317075293618347140262690519",
            "1e-14",
        ] {
            let decimal = Number::decimal(text).unwrap();
            assert_eq!(decimal.height(), 0, "{text}");
            assert_eq!((&decimal * &read("sqrt(2)/1025")).height(), 0, "{text}");
        }
        // Without decimals a number is exact.
        assert_eq!(Number::decimal("5").unwrap().height(), 0);
        assert_eq!(Number::decimal("36028797018963969").unwrap().height(), 56);
        for double in [0.1, 1e-14, -1.0 / 3.0, 1e300] {
            assert_eq!(Number::from_f64(double).unwrap().height(), 0, "{double}");
        }
        // An angle is as tall as the direction it is kept as.
        assert!((10..24).contains(&read("acos(1/1000)").height()));
        // What is computed from doubles has more bits than they have, and is exact.
        let third = Number::from_f64(1.0 / 3.0).unwrap();
        assert!((&third * &third).height() > 53);
    }
}
