//! What each kind of joint becomes.

use super::{Bounds, CadJoint, End, Kind, Maker, Mover, Side};
use crate::error::Outcome;
use crate::frames::{added, frame_of, one_after_another, sum};
use kutzbach_math::number::{Number, Quantity};
use kutzbach_math::space::{Rigid, length};
use kutzbach_model::mechanism::{Direction, Frame, JointBuilder, JointKind, Limit};

/// An angle whose sine is smaller asks for parallel axes: FreeCAD makes `ParallelAxesJoint` of angles below 1e-7
/// (`AssemblyObject::makeMbdJointOfType`, `Precision::Confusion`). As a turn at such an angle the joint would have a freedom more, which
/// no drawing shows. Half a turn asks for axes that point against one another, which are parallel as well.
const NO_ANGLE: f64 = 1e-7;

/// What rounding leaves of a direction's component that is zero: some dozen products of numbers of size one.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

fn axis(index: usize) -> Direction {
    Direction([0, 1, 2].map(|i| match i == index {
        true => Number::one(),
        false => Number::zero(),
    }))
}

/// An angle further than a first one, which is known as well as the digits of both say; a first one that is written as zero adds nothing.
fn turned_further(first: &Number, angle: &Number) -> Number {
    match first.is_zero() && first.inputs().is_empty() {
        true => angle.clone(),
        false => added(Quantity::Angle, first, angle),
    }
}

/// A frame turned further about its own x axis, which roll, pitch and yaw about fixed axes say exactly.
fn turned_about_x(frame: &Frame, angle: &Number) -> Frame {
    let [roll, pitch, yaw] = frame.roll_pitch_yaw.clone();
    Frame {
        position: frame.position.clone(),
        roll_pitch_yaw: [turned_further(&roll, angle), pitch, yaw],
    }
}

/// A frame turned half about its own z axis: of Rz·Ry·Rx·Rz(π) the half turn moves to the front, and turns the other two round.
fn half_turned_about_z(frame: &Frame) -> Frame {
    let [roll, pitch, yaw] = frame.roll_pitch_yaw.clone();
    Frame {
        position: frame.position.clone(),
        roll_pitch_yaw: [-roll, -pitch, turned_further(&yaw, &Number::pi())],
    }
}

/// Where a joint's two frames are drawn, and J seen from I.
pub(super) struct Drawn {
    pub(super) frames: [Rigid<f64>; 2],
    pub(super) seen: Rigid<f64>,
}

