//! What is read from a STEP file: parts with their places and faces, all in metres and radians.

use kutzbach_math::group::Pose;
use nalgebra::Vector3;
use std::sync::Arc;

/// An assembly: its parts, each once for every place where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    /// Metres in one unit of length of the file: 0.001 for millimetres. Of the first part, where parts differ.
    pub length_unit: f64,
    /// How far points of parts may be from where they should be in the assembly (m): as its contexts state, the largest of all,
    /// or more where the digits of its coordinates and directions leave more open. Zero where none is stated and the digits are those of doubles.
    pub accuracy: f64,
    /// How far coordinates of points may be off by the digits with which they are printed (m), as part of the accuracy. Zero where these are those of
    /// doubles, or a designer's own.
    pub printed: f64,
    /// How far directions may be from where they should be (rad), by the digits with which they are printed. Zero where these are those of doubles.
    pub tilt: f64,
    /// The schemas that the header names.
    pub schemas: Vec<String>,
    /// The parts, in the order in which the assembly names them.
    pub parts: Vec<Part>,
    /// The kinematic pairs between parts that the file says.
    pub pairs: Vec<KinematicPair>,
    /// The base of the file's mechanism, by its place in `parts`.
    pub base: Option<usize>,
    /// What was not read, and what was taken in one of several ways.
    pub notes: Vec<Note>,
}

/// A part at one place. What belongs to one product is taken as one rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The name of its product, made unique by a number behind it.
    pub name: String,
    /// The name of its product as it is written.
    pub product: String,
    /// The names of the occurrences that lead to it, from the whole assembly down; empty for a part that is no one's component.
    pub path: Vec<String>,
    /// Where it stands: `world_from_part`, with the translation in metres.
    pub pose: Pose,
    /// Its faces, in its own frame. Occurrences of one product share them.
    pub faces: Arc<Vec<Face>>,
}

/// A face of a part, in the frame of the part, in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// Its entity's number.
    pub entity: u64,
    /// Numbers of other entities that are parts of the same face, as the second half of a cylinder.
    pub halves: Vec<u64>,
    /// The surface on which it lies.
    pub surface: Surface,
    /// Where the material is.
    pub material: Side,
    /// The edges that bound it, as it passes them; none where its bounds are polygons or vertices. Those between its pieces are among them twice.
    pub edges: Vec<FaceEdge>,
    /// Its bounds as closed polygons (without a repeated corner), curved edges in steps of 15 degrees at most. Which of them is
    /// the outer one is not said: what is inside an odd number of them belongs to the face.
    pub outline: Vec<Vec<Vector3<f64>>>,
    /// For cylinders and cones, from where to where it goes along `direction`, from `point` or `apex` (m). (0, 0) otherwise.
    pub extent: (f64, f64),
    /// For cylinders and cones, the angle about the axis that it covers (rad), 2π where it goes around. Zero otherwise.
    pub turned: f64,
}

/// An edge as a face passes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceEdge {
    /// The number of its entity, by which faces share it.
    pub entity: u64,
    /// Its curve.
    pub curve: EdgeCurve,
    /// A point of it (m), away from its ends.
    pub at: Vector3<f64>,
    /// The unit direction in which the face passes it there: seen from outside of the material, the face is to the left. Zero where the edge has no
    /// length.
    pub along: Vector3<f64>,
}

/// The curve of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EdgeCurve {
    /// A straight line.
    Line,
    /// A circle, or an arc of one.
    Circle {
        /// Its centre (m).
        centre: Vector3<f64>,
        /// The unit direction of its axis.
        axis: Vector3<f64>,
        /// Its radius (m).
        radius: f64,
    },
    /// Another curve.
    Other,
}

/// The side of a face on which the material is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Inside the curvature: a pin, a ball. Planes are of this kind always: their normals point out of the material.
    Inside,
    /// Outside the curvature: a hole, a socket.
    Outside,
}

/// A surface, in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// A plane.
    Plane {
        /// A point of it.
        point: Vector3<f64>,
        /// Unit normal, out of the material.
        normal: Vector3<f64>,
    },
    /// A circular cylinder.
    Cylinder {
        /// A point of its axis.
        point: Vector3<f64>,
        /// Unit direction of its axis.
        direction: Vector3<f64>,
        /// Its radius.
        radius: f64,
    },
    /// A circular cone.
    Cone {
        /// Its apex.
        apex: Vector3<f64>,
        /// Unit direction of its axis, from the apex to where it is wide.
        direction: Vector3<f64>,
        /// The angle between its axis and its lines (rad).
        half_angle: f64,
    },
    /// A sphere.
    Sphere {
        /// Its centre.
        centre: Vector3<f64>,
        /// Its radius.
        radius: f64,
    },
    /// Another surface, by its keyword.
    Other(String),
}

/// A pair that a file says: two parts, and what they may do to each other.
#[derive(Clone, Debug, PartialEq)]
pub struct KinematicPair {
    /// Line of the file.
    pub line: usize,
    /// Number of its entity.
    pub entity: u64,
    /// Its two parts, by their places in [`Assembly::parts`], in the order of the pair.
    pub parts: (usize, usize),
    /// Its frame in the first and in the second part, as they stand: `assembly_from_pair` (m).
    pub frames: (Pose, Pose),
    /// What it lets through.
    pub motion: PairMotion,
}

/// What a kinematic pair lets through, about its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PairMotion {
    /// Translations along and rotations about x, y and z, each of them or not. Of two rotations the first is about an axis of the first
    /// frame, the second about one of the second frame.
    Free {
        /// Along x, y, z.
        translations: [bool; 3],
        /// About x, y, z.
        rotations: [bool; 3],
    },
    /// A turn about z with a translation along z.
    Screw {
        /// Metres per turn, right-handed positive.
        lead: f64,
    },
    /// Two gears: seen from what bears both, the second turns about its z by minus this many times the angle of the first about its own.
    Gears {
        /// Turns of the second for one of the first.
        ratio: f64,
    },
}

/// Something that the reader of a file should know.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Line of the file.
    pub line: usize,
    /// Number of the entity.
    pub entity: u64,
    /// What it can mean.
    pub kind: NoteKind,
    /// What was found.
    pub text: String,
}

/// What a [`Note`] can mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoteKind {
    /// Something that was not read and may touch another part: a contact may be missing.
    MayTouch,
    /// Something that says how parts are joined, and was not read.
    MayJoin,
    /// Something that was taken in one of several ways.
    Taken,
}
