//! The order of construction: which cluster goes where, by which elements. Combinatorics only.

use crate::analysis::Reduction;
use crate::sketch::Sketch;
use std::collections::HashMap;

/// One merge: two clusters move into the frame of the third, which is the largest.
#[derive(Clone, Debug)]
pub(super) struct Move {
    /// The cluster that stays, and the two that move, by place.
    pub(super) places: [usize; 3],
    /// Shared by the first two, by the last two, by the last and the first.
    pub(super) shared: [usize; 3],
    /// Where the shared elements stand: the first and the last in the cluster that stays, then the first and the middle in
    /// the second, the middle and the last in the third.
    pub(super) stay: [usize; 2],
    pub(super) second: [usize; 2],
    pub(super) last: [usize; 2],
}

/// All moves, and how the elements stand in the cluster that is left.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) moves: Vec<Move>,
    /// The place of the cluster that is left.
    pub(super) root: usize,
    /// Its elements.
    pub(super) order: Vec<usize>,
    /// How many times an element is moved.
    pub(super) moved: u64,
}

/// The elements of a cluster in their order, and back.
#[derive(Default)]
struct Order {
    elements: Vec<usize>,
    index: HashMap<usize, usize>,
}

impl Order {
    fn push(&mut self, element: usize) {
        self.index.insert(element, self.elements.len());
        self.elements.push(element);
    }
}

impl Plan {
    /// Every element moves with the smaller clusters only: V log V in all.
    pub(super) fn new(sketch: &Sketch, reduction: &Reduction) -> Self {
        let edges = sketch.graph().edges();
        let mut orders: Vec<Order> = Vec::with_capacity(edges.len());
        for ends in edges {
            let mut order = Order::default();
            ends.iter().for_each(|&v| order.push(v));
            orders.push(order);
        }
        // The place of a cluster is that of the first edge in its largest part.
        let mut place: Vec<usize> = (0..edges.len()).collect();
        let mut moved = 0;
        let mut moves = Vec::with_capacity(reduction.merges.len());
        for merge in &reduction.merges {
            let places = merge.parts.map(|p| place[p]);
            let size = |k: &usize| (orders[places[*k]].elements.len(), 2 - *k);
            let first = (0..3).max_by_key(size).unwrap_or(0);
            let turn = |of: [usize; 3]| [0, 1, 2].map(|k| of[(first + k) % 3]);
            let (places, shared) = (turn(places), turn(merge.shared));
            let at = |k: usize, v: usize| orders[places[k]].index[&v];
            let [x, y, z] = shared;
            moves.push(Move {
                places,
                shared,
                stay: [at(0, x), at(0, z)],
                second: [at(1, x), at(1, y)],
                last: [at(2, y), at(2, z)],
            });
            let gone = [1, 2].map(|k| std::mem::take(&mut orders[places[k]].elements));
            let kept = &mut orders[places[0]];
            kept.push(y);
            moved += 1;
            let others = gone.into_iter().flatten();
            for v in others.filter(|v| !shared.contains(v)) {
                kept.push(v);
                moved += 1;
            }
            place.push(places[0]);
        }
        let root = place.last().copied().unwrap_or(0);
        Self {
            order: std::mem::take(&mut orders[root].elements),
            moves,
            root,
            moved,
        }
    }
}
