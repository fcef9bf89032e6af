//! From one start down to where nothing improves.

use super::super::displacement::JointState;
use super::super::geometry::Geometry;
use super::super::jacobian::{CycleJacobian, Part, accuracy_of_fixed, entry_accuracy, jacobian};
use super::nearest::COMMENSURATE;
use kutzbach_math::matrix::{LeastSquares, MatrixError, Real, SplitMix64};
use kutzbach_math::space::{length, subtract};
use kutzbach_model::mechanism::Mechanism;
use std::collections::BTreeSet;

/// However coarsely the numbers are stated or rounded, a cycle that misses by more than this (rad, or cycle lengths) is not closed.
const COARSEST_CLOSING: f64 = 0.02;

/// A part to close.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) geometry: &'a Geometry<f64>,
    pub(super) part: &'a Part,
    /// Joints that keep their values.
    pub(super) held: &'a BTreeSet<usize>,
    /// What counts as closed (m), instead of what the file's digits say.
    pub(super) tolerance: Option<f64>,
}

/// How long a descent may go on.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    /// Steps after which it is given up.
    pub(super) steps: usize,
    /// Steps in which the sum of squares has to halve; `None` lets it creep.
    pub(super) patience: Option<usize>,
    /// Whether a gap that counts as closed is closed all the same, however far that moves the joints.
    pub(super) to_rounding: bool,
}

impl Effort {
    /// From the pose that the file draws, or beside it.
    pub(super) const LONG: Self = Self {
        steps: 200,
        patience: None,
        to_rounding: false,
    };
    /// Only where it stands.
    pub(super) const NONE: Self = Self {
        steps: 0,
        patience: None,
        to_rounding: false,
    };
    /// From one start among many.
    pub(super) const SHORT: Self = Self {
        steps: 80,
        patience: Some(12),
        to_rounding: false,
    };
    /// From a pose beside one that counts as closed, for the last of the gap.
    pub(super) const TO_ROUNDING: Self = Self {
        to_rounding: true,
        ..Self::SHORT
    };
}

/// Where a descent ended.
pub(super) struct PartOutcome {
    pub(super) residual: f64,
    pub(super) tolerance: f64,
    /// Length by which both count (m): that of the cycle which stays open farthest.
    pub(super) length: f64,
    /// What the arithmetic leaves of a closed cycle (rad, cycle lengths).
    pub(super) rounding: f64,
    pub(super) steps: usize,
    /// Floating-point operations, roughly: see [`step_work`].
    pub(super) work: f64,
    /// At the pose reached.
    pub(super) jacobian: Option<CycleJacobian<f64>>,
}

impl PartOutcome {
    /// Before anything was tried.
    pub(super) fn none() -> Self {
        Self {
            residual: f64::INFINITY,
            tolerance: 0.0,
            length: 1.0,
            rounding: 0.0,
            steps: 0,
            work: 0.0,
            jacobian: None,
        }
    }

    /// How far the cycles are open at the joints that close loops: of the worst, the angle (rad) and the largest distance by
    /// which such a joint misses itself after a walk around, in units of the size of the set of joints. The residual says less of a cycle whose axes
    /// almost meet far away: turned about that point it is hardly open there, and far open at the joints.
    pub(super) fn gap(&self, mechanism: &Mechanism) -> f64 {
        let Some(here) = &self.jacobian else {
            return f64::INFINITY;
        };
        let of_cycles = here.walks.iter().map(|walk| {
            let places = || walk.joints.iter().map(|joint| &joint.frame.translation);
            let far = |a: &[f64; 3], b: &[f64; 3]| length(&subtract(a, b));
            let size = places()
                .flat_map(|a| places().map(move |b| far(a, b)))
                .fold(0.0, f64::max);
            let size = if size > 0.0 { size } else { 1.0 };
            let closing = walk
                .joints
                .iter()
                .filter(|joint| mechanism.joints()[joint.joint].closes_loop)
                .map(|joint| &joint.frame.translation);
            let miss = closing.map(|place| far(&walk.closure.apply(place), place) / size);
            length(&walk.closure.rotation_vector()) + largest(&miss.collect::<Vec<f64>>())
        });
        let of_couplings = here.residual[6 * here.walks.len()..].iter().copied();
        largest(&of_cycles.chain(of_couplings).collect::<Vec<f64>>())
    }

