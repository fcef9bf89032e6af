//! Cheap proofs that a cycle closes at no pose at all.
//!
//! Each is a necessary condition on what the joints cannot change, whatever their values:
//!
//! - *Lengths.* The points that joints keep are the corners of a closed polygon, and no side of it is longer than all the others
//!   together (`spans.rs`).
//! - *Directions.* Where every joint keeps a direction (hinges, cylinders, screws, planes, slides), these directions are the corners of
//!   a closed polygon on the sphere with sides αᵢ in [0, π]. There is one if and only if for every set S of an odd number of sides
//!   Σ_S α − Σ_rest α ≤ (|S| − 1) π (for triangles: Blumenthal 1953, *Theory and Applications of Distance Geometry*, §18; by adding diagonals
//!   for all).
//! - *Offsets.* Where all axes are parallel hinges, and all slides across them, steps along them add up to zero.
//! - A cycle all of whose joints are held or fixed is as open as it is drawn.
//!
//! Held joints are rigid. The bounds have to be exceeded by several times what still counts as closed.

use super::super::geometry::Geometry;
use super::descent::Task;
use super::spans::widest;
use kutzbach_math::space::{Rigid, Vector, cross, dot, length};
use kutzbach_model::mechanism::JointKind;
use std::f64::consts::PI;

/// What counts as closed is the miss at a cycle's centre; a joint may miss by that and what the angle makes of its lever
/// arm, and the numbers may be off by as much again.
const SEVERAL: f64 = 4.0;

/// Directions within this angle (rad) of each other are taken as parallel; what they are off counts against the proof.
const PARALLEL: f64 = 1e-6;

/// Directions within this angle (rad) are parallel, or across one another, to rounding: a slide makes up for an offset of its length
/// times that angle, and no machine has slides so long.
const ACROSS: f64 = 1e-13;

/// Why a cycle closes at no pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// A side of the polygon of the points that its joints keep is longer than all the others together.
    TooShort {
        /// The joints that keep the ends of that side, by index; the same twice for a rod.
        between: [usize; 2],
        /// Its least length (m).
        apart: f64,
        /// What the others span at most (m).
        reach: f64,
    },
    /// The angles between its axes miss those of any closed polygon by so much (rad).
    Directions(f64),
    /// Steps along its parallel axes add up to so much (m).
    Offset(f64),
    /// All its joints are held or fixed.
    NothingMoves,
    /// The equations of so many loops together, this one among them, contradict one another: they have no solution, over the complex
    /// numbers either.
    Contradiction(usize),
    /// The equations of so many loops together, this one among them, have finitely many solutions over the complex numbers, and none of
    /// these is real.
    NoRealSolution(usize),
}

/// A cycle that closes at no pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProvenOpen {
    /// The joint that closes it in the file.
    pub joint: usize,
    /// Why.
    pub obstacle: Obstacle,
}

/// A joint as the walk around a cycle passes it.
pub(super) struct Corner {
    pub(super) joint: usize,
    /// Whether it is passed from predecessor to successor.
    pub(super) forward: bool,
    /// From the frame behind the corner before to the frame before this one.
    pub(super) step: Rigid<f64>,
    /// The direction kept, in the frame before and in the frame behind; `None` where none is.
    pub(super) axes: Option<[Vector<f64>; 2]>,
    /// The joint's axis, and its second one.
    pub(super) axis: Vector<f64>,
    pub(super) second: Vector<f64>,
    /// The length of a rod; 0 for other joints.
    pub(super) rod: f64,
    pub(super) kind: JointKind,
}

