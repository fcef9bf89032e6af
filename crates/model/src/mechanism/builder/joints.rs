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
        if spec.kind.freedom() != 1 {
            let problem = format!(
                "a {} joint has no single value that could be limited",
                spec.kind
            );
            return Err(MechanismError::new(entity, problem));
        }
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::{far_away, fault, help, hinge, links, number};
    use super::super::{JointBuilder, MechanismBuilder};
    use crate::mechanism::{Direction, Dynamics, JointKind, Limit};
    use kutzbach_math::number::Number;

    /// Two links and this joint.
    fn with(joint: JointBuilder) -> MechanismBuilder {
        let mut builder = links(&["a", "b"]);
        builder.joint(joint);
        builder
    }

    fn tree(kind: JointKind) -> JointBuilder {
        JointBuilder::tree("j", kind, "a", "b")
    }

    fn zero() -> Direction {
        Direction([Number::zero(), Number::zero(), Number::zero()])
    }

    #[test]
    fn a_joint_connects_two_links() {
        for joint in [
            hinge("j", "b", "b"),
            JointBuilder::closing("j", JointKind::Fixed, "b", "b"),
        ] {
            assert_eq!(
                fault(with(joint)),
                "joint `j`: both sides are link `b`; a joint connects two different links"
            );
        }
    }

    #[test]
    fn both_axes_are_the_x_axis_unless_stated() {
        let mechanism = with(tree(JointKind::Universal)).build().unwrap();
        let joint = &mechanism.joints()[0];
        assert_eq!(
            (&joint.axis, &joint.axis2),
            (&Direction::x(), &Direction::x())
        );
    }

    #[test]
    fn a_direction_that_is_used_is_not_zero() {
        for kind in JointKind::ALL {
            let described = |joint: JointBuilder| {
                let joint = if kind.uses_lead() {
                    joint.lead(Number::one())
                } else {
                    joint
                };
                with(if kind == JointKind::Distance {
                    joint.distance(Number::one())
                } else {
                    joint
                })
            };
            for (builder, what, used) in [
                (described(tree(kind).axis(zero())), "axis", kind.uses_axis()),
                (
                    described(tree(kind).axis2(zero())),
                    "axis2",
                    kind.uses_second_axis(),
                ),
            ] {
                if used {
                    assert_eq!(
                        fault(builder),
                        format!("joint `j`: {what} is the zero vector, which names no direction")
                    );
                } else {
                    assert!(builder.build().is_ok(), "{kind} does not read {what}");
                }
            }
        }
    }

    #[test]
    fn a_screw_has_a_lead_and_no_other_joint_has() {
        for kind in JointKind::ALL {
            let told = if kind.uses_lead() {
                assert_eq!(help(with(tree(kind))), "<screw lead=\"metres per turn\"/>");
                assert!(with(tree(kind).lead(Number::one())).build().is_ok());
                assert_eq!(
                    fault(with(tree(kind).lead(number("1e101")))),
                    "joint `j`: lead is 1e101, beyond the largest number accepted, 1e100"
                );
                (fault(with(tree(kind))), "needs its lead")
            } else {
                (fault(with(tree(kind).lead(Number::one()))), "has no lead")
            };
            assert_eq!(told.0, format!("joint `j`: a {kind} joint {}", told.1));
        }
    }

    #[test]
    fn a_distance_is_kept_by_distance_joints_only_and_is_positive() {
        let distance = |text: &str| with(tree(JointKind::Distance).distance(number(text)));
        assert!(distance("0.001").build().is_ok());
        for text in ["0", "-1"] {
            assert_eq!(
                fault(distance(text)),
                "joint `j`: the distance must be greater than zero"
            );
            assert_eq!(
                help(distance(text)),
                "two points that coincide are a `spherical` joint"
            );
        }
        assert!(fault(distance("1e101")).contains("distance is 1e101"));
        assert_eq!(
            fault(with(tree(JointKind::Spherical).distance(Number::one()))),
            "joint `j`: a spherical joint keeps no distance"
        );
    }

    #[test]
    fn a_distance_may_be_left_to_the_home_pose_where_there_is_one() {
        let told = "the two points of a tree joint coincide at home, so a distance joint needs its <distance value=\"...\"/>";
        assert_eq!(
            fault(with(tree(JointKind::Distance))),
            format!("joint `j`: {told}")
        );
        let mut closing = with(hinge("ab", "a", "b"));
        closing.joint(JointBuilder::closing("j", JointKind::Distance, "a", "b"));
        assert!(closing.build().is_ok());
        // A tree joint that turns out to close a loop counts as one.
        let mut second = with(hinge("ab", "a", "b"));
        second.joint(tree(JointKind::Distance));
        assert!(second.build().is_ok());
    }

    #[test]
    fn limits_are_ordered() {
        let limit = |lower: Option<&str>, upper: Option<&str>| {
            with(tree(JointKind::Revolute).limit(Limit {
                lower: lower.map(number),
                upper: upper.map(number),
                ..Limit::default()
            }))
        };
        assert_eq!(
            fault(limit(Some("1"), Some("0.5"))),
            "joint `j`: the lower limit is above the upper limit"
        );
        assert!(limit(Some("1"), Some("1")).build().is_ok());
        assert!(limit(Some("1"), None).build().is_ok());
        assert!(limit(None, Some("-1")).build().is_ok());
    }

    #[test]
    fn every_number_is_one_to_compute_with() {
        let huge = || number("1e101");
        let limit = |change: fn(&mut Limit, Number)| {
            let mut limit = Limit::default();
            change(&mut limit, huge());
            tree(JointKind::Revolute).limit(limit)
        };
        let dynamics = |damping: Option<Number>, friction: Option<Number>| {
            tree(JointKind::Revolute).dynamics(Dynamics { damping, friction })
        };
        // Not read by a ball, but written back to a file.
        let axis = || Direction([Number::one(), Number::zero(), huge()]);
        for (joint, what) in [
            (tree(JointKind::Spherical).axis(axis()), "axis"),
            (tree(JointKind::Spherical).axis2(axis()), "axis2"),
            (limit(|l, x| l.lower = Some(x)), "lower limit"),
            (limit(|l, x| l.upper = Some(x)), "upper limit"),
            (limit(|l, x| l.effort = Some(x)), "effort"),
            (limit(|l, x| l.velocity = Some(x)), "velocity"),
            (dynamics(Some(huge()), None), "dynamics"),
            (dynamics(None, Some(huge())), "dynamics"),
        ] {
            assert_eq!(
                fault(with(joint)),
                format!("joint `j`: {what} is 1e101, beyond the largest number accepted, 1e100")
            );
        }
        for joint in [
            tree(JointKind::Fixed).origin(far_away()),
            tree(JointKind::Fixed).successor_origin(far_away()),
        ] {
            assert!(fault(with(joint)).starts_with("joint `j`: origin is 1e200"));
        }
    }
}