    pub(super) fn closed(&self) -> bool {
        self.residual <= self.tolerance
    }
}

/// The largest magnitude; NaN if there is one, which must not pass for small.
pub(super) fn largest(values: &[f64]) -> f64 {
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
pub(super) struct Kept<R>(Vec<(usize, JointState<R>)>);

impl<R: Real> Kept<R> {
    pub(super) fn of(part: &Part, states: &[JointState<R>]) -> Self {
        Self(
            part.joints
                .iter()
                .map(|&j| (j, states[j].clone()))
                .collect(),
        )
    }

    pub(super) fn put_back(&self, states: &mut [JointState<R>]) {
        for (joint, state) in &self.0 {
            states[*joint] = state.clone();
        }
    }
}

/// Moves the joints of a part by up to `size` (rad, or part lengths), by numbers that depend on joint names only.
pub(super) fn nudge(
    task: &Task<'_>,
    size: f64,
    states: &mut [JointState<f64>],
) -> Result<(), MatrixError> {
    let here = jacobian(task.mechanism, task.geometry, states, task.part)?;
    let movable = movable_columns(&here, task.held);
    let increments: Vec<f64> = here
        .variables
        .iter()
        .map(|(joint, variable)| {
            let mut random = SplitMix64::named(&task.mechanism.joints()[*joint].name);
            (0..=*variable)
                .map(|_| random.symmetric())
                .last()
                .unwrap_or(0.0)
                * size
        })
        .collect();
    advance(
        task.mechanism,
        task.geometry,
        &here,
        &movable,
        &increments,
        states,
    );
    Ok(())
}

/// Damped Gauss–Newton from one start until the cycles close to rounding, or nothing improves.
pub(super) fn descend(
    task: &Task<'_>,
    states: &mut [JointState<f64>],
    effort: Effort,
) -> Result<PartOutcome, MatrixError> {
    let Task {
        mechanism,
        geometry,
        part,
        held,
        ..
    } = *task;
    let mut here = jacobian(mechanism, geometry, states, part)?;
    let work = step_work(&here);
    let (mut stated, rounding) = entry_accuracy(&here);
    if let Some(given) = task.tolerance {
        stated = here.walks.iter().fold(given / here.length, |least, walk| {
            least.min(given / walk.length)
        });
    }
    let mut residual = open_where_something_moves(&here);
    let mut steps = 0;
    let mut caution = 1.0f64;
    let sum = |r: &[f64]| r.iter().map(|x| x * x).sum::<f64>();
    let mut milestone = sum(&here.residual);
    let mut polishing = false;
    let columns = movable_columns(&here, held);
    // A pose that closes to the last digit is left exactly as it was drawn. One that had to be moved is polished as long as
    // that helps, so that it closes well within the bound wherever else it is read.
    let mut halved = true;
    while (residual > rounding || residual > 0.0 && steps > 0 && halved) && steps < effort.steps {
        let square = sum(&here.residual);
        if let Some(patience) = effort.patience
            && steps % patience == patience - 1
        {
            if square > 0.5 * milestone {
                break;
            }
            milestone = square;
        }
        let within = residual <= stated.min(COARSEST_CLOSING) && !effort.to_rounding;
        if within && !polishing {
            // The caution that led here from afar is no measure of what the steps at the end are worth. Some is needed: beside
            // a closed pose of dependent equations a step without damping goes any way along the motion.
            polishing = true;
            caution = caution.min(1.0);
        }
        let Some(increments) = step(&here, &columns, caution * square.min(1.0))? else {
            break;
        };
        // What closes within the stated precision is polished on only by steps in proportion to the gap: rounded numbers
        // may leave a gap that no motion removes, and chasing it would drag the mechanism along its own freedom.
        if within && largest(&increments) > stated.max(COMMENSURATE * residual) {
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
            halved = reached <= 0.25 * square;
            here = there;
            residual = open_where_something_moves(&here);
            caution = (caution * 0.25).max(1e-6);
            if stalled {
                break;
            }
        } else {
            before.put_back(states);
            halved = false;
            caution *= 8.0;
            if caution > 1e12 {
                break;
            }
        }
    }
    // What still counts as closed is the uncertainty of a walk around the cycle, which is that of a Jacobian entry.
    let allowed = |length: f64, fixed: (f64, f64)| match task.tolerance {
        None => stated + rounding + fixed.0 + fixed.1,
        Some(given) => given / length + rounding + fixed.1,
    };
    let (residual, tolerance, length) = worst_of(&here, allowed);
    Ok(PartOutcome {
        residual,
        tolerance,
        length,
        rounding,
        steps,
        work: work * (steps + 1) as f64,
        jacobian: Some(here),
    })
}

/// The equation that exceeds what is allowed by most, or comes closest to that: its residual, what it may be, and the length by
/// which it counts (m). `allowed` says what an equation may leave (rad, lengths of its cycle) that counts by a length (m), that of the
/// cycle, for couplings that of the part, where a cycle of fixed joints is as accurate as this.
fn worst_of(
    here: &CycleJacobian<f64>,
    allowed: impl Fn(f64, (f64, f64)) -> f64,
) -> (f64, f64, f64) {
    let of_cycles = 6 * here.walks.len();
    let roundoff = here.matrix.zero().unit_roundoff();
    let may = |length: f64, fixed: (f64, f64)| allowed(length, fixed).min(COARSEST_CLOSING);
    let mut worst = (0.0f64, may(here.length, (0.0, 0.0)), here.length);
    let mut heed = |rows: &[f64], length: f64, fixed: (f64, f64)| {
        let (found, may) = (largest(rows), may(length, fixed));
        // What is not a number must not pass for small.
        if !worst.0.is_nan() && !(found * worst.1 <= worst.0 * may) {
            worst = (found, may, length);
        }
    };
    for (walk, rows) in here.walks.iter().zip(here.residual.chunks(6)) {
        heed(rows, walk.length, accuracy_of_fixed(walk, roundoff));
    }
    let of_couplings = here.residual.get(of_cycles..).unwrap_or(&[]);
    heed(of_couplings, here.length, (0.0, 0.0));
    worst
}

/// How far the equations are open that have something to close them by: all but those of cycles of fixed joints.
fn open_where_something_moves(here: &CycleJacobian<f64>) -> f64 {
    let of_cycles = here.walks.iter().zip(here.residual.chunks(6));
    let moving = of_cycles
        .filter(|(walk, _)| walk.screw_count() > 0)
        .map(|(_, rows)| rows);
    let of_couplings = here.residual.get(6 * here.walks.len()..).unwrap_or(&[]);
    let all: Vec<f64> = moving.chain([of_couplings]).map(largest).collect();
    largest(&all)
}

/// What one step costs in floating-point operations, roughly: walking the cycles, and solving for the step as
/// [`LeastSquares::damped`] does, densely or by as many iterations as it may take.
fn step_work(here: &CycleJacobian<f64>) -> f64 {
    const OF_A_JOINT: f64 = 4000.0;
    let walked: usize = here.walks.iter().map(|walk| walk.joints.len()).sum();
    let (rows, columns) = (here.matrix.rows() as f64, here.matrix.columns() as f64);
    let solving = if columns <= 300.0 {
        2.0 * (rows + columns) * columns * columns
    } else {
        4.0 * here.matrix.entry_count() as f64 * (2.0 * columns).min(5000.0)
    };
    OF_A_JOINT * walked as f64 + solving
}

pub(super) fn movable_columns<R>(jacobian: &CycleJacobian<R>, held: &BTreeSet<usize>) -> Vec<bool> {
    jacobian
        .variables
        .iter()
        .map(|(joint, _)| !held.contains(joint))
        .collect()
}

/// The damped step `min |J x + r|² + damping |x|²`, held columns left out; `None` where nothing may move.
pub(super) fn step(
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
pub(super) fn advance<R: Real>(
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
