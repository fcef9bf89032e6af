//! Systems with finitely many complex solutions: how many, which are real, and where.
//!
//! A structure, or a mechanism whose motors are held, has finitely many poses; all of them are wanted, none twice, none that
//! is only complex. The answer must not depend on tolerances: the number of real solutions is a matter of signs of exact
//! numbers.
//!
//! From a Groebner basis: the space of remainders modulo the ideal (`quotient.rs`), the trace form whose rank and signature
//! count the points (`trace_form.rs`), a linear form that tells the points apart (`separating.rs`), the coordinates as
//! functions of its value (`representation.rs`), and real points as intervals as narrow as wished (`real.rs`).
//!
//! Cost: with D points (counted with multiplicities), about D³ operations with numbers whose length grows with D; sixteen
//! points take some milliseconds, sixty-four about a second.

mod quotient;
mod real;
mod representation;
mod separating;
mod trace_form;

pub use real::RealSolution;
pub use representation::Representation;
pub use trace_form::TraceForm;

use super::engine::{Budget, GroebnerBasis, Stop};
use super::polynomial::Polynomial;
use super::univariate::Univariate;
use quotient::Quotient;
use separating::Image;

/// Separating forms that may turn out not to separate before the attempt is given up: a form that passes the test modulo a
/// prime of 62 bits fails over the rationals only where that prime is unlucky.
const MOST_FORMS: usize = 8;

/// The finitely many complex zeros of an ideal.
#[derive(Clone, Debug)]
pub struct FinitePoints {
    quotient: Quotient,
    representation: Representation,
}

impl FinitePoints {
    /// The zeros of the ideal of a Groebner basis in any order; `None` where there are infinitely many.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn new(basis: &GroebnerBasis, budget: &Budget) -> Result<Option<Self>, Stop> {
        let heads: Vec<Vec<u32>> = basis.leading_monomials().map(<[u32]>::to_vec).collect();
        Self::of_basis(basis.polynomials(), &heads, basis.variables(), budget)
    }

    /// The same for the polynomials of a reduced basis and their leading monomials.
    pub(super) fn of_basis(
        polynomials: &[Polynomial],
        heads: &[Vec<u32>],
        variables: usize,
        budget: &Budget,
    ) -> Result<Option<Self>, Stop> {
        let Some(quotient) = Quotient::new(polynomials, heads, variables, budget)? else {
            return Ok(None);
        };
        if quotient.dimension() == 0 {
            let representation = Representation {
                form: vec![0; variables],
                factors: Vec::new(),
                complete: true,
                denominator: Univariate::from_integers(&[1]),
                numerators: vec![Univariate::default(); variables],
            };
            return Ok(Some(Self {
                quotient,
                representation,
            }));
        }
        let image = Image::new(&quotient, budget)?;
        let products = quotient.products(budget)?;
        let traces = trace_form::traces(&quotient, &products);
        for skip in 0..MOST_FORMS {
            let Some(form) = image.forms(&quotient, skip, budget)? else {
                break;
            };
            let found =
                representation::representation(&quotient, &products, &traces, &form, budget)?;
            if let Some(representation) = found {
                return Ok(Some(Self {
                    quotient,
                    representation,
                }));
            }
        }
        Err(Stop::Coefficients)
    }

    /// Number of zeros, each with its multiplicity.
    #[must_use]
    pub fn multiplicity(&self) -> usize {
        self.quotient.dimension()
    }

    /// Number of distinct complex zeros.
    #[must_use]
    pub fn count(&self) -> usize {
        let factors = self.representation.factors.iter();
        factors.map(|(factor, _)| factor.degree()).sum()
    }

    /// The separating form, its values, and the coordinates as functions of the value.
    #[must_use]
    pub fn representation(&self) -> &Representation {
        &self.representation
    }

    /// Rank and signature of the trace form: the counts of distinct complex and real zeros by another way than the roots of
    /// the representation.
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn trace_form(&self, budget: &Budget) -> Result<TraceForm, Stop> {
        let products = self.quotient.products(budget)?;
        let traces = trace_form::traces(&self.quotient, &products);
        let matrix = trace_form::trace_matrix(&self.quotient, &products, &traces);
        trace_form::rank_and_signature(matrix, budget)
    }
}

#[cfg(test)]
mod tests;
