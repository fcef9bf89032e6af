//! Subalgebras of se(3): the linear algebra of displacement subgroups.

use super::GroupError;
use super::class::DisplacementSubgroup;
use super::classify::classify_known;
use super::decomposition::Margin;
use super::gauge::Gauge;
use super::system::ScrewSystem;
use super::twist::Twist;

/// A screw system closed under the bracket: the tangent space of a connected subgroup of SE(3).
///
/// What holds for subalgebras holds for the connected subgroups they generate, globally, with one
/// limit: an intersection of groups may have discrete parts that no algebra sees (a screw and a
/// translation along it share all whole turns of the screw).
#[derive(Clone, Debug)]
pub struct Subalgebra(ScrewSystem);

impl Subalgebra {
    /// The smallest subalgebra that contains the given world twists: the group of all displacements that
    /// a chain of these joints can ever produce, whatever its length.
    ///
    /// Brackets of basis twists are added until nothing new appears. Each round but the last raises the
    /// dimension, so from two generators there are at most four rounds.
    ///
    /// # Errors
    /// [`GroupError::NotFinite`], [`GroupError::NoConvergence`].
    pub fn generated_by(twists: &[Twist], gauge: &Gauge) -> Result<Self, GroupError> {
        Self::generated_by_system(&ScrewSystem::span(twists, gauge)?)
    }

    /// The smallest subalgebra that contains a screw system; see [`Subalgebra::generated_by`].
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn generated_by_system(system: &ScrewSystem) -> Result<Self, GroupError> {
        let mut system = system.clone();
        loop {
            let (outside, tolerance) = system.brackets_outside()?;
            let (new, _) = Margin::decide(&outside.values, tolerance);
            // Beyond six dimensions there is nothing: surplus values could only be rounding.
            let new = new.min(6 - system.dimension());
            system = system.extended(&outside, new, tolerance);
            if new == 0 {
                return Ok(Self(system));
            }
        }
    }

    /// The screw system as a subalgebra if it is closed under the bracket, else `None`.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn from_system(system: &ScrewSystem) -> Result<Option<Self>, GroupError> {
        let (closed, margin) = system.is_closed()?;
        Ok(closed.then(|| {
            let mut system = system.clone();
            system.margin = margin;
            Self(system)
        }))
    }

    /// The underlying linear space.
    pub fn system(&self) -> &ScrewSystem {
        &self.0
    }

    /// Dimension: 0, 1, 2, 3, 4 or 6. (No subalgebra of se(3) has dimension 5.)
    pub fn dimension(&self) -> usize {
        self.0.dimension()
    }

    /// A basis of world twists; see [`ScrewSystem::basis`].
    pub fn basis(&self) -> Vec<Twist> {
        self.0.basis()
    }

    /// Worst margin of the rank decisions behind this algebra.
    pub fn margin(&self) -> Margin {
        self.0.margin()
    }

    /// True where a world twist belongs to the algebra; see [`ScrewSystem::contains`].
    pub fn contains(&self, twist: &Twist) -> bool {
        self.0.contains(twist)
    }

    /// The subalgebra common to both: the relative motion left by two chains in parallel.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn intersection(&self, other: &Self) -> Result<Self, GroupError> {
        // Closed because both are; asking again could only add rounding.
        Ok(Self(self.0.intersection(&other.0)?))
    }

    /// The linear sum, the tangent space of the product AB of both groups; in general no subalgebra.
    /// Its dimension dim A + dim B − dim A∩B is that of the product AB.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn sum(&self, other: &Self) -> Result<ScrewSystem, GroupError> {
        self.0.sum(&other.0)
    }

    /// The smallest subalgebra that contains both.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn join(&self, other: &Self) -> Result<Self, GroupError> {
        Self::generated_by_system(&self.sum(other)?)
    }

    /// The class and geometry of the connected subgroup; `None` only where the margin is too small for
    /// the dimensions to fit any class.
    ///
    /// # Errors
    /// [`GroupError::NoConvergence`].
    pub fn subgroup(&self) -> Result<Option<DisplacementSubgroup>, GroupError> {
        Ok(classify_known(&self.0, true, self.margin())?.subgroup)
    }
}

