//! Runs all measurements.

use super::analysis::Subject;
use super::choose::{Choice, choose};
use super::clock::Patience;
use super::effects::effects_of;
use super::motion::traced;
use super::result::{Accuracy, Motion, SCHEMA, Scene, Setting, Simulation};
use super::simulation::{Grid, Watch, driven_rows, scene_rows};
use crate::verification::{
    DrivenMotion, Size, VerificationError, VerificationOptions, looped_variables,
};
use crate::{Effects, World, WorldError, WorldOptions, effect_names, scene_drives};
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_math::matrix::MatrixError;
use kutzbach_mobility::{Analysis, AnalysisOptions, Branch, ExactBudget, Verdict};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::TraceOptions;
use std::ops::ControlFlow;
use thiserror::Error;

/// What to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct AccuracyOptions {
    /// The configuration that was analysed; the home pose if `None`.
    pub configuration: Option<String>,
    /// Name of the branch to trace and simulate; the first if `None`.
    pub branch: Option<String>,
    /// Name of the variable to drive; one that serves if `None`.
    pub drive: Option<String>,
    /// The error for which a setting is wanted (characteristic lengths, rad).
    pub wanted: Option<f64>,
    /// How much work exact algebra may do.
    pub exact: ExactBudget,
    /// The settings to simulate with.
    pub grid: Grid,
    /// Whether a first impression of the times is enough.
    pub quick: bool,
}

impl Default for AccuracyOptions {
    /// Everything, from home.
    fn default() -> Self {
        Self {
            configuration: None,
            branch: None,
            drive: None,
            wanted: None,
            exact: ExactBudget::default(),
            grid: Grid::full(),
            quick: false,
        }
    }
}

