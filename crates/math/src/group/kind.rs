//! Names, dimensions and canonical displacements of the twelve classes of displacement subgroups.

use nalgebra::Vector3;

use super::GroupError;
use super::pose::Pose;
use super::twist::Twist;

/// The class of a connected subgroup of SE(3), without its geometry (Hervé 1978).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SubgroupKind {
    /// E: no displacement.
    Identity,
    /// R: rotations about an axis.
    Rotation,
    /// T: translations along a direction.
    Translation,
    /// H: screws about an axis with one pitch.
    Helical,
    /// C: rotations about and translations along an axis.
    Cylindrical,
    /// T2: translations parallel to a plane.
    PlanarTranslation,
    /// S: rotations about a point.
    Spherical,
    /// G: motions of a plane in itself.
    Planar,
    /// T3: all translations.
    SpatialTranslation,
    /// Y: translations parallel to a plane and screws of one pitch normal to it.
    TranslatingScrew,
    /// X: all translations and rotations about one direction (Schoenflies).
    Schoenflies,
    /// D: all displacements.
    General,
}

impl SubgroupKind {
    /// All classes, by dimension.
    pub const ALL: [Self; 12] = [
        Self::Identity,
        Self::Rotation,
        Self::Translation,
        Self::Helical,
        Self::Cylindrical,
        Self::PlanarTranslation,
        Self::Spherical,
        Self::Planar,
        Self::SpatialTranslation,
        Self::TranslatingScrew,
        Self::Schoenflies,
        Self::General,
    ];

    /// Hervé's letter: E R T H C T2 S G T3 Y X D.
    pub fn short_name(self) -> &'static str {
        match self {
            Self::Identity => "E",
            Self::Rotation => "R",
            Self::Translation => "T",
            Self::Helical => "H",
            Self::Cylindrical => "C",
            Self::PlanarTranslation => "T2",
            Self::Spherical => "S",
            Self::Planar => "G",
            Self::SpatialTranslation => "T3",
            Self::TranslatingScrew => "Y",
            Self::Schoenflies => "X",
            Self::General => "D",
        }
    }

    /// Dimension of the subgroups of this class.
    pub fn dimension(self) -> usize {
        self.rotations() + self.translations()
    }

    /// Dimension of the rotational part: of the image in SO(3).
    pub fn rotations(self) -> usize {
        match self {
            Self::Identity
            | Self::Translation
            | Self::PlanarTranslation
            | Self::SpatialTranslation => 0,
            Self::Spherical | Self::General => 3,
            _ => 1,
        }
    }

    /// Dimension of the subgroup of pure translations.
    pub fn translations(self) -> usize {
        match self {
            Self::Identity | Self::Rotation | Self::Helical | Self::Spherical => 0,
            Self::Translation | Self::Cylindrical => 1,
            Self::PlanarTranslation | Self::Planar | Self::TranslatingScrew => 2,
            Self::SpatialTranslation | Self::Schoenflies | Self::General => 3,
        }
    }

    /// Displacement of the canonical subgroup of this class: x along the axis, direction or plane normal,
    /// origin on the axis or at the centre.
    ///
    /// With p the pitch (m per radian; only H and Y use it), lengths in m, angles in rad:
    ///
    /// | class | coordinates | displacement |
    /// |---|---|---|
    /// | E | – | identity |
    /// | R | θ | twix(θ) |
    /// | T | x | trans(x, 0, 0) |
    /// | H | θ | trans(pθ, 0, 0) twix(θ) |
    /// | C | x, θ | trans(x, 0, 0) twix(θ) |
    /// | T2 | y, z | trans(0, y, z) |
    /// | S | a, b, c | exp of the rotation vector (a, b, c) |
    /// | G | y, z, θ | trans(0, y, z) twix(θ) |
    /// | T3 | x, y, z | trans(x, y, z) |
    /// | Y | y, z, θ | trans(pθ, y, z) twix(θ) |
    /// | X | x, y, z, θ | trans(x, y, z) twix(θ) |
    /// | D | x, y, z, a, b, c | trans(x, y, z) exp of the rotation vector (a, b, c) |
    ///
    /// Hervé gives S by three successive rotations; a rotation vector covers the same group and is regular at
    /// the identity. Some authors count pitch in radians per metre, writing trans(x, 0, 0) twix(px) for H.
    ///
    /// # Errors
    /// [`GroupError::WrongCoordinateCount`].
    pub fn canonical_displacement(
        self,
        coordinates: &[f64],
        pitch: f64,
    ) -> Result<Pose, GroupError> {
        let turned = |x: f64, y: f64, z: f64, angle: f64| Pose {
            translation: Vector3::new(x, y, z),
            ..Pose::rotation_about(Vector3::x(), angle)
        };
        let ball = |v: Vector3<f64>| Pose::exp(&Twist::new(v, Vector3::zeros()));
        Ok(match (self, coordinates) {
            (Self::Identity, []) => Pose::identity(),
            (Self::Rotation, &[angle]) => turned(0.0, 0.0, 0.0, angle),
            (Self::Translation, &[x]) => turned(x, 0.0, 0.0, 0.0),
            (Self::Helical, &[angle]) => turned(pitch * angle, 0.0, 0.0, angle),
            (Self::Cylindrical, &[x, angle]) => turned(x, 0.0, 0.0, angle),
            (Self::PlanarTranslation, &[y, z]) => turned(0.0, y, z, 0.0),
            (Self::Spherical, &[a, b, c]) => ball(Vector3::new(a, b, c)),
            (Self::Planar, &[y, z, angle]) => turned(0.0, y, z, angle),
            (Self::SpatialTranslation, &[x, y, z]) => turned(x, y, z, 0.0),
            (Self::TranslatingScrew, &[y, z, angle]) => turned(pitch * angle, y, z, angle),
            (Self::Schoenflies, &[x, y, z, angle]) => turned(x, y, z, angle),
            (Self::General, &[x, y, z, a, b, c]) => {
                Pose::translation(Vector3::new(x, y, z)) * ball(Vector3::new(a, b, c))
            }
            _ => {
                return Err(GroupError::WrongCoordinateCount {
                    class: self.short_name(),
                    needed: self.dimension(),
                    found: coordinates.len(),
                });
            }
        })
    }
}
