//! What holds between three elements or more, or by a value that nothing states.
//!
//! # Why
//! A constraint ties two elements by a value that the file states. A middle, a mirror and a length that another one has too are not of that
//! kind: the first two tie three elements, the third a value that is unknown. Each is written as equations of its own, so that it is
//! counted and solved as it stands and no hidden element has to be placed for it.

use crate::construction::{Construction, Shape};
use kutzbach_math::number::Number;

/// A relation of elements, by index. Unknown values are lengths, above zero.
#[derive(Clone, Debug)]
pub enum Relation {
    /// A point lies in the middle of two others: two equations.
    Middle {
        /// The point.
        point: usize,
        /// The two others.
        of: [usize; 2],
    },
    /// Two points, or two lines, are mirror images in a line: two equations.
    Mirrored {
        /// The points or lines.
        pair: [usize; 2],
        /// The line that they are mirrored in.
        axis: usize,
        /// Of lines: whether the second points against the mirror image of the first.
        against: bool,
    },
    /// The distance of two points, or how far a point lies to the left of a line, is a sum of unknown values and a number: one equation.
    /// Of two points the sum may come out below zero; its size counts.
    Measured {
        /// The two elements.
        ends: [usize; 2],
        /// Unknown values, and whether each is subtracted.
        terms: Vec<(usize, bool)>,
        /// The number.
        plus: Number,
    },
}

impl Relation {
    /// The elements that it ties.
    #[must_use]
    pub fn elements(&self) -> Vec<usize> {
        match *self {
            Self::Middle { point, of: [a, b] } => vec![point, a, b],
            Self::Mirrored {
                pair: [a, b], axis, ..
            } => vec![a, b, axis],
            Self::Measured { ends, .. } => ends.to_vec(),
        }
    }

    /// The unknown values in it.
    #[must_use]
    pub fn values(&self) -> &[(usize, bool)] {
        match self {
            Self::Measured { terms, .. } => terms,
            _ => &[],
        }
    }

    /// How many freedoms it takes in general.
    #[must_use]
    pub const fn equations(&self) -> usize {
        match self {
            Self::Middle { .. } | Self::Mirrored { .. } => 2,
            Self::Measured { .. } => 1,
        }
    }

    /// The same of elements and values that have other indices; `None` where one of these has none.
    pub(crate) fn moved(
        &self,
        element: impl Fn(usize) -> Option<usize>,
        value: impl Fn(usize) -> Option<usize>,
    ) -> Option<Self> {
        let both = |[a, b]: [usize; 2]| Some([element(a)?, element(b)?]);
        Some(match self {
            Self::Middle { point, of } => Self::Middle {
                point: element(*point)?,
                of: both(*of)?,
            },
            Self::Mirrored {
                pair,
                axis,
                against,
            } => Self::Mirrored {
                pair: both(*pair)?,
                axis: element(*axis)?,
                against: *against,
            },
            Self::Measured { ends, terms, plus } => {
                let terms = terms.iter().map(|&(v, minus)| Some((value(v)?, minus)));
                Self::Measured {
                    ends: both(*ends)?,
                    terms: terms.collect::<Option<_>>()?,
                    plus: plus.clone(),
                }
            }
        })
    }

    /// Where an element is that this relation places by the others; `None` where it does not: an axis, an element that is not in
    /// it, or one of different kind.
    #[must_use]
    pub fn place(&self, element: usize, shapes: &[Shape]) -> Option<Shape> {
        match *self {
            Self::Middle { point, of: [a, b] } => {
                let at = |e: usize| match shapes.get(e) {
                    Some(Shape::Point(p)) => Some(*p),
                    _ => None,
                };
                let (p, q, weight) = match element {
                    e if e == point => (at(a)?, at(b)?, 0.5),
                    e if e == a => (at(point)?, at(b)?, -1.0),
                    e if e == b => (at(point)?, at(a)?, -1.0),
                    _ => return None,
                };
                // Half of both, or twice the middle less the other end.
                Some(Shape::Point([0, 1].map(|k| match weight > 0.0 {
                    true => weight * (p[k] + q[k]),
                    false => 2.0 * p[k] - q[k],
                })))
            }
            Self::Mirrored {
                pair: [a, b],
                axis,
                against,
            } => {
                let other = match element {
                    e if e == a => b,
                    e if e == b => a,
                    _ => return None,
                };
                mirrored(shapes.get(other)?, shapes.get(axis)?, against)
            }
            Self::Measured { .. } => None,
        }
    }

    /// By how much it does not hold, a length or the sine of an angle: not a number where an unknown value is not given.
    #[must_use]
    pub fn off(&self, shapes: &[Shape], values: &[f64]) -> f64 {
        match self {
            Self::Middle { point, .. } => self.apart(*point, shapes),
            Self::Mirrored { pair: [_, b], .. } => self.apart(*b, shapes),
            Self::Measured { ends, terms, plus } => {
                let term = |sum: f64, &(v, minus): &(usize, bool)| {
                    let value = values.get(v).copied().unwrap_or(f64::NAN);
                    if minus { sum - value } else { sum + value }
                };
                let asked = terms.iter().fold(plus.value(), term);
                let [u, v] = ends.map(|e| &shapes[e]);
                let found = Construction::value_between(u, v);
                let length = !u.is_line() && !v.is_line();
                (found - if length { asked.abs() } else { asked }).abs()
            }
        }
    }

