//! Mechanisms changed in ways that change the answer in a known way: two in one, joints taken apart, parts added.
//!
//! Frames must be parallel at home, as they are in the reference mechanisms.

use crate::support::rewrite::{Draft, DraftJoint, End};
use kutzbach::mechanism::{Direction, Frame, JointKind};
use kutzbach::number::Number;

fn end(link: &str, frame: Frame) -> End {
    End {
        link: link.to_owned(),
        frame,
    }
}

fn joint(name: &str, kind: JointKind, ends: [End; 2], axis: Direction) -> DraftJoint {
    DraftJoint {
        name: name.to_owned(),
        kind,
        ends,
        axis: axis.clone(),
        axis2: axis,
        lead: None,
        distance: None,
        closes_loop: false,
    }
}

fn along(x: i64, y: i64, z: i64) -> Direction {
    Direction([x, y, z].map(Number::integer))
}

/// Every link and joint under a new name.
#[must_use]
fn renamed(mut draft: Draft, suffix: &str) -> Draft {
    let change = |name: &mut String| name.push_str(suffix);
    draft.links.iter_mut().for_each(change);
    change(&mut draft.ground);
    for joint in &mut draft.joints {
        change(&mut joint.name);
        for end in &mut joint.ends {
            change(&mut end.link);
        }
    }
    for placed in &mut draft.placed {
        change(&mut placed.parent);
        change(&mut placed.child);
    }
    draft
}

/// The second mechanism with one of its links made one with a link of the first. They share no loop, so that all motions
/// are pairs of motions: freedoms add, branches multiply.
#[must_use]
pub fn mounted(mut first: Draft, carrier: &str, second: Draft) -> Draft {
    assert!(first.poses.is_empty() && second.poses.is_empty());
    assert!(second.mimics.is_empty() && second.ratios.is_empty() && second.sums.is_empty());
    let mut second = renamed(second, "_2");
    let root = second.ground.clone();
    let change = |name: &mut String| {
        if *name == root {
            carrier.clone_into(name);
        }
    };
    for joint in &mut second.joints {
        joint.ends.iter_mut().for_each(|end| change(&mut end.link));
    }
    for placed in &mut second.placed {
        change(&mut placed.parent);
    }
    assert!(second.placed.iter().all(|placed| placed.child != root));
    first
        .links
        .extend(second.links.into_iter().filter(|link| *link != root));
    first.joints.extend(second.joints);
    first.placed.extend(second.placed);
    first
}

/// A pendulum on a link: one freedom more on every branch.
#[must_use]
pub fn with_pendulum(mut draft: Draft, carrier: &str) -> Draft {
    draft.links.push("pendulum".to_owned());
    draft.joints.push(joint(
        "pendulum_hinge",
        JointKind::Revolute,
        [
            end(carrier, Frame::identity()),
            end("pendulum", Frame::identity()),
        ],
        along(1, 2, 2),
    ));
    draft
}

/// A rod with a ball at either end, both in one link: it spins, and asks nothing of the rest.
#[must_use]
pub fn with_idle_rod(mut draft: Draft, carrier: &str) -> Draft {
    let far = || Frame::at([2, 1, 2].map(Number::integer));
    draft.links.push("idle_rod".to_owned());
    for (name, frame, closes_loop) in [
        ("near_ball", Frame::identity as fn() -> Frame, false),
        ("far_ball", far, true),
    ] {
        let ends = [end(carrier, frame()), end("idle_rod", frame())];
        let mut ball = joint(name, JointKind::Spherical, ends, along(1, 0, 0));
        ball.closes_loop = closes_loop;
        draft.joints.push(ball);
    }
    draft
}

