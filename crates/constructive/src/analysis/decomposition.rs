//! Decomposition: all vertices fall into three sets that share one vertex pairwise, and so on down to the edges.
//!
//! A vertex of two edges is split off at once. Where there is none, a vertex `c` that two of the three sets share is sought: without
//! it the third is a block of what is left, and only two vertices of that block, `a` and `b`, touch anything else. A set is
//! linear in its edges while it has vertices of two edges, and costs V·E at worst where not.

use super::blocks::{Blocks, blocks_without};
use super::local::Local;
use super::peeling::Peeling;
use crate::graph::{Graph, deficit};

/// A set of vertices that fell into three.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SetDecomposition {
    /// The three sets.
    pub parts: [Part; 3],
    /// The vertices that they share: first with second, second with third, third with first.
    pub shared: [usize; 3],
}

/// A node of the decomposition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// The two ends of this edge.
    Edge(usize),
    /// What falls apart further: an index of [`Decomposition::sets`].
    Set(usize),
    /// Vertices, ascending, that do not fall apart: triconnected, or not well-constrained.
    Stuck(Vec<usize>),
}

/// What decomposition leads to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decomposition {
    /// The sets that fell apart, each before its parts.
    pub sets: Vec<SetDecomposition>,
    /// All vertices.
    pub root: Part,
    /// Whether only edges are left.
    pub solved: bool,
    /// Edges looked at.
    pub steps: u64,
}

/// Takes the graph apart by the rule as far as it goes. Every set that falls apart has as many edges as a well-constrained one.
#[must_use]
pub fn decompose(graph: &Graph) -> Decomposition {
    let mut state = State {
        graph,
        place: vec![0; graph.vertices()],
        sets: Vec::new(),
        root: Part::Stuck(Vec::new()),
        open: Vec::new(),
        steps: 0,
    };
    state.open.push(Open {
        vertices: (0..graph.vertices()).collect(),
        edges: (0..graph.edges().len()).collect(),
        slot: None,
    });
    while let Some(open) = state.open.pop() {
        state.take_apart(open);
    }
    let parts = state.sets.iter().flat_map(|s| &s.parts);
    let solved = !parts
        .chain([&state.root])
        .any(|p| matches!(p, Part::Stuck(_)));
    Decomposition {
        sets: state.sets,
        root: state.root,
        solved,
        steps: state.steps,
    }
}

/// Of which set something is which part; `None` for the whole.
type Slot = Option<(usize, usize)>;

/// A part that was not looked at yet.
struct Open {
    /// Ascending.
    vertices: Vec<usize>,
    edges: Vec<usize>,
    slot: Slot,
}

struct State<'a> {
    graph: &'a Graph,
    place: Vec<usize>,
    sets: Vec<SetDecomposition>,
    root: Part,
    open: Vec<Open>,
    steps: u64,
}

/// Three sets of vertices, and the vertices they share as in [`SetDecomposition`].
type Found = ([Vec<usize>; 3], [usize; 3]);

