//! Variables that take finitely many values.

use crate::algebra::univariate::RealRoot;
use crate::algebra::{
    Budget, GroebnerBasis, Meaning, Polynomial, PolynomialSystem, Stop, Univariate,
};

/// A variable with finitely many values, and these.
#[derive(Clone, Debug)]
pub struct FixedVariable {
    /// Index of the variable.
    pub variable: usize,
    /// The equation in this variable alone that follows from the others.
    pub polynomial: Polynomial,
    /// Its real roots, ascending. Not every one need belong to a real pose.
    pub values: Vec<RealRoot>,
}

/// Bits to which values are enclosed.
const BITS: u64 = 64;

/// All unknowns that are fixed: the algebraic numbers and parameters of the mechanism itself are left out.
pub(super) fn fixed_variables(
    system: &PolynomialSystem,
    basis: &GroebnerBasis,
    budget: &Budget,
) -> Result<Vec<FixedVariable>, Stop> {
    let mut fixed = Vec::new();
    for (variable, named) in system.variables.iter().enumerate() {
        if matches!(
            named.meaning,
            Meaning::Algebraic { .. } | Meaning::Parameter { .. }
        ) {
            continue;
        }
        if let Some(found) = fixed_variable(basis, variable, variable, budget)? {
            fixed.push(found);
        }
    }
    Ok(fixed)
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
        polynomial,
        values,
    }))
}
