//! The exact report block by block, for mechanisms of which not everything has exact equations.

use super::schema::{EXACT_SCHEMA, Outcome, Request};
use crate::text::words::{counted, names};
use crate::text::{Layout, Page, Tint};
use kutzbach_algebra::{BlockAnswer, BlockFinding, ByBlocks, SystemError};
use kutzbach_model::mechanism::Mechanism;
use serde::Serialize;

/// Joints of a block that are named.
const NAMED: usize = 3;

/// What is said of a block.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BlockRow {
    /// Its joints.
    pub joints: Vec<String>,
    /// Its independent cycles.
    pub loops: usize,
    /// `proved`; `bound`: its dimension is an upper bound; `nearby`: it is that of numbers nearby; `undecided`; or
    /// `refused`.
    pub answer: &'static str,
    /// Its dimension, as `answer` says; `null` where there is none to tell.
    pub dimension: Option<usize>,
    /// The same at the drawn pose.
    pub dimension_at_home: Option<usize>,
    /// The same in words, and why.
    pub text: String,
}

/// What is proved of a mechanism, block by block.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BlocksReport {
    /// [`EXACT_SCHEMA`].
    pub schema: &'static str,
    /// The mechanism.
    pub mechanism: String,
    /// The file.
    pub file: String,
    /// Always `by block`.
    pub formulation: &'static str,
    /// Its word is `in part` where blocks were refused or stay undecided.
    pub outcome: Outcome,
    /// Dimension of all solutions; `null` where some block is not decided, or where there is no solution.
    pub dimension: Option<usize>,
    /// Freedoms of the joints in no loop and no coupling, and six for each piece that no joint connects with the ground.
    pub free: usize,
    /// The blocks.
    pub blocks: Vec<BlockRow>,
    /// Whether the file's decimals were taken as exact fractions although they look rounded.
    pub rounded_numbers_taken_literally: bool,
}

/// The report block by block.
#[must_use]
pub fn blocks_report(mechanism: &Mechanism, found: &ByBlocks, request: &Request) -> BlocksReport {
    let row = |block| row(mechanism, block);
    let blocks: Vec<BlockRow> = found.blocks.iter().map(row).collect();
    let proved = blocks.iter().all(|row| row.answer == "proved");
    let parts: Option<usize> = blocks.iter().map(|row| row.dimension).sum();
    let stop = found.blocks.iter().find_map(|block| match &block.found {
        BlockFinding::Answered {
            dimension: None,
            stopped,
            ..
        } => *stopped,
        _ => None,
    });
    BlocksReport {
        schema: EXACT_SCHEMA,
        mechanism: mechanism.name().to_owned(),
        file: request.file.clone(),
        formulation: "by block",
        outcome: Outcome {
            word: if proved { "done" } else { "in part" },
            at: stop.map(|(at, _)| at),
            why: stop.map(|(_, why)| why.to_string()),
        },
        dimension: parts.filter(|_| proved).map(|d| d + found.free),
        free: found.free,
        blocks,
        rounded_numbers_taken_literally: !mechanism.precision().is_exact(),
    }
}

/// What exact algebra cannot say of rounded numbers, another command can.
const ASK: &str = "`report` gives the verdict within the digits";

fn row(mechanism: &Mechanism, block: &BlockAnswer) -> BlockRow {
    let rounded = !mechanism.is_exact(block.joints.iter().map(|joint| &joint.0));
    let (answer, dimension, text) = said(&block.found, rounded);
    let name = |joint: &kutzbach_model::mechanism::JointId| mechanism.joint(*joint).name.clone();
    BlockRow {
        joints: block.joints.iter().map(name).collect(),
        loops: block.loops,
        answer,
        dimension,
        dimension_at_home: match &block.found {
            BlockFinding::Answered {
                at_home,
                readings: 0,
                ..
            } => at_home.filter(|_| dimension.is_some()),
            _ => None,
        },
        text,
    }
}

