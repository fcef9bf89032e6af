//! Contacts of one pair made to agree where their faces have play.
//!
//! Which class of displacements is left is decided by what is parallel, at right angles, in one plane or on one axis. Faces say that to their
//! play: a pin that leans on one side of its hole has another axis than the hole, and both are the axis of one joint, since the parts can
//! be moved so that they agree. So what agrees within the play is made equal first, and what is left is intersected as exact geometry. What
//! differs by more than the play and less than [`APART`] times the play, or less than a designer would draw, is neither: then nothing is
//! decided.
//!
//! Contacts are taken in the order of their misfits, so that what fits best says where the axis is.

use super::{Contact, ContactKind};
use nalgebra::Vector3;

/// What differs by this many times the play is different.
const APART: f64 = 10.0;

/// Directions that are meant to differ do so by this (rad) at least: a twentieth of a degree.
const LEAST_ANGLE: f64 = 1e-3;

/// Axes and centres that are meant to differ do so by this (m) at least: the tightest fits have as much play.
const LEAST_LENGTH: f64 = 1e-5;

/// How far what is drawn as one may differ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Play {
    /// Of directions (rad).
    pub angle: f64,
    /// Of axes and centres (m).
    pub length: f64,
}

impl Play {
    fn angle_is_zero(self, angle: f64) -> Option<bool> {
        decided(angle, self.angle, LEAST_ANGLE)
    }

    fn length_is_zero(self, length: f64) -> Option<bool> {
        decided(length, self.length, LEAST_LENGTH)
    }
}

/// Whether a difference is within its play; `None` where it is neither that nor clearly larger.
fn decided(difference: f64, play: f64, least: f64) -> Option<bool> {
    if difference <= play {
        return Some(true);
    }
    (difference >= (APART * play).max(least)).then_some(false)
}

/// The contacts with directions, axes and centres that are equal where they agree within the play; `None` where some neither agree nor clearly
/// differ.
pub(super) fn settled(contacts: &[Contact], play: Play) -> Option<Vec<Contact>> {
    let mut order: Vec<&Contact> = contacts.iter().collect();
    order.sort_by(|a, b| a.misfit.total_cmp(&b.misfit));
    let mut known = Known::default();
    let mut out: Vec<Contact> = Vec::with_capacity(contacts.len());
    // Axes before the centres that may lie on them.
    let (balls, others): (Vec<&Contact>, Vec<&Contact>) = order
        .into_iter()
        .partition(|contact| contact.kind == ContactKind::Spherical);
    for contact in others {
        let mut contact = contact.clone();
        contact.axis = known.direction(contact.axis, play)?;
        if let Some(point) = on_known_axis(&contact, &out, play)? {
            contact.point = point;
        }
        out.push(contact);
    }
    for ball in balls {
        let mut ball = ball.clone();
        ball.point = centre(&ball, &out, play)?;
        out.push(ball);
    }
    Some(out)
}

/// Directions that differ.
#[derive(Default)]
struct Known {
    directions: Vec<Vector3<f64>>,
    /// The normal of the two that are farthest from parallel, with the sine between them.
    widest: Option<(Vector3<f64>, f64)>,
}

impl Known {
    /// A direction as those that are known have it, and known from now on; `None` where it neither agrees nor clearly differs.
    fn direction(&mut self, axis: Vector3<f64>, play: Play) -> Option<Vector3<f64>> {
        for other in &self.directions {
            if play.angle_is_zero(axis.cross(other).norm())? {
                return Some(other * axis.dot(other).signum());
            }
        }
        let mut across = Vec::new();
        for other in &self.directions {
            if play.angle_is_zero(axis.dot(other).abs())? {
                across.push(*other);
            }
        }
        if let Some((normal, sine)) = self.widest {
            // Noise of two directions is that of their normal, by the sine between them.
            let wide = Play {
                angle: play.angle / sine,
                ..play
            };
            if wide.angle_is_zero(axis.dot(&normal).abs())? {
                across.push(normal);
            }
        }
        let settled = at_right_angles(axis, &across)?;
        for other in &self.directions {
            let normal = settled.cross(other);
            let sine = normal.norm();
            if sine > self.widest.map_or(0.0, |(_, most)| most) {
                self.widest = Some((normal / sine, sine));
            }
        }
        self.directions.push(settled);
        Some(settled)
    }
}

/// The unit vector nearest to `axis` that is at right angles to all of `across`; `None` where there is none near it.
fn at_right_angles(axis: Vector3<f64>, across: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let mut basis: Vec<Vector3<f64>> = Vec::new();
    for other in across {
        let rest = basis.iter().fold(*other, |v, b| v - b * b.dot(&v));
        // What is spanned already is at right angles already.
        if rest.norm() > LEAST_ANGLE {
            basis.push(rest.normalize());
        }
    }
    match basis.as_slice() {
        [] => Some(axis),
        [one] => (axis - one * one.dot(&axis)).try_normalize(0.5),
        [one, two] => {
            let normal = one.cross(two);
            Some(normal * normal.dot(&axis).signum())
        }
        _ => None,
    }
}