/// Every hinge twice, as a door has two on one line: the second asks for nothing new.
#[must_use]
pub fn with_double_hinges(mut draft: Draft) -> Draft {
    let doubled: Vec<DraftJoint> = draft
        .joints
        .iter()
        .filter(|joint| joint.kind == JointKind::Revolute)
        .map(|joint| {
            let mut second = joint.clone();
            second.name.push_str("_again");
            second.closes_loop = true;
            for end in &mut second.ends {
                for (coordinate, step) in end.frame.position.iter_mut().zip(&joint.axis.0) {
                    *coordinate = &*coordinate + step;
                }
            }
            second
        })
        .collect();
    draft.joints.extend(doubled);
    draft
}

/// Every tree joint with a rigid piece of its successor as a link of its own.
#[must_use]
pub fn with_links_cut(mut draft: Draft) -> Draft {
    let mut welds = Vec::new();
    for joint in draft.joints.iter_mut().filter(|joint| !joint.closes_loop) {
        let whole = joint.ends[1].link.clone();
        let piece = format!("{whole}_piece");
        joint.ends[1].link.clone_from(&piece);
        welds.push((piece, whole));
    }
    for (piece, whole) in welds {
        let ends = [
            end(&piece, Frame::identity()),
            end(&whole, Frame::identity()),
        ];
        let weld = joint(
            &format!("{whole}_weld"),
            JointKind::Fixed,
            ends,
            along(1, 0, 0),
        );
        draft.links.push(piece);
        draft.joints.push(weld);
    }
    draft
}

/// Balls, sleeves, universal joints and plane contacts taken apart into hinges and slides. The chain reaches the same
/// relative poses, one to one near home, so that the poses of the whole are the same near home. `None` where nothing is
/// taken apart.
#[must_use]
pub fn with_simple_joints(mut draft: Draft) -> Option<Draft> {
    use JointKind::{Cylindrical, Planar, Prismatic, Revolute, Spherical, Universal};
    let mut joints = Vec::new();
    let before = draft.joints.len();
    for old in std::mem::take(&mut draft.joints) {
        let chain = match old.kind {
            Spherical => vec![
                (Revolute, along(1, 0, 0)),
                (Revolute, along(0, 1, 0)),
                (Revolute, along(0, 0, 1)),
            ],
            Cylindrical => vec![(Revolute, old.axis.clone()), (Prismatic, old.axis.clone())],
            Universal => vec![(Revolute, old.axis.clone()), (Revolute, old.axis2.clone())],
            Planar => {
                let [u, v] = across(&old.axis);
                vec![(Prismatic, u), (Prismatic, v), (Revolute, old.axis.clone())]
            }
            _ => {
                joints.push(old);
                continue;
            }
        };
        let count = chain.len();
        let mut from = old.ends[0].clone();
        for (index, (kind, axis)) in chain.into_iter().enumerate() {
            let last = index + 1 == count;
            let to = if last {
                old.ends[1].clone()
            } else {
                let between = format!("{}_between_{index}", old.name);
                draft.links.push(between.clone());
                end(&between, Frame::identity())
            };
            let mut simple = joint(
                &format!("{}_{index}", old.name),
                kind,
                [from.clone(), to.clone()],
                axis,
            );
            simple.closes_loop = last && old.closes_loop;
            joints.push(simple);
            from = to;
        }
    }
    draft.joints = joints;
    (draft.joints.len() > before).then_some(draft)
}

/// Two directions across another.
fn across(axis: &Direction) -> [Direction; 2] {
    let cross = |a: &[Number; 3], b: &[Number; 3]| {
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &(&a[i] * &b[j]) - &(&a[j] * &b[i]))
    };
    let smallest = (0..3)
        .min_by(|&i, &j| {
            let size = |k: usize| axis.0[k].value().abs();
            size(i).total_cmp(&size(j))
        })
        .unwrap_or(0);
    let mut other = [0, 0, 0].map(Number::integer);
    other[smallest] = Number::integer(1);
    let first = cross(&axis.0, &other);
    let second = cross(&axis.0, &first);
    [Direction(first), Direction(second)]
}
