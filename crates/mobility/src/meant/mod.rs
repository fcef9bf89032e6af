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
mod drowned;
mod giving_way;
mod held_fast;
mod least_largest;
mod nearest;
mod noise;
mod nominal;
mod parts;
mod poses;
mod relations;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;

use super::analysis::Analysis;
use super::as_stated::analyse_as_stated;
use super::claim::{Bounds, Claim, Says};
use super::depth::Depth;
use super::exact_constraint::NoChangeSet;
use super::intended::{AsWritten, Meant};
use super::options::{AnalysisError, AnalysisOptions};
use super::pose_rank::Reading;
use super::redundant_directions::JointDirections;
use super::roles::JointRole;
use super::verdict::{Nominal, judge, unassembled};
use super::vocabulary::{EngineName, Scope, Verdict};
use dimensions::{ROUNDED_DECIMALS, rounding};
use held_fast::held_fast;
use kutzbach_closure::Part;
use kutzbach_model::mechanism::{Configuration, JointId, Mechanism};
use nominal::{nominal, sorted};
use parts::{PartMeant, WITHIN, parts_meant};

/// The mechanism meant is computed to so much (relative to its size, or rad).
const COMPUTED_TO: f64 = 1e-11;

fn meant_of(mechanism: &Mechanism, parts: &[&PartMeant]) -> Meant {
    let numbers = parts.iter().flat_map(|part| part.numbers.clone());
    let size = parts.iter().map(|part| part.length).fold(0.0, f64::max);
    Meant {
        mechanism: mechanism
            .clone()
            .with_joint_numbers(numbers)
            .with_precision(COMPUTED_TO * size.min(1.0)),
        changes: sorted(parts.iter().flat_map(|part| part.changes.clone()).collect()),
    }
}

/// Completes an analysis that hangs on rounding by a look at the mechanism meant.
///
/// A rank that is lower within the digits is no proof that some numbers within them have it: it says where to look. Where the numbers as
/// written close less well or bind, the mechanism meant is sought, and its distance decides.
///
/// # Errors
/// [`AnalysisError`] where numbers overflow.
pub(super) fn completed(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
    stated: Analysis,
) -> Result<Analysis, AnalysisError> {
    let configuration = options
        .configuration
        .as_ref()
        .and_then(|name| mechanism.configuration(name));
    let found = within_digits(mechanism, options, configuration, stated)?;
    noise::but_for_noise(mechanism, options, configuration, found)
}

fn within_digits(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
    configuration: Option<&Configuration>,
    mut stated: Analysis,
) -> Result<Analysis, AnalysisError> {
    let open = matches!(
        stated.mobility.verdict,
        Verdict::Undecided | Verdict::Unassembled
    );
    // What its reader lets count as closed is known to so much, whatever its digits say.
    let asked_for = options.closure_tolerance.filter(|_| !open);
    let read = asked_for.map(|tolerance| mechanism.clone().with_precision(tolerance));
    let mechanism = read.as_ref().unwrap_or(mechanism);
    let chosen = stated.mobility.verdict == Verdict::Rigid && mechanism.precision().is_exact();
    let asked = open || chosen || !mechanism.precision().is_exact();
    let mut joints = stated.structure.parts.iter().flat_map(|part| &part.joints);
    let rounded = joints.any(|&joint| rounding(mechanism, joint).is_some());
    if !(rounded && asked && options.depth > Depth::Rank) {
        return Ok(stated);
    }
    let parts = parts_meant(mechanism, configuration, &stated)?;
    if parts.is_empty() {
        return Ok(stated);
    }
    let closing = parts.iter().filter_map(|part| part.closing);
    let closing = closing.fold(0.0, f64::max);
    if closing > 0.0 && options.closure_tolerance.is_none() {
        // What the digits leave open at this pose, and not what they leave open of any walk around a loop.
        let assembly = &mut stated.assembly;
        let explained = assembly.residual * WITHIN / closing;
        assembly.tolerance = assembly.tolerance.min(explained);
    }
    let all: Vec<&PartMeant> = parts.iter().collect();
    let known = parts.iter().all(|part| part.nearest.is_some());
    if known {
        let nearest = meant_of(mechanism, &all);
        stated.nearest = (!nearest.changes.is_empty()).then(|| Box::new(nearest));
    }
    let typed = |part: &PartMeant| is_typed(mechanism, &stated.structure.parts[part.index]);
    if stated.mobility.verdict == Verdict::Unassembled && known && parts.iter().all(typed) {
        // Taken at its word, with the nearest mechanism beside it.
        let finite = parts.iter().map(|part| part.freedom).sum();
        stated.mobility.nominal = Some(Nominal {
            within_digits: false,
            ..nominal(&all, finite)
        });
        return Ok(stated);
    }
    if let Some(tolerance) = asked_for {
        if known && stated.nearest.is_some() {
            let mut nominal = nominal(&all, parts.iter().map(|part| part.freedom).sum());
            nominal.within_digits = nominal.distance.is_some_and(|d| d <= tolerance);
            nominal.known_to = Some(tolerance);
            stated.mobility.nominal = Some(nominal);
            stated.mobility.as_written = Some(AsWritten {
                verdict: Verdict::Unassembled,
                finite: None,
            });
        }
        return Ok(stated);
    }
    by_distance(mechanism, options, configuration, stated, &parts)
}

