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
//! The joints proposed are the first independent ones in an order that a designer would ask in: joints of one freedom before others,
//! no intermediate links of balls, tree joints before those that close loops, near the ground before far from it, with limits
//! before without, and by name.
//!
//! Cost: variables × d² for each pose.

use super::branch::{Branch, BranchPose};
use super::idle::idle_spaces;
use super::one_sided::{OneSided, dot, norm};
use super::point_chains::Connections;
use super::tangent_space::{Limits, TangentSpace};
use kutzbach_closure::Geometry;
use kutzbach_closure::Structure;
use kutzbach_model::mechanism::Mechanism;

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
/// of the branch.
#[must_use]
pub fn actuation(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    branch: &Branch,
    here: Option<&BranchPose>,
    given: &[Freedom],
) -> Option<Actuation> {
    let work = mechanism.freedom() * branch.dimension * branch.dimension;
    if work > MOST_WORK {
        return None;
    }
    let poses: Vec<Rows> = idle_spaces(mechanism, geometry, structure, &branch.poses)
        .into_iter()
        .map(|(tangents, idle)| Rows { tangents, idle })
        .collect();
    // Ranks are largest at a generic pose; one that shows less, or nothing for certain, is not it.
    let (reference, chosen) = poses
        .iter()
        .filter_map(|rows| Some((rows, Chosen::of(rows, given)?)))
        .fold(None, |best: Option<(&Rows, Chosen)>, next| match best {
            Some(best) if best.1.span.len() >= next.1.span.len() => Some(best),
            _ => Some(next),
        })?;
    let left = reference.left(&chosen.span)?;
    let mut span = chosen.span;
    let candidates = candidates(mechanism, geometry, structure, reference);
    let (proposed, complete) = complete(reference, &candidates, &mut span, given);
    let set: Vec<Freedom> = chosen
        .independent
        .iter()
        .chain(&proposed)
        .copied()
        .collect();
    // On what something depends is seen at all poses: a coefficient may pass through zero at one.
    let spans: Vec<(&Rows, Span)> = poses
        .iter()
        .filter_map(|rows| {
            let chosen = Chosen::of(rows, &set)?;
            (chosen.independent == set).then_some((rows, chosen.span))
        })
        .collect();
    let dependent = chosen
        .dependent
        .into_iter()
        .map(|input| DependentInput {
            input,
            on: support(&spans, input, chosen.independent.len())
                .map(|on| on.into_iter().map(|index| set[index]).collect()),
        })
        .collect();
    let followers = (0..mechanism.joints().len())
        .flat_map(|joint| {
            let variables = 0..mechanism.joints()[joint].freedom();
            variables.map(move |variable| Freedom { joint, variable })
        })
        .filter(|freedom| !set.contains(freedom) && !given.contains(freedom))
        .map(|freedom| Follower {
            freedom,
            of: support(&spans, freedom, set.len())
                .map(|on| on.into_iter().map(|index| set[index]).collect()),
        })
        .collect();
    Some(Actuation {
        independent_here: here
            .and_then(|here| TangentSpace::at(mechanism, geometry, structure, here))
            .and_then(|tangents| {
                let rows = Rows {
                    tangents,
                    idle: Vec::new(),
                };
                Some(Chosen::of(&rows, given)?.independent.len())
            }),
        independent: chosen.independent,
        dependent,
        left,
        proposed,
        complete,
        followers,
    })
}

/// The tangent space at one pose, seen by rows.
struct Rows {
    tangents: TangentSpace,
    /// Orthonormal combinations of the tangents that are idle.
    idle: Vec<Vec<f64>>,
}

impl Rows {
    fn row(&self, freedom: Freedom) -> Vec<f64> {
        let variable = self.tangents.variables(freedom.joint).start + freedom.variable;
        self.tangents
            .basis
            .iter()
            .map(|vector| vector[variable])
            .collect()
    }

    /// Whether idle motion leaves a freedom at rest.
    fn is_clean(&self, row: &[f64]) -> bool {
        let along: Vec<f64> = self.idle.iter().map(|idle| dot(idle, row)).collect();
        self.tangents.limits.moves(norm(&along)) == Some(false)
    }

    /// Freedoms left when the rows of a span are held, idle ones not counted: dim ker A − dim (ker A ∩ I).
    fn left(&self, span: &Span) -> Option<usize> {
        let on_idle: Vec<Vec<f64>> = self
            .idle
            .iter()
            .map(|idle| span.rows.iter().map(|row| dot(row, idle)).collect())
            .collect();
        let driven = self.tangents.limits.rank(&OneSided::of(on_idle)?.values)?;
        let kernel = self.tangents.basis.len().checked_sub(span.len())?;
        kernel.checked_sub(self.idle.len() - driven)
    }
}

/// Independent rows, with an orthonormal basis of their span and what it is made of.
#[derive(Default)]
struct Span {
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
    fn len(&self) -> usize {
        self.rows.len()
    }

