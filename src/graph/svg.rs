//! A picture of the graph as a self-contained SVG document.
//!
//! Links stand in rows by their depth in the spanning tree, each above its subtree; tree edges are solid, chords dashed and
//! curved aside so that parallel joints stay apart, the ground is dark. Coordinates come from names and counts through
//! additions, multiplications and square roots only, so the picture is the same on every machine.

use super::constraint_graph::ConstraintGraph;
use super::draw::put;
use super::spanning_tree::SpanningTree;

/// Sizes in pixels.
const FONT: f64 = 12.0;
const NAME_FONT: f64 = 10.5;
/// Width of a character of the usual monospace faces, in parts of the font size.
const CHARACTER: f64 = 0.61;
const BOX_HEIGHT: f64 = 26.0;
const ROW: f64 = 110.0;
const GAP: f64 = 40.0;
const MARGIN: f64 = 24.0;
const LEGEND_HEIGHT: f64 = 30.0;
/// Smallest width of the picture: that of the legend.
const WIDTH: f64 = 480.0;
/// Beyond this number of edges, chords may pass behind links and the names of joints appear only when pointed at: there
/// would be no room for them, and finding it takes quadratic time.
const PLACED_EDGES: usize = 400;

#[derive(Clone, Copy)]
struct Point {
    x: f64,
    y: f64,
}

/// A label or a box, for finding room.
#[derive(Clone, Copy)]
struct Rectangle {
    centre: Point,
    half_width: f64,
    half_height: f64,
}

impl Rectangle {
    fn touches(&self, other: &Self) -> bool {
        (self.centre.x - other.centre.x).abs() < self.half_width + other.half_width
            && (self.centre.y - other.centre.y).abs() < self.half_height + other.half_height
    }
}

/// A quadratic Bézier curve; its control point lies on the chord's middle for straight lines.
struct Curve {
    from: Point,
    control: Point,
    to: Point,
}

impl Curve {
    fn at(&self, t: f64) -> Point {
        let (a, b, c) = ((1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t), t * t);
        Point {
            x: a * self.from.x + b * self.control.x + c * self.to.x,
            y: a * self.from.y + b * self.control.y + c * self.to.y,
        }
    }
}

/// The picture of the graph and its tree. Linear in the size of the graph, apart from the placing of edge names, which is
/// left out for large graphs (the names then show when pointed at).
#[must_use]
pub fn to_svg(graph: &ConstraintGraph, tree: &SpanningTree) -> String {
    let layout = Layout::new(graph, tree);
    let (width, height) = layout.size(tree);
    let mut svg = String::new();
    put(
        &mut svg,
        format_args!(
            concat!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w:.1} {h:.1}" width="{w:.1}" height="{h:.1}" role="img">"#,
                "\n<title>Constraint graph: {n} links, {e} joints, {l} independent loops</title>\n",
                "<style>text{{font:{f}px ui-monospace,Menlo,Consolas,monospace;text-anchor:middle;dominant-baseline:central}}",
                ".edge{{fill:none;stroke:#345;stroke-width:1.6}}.chord{{stroke:#b5482a;stroke-dasharray:6 4}}",
                ".name{{font-size:{g}px;fill:#345}}.chord-name{{fill:#b5482a}}.halo{{font-size:{g}px;fill:#fff;stroke:#fff;stroke-width:4px}}",
                ".link{{fill:#f4f7fa;stroke:#345;stroke-width:1.4}}.ground{{fill:#345}}.ground-name{{fill:#fff}}</style>\n",
                r##"<rect width="100%" height="100%" fill="#fff"/>"##,
                "\n"
            ),
            w = width,
            h = height,
            n = graph.node_count(),
            e = graph.edge_count(),
            l = tree.chords().len(),
            f = FONT,
            g = NAME_FONT,
        ),
    );
    let curves = layout.curves(graph, tree);
    for &edge in tree.edges().iter().chain(tree.chords()) {
        write_edge(&mut svg, graph, tree, edge, &curves[edge]);
    }
    for &node in graph.nodes_by_name() {
        write_node(&mut svg, graph, node, layout.boxes[node]);
    }
    if graph.edge_count() <= PLACED_EDGES {
        write_edge_names(&mut svg, graph, tree, &layout, &curves);
    }
    write_legend(&mut svg, width, height - LEGEND_HEIGHT / 2.0);
    svg.push_str("</svg>\n");
    svg
}

struct Layout {
    /// By node.
    boxes: Vec<Rectangle>,
    width: f64,
}

