//! A symbol for every class of joint, in the joint's own frames.
//!
//! A pin for a revolute joint, a block on a rail for a slider, a ball for a ball joint, a plate where something slides in
//! a plane. What belongs to the predecessor is drawn there and what belongs to the successor there, so that the two parts
//! come apart where the joint does.

use super::shapes::Primitive;
use super::vectors::{Point, along};
use kutzbach_closure::{JointDisplacement, Rigid};
use kutzbach_model::mechanism::JointKind;

/// One solid of a symbol, in the joint frame of one of the two sides.
pub struct Piece {
    /// Whether it belongs to the successor.
    pub on_successor: bool,
    /// `joint_from_shape`.
    pub pose: Rigid<f64>,
    /// The solid.
    pub primitive: Primitive,
}

fn on(on_successor: bool, direction: Point, primitive: Primitive) -> Piece {
    Piece {
        on_successor,
        pose: along([0.0; 3], direction),
        primitive,
    }
}

/// The symbol of a joint whose pin has the given radius (m).
pub fn symbol(displacement: &JointDisplacement<f64>, radius: f64) -> Vec<Piece> {
    let axis = *displacement.axis();
    let axis2 = *displacement.second_axis();
    let z = [0.0, 0.0, 1.0];
    let cylinder = |wide: f64, long: f64| Primitive::Cylinder {
        radius: wide * radius,
        length: long * radius,
    };
    let cuboid = |x: f64, y: f64, z: f64| Primitive::Box {
        size: [x * radius, y * radius, z * radius],
    };
    let ball = |size: f64| Primitive::Sphere {
        radius: size * radius,
    };
    let plate = || cuboid(7.0, 7.0, 0.4);
    let rail = || cylinder(0.4, 9.0);
    let (predecessor, successor) = (false, true);
    match displacement.kind() {
        JointKind::Fixed => vec![on(predecessor, z, cuboid(1.6, 1.6, 1.6))],
        JointKind::Revolute => vec![on(predecessor, axis, cylinder(1.0, 3.0))],
        JointKind::Prismatic => vec![
            on(predecessor, axis, rail()),
            on(successor, axis, cuboid(2.0, 2.0, 3.0)),
        ],
        JointKind::Screw => vec![
            on(predecessor, axis, cylinder(0.6, 8.0)),
            on(successor, axis, cuboid(2.2, 2.2, 1.4)),
        ],
        JointKind::Cylindrical => vec![
            on(predecessor, axis, cylinder(0.6, 8.0)),
            on(successor, axis, cylinder(1.1, 2.6)),
        ],
        JointKind::Universal => vec![
            on(predecessor, axis, cylinder(0.7, 3.6)),
            on(successor, axis2, cylinder(0.7, 3.6)),
        ],
        JointKind::PlanarTranslation => vec![
            on(predecessor, axis, plate()),
            on(successor, axis, cuboid(2.4, 2.4, 1.0)),
        ],
        JointKind::Planar => vec![
            on(predecessor, axis, plate()),
            on(successor, axis, cylinder(1.3, 1.0)),
        ],
        JointKind::Spherical => vec![on(predecessor, z, ball(1.4))],
        JointKind::Translational => vec![
            on(predecessor, z, ball(0.8)),
            on(successor, z, cuboid(2.0, 2.0, 2.0)),
        ],
        JointKind::TranslatingScrew => vec![
            on(predecessor, axis, plate()),
            on(successor, axis, cylinder(0.6, 5.0)),
            on(successor, axis, cuboid(2.2, 2.2, 1.0)),
        ],
        JointKind::Schoenflies => vec![
            on(predecessor, axis, cuboid(2.0, 2.0, 2.0)),
            on(successor, axis, cylinder(0.8, 4.0)),
        ],
        JointKind::PointOnLine => vec![on(predecessor, z, ball(1.2)), on(successor, axis2, rail())],
        JointKind::LineOnPlane => vec![
            on(predecessor, axis, cylinder(0.4, 6.0)),
            on(successor, axis2, plate()),
        ],
        JointKind::PointOnPlane => {
            vec![on(predecessor, z, ball(1.2)), on(successor, axis2, plate())]
        }
        JointKind::Distance => vec![on(predecessor, z, ball(1.2)), on(successor, z, ball(1.2))],
    }
}

/// The axis or direction in the predecessor, the way its first freedom counts positive; `None` for kinds without one.
pub fn axis_arrow(displacement: &JointDisplacement<f64>, radius: f64) -> Option<Piece> {
    let shown =
        !matches!(displacement.kind(), JointKind::LineOnPlane) && displacement.kind().uses_axis();
    shown.then(|| {
        on(
            false,
            *displacement.axis(),
            Primitive::Arrow {
                radius: 0.18 * radius,
                length: 6.0 * radius,
            },
        )
    })
}
