//! What is straight or flat, and what is round: what they have in common, what is contained in what, and how far they are apart.

use super::{EXACT, TOLERANT, With};
use crate::{Entity, Line, Scalar, Sphere, contained, coplanar, distance, intersection};

impl<S: Scalar> With<S> {
    fn meets_what_is_round(&self) {
        let ball = || self.sphere([1, 2, 3], 5);
        let pin = || self.cylinder([1, 2, 0], [0, 0, 2], 5);
        let ring = || self.circle([1, 2, 0], [0, 0, 3], 5);
        // Opens upwards, as wide as it is high.
        let horn = || self.cone([0, 0, 1], [0, 0, 2], 1);
        let point = |at| self.point(at);
        let rows = [
            // A chord, a tangent, a miss.
            (
                self.line([1, 5, 3], [2, 0, 0]),
                ball(),
                vec![point([5, 5, 3]), point([-3, 5, 3])],
            ),
            (
                self.line([9, 7, 3], [1, 0, 0]),
                ball(),
                vec![point([1, 7, 3])],
            ),
            (self.line([9, 8, 3], [1, 0, 0]), ball(), vec![]),
            (
                self.line([1, 5, 9], [2, 0, 0]),
                pin(),
                vec![point([5, 5, 9]), point([-3, 5, 9])],
            ),
            (
                self.line([9, 7, 4], [1, 0, 0]),
                pin(),
                vec![point([1, 7, 4])],
            ),
            (self.line([9, 8, 4], [1, 0, 1]), pin(), vec![]),
            // Along it: on its surface all along, inside of it nowhere.
            (
                self.line([5, 5, 0], [0, 0, 1]),
                pin(),
                vec![self.line([5, 5, 7], [0, 0, -1])],
            ),
            (self.line([1, 2, 0], [0, 0, 1]), pin(), vec![]),
            // In the plane of a circle, through it, past it.
            (
                self.line([1, 5, 0], [1, 0, 0]),
                ring(),
                vec![point([5, 5, 0]), point([-3, 5, 0])],
            ),
            (
                self.line([5, 5, 0], [1, 1, 1]),
                ring(),
                vec![point([5, 5, 0])],
            ),
            (self.line([5, 4, 0], [1, 1, 1]), ring(), vec![]),
            (self.line([5, 5, 1], [1, 0, 0]), ring(), vec![]),
            (
                self.line([0, 3, 5], [1, 0, 0]),
                self.cone([0, 0, 0], [0, 0, 1], 1),
                vec![point([4, 3, 5]), point([-4, 3, 5])],
            ),
            // Both halves would be met, at 1 ± 3; the lower one is no part of it.
            (
                self.line([3, 0, 0], [0, 0, 1]),
                horn(),
                vec![point([3, 0, 4])],
            ),
            (
                self.line([0, 0, 1], [1, 0, 0]),
                horn(),
                vec![point([0, 0, 1])],
            ),
            (self.line([0, 0, 0], [1, 0, 0]), horn(), vec![]),
            // As steep as its side: once, and beside the apex never.
            (self.line([2, 0, 1], [1, 0, 1]), horn(), vec![]),
            (
                self.line([2, 0, 1], [-1, 0, 1]),
                horn(),
                vec![point([1, 0, 2])],
            ),
            (
                self.line([0, 2, 1], [1, 0, 1]),
                self.cone([0, 0, 1], [0, 0, 1], 1),
                vec![],
            ),
            // Parts of what a line meets.
            (
                self.segment([1, 5, 3], [9, 5, 3]),
                ball(),
                vec![point([5, 5, 3])],
            ),
            (self.segment([0, 5, 3], [2, 5, 3]), ball(), vec![]),
            (
                self.segment([5, 5, 3], [9, 5, 3]),
                ball(),
                vec![point([5, 5, 3])],
            ),
            (
                self.segment([5, 5, 0], [5, 5, 2]),
                pin(),
                vec![self.segment([5, 5, 0], [5, 5, 2])],
            ),
            (
                self.segment([2, 0, 3], [4, 0, 5]),
                horn(),
                vec![self.segment([2, 0, 3], [4, 0, 5])],
            ),
            (
                self.segment([-2, 0, -1], [4, 0, 5]),
                horn(),
                vec![self.segment([0, 0, 1], [4, 0, 5])],
            ),
            (
                self.segment([-2, 0, -1], [0, 0, 1]),
                horn(),
                vec![point([0, 0, 1])],
            ),
            (self.segment([-2, 0, -1], [-1, 0, 0]), horn(), vec![]),
            // Planes.
            (
                self.plane([0, 0, 6], [0, 0, 2]),
                ball(),
                vec![self.circle([1, 2, 6], [0, 0, 1], 4)],
            ),
            (
                self.plane([0, 0, 8], [0, 0, 2]),
                ball(),
                vec![point([1, 2, 8])],
            ),
            (self.plane([0, 0, 9], [0, 0, 2]), ball(), vec![]),
            (
                self.plane([0, 0, 6], [0, 0, 2]),
                pin(),
                vec![self.circle([1, 2, 6], [0, 0, 1], 5)],
            ),
            (
                self.plane([0, 5, 0], [0, 3, 0]),
                pin(),
                vec![
                    self.line([5, 5, 0], [0, 0, 1]),
                    self.line([-3, 5, 0], [0, 0, 1]),
                ],
            ),
            (
                self.plane([0, 7, 0], [0, 3, 0]),
                pin(),
                vec![self.line([1, 7, 0], [0, 0, 1])],
            ),
            (self.plane([0, 8, 0], [0, 3, 0]), pin(), vec![]),
            (
                self.plane([0, 0, 4], [0, 0, -1]),
                horn(),
                vec![self.circle([0, 0, 4], [0, 0, 1], 3)],
            ),
            (
                self.plane([0, 0, 1], [0, 0, -1]),
                horn(),
                vec![point([0, 0, 1])],
            ),
            (self.plane([0, 0, 0], [0, 0, -1]), horn(), vec![]),
            (self.plane([0, 0, 0], [0, 0, -1]), ring(), vec![ring()]),
            (
                self.plane([0, 5, 0], [0, 1, 0]),
                ring(),
                vec![point([5, 5, 0]), point([-3, 5, 0])],
            ),
            (self.plane([0, 0, 1], [0, 0, -1]), ring(), vec![]),
        ];
        for (row, (a, b, expected)) in rows.iter().enumerate() {
            for (first, second) in [(a, b), (b, a)] {
                let found = intersection(first, second).expect("valid by construction");
                self.are_found(&found, expected, &format!("row {row}"));
            }
        }
        // Half of a line, an ellipse, a parabola.
        assert!(intersection(&self.line([0, 0, 1], [1, 0, 1]), &horn()).is_err());
        assert!(intersection(&self.plane([0, 0, 0], [0, 1, 1]), &pin()).is_err());
        assert!(intersection(&self.plane([0, 0, 0], [0, 1, 1]), &horn()).is_err());
    }

