//! Every entity elsewhere, and what a motion is not.

use super::{EXACT, TOLERANT, Three, With};
use crate::{
    Answer, Certainty, Line, Measured, Scalar, Transformation, Vector, coincide, distance,
};
use kutzbach_math::number::Number;

impl<S: Scalar> With<S> {
    fn quarter(&self, at: Three, along: Three) -> Transformation<S> {
        let axis = Line::new(self.at(at), self.towards(along));
        Transformation::about(&axis, &S::whole(0), &S::whole(1)).expect("valid by construction")
    }

    fn moves_entities(&self) {
        // A quarter of a turn about the upright line through (1, 0): (x, y) goes to (1 - y, x - 1).
        let quarter = self.quarter([1, 0, 5], [0, 0, 2]);
        let ring = [[1, 0, 0], [3, 0, 0], [3, 2, 0]];
        let turned = [[1, 0, 0], [1, 2, 0], [-1, 2, 0]];
        let rows = [
            (self.vector([1, 2, 3]), self.vector([-2, 1, 3])),
            (self.direction([1, 2, 3]), self.direction([-2, 1, 3])),
            (self.point([3, 2, 7]), self.point([-1, 2, 7])),
            (
                self.line([3, 2, 7], [1, 0, 0]),
                self.line([-1, 2, 7], [0, 1, 0]),
            ),
            (
                self.plane([3, 2, 7], [1, 0, 0]),
                self.plane([-1, 2, 7], [0, 1, 0]),
            ),
            (
                self.segment([1, 0, 0], [3, 2, 7]),
                self.segment([1, 0, 0], [-1, 2, 7]),
            ),
            (self.face(&[&ring]), self.face(&[&turned])),
        ];
        for (a, expected) in &rows {
            let found = quarter.entity(a).expect("valid by construction");
            assert_eq!(coincide(&found, expected), Ok(Answer::Yes), "{a:?}");
            let back = quarter.inverse().entity(&found);
            let back = back.expect("valid by construction");
            assert_eq!(coincide(&back, a), Ok(Answer::Yes), "{a:?}");
            // Four quarters are nothing.
            let half = quarter.then(&quarter);
            let whole = half.then(&half).entity(a).expect("valid by construction");
            assert_eq!(coincide(&whole, a), Ok(Answer::Yes), "{a:?}");
            let still = Transformation::identity().entity(a);
            let still = still.expect("valid by construction");
            assert_eq!(coincide(&still, a), Ok(Answer::Yes), "{a:?}");
        }
        let tetrahedron = self.solid(
            &[[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]],
            &[&[&[0, 2, 1]], &[&[0, 1, 3]], &[&[1, 2, 3]], &[&[2, 0, 3]]],
        );
        let shift = Transformation::translation(&Vector(self.three([1, 2, 3])));
        let moved = shift.boundary(&tetrahedron).expect("valid by construction");
        self.are_points(
            moved.vertices(),
            &[[1, 2, 3], [3, 2, 3], [1, 4, 3], [1, 2, 5]],
        );
        assert_eq!(moved.edges(), tetrahedron.edges());
        assert!(moved.is_solid());
        // First one, then the other: the order tells.
        let first = quarter.then(&shift).point(&self.at([1, 0, 0]));
        self.are_points(&[first], &[[2, 2, 3]]);
        let second = shift.then(&quarter).point(&self.at([1, 0, 0]));
        self.are_points(&[second], &[[-1, 1, 3]]);
    }

    fn refuses_what_is_no_motion(&self) {
        let nowhere = || Vector(self.three([0, 0, 0]));
        let rows = |rows: [Three; 3]| rows.map(|row| self.three(row));
        let turn = Transformation::new(rows([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), nowhere());
        let turn = turn.expect("valid by construction");
        assert_eq!(turn.certainty(), Certainty::Proven);
        self.are_points(&[turn.point(&self.at([1, 2, 3]))], &[[-2, 1, 3]]);
        for bad in [
            [[1, 0, 0], [0, 1, 0], [0, 0, -1]],
            [[2, 0, 0], [0, 1, 0], [0, 0, 1]],
            [[1, 0, 0], [1, 0, 0], [0, 0, 1]],
        ] {
            assert!(
                Transformation::new(rows(bad), nowhere()).is_err(),
                "{bad:?}"
            );
        }
        let axis = Line::new(self.at([0, 0, 0]), self.towards([1, 0, 0]));
        assert!(Transformation::about(&axis, &S::whole(1), &S::whole(1)).is_err());
    }
}

#[test]
fn rotations_by_roots_and_fractions_are_exact() {
    let ratio = |a, b| Number::ratio(a, b).expect("valid by construction");
    // A third of a turn about the diagonal goes round the axes.
    let diagonal = Line::new(EXACT.at([0, 0, 0]), EXACT.towards([1, 1, 1]));
    let (cosine, sine) = Number::integer(120).radians().cos_sin();
    let third = Transformation::about(&diagonal, &cosine, &sine).expect("valid by construction");
    let found = third.point(&EXACT.at([1, 2, 3]));
    let same = coincide(&found.into(), &EXACT.point([3, 1, 2]));
    assert_eq!(same, Ok(Answer::Yes));
    // The angle of the triangle of 3, 4 and 5 moves whole numbers to fractions, and keeps distances.
    let upright = Line::new(EXACT.at([0, 0, 0]), EXACT.towards([0, 0, 7]));
    let turn = Transformation::about(&upright, &ratio(3, 5), &ratio(4, 5));
    let turn = turn.expect("valid by construction");
    let moved = |at| {
        turn.entity(&EXACT.point(at))
            .expect("valid by construction")
    };
    let (a, b) = (moved([5, 0, 0]), moved([0, 5, 1]));
    assert_eq!(coincide(&a, &EXACT.point([3, 4, 0])), Ok(Answer::Yes));
    let far = distance(&a, &b).expect("valid by construction");
    assert!((far.value.value() - 51f64.sqrt()).abs() < 1e-12);
    assert_eq!(turn.certainty(), Certainty::Proven);
}

#[test]
fn measured_rotations_are_rotations_within_their_digits() {
    let m = |x: f64| Measured::new(x, 1e-6).expect("valid by construction");
    let axis = Line::new(TOLERANT.at([0, 0, 0]), TOLERANT.towards([0, 0, 1]));
    let turn = Transformation::about(&axis, &m(0.8), &m(0.6)).expect("valid by construction");
    assert_eq!(turn.certainty(), Certainty::WithinDigits);
    let found = turn.point(&TOLERANT.at([5, 0, 0]));
    let same = coincide(&found.into(), &TOLERANT.point([4, 3, 0]));
    assert_eq!(same, Ok(Answer::WithinDigits));
    assert!(Transformation::about(&axis, &m(0.8), &m(0.601)).is_err());
}

in_both_forms!(moves_entities, refuses_what_is_no_motion);
