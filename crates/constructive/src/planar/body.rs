//! What holds the elements of one body against each other.

use super::millimetres;
use crate::sketch::{Constraint, Element};
use kutzbach_math::number::Number;

/// Exact coordinates in the plane.
pub(crate) type Pair = [Number; 2];

/// A point, or a point of a line and its direction.
#[derive(Clone, Debug)]
pub(crate) enum Exact {
    Point(Pair),
    Line(Pair, Pair),
}

fn minus(a: &Pair, b: &Pair) -> Pair {
    [0, 1].map(|k| &a[k] - &b[k])
}

fn dot(a: &Pair, b: &Pair) -> Number {
    &(&a[0] * &b[0]) + &(&a[1] * &b[1])
}

fn cross(a: &Pair, b: &Pair) -> Number {
    &(&a[0] * &b[1]) - &(&a[1] * &b[0])
}

impl Exact {
    pub(crate) fn drawn(&self) -> Element {
        let value = |p: &Pair| [p[0].value(), p[1].value()];
        match self {
            Self::Point(p) => Element::Point(value(p)),
            Self::Line(p, d) => Element::Line {
                through: value(p),
                direction: value(d),
            },
        }
    }

    pub(crate) const fn is_line(&self) -> bool {
        matches!(self, Self::Line(..))
    }

    /// Whether both are at the same place: points in one place, lines of one direction on each other.
    pub(crate) fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Point(p), Self::Point(q)) => minus(p, q).iter().all(Number::is_zero),
            (Self::Line(p, a), Self::Line(q, b)) => {
                cross(a, b).is_zero() && dot(a, b).signum() > 0 && cross(a, &minus(p, q)).is_zero()
            }
            _ => false,
        }
    }

    pub(crate) fn parallel(&self, other: &Self) -> bool {
        matches!((self, other), (Self::Line(_, a), Self::Line(_, b)) if cross(a, b).is_zero())
    }

    /// How far from each other two are that should be at the same place, in words.
    pub(crate) fn gap(&self, other: &Self) -> String {
        let value = |p: &Pair| p.clone().map(|x| x.value());
        match (self, other) {
            (Self::Line(p, a), Self::Line(q, b))
                if cross(a, b).is_zero() && dot(a, b).signum() > 0 =>
            {
                let [x, y] = value(a);
                millimetres(cross(a, &minus(p, q)).value() / x.hypot(y))
            }
            (Self::Line(_, a), Self::Line(_, b)) => {
                let angle = cross(a, b).value().atan2(dot(a, b).value());
                format!("{:.3}°", angle.to_degrees().abs())
            }
            (Self::Point(p) | Self::Line(p, _), Self::Point(q) | Self::Line(q, _)) => {
                let [x, y] = value(&minus(p, q));
                millimetres(x.hypot(y))
            }
        }
    }

    /// The value of the constraint between the two.
    fn value(&self, other: &Self) -> Option<Number> {
        match (self, other) {
            (Self::Point(p), Self::Point(q)) => {
                let off = minus(p, q);
                dot(&off, &off).sqrt().ok()
            }
            (Self::Point(p), Self::Line(q, d)) | (Self::Line(q, d), Self::Point(p)) => {
                let length = dot(d, d).sqrt().ok()?;
                cross(d, &minus(p, q)).checked_div(&length).ok()
            }
            (Self::Line(_, a), Self::Line(_, b)) => Number::atan2(&cross(a, b), &dot(a, b)).ok(),
        }
    }
}

/// What a body asks for.
#[derive(Default)]
pub(crate) struct Held {
    pub(crate) constraints: Vec<Constraint>,
    /// Three elements each, and how they lie in the body.
    pub(crate) triangles: Vec<([usize; 3], [Element; 3])>,
}

/// Ties the first two elements, and every other one to two that are tied already; `None` where only lines are left.
pub(crate) fn hold(elements: &[(usize, Exact)]) -> Option<Held> {
    let mut held = Held::default();
    let mut tied: Vec<[usize; 2]> = Vec::new();
    // Points first: any of them hold each other.
    let mut order: Vec<usize> = (0..elements.len()).collect();
    order.sort_by_key(|&i| elements[i].1.is_line());
    for (count, &new) in order.iter().enumerate() {
        let near = match count {
            0 => continue,
            1 => vec![order[0]],
            _ => {
                let pair = tied.iter().find(|pair| fix(elements, **pair, new))?;
                pair.to_vec()
            }
        };
        for &old in &near {
            let [(u, one), (v, other)] = [&elements[old], &elements[new]];
            held.constraints.push(Constraint {
                ends: [*u, *v],
                value: one.value(other)?,
            });
            tied.push([old, new]);
        }
        if let [a, b] = near[..] {
            let three = [a, b, new].map(|i| &elements[i]);
            held.triangles
                .push((three.map(|e| e.0), three.map(|e| e.1.drawn())));
        }
    }
    Some(held)
}

/// Whether two elements fix a third.
fn fix(elements: &[(usize, Exact)], [a, b]: [usize; 2], new: usize) -> bool {
    let [one, other, new] = [a, b, new].map(|i| &elements[i].1);
    let lines = [one, other, new].iter().filter(|e| e.is_line()).count();
    lines < 2
        || lines == 2
            && ![(one, other), (one, new), (other, new)]
                .iter()
                .any(|(p, q)| p.parallel(q))
}
