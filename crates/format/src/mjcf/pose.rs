//! Numbers, positions and the five ways in which MJCF turns a frame.
//!
//! What can be said exactly is: turns about one axis of the frame, and `euler` in the order that roll, pitch and yaw have themselves.
//! Others are worked out in doubles that know the literals behind them ([`quaternion`](crate::quaternion)).

use super::Mjcf;
use super::classes::ATTACHED;
use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::frames::radians_of;
use crate::quaternion::{of_columns, product, roll_pitch_yaw, worked_out};
pub(super) use crate::values::{exactly, numbers};
use kutzbach_math::number::{Number, Quantity};
use kutzbach_math::space::cross;
use kutzbach_model::mechanism::Frame;
use std::rc::Rc;

/// What is particular to the file that something is from.
#[derive(Clone, Default)]
pub(super) struct Source<'a> {
    /// Its settings.
    pub(super) compiler: Compiler,
    /// What marks the attachments that it came with, the outermost first.
    pub(super) within: Rc<[&'a str]>,
}

impl<'a> Source<'a> {
    /// The same inside a frame: that of what is attached has the settings of its file.
    pub(super) fn inside(&self, frame: Element<'a>) -> Outcome<Self> {
        let mut inner = self.clone();
        for settings in frame.elements().filter(|part| part.name() == "compiler") {
            inner.compiler.take(settings)?;
        }
        if let Some(own) = frame.attribute(ATTACHED) {
            inner.within = self.within.iter().copied().chain([own.value]).collect();
        }
        Ok(inner)
    }
}

/// What `<compiler>` says.
#[derive(Clone, Copy)]
pub(super) struct Compiler {
    /// Whether angles are in degrees.
    pub(super) degrees: bool,
    /// The axes of `euler`, in small letters where they turn with the frame.
    pub(super) sequence: [char; 3],
    /// Whether a range without `limited` limits.
    pub(super) autolimits: bool,
    /// Whether masses are those of the geoms: always, never, or where there is no `<inertial>`.
    pub(super) mass_of_geoms: Option<bool>,
}

impl Default for Compiler {
    fn default() -> Self {
        Self {
            degrees: true,
            sequence: ['x', 'y', 'z'],
            autolimits: true,
            mass_of_geoms: None,
        }
    }
}

impl Compiler {
    /// Takes what an element says.
    pub(super) fn take(&mut self, element: Element<'_>) -> Outcome<()> {
        self.take_angles(element)?;
        let coordinate = element.attribute("coordinate");
        if let Some(coordinate) = coordinate.filter(|says| says.value == "global") {
            return Err(coordinate.fault(
                "global coordinates are not read, and by MuJoCo no more since version 2.3.3",
            ));
        }
        if let Some(says) = element.attribute("autolimits") {
            self.autolimits = says.value != "false";
        }
        if let Some(says) = element.attribute("inertiafromgeom") {
            self.mass_of_geoms = match says.value {
                "true" => Some(true),
                "false" => Some(false),
                _ => None,
            };
        }
        Ok(())
    }

    /// Takes what an element says of angles.
    pub(super) fn take_angles(&mut self, element: Element<'_>) -> Outcome<()> {
        if let Some(angle) = element.attribute("angle") {
            self.degrees = match angle.value {
                "degree" => true,
                "radian" => false,
                _ => return Err(angle.fault("an angle is in `degree` or in `radian`")),
            };
        }
        if let Some(sequence) = element.attribute("eulerseq") {
            let letters: Vec<char> = sequence.value.chars().collect();
            let known = letters.iter().all(|letter| "xyzXYZ".contains(*letter));
            let letters: Result<[char; 3], _> = letters.try_into();
            self.sequence = letters
                .ok()
                .filter(|_| known)
                .ok_or_else(|| sequence.fault("expected three of the letters x, y, z, X, Y, Z"))?;
        }
        Ok(())
    }

    /// An angle in the unit of the file.
    fn angle(&self, number: &Number) -> Number {
        match self.degrees {
            true => radians_of(number),
            false => number.clone(),
        }
    }

    /// Which axis an angle of `euler` turns about.
    pub(super) fn axis(&self, angle: usize) -> usize {
        self.sequence.get(angle).map_or(0, |axis| index_of(*axis))
    }

    /// Roll, pitch and yaw of `euler`.
    pub(super) fn euler(&self, angles: [Number; 3]) -> Option<[Number; 3]> {
        let angles = angles.map(|angle| self.angle(&angle));
        let sequence = self.sequence;
        let turning: Vec<usize> = (0..3).filter(|&i| !angles[i].is_zero()).collect();
        // Turns about axes that stay, x first, or about axes that turn along, z first, are roll, pitch and yaw.
        let fixed = |a: usize, b: usize| {
            let (a, b) = (sequence[a], sequence[b]);
            a.is_ascii_uppercase() && b.is_ascii_uppercase() && index_of(a) < index_of(b)
                || a.is_ascii_lowercase() && b.is_ascii_lowercase() && index_of(a) > index_of(b)
        };
        if turning.windows(2).all(|pair| fixed(pair[0], pair[1])) {
            let mut found = [Number::zero(), Number::zero(), Number::zero()];
            for i in turning {
                found[index_of(sequence[i])] = angles[i].clone();
            }
            return Some(found);
        }
        let numbers = angles.each_ref().map(|angle| (Quantity::Angle, angle));
        worked_out(numbers, |angles| {
            let turns = sequence.into_iter().zip(angles);
            Some(turns.fold([0.0, 0.0, 0.0, 1.0], |whole, (letter, angle)| {
                let mut axis = [0.0; 3];
                axis[index_of(letter)] = 1.0;
                let turn = about(axis, angle);
                match letter.is_ascii_lowercase() {
                    true => product(whole, turn),
                    false => product(turn, whole),
                }
            }))
        })
    }
}

