//! From a linear space of twists to the class and the geometry of the subgroup it generates.

use nalgebra::{Matrix3, Vector3, Vector6};

use super::GroupError;
use super::axis::{Axis, normalised_direction};
use super::class::DisplacementSubgroup;
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
    let (closed, closing) = system.is_closed()?;
    classify_known(system, closed, closing)
}

/// [`classify`] where it is known whether the space is closed under the bracket, and by which margin.
pub(super) fn classify_known(
    system: &ScrewSystem,
    closed: bool,
    closing: Margin,
) -> Result<Classification, GroupError> {
    let dimension = system.dimension();
    let angular = Decomposition::of(3, dimension, true, |i, j| system.basis[j][i])?;
    let (rotations, decision) = Margin::decide(&angular.values, system.uncertainty + ROUNDING);
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::group::herve_tables::one_of_each;
    use crate::group::{Gauge, Pose, Twist};
    use proptest::prelude::*;

    fn close(a: &DisplacementSubgroup, b: &DisplacementSubgroup, within: f64) -> bool {
        let (a, b) = (a.algebra(), b.algebra());
        let pairs = a.iter().zip(&b);
        a.len() == b.len()
            && pairs
                .into_iter()
                .all(|(a, b)| (*a - *b).to_vector().norm() < within)
    }

    #[test]
    fn geometry_is_read_back_exactly() {
        let gauge = Gauge::new(Vector3::new(0.3, -1.0, 2.0), 1.5, 1e-9).unwrap();
        for group in one_of_each() {
            let system = ScrewSystem::span(&group.algebra(), &gauge).unwrap();
            let found = classify(&system).unwrap();
            let read = found.subgroup.unwrap();
            assert!(close(&read, &group, 1e-13), "{read} for {group}");
            assert_eq!(found.rotations, group.kind().rotations());
            assert_eq!(found.translations, group.kind().translations());
            assert!(found.margin.is_clear(), "{group}");
        }
    }

    /// The joint classes of the file format that are no subgroups: chains of R, T, T2, S, G.
    #[test]
    fn spans_that_are_not_closed_have_no_class() {
        let o = Vector3::new(1.0, 2.0, 3.0);
        let r = |u: Vector3<f64>| Twist::revolute(u, o);
        let t = |u: Vector3<f64>| Twist::prismatic(u);
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        let beside = Twist::revolute(z, Vector3::zeros());
        let gauge = Gauge::new(Vector3::zeros(), 1.0, 1e-9).unwrap();
        for (name, twists, rotations) in [
            ("universal", vec![r(x), r(y)], 2),
            ("parallel revolutes", vec![r(z), beside], 1),
            ("revolute and oblique prismatic", vec![r(z), t(x + z)], 1),
            ("revolute and plane through it", vec![r(z), t(z), t(x)], 1),
            ("point on line", vec![t(x), r(x), r(y), r(z)], 3),
            ("line on plane", vec![r(x), r(z), t(x), t(y)], 2),
            ("point on plane", vec![t(x), t(y), r(x), r(y), r(z)], 3),
            ("distance", vec![beside, r(x), r(y), r(z), t(x)], 3),
        ] {
            let system = ScrewSystem::span(&twists, &gauge).unwrap();
            let found = classify(&system).unwrap();
            assert_eq!(system.dimension(), twists.len(), "{name}");
            assert_eq!(found.subgroup, None, "{name}");
            assert_eq!(found.rotations, rotations, "{name}");
            assert!(found.margin.is_clear(), "{name}");
        }
    }

    #[test]
    fn a_small_pitch_counts_against_the_accuracy() {
        let helix = |pitch| {
            [Twist::helical(
                Vector3::z(),
                Vector3::new(5.0, 0.0, 0.0),
                pitch,
            )]
        };
        let read = |pitch, tolerance| {
            let gauge = Gauge::new(Vector3::zeros(), 1.0, tolerance).unwrap();
            let system = ScrewSystem::span(&helix(pitch), &gauge).unwrap();
            let found = classify(&system).unwrap();
            (found.subgroup.unwrap(), found.margin.is_clear())
        };
        let (exact, clear) = read(1e-6, 1e-12);
        assert!(clear && (exact.pitch() - 1e-6).abs() < 1e-14, "{exact}");
        assert_eq!(read(1e-6, 1e-4).0.short_name(), "R");
        // A little above the tolerance, which is 6e-4 for this axis five lengths away, the pitch is kept
        // but the margin says how weakly.
        let (weak, clear) = read(2e-3, 1e-5);
        assert!(weak.short_name() == "H" && !clear, "{weak}");
    }

    proptest! {
        #[test]
        fn classes_and_geometry_follow_a_rigid_motion_and_the_unit(
            turn in [-2.0..2.0_f64, -2.0..2.0_f64, -2.0..2.0_f64],
            shift in [-1e3..1e3_f64, -1e3..1e3_f64, -1e3..1e3_f64],
            exponent in -6.0..6.0_f64,
        ) {
            let unit = 10.0_f64.powf(exponent);
            let pose = Pose::translation(Vector3::from(shift))
                * Pose::exp(&Twist::new(Vector3::from(turn), Vector3::zeros()));
            for group in one_of_each() {
                let moved = group.conjugated_by(&pose);
                let scaled = |t: &Twist| Twist::new(t.angular, t.linear * unit);
                let twists: Vec<_> = moved.algebra().iter().map(scaled).collect();
                // No hint where the mechanism is: the centre comes from the axes alone.
                let gauge = Gauge::from_axes(&twists, unit, 1e-9).unwrap();
                let found = classify(&ScrewSystem::span(&twists, &gauge).unwrap()).unwrap();
                let read = found.subgroup.unwrap();
                prop_assert_eq!(read.kind(), group.kind());
                prop_assert!(found.margin.is_clear());
                prop_assert!((read.pitch() - group.pitch() * unit).abs() < 1e-9 * unit);
                let system = ScrewSystem::span(&read.algebra(), &gauge).unwrap();
                for twist in &twists {
                    prop_assert!(system.contains(twist), "{} for {}", read, moved);
                }
            }
        }
    }
}
