//! The pieces of a cycle's solutions, and which of them the drawn pose lies on.

use super::Piece;
use crate::strategy::Local;
use crate::{
    Budget, GroebnerBasis, Hints, Incomplete, MonomialOrder, Polynomial, PolynomialSystem, Stop,
    Univariate, components, groebner_basis,
};

/// Work that may be spent on the pieces of one cycle: some seconds.
const PIECES_WORK: u64 = 2_000_000;

/// The solutions of a cycle as far as they are known to fall apart.
pub(super) struct Pieces {
    /// A basis of each, in the cycle's ring, and whether the drawn pose lies on it.
    bases: Vec<(GroebnerBasis, bool)>,
    /// Whether they were looked for to the end.
    complete: bool,
}

impl Pieces {
    /// The pieces of a cycle by itself, given its basis.
    pub(super) fn of(
        system: &PolynomialSystem,
        local: &Local,
        basis: &GroebnerBasis,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        let little = budget.with_work(PIECES_WORK);
        let variables = local.variables.len();
        let found = components(basis.polynomials(), variables, &Hints::default(), &little);
        budget.take_over(&little);
        let on_home = |equations: &[Polynomial]| {
            equations
                .iter()
                .all(|p| system.vanishes_at_home(&local.lift(p)) == Some(true))
        };
        // Pieces that were not examined to the end are the whole together all the same.
        let (pieces, complete) = match found {
            Ok(found) if !found.pieces.is_empty() => {
                let stopped = matches!(found.why, Some(Incomplete::Stopped(_)));
                (found.pieces, !stopped)
            }
            _ => {
                budget.check()?;
                return Ok(Self::unknown(basis));
            }
        };
        let mut bases = Vec::with_capacity(pieces.len());
        for piece in &pieces {
            let equations = nearer_to_radical(&piece.equations, variables, budget)?;
            bases.push((equations, on_home(&piece.equations)));
        }
        Ok(Self { bases, complete })
    }

    /// No pieces but the whole, given its basis.
    pub(super) fn unknown(basis: &GroebnerBasis) -> Self {
        Self {
            bases: vec![(basis.clone(), true)],
            complete: false,
        }
    }

    /// The same from pieces that are known in the ring of the system.
    pub(super) fn known(
        local: &Local,
        pieces: &[Piece],
        complete: bool,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        let variables = local.variables.len();
        let mut bases = Vec::with_capacity(pieces.len());
        for piece in pieces {
            let equations: Vec<Polynomial> = piece
                .component
                .equations
                .iter()
                .map(|p| local.lower(p))
                .collect();
            let basis = nearer_to_radical(&equations, variables, budget)?;
            bases.push((basis, piece.contains_home == Some(true)));
        }
        Ok(Self { bases, complete })
    }

    /// A basis of every piece.
    pub(super) fn all(&self) -> Vec<&GroebnerBasis> {
        self.bases.iter().map(|(basis, _)| basis).collect()
    }

    /// Whether they were looked for to the end.
    pub(super) fn are_complete(&self) -> bool {
        self.complete
    }

    /// Those of the drawn pose; all, should it lie on none.
    pub(super) fn of_home(&self) -> Vec<&GroebnerBasis> {
        let of_home = self.bases.iter().filter(|(_, home)| *home);
        let of_home: Vec<_> = of_home.map(|(basis, _)| basis).collect();
        if of_home.is_empty() {
            self.all()
        } else {
            of_home
        }
    }
}

/// A basis of some equations together with the squarefree parts of the polynomials in one variable that follow from them:
/// the same solutions, and where they are finitely many, nothing is missing that vanishes on all of them (Seidenberg 1974).
fn nearer_to_radical(
    equations: &[Polynomial],
    variables: usize,
    budget: &Budget,
) -> Result<GroebnerBasis, Stop> {
    let order = MonomialOrder::Degrevlex;
    let basis = groebner_basis(equations, variables, &order, budget)?;
    let mut more = Vec::new();
    for variable in 0..variables {
        let Some(polynomial) = basis.univariate_in(variable, budget)? else {
            continue;
        };
        let Some(univariate) = Univariate::from_polynomial(&polynomial, variable) else {
            continue;
        };
        let parts = univariate.squarefree();
        if parts.iter().any(|(_, multiplicity)| *multiplicity > 1) {
            let x = Polynomial::variable(variable, variables);
            let product = parts
                .iter()
                .fold(Polynomial::one(variables), |all, (part, _)| {
                    &all * &part.of(&x)
                });
            more.push(product);
        }
    }
    if more.is_empty() {
        return Ok(basis);
    }
    more.extend(basis.polynomials().iter().cloned());
    groebner_basis(&more, variables, &order, budget)
}