/// The cycle of a part that is proven to close nowhere, by the widest margin if there are several. `closing`: what counts as
/// closed (rad, cycle lengths); for each cycle its length and extent (m) are asked for.
pub(super) fn proven_open(
    task: &Task<'_>,
    closing: f64,
    scale: impl Fn(usize) -> Option<(f64, f64)>,
) -> Option<ProvenOpen> {
    let proofs = task
        .part
        .cycles
        .iter()
        .enumerate()
        .filter_map(|(index, cycle)| {
            let (cycle_length, extent) = scale(index)?;
            let angle = SEVERAL * closing;
            let distance = SEVERAL * closing * (cycle_length + extent);
            let (margin, obstacle) = obstacle(task, cycle, angle, distance)?;
            let named = |joint: &usize| {
                let joint = &task.mechanism.joints()[*joint];
                (!joint.closes_loop, joint.name.clone())
            };
            let joint = cycle.iter().map(|(joint, _)| *joint).min_by_key(named)?;
            Some((margin, ProvenOpen { joint, obstacle }))
        });
    // The first of equals.
    let mut widest: Option<(f64, ProvenOpen)> = None;
    for (margin, proof) in proofs {
        if widest.is_none_or(|(most, _)| margin > most) {
            widest = Some((margin, proof));
        }
    }
    widest.map(|(_, proof)| proof)
}

/// What keeps a cycle open, if anything is found, and how many times it exceeds what might still count as closed.
fn obstacle(
    task: &Task<'_>,
    cycle: &[(usize, bool)],
    angle: f64,
    distance: f64,
) -> Option<(f64, Obstacle)> {
    let found = match corners(task, cycle) {
        Err(rigid) => {
            let (turn, shift) = (length(&rigid.rotation_vector()), length(&rigid.translation));
            vec![(
                (turn / angle).max(shift / (distance + angle * shift)),
                Obstacle::NothingMoves,
            )]
        }
        Ok(corners) => [
            directions(&corners).map(|over| (over / angle, Obstacle::Directions(over))),
            offset(&corners).map(|(along, error)| {
                let along = along.abs();
                (along / (distance + error), Obstacle::Offset(along))
            }),
            widest(&corners).map(|span| {
                let obstacle = Obstacle::TooShort {
                    between: span.between,
                    apart: span.apart,
                    reach: span.reach,
                };
                ((span.apart - span.reach) / distance, obstacle)
            }),
        ]
        .into_iter()
        .flatten()
        .collect(),
    };
    found
        .into_iter()
        .filter(|(margin, _)| *margin > 1.0)
        .max_by(|a, b| a.0.total_cmp(&b.0))
}

/// The joints of a cycle that may move, in order; the displacement around it where there is none.
pub(super) fn corners(task: &Task<'_>, cycle: &[(usize, bool)]) -> Result<Vec<Corner>, Rigid<f64>> {
    let geometry: &Geometry<f64> = task.geometry;
    let mut step = Rigid::identity(&1.0);
    let mut corners: Vec<Corner> = Vec::new();
    for &(joint, forward) in cycle {
        let displacement = &geometry.displacements[joint];
        let [predecessor, successor] = &geometry.sides[joint];
        let (before, behind) = if forward {
            (predecessor, successor)
        } else {
            (successor, predecessor)
        };
        step = step.compose(before);
        let kind = displacement.kind();
        if kind.freedom() == 0 || task.held.contains(&joint) {
            let fixed = displacement.displacement(&geometry.states[joint]);
            step = step.compose(&if forward { fixed } else { fixed.inverse() });
        } else {
            let axis = *displacement.axis();
            let second = *displacement.second_axis();
            let axes = match kind {
                JointKind::Revolute
                | JointKind::Cylindrical
                | JointKind::Screw
                | JointKind::Planar
                | JointKind::TranslatingScrew
                | JointKind::Schoenflies => Some([axis, axis]),
                JointKind::Universal if forward => Some([axis, second]),
                JointKind::Universal => Some([second, axis]),
                _ => None,
            };
            corners.push(Corner {
                joint,
                forward,
                axis,
                second,
                step: std::mem::replace(&mut step, Rigid::identity(&1.0)),
                axes,
                rod: match kind {
                    JointKind::Distance => *displacement.distance(),
                    _ => 0.0,
                },
                kind,
            });
        }
        step = step.compose(&behind.inverse());
    }
    // What follows the last corner leads to the first one.
    match corners.first_mut() {
        Some(first) => {
            first.step = step.compose(&first.step);
            Ok(corners)
        }
        None => Err(step),
    }
}

