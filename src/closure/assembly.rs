//! Moving the joints until the cycles close.
//!
//! Damped Gauss–Newton (Levenberg–Marquardt) on the cycle equations. With the damping proportional to the squared
//! residual the method converges quadratically wherever the distance to the solution set is bounded by the residual, even
//! where the Jacobian has dependent rows or columns (Fan & Yuan 2005, *On the quadratic convergence of the
//! Levenberg–Marquardt method without nonsingularity assumption*, Computing 74): the step stays short along the
//! mechanism's own motions, so an assembled mechanism stays where it was drawn. At a singular pose that bound fails and
//! convergence is linear; the iteration goes on until nothing improves.

use super::displacement::JointState;
use super::geometry::{Geometry, relative};
use super::jacobian::{CycleJacobian, Part, entry_accuracy, jacobian};
use super::rigid::{Rigid, length, subtract};
use crate::matrix::{LeastSquares, MatrixError, Real, SplitMix64};
use crate::mechanism::Mechanism;
use std::collections::BTreeSet;

/// The gap of one loop of the file, before and after assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopGap {
    /// Index of the joint that closes the loop.
    pub joint: usize,
    /// Distance of the two sides as the file places them (m), freedoms of the joint taken out.
    pub position: f64,
    /// Angle between the two sides as the file places them (rad), freedoms of the joint taken out.
    pub angle: f64,
    /// What is left of the distance after assembly (m).
    pub left_position: f64,
    /// What is left of the angle after assembly (rad).
    pub left_angle: f64,
}

/// The outcome of an assembly. Not closing is an answer, not an error.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// Whether every cycle closes within the tolerance.
    pub closed: bool,
    /// Largest residual of a cycle: angle (rad), or displacement in units of the cycle's length.
    pub residual: f64,
    /// What the residual was held against: the numbers' stated precision and rounding, whichever is larger.
    pub tolerance: f64,
    /// Largest distance a joint was moved from where the file draws it (m).
    pub moved: f64,
    /// Gauss–Newton steps taken, summed over the parts.
    pub steps: usize,
    /// Joint states after assembly.
    pub states: Vec<JointState<f64>>,
    /// The loops of the file.
    pub gaps: Vec<LoopGap>,
    /// The equations at the final pose, one entry per part where the part was closed: whoever ranks them next takes them.
    pub(crate) jacobians: Vec<Option<CycleJacobian<f64>>>,
}

/// However coarsely the numbers are stated or rounded, a cycle that misses by more than this (rad, or cycle lengths) is not closed.
const COARSEST_CLOSING: f64 = 0.02;

/// Steps after which a part that does not close is given up.
const STEP_LIMIT: usize = 200;

/// Assembles the parts of a mechanism from its file pose. `held` joints keep their configured values.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn assemble(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    parts: &[Part],
    held: &BTreeSet<usize>,
) -> Result<Assembly, MatrixError> {
    let mut assembly = Assembly {
        closed: true,
        residual: 0.0,
        tolerance: 0.0,
        moved: 0.0,
        steps: 0,
        states: geometry.states.clone(),
        gaps: Vec::new(),
        jacobians: Vec::with_capacity(parts.len()),
    };
    for part in parts {
        if part.cycles.is_empty() && part.couplings.is_empty() {
            assembly.jacobians.push(None);
            continue;
        }
        let outcome = close(mechanism, geometry, &mut assembly.states, part, held)?;
        assembly.jacobians.push(outcome.jacobian);
        assembly.closed &= outcome.residual <= outcome.tolerance;
        assembly.residual = largest(&[assembly.residual, outcome.residual]);
        assembly.tolerance = assembly.tolerance.max(outcome.tolerance);
        assembly.steps += outcome.steps;
    }
    let poses = spanning_poses(mechanism, geometry, &assembly.states);
    // Untouched states give the drawn poses back, but for rounding on another path.
    if assembly.steps > 0 {
        assembly.moved = moved(mechanism, geometry, &poses);
    }
    assembly.gaps = gaps(mechanism, geometry, &assembly.states, &poses);
    Ok(assembly)
}

struct PartOutcome {
    residual: f64,
    tolerance: f64,
    steps: usize,
    /// At the pose reached.
    jacobian: Option<CycleJacobian<f64>>,
}

/// The largest magnitude; NaN if there is one, which must not pass for small.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, x| {
        if m.is_nan() || x.abs() <= m {
            m
        } else {
            x.abs()
        }
    })
}

