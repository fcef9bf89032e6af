//! Random rotations of integer quaternions, beside integers over their squares.

use crate::random_tests::{Whole, component, exact, not_zero, product, triple};
use crate::{
    Answer, Certainty, Direction, Entity, GeometryError, Line, Plane, Point, Transformation,
    Vector, coplanar, parallel, perpendicular,
};
use kutzbach_math::matrix::SplitMix64;
use kutzbach_math::number::Number;

const CASES: usize = 1_000;

type Ask = fn(&Entity<Number>, &Entity<Number>) -> Result<Answer, GeometryError>;

/// The rotation of a quaternion that is not zero: rows of integers over the square of its length.
fn rotation(random: &mut SplitMix64) -> ([Whole; 3], i128) {
    loop {
        let w = component(random);
        let [x, y, z] = triple(random);
        let square = w * w + x * x + y * y + z * z;
        if square == 0 {
            continue;
        }
        let rows = [
            [
                w * w + x * x - y * y - z * z,
                2 * (x * y - w * z),
                2 * (x * z + w * y),
            ],
            [
                2 * (x * y + w * z),
                w * w - x * x + y * y - z * z,
                2 * (y * z - w * x),
            ],
            [
                2 * (x * z - w * y),
                2 * (y * z + w * x),
                w * w - x * x - y * y + z * z,
            ],
        ];
        return (rows, square);
    }
}

fn ratio(numerator: i128, denominator: i128) -> Number {
    Number::ratio(numerator as i64, denominator as i64).expect("valid by construction")
}

#[test]
fn points_are_moved_to_the_fractions_of_a_quaternion() {
    let mut random = SplitMix64::new(564);
    for _ in 0..CASES {
        let (rows, square) = rotation(&mut random);
        let shift = triple(&mut random);
        let motion = Transformation::new(
            rows.map(|row| row.map(|x| ratio(x, square))),
            Vector(exact(shift)),
        );
        let motion = motion.expect("valid by construction");
        assert_eq!(motion.certainty(), Certainty::Proven);
        let at = triple(&mut random);
        let found = motion.point(&Point(exact(at)));
        for (i, row) in rows.iter().enumerate() {
            let expected = ratio(product(*row, at) + shift[i] * square, square);
            assert_eq!(found.0[i], expected, "{rows:?} {at:?}");
        }
        let back = motion.inverse().point(&found);
        assert_eq!(back.0, exact(at), "{rows:?} {at:?}");
    }
}

#[test]
fn answers_stay_what_they_are_after_a_motion() {
    let mut random = SplitMix64::new(565);
    let mut held = 0;
    for _ in 0..CASES {
        let (rows, square) = rotation(&mut random);
        let motion = Transformation::new(
            rows.map(|row| row.map(|x| ratio(x, square))),
            Vector(exact(triple(&mut random))),
        );
        let motion = motion.expect("valid by construction");
        let (p, q) = (exact(triple(&mut random)), exact(triple(&mut random)));
        let (u, v) = (direction(&mut random), direction(&mut random));
        let a: Entity<Number> = Line::new(Point(p), u).into();
        let line: Entity<Number> = Line::new(Point(q.clone()), v.clone()).into();
        let plane: Entity<Number> = Plane::new(Point(q), v).into();
        for b in [line, plane] {
            let moved_a = motion.entity(&a).expect("valid by construction");
            let moved_b = motion.entity(&b).expect("valid by construction");
            let asks: [Ask; 3] = [parallel, perpendicular, coplanar];
            for ask in asks {
                let before = ask(&a, &b).expect("valid by construction");
                let after = ask(&moved_a, &moved_b).expect("valid by construction");
                assert_eq!(before, after, "{a:?} {b:?} {rows:?}");
                held += usize::from(before.is_yes());
            }
        }
    }
    assert!(held > CASES / 4, "{held}");
}

fn direction(random: &mut SplitMix64) -> Direction<Number> {
    let v = exact(not_zero(random));
    Direction::new(v).expect("valid by construction")
}
