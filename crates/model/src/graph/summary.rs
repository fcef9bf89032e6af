//! What there is to say about a graph, in words and names: for reports, JSON and the terminal.

use std::fmt;

use serde::Serialize;

use super::constraint_graph::ConstraintGraph;
use super::cycle_basis::{BasisKind, CycleBasis};
use super::cycles::{Cycle, fundamental_cycles, overlap_work, overlaps};
use super::spanning_tree::SpanningTree;

/// Cycles are spelled out only while their edges together, and their pairs sharing an edge, stay below this: the
/// fundamental cycles of a long chain would take more room than anyone reads.
const LISTED: usize = 200_000;

/// The graph, its tree and its cycles by name. Serializes to JSON; displays as text.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct GraphSummary {
    /// Number of links.
    pub links: usize,
    /// Number of joints.
    pub joints: usize,
    /// Number of independent loops.
    pub loops: usize,
    /// Number of connected components.
    pub components: usize,
    /// Name of the fixed link.
    pub ground: String,
    /// The biconnected blocks.
    pub blocks: Vec<BlockSummary>,
    /// Where the tree is the low-depth one and not that of the file, its bounds.
    pub low_depth: Option<LowDepth>,
    /// Height of the spanning tree.
    pub tree_height: usize,
    /// The spanning tree, every link below its parent, depth first.
    pub tree: Vec<TreeNode>,
    /// Names of the joints outside the tree.
    pub chords: Vec<String>,
    /// The cycles closed by the chords, one each, in the order of `chords`.
    pub fundamental_cycles: CyclesSummary,
    /// The cycle basis of least total length.
    pub minimum_basis: CyclesSummary,
    /// Whether `minimum_basis` is minimal in every block.
    pub basis_kind: BasisKind,
}

/// What is known of a low-depth tree beforehand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct LowDepth {
    /// Most joints of a cycle of it: 2 height + 1.
    pub longest_cycle: usize,
    /// V E² + E V² for V links and E joints: what the procedure of Ruiz (1994, section 5.4.3) takes at most for the tree and
    /// its cycles.
    pub steps: u128,
}

/// A biconnected block by name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct BlockSummary {
    /// Number of independent loops in it.
    pub loops: usize,
    /// Whether it is a single joint on no loop.
    pub bridge: bool,
    /// Names of its joints.
    pub joints: Vec<String>,
    /// Names of the couplings that use its joints.
    pub couplings: Vec<String>,
}

/// A link in the spanning tree.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TreeNode {
    /// Name of the link.
    pub link: String,
    /// Number of joints to the root.
    pub depth: usize,
    /// Name of the joint to the parent; none at a root.
    pub joint: Option<String>,
    /// Name of the parent link.
    pub parent: Option<String>,
}

/// A set of cycles.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CyclesSummary {
    /// How many cycles.
    pub count: usize,
    /// Number of joints in all of them together.
    pub total_length: usize,
    /// Number of joints of the longest.
    pub longest: usize,
    /// Number of pairs with joints in common; none if there are too many to count.
    pub overlapping_pairs: Option<usize>,
    /// The cycles; empty if they are too long to list.
    pub cycles: Vec<CycleSummary>,
    /// Pairs with joints in common: positions of the two cycles (from 0) and how many joints; empty if too many to list.
    pub overlaps: Vec<[usize; 3]>,
}

/// One cycle by name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CycleSummary {
    /// Number of joints.
    pub length: usize,
    /// Names of the joints in the order of the walk, `+` before a joint passed from predecessor to successor, `-` before one
    /// passed the other way.
    pub joints: Vec<String>,
}

impl GraphSummary {
    /// Gathers tree, fundamental cycles and basis under the names of the graph.
    ///
    /// # Complexity
    /// Linear in the graph and in what is listed.
    #[must_use]
    pub fn new(graph: &ConstraintGraph, tree: &SpanningTree, basis: &CycleBasis) -> Self {
        let edge_names = |edges: &[usize]| -> Vec<String> {
            edges
                .iter()
                .map(|&e| graph.edge_name(e).to_string())
                .collect()
        };
        let blocks = graph.blocks().into_iter().map(|block| BlockSummary {
            loops: block.loop_count(),
            bridge: block.bridge,
            joints: edge_names(&block.edges),
            couplings: block
                .couplings
                .iter()
                .map(|&c| graph.couplings()[c].name.clone())
                .collect(),
        });
        Self {
            links: graph.node_count(),
            joints: graph.edge_count(),
            loops: tree.chords().len(),
            components: tree.roots().len(),
            ground: graph.node_name(graph.ground()).to_string(),
            blocks: blocks.collect(),
            low_depth: None,
            tree_height: tree.height(),
            tree: tree_nodes(graph, tree),
            chords: edge_names(tree.chords()),
            fundamental_cycles: fundamental_summary(graph, tree),
            minimum_basis: cycles_summary(graph, &basis.cycles),
            basis_kind: basis.kind.clone(),
        }
    }
}

