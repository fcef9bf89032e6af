//! Intersections, shadows and perpendiculars with each pair of arguments.

use super::{EXACT, TOLERANT, With};
use crate::{Scalar, intersection, join_perpend, perpend, projection};

impl<S: Scalar> With<S> {
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
            self.is_found(
                &intersection(a, b).expect("valid by construction"),
                expected.clone(),
                &what,
            );
            self.is_found(
                &intersection(b, a).expect("valid by construction"),
                expected.clone(),
                &what,
            );
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
            let outcome = projection(a, b, light.as_ref()).expect("valid by construction");
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
            let feet = join_perpend(&a, &b).expect("valid by construction").value;
            self.are_points(&[feet.first, feet.second], &[first, second]);
            assert_eq!(feet.one_of_many, one_of_many);
        }
        let back = join_perpend(&floor(), &self.point([3, 4, 5]))
            .expect("valid by construction")
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
            self.is_found(
                &perpend(a, b).expect("valid by construction"),
                expected.clone(),
                &what,
            );
        }
        assert!(perpend(&floor(), &floor()).is_err());
    }
}

in_both_forms!(intersects, projects, joins, finds_perpendiculars,);