fn said(found: &BlockFinding, rounded: bool) -> (&'static str, Option<usize>, String) {
    let (dimension, home, relaxations, readings, stopped) = match found {
        BlockFinding::Linear(Some(d)) => {
            return (
                "proved",
                Some(*d),
                format!("dimension {d}, by its couplings, which are linear"),
            );
        }
        BlockFinding::Linear(None) => {
            let text = "no solution: its couplings contradict one another";
            return ("proved", None, text.to_owned());
        }
        BlockFinding::Irrational => {
            let text = "not answered: a coupling is not linear, or a number of it is no fraction";
            return ("refused", None, text.to_owned());
        }
        BlockFinding::Refused(error) => {
            return (
                "refused",
                None,
                format!("not answered: {}; {ASK}", brief(error)),
            );
        }
        BlockFinding::Answered {
            dimension,
            home,
            relaxations,
            readings,
            stopped,
            ..
        } => (*dimension, *home, relaxations, *readings, stopped),
    };
    let Some(dimension) = dimension else {
        let why = stopped.map_or_else(
            || "no basis was found".to_owned(),
            |(at, stop)| format!("stopped at {at}: {stop}"),
        );
        return ("undecided", None, format!("undecided: {why}"));
    };
    let reading = match readings {
        0 => String::new(),
        1 => "1 angle read as a rational rotation within its digits: ".to_owned(),
        n => format!("{n} angles read as rational rotations within their digits: "),
    };
    // Overdetermined equations of rounded numbers have fewer solutions than those that were meant.
    if (rounded || readings > 0) && matches!(dimension, None | Some(0)) {
        let left = match dimension {
            None => "contradict one another",
            Some(_) => "leave finitely many poses",
        };
        let text = format!(
            "undecided: {reading}taken literally the decimals {left}, which need not hold of the mechanism meant; {ASK}"
        );
        return ("undecided", None, text);
    }
    let mut text = match dimension {
        None => "no solution: its equations contradict one another".to_owned(),
        Some(d) => format!("complex dimension {d}"),
    };
    let mut answer = "proved";
    if readings > 0 {
        answer = "nearby";
        let these = "the answer is about these numbers, not proved of those meant";
        text = format!("{text}; {reading}{these}");
    }
    if let Some(relaxation) = relaxations.first() {
        answer = if readings > 0 { answer } else { "bound" };
        text = format!("{text} at most: {relaxation}");
    }
    if home == Some(false) && readings == 0 {
        text = format!("{text}; the pose drawn does not satisfy its equations exactly");
    }
    (answer, dimension, text)
}

/// Why there are no exact equations, without the advice on how to write the number, which fills a line of its own.
fn brief(error: &SystemError) -> String {
    match error {
        SystemError::NotAlgebraic {
            entity,
            element,
            number,
            kind,
            ..
        } => format!("{entity}, {element}: {number} is {kind}"),
        other => other.to_string(),
    }
}

/// The same as a page of text, ending in a line break.
#[must_use]
pub fn render_blocks(report: &BlocksReport, layout: Layout) -> String {
    let mut page = Page::new(layout);
    let rows = &report.blocks;
    let answered = rows.iter().filter(|row| row.answer == "proved").count();
    let literally = match report.rounded_numbers_taken_literally {
        true => ", the decimals taken literally",
        false => "",
    };
    let headline = match report.dimension {
        Some(dimension) => {
            format!("The solutions have complex dimension {dimension}{literally}.")
        }
        None if rows
            .iter()
            .any(|r| r.answer == "proved" && r.dimension.is_none()) =>
        {
            "There are no solutions: a part contradicts itself.".to_owned()
        }
        None if rows.iter().all(|r| r.dimension.is_none()) => {
            "Undecided: no part with loops or couplings has an answer.".to_owned()
        }
        None => format!(
            "Answered in part: {answered} of {} proved{literally}.",
            counted(rows.len(), "part")
        ),
    };
    page.paragraph(&headline, Tint::Strong, "", "");
    for row in rows {
        let name = names(&row.joints, NAMED);
        let loops = match row.loops {
            0 => String::new(),
            loops => format!(" ({})", counted(loops, "loop")),
        };
        let tint = match row.answer {
            "proved" => Tint::Plain,
            "bound" | "nearby" => Tint::Notable,
            _ => Tint::Doubtful,
        };
        page.item(&format!("{name}{loops}: {}", row.text), tint);
    }
    if report.free > 0 {
        let other = format!(
            "{} in no loop and no coupling: nothing ties them",
            counted(report.free, "freedom")
        );
        page.item(&other, Tint::Plain);
    }
    page.gap();
    page.paragraph(
        &format!(
            "{} ({}), asked block by block: the solutions of the whole are all combinations of theirs, and dimensions add up.",
            report.mechanism, report.file
        ),
        Tint::Quiet,
        "",
        "",
    );
    page.into_text()
}
