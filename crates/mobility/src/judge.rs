//! The judge of one part: holds the claims of engines against one another.
//!
//! Claims are all true or some engine is wrong: each says what it can stand for, so that the truth lies in the intersection of their
//! bounds. Where that is empty, the part is open, and the two claims that exclude each other are named: no engine outvotes
//! another. The bounds then are those that are left if a single engine is wrong.
//!
//! Besides bounds on the same number, these exclude each other:
//!
//! - a pose that is regular by one claim and singular by another,
//! - branches whose largest dimension is not the finite mobility,
//! - more real freedoms than complex dimensions, since real solutions are some of the complex ones.
//!
//! Of the complex dimension alone two claims may differ without doubt about the real freedom, which rests on neither; it is then not
//! known, and the report says so.
//!
//! This is the one place where what is known of a part is put together.

use super::claim::{Answer, Bounds, Claim, PartBranch, Says};
use super::vocabulary::{CertificateLevel, EngineName, MobilityClass, PoseKind, SingularKind};
use std::fmt;

/// A number that claims are about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The finite mobility.
    Finite,
    /// The freedom of velocities at the pose.
    Instantaneous,
    /// The dimension of the complex solution set.
    Complex,
}

/// Two claims of which one is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Contradiction {
    /// Bounds that exclude each other.
    Bounds {
        /// On what.
        quantity: Quantity,
        /// By which engines, and what they say.
        claims: [(EngineName, Bounds); 2],
    },
    /// The pose is regular by the first engine and singular by the second.
    Pose([EngineName; 2]),
    /// The largest branch that an engine shows is not what claims leave.
    Branches {
        /// The engine that shows it.
        engine: EngineName,
        /// The dimension of the branch.
        dimension: usize,
        /// What all claims leave for the finite mobility.
        finite: Bounds,
    },
}

impl Contradiction {
    /// Whether the finite mobility is in doubt.
    fn is_about_motion(&self) -> bool {
        !matches!(
            self,
            Self::Bounds {
                quantity: Quantity::Complex,
                ..
            }
        )
    }
}

impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.lower, self.upper) {
            (lower, Some(upper)) if lower == upper => write!(f, "{lower}"),
            (0, Some(upper)) => write!(f, "at most {upper}"),
            (lower, Some(upper)) => write!(f, "{lower} to {upper}"),
            (lower, None) => write!(f, "at least {lower}"),
        }
    }
}

impl fmt::Display for Contradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("two engines contradict each other, please report this: ")?;
        match self {
            Self::Bounds { quantity, claims } => {
                let [(one, first), (other, second)] = claims;
                let what = match quantity {
                    Quantity::Finite => "finite mobility",
                    Quantity::Instantaneous => "instantaneous freedom",
                    Quantity::Complex => "dimension over the complex numbers",
                };
                write!(
                    f,
                    "the {what} is {first} by engine `{one}` and {second} by engine `{other}`"
                )
            }
            Self::Pose([regular, singular]) => write!(
                f,
                "the pose is regular by engine `{regular}` and singular by engine `{singular}`"
            ),
            Self::Branches {
                engine,
                dimension,
                finite,
            } => write!(
                f,
                "engine `{engine}` shows a branch of dimension {dimension}, and the finite mobility is {finite} by all together"
            ),
        }
    }
}

/// What is known of the finite mobility of one part: claims, and what they come to.
#[derive(Clone, Debug)]
pub struct PartFinding {
    claims: Vec<Claim>,
    /// Claims before this one were made of other numbers.
    first: usize,
    /// Joint variables: no part has more freedoms.
    unknowns: usize,
    finite: Bounds,
    instantaneous: Bounds,
    complex: Option<Bounds>,
    pose: Option<PoseKind>,
    contradictions: Vec<Contradiction>,
    open: Option<String>,
}

impl PartFinding {
    /// Nothing is known of a part of so many joint variables.
    pub(super) fn new(unknowns: usize) -> Self {
        let mut found = Self {
            claims: Vec::new(),
            first: 0,
            unknowns,
            finite: Bounds::ANY,
            instantaneous: Bounds::ANY,
            complex: None,
            pose: None,
            contradictions: Vec::new(),
            open: None,
        };
        found.judge();
        found
    }

    /// Takes another claim.
    pub(super) fn take(&mut self, claim: Claim) {
        self.claims.push(claim);
        self.judge();
    }

    /// Lets the engine asked last correct its claim.
    pub(super) fn amend(&mut self, change: impl FnOnce(&mut Claim)) {
        if let Some(last) = self.claims.last_mut() {
            change(last);
            self.judge();
        }
    }

