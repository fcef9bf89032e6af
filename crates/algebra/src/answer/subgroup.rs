//! The smallest displacement subgroup that holds all displacements of one link relative to another, exactly.
//!
//! Whether R n = n, n·t = 0 or R c + t = c holds on all solutions is a matter of normal forms, and which n and c these are
//! of linear equations (see [`RelativeDisplacement`]). What is found so follows from the equations. Where they are not
//! radical a smaller subgroup may hold as well; it is then not found, never wrongly claimed. Screws are not looked for:
//! how far a screw goes by an angle is no algebraic relation.

use crate::Stop;
use crate::system::{ExactVector, Reduce, RelativeDisplacement};
use kutzbach_math::group::{Axis, DisplacementSubgroup, normalised_direction};
use nalgebra::Vector3;

/// A subgroup with its direction, where it has one, kept exact.
pub(super) struct Held {
    pub(super) subgroup: DisplacementSubgroup,
    /// Of the axis, the translation, the normal.
    pub(super) direction: Option<ExactVector>,
}

/// The smallest subgroup that holds a displacement on the zeros of the ideals that `reduce` stands for.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub(super) fn smallest_subgroup(
    displacement: &RelativeDisplacement<'_>,
    reduce: &Reduce<'_>,
) -> Result<Held, Stop> {
    let doubles = |v: &ExactVector| Vector3::from(displacement.approximate(v));
    let unit = |v: &ExactVector| {
        let v = doubles(v);
        // An exact direction is not zero, and of the size of the mechanism's numbers.
        normalised_direction(v).unwrap_or(v)
    };
    let with = |subgroup, direction| {
        Ok(Held {
            subgroup,
            direction,
        })
    };
    let mut fixed = displacement.fixed_directions(reduce)?;
    if fixed.len() >= 2 {
        // A rotation that keeps two directions is none.
        let mut across = displacement.directions_across(reduce)?;
        return match (across.pop(), across.pop(), across.pop()) {
            (Some(_), Some(_), Some(_)) => with(DisplacementSubgroup::Identity, None),
            (Some(a), Some(b), None) => {
                let along = displacement.across_both(&a, &b);
                let direction = unit(&along);
                with(DisplacementSubgroup::Translation { direction }, Some(along))
            }
            (Some(normal), ..) => with(
                DisplacementSubgroup::PlanarTranslation {
                    normal: unit(&normal),
                },
                Some(normal),
            ),
            _ => with(DisplacementSubgroup::SpatialTranslation, None),
        };
    }
    let Some(direction) = fixed.pop() else {
        return match displacement.fixed_point(reduce)? {
            Some(centre) => with(
                DisplacementSubgroup::Spherical {
                    centre: doubles(&centre),
                },
                None,
            ),
            None => with(DisplacementSubgroup::General, None),
        };
    };
    let along = unit(&direction);
    let axis = |point: &ExactVector| Axis {
        point: doubles(point) - along * along.dot(&doubles(point)),
        direction: along,
    };
    let subgroup = if let Some(point) = displacement.fixed_point(reduce)? {
        DisplacementSubgroup::Rotation { axis: axis(&point) }
    } else if displacement.is_across(&direction, reduce)? {
        DisplacementSubgroup::Planar { normal: along }
    } else if let Some(point) = displacement.point_of_axis(&direction, reduce)? {
        DisplacementSubgroup::Cylindrical { axis: axis(&point) }
    } else {
        DisplacementSubgroup::Schoenflies { direction: along }
    };
    with(subgroup, Some(direction))
}
