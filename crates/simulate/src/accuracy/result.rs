//! What is told of one mechanism. Fields named `timing` differ from run to run, nothing else does.

use super::choose::Choice;
use crate::verification::{FINE_ENOUGH, NEAR};
use crate::{Integrator, Solver};
use kutzbach_mobility::CertificateLevel;
use serde::{Deserialize, Serialize};

/// The version of the JSON.
pub const SCHEMA: &str = "kutzbach-accuracy-1";

/// Every way to an answer about one mechanism, with its cost and its error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// [`SCHEMA`].
    pub schema: String,
    /// Name of the mechanism.
    pub mechanism: String,
    /// The verdict of all engines together, as a word.
    pub verdict: String,
    /// The finite freedom, where it is decided.
    pub finite: Option<usize>,
    /// Links, joints and independent loops.
    pub size: [usize; 3],
    /// The ways to know how it can move, in order of cost.
    pub analysis: Vec<Way>,
    /// Tracing the motion.
    pub motion: Motion,
    /// Simulating it.
    pub simulation: Simulation,
    /// Running the file's scene, where it has one.
    pub scene: Option<Scene>,
    /// What each effect costs.
    pub effects: Vec<Effect>,
    /// Which setting serves for a wanted error, where one was named.
    pub choice: Option<Choice>,
    /// Whether it was broken off; what is told was measured before.
    pub stopped: bool,
}

/// What a way's claim is worth, by the verdict of all engines together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Claim {
    /// It decides the finite freedom.
    Decides,
    /// It leaves several values possible, the true one among them.
    Bounds,
    /// A number that is no claim, and is the finite freedom.
    Equal,
    /// A number that is no claim, and is not the finite freedom.
    Wrong,
    /// It says nothing.
    Silent,
    /// The verdict is open, so that a number cannot be judged.
    Open,
}

impl Claim {
    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Decides => "decides",
            Self::Bounds => "bounds",
            Self::Equal => "right by itself",
            Self::Wrong => "wrong",
            Self::Silent => "silent",
            Self::Open => "not judged",
        }
    }
}

/// A way to know how a mechanism can move.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Way {
    /// Its name, such as `rank`; `verdict` and `whole report` are all engines together, asked for no more than that.
    pub name: String,
    /// Digits or order, such as `106 bits`; empty where there is nothing to choose.
    pub precision: String,
    /// What it says of the freedom, such as `1`, `at most 2` or `0 to 3`; empty where nothing.
    pub says: String,
    /// What that is worth.
    pub claim: Claim,
    /// By how many powers of ten the figures that it rests on stand clear of noise; the least of all parts.
    pub decades: Option<f64>,
    /// How strong the certificate of a decision is; only of all engines together, which give one.
    pub certificate: Option<CertificateLevel>,
    /// In a few words, of the part that hangs on least.
    pub text: String,
    /// How long it takes.
    pub timing: WayTiming,
}

/// How long a way takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WayTiming {
    /// Seconds on the clock: the median of the runs.
    pub seconds: f64,
    /// Runs; none where it was not asked.
    pub runs: usize,
}

/// A trace of the predicted motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Why there is none.
    pub still: Option<String>,
    /// Name of the branch.
    pub branch: String,
    /// What is driven.
    pub driven: String,
    /// Poses that the curve is made of.
    pub nodes: usize,
    /// Least and greatest arclength (metric: rad, part lengths).
    pub arclengths: [f64; 2],
    /// By tolerance, from coarse to fine.
    pub rows: Vec<Traced>,
    /// How long finding the curve takes.
    pub timing: MotionTiming,
}

/// How long finding a curve takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MotionTiming {
    /// Seconds on the clock, from the analysis to the curve with all that is met on it.
    pub seconds: f64,
}

/// Poses of the curve, closed to a tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Traced {
    /// What was asked for (rad, cycle lengths).
    pub tolerance: f64,
    /// Poses, equally far apart along the curve.
    pub poses: usize,
    /// Largest gap of any joint at any pose (characteristic lengths, rad).
    pub closure_error: f64,
    /// Largest distance from the pose at the same place that is closed to rounding (characteristic lengths, rad).
    pub distance: f64,
    /// How long they take.
    pub timing: TracedTiming,
}

impl Traced {
    /// The larger of the two errors.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.closure_error.max(self.distance)
    }
}

/// How long poses take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TracedTiming {
    /// Poses per second on the clock, those of all links included.
    pub poses_per_second: f64,
}

/// What a drive does while it is simulated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Driven {
    /// Name of the branch.
    pub branch: String,
    /// What is driven.
    pub variable: String,
    /// From where (rad, m).
    pub from: f64,
    /// To where.
    pub to: f64,
    /// Why no farther.
    pub ends: String,
    /// Seconds that it takes: no joint goes faster than a radian or a characteristic length per second.
    pub seconds: f64,
}

