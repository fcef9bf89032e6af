//! One cycle of the constraint graph, walked joint by joint.
//!
//! The walk starts in the frame of the cycle's first link, so nothing depends on where the mechanism stands in the world,
//! nor on how far the cycle is from the ground: a chain of ten thousand loops keeps the digits of a single one.

use super::displacement::JointState;
use super::geometry::{Geometry, Uncertainty, least_length};
use kutzbach_math::matrix::Real;
use kutzbach_math::space::{self, PlacedScrew, Rigid, Vector, three};

/// A cycle as the closure module sees it: joints in order, and whether each is passed from predecessor to successor.
pub type Walk = [(usize, bool)];

/// The screws of one joint of a cycle, in the frame of the cycle's first link.
#[derive(Clone, Debug)]
pub struct WalkedJoint<R> {
    /// Index of the joint.
    pub joint: usize,
    /// Whether the walk passes from predecessor to successor; the screws count negative otherwise.
    pub forward: bool,
    /// One screw per variable.
    pub screws: Vec<PlacedScrew<R>>,
    /// The predecessor's joint frame.
    pub frame: Rigid<R>,
}

/// What a walk around a cycle finds.
#[derive(Clone, Debug)]
pub struct WalkedCycle<R> {
    /// The joints in order.
    pub joints: Vec<WalkedJoint<R>>,
    /// What is left after going round: identity when the cycle closes.
    pub closure: Rigid<R>,
    /// A point near the cycle's axes (m, in the frame of its first link): the least-squares point of the axes.
    pub centre: [f64; 3],
    /// The cycle's own length scale (m): RMS distance of its axes to the centre; see [`characteristic_length`].
    pub length: f64,
    /// Largest coordinate met (m): rounding errors of positions are proportional to it.
    pub reach: f64,
    /// Largest distance of a joint from the centre (m): a wrong angle at one joint moves the others by up to that much.
    pub extent: f64,
    /// What the stated precision leaves open of the cycle's joints together.
    pub uncertainty: Uncertainty,
}

impl<R: Real> WalkedCycle<R> {
    /// Walks around a cycle at given joint states.
    pub fn walk(geometry: &Geometry<R>, states: &[JointState<R>], cycle: &Walk) -> Self {
        let mut pose = Rigid::identity(&geometry.one);
        let mut joints = Vec::with_capacity(cycle.len());
        let mut reach = 0.0f64;
        let far = |p: &Vector<R>| p.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
        for &(joint, forward) in cycle {
            let [predecessor, successor] = &geometry.sides[joint];
            let (displacement, screws) =
                geometry.displacements[joint].displacement_and_screws(&states[joint]);
            reach = reach
                .max(far(&predecessor.translation))
                .max(far(&successor.translation));
            let joint_frame = if forward {
                let frame = pose.compose(predecessor);
                pose = frame.compose(&displacement).compose(&successor.inverse());
                frame
            } else {
                let frame = pose.compose(successor).compose(&displacement.inverse());
                pose = frame.compose(&predecessor.inverse());
                frame
            };
            reach = reach.max(far(&joint_frame.translation));
            // In the memory of those that they come from.
            let screws = screws.into_iter();
            let screws = screws.map(|screw| screw.moved(&joint_frame)).collect();
            joints.push(WalkedJoint {
                joint,
                forward,
                screws,
                frame: joint_frame,
            });
        }
        let uncertainty = Uncertainty::total(
            cycle
                .iter()
                .map(|(joint, _)| &geometry.uncertainties[*joint]),
        );
        let arm = || match geometry.arm(cycle) {
            0.0 => cycle
                .first()
                .map_or(0.0, |(joint, _)| geometry.arms[*joint]),
            arm => arm,
        };
        let (centre, length) = characteristic_length(
            joints.iter().flat_map(|j| &j.screws),
            reach,
            arm,
            &uncertainty,
        );
        let extent = joints
            .iter()
            .map(|joint| {
                let point = joint.frame.translation.clone().map(|x| x.to_f64());
                space::length(&space::subtract(&point, &centre))
            })
            .fold(0.0, f64::max);
        Self {
            joints,
            closure: pose,
            centre,
            length,
            reach,
            extent,
            uncertainty,
        }
    }

