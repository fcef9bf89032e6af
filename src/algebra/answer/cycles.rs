//! Every basic cycle by itself: what it leaves free, what it fixes, which links it makes one.

use super::fixed::{FixedVariable, fixed_variable};
use crate::algebra::strategy::Local;
use crate::algebra::system::CycleEquations;
use crate::algebra::{Budget, MonomialOrder, PolynomialSystem, Stop};
use crate::mechanism::{JointId, LinkId, Mechanism};

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

/// Looks at every cycle by itself.
pub(super) fn cycle_answers(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    budget: &Budget,
) -> Result<Vec<CycleAnswer>, Stop> {
    system
        .cycles
        .iter()
        .map(|cycle| cycle_answer(mechanism, system, cycle, budget))
        .collect()
}

fn cycle_answer(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    cycle: &CycleEquations,
    budget: &Budget,
) -> Result<CycleAnswer, Stop> {
    let equations: Vec<_> = cycle
        .equations
        .iter()
        .map(|&e| system.equations[e].polynomial.clone())
        .collect();
    let local = Local::new(&equations, system.variables.len());
    let basis = local.basis(&MonomialOrder::Degrevlex, budget)?;
    let mut answer = CycleAnswer {
        name: cycle_name(mechanism, cycle),
        joints: cycle.joints.iter().map(|(joint, _)| *joint).collect(),
        dimension: basis.dimension(),
        fixed: Vec::new(),
        rigid: Vec::new(),
        clusters: Vec::new(),
    };
    if basis.is_inconsistent() {
        return Ok(answer);
    }
    for (place, &variable) in local.variables.iter().enumerate() {
        if system.variables[variable].meaning.joint().is_none() {
            continue;
        }
        if let Some(fixed) = fixed_variable(&basis, place, variable, budget)? {
            answer.fixed.push(fixed);
        }
    }
    for &joint in &answer.joints {
        let variables = &system.joint_variables[joint.0];
        let is_fixed = |v: &usize| answer.fixed.iter().any(|f| f.variable == *v);
        if !variables.is_empty() && variables.iter().all(is_fixed) {
            answer.rigid.push(joint);
        }
    }
    answer.clusters = clusters(mechanism, &answer.rigid);
    Ok(answer)
}

/// The links that some joints hold together.
fn clusters(mechanism: &Mechanism, joints: &[JointId]) -> Vec<Vec<LinkId>> {
    let mut clusters: Vec<Vec<LinkId>> = Vec::new();
    for &joint in joints {
        let joint = mechanism.joint(joint);
        let ends = [joint.predecessor.link, joint.successor.link];
        let (mut joined, rest): (Vec<_>, Vec<_>) = clusters
            .into_iter()
            .partition(|c| ends.iter().any(|end| c.contains(end)));
        joined.push(ends.to_vec());
        let mut links: Vec<LinkId> = joined.concat();
        links.sort_unstable();
        links.dedup();
        clusters = rest;
        clusters.push(links);
    }
    clusters.sort();
    clusters
}
