//! The twelve classes of connected displacement subgroups, with their geometry.

use std::fmt;

use nalgebra::{Matrix3, Vector3};

use super::GroupError;
use super::pose::Pose;
use super::twist::Twist;

/// A line in space, in a form that depends on the line only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The point of the line nearest the world's origin (m).
    pub point: Vector3<f64>,
    /// Unit direction, signed as by [`normalised_direction`].
    pub direction: Vector3<f64>,
}

impl Axis {
    /// The line through `point` (m) along `direction`; `None` where the direction is zero or not finite.
    pub fn through(point: Vector3<f64>, direction: Vector3<f64>) -> Option<Self> {
        let direction = normalised_direction(direction)?;
        Some(Self {
            point: point - direction * direction.dot(&point),
            direction,
        })
    }
}

/// The unit vector along `direction`, with the sign that makes its first component positive that is not
/// negligible (above 10⁻⁹, so that rounding in a zero component decides nothing). `None` where the direction is
/// zero or not finite.
pub fn normalised_direction(direction: Vector3<f64>) -> Option<Vector3<f64>> {
    let largest = direction.amax();
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let unit = (direction / largest).normalize();
    let first = unit.iter().find(|x| x.abs() > 1e-9)?;
    // Adding zero turns −0 into 0.
    Some((unit * first.signum()).map(|x| x + 0.0))
}

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

/// A connected subgroup of SE(3): its class with its geometry in world coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DisplacementSubgroup {
    /// E: no displacement.
    Identity,
    /// R: rotations about `axis`.
    Rotation {
        /// The axis of rotation.
        axis: Axis,
    },
    /// T: translations along `direction`.
    Translation {
        /// Unit direction.
        direction: Vector3<f64>,
    },
    /// H: screws about `axis`.
    Helical {
        /// The screw axis.
        axis: Axis,
        /// Pitch (m per radian), right-handed positive, not zero.
        pitch: f64,
    },
    /// C: rotations about and translations along `axis`.
    Cylindrical {
        /// The common axis.
        axis: Axis,
    },
    /// T2: translations parallel to a plane.
    PlanarTranslation {
        /// Unit normal of the plane.
        normal: Vector3<f64>,
    },
    /// S: rotations about `centre`.
    Spherical {
        /// The fixed point (m).
        centre: Vector3<f64>,
    },
    /// G: planar motions.
    Planar {
        /// Unit normal of the plane.
        normal: Vector3<f64>,
    },
    /// T3: all translations.
    SpatialTranslation,
    /// Y: translations normal to `direction` and screws along it.
    TranslatingScrew {
        /// Unit direction of the screws.
        direction: Vector3<f64>,
        /// Pitch (m per radian), right-handed positive, not zero.
        pitch: f64,
    },
    /// X: all translations and rotations about `direction`.
    Schoenflies {
        /// Unit direction of the rotations.
        direction: Vector3<f64>,
    },
    /// D: all displacements.
    General,
}

impl DisplacementSubgroup {
    /// The class without the geometry.
    pub fn kind(&self) -> SubgroupKind {
        match self {
            Self::Identity => SubgroupKind::Identity,
            Self::Rotation { .. } => SubgroupKind::Rotation,
            Self::Translation { .. } => SubgroupKind::Translation,
            Self::Helical { .. } => SubgroupKind::Helical,
            Self::Cylindrical { .. } => SubgroupKind::Cylindrical,
            Self::PlanarTranslation { .. } => SubgroupKind::PlanarTranslation,
            Self::Spherical { .. } => SubgroupKind::Spherical,
            Self::Planar { .. } => SubgroupKind::Planar,
            Self::SpatialTranslation => SubgroupKind::SpatialTranslation,
            Self::TranslatingScrew { .. } => SubgroupKind::TranslatingScrew,
            Self::Schoenflies { .. } => SubgroupKind::Schoenflies,
            Self::General => SubgroupKind::General,
        }
    }

