//! How far a scene's motion is off: the same scene in halved steps.
//!
//! # The estimate
//! Let x(h) be the motion with steps of h, and x(h) − x = C hᵖ + … (Richardson 1911). Then x(h) − x(h/2) = (2ᵖ − 1) C (h/2)ᵖ, so that
//! the finer of two runs is off by their difference over 2ᵖ − 1, and the coarser by 2ᵖ times as much. Differences of three runs
//! tell p: the lesser of the last two that were seen. With two runs the coarser is told of by the integrator's own order, or as if p were 1 where an error is wanted, and the finer as if p
//! were 1. An error that is wanted takes three runs at least, and each run is off by no less than its distance from the finest. Where p comes out below
//! [`CONVERGES`], as after an impact that one run has and the other has not, the runs do not approach one another, and nothing is claimed.
//!
//! What is compared is all links at all moments that both runs show: poses (characteristic lengths, rad), and twists as a share of
//! the greatest. It is an estimate and no bound: where steps are so long that the first term does not lead, it may be off by a factor.

use super::accuracy::work_of_setting;
use super::scene_run::{Moves, Paces, Scene, Served, looks_in, passage_of, run_in, served};
use super::smooth::{Integrator, SINGULAR, SmoothWorld, goes_one_way};
use super::trail::Trail;
use super::verification::{Moment, Observer, Passage};
use super::{SceneOptions, SceneRun, WorldError, WorldOptions};
use kutzbach_closure::{Geometry, JointState};
use kutzbach_model::mechanism::Mechanism;
use serde::Serialize;
use std::ops::ControlFlow;

/// The least order that counts as one.
const CONVERGES: f64 = 0.5;

/// What is known of the order of an integrator: that which the coarser of two runs is taken to have until a third shows it, the highest
/// that is believed where it is seen once (impacts of the engine may show any), and the highest that is believed.
const fn orders(integrator: Integrator) -> [f64; 3] {
    match integrator {
        Integrator::RungeKutta => [5.0, 5.0, 5.0],
        Integrator::Engine => [1.0, 1.0, 2.0],
    }
}

/// An order that is higher than the highest by more than this is no order.
const BY_CHANCE: f64 = 2.0;

/// Differences of this size are rounding, which shorter steps do not make smaller (characteristic lengths, rad, shares).
const ROUNDING: f64 = 1e-10;

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
    /// Its size in parts of the greatest kinetic energy, where nothing takes energy or gives it.
    pub energy_error: Option<f64>,
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
/// error is wanted, with steps halved until it is reached or the work is done. The observer is shown the run that is told of: while it
/// goes on where it is known to be that, and else when it is chosen. No run is made twice.
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
    let scene = Scene {
        mechanism,
        geometry,
        start,
        options,
    };
    let ((mut run, trajectory), because) =
        served(mechanism, options, &mut |integrator, because| {
            let settled = integrator == Integrator::RungeKutta
                || !because.contains(&SINGULAR) && goes_one_way(&scene)?;
            let halving = Halving {
                scene,
                integrator,
                settled,
            };
            halving.estimated(refinement, interrupted, observer)
        })?;
    run.engine_because = because;
    Ok((run, trajectory))
}

