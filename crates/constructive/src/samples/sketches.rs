//! Sketches of any size, with the lengths that their drawing has.

use super::{Random, strip};
use crate::sketch::{Constraint, Element, Sketch};
use kutzbach_math::number::Number;

/// A strip of triangles with sides of one; see [`strip`].
#[must_use]
pub fn strip_sketch(points: usize) -> Sketch {
    let place = |k: usize| [k as f64 / 2.0, (k % 2) as f64 * 0.75_f64.sqrt()];
    let constraint = |ends| Constraint {
        ends,
        value: Number::one(),
    };
    let places = (0..points.max(2)).map(place);
    let constraints = strip(points.max(2)).into_iter().map(constraint);
    built(places, constraints.collect())
}

/// Points anywhere in a square, each tied to two before it that it does not nearly make a straight line with.
#[must_use]
pub fn tied_sketch(points: usize) -> Sketch {
    let mut random = Random::new(9);
    let places: Vec<[f64; 2]> = (0..points.max(2))
        .map(|_| [random.unit(), random.unit()])
        .collect();
    let off = |u: usize, v: usize| [0, 1].map(|k| places[u][k] - places[v][k]);
    let mut constraints = Vec::new();
    let mut tie = |u: usize, v: usize| {
        let [x, y] = off(u, v);
        let value = Number::from_f64(x.hypot(y)).unwrap_or_else(Number::one);
        constraints.push(Constraint {
            ends: [u, v],
            value,
        });
    };
    tie(0, 1);
    for v in 2..places.len() {
        let mut pair = [0, 1];
        for _ in 0..20 {
            let first = random.below(v);
            pair = [first, random.other_than(v, &[first])];
            let [a, b] = pair.map(|u| off(u, v));
            let sine = (a[0] * b[1] - a[1] * b[0]) / (a[0].hypot(a[1]) * b[0].hypot(b[1]));
            if sine.abs() > 0.7 {
                break;
            }
        }
        tie(pair[0], v);
        tie(pair[1], v);
    }
    built(places.iter().copied(), constraints)
}

/// What the functions above put together is a sketch.
fn built(places: impl Iterator<Item = [f64; 2]>, constraints: Vec<Constraint>) -> Sketch {
    #[allow(clippy::expect_used)] // no data from outside
    Sketch::new(places.map(Element::Point).collect(), constraints)
        .expect("points apart, none tied twice")
}
