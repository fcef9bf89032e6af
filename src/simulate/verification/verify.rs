//! What a simulation says about a prediction.
//!
//! A prediction that something moves is put to the test branch by branch. The world starts at rest at a pose of the branch
//! that is not singular, one joint is driven along it by a motor of limited torque, the other inputs are held, and the
//! same is done over with finer and finer substeps until the ladder of errors decides ([`super::judge_motion`]). At a
//! generic pose blows at random count the freedoms ([`super::count_freedoms`]). A prediction that nothing moves is put to
//! the test by pushing every joint ([`super::Pushing`]). What is undecided or does not assemble is not simulated.
//!
//! None of it is a proof: it is evidence from physics that knows nothing of the analysis, and it is stated with the size
//! of the defect that it could have missed.

use super::driven_way::{DrivenWay, RATE, value, ways_along};
use super::ladder::{Finding, Outcome, Rung, judge_motion, order_between, undecided};
use super::observer::{Moment, Observer, Passage};
use super::prediction::Prediction;
use super::pushing::{Pushed, Pushing};
use super::{FreedomCount, VerificationError, count_freedoms};
use crate::closure::{Geometry, variable_unit};
use crate::mechanism::Mechanism;
use crate::mobility::{Analysis, Branch, Verdict};
use crate::motion::Variable;
use crate::simulate::{Drive, JointGap, Solver, World, WorldOptions};
use serde::Serialize;

/// How to verify.
#[derive(Clone, Debug, PartialEq)]
pub struct VerificationOptions {
    /// Only this branch; all if `None`.
    pub branch: Option<String>,
    /// The configuration that was analysed; the home pose if `None`.
    pub configuration: Option<String>,
    /// Name of the variable to drive; one that serves if `None`.
    pub drive: Option<String>,
    /// How trees are held, in the order of trying: the next one is tried where the one before does not confirm.
    pub solvers: Vec<Solver>,
    /// Length of a step (s).
    pub time_step: f64,
    /// Substeps of a step, ascending: the rungs.
    pub ladder: Vec<usize>,
    /// Seed of the blows that count freedoms.
    pub seed: u64,
    /// Whether to go on to the end of the ladder after it has decided.
    pub whole_ladder: bool,
    /// Longest way that a drive goes along a branch, in seconds at a pace of a radian per second for the fastest joint.
    pub longest: f64,
}

impl Default for VerificationOptions {
    /// Steps of 1/60 s with 4 to 256 substeps up to the rung that decides, trees first as multibodies, then by impulses.
    fn default() -> Self {
        Self {
            branch: None,
            configuration: None,
            drive: None,
            solvers: vec![Solver::Multibody, Solver::Impulse],
            time_step: 1.0 / 60.0,
            ladder: vec![4, 8, 16, 32, 64, 128, 256],
            seed: 1,
            whole_ladder: false,
            longest: 10.0,
        }
    }
}

/// One way along a branch, simulated with one solver.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ladder {
    /// How trees were held.
    pub solver: Solver,
    /// Name of the variable that is driven.
    pub driven: String,
    /// Where the drive starts and where it goes (rad, m).
    pub from: f64,
    /// See [`Self::from`].
    pub to: f64,
    /// Why it goes no farther.
    pub ends: String,
    /// Names of the variables that are held.
    pub held: Vec<String>,
    /// Largest torque or force of the drive (N m, N).
    pub largest_force: f64,
    /// The rungs, coarse to fine.
    pub rungs: Vec<Rung>,
    /// What they say.
    pub finding: Finding,
}

/// What simulation says about one branch.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BranchVerification {
    /// The branch's name.
    pub branch: String,
    /// Its predicted dimension.
    pub dimension: usize,
    /// What was simulated.
    pub ladders: Vec<Ladder>,
    /// The freedoms counted at a generic pose; `None` where none was at hand.
    pub freedoms: Option<FreedomCount>,
    /// What follows of all that.
    pub finding: Finding,
}

/// What simulation says about the whole prediction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verification {
    /// What was predicted.
    pub verdict: Verdict,
    /// The branches simulated.
    pub branches: Vec<BranchVerification>,
    /// The pushes, where rigidity was predicted.
    pub pushing: Option<Pushing>,
    /// The outcome.
    pub finding: Finding,
    /// Whether an observer broke it off.
    pub stopped: bool,
    /// What a reader has to know of how the worlds were made.
    pub notes: Vec<String>,
}

/// Largest torque of a drive, in moments of inertia of the whole mechanism (mass × length²) per s². A mechanism of its own
/// size and mass comes to speed in a thirtieth of a second.
const EFFORT: f64 = 30.0;

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

