//! Functions of faces with each partner: a square of 6 with a square hole of 2, and a jagged one.

use super::{BOX, EXACT, TOLERANT, Three, With, box_corners};
use crate::{
    Answer, BoundaryBuilder, Certainty, Entity, Face, FacePlace, Line, Measured, Place, Point,
    Scalar, Side, angle_between, classify, classify_by_face, classify_in_face, classify_in_solid,
    coincide, contained, coplanar, distance, intersection, parallel, perpendicular, projection,
    signed_angle_between,
};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

const OUTER: [Three; 4] = [[0, 0, 0], [6, 0, 0], [6, 6, 0], [0, 6, 0]];
const HOLE: [Three; 4] = [[2, 2, 0], [2, 4, 0], [4, 4, 0], [4, 2, 0]];
/// Teeth with tips at x = 1 and x = 5, and a notch down to y = 2 at x = 3.
const JAGGED: [Three; 5] = [[0, 0, 0], [6, 0, 0], [5, 4, 0], [3, 2, 0], [1, 4, 0]];

impl<S: Scalar> With<S> {
    fn holed(&self) -> Entity<S> {
        self.face(&[&OUTER, &HOLE])
    }

    fn jagged(&self) -> Entity<S> {
        self.face(&[&JAGGED])
    }

    fn asks_about_faces(&self) {
        let face = self.holed();
        let rows = [
            (self.point([1, 1, 0]), true),
            (self.point([3, 3, 0]), false),
            (self.point([2, 3, 0]), true),
            (self.point([4, 4, 0]), true),
            (self.point([6, 3, 0]), true),
            (self.point([7, 3, 0]), false),
            (self.point([1, 1, 1]), false),
            (self.segment([1, 1, 0], [5, 1, 0]), true),
            (self.segment([0, 2, 0], [6, 2, 0]), true),
            (self.segment([1, 3, 0], [5, 3, 0]), false),
            (self.segment([1, 3, 0], [2, 3, 0]), true),
            (self.segment([1, 1, 0], [7, 1, 0]), false),
            (self.segment([0, 0, 0], [6, 0, 0]), true),
            (self.segment([0, 0, 0], [6, 6, 0]), false),
            (self.segment([1, 1, 0], [1, 1, 1]), false),
            (self.segment([2, 3, 0], [4, 3, 0]), false),
        ];
        for (row, (a, holds)) in rows.iter().enumerate() {
            let expected = if *holds { Answer::Yes } else { Answer::No };
            assert_eq!(contained(a, &face), Ok(expected), "row {row}");
        }
        assert!(contained(&self.line([0, 0, 0], [1, 0, 0]), &face).is_err());
        let floor = self.plane([9, 9, 0], [0, 0, -3]);
        assert_eq!(contained(&face, &floor), Ok(Answer::Yes));
        let raised = self.plane([0, 0, 1], [0, 0, 1]);
        assert_eq!(contained(&face, &raised), Ok(Answer::No));

        // The same set: begun elsewhere, reversed, with a corner more on a straight edge.
        let mut turned = OUTER;
        turned.rotate_left(1);
        let back = [[0, 6, 0], [6, 6, 0], [6, 0, 0], [3, 0, 0], [0, 0, 0]];
        let mut hole_back = HOLE;
        hole_back.reverse();
        let rows = [
            (self.holed(), self.face(&[&turned, &HOLE]), true),
            (self.holed(), self.face(&[&back, &hole_back]), true),
            (self.holed(), self.face(&[&OUTER]), false),
            (self.holed(), self.jagged(), false),
            (
                self.jagged(),
                self.face(&[&[[0, 0, 1], [6, 0, 1], [5, 4, 1], [3, 2, 1], [1, 4, 1]]]),
                false,
            ),
        ];
        self.both_ways(coincide, &rows);
        let rows = [
            (self.holed(), self.jagged(), true),
            (self.holed(), self.plane([1, 1, 0], [0, 0, 1]), true),
            (self.holed(), self.point([9, 9, 0]), true),
            (self.holed(), self.line([9, 9, 0], [1, 0, 0]), true),
            (self.holed(), self.line([9, 9, 0], [1, 0, 1]), false),
            (self.holed(), self.segment([9, 9, 1], [1, 0, 1]), false),
        ];
        self.both_ways(coplanar, &rows);
    }

