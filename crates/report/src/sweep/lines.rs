//! A sweep as lines of text: one that states what was asked, in CSV one of the columns' names, and one for each variant.
//!
//! No line holds a line break of its own, so that a file that was cut off is complete up to its last line break.

use super::border::Side;
use super::family::{Family, Row};
use super::outcome::Facts;
use super::plan::{Asked, Shard};
use super::values::Value;
use crate::text::visible;
use kutzbach_mobility::Depth;
use serde::Serialize;
use std::borrow::Cow;
use std::fmt::Write as _;

/// The schema that the first line names.
pub const SWEEP_SCHEMA: &str = "kutzbach-sweep-1";

/// How lines are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Comma-separated values, after a line of JSON behind `#`.
    Csv,
    /// A JSON object in each line.
    JsonLines,
}

/// What a cell holds.
enum Cell<'a> {
    /// Nothing is known, or nothing was asked.
    Empty,
    /// A number as JSON writes it.
    Number(String),
    /// A word of the program, or a name or sentence.
    Text(Cow<'a, str>),
    /// Names.
    Names(&'a [String]),
}

/// The columns of every depth, after the measures.
const OF_RANK: [&str; 6] = [
    "status",
    "kutzbach",
    "instantaneous",
    "redundant",
    "margin",
    "reason",
];

/// Those of the verdict, after the margin.
const OF_VERDICT: [&str; 6] = ["finite", "generic", "verdict", "pose", "kind", "class"];

/// Those of branches, after the class.
const OF_BRANCHES: [&str; 2] = ["branches", "locked"];

/// How the rows of one sweep are written.
#[derive(Clone, Debug)]
pub struct Table {
    form: Form,
    depth: Depth,
    names: Vec<String>,
    head: String,
}

/// What the first line states: whatever rows depend on.
#[derive(Serialize)]
struct Head<'a> {
    schema: &'static str,
    program: &'static str,
    file: Cow<'a, str>,
    hash: String,
    #[serde(flatten)]
    asked: Asked,
    depth: &'static str,
    shard: String,
    variants: u64,
    set: Vec<String>,
    literal: bool,
    precision: Option<f64>,
    closure_tolerance: Option<f64>,
}

impl Table {
    /// The table of a share of a family's variants.
    #[must_use]
    pub fn new(family: &Family, shard: Shard, form: Form) -> Self {
        let source = family.source();
        let options = &source.options;
        let settings = options.settings.iter();
        let head = Head {
            schema: SWEEP_SCHEMA,
            program: env!("CARGO_PKG_VERSION"),
            file: file_name(&source.file),
            hash: format!("{:016x}", source.hash()),
            asked: family.plan().asked(),
            depth: depth_word(family.depth()),
            shard: shard.to_string(),
            variants: family.plan().count(),
            set: settings
                .map(|(name, value)| format!("{name}={value}"))
                .collect(),
            literal: options.literal,
            precision: options.precision,
            closure_tolerance: family.closure_tolerance(),
        };
        // Strings, numbers and lists of them always have a JSON form.
        let head = serde_json::to_string(&head).unwrap_or_default();
        Self {
            form,
            depth: family.depth(),
            names: family.plan().names().map(str::to_owned).collect(),
            head,
        }
    }

    /// What stands before the rows: a line that states file, ranges, share and depth, and in CSV the names of the columns.
    #[must_use]
    pub fn head(&self) -> String {
        if self.form == Form::JsonLines {
            return format!("{}\n", self.head);
        }
        let mut text = format!("# {}\nvariant", self.head);
        for name in &self.names {
            // Names of measures are the file's: one may be that of a column.
            let own = self.columns().any(|column| column == name) || name == "variant";
            let shown = if own {
                format!("{name} (measure)")
            } else {
                name.clone()
            };
            text.push(',');
            text.push_str(&quoted(&visible(&shown)));
        }
        for column in self.columns() {
            text.push(',');
            text.push_str(column);
        }
        text.push('\n');
        text
    }

    /// What the row of a variant begins with, and no other row does.
    #[must_use]
    pub fn start(&self, index: u64) -> String {
        match self.form {
            Form::Csv => format!("{index},"),
            Form::JsonLines => format!("{{\"variant\":{index},"),
        }
    }

    /// A row with its line break.
    #[must_use]
    pub fn line(&self, row: &Row) -> String {
        let mut line = self.start(row.index);
        match self.form {
            Form::Csv => self.csv(row, &mut line),
            Form::JsonLines => self.json(row, &mut line),
        }
        line.push('\n');
        line
    }

    /// What a line that this table has written says of its variant; `None` where it is no such line.
    #[must_use]
    pub fn side(&self, line: &str) -> Option<Side> {
        let line = line.trim_end();
        if self.form == Form::JsonLines {
            let object: serde_json::Value = serde_json::from_str(line).ok()?;
            return Side::read(|column| match object.get(column)? {
                serde_json::Value::String(word) => Some(word.clone()),
                serde_json::Value::Number(number) => Some(number.to_string()),
                _ => None,
            });
        }
        let cells = csv_cells(line)?;
        let before = 1 + self.names.len();
        Side::read(|column| {
            let place = self.columns().position(|own| own == column)?;
            cells
                .get(before + place)
                .filter(|cell| !cell.is_empty())
                .cloned()
        })
    }

