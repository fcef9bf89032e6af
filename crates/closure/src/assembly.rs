//! Moving the joints until the cycles close.
//!
//! Damped Gauss–Newton (Levenberg–Marquardt) on the cycle equations. With the damping proportional to the squared
//! residual the method converges quadratically wherever the distance to the solution set is bounded by the residual, even
//! where the Jacobian has dependent rows or columns (Fan & Yuan 2005, *On the quadratic convergence of the
//! Levenberg–Marquardt method without nonsingularity assumption*, Computing 74): the step stays short along the
//! mechanism's own motions, so an assembled mechanism stays where it was drawn. At a singular pose that bound fails and
//! convergence is linear; the iteration goes on until nothing improves.

mod closing;
mod descent;
mod following;
mod limits;
mod nearest;
mod places;
mod proof;
mod refining;
mod reversal;
mod search;
mod solved;
mod spans;

use super::displacement::JointState;
use super::geometry::Geometry;
use super::jacobian::{CycleJacobian, Part};
use closing::{Trying, close};
use descent::{Kept, PartOutcome, Task};
pub use following::follow;
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::Mechanism;
pub use limits::{OutsideLimit, coupled_joints, nearest_turn};
pub use places::spanning_poses;
use places::{gaps, moved, place};
pub use proof::{Obstacle, ProvenOpen};
pub use refining::refine;
pub use reversal::Reversal;
pub use solved::{JointPoses, Solved, Solver};
use std::collections::{BTreeMap, BTreeSet};

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

/// Where assembly took a joint, in values that a configuration can hold (rad, m; a ball's turn as a rotation vector).
#[derive(Clone, Debug, PartialEq)]
pub struct JointPlace {
    /// Index of the joint.
    pub joint: usize,
    /// Its values as drawn.
    pub drawn: Vec<f64>,
    /// Its values after assembly.
    pub values: Vec<f64>,
    /// Largest turn of its variables from the drawn pose (rad).
    pub turned: f64,
    /// Largest translation of its variables from there (m).
    pub shifted: f64,
}

/// What an assembly heeds besides the mechanism.
#[derive(Clone, Debug, Default)]
pub struct AssemblyOptions {
    /// Joints that keep their configured values.
    pub held: BTreeSet<usize>,
    /// How far the configured values of joints may be from those meant (rad, m), because they were rounded. Where the loops
    /// do not close with the values as they are, these joints may be corrected: see [`Assembly::corrected`].
    pub rounded: BTreeMap<usize, f64>,
    /// What counts as closed (m; angles count by the cycle's length), instead of what the file's digits say.
    pub tolerance: Option<f64>,
    /// Whether the poses that the solver knows are asked for before the drawn one: where that closes within rounding, and not otherwise.
    pub solve_first: bool,
}

/// The outcome of an assembly. Not closing is an answer, not an error.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// Whether every cycle closes within the tolerance.
    pub closed: bool,
    /// Largest residual of a cycle: angle (rad), or displacement in units of the cycle's length.
    pub residual: f64,
    /// What the residual was held against: the numbers' stated precision and rounding, whichever is larger; or what was
    /// given.
    pub tolerance: f64,
    /// Length of the loop by which both count (m): times it, they are gaps at the joints, of angles at this lever.
    pub length: f64,
    /// Largest distance a joint was moved from where the file draws it (m).
    pub moved: f64,
    /// Gauss–Newton steps taken, summed over the parts.
    pub steps: usize,
    /// Joint states after assembly.
    pub states: Vec<JointState<f64>>,
    /// The loops of the file.
    pub gaps: Vec<LoopGap>,
    /// Where every joint with a freedom stands, by joint index.
    pub joints: Vec<JointPlace>,
    /// The most poses that any part was closed from: 1 where all close from the drawn one.
    pub starts: usize,
    /// Whether a search for other starts ended at its limit on work.
    pub work_ended: bool,
    /// Joints that kept their configured values.
    pub held: BTreeSet<usize>,
    /// Joints whose configured values, rounded as they are, were corrected to close the loops.
    pub corrected: BTreeSet<usize>,
    /// Of parts that do not close with their held joints as they are, but do once these are released: where that takes the
    /// held joints, by joint index. Other parts may stay open all the same.
    pub released: Option<Vec<JointPlace>>,
    /// Joints outside their limits at the pose, farthest first.
    pub outside: Vec<OutsideLimit>,
    /// A cycle that is proven to close at no pose; `None` where nothing is proven.
    pub proven_open: Option<ProvenOpen>,
    /// A loop whose part closes once one of its frames is turned over. Other parts may stay open all the same.
    pub reversal: Option<Reversal>,
    /// The equations at the final pose, one entry per part where the part was closed: whoever ranks them next takes them.
    pub jacobians: Vec<Option<CycleJacobian<f64>>>,
}

/// Work of all searches for other starts together, in floating-point operations, roughly: a few seconds.
const SEARCH_WORK: f64 = 1.5e10;

/// Work of finding out what would help where nothing closes: held joints released, frames turned over.
const REMEDY_WORK: f64 = 2e9;

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
    let options = AssemblyOptions {
        held: held.clone(),
        ..AssemblyOptions::default()
    };
    assemble_with(mechanism, geometry, parts, &options, &solved::nobody)
}

