//! A stretch of predicted motion, driven through once in a world of any settings.
//!
//! The world starts at rest at a pose of the branch that is not singular, one joint variable is driven along the way by a
//! motor of limited torque, the other inputs are held, and at a few hundred moments the simulated poses are compared with the
//! predicted ones. Everything but the seconds on the clock depends on the mechanism and the settings alone.

use super::VerificationError;
use super::driven_way::{DrivenWay, RATE, value, ways_along};
use super::excitation::MOST_SPREAD;
use super::observer::{Moment, Observer, Passage};
use super::prediction::Prediction;
use super::verify::{VerificationOptions, largest_gap};
use crate::{Drive, Masses, World, WorldOptions, joint_gaps};
use kutzbach_closure::{Geometry, JointState, spanning_poses, variable_unit};
use kutzbach_mobility::{Analysis, Branch, Structure};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::Variable;
use std::time::{Duration, Instant};

/// Largest torque of a drive, in moments of inertia of the whole mechanism (mass × length²) per s². A mechanism of its own
/// size and mass comes to speed in a thirtieth of a second.
const EFFORT: f64 = 30.0;

/// Loads up to this, in masses of a typical link times the square of the characteristic length, are moved by that; for
/// more the torque grows in proportion, to a third of what would bring the load to its pace in a tenth of a second.
const LOAD: f64 = 10.0;

/// What holds an input gets ten times as much: it has to stand what the drive does.
const HOLDING_EFFORT: f64 = 300.0;

/// A drive comes to its pace over this time (s), smoothly: a jerk would excite the give of the joints.
const START_UP: f64 = 0.25;

/// A drive that is off its schedule, or an input off its place, is to be back in this time (s).
const CATCH_UP: f64 = 0.1;

/// While catching up, no drive is asked for more than this (rad/s, characteristic lengths per second). Where constraints
/// repeat one another the solver's sweeps do not come to an agreement, and a drive gets a fraction of what it asks for.
const FASTEST: f64 = 10.0 * RATE;

/// A drive gets so many times as long as its way takes before it counts as stalled.
const PATIENCE: f64 = 3.0;

/// So many moments of a passage are measured and shown, unless something else is wanted.
const MOMENTS: usize = 240;

/// A drive that has gone this share of its way has arrived.
const ALL_OF_IT: f64 = 0.999;

/// A stretch of a branch along which one driven variable determines all others, ready to be simulated.
pub struct DrivenMotion<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    /// That of the prediction, which may be another one where the prediction is false on purpose.
    predicted: &'a Geometry<f64>,
    structure: &'a Structure,
    branch: String,
    way: DrivenWay,
    /// Instantaneous freedom of the parts with loops at generic poses of the branch.
    freedom: usize,
    /// Characteristic length (m).
    length: f64,
    /// So many moments of a passage are measured and shown.
    moments: usize,
    masses: Masses,
}

/// What one simulation of a driven motion showed.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenRun {
    /// Largest gap of any joint at any moment (characteristic lengths, rad); NaN where the simulation came apart.
    pub closure_error: f64,
    /// Largest distance from the predicted motion (characteristic lengths, rad).
    pub distance: f64,
    /// How much of the way was gone.
    pub progress: f64,
    /// Largest torque or force of the drive (N m, N).
    pub largest_force: f64,
    /// Simulated seconds.
    pub time: f64,
    /// Steps taken.
    pub steps: usize,
    /// Whether the observer broke it off.
    pub stopped: bool,
    /// Seconds on the clock that the steps took, looking not counted.
    pub step_time: f64,
    /// Seconds on the clock in all.
    pub wall_time: f64,
}

