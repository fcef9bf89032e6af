//! Everything the polynomials say about a mechanism: one call from the file's mechanism to the answer.
//!
//! The steps are those of the module above: equations, basis, what the basis says about the variables, the pieces of the
//! solution set, and the cycles looked at one by one. A budget that ends in the middle leaves what was found until then,
//! and [`ExactAnswer::stopped`] says at which step and why.

mod conditions;
mod cycles;
mod fixed;

pub use conditions::{Condition, DesignConditions, Family, assembly_conditions, motion_conditions};
pub use cycles::CycleAnswer;
pub use fixed::FixedVariable;

use super::strategy::{Group, Incremental, Problem, Relation, Step};
use super::{
    AlgebraicNumber, Budget, Component, Decomposition, FinitePoints, Formulation, GroebnerBasis,
    Hints, Meaning, MonomialOrder, Origin, Polynomial, PolynomialSystem, Rational, RealSolution,
    Stop, SystemError, SystemOptions, Univariate, brute_force, components, divide_and_conquer,
    incremental_instancing, polynomial_system,
};
use crate::mechanism::Mechanism;
use fixed::fixed_variables;

/// Bits to which the coordinates of isolated real solutions are enclosed.
const SOLUTION_BITS: u64 = 64;

/// Most sets of free variables that are listed.
const FREE_SETS: usize = 64;

/// How the basis is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// All equations at once.
    #[default]
    Brute,
    /// Cycle by cycle, then all bases together.
    Divide,
    /// Cycle by cycle, putting what is known into what follows.
    Incremental,
}

/// What is asked.
#[derive(Clone, Debug)]
pub struct ExactOptions {
    /// The unknowns.
    pub system: SystemOptions,
    /// How the basis is computed.
    pub method: Method,
    /// The order of the basis.
    pub order: MonomialOrder,
}

impl Default for ExactOptions {
    fn default() -> Self {
        Self {
            system: SystemOptions::default(),
            method: Method::default(),
            order: MonomialOrder::Degrevlex,
        }
    }
}

/// A piece of the solution set, and whether the drawn pose lies on it.
#[derive(Clone, Debug)]
pub struct Piece {
    /// The piece.
    pub component: Component,
    /// Whether the drawn pose lies on it; `None` where that pose is not known exactly.
    pub contains_home: Option<bool>,
}

/// Isolated solutions.
#[derive(Clone, Debug)]
pub struct Solutions {
    /// Number of distinct complex ones. Where algebraic numbers are among the variables, those of all conjugates count.
    pub complex: usize,
    /// The real ones, each coordinate enclosed.
    pub real: Vec<RealSolution>,
}

