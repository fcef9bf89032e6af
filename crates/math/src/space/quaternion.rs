//! Rotations as quaternions, for whoever draws or logs them.

use super::Rigid;

impl Rigid<f64> {
    /// The rotation as a unit quaternion `[x, y, z, w]` with `w ≥ 0`.
    ///
    /// The largest component comes first, from a sum that is at least one (Shepperd 1978, *Quaternion from rotation
    /// matrix*), so that nothing is lost near half turns.
    #[must_use]
    pub fn quaternion(&self) -> [f64; 4] {
        let r = &self.rotation;
        let trace = r[0][0] + r[1][1] + r[2][2];
        let squares = [r[0][0], r[1][1], r[2][2], trace];
        let mut largest = 3;
        for i in [0, 1, 2] {
            if squares[i] > squares[largest] {
                largest = i;
            }
        }
        let mut q = [0.0; 4];
        if largest == 3 {
            q[0] = r[2][1] - r[1][2];
            q[1] = r[0][2] - r[2][0];
            q[2] = r[1][0] - r[0][1];
            q[3] = 1.0 + trace;
        } else {
            let (i, j, k) = (largest, (largest + 1) % 3, (largest + 2) % 3);
            q[i] = 1.0 + r[i][i] - r[j][j] - r[k][k];
            q[j] = r[j][i] + r[i][j];
            q[k] = r[k][i] + r[i][k];
            q[3] = r[k][j] - r[j][k];
        }
        let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        let sign = if q[3] < 0.0 { -1.0 } else { 1.0 };
        // Adding zero turns −0 into 0.
        q.map(|x| x * sign / length + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Quaternion, UnitQuaternion};
    use proptest::prelude::*;

    /// The rotation that nalgebra makes of the four numbers, as far from the pose's own as any entry is.
    fn error(pose: &Rigid<f64>) -> f64 {
        let [x, y, z, w] = pose.quaternion();
        let again = UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z)).to_rotation_matrix();
        let entries = (0..9).map(|k| (k / 3, k % 3));
        entries
            .map(|(i, j)| (again[(i, j)] - pose.rotation[i][j]).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn half_turns_keep_their_axes() {
        for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.6, 0.0, 0.8]] {
            let half = Rigid::rotation(&axis, &-1.0, &0.0);
            assert!(error(&half) < 1e-15);
            assert!(half.quaternion()[3].abs() < 1e-15);
        }
        let rest = Rigid::identity(&0.0).quaternion();
        assert_eq!(rest, [0.0, 0.0, 0.0, 1.0]);
    }

    proptest! {
        #[test]
        fn rotations_survive(angular in prop::array::uniform3(-3.2..3.2f64)) {
            let pose = Rigid::exponential(&angular, &[0.0; 3]);
            prop_assert!(pose.quaternion()[3] >= 0.0);
            prop_assert!(error(&pose) < 4e-15);
        }
    }
}
