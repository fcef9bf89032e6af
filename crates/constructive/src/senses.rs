//! Lines whose sense nothing measures.
//!
//! # Why
//! Lines are directed, so that a distance from one has a side and an angle is one of a whole turn. Where only points lie on a line nobody asks which way it
//! points: the same figure is then a solution twice. Lines that angles and mirror images tie point one way or the other together. Such a *class* is free
//! where no line of it has a distance to some side; turning all of it round makes a solution of each solution, and figures are these up to that.

use crate::construction::{Motion, Shape};
use crate::relation::Relation;
use crate::sketch::Sketch;

/// Classes of lines that can be turned round together without a figure changing, ascending; none where senses count.
pub(crate) fn free(sketch: &Sketch) -> Vec<Vec<usize>> {
    if sketch.senses_count() {
        return Vec::new();
    }
    let elements = sketch.elements();
    let line = |e: usize| elements[e].is_line();
    let mut class: Vec<usize> = (0..elements.len()).collect();
    let mut measured = vec![false; elements.len()];
    let mut join = |[u, v]: [usize; 2]| {
        let [a, b] = [u, v].map(|e| class[e]);
        class.iter_mut().filter(|c| **c == b).for_each(|c| *c = a);
    };
    for constraint in sketch.constraints() {
        let [u, v] = constraint.ends;
        match (line(u), line(v)) {
            (true, true) => join([u, v]),
            (false, false) => {}
            _ if constraint.value.is_zero() => {}
            _ => measured[if line(u) { u } else { v }] = true,
        }
    }
    for relation in sketch.relations() {
        match *relation {
            // The mirror image does not change with the axis' sense.
            Relation::Mirrored { pair, .. } if line(pair[0]) => join(pair),
            Relation::Measured { ends: [u, v], .. } if line(u) || line(v) => {
                measured[if line(u) { u } else { v }] = true;
            }
            _ => {}
        }
    }
    for (three, _) in sketch.rigid_triangles() {
        three.into_iter().for_each(|e| measured[e] = true);
    }
    let mut classes: Vec<Vec<usize>> = vec![Vec::new(); elements.len()];
    for e in (0..elements.len()).filter(|&e| line(e)) {
        classes[class[e]].push(e);
    }
    classes.retain(|lines| !lines.is_empty() && lines.iter().all(|&e| !measured[e]));
    classes.sort();
    classes
}

/// Turning more classes round than this, each alone and with others, is not compared.
const MOST_CLASSES: usize = 6;

/// Whether one place of some elements is another one up to a motion of the plane and the senses of lines; `free` are classes by index into the shapes.
pub(crate) fn same_figure(one: &[Shape], other: &[Shape], free: &[Vec<usize>]) -> bool {
    let choices = 1_usize << free.len().min(MOST_CLASSES);
    (0..choices).any(|choice| {
        let mut turned = one.to_vec();
        for (k, lines) in free.iter().enumerate() {
            if choice >> k & 1 == 1 {
                lines.iter().for_each(|&l| turned[l] = round(&turned[l]));
            }
        }
        is_moved(&turned, other)
    })
}

/// The line that points the other way.
fn round(shape: &Shape) -> Shape {
    match *shape {
        Shape::Line { direction, offset } => Shape::Line {
            direction: direction.map(|x| -x),
            offset: -offset,
        },
        point @ Shape::Point(_) => point,
    }
}

/// Share of the largest coordinate by which places differ that are one: places are known to about as many digits.
const SAME: f64 = 1e-8;

fn is_moved(one: &[Shape], other: &[Shape]) -> bool {
    let Some([a, b]) = frame(one) else {
        return false;
    };
    let Some(motion) = Motion::onto([&one[a], &one[b]], [&other[a], &other[b]]) else {
        return false;
    };
    let extents = one.iter().chain(other).map(Shape::extent);
    let size = extents.fold(0.0, f64::max);
    let near = |a: [f64; 2], b: [f64; 2], size: f64| {
        (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) <= SAME * size
    };
    one.iter().zip(other).all(|(s, o)| match (motion.of(s), o) {
        (Shape::Point(p), Shape::Point(q)) => near(p, *q, size),
        (
            Shape::Line {
                direction: d,
                offset: h,
            },
            Shape::Line {
                direction: e,
                offset: k,
            },
        ) => near(d, *e, 1.0) && (h - k).abs() <= SAME * size,
        _ => false,
    })
}

