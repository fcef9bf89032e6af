//! Where points and lines are, and the motions that put two of them onto two others.

use super::third::scale_of;
use crate::sketch::Element;

/// A point or a directed line at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A point at x, y.
    Point([f64; 2]),
    /// The points p with n·p = offset, where n is the direction turned to the left by a right angle.
    Line {
        /// Of length one.
        direction: [f64; 2],
        /// Distance from the origin, above zero where the origin lies on the right.
        offset: f64,
    },
}

impl Shape {
    /// Where an element is drawn.
    pub(crate) fn drawn(element: &Element) -> Self {
        match *element {
            Element::Point(p) => Self::Point(p),
            Element::Line { through, direction } => {
                let length = direction[0].hypot(direction[1]);
                let direction = direction.map(|x| x / length);
                Self::Line {
                    direction,
                    offset: dot(left(direction), through),
                }
            }
        }
    }

    pub(crate) const fn is_line(&self) -> bool {
        matches!(self, Self::Line { .. })
    }

    /// How far a line is from the origin, to its left; zero of a point.
    pub(crate) const fn offset(&self) -> f64 {
        match self {
            Self::Point(_) => 0.0,
            Self::Line { offset, .. } => *offset,
        }
    }

    /// The farthest that a coordinate of it, or the offset of a line, is from zero: for rounding errors.
    #[must_use]
    pub fn extent(&self) -> f64 {
        match self {
            Self::Point([x, y]) => x.abs().max(y.abs()),
            Self::Line { offset, .. } => offset.abs(),
        }
    }
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(super) fn left(a: [f64; 2]) -> [f64; 2] {
    [-a[1], a[0]]
}

pub(super) fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// `a` + `t` `b`.
pub(super) fn along(a: [f64; 2], b: [f64; 2], t: f64) -> [f64; 2] {
    [a[0] + t * b[0], a[1] + t * b[1]]
}

/// Turns `v` by the angle with this cosine and sine.
pub(super) fn turned(v: [f64; 2], [c, s]: [f64; 2]) -> [f64; 2] {
    [c * v[0] - s * v[1], s * v[0] + c * v[1]]
}

/// The distance of two points, how far a point lies to the left of a line, or the cosine and sine of the angle from one line to
/// the other.
pub(super) enum Measure {
    Length(f64),
    Offset(f64),
    Turn([f64; 2]),
}

pub(super) fn measure(one: &Shape, other: &Shape) -> Measure {
    match (*one, *other) {
        (Shape::Point(p), Shape::Point(q)) => {
            let [x, y] = minus(q, p);
            Measure::Length(x.hypot(y))
        }
        (Shape::Point(p), Shape::Line { direction, offset })
        | (Shape::Line { direction, offset }, Shape::Point(p)) => {
            Measure::Offset(dot(left(direction), p) - offset)
        }
        (Shape::Line { direction: a, .. }, Shape::Line { direction: b, .. }) => {
            Measure::Turn([dot(a, b), cross(a, b)])
        }
    }
}

/// A rotation about the origin, then a translation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    turn: [f64; 2],
    shift: [f64; 2],
}

impl Motion {
    /// By cosine and sine of the turn, and the shift after it.
    pub(super) const fn by(turn: [f64; 2], shift: [f64; 2]) -> Self {
        Self { turn, shift }
    }

    /// Cosine and sine of the turn, and the shift after it.
    pub(crate) const fn parts(&self) -> ([f64; 2], [f64; 2]) {
        (self.turn, self.shift)
    }

    pub(crate) fn of(&self, shape: &Shape) -> Shape {
        match *shape {
            Shape::Point(p) => Shape::Point(along(self.shift, turned(p, self.turn), 1.0)),
            Shape::Line { direction, offset } => {
                let direction = turned(direction, self.turn);
                let offset = offset + dot(left(direction), self.shift);
                Shape::Line { direction, offset }
            }
        }
    }

