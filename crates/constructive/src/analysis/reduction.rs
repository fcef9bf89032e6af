//! Reduction: clusters merge, three at a time.
//!
//! A cluster keeps a list of vertices that it may have a new triangle at. Three clusters are sought from such a vertex: one of
//! the three has it and shares it with a second, a third meets both elsewhere. A merge keeps the largest of the three in place;
//! only vertices that are new to it can lead to something new. So a vertex moves log V times, and what it costs is in the
//! searches around it: near linear where few clusters meet at most vertices, quadratic at worst.

use crate::graph::Graph;
use std::collections::BTreeSet;

/// Three clusters that become one. Cluster numbers below the number of edges are edges, later ones are merges in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Merge {
    /// The three clusters.
    pub parts: [usize; 3],
    /// The vertices that they share: first with second, second with third, third with first.
    pub shared: [usize; 3],
}

/// What reduction leads to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reduction {
    /// The merges, each after those of its parts.
    pub merges: Vec<Merge>,
    /// The clusters that are left, by number, each with its vertices, ascending. Where the graph is not over-constrained these
    /// do not depend on the order of merges.
    pub left: Vec<(usize, Vec<usize>)>,
    /// Whether one cluster with all vertices is left.
    pub solved: bool,
    /// Vertices and clusters looked at.
    pub steps: u64,
}

/// Merges clusters until no three share three vertices pairwise, one each.
#[must_use]
pub fn reduce(graph: &Graph) -> Reduction {
    let mut state = State::new(graph);
    // The last edge lies on top: what grows is finished before anything else is begun.
    let mut waiting: Vec<usize> = (0..graph.edges().len()).rev().collect();
    while let Some(cluster) = waiting.pop() {
        while let Some(&x) = state.pending[cluster].last() {
            match state.triangle_at(cluster, x) {
                None => {
                    state.pending[cluster].pop();
                }
                Some(found) => {
                    waiting.push(state.merge(found));
                    break;
                }
            }
        }
    }
    state.finished()
}

/// Three places of clusters, and the vertices they share as in [`Merge`].
type Triangle = ([usize; 3], [usize; 3]);

struct State {
    vertices: usize,
    /// By place: the vertices of the cluster that stands there; empty where it went into another.
    members: Vec<Vec<usize>>,
    /// By place: vertices from which triangles are still to be sought.
    pending: Vec<Vec<usize>>,
    /// By place: the number of the cluster.
    number: Vec<usize>,
    /// By vertex: the places of its clusters.
    at: Vec<BTreeSet<usize>>,
    merges: Vec<Merge>,
    steps: u64,
}

impl State {
    fn new(graph: &Graph) -> Self {
        let mut at = vec![BTreeSet::new(); graph.vertices()];
        for (e, ends) in graph.edges().iter().enumerate() {
            for &v in ends {
                at[v].insert(e);
            }
        }
        let edges = graph.edges().iter();
        // A triangle with an edge is found from either end.
        let pending = |&[u, v]: &[usize; 2]| vec![if at[u].len() <= at[v].len() { u } else { v }];
        Self {
            vertices: graph.vertices(),
            members: edges.clone().map(|e| e.to_vec()).collect(),
            pending: edges.clone().map(pending).collect(),
            number: (0..edges.len()).collect(),
            at,
            merges: Vec::new(),
            steps: 0,
        }
    }

    /// Three clusters, the first of them this one, which shares `x` with the second.
    fn triangle_at(&mut self, first: usize, x: usize) -> Option<Triangle> {
        let others: Vec<usize> = self.at[x].iter().copied().collect();
        let others = others.into_iter().filter(|&o| o != first);
        others
            .into_iter()
            .find_map(|second| self.closed_by(first, second, x))
    }

    /// The two clusters share `x`; a third that shares another vertex with each. It is sought from the smaller of the two.
    fn closed_by(&mut self, first: usize, second: usize, x: usize) -> Option<Triangle> {
        let swap = self.members[second].len() < self.members[first].len();
        let [small, large] = if swap {
            [second, first]
        } else {
            [first, second]
        };
        for i in 0..self.members[small].len() {
            let near = self.members[small][i];
            self.steps += 1;
            if near == x {
                continue;
            }
            if self.at[near].contains(&large) {
                return None; // two vertices shared: over-constrained here
            }
            let thirds: Vec<usize> = self.at[near].iter().copied().collect();
            for third in thirds.into_iter().filter(|&t| t != small) {
                let Some(far) = self.only_shared(third, large) else {
                    continue;
                };
                if far == x || self.only_shared(third, small) != Some(near) {
                    continue;
                }
                let [z, y] = if swap { [far, near] } else { [near, far] };
                return Some(([first, second, third], [x, y, z]));
            }
        }
        None
    }

