//! The few lines of a file around an error.
//!
//! A file may be one line of many megabytes and may hold terminal escapes. An excerpt holds the line of the error and one
//! line on either side, each cut to what fits a screen, with everything that would steer the terminal written out.

use kutzbach::report::text::visible;
use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};
use std::ops::Range;

/// Characters shown before and after the place, and of it.
const REACH: usize = 50;

/// Lines of a file, as they may be shown.
#[derive(Clone, Debug)]
pub struct Excerpt {
    file: String,
    text: String,
    /// Line of the first line shown, from 0.
    first_line: usize,
    /// Line and column of the place, from 0.
    place: (usize, usize),
    /// Bytes of `text` that the error is about.
    span: Range<usize>,
}

impl Excerpt {
    /// The surroundings of `span` (bytes of `source`), which begins at `line` and `column`, counted from 1.
    pub fn new(file: &str, source: &str, span: &Range<usize>, line: usize, column: usize) -> Self {
        let start = floor(source, span.start);
        let end = floor(source, span.end.max(start));
        let line_start = source[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = source[start..]
            .find('\n')
            .map_or(source.len(), |at| start + at);
        let mut text = String::new();
        let mut first_line = line.saturating_sub(1);
        if let Some(before_end) = line_start.checked_sub(1) {
            let before_start = source[..before_end].rfind('\n').map_or(0, |at| at + 1);
            text.push_str(&head(&source[before_start..before_end], 2 * REACH));
            text.push('\n');
            first_line = first_line.saturating_sub(1);
        }
        text.push_str(&tail(&source[line_start..start], REACH));
        let span_start = text.len();
        text.push_str(&head(&source[start..end.min(line_end)], REACH));
        let span_end = text.len();
        if end < line_end && !text.ends_with('…') {
            text.push_str(&head(&source[end..line_end], REACH));
        }
        text.push('\n');
        if let Some(rest) = source.get(line_end + 1..).filter(|rest| !rest.is_empty()) {
            let after_end = rest.find('\n').unwrap_or(rest.len());
            text.push_str(&head(&rest[..after_end], 2 * REACH));
            text.push('\n');
        }
        Self {
            file: visible(file).into_owned(),
            text,
            first_line,
            place: (line.saturating_sub(1), column.saturating_sub(1)),
            span: span_start..span_end,
        }
    }

    /// Bytes of the excerpt that the error is about.
    pub fn span(&self) -> SourceSpan {
        (self.span.start, self.span.len()).into()
    }
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let contents = self.text.as_str().read_span(span, before, after)?;
        // Without context it is the place itself that is asked for, which the caller knows in characters of the file.
        let (line, column) = if before == 0 {
            self.place
        } else {
            (contents.line() + self.first_line, contents.column())
        };
        Ok(Box::new(MietteSpanContents::new_named(
            self.file.clone(),
            contents.data(),
            *contents.span(),
            line,
            column,
            contents.line_count(),
        )))
    }
}

/// The first characters of a piece of a line.
fn head(text: &str, most: usize) -> String {
    let text = text.trim_end_matches('\r');
    match text.char_indices().nth(most) {
        Some((cut, _)) => format!("{}…", shown(&text[..cut])),
        None => shown(text),
    }
}

/// The last characters of a piece of a line.
fn tail(text: &str, most: usize) -> String {
    match text.char_indices().rev().nth(most) {
        Some((cut, c)) => format!("…{}", shown(&text[cut + c.len_utf8()..])),
        None => shown(text),
    }
}

/// Tabs become spaces, everything else that is not seen becomes visible.
fn shown(text: &str) -> String {
    visible(&text.replace('\t', "    ")).into_owned()
}

fn floor(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn shows_the_line_and_its_neighbours() {
        let source = "one\ntwo\nthree wrong here\nfour\nfive";
        let excerpt = Excerpt::new("f", source, &(14..19), 3, 7);
        assert_eq!(excerpt.text, "two\nthree wrong here\nfour\n");
        assert_eq!(&excerpt.text[excerpt.span.clone()], "wrong");
        assert_eq!(excerpt.first_line, 1);
    }

    #[test]
    fn endless_lines_and_escapes_stay_small_and_harmless() {
        let source = format!("{}\u{1b}[2J{}", "a".repeat(1 << 20), "b".repeat(1 << 20));
        let at = 1 << 20;
        let excerpt = Excerpt::new("f\u{7}", &source, &(at..source.len()), 1, at + 1);
        assert!(excerpt.text.len() < 400);
        assert!(!excerpt.text.contains('\u{1b}'));
        assert!(excerpt.text.starts_with("…aaa"));
        assert_eq!(excerpt.file, "f\\u{7}");
    }

    #[test]
    fn any_span_is_safe() {
        let source = "é\n\nü";
        for start in 0..8 {
            for end in 0..8 {
                let excerpt = Excerpt::new("f", source, &(start..end), 1, 1);
                assert!(excerpt.span.end <= excerpt.text.len());
            }
        }
    }
}
