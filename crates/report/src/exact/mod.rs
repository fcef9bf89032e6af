//! What the polynomials say, as data and as a page: `kutzbach exact`.

mod blocks;
mod conditions;
mod loopless;
mod motions;
mod proved;
mod relations;
mod schema;
mod text;
mod values;

pub use blocks::{BlockRow, BlocksReport, blocks_report, render_blocks};
pub(crate) use conditions::inequality;
pub use conditions::{
    ConditionRow, Conditions, FamilyRow, ReachRow, conditions_report, render_conditions,
};
pub use loopless::{LooplessReport, loopless_report, render_loopless};
pub use motions::Motion;
pub use proved::{Proved, proved};
pub use relations::{RelationRow, Relations, relations_report, render_relations};
pub use schema::{
    Cycle, EXACT_SCHEMA, ExactReport, Fixed, Modulo, Outcome, Piece, Request, Solutions, StepRow,
    exact_report,
};
pub use text::render;
pub use values::{FixedFreedom, FixedJoint};
