//! From a mechanism's shapes to solids on the page.

use super::solid::Solid;
use super::{Detail, Sketch};
use crate::picture::vector::{Vector, cross, difference, dot, is_finite, norm, sum, times, unit};
use kutzbach_closure::Rigid;
use kutzbach_model::mechanism::{JointId, JointKind};
use kutzbach_scene::{Colour, Part, Primitive, Shape};

use std::collections::BTreeMap;

/// Room left around the picture (px).
const MARGIN: f64 = 6.0;
/// Symbols of joints are at least that large (px), unless that takes more than this factor: they would cover the rods.
const LEAST_RADIUS: f64 = 1.7;
const MOST_BOOST: f64 = 2.5;
/// Axes reach that far from their joint, in radii of the symbol.
const AXIS_REACH: f64 = 6.0;
/// Where an axis leaves the symbol, in the same unit.
const AXIS_START: f64 = 1.5;
/// Axes that point to the eye more than this (cosine) are not drawn.
const AXIS_TO_THE_EYE: f64 = 0.9;

/// A solid on the page, in pixels: right, *down*, towards the eye.
#[derive(Clone, Debug)]
pub struct Item {
    /// The link that carries it.
    pub link: usize,
    /// What it stands for.
    pub part: Part,
    pub colour: Colour,
    pub solid: Solid,
}

/// Everything on the page, in pixels.
pub struct Scene {
    pub size: [f64; 2],
    pub items: Vec<Item>,
    /// Links of other poses.
    pub ghosts: Vec<Vec<Item>>,
    /// Ways of points, with their colours.
    pub paths: Vec<(Colour, Vec<[f64; 2]>)>,
    /// Lines across gaps.
    pub gaps: Vec<[[f64; 2]; 2]>,
    /// The outlines of links that join three joints or more, by link.
    pub webs: BTreeMap<usize, Vec<[f64; 2]>>,
}

impl Scene {
    pub fn new(sketch: &Sketch<'_>, detail: Detail) -> Self {
        let sane = |x: f64| {
            if x.is_finite() {
                x.clamp(16.0, 4000.0)
            } else {
                480.0
            }
        };
        let size = sketch.size.map(sane);
        let collected = |boost: f64| Collected::new(sketch, detail, boost);
        // The size of symbols depends on the scale, and this hardly on the symbols.
        let first = collected(1.0);
        let scale = first.fit(size).0;
        let boost = (LEAST_RADIUS / (sketch.drawing.radius * scale)).clamp(1.0, MOST_BOOST);
        let mut all = if boost > 1.0 { collected(boost) } else { first };
        let (scale, [x, y]) = all.fit(size);
        let place = |p: Vector| [x + scale * p[0], y - scale * p[1], scale * p[2]];
        for item in all.items.iter_mut().chain(all.ghosts.iter_mut().flatten()) {
            item.solid = item.solid.mapped(scale, place);
            if let Solid::Cuboid { halves, .. } = &mut item.solid {
                for half in halves {
                    half[1] = -half[1];
                }
            }
        }
        let flat = |p: &Vector| {
            let p = place(*p);
            [p[0], p[1]]
        };
        let webs = if detail < Detail::Dots {
            webs(&all.items)
        } else {
            BTreeMap::new()
        };
        Self {
            size,
            webs,
            items: all.items,
            ghosts: all.ghosts,
            paths: all
                .paths
                .iter()
                .map(|(colour, points)| (*colour, points.iter().map(flat).collect()))
                .collect(),
            gaps: all.gaps.iter().map(|[a, b]| [flat(a), flat(b)]).collect(),
        }
    }
}

/// The same in view coordinates, in metres: right, up, towards the eye.
struct Collected {
    items: Vec<Item>,
    ghosts: Vec<Vec<Item>>,
    paths: Vec<(Colour, Vec<Vector>)>,
    gaps: Vec<[Vector; 2]>,
}

