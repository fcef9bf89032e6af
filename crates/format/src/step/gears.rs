//! Gears: kinematic pairs that couple the hinges of two parts on a third.

use super::geometry::Geometry;
use kutzbach_math::group::Pose;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{JointKind, MechanismBuilder};
use kutzbach_step::{Assembly, KinematicPair, PairMotion};
use std::collections::BTreeSet;

/// A hinge is about the axis of a gear where the two differ by less (m; sine).
const SAME_AXIS: f64 = 1e-4;

/// A joint that was made.
pub(super) struct Joined {
    pub name: String,
    pub kind: JointKind,
    /// The parts that it leads from and to.
    pub parts: (usize, usize),
    /// Its geometry in the frame of the assembly.
    pub geometry: Geometry,
    /// 1 where the axis that is written points as that of the geometry, -1 where it points the other way.
    pub sense: f64,
}

/// Couples the hinges of gears; the pairs, by their places in [`Assembly::pairs`], whose parts have no hinges about the axes of the gears on
/// one common part.
pub(super) fn couple(
    assembly: &Assembly,
    joined: &[Joined],
    builder: &mut MechanismBuilder,
) -> Vec<usize> {
    let mut uncoupled = Vec::new();
    for (place, pair) in assembly.pairs.iter().enumerate() {
        let PairMotion::Gears { ratio } = pair.motion else {
            continue;
        };
        let Some((one, two)) = hinges(pair, joined) else {
            uncoupled.push(place);
            continue;
        };
        // The second turns by minus the ratio times the first, each about its own axis.
        let terms = vec![
            (one.name.to_owned(), shortest(ratio * one.sense)),
            (two.name.to_owned(), shortest(two.sense)),
        ];
        let name = format!("{} and {}", one.name, two.name);
        builder.linear_coupling(&name, terms, Number::zero());
    }
    uncoupled
}

/// A hinge of a gear.
#[derive(Clone, Copy)]
struct Hinge<'j> {
    name: &'j str,
    /// What bears the gear.
    carrier: usize,
    /// 1 where its variable counts as the gear turns about its axis, -1 otherwise.
    sense: f64,
}

/// The hinges of both gears on the part that bears them both; `None` where there is none, or several.
fn hinges<'j>(pair: &KinematicPair, joined: &'j [Joined]) -> Option<(Hinge<'j>, Hinge<'j>)> {
    let of = |gear: usize, frame: &Pose| -> Vec<Hinge<'j>> {
        let all = joined.iter().filter_map(|joint| hinge(joint, gear, frame));
        all.collect()
    };
    let first = of(pair.parts.0, &pair.frames.0);
    let second = of(pair.parts.1, &pair.frames.1);
    let carriers: BTreeSet<usize> = first.iter().map(|hinge| hinge.carrier).collect();
    let mut common = second
        .iter()
        .filter(|hinge| carriers.contains(&hinge.carrier));
    let (two, None) = (common.next()?, common.next()) else {
        return None;
    };
    let one = first.iter().find(|hinge| hinge.carrier == two.carrier)?;
    Some((*one, *two))
}

/// The hinge that a joint is for a gear whose axis is z of a frame.
fn hinge<'j>(joint: &'j Joined, gear: usize, frame: &Pose) -> Option<Hinge<'j>> {
    let (from, to) = joint.parts;
    let (carrier, leads) = match gear {
        part if part == to => (from, 1.0),
        part if part == from => (to, -1.0),
        _ => return None,
    };
    let Geometry::Line { point, direction } = joint.geometry else {
        return None;
    };
    let z = frame.rotation.column(2).into_owned();
    let apart = (point - frame.translation).cross(&z).norm();
    let same = direction.cross(&z).norm() <= SAME_AXIS && apart <= SAME_AXIS;
    (joint.kind == JointKind::Revolute && same).then(|| Hinge {
        name: &joint.name,
        carrier,
        sense: leads * direction.dot(&z).signum() * joint.sense,
    })
}

/// A number as the shortest decimal that is the double: what a person or a file wrote.
pub(super) fn shortest(x: f64) -> Number {
    Number::decimal(&format!("{x}")).unwrap_or_else(|_| Number::zero())
}
