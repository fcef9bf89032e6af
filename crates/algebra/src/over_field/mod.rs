//! Equations over a number field: as equations over the rationals, with the numbers adjoined as further unknowns, and their real
//! solutions at the numbers meant.
//!
//! A root of a polynomial cannot be told from its conjugates by equations. So solutions are found at all conjugates, and those
//! are kept at which every adjoined number is the one meant.

mod polynomial;

pub use polynomial::FieldPolynomial;

use crate::components::{AlgebraicNumber, Hints, RealPoints, components};
use crate::engine::{Budget, MonomialOrder, Stop, groebner_basis};
use crate::system::NumberField;
use crate::zero_dimensional::FinitePoints;
use crate::{Polynomial, Rational};
use kutzbach_math::number::Number;

/// Bits to which solutions are enclosed.
const BITS: u64 = 64;

/// An adjoined number that a solution has within this share is the one meant...
const MEANT: f64 = 1e-12;

/// ...and farther away than this it is a conjugate; between the two nothing is claimed.
const CONJUGATE: f64 = 1e-6;

/// Solutions closer than this in every unknown are one: they are enclosed to 64 bits.
const SAME: f64 = 1e-12;

/// A system over the rationals: what its numbers adjoin are unknowns as well.
#[derive(Clone, Debug)]
pub struct OverRationals {
    /// The equations' left sides, then the relations of the numbers adjoined.
    pub polynomials: Vec<Polynomial>,
    /// How many unknowns there are; adjoined numbers follow them.
    pub unknowns: usize,
    /// Which unknown each adjoined number is, and its value.
    pub numbers: Vec<(usize, Number)>,
    /// The degree over the rationals of the field of these numbers.
    pub degree: usize,
}

/// The real solutions of a system.
#[derive(Clone, Debug)]
pub enum RealSet {
    /// Finitely many over the complex numbers: how many of these, and all real ones.
    Finite {
        /// Solutions over the complex numbers, each counted as often as it is one: the dimension of the algebra of the equations
        /// over the field, which is that over the rationals divided by the degree of the field.
        complex: usize,
        /// The unknowns of each real solution, and how often it counts.
        real: Vec<(Vec<f64>, usize)>,
    },
    /// An irreducible component of this dimension has real points all over.
    Dimension(usize),
    /// Infinitely many complex solutions, or one whose adjoined numbers are not clearly those meant; of the real ones
    /// nothing is known.
    Unclear,
}

impl OverRationals {
    /// The equations `polynomials = 0` in so many unknowns. Numbers of the field that they do not need are left out.
    #[must_use]
    pub fn new(polynomials: &[FieldPolynomial], unknowns: usize, field: &NumberField) -> Self {
        let generators = field.generators();
        let count = unknowns + generators.len();
        let mut used = vec![false; generators.len()];
        let terms = |poly: &FieldPolynomial| {
            let mut terms: Vec<(Vec<u32>, Rational)> = Vec::new();
            for (exponents, coefficient) in poly.terms() {
                for (of_field, c) in coefficient.terms() {
                    let mut full: Vec<u32> = exponents.iter().map(|&e| u32::from(e)).collect();
                    full.resize(unknowns, 0);
                    full.extend(of_field);
                    full.resize(count, 0);
                    terms.push((full, c));
                }
            }
            Polynomial::from_terms(terms, count)
        };
        let mut all: Vec<Polynomial> = polynomials.iter().map(terms).collect();
        let mark = |polynomial: &Polynomial, used: &mut Vec<bool>| {
            for (g, flag) in used.iter_mut().enumerate() {
                *flag |= polynomial.mentions(unknowns + g);
            }
        };
        all.iter().for_each(|p| mark(p, &mut used));
        let relation = |g: usize| {
            let places: Vec<usize> = (unknowns..count).collect();
            generators[g].relation.moved(&places, count)
        };
        for g in (0..generators.len()).rev() {
            if used[g] {
                mark(&relation(g), &mut used);
            }
        }
        let kept: Vec<usize> = (0..generators.len()).filter(|&g| used[g]).collect();
        all.extend(kept.iter().map(|&g| relation(g)));
        let mut places: Vec<usize> = (0..count).collect();
        for (g, flag) in used.iter().enumerate() {
            if !flag {
                places[unknowns + g] = 0;
            }
        }
        for (place, &g) in kept.iter().enumerate() {
            places[unknowns + g] = unknowns + place;
        }
        let size = unknowns + kept.len();
        let degree = |&g: &usize| relation(g).degree_in(unknowns + g) as usize;
        let degree = kept.iter().map(degree).product();
        let moved = all.iter().map(|p| p.moved(&places, size).primitive());
        let number = |(place, &g): (usize, &usize)| (unknowns + place, generators[g].value.clone());
        Self {
            polynomials: moved.collect(),
            unknowns,
            numbers: kept.iter().enumerate().map(number).collect(),
            degree,
        }
    }

