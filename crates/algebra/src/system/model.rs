//! The exact geometry of joints: frames and axes as elements of a field.

use super::circle;
use super::element::Element;
use super::error::SystemError;
use super::field::{Field, FieldLimit};
use super::fraction::{self, Fraction};
use super::numbers::{Obstacle, Place, common_turn};
use super::space::{Matrix, Pose, Vector, cross, dot, multiply, scale, transpose};
use dashu_base::{Abs, Gcd};
use dashu_int::{IBig, UBig};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Configuration, Direction, Frame, Joint, JointKind, Mechanism, Placement,
};

/// A direction of any length, so that no root is needed to write it.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    /// In the joint frame of its side.
    pub(super) direction: Vector<Element>,
    /// The squared length, and one over it.
    pub(super) square: Element,
    pub(super) inverse_square: Element,
    /// Two directions across it and across one another.
    pub(super) across: [Across; 2],
}

/// A direction across an axis.
#[derive(Clone, Debug)]
pub(super) struct Across {
    pub(super) direction: Vector<Element>,
    pub(super) square: Element,
    pub(super) inverse_square: Element,
}

impl Axis {
    /// Whether the direction has length one.
    pub(super) fn is_unit(&self) -> bool {
        self.square == Element::integer(1)
    }

    fn new(field: &mut Field, direction: Vector<Element>) -> Result<Self, FieldLimit> {
        let direction = simplified(field, direction);
        let first = match (0..3).find(|&i| direction[i].is_zero()) {
            // The first coordinate direction across.
            Some(i) => [0, 1, 2].map(|j| Element::integer(i64::from(i == j))),
            None => [
                direction[1].negated(),
                direction[0].clone(),
                Element::zero(),
            ],
        };
        let second = cross(field, &direction, &first);
        let second = simplified(field, second);
        let square = dot(field, &direction, &direction);
        let inverse_square = field.inverse(&square)?;
        let across = [first, second].map(|direction| {
            let square = dot(field, &direction, &direction);
            let inverse_square = field.inverse(&square)?;
            Ok(Across {
                direction,
                square,
                inverse_square,
            })
        });
        let [a, b] = across;
        Ok(Self {
            direction,
            square,
            inverse_square,
            across: [a?, b?],
        })
    }
}

/// Largest component of a direction that is brought to integers.
const MAX_COMPONENT: u32 = 1_000_000;

/// A positive multiple of a direction that is simpler: of coprime integers where the ratios are rational and the integers
/// small, and of length one where that stays rational.
fn simplified(field: &mut Field, direction: Vector<Element>) -> Vector<Element> {
    let first = direction.iter().find(|x| !x.is_zero()).cloned();
    let Some(first) = first.filter(|x| !field.is_parametric(x)) else {
        return direction;
    };
    let Ok(inverse) = field.inverse(&first) else {
        return direction;
    };
    let ratios = direction
        .iter()
        .map(|x| field.multiply(x, &inverse).as_rational())
        .collect::<Option<Vec<Fraction>>>();
    let Some(ratios) = ratios else {
        return direction;
    };
    let lcm = ratios
        .iter()
        .fold(UBig::ONE, |all, x| fraction::lcm(&all, x.denominator()));
    let integers: Vec<IBig> = ratios
        .iter()
        .map(|x| (x * Fraction::from(lcm.clone())).numerator().clone())
        .collect();
    // One of the ratios is one, so that the integers are not all zero.
    let common = ratios.iter().fold(lcm.clone(), |all, x| {
        let whole = fraction::size(&(x * Fraction::from(lcm.clone())));
        if whole == UBig::ZERO {
            all
        } else {
            all.gcd(&whole)
        }
    });
    let negative = field.approximate(&first) < 0.0;
    let integers: Vec<IBig> = integers
        .into_iter()
        .map(|x| {
            let x = x / IBig::from(common.clone());
            if negative { -x } else { x }
        })
        .collect();
    let square = integers.iter().fold(IBig::ZERO, |sum, x| sum + x * x);
    let small = integers
        .iter()
        .all(|x| x.clone().abs() <= IBig::from(MAX_COMPONENT));
    let length = fraction::root(&Fraction::from(square));
    let scale = match (&length, small) {
        (Some(length), _) => fraction::inverse(length),
        (None, true) => Fraction::ONE,
        (None, false) => return direction,
    };
    let component = |i: usize| Element::rational(Fraction::from(integers[i].clone()) * &scale);
    [component(0), component(1), component(2)]
}

