//! Running a scene: a mechanism under the effects that it calls for, for a while.
//!
//! Nothing is predicted here. What is kept is what shows whether each effect does its own and nothing else: energy,
//! touching shapes, limits exceeded, loops opened.

use super::verification::{Moment, Observer, Passage, largest_gap};
use super::{Drive, Effects, Pieces, Solver, World, WorldError, WorldOptions};
use kutzbach_closure::{Geometry, JointState};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::Variable;
use serde::Serialize;

/// What to run.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneOptions {
    /// How the world is built and stepped.
    pub world: WorldOptions,
    /// Driven freedoms.
    pub drives: Vec<Drive>,
    /// Simulated seconds.
    pub duration: f64,
}

/// How a run went.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneRun {
    /// The effects, by name.
    pub effects: Vec<&'static str>,
    /// How trees were held.
    pub solver: Solver,
    /// Length of a step (s).
    pub time_step: f64,
    /// Substeps of a step.
    pub substeps: usize,
    /// Simulated seconds reached.
    pub time: f64,
    /// What the world consisted of.
    pub pieces: Pieces,
    /// Kinetic and potential energy at the end (J).
    pub kinetic_energy: f64,
    /// See [`Self::kinetic_energy`].
    pub potential_energy: f64,
    /// Energy at the end less that at the start (J): what drives brought in, less what friction, damping, contact and
    /// limits took. Where there are none of these it is the engine's error.
    pub energy_change: f64,
    /// The largest kinetic energy at a moment shown (J).
    pub largest_kinetic_energy: f64,
    /// Whether nothing in the scene brings energy in or takes it: no drive, contact, friction, damping or limit.
    pub conservative: bool,
    /// The most pairs of shapes that touched at once.
    pub most_contacts: usize,
    /// The joint that went farthest beyond its limit, and by how much (rad, m).
    pub beyond_limit: Option<(String, f64)>,
    /// Largest gap of any joint (characteristic lengths, rad).
    pub closure_error: f64,
    /// Why it ended early, if it did.
    pub ended_early: Option<String>,
    /// Constraints that the engine cannot hold.
    pub not_simulated: Vec<String>,
    /// Seconds on the clock.
    #[serde(skip)]
    pub wall_time: f64,
    /// Seconds on the clock that the steps took, looking not counted.
    #[serde(skip)]
    pub step_time: f64,
}

/// The effects that are on, by name.
#[must_use]
pub fn effect_names(effects: &Effects) -> Vec<&'static str> {
    [
        ("gravity", effects.gravity.is_some()),
        ("contact", effects.contact),
        ("limits", effects.limits),
        ("friction", effects.friction),
        ("damping", effects.damping),
    ]
    .into_iter()
    .filter_map(|(name, on)| on.then_some(name))
    .collect()
}

/// The drives of the mechanism's scene; each on the first freedom of its joint, without a cap where the file has none.
#[must_use]
pub fn scene_drives(mechanism: &Mechanism) -> Vec<Drive> {
    mechanism
        .scene()
        .iter()
        .flat_map(|scene| &scene.drives)
        .map(|drive| Drive {
            joint: drive.joint.0,
            freedom: 0,
            velocity: drive.velocity.value(),
            largest_force: drive.torque.as_ref().map_or(f64::INFINITY, |t| t.value()),
        })
        .collect()
}

/// Whether nothing of a scene brings energy in or takes it.
fn is_conservative(options: &SceneOptions) -> bool {
    let Effects {
        gravity: _,
        contact,
        limits,
        friction,
        damping,
    } = options.world.effects;
    options.drives.is_empty() && !(contact || limits || friction || damping)
}

/// Moments shown per simulated second.
const MOMENTS_PER_SECOND: f64 = 60.0;

/// Runs a scene from a closed pose, at rest.
///
/// # Errors
/// Where the world cannot be made or driven. That it diverges is a result: [`SceneRun::ended_early`].
pub fn run_scene(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    start: &[JointState<f64>],
    options: &SceneOptions,
    observer: &mut dyn Observer,
) -> Result<SceneRun, WorldError> {
    run_in(
        mechanism,
        geometry,
        start,
        options,
        Paces::of(options),
        observer,
        &mut |_, _| (),
    )
}

