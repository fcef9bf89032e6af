//! All poses at which a part closes, by exact algebra: before poses are searched, and of poses that were assembled.
//!
//! Where the numbers are exact the equations of the loops are the mechanism's, and a Groebner basis of them says of all poses at once
//! whether there are any, or finitely many, and which. What is told as proved rests on a basis computed over the rational numbers; where that
//! takes longer than it may, one found by way of primes and checked by another ([`kutzbach_algebra::Certificate`]) still says where to look.

use super::{ExactAllowance, ExactFinding, is_too_large, numbers_are_exact};
use crate::judge::PartFinding;
use crate::pose_rank::{PartRank, Pose, is_computed, numbers};
use kutzbach_algebra::{ClosingSet, Closings, PolynomialSystem, RealSolution, closings};
use kutzbach_closure::{
    Geometry, JointPoses, JointState, Obstacle, Part, ProvenOpen, Solved, spanning_poses,
};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Configuration, JointId, Mechanism};

/// A mechanism whose parts are asked about.
#[derive(Clone, Copy)]
pub(crate) struct Whole<'a> {
    pub mechanism: &'a Mechanism,
    pub configuration: Option<&'a Configuration>,
    pub geometry: &'a Geometry<f64>,
}

/// Why all poses of a part are not asked about, whatever the budget.
fn unsuited(whole: Whole<'_>, part: &Part) -> Option<&'static str> {
    let Whole {
        mechanism,
        configuration,
        ..
    } = whole;
    if is_too_large(mechanism, part) {
        return Some("too many joints");
    }
    if !numbers_are_exact(mechanism, configuration, part) {
        return Some("the numbers are rounded");
    }
    // The last bits of such doubles mean nothing, and would contradict one another.
    let computed = numbers(mechanism, part).any(Number::is_full_double);
    computed.then_some("the numbers are doubles that a program computed")
}

/// What exact algebra knows of the poses at which a part closes. Each part is asked about once.
fn known<'k>(
    whole: Whole<'_>,
    part: &Part,
    states: &[JointState<f64>],
    allowance: &'k mut ExactAllowance,
) -> Option<&'k Closings> {
    let Whole {
        mechanism,
        geometry,
        ..
    } = whole;
    if allowance.each == 0 || unsuited(whole, part).is_some() {
        return None;
    }
    if !allowance.closings.contains_key(&part.joints) {
        let budget = allowance.of_a_part();
        let joints: Vec<JointId> = part.joints.iter().map(|&j| JointId(j)).collect();
        let (links, _) = spanning_poses(mechanism, geometry, states);
        let found = closings(mechanism, &joints, &links, &budget);
        allowance.take(&budget);
        allowance.closings.insert(part.joints.clone(), found);
    }
    allowance.closings.get(&part.joints)?.as_ref()
}

/// The same for whoever closes the part.
pub(crate) fn solved(
    whole: Whole<'_>,
    part: &Part,
    states: &[JointState<f64>],
    allowance: &mut ExactAllowance,
) -> Solved {
    let Some(Closings {
        system,
        set,
        proven,
    }) = known(whole, part, states, allowance)
    else {
        return Solved::Unknown;
    };
    let poses = |real: &[RealSolution]| -> Vec<JointPoses> {
        let poses = real
            .iter()
            .map(|at| joint_poses(system, part, &at.values()));
        poses.collect()
    };
    match set {
        ClosingSet::Contradiction { .. } if !proven => Solved::Unknown,
        ClosingSet::Contradiction { cycles } => Solved::Never(ProvenOpen {
            joint: named(whole.mechanism, system, cycles, part),
            obstacle: Obstacle::Contradiction(cycles.len()),
        }),
        ClosingSet::Finite(real) if real.is_empty() && !proven => Solved::Unknown,
        ClosingSet::Finite(real) if real.is_empty() => {
            let all: Vec<usize> = (0..system.cycles.len()).collect();
            Solved::Never(ProvenOpen {
                joint: named(whole.mechanism, system, &all, part),
                obstacle: Obstacle::NoRealSolution(all.len()),
            })
        }
        ClosingSet::Finite(real) => Solved::All(poses(real)),
        ClosingSet::Infinite { met, .. } if met.is_empty() => Solved::Unknown,
        ClosingSet::Infinite { met, .. } => Solved::Some(poses(met)),
    }
}

