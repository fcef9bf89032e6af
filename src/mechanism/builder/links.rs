//! Rules about one link.

use super::checks::{check_all_finite, check_finite, check_frame};
use crate::mechanism::{Entity, Geometry, Link, MechanismError, Shape};

/// Mass properties and shapes.
pub(super) fn check_link(link: &Link) -> Result<(), MechanismError> {
    let entity = Entity::Link(link.name.clone());
    if let Some(inertial) = &link.inertial {
        check_frame(&entity, &inertial.origin)?;
        check_finite(&entity, "mass", &inertial.mass)?;
        check_all_finite(&entity, "inertia", &inertial.inertia)?;
        if inertial.mass.value() < 0.0 {
            return Err(MechanismError::new(entity, "the mass is negative"));
        }
    }
    link.collisions
        .iter()
        .chain(&link.visuals)
        .try_for_each(|shape| check_shape(&entity, shape))
}

fn check_shape(entity: &Entity, shape: &Shape) -> Result<(), MechanismError> {
    check_frame(entity, &shape.origin)?;
    match &shape.geometry {
        Geometry::Box(size) => check_all_finite(entity, "size", size),
        Geometry::Cylinder { radius, length } | Geometry::Capsule { radius, length } => {
            check_finite(entity, "radius", radius)?;
            check_finite(entity, "length", length)
        }
        Geometry::Sphere(radius) => check_finite(entity, "radius", radius),
        Geometry::Mesh { scale, .. } => check_all_finite(entity, "scale", scale.iter().flatten()),
    }
}
