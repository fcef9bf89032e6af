//! Running a scene: a mechanism under the effects that it calls for, for a while.
//!
//! Nothing is predicted here. What is kept is what shows whether each effect does its own and nothing else: energy,
//! touching shapes, limits exceeded, loops opened.

use super::measure::{joint_gaps, joint_states, limit_violations};
use super::smooth::{Integrator, REACHED, Serving, SmoothWorld, refusals};
use super::verification::{Moment, Observer, Passage, largest_gap};
use super::{Drive, Effects, Energy, Pieces, Solver, World, WorldError, WorldOptions};
use kutzbach_closure::{Geometry, JointState, Rigid};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Dynamics, Mechanism};
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
    /// What makes it move; `None` for what its effects call for ([`SERVING`](super::SERVING)).
    pub integrator: Option<Integrator>,
    /// Length of a Runge-Kutta step (s); that of the engine is [`WorldOptions::time_step`].
    pub runge_kutta_step: f64,
}

/// Length of a Runge-Kutta step where none is asked for (s): one for each moment shown.
pub const RUNGE_KUTTA_STEP: f64 = 1.0 / MOMENTS_PER_SECOND;

/// Length of a Runge-Kutta step to begin with where an error is wanted (s): a coarse one is had in steps that are looked into.
pub const LONGEST_STEP: f64 = 8.0 * RUNGE_KUTTA_STEP;

/// How a run went.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneRun {
    /// The effects, by name.
    pub effects: Vec<&'static str>,
    /// Those of them that have nothing to act on.
    pub idle_effects: Vec<IdleEffect>,
    /// What made it move.
    pub integrator: Integrator,
    /// Why that was the engine, where the scene's effects or its motion called for it.
    pub engine_because: Vec<&'static str>,
    /// How the engine held trees; nothing where no engine moved it.
    pub solver: Option<Solver>,
    /// Length of a step (s).
    pub time_step: f64,
    /// Substeps of a step of the engine; 1 where no engine moved it.
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
    /// Kinetic energy below this is hardly any (J): a millionth of what falling by the mechanism's own length gives.
    #[serde(skip)]
    pub least_energy: f64,
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

/// An effect that is on and has nothing to act on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct IdleEffect {
    /// Its name.
    pub effect: &'static str,
    /// Why.
    pub because: &'static str,
}

