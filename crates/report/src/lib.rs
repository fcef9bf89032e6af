//! What a person or a program reads.
//!
//! # The problem
//! An analysis ends in numbers, names and proofs. Three readers want them: an engineer who looks at one screen and acts, a
//! program that looks up one field, and a test that compares them with what is known. They must never be told different
//! things, and none of them should have to know how the numbers were found.
//!
//! # What holds
//! * [`Report`] is the only source. Text is rendered from a report and from nothing else, so a report read back from JSON
//!   gives the same page, and no fact exists in one form only.
//! * A field that has not been decided is absent (`null`), never zero. "Not decided yet" and "none" differ everywhere:
//!   a mechanism without branches is an isolated assembly, one whose branches are `null` has not been looked at.
//! * Lists are in natural order of names ([`natural_order`]), not in file order; numbers of a run (times) are left out
//!   unless asked for. The same mechanism gives the same bytes.
//! * Names come from files and may hold anything: text makes control characters visible instead of obeying them.
//!
//! # What it costs
//! Everything here is linear in the size of the report, except sorting names.
//!
//! # Where to look
//! | file | what it answers |
//! |---|---|
//! | `schema` | which fields there are; their words are those of `mobility` |
//! | `assembly` | how the loops closed; the file that holds the pose found |
//! | `assemble` | how a mechanism and its analysis become a report |
//! | `extras` | what a report holds only where it was asked for: pairs of links, evidence |
//! | `inputs` | useful and idle freedoms, inputs and limbs |
//! | `play` | the play that joints need where dimensions as written bind |
//! | `pose` | limits, dead centres and singular poses nearby, for the warnings |
//! | `ranges` | how far joints go, and pitches over a whole cycle |
//! | `text` | how a report becomes a page |
//! | `expectation`, `expected_file` | whether a report agrees with what is known |
//! | `html` | how a report becomes a page that moves |
//! | `accuracy` | what every way to an answer costs, as a page and as a figure |
//! | `exact` | what the polynomials say, as data and as a page |
//! | `convert` | the mechanism in the words of other programs |
//! | `picture` | plots, the mechanism drawn, a sign for each answer: still, as SVG |
//! | `sweep` | the same question of many members of a family, a row for each |
//! | `traced`, `simulated` | a traced motion, and what a simulation said, as data |
//! | `map` | a sweep as a picture over two of its measures |
//! | `definitions` | what a word means |

#[cfg(feature = "simulate")]
pub mod accuracy;
mod asked;
mod assemble;
mod assembly;
mod change_sets;
pub mod convert;
pub mod definitions;
pub mod exact;
mod expectation;
mod expected_file;
mod extras;
mod findings;
#[cfg(feature = "html")]
pub mod html;
mod inputs;
#[cfg(feature = "simulate")]
pub mod map;
mod misfits;
mod motions;
mod natural;
#[cfg(feature = "simulate")]
pub mod picture;
mod play;
mod pose;
mod ranges;
#[cfg(test)]
#[allow(clippy::wildcard_imports)]
pub(crate) mod samples;
mod schema;
#[cfg(feature = "simulate")]
pub mod simulated;
pub mod sweep;
pub mod text;
#[cfg(feature = "simulate")]
pub mod traced;

pub use asked::{Options, PlayAsked, ReportDepth, ReportError};
pub use assemble::{Input, analysed_report, analysed_report_on, report, report_on};
pub use assembly::{ASSEMBLED, assembled_file};
pub use change_sets::{ChangeSets, Component, JointReplacement, PartChanges, RedundantDirection};
pub use expectation::{Comparison, Disagreement, compare};
pub use expected_file::{ExpectedFile, ExpectedFileError};
pub use kutzbach_mobility::{
    CertificateLevel, MobilityClass, PoseKind, RelationKind, SingularKind, Verdict,
};
pub use kutzbach_motion::{FourBar, FourBarKind, GrashofClass, Swing};
pub use misfits::misfits;
pub use natural::natural_order;
pub use schema::{
    Advice, Assembly, Block, Branch, Certificate, Constants, CouplingRow, Cycle, DependentInput,
    Evidence, Follower, Freedoms, Gap, GenericCount, Home, Idle, InputSource, Inputs, JointPlace,
    JointPlay, JointRange, JointRow, Limb, LiteralReading, Misfit, Mobility, Motion, Nominal,
    OutsideLimit, Play, Relation, Report, Reversal, SCHEMA, Size, Source, Stage, Timing, Tree,
    TreeLink, Warning, WarningKind, WarningPlace,
};
