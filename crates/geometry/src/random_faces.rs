//! Random jagged faces and solids over a grid of integers, whose points are known by counting columns.

use crate::random_tests::{Whole, dependent, exact, not_zero, shaken, tolerant, triple};
use crate::{
    BoundaryBuilder, Certainty, Entity, Face, Found, Line, Place, Point, Scalar, classify_in_face,
    classify_in_solid, intersection,
};
use kutzbach_math::matrix::SplitMix64;
use kutzbach_math::number::Number;

const CASES: usize = 2_000;

/// Columns of width 2 side by side, of even heights, on a plane that two vectors span; a solid of height 4 on it.
struct Skyline {
    heights: Vec<i128>,
    origin: Whole,
    u: Whole,
    v: Whole,
    w: Whole,
}

impl Skyline {
    fn new(random: &mut SplitMix64) -> Self {
        let count = 1 + random.next_u64() % 5;
        let heights = (0..count).map(|_| 2 + 2 * i128::from(random.next_u64() % 3));
        let heights = heights.collect();
        loop {
            let (u, v) = (not_zero(random), not_zero(random));
            if dependent(u, v) {
                continue;
            }
            // Across both, so that the solid is on the upper side.
            let part = |i: usize, j: usize| u[i] * v[j] - u[j] * v[i];
            return Self {
                heights,
                origin: triple(random),
                u,
                v,
                w: [part(1, 2), part(2, 0), part(0, 1)],
            };
        }
    }

    /// The point of coordinates on the grid.
    fn at(&self, [x, y, z]: Whole) -> Whole {
        [0, 1, 2].map(|i| self.origin[i] + x * self.u[i] + y * self.v[i] + z * self.w[i])
    }

    /// The border, counterclockwise; straight corners stay, doubles do not.
    fn corners(&self) -> Vec<[i128; 2]> {
        let width = 2 * self.heights.len() as i128;
        let mut corners = vec![[0, 0], [width, 0]];
        for (column, height) in self.heights.iter().enumerate().rev() {
            let left = 2 * column as i128;
            for corner in [[left + 2, *height], [left, *height]] {
                if corners.last() != Some(&corner) {
                    corners.push(corner);
                }
            }
        }
        corners
    }

    /// Where a point of the grid's plane is: by the columns that it is in, and in the inside of.
    fn place(&self, x: i128, y: i128) -> Place {
        let near = |position: i128| {
            let column = usize::try_from(position.div_euclid(2)).ok()?;
            self.heights.get(column).copied()
        };
        // A column to each side of the point; the same one where the point is between borders.
        let sides = match x.rem_euclid(2) == 0 {
            true => [near(x - 1), near(x)],
            false => [near(x), near(x)],
        };
        let closed = |height: Option<i128>| height.is_some_and(|h| (0..=h).contains(&y));
        let open = |height: Option<i128>| height.is_some_and(|h| 0 < y && y < h);
        match (sides.into_iter().any(closed), sides.into_iter().all(open)) {
            (_, true) => Place::Inside,
            (true, false) => Place::OnBorder,
            (false, false) => Place::Outside,
        }
    }

    fn face<S: Scalar>(&self, mut numbers: impl FnMut(Whole) -> [S; 3]) -> Option<Face<S>> {
        let corners = self.corners();
        let ring = corners
            .iter()
            .map(|[x, y]| Point(numbers(self.at([*x, *y, 0]))))
            .collect();
        Face::new(vec![ring]).ok()
    }

    fn builder<S: Scalar>(&self, mut numbers: impl FnMut(Whole) -> [S; 3]) -> BoundaryBuilder<S> {
        let corners = self.corners();
        let count = corners.len();
        let mut builder = BoundaryBuilder::new();
        for z in [0, 4] {
            for [x, y] in &corners {
                builder.vertex(Point(numbers(self.at([*x, *y, z]))));
            }
        }
        builder.face(vec![(0..count).rev().collect()]);
        builder.face(vec![(count..2 * count).collect()]);
        for i in 0..count {
            let j = (i + 1) % count;
            builder.face(vec![vec![i, j, j + count, i + count]]);
        }
        builder
    }

    /// A point on the grid in and about the columns.
    fn somewhere(&self, random: &mut SplitMix64) -> [i128; 2] {
        let width = 2 * self.heights.len() as u64;
        let x = i128::from(random.next_u64() % (width + 3)) - 1;
        [x, i128::from(random.next_u64() % 9) - 1]
    }
}

