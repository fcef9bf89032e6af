//! `kutzbach explain WORD`: a definition with its formula.

use super::failure::Failure;
use super::{DONE, output, terminal};
use clap::Args;
use kutzbach::report::definitions::{self, Definition};
use kutzbach::report::text::{Cell, Column, Layout, Page, Table, Tint};

/// Define a word of the report; without a word, list those that are known
#[derive(Debug, Args)]
pub struct Arguments {
    /// The word, such as `redundant` or `D5`
    word: Vec<String>,
}

/// Runs the command.
///
/// # Errors
/// Where the word is not known, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let layout = terminal::layout(false, false);
    let word = arguments.word.join(" ");
    let page = if word.is_empty() {
        list(layout)
    } else {
        let definition = definitions::find(&word).ok_or_else(|| Failure::Plain {
            message: format!("`{word}` is not a word of the reports"),
            help: Some(match definitions::nearest(&word) {
                Some(near) => format!("did you mean `{near}`? `kutzbach explain` lists all words"),
                None => "`kutzbach explain` lists all words".to_owned(),
            }),
        })?;
        explanation(&definition, layout)
    };
    output::put(&page, None)?;
    Ok(DONE)
}

fn list(layout: Layout) -> String {
    let mut page = Page::new(layout);
    let mut table = Table::new()
        .column("", Column::Words)
        .column("definition", Column::Words)
        .column("also explains", Column::Shrinking);
    for definition in definitions::all() {
        table.row(vec![
            Cell::new(definition.number).tint(Tint::Quiet),
            Cell::new(definition.title).tint(Tint::Strong),
            Cell::new(definition.also.join(", ")),
        ]);
    }
    page.table(table, "definitions");
    page.into_text()
}

/// The paragraphs of the book without its markup; formulas keep their lines.
fn explanation(definition: &Definition, layout: Layout) -> String {
    let mut page = Page::new(layout);
    page.heading(&format!("{} {}", definition.number, definition.title));
    let mut in_list = false;
    for block in blocks(definition.body) {
        let item = matches!(block, Block::Item(_));
        if !(item && in_list) {
            page.gap();
        }
        in_list = item;
        match block {
            Block::Formula(lines) => {
                for line in lines {
                    page.formula(line, "    ");
                }
            }
            Block::Item(text) => page.item(&unmarked(&text), Tint::Plain),
            Block::Paragraph(text) => page.paragraph(&unmarked(&text), Tint::Plain, "  ", "  "),
        }
    }
    page.into_text()
}

enum Block<'a> {
    Paragraph(String),
    Item(String),
    Formula(Vec<&'a str>),
}

/// Splits a definition at blank lines, list points and fences.
fn blocks(body: &str) -> Vec<Block<'_>> {
    let mut blocks = Vec::new();
    let mut open = false;
    let mut lines = body.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("```") {
            let formula = lines.by_ref().take_while(|l| !l.starts_with("```"));
            blocks.push(Block::Formula(formula.collect()));
            open = false;
        } else if line.is_empty() {
            open = false;
        } else if let Some(item) = line.strip_prefix("- ") {
            blocks.push(Block::Item(item.to_owned()));
            open = true;
        } else if let (true, Some(Block::Paragraph(text) | Block::Item(text))) =
            (open, blocks.last_mut())
        {
            text.push(' ');
            text.push_str(line.trim());
        } else {
            blocks.push(Block::Paragraph(line.to_owned()));
            open = true;
        }
    }
    blocks
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
            let text = explanation(&definition, Layout::default());
            assert!(text.contains("Source:"), "{text}");
            assert!(text.contains("Decided by: kutzbach::"), "{text}");
            assert!(!text.contains("```"), "{text}");
        }
    }
}
