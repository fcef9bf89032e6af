//! Poses of a part: taken from the states of joints, moved, compared.

use super::rotations::{
    inverse_right_jacobian, nearest_turn, norm, orthonormalise, swing_to, swing_way,
};
use super::{Elementary, LoopSystem, SystemPose};
use kutzbach_closure::{JointState, Rigid};
use kutzbach_model::mechanism::JointKind;

impl LoopSystem {
    /// Takes over the states of the part's joints from those of the mechanism.
    #[must_use]
    pub fn pose(&self, states: &[JointState<f64>]) -> SystemPose {
        let mut pose = SystemPose {
            values: vec![0.0; self.unknowns()],
            frames: vec![Rigid::identity(&1.0); self.factors.len()],
        };
        for joint in &self.joints {
            let state = &states[joint.joint];
            for (value, known) in pose.values[joint.first..].iter_mut().zip(&state.values) {
                *value = *known;
            }
            let (first, count) = joint.factors;
            for (index, frame) in (first..first + count).zip(state.factors()) {
                pose.frames[index] = frame.clone();
                self.settle(&mut pose, index, true);
            }
            if joint.kind == JointKind::Distance {
                self.straighten(&mut pose, first);
            }
        }
        pose
    }

    /// The place of a joint of the mechanism among those of the part.
    pub(crate) fn place_of(&self, joint: usize) -> Option<usize> {
        self.joints.iter().position(|own| own.joint == joint)
    }

    /// The displacement of a joint, by its place in the part.
    pub(crate) fn displacement_at(&self, place: usize, pose: &SystemPose) -> Rigid<f64> {
        let (first, count) = self.joints[place].factors;
        self.displacements[place].displacement_of(&pose.frames[first..first + count])
    }

    /// Puts the part's joints into the states of the mechanism.
    pub fn put(&self, pose: &SystemPose, states: &mut [JointState<f64>]) {
        for joint in &self.joints {
            let (first, count) = joint.factors;
            states[joint.joint] = JointState::from_factors(
                pose.frames[first..first + count].to_vec(),
                pose.values[joint.first..joint.first + joint.kind.freedom()].to_vec(),
            );
        }
    }

    /// Makes a factor's frame agree with its values, or the values of a ball with its frame.
    fn settle(&self, pose: &mut SystemPose, index: usize, anew: bool) {
        let factor = &self.factors[index];
        match &factor.elementary {
            Elementary::Turn { axis, pitch } => {
                let angle = pose.values[factor.first];
                let (sine, cosine) = angle.sin_cos();
                let frame = &mut pose.frames[index];
                frame.rotation = Rigid::rotation(axis, &cosine, &sine).rotation;
                frame.translation = axis.map(|a| a * pitch * angle);
            }
            Elementary::Slide { direction } => {
                let way = pose.values[factor.first];
                pose.frames[index].translation = direction.map(|d| d * way);
            }
            Elementary::Ball => {
                let frame = &mut pose.frames[index];
                orthonormalise(&mut frame.rotation);
                let turn = frame.rotation_vector();
                let own = factor.first..factor.first + factor.generators.len();
                let before: Vec<f64> = pose.values[own.clone()].to_vec();
                let turn = if anew {
                    turn
                } else {
                    nearest_turn(&turn, &factor.generators, &before)
                };
                for (value, (angular, _)) in pose.values[own].iter_mut().zip(&factor.generators) {
                    *value = angular.iter().zip(&turn).map(|(a, t)| a * t).sum();
                }
            }
        }
    }

    /// Moves every joint: `z` in the metric, each factor by the exponential of its part of `z`.
    pub fn advance(&self, pose: &mut SystemPose, z: &[f64]) {
        for (index, factor) in self.factors.iter().enumerate() {
            let first = factor.first;
            match factor.elementary {
                Elementary::Turn { .. } | Elementary::Slide { .. } => {
                    pose.values[first] += z[first] / self.weights[first];
                }
                Elementary::Ball => {
                    let mut turn = [0.0; 3];
                    for (offset, (angular, _)) in factor.generators.iter().enumerate() {
                        for (t, a) in turn.iter_mut().zip(angular) {
                            *t += a * z[first + offset];
                        }
                    }
                    let frame = &mut pose.frames[index];
                    let step = Rigid::exponential(&turn, &[0.0; 3]);
                    frame.rotation = frame.compose(&step).rotation;
                }
            }
            self.settle(pose, index, false);
        }
        for joint in self.joints.iter().filter(|j| j.kind == JointKind::Distance) {
            self.straighten(pose, joint.factors.0);
        }
    }

