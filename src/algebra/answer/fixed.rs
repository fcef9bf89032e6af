//! Variables that take finitely many values.

use crate::algebra::univariate::RealRoot;
use crate::algebra::{
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

/// The numbers of the unknowns: algebraic numbers and parameters of the mechanism itself are left out.
fn unknowns(system: &PolynomialSystem) -> impl Iterator<Item = usize> {
    let variables = system.variables.iter().enumerate();
    variables.filter_map(|(index, variable)| {
        let given = matches!(
            variable.meaning,
            Meaning::Algebraic { .. } | Meaning::Parameter { .. }
        );
        (!given).then_some(index)
    })
}

/// All unknowns that are fixed.
pub(super) fn fixed_variables(
    system: &PolynomialSystem,
    basis: &GroebnerBasis,
    budget: &Budget,
) -> Result<Vec<FixedVariable>, Stop> {
    unknowns(system)
        .filter_map(|v| fixed_variable(basis, v, v, budget).transpose())
        .collect()
}

/// All unknowns, where the solutions are finitely many: equations in one variable alone would take longer than these.
pub(super) fn values_of_solutions(
    system: &PolynomialSystem,
    real: &[RealSolution],
) -> Vec<FixedVariable> {
    unknowns(system)
        .map(|variable| {
            let coordinate = |solution: &RealSolution| {
                let (low, high) = solution.coordinates[variable].clone();
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
        })
        .collect()
}

/// Whether a variable of the basis's ring, called `variable` outside, is fixed.
pub(super) fn fixed_variable(
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
