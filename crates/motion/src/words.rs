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

impl Display for EndReason {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::JointLimit { variable, value } => {
                write!(
                    out,
                    "joint limit of {} at {}",
                    variable.name,
                    value_text(*value)
                )
            }
            Self::GoesOn => out.write_str("it goes on; followed far enough"),
            Self::CannotGoOn => out.write_str("no pose is found beyond"),
        }
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

impl Display for EventKind {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::DeadCentre {
                variable,
                value,
                greatest,
            } => write!(
                out,
                "{} at its {}, {}",
                variable.name,
                if *greatest { "maximum" } else { "minimum" },
                value_text(*value)
            )?,
            Self::JointLimit { variable, value } => write!(
                out,
                "joint limit of {}: {}",
                variable.name,
                value_text(*value)
            )?,
            Self::Singular {
                freedom, excess: 0, ..
            } => write!(
                out,
                "input singularity: the joints held do not determine the motion here (freedom {freedom})"
            )?,
            Self::Singular {
                freedom, crosses, ..
            } => write!(
                out,
                "singular pose, freedom {freedom}: {}",
                if *crosses {
                    "branches cross (bifurcation)"
                } else {
                    "branches touch (tangential)"
                }
            )?,
            Self::Cusp { .. } => out.write_str("cusp: the motion turns back on its other half")?,
        }
        if self.is_home() {
            out.write_str(", the pose analysed")?;
        }
        Ok(())
    }
}
