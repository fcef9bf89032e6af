//! Each function with each pair of arguments, exact and within digits; what is equal, parallel and touching among them.

use crate::{
    Answer, Certainty, Direction, Entity, Found, GeometryError, Line, Measured, Outcome, Place,
    Plane, Point, Scalar, Segment, Side, Vector, World, WorldError, angle_between,
    calculate_normal, classify, classify_in_polygon, coincide, colinear, contained, coplanar,
    distance, intersection, join_perpend, parallel, perpend, perpendicular, planar_hull,
    projection, signed_angle_between, sort_angular,
};
use kutzbach_math::number::Number;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, FRAC_PI_4, PI};
use std::marker::PhantomData;

type Three = [i32; 3];
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
        Direction::new(self.three(along)).unwrap()
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
        Segment::new(self.at(from), self.at(to)).unwrap().into()
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

    fn asks_coincide(&self) {
        let rows = [
            (self.vector([0, 0, 0]), self.vector([0, 0, 0]), true),
            (self.vector([1, 2, 3]), self.vector([2, 4, 6]), false),
            (self.direction([1, 2, 3]), self.direction([2, 4, 6]), true),
            (
                self.direction([1, 2, 3]),
                self.direction([-1, -2, -3]),
                false,
            ),
            (self.direction([1, 0, 0]), self.direction([0, 1, 0]), false),
            (self.point([1, 2, 3]), self.point([1, 2, 3]), true),
            (self.point([1, 2, 3]), self.point([1, 2, 4]), false),
            (
                self.line([0, 0, 0], [1, 1, 1]),
                self.line([2, 2, 2], [-3, -3, -3]),
                true,
            ),
            (
                self.line([0, 0, 0], [1, 1, 1]),
                self.line([2, 2, 1], [1, 1, 1]),
                false,
            ),
            (
                self.line([0, 0, 0], [1, 1, 1]),
                self.line([0, 0, 0], [1, 1, 2]),
                false,
            ),
            (
                self.plane([0, 0, 1], [0, 0, 1]),
                self.plane([5, 7, 1], [0, 0, -2]),
                true,
            ),
            (
                self.plane([0, 0, 1], [0, 0, 1]),
                self.plane([5, 7, 2], [0, 0, 1]),
                false,
            ),
            (
                self.plane([0, 0, 1], [0, 0, 1]),
                self.plane([0, 0, 1], [0, 1, 1]),
                false,
            ),
            (
                self.segment([0, 0, 0], [1, 0, 0]),
                self.segment([1, 0, 0], [0, 0, 0]),
                true,
            ),
            (
                self.segment([0, 0, 0], [1, 0, 0]),
                self.segment([0, 0, 0], [2, 0, 0]),
                false,
            ),
        ];
        self.both_ways(coincide, &rows);
        assert!(coincide(&self.point([0, 0, 0]), &self.vector([0, 0, 0])).is_err());
    }

    fn asks_colinear_and_coplanar(&self) {
        let x = || self.line([0, 0, 0], [1, 0, 0]);
        let rows = [
            (self.point([4, 0, 0]), x(), true),
            (self.point([4, 1, 0]), x(), false),
            (
                self.point([4, 0, 0]),
                self.segment([0, 0, 0], [1, 0, 0]),
                true,
            ),
            (self.segment([3, 0, 0], [5, 0, 0]), x(), true),
            (self.segment([3, 0, 0], [5, 0, 1]), x(), false),
            (
                self.segment([3, 0, 0], [5, 0, 0]),
                self.segment([0, 0, 0], [1, 0, 0]),
                true,
            ),
            (x(), self.line([7, 0, 0], [-1, 0, 0]), true),
            (x(), self.line([0, 1, 0], [1, 0, 0]), false),
        ];
        self.both_ways(colinear, &rows);
        assert!(colinear(&self.point([0, 0, 0]), &self.point([1, 0, 0])).is_err());
        let floor = || self.plane([0, 0, 0], [0, 0, 1]);
        let rows = [
            (self.point([4, 5, 0]), floor(), true),
            (self.point([4, 5, 1]), floor(), false),
            (x(), floor(), true),
            (self.line([0, 0, 1], [1, 0, 0]), floor(), false),
            (self.segment([0, 0, 0], [1, 1, 0]), floor(), true),
            (self.segment([0, 0, 0], [1, 1, 1]), floor(), false),
            (floor(), self.plane([1, 1, 0], [0, 0, -3]), true),
            (floor(), self.plane([1, 1, 1], [0, 0, 1]), false),
            (x(), self.line([0, 3, 0], [1, 0, 0]), true),
            (x(), self.line([5, 0, 0], [1, 2, 3]), true),
            (x(), self.line([0, 0, 1], [0, 1, 0]), false),
            (x(), self.segment([0, 0, 1], [0, 1, 1]), false),
            (
                self.segment([0, 0, 0], [1, 0, 0]),
                self.segment([0, 0, 1], [1, 0, 1]),
                true,
            ),
        ];
        self.both_ways(coplanar, &rows);
        assert!(coplanar(&floor(), &self.direction([1, 0, 0])).is_err());
    }

    fn asks_contained(&self) {
        let floor = self.plane([0, 0, 0], [0, 0, 2]);
        let x = self.line([0, 0, 0], [2, 0, 0]);
        let bar = self.segment([0, 0, 0], [2, 2, 0]);
        let rows = [
            (self.point([5, 0, 0]), &x, true),
            (self.point([5, 0, 1]), &x, false),
            (self.point([5, 1, 0]), &floor, true),
            (self.point([5, 1, 1]), &floor, false),
            (self.point([1, 1, 0]), &bar, true),
            (self.point([0, 0, 0]), &bar, true),
            (self.point([2, 2, 0]), &bar, true),
            (self.point([3, 3, 0]), &bar, false),
            (self.point([-1, -1, 0]), &bar, false),
            (self.point([1, 1, 1]), &bar, false),
            (self.line([0, 4, 0], [1, 1, 0]), &floor, true),
            (self.line([0, 4, 0], [1, 1, 1]), &floor, false),
            (self.line([0, 4, 1], [1, 1, 0]), &floor, false),
            (self.line([9, 0, 0], [-1, 0, 0]), &x, true),
            (self.segment([1, 0, 0], [3, 0, 0]), &x, true),
            (self.segment([1, 0, 0], [3, 1, 0]), &x, false),
            (self.segment([1, 0, 0], [3, 1, 0]), &floor, true),
            (self.segment([1, 0, 0], [3, 1, 1]), &floor, false),
            (self.segment([1, 1, 0], [2, 2, 0]), &bar, true),
            (self.segment([1, 1, 0], [3, 3, 0]), &bar, false),
        ];
        for (row, (a, b, holds)) in rows.iter().enumerate() {
            let expected = if *holds { Answer::Yes } else { Answer::No };
            assert_eq!(contained(a, b), Ok(expected), "row {row}");
        }
        assert!(contained(&x, &bar).is_err());
        assert!(contained(&floor, &x).is_err());
    }

    fn asks_parallel_and_perpendicular(&self) {
        let direction = |d| self.direction(d);
        let line = |d| self.line([3, 1, 4], d);
        let segment = |[x, y, z]: Three| self.segment([1, 1, 1], [1 + x, 1 + y, 1 + z]);
        let plane = |d| self.plane([2, 7, 1], d);
        let (u, twice, across) = ([1, 2, 2], [-2, -4, -4], [2, 1, -2]);
        let slant = [1, 2, 3];
        let along: [&dyn Fn(Three) -> Entity<S>; 3] = [&direction, &line, &segment];
        for a in along {
            for b in along {
                let rows = [
                    (a(u), b(twice), true),
                    (a(u), b(across), false),
                    (a(u), b(slant), false),
                ];
                self.both_ways(parallel, &rows);
                let rows = [
                    (a(u), b(twice), false),
                    (a(u), b(across), true),
                    (a(u), b(slant), false),
                ];
                self.both_ways(perpendicular, &rows);
            }
            let rows = [
                (a(u), plane(twice), false),
                (a(u), plane(across), true),
                (a(u), plane(slant), false),
            ];
            self.both_ways(parallel, &rows);
            let rows = [
                (a(u), plane(twice), true),
                (a(u), plane(across), false),
                (a(u), plane(slant), false),
            ];
            self.both_ways(perpendicular, &rows);
        }
        let rows = [
            (plane(u), plane(twice), true),
            (plane(u), plane(across), false),
        ];
        self.both_ways(parallel, &rows);
        let rows = [
            (plane(u), plane(twice), false),
            (plane(u), plane(across), true),
        ];
        self.both_ways(perpendicular, &rows);
        assert!(parallel(&self.vector([0, 0, 0]), &plane(u)).is_err());
        assert!(perpendicular(&self.point([0, 0, 0]), &plane(u)).is_err());
    }

    fn measures_distances(&self) {
        let x = || self.line([0, 0, 0], [2, 0, 0]);
        let floor = || self.plane([0, 0, 0], [0, 0, 3]);
        let bar = || self.segment([0, 0, 0], [4, 0, 0]);
        let rows = [
            (self.point([0, 0, 0]), self.point([1, 2, 2]), 3.0),
            (self.point([1, 1, 1]), self.point([1, 1, 1]), 0.0),
            (self.point([0, 0, 0]), self.point([1, 1, 0]), 2f64.sqrt()),
            (self.point([7, 3, 4]), x(), 5.0),
            (self.point([7, 0, 0]), x(), 0.0),
            (self.point([7, 3, -4]), floor(), 4.0),
            (self.point([7, 3, 0]), floor(), 0.0),
            (self.point([2, 3, 4]), bar(), 5.0),
            (self.point([7, 0, 4]), bar(), 5.0),
            (self.point([-3, 4, 0]), bar(), 5.0),
            (self.point([4, 0, 0]), bar(), 0.0),
            (x(), self.line([9, 0, 5], [0, 1, 0]), 5.0),
            (x(), self.line([9, 0, 0], [0, 1, 0]), 0.0),
            (x(), self.line([9, 3, 4], [-1, 0, 0]), 5.0),
            (x(), self.line([9, 0, 0], [-1, 0, 0]), 0.0),
            (self.line([1, 1, 6], [1, 2, 0]), floor(), 6.0),
            (self.line([1, 1, 6], [1, 2, 1]), floor(), 0.0),
            (floor(), self.plane([1, 1, -2], [0, 0, 1]), 2.0),
            (floor(), self.plane([1, 1, -2], [0, 1, 1]), 0.0),
        ];
        for (row, (a, b, expected)) in rows.iter().enumerate() {
            for outcome in [distance(a, b).unwrap(), distance(b, a).unwrap()] {
                self.is_near(&outcome.value, *expected, &format!("row {row}"));
                assert_eq!(outcome.certainty, Certainty::Proven, "row {row}");
            }
        }
        assert!(distance(&self.direction([1, 0, 0]), &x()).is_err());
    }

    fn measures_angles(&self) {
        let floor = || self.plane([0, 0, 0], [0, 0, 1]);
        let rows = [
            (self.direction([1, 0, 0]), self.direction([-2, 0, 0]), PI),
            (self.direction([1, 0, 0]), self.direction([3, 0, 0]), 0.0),
            (
                self.direction([1, 0, 0]),
                self.direction([-1, 1, 0]),
                3.0 * FRAC_PI_4,
            ),
            (
                self.direction([1, 1, 0]),
                self.direction([0, 1, 1]),
                FRAC_PI_3,
            ),
            (
                self.line([0, 0, 0], [1, 0, 0]),
                self.line([5, 5, 5], [-1, 1, 0]),
                FRAC_PI_4,
            ),
            (
                self.line([0, 0, 0], [1, 0, 0]),
                self.line([5, 5, 5], [-1, 0, 0]),
                0.0,
            ),
            (self.line([0, 0, 0], [1, 0, 1]), floor(), FRAC_PI_4),
            (self.line([0, 0, 0], [0, 0, -1]), floor(), FRAC_PI_2),
            (self.line([0, 0, 9], [1, 1, 0]), floor(), 0.0),
            (self.segment([0, 0, 0], [1, 0, -1]), floor(), FRAC_PI_4),
            (
                self.segment([0, 0, 0], [1, 0, -1]),
                self.line([0, 0, 0], [1, 0, 0]),
                FRAC_PI_4,
            ),
            (floor(), self.plane([1, 1, 1], [0, -1, -1]), FRAC_PI_4),
            (floor(), self.plane([1, 1, 1], [0, 0, -1]), 0.0),
        ];
        for (row, (a, b, expected)) in rows.iter().enumerate() {
            for angles in [angle_between(a, b).unwrap(), angle_between(b, a).unwrap()] {
                self.is_near(&angles.angle, *expected, &format!("row {row}"));
                self.is_near(&angles.supplement, PI - expected, &format!("row {row}"));
            }
        }
        assert!(angle_between(&self.point([0, 0, 0]), &floor()).is_err());
    }

    fn measures_signed_angles(&self) {
        let up = self.towards([0, 0, 2]);
        let rows = [
            ([1, 0, 0], [0, 1, 0], FRAC_PI_2, -FRAC_PI_2),
            ([0, 1, 0], [1, 0, 0], -FRAC_PI_2, FRAC_PI_2),
            ([1, 0, 0], [1, 1, 0], FRAC_PI_4, -3.0 * FRAC_PI_4),
            // What runs along the axis does not count.
            ([1, 0, 5], [1, 1, -3], FRAC_PI_4, -3.0 * FRAC_PI_4),
            ([1, 0, 0], [2, 0, 0], 0.0, PI),
            ([1, 0, 0], [-2, 0, 0], PI, 0.0),
        ];
        for (u, v, expected, supplement) in rows {
            let pairs = [
                (self.direction(u), self.direction(v)),
                (self.plane([1, 2, 3], u), self.plane([3, 2, 1], v)),
            ];
            for (a, b) in pairs {
                let angles = signed_angle_between(&a, &b, &up).unwrap().value;
                self.is_near(&angles.angle, expected, "angle");
                self.is_near(&angles.supplement, supplement, "supplement");
            }
        }
        let along = self.direction([0, 0, -1]);
        assert!(signed_angle_between(&along, &self.direction([1, 0, 0]), &up).is_err());
        let line = self.line([0, 0, 0], [1, 0, 0]);
        assert!(signed_angle_between(&line, &line, &up).is_err());
    }

    fn intersects(&self) {
        let x = || self.line([0, 0, 0], [1, 0, 0]);
        let floor = || self.plane([0, 0, 0], [0, 0, 1]);
        let bar = || self.segment([0, 0, 0], [4, 0, 0]);
        let post = |x| self.segment([x, 0, -2], [x, 0, 2]);
        let rows = [
            (
                x(),
                self.line([3, 2, 0], [0, 1, 0]),
                Some(self.point([3, 0, 0])),
            ),
            (x(), self.line([3, 2, 1], [0, 1, 0]), None),
            (x(), self.line([3, 2, 0], [-1, 0, 0]), None),
            (x(), self.line([3, 0, 0], [-1, 0, 0]), Some(x())),
            (
                x(),
                self.plane([5, 1, 1], [1, 0, 0]),
                Some(self.point([5, 0, 0])),
            ),
            (x(), floor(), Some(x())),
            (x(), self.plane([0, 0, 1], [0, 0, 1]), None),
            (
                floor(),
                self.plane([0, 3, 9], [0, 1, 0]),
                Some(self.line([8, 3, 0], [1, 0, 0])),
            ),
            (floor(), self.plane([0, 3, 9], [0, 0, 1]), None),
            (floor(), self.plane([3, 3, 0], [0, 0, -1]), Some(floor())),
            (post(1), floor(), Some(self.point([1, 0, 0]))),
            (
                self.segment([1, 0, 0], [1, 0, 2]),
                floor(),
                Some(self.point([1, 0, 0])),
            ),
            (
                self.segment([1, 0, 2], [1, 0, 0]),
                floor(),
                Some(self.point([1, 0, 0])),
            ),
            (self.segment([1, 0, 1], [1, 0, 2]), floor(), None),
            (bar(), floor(), Some(bar())),
            (
                bar(),
                self.line([2, 5, 0], [0, 1, 0]),
                Some(self.point([2, 0, 0])),
            ),
            (
                bar(),
                self.line([4, 5, 0], [0, 1, 0]),
                Some(self.point([4, 0, 0])),
            ),
            (bar(), self.line([5, 5, 0], [0, 1, 0]), None),
            (bar(), self.line([-1, 5, 0], [0, 1, 0]), None),
            (bar(), x(), Some(bar())),
            (bar(), self.line([0, 1, 0], [1, 0, 0]), None),
        ];
        for (row, (a, b, expected)) in rows.iter().enumerate() {
            let what = format!("row {row}");
            self.is_found(&intersection(a, b).unwrap(), expected.clone(), &what);
            self.is_found(&intersection(b, a).unwrap(), expected.clone(), &what);
        }
        assert!(intersection(&bar(), &bar()).is_err());
        assert!(intersection(&self.point([0, 0, 0]), &x()).is_err());
    }

    fn projects(&self) {
        let x = || self.line([0, 0, 0], [1, 0, 0]);
        let floor = || self.plane([0, 0, 0], [0, 0, 1]);
        let up = || Some(self.towards([0, 0, 4]));
        let slant = || Some(self.towards([1, 0, -1]));
        let flat = || Some(self.towards([1, 1, 0]));
        let rows = [
            (
                self.point([3, 4, 5]),
                x(),
                None,
                Some(self.point([3, 0, 0])),
            ),
            (
                self.point([3, 0, 5]),
                x(),
                slant(),
                Some(self.point([8, 0, 0])),
            ),
            (self.point([3, 1, 5]), x(), slant(), None),
            (
                self.point([3, 4, 5]),
                floor(),
                None,
                Some(self.point([3, 4, 0])),
            ),
            (
                self.point([3, 4, 5]),
                floor(),
                slant(),
                Some(self.point([8, 4, 0])),
            ),
            (self.point([3, 4, 5]), floor(), flat(), None),
            (
                self.line([3, 4, 5], [1, 2, 3]),
                floor(),
                None,
                Some(self.line([3, 4, 0], [1, 2, 0])),
            ),
            (
                self.line([3, 4, 5], [0, 0, 3]),
                floor(),
                None,
                Some(self.point([3, 4, 0])),
            ),
            (
                self.line([3, 4, 5], [0, 0, 3]),
                floor(),
                slant(),
                Some(self.line([8, 4, 0], [1, 0, 0])),
            ),
            (self.line([3, 4, 5], [1, 0, 0]), floor(), flat(), None),
            (
                self.segment([3, 4, 5], [4, 6, 8]),
                floor(),
                up(),
                Some(self.segment([3, 4, 0], [4, 6, 0])),
            ),
            (
                self.segment([3, 4, 5], [3, 4, 8]),
                floor(),
                up(),
                Some(self.point([3, 4, 0])),
            ),
            (self.segment([3, 4, 5], [3, 4, 8]), floor(), flat(), None),
        ];
        for (row, (a, b, light, expected)) in rows.iter().enumerate() {
            let outcome = projection(a, b, light.as_ref()).unwrap();
            self.is_found(&outcome, expected.clone(), &format!("row {row}"));
        }
        assert!(projection(&floor(), &x(), None).is_err());
    }

    fn joins(&self) {
        let x = || self.line([0, 0, 0], [1, 0, 0]);
        let floor = || self.plane([0, 0, 0], [0, 0, 2]);
        let rows = [
            (self.point([3, 4, 5]), x(), [3, 4, 5], [3, 0, 0], false),
            (self.point([3, 0, 0]), x(), [3, 0, 0], [3, 0, 0], false),
            (self.point([3, 4, 5]), floor(), [3, 4, 5], [3, 4, 0], false),
            (
                x(),
                self.line([2, 7, 3], [0, 1, 0]),
                [2, 0, 0],
                [2, 0, 3],
                false,
            ),
            (
                x(),
                self.line([2, 7, 0], [0, 1, 0]),
                [2, 0, 0],
                [2, 0, 0],
                false,
            ),
            (
                x(),
                self.line([2, 7, 3], [1, 0, 0]),
                [0, 0, 0],
                [0, 7, 3],
                true,
            ),
        ];
        for (a, b, first, second, one_of_many) in rows {
            let feet = join_perpend(&a, &b).unwrap().value;
            self.are_points(&[feet.first, feet.second], &[first, second]);
            assert_eq!(feet.one_of_many, one_of_many);
        }
        let back = join_perpend(&floor(), &self.point([3, 4, 5]))
            .unwrap()
            .value;
        self.are_points(&[back.first, back.second], &[[3, 4, 0], [3, 4, 5]]);
        assert!(join_perpend(&floor(), &x()).is_err());
    }

    fn finds_perpendiculars(&self) {
        let x = || self.line([0, 0, 0], [1, 0, 0]);
        let floor = || self.plane([0, 0, 0], [0, 0, 1]);
        let point = || self.point([1, 2, 3]);
        let rows = [
            (
                x(),
                self.line([4, 4, 4], [0, 1, 0]),
                Some(self.direction([0, 0, 1])),
            ),
            (
                x(),
                self.line([4, 3, 4], [1, 0, 0]),
                Some(self.direction([0, 3, 4])),
            ),
            (x(), self.line([4, 0, 0], [1, 0, 0]), None),
            (x(), floor(), Some(self.plane([0, 0, 0], [0, 1, 0]))),
            (self.line([0, 0, 0], [0, 0, 1]), floor(), None),
            (point(), x(), Some(self.plane([1, 0, 0], [1, 0, 0]))),
            (point(), floor(), Some(self.line([1, 2, 0], [0, 0, 1]))),
        ];
        for (row, (a, b, expected)) in rows.iter().enumerate() {
            let what = format!("row {row}");
            self.is_found(&perpend(a, b).unwrap(), expected.clone(), &what);
        }
        assert!(perpend(&floor(), &floor()).is_err());
    }

    fn classifies(&self) {
        let floor = self.plane([0, 0, 0], [0, 0, 1]);
        let rows = [
            (self.point([1, 1, 1]), Side::Above),
            (self.point([1, 1, 0]), Side::In),
            (self.point([1, 1, -1]), Side::Below),
            (self.line([1, 1, 1], [1, 0, 0]), Side::Above),
            (self.line([1, 1, 0], [1, 0, 0]), Side::In),
            (self.line([1, 1, 1], [1, 0, 1]), Side::Crossing),
            (self.segment([0, 0, 1], [1, 0, 2]), Side::Above),
            (self.segment([0, 0, -1], [1, 0, -2]), Side::Below),
            (self.segment([0, 0, 0], [1, 0, 0]), Side::In),
            (self.segment([0, 0, 0], [1, 0, 1]), Side::Touching),
            (self.segment([0, 0, -1], [1, 0, 1]), Side::Crossing),
        ];
        for (a, expected) in rows {
            let found = classify(&a, &floor).unwrap();
            assert_eq!(
                (found.value, found.certainty),
                (expected, Certainty::Proven)
            );
        }
        assert!(classify(&floor, &floor).is_err());
        // The letter L, from both sides.
        let corners = [
            [0, 0, 5],
            [4, 0, 5],
            [4, 2, 5],
            [2, 2, 5],
            [2, 4, 5],
            [0, 4, 5],
        ];
        let corners = corners.map(|c| self.at(c));
        let rows = [
            ([1, 1, 5], Place::Inside),
            ([1, 2, 5], Place::Inside),
            ([3, 1, 5], Place::Inside),
            ([3, 3, 5], Place::Outside),
            ([-1, 2, 5], Place::Outside),
            ([5, 0, 5], Place::Outside),
            ([3, 2, 5], Place::OnBorder),
            ([2, 2, 5], Place::OnBorder),
            ([0, 1, 5], Place::OnBorder),
            ([1, 1, 4], Place::Outside),
        ];
        for (at, expected) in rows {
            for normal in [[0, 0, 1], [0, 0, -3]] {
                let found = classify_in_polygon(&self.at(at), &corners, &self.towards(normal));
                assert_eq!(found.unwrap().value, expected, "{at:?}");
            }
        }
        let up = self.towards([0, 0, 1]);
        assert!(classify_in_polygon(&self.at([0, 0, 0]), &corners[..2], &up).is_err());
    }

    fn sorts_and_hulls(&self) {
        let points = [
            [2, 0, 0],
            [0, -1, 0],
            [1, 1, 0],
            [-3, 0, 0],
            [1, 0, 0],
            [0, 0, 0],
        ];
        let points = points.map(|c| self.at(c));
        let centre = self.at([0, 0, 0]);
        let up = self.towards([0, 0, 3]);
        let down = self.towards([0, 0, -1]);
        let counterclockwise = sort_angular(&points, &centre, &up);
        let expected = [
            [0, 0, 0],
            [1, 0, 0],
            [2, 0, 0],
            [1, 1, 0],
            [-3, 0, 0],
            [0, -1, 0],
        ];
        self.are_points(&counterclockwise.value, &expected);
        let clockwise = sort_angular(&points, &centre, &down);
        let expected = [
            [0, 0, 0],
            [1, 0, 0],
            [2, 0, 0],
            [0, -1, 0],
            [-3, 0, 0],
            [1, 1, 0],
        ];
        self.are_points(&clockwise.value, &expected);
        assert!(sort_angular(&[], &centre, &up).value.is_empty());

        let square = [
            [0, 0, 0],
            [2, 2, 0],
            [1, 1, 0],
            [2, 0, 0],
            [0, 2, 0],
            [1, 0, 0],
            [0, 0, 0],
        ];
        let square = square.map(|c| self.at(c));
        let hull = planar_hull(&square, &up);
        assert_eq!(hull.value.len(), 4);
        assert_eq!(hull.certainty, Certainty::Proven);
        let normal = calculate_normal(&hull.value).unwrap().value.unwrap();
        let same = coincide(&normal.into(), &self.direction([0, 0, 1]));
        assert_eq!(same, Ok(Answer::Yes));
        let hull = planar_hull(&square, &down).value;
        let normal = calculate_normal(&hull).unwrap().value.unwrap();
        let same = coincide(&normal.into(), &self.direction([0, 0, -1]));
        assert_eq!(same, Ok(Answer::Yes));

        let on_a_line = [[1, 1, 0], [3, 3, 0], [2, 2, 0], [3, 3, 0]].map(|c| self.at(c));
        let ends = planar_hull(&on_a_line, &up).value;
        assert_eq!(ends.len(), 2);
        assert_eq!(planar_hull(&on_a_line[..1], &up).value.len(), 1);
        assert!(planar_hull(&[], &up).value.is_empty());
        assert!(calculate_normal(&on_a_line).unwrap().value.is_none());
        assert!(calculate_normal::<S>(&[]).unwrap().value.is_none());
    }

    fn refuses_what_is_degenerate(&self) {
        let at = |x| self.at([x, 0, 0]);
        assert!(Direction::new(self.three([0, 0, 0])).is_err());
        assert!(Line::through(at(1), &at(1)).is_err());
        assert!(Line::through(at(1), &at(2)).is_ok());
        assert!(Segment::new(at(1), at(1)).is_err());
        assert!(Plane::through(at(1), &at(2), &at(3)).is_err());
        let said = Line::through(at(1), &at(1)).unwrap_err().to_string();
        assert!(said.contains("two different points"), "{said}");
    }
}

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

