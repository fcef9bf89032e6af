//! The system as polynomials over the rationals, for the exact solver and for other programs.

use super::{Poly, ReducedSystem};
use kutzbach_algebra::{AlgebraicNumber, Polynomial, Rational};
use kutzbach_math::number::Number;
use std::fmt::Write;

/// A reduced system over the rationals: what its numbers adjoin are unknowns as well.
#[derive(Clone, Debug)]
pub struct Exported {
    /// Names of the unknowns, then of the numbers adjoined.
    pub names: Vec<String>,
    /// The equations' left sides.
    pub polynomials: Vec<Polynomial>,
    /// How many of the names are unknowns of the mechanism.
    pub unknowns: usize,
    /// Which root each number is.
    pub numbers: Vec<(usize, Number)>,
}

impl Exported {
    pub(super) fn new(system: &ReducedSystem) -> Self {
        let unknowns = system.unknown_count();
        let generators = system.field.generators();
        let mut polynomials: Vec<Poly> = system
            .closures
            .iter()
            .map(|c| c.polynomial.clone())
            .collect();
        polynomials.extend(system.unknowns.iter().map(|u| u.relation(&system.field)));
        let count = unknowns + generators.len();
        let mut used = vec![false; generators.len()];
        let terms = |poly: &Poly| {
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
        // Numbers that nothing mentions are left out.
        let mut places: Vec<usize> = (0..count).collect();
        for (place, &g) in kept.iter().enumerate() {
            places[unknowns + g] = unknowns + place;
        }
        let size = unknowns + kept.len();
        for (g, flag) in used.iter().enumerate() {
            if !flag {
                places[unknowns + g] = 0;
            }
        }
        let polynomials = all
            .iter()
            .map(|p| p.moved(&places, size).primitive())
            .collect();
        let mut names = Vec::new();
        for (number, turn) in system.unknowns.iter().enumerate() {
            let letters: &[&str] = if turn.count() == 2 {
                &["x", "y"]
            } else {
                &["q", "i", "j", "k"]
            };
            names.extend(
                letters
                    .iter()
                    .map(|letter| format!("{letter}{}", number + 1)),
            );
        }
        names.extend((0..kept.len()).map(|g| format!("g{}", g + 1)));
        Self {
            names,
            polynomials,
            unknowns,
            numbers: kept
                .iter()
                .enumerate()
                .map(|(place, &g)| (unknowns + place, generators[g].value.clone()))
                .collect(),
        }
    }

    /// Where each adjoined number is, for the exact solver: within 2⁻³⁰ of its size.
    #[must_use]
    pub fn roots(&self) -> Vec<AlgebraicNumber> {
        let bound = |x: f64| Rational::from_float(x);
        self.numbers
            .iter()
            .filter_map(|(variable, number)| {
                let value = number.value();
                let margin = value.abs().max(1.0) * 2f64.powi(-30);
                Some(AlgebraicNumber {
                    variable: *variable,
                    low: bound(value - margin)?,
                    high: bound(value + margin)?,
                })
            })
            .collect()
    }

    /// As a program for Singular: the ring, the ideal `I`, its dimension and degree.
    #[must_use]
    pub fn singular(&self) -> String {
        let mut text = format!("ring r = 0,({}),dp;\nideal I =\n", self.names.join(","));
        text.push_str(&self.listed());
        text.push_str(";\nideal G = std(I);\ndim(G);\nmult(G);\n");
        text
    }

    /// As a file for msolve.
    #[must_use]
    pub fn msolve(&self) -> String {
        format!("{}\n0\n{}\n", self.names.join(","), self.listed())
    }

    fn listed(&self) -> String {
        let mut text = String::new();
        for (index, polynomial) in self.polynomials.iter().enumerate() {
            let end = if index + 1 < self.polynomials.len() {
                ",\n"
            } else {
                ""
            };
            let _ = write!(text, "{}{end}", plain(polynomial, &self.names));
        }
        text
    }
}

/// A polynomial in the syntax that computer algebra systems share: `3*x1^2*y2-5`.
fn plain(polynomial: &Polynomial, names: &[String]) -> String {
    let mut text = String::new();
    for (exponents, coefficient) in polynomial.terms() {
        let mut factors = vec![coefficient.to_string()];
        for (name, &e) in names.iter().zip(exponents) {
            match e {
                0 => {}
                1 => factors.push(name.clone()),
                _ => factors.push(format!("{name}^{e}")),
            }
        }
        let term = factors.join("*");
        if !text.is_empty() && !term.starts_with('-') {
            text.push('+');
        }
        text.push_str(&term);
    }
    if text.is_empty() {
        "0".to_owned()
    } else {
        text
    }
}

impl ReducedSystem {
    /// The system over the rationals.
    #[must_use]
    pub fn exported(&self) -> Exported {
        Exported::new(self)
    }
}
