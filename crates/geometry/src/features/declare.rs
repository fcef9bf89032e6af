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
    /// An edge that is straight: all are.
    Straight,
    /// A face that is flat: all are.
    Planar,
    /// A face without holes.
    Simple,
    /// A face with holes.
    Pierced,
}

/// How material bends about an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bend {
    /// It fills less than half of a turn.
    Convex,
    /// It fills more than half of a turn.
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
    /// An edge is convex or concave.
    Bend(usize, Bend),
    /// Two faces or edges lie so to each other.
    Oriented(usize, usize, Orientation),
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
            Condition::Oriented(first, second, orientation) => {
                format!("{} and {} {orientation}", name(first), name(second))
            }
        }
    }
}

impl Type {
    /// What has this type.
    #[must_use]
    pub fn sort(self) -> Sort {
        match self {
            Self::Straight => Sort::Edge,
            Self::Planar | Self::Simple | Self::Pierced => Sort::Face,
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
            Self::Planar => "planar",
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
        })
    }
}