/// So many moments of a passage are measured and shown.
const MOMENTS: usize = 240;

/// The largest gap: distances in characteristic lengths, angles in rad.
#[must_use]
pub fn largest_gap(gaps: &[JointGap], length: f64) -> f64 {
    gaps.iter().fold(0.0, |largest: f64, gap| {
        let here = (gap.position / length).max(gap.angle);
        // What is not a number must not pass for small.
        if here <= largest { largest } else { here }
    })
}

/// Puts a prediction to the test.
///
/// # Errors
/// [`VerificationError`] where no world can be made, or a branch asked for does not exist.
pub fn verify(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    analysis: &Analysis,
    options: &VerificationOptions,
    observer: &mut dyn Observer,
) -> Result<Verification, VerificationError> {
    let mut verification = Verification {
        verdict: analysis.mobility.verdict,
        branches: Vec::new(),
        pushing: None,
        finding: Finding::new(Outcome::Inconclusive, String::new()),
        stopped: false,
        notes: Vec::new(),
    };
    let unpredicted = match analysis.mobility.verdict {
        Verdict::Unassembled => Some("it does not assemble: there is no pose to simulate"),
        Verdict::Undecided => Some("the mobility is undecided: nothing is predicted"),
        Verdict::Mobile | Verdict::Rigid => None,
    };
    if let Some(why) = unpredicted {
        verification.finding.why = why.to_owned();
        return Ok(verification);
    }
    let branches = analysis.branches.as_deref().unwrap_or_default();
    let chosen = chosen(branches, options.branch.as_deref())?;
    let home = World::new(
        mechanism,
        geometry,
        &analysis.assembly.states,
        &WorldOptions {
            solver: options.solvers.first().copied().unwrap_or_default(),
            ..WorldOptions::default()
        },
    )?;
    let (length, _) = home.scale();
    verification.notes = home
        .notes()
        .iter()
        .map(|note| format!("{}: {}", note.about, note.text))
        .collect();
    if !home.not_simulated().is_empty() {
        verification.finding.why = format!(
            "the engine cannot hold {}: what it would simulate is another mechanism",
            home.not_simulated().join(", ")
        );
        return Ok(verification);
    }
    if analysis.mobility.verdict == Verdict::Rigid {
        verify_rigid(mechanism, geometry, analysis, options, length, observer)
            .map(|pushing| verification.with_pushing(pushing))
    } else {
        let test = Test {
            mechanism,
            geometry,
            analysis,
            options,
            length,
        };
        for branch in chosen {
            let (found, stopped) = test.branch(branch, observer)?;
            verification.branches.push(found);
            if stopped {
                verification.stopped = true;
                break;
            }
        }
        verification.finding = together(&verification.branches, verification.stopped);
        Ok(verification)
    }
}

/// Pushes with one solver after the other until one shows that nothing moves; `None` where there is none to push with.
fn verify_rigid(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    analysis: &Analysis,
    options: &VerificationOptions,
    length: f64,
    observer: &mut dyn Observer,
) -> Result<Option<Pushing>, VerificationError> {
    let mut first = None;
    for &solver in &options.solvers {
        let pushed = Pushed {
            mechanism,
            geometry,
            states: &analysis.assembly.states,
            solver,
            time_step: options.time_step,
            ladder: &options.ladder,
            length,
        };
        let pushing = pushed.push_all(observer)?;
        if pushing.stopped || pushing.finding.outcome == Outcome::Confirmed {
            return Ok(Some(pushing));
        }
        first.get_or_insert(pushing);
    }
    Ok(first)
}

impl Verification {
    fn with_pushing(mut self, pushing: Option<Pushing>) -> Self {
        match &pushing {
            Some(pushing) => {
                let why = format!("predicted rigid: {}", pushing.finding.why);
                self.finding = Finding::new(pushing.finding.outcome, why);
                self.stopped = pushing.stopped;
            }
            None => self.finding.why = "no solver to simulate with was given".to_owned(),
        }
        self.pushing = pushing;
        self
    }
}

fn chosen<'a>(
    branches: &'a [Branch],
    name: Option<&str>,
) -> Result<Vec<&'a Branch>, VerificationError> {
    let Some(name) = name else {
        return Ok(branches.iter().collect());
    };
    match branches.iter().find(|b| b.name == name) {
        Some(branch) => Ok(vec![branch]),
        None => Err(VerificationError::UnknownBranch {
            name: name.to_owned(),
            known: match branches {
                [] => "none".to_owned(),
                several => {
                    let names: Vec<&str> = several.iter().map(|b| b.name.as_str()).collect();
                    names.join(", ")
                }
            },
        }),
    }
}

