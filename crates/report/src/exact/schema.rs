//! The exact report as data.

use super::motions::{Motion, motions, unsettled};
use super::values::{FixedJoint, doubles, fixed_freedoms, fixed_joints};
use kutzbach_algebra::{
    Case, ExactAnswer, ExactOptions, Formulation, GroebnerBasis, Instance, Irreducible, Learned,
    Meaning, Method, MonomialOrder, PolynomialSystem, RealPoints, Stop,
};
use kutzbach_model::mechanism::{LinkId, Mechanism};
use serde::Serialize;

/// The version of the JSON.
pub const EXACT_SCHEMA: &str = "kutzbach-exact-1";

/// What was asked and of which file.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// The file as it was named.
    pub file: String,
    /// Joints that are held, with their values, as they were asked for.
    pub held: Vec<String>,
    /// What was asked.
    pub options: ExactOptions,
    /// List the equations.
    pub equations: bool,
    /// List the polynomials of the basis.
    pub basis: bool,
    /// Say how long the steps took.
    pub timing: bool,
}

/// Whether the computation came to its end.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// `done` or `stopped`.
    pub word: &'static str,
    /// Where it stopped.
    pub at: Option<&'static str>,
    /// Why.
    pub why: Option<String>,
}

/// What is known of the solutions modulo a prime only: evidence, no proof.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Modulo {
    /// The prime.
    pub prime: u64,
    /// Complex dimension of the solutions modulo it; `null` where there are none.
    pub dimension: Option<usize>,
}

/// A variable with finitely many values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fixed {
    /// Its name.
    pub variable: String,
    /// The equation it satisfies; `null` where there are finitely many solutions, which tell the values.
    pub polynomial: Option<String>,
    /// The real roots of that equation, or its values at the real solutions, in double precision.
    pub values: Vec<f64>,
}

/// A piece of the solution set.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Piece {
    /// Complex dimension.
    pub dimension: usize,
    /// Degree.
    pub degree: Option<usize>,
    /// `yes`, `no` or `unknown`: whether it is one piece over the rationals.
    pub irreducible: &'static str,
    /// Its real points: `finite`, `full dimension`, `some`, `not found`, `none` or `unknown`.
    pub real: &'static str,
    /// How many real points, where they are finitely many.
    pub real_points: Option<usize>,
    /// Whether the drawn pose lies on it; `null` where that pose is not known exactly.
    pub contains_home: Option<bool>,
    /// The number (from 1) of an earlier piece that consists of the same poses, by the other sign of quaternions.
    pub same_poses_as: Option<usize>,
    /// Variables that can be chosen freely on it.
    pub free: Vec<String>,
    /// Its equations.
    pub equations: Vec<String>,
}

/// Isolated solutions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solutions {
    /// Distinct complex ones, with all conjugates of the algebraic numbers among the variables.
    pub complex: usize,
    /// Algebraic numbers among the variables, of which `complex` counts all conjugates.
    pub conjugates_of: Vec<String>,
    /// The real ones with the numbers of the file: the values of all variables, in their order.
    pub real: Vec<Vec<f64>>,
}

/// One cycle by itself.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cycle {
    /// Its joints.
    pub name: String,
    /// Complex dimension; `null` if it cannot be closed.
    pub dimension: Option<usize>,
    /// Freedoms with finitely many values, in words.
    pub fixed: Vec<String>,
    /// The same joint by joint.
    pub fixed_joints: Vec<FixedJoint>,
    /// Links that it makes one body.
    pub rigid_clusters: Vec<Vec<String>>,
    /// Links whose relative motion is less than the joints between them allow, proven.
    pub motions: Vec<Motion>,
    /// Why there may be more such links, or motions may be smaller; `null` where nothing was left open.
    pub motions_unsettled: Option<String>,
}

/// What a cycle gave the unknowns, with `incremental`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Instanced {
    /// The cycle.
    pub cycle: String,
    /// Every case that it leaves: the unknowns and what took their places, a number or an expression in others.
    pub cases: Vec<Vec<InstanceRow>>,
}

/// An unknown and what took its place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InstanceRow {
    /// The unknown.
    pub variable: String,
    /// What it equals.
    pub value: String,
}

