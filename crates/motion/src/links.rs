//! Poses of all links of a mechanism along a curve: which joint leads to which link is found once.

use super::system::{LoopSystem, SystemPose};
use kutzbach_closure::{Geometry, JointState, Rigid, spanning_poses};
use kutzbach_model::mechanism::Mechanism;

/// What is needed to tell a pose of a part as one of the whole mechanism.
#[derive(Debug)]
pub(super) struct WholeFrame {
    pub mechanism: Mechanism,
    pub states: Vec<JointState<f64>>,
    /// Every link after the one it hangs on.
    steps: Vec<Step>,
    /// Poses of the links that no joint leads to.
    rest: Vec<Rigid<f64>>,
    /// Values of all joint variables where the part rests, and at which of them its unknowns stand.
    values: Vec<f64>,
    places: Vec<usize>,
}

/// From a link to the next, across a joint.
#[derive(Debug)]
struct Step {
    from: usize,
    to: usize,
    across: Across,
    forward: bool,
}

#[derive(Debug)]
enum Across {
    /// A joint that stands still (`predecessor_from_successor`).
    Fixed(Rigid<f64>),
    /// A joint of the part, by its place there; `predecessor_from_joint` and `joint_from_successor`.
    Moving(usize, Box<[Rigid<f64>; 2]>),
}

impl WholeFrame {
    /// Joints outside the part stand as `states` say.
    pub fn new(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        system: &LoopSystem,
        states: Vec<JointState<f64>>,
    ) -> Self {
        let (rest, in_tree) = spanning_poses(mechanism, geometry, &states);
        let mut frame = Self {
            mechanism: mechanism.clone(),
            steps: Vec::new(),
            rest,
            values: states.iter().flat_map(|s| s.values.clone()).collect(),
            places: Vec::new(),
            states,
        };
        let offsets = mechanism.variable_offsets();
        let places = system.variables().into_iter();
        frame.places = places.map(|(joint, own)| offsets[joint] + own).collect();
        frame.walk(geometry, system, &in_tree);
        frame
    }

    /// Goes through the tree from the ground, then from whatever is not reached.
    fn walk(&mut self, geometry: &Geometry<f64>, system: &LoopSystem, in_tree: &[bool]) {
        let joints = self.mechanism.joints();
        let mut incident = vec![Vec::new(); self.rest.len()];
        for (index, joint) in joints.iter().enumerate().filter(|(j, _)| in_tree[*j]) {
            incident[joint.predecessor.link.0].push(index);
            incident[joint.successor.link.0].push(index);
        }
        let mut done = vec![false; self.rest.len()];
        // Whether the motion reaches a link: the others stay as they are.
        let mut moves = done.clone();
        for start in std::iter::once(self.mechanism.ground().0).chain(0..done.len()) {
            let mut stack = vec![start];
            if std::mem::replace(&mut done[start], true) {
                stack.clear();
            }
            while let Some(from) = stack.pop() {
                for &index in &incident[from] {
                    let joint = &joints[index];
                    let forward = joint.predecessor.link.0 == from;
                    let to = match forward {
                        true => joint.successor.link.0,
                        false => joint.predecessor.link.0,
                    };
                    if std::mem::replace(&mut done[to], true) {
                        continue;
                    }
                    stack.push(to);
                    let place = system.place_of(index);
                    moves[to] = moves[from] || place.is_some();
                    if !moves[to] {
                        continue;
                    }
                    let [near, far] = &geometry.sides[index];
                    let far = far.inverse();
                    let across = match place {
                        Some(place) => Across::Moving(place, Box::new([near.clone(), far])),
                        None => Across::Fixed({
                            let moved = &geometry.displacements[index];
                            let moved = moved.displacement(&self.states[index]);
                            near.compose(&moved).compose(&far)
                        }),
                    };
                    self.steps.push(Step {
                        from,
                        to,
                        across,
                        forward,
                    });
                }
            }
        }
    }

    /// `world_from_link` of every link.
    pub fn link_poses(&self, system: &LoopSystem, pose: &SystemPose) -> Vec<Rigid<f64>> {
        let mut poses = self.rest.clone();
        for step in &self.steps {
            let next = match &step.across {
                Across::Fixed(across) if step.forward => poses[step.from].compose(across),
                Across::Fixed(across) => poses[step.from].compose(&across.inverse()),
                Across::Moving(joint, sides) => {
                    let moved = system.displacement_at(*joint, pose);
                    let across = sides[0].compose(&moved).compose(&sides[1]);
                    match step.forward {
                        true => poses[step.from].compose(&across),
                        false => poses[step.from].compose(&across.inverse()),
                    }
                }
            };
            poses[step.to] = next;
        }
        poses
    }

    /// All values of all joints, one after another.
    pub fn values(&self, pose: &SystemPose) -> Vec<f64> {
        let mut values = self.values.clone();
        for (place, value) in self.places.iter().zip(&pose.values) {
            values[*place] = *value;
        }
        values
    }
}
