//! Rules about one joint: its numbers, and what its kind needs and does not know.

use super::JointBuilder;
use super::checks::{check_all_finite, check_finite, check_frame};
use super::names::Names;
use super::placements::Placements;
use crate::mechanism::{Direction, Entity, Joint, JointId, JointKind, Limit, MechanismError, Side};

/// Resolves the names of a joint, lets it place its child where nothing else does, and checks it.
pub(super) fn make_joint(
    spec: JointBuilder,
    id: JointId,
    names: &mut Names,
    placements: &mut Placements,
) -> Result<Joint, MechanismError> {
    names.add_joint(&spec.name, id)?;
    let entity = Entity::Joint(spec.name.clone());
    let predecessor = names.link(&entity, &spec.predecessor)?;
    let successor = names.link(&entity, &spec.successor)?;
    if predecessor == successor {
        return Err(MechanismError::new(
            entity,
            format!(
                "both sides are link `{}`; a joint connects two different links",
                spec.predecessor
            ),
        ));
    }
    // A second joint with the same child closes a loop: a link is placed once.
    let closes_loop = spec.closes_loop || !placements.place_by_joint(successor, id);
    check_frame(&entity, &spec.predecessor_frame)?;
    check_frame(&entity, &spec.successor_frame)?;
    check_directions(&entity, &spec)?;
    check_lead(&entity, &spec)?;
    check_distance(&entity, &spec, closes_loop)?;
    if let Some(limit) = &spec.limit {
        check_limit(&entity, limit)?;
    }
    if let Some(dynamics) = &spec.dynamics {
        let values = dynamics.damping.iter().chain(&dynamics.friction);
        check_all_finite(&entity, "dynamics", values)?;
    }
    Ok(Joint {
        name: spec.name,
        kind: spec.kind,
        predecessor: Side {
            link: predecessor,
            frame: spec.predecessor_frame,
        },
        successor: Side {
            link: successor,
            frame: spec.successor_frame,
        },
        axis: spec.axis.unwrap_or_else(Direction::x),
        axis2: spec.axis2.unwrap_or_else(Direction::x),
        lead: spec.lead,
        distance: spec.distance,
        limit: spec.limit,
        dynamics: spec.dynamics,
        independent: spec.independent,
        closes_loop,
    })
}

fn check_directions(entity: &Entity, spec: &JointBuilder) -> Result<(), MechanismError> {
    for (direction, what, used) in [
        (&spec.axis, "axis", spec.kind.uses_axis()),
        (&spec.axis2, "axis2", spec.kind.uses_second_axis()),
    ] {
        let Some(direction) = direction else { continue };
        check_all_finite(entity, what, &direction.0)?;
        if used && direction.is_zero() {
            return Err(MechanismError::new(
                entity.clone(),
                format!("{what} is the zero vector, which names no direction"),
            ));
        }
    }
    Ok(())
}

fn check_lead(entity: &Entity, spec: &JointBuilder) -> Result<(), MechanismError> {
    let kind = spec.kind;
    match (&spec.lead, kind.uses_lead()) {
        (None, false) => Ok(()),
        (None, true) => Err(MechanismError::new(
            entity.clone(),
            format!("a {kind} joint needs its lead"),
        )
        .help("<screw lead=\"metres per turn\"/>")),
        (Some(_), false) => Err(MechanismError::new(
            entity.clone(),
            format!("a {kind} joint has no lead"),
        )),
        (Some(lead), true) => check_finite(entity, "lead", lead),
    }
}

fn check_distance(
    entity: &Entity,
    spec: &JointBuilder,
    closes_loop: bool,
) -> Result<(), MechanismError> {
    let fault = |problem: String| MechanismError::new(entity.clone(), problem);
    let kind = spec.kind;
    match (&spec.distance, kind == JointKind::Distance) {
        (None, false) => Ok(()),
        // Where the joint closes a loop, the distance at home is the one meant.
        (None, true) if closes_loop => Ok(()),
        (None, true) => Err(fault(
            "the two points of a tree joint coincide at home, so a distance joint needs its <distance value=\"...\"/>"
                .to_owned(),
        )),
        (Some(_), false) => Err(fault(format!("a {kind} joint keeps no distance"))),
        (Some(distance), true) => {
            check_finite(entity, "distance", distance)?;
            if distance.value() > 0.0 {
                return Ok(());
            }
            Err(fault("the distance must be greater than zero".to_owned())
                .help("two points that coincide are a `spherical` joint"))
        }
    }
}

fn check_limit(entity: &Entity, limit: &Limit) -> Result<(), MechanismError> {
    for (what, value) in [
        ("lower limit", &limit.lower),
        ("upper limit", &limit.upper),
        ("effort", &limit.effort),
        ("velocity", &limit.velocity),
    ] {
        check_all_finite(entity, what, value)?;
    }
    match (&limit.lower, &limit.upper) {
        (Some(lower), Some(upper)) if lower.value() > upper.value() => Err(MechanismError::new(
            entity.clone(),
            "the lower limit is above the upper limit",
        )),
        _ => Ok(()),
    }
}