/// Why nothing was measured.
#[derive(Clone, Debug, Error)]
pub enum AccuracyError {
    /// No branch of that name.
    #[error("there is no branch `{name}`; there is {known}")]
    UnknownBranch {
        /// The name asked for.
        name: String,
        /// Those there are.
        known: String,
    },
    /// The wanted error is no error.
    #[error("an error has to be a positive number, but {wanted} was wanted")]
    Wanted {
        /// What was wanted.
        wanted: f64,
    },
    /// Numbers out of range.
    #[error("the geometry leaves the range of floating-point numbers: {0}")]
    OutOfRange(#[from] MatrixError),
    /// No world can be made.
    #[error(transparent)]
    World(#[from] WorldError),
    /// No simulation can be made.
    #[error(transparent)]
    Simulation(#[from] VerificationError),
}

/// What is being measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The ways to know how it can move.
    Analysis,
    /// The trace.
    Motion,
    /// Simulations of the motion.
    Simulation,
    /// Simulations of the scene.
    Scene,
    /// Steps with each effect.
    Effects,
}

/// Moments looked at in a simulation: about so many joint variables in all, within these bounds.
const LOOKED_AT: usize = 5_000;
const FEWEST_LOOKS: usize = 30;
const MOST_LOOKS: usize = 240;

/// Shares of the stages in the whole, for a progress bar: simulations take longest.
const SHARES: [f64; 5] = [0.1, 0.05, 0.6, 0.1, 0.15];

/// Measures everything. `analysis` is that of the configuration of the options. `watch` is told how far all of it has come,
/// from 0 to 1, and may break it off; what was measured by then is told.
///
/// # Errors
/// [`AccuracyError`] where the options ask for what the mechanism does not have, or numbers leave their range. That nothing
/// moves, or a simulation fails, is a result.
pub fn measure(
    mechanism: &Mechanism,
    analysis: &Analysis,
    options: &AccuracyOptions,
    watch: &mut dyn FnMut(Stage, f64) -> ControlFlow<()>,
) -> Result<Accuracy, AccuracyError> {
    let ready = Ready::new(mechanism, analysis, options)?;
    let structure = &analysis.structure;
    let mut accuracy = Accuracy {
        schema: SCHEMA.to_owned(),
        mechanism: mechanism.name().to_owned(),
        verdict: analysis.mobility.verdict.word().to_owned(),
        finite: analysis.mobility.finite(),
        size: [
            mechanism.links().len(),
            mechanism.joints().len(),
            structure.cycles.len(),
        ],
        analysis: Vec::new(),
        motion: Motion::default(),
        simulation: Simulation::default(),
        scene: None,
        effects: Vec::new(),
        choice: None,
        stopped: false,
    };
    let analysis_options = AnalysisOptions {
        configuration: options.configuration.clone(),
        exact: options.exact,
        ..AnalysisOptions::default()
    };
    let subject = Subject {
        mechanism,
        configuration: ready.configuration(),
        geometry: &ready.geometry,
        analysis,
        options: &analysis_options,
        patience: ready.patience,
    };
    let (ways, stopped) =
        subject.ways(|done| watch(Stage::Analysis, SHARES[0] * done).is_break())?;
    accuracy.analysis = ways;
    accuracy.stopped = stopped || watch(Stage::Motion, SHARES[0]).is_break();
    if accuracy.stopped {
        return Ok(accuracy);
    }
    let length = ready.length()?;
    accuracy.motion = traced(
        mechanism,
        &ready.geometry,
        analysis,
        &TraceOptions {
            branch: options.branch.clone(),
            drive: options.drive.clone(),
            configuration: options.configuration.clone(),
            ..TraceOptions::default()
        },
        length,
        ready.patience,
    );
    let from = SHARES[0] + SHARES[1];
    let (simulation, stopped) =
        ready.simulation(&mut |done, _| watch(Stage::Simulation, from + SHARES[2] * done))?;
    accuracy.simulation = simulation;
    accuracy.stopped = stopped;
    if stopped {
        return Ok(accuracy);
    }
    let from = from + SHARES[2];
    let wanted = options
        .wanted
        .filter(|_| accuracy.simulation.rows.is_empty());
    if let Some((scene, stopped)) = ready.scene(wanted, &mut |done, _| {
        watch(Stage::Scene, from + SHARES[3] * done)
    })? {
        accuracy.scene = Some(scene);
        accuracy.stopped = stopped;
    }
    accuracy.stopped |= watch(Stage::Effects, from + SHARES[3]).is_break();
    if !accuracy.stopped && ready.is_posed() {
        accuracy.effects = effects_of(
            mechanism,
            &ready.geometry,
            &analysis.assembly.states,
            Effects::of_scene(mechanism),
            &scene_drives(mechanism),
            (ready.patience.runs, options.grid.effects),
        )?;
    }
    accuracy.choice = options.wanted.map(|wanted| {
        choose(
            rows_for(&accuracy.simulation, accuracy.scene.as_ref()),
            wanted,
        )
    });
    Ok(accuracy)
}

/// Measures simulations only, and says which setting reaches an error soonest: what `simulate` asks. `None` as the choice
/// where it was broken off.
///
/// # Errors
/// As [`measure`].
pub fn measure_settings(
    mechanism: &Mechanism,
    analysis: &Analysis,
    options: &AccuracyOptions,
    wanted: f64,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(Vec<Setting>, Option<Choice>), AccuracyError> {
    let options = AccuracyOptions {
        wanted: Some(wanted),
        ..options.clone()
    };
    let ready = Ready::new(mechanism, analysis, &options)?;
    let (simulation, mut stopped) = ready.simulation(&mut |done, _| watch(done))?;
    let mut rows = simulation.rows;
    if rows.is_empty()
        && !stopped
        && let Some((scene, broken)) = ready.scene(Some(wanted), &mut |done, _| watch(done))?
    {
        rows = scene.rows;
        stopped = broken;
    }
    let choice = (!stopped).then(|| choose(&rows, wanted));
    Ok((rows, choice))
}

/// The settings that a choice is made of: those of the motion, or of the scene where nothing moves.
fn rows_for<'a>(simulation: &'a Simulation, scene: Option<&'a Scene>) -> &'a [Setting] {
    match scene {
        Some(scene) if simulation.rows.is_empty() => &scene.rows,
        _ => &simulation.rows,
    }
}

/// What all stages need.
struct Ready<'a> {
    mechanism: &'a Mechanism,
    analysis: &'a Analysis,
    options: &'a AccuracyOptions,
    geometry: Geometry<f64>,
    patience: Patience,
}

impl<'a> Ready<'a> {
    fn new(
        mechanism: &'a Mechanism,
        analysis: &'a Analysis,
        options: &'a AccuracyOptions,
    ) -> Result<Self, AccuracyError> {
        if let Some(wanted) = options.wanted
            && !(wanted > 0.0 && wanted.is_finite())
        {
            return Err(AccuracyError::Wanted { wanted });
        }
        let configuration = options
            .configuration
            .as_deref()
            .and_then(|name| mechanism.configuration(name));
        let ready = Self {
            mechanism,
            analysis,
            options,
            geometry: Geometry::new(mechanism, configuration, &Arithmetic::double()),
            patience: if options.quick {
                Patience::QUICK
            } else {
                Patience::FULL
            },
        };
        ready.branch()?;
        Ok(ready)
    }

    fn configuration(&self) -> Option<&'a kutzbach_model::mechanism::Configuration> {
        let name = self.options.configuration.as_deref()?;
        self.mechanism.configuration(name)
    }

    /// Whether there is a closed pose to start from.
    fn is_posed(&self) -> bool {
        self.analysis.mobility.verdict != Verdict::Unassembled
    }

    /// The branch asked for, or the first; `None` where there is none.
    fn branch(&self) -> Result<Option<&'a Branch>, AccuracyError> {
        let branches = self.analysis.branches.as_deref().unwrap_or_default();
        let Some(name) = &self.options.branch else {
            return Ok(branches.first());
        };
        let found = branches.iter().find(|branch| branch.name == *name);
        found.map(Some).ok_or_else(|| AccuracyError::UnknownBranch {
            name: name.clone(),
            known: if branches.is_empty() {
                "none".to_owned()
            } else {
                let names: Vec<&str> = branches.iter().map(|b| b.name.as_str()).collect();
                names.join(", ")
            },
        })
    }

