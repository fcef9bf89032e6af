//! Other starts, where the drawn pose and its neighbours lead to no closing.
//!
//! Damped Gauss–Newton finds a closing from most starts within reach of one, and ends in a local minimum of the gap from
//! others. So it is begun anew from poses spread widely: angles over a turn or within their limits, translations over the
//! part's length or within theirs, balls over all orientations. All of them are made from names, so that the same mechanism
//! gets the same starts. Every other one closes the cycles one after the other, which takes the joints of each to where the
//! next can follow. Joints that a motor drives keep their drawn values at first: what is drawn of them is meant.
//!
//! Among the closings found, one within the joint limits goes first, then the one nearest to the drawn pose. Not finding
//! any proves nothing, and the number of starts is reported with it.

use super::super::displacement::JointState;
use super::super::jacobian::Part;
use super::descent::{Effort, Kept, PartOutcome, Task, descend};
use super::limits;
use super::nearest::{distance, settle, unwind};
use kutzbach_math::matrix::{MatrixError, SplitMix64};
use kutzbach_model::mechanism::{FreedomPart, Joint, JointKind, Mechanism};
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

/// Starts of a search that finds nothing.
pub(super) const STARTS: usize = 256;

/// Starts that a search goes on after its first closing, in case another one is nearer or within the limits.
const FURTHER: usize = 12;

/// And as long as none is within the limits.
const FURTHER_OUTSIDE: usize = 64;

/// Of the starts, this share leaves the driven joints where they are drawn.
const DRIVEN_KEPT: f64 = 0.25;

/// Cycles are closed one after the other where they are no more than this.
const CYCLES_ONE_BY_ONE: usize = 12;

/// What a search came to.
pub(super) struct Search {
    /// Starts made.
    pub(super) starts: usize,
    pub(super) steps: usize,
    /// The best closing; where there is none, the pose that misses by least.
    pub(super) best: Option<PartOutcome>,
}

/// How good a closing is: less is better.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) struct Merit {
    /// By how much joints are outside their limits there.
    pub(super) outside: f64,
    pub(super) moves_driven: bool,
    /// From the pose to be near to.
    pub(super) distance: f64,
}

/// The joints of a part that something drives: motors of the file, joints marked as independent coordinates, or driven in a
/// scene.
pub(super) fn driven(mechanism: &Mechanism, part: &Part) -> BTreeSet<usize> {
    let named: BTreeSet<usize> = mechanism
        .scene()
        .iter()
        .flat_map(|scene| scene.drives.iter().map(|drive| drive.joint.0))
        .chain(mechanism.actuated().iter().map(|joint| joint.0))
        .collect();
    let is_driven = |joint: usize| {
        mechanism.joints()[joint].independent == Some(true) || named.contains(&joint)
    };
    part.joints
        .iter()
        .copied()
        .filter(|&joint| is_driven(joint))
        .collect()
}

/// Looks for a closing from up to `starts` poses, as long as there is `work` left (floating-point operations, roughly).
/// The states end at the best one; where there is none, at the pose that misses by least.
pub(super) fn search(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    reference: &[JointState<f64>],
    starts: usize,
    work: &mut f64,
) -> Result<Search, MatrixError> {
    let begun = Kept::of(task.part, states);
    let kept_still: BTreeSet<usize> = driven(task.mechanism, task.part)
        .union(task.held)
        .copied()
        .collect();
    let passive = task
        .part
        .joints
        .iter()
        .filter(|joint| !kept_still.contains(joint))
        .count();
    let driven_kept = if passive > 0 && kept_still.len() > task.held.len() {
        (DRIVEN_KEPT * starts as f64) as usize
    } else {
        0
    };
    let careful = Task {
        held: &kept_still,
        ..*task
    };
    let mut best: Option<(Merit, Kept<f64>, PartOutcome)> = None;
    let mut found = Search {
        starts: 0,
        steps: 0,
        best: None,
    };
    if let Some(settled) = by_groups(&careful, states, reference, starts, work, &mut found)? {
        let merit = Merit {
            outside: limits::excess(task, states),
            moves_driven: false,
            distance: distance(task, reference, states, &settled),
        };
        if merit.outside == 0.0 {
            found.best = Some(settled);
            return Ok(found);
        }
        best = Some((merit, Kept::of(task.part, states), settled));
    }
    let mut nearest: Option<(Kept<f64>, PartOutcome)> = None;
    let mut last = starts;
    while found.starts < last && *work > 0.0 {
        let index = found.starts;
        let moves_driven = index >= driven_kept;
        if index == driven_kept && best.is_some() {
            break;
        }
        let here = if moves_driven { task } else { &careful };
        begun.put_back(states);
        if moves_driven || index > 0 {
            spread(here, index, reference, states);
        }
        let grown = index % 2 == 1 && (2..=CYCLES_ONE_BY_ONE).contains(&task.part.cycles.len());
        if grown {
            grow(here, states, &mut found.steps, work)?;
        }
        let outcome = descend(here, states, Effort::SHORT)?;
        found.starts += 1;
        found.steps += outcome.steps;
        *work -= outcome.work;
        if !outcome.closed() {
            if best.is_none()
                && nearest
                    .as_ref()
                    .is_none_or(|(_, least)| outcome.residual < least.residual)
            {
                nearest = Some((Kept::of(task.part, states), outcome));
            }
            continue;
        }
        unwind(here, reference, states);
        let outcome = descend(here, states, Effort::SHORT)?;
        let settled = settle(here, reference, states, outcome, work)?;
        let merit = Merit {
            outside: limits::excess(task, states),
            moves_driven,
            distance: distance(task, reference, states, &settled),
        };
        if settled.closed() {
            let further = match merit.outside > 0.0 {
                true => FURTHER_OUTSIDE,
                false => FURTHER,
            };
            last = last.min(found.starts + further);
        }
        if settled.closed() && best.as_ref().is_none_or(|(least, ..)| merit < *least) {
            best = Some((merit, Kept::of(task.part, states), settled));
        }
    }
    match best.map(|(_, pose, outcome)| (pose, outcome)).or(nearest) {
        Some((pose, outcome)) => {
            pose.put_back(states);
            found.best = Some(outcome);
        }
        None => begun.put_back(states),
    }
    Ok(found)
}