/// A point of the axis among earlier contacts on which a contact turns as well, if there is one; `None` outside where that is not clear.
fn on_known_axis(contact: &Contact, known: &[Contact], play: Play) -> Option<Option<Vector3<f64>>> {
    if !has_axis(contact) {
        return Some(None);
    }
    for other in known.iter().filter(|other| has_axis(other)) {
        // Directions that agree were made equal.
        let parallel = contact.axis.cross(&other.axis).norm() <= f64::EPSILON;
        if parallel && play.length_is_zero(beside(contact.point, other))? {
            return Some(Some(other.point));
        }
    }
    Some(None)
}

/// The centre of a ball: that of an earlier ball, or on an axis, where it is within the play; `None` where that is not clear.
fn centre(ball: &Contact, known: &[Contact], play: Play) -> Option<Vector3<f64>> {
    let centres = known.iter().filter(|c| c.kind == ContactKind::Spherical);
    for other in centres {
        if play.length_is_zero((ball.point - other.point).norm())? {
            return Some(other.point);
        }
    }
    for other in known.iter().filter(|other| has_axis(other)) {
        if play.length_is_zero(beside(ball.point, other))? {
            let along = (ball.point - other.point).dot(&other.axis);
            return Some(other.point + other.axis * along);
        }
    }
    Some(ball.point)
}

fn has_axis(contact: &Contact) -> bool {
    matches!(
        contact.kind,
        ContactKind::Cylindrical | ContactKind::Conical
    )
}

/// How far a point is from the axis of a contact (m).
fn beside(point: Vector3<f64>, contact: &Contact) -> f64 {
    (point - contact.point).cross(&contact.axis).norm()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const PLAY: Play = Play {
        angle: 0.01,
        length: 1e-4,
    };

    fn contact(kind: ContactKind, axis: [f64; 3], point: [f64; 3], misfit: f64) -> Contact {
        Contact {
            first: 0,
            second: 1,
            kind,
            axis: Vector3::from(axis).normalize(),
            point: point.into(),
            clearance: 1e-4,
            misfit,
            size: 0.01,
            faces: (1, 2),
        }
    }

    #[test]
    fn what_agrees_within_the_play_is_made_equal() {
        use ContactKind::{Cylindrical, Planar, Spherical};
        let leaning = contact(Cylindrical, [0.005, 0.0, 1.0], [5e-5, 0.0, 0.01], 5e-5);
        let shaft = contact(Cylindrical, [0.0, 0.0, 1.0], [0.0; 3], 0.0);
        let head = contact(Planar, [0.0, -0.004, -1.0], [0.0; 3], 1e-5);
        let key = contact(Planar, [1.0, 0.003, 0.002], [0.0; 3], 2e-5);
        let ball = contact(Spherical, [0.0, 0.0, 1.0], [6e-5, 0.0, 0.02], 0.0);
        let found = settled(&[leaning, head, key, ball, shaft], PLAY).unwrap();
        let z = Vector3::z();
        assert_eq!(found[0].axis, z);
        assert_eq!(found[1].axis, -z);
        assert!(
            found[2].kind == Planar && found[2].axis.z == 0.0,
            "{found:?}"
        );
        assert_eq!((found[3].axis, found[3].point), (z, Vector3::zeros()));
        assert_eq!(found[4].point, z * 0.02);
    }

    #[test]
    fn normals_of_one_plane_stay_in_one_plane() {
        use ContactKind::Planar;
        let flank = |x: f64, y: f64, z: f64| contact(Planar, [x, y, z], [0.0; 3], 0.0);
        let found = [
            flank(0.0, 0.0, 1.0),
            flank(0.8, 0.0, -0.6),
            flank(-0.8, 1e-3, -0.6),
        ];
        let found = settled(&found, PLAY).unwrap();
        assert!(found[2].axis.y.abs() < 1e-15, "{found:?}");
    }

    #[test]
    fn what_is_in_between_is_unclear() {
        use ContactKind::{Cylindrical, Planar};
        let shaft = contact(Cylindrical, [0.0, 0.0, 1.0], [0.0; 3], 0.0);
        for other in [
            contact(Cylindrical, [0.0, 0.0, 1.0], [5e-4, 0.0, 0.0], 0.0),
            contact(Planar, [0.0, 0.05, 1.0], [0.0; 3], 0.0),
            contact(Planar, [1.0, 0.0, 0.05], [0.0; 3], 0.0),
        ] {
            let found = settled(&[shaft.clone(), other], PLAY);
            assert_eq!(found, None);
        }
        // Without play two directions may not differ by less than is drawn.
        let exact = Play {
            angle: 1e-6,
            length: 1e-9,
        };
        let off = contact(Planar, [0.0, 1e-5, 1.0], [0.0; 3], 0.0);
        assert_eq!(settled(&[shaft, off], exact), None);
    }
}
