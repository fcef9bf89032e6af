//! What is driven: one choice for all commands.
//!
//! The inputs are those that somebody names: the caller, or the file by its motors, by the drives of its scene, or by its marks of
//! independent coordinates. What these leave free is proposed as [`kutzbach_mobility::actuation`] orders it. Of a part that moves along
//! a curve it is also seen which joints go round, by following the curve once: a motor sits at a crank, not at the rocker.

use super::{Found, Tracer};
use crate::inputs::Variable;
use crate::result::{Motion, TraceOptions};
use crate::system::LoopSystem;
use kutzbach_mobility::{
    Actuation, Analysis, Branch, Freedom, PoseKind, actuation, pose_of_branch,
};
use kutzbach_model::mechanism::{JointId, Mechanism};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Larger parts are not followed to see what goes round.
const VARIABLES: usize = 40;

/// Poses computed for that, each way.
const POSES: usize = 2000;

/// Who names the inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputSource {
    /// The caller.
    Asked,
    /// The file, by the drives of its scene and then by its other motors.
    File,
    /// The file, by its marks of independent coordinates.
    Independent,
}

/// The inputs of a mechanism on a branch.
#[derive(Clone, Debug)]
pub struct Inputs {
    /// Those that somebody names; none where nobody does.
    pub given: Vec<Freedom>,
    /// Who does.
    pub source: Option<InputSource>,
    /// What these do, and what is proposed beside them; `None` where the branch or the margins do not tell.
    pub actuation: Option<Actuation>,
    /// The curve that was followed to see what goes round, where the branch is one.
    followed: Option<Box<Found>>,
}

impl Inputs {
    /// The motion along the branch, where it is a curve and was followed to find the inputs: two samples of it, the inputs that
    /// [`inputs`] was asked for being none. What is forward along it, and which variable it names as driven, is arbitrary. `branch` and
    /// `configuration` are those of that call. `None` where nothing was followed; then [`trace`](super::trace) follows the branch.
    #[must_use]
    pub fn motion(
        self,
        mechanism: &Mechanism,
        analysis: &Analysis,
        branch: &Branch,
        configuration: Option<&str>,
    ) -> Option<Motion> {
        let found = *self.followed?;
        let options = options(configuration);
        let (joint, variable) = *found
            .curve
            .solver
            .system
            .variables()
            .get(found.curve.drive)?;
        let drive = Variable::of(mechanism, joint, variable);
        let notes = found.notes.clone();
        let branches = analysis.branches.as_deref().unwrap_or_default();
        let tracer = Tracer::new(mechanism, analysis, branch, &options);
        Some(tracer.motion(found, drive, branches, notes, &options))
    }

    /// What to drive: the independent ones of those given, in their order, then those proposed. Those given where it is not known
    /// what they do; nothing where nobody names any either.
    #[must_use]
    pub fn driven(&self) -> Vec<Freedom> {
        match &self.actuation {
            Some(found) => [found.independent.as_slice(), &found.proposed].concat(),
            None => self.given.clone(),
        }
    }

    /// The same, named.
    #[must_use]
    pub fn variables(&self, mechanism: &Mechanism) -> Vec<Variable> {
        let named = |input: &Freedom| Variable::of(mechanism, input.joint, input.variable);
        self.driven().iter().map(named).collect()
    }
}

/// The inputs of a mechanism on a branch, in the configuration that was analysed; `asked` are those that the caller names, if any.
#[must_use]
pub fn inputs(
    mechanism: &Mechanism,
    analysis: &Analysis,
    branch: &Branch,
    configuration: Option<&str>,
    asked: Vec<Freedom>,
) -> Inputs {
    let options = options(configuration);
    let tracer = Tracer::new(mechanism, analysis, branch, &options);
    let (given, source) = given(mechanism, asked);
    let here = match analysis.mobility.pose {
        Some(PoseKind::Regular) => pose_of_branch(
            mechanism,
            &analysis.structure,
            &analysis.assembly.states,
            &analysis.parts,
            branch,
        ),
        _ => None,
    };
    let (turning, followed) = tracer.turning(&given);
    let actuation = actuation(
        mechanism,
        &tracer.geometry,
        &analysis.structure,
        branch,
        here.as_ref(),
        (&given, &turning),
    );
    Inputs {
        given,
        source,
        actuation,
        followed: followed.filter(|_| branch.dimension == 1).map(Box::new),
    }
}

