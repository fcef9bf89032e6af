//! The mechanism and its motions as data for the page's script.

use super::data::{
    BranchData, CycleData, EventData, HeldData, JointData, LinkData, MotionData, PageData, Palette,
    PointData, Pose, RoleData, SCHEMA, ShapeData, VariableData,
};
use super::motions::Played;
use super::names::{Names, shown};
use super::stage::{Facts, Stage};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use kutzbach_closure::Rigid;
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::Variable;
use kutzbach_scene::{
    AXIS, Colour, GROUND, Part, Primitive, Role, Roles, joint_colour, link_colour,
};

/// Everything the script needs.
pub(super) fn page_data(facts: &Facts<'_>, stage: &Stage, names: &Names) -> PageData {
    let mechanism = facts.mechanism;
    let offsets = mechanism.variable_offsets();
    let variables = Variable::all(mechanism);
    let column = |variable: &Variable| offsets[variable.joint] + variable.freedom;
    PageData {
        schema: SCHEMA,
        mechanism: shown(mechanism.name()),
        centre: stage.centre,
        extent: stage.drawing.extent,
        radius: stage.drawing.radius,
        view: stage.view.toward,
        up: stage.view.up,
        ground: mechanism.ground().0,
        links: mechanism
            .links()
            .iter()
            .zip(&stage.origins)
            .map(|(link, origin)| LinkData {
                name: shown(&link.name),
                origin: *origin,
            })
            .collect(),
        joints: mechanism
            .joints()
            .iter()
            .enumerate()
            .map(|(index, joint)| JointData {
                name: shown(&joint.name),
                class: joint.kind.class().to_owned(),
                kind: joint.kind.word().replace('_', " "),
                links: [joint.predecessor.link.0, joint.successor.link.0],
                first: offsets[index],
                variables: variables[offsets[index]..offsets[index + 1]]
                    .iter()
                    .map(|variable| VariableData {
                        name: shown(&variable.name),
                        unit: variable.unit(mechanism),
                    })
                    .collect(),
            })
            .collect(),
        cycles: facts
            .report
            .cycles
            .iter()
            .map(|cycle| CycleData {
                name: shown(&cycle.name),
                joints: cycle.joints.iter().filter_map(|j| names.joint(j)).collect(),
            })
            .collect(),
        shapes: shapes(stage),
        home: placed(&stage.home, stage),
        roles: roles(mechanism, &stage.roles),
        palette: palette(),
        branches: branches(stage),
        still: stage.repertoire.nothing.clone(),
        motions: stage
            .repertoire
            .played
            .iter()
            .map(|played| motion(mechanism, played, stage, &column))
            .collect(),
        points: stage
            .points
            .iter()
            .map(|point| PointData {
                name: shown(&point.name),
                link: point.link,
                at: seen_from(&point.at, stage.origins[point.link]),
            })
            .collect(),
    }
}

/// A point of a link in the frame that the link is drawn by.
fn seen_from(at: &[f64; 3], origin: Option<[f64; 3]>) -> [f64; 3] {
    let origin = origin.unwrap_or([0.0; 3]);
    [0, 1, 2].map(|i| at[i] - origin[i])
}

/// `world_from_link` of every link, by the frame it is drawn by and relative to the middle of the mechanism.
pub(super) fn placed(links: &[Rigid<f64>], stage: &Stage) -> Vec<Pose> {
    placed_links(links, stage).collect()
}

fn placed_links<'a>(links: &'a [Rigid<f64>], stage: &'a Stage) -> impl Iterator<Item = Pose> + 'a {
    links
        .iter()
        .zip(&stage.origins)
        .map(|(pose, origin)| match origin {
            None => pose_data(pose, &stage.centre),
            Some(origin) => pose_data(&pose.compose(&Rigid::translation(*origin)), &stage.centre),
        })
}

/// Relative to a point.
fn pose_data(pose: &Rigid<f64>, centre: &[f64; 3]) -> Pose {
    let [x, y, z, w] = pose.quaternion();
    let at = &pose.translation;
    [
        at[0] - centre[0],
        at[1] - centre[1],
        at[2] - centre[2],
        w,
        x,
        y,
        z,
    ]
}

