//! Masses and shapes in MJCF.

use super::place::{Place, is_straight, rounded, text, texts};
use kutzbach_closure::Rigid;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Geometry as Solid, Inertial, Shape};

/// Below this MuJoCo takes a mass or an inertia for none.
const LEAST: f64 = 1e-15;

/// A shape has to be larger than this (m).
pub(super) const EXTENT: f64 = LEAST;

/// What a moving link weighs that the file gives no mass: MuJoCo refuses bodies without.
pub(super) const DEFAULT: &str =
    "<inertial pos=\"0 0 0\" mass=\"0.1\" diaginertia=\"0.001 0.001 0.001\"/>";

/// What a body weighs that only carries the freedoms of a joint.
pub(super) const OF_CLOSURE: &str =
    "<inertial pos=\"0 0 0\" mass=\"0.001\" diaginertia=\"1e-06 1e-06 1e-06\"/>";

type Matrix = [[f64; 3]; 3];

/// Whether some body has these masses: there is a mass, and the moments of inertia are positive, none of them above the sum of the others.
pub(super) fn is_body(inertial: &Inertial) -> bool {
    let [a, b, c, d, e, f] = inertial.inertia.each_ref().map(Number::value);
    inertial.mass.value() > LEAST && is_possible(&[[a, b, c], [b, d, e], [c, e, f]])
}

/// `<inertial>`; `None` for what no body can have: no mass, or moments of inertia that are not positive or of which one exceeds the sum
/// of the others.
pub(super) fn inertial(inertial: &Inertial, pose: &Rigid<f64>) -> Option<String> {
    let [ixx, ixy, ixz, iyy, iyz, izz] = &inertial.inertia;
    let [a, b, c, d, e, f] = inertial.inertia.each_ref().map(Number::value);
    let matrix = [[a, b, c], [b, d, e], [c, e, f]];
    if !is_body(inertial) {
        return None;
    }
    let mass = text(&inertial.mass);
    let plain = [ixy, ixz, iyz].iter().all(|x| x.is_zero());
    Some(if plain {
        let place = with_position(&Place::Stated(inertial.origin.clone()));
        let moments = [ixx, iyy, izz].map(text).join(" ");
        format!("<inertial{place} mass=\"{mass}\" diaginertia=\"{moments}\"/>")
    } else {
        // A full matrix is one along the axes of the body.
        let moments = match is_straight(pose) {
            true => [ixx, iyy, izz, ixy, ixz, iyz].map(text).join(" "),
            false => {
                let m = turned(&matrix, &pose.rotation);
                let all = [m[0][0], m[1][1], m[2][2], m[0][1], m[0][2], m[1][2]];
                texts(&all.map(rounded))
            }
        };
        let position = texts(&inertial.origin.position);
        format!("<inertial pos=\"{position}\" mass=\"{mass}\" fullinertia=\"{moments}\"/>")
    })
}

/// `pos` is asked for, even where it is zero.
fn with_position(place: &Place) -> String {
    let words = place.attributes();
    match words.contains(" pos=") {
        true => words,
        false => format!(" pos=\"0 0 0\"{words}"),
    }
}

/// R M Rᵀ.
fn turned(m: &Matrix, r: &Matrix) -> Matrix {
    let entry = |i: usize, j: usize| {
        let mut sum = 0.0;
        for k in 0..3 {
            for l in 0..3 {
                sum += r[i][k] * m[k][l] * r[j][l];
            }
        }
        sum
    };
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

/// Whether some body has these moments of inertia: they are positive, and so is the matrix of second moments, `tr(M)/2 − M`, or it is
/// singular as that of a plate. The slack is a thousand roundings.
fn is_possible(m: &Matrix) -> bool {
    let trace = m[0][0] + m[1][1] + m[2][2];
    let slack = 1e-12 * trace;
    let mut second = m.map(|row| row.map(|x| -x));
    for (i, row) in second.iter_mut().enumerate() {
        row[i] += 0.5 * trace + slack;
    }
    trace > LEAST && is_positive(m) && is_positive(&second)
}

/// Whether the leading minors are positive.
fn is_positive(m: &Matrix) -> bool {
    let second = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    let third = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
        - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    m[0][0] > 0.0 && second > 0.0 && third > 0.0
}

/// `<geom>` of a shape that touches nothing, in a group; `None` for meshes, which MuJoCo reads in other ways, and for shapes without
/// extent.
pub(super) fn shape(shape: &Shape, group: usize) -> Option<String> {
    let half = Number::ratio(1, 2)?;
    let (word, size) = match &shape.geometry {
        Solid::Box(edges) => ("box", edges.each_ref().map(|edge| edge * &half).to_vec()),
        Solid::Cylinder { radius, length } => ("cylinder", vec![radius.clone(), length * &half]),
        Solid::Capsule { radius, length } => ("capsule", vec![radius.clone(), length * &half]),
        Solid::Sphere(radius) => ("sphere", vec![radius.clone()]),
        Solid::Mesh { .. } => return None,
    };
    if size.iter().any(|x| !(x.value() > EXTENT)) {
        return None;
    }
    let (place, size) = (
        Place::Stated(shape.origin.clone()).attributes(),
        texts(&size),
    );
    Some(format!(
        "<geom type=\"{word}\" size=\"{size}\"{place} group=\"{group}\" contype=\"0\" conaffinity=\"0\"/>"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inertias_that_no_body_has_are_known() {
        let of = |a: f64, b: f64, c: f64| [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]];
        assert!(is_possible(&of(1.0, 1.0, 1.0)));
        // A plate.
        assert!(is_possible(&of(1.0, 2.0, 3.0)));
        assert!(!is_possible(&of(1.0, 1.0, 3.0)));
        assert!(!is_possible(&of(0.0, 0.0, 0.0)));
        assert!(!is_possible(&of(1.0, -1.0, 1.0)));
    }
}