/// One joint.
#[derive(Clone, Debug)]
pub(super) struct JointModel {
    pub(super) kind: JointKind,
    /// `link_from_joint` of predecessor and successor.
    pub(super) sides: [Pose<Element>; 2],
    pub(super) axis: Option<Axis>,
    pub(super) axis2: Option<Axis>,
    /// The lead of a screw, metres per turn.
    pub(super) lead: Option<Element>,
    /// The stated distance of a distance joint, squared.
    pub(super) distance_square: Option<Element>,
    /// For joints with a ball: the rotation from the predecessor's to the successor's joint frame as the file draws it.
    pub(super) ball_home: Option<Matrix<Element>>,
    /// For `line_on_plane`: a constant rotation that takes the plane's normal across the line.
    pub(super) into_plane: Option<Matrix<Element>>,
    /// For `universal`: one over |a|²|b|² − (a·b)²; `None` where the axes are parallel.
    pub(super) skew: Option<Element>,
}

/// All numbers of a mechanism's geometry, with cosines and sines in place of angles.
fn all_numbers(mechanism: &Mechanism, configuration: Option<&Configuration>) -> Vec<Number> {
    let mut numbers = Vec::new();
    let mut frame = |frame: &Frame| {
        numbers.extend(frame.position.iter().cloned());
        for angle in &frame.roll_pitch_yaw {
            let (cos, sin) = angle.cos_sin();
            numbers.extend([cos, sin]);
        }
    };
    for joint in mechanism.joints() {
        frame(&joint.predecessor.frame);
        frame(&joint.successor.frame);
    }
    for link in mechanism.links() {
        if let Placement::Floating { origin, .. } = &link.placement {
            frame(origin);
        }
    }
    for joint in mechanism.joints() {
        numbers.extend(joint.axis.0.iter().chain(&joint.axis2.0).cloned());
        numbers.extend(joint.lead.iter().chain(&joint.distance).cloned());
    }
    for value in configuration
        .iter()
        .flat_map(|c| &c.positions)
        .flat_map(|(_, values)| values)
    {
        let (cos, sin) = value.cos_sin();
        numbers.extend([value.clone(), cos, sin]);
    }
    for coupling in mechanism.couplings() {
        let (cos, sin) = coupling.offset.cos_sin();
        numbers.extend([cos, sin]);
    }
    numbers
}

/// The field of fractions of a turn that a mechanism's angles need.
pub(super) fn circle_field(
    mechanism: &Mechanism,
    configuration: Option<&Configuration>,
) -> Result<Field, SystemError> {
    let numbers = all_numbers(mechanism, configuration);
    let (common, divisors) = common_turn(numbers.iter());
    let mut field = Field::with_circle(common).map_err(|_| SystemError::Degree {
        entity: format!("mechanism `{}`", mechanism.name()),
        element: "angles".to_owned(),
        number: format!("their common denominator, {common} to a turn,"),
        advice: format!(
            "2cos(2pi/{common}) has degree {}; write angles that have a small common denominator",
            circle::totient(common.min(100_000)) / 2
        ),
    })?;
    field.divisors = divisors;
    Ok(field)
}

pub(super) fn read_length(
    field: &mut Field,
    number: &Number,
    place: &Place,
) -> Result<Element, SystemError> {
    field
        .read(number)
        .map_err(|obstacle| place.length(number, obstacle))
}

/// `R = Rz(yaw) Ry(pitch) Rx(roll)`, as URDF has it.
pub(super) fn read_frame(
    field: &mut Field,
    frame: &Frame,
    place: &Place,
) -> Result<Pose<Element>, SystemError> {
    let mut translation = [Element::zero(), Element::zero(), Element::zero()];
    for (entry, number) in translation.iter_mut().zip(&frame.position) {
        *entry = read_length(field, number, place)?;
    }
    let mut rotation = super::space::identity(field);
    for axis in [2, 1, 0] {
        let angle = &frame.roll_pitch_yaw[axis];
        if angle.rational().is_some_and(|x| x.is_zero()) {
            continue;
        }
        let (c, s) = field
            .point(angle)
            .map_err(|obstacle| place.angle(angle, obstacle))?;
        let direction = [0, 1, 2].map(|i| Element::integer(i64::from(i == axis)));
        let one = Element::integer(1);
        let turn = super::space::rotation(field, &direction, &one, &c, &s, field);
        rotation = multiply(field, &rotation, &turn);
    }
    Ok(Pose {
        rotation,
        translation,
    })
}

