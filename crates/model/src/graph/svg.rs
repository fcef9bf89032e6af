//! A picture of the graph as SVG: a document of its own, or an element for a page.
//!
//! Links stand in rows by their depth in the spanning tree, each above its subtree; tree edges are solid, chords dashed and
//! curved aside so that parallel joints stay apart, the ground is dark. Coordinates come from names and counts through
//! additions, multiplications and square roots only, so the picture is the same on every machine.

mod layout;
mod text;

use super::constraint_graph::ConstraintGraph;
use super::draw::put;
use super::folded::FoldedGraph;
use super::spanning_tree::SpanningTree;
use layout::{Curve, LEGEND_HEIGHT, Layout, PLACED_EDGES, Rectangle};
use text::{escaped, text_width};

/// Font sizes in pixels; the style says the same.
const FONT: f64 = 12.0;
const NAME_FONT: f64 = 10.5;

/// The style of the picture, all of it below `svg.graph`, for pages that hold [`svg_fragment`]. Fixed colours stand before
/// custom properties for viewers that know none.
pub const SVG_STYLE: &str = include_str!("svg/style.css");

/// The picture of the graph and its tree as a document of its own, for light and dark screens. Linear in the size of the
/// graph, apart from the placing of edge names, which is left out for large graphs (the names then show when pointed at).
#[must_use]
pub fn to_svg(graph: &ConstraintGraph, tree: &SpanningTree) -> String {
    written(graph, tree, &Handles::None, &of_mechanism(graph, tree))
}

/// What a picture of another graph than that of a mechanism says.
#[derive(Clone, Debug)]
pub struct Captions<'a> {
    /// What it shows.
    pub title: String,
    /// What solid lines are, dashed ones, and the dark box: a word or two each.
    pub legend: [&'a str; 3],
}

/// The picture of any graph along a spanning tree, with words of its own.
#[must_use]
pub fn to_svg_with(
    graph: &ConstraintGraph,
    tree: &SpanningTree,
    captions: &Captions<'_>,
) -> String {
    written(graph, tree, &Handles::None, captions)
}

/// The words of a mechanism's graph.
fn of_mechanism(graph: &ConstraintGraph, tree: &SpanningTree) -> Captions<'static> {
    Captions {
        title: format!(
            "Constraint graph: {} links, {} joints, {} independent loops",
            graph.node_count(),
            graph.edge_count(),
            tree.chords().len()
        ),
        legend: ["spanning tree", "closes a loop", "ground"],
    }
}

/// The same picture as an element `svg.graph` without style, for a page that includes [`SVG_STYLE`]. Links have `data-link`
/// and joints `data-joint` with their indices, which are those of the mechanism for [`ConstraintGraph::of`], and the
/// keyboard reaches both.
#[must_use]
pub fn svg_fragment(graph: &ConstraintGraph, tree: &SpanningTree) -> String {
    written(graph, tree, &Handles::Own, &of_mechanism(graph, tree))
}

/// The same of a folded graph: `data-link` and `data-joint` are still indices of the mechanism.
#[must_use]
pub fn folded_svg_fragment(folded: &FoldedGraph) -> String {
    let captions = of_mechanism(&folded.graph, &folded.tree);
    written(&folded.graph, &folded.tree, &Handles::Of(folded), &captions)
}

/// Attributes by which a page finds a link or joint, and by which the keyboard reaches it. A document of its own has none:
/// indices depend on the order of the file, and nothing reads them.
enum Handles<'a> {
    None,
    /// The graph's own indices.
    Own,
    /// Those of the mechanism that a folded graph stands for.
    Of(&'a FoldedGraph),
}

impl Handles<'_> {
    fn alone(&self) -> bool {
        matches!(self, Self::None)
    }

    fn link(&self, node: usize) -> String {
        match self {
            Self::None => String::new(),
            Self::Own => handle("link", node, true),
            Self::Of(folded) => handle("link", folded.links[node], true),
        }
    }

    fn joint(&self, edge: usize, reached: bool) -> String {
        match self {
            Self::None => String::new(),
            Self::Own => handle("joint", edge, reached),
            Self::Of(folded) => handle("joint", folded.joints[edge], reached),
        }
    }
}

fn handle(what: &str, index: usize, reached: bool) -> String {
    let reached = if reached { " tabindex=\"0\"" } else { "" };
    format!(" data-{what}=\"{index}\"{reached}")
}