impl Layout {
    /// Every subtree gets a strip as wide as its own box or its children's strips, whichever is wider.
    fn new(graph: &ConstraintGraph, tree: &SpanningTree) -> Self {
        let own: Vec<f64> = (0..graph.node_count())
            .map(|node| text_width(graph.node_name(node), FONT) + 20.0)
            .collect();
        // The name of the joint above needs room as well.
        let needed = |node: usize| {
            let joint = tree.parent(node).map_or(0.0, |up| {
                text_width(graph.edge_name(up.edge), NAME_FONT) + 4.0
            });
            own[node].max(joint) + GAP
        };
        let mut children = vec![0.0; own.len()];
        let strip = |node: usize, children: &[f64]| f64::max(needed(node), children[node]);
        // Parents come before their children in the order of the tree.
        for &node in tree.order().iter().rev() {
            if let Some(up) = tree.parent(node) {
                children[up.node] += strip(node, &children);
            }
        }
        let mut cursor = vec![0.0; own.len()];
        let mut next_root = MARGIN - GAP / 2.0;
        let mut boxes = vec![
            Rectangle {
                centre: Point { x: 0.0, y: 0.0 },
                half_width: 0.0,
                half_height: BOX_HEIGHT / 2.0,
            };
            own.len()
        ];
        for &node in tree.order() {
            let width = strip(node, &children);
            let place = match tree.parent(node) {
                Some(up) => &mut cursor[up.node],
                None => &mut next_root,
            };
            let left = *place;
            *place += width;
            cursor[node] = left + (width - children[node]) / 2.0;
            #[allow(clippy::cast_precision_loss)]
            let row = tree.depth(node) as f64;
            boxes[node].centre = Point {
                x: left + width / 2.0,
                y: MARGIN + BOX_HEIGHT / 2.0 + ROW * row,
            };
            boxes[node].half_width = own[node] / 2.0;
        }
        // A narrow graph goes to the middle.
        let width = next_root + MARGIN;
        for place in &mut boxes {
            place.centre.x += (WIDTH - width).max(0.0) / 2.0;
        }
        Self {
            boxes,
            width: width.max(WIDTH),
        }
    }

    fn size(&self, tree: &SpanningTree) -> (f64, f64) {
        #[allow(clippy::cast_precision_loss)]
        let rows = tree.height() as f64;
        // Chords within the lowest row hang below it.
        let height = 2.0 * MARGIN + BOX_HEIGHT + ROW * rows + 70.0 + LEGEND_HEIGHT;
        (self.width, height)
    }

    /// One curve for each edge, by edge.
    fn curves(&self, graph: &ConstraintGraph, tree: &SpanningTree) -> Vec<Curve> {
        // Chords between the same two links bend further and further aside.
        let mut chords: Vec<([usize; 2], usize)> = tree
            .chords()
            .iter()
            .map(|&edge| {
                let mut ends = graph.edge(edge).ends.map(|n| graph.node_rank(n));
                ends.sort_unstable();
                (ends, edge)
            })
            .collect();
        chords.sort_by_key(|&(ends, edge)| (ends, graph.edge_rank(edge)));
        let mut place = vec![0_u32; graph.edge_count()];
        for group in chords.chunk_by(|a, b| a.0 == b.0) {
            for (position, &(_, edge)) in (1..).zip(group) {
                place[edge] = position;
            }
        }
        (0..graph.edge_count())
            .map(|edge| {
                let [a, b] = graph.edge(edge).ends;
                let (from, to) = (self.boxes[a].centre, self.boxes[b].centre);
                let bend = |factor: f64| Curve {
                    from,
                    control: control_point(from, to, place[edge], factor),
                    to,
                };
                if graph.edge_count() > PLACED_EDGES {
                    return bend(1.0);
                }
                // The first bend that passes no link, or the plain one.
                let clear = |curve: &Curve| !self.passes_a_link(curve, [a, b]);
                let tried = BENDS.into_iter().map(bend).find(clear);
                tried.unwrap_or_else(|| bend(1.0))
            })
            .collect()
    }

    fn passes_a_link(&self, curve: &Curve, ends: [usize; 2]) -> bool {
        (1..40).map(|step| f64::from(step) / 40.0).any(|t| {
            let point = Rectangle {
                centre: curve.at(t),
                half_width: 5.0,
                half_height: 5.0,
            };
            let mut others = (0..self.boxes.len()).filter(|node| !ends.contains(node));
            others.any(|node| self.boxes[node].touches(&point))
        })
    }
}

/// How much to bend a chord, in parts of the usual, and to which side: in the order of preference.
const BENDS: [f64; 9] = [1.0, -1.0, 0.5, -0.5, 1.6, -1.6, 0.2, 2.4, -2.4];

