//! Whether loops close at all, and where: what is asked before poses are searched.

use super::Solutions;
use super::solutions::isolated_solutions;
use crate::{
    Budget, Formulation, GroebnerBasis, Meaning, MonomialOrder, Polynomial, PolynomialSystem,
    Rational, RealSolution, Stop, SystemOptions, groebner_basis, polynomial_system,
};
use kutzbach_math::space::Rigid;
use kutzbach_model::mechanism::{JointId, Mechanism};

/// What the equations of some loops say of their poses.
#[derive(Clone, Debug)]
pub struct Closings {
    /// The equations, in the tree form.
    pub system: PolynomialSystem,
    /// Their solutions.
    pub set: ClosingSet,
}

/// The poses at which loops close.
#[derive(Clone, Debug)]
pub enum ClosingSet {
    /// The equations contradict one another, over the complex numbers too.
    Contradiction {
        /// Cycles of the system that contradict one another, with the couplings: indices in
        /// [`PolynomialSystem::cycles`]. None of them can be left out, as far as the budget told.
        cycles: Vec<usize>,
        /// Whether that was computed over the rational numbers; otherwise modulo primes, as
        /// [`Certificate`](crate::Certificate) says.
        proven: bool,
    },
    /// Finitely many complex solutions, and these are all real ones: there may be none.
    Finite(Vec<RealSolution>),
    /// Infinitely many complex solutions.
    Infinite {
        /// The complex dimension of their set.
        dimension: usize,
        /// Some real ones, where any were met: over values of the free variables near those given.
        met: Vec<RealSolution>,
    },
}

/// Joints that are closed with a denominator of this in their free variables.
const FINENESS: f64 = 64.0;

/// Where free variables are put, beside the values given: cosines and sines, and lengths in their own unit.
const BESIDE: [f64; 7] = [0.0, 0.125, -0.125, 0.375, -0.375, 0.75, -0.75];

/// Sets of free variables that are tried.
const FREE_SETS: usize = 3;

/// A product of terms of a closure takes as long as so many matrix entries at least.
const WORK_PER_PRODUCT: u64 = 5;

/// The solutions of the loops and couplings all of whose joints are among these. `near`: poses of all links (`world_from_link`), near
/// which solutions are looked for where there are infinitely many. Solutions of a system with
/// [relaxations](PolynomialSystem::relaxations) need not close the loops; that it has none is a proof all the same.
///
/// `None` where there are no polynomial equations, or the budget does not suffice.
#[must_use]
pub fn closings(
    mechanism: &Mechanism,
    joints: &[JointId],
    near: &[Rigid<f64>],
    budget: &Budget,
) -> Option<Closings> {
    let options = SystemOptions {
        formulation: Formulation::Tree,
        joints: Some(joints.to_vec()),
        most_products: budget.limits().work.map(|work| work / WORK_PER_PRODUCT),
        ..SystemOptions::default()
    };
    let system = polynomial_system(mechanism, &options).ok()?;
    if system.equations.is_empty() {
        return None;
    }
    let set = closing_set(&system, near, budget).ok()?;
    Some(Closings { system, set })
}

fn closing_set(
    system: &PolynomialSystem,
    near: &[Rigid<f64>],
    budget: &Budget,
) -> Result<ClosingSet, Stop> {
    let equations = system.polynomials();
    let basis = basis(&equations, system, budget)?;
    Ok(match basis.dimension() {
        None => {
            let mut basis = basis;
            // Fractions grow: what it may cost is what is left.
            let proven = basis.certificate().proven || basis.prove(&equations, budget) == Ok(true);
            ClosingSet::Contradiction {
                cycles: contradictory(system, budget),
                proven,
            }
        }
        Some(0) => ClosingSet::Finite(real_solutions(system, &basis, budget)?),
        Some(dimension) => ClosingSet::Infinite {
            dimension,
            // What is met helps, and proves nothing where it is not: work that ends here ends no more than that.
            met: met(system, &basis, near, budget).unwrap_or_default(),
        },
    })
}

/// Cycles that contradict one another, none of which can be left out: one after the other is left out, where the rest contradicts
/// itself without it.
fn contradictory(system: &PolynomialSystem, budget: &Budget) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..system.cycles.len()).collect();
    for cycle in 0..system.cycles.len() {
        let rest: Vec<usize> = kept.iter().copied().filter(|&c| c != cycle).collect();
        let among = |index: &usize| {
            rest.iter()
                .any(|&c| system.cycles[c].equations.contains(index))
        };
        let of_none = |index: &usize| {
            let mut cycles = system.cycles.iter();
            !cycles.any(|cycle| cycle.equations.contains(index))
        };
        let equations: Vec<Polynomial> = (0..system.equations.len())
            .filter(|index| among(index) || of_none(index))
            .map(|index| system.equations[index].polynomial.clone())
            .collect();
        if basis(&equations, system, budget).is_ok_and(|basis| basis.is_inconsistent()) {
            kept = rest;
        }
    }
    kept
}

fn basis(
    equations: &[Polynomial],
    system: &PolynomialSystem,
    budget: &Budget,
) -> Result<GroebnerBasis, Stop> {
    let variables = system.variables.len();
    groebner_basis(equations, variables, &MonomialOrder::Degrevlex, budget)
}

fn real_solutions(
    system: &PolynomialSystem,
    basis: &GroebnerBasis,
    budget: &Budget,
) -> Result<Vec<RealSolution>, Stop> {
    let all: Vec<usize> = (0..system.variables.len()).collect();
    let solutions = isolated_solutions(system, &all, basis, budget)?;
    Ok(solutions.map_or_else(Vec::new, |Solutions { real, .. }| real))
}

/// Real solutions over the first values of free variables that have any.
fn met(
    system: &PolynomialSystem,
    basis: &GroebnerBasis,
    near: &[Rigid<f64>],
    budget: &Budget,
) -> Result<Vec<RealSolution>, Stop> {
    let point = system.point_at(near);
    for beside in BESIDE {
        for free in basis.independent_sets(FREE_SETS) {
            let mut equations = basis.polynomials().to_vec();
            equations.extend(
                free.iter()
                    .filter_map(|&variable| placed(system, variable, point[variable] + beside)),
            );
            let over = self::basis(&equations, system, budget)?;
            if over.dimension() != Some(0) {
                continue;
            }
            let real = real_solutions(system, &over, budget)?;
            if !real.is_empty() {
                return Ok(real);
            }
        }
    }
    Ok(Vec::new())
}

/// The equation that puts a variable near a value; that of a cosine or a quaternion's component between −1 and 1.
fn placed(system: &PolynomialSystem, variable: usize, value: f64) -> Option<Polynomial> {
    let variables = system.variables.len();
    let bounded = matches!(
        system.variables[variable].meaning,
        Meaning::Cosine { .. } | Meaning::Sine { .. } | Meaning::Quaternion { .. }
    );
    let value = if bounded {
        value.clamp(-1.0, 1.0)
    } else {
        value
    };
    let rounded = Rational::from_float((value * FINENESS).round() / FINENESS)?;
    Some(&Polynomial::variable(variable, variables) - &Polynomial::constant(rounded, variables))
}
