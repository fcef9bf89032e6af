//! What the page's script is told. `docs/src/page.md` describes every field.

use serde::Serialize;

/// The version of the data.
pub const SCHEMA: &str = "kutzbach-page-1";

/// `[x, y, z, qw, qx, qy, qz]`: a pose; metres and a unit quaternion.
pub type Pose = [f64; 7];

/// Everything.
#[derive(Debug, Serialize)]
pub struct PageData {
    pub schema: &'static str,
    pub mechanism: String,
    /// The point that positions are told from, in the world frame (m).
    pub centre: [f64; 3],
    /// Diagonal of the box around the mechanism at home (m); positive.
    pub extent: f64,
    /// Radius of a joint's symbol (m).
    pub radius: f64,
    /// From the mechanism towards the eye; unit vector.
    pub view: [f64; 3],
    /// What is up in the picture; unit vector.
    pub up: [f64; 3],
    /// Index of the link held fixed.
    pub ground: usize,
    pub links: Vec<LinkData>,
    pub joints: Vec<JointData>,
    pub cycles: Vec<CycleData>,
    pub shapes: Vec<ShapeData>,
    /// `world_from_link` at the pose analysed.
    pub home: Vec<Pose>,
    /// What links and joints do where no motion is shown.
    pub roles: RoleData,
    pub palette: Palette,
    pub branches: Vec<BranchData>,
    /// Why nothing moves at all, where nothing does.
    pub still: Option<String>,
    pub motions: Vec<MotionData>,
    /// Points of links whose paths were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<PointData>,
}

#[derive(Debug, Serialize)]
pub struct PointData {
    pub name: String,
    pub link: usize,
    /// In the frame that the link is drawn by (m).
    pub at: [f64; 3],
}

#[derive(Debug, Serialize)]
pub struct LinkData {
    pub name: String,
    /// Where its drawn frame stands in its own (m); at its origin if `None`. All its poses and shapes are told by that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub origin: Option<[f64; 3]>,
}

#[derive(Debug, Serialize)]
pub struct JointData {
    pub name: String,
    pub class: String,
    pub kind: String,
    pub links: [usize; 2],
    /// Column of its first variable.
    pub first: usize,
    pub variables: Vec<VariableData>,
}

#[derive(Debug, Serialize)]
pub struct VariableData {
    pub name: String,
    pub unit: &'static str,
}

#[derive(Debug, Serialize)]
pub struct CycleData {
    pub name: String,
    pub joints: Vec<usize>,
}

#[derive(Debug, Serialize)]
pub struct ShapeData {
    pub link: usize,
    /// The joint whose symbol or axis it is.
    pub joint: Option<usize>,
    /// Whether it is the joint's axis.
    pub axis: bool,
    pub kind: &'static str,
    /// Extension along its own axes (m).
    pub size: [f64; 3],
    /// `link_from_shape`.
    pub pose: Pose,
}

/// Colours as `#rrggbb`.
#[derive(Debug, Serialize)]
pub struct Palette {
    pub ground: String,
    pub locked: String,
    pub idle: String,
    pub driven: String,
    pub moving_joint: String,
    pub axis: String,
    pub moving_links: Vec<String>,
}

#[derive(Debug, Serialize)]
pub struct BranchData {
    pub name: String,
    pub dimension: usize,
    /// Indices of its motions.
    pub motions: Vec<usize>,
    /// Why none is shown.
    pub still: Option<String>,
}

/// One curve. Numbers of samples are little-endian `f32` in base64: a ten-millionth of the mechanism is nothing to the eye.
#[derive(Debug, Serialize)]
pub struct MotionData {
    pub branch: usize,
    pub closed: bool,
    pub samples: usize,
    pub arclengths: String,
    /// All joint variables of every sample.
    pub values: String,
    /// `world_from_link` of every link of every sample.
    pub poses: String,
    /// The sample it starts at.
    pub start: usize,
    /// Columns that can be driven; the first is.
    pub drives: Vec<usize>,
    pub held: Vec<HeldData>,
    pub roles: RoleData,
    pub events: Vec<EventData>,
    pub length_unit: f64,
}

#[derive(Debug, Serialize)]
pub struct HeldData {
    pub column: usize,
    pub value: f64,
}

/// By index: `ground`, `driven`, `moving`, `locked` or `idle`.
#[derive(Debug, Serialize)]
pub struct RoleData {
    pub links: Vec<&'static str>,
    pub joints: Vec<&'static str>,
}

#[derive(Debug, Serialize)]
pub struct EventData {
    pub arclength: f64,
    /// The sample there.
    pub sample: usize,
    pub kind: &'static str,
    /// Column of the variable it is about.
    pub column: Option<usize>,
    /// Whether it is the pose analysed.
    pub home: bool,
    pub text: String,
}
