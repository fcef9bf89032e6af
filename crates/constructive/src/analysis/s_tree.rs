//! Owen's algorithm as Soto i Riera reformulated it: a binary tree of splits at pairs of vertices.
//!
//! At a *separating pair* the graph splits in two; an edge between the two vertices goes to one side. Of a well-constrained graph
//! one side is well-constrained and holds the pair rigid; the other lacks one edge and gets a *virtual* one for that, so that
//! Deficit(G) = Deficit(G′) + Deficit(G″) − 1 goes on to hold. Leaves have no separating pair. The graph is constructive
//! where all leaves are triangles.
//!
//! # What it costs
//! Vertices of two edges are split off in constant time each. Every other split, and every leaf that has no pair, costs one search for a
//! separating pair, linear in its edges: a virtual edge on one side is none on the other, so that triconnected components have to be
//! found anew there.

use super::blocks::blocks_without;
use super::local::Local;
use super::peeling::Peeling;
use super::separation::separating_pair;
use crate::graph::{Graph, deficit};
use std::collections::BTreeSet;

/// What an edge of a leaf stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tie {
    /// A constraint: an edge of the graph.
    Edge(usize),
    /// What the other side of this split does to its pair: an index of [`STree::nodes`].
    Virtual(usize),
}

/// What a leaf is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeafKind {
    /// Two vertices and the edge between them: the whole graph.
    Edge,
    /// Three vertices, three edges: constructed by two intersections at most.
    Triangle,
    /// No separating pair: not to be constructed.
    Triconnected,
    /// Not even in one piece without some vertex, or too few vertices with the wrong number of edges: not well-constrained.
    Loose,
}

/// A node of the s-tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node {
    /// Two graphs that share a pair of vertices.
    Split {
        /// The pair, ascending.
        pair: [usize; 2],
        /// The nodes of the two sides.
        sides: [usize; 2],
        /// The side, 0 or 1, that has the virtual edge.
        virtual_in: usize,
    },
    /// What has no separating pair.
    Leaf {
        /// What it is.
        kind: LeafKind,
        /// Its vertices, ascending.
        vertices: Vec<usize>,
        /// Its edges.
        edges: Vec<([usize; 2], Tie)>,
    },
}

/// The binary tree of splits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct STree {
    /// The root first, every split before its sides.
    pub nodes: Vec<Node>,
    /// Whether all leaves are triangles, or the whole is an edge.
    pub solved: bool,
    /// Vertices looked at.
    pub steps: u64,
}

impl STree {
    /// How many leaves of this kind there are.
    #[must_use]
    pub fn leaves(&self, wanted: LeafKind) -> usize {
        let is = |n: &&Node| matches!(n, Node::Leaf { kind, .. } if *kind == wanted);
        self.nodes.iter().filter(is).count()
    }
}

/// Splits the graph as far as it goes. Depends on the order of vertices and edges only.
#[must_use]
pub fn s_tree(graph: &Graph) -> STree {
    let edges = graph.edges().iter().enumerate();
    let whole = Piece {
        vertices: (0..graph.vertices()).collect(),
        edges: edges.map(|(e, &ends)| (ends, Tie::Edge(e))).collect(),
        node: 0,
    };
    let mut state = State {
        place: vec![0; graph.vertices()],
        nodes: vec![unseen()],
        open: vec![whole],
        steps: 0,
    };
    while let Some(piece) = state.open.pop() {
        state.take_apart(piece);
    }
    let bad = |n: &Node| {
        use LeafKind::{Loose, Triconnected};
        matches!(
            n,
            Node::Leaf {
                kind: Loose | Triconnected,
                ..
            }
        )
    };
    STree {
        solved: !state.nodes.iter().any(bad),
        nodes: state.nodes,
        steps: state.steps,
    }
}

/// A graph that is still to be split.
struct Piece {
    /// Ascending.
    vertices: Vec<usize>,
    edges: Vec<([usize; 2], Tie)>,
    node: usize,
}

impl Piece {
    fn deficit(&self) -> i64 {
        deficit(self.vertices.len(), self.edges.len())
    }
}

struct State {
    place: Vec<usize>,
    nodes: Vec<Node>,
    open: Vec<Piece>,
    steps: u64,
}

/// What stands for a node until it is looked at.
fn unseen() -> Node {
    Node::Leaf {
        kind: LeafKind::Loose,
        vertices: Vec::new(),
        edges: Vec::new(),
    }
}

