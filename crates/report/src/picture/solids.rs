//! Solids and surfaces with flat faces, some of them marked: what was found in a part.
//!
//! # What is wanted
//! Whoever has declared a feature wants to see which faces it is. Each part is seen from infinitely far, from the corner of a box about it from which
//! most of what is marked is seen; marked faces have a colour and their names, marked edges are thick. What is turned away is dashed.
//!
//! # How
//! Faces that are turned to the viewer are drawn from far to near. Of two faces whose pictures may overlap the farther one is that which lies
//! behind the plane of the other; where neither does, as where faces pass through each other, the one whose middle is farther (Newell, Newell
//! and Sancha 1972, without cutting). Comparing is quadratic; beyond two thousand faces the middles decide alone.

use super::markup::{escaped, put, px};
use super::vector::{Vector, cross, dot, sum, times, unit};

/// The style of these pictures, all of it below `svg.solids`.
pub const STYLE: &str = "svg.solids{font:14px system-ui,sans-serif;background:#fff;--ink:#1c2530;--face:#e6eaef;--line:#6a7683}\
svg.solids text{fill:#1c2530;text-anchor:middle}svg.solids .head{text-anchor:start;font-weight:600}\
svg.solids path{fill:#e6eaef;stroke:#6a7683;stroke-linejoin:round;fill-rule:evenodd}\
svg.solids .edge{fill:none;stroke-width:4}svg.solids .behind{fill:none;stroke-dasharray:4 3}\
svg.solids .m0{fill:#9cc9ff;stroke:#1f6fc0}svg.solids .m1{fill:#ffc2a3;stroke:#b4501c}svg.solids .m2{fill:#9fe0c4;stroke:#14805a}\
svg.solids .m3{fill:#e6bfe9;stroke:#8a3f92}svg.solids .m4{fill:#eed98a;stroke:#8a6d0c}svg.solids .m5{fill:#ffb0bf;stroke:#b32a48}\
svg.solids .edge.edge,svg.solids .behind.behind{fill:none}\
@media screen{svg.solids text{fill:var(--ink)}svg.solids path{fill:var(--face);stroke:var(--line)}}\
@media screen and (prefers-color-scheme:dark){svg.solids{background:#161b22;--ink:#dde3ea;--face:#2a323b;--line:#8d99a6}\
svg.solids .m0,svg.solids .m1,svg.solids .m2,svg.solids .m3,svg.solids .m4,svg.solids .m5{fill-opacity:.55}}";

/// How many colours there are; higher ones begin again.
pub const COLOURS: usize = 6;

/// The most faces of which every two are compared.
const MOST_COMPARED: usize = 2_000;

/// Width and height of the picture of one part (px), and the room around it.
const SIZE: [f64; 2] = [560.0, 420.0];
const MARGIN: f64 = 34.0;

/// Points nearer to a plane than this part of the size of what is drawn lie in it.
const IN_PLANE: f64 = 1e-9;

/// What a face or edge is in a feature.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark {
    /// The number of its colour.
    pub colour: usize,
    /// What is written at it.
    pub label: String,
}

/// A flat face.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatFace {
    /// Its loops, each from corner to corner.
    pub loops: Vec<Vec<Vector>>,
    /// Its normal, of a solid outwards; of any length.
    pub normal: Vector,
    /// What it is.
    pub marks: Vec<Mark>,
}

/// An edge that is marked.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkedEdge {
    /// Its ends.
    pub ends: [Vector; 2],
    /// What it is.
    pub mark: Mark,
}

/// A part with what was found in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What stands above it.
    pub title: String,
    /// Whether its faces bound a solid, so that those turned away are not seen.
    pub solid: bool,
    /// Its faces.
    pub faces: Vec<FlatFace>,
    /// Its marked edges.
    pub edges: Vec<MarkedEdge>,
}

