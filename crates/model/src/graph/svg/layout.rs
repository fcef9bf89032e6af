//! Where links stand and how edges run between them.

use super::text::text_width;
use super::{FONT, NAME_FONT};
use crate::graph::constraint_graph::ConstraintGraph;
use crate::graph::spanning_tree::SpanningTree;

/// Sizes in pixels.
const BOX_HEIGHT: f64 = 26.0;
const ROW: f64 = 110.0;
const GAP: f64 = 40.0;
const MARGIN: f64 = 24.0;
/// Room below the last row for the legend.
pub const LEGEND_HEIGHT: f64 = 30.0;
/// Smallest width of the picture: that of the legend.
const WIDTH: f64 = 480.0;
/// Beyond this number of edges, chords may pass behind links and the names of joints appear only when pointed at: there
/// would be no room for them, and finding it takes quadratic time.
pub const PLACED_EDGES: usize = 400;

#[derive(Clone, Copy)]
pub struct Point {
    pub x: f64,
    pub y: f64,
}

/// A label or a box, for finding room.
#[derive(Clone, Copy)]
pub struct Rectangle {
    pub centre: Point,
    pub half_width: f64,
    pub half_height: f64,
}

impl Rectangle {
    pub fn touches(&self, other: &Self) -> bool {
        (self.centre.x - other.centre.x).abs() < self.half_width + other.half_width
            && (self.centre.y - other.centre.y).abs() < self.half_height + other.half_height
    }
}

/// A quadratic Bézier curve; its control point lies on the chord's middle for straight lines.
pub struct Curve {
    pub from: Point,
    pub control: Point,
    pub to: Point,
}

impl Curve {
    pub fn at(&self, t: f64) -> Point {
        let (a, b, c) = ((1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t), t * t);
        Point {
            x: a * self.from.x + b * self.control.x + c * self.to.x,
            y: a * self.from.y + b * self.control.y + c * self.to.y,
        }
    }
}

/// Places of all links.
pub struct Layout {
    /// By node.
    pub boxes: Vec<Rectangle>,
    width: f64,
}

impl Layout {
    /// Every subtree gets a strip as wide as its own box or its children's strips, whichever is wider.
    pub fn new(graph: &ConstraintGraph, tree: &SpanningTree) -> Self {
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

    /// Width and height that hold all links, all curves and the legend.
    pub fn size(&self, curves: &[Curve]) -> (f64, f64) {
        // Chords within a row hang below it.
        let lowest_box = self
            .boxes
            .iter()
            .map(|place| place.centre.y + place.half_height);
        let lowest_name = curves.iter().map(|curve| curve.at(0.5).y + NAME_FONT);
        let lowest = lowest_box.chain(lowest_name).fold(MARGIN, f64::max);
        (self.width, lowest + MARGIN + LEGEND_HEIGHT)
    }

    /// One curve for each edge, by edge.
    pub fn curves(&self, graph: &ConstraintGraph, tree: &SpanningTree) -> Vec<Curve> {
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