    fn remainder(&self, row: &[f64], error: f64) -> Remainder {
        let mut rest = row.to_vec();
        let mut coefficients = vec![0.0; self.len()];
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

    fn push(&mut self, row: Vec<f64>, remainder: Remainder) {
        let size = norm(&remainder.rest);
        let mut made_of: Vec<f64> = remainder.coefficients.iter().map(|c| -c / size).collect();
        made_of.push(1.0 / size);
        self.made_of.iter_mut().for_each(|w| w.push(0.0));
        self.basis
            .push(remainder.rest.iter().map(|x| x / size).collect());
        self.made_of.push(made_of);
        self.rows.push(row);
    }

    /// Takes the last row back.
    fn pop(&mut self) {
        self.rows.pop();
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
    span: Span,
    independent: Vec<Freedom>,
    dependent: Vec<Freedom>,
}

impl Chosen {
    /// `None` where a margin is thin.
    fn of(rows: &Rows, given: &[Freedom]) -> Option<Self> {
        let mut chosen = Self {
            span: Span::default(),
            independent: Vec::new(),
            dependent: Vec::new(),
        };
        for &freedom in given {
            let row = rows.row(freedom);
            let remainder = chosen.span.remainder(&row, rows.tangents.limits.error);
            let limits = Limits::new(remainder.error, rows.tangents.basis.len());
            if limits.moves(norm(&remainder.rest))? {
                chosen.span.push(row, remainder);
                chosen.independent.push(freedom);
            } else {
                chosen.dependent.push(freedom);
            }
        }
        Some(chosen)
    }
}

/// The freedoms that could be inputs, best first.
fn candidates(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    rows: &Rows,
) -> Vec<(Freedom, Vec<f64>)> {
    let connections = Connections::of(mechanism, geometry, structure);
    let steps = connections.bodies.steps_from_ground(mechanism);
    let mut found: Vec<_> = Vec::new();
    for (index, joint) in mechanism.joints().iter().enumerate() {
        let ends = [joint.predecessor.link.0, joint.successor.link.0]
            .map(|link| connections.bodies.of[link]);
        let depth = ends.map(|body| steps[body]);
        let limited = joint
            .limit
            .as_ref()
            .is_some_and(|limit| limit.lower.is_some() && limit.upper.is_some());
        for variable in 0..joint.freedom() {
            let freedom = Freedom {
                joint: index,
                variable,
            };
            let row = rows.row(freedom);
            let key = (
                !rows.is_clean(&row),
                joint.freedom() != 1,
                ends.iter().any(|&body| connections.intermediate[body]),
                joint.closes_loop,
                depth[0].max(depth[1]),
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

/// Adds candidates to a span until nothing is left; those added, and whether nothing is left then.
///
/// Candidates that idle motion leaves at rest come first, and each takes one freedom away. Where these are not enough, as in a leg
/// that hangs on balls, others have to be driven together with the idle motion that moves them too: all independent
/// ones are taken, and those given back that were not needed.
fn complete(
    rows: &Rows,
    candidates: &[(Freedom, Vec<f64>)],
    span: &mut Span,
    given: &[Freedom],
) -> (Vec<Freedom>, bool) {
    let mut proposed: Vec<(Freedom, Vec<f64>)> = Vec::new();
    let wanted = rows.left(span);
    for (share, with_idle) in [(FAIR_SHARE, false), (0.0, false), (0.0, true)] {
        for (freedom, row) in candidates {
            let Some(left) = rows.left(span).filter(|left| *left > 0) else {
                break;
            };
            if given.contains(freedom) || proposed.iter().any(|(taken, _)| taken == freedom) {
                continue;
            }
            let remainder = span.remainder(row, rows.tangents.limits.error);
            let size = norm(&remainder.rest);
            let limits = Limits::new(remainder.error, rows.tangents.basis.len());
            if limits.moves(size) != Some(true) || size < share * norm(row) {
                continue;
            }
            span.push(row.clone(), remainder);
            if with_idle || rows.left(span) == left.checked_sub(1) {
                proposed.push((*freedom, row.clone()));
            } else {
                span.pop();
            }
        }
    }
    let enough = rows.left(span) == Some(0);
    let driven = span.rows.len() - proposed.len();
    // A row takes one freedom away at most: where no more were taken than were left, none can be spared.
    let least = wanted.filter(|_| enough).unwrap_or(usize::MAX);
    let mut index = 0;
    while proposed.len() > least && index < proposed.len() {
        let mut less = Span::default();
        let others = proposed
            .iter()
            .enumerate()
            .filter(|(other, _)| *other != index);
        let others = others.map(|(_, (_, row))| row);
        for row in span.rows[..driven].iter().chain(others) {
            let remainder = less.remainder(row, rows.tangents.limits.error);
            less.push(row.clone(), remainder);
        }
        if rows.left(&less) == Some(0) {
            proposed.remove(index);
            *span = less;
        } else {
            index += 1;
        }
    }
    (
        proposed.into_iter().map(|(freedom, _)| freedom).collect(),
        enough,
    )
}

/// Which of the first `count` rows of the spans a freedom's row is made of; `None` where it is not made of them, or a margin
/// does not tell.
fn support(spans: &[(&Rows, Span)], freedom: Freedom, count: usize) -> Option<Vec<usize>> {
    let mut seen = vec![Some(false); count];
    if spans.is_empty() {
        return None;
    }
    for (rows, span) in spans {
        let remainder = span.remainder(&rows.row(freedom), rows.tangents.limits.error);
        let limits = Limits::new(remainder.error, rows.tangents.basis.len());
        if limits.moves(norm(&remainder.rest)) != Some(false) {
            return None;
        }
        for (j, seen) in seen.iter_mut().enumerate() {
            let error = span.coefficient_error(j, remainder.error);
            match Limits::new(error, 1).moves(remainder.coefficients[j].abs()) {
                Some(true) => *seen = Some(true),
                None if *seen == Some(false) => *seen = None,
                _ => {}
            }
        }
    }
    let all: Option<Vec<bool>> = seen.into_iter().collect();
    Some(
        (0..count)
            .zip(all?)
            .filter(|(_, on)| *on)
            .map(|(index, _)| index)
            .collect(),
    )
}
