//! Aligned tables that fit a page.

use super::escape::{clipped, columns, visible};
use super::style::{Layout, NARROWEST_PAGE, Tint};

/// Tables longer than this are abridged unless everything is asked for.
pub const ABRIDGED_ROWS: usize = 60;

/// A column that may shrink keeps at least this many columns of the page.
const NARROWEST: usize = 8;

/// Space before the first column and between columns.
const INDENT: usize = 2;

/// One cell.
#[derive(Clone, Debug)]
pub struct Cell {
    text: String,
    tint: Tint,
}

impl Cell {
    /// A cell of plain text; made harmless here.
    #[must_use]
    pub fn new(text: impl AsRef<str>) -> Self {
        Self {
            text: visible(text.as_ref()).into_owned(),
            tint: Tint::Plain,
        }
    }

    /// Its text, harmless.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Its tint.
    #[must_use]
    pub fn its_tint(&self) -> Tint {
        self.tint
    }

    /// The same cell in a tint.
    #[must_use]
    pub fn tint(mut self, tint: Tint) -> Self {
        self.tint = tint;
        self
    }
}

/// How a column behaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// Words, at their natural width.
    Words,
    /// Names or lists, shortened with `…` where the page is too narrow.
    Shrinking,
    /// Numbers, to the right.
    Numbers,
}

/// What a row speaks of, by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A link.
    Link(String),
    /// A joint.
    Joint(String),
    /// A basic cycle.
    Cycle(String),
}

/// Cells side by side.
#[derive(Clone, Debug)]
pub struct Row {
    /// What it speaks of, where that is one thing.
    pub subject: Option<Subject>,
    /// One for each column.
    pub cells: Vec<Cell>,
}

/// Rows under headings.
#[derive(Clone, Debug, Default)]
pub struct Table {
    columns: Vec<(String, Column)>,
    rows: Vec<Row>,
}

impl Table {
    /// A table without columns.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a column.
    #[must_use]
    pub fn column(mut self, title: &str, column: Column) -> Self {
        self.columns.push((title.to_owned(), column));
        self
    }

    /// Adds a row of as many cells as there are columns.
    pub fn row(&mut self, cells: Vec<Cell>) {
        self.add(None, cells);
    }

    /// Adds a row that speaks of one thing.
    pub fn row_about(&mut self, subject: Subject, cells: Vec<Cell>) {
        self.add(Some(subject), cells);
    }

    fn add(&mut self, subject: Option<Subject>, cells: Vec<Cell>) {
        debug_assert_eq!(cells.len(), self.columns.len(), "a cell for each column");
        self.rows.push(Row { subject, cells });
    }

    /// Titles and kinds of the columns.
    #[must_use]
    pub fn columns(&self) -> &[(String, Column)] {
        &self.columns
    }

    /// The rows.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Writes the table, abridged to [`ABRIDGED_ROWS`] rows unless the layout is verbose; then a line says how many more
    /// `things` there are.
    pub fn render(&self, layout: &Layout, things: &str, out: &mut String) {
        self.render_under(None, layout, things, out);
    }

    /// The same under a heading, which takes the place of the first column's title where it fits there.
    pub fn render_under(
        &self,
        heading: Option<&str>,
        layout: &Layout,
        things: &str,
        out: &mut String,
    ) {
        let shown = if layout.verbose || self.rows.len() <= ABRIDGED_ROWS {
            self.rows.len()
        } else {
            ABRIDGED_ROWS
        };
        let rows = &self.rows[..shown];
        let page = layout.width.max(NARROWEST_PAGE);
        let heading = heading.map(|text| visible(text).into_owned());
        // A heading that would cut what stands beside it has a line of its own.
        let alone = self.widths(rows, page, "");
        let together = self.widths(rows, page, heading.as_deref().unwrap_or(""));
        let cuts = together.iter().zip(&alone).any(|(a, b)| a < b);
        let widths = if cuts { alone } else { together };
        let titles: Vec<Cell> = self
            .columns
            .iter()
            .map(|(title, _)| Cell::new(title).tint(Tint::Quiet))
            .collect();
        let first = INDENT + widths.first().copied().unwrap_or(0);
        match heading {
            Some(heading) if columns(&heading) <= first && widths.len() > 1 => {
                let mut rest = String::new();
                let mut titles = titles;
                titles[0] = Cell::new("");
                self.line(&titles, &widths, layout, &mut rest);
                out.push_str(&Tint::Strong.paint(&heading, layout.color));
                out.push_str(rest.get(columns(&heading)..).unwrap_or("\n"));
            }
            _ => {
                if let Some(heading) = heading {
                    out.push_str(&Tint::Strong.paint(&heading, layout.color));
                    out.push('\n');
                }
                if self.columns.iter().any(|(title, _)| !title.is_empty()) {
                    self.line(&titles, &widths, layout, out);
                }
            }
        }
        for row in rows {
            self.line(&row.cells, &widths, layout, out);
        }
        let left = self.rows.len() - shown;
        if left > 0 {
            let line = format!(
                "… and {left} more {things}: `--verbose` or `--format json` shows all {}",
                self.rows.len()
            );
            out.push_str(&" ".repeat(INDENT));
            out.push_str(&Tint::Quiet.paint(&line, layout.color));
            out.push('\n');
        }
    }