/// One step of the computation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StepRow {
    /// The cycle, or what else was worked on.
    pub name: String,
    /// Variables that occur.
    pub variables: usize,
    /// Equations that went in.
    pub equations: usize,
    /// Polynomials of the basis.
    pub basis: usize,
    /// Complex dimension; `null` if there is no solution.
    pub dimension: Option<usize>,
    /// Matrix entries that were eliminated: the same on every machine.
    pub work: u64,
    /// Wall time, only where it was asked for.
    pub seconds: Option<f64>,
}

/// What the polynomials say.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExactReport {
    /// [`EXACT_SCHEMA`].
    pub schema: &'static str,
    /// The mechanism.
    pub mechanism: String,
    /// The file.
    pub file: String,
    /// Joints that are held, with their values, as they were asked for; all that is said is of the mechanism held so.
    pub held: Vec<String>,
    /// `canonical`, `tree` or `positional`.
    pub formulation: &'static str,
    /// `brute`, `divide` or `incremental`.
    pub method: &'static str,
    /// The order of the basis.
    pub order: String,
    /// The variables' names, in order.
    pub variables: Vec<String>,
    /// Number of equations.
    pub equation_count: usize,
    /// Whether it came to its end.
    pub outcome: Outcome,
    /// Whether there is a solution at all, complex ones included; `null` where it was not decided.
    pub consistent: Option<bool>,
    /// Complex dimension of the solution set; `null` where there is none or it was not decided.
    pub dimension: Option<usize>,
    /// The same modulo one prime, where the basis over the rationals was not reached but that one was.
    pub dimension_modulo: Option<Modulo>,
    /// Degree of its part of largest dimension.
    pub degree: Option<usize>,
    /// Complex dimension at the drawn pose: the largest of the pieces through it.
    pub dimension_at_home: Option<usize>,
    /// Where that was not reached: complex dimension at the drawn pose, at least and at most.
    pub dimension_at_home_within: Option<[usize; 2]>,
    /// `exact`: the drawn pose solves the equations; `open`: it does not, the mechanism has to be assembled first;
    /// `unknown`: it is not known exactly.
    pub drawn_pose: &'static str,
    /// Largest sets of variables that can be chosen freely on some part of the solution set.
    pub free: Vec<Vec<String>>,
    /// Variables with finitely many values.
    pub fixed: Vec<Fixed>,
    /// The same in words, freedom by freedom.
    pub fixed_freedoms: Vec<String>,
    /// The same joint by joint.
    pub fixed_joints: Vec<FixedJoint>,
    /// Links that are one body in every assembly mode.
    pub rigid_clusters: Vec<Vec<String>>,
    /// Joints, and links relative to the ground, that the whole leaves less than the joints and the cycles by themselves
    /// do; empty where one cycle is all there is.
    pub motions: Vec<Motion>,
    /// Why there may be more of them, or motions may be smaller; `null` where nothing was left open.
    pub motions_unsettled: Option<String>,
    /// The pieces; `null` where they were not looked for.
    pub pieces: Option<Vec<Piece>>,
    /// Whether every piece is proven irreducible over the rationals.
    pub fully_split: bool,
    /// Isolated solutions, where there are finitely many.
    pub solutions: Option<Solutions>,
    /// Cycles by themselves.
    pub cycles: Vec<Cycle>,
    /// Cases of the incremental method: for every part of the equations that shares no variable with others, the dimensions of
    /// its cases.
    pub cases: Option<Vec<Vec<usize>>>,
    /// What every cycle gave the unknowns, with the incremental method.
    pub instanced: Option<Vec<Instanced>>,
    /// What was computed, step by step.
    pub steps: Vec<StepRow>,
    /// What was checked of the basis.
    pub certificate: Option<String>,
    /// How balls and the like are written.
    pub charts: Vec<String>,
    /// What the equations leave out of the mechanism; dimensions are then upper bounds.
    pub relaxations: Vec<String>,
    /// Whether the file's decimals were taken as exact fractions although they look rounded: what holds of the fractions
    /// need not hold of the mechanism that was meant.
    pub rounded_numbers_taken_literally: bool,
    /// The equations, where they were asked for.
    pub equations: Option<Vec<String>>,
    /// The basis, where it was asked for.
    pub basis: Option<Vec<String>>,
}

