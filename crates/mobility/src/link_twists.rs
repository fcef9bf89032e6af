//! How every link moves along each tangent of a branch at one of its poses.

use super::branch::BranchPose;
use super::one_sided::OneSided;
use super::tangent_space::{Limits, TangentSpace};
use kutzbach_closure::Structure;
use kutzbach_closure::{Geometry, Rigid, least_length, spanning_poses};
use kutzbach_math::group::Twist;
use kutzbach_model::mechanism::{JointId, Mechanism};
use nalgebra::{Matrix3, Vector3};

/// The twists of all links.
///
/// They are taken about the centroid of the joints, not about the world's origin, so that a mechanism far from the origin
/// loses no digits. A link's twist is a sum over the joints on the way to it in the spanning tree, which are kept, and not the sums:
/// those of all links of a long chain along all tangents would be as many as the square of its length.
#[derive(Clone, Debug)]
pub(super) struct LinkTwists {
    /// The tangents the twists belong to.
    pub tangents: TangentSpace,
    /// Limits for singular values of twists, rotations in radians and translations in lengths of the mechanism.
    pub limits: Limits,
    /// The same where the numbers are taken as they are written.
    pub as_written: Limits,
    /// RMS distance of the joints from their centroid (m).
    pub length: f64,
    /// The centroid, in the world (m).
    centre: Vector3<f64>,
    /// `world_from_link` of every link.
    poses: Vec<Rigid<f64>>,
    /// The last joint on the way to every link but the first of a piece.
    steps: Vec<Option<Step>>,
    /// The links in an order in which those beyond a link follow it at once.
    order: Vec<usize>,
    /// Where every link stands in that order, and where those beyond it end.
    reach: Vec<(usize, usize)>,
    /// Number of joints on the way to every link.
    depths: Vec<usize>,
    /// Number of joints on the way to that of a variable, where it is one of the tree.
    top: Vec<Option<usize>>,
    /// The link that a link's connected piece is placed by.
    pieces: Vec<usize>,
}

/// A joint of the spanning tree, crossed.
#[derive(Clone, Debug)]
struct Step {
    /// The link it is crossed from.
    from: usize,
    joint: usize,
    /// 1 from predecessor to successor, else −1.
    sign: f64,
    /// Twists of the joint's variables, successor relative to predecessor.
    screws: Vec<Twist>,
}

/// Twists along tangents, by index of the tangent.
type Columns = Vec<(usize, Twist)>;

/// In place of an index: one of the few twists that stand for those along many tangents.
const MERGED: usize = usize::MAX;

/// Up to so many twists of a link are kept one by one.
const MOST_COLUMNS: usize = 64;

impl LinkTwists {
    /// `None` where numbers leave their range or the pose belongs to another mechanism.
    pub fn at(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        structure: &Structure,
        pose: &BranchPose,
    ) -> Option<Self> {
        if pose.states.len() != mechanism.joints().len() {
            return None;
        }
        let tangents = TangentSpace::at(mechanism, geometry, structure, pose)?;
        let (poses, in_tree) = spanning_poses(mechanism, geometry, &pose.states);
        let (centre, length, farthest) = extent(mechanism, geometry, &poses);
        if !length.is_finite() || !centre.iter().all(|x| x.is_finite()) {
            return None;
        }
        let count = match tangents.dimension() {
            0 => 1,
            _ => tangents.length(),
        };
        let limits = |error: f64| Limits::new(error * (1.0 + farthest / length), count);
        let mut found = Self {
            limits: limits(tangents.limits.error),
            as_written: limits(tangents.as_written),
            length,
            centre,
            steps: vec![None; poses.len()],
            order: Vec::with_capacity(poses.len()),
            reach: vec![(0, 0); poses.len()],
            depths: vec![0; poses.len()],
            top: vec![None; tangents.length()],
            pieces: vec![usize::MAX; poses.len()],
            poses,
            tangents,
        };
        found.walk(mechanism, geometry, pose, &in_tree);
        let mut screws = found.steps.iter().flatten().flat_map(|step| &step.screws);
        screws.all(Twist::is_finite).then_some(found)
    }

