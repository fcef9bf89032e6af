//! The smallest subgroup known to hold the relative displacements of each two links.

use super::groups::{EVERYTHING, Group, Groups};
use kutzbach_math::group::GroupError;
use std::collections::{BTreeMap, BTreeSet};

/// Between up to this many bodies all pairs are bounded, otherwise those that lie on one of the given cycles.
const ALL_PAIRS: usize = 16;

/// Groups D(i, j) that hold the relative displacement of bodies i and j at every pose that the mechanism reaches from the one where they
/// were placed, as long as it passes no pose where a bound was not valid to begin with.
///
/// The displacement from i to j is that from i to k times that from k to j. Hence D(i, j) may be replaced by D(i, j) ∩ ⟨D(i, k) ∘ D(k, j)⟩,
/// until nothing changes. Each step lowers a dimension, of which a pair has four at most, so that it ends.
pub struct Bounds {
    /// The bodies with which each forms a pair, in order.
    near: Vec<Vec<usize>>,
    of: BTreeMap<(usize, usize), Group>,
    changed: BTreeSet<(usize, usize)>,
}

impl Bounds {
    /// Nothing known of some bodies, of which those of a cycle are near one another.
    pub fn new(bodies: usize, cycles: &[Vec<usize>]) -> Self {
        let mut near: Vec<Vec<usize>> = vec![Vec::new(); bodies];
        if bodies <= ALL_PAIRS {
            for (body, others) in near.iter_mut().enumerate() {
                others.extend((0..bodies).filter(|other| *other != body));
            }
        } else {
            for cycle in cycles {
                for &body in cycle {
                    near[body].extend(cycle.iter().filter(|other| **other != body));
                }
            }
            for others in &mut near {
                others.sort_unstable();
                others.dedup();
            }
        }
        Self {
            near,
            of: BTreeMap::new(),
            changed: BTreeSet::new(),
        }
    }

    /// The group of two different bodies.
    pub fn between(&self, a: usize, b: usize) -> Group {
        let group = self.of.get(&(a.min(b), a.max(b)));
        group.copied().unwrap_or(EVERYTHING)
    }

    /// All pairs of which something is known.
    pub fn all(&self) -> Vec<([usize; 2], Group)> {
        self.of
            .iter()
            .map(|(&(a, b), &group)| ([a, b], group))
            .collect()
    }

    /// Takes notice that the relative displacements of two bodies lie in a group. Whether that was news.
    pub fn restrict(
        &mut self,
        groups: &mut Groups,
        a: usize,
        b: usize,
        to: Group,
    ) -> Result<bool, GroupError> {
        if a == b || to == EVERYTHING {
            return Ok(false);
        }
        let before = self.between(a, b);
        let after = groups.meet(before, to)?;
        // A common part that is as large is the same group, however it was found.
        if after == before || groups.dimension(after) >= groups.dimension(before) {
            return Ok(false);
        }
        let pair = (a.min(b), a.max(b));
        self.of.insert(pair, after);
        self.changed.insert(pair);
        Ok(true)
    }

    /// Replaces bounds by smaller ones until nothing changes.
    pub fn settle(&mut self, groups: &mut Groups) -> Result<(), GroupError> {
        while let Some((a, b)) = self.changed.pop_first() {
            let via = self.between(a, b);
            let others = std::mem::take(&mut self.near[a]);
            for &other in &others {
                if other == b || self.near[b].binary_search(&other).is_err() {
                    continue;
                }
                let through_b = groups.join(via, self.between(b, other))?;
                self.restrict(groups, a, other, through_b)?;
                let through_a = groups.join(via, self.between(a, other))?;
                self.restrict(groups, b, other, through_a)?;
            }
            self.near[a] = others;
        }
        Ok(())
    }
}
