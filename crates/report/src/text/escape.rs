//! Text that came from a file, made harmless and measured.
//!
//! A name may hold terminal escapes, line breaks or characters that reorder what follows. They are shown, not obeyed.

use std::borrow::Cow;

/// The text with every character that would steer a terminal or hide itself written out, as in `\u{1b}`.
///
/// Control characters (C0, DEL, C1), line and paragraph separators, bidirectional controls, zero-width characters and
/// the byte order mark. Everything else stays as it is.
#[must_use]
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if is_hidden(c) {
            shown.extend(c.escape_default());
        } else {
            shown.push(c);
        }
    }
    Cow::Owned(shown)
}

fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

/// How many terminal columns a text takes: combining marks none, East Asian wide characters and pictographs two.
#[must_use]
pub fn columns(text: &str) -> usize {
    text.chars().map(char_columns).sum()
}

/// Ranges after Unicode Standard Annex 11, coarse: whole blocks instead of single characters.
fn char_columns(c: char) -> usize {
    match c {
        '\u{300}'..='\u{36f}'
        | '\u{483}'..='\u{489}'
        | '\u{591}'..='\u{5bd}'
        | '\u{64b}'..='\u{65f}'
        | '\u{1ab0}'..='\u{1aff}'
        | '\u{1dc0}'..='\u{1dff}'
        | '\u{20d0}'..='\u{20ff}'
        | '\u{fe00}'..='\u{fe0f}'
        | '\u{fe20}'..='\u{fe2f}' => 0,
        '\u{1100}'..='\u{115f}'
        | '\u{2e80}'..='\u{303e}'
        | '\u{3041}'..='\u{a4cf}'
        | '\u{ac00}'..='\u{d7a3}'
        | '\u{f900}'..='\u{faff}'
        | '\u{fe30}'..='\u{fe6f}'
        | '\u{ff00}'..='\u{ff60}'
        | '\u{ffe0}'..='\u{ffe6}'
        | '\u{1f300}'..='\u{1f64f}'
        | '\u{1f900}'..='\u{1f9ff}'
        | '\u{20000}'..='\u{3fffd}' => 2,
        _ => 1,
    }
}

/// The text cut to a number of columns, the last of them `…` where something was cut.
#[must_use]
pub fn clipped(text: &str, limit: usize) -> Cow<'_, str> {
    if columns(text) <= limit {
        return Cow::Borrowed(text);
    }
    if limit == 0 {
        return Cow::Borrowed("");
    }
    let mut used = 0;
    let mut cut = String::new();
    for c in text.chars() {
        let wide = char_columns(c);
        if used + wide > limit - 1 {
            break;
        }
        used += wide;
        cut.push(c);
    }
    cut.push('…');
    Cow::Owned(cut)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn escapes_are_shown() {
        assert_eq!(visible("a\u{1b}[31mb\n"), "a\\u{1b}[31mb\\n");
        assert_eq!(visible("x\u{202e}y\u{9b}"), "x\\u{202e}y\\u{9b}");
        assert!(matches!(visible("Kurbel 曲柄"), Cow::Borrowed(_)));
    }

    #[test]
    fn wide_and_combining_characters_are_measured() {
        assert_eq!(columns("曲柄"), 4);
        assert_eq!(columns("e\u{301}"), 1);
        assert_eq!(clipped("曲柄曲柄", 6), "曲柄…");
        assert_eq!(clipped("crank", 5), "crank");
        assert_eq!(clipped("cranks", 5), "cran…");
    }

    proptest! {
        #[test]
        fn nothing_steers_the_terminal(text in any::<String>(), limit in 0usize..20) {
            let shown = visible(&text);
            prop_assert!(!shown.chars().any(char::is_control));
            prop_assert!(columns(&clipped(&shown, limit)) <= limit);
        }
    }
}
