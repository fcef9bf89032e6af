//! One step: an element by what it has to do with two others that are placed.

use super::shape::{Measure, Shape, along, cross, dot, left, minus, turned};

/// How a step turned out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// Two places: `by` is how far the circles, or the circle and the line, overlap, in units of length.
    Two {
        /// Above zero.
        by: f64,
    },
    /// They touch: both places are one, a double solution, as far as rounding can tell or (`proven`) exactly.
    Touching {
        /// Whether exact arithmetic has shown it.
        proven: bool,
    },
    /// One place: two lines.
    One,
    /// They do not meet: `by` is how far they stay apart, in units of length.
    Apart {
        /// Above zero.
        by: f64,
    },
    /// The two that are placed coincide or are parallel, or three lines are tied by angles alone: nothing fixes the third.
    Degenerate,
}

impl Outcome {
    /// Whether there is a place.
    #[must_use]
    pub const fn is_possible(&self) -> bool {
        !matches!(self, Self::Apart { .. } | Self::Degenerate)
    }
}

/// A margin, and by how much rounding may have changed it.
pub(super) struct Margin {
    pub(super) value: f64,
    pub(super) error: f64,
}

impl Margin {
    fn outcome(&self) -> Outcome {
        if self.value > self.error {
            Outcome::Two { by: self.value }
        } else if self.value < -self.error {
            Outcome::Apart { by: -self.value }
        } else {
            Outcome::Touching { proven: false }
        }
    }
}

/// What a step has to do: an element of a kind, by its measures from two that are placed.
pub(super) struct Third<'a> {
    pub(super) line: bool,
    pub(super) placed: [&'a Shape; 2],
    pub(super) measures: [Measure; 2],
    /// The largest coordinate of the clusters that take part.
    pub(super) extent: f64,
    /// Which of two places.
    pub(super) left: bool,
}

/// The place, and how it came about. Where there is none, the place is the nearest thing to one, so that other steps can
/// be looked at; `None` where not even that exists.
pub(super) fn third(step: &Third<'_>) -> (Option<Shape>, Outcome) {
    use Measure::{Length, Offset, Turn};
    let found = match (step.line, step.placed.map(|s| *s), &step.measures) {
        (false, [Shape::Point(p), Shape::Point(q)], [Length(r), Length(s)]) => {
            two_circles(step, [p, q], [*r, *s])
        }
        (false, [Shape::Point(p), line @ Shape::Line { .. }], [Length(r), Offset(h)])
        | (false, [line @ Shape::Line { .. }, Shape::Point(p)], [Offset(h), Length(r)]) => {
            circle_and_line(step, p, *r, (line, *h))
        }
        (false, [one, other], [Offset(h), Offset(k)]) => {
            let [a, b] = [(one, *h), (other, *k)].map(|(line, by)| beside(&line, by));
            super::shape::crossing(&a, &b).map(|p| (Shape::Point(p), Outcome::One))
        }
        (true, [Shape::Point(p), Shape::Point(q)], [Offset(h), Offset(k)]) => {
            common_tangent(step, [p, q], [*h, *k])
        }
        // A turn counts from the placed line.
        (true, [Shape::Point(p), Shape::Line { direction, .. }], [Offset(h), Turn(t)])
        | (true, [Shape::Line { direction, .. }, Shape::Point(p)], [Turn(t), Offset(h)]) => {
            Some((line_by(turned(direction, *t), p, *h), Outcome::One))
        }
        _ => None,
    };
    match found {
        None => (None, Outcome::Degenerate),
        Some((shape, outcome)) => (Some(shape), outcome),
    }
}

/// The line parallel to this one at which points lie that are so far to its left.
fn beside(line: &Shape, by: f64) -> Shape {
    match *line {
        Shape::Line { direction, offset } => Shape::Line {
            direction,
            offset: offset + by,
        },
        point @ Shape::Point(_) => point,
    }
}