impl Halving<'_> {
    fn estimated(
        &self,
        refinement: Refinement,
        interrupted: &dyn Fn() -> bool,
        observer: &mut dyn Observer,
    ) -> Result<Served<(SceneRun, Trajectory)>, WorldError> {
        let each = match self.work()? {
            Ok(work) => self.scene.options.duration * work,
            Err(serving) => return Ok(Err(serving)),
        };
        let mut trajectory = Trajectory::begun(refinement.wanted);
        // The finest: no other is told of.
        let mut finest: Vec<(SceneRun, Trail)> = Vec::new();
        let mut differences: Vec<TrajectoryError> = Vec::new();
        let mut left = refinement.work;
        // Without an error wanted the engine's first run is told of, so that it is shown while it goes on; else the trail that is chosen is.
        let at_once = refinement.wanted.is_none() && self.integrator == Integrator::Engine;
        // Halvings that led nowhere, and why the last of them did.
        let (mut skipped, mut nowhere) = (0, None);
        for halvings in 0..MOST_HALVINGS {
            let work = each * f64::from(1 << halvings);
            if halvings > 0 && work > left {
                break;
            }
            left -= work;
            let mut quiet = Quiet(interrupted);
            let watching: &mut dyn Observer = match at_once && halvings == 0 {
                true => &mut *observer,
                false => &mut quiet,
            };
            let (run, trail) = match self.run(halvings, watching)? {
                Ok(done) => done,
                // A long step may lead where no short one does.
                Err(serving) if self.is_long(halvings) => {
                    nowhere = Some(serving);
                    trajectory.rows.clear();
                    finest.clear();
                    differences.clear();
                    skipped = halvings + 1;
                    continue;
                }
                Err(serving) => return Ok(Err(serving)),
            };
            if interrupted() && halvings > 0 {
                break;
            }
            if let Some((_, before)) = finest.last() {
                differences.push(trail.apart(before, &self.scene));
            }
            trajectory.rows.push(StepRow::of(&run));
            if finest.len() == KEPT {
                finest.remove(0);
            }
            finest.push((run, trail));
            trajectory.estimate(&differences, self.integrator);
            if !self.settled || trajectory.is_enough() || interrupted() {
                break;
            }
        }
        if let Some(serving) = nowhere.filter(|_| trajectory.rows.is_empty()) {
            return Ok(Err(serving));
        }
        trajectory.conclude(each * f64::from(1 << skipped), self.integrator);
        if !self.settled {
            trajectory.not_estimated =
                Some(format!("at {}, {}", SINGULAR.effect, SINGULAR.because));
        }
        let from_last = trajectory.rows.len().saturating_sub(1 + trajectory.used);
        let told = finest.len().checked_sub(1 + from_last);
        let over_time = told.map(|told| self.error_over_time(&finest, told, &trajectory));
        let told = told.map(|told| finest.swap_remove(told));
        let (run, trail) = told.ok_or_else(|| WorldError::Options("no run was made".to_owned()))?;
        if !at_once {
            trail.show(
                &passage_of(self.scene.mechanism, self.scene.options),
                observer,
            );
        }
        if let Some(over_time) = over_time.filter(|over_time| !over_time.is_empty()) {
            // All has been shown: nothing is left to be broken off.
            let _ = observer.estimated(&over_time);
        }
        Ok(Ok((run, trajectory)))
    }

    /// The error of one of the finest runs at each moment, by the next run, or by the one before where it is the last; nothing where it
    /// is not known.
    fn error_over_time(
        &self,
        finest: &[(SceneRun, Trail)],
        told: usize,
        trajectory: &Trajectory,
    ) -> Vec<(f64, f64)> {
        let other = finest
            .get(told + 1)
            .or_else(|| finest.get(told.checked_sub(1)?));
        let pair = finest.get(told).zip(other).zip(trajectory.error());
        pair.map_or(Vec::new(), |(((_, own), (_, other)), error)| {
            own.error_over_time(other, error.worst, &self.scene)
        })
    }

    /// Whether steps halved so often are still longer than the time between two moments.
    fn is_long(&self, halvings: u32) -> bool {
        let step = self.scene.options.runge_kutta_step;
        self.integrator == Integrator::RungeKutta && looks_in(step).trailing_zeros() > halvings
    }

    /// About how many seconds of work a simulated second takes in the first steps.
    fn work(&self) -> Result<Served<f64>, WorldError> {
        let Scene {
            mechanism,
            geometry,
            start,
            options,
        } = self.scene;
        Ok(match self.integrator {
            Integrator::RungeKutta => SmoothWorld::new(mechanism, geometry, start, options)?
                .map(|world| world.seconds_per_second()),
            Integrator::Engine => Ok(work_of_setting(mechanism, geometry, start, &options.world)?),
        })
    }
}

/// Runs that are kept to be told of.
const KEPT: usize = 3;

/// Steps are halved so often at most.
const MOST_HALVINGS: u32 = 20;

/// Fills in what differences tell: of each run but the first from the difference before it, of the first from that after it. Until a third
/// run shows the order, the finer of two runs is given no more credit than a method of first order has, and the coarser as much as is assumed.
fn estimate(
    rows: &mut [StepRow],
    differences: &[TrajectoryError],
    [assumed, once, highest]: [f64; 3],
) {
    let mut orders = (1.0, assumed);
    for (index, apart) in differences.iter().enumerate() {
        let seen = index
            .checked_sub(1)
            .map(|before| (differences[before].worst / apart.worst).log2())
            .filter(|order| order.is_finite());
        rows[index + 1].order = seen;
        let rounding = apart.largest() <= ROUNDING;
        if let Some(seen) = seen {
            // Where a difference collapses the one before was none of steps that are short enough, and tells nothing of the next.
            let believed = if seen > highest + BY_CHANCE {
                1.0
            } else {
                seen
            };
            // An order that was not seen before may be chance.
            let most = rows[index]
                .order
                .map_or(once, |before| before.clamp(0.0, highest));
            let order = believed
                .clamp(0.0, most)
                .max(if rounding { 1.0 } else { 0.0 });
            orders = (order, order);
        }
        let [finer, coarser] = [orders.0, orders.1].map(|order| f64::powf(2.0, order));
        // What is exact in both runs is off by nothing.
        let known = apart.largest().is_finite() && (orders.0 >= CONVERGES || apart.worst == 0.0);
        rows[index + 1].error = known.then(|| apart.times(1.0 / (finer - 1.0)));
        rows[index].error = known.then(|| apart.times(coarser / (coarser - 1.0)));
    }
}