/// How curves are followed to see what goes round.
fn options(configuration: Option<&str>) -> TraceOptions {
    TraceOptions {
        configuration: configuration.map(str::to_owned),
        poses: POSES,
        samples: 2,
        ..TraceOptions::default()
    }
}

/// The inputs that somebody names, and who.
///
/// URDF+ takes every joint for independent that is not marked. So its marks say something only where some joint is marked as
/// dependent, and something ties joints together.
fn given(mechanism: &Mechanism, asked: Vec<Freedom>) -> (Vec<Freedom>, Option<InputSource>) {
    if !asked.is_empty() {
        return (asked, Some(InputSource::Asked));
    }
    let joints = mechanism.joints();
    let freedoms = |of: Vec<usize>| {
        let variables = |joint: usize| {
            (0..joints[joint].freedom()).map(move |variable| Freedom { joint, variable })
        };
        of.into_iter().flat_map(variables).collect::<Vec<_>>()
    };
    let drives = mechanism.scene().map_or(&[][..], |scene| &scene.drives);
    let motors = drives.iter().map(|drive| drive.joint);
    let mut driven: Vec<usize> = Vec::new();
    for JointId(joint) in motors.chain(mechanism.actuated().iter().copied()) {
        if !driven.contains(&joint) {
            driven.push(joint);
        }
    }
    if !driven.is_empty() {
        return (freedoms(driven), Some(InputSource::File));
    }
    let tied = !mechanism.couplings().is_empty() || joints.iter().any(|joint| joint.closes_loop);
    if tied && joints.iter().any(|joint| joint.independent == Some(false)) {
        let marked = |joint: &usize| {
            !joints[*joint].closes_loop && joints[*joint].independent != Some(false)
        };
        let marked = (0..joints.len()).filter(marked).collect();
        return (freedoms(marked), Some(InputSource::Independent));
    }
    (Vec::new(), None)
}

/// Mechanisms of more parts that move along a curve are not followed for this: each takes as long as the whole is large.
const CURVES: usize = 20;

impl Tracer<'_> {
    /// Freedoms that go round without dead centre, of parts that move along a curve and have no input yet, and the last such curve.
    fn turning(&self, given: &[Freedom]) -> (BTreeSet<Freedom>, Option<Found>) {
        let (mut found, mut last) = (BTreeSet::new(), None);
        let curves = self.stages.iter().filter(|stage| stage.dimension == 1);
        if curves.clone().count() > CURVES {
            return (found, last);
        }
        for stage in curves {
            let joints = &stage.part.joints;
            let decided = given.iter().any(|input| joints.contains(&input.joint));
            if decided || joints.len() < 2 {
                continue;
            }
            let (states, at_home) = self.start(stage);
            let system = LoopSystem::new(self.mechanism, &self.geometry, &states, &stage.part);
            let Some(system) = system.ok().filter(|s| s.unknowns() <= VARIABLES) else {
                continue;
            };
            let system = Arc::new(system);
            let pose = system.pose(&states);
            let Ok(Some(curve)) = self.follow(stage, &system, pose, at_home, Vec::new(), None)
            else {
                continue;
            };
            for (unknown, (joint, variable)) in system.variables().into_iter().enumerate() {
                let named = Variable::of(self.mechanism, joint, variable);
                if system.is_scalar(unknown) && self.score(&curve, &named).is_infinite() {
                    found.insert(Freedom { joint, variable });
                }
            }
            last = Some(curve);
        }
        (found, last)
    }
}
