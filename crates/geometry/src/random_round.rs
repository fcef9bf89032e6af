//! Random circles, cylinders, cones and spheres of integers, beside squares of integers.

use crate::random_tests::{
    Whole, dependent, difference, exact, not_zero, product, shaken, tolerant, triple,
};
use crate::{
    Answer, Certainty, Circle, Cone, Cylinder, Direction, Entity, Line, Place, Plane, Point,
    Scalar, Sphere, classify_by_round, coaxial, coincide, concentric, contained, distance,
    intersection, parallel, perpendicular,
};
use kutzbach_math::matrix::SplitMix64;
use kutzbach_math::number::Number;
use std::cmp::Ordering;

const CASES: usize = 10_000;

/// Predicates that are asked of each case.
const PREDICATES: usize = 17;

/// What a case is about: a point, a place, a direction, another, and a radius.
struct Case {
    point: Whole,
    centre: Whole,
    along: Whole,
    other: Whole,
    radius: i128,
}

impl Case {
    fn new(random: &mut SplitMix64) -> Self {
        let along = not_zero(random);
        let mut case = Self {
            point: triple(random),
            centre: triple(random),
            along,
            other: not_zero(random),
            radius: 1 + i128::from(random.next_u64() % 3),
        };
        // Points on a cylinder, axes and circles that coincide are rare by chance.
        match random.next_u64() % 6 {
            0 => case.other = along.map(|x| -x),
            1 => case.point = [0, 1, 2].map(|i| case.centre[i] + case.along[i]),
            2 => {
                case.along = [0, 0, 2];
                case.point = [case.centre[0] + case.radius, case.centre[1], case.point[2]];
            }
            // As high above an apex as a circle on the cone is.
            3 => {
                (case.along, case.other) = ([0, 0, 1], [0, 0, -2]);
                case.point = [case.centre[0], case.centre[1], case.centre[2] + 1];
            }
            4 => (case.other, case.point) = (case.along, case.centre),
            _ => {}
        }
        case
    }

    /// The square of the offset of the point, its product with the direction, and the square of the direction.
    fn numbers(&self) -> (i128, i128, i128) {
        let offset = difference(self.point, self.centre);
        (
            product(offset, offset),
            product(offset, self.along),
            product(self.along, self.along),
        )
    }
}

struct Made<S> {
    point: Point<S>,
    line: Entity<S>,
    /// The plane through the point across the other direction.
    plane: Entity<S>,
    /// The circle about the point across the other direction, of the same radius.
    other_circle: Entity<S>,
    circle: Entity<S>,
    cylinder: Entity<S>,
    cone: Entity<S>,
    sphere: Entity<S>,
}

fn made<S: Scalar>(case: &Case, mut numbers: impl FnMut(Whole) -> [S; 3]) -> Option<Made<S>> {
    let point = Point(numbers(case.point));
    let centre = Point(numbers(case.centre));
    let along = Direction::new(numbers(case.along)).ok()?;
    let other = Direction::new(numbers(case.other)).ok()?;
    let [radius, ..] = numbers([case.radius, 0, 0]);
    let axis = Line::new(centre.clone(), along.clone());
    Some(Made {
        line: Line::new(point.clone(), other.clone()).into(),
        plane: Plane::new(point.clone(), other.clone()).into(),
        other_circle: Circle::new(point.clone(), other, radius.clone())
            .ok()?
            .into(),
        circle: Circle::new(centre.clone(), along.clone(), radius.clone())
            .ok()?
            .into(),
        cylinder: Cylinder::new(axis, radius.clone()).ok()?.into(),
        cone: Cone::new(centre.clone(), along, radius.clone())
            .ok()?
            .into(),
        sphere: Sphere::new(centre, radius).ok()?.into(),
        point,
    })
}

fn place(order: Ordering) -> Place {
    match order {
        Ordering::Less => Place::Inside,
        Ordering::Equal => Place::OnBorder,
        Ordering::Greater => Place::Outside,
    }
}