    /// What is left after going round a cycle, without anything else that a walk finds.
    pub fn around(geometry: &Geometry<R>, states: &[JointState<R>], cycle: &Walk) -> Rigid<R> {
        let mut pose = Rigid::identity(&geometry.one);
        for &(joint, forward) in cycle {
            let [predecessor, successor] = &geometry.sides[joint];
            let displacement = geometry.displacements[joint].displacement(&states[joint]);
            let passed = predecessor
                .compose(&displacement)
                .compose(&successor.inverse());
            pose = pose.compose(&if forward { passed } else { passed.inverse() });
        }
        pose
    }

    /// Number of screws, of all joints together.
    pub fn screw_count(&self) -> usize {
        self.joints.iter().map(|joint| joint.screws.len()).sum()
    }

    /// The six closure equations' value, about the centre: rotation vector (rad), then displacement of the centre in
    /// units of the cycle's length.
    pub fn residual(&self) -> [R; 6] {
        let like = &self.closure.translation[0];
        let centre = self.centre.map(|x| like.constant(x));
        let inverse = like.one_like() / like.constant(self.length);
        let rotation = self.closure.rotation_vector();
        let moved = self.closure.apply(&centre);
        let [a, b, c] = rotation;
        let [x, y, z] = three(|i| (moved[i].clone() - centre[i].clone()) * inverse.clone());
        [a, b, c, x, y, z]
    }

    /// The column of one variable in the cycle's six rows: the screw about the centre, lengths in units of the cycle's
    /// own, negative where the joint is passed backward.
    pub fn column(&self, joint: &WalkedJoint<R>, screw: &PlacedScrew<R>) -> [R; 6] {
        let like = &self.closure.translation[0];
        let centre = self.centre.map(|x| like.constant(x));
        let inverse = like.one_like() / like.constant(self.length);
        let (angular, linear) = screw.about(&centre);
        let [x, y, z] = linear.map(|v| v * inverse.clone());
        let [a, b, c] = angular;
        let column = [a, b, c, x, y, z];
        if joint.forward {
            column
        } else {
            column.map(|v| -v)
        }
    }
}

