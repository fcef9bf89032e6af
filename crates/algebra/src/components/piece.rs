//! A part of the solution set on its way through the decomposition.
//!
//! Linear equations are used up at once: a variable that is a linear function of others leaves the ring. Mechanisms are full
//! of them, and everything later gets cheaper with every variable that is gone.

use super::ideal::{compare, degree, degrevlex, head, independent_sets, is_one, local_degree};
use crate::engine::{Budget, Stop, saturate_basis};
use crate::polynomial::{Polynomial, Rational};
use crate::zero_dimensional::FinitePoints;

/// A ring in some of the original variables.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    /// The original index of every variable of the ring.
    pub(super) alive: Vec<usize>,
    /// Every original variable as a linear polynomial of the ring.
    pub(super) embedding: Vec<Polynomial>,
}

impl Ring {
    pub(super) fn whole(variables: usize) -> Self {
        Self {
            alive: (0..variables).collect(),
            embedding: (0..variables)
                .map(|i| Polynomial::variable(i, variables))
                .collect(),
        }
    }

    pub(super) fn variables(&self) -> usize {
        self.alive.len()
    }
}

/// The root of a linear polynomial in one variable.
fn root_of_linear(polynomial: &Polynomial) -> Option<Rational> {
    let at = |x: i64| polynomial.value_at(&[Rational::from_integer(x.into())]);
    (polynomial.degree() == 1).then(|| at(0) / (at(0) - at(1)))
}

/// The zeros of a reduced degrevlex basis without linear equations, in a ring of its own.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) ring: Ring,
    pub(super) equations: Vec<Polynomial>,
}

impl Piece {
    /// The zeros of some equations; `None` where there are none.
    pub(super) fn new(
        equations: &[Polynomial],
        ring: &Ring,
        budget: &Budget,
    ) -> Result<Option<Self>, Stop> {
        let basis = degrevlex(equations, ring.variables(), budget)?;
        Ok(Self::from_basis(basis, ring))
    }

    /// The same for a reduced degrevlex basis.
    pub(super) fn from_basis(basis: Vec<Polynomial>, ring: &Ring) -> Option<Self> {
        if is_one(&basis) {
            return None;
        }
        let variables = ring.variables();
        let mut solved: Vec<Option<Polynomial>> = vec![None; variables];
        let mut rest = Vec::new();
        let mut left = variables;
        for equation in basis {
            let leading = head(&equation).iter().position(|&e| e > 0);
            match leading {
                Some(variable) if equation.degree() == 1 && left > 1 => {
                    let x = Polynomial::variable(variable, variables);
                    let slope = equation
                        .terms()
                        .next()
                        .map_or_else(|| Rational::from_integer(1.into()), |(_, c)| c.clone());
                    solved[variable] = Some(&x - &equation.scaled(&slope.recip()));
                    left -= 1;
                }
                _ => rest.push(equation),
            }
        }
        let kept: Vec<usize> = (0..variables).filter(|&v| solved[v].is_none()).collect();
        let mut places = vec![0; variables];
        for (place, &variable) in kept.iter().enumerate() {
            places[variable] = place;
        }
        // In a reduced basis a solved variable occurs nowhere else.
        let map: Vec<Polynomial> = (0..variables)
            .map(|v| match &solved[v] {
                Some(value) => value.moved(&places, kept.len()),
                None => Polynomial::variable(places[v], kept.len()),
            })
            .collect();
        let equations: Vec<Polynomial> = rest
            .iter()
            .map(|p| p.moved(&places, kept.len()).primitive())
            .collect();
        let alive: Vec<usize> = kept.iter().map(|&v| ring.alive[v]).collect();
        let mut embedding: Vec<Polynomial> =
            ring.embedding.iter().map(|p| p.substitute(&map)).collect();
        // A single point keeps one variable, since a ring needs one; the others do not depend on it.
        if let ([equation], &[only]) = (equations.as_slice(), alive.as_slice())
            && let Some(value) = root_of_linear(equation)
        {
            for (_, p) in embedding.iter_mut().enumerate().filter(|(i, _)| *i != only) {
                *p = p.substitute(&[Polynomial::constant(value.clone(), 1)]);
            }
        }
        Some(Self {
            ring: Ring { alive, embedding },
            equations,
        })
    }

    pub(super) fn variables(&self) -> usize {
        self.ring.variables()
    }

    pub(super) fn heads(&self) -> Vec<Vec<u32>> {
        self.equations.iter().map(head).collect()
    }

    /// With one more equation.
    pub(super) fn with(&self, extra: &Polynomial, budget: &Budget) -> Result<Option<Self>, Stop> {
        let mut equations = self.equations.clone();
        equations.push(extra.clone());
        Self::new(&equations, &self.ring, budget)
    }

    /// What is not on f = 0.
    pub(super) fn without(&self, f: &Polynomial, budget: &Budget) -> Result<Option<Self>, Stop> {
        let basis = saturate_basis(&self.equations, self.variables(), f, budget)?;
        Ok(Self::from_basis(basis, &self.ring))
    }

    /// The same zeros in the ring of the original variables: a reduced degrevlex basis, smallest heads first.
    pub(super) fn original_equations(&self) -> Vec<Polynomial> {
        let variables = self.ring.embedding.len();
        let mut equations: Vec<Polynomial> = self
            .equations
            .iter()
            .map(|p| p.moved(&self.ring.alive, variables))
            .collect();
        for (i, value) in self.ring.embedding.iter().enumerate() {
            if !self.ring.alive.contains(&i) {
                let x = Polynomial::variable(i, variables);
                let value = value.moved(&self.ring.alive, variables);
                equations.push((&x - &value).primitive());
            }
        }
        equations.sort_by(|a, b| compare(&head(a), &head(b)));
        equations
    }

    /// A set of independent variables of largest size. Among several, one over which the piece has few sheets.
    pub(super) fn free(&self) -> Vec<usize> {
        let heads = self.heads();
        let (sets, _) = independent_sets(&heads, self.variables());
        sets.into_iter()
            .take(200)
            .min_by_key(|set| local_degree(&heads, set, self.variables()).unwrap_or(usize::MAX))
            .unwrap_or_default()
    }

    /// The points of a piece of dimension zero; `None` where there are infinitely many.
    pub(super) fn points(&self, budget: &Budget) -> Result<Option<FinitePoints>, Stop> {
        FinitePoints::of_basis(&self.equations, &self.heads(), self.variables(), budget)
    }

    pub(super) fn degree(&self) -> Option<usize> {
        degree(&self.heads(), self.variables())
    }

    /// A polynomial of the original variables in the ring of the piece.
    pub(super) fn in_ring(&self, polynomial: &Polynomial) -> Polynomial {
        polynomial.substitute(&self.ring.embedding)
    }
}
