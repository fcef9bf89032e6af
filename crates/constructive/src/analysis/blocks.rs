//! What stays in one piece when any one vertex is taken out (Hopcroft and Tarjan 1973).

use super::local::Local;

/// The blocks of a graph with one vertex left out.
pub(super) struct Blocks {
    /// The vertices of each.
    pub(super) blocks: Vec<Vec<usize>>,
    /// Whether a vertex lies in several.
    pub(super) cut: Vec<bool>,
    /// Whether there is one component, the vertex left out aside.
    pub(super) connected: bool,
}

impl Blocks {
    /// Whether all of so many vertices are in one block.
    pub(super) fn is_one(&self, vertices: usize) -> bool {
        self.blocks.len() == 1 && self.blocks[0].len() == vertices
    }
}

struct Search<'a> {
    graph: &'a Local,
    order: Vec<usize>,
    low: Vec<usize>,
    next: usize,
    waiting: Vec<usize>,
    found: Blocks,
}

/// Linear in what is left. Vertices without edges are no block.
pub(super) fn blocks_without(graph: &Local, out: usize) -> Blocks {
    let n = graph.len();
    let mut search = Search {
        graph,
        order: vec![usize::MAX; n],
        low: vec![0; n],
        next: 0,
        waiting: Vec::new(),
        found: Blocks {
            blocks: Vec::new(),
            cut: vec![false; n],
            connected: true,
        },
    };
    if let Some(order) = search.order.get_mut(out) {
        // Looks as if it had been finished long ago.
        *order = n;
    }
    let mut components = 0;
    for root in 0..n {
        if search.order[root] == usize::MAX {
            components += 1;
            search.from(root, out);
        }
    }
    search.found.connected = components <= 1;
    search.found
}

impl Search<'_> {
    fn from(&mut self, root: usize, out: usize) {
        self.enter(root);
        let mut children_of_root = 0;
        // Vertex, its parent, and how many of its edges were looked at.
        let mut path = vec![(root, root, 0)];
        while let Some(top) = path.last_mut() {
            let (v, parent, looked) = *top;
            if let Some(&(w, _)) = self.graph.near[v].get(looked) {
                top.2 += 1;
                if w == parent || w == out {
                    continue;
                }
                if self.order[w] == usize::MAX {
                    self.enter(w);
                    path.push((w, v, 0));
                } else {
                    self.low[v] = self.low[v].min(self.order[w]);
                }
                continue;
            }
            path.pop();
            if v == root {
                break;
            }
            self.low[parent] = self.low[parent].min(self.low[v]);
            if self.low[v] >= self.order[parent] {
                children_of_root += usize::from(parent == root);
                self.found.cut[parent] |= parent != root || children_of_root > 1;
                self.finish(v, parent);
            }
        }
        // The root itself.
        self.waiting.pop();
    }

    fn enter(&mut self, v: usize) {
        self.order[v] = self.next;
        self.low[v] = self.next;
        self.next += 1;
        self.waiting.push(v);
    }

    /// Everything that waits from `v` on, and `parent`.
    fn finish(&mut self, v: usize, parent: usize) {
        let mut block = vec![parent];
        while let Some(w) = self.waiting.pop() {
            block.push(w);
            if w == v {
                break;
            }
        }
        self.found.blocks.push(block);
    }
}
