//! What inputs do to a mechanism: whether they are enough, which of them depend on others, which joints follow from which.
//!
//! # The problem
//! A robot has motors on some of its joints. On a branch of dimension d the rates of all joints are linear functions of d
//! numbers; each input is one such function, a row over the tangent space. The inputs are independent if their rows are, they are
//! enough if no tangent but idle ones (a rod spinning about its own line) lets all of them rest, and a joint follows from the
//! inputs whose rows its own row is made of.
//!
//! # What it promises
//! Everything is asked at generic poses of the branch, where ranks are largest; at a special pose (a dead centre) inputs can do
//! less. A row counts as dependent or independent only with the margins of [`Limits`]; the error of what is left of a row
//! after the others are taken out is that of a tangent times (1 + Σ |coefficients|). Where a margin is thin there is no answer.
//!
//! The joints proposed are the first independent ones in an order that a designer would ask in: no follower of a `mimic`, joints of one
//! freedom before others, no intermediate links of balls, tree joints before those that close loops, no end of a ram before others,
//! near the ground before far from it, cranks that go round before what turns back, rams before hinges, with limits before without, and
//! by name. The slider of a ram counts as at the ground wherever the ram is: it is there to be driven. Those that are independent at
//! the pose itself come before all others: nobody starts from a dead centre if there is a choice.
//!
//! Everything is asked part by part, or for several parts together where idle motion reaches across them.
//!
//! Cost: variables × d² for each pose, summed over the parts; for joints in no loop that is one each.

use super::branch::{Branch, BranchPose};
use super::idle::{IdleSpace, idle_spaces};
use super::one_sided::{OneSided, dot, norm};
use super::passive::{Rams, followers_of_mimics};
use super::point_chains::Connections;
use super::tangent_space::{Limits, TangentSpace};
use kutzbach_closure::Geometry;
use kutzbach_closure::Structure;
use kutzbach_model::mechanism::{Joint, Mechanism};
use std::collections::{BTreeMap, BTreeSet};

/// One freedom of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Freedom {
    /// Index of the joint.
    pub joint: usize,
    /// Index of the variable among the joint's own.
    pub variable: usize,
}

/// An input that others determine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DependentInput {
    /// The input.
    pub input: Freedom,
    /// The inputs that it follows from; empty where it cannot move at all. `None` where a margin does not tell which.
    pub on: Option<Vec<Freedom>>,
}

/// A freedom that is no input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Follower {
    /// The freedom.
    pub freedom: Freedom,
    /// The inputs, given or proposed, that its rate is made of; `None` where idle motion moves it too, or a margin does not tell.
    pub of: Option<Vec<Freedom>>,
}

/// What the inputs do along a branch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Actuation {
    /// The inputs that are independent, in the order given.
    pub independent: Vec<Freedom>,
    /// The others.
    pub dependent: Vec<DependentInput>,
    /// How many of the inputs are independent at the pose itself: fewer than [`independent`](Self::independent) where it is a
    /// dead centre of theirs. `None` where that is not known.
    pub independent_here: Option<usize>,
    /// Freedoms that are left when all inputs are held, idle ones not counted.
    pub left: usize,
    /// Freedoms that take the rest as further inputs: as many as [`left`](Self::left), or more where idle motion moves them too.
    pub proposed: Vec<Freedom>,
    /// How many of the independent inputs and those proposed are independent together at the pose itself; `None` where that is
    /// not known.
    pub together_here: Option<usize>,
    /// Whether nothing is left with these; they may not suffice where no choice has clear margins.
    pub complete: bool,
    /// The freedoms that are neither given nor proposed, by joint and variable.
    pub followers: Vec<Follower>,
}

/// More operations than this are not worth an answer.
const MOST_WORK: usize = 2_000_000_000;

/// A proposed input should have at least this share of its motion for itself, if one has.
const FAIR_SHARE: f64 = 0.1;

