//! Why the configurations of one loop of pieces are a manifold with tangent space ker J.

use super::chain::{Piece, freedom, may_close, span, swept, swept_by};
use super::clear;
use kutzbach_math::group::{Gauge, GroupError, Margin, Subalgebra};
use std::collections::BTreeMap;

/// Loops of more places to cut them are not cut.
pub const MOST_CUTS: usize = 20;

/// Some pieces of a loop that are a submersion onto a subgroup.
#[derive(Clone, Debug)]
pub struct Arc {
    /// Positions of the pieces in the loop.
    pub pieces: Vec<usize>,
    /// The subgroup.
    pub group: Subalgebra,
}

/// The proof that a loop's configurations are a manifold with tangent space ker J.
#[derive(Clone, Debug)]
pub enum Proof {
    /// All pieces together are a submersion onto this subgroup.
    Whole(Subalgebra),
    /// Two arcs are, each onto its own; this is what the subgroups have in common.
    Split(Box<[Arc; 2]>, Subalgebra),
    /// The loop is a product of subgroups, each swept by an arc, whose algebras are independent: then only the identity of
    /// each closes the loop, and nothing moves but what moves within the arcs.
    Held {
        /// The arcs.
        arcs: Vec<Arc>,
        /// Independent equations.
        rank: usize,
        /// The margin of the rank.
        margin: Margin,
    },
}

impl Proof {
    /// Independent equations of the loop.
    pub fn rank(&self) -> usize {
        match self {
            Self::Whole(group) => group.dimension(),
            Self::Split(arcs, common) => {
                arcs.iter().map(|arc| arc.group.dimension()).sum::<usize>() - common.dimension()
            }
            Self::Held { rank, .. } => *rank,
        }
    }

    /// The worst margin it rests on.
    pub fn margin(&self) -> Margin {
        match self {
            Self::Whole(group) => group.margin(),
            Self::Split(_, common) => common.margin(),
            Self::Held { arcs, margin, .. } => arcs
                .iter()
                .fold(*margin, |all, arc| all.and(arc.group.margin())),
        }
    }
}

/// Looks for a proof, the more special the better. The pieces are in the order of the loop; where they start does not
/// matter.
pub fn prove(pieces: &[&Piece], gauge: &Gauge) -> Result<Option<Proof>, GroupError> {
    let span = span(pieces.iter().copied(), gauge)?;
    if may_close(pieces.iter().copied(), gauge)
        && let Some(group) = swept_by(pieces.iter().copied(), &span)?
    {
        return Ok(Some(Proof::Whole(group)));
    }
    if !clear(span.margin()) {
        return Ok(None);
    }
    let rank = span.dimension();
    let free = freedom(pieces.iter().copied());
    let held = |arcs| Proof::Held {
        arcs,
        rank,
        margin: span.margin(),
    };
    if free == rank {
        // No velocity closes the loop.
        return Ok(Some(held(Vec::new())));
    }
    let cuts = cuts(pieces);
    if cuts.len() > MOST_CUTS {
        return Ok(None);
    }
    let mut arcs = Arcs {
        pieces,
        gauge,
        cuts,
        known: BTreeMap::new(),
    };
    if pieces.len() > 2 && arcs.none_closes() {
        // One of two arcs has several pieces, and arcs of one piece each add up to all the freedom, which is more than the
        // rank.
        return Ok(None);
    }
    if let Some(split) = arcs.split()? {
        return Ok(Some(split).filter(|split| split.rank() == rank));
    }
    Ok(arcs.partition(rank)?.map(held))
}

/// A place to cut a loop: before a block of pieces, or within one, where some of its factors come first.
///
/// A block is a subgroup of a joint. Its factors can be taken in the order of the joint or in the opposite one.
#[derive(Clone, Debug)]
struct Cut {
    /// Number of the block.
    block: usize,
    /// Positions of the block's pieces before and after the cut.
    sides: [Vec<usize>; 2],
}

impl Cut {
    /// Whether this is the cut before the block that the other cut is within.
    fn begins_block_of(&self, other: &Self) -> bool {
        self.block == other.block && self.sides[0].is_empty() && !other.sides[0].is_empty()
    }
}

fn cuts(pieces: &[&Piece]) -> Vec<Cut> {
    let mut blocks: Vec<Vec<usize>> = Vec::new();
    let mut last = None;
    for (position, piece) in pieces.iter().enumerate() {
        let name = match piece {
            Piece::Factor {
                joint, subgroup, ..
            } => Some((*joint, *subgroup)),
            Piece::Replaced(_) => None,
        };
        match blocks.last_mut() {
            Some(block) if name.is_some() && name == last => block.push(position),
            _ => blocks.push(vec![position]),
        }
        last = name;
    }
    let mut cuts = Vec::new();
    for (number, block) in blocks.iter().enumerate() {
        cuts.push(Cut {
            block: number,
            sides: [Vec::new(), block.clone()],
        });
        let backward: Vec<usize> = block.iter().rev().copied().collect();
        for order in [block, &backward] {
            for before in 1..block.len() {
                let (first, second) = order.split_at(before);
                cuts.push(Cut {
                    block: number,
                    sides: [first.to_vec(), second.to_vec()],
                });
            }
        }
    }
    cuts
}

/// The arcs of a loop between two cuts each, looked at when asked for.
struct Arcs<'a> {
    pieces: &'a [&'a Piece],
    gauge: &'a Gauge,
    cuts: Vec<Cut>,
    known: BTreeMap<Vec<usize>, Option<Subalgebra>>,
}

