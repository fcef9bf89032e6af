//! Constructions of sketches with known solutions.

use super::*;
use crate::samples::{self, Random};
use crate::sketch::{Constraint, Element};
use kutzbach_math::number::Number;

pub(super) fn points(places: &[[f64; 2]]) -> Vec<Element> {
    places.iter().map(|&p| Element::Point(p)).collect()
}

pub(super) fn sketch(elements: Vec<Element>, constraints: &[(usize, usize, &str)]) -> Sketch {
    let constraint = |&(u, v, value): &(usize, usize, &str)| Constraint {
        ends: [u, v],
        value: Number::expression(value, &mut |_: &str| Ok(None)).unwrap(),
    };
    Sketch::new(elements, constraints.iter().map(constraint).collect()).unwrap()
}

/// A graph drawn at random, its lengths measured there.
fn drawn(edges: &[[usize; 2]], vertices: usize, random: &mut Random) -> Sketch {
    let places: Vec<[f64; 2]> = (0..vertices)
        .map(|_| [random.unit(), random.unit()])
        .collect();
    let length = |[u, v]: [usize; 2]| {
        let [p, q] = [places[u], places[v]];
        (p[0] - q[0]).hypot(p[1] - q[1])
    };
    let constraints = edges.iter().map(|&ends| Constraint {
        ends,
        value: Number::from_f64(length(ends)).unwrap(),
    });
    Sketch::new(points(&places), constraints.collect()).unwrap()
}

#[test]
fn a_triangle_has_two_solutions_and_the_drawn_one_comes_first() {
    let sides = [(0, 1, "4"), (1, 2, "3"), (2, 0, "5")];
    for y in [2.0, -2.0] {
        let sketch = sketch(points(&[[0.0; 2], [4.0, 0.0], [4.0, y]]), &sides);
        let construction = Construction::new(&sketch).unwrap();
        assert_eq!(construction.count().value(), Some(2));
        let all: Vec<Solution> = construction.solutions().collect();
        let area = |s: &Solution| match s.shapes[..] {
            [Shape::Point(a), Shape::Point(b), Shape::Point(c)] => {
                shape::cross(shape::minus(b, a), shape::minus(c, a)) / 2.0
            }
            _ => panic!("three points"),
        };
        assert!((area(&all[0]) - y.signum() * 6.0).abs() < 1e-12);
        assert!((area(&all[1]) + y.signum() * 6.0).abs() < 1e-12);
        assert!(all.iter().all(|s| construction.residual(s) < 1e-14));
    }
}

#[test]
fn what_a_rigid_body_has_is_not_turned_over() {
    let sides = [(0, 1, "4"), (1, 2, "3"), (2, 0, "5")];
    // The body has it on the other side than the drawing.
    let elements = points(&[[0.0; 2], [4.0, 0.0], [4.0, 3.0]]);
    let body = [[4.0, 0.0], [0.0, 0.0], [4.0, -3.0]].map(Element::Point);
    let sketch = sketch(elements, &sides).with_rigid(vec![([1, 0, 2], body)]);
    let construction = Construction::new(&sketch).unwrap();
    assert_eq!(construction.count().value(), Some(1));
    let only: Vec<Solution> = construction.solutions().collect();
    let [Shape::Point(a), Shape::Point(b), Shape::Point(c)] = only[0].shapes[..] else {
        panic!("three points");
    };
    assert!(shape::cross(shape::minus(b, a), shape::minus(c, a)) < 0.0);
}

#[test]
fn flat_triangles_are_double_and_too_long_sides_are_told() {
    let outcome = |side: &str| {
        let sides = [(0, 1, "sqrt(2)"), (1, 2, "sqrt(8)"), (2, 0, side)];
        let sketch = sketch(points(&[[0.0; 2], [1.0, 0.0], [2.0, 0.1]]), &sides);
        let construction = Construction::new(&sketch).unwrap();
        let first = construction.outcomes(construction.drawn_left())[0];
        (
            first,
            construction.count().value(),
            construction.solutions().count(),
        )
    };
    assert_eq!(
        outcome("3*sqrt(2)"),
        (Outcome::Touching { within: 0.0 }, Some(1), 1)
    );
    // Shorter by less than doubles tell.
    let nearly = outcome("3*sqrt(2)-1/10**20");
    assert!(
        matches!(nearly.0, Outcome::Two { by } if by < 1e-19),
        "{nearly:?}"
    );
    let apart = outcome("5");
    assert!(matches!(apart.0, Outcome::Apart { by } if (by - (5.0 - 18_f64.sqrt())).abs() < 1e-14));
    assert_eq!((apart.1, apart.2), (Some(0), 0));
}

