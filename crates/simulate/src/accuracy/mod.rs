//! What accuracy costs: every way of getting an answer about one mechanism, with its time and its error.
//!
//! # The problem
//! A count, a rank, a test near the pose, power series, exact algebra: each says something of how a mechanism moves, for
//! microseconds or for seconds. Once a motion is known, it can be traced or simulated, coarsely or finely. Which of all these
//! is worth its time depends on the mechanism, and is told here by trying them on it.
//!
//! # What holds
//! - Every way is tried alone, with the digits, the order or the settings named, and says what it claims, not what the
//!   verdict knows. Whether it is right is judged by the verdict of all engines together.
//! - Errors of traces and simulations are measured alike, by the poses of the links: the largest gap of a joint (*closure
//!   error*), and the largest distance from the motion that is predicted; in characteristic lengths, or radians.
//! - Everything but times depends on the mechanism and the options alone. What is left out for its work is decided by
//!   counting work, not by the clock, and is said. Times stand in fields of their own, named `timing`.
//! - What comes of times (the Pareto front, the cheapest setting) stands with them.
//!
//! | file | says |
//! |---|---|
//! | `analysis` | the ways to know how a mechanism can move |
//! | `all_engines` | the last two of them: the verdict and the whole report, which users wait for |
//! | `motion` | poses per second of a trace, by the tolerance of its samples |
//! | `simulation`, `work` | every setting of a simulation; how much work each is |
//! | `effects` | what gravity, contact and the like cost |
//! | `pareto`, `choose` | which settings no other one beats; which one reaches a wanted error soonest |
//! | `measure` | all of it, one after the other |
//! | `result`, `clock` | the result; how times are taken |
//!
//! # Cost
//! That of what is measured. A simulation of more than the [`Grid`]'s work is not run.
//!
//! Source of the picture: work–precision diagrams (Hairer, Nørsett, Wanner 1993, *Solving ordinary differential equations I*,
//! section II.10).

mod all_engines;
mod analysis;
mod choose;
mod clock;
mod effects;
mod measure;
mod motion;
mod pareto;
mod result;
mod simulation;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
mod work;

pub use choose::{Choice, ChoiceTiming, Chosen, choose};
pub use measure::{AccuracyError, AccuracyOptions, Stage, measure, measure_settings};
pub use pareto::pareto_front;
pub use result::{
    Accuracy, Claim, Driven, Effect, EffectTiming, Motion, MotionTiming, RunTiming, SCHEMA, Scene,
    SceneStep, Setting, Simulation, State, Traced, TracedTiming, Way, WayTiming,
};
pub use simulation::Grid;
pub(crate) use work::work_of_setting;
