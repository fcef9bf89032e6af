//! Predicted motion.

mod curve;
mod cusp;
mod dead_centres;
mod deflation;
mod follow;
mod inputs;
mod ranges;
mod result;
mod rows;
mod sampling;
mod singular;
mod solver;
mod sparse_rows;
mod system;
mod trace;
mod walk;
mod wishes;

pub use curve::{Curve, CurvePose};
pub use inputs::Variable;
pub use result::{
    End, EndReason, Event, EventKind, Held, Motion, Range, Sample, Spacing, Still, Trace,
    TraceError, TraceOptions, Unreached,
};
pub use system::{Evaluation, LoopSystem, SystemPose};
pub use trace::trace;
pub use wishes::variable_named;
