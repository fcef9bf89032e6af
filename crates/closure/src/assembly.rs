//! Moving the joints until the cycles close.
//!
//! Damped Gauss–Newton (Levenberg–Marquardt) on the cycle equations. With the damping proportional to the squared
//! residual the method converges quadratically wherever the distance to the solution set is bounded by the residual, even
//! where the Jacobian has dependent rows or columns (Fan & Yuan 2005, *On the quadratic convergence of the
//! Levenberg–Marquardt method without nonsingularity assumption*, Computing 74): the step stays short along the
//! mechanism's own motions, so an assembled mechanism stays where it was drawn. At a singular pose that bound fails and
//! convergence is linear; the iteration goes on until nothing improves.

mod descent;
mod limits;
mod nearest;
mod proof;
mod reversal;
mod search;
mod solved;
mod spans;

use super::displacement::JointState;
use super::geometry::{Geometry, relative};
use super::jacobian::{CycleJacobian, Part, jacobian};
use descent::{Effort, Kept, PartOutcome, Task, advance, descend, largest, movable_columns, nudge};
use kutzbach_math::matrix::{LeastSquares, MatrixError, Real};
use kutzbach_math::space::{Rigid, length, subtract};
use kutzbach_model::mechanism::{FreedomPart, Mechanism};
pub use limits::{OutsideLimit, coupled_joints, nearest_turn};
use petgraph::unionfind::UnionFind;
pub use proof::{Obstacle, ProvenOpen};
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

/// Where a joint stands, and how far that is from where it is drawn.
fn place(geometry: &Geometry<f64>, joint: usize, states: &[JointState<f64>]) -> JointPlace {
    let displacement = &geometry.displacements[joint];
    let drawn = &geometry.states[joint];
    let freedoms = displacement.kind().freedoms();
    let (mut turned, mut shifted) = (0.0f64, 0.0f64);
    for (increment, freedom) in displacement
        .increments(drawn, &states[joint])
        .iter()
        .zip(freedoms)
    {
        match freedom {
            FreedomPart::Translation => shifted = shifted.max(increment.abs()),
            FreedomPart::Rotation | FreedomPart::Screw => turned = turned.max(increment.abs()),
        }
    }
    JointPlace {
        joint,
        drawn: displacement.coordinates(drawn),
        values: displacement.coordinates(&states[joint]),
        turned,
        shifted,
    }
}

/// Tries in turn: the pose as drawn, then poses beside it, farther away each time. A pose can be stuck: drawn stretched
/// or folded flat, a loop's gap may lie exactly across everything its joints can do to first order.
const NUDGES: [f64; 8] = [0.0, 0.01, 0.03, 0.1, 0.2, 0.4, 0.7, 1.0];

/// Work that poses beside the drawn one may cost a part; the drawn one itself is always followed to its end.
const NUDGE_WORK: f64 = 1e10;

/// Starts of a part that is proven to close nowhere, to find where it misses by least.
const PROVEN_STARTS: usize = 24;

/// What closing a part came to.
struct PartClosing {
    outcome: PartOutcome,
    /// Poses it was closed from.
    starts: usize,
    work_ended: bool,
    proven_open: Option<ProvenOpen>,
    /// Whether it closes at no pose, though it may within rounding.
    never: bool,
}

impl PartClosing {
    /// Closes at no pose, since.
    fn never(&mut self, proof: ProvenOpen) {
        self.proven_open = Some(proof);
        self.never = true;
    }
}

/// What may be tried where the drawn pose and its neighbours do not lead to a closing.
#[derive(Clone, Copy)]
struct Trying<'a> {
    /// Other starts.
    starts: usize,
    solver: &'a Solver<'a>,
    /// Whether the solver is asked before the drawn pose is tried.
    solve_first: bool,
}

