//! What a declaration says.

use super::parse::Recognition;
use std::fmt;

/// What a role is filled by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sort {
    /// A face.
    Face,
    /// An edge.
    Edge,
}

/// A place of a tuple.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Role {
    /// Its name.
    pub name: String,
    /// What fills it.
    pub sort: Sort,
}

/// A property of one face or edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// An edge that is straight.
    Straight,
    /// An edge that is a circle or an arc of one.
    Circular,
    /// A face that is flat.
    Planar,
    /// A face on a circular cylinder.
    Cylindrical,
    /// A face on a circular cone.
    Conical,
    /// A face on a sphere.
    Spherical,
    /// A face that goes all around its axis.
    Whole,
    /// A flat face without holes.
    Simple,
    /// A flat face with holes.
    Pierced,
}

impl Type {
    /// All types, in the order in which they are told.
    pub(super) const ALL: [Self; 9] = [
        Self::Straight,
        Self::Circular,
        Self::Planar,
        Self::Cylindrical,
        Self::Conical,
        Self::Spherical,
        Self::Whole,
        Self::Simple,
        Self::Pierced,
    ];
}

/// How material bends about an edge, or how a round face is curved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bend {
    /// It fills less than half of a turn; of a face, it is inside the curvature, as that of a pin.
    Convex,
    /// It fills more than half of a turn; of a face, it is outside the curvature, as that around a hole.
    Concave,
}

/// How two faces or edges lie to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    /// They are parallel.
    Parallel,
    /// They are at a right angle.
    Perpendicular,
    /// Faces in one plane with one normal.
    Coplanar,
    /// Parallel faces with air between: each is in front of the other.
    Facing,
    /// Parallel faces with material between: each is behind the other.
    Away,
    /// Round faces and circular edges on one axis; of a sphere its centre is on that axis.
    Coaxial,
    /// Cylinders, spheres and circles of one radius.
    EqualRadius,
    /// The first has the larger radius.
    Larger,
}

impl Orientation {
    /// All of them, in the order in which they are told.
    pub(super) const ALL: [Self; 8] = [
        Self::Parallel,
        Self::Perpendicular,
        Self::Coplanar,
        Self::Facing,
        Self::Away,
        Self::Coaxial,
        Self::EqualRadius,
        Self::Larger,
    ];

    /// Whether it is one of faces only.
    pub(super) fn is_of_faces(self) -> bool {
        matches!(self, Self::Coplanar | Self::Facing | Self::Away)
    }
}

/// Something that has to hold for a tuple. Roles are known by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// A face or an edge is of a type.
    Type(usize, Type),
    /// Two faces share an edge.
    Connected {
        /// The first face.
        first: usize,
        /// The second face.
        second: usize,
        /// The edge.
        edge: usize,
    },
    /// An edge or a round face is convex or concave.
    Bend(usize, Bend),
    /// Two faces or edges lie so to each other.
    Oriented(usize, usize, Orientation),
    /// Two axes or centres are as far from a third axis or centre.
    Equidistant {
        /// The first of the two.
        first: usize,
        /// The second.
        second: usize,
        /// The third.
        from: usize,
    },
}

/// A feature, and how to look for it.
#[derive(Clone, Debug)]
pub struct Declaration {
    /// Its name.
    pub name: String,
    /// Its roles, in the order of the text.
    pub roles: Vec<Role>,
    /// What has to hold, in the order of the text.
    pub conditions: Vec<Condition>,
    /// How its author looks for it.
    pub(super) recognition: Vec<Recognition>,
}

impl Condition {
    /// The roles that it is about.
    #[must_use]
    pub fn roles(&self) -> Vec<usize> {
        match *self {
            Self::Type(role, _) | Self::Bend(role, _) => vec![role],
            Self::Connected {
                first,
                second,
                edge,
            } => vec![first, second, edge],
            Self::Oriented(first, second, _) => vec![first, second],
            Self::Equidistant {
                first,
                second,
                from,
            } => vec![first, second, from],
        }
    }
}

impl Declaration {
    /// The name of a role.
    #[must_use]
    pub fn role_name(&self, role: usize) -> &str {
        self.roles.get(role).map_or("", |role| role.name.as_str())
    }

    /// A condition in words.
    #[must_use]
    pub fn condition_text(&self, condition: Condition) -> String {
        let name = |role: usize| self.role_name(role);
        match condition {
            Condition::Type(role, kind) => format!("{} {kind}", name(role)),
            Condition::Bend(edge, bend) => format!("{} {bend}", name(edge)),
            Condition::Connected {
                first,
                second,
                edge,
            } => format!("{} beside {} at {}", name(first), name(second), name(edge)),
            Condition::Oriented(first, second, Orientation::Larger) => {
                format!("{} larger than {}", name(first), name(second))
            }
            Condition::Oriented(first, second, Orientation::EqualRadius) => {
                format!("{} and {} of equal radius", name(first), name(second))
            }
            Condition::Oriented(first, second, orientation) => {
                format!("{} and {} {orientation}", name(first), name(second))
            }
            Condition::Equidistant {
                first,
                second,
                from,
            } => format!(
                "{} and {} equidistant from {}",
                name(first),
                name(second),
                name(from)
            ),
        }
    }
}

impl Type {
    /// What has this type.
    #[must_use]
    pub fn sort(self) -> Sort {
        match self {
            Self::Straight | Self::Circular => Sort::Edge,
            _ => Sort::Face,
        }
    }
}

impl fmt::Display for Sort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Face => "face",
            Self::Edge => "edge",
        })
    }
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Straight => "straight",
            Self::Circular => "circular",
            Self::Planar => "planar",
            Self::Cylindrical => "cylindrical",
            Self::Conical => "conical",
            Self::Spherical => "spherical",
            Self::Whole => "whole",
            Self::Simple => "simple",
            Self::Pierced => "pierced",
        })
    }
}

impl fmt::Display for Bend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Convex => "convex",
            Self::Concave => "concave",
        })
    }
}

impl fmt::Display for Orientation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Parallel => "parallel",
            Self::Perpendicular => "perpendicular",
            Self::Coplanar => "coplanar",
            Self::Facing => "facing",
            Self::Away => "away",
            Self::Coaxial => "coaxial",
            Self::EqualRadius => "equal_radius",
            Self::Larger => "larger",
        })
    }
}
