//! A page under construction: headings, wrapped paragraphs and tables.

use super::escape::{columns, visible};
use super::style::{Layout, NARROWEST_PAGE, Tint};
use super::table::Table;

/// A page of text.
#[derive(Debug)]
pub struct Page {
    layout: Layout,
    text: String,
}

impl Page {
    /// An empty page.
    #[must_use]
    pub fn new(layout: Layout) -> Self {
        Self {
            layout,
            text: String::new(),
        }
    }

    /// How it is laid out.
    #[must_use]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// A heading, set off from what came before.
    pub fn heading(&mut self, title: &str) {
        self.gap();
        self.text
            .push_str(&Tint::Strong.paint(&visible(title), self.layout.color));
        self.text.push('\n');
    }

    /// A blank line, unless the page is empty.
    pub fn gap(&mut self) {
        if !self.text.is_empty() {
            self.text.push('\n');
        }
    }

    /// A paragraph, wrapped to the page; the first line is indented by `first`, all others by `rest`.
    pub fn paragraph(&mut self, text: &str, tint: Tint, first: &str, rest: &str) {
        let text = visible(text);
        let width = self.layout.width.max(NARROWEST_PAGE);
        let mut lead = first;
        for line in wrapped(
            &text,
            width.saturating_sub(columns(first).max(columns(rest))),
        ) {
            self.text.push_str(lead);
            self.text.push_str(&tint.paint(&line, self.layout.color));
            self.text.push('\n');
            lead = rest;
        }
    }

    /// A line that keeps its spaces, such as a formula; never wrapped.
    pub fn formula(&mut self, line: &str, indent: &str) {
        self.text.push_str(indent);
        self.text
            .push_str(&Tint::Strong.paint(&visible(line), self.layout.color));
        self.text.push('\n');
    }

    /// A point of a list.
    pub fn item(&mut self, text: &str, tint: Tint) {
        self.paragraph(text, tint, "  • ", "    ");
    }

    /// A table of `things`.
    pub fn table(&mut self, table: &Table, things: &str) {
        table.render(&self.layout, things, &mut self.text);
    }

    /// The finished page.
    #[must_use]
    pub fn into_text(self) -> String {
        self.text
    }
}

/// The text in lines of at most `width` columns, broken at spaces; words longer than a line are broken where it ends.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let width = width.max(1);
    let mut lines = Vec::new();
    let mut line = String::new();
    let mut used = 0;
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        let length = columns(word);
        if used > 0 && used + 1 + length > width {
            lines.push(std::mem::take(&mut line));
            used = 0;
        }
        if used > 0 {
            line.push(' ');
            used += 1;
        }
        for c in word.chars() {
            let wide = columns(c.encode_utf8(&mut [0; 4]));
            if used + wide > width && used > 0 {
                lines.push(std::mem::take(&mut line));
                used = 0;
            }
            line.push(c);
            used += wide;
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn paragraphs_are_wrapped_at_spaces_and_long_words_broken() {
        assert_eq!(wrapped("aa bb cc", 5), ["aa bb", "cc"]);
        assert_eq!(wrapped("abcdefg h", 3), ["abc", "def", "g h"]);
        assert!(wrapped("", 3).is_empty());
    }
}