/// Where the joints of one part stand, kept so that they can be put back: a mechanism of many parts is not copied as a
/// whole for each.
struct Kept<R>(Vec<(usize, JointState<R>)>);

impl<R: Real> Kept<R> {
    fn of(part: &Part, states: &[JointState<R>]) -> Self {
        Self(
            part.joints
                .iter()
                .map(|&j| (j, states[j].clone()))
                .collect(),
        )
    }

    fn put_back(&self, states: &mut [JointState<R>]) {
        for (joint, state) in &self.0 {
            states[*joint] = state.clone();
        }
    }
}

/// Tries in turn: the pose as drawn, then poses beside it, farther away each time. A pose can be stuck: drawn stretched
/// or folded flat, a loop's gap may lie exactly across everything its joints can do to first order.
const NUDGES: [f64; 8] = [0.0, 0.01, 0.03, 0.1, 0.2, 0.4, 0.7, 1.0];

fn close(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &mut [JointState<f64>],
    part: &Part,
    held: &BTreeSet<usize>,
) -> Result<PartOutcome, MatrixError> {
    let mut steps = 0;
    let drawn = Kept::of(part, states);
    let mut best: Option<(Kept<f64>, PartOutcome)> = None;
    for size in NUDGES {
        drawn.put_back(states);
        if size > 0.0 {
            nudge(mechanism, geometry, part, held, size, states)?;
        }
        let outcome = descend(mechanism, geometry, states, part, held)?;
        steps += outcome.steps;
        if outcome.residual <= outcome.tolerance {
            return Ok(PartOutcome { steps, ..outcome });
        }
        if best
            .as_ref()
            .is_none_or(|(_, b)| !(b.residual <= outcome.residual))
        {
            best = Some((Kept::of(part, states), outcome));
        }
    }
    let (nearest, outcome) = best.unwrap_or((
        drawn,
        PartOutcome {
            residual: f64::INFINITY,
            tolerance: 0.0,
            steps: 0,
            jacobian: None,
        },
    ));
    nearest.put_back(states);
    Ok(PartOutcome { steps, ..outcome })
}

/// Follows a motion of a part for a short finite way: all variables move along `direction` (in the Jacobian's units), then
/// the cycles are closed again. Calls `there` with the states reached; `None` where the cycles do not close from there.
/// The states are put back before it returns.
///
/// # Errors
/// [`MatrixError`] where numbers overflow, and those of `there`.
pub fn follow<T>(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &mut [JointState<f64>],
    part: &Part,
    direction: &[f64],
    there: impl FnOnce(&[JointState<f64>]) -> Result<T, MatrixError>,
) -> Result<Option<T>, MatrixError> {
    let here = jacobian(mechanism, geometry, states, part)?;
    let movable = vec![true; here.variables.len()];
    let before = Kept::of(part, states);
    advance(mechanism, geometry, &here, &movable, direction, states);
    let found = match descend(mechanism, geometry, states, part, &BTreeSet::new()) {
        Ok(outcome) if outcome.residual <= outcome.tolerance => there(states).map(Some),
        Ok(_) => Ok(None),
        Err(error) => Err(error),
    };
    before.put_back(states);
    found
}

/// Moves the joints of a part by up to `size` (rad, or part lengths), by numbers that depend on joint names only.
fn nudge(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    part: &Part,
    held: &BTreeSet<usize>,
    size: f64,
    states: &mut [JointState<f64>],
) -> Result<(), MatrixError> {
    let here = jacobian(mechanism, geometry, states, part)?;
    let movable = movable_columns(&here, held);
    let increments: Vec<f64> = here
        .variables
        .iter()
        .map(|(joint, variable)| {
            let mut random = SplitMix64::named(&mechanism.joints()[*joint].name);
            (0..=*variable)
                .map(|_| random.symmetric())
                .last()
                .unwrap_or(0.0)
                * size
        })
        .collect();
    advance(mechanism, geometry, &here, &movable, &increments, states);
    Ok(())
}

