//! How links move relative to one another along a branch: freedom, and the displacement subgroup where it is one.
//!
//! Seen from the frame of another link, a link that moves within a displacement subgroup H has twists `Ṫ T⁻¹` in the
//! algebra of H at every pose: the algebra is right-invariant, so the spans of twists at different poses are the *same*
//! space. Conversely, where all of them lie in one space of the dimension of the motion and that space is closed under
//! the bracket, the motion stays in the coset `H T₀` of the pose it is counted from (Frobenius' theorem; Hervé 1978,
//! section 2). A coupler of a four-bar has one freedom, and its twists at several poses span three dimensions: it moves
//! within planar motion, but its own motion is no subgroup, and no class is given. What its axis does is told by the
//! smallest subalgebra that all the twists generate and by the pitch of each.
//!
//! A link that a hinge, a slider or a screw joins to the other moves as that joint lets it, whatever the digits of all
//! others: such a row is read off the joint ([`super::across_joints`]) and never off twists.
//!
//! Poses stand for the branch: they must be generic and a finite way apart, as those of [`super::Branch`] are.
//!
//! Cost: a decomposition of six rows for every pair of links and pose, as long as there are tangents that move the links. Seen from
//! the ground those that move nothing else any more are merged on the way outwards, so that a chain costs no more than its length.

use super::across_joints::{AcrossJoints, Between};
use super::branch::{BranchPose, RelativeMotion};
use super::branch_roles::roles_seen;
use super::link_twists::{LinkTwists, coordinates};
use super::one_sided::OneSided;
use super::roles::JointRole;
use super::tangent_space::Limits;
use kutzbach_closure::Geometry;
use kutzbach_closure::Structure;
use kutzbach_math::group::{
    Axis, DisplacementSubgroup, Gauge, GroupError, Pose, ScrewSystem, Subalgebra, Twist, classify,
};
use kutzbach_model::mechanism::Mechanism;
use nalgebra::Vector3;

/// Relative motions of pairs (link, relative to), in the order of the pairs.
///
/// Links are named by index. Every pair has its row, with `None` for what no pose tells clearly. The class is `None` too
/// where the motion is no subgroup and, unless a joint of one freedom between the links decides, the links stand still
/// relative to one another or move in every way, where there are fewer than two poses. Links that no chain of joints
/// connects have all six freedoms. A pose whose numbers are out of range, or that belongs to another mechanism, is not used.
#[must_use]
pub fn relative_motions(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    poses: &[BranchPose],
    pairs: &[(usize, usize)],
) -> Vec<RelativeMotion> {
    let seen = link_twists(mechanism, geometry, structure, poses);
    let Some(first) = seen.first() else {
        return pairs.iter().map(|&pair| unknown(pair)).collect();
    };
    let roles = roles_seen(mechanism, &seen);
    let across = AcrossJoints::new(mechanism, geometry, &roles, first);
    let found = pairs.iter().map(|&(link, relative_to)| {
        // One point of the other's frame for all poses, near the mechanism.
        let point = first.centre_in(relative_to);
        let spans: Vec<Span> = seen
            .iter()
            .filter_map(|there| {
                let twists = there.relative(link, relative_to, &point);
                Span::of(&twists, first.length, there)
            })
            .collect();
        motion(first, &across, (link, relative_to), &spans)
    });
    found.collect()
}

