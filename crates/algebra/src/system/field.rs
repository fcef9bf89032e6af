//! The field that a mechanism's numbers lie in: the rationals with roots and cosines adjoined one after the other.
//!
//! Every generator is a root of a polynomial over the field before it, and an element is a polynomial in the generators
//! below those degrees. As long as each of these polynomials is irreducible where it is adjoined, an element is zero only
//! if it has no terms: equality needs no digits. So before a root `v² = t` is adjoined it is decided whether `t` has a root
//! in the field already (`search`), and all fractions of a turn share one generator `2 cos(2π/M)`.
//!
//! Parameters are generators without a relation. A quotient by something that holds a parameter is a generator `w` with
//! `w·d = 1`; the equations are cleared of it at the end.

use super::angles::Divisors;
use super::circle;
use super::element::{Element, Exponents, product, trim};
use super::fraction::{self, Fraction, inverse, to_rational};
use kutzbach_math::number::Number;

/// Why a field cannot hold what is asked of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum FieldLimit {
    /// Too many roots, or a fraction of a turn of too high a degree.
    Degree,
    /// The square root of something that is negative.
    Negative,
    /// A division by zero.
    Zero,
}

/// What a generator satisfies.
#[derive(Clone, Debug)]
pub(super) enum Relation {
    /// The power `degree` equals a polynomial of lower degree over the field before.
    Power {
        /// Degree of the minimal polynomial.
        degree: u16,
        /// What that power equals.
        tail: Element,
    },
    /// Nothing: a parameter.
    Free,
    /// The product with this element is one.
    Inverse(Element),
}

/// One generator of a field.
#[derive(Clone, Debug)]
pub(super) struct Generator {
    pub(super) name: String,
    pub(super) value: Number,
    pub(super) relation: Relation,
    /// Whether it depends on a parameter.
    pub(super) parametric: bool,
    /// Whether it is the cosine or sine of an angle that is a parameter.
    pub(super) of_angle: bool,
    approximate: f64,
}

/// The rationals with generators adjoined; grows as numbers are read.
#[derive(Clone, Debug, Default)]
pub(super) struct Field {
    generators: Vec<Generator>,
    /// M where generator 0 is 2 cos(2π/M).
    pub(super) circle: Option<u32>,
    /// By which parameters are divided in angles.
    pub(super) divisors: Divisors,
    /// Number of square roots adjoined.
    pub(super) roots: usize,
}

impl Field {
    pub(super) fn generators(&self) -> &[Generator] {
        &self.generators
    }

    /// The field with 2 cos(2π/M) where that is not rational. It has to be the first generator.
    pub(super) fn with_circle(denominator: u32) -> Result<Self, FieldLimit> {
        let mut field = Self::default();
        let minimal = circle::minimal_polynomial(denominator).ok_or(FieldLimit::Degree)?;
        if minimal.len() <= 2 {
            return Ok(field);
        }
        let degree = minimal.len() - 1;
        let mut tail = Element::zero();
        for (power, coefficient) in minimal[..degree].iter().enumerate() {
            let mut exponents = vec![power as u16];
            trim(&mut exponents);
            tail.add_term(exponents, -Fraction::from(coefficient.clone()));
        }
        let value = Number::integer(2) * circle::cosine_of_turn(1, denominator);
        field.circle = Some(denominator);
        field.push(
            format!("2cos(2pi/{denominator})"),
            value,
            Relation::Power {
                degree: degree as u16,
                tail,
            },
            false,
        );
        Ok(field)
    }

    pub(super) fn push(
        &mut self,
        name: String,
        value: Number,
        relation: Relation,
        parametric: bool,
    ) -> Element {
        let index = self.generators.len();
        let taken = |name: &str| self.generators.iter().any(|g| g.name == name);
        let mut name = name;
        while taken(&name) {
            name.push('\'');
        }
        self.generators.push(Generator {
            name,
            approximate: value.value(),
            value,
            relation,
            parametric,
            of_angle: false,
        });
        Element::generator(index)
    }

    /// A generator without a relation.
    pub(super) fn parameter(&mut self, name: &str, value: &Number) -> Element {
        let known = self
            .generators
            .iter()
            .position(|g| matches!(g.relation, Relation::Free) && g.name == name);
        match known {
            Some(index) => Element::generator(index),
            None => self.push(name.to_owned(), value.clone(), Relation::Free, true),
        }
    }