    /// Unknowns and adjoined numbers.
    #[must_use]
    pub fn variables(&self) -> usize {
        self.unknowns + self.numbers.len()
    }

    /// Where each adjoined number is: within 2⁻³⁰ of its size.
    #[must_use]
    pub fn roots(&self) -> Vec<AlgebraicNumber> {
        let bound = |x: f64| Rational::from_float(x);
        let enclosed = |(variable, number): &(usize, Number)| {
            let value = number.value();
            let margin = value.abs().max(1.0) * 2f64.powi(-30);
            Some(AlgebraicNumber {
                variable: *variable,
                low: bound(value - margin)?,
                high: bound(value + margin)?,
            })
        };
        self.numbers.iter().filter_map(enclosed).collect()
    }

    /// All real solutions. `canonical` brings the unknowns of a solution into the form in which equal ones are equal (of a
    /// rotation the quaternion of one sign); solutions that are equal then are one.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn real_set(
        &self,
        canonical: impl Fn(&[f64]) -> Vec<f64>,
        budget: &Budget,
    ) -> Result<RealSet, Stop> {
        let count = self.variables();
        let basis = groebner_basis(&self.polynomials, count, &MonomialOrder::Degrevlex, budget)?;
        match basis.dimension() {
            None => {
                return Ok(RealSet::Finite {
                    complex: 0,
                    real: Vec::new(),
                });
            }
            Some(0) => {}
            Some(_) => return self.of_positive_dimension(budget),
        }
        let Some(points) = FinitePoints::new(&basis, budget)? else {
            return Ok(RealSet::Unclear);
        };
        let mut real: Vec<(Vec<f64>, usize)> = Vec::new();
        for solution in points.real_solutions(BITS, budget)? {
            let values = solution.values();
            let Some(meant) = self.is_meant(&values) else {
                return Ok(RealSet::Unclear);
            };
            if !meant {
                continue;
            }
            let unknowns = canonical(&values[..self.unknowns]);
            let same = |(other, _): &(Vec<f64>, usize)| {
                let far = other.iter().zip(&unknowns).map(|(a, b)| (a - b).abs());
                far.fold(0.0, f64::max) < SAME
            };
            if !real.iter().any(same) {
                real.push((unknowns, solution.multiplicity as usize));
            }
        }
        Ok(RealSet::Finite {
            complex: points.multiplicity() / self.degree,
            real,
        })
    }

    /// Whether the adjoined numbers of a solution are those meant; `None` where that is not clear.
    fn is_meant(&self, values: &[f64]) -> Option<bool> {
        let mut meant = true;
        for (variable, number) in &self.numbers {
            let value = number.value();
            let off = (values[*variable] - value).abs() / value.abs().max(1.0);
            if off > MEANT && off < CONJUGATE {
                return None;
            }
            meant &= off <= MEANT;
        }
        Some(meant)
    }

    fn of_positive_dimension(&self, budget: &Budget) -> Result<RealSet, Stop> {
        let hints = Hints {
            angles: Vec::new(),
            numbers: self.roots(),
            points: Vec::new(),
        };
        let found = components(&self.polynomials, self.variables(), &hints, budget)?;
        let real = found.pieces.iter();
        let real = real
            .filter(|piece| piece.dimension > 0 && piece.real == RealPoints::FullDimension)
            .map(|piece| piece.dimension)
            .max();
        Ok(real.map_or(RealSet::Unclear, RealSet::Dimension))
    }
}
