//! A definition of the book as part of a page.

use super::page::Page;
use super::style::Tint;
use crate::definitions::Definition;

/// Writes the paragraphs of a definition without the book's markup; formulas keep their lines.
pub fn write(definition: &Definition, page: &mut Page) {
    let mut in_list = false;
    for piece in pieces(definition.body) {
        let item = matches!(piece, Piece::Item(_));
        if !(item && in_list) {
            page.gap();
        }
        in_list = item;
        match piece {
            Piece::Formula(lines) => {
                for line in lines {
                    page.formula(line, "    ");
                }
            }
            Piece::Item(text) => page.item(&unmarked(&text), Tint::Plain),
            Piece::Paragraph(text) => page.paragraph(&unmarked(&text), Tint::Plain, "  ", "  "),
        }
    }
}

enum Piece<'a> {
    Paragraph(String),
    Item(String),
    Formula(Vec<&'a str>),
}

/// Splits a definition at blank lines, list points and fences.
fn pieces(body: &str) -> Vec<Piece<'_>> {
    let mut pieces = Vec::new();
    let mut open = false;
    let mut lines = body.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("```") {
            let formula = lines.by_ref().take_while(|l| !l.starts_with("```"));
            pieces.push(Piece::Formula(formula.collect()));
            open = false;
        } else if line.is_empty() {
            open = false;
        } else if let Some(item) = line.strip_prefix("- ") {
            pieces.push(Piece::Item(item.to_owned()));
            open = true;
        } else if let (true, Some(Piece::Paragraph(text) | Piece::Item(text))) =
            (open, pieces.last_mut())
        {
            text.push(' ');
            text.push_str(line.trim());
        } else {
            pieces.push(Piece::Paragraph(line.to_owned()));
            open = true;
        }
    }
    pieces
}

/// Without emphasis and code marks; links keep their words.
fn unmarked(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(['*', '`', '[']) {
        plain.push_str(&rest[..at]);
        let marked = &rest[at..];
        let link = marked.strip_prefix('[').and_then(|inner| {
            let (words, after) = inner.split_once("](")?;
            let (_, after) = after.split_once(')')?;
            (!words.contains(']')).then_some((words, after))
        });
        rest = match link {
            Some((words, after)) => {
                plain.push_str(words);
                after
            }
            None if marked.starts_with('[') => {
                plain.push('[');
                &marked[1..]
            }
            None => &marked[1..],
        };
    }
    plain.push_str(rest);
    plain
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::definitions;
    use crate::text::Layout;

    #[test]
    fn markup_is_gone_and_brackets_stay() {
        assert_eq!(
            unmarked("`a[].b` is *c* of [D1](#freedom)"),
            "a[].b is c of D1"
        );
    }

    #[test]
    fn every_definition_is_shown_whole() {
        for definition in definitions::all() {
            let mut page = Page::new(Layout::default());
            write(&definition, &mut page);
            let text = page.into_text();
            assert!(text.contains("Source:"), "{text}");
            assert!(text.contains("Decided by: kutzbach::"), "{text}");
            assert!(!text.contains("```"), "{text}");
        }
    }
}