/// What the inputs do along a branch; `None` where its poses, or the margins, do not tell. `here` is the pose itself, if it is one
/// of the branch; `turning` are freedoms known to go round without dead centre, where the branch is a curve.
#[must_use]
pub fn actuation(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    branch: &Branch,
    here: Option<&BranchPose>,
    (given, turning): (&[Freedom], &BTreeSet<Freedom>),
) -> Option<Actuation> {
    let poses: Vec<Rows> = idle_spaces(mechanism, geometry, structure, branch)
        .into_iter()
        .map(Rows::of)
        .collect::<Option<_>>()?;
    // Ranks are largest at a generic pose; one that shows less, or nothing for certain, is not it.
    let (reference, chosen) = poses
        .iter()
        .filter_map(|rows| Some((rows, Chosen::of(rows, given)?)))
        .fold(None, |best: Option<(&Rows, Chosen)>, next| match best {
            Some(best) if best.1.independent.len() >= next.1.independent.len() => Some(best),
            _ => Some(next),
        })?;
    let left = reference.left(&chosen.spans)?;
    let taken: BTreeSet<Freedom> = given.iter().copied().collect();
    let asked = (&taken, turning);
    let candidates = candidates(mechanism, geometry, structure, reference, asked);
    let here = here
        .and_then(|here| TangentSpace::at(mechanism, geometry, structure, here))
        .and_then(|tangents| Rows::of(IdleSpace::without_idle(tangents)));
    let given_here = here.as_ref().and_then(|rows| Chosen::of(rows, given));
    let independent_here = given_here.as_ref().map(|chosen| chosen.independent.len());
    let mut at_pose = here.as_ref().zip(given_here).map(AtPose::of);
    let (proposed, complete) = complete(reference, &candidates, chosen.spans, at_pose.as_mut());
    let set: Vec<Freedom> = chosen
        .independent
        .iter()
        .chain(&proposed)
        .copied()
        .collect();
    // On what something depends is seen at all poses: a coefficient may pass through zero at one.
    let spans: Vec<(&Rows, Vec<Span>)> = poses
        .iter()
        .filter_map(|rows| {
            let chosen = Chosen::of(rows, &set)?;
            (chosen.independent == set).then_some((rows, chosen.spans))
        })
        .collect();
    let of = |freedom, count| {
        let on: Option<Vec<usize>> = support(&spans, freedom, count);
        on.map(|on| on.into_iter().map(|index| set[index]).collect())
    };
    let dependent = chosen
        .dependent
        .into_iter()
        .map(|input| DependentInput {
            input,
            on: of(input, chosen.independent.len()),
        })
        .collect();
    let inputs: BTreeSet<Freedom> = set.iter().chain(given).copied().collect();
    let followers = all_freedoms(mechanism)
        .filter(|freedom| !inputs.contains(freedom))
        .map(|freedom| Follower {
            freedom,
            of: of(freedom, set.len()),
        })
        .collect();
    Some(Actuation {
        independent_here,
        together_here: here
            .as_ref()
            .and_then(|rows| Some(Chosen::of(rows, &set)?.independent.len())),
        independent: chosen.independent,
        dependent,
        left,
        proposed,
        complete,
        followers,
    })
}

fn all_freedoms(mechanism: &Mechanism) -> impl Iterator<Item = Freedom> {
    let freedoms = mechanism.joints().iter().map(Joint::freedom);
    freedoms
        .enumerate()
        .flat_map(|(joint, count)| (0..count).map(move |variable| Freedom { joint, variable }))
}

/// The tangent space at one pose, seen by rows.
///
/// Its blocks have nothing to do with one another: a row is a row over one of them, and rows of different blocks are independent.
struct Rows {
    space: IdleSpace,
}

/// What a freedom is over the vectors of its block.
#[derive(Clone)]
struct Row {
    /// `None` if nothing moves the freedom.
    block: Option<usize>,
    values: Vec<f64>,
}

