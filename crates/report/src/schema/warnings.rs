//! What a careful reader should know.

use serde::{Deserialize, Serialize};

/// What a warning is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WarningKind {
    /// Something was taken for granted that the file does not say.
    Guessed,
    /// Something is not read that names two joints or links: the answer may be about another mechanism than the one meant.
    MayJoin,
    /// Something in the file has no meaning where it stands, and is ignored.
    Meaningless,
    /// Something in the file has a name of old.
    OldName,
    /// Anything else about the file.
    File,
    /// The pose asked for closes in another configuration than the one drawn.
    OtherConfiguration,
    /// The pose is outside joint limits.
    OutsideLimits,
    /// Joint limits that let something stand still.
    Limits,
    /// Joints that cannot start the motion at this pose.
    ExtremePosition,
    /// What holds at this singular pose need not hold elsewhere.
    SingularPose,
    /// A singular pose is near.
    NearlySingular,
    /// Couplings hold what the loops leave free.
    LockedTogether,
    /// Links that no joint connects to the ground.
    LooseLinks,
    /// The numbers were taken literally.
    TakenLiterally,
    /// The loops shown are another basis than usual.
    Cycles,
    /// What was asked for cannot be told.
    Unanswered,
}

impl WarningKind {
    /// Whether it belongs to the first lines: what is wrong with the pose, or with what holds there, or may hold, and what the
    /// file left to be guessed.
    #[must_use]
    pub fn is_told_first(self) -> bool {
        matches!(
            self,
            Self::Guessed
                | Self::MayJoin
                | Self::OtherConfiguration
                | Self::OutsideLimits
                | Self::ExtremePosition
                | Self::SingularPose
                | Self::NearlySingular
                | Self::LockedTogether
        )
    }
}

/// Where a file gives cause for a warning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct WarningPlace {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// How often the file gives cause for it; the place is that of the first time.
    pub count: usize,
}

/// A warning.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Warning {
    /// What it is about.
    pub kind: WarningKind,
    /// Where the file gives cause for it; `null` where the mechanism does.
    pub place: Option<WarningPlace>,
    /// The names that its kind speaks of: what is meaningless and for what, the old name and the new one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<String>,
    /// In words.
    pub text: String,
}

impl Warning {
    /// A warning about the mechanism.
    #[must_use]
    pub fn new(kind: WarningKind, text: impl Into<String>) -> Self {
        Self {
            kind,
            place: None,
            names: Vec::new(),
            text: text.into(),
        }
    }

    /// What it says, and before that the place, where it speaks of a single one.
    pub(crate) fn placed(&self) -> (String, String) {
        let Some(WarningPlace {
            line,
            column,
            count,
        }) = self.place
        else {
            return (String::new(), self.text.clone());
        };
        let place = format!("line {line}, column {column}");
        match count {
            1 => (place, self.text.clone()),
            _ => {
                let text = format!("{} ({count} times, first at {place})", self.text);
                (String::new(), text)
            }
        }
    }
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (place, text) = self.placed();
        match place.as_str() {
            "" => f.write_str(&text),
            place => write!(f, "{place}: {text}"),
        }
    }
}

impl From<&kutzbach_format::Warning> for Warning {
    fn from(warning: &kutzbach_format::Warning) -> Self {
        use kutzbach_format::WarningKind as Kind;
        let (kind, names) = match &warning.kind {
            Kind::Other => (WarningKind::File, Vec::new()),
            Kind::Guessed => (WarningKind::Guessed, Vec::new()),
            Kind::MayJoin => (WarningKind::MayJoin, Vec::new()),
            Kind::Meaningless { what, of } => {
                (WarningKind::Meaningless, vec![what.clone(), of.clone()])
            }
            Kind::OldName { old, new } => (WarningKind::OldName, vec![old.clone(), new.clone()]),
        };
        Self {
            kind,
            place: Some(WarningPlace {
                line: warning.line,
                column: warning.column,
                count: warning.count,
            }),
            names,
            text: warning.message.clone(),
        }
    }
}
