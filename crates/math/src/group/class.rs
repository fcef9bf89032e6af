//! The twelve classes of connected displacement subgroups, with their geometry.

use nalgebra::{Matrix3, Vector3};

use super::GroupError;
use super::axis::{Axis, normalised_direction};
use super::kind::SubgroupKind;
use super::pose::Pose;
use super::twist::Twist;

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
}