    /// How many singular values of what is made of unit tangents are not zero; `None` where one is doubtful.
    ///
    /// What the digits leave open is asked of the numbers as they are: where they close, their motion is one that they stand for.
    pub fn rank(&self, values: &[f64]) -> Option<usize> {
        let asked = [&self.limits, &self.as_written];
        asked.into_iter().find_map(|limits| limits.rank(values))
    }

    fn walk(
        &mut self,
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        pose: &BranchPose,
        in_tree: &[bool],
    ) {
        let joints = mechanism.joints();
        let mut incident = vec![Vec::new(); self.poses.len()];
        for (index, joint) in joints.iter().enumerate().filter(|(i, _)| in_tree[*i]) {
            incident[joint.predecessor.link.0].push(index);
            incident[joint.successor.link.0].push(index);
        }
        let starts = std::iter::once(mechanism.ground().0).chain(0..self.poses.len());
        for start in starts {
            if self.pieces[start] != usize::MAX {
                continue;
            }
            self.pieces[start] = start;
            let mut stack = vec![start];
            while let Some(link) = stack.pop() {
                self.reach[link].0 = self.order.len();
                self.order.push(link);
                for &index in &incident[link] {
                    let joint = &joints[index];
                    let forward = joint.predecessor.link.0 == link;
                    let other = if forward {
                        joint.successor.link.0
                    } else {
                        joint.predecessor.link.0
                    };
                    if self.pieces[other] != usize::MAX {
                        continue;
                    }
                    self.steps[other] = Some(Step {
                        from: link,
                        joint: index,
                        sign: if forward { 1.0 } else { -1.0 },
                        screws: self.screws(mechanism, geometry, pose, index),
                    });
                    for variable in self.tangents.variables(index) {
                        self.top[variable] = Some(self.depths[link]);
                    }
                    self.depths[other] = self.depths[link] + 1;
                    self.pieces[other] = start;
                    stack.push(other);
                }
            }
        }
        for &link in self.order.iter().rev() {
            let end = self.reach[link].1.max(self.reach[link].0 + 1);
            self.reach[link].1 = end;
            if let Some(step) = &self.steps[link] {
                let before = &mut self.reach[step.from].1;
                *before = end.max(*before);
            }
        }
    }

    /// Unit twists of a joint's variables about the centre: the successor's motion relative to the predecessor.
    fn screws(
        &self,
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        pose: &BranchPose,
        joint: usize,
    ) -> Vec<Twist> {
        let predecessor = mechanism.joints()[joint].predecessor.link.0;
        let frame = self.poses[predecessor].compose(&geometry.sides[joint][0]);
        geometry.displacements[joint]
            .screws(&pose.states[joint])
            .iter()
            .map(|screw| {
                let (angular, linear) = screw.moved(&frame).about(&self.centre.into());
                Twist::new(angular.into(), linear.into())
            })
            .collect()
    }

    /// Whether a chain of joints leads from one link to the other.
    pub fn connected(&self, a: usize, b: usize) -> bool {
        self.pieces[a] == self.pieces[b]
    }

    /// `world_from_link`: rotation and translation.
    pub fn link_pose(&self, link: usize) -> (Matrix3<f64>, Vector3<f64>) {
        parts(&self.poses[link])
    }

    /// The centre in the frame of a link (m).
    pub fn centre_in(&self, link: usize) -> Vector3<f64> {
        let (rotation, translation) = parts(&self.poses[link]);
        rotation.transpose() * (self.centre - translation)
    }

    /// Twists of a link relative to another along every tangent that moves either, in the other's directions, velocities taken at
    /// `point` of the other's frame.
    pub fn relative(&self, link: usize, to: usize, point: &Vector3<f64>) -> Vec<Twist> {
        let mut own = self.columns(link).into_iter().peekable();
        let mut other = self.columns(to).into_iter().peekable();
        let mut differences = Vec::new();
        loop {
            let next = [own.peek(), other.peek()].map(|next| next.map_or(MERGED, |next| next.0));
            let vector = next[0].min(next[1]);
            let taken = |found: Option<(usize, Twist)>| found.map_or(Twist::zero(), |next| next.1);
            let pair = [&mut own, &mut other].map(|of| taken(of.next_if(|next| next.0 == vector)));
            if vector == MERGED {
                break;
            }
            differences.push((vector, pair[0] - pair[1]));
        }
        self.seen_from(to, point, &differences)
    }

