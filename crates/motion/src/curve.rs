//! A curve of poses: a list of nodes, and between two of them a shape that predicts the poses in between.
//!
//! Between ordinary nodes the shape is the cubic through both with their tangents; a pose is predicted by it and corrected, or, where
//! many are asked for, read off a polynomial over it ([`super::dense_output`]).
//! Across a singular pose the shape is a polynomial through poses on either side, found away from it, and a pose close to
//! the singular one is what it says, uncorrected.

use super::bridge::Bridge;
use super::cubic::Cubic;
use super::dense_output::{DenseOutput, direction};
use super::links::WholeFrame;
use super::node::Node;
use super::solver::{Along, Solver};
use super::system::SystemPose;
use super::vectors::dot;
use kutzbach_closure::{JointState, Rigid};
use std::sync::Arc;

/// An interpolated pose that is closed better than this (rad, cycle lengths) is left as it is.
const WELL_CLOSED: f64 = 1e-14;

/// Steps of least length where Newton's method does not serve: on shaky branches the closure falls to a quarter each time.
const POLISHINGS: usize = 24;

/// A polynomial through a segment, which takes some six poses corrected by themselves, pays where so many are asked for.
const MANY: f64 = 8.0;

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
    /// Arclength of the last pose asked for between ordinary nodes.
    pub(super) asked: f64,
    /// The last segment of which many poses were asked for, with the polynomial through it, if one is known.
    pub(super) dense: Option<(usize, Option<DenseOutput>)>,
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
            Shape::Cubic(cubic) => self.guess(segment, (cubic, u)),
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

    pub(super) fn segment_at(&self, arclength: f64) -> Option<usize> {
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
        if let Some(found) = self.read_off(segment, u, arc) {
            return Some(found);
        }
        match &self.shapes[segment] {
            Shape::Cubic(cubic) => {
                let across = direction(cubic, u);
                let guess = self.guess(segment, (cubic, u));
                let mut pose = guess.clone();
                if let Some(done) = self.solver.correct(&mut pose, Along::Across(&across)) {
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

    /// The polynomial through a segment, made where poses asked for one after another lie so close that it pays.
    pub(super) fn dense_through(&mut self, segment: usize, arc: f64) -> Option<&DenseOutput> {
        let spacing = (arc - std::mem::replace(&mut self.asked, arc)).abs();
        let nodes = [&self.nodes[segment], &self.nodes[segment + 1]];
        let known = self.dense.as_ref().is_some_and(|(of, _)| *of == segment);
        if !known && spacing * MANY <= nodes[1].arc - nodes[0].arc {
            let found = match &self.shapes[segment] {
                Shape::Cubic(cubic) => DenseOutput::between(&mut self.solver, nodes, cubic),
                Shape::Bridge(_) => None,
            };
            self.dense = Some((segment, found));
        }
        let here = self.dense.as_ref().filter(|(of, _)| *of == segment);
        here.and_then(|(_, found)| found.as_ref())
    }

    /// The pose that the polynomial through a segment says, where there is one.
    fn read_off(&mut self, segment: usize, u: f64, arc: f64) -> Option<CurvePose> {
        self.dense_through(segment, arc)?;
        let (_, dense) = self.dense.as_ref()?;
        let Shape::Cubic(cubic) = &self.shapes[segment] else {
            return None;
        };
        let from = &self.nodes[segment];
        let (pose, closure) = dense.as_ref()?.pose(&mut self.solver, from, (cubic, u))?;
        Some(CurvePose {
            arclength: arc,
            pose,
            closure,
        })
    }

    /// What is predicted between two nodes.
    pub(super) fn guess(&self, segment: usize, (cubic, u): (&Cubic, f64)) -> SystemPose {
        let mut pose = self.nodes[segment].pose.clone();
        self.solver.system.advance(&mut pose, &cubic.at(u));
        pose
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
    fn poses_read_off_a_polynomial_are_those_corrected_however_near_a_singular_pose() {
        let spatial = [
            (JointKind::Revolute, [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            (JointKind::Spherical, [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            (JointKind::Spherical, [2.0, 3.0, 2.0], [0.0, 0.0, 1.0]),
            (JointKind::Cylindrical, [2.0, 3.0, 0.0], [1.0, 2.0, 2.0]),
        ];
        let flat = planar(&[[0.0, 0.0], [0.0, 1.0], [3.0, 1.0], [3.0, -1e-3]]);
        for (places, name) in [(spatial.to_vec(), "rssc"), (flat, "four-bar")] {
            let (mut once, mut often) = both(&places);
            let (first, last) = once.arclengths();
            for poses in [100, 1000, 5000] {
                let mut read_off = 0;
                for index in 0..poses {
                    let arc = first + (last - first) * f64::from(index) / f64::from(poses);
                    let many = often.pose_at_arclength(arc).unwrap();
                    let (segment, _) = often.place_of(arc).unwrap();
                    let polynomial = matches!(often.dense, Some((at, Some(_))) if at == segment);
                    read_off += i32::from(polynomial);
                    (once.asked, once.dense) = (f64::NAN, None);
                    let alone = once.pose_at_arclength(arc).unwrap();
                    let off = once.solver.system.separation(&many.pose, &alone.pose);
                    assert!(off < 1e-11, "{name}, {index} of {poses}: {off:e}");
                }
                let wanted = if poses < 5000 { 0 } else { 2 * poses / 3 };
                assert!(read_off >= wanted, "{name}: {read_off} of {poses}");
            }
        }
    }
}
