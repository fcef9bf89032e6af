//! The outcome of a check as a page: disagreements first, then the counts.

use super::Checked;
use kutzbach::report::text::words::counted;
use kutzbach::report::text::{Cell, Column, Layout, Page, Table, Tint};

/// The page.
pub fn render(checked: &Checked, layout: Layout) -> String {
    let mut page = Page::new(layout);
    let (verdict, tint) = if checked.wrong > 0 {
        (
            format!(
                "{} with what is known.",
                counted(checked.wrong, "disagreement")
            ),
            Tint::Bad,
        )
    } else if checked.right == 0 {
        ("Nothing was compared.".to_owned(), Tint::Doubtful)
    } else {
        ("Everything compared agrees.".to_owned(), Tint::Good)
    };
    page.paragraph(&verdict, tint, "", "");
    let mut counts = format!(
        "{}: {} right, {} wrong, {} open.",
        counted(checked.files, "file"),
        counted(checked.right, "fact"),
        checked.wrong,
        checked.open
    );
    if !checked.without_expectation.is_empty() {
        counts.push_str(&format!(
            " Nothing is known of {}.",
            counted(checked.without_expectation.len(), "file")
        ));
    }
    if !checked.unreadable.is_empty() {
        counts.push_str(&format!(
            " {} could not be read.",
            counted(checked.unreadable.len(), "file")
        ));
    }
    page.paragraph(&counts, Tint::Plain, "", "");
    disagreements(checked, &mut page);
    fields(checked, &mut page);
    if !checked.notes.is_empty() {
        page.heading("Notes");
        for note in &checked.notes {
            page.item(note, Tint::Doubtful);
        }
    }
    page.into_text()
}

fn disagreements(checked: &Checked, page: &mut Page) {
    if checked.disagreements.is_empty() {
        return;
    }
    page.heading("Disagreements");
    let mut table = Table::new()
        .column("file", Column::Shrinking)
        .column("field", Column::Words)
        .column("expected", Column::Shrinking)
        .column("found", Column::Shrinking);
    for row in &checked.disagreements {
        let (mut file, mut expected) = (row.file.clone(), row.disagreement.expected.clone());
        match &row.place {
            Some(place) if place.file == file => file = place.to_string(),
            Some(place) => expected = format!("{expected} ({place})"),
            None => {}
        }
        table.row(vec![
            Cell::new(file),
            Cell::new(row.disagreement.what),
            Cell::new(expected).tint(Tint::Good),
            Cell::new(&row.disagreement.found).tint(Tint::Bad),
        ]);
    }
    page.table(table, "disagreements");
}

fn fields(checked: &Checked, page: &mut Page) {
    if checked.fields.is_empty() {
        return;
    }
    page.heading("Fields");
    let mut table = Table::new()
        .column("", Column::Words)
        .column("right", Column::Numbers)
        .column("wrong", Column::Numbers)
        .column("open", Column::Numbers);
    for (field, tally) in &checked.fields {
        table.row(vec![
            Cell::new(field),
            Cell::new(tally.right.to_string()),
            Cell::new(tally.wrong.to_string()),
            Cell::new(tally.open.to_string()),
        ]);
    }
    page.table(table, "fields");
}
