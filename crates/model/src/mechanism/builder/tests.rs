//! The builder as a whole.

#![allow(clippy::unwrap_used)]

use super::samples::{fault, help, hinge, hinges, links};
use super::{JointBuilder, MechanismBuilder};
use crate::mechanism::{Expectation, Frame, JointKind, LinkId, Mechanism, Placement};
use kutzbach_math::number::Number;
use proptest::prelude::*;

#[test]
fn a_mechanism_has_a_link() {
    let empty = MechanismBuilder::new("empty");
    assert_eq!(fault(empty.clone()), "the mechanism: there is no link");
    assert_eq!(
        help(empty),
        "a mechanism has at least one <link name=\"...\"/>"
    );
    let one = links(&["a"]).build().unwrap();
    assert_eq!(one.placement_order(), [LinkId(0)]);
    assert_eq!(one.link(LinkId(0)).placement, Placement::World);
}

#[test]
fn the_ground_is_the_root_unless_named() {
    assert_eq!(hinges().build().unwrap().ground(), LinkId(0));
    let mut builder = hinges();
    builder.ground("c");
    let mechanism = builder.build().unwrap();
    assert_eq!(mechanism.ground(), LinkId(2));
    // Home poses are still counted from the root.
    assert_eq!(mechanism.link(LinkId(0)).placement, Placement::World);

    let mut builder = hinges();
    builder.ground("d");
    assert_eq!(
        fault(builder.clone()),
        "the ground: there is no link named `d`"
    );
    assert_eq!(help(builder), "did you mean `a`?");
}

/// ```text
/// l0 --j1-- l1 --j2-- l2 -- ... : hinges; every joint but the first follows the one before, every third pair of
/// neighbours is geared, every joint has a position and is named in the expectation.
/// ```
fn long_chain(links: usize) -> MechanismBuilder {
    let mut builder = MechanismBuilder::new("long");
    let mut positions = Vec::new();
    let mut locked = Vec::new();
    for index in 0..links {
        let (link, joint) = (format!("l{index}"), format!("j{index}"));
        builder.link(&link);
        if index == 0 {
            continue;
        }
        let previous = format!("l{}", index - 1);
        builder.joint(hinge(&joint, &previous, &link));
        if index > 1 {
            let leader = format!("j{}", index - 1);
            builder.mimic(&joint, &leader, Number::one(), Number::zero());
        }
        if index % 3 == 2 {
            let before = format!("l{}", index - 2);
            let (name, ends) = (format!("g{index}"), [&before[..], &link]);
            builder.coupling_on(Some(&previous), &name, ends, Number::one());
        }
        positions.push((joint.clone(), vec![Number::zero()]));
        locked.push(format!("{joint}.rot"));
    }
    builder.configuration("straight", positions);
    builder.expect(Expectation {
        locked: Some(locked),
        ..Expectation::default()
    });
    builder
}

/// With any rule that looks at all joints for each joint, or walks to the root for each gear, this takes minutes.
#[test]
fn a_hundred_thousand_joints_are_checked_in_a_moment() {
    let links = 100_001;
    let mechanism = long_chain(links).build().unwrap();
    assert_eq!(mechanism.joints().len(), links - 1);
    assert_eq!(mechanism.placement_order().len(), links);
    assert_eq!(mechanism.placement_order()[links - 1], LinkId(links - 1));
    let longest = mechanism.couplings().iter().map(|c| c.terms.len()).max();
    assert_eq!(longest, Some(2));
}

/// A plan of a tree: per link after the first an earlier link to hang from and a way to hang, all links in an order of
/// their own; and pairs of links that loops join.
#[derive(Clone, Debug)]
struct Plan {
    parents: Vec<(prop::sample::Index, Way)>,
    order: Vec<usize>,
    loops: Vec<(prop::sample::Index, prop::sample::Index, JointKind)>,
}

#[derive(Clone, Copy, Debug)]
enum Way {
    Joint(JointKind),
    Floating,
}

