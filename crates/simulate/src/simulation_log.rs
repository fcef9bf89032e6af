//! A simulation as it is logged: an [`Observer`] that writes down what it sees.
//!
//! Passages follow one another on one time line, each with a sentence on `/log` where it begins. The recorder's first error
//! ends the simulation; it is kept for whoever asks.

use crate::verification::{Moment, Observer, Passage};
use kutzbach_closure::{Geometry, Rigid};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_scene::{
    Closure, ClosureError, Estimate, Gap, JointClosure, Level, Motion, Prediction, RecordError,
    Recorder, Roles, values_of,
};
use std::io::Write;
use std::ops::ControlFlow;

/// Seconds of the time line between two passages.
const PAUSE: f64 = 0.5;

/// Joints that are open by less than this share of the largest gap are not listed.
const WORTH_TELLING: f64 = 0.01;

/// Logs a simulation while it runs.
pub struct SimulationLog<'r, 'a, W: Write> {
    recorder: Recorder<'a, W>,
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    roles_of: &'r dyn Fn(&Passage) -> Roles,
    passage: Option<Passage>,
    /// Time at which the passage begins.
    begins: f64,
    /// Latest time logged.
    until: f64,
    error: Option<RecordError>,
}

impl<'r, 'a, W: Write> SimulationLog<'r, 'a, W> {
    /// A log that goes on at a time (s). `roles_of` says what links and joints do in a passage.
    pub fn new(
        recorder: Recorder<'a, W>,
        mechanism: &'a Mechanism,
        geometry: &'a Geometry<f64>,
        begins: f64,
        roles_of: &'r dyn Fn(&Passage) -> Roles,
    ) -> Self {
        Self {
            recorder,
            mechanism,
            geometry,
            roles_of,
            passage: None,
            begins,
            until: begins,
            error: None,
        }
    }

    /// The recorder and the latest time logged (s), or what stopped the log.
    ///
    /// # Errors
    /// The recorder's first error.
    pub fn finish(self) -> Result<(Recorder<'a, W>, f64), RecordError> {
        match self.error {
            None => Ok((self.recorder, self.until)),
            Some(error) => Err(error),
        }
    }

    fn keep(&mut self, result: Result<(), RecordError>) -> ControlFlow<()> {
        match result {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.error.get_or_insert(error);
                ControlFlow::Break(())
            }
        }
    }

    fn write(&mut self, moment: &Moment<'_>) -> Result<(), RecordError> {
        let time = self.begins + moment.time;
        let values = values_of(moment.states);
        let gaps = self.gaps(moment.simulated);
        let simulated = Motion {
            joints: &values,
            gaps: &gaps,
            ..Motion::of_links(moment.simulated)
        };
        let predicted_values = moment.predicted.map(|(_, states)| values_of(states));
        let predicted =
            moment
                .predicted
                .zip(predicted_values.as_ref())
                .map(|((links, _), values)| Motion {
                    joints: values,
                    ..Motion::of_links(links)
                });
        self.recorder
            .moment(time, predicted.as_ref(), Some(&simulated))?;
        self.until = self.until.max(time);
        let largest =
            |of: fn(&crate::JointGap) -> f64| moment.gaps.iter().map(of).fold(0.0, f64::max);
        let (position, angle) = (largest(|g| g.position), largest(|g| g.angle));
        let joints = self
            .mechanism
            .joints()
            .iter()
            .zip(moment.gaps)
            .filter(|(_, gap)| {
                gap.position > WORTH_TELLING * position || gap.angle > WORTH_TELLING * angle
            })
            .map(|(joint, gap)| JointClosure {
                joint: joint.name.clone(),
                position: gap.position,
                angle: gap.angle,
            })
            .collect();
        self.recorder.closure(
            time,
            &Closure {
                predicted: None,
                simulated: Some(ClosureError {
                    position,
                    angle,
                    relative: moment.closure_error,
                    joints,
                }),
            },
        )?;
        let Some((passage, (_, states))) = self.passage.as_ref().zip(moment.predicted) else {
            return Ok(());
        };
        let Some(driven) = &passage.driven else {
            return Ok(());
        };
        let prediction = Prediction {
            branch: passage.branch.clone(),
            parameter: moment.done,
            drive: driven.name.clone(),
            predicted: states[driven.joint].values[driven.freedom],
            simulated: Some(values[driven.joint][driven.freedom]),
            distance: Some(moment.distance),
            margin: None,
            event: String::new(),
        };
        self.recorder.prediction(time, &prediction)
    }

    /// Where the two sides of each joint are that should be one place, its freedoms taken out.
    fn gaps(&self, links: &[Rigid<f64>]) -> Vec<Gap> {
        let joints = self.mechanism.joints().iter().enumerate();
        joints
            .filter(|(_, joint)| joint.closes_loop)
            .map(|(index, joint)| {
                let [predecessor, successor] = [&joint.predecessor, &joint.successor];
                let [a, b] = &self.geometry.sides[index];
                let a = links[predecessor.link.0].compose(a);
                let b = links[successor.link.0].compose(b);
                let displacement = &self.geometry.displacements[index];
                let fitted = displacement.fit(&a.inverse().compose(&b));
                Gap {
                    joint: index,
                    predecessor: a.compose(&displacement.displacement(&fitted)).translation,
                    successor: b.translation,
                }
            })
            .collect()
    }
}

impl<W: Write> Observer for SimulationLog<'_, '_, W> {
    fn begin(&mut self, passage: &Passage) -> ControlFlow<()> {
        if self.passage.is_some() {
            self.begins = self.until + PAUSE;
        }
        let roles = (self.roles_of)(passage);
        let told = self
            .recorder
            .set_roles(self.begins, &roles)
            .and_then(|()| self.recorder.log(self.begins, Level::Info, &passage.title));
        self.passage = Some(passage.clone());
        self.keep(told)
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        let written = self.write(moment);
        self.keep(written)
    }

    fn estimated(&mut self, over_time: &[(f64, f64)]) -> ControlFlow<()> {
        let written = over_time.iter().try_for_each(|(time, error)| {
            let estimate = Estimate { error: *error };
            self.recorder.estimate(self.begins + time, &estimate)
        });
        self.keep(written)
    }
}
