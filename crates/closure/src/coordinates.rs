//! Joint values that a file can hold.

use super::displacement::{JointDisplacement, JointState};
use kutzbach_math::space::{Rigid, cross, length, unit};
use kutzbach_model::mechanism::JointKind;

impl JointDisplacement<f64> {
    /// Values of which [`at`](Self::at) makes the displacement of a state again (rad, m), up to rounding: turns of a ball as
    /// its rotation vector, however they came about; of a rod first the shortest turn that points it there. Values of all
    /// other variables are the state's own.
    #[must_use]
    pub fn coordinates(&self, state: &JointState<f64>) -> Vec<f64> {
        let mut values = state.values.clone();
        let factors = state.factors();
        match (self.kind(), factors) {
            (
                JointKind::Spherical | JointKind::PointOnLine | JointKind::PointOnPlane,
                [ball, ..],
            ) => values[..3].copy_from_slice(&ball.rotation_vector()),
            (JointKind::Distance, [pointing, ball]) => {
                let along = [1.0, 0.0, 0.0];
                let target = pointing.rotate(&along);
                let across = cross(&along, &target);
                // Straight back, any turn about an axis across will do.
                let axis = if length(&across) > 1e-12 {
                    unit(&across)
                } else {
                    [0.0, 1.0, 0.0]
                };
                let angle = length(&across).atan2(target[0]);
                let shortest = Rigid::rotation(&axis, &angle.cos(), &angle.sin());
                let rest = shortest.inverse().compose(pointing).compose(ball);
                values[0] = axis[1] * angle;
                values[1] = axis[2] * angle;
                values[2..].copy_from_slice(&rest.rotation_vector());
            }
            _ => {}
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kutzbach_math::matrix::SplitMix64;

    #[test]
    fn coordinates_make_the_same_displacement() {
        let mut random = SplitMix64::new(7);
        for kind in [
            JointKind::Revolute,
            JointKind::Screw,
            JointKind::Universal,
            JointKind::Planar,
            JointKind::Spherical,
            JointKind::PointOnLine,
            JointKind::PointOnPlane,
            JointKind::LineOnPlane,
            JointKind::Distance,
        ] {
            let axis = [0.0, 0.6, 0.8];
            let joint = JointDisplacement::new(kind, &axis, &[1.0, 0.0, 0.0], &0.1, &2.0);
            for wide in [0.1, 1.0, 3.0] {
                // Several advances one after the other: a ball's accumulated values are no rotation vector then.
                let mut state = joint.home();
                for _ in 0..4 {
                    let step: Vec<f64> = (0..joint.freedom())
                        .map(|_| wide * random.symmetric())
                        .collect();
                    joint.advance(&mut state, &step);
                }
                let wanted = joint.displacement(&state);
                let found = joint.displacement(&joint.at(&joint.coordinates(&state)));
                let off = wanted.inverse().compose(&found);
                assert!(
                    length(&off.rotation_vector()) < 1e-13 && length(&off.translation) < 1e-13,
                    "{kind:?}: {off:?}"
                );
            }
        }
    }
}
