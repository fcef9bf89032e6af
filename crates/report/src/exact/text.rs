//! The exact report as a page.

use super::motions::cluster_text;
use super::schema::{ExactReport, Outcome, Piece};
use crate::text::words::{counted, figure};
use crate::text::{Cell, Column, Layout, Page, Table, Tint};

/// Sets of free variables that are shown.
const FREE_SHOWN: usize = 4;

/// Isolated solutions that are shown, unless everything is asked for.
const SOLUTIONS_SHOWN: usize = 8;

/// The report as a page of text, ending in a line break.
#[must_use]
pub fn render(report: &ExactReport, layout: Layout) -> String {
    let mut page = Page::new(layout);
    page.paragraph(&headline(report), Tint::Strong, "", "");
    if let Some(sentence) = stopped(&report.outcome) {
        page.item(&sentence, Tint::Doubtful);
    }
    if let Some(modulo) = &report.dimension_modulo {
        let found = match modulo.dimension {
            Some(dimension) => format!("the dimension is {dimension}"),
            None => "the equations contradict one another".to_owned(),
        };
        page.item(
            &format!(
                "modulo the prime {} {found}; over the rationals not computed: evidence, no proof",
                modulo.prime
            ),
            Tint::Notable,
        );
    }
    if let Some(sentence) = at_home(report) {
        page.item(&sentence, Tint::Plain);
    }
    if report.rounded_numbers_taken_literally {
        page.item(
            "the decimals of the file are taken literally, as fractions: what is special about the mechanism that was \
             meant (a length equal to a square root, say) is lost with the digits left out; write such numbers as \
             expressions",
            Tint::Notable,
        );
    }
    for relaxation in &report.relaxations {
        page.item(
            &format!("{relaxation}; dimensions are upper bounds"),
            Tint::Notable,
        );
    }
    page.gap();
    let held = match report.held.as_slice() {
        [] => String::new(),
        held => format!(", held: {}", held.join(", ")),
    };
    page.paragraph(
        &format!(
            "{} ({}{held}): {} and {} in {} form; basis by {}, {}.",
            report.mechanism,
            report.file,
            counted(report.variables.len(), "variable"),
            counted(report.equation_count, "equation"),
            report.formulation,
            match report.method {
                "divide" => "divide and conquer over the cycles",
                "incremental" => "incremental instancing",
                _ => "brute force",
            },
            report.order
        ),
        Tint::Quiet,
        "",
        "",
    );
    for chart in &report.charts {
        page.item(chart, Tint::Quiet);
    }
    variables(report, &mut page);
    pieces(report, &mut page);
    solutions(report, &mut page);
    cycles(report, &mut page);
    instanced(report, &mut page);
    steps(report, &mut page);
    listing("Equations", report.equations.as_deref(), &mut page);
    listing("Basis", report.basis.as_deref(), &mut page);
    if let Some(certificate) = &report.certificate {
        page.heading("What was checked");
        page.paragraph(&format!("{certificate}."), Tint::Plain, "  ", "  ");
    }
    page.into_text()
}

fn headline(report: &ExactReport) -> String {
    let rounded = report.rounded_numbers_taken_literally;
    match (report.consistent, report.dimension) {
        (Some(false), _) if rounded => {
            "Undecided: taken literally, the file's decimals contradict one another, which need not hold of the mechanism meant; `report` gives the verdict within the digits."
                .to_owned()
        }
        (_, Some(0)) if rounded => {
            "Undecided: taken literally, the file's decimals leave finitely many poses (dimension 0), which need not hold of the mechanism meant; `report` gives the verdict within the digits."
                .to_owned()
        }
        (Some(false), _) => {
            "The equations contradict one another: no pose satisfies them, not even a complex one."
                .to_owned()
        }
        (_, Some(0)) => "Finitely many poses satisfy the equations (dimension 0).".to_owned(),
        (_, Some(dimension)) => {
            let degree = report
                .degree
                .map_or(String::new(), |degree| format!(", degree {degree}"));
            format!("The solutions have complex dimension {dimension}{degree}.")
        }
        _ => match report.dimension_at_home_within {
            Some([least, most]) if least == most && !rounded => format!(
                "At the pose drawn the solutions have complex dimension {most}; of other poses nothing is said."
            ),
            _ => "Undecided: the computation ended before it had an answer.".to_owned(),
        },
    }
}

/// Where and why it ended early, if it did.
pub(super) fn stopped(outcome: &Outcome) -> Option<String> {
    let why = outcome.why.as_ref()?;
    Some(format!(
        "stopped at {}: {why}; what is said here holds, but more may hold",
        outcome.at.unwrap_or("some step")
    ))
}

