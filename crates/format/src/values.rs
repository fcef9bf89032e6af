//! Attribute values that are numbers, frames and directions.

use super::WarningKind;
use super::element::{Attribute, Element};
use super::error::{Fault, Outcome};
use super::hints;
use super::number_text;
use super::quaternion::roll_pitch_yaw;
use super::reader::{Dialect, Reader};
use super::words::{counted, cut};
use crate::words::quoted;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Frame};
use std::ops::Range;

/// Exact numbers have no largest one, but floating-point geometry does: products of a few of them must stay finite.
pub(super) const LARGEST: f64 = 1e100;
const TOO_LARGE: &str = "the number is too large; the largest accepted is 1e100";

/// Numbers and expressions of up to so many bytes are shared; longer ones seldom repeat.
const LONGEST_SHARED: usize = 24;
/// Bounds the memory for sharing.
const MOST_SHARED: usize = 4096;

/// All numbers of an attribute, or of the text in an element, where there are no expressions.
pub(super) fn numbers(attribute: Attribute<'_>) -> Outcome<Vec<Number>> {
    let words = attribute.value.split_ascii_whitespace();
    words
        .map(|word| decimal(word).map_err(|message| attribute.fault(message)))
        .collect()
}

/// A decimal that is not too large; why it is none.
pub(super) fn decimal(word: &str) -> Result<Number, String> {
    match Number::decimal(word) {
        Ok(number) if number.value().abs() <= LARGEST => Ok(number),
        Ok(_) => Err(TOO_LARGE.to_owned()),
        Err(_) => Err(format!("{} is no number", quoted(word))),
    }
}

/// As many numbers as asked for.
pub(super) fn exactly<const N: usize>(attribute: Attribute<'_>) -> Outcome<[Number; N]> {
    let found = numbers(attribute)?;
    let count = found.len();
    found
        .try_into()
        .map_err(|_| attribute.fault(format!("expected {}, found {count}", counted(N, "number"))))
}

impl<'a> Reader<'a> {
    /// One number.
    pub(super) fn number(&mut self, attribute: Attribute<'a>) -> Outcome<Number> {
        let [number] = self.numbers(attribute)?;
        Ok(number)
    }

    /// A number that may be left out.
    pub(super) fn optional_number(
        &mut self,
        element: Element<'a>,
        name: &str,
    ) -> Outcome<Option<Number>> {
        element
            .attribute(name)
            .map(|attribute| self.number(attribute))
            .transpose()
    }

    /// A number that says nothing about motion: where it cannot be read, that is noted.
    pub(super) fn number_if_readable(
        &mut self,
        element: Element<'a>,
        name: &str,
    ) -> Option<Number> {
        let attribute = element.attribute(name)?;
        match self.number(attribute) {
            Ok(number) => Some(number),
            Err(_) => {
                let what = format!("`{name}` of <{}>, which is no number", element.name());
                self.skip_because(element, what);
                None
            }
        }
    }

    /// Exactly so many numbers.
    pub(super) fn numbers<const N: usize>(
        &mut self,
        attribute: Attribute<'a>,
    ) -> Outcome<[Number; N]> {
        let parts = self.split(attribute)?;
        if parts.len() != N {
            return Err(attribute
                .fault(format!(
                    "expected {}, found {}",
                    counted(N, "number"),
                    parts.len()
                ))
                .help("numbers are separated by spaces"));
        }
        let numbers = self.evaluate(attribute, parts)?;
        // The lengths are equal, so the conversion succeeds.
        numbers
            .try_into()
            .map_err(|_| attribute.fault(format!("expected {}", counted(N, "number"))))
    }

    /// Any number of numbers, at least one.
    pub(super) fn number_list(&mut self, attribute: Attribute<'a>) -> Outcome<Vec<Number>> {
        const MOST: usize = 5;
        let parts = self.split(attribute)?;
        if parts.is_empty() || parts.len() > MOST {
            return Err(attribute.fault(format!(
                "expected 1 to {MOST} numbers, found {}",
                parts.len()
            )));
        }
        self.evaluate(attribute, parts)
    }

    fn split(&self, attribute: Attribute<'a>) -> Outcome<Vec<Range<usize>>> {
        number_text::split(attribute.value).map_err(|mut fault| {
            fault.range = attribute.part(fault.range);
            fault
        })
    }

    fn evaluate(
        &mut self,
        attribute: Attribute<'a>,
        parts: Vec<Range<usize>>,
    ) -> Outcome<Vec<Number>> {
        if attribute.value.contains('$') {
            self.uses(Dialect::Own);
        }
        parts
            .into_iter()
            .map(|part| self.evaluate_part(attribute, part))
            .collect()
    }

