//! The report as one HTML file that moves.
//!
//! # The problem
//! People who design mechanisms would rather look than read: what moves, along which branch, how far, and where it is
//! close to being something else. They get a file by mail, open it on whatever they have, and print it.
//!
//! # What holds
//! * One file, no network: the script and the style are inside, and a content security policy forbids everything that is
//!   not, by hash. Names from a mechanism file are text, never markup.
//! * Everything that can be read stands in the file as plain HTML and SVG, made here from the same pages as the text
//!   report, so that neither says what the other does not. The script makes the mechanism move, links names to what they
//!   stand for, sorts tables and reads plots; without it nothing but motion is lost.
//! * The poses played are those of [`kutzbach_motion`], told in single precision relative to the middle of the mechanism.
//! * The same mechanism gives the same bytes.
//!
//! # What it costs
//! Tracing every branch; the rest is linear in the poses shown, which are bounded (`motions`). The script is two thirds
//! of a small page.
//!
//! | file | says |
//! |---|---|
//! | `document` | the order of the page, its policy, script and style |
//! | `blocks`, `escape`, `names` | pages as HTML; text as text; names as indices |
//! | `motions` | what is played |
//! | `accuracy` | what accuracy costs, in the page and as one of its own |
//! | `map` | a sweep as a map, with the commands that make the reports of its cells |
//! | `configurations` | all configurations side by side, each with the motion through it |
//! | `drawing`, `data` | the mechanism and its motions for the script |
//! | `stage` | the mechanism and its motions, ready to be shown |
//! | `plots`, `ranges` | what is read off them |
//!
//! `docs/src/page.md` describes what page and script agree on.

mod accuracy;
mod blocks;
mod configurations;
mod data;
mod document;
mod drawing;
mod escape;
mod gallery;
mod map;
mod motions;
mod names;
mod plots;
mod ranges;
mod stage;

use crate::traced::LinkPoint;
pub use accuracy::accuracy_page;
pub use configurations::{Shown, configurations_page};
pub use document::{SCRIPT, STYLE, script, style};
pub use gallery::{Entry, index, stills_index};
pub use map::map_page;
use stage::Stage;
pub use stage::{Assets, Facts};

/// A mechanism with its motions traced, ready to be shown.
#[derive(Debug)]
pub struct Prepared<'a> {
    facts: Facts<'a>,
    stage: Stage,
    assets: Assets,
}

impl<'a> Prepared<'a> {
    /// Traces every branch.
    #[must_use]
    pub fn new(facts: Facts<'a>, assets: Assets) -> Self {
        Self {
            stage: Stage::new(&facts, assets.link_poses()),
            facts,
            assets,
        }
    }

    /// The same with points of links shown, and their paths instead of those of joints.
    #[must_use]
    pub fn with_points(mut self, points: Vec<LinkPoint>) -> Self {
        self.stage.points = points;
        self
    }

    /// The page as a complete HTML document.
    ///
    /// # Errors
    /// Where data have no JSON form, which would be a fault of this program.
    pub fn page(&self) -> Result<String, serde_json::Error> {
        document::document(&self.facts, &self.stage, self.assets)
    }

    /// The mechanism at the pose analysed, with where it goes drawn faintly, as a small SVG document.
    #[must_use]
    pub fn still(&self) -> String {
        document::sketch(self.facts.mechanism, &self.stage, gallery::THUMBNAIL).document()
    }

    /// The entry of a gallery that leads to the page of this name, or shows the still of this name.
    #[must_use]
    pub fn entry(&self, page: &str) -> Entry {
        Entry::new(page, self.facts.mechanism, self.facts.report, &self.stage)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
