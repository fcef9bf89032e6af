//! What a joint says of itself: its kind, its axis, its limits, and where it is drawn.

use super::Mjcf;
use super::pose::{exactly, numbers};
use crate::element::Element;
use crate::error::Outcome;
use crate::words::quoted;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Dynamics, JointKind, Limit};

impl<'a> Mjcf<'a> {
    /// The kind of a joint that is not free.
    pub(super) fn kind_of(&self, joint: Element<'a>, class: &str) -> Outcome<JointKind> {
        let word = self.classes.attribute(joint, class, "type");
        Ok(match word.map_or("hinge", |word| word.value) {
            "hinge" => JointKind::Revolute,
            "slide" => JointKind::Prismatic,
            "ball" => JointKind::Spherical,
            other => {
                let message = format!("there is no type of joint {}", quoted(other));
                return Err(joint.fault(message).help("hinge, slide, ball or free"));
            }
        })
    }

    pub(super) fn axis_of(&self, joint: Element<'a>, class: &str) -> Outcome<Direction> {
        let Some(axis) = self.classes.attribute(joint, class, "axis") else {
            return Ok(Direction([Number::zero(), Number::zero(), Number::one()]));
        };
        let numbers: [Number; 3] = exactly(axis)?;
        if numbers.iter().all(Number::is_zero) {
            return Err(axis.fault("the axis has no direction: its length is zero"));
        }
        Ok(Direction(numbers))
    }

    pub(super) fn dynamics_of(&self, joint: Element<'a>, class: &str) -> Outcome<Dynamics> {
        let number = |name: &str| -> Outcome<Option<Number>> {
            let Some(attribute) = self.classes.attribute(joint, class, name) else {
                return Ok(None);
            };
            let [first, ..] = &numbers(attribute)?[..] else {
                return Ok(None);
            };
            Ok(Some(first.clone()))
        };
        Ok(Dynamics {
            damping: number("damping")?,
            friction: number("frictionloss")?,
        })
    }

    /// The value that MuJoCo gives the joint as drawn, in radians or metres; here that is 0.
    pub(super) fn reference(
        &self,
        joint: Element<'a>,
        class: &str,
        kind: JointKind,
    ) -> Outcome<Number> {
        let Some(zero) = self.classes.attribute(joint, class, "ref") else {
            return Ok(Number::zero());
        };
        let [zero]: [Number; 1] = exactly(zero)?;
        Ok(match kind {
            JointKind::Revolute => self.angle(&zero),
            _ => zero,
        })
    }

    /// Tells what a joint says that is not read.
    pub(super) fn tell_unread_of(&mut self, joint: Element<'a>, class: &str, kind: JointKind) {
        let attribute = |name: &str| self.classes.attribute(joint, class, name);
        for name in ["stiffness", "springref"] {
            if let Some(spring) = attribute(name) {
                let what = format!("`{name}` of a joint");
                self.unread.text(spring.range().start, what);
            }
        }
        let Some(range) = attribute("range") else {
            return;
        };
        let limited = attribute("limited").map_or("auto", |word| word.value);
        let what = match (kind, limited) {
            (JointKind::Spherical, _) => "`range` of a ball",
            (_, "true" | "false") => return,
            _ if self.source.compiler.autolimits => return,
            _ => "`range` of a joint without `limited`, where `autolimits` is off",
        };
        self.unread.text(range.range().start, what.to_owned());
    }

    /// The limits of a joint, from the pose drawn.
    pub(super) fn limit(
        &self,
        joint: Element<'a>,
        class: &str,
        kind: JointKind,
    ) -> Outcome<Option<Limit>> {
        let attribute = |name: &str| self.classes.attribute(joint, class, name);
        let range = attribute("range").filter(|_| !self.switched_off.limits());
        let Some(range) = range else {
            return Ok(None);
        };
        let [lower, upper]: [Number; 2] = exactly(range)?;
        let proper = lower.value() < upper.value();
        let limited = match attribute("limited").map_or("auto", |word| word.value) {
            "true" => true,
            "false" => false,
            _ => self.source.compiler.autolimits && proper,
        };
        if !limited {
            return Ok(None);
        }
        if !proper {
            return Err(range.fault(
                "the lower limit of a joint that is limited has to be below the upper one",
            ));
        }
        let zero = self.reference(joint, class, kind)?;
        let from_here = |bound: &Number| match kind {
            JointKind::Revolute => &self.angle(bound) - &zero,
            _ => bound - &zero,
        };
        Ok(Some(Limit {
            lower: Some(from_here(&lower)),
            upper: Some(from_here(&upper)),
            effort: None,
            velocity: None,
        }))
    }
}