    /// Takes a claim about the part with its numbers read otherwise: what was claimed before is none of it.
    pub(super) fn read_anew(&mut self, claim: Claim) {
        self.first = self.claims.len();
        self.take(claim);
    }

    /// All claims, in the order they were made.
    #[must_use]
    pub fn claims(&self) -> &[Claim] {
        &self.claims
    }

    /// At least so many finite freedoms.
    #[must_use]
    pub fn lower(&self) -> usize {
        self.finite.lower
    }

    /// At most so many.
    #[must_use]
    pub fn upper(&self) -> usize {
        self.finite.upper.unwrap_or(self.unknowns)
    }

    /// Regular or singular.
    #[must_use]
    pub fn pose(&self) -> Option<PoseKind> {
        self.pose
    }

    /// In which way singular.
    #[must_use]
    pub fn kind(&self) -> Option<SingularKind> {
        self.answer().and_then(|answer| answer.kind)
    }

    /// Hervé's class.
    #[must_use]
    pub fn class(&self) -> Option<MobilityClass> {
        self.answer().and_then(|answer| answer.class)
    }

    /// How strong the certificate is.
    #[must_use]
    pub fn level(&self) -> CertificateLevel {
        match (self.answer(), self.proof()) {
            (Some(_), Some((level, _))) => level,
            (Some(answer), None) => answer.level,
            (None, _) => CertificateLevel::Numeric,
        }
    }

    /// What it proves.
    #[must_use]
    pub fn certificate(&self) -> &str {
        match (self.answer(), self.proof()) {
            (Some(_), Some((_, certificate))) => certificate,
            (Some(answer), None) => &answer.certificate,
            (None, _) if self.pose == Some(PoseKind::Singular) => {
                "the pose is singular, so that the finite freedom is below the instantaneous one"
            }
            (None, _) => {
                "the rank of the closure equations at this pose bounds the freedom from above"
            }
        }
    }

    /// The branches; `None` while not decided.
    #[must_use]
    pub fn branches(&self) -> Option<&[PartBranch]> {
        self.answer().and_then(|answer| answer.branches.as_deref())
    }

    /// How far the numbers, taken literally, miss a mobile mechanism (m), where they do.
    #[must_use]
    pub fn nominal(&self) -> Option<f64> {
        self.answer().and_then(|answer| answer.nominal)
    }

    /// Dimension over the complex numbers, where it was found.
    #[must_use]
    pub fn complex_dimension(&self) -> Option<usize> {
        self.complex.and_then(Bounds::sole)
    }

    /// No component of the complex solution set through the pose has more dimensions: proven, where exact algebra was asked.
    #[must_use]
    pub fn complex_upper(&self) -> Option<usize> {
        let proven = self.judged().filter(|c| c.engine == EngineName::Exact);
        proven.filter_map(|claim| claim.complex.upper).min()
    }

    /// Instantaneous freedom at the pose, where the part stays there.
    #[must_use]
    pub fn at_rest(&self) -> usize {
        self.instantaneous.upper.unwrap_or_else(|| self.upper())
    }

    /// What stays open, and what would decide it.
    #[must_use]
    pub fn open(&self) -> Option<&str> {
        self.open.as_deref()
    }

    /// Where engines contradict one another.
    #[must_use]
    pub fn contradictions(&self) -> &[Contradiction] {
        &self.contradictions
    }

    /// The claims that count.
    fn judged(&self) -> impl DoubleEndedIterator<Item = &Claim> {
        self.claims[self.first..].iter()
    }

    /// What the engine says that decided last, unless it is contradicted.
    pub(super) fn answer(&self) -> Option<&Answer> {
        let mut answers = self.judged().filter_map(Claim::answer);
        answers.next_back().filter(|_| self.open.is_none())
    }

    fn proof(&self) -> Option<(CertificateLevel, &str)> {
        self.judged().find_map(|claim| match &claim.says {
            Says::Proves { level, certificate } => Some((*level, certificate.as_str())),
            _ => None,
        })
    }