/// What the distances of the nearest dimensions of parts decide. Each part is read by its own numbers: those of one may be rounded, those
/// of another have the noise of the program that printed them.
fn by_distance(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
    configuration: Option<&Configuration>,
    stated: Analysis,
    parts: &[PartMeant],
) -> Result<Analysis, AnalysisError> {
    let verdict = stated.mobility.verdict;
    let open = matches!(verdict, Verdict::Undecided | Verdict::Unassembled);
    let chosen = verdict == Verdict::Rigid && mechanism.precision().is_exact();
    let within = |part: &PartMeant| part.nearest.is_some() && part.units() <= WITHIN;
    let near: Vec<&PartMeant> = parts.iter().filter(|part| within(part)).collect();
    if !near.is_empty() {
        let noisy = noise::noisy_parts(mechanism, options, configuration, &stated, &near)?;
        if let Some(found) = noise::meant_beside(mechanism, options, &stated, &near, &noisy)? {
            return Ok(found);
        }
    }
    if near.len() == parts.len() {
        let as_accepted = parts.iter().all(|part| part.accepted == Some(part.freedom));
        return match (open, chosen || as_accepted) {
            (false, true) => Ok(with_nearest(stated, &near, chosen)),
            _ => Ok(of_the_one_meant(mechanism, options, &stated, &near)?.unwrap_or(stated)),
        };
    }
    let refuted = |part: &PartMeant| part.excluded || part.is_open();
    let settled = parts.iter().all(|part| within(part) || refuted(part));
    if !chosen && settled && parts.iter().any(refuted) {
        return refuted_parts(mechanism, options, configuration, stated, parts);
    }
    Ok(stated)
}

/// The analysis as it is, with the mechanism that it is said of.
fn with_nearest(mut stated: Analysis, parts: &[&PartMeant], chosen: bool) -> Analysis {
    let Some(finite) = stated.mobility.finite() else {
        return stated;
    };
    let finite = match chosen {
        true => parts.iter().map(|part| part.freedom).sum(),
        false => finite,
    };
    let as_written = as_written(&stated);
    let known = stated.mobility.nominal.as_ref().map(|n| n.tolerance);
    let mut nominal = nominal(parts, finite);
    nominal.tolerance = known.unwrap_or(nominal.tolerance);
    if nominal.changes.is_empty() && !chosen {
        // The numbers as written are those meant.
        return stated;
    }
    stated.mobility.nominal = Some(nominal);
    stated.mobility.as_written = Some(as_written);
    stated
}

/// The analysis of the mechanism meant, all of whose other numbers are taken literally; `None` where that leaves it open.
fn of_the_one_meant(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
    stated: &Analysis,
    parts: &[&PartMeant],
) -> Result<Option<Analysis>, AnalysisError> {
    let meant = meant_of(mechanism, parts);
    let mut analysis = analyse_as_stated(&meant.mechanism, options)?;
    let moves = parts.iter().any(|part| part.freedom > 0);
    let Some(finite) = analysis.mobility.finite().filter(|f| *f > 0 || !moves) else {
        return Ok(None);
    };
    if meant.changes.is_empty() {
        // The numbers as written close all along a motion.
        for (now, before) in analysis.parts.iter_mut().zip(&stated.parts) {
            if before.decision.rank != now.decision.rank {
                now.reading = Reading::Literal;
            }
        }
        return Ok(Some(analysis));
    }
    analysis.mobility.nominal = Some(nominal(parts, finite));
    analysis.mobility.as_written = Some(as_written(stated));
    // How far the file's own numbers leave the loops open is what its reader asks.
    for (now, drawn) in analysis.assembly.gaps.iter_mut().zip(&stated.assembly.gaps) {
        (now.position, now.angle) = (drawn.position, drawn.angle);
    }
    analysis.nearest = Some(Box::new(meant.clone()));
    analysis.meant = Some(Box::new(meant));
    Ok(Some(analysis))
}