fn at_home(report: &ExactReport) -> Option<String> {
    match report.drawn_pose {
        "open" => Some(
            "the pose drawn in the file does not satisfy the equations: the mechanism has to be assembled first"
                .to_owned(),
        ),
        "unknown" => Some("the pose drawn in the file is not known exactly".to_owned()),
        _ if report.dimension_at_home.is_none() => {
            report.dimension_at_home_within.map(|[least, most]| {
                let bounds = "by the number of equations and by their rank there";
                match least == most {
                    true => format!("at the pose drawn the complex dimension is {most}, {bounds}"),
                    false => format!(
                        "at the pose drawn the complex dimension is at least {least} and at most {most}, {bounds}"
                    ),
                }
            })
        }
        _ => report.dimension_at_home.map(|dimension| {
            let real = report.pieces.iter().flatten().any(|p| {
                p.contains_home == Some(true) && p.dimension == dimension && p.real == "not found"
            });
            let caution = if real && dimension > 0 {
                "; no real point but isolated ones was found on it, so that complex freedom need not be motion"
            } else {
                ""
            };
            format!("at the pose drawn the complex dimension is {dimension}{caution}")
        }),
    }
}

fn variables(report: &ExactReport, page: &mut Page) {
    let facts = [
        report.free.len(),
        report.fixed_joints.len(),
        report.rigid_clusters.len(),
        report.motions.len(),
    ];
    if facts == [0; 4] {
        return;
    }
    page.heading("Free and fixed");
    if report.dimension.is_some_and(|d| d > 0) && !report.free.is_empty() {
        let shown: Vec<String> = report
            .free
            .iter()
            .take(FREE_SHOWN)
            .map(|set| set.join(", "))
            .collect();
        let more = report.free.len().saturating_sub(shown.len());
        let more = if more > 0 {
            format!("; or one of {more} other sets")
        } else {
            String::new()
        };
        page.item(&format!("free: {}{more}", shown.join("; or ")), Tint::Good);
    }
    for fixed in &report.fixed_joints {
        page.item(&fixed.text, Tint::Plain);
    }
    for cluster in &report.rigid_clusters {
        let text = format!("{} in every assembly mode", cluster_text(cluster));
        page.item(&text, Tint::Plain);
    }
    for motion in &report.motions {
        page.item(&motion.text, Tint::Good);
    }
    if let Some(unsettled) = &report.motions_unsettled {
        page.item(unsettled, Tint::Doubtful);
    }
}

fn pieces(report: &ExactReport, page: &mut Page) {
    let Some(pieces) = report.pieces.as_ref().filter(|pieces| !pieces.is_empty()) else {
        return;
    };
    page.heading("Pieces of the solution set");
    let mut table = Table::new()
        .column("", Column::Numbers)
        .column("dimension", Column::Numbers)
        .column("degree", Column::Numbers)
        .column("one piece over the rationals", Column::Words)
        .column("real points", Column::Words)
        .column("pose drawn", Column::Words);
    for (index, piece) in pieces.iter().enumerate() {
        table.row(vec![
            Cell::new((index + 1).to_string()),
            Cell::new(piece.dimension.to_string()),
            Cell::new(piece.degree.map_or("?".to_owned(), |d| d.to_string())),
            Cell::new(piece.irreducible),
            Cell::new(real_words(piece)),
            Cell::new(match (piece.contains_home, piece.same_poses_as) {
                (_, Some(first)) => format!("the poses of {first}"),
                (Some(true), None) => "on it".to_owned(),
                (Some(false), None) => String::new(),
                (None, None) => "?".to_owned(),
            }),
        ]);
    }
    page.table(table, "pieces");
    let different = pieces.iter().filter(|piece| piece.same_poses_as.is_none());
    let different = different.count();
    if different < pieces.len() {
        page.item(
            &format!(
                "up to the sign of quaternions, which makes no difference to the poses, {}",
                counted(different, "piece")
            ),
            Tint::Plain,
        );
    }
    for (index, piece) in pieces.iter().enumerate() {
        // What is free on the largest ones is said above.
        if !report.free.contains(&piece.free) && !piece.free.is_empty() {
            page.item(
                &format!("free on piece {}: {}", index + 1, piece.free.join(", ")),
                Tint::Plain,
            );
        }
    }
    if !report.fully_split {
        page.item(
            "not split further: some piece may fall apart into more",
            Tint::Notable,
        );
    }
}

fn real_words(piece: &Piece) -> String {
    match (piece.real, piece.real_points) {
        (_, Some(count)) => count.to_string(),
        ("full dimension", _) => format!("of dimension {}", piece.dimension),
        (word, _) => word.to_owned(),
    }
}

