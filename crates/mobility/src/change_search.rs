//! The least number of changes whose rows are independent and span everything: each joint may be changed in one of several
//! ways, each of which gives some rows.
//!
//! Found greedily, changes of most rows first; shown to be the least by a bound, or by looking through all smaller sets. Of
//! small problems all sets of the least size are listed. Cost: a fixed amount of work, [`WORK`], whatever the problem.

use super::row_space::RowSpace;
use kutzbach_math::interruption;

/// A way to change a joint.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    /// The joint; candidates of one joint follow each other.
    pub joint: usize,
    /// What it frees: at least one row.
    pub rows: Vec<Vec<f64>>,
}

/// Sets of candidates, by index in rising order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Found {
    /// One or more, in lexicographic order.
    pub sets: Vec<Vec<usize>>,
    /// Whether no smaller set exists.
    pub least: bool,
    /// Whether these are all of their size.
    pub complete: bool,
}

/// Multiplications that a search through all sets may take: a fraction of a second.
const WORK: usize = 60_000_000;

/// Sets listed.
const MOST_SETS: usize = 256;

/// Beyond so many dimensions a set that a bound shows to be the least is enough.
const MOST_LISTED: usize = 40;

/// Orders in which the greedy search is tried.
const ORDERS: usize = 12;

/// The sets; `None` if all candidates together do not span `dimension`, or none was found.
pub(super) fn least_sets(
    candidates: &[Candidate],
    dimension: usize,
    threshold: f64,
) -> Option<Found> {
    let all = candidates.iter().flat_map(|candidate| &candidate.rows);
    if rank_up_to(dimension, all, threshold) < dimension {
        return None;
    }
    let bound = lower_bound(candidates, dimension, threshold);
    let mut search = Search {
        candidates,
        dimension,
        space: RowSpace::new(threshold),
        chosen: Vec::new(),
        sets: Vec::new(),
        work: WORK,
        most_rows: most_rows(candidates),
    };
    let greedy = search.greedy(bound);
    // Where one set takes long to check, others are not sought.
    if let Some(set) = greedy
        .as_ref()
        .filter(|set| set.len() == bound && dimension > MOST_LISTED)
    {
        return Some(Found {
            sets: vec![set.clone()],
            least: true,
            complete: false,
        });
    }
    let most = greedy.as_ref().map_or(dimension, Vec::len);
    let mut least = true;
    for size in bound..=most {
        let complete = search.look_through(size);
        if !search.sets.is_empty() {
            return Some(Found {
                sets: search.sets,
                least,
                complete,
            });
        }
        // Without the work for all sets of this size a smaller one may have been missed.
        if !complete {
            least = size == most;
            break;
        }
    }
    greedy.map(|set| Found {
        sets: vec![set],
        least,
        complete: false,
    })
}

/// So many changes are needed at least. A set of k changes that give r rows has changes of more than one row, which give r − k
/// rows beyond their first ones. As each of them gives at most g rows, that is at most (g − 1)/g of the rank that all such changes
/// have together.
fn lower_bound(candidates: &[Candidate], dimension: usize, threshold: f64) -> usize {
    let most = most_rows(candidates);
    let many = candidates.iter().filter(|c| c.rows.len() > 1);
    let rank = rank_up_to(dimension, many.flat_map(|c| &c.rows), threshold);
    dimension - rank * (most - 1) / most
}

/// The rank of some rows, counted up to a limit.
fn rank_up_to<'a>(limit: usize, rows: impl Iterator<Item = &'a Vec<f64>>, threshold: f64) -> usize {
    let mut space = RowSpace::new(threshold);
    for row in rows {
        space.add(row);
        if space.dimension() >= limit {
            break;
        }
    }
    space.dimension()
}

fn most_rows(candidates: &[Candidate]) -> usize {
    let rows = candidates.iter().map(|candidate| candidate.rows.len());
    rows.max().unwrap_or(1).max(1)
}

struct Search<'a> {
    candidates: &'a [Candidate],
    dimension: usize,
    space: RowSpace,
    chosen: Vec<usize>,
    sets: Vec<Vec<usize>>,
    work: usize,
    most_rows: usize,
}

