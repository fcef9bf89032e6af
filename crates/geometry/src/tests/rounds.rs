//! Round things among themselves: what they have in common, how far they are apart, and points and circles projected.

use super::{EXACT, TOLERANT, Three, With};
use crate::{Entity, Scalar, distance, intersection, projection};

/// Two entities and what they have in common.
type Meeting<S> = (Entity<S>, Entity<S>, Vec<Entity<S>>);

impl<S: Scalar> With<S> {
    /// A cylinder along z.
    fn pin(&self, at: Three, radius: i32) -> Entity<S> {
        self.cylinder(at, [0, 0, 2], radius)
    }

    /// A circle across z.
    fn ring(&self, at: Three, radius: i32) -> Entity<S> {
        self.circle(at, [0, 0, -3], radius)
    }

    /// A cone as wide as it is high, which opens upwards or downwards.
    fn horn(&self, height: i32, up: i32) -> Entity<S> {
        self.cone([0, 0, height], [0, 0, up], 1)
    }

    fn meet(&self, rows: &[Meeting<S>]) {
        for (row, (a, b, expected)) in rows.iter().enumerate() {
            for (first, second) in [(a, b), (b, a)] {
                let found = intersection(first, second);
                let found = found.unwrap_or_else(|error| panic!("row {row}: {error}"));
                self.are_found(&found, expected, &format!("row {row}"));
            }
        }
    }

    fn do_not_meet_in_entities(&self, rows: &[(Entity<S>, Entity<S>)]) {
        for (row, (a, b)) in rows.iter().enumerate() {
            assert!(intersection(a, b).is_err(), "row {row}");
            assert!(intersection(b, a).is_err(), "row {row}");
        }
    }

    fn spheres_meet_what_is_round(&self) {
        let ball = |at, radius| self.sphere(at, radius);
        let point = |at| self.point(at);
        let origin = [0, 0, 0];
        self.meet(&[
            // Crossing, touching from outside and from inside, apart, one in the other about another centre and the same, one.
            (
                ball(origin, 5),
                ball([6, 0, 0], 5),
                vec![self.circle([3, 0, 0], [1, 0, 0], 4)],
            ),
            (ball(origin, 2), ball([5, 0, 0], 3), vec![point([2, 0, 0])]),
            (ball(origin, 5), ball([3, 0, 0], 2), vec![point([5, 0, 0])]),
            (ball(origin, 2), ball([6, 0, 0], 3), vec![]),
            (ball(origin, 9), ball([1, 0, 0], 2), vec![]),
            (ball(origin, 9), ball(origin, 2), vec![]),
            (ball(origin, 9), ball(origin, 9), vec![ball(origin, 9)]),
            // About the axis of a cylinder: through it, as wide, too thin.
            (
                ball([0, 0, 7], 5),
                self.pin(origin, 3),
                vec![self.ring([0, 0, 11], 3), self.ring([0, 0, 3], 3)],
            ),
            (
                ball([0, 0, 7], 3),
                self.pin(origin, 3),
                vec![self.ring([0, 0, 7], 3)],
            ),
            (ball([0, 0, 7], 2), self.pin(origin, 3), vec![]),
            // Beside it: touching from outside and from inside, and neither.
            (
                ball([8, 0, 1], 5),
                self.pin(origin, 3),
                vec![point([3, 0, 1])],
            ),
            (
                ball([1, 0, 4], 2),
                self.pin(origin, 3),
                vec![point([3, 0, 4])],
            ),
            (ball([9, 0, 1], 5), self.pin(origin, 3), vec![]),
            (ball([1, 0, 4], 1), self.pin(origin, 3), vec![]),
            // About the axis of a cone: twice, once, at its apex, below it; the same beside the axis.
            (
                ball([0, 0, 7], 5),
                self.horn(0, 1),
                vec![self.ring([0, 0, 4], 4), self.ring([0, 0, 3], 3)],
            ),
            (
                ball([0, 0, 1], 5),
                self.horn(0, 1),
                vec![self.ring([0, 0, 4], 4)],
            ),
            (ball([0, 0, -5], 5), self.horn(0, 2), vec![point(origin)]),
            (ball([0, 0, -6], 5), self.horn(0, 2), vec![]),
            (ball([3, 0, -4], 5), self.horn(0, 1), vec![point(origin)]),
            (ball([3, 0, -4], 4), self.horn(0, 1), vec![]),
        ]);
        self.do_not_meet_in_entities(&[
            (ball([1, 0, 0], 3), self.pin(origin, 3)),
            (ball([1, 0, 5], 3), self.horn(0, 1)),
        ]);
    }

