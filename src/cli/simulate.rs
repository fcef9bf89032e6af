//! `kutzbach simulate FILE`: what a physics engine says about the prediction, and the scene that the file calls for.

pub mod aside;
mod choices;
mod idle;
mod log;
mod setting;
mod table;

use super::failure::Failure;
use super::pose::Pose;
use super::{DISAGREEMENT, DONE, UNDECIDED, interrupt, load, output, terminal};
use choices::{Effect, Format, IntegratorChoice, SolverChoice, substeps};
use clap::Args;
use kutzbach::mobility::{AnalysisOptions, Followed, Verdict, analyse_to_follow};
use kutzbach::simulate::verification::{
    Beside, Observer, Outcome, Verification, VerificationOptions, verify,
};
use kutzbach::simulate::{
    LONGEST_STEP, RUNGE_KUTTA_STEP, Refinement, SceneOptions, WorldOptions, cost_table,
    run_scene_estimated, scene_drives,
};
use log::Log;
use std::path::PathBuf;
use std::sync::Arc;
use table::Simulated;

/// Simulate a mechanism: is the predicted motion confirmed? Log it for viewers
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: load::Source,
    #[command(flatten)]
    closing: load::Closing,
    /// Write predicted and simulated motion to this MCAP log
    #[arg(long, value_name = "LOG", help_heading = "The log")]
    mcap: Option<PathBuf>,
    /// Verify this branch only
    #[arg(long)]
    branch: Option<String>,
    /// Joint to drive; one that serves if not given
    #[arg(long, value_name = "JOINT")]
    drive: Option<String>,
    /// How trees of joints are held; `auto` tries multibodies, then impulses
    #[arg(long, value_enum, default_value_t = SolverChoice::Auto, help_heading = "The verification")]
    solver: SolverChoice,
    /// Substeps of a step, ascending: the ladder of the verification
    #[arg(long, value_name = "N,N,…", value_parser = substeps, default_value = "4,8,16,32,64,128,256", help_heading = "The verification")]
    substeps: choices::Ladder,
    /// Go on to the end of the ladder after it has decided
    #[arg(long, help_heading = "The verification")]
    whole_ladder: bool,
    /// Length of a step (s)
    #[arg(long, value_name = "SECONDS", help_heading = "The verification")]
    time_step: Option<f64>,
    /// Simulate with the cheapest setting that stays within this error, found by trying: the driven motion within it of the
    /// prediction, and the scene's own motion, speeds included, by runs in halved steps (characteristic lengths, rad)
    #[arg(long,
        value_name = "ERROR",
        value_parser = super::accuracy::error,
        conflicts_with_all = ["substeps", "time_step"], help_heading = "The verification")]
    accuracy: Option<f64>,
    /// Seed of the random impulses that count degrees of freedom
    #[arg(long, default_value_t = 1, help_heading = "The verification")]
    seed: u64,
    /// Spend about so many seconds of work on the verification, counted in steps and not by the clock, so that the answer
    /// is the same on every machine; what does not fit is named as not tested
    #[arg(long, value_name = "SECONDS", value_parser = budget, default_value_t = 30.0, help_heading = "The verification")]
    budget: f64,
    /// Add an effect to those of the file's scene; may be repeated
    #[arg(
        long = "with",
        value_enum,
        value_name = "EFFECT",
        help_heading = "The scene"
    )]
    with: Vec<Effect>,
    /// Leave an effect of the file's scene out; may be repeated
    #[arg(
        long = "without",
        value_enum,
        value_name = "EFFECT",
        help_heading = "The scene"
    )]
    without: Vec<Effect>,
    /// What makes the scene move
    #[arg(long, value_enum, default_value_t = IntegratorChoice::Auto, help_heading = "The scene")]
    integrator: IntegratorChoice,
    /// How fast shapes that touch part again, as a share of the speed of approach, from 0 to 1 [default: that of the scene, or 0]
    #[arg(long, value_name = "SHARE", value_parser = share, help_heading = "The scene")]
    restitution: Option<f64>,
    /// Simulated seconds of the scene [default: 2]
    #[arg(long, value_name = "SECONDS", help_heading = "The scene")]
    duration: Option<f64>,
    /// Say what each effect costs
    #[arg(long, help_heading = "The scene")]
    cost: bool,
    /// Poses of the predicted motion in the log [default: 200]
    #[arg(long, value_name = "N", help_heading = "The log")]
    samples: Option<usize>,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    destination: output::Destination,
    #[command(flatten)]
    pose: Pose,
    /// End with exit code 3 where nothing is decided
    #[arg(long)]
    strict: bool,
    /// Show every detail
    #[arg(long)]
    verbose: bool,
    /// Say in JSON too how long each simulation took
    #[arg(long, help_heading = "The verification")]
    timing: bool,
}