impl Rows {
    /// `None` where inputs would take too much work.
    fn of(space: IdleSpace) -> Option<Self> {
        let tangents = &space.tangents;
        let mut work = 0usize;
        for variable in 0..tangents.length() {
            if let Some(&vector) = tangents.row(variable).vectors.first() {
                let (block, _) = space.blocks.place[vector];
                let size = space.blocks.vectors[block].len();
                work = work.saturating_add(size.saturating_mul(size));
            }
        }
        (work <= MOST_WORK).then_some(Self { space })
    }

    fn row(&self, freedom: Freedom) -> Row {
        let variable = self.space.tangents.variables(freedom.joint).start + freedom.variable;
        let row = self.space.tangents.row(variable);
        let blocks = &self.space.blocks;
        let block = row.vectors.first().map(|&vector| blocks.place[vector].0);
        let mut values = vec![0.0; block.map_or(0, |block| blocks.vectors[block].len())];
        for (&vector, value) in row.vectors.iter().zip(row.values()) {
            values[blocks.place[vector].1] = value;
        }
        Row { block, values }
    }

    /// Bound on the error of a row.
    fn error(&self) -> f64 {
        self.space.tangents.limits.error
    }

    /// Limits for what is left of a row.
    fn limits(&self, error: f64) -> Limits {
        Limits::new(error, self.space.tangents.dimension())
    }

    /// Whether idle motion leaves a freedom at rest.
    fn is_clean(&self, row: &Row) -> bool {
        let idle = row
            .block
            .into_iter()
            .flat_map(|block| &self.space.idle[block]);
        let along: Vec<f64> = idle.map(|idle| dot(idle, &row.values)).collect();
        self.space.tangents.limits.moves(norm(&along)) == Some(false)
    }

    /// Freedoms of a block left when the rows of a span are held, idle ones not counted: dim ker A − dim (ker A ∩ I).
    fn left_in(&self, block: usize, span: &Span) -> Option<usize> {
        let idle = &self.space.idle[block];
        let on_idle: Vec<Vec<f64>> = idle
            .iter()
            .map(|idle| span.rows.iter().map(|row| dot(row, idle)).collect())
            .collect();
        let limits = &self.space.tangents.limits;
        let driven = limits.rank(&OneSided::of(on_idle)?.values)?;
        let kernel = self.space.blocks.vectors[block]
            .len()
            .checked_sub(span.rows.len())?;
        kernel.checked_sub(idle.len() - driven)
    }

    /// Freedoms left in all blocks.
    fn left(&self, spans: &[Span]) -> Option<usize> {
        let blocks = spans.iter().enumerate();
        blocks.map(|(block, span)| self.left_in(block, span)).sum()
    }
}

/// Independent rows of one block, with an orthonormal basis of their span and what it is made of.
#[derive(Clone, Default)]
struct Span {
    /// What each row is in the set that it was taken from.
    names: Vec<usize>,
    rows: Vec<Vec<f64>>,
    basis: Vec<Vec<f64>>,
    /// `basis[i] = Σ made_of[i][j] rows[j]`.
    made_of: Vec<Vec<f64>>,
}

/// A row against a span.
struct Remainder {
    /// What is left of it.
    rest: Vec<f64>,
    /// `row = rest + Σ coefficients[j] rows[j]`.
    coefficients: Vec<f64>,
    /// Bound on the error of the rest.
    error: f64,
}

impl Span {
    fn remainder(&self, row: &[f64], error: f64) -> Remainder {
        let mut rest = row.to_vec();
        let mut coefficients = vec![0.0; self.rows.len()];
        // Twice is enough (Giraud, Langou & Rozložník 2005).
        for _ in 0..2 {
            for (q, made_of) in self.basis.iter().zip(&self.made_of) {
                let along = dot(q, &rest);
                rest.iter_mut().zip(q).for_each(|(x, y)| *x -= along * y);
                for (c, w) in coefficients.iter_mut().zip(made_of) {
                    *c += along * w;
                }
            }
        }
        let sum: f64 = coefficients.iter().map(|c| c.abs()).sum();
        Remainder {
            rest,
            coefficients,
            error: error * (1.0 + sum),
        }
    }

