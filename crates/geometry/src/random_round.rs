//! Random circles, cylinders, cones and spheres of integers, beside squares of integers.

use crate::random_tests::{
    Whole, dependent, difference, exact, not_zero, product, shaken, tolerant, triple,
};
use crate::{
    Answer, Certainty, Circle, Cone, Cylinder, Direction, Entity, Line, Place, Point, Scalar,
    Sphere, classify_by_round, coaxial, concentric, contained, distance,
};
use kutzbach_math::matrix::SplitMix64;
use std::cmp::Ordering;

const CASES: usize = 5_000;

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
        // Points on a cylinder and axes that coincide are rare by chance.
        match random.next_u64() % 4 {
            0 => case.other = along.map(|x| -x),
            1 => case.point = [0, 1, 2].map(|i| case.centre[i] + case.along[i]),
            2 => {
                case.along = [0, 0, 2];
                case.point = [case.centre[0] + case.radius, case.centre[1], case.point[2]];
            }
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
        line: Line::new(point.clone(), other).into(),
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
    ];
    rows.into_iter()
        .map(|(name, answer, truth)| (name, answer.expect("valid by construction"), truth))
        .collect()
}

#[test]
fn no_answer_about_round_integers_is_wrong() {
    let mut random = SplitMix64::new(567);
    let mut held = [0_usize; 8];
    for index in 0..CASES {
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
    let mut random = SplitMix64::new(568);
    let (mut undecided, mut decided) = (0, 0);
    for _ in 0..CASES {
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
    assert!(undecided > 0 && decided > CASES, "{undecided}, {decided}");
}
