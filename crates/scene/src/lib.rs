//! Motions as MCAP logs, for viewers and for programs.
//!
//! A log has to show the mechanism to somebody who has nothing but the log, in any viewer that knows the common message
//! types; it has to say the same numbers to a program; and it has to be the same bytes for the same input, so that it can
//! be compared. Hence:
//!
//! - message types and their schemas are those of the foxglove crate, in Protobuf; the container is written record by
//!   record with the mcap crate. No clock is read: times are those of the motion, starting at zero.
//! - The predicted and the simulated motion are two trees of frames below `world`, `predicted/…` and `simulated/…`. Shapes
//!   are fixed to the links' frames, so that the scene is said once and `/tf` alone moves it.
//! - What moves is on other topics than what is said once: a viewer that jumps to a time asks for the last message of
//!   every topic before it, and has the whole picture.
//! - The file appears under its name when it is complete ([`LogFile`]). Chunks are closed every few moments and written as
//!   a whole: what a crash leaves is readable up to the last of them.
//!
//! [`Drawing`] turns a mechanism into plain coloured solids; it knows nothing of logs.
//!
//! Cost: linear in the number of links, joints and moments; about 130 bytes per link, motion and moment. Memory stays at one chunk
//! however long the log.

mod appearance;
#[cfg(feature = "logs")]
mod attachments;
#[cfg(feature = "logs")]
mod channels;
#[cfg(feature = "logs")]
mod error;
mod joint_symbols;
mod link_shapes;
#[cfg(feature = "logs")]
mod log_file;
#[cfg(feature = "logs")]
mod messages;
#[cfg(feature = "logs")]
mod names;
#[cfg(feature = "logs")]
mod predicted_motion;
#[cfg(feature = "logs")]
mod recorder;
#[cfg(feature = "logs")]
mod robot_description;
mod roles;
#[cfg(feature = "logs")]
mod scene;
mod shapes;
mod vectors;

pub use appearance::{AXIS, Colour, GAP, GROUND, LABEL, Role, Roles, joint_colour, link_colour};
#[cfg(feature = "logs")]
pub use error::RecordError;
#[cfg(feature = "logs")]
pub use log_file::LogFile;
#[cfg(feature = "logs")]
pub use messages::{Closure, ClosureError, Estimate, Gap, JointClosure, Level, Motion, Prediction};
#[cfg(feature = "logs")]
pub use names::{Stream, frame_id, readable};
#[cfg(feature = "logs")]
pub use predicted_motion::{record_motion, values_of};
#[cfg(feature = "logs")]
pub use recorder::{Header, Recorder, Summary, WORLD};
#[cfg(feature = "logs")]
pub use robot_description::robot_description;
pub use shapes::{Drawing, Part, Primitive, Shape};
