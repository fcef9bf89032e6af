//! A curve of poses: a list of nodes, and between two of them a shape that predicts the poses in between.
//!
//! Between ordinary nodes the shape is the cubic through both with their tangents; a pose is predicted by it and corrected.
//! Across a singular pose the shape is a polynomial through poses on either side, found away from it, and a pose close to
//! the singular one is what it says, uncorrected.

use super::bridge::Bridge;
use super::cubic::Cubic;
use super::links::WholeFrame;
use super::node::Node;
use super::solver::{Along, Solver};
use super::system::SystemPose;
use super::vectors::{dot, length};
use kutzbach_closure::{JointState, Rigid};
use std::sync::Arc;

/// An interpolated pose that is closed better than this (rad, cycle lengths) is left as it is.
const WELL_CLOSED: f64 = 1e-14;

/// Steps of least length where Newton's method does not serve: on shaky branches the closure falls to a quarter each time.
const POLISHINGS: usize = 24;

/// What the pose before was off by serves a prediction up to so many times its own share; from beside a node it is rounding.
const MOST_SHARE: f64 = 4.0;

/// What predicts the poses between two nodes.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    Cubic(Cubic),
    Bridge(Box<Bridge>),
}

/// A pose of a curve.
#[derive(Clone, Debug)]
pub struct CurvePose {
    /// Arclength from the start of the trace, in the metric: radians, and part lengths.
    pub arclength: f64,
    /// Where the joints of the moving part stand.
    pub pose: SystemPose,
    /// Largest loop equation left (rad, cycle lengths).
    pub closure: f64,
}

/// A one-parameter motion of a mechanism: poses by arclength or by the value of the driven variable.
///
/// Poses are closed to rounding wherever they are asked for. Cost of one: some microseconds for one loop, linear in the
/// number of loops for long chains.
#[derive(Clone, Debug)]
pub struct Curve {
    pub(super) solver: Solver,
    pub(super) nodes: Vec<Node>,
    /// One per pair of neighbours.
    pub(super) shapes: Vec<Shape>,
    pub(super) closed: bool,
    /// The unknown that is driven.
    pub(super) drive: usize,
    /// (arclength, value) of the driven variable at nodes and at its dead centres, in order.
    pub(super) milestones: Vec<(f64, f64)>,
    pub(super) frame: Arc<WholeFrame>,
    /// How far the last pose asked for was off its prediction.
    pub(super) beside: Option<Beside>,
}

/// How far a pose between two nodes is off the cubic through both.
#[derive(Clone, Debug)]
pub(super) struct Beside {
    segment: usize,
    u: f64,
    off: Vec<f64>,
}

impl Beside {
    /// What a cubic is off by is u² (1 − u)² times a vector that changes little along a segment.
    fn share(u: f64) -> f64 {
        (u * (1.0 - u)).powi(2)
    }
}

impl Curve {
    /// The least and the greatest arclength. A closed curve has all others too.
    #[must_use]
    pub fn arclengths(&self) -> (f64, f64) {
        match (self.nodes.first(), self.nodes.last()) {
            (Some(first), Some(last)) => (first.arc, last.arc),
            _ => (0.0, 0.0),
        }
    }

    /// Whether the curve comes back to where it started.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// The part's length (m), in whose units slides count for the arclength.
    #[must_use]
    pub fn length_unit(&self) -> f64 {
        self.solver.system.length()
    }

    /// The unknown of the part that is driven.
    #[must_use]
    pub fn driven_unknown(&self) -> usize {
        self.drive
    }

    /// How well the loops of the poses asked for from here on have to close (rad, cycle lengths). Zero asks for rounding,
    /// which a curve begins with. The curve itself stays as it was found: between two of its poses a cubic predicts to about
    /// 1e-7, so that a pose closed less well than that costs no step of Newton's method, and one closed to rounding two.
    pub fn set_tolerance(&mut self, tolerance: f64) {
        self.solver.tolerance = tolerance.max(0.0);
    }

    /// The equations of the moving part.
    #[must_use]
    pub fn system(&self) -> &super::LoopSystem {
        &self.solver.system
    }

