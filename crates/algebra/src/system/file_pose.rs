//! The links where the file draws them, exactly.

use super::element::Element;
use super::error::SystemError;
use super::field::Field;
use super::model::{JointModel, read_frame, read_length};
use super::numbers::Place;
use super::space::{Matrix, Pose, Vector, add, multiply, rotation, scale};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Configuration, Joint, JointKind, Mechanism, Placement};

/// `world_from_link` of every link: along the file's tree, with the joints named by a configuration at its values and the
/// others at zero.
pub(super) fn drawn_poses(
    field: &mut Field,
    mechanism: &Mechanism,
    models: &[JointModel],
    configuration: Option<&Configuration>,
) -> Result<Vec<Pose<Element>>, SystemError> {
    let mut poses = vec![Pose::identity(field); mechanism.links().len()];
    for &link in mechanism.placement_order() {
        match &mechanism.link(link).placement {
            Placement::World => {}
            Placement::Floating {
                name,
                parent,
                origin,
            } => {
                let place = Place::joint(name, "origin");
                let origin = read_frame(field, origin, &place)?;
                poses[link.0] = poses[parent.0].then(field, &origin);
            }
            Placement::Joint(id) => {
                let joint = mechanism.joint(*id);
                let model = &models[id.0];
                let values = configuration
                    .iter()
                    .flat_map(|c| &c.positions)
                    .find(|(named, _)| named == id)
                    .map(|(_, values)| values.as_slice());
                let before = poses[joint.predecessor.link.0].then(field, &model.sides[0]);
                let at = displacement(field, joint, model, values.unwrap_or_default())?;
                let back = model.sides[1].inverse(field);
                poses[link.0] = before.then(field, &at).then(field, &back);
            }
        }
    }
    Ok(poses)
}

/// A joint's displacement at stated values, in the unit and with the directions that [`kutzbach_closure`] gives them.
fn displacement(
    field: &mut Field,
    joint: &Joint,
    model: &JointModel,
    values: &[Number],
) -> Result<Pose<Element>, SystemError> {
    let mut result = Pose::identity(field);
    if values
        .iter()
        .all(|x| x.rational().is_some_and(|x| x.is_zero()))
        && model.into_plane.is_none()
        && joint.kind != JointKind::Distance
    {
        return Ok(result);
    }
    let place = Place::joint(&joint.name, "value in the configuration");
    let number = |index: usize| values.get(index).cloned().unwrap_or_else(Number::zero);
    let unit = |field: &mut Field, v: &Vector<Element>| {
        let square = super::space::dot(field, v, v);
        let length = field.root(&square);
        length
            .and_then(|length| field.inverse(&length))
            .map(|inverse| scale(field, v, &inverse))
            .map_err(|limit| place.length(&joint.axis.0[0], limit.into()))
    };
    let turn =
        |field: &mut Field, result: &mut Pose<Element>, u: &Vector<Element>, angle: &Number| {
            let (c, s) = field
                .point(angle)
                .map_err(|obstacle| place.angle(angle, obstacle))?;
            let one = Element::integer(1);
            let turned: Matrix<Element> = rotation(field, u, &one, &c, &s, field);
            result.rotation = multiply(field, &result.rotation, &turned);
            Ok::<(), SystemError>(())
        };
    let slide =
        |field: &mut Field, result: &mut Pose<Element>, u: &Vector<Element>, way: &Number| {
            let way = read_length(field, way, &place)?;
            let moved = scale(field, u, &way);
            result.translation = result.image(field, &moved);
            Ok::<(), SystemError>(())
        };
    // The ball's rotation vector.
    let ball = |field: &mut Field, result: &mut Pose<Element>, vector: [Number; 3]| {
        let square = vector.iter().fold(Number::zero(), |sum, x| sum + x * x);
        if square.is_zero() {
            return Ok(());
        }
        let parts = [0, 1, 2].map(|i| vector[i].rational().is_some_and(|x| x.is_zero()));
        let single = (0..3).find(|&i| (0..3).all(|j| j == i || parts[j]));
        let (direction, angle) = match single {
            Some(i) => (
                [0, 1, 2].map(|j| Number::integer(i64::from(i == j))),
                vector[i].clone(),
            ),
            None => {
                let angle = square
                    .sqrt()
                    .map_err(|_| place.angle(&square, super::numbers::Obstacle::Transcendental))?;
                let part = |i: usize| {
                    vector[i]
                        .checked_div(&angle)
                        .unwrap_or_else(|_| Number::zero())
                };
                ([part(0), part(1), part(2)], angle)
            }
        };
        let mut u = [Element::zero(), Element::zero(), Element::zero()];
        for (component, number) in u.iter_mut().zip(&direction) {
            *component = field
                .read(number)
                .map_err(|obstacle| place.angle(&angle, obstacle))?;
        }
        turn(field, result, &u, &angle)
    };
    let base = |i: usize| [0, 1, 2].map(|j| Element::integer(i64::from(i == j)));
    let axis = match &model.axis {
        Some(axis) if uses_unit(joint.kind, values) => Some(unit(field, &axis.direction)?),
        Some(axis) => Some(axis.direction.clone()),
        None => None,
    };
    let axis2 = match &model.axis2 {
        Some(axis) if uses_unit(joint.kind, values) => Some(unit(field, &axis.direction)?),
        Some(axis) => Some(axis.direction.clone()),
        None => None,
    };
    match (joint.kind, &axis, &axis2) {
        (JointKind::Revolute, Some(a), _) => turn(field, &mut result, a, &number(0))?,
        (JointKind::Prismatic, Some(a), _) => slide(field, &mut result, a, &number(0))?,
        (JointKind::Screw, Some(a), _) => {
            screw(field, joint, &place, &mut result, a, &number(0), &turn)?;
        }
        (JointKind::Cylindrical, Some(a), _) => {
            slide(field, &mut result, a, &number(0))?;
            turn(field, &mut result, a, &number(1))?;
        }
        (JointKind::Universal, Some(a), Some(b)) => {
            turn(field, &mut result, a, &number(0))?;
            turn(field, &mut result, b, &number(1))?;
        }
        (
            JointKind::PlanarTranslation | JointKind::Planar | JointKind::TranslatingScrew,
            Some(a),
            _,
        ) => {
            let (e1, e2) = perpendicular(field, a, &unit)?;
            slide(field, &mut result, &e1, &number(0))?;
            slide(field, &mut result, &e2, &number(1))?;
            match joint.kind {
                JointKind::Planar => turn(field, &mut result, a, &number(2))?,
                JointKind::TranslatingScrew => {
                    screw(field, joint, &place, &mut result, a, &number(2), &turn)?;
                }
                _ => {}
            }
        }
        (JointKind::Translational | JointKind::Schoenflies, ..) => {
            for i in 0..3 {
                slide(field, &mut result, &base(i), &number(i))?;
            }
            if let (JointKind::Schoenflies, Some(a)) = (joint.kind, &axis) {
                turn(field, &mut result, a, &number(3))?;
            }
        }
        (JointKind::Spherical, ..) => {
            ball(field, &mut result, [number(0), number(1), number(2)])?;
        }
        (JointKind::PointOnLine, _, Some(b)) => {
            ball(field, &mut result, [number(0), number(1), number(2)])?;
            slide(field, &mut result, b, &number(3))?;
        }
        (JointKind::PointOnPlane, _, Some(b)) => {
            let (e1, e2) = perpendicular(field, b, &unit)?;
            ball(field, &mut result, [number(0), number(1), number(2)])?;
            slide(field, &mut result, &e1, &number(3))?;
            slide(field, &mut result, &e2, &number(4))?;
        }
        (JointKind::LineOnPlane, Some(a), Some(b)) => {
            turn(field, &mut result, a, &number(0))?;
            if let Some(constant) = &model.into_plane {
                result.rotation = multiply(field, &result.rotation, constant);
            }
            if values.iter().any(|x| !x.is_zero()) {
                let (e1, e2) = perpendicular(field, b, &unit)?;
                slide(field, &mut result, &e1, &number(1))?;
                slide(field, &mut result, &e2, &number(2))?;
                turn(field, &mut result, b, &number(3))?;
            }
        }
        (JointKind::Distance, ..) => {
            ball(field, &mut result, [Number::zero(), number(0), number(1)])?;
            let rod = model
                .distance_square
                .as_ref()
                .and_then(|d| field.root(d).ok());
            let rod = rod.ok_or_else(|| SystemError::UnknownDistance {
                joint: joint.name.clone(),
            })?;
            let moved = scale(field, &base(0), &rod);
            result.translation = result.image(field, &moved);
            ball(field, &mut result, [number(2), number(3), number(4)])?;
        }
        _ => {}
    }
    Ok(result)
}