    /// Names of the columns after the measures.
    fn columns(&self) -> impl Iterator<Item = &'static str> + use<> {
        let [status, kutzbach, instantaneous, redundant, margin, reason] = OF_RANK;
        let beyond_rank = self.depth > Depth::Rank;
        let with_branches = self.depth >= Depth::Motions;
        [status, kutzbach, instantaneous, redundant, margin]
            .into_iter()
            .chain(OF_VERDICT.into_iter().filter(move |_| beyond_rank))
            .chain(OF_BRANCHES.into_iter().filter(move |_| with_branches))
            .chain([reason])
    }

    fn csv(&self, row: &Row, line: &mut String) {
        let measures = row
            .values
            .iter()
            .map(|value| visible(&value.shown).into_owned());
        let cells = self.columns().map(|column| match cell(row, column) {
            Cell::Empty => String::new(),
            Cell::Number(number) => number,
            Cell::Text(text) => visible(&text).into_owned(),
            Cell::Names(names) => visible(&names.join(";")).into_owned(),
        });
        let mut first = true;
        for cell in measures.chain(cells) {
            if !first {
                line.push(',');
            }
            first = false;
            line.push_str(&quoted(&cell));
        }
    }

    fn json(&self, row: &Row, line: &mut String) {
        line.push_str("\"measures\":{");
        for (place, (name, value)) in self.names.iter().zip(&row.values).enumerate() {
            let comma = if place > 0 { "," } else { "" };
            let _ = write!(line, "{comma}{}:{}", json_text(name), json_value(value));
        }
        line.push('}');
        for column in self.columns() {
            let value = match cell(row, column) {
                Cell::Empty => "null".to_owned(),
                Cell::Number(number) => number,
                Cell::Text(text) => json_text(&text),
                Cell::Names(names) => {
                    let names: Vec<String> = names.iter().map(|name| json_text(name)).collect();
                    format!("[{}]", names.join(","))
                }
            };
            let _ = write!(line, ",\"{column}\":{value}");
        }
        line.push('}');
    }
}

/// What a row holds in a column.
fn cell<'a>(row: &'a Row, column: &str) -> Cell<'a> {
    let facts: &Facts = &row.outcome.facts;
    let word =
        |word: Option<&'static str>| word.map_or(Cell::Empty, |word| Cell::Text(word.into()));
    match column {
        "status" => word(Some(row.outcome.status.word())),
        "kutzbach" => number(facts.kutzbach),
        "instantaneous" => number(facts.instantaneous),
        "redundant" => number(facts.redundant),
        // Three digits tell how near another answer is; more would differ from machine to machine.
        "margin" => number(facts.margin.map(|margin| format!("{margin:.2e}"))),
        "finite" => number(facts.finite),
        "generic" => number(facts.generic),
        "verdict" => word(facts.verdict.map(|own| own.word())),
        "pose" => word(facts.pose.map(|own| own.word())),
        "kind" => word(facts.kind.map(|own| own.word())),
        "class" => word(facts.class.map(|own| own.word())),
        "branches" => number(facts.branches),
        "locked" => match &facts.locked {
            Some(names) => Cell::Names(names),
            None => Cell::Empty,
        },
        "reason" => match &row.outcome.reason {
            Some(why) => Cell::Text(Cow::Borrowed(why)),
            None => Cell::Empty,
        },
        _ => Cell::Empty,
    }
}

fn number<'a>(value: Option<impl ToString>) -> Cell<'a> {
    value.map_or(Cell::Empty, |value| Cell::Number(value.to_string()))
}

/// The word for a depth, as the command line has it.
fn depth_word(depth: Depth) -> &'static str {
    match depth {
        Depth::Rank => "rank",
        Depth::Verdict => "verdict",
        Depth::Motions => "motions",
        Depth::Everything => "everything",
    }
}

/// A file's name without its folders: it is known by its hash.
fn file_name(path: &str) -> Cow<'_, str> {
    match std::path::Path::new(path).file_name() {
        Some(name) => name.to_string_lossy(),
        None => Cow::Borrowed(path),
    }
}

/// A cell of CSV (RFC 4180).
fn quoted(cell: &str) -> Cow<'_, str> {
    match cell.contains([',', '"', '\n', '\r']) {
        true => Cow::Owned(format!("\"{}\"", cell.replace('"', "\"\""))),
        false => Cow::Borrowed(cell),
    }
}

/// The cells of a line of CSV (RFC 4180; no cell of a sweep has a line break); `None` where a quotation does not end.
pub(crate) fn csv_cells(line: &str) -> Option<Vec<String>> {
    let mut cells = Vec::new();
    let mut cell = String::new();
    let mut is_quoted = false;
    let mut characters = line.chars().peekable();
    while let Some(character) = characters.next() {
        match character {
            '"' if is_quoted && characters.peek() == Some(&'"') => {
                characters.next();
                cell.push('"');
            }
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(std::mem::take(&mut cell)),
            other => cell.push(other),
        }
    }
    cells.push(cell);
    (!is_quoted).then_some(cells)
}

