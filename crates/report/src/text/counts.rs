//! The counts, and the sentence that says why they differ from Kutzbach's.

use super::cite;
use super::page::Page;
use super::style::Tint;
use super::table::{Cell, Column, Table};
use super::verdict;
use super::words::{capitalised, counted, figure};
use crate::schema::{GenericCount, Home, Report};
use kutzbach_mobility::{PoseKind, SingularKind, Verdict};

/// Writes the counts.
pub(crate) fn write(report: &Report, page: &mut Page) {
    let verbose = page.layout().verbose;
    // Of a tree the answer says it all.
    if !verbose && verdict::without_loops(report) && report.home.note.is_none() {
        return;
    }
    page.heading("Freedoms");
    let mut table = Table::new()
        .column("", Column::Words)
        .column("", Column::Numbers)
        .column("", Column::Shrinking);
    let mut row = |what: &str, number: String, how: String| {
        table.row(count_row(what, &number, &how));
    };
    row(
        "Kutzbach's count",
        report.kutzbach.to_string(),
        formula(report),
    );
    if let Some(generic) = &report.generic {
        row(
            "at random geometry",
            generic.mobility.to_string(),
            format!(
                "same links and joints, other dimensions: {} redundant",
                generic.redundant
            ),
        );
    }
    let home = &report.home;
    if report.mobility.verdict == Verdict::Unassembled {
        page.table(table, "counts");
        page.paragraph(
            "No closed pose is known, so nothing but counting can be said.",
            Tint::Plain,
            "  ",
            "  ",
        );
        return;
    }
    let mut row = |what: &str, number: String, how: String| {
        table.row(count_row(what, &number, &how));
    };
    row(
        "at this pose",
        optional(home.instantaneous),
        match home.rank {
            Some(rank) => format!(
                "instantaneous: {} less rank {rank}, of {}",
                counted(home.unknowns, "variable"),
                counted(home.equations, "constraint equation")
            ),
            None => format!(
                "instantaneous, between {} and {}",
                home.candidates[0], home.candidates[1]
            ),
        },
    );
    row(
        "in finite motion",
        optional(report.mobility.finite),
        match (report.mobility.finite, report.mobility.bounds) {
            (None, [None, None]) => "not bounded yet".to_owned(),
            (None, [Some(least), None]) => format!("at least {least}"),
            (None, [None, Some(most)]) => format!("at most {most}"),
            (None, [Some(least), Some(most)]) => format!("between {least} and {most}"),
            (Some(_), _) => String::new(),
        },
    );
    row(
        "redundant",
        home.redundant
            .map_or_else(|| "?".to_owned(), |n| n.to_string()),
        "constraint equations that repeat others at this pose".to_owned(),
    );
    page.table(table, "counts");
    // A first screen leaves out what only repeats the table.
    let decided = home.instantaneous.is_some() && home.redundant.is_some();
    let adds = |generic: &GenericCount| Some(generic.mobility) != home.instantaneous;
    let sentences = [
        (verbose || !decided).then(|| difference(report)),
        geometry(report).filter(|_| verbose || report.generic.as_ref().is_some_and(adds)),
        pose(home),
        match verbose {
            true => margin(report),
            false => short_margin(report),
        },
    ];
    for sentence in sentences.into_iter().flatten() {
        page.paragraph(&sentence, Tint::Plain, "  ", "  ");
    }
    if let Some(note) = &home.note {
        page.paragraph(&capitalised(note), Tint::Doubtful, "  ", "  ");
    }
}

fn count_row(what: &str, number: &str, how: &str) -> Vec<Cell> {
    vec![
        Cell::new(what),
        Cell::new(number).tint(Tint::Strong),
        Cell::new(how).tint(Tint::Quiet),
    ]
}

fn optional(count: Option<usize>) -> String {
    count.map_or_else(|| "?".to_owned(), |n| n.to_string())
}

/// Kutzbach's formula with the numbers of this mechanism.
fn formula(report: &Report) -> String {
    let size = &report.size;
    let removed = (6 * size.joints).saturating_sub(size.freedoms);
    let mut text = format!("6 × ({} − 1) − {removed}", counted(size.links, "link"));
    if size.couplings > 0 {
        text.push_str(&format!(" − {}", counted(size.couplings, "coupling")));
    }
    text
}

/// Why the freedom at the pose is not Kutzbach's count.
fn difference(report: &Report) -> String {
    let home = &report.home;
    let count = report.kutzbach;
    match (home.instantaneous, home.redundant) {
        (Some(freedom), Some(0)) if report.size.loops == 0 && report.size.couplings == 0 => {
            format!(
                "Kutzbach counts {count}: there is no loop, so every joint is free and {} at this pose.",
                remain(freedom)
            )
        }
        (Some(freedom), Some(0)) => format!(
            "Kutzbach counts {count}, and rightly at this pose: none of the {} repeats another, so {}.",
            counted(home.equations, "constraint equation"),
            remain(freedom)
        ),
        (Some(freedom), Some(redundant)) => format!(
            "Kutzbach counts {count}; {redundant} of the {} {} what others say, so {} at this pose.",
            counted(home.equations, "constraint equation"),
            if redundant == 1 { "repeats" } else { "repeat" },
            remain(freedom)
        ),
        _ => format!(
            "Kutzbach counts {count}; how many of the {} are independent is not decided.",
            counted(home.equations, "constraint equation")
        ),
    }
}

