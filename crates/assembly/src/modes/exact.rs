//! Exact algebra on the equations of a tree.

use crate::reduced::ReducedSystem;
use kutzbach_algebra::{
    Budget, FinitePoints, Hints, MonomialOrder, RealPoints, Stop, components, groebner_basis,
};

/// Bits to which solutions are enclosed.
const BITS: u64 = 64;

/// What exact algebra says.
pub(super) enum Exact {
    /// All real solutions: the unknowns, and how often each counts.
    Finite(Vec<(Vec<f64>, usize)>),
    /// A piece of this dimension has real points all over.
    Curve(usize),
    /// Infinitely many complex solutions; of the real ones nothing is known.
    Unclear,
}

/// Decides on a system.
pub(super) fn decide(system: &ReducedSystem, budget: &Budget) -> Result<Exact, Stop> {
    let exported = system.exported();
    let count = exported.names.len();
    let basis = groebner_basis(
        &exported.polynomials,
        count,
        &MonomialOrder::Degrevlex,
        budget,
    )?;
    match basis.dimension() {
        None => return Ok(Exact::Finite(Vec::new())),
        Some(0) => {}
        Some(_) => {
            let angles = Vec::new();
            let hints = Hints {
                angles,
                numbers: exported.roots(),
                points: Vec::new(),
            };
            let found = components(&exported.polynomials, count, &hints, budget)?;
            let real = found
                .pieces
                .iter()
                .filter(|piece| piece.dimension > 0 && piece.real == RealPoints::FullDimension)
                .map(|piece| piece.dimension)
                .max();
            return Ok(real.map_or(Exact::Unclear, Exact::Curve));
        }
    }
    let Some(points) = FinitePoints::new(&basis, budget)? else {
        return Ok(Exact::Unclear);
    };
    let mut solutions: Vec<(Vec<f64>, usize)> = Vec::new();
    for solution in points.real_solutions(BITS, budget)? {
        let values = solution.values();
        // Conjugates of the numbers belong to other mechanisms. They are far away, or nothing is said.
        let mut right = true;
        for (variable, number) in &exported.numbers {
            let (found, meant) = (values[*variable], number.value());
            let off = (found - meant).abs() / meant.abs().max(1.0);
            if off > 1e-12 && off < 1e-6 {
                return Ok(Exact::Unclear);
            }
            right &= off <= 1e-12;
        }
        if !right {
            continue;
        }
        let unknowns = canonical(system, &values[..exported.unknowns]);
        let known = solutions.iter().any(|(other, _)| {
            let far = other.iter().zip(&unknowns).map(|(a, b)| (a - b).abs());
            far.fold(0.0, f64::max) < 1e-12
        });
        if !known {
            solutions.push((unknowns, solution.multiplicity as usize));
        }
    }
    Ok(Exact::Finite(solutions))
}

/// Of the two quaternions of a rotation the one whose first component that is not zero is positive.
fn canonical(system: &ReducedSystem, values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    for turn in system.unknowns.iter().filter(|t| t.count() == 4) {
        let own = &mut values[turn.first()..turn.first() + 4];
        let sign = own
            .iter()
            .find(|x| x.abs() > 1e-9)
            .map_or(1.0, |x| x.signum());
        own.iter_mut().for_each(|x| *x *= sign);
    }
    values
}
