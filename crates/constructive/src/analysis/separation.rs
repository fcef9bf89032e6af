//! A pair of vertices without which a graph is in several pieces, in linear time (Hopcroft and Tarjan 1973, as Gutwenger and Mutzel
//! 2001 correct it).
//!
//! # The palm tree
//! A depth-first search makes every edge an arc of the tree, away from the root, or a *frond* back to an ancestor. Of a vertex `low`
//! are the two lowest that fronds reach from the tree below it, each with at most one tree arc and more above it. Arcs leave a vertex in
//! the order of the lowest that they reach; numbers are given so that of two children the one visited later has the lower numbers. Then
//! the search falls into paths, each of tree arcs and one frond that ends it.
//!
//! # The pairs
//! A pair `a`, `b` is one of two kinds. Either all that lies below a child of `b` reaches nothing above `b` but `a`: that is seen
//! from `low`. Or `b` lies below `a`, and what lies between them in the tree, with all that hangs there, reaches neither above `a` nor
//! below `b`: candidates wait on a stack as triples of `a`, `b` and the highest number between, for each path those that it may still
//! end, and arcs that reach too far take them off.

use super::local::Local;

/// An edge of the palm tree, as numbers.
#[derive(Clone, Copy)]
struct Arc {
    to: usize,
    /// Whether it is in the tree, or else a frond.
    tree: bool,
    /// Whether it is the first of its path.
    starts: bool,
}

/// The vertices by their numbers, root 0.
struct Palm {
    /// In the order in which they are looked at.
    arcs: Vec<Vec<Arc>>,
    /// The two lowest numbers reached from below.
    low: Vec<[usize; 2]>,
    /// How many vertices lie below, with this one.
    size: Vec<usize>,
    /// `usize::MAX` of the root.
    parent: Vec<usize>,
    /// Where the first frond to it begins; zero where there is none.
    high: Vec<usize>,
    degree: Vec<usize>,
    /// The vertex that has the number.
    vertex: Vec<usize>,
}

/// Whatever lies between `a` and `b` in the tree has numbers up to `high`.
#[derive(Clone, Copy)]
struct Triple {
    high: usize,
    a: usize,
    b: usize,
}

/// Two vertices without which there are several pieces; `None` where there are none such. The graph has to be in one piece whatever single
/// vertex is left out, and to have four vertices at least. Edges that double others count once.
pub(super) fn separating_pair(graph: &Local) -> Option<[usize; 2]> {
    let near: Vec<Vec<usize>> = graph
        .near
        .iter()
        .map(|near| {
            let mut near: Vec<usize> = near.iter().map(|n| n.0).collect();
            near.sort_unstable();
            near.dedup();
            near
        })
        .collect();
    let first = First::of(&near);
    let palm = Palm::of(&first.ordered(&near), &near, &first);
    Search {
        palm: &palm,
        triples: Vec::new(),
    }
    .pair()
}

/// A first search in any order: what the order of arcs is found by.
struct First {
    /// By vertex; `usize::MAX` before it is visited.
    number: Vec<usize>,
    /// By number.
    order: Vec<usize>,
    parent: Vec<usize>,
    /// By vertex, as numbers.
    low: Vec<[usize; 2]>,
    size: Vec<usize>,
}

impl First {
    fn of(near: &[Vec<usize>]) -> Self {
        let n = near.len();
        let mut first = Self {
            number: vec![usize::MAX; n],
            order: Vec::with_capacity(n),
            parent: vec![usize::MAX; n],
            low: vec![[0; 2]; n],
            size: vec![1; n],
        };
        first.enter(0);
        let mut path: Vec<(usize, usize)> = vec![(0, 0)];
        while let Some(top) = path.last_mut() {
            let (v, looked) = *top;
            let Some(&w) = near[v].get(looked) else {
                path.pop();
                first.leave(v);
                continue;
            };
            top.1 += 1;
            if first.number[w] == usize::MAX {
                first.parent[w] = v;
                first.enter(w);
                path.push((w, 0));
            } else if w != first.parent[v] && first.number[w] < first.number[v] {
                let reached = first.number[w];
                lower(&mut first.low[v], reached);
            }
        }
        first
    }

    fn enter(&mut self, v: usize) {
        self.number[v] = self.order.len();
        self.low[v] = [self.order.len(); 2];
        self.order.push(v);
    }

