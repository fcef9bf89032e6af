//! How a body is placed by its parent: a turn about two shared points, or about one.
//!
//! *Two points.* With e from one shared point to the other, u perpendicular to it to a point of the child, and u' to a point of
//! the parent, the child's u stands at U = x u' + y e × u', and |U|² = |u|² is a conic in x and y with coefficients in the
//! field of the coordinates. No root is needed, as it were for a cosine and a sine of the angle between u' and U:
//! x = (|u|/|u'|) cos, y = (|u|/|u'||e|) sin. Every coordinate is linear in x and y, a half angle would make it a quotient of
//! degree two. *One point.* A quaternion of length one; coordinates are quadratic in it.

use super::Poly;
use super::local::{Constant, Local, Vector, minus, sum};
use kutzbach_algebra::{FieldElement, NumberField};

/// The unknowns of an edge of the tree.
#[derive(Clone, Debug)]
pub enum Unknowns {
    /// Indices of x and y, |u|²/|u'|² and |e|².
    Hinge {
        /// Index of x; that of y follows.
        first: usize,
        /// (|u|/|u'|)²: x runs from minus to plus the root of it.
        ratio: FieldElement,
        /// The squared length of e (m²).
        axis: FieldElement,
    },
    /// The quaternion.
    Ball {
        /// Index of its real part; the other three follow.
        first: usize,
    },
}

impl Unknowns {
    /// Number of unknowns.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            Self::Hinge { .. } => 2,
            Self::Ball { .. } => 4,
        }
    }

    /// Index of the first unknown.
    #[must_use]
    pub fn first(&self) -> usize {
        match self {
            Self::Hinge { first, .. } | Self::Ball { first } => *first,
        }
    }

    /// Freedoms.
    #[must_use]
    pub fn freedom(&self) -> usize {
        self.count() - 1
    }

    /// The relation between the unknowns.
    #[must_use]
    pub fn relation(&self, field: &NumberField) -> Poly {
        let square = |index| Poly::unknown(index).times(&Poly::unknown(index), field);
        match self {
            Self::Hinge { first, ratio, axis } => square(*first)
                .plus(&square(first + 1).scaled(axis, field))
                .minus(&Poly::constant(ratio.clone())),
            Self::Ball { first } => (0..4)
                .fold(Poly::default(), |sum, k| sum.plus(&square(first + k)))
                .minus(&Poly::constant(FieldElement::integer(1))),
        }
    }
}

/// A child in the frame of its parent.
#[derive(Clone, Debug)]
pub(super) struct Turn {
    pub(super) unknowns: Unknowns,
    /// A shared point, in the child and in the parent.
    pub(super) pivot: [Constant; 2],
    parts: Parts,
}

#[derive(Clone, Debug)]
enum Parts {
    Hinge(Box<HingeParts>),
    Ball,
}

#[derive(Clone, Debug)]
struct HingeParts {
    child: Local,
    /// e, u and e × u in the child.
    of: [Constant; 3],
    /// Their squared lengths, inverted.
    inverse: [FieldElement; 3],
    /// e, u' and e × u' in the parent.
    to: [Constant; 3],
    /// −|e|².
    back: FieldElement,
}

impl Turn {
    /// How much farther than the points by which the turn is made another point of these bodies moves at most, where the former are
    /// off by a little: with the axis, and about it.
    pub(super) fn lever(&self, [child, parent]: [&Local; 2], field: &NumberField) -> f64 {
        let Parts::Hinge(parts) = &self.parts else {
            return 1.0;
        };
        let of_body = |body: &Local, pivot: &Constant, [e, u, _]: &[Constant; 3]| {
            let value = |a: &Constant, b: &Constant| field.number(&body.dot(a, b, field)).value();
            let (axis, arm) = (value(e, e), value(u, u));
            let of_point = |point: &Constant| {
                let way = minus(point, pivot);
                let (square, along) = (value(&way, &way), value(&way, e));
                let off = (square - along * along / axis).max(0.0);
                (square / axis).max(off / arm).sqrt()
            };
            body.points.values().map(of_point).fold(1.0, f64::max)
        };
        let in_child = of_body(child, &self.pivot[0], &parts.of);
        in_child.max(of_body(parent, &self.pivot[1], &parts.to))
    }

