//! Circles, cylinders, cones and spheres with each partner.

use super::{EXACT, TOLERANT, Three, With};
use crate::{
    Answer, Certainty, Circle, Cone, Cylinder, Entity, Line, Measured, Place, Scalar, Sphere,
    Transformation, Vector, angle_between, classify_by_round, coaxial, coincide, compare_radii,
    concentric, contained, distance, parallel, perpendicular, radius_difference,
};
use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_4;

impl<S: Scalar> With<S> {
    pub(super) fn circle(&self, at: Three, normal: Three, radius: i32) -> Entity<S> {
        Circle::new(self.at(at), self.towards(normal), S::whole(radius))
            .expect("valid by construction")
            .into()
    }

    pub(super) fn cylinder(&self, at: Three, along: Three, radius: i32) -> Entity<S> {
        let axis = Line::new(self.at(at), self.towards(along));
        Cylinder::new(axis, S::whole(radius))
            .expect("valid by construction")
            .into()
    }

    pub(super) fn cone(&self, apex: Three, along: Three, tangent: i32) -> Entity<S> {
        Cone::new(self.at(apex), self.towards(along), S::whole(tangent))
            .expect("valid by construction")
            .into()
    }

    pub(super) fn sphere(&self, centre: Three, radius: i32) -> Entity<S> {
        Sphere::new(self.at(centre), S::whole(radius))
            .expect("valid by construction")
            .into()
    }

    fn asks_about_axes_and_centres(&self) {
        let pin = || self.cylinder([1, 2, 3], [0, 0, 2], 4);
        let rows = [
            (pin(), self.cylinder([1, 2, 9], [0, 0, -1], 7), true),
            (pin(), self.cylinder([1, 3, 9], [0, 0, -1], 4), false),
            (pin(), self.cylinder([1, 2, 3], [0, 1, 2], 4), false),
            (pin(), self.cone([1, 2, 0], [0, 0, 1], 1), true),
            (pin(), self.circle([1, 2, 0], [0, 0, 1], 1), true),
            (pin(), self.circle([1, 2, 0], [0, 1, 1], 1), false),
            (pin(), self.line([1, 2, 0], [0, 0, 1]), true),
            (pin(), self.sphere([1, 2, 7], 1), true),
            (pin(), self.sphere([1, 1, 7], 1), false),
        ];
        self.both_ways(coaxial, &rows);
        assert!(coaxial(&self.sphere([0, 0, 0], 1), &self.sphere([0, 0, 0], 1)).is_err());
        assert!(coaxial(&pin(), &self.point([1, 2, 3])).is_err());
        let rows = [
            (self.sphere([1, 2, 3], 1), self.sphere([1, 2, 3], 5), true),
            (self.sphere([1, 2, 3], 1), self.sphere([1, 2, 4], 1), false),
            (
                self.sphere([1, 2, 3], 1),
                self.circle([1, 2, 3], [1, 0, 0], 1),
                true,
            ),
            (self.sphere([1, 2, 3], 1), self.point([1, 2, 3]), true),
        ];
        self.both_ways(concentric, &rows);
        assert!(concentric(&self.point([0, 0, 0]), &self.point([0, 0, 0])).is_err());
        assert!(concentric(&pin(), &pin()).is_err());
    }

    fn asks_what_is_round(&self) {
        let rows = [
            (
                self.circle([1, 2, 3], [0, 0, 1], 2),
                self.circle([1, 2, 3], [0, 0, -5], 2),
                true,
            ),
            (
                self.circle([1, 2, 3], [0, 0, 1], 2),
                self.circle([1, 2, 3], [0, 0, 1], 3),
                false,
            ),
            (
                self.cylinder([1, 2, 3], [0, 0, 1], 2),
                self.cylinder([1, 2, 5], [0, 0, -1], 2),
                true,
            ),
            (
                self.cone([1, 2, 3], [0, 0, 1], 2),
                self.cone([1, 2, 3], [0, 0, 4], 2),
                true,
            ),
            (
                self.cone([1, 2, 3], [0, 0, 1], 2),
                self.cone([1, 2, 3], [0, 0, -1], 2),
                false,
            ),
            (
                self.cone([1, 2, 3], [0, 0, 1], 2),
                self.cone([1, 2, 4], [0, 0, 1], 2),
                false,
            ),
            (self.sphere([1, 2, 3], 2), self.sphere([1, 2, 3], 2), true),
            (self.sphere([1, 2, 3], 2), self.sphere([1, 2, 3], 1), false),
        ];
        self.both_ways(coincide, &rows);
        assert!(
            coincide(
                &self.sphere([0, 0, 0], 1),
                &self.circle([0, 0, 0], [1, 0, 0], 1)
            )
            .is_err()
        );
        let pin = || self.cylinder([1, 2, 3], [0, 0, 2], 4);
        let rows = [
            (pin(), self.line([0, 0, 0], [0, 0, 1]), true),
            (pin(), self.plane([0, 0, 0], [1, 0, 0]), true),
            (pin(), self.circle([0, 0, 0], [0, 0, 1], 1), false),
            (pin(), self.cone([0, 0, 0], [0, 0, -1], 1), true),
        ];
        self.both_ways(parallel, &rows);
        let rows = [
            (pin(), self.plane([0, 0, 0], [0, 0, 1]), true),
            (pin(), self.circle([0, 0, 0], [0, 0, 1], 1), true),
        ];
        self.both_ways(perpendicular, &rows);
        assert!(parallel(&pin(), &self.sphere([0, 0, 0], 1)).is_err());
        let angle = angle_between(&pin(), &self.plane([0, 0, 0], [0, 1, 1]));
        let angle = angle.expect("valid by construction").angle;
        self.is_near(&angle, FRAC_PI_4, "axis and plane");
        let order = compare_radii(&pin(), &self.sphere([0, 0, 0], 3));
        let order = order.expect("valid by construction");
        assert_eq!(
            (order.value, order.certainty),
            (Ordering::Greater, Certainty::Proven)
        );
        let clearance = radius_difference(&self.cylinder([0, 0, 0], [1, 0, 0], 5), &pin());
        self.is_near(&clearance.expect("valid by construction"), 1.0, "clearance");
        assert!(compare_radii(&pin(), &self.cone([0, 0, 0], [1, 0, 0], 1)).is_err());
    }