    fn cylinders_and_cones_meet(&self) {
        let origin = [0, 0, 0];
        let across = |at, radius| self.cylinder(at, [0, 1, 0], radius);
        self.meet(&[
            // Parallel: crossing, touching from outside and from inside, apart, one in the other, about one axis, one.
            (
                self.pin(origin, 5),
                self.pin([6, 0, 9], 5),
                vec![
                    self.line([3, 4, 0], [0, 0, 1]),
                    self.line([3, -4, 0], [0, 0, 1]),
                ],
            ),
            (
                self.pin(origin, 2),
                self.pin([5, 0, 9], 3),
                vec![self.line([2, 0, 0], [0, 0, 1])],
            ),
            (
                self.pin(origin, 5),
                self.pin([3, 0, 9], 2),
                vec![self.line([5, 0, 0], [0, 0, 1])],
            ),
            (self.pin(origin, 2), self.pin([6, 0, 9], 3), vec![]),
            (self.pin(origin, 9), self.pin([1, 0, 9], 2), vec![]),
            (self.pin(origin, 9), self.pin([0, 0, 1], 2), vec![]),
            (
                self.pin(origin, 9),
                self.pin([0, 0, 1], 9),
                vec![self.pin(origin, 9)],
            ),
            // Skew: touching, apart.
            (
                self.pin(origin, 2),
                across([9, 0, 1], 7),
                vec![self.point([2, 0, 1])],
            ),
            (self.pin(origin, 2), across([9, 0, 1], 3), vec![]),
            (
                self.pin(origin, 3),
                self.horn(0, 5),
                vec![self.ring([0, 0, 3], 3)],
            ),
            (
                self.pin(origin, 3),
                self.horn(0, -1),
                vec![self.ring([0, 0, -3], 3)],
            ),
            // Cones against each other, by their apexes, apart; one in the other: crossing, in parallel, not at all, by one apex, one.
            (
                self.horn(0, 1),
                self.horn(6, -2),
                vec![self.ring([0, 0, 3], 3)],
            ),
            (self.horn(0, 1), self.horn(0, -2), vec![self.point(origin)]),
            (self.horn(0, 1), self.horn(-1, -2), vec![]),
            (
                self.horn(0, 1),
                self.cone([0, 0, 2], [0, 0, 1], 2),
                vec![self.ring([0, 0, 4], 4)],
            ),
            (self.horn(0, 1), self.horn(2, 3), vec![]),
            (self.horn(0, 1), self.cone([0, 0, -2], [0, 0, 1], 2), vec![]),
            (
                self.horn(0, 1),
                self.cone(origin, [0, 0, 1], 2),
                vec![self.point(origin)],
            ),
            (self.horn(0, 1), self.horn(0, 4), vec![self.horn(0, 1)]),
        ]);
        self.do_not_meet_in_entities(&[
            // Two ellipses, curves of degree four.
            (self.pin(origin, 2), across([0, 0, 1], 2)),
            (self.pin(origin, 2), across([0, 0, 1], 3)),
            (self.pin(origin, 2), across([1, 0, 1], 2)),
            (self.pin([1, 0, 0], 2), self.horn(0, 1)),
            (self.horn(0, 1), self.cone([1, 0, 0], [0, 0, 1], 2)),
        ]);
    }

