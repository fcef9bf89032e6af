//! Text from files inside markup and inside data.

pub use crate::picture::markup::escaped;

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