#[test]
fn rounded_lengths_that_leave_a_step_open_are_told() {
    let told = |side: &str| {
        let value = |text: &str| Number::decimal(text).unwrap();
        let sides = [(0, 1, "1.25"), (1, 2, "2.50"), (2, 0, side)];
        let constraints = sides.map(|(u, v, text)| Constraint {
            ends: [u, v],
            value: value(text),
        });
        let places = points(&[[0.0; 2], [1.0, 0.0], [2.0, 0.1]]);
        let sketch = Sketch::new(places, constraints.to_vec()).unwrap();
        Construction::new(&sketch).unwrap().left_open_by_rounding()
    };
    // Half a unit of the second place each: 0.015 together.
    assert_eq!(told("3.76"), [0]);
    assert_eq!(told("3.74"), [0]);
    assert!(told("3.77").is_empty());
    assert!(told("3.73").is_empty());
}

#[test]
fn random_sketches_are_constructed_as_drawn() {
    let mut random = Random::new(21);
    for round in 0..60 {
        let n = 4 + random.below(30);
        let graph = match round % 2 {
            0 => samples::henneberg(n, 0, &mut random),
            _ => samples::glued(n, &mut random),
        };
        let sketch = drawn(graph.edges(), n, &mut random);
        let construction = Construction::new(&sketch).unwrap();
        let solution = construction.as_drawn().unwrap();
        assert!(construction.residual(&solution) < 1e-6);
        // Up to how flat triangles carry errors on, every point is where it was drawn.
        for (shape, element) in solution.shapes.iter().zip(sketch.elements()) {
            let (Shape::Point(p), Element::Point(q)) = (shape, element) else {
                panic!("points");
            };
            assert!(
                shape::minus(*p, *q).iter().all(|d| d.abs() < 1e-4),
                "{p:?} {q:?}"
            );
        }
    }
}

#[test]
fn what_is_counted_is_what_all_choices_give() {
    let mut random = Random::new(22);
    let (mut fewer, mut hanging) = (0, 0);
    for _ in 0..80 {
        let n = 4 + random.below(5);
        let graph = samples::glued(n, &mut random);
        let sketch = drawn(graph.edges(), n, &mut random);
        let construction = Construction::new(&sketch).unwrap();
        let steps = n - 2;
        let by_hand = (0_u32..1 << steps)
            .filter(|bits| {
                let left: Vec<bool> = (0..steps).map(|k| bits >> k & 1 == 1).collect();
                construction.with_sides(&left).is_ok()
            })
            .count();
        let count = construction.count();
        assert!(count.complete);
        assert_eq!(count.value(), Some(by_hand as u128), "{graph:?}");
        let listed: Vec<Solution> = construction.solutions().collect();
        assert_eq!(listed.len(), by_hand);
        for (i, one) in listed.iter().enumerate() {
            assert!(listed[..i].iter().all(|other| other.left != one.left));
        }
        fewer += usize::from(by_hand < 1 << steps);
        hanging += usize::from(construction.classes().len() < steps);
    }
    assert!(fewer > 4 && hanging > 10, "{fewer} {hanging}");
}

#[test]
fn a_strip_has_two_to_the_steps() {
    let n = 2000;
    // Equilateral triangles, so that numbers stay small.
    let place = |k: usize| [k as f64 / 2.0, (k % 2) as f64 * 0.75_f64.sqrt()];
    let places: Vec<[f64; 2]> = (0..n).map(place).collect();
    let strip = samples::strip(n);
    let constraints: Vec<(usize, usize, &str)> = strip.iter().map(|e| (e[0], e[1], "1")).collect();
    let sketch = sketch(points(&places), &constraints);
    let construction = Construction::new(&sketch).unwrap();
    assert_eq!(construction.count().to_string(), "2^1998");
    let first: Vec<Solution> = construction.solutions().take(3).collect();
    assert!(first.iter().all(|s| construction.residual(s) < 1e-12));
    let Shape::Point(last) = first[0].shapes[n - 1] else {
        panic!("a point");
    };
    assert!(
        shape::minus(last, place(n - 1))
            .iter()
            .all(|d| d.abs() < 1e-9)
    );
}

