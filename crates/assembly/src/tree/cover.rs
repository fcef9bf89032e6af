//! Covering sets and the weight of their lightest trees.
//!
//! With weights 1, 3 and 6 the lightest spanning tree of k bodies weighs k + 2c + 3d − 6, where the bodies fall into c parts
//! by overlaps of two points or more and into d parts by overlaps of any kind: k − c edges weigh 1, c − d weigh 3, d − 1
//! weigh 6. (Kruskal 1956: a lightest tree spans every part with edges of the part's own kind.) An overlap of three points
//! would weigh nothing; in a standard collection there is none, and elsewhere it is counted as one of weight 1.

use super::EXACT_BODIES;
use crate::collection::Collection;

/// A covering set and the weight of its lightest tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cover {
    /// The bodies, ascending.
    pub bodies: Vec<usize>,
    /// The weight.
    pub weight: usize,
}

/// Which bodies overlap in how many points.
pub(super) struct Overlaps {
    /// Number of shared points by pair.
    shared: Vec<Vec<usize>>,
    /// The bodies of every point that a body has.
    holders: Vec<Vec<usize>>,
}

impl Overlaps {
    pub(super) fn new(collection: &Collection) -> Self {
        let n = collection.bodies().len();
        let row = |i: usize| (0..n).map(|j| collection.shared(i, j).len()).collect();
        let mut holders = vec![Vec::new(); collection.points().len()];
        for (index, body) in collection.bodies().iter().enumerate() {
            body.points.iter().for_each(|&p| holders[p].push(index));
        }
        holders.retain(|h| !h.is_empty());
        Self {
            shared: (0..n).map(row).collect(),
            holders,
        }
    }

    /// The weight of an edge in a tree.
    pub(super) fn weight(&self, one: usize, other: usize) -> usize {
        match self.shared[one][other] {
            0 => 6,
            1 => 3,
            _ => 1,
        }
    }

    /// Weight of the lightest tree of some bodies.
    fn tree_weight(&self, bodies: &[usize]) -> usize {
        let tight = self.parts(bodies, 2).len();
        let loose = self.parts(bodies, 1).len();
        (bodies.len() + 2 * tight + 3 * loose).saturating_sub(6)
    }

    /// The parts into which bodies fall that are joined where they share so many points.
    pub(super) fn parts(&self, bodies: &[usize], least: usize) -> Vec<Vec<usize>> {
        let mut left: Vec<usize> = bodies.to_vec();
        let mut parts = Vec::new();
        while let Some(start) = left.pop() {
            let mut part = vec![start];
            let mut next = 0;
            while let Some(&body) = part.get(next) {
                let (near, rest) = left.iter().partition(|&&b| self.shared[body][b] >= least);
                left = rest;
                part.extend::<Vec<usize>>(near);
                next += 1;
            }
            part.sort_unstable();
            parts.push(part);
        }
        parts.sort_unstable();
        parts
    }

    fn covers(&self, bodies: &[usize]) -> bool {
        let held = |holders: &Vec<usize>| holders.iter().any(|h| bodies.contains(h));
        self.holders.iter().all(held)
    }
}

/// All covering sets with the weight of their lightest trees; `None` beyond [`EXACT_BODIES`] bodies.
#[must_use]
pub fn covering_sets(collection: &Collection) -> Option<Vec<Cover>> {
    let overlaps = Overlaps::new(collection);
    let usable: Vec<usize> = (0..collection.bodies().len()).collect();
    if usable.len() > EXACT_BODIES {
        return None;
    }
    let mut sets = Vec::new();
    each_cover(&overlaps, &[], &usable, usize::MAX, |bodies, _| {
        sets.push(Cover {
            weight: overlaps.tree_weight(bodies),
            bodies: bodies.to_vec(),
        });
        usize::MAX
    });
    Some(sets)
}

