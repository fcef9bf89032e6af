//! ASMT, the text format of OndselSolver: a model with its parts, markers on them, joints between markers, motions and limits.
//!
//! The file names no unit of length; FreeCAD writes millimetres, others metres. Lengths are read as metres, which no count of freedoms
//! depends on. Angles are in radians.

use super::blocks::{Block, lines};
use super::{Assembly, CadJoint, End, Kind, Part, Side};
use crate::error::{Fault, Outcome};
use crate::frames::one_after_another;
use crate::quaternion::roll_pitch_yaw_of_rows;
use crate::words::{did_you_mean, quoted};
use crate::{ReadOptions, Reading, WarningKind};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::Frame;
use std::collections::BTreeMap;

/// Whether a text is ASMT: its second line is its model.
pub(crate) fn is_asmt(text: &str) -> bool {
    let mut said = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let first = said.next().unwrap_or_default();
    !first.starts_with('<') && said.next() == Some("Assembly")
}

/// Reads ASMT.
///
/// # Errors
/// The first fault, with its place.
pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<Reading, Vec<Fault>> {
    if let Some(fault) = options.without_measures("ASMT") {
        return Err(vec![fault]);
    }
    let mut reader = Reader::default();
    reader.all(text).map_err(|fault| vec![fault])?;
    let Reader { assembly, .. } = reader;
    if options.strict {
        let faults = assembly.unread.faults(text);
        if !faults.is_empty() {
            return Err(faults);
        }
    }
    super::mechanism(assembly, text, "asmt")
}

/// What is read, and what paths stand for.
#[derive(Default)]
struct Reader<'a> {
    assembly: Assembly<'a>,
    markers: BTreeMap<String, Side>,
    /// Indices of joints.
    joints: BTreeMap<String, usize>,
}

/// Blocks of an assembly that say nothing about how it moves.
const STANDARD: [&str; 14] = [
    "Notes",
    "Name",
    "Position3D",
    "RotationMatrix",
    "Velocity3D",
    "Omega3D",
    "RefPoints",
    "RefCurves",
    "RefSurfaces",
    "Parts",
    "ConstraintSets",
    "ConstantGravity",
    "SimulationParameters",
    "AnimationParameters",
];

impl<'a> Reader<'a> {
    fn all(&mut self, text: &'a str) -> Outcome<()> {
        let lines = lines(text);
        let model = lines
            .get(1..)
            .and_then(Block::first)
            .ok_or_else(|| Fault::new(0..text.len().min(1), "the model is empty"))?;
        let name = model.required("Name")?.word();
        self.assembly.name = name.to_owned();
        let path = format!("/{name}");
        self.part(&model, name, &path)?;
        let parts = model.block("Parts");
        for part in parts.iter().flat_map(Block::blocks) {
            let name = part.required("Name")?.word();
            self.part(&part, name, &format!("{path}/{name}"))?;
        }
        for block in model.blocks() {
            if !STANDARD.contains(&block.word()) && block.blocks().next().is_some() {
                let what = format!("{}: {}", block.word(), kinds_in(&block));
                self.assembly.unread.text(block.range().start, what);
            }
        }
        if let Some(sets) = model.block("ConstraintSets") {
            for set in sets.blocks() {
                self.set(&set, &path)?;
            }
        }
        let unit = "the file names no unit of length: its numbers are read as metres";
        let kind = WarningKind::ReadersDiffer {
            what: "lengths".to_owned(),
        };
        self.assembly
            .warnings
            .push((model.range().start, kind, unit.to_owned()));
        Ok(())
    }

    /// A part, or the model itself, which is the ground; and its markers.
    fn part(&mut self, block: &Block<'a, '_>, name: &str, path: &str) -> Outcome<()> {
        let index = self.assembly.parts.len();
        let drawn = match index {
            0 => Frame::identity(),
            _ => frame(block)?,
        };
        self.assembly.parts.push(Part {
            name: name.to_owned(),
            frame: drawn,
            range: block.range(),
        });
        let points = block.block("RefPoints");
        for point in points.iter().flat_map(Block::blocks) {
            let at = frame(&point)?;
            let markers = point.block("Markers");
            for marker in markers.iter().flat_map(Block::blocks) {
                let own = frame(&marker)?;
                let name = marker.required("Name")?.word();
                let side = Side {
                    part: index,
                    frame: one_after_another(&at, &own),
                };
                self.markers.insert(format!("{path}/{name}"), side);
            }
        }
        Ok(())
    }

    fn set(&mut self, set: &Block<'a, '_>, path: &str) -> Outcome<()> {
        for item in set.blocks() {
            match set.word() {
                "Joints" => self.joint(&item, path)?,
                "Limits" => self.limit(&item)?,
                "Motions" => self.motion(&item)?,
                _ => {
                    let message =
                        format!("{} is not read, and it may constrain", quoted(item.word()));
                    let at = item.range().start;
                    self.assembly
                        .warnings
                        .push((at, WarningKind::MayJoin, message));
                }
            }
        }
        Ok(())
    }

    fn side(&self, joint: &Block<'a, '_>, word: &str) -> Outcome<Side> {
        let said = joint.required(word)?;
        self.markers.get(said.word()).cloned().ok_or_else(|| {
            let known = self.markers.keys().map(String::as_str);
            said.fault(format!("there is no marker {}", quoted(said.word())))
                .maybe_help(did_you_mean(said.word(), known, ("`", "`")))
        })
    }

