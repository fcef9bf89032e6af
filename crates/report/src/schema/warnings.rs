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
    /// What other readers do not heed, or read in another way.
    ReadersDiffer,
    /// A limit that is none.
    NoLimit,
    /// A joint that closes a loop by giving a link a second place.
    ClosesLoop,
    /// Something of another program is read as an element of this format.
    ReadAs,
    /// A joint says what is said elsewhere.
    SaidTwice,
    /// Two joints between the same two links, in different places of the file.
    SameLinks,
    /// A joint with the name of another one is called otherwise here.
    Renamed,
    /// Joints inside `<gazebo>` are read.
    InGazebo,
    /// An element looks like a call of a macro and is none, or of one that nobody defines.
    NotCalled,
    /// What XML does not allow is read all the same.
    NotXml,
    /// What the file itself has to say.
    Said,
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
    /// The names that its kind speaks of, in this order: what is meaningless and for what; the old name and the new one; the joint, the
    /// link and the joint that places it where a loop is closed; the joint and the element that it is read as, or the joint like it, or
    /// what it is called; the element that is no call.
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
        let (kind, names): (_, Vec<&String>) = match &warning.kind {
            Kind::Guessed => (WarningKind::Guessed, vec![]),
            Kind::MayJoin => (WarningKind::MayJoin, vec![]),
            Kind::Meaningless { what, of } => (WarningKind::Meaningless, vec![what, of]),
            Kind::OldName { old, new } => (WarningKind::OldName, vec![old, new]),
            Kind::ReadersDiffer { what } => (WarningKind::ReadersDiffer, vec![what]),
            Kind::NoLimit => (WarningKind::NoLimit, vec![]),
            Kind::ClosesLoop { joint, link, other } => {
                (WarningKind::ClosesLoop, vec![joint, link, other])
            }
            Kind::ReadAs { joint, element } => (WarningKind::ReadAs, vec![joint, element]),
            Kind::SaidTwice { joint } => (WarningKind::SaidTwice, vec![joint]),
            Kind::SameLinks { joint, other } => (WarningKind::SameLinks, vec![joint, other]),
            Kind::Renamed { joint, called } => (WarningKind::Renamed, vec![joint, called]),
            Kind::InGazebo { .. } => (WarningKind::InGazebo, vec![]),
            Kind::NotCalled { element } => (WarningKind::NotCalled, vec![element]),
            Kind::NotXml => (WarningKind::NotXml, vec![]),
            Kind::Said => (WarningKind::Said, vec![]),
        };
        Self {
            kind,
            place: Some(WarningPlace {
                line: warning.line,
                column: warning.column,
                count: warning.count,
            }),
            names: names.into_iter().cloned().collect(),
            text: warning.message.clone(),
        }
    }
}
