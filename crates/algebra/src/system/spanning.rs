//! Which joints get variables: spanning trees and the joints that close them.

use super::{Formulation, SystemOptions};
use kutzbach_model::graph::{ConstraintGraph, Cycle, CycleBasis, SpanningTree, fundamental_cycles};
use kutzbach_model::mechanism::{JointKind, Mechanism};
use petgraph::unionfind::UnionFind;

/// The graph of a mechanism and the basic cycles whose equations are written, all of whose joints are asked about.
pub(super) fn basic_cycles(
    mechanism: &Mechanism,
    options: &SystemOptions,
) -> (ConstraintGraph, Vec<Cycle>) {
    let graph = ConstraintGraph::of(mechanism);
    let tree = SpanningTree::low_depth(&graph);
    let mut cycles: Vec<Cycle> = match options.formulation {
        Formulation::Tree => lightest_tree_cycles(&graph, &tree, mechanism),
        _ if options.shortest_cycles => CycleBasis::minimum(&graph, &tree).cycles,
        _ => fundamental_cycles(&graph, &tree),
    };
    cycles.retain(|c| c.edges.iter().all(|(edge, _)| options.includes(*edge)));
    (graph, cycles)
}

/// The fundamental cycles of the spanning tree whose joints have the fewest variables; where that leaves a choice, of one
/// that has as much of the low-depth tree as possible (Kruskal 1956).
fn lightest_tree_cycles(
    graph: &ConstraintGraph,
    low_depth: &SpanningTree,
    mechanism: &Mechanism,
) -> Vec<Cycle> {
    let coupled = coupled_joints(mechanism);
    let mut order: Vec<usize> = graph.edges_by_name().to_vec();
    order.sort_by_key(|&edge| {
        let kind = mechanism.joints()[edge].kind;
        // A coupled joint needs its variables.
        let weight = match coupled.contains(&edge) {
            true => 0,
            false => variable_count(kind),
        };
        (weight, !low_depth.contains(edge))
    });
    let mut joined = UnionFind::<usize>::new(graph.node_count());
    let mut kept = vec![false; graph.edge_count()];
    for &edge in &order {
        let [a, b] = graph.edge(edge).ends;
        kept[edge] = joined.union(a, b);
    }
    let specs = |keep: bool| {
        graph
            .edges_by_name()
            .iter()
            .copied()
            .filter(move |&edge| kept[edge] == keep)
    };
    cycles_of_tree(graph, specs.clone()(true).collect(), specs(false).collect())
}

/// Joints that couplings speak of, which need their variables.
fn coupled_joints(mechanism: &Mechanism) -> Vec<usize> {
    let terms = mechanism.couplings().iter().flat_map(|c| &c.terms);
    terms.map(|term| term.joint.0).collect()
}

fn variable_count(kind: JointKind) -> usize {
    match kind {
        JointKind::Fixed => 0,
        JointKind::Prismatic => 1,
        JointKind::Revolute | JointKind::PlanarTranslation => 2,
        JointKind::Screw | JointKind::Cylindrical | JointKind::Translational => 3,
        JointKind::Universal | JointKind::Planar | JointKind::Spherical => 4,
        JointKind::TranslatingScrew | JointKind::Schoenflies | JointKind::PointOnLine => 5,
        JointKind::LineOnPlane | JointKind::PointOnPlane => 6,
        JointKind::Distance => 7,
    }
}

/// One cycle per chord: the chord and the way through the tree.
fn cycles_of_tree(graph: &ConstraintGraph, tree: Vec<usize>, chords: Vec<usize>) -> Vec<Cycle> {
    let mut incident = vec![Vec::new(); graph.node_count()];
    for edge in tree {
        let [a, b] = graph.edge(edge).ends;
        incident[a].push((edge, b));
        incident[b].push((edge, a));
    }
    chords
        .into_iter()
        .filter_map(|chord| {
            let [from, to] = graph.edge(chord).ends;
            // Breadth first from one end to the other.
            let mut came = vec![None; graph.node_count()];
            let mut queue = std::collections::VecDeque::from([from]);
            while let Some(node) = queue.pop_front() {
                for &(edge, next) in &incident[node] {
                    if next != from && came[next].is_none() {
                        came[next] = Some((edge, node));
                        queue.push_back(next);
                    }
                }
            }
            let mut walk = vec![chord];
            let mut at = to;
            while at != from {
                let (edge, node) = came[at]?;
                walk.push(edge);
                at = node;
            }
            Cycle::from_walk(graph, &walk)
        })
        .collect()
}

/// For every cycle the joint that gets no variables: in the tree form the one that only this cycle passes and that saves
/// most, otherwise a distance joint that only this cycle passes.
pub(super) fn implicit_joints(
    mechanism: &Mechanism,
    cycles: &[Cycle],
    formulation: Formulation,
) -> Vec<Option<usize>> {
    let mut passed = vec![0; mechanism.joints().len()];
    for (edge, _) in cycles.iter().flat_map(|c| &c.edges) {
        passed[*edge] += 1;
    }
    let coupled = coupled_joints(mechanism);
    cycles
        .iter()
        .map(|cycle| {
            let own = cycle.edges.iter().map(|(edge, _)| *edge);
            let own = own.filter(|&edge| passed[edge] == 1 && !coupled.contains(&edge));
            let kind = |edge: usize| mechanism.joints()[edge].kind;
            match formulation {
                Formulation::Tree => own.max_by_key(|&edge| {
                    let name = std::cmp::Reverse(&mechanism.joints()[edge].name);
                    (variable_count(kind(edge)), name)
                }),
                _ => own
                    .filter(|&edge| kind(edge) == JointKind::Distance)
                    .min_by_key(|&edge| &mechanism.joints()[edge].name),
            }
        })
        .collect()
}