impl Trying<'_> {
    /// So many other starts, and nobody to ask.
    fn starts(starts: usize) -> Self {
        Self {
            starts,
            solver: &solved::nobody,
            solve_first: false,
        }
    }

    /// What the solver knows of a part, where it may be asked.
    fn solved(&self, task: &Task<'_>, states: &[JointState<f64>]) -> Solved {
        let held = task.part.joints.iter().any(|j| task.held.contains(j));
        match held || task.tolerance.is_some() {
            true => Solved::Unknown,
            false => (self.solver)(task.part, states),
        }
    }
}

/// Closes a part from where its joints stand; `reference` is the pose to be near to.
fn close(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    reference: &[JointState<f64>],
    trying: Trying<'_>,
    work: &mut f64,
) -> Result<PartClosing, MatrixError> {
    let more_starts = trying.starts;
    let mut steps = 0;
    let drawn = Kept::of(task.part, states);
    let mut best: Option<(Kept<f64>, PartOutcome)> = None;
    let mut done = PartClosing {
        outcome: PartOutcome::none(),
        starts: 0,
        work_ended: false,
        proven_open: None,
        never: false,
    };
    let solved_first = match trying.solve_first {
        true => trying.solved(task, states),
        false => Solved::Unknown,
    };
    if let Some(outcome) = solved::closed_at(task, states, reference, &solved_first, work)? {
        done.outcome = outcome;
        return Ok(done);
    }
    if let Solved::Never(proof) = solved_first {
        done.outcome = descend(task, states, Effort::LONG)?;
        done.never(proof);
        return Ok(done);
    }
    // Only the first attempt of a part has work of its own for these.
    let remedy = more_starts < search::STARTS;
    let mut nudging = if remedy { *work } else { NUDGE_WORK };
    for size in NUDGES {
        if size > 0.0 && !(nudging > 0.0) {
            done.work_ended = true;
            break;
        }
        drawn.put_back(states);
        if size > 0.0 {
            nudge(task, size, states)?;
        }
        let mut outcome = descend(task, states, Effort::LONG)?;
        done.starts += 1;
        nudging -= outcome.work;
        if remedy {
            *work -= outcome.work;
        }
        steps += outcome.steps;
        if outcome.closed() {
            if let Some(closed) = nearest::second_order(task, reference, states, &outcome, work)? {
                outcome = closed;
            } else if outcome.steps > 0 {
                outcome = nearest::commensurate(task, reference, states, outcome, work)?;
            }
            if task.tolerance.is_none() {
                outcome = nearest::mended(task, states, outcome)?;
            }
            if size == 0.0 && outcome.steps > 0 {
                outcome = nearest::no_worse_than_drawn(task, &drawn, states, outcome)?;
            }
            if outcome.steps > 0 && limits::excess(task, states) > 0.0 {
                outcome = within_limits(task, states, reference, outcome, work, &mut done)?;
            }
            done.outcome = PartOutcome {
                steps: steps.max(outcome.steps),
                ..outcome
            };
            return Ok(done);
        }
        if best
            .as_ref()
            .is_none_or(|(_, b)| !(b.residual <= outcome.residual))
        {
            best = Some((Kept::of(task.part, states), outcome));
        }
    }
    let outcome = match best {
        Some((nearest, outcome)) => {
            nearest.put_back(states);
            outcome
        }
        None => {
            drawn.put_back(states);
            PartOutcome::none()
        }
    };
    done.outcome = PartOutcome { steps, ..outcome };
    let walks = done.outcome.jacobian.as_ref().map(|here| &here.walks);
    done.proven_open = proof::proven_open(task, done.outcome.tolerance, |cycle| {
        walks?.get(cycle).map(|walk| (walk.length, walk.extent))
    });
    let nothing_moves = task.part.joints.iter().all(|j| task.held.contains(j));
    if nothing_moves {
        return Ok(done);
    }
    let solved = match done.proven_open {
        None => trying.solved(task, states),
        Some(_) => Solved::Unknown,
    };
    if let Solved::Never(proof) = &solved {
        done.never(*proof);
    }
    let before_search = matches!(solved, Solved::All(_));
    if before_search
        && let Some(outcome) = solved::closed_at(task, states, reference, &solved, work)?
    {
        done.outcome = outcome;
        return Ok(done);
    }
    // What cannot close is searched only for how nearly it does.
    let starts = match done.proven_open {
        Some(_) => more_starts.min(PROVEN_STARTS),
        None => more_starts,
    };
    let before = Kept::of(task.part, states);
    let found = search::search(task, states, reference, starts, work)?;
    done.starts += found.starts;
    done.work_ended |=
        found.starts < starts && !found.best.as_ref().is_some_and(PartOutcome::closed);
    let steps = steps + found.steps;
    done.outcome = match found.best {
        Some(best)
            if best.closed() || best.gap(task.mechanism) < done.outcome.gap(task.mechanism) =>
        {
            PartOutcome {
                steps: steps.max(1),
                ..best
            }
        }
        _ => {
            before.put_back(states);
            PartOutcome {
                steps,
                ..done.outcome
            }
        }
    };
    let after_search = !before_search && !done.outcome.closed();
    if after_search
        && let Some(outcome) = solved::closed_at(task, states, reference, &solved, work)?
    {
        done.outcome = outcome;
    }
    if done.outcome.closed() && !done.never {
        done.proven_open = None;
        return Ok(done);
    }
    // Nothing found may be worse than what is drawn.
    let nearest = Kept::of(task.part, states);
    drawn.put_back(states);
    let as_drawn = descend(task, states, Effort::NONE)?;
    if as_drawn.gap(task.mechanism) <= done.outcome.gap(task.mechanism) {
        done.outcome = PartOutcome { steps, ..as_drawn };
    } else {
        nearest.put_back(states);
    }
    Ok(done)
}

