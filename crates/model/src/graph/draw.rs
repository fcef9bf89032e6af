//! The graph in the language of Graphviz (DOT).

use std::fmt::Write;

use super::constraint_graph::ConstraintGraph;
use super::spanning_tree::SpanningTree;

/// The graph as a DOT document: edges of the tree solid, chords dashed, the ground in a double box, nodes and edges by
/// name. Names are escaped, so any name is shown as it is written.
#[must_use]
pub fn to_dot(graph: &ConstraintGraph, tree: &SpanningTree) -> String {
    let mut dot = String::from("graph constraints {\n  node [shape=box];\n");
    for &node in graph.nodes_by_name() {
        let ground = if node == graph.ground() {
            ", peripheries=2"
        } else {
            ""
        };
        put(
            &mut dot,
            format_args!(
                "  n{} [label={}{ground}];\n",
                graph.node_rank(node),
                quoted(graph.node_name(node))
            ),
        );
    }
    for &edge in graph.edges_by_name() {
        let [from, to] = graph.edge(edge).ends.map(|node| graph.node_rank(node));
        let style = if tree.contains(edge) {
            "solid"
        } else {
            "dashed"
        };
        let label = quoted(graph.edge_name(edge));
        put(
            &mut dot,
            format_args!("  n{from} -- n{to} [label={label}, style={style}];\n"),
        );
    }
    dot.push_str("}\n");
    dot
}

/// Appends formatted text; writing to a `String` cannot fail.
pub(super) fn put(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    let _ = text.write_fmt(arguments);
}

/// A DOT string. Graphviz reads backslash escapes and HTML entities in labels, so both are escaped.
fn quoted(name: &str) -> String {
    let mut text = String::from("\"");
    for character in name.chars() {
        match character {
            '"' => text.push_str("\\\""),
            '\\' => text.push_str("\\\\"),
            '&' => text.push_str("&amp;"),
            '\n' => text.push_str("\\n"),
            c if c.is_control() => text.push('\u{fffd}'),
            c => text.push(c),
        }
    }
    text.push('"');
    text
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn names_are_escaped_and_styles_given() {
        let graph = samples::graph(
            "a\"b\\N",
            &[("j & k", "a\"b\\N", "c"), ("line\nbreak", "c", "a\"b\\N")],
        );
        let dot = to_dot(&graph, &SpanningTree::low_depth(&graph));
        let expected = "graph constraints {\n  node [shape=box];\n  n0 [label=\"a\\\"b\\\\N\", peripheries=2];\n  \
                        n1 [label=\"c\"];\n  n0 -- n1 [label=\"j &amp; k\", style=solid];\n  \
                        n1 -- n0 [label=\"line\\nbreak\", style=dashed];\n}\n";
        assert_eq!(dot, expected);
    }
}