impl State {
    fn local(&mut self, piece: &Piece) -> Local {
        self.steps += piece.vertices.len() as u64;
        let ends = piece.edges.iter().map(|e| e.0);
        Local::new(piece.vertices.clone(), ends, &mut self.place)
    }

    fn take_apart(&mut self, mut piece: Piece) {
        // Only there it is the ear that gets the virtual edge.
        if piece.deficit() <= 0 {
            self.peel(&mut piece);
        }
        if piece.vertices.len() <= 3 {
            let kind = small(&piece);
            return self.leaf(piece, kind);
        }
        let local = self.local(&piece);
        if !blocks_without(&local, usize::MAX).is_one(local.len()) {
            return self.leaf(piece, LeafKind::Loose);
        }
        self.steps += local.len() as u64;
        match separating_pair(&local) {
            Some(pair) => self.split(piece, &local, pair),
            None => self.leaf(piece, LeafKind::Triconnected),
        }
    }

    fn leaf(&mut self, piece: Piece, kind: LeafKind) {
        self.nodes[piece.node] = Node::Leaf {
            kind,
            vertices: piece.vertices,
            edges: piece.edges,
        };
    }

    /// Two new nodes for the sides of this one.
    fn add(&mut self, node: usize, mut pair: [usize; 2], virtual_in: usize) -> [usize; 2] {
        let sides = [self.nodes.len(), self.nodes.len() + 1];
        self.nodes.extend([unseen(), unseen()]);
        pair.sort_unstable();
        self.nodes[node] = Node::Split {
            pair,
            sides,
            virtual_in,
        };
        sides
    }

    /// Splits off vertices of two edges, each as a triangle with a virtual edge.
    fn peel(&mut self, piece: &mut Piece) {
        let local = self.local(piece);
        let mut peeling = Peeling::new(&local);
        while let Some((c, near)) = peeling.next(3) {
            self.steps += 1;
            let [a, b] = near.map(|n| local.vertices[n.0]);
            let [ear, rest] = self.add(piece.node, [a, b], 0);
            let mut vertices = vec![a, b, local.vertices[c]];
            vertices.sort_unstable();
            let ties = near.map(|n| piece.edges[n.1]);
            self.nodes[ear] = Node::Leaf {
                kind: LeafKind::Triangle,
                vertices,
                edges: vec![ties[0], ties[1], ([a, b], Tie::Virtual(piece.node))],
            };
            piece.node = rest;
        }
        let place = &self.place;
        let left = |v: usize| peeling.is_left(place[v]);
        piece
            .edges
            .retain(|(ends, _)| ends.iter().all(|&v| left(v)));
        piece.vertices.retain(|&v| left(v));
    }

    /// The component with the first vertex against all others; edges between the two of the pair go with the others.
    fn split(&mut self, piece: Piece, local: &Local, pair: [usize; 2]) {
        let (component, _) = local.components_without(&pair);
        let one = |v: usize| component[v] == 0;
        let is_pair = |v: usize| pair.contains(&v);
        let chosen = |want: fn(bool, bool) -> bool| -> Vec<usize> {
            let inside = (0..local.len()).filter(|&v| want(one(v), is_pair(v)));
            inside.map(|v| local.vertices[v]).collect()
        };
        let vertices = [chosen(|one, pair| one || pair), chosen(|one, _| !one)];
        let (first, second): (Vec<_>, Vec<_>) = piece
            .edges
            .iter()
            .partition(|(ends, _)| ends.iter().any(|&v| one(self.place[v])));
        let ends = pair.map(|v| local.vertices[v]);
        let larger =
            deficit(vertices[0].len(), first.len()) > deficit(vertices[1].len(), second.len());
        let virtual_in = usize::from(!larger);
        let nodes = self.add(piece.node, ends, virtual_in);
        for (side, (vertices, mut edges)) in vertices.into_iter().zip([first, second]).enumerate() {
            if side == virtual_in {
                edges.push((ends, Tie::Virtual(piece.node)));
            }
            let node = nodes[side];
            self.open.push(Piece {
                vertices,
                edges,
                node,
            });
        }
    }
}

/// What two or three vertices are. Virtual edges of what is over-constrained may double others.
fn small(piece: &Piece) -> LeafKind {
    let ends: BTreeSet<[usize; 2]> = piece
        .edges
        .iter()
        .map(|&([u, v], _)| [u.min(v), u.max(v)])
        .collect();
    match (piece.vertices.len(), piece.edges.len(), ends.len()) {
        (2, 1, 1) => LeafKind::Edge,
        (3, 3, 3) => LeafKind::Triangle,
        _ => LeafKind::Loose,
    }
}
