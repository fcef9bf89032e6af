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
use super::fraction::{self, Fraction, fraction, inverse, to_rational};
use crate::number::Number;
use dashu::base::SquareRoot;
use dashu::integer::UBig;

/// Most square roots in one field: its degree doubles with each.
const MAX_ROOTS: usize = 10;

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
    roots: usize,
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

    fn push(
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

    fn inverse_of_constant(&self, a: &Element) -> Result<Element, FieldLimit> {
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

    /// The square root that is not negative: in the field where it has one, otherwise adjoined.
    pub(super) fn root(&mut self, a: &Element) -> Result<Element, FieldLimit> {
        if a.is_zero() {
            return Ok(Element::zero());
        }
        let value = self.number(a);
        if value.signum() < 0 {
            return Err(FieldLimit::Negative);
        }
        let parametric = self.is_parametric(a);
        if !parametric && let Some(root) = self.search(a, self.generators.len())? {
            return Ok(self.not_negative(root));
        }
        // With integral coefficients and square factors taken out: a = (h/L)²·radicand.
        let denominator = a.denominator();
        let whole = a.scaled(&Fraction::from(&denominator * &denominator));
        let (outside, _) = split_square(&whole.content());
        let square = Fraction::from(&outside * &outside);
        let radicand = whole.scaled(&inverse(&square));
        let factor = Fraction::from_parts(outside.into(), denominator);
        let known = self.generators.iter().position(
            |g| matches!(&g.relation, Relation::Power { degree: 2, tail } if *tail == radicand),
        );
        let root = match known {
            Some(index) => Element::generator(index),
            None => self.adjoin(radicand, parametric)?,
        };
        Ok(root.scaled(&factor))
    }

    fn adjoin(&mut self, radicand: Element, parametric: bool) -> Result<Element, FieldLimit> {
        if self.roots >= MAX_ROOTS {
            return Err(FieldLimit::Degree);
        }
        self.roots += 1;
        let text = self.text(&radicand);
        let name = if text.len() <= 24 {
            format!("sqrt({text})")
        } else {
            format!("root{}", self.roots)
        };
        let value = self
            .number(&radicand)
            .sqrt()
            .map_err(|_| FieldLimit::Negative)?;
        let relation = Relation::Power {
            degree: 2,
            tail: radicand,
        };
        Ok(self.push(name, value, relation, parametric))
    }

    fn not_negative(&self, root: Element) -> Element {
        let approximate = self.approximate(&root);
        let negative = if approximate.abs() > 1e-6 {
            approximate < 0.0
        } else {
            self.number(&root).signum() < 0
        };
        if negative { root.negated() } else { root }
    }

    /// A square root of a constant in the field of the first `level` generators.
    ///
    /// Over K(v), v² = d: a root of a + b v is r + u v with r² + d u² = a and 2 r u = b. Where b is zero, one of r and u
    /// is; otherwise a² − d b² is the square of some c, and r² = (a ± c)/2 (Borodin, Fagin, Hopcroft, Tompa 1985). In the
    /// field of a fraction of a turn see [`circle::square_root`].
    fn search(&self, a: &Element, level: usize) -> Result<Option<Element>, FieldLimit> {
        // All generators are real, so nothing negative has a root.
        if self.approximate(a) < -1e-6 {
            return Ok(None);
        }
        if level == 0 {
            return Ok(a
                .as_rational()
                .as_ref()
                .and_then(fraction::root)
                .map(Element::rational));
        }
        let top = level - 1;
        let generator = &self.generators[top];
        if generator.parametric {
            return self.search(a, top);
        }
        let Relation::Power { degree, tail } = &generator.relation else {
            return self.search(a, top);
        };
        if *degree != 2 || tail.mentions(top) {
            return match self.circle {
                Some(denominator) => circle::square_root(self, a, denominator),
                None => Err(FieldLimit::Degree),
            };
        }
        let parts = a.by_power(top);
        let even = parts.first().cloned().unwrap_or_default();
        let Some(odd) = parts.get(1) else {
            if let Some(root) = self.search(&even, top)? {
                return Ok(Some(root));
            }
            let quotient = self.multiply(&even, &self.inverse_of_constant(tail)?);
            let root = self.search(&quotient, top)?;
            return Ok(root.map(|r| self.multiply(&r, &Element::generator(top))));
        };
        let norm = self
            .square(&even)
            .minus(&self.multiply(&self.square(odd), tail));
        let Some(c) = self.search(&norm, top)? else {
            return Ok(None);
        };
        let half = fraction(1, 2);
        for c in [c.negated(), c] {
            let square = even.plus(&c).scaled(&half);
            if square.is_zero() {
                continue;
            }
            if let Some(r) = self.search(&square, top)? {
                let u = self
                    .multiply(odd, &self.inverse_of_constant(&r)?)
                    .scaled(&half);
                return Ok(Some(r.plus(&self.multiply(&u, &Element::generator(top)))));
            }
        }
        Ok(None)
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
        crate::algebra::Polynomial::from_terms(terms, count).text(&names)
    }
}

/// `n = outside² · inside`, as far as primes below 1000 and a last look for a square show it.
fn split_square(n: &UBig) -> (UBig, UBig) {
    let mut outside = UBig::ONE;
    let mut inside = n.clone();
    if inside == UBig::ZERO {
        return (outside, inside);
    }
    let mut rest = inside.clone();
    for p in 2u32..1000 {
        let square = UBig::from(p * p);
        while (&inside % &square) == UBig::ZERO {
            inside /= &square;
            outside *= p;
        }
        while (&rest % p) == 0 {
            rest /= p;
        }
    }
    // One more square may hide in what small primes leave.
    let root = rest.sqrt();
    if root > UBig::ONE && &root * &root == rest {
        inside /= &rest;
        outside *= root;
    }
    (outside, inside)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn int(n: i64) -> Element {
        Element::integer(n)
    }

    #[test]
    fn roots_that_are_there_are_not_adjoined_again() {
        let mut field = Field::default();
        let two = field.root(&int(2)).unwrap();
        let three = field.root(&int(3)).unwrap();
        let six = field.root(&int(6)).unwrap();
        assert_eq!(six, field.multiply(&two, &three));
        let twelve = field.root(&int(12)).unwrap();
        assert_eq!(twelve, three.scaled(&Fraction::from(2)));
        // √(5 + 2√6) = √2 + √3.
        let nested = int(5).plus(&six.scaled(&Fraction::from(2)));
        assert_eq!(field.root(&nested).unwrap(), two.plus(&three));
        assert_eq!(field.generators().len(), 2);
    }

    #[test]
    fn sine_and_cosine_of_an_eighth_of_a_half_turn_share_a_root() {
        let mut field = Field::default();
        let two = field.root(&int(2)).unwrap();
        let up = field.root(&int(2).plus(&two)).unwrap();
        let down = field.root(&int(2).minus(&two)).unwrap();
        assert_eq!(field.generators().len(), 2);
        assert_eq!(field.multiply(&up, &down), two);
        let quarter = fraction(1, 4);
        let one = field
            .square(&up)
            .plus(&field.square(&down))
            .scaled(&quarter);
        assert_eq!(one, int(1));
        assert!(field.approximate(&down) > 0.0);
    }

    #[test]
    fn inverses_undo() {
        let mut field = Field::default();
        let two = field.root(&int(2)).unwrap();
        let nested = field.root(&int(3).plus(&two)).unwrap();
        let a = nested.plus(&two).plus(&int(5));
        let inverse = field.inverse(&a).unwrap();
        assert_eq!(field.multiply(&a, &inverse), int(1));
        assert_eq!(field.inverse(&Element::zero()), Err(FieldLimit::Zero));
        let mut circle = Field::with_circle(7).unwrap();
        let a = Element::generator(0).plus(&int(3));
        let inverse = circle.inverse(&a).unwrap();
        assert_eq!(circle.multiply(&a, &inverse), int(1));
    }

    #[test]
    fn fractions_and_hidden_squares_come_out_of_roots() {
        let mut field = Field::default();
        let x = fraction(8, 27);
        let root = field.root(&Element::rational(x.clone())).unwrap();
        assert_eq!(field.square(&root), Element::rational(x));
        assert_eq!(field.generators()[0].name, "sqrt(6)");
        let large = UBig::from(1_000_003u32);
        let three = UBig::from(3u8);
        assert_eq!(split_square(&(&large * &large * &three)), (large, three));
    }

    #[test]
    fn roots_of_three_lie_in_the_field_of_ten_degrees() {
        let mut field = Field::with_circle(36).unwrap();
        let root = field.root(&int(3)).unwrap();
        assert_eq!(field.square(&root), int(3));
        assert_eq!(field.generators().len(), 1, "√3 = 2 cos 30°");
        assert!((field.approximate(&root) - 3f64.sqrt()).abs() < 1e-12);
        let new = field.root(&int(2)).unwrap();
        assert_eq!(field.generators().len(), 2);
        assert_eq!(field.square(&new), int(2));
    }
}
