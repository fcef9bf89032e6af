//! Every basic cycle by itself: what it leaves free, what it fixes, which links it makes one.

use super::Piece;
use super::clusters::{clusters, rigid_joints};
use super::fixed::{FixedVariable, fixed_variables};
use super::pieces::Pieces;
use super::relative_motion::{Part, ProvenMotion, Settled};
use super::solutions::isolated_solutions;
use crate::strategy::Local;
use crate::system::CycleEquations;
use crate::{Budget, GroebnerBasis, MonomialOrder, PolynomialSystem, Stop};
use kutzbach_model::mechanism::{JointId, LinkId, Mechanism};

/// What one cycle says without the others.
#[derive(Clone, Debug)]
pub struct CycleAnswer {
    /// Its joints, joined by dashes.
    pub name: String,
    /// Its joints in the order of the walk.
    pub joints: Vec<JointId>,
    /// Its complex dimension; `None` if it cannot be closed at all.
    pub dimension: Option<usize>,
    /// Variables with finitely many values.
    pub fixed: Vec<FixedVariable>,
    /// Joints all of whose freedoms are fixed: they hold their two links together.
    pub rigid: Vec<JointId>,
    /// Links that such joints make one body, at least two each.
    pub clusters: Vec<Vec<LinkId>>,
    /// Links that move relative to one another less than the joints between them allow.
    pub motions: Vec<ProvenMotion>,
    /// Whether all such links were found.
    pub settled: Settled,
}

/// A cycle's name.
pub(super) fn cycle_name(mechanism: &Mechanism, cycle: &CycleEquations) -> String {
    let names: Vec<&str> = cycle
        .joints
        .iter()
        .map(|(joint, _)| mechanism.joint(*joint).name.as_str())
        .collect();
    names.join(" – ")
}

/// What is known of the whole system before its cycles are looked at.
pub(super) struct Whole<'a> {
    pub(super) basis: Option<&'a GroebnerBasis>,
    pub(super) pieces: &'a [Piece],
    /// Whether the pieces were looked for to the end.
    pub(super) complete: bool,
}

/// Looks at a cycle by itself. Where it is all there is, what is known of the whole is not computed again.
pub(super) fn cycle_answer(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    cycle: &CycleEquations,
    whole: &Whole<'_>,
    budget: &Budget,
) -> Result<CycleAnswer, Stop> {
    let equations: Vec<_> = cycle
        .equations
        .iter()
        .map(|&e| system.equations[e].polynomial.clone())
        .collect();
    let local = Local::new(&equations, system.variables.len());
    let is_whole = cycle.equations.len() == system.equations.len();
    let same_ring = is_whole && local.variables.len() == system.variables.len();
    let basis = match whole.basis.filter(|_| same_ring) {
        Some(basis) => basis.clone(),
        None => local.basis(&MonomialOrder::Degrevlex, budget)?,
    };
    // A variable of its joints that no equation mentions is free.
    let of_joints = cycle
        .joints
        .iter()
        .flat_map(|(j, _)| &system.joint_variables[j.0]);
    let unmentioned = of_joints.filter(|v| !local.variables.contains(v)).count();
    let mut answer = CycleAnswer {
        name: cycle_name(mechanism, cycle),
        joints: cycle.joints.iter().map(|(joint, _)| *joint).collect(),
        dimension: basis.dimension().map(|d| d + unmentioned),
        fixed: Vec::new(),
        rigid: Vec::new(),
        clusters: Vec::new(),
        motions: Vec::new(),
        settled: Settled::Yes,
    };
    if basis.is_inconsistent() {
        return Ok(answer);
    }
    let solutions = isolated_solutions(system, &local.variables, &basis, budget)?;
    let solutions = solutions.as_ref();
    answer.fixed = fixed_variables(system, &local.variables, &basis, solutions, budget)?;
    // Links' places are not the cycle's own.
    let of_joint = |f: &FixedVariable| system.variables[f.variable].meaning.joint().is_some();
    answer.fixed.retain(of_joint);
    answer.rigid = rigid_joints(system, &answer.fixed, answer.joints.iter().copied());
    answer.clusters = clusters(mechanism, &answer.rigid);
    if answer.dimension == Some(0) {
        // Nothing moves; that is all that can be said of its links.
        return Ok(answer);
    }
    if system.home.exact().is_none() {
        answer.settled = Settled::NoHome;
        return Ok(answer);
    }
    let pieces = if is_whole && !whole.pieces.is_empty() {
        Pieces::known(&local, whole.pieces, whole.complete, budget)
    } else {
        Pieces::of(system, &local, &basis, budget)
    };
    match pieces {
        Ok(pieces) => {
            let part = Part {
                mechanism,
                system,
                local: &local,
                pieces: &pieces,
                rigid: &answer.clusters,
                budget,
            };
            let found = part.motions_in(cycle);
            answer.motions = found.motions;
            answer.settled = found.settled;
        }
        Err(stop) => answer.settled = Settled::Stopped(stop),
    }
    Ok(answer)
}