/// The outcome of all branches: confirmed only where each is.
fn together(branches: &[BranchVerification], stopped: bool) -> Finding {
    for outcome in [Outcome::Contradicted, Outcome::Inconclusive] {
        if let Some(branch) = branches.iter().find(|b| b.finding.outcome == outcome) {
            return Finding::new(
                outcome,
                format!("branch {}: {}", branch.branch, branch.finding.why),
            );
        }
    }
    match branches {
        _ if stopped => Finding::new(Outcome::Inconclusive, "broken off before the end"),
        [] => Finding::new(
            Outcome::Inconclusive,
            "the branches through the pose are not listed: none was simulated",
        ),
        [only] => only.finding.clone(),
        several => Finding::new(
            Outcome::Confirmed,
            format!("each of the {} branches was followed", several.len()),
        ),
    }
}

/// The outcome of one way, from the solvers tried: one that confirms is enough, since a solver can fail to move what moves
/// but not close what does not fit; a contradiction has to come from all of them.
fn of_one_way(ladders: &[Ladder]) -> Finding {
    let with = |outcome| ladders.iter().find(|l| l.finding.outcome == outcome);
    let found = with(Outcome::Confirmed)
        .or_else(|| with(Outcome::Inconclusive))
        .or_else(|| ladders.last());
    found.map_or_else(|| undecided(&[]), |ladder| ladder.finding.clone())
}

struct Test<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    analysis: &'a Analysis,
    options: &'a VerificationOptions,
    length: f64,
}

