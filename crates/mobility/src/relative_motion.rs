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
//! Cost: a decomposition of six rows for every pair of links and pose, as long as there are tangents that move the links. Seen from
//! the ground those that move nothing else any more are merged on the way outwards, so that a chain costs no more than its length.

use super::branch::{BranchPose, RelativeMotion};
use super::link_twists::{LinkTwists, coordinates};
use super::one_sided::OneSided;
use super::tangent_space::Limits;
use kutzbach_closure::Geometry;
use kutzbach_closure::Structure;
use kutzbach_math::group::{
    Axis, DisplacementSubgroup, Gauge, GroupError, Pose, ScrewSystem, Twist, classify,
};
use kutzbach_model::mechanism::Mechanism;
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
    motions_seen_from_ground(
        mechanism,
        &link_twists(mechanism, geometry, structure, poses),
    )
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
    let found = pairs.iter().filter_map(|&(link, relative_to)| {
        let first = seen.first()?;
        // One point of the other's frame for all poses, near the mechanism.
        let point = first.centre_in(relative_to);
        let spans = seen.iter().filter_map(|there| {
            let twists = there.relative(link, relative_to, &point);
            Span::of(&twists, first.length, &there.limits)
        });
        motion(first, link, relative_to, &spans.collect::<Vec<_>>())
    });
    found.collect()
}

/// Motions of all links but the ground relative to the ground, by link index.
pub(super) fn motions_seen_from_ground(
    mechanism: &Mechanism,
    seen: &[LinkTwists],
) -> Vec<RelativeMotion> {
    let Some(first) = seen.first() else {
        return Vec::new();
    };
    let ground = mechanism.ground().0;
    let point = first.centre_in(ground);
    let mut spans: Vec<Vec<Span>> = mechanism.links().iter().map(|_| Vec::new()).collect();
    for there in seen {
        there.each_link(|link, columns| {
            let twists = there.seen_from(ground, &point, columns);
            spans[link].extend(Span::of(&twists, first.length, &there.limits));
        });
    }
    let links = (0..spans.len()).filter(|link| *link != ground);
    links
        .filter_map(|link| motion(first, link, ground, &spans[link]))
        .collect()
}

fn motion(
    first: &LinkTwists,
    link: usize,
    relative_to: usize,
    spans: &[Span],
) -> Option<RelativeMotion> {
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
    let freedom = spans.iter().map(|span| span.basis.len()).max()?;
    let rotations = spans
        .iter()
        .filter(|span| span.basis.len() == freedom)
        .filter_map(Span::rotations)
        .max()?;
    let class = match freedom {
        0 => Some(DisplacementSubgroup::Identity),
        6 => Some(DisplacementSubgroup::General),
        _ => subgroup(spans, freedom, first.length, &first.centre_in(relative_to))
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
        let mut rows = vec![Vec::new(); 6];
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
        .map(|subgroup| tidied(subgroup.conjugated_by(&back), error, length)))
}

