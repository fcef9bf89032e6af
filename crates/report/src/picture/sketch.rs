//! A mechanism as it stands, drawn.
//!
//! # What is wanted
//! The picture is what a stranger sees first, what is printed, and what is seen where no script runs. Links are rods with an
//! outline, joints are the solids of [`Drawing`], seen from infinitely far along a [`View`]; faint behind it stand a few
//! other poses of the motion and the ways of single points. What is nearer covers what is farther, also where rods pass
//! over and under each other.
//!
//! # How
//! Every solid becomes a flat figure with a depth (`solid`). Figures that overlap are compared where they do, and drawn in
//! an order that agrees with all comparisons (`order`). What is drawn shrinks with the number of joints: axes go first,
//! then names and other poses, then the symbols' shapes, until the text is at most [`LONGEST`] bytes.

mod order;
mod paint;
mod scene;
mod solid;

use super::vector::Vector;
use super::view::View;
use kutzbach_closure::Rigid;
use kutzbach_model::mechanism::Mechanism;
use kutzbach_scene::Drawing;

/// The style of sketches, all of it below `svg.sketch`.
pub const STYLE: &str = "svg.sketch{max-width:100%;height:auto}\
svg.sketch .lit{filter:drop-shadow(0 0 2px #ff9d2e) drop-shadow(0 0 1px #ff9d2e)}\
@media screen and (prefers-color-scheme:dark){svg.sketch .ground,svg.sketch .axis{filter:brightness(1.55)}\
svg.sketch .ghost{opacity:.3}}";

/// Pictures are not longer than this (bytes), as long as leaving things out helps.
pub const LONGEST: usize = 150_000;

/// The way of a point of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct PointPath {
    /// Index of the link whose colour it has.
    pub link: usize,
    /// World coordinates (m).
    pub points: Vec<Vector>,
}

/// What is to be drawn.
#[derive(Clone, Debug)]
pub struct Sketch<'a> {
    /// Gives names and the kinds of joints.
    pub mechanism: &'a Mechanism,
    /// Its solids.
    pub drawing: &'a Drawing,
    /// `world_from_link`, one for each link. What is not finite is left out.
    pub links: &'a [Rigid<f64>],
    /// From which side.
    pub view: View,
    /// Other poses, drawn faint.
    pub ghosts: Vec<&'a [Rigid<f64>]>,
    /// Ways of points.
    pub paths: Vec<PointPath>,
    /// Pairs of points that should be one, joined by red lines (world, m).
    pub gaps: Vec<[Vector; 2]>,
    /// Width and height (px), from 16 to 4000.
    pub size: [f64; 2],
}

impl<'a> Sketch<'a> {
    /// A mechanism in one pose, 480 by 360 pixels.
    #[must_use]
    pub fn new(
        mechanism: &'a Mechanism,
        drawing: &'a Drawing,
        links: &'a [Rigid<f64>],
        view: View,
    ) -> Self {
        Self {
            mechanism,
            drawing,
            links,
            view,
            ghosts: Vec::new(),
            paths: Vec::new(),
            gaps: Vec::new(),
            size: [480.0, 360.0],
        }
    }

    /// The picture as an element `svg.sketch` for a page that includes [`STYLE`]; parts have `data-link` or `data-joint`.
    #[must_use]
    pub fn fragment(&self) -> String {
        self.shortest("", "")
    }

    /// The picture as a file of its own, without background.
    #[must_use]
    pub fn document(&self) -> String {
        self.shortest(
            " xmlns=\"http://www.w3.org/2000/svg\"",
            &format!("<style>{STYLE}</style>\n"),
        )
    }

    fn shortest(&self, namespace: &str, style: &str) -> String {
        let mut detail = Detail::suited(self.mechanism.joints().len());
        loop {
            let scene = scene::Scene::new(self, detail);
            let svg = paint::write(self, &scene, detail, namespace, style);
            match detail.less() {
                Some(less) if svg.len() > LONGEST => detail = less,
                _ => return svg,
            }
        }
    }
}

/// How much is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Detail {
    /// Everything.
    Full,
    /// No axes, no highlights.
    Plain,
    /// No names; two other poses at most.
    Nameless,
    /// Joints are dots, rods have no outlines, one other pose at most.
    Dots,
    /// Rods alone, a line for each colour.
    Lines,
}

impl Detail {
    const ALL: [Self; 5] = [
        Self::Full,
        Self::Plain,
        Self::Nameless,
        Self::Dots,
        Self::Lines,
    ];

    fn suited(joints: usize) -> Self {
        match joints {
            0..=32 => Self::Full,
            33..=90 => Self::Plain,
            91..=220 => Self::Nameless,
            221..=1500 => Self::Dots,
            _ => Self::Lines,
        }
    }

    fn less(self) -> Option<Self> {
        Self::ALL.into_iter().find(|detail| *detail > self)
    }

    fn ghosts(self) -> usize {
        match self {
            Self::Full | Self::Plain => usize::MAX,
            Self::Nameless => 2,
            Self::Dots => 1,
            Self::Lines => 0,
        }
    }
}

#[cfg(test)]
#[path = "sketch/tests.rs"]
#[allow(clippy::unwrap_used)]
mod tests;
