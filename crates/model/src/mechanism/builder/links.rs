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

#[cfg(test)]
mod tests {
    use super::super::samples::{far_away, fault, links, number};
    use crate::mechanism::{Frame, Geometry, Inertial, Shape};
    use kutzbach_math::number::Number;

    fn inertial(mass: &str, inertia: &str, origin: Frame) -> Inertial {
        Inertial {
            origin,
            mass: number(mass),
            inertia: std::array::from_fn(|_| number(inertia)),
        }
    }

    #[test]
    fn mass_properties() {
        let with = |inertial: Inertial| {
            let mut builder = links(&["a"]);
            builder.detailed_link("b", Some(inertial), Vec::new(), Vec::new());
            fault(builder)
        };
        let home = Frame::identity;
        assert_eq!(
            with(inertial("-1", "1", home())),
            "link `b`: the mass is negative"
        );
        let beyond = "beyond the largest number accepted, 1e100";
        for (inertial, what) in [
            (inertial("1e101", "1", home()), "mass is 1e101"),
            (inertial("1", "-1e101", home()), "inertia is -1e101"),
            (inertial("1", "1", far_away()), "origin is 1e200"),
        ] {
            assert_eq!(with(inertial), format!("link `b`: {what}, {beyond}"));
        }
        // Without mass it is a link like any other: the fault is elsewhere.
        assert!(with(inertial("0", "0", home())).contains("nothing connects it"));
    }

    #[test]
    fn shapes() {
        let (one, huge) = (|| number("1"), || number("1e101"));
        let size = |last: Number| [one(), one(), last];
        for (geometry, what) in [
            (Geometry::Box(size(huge())), "size"),
            (Geometry::Sphere(huge()), "radius"),
            (
                Geometry::Cylinder {
                    radius: huge(),
                    length: one(),
                },
                "radius",
            ),
            (
                Geometry::Capsule {
                    radius: one(),
                    length: huge(),
                },
                "length",
            ),
            (
                Geometry::Mesh {
                    filename: "a.stl".to_owned(),
                    scale: Some(size(huge())),
                },
                "scale",
            ),
        ] {
            let shape = |origin: Frame, geometry: &Geometry| Shape {
                name: None,
                origin,
                geometry: geometry.clone(),
            };
            let told =
                format!("link `b`: {what} is 1e101, beyond the largest number accepted, 1e100");
            let mut collision = links(&["a"]);
            let shapes = vec![shape(Frame::identity(), &geometry)];
            collision.detailed_link("b", None, shapes.clone(), Vec::new());
            assert_eq!(fault(collision), told);
            let mut visual = links(&["a"]);
            visual.detailed_link("b", None, Vec::new(), shapes);
            assert_eq!(fault(visual), told);
            let mut placed = links(&["a"]);
            placed.detailed_link("b", None, vec![shape(far_away(), &geometry)], Vec::new());
            assert!(fault(placed).starts_with("link `b`: origin is 1e200"));
        }
    }
}
