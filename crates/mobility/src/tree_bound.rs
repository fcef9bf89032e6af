//! How much a part can move at most, by its joints alone.
//!
//! Whatever the geometry: the velocities along a spanning tree of the joints say how every body of the part moves, and a
//! joint outside the tree follows, since its own screws are independent. So no tree has fewer freedoms than the part, and
//! the tree with fewest is the best bound: a door on three hinges has at most one.
//!
//! Cost: sorting the joints.

use kutzbach_closure::Part;
use kutzbach_model::mechanism::Mechanism;
use petgraph::unionfind::UnionFind;

/// The freedoms of the spanning tree that has fewest.
pub(super) fn most_by_joints(mechanism: &Mechanism, part: &Part) -> usize {
    let joints = mechanism.joints();
    let mut bodies = UnionFind::<usize>::new(mechanism.links().len());
    let mut order: Vec<usize> = part.joints.clone();
    let fixed = (0..joints.len()).filter(|&joint| joints[joint].freedom() == 0);
    order.extend(fixed);
    order.sort_by_key(|&joint| joints[joint].freedom());
    order
        .into_iter()
        .map(|joint| &joints[joint])
        .filter(|joint| bodies.union(joint.predecessor.link.0, joint.successor.link.0))
        .map(|joint| joint.freedom())
        .sum()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_closure::Structure;
    use kutzbach_format::read;

    fn bound(joints: &str) -> usize {
        let text = format!(
            r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/>{joints}</robot>"#
        );
        let mechanism = read(&text, "r.urdf", &[]).unwrap().mechanism;
        most_by_joints(&mechanism, &Structure::new(&mechanism).parts[0])
    }

    fn joint(name: &str, kind: &str, parent: &str, child: &str) -> String {
        format!(
            r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/></joint>"#
        )
    }

    fn closing(name: &str, kind: &str, one: &str, other: &str) -> String {
        format!(
            r#"<loop name="{name}" type="{kind}"><predecessor link="{one}"/><successor link="{other}"/><axis xyz="0 0 1"/></loop>"#
        )
    }

    #[test]
    fn parallel_joints_leave_what_the_narrowest_does() {
        let door = joint("h1", "continuous", "a", "b") + &closing("h2", "revolute", "a", "b");
        let knob = joint("k", "continuous", "b", "c") + &closing("s", "spherical", "b", "c");
        assert_eq!(bound(&(door.clone() + &knob)), 1, "each pair is a part");
        let lid = joint("ball", "spherical", "a", "b") + &closing("slide", "prismatic", "a", "b");
        assert_eq!(bound(&(lid + &joint("c", "fixed", "b", "c"))), 1);
    }

    #[test]
    fn a_ring_has_all_but_its_freest_joint() {
        let ring = joint("one", "continuous", "a", "b")
            + &joint("two", "spherical", "b", "c")
            + &closing("three", "cylindrical", "c", "a");
        assert_eq!(bound(&ring), 3);
    }

    #[test]
    fn what_is_fixed_together_is_one_body() {
        let ring = joint("one", "continuous", "a", "b")
            + &joint("two", "fixed", "b", "c")
            + &closing("three", "spherical", "c", "a");
        assert_eq!(bound(&ring), 1);
    }
}
