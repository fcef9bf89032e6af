//! The topology of a mechanism, split into parts whose equations stand alone.

use super::part_names::part_names;
use crate::Part;
use kutzbach_model::graph::{ConstraintGraph, Cycle, CycleBasis, SpanningTree, fundamental_cycle};
use kutzbach_model::mechanism::Mechanism;

/// Up to this total length the tree's fundamental cycles are listed one by one; their total grows with the square of a
/// chain's length, that of the short cycles does not.
const LISTED_TREE_CYCLES: usize = 20_000;

/// The constraint graph of a mechanism, its tree, its cycles and its parts.
#[derive(Clone, Debug)]
pub struct Structure {
    /// Links as nodes, joints as edges, couplings as extra relations.
    pub graph: ConstraintGraph,
    /// The spanning tree of the file, rooted at the ground ([`SpanningTree::of_mechanism`]).
    pub tree: SpanningTree,
    /// The cycles shown to people: the tree's fundamental cycles, or the short ones where those would be too long.
    pub cycles: Vec<Cycle>,
    /// Whether [`cycles`](Self::cycles) are the tree's.
    pub cycles_are_fundamental: bool,
    /// Parts with loops or couplings.
    pub parts: Vec<Part>,
    /// What people call each part: what the names of its joints have in common, or the first of them.
    pub part_names: Vec<String>,
    /// Joints in no loop and no coupling: free to move on their own.
    pub free_joints: Vec<usize>,
    /// Connected pieces beside the ground's own: bodies that nothing holds.
    pub loose_pieces: usize,
}

impl Structure {
    /// Analyses the topology. Near-linear for mechanisms whose loops are short.
    #[must_use]
    pub fn new(mechanism: &Mechanism) -> Self {
        let graph = constraint_graph(mechanism);
        // Equations are made from short cycles; people are shown those that the file closes.
        let basis = CycleBasis::minimum(&graph, &SpanningTree::low_depth(&graph));
        let tree = SpanningTree::of_mechanism(&graph, mechanism);
        let blocks = graph.coupled_blocks();
        let mut part_of_edge = vec![usize::MAX; graph.edge_count()];
        let mut parts = Vec::new();
        let mut free_joints = Vec::new();
        for block in &blocks {
            // A block of one edge without coupling is a bridge: its joint closes nothing.
            if block.couplings.is_empty() && block.edges.len() == 1 {
                free_joints.extend(&block.edges);
                continue;
            }
            let mut joints = block.edges.clone();
            // By name, so that columns do not depend on the order of the file.
            joints.sort_by_key(|&edge| graph.edge_rank(edge));
            for &edge in &joints {
                part_of_edge[edge] = parts.len();
            }
            parts.push(Part {
                joints,
                cycles: Vec::new(),
                couplings: block.couplings.clone(),
            });
        }
        for cycle in &basis.cycles {
            let part = cycle
                .edges
                .first()
                .map_or(usize::MAX, |(edge, _)| part_of_edge[*edge]);
            if let Some(part) = parts.get_mut(part) {
                part.cycles.push(cycle.edges.clone());
            }
        }
        let part_names = part_names(mechanism, &graph, &parts);
        let total: usize = tree
            .chords()
            .iter()
            .map(|&chord| tree.fundamental_length(&graph, chord))
            .fold(0, usize::saturating_add);
        let cycles_are_fundamental = total <= LISTED_TREE_CYCLES;
        let cycles = if cycles_are_fundamental {
            tree.chords()
                .iter()
                .filter_map(|&chord| fundamental_cycle(&graph, &tree, chord))
                .collect()
        } else {
            basis.cycles
        };
        let loose_pieces = graph.components().len().saturating_sub(1);
        Self {
            graph,
            tree,
            cycles,
            cycles_are_fundamental,
            parts,
            part_names,
            free_joints,
            loose_pieces,
        }
    }
}

