//! Exact numbers as elements of a field.

use super::angles::{Divisors, LinearAngle};
use super::circle;
use super::element::Element;
use super::error::SystemError;
use super::field::{Field, FieldLimit};
use super::fraction::fraction;
use kutzbach_math::number::{Angle, Number, View};

/// Expressions beyond this size are refused.
const MAX_NODES: u32 = 1_000;
/// Largest integer power that is multiplied out.
const MAX_POWER: u32 = 64;

/// What is wrong with a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Obstacle {
    /// It is transcendental, or nothing shows that it is not.
    Transcendental,
    /// The field would have too high a degree.
    Degree,
}

impl From<FieldLimit> for Obstacle {
    fn from(limit: FieldLimit) -> Self {
        match limit {
            FieldLimit::Degree => Self::Degree,
            FieldLimit::Negative | FieldLimit::Zero => Self::Transcendental,
        }
    }
}

/// Where a number stands, for messages.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub(super) entity: String,
    pub(super) element: String,
}

impl Place {
    pub(super) fn joint(name: &str, element: &str) -> Self {
        Self {
            entity: format!("joint `{name}`"),
            element: element.to_owned(),
        }
    }

    /// The error of a length, ratio or component of a direction.
    pub(super) fn length(&self, number: &Number, obstacle: Obstacle) -> SystemError {
        let advice = "write a decimal, a fraction or a square root".to_owned();
        self.error(number, obstacle, "not algebraic", advice)
    }

    /// The error of an angle.
    pub(super) fn angle(&self, number: &Number, obstacle: Obstacle) -> SystemError {
        let advice = match near_fraction_of_pi(number.value()) {
            Some(text) => format!("write ${{{text}}}"),
            None => {
                "write a fraction of pi, or the angle by its cosine or tangent as in ${acos(3/5)}"
                    .to_owned()
            }
        };
        self.error(
            number,
            obstacle,
            "an angle without an algebraic cosine",
            advice,
        )
    }

    fn error(
        &self,
        number: &Number,
        obstacle: Obstacle,
        kind: &'static str,
        advice: String,
    ) -> SystemError {
        let (kind, advice) = match number.is_open() {
            true => (
                "no polynomial in what is left open",
                "leave open an angle itself, or the components of a direction".to_owned(),
            ),
            false => (kind, advice),
        };
        let (entity, element, number) =
            (self.entity.clone(), self.element.clone(), excerpt(number));
        match obstacle {
            Obstacle::Transcendental => SystemError::NotAlgebraic {
                entity,
                element,
                number,
                kind,
                advice,
            },
            Obstacle::Degree => SystemError::Degree {
                entity,
                element,
                number,
                advice,
            },
        }
    }
}

/// The beginning of a number's text.
fn excerpt(number: &Number) -> String {
    let text = number.source();
    if text.chars().count() <= 40 {
        return text;
    }
    text.chars().take(37).chain("...".chars()).collect()
}

/// `k*pi/n` for the fraction of pi with a small denominator that a rounded angle is near, within a thousandth.
fn near_fraction_of_pi(value: f64) -> Option<String> {
    let ratio = value / std::f64::consts::PI;
    let (k, n) = [1i64, 2, 3, 4, 5, 6, 8, 9, 10, 12, 16, 18, 20, 24, 36]
        .into_iter()
        .map(|n| ((ratio * n as f64).round(), n))
        .find(|(k, n)| {
            *k != 0.0
                && k.abs() < 1e6
                && (value - k / *n as f64 * std::f64::consts::PI).abs() < 1e-3
        })?;
    let sign = if k < 0.0 { "-" } else { "" };
    let times = if k.abs() == 1.0 {
        "pi".to_owned()
    } else {
        format!("{}*pi", k.abs())
    };
    Some(if n == 1 {
        format!("{sign}{times}")
    } else {
        format!("{sign}{times}/{n}")
    })
}

