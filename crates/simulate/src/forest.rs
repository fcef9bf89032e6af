//! Which joints hold the tree and which close loops.
//!
//! Screws have to be in the tree, where the engine can tie travel to turn, and so have coupled joints, whose coordinates it
//! ties to one another; so bodies joined by these count as one node when the low-depth tree ([`SpanningTree`]) is grown from
//! the ground. Joints that no multibody can hold are left out: what hangs on those alone floats, and they hold it like loops.

use super::WorldError;
use super::elementary::{Elementary, Intermediate, TakenApart};
use kutzbach_closure::Rigid;
use kutzbach_model::graph::{ConstraintGraph, EdgeSpec, NodeSpec, SpanningTree};

/// One joint of the forest, seen from its root.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Branch {
    /// Index of the elementary joint.
    pub joint: usize,
    /// The body nearer to the root.
    pub parent: usize,
    /// The body that the joint holds.
    pub child: usize,
}

/// A spanning forest, branches ordered so that every parent comes before its children, and the joints left over.
#[derive(Clone, Debug, Default)]
pub(super) struct Forest {
    pub branches: Vec<Branch>,
    pub chords: Vec<usize>,
}

impl Forest {
    /// Grows the forest over bodies named `names`, of which the first `links` are links; `coupled` tells of the joints of the
    /// mechanism.
    pub fn grow(
        ground: usize,
        names: &[String],
        links: usize,
        joints: &[Elementary],
        joint_names: &[String],
        coupled: impl Fn(usize) -> bool,
    ) -> Result<Self, WorldError> {
        let mut clusters = Clusters((0..names.len()).collect());
        let mut in_tree = vec![false; joints.len()];
        let mut by_name: Vec<usize> = (0..joints.len()).collect();
        by_name.sort_by(|&a, &b| joint_names[a].cmp(&joint_names[b]));
        let is_screw = |joint: &Elementary| joint.pitch.is_some();
        let is_coupled =
            |joint: &Elementary| joint.reducible && joint.pitch.is_none() && coupled(joint.joint);
        let screws = by_name.iter().filter(|&&index| is_screw(&joints[index]));
        let others = by_name.iter().filter(|&&index| is_coupled(&joints[index]));
        for &index in screws.chain(others) {
            let [a, b] = joints[index].bodies;
            in_tree[index] = clusters.merge(a, b);
        }
        let cluster: Vec<usize> = (0..names.len()).map(|body| clusters.find(body)).collect();
        let mut node_of = vec![usize::MAX; names.len()];
        let mut nodes = Vec::new();
        for (body, &of) in cluster.iter().enumerate() {
            if of == body {
                node_of[body] = nodes.len();
                nodes.push(NodeSpec {
                    name: names[body].clone(),
                });
            }
        }
        let mut edges = Vec::new();
        let mut joint_of_edge = Vec::new();
        for (index, joint) in joints.iter().enumerate() {
            let ends = joint.bodies.map(|body| node_of[cluster[body]]);
            if joint.reducible && joint.pitch.is_none() && ends[0] != ends[1] {
                joint_of_edge.push(index);
                edges.push(EdgeSpec {
                    name: joint_names[index].clone(),
                    ends,
                    freedom: joint.free.count_ones() as usize,
                    class: String::new(),
                });
            }
        }
        let ground_node = node_of[cluster[ground]];
        let graph = ConstraintGraph::try_new(ground_node, nodes, edges, vec![])
            .map_err(|error| WorldError::Refused(error.to_string()))?;
        let tree = SpanningTree::root_at(&graph, ground_node);
        for &edge in tree.edges() {
            in_tree[joint_of_edge[edge]] = true;
        }
        // The ground first, then a link of each other piece: the busiest one, ties by name.
        let mut degree = vec![0usize; names.len()];
        for joint in joints {
            joint.bodies.iter().for_each(|&body| degree[body] += 1);
        }
        let mut roots = vec![ground];
        for &root in tree.roots().iter().skip(1) {
            let members = (0..links).filter(|&link| node_of[cluster[link]] == root);
            roots.extend(members.max_by_key(|&l| (degree[l], std::cmp::Reverse(&names[l]))));
        }
        // A piece whose root cluster is an intermediate body alone is reached from any link of it.
        roots.extend(0..names.len());
        Ok(Self::orient(
            names.len(),
            joints,
            &by_name,
            &in_tree,
            &roots,
        ))
    }

    fn orient(
        bodies: usize,
        joints: &[Elementary],
        by_name: &[usize],
        in_tree: &[bool],
        roots: &[usize],
    ) -> Self {
        let mut incident = vec![Vec::new(); bodies];
        for &index in by_name {
            if in_tree[index] {
                let [a, b] = joints[index].bodies;
                incident[a].push((index, b));
                incident[b].push((index, a));
            }
        }
        let mut forest = Self {
            branches: Vec::new(),
            chords: by_name.iter().copied().filter(|&i| !in_tree[i]).collect(),
        };
        let mut reached = vec![false; bodies];
        for &root in roots {
            if std::mem::replace(&mut reached[root], true) {
                continue;
            }
            let mut waiting = std::collections::VecDeque::from([root]);
            while let Some(parent) = waiting.pop_front() {
                for &(joint, child) in &incident[parent] {
                    if !std::mem::replace(&mut reached[child], true) {
                        forest.branches.push(Branch {
                            joint,
                            parent,
                            child,
                        });
                        waiting.push_back(child);
                    }
                }
            }
        }
        forest
    }
}

