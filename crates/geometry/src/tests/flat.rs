//! Sides, orders, hulls and normals.

use super::{EXACT, TOLERANT, With};
use crate::{
    Answer, Certainty, Place, Scalar, Side, calculate_normal, classify, classify_in_polygon,
    coincide, planar_hull, sort_angular,
};

impl<S: Scalar> With<S> {
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
            let found = classify(&a, &floor).expect("valid by construction");
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
                assert_eq!(
                    found.expect("valid by construction").value,
                    expected,
                    "{at:?}"
                );
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
        let normal = calculate_normal(&hull.value)
            .expect("valid by construction")
            .value
            .expect("valid by construction");
        let same = coincide(&normal.into(), &self.direction([0, 0, 1]));
        assert_eq!(same, Ok(Answer::Yes));
        let hull = planar_hull(&square, &down).value;
        let normal = calculate_normal(&hull)
            .expect("valid by construction")
            .value
            .expect("valid by construction");
        let same = coincide(&normal.into(), &self.direction([0, 0, -1]));
        assert_eq!(same, Ok(Answer::Yes));

        let on_a_line = [[1, 1, 0], [3, 3, 0], [2, 2, 0], [3, 3, 0]].map(|c| self.at(c));
        let ends = planar_hull(&on_a_line, &up).value;
        assert_eq!(ends.len(), 2);
        assert_eq!(planar_hull(&on_a_line[..1], &up).value.len(), 1);
        assert!(planar_hull(&[], &up).value.is_empty());
        assert!(
            calculate_normal(&on_a_line)
                .expect("valid by construction")
                .value
                .is_none()
        );
        assert!(
            calculate_normal::<S>(&[])
                .expect("valid by construction")
                .value
                .is_none()
        );
    }
}

in_both_forms!(classifies, sorts_and_hulls,);
