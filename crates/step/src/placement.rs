//! Points, directions and placements of a file, in metres.

use crate::error::StepError;
use crate::part21::{Instance, Record};
use crate::units::Units;
use kutzbach_math::group::Pose;
use nalgebra::{Matrix3, Vector3};

/// How far a scale may be from one and still be none. Scales are written with few digits; one in a million is a micrometre on
/// a metre.
const SCALE_DIGITS: f64 = 1e-6;

/// Points beyond this distance (m) are numbers that went wrong, and their squares may leave the range of numbers.
const FARTHEST: f64 = 1e12;

/// Below this sine a reference direction is taken as parallel to the axis: it would give a frame without a digit.
const PARALLEL: f64 = 1e-9;

/// A CARTESIAN_POINT (m).
///
/// # Errors
/// Where it is something else, has other than three coordinates, or lies too far away.
pub(crate) fn point(instance: Instance<'_>, units: &Units) -> Result<Vector3<f64>, StepError> {
    let record = instance.expect("CARTESIAN_POINT", "CARTESIAN_POINT")?;
    let point = triple(record)?.map(|x| units.metres(x));
    if point.norm() < FARTHEST {
        return Ok(point);
    }
    let found = format!("{} m", point.norm());
    Err(instance.geometry("a point within 10^12 m", found))
}

/// A DIRECTION, as a unit vector.
///
/// # Errors
/// Where it is something else, has other than three components, or is zero.
pub(crate) fn direction(instance: Instance<'_>) -> Result<Vector3<f64>, StepError> {
    let record = instance.expect("DIRECTION", "DIRECTION")?;
    let vector = triple(record)?;
    let largest = vector.amax();
    if !(largest > 0.0) {
        return Err(instance.geometry("a direction that is not zero", "(0, 0, 0)"));
    }
    Ok((vector / largest).normalize())
}

fn triple(record: Record<'_>) -> Result<Vector3<f64>, StepError> {
    match record.numbers_at(1)?.as_slice() {
        &[x, y, z] => Ok(Vector3::new(x, y, z)),
        _ => Err(record.wrong(1, "three numbers")),
    }
}

/// An AXIS2_PLACEMENT_3D: the pose of its frame.
///
/// # Errors
/// Where it is something else, or its directions give no frame.
pub(crate) fn placement(instance: Instance<'_>, units: &Units) -> Result<Pose, StepError> {
    let record = instance.expect("AXIS2_PLACEMENT_3D", "AXIS2_PLACEMENT_3D")?;
    let origin = point(record.entity_at(1)?, units)?;
    let axis = optional_direction(record, 2)?.unwrap_or_else(Vector3::z);
    let reference = optional_direction(record, 3)?;
    let rotation = frame(axis, reference).ok_or_else(|| {
        instance.geometry(
            "a reference direction that is not parallel to the axis",
            "parallel ones, which leave the frame open",
        )
    })?;
    Ok(Pose::new(rotation, origin))
}

/// An AXIS1_PLACEMENT or AXIS2_PLACEMENT_3D: a point (m) and the unit direction of its axis.
///
/// # Errors
/// As for [`point`] and [`direction`].
pub(crate) fn axis(
    instance: Instance<'_>,
    units: &Units,
) -> Result<(Vector3<f64>, Vector3<f64>), StepError> {
    let record = instance
        .leaf("AXIS2_PLACEMENT_3D")
        .or_else(|| instance.leaf("AXIS1_PLACEMENT"))
        .ok_or_else(|| instance.wrong_kind("AXIS2_PLACEMENT_3D or AXIS1_PLACEMENT"))?;
    let origin = point(record.entity_at(1)?, units)?;
    let axis = optional_direction(record, 2)?.unwrap_or_else(Vector3::z);
    Ok((origin, axis))
}

fn optional_direction(record: Record<'_>, place: usize) -> Result<Option<Vector3<f64>>, StepError> {
    if record.is_unset(place) {
        return Ok(None);
    }
    direction(record.entity_at(place)?).map(Some)
}

/// A rotation whose third column is `axis` (a unit vector) and whose first is `reference` without what is along the axis.
/// Without a reference it is x, or y where the axis is along x (ISO 10303-42, first_proj_axis).
fn frame(axis: Vector3<f64>, reference: Option<Vector3<f64>>) -> Option<Matrix3<f64>> {
    let across = |v: Vector3<f64>| {
        let rest = v - axis * axis.dot(&v);
        (rest.norm() > PARALLEL).then(|| rest.normalize())
    };
    let first = match reference {
        Some(given) => across(given)?,
        None => across(Vector3::x()).or_else(|| across(Vector3::y()))?,
    };
    Some(Matrix3::from_columns(&[first, axis.cross(&first), axis]))
}

/// A CARTESIAN_TRANSFORMATION_OPERATOR_3D as a rigid displacement.
///
/// # Errors
/// Where it is something else, scales, or mirrors: parts of a mechanism are rigid.
pub(crate) fn operator(instance: Instance<'_>, units: &Units) -> Result<Pose, StepError> {
    let whole = instance.leaf("CARTESIAN_TRANSFORMATION_OPERATOR_3D");
    let whole = whole.ok_or_else(|| instance.wrong_kind("CARTESIAN_TRANSFORMATION_OPERATOR_3D"))?;
    // Of several types at once, the first four of five parameters stand with the supertype.
    let count = whole.len();
    let (base, first, third) = match instance.leaf("CARTESIAN_TRANSFORMATION_OPERATOR") {
        Some(base) => (base, base.len().saturating_sub(4), 0),
        None => (whole, count.saturating_sub(5), count.saturating_sub(1)),
    };
    if !base.is_unset(first + 3) {
        let scale = base.number_at(first + 3)?;
        if !((scale - 1.0).abs() <= SCALE_DIGITS) {
            let found = format!("the scale {scale}: export the part in its true size");
            return Err(instance.geometry("a displacement without a scale", found));
        }
    }
    let origin = point(base.entity_at(first + 2)?, units)?;
    let x = optional_direction(base, first)?;
    let y = optional_direction(base, first + 1)?;
    let z = optional_direction(whole, third)?;
    let crossed = x.zip(y).map(|(x, y)| x.cross(&y));
    let axis = z.or(crossed).unwrap_or_else(Vector3::z);
    if axis.norm() <= PARALLEL {
        return Err(instance.geometry("two axes that are not parallel", "parallel ones"));
    }
    let axis = axis.normalize();
    let rotation = frame(axis, x);
    let rotation = rotation
        .ok_or_else(|| instance.geometry("two axes that are not parallel", "parallel ones"))?;
    if y.is_some_and(|y| y.dot(&rotation.column(1)) < 0.0) {
        return Err(instance.geometry(
            "a displacement",
            "a reflection: export the mirrored part as a part of its own",
        ));
    }
    Ok(Pose::new(rotation, origin))
}
