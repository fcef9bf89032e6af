//! From a linear space of twists to the class and the geometry of the subgroup it generates.

use nalgebra::{Matrix3, Vector3, Vector6};

use super::GroupError;
use super::class::{Axis, DisplacementSubgroup, normalised_direction};
use super::decomposition::{Decomposition, Margin, ROUNDING};
use super::system::ScrewSystem;

/// What [`classify`] found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Classification {
    /// The subgroup; `None` where the space is not closed under the bracket.
    pub subgroup: Option<DisplacementSubgroup>,
    /// Dimension of the rotational part: rank of the angular velocities in the space.
    pub rotations: usize,
    /// Dimension of the pure translations in the space.
    pub translations: usize,
    /// Worst margin of all decisions, those behind the space included.
    pub margin: Margin,
}

/// Recognises a displacement subgroup by invariants of its algebra.
///
/// Once the space is known to be closed under the bracket, the dimension and the rank r of the angular
/// velocities leave one class, or two that differ by whether a pitch vanishes:
///
/// | dimension | r | class |
/// |---|---|---|
/// | 0 | 0 | E |
/// | 1 | 0 / 1 | T / R or H |
/// | 2 | 0 / 1 | T2 / C |
/// | 3 | 0 / 1 / 3 | T3 / G or Y / S |
/// | 4 | 1 | X |
/// | 6 | 3 | D |
///
/// No other pair belongs to a subalgebra (Hervé 1978): the translations form an ideal that every
/// rotation of the group maps to itself, and so(3) leaves only {0} and R³.
///
/// Tolerances: the angular parts of an orthonormal basis wrong by δ have singular values wrong by at most
/// δ. For the pitch see the body of this file.
///
/// # Errors
/// [`GroupError::NoConvergence`].
pub fn classify(system: &ScrewSystem) -> Result<Classification, GroupError> {
    let dimension = system.dimension();
    let angular = Decomposition::of(3, dimension, true, |i, j| system.basis[j][i])?;
    let (rotations, decision) = Margin::decide(&angular.values, system.uncertainty + ROUNDING);
    let (closed, closing) = system.is_closed()?;
    let mut result = Classification {
        subgroup: None,
        rotations,
        translations: dimension - rotations,
        margin: closing.and(decision),
    };
    if !closed {
        return Ok(result);
    }
    let parts = Parts { system, angular };
    result.subgroup = match (dimension, rotations) {
        (0, 0) => Some(DisplacementSubgroup::Identity),
        (1, 0) => parts
            .translation(0)
            .map(|direction| DisplacementSubgroup::Translation { direction }),
        (2, 0) => parts
            .plane_normal()
            .map(|normal| DisplacementSubgroup::PlanarTranslation { normal }),
        (3, 0) => Some(DisplacementSubgroup::SpatialTranslation),
        (1, 1) => parts.axis().map(|axis| {
            let pitch = parts.pitch(&mut result.margin);
            if pitch == 0.0 {
                DisplacementSubgroup::Rotation { axis }
            } else {
                DisplacementSubgroup::Helical { axis, pitch }
            }
        }),
        (2, 1) => parts
            .axis()
            .map(|axis| DisplacementSubgroup::Cylindrical { axis }),
        (3, 1) => parts.axis().map(|Axis { direction, .. }| {
            let pitch = parts.pitch(&mut result.margin);
            if pitch == 0.0 {
                DisplacementSubgroup::Planar { normal: direction }
            } else {
                DisplacementSubgroup::TranslatingScrew { direction, pitch }
            }
        }),
        (3, 3) => parts
            .centre()
            .map(|centre| DisplacementSubgroup::Spherical { centre }),
        (4, 1) => parts
            .axis()
            .map(|Axis { direction, .. }| DisplacementSubgroup::Schoenflies { direction }),
        (6, 3) => Some(DisplacementSubgroup::General),
        _ => None,
    };
    Ok(result)
}

/// A space of twists with its angular parts decomposed: left singular vectors are directions of rotation,
/// right ones the combinations of the basis that turn that way; those of zero singular value translate.
struct Parts<'a> {
    system: &'a ScrewSystem,
    angular: Decomposition,
}

impl Parts<'_> {
    fn combination(&self, index: usize) -> (Vector3<f64>, Vector3<f64>) {
        let x: Vector6<f64> = self.angular.combine(&self.system.basis, index);
        (
            Vector3::new(x[0], x[1], x[2]),
            Vector3::new(x[3], x[4], x[5]),
        )
    }

    fn translation(&self, index: usize) -> Option<Vector3<f64>> {
        direction(self.combination(index).1)
    }

    fn plane_normal(&self) -> Option<Vector3<f64>> {
        direction(self.combination(0).1.cross(&self.combination(1).1))
    }

    /// The axis of the one twist that turns and is orthogonal to all translations. For classes with
    /// translations beyond the axis only its direction has a meaning.
    fn axis(&self) -> Option<Axis> {
        let (w, v) = self.combination(0);
        let gauge = self.system.gauge();
        let offset = w.cross(&v) * (gauge.length() / w.norm_squared());
        let mut axis = Axis::through(gauge.centre() + offset, direction(w)?)?;
        axis.point = self.cleaned(axis.point, offset.norm());
        Some(axis)
    }

    /// Pitch (m per radian) of that twist, zero where it is zero within its error.
    ///
    /// For the unit twist (ω; v) the velocity along the axis is v·ω/|ω|. An error δ of the twist changes v by
    /// δ and turns ω by δ/|ω|: together at most δ (1 + |v|/|ω|).
    fn pitch(&self, margin: &mut Margin) -> f64 {
        let (w, v) = self.combination(0);
        let (turning, advance) = (w.norm(), v.dot(&w) / w.norm());
        let tolerance = (self.system.uncertainty + ROUNDING) * (1.0 + v.norm() / turning);
        let (nonzero, decision) = Margin::decide(&[advance.abs()], tolerance);
        *margin = margin.and(decision);
        if nonzero == 0 {
            0.0
        } else {
            advance / turning * self.system.gauge().length()
        }
    }

    /// The point that no twist of the space moves: least squares over Σ |v + ω × x|², whose normal
    /// equations Σ (|ω|² I − ωωᵀ) x = Σ ω × v are well conditioned where three rotations span.
    fn centre(&self) -> Option<Vector3<f64>> {
        let mut matrix = Matrix3::zeros();
        let mut right = Vector3::zeros();
        for index in 0..3 {
            let (w, v) = self.combination(index);
            // Each combination is stretched to unit rotation, so that all three weigh alike.
            let (w, v) = (w / w.norm(), v / w.norm());
            matrix += Matrix3::identity() - w * w.transpose();
            right += w.cross(&v);
        }
        let gauge = self.system.gauge();
        let offset = matrix.cholesky()?.solve(&right) * gauge.length();
        Some(self.cleaned(gauge.centre() + offset, offset.norm()))
    }

    /// A point with coordinates that are nothing but rounding set to zero.
    fn cleaned(&self, point: Vector3<f64>, offset: f64) -> Vector3<f64> {
        let gauge = self.system.gauge();
        let noise = ROUNDING * (gauge.length() + gauge.centre().norm() + offset);
        point.map(|x| if x.abs() <= noise { 0.0 } else { x })
    }
}

/// Unit vector with the sign normalised and components that are nothing but rounding set to zero.
fn direction(v: Vector3<f64>) -> Option<Vector3<f64>> {
    let noise = ROUNDING * v.norm();
    normalised_direction(v.map(|x| if x.abs() <= noise { 0.0 } else { x }))
}
