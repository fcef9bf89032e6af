//! Relations added one by one, as data and as a page.

use super::schema::{EXACT_SCHEMA, Outcome, Request, formulation_word, outcome};
use super::text::stopped;
use crate::text::words::counted;
use crate::text::{Cell, Column, Layout, Page, Table, Tint};
use kutzbach_algebra::{PolynomialSystem, Relation, RelationFinding, RelationVerdict, Stop};
use kutzbach_model::mechanism::Mechanism;
use serde::Serialize;

/// One relation and what it adds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RelationRow {
    /// The joint, cycle or coupling.
    pub name: String,
    /// `accepted`, `redundant`, `inconsistent` or `not reached`.
    pub verdict: &'static str,
    /// Complex dimension of what the relations accepted so far leave possible; none where time did not suffice for it.
    pub dimension: Option<usize>,
    /// Polynomials of the basis after it; in positional form, of the loops that it is in.
    pub basis: Option<usize>,
    /// Of one that is redundant or inconsistent, in positional form: earlier ones that alone make it so.
    pub because_of: Vec<String>,
}

/// Relations added one by one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Relations {
    /// [`EXACT_SCHEMA`].
    pub schema: &'static str,
    /// The mechanism.
    pub mechanism: String,
    /// The file.
    pub file: String,
    /// `canonical`, `tree` or `positional`.
    pub formulation: &'static str,
    /// Whether it came to its end.
    pub outcome: Outcome,
    /// In the order in which they were added.
    pub relations: Vec<RelationRow>,
    /// What the equations leave out of the mechanism.
    pub relaxations: Vec<String>,
}

/// The management of constraints as data; `at_home` says of the relations after those with findings which are accepted all the same.
#[must_use]
pub fn relations_report(
    mechanism: &Mechanism,
    (system, relations): (&PolynomialSystem, &[Relation]),
    (findings, at_home): (&[RelationFinding], &[bool]),
    stopped: Option<Stop>,
    request: &Request,
) -> Relations {
    let known = at_home.iter().copied().chain(std::iter::repeat(false));
    let later = relations.iter().skip(findings.len()).zip(known);
    Relations {
        schema: EXACT_SCHEMA,
        mechanism: mechanism.name().to_owned(),
        file: request.file.clone(),
        formulation: formulation_word(request.options.system.formulation),
        outcome: outcome(stopped.map(|stop| ("the relations", stop))),
        relations: findings
            .iter()
            .map(|finding| row(finding, relations))
            .chain(later.map(|(relation, accepted)| without_basis(relation, accepted)))
            .collect(),
        relaxations: system.relaxations.iter().map(ToString::to_string).collect(),
    }
}

fn row(finding: &RelationFinding, relations: &[Relation]) -> RelationRow {
    let because_of = finding.because_of.iter();
    RelationRow {
        name: finding.name.clone(),
        verdict: match finding.verdict {
            RelationVerdict::Accepted => "accepted",
            RelationVerdict::Redundant => "redundant",
            RelationVerdict::Inconsistent => "inconsistent",
        },
        dimension: Some(finding.dimension),
        basis: Some(finding.basis),
        because_of: because_of
            .map(|&earlier| relations[earlier].name.clone())
            .collect(),
    }
}

fn without_basis(relation: &Relation, accepted: bool) -> RelationRow {
    RelationRow {
        name: relation.name.clone(),
        verdict: match accepted {
            true => "accepted",
            false => NOT_REACHED,
        },
        dimension: None,
        basis: None,
        because_of: Vec::new(),
    }
}

const NOT_REACHED: &str = "not reached";

/// Relations added one by one, as a page of text.
#[must_use]
pub fn render_relations(report: &Relations, layout: Layout) -> String {
    let mut page = Page::new(layout);
    let count = |word: &str| {
        report
            .relations
            .iter()
            .filter(|relation| relation.verdict == word)
            .count()
    };
    page.paragraph(
        &format!(
            "Of {}, {} accepted, {} redundant, {} inconsistent{}.",
            counted(report.relations.len(), "relation"),
            count("accepted"),
            count("redundant"),
            count("inconsistent"),
            match count(NOT_REACHED) {
                0 => String::new(),
                left => format!(", {left} {NOT_REACHED}"),
            }
        ),
        Tint::Strong,
        "",
        "",
    );
    if let Some(sentence) = stopped(&report.outcome) {
        page.item(&sentence, Tint::Doubtful);
    }
    for relaxation in &report.relaxations {
        page.item(relaxation, Tint::Notable);
    }
    page.gap();
    page.paragraph(
        &format!(
            "{} ({}), in {} form; relations in the order of the file.",
            report.mechanism, report.file, report.formulation
        ),
        Tint::Quiet,
        "",
        "",
    );
    page.gap();
    let mut table = Table::new()
        .column("relation", Column::Shrinking)
        .column("", Column::Words)
        .column("dimension after it", Column::Numbers)
        .column("basis", Column::Numbers)
        .column("because of", Column::Words);
    let number = |value: Option<usize>| value.map_or_else(String::new, |value| value.to_string());
    for relation in &report.relations {
        let tint = match relation.verdict {
            "accepted" => Tint::Good,
            "redundant" => Tint::Notable,
            NOT_REACHED => Tint::Doubtful,
            _ => Tint::Bad,
        };
        table.row(vec![
            Cell::new(&relation.name),
            Cell::new(relation.verdict).tint(tint),
            Cell::new(number(relation.dimension)),
            Cell::new(number(relation.basis)),
            Cell::new(relation.because_of.join(", ")),
        ]);
    }
    page.table(table, "relations");
    page.into_text()
}