/// An answer as data.
#[must_use]
pub fn exact_report(mechanism: &Mechanism, answer: &ExactAnswer, request: &Request) -> ExactReport {
    let system = &answer.system;
    let names = system.names();
    let named =
        |list: &[usize]| -> Vec<String> { list.iter().map(|&v| names[v].clone()).collect() };
    let basis = answer.basis.as_ref();
    ExactReport {
        schema: EXACT_SCHEMA,
        mechanism: mechanism.name().to_owned(),
        file: request.file.clone(),
        held: request.held.clone(),
        formulation: formulation_word(request.options.system.formulation),
        method: match answer.method {
            Method::Brute => "brute",
            Method::Divide => "divide",
            Method::Incremental => "incremental",
        },
        order: match &answer.ordered {
            Some(ordered) => format!("lex with {}", named(&ordered.variables).join(" > ")),
            None => order_word(&request.options.order),
        },
        equation_count: system.equations.len(),
        outcome: outcome(answer.stopped),
        consistent: answer.dimension.map(|d| d.is_some()),
        dimension: answer.dimension.flatten(),
        dimension_modulo: answer
            .dimension_modulo
            .map(|(prime, dimension)| Modulo { prime, dimension }),
        degree: basis
            .filter(|b| !b.is_inconsistent())
            .and_then(|b| b.degree()),
        dimension_at_home: answer.dimension_at_home(),
        dimension_at_home_within: answer.at_home_within.map(|(least, most)| [least, most]),
        drawn_pose: match system.home {
            kutzbach_algebra::HomePose::Exact(_) => "exact",
            kutzbach_algebra::HomePose::Open { .. } => "open",
            _ => "unknown",
        },
        free: answer.free.iter().map(|set| named(set)).collect(),
        fixed: answer
            .fixed
            .iter()
            .map(|fixed| Fixed {
                variable: names[fixed.variable].clone(),
                polynomial: fixed.polynomial.as_ref().map(|p| p.text(&names)),
                values: doubles(fixed),
            })
            .collect(),
        fixed_freedoms: fixed_freedoms(mechanism, system, &answer.fixed),
        fixed_joints: fixed_joints(mechanism, system, &answer.fixed),
        rigid_clusters: clusters(mechanism, &answer.clusters),
        motions: motions(mechanism, None, &answer.motions),
        motions_unsettled: answer.motions_settled.and_then(unsettled),
        pieces: (!answer.pieces.is_empty() || answer.decomposed).then(|| {
            let piece = |piece| self::piece(piece, &names);
            answer.pieces.iter().map(piece).collect()
        }),
        fully_split: answer.decomposed,
        solutions: answer.solutions.as_ref().map(|solutions| Solutions {
            complex: solutions.complex,
            conjugates_of: algebraic_numbers(system),
            real: solutions.real.iter().map(|s| s.values()).collect(),
        }),
        cycles: cycles(mechanism, answer),
        cases: answer.cases.as_ref().map(|found| {
            let dimensions = |part: &Vec<Case>| part.iter().map(|case| case.dimension).collect();
            found.parts.iter().map(dimensions).collect()
        }),
        instanced: answer.cases.as_ref().map(|found| {
            let cycle = |learned: &Learned| instanced(learned, &names);
            found.learned.iter().map(cycle).collect()
        }),
        steps: steps(answer, request.timing),
        certificate: basis.map(|b| b.certificate().text()),
        charts: system.charts.clone(),
        relaxations: system.relaxations.iter().map(ToString::to_string).collect(),
        rounded_numbers_taken_literally: !mechanism.precision().is_exact(),
        equations: request.equations.then(|| {
            let text = |p: &kutzbach_algebra::Polynomial| p.text(&names);
            system
                .equations
                .iter()
                .map(|e| text(&e.polynomial))
                .collect()
        }),
        basis: request
            .basis
            .then(|| match (&answer.ordered, basis) {
                (Some(ordered), _) => Some(texts(&ordered.basis, &named(&ordered.variables))),
                (None, Some(basis)) => Some(texts(basis, &names)),
                (None, None) => None,
            })
            .flatten(),
        variables: names,
    }
}

