//! Points of bodies, and which of them are one point.

use super::{Exact3, minus};
use std::collections::BTreeMap;

/// Coordinates whose doubles differ by more than this part of their size are different numbers: doubles are correctly
/// rounded, so that equal numbers have equal ones; a wide margin costs nothing but a few exact comparisons.
const CLEARLY_APART: f64 = 1e-6;

/// A point of one body.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) group: usize,
    pub(super) at: Exact3,
    pub(super) name: String,
}

/// Points of bodies, joined where bodies share them.
#[derive(Debug, Default)]
pub(super) struct Nodes {
    pub(super) all: Vec<Node>,
    parent: Vec<usize>,
}

impl Nodes {
    /// The point of a body at a place, made where there is none yet.
    pub(super) fn add(&mut self, group: usize, at: Exact3, name: &str) -> usize {
        let known = self
            .all
            .iter()
            .position(|n| n.group == group && same(&n.at, &at));
        known.unwrap_or_else(|| {
            self.all.push(Node {
                group,
                at,
                name: name.to_owned(),
            });
            self.parent.push(self.parent.len());
            self.parent.len() - 1
        })
    }

    /// Two points of bodies are one.
    pub(super) fn join(&mut self, one: usize, other: usize) {
        let (a, b) = (self.class(one), self.class(other));
        self.parent[a.max(b)] = a.min(b);
    }

    /// The first of all points that are one with this.
    pub(super) fn class(&self, node: usize) -> usize {
        let mut node = node;
        while self.parent[node] != node {
            node = self.parent[node];
        }
        node
    }

    /// Two places of one body that are joined to one point, if there are: points of a body at one place are one node.
    pub(super) fn torn(&self) -> Option<[usize; 2]> {
        let mut known = BTreeMap::new();
        (0..self.all.len()).find_map(|node| {
            let of = (self.all[node].group, self.class(node));
            known.insert(of, node).map(|other| [other, node])
        })
    }

    /// Number of bodies and bars that have a point.
    pub(super) fn users(&self, node: usize) -> usize {
        let class = self.class(node);
        (0..self.all.len())
            .filter(|&n| self.class(n) == class)
            .count()
    }
}

/// Whether two places are the same: exactly.
pub(super) fn same(a: &Exact3, b: &Exact3) -> bool {
    let near = a.iter().zip(b).all(|(x, y)| {
        let (x, y) = (x.value(), y.value());
        (x - y).abs() <= CLEARLY_APART * (1.0 + x.abs().max(y.abs()))
    });
    near && minus(a, b)
        .iter()
        .all(kutzbach_math::number::Number::is_zero)
}
