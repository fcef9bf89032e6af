//! The four-bars of a mechanism: rings of four hinges through the ground, each with a part of its own or within a larger one.

use super::{EQUAL, FourBar, kind, reach};
use kutzbach_closure::{cross_product, spanning_poses};
use kutzbach_math::space::dot;
use kutzbach_mobility::Analysis;
use kutzbach_model::mechanism::{JointKind, Mechanism};
use std::collections::BTreeMap;

/// A joint of a ring: its index, whether the ring passes it from its predecessor, its point (m) and the direction of its axis at the pose.
#[derive(Clone, Copy)]
pub(super) struct Pin {
    pub(super) joint: usize,
    pub(super) forward: bool,
    pub(super) point: [f64; 3],
    pub(super) axis: [f64; 3],
}

/// A ring from the ground around: the pins of input, coupler and output, and that of the output on the ground; and input, coupler and
/// output themselves.
struct Ring {
    pins: [Pin; 4],
    bodies: [usize; 3],
}

impl Ring {
    /// The same the other way around.
    fn reversed(&self) -> Self {
        let [a, b, c, d] = self.pins.map(|pin| Pin {
            forward: !pin.forward,
            ..pin
        });
        let [input, coupler, output] = self.bodies;
        Self {
            pins: [d, c, b, a],
            bodies: [output, coupler, input],
        }
    }
}

/// All four-bars of a mechanism at the pose that was analysed, in the order of their joints: rings of four hinges with parallel axes
/// through the ground. None where no pose is closed.
#[must_use]
pub fn four_bars(mechanism: &Mechanism, analysis: &Analysis) -> Vec<FourBar> {
    if analysis.home.is_none() {
        return Vec::new();
    }
    let geometry = &analysis.geometry;
    let states = &analysis.assembly.states;
    let (poses, _) = spanning_poses(mechanism, geometry, states);
    let body = bodies(mechanism);
    let ground = body[mechanism.ground().0];
    let mut found = Vec::new();
    for part in &analysis.structure.parts {
        // What is locked on the whole turns nowhere.
        let hinges: Vec<usize> = part
            .joints
            .iter()
            .copied()
            .filter(|&joint| mechanism.joints()[joint].kind == JointKind::Revolute)
            .filter(|&joint| analysis.roles[joint].locked != Some(true))
            .collect();
        // The hinges at every body, with the body beyond: each is looked at where a ring may pass it, and nowhere else.
        let mut at: BTreeMap<usize, Vec<(Pin, usize)>> = BTreeMap::new();
        for &joint in &hinges {
            let sides = [
                &mechanism.joints()[joint].predecessor,
                &mechanism.joints()[joint].successor,
            ];
            let frame = poses[sides[0].link.0].compose(&geometry.sides[joint][0]);
            let [near, far] = sides.map(|side| body[side.link.0]);
            for (forward, from, to) in [(true, near, far), (false, far, near)] {
                let pin = Pin {
                    joint,
                    forward,
                    point: frame.translation,
                    axis: frame.rotate(geometry.displacements[joint].axis()),
                };
                if from != to {
                    at.entry(from).or_default().push((pin, to));
                }
            }
        }
        let from = |start: usize| at.get(&start).into_iter().flatten().copied();
        let alone = hinges.len() == 4 && part.cycles.len() == 1 && part.joints.len() == 4;
        for (first, input) in from(ground) {
            for (second, coupler) in from(input).filter(|(_, coupler)| *coupler != ground) {
                let beyond = from(coupler).filter(|(_, output)| ![ground, input].contains(output));
                for (third, output) in beyond {
                    for (last, _) in from(output).filter(|(_, end)| *end == ground) {
                        if last.joint < first.joint {
                            continue;
                        }
                        let ring = Ring {
                            pins: [first, second, third, last],
                            bodies: [input, coupler, output],
                        };
                        let within_larger = !alone;
                        let moves = |pin: &Pin| analysis.roles[pin.joint].locked == Some(false);
                        if within_larger && !ring.pins.iter().all(moves) {
                            continue;
                        }
                        let bar = of(mechanism, &ring, states, within_larger);
                        found.extend(bar);
                    }
                }
            }
        }
    }
    found
}

/// Links that fixed joints hold together, by the first of them; of the ground's, the ground.
fn bodies(mechanism: &Mechanism) -> Vec<usize> {
    let mut body: Vec<usize> = (0..mechanism.links().len()).collect();
    for joint in mechanism.joints() {
        if joint.kind == JointKind::Fixed {
            let [a, b] = [joint.predecessor.link.0, joint.successor.link.0].map(|l| body[l]);
            body.iter_mut()
                .filter(|l| **l == a.max(b))
                .for_each(|l| *l = a.min(b));
        }
    }
    let (ground, own) = (mechanism.ground().0, body[mechanism.ground().0]);
    body.iter_mut()
        .filter(|l| **l == own)
        .for_each(|l| *l = ground);
    body
}

fn of(
    mechanism: &Mechanism,
    ring: &Ring,
    states: &[kutzbach_closure::JointState<f64>],
    within_larger: bool,
) -> Option<FourBar> {
    let lengths = lengths(&ring.pins)?;
    let name = |link: usize| mechanism.links()[link].name.clone();
    let joint = |pin: usize| mechanism.joints()[ring.pins[pin].joint].name.clone();
    let [input, coupler, output] = ring.bodies.map(name);
    let links = [
        mechanism.link(mechanism.ground()).name.clone(),
        input,
        coupler,
        output,
    ];
    let mut bar = FourBar::new(links, lengths, [joint(0), joint(3)]);
    bar.within_larger = within_larger;
    if !bar.turns() {
        return None;
    }
    let same = bar.swings[0].joint == joint(0);
    let pins = match same {
        true => ring.pins,
        false => ring.reversed().pins,
    };
    if let Some(reach) = reach::within_limits(mechanism, &pins, states, &bar) {
        let before = bar.kind;
        bar.swings[0].extremes = Some(reach.input);
        bar.swings[1].extremes = Some(reach.output);
        bar.transmission = reach.transmission;
        bar.stopped_by = reach.stopped_by;
        bar.kind = kind(&bar.swings);
        bar.without_limits = Some(before);
    }
    Some(bar)
}

/// Ground, and the links in the order of the ring; `None` where the axes are not parallel, or two of them are one.
fn lengths(pins: &[Pin; 4]) -> Option<[f64; 4]> {
    let axis = &pins[0].axis;
    let cross = |a: &[f64; 3], b: &[f64; 3]| {
        let c: [f64; 3] = cross_product(a, b);
        dot(&c, &c).sqrt()
    };
    let parallel = pins.iter().all(|pin| cross(axis, &pin.axis) < EQUAL);
    // Across the axes, which are unit vectors.
    let between = |i: usize, j: usize| {
        let difference: [f64; 3] = std::array::from_fn(|k| pins[j].point[k] - pins[i].point[k]);
        cross(axis, &difference)
    };
    let lengths = [between(3, 0), between(0, 1), between(1, 2), between(2, 3)];
    let longest = lengths.into_iter().fold(0.0, f64::max);
    let proper = lengths.iter().all(|length| *length > EQUAL * longest);
    (parallel && proper).then_some(lengths)
}
