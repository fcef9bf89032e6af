//! Where links have their frames, and the file that comes of it.

use super::families::{Drawn, Vector, cross, unit};
use super::printing::{What, Writer};
use kutzbach::matrix::SplitMix64;
use std::fmt::Write as _;

/// How frames lie in links.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Frames {
    /// As the world does, at the joint that the link hangs on.
    World,
    /// The axis of that joint along z.
    Axis,
    /// Anyhow.
    Turned,
}

#[derive(Clone, Copy)]
pub struct Setting {
    frames: Frames,
    /// Whether the whole is turned and moved by lot; else its places are whole millimetres where the family allows it.
    moved: bool,
    /// Whether a camera of other digits is mounted on the ground.
    camera: bool,
}

pub const FRAMES: [Setting; 5] = [
    Setting {
        frames: Frames::World,
        moved: false,
        camera: false,
    },
    Setting {
        frames: Frames::World,
        moved: true,
        camera: false,
    },
    Setting {
        frames: Frames::Axis,
        moved: true,
        camera: false,
    },
    Setting {
        frames: Frames::Turned,
        moved: true,
        camera: true,
    },
    Setting {
        frames: Frames::Axis,
        moved: false,
        camera: true,
    },
];

impl Setting {
    pub fn name(self) -> String {
        let moved = if self.moved { "moved" } else { "home" };
        let camera = if self.camera { " camera" } else { "" };
        format!("{:?} {moved}{camera}", self.frames)
    }
}

/// Columns are the axes of a frame.
type Rotation = [Vector; 3];

const IDENTITY: Rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn any_direction(random: &mut SplitMix64) -> Vector {
    loop {
        let v = [0; 3].map(|_| random.symmetric());
        let square: f64 = v.iter().map(|x| x * x).sum();
        if (0.05..1.0).contains(&square) {
            return unit(v);
        }
    }
}

/// A rotation whose z is this direction.
fn with_axis(z: Vector, random: &mut SplitMix64) -> Rotation {
    loop {
        let x = cross(any_direction(random), z);
        let length = x.iter().map(|c| c * c).sum::<f64>().sqrt();
        if length > 0.2 {
            let x = unit(x);
            return [x, cross(z, x), z];
        }
    }
}

/// Components of a vector in a frame.
fn seen(frame: &Rotation, v: Vector) -> Vector {
    frame.map(|axis| (0..3).map(|i| axis[i] * v[i]).sum())
}

/// A vector with these components in a frame.
fn placed(frame: &Rotation, v: Vector) -> Vector {
    [0, 1, 2].map(|i| (0..3).map(|k| frame[k][i] * v[k]).sum())
}

/// Roll, pitch and yaw of a frame seen in another.
fn angles(from: &Rotation, to: &Rotation) -> Vector {
    let [x, y, z] = to.map(|axis| seen(from, axis));
    let pitch = (-x[2]).clamp(-1.0, 1.0).asin();
    [y[2].atan2(z[2]), pitch, x[1].atan2(x[0])]
}

/// The file.
pub fn written(
    drawn: &Drawn,
    setting: Setting,
    writer: &Writer,
    random: &mut SplitMix64,
) -> String {
    let (turn, shift) = match setting.moved {
        true => {
            let turn = with_axis(any_direction(random), random);
            (turn, [0; 3].map(|_| 0.5 * random.symmetric()))
        }
        false => (IDENTITY, [0.0; 3]),
    };
    let links = 1 + drawn.joints.iter().flat_map(|j| j.ends).max().unwrap();
    let mut frames: Vec<(Rotation, Vector)> = vec![(IDENTITY, [0.0; 3]); links];
    let mut text = String::from("<robot name=\"written\">\n");
    for link in 0..links {
        let _ = writeln!(text, "<link name=\"l{link}\"/>");
    }
    for (index, joint) in drawn.joints.iter().enumerate() {
        let point = placed(&turn, joint.point);
        let point = [0, 1, 2].map(|i| point[i] + shift[i]);
        let axis = placed(&turn, joint.axis);
        let own = match setting.frames {
            Frames::World => IDENTITY,
            Frames::Axis => with_axis(axis, random),
            Frames::Turned => with_axis(any_direction(random), random),
        };
        let origin = |link: usize, random: &mut SplitMix64| {
            let (frame, place) = &frames[link];
            let way = seen(frame, [0, 1, 2].map(|i| point[i] - place[i]));
            let mut print = |what: What, values: Vector| -> String {
                let each = values.map(|value| {
                    let small = value.abs() < 1e-12;
                    let value = if small { 0.0 } else { value };
                    writer.number(what, value, joint.closes, random)
                });
                each.join(" ")
            };
            let xyz = print(What::Length, way);
            match setting.frames {
                Frames::World => format!("<origin xyz=\"{xyz}\"/>"),
                _ => {
                    let rpy = print(What::Angle, angles(frame, &own));
                    format!("<origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>")
                }
            }
        };
        let [parent, child] = joint.ends;
        let name = format!("j{index}");
        let kind = joint.kind;
        let parent_origin = origin(parent, random);
        let child_origin = if joint.closes {
            origin(child, random)
        } else {
            String::new()
        };
        let direction = match setting.frames {
            _ if kind == "spherical" => String::new(),
            Frames::Axis => "<axis xyz=\"0 0 1\"/>".to_owned(),
            _ => {
                let components = seen(&own, axis).map(|x| {
                    let x = if x.abs() < 1e-12 { 0.0 } else { x };
                    writer.number(What::Direction, x, joint.closes, random)
                });
                format!("<axis xyz=\"{}\"/>", components.join(" "))
            }
        };
        if joint.closes {
            let _ = writeln!(
                text,
                "<loop name=\"{name}\" type=\"{kind}\"><predecessor link=\"l{parent}\">{parent_origin}</predecessor>\
                 <successor link=\"l{child}\">{child_origin}</successor>{direction}</loop>"
            );
        } else {
            let limit = match kind {
                "prismatic" => "<limit lower=\"-10\" upper=\"10\" effort=\"1\" velocity=\"1\"/>",
                _ => "",
            };
            let _ = writeln!(
                text,
                "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"l{parent}\"/><child link=\"l{child}\"/>{parent_origin}\
                 {direction}{limit}</joint>"
            );
            frames[child] = (own, point);
        }
    }
    if setting.camera {
        text.push_str(
            "<link name=\"camera\"/><joint name=\"mount\" type=\"fixed\"><parent link=\"l0\"/><child link=\"camera\"/>\
             <origin xyz=\"0.123 0 0.04\"/></joint>\n",
        );
    }
    text.push_str("</robot>\n");
    text
}