/// Motions of all links but the ground relative to the ground, by link index; see [`relative_motions`].
#[must_use]
pub fn motions_to_ground(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    poses: &[BranchPose],
) -> Vec<RelativeMotion> {
    let seen = link_twists(mechanism, geometry, structure, poses);
    let roles = roles_seen(mechanism, &seen);
    motions_seen_from_ground(mechanism, geometry, &roles, &seen)
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

/// Motions of all links but the ground relative to the ground, by link index, where the joints have these roles.
pub(super) fn motions_seen_from_ground(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    roles: &[JointRole],
    seen: &[LinkTwists],
) -> Vec<RelativeMotion> {
    let ground = mechanism.ground().0;
    let links = (0..mechanism.links().len()).filter(|link| *link != ground);
    let Some(first) = seen.first() else {
        return links.map(|link| unknown((link, ground))).collect();
    };
    let across = AcrossJoints::new(mechanism, geometry, roles, first);
    let point = first.centre_in(ground);
    let mut spans: Vec<Vec<Span>> = mechanism.links().iter().map(|_| Vec::new()).collect();
    for there in seen {
        there.each_link(|link, columns| {
            let twists = there.seen_from(ground, &point, columns);
            spans[link].extend(Span::of(&twists, first.length, there));
        });
    }
    links
        .map(|link| motion(first, &across, (link, ground), &spans[link]))
        .collect()
}

/// A pair of which nothing is known.
fn unknown((link, relative_to): (usize, usize)) -> RelativeMotion {
    RelativeMotion {
        link,
        relative_to,
        freedom: None,
        class: None,
        within: None,
        axes_move: false,
        joint: None,
        rotations: None,
        translations: None,
        pitches: None,
        tilts: None,
    }
}

/// A motion that is this subgroup.
fn is_subgroup(pair: (usize, usize), class: DisplacementSubgroup) -> RelativeMotion {
    let kind = class.kind();
    RelativeMotion {
        freedom: Some(class.dimension()),
        class: Some(class),
        within: Some(class),
        rotations: Some(kind.rotations()),
        translations: Some(class.dimension() - kind.rotations()),
        pitches: match class {
            DisplacementSubgroup::Rotation { .. } => Some([0.0; 2]),
            DisplacementSubgroup::Helical { pitch, .. } => Some([pitch; 2]),
            _ => None,
        },
        ..unknown(pair)
    }
}

/// The motion of a pair: what the joint between them says, then what their velocities at the poses do.
fn motion(
    first: &LinkTwists,
    across: &AcrossJoints<'_>,
    pair: (usize, usize),
    spans: &[Span],
) -> RelativeMotion {
    let (link, relative_to) = pair;
    if !first.connected(link, relative_to) {
        return is_subgroup(pair, DisplacementSubgroup::General);
    }
    let joint = match across.between(link, relative_to) {
        Between::Nothing => None,
        Between::Rigid => return is_subgroup(pair, DisplacementSubgroup::Identity),
        Between::Joint(joint) => Some(joint),
    };
    let allowed = joint.and_then(|joint| across.subgroup(joint, relative_to));
    if let (Some(joint), Some(class)) = (joint, allowed)
        && class.dimension() == 1
        && across.moves(joint)
    {
        return RelativeMotion {
            joint: Some(joint),
            ..is_subgroup(pair, class)
        };
    }
    let mut found = by_velocities(pair, first, spans);
    let Some(allowed) = allowed else {
        return found;
    };
    if found.freedom == Some(allowed.dimension()) {
        return RelativeMotion {
            joint: joint.filter(|_| allowed.dimension() == 1),
            ..is_subgroup(pair, allowed)
        };
    }
    if found
        .within
        .is_none_or(|within| within.dimension() >= allowed.dimension())
    {
        found.within = Some(allowed);
    }
    found
}

fn by_velocities(pair: (usize, usize), first: &LinkTwists, spans: &[Span]) -> RelativeMotion {
    let Some(freedom) = spans.iter().map(|span| span.basis.len()).max() else {
        return unknown(pair);
    };
    match freedom {
        0 => return is_subgroup(pair, DisplacementSubgroup::Identity),
        6 => return is_subgroup(pair, DisplacementSubgroup::General),
        _ => {}
    }
    let full: Vec<&Span> = spans
        .iter()
        .filter(|span| span.basis.len() == freedom)
        .collect();
    let rotations = full.iter().filter_map(|span| span.rotations()).max();
    // Three freedoms that do not turn are all there are.
    if (freedom, rotations) == (3, Some(0)) {
        return is_subgroup(pair, DisplacementSubgroup::SpatialTranslation);
    }
    if let Some(tilts) = tilts(&full, rotations, first.length) {
        return RelativeMotion {
            freedom: Some(freedom),
            rotations: Some(0),
            translations: Some(freedom),
            tilts: Some(tilts),
            ..unknown(pair)
        };
    }
    let point = first.centre_in(pair.1);
    let found = enclosing(spans, freedom, first.length).ok().flatten();
    let (error, placed) = found.as_ref().map_or((0.0, None), |found| {
        let back = Pose::translation(point);
        (found.error, found.within.map(|g| g.conjugated_by(&back)))
    });
    let within = placed.map(|subgroup| tidied(subgroup, error, first.length));
    let axes_move = found.as_ref().is_some_and(|found| found.axes_move);
    let class = within.filter(|g| g.dimension() == freedom && !axes_move);
    if let Some(class) = class.filter(|_| found.is_some_and(|found| found.clear)) {
        return is_subgroup(pair, class);
    }
    let pitches = match (freedom, rotations) {
        (1, Some(1)) => pitches(&full, first.length),
        _ => None,
    };
    RelativeMotion {
        freedom: Some(freedom),
        within: within.filter(|g| g.dimension() > freedom),
        axes_move,
        rotations,
        translations: rotations.map(|rotations| freedom - rotations),
        pitches,
        ..unknown(pair)
    }
}

/// Turning by less than this beside sliding by the mechanism's length (rad) is a tilt: half a degree.
const TILT: f64 = 0.01;

/// By how much a link that translates in several ways tilts meanwhile (rad/m), where it does.
fn tilts(spans: &[&Span], rotations: Option<usize>, length: f64) -> Option<f64> {
    let first = spans.first()?;
    if first.basis.len() < 2 || rotations == Some(0) {
        return None;
    }
    let mut most = 0.0f64;
    for span in spans {
        most = most.max(*span.angular()?.first()?);
    }
    (most < TILT && most > AS_WRITTEN).then_some(most / length)
}

/// What one pose lets a link do relative to another.
struct Span {
    /// Orthonormal, in radians and lengths of the mechanism.
    basis: Vec<[f64; 6]>,
    /// Bound on the error of each.
    error: f64,
    /// The same of the numbers as they are written.
    as_written: f64,
}

impl Span {
    /// `None` where the dimension is doubtful.
    ///
    /// What the digits leave open is asked of the numbers as they are: where they close, their motion is one that they stand for.
    fn of(twists: &[Twist], length: f64, there: &LinkTwists) -> Option<Self> {
        let mut rows = vec![Vec::new(); 6];
        for twist in twists {
            for (row, x) in rows.iter_mut().zip(coordinates(twist, length)) {
                row.push(x);
            }
        }
        let found = OneSided::of(rows)?;
        let asked = [&there.limits, &there.as_written];
        let (limits, dimension) = asked
            .into_iter()
            .find_map(|limits| Some((limits, limits.rank(&found.values)?)))?;
        let smallest = dimension.checked_sub(1).map_or(1.0, |k| found.values[k]);
        Some(Self {
            basis: found.combinations[..dimension]
                .iter()
                .map(|combination| std::array::from_fn(|i| combination[i]))
                .collect(),
            // Wedin (1972): the space of singular vectors turns by the error over the smallest value kept.
            error: limits.error / smallest,
            as_written: there.as_written.error / smallest,
        })
    }

    /// Rank of the angular parts; `None` where it is doubtful.
    fn rotations(&self) -> Option<usize> {
        let values = self.angular()?;
        let rank = |error: f64| Limits::new(error, 6).rank(&values);
        rank(self.error).or_else(|| rank(self.as_written))
    }

    /// Singular values of the angular parts, largest first.
    fn angular(&self) -> Option<Vec<f64>> {
        let angular = self.basis.iter().map(|twist| twist[..3].to_vec());
        OneSided::of(angular.collect()).map(|found| found.values)
    }

    fn twists(&self, length: f64) -> impl Iterator<Item = Twist> + '_ {
        self.basis.iter().map(move |x| {
            let linear = Vector3::new(x[3], x[4], x[5]) * length;
            Twist::new(Vector3::new(x[0], x[1], x[2]), linear)
        })
    }
}