/// Damped Gauss–Newton from one start until the cycles close to rounding, or nothing improves.
fn descend(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &mut [JointState<f64>],
    part: &Part,
    held: &BTreeSet<usize>,
) -> Result<PartOutcome, MatrixError> {
    let mut here = jacobian(mechanism, geometry, states, part)?;
    let (stated, rounding) = entry_accuracy(mechanism, &here);
    let mut residual = largest(&here.residual);
    let mut steps = 0;
    let mut caution = 1.0;
    let sum = |r: &[f64]| r.iter().map(|x| x * x).sum::<f64>();
    // A pose that closes to the last digit is left exactly as it was drawn.
    while residual > rounding && steps < STEP_LIMIT {
        let square = sum(&here.residual);
        let columns = movable_columns(&here, held);
        let Some(increments) = step(&here, &columns, caution * square.min(1.0))? else {
            break;
        };
        // What closes within the stated precision is polished only as far as that precision goes: rounded numbers leave
        // a gap that no motion removes, and chasing it would drag the mechanism along its own freedom.
        let within = residual <= stated.min(COARSEST_CLOSING);
        if within && largest(&increments) > stated {
            break;
        }
        let before = Kept::of(part, states);
        advance(mechanism, geometry, &here, &columns, &increments, states);
        let there = jacobian(mechanism, geometry, states, part)?;
        let reached = sum(&there.residual);
        steps += 1;
        if within && !(reached <= 0.25 * square) {
            before.put_back(states);
            break;
        }
        if reached.is_finite() && reached < square {
            let stalled = reached > square * (1.0 - 1e-6);
            here = there;
            residual = largest(&here.residual);
            caution = (caution * 0.25).max(1e-6);
            if stalled {
                break;
            }
        } else {
            before.put_back(states);
            caution *= 8.0;
            if caution > 1e12 {
                break;
            }
        }
    }
    // What still counts as closed is the uncertainty of a walk around the cycle, which is that of a Jacobian entry.
    Ok(PartOutcome {
        residual,
        tolerance: (stated + rounding).min(COARSEST_CLOSING),
        steps,
        jacobian: Some(here),
    })
}

fn movable_columns<R>(jacobian: &CycleJacobian<R>, held: &BTreeSet<usize>) -> Vec<bool> {
    jacobian
        .variables
        .iter()
        .map(|(joint, _)| !held.contains(joint))
        .collect()
}

/// The damped step `min |J x + r|² + damping |x|²`, held columns left out; `None` where nothing may move.
fn step(
    jacobian: &CycleJacobian<f64>,
    movable: &[bool],
    damping: f64,
) -> Result<Option<Vec<f64>>, MatrixError> {
    if !movable.iter().any(|m| *m) {
        return Ok(None);
    }
    let right: Vec<f64> = jacobian.residual.iter().map(|r| -r).collect();
    let mut increments = LeastSquares::damped(&jacobian.matrix, &right, damping, Some(movable))?;
    // A step beyond a radian or the part's own size leaves the range of the linearisation.
    let size = largest(&increments);
    if !size.is_finite() {
        return Ok(None);
    }
    if size > 1.0 {
        increments.iter_mut().for_each(|x| *x /= size);
    }
    Ok(Some(increments))
}

/// Applies increments in the Jacobian's own units.
fn advance<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    jacobian: &CycleJacobian<R>,
    movable: &[bool],
    increments: &[R],
    states: &mut [JointState<R>],
) {
    let mut column = 0;
    while column < jacobian.variables.len() {
        let (joint, _) = jacobian.variables[column];
        let freedom = geometry.displacements[joint].freedom();
        let values: Vec<R> = (column..column + freedom)
            .map(|c| {
                if movable[c] {
                    increments[c].clone() * geometry.one.constant(jacobian.unit(mechanism, c))
                } else {
                    geometry.one.zero_like()
                }
            })
            .collect();
        geometry.displacements[joint].advance(&mut states[joint], &values);
        column += freedom;
    }
}

/// Polishes states in an arithmetic of more digits, starting from states that close in double precision: Newton steps
/// whose residual is exact to the arithmetic while the direction is solved in double precision, which gains some fifteen
/// digits a step at a regular pose. Stops when the residual no longer falls; returns it.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn refine<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &mut [JointState<R>],
    part: &Part,
    held: &BTreeSet<usize>,
) -> Result<f64, MatrixError> {
    const STEPS: usize = 60;
    let mut here = jacobian(mechanism, geometry, states, part)?;
    let size = |r: &[R]| largest(&r.iter().map(Real::to_f64).collect::<Vec<_>>());
    let mut residual = size(&here.residual);
    for _ in 0..STEPS {
        if !(residual > 64.0 * geometry.one.unit_roundoff()) {
            break;
        }
        let movable = movable_columns(&here, held);
        let double = here.matrix.map(&0.0, Real::to_f64);
        // The residual is brought to order one before it is rounded to double, and the step back after.
        let right: Vec<f64> = here
            .residual
            .iter()
            .map(|r| -(r.clone() / geometry.one.constant(residual)).to_f64())
            .collect();
        let solution = LeastSquares::damped(&double, &right, 1e-24, Some(&movable))?;
        let increments: Vec<R> = solution
            .iter()
            .map(|x| geometry.one.constant(*x) * geometry.one.constant(residual))
            .collect();
        let before = Kept::of(part, states);
        advance(mechanism, geometry, &here, &movable, &increments, states);
        let there = jacobian(mechanism, geometry, states, part)?;
        let reached = size(&there.residual);
        if !(reached < 0.5 * residual) {
            before.put_back(states);
            break;
        }
        here = there;
        residual = reached;
    }
    Ok(residual)
}

