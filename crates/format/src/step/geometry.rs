//! What a joint needs of the geometry of its contacts.

use kutzbach_math::group::{DisplacementSubgroup, Pose};
use kutzbach_model::mechanism::JointKind;
use kutzbach_step::{Contact, ContactKind};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// The geometry of a joint, in the frame of the assembly (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Geometry {
    /// Nothing: it holds everything, or turns nothing.
    Free,
    /// A direction, or the normal of a plane.
    Direction(Vector3<f64>),
    /// An axis.
    Line {
        /// A point of it.
        point: Vector3<f64>,
        /// Its direction.
        direction: Vector3<f64>,
    },
    /// A centre.
    Point(Vector3<f64>),
    /// Two axes that meet: of the first and of the second part of a pair.
    Cross {
        /// Where they meet.
        point: Vector3<f64>,
        /// The direction of the first.
        first: Vector3<f64>,
        /// The direction of the second.
        second: Vector3<f64>,
    },
}

/// A joint that a pair is taken as.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Taken {
    pub kind: JointKind,
    pub geometry: Geometry,
    /// Metres per turn of screws.
    pub lead: Option<f64>,
}

impl Geometry {
    /// Its direction, normal, or the direction of its axis, of two the first.
    pub(super) fn direction(&self) -> Option<Vector3<f64>> {
        match self {
            Self::Direction(direction)
            | Self::Line { direction, .. }
            | Self::Cross {
                first: direction, ..
            } => Some(*direction),
            Self::Free | Self::Point(_) => None,
        }
    }

    /// A point of its axis or axes, or its centre.
    pub(super) fn point(&self) -> Option<Vector3<f64>> {
        match self {
            Self::Line { point, .. } | Self::Point(point) | Self::Cross { point, .. } => {
                Some(*point)
            }
            Self::Free | Self::Direction(_) => None,
        }
    }

    /// This geometry where `pose` moves it.
    pub(super) fn moved(&self, pose: &Pose) -> Self {
        match self {
            Self::Free => Self::Free,
            Self::Direction(direction) => Self::Direction(pose.transform_direction(direction)),
            Self::Line { point, direction } => Self::Line {
                point: pose.transform_point(point),
                direction: pose.transform_direction(direction),
            },
            Self::Point(point) => Self::Point(pose.transform_point(point)),
            Self::Cross {
                point,
                first,
                second,
            } => Self::Cross {
                point: pose.transform_point(point),
                first: pose.transform_direction(first),
                second: pose.transform_direction(second),
            },
        }
    }
}

/// The joint that lets exactly these displacements through: its kind, geometry and lead (m per turn). `None` where everything
/// may move.
pub(super) fn of_subgroup(
    subgroup: &DisplacementSubgroup,
) -> Option<(JointKind, Geometry, Option<f64>)> {
    use DisplacementSubgroup as D;
    let line = |axis: &kutzbach_math::group::Axis| Geometry::Line {
        point: axis.point,
        direction: axis.direction,
    };
    Some(match subgroup {
        D::Identity => (JointKind::Fixed, Geometry::Free, None),
        D::Rotation { axis } => (JointKind::Revolute, line(axis), None),
        D::Translation { direction } => {
            (JointKind::Prismatic, Geometry::Direction(*direction), None)
        }
        D::Helical { axis, pitch } => (JointKind::Screw, line(axis), Some(pitch * TAU)),
        D::Cylindrical { axis } => (JointKind::Cylindrical, line(axis), None),
        D::PlanarTranslation { normal } => (
            JointKind::PlanarTranslation,
            Geometry::Direction(*normal),
            None,
        ),
        D::Spherical { centre } => (JointKind::Spherical, Geometry::Point(*centre), None),
        D::Planar { normal } => (JointKind::Planar, Geometry::Direction(*normal), None),
        D::SpatialTranslation => (JointKind::Translational, Geometry::Free, None),
        D::TranslatingScrew { direction, pitch } => (
            JointKind::TranslatingScrew,
            Geometry::Direction(*direction),
            Some(pitch * TAU),
        ),
        D::Schoenflies { direction } => (
            JointKind::Schoenflies,
            Geometry::Direction(*direction),
            None,
        ),
        D::General => return None,
    })
}

/// The geometry of a joint of a kind that a person has named, from what the contacts leave or from one of them. `None` where
/// neither has an axis, a direction or a centre that could be meant.
pub(super) fn for_kind(
    kind: JointKind,
    found: Option<&DisplacementSubgroup>,
    contacts: &[Contact],
) -> Option<Geometry> {
    let found = found.and_then(of_subgroup);
    if let Some((own, geometry, _)) = found
        && own == kind
    {
        return Some(geometry);
    }
    let found = found.map(|(_, geometry, _)| geometry);
    let first = |kinds: &[ContactKind]| contacts.iter().find(|c| kinds.contains(&c.kind));
    let axis = || match found {
        Some(line @ Geometry::Line { .. }) => Some(line),
        _ => {
            let round = first(&[ContactKind::Cylindrical, ContactKind::Conical])?;
            Some(Geometry::Line {
                point: round.point,
                direction: round.axis,
            })
        }
    };
    let along = |geometry: Geometry| match geometry {
        Geometry::Line { direction, .. } | Geometry::Direction(direction) => {
            Some(Geometry::Direction(direction))
        }
        Geometry::Free | Geometry::Point(_) | Geometry::Cross { .. } => None,
    };
    let normal = || {
        let plane = first(&[ContactKind::Planar]).map(|c| Geometry::Direction(c.axis));
        plane.or_else(|| axis().and_then(along))
    };
    match kind {
        JointKind::Fixed | JointKind::Translational => Some(Geometry::Free),
        JointKind::Revolute | JointKind::Cylindrical | JointKind::Screw => axis(),
        JointKind::Prismatic => axis().and_then(along),
        JointKind::Planar
        | JointKind::PlanarTranslation
        | JointKind::TranslatingScrew
        | JointKind::Schoenflies => normal(),
        JointKind::Spherical => {
            let ball = first(&[ContactKind::Spherical])?;
            Some(Geometry::Point(ball.point))
        }
        JointKind::Universal
        | JointKind::PointOnLine
        | JointKind::LineOnPlane
        | JointKind::PointOnPlane
        | JointKind::Distance => None,
    }
}

/// What such a geometry is called where it is missing.
pub(super) fn needed_by(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Spherical => "a ball in a socket",
        JointKind::Planar
        | JointKind::PlanarTranslation
        | JointKind::TranslatingScrew
        | JointKind::Schoenflies => "a plane on a plane, or a round face in another",
        _ => "a round face in another, whose axis it takes",
    }
}
