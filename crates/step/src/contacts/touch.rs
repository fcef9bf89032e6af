//! Whether two faces touch.

use super::overlap::{Chart, common};
use super::{ContactKind, ContactOptions};
use crate::shape::{Face, Side, Surface};
use nalgebra::Vector3;

/// Faces that lean against each other more than this (rad) are never on each other, however small.
const STEEPEST: f64 = 0.02;

/// Of a radius, the largest part that counts as clearance.
const SHARE: f64 = 0.25;

/// Strips narrower than this part of their length are the digits of two edges in one place.
const SLIVER: f64 = 1e-6;

/// What two faces have in common.
pub(super) struct Touch {
    /// Which kind of contact.
    pub kind: ContactKind,
    /// Unit direction of the axis, or the normal out of the first face's part.
    pub axis: Vector3<f64>,
    /// A point of it (m).
    pub point: Vector3<f64>,
    /// Room between the faces (m).
    pub clearance: f64,
    /// How far the faces are from sharing axis, centre or direction (m).
    pub misfit: f64,
    /// How large the contact is (m).
    pub size: f64,
}

/// What two faces, both in the frame of the assembly, have in common; `None` where they do not touch.
pub(super) fn touch(first: &Face, second: &Face, options: &ContactOptions) -> Option<Touch> {
    let (pin, hole) = match (&first.surface, &second.surface) {
        (Surface::Plane { .. }, Surface::Plane { .. }) => return planar(first, second, options),
        // One bulges into the other.
        _ if first.material == Side::Inside && second.material == Side::Outside => (first, second),
        _ if first.material == Side::Outside && second.material == Side::Inside => (second, first),
        _ => return None,
    };
    match (&pin.surface, &hole.surface) {
        (Surface::Cylinder { .. }, Surface::Cylinder { .. }) => cylindrical(pin, hole, options),
        (Surface::Sphere { .. }, Surface::Sphere { .. }) => spherical(pin, hole, options),
        (Surface::Cone { .. }, Surface::Cone { .. }) => conical(pin, hole, options),
        _ => None,
    }
}

/// The largest distance (m) that counts as touching for a pin or ball of this radius.
fn play(radius: f64, options: &ContactOptions) -> f64 {
    options.clearance.min(SHARE * radius) + options.accuracy
}

/// Where `other` goes along the axis of a face, which passes `point` along `direction`.
fn heights(other: &Face, point: Vector3<f64>, direction: Vector3<f64>) -> Option<(f64, f64)> {
    let (origin, axis) = other.surface.axis()?;
    let at = |height: f64| (origin + axis * height - point).dot(&direction);
    let (one, two) = (at(other.extent.0), at(other.extent.1));
    Some((one.min(two), one.max(two)))
}

fn cylindrical(pin: &Face, hole: &Face, options: &ContactOptions) -> Option<Touch> {
    let Surface::Cylinder {
        point: p,
        direction: d,
        radius: r,
    } = pin.surface
    else {
        return None;
    };
    let Surface::Cylinder {
        point: q,
        direction: e,
        radius: s,
    } = hole.surface
    else {
        return None;
    };
    let play = play(r.min(s), options);
    let clearance = s - r;
    let turned = pin.turned.min(hole.turned);
    if clearance.abs() > play || d.cross(&e).norm() > STEEPEST || turned < options.least_turn {
        return None;
    }
    let (low, high) = heights(hole, p, d)?;
    let (low, high) = (low.max(pin.extent.0), high.min(pin.extent.1));
    let size = high - low;
    if !(size > options.accuracy) {
        return None;
    }
    let apart = |height: f64| (p + d * height - q).cross(&e).norm();
    let misfit = apart(low).max(apart(high));
    (misfit <= play).then_some(Touch {
        kind: ContactKind::Cylindrical,
        axis: d,
        point: p + d * ((low + high) / 2.0),
        clearance,
        misfit,
        size,
    })
}

fn planar(first: &Face, second: &Face, options: &ContactOptions) -> Option<Touch> {
    let Surface::Plane {
        point: p,
        normal: n,
    } = first.surface
    else {
        return None;
    };
    let Surface::Plane {
        point: q,
        normal: m,
    } = second.surface
    else {
        return None;
    };
    let lean = n.cross(&m).norm();
    let play = options.clearance + options.accuracy;
    // Against each other, and near somewhere: the exact distance is taken where they overlap.
    if n.dot(&m) >= 0.0 || lean > STEEPEST {
        return None;
    }
    let chart = Chart::new(p, n);
    let (one, two) = (chart.flat(&first.outline)?, chart.flat(&second.outline)?);
    let shared = common(&one, &two)?;
    // A strip as wide as points are accurate is no common area. Polygons that only share an edge give one.
    let width = options.accuracy.max(SLIVER * shared.length);
    if shared.area <= 2.0 * width * shared.length {
        return None;
    }
    let (point, size) = (chart.point(shared.centroid), shared.area.sqrt());
    let clearance = (q - point).dot(&m) / n.dot(&m);
    let misfit = lean * size;
    (clearance.abs() <= play && misfit <= play).then_some(Touch {
        kind: ContactKind::Planar,
        axis: n,
        point,
        clearance,
        misfit,
        size,
    })
}

