//! Relations added one by one: accepted, redundant or inconsistent.
//!
//! Ruiz (1994), section 3.2.2. A relation is redundant when each of its equations lies in the radical of the ideal so far (Hilbert's
//! Nullstellensatz: it vanishes on all solutions, complex ones included). Where fewer dimensions are left with it than before,
//! that needs no proof; only where as many are is each equation asked about.
//!
//! Where relations are between bodies and nothing else, those on other loops have no say, and what is open moves freely: the
//! equations of the loops that a relation closes decide, with one of their bodies at rest ([`Bodies`]).

use super::blocks::Blocks;
use crate::{
    Budget, GroebnerBasis, MonomialOrder, Polynomial, Stop, groebner_basis, radical_contains,
};

/// A relation between links and its equations.
#[derive(Clone, Debug)]
pub struct Relation {
    /// The joint or coupling.
    pub name: String,
    /// Its equations.
    pub equations: Vec<Polynomial>,
}

impl Relation {
    /// A relation without equations yet.
    #[must_use]
    pub fn named(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            equations: Vec::new(),
        }
    }
}

/// Bodies that relations are between, where each relation is between two.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// The body at rest.
    pub ground: usize,
    /// The variables of every body but the ground: the entries of its rotation matrix, row by row, and its three coordinates.
    pub variables: Vec<Vec<usize>>,
    /// The two bodies of every relation.
    pub of: Vec<[usize; 2]>,
}

/// Relations, and what holds without them.
#[derive(Clone, Debug)]
pub struct Relations {
    /// Equations that always hold: unit circles, rotations, algebraic numbers.
    pub always: Vec<Polynomial>,
    /// The relations in the order in which they are added.
    pub relations: Vec<Relation>,
    /// Variables of the ring.
    pub variables: usize,
    /// Where the relations are joints between bodies, and their equations do not depend on where a pair of bodies is.
    pub bodies: Option<Bodies>,
}

impl Relations {
    /// The same with those of these names first, in this order, and the others after them in theirs.
    ///
    /// # Errors
    /// A name that no relation has.
    pub fn ordered(mut self, first: &[String]) -> Result<Self, String> {
        let named = |name: &String| self.relations.iter().any(|own| own.name == *name);
        if let Some(name) = first.iter().find(|name| !named(name)) {
            return Err(name.clone());
        }
        let place = |own: &usize| {
            let name = &self.relations[*own].name;
            first
                .iter()
                .position(|other| other == name)
                .unwrap_or(usize::MAX)
        };
        let mut order: Vec<usize> = (0..self.relations.len()).collect();
        order.sort_by_key(place);
        if let Some(bodies) = &mut self.bodies {
            bodies.of = order.iter().map(|&own| bodies.of[own]).collect();
        }
        self.relations = order
            .iter()
            .map(|&own| self.relations[own].clone())
            .collect();
        Ok(self)
    }
}

/// What a relation adds to those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RelationVerdict {
    /// It forbids something that was possible.
    Accepted,
    /// It holds wherever the relations before it hold.
    Redundant,
    /// Nothing satisfies it together with those before it; it is left out of what follows.
    Inconsistent,
}

/// A relation and what it adds.
#[derive(Clone, Debug)]
pub struct RelationFinding {
    /// The joint or coupling.
    pub name: String,
    /// What it adds.
    pub verdict: RelationVerdict,
    /// Complex dimension of what the accepted relations leave possible.
    pub dimension: usize,
    /// Polynomials of the basis after it: where relations are between bodies, of the loops that it is in.
    pub basis: usize,
    /// Of a relation that is redundant or inconsistent: earlier ones that alone make it so, by number, none of them superfluous as far
    /// as the work allowed to see; none where relations are not between bodies.
    pub because_of: Vec<usize>,
}

