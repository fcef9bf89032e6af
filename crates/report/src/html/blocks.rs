//! Pages as HTML: the same blocks that make the text report.

use super::escape::escaped;
use super::names::Names;
use crate::definitions;
use crate::text::{Block, Cell, Column, Row, Table, Tint};

/// Tables longer than this are abridged: nobody reads on, and a browser gets slow.
const ROWS: usize = 2000;

/// What a page says, headings as `<h2>`.
pub(super) fn write(blocks: &[Block], names: &Names, out: &mut String) {
    let mut listed = false;
    for (index, block) in blocks.iter().enumerate() {
        let item = matches!(block, Block::Item { .. });
        if item != listed {
            out.push_str(if item { "<ul>\n" } else { "</ul>\n" });
            listed = item;
        }
        match block {
            Block::Heading(title) => out.push_str(&format!("<h2>{}</h2>\n", prose(title))),
            Block::Gap => {}
            Block::Paragraph { text, tint, .. } => {
                out.push_str(&format!("<p{}>{}</p>\n", class(*tint), prose(text)));
            }
            Block::Item { text, tint } => {
                out.push_str(&format!("<li{}>{}</li>\n", class(*tint), prose(text)));
            }
            Block::Formula { line, .. } => {
                // Lines that follow one another are one formula.
                let is_formula = |at: usize| matches!(blocks.get(at), Some(Block::Formula { .. }));
                let first = index == 0 || !is_formula(index - 1);
                let last = !is_formula(index + 1);
                out.push_str(if first { "<pre>" } else { "" });
                out.push_str(&escaped(line));
                out.push_str(if last { "</pre>\n" } else { "\n" });
            }
            Block::Table { table, things } => write_table(table, things, names, out),
        }
    }
    if listed {
        out.push_str("</ul>\n");
    }
}

/// ` class="…"` for a tint.
fn class(tint: Tint) -> &'static str {
    match tint {
        Tint::Plain => "",
        Tint::Strong => r#" class="strong""#,
        Tint::Quiet => r#" class="quiet""#,
        Tint::Good => r#" class="good""#,
        Tint::Notable => r#" class="notable""#,
        Tint::Doubtful => r#" class="doubtful""#,
        Tint::Bad => r#" class="bad""#,
    }
}

fn write_table(table: &Table, things: &str, names: &Names, out: &mut String) {
    let columns = table.columns();
    let titled = columns.iter().any(|(title, _)| !title.is_empty());
    out.push_str("<div class=\"scroll\"><table");
    // Rows that say different things have no order.
    if titled && table.rows().len() > 1 {
        out.push_str(" class=\"sortable\"");
    }
    out.push_str(">\n");
    if titled {
        out.push_str("<thead><tr>");
        for (title, column) in columns {
            let (class, sort) = match column {
                Column::Numbers => (r#" class="number""#, "number"),
                Column::Words | Column::Shrinking => ("", "text"),
            };
            let sort = if title.is_empty() {
                String::new()
            } else {
                format!(" data-sort=\"{sort}\"")
            };
            out.push_str(&format!(
                "<th scope=\"col\"{class}{sort}>{}</th>",
                title_link(title)
            ));
        }
        out.push_str("</tr></thead>\n");
    }
    out.push_str("<tbody>\n");
    for row in table.rows().iter().take(ROWS) {
        write_row(row, columns, names, out);
    }
    out.push_str("</tbody></table></div>\n");
    let left = table.rows().len().saturating_sub(ROWS);
    if left > 0 {
        out.push_str(&format!(
            "<p class=\"quiet\">… and {left} more {}: <code>--format json</code> shows all {}</p>\n",
            escaped(things),
            table.rows().len()
        ));
    }
}

fn write_row(row: &Row, columns: &[(String, Column)], names: &Names, out: &mut String) {
    let subject = row.subject.as_ref().and_then(|s| names.attribute(s));
    match subject {
        Some(attribute) => out.push_str(&format!("<tr {attribute}>")),
        None => out.push_str("<tr>"),
    }
    for (index, (cell, (_, column))) in row.cells.iter().zip(columns).enumerate() {
        let mut classes = Vec::new();
        if *column == Column::Numbers {
            classes.push("number");
        }
        classes.extend(tint_name(cell));
        let class = if classes.is_empty() {
            String::new()
        } else {
            format!(" class=\"{}\"", classes.join(" "))
        };
        let text = escaped(cell.text());
        if index == 0 && !cell.text().is_empty() {
            out.push_str(&format!("<th scope=\"row\"{class}>{text}</th>"));
        } else {
            out.push_str(&format!("<td{class}>{text}</td>"));
        }
    }
    out.push_str("</tr>\n");
}

fn tint_name(cell: &Cell) -> Option<&'static str> {
    match cell.its_tint() {
        Tint::Plain => None,
        Tint::Strong => Some("strong"),
        Tint::Quiet => Some("quiet"),
        Tint::Good => Some("good"),
        Tint::Notable => Some("notable"),
        Tint::Doubtful => Some("doubtful"),
        Tint::Bad => Some("bad"),
    }
}

/// A column's title, linked to the definition of its word where there is one.
fn title_link(title: &str) -> String {
    let word = match title {
        "in motion" => "locked",
        "through" => "cycle",
        "moves by" | "seen from" => "relative motion",
        "freedom alone" => "freedom",
        "undetermined" => "redundant",
        other => other,
    };
    match definitions::all().into_iter().find(|d| d.explains(word)) {
        Some(definition) => format!(
            "<a class=\"term\" href=\"#{}\">{}</a>",
            definition.number,
            escaped(title)
        ),
        None => escaped(title),
    }
}

/// Running text: names between backquotes as code, numbers of definitions as links to them.
pub(super) fn prose(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 32);
    for (index, piece) in text.split('`').enumerate() {
        if index % 2 == 1 {
            out.push_str(&format!("<code>{}</code>", escaped(piece)));
        } else {
            link_definitions(piece, &mut out);
        }
    }
    out
}

fn link_definitions(text: &str, out: &mut String) {
    let mut rest = text;
    let mut before = ' ';
    while let Some(at) = rest.find('D') {
        let (plain, from) = rest.split_at(at);
        out.push_str(&escaped(plain));
        before = plain.chars().next_back().unwrap_or(before);
        let digits = from[1..].bytes().take_while(u8::is_ascii_digit).count();
        let (word, after) = from.split_at(1 + digits);
        let alone = !before.is_alphanumeric()
            && !after.chars().next().is_some_and(char::is_alphanumeric)
            && digits > 0;
        if alone && definitions::all().iter().any(|d| d.number == word) {
            out.push_str(&format!("<a class=\"term\" href=\"#{word}\">{word}</a>"));
        } else {
            out.push_str(&escaped(word));
        }
        before = 'D';
        rest = after;
    }
    out.push_str(&escaped(rest));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definitions_are_linked_where_they_stand_alone() {
        assert_eq!(
            prose("singular (D6): D6x, AD6, D999 and D"),
            "singular (<a class=\"term\" href=\"#D6\">D6</a>): D6x, AD6, D999 and D"
        );
    }

    #[test]
    fn names_are_code_and_never_markup() {
        assert_eq!(
            prose("loop `<img src=x onerror=1>` & more"),
            "loop <code>&lt;img src=x onerror=1&gt;</code> &amp; more"
        );
        assert_eq!(
            prose("an odd ` mark <b>"),
            "an odd <code> mark &lt;b&gt;</code>"
        );
    }
}
