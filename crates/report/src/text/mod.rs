//! A person's first screen.
//!
//! The order is that of the questions: does it move, and in how many ways; are its motors enough, which limb has how many of
//! the freedoms, what is wrong with the pose; why not as many as the count says; which joints take part; which loops hold it;
//! what to change; what to beware of. A first screen of a robot of forty joints is a page: what is alike is told once with its
//! number, and what only repeats is left to a verbose page. Everything shown stands in the [`Report`], nothing
//! is computed here but sums and words.

mod alternatives;
pub(super) mod assembly;
pub(super) mod branches;
mod cite;
mod constants;
pub(super) mod counts;
mod escape;
pub mod explanation;
mod folded;
pub(super) mod inputs;
pub(super) mod joints;
mod page;
pub(super) mod sections;
mod style;
mod table;
pub(super) mod verdict;
pub mod words;

pub use escape::{clipped, columns, visible};
pub use page::{Block, Page};
pub use style::{Layout, NARROWEST_PAGE, Tint};
pub use table::{ABRIDGED_ROWS, Cell, Column, Row, Subject, Table};

use super::schema::Report;
use std::collections::BTreeMap;

/// The report as a page of text, ending in a line break.
#[must_use]
pub fn render(report: &Report, layout: Layout) -> String {
    let mut page = Page::new(layout);
    verdict::answer(report, &mut page);
    branches::idle_and_locked(report, &mut page);
    inputs::inputs(report, &mut page);
    sections::pose(report, &mut page);
    verdict::reasons(report, &mut page);
    counts::write(report, &mut page);
    assembly::section(report, &mut page);
    branches::branches(report, &mut page);
    joints::joints(report, &BTreeMap::new(), false, &mut page);
    sections::couplings(report, &mut page);
    sections::cycles(report, &mut page);
    branches::motions(report, false, &mut page);
    sections::advice(report, &mut page);
    sections::other_warnings(report, &mut page);
    branches::evidence(report, &mut page);
    sections::details(report, &mut page);
    page.into_text()
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
