//! What an engine may say about the mobility of a part: bounds, where they hold, and what it decides, if it does.
//!
//! An engine says nothing of what others found. That is the business of the judge ([`PartFinding`](super::PartFinding)), which
//! holds claims against one another.

use super::tracing::PartPose;
use super::vocabulary::{
    CertificateLevel, EngineName, MobilityClass, PoseKind, Scope, SingularKind,
};

/// Bounds on a number of freedoms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// At least so many.
    pub lower: usize,
    /// At most so many; `None` where nothing bounds them.
    pub upper: Option<usize>,
}

impl Bounds {
    /// Says nothing.
    pub const ANY: Self = Self {
        lower: 0,
        upper: None,
    };

    /// So many.
    #[must_use]
    pub const fn exactly(freedom: usize) -> Self {
        Self::between(freedom, freedom)
    }

    /// At most so many.
    #[must_use]
    pub const fn at_most(upper: usize) -> Self {
        Self::between(0, upper)
    }

    /// At least `lower`, at most `upper`.
    #[must_use]
    pub const fn between(lower: usize, upper: usize) -> Self {
        Self {
            lower,
            upper: Some(upper),
        }
    }

    /// What both leave; `None` where they exclude each other.
    #[must_use]
    pub fn meet(self, other: Self) -> Option<Self> {
        let upper = match (self.upper, other.upper) {
            (Some(one), Some(two)) => Some(one.min(two)),
            (one, two) => one.or(two),
        };
        let lower = self.lower.max(other.lower);
        upper
            .is_none_or(|upper| lower <= upper)
            .then_some(Self { lower, upper })
    }

    /// What one of the two leaves at least.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self {
            lower: self.lower.min(other.lower),
            upper: self.upper.zip(other.upper).map(|(one, two)| one.max(two)),
        }
    }

    /// The number, where the bounds meet.
    #[must_use]
    pub fn sole(self) -> Option<usize> {
        self.upper.filter(|upper| *upper == self.lower)
    }
}

/// A branch of one part.
#[derive(Clone, Debug)]
pub struct PartBranch {
    /// Dimension.
    pub dimension: usize,
    /// Ways of leaving the pose, for dimension 1.
    pub half_branches: Option<usize>,
    /// Generic poses on it.
    pub poses: Vec<PartPose>,
}

/// What an engine that decides a part says of it.
#[derive(Clone, Debug)]
pub struct Answer {
    /// In which way singular.
    pub kind: Option<SingularKind>,
    /// Hervé's class.
    pub class: Option<MobilityClass>,
    /// How strong the certificate is.
    pub level: CertificateLevel,
    /// What it proves.
    pub certificate: String,
    /// The branches; `None` where they are not known.
    pub branches: Option<Vec<PartBranch>>,
    /// How far the numbers, taken literally, miss a mobile mechanism (m), where they do.
    pub nominal: Option<f64>,
}

impl Answer {
    /// An answer in floating point, of which nothing but the certificate is known yet.
    pub(super) fn numeric(certificate: impl Into<String>) -> Self {
        Self {
            kind: None,
            class: None,
            level: CertificateLevel::Numeric,
            certificate: certificate.into(),
            branches: None,
            nominal: None,
        }
    }
}

/// Whether an engine decides a part.
#[derive(Clone, Debug)]
pub enum Says {
    /// It gives bounds only.
    Bounds,
    /// It leaves the part open, and says what would decide it.
    Open(String),
    /// It decides.
    Decides(Box<Answer>),
    /// It proves what another engine decided.
    Proves {
        /// How strong the certificate is.
        level: CertificateLevel,
        /// What it proves.
        certificate: String,
    },
}

/// What one engine says about one part.
#[derive(Clone, Debug)]
pub struct Claim {
    /// The engine.
    pub engine: EngineName,
    /// Where the claim holds.
    pub scope: Scope,
    /// The finite mobility.
    pub finite: Bounds,
    /// The freedom of velocities at the pose.
    pub instantaneous: Bounds,
    /// The dimension of the complex solution set at the pose.
    pub complex: Bounds,
    /// Regular or singular.
    pub pose: Option<PoseKind>,
    /// Whether it decides.
    pub says: Says,
    /// Figures: margins, orders, radii, seeds.
    pub text: String,
}

impl Claim {
    /// Bounds on the finite mobility, and nothing else.
    pub(super) fn of(
        engine: EngineName,
        scope: Scope,
        finite: Bounds,
        text: impl Into<String>,
    ) -> Self {
        Self {
            engine,
            scope,
            finite,
            instantaneous: Bounds::ANY,
            complex: Bounds::ANY,
            pose: None,
            says: Says::Bounds,
            text: text.into(),
        }
    }

    /// The same, deciding the part.
    pub(super) fn decides(mut self, answer: Answer) -> Self {
        self.says = Says::Decides(Box::new(answer));
        self
    }

    /// The same, of a pose that is regular: there are so many freedoms, over the complex numbers too.
    pub(super) fn regular(mut self, freedom: usize, answer: Answer) -> Self {
        self.finite = Bounds::exactly(freedom);
        self.complex = Bounds::exactly(freedom);
        self.pose = Some(PoseKind::Regular);
        self.decides(answer)
    }

    /// What it decides, if it does.
    #[must_use]
    pub fn answer(&self) -> Option<&Answer> {
        match &self.says {
            Says::Decides(answer) => Some(answer),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_meet_or_exclude_each_other() {
        let some = Bounds::between(1, 3);
        assert_eq!(some.meet(Bounds::ANY), Some(some));
        assert_eq!(some.meet(Bounds::at_most(1)), Some(Bounds::exactly(1)));
        assert_eq!(some.meet(Bounds::at_most(0)), None);
        assert_eq!(
            Bounds::exactly(2).hull(Bounds::at_most(1)),
            Bounds::at_most(2)
        );
        assert_eq!(some.hull(Bounds::ANY), Bounds::ANY);
        assert_eq!((some.sole(), Bounds::exactly(2).sole()), (None, Some(2)));
    }
}
