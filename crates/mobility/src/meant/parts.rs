//! The nearest dimensions of every part that hangs on how its numbers were rounded: first with the relations that these nearly
//! satisfy, then without.

use super::dimensions::{Dimension, Dimensions};
use super::giving_way::least_change_to_give_way;
use super::nearest::{Nearest, Search};
use super::poses::Loops;
use super::relations::Relations;
use crate::analysis::Analysis;
use crate::intended::{Change, Kept};
use crate::judge::PartFinding;
use crate::pose_rank::{BEYOND_FIRST_ORDER, PartRank};
use crate::tree_bound::most_by_joints;
use kutzbach_closure::{
    Arithmetic, CycleJacobian, Geometry, JointState, Metric, Part, linearised, rounding_of,
};
use kutzbach_math::matrix::{DENSE_COLUMNS, MatrixError, relative_singular_values};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Configuration, Mechanism};

/// Numbers are within their digits up to so many units. What was rounded once differs by one at most; a quarter more is for numbers
/// that were converted, and rounded, before, and for the second order.
pub(super) const WITHIN: f64 = 1.25;

/// So many numbers of freedoms are tried for a part.
const TRIES: usize = 3;

/// Parts of more numbers than this are not searched.
pub(super) const MOST_DIMENSIONS: usize = 600;

/// A gap is none of rounding where it is so many times what that may leave.
pub(super) const GAP: f64 = 8.0;

/// What holds fast to first order is clearly beyond the digits where it is so many times what these leave open: the second order of such
/// changes is less than their first.
const CLEARLY: f64 = 1.5;

/// Of numbers that may be off by more than this (rad, or of how far the loops reach) the first order says too little.
const COARSE: f64 = 0.01;

/// Numbers that may well have been chosen are searched where there are no more of them.
const MOST_CHOSEN: usize = 200;

/// What was found of one part whose mobility hangs on how its numbers were rounded.
pub(super) struct PartMeant {
    /// Which part.
    pub index: usize,
    pub nearest: Option<Nearest>,
    /// How many freedoms it has where it moves.
    pub freedom: usize,
    /// How many freedoms the rank within the digits gave it, where that decided.
    pub accepted: Option<usize>,
    /// Whether no numbers within the digits let it move, or with as many freedoms as it was given.
    pub excluded: bool,
    /// What some number has to change by at least for it to move so, in units of what the digits leave open.
    pub at_least: f64,
    /// Whether that is for it to have any velocity, to first order.
    pub rigid: bool,
    /// Whether its loops as written stay open at the pose by more than rounding.
    pub gap: bool,
    /// What some number has to change by at least for its loops to close at the pose, in units of what the digits leave open, where
    /// that was asked.
    pub closing: Option<f64>,
    /// The part's length (m).
    pub length: f64,
    pub changes: Vec<Change>,
    pub numbers: Vec<(usize, usize, Number)>,
    pub kept: Vec<Kept>,
}

impl PartMeant {
    /// Of a part of which nothing is found yet.
    pub fn of(index: usize) -> Self {
        Self {
            index,
            nearest: None,
            freedom: 0,
            accepted: None,
            excluded: false,
            at_least: 0.0,
            rigid: false,
            gap: false,
            closing: None,
            length: 0.0,
            changes: Vec::new(),
            numbers: Vec::new(),
            kept: Vec::new(),
        }
    }