fn read_axis(field: &mut Field, direction: &Direction, place: &Place) -> Result<Axis, SystemError> {
    let mut components = [Element::zero(), Element::zero(), Element::zero()];
    for (component, number) in components.iter_mut().zip(&direction.0) {
        *component = read_length(field, number, place)?;
    }
    Axis::new(field, components).map_err(|limit| place.length(&direction.0[0], limit.into()))
}

/// Reads a joint's geometry.
pub(super) fn read_joint(field: &mut Field, joint: &Joint) -> Result<JointModel, SystemError> {
    let place = |element: &str| Place::joint(&joint.name, element);
    let sides = [
        read_frame(
            field,
            &joint.predecessor.frame,
            &place("origin of the predecessor"),
        )?,
        read_frame(
            field,
            &joint.successor.frame,
            &place("origin of the successor"),
        )?,
    ];
    let kind = joint.kind;
    let axis = match kind.uses_axis() {
        true => Some(read_axis(field, &joint.axis, &place("axis"))?),
        false => None,
    };
    let axis2 = match kind.uses_second_axis() {
        true => Some(read_axis(field, &joint.axis2, &place("axis2"))?),
        false => None,
    };
    // A lead is used in the linear form only; elsewhere it may be anything.
    let lead = joint.lead.as_ref().and_then(|lead| field.read(lead).ok());
    let distance_square = match &joint.distance {
        Some(distance) => {
            let d = read_length(field, distance, &place("distance"))?;
            if d.is_zero() {
                return Err(SystemError::NoDistance {
                    joint: joint.name.clone(),
                });
            }
            Some(field.square(&d))
        }
        None => None,
    };
    let mut model = JointModel {
        kind,
        sides,
        axis,
        axis2,
        lead,
        distance_square,
        ball_home: None,
        into_plane: None,
        skew: None,
    };
    let limit = |limit: FieldLimit| {
        place("axis and axis2").length(&joint.axis2.0[0], Obstacle::from(limit))
    };
    if let (Some(a), Some(b)) = (&model.axis, &model.axis2) {
        let along = dot(field, &a.direction, &b.direction);
        if kind == JointKind::LineOnPlane {
            model.into_plane = Some(into_plane(field, a, b, &along).map_err(limit)?);
        } else {
            let across = field
                .multiply(&a.square, &b.square)
                .minus(&field.square(&along));
            if !across.is_zero() {
                model.skew = Some(field.inverse(&across).map_err(limit)?);
            }
        }
    }
    Ok(model)
}

/// A constant rotation that takes a plane's normal `b` across a line along `a`: the smallest one, a quarter turn where the
/// two are parallel, as in [`kutzbach_closure`].
///
/// With w the part of b across a, and k w as long as b, the rotation has cosine k |w|²/|b|² and axis v = b × k w of length
/// |b|² sin. So only k = |b|/|w| may be irrational.
fn into_plane(
    field: &mut Field,
    a: &Axis,
    b: &Axis,
    along: &Element,
) -> Result<Matrix<Element>, FieldLimit> {
    if along.is_zero() {
        return Ok(super::space::identity(field));
    }
    let part = field.multiply(along, &a.inverse_square);
    let w = super::space::subtract(field, &b.direction, &scale(field, &a.direction, &part));
    // Of nearly parallel ones the closure equations turn the normal elsewhere; so it is done here.
    let across = dot(field, &w, &w);
    let parallel = field.approximate(&across) <= 1e-6 * field.approximate(&b.square);
    let w = if parallel {
        let sizes = [0, 1, 2].map(|i| field.approximate(&a.direction[i]).abs());
        let mut smallest = 0;
        for i in 1..3 {
            if sizes[i] < sizes[smallest] {
                smallest = i;
            }
        }
        let helper = [0, 1, 2].map(|i| Element::integer(i64::from(i == smallest)));
        cross(field, &a.direction, &helper)
    } else {
        w
    };
    let square = dot(field, &w, &w);
    let inverse = field.inverse(&square)?;
    let ratio = field.multiply(&b.square, &inverse);
    let k = field.root(&ratio)?;
    let target = scale(field, &w, &k);
    let v = cross(field, &b.direction, &target);
    let cosine = field.multiply(&dot(field, &b.direction, &target), &b.inverse_square);
    let v_square = dot(field, &v, &v);
    let inverse_v = field.inverse(&v_square)?;
    Ok(super::space::rotation(
        field,
        &v,
        &inverse_v,
        &cosine,
        &b.inverse_square,
        field,
    ))
}

