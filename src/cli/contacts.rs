//! `kutzbach contacts FILE`: which parts of a STEP file touch, and the joints that their contacts are taken as.
//!
//! The same as JSON is a file that `--contacts` reads back; what a person changes in it counts.

use super::failure::Failure;
use super::{DONE, load, output, terminal};
use clap::Args;
use kutzbach::format::{
    ContactRow, ContactSeen, ContactTable, Corrections, MEMORY, PairCorrection, PairRule, Reason,
    contact_table, file_bytes,
};
use kutzbach::report::text::words::{counted, figure, metres};
use kutzbach::report::text::{Cell, Column, Page, Table, Tint};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// List which parts of a STEP file touch, and the joints that they make
#[derive(Debug, Args)]
pub struct Arguments {
    /// STEP file; `-` for standard input
    file: PathBuf,
    /// Write the list as JSON, which `--contacts` reads back: change what is not as it seems
    #[arg(long)]
    json: bool,
    /// Read corrections first: what single pairs are, the ground, the clearance
    #[arg(long, value_name = "FILE", value_parser = corrections, help_heading = "Reading the file")]
    contacts: Option<Corrections>,
    #[command(flatten)]
    destination: output::Destination,
    /// Show every pair
    #[arg(long, conflicts_with = "json")]
    verbose: bool,
}

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let none = Corrections::default();
    let corrections = arguments.contacts.as_ref().unwrap_or(&none);
    let found = match arguments.file == Path::new("-") {
        true => {
            let text = load::standard_input(MEMORY)?;
            contact_table(text.as_bytes(), load::STANDARD_INPUT, corrections)?
        }
        false => {
            let bytes = file_bytes(&arguments.file)?;
            contact_table(&bytes, &arguments.file.display().to_string(), corrections)?
        }
    };
    let text = match arguments.json {
        true => output::json(&Listed::of(&found))?,
        false => {
            let to_file = arguments.destination.file().is_some();
            page(&found, terminal::layout(to_file, arguments.verbose))
        }
    };
    arguments.destination.put(&text)?;
    Ok(DONE)
}

/// The list as JSON.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Listed {
    /// The part that is held.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    ground: Option<String>,
    /// The largest distance between faces that touch (m).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    clearance: Option<f64>,
    #[serde(default)]
    pairs: Vec<ListedPair>,
}

/// A pair of parts.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ListedPair {
    parts: [String; 2],
    /// What they are taken as, in a word of [`PairRule`]; `null` where their contacts are to say.
    #[serde(default)]
    is: Option<String>,
    /// Metres per turn, of screws.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lead: Option<f64>,
    /// Why: for a person, and not read back.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    because: Option<String>,
    /// Not read back.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    margin: Option<ListedMargin>,
    /// Not read back.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    contacts: Vec<ListedContact>,
}

/// How clearly contacts are a joint. Infinite sizes are `null`.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ListedMargin {
    #[serde(default)]
    kept: Option<f64>,
    #[serde(default)]
    dropped: Option<f64>,
}

/// A contact (m).
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ListedContact {
    kind: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    radius: Option<f64>,
    #[serde(default)]
    clearance: Option<f64>,
    #[serde(default)]
    size: Option<f64>,
}

impl Listed {
    fn of(table: &ContactTable) -> Self {
        Self {
            ground: Some(table.ground.clone()),
            clearance: Some(table.clearance),
            pairs: table.rows.iter().map(ListedPair::of).collect(),
        }
    }

    /// What is read back.
    fn corrections(self) -> Result<Corrections, String> {
        let mut pairs = Vec::new();
        for pair in self.pairs {
            let Some(word) = pair.is else {
                continue;
            };
            let Some(rule) = PairRule::from_word(&word) else {
                let [one, other] = &pair.parts;
                let hint = PairRule::hint(&word);
                return Err(format!(
                    "`{word}` is nothing that `{one}` and `{other}` can be: {hint}"
                ));
            };
            pairs.push(PairCorrection {
                parts: pair.parts,
                rule,
                lead: pair.lead,
            });
        }
        Ok(Corrections {
            ground: self.ground,
            clearance: self.clearance,
            pairs,
        })
    }
}

