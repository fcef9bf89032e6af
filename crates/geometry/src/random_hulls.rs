//! Random hulls of integers, beside all planes through three points that have the others on one side.

use crate::random_tests::{Whole, determinant, difference, exact, product, tolerant};
use crate::{Boundary, Certainty, Found, Place, Point, Scalar, classify_in_solid, space_hull};
use kutzbach_math::matrix::SplitMix64;
use std::collections::BTreeSet;

const CASES: usize = 1_000;

fn gcd(a: i128, b: i128) -> i128 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// The supporting planes of three points or more: the normal outwards, as short as integers allow, and the height.
fn planes(points: &[Whole]) -> BTreeSet<(Whole, i128)> {
    let mut planes = BTreeSet::new();
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate().skip(i + 1) {
            for c in points.iter().skip(j + 1) {
                let (u, v) = (difference(*b, *a), difference(*c, *a));
                let part = |i: usize, j: usize| u[i] * v[j] - u[j] * v[i];
                let normal = [part(1, 2), part(2, 0), part(0, 1)];
                let shared = normal.iter().fold(0, |g, x| gcd(g, *x));
                if shared == 0 {
                    continue;
                }
                let normal = normal.map(|x| x / shared);
                let height = product(normal, *a);
                let heights: Vec<i128> = points.iter().map(|p| product(normal, *p)).collect();
                if heights.iter().all(|h| *h <= height) {
                    planes.insert((normal, height));
                }
                if heights.iter().all(|h| *h >= height) {
                    planes.insert((normal.map(|x| -x), -height));
                }
            }
        }
    }
    planes
}

/// The points at which three supporting planes meet that have nothing else in common.
fn vertices(points: &[Whole], planes: &BTreeSet<(Whole, i128)>) -> BTreeSet<Whole> {
    let is_vertex = |point: &Whole| {
        let tight: Vec<Whole> = planes
            .iter()
            .filter(|(normal, height)| product(*normal, *point) == *height)
            .map(|(normal, _)| *normal)
            .collect();
        tight.iter().enumerate().any(|(i, a)| {
            tight.iter().enumerate().skip(i + 1).any(|(j, b)| {
                let mut others = tight.iter().skip(j + 1);
                others.any(|c| determinant([*a, *b, *c]) != 0)
            })
        })
    };
    points.iter().filter(|p| is_vertex(p)).copied().collect()
}

/// Whether every point belongs to the solid, and each vertex is one of those that are needed.
fn check<S: Scalar>(
    points: &[Whole],
    solid: &Boundary<S>,
    planes: &BTreeSet<(Whole, i128)>,
    numbers: impl Fn(Whole) -> [S; 3],
) {
    let needed = vertices(points, planes);
    assert_eq!(solid.faces().len(), planes.len(), "{points:?}");
    assert_eq!(solid.vertices().len(), needed.len(), "{points:?}");
    for vertex in solid.vertices() {
        let at = vertex.0.each_ref().map(|x| x.double() as i128);
        assert!(needed.contains(&at), "{points:?} {at:?}");
    }
    let count = solid.vertices().len() + solid.faces().len();
    assert_eq!(count, solid.edges().len() + 2, "{points:?}");
    for edge in 0..solid.edges().len() {
        let bend = solid.convex(edge).expect("valid by construction");
        assert!(bend.is_yes(), "{points:?}");
    }
    for point in points.iter().take(3) {
        let found = classify_in_solid(&Point(numbers(*point)), solid);
        let found = found.expect("valid by construction");
        let is_tight = |(normal, height): &(Whole, i128)| product(*normal, *point) == *height;
        let expected = match planes.iter().any(is_tight) {
            true => Place::OnBorder,
            false => Place::Inside,
        };
        assert_eq!(found.value, expected, "{points:?} {point:?}");
    }
}

#[test]
fn hulls_have_the_supporting_planes_of_their_points() {
    let mut random = SplitMix64::new(566);
    let mut solids = 0;
    for _ in 0..CASES {
        // Few places for many points: many of them in one plane, on one line, or equal.
        let size = 2 + random.next_u64() % 4;
        let count = 4 + random.next_u64() % 8;
        let mut points: Vec<Whole> = Vec::new();
        for _ in 0..count {
            points.push([0; 3].map(|_: i128| i128::from(random.next_u64() % size)));
        }
        let by_fractions: Vec<_> = points.iter().map(|p| Point(exact(*p))).collect();
        let by_doubles: Vec<_> = points.iter().map(|p| Point(tolerant(*p))).collect();
        let found = space_hull(&by_fractions).expect("valid by construction");
        let doubles = space_hull(&by_doubles).expect("valid by construction");
        assert_eq!(found.certainty, Certainty::Proven, "{points:?}");
        assert_eq!(doubles.certainty, Certainty::Proven, "{points:?}");
        let planes = planes(&points);
        match (found.value, doubles.value) {
            (Found::Boundary(solid), Found::Boundary(other)) => {
                solids += 1;
                check(&points, &solid, &planes, exact);
                check(&points, &other, &planes, tolerant);
            }
            // In one plane, that plane is supporting from both sides, or no three points span one.
            (Found::Face(_), Found::Face(_)) => assert_eq!(planes.len(), 2, "{points:?}"),
            (Found::Segment(_), Found::Segment(_)) | (Found::Point(_), Found::Point(_)) => {
                assert!(planes.is_empty(), "{points:?}");
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(solids > CASES / 2, "{solids}");
}