/// Whether the lengths of the axes matter: not at home.
fn uses_unit(kind: JointKind, values: &[Number]) -> bool {
    kind != JointKind::Distance && values.iter().any(|x| !x.is_zero())
}

/// A screw at a stated angle: the way is lead times a fraction of a turn, algebraic where the angle is one of pi.
fn screw(
    field: &mut Field,
    joint: &Joint,
    place: &Place,
    result: &mut Pose<Element>,
    axis: &Vector<Element>,
    angle: &Number,
    turn: &impl Fn(&mut Field, &mut Pose<Element>, &Vector<Element>, &Number) -> Result<(), SystemError>,
) -> Result<(), SystemError> {
    let full = Number::integer(2) * Number::pi();
    if let (Some(lead), Ok(turns)) = (&joint.lead, angle.checked_div(&full)) {
        let way = read_length(field, &(lead * &turns), place)?;
        let moved = scale(field, axis, &way);
        result.translation = add(
            field,
            &result.translation,
            &super::space::apply(field, &result.rotation, &moved),
        );
    }
    turn(field, result, axis, angle)
}

/// The two directions across a unit axis that [`kutzbach_closure`] uses: the coordinate direction least along the axis times
/// it, and that one turned on.
fn perpendicular(
    field: &mut Field,
    axis: &Vector<Element>,
    unit: &impl Fn(&mut Field, &Vector<Element>) -> Result<Vector<Element>, SystemError>,
) -> Result<(Vector<Element>, Vector<Element>), SystemError> {
    let sizes = [0, 1, 2].map(|i| field.approximate(&axis[i]).abs());
    let mut smallest = 0;
    for i in 1..3 {
        if sizes[i] < sizes[smallest] {
            smallest = i;
        }
    }
    let helper = [0, 1, 2].map(|i| Element::integer(i64::from(i == smallest)));
    let crossed = super::space::cross(field, axis, &helper);
    let first = unit(field, &crossed)?;
    let second = super::space::cross(field, axis, &first);
    Ok((first, second))
}
