//! Why a world cannot be made or stepped.

use thiserror::Error;

/// What stops a simulation.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum WorldError {
    /// Options that no world can be stepped with.
    #[error("{0}")]
    Options(String),
    /// Not one state for every joint.
    #[error("a start pose needs one state for each of the {wanted} joints, but {given} were given")]
    States {
        /// Joints of the mechanism.
        wanted: usize,
        /// States given.
        given: usize,
    },
    /// A number of the start pose, or one computed from it, is not finite or too large to compute with.
    #[error("{what} of `{name}` is not a number to compute with")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// The link or joint.
        name: String,
    },
    /// A drive, push or twist that names nothing of this world or is not finite.
    #[error("{0}")]
    Command(String),
    /// The simulated motion left the range of numbers.
    #[error("link `{link}` left the range of numbers at {time} s")]
    Diverged {
        /// The first link, in file order, whose pose or velocity is not finite.
        link: String,
        /// Simulated time at the end of the step (s).
        time: f64,
    },
    /// The physics engine refused a joint.
    #[error("the physics engine refused joint `{0}`")]
    Refused(String),
}