/// The spatial constraint graph of a mechanism; node and edge indices are link and joint indices.
#[must_use]
pub fn constraint_graph(mechanism: &Mechanism) -> ConstraintGraph {
    ConstraintGraph::of(mechanism)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::samples::{CRANK_ROCKER, Written, add_ring, four_bar, planar, sarrus_places};
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind, MechanismBuilder};

    fn two_rings() -> MechanismBuilder {
        let mut builder = MechanismBuilder::new("two");
        builder.link("ground");
        add_ring(
            &mut builder,
            "p",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        add_ring(
            &mut builder,
            "s",
            "ground",
            &sarrus_places(),
            [0.0; 3],
            Written::Exactly,
        );
        builder
    }

    #[test]
    fn blocks_that_share_a_link_only_stand_alone() {
        let structure = Structure::new(&two_rings().build().unwrap());
        assert_eq!(structure.parts.len(), 2);
        assert!(structure.free_joints.is_empty() && structure.loose_pieces == 0);
        assert_eq!(structure.cycles.len(), 2);
        assert!(structure.cycles_are_fundamental);
        let sizes: Vec<usize> = structure
            .parts
            .iter()
            .map(|part| part.joints.len())
            .collect();
        assert_eq!(sizes.iter().sum::<usize>(), 10);
        for part in &structure.parts {
            assert_eq!(part.cycles.len(), 1);
            assert_eq!(part.cycles[0].len(), part.joints.len());
        }
    }

    #[test]
    fn couplings_tie_blocks_together() {
        let mut builder = two_rings();
        builder.mimic("s_b", "p_a", Number::one(), Number::zero());
        let structure = Structure::new(&builder.build().unwrap());
        assert_eq!(structure.parts.len(), 1);
        assert_eq!(
            (
                structure.parts[0].cycles.len(),
                structure.parts[0].couplings.len()
            ),
            (2, 1)
        );
    }

    #[test]
    fn bridges_are_free_and_bodies_without_joints_loose() {
        let mut builder = two_rings();
        builder.link("hand").link("finger").link("stone");
        builder.joint(JointBuilder::tree(
            "wrist",
            JointKind::Spherical,
            "p2",
            "hand",
        ));
        builder.joint(JointBuilder::tree(
            "tip",
            JointKind::Fixed,
            "hand",
            "finger",
        ));
        builder.floating("drop", "ground", "stone", Frame::identity());
        let mechanism = builder.build().unwrap();
        let structure = Structure::new(&mechanism);
        let mut free: Vec<&str> = structure
            .free_joints
            .iter()
            .map(|j| mechanism.joints()[*j].name.as_str())
            .collect();
        free.sort_unstable();
        assert_eq!(free, ["tip", "wrist"]);
        assert_eq!(structure.loose_pieces, 1);
        // A gear makes a bridge part of something.
        let mut builder = two_rings();
        builder.link("hand");
        builder.joint(JointBuilder::tree(
            "wrist",
            JointKind::Revolute,
            "p2",
            "hand",
        ));
        builder.mimic("wrist", "p_a", Number::one(), Number::zero());
        let structure = Structure::new(&builder.build().unwrap());
        assert!(structure.free_joints.is_empty());
        assert_eq!(
            structure.parts.iter().map(|part| part.joints.len()).max(),
            Some(6)
        );
    }

    #[test]
    fn columns_follow_names_not_the_file() {
        let mechanism = four_bar();
        let joints = &Structure::new(&mechanism).parts[0].joints;
        let names: Vec<&str> = joints
            .iter()
            .map(|j| mechanism.joints()[*j].name.as_str())
            .collect();
        assert_eq!(names, ["r_a", "r_b", "r_c", "r_d"]);
    }

    #[test]
    fn the_graph_keeps_indices() {
        let mechanism = two_rings().build().unwrap();
        let graph = constraint_graph(&mechanism);
        assert_eq!(graph.edge_count(), mechanism.joints().len());
        for (index, joint) in mechanism.joints().iter().enumerate() {
            assert_eq!(graph.edge_name(index), joint.name);
        }
    }
}
