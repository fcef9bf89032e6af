//! The mechanism meant by numbers that a program printed, up to the noise of its arithmetic.
//!
//! A geometry kernel, an optimiser or single precision leave errors far above the last digit that is printed of them. Nobody builds to a
//! millionth of a link: a misfit of numbers that are off by less, which stands alone, is met by the nearest mechanism without it, and what
//! the numbers are as written is said beside. Numbers typed by a person are taken at their word.

use super::dimensions::Dimensions;
use super::nearest::{Nearest, Search};
use super::parts::{GAP, MOST_DIMENSIONS, PartMeant, changes, is_else_as_written, reach};
use super::poses::Loops;
use super::relations::Relations;
use super::{of_the_one_meant, opened};
use crate::analysis::Analysis;
use crate::depth::Depth;
use crate::options::{AnalysisError, AnalysisOptions};
use crate::roles::JointRole;
use crate::vocabulary::Verdict;
use kutzbach_closure::{
    Arithmetic, CycleJacobian, Geometry, JointState, Metric, Part, Section, linearised, rounding_of,
};
use kutzbach_math::matrix::{DENSE_COLUMNS, MatrixError, relative_singular_values};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Configuration, Mechanism};

/// Noise of a number is less than this share of the loop's size (rad).
const NOISE: f64 = 1e-6;

/// Numbers count in units of this share, so that those of the mechanism meant are a few units from those written.
const UNIT: f64 = 0.1 * NOISE;

/// What stands alone is so many times smaller than the next.
const ALONE: f64 = 1e3;

/// Programs print so many significant digits at least, and no more than doubles have.
const PRINTED: std::ops::RangeInclusive<u32> = 9..=17;

/// It takes so many such numbers, and they are most of those that are neither zero nor a constant.
const LEAST_PRINTED: usize = 4;

/// Whether a program printed most numbers of a part.
fn is_printed(mechanism: &Mechanism, part: &Part) -> bool {
    let (mut long, mut all) = (0, 0);
    for &joint in &part.joints {
        for number in mechanism.joints()[joint].numbers().into_iter().flatten() {
            // What was read as a constant, or as a shorter decimal, says nothing; what was computed was typed, but where it has a text, or
            // knows the literals behind it: it is as long as the longest of these.
            let written = number
                .literals()
                .chain([number])
                .filter_map(Number::written);
            let significant = written.map(|own| own.significant).max().unwrap_or(0);
            all += usize::from(significant > 1);
            long += usize::from(PRINTED.contains(&significant));
        }
    }
    long >= LEAST_PRINTED && 2 * long > all
}

/// What the noise of a part's numbers comes to in the equations of its loops, if each number is off by itself: errors of so many add up like
/// their squares (rad, or lengths of how far the loops reach).
fn of_all_numbers(mechanism: &Mechanism, part: &Part) -> f64 {
    let uncertain = |number: &&Number| number.stated().is_some() || !number.inputs().is_empty();
    let count = |joint: &usize| {
        let numbers = mechanism.joints()[*joint].numbers().into_iter().flatten();
        numbers.filter(uncertain).count()
    };
    let count: usize = part.joints.iter().map(count).sum();
    NOISE * (count.max(1) as f64).sqrt()
}

/// Completes the analysis of numbers that a program printed: where they bind or stay open by noise only, that of the mechanism meant.
///
/// # Errors
/// [`AnalysisError`] where numbers overflow.
pub(super) fn but_for_noise(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
    configuration: Option<&Configuration>,
    stated: Analysis,
) -> Result<Analysis, AnalysisError> {
    let parts = noisy_parts(mechanism, options, configuration, &stated, &[])?;
    let verdict = stated.mobility.verdict;
    let decided = matches!(verdict, Verdict::Mobile | Verdict::Rigid);
    let same = |part: &PartMeant| part.changes.iter().all(|c| c.to == c.from);
    // Numbers that close all along a motion as they stand, to the rounding of doubles, move with what these leave open.
    if parts.is_empty() || decided && parts.iter().all(same) {
        return Ok(stated);
    }
    if let Some(found) = meant_beside(mechanism, options, &stated, &[], &parts)? {
        return Ok(found);
    }
    let moving = parts.iter().filter(|part| part.freedom > 0);
    let open: Vec<(usize, usize)> = moving.map(|part| (part.index, part.freedom)).collect();
    if !decided || open.is_empty() {
        return Ok(stated);
    }
    let mut stated = opened(mechanism, stated, &open, NOT_FOLLOWED);
    for (index, _) in open {
        for &joint in &stated.structure.parts[index].joints {
            stated.roles[joint] = JointRole::default();
        }
    }
    Ok(stated)
}

/// Why a part stays open that binds by noise only.
const NOT_FOLLOWED: &str = "as written it binds by no more than the noise of numbers that a program printed, and what the mechanism meant does \
                            was not decided; `--precision` states how well the numbers are known";

