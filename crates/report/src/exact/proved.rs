//! What is proved of a mechanism, as the report that fits it.

use super::blocks::{BlocksReport, blocks_report};
use super::loopless::{LooplessReport, loopless_report};
use super::schema::{ExactReport, Request, exact_report};
use kutzbach_algebra::{
    BlockAnswer, BlockFinding, Budget, Stop, SystemError, exact_answer, exact_by_blocks,
    without_loops,
};
use kutzbach_model::graph::ConstraintGraph;
use kutzbach_model::mechanism::Mechanism;
use serde::Serialize;

/// Mechanisms of more blocks with loops than these are asked block by block from the start: the equations of all at once
/// soon take longer than those of each.
const BLOCKS_AT_ONCE: usize = 3;

/// One of three reports; as data it is that report.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Proved {
    /// On a mechanism without loops.
    Loopless(LooplessReport),
    /// On the whole.
    Whole(Box<ExactReport>),
    /// Block by block.
    Blocks(BlocksReport),
}

/// Asks for the answer, and says what ended the computation early, if anything did. If `plain`, nothing is asked but the answer, in
/// whatever form it has; otherwise the whole is asked in the form of the request.
///
/// # Errors
/// [`SystemError`] where neither the whole nor, if `plain`, any block has exact equations.
pub fn proved(
    mechanism: &Mechanism,
    request: &Request,
    plain: bool,
    budget: &Budget,
) -> Result<(Proved, Option<Stop>), SystemError> {
    if let Some(found) = without_loops(mechanism).filter(|_| plain) {
        let report = loopless_report(mechanism, &found, request);
        return Ok((Proved::Loopless(report), None));
    }
    if plain && blocks_with_loops(mechanism) > BLOCKS_AT_ONCE {
        return by_blocks(mechanism, request, budget);
    }
    let answer = match exact_answer(mechanism, &request.options, budget) {
        Ok(answer) => answer,
        Err(_) if plain => return by_blocks(mechanism, request, budget),
        Err(error) => return Err(error),
    };
    let report = exact_report(mechanism, &answer, request);
    let stopped = answer.stopped.map(|(_, stop)| stop);
    Ok((Proved::Whole(Box::new(report)), stopped))
}

/// The blocks that have exact equations, where the whole has none; an error where that leaves nothing.
fn by_blocks(
    mechanism: &Mechanism,
    request: &Request,
    budget: &Budget,
) -> Result<(Proved, Option<Stop>), SystemError> {
    let found = exact_by_blocks(mechanism, &request.options, budget);
    let refused = |block: &BlockAnswer| matches!(block.found, BlockFinding::Refused(_));
    if let Some(BlockAnswer {
        found: BlockFinding::Refused(error),
        ..
    }) = found.blocks.first()
        && found.blocks.iter().all(refused)
    {
        return Err(error.clone());
    }
    let report = blocks_report(mechanism, &found, request);
    let stopped = found.blocks.iter().find_map(|block| match &block.found {
        BlockFinding::Answered { stopped, .. } => stopped.map(|(_, stop)| stop),
        _ => None,
    });
    Ok((Proved::Blocks(report), stopped))
}

fn blocks_with_loops(mechanism: &Mechanism) -> usize {
    let blocks = ConstraintGraph::of(mechanism).blocks();
    blocks.iter().filter(|block| !block.bridge).count()
}
