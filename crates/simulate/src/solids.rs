//! Primitive shapes of a file as the engine's shapes.

use super::convert::{frame, pose};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Geometry, Shape};
use rapier3d_f64::prelude::{Pose, Rotation, SharedShape, Vector};

/// A shape and `link_from_shape`, in units of `unit` metres; `None` for meshes and for sizes that are not positive
/// numbers to compute with.
pub(super) fn solid(shape: &Shape, unit: f64) -> Option<(Pose, SharedShape)> {
    let mut placed = pose(&frame(&shape.origin));
    placed.translation /= unit;
    let size = |number: &Number| -> Option<f64> {
        let value = number.value() / unit;
        (value > 1e-30 && value < 1e30).then_some(value)
    };
    if !placed.is_finite() {
        return None;
    }
    match &shape.geometry {
        Geometry::Box(edges) => {
            let [x, y, z] = edges;
            let half = [size(x)?, size(y)?, size(z)?].map(|edge| 0.5 * edge);
            Some((placed, SharedShape::cuboid(half[0], half[1], half[2])))
        }
        // The engine's cylinders stand along y.
        Geometry::Cylinder { radius, length } => Some((
            placed * Pose::from_rotation(Rotation::from_axis_angle(Vector::X, QUARTER_TURN)),
            SharedShape::cylinder(0.5 * size(length)?, size(radius)?),
        )),
        Geometry::Capsule { radius, length } => Some((
            placed,
            SharedShape::capsule_z(0.5 * size(length)?, size(radius)?),
        )),
        Geometry::Sphere(radius) => Some((placed, SharedShape::ball(size(radius)?))),
        Geometry::Mesh { .. } => None,
    }
}

const QUARTER_TURN: f64 = std::f64::consts::FRAC_PI_2;