fn remain(freedom: usize) -> String {
    match freedom {
        0 => "no freedom remains".to_owned(),
        1 => "1 freedom remains".to_owned(),
        n => format!("{n} freedoms remain"),
    }
}

/// What the special dimensions add to what links and joints alone would allow.
fn geometry(report: &Report) -> Option<String> {
    let generic = report.generic.as_ref()?;
    let freedom = report.home.instantaneous?;
    let text = match freedom.checked_sub(generic.mobility)? {
        0 => format!(
            "At almost any dimensions {}: those of this pose add nothing.",
            remain(freedom)
        ),
        more => format!(
            "At other dimensions {}: the geometry of this pose adds {more}.",
            remain(generic.mobility)
        ),
    };
    Some(text)
}

fn pose(home: &Home) -> Option<String> {
    let at = if home.configuration == "home" {
        "the home pose".to_owned()
    } else {
        format!("configuration `{}`", home.configuration)
    };
    let text = match (home.pose?, home.kind) {
        (PoseKind::Regular, _) if home.instantaneous == Some(0) => return None,
        (PoseKind::Regular, _) => {
            format!(
                "Regular ({}): around {at} every instantaneous freedom can be followed.",
                cite::REGULAR
            )
        }
        (PoseKind::Singular, None) => {
            format!(
                "Singular ({}): around {at} the instantaneous freedoms are not all motions.",
                cite::REGULAR
            )
        }
        (PoseKind::Singular, Some(kind)) => {
            let what = match kind {
                SingularKind::Bifurcation => "branches with different tangents meet",
                SingularKind::Tangential => "branches with a common tangent meet",
                SingularKind::Cusp => "the motion stops and turns back",
                SingularKind::Kinematotropic => "branches of different mobility meet",
                SingularKind::Shaky => "it gives way a little, but nothing moves",
                SingularKind::PermanentlyShaky => {
                    "it gives way in more directions than it moves, here and all along the motion"
                }
            };
            format!("Singular ({}): at {at} {what}.", cite::kind(kind))
        }
    };
    Some(text)
}

/// Dropped singular values up to this, relative to the largest, are rounding in double precision.
const ROUNDING: f64 = 1e-14;

/// Where the smallest singular value kept is so many times the threshold, it does not matter in which block that is.
const CLEAR: f64 = 1e3;

/// How safe the rank is, in one line where that is beyond doubt.
fn short_margin(report: &Report) -> Option<String> {
    let home = &report.home;
    let (kept, tolerance) = (home.kept?, home.tolerance?);
    let clear = home.dropped.is_none_or(|dropped| dropped <= ROUNDING);
    if home.rank.is_none() || home.as_written.is_some() || !clear || kept < CLEAR * tolerance {
        return margin(report);
    }
    Some(format!(
        "Rank margin: singular values kept ≥ {} of the largest; below {} counts as zero.",
        figure(kept),
        figure(tolerance)
    ))
}

/// How safe the rank is.
fn margin(report: &Report) -> Option<String> {
    let home = &report.home;
    home.rank?;
    let kept = figure(home.kept?);
    let tolerance = home.tolerance.unwrap_or(0.0);
    // The weakest block speaks for all.
    let whose = match &home.weakest {
        Some(block) => format!(" (least in block `{block}`)"),
        None => String::new(),
    };
    let mut text = format!(
        "Margin of the rank{whose}: the smallest singular value kept is {kept} of the largest"
    );
    match home.dropped {
        // Rounding differs from machine to machine, and its digits mean nothing to a person.
        Some(dropped) if dropped <= ROUNDING => text.push_str(&format!(
            ", those dropped are zero up to rounding; below {} counts as zero.",
            figure(tolerance)
        )),
        Some(dropped) => text.push_str(&format!(
            ", the largest dropped {}; below {} counts as zero.",
            figure(dropped),
            figure(tolerance)
        )),
        None => text.push_str(&format!(
            ", none was dropped; below {} counts as zero.",
            figure(tolerance)
        )),
    }
    // A note says this already, with its figures.
    if let (Some(literal), None) = (home.as_written, &home.note) {
        text.push_str(&format!(
            " Taken literally, the numbers of the file give {}; within their stated precision it is {}.",
            counted(literal, "instantaneous freedom"),
            optional(home.instantaneous)
        ));
    }
    Some(text)
}