    /// Cosine and sine of an angle that is a parameter: two generators on a circle.
    pub(super) fn parametric_point(&mut self, angle: &str, value: &Number) -> (Element, Element) {
        let (cos, sin) = value.cos_sin();
        let c = self.parameter(&format!("cos({angle})"), &cos);
        let name = format!("sin({angle})");
        if let Some(index) = self.generators.iter().position(|g| g.name == name) {
            return (c, Element::generator(index));
        }
        let tail = Element::integer(1).minus(&self.multiply(&c, &c));
        let s = self.push(name, sin, Relation::Power { degree: 2, tail }, true);
        for generator in self.generators.iter_mut().rev().take(2) {
            generator.of_angle = true;
        }
        (c, s)
    }

    /// Whether any parameter has been met.
    pub(super) fn has_parameters(&self) -> bool {
        self.generators.iter().any(|g| g.parametric)
    }

    /// Elements without parameters in place of all generators: the parameters at their values in the file. `None` where
    /// such a value is not algebraic.
    pub(super) fn at_values(&mut self) -> Option<Vec<Element>> {
        let mut values = Vec::with_capacity(self.generators.len());
        for index in 0..self.generators.len() {
            let generator = self.generators[index].clone();
            values.push(match &generator.relation {
                _ if !generator.parametric => Element::generator(index),
                Relation::Inverse(of) => {
                    let of = self.substitute(of, &values);
                    self.inverse(&of).ok()?
                }
                Relation::Power { tail, .. } if !generator.of_angle => {
                    let tail = self.substitute(tail, &values);
                    self.root(&tail).ok()?
                }
                _ => self.read(&generator.value).ok()?,
            });
        }
        Some(values)
    }

    /// An element with others in place of the generators.
    pub(super) fn substitute(&self, a: &Element, values: &[Element]) -> Element {
        let mut sum = Element::zero();
        for (exponents, coefficient) in &a.0 {
            let mut term = Element::rational(coefficient.clone());
            for (value, &exponent) in values.iter().zip(exponents) {
                for _ in 0..exponent {
                    term = self.multiply(&term, value);
                }
            }
            sum = sum.plus(&term);
        }
        sum
    }

    /// Whether an element depends on a parameter.
    pub(super) fn is_parametric(&self, a: &Element) -> bool {
        self.generators
            .iter()
            .enumerate()
            .any(|(index, g)| g.parametric && a.mentions(index))
    }

    /// The product in normal form.
    pub(super) fn multiply(&self, a: &Element, b: &Element) -> Element {
        let mut result = Element::zero();
        for (x, c) in &a.0 {
            for (y, d) in &b.0 {
                result.add_term(product(x, y), c * d);
            }
        }
        self.reduce(result)
    }

    pub(super) fn square(&self, a: &Element) -> Element {
        self.multiply(a, a)
    }

    /// Replaces powers by the generators' relations, the last generator first.
    fn reduce(&self, a: Element) -> Element {
        let mut result = a;
        for index in (0..self.generators.len()).rev() {
            let Relation::Power { degree, tail } = &self.generators[index].relation else {
                continue;
            };
            loop {
                let high: Vec<(Exponents, Fraction)> = result
                    .0
                    .iter()
                    .filter(|(e, _)| e.get(index).is_some_and(|e| e >= degree))
                    .map(|(e, c)| (e.clone(), c.clone()))
                    .collect();
                if high.is_empty() {
                    break;
                }
                for (mut exponents, coefficient) in high {
                    result.0.remove(&exponents);
                    exponents[index] -= degree;
                    trim(&mut exponents);
                    for (e, c) in &tail.0 {
                        result.add_term(product(&exponents, e), &coefficient * c);
                    }
                }
            }
        }
        result
    }

    /// One over an element.
    pub(super) fn inverse(&mut self, a: &Element) -> Result<Element, FieldLimit> {
        if a.is_zero() {
            return Err(FieldLimit::Zero);
        }
        if self.is_parametric(a) {
            return Ok(self.quotient_generator(a));
        }
        self.inverse_of_constant(a)
    }