    /// What twists about the centre are in the directions of a link, with velocities at `point` of its frame.
    pub fn seen_from(&self, to: usize, point: &Vector3<f64>, columns: &Columns) -> Vec<Twist> {
        let (rotation, translation) = parts(&self.poses[to]);
        let shift = rotation * point + translation - self.centre;
        let back = rotation.transpose();
        columns
            .iter()
            .map(|(_, twist)| Twist::new(back * twist.angular, back * twist.velocity_at(&shift)))
            .collect()
    }

    /// The links on the way to a link that are deeper than `above`, the nearest to the ground first.
    fn way(&self, link: usize, above: usize) -> Vec<usize> {
        let mut way = Vec::new();
        let mut next = link;
        while let Some(step) = self.steps[next]
            .as_ref()
            .filter(|_| self.depths[next] > above)
        {
            way.push(next);
            next = step.from;
        }
        way.reverse();
        way
    }

    /// Adds what the last joint on the way to a link does along every tangent.
    fn step_on(&self, step: &Step, columns: &mut Columns) {
        let variables = self.tangents.variables(step.joint);
        for (screw, variable) in step.screws.iter().zip(variables) {
            for &vector in self.tangents.row(variable).vectors {
                let rate = self.tangents.rate(vector, variable);
                if rate == 0.0 {
                    continue;
                }
                let more = *screw * (step.sign * rate);
                match columns.binary_search_by_key(&vector, |column| column.0) {
                    Ok(at) => columns[at].1 += more,
                    Err(at) => columns.insert(at, (vector, more)),
                }
            }
        }
    }

    fn columns(&self, link: usize) -> Columns {
        let mut columns = Columns::new();
        for step in self
            .way(link, 0)
            .into_iter()
            .filter_map(|link| self.steps[link].as_ref())
        {
            self.step_on(step, &mut columns);
        }
        columns
    }

    /// Calls `found` for every link with its twists about the centre, seen from the link that its piece is placed by.
    ///
    /// Where they are many, those along tangents that move nothing beyond the link are replaced by six with the same singular values and
    /// left singular vectors, which is all that matters of them for the links beyond: in an orthonormal basis of the tangent space
    /// these then are twists along other unit tangents.
    pub fn each_link(&self, mut found: impl FnMut(usize, &Columns)) {
        // Where the links of the joints that each tangent moves stand in the order.
        let mut moved: Vec<Vec<usize>> = vec![Vec::new(); self.tangents.dimension()];
        for &link in &self.order {
            let Some(step) = &self.steps[link] else {
                continue;
            };
            for vector in self
                .tangents
                .vectors_of(self.tangents.variables(step.joint))
            {
                moved[vector].push(self.reach[link].0);
            }
        }
        let mut waiting: Vec<usize> = vec![0; self.order.len()];
        for step in self.steps.iter().flatten() {
            waiting[step.from] += 1;
        }
        let mut kept: Vec<Columns> = vec![Columns::new(); self.order.len()];
        for &link in &self.order {
            let mut columns = Columns::new();
            if let Some(step) = &self.steps[link] {
                waiting[step.from] -= 1;
                columns = match waiting[step.from] {
                    0 => std::mem::take(&mut kept[step.from]),
                    _ => kept[step.from].clone(),
                };
                self.step_on(step, &mut columns);
            }
            found(link, &columns);
            if waiting[link] == 0 {
                continue;
            }
            if columns.len() > MOST_COLUMNS {
                let (start, end) = self.reach[link];
                self.merge(&mut columns, |vector| {
                    let after = moved[vector].partition_point(|&at| at <= start);
                    moved[vector].get(after).is_none_or(|&at| at >= end)
                });
            }
            kept[link] = columns;
        }
    }

