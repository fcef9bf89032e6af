//! Logical functions with each pair of arguments.

use super::{EXACT, TOLERANT, Three, With};
use crate::{
    Answer, Direction, Entity, Line, Plane, Scalar, Segment, coincide, colinear, contained,
    coplanar, parallel, perpendicular,
};

impl<S: Scalar> With<S> {
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

    fn refuses_what_is_degenerate(&self) {
        let at = |x| self.at([x, 0, 0]);
        assert!(Direction::new(self.three([0, 0, 0])).is_err());
        assert!(Line::through(at(1), &at(1)).is_err());
        assert!(Line::through(at(1), &at(2)).is_ok());
        assert!(Segment::new(at(1), at(1)).is_err());
        assert!(Plane::through(at(1), &at(2), &at(3)).is_err());
        let said = Line::through(at(1), &at(1))
            .expect_err("refused")
            .to_string();
        assert!(said.contains("two different points"), "{said}");
    }
}

in_both_forms!(
    asks_coincide,
    asks_colinear_and_coplanar,
    asks_contained,
    asks_parallel_and_perpendicular,
    refuses_what_is_degenerate,
);
