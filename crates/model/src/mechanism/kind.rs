//! The joint classes: what a joint lets its two links do.

use serde::Serialize;
use std::fmt;

/// The kind of a joint, by the set of relative displacements that it allows (Hervé 1978, and the contact pairs of Ruiz 1994).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// E: no relative motion.
    Fixed,
    /// R: rotation about an axis.
    Revolute,
    /// T(u): translation along a direction.
    Prismatic,
    /// H: screw motion with a fixed lead.
    Screw,
    /// C: rotation about and translation along one axis.
    Cylindrical,
    /// Two rotations about intersecting axes, the first fixed in the predecessor, the second in the successor.
    Universal,
    /// T2: translations parallel to a plane.
    PlanarTranslation,
    /// G: planar motion, two translations and one rotation.
    Planar,
    /// S: rotations about a point.
    Spherical,
    /// T: all translations.
    Translational,
    /// Y: translations of a plane together with a screw normal to it.
    TranslatingScrew,
    /// X: all translations and a rotation about a fixed direction.
    Schoenflies,
    /// A point of the predecessor stays on a line of the successor.
    PointOnLine,
    /// A line of the predecessor stays in a plane of the successor.
    LineOnPlane,
    /// A point of the predecessor stays in a plane of the successor.
    PointOnPlane,
    /// A point of the predecessor keeps its distance from a point of the successor.
    Distance,
}

/// What one freedom of a joint does: names the part of a joint that is locked while another part moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FreedomPart {
    /// A rotation.
    Rotation,
    /// A translation.
    Translation,
    /// A rotation and a translation tied together.
    Screw,
}

impl FreedomPart {
    /// The suffix in names such as `slider.rot`.
    #[must_use]
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Rotation => "rot",
            Self::Translation => "trans",
            Self::Screw => "screw",
        }
    }
}

impl JointKind {
    /// Every kind, in the order of the format's table.
    pub const ALL: [Self; 16] = [
        Self::Fixed,
        Self::Revolute,
        Self::Prismatic,
        Self::Screw,
        Self::Cylindrical,
        Self::Universal,
        Self::PlanarTranslation,
        Self::Planar,
        Self::Spherical,
        Self::Translational,
        Self::TranslatingScrew,
        Self::Schoenflies,
        Self::PointOnLine,
        Self::LineOnPlane,
        Self::PointOnPlane,
        Self::Distance,
    ];

    /// The kind's own word in a file.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Revolute => "revolute",
            Self::Prismatic => "prismatic",
            Self::Screw => "screw",
            Self::Cylindrical => "cylindrical",
            Self::Universal => "universal",
            Self::PlanarTranslation => "planar_translation",
            Self::Planar => "planar",
            Self::Spherical => "spherical",
            Self::Translational => "translational",
            Self::TranslatingScrew => "translating_screw",
            Self::Schoenflies => "schoenflies",
            Self::PointOnLine => "point_on_line",
            Self::LineOnPlane => "line_on_plane",
            Self::PointOnPlane => "point_on_plane",
            Self::Distance => "distance",
        }
    }

    /// The kind that a word in a file names, its synonyms included (`continuous`, `line_on_line`, `plane_on_plane`,
    /// `point_on_point`). `floating` is not a kind: it constrains nothing.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        match word {
            "continuous" => Some(Self::Revolute),
            "line_on_line" => Some(Self::Cylindrical),
            "plane_on_plane" => Some(Self::Planar),
            "point_on_point" => Some(Self::Spherical),
            _ => Self::ALL.into_iter().find(|kind| kind.word() == word),
        }
    }

    /// The short class name used in tables: Hervé's letter where the displacements form a subgroup.
    #[must_use]
    pub fn class(self) -> &'static str {
        match self {
            Self::Fixed => "E",
            Self::Revolute => "R",
            Self::Prismatic => "P",
            Self::Screw => "H",
            Self::Cylindrical => "C",
            Self::Universal => "U",
            Self::PlanarTranslation => "T2",
            Self::Planar => "G",
            Self::Spherical => "S",
            Self::Translational => "T3",
            Self::TranslatingScrew => "Y",
            Self::Schoenflies => "X",
            Self::PointOnLine => "T·S",
            Self::LineOnPlane => "R·G",
            Self::PointOnPlane => "T2·S",
            Self::Distance => "S·S",
        }
    }

    /// What each freedom does, in the order of the joint's variables.
    ///
    /// The order follows the canonical displacement: translations before the rotation they share an axis with; for
    /// `point_on_line` and `point_on_plane` the rotations first, for `line_on_plane` the rotation about the line, the two
    /// translations, the rotation about the plane's normal; for `distance` the two swings of the connecting direction,
    /// then the three rotations of the successor.
    #[must_use]
    pub fn freedoms(self) -> &'static [FreedomPart] {
        use FreedomPart::{Rotation as R, Screw as H, Translation as P};
        match self {
            Self::Fixed => &[],
            Self::Revolute => &[R],
            Self::Prismatic => &[P],
            Self::Screw => &[H],
            Self::Cylindrical => &[P, R],
            Self::Universal => &[R, R],
            Self::PlanarTranslation => &[P, P],
            Self::Planar => &[P, P, R],
            Self::Spherical => &[R, R, R],
            Self::Translational => &[P, P, P],
            Self::TranslatingScrew => &[P, P, H],
            Self::Schoenflies => &[P, P, P, R],
            Self::PointOnLine => &[R, R, R, P],
            Self::LineOnPlane => &[R, P, P, R],
            Self::PointOnPlane => &[R, R, R, P, P],
            Self::Distance => &[R, R, R, R, R],
        }
    }

    /// The number of freedoms, 0 to 5.
    #[must_use]
    pub fn freedom(self) -> usize {
        self.freedoms().len()
    }

    /// Whether the kind reads `axis`.
    #[must_use]
    pub fn uses_axis(self) -> bool {
        !matches!(
            self,
            Self::Fixed
                | Self::Spherical
                | Self::Translational
                | Self::PointOnLine
                | Self::PointOnPlane
                | Self::Distance
        )
    }

    /// Whether the kind reads `axis2`.
    #[must_use]
    pub fn uses_second_axis(self) -> bool {
        matches!(
            self,
            Self::Universal | Self::PointOnLine | Self::LineOnPlane | Self::PointOnPlane
        )
    }

    /// Whether the kind needs a screw lead.
    #[must_use]
    pub fn uses_lead(self) -> bool {
        matches!(self, Self::Screw | Self::TranslatingScrew)
    }

    /// Whether the allowed displacements form a subgroup of SE(3) (Hervé 1978).
    #[must_use]
    pub fn is_subgroup(self) -> bool {
        !matches!(
            self,
            Self::Universal
                | Self::PointOnLine
                | Self::LineOnPlane
                | Self::PointOnPlane
                | Self::Distance
        )
    }
}

impl fmt::Display for JointKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn every_word_names_its_kind() {
        for kind in JointKind::ALL {
            assert_eq!(JointKind::from_word(kind.word()).unwrap(), kind);
            assert!(
                kind.freedom() <= 5,
                "a joint of six freedoms is no constraint"
            );
        }
        assert_eq!(
            JointKind::from_word("continuous").unwrap(),
            JointKind::Revolute
        );
        assert!(JointKind::from_word("floating").is_none());
    }
}