/// A difference of pitches, in lengths of the mechanism, that is none to a reader of coarse numbers.
const NO_PITCH: f64 = 1e-3;

/// The least and the greatest pitch (m/rad) of one-dimensional spans; `None` where one is doubtful.
fn pitches(spans: &[&Span], length: f64) -> Option<[f64; 2]> {
    let mut found = Vec::with_capacity(spans.len());
    for span in spans {
        let [x] = span.basis.as_slice() else {
            return None;
        };
        let (turn, slide) = (
            Vector3::new(x[0], x[1], x[2]),
            Vector3::new(x[3], x[4], x[5]),
        );
        let square = turn.norm_squared();
        let pitch = turn.dot(&slide) / square;
        // Of a product of unit vectors over a square, each wrong by the error: three errors and the square's two.
        let error = span.error * (2.0 + 2.0 * pitch.abs() * turn.norm()) / square;
        let none = pitch.abs() <= (10.0 * error).min(NO_PITCH);
        if !none && !(pitch.abs() > (10.0 * error).min(VISIBLE)) {
            return None;
        }
        found.push(if none { 0.0 } else { pitch * length });
    }
    let least = found.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = found.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Some([least, greatest])
}

/// The subgroup that velocities at several poses generate.
#[derive(Clone, Copy)]
struct Enclosing {
    /// `None` where the last pose still adds to it.
    within: Option<DisplacementSubgroup>,
    /// Whether the velocities clearly span more at all poses together than at one.
    axes_move: bool,
    /// Whether no decision about the subgroup is thin.
    clear: bool,
    error: f64,
}