impl Collected {
    fn new(sketch: &Sketch<'_>, detail: Detail, boost: f64) -> Self {
        let drawing = sketch.drawing;
        let by_link = link_shapes(sketch);
        let mut items = Vec::new();
        for shapes in &by_link {
            link_items(sketch, shapes, sketch.links, &mut items);
        }
        if detail < Detail::Lines {
            joint_items(sketch, detail, boost, &mut items);
        }
        distance_rods(sketch, boost, &mut items);
        let mut ghosts = Vec::new();
        for links in sketch.ghosts.iter().take(detail.ghosts()) {
            let mut ghost = Vec::new();
            for shapes in &by_link {
                let moves = |shape: &&Shape| moved(shape, sketch.links, links, drawing.extent);
                if shapes.iter().any(moves) {
                    link_items(sketch, shapes, links, &mut ghost);
                }
            }
            ghosts.push(ghost);
        }
        let colour_of = |link: usize| {
            let shapes = by_link.iter().find(|shapes| shapes[0].link == link);
            shapes.map_or(kutzbach_scene::AXIS, |shapes| shapes[0].colour)
        };
        let project = |p: &Vector| is_finite(*p).then(|| sketch.view.project(*p));
        let paths = sketch
            .paths
            .iter()
            .map(|path| {
                let points = path.points.iter().filter_map(project).collect();
                (colour_of(path.link), points)
            })
            .collect();
        let gaps = sketch
            .gaps
            .iter()
            .filter_map(|[a, b]| Some([project(a)?, project(b)?]))
            .collect();
        Self {
            items,
            ghosts,
            paths,
            gaps,
        }
    }

    /// Pixels per metre, and where the origin comes to lie.
    fn fit(&self, size: [f64; 2]) -> (f64, [f64; 2]) {
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let mut include = |[low, high]: [[f64; 2]; 2]| {
            for i in 0..2 {
                bounds[0][i] = bounds[0][i].min(low[i]);
                bounds[1][i] = bounds[1][i].max(high[i]);
            }
        };
        for item in self.items.iter().chain(self.ghosts.iter().flatten()) {
            include(item.solid.bounds());
        }
        let points = self.paths.iter().flat_map(|(_, points)| points);
        for point in points.chain(self.gaps.iter().flatten()) {
            include([[point[0], point[1]]; 2]);
        }
        if !bounds.iter().flatten().all(|x| x.is_finite()) {
            return (1.0, size.map(|x| 0.5 * x));
        }
        let span = [0, 1].map(|i| bounds[1][i] - bounds[0][i]);
        let scale = [0, 1]
            .map(|i| (size[i] - 2.0 * MARGIN) / span[i])
            .into_iter()
            .filter(|s| s.is_finite() && *s > 0.0)
            .fold(f64::INFINITY, f64::min);
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let middle = [0, 1].map(|i| 0.5 * (bounds[0][i] + bounds[1][i]));
        let origin = [
            0.5 * size[0] - scale * middle[0],
            0.5 * size[1] + scale * middle[1],
        ];
        (scale, origin)
    }
}

/// The convex outlines of links of three rods or more: bodies rather than bars.
fn webs(items: &[Item]) -> BTreeMap<usize, Vec<[f64; 2]>> {
    let mut ends_of: BTreeMap<usize, Vec<[f64; 2]>> = BTreeMap::new();
    for item in items {
        if let (Part::Link, Solid::Rod { ends, .. }) = (item.part, item.solid) {
            let points = ends_of.entry(item.link).or_default();
            points.extend(ends.map(|p| [p[0], p[1]]));
        }
    }
    ends_of
        .into_iter()
        .filter(|(_, points)| points.len() >= 6)
        .map(|(link, points)| (link, convex_outline(points)))
        .filter(|(_, outline)| outline.len() >= 3)
        .collect()
}

/// The convex hull, counted around (Andrew 1979).
fn convex_outline(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    let turns = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let mut outline: Vec<[f64; 2]> = Vec::new();
    for upper in [false, true] {
        let least = outline.len() + 1;
        for k in 0..points.len() {
            let point = points[if upper { points.len() - 1 - k } else { k }];
            while outline.len() > least
                && !(turns(
                    outline[outline.len() - 2],
                    outline[outline.len() - 1],
                    point,
                ) > 0.0)
            {
                outline.pop();
            }
            outline.push(point);
        }
        outline.pop();
    }
    outline
}

/// The shapes of links, link by link.
fn link_shapes<'a>(sketch: &Sketch<'a>) -> Vec<Vec<&'a Shape>> {
    let mut groups: Vec<Vec<&Shape>> = Vec::new();
    for shape in &sketch.drawing.shapes {
        if shape.part != Part::Link {
            continue;
        }
        match groups.last_mut() {
            Some(group) if group[0].link == shape.link => group.push(shape),
            _ => groups.push(vec![shape]),
        }
    }
    groups
}

