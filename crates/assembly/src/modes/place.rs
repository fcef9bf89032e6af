//! Poses of links.

use crate::placed::{Placed, PlacedLink};
use kutzbach_closure::{Arithmetic, Geometry, JointState, least_length};
use kutzbach_math::number::Number;
use kutzbach_math::space::{Rigid, cross, dot, length, scale, subtract, unit};
use kutzbach_mobility::{AnalysisOptions, Depth, analyse};
use kutzbach_model::mechanism::{JointId, Mechanism};

/// `world_from_link`, in doubles (m).
pub type Pose = Rigid<f64>;

/// How far apart two poses are: angle, and distance in parts of a size.
pub(super) fn apart(one: &Pose, other: &Pose, size: f64) -> f64 {
    let between = one.inverse().compose(other);
    let turn = between
        .rotation_vector()
        .iter()
        .map(|x| x * x)
        .sum::<f64>()
        .sqrt();
    let way = between
        .translation
        .iter()
        .map(|x| x * x)
        .sum::<f64>()
        .sqrt();
    turn.max(way / size)
}

/// Where a mechanism is drawn, closed.
pub(super) struct Drawn {
    /// `world_from_link`, by link.
    pub(super) poses: Vec<Pose>,
    /// Its size (m): the largest coordinate of a joint in its link, or of a link.
    pub(super) size: f64,
}

/// What the usual assembly says of the pose drawn.
#[derive(Default)]
pub(super) struct Start {
    /// The poses of the links where the mechanism is drawn, closed; `None` where it does not close from there.
    pub(super) drawn: Option<Drawn>,
    /// Whether it is shown to close nowhere, whatever the digits that rounding left out.
    pub(super) never_closes: bool,
}

/// Closes a mechanism from where it is drawn.
pub(super) fn start(mechanism: &Mechanism) -> Start {
    let options = AnalysisOptions {
        depth: Depth::Rank,
        ..AnalysisOptions::default()
    };
    let Ok(analysis) = analyse(mechanism, &options) else {
        return Start::default();
    };
    Start {
        never_closes: analysis.assembly.proven_open.is_some(),
        drawn: analysis
            .assembly
            .closed
            .then(|| drawn_poses(mechanism, &analysis.assembly.states)),
    }
}

fn drawn_poses(mechanism: &Mechanism, states: &[JointState<f64>]) -> Drawn {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let poses = kutzbach_closure::spanning_poses(mechanism, &geometry, states).0;
    let moving = mechanism.joints().iter().enumerate().filter(|(joint, of)| {
        of.freedom() > 0 || mechanism.sub_mechanism(JointId(*joint)).is_some()
    });
    let size = moving
        .flat_map(|(joint, of)| {
            let links = [of.predecessor.link, of.successor.link].map(|link| &poses[link.0]);
            let [one, other] = [links[0].translation, links[1].translation];
            [one, other]
                .concat()
                .into_iter()
                .chain([geometry.size_of([joint])])
        })
        .fold(1e-12, |m: f64, x| m.max(x.abs()));
    Drawn { poses, size }
}

/// The place of a body by three of its points: `a_from_b` of a frame on them.
fn frame_of([p, q, r]: [[f64; 3]; 3]) -> Pose {
    let x = unit(&subtract(&q, &p));
    let way = subtract(&r, &p);
    let y = unit(&subtract(&way, &scale(&x, &dot(&way, &x))));
    let z = cross(&x, &y);
    Rigid {
        rotation: [0, 1, 2].map(|i| [x[i], y[i], z[i]]),
        translation: p,
    }
}

/// Poses of all links by the places of all points: the ground stays where it is. `None` for links of no body.
pub(super) fn link_poses(
    mechanism: &Mechanism,
    placed: &Placed,
    points: &[Option<[f64; 3]>],
) -> Vec<Option<Pose>> {
    let mut poses = vec![None; mechanism.links().len()];
    for body in &placed.bodies {
        let here: Vec<([f64; 3], [f64; 3])> = body
            .points
            .iter()
            .filter_map(|(p, at)| Some(([0, 1, 2].map(|i| at[i].value()), points[*p]?)))
            .collect();
        let Some([a, b, c]) = spread(&here) else {
            continue;
        };
        let local = frame_of([here[a].0, here[b].0, here[c].0]);
        let there = frame_of([here[a].1, here[b].1, here[c].1]);
        let body_pose = there.compose(&local.inverse());
        for link in &body.links {
            poses[link.link.0] = Some(body_pose.compose(&link.pose.to_doubles()));
        }
    }
    onto_ground(mechanism, &mut poses);
    poses
}

