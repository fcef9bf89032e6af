//! A mechanism with other values of its measures: which of them move, which lock, which are singular.
//!
//! # The problem
//! A file that names its measures (`<xacro:property name="a" value="0.52"/>`) describes a family of mechanisms. A sweep asks the
//! same question of many members, and tells the answers in one table, a row for each.
//!
//! # What holds
//! * A row depends on the file, the values of its measures and the question, and on nothing else: not on the order in which
//!   rows are computed, nor on how the work is shared out.
//! * Values from ranges are exact fractions, and the file's reader is given them as such: a step of 0.005 is 1/200, with no digit to
//!   be rounded. What `--set a=1/200` says of a single file, the row says.
//! * A member that is no mechanism, or that does not assemble, is a row with its reason. Nothing ends a sweep but its end.
//! * Numbers of variants are found without those before them, so that shares of a sweep need not know one another.
//!
//! # What it costs
//! A file that uses named numbers and no more of xacro is parsed once ([`Family::members`]). Where these stand in frames and axes of joints
//! only, members differ in numbers only: the mechanism is built once, with its structure and the count at random geometry, and other numbers
//! are put into it for each. Where not, it is built for each; any other file is read from memory for each. Each member is analysed by itself.
//!
//! ```
//! # mod kutzbach { pub use kutzbach_report::sweep; pub use kutzbach_mobility as mobility; }
//! use kutzbach::mobility::{AnalysisOptions, Depth};
//! use kutzbach::sweep::{Family, MeasuredFile, Over, Plan};
//!
//! let text = r#"
//! <robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
//!   <xacro:property name="length" value="1"/>
//!   <link name="base"/> <link name="arm"/>
//!   <joint name="hinge" type="revolute">
//!     <parent link="base"/> <child link="arm"/> <origin xyz="${length} 0 0"/> <axis xyz="0 0 1"/>
//!   </joint>
//! </robot>"#;
//! let plan = Plan::new(vec![Over::read("length=0..1:5")?], None)?;
//! let options = AnalysisOptions { depth: Depth::Verdict, ..AnalysisOptions::default() };
//! let family = Family::new(MeasuredFile::of_text(text, "arm.urdf"), plan, options).unwrap();
//! let row = family.row(1).unwrap();
//! assert_eq!(row.values[0].shown, "0.25");
//! assert_eq!(row.outcome.facts.finite, Some(1));
//! # Ok::<(), kutzbach::sweep::SweepError>(())
//! ```

mod border;
mod family;
mod fraction;
mod lines;
mod outcome;
mod plan;
mod points;
mod values;

pub use border::{Border, Side};
pub use family::{Family, MeasuredFile, Members, Row};
pub use fraction::Fraction;
#[cfg(feature = "simulate")]
pub(crate) use lines::csv_cells;
pub use lines::{Form, SWEEP_SCHEMA, Table};
pub use outcome::{Facts, Outcome, Status, outcome};
pub use plan::{Asked, Plan, Sample, Shard};
pub use points::{SOBOL_DIMENSIONS, Sobol, random_parts};
pub use values::{Over, Range, SweepError, Value, Values};
