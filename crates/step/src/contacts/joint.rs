//! The contacts of a pair of parts as one joint.

use super::settle::{Play, settled};
use super::{Contact, ContactKind};
use kutzbach_math::group::{
    Axis, DisplacementSubgroup, Gauge, GroupError, Margin, Subalgebra, normalised_direction,
};
use nalgebra::Vector3;
use std::error::Error;
use std::fmt;

/// Directions are written with six digits or more; a joint is not told more finely than that.
const DIGITS: f64 = 1e-6;

/// Contacts that fit worse than this share of their size are not one joint.
const COARSEST: f64 = 0.05;

/// What was settled is equal to the digits of doubles, after a few products.
const SETTLED: f64 = 1e-9;

/// The displacements that contacts leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Their class with its geometry, in the frame of the assembly. `Identity` where the parts hold each other.
    pub subgroup: DisplacementSubgroup,
    /// How clearly that was decided; see [`Margin::is_clear`].
    pub margin: Margin,
}

/// Why contacts are not one joint.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum JointError {
    /// No contacts: what they leave is everything.
    NoContacts,
    /// Numbers that are none.
    NotFinite,
    /// Faces that fit each other too badly to be on each other all at once.
    Misfit {
        /// The largest distance between what they should share (m).
        misfit: f64,
        /// The size of the contacts (m).
        size: f64,
    },
    /// The contacts decide nothing within their accuracy.
    Unclear,
    /// A failure of the group engine.
    Group(GroupError),
}

impl fmt::Display for JointError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoContacts => f.write_str("needed one contact or more, found none"),
            Self::NotFinite => {
                f.write_str("needed contacts with finite points and directions, found others")
            }
            Self::Misfit { misfit, size } => write!(
                f,
                "needed faces that fit, found a misfit of {misfit} m on contacts of {size} m: state a smaller clearance"
            ),
            Self::Unclear => f.write_str(
                "needed contacts whose axes and normals are equal or clearly not, found some in between: state their accuracy",
            ),
            Self::Group(error) => write!(f, "{error}"),
        }
    }
}

impl Error for JointError {}

impl From<GroupError> for JointError {
    fn from(error: GroupError) -> Self {
        Self::Group(error)
    }
}

/// The joint that the contacts of one pair of parts make: the intersection of the displacement subgroups that each of them
/// leaves, on the supposition that all faces stay on each other.
///
/// `accuracy` is how far points may be from where they should be (m); what the contacts themselves do not fit
/// ([`Contact::misfit`]) counts besides. Within both, axes, normals and centres count as parallel, at right angles or equal.
///
/// # Errors
/// [`JointError`]: no contacts, contacts that fit too badly, decisions that are not clear enough to name a class.
pub fn joint_of(contacts: &[Contact], accuracy: f64) -> Result<Joint, JointError> {
    let (play, length) = play(contacts, accuracy)?;
    let contacts = settled(contacts, play).ok_or(JointError::Unclear)?;
    let points = contacts.iter().map(|contact| contact.point);
    let centre = points.sum::<Vector3<f64>>() / contacts.len() as f64;
    // The line of two centres is settled with nothing.
    let balls = contacts.iter().filter(|c| c.kind == ContactKind::Spherical);
    let tolerance = if balls.count() > 1 {
        play.angle
    } else {
        SETTLED
    };
    let gauge = Gauge::new(centre, length, tolerance)?;
    let mut common: Option<Subalgebra> = None;
    for contact in distinct(&contacts, &gauge) {
        let left = left_by(contact).ok_or(JointError::NotFinite)?;
        let algebra = Subalgebra::generated_by(&left.algebra(), &gauge)?;
        common = Some(match common {
            Some(before) => before.intersection(&algebra)?,
            None => algebra,
        });
    }
    let common = common.ok_or(JointError::NoContacts)?;
    Ok(Joint {
        subgroup: common.subgroup()?.ok_or(JointError::Unclear)?,
        margin: common.margin(),
    })
}

