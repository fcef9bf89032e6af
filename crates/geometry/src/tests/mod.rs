//! Each function with each pair of arguments, exact and within digits; what is equal, parallel and touching among them.

use crate::{
    Answer, Boundary, BoundaryBuilder, Certainty, Direction, Entity, Face, Found, GeometryError,
    Line, Measured, Outcome, Plane, Point, Scalar, Segment, Vector, coincide,
};
use kutzbach_math::number::Number;
use std::marker::PhantomData;

/// One test for each function, in both forms.
macro_rules! in_both_forms {
    ($($function:ident),* $(,)?) => {
        $(#[test]
        fn $function() {
            EXACT.$function();
            TOLERANT.$function();
        })*
    };
}

mod boundary;
mod constructs;
mod curved;
mod faces;
mod flat;
mod forms;
mod hulls;
mod logical;
mod measures;
mod meets;
mod moved;
mod rounds;

type Three = [i32; 3];

/// The corners of a box, and its faces seen from outside.
const BOX: [[usize; 4]; 6] = [
    [0, 3, 2, 1],
    [4, 5, 6, 7],
    [0, 1, 5, 4],
    [1, 2, 6, 5],
    [2, 3, 7, 6],
    [3, 0, 4, 7],
];

fn box_corners([a, b, c]: Three, [x, y, z]: Three) -> [Three; 8] {
    [
        [a, b, c],
        [x, b, c],
        [x, y, c],
        [a, y, c],
        [a, b, z],
        [x, b, z],
        [x, y, z],
        [a, y, z],
    ]
}
type Logical<S> = fn(&Entity<S>, &Entity<S>) -> Result<Answer, GeometryError>;

/// Makes entities of integers in one of the two forms.
struct With<S> {
    numbers: PhantomData<S>,
    exact: bool,
}

const EXACT: With<Number> = With {
    numbers: PhantomData,
    exact: true,
};
const TOLERANT: With<Measured> = With {
    numbers: PhantomData,
    exact: false,
};

impl<S: Scalar> With<S> {
    fn three(&self, at: Three) -> [S; 3] {
        at.map(S::whole)
    }

    fn at(&self, at: Three) -> Point<S> {
        Point(self.three(at))
    }

    fn towards(&self, along: Three) -> Direction<S> {
        Direction::new(self.three(along)).expect("valid by construction")
    }

    fn vector(&self, at: Three) -> Entity<S> {
        Vector(self.three(at)).into()
    }

    fn direction(&self, along: Three) -> Entity<S> {
        self.towards(along).into()
    }

    fn point(&self, at: Three) -> Entity<S> {
        self.at(at).into()
    }

    fn line(&self, at: Three, along: Three) -> Entity<S> {
        Line::new(self.at(at), self.towards(along)).into()
    }

    fn plane(&self, at: Three, normal: Three) -> Entity<S> {
        Plane::new(self.at(at), self.towards(normal)).into()
    }

    fn segment(&self, from: Three, to: Three) -> Entity<S> {
        Segment::new(self.at(from), self.at(to))
            .expect("valid by construction")
            .into()
    }

    fn flat(&self, loops: &[&[Three]]) -> Face<S> {
        let mut points: Vec<Vec<Point<S>>> = Vec::new();
        for ring in loops {
            points.push(ring.iter().map(|c| self.at(*c)).collect());
        }
        Face::new(points).expect("valid by construction")
    }

    fn face(&self, loops: &[&[Three]]) -> Entity<S> {
        self.flat(loops).into()
    }

    fn builder(&self, vertices: &[Three], faces: &[&[&[usize]]]) -> BoundaryBuilder<S> {
        let mut builder = BoundaryBuilder::new();
        for vertex in vertices {
            builder.vertex(self.at(*vertex));
        }
        for loops in faces {
            builder.face(loops.iter().map(|ring| ring.to_vec()).collect());
        }
        builder
    }

    fn solid(&self, vertices: &[Three], faces: &[&[&[usize]]]) -> Boundary<S> {
        let builder = self.builder(vertices, faces);
        builder.build_solid().expect("valid by construction")
    }

    /// A set, in any order.
    fn are_found(&self, outcome: &Outcome<Found<S>>, expected: &[Entity<S>], what: &str) {
        let found = outcome.value.clone().entities();
        assert_eq!(found.len(), expected.len(), "{what}: found {found:?}");
        for needed in expected {
            let any = found.iter().any(|one| {
                one.kind() == needed.kind()
                    && coincide(one, needed).is_ok_and(|answer| match self.exact {
                        true => answer.is_yes(),
                        false => !answer.is_no(),
                    })
            });
            assert!(any, "{what}: needed {needed:?}, found {found:?}");
        }
        if self.exact {
            assert_eq!(outcome.certainty, Certainty::Proven, "{what}");
        }
    }

    /// Rows of a function of which the arguments have no order.
    fn both_ways(&self, function: Logical<S>, rows: &[(Entity<S>, Entity<S>, bool)]) {
        for (row, (a, b, holds)) in rows.iter().enumerate() {
            let expected = if *holds { Answer::Yes } else { Answer::No };
            assert_eq!(function(a, b), Ok(expected), "row {row}: {a:?} {b:?}");
            assert_eq!(function(b, a), Ok(expected), "row {row}: {b:?} {a:?}");
        }
    }

    fn is_near(&self, found: &S, expected: f64, what: &str) {
        assert!(
            (found.double() - expected).abs() < 1e-12,
            "{what}: needed {expected}, found {found:?}"
        );
    }

    fn is_found(&self, outcome: &Outcome<Found<S>>, expected: Option<Entity<S>>, what: &str) {
        match (outcome.value.clone().entity(), expected) {
            (None, None) => {}
            (Some(found), Some(expected)) => {
                let answer = coincide(&found, &expected)
                    .unwrap_or_else(|e| panic!("{what}: {e}, of {found:?}"));
                let right = if self.exact {
                    answer.is_yes()
                } else {
                    !answer.is_no()
                };
                assert!(right, "{what}: needed {expected:?}, found {found:?}");
            }
            (found, expected) => panic!("{what}: needed {expected:?}, found {found:?}"),
        }
        if self.exact {
            assert_eq!(outcome.certainty, Certainty::Proven, "{what}");
        }
    }

    fn are_points(&self, found: &[Point<S>], expected: &[Three]) {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (a, b) in found.iter().zip(expected) {
            let same = coincide(&a.clone().into(), &self.point(*b));
            assert_eq!(same, Ok(Answer::Yes), "needed {b:?}, found {a:?}");
        }
    }
}
