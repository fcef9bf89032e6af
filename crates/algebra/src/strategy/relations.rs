//! Relations added one by one: accepted, redundant or inconsistent.

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
    /// Polynomials of the basis after it.
    pub basis: usize,
}

/// Adds relations in the order given, on top of equations that always hold (unit circles, rotations).
///
/// Ruiz (1994), section 3.2.2. A relation is redundant when each of its equations lies in the radical of the ideal so far
/// (Hilbert's Nullstellensatz: it vanishes on all solutions, complex ones included).
///
/// # Errors
/// [`Stop`] where the budget does not suffice; the findings so far come with it.
pub fn relation_by_relation(
    always: &[Polynomial],
    relations: &[Relation],
    variables: usize,
    budget: &Budget,
) -> Result<Vec<RelationFinding>, (Stop, Vec<RelationFinding>)> {
    let mut findings = Vec::new();
    let mut basis = match basis_of(always, variables, budget) {
        Ok(basis) => basis,
        Err(stop) => return Err((stop, findings)),
    };
    for relation in relations {
        match add(&mut basis, relation, variables, budget) {
            Ok(verdict) => findings.push(RelationFinding {
                name: relation.name.clone(),
                verdict,
                dimension: basis.dimension().unwrap_or(0),
                basis: basis.polynomials().len(),
            }),
            Err(stop) => return Err((stop, findings)),
        }
    }
    Ok(findings)
}

fn add(
    basis: &mut GroebnerBasis,
    relation: &Relation,
    variables: usize,
    budget: &Budget,
) -> Result<RelationVerdict, Stop> {
    let mut new = Vec::new();
    for equation in &relation.equations {
        let left = basis.normal_form(equation);
        if !left.is_zero() && !radical_contains(basis.polynomials(), variables, &left, budget)? {
            new.push(left);
        }
    }
    if new.is_empty() {
        return Ok(RelationVerdict::Redundant);
    }
    let mut trial: Vec<Polynomial> = basis.polynomials().to_vec();
    trial.extend(new);
    let after = basis_of(&trial, variables, budget)?;
    if after.is_inconsistent() {
        return Ok(RelationVerdict::Inconsistent);
    }
    *basis = after;
    Ok(RelationVerdict::Accepted)
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
        let relations = [
            relation("twice", &squared),
            relation("once", &(&x - &y)),
            relation("first", &(&x - &one)),
            relation("second", &(&y + &one)),
        ];
        let findings = relation_by_relation(&[], &relations, 2, &Budget::unlimited()).unwrap();
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