/// Calls `found` for every covering set that has few enough bodies for a tree of a bounded weight (k bodies weigh k − 1 at
/// least); what it returns is the new bound.
fn each_cover(
    overlaps: &Overlaps,
    needed: &[usize],
    usable: &[usize],
    bound: usize,
    mut found: impl FnMut(&[usize], usize) -> usize,
) {
    let mask = |holders: &Vec<usize>| {
        let bit = |(i, b): (usize, &usize)| u32::from(holders.contains(b)) << i;
        usable
            .iter()
            .enumerate()
            .map(bit)
            .fold(0, |all, bit| all | bit)
    };
    let mut holders: Vec<u32> = overlaps.holders.iter().map(mask).collect();
    // The points of few bodies rule out most sets.
    holders.sort_by_key(|h| (h.count_ones(), *h));
    holders.dedup();
    let needed = mask(&needed.to_vec());
    let mut bound = bound;
    for set in 1u32..1 << usable.len() {
        let size = set.count_ones() as usize;
        if size - 1 > bound || set & needed != needed || holders.iter().any(|h| h & set == 0) {
            continue;
        }
        let chosen = usable.iter().enumerate().filter(|(i, _)| set >> i & 1 == 1);
        let bodies: Vec<usize> = chosen.map(|(_, &b)| b).collect();
        bound = found(&bodies, bound);
    }
}

/// The covering sets of the least weight, and whether that is known to be the least.
pub(super) fn best_covers(
    overlaps: &Overlaps,
    needed: &[usize],
    usable: &[usize],
) -> Option<(Vec<Cover>, bool)> {
    if usable.is_empty() || !overlaps.covers(usable) {
        return None;
    }
    if usable.len() > EXACT_BODIES {
        return Some((vec![dropped_one_by_one(overlaps, needed, usable)], false));
    }
    let mut best: Vec<Cover> = Vec::new();
    let start = overlaps.tree_weight(usable);
    each_cover(overlaps, needed, usable, start, |bodies, bound| {
        let weight = overlaps.tree_weight(bodies);
        if weight < bound || best.is_empty() && weight == bound {
            best.clear();
        }
        if weight <= bound {
            best.push(Cover {
                bodies: bodies.to_vec(),
                weight,
            });
        }
        weight.min(bound)
    });
    Some((best, true))
}

/// All bodies, without those whose absence makes the tree lighter or no heavier, the last ones first.
fn dropped_one_by_one(overlaps: &Overlaps, needed: &[usize], usable: &[usize]) -> Cover {
    let mut bodies = usable.to_vec();
    let mut weight = overlaps.tree_weight(&bodies);
    loop {
        let mut lighter = None;
        for place in (0..bodies.len()).rev() {
            let mut fewer = bodies.clone();
            let dropped = fewer.remove(place);
            if needed.contains(&dropped) || fewer.is_empty() || !overlaps.covers(&fewer) {
                continue;
            }
            let without = overlaps.tree_weight(&fewer);
            if without < weight {
                weight = without;
                lighter = Some(fewer);
            }
        }
        match lighter {
            Some(fewer) => bodies = fewer,
            None => return Cover { bodies, weight },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collection::samples;

    /// Prim's algorithm on every covering set agrees with the count.
    #[test]
    fn the_count_is_the_weight_of_the_lightest_tree() {
        for collection in [
            samples::tetra_whole(),
            samples::pent_whole(),
            samples::quad_whole(),
        ] {
            let overlaps = Overlaps::new(&collection);
            for cover in covering_sets(&collection).into_iter().flatten() {
                let mut left = cover.bodies.clone();
                let mut tree = vec![left.remove(0)];
                let mut sum = 0;
                while !left.is_empty() {
                    let near = |b: usize| tree.iter().map(|&t| overlaps.weight(t, b)).min();
                    let place = (0..left.len()).min_by_key(|&i| near(left[i])).unwrap_or(0);
                    sum += near(left[place]).unwrap_or(0);
                    tree.push(left.remove(place));
                }
                assert_eq!(sum, cover.weight, "{:?}", cover.bodies);
            }
        }
    }
}
