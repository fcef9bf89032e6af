//! Rules 1 and 2 on one loop of pieces.

use super::chain::{Piece, swept};
use crate::group::{Gauge, GroupError, Margin, Subalgebra};

/// Longest loop, in pieces (every variable of a joint is one), that is cut at all pairs of places.
pub const LONGEST_SPLIT: usize = 18;

/// Why the configurations of a loop are a manifold with tangent space ker J.
#[derive(Clone, Debug)]
pub enum Proof {
    /// All pieces together are a submersion onto this subgroup.
    Whole(Subalgebra),
    /// Two chains are, each onto its own.
    Split {
        /// Where the first chain starts, and how many pieces it has; the other is the rest.
        start: usize,
        /// Number of pieces of the first chain.
        length: usize,
        /// The subgroup of the first chain.
        first: Subalgebra,
        /// The subgroup of the second chain.
        second: Subalgebra,
        /// What they have in common.
        common: Subalgebra,
    },
}

impl Proof {
    /// Independent equations of the loop.
    pub fn rank(&self) -> usize {
        match self {
            Self::Whole(group) => group.dimension(),
            Self::Split {
                first,
                second,
                common,
                ..
            } => first.dimension() + second.dimension() - common.dimension(),
        }
    }

    /// The worst margin it rests on.
    pub fn margin(&self) -> Margin {
        match self {
            Self::Whole(group) => group.margin(),
            Self::Split { common, .. } => common.margin(),
        }
    }
}

/// Looks for a proof. The pieces are in the order of the loop; where they start does not matter.
///
/// Cuts into chains of like length come first: they are the ones that explain.
pub fn prove(pieces: &[&Piece], gauge: &Gauge) -> Result<Option<Proof>, GroupError> {
    let count = pieces.len();
    if let Some(group) = swept(pieces.iter().copied(), gauge)? {
        return Ok(Some(Proof::Whole(group)));
    }
    if count > LONGEST_SPLIT {
        return Ok(None);
    }
    // Every pair of complementary arcs once: the one that holds the last piece is the second.
    let mut arcs: Vec<(usize, usize)> = (0..count)
        .flat_map(|start| (1..count - start).map(move |length| (start, length)))
        .collect();
    arcs.sort_by_key(|&(start, length)| ((2 * length).abs_diff(count), start, length));
    for (start, length) in arcs {
        let arc =
            |from: usize, number: usize| (from..from + number).map(move |i| pieces[i % count]);
        let Some(first) = swept(arc(start, length), gauge)? else {
            continue;
        };
        let Some(second) = swept(arc(start + length, count - length), gauge)? else {
            continue;
        };
        let common = first.intersection(&second)?;
        if super::clear(common.margin()) {
            return Ok(Some(Proof::Split {
                start,
                length,
                first,
                second,
                common,
            }));
        }
    }
    Ok(None)
}
