//! How far a scene's motion is off: the same scene in halved steps.
//!
//! # The estimate
//! Let x(h) be the motion with steps of h, and x(h) − x = C hᵖ + … (Richardson 1911). Then x(h) − x(h/2) = (2ᵖ − 1) C (h/2)ᵖ, so that
//! the finer of two runs is off by their difference over 2ᵖ − 1, and the coarser by 2ᵖ times as much. Differences of three runs
//! tell p; with two it is taken as 1, which is that of the engine's steps. Where p comes out below [`CONVERGES`], as after an
//! impact that one run has and the other has not, the runs do not approach one another, and nothing is claimed.
//!
//! What is compared is all links at all moments that both runs show: poses (characteristic lengths, rad), and twists as a share of
//! the greatest. It is an estimate and no bound: where steps are so long that the first term does not lead, it may be off by a factor.

use super::accuracy::work_of_setting;
use super::scene_run::{Paces, run_in};
use super::verification::{Moment, Observer, Passage, distance_between};
use super::{SceneOptions, SceneRun, World, WorldError, WorldOptions};
use kutzbach_closure::{Geometry, JointState, Rigid};
use kutzbach_model::mechanism::Mechanism;
use serde::Serialize;
use std::ops::ControlFlow;

/// The least order that counts as one.
const CONVERGES: f64 = 0.5;

/// The highest order that is believed: that of a symmetric step. What seems higher is chance.
const HIGHEST: f64 = 2.0;

/// How far a run is off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TrajectoryError {
    /// Poses of links at the worst moment (characteristic lengths, rad).
    pub worst: f64,
    /// Poses of links at the end (characteristic lengths, rad).
    pub end: f64,
    /// Twists of links at the worst moment, in parts of the greatest.
    pub speed: f64,
}

impl TrajectoryError {
    /// The largest of the three.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.worst.max(self.end).max(self.speed)
    }

    fn times(self, factor: f64) -> Self {
        Self {
            worst: factor * self.worst,
            end: factor * self.end,
            speed: factor * self.speed,
        }
    }
}

/// The scene with steps of one length.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StepRow {
    /// Length of a step (s).
    pub time_step: f64,
    /// About how far the motion is off; `None` where the runs do not approach one another, or one of them ended early.
    pub error: Option<TrajectoryError>,
    /// The order in the step that the difference from the run before shows, beside the difference before.
    pub order: Option<f64>,
    /// Energy at the end less that at the start (J).
    pub energy_change: f64,
    /// Largest gap of any joint (characteristic lengths, rad).
    pub closure_error: f64,
    /// Seconds on the clock that the steps took.
    #[serde(skip)]
    pub step_time: f64,
}

/// What halved steps tell of a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trajectory {
    /// By falling step.
    pub rows: Vec<StepRow>,
    /// Which of them is the run that is told of.
    pub used: usize,
    /// The error wanted, if any: of poses, of speeds and of closure.
    pub wanted: Option<f64>,
    /// Whether the run that is told of stays within it.
    pub reached: Option<bool>,
    /// About how many seconds of work would reach it, by the order seen, where it was not reached.
    pub needed: Option<f64>,
    /// Why there is no estimate.
    pub not_estimated: Option<String>,
}

/// How far to go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinement {
    /// The error wanted; `None` for an estimate only.
    pub wanted: Option<f64>,
    /// Seconds of work, by the model of work and not by the clock, that all runs together may take.
    pub work: f64,
}