    fn push(&mut self, name: usize, row: Vec<f64>, remainder: Remainder) {
        let size = norm(&remainder.rest);
        let mut made_of: Vec<f64> = remainder.coefficients.iter().map(|c| -c / size).collect();
        made_of.push(1.0 / size);
        self.made_of.iter_mut().for_each(|w| w.push(0.0));
        self.basis
            .push(remainder.rest.iter().map(|x| x / size).collect());
        self.made_of.push(made_of);
        self.rows.push(row);
        self.names.push(name);
    }

    /// Takes the last row back.
    fn pop(&mut self) {
        self.rows.pop();
        self.names.pop();
        self.basis.pop();
        self.made_of.pop();
        self.made_of
            .iter_mut()
            .for_each(|w| w.truncate(self.rows.len()));
    }

    /// Bound on the error of the j-th coefficient of something known to within `error`.
    fn coefficient_error(&self, j: usize, error: f64) -> f64 {
        let column: Vec<f64> = self.made_of.iter().map(|w| w[j]).collect();
        error * norm(&column)
    }
}

/// The independent ones among some freedoms.
struct Chosen {
    /// One for every block; rows are named by their places in `independent`.
    spans: Vec<Span>,
    independent: Vec<Freedom>,
    dependent: Vec<Freedom>,
}

impl Chosen {
    /// `None` where a margin is thin.
    fn of(rows: &Rows, given: &[Freedom]) -> Option<Self> {
        let mut chosen = Self {
            spans: vec![Span::default(); rows.space.blocks.vectors.len()],
            independent: Vec::new(),
            dependent: Vec::new(),
        };
        for &freedom in given {
            let row = rows.row(freedom);
            let Some(span) = row.block.map(|block| &mut chosen.spans[block]) else {
                chosen.dependent.push(freedom);
                continue;
            };
            let remainder = span.remainder(&row.values, rows.error());
            if rows.limits(remainder.error).moves(norm(&remainder.rest))? {
                span.push(chosen.independent.len(), row.values, remainder);
                chosen.independent.push(freedom);
            } else {
                chosen.dependent.push(freedom);
            }
        }
        Some(chosen)
    }
}

/// What the inputs taken so far span at the pose itself.
struct AtPose<'r> {
    rows: &'r Rows,
    spans: Vec<Span>,
}