#[test]
fn points_and_lines_by_circles_and_lines() {
    let line = |through, direction| Element::Line { through, direction };
    let elements = vec![
        line([0.0, 0.0], [1.0, 0.0]),
        Element::Point([0.0, 0.0]),
        Element::Point([3.0, 2.0]),
        line([0.0, 0.0], [1.0, 1.0]),
        Element::Point([2.0, 2.0]),
        line([0.0, 1.0], [3.0, 2.0]),
    ];
    // A circle and a line; two lines; a line by a point and an angle; a tangent to two circles.
    let constraints = [
        (0, 1, "0"),
        (0, 2, "2"),
        (1, 2, "4"),
        (0, 3, "pi/4"),
        (1, 3, "-1/2"),
        (3, 4, "0"),
        (0, 4, "2"),
        (1, 5, "-1"),
        (2, 5, "1/2"),
    ];
    let sketch = sketch(elements, &constraints);
    let construction = Construction::new(&sketch).unwrap();
    let all: Vec<Solution> = construction.solutions().collect();
    assert_eq!(all.len(), 4);
    assert_eq!(construction.count().value(), Some(4));
    for (i, one) in all.iter().enumerate() {
        assert!(
            construction.residual(one) < 1e-13,
            "{}",
            construction.residual(one)
        );
        assert!(all[..i].iter().all(|other| other.shapes != one.shapes));
    }
    let drawn_side = |e: usize| match (all[0].shapes[1], all[0].shapes[e]) {
        (Shape::Point(p), Shape::Point(q)) => q[0] > p[0],
        _ => panic!("points"),
    };
    assert!(drawn_side(2), "ahead, as drawn");
}

#[test]
fn degenerate_steps_are_told() {
    let line = |direction| Element::Line {
        through: [0.0; 2],
        direction,
    };
    // Three lines by their angles alone, which agree or do not.
    let lines = || vec![line([1.0, 0.0]), line([0.0, 1.0]), line([1.0, 1.0])];
    let angles = [(0, 1, "pi/2"), (0, 2, "pi/4"), (1, 2, "-pi/4")];
    let contradictory = [(0, 1, "pi/2"), (0, 2, "pi/4"), (1, 2, "-pi/3")];
    // A point at two parallel lines.
    let parallel = vec![line([1.0, 0.0]), line([1.0, 0.1]), Element::Point([1.0; 2])];
    let offsets = [(0, 1, "0"), (0, 2, "1"), (1, 2, "2")];
    for (elements, constraints) in [(lines(), angles), (parallel, offsets)] {
        let sketch = sketch(elements, &constraints);
        let construction = Construction::new(&sketch).unwrap();
        let why = construction.as_drawn().unwrap_err();
        assert_eq!((why.step, why.outcome), (0, Outcome::Degenerate));
        let count = construction.count();
        assert!(count.degenerate && count.infinite);
        assert_eq!(count.to_string(), "infinitely many");
    }
    let sketch = sketch(lines(), &contradictory);
    let construction = Construction::new(&sketch).unwrap();
    let why = construction.as_drawn().unwrap_err();
    assert!(
        matches!(why.outcome, Outcome::Apart { by } if (by - std::f64::consts::PI / 12.0).abs() < 1e-14)
    );
    assert_eq!(construction.count().to_string(), "0");
}

/// Two triangles over one base have their tips in one place on the same side, and a fifth point is tied to both.
#[test]
fn coincident_centres_leave_all_of_a_circle_or_nothing() {
    let counted = |one: &str, other: &str| {
        let places = points(&[[0.0; 2], [4.0, 0.0], [1.0, 2.0], [1.0, -2.0], [6.0, 0.0]]);
        let constraints = [
            (0, 1, "4"),
            (0, 2, "3"),
            (1, 2, "3"),
            (0, 3, "3"),
            (1, 3, "3"),
            (2, 4, one),
            (3, 4, other),
        ];
        let sketch = sketch(places, &constraints);
        Construction::new(&sketch).unwrap().count()
    };
    // On other sides the tips are 2 sqrt(5) apart.
    assert_eq!(
        counted("5", "5").to_string(),
        "4, and infinitely many besides"
    );
    assert_eq!(counted("1", "1").to_string(), "infinitely many");
    assert_eq!(counted("5", "4").to_string(), "4");
    assert_eq!(counted("1", "2").to_string(), "0");
}

/// The tips of two triangles over one base are exactly as far apart as the two bars to a fifth point are long together; doubles do
/// not tell. A line through the base, with nothing else on it, takes the exact answer away.
#[test]
fn circles_that_touch_at_derived_lengths_are_decided_or_left_open() {
    let counted = |bar: &str, line: bool| {
        let mut elements = points(&[[0.0; 2], [4.0, 0.0], [2.0, 2.0], [2.0, -2.0], [3.0, 0.0]]);
        let mut constraints = vec![
            (0, 1, "4"),
            (0, 2, "3"),
            (1, 2, "3"),
            (0, 3, "3"),
            (1, 3, "3"),
            (2, 4, bar),
            (3, 4, "2"),
        ];
        if line {
            elements.push(Element::Line {
                through: [0.0; 2],
                direction: [4.0, 1.0],
            });
            constraints.insert(0, (5, 0, "0"));
            constraints.insert(1, (5, 1, "1"));
        }
        let sketch = sketch(elements, &constraints);
        Construction::new(&sketch).unwrap().count().to_string()
    };
    for (bar, exact, left_open) in [
        ("sqrt(20)-2", "2", "from 0 to 8"),
        ("sqrt(20)-2+1/10**20", "4", "from 0 to 8"),
        ("sqrt(20)-2-1/10**20", "0", "from 0 to 8"),
        ("sqrt(20)-2+1/10**6", "4", "8"),
        ("sqrt(20)-2-1/10**6", "0", "0"),
    ] {
        assert_eq!(counted(bar, false), exact, "{bar}");
        assert_eq!(counted(bar, true), left_open, "{bar}");
    }
}

