//! The one place where engines meet: each gives bounds on the finite mobility, and what they agree on is the verdict.

use super::pose_rank::PartRank;
use super::structure::Structure;
use crate::closure::Assembly;
use crate::mechanism::Mechanism;

/// What is said of the mechanism as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// At least one finite freedom.
    Mobile,
    /// No finite freedom.
    Rigid,
    /// The bounds do not meet.
    Undecided,
    /// There is no closed pose to ask about.
    Unassembled,
}

impl Verdict {
    /// The word of the report.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Mobile => "mobile",
            Self::Rigid => "rigid",
            Self::Undecided => "undecided",
            Self::Unassembled => "unassembled",
        }
    }
}

/// The verdict with its bounds and reasons.
#[derive(Clone, Debug, PartialEq)]
pub struct Mobility {
    /// The verdict.
    pub verdict: Verdict,
    /// Least and greatest finite mobility that remain possible; `None` where nothing is known.
    pub bounds: (Option<usize>, Option<usize>),
    /// Whether the pose is known to be regular.
    pub regular: bool,
    /// What the verdict rests on, in one sentence.
    pub certificate: String,
    /// Why not more, why not less, or what would decide.
    pub why: Vec<String>,
}

impl Mobility {
    /// The finite mobility where the bounds meet.
    #[must_use]
    pub fn finite(&self) -> Option<usize> {
        match (self.verdict, self.bounds) {
            (Verdict::Mobile | Verdict::Rigid, (Some(low), Some(high))) if low == high => {
                Some(high)
            }
            _ => None,
        }
    }
}

/// Intersects what the rank at the pose says about each part.
///
/// - Upper bound: the kernel of the Jacobian contains the tangents of every motion, so the instantaneous freedom bounds
///   the finite one from above.
/// - Lower bound: where the equations of a part are independent (full row rank), the implicit function theorem makes its
///   configurations a manifold of exactly the instantaneous dimension. Elsewhere nothing is known yet: 0.
#[must_use]
pub fn judge(
    mechanism: &Mechanism,
    structure: &Structure,
    assembly: &Assembly,
    parts: &[PartRank],
) -> Mobility {
    if !assembly.closed {
        return Mobility {
            verdict: Verdict::Unassembled,
            bounds: (None, None),
            regular: false,
            certificate: format!(
                "no closed pose was found from the pose drawn: the best one still misses by {:.2e} (allowed {:.2e})",
                assembly.residual, assembly.tolerance
            ),
            why: vec!["a mechanism that does not close has no motions to count".to_owned()],
        };
    }
    let free: usize = structure
        .free_joints
        .iter()
        .map(|&j| mechanism.joints()[j].freedom())
        .sum();
    let base = free + 6 * structure.loose_pieces;
    let mut low = base;
    let mut high = base;
    let mut regular = true;
    let mut doubtful = false;
    let mut dependent = 0;
    for part in parts {
        // A special mechanism written with too few digits is, taken literally, a generic one: that more equations than
        // unknowns then hold it fast may be due to the digits left out.
        let held_by_rounding = part.taken_literally
            && part.instantaneous == Some(0)
            && part.equations() > part.unknowns();
        let decided = part
            .instantaneous
            .filter(|_| part.note.is_none() && !held_by_rounding);
        doubtful |= decided.is_none();
        high += if held_by_rounding {
            part.unknowns()
        } else {
            part.instantaneous
                .map_or(part.candidates.1, |i| i.max(part.candidates.1))
        };
        match decided {
            Some(freedom) if freedom + part.equations() == part.unknowns() => low += freedom,
            Some(0) => dependent += part.equations() - part.unknowns(),
            Some(freedom) => {
                regular = false;
                dependent += freedom + part.equations() - part.unknowns();
            }
            None => regular = false,
        }
    }
    let mut why = Vec::new();
    let (verdict, certificate) = if low == high && !doubtful {
        let sentence = if high == 0 {
            "no velocity at all satisfies the closure equations at this pose, so no motion starts from it".to_owned()
        } else {
            "where they constrain motion at all, the closure equations at this pose are independent, so its motions form a \
             manifold of exactly this dimension (implicit function theorem)"
                .to_owned()
        };
        let verdict = if high == 0 {
            Verdict::Rigid
        } else {
            Verdict::Mobile
        };
        (verdict, sentence)
    } else {
        if doubtful {
            why.push("the numbers as they are stated leave the rank at this pose open".to_owned());
        }
        if dependent > 0 {
            why.push(format!(
                "{dependent} of the equations repeat the others at this pose; whether they do so all along a motion, or only \
                 here, is not settled by a rank at one pose"
            ));
        }
        (
            Verdict::Undecided,
            "the rank of the closure equations at this pose bounds the freedom from above"
                .to_owned(),
        )
    };
    Mobility {
        verdict,
        bounds: (Some(low), Some(high)),
        regular,
        certificate,
        why,
    }
}
