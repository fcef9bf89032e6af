//! Everything the polynomials say about a mechanism: one call from the file's mechanism to the answer.
//!
//! The steps are those of the module above: equations, basis, what the basis says about the variables, the pieces of the
//! solution set, and the cycles looked at one by one. A budget that ends in the middle leaves what was found until then,
//! and [`ExactAnswer::stopped`] says at which step and why.

mod at_home;
mod blocks;
mod closings;
mod clusters;
mod conditions;
mod cycles;
mod exceptions;
mod fixed;
mod hints;
mod pieces;
mod relative_motion;
mod same_poses;
mod solutions;
mod subgroup;

pub use at_home::accepted_at_home;
pub use blocks::{BlockAnswer, BlockFinding, ByBlocks, exact_by_blocks};
pub use closings::{ClosingSet, Closings, closings};
pub use conditions::{Condition, DesignConditions, Family, assembly_conditions, motion_conditions};
pub use cycles::CycleAnswer;
pub use exceptions::{Exception, Exceptions};
pub use fixed::FixedVariable;
pub use relative_motion::{ProvenMotion, Scope, Settled};
pub use solutions::Solutions;

use super::strategy::{
    Bodies, Group, Incremental, Local, Problem, Relation, Relations, Step, basis_by_parts,
    brute_force_noting,
};
use super::{
    Budget, Component, Decomposition, Formulation, GroebnerBasis, Incomplete, Meaning,
    MonomialOrder, Origin, Polynomial, PolynomialSystem, Stop, SystemError, SystemOptions,
    components, divide_and_conquer, incremental_instancing, polynomial_system,
};
use crate::components::components_of;
use clusters::mechanism_clusters;
use cycles::{Whole, cycle_answer};
use fixed::fixed_variables;
use hints::hints;
use kutzbach_model::mechanism::{Joint, LinkId, Mechanism};
use pieces::Pieces;
use relative_motion::Part;
use same_poses::first_of_same_poses;
use solutions::isolated_solutions;

/// Most sets of free variables that are listed.
const FREE_SETS: usize = 64;

/// Share of the effort that the whole system may take, so that some is left for its cycles.
const SHARE_OF_THE_WHOLE: f64 = 0.8;

/// Share of it that the basis may take where the cases of [`Method::Incremental`] have told the dimension already.
const SHARE_OF_THE_BASIS: f64 = 0.5;

/// Most combinations of cases of which the pieces are put together where there is no basis of the whole.
const MOST_COMBINATIONS: usize = 64;

/// How the basis is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// All equations at once.
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
    /// How the basis is computed; `None` leaves the choice to the equations: [`Method::Divide`] where they fall into parts
    /// that share no variable, [`Method::Brute`] elsewhere.
    pub method: Option<Method>,
    /// The order of the basis.
    pub order: MonomialOrder,
    /// Names of variables, the most significant first, of which a lexicographic basis is wanted besides; those that are not named come
    /// after in their order. Empty: none.
    pub variable_order: Vec<String>,
}

impl Default for ExactOptions {
    fn default() -> Self {
        Self {
            system: SystemOptions::default(),
            method: None,
            order: MonomialOrder::Degrevlex,
            variable_order: Vec::new(),
        }
    }
}

/// A lexicographic basis in an order of the variables that was asked for.
#[derive(Clone, Debug)]
pub struct Ordered {
    /// The variables, the most significant first.
    pub variables: Vec<usize>,
    /// The basis, in the ring of the variables so ordered.
    pub basis: GroebnerBasis,
}

/// A piece of the solution set, and whether the drawn pose lies on it.
#[derive(Clone, Debug)]
pub struct Piece {
    /// The piece.
    pub component: Component,
    /// Whether the drawn pose lies on it; `None` where that pose is not known exactly.
    pub contains_home: Option<bool>,
    /// The first piece that consists of the same poses, by the other sign of some quaternions; `None` where this is it.
    pub same_poses_as: Option<usize>,
}