impl Test<'_> {
    /// Tests one branch; also whether an observer broke it off.
    fn branch(
        &self,
        branch: &Branch,
        observer: &mut dyn Observer,
    ) -> Result<(BranchVerification, bool), VerificationError> {
        let mut found = BranchVerification {
            branch: branch.name.clone(),
            dimension: branch.dimension,
            ladders: Vec::new(),
            freedoms: None,
            finding: Finding::new(Outcome::Inconclusive, String::new()),
        };
        let ways = match ways_along(
            self.mechanism,
            self.geometry,
            (self.length, self.options.longest),
            self.analysis,
            branch,
            self.options.configuration.as_deref(),
            self.options.drive.as_deref(),
        ) {
            Ok(ways) => ways,
            Err(why) => {
                found.finding.why = why;
                return Ok((found, false));
            }
        };
        let mut findings = Vec::new();
        for way in &ways {
            let begun = found.ladders.len();
            for &solver in &self.options.solvers {
                let (ladder, stopped) = self.ladder(way, branch, solver, observer)?;
                let confirmed = ladder.finding.outcome == Outcome::Confirmed;
                found.ladders.push(ladder);
                if stopped {
                    found.finding.why = "broken off".to_owned();
                    return Ok((found, true));
                }
                if confirmed && !self.options.whole_ladder {
                    break;
                }
            }
            findings.push(of_one_way(&found.ladders[begun..]));
        }
        if let (Some(pose), Some(expected)) = (branch.poses.first(), branch.instantaneous) {
            let count = count_freedoms(
                self.mechanism,
                self.geometry,
                &pose.states,
                (branch.dimension, expected),
                self.options.seed,
            )?;
            findings.push(count.finding.clone());
            found.freedoms = Some(count);
        }
        let of = |outcome| findings.iter().find(|f| f.outcome == outcome);
        if let Some(finding) = of(Outcome::Contradicted)
            .or_else(|| of(Outcome::Inconclusive))
            .or_else(|| findings.first())
        {
            found.finding = finding.clone();
        }
        Ok((found, false))
    }

    fn ladder(
        &self,
        way: &DrivenWay,
        branch: &Branch,
        solver: Solver,
        observer: &mut dyn Observer,
    ) -> Result<(Ladder, bool), VerificationError> {
        let mut ladder = Ladder {
            solver,
            driven: way.driven.name.clone(),
            from: way.from,
            to: way.to,
            ends: way.ends.clone(),
            held: way.held.iter().map(|v| v.name.clone()).collect(),
            largest_force: 0.0,
            rungs: Vec::new(),
            finding: Finding::new(Outcome::Inconclusive, String::new()),
        };
        let mut decided = None;
        for &substeps in &self.options.ladder {
            let mut climb = self.climb(way, branch, solver, substeps, observer)?;
            ladder.largest_force = climb.largest_force;
            climb.rung.order = ladder.rungs.last().and_then(|before| {
                order_between(
                    (before.substeps, before.closure_error),
                    (climb.rung.substeps, climb.rung.closure_error),
                )
            });
            ladder.rungs.push(climb.rung);
            if climb.stopped {
                ladder.finding.why = "broken off".to_owned();
                return Ok((ladder, true));
            }
            decided = decided.or_else(|| judge_motion(&ladder.rungs));
            if decided.is_some() && !self.options.whole_ladder {
                break;
            }
        }
        ladder.finding = decided.unwrap_or_else(|| undecided(&ladder.rungs));
        Ok((ladder, false))
    }

    /// Goes the way once.
    fn climb(
        &self,
        way: &DrivenWay,
        branch: &Branch,
        solver: Solver,
        substeps: usize,
        observer: &mut dyn Observer,
    ) -> Result<Climb, VerificationError> {
        let begun = std::time::Instant::now();
        let options = WorldOptions {
            solver,
            time_step: self.options.time_step,
            substeps,
            ..WorldOptions::default()
        };
        let mut world = World::new(self.mechanism, self.geometry, &way.start, &options)?;
        let (_, effort) = world.scale();
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
        let duration = way.duration() + 0.5 * START_UP;
        let mut climb = Climb {
            rung: Rung {
                substeps,
                closure_error: 0.0,
                distance: 0.0,
                progress: 0.0,
                order: None,
                wall_time: 0.0,
            },
            largest_force: EFFORT * effort / unit(&way.driven),
            stopped: observer
                .begin(&Passage {
                    title: format!(
                        "branch {}: `{}`, {substeps} substeps",
                        branch.name, way.driven.name
                    ),
                    branch: branch.name.clone(),
                    driven: Some(way.driven.clone()),
                    substeps,
                    duration,
                })
                .is_break(),
        };
        let mut prediction = Prediction::new(
            self.mechanism,
            self.geometry,
            &self.analysis.structure,
            &way.start,
            self.loop_freedom(branch),
            self.length,
        )?;
        let mut states = way.start.clone();
        let steps = (PATIENCE * duration / self.options.time_step).ceil() as usize;
        let every = ((duration / self.options.time_step) as usize / MOMENTS).max(1);
        for step in 1..=steps {
            if climb.stopped || climb.rung.progress >= 0.999 {
                break;
            }
            let (place, rate) = way.target(pace(world.time() + self.options.time_step));
            let now = value(self.geometry, &way.driven, &way.start, &states);
            let velocity = rate + (place - now) / CATCH_UP;
            drive(&mut world, &way.driven, velocity, EFFORT * effort)?;
            for (held, place) in way.held.iter().zip(&places) {
                let off = value(self.geometry, held, &way.start, &states) - place;
                drive(&mut world, held, -off / CATCH_UP, HOLDING_EFFORT * effort)?;
            }
            if world.step().is_err() {
                climb.rung.closure_error = f64::NAN;
                break;
            }
            states = world.states(&states);
            if step % every != 0 {
                continue;
            }
            prediction.follow(&states)?;
            let poses = world.link_poses();
            let gaps = world.gaps();
            let closure_error = largest_gap(&gaps, self.length);
            let distance = prediction.distance(&poses);
            climb.rung.progress =
                (value(self.geometry, &way.driven, &way.start, &states) - way.from) / travel;
            for (most, now) in [
                (&mut climb.rung.closure_error, closure_error),
                (&mut climb.rung.distance, distance),
            ] {
                if !(now <= *most) {
                    *most = now;
                }
            }
            climb.stopped = observer
                .moment(&Moment {
                    time: world.time(),
                    done: climb.rung.progress.clamp(0.0, 1.0),
                    simulated: &poses,
                    states: &states,
                    predicted: Some((prediction.poses(), prediction.states())),
                    gaps: &gaps,
                    closure_error,
                    distance,
                })
                .is_break();
        }
        climb.rung.wall_time = begun.elapsed().as_secs_f64();
        Ok(climb)
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

impl Test<'_> {
    /// Instantaneous freedom of the parts with loops at a generic pose of the branch.
    fn loop_freedom(&self, branch: &Branch) -> usize {
        let structure = &self.analysis.structure;
        let free: usize = structure
            .free_joints
            .iter()
            .map(|&j| self.mechanism.joints()[j].freedom())
            .sum();
        let all = branch.instantaneous.unwrap_or(branch.dimension);
        all.saturating_sub(free + 6 * structure.loose_pieces)
    }
}

struct Climb {
    rung: Rung,
    largest_force: f64,
    stopped: bool,
}
