//! Names as XML wants them.

/// Width of a character of the usual monospace faces, in parts of the font size.
const CHARACTER: f64 = 0.61;

/// Estimated; characters outside ASCII are taken to be as wide as they are high.
pub fn text_width(text: &str, size: f64) -> f64 {
    let wide = |c: char| if c.is_ascii() { CHARACTER } else { 1.0 };
    text.chars().map(wide).sum::<f64>() * size
}

/// Text for XML 1.0: markup is escaped. Characters that XML does not allow, that cannot be seen or that reorder what follows
/// are shown as U+FFFD.
pub fn escaped(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => result.push_str("&amp;"),
            '<' => result.push_str("&lt;"),
            '>' => result.push_str("&gt;"),
            '"' => result.push_str("&quot;"),
            '\'' => result.push_str("&#39;"),
            '\t' | '\n' | '\r' => result.push(' '),
            '\u{fffe}' | '\u{ffff}' => result.push('\u{fffd}'),
            '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{feff}' => {
                result.push('\u{fffd}');
            }
            c if c.is_control() => result.push('\u{fffd}'),
            c => result.push(c),
        }
    }
    result
}
