//! Where the copies of a `<replicate>` are.
//!
//! Copy i is turned by i times each angle, and stands at i times the offset, where that is along the axis of the turn or nothing turns: exact multiples, known
//! i times as badly as what is written. Elsewhere its place is the sum of i offsets, each turned as the copy before it. It is known no worse than i times the
//! offset, and by an angle, of which offset j is turned j times, than Σ j = i (i − 1)/2 times the length of the offset: bounds of what the directions of
//! the offsets make less.

use super::Mjcf;
use super::pose::{Compiler, exactly};
use crate::element::Element;
use crate::error::Outcome;
use crate::frames::{is_chosen, multiple};
use kutzbach_math::number::{Inputs, Number, Quantity};
use kutzbach_math::space::length;
use kutzbach_model::mechanism::Frame;

/// The attribute of the frame of a copy that says which one it is.
pub(super) const COPY: &str = "replicated";

pub(super) fn zeros() -> [Number; 3] {
    [Number::zero(), Number::zero(), Number::zero()]
}

/// From one copy to the next one, as it is written.
pub(super) struct Step {
    pub(super) offset: [Number; 3],
    /// In the unit of the file.
    euler: [Number; 3],
}

impl Step {
    /// What a `<replicate>`, or the frame of a copy of one, says.
    pub(super) fn of(element: Element<'_>) -> Outcome<Self> {
        let read = |name: &str| element.attribute(name).map(exactly::<3>).transpose();
        Ok(Self {
            offset: read("offset")?.unwrap_or_else(zeros),
            euler: read("euler")?.unwrap_or_else(zeros),
        })
    }

    /// Whether the places of copies are multiples of the offset.
    pub(super) fn is_along(&self, compiler: &Compiler) -> bool {
        let turning: Vec<usize> = (0..3).filter(|&i| !self.euler[i].is_zero()).collect();
        match turning[..] {
            [] => true,
            [one] => (0..3).all(|i| self.offset[i].is_zero() || i == compiler.axis(one)),
            _ => false,
        }
    }

    /// Roll, pitch and yaw (rad) of a copy.
    pub(super) fn turn(&self, index: usize, compiler: &Compiler) -> Option<[Number; 3]> {
        let angles = self.euler.each_ref();
        compiler.euler(angles.map(|angle| multiple(Quantity::Angle, angle, index)))
    }

    /// What the place of a copy is worked out from, if it is no multiple; `unit` is that of the angles (rad).
    fn inputs(&self, index: usize, unit: f64) -> Inputs {
        let copies = index as f64;
        let mut inputs = Inputs::default();
        for part in self.offset.iter().filter(|part| !is_chosen(part)) {
            inputs.add(Quantity::Length, part, copies);
        }
        let reach = length(&self.offset.each_ref().map(Number::value));
        for angle in self.euler.iter().filter(|angle| !is_chosen(angle)) {
            let slope = 0.5 * copies * (copies - 1.0) * reach * unit;
            inputs.add(Quantity::Angle, angle, slope);
        }
        inputs
    }
}

impl<'a> Mjcf<'a> {
    /// The frame of a copy, where an element is one.
    pub(super) fn frame_of_copy(&self, element: Element<'a>) -> Outcome<Option<Frame>> {
        let index = element
            .attribute(COPY)
            .filter(|_| element.name() == "frame");
        let Some(index) = index.and_then(|index| index.value.parse::<usize>().ok()) else {
            return Ok(None);
        };
        let step = Step::of(element)?;
        let compiler = &self.source.compiler;
        let position = match element.attribute("pos") {
            Some(place) => {
                let unit = match compiler.degrees {
                    true => 1f64.to_radians(),
                    false => 1.0,
                };
                let inputs = step.inputs(index, unit);
                exactly::<3>(place)?.map(|part| part.derived_from(inputs.clone()))
            }
            None => {
                let offset = step.offset.each_ref();
                offset.map(|part| multiple(Quantity::Length, part, index))
            }
        };
        let roll_pitch_yaw = step.turn(index, compiler).unwrap_or_else(zeros);
        Ok(Some(Frame {
            position,
            roll_pitch_yaw,
        }))
    }
}
