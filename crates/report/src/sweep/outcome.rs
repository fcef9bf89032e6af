//! What is found of a member of a family: what a row says.

use crate::findings::{joint_role, margin};
use crate::natural::natural_order;
use kutzbach_mobility::{
    Analysis, Depth, MobilityClass, PoseKind, SingularKind, Structure, Verdict, generic_count,
};
use kutzbach_model::mechanism::Mechanism;

/// Whether there is an answer for a variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// It was analysed at a closed pose.
    Analysed,
    /// No closed pose was found.
    Unassembled,
    /// With these values the file is no mechanism.
    Invalid,
}

impl Status {
    /// The word in a table.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Analysed => "analysed",
            Self::Unassembled => "unassembled",
            Self::Invalid => "invalid",
        }
    }

    /// What a word in a table says.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        let all = [Self::Analysed, Self::Unassembled, Self::Invalid];
        all.into_iter().find(|own| own.word() == word)
    }
}

/// What is found of a variant; what was not asked, or is not decided, is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    /// Kutzbach's count.
    pub kutzbach: Option<i64>,
    /// The count at random geometry.
    pub generic: Option<i64>,
    /// Instantaneous freedom.
    pub instantaneous: Option<usize>,
    /// Redundant constraints.
    pub redundant: Option<i64>,
    /// How many times its tolerance the rank of the weakest part is away from being another one; `None` where nothing was
    /// ranked or no value is near.
    pub margin: Option<f64>,
    /// Finite freedom.
    pub finite: Option<usize>,
    /// The verdict.
    pub verdict: Option<Verdict>,
    /// Regular or singular.
    pub pose: Option<PoseKind>,
    /// In which way singular.
    pub kind: Option<SingularKind>,
    /// Why it is mobile.
    pub class: Option<MobilityClass>,
    /// How many branches pass through the pose.
    pub branches: Option<usize>,
    /// Names of locked joints, in natural order; `None` where it is open of some joint whether it is.
    pub locked: Option<Vec<String>>,
}

/// The answer for one variant.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Whether there is one.
    pub status: Status,
    /// Why there is none, or why it is open.
    pub reason: Option<String>,
    /// What was found.
    pub facts: Facts,
}

impl Outcome {
    pub(super) fn invalid(reason: String) -> Self {
        Self {
            status: Status::Invalid,
            reason: Some(reason),
            facts: Facts::default(),
        }
    }
}

/// What an analysis of this depth has found of the mechanism that it was given, and why not more: what a row says.
#[must_use]
pub fn outcome(given: &Mechanism, analysis: &Analysis, depth: Depth) -> Outcome {
    let generic = match depth {
        Depth::Rank => None,
        _ => generic_mobility(analysis.of(given), &analysis.structure),
    };
    found(given, analysis, depth, generic)
}

/// [`outcome`], where the count at random geometry is known.
pub(super) fn found(
    given: &Mechanism,
    analysis: &Analysis,
    depth: Depth,
    generic: Option<i64>,
) -> Outcome {
    let mobility = &analysis.mobility;
    let mut facts = Facts {
        kutzbach: Some(analysis.kutzbach),
        ..Facts::default()
    };
    let Some(home) = &analysis.home else {
        facts.verdict = (depth > Depth::Rank).then_some(mobility.verdict);
        return Outcome {
            status: Status::Unassembled,
            reason: Some(mobility.certificate.clone()),
            facts,
        };
    };
    facts.instantaneous = home.instantaneous;
    facts.redundant = home.redundant;
    facts.margin = analysis
        .parts
        .iter()
        .filter(|part| part.unknowns() > 0 && part.equations() > 0)
        .map(margin)
        .min_by(f64::total_cmp)
        .filter(|margin| margin.is_finite());
    let mut reason = None;
    if depth == Depth::Rank {
        if home.instantaneous.is_none() {
            let (least, most) = home.candidates;
            reason = Some(format!(
                "the margin does not tell: between {least} and {most} instantaneous freedoms"
            ));
        }
    } else {
        facts.generic = generic;
        judged(&mut facts, analysis.of(given), analysis);
        if mobility.finite().is_none() {
            reason = mobility.why.first().cloned();
        }
    }
    Outcome {
        status: Status::Analysed,
        reason,
        facts,
    }
}

/// What goes beyond the rank.
fn judged(facts: &mut Facts, mechanism: &Mechanism, analysis: &Analysis) {
    let mobility = &analysis.mobility;
    facts.verdict = Some(mobility.verdict);
    facts.finite = mobility.finite();
    facts.pose = mobility.pose;
    facts.kind = mobility.kind;
    facts.class = mobility.class;
    facts.branches = analysis.branches.as_ref().map(Vec::len);
    facts.locked = locked(mechanism, analysis);
}

pub(super) fn generic_mobility(mechanism: &Mechanism, structure: &Structure) -> Option<i64> {
    let generic = generic_count(mechanism, structure).ok();
    generic.map(|generic| generic.mobility)
}

/// Names of joints that rest on every branch.
fn locked(mechanism: &Mechanism, analysis: &Analysis) -> Option<Vec<String>> {
    let mut names = Vec::new();
    for (index, joint) in mechanism.joints().iter().enumerate() {
        if joint.freedom() > 0 && joint_role(analysis, index).locked? {
            names.push(joint.name.clone());
        }
    }
    names.sort_by(|a, b| natural_order(a, b));
    Some(names)
}
