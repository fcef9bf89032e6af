//! Assemblies of CAD programs: parts where they were drawn, and joints between frames on them.
//!
//! Both formats that are read, ASMT ([`asmt`]) and FreeCAD's documents ([`freecad`]), say the same in different words, so both become an
//! [`Assembly`] first. Every joint has a frame on each of its parts, and none of them places a part: parts stand where the file draws
//! them, and all joints close loops. What the drawn places miss is then seen, and not taken over.
//!
//! | joint of the file, between frames I and J | here |
//! |---|---|
//! | Fixed, Revolute, Cylindrical, Slider, Ball, Universal, Planar | the kind of that name |
//! | Parallel; no rotation | Schönflies motion about the common direction; all translations |
//! | a point in a plane, a point in a line, a line in a plane | the kind of that name |
//! | Perpendicular, Angle | translations, a turn about one direction, and a turn about the other at that angle |
//! | a rod between balls | a distance |
//! | a rod between hinges, cylindrical joints and balls | that rod as a link, and its two joints |
//! | Screw between two parts with a cylindrical joint | a screw joint |
//! | Screw, RackPinion, Gears, Belt | a coupling of the joints that bear the two parts |

mod asmt;
mod blocks;
mod couplings;
mod freecad;
mod joints;

pub(super) use asmt::{is_asmt, read as read_asmt};
pub(super) use freecad::{document, is_document, read as read_freecad};

use super::error::{Fault, Outcome};
use super::kept::Kept;
use super::names::unused;
use super::reader::{counted_skips, counted_warnings};
use super::unread::Tally;
use super::{Reading, WarningKind};
use kutzbach_math::number::Number;
use kutzbach_math::space::Rigid;
use kutzbach_model::mechanism::{Entity, Frame, MechanismBuilder};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A part as it is drawn; the first one of an assembly is the ground.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) name: String,
    /// Where it is drawn, in the assembly.
    pub(super) frame: Frame,
    pub(super) range: Range<usize>,
}

/// One side of a joint: a part and a frame on it.
#[derive(Clone, Debug)]
pub(super) struct Side {
    pub(super) part: usize,
    /// Whether this frame is known with its own digits is up to the reader: it is used as it stands.
    pub(super) frame: Frame,
}

/// How a rod of a composite joint is held at one of its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Revolute,
    Cylindrical,
    Ball,
}

/// What a joint of a CAD program says of its two frames. The axes are their z axes.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    Fixed,
    Revolute,
    Cylindrical,
    Slider,
    Ball,
    Universal,
    /// The plane of J at this height above that of I (m).
    Planar(Number),
    /// J's origin in the plane at this height above I's (m).
    PointInPlane(Number),
    /// J's z axis in that plane (m).
    LineInPlane(Number),
    /// J's origin on I's z axis.
    PointInLine,
    Parallel,
    NoRotation,
    /// Between the two z axes (rad).
    Angle(Number),
    /// A rod of this length from I's axis to J (m).
    Rod([End; 2], Number),
    /// Metres per turn.
    Screw(Number),
    /// J, a pinion of this radius (m), rolls along the x axis of I.
    Rack(Number),
    /// Radii; a belt's second one is negative.
    Gears([Number; 2]),
}

/// A joint between frames I and J.
#[derive(Clone, Debug)]
pub(super) struct CadJoint {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) sides: [Side; 2],
    pub(super) range: Range<usize>,
    /// Bounds of the rotation (rad) and of the translation (m) of J seen from I.
    pub(super) limits: [Bounds; 2],
    pub(super) is_driven: bool,
}

/// A lower and an upper bound.
pub(super) type Bounds = [Option<Number>; 2];

/// Everything that a file says.
#[derive(Default)]
pub(super) struct Assembly<'a> {
    pub(super) name: String,
    pub(super) parts: Vec<Part>,
    pub(super) joints: Vec<CadJoint>,
    pub(super) warnings: Vec<(usize, WarningKind, String)>,
    pub(super) unread: Tally<'a>,
}