/// Where closing left joints outside their limits: looks for a closing that does not. The states end there, or where they
/// were.
fn within_limits(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    reference: &[JointState<f64>],
    outcome: PartOutcome,
    work: &mut f64,
    done: &mut PartClosing,
) -> Result<PartOutcome, MatrixError> {
    const STARTS: usize = 64;
    // Joints drawn at a limit may have to pass it by a little; that is no reason to look for another pose.
    const CORRECTION: f64 = 0.1;
    if nearest::distance(task, reference, states, &outcome) < CORRECTION {
        return Ok(outcome);
    }
    let as_found = Kept::of(task.part, states);
    let outside = limits::excess(task, states);
    nearest::unwind(task, reference, states);
    if limits::excess(task, states) == 0.0 {
        return Ok(outcome);
    }
    let found = search::search(task, states, reference, STARTS, work)?;
    done.starts += found.starts;
    match found.best {
        Some(closing) if closing.closed() && limits::excess(task, states) < outside => {
            Ok(PartOutcome {
                steps: outcome.steps + found.steps,
                ..closing
            })
        }
        _ => {
            as_found.put_back(states);
            Ok(outcome)
        }
    }
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
    let nobody = BTreeSet::new();
    let task = Task {
        mechanism,
        geometry,
        part,
        held: &nobody,
        tolerance: None,
    };
    let found = match descend(&task, states, Effort::LONG) {
        Ok(outcome) if outcome.residual <= outcome.tolerance => there(states).map(Some),
        Ok(_) => Ok(None),
        Err(error) => Err(error),
    };
    before.put_back(states);
    found
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
    let mut pieces = UnionFind::<usize>::new(mechanism.links().len());
    let mut in_tree = vec![false; joints.len()];
    // By name, so that the order in the file changes nothing.
    let mut order: Vec<usize> = (0..joints.len()).collect();
    order.sort_by_key(|&index| (joints[index].closes_loop, &joints[index].name));
    for index in order {
        let joint = &joints[index];
        in_tree[index] = pieces.union(joint.predecessor.link.0, joint.successor.link.0);
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