/// World pose of a shape; `None` where it is not finite.
fn world_pose(shape: &Shape, links: &[Rigid<f64>]) -> Option<Rigid<f64>> {
    let pose = links.get(shape.link)?.compose(&shape.pose);
    let finite = is_finite(pose.translation) && pose.rotation.iter().all(|row| is_finite(*row));
    finite.then_some(pose)
}

/// Whether a shape is elsewhere in another pose, by more than the eye would see.
fn moved(shape: &Shape, from: &[Rigid<f64>], to: &[Rigid<f64>], extent: f64) -> bool {
    let (Some(a), Some(b)) = (world_pose(shape, from), world_pose(shape, to)) else {
        return false;
    };
    let size = shape.primitive.size();
    [[0.0; 3], times(size, 0.5), times(size, -0.5)]
        .iter()
        .any(|p| norm(difference(a.apply(p), b.apply(p))) > 2e-3 * extent)
}

/// A cylinder's ends in view coordinates.
fn ends(sketch: &Sketch<'_>, pose: &Rigid<f64>, length: f64) -> [Vector; 2] {
    [-0.5, 0.5].map(|share| sketch.view.project(pose.apply(&[0.0, 0.0, share * length])))
}

/// A solid of its own; `grown` enlarges it about its origin.
fn solid(sketch: &Sketch<'_>, pose: &Rigid<f64>, primitive: &Primitive, grown: f64) -> Solid {
    match *primitive {
        Primitive::Box { size } => {
            let half = |axis: usize| {
                let mut half = [0.0; 3];
                half[axis] = 0.5 * grown * size[axis];
                sketch.view.project(pose.rotate(&half))
            };
            Solid::Cuboid {
                centre: sketch.view.project(pose.translation),
                halves: [half(0), half(1), half(2)],
            }
        }
        Primitive::Sphere { radius } => Solid::Ball {
            centre: sketch.view.project(pose.translation),
            radius: grown * radius,
        },
        Primitive::Cylinder { radius, length } => Solid::Cylinder {
            ends: ends(sketch, pose, grown * length),
            radius: grown * radius,
        },
        Primitive::Arrow { length, .. } => {
            let tip = pose.apply(&[0.0, 0.0, grown * length]);
            Solid::Line {
                ends: [pose.translation, tip].map(|p| sketch.view.project(p)),
            }
        }
    }
}

/// The solids of one link. Cylinders with a ball of their radius at both ends become rods, and the balls vanish in them.
fn link_items(sketch: &Sketch<'_>, shapes: &[&Shape], links: &[Rigid<f64>], items: &mut Vec<Item>) {
    let mut found: Vec<Item> = Vec::new();
    for shape in shapes {
        let Some(pose) = world_pose(shape, links) else {
            continue;
        };
        found.push(Item {
            link: shape.link,
            part: Part::Link,
            colour: shape.colour,
            solid: solid(sketch, &pose, &shape.primitive, 1.0),
        });
    }
    let balls: Vec<(Vector, f64)> = found
        .iter()
        .filter_map(|item| match item.solid {
            Solid::Ball { centre, radius } => Some((centre, radius)),
            _ => None,
        })
        .collect();
    let mut rod_ends: Vec<(Vector, f64)> = Vec::new();
    for item in &mut found {
        let Solid::Cylinder { ends, radius } = item.solid else {
            continue;
        };
        let ball_at = |end: &Vector| {
            let near = |(centre, size): &(Vector, f64)| {
                *size > 0.99 * radius && norm(difference(*centre, *end)) < 0.05 * radius
            };
            balls.iter().any(near)
        };
        if ends.iter().all(ball_at) {
            item.solid = Solid::Rod { ends, radius };
            rod_ends.extend(ends.map(|end| (end, radius)));
        }
    }
    found.retain(|item| match item.solid {
        Solid::Ball { centre, radius } => !rod_ends.iter().any(|(end, size)| {
            radius < 1.01 * size && norm(difference(centre, *end)) < 0.05 * size
        }),
        _ => true,
    });
    items.append(&mut found);
}

