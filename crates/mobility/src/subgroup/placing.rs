//! The screws of a part's joints in one frame.

use crate::PartRank;
use kutzbach_closure::{
    Geometry, JointState, Part, PlacedScrew, Rigid, Uncertainty, characteristic_length,
};
use kutzbach_math::group::{Gauge, GroupError, Twist};
use kutzbach_math::matrix::Real;
use kutzbach_model::mechanism::Mechanism;
use nalgebra::Vector3;
use std::collections::{BTreeMap, VecDeque};

/// The joints of a part at a pose.
pub struct Placed {
    /// Centre, length and accuracy by which the part's screws are compared.
    pub gauge: Gauge,
    /// The screws of every joint of the part, in its order, one per variable.
    pub screws: Vec<Vec<Twist>>,
}

/// Places a part's joints in the frame of the world where the ground is one of its links, otherwise as seen from its
/// first joint's predecessor, which is put where the file draws it. Links are reached by the fewest joints; how else they
/// could be reached differs by what the loops leave open, which the accuracy covers.
///
/// `accuracy` is that of the part's cycles, each in units of its own length. In the part's length, errors are larger by as
/// much as the largest cycle's length exceeds it; along a way of more joints than the longest cycle has, they add up.
///
/// # Errors
/// [`GroupError::BadGauge`] where the part's size is out of range.
pub fn place(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    part: &Part,
    rank: &PartRank,
    accuracy: f64,
) -> Result<Placed, GroupError> {
    let (poses, depth) = link_poses(mechanism, geometry, states, part);
    let placed: Vec<Vec<PlacedScrew<f64>>> = part
        .joints
        .iter()
        .map(|&joint| {
            let predecessor = mechanism.joints()[joint].predecessor.link.0;
            let frame = match poses.get(&predecessor) {
                Some(pose) => pose.compose(&geometry.sides[joint][0]),
                None => geometry.sides[joint][0].clone(),
            };
            let screws = geometry.displacements[joint].screws(&states[joint]);
            screws.iter().map(|screw| screw.moved(&frame)).collect()
        })
        .collect();
    let uncertainty = Uncertainty::total(part.joints.iter().map(|&j| &geometry.uncertainties[j]));
    let reach = placed
        .iter()
        .flatten()
        .flat_map(|screw| screw.point)
        .fold(0.0, |far: f64, x| far.max(x.abs()));
    let (centre, length) = characteristic_length(
        placed.iter().flatten(),
        reach,
        || {
            let arms = part.joints.iter().map(|&j| geometry.arms[j]);
            arms.fold(0.0, f64::max)
        },
        &uncertainty,
    );
    let screws = placed
        .iter()
        .map(|joint| {
            let twist = |screw: &PlacedScrew<f64>| {
                let (angular, linear) = screw.about(&[0.0; 3]);
                Twist::new(Vector3::from(angular), Vector3::from(linear))
            };
            joint.iter().map(twist).collect()
        })
        .collect();
    let walks = &rank.jacobian.walks;
    let longest = walks.iter().map(|w| w.joints.len()).max().unwrap_or(1);
    let largest = walks.iter().map(|w| w.length).fold(length, f64::max);
    let farther = (depth as f64 / longest.max(1) as f64).max(1.0) * (largest / length);
    Ok(Placed {
        gauge: Gauge::new(Vector3::from(centre), length, accuracy * farther)?,
        screws,
    })
}

/// Where a frame parallel to that of the first link of a part's only cycle, at the cycle's centre, is in the world. `None`
/// for a part of several cycles.
pub fn cycle_frame(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    part: &Part,
    rank: &PartRank,
) -> Option<Rigid<f64>> {
    let ([cycle], [walk]) = (&part.cycles[..], &rank.jacobian.walks[..]) else {
        return None;
    };
    let (joint, forward) = *cycle.first()?;
    let [predecessor, successor] = ends(mechanism, joint);
    let first = if forward { predecessor } else { successor };
    let (poses, _) = link_poses(mechanism, geometry, states, part);
    let centre = Rigid {
        translation: walk.centre,
        ..Rigid::identity(&1.0)
    };
    Some(poses.get(&first)?.compose(&centre))
}

/// Poses of the part's links, breadth first, and the number of joints to the farthest.
pub fn link_poses<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &[JointState<R>],
    part: &Part,
) -> (BTreeMap<usize, Rigid<R>>, usize) {
    let mut incident: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &joint in &part.joints {
        for side in ends(mechanism, joint) {
            incident.entry(side).or_default().push(joint);
        }
    }
    let ground = mechanism.ground().0;
    let first = part.joints.first().map(|&joint| ends(mechanism, joint)[0]);
    let roots = std::iter::once(ground)
        .filter(|link| incident.contains_key(link))
        .chain(first)
        .chain(incident.keys().copied());
    let mut depth = 0;
    let mut poses: BTreeMap<usize, Rigid<R>> = BTreeMap::new();
    for root in roots {
        if poses.contains_key(&root) {
            continue;
        }
        poses.insert(root, geometry.home[root].clone());
        let mut queue = VecDeque::from([(root, 0)]);
        while let Some((link, steps)) = queue.pop_front() {
            depth = depth.max(steps);
            let from = poses[&link].clone();
            for &joint in incident.get(&link).into_iter().flatten() {
                let [predecessor, successor] = &geometry.sides[joint];
                let across = predecessor
                    .compose(&geometry.displacements[joint].displacement(&states[joint]))
                    .compose(&successor.inverse());
                let [start, end] = ends(mechanism, joint);
                let (other, step) = if start == link {
                    (end, across)
                } else {
                    (start, across.inverse())
                };
                poses.entry(other).or_insert_with(|| {
                    queue.push_back((other, steps + 1));
                    from.compose(&step)
                });
            }
        }
    }
    (poses, depth)
}

/// The links of a joint: predecessor, successor.
pub fn ends(mechanism: &Mechanism, joint: usize) -> [usize; 2] {
    let joint = &mechanism.joints()[joint];
    [joint.predecessor.link.0, joint.successor.link.0]
}