struct Clusters(Vec<usize>);

impl Clusters {
    fn find(&mut self, mut body: usize) -> usize {
        while self.0[body] != body {
            self.0[body] = self.0[self.0[body]];
            body = self.0[body];
        }
        body
    }

    /// The smaller index stays the cluster's own, so that links name the clusters.
    fn merge(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b)] = a.min(b);
        a != b
    }
}

/// A screw that closes a loop moves a small body instead, which is welded to the second body by impulses.
pub(super) fn weld_chord_screws(apart: &mut TakenApart, forest: &mut Forest, poses: &[Rigid<f64>]) {
    for chord in &mut forest.chords {
        let screw = apart.joints[*chord].clone();
        if screw.pitch.is_none() {
            continue;
        }
        let small = poses.len() + apart.intermediates.len();
        // Both ends of a screw are links: only joints without a screw have intermediate bodies of their own.
        let pose = poses[screw.bodies[0]].compose(&screw.frames[0]);
        apart.intermediates.push(Intermediate {
            joint: screw.joint,
            pose,
            length: 0.0,
            links: screw.bodies,
        });
        let here = || Rigid::identity(&0.0);
        let weld = Elementary {
            bodies: [small, screw.bodies[1]],
            frames: [here(), screw.frames[1].clone()],
            free: 0,
            pitch: None,
            ..screw.clone()
        };
        forest.branches.push(Branch {
            joint: *chord,
            parent: screw.bodies[0],
            child: small,
        });
        apart.joints[*chord] = Elementary {
            bodies: [screw.bodies[0], small],
            frames: [screw.frames[0].clone(), here()],
            ..screw
        };
        *chord = apart.joints.len();
        apart.joints.push(weld);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn joint(index: usize, bodies: [usize; 2], pitch: Option<f64>) -> Elementary {
        let here = || Rigid::identity(&0.0);
        Elementary {
            joint: index,
            bodies,
            frames: [here(), here()],
            free: 8,
            pitch,
            reducible: true,
        }
    }

    fn names(prefix: &str, count: usize) -> Vec<String> {
        (0..count).map(|i| format!("{prefix}{i}")).collect()
    }

    fn grown(ground: usize, bodies: usize, joints: &[Elementary]) -> Forest {
        grown_with(ground, bodies, joints, &[])
    }

    fn grown_with(
        ground: usize,
        bodies: usize,
        joints: &[Elementary],
        coupled: &[usize],
    ) -> Forest {
        let names_of_joints = names("j", joints.len());
        Forest::grow(
            ground,
            &names("b", bodies),
            bodies,
            joints,
            &names_of_joints,
            |joint| coupled.contains(&joint),
        )
        .unwrap()
    }

    #[test]
    fn screws_are_in_the_tree_and_parents_come_first() {
        // A ring 0 – 1 – 2 – 3 – 0 whose screw a tree by name alone would leave out.
        let joints = [
            joint(0, [0, 1], None),
            joint(1, [1, 2], None),
            joint(2, [3, 2], Some(0.1)),
            joint(3, [0, 3], None),
        ];
        for ground in 0..4 {
            let forest = grown(ground, 4, &joints);
            assert_eq!(forest.branches.len(), 3);
            assert_eq!(forest.chords.len(), 1);
            assert!(!forest.chords.contains(&2));
            let mut reached = vec![ground];
            for branch in &forest.branches {
                assert!(reached.contains(&branch.parent));
                assert!(!reached.contains(&branch.child));
                reached.push(branch.child);
            }
        }
    }

    #[test]
    fn coupled_joints_are_in_the_tree_where_they_close_no_loop_together() {
        let ring: Vec<Elementary> = (0..4).map(|i| joint(i, [i, (i + 1) % 4], None)).collect();
        for closing in 0..4 {
            let coupled: Vec<usize> = (0..4).filter(|joint| *joint != closing).collect();
            assert_eq!(grown_with(0, 4, &ring, &coupled).chords, [closing]);
        }
        assert_eq!(grown_with(0, 4, &ring, &[0, 1, 2, 3]).chords.len(), 1);
        let mut held = joint(0, [0, 1], None);
        held.reducible = false;
        assert_eq!(grown_with(0, 2, &[held], &[0]).chords, [0]);
    }

    #[test]
    fn what_no_multibody_can_hold_is_left_to_impulses() {
        let mut only = joint(0, [1, 0], None);
        only.reducible = false;
        let forest = grown(0, 3, &[only, joint(1, [1, 2], None)]);
        assert_eq!(forest.chords, [0]);
        assert_eq!(forest.branches.len(), 1);
    }

    #[test]
    fn of_two_screws_side_by_side_one_is_welded() {
        let mut apart = TakenApart {
            joints: vec![joint(0, [0, 1], Some(0.1)), joint(1, [0, 1], Some(0.1))],
            ..TakenApart::default()
        };
        let mut forest = grown(0, 2, &apart.joints);
        assert_eq!(forest.chords, [1]);
        let poses = vec![Rigid::identity(&0.0); 2];
        weld_chord_screws(&mut apart, &mut forest, &poses);
        assert_eq!(apart.intermediates.len(), 1);
        assert_eq!(apart.joints[1].bodies, [0, 2]);
        let weld = &apart.joints[forest.chords[0]];
        assert_eq!((weld.bodies, weld.free, weld.pitch), ([2, 1], 0, None));
        assert_eq!(forest.branches.last().unwrap().child, 2);
    }
}