/// The analysis of the mechanism meant by the numbers of some parts but for their noise, beside those that are `near` by their digits;
/// `None` where that leaves it open, where there are none of the former, or where the numbers of another part, taken literally as they
/// are then, are not what they were read as.
pub(super) fn meant_beside(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
    stated: &Analysis,
    near: &[&PartMeant],
    noisy: &[PartMeant],
) -> Result<Option<Analysis>, AnalysisError> {
    let all: Vec<&PartMeant> = near.iter().copied().chain(noisy).collect();
    let among = |index: usize| all.iter().any(|part| part.index == index);
    let mut others = stated.findings.iter().zip(&stated.parts).enumerate();
    let otherwise = others.any(|(index, (finding, rank))| {
        !among(index) && finding.upper() > 0 && is_else_as_written(rank)
    });
    let other = |joint: usize| {
        let parts = &stated.structure.parts;
        let has = |part: &&PartMeant| parts[part.index].joints.contains(&joint);
        !all.iter().any(has)
    };
    let by_digits = stated.meant.as_ref();
    let by_digits = by_digits.is_some_and(|own| own.changes.iter().any(|c| other(c.joint)));
    if noisy.is_empty() || otherwise || by_digits {
        return Ok(None);
    }
    let mut found = of_the_one_meant(mechanism, options, stated, &all)?;
    if let Some(analysis) = &mut found
        && analysis.meant.is_some()
        && let Some(nominal) = &mut analysis.mobility.nominal
    {
        nominal.noise = true;
        nominal.within_digits = false;
    }
    Ok(found)
}

/// The parts whose numbers a program printed, and that bind or stay open by the noise of these only; none where another part stays open,
/// but for those that are `near` by their digits.
///
/// # Errors
/// [`AnalysisError`] where numbers overflow.
pub(super) fn noisy_parts(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
    configuration: Option<&Configuration>,
    stated: &Analysis,
    near: &[&PartMeant],
) -> Result<Vec<PartMeant>, AnalysisError> {
    let by_hand = mechanism.precision().by_hand().is_some();
    if by_hand || options.depth <= Depth::Rank {
        return Ok(Vec::new());
    }
    let geometry = Geometry::new(mechanism, configuration, &Arithmetic::double());
    let mut parts = Vec::new();
    for (index, part) in stated.structure.parts.iter().enumerate() {
        if near.iter().any(|near| near.index == index) {
            continue;
        }
        let finding = stated.findings.get(index);
        let open = finding.is_none_or(|finding| finding.open().is_some());
        let moves = !open && finding.is_some_and(|finding| finding.upper() > 0);
        if moves && !stands_elsewhere(mechanism, &geometry, stated, part)? {
            continue;
        }
        match of_part(mechanism, &geometry, stated, (index, part))? {
            Some(found) => parts.push(found),
            None if open && !closes_as_written(mechanism, &geometry, stated, part)? => {
                return Ok(Vec::new());
            }
            None => {}
        }
    }
    Ok(parts)
}

/// Whether a part was closed at a pose away from the drawn one, which misses by noise: nearer to it no pose closes the numbers as written.
/// A misfit of noise moves joints by as much, and at a singular pose by its root.
fn stands_elsewhere(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    stated: &Analysis,
    part: &Part,
) -> Result<bool, MatrixError> {
    if stated.assembly.starts <= 1 {
        return Ok(false);
    }
    let drawn = linearised(geometry, &geometry.states, part)?;
    let mut matrix = drawn.matrix.clone();
    let scales = matrix.scale_columns();
    let section = Section {
        mechanism,
        geometry,
        part,
        metric: &Metric::of(mechanism, &drawn, &scales),
    };
    let way = section.way_between(&geometry.states, &stated.assembly.states);
    let farthest = way.iter().fold(0.0f64, |most, way| way.abs().max(most));
    let noise = of_all_numbers(mechanism, part);
    Ok(misfit(&drawn) <= noise && farthest > noise.sqrt())
}

/// Whether a part of a mechanism that does not assemble closes with its numbers as they are, and these stand for no others by their
/// digits: what it does is decided when the others close.
fn closes_as_written(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    stated: &Analysis,
    part: &Part,
) -> Result<bool, MatrixError> {
    if part.cycles.is_empty() {
        return Ok(true);
    }
    let unassembled = stated.mobility.verdict == Verdict::Unassembled;
    if !unassembled || !Dimensions::of(mechanism, part).all.is_empty() {
        return Ok(false);
    }
    let here = linearised(geometry, &stated.assembly.states, part)?;
    let rounding = rounding_of(&here.walks, f64::EPSILON);
    let closed = |residual: &f64| residual.abs() <= GAP * rounding;
    Ok(here.residual.iter().all(closed))
}

