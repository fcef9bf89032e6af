//! Subalgebras of se(3): the linear algebra of displacement subgroups.

use super::GroupError;
use super::class::DisplacementSubgroup;
use super::classify::classify;
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
        Ok(classify(&self.0)?.subgroup)
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
