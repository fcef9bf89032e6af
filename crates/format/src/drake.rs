//! Drake's elements (drake.mit.edu, `multibody/parsing/parsing_doxygen.h`) that bear on motion, and others' elements that
//! do not.
//!
//! - `<drake:joint>`: a joint of a type that URDF has not: `ball`, `planar`, `screw`, `universal`. A universal joint turns
//!   about x of the parent's frame, then about y of the child's.
//! - `<drake:screw_thread_pitch value>` inside it: metres per revolution, right-handed.
//! - `<drake:mimic joint multiplier offset>` inside `<joint>`: as `<mimic>`.
//! - `<drake:ball_constraint>`: a point P of body A stays at a point Q of body B.
//! - `<drake:distance_constraint>`: P and Q keep a distance, unless a finite stiffness makes a spring of it.
//! - `<drake:tendon_constraint>`, `<drake:linear_bushing_rpy>`, `<drake:linear_spring_damper>`: springs or one-sided limits,
//!   which leave the motion as it is.

use super::element::Element;
use super::error::Outcome;
use super::names::Named;
use super::reader::{Dialect, Reader};
use super::world::WORLD;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Frame, JointBuilder, JointKind};

impl<'a> Reader<'a> {
    /// An element of another namespace at the top of a file.
    pub(super) fn read_foreign(&mut self, element: Element<'a>) -> Outcome<()> {
        let springs = [
            "drake:tendon_constraint",
            "drake:linear_bushing_rpy",
            "drake:linear_spring_damper",
        ];
        match element.written_name() {
            "drake:joint" => self.read_joint(element),
            "drake:ball_constraint" => self.read_point_constraint(element, JointKind::Spherical),
            "drake:distance_constraint" => self.read_point_constraint(element, JointKind::Distance),
            name if springs.contains(&name) => {
                self.skip_because(
                    element,
                    format!(
                        "<{name}>, a spring or a one-sided limit, which leaves the motion free"
                    ),
                );
                Ok(())
            }
            name if name.starts_with("drake:") && name.contains("constraint") => Err(element
                .fault(format!("<{name}> constrains, and it is not read"))
                .help("write it as a <loop> or a <coupling>")),
            _ if element
                .namespace()
                .is_some_and(|address| address.contains("xacro")) =>
            {
                self.skip_because(
                    element,
                    format!(
                        "<{}>, the call of a macro that the file does not have",
                        element.written_name()
                    ),
                );
                Ok(())
            }
            _ => self.skip_unless_joining(element),
        }
    }

    /// The joint type that Drake's word stands for.
    pub(super) fn drake_kind(word: &str) -> Option<JointKind> {
        Some(match word {
            "ball" => JointKind::Spherical,
            "planar" => JointKind::Planar,
            "screw" => JointKind::Screw,
            "universal" => JointKind::Universal,
            _ => return None,
        })
    }

    /// The second axis of Drake's universal joint.
    pub(super) fn drake_second_axis() -> Direction {
        Direction([Number::zero(), Number::one(), Number::zero()])
    }

    /// A point of body A and one of body B that coincide or keep their distance.
    fn read_point_constraint(&mut self, constraint: Element<'a>, kind: JointKind) -> Outcome<()> {
        let own = constraint.name();
        let part = |what: &str| {
            let name = format!("{own}_{what}");
            let found = constraint.elements().find(|part| part.name() == name);
            found.ok_or_else(|| {
                constraint.fault(format!(
                    "<{}> needs <drake:{name}>",
                    constraint.written_name()
                ))
            })
        };
        if let Ok(stiffness) = part("stiffness") {
            let finite = stiffness.attribute("value").map(|value| self.number(value));
            if matches!(finite, Some(Ok(_))) {
                let name = constraint.written_name();
                let what = format!("<{name}> with a finite stiffness, a spring");
                self.skip_because(constraint, what);
                return Ok(());
            }
        }
        let body_a = self.directory.refer(Named::Link, part("body_A")?, "name")?;
        let body_b = self.directory.refer(Named::Link, part("body_B")?, "name")?;
        self.meets_world |= [body_a, body_b].contains(&WORLD);
        let p_ap = self.numbers(part("p_AP")?.required("value")?)?;
        let p_bq = self.numbers(part("p_BQ")?.required("value")?)?;
        let name = self.name_unnamed(own);
        let mut builder = JointBuilder::closing(&name, kind, body_a, body_b)
            .origin(Frame::at(p_ap))
            .successor_origin(Frame::at(p_bq));
        if kind == JointKind::Distance {
            builder = builder.distance(self.number(part("distance")?.required("value")?)?);
        }
        self.uses(Dialect::Own);
        self.other_closures = true;
        self.builder.joint(builder);
        Ok(())
    }

    /// A name for a joint that has none.
    pub(super) fn name_unnamed(&mut self, base: &str) -> String {
        loop {
            self.unnamed += 1;
            let name = format!("{base}_{}", self.unnamed);
            if !self.directory.has_joint_or_coupling(&name) {
                return name;
            }
        }
    }
}