    /// Dimension of the subgroup.
    pub fn dimension(&self) -> usize {
        self.kind().dimension()
    }

    /// Hervé's letter: E R T H C T2 S G T3 Y X D.
    pub fn short_name(&self) -> &'static str {
        self.kind().short_name()
    }

    /// Pitch (m per radian) of H and Y; zero for all others.
    pub fn pitch(&self) -> f64 {
        match self {
            Self::Helical { pitch, .. } | Self::TranslatingScrew { pitch, .. } => *pitch,
            _ => 0.0,
        }
    }

    /// The frame in which this subgroup has its canonical form: x along its axis, direction or normal, origin
    /// at its axis point or centre, otherwise at the world's origin. Where the class has no direction
    /// the axes are the world's; y and z about x are chosen by a fixed rule.
    pub fn world_from_canonical(&self) -> Pose {
        let (direction, origin) = match *self {
            Self::Rotation { axis } | Self::Cylindrical { axis } | Self::Helical { axis, .. } => {
                (axis.direction, axis.point)
            }
            Self::Translation { direction }
            | Self::TranslatingScrew { direction, .. }
            | Self::Schoenflies { direction } => (direction, Vector3::zeros()),
            Self::PlanarTranslation { normal } | Self::Planar { normal } => {
                (normal, Vector3::zeros())
            }
            Self::Spherical { centre } => (Vector3::x(), centre),
            Self::Identity | Self::SpatialTranslation | Self::General => {
                (Vector3::x(), Vector3::zeros())
            }
        };
        Pose::new(frame_along(direction), origin)
    }

    /// A basis of the algebra as world twists, in the order of the coordinates of
    /// [`SubgroupKind::canonical_displacement`], each the derivative by that coordinate at the identity.
    pub fn algebra(&self) -> Vec<Twist> {
        let origin = Vector3::zeros();
        let shift = |axis: usize| Twist::prismatic(Vector3::ith(axis, 1.0));
        let turn = |axis: usize| Twist::revolute(Vector3::ith(axis, 1.0), origin);
        let screw = Twist::helical(Vector3::x(), origin, self.pitch());
        let canonical = match self.kind() {
            SubgroupKind::Identity => vec![],
            SubgroupKind::Rotation | SubgroupKind::Helical => vec![screw],
            SubgroupKind::Translation => vec![shift(0)],
            SubgroupKind::Cylindrical => vec![shift(0), turn(0)],
            SubgroupKind::PlanarTranslation => vec![shift(1), shift(2)],
            SubgroupKind::Spherical => vec![turn(0), turn(1), turn(2)],
            SubgroupKind::Planar | SubgroupKind::TranslatingScrew => {
                vec![shift(1), shift(2), screw]
            }
            SubgroupKind::SpatialTranslation => vec![shift(0), shift(1), shift(2)],
            SubgroupKind::Schoenflies => vec![shift(0), shift(1), shift(2), turn(0)],
            SubgroupKind::General => {
                vec![shift(0), shift(1), shift(2), turn(0), turn(1), turn(2)]
            }
        };
        let world_from_canonical = self.world_from_canonical();
        canonical
            .iter()
            .map(|t| world_from_canonical.transform_twist(t))
            .collect()
    }

    /// The conjugate subgroup F·G·F⁻¹: the same motions of a mechanism moved as a whole by `pose`.
    pub fn conjugated_by(&self, pose: &Pose) -> Self {
        let turned = |d: Vector3<f64>| {
            let d = pose.transform_direction(&d);
            // A rotation keeps unit vectors nonzero; the fallback is never taken for a true pose.
            normalised_direction(d).unwrap_or(d)
        };
        let moved = |axis: Axis| {
            let direction = turned(axis.direction);
            let point = pose.transform_point(&axis.point);
            Axis {
                point: point - direction * direction.dot(&point),
                direction,
            }
        };
        match *self {
            Self::Rotation { axis } => Self::Rotation { axis: moved(axis) },
            Self::Translation { direction } => Self::Translation {
                direction: turned(direction),
            },
            Self::Helical { axis, pitch } => Self::Helical {
                axis: moved(axis),
                pitch,
            },
            Self::Cylindrical { axis } => Self::Cylindrical { axis: moved(axis) },
            Self::PlanarTranslation { normal } => Self::PlanarTranslation {
                normal: turned(normal),
            },
            Self::Spherical { centre } => Self::Spherical {
                centre: pose.transform_point(&centre),
            },
            Self::Planar { normal } => Self::Planar {
                normal: turned(normal),
            },
            Self::TranslatingScrew { direction, pitch } => Self::TranslatingScrew {
                direction: turned(direction),
                pitch,
            },
            Self::Schoenflies { direction } => Self::Schoenflies {
                direction: turned(direction),
            },
            Self::Identity | Self::SpatialTranslation | Self::General => *self,
        }
    }

    /// The displacement of this subgroup with the given canonical coordinates, in world coordinates:
    /// F·canonical·F⁻¹ with F = [`DisplacementSubgroup::world_from_canonical`].
    ///
    /// # Errors
    /// [`GroupError::WrongCoordinateCount`].
    pub fn displacement(&self, coordinates: &[f64]) -> Result<Pose, GroupError> {
        let frame = self.world_from_canonical();
        let canonical = self
            .kind()
            .canonical_displacement(coordinates, self.pitch())?;
        Ok(frame * canonical * frame.inverse())
    }
}

