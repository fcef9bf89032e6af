//! Vertices of two edges, taken off one after the other.

use super::local::Local;
use std::collections::VecDeque;

/// A graph from which vertices are taken.
pub(super) struct Peeling<'a> {
    graph: &'a Local,
    degree: Vec<usize>,
    left: Vec<bool>,
    count: usize,
    waiting: VecDeque<usize>,
}

/// A vertex, and its two neighbours with the edges that lead there.
pub(super) type Peel = (usize, [(usize, usize); 2]);

impl<'a> Peeling<'a> {
    pub(super) fn new(graph: &'a Local) -> Self {
        let degree: Vec<usize> = graph.near.iter().map(Vec::len).collect();
        Self {
            waiting: (0..graph.len()).filter(|&v| degree[v] == 2).collect(),
            left: vec![true; graph.len()],
            count: graph.len(),
            degree,
            graph,
        }
    }

    pub(super) fn is_left(&self, v: usize) -> bool {
        self.left[v]
    }

    /// Takes off the next vertex with edges to two others, as long as more vertices than `keep` are left.
    pub(super) fn next(&mut self, keep: usize) -> Option<Peel> {
        while self.count > keep {
            let v = self.waiting.pop_front()?;
            if !self.left[v] || self.degree[v] != 2 {
                continue;
            }
            let mut near = self.graph.near[v].iter().filter(|n| self.left[n.0]);
            let (Some(&one), Some(&two)) = (near.next(), near.next()) else {
                continue;
            };
            if one.0 == two.0 {
                continue; // two edges between the same vertices
            }
            self.left[v] = false;
            self.count -= 1;
            for (w, _) in [one, two] {
                self.degree[w] -= 1;
                if self.degree[w] == 2 {
                    self.waiting.push_back(w);
                }
            }
            return Some((v, [one, two]));
        }
        None
    }
}
