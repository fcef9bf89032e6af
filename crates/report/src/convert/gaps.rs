//! What closes loops: which joints the file speaks of, whether they are closed as drawn, and where they are.

use kutzbach_closure::{Geometry, JointState, Rigid, Structure, assemble, spanning_poses};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Coupling, JointId, Mechanism};
use std::collections::BTreeSet;

/// Rounding errors of a loop, relative to its size: some million roundings.
const ROUNDINGS: f64 = 1e-10;

/// What rounded digits may do to a gap, in units of what they leave open of all joints.
const OF_DIGITS: f64 = 4.0;

/// How far the two sides of a closing joint are from what it allows, as drawn (m and rad together); `fitted` is the displacement that it
/// allows and that comes nearest.
pub(super) fn gap(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    id: JointId,
    fitted: &Rigid<f64>,
) -> f64 {
    let joint = mechanism.joint(id);
    let [predecessor, successor] = &geometry.sides[id.0];
    let home = &geometry.home;
    let first = home[joint.predecessor.link.0].compose(predecessor);
    let second = home[joint.successor.link.0].compose(successor);
    let between = first.compose(fitted).inverse().compose(&second);
    let size = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    // What lies in the two sides' own directions is what the joint leaves free.
    size(&between.translation) + size(&between.rotation_vector())
}

/// Up to which gap a loop is closed: what the digits of all joints leave open, and rounding errors. `size` is the largest coordinate of a
/// joint's frame in a link (m).
pub(super) fn tolerance(geometry: &Geometry<f64>, size: f64) -> f64 {
    let size = 1.0 + size;
    let open = geometry.uncertainties.iter();
    let digits = open.fold(0.0, |sum: f64, own| {
        sum.hypot(own.lengths).hypot(own.angles * size)
    });
    OF_DIGITS * digits + ROUNDINGS * size
}

/// Whether the file says something of a joint's variables, which then have to be in the file written.
pub(super) fn is_spoken_of(mechanism: &Mechanism, id: JointId) -> bool {
    let joint = mechanism.joint(id);
    let coupled = |coupling: &Coupling| coupling.terms.iter().any(|term| term.joint == id);
    mechanism.actuated().contains(&id)
        || mechanism.couplings().iter().any(coupled)
        || joint.bounds().is_some()
        || joint.dynamics.is_some() && joint.freedom() == 1
}

/// Below this a mechanism has no size (m), as one whose axes all meet in a point where all joints are.
const NO_SIZE: f64 = 1e-9;

/// What an axis of this length is stretched by to reach the second of two points that stand for a hinge: about as far from the first one as
/// the mechanism is large (m), a metre where that has no size. A power of ten, which leaves the digits of the axis as they are.
pub(super) fn lever(size: f64, axis: f64) -> Number {
    let wanted = match size > NO_SIZE {
        true => size.max(1e-6).log10().floor(),
        false => 0.0,
    };
    let power = (wanted - axis.log10()).round().clamp(-18.0, 18.0) as i32;
    let whole = 10i64.pow(power.unsigned_abs());
    match power < 0 {
        true => Number::ratio(1, whole).unwrap_or_else(Number::one),
        false => Number::integer(whole),
    }
}

/// A pose of the whole mechanism.
pub(super) struct Pose {
    /// Where every joint stands.
    pub(super) states: Vec<JointState<f64>>,
    /// Where every link is in the world.
    pub(super) links: Vec<Rigid<f64>>,
    /// Whether it is another one than that drawn.
    pub(super) moved: bool,
}

/// The pose drawn, where all loops are closed there, else the one that assembly finds; `None` where it finds none.
pub(super) fn closed(mechanism: &Mechanism, geometry: &Geometry<f64>) -> Option<Pose> {
    let joints = mechanism.joints();
    let tolerance = tolerance(geometry, geometry.size_of(0..joints.len()));
    let closes = |(index, displacement): (usize, Rigid<f64>)| {
        !joints[index].closes_loop
            || gap(mechanism, geometry, JointId(index), &displacement) <= tolerance
    };
    let displacements = geometry.displacements.iter().zip(&geometry.states);
    let displacements = displacements.map(|(joint, state)| joint.displacement(state));
    if displacements.enumerate().all(closes) {
        return Some(Pose {
            states: geometry.states.clone(),
            links: geometry.home.clone(),
            moved: false,
        });
    }
    let parts = Structure::new(mechanism).parts;
    let found = assemble(mechanism, geometry, &parts, &BTreeSet::new()).ok()?;
    if !found.closed {
        return None;
    }
    let (links, _) = spanning_poses(mechanism, geometry, &found.states);
    Some(Pose {
        states: found.states,
        links,
        moved: true,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_points_of_a_hinge_are_about_as_far_apart_as_all_is_large() {
        for (size, axis, expected) in [
            (5.0, 1.0, 1.0),
            (250.0, 1.0, 100.0),
            (250.0, 13.0, 10.0),
            (0.03, 1.0, 0.01),
            (0.03, 0.001, 10.0),
            (1e-8, 1.0, 1e-6),
            (0.0, 7.0, 0.1),
        ] {
            let found = lever(size, axis).value();
            assert!((found / expected - 1.0).abs() < 1e-12, "{size}: {found}");
        }
    }
}
