//! The precision of every independent sub-mechanism: which numbers bear on its loops.

use super::link::Placement;
use super::model::Mechanism;
use super::precision::{LiteralPlace, Precision};
use crate::graph::{Block, ConstraintGraph};
use kutzbach_math::number::Number;

/// The precisions of a mechanism's independent sub-mechanisms: the biconnected blocks of its constraint graph.
///
/// A sub-mechanism's numbers are read from the literals that bear on its own loops: those of its joints, and the places of its links
/// where no joint places them. What lies in no loop, such as the frame of a camera that is fixed to a link, bears on nothing.
#[derive(Clone, Debug, PartialEq, Default)]
pub(super) struct Precisions {
    /// Of the joints of each block's tree, and of those that close its loops.
    blocks: Vec<[Precision; 2]>,
    /// Index in `blocks` of every joint's, and which of the two; `None` for joints in no loop.
    of_joint: Vec<Option<(usize, usize)>>,
    together: Precision,
    /// That of what bears on nothing.
    exact: Precision,
}

impl Precisions {
    /// Those of a mechanism, of which everything else is known. Cost: near-linear.
    pub(super) fn of(mechanism: &Mechanism) -> Self {
        let loops: Vec<Block> = ConstraintGraph::of(mechanism)
            .blocks()
            .into_iter()
            .filter(|block| !block.bridge)
            .collect();
        let mut of_joint = vec![None; mechanism.joints.len()];
        for (index, block) in loops.iter().enumerate() {
            block
                .edges
                .iter()
                .for_each(|&joint| of_joint[joint] = Some((index, side_of(mechanism, joint))));
        }
        let blocks: Vec<[Precision; 2]> = loops
            .iter()
            .map(|block| {
                let [tree, closing] = [0, 1].map(|side| bearing(mechanism, block, side));
                Precision::of(tree, closing)
            })
            .collect();
        let mut all = blocks.iter().flatten();
        let first = all.next().copied().unwrap_or_default();
        Self {
            together: all.fold(first, Precision::with),
            blocks,
            of_joint,
            exact: Precision::default(),
        }
    }

    /// Those with every literal known to within this (m, rad).
    pub(super) fn known_to(mut self, uncertainty: f64) -> Self {
        let all = [&mut self.together, &mut self.exact];
        for precision in all.into_iter().chain(self.blocks.iter_mut().flatten()) {
            *precision = precision.known_to(uncertainty);
        }
        self
    }

    pub(super) fn together(&self) -> &Precision {
        &self.together
    }

    pub(super) fn of_joint(&self, joint: usize) -> &Precision {
        let of = self.of_joint.get(joint).copied().flatten();
        of.map_or(&self.exact, |(block, side)| &self.blocks[block][side])
    }

    /// Index of the independent sub-mechanism that a joint belongs to; `None` for joints in no loop.
    pub(super) fn block(&self, joint: usize) -> Option<usize> {
        let of = self.of_joint.get(joint).copied().flatten();
        of.map(|(block, _)| block)
    }
}

/// 0 for a joint of the tree, 1 for one that closes a loop.
fn side_of(mechanism: &Mechanism, joint: usize) -> usize {
    usize::from(mechanism.joints[joint].closes_loop)
}

/// The literals that bear on a block's loops, in file order: those of its tree (0), or of the joints that close loops (1).
fn bearing<'a>(
    mechanism: &'a Mechanism,
    block: &Block,
    side: usize,
) -> impl Iterator<Item = (LiteralPlace, &'a Number)> {
    let mut joints = block.edges.clone();
    joints.retain(|&joint| side_of(mechanism, joint) == side);
    joints.sort_unstable();
    let mut links = match side {
        0 => block.nodes.clone(),
        _ => Vec::new(),
    };
    links.sort_unstable();
    let placed = links.into_iter().flat_map(|link| {
        let frame = match &mechanism.links[link].placement {
            Placement::Floating { origin, .. } => Some(origin),
            _ => None,
        };
        let numbers = frame
            .into_iter()
            .flat_map(|frame| frame.position.iter().chain(&frame.roll_pitch_yaw));
        numbers
            .enumerate()
            .map(move |(place, number)| (LiteralPlace::Link(link, place), number))
    });
    let joints = joints.into_iter().flat_map(|joint| {
        let numbers = mechanism.joints[joint].numbers().into_iter().enumerate();
        numbers
            .filter_map(move |(place, number)| Some((LiteralPlace::Joint(joint, place), number?)))
    });
    placed.chain(joints)
}
