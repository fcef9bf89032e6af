//! What a trace says, in words.

use super::inputs::Variable;
use super::result::{EndReason, EventKind};
use kutzbach_model::mechanism::{FreedomPart, Mechanism};
use std::fmt::{self, Display, Formatter};

/// A value of a joint variable for people: six digits behind the point; zero without a sign.
#[must_use]
pub fn value_text(value: f64) -> String {
    let text = format!("{value:.6}");
    if text
        .trim_start_matches('-')
        .chars()
        .all(|c| c == '0' || c == '.')
    {
        "0.000000".to_owned()
    } else {
        text
    }
}

impl Variable {
    /// The unit its values are in: `m` or `rad`.
    #[must_use]
    pub fn unit(&self, mechanism: &Mechanism) -> &'static str {
        match mechanism.joints()[self.joint].kind.freedoms()[self.freedom] {
            FreedomPart::Translation => "m",
            FreedomPart::Rotation | FreedomPart::Screw => "rad",
        }
    }
}

impl EndReason {
    /// The reason in words, with values as they are to be shown.
    #[must_use]
    pub fn told(&self, shown: &dyn Fn(&Variable, f64) -> String) -> String {
        match self {
            Self::JointLimit { variable, value } => {
                let value = shown(variable, *value);
                format!("joint limit of {} at {value}", variable.name)
            }
            Self::GoesOn => "it goes on; followed far enough".to_owned(),
            Self::CannotGoOn => "no pose is found beyond".to_owned(),
        }
    }
}

impl Display for EndReason {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        out.write_str(&self.told(&|_, value| value_text(value)))
    }
}

impl EventKind {
    /// The word for it in data.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::DeadCentre { .. } => "dead_centre",
            Self::JointLimit { .. } => "joint_limit",
            Self::Singular { excess: 0, .. } => "input_singularity",
            Self::Singular { crosses: true, .. } => "bifurcation",
            Self::Singular { crosses: false, .. } => "tangential",
            Self::Cusp { .. } => "cusp",
        }
    }

    /// The variable that meets its limit or turns back, where it is about one.
    #[must_use]
    pub fn variable(&self) -> Option<&Variable> {
        match self {
            Self::DeadCentre { variable, .. } | Self::JointLimit { variable, .. } => Some(variable),
            Self::Singular { .. } | Self::Cusp { .. } => None,
        }
    }

    /// Whether it is the pose that was analysed.
    #[must_use]
    pub fn is_home(&self) -> bool {
        matches!(
            self,
            Self::Singular { home: true, .. } | Self::Cusp { home: true }
        )
    }
}

impl EventKind {
    /// The event in words, with values as they are to be shown.
    #[must_use]
    pub fn told(&self, shown: &dyn Fn(&Variable, f64) -> String) -> String {
        let mut text = match self {
            Self::DeadCentre {
                variable,
                value,
                greatest,
            } => format!(
                "{} at its {}, {}",
                variable.name,
                if *greatest { "maximum" } else { "minimum" },
                shown(variable, *value)
            ),
            Self::JointLimit { variable, value } => format!(
                "joint limit of {}: {}",
                variable.name,
                shown(variable, *value)
            ),
            Self::Singular {
                freedom, excess: 0, ..
            } => format!(
                "input singularity: the joints held do not determine the motion here (of {freedom} instantaneous degrees of freedom)"
            ),
            Self::Singular {
                freedom, crosses, ..
            } => format!(
                "singular pose, {freedom} instantaneous degrees of freedom: {}",
                if *crosses {
                    "branches cross (bifurcation)"
                } else {
                    "branches touch (tangential)"
                }
            ),
            Self::Cusp { .. } => "cusp: the motion turns back on its other half".to_owned(),
        };
        if self.is_home() {
            text.push_str(", the pose analysed");
        }
        text
    }
}

impl Display for EventKind {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        out.write_str(&self.told(&|_, value| value_text(value)))
    }
}