in_both_forms!(
    asks_coincide,
    asks_colinear_and_coplanar,
    asks_contained,
    asks_parallel_and_perpendicular,
    measures_distances,
    measures_angles,
    measures_signed_angles,
    intersects,
    projects,
    joins,
    finds_perpendiculars,
    classifies,
    sorts_and_hulls,
    refuses_what_is_degenerate,
);

#[test]
fn roots_are_decided() {
    let root = |n| Number::integer(n).sqrt().unwrap();
    let zero = Number::zero;
    let along = Direction::new([root(2), Number::one(), zero()]).unwrap();
    let line: Entity<Number> = Line::new(Point([zero(), zero(), zero()]), along).into();
    let on = Point([Number::integer(2), root(2), zero()]).into();
    let beside = Point([
        Number::integer(2),
        Number::ratio(141_421, 100_000).unwrap(),
        zero(),
    ])
    .into();
    assert_eq!(contained(&on, &line), Ok(Answer::Yes));
    assert_eq!(contained(&beside, &line), Ok(Answer::No));
    // Of degree three: 2 cos 20° is a zero of x³ − 3 x − 1.
    let x = &Number::integer(20).radians().cos_sin().0 * &Number::integer(2);
    let cube = &(&x * &x) * &x;
    let polynomial = &(&cube - &(&x * &Number::integer(3))) - &Number::one();
    let found = Point([polynomial, zero(), zero()]).into();
    let origin = Point([zero(), zero(), zero()]).into();
    assert_eq!(coincide(&found, &origin), Ok(Answer::Yes));
}