    fn places_points_beside_round_things(&self) {
        let sphere = || self.sphere([1, 0, 0], 5);
        let pin = || self.cylinder([1, 0, 0], [0, 0, 3], 5);
        let cone = || self.cone([0, 0, 1], [0, 0, 2], 2);
        let rows = [
            (sphere(), [4, 4, 0], Place::OnBorder),
            (sphere(), [1, 0, 0], Place::Inside),
            (sphere(), [4, 4, 1], Place::Outside),
            (pin(), [4, 4, 77], Place::OnBorder),
            (pin(), [1, 0, 9], Place::Inside),
            (pin(), [7, 0, 0], Place::Outside),
            (cone(), [0, 0, 1], Place::OnBorder),
            (cone(), [2, 0, 2], Place::OnBorder),
            (cone(), [1, 0, 2], Place::Inside),
            (cone(), [3, 0, 2], Place::Outside),
            (cone(), [2, 0, 0], Place::Outside),
            (cone(), [0, 0, 0], Place::Outside),
        ];
        for (row, (entity, at, expected)) in rows.iter().enumerate() {
            let found = classify_by_round(&self.at(*at), entity).expect("valid by construction");
            assert_eq!(found.value, *expected, "row {row}");
            assert_eq!(found.certainty, Certainty::Proven, "row {row}");
            let on = if *expected == Place::OnBorder {
                Answer::Yes
            } else {
                Answer::No
            };
            assert_eq!(contained(&self.point(*at), entity), Ok(on), "row {row}");
        }
        let circle = self.circle([1, 0, 0], [0, 0, 1], 5);
        for (at, on) in [
            ([4, 4, 0], Answer::Yes),
            ([4, 4, 1], Answer::No),
            ([1, 0, 0], Answer::No),
        ] {
            assert_eq!(contained(&self.point(at), &circle), Ok(on), "{at:?}");
        }
        assert!(classify_by_round(&self.at([0, 0, 0]), &circle).is_err());
    }