    fn asks_directions_of_faces(&self) {
        let wall = || self.face(&[&[[0, 0, 0], [4, 0, 0], [4, 0, 4]]]);
        let rows = [
            (self.holed(), self.jagged(), true),
            (self.holed(), wall(), false),
            (self.holed(), self.plane([0, 0, 5], [0, 0, -1]), true),
            (self.holed(), self.line([0, 0, 5], [1, 2, 0]), true),
            (self.holed(), self.segment([0, 0, 5], [0, 0, 6]), false),
            (self.holed(), self.direction([0, 1, 0]), true),
        ];
        self.both_ways(parallel, &rows);
        let rows = [
            (self.holed(), self.jagged(), false),
            (self.holed(), wall(), true),
            (self.holed(), self.plane([0, 0, 5], [1, 0, 0]), true),
            (self.holed(), self.line([0, 0, 5], [0, 0, 2]), true),
            (self.holed(), self.segment([0, 0, 5], [1, 0, 6]), false),
        ];
        self.both_ways(perpendicular, &rows);
        let slanted = self.plane([0, 0, 0], [0, 1, 1]);
        let angle = angle_between(&self.holed(), &slanted).expect("valid by construction");
        self.is_near(&angle.angle, FRAC_PI_4, "face and plane");
        let about = self.towards([1, 0, 0]);
        let signed = signed_angle_between(&self.holed(), &wall(), &about)
            .expect("valid by construction")
            .value;
        self.is_near(&signed.angle, FRAC_PI_2, "from up to the front");
    }

    fn meet_the_holed_face(&self, rows: &[(Entity<S>, Vec<Entity<S>>)]) {
        for (row, (a, expected)) in rows.iter().enumerate() {
            let what = format!("row {row}");
            for outcome in [
                intersection(a, &self.holed()),
                intersection(&self.holed(), a),
            ] {
                let outcome = outcome.expect("valid by construction");
                self.are_found(&outcome, expected, &what);
            }
        }
    }

    fn intersects_faces(&self) {
        let line = |at: Three, along: Three| self.line(at, along);
        let segment = |from: Three, to: Three| self.segment(from, to);
        let point = |at: Three| self.point(at);
        let rows = [
            // Through it, at its border, through the hole, beside it, above it.
            (line([1, 1, 5], [0, 0, 2]), vec![point([1, 1, 0])]),
            (line([6, 3, 5], [0, 0, 2]), vec![point([6, 3, 0])]),
            (line([3, 3, 5], [0, 0, 2]), vec![]),
            (line([3, 3, 1], [1, 0, -1]), vec![point([4, 3, 0])]),
            (line([7, 3, 5], [0, 0, 2]), vec![]),
            (line([7, 3, 5], [1, 0, 0]), vec![]),
            // In its plane: across the hole, along its border, at a corner, beside.
            (
                line([9, 3, 0], [-1, 0, 0]),
                vec![segment([0, 3, 0], [2, 3, 0]), segment([4, 3, 0], [6, 3, 0])],
            ),
            (
                line([9, 2, 0], [-1, 0, 0]),
                vec![segment([0, 2, 0], [6, 2, 0])],
            ),
            (
                line([9, 0, 0], [-1, 0, 0]),
                vec![segment([0, 0, 0], [6, 0, 0])],
            ),
            (line([5, -5, 0], [1, 1, 0]), vec![]),
            (line([6, 0, 0], [1, 1, 0]), vec![point([6, 0, 0])]),
            (
                line([0, 0, 0], [1, 1, 0]),
                vec![segment([0, 0, 0], [2, 2, 0]), segment([4, 4, 0], [6, 6, 0])],
            ),
            (
                line([0, 4, 0], [1, 0, 0]),
                vec![segment([0, 4, 0], [6, 4, 0])],
            ),
        ];
        self.meet_the_holed_face(&rows);
        assert!(intersection(&self.holed(), &self.holed()).is_err());
        assert!(intersection(&self.holed(), &point([0, 0, 0])).is_err());
    }