fn kind() -> impl Strategy<Value = JointKind> {
    prop::sample::select(JointKind::ALL.to_vec())
}

fn plan() -> impl Strategy<Value = Plan> {
    let way = prop_oneof![8 => kind().prop_map(Way::Joint), 1 => Just(Way::Floating)];
    let index = any::<prop::sample::Index>;
    prop::collection::vec((index(), way), 0..40).prop_flat_map(move |parents| {
        let order = Just((0..=parents.len()).collect::<Vec<usize>>()).prop_shuffle();
        let loops = prop::collection::vec((index(), index(), kind()), 0..6);
        (Just(parents), order, loops).prop_map(|(parents, order, loops)| Plan {
            parents,
            order,
            loops,
        })
    })
}

fn described(joint: JointBuilder, kind: JointKind) -> JointBuilder {
    match kind {
        JointKind::Screw | JointKind::TranslatingScrew => joint.lead(Number::one()),
        JointKind::Distance => joint.distance(Number::one()),
        _ => joint,
    }
}

fn build(plan: &Plan) -> Mechanism {
    let mut builder = MechanismBuilder::new("random");
    let name = |index: usize| format!("l{index}");
    for &index in &plan.order {
        builder.link(&name(index));
    }
    for (index, (parent, way)) in plan.parents.iter().enumerate() {
        let (child, parent) = (name(index + 1), name(parent.index(index + 1)));
        let joint = format!("to_{child}");
        match way {
            Way::Floating => builder.floating(&joint, &parent, &child, Frame::identity()),
            Way::Joint(kind) => builder.joint(described(
                JointBuilder::tree(&joint, *kind, &parent, &child),
                *kind,
            )),
        };
    }
    let links = plan.order.len();
    for (index, (a, b, kind)) in plan.loops.iter().enumerate() {
        let (a, b) = (a.index(links), b.index(links));
        if a != b {
            let joint = format!("loop_{index}");
            builder.joint(described(
                JointBuilder::closing(&joint, *kind, &name(a), &name(b)),
                *kind,
            ));
        }
    }
    builder.build().unwrap()
}

proptest! {
    /// Whatever the shape of the tree and the order in which links and joints are told.
    #[test]
    fn a_tree_with_loops_always_builds_and_is_placed_from_its_root(plan in plan()) {
        let mechanism = build(&plan);
        let links = mechanism.links().len();
        prop_assert_eq!(links, plan.order.len());
        let root = mechanism.link_named("l0").unwrap();
        prop_assert_eq!(mechanism.ground(), root);

        let order = mechanism.placement_order();
        prop_assert_eq!(order.len(), links);
        let mut place = vec![usize::MAX; links];
        for (position, link) in order.iter().enumerate() {
            prop_assert_eq!(place[link.0], usize::MAX, "no link comes twice");
            place[link.0] = position;
        }
        for (index, link) in mechanism.links().iter().enumerate() {
            match &link.placement {
                Placement::World => prop_assert_eq!(LinkId(index), root),
                Placement::Joint(id) => {
                    let joint = mechanism.joint(*id);
                    prop_assert!(!joint.closes_loop);
                    prop_assert_eq!(joint.successor.link, LinkId(index));
                    prop_assert!(place[joint.predecessor.link.0] < place[index]);
                }
                Placement::Floating { parent, .. } => prop_assert!(place[parent.0] < place[index]),
            }
        }
        let tree = mechanism.joints().iter().filter(|j| !j.closes_loop).count();
        let floating = plan.parents.iter().filter(|(_, way)| matches!(way, Way::Floating)).count();
        prop_assert_eq!(tree + floating + 1, links);

        let offsets = mechanism.variable_offsets();
        prop_assert_eq!(offsets.last().copied(), Some(mechanism.freedom()));
        for (joint, pair) in mechanism.joints().iter().zip(offsets.windows(2)) {
            prop_assert_eq!(pair[1] - pair[0], joint.freedom());
        }
    }
}
