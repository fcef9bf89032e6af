//! The system as polynomials over the rationals, for the exact solver and for other programs.

use super::ReducedSystem;
use kutzbach_algebra::{FieldPolynomial, OverRationals, Polynomial};
use std::fmt::Write;

/// A reduced system over the rationals: what its numbers adjoin are unknowns as well.
#[derive(Clone, Debug)]
pub struct Exported {
    /// Names of the unknowns, then of the numbers adjoined.
    pub names: Vec<String>,
    /// The equations in them.
    pub system: OverRationals,
}

impl Exported {
    pub(super) fn new(system: &ReducedSystem) -> Self {
        let closures = system.closures.iter().map(|c| c.polynomial.clone());
        let relations = system.unknowns.iter().map(|u| u.relation(&system.field));
        let polynomials: Vec<FieldPolynomial> = closures.chain(relations).collect();
        let system_over = OverRationals::new(&polynomials, system.unknown_count(), &system.field);
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
        names.extend((0..system_over.numbers.len()).map(|g| format!("g{}", g + 1)));
        Self {
            names,
            system: system_over,
        }
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
        for (index, polynomial) in self.system.polynomials.iter().enumerate() {
            let end = if index + 1 < self.system.polynomials.len() {
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