/// Adds relations in the order given, on top of equations that always hold.
///
/// # Errors
/// [`Stop`] where the budget does not suffice; the findings so far come with it.
pub fn relation_by_relation(
    given: &Relations,
    budget: &Budget,
) -> Result<Vec<RelationFinding>, (Stop, Vec<RelationFinding>)> {
    let mut findings = Vec::new();
    let stopped = match &given.bodies {
        Some(bodies) => Blocks::new(given, bodies).add_all(budget, &mut findings),
        None => add_all(given, budget, &mut findings),
    };
    match stopped {
        Ok(()) => Ok(findings),
        Err(stop) => Err((stop, findings)),
    }
}

fn add_all(
    given: &Relations,
    budget: &Budget,
    findings: &mut Vec<RelationFinding>,
) -> Result<(), Stop> {
    let mut basis = basis_of(&given.always, given.variables, budget)?;
    for relation in &given.relations {
        let before = basis.dimension();
        let asked = Asked {
            before: basis.polynomials(),
            dimension: before.unwrap_or(0),
            new: &relation.equations,
            variables: given.variables,
        };
        let (verdict, after) = asked.answer(budget)?;
        if verdict == RelationVerdict::Accepted {
            basis = after;
        }
        findings.push(RelationFinding {
            name: relation.name.clone(),
            verdict,
            dimension: basis.dimension().unwrap_or(0),
            basis: basis.polynomials().len(),
            because_of: Vec::new(),
        });
    }
    Ok(())
}

/// What a relation adds to equations.
pub(super) struct Asked<'a> {
    pub before: &'a [Polynomial],
    /// The dimension of their solutions.
    pub dimension: usize,
    pub new: &'a [Polynomial],
    pub variables: usize,
}

impl Asked<'_> {
    /// The verdict, and the basis of all equations together.
    pub fn answer(&self, budget: &Budget) -> Result<(RelationVerdict, GroebnerBasis), Stop> {
        let all = [self.before, self.new].concat();
        let after = basis_of(&all, self.variables, budget)?;
        let verdict = match after.dimension() {
            None => RelationVerdict::Inconsistent,
            Some(left) if left < self.dimension => RelationVerdict::Accepted,
            Some(_) if self.is_redundant(budget)? => RelationVerdict::Redundant,
            Some(_) => RelationVerdict::Accepted,
        };
        Ok((verdict, after))
    }

    /// Whether the new equations hold wherever those before do.
    pub fn is_redundant(&self, budget: &Budget) -> Result<bool, Stop> {
        for equation in self.new {
            if !radical_contains(self.before, self.variables, equation, budget)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether nothing satisfies all of them.
    pub fn is_inconsistent(&self, budget: &Budget) -> Result<bool, Stop> {
        let all = [self.before, self.new].concat();
        Ok(basis_of(&all, self.variables, budget)?.is_inconsistent())
    }
}

fn basis_of(
    equations: &[Polynomial],
    variables: usize,
    budget: &Budget,
) -> Result<GroebnerBasis, Stop> {
    groebner_basis(equations, variables, &MonomialOrder::Degrevlex, budget)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_of_relation_is_told_apart() {
        let (x, y) = (Polynomial::variable(0, 2), Polynomial::variable(1, 2));
        let one = Polynomial::one(2);
        let relation = |name: &str, equation: &Polynomial| Relation {
            name: name.to_owned(),
            equations: vec![equation.clone()],
        };
        let squared = &(&x - &y) * &(&x - &y);
        let given = Relations {
            always: Vec::new(),
            relations: vec![
                relation("twice", &squared),
                relation("once", &(&x - &y)),
                relation("first", &(&x - &one)),
                relation("second", &(&y + &one)),
            ],
            variables: 2,
            bodies: None,
        };
        let findings = relation_by_relation(&given, &Budget::unlimited()).unwrap();
        let told: Vec<(RelationVerdict, usize)> =
            findings.iter().map(|f| (f.verdict, f.dimension)).collect();
        assert_eq!(
            told,
            [
                (RelationVerdict::Accepted, 1),
                (RelationVerdict::Redundant, 1),
                (RelationVerdict::Accepted, 0),
                (RelationVerdict::Inconsistent, 0),
            ]
        );
    }
}
