//! From polynomials over a number field to polynomials over the rationals, the field's generators being variables.

use super::build::{Construction, Draft, cycle_equations};
use super::element::Element;
use super::field::{Field, Relation};
use super::fraction::{Fraction, lcm, size, to_rational};
use super::home::HomePose;
use super::poly::Poly;
use super::variables::{Meaning, Variable};
use super::{Equation, Origin, PolynomialSystem};
use crate::{Polynomial, Rational};
use dashu_base::Gcd;
use dashu_int::UBig;
use num_traits::Signed;
use std::collections::BTreeSet;

/// The generators that some polynomials need, by index, those in relations included; no quotients, which are cleared.
fn needed_generators(field: &Field, equations: &[(Poly, Origin)]) -> Vec<usize> {
    let count = field.generators().len();
    let mut needed = vec![false; count];
    let mut mark = |element: &Element| {
        for (index, flag) in needed.iter_mut().enumerate() {
            *flag |= element.mentions(index);
        }
    };
    for (poly, _) in equations {
        poly.terms().for_each(|(_, coefficient)| mark(coefficient));
    }
    for index in (0..count).rev() {
        if !needed[index] {
            continue;
        }
        let relation = match &field.generators()[index].relation {
            Relation::Power { tail, .. } => tail,
            Relation::Inverse(of) => of,
            Relation::Free => continue,
        };
        for (other, flag) in needed.iter_mut().enumerate().take(index) {
            *flag |= relation.mentions(other);
        }
    }
    (0..count).filter(|&index| needed[index]).collect()
}

/// Places of unknowns and generators in the ring of all variables.
struct Ring<'a> {
    field: &'a Field,
    unknowns: usize,
    /// Every needed generator in order, quotients included.
    generators: Vec<usize>,
}

impl Ring<'_> {
    fn size(&self) -> usize {
        self.unknowns + self.generators.len()
    }

    fn place(&self, generator: usize) -> Option<usize> {
        self.generators
            .iter()
            .position(|g| *g == generator)
            .map(|place| self.unknowns + place)
    }

    fn term(&self, unknowns: &[u16], element: &Element, terms: &mut Vec<(Vec<u32>, Fraction)>) {
        for (exponents, coefficient) in &element.0 {
            let mut full = vec![0u32; self.size()];
            for (place, e) in full.iter_mut().zip(unknowns) {
                *place = u32::from(*e);
            }
            for (generator, e) in exponents.iter().enumerate().filter(|(_, e)| **e > 0) {
                if let Some(place) = self.place(generator) {
                    full[place] = u32::from(*e);
                }
            }
            terms.push((full, coefficient.clone()));
        }
    }

    /// With coprime integers for coefficients.
    fn polynomial(&self, poly: &Poly) -> Polynomial {
        let mut terms = Vec::new();
        for (unknowns, coefficient) in poly.terms() {
            self.term(unknowns, coefficient, &mut terms);
        }
        let denominator = terms
            .iter()
            .fold(UBig::ONE, |all, (_, c)| lcm(&all, c.denominator()));
        let whole = Fraction::from(denominator);
        let content = terms.iter().fold(UBig::ZERO, |all, (_, c)| {
            let c = size(&(c * &whole));
            if all == UBig::ZERO { c } else { all.gcd(&c) }
        });
        if content == UBig::ZERO {
            return Polynomial::zero(self.size());
        }
        let scale = whole / Fraction::from(content);
        let terms = terms
            .into_iter()
            .map(|(e, c)| (e, to_rational(&(c * &scale))))
            .collect();
        Polynomial::from_terms(terms, self.size())
    }

    fn element(&self, element: &Element) -> Polynomial {
        let mut terms = Vec::new();
        self.term(&[], element, &mut terms);
        let terms = terms.into_iter().map(|(e, c)| (e, to_rational(&c)));
        Polynomial::from_terms(terms.collect(), self.size())
    }

    /// Multiplied by denominators until no quotient is left: Σ aₖ wᵏ with w d = 1 times dⁿ is Σ aₖ dⁿ⁻ᵏ.
    fn cleared(&self, polynomial: Polynomial) -> Polynomial {
        let mut result = polynomial;
        // A quotient may hold earlier ones: the last is cleared first.
        for &generator in self.generators.iter().rev() {
            let Relation::Inverse(of) = &self.field.generators()[generator].relation else {
                continue;
            };
            let Some(place) = self.place(generator) else {
                continue;
            };
            let highest = result.degree_in(place);
            if highest == 0 {
                continue;
            }
            let divisor = self.element(of);
            let mut sum = Polynomial::zero(self.size());
            for power in 0..=highest {
                let terms = result
                    .terms()
                    .filter(|(e, _)| e[place] == power)
                    .map(|(e, c)| {
                        let mut rest = e.to_vec();
                        rest[place] = 0;
                        (rest, c.clone())
                    })
                    .collect();
                let part = Polynomial::from_terms(terms, self.size());
                sum = &sum + &(&part * &divisor.power(highest - power));
            }
            result = sum;
        }
        result
    }
}

