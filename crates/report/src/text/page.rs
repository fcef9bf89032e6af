//! A page under construction: headings, paragraphs and tables, and how they become text.
//!
//! What a page says is kept as blocks, so that text and HTML are made from the same words.

use super::cite;
use super::escape::{columns, visible};
use super::style::{Layout, NARROWEST_PAGE, Tint};
use super::table::Table;
use std::borrow::Cow;

/// One piece of a page. Texts are as the caller gave them; whoever renders them makes them harmless.
#[derive(Clone, Debug)]
pub enum Block {
    /// A heading, set off from what came before.
    Heading(String),
    /// A blank line, unless it would be the first.
    Gap,
    /// Running text.
    Paragraph {
        /// The text.
        text: String,
        /// What its colour stands for.
        tint: Tint,
        /// Before its first line.
        first: &'static str,
        /// Before all others.
        rest: &'static str,
    },
    /// A point of a list.
    Item {
        /// The text.
        text: String,
        /// What its colour stands for.
        tint: Tint,
    },
    /// A line that keeps its spaces; never wrapped.
    Formula {
        /// The line.
        line: String,
        /// Before it.
        indent: &'static str,
    },
    /// A table.
    Table {
        /// Its columns and rows.
        table: Table,
        /// What its rows are, in plural.
        things: &'static str,
    },
}

/// A page: what it says, in order, whatever it will be shown on.
#[derive(Debug)]
pub struct Page {
    layout: Layout,
    blocks: Vec<Block>,
    /// Whether a heading stands in the first line of the table below it.
    compact: bool,
}

impl Page {
    /// An empty page.
    #[must_use]
    pub fn new(layout: Layout) -> Self {
        Self {
            layout,
            blocks: Vec::new(),
            compact: false,
        }
    }

    /// Lets headings stand in the first line of the table below them, in place of the title of its first column.
    #[must_use]
    pub fn compact(mut self) -> Self {
        self.compact = true;
        self
    }

    /// How it is laid out.
    #[must_use]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// What it says.
    #[must_use]
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// A heading, set off from what came before.
    pub fn heading(&mut self, title: &str) {
        self.blocks.push(Block::Heading(title.to_owned()));
    }

    /// A blank line, unless the page is empty.
    pub fn gap(&mut self) {
        self.blocks.push(Block::Gap);
    }

    /// A paragraph, wrapped to the page; the first line is indented by `first`, all others by `rest`.
    pub fn paragraph(&mut self, text: &str, tint: Tint, first: &'static str, rest: &'static str) {
        self.blocks.push(Block::Paragraph {
            text: text.to_owned(),
            tint,
            first,
            rest,
        });
    }

    /// A line that keeps its spaces, such as a formula; never wrapped.
    pub fn formula(&mut self, line: &str, indent: &'static str) {
        self.blocks.push(Block::Formula {
            line: line.to_owned(),
            indent,
        });
    }

    /// A point of a list.
    pub fn item(&mut self, text: &str, tint: Tint) {
        self.blocks.push(Block::Item {
            text: text.to_owned(),
            tint,
        });
    }

    /// A table of `things`.
    pub fn table(&mut self, table: Table, things: &'static str) {
        self.blocks.push(Block::Table { table, things });
    }

    /// The finished page as text for a terminal or a file.
    #[must_use]
    pub fn into_text(self) -> String {
        let mut text = String::new();
        let mut blocks = self.blocks.iter().peekable();
        while let Some(block) = blocks.next() {
            let below = blocks.peek();
            match (block, below) {
                (Block::Heading(title), Some(Block::Table { table, things })) if self.compact => {
                    self.layout.write(&Block::Gap, &mut text);
                    let title = self.layout.cited(title);
                    table.render_under(Some(&title), &self.layout, things, &mut text);
                    blocks.next();
                }
                _ => self.layout.write(block, &mut text),
            }
        }
        text
    }
}

impl Layout {
    fn write(&self, block: &Block, out: &mut String) {
        match block {
            Block::Heading(title) => {
                self.write(&Block::Gap, out);
                let title = self.cited(title);
                out.push_str(&Tint::Strong.paint(&visible(&title), self.color));
                out.push('\n');
            }
            Block::Gap => {
                if !out.is_empty() {
                    out.push('\n');
                }
            }
            Block::Paragraph {
                text,
                tint,
                first,
                rest,
            } => self.write_lines(text, *tint, [first, rest], out),
            Block::Item { text, tint } => self.write_lines(text, *tint, ["  • ", "    "], out),
            Block::Formula { line, indent } => {
                out.push_str(indent);
                out.push_str(&Tint::Strong.paint(&visible(line), self.color));
                out.push('\n');
            }
            Block::Table { table, things } => table.render(self, things, out),
        }
    }

    /// The text with the numbers of definitions where everything is asked for.
    fn cited<'a>(&self, text: &'a str) -> Cow<'a, str> {
        match self.verbose {
            true => Cow::Borrowed(text),
            false => Cow::Owned(cite::without(text)),
        }
    }

    fn write_lines(&self, text: &str, tint: Tint, [first, rest]: [&str; 2], out: &mut String) {
        let text = self.cited(text);
        let text = visible(&text);
        let width = self.width.max(NARROWEST_PAGE);
        let mut lead = first;
        for line in wrapped(
            &text,
            width.saturating_sub(columns(first).max(columns(rest))),
        ) {
            out.push_str(lead);
            out.push_str(&tint.paint(&line, self.color));
            out.push('\n');
            lead = rest;
        }
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