impl<'r> AtPose<'r> {
    fn of((rows, chosen): (&'r Rows, Chosen)) -> Self {
        Self {
            rows,
            spans: chosen.spans,
        }
    }

    /// The row of a freedom with what is left of it after the inputs taken, and its block; `None` where that is not clearly
    /// something.
    fn own(&self, freedom: Freedom) -> Option<(usize, Row, Remainder)> {
        let row = self.rows.row(freedom);
        let block = row.block?;
        let remainder = self.spans[block].remainder(&row.values, self.rows.error());
        let limits = self.rows.limits(remainder.error);
        (limits.moves(norm(&remainder.rest)) == Some(true)).then_some((block, row, remainder))
    }

    /// Whether a freedom moves by itself here when the inputs taken are held.
    fn is_independent(&self, freedom: Freedom) -> bool {
        self.own(freedom).is_some()
    }

    /// Takes an input.
    fn take(&mut self, freedom: Freedom) {
        if let Some((block, row, remainder)) = self.own(freedom) {
            let name = self.spans[block].rows.len();
            self.spans[block].push(name, row.values, remainder);
        }
    }
}

/// The freedoms that could be inputs, best first, but for those taken already and those of joints that the file calls dependent.
fn candidates(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    rows: &Rows,
    (taken, turning): (&BTreeSet<Freedom>, &BTreeSet<Freedom>),
) -> Vec<(Freedom, Row)> {
    let connections = Connections::of(mechanism, geometry, structure);
    let steps = connections.bodies.steps_from_ground(mechanism);
    let rams = Rams::of(mechanism, &connections.bodies);
    let followers = followers_of_mimics(mechanism);
    let mut found: Vec<_> = Vec::new();
    for (index, joint) in mechanism.joints().iter().enumerate() {
        let ends = [joint.predecessor.link.0, joint.successor.link.0]
            .map(|link| connections.bodies.of[link]);
        let slides = rams.sliders.contains(&index);
        let depth = match slides {
            true => 1,
            false => steps[ends[0]].max(steps[ends[1]]),
        };
        let limited = joint
            .limit
            .as_ref()
            .is_some_and(|limit| limit.lower.is_some() && limit.upper.is_some());
        if joint.independent == Some(false) {
            continue;
        }
        for variable in 0..joint.freedom() {
            let freedom = Freedom {
                joint: index,
                variable,
            };
            if taken.contains(&freedom) {
                continue;
            }
            let row = rows.row(freedom);
            let key = (
                (!rows.is_clean(&row), followers.contains(&index)),
                joint.freedom() != 1,
                ends.iter().any(|&body| connections.intermediate[body]),
                joint.closes_loop,
                rams.ends.contains(&index),
                depth,
                (!turning.contains(&freedom), !slides),
                !limited,
                structure.graph.edge_rank(index),
                variable,
            );
            found.push((key, freedom, row));
        }
    }
    found.sort_by_key(|(key, ..)| *key);
    found
        .into_iter()
        .map(|(_, freedom, row)| (freedom, row))
        .collect()
}

/// The candidates that have to be added until nothing is left, and whether nothing is left then.
fn complete(
    rows: &Rows,
    candidates: &[(Freedom, Row)],
    spans: Vec<Span>,
    mut at_pose: Option<&mut AtPose<'_>>,
) -> (Vec<Freedom>, bool) {
    let mut of_blocks = vec![Vec::new(); spans.len()];
    for (index, (freedom, row)) in candidates.iter().enumerate() {
        if let Some(block) = row.block {
            of_blocks[block].push(Candidate {
                index,
                freedom: *freedom,
                row: &row.values,
            });
        }
    }
    let mut proposed = Vec::new();
    let mut enough = true;
    for (block, (mut span, own)) in spans.into_iter().zip(of_blocks).enumerate() {
        let (found, complete) =
            complete_block(rows, block, &own, &mut span, at_pose.as_deref_mut());
        proposed.extend(found);
        enough &= complete;
    }
    proposed.sort_unstable();
    let freedoms = proposed.into_iter().map(|(_, index)| candidates[index].0);
    (freedoms.collect(), enough)
}

/// A freedom of a block that could be an input.
#[derive(Clone, Copy)]
struct Candidate<'c> {
    /// Its place among all candidates.
    index: usize,
    freedom: Freedom,
    row: &'c [f64],
}

/// Which candidates a round takes.
struct Round {
    /// The share of its motion that an input should have for itself.
    share: f64,
    /// Only those that are independent at the pose itself.
    at_pose: bool,
    /// Also those that idle motion moves.
    with_idle: bool,
}

/// The rounds, from what is wanted to what will do.
const ROUNDS: [Round; 5] = [
    round(FAIR_SHARE, true, false),
    round(0.0, true, false),
    round(FAIR_SHARE, false, false),
    round(0.0, false, false),
    round(0.0, false, true),
];

const fn round(share: f64, at_pose: bool, with_idle: bool) -> Round {
    Round {
        share,
        at_pose,
        with_idle,
    }
}

