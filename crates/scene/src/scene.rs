//! Shapes as entities of a scene, fixed to the frames of their links.

use super::appearance::{Colour, GAP, LABEL, Roles};
use super::messages::{Motion, pose, stamp, vector};
use super::names::{Stream, frame_id, readable};
use super::shapes::{Drawing, Part, Primitive, Shape};
use super::vectors::{along, norm};
use foxglove::messages::{
    ArrowPrimitive, Color, CubePrimitive, CylinderPrimitive, Duration, KeyValuePair, LinePrimitive,
    Point3, SceneEntity, SceneUpdate, SpherePrimitive, TextPrimitive,
};
use kutzbach_closure::Rigid;
use kutzbach_model::mechanism::{JointKind, Mechanism};

/// Opacity of the predicted motion where the simulated one is drawn in the same place.
pub const GHOST: f64 = 0.35;

/// `LINE_LIST` of foxglove.LinePrimitive: pairs of points.
const PAIRS_OF_POINTS: i32 = 2;

/// Thickness of lines that keep their width at any distance, in pixels.
const PIXELS: f64 = 3.0;

/// All entities of one stream: one per link and part, none of which changes while the mechanism moves.
pub fn entities(
    mechanism: &Mechanism,
    drawing: &Drawing,
    roles: &Roles,
    stream: Stream,
    opacity: f64,
    time: u64,
) -> Vec<SceneEntity> {
    let mut found: Vec<SceneEntity> = Vec::new();
    let mut last = None;
    for shape in &drawing.shapes {
        let here = (shape.link, shape.part);
        if last != Some(here) {
            last = Some(here);
            found.push(empty(mechanism, roles, stream, shape, time));
        }
        if let Some(entity) = found.last_mut() {
            add(entity, shape, opacity);
        }
    }
    found.push(label(drawing, stream, time));
    found
}

fn empty(
    mechanism: &Mechanism,
    roles: &Roles,
    stream: Stream,
    shape: &Shape,
    time: u64,
) -> SceneEntity {
    let link = &mechanism
        .link(kutzbach_model::mechanism::LinkId(shape.link))
        .name;
    let joint = |index: usize| mechanism.joint(kutzbach_model::mechanism::JointId(index));
    let mut facts = Vec::new();
    let mut fact = |key: &str, value: &str| {
        facts.push(KeyValuePair {
            key: key.to_owned(),
            value: readable(value).into_owned(),
        });
    };
    let (what, name) = match shape.part {
        Part::Link => {
            let role = if shape.link == mechanism.ground().0 {
                "ground"
            } else {
                roles.link(shape.link).word()
            };
            fact("role", role);
            ("link", link)
        }
        Part::Joint(index) | Part::Axis(index) => {
            let joint = joint(index);
            fact("class", joint.kind.class());
            fact("role", roles.joint(index).word());
            fact("predecessor", &mechanism.link(joint.predecessor.link).name);
            fact("successor", &mechanism.link(joint.successor.link).name);
            let what = match shape.part {
                Part::Axis(_) => "axis",
                _ if shape.link == joint.predecessor.link.0 => "joint",
                _ => "counterpart",
            };
            (what, &joint.name)
        }
    };
    entity(
        frame_id(stream, link),
        format!("{}/{what}/{}", stream.word(), readable(name)),
        facts,
        time,
    )
}

fn entity(frame: String, id: String, metadata: Vec<KeyValuePair>, time: u64) -> SceneEntity {
    SceneEntity {
        timestamp: Some(stamp(time)),
        frame_id: frame,
        id,
        // For ever.
        lifetime: Some(Duration::new(0, 0)),
        frame_locked: true,
        metadata,
        ..SceneEntity::default()
    }
}

