//! `kutzbach explain WORD`: a definition with its formula.

use super::failure::Failure;
use super::{DONE, output, terminal};
use clap::Args;
use kutzbach::report::definitions::{self, Definition};
use kutzbach::report::text::{Cell, Column, Layout, Page, Table, Tint, explanation};

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
        explained(&definition, layout)
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

fn explained(definition: &Definition, layout: Layout) -> String {
    let mut page = Page::new(Layout {
        verbose: true,
        ..layout
    });
    page.heading(&format!("{} {}", definition.number, definition.title));
    explanation::write(definition, &mut page);
    page.into_text()
}