    /// Whether no numbers within the digits close its loops at the pose.
    pub fn is_open(&self) -> bool {
        self.closing.is_some_and(|closing| closing > WITHIN)
    }

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
            let else_as_written = rank.is_some_and(is_else_as_written);
            finding.open().is_some()
                || finding.nominal().is_some()
                || else_as_written
                || finding.upper() == 0 && nearly
        });
        if !asked {
            continue;
        }
        let mut of_part = PartMeant::of(index);
        of_part.gap = rank.is_some_and(leaves_a_gap);
        let states = &stated.assembly.states;
        let freedom = finding
            .filter(|finding| finding.open().is_none() && finding.upper() > 0)
            .map(PartFinding::upper);
        of_part.accepted = freedom;
        let rigid = finding.is_some_and(|finding| finding.open().is_none() && finding.upper() == 0);
        let literal = rank.and_then(|rank| rank.as_written);
        let open_to = rank.map_or(0.0, |rank| rank.open_by_digits());
        let most = rank
            .filter(|_| freedom.is_none())
            .map(|rank| rank.candidates.1);
        let freedoms = Freedoms {
            known: freedom,
            possible: most,
            literal: literal.unwrap_or(0),
            open_to: (open_to > 0.0).then_some(BEYOND_FIRST_ORDER * open_to),
        };
        if (1..=MOST_DIMENSIONS).contains(&dimensions.all.len())
            && !(rigid && rank.is_some_and(|rank| rank.open_by_digits() > 0.0))
            && let Some(found) =
                nearest_of_part(mechanism, &geometry, states, part, &dimensions, freedoms)?
        {
            of_part.excluded = found.excluded.is_some();
            of_part.at_least = found.excluded.unwrap_or(0.0);
            of_part.rigid = found.rigid;
            of_part.length = found.length;
            if let Some((nearest, freedom)) = found.nearest {
                of_part.freedom = freedom;
                of_part.changes = changes(&dimensions, &nearest.z);
                of_part.numbers = dimensions.changes(&nearest.z);
                of_part.nearest = Some(nearest);
                of_part.kept = found.kept;
            }
        }
        let still = rigid || of_part.rigid || of_part.excluded && of_part.accepted.is_some();
        if still && of_part.gap {
            of_part.closing = Some(closing(mechanism, &geometry, states, part, &dimensions)?);
        }
        found.push(of_part);
    }
    Ok(found)
}

/// Whether the loops of a part stay open at its pose by more than rounding: a misfit of dimensions, since the pose was closed as far as
/// it closes.
fn leaves_a_gap(rank: &PartRank) -> bool {
    let rounding = rounding_of(&rank.jacobian.walks, f64::EPSILON);
    let open = |residual: &f64| residual.abs() > GAP * rounding;
    rank.open_by_digits() > 0.0 && rank.jacobian.residual.iter().any(open)
}

/// Whether the numbers of a part as written close less well, or have a higher rank, than those that they may stand for.
pub(super) fn is_else_as_written(rank: &PartRank) -> bool {
    let literally = rank.as_written != rank.instantaneous;
    rank.open_by_digits() > 0.0 && (literally || leaves_a_gap(rank))
}

/// What some number has to change by at least for the loops of a part to close at its pose, whatever moves then (units); zero where that
/// is not computed.
fn closing(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    part: &Part,
    dimensions: &Dimensions<'_>,
) -> Result<f64, MatrixError> {
    let here = linearised(geometry, states, part)?;
    let mut matrix = here.matrix.clone();
    let scales = matrix.scale_columns();
    if matrix.columns() > DENSE_COLUMNS || dimensions.all.len() > MOST_DIMENSIONS {
        return Ok(0.0);
    }
    let values = relative_singular_values(&matrix)?.unwrap_or_default();
    let noise = dimensions.noise(here.length);
    let clear = values.iter().filter(|value| **value > noise).count();
    let metric = Metric::of(mechanism, &here, &scales);
    let relations = Relations::default();
    let asked = Asked {
        mechanism,
        part,
        metric: &metric,
        dimensions,
        geometry,
        length: here.length,
        reach: reach(&here),
    };
    let mut search = asked.search(matrix.columns() - clear, &relations);
    search.least_change_to_close(states)
}

/// Whether a part of exact numbers that holds fast would be open if they were rounded.
fn nearly_moves(dimensions: &Dimensions<'_>, rank: &PartRank) -> bool {
    let decision = &rank.decision;
    rank.open_by_digits() == 0.0
        && rank.instantaneous == Some(0)
        && dimensions.all.len() <= MOST_CHOSEN
        && decision.kept <= BEYOND_FIRST_ORDER * dimensions.noise(rank.jacobian.length)
}

pub(super) fn changes(dimensions: &Dimensions<'_>, z: &[f64]) -> Vec<Change> {
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
    /// How many it may have within the digits, where the rank is open.
    possible: Option<usize>,
    /// How many the numbers leave at the pose where they are taken literally.
    literal: usize,
    /// Singular values above this share of the largest are no rounded zeros, where a pose was ranked.
    open_to: Option<f64>,
}