/// What rounding alone leaves of directions at poses that are closed as written (rad, lengths of the mechanism).
const AS_WRITTEN: f64 = 1e-9;

/// A subgroup found no more finely than this says nothing, however coarse the numbers.
const COARSEST: f64 = 1e-3;

/// An axis that moves by so much moves in the file as written, whatever its precision leaves open: three degrees, or a
/// twentieth of the mechanism's size.
const VISIBLE: f64 = 0.05;

/// `None` where there are too few poses, or where the numbers are so coarse that directions mean nothing.
///
/// Coarse numbers are asked twice: whether the motion stays in a subgroup as it is written, and whether it does within what they
/// leave open. The smaller subgroup that holds all velocities is the answer.
fn enclosing(spans: &[Span], freedom: usize, length: f64) -> Result<Option<Enclosing>, GroupError> {
    if spans.len() < 2 {
        return Ok(None);
    }
    let error = spans.iter().fold(0.0, |m: f64, span| m.max(span.error));
    // Ten errors count as none, as for freedoms; the gauge's tolerance is that of a screw's axis, which bounds its
    // direction in the space of twists to 2.14 of it.
    let wanted = 10.0 * error / 2.14;
    let tolerances = match wanted <= AS_WRITTEN {
        true => vec![wanted],
        false => vec![AS_WRITTEN, wanted.min(COARSEST)],
    };
    let mut best: Option<Enclosing> = None;
    for tolerance in tolerances {
        let gauge = match Gauge::new(Vector3::zeros(), length, tolerance) {
            Ok(gauge) => gauge,
            // So coarse that directions mean nothing.
            Err(GroupError::BadGauge { .. }) => continue,
            Err(error) => return Err(error),
        };
        let found = enclosing_to(spans, freedom, &gauge, error)?;
        let size = |of: &Enclosing| of.within.map_or(7, |within| within.dimension());
        best = match best {
            Some(known) if size(&known) <= size(&found) => Some(known),
            _ => Some(found),
        };
    }
    Ok(best)
}

