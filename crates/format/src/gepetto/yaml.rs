//! A small YAML file as words, lists and entries, with the place of each.

use crate::error::{Fault, Outcome};
use saphyr_parser::{Event, Parser};
use std::ops::Range;

/// Lists in lists; the files have two levels below an entry.
const DEEPEST: usize = 8;

/// A robot has dozens of joints.
const MOST_BYTES: usize = 1 << 20;

/// A piece of text and where it stands.
pub(super) struct Word {
    pub(super) text: String,
    pub(super) at: Range<usize>,
}

/// A value and where it begins.
pub(super) struct Node {
    pub(super) said: Said,
    pub(super) at: Range<usize>,
}

/// What a value is.
pub(super) enum Said {
    Word(String),
    List(Vec<Node>),
    /// Keys and values in turn.
    Entries(Vec<Node>),
    Nothing,
}

impl Word {
    pub(super) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault::new(self.at.clone(), message)
    }
}

impl Node {
    pub(super) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault::new(self.at.clone(), message)
    }
}

/// The entries of a file, each key once.
pub(super) fn entries(text: &str) -> Outcome<Vec<(Word, Node)>> {
    let node = value(text)?;
    let at = node.fault("needed entries such as `closed_loop: [[one, other]]`");
    let Said::Entries(items) = node.said else {
        return Err(at);
    };
    let mut entries: Vec<(Word, Node)> = Vec::new();
    let mut items = items.into_iter();
    while let (Some(key), Some(value)) = (items.next(), items.next()) {
        let Said::Word(text) = key.said else {
            return Err(Fault::new(key.at, "needed a word as the name of an entry"));
        };
        let key = Word { text, at: key.at };
        if entries.iter().any(|(known, _)| known.text == key.text) {
            return Err(key
                .fault("there are two entries of this name")
                .help("remove one of the two"));
        }
        entries.push((key, value));
    }
    Ok(entries)
}

/// The value of the first document.
fn value(text: &str) -> Outcome<Node> {
    if text.len() > MOST_BYTES {
        let message = "a description of loops has no more than 1 MiB";
        return Err(Fault::new(0..0, message));
    }
    let mut places = Places::new(text);
    let mut open: Vec<Node> = Vec::new();
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| {
            let at = places.byte(error.marker().index());
            Fault::new(at..at, format!("this is no YAML: {}", error.info()))
        })?;
        let start = places.byte(span.start.index());
        let node = |said: Said, end: usize| Node {
            said,
            at: start..end.max(start),
        };
        let done = match event {
            Event::SequenceStart(..) | Event::MappingStart(..) if open.len() >= DEEPEST => {
                let message = format!("lists are nested more than {DEEPEST} levels deep");
                return Err(Fault::new(start..start, message));
            }
            Event::SequenceStart(..) => {
                open.push(node(Said::List(Vec::new()), start + 1));
                continue;
            }
            Event::MappingStart(..) => {
                open.push(node(Said::Entries(Vec::new()), start + 1));
                continue;
            }
            Event::SequenceEnd | Event::MappingEnd => match open.pop() {
                Some(done) => done,
                None => continue,
            },
            Event::Scalar(word, ..) if word.is_empty() => node(Said::Nothing, start),
            Event::Scalar(word, ..) => {
                let end = places.byte(span.end.index());
                node(Said::Word(word.into_owned()), end)
            }
            Event::Alias(_) => {
                return Err(Fault::new(start..start, "aliases are not read here")
                    .help("write the names out"));
            }
            Event::DocumentEnd => break,
            _ => continue,
        };
        match open.last_mut().map(|outer| &mut outer.said) {
            Some(Said::List(items) | Said::Entries(items)) => items.push(done),
            _ => return Ok(done),
        }
    }
    Ok(Node {
        said: Said::Nothing,
        at: 0..0,
    })
}

/// Where characters are, asked for in their order.
struct Places<'t> {
    text: &'t str,
    /// How many characters lie before the place looked at last, and how many bytes.
    characters: usize,
    bytes: usize,
}

impl<'t> Places<'t> {
    fn new(text: &'t str) -> Self {
        Self {
            text,
            characters: 0,
            bytes: 0,
        }
    }

    /// The first byte of a character; one before those asked for already is taken for the last of them.
    fn byte(&mut self, character: usize) -> usize {
        let rest = self.text.get(self.bytes..).unwrap_or_default();
        let more = character.saturating_sub(self.characters);
        for known in rest.chars().take(more) {
            self.characters += 1;
            self.bytes += known.len_utf8();
        }
        self.bytes
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn words_have_their_places() {
        let text =
            "# ä\nclosed_loop: [['é_A', \"b\"],\n  [c, d]]\ntype:\n- 6d\n- 3d\nname_mot: mot\n";
        let entries = entries(text).unwrap();
        let keys: Vec<&str> = entries.iter().map(|(key, _)| &key.text[..]).collect();
        assert_eq!(keys, ["closed_loop", "type", "name_mot"]);
        for (key, _) in &entries {
            assert_eq!(&text[key.at.clone()], key.text);
        }
        let Said::List(pairs) = &entries[0].1.said else {
            panic!("no list");
        };
        let Said::List(pair) = &pairs[0].said else {
            panic!("no pair");
        };
        let Said::Word(word) = &pair[0].said else {
            panic!("no word");
        };
        assert_eq!(word, "é_A");
        assert_eq!(&text[pair[0].at.clone()], "'é_A'");
    }

    #[test]
    fn what_is_no_such_file_is_a_fault() {
        for (text, told) in [
            ("- a\n- b", "needed entries"),
            ("", "needed entries"),
            ("a: [", "no YAML"),
            ("a: 1\na: 2", "two entries"),
            ("a: &x [b]\nc: *x", "aliases"),
            ("[a]: b", "as the name of an entry"),
            ("a: [[[[[[[[[[b]]]]]]]]]]", "levels deep"),
        ] {
            let fault = entries(text).err().unwrap();
            assert!(fault.message.contains(told), "{text}: {}", fault.message);
        }
        let deep = format!("a: {}", "[".repeat(100_000));
        assert!(entries(&deep).is_err());
    }
}
