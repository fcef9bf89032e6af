//! The effects beside joints: limits, dry friction, damping, contact. Each adds its own pieces only.

use super::build::{Built, Held};
use super::elementary::TakenApart;
use super::motor::{Gain, Motor, motor_joint};
use super::options::WorldOptions;
use super::solids::solid;
use super::units::Units;
use kutzbach_closure::JointState;
use kutzbach_model::mechanism::Mechanism;
use rapier3d_f64::prelude::{
    ActiveHooks, ColliderBuilder, JointAxis, PairFilterContext, PhysicsHooks, PhysicsWorld,
    SolverFlags,
};
use std::collections::BTreeSet;

/// Pairs of links, the smaller index first, whose shapes do not collide because a joint joins them.
#[derive(Debug, Default)]
pub(super) struct ApartHooks(BTreeSet<(u32, u32)>);

impl PhysicsHooks for ApartHooks {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let link = |collider| context.colliders.get(collider).map(|c| c.user_data as u32);
        let (a, b) = (link(context.collider1)?, link(context.collider2)?);
        let joined = self.0.contains(&(a.min(b), a.max(b)));
        (!joined).then_some(SolverFlags::COMPUTE_RIGID_IMPULSES)
    }
}

/// Adds what the options ask for.
pub(super) fn add(
    mechanism: &Mechanism,
    states: &[JointState<f64>],
    options: &WorldOptions,
    apart: &TakenApart,
    units: &Units,
    built: &mut Built,
    physics: &mut PhysicsWorld,
) {
    let effects = &options.effects;
    if effects.limits {
        limits(mechanism, states, apart, units, built, physics);
    }
    if effects.friction || effects.damping {
        resistances(
            mechanism,
            effects.friction,
            effects.damping,
            units,
            built,
            physics,
        );
    }
    if effects.contact {
        contact(mechanism, effects.restitution, units, built, physics);
    }
}

fn limits(
    mechanism: &Mechanism,
    states: &[JointState<f64>],
    apart: &TakenApart,
    units: &Units,
    built: &mut Built,
    physics: &mut PhysicsWorld,
) {
    // Beyond this a limit is none; the engine takes differences of limits.
    const FAR: f64 = 1e12;
    for (index, elementary) in apart.joints.iter().enumerate() {
        let joint = &mechanism.joints()[elementary.joint];
        let Some(limits) = joint.bounds().map(<[f64; 2]>::from) else {
            continue;
        };
        // The weld of a screw that closes a loop carries no limit: the screw itself does.
        if elementary.free == 0 {
            continue;
        }
        let turns = elementary.free & super::elementary::axes::TURN_X != 0;
        let (axis, number) = if turns {
            (JointAxis::AngX, 3)
        } else {
            (JointAxis::LinX, 0)
        };
        let start = states[elementary.joint].values[0];
        let [lower, upper] =
            limits.map(|limit| ((limit - start) / units.travel(number)).clamp(-FAR, FAR));
        if !(lower <= upper) {
            continue;
        }
        match built.held[index] {
            Some(Held::Multibody { handle, backwards }) => {
                if let Some((multibody, link)) = physics.multibody_joints.get_mut(handle)
                    && let Some(link) = multibody.link_mut(link)
                {
                    let range = if backwards {
                        [-upper, -lower]
                    } else {
                        [lower, upper]
                    };
                    link.joint.data.set_limits(axis, range);
                    built.pieces.limits += 1;
                }
            }
            Some(Held::Impulse(handle)) => {
                // An angle read off a rotation is known up to whole turns: a range has to fit into one, with the start in it.
                let one_turn = std::f64::consts::PI;
                if turns && (lower < -one_turn || upper > one_turn) && upper - lower < FAR {
                    built.note(
                        &joint.name,
                        "its limits reach farther than half a turn from the start, which impulses cannot hold; they are left out",
                    );
                    built.not_simulated.push(format!("{} (limits)", joint.name));
                } else if let Some(held) = physics.impulse_joints.get_mut(handle, true) {
                    held.data.set_limits(axis, [lower, upper]);
                    built.pieces.limits += 1;
                }
            }
            None => {}
        }
    }
}

fn resistances(
    mechanism: &Mechanism,
    friction: bool,
    damping: bool,
    units: &Units,
    built: &mut Built,
    physics: &mut PhysicsWorld,
) {
    for (index, joint) in mechanism.joints().iter().enumerate() {
        let Some(dynamics) = &joint.dynamics else {
            continue;
        };
        let value = |on: bool, number: &Option<kutzbach_math::number::Number>| {
            let value = number
                .as_ref()
                .map_or(0.0, kutzbach_math::number::Number::value);
            (on && value > 0.0 && value < 1e30).then_some(value)
        };
        let dry = value(friction, &dynamics.friction).map(|largest| Gain::Stiff { largest });
        let viscous = value(damping, &dynamics.damping).map(|damping| Gain::Viscous { damping });
        let handles = built.handles[index].clone();
        for gain in [dry, viscous].into_iter().flatten() {
            for handle in &handles {
                let motor = Motor {
                    velocity: 0.0,
                    gain,
                };
                let resisting = motor_joint(built, units, handle, motor);
                let [a, b] = handle.bodies.map(|body| built.bodies[body]);
                physics.impulse_joints.insert(a, b, resisting, true);
                match gain {
                    Gain::Stiff { .. } => built.pieces.frictions += 1,
                    Gain::Viscous { .. } => built.pieces.dampings += 1,
                }
            }
        }
        if handles.len() > 1 && (dry.is_some() || viscous.is_some()) {
            built.note(
                &joint.name,
                "friction and damping act on each of its freedoms alike, in N or N m",
            );
        }
    }
}

/// Coefficient of friction between shapes: the format states none.
const CONTACT_FRICTION: f64 = 0.5;

fn contact(
    mechanism: &Mechanism,
    restitution: f64,
    units: &Units,
    built: &mut Built,
    physics: &mut PhysicsWorld,
) {
    for joint in mechanism.joints() {
        let (a, b) = (
            joint.predecessor.link.0 as u32,
            joint.successor.link.0 as u32,
        );
        built.hooks.0.insert((a.min(b), a.max(b)));
    }
    for (index, link) in mechanism.links().iter().enumerate() {
        for shape in &link.collisions {
            let Some((placed, shape)) = solid(shape, units.length) else {
                built.note(
                    &link.name,
                    "a collision shape that is a mesh or has no size takes no part in contact",
                );
                built
                    .not_simulated
                    .push(format!("{} (collision mesh)", link.name));
                continue;
            };
            let body_from_link = units.pose(&built.offsets[index].inverse());
            let collider = ColliderBuilder::new(shape)
                .position(body_from_link * placed)
                .density(0.0)
                .friction(CONTACT_FRICTION)
                .restitution(restitution)
                .active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS)
                .user_data(index as u128);
            let body = built.bodies[index];
            physics
                .colliders
                .insert_with_parent(collider, body, &mut physics.bodies);
        }
    }
}
