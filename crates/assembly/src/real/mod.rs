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
mod closest;
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
    real_solutions_within(system, 0.0, budget)
}

/// All real solutions of a system whose coefficients are known up to a share of the largest one of their kind.
///
/// Every system within has at most one solution near each root and none elsewhere, if nothing stayed open; exactly one near each that is
/// proven. The places told are where the equations given hold best. Where places stayed open roots are also sought in these, and
/// are not proven.
#[must_use]
pub fn real_solutions_within(system: &ReducedSystem, share: f64, budget: &Budget) -> RealSolutions {
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
    let found = search::search(system, &charts, share, budget);
    let middle = |sides: &[Interval]| sides.iter().map(|s| s.middle()).collect::<Vec<f64>>();
    let at = |index: usize, at: &[f64]| chart::unknowns_at(system, &scales, &charts[index], at);
    let open: Vec<Vec<f64>> = found
        .open
        .iter()
        .map(|(chart, sides)| at(*chart, &middle(sides)))
        .collect();
    let closest = |chart: usize, sides: &[Interval]| {
        let tensors = chart::tensors(system, &scales, &charts[chart]);
        let sizes = chart::sizes(system, &tensors);
        closest::closest(&tensors, &sizes, &middle(sides))
    };
    let mut roots: Vec<RealRoot> = Vec::new();
    for proven in &found.proven {
        let from = middle(&proven.at);
        // Narrow enclosures are the places themselves.
        let place = match share > 0.0 {
            true => closest(proven.chart, &proven.at).map_or(from, |(place, _)| place),
            false => from,
        };
        let unknowns = at(proven.chart, &place);
        let radius = proven.at.iter().fold(0.0, |m: f64, s| m.max(s.width()));
        let again = share > 0.0
            && roots
                .iter()
                .any(|known| same(known, &unknowns, OF_RADIUS * known.radius.min(radius)));
        if !again {
            roots.push(RealRoot {
                radius,
                proven: others_follow(system, &proven.used, &unknowns, radius),
                unknowns,
            });
        }
    }
    let wanted = share > 0.0 && found.stopped != Some(Stop::Cancelled);
    let sought = found.open.iter().filter(|_| wanted);
    for (chart, sides) in sought {
        let Some((place, worst)) = closest(*chart, sides) else {
            continue;
        };
        let way = place.iter().zip(middle(sides)).map(|(a, b)| (a - b).abs());
        let unknowns = at(*chart, &place);
        let near = way.fold(0.0, f64::max) <= NEARBY;
        let apart = (COARSE * share).min(NEARBY);
        let known = roots
            .iter()
            .any(|known| same(known, &unknowns, known.radius.max(apart)));
        if worst <= share && near && !known {
            roots.push(RealRoot {
                radius: apart,
                proven: false,
                unknowns,
            });
        }
    }
    // So many places are those of a curve.
    if roots.iter().filter(|root| !root.proven).count() > MOST_SOUGHT {
        roots.retain(|root| root.proven);
    }
    // By the unknowns, so that the order is that of the solutions and not of the search.
    roots.sort_by(|a, b| {
        let pairs = a.unknowns.iter().zip(&b.unknowns);
        let first = pairs.map(|(x, y)| y.total_cmp(x)).find(|o| o.is_ne());
        first.unwrap_or(std::cmp::Ordering::Equal)
    });
    RealSolutions {
        roots,
        open,
        boxes: found.boxes,
        stopped: found.stopped,
        crowded: found.crowded,
    }
}

/// Places in open boxes at most.
const MOST_SOUGHT: usize = 64;

/// How far from a place left open the equations may hold best (half angles).
const NEARBY: f64 = 0.25;

/// Two enclosures are of one solution, found by other equations or in another chart, where the places at which equations hold best differ by
/// less than this share of them: solutions that are two are farther apart than an enclosure.
const OF_RADIUS: f64 = 0.1;

/// Places left open are told from each other beyond so many shares (half angles): in another chart the equations have other weights.
const COARSE: f64 = 30.0;

/// Whether a root is at this place: not farther away than enclosures reach, and the digits of a double solution.
fn same(known: &RealRoot, unknowns: &[f64], radius: f64) -> bool {
    const APART: f64 = 1e-6;
    let largest = known.unknowns.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    let pairs = known.unknowns.iter().zip(unknowns);
    pairs
        .into_iter()
        .all(|(a, b)| (a - b).abs() <= (2.0 * radius).max(APART) * largest)
}

/// Least share of a direction along the coordinate that is left out: far above what rounding makes of it.
const LEAST_SHARE: f64 = 1e-3;

/// Whether the equations that were not used to prove a solution follow from those that were. Of a point P beside another
/// point Q that the bodies share, at the same distance in both, one coordinate may be left out: the difference of P in the
/// two bodies is then along that coordinate, and perpendicular to P − Q up to its own size, so that it is zero where P − Q
/// has a share along it that is larger than any difference within the enclosure, of this `radius` in half angles.
fn others_follow(system: &ReducedSystem, used: &[usize], unknowns: &[f64], radius: f64) -> bool {
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
        let least = LEAST_SHARE.max(reach(system, [*point, *beside], unknowns) * radius);
        if !(system.share_along(closure, *point, *beside, unknowns) >= least) {
            return false;
        }
    }
    true
}

/// How far a half angle may move a point in a body, in parts of its distance from another one: all turns add up, and each acts on an arm
/// of no more than twice the farthest coordinate.
fn reach(system: &ReducedSystem, [one, other]: [usize; 2], unknowns: &[f64]) -> f64 {
    let points = system.points_at(unknowns);
    let (Some(p), Some(q)) = (points[one], points[other]) else {
        return f64::INFINITY;
    };
    let apart = p
        .iter()
        .zip(&q)
        .map(|(a, b)| (a - b) * (a - b))
        .sum::<f64>()
        .sqrt();
    let coordinates = points.iter().flatten().flatten();
    let far = coordinates.fold(0.0, |m: f64, x| m.max(x.abs()));
    2.0 * 2.0 * system.freedom() as f64 * far / apart
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod disturbed;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