impl ListedPair {
    fn of(row: &ContactRow) -> Self {
        Self {
            parts: row.parts.clone(),
            // What the file says is read from it again: its joints may have no contact to take an axis from.
            is: (row.reason != Reason::Declared)
                .then_some(row.rule)
                .flatten()
                .map(|rule| rule.word().to_owned()),
            lead: row.lead.filter(|_| row.reason != Reason::Declared),
            because: Some(match &row.reason {
                Reason::Unclear(why) => format!("unclear: {why}"),
                reason => reason_word(reason).to_owned(),
            }),
            margin: row.margin.map(|margin| ListedMargin {
                kept: margin.kept.is_finite().then_some(margin.kept),
                dropped: Some(margin.dropped),
            }),
            contacts: row.contacts.iter().map(ListedContact::of).collect(),
        }
    }
}

impl ListedContact {
    fn of(seen: &ContactSeen) -> Self {
        Self {
            kind: seen.kind.to_owned(),
            radius: seen.radius,
            clearance: Some(seen.clearance),
            size: Some(seen.size),
        }
    }
}

/// Reads the file of a `--contacts`.
///
/// # Errors
/// A file that cannot be read; JSON of another form, with its line; a word that is no joint.
pub fn corrections(path: &str) -> Result<Corrections, String> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("cannot be read: {error}"))?;
    let listed: Listed = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    listed.corrections()
}

/// Why a pair is what it is, in a word.
fn reason_word(reason: &Reason) -> &'static str {
    match reason {
        Reason::Contacts => "contacts",
        Reason::Fastener => "fastener",
        Reason::Correction => "correction",
        Reason::Declared => "file",
        Reason::Unclear(_) => "unclear",
    }
}

fn page(found: &ContactTable, layout: kutzbach::report::text::Layout) -> String {
    let mut page = Page::new(layout);
    let summary = format!(
        "{} of parts with faces within {}. The ground is `{}`.",
        counted(found.rows.len(), "pair"),
        metres(found.clearance),
        found.ground
    );
    page.paragraph(&summary, Tint::Plain, "", "");
    for warning in &found.warnings {
        let times = match warning.count {
            1 => String::new(),
            count => format!(" ({count} times)"),
        };
        page.item(&format!("{}{times}", warning.message), Tint::Doubtful);
    }
    if !found.rows.is_empty() {
        page.heading("Contacts");
        let mut table = Table::new()
            .column("parts", Column::Shrinking)
            .column("contacts", Column::Shrinking)
            .column("joint", Column::Words)
            .column("because of", Column::Words)
            .column("margin", Column::Words);
        for row in &found.rows {
            table.row(cells(row));
        }
        page.table(table, "pairs");
    }
    page.into_text()
}

fn cells(row: &ContactRow) -> Vec<Cell> {
    let [one, other] = &row.parts;
    let joint = row.rule.map_or("–", PairRule::word);
    let clear = row.margin.map(|margin| margin.is_clear());
    let margin = match (clear, row.margin) {
        (Some(true), _) => "clear".to_owned(),
        (Some(false), Some(margin)) => format!("{}, not clear", figure(margin.gap())),
        _ => "–".to_owned(),
    };
    let tint = match row.rule {
        None => Tint::Doubtful,
        Some(_) => Tint::Plain,
    };
    vec![
        Cell::new(format!("{one} – {other}")),
        Cell::new(contacts_of(row)),
        Cell::new(joint).tint(tint),
        Cell::new(reason_word(&row.reason)),
        Cell::new(margin),
    ]
}

/// The contacts of a pair, equal ones once: `2 × cylindrical ⌀4 mm, 50 µm`.
fn contacts_of(row: &ContactRow) -> String {
    let mut kinds: Vec<(String, usize)> = Vec::new();
    for contact in &row.contacts {
        let text = contact_text(contact);
        match kinds.iter_mut().find(|(known, _)| *known == text) {
            Some((_, count)) => *count += 1,
            None => kinds.push((text, 1)),
        }
    }
    let counted = kinds.into_iter().map(|(text, count)| match count {
        1 => text,
        count => format!("{count} × {text}"),
    });
    let texts: Vec<String> = counted.collect();
    match texts.is_empty() {
        true => "none".to_owned(),
        false => texts.join("; "),
    }
}

fn contact_text(contact: &ContactSeen) -> String {
    let radius = contact
        .radius
        .map(|radius| format!(" ⌀{}", metres(2.0 * radius)));
    // Of faces that fit, digits are all that is left.
    let room = match contact.clearance.abs() < 1e-9 {
        true => String::new(),
        false => format!(", {} room", metres(contact.clearance)),
    };
    format!("{}{}{room}", contact.kind, radius.unwrap_or_default())
}