    /// The world at the pose that was analysed.
    fn world(&self) -> Result<World, WorldError> {
        let states = &self.analysis.assembly.states;
        let options = WorldOptions::default();
        World::new(self.mechanism, &self.geometry, states, &options)
    }

    /// Characteristic length (m).
    fn length(&self) -> Result<f64, AccuracyError> {
        Ok(self.world()?.scale().0)
    }

    fn simulation(&self, watch: &mut Watch<'_>) -> Result<(Simulation, bool), AccuracyError> {
        let none = |why: &str| {
            let simulation = Simulation {
                why_not: Some(why.to_owned()),
                ..Simulation::default()
            };
            Ok((simulation, false))
        };
        match self.analysis.mobility.verdict {
            Verdict::Unassembled => {
                return none("no closed pose is known: there is no pose to start from");
            }
            Verdict::Rigid => {
                return none(
                    "it is rigid: no motion is predicted that a simulation could be compared with",
                );
            }
            Verdict::Undecided | Verdict::Mobile => {}
        }
        let Some(branch) = self.branch()? else {
            return none("how it moves is not decided: no motion is predicted");
        };
        let verification = VerificationOptions {
            configuration: self.options.configuration.clone(),
            drive: self.options.drive.clone(),
            longest: self.options.grid.longest,
            ..VerificationOptions::default()
        };
        if let Some(why) = self.world()?.another_mechanism() {
            return none(&why);
        }
        let motion = DrivenMotion::first_along(
            self.mechanism,
            &self.geometry,
            self.analysis,
            branch,
            &verification,
        );
        let motion = match motion {
            Ok(Some(motion)) => motion,
            Ok(None) => return none("no stretch of the branch can be driven"),
            Err(why) => return none(&why),
        };
        let freedoms = self.mechanism.joints().iter().map(|joint| joint.freedom());
        let unknowns = freedoms.sum::<usize>().max(1);
        let motion = motion.looked_at((LOOKED_AT / unknowns).clamp(FEWEST_LOOKS, MOST_LOOKS));
        let looped = looped_variables(self.mechanism, &self.analysis.structure);
        Ok(driven_rows(
            self.mechanism,
            &self.geometry,
            (&motion, &Size::of(self.mechanism, looped)),
            &branch.name,
            (&self.options.grid, self.options.wanted),
            watch,
        )?)
    }

    /// The scene of the file, where it calls for anything; with settings between those of the grid where a choice has to be
    /// made of them.
    fn scene(
        &self,
        wanted: Option<f64>,
        watch: &mut Watch<'_>,
    ) -> Result<Option<(Scene, bool)>, AccuracyError> {
        let effects = Effects::of_scene(self.mechanism);
        let drives = scene_drives(self.mechanism);
        if !self.is_posed() || (effect_names(&effects).is_empty() && drives.is_empty()) {
            return Ok(None);
        }
        Ok(Some(scene_rows(
            self.mechanism,
            &self.geometry,
            &self.analysis.assembly.states,
            (effects, &drives),
            (&self.options.grid, wanted),
            watch,
        )?))
    }
}
