//! Simulation as a witness for what was predicted.
//!
//! # The problem
//! A physics engine moves a mechanism without knowing why it can move. What it shows is evidence, if one knows how to ask:
//! its joints are held by forces that give way a little, so that loops which do not fit turn all the same, and
//! constraints that repeat one another can block a loop which does fit.
//!
//! # What a result must satisfy
//! - A motion is *confirmed* only where the closure error falls at the order of the integration, the simulated mechanism
//!   keeps to the predicted branch, and the drive arrives. It says down to which size a defect would have been seen.
//! - It is *contradicted* where the error levels off, or the drive stalls while the loops stay closed.
//! - Rigidity is confirmed where every joint pushed in turn stays.
//! - Everything else is *inconclusive*, with the reason.
//! - Seeds, settings and errors are part of the result; wall-clock times are the only thing that differs between runs.
//!
//! # The way through
//! - [`verify`](fn@verify): which worlds are run for which prediction, and the outcome.
//! - [`DrivenMotion`]: such a stretch, simulated once with any settings.
//! - `driven_way`: along which stretch of a branch a drive goes; never through a singular pose.
//! - [`Prediction`]: the pose of the branch next to a simulated one.
//! - [`judge_motion`]: what a ladder of errors says.
//! - [`judge_pushing`]: what pushes of a rigid mechanism say.
//! - [`count_freedoms`]: the rank of the response to random impulses.
//! - `budget`: what may be simulated, counted in work.
//! - [`Beside`]: the prediction beside a scene.
//! - [`Observer`]: logs and progress bars look on.

mod beside;
mod budget;
mod closing;
mod driven_motion;
mod driven_way;
mod error;
mod excitation;
mod ladder;
mod observer;
mod prediction;
mod pushing;
mod scale;
mod verify;

pub use beside::Beside;
pub(crate) use budget::{Size, looped_variables};
pub use driven_motion::{DrivenMotion, DrivenRun};
pub use error::VerificationError;
pub use excitation::{FreedomCount, count_freedoms};
pub(crate) use ladder::{APART, FINE_ENOUGH, NEAR};
pub use ladder::{Finding, Outcome, Rung, defect, judge_motion, order_between, undecided};
pub use observer::{Moment, Observer, Passage, PredictedPose, Unobserved};
pub use prediction::{Prediction, distance_between};
pub use pushing::{PushRung, Pushing, judge_pushing};
pub use verify::{
    BranchVerification, Ladder, Verification, VerificationOptions, largest_gap, verify,
};
