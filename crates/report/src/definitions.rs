//! What the words of a report mean: the numbered definitions of the book (`docs/src/definitions.md`), looked up by word.
//!
//! The book's page is compiled in and read here; a copy of it lies in this crate, so that it can be packaged. A definition opens with a heading
//! `## D3 Instantaneous freedom {#instantaneous}`, may list further words on a line `Also: …`, and runs to the next heading.

use strsim::levenshtein;

/// The book's page.
const PAGE: &str = include_str!("../definitions.md");

/// One numbered definition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// Its number, `D3`.
    pub number: &'static str,
    /// Its title, `Instantaneous freedom`.
    pub title: &'static str,
    /// Its anchor in the book, `instantaneous`.
    pub anchor: &'static str,
    /// Other words that it explains.
    pub also: Vec<&'static str>,
    /// Its text, as in the book: paragraphs, points and one block of formulas.
    pub body: &'static str,
}

impl Definition {
    /// Whether the definition explains this word; case, hyphens and underscores do not matter.
    #[must_use]
    pub fn explains(&self, word: &str) -> bool {
        let word = normal(word);
        [self.number, self.title, self.anchor]
            .iter()
            .chain(&self.also)
            .any(|own| normal(own) == word)
    }
}

/// All definitions, in the order of their numbers.
#[must_use]
pub fn all() -> Vec<Definition> {
    PAGE.split("\n## ").skip(1).filter_map(parse).collect()
}

/// The definition of a word: its own one before one that mentions it beside others.
#[must_use]
pub fn find(word: &str) -> Option<Definition> {
    let mut definitions = all();
    let wanted = normal(word);
    let own = definitions.iter().position(|d| {
        [d.number, d.title, d.anchor]
            .iter()
            .any(|own| normal(own) == wanted)
    });
    let index = own.or_else(|| definitions.iter().position(|d| d.explains(word)))?;
    Some(definitions.swap_remove(index))
}

/// The known word closest to an unknown one, if one is close: at most a third of its letters differ.
#[must_use]
pub fn nearest(word: &str) -> Option<&'static str> {
    closest(
        word,
        all()
            .iter()
            .flat_map(|d| [d.anchor].into_iter().chain(d.also.iter().copied())),
    )
}

/// The name closest to a misspelt one, if one is close: at most a third of its letters differ.
#[must_use]
pub fn closest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let wanted: String = normal(word).chars().take(64).collect();
    known
        .map(|known| (levenshtein(&wanted, &normal(known)), known))
        .min()
        .filter(|(distance, known)| 3 * distance <= known.chars().count().max(3))
        .map(|(_, known)| known)
}

fn parse(section: &'static str) -> Option<Definition> {
    let (heading, body) = section.split_once('\n')?;
    let (number, rest) = heading.split_once(' ')?;
    let (title, anchor) = rest.split_once("{#")?;
    let body = body.trim();
    let (also, body) = match body.strip_prefix("Also: ") {
        Some(rest) => {
            let (words, body) = rest.split_once('\n')?;
            (words.split(", ").map(str::trim).collect(), body.trim())
        }
        None => (Vec::new(), body),
    };
    Some(Definition {
        number,
        title: title.trim(),
        anchor: anchor.trim_end_matches('}'),
        also,
        body,
    })
}

fn normal(word: &str) -> String {
    word.trim().to_lowercase().replace(['-', '_'], " ")
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{CertificateLevel, MobilityClass, PoseKind, SingularKind, Verdict};

    #[test]
    fn definitions_are_numbered_without_gaps_and_complete() {
        for (index, definition) in all().iter().enumerate() {
            assert_eq!(definition.number, format!("D{}", index + 1));
            for part in ["```text\n", "Source: "] {
                assert!(
                    definition.body.contains(part),
                    "{} lacks {part}",
                    definition.number
                );
            }
            assert!(
                definition.body.contains("Decided by: `kutzbach::"),
                "{} does not say what decides it",
                definition.number
            );
        }
        assert!(all().len() >= 20);
    }

    #[test]
    fn every_word_of_a_report_is_defined() {
        let mut words = vec![
            "freedom",
            "Kutzbach count",
            "instantaneous",
            "finite",
            "redundant",
            "regular",
            "singular",
            "branch",
            "locked",
            "idle",
            "class",
            "certificate",
            "stated precision",
            "basic cycle",
            "low-depth tree",
            "generic count",
            "assembled",
            "nominal",
            "gap",
            "verdict",
            "half-branch",
            "relative motion",
            "evidence",
        ];
        words.extend(SingularKind::ALL.iter().map(|w| w.word()));
        words.extend(PoseKind::ALL.iter().map(|w| w.word()));
        words.extend(Verdict::ALL.iter().map(|w| w.word()));
        words.extend(MobilityClass::ALL.iter().map(|w| w.word()));
        words.extend(CertificateLevel::ALL.iter().map(|w| w.word()));
        for word in words {
            assert!(find(word).is_some(), "`{word}` is not defined");
        }
    }

    #[test]
    fn a_words_own_definition_comes_first() {
        assert_eq!(find("d9").unwrap().anchor, "locked");
        assert_eq!(find("Permanently-Shaky").unwrap().number, "D7");
        assert_eq!(find("subgroup").unwrap().number, "D12");
        assert_eq!(find("walrus"), None);
    }

    #[test]
    fn misspelt_words_have_a_suggestion() {
        assert_eq!(nearest("redundent"), Some("redundant"));
        assert_eq!(nearest("kinematotrop"), Some("kinematotropic"));
        assert_eq!(nearest("xylophone"), None);
        assert_eq!(nearest(&"x".repeat(10_000)), None);
    }
}
