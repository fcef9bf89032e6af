//! The page of a report that was not asked for everything.

use super::page::Page;
use super::style::{Layout, Tint};
use super::{assembly, counts, sections, verdict};
use crate::asked::ReportDepth;
use crate::schema::Report;
use kutzbach_mobility::Verdict;

/// What was asked for, and that nobody looked at the rest.
pub(super) fn render(report: &Report, layout: Layout, depth: ReportDepth) -> String {
    let mut page = match layout.verbose {
        true => Page::new(layout),
        false => Page::new(layout).compact(),
    };
    let counted = depth == ReportDepth::Counts && report.mobility.verdict == Verdict::Undecided;
    if counted {
        page.paragraph(&at_this_pose(report), Tint::Plain, "", "");
    } else {
        verdict::answer(report, &mut page);
        sections::pose(report, &mut page);
        verdict::reasons(report, &mut page);
    }
    assembly::section(report, &mut page);
    sections::other_warnings(report, &mut page);
    counts::write(report, &mut page);
    verdict::source(report, &mut page);
    let rest = match counted {
        true => "Counts only: whether this motion goes on was not asked. `--depth verdict` tells.",
        false => {
            "The verdict only: idle motions, branches, joints and advice were not asked for. Without `--depth` they are told."
        }
    };
    page.paragraph(rest, Tint::Quiet, "", "");
    page.into_text()
}

/// The freedom to first order, or what is known of it.
fn at_this_pose(report: &Report) -> String {
    match (report.home.instantaneous, report.home.candidates) {
        (Some(freedom), _) => format!(
            "At this pose {} to first order.",
            super::words::degrees(freedom)
        ),
        (None, [least, most]) => format!(
            "At this pose between {least} and {} to first order.",
            super::words::degrees(most)
        ),
    }
}