impl<'a> DrivenMotion<'a> {
    /// The stretch to drive along a branch: along the part that has loops and moves and comes first, if any does; of the
    /// options, `configuration`, `drive` and `longest` count.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn first_along(
        mechanism: &'a Mechanism,
        geometry: &'a Geometry<f64>,
        analysis: &'a Analysis,
        branch: &Branch,
        options: &VerificationOptions,
    ) -> Result<Option<Self>, String> {
        let mut asked = 0;
        let mut first = |_: Option<&str>| {
            asked += 1;
            asked == 1
        };
        let motions =
            Self::along_those_wanted(mechanism, geometry, analysis, branch, options, &mut first)?;
        Ok(motions.into_iter().next())
    }

    /// The stretches to drive along a branch: one for each part of the mechanism that has loops and moves, or one in all.
    /// Each is asked for before it is traced, by the name of what drives it where that is known.
    ///
    /// # Errors
    /// As [`Self::first_along`].
    pub(super) fn along_those_wanted(
        mechanism: &'a Mechanism,
        geometry: &'a Geometry<f64>,
        analysis: &'a Analysis,
        branch: &Branch,
        options: &VerificationOptions,
        wanted: &mut dyn FnMut(Option<&str>) -> bool,
    ) -> Result<Vec<Self>, String> {
        let states = &analysis.assembly.states;
        let home = World::new(mechanism, geometry, states, &WorldOptions::default())
            .map_err(|error| error.to_string())?;
        let (length, _) = home.scale();
        let ways = ways_along(
            mechanism,
            geometry,
            (length, options.longest),
            analysis,
            branch,
            (options.configuration.as_deref(), options.drive.as_deref()),
            wanted,
        )?;
        let freedom = loop_freedom(mechanism, &analysis.structure, branch);
        let masses = match home.inertia_spread() > MOST_SPREAD {
            true => Masses::Alike,
            false => Masses::Stated,
        };
        Ok(ways
            .into_iter()
            .map(|way| Self {
                mechanism,
                geometry,
                predicted: &analysis.geometry,
                structure: &analysis.structure,
                branch: branch.name.clone(),
                way,
                freedom,
                length,
                moments: MOMENTS,
                masses,
            })
            .collect())
    }

    /// What is driven.
    #[must_use]
    pub fn driven(&self) -> &Variable {
        &self.way.driven
    }

    /// What is held where it starts.
    #[must_use]
    pub fn held(&self) -> &[Variable] {
        &self.way.held
    }

    /// Value of the driven variable at the start (rad, m).
    #[must_use]
    pub fn from(&self) -> f64 {
        self.way.from
    }

    /// And at the end.
    #[must_use]
    pub fn to(&self) -> f64 {
        self.way.to
    }

    /// The pose that it starts from, by joint.
    #[must_use]
    pub fn start(&self) -> &[JointState<f64>] {
        &self.way.start
    }

    /// Why it goes no farther.
    #[must_use]
    pub fn ends(&self) -> &str {
        &self.way.ends
    }

    /// Seconds that the drive takes: no joint goes faster than a radian, or a characteristic length, per second.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.way.duration() + 0.5 * START_UP
    }

    /// Characteristic length (m).
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Looks at so many moments, at least one. Each takes Newton's method and a rank, which for large mechanisms is more work
    /// than the steps between.
    #[must_use]
    pub fn looked_at(self, moments: usize) -> Self {
        Self {
            moments: moments.max(1),
            ..self
        }
    }

    /// So many moments of a passage are looked at.
    #[must_use]
    pub fn moments(&self) -> usize {
        self.moments
    }

    /// The masses it is simulated with.
    #[must_use]
    pub fn masses(&self) -> Masses {
        self.masses
    }

    /// With masses of one's choice.
    #[must_use]
    pub fn with_masses(self, masses: Masses) -> Self {
        Self { masses, ..self }
    }

    /// How far joints are open where the world stands at poses of the predicted motion, by joint values and without a drive: the largest
    /// gap in the world, and in the mechanism that the prediction was made for (characteristic lengths, rad). The second is what is left
    /// of a prediction's equations; the first is as small where its poses are poses of this world.
    ///
    /// # Errors
    /// [`VerificationError`] where no world can be made.
    pub(super) fn open_as_predicted(&self) -> Result<[f64; 2], VerificationError> {
        let options = WorldOptions::default();
        let (mechanism, predicted) = (self.mechanism, self.predicted);
        let mut largest = [0.0; 2];
        for pose in &self.way.poses {
            let world = World::with_masses(mechanism, self.geometry, pose, &options, self.masses)?;
            let links = spanning_poses(mechanism, predicted, pose).0;
            let own = joint_gaps(mechanism, predicted, &links);
            for (most, gaps) in largest.iter_mut().zip([world.gaps(), own]) {
                let gap = largest_gap(&gaps, self.length);
                // What is not a number must not pass for small.
                if !(gap <= *most) {
                    *most = gap;
                }
            }
        }
        Ok(largest)
    }

    /// By how much a drive has to be stronger than one that moves a mechanism of its own size and mass: a tree of forty
    /// links is more than that. One for all smaller ones, and for loops with their own masses: what is strong enough for
    /// anything bends a loop open.
    fn load(&self, world: &World) -> f64 {
        let loops = self.structure.parts.iter().any(|p| !p.cycles.is_empty());
        if loops && self.masses == Masses::Stated {
            return 1.0;
        }
        let joint = &self.mechanism.joints()[self.way.driven.joint];
        let frame = world.link_poses()[joint.predecessor.link.0]
            .compose(&self.geometry.sides[self.way.driven.joint][0]);
        (world.load_about(&frame.translation) / LOAD).max(1.0)
    }

    /// Goes the way once.
    ///
    /// # Errors
    /// [`VerificationError`] where no world can be made or numbers leave their range. That a simulation comes apart or stalls
    /// is a result.
    pub fn run(
        &self,
        options: &WorldOptions,
        observer: &mut dyn Observer,
    ) -> Result<DrivenRun, VerificationError> {
        let begun = Instant::now();
        let way = &self.way;
        let mut world = World::with_masses(
            self.mechanism,
            self.geometry,
            &way.start,
            options,
            self.masses,
        )?;
        let (_, effort) = world.scale();
        let effort = effort * self.load(&world);
        let unit = |input: &Variable| {
            let kind = self.mechanism.joints()[input.joint].kind;
            variable_unit(kind.freedoms()[input.freedom], self.length)
        };
        let drive = |world: &mut World, input: &Variable, velocity: f64, effort: f64| {
            let fastest = FASTEST * unit(input);
            world.drive(Drive {
                joint: input.joint,
                freedom: input.freedom,
                velocity: velocity.clamp(-fastest, fastest),
                largest_force: effort / unit(input),
            })
        };
        let places: Vec<f64> = way
            .held
            .iter()
            .map(|held| value(self.geometry, held, &way.start, &way.start))
            .collect();
        let travel = way.to - way.from;
        let duration = self.duration();
        let mut run = DrivenRun {
            closure_error: 0.0,
            distance: 0.0,
            progress: 0.0,
            largest_force: EFFORT * effort / unit(&way.driven),
            time: 0.0,
            steps: 0,
            stopped: observer.begin(&self.passage(options)).is_break(),
            step_time: 0.0,
            wall_time: 0.0,
        };
        let mut prediction = Prediction::new(
            self.mechanism,
            self.predicted,
            self.structure,
            &way.start,
            self.freedom,
            self.length,
        )?;
        let mut states = way.start.clone();
        let mut stepping = Duration::ZERO;
        let steps = (PATIENCE * duration / options.time_step).ceil() as usize;
        let every = ((duration / options.time_step) as usize / self.moments).max(1);
        for step in 1..=steps {
            if run.stopped || run.progress >= ALL_OF_IT {
                break;
            }
            let (place, rate) = way.target(pace(world.time() + options.time_step));
            let now = value(self.geometry, &way.driven, &way.start, &states);
            let velocity = rate + (place - now) / CATCH_UP;
            drive(&mut world, &way.driven, velocity, EFFORT * effort)?;
            for (held, place) in way.held.iter().zip(&places) {
                let off = value(self.geometry, held, &way.start, &states) - place;
                drive(&mut world, held, -off / CATCH_UP, HOLDING_EFFORT * effort)?;
            }
            let before = Instant::now();
            let sound = world.step().is_ok();
            stepping += before.elapsed();
            if !sound {
                run.closure_error = f64::NAN;
                break;
            }
            run.steps = step;
            states = world.states(&states);
            if step % every != 0 {
                continue;
            }
            prediction.follow(&states)?;
            let poses = world.link_poses();
            let gaps = world.gaps();
            let closure_error = largest_gap(&gaps, self.length);
            let distance = prediction.distance(&poses);
            run.progress =
                (value(self.geometry, &way.driven, &way.start, &states) - way.from) / travel;
            for (most, now) in [
                (&mut run.closure_error, closure_error),
                (&mut run.distance, distance),
            ] {
                // What is not a number must not pass for small.
                if !(now <= *most) {
                    *most = now;
                }
            }
            run.stopped = observer
                .moment(&Moment {
                    time: world.time(),
                    done: run.progress.clamp(0.0, 1.0),
                    simulated: &poses,
                    states: &states,
                    predicted: Some((prediction.poses(), prediction.states())),
                    gaps: &gaps,
                    closure_error,
                    distance,
                })
                .is_break();
        }
        run.time = run.steps as f64 * options.time_step;
        run.step_time = stepping.as_secs_f64();
        run.wall_time = begun.elapsed().as_secs_f64();
        Ok(run)
    }

    fn passage(&self, options: &WorldOptions) -> Passage {
        Passage {
            title: format!(
                "branch {}: `{}`, {} substeps",
                self.branch, self.way.driven.name, options.substeps
            ),
            branch: self.branch.clone(),
            driven: Some(self.way.driven.clone()),
            substeps: options.substeps,
            duration: self.duration(),
        }
    }
}

/// The time on the schedule at a time of the simulation: it starts from rest.
fn pace(time: f64) -> f64 {
    if time < START_UP {
        // The integral of the smooth step 3 x² − 2 x³.
        let x = time / START_UP;
        START_UP * (x.powi(3) - 0.5 * x.powi(4))
    } else {
        time - 0.5 * START_UP
    }
}

/// Instantaneous freedom of the parts with loops at a generic pose of the branch.
pub(super) fn loop_freedom(mechanism: &Mechanism, structure: &Structure, branch: &Branch) -> usize {
    let free: usize = structure
        .free_joints
        .iter()
        .map(|&j| mechanism.joints()[j].freedom())
        .sum();
    let all = branch.instantaneous.unwrap_or(branch.dimension);
    all.saturating_sub(free + 6 * structure.loose_pieces)
}