fn json_text(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// Decimals are numbers in JSON as they stand here; fractions and expressions are strings.
fn json_value(value: &Value) -> String {
    match value.is_decimal {
        true => value.shown.clone(),
        false => json_text(&value.shown),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::family::MeasuredFile;
    use super::super::outcome::{Outcome, Status};
    use super::super::plan::Plan;
    use super::super::values::Over;
    use super::*;
    use kutzbach_mobility::{AnalysisOptions, Verdict};

    const TEXT: &str = r#"<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:property name="a" value="1"/><xacro:property name="pose" value="1"/><link name="base"/></robot>"#;

    fn table(depth: Depth, form: Form) -> Table {
        let over = ["a=0..1:3", "pose=1/3"].map(|one| Over::read(one).unwrap());
        let plan = Plan::new(over.to_vec(), None).unwrap();
        let options = AnalysisOptions {
            depth,
            ..AnalysisOptions::default()
        };
        let family = Family::new(MeasuredFile::of_text(TEXT, "x/r.urdf"), plan, options);
        Table::new(&family.unwrap(), Shard::read("1/2").unwrap(), form)
    }

    fn row() -> Row {
        let values = ["a=0.5", "pose=1/3"].map(|one| {
            let over = Over::read(one).unwrap();
            over.values.at(0).unwrap()
        });
        let facts = Facts {
            kutzbach: Some(-2),
            instantaneous: Some(1),
            margin: Some(123_456.0),
            finite: Some(1),
            verdict: Some(Verdict::Mobile),
            branches: Some(1),
            locked: Some(vec!["b,c".to_owned(), "d".to_owned()]),
            ..Facts::default()
        };
        Row {
            index: 7,
            values: values.to_vec(),
            outcome: Outcome {
                status: Status::Analysed,
                reason: Some("one\ntwo".to_owned()),
                facts,
            },
        }
    }

    #[test]
    fn csv_has_a_stated_question_and_a_row_a_variant() {
        let head = table(Depth::Motions, Form::Csv).head();
        let lines: Vec<&str> = head.lines().collect();
        assert!(lines[0].starts_with("# {\"schema\":\"kutzbach-sweep-1\""));
        for part in [
            "\"file\":\"r.urdf\"",
            "\"over\":[\"a=0..1:3\",\"pose=1/3\"]",
            "\"shard\":\"1/2\"",
        ] {
            assert!(lines[0].contains(part), "{part}: {}", lines[0]);
        }
        assert_eq!(
            lines[1],
            "variant,a,pose (measure),status,kutzbach,instantaneous,redundant,margin,finite,generic,verdict,pose,kind,class,\
             branches,locked,reason"
        );
        assert_eq!(
            table(Depth::Motions, Form::Csv).line(&row()),
            "7,0.5,1/3,analysed,-2,1,,1.23e5,1,,mobile,,,,1,\"b,c;d\",one\\ntwo\n"
        );
        assert_eq!(
            table(Depth::Rank, Form::Csv).line(&row()),
            "7,0.5,1/3,analysed,-2,1,,1.23e5,one\\ntwo\n"
        );
    }

    #[test]
    fn lines_say_again_what_they_were_made_of() {
        for form in [Form::Csv, Form::JsonLines] {
            for depth in [Depth::Rank, Depth::Verdict, Depth::Motions] {
                let table = table(depth, form);
                let mut row = row();
                if depth == Depth::Rank {
                    row.outcome.facts.verdict = None;
                }
                let side = table.side(&table.line(&row));
                assert_eq!(side, Some(Side::of(&row.outcome)), "{form:?} {depth:?}");
                row.outcome.status = Status::Invalid;
                row.outcome.facts = Facts::default();
                let side = table.side(&table.line(&row));
                assert_eq!(side, Some(Side::of(&row.outcome)), "{form:?} {depth:?}");
            }
            assert_eq!(table(Depth::Rank, form).side("variant,a"), None);
        }
        assert_eq!(csv_cells("a,\"b,\"\"c\"").unwrap(), ["a", "b,\"c"]);
        assert_eq!(csv_cells("").unwrap(), [""]);
        assert_eq!(csv_cells("a,\"b"), None);
    }

    #[test]
    fn lines_of_json_are_json() {
        let table = table(Depth::Motions, Form::JsonLines);
        let line = table.line(&row());
        assert!(line.starts_with(&table.start(7)) && line.ends_with("}\n"));
        let read: serde_json::Value = serde_json::from_str(&line).unwrap();
        assert_eq!(read["measures"]["a"], 0.5);
        assert_eq!(read["measures"]["pose"], "1/3");
        assert_eq!(read["margin"], 123_000.0);
        assert_eq!(read["locked"][1], "d");
        assert_eq!(read["reason"], "one\ntwo");
        assert!(read["redundant"].is_null());
        let head: serde_json::Value = serde_json::from_str(&table.head()).unwrap();
        assert_eq!(head["depth"], "motions");
        assert_eq!(head["variants"], 3);
    }
}