    fn evaluate_part(&mut self, attribute: Attribute<'a>, part: Range<usize>) -> Outcome<Number> {
        let token = &attribute.value[part.clone()];
        // Most numbers of most files are 0 and 1: read once, then shared. So are expressions: by the time elements are read
        // every definition has its value, so that the same text means the same number throughout.
        let is_short = token.len() <= LONGEST_SHARED;
        let open = self.open.filter(|_| token.contains('$'));
        if let Some(count) = open {
            count.set(count.get() + 1);
        }
        if let Some(number) = self.literals.get(token).filter(|_| is_short) {
            return Ok(number.clone());
        }
        let place =
            |range: Range<usize>| attribute.part(part.start + range.start..part.start + range.end);
        let number = number_text::number(token, &mut self.definitions)
            .map_err(|trouble| trouble.placed(place).maybe_help(hints::without_unit(token)))?;
        if number.value().abs() > LARGEST {
            return Err(Fault::new(place(0..token.len()), TOO_LARGE));
        }
        let number = match open {
            Some(_) => Number::parameter(token, number),
            None => number,
        };
        if is_short && self.literals.len() < MOST_SHARED {
            self.literals.insert(token, number.clone());
        }
        Ok(number)
    }

    /// `<origin xyz rpy/>`, both optional; `quat_xyzw` may stand for `rpy`.
    pub(super) fn origin(&mut self, element: Element<'a>) -> Outcome<Frame> {
        self.leaf_of(element, &["xyz", "rpy", "quat_xyzw"], true)?;
        self.frame_of(element)
    }

    /// `<origin>` of a joint, which moves with how it is turned.
    pub(super) fn joint_origin(&mut self, element: Element<'a>) -> Outcome<Frame> {
        no_other_turn(element)?;
        if let Some(rpy) = element.attribute("rpy") {
            self.note_angles(rpy);
        }
        self.origin(element)
    }

    /// The attributes `xyz` and `rpy` or `quat_xyzw` of whatever element has them.
    pub(super) fn frame_of(&mut self, element: Element<'a>) -> Outcome<Frame> {
        let mut frame = Frame::identity();
        if let Some(xyz) = element.attribute("xyz") {
            frame.position = self.numbers(xyz)?;
        }
        if let Some(rpy) = element.attribute("rpy") {
            frame.roll_pitch_yaw = self.numbers(rpy)?;
        }
        if let Some(turned) = element.attribute("quat_xyzw") {
            if element.attribute("rpy").is_some() {
                return Err(turned
                    .fault("the frame is turned twice, by `rpy` and by `quat_xyzw`")
                    .help("remove one of the two"));
            }
            if self.version() < (1, 1) {
                let at = turned.range().start;
                self.warn_of(at, WarningKind::ReadersDiffer { what: "quat_xyzw".to_owned() }, "`quat_xyzw` is read; other readers of URDF heed it from version 1.1 on (<robot version=\"1.1\">), and take the frame as not turned here");
            }
            let quaternion: [Number; 4] = self.numbers(turned)?;
            if let Some(open) = quaternion.iter().find(|part| part.is_open()) {
                return Err(turned
                    .fault(format!(
                        "a quaternion needs the value of {}, which is left open",
                        quoted(open.open_name().unwrap_or("a measure"))
                    ))
                    .help("turn the frame by `rpy`, with an angle that is left open"));
            }
            frame.roll_pitch_yaw = roll_pitch_yaw(&quaternion)
                .ok_or_else(|| turned.fault("the zero quaternion is no rotation"))?;
        }
        Ok(frame)
    }

    /// The version of URDF that the file is of; 1.0 where it states none.
    pub(super) fn version(&self) -> (u32, u32) {
        let version = self.root.attribute("version");
        let version = version.and_then(|text| {
            let (major, minor) = text.value.trim().split_once('.')?;
            Some((major.parse().ok()?, minor.parse().ok()?))
        });
        version.unwrap_or((1, 0))
    }

    /// `<axis xyz/>` or `<axis2 xyz/>`, any length but zero.
    pub(super) fn direction(&mut self, element: Element<'a>) -> Outcome<Direction> {
        self.leaf_of(element, &["xyz"], true)?;
        self.direction_of(element)
    }

    /// The attribute `xyz` of an axis.
    pub(super) fn direction_of(&mut self, element: Element<'a>) -> Outcome<Direction> {
        let xyz = element.required("xyz")?;
        let direction = Direction(self.numbers(xyz)?);
        if direction.is_zero() {
            return Err(xyz
                .fault("the zero vector names no direction")
                .help("give three numbers of which one is not zero, such as 0 0 1"));
        }
        Ok(direction)
    }
}

/// A fault where the frame of a joint is turned in words that are not read.
pub(super) fn no_other_turn(element: Element<'_>) -> Outcome<()> {
    const TURNS: [&str; 6] = ["wxyz", "xyzw", "orientation", "rotation", "euler", "ypr"];
    for (name, range) in element.other_attributes(&["quat_xyzw"]) {
        if name.starts_with("quat") || TURNS.contains(&name) {
            let message = format!("`{}` turns the frame, and how is not known", cut(name));
            return Err(Fault::new(range, message)
                .help("rpy=\"roll pitch yaw\", or quat_xyzw=\"x y z w\" with the real part last"));
        }
    }
    Ok(())
}