    /// The vertex that two clusters share, if it is one.
    fn only_shared(&mut self, one: usize, other: usize) -> Option<usize> {
        let swap = self.members[other].len() < self.members[one].len();
        let [small, large] = if swap { [other, one] } else { [one, other] };
        let mut shared = None;
        for &v in &self.members[small] {
            self.steps += 1;
            if self.at[v].contains(&large) && shared.replace(v).is_some() {
                return None;
            }
        }
        shared
    }

    /// Merges into the place of the largest, which is returned.
    fn merge(&mut self, (places, shared): Triangle) -> usize {
        let parts = places.map(|p| self.number[p]);
        self.merges.push(Merge { parts, shared });
        let kept = places
            .into_iter()
            .max_by_key(|&p| (self.members[p].len(), std::cmp::Reverse(p)))
            .unwrap_or(places[0]);
        // As many numbers as edges come first.
        self.number[kept] = self.number.len() + self.merges.len() - 1;
        for gone in places.into_iter().filter(|&p| p != kept) {
            self.pending[gone] = Vec::new();
            for v in std::mem::take(&mut self.members[gone]) {
                self.steps += 1;
                self.at[v].remove(&gone);
                if self.at[v].insert(kept) {
                    self.members[kept].push(v);
                    self.pending[kept].push(v);
                }
            }
        }
        kept
    }

    fn finished(self) -> Reduction {
        let places = self.number.into_iter().zip(self.members);
        let mut left: Vec<(usize, Vec<usize>)> = places.filter(|(_, m)| !m.is_empty()).collect();
        for (_, members) in &mut left {
            members.sort_unstable();
        }
        left.sort_unstable_by_key(|(number, _)| *number);
        let whole = |l: &[(usize, Vec<usize>)]| l.len() == 1 && l[0].1.len() == self.vertices;
        Reduction {
            solved: whole(&left),
            merges: self.merges,
            left,
            steps: self.steps,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::pebbles::{PebbleGame, Standing};
    use crate::samples::{self, Random};

    /// The rule as it is written, tried on all triples in a random order.
    fn by_the_rule(graph: &Graph, random: &mut Random) -> BTreeSet<Vec<usize>> {
        let mut clusters: Vec<BTreeSet<usize>> = graph
            .edges()
            .iter()
            .map(|e| e.iter().copied().collect())
            .collect();
        'again: loop {
            random.shuffle(&mut clusters);
            for i in 0..clusters.len() {
                for j in 0..i {
                    for k in 0..j {
                        let [a, b, c] = [i, j, k].map(|x| &clusters[x]);
                        let shared: Vec<usize> = [(a, b), (b, c), (c, a)]
                            .iter()
                            .flat_map(|(p, q)| p.intersection(q).copied())
                            .collect();
                        let three: BTreeSet<usize> = shared.iter().copied().collect();
                        let one_each = [(a, b), (b, c), (c, a)]
                            .iter()
                            .all(|(p, q)| p.intersection(q).count() == 1);
                        if one_each && three.len() == 3 {
                            let merged = a | b;
                            let merged = &merged | c;
                            for gone in [i, j, k] {
                                clusters.remove(gone);
                            }
                            clusters.push(merged);
                            continue 'again;
                        }
                    }
                }
            }
            return clusters
                .into_iter()
                .map(|c| c.into_iter().collect())
                .collect();
        }
    }

    #[test]
    fn the_clusters_left_are_those_of_the_rule_in_any_order() {
        let mut random = Random::new(11);
        let mut partly = 0;
        for _ in 0..150 {
            let n = 4 + random.below(8);
            let graph = samples::henneberg(n, 60, &mut random);
            let graph = match random.below(2) {
                0 => graph,
                _ => samples::with_one_fewer(&graph, &mut random),
            };
            assert_ne!(PebbleGame::play(&graph).standing(), Standing::Over);
            let reduction = reduce(&graph);
            let left: BTreeSet<Vec<usize>> = reduction.left.iter().map(|l| l.1.clone()).collect();
            assert_eq!(left, by_the_rule(&graph, &mut random), "{graph:?}");
            partly += usize::from(!reduction.solved && !reduction.merges.is_empty());
        }
        assert!(partly > 20, "{partly}");
    }

    #[test]
    fn a_strip_and_a_fan_cost_in_proportion() {
        let fan = |n: usize| {
            (1..n)
                .flat_map(move |k| [[0, k], [k, k + 1]])
                .take(2 * n - 3)
        };
        let steps = |n: usize, edges: Vec<[usize; 2]>| {
            let reduction = reduce(&Graph::new(n, edges).unwrap());
            assert!(reduction.solved);
            assert_eq!(reduction.merges.len(), n - 2);
            reduction.steps as f64
        };
        let strips = steps(8000, samples::strip(8000)) / steps(1000, samples::strip(1000));
        assert!(strips < 8.8, "{strips}");
        let fans = steps(8000, fan(8000).collect()) / steps(1000, fan(1000).collect());
        assert!(fans < 8.8, "{fans}");
    }
}
