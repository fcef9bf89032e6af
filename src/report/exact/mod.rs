//! What the polynomials say, as data and as a page: `kutzbach exact`.

mod motions;
mod schema;
mod text;
mod values;

pub use motions::Motion;
pub use schema::{
    ConditionRow, Conditions, Cycle, EXACT_SCHEMA, ExactReport, FamilyRow, Fixed, Modulo, Outcome,
    Piece, RelationRow, Relations, Request, Solutions, StepRow, conditions_report, exact_report,
    relations_report,
};
pub use text::{render, render_conditions, render_relations};
pub use values::{FixedFreedom, FixedJoint};