    fn leave(&mut self, v: usize) {
        let parent = self.parent[v];
        if parent == usize::MAX {
            return;
        }
        self.size[parent] += self.size[v];
        for reached in self.low[v] {
            lower(&mut self.low[parent], reached);
        }
    }

    /// Of every vertex its arcs in the order of the lowest vertex that they reach, and whether they are of the tree. A frond goes
    /// behind the tree arcs that reach the same vertex and another above where they begin, before those that reach it alone.
    fn ordered(&self, near: &[Vec<usize>]) -> Vec<Vec<(usize, bool)>> {
        let mut arcs = Vec::new();
        for (v, near) in near.iter().enumerate() {
            for &w in near {
                let tree = self.parent[w] == v;
                if tree {
                    let [lowest, second] = self.low[w];
                    let alone = second >= self.number[v];
                    arcs.push((3 * lowest + 2 * usize::from(alone), v, w, tree));
                } else if w != self.parent[v] && self.number[w] < self.number[v] {
                    arcs.push((3 * self.number[w] + 1, v, w, tree));
                }
            }
        }
        arcs.sort_by_key(|arc| arc.0);
        let mut out = vec![Vec::new(); near.len()];
        for (_, v, w, tree) in arcs {
            out[v].push((w, tree));
        }
        out
    }
}

/// Takes note of a number that is reached, among the two lowest.
fn lower(low: &mut [usize; 2], reached: usize) {
    if reached < low[0] {
        *low = [reached, low[0]];
    } else if reached > low[0] {
        low[1] = low[1].min(reached);
    }
}

impl Palm {
    fn of(out: &[Vec<(usize, bool)>], near: &[Vec<usize>], first: &First) -> Self {
        let n = out.len();
        let mut number = vec![0; n];
        let mut arcs = vec![Vec::new(); n];
        let mut high = vec![0; n];
        let (mut last, mut starts) = (n, true);
        let mut path: Vec<(usize, usize)> = vec![(0, 0)];
        while let Some(top) = path.last_mut() {
            let (v, looked) = *top;
            let Some(&(w, tree)) = out[v].get(looked) else {
                path.pop();
                last -= 1;
                continue;
            };
            top.1 += 1;
            if tree {
                number[w] = last - first.size[w];
                path.push((w, 0));
            }
            let (from, to) = (number[v], number[w]);
            if !tree && high[to] == 0 {
                high[to] = from;
            }
            arcs[from].push(Arc { to, tree, starts });
            starts = !tree;
        }
        let mut vertex = vec![0; n];
        for (v, &own) in number.iter().enumerate() {
            vertex[own] = v;
        }
        let reached = |visit: usize| number[first.order[visit]];
        let of_parent = |v: usize| number.get(first.parent[v]).copied();
        let of_vertices = vertex.iter();
        Self {
            arcs,
            low: of_vertices
                .clone()
                .map(|&v| first.low[v].map(reached))
                .collect(),
            size: of_vertices.clone().map(|&v| first.size[v]).collect(),
            parent: of_vertices
                .clone()
                .map(|&v| of_parent(v).unwrap_or(usize::MAX))
                .collect(),
            degree: of_vertices.map(|&v| near[v].len()).collect(),
            high,
            vertex,
        }
    }
}

struct Search<'a> {
    palm: &'a Palm,
    /// `None` where a path begins.
    triples: Vec<Option<Triple>>,
}

