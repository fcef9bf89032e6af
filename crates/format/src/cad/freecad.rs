//! FreeCAD's documents: the joints of an assembly, without its shapes.
//!
//! A document is a zip file whose `Document.xml` lists objects and their properties. A joint names an element of each of its parts
//! by a path of objects, and keeps the frame on the object that the path ends in, offsets included, so no shape is needed. Where the kind of a joint
//! depends on shapes (a distance between faces), or an object on the way lies in another file, the joint is told as not read.
//!
//! Lengths are millimetres, angles degrees, quaternions x, y, z, w. Source: FreeCAD 1.0 and 1.1, what its Assembly workbench writes.

use super::{Assembly, CadJoint, End, Kind, Part, Side};
use crate::element::{Attribute, Element};
use crate::error::{Fault, Outcome};
use crate::frames::{one_after_another, radians_of};
use crate::quaternion::roll_pitch_yaw;
use crate::values::exactly;
use crate::words::quoted;
use crate::{ReadOptions, Reading, WarningKind, xml};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::Frame;
use std::collections::{BTreeMap, BTreeSet};

/// The file inside a document.
const DOCUMENT: &str = "Document.xml";

/// What a joint may be, in the order that documents without a list of their own number them.
const TYPES: [&str; 13] = [
    "Fixed",
    "Revolute",
    "Cylindrical",
    "Slider",
    "Ball",
    "Distance",
    "Parallel",
    "Perpendicular",
    "Angle",
    "RackPinion",
    "Screw",
    "Gears",
    "Belt",
];

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
    file.take(crate::guard::MOST_BYTES as u64 + 1)
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

/// An object of the document: its type, and its properties by name, each as the element that holds its value.
struct Object<'a> {
    element: Element<'a>,
    kind: &'a str,
    properties: BTreeMap<&'a str, Element<'a>>,
}

struct Reader<'a> {
    objects: BTreeMap<&'a str, Object<'a>>,
    assembly: Assembly<'a>,
    /// Indices of parts by the names of their objects.
    parts: BTreeMap<&'a str, usize>,
}

/// All objects with their properties.
fn objects(root: Element<'_>) -> Outcome<BTreeMap<&str, Object<'_>>> {
    let section = |name: &'static str| {
        let named = root.elements().filter(move |part| part.name() == name);
        named.flat_map(|part| part.elements())
    };
    let mut kinds = BTreeMap::new();
    for object in section("Objects").filter(|object| object.name() == "Object") {
        let kind = object.attribute("type").map_or("", |kind| kind.value);
        kinds.insert(object.required("name")?.value, kind);
    }
    let mut found = BTreeMap::new();
    for element in section("ObjectData").filter(|object| object.name() == "Object") {
        let name = element.required("name")?.value;
        let properties = element
            .elements()
            .filter(|part| part.name() == "Properties")
            .flat_map(|part| part.elements())
            .filter_map(|property| Some((property.attribute("name")?.value, property)))
            .collect();
        let kind = kinds.get(name).copied().unwrap_or_default();
        found.insert(
            name,
            Object {
                element,
                kind,
                properties,
            },
        );
    }
    Ok(found)
}

impl<'a> Object<'a> {
    /// The first element inside a property, and its `value`.
    fn inner(&self, property: &str) -> Option<Element<'a>> {
        self.properties.get(property)?.elements().next()
    }

    fn value(&self, property: &str) -> Option<Attribute<'a>> {
        self.inner(property)?.attribute("value")
    }

    fn says(&self, property: &str) -> Option<bool> {
        Some(self.value(property)?.value == "true")
    }

    /// The objects that a list of links names.
    fn links(&self, property: &str) -> Vec<&'a str> {
        let list = self.inner(property).map(|list| list.elements());
        let values = list.into_iter().flatten();
        values
            .filter_map(|link| Some(link.attribute("value")?.value))
            .collect()
    }

    fn length(&self, property: &str) -> Outcome<Number> {
        self.value(property).map_or(Ok(Number::zero()), millimetres)
    }

    fn angle(&self, property: &str) -> Outcome<Number> {
        let Some(value) = self.value(property) else {
            return Ok(Number::zero());
        };
        let [degrees] = exactly(value)?;
        Ok(radians_of(&degrees))
    }

    /// The kind of a joint; none of what is no joint.
    fn joint_type(&self) -> Option<&'a str> {
        let property = self.properties.get("JointType")?;
        let number: usize = self.value("JointType")?.value.parse().ok()?;
        let list = property
            .elements()
            .find(|part| part.name() == "CustomEnumList");
        let own = list.and_then(|list| list.elements().nth(number));
        own.and_then(|own| own.attribute("value"))
            .map(|own| own.value)
            .or_else(|| TYPES.get(number).copied())
    }

    fn label(&self, name: &'a str) -> &'a str {
        self.value("Label").map_or(name, |label| label.value)
    }
}

/// A length in metres whose digits are those that are written.
fn millimetres(attribute: Attribute<'_>) -> Outcome<Number> {
    let text = attribute.value.trim();
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let metres = exponent
        .parse::<i32>()
        .ok()
        .and_then(|exponent| exponent.checked_sub(3))
        .and_then(|exponent| Number::decimal(&format!("{digits}e{exponent}")).ok());
    metres
        .filter(|metres| metres.value().abs() <= crate::values::LARGEST)
        .ok_or_else(|| attribute.fault(format!("{} is no number", quoted(text))))
}