/// What the polynomials say.
#[derive(Clone, Debug)]
pub struct ExactAnswer {
    /// The equations.
    pub system: PolynomialSystem,
    /// What was computed on the way, and what it cost.
    pub steps: Vec<Step>,
    /// The basis of the whole; `None` where it was not reached, or not asked for ([`Method::Incremental`]).
    pub basis: Option<GroebnerBasis>,
    /// The cases of [`Method::Incremental`].
    pub cases: Option<Incremental>,
    /// The complex dimension of the solution set; inside, `None` where there is no solution. Outside, `None` where it was
    /// not reached.
    pub dimension: Option<Option<usize>>,
    /// Largest sets of variables that can be chosen freely (on some part of the solution set), at most 64.
    pub free: Vec<Vec<usize>>,
    /// Variables that take finitely many values.
    pub fixed: Vec<FixedVariable>,
    /// The pieces of the solution set.
    pub pieces: Vec<Piece>,
    /// Whether every piece is proven irreducible over the rationals.
    pub decomposed: bool,
    /// The solutions, where they are finitely many.
    pub solutions: Option<Solutions>,
    /// Every basic cycle by itself.
    pub cycles: Vec<CycleAnswer>,
    /// Where and why the computation ended early.
    pub stopped: Option<(&'static str, Stop)>,
}

/// Asks the polynomials of a mechanism.
///
/// # Errors
/// [`SystemError`] where the mechanism has no exact polynomial equations.
pub fn exact_answer(
    mechanism: &Mechanism,
    options: &ExactOptions,
    budget: &Budget,
) -> Result<ExactAnswer, SystemError> {
    let system = polynomial_system(mechanism, &options.system)?;
    let mut answer = ExactAnswer {
        system,
        steps: Vec::new(),
        basis: None,
        cases: None,
        dimension: None,
        free: Vec::new(),
        fixed: Vec::new(),
        pieces: Vec::new(),
        decomposed: false,
        solutions: None,
        cycles: Vec::new(),
        stopped: None,
    };
    if let Err(stop) = answer.find_basis(mechanism, options, budget) {
        answer.stopped = Some(("the basis", stop));
        return Ok(answer);
    }
    if let Err(stop) = answer.read_basis(budget) {
        answer.stopped = Some(("the values of fixed variables", stop));
        return Ok(answer);
    }
    if let Err(stop) = answer.find_solutions(budget) {
        answer.stopped = Some(("the isolated solutions", stop));
        return Ok(answer);
    }
    if let Err(stop) = answer.find_pieces(budget) {
        answer.stopped = Some(("the pieces of the solution set", stop));
        return Ok(answer);
    }
    match cycles::cycle_answers(mechanism, &answer.system, budget) {
        Ok(cycles) => answer.cycles = cycles,
        Err(stop) => answer.stopped = Some(("the cycles one by one", stop)),
    }
    Ok(answer)
}

impl ExactAnswer {
    fn find_basis(
        &mut self,
        mechanism: &Mechanism,
        options: &ExactOptions,
        budget: &Budget,
    ) -> Result<(), Stop> {
        let problem = problem(mechanism, &self.system);
        match options.method {
            Method::Brute => {
                let (step, basis) = brute_force(&problem, &options.order, budget)?;
                self.steps.push(step);
                self.basis = Some(basis);
            }
            Method::Divide => {
                let divided = divide_and_conquer(&problem, &options.order, budget)?;
                self.steps = divided.steps;
                self.basis = Some(divided.basis);
            }
            Method::Incremental => {
                let mut incremental = incremental_instancing(&problem, budget)?;
                self.steps = std::mem::take(&mut incremental.steps);
                self.dimension = Some(incremental.dimension());
                self.cases = Some(incremental);
            }
        }
        Ok(())
    }

    fn read_basis(&mut self, budget: &Budget) -> Result<(), Stop> {
        let Some(basis) = &self.basis else {
            return Ok(());
        };
        self.dimension = Some(basis.dimension());
        self.free = basis.independent_sets(FREE_SETS);
        if !basis.is_inconsistent() {
            self.fixed = fixed_variables(&self.system, basis, budget)?;
        }
        Ok(())
    }

    fn find_solutions(&mut self, budget: &Budget) -> Result<(), Stop> {
        let Some(basis) = self.basis.as_ref().filter(|b| b.dimension() == Some(0)) else {
            return Ok(());
        };
        let Some(points) = FinitePoints::new(basis, budget)? else {
            return Ok(());
        };
        let hints = hints(&self.system, budget)?;
        let mut real = points.real_solutions(SOLUTION_BITS, budget)?;
        real.retain(|solution| {
            hints.numbers.iter().all(|number| {
                let (low, high) = &solution.coordinates[number.variable];
                *low <= number.high && number.low <= *high
            })
        });
        self.solutions = Some(Solutions {
            complex: points.count(),
            real,
        });
        Ok(())
    }

    fn find_pieces(&mut self, budget: &Budget) -> Result<(), Stop> {
        if self.cases.is_some() {
            return Ok(());
        }
        let hints = hints(&self.system, budget)?;
        // A basis generates the same ideal and is nearer to the pieces.
        let equations: Vec<Polynomial> = match &self.basis {
            Some(basis) => basis.polynomials().to_vec(),
            None => self.system.polynomials(),
        };
        let Decomposition {
            pieces, complete, ..
        } = components(&equations, self.system.variables.len(), &hints, budget)?;
        self.decomposed = complete;
        self.pieces = pieces
            .into_iter()
            .map(|component| {
                let contains_home = component
                    .equations
                    .iter()
                    .map(|p| self.system.vanishes_at_home(p))
                    .try_fold(true, |all, one| one.map(|one| all && one));
                Piece {
                    component,
                    contains_home,
                }
            })
            .collect();
        Ok(())
    }