    /// The turn of a child about the points that it shares with its parent; `None` where these do not suffice, or for one
    /// point where a body's basis is not of unit vectors.
    pub(super) fn new(
        shared: &[usize],
        child: &Local,
        parent: &Local,
        first: usize,
        field: &NumberField,
    ) -> Option<Self> {
        let pivot = [child, parent].map(|body| body.points.get(&shared[0]).cloned());
        let [Some(in_child), Some(in_parent)] = pivot else {
            return None;
        };
        let pivot = [in_child, in_parent];
        let Some(second) = shared.get(1) else {
            let unit = FieldElement::integer(1);
            let plain = |body: &Local| body.metric.iter().all(|g| *g == unit);
            return (plain(child) && plain(parent)).then_some(Self {
                unknowns: Unknowns::Ball { first },
                pivot,
                parts: Parts::Ball,
            });
        };
        let axis_of = |body: &Local, pivot: &Constant| {
            let e = minus(body.points.get(second)?, pivot);
            let square = body.dot(&e, &e, field);
            let inverse = field.inverse(&square)?;
            // The first point off the axis.
            let u = body.points.values().find_map(|p| {
                let way = minus(p, pivot);
                let along = field.times(&body.dot(&way, &e, field), &inverse);
                let u = [0, 1, 2].map(|i| way[i].minus(&field.times(&along, &e[i])));
                (!u.iter().all(FieldElement::is_zero)).then_some(u)
            })?;
            let w = body.cross(&e, &u, field);
            Some([e, u, w])
        };
        let of = axis_of(child, &pivot[0])?;
        let to = axis_of(parent, &pivot[1])?;
        let squares = [0, 1, 2].map(|i| child.dot(&of[i], &of[i], field));
        let width = parent.dot(&to[1], &to[1], field);
        let ratio = field.times(&squares[1], &field.inverse(&width)?);
        let mut inverse = squares.clone();
        for square in &mut inverse {
            *square = field.inverse(square)?;
        }
        let axis = squares[0].clone();
        Some(Self {
            unknowns: Unknowns::Hinge {
                first,
                ratio,
                axis: axis.clone(),
            },
            pivot,
            parts: Parts::Hinge(Box::new(HingeParts {
                child: child.clone(),
                of,
                inverse,
                to,
                back: FieldElement::default().minus(&axis),
            })),
        })
    }

    /// A vector of the child in the parent's frame.
    pub(super) fn turned(&self, v: &Vector, field: &NumberField) -> Vector {
        match (&self.parts, &self.unknowns) {
            (Parts::Hinge(parts), Unknowns::Hinge { first, .. }) => {
                let (x, y) = (Poly::unknown(*first), Poly::unknown(first + 1));
                let [along, out, side] = [0, 1, 2].map(|i| {
                    let component = parts.child.dot_with(&parts.of[i], v, field);
                    component.scaled(&parts.inverse[i], field)
                });
                // U = x u' + y w', e × U = x w' − y |e|² u'.
                let to_u = out
                    .times(&x, field)
                    .plus(&side.times(&y, field).scaled(&parts.back, field));
                let to_w = out.times(&y, field).plus(&side.times(&x, field));
                [0, 1, 2].map(|i| {
                    along
                        .scaled(&parts.to[0][i], field)
                        .plus(&to_u.scaled(&parts.to[1][i], field))
                        .plus(&to_w.scaled(&parts.to[2][i], field))
                })
            }
            (_, unknowns) => {
                let q = [0, 1, 2, 3].map(|k| Poly::unknown(unknowns.first() + k));
                let rows = rotation(&q, field);
                rows.map(|row| {
                    (0..3).fold(Poly::default(), |sum, j| {
                        sum.plus(&row[j].times(&v[j], field))
                    })
                })
            }
        }
    }

    /// A point of the child, seen from the pivot, in the parent's frame.
    pub(super) fn placed(&self, point: &Vector, field: &NumberField) -> Vector {
        let from_pivot = super::local::difference(point, &super::local::constant(&self.pivot[0]));
        sum(
            &self.turned(&from_pivot, field),
            &super::local::constant(&self.pivot[1]),
        )
    }
}

/// The rotation of a quaternion, homogeneous of degree two: divided by its squared length it is a rotation matrix.
fn rotation(q: &[Poly; 4], field: &NumberField) -> [[Poly; 3]; 3] {
    let product = |i: usize, j: usize| q[i].times(&q[j], field);
    let two = FieldElement::integer(2);
    let square = [0, 1, 2, 3].map(|i| product(i, i));
    let diagonal = |i: usize| {
        let mut sum = square[0].clone();
        for (j, other) in square.iter().enumerate().skip(1) {
            sum = if j == i + 1 {
                sum.plus(other)
            } else {
                sum.minus(other)
            };
        }
        sum
    };
    let entry = |i: usize, j: usize| {
        if i == j {
            return diagonal(i);
        }
        let outer = product(i + 1, j + 1);
        let skew = product(0, 4 - i - j);
        let both = if (3 + j - i) % 3 == 1 {
            outer.minus(&skew)
        } else {
            outer.plus(&skew)
        };
        both.scaled(&two, field)
    };
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}