/// The least common denominator M of all fractions of a turn whose cosine occurs in some numbers, 1 if there is none; and
/// the divisors of the parameters in angles.
pub(super) fn common_turn<'a>(numbers: impl Iterator<Item = &'a Number>) -> (u32, Divisors) {
    let mut lcm = 1u64;
    let mut divisors = Divisors::new();
    for number in numbers.filter(|n| n.size() <= MAX_NODES) {
        let mut stack = vec![number.clone()];
        while let Some(number) = stack.pop() {
            match number.view() {
                View::Sum(a, b) | View::Product(a, b) | View::Quotient(a, b) => {
                    stack.extend([a.clone(), b.clone()]);
                }
                View::Negative(a) | View::Root(a) | View::Power(a, _) => stack.push(a.clone()),
                View::Cosine(a) | View::Sine(a) | View::Tangent(a) => {
                    let View::Angle(angle) = a.view() else {
                        if let Some(sum) = LinearAngle::of(a).filter(|a| !a.multiples.is_empty()) {
                            sum.note(&mut divisors);
                            let (cos, sin) = sum.constant.cos_sin();
                            stack.extend([cos, sin]);
                        }
                        continue;
                    };
                    let needs_sine = !matches!(number.view(), View::Cosine(_));
                    for turn in [
                        Some(turn_of(angle, false)),
                        needs_sine.then(|| turn_of(angle, true)),
                    ]
                    .into_iter()
                    .flatten()
                    .flatten()
                    {
                        let denominator = u64::from(turn.1);
                        lcm = (lcm / gcd(lcm, denominator)).saturating_mul(denominator);
                    }
                }
                _ => {}
            }
        }
    }
    (u32::try_from(lcm).unwrap_or(u32::MAX), divisors)
}

