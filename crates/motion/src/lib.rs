//! Predicted motion: a branch of the configuration space, followed as a curve.
//!
//! [`kutzbach_mobility`] says that a mechanism moves; here is how. The poses of a branch of dimension one are a curve in the
//! space of all joint variables; of a branch of dimension d, holding d − 1 joint variables leaves one. [`trace()`] follows
//! it both ways from home, or from a generic pose of the branch where home is singular, until it comes back, meets a joint
//! limit of the file, or has been followed far enough.
//!
//! What the result satisfies:
//! - every pose closes all loops to rounding, 1e-12 of a loop's length at most, and lies on the branch that was asked for,
//!   also behind singular poses, which are passed by interpolation from both sides and never solved at;
//! - what is met on the way (dead centres, joint limits, singular poses, cusps) is located to 1e-10, as far as the margin
//!   of the equations beside it allows;
//! - the same file gives the same bytes, and the order of its joints changes nothing but rounding.
//!
//! | file | says |
//! |---|---|
//! | `system`, `system/…` | the equations of a part, compiled ([`LoopSystem`]); its poses, values and derivatives |
//! | `rows`, `sparse_rows`, `deflation`, `solver` | which equations are solved at a pose, and Newton's method on them |
//! | `node`, `cubic`, `follow` | a pose with its tangent, what lies between two, from pose to pose |
//! | `cusp`, `singular`, `bridge`, `pieces`, `walk` | cusps and singular poses, how they are passed, the whole curve |
//! | `curve`, `at_drive`, `dense_output` | poses by arclength and by drive value ([`Curve`]), many of a segment by a polynomial |
//! | `dead_centres`, `ranges`, `pitch`, `sampling` | what is read off a curve |
//! | `four_bar`, `four_bar/…` | Grashof's class, swings and transmission angles of four-bars ([`four_bars()`]) |
//! | `inputs`, `requested` | what is driven and held |
//! | `approach` | the pose where joints have given values, along the branch drawn ([`approach()`]) |
//! | `play`, `play/…` | the play that joints need where dimensions as written bind ([`play()`]) |
//! | `words` | what is met and where it ends, for people |
//! | `trace`, `trace/…` | from an analysis to a [`Trace`]: where a part starts, which curve serves, what is told of it |
//!
//! Cost: one pose of a single loop takes some microseconds; dense factorizations grow with the cube of a part's unknowns
//! up to 150, sparse ones serve beyond.

mod approach;
mod at_drive;
mod bridge;
mod cubic;
mod curve;
mod cusp;
mod dead_centres;
mod deflation;
mod dense_output;
mod follow;
mod four_bar;
mod inputs;
mod links;
mod node;
mod pieces;
mod pitch;
mod play;
mod ranges;
mod requested;
mod result;
mod rows;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod samples;
mod sampling;
mod shown;
mod singular;
mod solver;
mod sparse_rows;
mod system;
mod trace;
mod vectors;
mod walk;
mod words;

pub use approach::{NotReached, approach};
pub use curve::{Curve, CurvePose};
pub use four_bar::{FourBar, FourBarKind, GrashofClass, Swing, four_bars};
pub use inputs::Variable;
pub use play::{Deviation, NoPlay, Play, PlayOptions, play};
pub use requested::variable_named;
pub use result::{
    End, EndReason, Event, EventKind, Held, Motion, Range, Sample, Spacing, Still, Trace,
    TraceError, TraceOptions, Unreached,
};
pub use system::{Evaluation, LoopSystem, SystemPose};
pub use trace::{InputSource, Inputs, inputs, trace};
pub use words::value_text;
