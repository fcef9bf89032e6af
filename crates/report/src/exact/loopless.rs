//! The exact report on a mechanism without loops.

use super::schema::{EXACT_SCHEMA, Outcome, Request};
use crate::text::words::counted;
use crate::text::{Layout, Page, Tint};
use kutzbach_algebra::WithoutLoops;
use kutzbach_model::mechanism::Mechanism;
use serde::Serialize;

/// What is proved of a mechanism without loops; the fields of [`super::ExactReport`] that mean something here.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LooplessReport {
    /// [`EXACT_SCHEMA`].
    pub schema: &'static str,
    /// The mechanism.
    pub mechanism: String,
    /// The file.
    pub file: String,
    /// Always `linear`: no polynomials are needed.
    pub formulation: &'static str,
    /// Names of the joint variables.
    pub variables: Vec<String>,
    /// Number of equations: one for each coupling.
    pub equation_count: usize,
    /// How many of them are independent.
    pub rank: usize,
    /// Always done.
    pub outcome: Outcome,
    /// Dimension of the solutions, at every pose; `null` where the couplings contradict one another.
    pub dimension: Option<usize>,
}

/// The report on a mechanism without loops.
#[must_use]
pub fn loopless_report(
    mechanism: &Mechanism,
    found: &WithoutLoops,
    request: &Request,
) -> LooplessReport {
    let joints = mechanism.joints().iter();
    LooplessReport {
        schema: EXACT_SCHEMA,
        mechanism: mechanism.name().to_owned(),
        file: request.file.clone(),
        formulation: "linear",
        variables: joints
            .flat_map(|joint| (0..joint.freedom()).map(|freedom| joint.freedom_name(freedom)))
            .collect(),
        equation_count: found.couplings,
        rank: found.rank,
        outcome: Outcome {
            word: "done",
            at: None,
            why: None,
        },
        dimension: found.dimension,
    }
}

/// The same as a page of text, ending in a line break.
#[must_use]
pub fn render_loopless(report: &LooplessReport, layout: Layout) -> String {
    let mut page = Page::new(layout);
    let headline = match report.dimension {
        Some(dimension) => format!(
            "The solutions have dimension {dimension}, at every pose, over the real and the complex numbers."
        ),
        None => "There are no solutions: the couplings contradict one another.".to_owned(),
    };
    page.paragraph(&headline, Tint::Strong, "", "");
    let why = match report.equation_count {
        0 => "there is no loop and no coupling: nothing ties the joints, and there is no equation to solve".to_owned(),
        couplings => format!(
            "there is no loop: the only equations are those of {}, which are linear, and {} of them independent; their \
             numbers were taken as fractions",
            counted(couplings, "coupling"),
            match report.rank {
                1 => "1 is".to_owned(),
                rank => format!("{rank} are"),
            }
        ),
    };
    page.item(&why, Tint::Plain);
    page.gap();
    page.paragraph(
        &format!(
            "{} ({}): {} and {}; no polynomials are needed (`--print equations` or `--variables` writes them all the same).",
            report.mechanism,
            report.file,
            counted(report.variables.len(), "variable"),
            counted(report.equation_count, "equation"),
        ),
        Tint::Plain,
        "",
        "",
    );
    page.into_text()
}