    /// Puts the claims together.
    fn judge(&mut self) {
        let mut contradictions = Vec::new();
        self.instantaneous = self.met(Quantity::Instantaneous, &mut contradictions);
        self.finite = self.met(Quantity::Finite, &mut contradictions);
        self.complex = None;
        let mut about_complex = Vec::new();
        let complex = self.met(Quantity::Complex, &mut about_complex);
        if about_complex.is_empty() {
            self.complex = match self.above_the_real(complex) {
                Ok(bounds) => Some(bounds),
                Err(contradiction) => {
                    about_complex.push(contradiction);
                    None
                }
            };
        }
        contradictions.append(&mut about_complex);
        self.pose = self.pose_of_all(&mut contradictions);
        contradictions.extend(self.branches_out_of_bounds());
        let doubt = contradictions.iter().find(|c| c.is_about_motion());
        self.open = match doubt {
            Some(contradiction) => {
                self.pose = None;
                self.complex = None;
                Some(contradiction.to_string())
            }
            None if self.judged().any(|claim| claim.answer().is_some()) => None,
            None => {
                let mut open = self.judged().filter_map(|claim| match &claim.says {
                    Says::Open(why) => Some(why.clone()),
                    _ => None,
                });
                Some(open.next_back().unwrap_or_default())
            }
        };
        self.contradictions = contradictions;
    }

    /// What all claims leave of a number; if nothing, what is left where a single engine is wrong.
    fn met(&self, quantity: Quantity, contradictions: &mut Vec<Contradiction>) -> Bounds {
        let said = || {
            self.judged()
                .map(|claim| (claim.engine, bounds(claim, quantity)))
        };
        let all = said().try_fold(Bounds::ANY, |sum, (_, bounds)| sum.meet(bounds));
        if let Some(bounds) = all {
            return bounds;
        }
        let excluded = said().find_map(|one| {
            let other = said().find(|other| one.1.meet(other.1).is_none())?;
            Some([one, other])
        });
        // Intervals that exclude one another do so in pairs (Helly's theorem on the line).
        if let Some(claims) = excluded {
            contradictions.push(Contradiction::Bounds { quantity, claims });
        }
        let without = |wrong: EngineName| {
            said()
                .filter(|(engine, _)| *engine != wrong)
                .try_fold(Bounds::ANY, |sum, (_, bounds)| sum.meet(bounds))
        };
        said()
            .filter_map(|(engine, _)| without(engine))
            .reduce(Bounds::hull)
            .unwrap_or(Bounds::ANY)
    }

    /// Bounds on the complex dimension, which is no less than the real one.
    fn above_the_real(&self, complex: Bounds) -> Result<Bounds, Contradiction> {
        if complex.upper.is_none() {
            return Ok(complex);
        }
        let real = Bounds {
            lower: self.finite.lower,
            upper: None,
        };
        complex.meet(real).ok_or_else(|| {
            let by = |value: &dyn Fn(&Claim) -> bool| {
                self.judged()
                    .find(|claim| value(claim))
                    .map_or(EngineName::Rank, |claim| claim.engine)
            };
            Contradiction::Bounds {
                quantity: Quantity::Complex,
                claims: [
                    (by(&|claim| claim.complex.upper == complex.upper), complex),
                    (by(&|claim| claim.finite.lower == real.lower), real),
                ],
            }
        })
    }

    fn pose_of_all(&self, contradictions: &mut Vec<Contradiction>) -> Option<PoseKind> {
        let by = |kind: PoseKind| {
            let mut claims = self.judged();
            claims.find(|claim| claim.pose == Some(kind))
        };
        match (by(PoseKind::Regular), by(PoseKind::Singular)) {
            (Some(regular), Some(singular)) => {
                let engines = [regular.engine, singular.engine];
                contradictions.push(Contradiction::Pose(engines));
                None
            }
            (one, other) => one.or(other).and_then(|claim| claim.pose),
        }
    }

    /// Branches shown that are not of the dimension that claims leave.
    fn branches_out_of_bounds(&self) -> Option<Contradiction> {
        let claim = self.judged().rfind(|c| c.answer().is_some())?;
        let branches = claim.answer()?.branches.as_ref()?;
        let dimension = branches.iter().map(|b| b.dimension).max().unwrap_or(0);
        #[cfg(test)]
        let dimension = moved::moved(claim.engine, Bounds::exactly(dimension)).lower;
        (self.finite.sole() != Some(dimension)).then_some(Contradiction::Branches {
            engine: claim.engine,
            dimension,
            finite: self.finite,
        })
    }
}

/// What a claim says of a number.
fn bounds(claim: &Claim, quantity: Quantity) -> Bounds {
    let bounds = match quantity {
        Quantity::Finite => claim.finite,
        Quantity::Instantaneous => return claim.instantaneous,
        Quantity::Complex => claim.complex,
    };
    #[cfg(test)]
    let bounds = moved::moved(claim.engine, bounds);
    bounds
}

#[cfg(test)]
mod moved;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