/// The displacements that one contact leaves.
fn left_by(contact: &Contact) -> Option<DisplacementSubgroup> {
    Some(match contact.kind {
        ContactKind::Cylindrical => DisplacementSubgroup::Cylindrical {
            axis: Axis::through(contact.point, contact.axis)?,
        },
        ContactKind::Conical => DisplacementSubgroup::Rotation {
            axis: Axis::through(contact.point, contact.axis)?,
        },
        ContactKind::Planar => DisplacementSubgroup::Planar {
            normal: normalised_direction(contact.axis)?,
        },
        ContactKind::Spherical => DisplacementSubgroup::Spherical {
            centre: contact.point,
        },
    })
}

/// How well contacts are known, and the length by which they are compared (m): as far as they are apart, or as large as one is.
fn play(contacts: &[Contact], accuracy: f64) -> Result<(Play, f64), JointError> {
    let size = contacts.iter().map(|c| c.size).fold(0.0, f64::max);
    let misfit = contacts.iter().map(|c| c.misfit).fold(0.0, f64::max);
    if contacts.is_empty() {
        return Err(JointError::NoContacts);
    }
    let usable = |c: &Contact| c.axis.norm() > 0.5 && c.point.norm().is_finite();
    if !(size > 0.0 && size.is_finite() && contacts.iter().all(usable)) {
        return Err(JointError::NotFinite);
    }
    // A misfit turns an axis by its share of the smallest contact, on which the axis rests.
    let smallest = contacts.iter().map(|c| c.size).fold(size, f64::min);
    let accuracy = accuracy.max(0.0);
    let angle = DIGITS.max((misfit + accuracy) / smallest);
    if !(angle < COARSEST) {
        return Err(JointError::Misfit {
            misfit,
            size: smallest,
        });
    }
    // Each of two axes may be off by as much; far apart on one axis, by its turn as well.
    let points = || contacts.iter().map(|contact| contact.point);
    let low = points().reduce(|a, b| a.inf(&b));
    let high = points().reduce(|a, b| a.sup(&b));
    let reach = low.zip(high).map_or(0.0, |(low, high)| (high - low).norm());
    let length = 2.0 * (misfit + accuracy) + DIGITS * reach;
    Ok((Play { angle, length }, size.max(reach)))
}

/// The contacts without those that leave the same displacements as an earlier one: many faces of one plane say nothing more, and
/// every intersection costs digits.
fn distinct<'c>(contacts: &'c [Contact], gauge: &Gauge) -> Vec<&'c Contact> {
    let mut kept: Vec<&Contact> = Vec::new();
    for contact in contacts {
        if !kept.iter().any(|other| same(other, contact, gauge)) {
            kept.push(contact);
        }
    }
    kept
}

