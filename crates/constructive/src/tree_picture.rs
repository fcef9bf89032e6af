//! An s-tree as SVG.

use crate::analysis::{Node, STree};
use crate::picture::escaped;
use std::fmt::Write;

/// Width of a letter, height of a row, and margin, in pixels.
const LETTER: f64 = 7.5;
const ROW: f64 = 56.0;
const MARGIN: f64 = 24.0;

/// The tree from its root down, each node in a column of its own; sides with a virtual edge hang on solid lines, others on dashed
/// ones. `label` names a node.
#[must_use]
pub fn tree_svg(tree: &STree, label: impl Fn(&Node) -> String) -> String {
    let labels: Vec<String> = tree.nodes.iter().map(label).collect();
    let (places, width, depth) = layout(tree, &labels);
    let height = 2.0 * MARGIN + ROW * (depth + 1) as f64 + 20.0;
    let width = width.max(360.0);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
         height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"13\" text-anchor=\"middle\">\n\
         <rect width=\"{width:.0}\" height=\"{height:.0}\" fill=\"#fff\"/>\n"
    );
    for (node, [x, y]) in tree.nodes.iter().zip(&places) {
        let Node::Split {
            sides, virtual_in, ..
        } = node
        else {
            continue;
        };
        for (k, &side) in sides.iter().enumerate() {
            let dashes = if k == *virtual_in {
                ""
            } else {
                " stroke-dasharray=\"5 4\""
            };
            let [to_x, to_y] = places[side];
            let _ = writeln!(
                svg,
                "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{to_x:.1}\" y2=\"{to_y:.1}\" stroke=\"#246\"{dashes}/>"
            );
        }
    }
    for (text, [x, y]) in labels.iter().zip(&places) {
        let wide = breadth(text) - LETTER;
        let _ = writeln!(
            svg,
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{wide:.1}\" height=\"24\" rx=\"4\" fill=\"#eef\" stroke=\"#246\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\">{}</text>",
            x - wide / 2.0,
            y - 12.0,
            y + 4.5,
            escaped(text)
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\">solid: the side with the virtual edge; dashed: the side without</text>\n</svg>",
        width / 2.0,
        height - MARGIN / 2.0
    );
    svg
}

/// The column that a label takes.
fn breadth(label: &str) -> f64 {
    LETTER * (label.chars().count() + 3) as f64
}

/// Middle of every node, the width of all, and the depth of the deepest; columns from left to right in the order of the leaves,
/// every split between its sides.
fn layout(tree: &STree, labels: &[String]) -> (Vec<[f64; 2]>, f64, usize) {
    let mut places = vec![[0.0; 2]; tree.nodes.len()];
    let (mut x, mut deepest) = (MARGIN, 0);
    // A node whose first side is placed already comes back for itself.
    let mut open = vec![(0, 0, false)];
    while let Some((node, depth, seen)) = open.pop() {
        deepest = deepest.max(depth);
        if let (Node::Split { sides, .. }, false) = (&tree.nodes[node], seen) {
            open.push((sides[1], depth + 1, false));
            open.push((node, depth, true));
            open.push((sides[0], depth + 1, false));
            continue;
        }
        let wide = breadth(&labels[node]);
        places[node] = [x + wide / 2.0, MARGIN + ROW * (depth as f64 + 0.5)];
        x += wide;
    }
    (places, x + MARGIN, deepest)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::analysis::s_tree;
    use crate::samples;

    #[test]
    fn every_node_has_a_column_and_lies_below_its_split() {
        let tree = s_tree(&samples::named("chain of six").unwrap());
        let labels: Vec<String> = (0..tree.nodes.len()).map(|i| format!("node {i}")).collect();
        let (places, width, _) = layout(&tree, &labels);
        for (i, [x, _]) in places.iter().enumerate() {
            assert!(*x < width);
            let wide = breadth(&labels[i]);
            assert!(
                places[..i]
                    .iter()
                    .all(|[other, _]| (x - other).abs() > 0.9 * wide)
            );
        }
        for (node, [_, y]) in tree.nodes.iter().zip(&places) {
            if let Node::Split { sides, .. } = node {
                assert!(sides.iter().all(|&s| places[s][1] > *y));
            }
        }
        let svg = tree_svg(&tree, |_| "a & b".to_owned());
        assert_eq!(svg.matches("<line").count(), tree.nodes.len() - 1);
        assert_eq!(svg.matches("stroke-dasharray").count(), 3);
        assert!(svg.contains("a &amp; b"));
    }
}
