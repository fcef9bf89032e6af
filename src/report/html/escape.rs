//! Text from files inside markup and inside data.

use crate::report::text::visible;

/// Text as it may stand between tags and in quoted attributes; control characters are written out.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in visible(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

/// JSON as it may stand in a script element: no `<`, which could end the element or open a comment.
#[must_use]
pub fn in_script(json: &str) -> String {
    // Outside strings JSON has no such character, inside it may be written so.
    json.replace('<', "\\u003c")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_ends_an_attribute_or_an_element() {
        let text = escaped("<a href=\"x\" class='y'>&\u{202e}");
        assert!(!text.contains(['<', '>', '"', '\'']));
        assert!(text.contains("&amp;\\u{202e}"));
        assert_eq!(in_script("[\"</script>\"]"), "[\"\\u003c/script>\"]");
    }
}
