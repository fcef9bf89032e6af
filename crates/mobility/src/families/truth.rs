//! What is known of a mechanism, and whether an analysis says so.

use crate::{Analysis, PoseKind, Verdict};

/// What is true of a mechanism at the pose where it is drawn, or at the closed pose nearest to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Truth {
    /// Finite freedom.
    pub finite: usize,
    /// Instantaneous freedom.
    pub instantaneous: usize,
    /// Regular or singular.
    pub pose: PoseKind,
    /// Branches through the pose.
    pub branches: usize,
}

/// How an analysis compares with the truth.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// A verdict was given, and all that was decided is true.
    Right,
    /// No verdict was given, and all that was decided is true.
    Undecided,
    /// Something that was decided is not true, or something true was excluded: what, one sentence each.
    Wrong(Vec<String>),
}

impl Outcome {
    /// The word for it: `right`, `undecided` or `wrong`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Undecided => "undecided",
            Self::Wrong(_) => "wrong",
        }
    }
}

impl Truth {
    /// Compares an analysis with this: the verdict, the bounds, the instantaneous freedom, the pose and the branches, each as
    /// far as it was decided.
    #[must_use]
    pub fn outcome(&self, analysis: &Analysis) -> Outcome {
        let mobility = &analysis.mobility;
        let mut wrong = Vec::new();
        let mut compare = |what: &str, found: Option<String>, expected: String| {
            if let Some(found) = found.filter(|found| *found != expected) {
                wrong.push(format!("{what}: found {found}, expected {expected}"));
            }
        };
        let number = |n: usize| n.to_string();
        compare("finite", mobility.finite().map(number), number(self.finite));
        compare(
            "pose",
            mobility.pose.map(|pose| pose.to_string()),
            self.pose.to_string(),
        );
        compare(
            "branches",
            analysis.branches.as_ref().map(|list| number(list.len())),
            number(self.branches),
        );
        let within = |value: usize, (low, high): (Option<usize>, Option<usize>)| {
            low.is_none_or(|low| low <= value) && high.is_none_or(|high| value <= high)
        };
        if !within(self.finite, mobility.bounds) {
            wrong.push(format!(
                "bounds {:?} exclude {}",
                mobility.bounds, self.finite
            ));
        }
        match &analysis.home {
            None => wrong.push("does not assemble".to_owned()),
            Some(home) => {
                let (low, high) = home.candidates;
                if home.instantaneous.is_some_and(|i| i != self.instantaneous)
                    || !within(self.instantaneous, (Some(low), Some(high)))
                {
                    wrong.push(format!(
                        "instantaneous: found {:?} of {low} to {high}, expected {}",
                        home.instantaneous, self.instantaneous
                    ));
                }
            }
        }
        if !wrong.is_empty() {
            Outcome::Wrong(wrong)
        } else if matches!(mobility.verdict, Verdict::Mobile | Verdict::Rigid) {
            Outcome::Right
        } else {
            Outcome::Undecided
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::families::flattening_parallelogram;
    use crate::{AnalysisOptions, analyse};
    use kutzbach_math::number::Number;

    const FLAT: Truth = Truth {
        finite: 1,
        instantaneous: 2,
        pose: PoseKind::Singular,
        branches: 2,
    };

    fn flat() -> Analysis {
        let flat = flattening_parallelogram(&Number::zero()).unwrap();
        analyse(&flat, &AnalysisOptions::default()).unwrap()
    }

    #[test]
    fn every_fact_that_is_decided_counts() {
        let found = flat();
        assert_eq!(FLAT.outcome(&found), Outcome::Right);
        for other in [
            Truth { finite: 2, ..FLAT },
            Truth {
                instantaneous: 1,
                ..FLAT
            },
            Truth {
                pose: PoseKind::Regular,
                ..FLAT
            },
            Truth {
                branches: 1,
                ..FLAT
            },
        ] {
            assert_eq!(other.outcome(&found).word(), "wrong", "{other:?}");
        }
    }

    #[test]
    fn what_is_left_open_is_no_mistake_but_what_excludes_the_truth_is() {
        let mut found = flat();
        found.mobility.verdict = Verdict::Undecided;
        found.mobility.bounds = (Some(0), Some(2));
        found.mobility.pose = None;
        found.branches = None;
        assert_eq!(FLAT.outcome(&found), Outcome::Undecided);
        found.mobility.bounds = (Some(2), Some(2));
        assert_eq!(FLAT.outcome(&found).word(), "wrong");
        found.home = None;
        let Outcome::Wrong(reasons) = FLAT.outcome(&found) else {
            panic!("a mechanism that closes was called open");
        };
        assert_eq!(reasons.len(), 2);
    }
}