    /// (arclength, margin) along the curve: the smallest singular value that the equations keep there, with what is held,
    /// in the metric. Where it is small, a pose is known less well than its loops close.
    pub fn margins(&self) -> impl Iterator<Item = (f64, f64)> {
        self.nodes.iter().map(|node| (node.arc, node.margin))
    }

    /// (arclength, unknowns of the part) at the poses that the curve is made of, in the order of the arclength.
    pub fn poses(&self) -> impl Iterator<Item = (f64, &[f64])> {
        let nodes = self.nodes.iter();
        nodes.map(|node| (node.arc, node.pose.values.as_slice()))
    }

    /// The pose at an arclength; `None` beyond the ends of a curve that is not closed. On a closed curve angles go on
    /// counting.
    pub fn pose_at_arclength(&mut self, arclength: f64) -> Option<CurvePose> {
        let (first, last) = self.arclengths();
        let span = last - first;
        let turns = if self.closed && span > 0.0 && !(first..=last).contains(&arclength) {
            ((arclength - first) / span).floor()
        } else {
            0.0
        };
        let wanted = arclength - turns * span;
        // Rounding of the reduction must not lead beyond an end.
        let slack = 1e-12 * (1.0 + span);
        if !(wanted >= first - slack && wanted <= last + slack) {
            return None;
        }
        let (segment, u) = self.place_of(wanted)?;
        let mut found = self.pose_between(segment, u)?;
        found.arclength = arclength;
        if turns != 0.0 {
            let around: Vec<f64> = self.winding();
            for (value, way) in found.pose.values.iter_mut().zip(around) {
                *value += turns * way;
            }
        }
        Some(found)
    }

    /// By how much every unknown grows once around a closed curve (rad, m).
    #[must_use]
    pub fn winding(&self) -> Vec<f64> {
        match (self.nodes.first(), self.nodes.last()) {
            (Some(first), Some(last)) if self.closed => first
                .pose
                .values
                .iter()
                .zip(&last.pose.values)
                .map(|(a, b)| b - a)
                .collect(),
            _ => vec![0.0; self.solver.system.unknowns()],
        }
    }

    /// The pose that the curve predicts at an arclength between its ends, without closing it: off by some 1e-7 in the metric
    /// where nodes stand as far apart as they may, and as cheap as it is rough. `None` beyond the ends.
    #[must_use]
    pub fn predicted_at(&self, arclength: f64) -> Option<SystemPose> {
        let (first, last) = self.arclengths();
        if !(first..=last).contains(&arclength) {
            return None;
        }
        let (segment, u) = self.place_of(arclength)?;
        Some(match &self.shapes[segment] {
            Shape::Bridge(bridge) => bridge.pose(&self.solver, u),
            Shape::Cubic(cubic) => {
                let mut pose = self.nodes[segment].pose.clone();
                self.solver.system.advance(&mut pose, &cubic.at(u));
                pose
            }
        })
    }

    /// The segment of an arclength, and the place in it from 0 to 1.
    fn place_of(&self, arclength: f64) -> Option<(usize, f64)> {
        let segment = self.segment_at(arclength)?;
        let (from, to) = (self.nodes[segment].arc, self.nodes[segment + 1].arc);
        let gap = to - from;
        let u = if gap > 0.0 {
            ((arclength - from) / gap).clamp(0.0, 1.0)
        } else {
            0.0
        };
        Some((segment, u))
    }

    fn segment_at(&self, arclength: f64) -> Option<usize> {
        if self.nodes.len() < 2 {
            return None;
        }
        let after = self.nodes.partition_point(|n| n.arc <= arclength);
        Some(after.saturating_sub(1).min(self.nodes.len() - 2))
    }

