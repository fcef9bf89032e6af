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

use super::driven_motion::DrivenMotion;
use super::ladder::{Finding, Outcome, Rung, judge_motion, order_between, undecided};
use super::observer::Observer;
use super::pushing::{Pushed, Pushing};
use super::{FreedomCount, VerificationError, count_freedoms};
use crate::closure::Geometry;
use crate::mechanism::Mechanism;
use crate::mobility::{Analysis, Branch, Verdict};
use crate::simulate::{JointGap, Solver, World, WorldOptions};
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
        let motions = match DrivenMotion::along(
            self.mechanism,
            self.geometry,
            self.analysis,
            branch,
            self.options,
        ) {
            Ok(motions) => motions,
            Err(why) => {
                found.finding.why = why;
                return Ok((found, false));
            }
        };
        let mut findings = Vec::new();
        for motion in &motions {
            let begun = found.ladders.len();
            for &solver in &self.options.solvers {
                let (ladder, stopped) = self.ladder(motion, solver, observer)?;
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
        motion: &DrivenMotion<'_>,
        solver: Solver,
        observer: &mut dyn Observer,
    ) -> Result<(Ladder, bool), VerificationError> {
        let mut ladder = Ladder {
            solver,
            driven: motion.driven().name.clone(),
            from: motion.from(),
            to: motion.to(),
            ends: motion.ends().to_owned(),
            held: motion.held().iter().map(|v| v.name.clone()).collect(),
            largest_force: 0.0,
            rungs: Vec::new(),
            finding: Finding::new(Outcome::Inconclusive, String::new()),
        };
        let mut decided = None;
        for &substeps in &self.options.ladder {
            let options = WorldOptions {
                solver,
                time_step: self.options.time_step,
                substeps,
                ..WorldOptions::default()
            };
            let run = motion.run(&options, observer)?;
            ladder.largest_force = run.largest_force;
            let order = ladder.rungs.last().and_then(|before| {
                order_between(
                    (before.substeps, before.closure_error),
                    (substeps, run.closure_error),
                )
            });
            ladder.rungs.push(Rung {
                substeps,
                closure_error: run.closure_error,
                distance: run.distance,
                progress: run.progress,
                order,
                wall_time: run.wall_time,
            });
            if run.stopped {
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
}