/// Link poses in the world along a spanning tree that prefers the file's tree joints; the ground keeps its place.
pub fn spanning_poses<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &[JointState<R>],
) -> (Vec<Rigid<R>>, Vec<bool>) {
    let joints = mechanism.joints();
    let mut piece: Vec<usize> = (0..mechanism.links().len()).collect();
    fn root(piece: &mut [usize], mut link: usize) -> usize {
        while piece[link] != link {
            piece[link] = piece[piece[link]];
            link = piece[link];
        }
        link
    }
    let mut in_tree = vec![false; joints.len()];
    // By name, so that the order in the file changes nothing.
    let mut order: Vec<usize> = (0..joints.len()).collect();
    order.sort_by_key(|&index| (joints[index].closes_loop, &joints[index].name));
    for index in order {
        let joint = &joints[index];
        let (a, b) = (
            root(&mut piece, joint.predecessor.link.0),
            root(&mut piece, joint.successor.link.0),
        );
        if a != b {
            piece[a] = b;
            in_tree[index] = true;
        }
    }
    let mut incident = vec![Vec::new(); mechanism.links().len()];
    for (index, joint) in joints
        .iter()
        .enumerate()
        .filter(|(index, _)| in_tree[*index])
    {
        incident[joint.predecessor.link.0].push(index);
        incident[joint.successor.link.0].push(index);
    }
    // Pieces that no joint connects to the ground stay where the file places them.
    let mut poses = geometry.home.clone();
    let mut done = vec![false; poses.len()];
    let ground_first = std::iter::once(mechanism.ground().0).chain(0..done.len());
    for start in ground_first {
        if done[start] {
            continue;
        }
        done[start] = true;
        let mut stack = vec![start];
        while let Some(link) = stack.pop() {
            for &index in &incident[link] {
                let joint = &joints[index];
                let [predecessor, successor] = &geometry.sides[index];
                let across = predecessor
                    .compose(&geometry.displacements[index].displacement(&states[index]))
                    .compose(&successor.inverse());
                let (other, step) = if joint.predecessor.link.0 == link {
                    (joint.successor.link.0, across)
                } else {
                    (joint.predecessor.link.0, across.inverse())
                };
                if !done[other] {
                    done[other] = true;
                    poses[other] = poses[link].compose(&step);
                    stack.push(other);
                }
            }
        }
    }
    (poses, in_tree)
}

fn moved(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    poses: &(Vec<Rigid<f64>>, Vec<bool>),
) -> f64 {
    let mut farthest = 0.0f64;
    for (index, joint) in mechanism.joints().iter().enumerate() {
        for (side, frame) in [&joint.predecessor, &joint.successor]
            .into_iter()
            .zip(&geometry.sides[index])
        {
            let before = geometry.home[side.link.0].apply(&frame.translation);
            let after = poses.0[side.link.0].apply(&frame.translation);
            farthest = farthest.max(length(&subtract(&after, &before)));
        }
    }
    farthest
}

fn gaps(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    poses: &(Vec<Rigid<f64>>, Vec<bool>),
) -> Vec<LoopGap> {
    let miss = |poses: &[Rigid<f64>], index: usize, state: &JointState<f64>| {
        let wanted = relative(poses, &mechanism.joints()[index], &geometry.sides[index]);
        let off = geometry.displacements[index]
            .displacement(state)
            .inverse()
            .compose(&wanted);
        (length(&off.translation), length(&off.rotation_vector()))
    };
    mechanism
        .joints()
        .iter()
        .enumerate()
        .filter(|(_, joint)| joint.closes_loop)
        .map(|(index, _)| {
            let (position, angle) = miss(&geometry.home, index, &geometry.states[index]);
            let (left_position, left_angle) = miss(&poses.0, index, &states[index]);
            LoopGap {
                joint: index,
                position,
                angle,
                left_position,
                left_angle,
            }
        })
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