fn same(a: &Contact, b: &Contact, gauge: &Gauge) -> bool {
    let width = gauge.tolerance() * gauge.length();
    let parallel = a.axis.cross(&b.axis).norm() <= gauge.tolerance();
    a.kind == b.kind
        && match a.kind {
            ContactKind::Planar => parallel,
            ContactKind::Cylindrical | ContactKind::Conical => {
                parallel && (a.point - b.point).cross(&a.axis).norm() <= width
            }
            ContactKind::Spherical => (a.point - b.point).norm() <= width,
        }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn contact(kind: ContactKind, axis: [f64; 3], point: [f64; 3]) -> Contact {
        Contact {
            first: 0,
            second: 1,
            kind,
            axis: Vector3::from(axis).normalize(),
            point: point.into(),
            clearance: 0.0,
            misfit: 0.0,
            size: 0.01,
            faces: (1, 2),
        }
    }

    #[test]
    fn contacts_of_one_pair_are_intersected() {
        use ContactKind::{Conical, Cylindrical, Planar, Spherical};
        let (x, z, o) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]);
        let (beside, above) = ([0.02, 0.0, 0.0], [0.0, 0.0, 0.03]);
        let pin = contact(Cylindrical, z, o);
        let ball = |point| contact(Spherical, z, point);
        for (name, contacts, class) in [
            ("pin", vec![pin.clone()], "C"),
            (
                "pin with a shoulder",
                vec![pin.clone(), contact(Planar, z, beside)],
                "R",
            ),
            (
                "pin with two seats",
                vec![pin.clone(), contact(Cylindrical, z, above)],
                "C",
            ),
            (
                "pin with a flat along it",
                vec![pin.clone(), contact(Planar, x, beside)],
                "T",
            ),
            (
                "two pins side by side",
                vec![pin.clone(), contact(Cylindrical, z, beside)],
                "T",
            ),
            (
                "two pins side by side and a shoulder",
                vec![
                    pin.clone(),
                    contact(Cylindrical, z, beside),
                    contact(Planar, z, o),
                ],
                "E",
            ),
            (
                "two pins across",
                vec![pin.clone(), contact(Cylindrical, x, above)],
                "E",
            ),
            ("plane", vec![contact(Planar, z, o)], "G"),
            (
                "two planes that cross",
                vec![contact(Planar, z, o), contact(Planar, x, beside)],
                "T",
            ),
            (
                "three planes",
                vec![
                    contact(Planar, z, o),
                    contact(Planar, x, o),
                    contact(Planar, [0.0, 1.0, 0.0], o),
                ],
                "E",
            ),
            ("ball", vec![ball(o)], "S"),
            ("two balls", vec![ball(o), ball(above)], "R"),
            ("ball in a pin's way", vec![pin.clone(), ball(above)], "R"),
            (
                "two cones of one axis",
                vec![contact(Conical, z, o), contact(Conical, z, above)],
                "R",
            ),
        ] {
            let joint = joint_of(&contacts, 1e-9).unwrap();
            assert_eq!(joint.subgroup.short_name(), class, "{name}");
            assert!(joint.margin.is_clear(), "{name}: {:?}", joint.margin);
        }
    }

    /// A pin that a designer has put against the side of its hole turns in it all the same.
    #[test]
    fn a_pin_off_the_middle_of_its_hole_is_a_hinge() {
        use ContactKind::{Cylindrical, Planar};
        let mut pin = contact(Cylindrical, [0.0, 0.0, 1.0], [7e-5, 0.0, 0.0025]);
        (pin.misfit, pin.size) = (7e-5, 0.005);
        let head = contact(Planar, [0.0, 0.0, -1.0], [7e-5, 3e-6, 0.0]);
        let joint = joint_of(&[head, pin], 1e-9).unwrap();
        assert_eq!(joint.subgroup.short_name(), "R");
        assert!(joint.margin.is_clear(), "{:?}", joint.margin);
    }

    /// The dovetail of a table that stands askew: digits of five normals, three of them different.
    #[test]
    fn planes_of_a_dovetail_leave_one_direction_however_it_is_turned() {
        let turn = kutzbach_math::group::Pose::from_roll_pitch_yaw(0.24, 0.72, 1.35);
        let (flat, flank) = ([0.0, 0.0, 1.0], [0.857_492_925_7, 0.0, 0.514_495_755_4]);
        let other = [-0.857_492_925_7, 0.0, 0.514_495_755_4];
        let faces = [flat, flank, other, flat, flat];
        let contacts: Vec<Contact> = (0_i32..)
            .zip(faces)
            .map(|(place, normal)| {
                let shift = 0.02 * f64::from(place - 2);
                let mut face = contact(ContactKind::Planar, normal, [shift, 0.0, 0.01]);
                let digits = Vector3::new(1.0, -1.0, 1.0) * (1e-8 * f64::from(place));
                face.axis = turn.transform_direction(&(face.axis + digits).normalize());
                face.point = turn.transform_point(&face.point);
                face.size = 0.04;
                face
            })
            .collect();
        let joint = joint_of(&contacts, 1e-9).unwrap();
        assert_eq!(joint.subgroup.short_name(), "T");
        assert!(joint.margin.is_clear(), "{:?}", joint.margin);
    }

    #[test]
    fn what_cannot_be_said_is_an_error() {
        assert_eq!(joint_of(&[], 0.0), Err(JointError::NoContacts));
        let mut bad = contact(ContactKind::Planar, [0.0, 0.0, 1.0], [0.0; 3]);
        bad.misfit = 0.002;
        let error = joint_of(&[bad.clone()], 0.0).unwrap_err();
        assert!(matches!(error, JointError::Misfit { .. }), "{error}");
        bad.misfit = 0.0;
        bad.axis = Vector3::zeros();
        assert_eq!(joint_of(&[bad], 0.0), Err(JointError::NotFinite));
    }
}