impl GraphSummary {
    /// The same, told as that of the low-depth tree.
    #[must_use]
    pub fn of_low_depth(self) -> Self {
        let (links, joints) = (self.links as u128, self.joints as u128);
        let low_depth = LowDepth {
            longest_cycle: 2 * self.tree_height + 1,
            steps: links * joints * (links + joints),
        };
        Self {
            low_depth: Some(low_depth),
            ..self
        }
    }
}

fn tree_nodes(graph: &ConstraintGraph, tree: &SpanningTree) -> Vec<TreeNode> {
    let mut children = vec![Vec::new(); graph.node_count()];
    for &node in tree.order().iter().rev() {
        if let Some(up) = tree.parent(node) {
            children[up.node].push(node);
        }
    }
    let mut waiting: Vec<usize> = tree.roots().iter().rev().copied().collect();
    let mut nodes = Vec::with_capacity(graph.node_count());
    while let Some(node) = waiting.pop() {
        waiting.extend(&children[node]);
        let up = tree.parent(node);
        nodes.push(TreeNode {
            link: graph.node_name(node).to_string(),
            depth: tree.depth(node),
            joint: up.map(|up| graph.edge_name(up.edge).to_string()),
            parent: up.map(|up| graph.node_name(up.node).to_string()),
        });
    }
    nodes
}

/// Lengths are known without walking the cycles, so long ones need not be built.
fn fundamental_summary(graph: &ConstraintGraph, tree: &SpanningTree) -> CyclesSummary {
    let lengths = tree
        .chords()
        .iter()
        .map(|&chord| tree.fundamental_length(graph, chord));
    let (total_length, longest) =
        lengths.fold((0, 0), |(sum, most), l| (sum + l, usize::max(most, l)));
    if total_length <= LISTED {
        return cycles_summary(graph, &fundamental_cycles(graph, tree));
    }
    CyclesSummary {
        count: tree.chords().len(),
        total_length,
        longest,
        overlapping_pairs: None,
        cycles: Vec::new(),
        overlaps: Vec::new(),
    }
}

fn cycles_summary(graph: &ConstraintGraph, cycles: &[Cycle]) -> CyclesSummary {
    let total_length = cycles.iter().map(Cycle::len).sum();
    let step = |&(edge, forward): &(usize, bool)| {
        format!(
            "{}{}",
            if forward { '+' } else { '-' },
            graph.edge_name(edge)
        )
    };
    let listed = |cycle: &Cycle| CycleSummary {
        length: cycle.len(),
        joints: cycle.edges.iter().map(step).collect(),
    };
    let pairs = (overlap_work(graph, cycles) <= LISTED).then(|| overlaps(graph, cycles));
    CyclesSummary {
        count: cycles.len(),
        total_length,
        longest: cycles.iter().map(Cycle::len).max().unwrap_or(0),
        overlapping_pairs: pairs.as_ref().map(Vec::len),
        cycles: if total_length <= LISTED {
            cycles.iter().map(listed).collect()
        } else {
            Vec::new()
        },
        overlaps: pairs
            .unwrap_or_default()
            .iter()
            .map(|pair| [pair.first, pair.second, pair.shared])
            .collect(),
    }
}