fn spherical(ball: &Face, socket: &Face, options: &ContactOptions) -> Option<Touch> {
    let Surface::Sphere {
        centre: p,
        radius: r,
    } = ball.surface
    else {
        return None;
    };
    let Surface::Sphere {
        centre: q,
        radius: s,
    } = socket.surface
    else {
        return None;
    };
    let play = play(r.min(s), options);
    let (clearance, misfit) = (s - r, (p - q).norm());
    (clearance.abs() <= play && misfit <= play).then_some(Touch {
        kind: ContactKind::Spherical,
        axis: Vector3::z(),
        point: p,
        clearance,
        misfit,
        size: r,
    })
}

fn conical(pin: &Face, hole: &Face, options: &ContactOptions) -> Option<Touch> {
    let Surface::Cone {
        apex: p,
        direction: d,
        half_angle: a,
    } = pin.surface
    else {
        return None;
    };
    let Surface::Cone {
        apex: q,
        direction: e,
        half_angle: b,
    } = hole.surface
    else {
        return None;
    };
    let turned = pin.turned.min(hole.turned);
    let lean = d.cross(&e).norm().max((a - b).abs());
    if d.dot(&e) <= 0.0 || lean > STEEPEST || turned < options.least_turn {
        return None;
    }
    let (low, high) = heights(hole, p, d)?;
    let (low, high) = (low.max(pin.extent.0), high.min(pin.extent.1));
    let size = high - low;
    if !(size > options.accuracy) {
        return None;
    }
    let play = play(high.abs() * a.tan(), options);
    let between = q - p;
    // A cone that is shifted along its axis leaves its seat by the sine of its angle; the hole's apex below the pin's is room.
    let clearance = -between.dot(&d) * a.sin();
    let misfit = between.cross(&d).norm().max(lean * size);
    (clearance.abs() <= play && misfit <= play).then_some(Touch {
        kind: ContactKind::Conical,
        axis: d,
        point: p,
        clearance,
        misfit,
        size,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn face(surface: Surface, material: Side) -> Face {
        Face {
            entity: 1,
            halves: Vec::new(),
            edges: Vec::new(),
            surface,
            material,
            outline: Vec::new(),
            extent: (0.0, 0.02),
            turned: TAU,
        }
    }

    fn tube(shift: f64, radius: f64, material: Side) -> Face {
        let surface = Surface::Cylinder {
            point: Vector3::new(shift, 0.0, shift),
            direction: Vector3::z(),
            radius,
        };
        face(surface, material)
    }

    #[test]
    fn a_pin_needs_a_hole_of_its_size_on_its_axis() {
        let options = ContactOptions::default();
        let hole = tube(0.0, 0.0051, Side::Outside);
        let found = touch(&tube(0.0, 0.005, Side::Inside), &hole, &options).unwrap();
        assert_eq!(found.kind, ContactKind::Cylindrical);
        assert!((found.clearance - 1e-4).abs() < 1e-15);
        assert_eq!((found.size, found.misfit), (0.02, 0.0));
        // Inside each other, too small, beside, above, without a hole, with a corner only.
        assert!(touch(&hole, &tube(0.0, 0.00515, Side::Inside), &options).is_some());
        assert!(touch(&tube(0.0, 0.0045, Side::Inside), &hole, &options).is_none());
        assert!(touch(&tube(0.001, 0.005, Side::Inside), &hole, &options).is_none());
        let mut above = tube(0.0, 0.005, Side::Inside);
        above.extent = (0.021, 0.03);
        assert!(touch(&above, &hole, &options).is_none());
        assert!(touch(&tube(0.0, 0.005, Side::Outside), &hole, &options).is_none());
        let mut corner = tube(0.0, 0.005, Side::Inside);
        corner.turned = TAU / 4.0;
        assert!(touch(&corner, &hole, &options).is_none());
    }

    #[test]
    fn balls_and_cones_need_their_sockets() {
        let options = ContactOptions::default();
        let sphere = |x: f64, radius: f64, material| {
            let centre = Vector3::new(x, 0.0, 0.0);
            face(Surface::Sphere { centre, radius }, material)
        };
        let socket = sphere(0.0, 0.01, Side::Outside);
        let found = touch(&sphere(1e-5, 0.01, Side::Inside), &socket, &options).unwrap();
        assert_eq!(found.kind, ContactKind::Spherical);
        assert!(touch(&sphere(0.001, 0.01, Side::Inside), &socket, &options).is_none());

        let cone = |height: f64, half_angle: f64, material| {
            let apex = Vector3::new(0.0, 0.0, height);
            let direction = Vector3::z();
            let surface = Surface::Cone {
                apex,
                direction,
                half_angle,
            };
            face(surface, material)
        };
        let seat = cone(0.0, 0.5, Side::Outside);
        let found = touch(&cone(1e-4, 0.5, Side::Inside), &seat, &options).unwrap();
        assert!(found.kind == ContactKind::Conical && found.clearance > 0.0);
        assert!(touch(&cone(0.0, 0.6, Side::Inside), &seat, &options).is_none());
    }
}
