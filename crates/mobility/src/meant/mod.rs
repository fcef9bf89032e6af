//! What rounded numbers were meant to be: the mobile mechanism nearest to them, and whether it lies within their digits.
//!
//! A linkage that moves because of relations between its dimensions is, written with a few decimals, another one, which binds.
//! Ranks within the stated precision tell such mechanisms from rigid ones while the precision is fine; coarse decimals leave
//! them open, and where the loops do not close within them there is no pose to rank at all. Then the mechanism meant is
//! computed: the dimensions nearest to those written for which the loops close along a finite motion (`nearest.rs`). It is
//! analysed as any other mechanism is, so that whatever is said of it rests on that analysis and not on how it was found;
//! and how far it is from what is written is said beside it.
//!
//! Where several numbers of freedoms are possible, that with the widest gap in the singular values is tried first.

mod dimensions;
mod held_fast;
mod nearest;
mod parts;
mod poses;
mod relations;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;

use super::analysis::{Analysis, AnalysisError, AnalysisOptions, analyse_as_stated};
use super::depth::Depth;
use super::verdict::Nominal;
use super::vocabulary::Verdict;
use dimensions::turns;
use held_fast::held_fast;
use kutzbach_model::mechanism::{JointId, Mechanism, Precision};
use parts::{PartMeant, parts_meant};
pub use relations::Kept;

/// The mechanism meant is computed to so much (relative to its size, or rad).
const COMPUTED_TO: f64 = 1e-11;

/// Files of two decimals hold chosen numbers, unless they do not close: then they are rounded like others.
const ROUNDED_DECIMALS: i32 = 2;

/// A number is within its digits up to one unit, and rounding.
const WITHIN: f64 = 1.0 + 1e-6;

/// A number that the mechanism meant has otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Joint index.
    pub joint: usize,
    /// Place in [`kutzbach_model::mechanism::Joint::numbers`].
    pub place: usize,
    /// The number as written (m, rad).
    pub from: f64,
    /// The number meant.
    pub to: f64,
    /// How far the digits allow it to be (m, rad).
    pub within: f64,
}

/// The mobile mechanism nearest to a file's numbers.
#[derive(Clone, Debug)]
pub struct Meant {
    /// The mechanism, its numbers known to rounding.
    pub mechanism: Mechanism,
    /// What differs, largest in units of its uncertainty first.
    pub changes: Vec<Change>,
}

impl Change {
    /// The change in units of what the digits leave open: up to 1 it lies within them.
    #[must_use]
    pub fn units(&self) -> f64 {
        (self.to - self.from).abs() / self.within
    }
}

impl Meant {
    fn of(mechanism: &Mechanism, parts: &[&PartMeant]) -> Self {
        let numbers = parts.iter().flat_map(|part| part.numbers.clone());
        let size = parts.iter().map(|part| part.length).fold(0.0, f64::max);
        Self {
            mechanism: mechanism
                .clone()
                .with_joint_numbers(numbers)
                .with_precision(COMPUTED_TO * size.min(1.0)),
            changes: sorted(parts.iter().flat_map(|part| part.changes.clone()).collect()),
        }
    }
}

/// The numbers taken literally.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AsWritten {
    /// What they leave.
    pub verdict: Verdict,
    /// Freedom, where it is decided.
    pub finite: Option<usize>,
}