/// The same geometry with coordinates that are nothing but error set to zero.
///
/// Even of coarse numbers no more than a billionth is taken for error here: a coordinate that means something to a reader
/// is not to vanish.
fn tidied(subgroup: DisplacementSubgroup, error: f64, length: f64) -> DisplacementSubgroup {
    use DisplacementSubgroup as G;
    let error = error.min(1e-9);
    let cleaned = |v: Vector3<f64>, noise: f64| v.map(|x| if x.abs() <= noise { 0.0 } else { x });
    // What is left is a unit vector to within the square of the error.
    let direction = |v: Vector3<f64>| cleaned(v, error);
    let place = |v: Vector3<f64>| cleaned(v, error * (length + v.norm()));
    let line = |axis: Axis| Axis {
        point: place(axis.point),
        direction: direction(axis.direction),
    };
    match subgroup {
        G::Rotation { axis } => G::Rotation { axis: line(axis) },
        G::Cylindrical { axis } => G::Cylindrical { axis: line(axis) },
        G::Helical { axis, pitch } => G::Helical {
            axis: line(axis),
            pitch,
        },
        G::Translation { direction: d } => G::Translation {
            direction: direction(d),
        },
        G::PlanarTranslation { normal } => G::PlanarTranslation {
            normal: direction(normal),
        },
        G::Planar { normal } => G::Planar {
            normal: direction(normal),
        },
        G::Spherical { centre } => G::Spherical {
            centre: place(centre),
        },
        G::TranslatingScrew {
            direction: d,
            pitch,
        } => G::TranslatingScrew {
            direction: direction(d),
            pitch,
        },
        G::Schoenflies { direction: d } => G::Schoenflies {
            direction: direction(d),
        },
        G::Identity | G::SpatialTranslation | G::General => subgroup,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::branch::Tangent;
    use super::super::branch_samples::Sample;
    use super::*;
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{Direction, Frame, JointBuilder, JointKind, MechanismBuilder};

    impl Sample {
        fn motion(&self, link: &str, relative_to: &str) -> Option<RelativeMotion> {
            let index = |name| self.mechanism.link_named(name).unwrap().0;
            relative_motions(
                &self.mechanism,
                &self.geometry,
                &self.structure,
                &self.poses,
                &[(index(link), index(relative_to))],
            )
            .pop()
        }

        fn words(&self, link: &str, relative_to: &str) -> String {
            let motion = self.motion(link, relative_to).unwrap();
            let class = motion.class.map_or("-", |class| class.short_name());
            format!("{}{} {class}", motion.rotations, motion.translations)
        }
    }

    #[test]
    fn a_coupler_on_a_circle_is_in_no_subgroup() {
        let sample = Sample::parallelogram();
        assert_eq!(sample.words("r2", "ground"), "01 -");
        assert_eq!(sample.words("r1", "r3"), "01 -");
        assert_eq!(sample.words("r2", "r2"), "00 E");
        let crank = sample.motion("r3", "ground").unwrap();
        let Some(DisplacementSubgroup::Rotation { axis }) = crank.class else {
            panic!("{crank:?}")
        };
        assert_eq!(axis.direction, Vector3::z());
        assert!((axis.point - Vector3::new(2.0, 0.0, 0.0)).norm() < 1e-12);
        // In the frame of the crank, which has its origin at its first joint; the other hinge is one length away from it.
        let coupler = sample.motion("r2", "r1").unwrap();
        let Some(DisplacementSubgroup::Rotation { axis }) = coupler.class else {
            panic!("{coupler:?}")
        };
        assert!((axis.point - Vector3::new(0.0, 1.0, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn one_pose_tells_freedoms_but_no_class() {
        let mut sample = Sample::parallelogram();
        sample.poses.truncate(1);
        assert_eq!(sample.words("r1", "ground"), "10 -");
        assert_eq!(sample.words("r1", "r1"), "00 E");
        sample.poses.clear();
        assert!(sample.motion("r1", "ground").is_none());
    }

    #[test]
    fn poses_of_another_mechanism_are_not_used() {
        let mut sample = Sample::parallelogram();
        sample.poses[0].tangents[0] = vec![3.0, -3.0, 3.0].into();
        sample.poses[1].states.pop();
        assert_eq!(sample.words("r1", "ground"), "10 -");
        sample.poses[2].tangents[0] = vec![3.0, f64::NAN, 3.0, -3.0].into();
        assert!(sample.motion("r1", "ground").is_none());
    }

    #[test]
    fn the_scale_and_the_choice_of_the_tangents_mean_nothing() {
        let mut sample = Sample::sleeve();
        assert_eq!(sample.words("r1", "ground"), "11 C");
        for tangents in sample.poses.iter_mut().map(|pose| &mut pose.tangents) {
            let rates = tangents[1].entries().iter().map(|(v, x)| (*v, 1e-200 * x));
            tangents.push(Tangent::new(4, rates));
        }
        assert_eq!(sample.words("r1", "ground"), "11 C");
    }

    #[test]
    fn bridges_move_even_where_the_tangents_leave_them_out() {
        let number = |x: i64| Number::integer(x);
        let mut builder = MechanismBuilder::new("arm");
        builder
            .link("ground")
            .link("arm")
            .link("hand")
            .link("stone");
        let along = |x, y, z| Direction([x, y, z].map(number));
        builder.joint(
            JointBuilder::tree("turn", JointKind::Revolute, "ground", "arm")
                .origin(Frame::at([5, 0, 0].map(number)))
                .axis(along(0, 0, 1)),
        );
        builder.joint(
            JointBuilder::tree("reach", JointKind::Prismatic, "arm", "hand").axis(along(1, 0, 0)),
        );
        builder.floating("drop", "ground", "stone", Frame::identity());
        let poses = [0.2, 0.7].map(|x: f64| (vec![vec![x], vec![x]], vec![]));
        let sample = Sample::new(builder.build().unwrap(), poses.into());
        assert_eq!(sample.words("arm", "ground"), "10 R");
        assert_eq!(sample.words("hand", "arm"), "01 T");
        assert_eq!(sample.words("hand", "ground"), "11 -");
        // Nothing holds the stone.
        assert_eq!(sample.words("stone", "hand"), "33 D");
        let all = motions_to_ground(
            &sample.mechanism,
            &sample.geometry,
            &sample.structure,
            &sample.poses,
        );
        assert_eq!(all.len(), 3);
    }

    #[test]
    fn tangents_that_are_none_are_not_trusted() {
        // One hinge moves by half as much again: the cycle does not close along that.
        let mut sample = Sample::parallelogram();
        for pose in &mut sample.poses {
            pose.tangents[0] = vec![3.0, -4.5, 3.0, -3.0].into();
        }
        assert!(sample.motion("r2", "ground").is_none());
    }
}