/// Simulations of the predicted motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Simulation {
    /// Why there is none.
    pub why_not: Option<String>,
    /// What is driven.
    pub driven: Option<Driven>,
    /// Every setting, solver by solver, from long substeps to short ones.
    pub rows: Vec<Setting>,
}

/// What became of a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// It went all the way.
    Arrived,
    /// The drive did not arrive in three times the time.
    Stalled,
    /// It fell to pieces: joints opened by a third of its size, or a number was not finite any more.
    CameApart,
    /// It was not run: too much work.
    LeftOut,
    /// It was broken off.
    BrokenOff,
}

impl State {
    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Arrived => "arrived",
            Self::Stalled => "stalled",
            Self::CameApart => "came apart",
            Self::LeftOut => "left out",
            Self::BrokenOff => "interrupted",
        }
    }
}

/// One setting of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Setting {
    /// How trees are held.
    pub solver: Solver,
    /// Length of a step (s).
    pub time_step: f64,
    /// Substeps of a step.
    pub substeps: usize,
    /// What became of it.
    pub state: State,
    /// Largest gap of any joint at any moment looked at (characteristic lengths, rad).
    pub closure_error: Option<f64>,
    /// Largest distance from the predicted motion, same units; absent where nothing is predicted.
    pub distance: Option<f64>,
    /// How much of its way the drive came; absent where nothing is predicted.
    pub came: Option<f64>,
    /// How long it takes; absent where it was not run.
    pub timing: Option<RunTiming>,
}

impl Setting {
    /// The larger of the errors known; `None` where the run says nothing: it did not arrive, or came apart.
    #[must_use]
    pub fn error(&self) -> Option<f64> {
        let closure = self
            .closure_error
            .filter(|_| self.state == State::Arrived)?;
        Some(closure.max(self.distance.unwrap_or(0.0)))
    }

    /// Whether a verification takes errors of this size for those of a true motion. A setting that errs by more can be as
    /// cheap as it likes: what it shows confirms nothing.
    #[must_use]
    pub fn confirms(&self) -> bool {
        let closure = self.closure_error.unwrap_or(f64::INFINITY);
        let near = FINE_ENOUGH.max(NEAR * closure);
        self.state == State::Arrived
            && closure <= FINE_ENOUGH
            && self.distance.is_none_or(|distance| distance <= near)
    }

    /// Seconds on the clock for a simulated second.
    #[must_use]
    pub fn seconds(&self) -> Option<f64> {
        self.timing.map(|timing| timing.seconds_per_second)
    }

    /// Length of a substep (s).
    #[must_use]
    pub fn substep(&self) -> f64 {
        self.time_step / self.substeps as f64
    }
}

/// How long a simulation takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunTiming {
    /// Seconds on the clock for a simulated second, looking not counted.
    pub seconds_per_second: f64,
    /// Whether no other setting is as quick and has a smaller error: it lies on the Pareto front.
    pub pareto: bool,
}

/// Simulations of the file's scene, from rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Its effects, by name.
    pub effects: Vec<String>,
    /// Simulated seconds.
    pub seconds: f64,
    /// Every setting of the engine; only the closure error is known.
    pub rows: Vec<Setting>,
    /// How far the motion is off, in halved steps of each integrator that serves the scene.
    #[serde(default)]
    pub steps: Vec<SceneStep>,
    /// Characteristic length (m).
    #[serde(default)]
    pub length: f64,
}

/// The scene in steps of one length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneStep {
    /// What made it move.
    pub integrator: Integrator,
    /// Length of a step (s).
    pub time_step: f64,
    /// About how far links are off at the worst moment (characteristic lengths, rad); absent where runs do not approach one another.
    pub off: Option<f64>,
    /// About how far speeds are off, in parts of the greatest.
    pub speeds: Option<f64>,
    /// Energy at the end less that at the start (J).
    pub energy_change: f64,
    /// Largest gap of any joint (characteristic lengths, rad).
    pub closure_error: f64,
    /// How long it takes.
    pub timing: RunTiming,
}

/// What one effect costs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Effect {
    /// `none`, the name of an effect, or `scene`.
    pub effects: String,
    /// Whether the file's scene calls for it.
    pub called_for: bool,
    /// Bodies.
    pub bodies: usize,
    /// Shapes that can touch.
    pub shapes: usize,
    /// Steps measured.
    pub steps: usize,
    /// How long a step takes.
    pub timing: EffectTiming,
}

/// How long a step takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EffectTiming {
    /// Seconds on the clock; absent where the motion left the range of numbers.
    pub step: Option<f64>,
}