/// Two elements that fix a motion: the two points that are farthest apart from the first, or a point and a line.
fn frame(shapes: &[Shape]) -> Option<[usize; 2]> {
    let point = |e: &usize| matches!(shapes[*e], Shape::Point(_));
    let first = (0..shapes.len()).find(point)?;
    let far = |e: &usize| match (&shapes[first], &shapes[*e]) {
        (Shape::Point(p), Shape::Point(q)) => (p[0] - q[0]).hypot(p[1] - q[1]),
        _ => 0.0,
    };
    let second = (0..shapes.len())
        .filter(point)
        .max_by(|a, b| far(a).total_cmp(&far(b)));
    let second = second.filter(|e| far(e) > 0.0);
    let line = (0..shapes.len()).find(|e| !point(e));
    second.or(line).map(|second| [first, second])
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::construction::Construction;
    use crate::samples::Random;
    use crate::sketch::{Constraint, Element};
    use kutzbach_math::number::Number;

    /// Lines through two points, lines at an angle with one through a point, and points on lines or off them, one after the other.
    fn random_sketch(random: &mut Random, count: usize) -> Sketch {
        let unit = |random: &mut Random| 10.0 * random.unit() - 5.0;
        let mut elements: Vec<Element> = Vec::new();
        let mut ends: Vec<[usize; 2]> = vec![[0, 1]];
        for _ in 0..2 {
            elements.push(Element::Point([unit(random), unit(random)]));
        }
        let at = |e: &Element| match *e {
            Element::Point(p) => (p, [0.0; 2]),
            Element::Line { through, direction } => (through, direction),
        };
        while elements.len() < count {
            let new = elements.len();
            let pick = |random: &mut Random, line: bool, not: usize| loop {
                let e = random.below(new);
                if elements[e].is_line() == line && e != not {
                    break e;
                }
            };
            let lines = elements.iter().any(Element::is_line);
            let p = pick(random, false, new);
            match random.below(if lines { 4 } else { 2 }) {
                0 => {
                    let q = pick(random, false, p);
                    elements.push(Element::Point([unit(random), unit(random)]));
                    ends.extend([[p, new], [q, new]]);
                }
                1 => {
                    let q = pick(random, false, p);
                    let [(a, _), (b, _)] = [p, q].map(|e| at(&elements[e]));
                    let direction = [b[0] - a[0], b[1] - a[1]];
                    let through = a;
                    elements.push(Element::Line { through, direction });
                    ends.extend([[p, new], [q, new]]);
                }
                2 => {
                    let l = pick(random, true, new);
                    let (through, d) = at(&elements[l]);
                    // On the line, or beside it.
                    let (t, off) = (unit(random), random.below(3) as f64 * 0.3);
                    let off = if random.below(2) == 0 { 0.0 } else { off };
                    let place = [0, 1].map(|k| through[k] + t * d[k] + off * [-d[1], d[0]][k]);
                    elements.push(Element::Point(place));
                    ends.extend([[p, new], [l, new]]);
                }
                _ => {
                    let l = pick(random, true, new);
                    let (through, _) = at(&elements[p]);
                    let direction = [unit(random), unit(random)];
                    elements.push(Element::Line { through, direction });
                    ends.extend([[p, new], [l, new]]);
                }
            }
        }
        let value = |&[u, v]: &[usize; 2]| {
            let [a, b] = [u, v].map(|e| Shape::drawn(&elements[e]));
            let value = Construction::value_between(&a, &b);
            // What lies on a line to rounding lies on it.
            let value = if value.abs() < 1e-9 { 0.0 } else { value };
            Constraint {
                ends: [u, v],
                value: Number::from_f64(value).unwrap(),
            }
        };
        let constraints = ends.iter().map(value).collect();
        Sketch::new(elements, constraints).unwrap()
    }

    #[test]
    fn figures_are_counted_once_whatever_the_senses_of_lines() {
        let mut random = Random::new(9);
        let mut fewer = 0;
        for round in 0..200 {
            let directed = random_sketch(&mut random, 7);
            let sketch = directed.clone().of_figures();
            let (Ok(all), Ok(once)) = (Construction::new(&directed), Construction::new(&sketch))
            else {
                continue;
            };
            let free = free(&sketch);
            let mut figures: Vec<Vec<Shape>> = Vec::new();
            for solution in all.solutions() {
                if !figures
                    .iter()
                    .any(|f| same_figure(f, &solution.shapes, &free))
                {
                    figures.push(solution.shapes);
                }
            }
            let count = all.count();
            if !count.complete || count.degenerate || count.between.is_some() {
                continue;
            }
            assert_eq!(once.count().value(), Some(figures.len() as u128), "{round}");
            fewer += usize::from(count.value() != once.count().value());
        }
        assert!(fewer > 60, "{fewer}");
    }

    #[test]
    fn figures_are_the_same_up_to_motions_and_free_senses() {
        let line = |direction, offset| Shape::Line { direction, offset };
        let one = [
            Shape::Point([0.0, 0.0]),
            Shape::Point([2.0, 0.0]),
            line([0.6, 0.8], 1.0),
        ];
        // Turned by a right angle and shifted by (1, 1); the normal (−0.8, 0.6) becomes (−0.6, −0.8).
        let other = [
            Shape::Point([1.0, 1.0]),
            Shape::Point([1.0, 3.0]),
            line([-0.8, 0.6], 1.0 - 0.6 - 0.8),
        ];
        assert!(same_figure(&one, &other, &[]));
        let turned = [other[0], other[1], round(&other[2])];
        assert!(!same_figure(&one, &turned, &[]));
        assert!(same_figure(&one, &turned, &[vec![2]]));
        let mirrored = [one[0], one[1], line([0.6, -0.8], -1.0)];
        assert!(!same_figure(&one, &mirrored, &[vec![2]]));
    }
}
