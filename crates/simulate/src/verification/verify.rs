//! What a simulation says about a prediction.
//!
//! A prediction that something moves is put to the test branch by branch. The world starts at rest at a pose of the branch
//! that is not singular, one joint is driven along it by a motor of limited torque, the other inputs are held, and the
//! same is done over with finer and finer substeps until the ladder of errors decides ([`super::judge_motion`]). At a
//! generic pose random impulses count the degrees of freedom ([`super::count_freedoms`]). A prediction that nothing moves is put to
//! the test by pushing every joint ([`super::Pushing`]). What is undecided or does not assemble is not simulated.
//!
//! None of it is a proof: it is evidence from physics that knows nothing of the analysis, and it is stated with the size
//! of the defect that it could have missed.

use super::budget::{Budget, Size, cost_of_count, cost_of_run, looped_variables, wheels};
use super::driven_motion::DrivenMotion;
use super::excitation::{self, MOST_SPREAD};
use super::ladder::{
    FINE_ENOUGH, Finding, NEAR, Outcome, ROUNDING, Rung, judge_motion, order_between, undecided,
};
use super::observer::Observer;
use super::pushing::{Pushed, Pushing};
use super::{FreedomCount, VerificationError, count_freedoms};
use crate::{JointGap, Masses, Solver, World, WorldOptions};
use kutzbach_closure::Geometry;
use kutzbach_mobility::{Analysis, Branch, CertificateLevel, Verdict};
use kutzbach_model::mechanism::Mechanism;
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
    /// Work to spend, in seconds on a usual machine, counted in steps and sizes and not by the clock, so that the answer is
    /// the same everywhere; as much as it takes if `None`.
    pub budget: Option<f64>,
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
            budget: None,
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
    /// What the budget did not allow, for people.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub untested: Vec<String>,
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
    let mut verification = Verification::begun(analysis.mobility.verdict, "");
    let unpredicted = match analysis.mobility.verdict {
        Verdict::Unassembled => Some("no closed pose is known: there is no pose to simulate"),
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
    verification.notes = notes(mechanism, &home);
    if let Some(why) = home.another_mechanism() {
        verification.finding.why = why;
        return Ok(verification);
    }
    if analysis.mobility.verdict == Verdict::Rigid {
        verify_rigid(mechanism, geometry, analysis, options, &home, observer)
            .map(|pushing| verification.with_pushing(pushing))
    } else {
        let mut test = Test {
            mechanism,
            geometry,
            analysis,
            options,
            size: Size::of(mechanism, looped_variables(mechanism, &analysis.structure)),
            budget: Budget::new(options.budget),
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

/// The masses to verify with.
fn masses_of(home: &World) -> Masses {
    match home.inertia_spread() > MOST_SPREAD {
        true => Masses::Alike,
        false => Masses::Stated,
    }
}

/// How the worlds are made: of masses only that they are not the file's, where they are not.
fn notes(mechanism: &Mechanism, home: &World) -> Vec<String> {
    let all = home.notes().iter();
    let alike = masses_of(home) == Masses::Alike;
    let is_link = |name: &str| mechanism.link_named(name).is_some();
    let mut notes: Vec<String> = all
        .filter(|note| !(alike && is_link(&note.about)))
        .map(|note| format!("{}: {}", note.about, note.text))
        .collect();
    if alike {
        notes.insert(
            0,
            format!(
                "{}: every link has the same mass and moments of inertia here, since those stated or derived are \
                 too far apart ({:.0e} : 1) for the engine's solver; how a mechanism can move does not depend on them",
                mechanism.name(),
                home.inertia_spread()
            ),
        );
    }
    notes
}

/// Rungs of a solver that is only asked whether something moves after all: impulses close loops to 1e-5 at the last of them.
const FEW_RUNGS: usize = 5;

/// Pushes with one solver after the other; `None` where there is none to push with. Nothing moves where one of them shows so and none
/// that something moves with its loops closed to rounding: redundant constraints can lock the solver that holds trees by reduced
/// coordinates, and impulses give way.
fn verify_rigid(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    analysis: &Analysis,
    options: &VerificationOptions,
    home: &World,
    observer: &mut dyn Observer,
) -> Result<Option<Pushing>, VerificationError> {
    let (mut stays, mut first) = (None, None);
    let (size, mut budget) = (Size::of(mechanism, 0), Budget::new(options.budget));
    let masses = masses_of(home);
    let length = home.scale().0;
    for &solver in &options.solvers {
        let rungs = match stays {
            Some(_) => options.ladder.len().min(FEW_RUNGS),
            None => options.ladder.len(),
        };
        let pushed = Pushed {
            mechanism,
            geometry,
            structure: &analysis.structure,
            proved: analysis.mobility.level == CertificateLevel::Exact,
            states: &analysis.assembly.states,
            solver,
            time_step: options.time_step,
            ladder: &options.ladder[..rungs],
            length,
            masses,
        };
        let pushing = pushed.push_all((&size, &mut budget), observer)?;
        match pushing.finding.outcome {
            _ if pushing.stopped => return Ok(Some(pushing)),
            Outcome::Contradicted => return Ok(Some(pushing)),
            Outcome::Confirmed => stays.get_or_insert(pushing),
            Outcome::Inconclusive => first.get_or_insert(pushing),
        };
    }
    Ok(stays.or(first))
}

impl Verification {
    /// What is known where one was asked to stop before anything was tested.
    #[must_use]
    pub fn broken_off(verdict: Verdict) -> Self {
        Self {
            stopped: true,
            ..Self::begun(verdict, "broken off before anything was tested")
        }
    }

    fn begun(verdict: Verdict, why: &str) -> Self {
        Self {
            verdict,
            branches: Vec::new(),
            pushing: None,
            finding: Finding::new(Outcome::Inconclusive, why),
            stopped: false,
            notes: Vec::new(),
        }
    }

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

fn driven_by(name: &str) -> String {
    format!("driven by `{name}`")
}

/// The share of a budget that may go into waiting for velocities to settle after blows.
const SETTLING_SHARE: f64 = 1.0 / 6.0;

/// Things left out that are named; of more the rest is counted.
const NAMED: usize = 3;

fn listed(things: &[String]) -> String {
    let named = things[..things.len().min(NAMED)].join(", ");
    match things.len().saturating_sub(NAMED) {
        0 => named,
        more => format!("{named} and {more} more"),
    }
}

/// Loops open by so much (characteristic lengths, rad) hold nothing together.
const OPEN: f64 = 0.1;

/// The outcome of one way, from the solvers tried: one that confirms is enough, since a solver can fail to move what moves
/// but not close what does not fit; a contradiction has to come from all of them.
fn of_one_way(ladders: &[Ladder]) -> Finding {
    let with = |outcome| ladders.iter().filter(move |l| l.finding.outcome == outcome);
    // A simulation whose loops are open by a good part of the machine says nothing for or against.
    let held = |ladder: &&Ladder| {
        ladder
            .rungs
            .last()
            .is_some_and(|rung| rung.closure_error < OPEN)
    };
    let found = with(Outcome::Confirmed)
        .next()
        .or_else(|| with(Outcome::Inconclusive).find(held))
        .or_else(|| with(Outcome::Contradicted).next())
        .or_else(|| ladders.last());
    found.map_or_else(|| undecided(&[]), |ladder| ladder.finding.clone())
}

/// What is said where no drive shows that a motion is none of the mechanism, but its joints cannot stand as predicted: drives stall, and
/// simulations come apart, for other reasons too.
fn stands_open(simulated: &Finding, open: f64) -> Finding {
    let why = format!(
        "the drive does not show it ({}), but where its joints stand as predicted a loop is open by {open:.1e} of the \
         characteristic length: these are no poses of the simulated mechanism",
        simulated.why
    );
    Finding::new(Outcome::Contradicted, why)
}

struct Test<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    analysis: &'a Analysis,
    options: &'a VerificationOptions,
    size: Size,
    budget: Budget,
}

impl Test<'_> {
    /// Tests one branch; also whether an observer broke it off.
    fn branch(
        &mut self,
        branch: &Branch,
        observer: &mut dyn Observer,
    ) -> Result<(BranchVerification, bool), VerificationError> {
        let mut found = BranchVerification {
            branch: branch.name.clone(),
            dimension: branch.dimension,
            ladders: Vec::new(),
            freedoms: None,
            untested: Vec::new(),
            finding: Finding::new(Outcome::Inconclusive, String::new()),
        };
        let options = VerificationOptions {
            longest: self.longest(),
            ..self.options.clone()
        };
        let (budget, untested) = (&mut self.budget, &mut found.untested);
        let cost = self.size.trace();
        let mut wanted = |drive: Option<&str>| {
            let fits = budget.affords(cost);
            if !fits {
                untested.push(match drive {
                    Some(name) => driven_by(name),
                    None => "any drive".to_owned(),
                });
            }
            fits
        };
        let motions = match DrivenMotion::along_those_wanted(
            self.mechanism,
            self.geometry,
            self.analysis,
            branch,
            &options,
            &mut wanted,
        ) {
            Ok(motions) => motions,
            Err(why) => {
                found.finding.why = why;
                return Ok((found, false));
            }
        };
        let mut findings = Vec::new();
        // The count first: it speaks of all freedoms at once.
        let count = self.count(branch, &mut found)?;
        for motion in motions {
            let moments = self.size.moments(motion.moments());
            let motion = motion.looked_at(moments);
            let begun = found.ladders.len();
            let [open, own] = motion.open_as_predicted()?;
            if self.tries(&motion, &mut found, observer)? {
                found.finding.why = "broken off".to_owned();
                return Ok((found, true));
            }
            let mut finding = of_one_way(&found.ladders[begun..]);
            if finding.outcome == Outcome::Contradicted && motion.masses() == Masses::Stated {
                // What is heavy may stall a drive: masses are no matter of how it can move.
                let motion = motion.with_masses(Masses::Alike);
                let again = found.ladders.len();
                if self.tries(&motion, &mut found, observer)? {
                    found.finding.why = "broken off".to_owned();
                    return Ok((found, true));
                }
                if found.ladders.len() == again {
                    self.doubt(&mut finding);
                } else {
                    finding = of_one_way(&found.ladders[again..]);
                }
            }
            if found.ladders.len() == begun {
                continue;
            }
            if finding.outcome != Outcome::Contradicted && open > FINE_ENOUGH + NEAR * own {
                finding = stands_open(&finding, open);
            }
            findings.push(finding);
        }
        findings.extend(count);
        found.finding = self.whole(&findings, &found.untested);
        Ok((found, false))
    }

    /// How long a way may last (s) for one along every part to be tested.
    fn longest(&self) -> f64 {
        let ways = match &self.options.drive {
            Some(_) => 1,
            None => self.analysis.structure.parts.len().max(1),
        };
        let ladder = (self.options.time_step, self.options.ladder.as_slice());
        self.budget
            .longest(&self.size, ways, ladder, self.options.longest)
    }

    /// Counts the freedoms at a generic pose of the branch, if there is one and the budget allows it.
    fn count(
        &mut self,
        branch: &Branch,
        found: &mut BranchVerification,
    ) -> Result<Option<Finding>, VerificationError> {
        let (Some(pose), Some(expected)) = (branch.poses.first(), branch.instantaneous) else {
            return Ok(None);
        };
        if !self.budget.affords(cost_of_count(&self.size, expected)) {
            found.untested.push("the count of freedoms".to_owned());
            return Ok(None);
        }
        let count = count_freedoms(
            self.mechanism,
            self.geometry,
            &pose.states,
            (branch.dimension, expected),
            self.options.seed,
            self.budget.share(SETTLING_SHARE),
        )?;
        // Some blows take much longer to settle than most.
        let done = self.size.steps(count.steps as f64, excitation::SUBSTEPS);
        self.budget
            .charge((done - cost_of_count(&self.size, expected)).max(0.0));
        let finding = count.finding.clone();
        found.freedoms = Some(count);
        Ok(Some(finding))
    }

    /// One way with one solver after the other until one confirms; whether an observer broke it off.
    fn tries(
        &mut self,
        motion: &DrivenMotion<'_>,
        found: &mut BranchVerification,
        observer: &mut dyn Observer,
    ) -> Result<bool, VerificationError> {
        let solvers = self.options.solvers.clone();
        for (index, &solver) in solvers.iter().enumerate() {
            let (ladder, stopped) = self.ladder(motion, solver, observer)?;
            // Where forces hold nothing together, all solvers do the same. A contradiction is to come from all of them.
            let exact = ladder.rungs.iter().all(|r| r.closure_error <= ROUNDING);
            let enough = match ladder.finding.outcome {
                Outcome::Confirmed => true,
                Outcome::Inconclusive => exact && !ladder.rungs.is_empty(),
                Outcome::Contradicted => false,
            };
            if ladder.rungs.is_empty() && !stopped {
                // Nothing of it fits into the budget.
                match found.ladders.last_mut().filter(|_| index > 0) {
                    None => found.untested.push(driven_by(&ladder.driven)),
                    Some(before) => self.doubt(&mut before.finding),
                }
                return Ok(false);
            }
            found.ladders.push(ladder);
            if stopped {
                return Ok(true);
            }
            if enough && !self.options.whole_ladder {
                break;
            }
        }
        Ok(false)
    }

    /// A contradiction has to come from every solver and with any masses: one that could not be tried anew is none.
    fn doubt(&self, finding: &mut Finding) {
        if finding.outcome == Outcome::Contradicted {
            finding.outcome = Outcome::Inconclusive;
            let text = format!(
                "; to try it another way does not fit into {}",
                self.budget.words()
            );
            finding.why.push_str(&text);
        }
    }

    /// What all findings about a branch come to, with what was left out.
    fn whole(&self, findings: &[Finding], untested: &[String]) -> Finding {
        let of = |outcome| findings.iter().find(|f| f.outcome == outcome);
        if let Some(finding) = of(Outcome::Contradicted).or_else(|| of(Outcome::Inconclusive)) {
            return finding.clone();
        }
        match (findings, untested) {
            ([], []) => Finding::new(Outcome::Inconclusive, String::new()),
            ([first, ..], []) => first.clone(),
            (tested, _) => Finding::new(
                Outcome::Inconclusive,
                format!(
                    "within {} {} confirmed; not tested: {}",
                    self.budget.words(),
                    match tested.len() {
                        0 => "nothing was".to_owned(),
                        1 => "one test is".to_owned(),
                        many => format!("all {many} tests made are"),
                    },
                    listed(untested)
                ),
            ),
        }
    }

    fn ladder(
        &mut self,
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
        let mut spent = false;
        let rungs = self.options.ladder.clone();
        for &substeps in &rungs {
            let cost = cost_of_run(&self.size, motion, self.options.time_step, substeps);
            if !self.budget.affords(cost) {
                spent = true;
                break;
            }
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
        let off = |rung: &Rung| rung.closure_error <= ROUNDING && rung.distance > ROUNDING;
        if ladder.finding.outcome == Outcome::Inconclusive
            && ladder.rungs.last().is_some_and(off)
            && wheels(self.mechanism) > 0
        {
            let why = "; couplings of three joints and more, which the engine holds by light wheels, may give";
            ladder.finding.why.push_str(why);
        }
        if spent && ladder.finding.outcome == Outcome::Inconclusive && !ladder.rungs.is_empty() {
            let spent = format!("; finer ones do not fit into {}", self.budget.words());
            ladder.finding.why.push_str(&spent);
        }
        Ok((ladder, false))
    }
}