/// k and n with cos(2πk/n) the cosine, or sine, of a fraction of pi; `None` for other angles.
fn turn_of(angle: &Angle, sine: bool) -> Option<(u32, u32)> {
    if angle.parts().len() > 0 {
        return None;
    }
    let mut turn = angle.pi_multiple() * fraction(1, 2);
    if sine {
        turn = fraction(1, 4) - turn;
    }
    turn = &turn - dashu_ratio::RBig::from(turn.floor());
    let numerator = u32::try_from(turn.numerator().clone()).ok()?;
    Some((numerator, u32::try_from(turn.denominator().clone()).ok()?))
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

impl Field {
    /// A number as an element.
    pub(super) fn read(&mut self, number: &Number) -> Result<Element, Obstacle> {
        if number.size() > MAX_NODES {
            return Err(Obstacle::Degree);
        }
        self.read_small(number)
    }

    fn read_small(&mut self, number: &Number) -> Result<Element, Obstacle> {
        Ok(match number.view() {
            View::Rational(x) => Element::rational(x.clone()),
            View::Surd(surd) => {
                let mut sum = Element::zero();
                for (radicand, coefficient) in surd.terms() {
                    let radicand = dashu_ratio::RBig::from(radicand.clone());
                    let root = self.root(&Element::rational(radicand))?;
                    sum = sum.plus(&root.scaled(coefficient));
                }
                sum
            }
            View::Sum(a, b) => self.read_small(a)?.plus(&self.read_small(b)?),
            View::Product(a, b) => {
                let (a, b) = (self.read_small(a)?, self.read_small(b)?);
                self.multiply(&a, &b)
            }
            View::Quotient(a, b) => {
                let (a, b) = (self.read_small(a)?, self.read_small(b)?);
                let inverse = self.inverse(&b)?;
                self.multiply(&a, &inverse)
            }
            View::Negative(a) => self.read_small(a)?.negated(),
            View::Root(a) => {
                let a = self.read_small(a)?;
                self.root(&a)?
            }
            View::Power(a, n) => {
                if n.unsigned_abs() > MAX_POWER {
                    return Err(Obstacle::Degree);
                }
                let a = self.read_small(a)?;
                let a = if n < 0 { self.inverse(&a)? } else { a };
                (0..n.unsigned_abs()).fold(Element::integer(1), |product, _| {
                    self.multiply(&product, &a)
                })
            }
            View::Cosine(a) => self.circular(a, false)?,
            View::Sine(a) => self.circular(a, true)?,
            View::Tangent(a) => {
                let (cosine, sine) = (self.circular(a, false)?, self.circular(a, true)?);
                let inverse = self.inverse(&cosine)?;
                self.multiply(&sine, &inverse)
            }
            View::Parameter(name, value) => self.parameter(name, value),
            View::Angle(_) | View::Other => return Err(Obstacle::Transcendental),
        })
    }

    /// Cosine or sine of a fraction of pi.
    fn circular(&mut self, angle: &Number, sine: bool) -> Result<Element, Obstacle> {
        let View::Angle(angle) = angle.view() else {
            let sum = LinearAngle::of(angle).filter(|sum| !sum.multiples.is_empty());
            let (cosine, sine_of) = self.parametric(&sum.ok_or(Obstacle::Transcendental)?)?;
            return Ok(if sine { sine_of } else { cosine });
        };
        let (k, n) = turn_of(angle, sine).ok_or(Obstacle::Transcendental)?;
        let common = match self.circle {
            Some(common) => common,
            // Without a generator only the rational cosines are left.
            None if circle::totient(n) <= 2 => n,
            None => return Err(Obstacle::Degree),
        };
        if common % n != 0 {
            return Err(Obstacle::Degree);
        }
        Ok(circle::cosine(self, k * (common / n), common))
    }

    /// Cosine and sine of a sum of multiples of parameters, by the addition theorem.
    fn parametric(&mut self, angle: &LinearAngle) -> Result<(Element, Element), Obstacle> {
        let mut point = self.point(&angle.constant)?;
        for (parameter, (multiple, value)) in &angle.multiples {
            let divisor = match self.divisors.get(parameter) {
                Some(divisor) => divisor.clone(),
                None => multiple.denominator().clone(),
            };
            let count = multiple * super::fraction::Fraction::from(divisor.clone());
            let count = i64::try_from(count.numerator().clone()).map_err(|_| Obstacle::Degree)?;
            if count.unsigned_abs() > u64::from(MAX_POWER) {
                return Err(Obstacle::Degree);
            }
            let part = super::fraction::Fraction::from_parts(1.into(), divisor.clone());
            let part = value * &Number::of_fraction(part);
            let name = super::angles::name(parameter, &divisor);
            let (c, s) = self.parametric_point(&name, &part);
            let s = if count < 0 { s.negated() } else { s };
            for _ in 0..count.unsigned_abs() {
                let (x, y) = &point;
                point = (
                    self.multiply(x, &c).minus(&self.multiply(y, &s)),
                    self.multiply(x, &s).plus(&self.multiply(y, &c)),
                );
            }
        }
        Ok(point)
    }

    /// Cosine and sine of an angle.
    pub(super) fn point(&mut self, angle: &Number) -> Result<(Element, Element), Obstacle> {
        let (cosine, sine) = angle.cos_sin();
        Ok((self.read(&cosine)?, self.read(&sine)?))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn number(text: &str) -> Number {
        Number::expression(text, &mut |_| Ok(None)).unwrap()
    }

    fn read(text: &str) -> (Field, Element) {
        let number = number(text);
        let mut field = Field::with_circle(common_turn(std::iter::once(&number)).0).unwrap();
        let element = field.read(&number).unwrap();
        (field, element)
    }

    #[test]
    fn numbers_keep_their_values() {
        for text in [
            "-22/7",
            "sqrt(2) + sqrt(3)/5 - 1/sqrt(6)",
            "cos(pi/8)*sin(pi/8)",
            "sqrt(1 + sqrt(2))/(3 - sqrt(5))",
            "cos(pi/7) - 2*sin(3*pi/7)",
            "tan(pi/9)",
            "sin(acos(1/3))",
            "cos(atan(1/2)/2)**3",
            "sqrt(2 + sqrt(2 + sqrt(2)))",
            "cos(pi/5) + cos(pi/7)",
        ] {
            let (field, element) = read(text);
            let expected = number(text).value();
            let found = field.approximate(&element);
            assert!(
                (found - expected).abs() < 1e-9,
                "{text}: {found} {expected}"
            );
            assert!((field.number(&element) - number(text)).is_zero(), "{text}");
        }
    }

    #[test]
    fn what_is_zero_looks_like_zero() {
        for text in [
            "cos(pi/8)**2 + sin(pi/8)**2 - 1",
            "cos(pi/7) - cos(2*pi/7) + cos(3*pi/7) - 1/2",
            "sqrt(2+sqrt(2))*sqrt(2-sqrt(2)) - sqrt(2)",
            "1/sqrt(1+sqrt(3)) - sqrt((sqrt(3)-1)/2)",
            "cos(pi/9)*cos(2*pi/9)*cos(4*pi/9) - 1/8",
        ] {
            assert!(read(text).1.is_zero(), "{text}");
        }
    }

    #[test]
    fn what_is_not_algebraic_is_refused_with_advice() {
        let mut field = Field::default();
        assert_eq!(field.read(&number("pi")), Err(Obstacle::Transcendental));
        assert_eq!(
            field.point(&number("15708/10000")),
            Err(Obstacle::Transcendental)
        );
        let place = Place::joint("crank", "origin of the predecessor");
        let angle = Number::decimal("1.5708").unwrap();
        let message = place.angle(&angle, Obstacle::Transcendental).to_string();
        assert!(
            message.contains("joint `crank`") && message.contains("write ${pi/2}"),
            "{message}"
        );
        let other = Number::decimal("0.3").unwrap();
        let message = place.angle(&other, Obstacle::Transcendental).to_string();
        assert!(message.contains("acos"), "{message}");
        assert_eq!(near_fraction_of_pi(-2.0944).unwrap(), "-2*pi/3");
    }
}
