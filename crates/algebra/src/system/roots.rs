//! Square roots in a field of numbers: found where they are there, adjoined where they are not.

use super::circle;
use super::element::Element;
use super::field::{Field, FieldLimit, Relation};
use super::fraction::{self, Fraction, fraction, inverse};
use dashu_base::SquareRoot;
use dashu_int::UBig;

/// Most square roots in one field: its degree doubles with each.
const MAX_ROOTS: usize = 10;

impl Field {
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
        if !parametric && let Some(root) = self.search(a, self.generators().len())? {
            return Ok(self.not_negative(root));
        }
        // With integral coefficients and square factors taken out: a = (h/L)²·radicand.
        let denominator = a.denominator();
        let whole = a.scaled(&Fraction::from(&denominator * &denominator));
        let (outside, _) = split_square(&whole.content());
        let square = Fraction::from(&outside * &outside);
        let radicand = whole.scaled(&inverse(&square));
        let factor = Fraction::from_parts(outside.into(), denominator);
        let known = self.generators().iter().position(
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
        let generator = &self.generators()[top];
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
