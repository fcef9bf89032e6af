//! Which joints hold the tree and which close loops.
//!
//! Screws have to be in the tree, where the engine can tie travel to turn; so bodies joined by screws count as one node
//! when the low-depth tree ([`SpanningTree`]) is grown from the ground. Joints that no multibody can hold are left out:
//! what hangs on those alone floats, and they hold it like loops.

use super::WorldError;
use super::elementary::Elementary;
use crate::graph::{ConstraintGraph, EdgeSpec, NodeSpec, SpanningTree};

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
    /// Grows the forest over bodies named `names`, of which the first `links` are links.
    pub fn grow(
        ground: usize,
        names: &[String],
        links: usize,
        joints: &[Elementary],
        joint_names: &[String],
    ) -> Result<Self, WorldError> {
        let mut clusters = Clusters((0..names.len()).collect());
        let mut in_tree = vec![false; joints.len()];
        let mut by_name: Vec<usize> = (0..joints.len()).collect();
        by_name.sort_by(|&a, &b| joint_names[a].cmp(&joint_names[b]));
        for &index in &by_name {
            let joint = &joints[index];
            if joint.pitch.is_some() {
                in_tree[index] = clusters.merge(joint.bodies[0], joint.bodies[1]);
            }
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
