//! Hulls in space, whole and degenerate.

use super::{EXACT, TOLERANT, Three, With, box_corners};
use crate::{
    Boundary, Certainty, Found, Measured, Outcome, Place, Point, Scalar, classify_in_solid,
    space_hull,
};
use kutzbach_math::number::Number;

impl<S: Scalar> With<S> {
    fn hull(&self, points: &[Three]) -> Outcome<Found<S>> {
        let points: Vec<Point<S>> = points.iter().map(|c| self.at(*c)).collect();
        space_hull(&points).expect("valid by construction")
    }

    fn solid_hull(&self, points: &[Three]) -> Boundary<S> {
        let outcome = self.hull(points);
        assert_eq!(outcome.certainty, Certainty::Proven);
        match outcome.value {
            Found::Boundary(solid) => solid,
            other => panic!("{other:?}"),
        }
    }

    fn hulls_in_space(&self) {
        // A box with points inside, on faces, on edges and twice, among the first of them.
        let mut points = vec![[1, 1, 0], [1, 1, 1], [0, 0, 1], [1, 1, 1]];
        points.extend(box_corners([0, 0, 0], [2, 2, 2]));
        points.extend([[1, 0, 0], [2, 2, 2], [2, 1, 1], [2, 2, 1], [1, 2, 1]]);
        let cube = self.solid_hull(&points);
        assert_eq!((cube.vertices().len(), cube.edges().len()), (8, 12));
        assert_eq!(cube.faces().len(), 6);
        assert!(cube.is_solid());
        for face in cube.faces() {
            assert_eq!(face.loops().len(), 1);
            assert_eq!(face.loops()[0].len(), 4);
        }
        for edge in 0..cube.edges().len() {
            assert!(cube.convex(edge).expect("valid by construction").is_yes());
        }
        let inside = classify_in_solid(&self.at([1, 1, 1]), &cube);
        assert_eq!(inside.expect("valid by construction").value, Place::Inside);
        // An octahedron, from its corners and its middle.
        let octahedron = self.solid_hull(&[
            [0, 0, 0],
            [1, 0, 0],
            [-1, 0, 0],
            [0, 1, 0],
            [0, -1, 0],
            [0, 0, 1],
            [0, 0, -1],
        ]);
        let counts = (octahedron.vertices().len(), octahedron.faces().len());
        assert_eq!(counts, (6, 8));
        // A pyramid: its base has been taken for two triangles on the way.
        let pyramid = self.solid_hull(&[[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 5], [4, 4, 0]]);
        let counts = (pyramid.vertices().len(), pyramid.faces().len());
        assert_eq!(counts, (5, 5));
    }

    fn hulls_of_less_than_space(&self) {
        let square = [[0, 0, 3], [2, 0, 3], [1, 1, 3], [2, 2, 3], [0, 2, 3]];
        let expected = self.face(&[&[[0, 0, 3], [2, 0, 3], [2, 2, 3], [0, 2, 3]]]);
        self.are_found(&self.hull(&square), &[expected], "in a plane");
        let line = [[1, 1, 1], [3, 3, 3], [-1, -1, -1], [0, 0, 0]];
        let expected = self.segment([-1, -1, -1], [3, 3, 3]);
        self.are_found(&self.hull(&line), &[expected], "on a line");
        let one = [[1, 2, 3], [1, 2, 3]];
        self.are_found(&self.hull(&one), &[self.point([1, 2, 3])], "equal");
        self.are_found(&self.hull(&[]), &[], "none");
    }
}

#[test]
fn hulls_of_roots_are_exact() {
    // A cube turned by a rotation of roots: which four corners are in one plane only exact numbers say.
    let root = |n| Number::integer(n).sqrt().expect("valid by construction");
    let (two, six) = (root(2), root(6));
    let zero = Number::zero;
    // The columns of a rotation times the root of 6.
    let (one, three) = (Number::one(), root(3));
    let columns = [
        [two.clone(), three.clone(), one.clone()],
        [two.clone(), -&three, one.clone()],
        [two.clone(), zero(), -&(&one + &one)],
    ];
    let mut points = Vec::new();
    for corner in 0..8 {
        let mut at = [zero(), zero(), zero()];
        for (bit, column) in columns.iter().enumerate() {
            if (corner >> bit) & 1 == 1 {
                let scaled = |i: usize| column[i].over(&six).expect("valid by construction");
                at = [0, 1, 2].map(|i: usize| &at[i] + &scaled(i));
            }
        }
        points.push(Point(at));
    }
    let outcome = space_hull(&points).expect("valid by construction");
    assert_eq!(outcome.certainty, Certainty::Proven);
    let Found::Boundary(cube) = outcome.value else {
        panic!("a cube has a hull in space");
    };
    assert_eq!((cube.vertices().len(), cube.edges().len()), (8, 12));
    assert_eq!(cube.faces().len(), 6);
}

#[test]
fn measured_hulls_say_how_certain_they_are() {
    let at = |c: Three| {
        Point(c.map(|x| Measured::new(f64::from(x), 1e-6).expect("valid by construction")))
    };
    let corners: Vec<Point<Measured>> = box_corners([0, 0, 0], [2, 2, 2]).map(at).to_vec();
    let outcome = space_hull(&corners).expect("valid by construction");
    // Four measured corners may be in one plane, and never certainly are.
    assert_eq!(outcome.certainty, Certainty::WithinDigits);
    let Found::Boundary(cube) = outcome.value else {
        panic!("a box has a hull in space");
    };
    assert_eq!((cube.vertices().len(), cube.faces().len()), (8, 6));
    // No four of these are near one plane.
    let corners: Vec<Point<Measured>> = [[0, 0, 0], [4, 0, 0], [0, 5, 0], [1, 1, 6], [3, 4, 5]]
        .map(at)
        .to_vec();
    let outcome = space_hull(&corners).expect("valid by construction");
    let Found::Boundary(solid) = outcome.value else {
        panic!("they have a hull in space");
    };
    assert_eq!((solid.vertices().len(), solid.faces().len()), (5, 6));
}

in_both_forms!(hulls_in_space, hulls_of_less_than_space);