    fn contains_what_is_round(&self) {
        let pin = || self.cylinder([1, 2, 0], [0, 0, 2], 5);
        let horn = || self.cone([0, 0, 1], [0, 0, 2], 2);
        let ball = || self.sphere([1, 2, 3], 5);
        let ring = |z, radius| self.circle([1, 2, z], [0, 0, -1], radius);
        let rows = [
            (self.line([5, 5, 1], [0, 0, 1]), pin(), true),
            (self.line([5, 4, 1], [0, 0, 1]), pin(), false),
            (self.line([5, 5, 1], [0, 1, 1]), pin(), false),
            (self.segment([5, 5, 1], [5, 5, 2]), pin(), true),
            // Both ends are on it, and the middle is inside.
            (self.segment([5, 5, 1], [-3, 5, 1]), pin(), false),
            (self.segment([2, 0, 2], [6, 0, 4]), horn(), true),
            (self.segment([0, 0, 1], [6, 0, 4]), horn(), true),
            (self.segment([2, 0, 2], [-2, 0, 2]), horn(), false),
            (self.segment([2, 0, 2], [-2, 0, 0]), horn(), false),
            (ring(7, 5), pin(), true),
            (ring(7, 4), pin(), false),
            (self.circle([1, 3, 7], [0, 0, 1], 5), pin(), false),
            (self.circle([1, 2, 7], [0, 1, 1], 5), pin(), false),
            (self.circle([0, 0, 3], [0, 0, 1], 4), horn(), true),
            (self.circle([0, 0, -1], [0, 0, 1], 4), horn(), false),
            (self.circle([0, 0, 3], [0, 0, 1], 3), horn(), false),
            (ring(7, 3), ball(), true),
            (ring(3, 5), ball(), true),
            (ring(7, 4), ball(), false),
            (self.circle([1, 2, 7], [0, 1, 1], 3), ball(), false),
            (ring(7, 3), self.plane([0, 0, 7], [0, 0, 1]), true),
            (ring(7, 3), self.plane([0, 0, 6], [0, 0, 1]), false),
            (ring(7, 3), self.plane([1, 2, 7], [0, 1, 1]), false),
        ];
        for (row, (a, b, holds)) in rows.iter().enumerate() {
            let found = contained(a, b).expect("valid by construction");
            assert!(
                found.is_yes() == *holds && found.is_no() != *holds,
                "row {row}: {found:?}"
            );
        }
        assert!(contained(&self.line([0, 0, 0], [1, 0, 0]), &horn()).is_err());
        assert!(contained(&self.segment([0, 0, 0], [1, 0, 0]), &ball()).is_err());
        assert!(contained(&ball(), &pin()).is_err());
        let rows = [
            (ring(7, 3), self.line([0, 0, 7], [1, 0, 0]), true),
            (ring(7, 3), self.line([0, 0, 7], [1, 0, 1]), false),
            (ring(7, 3), self.point([9, 9, 7]), true),
            (ring(7, 3), self.plane([0, 0, 7], [0, 0, 5]), true),
            (ring(7, 3), self.circle([4, 4, 7], [0, 0, 1], 1), true),
            (ring(7, 3), self.circle([1, 2, 7], [0, 1, 1], 3), false),
        ];
        self.both_ways(coplanar, &rows);
        assert!(coplanar(&ring(7, 3), &ball()).is_err());
    }

