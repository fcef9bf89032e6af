//! How a body is turned against another one where points of both are the same.

use super::anchors::{Held, Meaning, doubts};
use super::pose::unit;
use crate::quaternion::{angles_of, of_columns};
use kutzbach_math::number::{Inputs, Number, Quantity};
use kutzbach_math::space::{cross, dot, perpendicular};

type Vector = [f64; 3];

/// The axes of a body.
const AXES: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Points that miss one another by less than this share of their distances coincide: what doubles leave.
const COINCIDE: f64 = 1e-12;

/// A distance of two points, in one body and in the other, is off by the doubts of four coordinates.
const OF_TWO_DISTANCES: f64 = 4.0;

/// Roll, pitch and yaw (rad) of the directions of the first body in the second one where the points of both, one for one, are the same; and
/// whether they are to rounding, or within their digits only. Of points on one line it is a least turn.
///
/// `found` is what the points of the first body hold. `None` where no turn takes these to those of the second one.
pub(super) fn turn_between(
    sides: [&[[Number; 3]]; 2],
    found: &Meaning,
) -> Option<([Number; 3], bool)> {
    let ways = sides.map(from_the_first);
    let doubts = sides.iter().flat_map(|side| doubts(side));
    let doubt = doubts.flatten().fold(0.0, f64::max);
    let [a, b] = &ways;
    let (length, [from, to]) = match found.held {
        Held::Point => (0.0, [AXES; 2]),
        _ => {
            let along = [*a.get(found.farthest)?, *b.get(found.farthest)?];
            let is_line = matches!(found.held, Held::Line(_));
            (
                dot(&along[0], &along[0]).sqrt(),
                axes(&ways, along, is_line)?,
            )
        }
    };
    let turned = |way: &Vector| -> Vector {
        let parts = from.each_ref().map(|axis| dot(axis, way));
        [0, 1, 2].map(|i| (0..3).map(|k| to[k][i] * parts[k]).sum())
    };
    let miss = a.iter().zip(b).map(|(a, b)| {
        let found = turned(a);
        (0..3).map(|i| (found[i] - b[i]).abs()).fold(0.0, f64::max)
    });
    let miss = miss.fold(0.0, f64::max);
    let exactly = miss <= COINCIDE * (1.0 + length);
    if !(exactly || miss <= OF_TWO_DISTANCES * doubt) {
        return None;
    }
    let columns = AXES.map(|axis| turned(&axis));
    let angles = angles_of(of_columns(columns))?;
    // The ends of the longest way, in either body, turn it by so much when they are moved across it, and by less otherwise.
    let mut inputs = Inputs::default();
    // Points that were chosen are exact.
    for side in sides.into_iter().filter(|_| doubt > 0.0) {
        let ends = side.first().into_iter().chain(side.get(found.farthest));
        for number in ends.flatten() {
            inputs.add(Quantity::Length, number, 1.0 / length);
        }
    }
    Some((
        angles.map(|angle| angle.derived_from(inputs.clone())),
        exactly,
    ))
}

/// The ways from the first of some points to each of them.
fn from_the_first(points: &[[Number; 3]]) -> Vec<Vector> {
    let way = |point: &[Number; 3]| [0, 1, 2].map(|i| point[i].value() - points[0][i].value());
    points.iter().map(way).collect()
}

/// Three axes at right angles in each body that become the same ones, the first along the points' longest way.
fn axes(ways: &[Vec<Vector>; 2], along: [Vector; 2], is_line: bool) -> Option<[[Vector; 3]; 2]> {
    let [x, u] = [unit(along[0])?, unit(along[1])?];
    let normals = match is_line {
        true => {
            let normal = unit(cross(&x, &u)).unwrap_or_else(|| perpendicular(&x).0);
            [normal, normal]
        }
        false => {
            let [a, b] = ways;
            let beside = |k: usize| cross(&x, &a[k]);
            let size = |k: usize| dot(&beside(k), &beside(k));
            let farthest = (0..a.len()).max_by(|&k, &l| size(k).total_cmp(&size(l)))?;
            [unit(beside(farthest))?, unit(cross(&u, &b[farthest]))?]
        }
    };
    let [z, w] = normals;
    Some([[x, cross(&z, &x), z], [u, cross(&w, &u), w]])
}

