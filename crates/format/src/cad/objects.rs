//! The objects of a FreeCAD document, with the values of their properties.

use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::frames::radians_of;
use crate::quaternion::roll_pitch_yaw;
use crate::values::{decimal, exactly};
use crate::words::quoted;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::Frame;
use std::collections::BTreeMap;

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

/// An object of the document: its type, and its properties by name, each as the element that holds its value.
pub(super) struct Object<'a> {
    pub(super) element: Element<'a>,
    pub(super) kind: &'a str,
    pub(super) properties: BTreeMap<&'a str, Element<'a>>,
}

/// Objects by their names.
pub(super) type Objects<'a> = BTreeMap<&'a str, Object<'a>>;

/// All objects with their properties.
pub(super) fn objects(root: Element<'_>) -> Outcome<Objects<'_>> {
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
    pub(super) fn inner(&self, property: &str) -> Option<Element<'a>> {
        self.properties.get(property)?.elements().next()
    }

    pub(super) fn value(&self, property: &str) -> Option<Attribute<'a>> {
        self.inner(property)?.attribute("value")
    }

    pub(super) fn says(&self, property: &str) -> Option<bool> {
        Some(self.value(property)?.value == "true")
    }

    /// The objects that a list of links names.
    pub(super) fn links(&self, property: &str) -> Vec<&'a str> {
        let list = self.inner(property).map(|list| list.elements());
        let values = list.into_iter().flatten();
        values
            .filter_map(|link| Some(link.attribute("value")?.value))
            .collect()
    }

    pub(super) fn length(&self, property: &str) -> Outcome<Number> {
        self.value(property).map_or(Ok(Number::zero()), millimetres)
    }

    pub(super) fn angle(&self, property: &str) -> Outcome<Number> {
        let Some(value) = self.value(property) else {
            return Ok(Number::zero());
        };
        let [degrees] = exactly(value)?;
        Ok(radians_of(&degrees))
    }

    /// The kind of a joint; none of what is no joint.
    pub(super) fn joint_type(&self) -> Option<&'a str> {
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

    /// Where it is in what holds it.
    pub(super) fn placement(&self) -> Outcome<Frame> {
        let placed = self
            .inner("Placement")
            .or_else(|| self.inner("LinkPlacement"));
        placed.map_or(Ok(Frame::identity()), placement)
    }

    pub(super) fn label(&self, name: &'a str) -> &'a str {
        self.value("Label").map_or(name, |label| label.value)
    }
}

/// A length in metres whose digits are those that are written. Whole millimetres were chosen, whatever zeros are printed behind them: they are exact.
fn millimetres(attribute: Attribute<'_>) -> Outcome<Number> {
    let text = attribute.value.trim();
    let padded = text.split_once('.');
    let padded = padded.filter(|(_, rest)| rest.bytes().all(|digit| digit == b'0'));
    let whole = padded.map_or(text, |(whole, _)| whole).parse::<i64>().ok();
    if let Some(metres) = whole.and_then(|count| Number::ratio(count, 1000)) {
        return Ok(metres);
    }
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let exponent = exponent.parse::<i32>().ok();
    let metres = match exponent.and_then(|exponent| exponent.checked_sub(3)) {
        Some(exponent) if Number::decimal(text).is_ok() => decimal(&format!("{digits}e{exponent}")),
        _ => Err(format!("{} is no number", quoted(text))),
    };
    metres.map_err(|message| attribute.fault(message))
}

/// A placement: millimetres and a quaternion.
pub(super) fn placement(element: Element<'_>) -> Outcome<Frame> {
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
