//! The field of some numbers, for whoever writes equations of his own.

use super::element::Element;
use super::field::{Field, Relation};
use super::fraction::to_rational;
use super::numbers::common_turn;
use crate::{Polynomial, Rational};
use kutzbach_math::number::Number;

/// The rationals with what some exact numbers need adjoined: every number has one normal form there, so that equality needs
/// no digits.
#[derive(Clone, Debug, Default)]
pub struct NumberField(Field);

/// An element of a [`NumberField`]; of elements of one field, equal ones look equal.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct FieldElement(Element);

/// What a field has adjoined.
#[derive(Clone, Debug)]
pub struct FieldGenerator {
    /// Its name, such as `sqrt(6)`.
    pub name: String,
    /// Which root of its relation: the real number itself.
    pub value: Number,
    /// A polynomial that vanishes at the generators, in as many variables as there are; it ends in this one.
    pub relation: Polynomial,
}

impl FieldElement {
    /// An integer.
    #[must_use]
    pub fn integer(value: i64) -> Self {
        Self(Element::integer(value))
    }

    /// Whether this is zero: exact.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.is_zero()
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self(self.0.plus(&other.0))
    }

    /// The difference.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        Self(self.0.minus(&other.0))
    }

    /// The terms: exponents of the generators, as many as there are up to the last that occurs, and coefficients.
    #[must_use]
    pub fn terms(&self) -> Vec<(Vec<u32>, Rational)> {
        let term = |(exponents, c): (&Vec<u16>, &super::fraction::Fraction)| {
            (
                exponents.iter().map(|e| u32::from(*e)).collect(),
                to_rational(c),
            )
        };
        self.0.0.iter().map(term).collect()
    }
}

impl NumberField {
    /// A field that can hold these numbers, without anything adjoined yet but the cosine of the common fraction of a turn.
    /// `None` where that has too high a degree.
    #[must_use]
    pub fn of(numbers: &[Number]) -> Option<Self> {
        let (common, divisors) = common_turn(numbers.iter());
        let mut field = Field::with_circle(common).ok()?;
        field.divisors = divisors;
        Some(Self(field))
    }

    /// A number as an element; `None` where nothing shows that it is algebraic, the degree would be too high, or it has a
    /// parameter.
    pub fn read(&mut self, number: &Number) -> Option<FieldElement> {
        let element = self.0.read(number).ok()?;
        (!self.0.has_parameters()).then_some(FieldElement(element))
    }

    /// The product.
    #[must_use]
    pub fn times(&self, a: &FieldElement, b: &FieldElement) -> FieldElement {
        FieldElement(self.0.multiply(&a.0, &b.0))
    }

    /// One over an element; `None` for zero.
    #[must_use]
    pub fn inverse(&self, a: &FieldElement) -> Option<FieldElement> {
        if a.is_zero() {
            return None;
        }
        self.0.inverse_of_constant(&a.0).ok().map(FieldElement)
    }

    /// The real value, exact.
    #[must_use]
    pub fn number(&self, a: &FieldElement) -> Number {
        self.0.number(&a.0)
    }

    /// What is adjoined, in order.
    #[must_use]
    pub fn generators(&self) -> Vec<FieldGenerator> {
        let generators = self.0.generators();
        let count = generators.len();
        let polynomial = |element: &Element| {
            let terms = FieldElement(element.clone()).terms().into_iter();
            let full = terms.map(|(mut e, c)| {
                e.resize(count, 0);
                (e, c)
            });
            Polynomial::from_terms(full.collect(), count)
        };
        let relation = |index: usize| match &generators[index].relation {
            Relation::Power { degree, tail } => {
                let power = Polynomial::variable(index, count).power(u32::from(*degree));
                &power - &polynomial(tail)
            }
            // Neither occurs without parameters.
            Relation::Free | Relation::Inverse(_) => Polynomial::zero(count),
        };
        let generator = |(index, g): (usize, &super::field::Generator)| FieldGenerator {
            name: g.name.clone(),
            value: g.value.clone(),
            relation: relation(index),
        };
        generators.iter().enumerate().map(generator).collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn number(text: &str) -> Number {
        Number::expression(text, &mut |_| Ok(None)).unwrap()
    }

    #[test]
    fn generators_satisfy_their_relations() {
        let numbers = [number("cos(pi/5)"), number("sqrt(6)"), number("sin(pi/5)")];
        let mut field = NumberField::of(&numbers).unwrap();
        let elements: Vec<FieldElement> = numbers.iter().map(|n| field.read(n).unwrap()).collect();
        for (number, element) in numbers.iter().zip(&elements) {
            assert!((field.number(element) - number.clone()).is_zero());
        }
        let squares = [&elements[0], &elements[2]].map(|x| field.times(x, x));
        assert_eq!(squares[0].plus(&squares[1]), FieldElement::integer(1));
        let generators = field.generators();
        let values: Vec<f64> = generators.iter().map(|g| g.value.value()).collect();
        for generator in &generators {
            let sum: f64 = generator
                .relation
                .terms()
                .map(|(e, c)| {
                    let c = num_traits::ToPrimitive::to_f64(c).unwrap();
                    e.iter()
                        .zip(&values)
                        .fold(c, |t, (e, v)| t * v.powi(*e as i32))
                })
                .sum();
            assert!(sum.abs() < 1e-12, "{}", generator.name);
        }
        assert!(field.read(&Number::pi()).is_none());
    }
}