/// The parts below each other, as a document of its own. Coordinates that are not finite are drawn at zero.
#[must_use]
pub fn document(parts: &[Part]) -> String {
    let [width, height] = SIZE;
    let total = height * parts.len().max(1) as f64;
    let mut svg = String::new();
    put(
        &mut svg,
        format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"solids\" viewBox=\"0 0 {} {}\" role=\"img\">\n<style>{STYLE}</style>\n",
            px(width),
            px(total)
        ),
    );
    for (place, part) in parts.iter().enumerate() {
        let down = height * place as f64;
        put(
            &mut svg,
            format_args!("<g transform=\"translate(0 {})\">\n", px(down)),
        );
        put(
            &mut svg,
            format_args!(
                "<text class=\"head\" x=\"12\" y=\"22\">{}</text>\n",
                escaped(&part.title)
            ),
        );
        draw(part, &mut svg);
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

fn draw(part: &Part, svg: &mut String) {
    let view = View::new(part);
    let seen = |face: &FlatFace| view.faces(face) || !part.solid;
    let shown: Vec<&FlatFace> = part.faces.iter().filter(|face| seen(face)).collect();
    for face in in_order(&shown, &view) {
        let path = view.path(&face.loops);
        let class = face.marks.first().map(|mark| mark.colour % COLOURS);
        match class {
            Some(colour) => put(
                svg,
                format_args!("<path class=\"m{colour}\" d=\"{path}\"/>\n"),
            ),
            None => put(svg, format_args!("<path d=\"{path}\"/>\n")),
        }
    }
    for face in part.faces.iter().filter(|face| !seen(face)) {
        if let Some(mark) = face.marks.first() {
            let (colour, path) = (mark.colour % COLOURS, view.path(&face.loops));
            let class = format!("behind m{colour}");
            put(
                svg,
                format_args!("<path class=\"{class}\" d=\"{path}\"/>\n"),
            );
        }
    }
    for edge in &part.edges {
        let (colour, path) = (edge.mark.colour % COLOURS, view.path(&[edge.ends.to_vec()]));
        let class = format!("edge m{colour}");
        put(
            svg,
            format_args!("<path class=\"{class}\" d=\"{path}\"/>\n"),
        );
    }
    for face in &part.faces {
        if let Some(outer) = face.loops.first() {
            let labels: Vec<&str> = face.marks.iter().map(|mark| mark.label.as_str()).collect();
            label(&labels.join(", "), view.at(middle(outer)), svg);
        }
    }
    for edge in &part.edges {
        label(&edge.mark.label, view.at(middle(&edge.ends)), svg);
    }
}

fn label(text: &str, [x, y]: [f64; 2], svg: &mut String) {
    if !text.is_empty() {
        let (x, y) = (px(x), px(y + 5.0));
        let text = escaped(text);
        put(
            svg,
            format_args!("<text x=\"{x}\" y=\"{y}\">{text}</text>\n"),
        );
    }
}

/// From where a part is seen, and where its points are in the picture.
struct View {
    /// To the right, upwards, and towards the viewer: unit vectors.
    axes: [Vector; 3],
    /// Pixels for a unit, and the place of the origin.
    scale: f64,
    origin: [f64; 2],
    /// The size of what is drawn.
    size: f64,
}

impl View {
    fn new(part: &Part) -> Self {
        let mut best: Option<(f64, [Vector; 3])> = None;
        for toward in corners() {
            let axes = axes(toward);
            let marked = part.faces.iter().filter(|face| !face.marks.is_empty());
            let shown: f64 = marked
                .map(|face| dot(area(face), axes[2]).max(0.0))
                .filter(|area| area.is_finite())
                .sum();
            // The first of those that show as much, to rounding.
            if best.is_none_or(|(most, _)| shown > most * (1.0 + 1e-9)) {
                best = Some((shown, axes));
            }
        }
        let axes = best.map_or_else(|| axes([1.0, -1.4, 0.9]), |(_, axes)| axes);
        let mut view = Self {
            axes,
            scale: 1.0,
            origin: [0.0; 2],
            size: 0.0,
        };
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in part
            .faces
            .iter()
            .flat_map(|face| face.loops.iter().flatten())
        {
            let [x, y] = view.at(*point);
            (low, high) = (
                [low[0].min(x), low[1].min(y)],
                [high[0].max(x), high[1].max(y)],
            );
        }
        let [wide, high_up] = [high[0] - low[0], high[1] - low[1]];
        view.size = wide.max(high_up);
        if view.size > 0.0 && view.size.is_finite() {
            let room = [SIZE[0] - 2.0 * MARGIN, SIZE[1] - 2.0 * MARGIN];
            view.scale = (room[0] / wide).min(room[1] / high_up);
            view.origin = [
                SIZE[0] / 2.0 - view.scale * (low[0] + high[0]) / 2.0,
                SIZE[1] / 2.0 - view.scale * (low[1] + high[1]) / 2.0,
            ];
        }
        view
    }

    /// Where a point is in the picture (px, y downwards).
    fn at(&self, point: Vector) -> [f64; 2] {
        let [right, up, _] = self.axes;
        [
            self.origin[0] + self.scale * dot(point, right),
            self.origin[1] - self.scale * dot(point, up),
        ]
    }

    fn depth(&self, point: Vector) -> f64 {
        dot(point, self.axes[2])
    }

    /// Whether a face is turned to the viewer.
    fn faces(&self, face: &FlatFace) -> bool {
        dot(face.normal, self.axes[2]) > 0.0
    }

    fn path(&self, loops: &[Vec<Vector>]) -> String {
        let mut path = String::new();
        for corners in loops {
            for (place, corner) in corners.iter().enumerate() {
                let [x, y] = self.at(*corner);
                let letter = if place == 0 { 'M' } else { 'L' };
                put(&mut path, format_args!("{letter}{} {}", px(x), px(y)));
            }
            path.push('Z');
        }
        path
    }
}

/// The corners of a box, those above before those below, and those in front before those behind.
fn corners() -> [Vector; 8] {
    let mut found = [[0.0; 3]; 8];
    for (place, corner) in found.iter_mut().enumerate() {
        let sign = |bit: usize| if place & bit == 0 { 1.0 } else { -1.0 };
        *corner = [sign(1), -1.4 * sign(2), 0.9 * sign(4)];
    }
    found
}

/// Right, up and towards the viewer, who is in a direction that is not vertical.
fn axes(toward: Vector) -> [Vector; 3] {
    let straight = |v: Vector| unit(v).unwrap_or(v);
    let toward = straight(toward);
    let right = straight(cross([0.0, 0.0, 1.0], toward));
    [right, cross(toward, right), toward]
}

/// A face with what tells it from others.
struct Placed<'a> {
    face: &'a FlatFace,
    corners: Vec<Vector>,
    /// The corners of the box around it in the picture.
    low: [f64; 2],
    high: [f64; 2],
    depth: f64,
}