    fn measures_to_round_things(&self) {
        let sphere = || self.sphere([0, 0, 0], 2);
        let pin = || self.cylinder([0, 0, 0], [0, 0, 3], 2);
        let ring = || self.circle([0, 0, 0], [0, 0, 2], 2);
        let cone = || self.cone([0, 0, 0], [0, 0, 2], 1);
        let half = 0.5f64.sqrt();
        let rows = [
            (self.point([3, 4, 0]), sphere(), 3.0),
            (self.point([0, 0, 0]), sphere(), 2.0),
            (self.point([0, 2, 0]), sphere(), 0.0),
            (self.line([5, 0, 0], [0, 1, 0]), sphere(), 3.0),
            (self.line([2, 0, 0], [0, 1, 0]), sphere(), 0.0),
            (self.line([1, 0, 0], [0, 1, 0]), sphere(), 0.0),
            (self.plane([0, 0, -5], [0, 0, 3]), sphere(), 3.0),
            (self.plane([0, 0, 1], [0, 0, 3]), sphere(), 0.0),
            (self.point([3, 4, 9]), pin(), 3.0),
            (self.point([0, 0, 9]), pin(), 2.0),
            (self.line([5, 0, 0], [0, 0, 1]), pin(), 3.0),
            (self.line([1, 0, 0], [0, 0, 1]), pin(), 1.0),
            (self.line([5, 0, 7], [0, 1, 1]), pin(), 3.0),
            (self.line([1, 0, 7], [0, 1, 1]), pin(), 0.0),
            (self.plane([5, 0, 0], [2, 0, 0]), pin(), 3.0),
            (self.plane([2, 0, 0], [2, 0, 0]), pin(), 0.0),
            (self.plane([50, 0, 0], [2, 0, 1]), pin(), 0.0),
            (self.point([5, 0, 4]), ring(), 5.0),
            (self.point([0, 0, 0]), ring(), 2.0),
            (self.point([0, 2, 0]), ring(), 0.0),
            (self.plane([0, 0, 3], [0, 0, 1]), ring(), 3.0),
            (self.plane([5, 0, 0], [1, 0, 0]), ring(), 3.0),
            (self.plane([1, 0, 0], [1, 0, 0]), ring(), 0.0),
            (self.point([0, 0, -3]), cone(), 3.0),
            (self.point([0, 0, 1]), cone(), half),
            (self.point([1, 0, 1]), cone(), 0.0),
            (self.point([1, 0, -1]), cone(), 2f64.sqrt()),
            (self.point([2, 0, 0]), cone(), 2f64.sqrt()),
            (self.plane([0, 0, -3], [0, 0, 1]), cone(), 3.0),
            (self.plane([0, 0, 3], [0, 0, 1]), cone(), 0.0),
            // Along a side of the cone, below it.
            (self.plane([0, 0, -2], [-1, 0, 1]), cone(), 2f64.sqrt()),
            (self.plane([0, 0, -2], [-2, 0, 1]), cone(), 0.0),
            (self.plane([0, 0, -3], [0, 0, -1]), cone(), 3.0),
        ];
        for (row, (a, b, expected)) in rows.iter().enumerate() {
            for outcome in [distance(a, b), distance(b, a)] {
                let outcome = outcome.expect("valid by construction");
                self.is_near(&outcome.value, *expected, &format!("row {row}"));
                if self.exact {
                    assert_eq!(outcome.certainty, Certainty::Proven, "row {row}");
                }
            }
        }
        assert!(distance(&self.line([0, 0, 0], [1, 0, 0]), &ring()).is_err());
        assert!(distance(&self.line([0, 0, 0], [1, 0, 0]), &cone()).is_err());
        assert!(distance(&self.segment([0, 0, 0], [1, 0, 0]), &cone()).is_err());
    }

    fn moves_round_things(&self) {
        let axis = Line::new(self.at([0, 0, 0]), self.towards([0, 0, 1]));
        let quarter = Transformation::about(&axis, &S::whole(0), &S::whole(1));
        let shift = Transformation::translation(&Vector(self.three([0, 0, 5])));
        let motion = quarter.expect("valid by construction").then(&shift);
        let rows = [
            (
                self.circle([1, 0, 0], [1, 2, 0], 3),
                self.circle([0, 1, 5], [-2, 1, 0], 3),
            ),
            (
                self.cylinder([1, 0, 0], [1, 2, 0], 3),
                self.cylinder([0, 1, 5], [-2, 1, 0], 3),
            ),
            (
                self.cone([1, 0, 0], [1, 2, 0], 3),
                self.cone([0, 1, 5], [-2, 1, 0], 3),
            ),
            (self.sphere([1, 0, 0], 3), self.sphere([0, 1, 5], 3)),
        ];
        for (a, expected) in &rows {
            let found = motion.entity(a).expect("valid by construction");
            assert_eq!(coincide(&found, expected), Ok(Answer::Yes), "{a:?}");
        }
    }

    fn refuses_what_has_no_radius(&self) {
        let (at, up) = (|| self.at([0, 0, 0]), || self.towards([0, 0, 1]));
        for radius in [0, -1] {
            assert!(Circle::new(at(), up(), S::whole(radius)).is_err());
            assert!(Cylinder::new(Line::new(at(), up()), S::whole(radius)).is_err());
            assert!(Cone::new(at(), up(), S::whole(radius)).is_err());
            assert!(Sphere::new(at(), S::whole(radius)).is_err());
        }
    }
}

#[test]
fn measured_radii_are_compared_within_their_digits() {
    let pin = |radius: f64| -> Entity<Measured> {
        let axis = Line::new(TOLERANT.at([0, 0, 0]), TOLERANT.towards([0, 0, 1]));
        let radius = Measured::new(radius, 0.005).expect("valid by construction");
        Cylinder::new(axis, radius)
            .expect("valid by construction")
            .into()
    };
    let near = compare_radii(&pin(4.0), &pin(4.009)).expect("valid by construction");
    assert_eq!(near.certainty, Certainty::WithinDigits);
    let far = compare_radii(&pin(4.0), &pin(4.011)).expect("valid by construction");
    assert_eq!(
        (far.value, far.certainty),
        (Ordering::Less, Certainty::Proven)
    );
    assert_eq!(coincide(&pin(4.0), &pin(4.009)), Ok(Answer::WithinDigits));
    assert_eq!(coincide(&pin(4.0), &pin(4.011)), Ok(Answer::No));
    assert_eq!(coaxial(&pin(4.0), &pin(5.0)), Ok(Answer::Yes));
    let thin = Measured::new(0.001, 0.005).expect("valid by construction");
    assert!(Sphere::new(TOLERANT.at([0, 0, 0]), thin).is_err());
}

in_both_forms!(
    asks_about_axes_and_centres,
    asks_what_is_round,
    places_points_beside_round_things,
    measures_to_round_things,
    moves_round_things,
    refuses_what_has_no_radius,
);
