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
//! | `configurations` | all configurations side by side, each with the motion through it |
//! | `drawing`, `data` | the mechanism and its motions for the script |
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
mod motions;
mod names;
mod plots;
mod ranges;

use super::schema::Report;
use crate::picture::traced::LinkPoint;
use crate::picture::view::View;
pub use accuracy::accuracy_page;
pub use configurations::{Shown, configurations_page};
pub use document::{SCRIPT, STYLE, script, style};
pub use gallery::{Entry, index, stills_index};
use kutzbach_closure::{Geometry, Rigid, spanning_poses};
use kutzbach_mobility::{Analysis, AnalysisOptions, Depth, Verdict, analyse};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_scene::{Drawing, Roles};
use kutzbach_simulate::accuracy::Accuracy;
use kutzbach_simulate::verification::Verification;
use motions::{Repertoire, repertoire};
use std::sync::Arc;

/// What a page is made of.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The report on it.
    pub report: &'a Report,
    /// The analysis that the report tells of.
    pub analysis: &'a Analysis,
    /// The configuration that was analysed; the home pose if `None`.
    pub configuration: Option<&'a str>,
    /// What simulation says, where it was asked.
    pub verification: Option<&'a Verification>,
    /// What accuracy costs, where it was measured.
    pub accuracy: Option<&'a Accuracy>,
}

/// Where a page has its script and its style.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assets {
    /// In itself: one file.
    Inside,
    /// In [`SCRIPT`] and [`STYLE`] in the same folder, for many pages.
    Beside,
}

impl Assets {
    /// Poses of links that a page may hold, all motions together; about 40 bytes each. A gallery is many pages.
    fn link_poses(self) -> usize {
        match self {
            Self::Inside => 12_000,
            Self::Beside => 4_000,
        }
    }
}

/// A link's frame farther than so many extents from the mechanism is too far for single precision.
const FAR: f64 = 4.0;

/// The mechanism as it is drawn.
#[derive(Debug)]
struct Stage {
    geometry: Arc<Geometry<f64>>,
    drawing: Drawing,
    /// What links and joints do on the first branch, or at the pose where there is none.
    roles: Roles,
    /// `world_from_link` at the pose analysed.
    home: Vec<Rigid<f64>>,
    /// The middle of the mechanism (m).
    centre: [f64; 3],
    /// Of links whose frames are far from what is drawn: a point in the link that is near (m).
    origins: Vec<Option<[f64; 3]>>,
    view: View,
    /// Points that should be one, where the mechanism does not assemble (world, m).
    gaps: Vec<[[f64; 3]; 2]>,
    repertoire: Repertoire,
    /// Names and dimensions of the branches of what is shown.
    branches: Vec<(String, usize)>,
    /// How far the dimensions shown are from those drawn (m), where the mechanism drawn does not move and the nearest that does is
    /// shown instead.
    nearest: Option<f64>,
    /// Points whose paths are shown instead of those of joints.
    points: Vec<LinkPoint>,
}

impl Stage {
    fn new(facts: &Facts<'_>, link_poses: usize) -> Self {
        let nearest = nearest_that_moves(facts);
        let (mechanism, analysis) = match &nearest {
            Some((mechanism, analysis)) => (*mechanism, analysis),
            None => (facts.analysis.of(facts.mechanism), facts.analysis),
        };
        let geometry = Arc::clone(&analysis.geometry);
        let (home, _) = spanning_poses(mechanism, &geometry, &analysis.assembly.states);
        let branches = analysis.branches.as_deref().unwrap_or_default();
        let roles = Roles::of(mechanism, analysis, branches.first(), None);
        let drawing = Drawing::new(mechanism, &geometry, &roles);
        let [low, high] = drawing.bounds;
        let centre = [0, 1, 2].map(|i| 0.5 * (low[i] + high[i]));
        let near = |link: &Rigid<f64>| {
            let far =
                (0..3).any(|i| (link.translation[i] - centre[i]).abs() > FAR * drawing.extent);
            far.then(|| link.inverse().apply(&centre))
        };
        Self {
            origins: home.iter().map(near).collect(),
            centre,
            view: View::of(&drawing, &geometry.displacements, &home),
            gaps: gaps((mechanism, analysis), &geometry, &home),
            repertoire: repertoire(mechanism, analysis, facts.configuration, link_poses),
            branches: branches
                .iter()
                .map(|b| (b.name.clone(), b.dimension))
                .collect(),
            nearest: nearest.as_ref().map(|_| {
                let nominal = facts.analysis.mobility.nominal.as_ref();
                nominal.and_then(|nominal| nominal.distance).unwrap_or(0.0)
            }),
            home,
            drawing,
            roles,
            geometry,
            points: Vec::new(),
        }
    }
}

/// The nearest mechanism that moves, analysed, where the one drawn does not, and that one lies within its digits.
fn nearest_that_moves<'a>(facts: &Facts<'a>) -> Option<(&'a Mechanism, Analysis)> {
    let drawn = &facts.analysis.mobility;
    let within = drawn.nominal.as_ref().is_some_and(|n| n.within_digits);
    let nearest = facts.analysis.nearest.as_ref();
    let nearest = nearest.filter(|_| within && drawn.verdict != Verdict::Mobile)?;
    let options = AnalysisOptions {
        configuration: facts.configuration.map(str::to_owned),
        depth: Depth::Motions,
        ..AnalysisOptions::default()
    };
    let analysis = analyse(&nearest.mechanism, &options).ok()?;
    (analysis.mobility.verdict == Verdict::Mobile).then_some((&nearest.mechanism, analysis))
}

/// Where the loops of a mechanism that does not assemble stay open: the two sides of the joint that closes each.
fn gaps(
    (mechanism, analysis): (&Mechanism, &Analysis),
    geometry: &Geometry<f64>,
    links: &[Rigid<f64>],
) -> Vec<[[f64; 3]; 2]> {
    let assembly = &analysis.assembly;
    if assembly.closed {
        return Vec::new();
    }
    let side = |joint: usize, side: usize| {
        let known = &mechanism.joints()[joint];
        let link = [known.predecessor.link.0, known.successor.link.0][side];
        links[link].apply(&geometry.sides[joint][side].translation)
    };
    let open = assembly.gaps.iter();
    open.map(|gap| [0, 1].map(|k| side(gap.joint, k))).collect()
}

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