fn texts(basis: &GroebnerBasis, names: &[String]) -> Vec<String> {
    basis.polynomials().iter().map(|p| p.text(names)).collect()
}

fn instanced(learned: &Learned, names: &[String]) -> Instanced {
    let row = |instance: &Instance| InstanceRow {
        variable: names[instance.variable].clone(),
        value: instance.value.text(names),
    };
    Instanced {
        cycle: learned.cycle.clone(),
        cases: learned
            .cases
            .iter()
            .map(|case| case.iter().map(row).collect())
            .collect(),
    }
}

fn algebraic_numbers(system: &PolynomialSystem) -> Vec<String> {
    let variables = system.variables.iter();
    variables
        .filter(|variable| matches!(variable.meaning, Meaning::Algebraic { .. }))
        .map(|variable| variable.name.clone())
        .collect()
}

pub(super) fn formulation_word(formulation: Formulation) -> &'static str {
    match formulation {
        Formulation::Canonical => "canonical",
        Formulation::Tree => "tree",
        Formulation::Positional => "positional",
    }
}

fn order_word(order: &MonomialOrder) -> String {
    match order {
        MonomialOrder::Degrevlex => "degrevlex".to_owned(),
        MonomialOrder::Lexicographic => "lex".to_owned(),
        MonomialOrder::Elimination(first) => format!("elimination of {first}"),
    }
}

pub(super) fn outcome(stopped: Option<(&'static str, Stop)>) -> Outcome {
    Outcome {
        word: if stopped.is_some() { "stopped" } else { "done" },
        at: stopped.map(|(at, _)| at),
        why: stopped.map(|(_, stop)| stop.to_string()),
    }
}

fn piece(piece: &kutzbach_algebra::Piece, names: &[String]) -> Piece {
    let component = &piece.component;
    Piece {
        dimension: component.dimension,
        degree: component.degree,
        irreducible: match component.irreducible {
            Irreducible::Yes => "yes",
            Irreducible::Unknown => "unknown",
            _ => "no",
        },
        real: match component.real {
            RealPoints::Finite(_) => "finite",
            RealPoints::FullDimension => "full dimension",
            RealPoints::Some => "some",
            RealPoints::NotFound => "not found",
            RealPoints::None => "none",
            RealPoints::Unknown => "unknown",
        },
        real_points: match component.real {
            RealPoints::Finite(count) => Some(count),
            RealPoints::None => Some(0),
            _ => None,
        },
        contains_home: piece.contains_home,
        same_poses_as: piece.same_poses_as.map(|first| first + 1),
        free: component.free.iter().map(|&v| names[v].clone()).collect(),
        equations: component.equations.iter().map(|p| p.text(names)).collect(),
    }
}

fn cycles(mechanism: &Mechanism, answer: &ExactAnswer) -> Vec<Cycle> {
    answer
        .cycles
        .iter()
        .map(|cycle| Cycle {
            name: cycle.name.clone(),
            dimension: cycle.dimension,
            fixed: fixed_freedoms(mechanism, &answer.system, &cycle.fixed),
            fixed_joints: fixed_joints(mechanism, &answer.system, &cycle.fixed),
            rigid_clusters: clusters(mechanism, &cycle.clusters),
            motions: motions(mechanism, Some(cycle), &cycle.motions),
            motions_unsettled: cycle.dimension.and_then(|_| unsettled(cycle.settled)),
        })
        .collect()
}

fn clusters(mechanism: &Mechanism, clusters: &[Vec<LinkId>]) -> Vec<Vec<String>> {
    let name = |link: &LinkId| mechanism.link(*link).name.clone();
    clusters
        .iter()
        .map(|links| links.iter().map(name).collect())
        .collect()
}

fn steps(answer: &ExactAnswer, timing: bool) -> Vec<StepRow> {
    answer
        .steps
        .iter()
        .map(|step| StepRow {
            name: step.name.clone(),
            variables: step.variables,
            equations: step.equations,
            basis: step.basis,
            dimension: step.dimension,
            work: step.work,
            seconds: timing.then_some(step.time.as_secs_f64()),
        })
        .collect()
}
