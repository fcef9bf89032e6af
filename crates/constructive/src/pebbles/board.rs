//! Two pebbles a vertex, on the vertex or on an edge that leaves it.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Where the pebbles are: a vertex covers at most two edges, and what it does not cover is free.
#[derive(Clone, Debug)]
pub(super) struct Board {
    /// The other ends of the edges that a vertex covers.
    covers: Vec<[Option<usize>; 2]>,
    /// In which search a vertex was reached, and from which vertex by which of its pebbles.
    seen: Vec<(u64, usize, usize)>,
    search: u64,
    /// For which part a vertex was marked, and whether as rigid in it or as loose.
    marks: Vec<(u64, bool)>,
    part: u64,
    steps: u64,
    stack: Vec<usize>,
}

impl Board {
    pub(super) fn new(vertices: usize) -> Self {
        Self {
            covers: vec![[None; 2]; vertices],
            seen: vec![(0, 0, 0); vertices],
            search: 0,
            marks: vec![(0, false); vertices],
            part: 0,
            steps: 0,
            stack: Vec::new(),
        }
    }

    pub(super) fn vertices(&self) -> usize {
        self.covers.len()
    }

    pub(super) const fn steps(&self) -> u64 {
        self.steps
    }

    fn free(&self, v: usize) -> usize {
        self.covers[v].iter().filter(|c| c.is_none()).count()
    }

    /// Brings as many pebbles to the two vertices as can be brought: three or four.
    pub(super) fn gather(&mut self, ends: [usize; 2]) -> usize {
        for u in ends {
            while self.free(u) < 2 && self.bring(u, ends) {}
        }
        self.free(ends[0]) + self.free(ends[1])
    }

    /// Brings one free pebble to `u`, from neither of the two vertices.
    fn bring(&mut self, u: usize, ends: [usize; 2]) -> bool {
        self.search += 1;
        self.stack.clear();
        self.stack.push(u);
        self.seen[u] = (self.search, u, 0);
        while let Some(v) = self.stack.pop() {
            self.steps += 1;
            if !ends.contains(&v) && self.free(v) > 0 {
                self.turn_path(u, v);
                return true;
            }
            for slot in 0..2 {
                if let Some(w) = self.covers[v][slot]
                    && self.seen[w].0 != self.search
                {
                    self.seen[w] = (self.search, v, slot);
                    self.stack.push(w);
                }
            }
        }
        false
    }

    /// Every edge on the path from `u` to `v` is covered from its other end from now on, so that the free pebble of `v` is at `u`.
    fn turn_path(&mut self, u: usize, v: usize) {
        let mut at = v;
        while at != u {
            let (_, from, slot) = self.seen[at];
            self.covers[from][slot] = None;
            // The pebble of `at` that is free: at `v` as found, further up the one that was taken off just before.
            if let Some(free) = self.covers[at].iter_mut().find(|c| c.is_none()) {
                *free = Some(from);
            }
            at = from;
        }
    }

    /// Covers the edge between two vertices that have a free pebble each.
    pub(super) fn cover(&mut self, [u, v]: [usize; 2]) {
        if let Some(free) = self.covers[u].iter_mut().find(|c| c.is_none()) {
            *free = Some(v);
        }
    }

    /// The vertices that the covered edges lead to, ascending, the two themselves among them.
    pub(super) fn within_reach(&mut self, ends: [usize; 2]) -> Vec<usize> {
        self.search += 1;
        let mut reached = Vec::new();
        self.stack.clear();
        for u in ends {
            self.seen[u].0 = self.search;
            self.stack.push(u);
        }
        while let Some(v) = self.stack.pop() {
            self.steps += 1;
            reached.push(v);
            for w in self.covers[v].into_iter().flatten() {
                if self.seen[w].0 != self.search {
                    self.seen[w].0 = self.search;
                    self.stack.push(w);
                }
            }
        }
        reached.sort_unstable();
        reached
    }

    /// The largest rigid part with both ends of an edge, ascending: with three pebbles gathered there, everything from where no
    /// other free pebble can be reached. `near` has the neighbours of every vertex.
    ///
    /// It grows from neighbour to neighbour. A part of three vertices or more stays in one piece without any one of them, so that the
    /// last one need not be looked at, and few neighbours are looked at first: hubs cost nothing.
    pub(super) fn rigid_around(&mut self, ends: [usize; 2], near: &[Vec<usize>]) -> Vec<usize> {
        self.gather(ends);
        self.part += 1;
        let mut rigid = ends.to_vec();
        let mut open = BinaryHeap::new();
        for u in ends {
            self.marks[u] = (self.part, true);
            open.push(Reverse((near[u].len(), u)));
        }
        while open.len() > 1 {
            let Some(Reverse((_, v))) = open.pop() else {
                break;
            };
            for &w in &near[v] {
                self.steps += 1;
                if self.marks[w].0 == self.part {
                    continue;
                }
                for x in self.held_with(w) {
                    rigid.push(x);
                    open.push(Reverse((near[x].len(), x)));
                }
            }
        }
        rigid.sort_unstable();
        rigid
    }

    /// The vertices that can be reached from `w` if none of them is free or marked as loose: they are marked as rigid. Otherwise
    /// the path to that one is marked as loose.
    fn held_with(&mut self, w: usize) -> Vec<usize> {
        self.search += 1;
        let mut reached = Vec::new();
        self.stack.clear();
        self.stack.push(w);
        self.seen[w] = (self.search, w, 0);
        while let Some(v) = self.stack.pop() {
            self.steps += 1;
            if self.marks[v] == (self.part, false) || self.free(v) > 0 {
                let mut at = v;
                loop {
                    self.marks[at] = (self.part, false);
                    let before = self.seen[at].1;
                    if before == at {
                        return Vec::new();
                    }
                    at = before;
                }
            }
            reached.push(v);
            for slot in 0..2 {
                if let Some(x) = self.covers[v][slot]
                    && self.seen[x].0 != self.search
                    && self.marks[x] != (self.part, true)
                {
                    self.seen[x] = (self.search, v, slot);
                    self.stack.push(x);
                }
            }
        }
        for &v in &reached {
            self.marks[v] = (self.part, true);
        }
        reached
    }
}
