//! Singular parts with loops that stand still by themselves: the joints of such a loop are fixed, and the part is asked again.
//!
//! A triangle whose sides lie on one line stands still, though to first order its corner gives way; so does a rod of several links
//! that is pulled straight. Where such a loop belongs to a larger part, the part's equations vanish on its branches to second order
//! and more, and power series tell little. But every motion of the part closes each of its loops. A joint that one loop alone keeps
//! where it is near the pose is kept there in the part as well, so that fixing it takes away no motion, and what it gives to first
//! order only is gone.
//!
//! A loop serves if its finite mobility is decided and is no more than what is idle in it: then its joints have the values drawn
//! near the pose, but for those that idle motions turn. This holds for real poses only, and says nothing of complex ones.
//!
//! Cost: the engines once for every loop, and once for what is left. Asked only of exact numbers where all other engines leave a
//! singular pose open.

use super::branch::{Branch, BranchPose, Tangent};
use super::chart::Kernel;
use super::claim::{Answer, Bounds, Claim, PartBranch};
use super::depth::Depth;
use super::idle_directions::{AT_REST, idle_directions};
use super::judge::PartFinding;
use super::more_digits::MoreDigits;
use super::options::{AnalysisError, AnalysisOptions};
use super::pose_rank::{PartRank, Pose, TALL, height_at, rank_part_with};
use super::question::{Again, Means, Question};
use super::tracing::{KERNEL_LIMIT, PartPose, tangents_at};
use super::vocabulary::{EngineName, PoseKind, Scope, SingularKind};
use kutzbach_closure::{JointState, Part, Section, Structure};
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::{JointId, JointKind, Mechanism};
use std::collections::BTreeSet;

/// Fills a finding that leaves a singular pose open, where fixing what stands still by itself decides it.
///
/// # Errors
/// [`AnalysisError`] where numbers overflow.
pub(super) fn with_loops_at_rest(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    structure: &Structure,
    (part, rank): (&Part, &PartRank),
    (options, again): (&AnalysisOptions, &Again),
    found: &mut PartFinding,
) -> Result<(), AnalysisError> {
    let open = found.open().is_some() && found.pose() == Some(PoseKind::Singular);
    if !is_exact_as_drawn(pose, rank) || !open || part.cycles.len() < 2 {
        return Ok(());
    }
    let still = joints_at_rest(pose, more, structure, (part, &part.cycles), again)?;
    if let Some(claim) = with_fixed(pose, (part, rank), &still, (options, again))? {
        found.take(claim);
    }
    Ok(())
}

/// Whether a part is asked at the pose drawn, with numbers that mean no others: what a loop keeps there is then kept for good.
fn is_exact_as_drawn(pose: &Pose<'_>, rank: &PartRank) -> bool {
    rank.open_by_digits() <= rank.accuracy && pose.as_drawn && pose.configuration.is_none()
}

/// Loops that are asked: those of the least freedom.
const MOST_ASKED: usize = 16;

/// Parts of more loops are not asked so: with each loop that stands still all engines are asked again of the rest, one within the other.
const MOST_LOOPS: usize = 64;

/// The joints that a loop passes, and whether each forward.
type Cycle = Vec<(usize, bool)>;

/// The same before a pose may be taken for regular. In a chain of linkages each of which drives the next from a dead centre, what the first
/// one moves by is squared from loop to loop, and after a few it is nothing in any number of digits: what stands still at the end
/// of the chain then looks as if it could be left out. So a part is asked anew with what a loop keeps as drawn that does not move to first
/// order, although by itself it gives way; where less is left than the velocities at the pose, the pose is singular, and what is left is
/// the answer.
///
/// # Errors
/// [`AnalysisError`] where numbers overflow.
pub(super) fn with_a_loop_that_does_not_start(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    structure: &Structure,
    (part, rank): (&Part, &PartRank),
    (options, again): (&AnalysisOptions, &Again),
    found: &mut PartFinding,
) -> Result<(), AnalysisError> {
    let loops = part.cycles.len();
    if !is_exact_as_drawn(pose, rank) || !(2..=MOST_LOOPS).contains(&loops) {
        return Ok(());
    }
    let Some(kernel) = Kernel::of(pose, rank, KERNEL_LIMIT)? else {
        return Ok(());
    };
    let moving = moving_joints(pose, part, &kernel);
    let mut cycles: Vec<_> = part.cycles.clone();
    cycles.retain(|cycle| cycle.iter().all(|(joint, _)| !moving.contains(joint)));
    // What was fixed before is passed in many loops, and is all of some.
    let freedom = |cycle: &Cycle| -> usize {
        let of = |(joint, _): &(usize, bool)| pose.mechanism.joints()[*joint].freedom();
        cycle.iter().map(of).sum()
    };
    cycles.retain(|cycle| freedom(cycle) > 0);
    cycles.sort_by_key(freedom);
    let mut still = BTreeSet::new();
    for cycle in cycles.into_iter().take(MOST_ASKED) {
        still = joints_at_rest(pose, more, structure, (part, &[cycle]), again)?;
        if !still.is_empty() {
            break;
        }
    }
    if let Some(mut claim) = with_fixed(pose, (part, rank), &still, (options, again))?
        && claim.answer().is_some()
        && claim.finite.upper < Some(kernel.basis.nullity)
    {
        claim.pose = Some(PoseKind::Singular);
        found.take(claim);
    }
    Ok(())
}