/// How far the loops of a part are open (rad, or lengths of how far they reach).
fn misfit(here: &CycleJacobian<f64>) -> f64 {
    let share = here.length / reach(here);
    let size = |(row, residual): (usize, &f64)| match row % 6 < 3 {
        true => residual.abs(),
        false => residual.abs() * share,
    };
    here.residual
        .iter()
        .enumerate()
        .map(size)
        .fold(0.0, f64::max)
}

/// The rank without the singular values that noise leaves of zeros, where these stand alone: what the noise of all numbers may leave, or of
/// a single one, where the next value is not far above the former.
fn rank_but_for_noise(values: &[f64], misfit: f64, noise: f64) -> Option<usize> {
    let alone = |cut: f64| {
        let rank = values.iter().filter(|value| **value > cut).count();
        let next = values.get(rank).copied().unwrap_or(0.0).max(misfit);
        let least = rank.checked_sub(1).map_or(1.0, |last| values[last]);
        (least >= ALONE * next).then_some(rank)
    };
    alone(noise).or_else(|| alone(NOISE))
}

/// The pose at which a part is meant to stand. What does not close was sought everywhere: as it is drawn it may miss by no more than noise.
fn where_meant<'a>(
    mechanism: &Mechanism,
    geometry: &'a Geometry<f64>,
    stated: &'a Analysis,
    part: &Part,
) -> Result<&'a [JointState<f64>], MatrixError> {
    let drawn = match stated.mobility.verdict {
        Verdict::Unassembled => {
            let drawn = linearised(geometry, &geometry.states, part)?;
            misfit(&drawn) <= of_all_numbers(mechanism, part)
        }
        _ => stands_elsewhere(mechanism, geometry, stated, part)?,
    };
    Ok(match drawn {
        true => geometry.states.as_slice(),
        false => stated.assembly.states.as_slice(),
    })
}

/// The nearest mechanism of one part, where it is within noise.
fn of_part(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    stated: &Analysis,
    (index, part): (usize, &Part),
) -> Result<Option<PartMeant>, MatrixError> {
    if !is_printed(mechanism, part) {
        return Ok(None);
    }
    let unassembled = stated.mobility.verdict == Verdict::Unassembled;
    let noise = of_all_numbers(mechanism, part);
    let states = where_meant(mechanism, geometry, stated, part)?;
    let here = linearised(geometry, states, part)?;
    let mut matrix = here.matrix.clone();
    let scales = matrix.scale_columns();
    if matrix.columns() > DENSE_COLUMNS {
        return Ok(None);
    }
    let misfit = misfit(&here);
    let values = relative_singular_values(&matrix)?.unwrap_or_default();
    let rank = rank_but_for_noise(&values, misfit, noise).filter(|_| misfit <= noise);
    let Some(rank) = rank else {
        return Ok(None);
    };
    let (length, unit) = (here.length, UNIT * here.length);
    let dimensions = Dimensions::known_to(mechanism, part, unit).alike(unit, length);
    if !(1..=MOST_DIMENSIONS).contains(&dimensions.all.len()) {
        return Ok(None);
    }
    let freedom = matrix.columns() - rank;
    let metric = Metric::of(mechanism, &here, &scales);
    let search = |relations: &Relations, along: bool| -> Result<Option<Nearest>, MatrixError> {
        let mut search = Search {
            loops: Loops {
                mechanism,
                part,
                metric: &metric,
                freedom,
            },
            dimensions: &dimensions,
            relations,
            geometry: geometry.clone(),
            length: here.length,
            reach: reach(&here),
            work: 0,
        };
        match along {
            false => search.nearest_at_one_pose(states),
            true => search.nearest(states),
        }
    };
    let within = |nearest: &Nearest| nearest.z.iter().all(|z| z.abs() * UNIT <= NOISE);
    let relations = Relations::of(mechanism, part, &dimensions, geometry, here.length);
    let none = Relations::default();
    let (mut found, mut kept) = (None, Vec::new());
    if !relations.is_empty() && freedom > 0 {
        found = search(&relations, true)?.filter(within);
        kept = relations.kept();
    }
    if found.is_none() && freedom > 0 {
        found = search(&none, true)?.filter(within);
        kept.clear();
    }
    let moves = found.is_some();
    if found.is_none() && unassembled {
        // It closes, and moves or not as what closes does.
        found = search(&none, false)?.filter(within);
    }
    Ok(found.map(|nearest| {
        let numbers: Vec<(usize, usize, Number)> = dimensions.changes(&nearest.z);
        PartMeant {
            freedom: if moves { freedom } else { 0 },
            length: here.length,
            changes: changes(&dimensions, &nearest.z),
            numbers,
            kept,
            nearest: Some(nearest),
            ..PartMeant::of(index)
        }
    }))
}
