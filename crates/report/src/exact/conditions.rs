//! Conditions on measures that were left open, as data and as a page.

use super::schema::{EXACT_SCHEMA, Outcome, Request, outcome};
use super::text::stopped;
use crate::text::words::counted;
use crate::text::{Layout, Page, Tint};
use kutzbach_algebra::{DesignConditions, Family, Meaning, PolynomialSystem, Stop};
use kutzbach_model::mechanism::Mechanism;
use serde::Serialize;

/// Conditions that are shown where the ways to satisfy them are shown as well.
const CONDITIONS: usize = 6;

/// A condition on the parameters.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ConditionRow {
    /// The polynomial that has to vanish.
    pub polynomial: String,
    /// Its factors, one of which has to vanish.
    pub factors: Vec<String>,
}

/// One way to satisfy all conditions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FamilyRow {
    /// How many parameters can be chosen freely.
    pub dimension: usize,
    /// The equations of the parameters.
    pub equations: Vec<String>,
}

/// Conditions on measures that were left open.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Conditions {
    /// [`EXACT_SCHEMA`].
    pub schema: &'static str,
    /// The mechanism.
    pub mechanism: String,
    /// The file.
    pub file: String,
    /// `assembly`, or the joint that is to take every position.
    pub question: String,
    /// The parameters: their variables.
    pub parameters: Vec<String>,
    /// Whether it came to its end.
    pub outcome: Outcome,
    /// What has to vanish; empty: no condition; `null` where it was not found.
    pub conditions: Option<Vec<ConditionRow>>,
    /// Ways to satisfy all conditions together; `null` where they were not asked for or not found.
    pub families: Option<Vec<FamilyRow>>,
    /// Whether every family is proven irreducible over the rationals.
    pub families_fully_split: Option<bool>,
    /// What the equations leave out of the mechanism.
    pub relaxations: Vec<String>,
}

/// Design conditions as data; `joint` is the one that is to move, if any. `families` are those of
/// [`DesignConditions::families`].
#[must_use]
pub fn conditions_report(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    found: Result<&DesignConditions, Stop>,
    families: Option<&(Vec<Family>, bool)>,
    joint: Option<&str>,
    request: &Request,
) -> Conditions {
    let names = system.names();
    let text = |p: &kutzbach_algebra::Polynomial| p.text(&names);
    Conditions {
        schema: EXACT_SCHEMA,
        mechanism: mechanism.name().to_owned(),
        file: request.file.clone(),
        question: joint.unwrap_or("assembly").to_owned(),
        parameters: (0..names.len())
            .filter(|&v| matches!(system.variables[v].meaning, Meaning::Parameter { .. }))
            .map(|v| names[v].clone())
            .collect(),
        outcome: outcome(found.err().map(|stop| ("the elimination", stop))),
        conditions: found.ok().map(|found| {
            let row = |condition: &kutzbach_algebra::Condition| ConditionRow {
                polynomial: text(&condition.polynomial),
                factors: condition.factors.iter().map(&text).collect(),
            };
            found.conditions.iter().map(row).collect()
        }),
        families: families.map(|(families, _)| {
            let row = |family: &Family| FamilyRow {
                dimension: family.dimension,
                equations: family.equations.iter().map(&text).collect(),
            };
            families.iter().map(row).collect()
        }),
        families_fully_split: families.map(|(_, complete)| *complete),
        relaxations: system.relaxations.iter().map(ToString::to_string).collect(),
    }
}

/// Design conditions as a page of text.
#[must_use]
pub fn render_conditions(report: &Conditions, layout: Layout) -> String {
    let mut page = Page::new(layout);
    let does = if report.question == "assembly" {
        "can be put together".to_owned()
    } else {
        format!("can move with `{}` taking every position", report.question)
    };
    let headline = match report.conditions.as_deref() {
        None => "Undecided: the computation ended before it had an answer.".to_owned(),
        Some([]) => format!("It {does} whatever the values (complex ones included)."),
        Some([one]) if one.polynomial == "1" => format!("There are no values for which it {does}."),
        Some([one]) if one.factors.len() == 1 => {
            format!("It {does} only if {} = 0.", one.factors[0])
        }
        Some(_) => format!("It {does} only if all of this holds:"),
    };
    page.paragraph(&headline, Tint::Strong, "", "");
    if let Some(sentence) = stopped(&report.outcome) {
        page.item(&sentence, Tint::Doubtful);
    }
    let rows = report.conditions.as_deref().unwrap_or_default();
    let shown = match (&report.families, page.layout().verbose) {
        (Some(families), false) if !families.is_empty() && rows.len() > CONDITIONS => CONDITIONS,
        _ => rows.len(),
    };
    if rows.len() > 1 || rows.iter().any(|row| row.factors.len() > 1) {
        for row in &rows[..shown] {
            let ways: Vec<String> = row.factors.iter().map(|f| format!("{f} = 0")).collect();
            page.item(&ways.join(" or "), Tint::Plain);
        }
        if shown < rows.len() {
            let left = counted(rows.len() - shown, "condition");
            page.item(&format!("{left} more, listed with --verbose"), Tint::Quiet);
        }
    }
    if let Some(families) = report.families.as_deref().filter(|_| rows.len() > 1) {
        page.heading("Ways to satisfy all of it");
        for (index, family) in families.iter().enumerate() {
            let equations: Vec<String> = family
                .equations
                .iter()
                .map(|e| format!("{e} = 0"))
                .collect();
            page.item(
                &format!(
                    "{}: {} ({} free)",
                    index + 1,
                    equations.join(", "),
                    counted(family.dimension, "measure")
                ),
                Tint::Plain,
            );
        }
        if families.is_empty() {
            page.item("none where no denominator vanishes", Tint::Notable);
        }
        if report.families_fully_split == Some(false) {
            page.item(
                "not split further: some of them may fall apart into more",
                Tint::Notable,
            );
        }
    }
    for relaxation in &report.relaxations {
        page.item(relaxation, Tint::Notable);
    }
    page.gap();
    page.paragraph(
        &format!(
            "{} ({}), left open: {}. The conditions are necessary; complex solutions count.",
            report.mechanism,
            report.file,
            report.parameters.join(", ")
        ),
        Tint::Quiet,
        "",
        "",
    );
    page.into_text()
}