/// [`assemble`], with more to heed.
///
/// A part that closes from the drawn pose stays near it. One that does not is closed from poses beside it, then at those that
/// `solver` knows, then from up to 256 others spread widely, within a limit on work; a closing within the joint limits goes first, then the nearest one.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn assemble_with(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    parts: &[Part],
    options: &AssemblyOptions,
    solver: &Solver<'_>,
) -> Result<Assembly, MatrixError> {
    let mut assembly = Assembly {
        closed: true,
        residual: 0.0,
        tolerance: 0.0,
        length: 1.0,
        moved: 0.0,
        steps: 0,
        states: geometry.states.clone(),
        gaps: Vec::new(),
        joints: Vec::new(),
        starts: 1,
        work_ended: false,
        held: options.held.clone(),
        corrected: BTreeSet::new(),
        released: None,
        outside: Vec::new(),
        proven_open: None,
        reversal: None,
        jacobians: Vec::with_capacity(parts.len()),
    };
    let mut work = SEARCH_WORK;
    let mut remedies = REMEDY_WORK;
    for part in parts {
        if part.cycles.is_empty() && part.couplings.is_empty() {
            assembly.jacobians.push(None);
            continue;
        }
        let task = Task {
            mechanism,
            geometry,
            part,
            held: &options.held,
            tolerance: options.tolerance,
        };
        let closing = close(
            &task,
            &mut assembly.states,
            &geometry.states,
            Trying {
                starts: search::STARTS,
                solver,
                solve_first: options.solve_first,
            },
            &mut work,
        )?;
        let mut outcome = closing.outcome;
        assembly.starts = assembly.starts.max(closing.starts);
        assembly.work_ended |= closing.work_ended;
        if !outcome.closed() || closing.never {
            // Of several parts, one with axes that cannot meet is told first: that is a slip, the others may be digits.
            let slip = |open: &ProvenOpen| matches!(open.obstacle, Obstacle::Directions(_));
            if assembly.proven_open.is_none() || closing.proven_open.as_ref().is_some_and(slip) {
                assembly.proven_open = closing.proven_open.or(assembly.proven_open);
            }
            if part.joints.iter().any(|joint| options.held.contains(joint)) {
                outcome = assembly.release(&task, options, outcome, &mut remedies)?;
            }
        }
        assembly.jacobians.push(outcome.jacobian);
        assembly.closed &= outcome.residual <= outcome.tolerance && !closing.never;
        // Of several parts the one that is farthest from closing speaks for all.
        let share = |residual: f64, allowed: f64| residual / allowed.max(f64::MIN_POSITIVE);
        let known = share(assembly.residual, assembly.tolerance);
        if !known.is_nan() && !(share(outcome.residual, outcome.tolerance) < known) {
            assembly.residual = outcome.residual;
            assembly.tolerance = outcome.tolerance;
            assembly.length = outcome.length;
        }
        assembly.steps += outcome.steps;
    }
    let poses = spanning_poses(mechanism, geometry, &assembly.states);
    // Untouched states give the drawn poses back, but for rounding on another path.
    if assembly.steps > 0 {
        assembly.moved = moved(mechanism, geometry, &poses);
    }
    assembly.gaps = gaps(mechanism, geometry, &assembly.states, &poses);
    assembly.joints = (0..mechanism.joints().len())
        .filter(|&joint| mechanism.joints()[joint].freedom() > 0)
        .map(|joint| place(geometry, joint, &assembly.states))
        .collect();
    assembly.outside = limits::outside(mechanism, &assembly.states);
    if !assembly.closed {
        assembly.reversal = reversal::reversal(
            mechanism,
            geometry,
            parts,
            &options.held,
            &assembly.gaps,
            options.tolerance,
            &mut remedies,
        )?;
    }
    Ok(assembly)
}

impl Assembly {
    /// A part that does not close with its held joints as they are: closed with them free, from the nearest pose with them
    /// held. If they move by no more than rounding of their values allows, that is the pose; otherwise it is only told, and
    /// the states stay as they are.
    ///
    /// Each of n values is off by u at most, all together by √n u; what is free follows by up to 1/σ times as much, and may
    /// draw the held joints along. The smallest singular value σ of a well-conditioned closure is about a tenth. A
    /// hair's breadth is always allowed: values that were computed elsewhere close as well as the arithmetic there did.
    fn release(
        &mut self,
        task: &Task<'_>,
        options: &AssemblyOptions,
        open: PartOutcome,
        work: &mut f64,
    ) -> Result<PartOutcome, MatrixError> {
        const RELEASED_STARTS: usize = 32;
        const ONE_OVER_SIGMA: f64 = 10.0;
        const HAIRS_BREADTH: f64 = 1e-9;
        let nobody = BTreeSet::new();
        let free = Task {
            held: &nobody,
            ..*task
        };
        let nearest = Kept::of(task.part, &self.states);
        let reference = self.states.clone();
        let trying = Trying::starts(RELEASED_STARTS);
        let closing = close(&free, &mut self.states, &reference, trying, work)?;
        if !closing.outcome.closed() {
            nearest.put_back(&mut self.states);
            return Ok(open);
        }
        let held = task.part.joints.iter().copied();
        let held: Vec<usize> = held.filter(|j| options.held.contains(j)).collect();
        let places: Vec<JointPlace> = held
            .iter()
            .map(|&joint| place(task.geometry, joint, &self.states))
            .collect();
        let squares = held.iter().map(|joint| {
            let off = options.rounded.get(joint).copied().unwrap_or(0.0);
            off * off * task.mechanism.joints()[*joint].freedom() as f64
        });
        let allowed = (ONE_OVER_SIGMA * squares.sum::<f64>().sqrt()).max(HAIRS_BREADTH);
        if places.iter().all(|p| p.turned.max(p.shifted) <= allowed) {
            self.corrected.extend(&held);
            held.iter().for_each(|joint| {
                self.held.remove(joint);
            });
            self.proven_open = None;
            return Ok(PartOutcome {
                steps: open.steps + closing.outcome.steps,
                ..closing.outcome
            });
        }
        self.released.get_or_insert_default().extend(places);
        nearest.put_back(&mut self.states);
        Ok(open)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