/// The system over the rationals, its home pose not yet looked at.
pub(super) fn system(
    draft: Draft,
    mut construction: Construction,
    joint_variables: Vec<Vec<usize>>,
    charts: Vec<String>,
) -> PolynomialSystem {
    let Draft {
        names,
        equations,
        relaxations,
        cycles,
    } = draft;
    let field = &construction.field;
    let ring = Ring {
        field,
        unknowns: names.variables.len(),
        generators: needed_generators(field, &equations),
    };
    let is_quotient =
        |generator: usize| matches!(field.generators()[generator].relation, Relation::Inverse(_));
    // Quotients are cleared, so that the final ring has no place for them.
    let kept: Vec<usize> = ring
        .generators
        .iter()
        .copied()
        .filter(|&g| !is_quotient(g))
        .collect();
    let mut names = names;
    let mut places: Vec<usize> = (0..ring.unknowns).collect();
    for &generator in &ring.generators {
        if is_quotient(generator) {
            // No term mentions it any more.
            places.push(0);
            continue;
        }
        let g = &field.generators()[generator];
        let meaning = match g.of_angle || matches!(g.relation, Relation::Free) {
            true => Meaning::Parameter {
                value: g.value.clone(),
            },
            false => Meaning::Algebraic {
                value: g.value.clone(),
            },
        };
        places.push(names.add(g.name.clone(), meaning));
    }
    let variables: Vec<Variable> = names.variables;
    let count = variables.len();
    let has_quotients = kept.len() < ring.generators.len();
    let finish = |polynomial: Polynomial| {
        if has_quotients {
            return ring.cleared(polynomial).moved(&places, count).primitive();
        }
        // The coefficients are coprime integers already; a search for a common divisor of long ones is slow there.
        let moved = polynomial.moved(&places, count);
        let negative = moved.terms().next().is_some_and(|(_, c)| c.is_negative());
        if negative { -&moved } else { moved }
    };
    let mut result: Vec<Equation> = Vec::new();
    let mut seen: BTreeSet<Vec<(Vec<u32>, Rational)>> = BTreeSet::new();
    let mut add = |polynomial: Polynomial, origin: Origin| {
        let key: Vec<(Vec<u32>, Rational)> = polynomial
            .terms()
            .map(|(e, c)| (e.to_vec(), c.clone()))
            .collect();
        if !key.is_empty() && seen.insert(key) {
            result.push(Equation { polynomial, origin });
        }
    };
    for (poly, origin) in &equations {
        add(finish(ring.polynomial(poly)), *origin);
    }
    let mut nonzero = Vec::new();
    for &generator in &ring.generators {
        match &field.generators()[generator].relation {
            Relation::Free => {}
            Relation::Inverse(of) => {
                let divisor = finish(ring.element(of)).primitive();
                if !nonzero.contains(&divisor) {
                    nonzero.push(divisor);
                }
            }
            Relation::Power { degree, tail } => {
                let Some(place) = ring.place(generator) else {
                    continue;
                };
                let power = Polynomial::variable(place, ring.size()).power(u32::from(*degree));
                let variable = places[place];
                let origin = match variables[variable].meaning {
                    Meaning::Parameter { .. } => Origin::Parameter { variable },
                    _ => Origin::MinimalPolynomial { variable },
                };
                add(finish(&power - &ring.element(tail)).primitive(), origin);
            }
        }
    }
    construction.generators = kept;
    let mut system = PolynomialSystem {
        variables,
        equations: result,
        nonzero,
        cycles: Vec::new(),
        joint_variables,
        charts,
        relaxations,
        rounded_numbers: false,
        home: HomePose::Unknown,
        construction,
    };
    system.cycles = cycles
        .into_iter()
        .enumerate()
        .map(|(index, joints)| cycle_equations(joints, index, &system))
        .collect();
    system
}