fn angle_between(a: &Vector<f64>, b: &Vector<f64>) -> f64 {
    length(&cross(a, b)).atan2(dot(a, b))
}

/// By how much the angles between consecutive axes miss those of a closed polygon on the sphere (rad); negative where they
/// do not. `None` where a joint keeps no direction. Slides keep all of them, so that links on either side turn as one.
fn directions(corners: &[Corner]) -> Option<f64> {
    let slides = |corner: &Corner| {
        matches!(
            corner.kind,
            JointKind::Prismatic | JointKind::PlanarTranslation | JointKind::Translational
        )
    };
    let kept: Vec<usize> = (0..corners.len())
        .filter(|&index| !slides(&corners[index]))
        .collect();
    let Some(&first) = kept.first() else {
        let around = corners
            .iter()
            .fold(Rigid::identity(&1.0), |around, corner| {
                around.compose(&corner.step)
            });
        return Some(length(&around.rotation_vector()));
    };
    let mut angles = Vec::with_capacity(corners.len());
    let mut behind = corners[first].axes?[1];
    let mut turned = Rigid::identity(&1.0);
    for offset in 1..=corners.len() {
        let corner = &corners[(first + offset) % corners.len()];
        turned = turned.compose(&corner.step);
        if slides(corner) {
            continue;
        }
        let [before, after] = corner.axes?;
        angles.push(angle_between(&behind, &turned.rotate(&before)));
        if corner.kind == JointKind::Universal {
            angles.push(angle_between(&before, &after));
        }
        behind = after;
        turned = Rigid::identity(&1.0);
    }
    // Σ_S (2α − π) − Σ α + π, the largest over all odd sets: every positive term, mended to an odd number of them at least cost.
    let mut terms: Vec<f64> = angles.iter().map(|alpha| 2.0 * alpha - PI).collect();
    terms.sort_by(|a, b| b.total_cmp(a));
    let positive = terms.iter().filter(|term| **term > 0.0).count();
    let chosen: f64 = terms[..positive].iter().sum();
    let best = if positive % 2 == 1 {
        chosen
    } else {
        let more = terms.get(positive).map(|term| chosen + term);
        let fewer = (positive > 0).then(|| chosen - terms[positive - 1]);
        more.into_iter()
            .chain(fewer)
            .fold(f64::NEG_INFINITY, f64::max)
    };
    Some(best - angles.iter().sum::<f64>() + PI)
}