/// Faces from far to near.
fn in_order<'a>(faces: &[&'a FlatFace], view: &View) -> Vec<&'a FlatFace> {
    let mut placed: Vec<Placed<'a>> = faces
        .iter()
        .map(|&face| {
            let corners: Vec<Vector> = face.loops.iter().flatten().copied().collect();
            let flat = corners.iter().map(|corner| view.at(*corner));
            let (low, high) = flat.fold(
                ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]),
                |(low, high), [x, y]| {
                    (
                        [low[0].min(x), low[1].min(y)],
                        [high[0].max(x), high[1].max(y)],
                    )
                },
            );
            Placed {
                depth: view.depth(middle(&corners)),
                face,
                corners,
                low,
                high,
            }
        })
        .collect();
    placed.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    if placed.len() > MOST_COMPARED {
        return placed.into_iter().map(|one| one.face).collect();
    }
    let count = placed.len();
    let mut before: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut waiting = vec![0_usize; count];
    for (first, one) in placed.iter().enumerate() {
        for (second, two) in placed.iter().enumerate().skip(first + 1) {
            let pair = match behind(one, two, view) {
                Some(true) => (first, second),
                Some(false) => (second, first),
                None => continue,
            };
            before[pair.0].push(pair.1);
            waiting[pair.1] += 1;
        }
    }
    let mut out = Vec::with_capacity(count);
    let mut done = vec![false; count];
    for _ in 0..count {
        // The farthest that nothing has to precede; where faces wait for each other, the farthest.
        let free = (0..count).find(|place| !done[*place] && waiting[*place] == 0);
        let Some(next) = free.or_else(|| (0..count).find(|place| !done[*place])) else {
            break;
        };
        done[next] = true;
        for later in &before[next] {
            waiting[*later] = waiting[*later].saturating_sub(1);
        }
        out.push(placed[next].face);
    }
    out
}

/// Whether the first of two faces is behind the second; `None` where it does not matter.
fn behind(one: &Placed<'_>, two: &Placed<'_>, view: &View) -> Option<bool> {
    let apart =
        (0..2).any(|axis| one.high[axis] <= two.low[axis] || two.high[axis] <= one.low[axis]);
    if apart {
        return None;
    }
    let (lowest, highest) = sides(&one.corners, two.face, view);
    let (own_lowest, own_highest) = sides(&two.corners, one.face, view);
    let width = IN_PLANE * view.size;
    let within = |x: f64| x.abs() <= width;
    if within(lowest) && within(highest) {
        return None;
    }
    if highest <= width || own_lowest >= -width {
        return Some(true);
    }
    if lowest >= -width || own_highest <= width {
        return Some(false);
    }
    // They come by the depth of their middles.
    Some(true)
}

/// How far the nearest and the farthest of some points are in front of the plane of a face, as the viewer sees it.
fn sides(points: &[Vector], face: &FlatFace, view: &View) -> (f64, f64) {
    let normal = unit(face.normal).unwrap_or(face.normal);
    let toward = if view.faces(face) { 1.0 } else { -1.0 };
    let on = face.loops.first().and_then(|corners| corners.first());
    let base = dot(normal, on.copied().unwrap_or_default());
    let heights = points.iter().map(|p| toward * (dot(*p, normal) - base));
    heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| {
        (low.min(h), high.max(h))
    })
}

/// Twice the area of a face, as a vector along its normal.
fn area(face: &FlatFace) -> Vector {
    let mut whole = [0.0; 3];
    for corners in &face.loops {
        let following = corners.iter().cycle().skip(1);
        for (from, to) in corners.iter().zip(following) {
            whole = sum(whole, cross(*from, *to));
        }
    }
    // Loops may go round either way; the normal says which side is out.
    match dot(whole, face.normal) < 0.0 {
        true => times(whole, -1.0),
        false => whole,
    }
}

fn middle(points: &[Vector]) -> Vector {
    let whole = points
        .iter()
        .fold([0.0; 3], |whole, point| sum(whole, *point));
    times(whole, 1.0 / points.len().max(1) as f64)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
