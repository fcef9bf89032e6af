//! FreeCAD's documents: the joints of an assembly, without its shapes.
//!
//! A document is a zip file whose `Document.xml` lists objects and their properties. A joint names an element of each of its parts
//! by a path of objects ([`super::references`]), and keeps the frame on the object that the path ends in, offsets included, so no shape is needed. Where the kind of a joint
//! depends on shapes (a distance between faces), or an object on the way lies in another file, the joint is told as not read.
//!
//! Lengths are millimetres, angles degrees, quaternions x, y, z, w. Source: FreeCAD 1.0 and 1.1, what its Assembly workbench writes.

use super::objects::{Object, Objects, objects, placement};
use super::references::follow;
use super::{Assembly, CadJoint, End, Kind, Part, Side};
use crate::element::Element;
use crate::error::{Fault, Outcome};
use crate::frames::one_after_another;
use crate::words::quoted;
use crate::{ReadOptions, Reading, WarningKind, xml};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::Frame;
use std::collections::{BTreeMap, BTreeSet};

/// The file inside a document.
const DOCUMENT: &str = "Document.xml";

/// The text of `Document.xml` in a zip file; none where there is no such file.
///
/// # Errors
/// A zip file that cannot be unpacked, or whose document is too large or no text.
pub(crate) fn document(bytes: &[u8]) -> Outcome<Option<String>> {
    use std::io::Read as _;
    let broken =
        |error: String| Fault::new(0..0, format!("the zip file cannot be unpacked: {error}"));
    let mut archive =
        zip::ZipArchive::new(std::io::Cursor::new(bytes)).map_err(|e| broken(e.to_string()))?;
    let file = match archive.by_name(DOCUMENT) {
        Ok(file) => file,
        Err(zip::result::ZipError::FileNotFound) => return Ok(None),
        Err(error) => return Err(broken(error.to_string())),
    };
    let mut unpacked = Vec::new();
    // What a file says of its size is not believed.
    file.take(crate::guard::most_bytes().saturating_add(1))
        .read_to_end(&mut unpacked)
        .map_err(|error| broken(error.to_string()))?;
    if let Some(fault) = crate::guard::size_fault(unpacked.len() as u64) {
        return Err(fault);
    }
    String::from_utf8(unpacked)
        .map(Some)
        .map_err(|_| broken(format!("{DOCUMENT} is no UTF-8 text")))
}

/// Whether a text is the document of FreeCAD.
pub(crate) fn is_document(text: &str) -> bool {
    xml::root_name(text) == "Document"
}

/// Reads the text of a document.
///
/// # Errors
/// The first fault, with its place.
pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<Reading, Vec<Fault>> {
    let one = |fault| vec![fault];
    if let Some(fault) = options.without_measures("FreeCAD") {
        return Err(one(fault));
    }
    let parsed = xml::parse(text).map_err(one)?;
    let root = Element::root(&parsed, text);
    let mut reader = Reader {
        objects: objects(root).map_err(one)?,
        assembly: Assembly::default(),
        parts: BTreeMap::new(),
    };
    reader.all(root).map_err(one)?;
    if options.strict {
        let faults = reader.assembly.unread.faults(text);
        if !faults.is_empty() {
            return Err(faults);
        }
    }
    super::mechanism(reader.assembly, text, "freecad")
}

struct Reader<'a> {
    objects: Objects<'a>,
    assembly: Assembly<'a>,
    /// Indices of parts by the names of their objects.
    parts: BTreeMap<&'a str, usize>,
}