    fn measures_between_round_things(&self) {
        let ball = |x, radius| self.sphere([x, 0, 0], radius);
        let pin = |x, radius| self.cylinder([x, 0, 0], [0, 0, 2], radius);
        let rows = [
            // Beside each other, touching, meeting, one in the other.
            (ball(0, 2), ball(7, 3), 2.0),
            (ball(0, 2), ball(5, 3), 0.0),
            (ball(0, 2), ball(4, 3), 0.0),
            (ball(0, 9), ball(4, 3), 2.0),
            (ball(0, 2), pin(7, 3), 2.0),
            (ball(0, 2), pin(4, 3), 0.0),
            (ball(0, 2), pin(1, 5), 2.0),
            // A cylinder does not end inside of a ball.
            (ball(0, 9), pin(1, 5), 0.0),
            (pin(0, 2), pin(7, 3), 2.0),
            (pin(0, 2), pin(1, 5), 2.0),
            (pin(0, 2), pin(4, 3), 0.0),
            (pin(0, 2), self.cylinder([9, 0, 0], [0, 1, 0], 3), 4.0),
            (pin(0, 9), self.cylinder([1, 0, 0], [0, 1, 0], 3), 0.0),
            (self.segment([4, 0, 1], [4, 9, 1]), pin(0, 2), 2.0),
            (self.segment([4, -9, 1], [4, 9, 5]), pin(0, 5), 0.0),
            (self.segment([1, 0, 0], [3, 0, 0]), pin(0, 5), 2.0),
            (self.segment([6, 8, 1], [9, 12, 1]), pin(0, 5), 5.0),
            (self.segment([4, 0, 0], [4, 9, 0]), ball(0, 2), 2.0),
            (self.segment([6, 8, 0], [9, 12, 0]), ball(0, 5), 5.0),
            (self.segment([1, 0, 0], [0, 3, 0]), ball(0, 5), 2.0),
            (self.segment([0, 0, 0], [9, 0, 0]), ball(0, 5), 0.0),
        ];
        for (row, (a, b, expected)) in rows.iter().enumerate() {
            for (first, second) in [(a, b), (b, a)] {
                let found = distance(first, second)
                    .expect("valid by construction")
                    .value;
                self.is_near(&found, *expected, &format!("row {row}"));
            }
        }
    }
}

/// A line that touches a ball within its digits meets it there, and that is told.
#[test]
fn a_measured_tangent_touches_within_its_digits() {
    use crate::{Certainty, Measured, Point};
    let number = |x: f64, u: f64| Measured::new(x, u).expect("valid by construction");
    let radius = number(2.0, 1e-3);
    let ball: Entity<Measured> = Sphere::new(TOLERANT.at([0, 0, 0]), radius)
        .expect("valid by construction")
        .into();
    let at = Point([number(0.0, 0.0), number(2.0, 1e-3), number(0.0, 0.0)]);
    let tangent = Line::new(at, TOLERANT.towards([1, 0, 0])).into();
    let met = intersection(&tangent, &ball).expect("valid by construction");
    assert_eq!(
        (met.value.parts().len(), met.certainty),
        (1, Certainty::WithinDigits)
    );
}

in_both_forms!(
    meets_what_is_round,
    contains_what_is_round,
    measures_between_round_things,
);