/// Joints that some velocity of a part moves.
fn moving_joints(pose: &Pose<'_>, part: &Part, kernel: &Kernel) -> BTreeSet<usize> {
    let mut moving = BTreeSet::new();
    let mut column = 0;
    for &joint in &part.joints {
        let columns = column..column + pose.mechanism.joints()[joint].freedom();
        column = columns.end;
        let mut vectors = kernel.basis.vectors.iter();
        if vectors.any(|v| v[columns.clone()].iter().any(|x| x.abs() > AT_REST)) {
            moving.insert(joint);
        }
    }
    moving
}

/// What all engines say of a part with these joints fixed; `None` where there are none.
fn with_fixed(
    pose: &Pose<'_>,
    (part, rank): (&Part, &PartRank),
    still: &BTreeSet<usize>,
    (options, again): (&AnalysisOptions, &Again),
) -> Result<Option<Claim>, AnalysisError> {
    if still.is_empty() {
        return Ok(None);
    }
    let whole: Vec<JointId> = part.joints.iter().map(|&joint| JointId(joint)).collect();
    let fixed: Vec<JointId> = still.iter().map(|&joint| JointId(joint)).collect();
    let left = pose
        .mechanism
        .with_others_put_aside(&whole)
        .with_joints_fixed_as_drawn(&fixed);
    let asked = AnalysisOptions {
        configuration: None,
        exact: options.exact,
        depth: Depth::Motions,
        closure_tolerance: None,
    };
    let answer = (again.mechanism)(&left, &asked)?;
    let names: Vec<&str> = still
        .iter()
        .map(|&joint| pose.mechanism.joints()[joint].name.as_str())
        .collect();
    // Bodies that nothing holds are none of the part.
    let loose = 6 * answer.structure.loose_pieces;
    let finite = answer
        .mobility
        .finite()
        .and_then(|all| all.checked_sub(loose));
    let claim = Claim::of(
        EngineName::LoopsAtRest,
        Scope::RealNeighbourhood,
        Bounds::ANY,
        format!(
            "single loops keep joints as drawn: {}; with these fixed: {}",
            names.join(", "),
            answer.mobility.certificate
        ),
    );
    let Some(finite) = finite.filter(|_| answer.assembly.steps == 0) else {
        return Ok(Some(claim));
    };
    let branches = match &answer.branches {
        Some(_) if finite == 0 => Some(Vec::new()),
        Some(branches) if loose == 0 => branches_of_part(pose, &left, part, rank, branches)?,
        _ => None,
    };
    let kind = match branches.as_deref() {
        _ if finite == 0 => Some(SingularKind::Shaky),
        Some([only]) if shaky(only) => Some(SingularKind::PermanentlyShaky),
        _ => answer.mobility.kind,
    };
    let told = answer.findings.iter().flat_map(PartFinding::claims);
    let within = told
        .filter(|claim| claim.engine == EngineName::LoopsAtRest)
        .any(|claim| claim.answer().is_some());
    let rest = &answer.mobility.certificate;
    // One loop after the other: the last one tells what is left.
    let certificate = match within {
        true => rest.clone(),
        false => format!(
            "single loops stand still and keep some of the joints as drawn; with these fixed: {rest}"
        ),
    };
    let claim = Claim {
        finite: Bounds::exactly(finite),
        ..claim
    };
    Ok(Some(claim.decides(Answer {
        kind,
        branches,
        ..Answer::numeric(certificate)
    })))
}