/// A rotation whose first column is the unit vector `x`; the identity for x = (1, 0, 0).
fn frame_along(x: Vector3<f64>) -> Matrix3<f64> {
    // Start from the world axis following the largest component: it is far from parallel to x, and
    // exact directions give exact frames.
    let follower = Vector3::ith((x.iamax() + 1) % 3, 1.0);
    let y = (follower - x * x.dot(&follower)).normalize();
    Matrix3::from_columns(&[x, y, x.cross(&y)])
}

/// In words for engineers, such as `planar motion normal to (0, 0, 1)`. Six significant digits.
impl fmt::Display for DisplacementSubgroup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Identity => write!(f, "no motion"),
            Self::Rotation { axis } => write!(f, "rotation about {}", line(axis)),
            Self::Translation { direction } => {
                write!(f, "translation along {}", figures(direction))
            }
            Self::Helical { axis, pitch } => write!(
                f,
                "screw motion with pitch {} m/rad about {}",
                figure(*pitch),
                line(axis)
            ),
            Self::Cylindrical { axis } => {
                write!(f, "rotation about and translation along {}", line(axis))
            }
            Self::PlanarTranslation { normal } => {
                write!(f, "translation in the plane normal to {}", figures(normal))
            }
            Self::Spherical { centre } => {
                write!(f, "rotation about the point {}", figures(centre))
            }
            Self::Planar { normal } => write!(f, "planar motion normal to {}", figures(normal)),
            Self::SpatialTranslation => write!(f, "translation in every direction"),
            Self::TranslatingScrew { direction, pitch } => write!(
                f,
                "translation in the plane normal to {} with screw motion of pitch {} m/rad along it",
                figures(direction),
                figure(*pitch)
            ),
            Self::Schoenflies { direction } => write!(
                f,
                "translation in every direction and rotation about {}",
                figures(direction)
            ),
            Self::General => write!(f, "unrestricted motion"),
        }
    }
}

fn line(axis: &Axis) -> String {
    let (direction, point) = (figures(&axis.direction), figures(&axis.point));
    format!("the axis along {direction} through {point}")
}

/// A vector to six significant digits of its largest component.
fn figures(v: &Vector3<f64>) -> String {
    let digits = decimals(v.amax());
    let [x, y, z] = [v.x, v.y, v.z].map(|x| rounded(x, digits));
    format!("({x}, {y}, {z})")
}

