//! How links move relative to one another along a branch: freedom, and the displacement subgroup where it is one.
//!
//! Seen from the frame of another link, a link that moves within a displacement subgroup H has twists `Ṫ T⁻¹` in the
//! algebra of H at every pose: the algebra is right-invariant, so the spans of twists at different poses are the *same*
//! space. Conversely, where all of them lie in one space of the dimension of the motion and that space is closed under
//! the bracket, the motion stays in the coset `H T₀` of the pose it is counted from (Frobenius' theorem; Hervé 1978,
//! section 2). A coupler of a four-bar has one freedom, and its twists at several poses span three dimensions: it moves
//! within planar motion, but its own motion is no subgroup, and no class is given.
//!
//! Poses stand for the branch: they must be generic and a finite way apart, as those of [`super::Branch`] are.
//!
//! Cost: linear in links × tangents, and a decomposition of six rows for every pair of links and pose.

use super::branch::{BranchPose, RelativeMotion};
use super::link_twists::{LinkTwists, coordinates};
use super::one_sided::OneSided;
use super::structure::Structure;
use super::tangent_space::Limits;
use crate::closure::Geometry;
use crate::group::{DisplacementSubgroup, Gauge, GroupError, Pose, ScrewSystem, Twist, classify};
use crate::mechanism::Mechanism;
use nalgebra::Vector3;

/// Relative motions of pairs (link, relative to), in the order of the pairs.
///
/// Links are named by index. A pair whose freedom no pose tells clearly is left out: an answer would be a guess. The class
/// is `None` where the motion is no subgroup, where the margin does not tell, and, unless the links stand still relative
/// to one another or move in every way, where there are fewer than two poses. Links that no chain of joints connects have
/// all six freedoms. A pose whose numbers are out of range, or that belongs to another mechanism, is not used.
#[must_use]
pub fn relative_motions(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    poses: &[BranchPose],
    pairs: &[(usize, usize)],
) -> Vec<RelativeMotion> {
    motions_seen(&link_twists(mechanism, geometry, structure, poses), pairs)
}

/// Motions of all links but the ground relative to the ground, by link index; see [`relative_motions`].
#[must_use]
pub fn motions_to_ground(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    poses: &[BranchPose],
) -> Vec<RelativeMotion> {
    relative_motions(mechanism, geometry, structure, poses, &to_ground(mechanism))
}

pub(super) fn to_ground(mechanism: &Mechanism) -> Vec<(usize, usize)> {
    let ground = mechanism.ground().0;
    (0..mechanism.links().len())
        .filter(|link| *link != ground)
        .map(|link| (link, ground))
        .collect()
}

/// The twists of all links at every usable pose.
pub(super) fn link_twists(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    poses: &[BranchPose],
) -> Vec<LinkTwists> {
    poses
        .iter()
        .filter_map(|pose| LinkTwists::at(mechanism, geometry, structure, pose))
        .collect()
}

pub(super) fn motions_seen(seen: &[LinkTwists], pairs: &[(usize, usize)]) -> Vec<RelativeMotion> {
    pairs
        .iter()
        .filter_map(|&(link, relative_to)| motion(seen, link, relative_to))
        .collect()
}

fn motion(seen: &[LinkTwists], link: usize, relative_to: usize) -> Option<RelativeMotion> {
    let first = seen.first()?;
    let found = |freedom, rotations, class| {
        Some(RelativeMotion {
            link,
            relative_to,
            freedom,
            class,
            rotations,
            translations: freedom - rotations,
        })
    };
    if !first.connected(link, relative_to) {
        return found(6, 3, Some(DisplacementSubgroup::General));
    }
    // One point of the other's frame for all poses, near the mechanism.
    let point = first.centre_in(relative_to);
    let spans: Vec<Span> = seen
        .iter()
        .filter_map(|there| {
            let twists = there.relative(link, relative_to, &point);
            Span::of(&twists, first.length, &there.limits)
        })
        .collect();
    let freedom = spans.iter().map(|span| span.basis.len()).max()?;
    let rotations = spans
        .iter()
        .filter(|span| span.basis.len() == freedom)
        .filter_map(Span::rotations)
        .max()?;
    let class = match freedom {
        0 => Some(DisplacementSubgroup::Identity),
        6 => Some(DisplacementSubgroup::General),
        _ => subgroup(&spans, freedom, first.length, &point)
            .ok()
            .flatten(),
    };
    found(freedom, rotations, class)
}

/// What one pose lets a link do relative to another.
struct Span {
    /// Orthonormal, in radians and lengths of the mechanism.
    basis: Vec<[f64; 6]>,
    /// Bound on the error of each.
    error: f64,
}

impl Span {
    /// `None` where the dimension is doubtful.
    fn of(twists: &[Twist], length: f64, limits: &Limits) -> Option<Self> {
        let mut rows = vec![Vec::with_capacity(twists.len()); 6];
        for twist in twists {
            for (row, x) in rows.iter_mut().zip(coordinates(twist, length)) {
                row.push(x);
            }
        }
        let found = OneSided::of(rows)?;
        let dimension = limits.rank(&found.values)?;
        let smallest = dimension.checked_sub(1).map_or(1.0, |k| found.values[k]);
        Some(Self {
            basis: found.combinations[..dimension]
                .iter()
                .map(|combination| std::array::from_fn(|i| combination[i]))
                .collect(),
            // Wedin (1972): the space of singular vectors turns by the error over the smallest value kept.
            error: limits.error / smallest,
        })
    }

    /// Rank of the angular parts; `None` where it is doubtful.
    fn rotations(&self) -> Option<usize> {
        let angular = self.basis.iter().map(|twist| twist[..3].to_vec());
        let found = OneSided::of(angular.collect())?;
        Limits::new(self.error, 6).rank(&found.values)
    }
}

/// The subgroup whose algebra all the spans together are, if they are one of the dimension of the motion.
fn subgroup(
    spans: &[Span],
    freedom: usize,
    length: f64,
    point: &Vector3<f64>,
) -> Result<Option<DisplacementSubgroup>, GroupError> {
    if spans.len() < 2 {
        return Ok(None);
    }
    let error = spans.iter().fold(0.0, |m: f64, span| m.max(span.error));
    // Ten errors count as none, as for freedoms; the gauge's tolerance is that of a screw's axis, which bounds its
    // direction in the space of twists to 2.14 of it.
    let gauge = match Gauge::new(Vector3::zeros(), length, 10.0 * error / 2.14) {
        Ok(gauge) => gauge,
        // So coarse that directions mean nothing.
        Err(GroupError::BadGauge { .. }) => return Ok(None),
        Err(error) => return Err(error),
    };
    let twists: Vec<Twist> = spans
        .iter()
        .flat_map(|span| &span.basis)
        .map(|x| {
            let linear = Vector3::new(x[3], x[4], x[5]) * length;
            Twist::new(Vector3::new(x[0], x[1], x[2]), linear)
        })
        .collect();
    let system = ScrewSystem::span(&twists, &gauge)?;
    if system.dimension() != freedom {
        return Ok(None);
    }
    let found = classify(&system)?;
    // A pitch, or a rotation, that is barely above its error is as good as none.
    let clear = found.margin.kept >= 10.0;
    let back = Pose::translation(*point);
    Ok(found
        .subgroup
        .filter(|_| clear)
        .map(|subgroup| subgroup.conjugated_by(&back)))
}