fn add(entity: &mut SceneEntity, shape: &Shape, opacity: f64) {
    let color = Some(color(
        shape.colour.with_opacity(shape.colour.opacity * opacity),
    ));
    let size = Some(vector(shape.primitive.size()));
    let at = Some(pose(&shape.pose));
    match shape.primitive {
        Primitive::Box { .. } => entity.cubes.push(CubePrimitive {
            pose: at,
            size,
            color,
        }),
        Primitive::Sphere { .. } => entity.spheres.push(SpherePrimitive {
            pose: at,
            size,
            color,
        }),
        Primitive::Cylinder { .. } => entity.cylinders.push(CylinderPrimitive {
            pose: at,
            size,
            bottom_scale: 1.0,
            top_scale: 1.0,
            color,
        }),
        Primitive::Arrow { radius, length } => {
            // An arrow of the scene points along x; a shape's along z.
            let x_to_z = Rigid {
                rotation: [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
                translation: [0.0; 3],
            };
            let head = (6.0 * radius).min(0.5 * length);
            entity.arrows.push(ArrowPrimitive {
                pose: Some(pose(&shape.pose.compose(&x_to_z))),
                shaft_length: length - head,
                shaft_diameter: 2.0 * radius,
                head_length: head,
                head_diameter: 5.0 * radius,
                color,
            });
        }
    }
}

/// The stream's name above the mechanism.
fn label(drawing: &Drawing, stream: Stream, time: u64) -> SceneEntity {
    let [low, high] = drawing.bounds;
    let above = [
        0.5 * (low[0] + high[0]),
        0.5 * (low[1] + high[1]),
        high[2] + 0.12 * drawing.extent,
    ];
    let word = stream.word();
    let mut label = entity(word.to_owned(), format!("{word}/label"), Vec::new(), time);
    label.texts.push(TextPrimitive {
        pose: Some(pose(&Rigid::translation(above))),
        billboard: true,
        font_size: 0.05 * drawing.extent,
        scale_invariant: false,
        color: Some(color(LABEL)),
        text: word.to_owned(),
    });
    label
}

/// What a stream's moment adds to the scene: lines across gaps, and the rods of distance joints, which belong to neither
/// of their links.
pub fn lines(
    mechanism: &Mechanism,
    drawing: &Drawing,
    rods: &[(usize, [Rigid<f64>; 2])],
    roles: &Roles,
    stream: Stream,
    motion: &Motion<'_>,
    time: u64,
) -> SceneEntity {
    let word = stream.word();
    let mut entity = entity(word.to_owned(), format!("{word}/gaps"), Vec::new(), time);
    let mut points = Vec::new();
    for gap in motion.gaps {
        if gap.predecessor != gap.successor {
            points.extend([gap.predecessor, gap.successor].map(point));
        }
    }
    if !points.is_empty() {
        entity.lines.push(LinePrimitive {
            r#type: PAIRS_OF_POINTS,
            pose: Some(pose(&Rigid::identity(&0.0))),
            thickness: PIXELS,
            scale_invariant: true,
            points,
            color: Some(color(GAP)),
            colors: Vec::new(),
            indices: Vec::new(),
        });
    }
    for (index, sides) in rods {
        let joint = mechanism.joint(kutzbach_model::mechanism::JointId(*index));
        let links = [joint.predecessor.link.0, joint.successor.link.0];
        let [from, to] = [0, 1].map(|i| motion.links[links[i]].apply(&sides[i].translation));
        let way = [0, 1, 2].map(|i| to[i] - from[i]);
        let middle = [0, 1, 2].map(|i| from[i] + 0.5 * way[i]);
        let thick = drawing.radius;
        entity.cylinders.push(CylinderPrimitive {
            pose: Some(pose(&along(middle, way))),
            size: Some(vector([thick, thick, norm(way)])),
            bottom_scale: 1.0,
            top_scale: 1.0,
            color: Some(color(super::appearance::joint_colour(roles.joint(*index)))),
        });
    }
    entity
}

/// The joints that [`lines`] draws a rod for, with their sides.
pub fn rods(mechanism: &Mechanism, sides: &[[Rigid<f64>; 2]]) -> Vec<(usize, [Rigid<f64>; 2])> {
    let joints = mechanism.joints().iter().zip(sides).enumerate();
    joints
        .filter(|(_, (joint, _))| joint.kind == JointKind::Distance)
        .map(|(index, (_, sides))| (index, sides.clone()))
        .collect()
}

/// A scene that knows nothing but these entities.
pub fn update(entities: Vec<SceneEntity>) -> SceneUpdate {
    SceneUpdate {
        deletions: Vec::new(),
        entities,
    }
}

fn color(colour: Colour) -> Color {
    Color {
        r: colour.red,
        g: colour.green,
        b: colour.blue,
        a: colour.opacity,
    }
}

fn point(point: [f64; 3]) -> Point3 {
    let [x, y, z] = point.map(|x| x + 0.0);
    Point3 { x, y, z }
}