#[cfg(test)]
mod tests {
    use super::super::anchors::meaning;
    use super::*;

    fn points(texts: &[&str]) -> Vec<[Number; 3]> {
        let point = |text: &&str| {
            let numbers: Vec<Number> = text
                .split(' ')
                .map(|word| Number::decimal(word).expect("a number"))
                .collect();
            numbers.try_into().expect("three numbers")
        };
        texts.iter().map(point).collect()
    }

    fn turn(one: &[&str], other: &[&str]) -> Option<([f64; 3], bool)> {
        let [one, other] = [points(one), points(other)];
        let (angles, exactly) = turn_between([&one, &other], &meaning(&one))?;
        Some((
            angles.map(|angle| (angle.value() * 1e4).round() / 1e4),
            exactly,
        ))
    }

    #[test]
    fn points_of_two_bodies_are_the_same_after_a_turn() {
        let quarter = (std::f64::consts::FRAC_PI_2 * 1e4).round() / 1e4;
        for (one, other, expected) in [
            (
                &["0 0 0", "0 0 0.1"][..],
                &["1 2 3", "1 2 3.1"][..],
                Some(([0.0; 3], true)),
            ),
            // z becomes x.
            (
                &["0 0 0", "0 0 0.1"],
                &["1 2 3", "1.1 2 3"],
                Some(([0.0, quarter, 0.0], true)),
            ),
            (&["0 0 0", "0 0 0.1"], &["0 0 0", "0 0 0.15"], None),
            (
                &["0 0 0", "0.057735 0.057735 0.057735"],
                &["0 0 0", "0.100001 0.1 0.1"],
                None,
            ),
            // Not on a line: x stays, y becomes z.
            (
                &["0 0 0", "1 0 0", "0 0.5 0"],
                &["0 0 0", "1 0 0", "0 0 0.5"],
                Some(([quarter, 0.0, 0.0], true)),
            ),
            // Mirrored: their distances are the same.
            (
                &["0 0 0", "2 0 0", "0 1 0", "0 0 0.5"],
                &["0 0 0", "2 0 0", "0 1 0", "0 0 -0.5"],
                None,
            ),
            (
                &["1 0 0", "1 0 0"],
                &["0 0 1", "0 0 1"],
                Some(([0.0; 3], true)),
            ),
            (&["1 0 0", "1 0 0"], &["0 0 1", "0 0 2"], None),
        ] {
            assert_eq!(turn(one, other), expected, "{one:?} {other:?}");
        }
        let rounded = turn(
            &["0 0 0", "0.057735 0.057735 0.057735"],
            &["0 0 0", "0 0 0.1"],
        );
        assert!(rounded.is_some_and(|(_, exactly)| !exactly));
        // The angles know the ends, a tenth of a metre apart.
        let literals = |one: &[&str], other: &[&str]| {
            let [one, other] = [points(one), points(other)];
            let found = turn_between([&one, &other], &meaning(&one));
            let [roll, ..] = found.expect("a turn").0;
            let slopes = roll.inputs().iter().map(|own| own.slope * 0.1);
            slopes.collect::<Vec<f64>>()
        };
        let slopes = literals(&["0.1234 0 0", "0.1234 0 0.1"], &["0 0 0", "0 0.1 0"]);
        assert!(
            slopes.iter().any(|slope| (slope - 2.0).abs() < 1e-12),
            "{slopes:?}"
        );
        assert!(literals(&["0 0 0", "0 0 0.1"], &["0 0 0", "0 0.1 0"]).is_empty());
    }
}