/// A joint of one freedom, which gears, racks and screws may couple.
struct Mover {
    name: String,
    /// Predecessor and successor.
    parts: [usize; 2],
    turns: bool,
    /// Along its axis, in the assembly as it is drawn.
    axis: [f64; 3],
    /// Its variable as drawn (rad, m).
    home: f64,
    /// The largest number that this was computed from: a turn from components of directions, a slide from coordinates (m).
    size: f64,
}

struct Maker<'a> {
    builder: MechanismBuilder,
    assembly: Assembly<'a>,
    /// Where parts are drawn, in doubles; also of links that are added to them.
    poses: Vec<Rigid<f64>>,
    links: Vec<String>,
    taken: BTreeSet<String>,
    /// Where what has a name is written.
    places: BTreeMap<String, Range<usize>>,
    movers: Vec<Mover>,
    /// Parts that are one body, as a forest of indices.
    body: Vec<usize>,
}

/// Makes the mechanism of an assembly.
///
/// # Errors
/// What contradicts itself, with its place.
pub(super) fn mechanism(
    assembly: Assembly<'_>,
    text: &str,
    format: &'static str,
) -> Result<Reading, Vec<Fault>> {
    let mut maker = Maker {
        builder: MechanismBuilder::new(&assembly.name),
        poses: Vec::new(),
        links: Vec::new(),
        taken: BTreeSet::new(),
        places: BTreeMap::new(),
        movers: Vec::new(),
        body: Vec::new(),
        assembly,
    };
    maker.all().map_err(|fault| vec![fault])?;
    maker.finish(text, format)
}

impl Maker<'_> {
    fn all(&mut self) -> Outcome<()> {
        for part in std::mem::take(&mut self.assembly.parts) {
            self.add_link(&part.name, part.frame, part.range);
        }
        let joints = std::mem::take(&mut self.assembly.joints);
        for joint in &joints {
            self.join(joint, &joints)?;
        }
        for joint in &joints {
            self.couple(joint, &joints)?;
        }
        Ok(())
    }

    /// A name that nothing has yet, and this has from now on.
    fn take_name(&mut self, wanted: &str) -> String {
        let name = unused(wanted, |name| self.taken.contains(name));
        self.taken.insert(name.clone());
        name
    }

    /// Adds a link where it is drawn; its index.
    fn add_link(&mut self, wanted: &str, frame: Frame, range: Range<usize>) -> usize {
        let name = self.take_name(wanted);
        let index = self.links.len();
        self.builder.link(&name);
        self.poses.push(frame.to_doubles());
        if let Some(ground) = self.links.first() {
            let placed = format!("{name} as drawn");
            self.taken.insert(placed.clone());
            self.builder.floating(&placed, ground, &name, frame);
        }
        self.places.insert(name.clone(), range);
        self.links.push(name);
        self.body.push(index);
        index
    }

    /// What is not read although it constrains.
    fn not_read(&mut self, joint: &CadJoint, why: &str) {
        let message = format!(
            "joint `{}` is not read, and it constrains: {why}",
            joint.name
        );
        self.assembly
            .warnings
            .push((joint.range.start, WarningKind::MayJoin, message));
    }

    /// The body that a part belongs to.
    fn body_of(&self, part: usize) -> usize {
        let mut at = part;
        while self.body[at] != at {
            at = self.body[at];
        }
        at
    }

    fn finish(self, text: &str, format: &'static str) -> Result<Reading, Vec<Fault>> {
        let mechanism = self.builder.build().map_err(|error| {
            let place = match &error.entity {
                Entity::Link(name) | Entity::Joint(name) | Entity::Coupling(name) => {
                    self.places.get(name)
                }
                _ => None,
            };
            let range = place.cloned().unwrap_or(0..0);
            vec![Fault::new(range, error.to_string()).maybe_help(error.help)]
        })?;
        Ok(Reading {
            mechanism,
            warnings: counted_warnings(text, self.assembly.warnings),
            skipped: counted_skips(text, self.assembly.unread),
            format,
            kept: Kept::default(),
            expect_at: None,
        })
    }
}