/// What the polynomials say.
#[derive(Clone, Debug)]
pub struct ExactAnswer {
    /// The equations.
    pub system: PolynomialSystem,
    /// How the basis was computed.
    pub method: Method,
    /// What was computed on the way, and what it cost.
    pub steps: Vec<Step>,
    /// The basis of the whole; `None` where it was not reached.
    pub basis: Option<GroebnerBasis>,
    /// The lexicographic basis in the order of variables that was asked for, where one was and it was reached.
    pub ordered: Option<Ordered>,
    /// The cases of [`Method::Incremental`].
    pub cases: Option<Incremental>,
    /// The complex dimension of the solution set; inside, `None` where there is no solution. Outside, `None` where it was
    /// not reached.
    pub dimension: Option<Option<usize>>,
    /// Where the basis was not reached, but was modulo one prime: that prime, and the complex dimension of the solutions
    /// modulo it; inside, `None` where there is none. Evidence and no proof: for all but finitely many primes it is that
    /// over the rationals. Found with [`Method::Brute`] only.
    pub dimension_modulo: Option<(u64, Option<usize>)>,
    /// Largest sets of variables that can be chosen freely (on some part of the solution set), at most 64.
    pub free: Vec<Vec<usize>>,
    /// Variables that take finitely many values.
    pub fixed: Vec<FixedVariable>,
    /// The pieces of the solution set.
    pub pieces: Vec<Piece>,
    /// Whether every piece is proven irreducible over the rationals.
    pub decomposed: bool,
    /// Why the pieces were not looked for to the end, where they were not.
    pub pieces_stopped: Option<Stop>,
    /// The solutions, where they are finitely many.
    pub solutions: Option<Solutions>,
    /// Every basic cycle by itself.
    pub cycles: Vec<CycleAnswer>,
    /// Links that the mechanism makes one body, at least two each, in every assembly mode.
    pub clusters: Vec<Vec<LinkId>>,
    /// Joints, and links relative to the ground, that the whole leaves less than the joints and the cycles by themselves
    /// do. Empty where one cycle is all there is: then it speaks for the whole.
    pub motions: Vec<ProvenMotion>,
    /// Whether all such motions were found; `None` where they were not looked for.
    pub motions_settled: Option<Settled>,
    /// Where the computation ended before the pieces told the dimension at the drawn pose: at least and at most so much, by the
    /// number of equations and by their rank there.
    pub at_home_within: Option<(usize, usize)>,
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
    let mut answer = ExactAnswer::unasked(mechanism, options)?;
    // Should the whole be out of reach, its cycles may not be.
    let most = budget.with_share(SHARE_OF_THE_WHOLE);
    answer.stopped = answer.find_whole(mechanism, options, &most).err();
    budget.take_over(&most);
    if matches!(answer.stopped, Some((_, Stop::Cancelled))) {
        return Ok(answer);
    }
    if answer.stopped.is_some() {
        answer.at_home_within = at_home::bounds(mechanism, options, &answer.system);
    }
    answer.find_cycles(mechanism, budget);
    answer.find_motions(mechanism, budget);
    Ok(answer)
}

impl ExactAnswer {
    /// The equations, before anything is found of them.
    fn unasked(mechanism: &Mechanism, options: &ExactOptions) -> Result<Self, SystemError> {
        let system = polynomial_system(mechanism, &options.system)?;
        let known = |name: &String| system.variables.iter().any(|v| v.name == *name);
        if let Some(name) = options.variable_order.iter().find(|name| !known(name)) {
            return Err(SystemError::UnknownVariable {
                name: name.clone(),
                known: system.names().join(", "),
            });
        }
        let method = options.method.unwrap_or_else(|| {
            match problem(mechanism, &system).independent().len() {
                0 | 1 => Method::Brute,
                _ => Method::Divide,
            }
        });
        Ok(Self {
            system,
            method,
            steps: Vec::new(),
            basis: None,
            ordered: None,
            cases: None,
            dimension: None,
            dimension_modulo: None,
            free: Vec::new(),
            fixed: Vec::new(),
            pieces: Vec::new(),
            decomposed: false,
            pieces_stopped: None,
            solutions: None,
            cycles: Vec::new(),
            clusters: Vec::new(),
            motions: Vec::new(),
            motions_settled: None,
            at_home_within: None,
            stopped: None,
        })
    }

    /// Everything that is asked of the whole system, or where and why it ended early.
    fn find_whole(
        &mut self,
        mechanism: &Mechanism,
        options: &ExactOptions,
        budget: &Budget,
    ) -> Result<(), (&'static str, Stop)> {
        let at = |step: &'static str| move |stop: Stop| (step, stop);
        self.find_basis(mechanism, options, budget)
            .map_err(at("the basis"))?;
        self.read_basis();
        self.find_ordered(options, budget)
            .map_err(at("the lexicographic basis"))?;
        self.find_solutions(budget)
            .map_err(at("the isolated solutions"))?;
        self.find_fixed(budget)
            .map_err(at("the values of fixed variables"))?;
        self.find_pieces(budget)
            .map_err(at("the pieces of the solution set"))
    }

