//! Offsets that double precision does not see: two axes 1e-15 m apart are one to it, and generate another subgroup.

use super::super::more_digits::MoreDigits;
use super::super::pose_rank::{PartRank, Pose};
use super::placing::link_poses;
use kutzbach_closure::{Arithmetic, Geometry, JointState, Part, PlacedScrew};
use kutzbach_math::matrix::{Extended, MatrixError, Real};
use kutzbach_math::space::{cross, dot, length, subtract};
use kutzbach_model::mechanism::Mechanism;

/// Below this (rad, part lengths) doubles may take an offset for none.
const SEEN_IN_DOUBLE: f64 = 1e-7;

/// What exceeds rounding by this factor is there.
const CLEAR: f64 = 1e6;

/// What two screws of a part are apart by, if it is so little that doubles take it for nothing and many digits do not.
///
/// Asked in the bits of the part's rank; with those of a double it finds nothing.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn hidden_offset(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    rank: &PartRank,
) -> Result<Option<f64>, MatrixError> {
    if rank.bits <= 53 {
        return Ok(None);
    }
    let (geometry, states) = more.polished(pose, part, !pose.as_drawn, rank.bits)?;
    let placed = (pose.mechanism, geometry, states, part);
    Ok(between(&part.joints, placed, rank.jacobian.length))
}

/// Bits in which joints of one link are compared.
const BITS: u32 = 212;

/// The same between some joints of a part as the file draws them, for joints of one link: what these are apart by, no motion changes.
pub fn drawn_hidden_offset(
    mechanism: &Mechanism,
    part: &Part,
    joints: &[usize],
    size: f64,
) -> Option<f64> {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::bits(BITS));
    between(joints, (mechanism, &geometry, &geometry.states, part), size)
}

/// The first hidden offset between the screws of joints.
fn between(
    joints: &[usize],
    (mechanism, geometry, states, part): (
        &Mechanism,
        &Geometry<Extended>,
        &[JointState<Extended>],
        &Part,
    ),
    size: f64,
) -> Option<f64> {
    let (poses, _) = link_poses(mechanism, geometry, states, part);
    let screws: Vec<PlacedScrew<Extended>> = joints
        .iter()
        .flat_map(|&joint| {
            let predecessor = mechanism.joints()[joint].predecessor.link.0;
            let frame = poses[&predecessor].compose(&geometry.sides[joint][0]);
            let screws = geometry.displacements[joint].screws(&states[joint]);
            let moved: Vec<_> = screws.iter().map(|screw| screw.moved(&frame)).collect();
            moved
        })
        .collect();
    let least = CLEAR * geometry.one.unit_roundoff();
    let hidden = |x: &f64| *x > least && *x < SEEN_IN_DOUBLE;
    screws.iter().enumerate().find_map(|(index, a)| {
        let mut others = screws[index + 1..].iter();
        others.find_map(|b| offsets(a, b, size).into_iter().find(hidden))
    })
}

/// The angle between two screws, and for rotations the distance of their axes and that of their points (part lengths).
fn offsets(a: &PlacedScrew<Extended>, b: &PlacedScrew<Extended>, size: f64) -> Vec<f64> {
    let direction = |s: &PlacedScrew<Extended>| {
        let turns = length(&s.angular).to_f64() > 0.5;
        (
            turns,
            if turns {
                s.angular.clone()
            } else {
                s.linear.clone()
            },
        )
    };
    let ((a_turns, along), (b_turns, other)) = (direction(a), direction(b));
    let normal = cross(&along, &other);
    let angle = length(&normal);
    let mut found = vec![angle.to_f64(), dot(&along, &other).abs().to_f64()];
    if a_turns && b_turns {
        let between = subtract(&b.point, &a.point);
        found.push(length(&cross(&between, &along)).to_f64() / size);
        if angle.to_f64() > 0.0 {
            found.push((dot(&between, &normal) / angle).abs().to_f64() / size);
        }
    }
    found
}
