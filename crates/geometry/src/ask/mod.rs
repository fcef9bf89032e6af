//! A small language of questions about a world: terms with free names, conjunction, negation, comparisons.
//!
//! `parallel(?f, plate.face1)` answers with every entity that the function holds for, in the order of names; a goal that has no
//! free names is answered by itself. A [`Session`] runs scripts, whose lines may make new entities, and writes transcripts that
//! are scripts again.

mod call;
mod evaluate;
mod make;
mod parse;
mod session;
mod show;
mod solve;
mod term;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
mod value;

pub use session::{Reply, Session, Told, Transcript, TranscriptLine};
pub use show::Shown;
pub use solve::{Answers, Row};