fn written(
    graph: &ConstraintGraph,
    tree: &SpanningTree,
    handles: &Handles<'_>,
    captions: &Captions<'_>,
) -> String {
    let alone = handles.alone();
    let layout = Layout::new(graph, tree);
    let curves = layout.curves(graph, tree);
    let (width, height) = layout.size(&curves);
    let title = escaped(&captions.title);
    let mut svg = String::new();
    let namespace = if alone {
        " xmlns=\"http://www.w3.org/2000/svg\""
    } else {
        ""
    };
    put(
        &mut svg,
        format_args!(
            "<svg{namespace} class=\"graph\" viewBox=\"0 0 {width:.1} {height:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" role=\"group\" aria-label=\"{title}\">\n"
        ),
    );
    if alone {
        put(
            &mut svg,
            format_args!(
                "<title>{title}</title>\n<style>{SVG_STYLE}</style>\n<rect class=\"back\" width=\"100%\" height=\"100%\"/>\n"
            ),
        );
    }
    for &edge in tree.edges().iter().chain(tree.chords()) {
        write_edge(&mut svg, graph, tree, edge, &curves[edge], handles);
    }
    for &node in graph.nodes_by_name() {
        write_node(&mut svg, graph, node, layout.boxes[node], handles);
    }
    if graph.edge_count() <= PLACED_EDGES {
        write_edge_names(&mut svg, graph, tree, &layout, &curves, handles);
    }
    write_legend(
        &mut svg,
        width,
        height - LEGEND_HEIGHT / 2.0,
        captions.legend,
    );
    svg.push_str("</svg>\n");
    svg
}

fn write_edge(
    svg: &mut String,
    graph: &ConstraintGraph,
    tree: &SpanningTree,
    edge: usize,
    curve: &Curve,
    handles: &Handles<'_>,
) {
    let spec = graph.edge(edge);
    let class = if tree.contains(edge) {
        "edge"
    } else {
        "edge chord"
    };
    let [from, to] = spec.ends.map(|node| escaped(graph.node_name(node)));
    let path = format!(
        "M{:.1} {:.1}Q{:.1} {:.1} {:.1} {:.1}",
        curve.from.x, curve.from.y, curve.control.x, curve.control.y, curve.to.x, curve.to.y,
    );
    put(
        svg,
        format_args!(
            concat!(
                "<g{handle}><title>{name} ({class_of}, freedom {freedom}): {from} to {to}</title>",
                // Wide and unseen: something to point at.
                "<path class=\"touch\" d=\"{path}\"/><path class=\"{class}\" d=\"{path}\"/></g>\n"
            ),
            handle = handles.joint(edge, true),
            name = escaped(&spec.name),
            class_of = escaped(&spec.class),
            freedom = spec.freedom,
            from = from,
            to = to,
            path = path,
            class = class,
        ),
    );
}

fn write_node(
    svg: &mut String,
    graph: &ConstraintGraph,
    node: usize,
    place: Rectangle,
    handles: &Handles<'_>,
) {
    let (box_class, text_class) = if node == graph.ground() {
        ("link ground", " class=\"ground-name\"")
    } else {
        ("link", "")
    };
    put(
        svg,
        format_args!(
            "<g{handle}><title>{name}</title><rect class=\"{box_class}\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" rx=\"5\"/><text{text_class} dy=\"0.35em\" x=\"{:.1}\" y=\"{:.1}\">{name}</text></g>\n",
            place.centre.x - place.half_width,
            place.centre.y - place.half_height,
            2.0 * place.half_width,
            2.0 * place.half_height,
            place.centre.x,
            place.centre.y,
            name = escaped(graph.node_name(node)),
            handle = handles.link(node),
        ),
    );
}

/// Each name goes to the first of a few places along its curve where it covers nothing written before.
fn write_edge_names(
    svg: &mut String,
    graph: &ConstraintGraph,
    tree: &SpanningTree,
    layout: &Layout,
    curves: &[Curve],
    handles: &Handles<'_>,
) {
    const PLACES: [f64; 11] = [
        0.5, 0.44, 0.56, 0.38, 0.62, 0.32, 0.68, 0.26, 0.74, 0.2, 0.8,
    ];
    let mut taken = layout.boxes.clone();
    for &edge in graph.edges_by_name() {
        let name = graph.edge_name(edge);
        let label = |t: f64| Rectangle {
            centre: curves[edge].at(t),
            half_width: text_width(name, NAME_FONT) / 2.0 + 2.0,
            half_height: NAME_FONT / 2.0 + 2.0,
        };
        let free = PLACES
            .iter()
            .map(|&t| label(t))
            .find(|label| !taken.iter().any(|other| other.touches(label)));
        let label = free.unwrap_or_else(|| label(0.5));
        let class = if tree.contains(edge) {
            "name"
        } else {
            "name chord-name"
        };
        put(
            svg,
            format_args!(
                concat!(
                    // The halo is a text of its own: not every viewer knows `paint-order`.
                    "<g{handle}><text class=\"halo\" aria-hidden=\"true\" dy=\"0.35em\" x=\"{x:.1}\" y=\"{y:.1}\">{name}</text>",
                    "<text class=\"{class}\" dy=\"0.35em\" x=\"{x:.1}\" y=\"{y:.1}\">{name}</text></g>\n"
                ),
                handle = handles.joint(edge, false),
                x = label.centre.x,
                y = label.centre.y,
                name = escaped(name),
                class = class
            ),
        );
        taken.push(label);
    }
}

