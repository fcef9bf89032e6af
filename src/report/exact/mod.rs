//! What the polynomials say, as data and as a page: `kutzbach exact`.

mod conditions;
mod motions;
mod relations;
mod schema;
mod text;
mod values;

pub use conditions::{ConditionRow, Conditions, FamilyRow, conditions_report, render_conditions};
pub use motions::Motion;
pub use relations::{RelationRow, Relations, relations_report, render_relations};
pub use schema::{
    Cycle, EXACT_SCHEMA, ExactReport, Fixed, Modulo, Outcome, Piece, Request, Solutions, StepRow,
    exact_report,
};
pub use text::render;
pub use values::{FixedFreedom, FixedJoint};
