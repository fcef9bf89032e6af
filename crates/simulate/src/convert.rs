//! Between this crate's displacements and the physics engine's.

use kutzbach_closure::{Rigid, Vector, across};
use kutzbach_model::mechanism::Frame;
use rapier3d_f64::prelude::{Matrix, Pose, Rotation, Vector as Vec3};

/// A vector of the engine.
pub(super) fn vector(v: &Vector<f64>) -> Vec3 {
    Vec3::new(v[0], v[1], v[2])
}

/// The engine's pose. The quaternion is normalised: rotation matrices multiplied many times drift off by rounding.
pub(super) fn pose(rigid: &Rigid<f64>) -> Pose {
    let column = |j: usize| {
        Vec3::new(
            rigid.rotation[0][j],
            rigid.rotation[1][j],
            rigid.rotation[2][j],
        )
    };
    let matrix = Matrix::from_cols(column(0), column(1), column(2));
    Pose::from_parts(
        vector(&rigid.translation),
        Rotation::from_mat3(&matrix).normalize(),
    )
}

/// This crate's displacement.
pub(super) fn rigid(pose: &Pose) -> Rigid<f64> {
    let matrix = Matrix::from_quat(pose.rotation);
    let (x, y, z) = (matrix.x_axis, matrix.y_axis, matrix.z_axis);
    Rigid {
        rotation: [[x.x, y.x, z.x], [x.y, y.y, z.y], [x.z, y.z, z.z]],
        translation: [pose.translation.x, pose.translation.y, pose.translation.z],
    }
}

/// The rotation whose x axis is a unit vector and whose y and z axes are the joint's two directions across it.
pub(super) fn along(axis: &Vector<f64>) -> Rigid<f64> {
    let (y, z) = across(axis);
    Rigid {
        rotation: [0, 1, 2].map(|i| [axis[i], y[i], z[i]]),
        translation: [0.0; 3],
    }
}

/// The rotation alone.
pub(super) fn turn(rigid: &Rigid<f64>) -> Rigid<f64> {
    Rigid {
        rotation: rigid.rotation,
        translation: [0.0; 3],
    }
}

/// Whether every number is finite and its square is, too.
pub(super) fn computable(rigid: &Rigid<f64>) -> bool {
    let numbers = rigid.rotation.iter().flatten().chain(&rigid.translation);
    numbers.into_iter().all(|x| x.abs() < 1e100)
}

/// A frame of a file in double precision: `R = Rz(yaw) Ry(pitch) Rx(roll)`.
pub(super) fn frame(frame: &Frame) -> Rigid<f64> {
    let mut placed = Rigid::translation([0, 1, 2].map(|i| frame.position[i].value()));
    for axis in [2, 1, 0] {
        let mut direction = [0.0; 3];
        direction[axis] = 1.0;
        let (sine, cosine) = frame.roll_pitch_yaw[axis].value().sin_cos();
        placed = placed.compose(&Rigid::rotation(&direction, &cosine, &sine));
    }
    placed
}