/// The analysis where no numbers within the digits let some part move, or close, as the rank within the digits would have it.
fn refuted_parts(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
    configuration: Option<&Configuration>,
    stated: Analysis,
    parts: &[PartMeant],
) -> Result<Analysis, AnalysisError> {
    if parts.iter().any(PartMeant::is_open) {
        return Ok(left_open(stated, parts));
    }
    let fewer = |part: &&PartMeant| {
        let literal = stated
            .parts
            .get(part.index)
            .and_then(|rank| rank.as_written);
        part.excluded && part.accepted.is_some_and(|f| f > 1) && literal != Some(0)
    };
    if parts.iter().any(|part| fewer(&part)) {
        // Some of its motions may be left: those of the numbers taken literally, if these close.
        let literal = mechanism.clone().with_precision(0.0);
        let mut analysis = analyse_as_stated(&literal, options)?;
        let all: Vec<&PartMeant> = parts.iter().collect();
        let Some(finite) = analysis.mobility.finite() else {
            let excluded = parts.iter().filter(|part| part.excluded);
            let open = excluded.map(|part| (part.index, stated.findings[part.index].upper()));
            let open: Vec<(usize, usize)> = open.collect();
            let why = "no numbers within the digits let it move with as many degrees of freedom as its rank within them; with how \
                       many fewer it moves is open";
            return Ok(opened(mechanism, stated, &open, why));
        };
        analysis.mobility.nominal = Some(nominal(&all, finite));
        analysis.nearest = stated.nearest;
        return Ok(analysis);
    }
    Ok(held_fast(mechanism, configuration, stated, parts))
}

/// A mechanism that counted as closed, though no numbers within the digits close it.
fn left_open(mut stated: Analysis, parts: &[PartMeant]) -> Analysis {
    stated.assembly.closed = false;
    let all: Vec<&PartMeant> = parts.iter().filter(|part| part.nearest.is_some()).collect();
    stated.mobility = unassembled(&stated.assembly);
    if !all.is_empty() {
        stated.mobility.nominal = Some(nominal(&all, 0));
    }
    stated.home = None;
    stated.parts.clear();
    stated.findings.clear();
    stated.branches = None;
    let count = stated.roles.len();
    stated.roles = vec![JointRole::default(); count];
    stated.redundant_wrenches = vec![None; count];
    stated.directions = vec![JointDirections::default(); count];
    stated.cycles.clear();
    stated.advice.clear();
    stated.change_sets = Err(NoChangeSet::Undecided);
    stated
}

/// The analysis with some parts open, each with so many freedoms at most.
fn opened(
    mechanism: &Mechanism,
    mut stated: Analysis,
    open: &[(usize, usize)],
    why: &str,
) -> Analysis {
    for &(index, most) in open {
        let Some(finding) = stated.findings.get_mut(index) else {
            continue;
        };
        // What bound the part at its pose was read of other numbers.
        let pose = finding.pose().filter(|_| finding.upper() >= most);
        finding.read_anew(Claim {
            pose,
            says: Says::Open(why.to_owned()),
            ..Claim::of(EngineName::Digits, Scope::Pose, Bounds::at_most(most), why)
        });
    }
    stated.mobility = judge(mechanism, &stated.structure, &stated.findings);
    stated.branches = None;
    stated
}

/// Whether the numbers of a part are somebody's choice and not rounded to their decimals.
fn is_typed(mechanism: &Mechanism, part: &Part) -> bool {
    part.joints.first().is_some_and(|&joint| {
        let precision = mechanism.precision_of(JointId(joint));
        precision.is_exact() && !precision.may_be_rounded_to(ROUNDED_DECIMALS)
    })
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