impl StepRow {
    fn of(run: &SceneRun) -> Self {
        Self {
            time_step: run.time_step,
            error: None,
            order: None,
            energy_change: run.energy_change,
            energy_error: run.energy_error(),
            closure_error: run.closure_error,
            step_time: run.step_time,
        }
    }

    fn is_within(&self, wanted: f64) -> bool {
        let off = self.error.as_ref().map(TrajectoryError::largest);
        // A speed that is off by a share takes energy off by twice that.
        let kept = self.energy_error.is_none_or(|off| off <= 2.0 * wanted);
        off.is_some_and(|off| off <= wanted) && self.closure_error <= wanted && kept
    }
}

impl Trajectory {
    fn begun(wanted: Option<f64>) -> Self {
        Self {
            rows: Vec::new(),
            used: 0,
            wanted,
            reached: None,
            needed: None,
            not_estimated: None,
        }
    }

    /// Where an error is wanted, steps begin too long for their order to be taken for granted: it has to be seen.
    fn estimate(&mut self, differences: &[TrajectoryError], integrator: Integrator) {
        let mut orders = orders(integrator);
        if self.wanted.is_some() {
            orders[0] = 1.0;
        }
        estimate(&mut self.rows, differences, orders);
        // A run is off by no less than it is from the finest, which steps that are too long may agree with one another not to tell.
        for (index, row) in self.rows.iter_mut().enumerate() {
            let apart = differences.iter().skip(index);
            if let Some(error) = &mut row.error {
                let [worst, end, speed] = apart.fold([0.0; 3], |[worst, end, speed], apart| {
                    [worst + apart.worst, end + apart.end, speed + apart.speed]
                });
                error.worst = error.worst.max(worst);
                error.end = error.end.max(end);
                error.speed = error.speed.max(speed);
            }
        }
    }

    /// Whether no further run is needed.
    fn is_enough(&self) -> bool {
        match (self.wanted, self.rows.last()) {
            (None, _) => self.rows.len() == 2,
            (Some(_), _) if self.rows.len() < 3 => false,
            (Some(wanted), last) => last.is_some_and(|row| row.is_within(wanted)),
        }
    }

    /// Which run is told of, and what the error wanted would cost.
    fn conclude(&mut self, each: f64, integrator: Integrator) {
        if let Some(wanted) = self.wanted {
            self.choose(wanted, each, integrator);
        }
        if self.error().is_none() {
            self.not_estimated = Some(match self.rows.len() {
                0 | 1 => "a second run would take too long".to_owned(),
                _ => "the runs in halved steps do not approach one another".to_owned(),
            });
        }
    }

    fn choose(&mut self, wanted: f64, each: f64, integrator: Integrator) {
        let [assumed, _, highest] = orders(integrator);
        let within = |row: &StepRow| row.is_within(wanted);
        let last = self.rows.len().saturating_sub(1);
        let first = self.rows.iter().position(within).unwrap_or(last);
        self.used = first.max(self.rows.len().saturating_sub(KEPT));
        let used = self.rows.get(self.used);
        self.reached = Some(used.is_some_and(within));
        if self.reached == Some(false)
            && let Some(row) = used
            && let Some(error) = &row.error
        {
            let order = row.order.unwrap_or(assumed).clamp(CONVERGES, highest);
            let shorter = (error.largest().max(row.closure_error) / wanted).powf(1.0 / order);
            self.needed = Some(each * f64::from(1 << self.used) * shorter.max(1.0));
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
    scene: Scene<'a>,
    integrator: Integrator,
    /// Whether the equations say which way the motion goes: where they do not, runs agree or differ by chance.
    settled: bool,
}

impl Halving<'_> {
    /// A run, and what was to be seen of it.
    fn run(
        &self,
        halvings: u32,
        observer: &mut dyn Observer,
    ) -> Result<Served<(SceneRun, Trail)>, WorldError> {
        let given = self.scene.options;
        let finer = f64::from(1u32 << halvings);
        let options = SceneOptions {
            world: WorldOptions {
                time_step: given.world.time_step / finer,
                ..given.world
            },
            runge_kutta_step: given.runge_kutta_step / finer,
            ..given.clone()
        };
        let first = Paces::of(given, self.integrator);
        let paces = first.halved(given, self.integrator, halvings);
        let scene = Scene {
            options: &options,
            ..self.scene
        };
        let mut trail = Trail::default();
        let look = &mut |world: &dyn Moves, moment: &Moment<'_>| trail.keep(world, moment);
        let run = run_in(&scene, self.integrator, paces, observer, look)?;
        Ok(run.map(|run| (run, trail)))
    }
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
#[path = "trajectory_tests.rs"]
mod tests;