impl fmt::Display for GraphSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "links {}, joints {}, independent loops {}, components {}, ground {}",
            self.links,
            self.joints,
            self.loops,
            self.components,
            plain(&self.ground)
        )?;
        let bridges = self.blocks.iter().filter(|block| block.bridge).count();
        writeln!(
            f,
            "blocks with loops {}, bridges {bridges}",
            self.blocks.len() - bridges
        )?;
        match self.low_depth {
            None => writeln!(f, "\nspanning tree, height {}", self.tree_height)?,
            Some(low) => writeln!(
                f,
                "\nlow-depth spanning tree, height {}: cycles of at most {} joints, found in at most V E² + E V² = {} steps",
                self.tree_height, low.longest_cycle, low.steps
            )?,
        }
        for node in &self.tree {
            // Indentation stops growing, or a deep chain would fill its lines with spaces.
            let indent = 2 * node.depth.min(20) + 2;
            write!(f, "{:indent$}{}", "", plain(&node.link))?;
            match &node.joint {
                Some(joint) => writeln!(f, "  by {}", plain(joint))?,
                None => writeln!(f)?,
            }
        }
        write_cycles(f, "cycles of the tree", &self.fundamental_cycles)?;
        let title = match &self.basis_kind {
            BasisKind::MinimumLength => "shortest cycle basis",
            BasisKind::WithFundamentalBlocks { .. } => {
                "shortest cycle basis, in some blocks replaced by the cycles of the tree"
            }
        };
        write_cycles(f, title, &self.minimum_basis)
    }
}

fn write_cycles(f: &mut fmt::Formatter<'_>, title: &str, set: &CyclesSummary) -> fmt::Result {
    write!(
        f,
        "\n{title}: {}, total length {}, longest {}, pairs with common joints ",
        set.count, set.total_length, set.longest
    )?;
    match set.overlapping_pairs {
        Some(pairs) => writeln!(f, "{pairs}")?,
        None => writeln!(f, "not counted")?,
    }
    if set.cycles.len() < set.count {
        return writeln!(f, "  (too long to list)");
    }
    for (number, cycle) in (1..).zip(&set.cycles) {
        let joints: Vec<_> = cycle.joints.iter().map(|joint| plain(joint)).collect();
        writeln!(
            f,
            "  {number:>3}  length {:>3}  {}",
            cycle.length,
            joints.join(" ")
        )?;
    }
    Ok(())
}

/// Names go to the terminal without control characters.
fn plain(name: &str) -> String {
    let shown = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    name.chars().map(shown).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples;
    use super::*;

    fn summary(graph: &ConstraintGraph) -> GraphSummary {
        let tree = SpanningTree::low_depth(graph);
        GraphSummary::new(graph, &tree, &CycleBasis::minimum(graph, &tree))
    }

    #[test]
    fn cartesian_table_in_words() {
        let text = summary(&samples::cartesian_table()).to_string();
        let expected = "\
links 5, joints 9, independent loops 5, components 1, ground B3
blocks with loops 1, bridges 0

spanning tree, height 3
  B1
    B3  by C5
      B2  by C6
        B5  by C3
    B4  by C1

cycles of the tree: 5, total length 13, longest 5, pairs with common joints 4
    1  length   2  +C1 -C2
    2  length   2  +C3 -C4
    3  length   5  +C1 +C7 -C3 -C6 +C5
    4  length   2  +C5 -C8
    5  length   2  +C6 -C9

shortest cycle basis: 5, total length 13, longest 5, pairs with common joints 4
    1  length   2  +C1 -C2
    2  length   2  +C3 -C4
    3  length   2  +C5 -C8
    4  length   2  +C6 -C9
    5  length   5  +C1 +C7 -C3 -C6 +C5
";
        assert_eq!(text, expected);
    }

    #[test]
    fn json_has_the_same_facts() {
        let json = serde_json::to_value(summary(&samples::platform(6, 3))).unwrap();
        assert_eq!(json["loops"], 5);
        assert_eq!(json["basis_kind"], "minimum_length");
        assert_eq!(json["minimum_basis"]["total_length"], 30);
        assert_eq!(json["minimum_basis"]["overlapping_pairs"], 10);
        assert_eq!(json["fundamental_cycles"]["cycles"][0]["length"], 6);
        assert_eq!(json["tree"][0]["joint"], serde_json::Value::Null);
    }

    /// The tree cycles of a long chain are counted, not listed.
    #[test]
    fn long_chains_stay_readable() {
        let summary = summary(&samples::scissor(3_000, false));
        assert_eq!(summary.minimum_basis.total_length, 4 * 2_999);
        assert_eq!(summary.fundamental_cycles.count, 2_999);
        assert!(summary.to_string().len() < 2_000_000);
        assert_eq!(summary.tree.len(), 6_000);
    }
}