    fn joint(&mut self, block: &Block<'a, '_>, path: &str) -> Outcome<()> {
        // A name may be an empty line.
        let name = block.said("Name").map_or(block.word(), |name| name.word());
        let Some(kind) = kind(block)? else {
            let message = format!(
                "joint {} is not read, and it constrains: nothing here is a {}",
                quoted(name),
                block.word()
            );
            let at = block.range().start;
            self.assembly
                .warnings
                .push((at, WarningKind::MayJoin, message));
            return Ok(());
        };
        let sides = [self.side(block, "MarkerI")?, self.side(block, "MarkerJ")?];
        let index = self.assembly.joints.len();
        self.joints.insert(format!("{path}/{name}"), index);
        self.assembly.joints.push(CadJoint {
            name: name.to_owned(),
            kind,
            sides,
            range: block.range(),
            limits: Default::default(),
            is_driven: false,
        });
        Ok(())
    }

    /// The joint that a limit or a motion is about.
    fn joint_of(&mut self, block: &Block<'a, '_>) -> Option<&mut CadJoint> {
        let named = block.said("MotionJoint")?;
        let index = self.joints.get(named.word())?;
        self.assembly.joints.get_mut(*index)
    }

    fn limit(&mut self, block: &Block<'a, '_>) -> Outcome<()> {
        let which = match block.word() {
            "RotationLimit" => 0,
            "TranslationLimit" => 1,
            other => {
                let what = format!("limit {}", quoted(other));
                self.assembly.unread.text(block.range().start, what);
                return Ok(());
            }
        };
        let at = block.required("Limit")?;
        let lower = block.required("Type")?.word() == "=>";
        let value = Number::decimal(at.word());
        let start = block.range().start;
        match (self.joint_of(block), value) {
            (Some(joint), Ok(value)) => joint.limits[which][usize::from(!lower)] = Some(value),
            _ => {
                let what = "limit by a formula or of no joint".to_owned();
                self.assembly.unread.text(start, what);
            }
        }
        Ok(())
    }

    fn motion(&mut self, block: &Block<'a, '_>) -> Outcome<()> {
        let single = matches!(block.word(), "RotationalMotion" | "TranslationalMotion");
        let start = block.range().start;
        match self.joint_of(block).filter(|_| single) {
            Some(joint) => joint.is_driven = true,
            None => {
                let what = format!("motion {}", quoted(block.word()));
                self.assembly.unread.text(start, what);
            }
        }
        Ok(())
    }
}

/// The kinds of blocks inside one.
fn kinds_in(block: &Block<'_, '_>) -> String {
    let mut words: Vec<&str> = block.blocks().map(|inner| inner.word()).collect();
    words.sort_unstable();
    words.dedup();
    words.truncate(3);
    words.join(", ")
}

/// Where something is in what it belongs to.
fn frame(block: &Block<'_, '_>) -> Outcome<Frame> {
    let mut frame = Frame::identity();
    if let Some(position) = block.said("Position3D") {
        frame.position = position.numbers()?;
    }
    if let Some(matrix) = block.block("RotationMatrix") {
        let rows: Vec<[Number; 3]> = matrix
            .blocks()
            .map(|row| row.numbers())
            .collect::<Outcome<_>>()?;
        let rows: [[Number; 3]; 3] = rows
            .try_into()
            .map_err(|_| matrix.fault("a rotation matrix has three rows"))?;
        frame.roll_pitch_yaw = roll_pitch_yaw_of_rows(&rows).ok_or_else(|| {
            matrix.fault("these rows are no rotation: their columns are not orthonormal")
        })?;
    }
    Ok(frame)
}

/// What a joint says of its markers; none of a kind that is unknown.
fn kind(block: &Block<'_, '_>) -> Outcome<Option<Kind>> {
    let number =
        |word: &str| -> Outcome<Number> { Ok(block.number(word)?.unwrap_or_else(Number::zero)) };
    let rod = |ends: [End; 2]| -> Outcome<Kind> { Ok(Kind::Rod(ends, number("distanceIJ")?)) };
    Ok(Some(match block.word() {
        "FixedJoint" => Kind::Fixed,
        "RevoluteJoint" => Kind::Revolute,
        "CylindricalJoint" => Kind::Cylindrical,
        "TranslationalJoint" => Kind::Slider,
        "SphericalJoint" | "AtPointJoint" => Kind::Ball,
        "UniversalJoint" => Kind::Universal,
        "PlanarJoint" => Kind::Planar(number("offset")?),
        "PointInPlaneJoint" => Kind::PointInPlane(number("offset")?),
        "LineInPlaneJoint" => Kind::LineInPlane(number("offset")?),
        "PointInLineJoint" => Kind::PointInLine,
        "ParallelAxesJoint" => Kind::Parallel,
        "NoRotationJoint" => Kind::NoRotation,
        "PerpendicularJoint" => Kind::Angle(super::joints::quarter()),
        "AngleJoint" => Kind::Angle(number("theIzJz")?),
        "RevRevJoint" => rod([End::Revolute, End::Revolute])?,
        "RevCylJoint" => rod([End::Revolute, End::Cylindrical])?,
        "CylSphJoint" => rod([End::Cylindrical, End::Ball])?,
        "SphSphJoint" => rod([End::Ball, End::Ball])?,
        "ScrewJoint" => Kind::Screw(number("pitch")?),
        "RackPinionJoint" => Kind::Rack(number("pitchRadius")?),
        "GearJoint" => Kind::Gears([number("radiusI")?, number("radiusJ")?]),
        _ => return Ok(None),
    }))
}
