//! Linear relations between joint variables: gears, belts, mimic joints.
//!
//! A multibody ties one of its coordinates to one other. That is a coupling of two joints of the tree. A coupling of more
//! joints is an adding train: light wheels in a row on a common axis, each turned against the one before it by one joint's
//! share, the last held back by impulses, so that the shares add up to nothing.

use super::build::{Built, Held};
use super::elementary::{TakenApart, axes};
use super::units::Units;
use kutzbach_closure::{Geometry, JointState};
use kutzbach_model::mechanism::Mechanism;
use rapier3d_f64::prelude::{
    GenericJoint, JointAxesMask, MultibodyDofCoupling, MultibodyIndex, MultibodyJointHandle,
    PhysicsWorld, RigidBodyBuilder, RigidBodyHandle,
};

/// One term of a coupling as a multibody's coordinate.
#[derive(Clone, Copy, Debug)]
struct Coordinate {
    multibody: MultibodyIndex,
    link: usize,
    /// Position among the joint's free axes.
    freedom: usize,
    /// 0 to 5.
    axis: usize,
    /// The term is this times the coordinate, plus what it is at the start.
    factor: f64,
}

/// Adds every coupling that the engine can hold, and says which ones it cannot.
pub(super) fn add(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    apart: &TakenApart,
    units: &Units,
    built: &mut Built,
    physics: &mut PhysicsWorld,
) {
    for (coupling, equation) in mechanism.couplings().iter().zip(&geometry.couplings) {
        let (value, _) = equation.at(states);
        let left = -value;
        let mut terms = equation.slopes(states);
        terms.retain(|(_, factor)| *factor != 0.0);
        if !equation.is_linear() {
            built.note(
                &coupling.name,
                "the engine does not support couplings with powers of a joint's variable: it is left out",
            );
            built.not_simulated.push(coupling.name.clone());
            continue;
        }
        let coordinates: Option<Vec<Coordinate>> = terms
            .iter()
            .map(|(joint, factor)| coordinate(*joint, *factor, apart, units, built, physics))
            .collect();
        let together = coordinates.filter(|all| {
            all.len() > 1
                && all
                    .windows(2)
                    .all(|pair| pair[0].multibody == pair[1].multibody)
        });
        match together.as_deref() {
            Some([a, b]) => {
                tie(physics, *a, *b, left);
                built.pieces.couplings += 1;
            }
            Some(all) => train(physics, built, all, left),
            None => {
                built.note(
                    &coupling.name,
                    "the engine does not support this coupling, of joints that close a loop together, joints of separate parts, or one joint alone: it is left out",
                );
                built.not_simulated.push(coupling.name.clone());
            }
        }
    }
}

fn coordinate(
    joint: usize,
    factor: f64,
    apart: &TakenApart,
    units: &Units,
    built: &Built,
    physics: &PhysicsWorld,
) -> Option<Coordinate> {
    let index = apart.joints.iter().position(|e| e.joint == joint)?;
    let Some(Held::Multibody { handle, backwards }) = built.held[index] else {
        return None;
    };
    let free = apart.joints[index].free;
    let turns = free & axes::TURN_X != 0;
    let axis = if turns { 3 } else { 0 };
    let sign = if backwards { -1.0 } else { 1.0 };
    let (_, link) = physics.multibody_joints.get(handle)?;
    Some(Coordinate {
        multibody: multibody_of(physics, handle)?,
        link,
        freedom: if turns {
            (free & axes::TRANSLATIONS).count_ones() as usize
        } else {
            0
        },
        axis,
        factor: sign * factor * units.travel(axis),
    })
}

fn multibody_of(physics: &PhysicsWorld, handle: MultibodyJointHandle) -> Option<MultibodyIndex> {
    let body = RigidBodyHandle(handle.0);
    Some(physics.multibody_joints.rigid_body_link(body)?.multibody)
}

/// a.factor · a + b.factor · b = left.
fn tie(physics: &mut PhysicsWorld, a: Coordinate, b: Coordinate, left: f64) {
    if let Some(multibody) = physics.multibody_joints.get_multibody_mut(a.multibody) {
        multibody.add_dof_coupling(MultibodyDofCoupling {
            link1: a.link,
            dof1: a.freedom,
            axis1: a.axis,
            link2: b.link,
            dof2: b.freedom,
            axis2: b.axis,
            coeff: -a.factor / b.factor,
            offset: left / b.factor,
        });
    }
}

/// Mass and moment of a wheel in units of the engine, where links have about one.
const WHEEL: f64 = 1e-3;

fn train(physics: &mut PhysicsWorld, built: &mut Built, terms: &[Coordinate], left: f64) {
    let largest = terms.iter().fold(0.0f64, |m, t| m.max(t.factor.abs()));
    let Some(root) = physics
        .multibody_joints
        .get_multibody(terms[0].multibody)
        .map(|multibody| multibody.root().rigid_body_handle())
    else {
        return;
    };
    let place = physics.bodies.get(root).map(|body| *body.position());
    let turning = GenericJoint::new(JointAxesMask::from_bits_truncate(!axes::TURN_X & 0b11_1111));
    let mut before = root;
    for (index, term) in terms.iter().enumerate() {
        let wheel = RigidBodyBuilder::dynamic()
            .pose(place.unwrap_or_default())
            .additional_mass_properties(rapier3d_f64::prelude::MassProperties::new(
                rapier3d_f64::prelude::Vector::ZERO,
                WHEEL,
                rapier3d_f64::prelude::Vector::splat(WHEEL),
            ))
            .gravity_scale(0.0)
            .can_sleep(false);
        let wheel = physics.bodies.insert(wheel);
        let inserted = physics
            .multibody_joints
            .insert(before, wheel, turning, true);
        if let Some((_, link)) = inserted.and_then(|handle| physics.multibody_joints.get(handle)) {
            let turned = Coordinate {
                link,
                freedom: 0,
                axis: 3,
                factor: -largest,
                ..*term
            };
            let offset = if index == 0 { left } else { 0.0 };
            tie(physics, *term, turned, offset);
        }
        built.pieces.couplings += 1;
        built.pieces.multibody_joints += 1;
        before = wheel;
    }
    if let Some(multibody) = physics
        .multibody_joints
        .get_multibody_mut(terms[0].multibody)
    {
        multibody.forward_kinematics(&physics.bodies, true);
        multibody.damping_mut().fill(0.0);
    }
    // The last wheel is held back by its turn alone; the row of wheels keeps the rest.
    let stop = GenericJoint::new(JointAxesMask::ANG_X);
    physics.impulse_joints.insert(root, before, stop, true);
    built.pieces.impulse_joints += 1;
}
