//! Random small integers against determinants of integers: no answer may be wrong.

use crate::{
    Answer, Direction, Entity, Found, GeometryError, Line, Measured, Plane, Point, Scalar, Segment,
    coincide, colinear, contained, coplanar, intersection, parallel, perpendicular,
};
use kutzbach_math::matrix::SplitMix64;
use kutzbach_math::number::Number;

const CASES: usize = 10_000;

/// Predicates that are asked of each case.
const PREDICATES: usize = 25;

pub(crate) type Whole = [i128; 3];

pub(crate) fn exact(v: Whole) -> [Number; 3] {
    v.map(|x| Number::integer(x as i64))
}

pub(crate) fn tolerant(v: Whole) -> [Measured; 3] {
    v.map(|x| Measured::new(x as f64, 0.0).expect("valid by construction"))
}

/// Numbers within a hundredth of the integers, and as uncertain: the integers are among what they may be.
pub(crate) fn shaken(v: Whole, random: &mut SplitMix64) -> [Measured; 3] {
    v.map(|x| {
        Measured::new(x as f64 + 0.01 * random.symmetric(), 0.0101).expect("valid by construction")
    })
}

pub(crate) fn component(random: &mut SplitMix64) -> i128 {
    i128::from(random.next_u64() % 5) - 2
}

pub(crate) fn triple(random: &mut SplitMix64) -> Whole {
    [component(random), component(random), component(random)]
}

pub(crate) fn not_zero(random: &mut SplitMix64) -> Whole {
    loop {
        let v = triple(random);
        if v != [0, 0, 0] {
            return v;
        }
    }
}

/// The determinant of three rows, by the rule of Sarrus: no product of vectors is shared with the library.
pub(crate) fn determinant([a, b, c]: [Whole; 3]) -> i128 {
    a[0] * b[1] * c[2] + a[1] * b[2] * c[0] + a[2] * b[0] * c[1]
        - a[2] * b[1] * c[0]
        - a[0] * b[2] * c[1]
        - a[1] * b[0] * c[2]
}

/// Whether two rows are of rank one at most: all minors of two columns are zero.
pub(crate) fn dependent(a: Whole, b: Whole) -> bool {
    [(0, 1), (0, 2), (1, 2)]
        .into_iter()
        .all(|(i, j)| a[i] * b[j] == a[j] * b[i])
}

pub(crate) fn product(a: Whole, b: Whole) -> i128 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