impl Maker<'_> {
    pub(super) fn drawn(&self, sides: &[Side; 2]) -> Drawn {
        let frames = sides
            .each_ref()
            .map(|side| self.poses[side.part].compose(&side.frame.to_doubles()));
        let seen = frames[0].inverse().compose(&frames[1]);
        Drawn { frames, seen }
    }

    /// Frames whose z axes point the same way, and x axes too where nothing may turn: a CAD program takes the opposite ones as well.
    fn alike(&self, sides: &[Side; 2], held: bool) -> [Side; 2] {
        let mut found = sides.clone();
        let seen = self.drawn(&found).seen;
        if seen.rotate(&[0.0, 0.0, 1.0])[2] < 0.0 {
            found[1].frame = turned_about_x(&found[1].frame, &Number::pi());
        }
        let seen = self.drawn(&found).seen;
        if held && seen.rotate(&[1.0, 0.0, 0.0])[0] < 0.0 {
            found[1].frame = half_turned_about_z(&found[1].frame);
        }
        found
    }

    /// Adds a joint between two frames, I the predecessor's.
    fn close(
        &mut self,
        joint: &CadJoint,
        name: &str,
        kind: JointKind,
        [from, to]: &[Side; 2],
    ) -> String {
        let name = self.take_name(name);
        self.places.insert(name.clone(), joint.range.clone());
        let (one, other) = (&self.links[from.part], &self.links[to.part]);
        let mut made = JointBuilder::closing(&name, kind, one, other)
            .origin(from.frame.clone())
            .successor_origin(to.frame.clone());
        if kind.uses_axis() {
            made = made.axis(axis(2));
        }
        if kind.uses_second_axis() {
            // The second axis of a universal joint is the y axis of a frame that was turned for it.
            made = made.axis2(axis(if kind == JointKind::Universal { 1 } else { 2 }));
        }
        match (&joint.kind, kind) {
            (Kind::Rod(_, length), JointKind::Distance) => made = made.distance(length.clone()),
            (Kind::Screw(lead), JointKind::Screw) => made = made.lead(lead.clone()),
            _ => {}
        }
        if let Some(limit) = limit_of(kind, &joint.limits) {
            made = made.limit(limit);
        }
        self.builder.joint(made);
        if joint.is_driven && kind.freedom() == 1 {
            self.builder.actuate(&name);
        }
        if matches!(kind, JointKind::Revolute | JointKind::Prismatic) {
            let Drawn { frames, seen } = self.drawn(&[from.clone(), to.clone()]);
            let turns = kind == JointKind::Revolute;
            let x = seen.rotate(&[1.0, 0.0, 0.0]);
            self.movers.push(Mover {
                name: name.clone(),
                parts: [from.part, to.part],
                turns,
                axis: frames[0].rotate(&[0.0, 0.0, 1.0]),
                home: match turns {
                    true => x[1].atan2(x[0]),
                    false => seen.apply(&[0.0; 3])[2],
                },
                size: match turns {
                    true => 1.0,
                    false => frames
                        .iter()
                        .map(|f| length(&f.translation))
                        .fold(0.0, f64::max),
                },
            });
        }
        if kind == JointKind::Fixed {
            let (a, b) = (self.body_of(from.part), self.body_of(to.part));
            self.body[b] = a;
        }
        name
    }

    /// Reads a joint that is not a coupling of others.
    pub(super) fn join(&mut self, joint: &CadJoint, all: &[CadJoint]) -> Outcome<()> {
        let sides = &joint.sides;
        if sides[0].part == sides[1].part {
            let what = "joint between two frames of one part".to_owned();
            self.assembly.unread.text(joint.range.start, what);
            return Ok(());
        }
        let above = |height: &Number| raised(&sides[0], height);
        let name = joint.name.as_str();
        // The point or the line is J's, so J is the predecessor: a point of it stays in what the successor has.
        let in_other = |height: &Number| [sides[1].clone(), raised(&sides[0], height)];
        let (kind, sides) = match &joint.kind {
            Kind::Fixed => (JointKind::Fixed, self.alike(sides, true)),
            Kind::Revolute => (JointKind::Revolute, self.alike(sides, false)),
            Kind::Cylindrical => match screw_beside(joint, all) {
                Some(screw) => {
                    let sides = self.alike(sides, false);
                    self.close(screw, name, JointKind::Screw, &sides);
                    return Ok(());
                }
                None => (JointKind::Cylindrical, self.alike(sides, false)),
            },
            Kind::Slider => (JointKind::Prismatic, self.alike(sides, true)),
            Kind::Ball => (JointKind::Spherical, self.alike(sides, false)),
            Kind::NoRotation => (JointKind::Translational, self.alike(sides, true)),
            Kind::Parallel => (JointKind::Schoenflies, self.alike(sides, false)),
            Kind::Planar(height) => {
                let raised = [above(height), sides[1].clone()];
                (JointKind::Planar, self.alike(&raised, false))
            }
            Kind::Universal => {
                let mut turned = sides.clone();
                turned[1].frame = turned_about_x(&turned[1].frame, &quarter());
                (JointKind::Universal, turned)
            }
            Kind::PointInPlane(height) => (JointKind::PointOnPlane, in_other(height)),
            Kind::LineInPlane(height) => (JointKind::LineOnPlane, in_other(height)),
            Kind::PointInLine => (JointKind::PointOnLine, in_other(&Number::zero())),
            Kind::Angle(angle) => return self.at_an_angle(joint, angle),
            Kind::Rod(ends, length) => return self.rod(joint, *ends, length),
            Kind::Screw(_) | Kind::Rack(_) | Kind::Gears(_) => return Ok(()),
        };
        self.close(joint, name, kind, &sides);
        Ok(())
    }

    /// Two directions at an angle: all translations, a turn about the one, and a turn about the other at that angle to it.
    fn at_an_angle(&mut self, joint: &CadJoint, angle: &Number) -> Outcome<()> {
        if angle.value().sin().abs() < NO_ANGLE {
            let sides = self.alike(&joint.sides, false);
            self.close(joint, &joint.name, JointKind::Schoenflies, &sides);
            return Ok(());
        }
        let Drawn { frames, seen } = self.drawn(&joint.sides);
        // A frame whose z axis is I's, at J's origin, turned so that J's z axis leans towards its −y, as a turn about its x axis has it.
        // Where the two are drawn parallel it may lean either way: the joint is closed from there.
        let [x, y, _] = seen.rotate(&[0.0, 0.0, 1.0]);
        let way = match x.hypot(y) > ROUNDED {
            true => x.atan2(-y),
            false => 0.0,
        };
        let about_z = Rigid::rotation(&[0.0, 0.0, 1.0], &way.cos(), &way.sin());
        let there = Rigid::translation(frames[1].apply(&[0.0; 3]));
        let unplaced = Rigid {
            translation: [0.0; 3],
            ..frames[0].clone()
        };
        let carried = there.compose(&unplaced);
        let leaning = carried.compose(&about_z);
        let moved = self.add_link(
            &format!("{} moved", joint.name),
            frame_of(&carried),
            joint.range.clone(),
        );
        let turned = self.add_link(
            &format!("{} turned", joint.name),
            frame_of(&leaning),
            joint.range.clone(),
        );
        let at = |part: usize, frame: Frame| Side { part, frame };
        let own = Frame::identity();
        let bare = CadJoint {
            limits: Default::default(),
            is_driven: false,
            ..joint.clone()
        };
        let translations = [joint.sides[0].clone(), at(moved, own.clone())];
        self.close(
            &bare,
            &format!("{} translations", joint.name),
            JointKind::Translational,
            &translations,
        );
        let first = [at(moved, own.clone()), at(turned, own.clone())];
        self.close(
            &bare,
            &format!("{} first turn", joint.name),
            JointKind::Revolute,
            &first,
        );
        let second = [
            at(turned, turned_about_x(&own, angle)),
            joint.sides[1].clone(),
        ];
        self.close(
            &bare,
            &format!("{} second turn", joint.name),
            JointKind::Revolute,
            &second,
        );
        Ok(())
    }

    /// A rod from I's axis to J.
    fn rod(&mut self, joint: &CadJoint, ends: [End; 2], length: &Number) -> Outcome<()> {
        let none = length.is_zero();
        let plain = match (ends, none) {
            ([End::Ball, End::Ball], false) => Some(JointKind::Distance),
            ([End::Ball, End::Ball], true) => Some(JointKind::Spherical),
            ([End::Revolute, End::Revolute], true) => Some(JointKind::Revolute),
            ([End::Revolute, End::Cylindrical], true) => Some(JointKind::Cylindrical),
            _ => None,
        };
        if let Some(kind) = plain {
            let sides = match kind {
                JointKind::Distance => joint.sides.clone(),
                _ => self.alike(&joint.sides, false),
            };
            self.close(joint, &joint.name, kind, &sides);
            return Ok(());
        }
        if ends[1] == End::Ball && none {
            let sides = [joint.sides[1].clone(), joint.sides[0].clone()];
            self.close(joint, &joint.name, JointKind::PointOnLine, &sides);
            return Ok(());
        }
        let sides = self.alike(&joint.sides, false);
        let Drawn { frames, seen } = self.drawn(&sides);
        let [x, y, z] = seen.apply(&[0.0; 3]);
        let way = y.atan2(x);
        let slides = ends.contains(&End::Cylindrical);
        let height = if slides { z } else { 0.0 };
        let at_foot = frames[0]
            .compose(&Rigid::translation([0.0, 0.0, height]))
            .compose(&Rigid::rotation(&[0.0, 0.0, 1.0], &way.cos(), &way.sin()));
        let rod = self.add_link(
            &format!("{} rod", joint.name),
            frame_of(&at_foot),
            joint.range.clone(),
        );
        let own = Frame::identity();
        let mut tip = own.clone();
        tip.position[0] = length.clone();
        let foot = Side {
            part: rod,
            frame: own,
        };
        let tip = Side {
            part: rod,
            frame: tip,
        };
        let kind = match slides {
            true => JointKind::Cylindrical,
            false => JointKind::Revolute,
        };
        let bare = CadJoint {
            limits: Default::default(),
            is_driven: false,
            ..joint.clone()
        };
        self.close(
            &bare,
            &format!("{} foot", joint.name),
            kind,
            &[sides[0].clone(), foot],
        );
        let kind = match ends[1] {
            End::Ball => JointKind::Spherical,
            _ => JointKind::Revolute,
        };
        self.close(
            &bare,
            &format!("{} tip", joint.name),
            kind,
            &[tip, sides[1].clone()],
        );
        Ok(())
    }
}