/// The line in this direction that has `p` so far to its left.
fn line_by(direction: [f64; 2], p: [f64; 2], by: f64) -> Shape {
    Shape::Line {
        direction,
        offset: dot(left(direction), p) - by,
    }
}

/// Coordinates were rounded in a few operations of size `extent` by each of the clusters that they went through; 32 units in
/// the last place of it hold what changes a difference of lengths.
fn rounding(extent: f64, lengths: &[f64]) -> f64 {
    let largest = lengths.iter().fold(extent, |m, l| m.max(l.abs()));
    32.0 * f64::EPSILON * largest
}

fn two_circles(
    step: &Third<'_>,
    [p, q]: [[f64; 2]; 2],
    [r, s]: [f64; 2],
) -> Option<(Shape, Outcome)> {
    let across = minus(q, p);
    let d = across[0].hypot(across[1]);
    let error = rounding(step.extent, &[r, s, d]);
    if d <= error {
        return None;
    }
    let value = (r + s - d).min(d - (r - s).abs());
    let outcome = Margin { value, error }.outcome();
    let unit = across.map(|x| x / d);
    let foot = (d + (r - s) * (r + s) / d) / 2.0;
    let height = match outcome {
        // Heron's formula by its factors, which lose no digits where the triangle is flat.
        Outcome::Two { .. } => {
            ((r + s - d) * (r + s + d) * (d - r + s) * (d + r - s)).sqrt() / (2.0 * d)
        }
        _ => 0.0,
    };
    let height = if step.left { height } else { -height };
    let place = along(along(p, unit, foot), left(unit), height);
    Some((Shape::Point(place), outcome))
}

fn circle_and_line(
    step: &Third<'_>,
    p: [f64; 2],
    r: f64,
    (line, by): (Shape, f64),
) -> Option<(Shape, Outcome)> {
    let Shape::Line { direction, offset } = line else {
        return None;
    };
    let height = dot(left(direction), p) - offset - by;
    let error = rounding(step.extent, &[r, by]);
    let value = r - height.abs();
    let outcome = Margin { value, error }.outcome();
    let half = match outcome {
        Outcome::Two { .. } => (value * (r + height.abs())).sqrt(),
        _ => 0.0,
    };
    let half = if step.left { half } else { -half };
    let foot = along(p, left(direction), -height);
    Some((Shape::Point(along(foot, direction, half)), outcome))
}

fn common_tangent(
    step: &Third<'_>,
    [p, q]: [[f64; 2]; 2],
    [h, k]: [f64; 2],
) -> Option<(Shape, Outcome)> {
    let across = minus(q, p);
    let d = across[0].hypot(across[1]);
    let error = rounding(step.extent, &[h, k, d]);
    if d <= error {
        return None;
    }
    let rise = k - h;
    let value = d - rise.abs();
    let outcome = Margin { value, error }.outcome();
    let cosine = (rise / d).clamp(-1.0, 1.0);
    let sine = match outcome {
        Outcome::Two { .. } => (value * (d + rise.abs())).sqrt() / d,
        _ => 0.0,
    };
    // The direction turned to the left has the cosine with the way from p to q.
    let sine = if step.left { sine } else { -sine };
    let normal = turned(across.map(|x| x / d), [cosine, sine]);
    let direction = [normal[1], -normal[0]];
    Some((line_by(direction, p, h), outcome))
}

/// On which side the third is drawn, of two places; zero where the drawing cannot tell.
pub(super) fn drawn_side(placed: [&Shape; 2], shape: &Shape) -> f64 {
    match (placed.map(|s| *s), *shape) {
        ([Shape::Point(p), Shape::Point(q)], Shape::Point(y)) => cross(minus(q, p), minus(y, p)),
        (
            [Shape::Point(p), Shape::Line { direction, .. }]
            | [Shape::Line { direction, .. }, Shape::Point(p)],
            Shape::Point(y),
        ) => dot(direction, minus(y, p)),
        ([Shape::Point(p), Shape::Point(q)], Shape::Line { direction, .. }) => {
            cross(minus(q, p), left(direction))
        }
        _ => 0.0,
    }
}
