//! The same question asked of every block by itself.
//!
//! Joints of different blocks have no equation in common (see [`kutzbach_model::graph`]): the solutions of the whole are all
//! combinations of theirs, and dimensions add up. So a number that keeps one block from being written as polynomials
//! keeps no other from it, and joints in no loop and no coupling are not asked about at all.
//!
//! A block is asked with all other joints put aside, which draws its links elsewhere, but together. Therefore nothing is
//! said here of directions.

use super::super::without_loops::{eliminated, rows};
use super::super::{Budget, HomePose, Relaxation, Stop, SystemError};
use super::{ExactAnswer, ExactOptions};
use kutzbach_model::graph::{Block, ConstraintGraph, CoupledBlock};
use kutzbach_model::mechanism::{JointId, Mechanism, Placement};

/// What is found of a block.
#[derive(Clone, Debug)]
pub enum BlockFinding {
    /// It has no loop: its couplings are linear, and this is the dimension of their solutions; `None` where they contradict
    /// one another.
    Linear(Option<usize>),
    /// It was written as polynomials.
    Answered {
        /// Complex dimension of its solutions; inside, `None` where there is none. Outside, where it was not reached.
        dimension: Option<Option<usize>>,
        /// The same at the drawn pose.
        at_home: Option<usize>,
        /// Whether the drawn pose is a solution; `None` where that is not known.
        home: Option<bool>,
        /// What the equations leave out; dimensions are then upper bounds.
        relaxations: Vec<Relaxation>,
        /// Angles read as rational rotations within their digits, since they are no algebraic ones as written: what is
        /// found is about these numbers.
        readings: usize,
        /// Where and why the computation ended early.
        stopped: Option<(&'static str, Stop)>,
    },
    /// It has no exact equations.
    Refused(SystemError),
    /// A coupling's number is not rational.
    Irrational,
}

/// A block and what is found of it.
#[derive(Clone, Debug)]
pub struct BlockAnswer {
    /// Its joints, by name.
    pub joints: Vec<JointId>,
    /// Its independent cycles.
    pub loops: usize,
    /// What is found.
    pub found: BlockFinding,
}

impl BlockAnswer {
    /// The dimension of its solutions, as far as it is proved to be just that; inside, `None` where there is none.
    #[must_use]
    pub fn dimension(&self) -> Option<Option<usize>> {
        match &self.found {
            BlockFinding::Linear(dimension) => Some(*dimension),
            BlockFinding::Answered {
                dimension,
                relaxations,
                readings: 0,
                ..
            } => dimension.filter(|_| relaxations.is_empty()),
            _ => None,
        }
    }
}

/// The answers of all blocks that have a loop or a coupling.
#[derive(Clone, Debug)]
pub struct ByBlocks {
    /// Block by block, in the order of [`ConstraintGraph::coupled_blocks`].
    pub blocks: Vec<BlockAnswer>,
    /// Freedoms of the joints in none of them, and six for each piece that no joint connects with the ground.
    pub free: usize,
}

/// Asks every block with a loop or a coupling by itself: for its dimension, and that at the drawn pose. The effort is shared
/// among them. Options that name joints or a configuration are not heeded.
#[must_use]
pub fn exact_by_blocks(mechanism: &Mechanism, options: &ExactOptions, budget: &Budget) -> ByBlocks {
    let graph = ConstraintGraph::of(mechanism);
    let simple = graph.blocks();
    let loops = |block: &CoupledBlock| -> usize {
        block.blocks.iter().map(|&b| simple[b].loop_count()).sum()
    };
    let (tied, single): (Vec<CoupledBlock>, Vec<CoupledBlock>) = graph
        .coupled_blocks()
        .into_iter()
        .partition(|block| loops(block) > 0 || !block.couplings.is_empty());
    let freedom = |block: &CoupledBlock| -> usize {
        let joints = block.edges.iter();
        joints
            .map(|&joint| mechanism.joints()[joint].freedom())
            .sum()
    };
    let count = tied.len();
    let blocks = tied.iter().enumerate().map(|(index, block)| {
        let loops = loops(block);
        let part = budget.with_share(1.0 / (count - index) as f64);
        let found = match loops {
            0 => linear(mechanism, block, freedom(block)),
            _ => asked(mechanism, block, &simple, options, &part),
        };
        budget.take_over(&part);
        BlockAnswer {
            joints: block.edges.iter().copied().map(JointId).collect(),
            loops,
            found,
        }
    });
    ByBlocks {
        blocks: blocks.collect(),
        free: single.iter().map(freedom).sum::<usize>() + 6 * (graph.components().len() - 1),
    }
}

fn linear(mechanism: &Mechanism, block: &CoupledBlock, freedom: usize) -> BlockFinding {
    let couplings = block.couplings.iter().map(|&c| &mechanism.couplings()[c]);
    let Some(rows) = rows(couplings) else {
        return BlockFinding::Irrational;
    };
    let (rank, consistent) = eliminated(rows);
    BlockFinding::Linear(consistent.then(|| freedom - rank))
}

/// Whether a block's links are drawn by its own joints, all but one: then they stay together wherever the others are.
fn drawn_by_itself(mechanism: &Mechanism, block: &Block) -> bool {
    let own = |&&link: &&usize| match &mechanism.links()[link].placement {
        Placement::Joint(joint) => block.edges.contains(&joint.0),
        _ => false,
    };
    block.nodes.iter().filter(own).count() + 1 == block.nodes.len()
}

fn asked(
    mechanism: &Mechanism,
    block: &CoupledBlock,
    simple: &[Block],
    options: &ExactOptions,
    budget: &Budget,
) -> BlockFinding {
    let joints: Vec<JointId> = block.edges.iter().copied().map(JointId).collect();
    let alone = block
        .blocks
        .iter()
        .all(|&b| drawn_by_itself(mechanism, &simple[b]));
    let put_aside = alone.then(|| mechanism.with_others_put_aside(&joints));
    let mechanism = put_aside.as_ref().unwrap_or(mechanism);
    let mut options = options.clone();
    options.system.joints = Some(joints.clone());
    options.system.configuration = None;
    if let Err(stop) = budget.check() {
        return BlockFinding::Answered {
            dimension: None,
            at_home: None,
            home: None,
            relaxations: Vec::new(),
            readings: 0,
            stopped: Some(("the equations", stop)),
        };
    }
    let written = ExactAnswer::unasked(mechanism, &options).map(|answer| (answer, 0));
    let written = written.or_else(|error| {
        let (nearby, count) = mechanism.with_rational_rotations(&joints);
        match ExactAnswer::unasked(&nearby, &options) {
            Ok(answer) if count > 0 => Ok((answer, count)),
            _ => Err(error),
        }
    });
    let (mut answer, readings) = match written {
        Ok(written) => written,
        Err(error) => return BlockFinding::Refused(error),
    };
    answer.stopped = answer.find_whole(mechanism, &options, budget).err();
    BlockFinding::Answered {
        dimension: answer.dimension,
        at_home: answer.dimension_at_home(),
        home: match answer.system.home {
            HomePose::Exact(_) => Some(true),
            HomePose::Open { .. } => Some(false),
            _ => None,
        },
        relaxations: answer.system.relaxations,
        readings,
        stopped: answer.stopped,
    }
}