    fn circles_meet_what_is_round(&self) {
        let origin = [0, 0, 0];
        let ring = || self.ring(origin, 5);
        let two = || vec![self.point([3, 4, 0]), self.point([3, -4, 0])];
        let standing = |radius| self.circle([3, 0, 0], [1, 0, 0], radius);
        self.meet(&[
            (ring(), self.ring([6, 0, 0], 5), two()),
            (ring(), self.ring([7, 0, 0], 2), vec![self.point([5, 0, 0])]),
            (ring(), self.ring([8, 0, 0], 2), vec![]),
            (ring(), self.ring(origin, 2), vec![]),
            (ring(), self.ring([0, 0, 1], 5), vec![]),
            (ring(), ring(), vec![ring()]),
            (ring(), standing(4), two()),
            (ring(), standing(3), vec![]),
            (ring(), self.sphere(origin, 5), vec![ring()]),
            (ring(), self.sphere([6, 0, 0], 5), two()),
            (ring(), self.sphere([0, 0, 9], 2), vec![]),
            (ring(), self.pin([6, 0, 3], 5), two()),
            (ring(), self.pin([0, 0, 3], 5), vec![ring()]),
            (
                ring(),
                self.cylinder(origin, [0, 1, 0], 3),
                [two(), vec![self.point([-3, 4, 0]), self.point([-3, -4, 0])]].concat(),
            ),
            (
                self.ring([0, 0, 3], 3),
                self.horn(0, 1),
                vec![self.ring([0, 0, 3], 3)],
            ),
            (self.ring([0, 0, 3], 2), self.horn(0, 1), vec![]),
            (ring(), self.horn(0, 1), vec![]),
        ]);
        let askew = || self.circle(origin, [0, 1, 1], 5);
        self.do_not_meet_in_entities(&[
            (askew(), self.pin(origin, 2)),
            (askew(), self.horn(-1, 1)),
        ]);
    }

    fn measures_round_things_about_one_axis(&self) {
        let origin = [0, 0, 0];
        let ring = || self.ring(origin, 5);
        let rows = [
            // A ball inside of a circle, around it, through it, beside it and above.
            (self.sphere(origin, 2), ring(), 3.0),
            (self.sphere(origin, 9), ring(), 4.0),
            (self.sphere(origin, 5), ring(), 0.0),
            (self.sphere([4, 0, 0], 2), ring(), 0.0),
            (self.sphere([8, 0, 0], 2), ring(), 1.0),
            (self.sphere([9, 0, 3], 1), ring(), 4.0),
            (self.sphere([3, 0, -4], 2), self.horn(0, 1), 3.0),
            (self.sphere([0, 0, 5], 9), self.horn(0, 1), 0.0),
            (ring(), self.ring([0, 0, 12], 10), 13.0),
            (self.ring(origin, 2), self.ring([9, 0, 3], 3), 5.0),
            (ring(), self.ring([6, 0, 0], 5), 0.0),
            (ring(), self.ring([6, 0, 2], 5), 2.0),
            (self.ring(origin, 2), self.pin([7, 0, 1], 3), 2.0),
            (self.ring([0, 0, 7], 7), self.horn(0, 1), 0.0),
            (self.ring([0, 0, -4], 3), self.horn(0, 1), 5.0),
            (self.pin([7, 0, 1], 3), self.horn(0, 1), 0.0),
            (self.horn(0, 1), self.horn(-5, -1), 5.0),
            (self.horn(0, 1), self.horn(5, -1), 0.0),
            // One in the other, with sides in parallel.
            (self.horn(0, 1), self.horn(4, 1), 8.0_f64.sqrt()),
        ];
        for (row, (a, b, expected)) in rows.iter().enumerate() {
            for (first, second) in [(a, b), (b, a)] {
                let found = distance(first, second);
                let found = found.unwrap_or_else(|error| panic!("row {row}: {error}"));
                self.is_near(&found.value, *expected, &format!("row {row}"));
            }
        }
        let askew = || self.circle(origin, [0, 1, 1], 5);
        assert!(distance(&askew(), &ring()).is_err());
        assert!(distance(&askew(), &self.pin(origin, 2)).is_err());
        assert!(distance(&self.horn(0, 1), &self.ring([1, 0, 0], 2)).is_err());
        let tilted = self.cone(origin, [0, 1, 1], 1);
        assert!(distance(&self.horn(0, 1), &tilted).is_err());
        assert!(distance(&self.pin(origin, 1), &tilted).is_err());
    }