/// Whether the points of every body span a triangle: of rounded numbers points that are meant to be one may be many, a digit apart.
pub(super) fn are_spread(placed: &Placed) -> bool {
    let places = placed.bodies.iter().map(|body| -> Vec<[f64; 3]> {
        let at = body.points.iter().map(|(_, at)| at);
        at.map(|at| [0, 1, 2].map(|i| at[i].value())).collect()
    });
    let places: Vec<Vec<[f64; 3]>> = places.collect();
    let far = |m: f64, x: &f64| m.max(x.abs());
    let size = places.iter().flatten().flatten().fold(0.0, far);
    let least = least_length(size);
    places.iter().all(|points| {
        let pairs: Vec<_> = points.iter().map(|at| (*at, *at)).collect();
        let area = spread(&pairs).map(|[a, b, c]| {
            let [u, v] = [b, c].map(|i| subtract(&points[i], &points[a]));
            length(&cross(&u, &v)) / length(&u).max(length(&v))
        });
        area.is_some_and(|height| height > least)
    })
}

/// Poses of all links, which are one body.
pub(super) fn poses_of_one_body(mechanism: &Mechanism, links: &[PlacedLink]) -> Vec<Option<Pose>> {
    let mut poses = vec![None; mechanism.links().len()];
    for link in links {
        poses[link.link.0] = Some(link.pose.to_doubles());
    }
    onto_ground(mechanism, &mut poses);
    poses
}

/// Moves everything so that the ground is where it is at home.
pub(super) fn onto_ground(mechanism: &Mechanism, poses: &mut [Option<Pose>]) {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let ground = mechanism.ground().0;
    if let Some(found) = poses[ground].clone() {
        let to_world = geometry.home[ground].compose(&found.inverse());
        for pose in poses.iter_mut().flatten() {
            *pose = to_world.compose(pose);
        }
    }
}

/// Three points that span the largest triangle with the first one.
fn spread(points: &[([f64; 3], [f64; 3])]) -> Option<[usize; 3]> {
    let mut best = (0.0, None);
    for b in 1..points.len() {
        for c in b + 1..points.len() {
            let [u, v] = [b, c].map(|i| subtract(&points[i].0, &points[0].0));
            let area = cross(&u, &v).iter().map(|x| x * x).sum::<f64>();
            if area > best.0 {
                best = (area, Some([0, b, c]));
            }
        }
    }
    best.1
}

/// Values of all joints with freedoms, from the poses of their links; those held have the values at which they are.
pub(super) fn joint_values(
    mechanism: &Mechanism,
    fixed: &Mechanism,
    held: &[(JointId, Number)],
    poses: &[Option<Pose>],
) -> Vec<(JointId, Option<Vec<f64>>)> {
    let geometry = Geometry::new(fixed, None, &Arithmetic::double());
    let mut values = Vec::new();
    for (index, joint) in mechanism.joints().iter().enumerate() {
        if joint.freedom() == 0 {
            continue;
        }
        if let Some((id, value)) = held.iter().find(|(id, _)| id.0 == index) {
            values.push((*id, Some(vec![value.value()])));
            continue;
        }
        let [a, b] = [joint.predecessor.link.0, joint.successor.link.0];
        let found = match (&poses[a], &poses[b]) {
            (Some(a), Some(b)) => {
                let [near, far] = &geometry.sides[index];
                let between = a.compose(near).inverse().compose(&b.compose(far));
                let displacement = &geometry.displacements[index];
                let state = displacement.fit(&between);
                Some(displacement.increments(&displacement.home(), &state))
            }
            _ => None,
        };
        values.push((JointId(index), found));
    }
    values
}