#[test]
fn what_is_not_proven_is_said() {
    // sin² 1 + cos² 1 − 1: no bound is known for sines of rational numbers.
    let (cos, sin) = Number::one().cos_sin();
    let x = &(&(&cos * &cos) + &(&sin * &sin)) - &Number::one();
    let point: Entity<Number> = Point([x.clone(), Number::zero(), Number::zero()]).into();
    let origin = Point([Number::zero(), Number::zero(), Number::zero()]).into();
    assert_eq!(coincide(&point, &origin), Ok(Answer::Indistinguishable));
    let wall = EXACT.plane([0, 0, 0], [1, 0, 0]);
    let side = classify(&point, &wall).unwrap();
    assert_eq!(
        (side.value, side.certainty),
        (Side::In, Certainty::Indistinguishable)
    );
    assert!(Direction::new([x, Number::zero(), Number::zero()]).is_err());
}

#[test]
fn digits_are_respected() {
    let m = |x: f64, u: f64| Measured::new(x, u).unwrap();
    let at = |z: Measured| Entity::from(Point([m(1.0, 1e-3), m(2.0, 1e-3), z]));
    let floor = TOLERANT.plane([0, 0, 0], [0, 0, 1]);
    assert_eq!(
        contained(&at(m(5e-4, 1e-3)), &floor),
        Ok(Answer::WithinDigits)
    );
    assert_eq!(contained(&at(m(5e-3, 1e-3)), &floor), Ok(Answer::No));
    assert_eq!(contained(&at(m(0.0, 0.0)), &floor), Ok(Answer::Yes));
    assert!(Direction::new([m(1e-4, 1e-3), m(0.0, 0.0), m(0.0, 0.0)]).is_err());
    assert!(Measured::new(f64::NAN, 0.0).is_err() && Measured::new(1.0, -1.0).is_err());
    // Two measured lines meet within their digits.
    let up = Direction::new([m(0.0, 1e-6), m(0.0, 1e-6), m(1.0, 1e-6)]).unwrap();
    let upright = Line::new(Point([m(2.0, 1e-3), m(1e-5, 1e-3), m(3.0, 1e-3)]), up).into();
    let met = intersection(&TOLERANT.line([0, 0, 0], [1, 0, 0]), &upright).unwrap();
    assert_eq!(met.certainty, Certainty::WithinDigits);
    let Found::Point(Point([x, ..])) = met.value else {
        panic!("{met:?}");
    };
    assert!(
        x.low() < 2.0 && x.high() > 2.0 && x.uncertainty() < 2e-3,
        "{x:?}"
    );
    // A literal states half a unit of its last decimal, an integer is exact.
    let length = Measured::stated(&Number::decimal("0.25").unwrap()).unwrap();
    assert!(length.low() <= 0.245 && length.high() >= 0.255 && length.uncertainty() < 0.0051);
    let twelve = Measured::stated(&Number::decimal("12").unwrap()).unwrap();
    assert_eq!((twelve.low(), twelve.high()), (12.0, 12.0));
    let third = Measured::stated(&Number::ratio(1, 3).unwrap()).unwrap();
    assert!(third.low() < third.high());
}