    /// The pose at a place between two nodes, `u` from 0 to 1.
    pub(super) fn pose_between(&mut self, segment: usize, u: f64) -> Option<CurvePose> {
        let arc =
            self.nodes[segment].arc + u * (self.nodes[segment + 1].arc - self.nodes[segment].arc);
        match &self.shapes[segment] {
            Shape::Cubic(cubic) => {
                let mut across = cubic.velocity(u);
                let size = length(&across);
                across.iter_mut().for_each(|x| *x /= size);
                let mut pose = self.guess(segment, (cubic, u), Some(&across));
                let guess = pose.clone();
                if let Some(done) = self
                    .solver
                    .correct_next(&mut pose, Along::Across(&across), arc)
                {
                    self.beside = self.off_prediction(segment, cubic, u, &pose);
                    return Some(CurvePose {
                        arclength: arc,
                        pose,
                        closure: done.closure,
                    });
                }
                // Hardly any margin: closed by short steps as well as can be.
                pose = guess;
                let mut closure = f64::INFINITY;
                for _ in 0..POLISHINGS {
                    closure = self.solver.polish(&mut pose);
                    if closure < WELL_CLOSED {
                        break;
                    }
                }
                (closure <= self.solver.allowed).then_some(CurvePose {
                    arclength: arc,
                    pose,
                    closure,
                })
            }
            Shape::Bridge(bridge) => {
                let pose = bridge.pose(&self.solver, u);
                let closure = self.solver.closure_of(&pose);
                let mut best = CurvePose {
                    arclength: arc,
                    pose,
                    closure,
                };
                if best.closure > WELL_CLOSED {
                    let mut tried = best.pose.clone();
                    let closure = self.solver.polish(&mut tried);
                    if closure < best.closure {
                        best.pose = tried;
                        best.closure = closure;
                    }
                }
                let mut tried = best.pose.clone();
                if bridge.is_beside(u)
                    && let Some(done) = self
                        .solver
                        .correct(&mut tried, Along::Across(&bridge.direction(u)))
                    && done.closure < best.closure
                    && done.way < 1e-8
                {
                    best.pose = tried;
                    best.closure = done.closure;
                }
                Some(best)
            }
        }
    }

    /// What is predicted between two nodes: as far off the cubic as the pose asked for before was, in the plane across a direction if one
    /// is given.
    fn guess(
        &self,
        segment: usize,
        (cubic, u): (&Cubic, f64),
        across: Option<&[f64]>,
    ) -> SystemPose {
        let mut way = cubic.at(u);
        if let Some(beside) = self.beside.as_ref().filter(|b| b.segment == segment) {
            let share = Beside::share(u) / Beside::share(beside.u);
            if share < MOST_SHARE {
                let along = across.map_or(0.0, |across| dot(&beside.off, across));
                for (i, (way, off)) in way.iter_mut().zip(&beside.off).enumerate() {
                    *way += share * (off - across.map_or(0.0, |across| along * across[i]));
                }
            }
        }
        let mut pose = self.nodes[segment].pose.clone();
        self.solver.system.advance(&mut pose, &way);
        pose
    }

    fn off_prediction(
        &self,
        segment: usize,
        cubic: &Cubic,
        u: f64,
        pose: &SystemPose,
    ) -> Option<Beside> {
        let mut off = vec![0.0; self.solver.system.unknowns()];
        let from = &self.nodes[segment].pose;
        self.solver.system.way(from, pose, &mut off);
        off.iter_mut()
            .zip(&cubic.at(u))
            .for_each(|(off, at)| *off -= at);
        Some(Beside { segment, u, off })
    }

    /// The unit tangent at a pose of a segment, forward.
    pub(super) fn tangent_between(&mut self, segment: usize, u: f64) -> Option<Vec<f64>> {
        match &self.shapes[segment] {
            Shape::Bridge(bridge) => Some(bridge.direction(u)),
            Shape::Cubic(cubic) => {
                let toward = cubic.velocity(u);
                let found = self.pose_between(segment, u)?;
                if !self.solver.linearise(&found.pose) {
                    return None;
                }
                let mut tangent = self.solver.tangent().to_vec();
                if dot(&tangent, &toward) < 0.0 {
                    tangent.iter_mut().for_each(|t| *t = -*t);
                }
                Some(tangent)
            }
        }
    }