#[test]
fn lengths_of_any_size_are_constructed() {
    for (scale, size) in [("10**80", 1e80), ("1/10**82", 1e-82)] {
        let sides = [(0, 1, 4), (1, 2, 3), (2, 0, 5), (1, 3, 2), (2, 3, 4)];
        let texts: Vec<String> = sides.iter().map(|s| format!("{}*{scale}", s.2)).collect();
        let constraints: Vec<(usize, usize, &str)> = sides
            .iter()
            .zip(&texts)
            .map(|(s, text)| (s.0, s.1, &**text))
            .collect();
        let places = [[0.0; 2], [4.0, 0.0], [4.0, 3.0], [6.0, 0.0]].map(|p| p.map(|x| size * x));
        let sketch = sketch(points(&places), &constraints);
        let construction = Construction::new(&sketch).unwrap();
        let all: Vec<Solution> = construction.solutions().collect();
        assert_eq!(
            (construction.count().value(), all.len()),
            (Some(4), 4),
            "{scale}"
        );
        for solution in &all {
            assert!(construction.residual(solution) < 1e-14 * size, "{scale}");
        }
    }
}

/// Impossible choices of one class spoil lengths that another one measures: all choices are tried one by one here.
#[test]
fn counts_are_those_of_brute_force() {
    let mut random = Random::new(24);
    let (mut fewer, mut none) = (0, 0);
    for round in 0..400 {
        let n = 5 + random.below(7);
        let graph = match round % 2 {
            0 => samples::glued(n, &mut random),
            _ => samples::henneberg(n, 0, &mut random),
        };
        let mut sketch = drawn(graph.edges(), n, &mut random);
        if round % 5 == 0 {
            // Lengths that belong to no drawing.
            let constraints = sketch.constraints().iter().map(|c| Constraint {
                ends: c.ends,
                value: Number::from_f64(0.5 + random.unit()).unwrap(),
            });
            sketch = Sketch::new(sketch.elements().to_vec(), constraints.collect()).unwrap();
        }
        let construction = Construction::new(&sketch).unwrap();
        let steps = n - 2;
        let by_hand = (0_u32..1 << steps)
            .filter(|bits| {
                let left: Vec<bool> = (0..steps).map(|k| bits >> k & 1 == 1).collect();
                construction.with_sides(&left).is_ok()
            })
            .count();
        let count = construction.count();
        assert!(count.complete && count.between.is_none(), "{round}");
        assert_eq!(count.value(), Some(by_hand as u128), "{round}: {graph:?}");
        if round % 8 == 0 {
            assert_eq!(construction.solutions().count(), by_hand, "{round}");
        }
        fewer += usize::from(by_hand < 1 << steps);
        none += usize::from(by_hand == 0);
    }
    assert!(fewer > 100 && none > 5, "{fewer} {none}");
}

#[test]
fn what_is_not_constructive_says_why() {
    let mut random = Random::new(23);
    let mut why = |name: &str| {
        let graph = samples::named(name).unwrap();
        let sketch = drawn(graph.edges(), graph.vertices(), &mut random);
        Construction::new(&sketch).err().unwrap().to_string()
    };
    assert_eq!(
        why("K4"),
        "1 constraints too many: constraint 5 follows from those before it among 4 elements"
    );
    assert_eq!(why("bow tie"), "1 freedoms are left between 2 rigid parts");
    assert_eq!(
        why("prism"),
        "not by ruler and compass: 5 clusters are left that do not merge"
    );
}

#[test]
fn elements_move_in_proportion_in_chains() {
    let moved = |sketch: &Sketch| {
        let construction = Construction::new(sketch).unwrap();
        (construction.reduction().steps + construction.moved()) as f64
    };
    for family in [samples::strip_sketch, samples::tied_sketch] {
        let growth = moved(&family(8000)) / moved(&family(1000));
        assert!(growth < 12.0, "{growth}");
    }
}

#[test]
fn a_count_that_would_take_too_long_is_a_bound() {
    let sketch = samples::tied_sketch(400);
    let construction = Construction::new(&sketch).unwrap();
    let count = construction.count();
    assert!(!count.complete && count.value().is_none_or(|v| v > 0));
    assert!(count.to_string().starts_with("at least "));
    // The drawn solution is there, and the first.
    let first = construction.solutions().next().unwrap();
    assert_eq!(first.left, construction.drawn_left());
    assert!(construction.residual(&first) < 1e-9);
}