pub(super) fn quarter() -> Number {
    match Number::ratio(1, 2) {
        Some(half) => &Number::pi() * &half,
        None => Number::zero(),
    }
}

/// A side's frame at a height along its z axis.
fn raised(side: &Side, height: &Number) -> Side {
    let mut raised = side.clone();
    if height.is_zero() {
        return raised;
    }
    let z = side.frame.to_doubles().rotate(&[0.0, 0.0, 1.0]);
    let Some(main) = (0..3).find(|&i| (z[i].abs() - 1.0).abs() < 1e-12) else {
        let above = Frame::at([Number::zero(), Number::zero(), height.clone()]);
        raised.frame.position = one_after_another(&side.frame, &above).position;
        return raised;
    };
    // Along an axis of the part the sum keeps its digits.
    let up = match z[main] > 0.0 {
        true => height.clone(),
        false => -height.clone(),
    };
    raised.frame.position[main] = sum(&raised.frame.position[main], &up);
    raised
}

/// The screw between the two parts of a cylindrical joint, on its axis.
fn screw_beside<'j>(joint: &CadJoint, all: &'j [CadJoint]) -> Option<&'j CadJoint> {
    all.iter().find(|other| {
        let parts = |joint: &CadJoint| [joint.sides[0].part, joint.sides[1].part];
        let ([a, b], own) = (parts(joint), parts(other));
        matches!(other.kind, Kind::Screw(_)) && (own == [a, b] || own == [b, a])
    })
}

/// The limit of a joint of one freedom.
fn limit_of(kind: JointKind, [rotation, translation]: &[Bounds; 2]) -> Option<Limit> {
    let bounds = match kind {
        JointKind::Revolute => rotation,
        JointKind::Prismatic => translation,
        _ => return None,
    };
    let [lower, upper] = bounds;
    (lower.is_some() || upper.is_some()).then(|| Limit {
        lower: lower.clone(),
        upper: upper.clone(),
        effort: None,
        velocity: None,
    })
}

/// Whether a screw's two parts have a cylindrical joint, which is then read as the screw.
pub(super) fn cylinder_beside(screw: &CadJoint, all: &[CadJoint]) -> bool {
    all.iter().any(|joint| {
        matches!(joint.kind, Kind::Cylindrical)
            && screw_beside(joint, all).is_some_and(|found| found.name == screw.name)
    })
}
