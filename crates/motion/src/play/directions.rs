//! The deviations that a joint's play may take: the directions that the joint constrains, in a metric of lengths.

use kutzbach_closure::{JointDisplacement, JointState};
use kutzbach_math::space::{PlacedScrew, Rigid};
use nalgebra::{DMatrix, Vector6};

/// Below this share of the largest, a joint's freedoms coincide at a pose, as a universal joint's never do.
const COINCIDE: f64 = 1e-9;

/// Deviations of size one (m) in directions orthogonal to the joint's freedoms and to each other.
pub(super) struct Constrained {
    /// Each as a screw in the predecessor's joint frame, at the origin of the successor's.
    pub screws: Vec<Deviating>,
}

/// One direction.
pub(super) struct Deviating {
    /// Tilt (rad per metre of deviation).
    pub tilt: [f64; 3],
    /// Shift (m per metre of deviation).
    pub shift: [f64; 3],
    at: [f64; 3],
}

impl Deviating {
    /// In another frame, as two placed screws whose sum it is: a turn about an axis through the point, and a shift.
    pub fn screw(&self, frame: &Rigid<f64>) -> PlacedScrew<f64> {
        PlacedScrew {
            angular: self.tilt,
            point: self.at,
            linear: self.shift,
        }
        .moved(frame)
    }
}

impl Constrained {
    /// Those of a joint at a state, tilts counting by an arm (m).
    pub fn of(joint: &JointDisplacement<f64>, state: &JointState<f64>, arm: f64) -> Self {
        let (displacement, screws) = joint.displacement_and_screws(state);
        let at = displacement.translation;
        let mut freedoms = DMatrix::zeros(6, screws.len().max(1));
        for (column, screw) in screws.iter().enumerate() {
            let (angular, linear) = screw.about(&at);
            let twist = Vector6::from_iterator(angular.iter().map(|x| x * arm).chain(linear));
            freedoms.set_column(column, &twist.normalize());
        }
        // Eigenvectors of the Gram matrix with eigenvalue zero are what no freedom reaches.
        let gram = &freedoms * freedoms.transpose();
        let eigen = gram.symmetric_eigen();
        let most = eigen.eigenvalues.max().max(f64::MIN_POSITIVE);
        let screws = (0..6)
            .filter(|&i| screws.is_empty() || eigen.eigenvalues[i] <= COINCIDE * most)
            .map(|i| {
                let v = eigen.eigenvectors.column(i);
                Deviating {
                    tilt: [v[0] / arm, v[1] / arm, v[2] / arm],
                    shift: [v[3], v[4], v[5]],
                    at,
                }
            })
            .collect();
        Self { screws }
    }
}