fn budget(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds >= 0.0 && seconds.is_finite() => Ok(seconds),
        _ => Err(format!("`{text}` is no number of seconds, zero or more")),
    }
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(share) if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err(format!("`{text}` is no number from 0 to 1")),
    }
}

/// Simulated seconds of a scene where none are asked for.
const DURATION: f64 = 2.0;

/// Seconds of work that a scene may take with all runs in halved steps that tell how far it is off.
const SCENE_WORK: f64 = 20.0;

/// Steps that the cost of an effect is measured over.
const COST_STEPS: usize = 500;

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read, has no such configuration, branch or joint, no world can be made, or output cannot be
/// written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    idle::refuse(arguments)?;
    let mut reading = arguments.source.read()?;
    let configuration = arguments.pose.configure(&mut reading)?;
    let mechanism = &reading.mechanism;
    let plain = |message: String, help: Option<String>| Failure::Plain {
        message: format!("{}: {message}", arguments.source.file.display()),
        help,
    };
    let Followed {
        mechanism,
        analysis,
        changed,
    } = analyse_to_follow(
        mechanism,
        &AnalysisOptions {
            configuration: configuration.clone(),
            closure_tolerance: arguments.closing.closure_tolerance,
            ..AnalysisOptions::default()
        },
    )
    .map_err(|error| {
        plain(
            error.to_string(),
            Some("`kutzbach report FILE` tells more".to_owned()),
        )
    })?;
    let mechanism = &mechanism;
    if let Some(name) = &arguments.drive {
        kutzbach::motion::variable_named(mechanism, name)
            .map_err(|error| plain(error.to_string(), Some(error.help())))?;
    }
    let geometry = Arc::clone(&analysis.geometry);
    let mut options = VerificationOptions {
        branch: arguments.branch.clone(),
        configuration: configuration.clone(),
        drive: arguments.drive.clone(),
        solvers: arguments.solver.solvers(),
        ladder: arguments.substeps.0.clone(),
        seed: arguments.seed,
        whole_ladder: arguments.whole_ladder,
        budget: Some(arguments.budget),
        ..VerificationOptions::default()
    };
    if let Some(time_step) = arguments.time_step {
        options.time_step = time_step;
    }
    let refused = |message: String| plain(message, Some("see `kutzbach simulate --help`".into()));
    WorldOptions {
        time_step: options.time_step,
        ..WorldOptions::default()
    }
    .check()
    .map_err(|error| refused(error.to_string()))?;
    let duration = arguments.duration.unwrap_or(DURATION);
    if !(duration >= 0.0 && duration.is_finite()) {
        return Err(refused(format!(
            "a scene lasts a finite number of seconds, but {duration} were asked for"
        )));
    }
    if let Some(samples) = arguments.samples
        && !(2..=10_000_000).contains(&samples)
    {
        return Err(refused(format!(
            "{samples} samples; from 2 to 10000000 are possible"
        )));
    }

    let choice = match arguments.accuracy {
        None => None,
        Some(wanted) => {
            Some(setting::chosen(mechanism, &analysis, &options, wanted).map_err(refused)?)
        }
    };
    let setting = choice.as_ref().and_then(setting::of);
    if let Some(setting) = setting {
        setting::begin_with(setting, &mut options);
    }

    let mut effects = choices::effects(mechanism, &arguments.with, &arguments.without);
    effects.restitution = arguments.restitution.unwrap_or(effects.restitution);
    let drives = scene_drives(mechanism);
    // A step that is asked for is taken as it is, and refused where it is longer than the scene.
    let no_longer = |usual: f64| match (arguments.time_step, duration > 0.0) {
        (Some(step), _) => step,
        (None, true) => usual.min(duration),
        (None, false) => usual,
    };
    let world = WorldOptions {
        solver: options.solvers.first().copied().unwrap_or_default(),
        effects,
        time_step: no_longer(setting.map_or(1.0 / 240.0, |s| s.time_step)),
        substeps: setting.map_or(WorldOptions::default().substeps, |s| s.substeps),
    };
    let called_for = !kutzbach::simulate::effect_names(&effects).is_empty() || !drives.is_empty();

    if called_for
        && let Some(step) = arguments.time_step
        && duration > 0.0
        && step > duration
    {
        return Err(refused(format!(
            "a step of {step} s is longer than the scene, which lasts {duration} s"
        )));
    }

    let mut log = Log::begin(arguments, &reading, &geometry, &analysis, &options)?;
    let posed = analysis.mobility.verdict != Verdict::Unassembled;
    let scene = if called_for && posed {
        let scene = SceneOptions {
            world,
            drives: drives.clone(),
            duration,
            integrator: arguments.integrator.integrator(),
            runge_kutta_step: no_longer(match arguments.accuracy {
                Some(_) => LONGEST_STEP,
                None => RUNGE_KUTTA_STEP,
            }),
        };
        let refinement = Refinement {
            wanted: arguments.accuracy,
            work: SCENE_WORK,
        };
        let run = log
            .watch(|observer| {
                let how = (refinement, &interrupt::asked as &dyn Fn() -> bool);
                let start = &analysis.assembly.states;
                let mut beside;
                let observer: &mut dyn Observer = if arguments.mcap.is_some() {
                    beside = Beside::new(mechanism, &geometry, &analysis, observer);
                    &mut beside
                } else {
                    observer
                };
                run_scene_estimated(mechanism, &geometry, start, &scene, how, observer)
            })?
            .map_err(|error| refused(error.to_string()))?;
        log.tell(&table::off_text(&run.1))?;
        Some(run)
    } else {
        None
    };
    let verification = match interrupt::asked() {
        true => Verification::broken_off(analysis.mobility.verdict),
        false => log
            .watch(|observer| verify(mechanism, &geometry, &analysis, &options, observer))?
            .map_err(|error| refused(error.to_string()))?,
    };
    let mut simulated = Simulated {
        mechanism,
        changed,
        choice,
        verification,
        scene,
        cost: None,
        idle: idle::idle(
            arguments,
            mechanism,
            analysis.mobility.verdict,
            (&effects, called_for),
        ),
        log: None,
        stopped: false,
    };
    simulated.stopped = simulated.verification.stopped || interrupt::asked();
    if arguments.cost && posed && !simulated.stopped {
        let rows = cost_table(
            mechanism,
            &geometry,
            &analysis.assembly.states,
            &world,
            &drives,
            COST_STEPS,
        );
        simulated.cost = Some(rows.map_err(|error| refused(error.to_string()))?);
    }
    simulated.log = log.finish(&simulated.verification.finding, simulated.stopped)?;
    let text = match arguments.format {
        Format::Text => table::text(
            &simulated,
            terminal::layout(arguments.destination.file().is_some(), arguments.verbose),
        ),
        Format::Json => output::json(&table::json(&simulated, arguments.timing))?,
    };
    arguments.destination.put(&text)?;
    if simulated.stopped {
        return Ok(interrupt::INTERRUPTED);
    }
    Ok(match simulated.verification.finding.outcome {
        Outcome::Contradicted => DISAGREEMENT,
        Outcome::Inconclusive if arguments.strict => UNDECIDED,
        // A wanted error that no setting reaches is not what was asked for either.
        Outcome::Confirmed if arguments.strict && simulated.misses() => UNDECIDED,
        Outcome::Inconclusive | Outcome::Confirmed => DONE,
    })
}