impl Arcs<'_> {
    /// The pieces from a cut to another: in a later block, or from the beginning of a block to a cut in it; otherwise after
    /// going around.
    fn between(&self, from: usize, to: usize) -> Vec<usize> {
        let (from, to) = (&self.cuts[from], &self.cuts[to]);
        if from.begins_block_of(to) {
            return to.sides[0].clone();
        }
        let blocks = self.cuts.last().map_or(0, |cut| cut.block + 1);
        let mut arc = from.sides[1].clone();
        let mut block = (from.block + 1) % blocks;
        while block != to.block {
            let whole = self.cuts.iter().find(|cut| cut.block == block);
            arc.extend(whole.into_iter().flat_map(|cut| &cut.sides[1]));
            block = (block + 1) % blocks;
        }
        arc.extend(&to.sides[0]);
        arc
    }

    fn arc(&mut self, pieces: Vec<usize>) -> Result<Option<Arc>, GroupError> {
        let group = match self.known.get(&pieces) {
            Some(known) => known.clone(),
            None => {
                let group = swept(pieces.iter().map(|&i| self.pieces[i]), self.gauge)?;
                self.known.insert(pieces.clone(), group.clone());
                group
            }
        };
        Ok(group.map(|group| Arc { pieces, group }))
    }

    /// Whether no arc of several pieces can be a submersion onto a subgroup, at a look.
    fn none_closes(&self) -> bool {
        let all = 0..self.cuts.len();
        all.clone()
            .flat_map(|from| all.clone().map(move |to| (from, to)))
            .filter(|(from, to)| from != to)
            .map(|(from, to)| self.between(from, to))
            .filter(|arc| arc.len() > 1)
            .all(|arc| !self.may_close(&arc))
    }

    fn may_close(&self, arc: &[usize]) -> bool {
        may_close(arc.iter().map(|&i| self.pieces[i]), self.gauge)
    }

    /// Two complementary arcs that are submersions onto subgroups. Arcs of like length come first: they explain best.
    fn split(&mut self) -> Result<Option<Proof>, GroupError> {
        let count = self.cuts.len();
        let mut pairs: Vec<(usize, usize, usize)> = (0..count)
            .flat_map(|from| (from + 1..count).map(move |to| (from, to)))
            .filter(|&(from, to)| {
                let (from, to) = (&self.cuts[from], &self.cuts[to]);
                from.block < to.block || from.begins_block_of(to)
            })
            .map(|(from, to)| {
                let length = self.between(from, to).len();
                ((2 * length).abs_diff(self.pieces.len()), from, to)
            })
            .collect();
        pairs.sort_unstable();
        for (_, from, to) in pairs {
            let (inside, outside) = (self.between(from, to), self.between(to, from));
            if !(self.may_close(&inside) && self.may_close(&outside)) {
                continue;
            }
            let Some(first) = self.arc(inside)? else {
                continue;
            };
            let Some(second) = self.arc(outside)? else {
                continue;
            };
            let common = first.group.intersection(&second.group)?;
            if clear(common.margin()) {
                return Ok(Some(Proof::Split(Box::new([first, second]), common)));
            }
        }
        Ok(None)
    }

    /// A partition of the loop into arcs that are submersions onto subgroups whose dimensions add up to the rank, with as
    /// few arcs as possible from the first cut that has one.
    fn partition(&mut self, rank: usize) -> Result<Option<Vec<Arc>>, GroupError> {
        let count = self.cuts.len();
        let blocks = self.cuts.last().map_or(0, |cut| cut.block + 1);
        for start in 0..count {
            // Best way from the start to each cut: dimensions so far, number of arcs, the cut before.
            let steps: Vec<usize> = self
                .cuts
                .iter()
                .map(|cut| (cut.block + blocks - self.cuts[start].block) % blocks)
                .collect();
            let mut order: Vec<usize> = (0..count).filter(|&cut| steps[cut] > 0).collect();
            order.sort_by_key(|&cut| (steps[cut], cut));
            let mut best: BTreeMap<usize, (usize, usize, usize)> = BTreeMap::new();
            best.insert(start, (0, 0, start));
            let mut reached: Vec<usize> = vec![start];
            let mut closed: Option<(usize, usize, usize)> = None;
            for to in order.into_iter().chain([start]) {
                let mut found: Option<(usize, usize, usize)> = None;
                for &from in &reached {
                    let forward =
                        steps[from] < steps[to] || self.cuts[from].begins_block_of(&self.cuts[to]);
                    if from != start && to != start && !forward {
                        continue;
                    }
                    if from == start && to == start {
                        continue;
                    }
                    let Some(&(sum, arcs, _)) = best.get(&from) else {
                        continue;
                    };
                    if sum >= rank {
                        continue;
                    }
                    let Some(arc) = self.arc(self.between(from, to))? else {
                        continue;
                    };
                    let through = (sum + arc.group.dimension(), arcs + 1, from);
                    if through.0 <= rank && found.is_none_or(|best| through < best) {
                        found = Some(through);
                    }
                }
                let Some(found) = found else {
                    continue;
                };
                if to == start {
                    closed = Some(found);
                } else {
                    best.insert(to, found);
                    reached.push(to);
                }
            }
            let Some((_, _, mut before)) = closed.filter(|(sum, _, _)| *sum == rank) else {
                continue;
            };
            let mut after = start;
            let mut arcs = Vec::new();
            loop {
                arcs.extend(self.arc(self.between(before, after))?);
                if before == start {
                    arcs.reverse();
                    return Ok(Some(arcs));
                }
                after = before;
                before = best.get(&before).map_or(start, |(_, _, cut)| *cut);
            }
        }
        Ok(None)
    }
}
