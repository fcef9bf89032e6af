//! Drawings that are solutions, or nearly.

use super::tests::{points, sketch};
use super::*;
use crate::samples::Random;
use crate::sketch::{Constraint, Element};
use kutzbach_math::number::Number;

/// Points tied to two of the last before them each, by the lengths of these places; drawn where `drawn` puts them.
fn long_chain(
    n: usize,
    random: &mut Random,
    mut drawn: impl FnMut(&mut Random, f64) -> f64,
) -> Sketch {
    let mut places = vec![[0.0, 0.0], [10.0, 1.0]];
    let mut edges = vec![[0, 1]];
    while places.len() < n {
        let new = places.len();
        let first = new.saturating_sub(25);
        let a = first + random.below(new - first);
        let b = random.other_than(new - first, &[a - first]) + first;
        let near = |k: usize| (places[a][k] + places[b][k]) / 2.0;
        let place = [0, 1].map(|k| near(k) + 16.0 * random.unit() - 8.0);
        places.push(place);
        edges.extend([[a, new], [b, new]]);
    }
    let value = |&[u, v]: &[usize; 2]| {
        let [x, y] = [0, 1].map(|k: usize| places[u][k] - places[v][k]);
        Constraint {
            ends: [u, v],
            value: Number::from_f64(f64::hypot(x, y)).unwrap(),
        }
    };
    let constraints = edges.iter().map(value).collect();
    let draw = |p: &[f64; 2]| Element::Point(p.map(|x| drawn(random, x)));
    let elements = places.iter().map(draw).collect();
    Sketch::new(elements, constraints).unwrap()
}

#[test]
fn a_drawing_that_holds_is_a_solution_however_long_the_chain() {
    let mut random = Random::new(4);
    for n in [30, 600, 2000] {
        let sketch = long_chain(n, &mut random, |_, x| x);
        let construction = Construction::new(&sketch).unwrap();
        let solution = construction.as_drawn().unwrap();
        assert!(construction.residual(&solution) < 1e-11, "{n}");
        let count = construction.count();
        assert!(count.value().is_none_or(|v| v > 0), "{n}: {count}");
        assert_eq!(
            construction.solutions().next().unwrap().left,
            construction.drawn_left()
        );
        // Another length is no rounding.
        let other = sketch.with_value(n, Number::integer(1000));
        assert!(
            Construction::new(&other).unwrap().as_drawn().is_err(),
            "{n}"
        );
    }
}

#[test]
fn a_drawing_off_in_its_sixth_decimal_is_corrected() {
    let mut random = Random::new(5);
    for n in [30, 400, 1000] {
        let sketch = long_chain(n, &mut random, |random, x| x + 1e-6 * (random.unit() - 0.5));
        let construction = Construction::new(&sketch).unwrap();
        let solution = construction.as_drawn().unwrap();
        assert!(construction.residual(&solution) < 1e-11, "{n}");
        assert_eq!(solution.left, construction.drawn_left());
        assert!(construction.count().value().is_none_or(|v| v > 0), "{n}");
    }
}

#[test]
fn points_and_lines_are_corrected_together() {
    // A strip between two lines: every point on one of them, at a distance of the one before it.
    let line = |y: f64, slope: f64| Element::Line {
        through: [0.0, y],
        direction: [1.0, slope],
    };
    let mut elements = vec![line(0.0, 0.0), line(2.0, 0.125)];
    let on = |k: usize| {
        let x = k as f64;
        match k % 2 {
            0 => [x, 0.0],
            _ => [x, 2.0 + x / 8.0],
        }
    };
    let mut constraints = vec![([0, 1], 0.125_f64.atan())];
    for k in 0..20 {
        elements.push(Element::Point(on(k)));
        constraints.push(([2 + k, k % 2], 0.0));
        if let Some(before) = k.checked_sub(1) {
            let [x, y] = [0, 1].map(|i: usize| on(k)[i] - on(before)[i]);
            constraints.push(([1 + k, 2 + k], f64::hypot(x, y)));
        }
    }
    let constraints = constraints.into_iter().map(|(ends, value)| Constraint {
        ends,
        value: Number::from_f64(value).unwrap(),
    });
    let sketch = Sketch::new(elements, constraints.collect()).unwrap();
    let drawn = drawn_shapes(&sketch);
    let mut random = Random::new(6);
    let mut off = || 2e-5 * (random.unit() - 0.5);
    let disturbed: Vec<Shape> = drawn
        .iter()
        .map(|shape| match *shape {
            Shape::Point(p) => Shape::Point(p.map(|x| x + off())),
            Shape::Line { direction, offset } => {
                let (sin, cos) = off().sin_cos();
                Shape::Line {
                    direction: shape::turned(direction, [cos, sin]),
                    offset: offset + off(),
                }
            }
        })
        .collect();
    assert!(correction::holds(&sketch, &drawn) && !correction::holds(&sketch, &disturbed));
    let corrected = correction::corrected(&sketch, &disturbed).unwrap();
    assert!(correction::holds(&sketch, &corrected));
    // Beside the drawing: no farther off than it was disturbed, a few times.
    for (one, other) in corrected.iter().zip(&drawn) {
        let far = match (one, other) {
            (Shape::Point(p), Shape::Point(q)) => f64::hypot(p[0] - q[0], p[1] - q[1]),
            _ => (one.offset() - other.offset()).abs(),
        };
        assert!(far < 1e-3, "{far}");
    }
}

#[test]
fn sides_that_do_not_reach_are_not_made_to() {
    // Longer than the two others together by a part in a million.
    let elements = points(&[[0.0, 0.0], [2.0, 0.0], [1.0, 1e-6]]);
    let sketch = sketch(elements, &[(0, 1, "2.000002"), (0, 2, "1"), (1, 2, "1")]);
    assert!(correction::corrected(&sketch, &drawn_shapes(&sketch)).is_none());
    assert!(Construction::new(&sketch).unwrap().as_drawn().is_err());
}

fn drawn_shapes(sketch: &Sketch) -> Vec<Shape> {
    sketch.elements().iter().map(Shape::drawn).collect()
}
