//! Closing one part: from the pose drawn, from poses beside it, at poses that somebody knows, and from poses spread widely.

use super::super::displacement::JointState;
use super::descent::{Effort, Kept, PartOutcome, Task, descend, nudge};
use super::proof::ProvenOpen;
use super::solved::{Solved, Solver};
use super::{limits, nearest, proof, search, solved};
use kutzbach_math::matrix::MatrixError;

/// Tries in turn: the pose as drawn, then poses beside it, farther away each time. A pose can be stuck: drawn stretched
/// or folded flat, a loop's gap may lie exactly across everything its joints can do to first order.
const NUDGES: [f64; 8] = [0.0, 0.01, 0.03, 0.1, 0.2, 0.4, 0.7, 1.0];

/// Work that poses beside the drawn one may cost a part; the drawn one itself is always followed to its end.
const NUDGE_WORK: f64 = 1e10;

/// Starts of a part that is proven to close nowhere, to find where it misses by least.
const PROVEN_STARTS: usize = 24;

/// What closing a part came to.
pub(super) struct PartClosing {
    pub(super) outcome: PartOutcome,
    /// Poses it was closed from.
    pub(super) starts: usize,
    pub(super) work_ended: bool,
    pub(super) proven_open: Option<ProvenOpen>,
    /// Whether it closes at no pose, though it may within rounding.
    pub(super) never: bool,
}

impl PartClosing {
    fn begun() -> Self {
        Self {
            outcome: PartOutcome::none(),
            starts: 0,
            work_ended: false,
            proven_open: None,
            never: false,
        }
    }

    /// Closes at no pose, since.
    fn never(&mut self, proof: ProvenOpen) {
        self.proven_open = Some(proof);
        self.never = true;
    }
}

/// What may be tried where the drawn pose and its neighbours do not lead to a closing.
#[derive(Clone, Copy)]
pub(super) struct Trying<'a> {
    /// Other starts.
    pub(super) starts: usize,
    pub(super) solver: &'a Solver<'a>,
    /// Whether the solver is asked before the drawn pose is tried.
    pub(super) solve_first: bool,
}

impl Trying<'_> {
    /// So many other starts, and nobody to ask.
    pub(super) fn starts(starts: usize) -> Self {
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
pub(super) fn close(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    reference: &[JointState<f64>],
    trying: Trying<'_>,
    work: &mut f64,
) -> Result<PartClosing, MatrixError> {
    let drawn = Kept::of(task.part, states);
    let mut done = PartClosing::begun();
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
    // Only the first attempt of a part has work of its own for poses beside the drawn one.
    let remedy = trying.starts < search::STARTS;
    if near_the_drawing(task, states, reference, &drawn, remedy, work, &mut done)? {
        return Ok(done);
    }
    let walks = done.outcome.jacobian.as_ref().map(|here| &here.walks);
    done.proven_open = proof::proven_open(task, done.outcome.tolerance, |cycle| {
        walks?.get(cycle).map(|walk| (walk.length, walk.extent))
    });
    let nothing_moves = task.part.joints.iter().all(|j| task.held.contains(j));
    if nothing_moves {
        return Ok(done);
    }
    let Some(steps) = elsewhere(task, states, reference, trying, work, &mut done)? else {
        return Ok(done);
    };
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

/// Closes a part from the pose drawn, and from poses beside it; whether that succeeds. Otherwise the states end where they close best.
fn near_the_drawing(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    reference: &[JointState<f64>],
    drawn: &Kept<f64>,
    remedy: bool,
    work: &mut f64,
    done: &mut PartClosing,
) -> Result<bool, MatrixError> {
    let mut steps = 0;
    let mut best: Option<(Kept<f64>, PartOutcome)> = None;
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
        let outcome = descend(task, states, Effort::LONG)?;
        done.starts += 1;
        nudging -= outcome.work;
        if remedy {
            *work -= outcome.work;
        }
        steps += outcome.steps;
        if outcome.closed() {
            let as_drawn = (size == 0.0).then_some(drawn);
            let outcome = settled(task, states, reference, as_drawn, outcome, work, done)?;
            done.outcome = PartOutcome {
                steps: steps.max(outcome.steps),
                ..outcome
            };
            return Ok(true);
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
    Ok(false)
}

/// A closed pose brought as near to the reference, and as far inside the joint limits, as it will go. `drawn` is the pose drawn, where it was
/// closed from there.
fn settled(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    reference: &[JointState<f64>],
    drawn: Option<&Kept<f64>>,
    mut outcome: PartOutcome,
    work: &mut f64,
    done: &mut PartClosing,
) -> Result<PartOutcome, MatrixError> {
    if let Some(closed) = nearest::second_order(task, reference, states, &outcome, work)? {
        outcome = closed;
    } else if outcome.steps > 0 {
        outcome = nearest::commensurate(task, reference, states, outcome, work)?;
    }
    if task.tolerance.is_none() {
        outcome = nearest::mended(task, states, outcome)?;
    }
    if let Some(drawn) = drawn.filter(|_| outcome.steps > 0) {
        outcome = nearest::no_worse_than_drawn(task, drawn, states, outcome)?;
    }
    if outcome.steps > 0 && limits::excess(task, states) > 0.0 {
        outcome = within_limits(task, states, reference, outcome, work, done)?;
    }
    Ok(outcome)
}

/// Closes a part at poses that the solver knows, and from poses spread widely. The states end where they close best. The steps taken so far;
/// `None` where one of all poses was taken, which settles it.
fn elsewhere(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    reference: &[JointState<f64>],
    trying: Trying<'_>,
    work: &mut f64,
    done: &mut PartClosing,
) -> Result<Option<usize>, MatrixError> {
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
        return Ok(None);
    }
    // What cannot close is searched only for how nearly it does.
    let starts = match done.proven_open {
        Some(_) => trying.starts.min(PROVEN_STARTS),
        None => trying.starts,
    };
    let before = Kept::of(task.part, states);
    let found = search::search(task, states, reference, starts, work)?;
    done.starts += found.starts;
    done.work_ended |=
        found.starts < starts && !found.best.as_ref().is_some_and(PartOutcome::closed);
    let steps = done.outcome.steps + found.steps;
    let nearer = |best: &PartOutcome| {
        best.closed() || best.gap(task.mechanism) < done.outcome.gap(task.mechanism)
    };
    match found.best.filter(nearer) {
        Some(best) => {
            done.outcome = PartOutcome {
                steps: steps.max(1),
                ..best
            };
        }
        None => {
            before.put_back(states);
            done.outcome.steps = steps;
        }
    }
    let after_search = !before_search && !done.outcome.closed();
    if after_search
        && let Some(outcome) = solved::closed_at(task, states, reference, &solved, work)?
    {
        done.outcome = outcome;
    }
    Ok(Some(steps))
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