/// Places beside a sphere, a cylinder and a cone.
fn places(case: &Case) -> [Place; 3] {
    let (square, way, size) = case.numbers();
    let limit = case.radius * case.radius;
    // The square of the distance from the axis, times that of the direction (Lagrange).
    let away = square * size - way * way;
    let cone = match way < 0 {
        true => Place::Outside,
        false => place(away.cmp(&(limit * way * way))),
    };
    [
        place(square.cmp(&limit)),
        place(away.cmp(&(limit * size))),
        cone,
    ]
}

/// Answers beside what the integers say.
fn answers<S: Scalar>(case: &Case, made: &Made<S>) -> Vec<(&'static str, Answer, bool)> {
    let (square, way, _) = case.numbers();
    let [sphere, cylinder, cone] = places(case).map(|place| place == Place::OnBorder);
    let on_circle = way == 0 && square == case.radius * case.radius;
    let offset = difference(case.point, case.centre);
    let one_axis = dependent(case.along, case.other) && dependent(offset, case.along);
    let centred = dependent(offset, case.other);
    let point: Entity<S> = made.point.clone().into();
    let (size, limit) = (case.numbers().2, case.radius * case.radius);
    let alike = dependent(case.along, case.other);
    let across = product(case.along, case.other) == 0;
    let (ring, plane, line) = (&made.other_circle, &made.plane, &made.line);
    // From the centre to the point, along the other direction.
    let level = product(offset, case.other) == 0;
    let rows = [
        ("on sphere", contained(&point, &made.sphere), sphere),
        ("on cylinder", contained(&point, &made.cylinder), cylinder),
        ("on cone", contained(&point, &made.cone), cone),
        ("on circle", contained(&point, &made.circle), on_circle),
        ("coaxial", coaxial(&made.line, &made.cylinder), one_axis),
        (
            "coaxial circle",
            coaxial(&made.circle, &made.line),
            one_axis,
        ),
        ("coaxial sphere", coaxial(&made.line, &made.sphere), centred),
        ("concentric", concentric(&point, &made.sphere), square == 0),
        ("parallel axis", parallel(line, &made.cylinder), alike),
        (
            "perpendicular axis",
            perpendicular(line, &made.cone),
            across,
        ),
        ("parallel circles", parallel(ring, &made.circle), alike),
        (
            "line on cylinder",
            contained(line, &made.cylinder),
            alike && cylinder,
        ),
        (
            "circle on cylinder",
            contained(ring, &made.cylinder),
            one_axis,
        ),
        (
            "circle on cone",
            contained(ring, &made.cone),
            // As high above the apex as it takes for the radius: height × tangent = radius, both of which are one number here.
            one_axis && way > 0 && limit * size == limit * way * way,
        ),
        (
            "circle on sphere",
            contained(ring, &made.sphere),
            centred && square == 0,
        ),
        (
            "circle in plane",
            contained(&made.circle, plane),
            alike && level,
        ),
        (
            "coincident circles",
            coincide(ring, &made.circle),
            alike && square == 0,
        ),
    ];
    rows.into_iter()
        .map(|(name, answer, truth)| (name, answer.expect("valid by construction"), truth))
        .collect()
}

#[test]
fn no_answer_about_round_integers_is_wrong() {
    no_answer_is_wrong(CASES);
}

/// `cargo test --lib -- --ignored a_hundred_thousand`
#[test]
#[ignore = "too long for every commit: run by CI, cargo test --lib -- --ignored a_hundred_thousand"]
fn a_hundred_thousand_round_answers_are_right() {
    no_answer_is_wrong(100_000);
    none_contradicts(100_000);
}

