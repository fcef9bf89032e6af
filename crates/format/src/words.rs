//! Words in messages: quoting what a file says, and naming the known word that is nearest to an unknown one.

use std::borrow::Cow;
use std::fmt::Write as _;
use strsim::levenshtein;

/// A piece of the file in backticks, cut where it is too long for a message.
pub(super) fn quoted(text: &str) -> String {
    format!("`{}`", cut(text))
}

/// A piece of the file, cut where it is too long for a message.
pub(super) fn cut(text: &str) -> Cow<'_, str> {
    const LONGEST: usize = 60;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => Cow::Owned(format!("{}…", &text[..end])),
        None => Cow::Borrowed(text),
    }
}

/// `a`, `a or b`, `a, b or c`.
pub(super) fn alternatives(words: &[&str]) -> String {
    match words {
        [] => "nothing".to_owned(),
        [only] => (*only).to_owned(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

/// `a`, `a` and `b`, or `a`, `b` and 12 more, of one name or more.
pub(super) fn listed(names: &[&str]) -> String {
    const MOST: usize = 4;
    const SHOWN: usize = 2;
    let shown = if names.len() > MOST {
        SHOWN
    } else {
        names.len()
    };
    let mut parts: Vec<String> = names.iter().take(shown).map(|name| quoted(name)).collect();
    if names.len() > shown {
        parts.push(format!("{} more", names.len() - shown));
    }
    match parts.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => parts.concat(),
    }
}

/// `1 number`, `3 numbers`.
pub(super) fn counted(count: usize, what: &str) -> String {
    let mut text = format!("{count} {what}");
    if count != 1 {
        let _ = write!(text, "s");
    }
    text
}

/// A hint with the known word nearest to an unknown one, if any is near.
///
/// Looks at no more than 2000 known words, so that a message costs no more than a short moment.
pub(super) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let (distance, best) = known
        .into_iter()
        .take(2000)
        .map(|candidate| (edit_distance(word, candidate), candidate))
        .min()?;
    // Half of the letters wrong is another word.
    let letters = word.chars().count().max(2);
    (distance * 2 <= letters).then_some(best)
}

/// The hint `did you mean ...?`, with the found word put into a frame such as `<…>`.
pub(super) fn did_you_mean<'a>(
    word: &str,
    known: impl IntoIterator<Item = &'a str>,
    frame: (&str, &str),
) -> Option<String> {
    nearest(word, known).map(|best| format!("did you mean {}{best}{}?", frame.0, frame.1))
}

/// Levenshtein distance of the first 64 characters, ignoring case (`Link` is near `link`).
fn edit_distance(a: &str, b: &str) -> usize {
    const MOST: usize = 64;
    let start = |word: &str| -> String {
        word.chars()
            .take(MOST)
            .map(|c| c.to_ascii_lowercase())
            .collect()
    };
    levenshtein(&start(a), &start(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_words_are_found_and_far_ones_are_not() {
        let known = ["revolute", "prismatic", "screw"];
        assert_eq!(nearest("revolut", known), Some("revolute"));
        assert_eq!(nearest("Screw", known), Some("screw"));
        assert_eq!(nearest("banana", known), None);
        assert_eq!(nearest("x", []), None);
    }

    #[test]
    fn long_text_is_cut_between_characters() {
        assert_eq!(quoted("ab"), "`ab`");
        assert_eq!(quoted(&"é".repeat(61)), format!("`{}…`", "é".repeat(60)));
    }

    #[test]
    fn lists_read_like_sentences() {
        assert_eq!(alternatives(&["a"]), "a");
        assert_eq!(alternatives(&["a", "b", "c"]), "a, b or c");
        assert_eq!(listed(&["a"]), "`a`");
        assert_eq!(listed(&["a", "b", "c", "d"]), "`a`, `b`, `c` and `d`");
        assert_eq!(listed(&["a", "b", "c", "d", "e"]), "`a`, `b` and 3 more");
        assert_eq!(counted(1, "number"), "1 number");
        assert_eq!(counted(0, "number"), "0 numbers");
    }
}