/// The joint by which cycles are called: one that closes a loop in the file, the first by name.
fn named(mechanism: &Mechanism, system: &PolynomialSystem, cycles: &[usize], part: &Part) -> usize {
    let walked = cycles.iter().flat_map(|&c| &system.cycles[c].joints);
    let of_cycles = walked.map(|(joint, _)| joint.0);
    let all = of_cycles.chain(part.joints.iter().copied().filter(|_| cycles.is_empty()));
    let by_name = |joint: &usize| {
        let joint = &mechanism.joints()[*joint];
        (!joint.closes_loop, joint.name.clone())
    };
    all.min_by_key(by_name).unwrap_or_default()
}

/// Where the joints stand that a system has variables for.
fn joint_poses(system: &PolynomialSystem, part: &Part, values: &[f64]) -> JointPoses {
    let pose = |&joint: &usize| Some((joint, system.joint_pose(JointId(joint), values)?));
    part.joints.iter().filter_map(pose).collect()
}

/// Solutions are enclosed to 64 bits. A pose that closes to rounding is within its square root of an isolated solution, and of a solution of
/// higher multiplicity within a higher root, a thousandth at most: beyond (rad, m), it is none of them.
const SAME: f64 = 1e-3;

/// What is true of the part at every pose, for one that was assembled.
pub(super) fn everywhere(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    found: &PartFinding,
    allowance: &mut ExactAllowance,
) -> Result<ExactFinding, String> {
    let whole = Whole {
        mechanism: pose.mechanism,
        configuration: pose.configuration,
        geometry: pose.geometry,
    };
    if rank.open_by_digits() > 0.0 || rank.is_taken_literally() {
        return Err("not asked: the numbers are rounded".to_owned());
    }
    if found.open().is_none() && found.lower() > 0 {
        return Err("not asked: the pose was assembled, and it moves there".to_owned());
    }
    if let Some(why) = unsuited(whole, part) {
        return Err(format!("not asked: {why}"));
    }
    let away = |system: &PolynomialSystem, real: &[RealSolution]| {
        let mut solutions = real.iter();
        !solutions.any(|at| is_at(pose, part, &joint_poses(system, part, &at.values())))
    };
    let Some(Closings {
        system,
        set,
        proven,
    }) = known(whole, part, pose.states, allowance)
    else {
        return Err(
            "the pose was assembled, and nothing about all poses within its budget".to_owned(),
        );
    };
    let most = rank.candidates.1;
    let mut answer = ExactFinding {
        tangent: most,
        upper: most,
        proven: None,
        complex_dimension: None,
        certificate: String::new(),
        text: format!(
            "of all poses: {} equations in {} unknowns",
            system.equations.len(),
            system.variables.len()
        ),
    };
    match set {
        ClosingSet::Infinite { dimension, .. } => {
            if *proven {
                answer.upper = most.min(*dimension);
            }
            answer.text.push_str(&format!(", dimension {dimension}"));
        }
        // What rests on primes is no proof: other engines have to leave no fewer.
        ClosingSet::Finite(real) if !away(system, real) && !proven => {
            answer.upper = 0;
            answer.text.push_str(", finitely many solutions by several primes");
        }
        ClosingSet::Finite(real) if !away(system, real) => answer.prove(
            0,
            "the closure equations have finitely many solutions, over the complex numbers too, so that every closed pose is isolated",
        ),
        ClosingSet::Finite(_) | ClosingSet::Contradiction { .. } => {
            // What was computed from decimals closes within these as well as it can.
            allowance.elsewhere |= !is_computed(pose.mechanism, part);
            return Err("the loops do not close at this pose, but within rounding".to_owned());
        }
    }
    Ok(answer)
}

/// Whether a part stands at a pose, but for what closing to rounding leaves open.
fn is_at(pose: &Pose<'_>, part: &Part, there: &JointPoses) -> bool {
    let near = |joint: usize| {
        let displacement = &pose.geometry.displacements[joint];
        let here = displacement.displacement(&pose.states[joint]);
        let Some((_, there)) = there.iter().find(|(other, _)| *other == joint) else {
            return true;
        };
        let off = here.inverse().compose(there);
        let largest = off.rotation_vector().into_iter().chain(off.translation);
        largest.fold(0.0, |most: f64, x| most.max(x.abs())) < SAME
    };
    part.joints.iter().all(|&joint| near(joint))
}
