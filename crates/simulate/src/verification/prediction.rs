//! The predicted motion next to a simulated one.
//!
//! A branch is a set of poses. The prediction for a simulated pose is the pose of the branch next to it: the simulated
//! joint variables, moved across the branch until the loops close, while nothing moves along it. What is left between the
//! two is the distance of the simulation from the prediction. Following the simulation in small steps keeps to the branch
//! that the simulation started on: where another branch passes, the tangents held are still those of the first.

use super::VerificationError;
use kutzbach_closure::{
    Geometry, JointState, Metric, Part, Rigid, Section, jacobian, spanning_poses,
};
use kutzbach_mobility::{Structure, tangents_at};
use kutzbach_model::mechanism::Mechanism;

/// Newton steps that a prediction may take.
const STEPS: usize = 20;

/// The pose of a branch next to a simulated pose.
pub struct Prediction<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    part: Part,
    metric: Metric,
    /// Directions along the branch at the last pose, orthonormal in the metric.
    along: Vec<Vec<f64>>,
    /// Instantaneous freedom of the parts with loops, at generic poses of the branch.
    freedom: usize,
    states: Vec<JointState<f64>>,
    poses: Vec<Rigid<f64>>,
    length: f64,
}

impl<'a> Prediction<'a> {
    /// Starts at a pose of the branch at which the loops have `freedom` instantaneous freedoms (joints outside loops do not
    /// count). `length` is the characteristic length (m).
    ///
    /// # Errors
    /// [`VerificationError::OutOfRange`] where the loops' equations leave the range of numbers.
    pub fn new(
        mechanism: &'a Mechanism,
        geometry: &'a Geometry<f64>,
        structure: &Structure,
        start: &[JointState<f64>],
        freedom: usize,
        length: f64,
    ) -> Result<Self, VerificationError> {
        let mut part = Part::default();
        for other in &structure.parts {
            part.joints.extend(&other.joints);
            part.cycles.extend(other.cycles.iter().cloned());
            part.couplings.extend(&other.couplings);
        }
        let metric = if part.joints.is_empty() {
            Metric {
                weights: Vec::new(),
            }
        } else {
            let here = jacobian(mechanism, geometry, start, &part)?;
            let scales = here.matrix.clone().scale_columns();
            Metric::of(mechanism, &here, &scales)
        };
        let mut prediction = Self {
            mechanism,
            geometry,
            part,
            metric,
            along: Vec::new(),
            freedom,
            states: start.to_vec(),
            poses: spanning_poses(mechanism, geometry, start).0,
            length,
        };
        prediction.take_tangents()?;
        Ok(prediction)
    }

    /// The predicted states, by joint.
    #[must_use]
    pub fn states(&self) -> &[JointState<f64>] {
        &self.states
    }

    /// The predicted `world_from_link`, by link.
    #[must_use]
    pub fn poses(&self) -> &[Rigid<f64>] {
        &self.poses
    }

    /// Moves the prediction next to a simulated pose. Joints outside loops are predicted to be where they are.
    ///
    /// # Errors
    /// [`VerificationError::OutOfRange`] where the loops' equations leave the range of numbers.
    pub fn follow(&mut self, simulated: &[JointState<f64>]) -> Result<(), VerificationError> {
        self.states.clone_from_slice(simulated);
        if !self.part.joints.is_empty() {
            let section = Section {
                mechanism: self.mechanism,
                geometry: self.geometry,
                part: &self.part,
                metric: &self.metric,
            };
            section.close(&mut self.states, &self.along, STEPS)?;
            self.take_tangents()?;
        }
        self.poses = spanning_poses(self.mechanism, self.geometry, &self.states).0;
        Ok(())
    }

    /// Largest distance of a link from where it is predicted: of its joints, in characteristic lengths, or its turn (rad).
    #[must_use]
    pub fn distance(&self, simulated: &[Rigid<f64>]) -> f64 {
        distance_between(
            self.mechanism,
            self.geometry,
            simulated,
            &self.poses,
            self.length,
        )
    }

    fn take_tangents(&mut self) -> Result<(), VerificationError> {
        if self.part.joints.is_empty() {
            return Ok(());
        }
        let section = Section {
            mechanism: self.mechanism,
            geometry: self.geometry,
            part: &self.part,
            metric: &self.metric,
        };
        // Near a pose where other branches pass the freedom is larger; there the old directions serve.
        if let Some((tangents, _)) = tangents_at(&section, &self.states, 0.0, self.freedom)?
            && (tangents.basis.len() == self.freedom || self.along.is_empty())
        {
            self.along = tangents.basis;
        }
        Ok(())
    }
}

/// Largest distance of a link between two poses of a mechanism (`world_from_link`, by link index): of its joints, in units of
/// `length` (m), or its turn (rad). What is not a number counts as far.
#[must_use]
pub fn distance_between(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    one: &[Rigid<f64>],
    other: &[Rigid<f64>],
    length: f64,
) -> f64 {
    let mut largest: f64 = 0.0;
    for (joint, sides) in mechanism.joints().iter().zip(&geometry.sides) {
        for (side, frame) in [&joint.predecessor, &joint.successor]
            .into_iter()
            .zip(sides)
        {
            let here = &one[side.link.0];
            let there = &other[side.link.0];
            let a = here.apply(&frame.translation);
            let b = there.apply(&frame.translation);
            let apart = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
            let turn = there.inverse().compose(here).rotation_vector();
            let angle = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
            let distance = (apart / length).max(angle);
            // A number that is none must not pass for a small one.
            if !(distance <= largest) {
                largest = distance;
            }
        }
    }
    largest
}
