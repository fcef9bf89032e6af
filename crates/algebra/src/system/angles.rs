//! Angles that hold parameters: sums of rational multiples of parameters and a constant angle.

use super::fraction::{Fraction, inverse, lcm};
use dashu_int::UBig;
use kutzbach_math::number::{Number, View};
use std::collections::BTreeMap;

/// A parameter as an angle: its name, and whether it counts in half turns (times pi, as degrees do) and not in radians.
pub(super) type Parameter = (String, bool);

/// Σ multiple · parameter + constant.
#[derive(Clone, Debug)]
pub(super) struct LinearAngle {
    /// By parameter, with the parameter's value in the file; no multiple is zero.
    pub(super) multiples: BTreeMap<Parameter, (Fraction, Number)>,
    pub(super) constant: Number,
}

/// Least common denominators of the multiples in which parameters occur in angles.
pub(super) type Divisors = BTreeMap<Parameter, UBig>;

impl LinearAngle {
    fn constant(number: &Number) -> Self {
        Self {
            multiples: BTreeMap::new(),
            constant: number.clone(),
        }
    }

    fn scaled(mut self, factor: &Fraction) -> Self {
        if factor.is_zero() {
            return Self::constant(&Number::zero());
        }
        for (multiple, _) in self.multiples.values_mut() {
            *multiple = &*multiple * factor;
        }
        self.constant = &self.constant * &Number::of_fraction(factor.clone());
        self
    }

    fn plus(mut self, other: Self) -> Self {
        for (parameter, (multiple, value)) in other.multiples {
            let entry = self
                .multiples
                .entry(parameter)
                .or_insert((Fraction::ZERO, value));
            entry.0 = &entry.0 + &multiple;
        }
        self.multiples
            .retain(|_, (multiple, _)| !multiple.is_zero());
        self.constant = &self.constant + &other.constant;
        self
    }

    /// A number as such a sum; `None` where it is none.
    pub(super) fn of(number: &Number) -> Option<Self> {
        match number.view() {
            View::Parameter(name, value) => {
                let parameter = (name.to_owned(), false);
                Some(Self {
                    multiples: BTreeMap::from([(parameter, (Fraction::ONE, value.clone()))]),
                    constant: Number::zero(),
                })
            }
            View::Sum(a, b) => Some(Self::of(a)?.plus(Self::of(b)?)),
            View::Negative(a) => Some(Self::of(a)?.scaled(&Fraction::from(-1))),
            View::Product(a, b) => Self::product(a, b).or_else(|| Self::product(b, a)),
            View::Quotient(a, b) => {
                let divisor = b.rational().filter(|x| !x.is_zero())?;
                Some(Self::of(a)?.scaled(&inverse(divisor)))
            }
            _ => Some(Self::constant(number)),
        }
    }

    /// A factor times a sum: a fraction times any, a fraction of pi times parameters alone.
    fn product(factor: &Number, sum: &Number) -> Option<Self> {
        let sum = Self::of(sum)?;
        match factor.view() {
            View::Rational(factor) => Some(sum.scaled(factor)),
            View::Angle(angle) if angle.parts().len() == 0 => {
                let factor = angle.pi_multiple().clone();
                if !sum.multiples.keys().all(|(_, half_turns)| !half_turns) {
                    return None;
                }
                let turned = |((name, _), (multiple, value))| {
                    ((name, true), (multiple, value * Number::pi()))
                };
                let constant = match sum.constant.view() {
                    View::Rational(x) => Number::of_fraction(x.clone()) * Number::pi(),
                    _ => return None,
                };
                let sum = Self {
                    multiples: sum.multiples.into_iter().map(turned).collect(),
                    constant,
                };
                Some(sum.scaled(&factor))
            }
            _ => None,
        }
    }

    /// Notes the denominators of the multiples.
    pub(super) fn note(&self, divisors: &mut Divisors) {
        for (parameter, (multiple, _)) in &self.multiples {
            let known = divisors.entry(parameter.clone()).or_insert(UBig::ONE);
            *known = lcm(known, multiple.denominator());
        }
    }
}

/// The name of a parameter over a divisor, as an angle in radians.
pub(super) fn name((name, half_turns): &Parameter, divisor: &UBig) -> String {
    let times = if *half_turns { "*pi" } else { "" };
    if *divisor == UBig::ONE {
        format!("{name}{times}")
    } else {
        format!("{name}{times}/{divisor}")
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_math::number::NumberError;

    fn read(text: &str) -> Result<Number, NumberError> {
        Number::expression(text, &mut |name| {
            let value = Number::ratio(
                match name {
                    "alpha" => 1,
                    _ => 2,
                },
                3,
            );
            Ok(value.map(|value| Number::parameter(name, value)))
        })
    }

    #[test]
    fn sums_of_multiples_are_recognized() {
        let angle =
            LinearAngle::of(&read("alpha/2 - 3*(beta - pi/4) + radians(30*alpha)").unwrap());
        let angle = angle.unwrap();
        let multiples: Vec<String> = angle
            .multiples
            .iter()
            .map(|((name, half), (n, _))| format!("{n} {name} {half}"))
            .collect();
        assert_eq!(
            multiples,
            ["1/2 alpha false", "1/6 alpha true", "-3 beta false"]
        );
        assert!((angle.constant.value() - 0.75 * std::f64::consts::PI).abs() < 1e-15);
        let none = LinearAngle::of(&read("alpha - alpha").unwrap()).unwrap();
        assert!(none.multiples.is_empty());
        assert!(LinearAngle::of(&read("alpha*beta").unwrap()).is_none());
    }
}
