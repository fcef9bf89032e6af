//! Relations between bodies, loop by loop.
//!
//! A relation that joins two bodies which nothing has joined yet leaves six freedoms less what it forbids, whatever they are else
//! joined to. One that closes loops has to do with the relations on the ways between its two bodies, their block, and with no
//! others: the freedom of a block is that of its bodies with one of them at rest, and the freedoms of blocks add up.

use super::relations::{Asked, Bodies, RelationFinding, RelationVerdict, Relations};
use crate::polynomial::Rational;
use crate::{Budget, Polynomial, Stop};
use num_traits::One;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Six freedoms of one body seen from another.
const FREE: usize = 6;

/// Work on whether one earlier relation is superfluous for a verdict; one that takes more is kept.
const LITTLE_WORK: u64 = 2_000_000;

/// The relations accepted so far, by block.
pub(super) struct Blocks<'a> {
    given: &'a Relations,
    bodies: &'a Bodies,
    /// Equations that always hold, by the body they are of; algebraic numbers by none.
    own: BTreeMap<usize, Vec<&'a Polynomial>>,
    numbers: Vec<&'a Polynomial>,
    /// The block of every accepted relation, by number of the relation.
    block_of: BTreeMap<usize, usize>,
    /// The freedom of every block.
    freedoms: BTreeMap<usize, usize>,
}

impl<'a> Blocks<'a> {
    pub fn new(given: &'a Relations, bodies: &'a Bodies) -> Self {
        let mut body_of = BTreeMap::new();
        for (body, variables) in bodies.variables.iter().enumerate() {
            body_of.extend(variables.iter().map(|&variable| (variable, body)));
        }
        let mut own: BTreeMap<usize, Vec<&Polynomial>> = BTreeMap::new();
        let mut numbers = Vec::new();
        for equation in &given.always {
            let body = body_of
                .iter()
                .find(|(variable, _)| equation.mentions(**variable));
            match body {
                Some((_, &body)) => own.entry(body).or_default().push(equation),
                None => numbers.push(equation),
            }
        }
        Self {
            given,
            bodies,
            own,
            numbers,
            block_of: BTreeMap::new(),
            freedoms: BTreeMap::new(),
        }
    }

    pub fn add_all(
        &mut self,
        budget: &Budget,
        findings: &mut Vec<RelationFinding>,
    ) -> Result<(), Stop> {
        for relation in 0..self.given.relations.len() {
            findings.push(self.add(relation, budget)?);
        }
        Ok(())
    }

    fn add(&mut self, relation: usize, budget: &Budget) -> Result<RelationFinding, Stop> {
        let blocks = self.blocks_between(self.bodies.of[relation]);
        let before: usize = match &blocks {
            Some(blocks) => blocks.iter().map(|block| self.freedoms[block]).sum(),
            None => FREE,
        };
        let blocks = blocks.unwrap_or_default();
        let others: Vec<usize> = self
            .block_of
            .iter()
            .filter(|(_, block)| blocks.contains(*block))
            .map(|(&other, _)| other)
            .collect();
        let system = self.system(relation, &others);
        let (verdict, after) = system.asked(before).answer(budget)?;
        let because_of = match verdict {
            RelationVerdict::Accepted => Vec::new(),
            other => self.needed(relation, others, other, budget)?,
        };
        if verdict == RelationVerdict::Accepted {
            for block in self.block_of.values_mut().filter(|b| blocks.contains(*b)) {
                *block = relation;
            }
            self.block_of.insert(relation, relation);
            self.freedoms.retain(|block, _| !blocks.contains(block));
            self.freedoms
                .insert(relation, after.dimension().unwrap_or(0));
        }
        Ok(RelationFinding {
            name: self.given.relations[relation].name.clone(),
            verdict,
            dimension: self.dimension(),
            basis: after.polynomials().len(),
            because_of,
        })
    }

    /// The blocks on the way between two bodies; `None` where nothing joins them.
    fn blocks_between(&self, [from, to]: [usize; 2]) -> Option<BTreeSet<usize>> {
        let mut came_by: BTreeMap<usize, Option<usize>> = BTreeMap::from([(from, None)]);
        let mut waiting = VecDeque::from([from]);
        while let Some(body) = waiting.pop_front() {
            for &relation in self.block_of.keys() {
                let [a, b] = self.bodies.of[relation];
                let other = match body {
                    body if body == a => b,
                    body if body == b => a,
                    _ => continue,
                };
                came_by.entry(other).or_insert_with(|| {
                    waiting.push_back(other);
                    Some(relation)
                });
            }
        }
        let mut blocks = BTreeSet::new();
        let mut body = to;
        while let &Some(relation) = came_by.get(&body)? {
            blocks.insert(self.block_of[&relation]);
            let [a, b] = self.bodies.of[relation];
            body = if body == a { b } else { a };
        }
        Some(blocks)
    }