impl JointModel {
    /// The joint as drawn, from the pose of its successor's joint frame in that of its predecessor.
    pub(super) fn drawn_at(&mut self, relative: &Pose<Element>, field: &Field) {
        if matches!(
            self.kind,
            JointKind::Spherical
                | JointKind::PointOnLine
                | JointKind::PointOnPlane
                | JointKind::Distance
        ) {
            self.ball_home = Some(relative.rotation.clone());
        }
        if self.kind == JointKind::Distance && self.distance_square.is_none() {
            let t = &relative.translation;
            self.distance_square = Some(dot(field, t, t));
        }
    }

    /// The rotation a ball starts from.
    pub(super) fn ball_start(&self, field: &Field) -> Matrix<Element> {
        self.ball_home
            .clone()
            .unwrap_or_else(|| super::space::identity(field))
    }

    /// A direction of the predecessor's joint frame in its link.
    pub(super) fn in_predecessor(&self, field: &Field, v: &Vector<Element>) -> Vector<Element> {
        super::space::apply(field, &self.sides[0].rotation, v)
    }

    /// A direction of the successor's joint frame in its link.
    pub(super) fn in_successor(&self, field: &Field, v: &Vector<Element>) -> Vector<Element> {
        super::space::apply(field, &self.sides[1].rotation, v)
    }

    /// The rotation of the successor link relative to the predecessor link where the two joint frames are parallel.
    pub(super) fn parallel(&self, field: &Field) -> Matrix<Element> {
        multiply(
            field,
            &self.sides[0].rotation,
            &transpose(&self.sides[1].rotation),
        )
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn axis(field: &mut Field, v: [i64; 3]) -> Axis {
        Axis::new(field, v.map(Element::integer)).unwrap()
    }

    #[test]
    fn directions_become_simple() {
        let mut field = Field::default();
        let root = field.root(&Element::integer(2)).unwrap();
        let half = root.scaled(&fraction::fraction(1, 2));
        let diagonal = Axis::new(&mut field, [half.negated(), half, Element::zero()]).unwrap();
        assert_eq!(diagonal.direction, [-1, 1, 0].map(Element::integer));
        assert_eq!(diagonal.square, Element::integer(2));
        assert!(axis(&mut field, [0, 30, 40]).is_unit());
        let x = axis(&mut field, [5, 0, 0]);
        assert_eq!(x.across[0].direction, [0, 1, 0].map(Element::integer));
        assert_eq!(x.across[1].direction, [0, 0, 1].map(Element::integer));
    }

    #[test]
    fn directions_across_are_across() {
        let mut field = Field::default();
        for v in [[1, 2, 3], [0, 0, -2], [3, 0, 4], [-7, 1, 5]] {
            let axis = axis(&mut field, v);
            let [e, f] = [&axis.across[0].direction, &axis.across[1].direction];
            for (a, b) in [(e, f), (e, &axis.direction), (f, &axis.direction)] {
                assert!(dot(&field, a, b).is_zero(), "{v:?}");
            }
        }
    }

    #[test]
    fn normals_are_turned_across_lines() {
        let mut field = Field::default();
        for (a, b) in [
            ([1, 0, 0], [1, 1, 1]),
            ([0, 0, 2], [0, 0, 1]),
            ([1, 2, 2], [0, 3, 1]),
        ] {
            let (a, b) = (axis(&mut field, a), axis(&mut field, b));
            let along = dot(&field, &a.direction, &b.direction);
            let turn = into_plane(&mut field, &a, &b, &along).unwrap();
            let turned = super::super::space::apply(&field, &turn, &b.direction);
            assert!(dot(&field, &turned, &a.direction).is_zero());
            let product = multiply(&field, &turn, &transpose(&turn));
            assert_eq!(product, super::super::space::identity(&field));
        }
    }
}
