//! A person's first screen.
//!
//! The order is that of the questions: does it move, and with how many degrees of freedom; are its motors enough, what is
//! wrong with the pose; why not more and why not less; what does each link do; what does each joint do; what to change; what
//! to beware of; and the counts last. The first screen of a robot of forty joints is one page: equal things share a line, and
//! proofs, loops, independent parts and margins are left to a verbose page. Everything shown stands in the [`Report`], nothing
//! is computed here but sums and words.

mod alternatives;
pub(super) mod assembly;
pub(super) mod branches;
mod change_sets;
mod cite;
mod constants;
pub(super) mod counts;
mod escape;
pub mod explanation;
mod folded;
pub(super) mod four_bars;
pub(super) mod inputs;
pub(super) mod joints;
mod page;
mod play;
mod ranges;
mod relations;
pub(super) mod sections;
mod shallow;
mod style;
mod table;
pub(super) mod verdict;
pub mod words;

pub use escape::{clipped, columns, visible};
pub use page::{Block, Page};
pub use style::{Layout, NARROWEST_PAGE, Tint, Units};
pub use table::{ABRIDGED_ROWS, Cell, Column, Row, Subject, Table};

use super::schema::Report;

/// The report as a page of text, ending in a line break.
#[must_use]
pub fn render(report: &Report, layout: Layout) -> String {
    if let Some(depth) = report.depth {
        return shallow::render(report, layout, depth);
    }
    let mut page = match layout.verbose {
        true => Page::new(layout),
        false => Page::new(layout).compact(),
    };
    verdict::answer(report, &mut page);
    branches::idle_and_locked(report, &mut page);
    inputs::inputs(report, &mut page);
    sections::pose(report, &mut page);
    verdict::reasons(report, &mut page);
    branches::branches(report, &mut page);
    branches::motions(report, false, &mut page);
    let ranges = ranges::texts(report, layout.units);
    joints::joints(report, &ranges, false, &mut page);
    four_bars::four_bars(report, layout.units, &mut page);
    sections::couplings(report, &mut page);
    sections::advice(report, &mut page);
    assembly::section(report, &mut page);
    play::play(report, &mut page);
    sections::other_warnings(report, &mut page);
    if layout.verbose {
        relations::relations(report, &mut page);
        sections::cycles(report, &mut page);
        branches::evidence(report, &mut page);
    }
    counts::write(report, &mut page);
    if !layout.verbose {
        branches::evidence(report, &mut page);
    }
    sections::details(report, &mut page);
    verdict::source(report, &mut page);
    verdict::further(report, &mut page);
    page.into_text()
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