/// Runs a scene from a closed pose, at rest, and estimates how far its motion is off: with one more run in half the step, or, where an
/// error is wanted, with steps halved until it is reached or the work is done. The run that is told of is shown to the observer.
///
/// # Errors
/// As [`run_scene`](super::run_scene).
///
/// `interrupted` is asked between moments of the runs that are not shown.
pub fn run_scene_estimated(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    start: &[JointState<f64>],
    options: &SceneOptions,
    (refinement, interrupted): (Refinement, &dyn Fn() -> bool),
    observer: &mut dyn Observer,
) -> Result<(SceneRun, Trajectory), WorldError> {
    let scene = Halving {
        mechanism,
        geometry,
        start,
        options,
        first: Paces::of(options),
    };
    let each = options.duration * work_of_setting(mechanism, geometry, start, &options.world)?;
    let mut trajectory = Trajectory {
        rows: Vec::new(),
        used: 0,
        wanted: refinement.wanted,
        reached: None,
        needed: None,
        not_estimated: None,
    };
    let mut trails: Vec<Trail> = Vec::new();
    let mut differences: Vec<TrajectoryError> = Vec::new();
    let mut left = refinement.work;
    for halvings in 0..MOST_HALVINGS {
        let work = each * f64::from(1 << halvings);
        // The run that is told of is run once more, for whoever watches.
        if halvings > 0 && work * 2.0 > left {
            break;
        }
        left -= work;
        let Some((row, trail)) = scene.quietly(halvings, interrupted)? else {
            break;
        };
        if let Some(before) = trails.last() {
            differences.push(trail.apart(before, &scene));
        }
        trajectory.rows.push(row);
        trails.push(trail);
        estimate(&mut trajectory.rows, &differences);
        let enough = match refinement.wanted {
            None => halvings == 1,
            Some(wanted) => trajectory
                .rows
                .last()
                .is_some_and(|row| row.is_within(wanted)),
        };
        if enough {
            break;
        }
    }
    trajectory.conclude(each);
    let run = scene.shown(trajectory.used as u32, observer)?;
    Ok((run, trajectory))
}

/// Steps are halved so often at most.
const MOST_HALVINGS: u32 = 20;

/// Fills in what differences tell: of each run but the first from the difference before it, of the first from that after it.
fn estimate(rows: &mut [StepRow], differences: &[TrajectoryError]) {
    let mut order = 1.0;
    for (index, apart) in differences.iter().enumerate() {
        let seen = index
            .checked_sub(1)
            .map(|before| (differences[before].worst / apart.worst).log2())
            .filter(|order| order.is_finite());
        rows[index + 1].order = seen;
        order = seen.map_or(order, |seen: f64| seen.clamp(0.0, HIGHEST));
        let ratio = f64::powf(2.0, order);
        // What is exact in both runs is off by nothing.
        let known = apart.largest().is_finite() && (order >= CONVERGES || apart.worst == 0.0);
        let finer = known.then(|| apart.times(1.0 / (ratio - 1.0)));
        rows[index + 1].error = finer;
        rows[index].error = finer.map(|finer| finer.times(ratio));
    }
}

impl StepRow {
    fn is_within(&self, wanted: f64) -> bool {
        let off = self.error.as_ref().map(TrajectoryError::largest);
        off.is_some_and(|off| off <= wanted) && self.closure_error <= wanted
    }
}

impl Trajectory {
    /// Which run is told of, and what the error wanted would cost.
    fn conclude(&mut self, each: f64) {
        let Some(wanted) = self.wanted else {
            if self.rows.len() < 2 {
                self.not_estimated = Some("a second run would take too long".to_owned());
            }
            return;
        };
        let within = |row: &StepRow| row.is_within(wanted);
        let last = self.rows.len().saturating_sub(1);
        self.used = self.rows.iter().position(within).unwrap_or(last);
        let used = self.rows.get(self.used);
        self.reached = Some(used.is_some_and(within));
        if self.reached == Some(false)
            && let Some(row) = used
            && let Some(error) = &row.error
        {
            let order = row.order.unwrap_or(1.0).clamp(CONVERGES, HIGHEST);
            let shorter = (error.largest().max(row.closure_error) / wanted).powf(1.0 / order);
            self.needed = Some(each * f64::from(1 << self.used) * shorter.max(1.0));
        }
        if used.is_none_or(|row| row.error.is_none()) {
            self.not_estimated = Some(match self.rows.len() {
                0 | 1 => "a second run would take too long".to_owned(),
                _ => "the runs in halved steps do not approach one another".to_owned(),
            });
        }
    }

    /// About how far the run that is told of is off.
    #[must_use]
    pub fn error(&self) -> Option<TrajectoryError> {
        self.rows.get(self.used)?.error
    }
}

/// A scene, to be run in halved steps.
struct Halving<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    start: &'a [JointState<f64>],
    options: &'a SceneOptions,
    first: Paces,
}

/// Poses and twists of all links at the moments shown.
struct Trail {
    poses: Vec<Vec<Rigid<f64>>>,
    twists: Vec<Vec<[f64; 6]>>,
    length: f64,
}

