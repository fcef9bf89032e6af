//! What a row says of how the mechanism moves, in a word.

use crate::sweep::Status;
use kutzbach_mobility::{PoseKind, Verdict};

/// What the columns of a row hold that an answer is made of.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Said<'a> {
    pub status: &'a str,
    /// None where the sweep went no further than the rank.
    pub verdict: Option<&'a str>,
    pub finite: &'a str,
    pub instantaneous: &'a str,
    pub pose: &'a str,
    pub locked: &'a str,
}

/// An answer; the order is that of the legend.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Answer {
    /// It moves.
    Mobile {
        /// Finite freedom, where it is known.
        freedom: Option<u32>,
        /// Whether the pose is singular.
        singular: bool,
        /// Whether joints are locked.
        locks: bool,
    },
    /// It does not.
    Rigid {
        /// Whether the pose is singular: it gives a little.
        singular: bool,
    },
    /// Where the rank alone was asked for: instantaneous freedom.
    Instantaneous(u32),
    /// Not decided.
    Undecided,
    /// No closed pose was found.
    Unassembled,
    /// The file is no mechanism with these values.
    Invalid,
}

impl Answer {
    /// The answer of a row; `None` where a word is none that a sweep writes.
    pub fn of(said: &Said<'_>) -> Option<Self> {
        if said.status == Status::Invalid.word() {
            return Some(Self::Invalid);
        }
        if said.status == Status::Unassembled.word() {
            return Some(Self::Unassembled);
        }
        if said.status != Status::Analysed.word() {
            return None;
        }
        let Some(verdict) = said.verdict else {
            return Some(match said.instantaneous.parse() {
                Ok(freedom) => Self::Instantaneous(freedom),
                Err(_) => Self::Undecided,
            });
        };
        let singular = said.pose == PoseKind::Singular.word();
        Some(match Verdict::from_word(verdict)? {
            Verdict::Mobile => Self::Mobile {
                freedom: said.finite.parse().ok(),
                singular,
                locks: !said.locked.is_empty(),
            },
            Verdict::Rigid => Self::Rigid { singular },
            Verdict::Undecided => Self::Undecided,
            Verdict::Unassembled => Self::Unassembled,
        })
    }

    /// Whether there is one: it was analysed.
    pub fn is_analysed(self) -> bool {
        !matches!(self, Self::Unassembled | Self::Invalid)
    }

    /// What has to differ for a border: whether and how much it moves.
    pub fn side(self) -> Self {
        match self {
            Self::Mobile { freedom, .. } => Self::Mobile {
                freedom,
                singular: false,
                locks: false,
            },
            Self::Rigid { .. } => Self::Rigid { singular: false },
            other => other,
        }
    }

    /// In words.
    pub fn label(self) -> String {
        match self {
            Self::Mobile {
                freedom,
                singular,
                locks,
            } => {
                let mut label = Verdict::Mobile.word().to_owned();
                if let Some(freedom) = freedom {
                    label.push_str(&format!(", {freedom} DOF"));
                }
                if singular {
                    label.push_str(", singular");
                }
                if locks {
                    label.push_str(", locked joints");
                }
                label
            }
            Self::Rigid { singular: false } => Verdict::Rigid.word().to_owned(),
            Self::Rigid { singular: true } => format!("{}, singular", Verdict::Rigid.word()),
            Self::Instantaneous(freedom) => format!("{freedom} DOF at this pose"),
            Self::Undecided => Verdict::Undecided.word().to_owned(),
            Self::Unassembled => Status::Unassembled.word().to_owned(),
            Self::Invalid => Status::Invalid.word().to_owned(),
        }
    }

    /// The class of its colour; those of three freedoms and more are alike.
    pub fn class(self) -> String {
        // Of what moves there are three shades of each colour.
        let shade = |freedom: u32| freedom.clamp(1, 3);
        match self {
            Self::Mobile {
                freedom,
                singular,
                locks,
            } => {
                let colour = match (singular, locks) {
                    (true, _) => "singular",
                    (false, true) => "locks",
                    (false, false) => "moves",
                };
                format!("{colour}{}", shade(freedom.unwrap_or(1)))
            }
            Self::Rigid { singular: false } | Self::Instantaneous(0) => "rigid".to_owned(),
            Self::Rigid { singular: true } => "shaky".to_owned(),
            Self::Instantaneous(freedom) => format!("moves{}", shade(freedom)),
            Self::Undecided => "undecided".to_owned(),
            Self::Unassembled => "unassembled".to_owned(),
            Self::Invalid => "invalid".to_owned(),
        }
    }
}
