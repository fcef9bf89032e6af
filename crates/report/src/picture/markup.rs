//! Text and numbers as XML wants them.

use crate::text::visible;
use std::fmt::{Arguments, Write};

/// Appends formatted text; writing to a `String` cannot fail.
pub fn put(text: &mut String, arguments: Arguments<'_>) {
    let _ = text.write_fmt(arguments);
}

/// A name for text and attributes of XML 1.0 and HTML alike: control characters written out, markup escaped, the two
/// characters that XML knows no way to write replaced.
#[must_use]
pub fn escaped(text: &str) -> String {
    let shown = visible(text);
    let mut result = String::with_capacity(shown.len() + 8);
    for character in shown.chars() {
        match character {
            '&' => result.push_str("&amp;"),
            '<' => result.push_str("&lt;"),
            '>' => result.push_str("&gt;"),
            '"' => result.push_str("&quot;"),
            '\'' => result.push_str("&#39;"),
            '\u{fffe}' | '\u{ffff}' => result.push('\u{fffd}'),
            c => result.push(c),
        }
    }
    result
}

/// Farther out than any picture is large; keeps a coordinate that went astray short.
const FAR: f64 = 1e6;

/// A coordinate in pixels with at most one decimal; what is not a number is zero, and nothing is farther than a million.
#[must_use]
pub fn px(value: f64) -> String {
    let value = if value.is_nan() {
        0.0
    } else {
        value.clamp(-FAR, FAR)
    };
    let mut text = format!("{value:.1}");
    let kept = text.trim_end_matches('0').trim_end_matches('.').len();
    text.truncate(kept);
    if text == "-0" { "0".to_owned() } else { text }
}

/// About how wide a text is in the usual sans-serif faces, in parts of the font size.
const CHARACTER: f64 = 0.57;

/// Estimated width of a text (px). Wide scripts take twice the room.
#[must_use]
pub fn text_width(text: &str, size: f64) -> f64 {
    crate::text::columns(text) as f64 * CHARACTER * size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_short_and_finite() {
        let cases = [
            (1.0, "1"),
            (-0.04, "0"),
            (0.25, "0.2"),
            (10.0, "10"),
            (-12.35, "-12.3"),
            (f64::NAN, "0"),
            (f64::INFINITY, "1000000"),
        ];
        for (value, text) in cases {
            assert_eq!(px(value), text);
        }
    }

    #[test]
    fn names_are_text() {
        assert_eq!(
            escaped("<img src=x onerror=1>"),
            "&lt;img src=x onerror=1&gt;"
        );
        assert_eq!(
            escaped("a\u{1b}\u{202e}\"&'"),
            "a\\u{1b}\\u{202e}&quot;&amp;&#39;"
        );
        assert_eq!(escaped("\u{ffff}"), "\u{fffd}");
    }
}