    /// How far an element is from where this relation places it.
    fn apart(&self, element: usize, shapes: &[Shape]) -> f64 {
        match (self.place(element, shapes), shapes.get(element)) {
            (Some(Shape::Point(p)), Some(Shape::Point(q))) => (p[0] - q[0]).hypot(p[1] - q[1]),
            (
                Some(Shape::Line {
                    direction: a,
                    offset: h,
                }),
                Some(Shape::Line {
                    direction: b,
                    offset: k,
                }),
            ) => (a[0] - b[0]).hypot(a[1] - b[1]).max((h - k).abs()),
            _ => f64::NAN,
        }
    }
}

/// The mirror image of a point or line in a line; of a line as it points, or against that.
pub(crate) fn mirrored(shape: &Shape, axis: &Shape, against: bool) -> Option<Shape> {
    let Shape::Line {
        direction: [c, s],
        offset,
    } = *axis
    else {
        return None;
    };
    let reflected = |[x, y]: [f64; 2]| {
        let along = 2.0 * (c * x + s * y);
        [along * c - x, along * s - y]
    };
    Some(match *shape {
        Shape::Point(p) => {
            let [x, y] = reflected(p);
            Shape::Point([x - 2.0 * offset * s, y + 2.0 * offset * c])
        }
        Shape::Line {
            direction,
            offset: own,
        } => {
            let along = c * direction[0] + s * direction[1];
            // The left side becomes the right one.
            let sign = if against { 1.0 } else { -1.0 };
            Shape::Line {
                direction: reflected(direction).map(|x| -sign * x),
                offset: sign * (own - 2.0 * offset * along),
            }
        }
    })
}

/// The unknown values, measured where elements are: by relations with one of them at a time; not a number where none says.
#[must_use]
pub(crate) fn measured<'r>(
    relations: impl Iterator<Item = &'r Relation> + Clone,
    shapes: &[Shape],
    count: usize,
) -> Vec<f64> {
    let mut values = vec![f64::NAN; count];
    loop {
        let next = relations.clone().find_map(|relation| {
            let Relation::Measured { ends, terms, plus } = relation else {
                return None;
            };
            let mut open = terms.iter().filter(|(v, _)| values[*v].is_nan());
            let (&(value, minus), None) = (open.next()?, open.next()) else {
                return None;
            };
            let [u, v] = ends.map(|e| shapes.get(e));
            let found = Construction::value_between(u?, v?);
            let known = |sum: f64, &(v, minus): &(usize, bool)| match (values[v].is_nan(), minus) {
                (true, _) => sum,
                (false, true) => sum - values[v],
                (false, false) => sum + values[v],
            };
            let rest = found - terms.iter().fold(plus.value(), known);
            Some((value, if minus { -rest } else { rest }))
        });
        match next {
            Some((value, found)) if found.is_finite() => values[value] = found,
            _ => return values,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_image_twice_is_what_was_mirrored() {
        let axis = Shape::Line {
            direction: [0.6, 0.8],
            offset: 1.5,
        };
        // (2, 1) lies 0.6 · 1 − 0.8 · 2 − 1.5 = −2.5 to the left: its image is 5 along the normal (−0.8, 0.6) away.
        let image = mirrored(&Shape::Point([2.0, 1.0]), &axis, false).unwrap();
        let Shape::Point([x, y]) = image else {
            panic!("a point")
        };
        assert!(
            (x + 2.0).abs() < 1e-14 && (y - 4.0).abs() < 1e-14,
            "{x} {y}"
        );
        let line = Shape::Line {
            direction: [-0.28, 0.96],
            offset: 0.7,
        };
        for (shape, against) in [(image, false), (line, false), (line, true)] {
            let once = mirrored(&shape, &axis, against).unwrap();
            let pair = [shape, once, axis];
            let relation = Relation::Mirrored {
                pair: [0, 1],
                axis: 2,
                against,
            };
            assert!(relation.off(&pair, &[]) < 1e-14);
            assert!(relation.off(&[once, shape, axis], &[]) < 1e-14);
            assert_ne!(once, shape);
        }
        // A point of the line, mirrored, lies on the line's image.
        let on = Shape::Point([-0.96 * 0.7, -0.28 * 0.7]);
        for against in [false, true] {
            let [p, l] = [&on, &line].map(|s| mirrored(s, &axis, against).unwrap());
            assert!(Construction::value_between(&p, &l).abs() < 1e-14);
        }
    }

    #[test]
    fn values_are_measured_one_after_the_other() {
        let shapes = [[0.0, 0.0], [3.0, 4.0], [3.0, 6.0]].map(Shape::Point);
        let of = |ends, terms: &[(usize, bool)]| Relation::Measured {
            ends,
            terms: terms.to_vec(),
            plus: Number::one(),
        };
        // 2 = b − a + 1 and 5 = a + 1.
        let relations = [
            of([1, 2], &[(1, false), (0, true)]),
            of([0, 1], &[(0, false)]),
        ];
        let values = measured(relations.iter(), &shapes, 3);
        assert_eq!(values[..2], [4.0, 5.0]);
        assert!(values[2].is_nan());
        assert!(relations.iter().all(|r| r.off(&shapes, &values) < 1e-15));
        assert!(relations[0].off(&shapes, &[4.0]).is_nan());
    }
}