    /// The motion that puts two elements onto two others of the same kinds and the same measure; `None` where they do not fix
    /// one: coincident points, parallel lines.
    pub(crate) fn onto(from: [&Shape; 2], to: [&Shape; 2]) -> Option<Self> {
        match (from.map(|s| *s), to.map(|s| *s)) {
            ([Shape::Point(p), Shape::Point(q)], [Shape::Point(u), Shape::Point(v)]) => {
                Self::turning(minus(q, p), minus(v, u)).map(|m| m.carrying(p, u))
            }
            (
                [Shape::Line { direction: a, .. }, Shape::Point(p)]
                | [Shape::Point(p), Shape::Line { direction: a, .. }],
                [Shape::Line { direction: b, .. }, Shape::Point(u)]
                | [Shape::Point(u), Shape::Line { direction: b, .. }],
            ) => Self::turning(a, b).map(|m| m.carrying(p, u)),
            ([Shape::Line { direction: a, .. }, _], [Shape::Line { direction: b, .. }, _]) => {
                let [p, u] = [crossing(from[0], from[1])?, crossing(to[0], to[1])?];
                Self::turning(a, b).map(|m| m.carrying(p, u))
            }
            _ => None,
        }
    }

    /// The rotation from one direction to another, of any lengths.
    fn turning(a: [f64; 2], b: [f64; 2]) -> Option<Self> {
        let [a, b] = [a, b].map(|v| {
            let scale = scale_of(v[0].abs().max(v[1].abs()));
            v.map(|x| x / scale)
        });
        let turn = [dot(a, b), cross(a, b)];
        let length = turn[0].hypot(turn[1]);
        (length > 0.0).then(|| Self {
            turn: turn.map(|x| x / length),
            shift: [0.0; 2],
        })
    }

    fn carrying(self, p: [f64; 2], to: [f64; 2]) -> Self {
        let shift = minus(to, turned(p, self.turn));
        Self { shift, ..self }
    }
}

/// Where two lines cross, unless they are parallel to rounding.
pub(super) fn crossing(one: &Shape, other: &Shape) -> Option<[f64; 2]> {
    let (
        &Shape::Line {
            direction: a,
            offset: h,
        },
        &Shape::Line {
            direction: b,
            offset: k,
        },
    ) = (one, other)
    else {
        return None;
    };
    let sine = cross(a, b);
    // Directions carry a few roundings each.
    if sine.abs() <= 64.0 * f64::EPSILON {
        return None;
    }
    // p = s a + t b with left(a)·p = h and left(b)·p = k.
    let (t, s) = (h / sine, -k / sine);
    Some(along(a.map(|x| s * x), b, t))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_puts_two_elements_where_two_others_are() {
        let line = |x: f64, y: f64, offset| Shape::Line {
            direction: [x, y],
            offset,
        };
        let elements = [
            Shape::Point([1.0, 2.0]),
            Shape::Point([-3.0, 0.5]),
            line(0.6, 0.8, 2.0),
            line(-0.8, 0.6, -1.0),
        ];
        let moved = Motion {
            turn: [0.28, 0.96],
            shift: [5.0, -7.0],
        };
        for i in 0..4 {
            for j in (0..4).filter(|&j| j != i) {
                let pair = [&elements[i], &elements[j]];
                let targets = pair.map(|s| moved.of(s));
                let found = Motion::onto(pair, [&targets[0], &targets[1]]).unwrap();
                for k in 0..2 {
                    let difference = minus(found.turn, moved.turn)[k].abs()
                        + minus(found.shift, moved.shift)[k].abs();
                    assert!(difference < 1e-13, "{i} {j}");
                }
            }
        }
        let parallel = [&line(0.6, 0.8, 1.0), &line(-0.6, -0.8, 1.0)];
        assert!(Motion::onto(parallel, parallel).is_none());
    }

    #[test]
    fn lines_cross_on_both() {
        let one = Shape::drawn(&Element::Line {
            through: [1.0, 1.0],
            direction: [3.0, 4.0],
        });
        let other = Shape::drawn(&Element::Line {
            through: [2.0, 0.0],
            direction: [0.0, -2.0],
        });
        let p = crossing(&one, &other).unwrap();
        for line in [one, other] {
            let Measure::Offset(off) = measure(&Shape::Point(p), &line) else {
                panic!("a point and a line");
            };
            assert!(off.abs() < 1e-14);
        }
        assert!((p[0] - 2.0).abs() < 1e-14);
    }
}
