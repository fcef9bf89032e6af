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
    /// They touch: both places are one, a double solution; or they overlap or stay apart by less than `within`, which leaves
    /// none, one or two places.
    Touching {
        /// In units of length; zero where exact arithmetic has shown that they touch.
        within: f64,
    },
    /// One place: two lines.
    One,
    /// They do not meet: `by` is how far they stay apart, in units of length (radians for a line by its angles with two others).
    Apart {
        /// Above zero.
        by: f64,
    },
    /// The two that are placed coincide or are parallel, or three lines are tied by angles alone, and both measures agree, to
    /// rounding: nothing fixes the third, which keeps one freedom.
    Degenerate,
}

impl Outcome {
    /// Whether there is a place.
    #[must_use]
    pub const fn is_possible(&self) -> bool {
        !matches!(self, Self::Apart { .. } | Self::Degenerate)
    }
}

/// A margin, and below which size its sign is not trusted.
struct Margin {
    value: f64,
    nearly: f64,
}

/// Margins below this part of the largest length are not trusted: how much of it is rounding hangs on how flat the triangles
/// were that lengths went through.
const NEARLY: f64 = 1e-9;

impl Margin {
    fn outcome(&self) -> Outcome {
        if self.value.abs() <= self.nearly {
            Outcome::Touching {
                within: self.nearly,
            }
        } else if self.value > 0.0 {
            Outcome::Two { by: self.value }
        } else {
            Outcome::Apart { by: -self.value }
        }
    }

    /// The margin for what lies in one place where it is zero or below.
    const fn inside(&self) -> f64 {
        self.value.max(0.0)
    }
}

/// What a step has to do: an element of a kind, by its measures from two that are placed.
pub(super) struct Third<'a> {
    pub(super) line: bool,
    pub(super) placed: [&'a Shape; 2],
    pub(super) measures: [Measure; 2],
    /// The largest coordinate of the clusters that take part.
    pub(super) extent: f64,
    /// Whether the two that are placed are held by the constraint between them alone: two parallel lines then are at no
    /// particular distance.
    pub(super) only_tied: bool,
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
            let lines = [(one, *h), (other, *k)].map(|(line, by)| beside(&line, by));
            two_lines(step, lines, [*h, *k])
        }
        (true, [Shape::Point(p), Shape::Point(q)], [Offset(h), Offset(k)]) => {
            common_tangent(step, [p, q], [*h, *k])
        }
        // A turn counts from the placed line.
        (true, [Shape::Point(p), Shape::Line { direction, .. }], [Offset(h), Turn(t)])
        | (true, [Shape::Line { direction, .. }, Shape::Point(p)], [Turn(t), Offset(h)]) => {
            Ok((line_by(turned(direction, *t), p, *h), Outcome::One))
        }
        (
            true,
            [
                Shape::Line { direction: a, .. },
                Shape::Line { direction: b, .. },
            ],
            [Turn(t), Turn(u)],
        ) => {
            let [a, b] = [turned(a, *t), turned(b, *u)];
            let off = cross(a, b).atan2(dot(a, b)).abs();
            Err(free_or_apart(off, DIRECTIONS))
        }
        _ => Err(Outcome::Degenerate),
    };
    match found {
        Err(outcome) => (None, outcome),
        Ok((shape, outcome)) => (Some(shape), outcome),
    }
}

/// Directions carry a few roundings each.
const DIRECTIONS: f64 = 64.0 * f64::EPSILON;

/// What two measures leave that should agree and are so far off each other.
fn free_or_apart(off: f64, error: f64) -> Outcome {
    match off <= error {
        true => Outcome::Degenerate,
        false => Outcome::Apart { by: off },
    }
}

/// A place, or why there is none.
type Found = Result<(Shape, Outcome), Outcome>;