/// Adds candidates of a block to its span until nothing is left; the indices of those added, each after the number of the round that
/// it was found in, and whether nothing is left then.
///
/// Candidates that idle motion leaves at rest come first, and each takes one freedom away. Where these are not enough, as in a leg
/// that hangs on balls, others have to be driven together with the idle motion that moves them too: all independent
/// ones are taken, and those given back that were not needed.
fn complete_block(
    rows: &Rows,
    block: usize,
    candidates: &[Candidate<'_>],
    span: &mut Span,
    mut at_pose: Option<&mut AtPose<'_>>,
) -> (Vec<(usize, usize)>, bool) {
    let mut proposed: Vec<(usize, usize)> = Vec::new();
    let mut taken = vec![false; candidates.len()];
    let driven = span.rows.len();
    let wanted = rows.left_in(block, span);
    for (number, round) in ROUNDS.iter().enumerate() {
        if round.at_pose && at_pose.is_none() {
            continue;
        }
        for (candidate, taken) in candidates.iter().zip(&mut taken) {
            let Some(left) = rows.left_in(block, span).filter(|left| *left > 0) else {
                break;
            };
            let Candidate { index, row, .. } = *candidate;
            let here = at_pose.as_deref().filter(|_| round.at_pose);
            if *taken || here.is_some_and(|here| !here.is_independent(candidate.freedom)) {
                continue;
            }
            let remainder = span.remainder(row, rows.error());
            let size = norm(&remainder.rest);
            if rows.limits(remainder.error).moves(size) != Some(true)
                || size < round.share * norm(row)
            {
                continue;
            }
            span.push(index, row.to_vec(), remainder);
            if round.with_idle || rows.left_in(block, span) == left.checked_sub(1) {
                proposed.push((number, index));
                *taken = true;
                if let Some(here) = at_pose.as_deref_mut() {
                    here.take(candidate.freedom);
                }
            } else {
                span.pop();
            }
        }
    }
    let enough = rows.left_in(block, span) == Some(0);
    // A row takes one freedom away at most: where no more were taken than were left, none can be spared.
    let least = wanted.filter(|_| enough).unwrap_or(usize::MAX);
    let mut index = 0;
    while proposed.len() > least && index < proposed.len() {
        let mut less = Span::default();
        for (place, (name, row)) in span.names.iter().zip(&span.rows).enumerate() {
            if place != driven + index {
                let remainder = less.remainder(row, rows.error());
                less.push(*name, row.clone(), remainder);
            }
        }
        if rows.left_in(block, &less) == Some(0) {
            proposed.remove(index);
            *span = less;
        } else {
            index += 1;
        }
    }
    (proposed, enough)
}

/// Which of the first `count` freedoms of a set a freedom's row is made of; `None` where it is not made of them, or a margin
/// does not tell.
fn support(spans: &[(&Rows, Vec<Span>)], freedom: Freedom, count: usize) -> Option<Vec<usize>> {
    let mut seen: BTreeMap<usize, Option<bool>> = BTreeMap::new();
    if spans.is_empty() {
        return None;
    }
    for (rows, spans) in spans {
        let row = rows.row(freedom);
        let Some(span) = row.block.map(|block| &spans[block]) else {
            continue;
        };
        let remainder = span.remainder(&row.values, rows.error());
        if rows.limits(remainder.error).moves(norm(&remainder.rest)) != Some(false) {
            return None;
        }
        for (j, name) in span
            .names
            .iter()
            .enumerate()
            .filter(|(_, name)| **name < count)
        {
            let error = span.coefficient_error(j, remainder.error);
            let seen = seen.entry(*name).or_insert(Some(false));
            match Limits::new(error, 1).moves(remainder.coefficients[j].abs()) {
                Some(true) => *seen = Some(true),
                None if *seen == Some(false) => *seen = None,
                _ => {}
            }
        }
    }
    let on = seen.into_iter().filter(|(_, on)| *on != Some(false));
    on.map(|(index, on)| on.map(|_| index)).collect()
}