/// Completes an analysis that hangs on rounding by a look at the mechanism meant.
///
/// # Errors
/// [`AnalysisError`] where numbers overflow.
pub(super) fn completed(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
    mut stated: Analysis,
) -> Result<Analysis, AnalysisError> {
    let open = matches!(
        stated.mobility.verdict,
        Verdict::Undecided | Verdict::Unassembled
    );
    let rigid = stated.mobility.verdict == Verdict::Rigid && mechanism.precision().is_exact();
    let asked = open || rigid || stated.mobility.nominal.is_some();
    let mut parts = stated.structure.parts.iter();
    let rounded = parts.any(|part| {
        part.joints
            .iter()
            .any(|&j| rounding(mechanism, j).is_some())
    });
    if !(rounded && asked && options.depth > Depth::Rank) {
        return Ok(stated);
    }
    let configuration = options
        .configuration
        .as_ref()
        .and_then(|name| mechanism.configuration(name));
    let parts = parts_meant(mechanism, configuration, &stated)?;
    let within = |part: &PartMeant| part.nearest.is_some() && part.units() <= WITHIN;
    if parts.is_empty() {
        return Ok(stated);
    }
    if parts.iter().all(|part| part.nearest.is_some()) {
        let all: Vec<&PartMeant> = parts.iter().collect();
        let nearest = Meant::of(mechanism, &all);
        stated.nearest = (!nearest.changes.is_empty()).then(|| Box::new(nearest));
    }
    if open && parts.iter().all(|part| part.excluded) {
        return Ok(held_fast(mechanism, configuration, stated, &parts));
    }
    if !parts.iter().all(within) {
        return Ok(stated);
    }
    let all: Vec<&PartMeant> = parts.iter().collect();
    let as_written = as_written(&stated);
    if !open {
        if let Some(finite) = stated.mobility.finite() {
            let finite = match rigid {
                true => parts.iter().map(|part| part.freedom).sum(),
                false => finite,
            };
            let known = stated
                .mobility
                .nominal
                .as_ref()
                .map(|known| known.tolerance);
            let mut nominal = nominal(&all, finite);
            nominal.tolerance = known.unwrap_or(nominal.tolerance);
            stated.mobility.nominal = Some(nominal);
            stated.mobility.as_written = Some(as_written);
        }
        return Ok(stated);
    }
    let meant = Meant::of(mechanism, &all);
    let mut analysis = analyse_as_stated(&meant.mechanism, options)?;
    let Some(finite) = analysis.mobility.finite().filter(|finite| *finite > 0) else {
        return Ok(stated);
    };
    if meant.changes.is_empty() {
        // The numbers as written close all along a motion.
        for (now, before) in analysis.parts.iter_mut().zip(&stated.parts) {
            now.taken_literally |= before.decision.rank != now.decision.rank;
        }
        return Ok(analysis);
    }
    analysis.mobility.nominal = Some(nominal(&all, finite));
    analysis.mobility.as_written = Some(as_written);
    // How far the file's own numbers leave the loops open is what its reader asks.
    for (now, drawn) in analysis.assembly.gaps.iter_mut().zip(&stated.assembly.gaps) {
        (now.position, now.angle) = (drawn.position, drawn.angle);
    }
    analysis.nearest = Some(Box::new(meant.clone()));
    analysis.meant = Some(Box::new(meant));
    Ok(analysis)
}

fn nominal(parts: &[&PartMeant], finite: usize) -> Nominal {
    let misfit = |part: &&PartMeant| {
        let open = part.nearest.as_ref().map_or(0.0, |nearest| nearest.misfit);
        open * part.length
    };
    let distance = |part: &&PartMeant| {
        let (far, turn) = farthest(&part.changes);
        far.max(turn * part.length)
    };
    Nominal {
        finite,
        tolerance: parts.iter().map(misfit).fold(0.0, f64::max),
        distance: Some(parts.iter().map(distance).fold(0.0, f64::max)),
        known_to: None,
        within_digits: parts.iter().all(|part| part.units() <= WITHIN),
        changes: sorted(parts.iter().flat_map(|part| part.changes.clone()).collect()),
        kept: parts.iter().flat_map(|part| part.kept.clone()).collect(),
    }
}

/// Largest change of a length (m), and of an angle or a direction (rad).
fn farthest(changes: &[Change]) -> (f64, f64) {
    let largest = |turning: bool| {
        changes
            .iter()
            .filter(|change| turns(change.place) == turning)
            .map(|change| (change.to - change.from).abs())
            .fold(0.0, f64::max)
    };
    (largest(false), largest(true))
}

fn sorted(mut changes: Vec<Change>) -> Vec<Change> {
    changes.retain(|change| change.to != change.from);
    changes.sort_by(|a, b| b.units().total_cmp(&a.units()));
    changes
}

/// The precision at which the numbers of a joint's sub-mechanism are rounded; `None` where they are exact, or printed doubles.
fn rounding(mechanism: &Mechanism, joint: usize) -> Option<Precision> {
    let precision = *mechanism.precision_of(JointId(joint));
    if precision.is_of_doubles() {
        return None;
    }
    if !precision.is_exact() {
        return Some(precision);
    }
    let decimals = precision.decimals.filter(|d| *d >= ROUNDED_DECIMALS)?;
    let by_hand = precision.by_hand().is_some();
    (!by_hand).then(|| precision.known_to(0.5 * 10f64.powi(-decimals)))
}

/// What the literal numbers leave, as far as it is known.
fn as_written(stated: &Analysis) -> AsWritten {
    let unassembled = stated.mobility.verdict == Verdict::Unassembled;
    let home = stated.home.as_ref();
    let rigid = home.is_some_and(|home| {
        home.as_written == Some(0) || home.as_written.is_none() && home.instantaneous == Some(0)
    });
    match (unassembled, rigid) {
        (true, _) => AsWritten {
            verdict: Verdict::Unassembled,
            finite: None,
        },
        (_, true) => AsWritten {
            verdict: Verdict::Rigid,
            finite: Some(0),
        },
        _ => AsWritten {
            verdict: Verdict::Undecided,
            finite: None,
        },
    }
}
