//! Variables that take finitely many values.

use super::solutions::Solutions;
use crate::univariate::RealRoot;
use crate::{
    Budget, GroebnerBasis, Meaning, Polynomial, PolynomialSystem, RealSolution, Stop, Univariate,
};

/// A variable with finitely many values, and these.
#[derive(Clone, Debug)]
pub struct FixedVariable {
    /// Index of the variable.
    pub variable: usize,
    /// The equation in this variable alone that follows from the others; `None` where all variables are fixed, and the
    /// values were taken from the solutions.
    pub polynomial: Option<Polynomial>,
    /// Its real roots, ascending; not every one need belong to a real pose. Without the equation those of all real solutions,
    /// such as agree to 64 bits taken for one.
    pub values: Vec<RealRoot>,
}

/// Bits to which values are enclosed.
const BITS: u64 = 64;

/// All unknowns that are fixed, given the basis in the ring of some variables and the solutions where they are finitely many:
/// every variable is fixed then, and equations in one variable alone would take much longer than the solutions did.
pub(super) fn fixed_variables(
    system: &PolynomialSystem,
    variables: &[usize],
    basis: &GroebnerBasis,
    solutions: Option<&Solutions>,
    budget: &Budget,
) -> Result<Vec<FixedVariable>, Stop> {
    let given = |variable: usize| {
        matches!(
            system.variables[variable].meaning,
            Meaning::Algebraic { .. } | Meaning::Parameter { .. }
        )
    };
    let places = variables.iter().copied().enumerate();
    let unknowns = places.filter(|(_, variable)| !given(*variable));
    match solutions {
        Some(solutions) => Ok(unknowns
            .map(|(place, variable)| at_solutions(place, variable, &solutions.real))
            .collect()),
        None => unknowns
            .filter_map(|(place, variable)| {
                fixed_variable(basis, place, variable, budget).transpose()
            })
            .collect(),
    }
}

/// A variable's values at the solutions.
fn at_solutions(place: usize, variable: usize, real: &[RealSolution]) -> FixedVariable {
    let coordinate = |solution: &RealSolution| {
        let (low, high) = solution.coordinates[place].clone();
        RealRoot { low, high }
    };
    let mut values: Vec<RealRoot> = real.iter().map(coordinate).collect();
    values.sort_by(|a, b| a.low.cmp(&b.low));
    values.dedup_by(|next, kept| next.low <= kept.high);
    FixedVariable {
        variable,
        polynomial: None,
        values,
    }
}

/// Whether a variable of the basis's ring, called `variable` outside, is fixed.
fn fixed_variable(
    basis: &GroebnerBasis,
    place: usize,
    variable: usize,
    budget: &Budget,
) -> Result<Option<FixedVariable>, Stop> {
    let Some(polynomial) = basis.univariate_in(place, budget)? else {
        return Ok(None);
    };
    let mut values = Vec::new();
    if let Some(univariate) = Univariate::from_polynomial(&polynomial, place) {
        for (part, _) in univariate.squarefree() {
            for root in part.real_roots(budget)? {
                values.push(part.refine(&root, BITS));
            }
        }
    }
    values.sort_by(|a, b| a.low.cmp(&b.low));
    Ok(Some(FixedVariable {
        variable,
        polynomial: Some(polynomial),
        values,
    }))
}