    fn intersects_segments_and_planes_with_faces(&self) {
        let segment = |from: Three, to: Three| self.segment(from, to);
        let point = |at: Three| self.point(at);
        let rows = [
            // Segments: through it, ending on it, before it, in its plane.
            (segment([1, 1, 1], [1, 1, -3]), vec![point([1, 1, 0])]),
            (segment([1, 1, 0], [1, 1, 3]), vec![point([1, 1, 0])]),
            (segment([1, 1, 1], [1, 1, 3]), vec![]),
            (segment([3, 3, 1], [3, 3, -3]), vec![]),
            (
                segment([1, 3, 0], [5, 3, 0]),
                vec![segment([1, 3, 0], [2, 3, 0]), segment([4, 3, 0], [5, 3, 0])],
            ),
            (
                segment([5, 3, 0], [3, 3, 0]),
                vec![segment([5, 3, 0], [4, 3, 0])],
            ),
            (segment([3, 3, 0], [4, 3, 0]), vec![point([4, 3, 0])]),
            (
                segment([1, 1, 0], [2, 1, 0]),
                vec![segment([1, 1, 0], [2, 1, 0])],
            ),
            // Planes: across the hole, along its border, at the border, parallel, the same.
            (
                self.plane([0, 3, 0], [0, 1, 0]),
                vec![segment([0, 3, 0], [2, 3, 0]), segment([4, 3, 0], [6, 3, 0])],
            ),
            (
                self.plane([0, 6, 0], [0, 1, 1]),
                vec![segment([0, 6, 0], [6, 6, 0])],
            ),
            (self.plane([0, 7, 0], [0, 1, 0]), vec![]),
            (self.plane([0, 0, 1], [0, 0, 1]), vec![]),
            (self.plane([7, 7, 0], [0, 0, -1]), vec![self.holed()]),
        ];
        self.meet_the_holed_face(&rows);
    }

    fn intersects_jagged_faces(&self) {
        let at = |height: i32| {
            let line = self.line([9, height, 0], [1, 0, 0]);
            intersection(&line, &self.jagged()).expect("valid by construction")
        };
        let tips = [self.point([1, 4, 0]), self.point([5, 4, 0])];
        self.are_found(&at(4), &tips, "the tips");
        let foot = [self.segment([0, 0, 0], [6, 0, 0])];
        self.are_found(&at(0), &foot, "the foot");
        self.are_found(&at(5), &[], "above");
        // Over the bottom of the notch, from 1/2 to 11/2.
        assert_eq!(at(2).value.parts().len(), 1);
        // The teeth at y = 3: from 3/4 to 2, from 4 to 21/4.
        let mut ends = Vec::new();
        for part in at(3).value.entities() {
            let Entity::Segment(s) = &part else {
                panic!("{part:?}");
            };
            ends.extend([s.from().0[0].double(), s.to().0[0].double()]);
        }
        assert_eq!(ends, [0.75, 2.0, 4.0, 5.25]);
    }

    fn projects_on_faces(&self) {
        let segment = |from: Three, to: Three| self.segment(from, to);
        let slant = || Some(self.towards([1, 0, -1]));
        let rows = [
            (self.point([1, 1, 7]), None, vec![self.point([1, 1, 0])]),
            (self.point([3, 3, 7]), None, vec![]),
            (self.point([3, 3, 2]), slant(), vec![self.point([5, 3, 0])]),
            (self.point([8, 3, 2]), None, vec![]),
            (
                self.line([0, 3, 5], [1, 0, 1]),
                None,
                vec![segment([0, 3, 0], [2, 3, 0]), segment([4, 3, 0], [6, 3, 0])],
            ),
            (
                self.line([1, 1, 5], [0, 0, 1]),
                None,
                vec![self.point([1, 1, 0])],
            ),
            (self.line([3, 3, 5], [0, 0, 1]), None, vec![]),
            (self.line([7, 0, 5], [0, 1, 0]), None, vec![]),
            (
                segment([1, 3, 4], [5, 3, 8]),
                None,
                vec![segment([1, 3, 0], [2, 3, 0]), segment([4, 3, 0], [5, 3, 0])],
            ),
            (segment([7, 3, 4], [9, 3, 8]), None, vec![]),
            (
                segment([1, 1, 4], [1, 1, 8]),
                None,
                vec![self.point([1, 1, 0])],
            ),
            (
                segment([-1, 3, 2], [1, 3, 2]),
                slant(),
                vec![segment([1, 3, 0], [2, 3, 0])],
            ),
        ];
        for (row, (a, light, expected)) in rows.iter().enumerate() {
            let outcome = projection(a, &self.holed(), light.as_ref());
            let outcome = outcome.expect("valid by construction");
            self.are_found(&outcome, expected, &format!("row {row}"));
        }
        let plane = self.plane([0, 0, 0], [1, 0, 0]);
        assert!(projection(&plane, &self.holed(), None).is_err());
    }