pub(crate) fn difference(a: Whole, b: Whole) -> Whole {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// What the four random vectors of a case say: two points, two vectors that are not zero.
struct Case {
    p: Whole,
    q: Whole,
    u: Whole,
    v: Whole,
}

impl Case {
    fn new(random: &mut SplitMix64) -> Self {
        let mut case = Self {
            p: triple(random),
            q: triple(random),
            u: not_zero(random),
            v: not_zero(random),
        };
        // By chance alone lines would coincide in one case of a thousand.
        let choice = random.next_u64();
        if choice.is_multiple_of(4) {
            case.v = case.u.map(|x| -x);
        }
        if choice.is_multiple_of(7) {
            case.v = case.u;
        }
        if choice.is_multiple_of(3) {
            case.q = [0, 1, 2].map(|i| case.p[i] + case.u[i]);
        }
        if choice.is_multiple_of(5) {
            case.q = case.p;
        }
        case
    }
}

/// The entities of a case in one of the forms; `None` where their digits do not tell a direction from zero.
struct Made<S> {
    point: Entity<S>,
    other_point: Entity<S>,
    direction: Entity<S>,
    other_direction: Entity<S>,
    first: Entity<S>,
    second: Entity<S>,
    /// From the second point along the second vector.
    segment: Entity<S>,
    /// From the first point along the first.
    other_segment: Entity<S>,
    plane: Entity<S>,
    other_plane: Entity<S>,
}

fn made<S: Scalar>(case: &Case, mut numbers: impl FnMut(Whole) -> [S; 3]) -> Option<Made<S>> {
    let (p, q) = (Point(numbers(case.p)), Point(numbers(case.q)));
    let u = Direction::new(numbers(case.u)).ok()?;
    let v = Direction::new(numbers(case.v)).ok()?;
    let sum = |a: Whole, b: Whole| [0, 1, 2].map(|i| a[i] + b[i]);
    let segment = Segment::new(q.clone(), Point(numbers(sum(case.q, case.v)))).ok()?;
    let other_segment = Segment::new(p.clone(), Point(numbers(sum(case.p, case.u)))).ok()?;
    Some(Made {
        point: p.clone().into(),
        other_point: q.clone().into(),
        direction: u.clone().into(),
        other_direction: v.clone().into(),
        other_segment: other_segment.into(),
        first: Line::new(p.clone(), u.clone()).into(),
        second: Line::new(q.clone(), v.clone()).into(),
        segment: segment.into(),
        plane: Plane::new(q, v).into(),
        other_plane: Plane::new(p, u).into(),
    })
}

type Row = (&'static str, Result<Answer, GeometryError>, bool);

/// Predicates of directions beside what the integers say.
fn of_directions<S: Scalar>(case: &Case, made: &Made<S>) -> Vec<Row> {
    let (line, plane) = (&made.first, &made.plane);
    let alike = dependent(case.u, case.v);
    let across = product(case.u, case.v) == 0;
    vec![
        ("parallel lines", parallel(line, &made.second), alike),
        ("parallel line, plane", parallel(line, plane), across),
        ("parallel planes", parallel(plane, &made.other_plane), alike),
        (
            "perpendicular lines",
            perpendicular(line, &made.segment),
            across,
        ),
        (
            "perpendicular line, plane",
            perpendicular(line, plane),
            alike,
        ),
        (
            "perpendicular planes",
            perpendicular(plane, &made.other_plane),
            across,
        ),
        (
            "parallel direction, segment",
            parallel(&made.direction, &made.segment),
            alike,
        ),
        (
            "coincident directions",
            coincide(&made.direction, &made.other_direction),
            alike && product(case.u, case.v) > 0,
        ),
    ]
}

/// Predicates of places beside what the integers say.
fn of_places<S: Scalar>(case: &Case, made: &Made<S>) -> Vec<Row> {
    let Case { p, q, u, v } = *case;
    let (offset, back) = (difference(q, p), difference(p, q));
    let way = product(back, v);
    let on_line = dependent(back, v);
    let on_segment = on_line && way >= 0 && way <= product(v, v);
    let in_plane = product(back, v) == 0;
    let one_line = dependent(u, v) && dependent(offset, u);
    let one_plane = dependent(u, v) && in_plane;
    let flat = determinant([offset, u, v]) == 0;
    let (point, line, plane) = (&made.point, &made.first, &made.plane);
    let (second, segment) = (&made.second, &made.segment);
    let along_plane = product(u, v) == 0;
    vec![
        ("coincident lines", coincide(line, second), one_line),
        (
            "coincident planes",
            coincide(plane, &made.other_plane),
            one_plane,
        ),
        ("colinear line, segment", colinear(line, segment), one_line),
        ("colinear point, line", colinear(point, second), on_line),
        ("coplanar lines", coplanar(line, second), flat),
        ("contained in line", contained(point, second), on_line),
        (
            "contained in segment",
            contained(point, segment),
            on_segment,
        ),
        ("contained in plane", contained(point, plane), in_plane),
        (
            "line contained in plane",
            contained(line, plane),
            along_plane && in_plane,
        ),
    ]
}

/// Predicates of two points and of segments beside what the integers say.
fn of_segments<S: Scalar>(case: &Case, made: &Made<S>) -> Vec<Row> {
    let Case { p, q, u, v } = *case;
    let (from, to) = (p, [0, 1, 2].map(|i| p[i] + u[i]));
    let ends = (q, [0, 1, 2].map(|i| q[i] + v[i]));
    let one_line = dependent(u, v) && dependent(difference(q, p), u);
    let within = |end: Whole| {
        let way = product(difference(end, p), u);
        way >= 0 && way <= product(u, u)
    };
    let level = product(difference(q, p), u) == 0 && product(u, v) == 0;
    let one_plane = dependent(u, v) && product(difference(q, p), u) == 0;
    let (own, other) = (&made.segment, &made.other_segment);
    vec![
        (
            "coincident points",
            coincide(&made.point, &made.other_point),
            p == q,
        ),
        (
            "coincident segments",
            coincide(own, other),
            (from, to) == ends || (to, from) == ends,
        ),
        ("colinear segments", colinear(own, other), one_line),
        (
            "segment contained in line",
            contained(own, &made.first),
            one_line,
        ),
        (
            "segment contained in segment",
            contained(own, other),
            one_line && within(ends.0) && within(ends.1),
        ),
        (
            "segment contained in plane",
            contained(own, &made.other_plane),
            level,
        ),
        (
            "coplanar planes",
            coplanar(&made.plane, &made.other_plane),
            one_plane,
        ),
        (
            "coplanar segment, plane",
            coplanar(own, &made.other_plane),
            level,
        ),
    ]
}

/// Every predicate of a case beside what the integers say.
fn answers<S: Scalar>(case: &Case, made: &Made<S>) -> Vec<(&'static str, Answer, bool)> {
    of_directions(case, made)
        .into_iter()
        .chain(of_places(case, made))
        .chain(of_segments(case, made))
        .map(|(name, answer, truth)| (name, answer.expect("valid by construction"), truth))
        .collect()
}

fn no_answer_is_wrong(cases: usize) {
    let mut random = SplitMix64::new(56);
    let mut held = [0_usize; PREDICATES];
    for _ in 0..cases {
        let case = Case::new(&mut random);
        let (p, q, u, v) = (case.p, case.q, case.u, case.v);
        let by_fractions = answers(&case, &made(&case, exact).expect("valid by construction"));
        let by_doubles = answers(
            &case,
            &made(&case, tolerant).expect("valid by construction"),
        );
        for (row, (name, answer, truth)) in by_fractions.into_iter().chain(by_doubles).enumerate() {
            let expected = if truth { Answer::Yes } else { Answer::No };
            assert_eq!(answer, expected, "{name}: {p:?} {q:?} {u:?} {v:?}");
            held[row % PREDICATES] += usize::from(truth);
        }
    }
    // Every predicate was seen to hold, in both forms.
    assert!(held.iter().all(|count| *count > cases / 100), "{held:?}");
}

#[test]
fn no_answer_about_integers_is_wrong() {
    no_answer_is_wrong(CASES);
}

/// `cargo test --lib -- --ignored a_hundred_thousand`
#[test]
#[ignore = "too long for every commit: run by CI, cargo test --lib -- --ignored a_hundred_thousand"]
fn a_hundred_thousand_answers_are_right() {
    no_answer_is_wrong(100_000);
    none_contradicts(100_000);
}

#[test]
fn answers_within_digits_never_contradict_the_integers() {
    none_contradicts(CASES);
}

fn none_contradicts(cases: usize) {
    let mut random = SplitMix64::new(57);
    let (mut undecided, mut decided) = (0, 0);
    for _ in 0..cases {
        let case = Case::new(&mut random);
        let Some(made) = made(&case, |v| shaken(v, &mut random)) else {
            continue;
        };
        for (name, answer, truth) in answers(&case, &made) {
            let (p, q, u, v) = (case.p, case.q, case.u, case.v);
            let wrong = answer == if truth { Answer::No } else { Answer::Yes };
            assert!(!wrong, "{name}: {p:?} {q:?} {u:?} {v:?}");
            match answer {
                Answer::WithinDigits => undecided += 1,
                _ => decided += 1,
            }
        }
    }
    assert!(
        undecided > cases / 2 && decided > cases,
        "{undecided}, {decided}"
    );
}

#[test]
fn points_of_lines_and_planes_are_fractions() {
    let mut random = SplitMix64::new(58);
    let mut met = 0;
    for _ in 0..CASES {
        let case = Case::new(&mut random);
        let made = made(&case, exact).expect("valid by construction");
        let found = intersection(&made.first, &made.plane)
            .expect("valid by construction")
            .value;
        let rise = product(case.u, case.v);
        let height = product(difference(case.q, case.p), case.v);
        match found {
            Found::Point(Point(x)) => {
                met += 1;
                for (i, found) in x.iter().enumerate() {
                    let numerator = case.p[i] * rise + case.u[i] * height;
                    let expected = Number::ratio(numerator as i64, rise as i64)
                        .expect("valid by construction");
                    assert_eq!(*found, expected);
                }
            }
            Found::Line(_) => assert!(rise == 0 && height == 0),
            Found::Nothing => assert!(rise == 0 && height != 0),
            other => panic!("{other:?}"),
        }
    }
    assert!(met > CASES / 2);
}
