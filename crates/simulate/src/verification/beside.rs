//! The prediction beside a motion that nothing was predicted for: that of a scene.

use super::budget::{Size, looped_variables};
use super::driven_motion::loop_freedom;
use super::observer::{Moment, Observer, Passage};
use super::prediction::Prediction;
use kutzbach_closure::{Geometry, JointState, Rigid, spanning_poses};
use kutzbach_mobility::{Analysis, Branch, Verdict};
use kutzbach_model::mechanism::Mechanism;
use std::ops::ControlFlow;

/// Seconds of work that the pose next to a simulated one may take: a scene shows a hundred moments or more.
const LOOK: f64 = 0.02;

/// Hands a scene on to an observer, with the pose that is predicted next to each simulated one: of the branch, where there is one
/// alone through the start; the start, where nothing is to move. Where neither is so, or to find the pose is too much work, nothing
/// is predicted.
pub struct Beside<'o, 'a> {
    observer: &'o mut dyn Observer,
    predicted: Predicted<'a>,
}

enum Predicted<'a> {
    Nothing,
    Start(Vec<Rigid<f64>>, &'a [JointState<f64>]),
    Branch(Box<Prediction<'a>>),
}

impl<'o, 'a> Beside<'o, 'a> {
    /// The analysis is of the mechanism that the scene moves, and the scene starts where it was made.
    pub fn new(
        mechanism: &'a Mechanism,
        geometry: &'a Geometry<f64>,
        analysis: &'a Analysis,
        observer: &'o mut dyn Observer,
    ) -> Self {
        let start = analysis.assembly.states.as_slice();
        let branches = analysis.branches.as_deref().unwrap_or_default();
        let predicted = match (analysis.mobility.verdict, branches) {
            (Verdict::Rigid, _) => {
                Predicted::Start(spanning_poses(mechanism, geometry, start).0, start)
            }
            (Verdict::Mobile, [branch]) => next_to(mechanism, geometry, analysis, branch)
                .map_or(Predicted::Nothing, |found| {
                    Predicted::Branch(Box::new(found))
                }),
            _ => Predicted::Nothing,
        };
        Self {
            observer,
            predicted,
        }
    }
}

fn next_to<'a>(
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    analysis: &'a Analysis,
    branch: &Branch,
) -> Option<Prediction<'a>> {
    let structure = &analysis.structure;
    let size = Size::of(mechanism, looped_variables(mechanism, structure));
    if size.looks(1.0) > LOOK {
        return None;
    }
    let freedom = loop_freedom(mechanism, structure, branch);
    let start = &analysis.assembly.states;
    Prediction::new(mechanism, geometry, structure, start, freedom, 1.0).ok()
}

impl Observer for Beside<'_, '_> {
    fn begin(&mut self, passage: &Passage) -> ControlFlow<()> {
        self.observer.begin(passage)
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        if let Predicted::Branch(prediction) = &mut self.predicted
            && prediction.follow(moment.states).is_err()
        {
            self.predicted = Predicted::Nothing;
        }
        let predicted = match &self.predicted {
            Predicted::Nothing => None,
            Predicted::Start(links, states) => Some((links.as_slice(), *states)),
            Predicted::Branch(prediction) => Some((prediction.poses(), prediction.states())),
        };
        self.observer.moment(&Moment {
            predicted: moment.predicted.or(predicted),
            ..*moment
        })
    }

    fn estimated(&mut self, over_time: &[(f64, f64)]) -> ControlFlow<()> {
        self.observer.estimated(over_time)
    }
}
