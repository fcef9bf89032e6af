//! The surfaces of faces.

use crate::curves::Curve;
use crate::error::{Problem, StepError};
use crate::part21::{Instance, Record};
use crate::placement::{axis, direction, placement};
use crate::quadrics::{Range, Recognised, recognised};
use crate::shape::Surface;
use crate::spline::SplineSurface;
use crate::units::Units;
use kutzbach_math::group::Pose;
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// The most surfaces that stand for each other, one after the other.
const LONGEST: usize = 8;

/// How far lines are followed that sweep a surface (m). Where a surface is known by this much of it, it is known.
const REACH: f64 = 1.0;

/// A surface in the frame of its representation (m), and whether its own normal points away from its axis or centre (for planes:
/// along the normal that is given).
///
/// # Errors
/// References to nothing, parameters of the wrong kind, radii that are not positive.
pub(crate) fn surface(instance: Instance<'_>, units: &Units) -> Result<Recognised, StepError> {
    let mut instance = instance;
    let mut agrees = true;
    for _ in 0..LONGEST {
        let Some(trimmed) = instance.leaf("RECTANGULAR_TRIMMED_SURFACE") else {
            let (surface, outward) = itself(instance, units)?;
            return Ok((surface, outward == agrees));
        };
        agrees ^= trimmed.truth_at(6)? != trimmed.truth_at(7)?;
        instance = trimmed.entity_at(1)?;
    }
    Err(instance.error(Problem::Cycle { what: "surfaces" }))
}

fn itself(instance: Instance<'_>, units: &Units) -> Result<Recognised, StepError> {
    let elementary = [
        "PLANE",
        "CYLINDRICAL_SURFACE",
        "CONICAL_SURFACE",
        "SPHERICAL_SURFACE",
    ];
    if let Some(record) = elementary.iter().find_map(|word| instance.leaf(word)) {
        let frame = placement(record.entity_at(1)?, units)?;
        return Ok((written(record, &frame, units)?, true));
    }
    let found = if let Some(record) = instance.leaf("SURFACE_OF_LINEAR_EXTRUSION") {
        extruded(record, units)?
    } else if let Some(record) = instance.leaf("SURFACE_OF_REVOLUTION") {
        revolved(record, units)?
    } else if let Some(spline) = SplineSurface::read(instance, units)? {
        let (u, v) = spline.domain();
        recognised(&|a, b| spline.at(a, b), u, v, units.accuracy)
    } else {
        None
    };
    Ok(found.unwrap_or_else(|| (Surface::Other(instance.keywords()), true)))
}

/// A plane, cylinder, cone or sphere with its frame, whose z is the axis.
fn written(record: Record<'_>, frame: &Pose, units: &Units) -> Result<Surface, StepError> {
    let (point, z) = (frame.translation, frame.transform_direction(&Vector3::z()));
    if record.keyword() == "PLANE" {
        return Ok(Surface::Plane { point, normal: z });
    }
    let radius = units.metres(record.number_at(2)?);
    let is_cone = record.keyword() == "CONICAL_SURFACE";
    if !(radius > 0.0 || (is_cone && radius == 0.0)) {
        return Err(record.wrong(2, "a positive radius"));
    }
    Ok(match record.keyword() {
        "CYLINDRICAL_SURFACE" => Surface::Cylinder {
            point,
            direction: z,
            radius,
        },
        "SPHERICAL_SURFACE" => Surface::Sphere {
            centre: point,
            radius,
        },
        _ => {
            let angle = record.number_at(3)? * units.angle;
            let half_angle = angle.abs();
            if !(half_angle > 0.0 && half_angle < FRAC_PI_2) {
                return Err(record.wrong(3, "an angle between zero and a right one"));
            }
            // A negative angle, which some writers give, lets the cone become narrow along z.
            let direction = z * angle.signum();
            Surface::Cone {
                apex: point - direction * (radius / half_angle.tan()),
                direction,
                half_angle,
            }
        }
    })
}

/// The point of a curve at a parameter.
type Along = Box<dyn Fn(f64) -> Vector3<f64>>;

/// A curve by its parameter, and from where to where it is followed; `None` where it cannot be.
fn followed(curve: Curve) -> Option<(Along, Range)> {
    match curve {
        Curve::Line(point, along) => {
            let unit = along.norm();
            (unit > 0.0).then(|| -> (Along, Range) {
                (
                    Box::new(move |t: f64| point + along * t),
                    (0.0, REACH / unit),
                )
            })
        }
        Curve::Ellipse(centre, x, y) => Some((
            Box::new(move |t: f64| centre + x * t.cos() + y * t.sin()),
            (0.0, TAU),
        )),
        Curve::Spline(spline) => {
            let domain = spline.domain();
            Some((Box::new(move |t: f64| spline.at(t)), domain))
        }
        Curve::Corners(_) | Curve::Other(_) => None,
    }
}

fn extruded(record: Record<'_>, units: &Units) -> Result<Option<Recognised>, StepError> {
    let curve = Curve::read(record.entity_at(1)?, units)?;
    let vector = record.entity_at(2)?.expect("VECTOR", "VECTOR")?;
    let along = direction(vector.entity_at(1)?)?;
    let Some((curve, u)) = followed(curve) else {
        return Ok(None);
    };
    // As high as the curve is wide, so that both count alike.
    let middle = curve((u.0 + u.1) / 2.0);
    let height = (curve(u.0) - middle).norm().max(1e-6);
    let chart = |a: f64, b: f64| curve(a) + along * b;
    Ok(recognised(&chart, u, (0.0, height), units.accuracy))
}

fn revolved(record: Record<'_>, units: &Units) -> Result<Option<Recognised>, StepError> {
    let curve = Curve::read(record.entity_at(1)?, units)?;
    let (origin, axis) = axis(record.entity_at(2)?, units)?;
    let Some((curve, v)) = followed(curve) else {
        return Ok(None);
    };
    let chart = |a: f64, b: f64| {
        let arm = curve(b) - origin;
        let turn = Pose::rotation_about(axis, a);
        origin + turn.transform_direction(&arm)
    };
    Ok(recognised(&chart, (0.0, TAU), v, units.accuracy))
}