fn write_legend(svg: &mut String, width: f64, y: f64, [solid, dashed, dark]: [&str; 3]) {
    put(
        svg,
        format_args!(
            concat!(
                "<g transform=\"translate({left:.1} {y:.1})\"><path class=\"edge\" d=\"M0 0H36\"/><text x=\"92\" y=\"0\" dy=\"0.35em\">{solid}</text>",
                "<path class=\"edge chord\" d=\"M160 0H196\"/><text x=\"252\" y=\"0\" dy=\"0.35em\">{dashed}</text>",
                "<rect class=\"link ground\" x=\"322\" y=\"-7\" width=\"36\" height=\"14\" rx=\"3\"/><text x=\"386\" y=\"0\" dy=\"0.35em\">{dark}</text></g>\n"
            ),
            left = (width - 410.0) / 2.0,
            y = y,
            solid = escaped(solid),
            dashed = escaped(dashed),
            dark = escaped(dark),
        ),
    );
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples;
    use super::*;
    use crate::mechanism::{JointBuilder, JointKind, MechanismBuilder};

    fn picture(graph: &ConstraintGraph) -> String {
        to_svg(graph, &SpanningTree::low_depth(graph))
    }

    #[test]
    fn the_picture_is_xml_with_every_name() {
        let nasty = "<a href=\"x\">'&\u{1}\u{ffff}";
        let graph = samples::graph(nasty, &[("j<1>", nasty, "b"), ("]]>", "b", nasty)]);
        let svg = picture(&graph);
        let document = roxmltree::Document::parse(&svg).unwrap();
        let texts: Vec<_> = document
            .descendants()
            .filter(|n| n.has_tag_name("text"))
            .filter_map(|n| n.text())
            .collect();
        for name in ["<a href=\"x\">'&\u{fffd}\u{fffd}", "b", "j<1>", "]]>"] {
            assert!(texts.contains(&name), "{name} is missing");
        }
    }

    #[test]
    fn chords_are_dashed_and_the_ground_is_marked() {
        let svg = picture(&samples::cartesian_table());
        // One more of each in the legend.
        assert_eq!(svg.matches("class=\"edge chord\"").count(), 5 + 1);
        assert_eq!(svg.matches("class=\"edge\"").count(), 4 + 1);
        assert_eq!(svg.matches("class=\"link ground\"").count(), 1 + 1);
    }

    #[test]
    fn the_element_for_pages_knows_links_and_joints() {
        let graph = samples::cartesian_table();
        let svg = svg_fragment(&graph, &SpanningTree::low_depth(&graph));
        let document = roxmltree::Document::parse(&svg).unwrap();
        assert_eq!(document.root_element().attribute("class"), Some("graph"));
        assert!(!svg.contains("style"));
        let reached = |attribute: &str, index: usize| {
            let index = index.to_string();
            let found: Vec<_> = document
                .descendants()
                .filter(|n| n.attribute(attribute) == Some(&index))
                .collect();
            let focused = found
                .iter()
                .filter(|n| n.attribute("tabindex") == Some("0"));
            assert_eq!(focused.count(), 1);
            let title = found
                .iter()
                .find_map(|n| n.children().find(|c| c.has_tag_name("title")));
            title.and_then(|t| t.text()).unwrap().to_owned()
        };
        for node in 0..graph.node_count() {
            assert_eq!(reached("data-link", node), graph.node_name(node));
        }
        for edge in 0..graph.edge_count() {
            assert!(reached("data-joint", edge).starts_with(graph.edge_name(edge)));
        }
    }

    #[test]
    fn nodes_and_edges_are_links_and_joints() {
        let mut builder = MechanismBuilder::new("chain");
        for link in ["base", "crank", "rod"] {
            builder.link(link);
        }
        for (name, ends) in [("pin", ["crank", "rod"]), ("shaft", ["base", "crank"])] {
            let kind = JointKind::Revolute;
            builder.joint(JointBuilder::tree(name, kind, ends[0], ends[1]));
        }
        let mechanism = builder.build().unwrap();
        let graph = ConstraintGraph::of(&mechanism);
        for (index, link) in mechanism.links().iter().enumerate() {
            assert_eq!(graph.node_name(index), link.name);
        }
        for (index, joint) in mechanism.joints().iter().enumerate() {
            assert_eq!(graph.edge_name(index), joint.name);
        }
    }

    #[test]
    fn links_do_not_cover_each_other() {
        for graph in [
            samples::platform(6, 3),
            samples::petersen(),
            samples::lattice(5, 5),
            samples::graph_with_isolated("a", &[("1", "b", "c")], &["d", "e"]),
        ] {
            let layout = Layout::new(&graph, &SpanningTree::low_depth(&graph));
            for (i, a) in layout.boxes.iter().enumerate() {
                assert!(!layout.boxes[i + 1..].iter().any(|b| a.touches(b)));
            }
        }
    }

    #[test]
    fn the_order_of_the_file_does_not_show() {
        let graph = samples::petersen();
        assert_eq!(
            picture(&graph),
            picture(&samples::shuffled(&graph, &[5, 1, 9, 2, 8, 77, 3]))
        );
    }
}