    fn measures_to_faces(&self) {
        let face = self.holed();
        let raised = self.face(&[&[[1, 1, 3], [5, 1, 3], [5, 5, 3]]]);
        let rows = [
            (self.point([1, 1, -4]), 4.0),
            (self.point([1, 1, 0]), 0.0),
            (self.point([3, 3, 0]), 1.0),
            (self.point([3, 3, 7]), 50f64.sqrt()),
            (self.point([9, 3, 4]), 5.0),
            (self.point([9, 10, 0]), 5.0),
            (self.line([1, 1, 9], [0, 0, 1]), 0.0),
            (self.line([3, 3, 9], [0, 0, 1]), 1.0),
            (self.line([9, 0, 4], [0, 1, 0]), 5.0),
            (self.line([1, 1, 4], [1, 1, 0]), 4.0),
            (self.segment([1, 1, 2], [1, 1, 9]), 2.0),
            (self.segment([1, 1, -2], [1, 1, 9]), 0.0),
            (self.segment([3, 3, -2], [3, 3, 9]), 1.0),
            (self.segment([9, 0, 4], [9, 9, 4]), 5.0),
            (self.plane([0, 0, 2], [0, 0, 5]), 2.0),
            (self.plane([0, 0, 2], [0, 1, 0]), 0.0),
            (self.plane([9, 0, 2], [1, 0, 0]), 3.0),
            (self.plane([6, 0, 2], [1, 0, 0]), 0.0),
            (raised, 3.0),
            (self.face(&[&[[9, 0, 4], [9, 6, 4], [12, 0, 4]]]), 5.0),
            (self.face(&[&[[1, 1, -1], [1, 5, -1], [1, 1, 1]]]), 0.0),
        ];
        for (row, (a, expected)) in rows.iter().enumerate() {
            for outcome in [distance(a, &face), distance(&face, a)] {
                let outcome = outcome.expect("valid by construction");
                self.is_near(&outcome.value, *expected, &format!("row {row}"));
                if self.exact {
                    assert_eq!(outcome.certainty, Certainty::Proven, "row {row}");
                }
            }
        }
        let bar = self.segment([0, 0, 0], [4, 0, 0]);
        let rows = [
            (self.segment([2, -1, 3], [2, 1, 3]), 3.0),
            (self.segment([7, 4, 0], [7, 9, 0]), 5.0),
            (self.segment([1, 3, 0], [9, 3, 0]), 3.0),
            (self.segment([2, 0, 0], [2, 1, 3]), 0.0),
            (self.line([7, 4, 0], [0, 0, 1]), 5.0),
            (self.line([2, 3, 0], [0, 0, 1]), 3.0),
            (self.plane([0, 0, 2], [0, 0, 1]), 2.0),
            (self.plane([2, 0, 0], [1, 0, 0]), 0.0),
        ];
        for (row, (a, expected)) in rows.iter().enumerate() {
            for outcome in [distance(a, &bar), distance(&bar, a)] {
                let found = outcome.expect("valid by construction").value;
                self.is_near(&found, *expected, &format!("segment row {row}"));
            }
        }
        assert!(distance(&face, &self.direction([1, 0, 0])).is_err());
    }

    fn classifies_faces(&self) {
        let face = self.flat(&[&OUTER, &HOLE]);
        for (at, expected) in [
            ([1, 1, 0], Place::Inside),
            ([3, 3, 0], Place::Outside),
            ([2, 2, 0], Place::OnBorder),
            ([3, 2, 0], Place::OnBorder),
            ([0, 2, 0], Place::OnBorder),
            ([1, 2, 0], Place::Inside),
            ([1, 2, 1], Place::Outside),
            ([-1, 2, 0], Place::Outside),
        ] {
            let found = classify_in_face(&self.at(at), &face);
            assert_eq!(found.certainty, Certainty::Proven, "{at:?}");
            assert_eq!(found.value, expected, "{at:?}");
        }
        let rows = [
            (self.line([1, 1, 1], [0, 0, 1]), FacePlace::Piercing),
            (self.line([0, 1, 1], [0, 0, 1]), FacePlace::Touching),
            (self.line([3, 3, 1], [0, 0, 1]), FacePlace::Apart),
            (self.line([0, 3, 0], [1, 0, 0]), FacePlace::Within),
            (self.line([0, 6, 0], [1, 0, 0]), FacePlace::Touching),
            (self.line([0, 7, 0], [1, 0, 0]), FacePlace::Apart),
            (self.segment([1, 1, 1], [1, 1, -1]), FacePlace::Piercing),
            (self.segment([1, 1, 1], [1, 1, 0]), FacePlace::Touching),
            (self.segment([1, 1, 0], [1, 2, 0]), FacePlace::Within),
            (self.segment([1, 1, 1], [1, 1, 2]), FacePlace::Apart),
        ];
        for (row, (a, expected)) in rows.iter().enumerate() {
            let found = classify_by_face(a, &self.holed()).expect("valid by construction");
            assert_eq!(found.value, *expected, "row {row}");
        }
        assert!(classify_by_face(&self.point([0, 0, 0]), &self.holed()).is_err());
        for (plane, expected) in [
            (self.plane([0, 0, -1], [0, 0, 1]), Side::Above),
            (self.plane([0, 0, 0], [0, 0, 1]), Side::In),
            (self.plane([0, 0, 1], [0, 0, 1]), Side::Below),
            (self.plane([3, 0, 0], [1, 0, 0]), Side::Crossing),
            (self.plane([6, 0, 0], [1, 0, 0]), Side::Touching),
        ] {
            let found = classify(&self.holed(), &plane).expect("valid by construction");
            assert_eq!(found.value, expected, "{plane:?}");
        }
    }
}