/// The joints of a part that some loop of these keeps as drawn whatever the others do.
fn joints_at_rest(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    structure: &Structure,
    (part, cycles): (&Part, &[Cycle]),
    again: &Again,
) -> Result<BTreeSet<usize>, AnalysisError> {
    let mut still = BTreeSet::new();
    for cycle in cycles {
        let passed: BTreeSet<usize> = cycle.iter().map(|(joint, _)| *joint).collect();
        let own = Part {
            joints: part
                .joints
                .iter()
                .copied()
                .filter(|joint| passed.contains(joint))
                .collect(),
            cycles: vec![cycle.clone()],
            couplings: Vec::new(),
        };
        let rank = rank_part_with(pose, more, &own, None)?;
        let Some(kernel) = Kernel::of(pose, &rank, KERNEL_LIMIT)?.filter(|k| k.basis.complete)
        else {
            continue;
        };
        let by_kind = height_at(pose, &own) > TALL;
        let idle = idle_directions(pose.mechanism, &own, &kernel, by_kind);
        if kernel.basis.nullity == idle.len() {
            continue;
        }
        let question = Question::new(pose, structure, (&own, &rank), Depth::Verdict);
        let mut means = Means { more, whole: None };
        let found = (again.part)(&question, &mut means)?;
        if found.open().is_some() || found.upper() != idle.len() {
            continue;
        }
        let mut column = 0;
        for &joint in &own.joints {
            let kind = pose.mechanism.joints()[joint].kind;
            let columns = column..column + kind.freedom();
            column = columns.end;
            let rests = idle
                .iter()
                .all(|way| way[columns.clone()].iter().all(|x| x.abs() < AT_REST));
            let drawn = pose.states[joint].values.iter().all(|x| *x == 0.0);
            if rests && drawn && kind.freedom() > 0 && kind != JointKind::Distance {
                still.insert(joint);
            }
        }
    }
    Ok(still)
}

/// Whether at every pose of a branch more moves to first order than along it.
fn shaky(branch: &PartBranch) -> bool {
    branch
        .poses
        .iter()
        .all(|p| p.instantaneous.is_some_and(|i| i > branch.dimension))
}

/// Branches of what is left, as branches of the part: the joints that were fixed stand still. `None` where a rank on one is open.
fn branches_of_part(
    pose: &Pose<'_>,
    left: &Mechanism,
    part: &Part,
    rank: &PartRank,
    branches: &[Branch],
) -> Result<Option<Vec<PartBranch>>, MatrixError> {
    let Some(kernel) = Kernel::of(pose, rank, KERNEL_LIMIT)? else {
        return Ok(None);
    };
    let section = Section {
        mechanism: pose.mechanism,
        geometry: pose.geometry,
        part,
        metric: &kernel.metric,
    };
    let mut of_part = Vec::with_capacity(branches.len());
    for branch in branches {
        let mut poses = Vec::with_capacity(branch.poses.len());
        for there in &branch.poses {
            let states = states_of_part(pose, part, left, there);
            let seen = tangents_at(&section, &states, rank.open_by_digits(), branch.dimension)?;
            poses.push(PartPose {
                states: part.joints.iter().map(|&j| states[j].clone()).collect(),
                tangents: tangents_of_part(pose.mechanism, part, left, there),
                instantaneous: seen.and_then(|(tangents, _)| tangents.instantaneous),
                surplus: rank.unknowns() as i64 - rank.equations() as i64,
            });
        }
        if poses.is_empty() || poses.iter().any(|p| p.instantaneous.is_none()) {
            return Ok(None);
        }
        of_part.push(PartBranch {
            dimension: branch.dimension,
            half_branches: branch.half_branches,
            poses,
        });
    }
    Ok(Some(of_part))
}

/// The states of all joints at a pose of what is left.
fn states_of_part(
    pose: &Pose<'_>,
    part: &Part,
    left: &Mechanism,
    there: &BranchPose,
) -> Vec<JointState<f64>> {
    let mut states = pose.states.to_vec();
    for &joint in &part.joints {
        if left.joints()[joint].kind == pose.mechanism.joints()[joint].kind {
            states[joint] = there.states[joint].clone();
        }
    }
    states
}

/// The tangents at a pose of what is left, in the unknowns of the part.
fn tangents_of_part(
    mechanism: &Mechanism,
    part: &Part,
    left: &Mechanism,
    there: &BranchPose,
) -> Vec<Vec<f64>> {
    let first = left.variable_offsets();
    let rates = |tangent: &Tangent| -> Vec<f64> {
        let mut rates = Vec::new();
        for &joint in &part.joints {
            rates.extend((first[joint]..first[joint + 1]).map(|variable| tangent[variable]));
            // A joint that was fixed has no variables any more.
            rates.resize(
                rates.len() + mechanism.joints()[joint].freedom() - left.joints()[joint].freedom(),
                0.0,
            );
        }
        rates
    };
    there.tangents.iter().map(rates).collect()
}
