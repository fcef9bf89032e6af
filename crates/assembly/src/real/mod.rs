//! All real solutions of a reduced system, with proof.
//!
//! # What is proven
//! Every box of every chart is either shown to hold no solution (an equation keeps its sign on it, or Krawczyk's operator
//! maps it off itself), or to lie in a box with exactly one. What remains, [`RealSolutions::open`], may hold solutions: double
//! ones, curves, or simple ones that are too close to one another. Nothing is proven of it, and so nothing is claimed.
//!
//! Of more equations than unknowns only as many prove a solution. Where the others follow from these, as the third coordinate of
//! a point beside another one at the same distance does, the proof is whole; elsewhere a solution is only *consistent*: no
//! equation excludes it.
//!
//! # What it costs
//! Some thousand boxes for four unknowns, ten microseconds each; a multiple of ten for every unknown more.
//!
//! Source: R. Krawczyk (1969); B. Mourrain, J.-P. Pavone, "Subdivision methods for solving polynomial equations" (2005).

mod chart;
mod interval;
mod krawczyk;
mod search;
mod tensor;

pub use interval::Interval;

use crate::reduced::{Asks, ReducedSystem};
use kutzbach_algebra::{Budget, Stop};

/// A real solution.
#[derive(Clone, Debug)]
pub struct RealRoot {
    /// The unknowns, in doubles.
    pub unknowns: Vec<f64>,
    /// How far they may be off, in half angles.
    pub radius: f64,
    /// Whether all equations hold there, proven; else none excludes it.
    pub proven: bool,
}

/// What is known of all real solutions.
#[derive(Clone, Debug)]
pub struct RealSolutions {
    /// Simple solutions, each once.
    pub roots: Vec<RealRoot>,
    /// Places that may hold more: the unknowns at the middle of each box that stayed open.
    pub open: Vec<Vec<f64>>,
    /// Boxes that were looked at.
    pub boxes: usize,
    /// Why the search ended early.
    pub stopped: Option<Stop>,
    /// Whether it ended because so much stayed open that a curve is likely.
    pub crowded: bool,
}

impl RealSolutions {
    /// Whether these are all real solutions, and every one of them is one.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.open.is_empty() && self.stopped.is_none() && self.roots.iter().all(|r| r.proven)
    }
}

/// All real solutions of a system, as far as the budget goes.
#[must_use]
pub fn real_solutions(system: &ReducedSystem, budget: &Budget) -> RealSolutions {
    if system.impossible.is_some() {
        return RealSolutions {
            roots: Vec::new(),
            open: Vec::new(),
            boxes: 0,
            stopped: None,
            crowded: false,
        };
    }
    if system.freedom() == 0 {
        let met = system.closures.is_empty();
        return RealSolutions {
            roots: met
                .then(|| RealRoot {
                    unknowns: Vec::new(),
                    radius: 0.0,
                    proven: true,
                })
                .into_iter()
                .collect(),
            open: Vec::new(),
            boxes: 0,
            stopped: None,
            crowded: false,
        };
    }
    let charts = chart::charts(system);
    let scales = chart::scales(system);
    let found = search::search(system, &charts, 0.0, budget);
    let middle = |sides: &[Interval]| sides.iter().map(|s| s.middle()).collect::<Vec<f64>>();
    let at = |index: usize, sides: &[Interval]| {
        chart::unknowns_at(system, &scales, &charts[index], &middle(sides))
    };
    let mut roots: Vec<RealRoot> = found
        .proven
        .iter()
        .map(|proven| {
            let unknowns = at(proven.chart, &proven.at);
            let radius = proven.at.iter().fold(0.0, |m: f64, s| m.max(s.width()));
            RealRoot {
                radius,
                // In a wide enclosure a mirrored solution of the equations used may hide.
                proven: radius < NARROW && others_follow(system, &proven.used, &unknowns),
                unknowns,
            }
        })
        .collect();
    // By the unknowns, so that the order is that of the solutions and not of the search.
    roots.sort_by(|a, b| {
        let pairs = a.unknowns.iter().zip(&b.unknowns);
        let first = pairs.map(|(x, y)| y.total_cmp(x)).find(|o| o.is_ne());
        first.unwrap_or(std::cmp::Ordering::Equal)
    });
    RealSolutions {
        roots,
        open: found
            .open
            .iter()
            .map(|(chart, sides)| at(*chart, sides))
            .collect(),
        boxes: found.boxes,
        stopped: found.stopped,
        crowded: found.crowded,
    }
}

/// Whether a complete answer has as many solutions, near those, for all equations of which every coefficient is within a share of
/// the largest one.
#[must_use]
pub fn stays(system: &ReducedSystem, answer: &RealSolutions, share: f64, budget: &Budget) -> bool {
    if !answer.is_complete() || system.freedom() == 0 || !share.is_finite() {
        return false;
    }
    let found = search::search(system, &chart::charts(system), share, budget);
    found.open.is_empty() && found.stopped.is_none() && found.proven.len() == answer.roots.len()
}

/// An enclosure narrower than this holds one solution at which the other equations can be told from far off.
const NARROW: f64 = 1e-6;

/// Least share of a direction along the coordinate that is left out: far above what rounding makes of it.
const LEAST_SHARE: f64 = 1e-3;

/// Whether the equations that were not used to prove a solution follow from those that were. Of a point P beside another
/// point Q that the bodies share, at the same distance in both, one coordinate may be left out: the difference of P in the
/// two bodies is then along that coordinate, and perpendicular to P − Q up to its own size, so that it is zero where P − Q
/// has a share along it.
fn others_follow(system: &ReducedSystem, used: &[usize], unknowns: &[f64]) -> bool {
    let unused: Vec<usize> = (0..system.closures.len())
        .filter(|c| !used.contains(c))
        .collect();
    let mut left_out: Vec<(usize, [usize; 2])> = Vec::new();
    for &closure in &unused {
        let Asks::Point {
            point,
            between,
            beside: Some(beside),
            ..
        } = &system.closures[closure].asks
        else {
            return false;
        };
        // The other point has to be brought together without this one.
        let beside_too = unused.iter().any(|&c| {
            matches!(&system.closures[c].asks, Asks::Point { point, between: b, .. } if point == beside && b == between)
        });
        if beside_too || left_out.contains(&(*point, *between)) {
            return false;
        }
        left_out.push((*point, *between));
        if system.share_along(closure, *point, *beside, unknowns) < LEAST_SHARE {
            return false;
        }
    }
    true
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