    fn projects_on_what_is_round(&self) {
        let origin = [0, 0, 0];
        let point = |at| self.point(at);
        let rows = [
            (point([8, 6, 0]), self.sphere(origin, 5), [4, 3, 0]),
            (point([2, 0, 0]), self.sphere(origin, 5), [5, 0, 0]),
            (point([8, 6, 7]), self.pin(origin, 5), [4, 3, 7]),
            (point([8, 6, 7]), self.ring(origin, 5), [4, 3, 0]),
            // In front of its side, inside, behind its apex, on its axis behind that.
            (point([4, 0, 0]), self.horn(0, 1), [2, 0, 2]),
            (point([0, 1, 3]), self.horn(0, 1), [0, 2, 2]),
            (point([1, 0, -3]), self.horn(0, 1), origin),
            (point([0, 0, -3]), self.horn(0, 1), origin),
        ];
        for (row, (a, on, expected)) in rows.iter().enumerate() {
            let found = projection(a, on, None);
            let found = found.unwrap_or_else(|error| panic!("row {row}: {error}"));
            self.is_found(&found, Some(point(*expected)), &format!("row {row}"));
        }
        for (at, on) in [
            (origin, self.sphere(origin, 5)),
            ([0, 0, 4], self.pin(origin, 5)),
            ([0, 0, 4], self.ring(origin, 5)),
            ([0, 0, 4], self.horn(0, 1)),
        ] {
            assert!(projection(&point(at), &on, None).is_err(), "{on:?}");
        }
        let light = self.towards([0, 1, 0]);
        let found = projection(&point([3, 9, 0]), &self.sphere(origin, 5), Some(&light));
        let both = [point([3, 4, 0]), point([3, -4, 0])];
        self.are_found(&found.expect("valid by construction"), &both, "ball");
        let missed = projection(&point([6, 9, 0]), &self.pin(origin, 5), Some(&light));
        self.are_found(&missed.expect("valid by construction"), &[], "pin");
    }

    fn projects_circles_on_planes(&self) {
        let floor = self.plane([0, 0, 0], [0, 0, 1]);
        let ring = self.ring([1, 2, 9], 3);
        let slanted = self.towards([1, 0, 1]);
        let level = self.towards([1, 0, 0]);
        let standing = self.circle([1, 2, 9], [1, 0, 0], 3);
        let rows = [
            (&ring, None, Some(self.ring([1, 2, 0], 3))),
            (&ring, Some(&slanted), Some(self.ring([-8, 2, 0], 3))),
            (&ring, Some(&level), None),
            (&standing, None, Some(self.segment([1, 5, 0], [1, -1, 0]))),
        ];
        for (row, (circle, light, expected)) in rows.into_iter().enumerate() {
            let found = projection(circle, &floor, light);
            let found = found.unwrap_or_else(|error| panic!("row {row}: {error}"));
            self.is_found(&found, expected, &format!("row {row}"));
        }
        assert!(projection(&standing, &floor, Some(&slanted)).is_err());
        let askew = self.circle([1, 2, 9], [1, 0, 1], 3);
        assert!(projection(&askew, &floor, None).is_err());
        assert!(projection(&ring, &self.line([0, 0, 0], [1, 0, 0]), None).is_err());
    }
}

in_both_forms!(
    spheres_meet_what_is_round,
    cylinders_and_cones_meet,
    circles_meet_what_is_round,
    measures_round_things_about_one_axis,
    projects_on_what_is_round,
    projects_circles_on_planes,
);