/// How far the loops of a part reach from their middle (m), or the part's length if that is more.
pub(super) fn reach(here: &CycleJacobian<f64>) -> f64 {
    let each = here.walks.iter().map(|walk| walk.extent);
    each.fold(here.length, f64::max)
}

/// A part as it is asked about.
struct Asked<'a> {
    mechanism: &'a Mechanism,
    part: &'a Part,
    metric: &'a Metric,
    dimensions: &'a Dimensions<'a>,
    geometry: &'a Geometry<f64>,
    length: f64,
    reach: f64,
}

impl<'a> Asked<'a> {
    fn search(&self, freedom: usize, relations: &'a Relations) -> Search<'a> {
        Search {
            loops: Loops {
                mechanism: self.mechanism,
                part: self.part,
                metric: self.metric,
                freedom,
            },
            dimensions: self.dimensions,
            relations,
            geometry: self.geometry.clone(),
            length: self.length,
            reach: self.reach,
            work: 0,
        }
    }
}

impl Asked<'_> {
    /// What some number has to change by at least for the part to have a velocity at its pose, where that is clearly more than the
    /// digits leave open; `possible` is how many freedoms it may have within them.
    fn holds_fast(
        &self,
        states: &[JointState<f64>],
        possible: Option<usize>,
    ) -> Result<Option<f64>, MatrixError> {
        let none = Relations::default();
        if self.dimensions.coarsest(self.reach) > COARSE {
            return Ok(None);
        }
        let least = least_change_to_give_way(
            &self.search(0, &none).loops,
            self.dimensions,
            (self.geometry, states),
            self.length,
            possible.unwrap_or(1),
        )?;
        Ok(least.filter(|least| *least > CLEARLY * WITHIN))
    }

    /// Beyond the digits, nearest is what changes least in metres, however precisely single numbers are written.
    fn draw_near_in_metres(
        &self,
        states: &[JointState<f64>],
        nearest: &mut Nearest,
        freedom: usize,
    ) -> Result<(), MatrixError> {
        let distance = self.dimensions.distance(&nearest.z, self.length);
        let alike = self.dimensions.alike(distance, self.length);
        let relations = Relations::default();
        let asked = Asked {
            dimensions: &alike,
            geometry: self.geometry,
            metric: self.metric,
            ..*self
        };
        let found = asked.search(freedom, &relations).nearest(states)?;
        if let Some(found) = found.filter(|found| alike.distance(&found.z, self.length) < distance)
        {
            let both = alike.all.iter().zip(&self.dimensions.all).zip(&found.z);
            nearest.z = both
                .map(|((to, from), z)| z * to.unit / from.unit)
                .collect();
            nearest.misfit = found.misfit;
        }
        Ok(())
    }
}

/// What was found of one part.
struct Found {
    /// The nearest dimensions, and how many freedoms they have.
    nearest: Option<(Nearest, usize)>,
    /// The part's length (m).
    length: f64,
    /// What some number has to change by at least (units), where no numbers within the digits let it move: where the pose allows
    /// one motion at most, or has a number of freedoms within the digits.
    excluded: Option<f64>,
    /// Whether that is what it has to change by to have any velocity, to first order.
    rigid: bool,
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
        // If none within the digits has as many, then maybe some has fewer.
        Some(freedom) => {
            let fewer = by_gap(&values, matrix.columns(), noise, &known, freedom - 1);
            std::iter::once(freedom).chain(fewer).collect()
        }
        None => {
            let most = most_by_joints(mechanism, part);
            by_gap(&values, matrix.columns(), noise, &known, most)
        }
    };
    // Axes that nearly coincide are known by their directions, which lengths leave as they are.
    let apart = dimensions.noise(reach(&here));
    // What was accepted was accepted at a regular pose.
    let regular =
        known.known.is_some() || has_one_direction(&values, matrix.columns(), apart, &known);
    let metric = Metric::of(mechanism, &here, &scales);
    let asked = Asked {
        mechanism,
        part,
        metric: &metric,
        dimensions,
        geometry,
        length: here.length,
        reach: reach(&here),
    };
    let relations = Relations::of(mechanism, part, dimensions, geometry, here.length);
    let found = by_relations(&asked, states, &freedoms, &relations)?;
    if found.is_some() {
        return Ok(found);
    }
    by_dimensions(&asked, states, &known, (freedoms, regular)).map(Some)
}

