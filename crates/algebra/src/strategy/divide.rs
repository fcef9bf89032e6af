//! Brute force, and divide and conquer.

use super::group::{Local, Problem, about_the_same, basis_by_parts, mentioned};
use crate::engine::groebner_basis_noting;
use crate::{Budget, GroebnerBasis, MonomialOrder, Polynomial, Stop};
use std::time::{Duration, Instant};

/// What one step of a strategy cost and found.
#[derive(Clone, Debug)]
pub struct Step {
    /// The cycle, or what else was worked on.
    pub name: String,
    /// Variables that occur.
    pub variables: usize,
    /// Equations that went in.
    pub equations: usize,
    /// Polynomials of the basis.
    pub basis: usize,
    /// Dimension of the solution set of these equations in their own variables; `None` if there is no solution.
    pub dimension: Option<usize>,
    /// Work in matrix entries, the same on every machine.
    pub work: u64,
    /// Wall time.
    pub time: Duration,
}

/// The result of divide and conquer.
#[derive(Clone, Debug)]
pub struct Divided {
    /// One step per cycle, then the step for all of them together.
    pub steps: Vec<Step>,
    /// The basis of every cycle, in the ring of all variables.
    pub cycles: Vec<Vec<Polynomial>>,
    /// The basis of the whole.
    pub basis: GroebnerBasis,
}

/// The basis of all equations at once.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn brute_force(
    problem: &Problem,
    order: &MonomialOrder,
    budget: &Budget,
) -> Result<(Step, GroebnerBasis), Stop> {
    brute_force_noting(problem, order, budget, &mut None)
}

/// The same; notes the dimension modulo the first prime as soon as it is known.
pub(crate) fn brute_force_noting(
    problem: &Problem,
    order: &MonomialOrder,
    budget: &Budget,
    modulo: &mut Option<(u64, Option<usize>)>,
) -> Result<(Step, GroebnerBasis), Stop> {
    let clock = Clock::start(budget);
    let variables = problem.variables;
    let basis = groebner_basis_noting(&problem.equations, variables, order, budget, modulo)?;
    let variables = mentioned(&problem.equations, problem.variables);
    let step = clock.step(
        "all equations",
        variables.len(),
        problem.equations.len(),
        &basis,
        problem.variables - variables.len(),
    );
    Ok((step, basis))
}

/// The basis of every group, the smallest first, then of all these bases together. What smaller groups say about the
/// variables of a group is used with its equations. What shares no variable in the end is not mixed: cycles in different
/// blocks of the constraint graph, and cycles that meet only in joints that stand still.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn divide_and_conquer(
    problem: &Problem,
    order: &MonomialOrder,
    budget: &Budget,
) -> Result<Divided, Stop> {
    let mut steps = Vec::new();
    let mut cycles: Vec<Vec<Polynomial>> = Vec::new();
    for group in problem.smallest_first() {
        let clock = Clock::start(budget);
        let mut equations = problem.equations_of(group);
        let known = about_the_same(cycles.iter().flatten(), &equations);
        equations.extend(known);
        let local = Local::new(&equations, problem.variables);
        let basis = local.basis(order, budget)?;
        steps.push(clock.step(
            &group.name,
            local.variables.len(),
            local.equations.len(),
            &basis,
            0,
        ));
        cycles.push(basis.polynomials().iter().map(|p| local.lift(p)).collect());
    }
    let clock = Clock::start(budget);
    let mut together = problem.ungrouped();
    for cycle in &cycles {
        for polynomial in cycle {
            if !together.contains(polynomial) {
                together.push(polynomial.clone());
            }
        }
    }
    let basis = basis_by_parts(&together, problem.variables, order, budget)?;
    let variables = mentioned(&together, problem.variables);
    steps.push(clock.step(
        "all cycles together",
        variables.len(),
        together.len(),
        &basis,
        problem.variables - variables.len(),
    ));
    Ok(Divided {
        steps,
        cycles,
        basis,
    })
}

/// Time and work of a step.
pub(super) struct Clock<'a> {
    budget: &'a Budget,
    started: Instant,
    work: u64,
}

impl<'a> Clock<'a> {
    pub(super) fn start(budget: &'a Budget) -> Self {
        Self {
            budget,
            started: Instant::now(),
            work: budget.work(),
        }
    }

    /// `absent` variables of the basis's ring occur in no equation; their freedom is not counted.
    pub(super) fn step(
        &self,
        name: &str,
        variables: usize,
        equations: usize,
        basis: &GroebnerBasis,
        absent: usize,
    ) -> Step {
        Step {
            name: name.to_owned(),
            variables,
            equations,
            basis: basis.polynomials().len(),
            dimension: basis.dimension().map(|d| d - absent),
            work: self.budget.work() - self.work,
            time: self.started.elapsed(),
        }
    }
}
