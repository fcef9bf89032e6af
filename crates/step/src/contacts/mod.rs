//! Faces of different parts that touch, and the joints that they make.

mod boxes;
mod joint;
mod overlap;
mod settle;
mod touch;

use crate::shape::{Assembly, Face};
use boxes::{Bounds, meeting, touching};
use nalgebra::Vector3;
use touch::touch;

pub use joint::{Joint, JointError, joint_of};

/// What counts as touching.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactOptions {
    /// The largest distance (m) between two faces that touch: between radii, planes, axes, centres. Parts may also lie in each
    /// other by as much. Of a small pin or ball no more than a quarter of its radius counts.
    pub clearance: f64,
    /// How far points may be from where they should be (m), besides what the file states.
    pub accuracy: f64,
    /// The smallest angle (rad) about the axis that both faces of a cylindrical contact must cover: the rounded corner of a part
    /// in that of another, a quarter turn, is no bearing.
    pub least_turn: f64,
}

impl Default for ContactOptions {
    /// 0.2 mm, a nanometre, 115 degrees.
    fn default() -> Self {
        Self {
            clearance: 2e-4,
            accuracy: 1e-9,
            least_turn: 2.0,
        }
    }
}

/// What a contact lets through, while its faces stay on each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ContactKind {
    /// A pin in a hole: C.
    Cylindrical,
    /// A plane on a plane: G.
    Planar,
    /// A ball in a socket: S.
    Spherical,
    /// A cone in a cone: R.
    Conical,
}

impl ContactKind {
    /// Its name in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cylindrical => "cylindrical",
            Self::Planar => "planar",
            Self::Spherical => "spherical",
            Self::Conical => "conical",
        }
    }
}

/// Two faces that touch, in the frame of the assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// The part of the first face, by its place in [`Assembly::parts`].
    pub first: usize,
    /// The part of the second face.
    pub second: usize,
    /// What kind of contact it is.
    pub kind: ContactKind,
    /// Unit direction of the axis; of planes the normal, out of the first part. For balls without meaning: (0, 0, 1).
    pub axis: Vector3<f64>,
    /// A point of the contact (m): the middle of the axis where both faces are, the centre of a ball, the apex of a cone, about
    /// the centroid of the common area of planes.
    pub point: Vector3<f64>,
    /// How much room there is between the faces (m): the difference of radii, the distance of planes. Negative where the parts
    /// lie in each other, as in a press fit. Of a cone it is measured across its lines.
    pub clearance: f64,
    /// How far the two faces are from sharing an axis, centre or direction (m).
    pub misfit: f64,
    /// How large the contact is (m): the common length of cylinders and cones, the root of the common area of planes, the radius
    /// of a ball.
    pub size: f64,
    /// The numbers of the entities of both faces.
    pub faces: (u64, u64),
}

/// Two parts that touch.
#[derive(Clone, Debug, PartialEq)]
pub struct PairOfParts {
    /// The first part, by its place in [`Assembly::parts`].
    pub first: usize,
    /// The second part; greater than the first.
    pub second: usize,
    /// Their contacts, at least one.
    pub contacts: Vec<Contact>,
}

/// A face in the frame of the assembly with the box around it.
struct Placed {
    face: Face,
    bounds: Bounds,
}

/// The pairs of parts whose faces touch, in ascending order of both parts. Parts whose faces make no contact of the four kinds
/// (lines on planes, gears, cams, threads) are not among them.
pub fn contacts(assembly: &Assembly, options: &ContactOptions) -> Vec<PairOfParts> {
    let accuracy = options.accuracy.max(assembly.accuracy);
    let options = ContactOptions {
        accuracy,
        ..*options
    };
    let margin = options.clearance + accuracy;
    let parts: Vec<Vec<Placed>> = assembly
        .parts
        .iter()
        .map(|part| {
            let faces = part.faces.iter().filter_map(|face| {
                let face = face.moved(&part.pose);
                let bounds = Bounds::of_face(&face)?;
                Some(Placed { face, bounds })
            });
            faces.collect()
        })
        .collect();
    let bounds: Vec<Option<Bounds>> = parts
        .iter()
        .map(|faces| around(faces, margin / 2.0))
        .collect();
    let mut pairs = Vec::new();
    for (first, second) in touching(&bounds) {
        let (Some(one), Some(two)) = (parts.get(first), parts.get(second)) else {
            continue;
        };
        let contacts = between((first, one.as_slice()), (second, two.as_slice()), &options);
        if !contacts.is_empty() {
            pairs.push(PairOfParts {
                first,
                second,
                contacts,
            });
        }
    }
    pairs
}

/// The box around all faces of a part, larger by `margin` (m).
fn around(faces: &[Placed], margin: f64) -> Option<Bounds> {
    let mut boxes = faces.iter().map(|placed| placed.bounds);
    let first = boxes.next()?;
    Some(boxes.fold(first, Bounds::union).grown(margin))
}

/// The faces whose boxes meet another.
fn near<'p>(faces: &'p [Placed], around: &Bounds) -> Vec<&'p Placed> {
    let near = |placed: &&Placed| placed.bounds.meets(around);
    faces.iter().filter(near).collect()
}

/// The contacts between two parts, each given by its place and its faces.
fn between(
    first: (usize, &[Placed]),
    second: (usize, &[Placed]),
    options: &ContactOptions,
) -> Vec<Contact> {
    let margin = options.clearance + options.accuracy;
    let boxes = (around(first.1, margin), around(second.1, margin));
    let (Some(around_first), Some(around_second)) = boxes else {
        return Vec::new();
    };
    let (ones, twos) = (near(first.1, &around_second), near(second.1, &around_first));
    let wide: Vec<Bounds> = ones.iter().map(|one| one.bounds.grown(margin)).collect();
    let own: Vec<Bounds> = twos.iter().map(|two| two.bounds).collect();
    let mut contacts = Vec::new();
    for (one, two) in meeting(&wide, &own) {
        let (Some(one), Some(two)) = (ones.get(one), twos.get(two)) else {
            continue;
        };
        if let Some(found) = touch(&one.face, &two.face, options) {
            contacts.push(Contact {
                first: first.0,
                second: second.0,
                kind: found.kind,
                axis: found.axis,
                point: found.point,
                clearance: found.clearance,
                misfit: found.misfit,
                size: found.size,
                faces: (one.face.entity, two.face.entity),
            });
        }
    }
    contacts
}