#[test]
fn no_place_beside_a_face_is_wrong() {
    let mut random = SplitMix64::new(561);
    let mut seen = [0_usize; 3];
    for _ in 0..CASES {
        let sky = Skyline::new(&mut random);
        let by_fractions = sky.face(exact).expect("valid by construction");
        let by_doubles = sky.face(tolerant).expect("valid by construction");
        let by_digits = sky.face(|v| shaken(v, &mut random));
        for _ in 0..5 {
            let [x, y] = sky.somewhere(&mut random);
            let z = i128::from(random.next_u64().is_multiple_of(8));
            let expected = match z {
                0 => sky.place(x, y),
                _ => Place::Outside,
            };
            let at = sky.at([x, y, z]);
            let found = classify_in_face(&Point(exact(at)), &by_fractions);
            let heights = &sky.heights;
            assert_eq!(
                found.certainty,
                Certainty::Proven,
                "{heights:?} {x} {y} {z}"
            );
            assert_eq!(found.value, expected, "{heights:?} {x} {y} {z}");
            let found = classify_in_face(&Point(tolerant(at)), &by_doubles);
            assert_eq!(
                found.certainty,
                Certainty::Proven,
                "{heights:?} {x} {y} {z}"
            );
            assert_eq!(found.value, expected, "{heights:?} {x} {y} {z}");
            if let Some(face) = &by_digits {
                let found = classify_in_face(&Point(shaken(at, &mut random)), face);
                let wrong = found.certainty == Certainty::Proven && found.value != expected;
                assert!(!wrong, "{heights:?} {x} {y} {z}");
            }
            seen[expected as usize] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > CASES / 2), "{seen:?}");
}

#[test]
fn lines_cut_faces_where_columns_are_high_enough() {
    let mut random = SplitMix64::new(562);
    let mut several = 0;
    for _ in 0..CASES {
        let sky = Skyline::new(&mut random);
        let y = i128::from(random.next_u64() % 8);
        let face: Entity<Number> = sky.face(exact).expect("valid by construction").into();
        let (from, to) = (sky.at([-3, y, 0]), sky.at([-2, y, 0]));
        let line = Line::through(Point(exact(from)), &Point(exact(to)));
        let line: Entity<Number> = line.expect("valid by construction").into();
        let found = intersection(&line, &face).expect("valid by construction");
        assert_eq!(found.certainty, Certainty::Proven);
        // Runs of columns that reach up to the line.
        let mut expected: Vec<[i128; 2]> = Vec::new();
        for (column, height) in sky.heights.iter().enumerate() {
            let left = 2 * column as i128;
            if *height < y {
                continue;
            }
            match expected.last_mut() {
                Some(run) if run[1] == left => run[1] = left + 2,
                _ => expected.push([left, left + 2]),
            }
        }
        several += usize::from(expected.len() > 1);
        assert_eq!(
            found.value.parts().len(),
            expected.len(),
            "{:?} {y}",
            sky.heights
        );
        for (part, [left, right]) in found.value.parts().iter().zip(expected) {
            let Found::Segment(part) = part else {
                panic!("{part:?}");
            };
            assert_eq!(part.from().0, exact(sky.at([left, y, 0])));
            assert_eq!(part.to().0, exact(sky.at([right, y, 0])));
        }
    }
    assert!(several > CASES / 20, "{several}");
}

#[test]
fn no_place_beside_a_solid_is_wrong() {
    let mut random = SplitMix64::new(563);
    let mut seen = [0_usize; 3];
    for _ in 0..CASES / 4 {
        let sky = Skyline::new(&mut random);
        let solid = sky.builder(exact).build_solid();
        let solid = solid.expect("valid by construction");
        let by_doubles = sky.builder(tolerant).build_solid();
        let by_doubles = by_doubles.expect("valid by construction");
        for _ in 0..3 {
            let [x, y] = sky.somewhere(&mut random);
            let z = i128::from(random.next_u64() % 7) - 1;
            let expected = match (sky.place(x, y), z) {
                (_, ..=-1 | 5..) | (Place::Outside, _) => Place::Outside,
                (Place::Inside, 1..=3) => Place::Inside,
                _ => Place::OnBorder,
            };
            let at = sky.at([x, y, z]);
            let heights = &sky.heights;
            let found = classify_in_solid(&Point(exact(at)), &solid);
            let found = found.expect("valid by construction");
            assert_eq!(
                found.certainty,
                Certainty::Proven,
                "{heights:?} {x} {y} {z}"
            );
            assert_eq!(found.value, expected, "{heights:?} {x} {y} {z}");
            let found = classify_in_solid(&Point(tolerant(at)), &by_doubles);
            let found = found.expect("valid by construction");
            assert_eq!(found.value, expected, "{heights:?} {x} {y} {z}");
            seen[expected as usize] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > 50), "{seen:?}");
}