impl Search<'_> {
    fn pair(&mut self) -> Option<[usize; 2]> {
        let mut path: Vec<(usize, usize)> = vec![(0, 0)];
        while let Some(top) = path.last_mut() {
            let (v, looked) = *top;
            if let Some(&arc) = self.palm.arcs[v].get(looked) {
                top.1 += 1;
                if arc.starts {
                    self.begin(v, arc);
                }
                if arc.tree {
                    path.push((arc.to, 0));
                }
                continue;
            }
            path.pop();
            if let Some(&(above, looked)) = path.last()
                && let Some(pair) = self.back(above, looked - 1)
            {
                return Some(pair.map(|x| self.palm.vertex[x]));
            }
        }
        None
    }

    /// A path begins with this arc: triples that it reaches above of are one with what it makes.
    fn begin(&mut self, v: usize, arc: Arc) {
        let (a, own) = match arc.tree {
            true => (
                self.palm.low[arc.to][0],
                arc.to + self.palm.size[arc.to] - 1,
            ),
            false => (arc.to, v),
        };
        let mut merged: Option<(usize, usize)> = None;
        while let Some(&Some(triple)) = self.triples.last() {
            if triple.a <= a {
                break;
            }
            let so_far = merged.map_or(0, |(high, _)| high);
            merged = Some((triple.high.max(so_far), triple.b));
            self.triples.pop();
        }
        let (high, b) = match merged {
            None => (own, v),
            Some((high, b)) if arc.tree => (high.max(own), b),
            Some(found) => found,
        };
        self.triples.push(Some(Triple { high, a, b }));
        if arc.tree {
            self.triples.push(None);
        }
    }

    /// Back at `v` from the tree arc at this place of its arcs.
    fn back(&mut self, v: usize, place: usize) -> Option<[usize; 2]> {
        let palm = self.palm;
        let (arc, later) = (palm.arcs[v][place], &palm.arcs[v][place + 1..]);
        let w = arc.to;
        if v != 0 {
            let below = palm.arcs[w].iter().find(|a| a.tree);
            if let (2, Some(below)) = (palm.degree[w], below) {
                return Some([v, below.to]);
            }
            while let Some(&Some(Triple { a, b, .. })) = self.triples.last() {
                if a != v {
                    break;
                }
                if palm.parent[b] != a {
                    return Some([a, b]);
                }
                // Nothing lies between.
                self.triples.pop();
            }
        }
        let [lowest, second] = palm.low[w];
        // Something else than the two and what lies below `w`.
        let others = palm.parent[v] != 0 || later.iter().any(|a| a.tree);
        if lowest < v && second >= v && others {
            return Some([lowest, v]);
        }
        if arc.starts {
            while matches!(self.triples.pop(), Some(Some(_))) {}
        }
        while let Some(&Some(t)) = self.triples.last() {
            if t.a == v || t.b == v || palm.high[v] <= t.high {
                break;
            }
            self.triples.pop();
        }
        None
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::blocks::blocks_without;
    use super::*;
    use crate::graph::Graph;
    use crate::samples::{self, Random};

    fn local(graph: &Graph) -> Local {
        let vertices = graph.vertices();
        let edges = graph.edges().iter().copied();
        Local::new((0..vertices).collect(), edges, &mut vec![0; vertices])
    }

    /// Whether leaving both out leaves several pieces, tried.
    fn separates(graph: &Local, pair: [usize; 2]) -> bool {
        graph.components_without(&pair).1 > 1
    }

    #[test]
    fn a_pair_is_found_exactly_where_trying_all_finds_one() {
        let mut random = Random::new(17);
        let mut seen = [0; 2];
        for round in 0..6000 {
            let n = 4 + random.below(12);
            let graph = match round % 3 {
                0 => samples::henneberg(n, 95, &mut random),
                1 => samples::glued(n, &mut random),
                _ => {
                    let edges = n + random.below(2 * n);
                    samples::any(n, edges, &mut random)
                }
            };
            let graph = local(&graph);
            if !blocks_without(&graph, usize::MAX).is_one(n) {
                continue;
            }
            let mut all = (0..n).flat_map(|b| (0..b).map(move |a| [a, b]));
            let one = all.find(|&pair| separates(&graph, pair));
            let found = separating_pair(&graph);
            assert_eq!(found.is_some(), one.is_some(), "{:?}", graph.near);
            assert!(found.is_none_or(|pair| separates(&graph, pair)));
            seen[usize::from(found.is_some())] += 1;
        }
        assert!(seen.iter().all(|&s| s > 100), "{seen:?}");
    }

    #[test]
    fn a_ring_of_any_length_is_searched_without_recursion() {
        // A wheel has no pair, a ring with one chord has many.
        let n = 100_000;
        let ring = || (0..n).map(|k| [k, (k + 1) % n]);
        let chord = Graph::new(n, ring().chain([[0, n / 2]])).unwrap();
        let chord = local(&chord);
        let pair = separating_pair(&chord).unwrap();
        assert!(separates(&chord, pair));
        let spokes = (0..n).map(|k| [k, n]);
        let wheel = Graph::new(n + 1, ring().chain(spokes)).unwrap();
        assert_eq!(separating_pair(&local(&wheel)), None);
    }

    #[test]
    fn doubled_edges_are_one() {
        let square = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 1]];
        let place = &mut [0; 4];
        let square = Local::new((0..4).collect(), square.into_iter(), place);
        let pair = separating_pair(&square).unwrap();
        assert!(separates(&square, pair));
    }
}
