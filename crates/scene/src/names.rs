//! Names of frames and joints in a log: as in the file where possible, unique and readable always.

use kutzbach_model::mechanism::Mechanism;
use std::borrow::Cow;
use std::collections::BTreeSet;

/// Which motion something belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stream {
    /// The motion that the closure equations predict.
    Predicted,
    /// The motion of the simulated bodies.
    Simulated,
}

impl Stream {
    /// Both, in the order of the log.
    pub const BOTH: [Self; 2] = [Self::Predicted, Self::Simulated];

    /// The name of its root frame, and the first part of the names of its other frames.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Predicted => "predicted",
            Self::Simulated => "simulated",
        }
    }

    /// A topic of this stream: that of the prediction bears the plain name.
    pub(super) fn topic(self, name: &str) -> String {
        match self {
            Self::Predicted => format!("/{name}"),
            Self::Simulated => format!("/simulated/{name}"),
        }
    }
}

/// The name of a link's frame: `predicted/crank`.
#[must_use]
pub fn frame_id(stream: Stream, link: &str) -> String {
    format!("{}/{}", stream.word(), readable(link))
}

/// A name without control characters and others that XML cannot hold: these are written as `\u{…}`, and so is the
/// backslash in such a name, so that different names stay different. All other names stay as they are, unless they
/// contain a backslash themselves.
#[must_use]
pub fn readable(name: &str) -> Cow<'_, str> {
    let strange = |c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}' | '\\');
    if !name.chars().any(strange) {
        return Cow::Borrowed(name);
    }
    let mut text = String::with_capacity(name.len() + 16);
    for character in name.chars() {
        if strange(character) {
            text.extend(character.escape_unicode());
        } else {
            text.push(character);
        }
    }
    Cow::Owned(text)
}

/// One name per joint variable, in the order of the joints; where two joints would share one, it is told apart by `#` and
/// the index of the joint.
pub fn variable_names(mechanism: &Mechanism) -> Vec<Vec<String>> {
    let mut taken = BTreeSet::new();
    let mut names: Vec<Vec<String>> = Vec::with_capacity(mechanism.joints().len());
    for (index, joint) in mechanism.joints().iter().enumerate() {
        let own = (0..joint.freedom()).map(|freedom| {
            let name = readable(&joint.freedom_name(freedom)).into_owned();
            let mut unique = name.clone();
            while !taken.insert(unique.clone()) {
                unique = format!("{unique}#{index}");
            }
            unique
        });
        names.push(own.collect());
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_unless_they_cannot() {
        for name in ["crank", "a/b c", "Größe", "<&\"'>", "../..", "机构"] {
            assert_eq!(readable(name), name);
        }
        assert_eq!(frame_id(Stream::Simulated, "a\nb"), "simulated/a\\u{a}b");
    }

    #[test]
    fn different_names_stay_different() {
        let names = [
            "a\nb",
            "a\\u{a}b",
            "a\\nb",
            "a b",
            "a\u{fffe}",
            "a\\u{fffe}",
            "a\\",
            "a",
        ];
        let seen: BTreeSet<String> = names.iter().map(|n| readable(n).into_owned()).collect();
        assert_eq!(seen.len(), names.len(), "{seen:?}");
        for name in seen {
            assert!(!name.chars().any(char::is_control));
        }
    }
}
