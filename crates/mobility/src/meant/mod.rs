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
mod nearest;
mod poses;
mod relations;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;

use super::analysis::{Analysis, AnalysisError, AnalysisOptions, analyse_as_stated};
use super::depth::Depth;
use super::pose_rank::{BEYOND_FIRST_ORDER, PartRank};
use super::roles::JointRole;
use super::tree_bound::most_by_joints;
use super::verdict::{Nominal, judge};
use super::vocabulary::{CertificateLevel, Verdict};
use super::whole_branches::whole_branches;
use dimensions::{Dimension, Dimensions, turns};
use kutzbach_closure::{Arithmetic, Geometry, JointState, Metric, Part, linearised};
use kutzbach_math::matrix::{DENSE_COLUMNS, MatrixError, relative_singular_values};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Configuration, Mechanism, Precision};
use nearest::{Nearest, Search};
use poses::Loops;
pub use relations::Kept;
use relations::Relations;

/// So many numbers of freedoms are tried for a part.
const TRIES: usize = 3;

/// The mechanism meant is computed to so much (relative to its size, or rad).
const COMPUTED_TO: f64 = 1e-11;

/// Files of two decimals hold chosen numbers, unless they do not close: then they are rounded like others.
const ROUNDED_DECIMALS: i32 = 2;

/// Parts of more numbers than this are not searched.
const MOST_DIMENSIONS: usize = 600;

/// Where all dimensions that close along a motion change some number by more than so many units, to first order, none is within
/// the digits: room for the second order.
const EXCLUDED: f64 = 1.5;

/// Numbers that may well have been chosen are searched where there are no more of them.
const MOST_CHOSEN: usize = 200;

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

/// What was found of one part whose mobility hangs on how its numbers were rounded.
struct PartMeant {
    /// Which part.
    index: usize,
    nearest: Option<Nearest>,
    /// How many freedoms it has where it moves.
    freedom: usize,
    /// Whether no numbers within the digits let it move.
    excluded: bool,
    /// The part's length (m).
    length: f64,
    changes: Vec<Change>,
    numbers: Vec<(usize, usize, Number)>,
    kept: Vec<Kept>,
}

impl PartMeant {
    fn units(&self) -> f64 {
        self.changes.iter().map(Change::units).fold(0.0, f64::max)
    }
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
    let Some(precision) = rounding(mechanism).filter(|_| asked && options.depth > Depth::Rank)
    else {
        return Ok(stated);
    };
    let configuration = options
        .configuration
        .as_ref()
        .and_then(|name| mechanism.configuration(name));
    let parts = parts_meant(mechanism, configuration, &precision, &stated)?;
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
    analysis.nearest = Some(Box::new(meant.clone()));
    analysis.meant = Some(Box::new(meant));
    Ok(analysis)
}

/// The analysis where no numbers within the digits let an open part move, and how far away the nearest mechanism is that moves.
fn held_fast(
    mechanism: &Mechanism,
    configuration: Option<&Configuration>,
    mut stated: Analysis,
    parts: &[PartMeant],
) -> Analysis {
    let all: Vec<&PartMeant> = parts.iter().collect();
    let mut nominal = nominal(&all, 0);
    if stated.mobility.verdict == Verdict::Undecided {
        for part in parts {
            let finding = &mut stated.findings[part.index];
            finding.lower = 0;
            finding.upper = 0;
            finding.at_rest = 0;
            finding.open = None;
            finding.level = CertificateLevel::Numeric;
            finding.certificate = certificate(part);
            // Of equations whose rank is open, joints that move to first order are not known to be locked.
            let holds = stated.parts[part.index].as_written == Some(0);
            for &joint in &stated.structure.parts[part.index].joints {
                let moves = mechanism.joints()[joint].freedom() > 0;
                stated.roles[joint] = JointRole {
                    locked: (holds && moves).then_some(true),
                    ..JointRole::default()
                };
            }
        }
        stated.mobility = judge(mechanism, &stated.structure, &stated.findings);
        stated.branches = whole_branches(
            mechanism,
            &Geometry::new(mechanism, configuration, &Arithmetic::double()),
            &stated.structure,
            &stated.assembly.states,
            stated.kutzbach,
            &stated.findings,
        );
        if let Some(home) = &mut stated.home {
            // Of equations that hold within the digits only, the rank is not known.
            home.instantaneous = None;
            home.redundant = None;
        }
        nominal.finite = stated.mobility.finite().unwrap_or(0);
    }
    stated.mobility.nominal = Some(nominal);
    stated
}