    /// The largest dimension of a piece with the drawn pose on it: the complex dimension there. `None` where the pieces or
    /// the pose are not known.
    #[must_use]
    pub fn dimension_at_home(&self) -> Option<usize> {
        if self
            .pieces
            .iter()
            .any(|piece| piece.contains_home.is_none())
        {
            return None;
        }
        self.pieces
            .iter()
            .filter(|piece| piece.contains_home == Some(true))
            .map(|piece| piece.component.dimension)
            .max()
    }
}

/// The equations of a mechanism, grouped by cycle.
pub(super) fn problem(mechanism: &Mechanism, system: &PolynomialSystem) -> Problem {
    let groups = system
        .cycles
        .iter()
        .map(|cycle| Group {
            name: cycles::cycle_name(mechanism, cycle),
            equations: cycle.equations.clone(),
        })
        .collect();
    Problem {
        variables: system.variables.len(),
        equations: system.polynomials(),
        groups,
    }
}

/// What the meaning of the variables says: angles and algebraic numbers.
fn hints(system: &PolynomialSystem, budget: &Budget) -> Result<Hints, Stop> {
    let mut hints = Hints::default();
    for (index, variable) in system.variables.iter().enumerate() {
        match &variable.meaning {
            Meaning::Sine {
                joint,
                freedom,
                axis_square,
            } if *axis_square == crate::number::Number::one() => {
                let cosine = system.variables.iter().position(|other| {
                    matches!(&other.meaning, Meaning::Cosine { joint: j, freedom: f }
                        if j == joint && f == freedom)
                });
                if let Some(cosine) = cosine {
                    hints.angles.push((cosine, index));
                }
            }
            Meaning::Algebraic { value } => {
                if let Some(number) = isolated(system, index, value, budget)? {
                    hints.numbers.push(number);
                }
            }
            _ => {}
        }
    }
    Ok(hints)
}

/// The interval of an algebraic number that no conjugate shares; `None` where its equation holds other variables too.
fn isolated(
    system: &PolynomialSystem,
    variable: usize,
    value: &crate::number::Number,
    budget: &Budget,
) -> Result<Option<AlgebraicNumber>, Stop> {
    let equation = system.equations.iter().find(
        |e| matches!(e.origin, super::Origin::MinimalPolynomial { variable: v } if v == variable),
    );
    let Some(univariate) =
        equation.and_then(|e| Univariate::from_polynomial(&e.polynomial, variable))
    else {
        return Ok(None);
    };
    let Some(near) = Rational::from_float(value.value()) else {
        return Ok(None);
    };
    let nearest = univariate
        .real_roots(budget)?
        .into_iter()
        .map(|root| univariate.refine(&root, SOLUTION_BITS))
        .min_by_key(|root| {
            let off = root.middle() - &near;
            if off < Rational::from_integer(0.into()) {
                -off
            } else {
                off
            }
        });
    Ok(nearest.map(|root| AlgebraicNumber {
        variable,
        low: root.low,
        high: root.high,
    }))
}

/// The relations of a mechanism for [`relation_by_relation`](super::relation_by_relation): the system, the equations that
/// hold before any relation, and the relations in the order of the file. In positional form a relation is a joint; in the
/// others it is a cycle, since what is not in a cycle relates nothing. Couplings come last.
///
/// # Errors
/// [`SystemError`] where the mechanism has no exact polynomial equations.
pub fn relations_of(
    mechanism: &Mechanism,
    options: &SystemOptions,
) -> Result<(PolynomialSystem, Vec<Polynomial>, Vec<Relation>), SystemError> {
    let system = polynomial_system(mechanism, options)?;
    let mut joints: Vec<Relation> = mechanism
        .joints()
        .iter()
        .map(|joint| Relation::named(&joint.name))
        .collect();
    let mut cycles: Vec<Relation> = system
        .cycles
        .iter()
        .map(|cycle| Relation::named(&cycles::cycle_name(mechanism, cycle)))
        .collect();
    let mut couplings: Vec<Relation> = mechanism
        .couplings()
        .iter()
        .map(|coupling| Relation::named(&coupling.name))
        .collect();
    let mut always = Vec::new();
    for equation in &system.equations {
        let list = match equation.origin {
            Origin::Cycle { cycle, .. } => &mut cycles[cycle].equations,
            Origin::Joint { joint } => &mut joints[joint.0].equations,
            Origin::Coupling { coupling } => &mut couplings[coupling].equations,
            _ => &mut always,
        };
        list.push(equation.polynomial.clone());
    }
    let relations = match options.formulation {
        Formulation::Positional => joints,
        Formulation::Canonical => cycles,
        Formulation::Tree => joints
            .into_iter()
            .filter(|relation| !relation.equations.is_empty())
            .collect(),
    };
    let relations = relations.into_iter().chain(couplings).collect();
    Ok((system, always, relations))
}
