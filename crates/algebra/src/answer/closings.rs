//! Whether loops close at all, and where: what is asked before poses are searched.

use super::Solutions;
use super::solutions::isolated_solutions;
use crate::{
    Budget, Formulation, GroebnerBasis, Limits, Meaning, MonomialOrder, Polynomial,
    PolynomialSystem, Rational, RealSolution, Stop, SystemOptions, groebner_basis,
    polynomial_system,
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
    /// Whether the basis that tells was computed over the rational numbers. Otherwise it was found by way of primes, and checked as
    /// [`Certificate`](crate::Certificate) says.
    pub proven: bool,
}

/// The poses at which loops close.
#[derive(Clone, Debug)]
pub enum ClosingSet {
    /// The equations contradict one another, over the complex numbers too.
    Contradiction {
        /// Cycles of the system that contradict one another, with the couplings: indices in
        /// [`PolynomialSystem::cycles`]. None of them can be left out, as far as the budget told.
        cycles: Vec<usize>,
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
    let equations = system.polynomials();
    let mut basis = basis(&equations, &system, budget).ok()?;
    let set = closing_set(&system, &basis, near, budget).ok()?;
    let proven = is_proven(&mut basis, &equations, budget);
    Some(Closings {
        system,
        set,
        proven,
    })
}

/// An entry over the rationals costs as much as so many modulo a prime: fractions are long.
const RATIONAL_PRICE: u64 = 20;

/// Whether a basis is that of the equations with nothing left to primes, as far as what is left of the budget tells.
fn is_proven(basis: &mut GroebnerBasis, equations: &[Polynomial], budget: &Budget) -> bool {
    if basis.certificate().proven {
        return true;
    }
    let left = |most: u64| most.saturating_sub(budget.work()) / RATIONAL_PRICE;
    let own = Budget::new(Limits {
        work: budget.limits().work.map(left),
        ..budget.limits().clone()
    });
    let proven = basis.prove(equations, &own) == Ok(true);
    // Where that was too much, everything is done.
    let _ = budget.spend(own.work().saturating_mul(RATIONAL_PRICE));
    proven
}

fn closing_set(
    system: &PolynomialSystem,
    basis: &GroebnerBasis,
    near: &[Rigid<f64>],
    budget: &Budget,
) -> Result<ClosingSet, Stop> {
    Ok(match basis.dimension() {
        None => ClosingSet::Contradiction {
            cycles: contradictory(system, budget),
        },
        Some(0) => ClosingSet::Finite(real_solutions(system, basis, budget)?),
        Some(dimension) => ClosingSet::Infinite {
            dimension,
            // What is met helps, and proves nothing where it is not: work that ends here ends no more than that.
            met: met(system, basis, near, budget).unwrap_or_default(),
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{Direction, Frame, JointBuilder, JointKind, MechanismBuilder};

    fn length(text: &str) -> Number {
        Number::expression(text, &mut |_| Ok(None)).unwrap()
    }

    /// A crank of length 1 about z, whose pin is on a plane across x at so much from its pivot.
    fn pin_on_plane(at: &str) -> Closings {
        let mut builder = MechanismBuilder::new("pin");
        builder.link("ground").link("crank");
        let [x, z] = [0, 2].map(|along| {
            Direction([0, 1, 2].map(|i| {
                if i == along {
                    Number::one()
                } else {
                    Number::zero()
                }
            }))
        });
        let pivot = JointBuilder::tree("pivot", JointKind::Revolute, "ground", "crank");
        builder.joint(pivot.axis(z));
        let place = |x: Number, y: Number| Frame::at([x, y, Number::zero()]);
        builder.joint(
            JointBuilder::closing("plane", JointKind::PointOnPlane, "crank", "ground")
                .origin(place(Number::zero(), Number::one()))
                .successor_origin(place(length(at), Number::zero()))
                .axis2(x),
        );
        let mechanism = builder.build().unwrap();
        let links = vec![Rigid::identity(&1.0); 2];
        let joints = [JointId(0), JointId(1)];
        closings(&mechanism, &joints, &links, &Budget::unlimited()).unwrap()
    }

    #[test]
    fn all_real_poses_are_told() {
        let found = pin_on_plane("3/5");
        assert!(found.proven);
        let ClosingSet::Finite(real) = &found.set else {
            panic!("{:?}", found.set);
        };
        let mut heights: Vec<f64> = real
            .iter()
            .map(|at| {
                let pose = found.system.joint_pose(JointId(0), &at.values()).unwrap();
                pose.apply(&[0.0, 1.0, 0.0])[1]
            })
            .collect();
        heights.sort_by(f64::total_cmp);
        assert!((heights[0] + 0.8).abs() < 1e-12 && (heights[1] - 0.8).abs() < 1e-12);
    }

    #[test]
    fn out_of_reach_is_finite_and_not_real() {
        let found = pin_on_plane("2");
        assert!(matches!(&found.set, ClosingSet::Finite(real) if real.is_empty()));
    }
}
