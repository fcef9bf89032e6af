//! Features that a text declares, found in the boundaries of parts, and in parts with round faces.
//!
//! A declaration says which faces and edges a feature is made of, of what type they are, how they are connected and oriented, and
//! in which order to look for them. It is compiled to a plan ([`Declaration::plan`]) over a table of tuples, one column for each
//! role; steps fill columns or strike rows out, and what is left are the features ([`Declaration::extract`]).

mod declare;
mod parse;
mod part;
mod plan;
mod round_part;
#[cfg(test)]
mod round_tests;
mod table;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;

pub use declare::{Bend, Condition, Declaration, Orientation, Role, Sort, Type};
pub use parse::read_declarations;
pub use part::Part;
pub use plan::{Action, Plan, PlanStep};
pub use round_part::{RoundEdge, RoundFace, RoundPart, Shape};
pub use table::{Extraction, Feature, FeatureError, StepTold};