impl Search<'_> {
    /// A small set, not always the least; no order is tried after one that gives a set as small as the bound.
    fn greedy(&mut self, bound: usize) -> Option<Vec<usize>> {
        let many = self.candidates.len();
        let mut best: Option<Vec<usize>> = None;
        for order in 0..ORDERS.min(many) {
            self.space.cut(0);
            let mut set: Vec<usize> = Vec::new();
            for rows in (1..=self.most_rows).rev() {
                for index in (0..many).map(|i| (i + order * many / ORDERS) % many) {
                    if interruption::asked() {
                        return None;
                    }
                    let candidate = &self.candidates[index];
                    let changed = |i: &usize| self.candidates[*i].joint == candidate.joint;
                    if self.space.dimension() < self.dimension
                        && candidate.rows.len() == rows
                        && !set.iter().any(changed)
                        && self.space.add_all(&candidate.rows)
                    {
                        set.push(index);
                    }
                }
            }
            let complete = self.space.dimension() == self.dimension;
            if complete && best.as_ref().is_none_or(|known| set.len() < known.len()) {
                set.sort_unstable();
                best = Some(set);
            }
            if best.as_ref().is_some_and(|set| set.len() == bound) {
                break;
            }
        }
        self.space.cut(0);
        best
    }

    /// Looks for all sets of a size; whether there was work enough, and room.
    fn look_through(&mut self, size: usize) -> bool {
        self.space.cut(0);
        self.chosen.clear();
        self.from(0, size)
    }

    fn from(&mut self, first: usize, left: usize) -> bool {
        let needed = self.dimension - self.space.dimension();
        if left == 0 || needed == 0 {
            if left == 0 && needed == 0 {
                self.sets.push(self.chosen.clone());
            }
            return self.sets.len() < MOST_SETS;
        }
        for index in first..self.candidates.len() {
            let candidate = &self.candidates[index];
            let rows = candidate.rows.len();
            if rows > needed || needed - rows > self.most_rows * (left - 1) {
                continue;
            }
            let before = self.space.dimension();
            let cost = 4 * rows * (before + 1) * self.dimension;
            match self.work.checked_sub(cost) {
                Some(work) if !interruption::asked() => self.work = work,
                _ => return false,
            }
            if !self.space.add_all(&candidate.rows) {
                continue;
            }
            let joint = candidate.joint;
            let behind = self.candidates[index..].iter();
            let next = index + behind.take_while(|c| c.joint == joint).count();
            self.chosen.push(index);
            let complete = self.from(next, left - 1);
            self.chosen.pop();
            self.space.cut(before);
            if !complete {
                return false;
            }
        }
        true
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn unit(dimension: usize, index: usize) -> Vec<f64> {
        (0..dimension)
            .map(|i| f64::from(u8::from(i == index)))
            .collect()
    }

    /// Joints of a planar loop: each may give the third row, or the first two.
    fn planar(joints: usize) -> Vec<Candidate> {
        let ways = [vec![unit(3, 2)], vec![unit(3, 0), unit(3, 1)]];
        let of = |joint| {
            ways.iter().map(move |rows| Candidate {
                joint,
                rows: rows.clone(),
            })
        };
        (0..joints).flat_map(of).collect()
    }

    #[test]
    fn all_sets_of_the_least_size_are_listed_once() {
        let found = least_sets(&planar(4), 3, 1e-9).unwrap();
        assert!(found.least && found.complete);
        assert_eq!(found.sets.len(), 12, "two of four joints, in either way");
        assert!(found.sets.iter().all(|set| set.len() == 2));
        // One joint cannot be changed in two ways.
        assert_eq!(least_sets(&planar(1), 3, 1e-9), None);
    }

    #[test]
    fn more_dimensions_than_rows_are_not_spanned() {
        let mut candidates = planar(4);
        for candidate in &mut candidates {
            for row in &mut candidate.rows {
                row.push(0.0);
            }
        }
        assert_eq!(least_sets(&candidates, 4, 1e-9), None);
    }

    #[test]
    fn large_problems_take_no_longer() {
        let loops = 100;
        let mut candidates = Vec::new();
        for joint in 0..4 * loops {
            let row = |i| unit(3 * loops, 3 * (joint / 4) + i);
            for rows in [vec![row(2)], vec![row(0), row(1)]] {
                candidates.push(Candidate { joint, rows });
            }
        }
        let found = least_sets(&candidates, 3 * loops, 1e-9).unwrap();
        assert!(found.least, "the bound says so");
        assert!(found.sets.iter().all(|set| set.len() == 2 * loops));
    }
}