/// How many steps a run has, and after how many of them a moment is shown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paces {
    pub steps: u64,
    pub every: u64,
}

impl Paces {
    pub fn of(options: &SceneOptions) -> Self {
        Self {
            steps: (options.duration / options.world.time_step).round() as u64,
            every: ((1.0 / (MOMENTS_PER_SECOND * options.world.time_step)) as u64).max(1),
        }
    }
}

/// A scene as it is announced.
pub(super) fn passage_of(mechanism: &Mechanism, options: &SceneOptions) -> Passage {
    let effects = effect_names(&options.world.effects).join(", ");
    Passage {
        title: if effects.is_empty() {
            "scene without effects".to_owned()
        } else {
            format!("scene with {effects}")
        },
        branch: String::new(),
        driven: options
            .drives
            .first()
            .map(|drive| Variable::of(mechanism, drive.joint, drive.freedom)),
        substeps: options.world.substeps,
        duration: options.duration,
    }
}

/// [`run_scene`] in given paces; `look` sees the world at each moment.
pub(super) fn run_in(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    start: &[JointState<f64>],
    options: &SceneOptions,
    Paces { steps, every }: Paces,
    observer: &mut dyn Observer,
    look: &mut dyn FnMut(&World, &Moment<'_>),
) -> Result<SceneRun, WorldError> {
    if !(options.duration >= 0.0 && options.duration.is_finite()) {
        return Err(WorldError::Options(format!(
            "a run lasts a finite number of seconds, but {} were asked for",
            options.duration
        )));
    }
    let begun = std::time::Instant::now();
    let mut world = World::new(mechanism, geometry, start, &options.world)?;
    for drive in &options.drives {
        world.drive(*drive)?;
    }
    let (length, _) = world.scale();
    let energy = world.energy().total();
    let mut run = SceneRun {
        effects: effect_names(&options.world.effects),
        solver: options.world.solver,
        time_step: options.world.time_step,
        substeps: options.world.substeps,
        time: 0.0,
        pieces: world.pieces(),
        kinetic_energy: 0.0,
        potential_energy: 0.0,
        energy_change: 0.0,
        largest_kinetic_energy: 0.0,
        conservative: is_conservative(options),
        most_contacts: 0,
        beyond_limit: None,
        closure_error: 0.0,
        ended_early: None,
        not_simulated: world.not_simulated().to_vec(),
        wall_time: 0.0,
        step_time: 0.0,
    };
    let mut stopped = observer.begin(&passage_of(mechanism, options)).is_break();
    let mut states = start.to_vec();
    for step in 1..=steps {
        if stopped {
            run.ended_early = Some("broken off".to_owned());
            break;
        }
        let before = std::time::Instant::now();
        let stepped = world.step();
        run.step_time += before.elapsed().as_secs_f64();
        if let Err(error) = stepped {
            run.ended_early = Some(error.to_string());
            break;
        }
        states = world.states(&states);
        run.time = world.time();
        run.most_contacts = run.most_contacts.max(world.contacts());
        for (joint, beyond) in world.limit_violations_of(&states) {
            if beyond > run.beyond_limit.as_ref().map_or(0.0, |(_, most)| *most) {
                run.beyond_limit = Some((mechanism.joints()[joint].name.clone(), beyond));
            }
        }
        if step % every != 0 && step != steps {
            continue;
        }
        let kinetic = world.energy().kinetic;
        run.largest_kinetic_energy = run.largest_kinetic_energy.max(kinetic);
        let gaps = world.gaps();
        let closure_error = largest_gap(&gaps, length);
        // What is not a number must not pass for small.
        if !(closure_error <= run.closure_error) {
            run.closure_error = closure_error;
        }
        let poses = world.link_poses();
        let moment = Moment {
            time: world.time(),
            done: step as f64 / steps as f64,
            simulated: &poses,
            states: &states,
            predicted: None,
            gaps: &gaps,
            closure_error,
            distance: 0.0,
        };
        look(&world, &moment);
        stopped = observer.moment(&moment).is_break();
    }
    let last = world.energy();
    run.kinetic_energy = last.kinetic;
    run.potential_energy = last.potential;
    run.energy_change = last.total() - energy;
    run.wall_time = begun.elapsed().as_secs_f64();
    Ok(run)
}