    /// The values of the driven variable that the curve reaches without turning back, from its start; infinite where it
    /// goes round.
    #[must_use]
    pub fn drive_range(&self) -> (f64, f64) {
        let (from, to) = self.stretch();
        let goes_on = |value: f64, other: f64| {
            if value > other {
                f64::INFINITY
            } else {
                f64::NEG_INFINITY
            }
        };
        let last = self.milestones.len().saturating_sub(1);
        let (Some(a), Some(b)) = (self.milestones.get(from), self.milestones.get(to)) else {
            return (f64::NAN, f64::NAN);
        };
        if self.closed && from == 0 && to == last {
            let (low, high) = (goes_on(a.1, b.1), goes_on(b.1, a.1));
            return (low.min(high), low.max(high));
        }
        let before = self.stretch_before().map(|begin| {
            let around = self.milestones[last].1 - self.milestones[0].1;
            self.milestones[begin].1 - around
        });
        let begin = before.unwrap_or(a.1);
        (begin.min(b.1), begin.max(b.1))
    }

    /// Where the stretch around the start begins behind the end of a closed curve: the curve is told from its start, which need not
    /// be a place where the driven variable turns back.
    fn stretch_before(&self) -> Option<usize> {
        let m = &self.milestones;
        let (from, to) = self.stretch();
        let last = m.len().saturating_sub(1);
        if !self.closed || from > 0 || to == last {
            return None;
        }
        let rising = m[to].1 > m[from].1;
        let mut begin = last;
        while begin > to && (m[begin].1 > m[begin - 1].1) == rising && m[begin].1 != m[begin - 1].1
        {
            begin -= 1;
        }
        (begin < last).then_some(begin)
    }

    /// The milestones between which the driven variable is monotonic, around the start of the curve.
    pub(super) fn stretch(&self) -> (usize, usize) {
        let m = &self.milestones;
        if m.len() < 2 {
            return (0, 0);
        }
        // The pair that has the start inside; where the start is a dead centre, the one ahead.
        let first = m
            .windows(2)
            .position(|pair| pair[1].0 > 1e-12)
            .unwrap_or(m.len() - 2);
        let rising = m[first + 1].1 > m[first].1;
        let same = |i: usize| (m[i + 1].1 > m[i].1) == rising && m[i + 1].1 != m[i].1;
        let mut from = first;
        while from > 0 && same(from - 1) {
            from -= 1;
        }
        let mut to = first + 1;
        while to + 1 < m.len() && same(to) {
            to += 1;
        }
        (from, to)
    }

    /// The pose at which the driven variable has a value (rad, m), on the stretch around the start on which it does not
    /// turn back; `None` where it is not reached there.
    pub fn pose_at_drive(&mut self, value: f64) -> Option<CurvePose> {
        let (low, high) = self.drive_range();
        if !(value >= low - 1e-12 && value <= high + 1e-12) {
            return None;
        }
        let (mut from, mut to) = self.stretch();
        let (a, b) = (self.milestones[from], self.milestones[to]);
        let mut wanted = value;
        let mut turns = 0.0;
        if self.closed && low.is_infinite() {
            let around = b.1 - a.1;
            turns = ((value - a.1) / around).floor();
            wanted = value - turns * around;
        } else if let Some(begin) = self
            .stretch_before()
            .filter(|_| (value < a.1) == (b.1 > a.1) && value != a.1)
        {
            (from, to) = (begin, self.milestones.len() - 1);
            wanted = value + self.milestones[to].1 - self.milestones[0].1;
            turns = -1.0;
        }
        let inside = &self.milestones[from..=to];
        let rising = inside[inside.len() - 1].1 > inside[0].1;
        let place = inside
            .partition_point(|m| if rising { m.1 <= wanted } else { m.1 >= wanted })
            .clamp(1, inside.len() - 1);
        let (start, end) = (inside[place - 1], inside[place]);
        let mut found = self.solve_drive(start, end, wanted)?;
        let (first, last) = self.arclengths();
        found.arclength += turns * (last - first);
        if turns != 0.0 {
            let around = self.winding();
            for (value, way) in found.pose.values.iter_mut().zip(around) {
                *value += turns * way;
            }
        }
        Some(found)
    }