/// Whether the product AB of two subgroups, a chain in series, is again a subgroup; with the margin.
///
/// It is one exactly where the linear sum of the algebras is closed under the bracket: a subgroup AB has that
/// sum as its tangent space, and a closed sum generates a group of the dimension of AB in which AB
/// contains a neighbourhood of the identity.
///
/// # Errors
/// [`GroupError::NoConvergence`].
pub fn product_is_subgroup(a: &Subalgebra, b: &Subalgebra) -> Result<(bool, Margin), GroupError> {
    a.sum(b)?.is_closed()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use nalgebra::Vector3;
    use proptest::prelude::*;

    const O: [f64; 3] = [0.0; 3];

    fn r(u: [f64; 3], p: [f64; 3]) -> Twist {
        Twist::revolute(u.into(), p.into())
    }

    fn h(u: [f64; 3], p: [f64; 3], pitch: f64) -> Twist {
        Twist::helical(u.into(), p.into(), pitch)
    }

    fn t(u: [f64; 3]) -> Twist {
        Twist::prismatic(u.into())
    }

    fn gauge(tolerance: f64) -> Gauge {
        Gauge::new(Vector3::zeros(), 1.0, tolerance).unwrap()
    }

    #[test]
    fn chains_generate_the_known_groups() {
        let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        for (name, twists, class) in [
            ("no joint", vec![], "E"),
            ("parallel revolutes", vec![r(z, O), r(z, x)], "G"),
            ("revolute and slide across", vec![r(z, O), t(x)], "G"),
            (
                "revolute and oblique slide",
                vec![r(z, O), t([1.0, 0.0, 1.0])],
                "X",
            ),
            ("Hooke joint", vec![r(x, O), r(y, O)], "S"),
            ("skew revolutes", vec![r(x, O), r(y, z)], "D"),
            (
                "parallel screws of one pitch",
                vec![h(z, O, 0.3), h(z, x, 0.3)],
                "Y",
            ),
            (
                "parallel screws of two pitches",
                vec![h(z, O, 0.3), h(z, x, 0.2)],
                "X",
            ),
            (
                "revolute and parallel screw",
                vec![r(z, O), h(z, x, 0.2)],
                "X",
            ),
            (
                "coaxial screws of two pitches",
                vec![h(z, O, 0.3), h(z, O, 0.2)],
                "C",
            ),
            ("meeting screws", vec![h(z, O, 0.3), h(x, O, 0.3)], "D"),
            (
                "screws of opposite pitch, meeting",
                vec![h(z, O, 0.3), h(x, O, -0.3)],
                "D",
            ),
            ("slides", vec![t(x), t(y), t([1.0, 2.0, 0.0])], "T2"),
            ("screw and slide across", vec![h(z, O, 0.3), t(y)], "Y"),
            (
                "point on plane",
                vec![t(x), t(y), r(x, O), r(y, O), r(z, O)],
                "D",
            ),
        ] {
            let algebra = Subalgebra::generated_by(&twists, &gauge(1e-9)).unwrap();
            let group = algebra.subgroup().unwrap().unwrap();
            assert_eq!(group.short_name(), class, "{name}");
            assert!(
                algebra.margin().is_clear(),
                "{name}: {:?}",
                algebra.margin()
            );
            for twist in &twists {
                assert!(algebra.contains(twist), "{name}");
            }
        }
    }

    #[test]
    fn a_visible_tilt_is_not_planar() {
        for tilt in [1e-1, 1e-2, 1e-3] {
            let joints = [
                r([0.0, 0.0, 1.0], O),
                r([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]),
                r([0.0, tilt, 1.0], [0.0, 1.0, 0.0]),
            ];
            let exact = Subalgebra::generated_by(&joints, &gauge(1e-12)).unwrap();
            assert_eq!(exact.dimension(), 6, "{tilt}");
            assert!(exact.margin().is_clear(), "{tilt}: {:?}", exact.margin());
        }
    }

    #[test]
    fn a_tilt_a_little_above_the_tolerance_is_called_unclear() {
        let joints = [
            r([0.0, 0.0, 1.0], O),
            r([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]),
            r([0.0, 2e-4, 1.0], [0.0, 1.0, 0.0]),
        ];
        let algebra = Subalgebra::generated_by(&joints, &gauge(1e-6)).unwrap();
        assert!(!algebra.margin().is_clear(), "{:?}", algebra.margin());
    }

    #[test]
    fn systems_that_are_not_closed_are_refused() {
        let hooke = [r([1.0, 0.0, 0.0], O), r([0.0, 1.0, 0.0], O)];
        let system = ScrewSystem::span(&hooke, &gauge(1e-9)).unwrap();
        assert!(Subalgebra::from_system(&system).unwrap().is_none());
    }

    fn vector() -> impl Strategy<Value = Vector3<f64>> {
        [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64].prop_map(Vector3::from)
    }

    proptest! {
        /// The tolerance is a bound: geometry wrong by as much as the gauge says never
        /// breaks a planar or a spherical group.
        #[test]
        fn errors_within_the_stated_accuracy_change_nothing(
            points in proptest::collection::vec(vector(), 3..7),
            errors in proptest::collection::vec((vector(), vector()), 7),
            exponent in -12.0..-4.0_f64,
        ) {
            // Vectors of the cube scaled into the unit ball.
            let accuracy = 10.0_f64.powf(exponent);
            let wrong = |v: &Vector3<f64>| v * (accuracy / 3.0_f64.sqrt());
            let joint = |u: Vector3<f64>, p: Vector3<f64>, e: &(Vector3<f64>, Vector3<f64>)| {
                Twist::revolute(u.normalize() + wrong(&e.0), p + wrong(&e.1))
            };
            let pairs = points.iter().zip(&errors);
            let planar: Vec<_> = pairs.clone().map(|(p, e)| joint(Vector3::z(), *p, e)).collect();
            let spherical: Vec<_> = pairs
                .map(|(p, e)| joint(p + Vector3::z() * 1e-3, Vector3::zeros(), e))
                .collect();
            let closed = |twists: &[Twist]| {
                Subalgebra::generated_by(twists, &gauge(accuracy)).unwrap().dimension()
            };
            prop_assert!(closed(&planar) <= 3);
            prop_assert!(closed(&spherical) <= 3);
        }
    }
}