    pub(super) fn inverse_of_constant(&self, a: &Element) -> Result<Element, FieldLimit> {
        if let Some(x) = a.as_rational() {
            return Ok(Element::rational(inverse(&x)));
        }
        let top = a.level() - 1;
        let Relation::Power { degree, tail } = &self.generators[top].relation else {
            return Err(FieldLimit::Degree);
        };
        if *degree == 2 && !tail.mentions(top) {
            // 1/(a + b v) = (a − b v)/(a² − b² v²).
            let parts = a.by_power(top);
            let generator = Element::generator(top);
            let odd = self.multiply(&parts[1], &generator);
            let conjugate = parts[0].minus(&odd);
            let norm = self.multiply(a, &conjugate);
            let inverse = self.inverse_of_constant(&norm)?;
            return Ok(self.multiply(&conjugate, &inverse));
        }
        self.inverse_by_elimination(a, usize::from(*degree))
    }

    /// In the field of one generator: the coefficients of the inverse solve a linear system.
    fn inverse_by_elimination(&self, a: &Element, degree: usize) -> Result<Element, FieldLimit> {
        let coefficient = |x: &Element, power: usize| {
            let mut exponents = vec![power as u16];
            trim(&mut exponents);
            x.0.get(&exponents).cloned().unwrap_or(Fraction::ZERO)
        };
        // Column j holds a·gʲ; the last column is 1.
        let mut rows = vec![vec![Fraction::ZERO; degree + 1]; degree];
        let mut column = a.clone();
        let generator = Element::generator(0);
        for j in 0..degree {
            for (i, row) in rows.iter_mut().enumerate() {
                row[j] = coefficient(&column, i);
            }
            column = self.multiply(&column, &generator);
        }
        rows[0][degree] = Fraction::ONE;
        for pivot in 0..degree {
            let found = (pivot..degree).find(|&i| !rows[i][pivot].is_zero());
            rows.swap(pivot, found.ok_or(FieldLimit::Zero)?);
            let lead = inverse(&rows[pivot][pivot]);
            rows[pivot].iter_mut().for_each(|x| *x *= &lead);
            let pivot_row = rows[pivot].clone();
            for (i, row) in rows.iter_mut().enumerate() {
                if i != pivot && !row[pivot].is_zero() {
                    let factor = row[pivot].clone();
                    for (x, y) in row.iter_mut().zip(&pivot_row) {
                        *x -= &factor * y;
                    }
                }
            }
        }
        let mut result = Element::zero();
        for (power, row) in rows.iter().enumerate() {
            let mut exponents = vec![power as u16];
            trim(&mut exponents);
            result.add_term(exponents, row[degree].clone());
        }
        Ok(result)
    }

    /// A generator whose product with an element is one.
    fn quotient_generator(&mut self, a: &Element) -> Element {
        let known = self
            .generators
            .iter()
            .position(|g| matches!(&g.relation, Relation::Inverse(d) if d == a));
        if let Some(index) = known {
            return Element::generator(index);
        }
        let value = Number::one()
            .checked_div(&self.number(a))
            .unwrap_or_else(|_| Number::zero());
        let name = format!("1/({})", self.text(a));
        self.push(name, value, Relation::Inverse(a.clone()), true)
    }

    /// The real value, exact.
    pub(super) fn number(&self, a: &Element) -> Number {
        let mut sum = Number::zero();
        for (exponents, coefficient) in &a.0 {
            let mut term = Number::of_fraction(coefficient.clone());
            for (generator, &exponent) in self.generators.iter().zip(exponents) {
                for _ in 0..exponent {
                    term = &term * &generator.value;
                }
            }
            sum = &sum + &term;
        }
        sum
    }

    /// The real value in doubles.
    pub(super) fn approximate(&self, a: &Element) -> f64 {
        if let Some(x) = a.as_rational() {
            return fraction::to_f64(&x);
        }
        let values: Vec<f64> = self.generators.iter().map(|g| g.approximate).collect();
        a.approximate(&values)
    }

    /// The element as text, with the generators' names.
    pub(super) fn text(&self, a: &Element) -> String {
        let names: Vec<String> = self.generators.iter().map(|g| g.name.clone()).collect();
        let count = names.len();
        let terms =
            a.0.iter()
                .map(|(exponents, coefficient)| {
                    let mut full: Vec<u32> = exponents.iter().map(|e| u32::from(*e)).collect();
                    full.resize(count, 0);
                    (full, to_rational(coefficient))
                })
                .collect();
        crate::Polynomial::from_terms(terms, count).text(&names)
    }
}