/// Closes groups of cycles one by one that share no joint which may move, as the legs of a walking machine do once its crank
/// is held. `None` where there is but one group, or one does not close; the states are then as they were.
fn by_groups(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    reference: &[JointState<f64>],
    starts: usize,
    work: &mut f64,
    found: &mut Search,
) -> Result<Option<PartOutcome>, MatrixError> {
    let groups = groups(task);
    if groups.len() < 2 {
        return Ok(None);
    }
    let begun = Kept::of(task.part, states);
    for part in &groups {
        let group = Task { part, ..*task };
        let here = search(&group, states, reference, starts, work)?;
        found.starts += here.starts;
        found.steps += here.steps;
        if !here.best.as_ref().is_some_and(PartOutcome::closed) {
            begun.put_back(states);
            return Ok(None);
        }
    }
    let outcome = descend(task, states, Effort::SHORT)?;
    if !outcome.closed() {
        begun.put_back(states);
        return Ok(None);
    }
    Ok(Some(outcome))
}

/// The cycles and couplings of a part, parted by the joints that may move.
fn groups(task: &Task<'_>) -> Vec<Part> {
    let part = task.part;
    let movable = |joint: &usize| !task.held.contains(joint);
    let sets = part
        .cycles
        .iter()
        .map(|cycle| cycle.iter().map(|(joint, _)| *joint).collect::<Vec<_>>());
    let tied = part.couplings.iter().map(|&coupling| {
        task.geometry.couplings[coupling]
            .joints()
            .collect::<Vec<_>>()
    });
    let sets: Vec<BTreeSet<usize>> = sets
        .chain(tied)
        .map(|joints| joints.into_iter().filter(movable).collect())
        .collect();
    let mut groups: Vec<(BTreeSet<usize>, Vec<usize>)> = Vec::new();
    for (index, joints) in sets.iter().enumerate() {
        let mut grown = (joints.clone(), vec![index]);
        let (touched, apart): (Vec<_>, Vec<_>) = groups
            .into_iter()
            .partition(|(others, _)| !others.is_disjoint(joints));
        for (others, members) in touched {
            grown.0.extend(others);
            grown.1.extend(members);
        }
        groups = apart;
        groups.push(grown);
    }
    let cycles = part.cycles.len();
    groups
        .into_iter()
        .map(|(_, mut members)| {
            members.sort_unstable();
            let (in_cycles, in_couplings): (Vec<usize>, Vec<usize>) =
                members.into_iter().partition(|&index| index < cycles);
            let walked = in_cycles.iter().flat_map(|&i| &part.cycles[i]);
            let related = in_couplings
                .iter()
                .flat_map(|&i| task.geometry.couplings[part.couplings[i - cycles]].joints());
            let inside: BTreeSet<usize> = walked.map(|(joint, _)| *joint).chain(related).collect();
            let joints = part.joints.iter().copied();
            Part {
                joints: joints.filter(|joint| inside.contains(joint)).collect(),
                cycles: in_cycles.iter().map(|&i| part.cycles[i].clone()).collect(),
                couplings: in_couplings
                    .iter()
                    .map(|&i| part.couplings[i - cycles])
                    .collect(),
            }
        })
        .collect()
}

