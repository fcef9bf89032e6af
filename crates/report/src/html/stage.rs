//! What a page shows: the facts that it is made of, and the mechanism with its motions traced.

use super::motions::{Repertoire, repertoire};
use crate::picture::view::View;
use crate::schema::Report;
use crate::traced::LinkPoint;
use kutzbach_closure::{Geometry, Rigid, spanning_poses};
use kutzbach_mobility::{Analysis, AnalysisOptions, Depth, Verdict, analyse};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_scene::{Drawing, Roles};
use kutzbach_simulate::accuracy::Accuracy;
use kutzbach_simulate::verification::Verification;
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
    /// In [`SCRIPT`](super::SCRIPT) and [`STYLE`](super::STYLE) in the same folder, for many pages.
    Beside,
}

impl Assets {
    /// Poses of links that a page may hold, all motions together; about 40 bytes each. A gallery is many pages.
    pub(super) fn link_poses(self) -> usize {
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
pub(super) struct Stage {
    pub(super) geometry: Arc<Geometry<f64>>,
    pub(super) drawing: Drawing,
    /// What links and joints do on the first branch, or at the pose where there is none.
    pub(super) roles: Roles,
    /// `world_from_link` at the pose analysed.
    pub(super) home: Vec<Rigid<f64>>,
    /// The middle of the mechanism (m).
    pub(super) centre: [f64; 3],
    /// Of links whose frames are far from what is drawn: a point in the link that is near (m).
    pub(super) origins: Vec<Option<[f64; 3]>>,
    pub(super) view: View,
    /// Points that should be one, where the mechanism does not assemble (world, m).
    pub(super) gaps: Vec<[[f64; 3]; 2]>,
    pub(super) repertoire: Repertoire,
    /// Names and dimensions of the branches of what is shown.
    pub(super) branches: Vec<(String, usize)>,
    /// How far the dimensions shown are from those drawn (m), where the mechanism drawn does not move and the nearest that does is
    /// shown instead.
    pub(super) nearest: Option<f64>,
    /// Points whose paths are shown instead of those of joints.
    pub(super) points: Vec<LinkPoint>,
}

impl Stage {
    pub(super) fn new(facts: &Facts<'_>, link_poses: usize) -> Self {
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
