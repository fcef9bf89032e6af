//! Distances and angles with each pair of arguments.

use super::{EXACT, TOLERANT, With};
use crate::{Certainty, Scalar, angle_between, distance, signed_angle_between};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, FRAC_PI_4, PI};

impl<S: Scalar> With<S> {
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
            for outcome in [
                distance(a, b).expect("valid by construction"),
                distance(b, a).expect("valid by construction"),
            ] {
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
            for angles in [
                angle_between(a, b).expect("valid by construction"),
                angle_between(b, a).expect("valid by construction"),
            ] {
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
                let angles = signed_angle_between(&a, &b, &up)
                    .expect("valid by construction")
                    .value;
                self.is_near(&angles.angle, expected, "angle");
                self.is_near(&angles.supplement, supplement, "supplement");
            }
        }
        let along = self.direction([0, 0, -1]);
        assert!(signed_angle_between(&along, &self.direction([1, 0, 0]), &up).is_err());
        let line = self.line([0, 0, 0], [1, 0, 0]);
        assert!(signed_angle_between(&line, &line, &up).is_err());
    }
}

in_both_forms!(measures_distances, measures_angles, measures_signed_angles,);
