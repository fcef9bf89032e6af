//! The nearest dimensions of every part that hangs on how its numbers were rounded: first with the relations that these nearly
//! satisfy, then without.

use super::dimensions::{Dimension, Dimensions};
use super::nearest::{Nearest, Search};
use super::poses::Loops;
use super::relations::{Kept, Relations};
use super::{Change, WITHIN};
use crate::analysis::Analysis;
use crate::pose_rank::{BEYOND_FIRST_ORDER, PartRank};
use crate::tree_bound::most_by_joints;
use kutzbach_closure::{Arithmetic, Geometry, JointState, Metric, Part, linearised};
use kutzbach_math::matrix::{DENSE_COLUMNS, MatrixError, relative_singular_values};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Configuration, Mechanism};

/// So many numbers of freedoms are tried for a part.
const TRIES: usize = 3;

/// Parts of more numbers than this are not searched.
const MOST_DIMENSIONS: usize = 600;

/// Where all dimensions that close along a motion change some number by more than so many units, to first order, none is within
/// the digits: room for the second order.
const EXCLUDED: f64 = 1.5;

/// Numbers that may well have been chosen are searched where there are no more of them.
const MOST_CHOSEN: usize = 200;

/// What was found of one part whose mobility hangs on how its numbers were rounded.
pub(super) struct PartMeant {
    /// Which part.
    pub index: usize,
    pub nearest: Option<Nearest>,
    /// How many freedoms it has where it moves.
    pub freedom: usize,
    /// Whether no numbers within the digits let it move.
    pub excluded: bool,
    /// The part's length (m).
    pub length: f64,
    pub changes: Vec<Change>,
    pub numbers: Vec<(usize, usize, Number)>,
    pub kept: Vec<Kept>,
}

impl PartMeant {
    /// The largest change, in units of what the digits leave open.
    pub fn units(&self) -> f64 {
        self.changes.iter().map(Change::units).fold(0.0, f64::max)
    }
}

/// The nearest dimensions of every part that hangs on rounding.
pub(super) fn parts_meant(
    mechanism: &Mechanism,
    configuration: Option<&Configuration>,
    stated: &Analysis,
) -> Result<Vec<PartMeant>, MatrixError> {
    let geometry = Geometry::new(mechanism, configuration, &Arithmetic::double());
    let mut found = Vec::new();
    for (index, part) in stated.structure.parts.iter().enumerate() {
        let finding = stated.findings.get(index);
        let rank = stated.parts.get(index);
        let dimensions = Dimensions::of(mechanism, part);
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