/// Why a part does not move whatever its digits stand for.
fn certificate(part: &PartMeant) -> String {
    let (open, least) = part.nearest.as_ref().map_or((0.0, 0.0), |nearest| {
        (nearest.misfit * part.length, nearest.at_least)
    });
    format!(
        "the pose allows one motion at most, and along it the loops stay open by up to {open:.1e} m; to close them along a \
         motion near it some number has to change, to first order, by at least {least:.1} times what its digits leave open"
    )
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

/// The precision at which the file's numbers are rounded; `None` where they are exact, or printed doubles.
fn rounding(mechanism: &Mechanism) -> Option<Precision> {
    let precision = *mechanism.precision();
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

/// The nearest dimensions of every part that hangs on rounding.
fn parts_meant(
    mechanism: &Mechanism,
    configuration: Option<&Configuration>,
    precision: &Precision,
    stated: &Analysis,
) -> Result<Vec<PartMeant>, MatrixError> {
    let geometry = Geometry::new(mechanism, configuration, &Arithmetic::double());
    let mut found = Vec::new();
    for (index, part) in stated.structure.parts.iter().enumerate() {
        let finding = stated.findings.get(index);
        let rank = stated.parts.get(index);
        let dimensions = Dimensions::of(mechanism, part, precision);
        let asked = finding.is_none_or(|finding| {
            let nearly = rank.is_some_and(|rank| nearly_moves(&dimensions, rank));
            finding.open.is_some() || finding.nominal.is_some() || finding.upper == 0 && nearly
        });
        if !asked {
            continue;
        }
        let mut of_part = PartMeant {
            index,
            nearest: None,
            freedom: 0,
            excluded: false,
            length: 0.0,
            changes: Vec::new(),
            numbers: Vec::new(),
            kept: Vec::new(),
        };
        let states = &stated.assembly.states;
        let freedom = finding
            .filter(|finding| finding.open.is_none() && finding.upper > 0)
            .map(|finding| finding.upper);
        let literal = rank.and_then(|rank| rank.as_written);
        let open_to = rank.map_or(0.0, |rank| rank.stated);
        let freedoms = Freedoms {
            known: freedom,
            literal: literal.unwrap_or(0),
            open_to: (open_to > 0.0).then_some(BEYOND_FIRST_ORDER * open_to),
        };
        if (1..=MOST_DIMENSIONS).contains(&dimensions.all.len())
            && let Some(Found {
                nearest,
                freedom,
                length,
                excluded,
                kept,
            }) = nearest_of_part(mechanism, &geometry, states, part, &dimensions, freedoms)?
        {
            of_part.excluded = excluded;
            of_part.freedom = freedom;
            of_part.changes = changes(&dimensions, &nearest.z);
            of_part.numbers = dimensions.changes(&nearest.z);
            of_part.nearest = Some(nearest);
            of_part.length = length;
            of_part.kept = kept;
        }
        found.push(of_part);
    }
    Ok(found)
}

/// Whether a part of exact numbers that holds fast would be open if they were rounded.
fn nearly_moves(dimensions: &Dimensions<'_>, rank: &PartRank) -> bool {
    let decision = &rank.decision;
    rank.stated == 0.0
        && rank.instantaneous == Some(0)
        && dimensions.all.len() <= MOST_CHOSEN
        && decision.kept <= BEYOND_FIRST_ORDER * dimensions.noise(rank.jacobian.length)
}

fn changes(dimensions: &Dimensions<'_>, z: &[f64]) -> Vec<Change> {
    let change = |(dimension, z): (&Dimension, &f64)| {
        let from = dimensions.numbers(dimension.joint, &[]).0[dimension.place];
        Change {
            joint: dimension.joint,
            place: dimension.place,
            from,
            to: from + z * dimension.unit,
            within: dimension.unit,
        }
    };
    dimensions.all.iter().zip(z).map(change).collect()
}

/// What is known of a part's freedoms beforehand.
struct Freedoms {
    /// How many it has within the digits, where that is decided.
    known: Option<usize>,
    /// How many the numbers leave at the pose where they are taken literally.
    literal: usize,
    /// Singular values above this share of the largest are no rounded zeros, where a pose was ranked.
    open_to: Option<f64>,
}

/// The nearest dimensions found of one part.
struct Found {
    nearest: Nearest,
    /// How many freedoms it has.
    freedom: usize,
    /// The part's length (m).
    length: f64,
    /// Whether the pose allows one motion at most, and no numbers within the digits let it go through.
    excluded: bool,
    /// The relations that it was found by.
    kept: Vec<Kept>,
}

/// The nearest dimensions of one part: those within the digits, if there are such.
fn nearest_of_part(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    part: &Part,
    dimensions: &Dimensions<'_>,
    known: Freedoms,
) -> Result<Option<Found>, MatrixError> {
    let here = linearised(geometry, states, part)?;
    let mut matrix = here.matrix.clone();
    let scales = matrix.scale_columns();
    if matrix.columns() > DENSE_COLUMNS {
        return Ok(None);
    }
    let values = relative_singular_values(&matrix)?.unwrap_or_default();
    let noise = dimensions.noise(here.length);
    let freedoms = match known.known {
        Some(freedom) => vec![freedom],
        None => {
            let most = most_by_joints(mechanism, part);
            by_gap(&values, matrix.columns(), noise, &known, most)
        }
    };
    let regular = has_one_direction(&values, matrix.columns(), noise, &known);
    let metric = Metric::of(mechanism, &here, &scales);
    let search = |freedom: usize, relations: &Relations| {
        let mut search = Search {
            loops: Loops {
                mechanism,
                part,
                metric: &metric,
                freedom,
            },
            dimensions,
            relations,
            geometry: geometry.clone(),
            length: here.length,
            work: 0,
        };
        // What closes as it is written is not made to follow relations.
        if !relations.is_empty() && search.closes_as_written(states)? {
            return Ok(None);
        }
        search.nearest(states)
    };
    let units = |nearest: &Nearest| nearest.z.iter().fold(0.0f64, |m, z| z.abs().max(m));
    let found = |(nearest, freedom): (Nearest, usize), excluded: bool, kept: Vec<Kept>| Found {
        nearest,
        freedom,
        length: here.length,
        excluded,
        kept,
    };
    let relations = Relations::of(mechanism, part, dimensions, geometry, here.length);
    if !relations.is_empty() {
        for &freedom in freedoms.iter().take(TRIES) {
            let nearest = search(freedom, &relations)?;
            if let Some(nearest) = nearest.filter(|nearest| units(nearest) <= WITHIN) {
                return Ok(Some(found((nearest, freedom), false, relations.kept())));
            }
        }
    }
    let mut best: Option<(Nearest, usize)> = None;
    let mut excluded = regular && freedoms == [1];
    for freedom in freedoms.into_iter().take(TRIES) {
        let Some(nearest) = search(freedom, &Relations::default())? else {
            excluded = false;
            continue;
        };
        excluded &= nearest.at_least > EXCLUDED;
        let within = units(&nearest) <= WITHIN;
        if best
            .as_ref()
            .is_none_or(|(best, _)| units(&nearest) < units(best))
        {
            best = Some((nearest, freedom));
        }
        if within {
            break;
        }
    }
    Ok(best.map(|best| found(best, excluded, Vec::new())))
}

/// Whether the equations leave one direction at most, whatever the digits stand for: then each mechanism within them that moves
/// does so along this one, and passes the pose regularly. Where there are several, a motion may leave the pose along any curve
/// among them, and that none of the dimensions searched closes says nothing of it.
fn has_one_direction(values: &[f64], columns: usize, noise: f64, known: &Freedoms) -> bool {
    let open_to = known.open_to.unwrap_or(BEYOND_FIRST_ORDER * noise);
    let clear = values.iter().filter(|value| **value > open_to).count();
    clear + 1 >= columns
}

/// The possible numbers of freedoms, from the literal one up to `most`; those with the widest gap in the singular values first.
/// `noise` is about what rounding leaves of a zero.
fn by_gap(values: &[f64], columns: usize, noise: f64, known: &Freedoms, most: usize) -> Vec<usize> {
    let value = |k: usize| values.get(k).copied().unwrap_or(0.0);
    let gap = |freedom: usize| -> f64 {
        let rank = columns - freedom;
        let kept = if rank == 0 { 1.0 } else { value(rank - 1) };
        kept / value(rank).max(noise)
    };
    let open = |freedom: &usize| value(columns - freedom) <= known.open_to.unwrap_or(1.0);
    let mut freedoms: Vec<usize> = (known.literal.max(1)..=most.min(columns))
        .filter(|f| columns - f <= values.len() && open(f))
        .collect();
    freedoms.sort_by(|a, b| gap(*b).total_cmp(&gap(*a)));
    freedoms
}
