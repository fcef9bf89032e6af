//! The counts, and the sentence that says why they differ from Kutzbach's.

use super::cite;
use super::page::Page;
use super::style::Tint;
use super::table::{Cell, Column, Table};
use super::verdict;
use super::words::{capitalised, counted, degrees, figure};
use crate::schema::{Home, Report};
use kutzbach_mobility::{PoseKind, SingularKind, Verdict};

/// Writes the counts, in one row, with the margin of the rank.
pub(crate) fn write(report: &Report, page: &mut Page) {
    let verbose = page.layout().verbose;
    // Of a tree the answer says it all.
    if !verbose && verdict::without_loops(report) && report.home.note.is_none() {
        return;
    }
    page.heading("Counts");
    let home = &report.home;
    let known = report.mobility.verdict != Verdict::Unassembled;
    let decided = home.instantaneous.is_some() && home.redundant.is_some();
    let mut counts = vec![("Kutzbach", report.kutzbach.to_string())];
    if let Some(generic) = &report.generic {
        counts.push(("generic", generic.mobility.to_string()));
    }
    if known {
        counts.push(("this pose", at_pose(home)));
        counts.push(("finite", finite(report)));
        counts.push(("redundant", redundant(home)));
        counts.extend(
            home.rank
                .map(|rank| ("rank", format!("{rank} of {}", home.unknowns))),
        );
        counts.extend(home.pose.map(|pose| ("pose", pose_word(pose, home.kind))));
        counts.extend(margin_figures(home).map(|text| ("margin", text)));
    }
    let mut table = Table::new().column("", Column::Words);
    for (title, _) in &counts {
        table = table.column(title, Column::Words);
    }
    let cell = |(_, number): &(&str, String)| Cell::new(number).tint(Tint::Strong);
    table.row(
        [Cell::new("")]
            .into_iter()
            .chain(counts.iter().map(cell))
            .collect(),
    );
    page.table(table, "counts");
    if !known {
        return;
    }
    let doubtful = home.rank.is_none() || home.as_written.is_some() || thin(home);
    let sentences = [
        (verbose || !decided).then(|| difference(report)),
        geometry(report).filter(|_| verbose),
        pose(home).filter(|_| verbose),
        margin(report).filter(|_| verbose || doubtful),
    ];
    for sentence in sentences.into_iter().flatten() {
        page.paragraph(&sentence, Tint::Plain, "  ", "  ");
    }
    if let Some(note) = &home.note {
        page.paragraph(&capitalised(note), Tint::Doubtful, "  ", "  ");
    }
}

/// The degrees of freedom at the pose, or the least and the most that the margins leave.
fn at_pose(home: &Home) -> String {
    match home.instantaneous {
        Some(freedom) => freedom.to_string(),
        None => format!("{} … {}", home.candidates[0], home.candidates[1]),
    }
}

/// The finite mobility, or its bounds.
fn finite(report: &Report) -> String {
    match (report.mobility.finite, report.mobility.bounds) {
        (Some(finite), _) => finite.to_string(),
        (None, [None, None]) => "?".to_owned(),
        (None, [Some(least), None]) => format!("≥ {least}"),
        (None, [None, Some(most)]) => format!("≤ {most}"),
        (None, [Some(least), Some(most)]) => format!("{least} … {most}"),
    }
}

/// `3 of 6`: of the constraint equations.
fn redundant(home: &Home) -> String {
    let redundant = home.redundant;
    let redundant = redundant.map_or_else(|| "?".to_owned(), |n| n.to_string());
    format!("{redundant} of {}", home.equations)
}

/// `regular`, `shaky`.
fn pose_word(pose: PoseKind, kind: Option<SingularKind>) -> String {
    match kind {
        Some(kind) => kind.word().replace('_', " "),
        None => pose.word().to_owned(),
    }
}

/// `0.65 > 4e-14`: the smallest singular value that counts, relative to the largest, and what counts as zero.
fn margin_figures(home: &Home) -> Option<String> {
    home.rank?;
    let (kept, tolerance) = (home.kept?, home.tolerance?);
    Some(format!("{} > {:.0e}", figure(kept), tolerance))
}