/// Closes the first cycle, then the first two, and so on.
fn grow(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    steps: &mut usize,
    work: &mut f64,
) -> Result<(), MatrixError> {
    for count in 1..task.part.cycles.len() {
        let cycles = &task.part.cycles[..count];
        let inside: BTreeSet<usize> = cycles.iter().flatten().map(|(joint, _)| *joint).collect();
        let part = Part {
            joints: task
                .part
                .joints
                .iter()
                .copied()
                .filter(|joint| inside.contains(joint))
                .collect(),
            cycles: cycles.to_vec(),
            couplings: task
                .part
                .couplings
                .iter()
                .copied()
                .filter(|&coupling| {
                    let mut joints = task.geometry.couplings[coupling].joints();
                    joints.all(|joint| inside.contains(&joint))
                })
                .collect(),
        };
        let outcome = descend(
            &Task {
                part: &part,
                ..*task
            },
            states,
            Effort::SHORT,
        )?;
        *steps += outcome.steps;
        *work -= outcome.work;
    }
    Ok(())
}

/// Places all joints that may move anywhere, by numbers that depend on their names and the start's only. Every third start
/// is half as wide, every third a quarter.
fn spread(
    task: &Task<'_>,
    start: usize,
    reference: &[JointState<f64>],
    states: &mut [JointState<f64>],
) {
    let width = [1.0, 0.5, 0.25][start % 3];
    let within_limits = start.is_multiple_of(2);
    let extent = extent(task);
    for &joint in &task.part.joints {
        if task.held.contains(&joint) {
            continue;
        }
        let described = &task.mechanism.joints()[joint];
        let mut random = SplitMix64::named(&described.name);
        let mut random = SplitMix64::new(
            random
                .next_u64()
                .wrapping_add((start as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)),
        );
        let displacement = &task.geometry.displacements[joint];
        let freedoms = described.kind.freedoms();
        let drawn = &reference[joint].values;
        let range = limits::range(described).filter(|_| within_limits);
        if let (Some((lower, upper)), 1) = (range, freedoms.len()) {
            let middle = 0.5 * (lower + upper);
            // The first start is the middle itself, which is clear of most that is singular at the ends.
            let away = match start {
                0 => 0.0,
                _ => random.symmetric(),
            };
            let value = middle + 0.5 * (upper - lower) * away;
            states[joint] = displacement.at(&[value]);
            continue;
        }
        let away: Vec<f64> = freedoms
            .iter()
            .map(|freedom| {
                let far = match freedom {
                    FreedomPart::Translation => extent,
                    FreedomPart::Rotation => PI,
                    FreedomPart::Screw => PI + TAU * turns(described, extent),
                };
                width * far * random.symmetric()
            })
            .collect();
        if has_ball(described.kind) {
            states[joint] = reference[joint].clone();
            displacement.advance(&mut states[joint], &away);
        } else {
            let values: Vec<f64> = drawn.iter().zip(&away).map(|(a, b)| a + b).collect();
            states[joint] = displacement.at(&values);
        }
    }
}

/// How often a screw may have to turn: its turns, unlike a hinge's, are different places. More than a few dozen are more than
/// the starts can tell apart.
fn turns(joint: &Joint, extent: f64) -> f64 {
    const MOST: f64 = 16.0;
    let lead = joint.lead.as_ref().map_or(0.0, |lead| lead.value().abs());
    if lead > 0.0 {
        (extent / lead).min(MOST)
    } else {
        0.0
    }
}

/// Whether values of a kind's variables are not coordinates once they have moved.
pub(super) fn has_ball(kind: JointKind) -> bool {
    matches!(
        kind,
        JointKind::Spherical
            | JointKind::PointOnLine
            | JointKind::PointOnPlane
            | JointKind::Distance
    )
}

/// How far a part reaches (m): the sum of what its links span on the way along the joints, at most a few cycles' worth.
fn extent(task: &Task<'_>) -> f64 {
    let spans = task.part.joints.iter().map(|&joint| {
        task.geometry.sides[joint]
            .iter()
            .map(|side| kutzbach_math::space::length(&side.translation))
            .fold(0.0, f64::max)
    });
    let widest = spans.fold(0.0, f64::max);
    if widest > 0.0 { 2.0 * widest } else { 1.0 }
}
