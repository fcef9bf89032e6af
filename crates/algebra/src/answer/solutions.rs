//! Isolated solutions.

use super::hints::hints;
use crate::{Budget, FinitePoints, GroebnerBasis, PolynomialSystem, RealSolution, Stop};

/// Bits to which the coordinates of real solutions are enclosed.
const BITS: u64 = 64;

/// The solutions, where they are finitely many.
#[derive(Clone, Debug)]
pub struct Solutions {
    /// Number of distinct complex ones. Where algebraic numbers are among the variables, those of all conjugates count.
    pub complex: usize,
    /// The real ones, each coordinate enclosed.
    pub real: Vec<RealSolution>,
}

/// The solutions of a basis in the ring of some of a system's variables; `None` where they are none or infinitely many.
pub(super) fn isolated_solutions(
    system: &PolynomialSystem,
    variables: &[usize],
    basis: &GroebnerBasis,
    budget: &Budget,
) -> Result<Option<Solutions>, Stop> {
    if basis.dimension() != Some(0) {
        return Ok(None);
    }
    let Some(points) = FinitePoints::new(basis, budget)? else {
        return Ok(None);
    };
    let mut real = points.real_solutions(BITS, budget)?;
    // The other roots of minimal polynomials belong to other mechanisms.
    let numbers = hints(system, budget)?.numbers;
    real.retain(|solution| {
        numbers.iter().all(|number| {
            let place = variables.iter().position(|&v| v == number.variable);
            place.is_none_or(|place| {
                let (low, high) = &solution.coordinates[place];
                *low <= number.high && number.low <= *high
            })
        })
    });
    Ok(Some(Solutions {
        complex: points.count(),
        real,
    }))
}