    /// The pose nearest to the start along the curve at which the driven variable has a value (rad, m), wherever it turns back on the
    /// way; `None` where the curve does not have it.
    pub fn nearest_at_drive(&mut self, value: f64) -> Option<CurvePose> {
        let (first, last) = self.arclengths();
        let around = last - first;
        let distance = |arclength: f64| match self.closed {
            true => arclength.abs().min(around - arclength.abs()),
            false => arclength.abs(),
        };
        let pairs = self.milestones.windows(2).map(|pair| (pair[0], pair[1]));
        let mut holding: Vec<_> = pairs
            .filter(|(a, b)| a.1.min(b.1) <= value && value <= a.1.max(b.1))
            .collect();
        holding.sort_by(|(a, b), (c, d)| {
            let near = |a: f64, b: f64| distance(a).min(distance(b));
            near(a.0, b.0).total_cmp(&near(c.0, d.0))
        });
        holding
            .into_iter()
            .find_map(|(start, end)| self.solve_drive(start, end, value))
    }

    /// The pose between two milestones where the driven variable has a value.
    fn solve_drive(&mut self, start: (f64, f64), end: (f64, f64), value: f64) -> Option<CurvePose> {
        let middle = 0.5 * (start.0 + end.0);
        let segment = self.segment_at(middle)?;
        let gap = self.nodes[segment + 1].arc - self.nodes[segment].arc;
        let base = self.nodes[segment].arc;
        let unit = |arc: f64| ((arc - base) / gap).clamp(0.0, 1.0);
        let (mut low, mut high) = (unit(start.0), unit(end.0));
        if let Shape::Cubic(cubic) = &self.shapes[segment] {
            let own = self.nodes[segment].pose.values[self.drive];
            let wanted = (value - own) * self.solver.system.weights()[self.drive];
            let rising = end.1 > start.1;
            let mut u =
                low + (high - low) * ((value - start.1) / (end.1 - start.1)).clamp(0.0, 1.0);
            // Newton's steps on one cubic, kept inside by halving.
            for _ in 0..12 {
                let off = cubic.component(self.drive, u) - wanted;
                let step = off / cubic.speed(self.drive, u);
                if step.abs() < 1e-14 {
                    break;
                }
                if (off < 0.0) == rising {
                    low = u;
                } else {
                    high = u;
                }
                let next = u - step;
                u = if next > low && next < high {
                    next
                } else {
                    0.5 * (low + high)
                };
            }
            let mut pose = self.guess(segment, (cubic, u), None);
            if cubic.speed(self.drive, u).abs() > 1e-3 * gap
                && let Some(done) = self.solver.correct_next(
                    &mut pose,
                    Along::Value(self.drive, value),
                    base + u * gap,
                )
                && done.way < 0.1 * gap
            {
                self.beside = self.off_prediction(segment, cubic, u, &pose);
                // Where the plane across the cubic at u passes through the pose found.
                let mut z = vec![0.0; self.solver.system.unknowns()];
                self.solver
                    .system
                    .way(&self.nodes[segment].pose, &pose, &mut z);
                for _ in 0..3 {
                    let (at, along) = (cubic.at(u), cubic.velocity(u));
                    let off: f64 = z
                        .iter()
                        .zip(&at)
                        .zip(&along)
                        .map(|((z, a), v)| (z - a) * v)
                        .sum();
                    u += off / dot(&along, &along);
                }
                return Some(CurvePose {
                    arclength: base + u * gap,
                    pose,
                    closure: done.closure,
                });
            }
            (low, high) = (unit(start.0), unit(end.0));
        }
        // Close to a dead centre or a singular pose: halve.
        let rising = end.1 > start.1;
        let mut best = None;
        for _ in 0..60 {
            let u = 0.5 * (low + high);
            let found = self.pose_between(segment, u)?;
            let off = found.pose.values[self.drive] - value;
            if (off < 0.0) == rising {
                low = u;
            } else {
                high = u;
            }
            let done = off.abs() < 1e-15 || high - low < 1e-15;
            best = Some(found);
            if done {
                break;
            }
        }
        best
    }