/// What a reference of a joint ends in.
enum Found {
    Side(Side, &'static str),
    /// It cannot be followed, and why.
    Lost(&'static str),
}

impl<'a> Reader<'a> {
    fn all(&mut self, root: Element<'a>) -> Outcome<()> {
        let assemblies: Vec<&'a str> =
            self.named(|object| object.kind == "Assembly::AssemblyObject");
        let inside: BTreeSet<&str> = assemblies
            .iter()
            .flat_map(|name| self.objects[name].links("Group"))
            .collect();
        let mut outer = assemblies.iter().filter(|name| !inside.contains(*name));
        let Some(&name) = outer.next() else {
            return Err(root
                .fault("the document holds no assembly")
                .help("join the parts in FreeCAD's Assembly workbench (1.0 or later)"));
        };
        for other in assemblies.iter().filter(|other| **other != name) {
            let start = self.objects[other].element.start();
            let what = "another assembly of the document, or one that is rigid inside".to_owned();
            self.assembly.unread.text(start, what);
        }
        let object = &self.objects[name];
        self.assembly.name = object.label(name).to_owned();
        self.assembly.parts.push(Part {
            name: self.assembly.name.clone(),
            frame: Frame::identity(),
            range: object.element.range(),
        });
        self.parts.insert(name, 0);
        for joint in self.joints_of(name) {
            self.joint(joint, name)?;
        }
        self.note_loose(name);
        Ok(())
    }

    fn named(&self, which: impl Fn(&Object<'a>) -> bool) -> Vec<&'a str> {
        let found = self.objects.iter().filter(|(_, object)| which(object));
        found.map(|(name, _)| *name).collect()
    }

    /// Joints in the groups of joints of an assembly, in their order, each once however often it is listed.
    fn joints_of(&self, assembly: &str) -> Vec<&'a str> {
        let groups = self.objects[assembly].links("Group");
        let mut known = BTreeSet::new();
        groups
            .into_iter()
            .filter_map(|name| self.objects.get(name))
            .filter(|object| object.kind == "Assembly::JointGroup")
            .flat_map(|object| object.links("Group"))
            .filter(|name| self.objects.contains_key(name) && known.insert(*name))
            .collect()
    }

    /// Parts that no joint names are not links: FreeCAD leaves them where they are.
    fn note_loose(&mut self, assembly: &str) {
        for name in self.objects[assembly].links("Group") {
            let Some(object) = self.objects.get(name) else {
                continue;
            };
            let is_part = object.properties.contains_key("Placement")
                // Groups of FreeCAD name joints too, and one that grounds has a placement.
                && !object.properties.contains_key("ObjectToGround")
                && object.kind != "Assembly::JointGroup"
                && !object.kind.starts_with("App::Origin");
            if is_part && !self.parts.contains_key(name) {
                let what = "part that no joint names".to_owned();
                self.assembly.unread.text(object.element.start(), what);
            }
        }
    }

    fn joint(&mut self, name: &'a str, assembly: &'a str) -> Outcome<()> {
        let object = &self.objects[name];
        let start = object.element.start();
        let off =
            object.says("Activated") == Some(false) || object.says("Suppressed") == Some(true);
        if off {
            let what = "joint that is switched off".to_owned();
            self.assembly.unread.text(start, what);
            return Ok(());
        }
        if let Some(grounded) = object.inner("ObjectToGround") {
            let target = grounded
                .attribute("value")
                .or_else(|| grounded.attribute("name"));
            return match target {
                Some(target) => self.ground(name, target.value),
                None => Ok(()),
            };
        }
        let Some(kind) = object.joint_type() else {
            self.assembly
                .unread
                .text(start, "object among the joints".to_owned());
            return Ok(());
        };
        let mut sides = Vec::new();
        let mut elements = Vec::new();
        for number in ["1", "2"] {
            match self.side(name, number, assembly)? {
                Found::Side(side, element) => {
                    sides.push(side);
                    elements.push(element);
                }
                Found::Lost(why) => {
                    self.lost(name, why);
                    return Ok(());
                }
            }
        }
        let (Ok(sides), [one, other]) = (<[Side; 2]>::try_from(sides), &elements[..]) else {
            return Ok(());
        };
        let Some(kind) = self.kind(name, kind, [one, other])? else {
            let why = "what it means depends on shapes, or is not known";
            self.lost(name, why);
            return Ok(());
        };
        let object = &self.objects[name];
        let limits = [
            self.bounds(object, "Angle")?,
            self.bounds(object, "Length")?,
        ];
        if matches!(kind, Kind::Cylindrical) && limits.iter().flatten().any(Option::is_some) {
            let what = "limit of a cylindrical joint".to_owned();
            self.assembly.unread.text(start, what);
        }
        self.assembly.joints.push(CadJoint {
            name: object.label(name).to_owned(),
            kind,
            sides,
            range: object.element.range(),
            limits,
            is_driven: false,
        });
        Ok(())
    }

    fn lost(&mut self, joint: &'a str, why: &str) {
        let object = &self.objects[joint];
        let label = object.label(joint);
        let message = format!(
            "joint {} is not read, and it constrains: {why}",
            quoted(label)
        );
        let at = object.element.start();
        self.assembly
            .warnings
            .push((at, WarningKind::MayJoin, message));
    }

    fn bounds(&self, object: &Object<'a>, what: &str) -> Outcome<super::Bounds> {
        let bound = |end: &str| -> Outcome<Option<Number>> {
            if object.says(&format!("Enable{what}{end}")) != Some(true) {
                return Ok(None);
            }
            let property = format!("{what}{end}");
            Ok(Some(match what {
                "Angle" => object.angle(&property)?,
                _ => object.length(&property)?,
            }))
        };
        Ok([bound("Min")?, bound("Max")?])
    }

    /// Holds a part where it is drawn.
    fn ground(&mut self, joint: &'a str, part: &str) -> Outcome<()> {
        let Some((&name, _)) = self.objects.get_key_value(part) else {
            self.lost(joint, "the part that it holds is not in the document");
            return Ok(());
        };
        let index = self.part(name, None)?;
        let object = &self.objects[joint];
        let held = self.assembly.parts[index].frame.clone();
        let side = |part: usize, frame: Frame| Side { part, frame };
        self.assembly.joints.push(CadJoint {
            name: object.label(joint).to_owned(),
            kind: Kind::Fixed,
            sides: [side(0, held), side(index, Frame::identity())],
            range: object.element.range(),
            limits: Default::default(),
            is_driven: false,
        });
        Ok(())
    }

    /// The index of the part that an object is, which may be an element of an array.
    fn part(&mut self, name: &'a str, array: Option<&'a str>) -> Outcome<usize> {
        if let Some(index) = self.parts.get(name) {
            return Ok(*index);
        }
        let object = &self.objects[name];
        let mut frame = object.placement()?;
        if let Some(array) = array {
            frame = one_after_another(&self.objects[array].placement()?, &frame);
        }
        let index = self.assembly.parts.len();
        self.assembly.parts.push(Part {
            name: object.label(name).to_owned(),
            frame,
            range: object.element.range(),
        });
        self.parts.insert(name, index);
        Ok(index)
    }

    fn side(&mut self, joint: &'a str, number: &str, assembly: &'a str) -> Outcome<Found> {
        let object = &self.objects[joint];
        let frame = match object.inner(&format!("Placement{number}")) {
            Some(placed) => placement(placed)?,
            None => return Ok(Found::Lost("it has no frame")),
        };
        let reference = match follow(&self.objects, object, number, assembly) {
            Ok(reference) => reference,
            Err(why) => return Ok(Found::Lost(why)),
        };
        let mut whole = Frame::identity();
        for name in &reference.inner {
            whole = one_after_another(&whole, &self.objects[*name].placement()?);
        }
        let part = match reference.part {
            Some(part) => self.part(part, reference.array)?,
            None => 0,
        };
        let frame = one_after_another(&whole, &frame);
        Ok(Found::Side(Side { part, frame }, reference.element))
    }

    /// What a joint says; none where that depends on shapes, or is not known.
    fn kind(&self, joint: &str, word: &str, elements: [&str; 2]) -> Outcome<Option<Kind>> {
        let object = &self.objects[joint];
        let length = |property: &str| object.length(property);
        Ok(Some(match word {
            "Fixed" => Kind::Fixed,
            "Revolute" => Kind::Revolute,
            "Cylindrical" => Kind::Cylindrical,
            "Slider" => Kind::Slider,
            "Ball" => Kind::Ball,
            "Distance" if elements == ["Vertex"; 2] => {
                Kind::Rod([End::Ball, End::Ball], length("Distance")?)
            }
            "Parallel" => Kind::Parallel,
            "Perpendicular" => Kind::Angle(super::joints::quarter()),
            // Before 1.1 the angle stood where lengths do.
            "Angle" => Kind::Angle(match object.properties.contains_key("Angle") {
                true => object.angle("Angle")?,
                false => object.angle("Distance")?,
            }),
            "RackPinion" => Kind::Rack(length("Distance")?),
            "Screw" => Kind::Screw(length("Distance")?),
            "Gears" => Kind::Gears([length("Distance")?, length("Distance2")?]),
            "Belt" => Kind::Gears([length("Distance")?, -length("Distance2")?]),
            _ => return Ok(None),
        }))
    }
}