/// Whether velocities at one pose are clearly none of those at another.
fn moves_its_axes(spans: &[Span], gauge: &Gauge, error: f64) -> Result<bool, GroupError> {
    let least = (100.0 * error / 2.14).clamp(
        10.0 * gauge.tolerance(),
        VISIBLE.max(10.0 * gauge.tolerance()),
    );
    let Some((first, others)) = spans.split_first() else {
        return Ok(false);
    };
    let twists = |span: &Span| span.twists(gauge.length()).collect::<Vec<_>>();
    let here = ScrewSystem::span(&twists(first), gauge)?;
    let others = others.iter().flat_map(twists);
    Ok(others
        .map(|twist| here.distance(&twist))
        .fold(0.0, f64::max)
        >= least)
}

fn enclosing_to(
    spans: &[Span],
    freedom: usize,
    gauge: &Gauge,
    error: f64,
) -> Result<Enclosing, GroupError> {
    let length = gauge.length();
    let of = |spans: &[Span]| -> Vec<Twist> {
        spans.iter().flat_map(|span| span.twists(length)).collect()
    };
    let twists = of(spans);
    let system = ScrewSystem::span(&twists, gauge)?;
    let holds = |subgroup: &DisplacementSubgroup| -> Result<bool, GroupError> {
        let all = ScrewSystem::span(&subgroup.algebra(), gauge)?;
        let away = twists.iter().map(|twist| all.distance(twist));
        Ok(away.fold(0.0, f64::max) <= 10.0 * gauge.tolerance().max(1e-14))
    };
    if system.dimension() == freedom {
        let found = classify(&system)?;
        let within = match found.subgroup {
            Some(subgroup) if holds(&subgroup)? => Some(subgroup),
            _ => None,
        };
        return Ok(Enclosing {
            within,
            axes_move: false,
            clear: found.margin.kept >= 10.0,
            error,
        });
    }
    let all = Subalgebra::generated_by_system(&system)?;
    // What the poses before the last one generate holds the last one too, unless the motion leaves it elsewhere as well.
    let before = &spans[..spans.len() - 1];
    let confirmed = all.dimension() == 6
        || Subalgebra::generated_by(&of(before), gauge)?.dimension() == all.dimension();
    let within = match all.subgroup()? {
        // To coarse numbers every short piece of a curve is plane.
        Some(DisplacementSubgroup::PlanarTranslation { .. })
            if gauge.tolerance() > AS_WRITTEN && confirmed =>
        {
            Some(DisplacementSubgroup::SpatialTranslation)
        }
        Some(subgroup) if confirmed && holds(&subgroup)? => Some(subgroup),
        _ => None,
    };
    Ok(Enclosing {
        within,
        axes_move: moves_its_axes(spans, gauge, error)?,
        clear: all.margin().kept >= 10.0,
        error,
    })
}

/// The same geometry with coordinates that are nothing but error set to zero.
///
/// Even of coarse numbers no more than a billionth is taken for error here: a coordinate that means something to a reader
/// is not to vanish.
pub(super) fn tidied(
    subgroup: DisplacementSubgroup,
    error: f64,
    length: f64,
) -> DisplacementSubgroup {
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
            let count = |number: Option<usize>| number.map_or("?".to_owned(), |n| n.to_string());
            format!(
                "{}{} {class}",
                count(motion.rotations),
                count(motion.translations)
            )
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
        assert_eq!(sample.words("r2", "ground"), "01 -");
        // What a hinge allows is read off the hinge.
        assert_eq!(sample.words("r1", "ground"), "10 R");
        assert_eq!(sample.words("r1", "r1"), "00 E");
        sample.poses.clear();
        assert_eq!(sample.motion("r2", "ground").unwrap().freedom, None);
    }

    #[test]
    fn poses_of_another_mechanism_are_not_used() {
        let mut sample = Sample::parallelogram();
        sample.poses[0].tangents[0] = vec![3.0, -3.0, 3.0].into();
        sample.poses[1].states.pop();
        assert_eq!(sample.words("r2", "ground"), "01 -");
        sample.poses[2].tangents[0] = vec![3.0, f64::NAN, 3.0, -3.0].into();
        assert_eq!(sample.motion("r2", "ground").unwrap().freedom, None);
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
        assert_eq!(sample.motion("r2", "ground").unwrap().freedom, None);
    }
}