    /// Natural widths; where the page is too narrow, shrinking columns give way first, then headings wider than what
    /// stands below them, then everything.
    fn widths(&self, rows: &[Row], page: usize, heading: &str) -> Vec<usize> {
        let content: Vec<usize> = (0..self.columns.len())
            .map(|index| {
                rows.iter()
                    .filter_map(|row| row.cells.get(index))
                    .map(|cell| columns(&cell.text))
                    .max()
                    .unwrap_or(0)
            })
            .collect();
        let mut widths: Vec<usize> = content
            .iter()
            .zip(&self.columns)
            .map(|(width, (title, _))| columns(title).max(*width))
            .collect();
        if let Some(first) = widths.first_mut() {
            *first = columns(heading).saturating_sub(INDENT).max(*first);
        }
        let excess = (widths.iter().sum::<usize>() + INDENT * widths.len()).saturating_sub(page);
        let shrinking = |i: usize| match self.columns[i].1 {
            Column::Shrinking => NARROWEST,
            Column::Words | Column::Numbers => usize::MAX,
        };
        let excess = narrow(&mut widths, excess, shrinking);
        let excess = narrow(&mut widths, excess, |i| content[i].max(3));
        narrow(&mut widths, excess, |_| 3);
        widths
    }

    fn line(&self, cells: &[Cell], widths: &[usize], layout: &Layout, out: &mut String) {
        let mut line = String::new();
        let mut pending = 0;
        for ((cell, width), (_, column)) in cells.iter().zip(widths).zip(&self.columns) {
            let text = clipped(&cell.text, *width);
            let padding = width - columns(&text);
            let (before, after) = match column {
                Column::Numbers => (padding, 0),
                Column::Words | Column::Shrinking => (0, padding),
            };
            if text.is_empty() {
                pending += INDENT + width;
                continue;
            }
            line.push_str(&" ".repeat(pending + INDENT + before));
            line.push_str(&cell.tint.paint(&text, layout.color));
            pending = after;
        }
        out.push_str(&line);
        out.push('\n');
    }
}

/// Takes `excess` columns from the widest columns down to their floors; what could not be taken is returned.
fn narrow(widths: &mut [usize], mut excess: usize, floor: impl Fn(usize) -> usize) -> usize {
    while excess > 0 {
        let can = |i: usize, widths: &[usize]| widths[i] > floor(i);
        let Some(widest) = (0..widths.len())
            .filter(|i| can(*i, widths))
            .max_by_key(|i| widths[*i])
        else {
            break;
        };
        // Down to the next widest at once, so that a long name does not cost one round per letter.
        let next = (0..widths.len())
            .filter(|i| *i != widest && can(*i, widths))
            .map(|i| widths[i])
            .max()
            .unwrap_or(0);
        let step = (widths[widest] - next)
            .clamp(1, excess)
            .min(widths[widest] - floor(widest));
        widths[widest] -= step;
        excess -= step;
    }
    excess
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn table(rows: usize, name: &str) -> String {
        let mut table = Table::new()
            .column("name", Column::Shrinking)
            .column("n", Column::Numbers);
        for n in 0..rows {
            table.row(vec![Cell::new(name), Cell::new(n.to_string())]);
        }
        let mut out = String::new();
        table.render(&Layout::default(), "joints", &mut out);
        out
    }

    #[test]
    fn sixty_rows_are_shown_and_one_more_is_told() {
        assert_eq!(table(60, "a").lines().count(), 61);
        let long = table(61, "a");
        assert_eq!(long.lines().count(), 62);
        assert!(
            long.ends_with("… and 1 more joints: `--verbose` or `--format json` shows all 61\n")
        );
    }

    #[test]
    fn long_names_are_cut_to_the_page() {
        let out = table(3, &"x".repeat(10_000));
        for line in out.lines() {
            assert!(columns(line) <= 100, "{line}");
        }
        assert!(out.contains('…'));
    }

    #[test]
    fn a_heading_takes_the_place_of_the_first_title_where_it_fits() {
        let mut table = Table::new()
            .column("name", Column::Shrinking)
            .column("n", Column::Numbers);
        table.row(vec![Cell::new("a"), Cell::new("1")]);
        let shown = |heading: &str| {
            let mut out = String::new();
            table.render_under(Some(heading), &Layout::default(), "joints", &mut out);
            out
        };
        assert_eq!(shown("Joints"), "Joints  n\n  a     1\n");
        assert_eq!(
            shown("Motion of all"),
            "Motion of all  n\n  a            1\n"
        );
        let long = "x".repeat(200);
        assert!(shown(&long).starts_with(&format!("{long}\n")));
    }

    #[test]
    fn no_line_ends_in_space() {
        for line in table(3, "name").lines() {
            assert_eq!(line, line.trim_end());
        }
    }
}