/// Whether a singular value lies near the threshold.
fn thin(home: &Home) -> bool {
    let clear = home.dropped.is_none_or(|dropped| dropped <= ROUNDING);
    let kept = home.kept.zip(home.tolerance);
    !clear || kept.is_some_and(|(kept, tolerance)| kept < CLEAR * tolerance)
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
                "Kutzbach: {} = {count}; there is no loop, so every joint is free and {} at this pose.",
                formula(report),
                remain(freedom)
            )
        }
        (Some(freedom), Some(0)) => format!(
            "Kutzbach: {} = {count}, which holds at this pose: the {} independent, so {}.",
            formula(report),
            match home.equations {
                1 => "constraint equation is".to_owned(),
                n => format!("{n} constraint equations are"),
            },
            remain(freedom)
        ),
        (Some(freedom), Some(redundant)) => format!(
            "Kutzbach: {} = {count}; {redundant} of the {} {} redundant, so {} at this pose.",
            formula(report),
            counted(home.equations, "constraint equation"),
            if redundant == 1 { "is" } else { "are" },
            remain(freedom)
        ),
        _ => format!(
            "Kutzbach: {} = {count}; how many of the {} are independent is not decided.",
            formula(report),
            counted(home.equations, "constraint equation")
        ),
    }
}

fn remain(freedom: usize) -> String {
    match freedom {
        0 => "no degree of freedom remains".to_owned(),
        1 => "1 degree of freedom remains".to_owned(),
        n => format!("{n} degrees of freedom remain"),
    }
}

/// What the special dimensions add to what links and joints alone would allow.
fn geometry(report: &Report) -> Option<String> {
    let generic = report.generic.as_ref()?;
    let freedom = report.home.instantaneous?;
    let text = match freedom.checked_sub(generic.mobility)? {
        0 => format!("With generic dimensions {} too.", remain(freedom)),
        more => format!(
            "With generic dimensions {}; the dimensions at this pose add {more}.",
            match generic.mobility {
                0 => "it would be rigid".to_owned(),
                left => remain(left),
            }
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
                "Regular pose ({}): at {at} every infinitesimal motion can be continued.",
                cite::REGULAR
            )
        }
        (PoseKind::Singular, None) => {
            format!(
                "Singular pose ({}): at {at} not every infinitesimal motion can be continued.",
                cite::REGULAR
            )
        }
        (PoseKind::Singular, Some(kind)) => {
            let what = match kind {
                SingularKind::Bifurcation => "branches with different tangents meet",
                SingularKind::Tangential => "branches with a common tangent meet",
                SingularKind::Cusp => "the motion stops and turns back",
                SingularKind::Kinematotropic => "branches of different mobility meet",
                SingularKind::Shaky => "there are infinitesimal motions, which cannot be continued",
                SingularKind::PermanentlyShaky => {
                    "it is infinitesimally more mobile than it moves, here and along the whole motion"
                }
            };
            format!("Singular pose ({}): at {at} {what}.", cite::kind(kind))
        }
    };
    Some(text)
}

/// Dropped singular values up to this, relative to the largest, are rounding in double precision.
const ROUNDING: f64 = 1e-14;

/// Where the smallest singular value kept is so many times the threshold, it does not matter in which block that is.
const CLEAR: f64 = 1e3;

/// How safe the rank is.
fn margin(report: &Report) -> Option<String> {
    let home = &report.home;
    home.rank?;
    let kept = figure(home.kept?);
    let tolerance = home.tolerance.unwrap_or(0.0);
    // The weakest sub-mechanism speaks for all.
    let whose = match &home.weakest {
        Some(block) => format!(" in `{block}`, the least certain"),
        None => String::new(),
    };
    let dropped = match home.dropped {
        // Rounding differs from machine to machine, and its digits mean nothing to a person.
        Some(dropped) if dropped <= ROUNDING => "those dropped are zero to rounding".to_owned(),
        Some(dropped) => format!("the largest dropped {}", figure(dropped)),
        None => "none was dropped".to_owned(),
    };
    let mut text = format!(
        "Margin of the rank{whose}: relative to the largest singular value, the smallest kept is {kept}, {dropped}; the \
         threshold is {}.",
        figure(tolerance)
    );
    // A note says this already, with its figures.
    if let (Some(literal), None) = (home.as_written, &home.note) {
        text.push_str(&format!(
            " As written the numbers leave {} at this pose; within their stated precision it is {}.",
            degrees(literal),
            home.instantaneous
                .map_or_else(|| "?".to_owned(), |n| n.to_string())
        ));
    }
    Some(text)
}