/// A placement: millimetres and a quaternion.
fn placement(element: Element<'_>) -> Outcome<Frame> {
    let mut frame = Frame::identity();
    for (i, name) in ["Px", "Py", "Pz"].into_iter().enumerate() {
        frame.position[i] = millimetres(element.required(name)?)?;
    }
    let mut quaternion = [const { None }; 4];
    for (i, name) in ["Q0", "Q1", "Q2", "Q3"].into_iter().enumerate() {
        let [part] = exactly(element.required(name)?)?;
        quaternion[i] = Some(part);
    }
    let [Some(x), Some(y), Some(z), Some(w)] = quaternion else {
        return Ok(frame);
    };
    frame.roll_pitch_yaw = roll_pitch_yaw(&[x, y, z, w])
        .ok_or_else(|| element.fault("a quaternion of zero length turns nothing"))?;
    Ok(frame)
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

    /// Joints in the groups of joints of an assembly, in their order.
    fn joints_of(&self, assembly: &str) -> Vec<&'a str> {
        let groups = self.objects[assembly].links("Group");
        groups
            .into_iter()
            .filter_map(|name| self.objects.get(name))
            .filter(|object| object.kind == "Assembly::JointGroup")
            .flat_map(|object| object.links("Group"))
            .filter(|name| self.objects.contains_key(name))
            .collect()
    }

    /// Parts that no joint names are not links: FreeCAD leaves them where they are.
    fn note_loose(&mut self, assembly: &str) {
        for name in self.objects[assembly].links("Group") {
            let Some(object) = self.objects.get(name) else {
                continue;
            };
            let is_part = object.properties.contains_key("Placement")
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
        let index = self.part(name)?;
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

    /// The index of the part that an object is.
    fn part(&mut self, name: &'a str) -> Outcome<usize> {
        if let Some(index) = self.parts.get(name) {
            return Ok(*index);
        }
        let object = &self.objects[name];
        let frame = self.placement_of(object)?;
        let index = self.assembly.parts.len();
        self.assembly.parts.push(Part {
            name: object.label(name).to_owned(),
            frame,
            range: object.element.range(),
        });
        self.parts.insert(name, index);
        Ok(index)
    }

    fn placement_of(&self, object: &Object<'a>) -> Outcome<Frame> {
        let placed = object
            .inner("Placement")
            .or_else(|| object.inner("LinkPlacement"));
        placed.map_or(Ok(Frame::identity()), placement)
    }

    /// What a reference of a joint says: the path of objects, without the assembly and groups before the part.
    fn path(&self, joint: &Object<'a>, number: &str) -> (Vec<&'a str>, Vec<&'a str>) {
        let mut words: Vec<&'a str> = Vec::new();
        if let Some(link) = joint.inner(&format!("Reference{number}")) {
            words.extend(link.attribute("name").map(|name| name.value));
            let subs = link.elements().filter_map(|sub| sub.attribute("value"));
            let sub = link.attribute("sub").or_else(|| subs.into_iter().next());
            words.extend(sub.into_iter().flat_map(|sub| sub.value.split('.')));
        } else {
            // As development versions before 1.0 had it: the part, the object and the element each by themselves.
            let part = joint.inner(&format!("Part{number}"));
            words.extend(
                part.and_then(|part| part.attribute("value"))
                    .map(|p| p.value),
            );
            let object = joint.value(&format!("Object{number}"));
            let object = object
                .into_iter()
                .flat_map(|object| object.value.split('.'));
            words.extend(object);
            let element = joint.value(&format!("Element{number}"));
            words.extend(element.map(|element| element.value));
            words.dedup();
        }
        let known = words
            .iter()
            .take_while(|word| self.objects.contains_key(*word))
            .count();
        let rest = words.split_off(known);
        let holds = |word: &&str| {
            let kind = self.objects[*word].kind;
            kind == "Assembly::AssemblyObject" || kind == "App::DocumentObjectGroup"
        };
        let before = words.iter().take_while(|word| holds(word)).count();
        (words.split_off(before), rest)
    }

    fn side(&mut self, joint: &'a str, number: &str, assembly: &'a str) -> Outcome<Found> {
        let object = &self.objects[joint];
        let (path, rest) = self.path(object, number);
        let frame = match object.inner(&format!("Placement{number}")) {
            Some(placed) => placement(placed)?,
            None => return Ok(Found::Lost("it has no frame")),
        };
        let element = match rest.last() {
            Some(last) if last.starts_with("Vertex") => "Vertex",
            _ => "",
        };
        let Some((&part, inner)) = path.split_first() else {
            // The assembly itself, its origin for instance.
            let on_assembly = self.parts.get(assembly).copied().unwrap_or_default();
            let side = Side {
                part: on_assembly,
                frame,
            };
            return Ok(Found::Side(side, element));
        };
        if self.objects[part].kind == "Assembly::AssemblyLink" {
            return Ok(Found::Lost(
                "one of its parts lies in an assembly of another file",
            ));
        }
        let mut chain: Vec<Frame> = Vec::new();
        let mut ends = self.objects[part].kind == "PartDesign::Body";
        for name in inner {
            if ends {
                break;
            }
            let object = &self.objects[*name];
            chain.push(self.placement_of(object)?);
            ends = object.kind == "PartDesign::Body";
        }
        if !ends && rest.len() > 1 {
            return Ok(Found::Lost(
                "an object that it refers to lies in another file",
            ));
        }
        let part = self.part(part)?;
        chain.push(frame);
        let mut whole = Frame::identity();
        for frame in &chain {
            whole = one_after_another(&whole, frame);
        }
        Ok(Found::Side(Side { part, frame: whole }, element))
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