impl State<'_> {
    fn put(&mut self, slot: Slot, part: Part) {
        match slot {
            None => self.root = part,
            Some((set, which)) => self.sets[set].parts[which] = part,
        }
    }

    fn add(&mut self, slot: Slot, parts: [Part; 3], shared: [usize; 3]) -> usize {
        let set = self.sets.len();
        self.sets.push(SetDecomposition { parts, shared });
        self.put(slot, Part::Set(set));
        set
    }

    fn take_apart(&mut self, mut open: Open) {
        if deficit(open.vertices.len(), open.edges.len()) != 0 {
            return self.put(open.slot, Part::Stuck(open.vertices));
        }
        self.peel(&mut open);
        if let [_, _] = open.vertices[..] {
            return self.put(open.slot, Part::Edge(open.edges[0]));
        }
        let local = self.local(&open);
        match self.found(&local) {
            None => self.put(open.slot, Part::Stuck(open.vertices)),
            Some((parts, shared)) => self.open_parts(&open, parts, shared),
        }
    }

    fn local(&mut self, open: &Open) -> Local {
        let ends = open.edges.iter().map(|&e| self.graph.edges()[e]);
        Local::new(open.vertices.clone(), ends, &mut self.place)
    }

    /// Vertices of two edges, one after the other: these edges and the rest are the three sets.
    fn peel(&mut self, open: &mut Open) {
        let local = self.local(open);
        let mut peeling = Peeling::new(&local);
        while let Some((c, [(a, first), (b, last)])) = peeling.next(2) {
            self.steps += 1;
            let edge = |e: usize| Part::Edge(open.edges[e]);
            let rest = Part::Stuck(Vec::new()); // until it is looked at
            let set = self.add(
                open.slot,
                [edge(first), rest, edge(last)],
                [a, b, c].map(|v| local.vertices[v]),
            );
            open.slot = Some((set, 1));
        }
        let kept = |e: &usize| {
            let ends = self.graph.edges()[*e];
            ends.iter().all(|&v| peeling.is_left(self.place[v]))
        };
        open.edges.retain(kept);
        let left = (0..local.len()).filter(|&v| peeling.is_left(v));
        open.vertices = left.map(|v| local.vertices[v]).collect();
    }

    /// Three sets, by a vertex that two of them share. Those with few edges are tried first.
    fn found(&mut self, local: &Local) -> Option<Found> {
        let mut order: Vec<usize> = (0..local.len()).collect();
        order.sort_by_key(|&v| local.near[v].len());
        order.into_iter().find_map(|c| {
            self.steps += local.len() as u64;
            let Blocks {
                blocks,
                cut,
                connected,
            } = blocks_without(local, c);
            let touches = |v: usize| cut[v] || local.near[v].iter().any(|&(w, _)| w == c);
            connected.then_some(())?;
            let ends = |block: &Vec<usize>| {
                let mut touching = block.iter().copied().filter(|&v| touches(v));
                let (a, b) = (touching.next()?, touching.next()?);
                touching.next().is_none().then_some((a, b))
            };
            blocks.iter().find_map(|block| {
                let (a, b) = ends(block)?;
                three_sets(local, block, [a, b, c])
            })
        })
    }

    fn open_parts(&mut self, open: &Open, parts: [Vec<usize>; 3], shared: [usize; 3]) {
        let empty = [0; 3].map(|_| Part::Stuck(Vec::new()));
        let set = self.add(open.slot, empty, shared);
        for (which, vertices) in parts.into_iter().enumerate() {
            for &v in &open.vertices {
                self.place[v] = usize::MAX;
            }
            for &v in &vertices {
                self.place[v] = 0;
            }
            let inside = |e: &&usize| {
                let ends = self.graph.edges()[**e];
                ends.iter().all(|&v| self.place[v] == 0)
            };
            self.open.push(Open {
                edges: open.edges.iter().filter(inside).copied().collect(),
                vertices,
                slot: Some((set, which)),
            });
        }
    }
}

/// The block, which touches the rest at `a` and `b` only, and what hangs at each of the two up to `c`.
fn three_sets(local: &Local, block: &[usize], [a, b, c]: [usize; 3]) -> Option<Found> {
    let (component, count) = local.components_without(&[a, b, c]);
    let mut set_of = vec![None; count];
    for &v in block.iter().filter(|v| ![a, b].contains(v)) {
        set_of[component[v]] = Some(0);
    }
    for (end, set) in [(b, 1), (a, 2)] {
        for &(w, _) in &local.near[end] {
            if ![a, b, c].contains(&w) && *set_of[component[w]].get_or_insert(set) != set {
                // Of the block itself, or of both: then the block would have been larger.
                if set_of[component[w]] != Some(0) {
                    return None;
                }
            }
        }
    }
    let mut sets = [vec![a, b], vec![b, c], vec![a, c]];
    for v in (0..local.len()).filter(|v| ![a, b, c].contains(v)) {
        sets[set_of[component[v]]?].push(v);
    }
    for set in &mut sets {
        set.sort_unstable();
        set.iter_mut().for_each(|v| *v = local.vertices[*v]);
    }
    Some((sets, [b, c, a].map(|v| local.vertices[v])))
}