    /// The two swings of a distance joint are the shortest rotation to the direction they reach; what spin they picked up
    /// about the rod on the way is handed on to the ball at its end, which leaves the displacement as it is.
    fn straighten(&self, pose: &mut SystemPose, swing: usize) {
        let frame = pose.frames[swing].clone();
        let to = [0, 1, 2].map(|i| frame.rotation[i][0]);
        if to[0] < -0.999_999 {
            return;
        }
        let short = swing_to(&to);
        let spin = short.inverse().compose(&frame);
        pose.frames[swing].rotation = short.rotation;
        pose.frames[swing + 1].rotation = spin.compose(&pose.frames[swing + 1]).rotation;
        self.settle(pose, swing, false);
        self.settle(pose, swing + 1, false);
    }

    /// By which [`Self::advance`] leads from one pose to another (written to `z`); turns of a ball the short way, turns of
    /// hinges as counted.
    pub fn way(&self, from: &SystemPose, to: &SystemPose, z: &mut [f64]) {
        let mut spin: Option<Rigid<f64>> = None;
        for (index, factor) in self.factors.iter().enumerate() {
            let first = factor.first;
            if let Elementary::Ball = factor.elementary {
                let turn = from.frames[index]
                    .inverse()
                    .compose(&to.frames[index])
                    .rotation_vector();
                for (offset, (angular, _)) in factor.generators.iter().enumerate() {
                    z[first + offset] = angular.iter().zip(&turn).map(|(a, t)| a * t).sum();
                }
                if factor.generators.len() == 2 {
                    spin = Some(swing_way(
                        &from.frames[index],
                        &to.frames[index],
                        &mut z[first..],
                    ));
                } else if let Some(spin) = spin.take() {
                    let turn = spin
                        .compose(&from.frames[index])
                        .inverse()
                        .compose(&to.frames[index])
                        .rotation_vector();
                    z[first..first + 3].copy_from_slice(&turn);
                }
            } else {
                z[first] = (to.values[first] - from.values[first]) * self.weights[first];
            }
        }
    }

    /// The velocity with which the chart of a pose sees a motion at `z`, given in the chart of that place: the same numbers
    /// for hinges and slides, `J_r⁻¹(z)` times them for balls.
    #[must_use]
    pub fn chart_velocity(&self, z: &[f64], velocity: &[f64]) -> Vec<f64> {
        let mut seen = velocity.to_vec();
        for factor in self.factors.iter().filter(|f| f.generators.len() == 3) {
            let own = factor.first..factor.first + 3;
            let (mut turn, mut step) = ([0.0; 3], [0.0; 3]);
            for (i, (angular, _)) in own.clone().zip(&factor.generators) {
                for k in 0..3 {
                    turn[k] += angular[k] * z[i];
                    step[k] += angular[k] * velocity[i];
                }
            }
            let image = inverse_right_jacobian(&turn, &step);
            for (slot, (angular, _)) in seen[own].iter_mut().zip(&factor.generators) {
                *slot = angular.iter().zip(&image).map(|(a, x)| a * x).sum();
            }
        }
        seen
    }

    /// The pose `from` counted anew so that every hinge is within half a turn of `to`: the same pose of all links.
    #[must_use]
    pub fn wound_towards(&self, from: &SystemPose, to: &SystemPose) -> SystemPose {
        let mut wound = from.clone();
        for unknown in 0..self.unknowns() {
            if self.is_periodic(unknown) {
                let turns =
                    ((to.values[unknown] - from.values[unknown]) / std::f64::consts::TAU).round();
                wound.values[unknown] += turns * std::f64::consts::TAU;
            }
        }
        for (index, factor) in self.factors.iter().enumerate() {
            if matches!(factor.elementary, Elementary::Ball) {
                let own = factor.first..factor.first + factor.generators.len();
                wound.values[own.clone()].copy_from_slice(&to.values[own]);
                self.settle(&mut wound, index, false);
            }
        }
        wound
    }

    /// How far two poses are apart, in the metric, by where the joints stand and not by how the turns are counted: the
    /// largest turn or slide between the displacements of a joint.
    #[must_use]
    pub fn separation(&self, a: &SystemPose, b: &SystemPose) -> f64 {
        let mut largest = 0.0f64;
        for place in 0..self.joints.len() {
            let of = |pose: &SystemPose| self.displacement_at(place, pose);
            let off = of(a).inverse().compose(&of(b));
            let turn = norm(&off.rotation_vector());
            largest = largest.max(turn).max(norm(&off.translation) / self.length);
        }
        largest
    }
}
