//! Which measures of a file rule a pose out.

use crate::exact::inequality;
use crate::schema::Misfit;
use kutzbach_algebra::{
    Budget, Condition, Limits, Meaning, PolynomialSystem, SystemOptions, assembly_conditions,
    polynomial_system,
};
use kutzbach_model::mechanism::Mechanism;

/// Measures that are looked at, each with work for a small elimination.
const MOST_MEASURES: usize = 12;
const WORK: u64 = 1_000_000;

/// A polynomial is not zero where it is more than this share of its terms; lengths do not reach where more than this is missing (m): far above
/// what doubles make of either.
const CLEAR: f64 = 1e-9;

/// Of these properties of a file those whose value rules a pose out, as long as the others keep theirs. `open` reads the file with one of them left
/// symbolic ([`ReadOptions::symbolic`](kutzbach_format::ReadOptions::symbolic)). Equations are those that are left when all unknowns are eliminated, inequalities those of
/// [`PolynomialSystem::reaches`]: where a file has none, nothing is said. Deterministic: bounded by work, not by time.
pub fn misfits(names: &[String], open: impl Fn(&str) -> Option<Mechanism>) -> Vec<Misfit> {
    let names = names.iter().take(MOST_MEASURES);
    let found = names.filter_map(|name| {
        let mechanism = open(name)?;
        // Of rounded numbers an equation may be missed by rounding alone.
        if !mechanism.precision().is_exact() {
            return None;
        }
        let system = polynomial_system(&mechanism, &SystemOptions::default()).ok()?;
        let needs = needs(&system);
        (!needs.is_empty()).then(|| Misfit {
            measure: name.clone(),
            value: value(&system, name),
            needs,
        })
    });
    found.collect()
}

/// What the file's value violates.
fn needs(system: &PolynomialSystem) -> Vec<String> {
    let names = system.names();
    let is_open = |v: &kutzbach_algebra::Variable| matches!(v.meaning, Meaning::Parameter { .. });
    if !system.variables.iter().any(is_open) {
        return Vec::new();
    }
    let reaches = system.reaches().into_iter();
    let mut needs: Vec<String> = reaches
        .filter(|reach| reach.excess > CLEAR)
        .map(|reach| inequality(&reach.apart, &reach.others))
        .collect();
    let budget = Budget::new(Limits {
        work: Some(WORK),
        ..Limits::default()
    });
    // What a relation that is left out asks for comes on top of that: conditions stay necessary.
    if let Ok(found) = assembly_conditions(system, &budget) {
        let violated = |condition: &&Condition| {
            let value = system.value_in_file(&condition.polynomial);
            !condition.factors.is_empty()
                && value.is_some_and(|(value, size)| value.abs() > CLEAR * size)
        };
        needs.extend(found.conditions.iter().filter(violated).map(|condition| {
            let ways: Vec<String> = condition
                .factors
                .iter()
                .map(|f| format!("{} = 0", f.text(&names)))
                .collect();
            ways.join(" or ")
        }));
    }
    needs
}

/// The value of a length in the file.
fn value(system: &PolynomialSystem, name: &str) -> Option<f64> {
    let names = system.names();
    let place = names.iter().position(|own| own == name)?;
    let itself = kutzbach_algebra::Polynomial::variable(place, names.len());
    Some(system.value_in_file(&itself)?.0)
}