/// Where two lines cross; parallel ones are one, or stay apart.
fn two_lines(step: &Third<'_>, [one, other]: [Shape; 2], offsets: [f64; 2]) -> Found {
    if let Some(p) = super::shape::crossing(&one, &other) {
        return Ok((Shape::Point(p), Outcome::One));
    }
    match (one, other) {
        (
            Shape::Line {
                direction: a,
                offset: h,
            },
            Shape::Line {
                direction: b,
                offset: k,
            },
        ) if !step.only_tied => {
            let off = (h - k * dot(a, b).signum()).abs();
            Err(free_or_apart(off, rounding(step.extent, &offsets)))
        }
        _ => Err(Outcome::Degenerate),
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

/// A power of two near a length that is not zero: in such units squares of lengths neither overflow nor vanish.
pub(super) fn scale_of(length: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    match f64::from_bits(length.to_bits() & EXPONENT) {
        power if power.is_normal() => power,
        _ => 1.0,
    }
}

/// Two points that are placed.
struct Pair {
    /// The direction from the first to the second, and the distance.
    unit: [f64; 2],
    distance: f64,
    /// The margin below which nothing is said.
    nearly: f64,
}

impl Pair {
    /// Where the points coincide, to rounding: both measures from there have to agree.
    fn of(step: &Third<'_>, [p, q]: [[f64; 2]; 2], measures: [f64; 2]) -> Result<Self, Outcome> {
        let across = minus(q, p);
        let distance = across[0].hypot(across[1]);
        let [one, other] = measures;
        let error = rounding(step.extent, &[one, other, distance]);
        if distance <= error {
            return Err(free_or_apart((one - other).abs(), error));
        }
        Ok(Self {
            unit: across.map(|x| x / distance),
            distance,
            nearly: nearly(&[one, other, distance]),
        })
    }
}

fn nearly(lengths: &[f64]) -> f64 {
    NEARLY * lengths.iter().fold(0.0, |m: f64, l| m.max(l.abs()))
}

fn two_circles(step: &Third<'_>, points: [[f64; 2]; 2], [r, s]: [f64; 2]) -> Found {
    let Pair {
        unit,
        distance,
        nearly,
    } = Pair::of(step, points, [r, s])?;
    let value = (r + s - distance).min(distance - (r - s).abs());
    let margin = Margin { value, nearly };
    let scale = scale_of(distance.max(r).max(s));
    let [d, r, s] = [distance, r, s].map(|x| x / scale);
    let foot = (d + (r - s) / d * (r + s)) / 2.0;
    let height = match margin.inside() > 0.0 {
        // Heron's formula by its factors, which lose no digits where the triangle is flat.
        true => ((r + s - d) * (r + s + d) * (d - r + s) * (d + r - s)).sqrt() / (2.0 * d),
        false => 0.0,
    };
    let height = if step.left { height } else { -height };
    let at = along(points[0], unit, scale * foot);
    let place = along(at, left(unit), scale * height);
    Ok((Shape::Point(place), margin.outcome()))
}

fn circle_and_line(step: &Third<'_>, p: [f64; 2], r: f64, (line, by): (Shape, f64)) -> Found {
    let Shape::Line { direction, offset } = line else {
        return Err(Outcome::Degenerate);
    };
    let height = dot(left(direction), p) - offset - by;
    let margin = Margin {
        value: r - height.abs(),
        nearly: nearly(&[r, height, step.extent * f64::EPSILON / NEARLY]),
    };
    let half = margin.inside().sqrt() * (r + height.abs()).sqrt();
    let half = if step.left { half } else { -half };
    let foot = along(p, left(direction), -height);
    Ok((Shape::Point(along(foot, direction, half)), margin.outcome()))
}

fn common_tangent(step: &Third<'_>, points: [[f64; 2]; 2], [h, k]: [f64; 2]) -> Found {
    let Pair {
        unit,
        distance,
        nearly,
    } = Pair::of(step, points, [h, k])?;
    let rise = k - h;
    let margin = Margin {
        value: distance - rise.abs(),
        nearly,
    };
    let cosine = (rise / distance).clamp(-1.0, 1.0);
    let sine = (margin.inside() / distance).sqrt() * (1.0 + cosine.abs()).sqrt();
    // The direction turned to the left has the cosine with the way from p to q.
    let sine = if step.left { sine } else { -sine };
    let normal = turned(unit, [cosine, sine]);
    let direction = [normal[1], -normal[0]];
    Ok((line_by(direction, points[0], h), margin.outcome()))
}

/// On which side the third is drawn, of two places; zero where the drawing cannot tell.
pub(crate) fn drawn_side(placed: [&Shape; 2], shape: &Shape) -> f64 {
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