#[test]
fn the_world_lets_no_reference_dangle() {
    let mut world = World::new();
    assert!(world.is_empty());
    let a = world.store("a", EXACT.at([0, 0, 0])).unwrap();
    let b = world.store("b", EXACT.at([1, 0, 0])).unwrap();
    let taken = world.store("a", EXACT.at([2, 0, 0])).unwrap_err();
    assert_eq!(taken, WorldError::NameTaken("a".to_owned()));
    assert_eq!(
        world.store(" ", EXACT.at([2, 0, 0])),
        Err(WorldError::NoName)
    );
    let line = Line::through(EXACT.at([0, 0, 0]), &EXACT.at([1, 0, 0])).unwrap();
    let l = world.store_made_from("l", line, &[a, b]).unwrap();
    assert_eq!(world.made_from(a), [l]);
    let in_use = world.delete(a).unwrap_err();
    assert!(in_use.to_string().contains("`l` is"), "{in_use}");
    world.rename(l, "axis").unwrap();
    assert_eq!(
        (world.find("l"), world.find("axis"), world.name(l)),
        (None, Some(l), Some("axis"))
    );
    assert!(world.rename(l, "b").is_err());
    assert_eq!(
        world.iter().map(|(name, ..)| name).collect::<Vec<_>>(),
        ["a", "axis", "b"]
    );
    assert!(matches!(world.delete(l), Ok(Entity::Line(_))));
    // Its place is used again, its id is not.
    let c = world.store("c", EXACT.at([3, 0, 0])).unwrap();
    assert!(world.get(l).is_none() && world.get(c).is_some() && l != c);
    assert_eq!(world.delete(l).unwrap_err(), WorldError::Deleted(l));
    assert!(
        world
            .store_made_from("d", EXACT.at([4, 0, 0]), &[l])
            .is_err()
    );
    assert_eq!(world.find("d"), None);
    let d = world
        .store_made_from("d", EXACT.at([4, 0, 0]), &[a])
        .unwrap();
    world
        .store_made_from("e", EXACT.at([5, 0, 0]), &[d])
        .unwrap();
    assert_eq!(world.delete_with_all_made_from_it(a), Ok(3));
    assert_eq!(
        world.iter().map(|(name, ..)| name).collect::<Vec<_>>(),
        ["b", "c"]
    );
    assert_eq!(world.len(), 2);
}
