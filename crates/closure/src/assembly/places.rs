//! Where links and joints stand at a pose, and how far that is from where they are drawn.

use super::super::displacement::JointState;
use super::super::geometry::{Geometry, relative};
use super::{JointPlace, LoopGap};
use kutzbach_math::matrix::Real;
use kutzbach_math::space::{Rigid, length, subtract};
use kutzbach_model::mechanism::{FreedomPart, Mechanism};
use petgraph::unionfind::UnionFind;

/// Where a joint stands, and how far that is from where it is drawn.
pub(super) fn place(
    geometry: &Geometry<f64>,
    joint: usize,
    states: &[JointState<f64>],
) -> JointPlace {
    let displacement = &geometry.displacements[joint];
    let drawn = &geometry.states[joint];
    let freedoms = displacement.kind().freedoms();
    let (mut turned, mut shifted) = (0.0f64, 0.0f64);
    for (increment, freedom) in displacement
        .increments(drawn, &states[joint])
        .iter()
        .zip(freedoms)
    {
        match freedom {
            FreedomPart::Translation => shifted = shifted.max(increment.abs()),
            FreedomPart::Rotation | FreedomPart::Screw => turned = turned.max(increment.abs()),
        }
    }
    JointPlace {
        joint,
        drawn: displacement.coordinates(drawn),
        values: displacement.coordinates(&states[joint]),
        turned,
        shifted,
    }
}

/// Link poses in the world along a spanning tree that prefers the file's tree joints; the ground keeps its place.
pub fn spanning_poses<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &[JointState<R>],
) -> (Vec<Rigid<R>>, Vec<bool>) {
    let joints = mechanism.joints();
    let mut pieces = UnionFind::<usize>::new(mechanism.links().len());
    let mut in_tree = vec![false; joints.len()];
    // By name, so that the order in the file changes nothing.
    let mut order: Vec<usize> = (0..joints.len()).collect();
    order.sort_by_key(|&index| (joints[index].closes_loop, &joints[index].name));
    for index in order {
        let joint = &joints[index];
        in_tree[index] = pieces.union(joint.predecessor.link.0, joint.successor.link.0);
    }
    let mut incident = vec![Vec::new(); mechanism.links().len()];
    for (index, joint) in joints
        .iter()
        .enumerate()
        .filter(|(index, _)| in_tree[*index])
    {
        incident[joint.predecessor.link.0].push(index);
        incident[joint.successor.link.0].push(index);
    }
    // Pieces that no joint connects to the ground stay where the file places them.
    let mut poses = geometry.home.clone();
    let mut done = vec![false; poses.len()];
    let ground_first = std::iter::once(mechanism.ground().0).chain(0..done.len());
    for start in ground_first {
        if done[start] {
            continue;
        }
        done[start] = true;
        let mut stack = vec![start];
        while let Some(link) = stack.pop() {
            for &index in &incident[link] {
                let joint = &joints[index];
                let [predecessor, successor] = &geometry.sides[index];
                let across = predecessor
                    .compose(&geometry.displacements[index].displacement(&states[index]))
                    .compose(&successor.inverse());
                let (other, step) = if joint.predecessor.link.0 == link {
                    (joint.successor.link.0, across)
                } else {
                    (joint.predecessor.link.0, across.inverse())
                };
                if !done[other] {
                    done[other] = true;
                    poses[other] = poses[link].compose(&step);
                    stack.push(other);
                }
            }
        }
    }
    (poses, in_tree)
}

/// The largest distance by which an end of a joint was moved from where it is drawn (m).
pub(super) fn moved(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    poses: &(Vec<Rigid<f64>>, Vec<bool>),
) -> f64 {
    let mut farthest = 0.0f64;
    for (index, joint) in mechanism.joints().iter().enumerate() {
        for (side, frame) in [&joint.predecessor, &joint.successor]
            .into_iter()
            .zip(&geometry.sides[index])
        {
            let before = geometry.home[side.link.0].apply(&frame.translation);
            let after = poses.0[side.link.0].apply(&frame.translation);
            farthest = farthest.max(length(&subtract(&after, &before)));
        }
    }
    farthest
}

/// How far the loops of the file are open, as drawn and at the poses.
pub(super) fn gaps(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    poses: &(Vec<Rigid<f64>>, Vec<bool>),
) -> Vec<LoopGap> {
    let miss = |poses: &[Rigid<f64>], index: usize, state: &JointState<f64>| {
        let wanted = relative(poses, &mechanism.joints()[index], &geometry.sides[index]);
        let off = geometry.displacements[index]
            .displacement(state)
            .inverse()
            .compose(&wanted);
        (length(&off.translation), length(&off.rotation_vector()))
    };
    mechanism
        .joints()
        .iter()
        .enumerate()
        .filter(|(_, joint)| joint.closes_loop)
        .map(|(index, _)| {
            let (position, angle) = miss(&geometry.home, index, &geometry.states[index]);
            let (left_position, left_angle) = miss(&poses.0, index, &states[index]);
            LoopGap {
                joint: index,
                position,
                angle,
                left_position,
                left_angle,
            }
        })
        .collect()
}
