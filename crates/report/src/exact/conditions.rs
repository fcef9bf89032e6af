//! Conditions on measures that were left open, as data and as a page.

use super::schema::{EXACT_SCHEMA, Outcome, Request, outcome};
use super::text::stopped;
use crate::text::words::counted;
use crate::text::{Layout, Page, Tint};
use kutzbach_algebra::{
    DesignConditions, Exception, Exceptions, Family, Meaning, PolynomialSystem, Reach, Stop,
};
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

/// Values without a solution although they satisfy all conditions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExceptionRow {
    /// The values: where all of these vanish.
    pub on: Vec<String>,
    /// What has to vanish there as well; `1` where nothing helps.
    pub only_if: Vec<String>,
}

/// A length that must not be larger than others together, for a pose in real numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReachRow {
    /// The joints that keep the ends of the side; the same twice for a rod.
    pub between: [String; 2],
    /// How far these are apart at least.
    pub apart: String,
    /// The lengths that have to make up for it.
    pub others: Vec<String>,
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
    /// Whether it came to its end; `in part` where a relation of the mechanism is left out, and conditions may be missing.
    pub outcome: Outcome,
    /// What has to vanish; empty: no condition; `null` where it was not found.
    pub conditions: Option<Vec<ConditionRow>>,
    /// Ways to satisfy all conditions together; `null` where they were not asked for or not found.
    pub families: Option<Vec<FamilyRow>>,
    /// Whether every family is proven irreducible over the rationals.
    pub families_fully_split: Option<bool>,
    /// Values that satisfy the conditions and have no solution, not even a complex one; `null` where there are no conditions.
    pub exceptions: Option<Vec<ExceptionRow>>,
    /// Whether these are all.
    pub exceptions_complete: Option<bool>,
    /// What has to hold as well for a pose in real numbers, as far as it is the sides of loops: necessary.
    pub reaches: Vec<ReachRow>,
    /// What the equations leave out of the mechanism.
    pub relaxations: Vec<String>,
}

/// Design conditions as data; `joint` is the one that is to move, if any. `families` are those of
/// [`DesignConditions::families`], `exceptions` those of [`DesignConditions::exceptions`].
#[must_use]
pub fn conditions_report(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    found: Result<&DesignConditions, Stop>,
    families: Option<&(Vec<Family>, bool)>,
    exceptions: Option<&Exceptions>,
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
        outcome: match found {
            Ok(_) if !system.is_exact() => Outcome {
                word: "in part",
                ..outcome(None)
            },
            _ => outcome(found.err().map(|stop| ("the elimination", stop))),
        },
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
        exceptions: exceptions.map(|all| {
            let row = |exception: &Exception| ExceptionRow {
                on: exception.on.iter().map(&text).collect(),
                only_if: exception.only_if.iter().map(&text).collect(),
            };
            all.found.iter().map(row).collect()
        }),
        exceptions_complete: exceptions.map(|all| all.complete),
        reaches: {
            let found = system.reaches().into_iter();
            found.map(|reach| reach_row(mechanism, reach)).collect()
        },
        relaxations: system.relaxations.iter().map(ToString::to_string).collect(),
    }
}

/// Design conditions as a page of text.
#[must_use]
pub fn render_conditions(report: &Conditions, layout: Layout) -> String {
    let mut page = Page::new(layout);
    let headline = headline(report);
    page.paragraph(&headline, Tint::Strong, "", "");
    if let Some(sentence) = stopped(&report.outcome) {
        page.item(&sentence, Tint::Doubtful);
    }
    let rows = report.conditions.as_deref().unwrap_or_default();
    // Where no values will do, there is nothing to choose from.
    let rows = match rows.iter().any(|row| row.factors.is_empty()) {
        true => &[],
        false => rows,
    };
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
    for exception in report.exceptions.iter().flatten() {
        page.item(&exception_text(exception), Tint::Notable);
    }
    for reach in impossible_or(&report.reaches, report) {
        page.item(&reach_text(reach), Tint::Notable);
    }
    if report.exceptions_complete == Some(false) {
        page.item("there may be other exceptions", Tint::Notable);
    }
    for relaxation in &report.relaxations {
        page.item(relaxation, Tint::Notable);
    }
    page.gap();
    let open = match report.parameters.as_slice() {
        [] => "nothing that is left open enters the equations".to_owned(),
        some => format!("left open: {}", some.join(", ")),
    };
    page.paragraph(
        &format!(
            "{} ({}), {open}. The conditions are necessary. Complex solutions count: where none is excluded, real ones may ask for more.",
            report.mechanism, report.file
        ),
        Tint::Quiet,
        "",
        "",
    );
    page.into_text()
}

/// The answer in a sentence.
fn headline(report: &Conditions) -> String {
    let does = if report.question == "assembly" {
        "can be put together".to_owned()
    } else {
        format!("can move with `{}` taking every position", report.question)
    };
    let real = match report.reaches.is_empty() {
        true => "is not said",
        false => "at most where lengths reach",
    };
    let some_left_out = !report.relaxations.is_empty();
    let has_exceptions = report.exceptions.as_ref().is_none_or(|all| !all.is_empty());
    match report.conditions.as_deref() {
        None => "Undecided: the computation ended before it had an answer.".to_owned(),
        Some([]) if some_left_out => format!(
            "Undecided whether it {does}: what the equations hold restricts no value, but they do not hold all of the mechanism."
        ),
        Some([]) if has_exceptions || report.exceptions_complete != Some(true) => {
            format!("It {does} for almost all values, in complex numbers; in real ones {real}.")
        }
        Some([]) => {
            format!("It {does} whatever the values, in complex numbers; in real ones {real}.")
        }
        Some(rows) if rows.iter().any(|row| row.factors.is_empty()) => {
            format!("There are no values for which it {does}.")
        }
        Some([one]) if one.factors.len() == 1 => {
            format!("It {does} only if {} = 0.", one.factors[0])
        }
        Some(_) => format!("It {does} only if all of this holds:"),
    }
}

/// How far lengths have to reach; nothing where there is no pose whatever they do.
fn impossible_or<'a>(reaches: &'a [ReachRow], report: &Conditions) -> &'a [ReachRow] {
    let rows = report.conditions.iter().flatten();
    match rows.into_iter().any(|row| row.factors.is_empty()) {
        true => &[],
        false => reaches,
    }
}

fn reach_text(reach: &ReachRow) -> String {
    let [one, other] = &reach.between;
    let who = match one == other {
        true => format!("`{one}` is that long"),
        false => format!("`{one}` and `{other}` are that far apart"),
    };
    let needed = inequality(&reach.apart, &reach.others);
    format!("in real numbers only where {needed}: {who}")
}

/// A length, and what has to make up for it.
pub(crate) fn inequality(apart: &str, others: &[String]) -> String {
    match others {
        [] => format!("{apart} <= 0"),
        others => format!("{apart} <= {}", others.join(" + ")),
    }
}

fn reach_row(mechanism: &Mechanism, reach: Reach) -> ReachRow {
    ReachRow {
        between: reach
            .between
            .map(|joint| mechanism.joint(joint).name.clone()),
        apart: reach.apart,
        others: reach.others,
    }
}

/// Where there is no solution.
fn exception_text(exception: &ExceptionRow) -> String {
    let zero = |all: &[String]| {
        let equations: Vec<String> = all.iter().map(|p| format!("{p} = 0")).collect();
        equations.join(" and ")
    };
    match exception.only_if.as_slice() {
        [one] if one == "1" => format!("not where {}", zero(&exception.on)),
        only_if => format!("where {} only if {}", zero(&exception.on), zero(only_if)),
    }
}