    fn find_basis(
        &mut self,
        mechanism: &Mechanism,
        options: &ExactOptions,
        budget: &Budget,
    ) -> Result<(), Stop> {
        let problem = problem(mechanism, &self.system);
        match self.method {
            Method::Brute => {
                let modulo = &mut self.dimension_modulo;
                let (step, basis) = brute_force_noting(&problem, &options.order, budget, modulo)?;
                // What is known of the rationals needs no evidence.
                self.dimension_modulo = None;
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
                let equations = incremental.simpler(&problem.equations);
                self.cases = Some(incremental);
                // What is read off a basis is the same whichever way led to it; where there is none, the cases tell it.
                let share = budget.with_share(SHARE_OF_THE_BASIS);
                let basis = basis_by_parts(&equations, problem.variables, &options.order, &share);
                budget.take_over(&share);
                match basis {
                    Ok(basis) => self.basis = Some(basis),
                    Err(Stop::Cancelled) => return Err(Stop::Cancelled),
                    Err(_) => {}
                }
            }
        }
        Ok(())
    }

    fn find_ordered(&mut self, options: &ExactOptions, budget: &Budget) -> Result<(), Stop> {
        let Some(basis) = self
            .basis
            .as_ref()
            .filter(|_| !options.variable_order.is_empty())
        else {
            return Ok(());
        };
        let count = self.system.variables.len();
        let place = |v: &usize| {
            let mut named = options.variable_order.iter();
            named
                .position(|name| *name == self.system.variables[*v].name)
                .unwrap_or(usize::MAX)
        };
        let mut variables = self.all_variables();
        variables.sort_by_key(place);
        let mut places = vec![0; count];
        for (place, &variable) in variables.iter().enumerate() {
            places[variable] = place;
        }
        let moved: Vec<Polynomial> = basis
            .polynomials()
            .iter()
            .map(|p| p.moved(&places, count))
            .collect();
        let basis = basis_by_parts(&moved, count, &MonomialOrder::Lexicographic, budget)?;
        self.ordered = Some(Ordered { variables, basis });
        Ok(())
    }

    fn read_basis(&mut self) {
        if let Some(basis) = &self.basis {
            self.dimension = Some(basis.dimension());
            self.free = basis.independent_sets(FREE_SETS);
        } else if let Some(cases) = &self.cases {
            self.free = cases.free(self.system.variables.len(), FREE_SETS);
        }
    }

    /// The ring of the whole: every variable at its own place.
    fn all_variables(&self) -> Vec<usize> {
        (0..self.system.variables.len()).collect()
    }

    fn find_fixed(&mut self, budget: &Budget) -> Result<(), Stop> {
        if let Some(basis) = self.basis.as_ref().filter(|b| !b.is_inconsistent()) {
            let (all, solutions) = (self.all_variables(), self.solutions.as_ref());
            self.fixed = fixed_variables(&self.system, &all, basis, solutions, budget)?;
        }
        Ok(())
    }

    fn find_solutions(&mut self, budget: &Budget) -> Result<(), Stop> {
        if let Some(basis) = &self.basis {
            let all = self.all_variables();
            self.solutions = isolated_solutions(&self.system, &all, basis, budget)?;
        }
        Ok(())
    }