/// Where all corners are hinges about parallel axes, planar joints and slides across them: what the steps along them add up to (m), and
/// how far the axes' being not quite parallel may change that. Slides have any length, and have to be across to rounding.
fn offset(corners: &[Corner]) -> Option<(f64, f64)> {
    let first = corners.iter().position(|corner| corner.axes.is_some())?;
    let (mut along, mut reach, mut tilt, mut sense) = (0.0, 0.0, 0.0, 1.0);
    let mut behind = corners[first].axes?[1];
    let mut slides = false;
    for index in 1..=corners.len() {
        let corner = &corners[(first + index) % corners.len()];
        let step = &corner.step;
        along += sense * dot(&behind, &step.translation);
        reach += length(&step.translation);
        let here = step.rotate_back(&behind);
        let axis = match (corner.kind, corner.axes) {
            (JointKind::Revolute | JointKind::Planar, Some([axis, _])) => axis,
            (JointKind::Prismatic, _) if dot(&here, &corner.axis).abs() <= ACROSS => here,
            (JointKind::PlanarTranslation, _) if length(&cross(&here, &corner.axis)) <= ACROSS => {
                here
            }
            _ => return None,
        };
        slides |= corner.kind != JointKind::Revolute;
        let alpha = angle_between(&here, &axis);
        let off = alpha.min(PI - alpha);
        if off > if slides { ACROSS } else { PARALLEL } {
            return None;
        }
        tilt += off;
        if alpha > 0.5 * PI {
            sense = -sense;
        }
        behind = axis;
    }
    (!slides || tilt <= ACROSS).then_some((along, 2.0 * tilt * reach))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::super::samples::{Written, planar, ring};
    use super::super::super::{Arithmetic, Geometry};
    use super::*;
    use crate::Structure;
    use kutzbach_model::mechanism::Mechanism;
    use std::collections::BTreeSet;

    fn obstacle_of(mechanism: &Mechanism, held: &[usize]) -> Option<Obstacle> {
        let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
        let part = Structure::new(mechanism).parts.swap_remove(0);
        let held: BTreeSet<usize> = held.iter().copied().collect();
        let task = Task {
            mechanism,
            geometry: &geometry,
            part: &part,
            held: &held,
            tolerance: None,
        };
        proven_open(&task, 1e-12, |_| Some((1.0, 1.0))).map(|open| open.obstacle)
    }

    const STRETCHED: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.5, 0.0]];

    #[test]
    fn a_side_longer_than_all_the_others_is_proof() {
        let too_long = ring(&planar(&STRETCHED), [1.5, 0.0, 0.0], Written::Exactly);
        let Some(Obstacle::TooShort { apart, reach, .. }) = obstacle_of(&too_long, &[]) else {
            panic!("1 + 1 + 1.5 < 5");
        };
        assert!((apart - 5.0).abs() < 1e-12 && (reach - 3.5).abs() < 1e-12);
        // A side as long as the others together just closes.
        for gap in [0.0, -0.5, -1.5] {
            let closes = ring(&planar(&STRETCHED), [gap, 0.0, 0.0], Written::Exactly);
            assert_eq!(obstacle_of(&closes, &[]), None, "{gap}");
        }
        // With a hinge held, two of the sides are one.
        let bent = ring(&planar(&STRETCHED), [-0.25, 0.0, 0.0], Written::Exactly);
        assert_eq!(obstacle_of(&bent, &[]), None);
        assert!(matches!(
            obstacle_of(&bent, &[1, 2]),
            Some(Obstacle::TooShort { .. })
        ));
        assert_eq!(
            obstacle_of(&bent, &[0, 1, 2, 3]),
            Some(Obstacle::NothingMoves)
        );
    }

    #[test]
    fn parallel_axes_cannot_step_aside() {
        let aside = ring(&planar(&STRETCHED), [0.0, 0.0, 0.25], Written::Exactly);
        let Some(Obstacle::Offset(by)) = obstacle_of(&aside, &[]) else {
            panic!("0.25 m along the axes");
        };
        assert!((by - 0.25).abs() < 1e-12);
    }

    #[test]
    fn directions_that_close_on_no_sphere_are_proof() {
        use kutzbach_model::mechanism::JointKind::Revolute;
        // Four hinges through one point; with two of them held the other two have to find the angle between them unchanged.
        let places = [
            (Revolute, [0.0; 3], [0.0, 0.0, 1.0]),
            (Revolute, [0.0; 3], [0.0, 0.6, 0.8]),
            (Revolute, [0.0; 3], [0.8, 0.0, 0.6]),
            (Revolute, [0.0; 3], [0.0, -0.6, 0.8]),
        ];
        let mechanism = ring(&places, [0.0; 3], Written::Exactly);
        let mut geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let part = Structure::new(&mechanism).parts.swap_remove(0);
        let mut obstacle = |held: &[usize], turn: f64| {
            geometry.states[1] = geometry.displacements[1].at(&[turn]);
            let held: BTreeSet<usize> = held.iter().copied().collect();
            let task = Task {
                mechanism: &mechanism,
                geometry: &geometry,
                part: &part,
                held: &held,
                tolerance: None,
            };
            proven_open(&task, 1e-12, |_| Some((1.0, 1.0))).map(|open| open.obstacle)
        };
        assert_eq!(obstacle(&[1, 2], 0.0), None, "as drawn");
        assert_eq!(obstacle(&[1], 0.5), None, "three are free to follow");
        assert!(matches!(
            obstacle(&[1, 2], 0.5),
            Some(Obstacle::Directions(miss)) if miss > 0.01
        ));
    }
}