/// `place` 0: straight. Chords within a row hang down between the rows; others bend to alternating sides.
fn control_point(from: Point, to: Point, place: u32, factor: f64) -> Point {
    let middle = Point {
        x: (from.x + to.x) / 2.0,
        y: (from.y + to.y) / 2.0,
    };
    if place == 0 {
        return middle;
    }
    let (dx, dy) = (to.x - from.x, to.y - from.y);
    let length = (dx * dx + dy * dy).sqrt().max(1.0);
    let step = f64::from(place);
    if dy == 0.0 {
        // The curve reaches half as far as its control point, and rows are 84 pixels apart.
        let sag = (0.12 * length + 34.0).min(100.0) + 26.0 * (step - 1.0);
        return Point {
            x: middle.x,
            y: middle.y + factor * sag.min(145.0),
        };
    }
    let side = if place % 2 == 1 { 1.0 } else { -1.0 };
    let bend = side * (0.10 * length + 26.0) * ((step + 1.0) / 2.0).floor() * factor;
    // The normal is taken from the upper end, so that the order of the ends does not matter.
    let down = if dy > 0.0 { 1.0 } else { -1.0 };
    Point {
        x: middle.x + down * bend * dy / length,
        y: middle.y - down * bend * dx / length,
    }
}

fn write_edge(
    svg: &mut String,
    graph: &ConstraintGraph,
    tree: &SpanningTree,
    edge: usize,
    curve: &Curve,
) {
    let spec = graph.edge(edge);
    let class = if tree.contains(edge) {
        "edge"
    } else {
        "edge chord"
    };
    let [from, to] = spec.ends.map(|node| escaped(graph.node_name(node)));
    put(
        svg,
        format_args!(
            "<path class=\"{class}\" d=\"M{:.1} {:.1}Q{:.1} {:.1} {:.1} {:.1}\"><title>{} ({}, freedom {}): {from} to {to}</title></path>\n",
            curve.from.x,
            curve.from.y,
            curve.control.x,
            curve.control.y,
            curve.to.x,
            curve.to.y,
            escaped(&spec.name),
            escaped(&spec.class),
            spec.freedom,
        ),
    );
}

fn write_node(svg: &mut String, graph: &ConstraintGraph, node: usize, place: Rectangle) {
    let (box_class, text_class) = if node == graph.ground() {
        ("link ground", " class=\"ground-name\"")
    } else {
        ("link", "")
    };
    put(
        svg,
        format_args!(
            "<rect class=\"{box_class}\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" rx=\"5\"/><text{text_class} x=\"{:.1}\" y=\"{:.1}\">{}</text>\n",
            place.centre.x - place.half_width,
            place.centre.y - place.half_height,
            2.0 * place.half_width,
            2.0 * place.half_height,
            place.centre.x,
            place.centre.y,
            escaped(graph.node_name(node)),
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
                    "<text class=\"halo\" x=\"{x:.1}\" y=\"{y:.1}\">{name}</text>",
                    "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{name}</text>\n"
                ),
                x = label.centre.x,
                y = label.centre.y,
                name = escaped(name),
                class = class
            ),
        );
        taken.push(label);
    }
}

fn write_legend(svg: &mut String, width: f64, y: f64) {
    put(
        svg,
        format_args!(
            concat!(
                "<g transform=\"translate({left:.1} {y:.1})\"><path class=\"edge\" d=\"M0 0H36\"/><text x=\"92\" y=\"0\">spanning tree</text>",
                "<path class=\"edge chord\" d=\"M160 0H196\"/><text x=\"252\" y=\"0\">closes a loop</text>",
                "<rect class=\"link ground\" x=\"322\" y=\"-7\" width=\"36\" height=\"14\" rx=\"3\"/><text x=\"386\" y=\"0\">ground</text></g>\n"
            ),
            left = (width - 410.0) / 2.0,
            y = y,
        ),
    );
}

/// Estimated; characters outside ASCII are taken to be as wide as they are high.
fn text_width(text: &str, size: f64) -> f64 {
    let wide = |c: char| if c.is_ascii() { CHARACTER } else { 1.0 };
    text.chars().map(wide).sum::<f64>() * size
}

/// Text for XML 1.0: markup is escaped, and characters that XML does not allow at all are shown as U+FFFD.
fn escaped(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => result.push_str("&amp;"),
            '<' => result.push_str("&lt;"),
            '>' => result.push_str("&gt;"),
            '"' => result.push_str("&quot;"),
            '\'' => result.push_str("&#39;"),
            '\t' | '\n' | '\r' => result.push(' '),
            '\u{fffe}' | '\u{ffff}' => result.push('\u{fffd}'),
            c if c.is_control() => result.push('\u{fffd}'),
            c => result.push(c),
        }
    }
    result
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples;
    use super::*;

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