/// Effects that are on and have nothing to act on.
#[must_use]
pub fn idle_effects(mechanism: &Mechanism, effects: &Effects) -> Vec<IdleEffect> {
    let joints = mechanism.joints();
    let states = |of: fn(&Dynamics) -> &Option<Number>| {
        let stated = joints.iter().filter_map(|joint| joint.dynamics.as_ref());
        stated
            .filter_map(|dynamics| of(dynamics).as_ref())
            .any(|number| number.value() > 0.0)
    };
    let solid = mechanism
        .links()
        .iter()
        .filter(|link| !link.collisions.is_empty());
    [
        (
            "contact",
            effects.contact && solid.count() < 2,
            "fewer than two links have collision shapes",
        ),
        (
            "limits",
            effects.limits && joints.iter().all(|joint| joint.bounds().is_none()),
            "no joint of one freedom has a limit",
        ),
        (
            "friction",
            effects.friction && !states(|dynamics| &dynamics.friction),
            "no joint states any",
        ),
        (
            "damping",
            effects.damping && !states(|dynamics| &dynamics.damping),
            "no joint states any",
        ),
    ]
    .into_iter()
    .filter_map(|(effect, idle, because)| idle.then_some(IdleEffect { effect, because }))
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

/// The share of the energy of falling by its own length that a mechanism has to have for shares of its energy to tell something.
pub(super) const STILL: f64 = 1e-6;

/// m/s².
pub(super) fn gravity_of(options: &SceneOptions) -> f64 {
    let gravity = options.world.effects.gravity.unwrap_or_default();
    gravity.iter().map(|g| g * g).sum::<f64>().sqrt()
}

/// Whether nothing of a scene brings energy in or takes it.
fn is_conservative(options: &SceneOptions) -> bool {
    let Effects {
        gravity: _,
        contact,
        restitution: _,
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
/// Where the world cannot be made or driven, or the integrator asked for cannot serve the scene. That it diverges is a result:
/// [`SceneRun::ended_early`].
pub fn run_scene(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    start: &[JointState<f64>],
    options: &SceneOptions,
    observer: &mut dyn Observer,
) -> Result<SceneRun, WorldError> {
    let scene = Scene {
        mechanism,
        geometry,
        start,
        options,
    };
    let (mut run, because) = served(mechanism, options, &mut |integrator, _| {
        let paces = Paces::of(options, integrator);
        run_in(&scene, integrator, paces, observer, &mut |_, _| ())
    })?;
    run.engine_because = because;
    Ok(run)
}

/// Runs with Runge-Kutta steps where they serve, and else, or where they turn out not to, with the engine, which is told why; and says it.
///
/// # Errors
/// Those of the runs, and [`WorldError::Options`] where the integrator asked for cannot serve the scene.
pub(super) fn served<T>(
    mechanism: &Mechanism,
    options: &SceneOptions,
    run: &mut Running<'_, T>,
) -> Result<(T, Vec<&'static str>), WorldError> {
    let mut refused = Vec::new();
    if options.integrator != Some(Integrator::Engine) {
        refused = refusals(mechanism, options);
        if refused.is_empty() {
            match run(Integrator::RungeKutta, &[])? {
                Ok(done) => return Ok((done, Vec::new())),
                Err(serving) => refused.push(serving),
            }
        }
    }
    let because: Vec<&'static str> = refused.iter().map(|serving| serving.effect).collect();
    if options.integrator == Some(Integrator::RungeKutta) {
        return Err(WorldError::Options(format!(
            "Runge-Kutta steps do not serve a scene with {}",
            because.join(", ")
        )));
    }
    match run(Integrator::Engine, &refused)? {
        Ok(done) => Ok((done, because)),
        Err(serving) => Err(WorldError::Options(serving.because.to_owned())),
    }
}

/// Runs with an integrator, told what was refused another one.
pub(super) type Running<'a, T> =
    dyn FnMut(Integrator, &[Serving]) -> Result<Served<T>, WorldError> + 'a;

/// A result, or why there is none and the engine has to do it.
pub(super) type Served<T> = Result<T, Serving>;

/// What a run needs to know.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub mechanism: &'a Mechanism,
    pub geometry: &'a Geometry<f64>,
    pub start: &'a [JointState<f64>],
    pub options: &'a SceneOptions,
}

/// How many steps a run has, or looks into longer ones, and after how many of them a moment is shown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paces {
    pub steps: u64,
    pub every: u64,
}

impl Paces {
    pub fn of(options: &SceneOptions, integrator: Integrator) -> Self {
        let step = step_of(options, integrator);
        let pace = match integrator {
            Integrator::RungeKutta => step / looks_in(step) as f64,
            Integrator::Engine => step,
        };
        Self {
            steps: (options.duration / pace).round() as u64,
            every: ((1.0 / (MOMENTS_PER_SECOND * pace)) as u64).max(1),
        }
    }

    /// Of steps halved so often, with the same moments.
    pub fn halved(self, options: &SceneOptions, integrator: Integrator, halvings: u32) -> Self {
        let looks = match integrator {
            Integrator::RungeKutta => looks_in(options.runge_kutta_step),
            Integrator::Engine => 1,
        };
        // Steps longer than what lies between two moments are looked into.
        let more = halvings.saturating_sub(looks.trailing_zeros());
        Self {
            steps: self.steps << more,
            every: self.every << more,
        }
    }
}

/// Looks at a Runge-Kutta step of a length (s): so many powers of two that all moments are seen.
pub(super) fn looks_in(step: f64) -> u64 {
    let moments = (step * MOMENTS_PER_SECOND - ALMOST).ceil().max(1.0);
    (moments as u64).next_power_of_two()
}

/// A step that is longer than the time between two moments by less than this share is not.
const ALMOST: f64 = 1e-9;

fn step_of(options: &SceneOptions, integrator: Integrator) -> f64 {
    match integrator {
        Integrator::RungeKutta => options.runge_kutta_step,
        Integrator::Engine => options.world.time_step,
    }
}

/// What moves step by step, whatever makes it move.
pub(super) trait Moves {
    /// A step.
    fn step(&mut self) -> Result<(), Stopped>;
    /// s.
    fn time(&self) -> f64;
    /// `world_from_link`.
    fn link_poses(&self) -> Vec<Rigid<f64>>;
    /// In the world: angular velocity (rad/s), velocity of the point at the origin (m/s).
    fn link_twists(&self) -> Vec<[f64; 6]>;
    /// J.
    fn energy(&self) -> Energy;
    /// Pairs of shapes that touch.
    fn contacts(&self) -> usize;
    /// Characteristic length (m).
    fn length(&self) -> f64;
    /// Of all that moves (kg).
    fn mass(&self) -> f64;
    /// What it consists of.
    fn pieces(&self) -> Pieces;
    /// Constraints that it lacks.
    fn not_simulated(&self) -> &[String];
}

/// Why there is no further step.
#[derive(Clone, Debug)]
pub(super) enum Stopped {
    /// The motion left the range of numbers.
    Early(String),
    /// Another integrator has to do it.
    Unserved(Serving),
}

impl Moves for World {
    fn step(&mut self) -> Result<(), Stopped> {
        World::step(self).map_err(|error| Stopped::Early(error.to_string()))
    }

    fn time(&self) -> f64 {
        World::time(self)
    }

    fn link_poses(&self) -> Vec<Rigid<f64>> {
        World::link_poses(self)
    }

    fn link_twists(&self) -> Vec<[f64; 6]> {
        World::link_twists(self)
    }

    fn energy(&self) -> Energy {
        World::energy(self)
    }

    fn contacts(&self) -> usize {
        World::contacts(self)
    }

    fn length(&self) -> f64 {
        self.scale().0
    }

    fn mass(&self) -> f64 {
        self.built
            .masses
            .iter()
            .flatten()
            .map(|mass| mass.mass)
            .sum()
    }

    fn pieces(&self) -> Pieces {
        World::pieces(self)
    }

    fn not_simulated(&self) -> &[String] {
        World::not_simulated(self)
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

impl Scene<'_> {
    fn world(&self, integrator: Integrator) -> Result<Served<Box<dyn Moves>>, WorldError> {
        let Self {
            mechanism,
            geometry,
            start,
            options,
        } = self;
        if integrator == Integrator::RungeKutta {
            let smooth = SmoothWorld::new(mechanism, geometry, start, options)?;
            return Ok(smooth.map(|world| Box::new(world) as Box<dyn Moves>));
        }
        let mut world = World::new(mechanism, geometry, start, &options.world)?;
        for drive in &options.drives {
            world.drive(*drive)?;
        }
        Ok(Ok(Box::new(world)))
    }

    /// A run that has not begun.
    fn still(&self, integrator: Integrator, world: &dyn Moves) -> SceneRun {
        let options = self.options;
        let by_engine = integrator == Integrator::Engine;
        SceneRun {
            effects: effect_names(&options.world.effects),
            idle_effects: idle_effects(self.mechanism, &options.world.effects),
            integrator,
            engine_because: Vec::new(),
            solver: by_engine.then_some(options.world.solver),
            time_step: step_of(options, integrator),
            substeps: if by_engine { options.world.substeps } else { 1 },
            time: 0.0,
            pieces: world.pieces(),
            kinetic_energy: 0.0,
            potential_energy: 0.0,
            energy_change: 0.0,
            largest_kinetic_energy: 0.0,
            least_energy: STILL * world.mass() * gravity_of(options) * world.length(),
            conservative: is_conservative(options),
            most_contacts: 0,
            beyond_limit: None,
            closure_error: 0.0,
            ended_early: None,
            not_simulated: world.not_simulated().to_vec(),
            wall_time: 0.0,
            step_time: 0.0,
        }
    }
}

impl SceneRun {
    /// The energy's change in parts of the greatest kinetic energy, where nothing in the scene takes energy or gives it: an error of the
    /// steps. What hardly moves is measured against what moves by some thousandths of its natural speed.
    #[must_use]
    pub fn energy_error(&self) -> Option<f64> {
        let greatest = self.largest_kinetic_energy.max(self.least_energy);
        (self.conservative && greatest > 0.0).then(|| self.energy_change.abs() / greatest)
    }

    /// Keeps the joint that is farthest beyond its limit.
    fn look_at_limits(&mut self, mechanism: &Mechanism, states: &[JointState<f64>]) {
        for (joint, beyond) in limit_violations(mechanism, states) {
            if beyond > self.beyond_limit.as_ref().map_or(0.0, |(_, most)| *most) {
                self.beyond_limit = Some((mechanism.joints()[joint].name.clone(), beyond));
            }
        }
    }
}

/// A run in given paces; `look` sees the world at each moment.
pub(super) fn run_in(
    scene: &Scene<'_>,
    integrator: Integrator,
    Paces { steps, every }: Paces,
    observer: &mut dyn Observer,
    look: &mut dyn FnMut(&dyn Moves, &Moment<'_>),
) -> Result<Served<SceneRun>, WorldError> {
    let Scene {
        mechanism,
        geometry,
        start,
        options,
    } = *scene;
    if !(options.duration >= 0.0 && options.duration.is_finite()) {
        return Err(WorldError::Options(format!(
            "a run lasts a finite number of seconds, but {} were asked for",
            options.duration
        )));
    }
    let step = step_of(options, integrator);
    if options.duration > 0.0 && step > options.duration * (1.0 + ALMOST) {
        return Err(WorldError::Options(format!(
            "a step of {step} s is longer than the scene, which lasts {} s",
            options.duration
        )));
    }
    let begun = std::time::Instant::now();
    let mut world = match scene.world(integrator)? {
        Ok(world) => world,
        Err(serving) => return Ok(Err(serving)),
    };
    let length = world.length();
    let energy = world.energy().total();
    let mut run = scene.still(integrator, &*world);
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
        match stepped {
            Ok(()) => {}
            Err(Stopped::Unserved(serving)) => return Ok(Err(serving)),
            Err(Stopped::Early(why)) => {
                run.ended_early = Some(why);
                break;
            }
        }
        let poses = world.link_poses();
        states = joint_states(mechanism, geometry, &poses, &states);
        run.time = world.time();
        run.most_contacts = run.most_contacts.max(world.contacts());
        run.look_at_limits(mechanism, &states);
        if integrator == Integrator::RungeKutta
            && options.world.effects.limits
            && run.beyond_limit.is_some()
        {
            return Ok(Err(REACHED));
        }
        if step % every != 0 && step != steps {
            continue;
        }
        let kinetic = world.energy().kinetic;
        run.largest_kinetic_energy = run.largest_kinetic_energy.max(kinetic);
        let gaps = joint_gaps(mechanism, geometry, &poses);
        let closure_error = largest_gap(&gaps, length);
        // What is not a number must not pass for small.
        if !(closure_error <= run.closure_error) {
            run.closure_error = closure_error;
        }
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
        look(&*world, &moment);
        stopped = observer.moment(&moment).is_break();
    }
    let last = world.energy();
    run.kinetic_energy = last.kinetic;
    run.potential_energy = last.potential;
    run.energy_change = last.total() - energy;
    run.wall_time = begun.elapsed().as_secs_f64();
    Ok(Ok(run))
}