/// The least-squares point of a set of axes and the RMS distance of the axes to it (m).
///
/// The point minimises `Σ |(I − u uᵀ)(c − p)|²`. Where that leaves a direction open (all axes parallel) it stays at the
/// mean of the axis points along that direction. Where no length is left because all axes meet in a point, as far as
/// rounding and stated precision let that be seen, the size of the set of axis points serves, then the RMS pitch, then `arm`, the
/// length of the longest link that has one for sure (m; 0 if none has, see [`Geometry::arm`]; asked for here only), then `reach`,
/// the largest coordinate met (m); finally 1 m. What rounding leaves of coordinates up to `reach` is no length.
pub fn characteristic_length<'a, R: Real + 'a>(
    screws: impl Iterator<Item = &'a PlacedScrew<R>>,
    reach: f64,
    arm: impl FnOnce() -> f64,
    uncertainty: &Uncertainty,
) -> ([f64; 3], f64) {
    use nalgebra::{Matrix3, Vector3};
    let least = least_length(reach);
    // All lengths below are in units of the reach, so that squares stay in the range of numbers.
    let unit = if reach > least && reach.is_finite() {
        reach
    } else {
        1.0
    };
    let axes: Vec<(Vector3<f64>, Vector3<f64>, f64)> = screws
        .filter_map(|screw| {
            let u = Vector3::from(screw.angular.clone().map(|x| x.to_f64()));
            let p = Vector3::from(screw.point.clone().map(|x| x.to_f64() / unit));
            let l = Vector3::from(screw.linear.clone().map(|x| x.to_f64() / unit));
            (u.norm() > 0.5 && p.iter().all(|x| x.is_finite()))
                .then(|| (u.normalize(), p, l.norm()))
        })
        .collect();
    if axes.is_empty() {
        // Translations only: the rank has no length in it, and any positive one will do.
        let arm = arm();
        return ([0.0; 3], if arm > least { arm } else { unit });
    }
    let count = axes.len() as f64;
    let mean = axes.iter().map(|(_, p, _)| p).sum::<Vector3<f64>>() / count;
    let mut normal = Matrix3::zeros();
    let mut right = Vector3::zeros();
    for (u, p, _) in &axes {
        let across = Matrix3::identity() - u * u.transpose();
        normal += across;
        right += across * (p - mean);
    }
    // Directions the axes leave open have an eigenvalue of zero; 1e-6 of the count is far above rounding and far below
    // what two axes that differ visibly in direction contribute, and a small shift of the centre does no harm. Axes that are
    // parallel but for a tilt e by their stated digits meet at about 1/e times their distance: damped by 4 e, the centre stays
    // within a fraction of that distance.
    let open = (4.0 * uncertainty.angles).clamp(1e-6, 1.0);
    let damped = normal + Matrix3::identity() * (open * count);
    let centre = damped
        .try_inverse()
        .map_or(mean, |inverse| mean + inverse * right);
    let rms = |distances: &mut dyn Iterator<Item = f64>| {
        (distances.map(|d| d * d).sum::<f64>() / count).sqrt()
    };
    let size = axes
        .iter()
        .map(|(_, p, _)| (p - centre).norm())
        .fold(0.0, f64::max);
    let spread = rms(&mut axes.iter().map(|(u, p, _)| (p - centre).cross(u).norm()));
    let pitch = rms(&mut axes.iter().map(|(_, _, pitch)| *pitch));
    // What is not far above an error of the axes' places is no length of the mechanism. The damping moves the centre by
    // up to a millionth of the size; rounding moves points by 1e-16 of the reach; numbers as they are stated move axes
    // by about their uncertainty together, of which four times is hardly ever exceeded.
    let places = (4.0 * uncertainty.lengths).max(least) / unit;
    let tilts = 4.0 * uncertainty.angles * size;
    let is_length = |length: f64, least: f64| length > least && length > 1e-9 && length.is_finite();
    let length = [
        (spread, (1e-3 * size).max(places + tilts)),
        (size, places),
        (pitch, places),
    ]
    .into_iter()
    .find_map(|(length, least)| is_length(length, least).then_some(length))
    .or_else(|| Some(arm() / unit).filter(|&arm| is_length(arm, least / unit)))
    .unwrap_or(1.0);
    ((centre * unit).into(), length * unit)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::geometry::Arithmetic;
    use super::super::samples::{
        CRANK_ROCKER, Place, Written, planar, ring, sarrus_places, spherical,
    };
    use super::*;
    use kutzbach_model::mechanism::JointKind;
    use proptest::prelude::*;

    fn walked(places: &[Place], gap: [f64; 3]) -> WalkedCycle<f64> {
        let mechanism = ring(places, gap, Written::Exactly);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let cycle: Vec<(usize, bool)> = (0..places.len()).map(|joint| (joint, true)).collect();
        WalkedCycle::walk(&geometry, &geometry.states, &cycle)
    }

    fn screw(angular: Vector<f64>, point: Vector<f64>) -> PlacedScrew<f64> {
        PlacedScrew {
            angular: space::unit(&angular),
            point,
            linear: [0.0; 3],
        }
    }

    fn scale_of(screws: &[PlacedScrew<f64>], reach: f64) -> ([f64; 3], f64) {
        characteristic_length(screws.iter(), reach, || 0.0, &Uncertainty::default())
    }

    #[test]
    fn a_closed_loop_leaves_nothing() {
        for places in [planar(&CRANK_ROCKER), sarrus_places()] {
            let walk = walked(&places, [0.0; 3]);
            assert!(walk.residual().iter().all(|r| r.abs() < 1e-15));
            assert_eq!(walk.joints.len(), places.len());
        }
    }

    #[test]
    fn a_gap_counts_in_lengths_of_the_cycle() {
        let walk = walked(&planar(&CRANK_ROCKER), [0.0, 0.0, 0.5]);
        let residual = walk.residual();
        assert!(
            residual[..3].iter().all(|r| r.abs() < 1e-15),
            "nothing turns"
        );
        assert!((residual[5].abs() * walk.length - 0.5).abs() < 1e-15);
        assert!(residual[3].abs() + residual[4].abs() < 1e-15);
    }

    #[test]
    fn walking_back_undoes_the_walk() {
        let mechanism = ring(&planar(&CRANK_ROCKER), [0.25, 0.0, 0.5], Written::Exactly);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let forth = [(0, true), (1, true), (2, true), (3, true)];
        let back = [(3, false), (2, false), (1, false), (0, false)];
        let [there, home] =
            [&forth, &back].map(|cycle| WalkedCycle::walk(&geometry, &geometry.states, cycle));
        let nothing = there.closure.compose(&home.closure);
        assert!(space::length(&nothing.translation) < 1e-14);
        assert!(space::length(&nothing.rotation_vector()) < 1e-14);
        let joint = &home.joints[0];
        let column = home.column(joint, &joint.screws[0]);
        assert_eq!(
            column[2], -1.0,
            "passed backward, the screw counts negative"
        );
    }

    #[test]
    fn the_square_has_the_distance_of_its_corners() {
        let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        let screws: Vec<_> = corners
            .iter()
            .map(|[x, y]| screw([0.0, 0.0, 1.0], [10.0 + x, *y, 3.0]))
            .collect();
        let (centre, length) = scale_of(&screws, 11.0);
        assert!((length - 2f64.sqrt()).abs() < 1e-5);
        assert!((centre[0] - 10.0).abs() + centre[1].abs() < 1e-5);
        assert_eq!(
            centre[2], 3.0,
            "along parallel axes the centre stays with their points"
        );
    }

    #[test]
    fn what_gives_no_length_falls_back() {
        let slide = PlacedScrew {
            angular: [0.0; 3],
            point: [0.0; 3],
            linear: [1.0, 0.0, 0.0],
        };
        assert_eq!(scale_of(std::slice::from_ref(&slide), 2.5).1, 2.5);
        assert_eq!(scale_of(&[slide], 0.0).1, 1.0, "no length at all");
        assert_eq!(scale_of(&[], 0.0).1, 1.0);
        // All axes through one point, drawn away from it.
        let screws = [
            screw([0.0, 0.0, 1.0], [0.0, 0.0, 2.0]),
            screw([1.0, 0.0, 0.0], [-2.0, 0.0, 0.0]),
            screw([0.6, 0.8, 0.0], [0.6, 0.8, 0.0]),
        ];
        let (centre, length) = scale_of(&screws, 2.0);
        assert!(space::length(&centre) < 1e-5);
        assert!(
            (length - 2.0).abs() < 1e-5,
            "the size of the set of points: {length}"
        );
        // One axis and a pitch: the pitch is the length.
        let mut helix = screw([0.0, 0.0, 1.0], [0.0; 3]);
        helix.linear = [0.0, 0.0, 0.125];
        assert_eq!(scale_of(&[helix.clone(), helix], 3.0).1, 0.125);
    }

    #[test]
    fn rounded_axes_of_a_sphere_have_no_length_of_their_own() {
        // Axes that miss each other by what six decimals leave open.
        let off = [
            [3e-7, 0.0, 0.0],
            [0.0, -4e-7, 1e-7],
            [2e-7, 2e-7, 0.0],
            [0.0; 3],
        ];
        let axes = [
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [0.0, 1.0, 1.0],
            [1.0, 1.0, 0.0],
        ];
        let screws: Vec<_> = axes.iter().zip(off).map(|(u, p)| screw(*u, p)).collect();
        let stated = Uncertainty {
            lengths: 24f64.sqrt() * 0.5e-6,
            angles: 0.0,
        };
        let (_, length) = characteristic_length(screws.iter(), 0.3, || 0.0, &stated);
        assert_eq!(length, 0.3);
        let (_, length) =
            characteristic_length(screws.iter(), 0.3, || 0.0, &Uncertainty::default());
        assert!(length < 1e-6, "taken literally they do");
    }

    #[test]
    fn lengths_of_any_size_scale() {
        let at = |unit: f64| {
            let places: Vec<Place> = sarrus_places()
                .into_iter()
                .map(|(kind, at, along)| (kind, at.map(|x| x * unit), along))
                .collect();
            walked(&places, [0.0; 3]).length / unit
        };
        for unit in [1e-9, 1e-6, 1e6, 1e99] {
            assert!((at(unit) / at(1.0) - 1.0).abs() < 1e-12, "{unit:e}");
        }
    }

    #[test]
    fn spherical_loops_close_wherever_their_joints_are_drawn() {
        for distances in [[0.0; 4], [1.0, 0.5, -0.25, 2.0]] {
            let walk = walked(&spherical([0.125, 0.25, -0.5], distances), [0.0; 3]);
            assert!(walk.residual().iter().all(|r| r.abs() < 1e-15));
            assert!(walk.length > 0.1 && walk.length < 3.0, "{}", walk.length);
        }
    }

    #[test]
    fn the_extent_is_that_of_the_joints_not_of_the_world() {
        let near = walked(&planar(&CRANK_ROCKER), [0.0; 3]);
        let moved: Vec<Place> = planar(&CRANK_ROCKER)
            .into_iter()
            .map(|(kind, [x, y, z], along)| (kind, [x + 1024.0, y, z], along))
            .collect();
        let far = walked(&moved, [0.0; 3]);
        assert!((near.extent - far.extent).abs() < 1e-9);
        assert!(far.reach > 1e3 && near.reach < 10.0);
        assert!(matches!(planar(&CRANK_ROCKER)[0].0, JointKind::Revolute));
    }

    proptest! {
        #[test]
        fn the_length_knows_no_origin_no_unit_and_no_point_of_an_axis(
            axes in prop::collection::vec(
                (prop::array::uniform3(-1.0..1.0f64), prop::array::uniform3(-1.0..1.0f64)), 3..7),
            shift in prop::array::uniform3(-50.0..50.0f64),
            slides in prop::collection::vec(-2.0..2.0f64, 7),
            power in -6..6i32,
        ) {
            prop_assume!(axes.iter().all(|(u, _)| space::length(u) > 0.2));
            let plain: Vec<_> = axes.iter().map(|(u, p)| screw(*u, *p)).collect();
            let unit = 10f64.powi(power);
            let changed: Vec<_> = plain
                .iter()
                .zip(&slides)
                .map(|(s, slide)| {
                    let p = [0, 1, 2].map(|i| unit * (s.point[i] + shift[i] + slide * s.angular[i]));
                    screw(s.angular, p)
                })
                .collect();
            let (centre, length) = scale_of(&plain, 2.0);
            prop_assume!(length > 0.1);
            let (other_centre, other) = scale_of(&changed, 60.0 * unit);
            // Damping lets the points be felt by a millionth of their distances, and more where axes are nearly parallel.
            prop_assert!((other / (unit * length) - 1.0).abs() < 1e-3, "{length} {other}");
            let moved = [0, 1, 2].map(|i| other_centre[i] / unit - shift[i] - centre[i]);
            prop_assert!(space::length(&moved) < 0.02);
        }
    }
}