impl Halving<'_> {
    fn of(&self, halvings: u32) -> (SceneOptions, Paces) {
        let finer = f64::from(1u32 << halvings);
        let world = WorldOptions {
            time_step: self.options.world.time_step / finer,
            ..self.options.world
        };
        let paces = Paces {
            steps: self.first.steps << halvings,
            every: self.first.every << halvings,
        };
        let options = SceneOptions {
            world,
            ..self.options.clone()
        };
        (options, paces)
    }

    /// A run that is not shown; `None` where it was broken off.
    fn quietly(
        &self,
        halvings: u32,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<Option<(StepRow, Trail)>, WorldError> {
        let (options, paces) = self.of(halvings);
        let mut trail = Trail {
            poses: Vec::new(),
            twists: Vec::new(),
            length: 1.0,
        };
        let mut quiet = Quiet(interrupted);
        let look = &mut |world: &World| {
            trail.poses.push(world.link_poses());
            trail.twists.push(world.link_twists());
            trail.length = world.scale().0;
        };
        let run = run_in(
            self.mechanism,
            self.geometry,
            self.start,
            &options,
            paces,
            &mut quiet,
            look,
        )?;
        let row = StepRow {
            time_step: options.world.time_step,
            error: None,
            order: None,
            energy_change: run.energy_change,
            closure_error: run.closure_error,
            step_time: run.step_time,
        };
        Ok((!interrupted()).then_some((row, trail)))
    }

    /// A run for whoever watches.
    fn shown(&self, halvings: u32, observer: &mut dyn Observer) -> Result<SceneRun, WorldError> {
        let (options, paces) = self.of(halvings);
        run_in(
            self.mechanism,
            self.geometry,
            self.start,
            &options,
            paces,
            observer,
            &mut |_| (),
        )
    }
}

impl Trail {
    /// The largest differences from a coarser run; infinite where one ended before the other.
    fn apart(&self, coarse: &Self, scene: &Halving<'_>) -> TrajectoryError {
        if self.poses.len() != coarse.poses.len() {
            return TrajectoryError {
                worst: f64::INFINITY,
                end: f64::INFINITY,
                speed: f64::INFINITY,
            };
        }
        let pairs = self.poses.iter().zip(&coarse.poses);
        let apart: Vec<f64> = pairs
            .map(|(fine, coarse)| {
                distance_between(scene.mechanism, scene.geometry, fine, coarse, self.length)
            })
            .collect();
        let greatest = |less: Option<&Self>| {
            let mut most = 0.0f64;
            for (moment, poses) in self.poses.iter().enumerate() {
                for link in 0..poses.len() {
                    let own = self.speeds(moment, link);
                    let less = less.map_or([0.0; 6], |less| less.speeds(moment, link));
                    let apart: [f64; 6] = std::array::from_fn(|i| own[i] - less[i]);
                    let (turning, sliding) = apart.split_at(3);
                    most = most.max(norm(turning)).max(norm(sliding));
                }
            }
            most
        };
        let (fastest, changed) = (greatest(None), greatest(Some(coarse)));
        TrajectoryError {
            worst: apart.iter().copied().fold(0.0, f64::max),
            end: apart.last().copied().unwrap_or(0.0),
            speed: if changed > 0.0 {
                changed / fastest
            } else {
                0.0
            },
        }
    }

    /// Angular velocity (rad/s) and velocity of the link's own origin (characteristic lengths per second).
    fn speeds(&self, moment: usize, link: usize) -> [f64; 6] {
        let [a, b, c, u, v, w] = self.twists[moment][link];
        let [x, y, z] = self.poses[moment][link].translation;
        let own = [u + b * z - c * y, v + c * x - a * z, w + a * y - b * x];
        let [u, v, w] = own.map(|speed| speed / self.length);
        [a, b, c, u, v, w]
    }
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Shows nothing, and asks whether to go on.
struct Quiet<'a>(&'a dyn Fn() -> bool);

impl Quiet<'_> {
    fn flow(&self) -> ControlFlow<()> {
        match (self.0)() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}

impl Observer for Quiet<'_> {
    fn begin(&mut self, _: &Passage) -> ControlFlow<()> {
        self.flow()
    }

    fn moment(&mut self, _: &Moment<'_>) -> ControlFlow<()> {
        self.flow()
    }
}