    fn find_pieces(&mut self, budget: &Budget) -> Result<(), Stop> {
        let hints = hints(&self.system, budget)?;
        let variables = self.system.variables.len();
        let found = match (&self.basis, &self.cases) {
            // A basis generates the same ideal and is nearer to the pieces.
            (Some(basis), _) => components(basis.polynomials(), variables, &hints, budget)?,
            (None, Some(cases)) => match cases.combined(MOST_COMBINATIONS) {
                Some(sets) => components_of(&sets, variables, &hints, budget)?,
                None => return Ok(()),
            },
            (None, None) => components(&self.system.polynomials(), variables, &hints, budget)?,
        };
        let Decomposition {
            pieces,
            complete,
            why,
        } = found;
        self.decomposed = complete;
        // Before anything else that may end here: what follows must not take these pieces for all there are.
        if let Some(Incomplete::Stopped(stop)) = why {
            self.pieces_stopped = Some(stop);
        }
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
                    same_poses_as: None,
                }
            })
            .collect();
        let first = first_of_same_poses(&self.system, &self.pieces, budget)?;
        for (index, (piece, first)) in self.pieces.iter_mut().zip(first).enumerate() {
            piece.same_poses_as = (first != index).then_some(first);
        }
        // A piece that is too large is not the end of everything; time that is over is.
        budget.check()
    }

    fn find_cycles(&mut self, mechanism: &Mechanism, budget: &Budget) {
        let whole = Whole {
            basis: self.basis.as_ref(),
            pieces: &self.pieces,
            complete: self.pieces_stopped.is_none(),
        };
        for cycle in &self.system.cycles {
            match cycle_answer(mechanism, &self.system, cycle, &whole, budget) {
                Ok(answer) => self.cycles.push(answer),
                Err(stop) => {
                    self.stopped.get_or_insert(("the cycles one by one", stop));
                    break;
                }
            }
        }
        let of_cycles = self.cycles.iter().flat_map(|cycle| cycle.clusters.clone());
        self.clusters = mechanism_clusters(mechanism, &self.system, &self.fixed, of_cycles);
    }

    /// What the links of the whole are left with, where several cycles or a coupling make that more than one cycle says.
    fn find_motions(&mut self, mechanism: &Mechanism, budget: &Budget) {
        let [first, ..] = self.system.cycles.as_slice() else {
            return;
        };
        let Some(basis) = self.basis.as_ref().filter(|b| b.dimension() > Some(0)) else {
            // Nothing is there, or nothing moves.
            return;
        };
        if first.equations.len() == self.system.equations.len() {
            return;
        }
        if self.system.home.exact().is_none() {
            self.motions_settled = Some(Settled::NoHome);
            return;
        }
        let local = Local::whole(&self.system.polynomials(), self.system.variables.len());
        let complete = self.pieces_stopped.is_none();
        let pieces = if self.pieces.is_empty() {
            Ok(Pieces::unknown(basis))
        } else {
            Pieces::known(&local, &self.pieces, complete, budget)
        };
        let pieces = match pieces {
            Ok(pieces) => pieces,
            Err(stop) => {
                self.motions_settled = Some(Settled::Stopped(stop));
                return;
            }
        };
        let known = self.cycles.iter().flat_map(|cycle| cycle.motions.clone());
        let known: Vec<ProvenMotion> = known.collect();
        let part = Part {
            mechanism,
            system: &self.system,
            local: &local,
            pieces: &pieces,
            rigid: &self.clusters,
            budget,
        };
        let found = part.motions_of_all(&known);
        self.motions = found.motions;
        self.motions_settled = Some(found.settled);
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

/// The relations of a mechanism for [`relation_by_relation`](super::relation_by_relation), with the system that they are of:
/// in the order of the file. In positional form a relation is a joint; in the
/// others it is a cycle, since what is not in a cycle relates nothing. Couplings come last.
///
/// # Errors
/// [`SystemError`] where the mechanism has no exact polynomial equations.
pub fn relations_of(
    mechanism: &Mechanism,
    options: &SystemOptions,
) -> Result<(PolynomialSystem, Relations), SystemError> {
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
    let of_bodies = |meaning: &Meaning| {
        matches!(
            meaning,
            Meaning::BodyRotation { .. }
                | Meaning::BodyTranslation { .. }
                | Meaning::Algebraic { .. }
        )
    };
    let between_bodies = options.formulation == Formulation::Positional
        && system.variables.iter().all(|v| of_bodies(&v.meaning));
    let bodies = between_bodies.then(|| bodies(mechanism, &system));
    // In positional form couplings have no equations.
    let couplings = couplings.into_iter().filter(|_| bodies.is_none());
    let given = Relations {
        always,
        relations: relations.into_iter().chain(couplings).collect(),
        variables: system.variables.len(),
        bodies,
    };
    Ok((system, given))
}

/// The links as bodies, and the two of every joint.
fn bodies(mechanism: &Mechanism, system: &PolynomialSystem) -> Bodies {
    let mut variables = vec![vec![0; 12]; mechanism.links().len()];
    variables[mechanism.ground().0].clear();
    for (index, variable) in system.variables.iter().enumerate() {
        match variable.meaning {
            Meaning::BodyRotation { link, row, column } => {
                variables[link.0][3 * row + column] = index;
            }
            Meaning::BodyTranslation { link, row } => variables[link.0][9 + row] = index,
            _ => {}
        }
    }
    let ends = |joint: &Joint| [joint.predecessor.link.0, joint.successor.link.0];
    Bodies {
        ground: mechanism.ground().0,
        variables,
        of: mechanism.joints().iter().map(ends).collect(),
    }
}
