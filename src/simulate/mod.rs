//! A mechanism as a world of a physics engine.
mod build;
mod convert;
mod driven_way;
mod effects;
mod elementary;
mod error;
mod excitation;
mod forest;
mod inertia;
mod ladder;
mod observer;
mod options;
mod prediction;
mod pushing;
mod scale;
mod solids;
mod units;
mod verification;
mod verification_error;
mod world;

pub use error::WorldError;
pub use excitation::{FreedomCount, count_freedoms};
pub use ladder::{
    Finding, Outcome, Rung, defect, judge_motion, order_between, undecided,
};
pub use observer::{Moment, Observer, Passage, Unobserved};
pub use options::{Drive, Effects, Energy, JointGap, Note, Pieces, Solver, WorldOptions};
pub use prediction::Prediction;
pub use pushing::{PushRung, Pushing, judge_pushing};
pub use verification::{
    BranchVerification, Verification, VerificationOptions, largest_gap, verify,
};
pub use verification_error::VerificationError;
pub use world::World;
