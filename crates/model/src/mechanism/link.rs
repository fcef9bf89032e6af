//! A rigid link: its name, how it is placed at home, and what a simulation wants to know of it.

use super::frame::Frame;
use super::model::{JointId, LinkId};
use kutzbach_math::number::Number;

/// How the home pose of a link is known.
#[derive(Clone, Debug, PartialEq)]
pub enum Placement {
    /// The root of the file's tree: its frame is the world frame.
    World,
    /// Through a joint of the file's tree: `parent * origin * displacement`.
    Joint(JointId),
    /// By a pose relative to another link, without any constraint (a `floating` joint).
    Floating {
        /// Name of the file's `floating` joint.
        name: String,
        /// The link that the pose refers to.
        parent: LinkId,
        /// `parent_from_link`.
        origin: Frame,
    },
}

/// Mass properties, as in URDF.
#[derive(Clone, Debug, PartialEq)]
pub struct Inertial {
    /// Centre of mass and orientation of the inertia axes, relative to the link frame.
    pub origin: Frame,
    /// Mass in kilograms.
    pub mass: Number,
    /// `ixx ixy ixz iyy iyz izz` in kg m².
    pub inertia: [Number; 6],
}

/// A simple solid.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// Edge lengths in metres.
    Box([Number; 3]),
    /// Radius and length along z, in metres.
    Cylinder {
        /// Radius.
        radius: Number,
        /// Length.
        length: Number,
    },
    /// Radius of the ends and length of the cylindrical part along z, in metres.
    Capsule {
        /// Radius.
        radius: Number,
        /// Length.
        length: Number,
    },
    /// Radius in metres.
    Sphere(Number),
    /// A mesh file by name, with a scale.
    Mesh {
        /// The file's name as written.
        filename: String,
        /// Scale per axis.
        scale: Option<[Number; 3]>,
    },
}

/// A solid placed in a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// The shape's own name, if any.
    pub name: Option<String>,
    /// `link_from_shape`.
    pub origin: Frame,
    /// The solid.
    pub geometry: Geometry,
}

/// A rigid link.
#[derive(Clone, Debug)]
pub struct Link {
    /// Unique among links.
    pub name: String,
    /// How the home pose is known.
    pub placement: Placement,
    /// Mass properties, where the file states them.
    pub inertial: Option<Inertial>,
    /// Shapes for contact.
    pub collisions: Vec<Shape>,
    /// Shapes for pictures.
    pub visuals: Vec<Shape>,
}