#[test]
fn measured_faces_and_solids_are_told_within_their_digits() {
    let m = |x: f64| Measured::new(x, 1e-3).expect("valid by construction");
    let at = |x: f64, y: f64, z: f64| Point([m(x), m(y), m(z)]);
    let ring = vec![
        at(0.0, 0.0, 0.0),
        at(6.0, 0.0, 0.0),
        at(6.0, 6.0, 0.0),
        at(0.0, 6.0, 0.0),
    ];
    let face = Face::new(vec![ring]).expect("valid by construction");
    // Four measured corners may be in one plane, and never certainly are.
    assert_eq!(face.certainty(), Certainty::WithinDigits);
    let face: Entity<Measured> = face.into();
    let ask = |point: Point<Measured>| contained(&point.into(), &face);
    assert_eq!(ask(at(3.0, 3.0, 0.0)), Ok(Answer::WithinDigits));
    assert_eq!(ask(at(3.0, 3.0, 0.1)), Ok(Answer::No));
    assert_eq!(ask(at(7.0, 3.0, 0.0)), Ok(Answer::No));
    assert_eq!(ask(at(6.0005, 3.0, 0.0)), Ok(Answer::WithinDigits));
    // A line through the inside certainly pierces it; one past it certainly does not; at the border either may be.
    let upright = |x: f64| -> Entity<Measured> {
        Line::new(at(x, 3.0, 5.0), TOLERANT.towards([0, 0, 1])).into()
    };
    for (x, place, certainty) in [
        (3.0, FacePlace::Piercing, Certainty::Proven),
        (7.0, FacePlace::Apart, Certainty::Proven),
        (6.0, FacePlace::Touching, Certainty::WithinDigits),
    ] {
        let found = classify_by_face(&upright(x), &face).expect("valid by construction");
        assert_eq!((found.value, found.certainty), (place, certainty), "{x}");
    }
    let mut builder = BoundaryBuilder::new();
    for [x, y, z] in box_corners([0, 0, 0], [6, 6, 6]) {
        builder.vertex(at(f64::from(x), f64::from(y), f64::from(z)));
    }
    for corners in BOX {
        builder.face(vec![corners.to_vec()]);
    }
    let solid = builder.build_solid().expect("valid by construction");
    for (point, place, certainty) in [
        (at(3.0, 3.0, 3.0), Place::Inside, Certainty::Proven),
        (at(3.0, 3.0, 7.0), Place::Outside, Certainty::Proven),
        // In the planes of faces within its digits, away from the faces.
        (at(9.0, 6.0, 6.0), Place::Outside, Certainty::Proven),
        (at(3.0, 3.0, 6.0), Place::OnBorder, Certainty::WithinDigits),
    ] {
        let found = classify_in_solid(&point, &solid).expect("valid by construction");
        assert_eq!(found.value, place, "{point:?}");
        assert_eq!(found.certainty, certainty, "{point:?}");
    }
}

in_both_forms!(
    asks_about_faces,
    asks_directions_of_faces,
    intersects_faces,
    intersects_segments_and_planes_with_faces,
    intersects_jagged_faces,
    projects_on_faces,
    measures_to_faces,
    classifies_faces,
);
