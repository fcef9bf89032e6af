//! Rotations by small steps: swings of rods, derivatives of rotation vectors, turns counted on.

use kutzbach_closure::{Rigid, Vector, cross_product};

/// The shortest rotation from x to a direction, which must not be −x.
pub(super) fn swing_to(to: &Vector<f64>) -> Rigid<f64> {
    let sine = to[1].hypot(to[2]);
    if !(sine > 0.0) {
        return Rigid::identity(&1.0);
    }
    Rigid::rotation(&[0.0, -to[2] / sine, to[1] / sine], &to[0], &sine)
}

/// The two swings that lead from one direction of a rod to another (rotations about y and z, written to `z`), and the spin
/// that is then handed on to the ball.
pub(super) fn swing_way(from: &Rigid<f64>, to: &Rigid<f64>, z: &mut [f64]) -> Rigid<f64> {
    let direction = [0, 1, 2].map(|i| to.rotation[i][0]);
    let seen = from.rotate_back(&direction);
    let sine = seen[1].hypot(seen[2]);
    let angle = sine.atan2(seen[0]);
    let factor = if sine > 0.0 { angle / sine } else { 0.0 };
    z[0] = -seen[2] * factor;
    z[1] = seen[1] * factor;
    let reached = from.compose(&Rigid::exponential(&[0.0, z[0], z[1]], &[0.0; 3]));
    to.inverse().compose(&reached)
}

pub(super) fn norm(v: &Vector<f64>) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// J_r⁻¹(ρ) δ: by how much the rotation vector of `exp(ρ)` changes when it is multiplied by `exp(δ)` from the right
/// (Murray, Li & Sastry 1994, section 2.3; Chirikjian 2012, section 10.8.5). Diverges at a full turn.
pub(super) fn inverse_right_jacobian(turn: &Vector<f64>, step: &Vector<f64>) -> Vector<f64> {
    let angle = norm(turn);
    let first = cross_product(turn, step);
    let second = cross_product(turn, &first);
    let factor = if angle < 1e-3 {
        // 1/θ² − cot(θ/2)/(2θ) = 1/12 + θ²/720 + …
        1.0 / 12.0 + angle * angle / 720.0
    } else {
        let half = 0.5 * angle;
        (1.0 - half * half.cos() / half.sin()) / (angle * angle)
    };
    [0, 1, 2].map(|i| step[i] + 0.5 * first[i] + factor * second[i])
}

/// Keeps a product of many rotations a rotation: one step of Newton's iteration for the polar factor, which squares the
/// error (Higham 1986), `R (3 − RᵀR) / 2`.
pub(super) fn orthonormalise(r: &mut [[f64; 3]; 3]) {
    let mut square = [[0.0; 3]; 3];
    for (i, row) in square.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = (0..3).map(|k| r[k][i] * r[k][j]).sum();
        }
    }
    let old = *r;
    for (i, row) in r.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = 1.5 * old[i][j] - 0.5 * (0..3).map(|k| old[i][k] * square[k][j]).sum::<f64>();
        }
    }
}

/// The axis of a smaller turn (rad) than this is known to less than seven digits, and no better than that which it had before.
const AXIS_SEEN: f64 = 1e-9;

/// The rotation vector of the same rotation that is nearest to the values before: whole turns are added along its axis.
pub(super) fn nearest_turn(
    turn: &Vector<f64>,
    generators: &[(Vector<f64>, Vector<f64>)],
    before: &[f64],
) -> Vector<f64> {
    let mut old = [0.0; 3];
    for (value, (angular, _)) in before.iter().zip(generators) {
        for (o, a) in old.iter_mut().zip(angular) {
            *o += a * value;
        }
    }
    let angle = norm(turn);
    if angle < AXIS_SEEN {
        // No turn is every whole turn about every axis: that about the axis before is the nearest.
        let before = norm(&old);
        let turns = (before / std::f64::consts::TAU).round();
        return match turns > 0.0 {
            true => old.map(|o| o / before * turns * std::f64::consts::TAU),
            false => *turn,
        };
    }
    let axis = turn.map(|t| t / angle);
    let along: f64 = axis.iter().zip(&old).map(|(a, o)| a * o).sum();
    let turns = ((along - angle) / std::f64::consts::TAU).round();
    axis.map(|a| a * (angle + turns * std::f64::consts::TAU))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_full_turn_is_counted_on_where_no_axis_is_seen() {
        let own = [0, 1, 2].map(|axis| {
            let unit = [0, 1, 2].map(|k| if k == axis { 1.0 } else { 0.0 });
            (unit, [0.0; 3])
        });
        let after = |turn: [f64; 3], before: [f64; 3]| nearest_turn(&turn, &own, &before);
        let close = |a: [f64; 3], b: [f64; 3]| {
            assert!(
                norm(&[a[0] - b[0], a[1] - b[1], a[2] - b[2]]) < 1e-12,
                "{a:?} {b:?}"
            );
        };
        // Just before, at and just after a full turn about z, and at the start, where nothing has turned.
        close(
            after([0.0, 0.0, -0.1], [0.0, 0.0, 6.1]),
            [0.0, 0.0, TAU - 0.1],
        );
        close(after([0.0; 3], [0.0, 0.0, 6.2]), [0.0, 0.0, TAU]);
        close(
            after([0.0, 0.0, 0.1], [0.0, 0.0, TAU]),
            [0.0, 0.0, TAU + 0.1],
        );
        close(after([1e-17, 0.0, 0.0], [0.0, 0.0, 0.1]), [1e-17, 0.0, 0.0]);
        // About an oblique axis, backward, twice around.
        let twice = [-1.2 * TAU, 0.0, -1.6 * TAU];
        close(after([0.0; 3], twice.map(|x| 0.99 * x)), twice);
    }
}