fn index_of(axis: char) -> usize {
    match axis.to_ascii_lowercase() {
        'x' => 0,
        'y' => 1,
        _ => 2,
    }
}

/// The five attributes of which a frame may have one.
const TURNS: [&str; 5] = ["quat", "euler", "axisangle", "xyaxes", "zaxis"];

/// A turn about an axis by an angle (rad), as a quaternion x, y, z, w.
fn about(axis: [f64; 3], angle: f64) -> [f64; 4] {
    let (sine, cosine) = (angle / 2.0).sin_cos();
    let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [x, y, z] = axis.map(|part| part / length * sine);
    [x, y, z, cosine]
}

/// A vector in length 1; `None` where it has none.
pub(super) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 1e-12).then(|| v.map(|x| x / length))
}

impl<'a> Mjcf<'a> {
    /// An angle in the unit of the file.
    pub(super) fn angle(&self, number: &Number) -> Number {
        self.source.compiler.angle(number)
    }

    /// The frame of an element of a class: `pos` and how it is turned.
    pub(super) fn frame(&self, element: Element<'a>, class: &str) -> Outcome<Frame> {
        if let Some(frame) = self.frame_of_copy(element)? {
            return Ok(frame);
        }
        let mut frame = Frame::identity();
        let attribute = |name: &str| self.classes.attribute(element, class, name);
        if let Some(position) = attribute("pos") {
            frame.position = exactly(position)?;
        }
        let own: Vec<&str> = TURNS
            .into_iter()
            .filter(|name| element.attribute(name).is_some())
            .collect();
        if let [_, second, ..] = own[..] {
            return Err(element.fault(format!(
                "the frame is turned twice, the second time by `{second}`"
            )));
        }
        let turned = match own.first() {
            Some(name) => element.attribute(name).map(|turn| (*name, turn)),
            None => TURNS
                .into_iter()
                .find_map(|name| Some((name, attribute(name)?))),
        };
        if let Some((name, turn)) = turned {
            frame.roll_pitch_yaw = self.turned(name, turn)?;
        }
        Ok(frame)
    }

    fn turned(&self, name: &str, turn: Attribute<'a>) -> Outcome<[Number; 3]> {
        let none = || {
            turn.fault(format!(
                "`{name}` says no direction: it has a length of zero"
            ))
        };
        match name {
            "quat" => {
                let [w, x, y, z] = exactly(turn)?;
                roll_pitch_yaw(&[x, y, z, w]).ok_or_else(none)
            }
            "euler" => self.source.compiler.euler(exactly(turn)?).ok_or_else(none),
            "axisangle" => {
                let [x, y, z, angle] = exactly(turn)?;
                let angle = self.angle(&angle);
                one_axis(&[&x, &y, &z], &angle)
                    .or_else(|| {
                        let [x, y, z] = [&x, &y, &z].map(|part| (Quantity::Direction, part));
                        let numbers = [x, y, z, (Quantity::Angle, &angle)];
                        worked_out(numbers, |[x, y, z, angle]| {
                            Some(about(unit([x, y, z])?, angle))
                        })
                    })
                    .ok_or_else(none)
            }
            "xyaxes" => {
                let all: [Number; 6] = exactly(turn)?;
                let numbers = all.each_ref().map(|part| (Quantity::Direction, part));
                let found = worked_out(numbers, |[a, b, c, d, e, f]| {
                    let (x, y) = (unit([a, b, c])?, [d, e, f]);
                    let along: f64 = (0..3).map(|i| x[i] * y[i]).sum();
                    let y = unit([0, 1, 2].map(|i| y[i] - along * x[i]))?;
                    Some(of_columns([x, y, cross(&x, &y)]))
                });
                found.ok_or_else(none)
            }
            _ => {
                let all: [Number; 3] = exactly(turn)?;
                least_turn(all.each_ref()).ok_or_else(none)
            }
        }
    }
}

/// The least turn that takes z to a direction of any length.
pub(super) fn least_turn(direction: [&Number; 3]) -> Option<[Number; 3]> {
    let numbers = direction.map(|part| (Quantity::Direction, part));
    worked_out(numbers, |direction| {
        let z = unit(direction)?;
        let axis = cross(&[0.0, 0.0, 1.0], &z);
        let sine = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        Some(match sine > 1e-12 {
            true => about(axis, sine.atan2(z[2])),
            false if z[2] > 0.0 => [0.0, 0.0, 0.0, 1.0],
            false => [1.0, 0.0, 0.0, 0.0],
        })
    })
}

/// A turn about an axis of the frame.
fn one_axis(axis: &[&Number; 3], angle: &Number) -> Option<[Number; 3]> {
    let along: Vec<usize> = (0..3).filter(|&i| !axis[i].is_zero()).collect();
    let [along] = along[..] else {
        return None;
    };
    let mut found = [Number::zero(), Number::zero(), Number::zero()];
    found[along] = match axis[along].value() > 0.0 {
        true => angle.clone(),
        false => -angle.clone(),
    };
    Some(found)
}