fn solutions(report: &ExactReport, page: &mut Page) {
    let Some(solutions) = &report.solutions else {
        return;
    };
    page.heading("Solutions");
    let (complex, real) = (solutions.complex, solutions.real.len());
    let counts = match solutions.conjugates_of.as_slice() {
        [] => format!("{complex} complex, of which {real} real"),
        numbers => format!(
            "{real} real, of {complex} complex ones with every conjugate of {}",
            numbers.join(", ")
        ),
    };
    page.item(&counts, Tint::Plain);
    let shown = if page.layout().verbose {
        solutions.real.len()
    } else {
        SOLUTIONS_SHOWN
    };
    for solution in solutions.real.iter().take(shown) {
        let values: Vec<String> = report
            .variables
            .iter()
            .zip(solution)
            .map(|(name, value)| format!("{name} = {}", figure(*value)))
            .collect();
        page.item(&values.join(", "), Tint::Quiet);
    }
    let left = solutions.real.len().saturating_sub(shown);
    if left > 0 {
        page.item(&format!("and {left} more"), Tint::Quiet);
    }
}

fn cycles(report: &ExactReport, page: &mut Page) {
    if report.cycles.is_empty() {
        return;
    }
    page.heading("Cycles by themselves");
    for cycle in &report.cycles {
        let dimension = match cycle.dimension {
            None => "cannot be closed".to_owned(),
            Some(dimension) => format!("dimension {dimension}"),
        };
        page.item(&format!("cycle {}: {dimension}", cycle.name), Tint::Plain);
        let mut fact = |text: &str, tint: Tint| page.paragraph(text, tint, "      - ", "        ");
        for motion in &cycle.motions {
            fact(&motion.text, Tint::Good);
        }
        for cluster in &cycle.rigid_clusters {
            fact(&cluster_text(cluster), Tint::Plain);
        }
        for fixed in &cycle.fixed_joints {
            fact(&fixed.text, Tint::Plain);
        }
        if let Some(unsettled) = &cycle.motions_unsettled {
            fact(unsettled, Tint::Doubtful);
        }
    }
}

/// What the cycles gave the unknowns, one after the other.
fn instanced(report: &ExactReport, page: &mut Page) {
    let Some(cycles) = report.instanced.as_ref().filter(|all| !all.is_empty()) else {
        return;
    };
    page.heading("Put into what follows");
    for cycle in cycles {
        let several = cycle.cases.len() > 1;
        for (index, case) in cycle.cases.iter().enumerate() {
            let number = match several {
                true => format!(", case {}", index + 1),
                false => String::new(),
            };
            let rows = case
                .iter()
                .map(|row| format!("{} = {}", row.variable, row.value));
            let rows: Vec<String> = rows.collect();
            let said = match rows.is_empty() {
                true => "nothing".to_owned(),
                false => rows.join(", "),
            };
            page.item(&format!("{}{number}: {said}", cycle.cycle), Tint::Plain);
        }
    }
}

fn steps(report: &ExactReport, page: &mut Page) {
    if report.steps.is_empty() {
        return;
    }
    page.heading("Steps");
    let timed = report.steps.iter().any(|step| step.seconds.is_some());
    let mut table = Table::new()
        .column("", Column::Shrinking)
        .column("variables", Column::Numbers)
        .column("equations", Column::Numbers)
        .column("basis", Column::Numbers)
        .column("dimension", Column::Numbers)
        .column("work", Column::Numbers);
    if timed {
        table = table.column("ms", Column::Numbers);
    }
    for step in &report.steps {
        let mut row = vec![
            Cell::new(&step.name),
            Cell::new(step.variables.to_string()),
            Cell::new(step.equations.to_string()),
            Cell::new(step.basis.to_string()),
            Cell::new(step.dimension.map_or("none".to_owned(), |d| d.to_string())),
            Cell::new(step.work.to_string()),
        ];
        if timed {
            row.push(Cell::new(figure(step.seconds.unwrap_or(0.0) * 1e3)));
        }
        table.row(row);
    }
    page.table(table, "steps");
    for (index, cases) in report.cases.iter().flatten().enumerate() {
        let several = report.cases.as_ref().is_some_and(|parts| parts.len() > 1);
        let part = match several {
            true => format!("part {} of the equations: ", index + 1),
            false => String::new(),
        };
        let dimensions: Vec<String> = cases.iter().map(ToString::to_string).collect();
        page.item(
            &format!(
                "{part}{} carried to the end, of dimension {}",
                counted(cases.len(), "case"),
                dimensions.join(", ")
            ),
            Tint::Plain,
        );
    }
}

fn listing(title: &str, lines: Option<&[String]>, page: &mut Page) {
    let Some(lines) = lines else {
        return;
    };
    page.heading(title);
    for line in lines {
        page.paragraph(line, Tint::Plain, "  ", "      ");
    }
}