fn shapes(stage: &Stage) -> Vec<ShapeData> {
    let shape = |shape: &kutzbach_scene::Shape| {
        let (joint, axis) = match shape.part {
            Part::Link => (None, false),
            Part::Joint(joint) => (Some(joint), false),
            Part::Axis(joint) => (Some(joint), true),
        };
        ShapeData {
            link: shape.link,
            joint,
            axis,
            kind: match shape.primitive {
                Primitive::Box { .. } => "box",
                Primitive::Cylinder { .. } => "cylinder",
                Primitive::Sphere { .. } => "sphere",
                Primitive::Arrow { .. } => "arrow",
            },
            size: shape.primitive.size(),
            pose: pose_data(&shape.pose, &stage.origins[shape.link].unwrap_or([0.0; 3])),
        }
    };
    // A ball for each point asked for, half as thick again as a joint.
    let balls = stage.points.iter().map(|point| {
        let ball = Primitive::Sphere {
            radius: 1.5 * stage.drawing.radius,
        };
        ShapeData {
            link: point.link,
            joint: None,
            axis: false,
            kind: "sphere",
            size: ball.size(),
            pose: pose_data(
                &Rigid::translation(point.at),
                &stage.origins[point.link].unwrap_or([0.0; 3]),
            ),
        }
    });
    stage
        .drawing
        .shapes
        .iter()
        .map(shape)
        .chain(balls)
        .collect()
}

/// The colours of the logs, so that a page and a viewer show the same.
fn palette() -> Palette {
    Palette {
        ground: hex(GROUND),
        locked: hex(joint_colour(Role::Locked)),
        idle: hex(joint_colour(Role::Idle)),
        driven: hex(joint_colour(Role::Driven)),
        moving_joint: hex(joint_colour(Role::Moving)),
        axis: hex(AXIS),
        moving_links: (0..4).map(|i| hex(link_colour(i, Role::Moving))).collect(),
    }
}

fn hex(colour: Colour) -> String {
    let byte = |x: f64| (x.clamp(0.0, 1.0) * 255.0).round() as u8;
    let [red, green, blue] = [colour.red, colour.green, colour.blue].map(byte);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn branches(stage: &Stage) -> Vec<BranchData> {
    let repertoire = &stage.repertoire;
    let branches = stage.branches.iter().enumerate();
    branches
        .map(|(index, (name, dimension))| BranchData {
            name: name.clone(),
            dimension: *dimension,
            motions: (0..repertoire.played.len())
                .filter(|&m| repertoire.played[m].branch == index)
                .collect(),
            still: repertoire.still.get(index).cloned().flatten(),
        })
        .collect()
}

pub(super) fn motion(
    mechanism: &Mechanism,
    played: &Played,
    stage: &Stage,
    column: &dyn Fn(&Variable) -> usize,
) -> MotionData {
    let poses = &played.poses;
    let links = mechanism.links().len();
    let mut all: Vec<f64> = Vec::with_capacity(poses.len() * links * 7);
    for (sample, pose) in poses.iter().enumerate() {
        for (link, mut own) in placed_links(&pose.links, stage).enumerate() {
            // Of the two quaternions of a rotation the one close to that before: what lies between is read off them.
            if sample > 0 {
                let before = &all[((sample - 1) * links + link) * 7 + 3..][..4];
                let along: f64 = before.iter().zip(&own[3..]).map(|(a, b)| a * b).sum();
                if along < 0.0 {
                    own[3..].iter_mut().for_each(|x| *x = -*x);
                }
            }
            all.extend(own);
        }
    }
    MotionData {
        branch: played.branch,
        closed: played.motion.closed.is_some(),
        samples: poses.len(),
        arclengths: packed(poses.iter().map(|pose| pose.arclength)),
        values: packed(poses.iter().flat_map(|pose| pose.values.iter().copied())),
        poses: packed(all.into_iter()),
        start: played.start,
        drives: played.drives.iter().map(column).collect(),
        held: played
            .motion
            .held
            .iter()
            .map(|held| HeldData {
                column: column(&held.variable),
                value: held.value,
            })
            .collect(),
        roles: roles(mechanism, &played.roles),
        events: played
            .motion
            .events
            .iter()
            .map(|event| EventData {
                arclength: event.arclength,
                sample: played.nearest(event.arclength),
                kind: event.kind.word(),
                column: event.kind.variable().map(column),
                home: event.kind.is_home(),
                text: shown(&event.kind.to_string()),
            })
            .collect(),
        length_unit: played.motion.length_unit,
    }
}

pub(super) fn roles(mechanism: &Mechanism, roles: &Roles) -> RoleData {
    let ground = mechanism.ground().0;
    let link = |index: usize| match index == ground {
        true => "ground",
        false => roles.link(index).word(),
    };
    RoleData {
        links: (0..mechanism.links().len()).map(link).collect(),
        joints: (0..mechanism.joints().len())
            .map(|index| roles.joint(index).word())
            .collect(),
    }
}

/// Single precision, little-endian, base64.
pub(super) fn packed(numbers: impl Iterator<Item = f64>) -> String {
    let bytes: Vec<u8> = numbers
        .flat_map(|number| (number as f32).to_le_bytes())
        .collect();
    STANDARD.encode(bytes)
}
