//! All moves carried out for one choice of places.

use super::plan::{Move, Plan};
use super::shape::{Measure, Motion, Shape, measure, turned};
use super::third::{Outcome, Third, third};
use crate::sketch::Sketch;

/// Where the elements of every edge are in a frame of its own.
pub(super) fn of_edges(sketch: &Sketch) -> Vec<Vec<Shape>> {
    let line = |direction| Shape::Line {
        direction,
        offset: 0.0,
    };
    let along_x = line([1.0, 0.0]);
    let elements = sketch.elements();
    let of = |c: &crate::sketch::Constraint| {
        let value = c.value.value();
        let is_line = c.ends.map(|e| Shape::drawn(&elements[e]).is_line());
        match is_line {
            [false, false] => vec![Shape::Point([0.0; 2]), Shape::Point([value, 0.0])],
            [false, true] => vec![Shape::Point([0.0, value]), along_x],
            [true, false] => vec![along_x, Shape::Point([0.0, value])],
            [true, true] => {
                let (cos, sin) = c.value.cos_sin();
                vec![along_x, line([cos.value(), sin.value()])]
            }
        }
    };
    sketch.constraints().iter().map(of).collect()
}

/// What came of the moves.
pub(super) struct Carried {
    /// How every move turned out.
    pub(super) outcomes: Vec<Outcome>,
    /// Where the elements are, in the plan's order.
    pub(super) shapes: Vec<Shape>,
}

/// Carries out all moves; `left` says for each which of two places. Where there is none, the nearest thing to one stands in.
pub(super) fn carry_out(
    plan: &Plan,
    mut frames: Vec<Vec<Shape>>,
    left: impl Fn(usize) -> bool,
) -> Carried {
    let mut extents: Vec<f64> = frames.iter().map(|f| extent(f)).collect();
    let mut outcomes = Vec::with_capacity(plan.moves.len());
    for (i, step) in plan.moves.iter().enumerate() {
        outcomes.push(carry(step, &mut frames, &mut extents, left(i)));
    }
    Carried {
        outcomes,
        shapes: std::mem::take(&mut frames[plan.root]),
    }
}

/// What comes of the moves where all elements stay where they are.
pub(super) fn as_it_is(plan: &Plan, drawn: &[Shape]) -> Carried {
    let extent = extent(drawn);
    let outcome = |step: &Move| {
        let [x, y, z] = step.shared.map(|e| &drawn[e]);
        let (_, outcome) = third(&Third {
            line: y.is_line(),
            placed: [x, z],
            measures: [measure(x, y), measure(z, y)],
            extent,
            only_tied: false,
            left: true,
        });
        outcome
    };
    Carried {
        outcomes: plan.moves.iter().map(outcome).collect(),
        shapes: plan.order.iter().map(|&e| drawn[e]).collect(),
    }
}

fn extent(shapes: &[Shape]) -> f64 {
    shapes.iter().fold(0.0, |m, s| s.extent().max(m))
}

fn carry(step: &Move, frames: &mut [Vec<Shape>], extents: &mut [f64], left: bool) -> Outcome {
    let [stays, second, last] = step.places;
    let gone = [second, last].map(|p| std::mem::take(&mut frames[p]));
    let kept = &mut frames[stays];
    let only_tied = kept.len() == 2;
    let [x, z] = step.stay.map(|i| kept[i]);
    let [x2, y2] = step.second.map(|i| gone[0][i]);
    let [y3, z3] = step.last.map(|i| gone[1][i]);
    let extent_of_all = step.places.iter().fold(0.0_f64, |m, &p| m.max(extents[p]));
    let (placed, mut outcome) = third(&Third {
        line: y2.is_line(),
        placed: [&x, &z],
        // Turns count from the placed line to the new one.
        measures: [measure(&x2, &y2), measure(&z3, &y3)],
        extent: extent_of_all,
        only_tied,
        left,
    });
    let y = placed.unwrap_or(y2);
    let motions = [
        Motion::onto([&x2, &y2], [&x, &y]),
        Motion::onto([&y3, &z3], [&y, &z]),
    ];
    let skipped = [step.second, step.last];
    let mut farthest = extents[stays].max(y.extent());
    kept.push(y);
    for ((shapes, motion), skip) in gone.into_iter().zip(motions).zip(skipped) {
        if motion.is_none() && shapes.len() > 2 && outcome.is_possible() {
            outcome = Outcome::Degenerate;
        }
        for (i, shape) in shapes.into_iter().enumerate() {
            if !skip.contains(&i) {
                let shape = motion.map_or(shape, |m| m.of(&shape));
                farthest = farthest.max(shape.extent());
                kept.push(shape);
            }
        }
    }
    extents[stays] = farthest;
    outcome
}

/// Turns and shifts everything to the drawing: points by least squares about their centres, of lines the directions where there
/// are fewer than two points.
pub(crate) fn as_drawn(shapes: &mut [Shape], drawn: &[Shape]) {
    let points: Vec<([f64; 2], [f64; 2])> = shapes
        .iter()
        .zip(drawn)
        .filter_map(|(s, d)| match (s, d) {
            (Shape::Point(p), Shape::Point(q)) => Some((*p, *q)),
            _ => None,
        })
        .collect();
    let count = points.len().max(1) as f64;
    let mut centres = [[0.0; 2]; 2];
    for (p, q) in &points {
        for k in 0..2 {
            centres[0][k] += p[k] / count;
            centres[1][k] += q[k] / count;
        }
    }
    let mut turn = [0.0; 2];
    let mut add = |a: [f64; 2], b: [f64; 2]| {
        turn[0] += a[0] * b[0] + a[1] * b[1];
        turn[1] += a[0] * b[1] - a[1] * b[0];
    };
    for (p, q) in &points {
        let off = |a: &[f64; 2], c: [f64; 2]| [a[0] - c[0], a[1] - c[1]];
        add(off(p, centres[0]), off(q, centres[1]));
    }
    if points.len() < 2 {
        for (s, d) in shapes.iter().zip(drawn) {
            if let (Shape::Line { direction: a, .. }, Shape::Line { direction: b, .. }) = (s, d) {
                add(*a, *b);
            }
        }
    }
    let length = turn[0].hypot(turn[1]);
    let turn = match length > 0.0 {
        true => turn.map(|x| x / length),
        false => [1.0, 0.0],
    };
    let moved = turned(centres[0], turn);
    let shift = [centres[1][0] - moved[0], centres[1][1] - moved[1]];
    let motion = Motion::by(turn, shift);
    shapes.iter_mut().for_each(|s| *s = motion.of(s));
}

/// The value of a constraint between two shapes, an angle in radians.
pub(super) fn value_between(one: &Shape, other: &Shape) -> f64 {
    match measure(one, other) {
        Measure::Length(x) | Measure::Offset(x) => x,
        Measure::Turn([c, s]) => s.atan2(c),
    }
}