    /// What all relations accepted so far leave: the freedoms of blocks, and six for each piece without the ground.
    fn dimension(&self) -> usize {
        let count = self.bodies.variables.len();
        let mut joined = petgraph::unionfind::UnionFind::<usize>::new(count);
        for &relation in self.block_of.keys() {
            let [a, b] = self.bodies.of[relation];
            joined.union(a, b);
        }
        let pieces: BTreeSet<usize> = (0..count).map(|body| joined.find(body)).collect();
        self.freedoms.values().sum::<usize>() + FREE * (pieces.len() - 1)
    }

    /// Of some relations those without which the verdict on another would not be proved.
    fn needed(
        &self,
        relation: usize,
        others: Vec<usize>,
        verdict: RelationVerdict,
        budget: &Budget,
    ) -> Result<Vec<usize>, Stop> {
        let mut needed = others.clone();
        for other in others {
            let fewer: Vec<usize> = needed.iter().copied().filter(|n| *n != other).collect();
            let little = budget.with_work(LITTLE_WORK);
            let system = self.system(relation, &fewer);
            let asked = system.asked(0);
            let still = match verdict {
                RelationVerdict::Inconsistent => asked.is_inconsistent(&little),
                _ => asked.is_redundant(&little),
            };
            budget.take_over(&little);
            match still {
                Ok(true) => needed = fewer,
                Ok(false) | Err(Stop::Work) => {}
                Err(stop) => return Err(stop),
            }
        }
        Ok(needed)
    }

    /// The equations of a relation and some others, with one of their bodies at rest.
    fn system(&self, relation: usize, others: &[usize]) -> Local {
        let of = |&relation: &usize| self.bodies.of[relation];
        let bodies: BTreeSet<usize> = others.iter().chain([&relation]).flat_map(of).collect();
        let resting_body = match bodies.contains(&self.bodies.ground) {
            true => self.bodies.ground,
            false => self.bodies.of[relation][0],
        };
        let moving = bodies.iter().filter(|body| **body != resting_body);
        let always = moving.flat_map(|body| self.own.get(body).into_iter().flatten());
        let joints = others
            .iter()
            .flat_map(|&other| &self.given.relations[other].equations);
        let before: Vec<&Polynomial> = always.chain(&self.numbers).copied().chain(joints).collect();
        let new: Vec<&Polynomial> = self.given.relations[relation].equations.iter().collect();
        let resting = &self.bodies.variables[resting_body];
        // Row by row: the entries of the identity.
        let ones = [0, 4, 8].map(|entry| resting.get(entry).copied());
        let at_rest = |polynomial: &&Polynomial| with_resting(polynomial, resting, &ones);
        let before: Vec<Polynomial> = before.iter().map(at_rest).collect();
        let new: Vec<Polynomial> = new.iter().map(at_rest).collect();
        let free = bodies.iter().filter(|body| **body != resting_body);
        let free = free.flat_map(|&body| self.bodies.variables[body].iter().copied());
        Local::of(before, new, free.collect(), self.given.variables)
    }
}

/// A polynomial in which some variables are 1 and others of the same body 0.
fn with_resting(polynomial: &Polynomial, resting: &[usize], ones: &[Option<usize>]) -> Polynomial {
    let terms = polynomial.terms().filter_map(|(exponents, coefficient)| {
        let mut left = exponents.to_vec();
        for &variable in resting {
            if left[variable] > 0 && !ones.contains(&Some(variable)) {
                return None;
            }
            left[variable] = 0;
        }
        Some((left, coefficient.clone()))
    });
    // Terms that have become equal are added up.
    let mut sums: BTreeMap<Vec<u32>, Rational> = BTreeMap::new();
    for (exponents, coefficient) in terms {
        let sum = sums
            .entry(exponents)
            .or_insert_with(|| Rational::one() - Rational::one());
        *sum += coefficient;
    }
    Polynomial::from_terms(sums.into_iter().collect(), polynomial.variables())
}

/// Equations in the variables of some bodies, and others that occur in them.
struct Local {
    before: Vec<Polynomial>,
    new: Vec<Polynomial>,
    variables: usize,
}

impl Local {
    fn of(
        before: Vec<Polynomial>,
        new: Vec<Polynomial>,
        free: BTreeSet<usize>,
        variables: usize,
    ) -> Self {
        let mentioned = |variable: usize| before.iter().chain(&new).any(|p| p.mentions(variable));
        let kept: Vec<usize> = (0..variables)
            .filter(|&variable| free.contains(&variable) || mentioned(variable))
            .collect();
        let mut places = vec![0; variables];
        for (place, &variable) in kept.iter().enumerate() {
            places[variable] = place;
        }
        let count = kept.len();
        let moved = |all: &[Polynomial]| all.iter().map(|p| p.moved(&places, count)).collect();
        Self {
            before: moved(&before),
            new: moved(&new),
            variables: count,
        }
    }

    fn asked(&self, dimension: usize) -> Asked<'_> {
        Asked {
            before: &self.before,
            dimension,
            new: &self.new,
            variables: self.variables,
        }
    }
}
