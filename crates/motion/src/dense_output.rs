//! Dense output: a polynomial that gives all poses between two nodes to rounding.
//!
//! The cubic between two nodes is off by u² (1 − u)² g(u) with a smooth g. This g is interpolated (Newton's divided differences) at
//! poses that are corrected with factors of their own, one after another, each where the polynomial may be off most, until two of them
//! in a row are predicted as closely as they are known. The error of a polynomial through n poses is seen at the next one, and falls
//! geometrically for a curve that is analytic, as loop equations make it between singular poses (Trefethen 2013, chapters 8 and 16).
//!
//! Nothing is solved for at the poses in between, and factors are needed at a handful of poses per segment, however many are
//! asked for. They are known as well as the poses interpolated, *whatever the margin*: where these are off by what rounding leaves over the
//! least singular value, so are they, times a Lebesgue constant of six at most. A residual tells nothing of the kind (divided by a margin
//! of 1e-8, what is met to rounding is open to 1e-7); it is looked at all the same, and a pose that stays open is corrected by itself.

use super::cubic::Cubic;
use super::node::Node;
use super::solver::{Along, Solver};
use super::system::SystemPose;
use super::vectors::length;

/// Where g is taken: each place makes u² (1 − u)² Π |u − uⱼ| greatest (weighted Leja points: Reichel 1990).
const PLACES: [f64; 10] = [
    0.5, 0.276, 0.764, 0.141, 0.879, 0.623, 0.071, 0.389, 0.942, 0.206,
];

/// A pose no farther from the curve than this (metric) is on it: rounding of a hundred joints.
const CLOSE: f64 = 3e-14;

/// An equation is rounded by this, m of them by √m as much, which leaves a pose open by that over their margin.
const ROUNDED: f64 = 2.0 * f64::EPSILON;

/// What rounding leaves open by more than this is not taken for predicted.
const MOST_OPEN: f64 = 1e-11;

/// A pose is predicted where it is off by no more than so many times what rounding leaves.
const PREDICTED: f64 = 4.0;

/// So many poses in a row have to be predicted: one may be by symmetry.
const IN_A_ROW: usize = 2;

/// A pose between two nodes may be as many times as open as those interpolated: rounding differs.
const OPEN: f64 = 4.0;

/// The polynomial between two nodes, over the cubic.
#[derive(Clone, Debug)]
pub(super) struct DenseOutput {
    /// Divided differences of g, one vector of all unknowns after another.
    differences: Vec<f64>,
    /// Largest loop equation at the poses interpolated.
    closure: f64,
}

/// u² (1 − u)² and its derivative.
fn share(u: f64) -> (f64, f64) {
    let root = u * (1.0 - u);
    (root * root, 2.0 * root * (1.0 - 2.0 * u))
}

impl DenseOutput {
    /// The polynomial between a node and the next; `None` where more poses would be needed than there are places.
    pub fn between(solver: &mut Solver, nodes: [&Node; 2], cubic: &Cubic) -> Option<Self> {
        let [from, to] = nodes;
        let rounded = (solver.system.unknowns() as f64).sqrt() * ROUNDED;
        let close = (rounded / from.margin.min(to.margin)).clamp(CLOSE, MOST_OPEN);
        let tolerance = std::mem::take(&mut solver.tolerance);
        let found = Self::interpolate(solver, from, cubic, PREDICTED * close);
        solver.tolerance = tolerance;
        found
    }

    fn interpolate(solver: &mut Solver, from: &Node, cubic: &Cubic, close: f64) -> Option<Self> {
        let mut found = Self {
            differences: Vec::new(),
            closure: f64::EPSILON,
        };
        let mut predicted = vec![0.0; solver.system.unknowns()];
        let mut way = predicted.clone();
        let mut in_a_row = 0;
        for (index, &u) in PLACES.iter().enumerate() {
            found.write(cubic, u, &mut predicted);
            // From the cubic, as a pose that is asked for by itself: which pose of the curve is meant depends on where corrections begin.
            let mut pose = from.pose.clone();
            solver.system.advance(&mut pose, &cubic.at(u));
            let across = direction(cubic, u);
            let done = solver.correct(&mut pose, Along::Across(&across))?;
            found.closure = found.closure.max(done.closure);
            solver.system.way(&from.pose, &pose, &mut way);
            way.iter_mut().zip(&predicted).for_each(|(w, p)| *w -= p);
            in_a_row = if length(&way) <= close {
                in_a_row + 1
            } else {
                0
            };
            let product: f64 = PLACES[..index].iter().map(|other| u - other).product();
            let scale = share(u).0 * product;
            found.differences.extend(way.iter().map(|off| off / scale));
            if in_a_row == IN_A_ROW {
                return Some(found);
            }
        }
        None
    }

    /// The pose at a place between the nodes, and its largest loop equation; `None` where that stays open.
    pub fn pose(
        &self,
        solver: &mut Solver,
        from: &Node,
        (cubic, u): (&Cubic, f64),
    ) -> Option<(SystemPose, f64)> {
        let mut way = vec![0.0; solver.system.unknowns()];
        self.write(cubic, u, &mut way);
        let mut pose = from.pose.clone();
        solver.system.advance(&mut pose, &way);
        let closure = solver.closure_of(&pose);
        (closure <= OPEN * self.closure).then_some((pose, closure))
    }

    /// The way from the first node, in its chart.
    fn write(&self, cubic: &Cubic, u: f64, way: &mut [f64]) {
        way.fill(0.0);
        let n = way.len();
        let terms = self.differences.chunks_exact(n.max(1)).zip(PLACES);
        for (difference, place) in terms.rev() {
            let factor = u - place;
            for (w, d) in way.iter_mut().zip(difference) {
                *w = *w * factor + d;
            }
        }
        let share = share(u).0;
        for (w, c) in way.iter_mut().zip(cubic.at(u)) {
            *w = *w * share + c;
        }
    }

    /// One component of the way, and its derivative by u.
    pub fn component(&self, cubic: &Cubic, i: usize, u: f64) -> (f64, f64) {
        let n = cubic.unknowns().max(1);
        let (mut g, mut slope) = (0.0, 0.0);
        let terms = self.differences.chunks_exact(n).zip(PLACES);
        for (difference, place) in terms.rev() {
            slope = slope * (u - place) + g;
            g = g * (u - place) + difference[i];
        }
        let (share, change) = share(u);
        (
            cubic.component(i, u) + share * g,
            cubic.speed(i, u) + share * slope + change * g,
        )
    }
}

/// The unit vector along the cubic.
pub(super) fn direction(cubic: &Cubic, u: f64) -> Vec<f64> {
    let mut along = cubic.velocity(u);
    let size = length(&along);
    along.iter_mut().for_each(|x| *x /= size);
    along
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_where_the_polynomial_may_be_off_most() {
        for (index, place) in PLACES.iter().enumerate() {
            let weight = |u: f64| {
                let before = PLACES[..index].iter();
                before.fold(share(u).0, |product, other| product * (u - other).abs())
            };
            let most = (0..=1000).fold(0.0f64, |most, k| most.max(weight(f64::from(k) * 1e-3)));
            assert!(weight(*place) > 0.99 * most, "{place}");
        }
    }
}