/// Symbols and axes of joints.
fn joint_items(sketch: &Sketch<'_>, detail: Detail, boost: f64, items: &mut Vec<Item>) {
    let radius = boost * sketch.drawing.radius;
    let meeting = match detail {
        Detail::Full => meeting_point(sketch),
        _ => None,
    };
    let mut last = None;
    for shape in &sketch.drawing.shapes {
        let Some(pose) = world_pose(shape, sketch.links) else {
            continue;
        };
        let mut add = |solid: Solid| {
            items.push(Item {
                link: shape.link,
                part: shape.part,
                colour: shape.colour,
                solid,
            });
        };
        match shape.part {
            Part::Joint(joint) if detail >= Detail::Dots => {
                // One dot for each joint.
                if last != Some(joint) {
                    add(Solid::Ball {
                        centre: sketch.view.project(pose.translation),
                        radius,
                    });
                }
                last = Some(joint);
            }
            Part::Joint(_) => add(solid(sketch, &pose, &shape.primitive, boost)),
            Part::Axis(_) if detail == Detail::Full => {
                let centre = sketch.view.project(pose.translation);
                let Some(axis) = unit(sketch.view.project(pose.rotate(&[0.0, 0.0, 1.0]))) else {
                    continue;
                };
                if axis[2].abs() > AXIS_TO_THE_EYE && meeting.is_none() {
                    continue;
                }
                for sign in [-1.0, 1.0] {
                    let at = |reach: f64| sum(centre, times(axis, sign * reach * radius));
                    let end = match meeting {
                        Some(point) if sign * dot(axis, difference(point, centre)) > 0.0 => point,
                        _ => at(AXIS_REACH),
                    };
                    add(Solid::Line {
                        ends: [at(AXIS_START), end],
                    });
                }
            }
            Part::Axis(_) | Part::Link => {}
        }
    }
}

/// Where the axes of a spherical mechanism meet, in view coordinates; `None` where there are fewer than three axes, some
/// joint has none, or they do not meet in one point away from the symbols.
fn meeting_point(sketch: &Sketch<'_>) -> Option<Vector> {
    let mut lines: Vec<(Vector, Vector)> = Vec::new();
    for shape in &sketch.drawing.shapes {
        let Part::Axis(joint) = shape.part else {
            continue;
        };
        let joint = sketch.mechanism.joints().get(joint)?;
        if joint.kind != JointKind::Revolute {
            return None;
        }
        let pose = world_pose(shape, sketch.links)?;
        let axis = unit(pose.rotate(&[0.0, 0.0, 1.0]))?;
        lines.push((pose.translation, axis));
    }
    if lines.len() < 3 || lines.len() != sketch.mechanism.joints().len() {
        return None;
    }
    // The first axis and the one least parallel to it say where; all have to go through it.
    let (p, u) = lines[0];
    let &(q, v) = lines.iter().max_by(|a, b| {
        let off = |line: &(Vector, Vector)| norm(cross(u, line.1));
        off(a).total_cmp(&off(b))
    })?;
    let normal = cross(u, v);
    let square = dot(normal, normal);
    if !(square > 1e-4) {
        return None;
    }
    let along = dot(cross(difference(q, p), v), normal) / square;
    let point = sum(p, times(u, along));
    let far = |(q, v): &(Vector, Vector)| norm(cross(difference(point, *q), *v));
    let symbol = 3.0 * sketch.drawing.radius;
    let meets = lines.iter().all(|line| {
        far(line) < 1e-5 * sketch.drawing.extent && norm(difference(point, line.0)) > symbol
    });
    meets.then(|| sketch.view.project(point))
}

/// Joints that keep two points at a distance are rods which belong to neither link.
fn distance_rods(sketch: &Sketch<'_>, boost: f64, items: &mut Vec<Item>) {
    let mut ends: Vec<(usize, &Shape, Vector)> = Vec::new();
    for shape in &sketch.drawing.shapes {
        let Part::Joint(joint) = shape.part else {
            continue;
        };
        if joint >= sketch.mechanism.joints().len()
            || sketch.mechanism.joint(JointId(joint)).kind != JointKind::Distance
        {
            continue;
        }
        if let Some(pose) = world_pose(shape, sketch.links) {
            ends.push((joint, shape, sketch.view.project(pose.translation)));
        }
    }
    for pair in ends.chunk_by(|a, b| a.0 == b.0) {
        if let [(_, shape, from), (_, _, to)] = pair {
            items.push(Item {
                link: shape.link,
                part: shape.part,
                colour: shape.colour,
                solid: Solid::Rod {
                    ends: [*from, *to],
                    radius: 0.5 * boost * sketch.drawing.radius,
                },
            });
        }
    }
}
