//! What the physics engine says of the prediction, and the scene that the file calls for.

use crate::asked::{self, Simulate};
use crate::failure::Failure;
use crate::reading::Subject;
use kutzbach::interruption;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, Followed, Verdict, analyse_to_follow};
use kutzbach::report::simulated::data;
use kutzbach::simulate::verification::{Moment, Observer, Passage, VerificationOptions, verify};
use kutzbach::simulate::{
    Effects, RUNGE_KUTTA_STEP, Refinement, SceneOptions, SceneRun, Solver, Trajectory, WorldError,
    WorldOptions, effect_names, run_scene_estimated, scene_drives,
};
use std::ops::ControlFlow;

/// Work on the verification and simulated seconds of the scene where none are stated, and work on the scene: as the command line
/// has them.
const BUDGET: f64 = 30.0;
const DURATION: f64 = 2.0;
const SCENE_WORK: f64 = 20.0;

/// Breaks a simulation off where it is interrupted.
struct Watch;

/// Whether it goes on.
fn goes_on() -> ControlFlow<()> {
    match interruption::asked() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    }
}

impl Observer for Watch {
    fn begin(&mut self, _: &Passage) -> ControlFlow<()> {
        goes_on()
    }

    fn moment(&mut self, _: &Moment<'_>) -> ControlFlow<()> {
        goes_on()
    }
}

/// What `kutzbach simulate --format json` writes.
///
/// # Errors
/// A configuration, branch or joint that there is not; a world that cannot be made.
pub fn simulated(subject: &Subject, asked: &str) -> Result<String, Failure> {
    let asked: Simulate = asked::parsed(asked)?;
    let duration = asked.duration.unwrap_or(DURATION);
    if !(duration >= 0.0 && duration.is_finite()) {
        return Err(Failure::plain(
            format!("a scene lasts a finite number of seconds, but {duration} were asked for"),
            "`duration` is 0 or more",
        ));
    }
    let configuration = asked::named(asked.configuration);
    let Followed {
        mechanism,
        analysis,
        changed,
    } = analyse_to_follow(
        subject.mechanism(),
        &AnalysisOptions {
            configuration: configuration.clone(),
            closure_tolerance: asked.closure_tolerance,
            ..AnalysisOptions::default()
        },
    )
    .map_err(|error| subject.failed(&error.to_string(), None))?;
    let defaults = VerificationOptions::default();
    let options = VerificationOptions {
        branch: asked.branch,
        configuration,
        drive: asked.drive,
        seed: asked.seed.unwrap_or(defaults.seed),
        budget: Some(asked.budget.unwrap_or(BUDGET)),
        ..defaults
    };
    if let Some(name) = &options.drive {
        kutzbach::motion::variable_named(&mechanism, name)
            .map_err(|error| subject.failed(&error.to_string(), Some(error.help())))?;
    }
    let mut watch = Watch;
    let verification = verify(
        &mechanism,
        &analysis.geometry,
        &analysis,
        &options,
        &mut watch,
    )
    .map_err(|error| subject.failed(&error.to_string(), None))?;
    let mut scene = None;
    if !verification.stopped {
        let solver = options.solvers.first().copied().unwrap_or_default();
        scene = scene_run(&mechanism, &analysis, (solver, duration), &mut watch)
            .map_err(|error| subject.failed(&error.to_string(), None))?;
    }
    Ok(data(&mechanism, changed, None, &verification, scene.as_ref()).to_string())
}

/// The scene that the file calls for, from the pose analysed; none where it calls for none, or there is no pose.
fn scene_run(
    mechanism: &Mechanism,
    analysis: &Analysis,
    (solver, duration): (Solver, f64),
    watch: &mut Watch,
) -> Result<Option<(SceneRun, Trajectory)>, WorldError> {
    let effects = Effects::of_scene(mechanism);
    let drives = scene_drives(mechanism);
    let called_for = !effect_names(&effects).is_empty() || !drives.is_empty();
    if !called_for || analysis.mobility.verdict == Verdict::Unassembled {
        return Ok(None);
    }
    let scene = SceneOptions {
        world: WorldOptions {
            solver,
            effects,
            ..WorldOptions::default()
        },
        drives,
        duration,
        integrator: None,
        runge_kutta_step: RUNGE_KUTTA_STEP,
    };
    let refinement = Refinement {
        wanted: None,
        work: SCENE_WORK,
    };
    let how = (refinement, &interruption::asked as &dyn Fn() -> bool);
    let states = &analysis.assembly.states;
    run_scene_estimated(mechanism, &analysis.geometry, states, &scene, how, watch).map(Some)
}
