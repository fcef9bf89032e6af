//! The system as polynomials over the rationals, for the exact solver and for other programs.

use super::ReducedSystem;
use kutzbach_algebra::{FieldPolynomial, OverRationals, Reader, written_for};

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

    /// As a file for another program.
    #[must_use]
    pub fn written_for(&self, reader: Reader) -> String {
        written_for(reader, &self.names, &self.system.polynomials)
    }
}

impl ReducedSystem {
    /// The system over the rationals.
    #[must_use]
    pub fn exported(&self) -> Exported {
        Exported::new(self)
    }
}