    /// Replaces the twists along tangents that are done with by six.
    fn merge(&self, columns: &mut Columns, done: impl Fn(usize) -> bool) {
        let (merged, mut others): (Columns, Columns) = columns
            .iter()
            .partition(|(vector, _)| *vector == MERGED || done(*vector));
        let mut rows = vec![Vec::new(); 6];
        for (_, twist) in &merged {
            let numbers = coordinates(twist, self.length);
            rows.iter_mut()
                .zip(numbers)
                .for_each(|(row, x)| row.push(x));
        }
        let Some(decomposed) = OneSided::of(rows).filter(|_| merged.len() > 6) else {
            return;
        };
        // The rows are C⁻¹ V with C orthogonal and V's rows orthogonal and as long as the values.
        for (value, combination) in decomposed.values.iter().zip(&decomposed.combinations) {
            let x = |i: usize| value * combination[i];
            let linear = Vector3::new(x(3), x(4), x(5)) * self.length;
            others.push((MERGED, Twist::new(Vector3::new(x(0), x(1), x(2)), linear)));
        }
        *columns = others;
    }

    /// Coordinates (rad, lengths of the mechanism) of a link's twist along a combination of some tangents.
    pub fn along(&self, link: usize, vectors: &[usize], weights: &[f64]) -> [f64; 6] {
        // Nothing nearer to the ground than what these tangents move takes the link along.
        let above = self.tangents.moved_with(vectors);
        let above = above
            .iter()
            .filter_map(|&variable| self.top[variable])
            .min();
        let way = self.way(link, above.unwrap_or(usize::MAX));
        let sum = vectors
            .iter()
            .zip(weights)
            .fold(Twist::zero(), |sum, (&vector, weight)| {
                let steps = way.iter().filter_map(|&link| self.steps[link].as_ref());
                let twist = steps.fold(Twist::zero(), |twist, step| {
                    let variables = self.tangents.variables(step.joint);
                    step.screws
                        .iter()
                        .zip(variables)
                        .fold(twist, |twist, (screw, variable)| {
                            twist + *screw * (step.sign * self.tangents.rate(vector, variable))
                        })
                });
                sum + twist * *weight
            });
        coordinates(&sum, self.length)
    }
}

/// A twist as six numbers of like size.
pub(super) fn coordinates(twist: &Twist, length: f64) -> [f64; 6] {
    let (w, v) = (twist.angular, twist.linear / length);
    [w.x, w.y, w.z, v.x, v.y, v.z]
}

/// Rotation and translation.
pub(super) fn parts(pose: &Rigid<f64>) -> (Matrix3<f64>, Vector3<f64>) {
    let rotation = Matrix3::from_fn(|i, j| pose.rotation[i][j]);
    (rotation, pose.translation.into())
}

/// Centroid of the joints, their RMS distance from it, and the largest one (m). Where all joints are in one place any
/// length will do.
fn extent(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    poses: &[Rigid<f64>],
) -> (Vector3<f64>, f64, f64) {
    // What neither moves by itself nor is part of a loop, as a mount, says nothing of how large the motions are.
    let points: Vec<Vector3<f64>> = mechanism
        .joints()
        .iter()
        .zip(&geometry.sides)
        .enumerate()
        .filter(|(index, (joint, _))| {
            joint.freedom() > 0 || mechanism.sub_mechanism(JointId(*index)).is_some()
        })
        .map(|(_, (joint, sides))| {
            let link = joint.predecessor.link.0;
            poses[link].apply(&sides[0].translation).into()
        })
        .collect();
    let count = points.len().max(1) as f64;
    let centre = points.iter().sum::<Vector3<f64>>() / count;
    let distances: Vec<f64> = points.iter().map(|point| (point - centre).norm()).collect();
    let spread = (distances.iter().map(|d| d * d).sum::<f64>() / count).sqrt();
    let farthest = distances.iter().fold(0.0, |m: f64, d| m.max(*d));
    let reach = points
        .iter()
        .fold(0.0, |far: f64, point| far.max(point.amax()));
    let arm = geometry.arms.iter().copied().fold(0.0, f64::max);
    let length = [spread, arm, reach]
        .into_iter()
        .find(|length| *length > least_length(reach))
        .unwrap_or(1.0);
    (centre, length, farthest)
}