fn figure(x: f64) -> String {
    rounded(x, decimals(x.abs()))
}

/// Decimals that show six significant digits of a number of this size.
fn decimals(size: f64) -> usize {
    if size > 0.0 && size.is_finite() {
        // Clamped to what f64 can hold anyway.
        (5 - size.log10().floor() as i32).clamp(0, 300) as usize
    } else {
        0
    }
}

fn rounded(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    let is_zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero { "0" } else { text }.to_string()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::group::herve_tables::one_of_each;

    #[test]
    fn names_are_those_of_herve() {
        let names = SubgroupKind::ALL.map(SubgroupKind::short_name);
        assert_eq!(
            names,
            ["E", "R", "T", "H", "C", "T2", "S", "G", "T3", "Y", "X", "D"]
        );
        for (g, kind) in one_of_each().iter().zip(SubgroupKind::ALL) {
            assert_eq!(g.kind(), kind);
            assert_eq!(g.algebra().len(), kind.dimension());
        }
    }

    #[test]
    fn directions_get_one_sign() {
        let d = normalised_direction(Vector3::new(1e-12, -2.0, 0.0)).unwrap();
        assert!((d - Vector3::y()).norm() < 1e-11);
        assert_eq!(normalised_direction(Vector3::zeros()), None);
        assert_eq!(normalised_direction(Vector3::new(f64::NAN, 1.0, 0.0)), None);
    }

    #[test]
    fn algebra_is_the_derivative_of_the_displacement() {
        let h = 1e-5;
        for g in one_of_each() {
            for (i, twist) in g.algebra().iter().enumerate() {
                let at = |t: f64| {
                    let mut c = vec![0.0; g.dimension()];
                    c[i] = t;
                    g.displacement(&c).unwrap().log()
                };
                let difference = (at(h) - at(-h)) * (0.5 / h) - *twist;
                assert!(difference.to_vector().norm() < 1e-9, "{g}");
            }
        }
    }

    #[test]
    fn displacements_compose_within_the_subgroup() {
        // log of a product must lie in the algebra again; the product is far from the identity.
        let gauge = crate::group::Gauge::new(Vector3::zeros(), 1.0, 1e-9).unwrap();
        for g in one_of_each() {
            let system = crate::group::ScrewSystem::span(&g.algebra(), &gauge).unwrap();
            let n = g.dimension();
            let a: Vec<_> = (0..n).map(|i| 0.7 - 0.4 * i as f64).collect();
            let b: Vec<_> = (0..n).map(|i| 0.3 + 0.2 * i as f64).collect();
            let product = g.displacement(&a).unwrap() * g.displacement(&b).unwrap();
            assert!(system.contains(&product.log()), "{g}");
            let quotient = g.displacement(&a).unwrap().inverse();
            assert!(system.contains(&quotient.log()), "{g}");
        }
    }

    #[test]
    fn wrong_coordinate_counts_are_named() {
        let error = SubgroupKind::Planar.canonical_displacement(&[1.0], 0.0);
        let expected = "class G takes 3 coordinates, found 1";
        assert_eq!(error.unwrap_err().to_string(), expected);
    }

    #[test]
    fn words_for_engineers() {
        let words: Vec<_> = one_of_each().iter().map(|g| g.to_string()).collect();
        assert_eq!(words[0], "no motion");
        assert_eq!(
            words[1],
            "rotation about the axis along (0, 0, 1) through (1, 2, 0)"
        );
        assert_eq!(words[7], "planar motion normal to (0, 0, 1)");
        assert_eq!(
            words[9],
            "translation in the plane normal to (0, 0, 1) with screw motion of pitch 0.5 m/rad along it"
        );
        let centre = Vector3::new(1.0 / 3.0, -1e-17, 1200.5);
        let sphere = DisplacementSubgroup::Spherical { centre };
        assert_eq!(
            sphere.to_string(),
            "rotation about the point (0.33, 0, 1200.5)"
        );
    }
}