    /// The states of all joints of the mechanism at a pose of the curve.
    #[must_use]
    pub fn states(&self, pose: &SystemPose) -> Vec<JointState<f64>> {
        let mut states = self.frame.states.clone();
        self.solver.system.put(pose, &mut states);
        states
    }

    /// `world_from_link` of every link at a pose of the curve, by link index.
    #[must_use]
    pub fn link_poses(&self, pose: &SystemPose) -> Vec<Rigid<f64>> {
        self.frame.link_poses(&self.solver.system, pose)
    }

    /// The values of all joint variables of the mechanism at a pose of the curve, joint by joint (rad, m).
    #[must_use]
    pub fn values(&self, pose: &SystemPose) -> Vec<f64> {
        self.frame.values(pose)
    }

    /// Values of all joint variables of the mechanism, such as those of a sample, joint by joint.
    #[must_use]
    pub fn by_joint(&self, values: &[f64]) -> Vec<Vec<f64>> {
        let mut rest = values.iter().copied();
        let joints = self.frame.mechanism.joints().iter();
        joints
            .map(|joint| rest.by_ref().take(joint.freedom()).collect())
            .collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{TraceOptions, trace};
    use kutzbach_closure::samples::{Place, Written, planar, ring};
    use kutzbach_mobility::{AnalysisOptions, analyse};
    use kutzbach_model::mechanism::JointKind;

    /// The curve of a ring, and the same curve with its equations factored as those of a large part are.
    fn both(places: &[Place]) -> (Curve, Curve) {
        let mechanism = ring(places, [0.0; 3], Written::Exactly);
        let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
        let options = TraceOptions {
            samples: 2,
            ..TraceOptions::default()
        };
        let traced = trace(&mechanism, &analysis, &options).unwrap();
        let dense = traced.into_motion().unwrap().curve;
        let mut sparse = dense.clone();
        let (system, holds) = (Arc::clone(&dense.solver.system), dense.solver.holds());
        let generic = dense
            .nodes
            .iter()
            .max_by(|a, b| a.margin.total_cmp(&b.margin));
        let start = &generic.unwrap().pose;
        let allowed = dense.solver.allowed;
        sparse.solver =
            Solver::with_dense_up_to(0, system, start, holds.to_vec(), 0, allowed).unwrap();
        (dense, sparse)
    }

    /// A hinge, two balls and a cylindrical joint, one ball held, comes so near to singular poses that a pose may be 2e-7 off where its
    /// loops close to rounding; a four-bar that is nearly a parallelogram comes near to its flat pose.
    #[test]
    fn poses_are_those_of_factors_made_anew_however_near_a_singular_pose() {
        let spatial = [
            (JointKind::Revolute, [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            (JointKind::Spherical, [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            (JointKind::Spherical, [2.0, 3.0, 2.0], [0.0, 0.0, 1.0]),
            (JointKind::Cylindrical, [2.0, 3.0, 0.0], [1.0, 2.0, 2.0]),
        ];
        let flat = planar(&[[0.0, 0.0], [0.0, 1.0], [3.0, 1.0], [3.0, -1e-3]]);
        for (places, name) in [(spatial.to_vec(), "rssc"), (flat, "four-bar")] {
            let (mut dense, mut sparse) = both(&places);
            let (first, last) = dense.arclengths();
            for poses in [100, 1000, 5000] {
                for index in 0..poses {
                    let arc = first + (last - first) * f64::from(index) / f64::from(poses);
                    let kept = sparse.pose_at_arclength(arc).unwrap();
                    dense.solver.fix(None);
                    let anew = dense.pose_at_arclength(arc).unwrap();
                    let off = dense.solver.system.separation(&kept.pose, &anew.pose);
                    assert!(off < 1e-10, "{name}, {index} of {poses}: {off:e}");
                }
            }
        }
    }
}