/// The largest change, in what the digits of each number leave open.
fn units(nearest: &Nearest) -> f64 {
    nearest.z.iter().fold(0.0f64, |most, z| z.abs().max(most))
}

/// The nearest of so many freedoms that keeps some relations, what closes as it is written left out: that is not made to follow any.
fn sought(
    asked: &Asked<'_>,
    states: &[JointState<f64>],
    freedom: usize,
    relations: &Relations,
) -> Result<Option<Nearest>, MatrixError> {
    let mut search = asked.search(freedom, relations);
    if !relations.is_empty() && search.closes_as_written(states)? {
        return Ok(None);
    }
    search.nearest(states)
}

/// The nearest that keeps relations between the numbers, where one is within the digits.
fn by_relations(
    asked: &Asked<'_>,
    states: &[JointState<f64>],
    freedoms: &[usize],
    relations: &Relations,
) -> Result<Option<Found>, MatrixError> {
    if relations.is_empty() {
        return Ok(None);
    }
    for &freedom in freedoms.iter().take(TRIES) {
        let nearest = sought(asked, states, freedom, relations)?;
        if let Some(nearest) = nearest.filter(|nearest| units(nearest) <= WITHIN) {
            return Ok(Some(Found {
                nearest: Some((nearest, freedom)),
                length: asked.length,
                excluded: None,
                rigid: false,
                kept: relations.kept(),
            }));
        }
    }
    Ok(None)
}

/// The nearest, whatever relations it breaks; and how near none is, where that is known.
fn by_dimensions(
    asked: &Asked<'_>,
    states: &[JointState<f64>],
    known: &Freedoms,
    (freedoms, regular): (Vec<usize>, bool),
) -> Result<Found, MatrixError> {
    let none = Relations::default();
    let mut best: Option<(Nearest, usize)> = None;
    let decides = regular && (known.known.is_some() || freedoms == [1]);
    let mut excluded = decides.then_some(f64::INFINITY);
    for freedom in freedoms.into_iter().take(TRIES) {
        let least = asked.search(freedom, &none).least_change(states)?;
        excluded = excluded.map(|e| e.min(least)).filter(|e| *e > WITHIN);
        let Some(nearest) = sought(asked, states, freedom, &none)? else {
            continue;
        };
        let within = units(&nearest) <= WITHIN;
        let nearer = |(best, _): &(Nearest, usize)| units(&nearest) < units(best);
        if best.as_ref().is_none_or(nearer) {
            best = Some((nearest, freedom));
        }
        if within {
            excluded = None;
            break;
        }
    }
    let nearer = best.as_ref().is_some_and(|(best, _)| units(best) <= WITHIN);
    let mut rigid = false;
    if excluded.is_none() && !nearer && known.known.is_none() && known.literal == 0 {
        excluded = asked.holds_fast(states, known.possible)?;
        rigid = excluded.is_some();
    }
    if rigid && known.open_to.is_none() {
        // Its digits close it, though as they are its loops stay open by more than what is usual.
        let closed = asked.search(0, &none).nearest_at_one_pose(states)?;
        if let Some(closed) = closed.filter(|closed| units(closed) <= WITHIN) {
            best = Some((closed, 0));
        }
    }
    if let Some((beyond, freedom)) = &mut best
        && units(beyond) > WITHIN
    {
        asked.draw_near_in_metres(states, beyond, *freedom)?;
    }
    Ok(Found {
        nearest: best,
        length: asked.length,
        excluded: excluded.filter(|e| e.is_finite()),
        rigid,
        kept: Vec::new(),
    })
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
    let open = |freedom: &usize| {
        known.possible.is_some_and(|most| *freedom <= most)
            || value(columns - freedom) <= known.open_to.unwrap_or(1.0)
    };
    let mut freedoms: Vec<usize> = (known.literal.max(1)..=most.min(columns))
        .filter(|f| columns - f <= values.len() && open(f))
        .collect();
    freedoms.sort_by(|a, b| gap(*b).total_cmp(&gap(*a)));
    freedoms
}