/// A line meets a sphere and a cylinder as often as the discriminant of integers says.
fn meets_as_often_as_integers_say(case: &Case, made: &Made<Number>) {
    let offset = difference(case.point, case.centre);
    let limit = case.radius * case.radius;
    // Of the depth along the line: (a, b, c) of a t² + 2 b t + c.
    let sphere = (
        product(case.other, case.other),
        product(offset, case.other),
        product(offset, offset) - limit,
    );
    let of = |x: Whole, y: Whole| {
        // The product of two vectors' parts across the axis, times its square.
        product(x, y) * product(case.along, case.along)
            - product(x, case.along) * product(y, case.along)
    };
    let cylinder = (
        of(case.other, case.other),
        of(offset, case.other),
        of(offset, offset) - limit * product(case.along, case.along),
    );
    for (entity, (a, b, c)) in [(&made.sphere, sphere), (&made.cylinder, cylinder)] {
        let expected = match (a, (b * b - a * c).signum()) {
            // Along the axis: all of it or none.
            (0, _) => usize::from(c == 0),
            (_, -1) => 0,
            (_, 0) => 1,
            _ => 2,
        };
        let found = intersection(&made.line, entity).expect("valid by construction");
        assert_eq!(found.certainty, Certainty::Proven);
        let parts = found.value.parts();
        assert_eq!(parts.len(), expected, "{entity:?} {:?}", made.line);
        for part in parts {
            let Some(part) = part.clone().entity() else {
                panic!("{part:?}");
            };
            assert_eq!(contained(&part, entity), Ok(Answer::Yes), "{part:?}");
        }
    }
}

fn no_answer_is_wrong(cases: usize) {
    let mut random = SplitMix64::new(567);
    let mut held = [0_usize; PREDICATES];
    for index in 0..cases {
        let case = Case::new(&mut random);
        let by_fractions = made(&case, exact).expect("valid by construction");
        let by_doubles = made(&case, tolerant).expect("valid by construction");
        let rows = answers(&case, &by_fractions).into_iter().enumerate();
        for (row, (name, answer, truth)) in rows {
            assert_eq!(
                answer.is_yes(),
                truth,
                "{name}: {:?} {:?}",
                case.point,
                case.centre
            );
            assert_eq!(
                answer.is_no(),
                !truth,
                "{name}: {:?} {:?}",
                case.point,
                case.centre
            );
            held[row] += usize::from(truth);
        }
        for (name, answer, truth) in answers(&case, &by_doubles) {
            let expected = if truth { Answer::Yes } else { Answer::No };
            assert_eq!(
                answer, expected,
                "{name}: {:?} {:?}",
                case.point, case.centre
            );
        }
        if index % 10 == 0 {
            meets_as_often_as_integers_say(&case, &by_fractions);
        }
        let round = [
            &by_fractions.sphere,
            &by_fractions.cylinder,
            &by_fractions.cone,
        ];
        for (entity, expected) in round.into_iter().zip(places(&case)) {
            let found = classify_by_round(&by_fractions.point, entity);
            let found = found.expect("valid by construction");
            assert_eq!(found.value, expected, "{entity:?} {:?}", case.point);
            if index % 10 != 0 {
                continue;
            }
            // A point is at distance 0 where it is on the surface, and nowhere else.
            let far = distance(&by_fractions.point.clone().into(), entity);
            let far = far.expect("valid by construction");
            assert_eq!(far.certainty, Certainty::Proven);
            let touches = Answer::zero(far.value.sign()).is_yes();
            assert_eq!(
                touches,
                expected == Place::OnBorder,
                "{entity:?} {:?}",
                case.point
            );
        }
    }
    assert!(held.iter().all(|count| *count > 5), "{held:?}");
}

#[test]
fn round_answers_within_digits_never_contradict_the_integers() {
    none_contradicts(CASES);
}

fn none_contradicts(cases: usize) {
    let mut random = SplitMix64::new(568);
    let (mut undecided, mut decided) = (0, 0);
    for _ in 0..cases {
        let case = Case::new(&mut random);
        let Some(made) = made(&case, |v| shaken(v, &mut random)) else {
            continue;
        };
        for (name, answer, truth) in answers(&case, &made) {
            let wrong = answer == if truth { Answer::No } else { Answer::Yes };
            assert!(!wrong, "{name}: {:?} {:?}", case.point, case.centre);
            match answer {
                Answer::WithinDigits => undecided += 1,
                _ => decided += 1,
            }
        }
    }
    assert!(undecided > 0 && decided > cases, "{undecided}, {decided}");
}
