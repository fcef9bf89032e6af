//! A joint as turns, slides and balls one after another.
//!
//! Formats for trees know hinges, sliders and at best balls. Every kind of joint is a product of such displacements, each with a
//! direction and a point that are told here in the joint's frame on the successor, at the pose that the joint stands in: then all their
//! variables are zero there. Where the allowed displacements are a subgroup, this is the same list at every pose.

use super::place::{Triple, is_straight, triple, values, zeros};
use kutzbach_closure::{Rigid, across};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Joint, JointKind};

/// What a part does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    /// Turns about an axis.
    Turn,
    /// Slides along an axis.
    Slide,
    /// Turns about a point.
    Ball,
}

impl Motion {
    fn word(self) -> &'static str {
        match self {
            Self::Turn => "rot",
            Self::Slide => "trans",
            Self::Ball => "ball",
        }
    }
}

/// A part of a joint.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) motion: Motion,
    /// Of any length but zero; without meaning for a ball.
    pub(super) axis: Triple,
    /// A point of the axis, or of the ball; without meaning for a slide.
    pub(super) point: Triple,
    /// Whether it is the slide of a screw: `lead / 2π` times the turn.
    pub(super) of_screw: bool,
}

impl Part {
    fn new(motion: Motion, axis: Triple) -> Self {
        Self {
            motion,
            axis,
            point: zeros(),
            of_screw: false,
        }
    }

    /// The part in a frame in which its own is `frame`.
    pub(super) fn moved(&self, frame: &Rigid<f64>) -> Self {
        let axis = match is_straight(frame) || self.motion == Motion::Ball {
            true => self.axis.clone(),
            false => triple(frame.rotate(&values(&self.axis))),
        };
        Self {
            axis,
            point: triple(frame.apply(&values(&self.point))),
            ..self.clone()
        }
    }

    /// The part as the other side sees it.
    pub(super) fn reversed(&self) -> Self {
        Self {
            axis: self.axis.each_ref().map(|x| -x),
            ..self.clone()
        }
    }
}

/// The parts of a joint that stands in a displacement, the first next to the predecessor, in the frame on the successor; `None` where the
/// two frames coincide.
pub(super) fn parts(joint: &Joint, standing: Option<&Rigid<f64>>) -> Vec<Part> {
    let turn = |axis: &Triple| Part::new(Motion::Turn, axis.clone());
    let slide = |axis: &Triple| Part::new(Motion::Slide, axis.clone());
    let plane = |normal: &Triple| {
        let (first, second) = across(&unit(values(normal)));
        [first, second].map(|v| Part::new(Motion::Slide, triple(v)))
    };
    let base = |i: usize| {
        let mut v = zeros();
        v[i] = Number::one();
        v
    };
    // What is fixed in the predecessor, seen from the successor.
    let there = |v: &Triple| match standing {
        None => v.clone(),
        Some(pose) => triple(pose.rotate_back(&values(v))),
    };
    let origin = match standing {
        None => zeros(),
        Some(pose) => triple(pose.inverse().translation),
    };
    let ball = |point: Triple| Part {
        point,
        ..Part::new(Motion::Ball, zeros())
    };
    let screw = || {
        let along = Part {
            of_screw: true,
            ..slide(&joint.axis.0)
        };
        [turn(&joint.axis.0), along]
    };
    let (axis, axis2) = (&joint.axis.0, &joint.axis2.0);
    match joint.kind {
        JointKind::Fixed => Vec::new(),
        JointKind::Revolute => vec![turn(axis)],
        JointKind::Prismatic => vec![slide(axis)],
        JointKind::Screw => screw().to_vec(),
        JointKind::Cylindrical => vec![slide(axis), turn(axis)],
        JointKind::Universal => vec![turn(&there(axis)), turn(axis2)],
        JointKind::PlanarTranslation => plane(axis).to_vec(),
        JointKind::Planar => [&plane(axis)[..], &[turn(axis)][..]].concat(),
        JointKind::Spherical => vec![ball(zeros())],
        JointKind::Translational => (0..3).map(|i| slide(&base(i))).collect(),
        JointKind::TranslatingScrew => [plane(axis), screw()].concat(),
        JointKind::Schoenflies => {
            let slides = (0..3).map(|i| slide(&base(i)));
            slides.chain([turn(axis)]).collect()
        }
        JointKind::PointOnLine => vec![ball(origin), slide(axis2)],
        JointKind::PointOnPlane => [&[ball(origin)][..], &plane(axis2)[..]].concat(),
        JointKind::LineOnPlane => {
            let first = Part {
                point: origin,
                ..turn(&there(axis))
            };
            [&[first][..], &plane(axis2)[..], &[turn(axis2)][..]].concat()
        }
        JointKind::Distance => rod(standing, origin, ball(zeros())),
    }
}

/// A rod between two points: two turns across it at its start, a ball at its end. Two balls would let it spin.
fn rod(standing: Option<&Rigid<f64>>, start: Triple, end: Part) -> Vec<Part> {
    let along = standing.map_or([0.0; 3], |pose| pose.rotate_back(&pose.translation));
    if along.iter().all(|x| *x == 0.0) {
        return vec![end];
    }
    let (first, second) = across(&unit(along));
    let turn = |v| Part {
        point: start.clone(),
        ..Part::new(Motion::Turn, triple(v))
    };
    vec![turn(first), turn(second), end]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

/// Names of the parts: that of the joint where there is one, or one besides the slide of a screw; with `.rot`, `.trans` or `.ball`
/// behind it where there are several, numbered where these do the same.
pub(super) fn names(joint: &str, parts: &[Part]) -> Vec<String> {
    let free = parts.iter().filter(|part| !part.of_screw).count();
    let same = |part: &Part| {
        let alike = parts.iter().filter(|other| other.motion == part.motion);
        alike.count()
    };
    let mut names = Vec::with_capacity(parts.len());
    for (index, part) in parts.iter().enumerate() {
        let word = part.motion.word();
        let before = parts
            .iter()
            .take(index)
            .filter(|other| other.motion == part.motion);
        names.push(match (free, part.of_screw, same(part)) {
            (1, false, _) => joint.to_owned(),
            (_, _, 1) => format!("{joint}.{word}"),
            _ => format!("{joint}.{word}{}", before.count() + 1),
        });
    }
    names
}

/// Metres of the slide of a screw for a radian of its turn.
pub(super) fn pitch(joint: &Joint) -> Option<Number> {
    let turn = &Number::integer(2) * &Number::pi();
    joint.lead.as_ref()?.checked_div(&turn).ok()
}
