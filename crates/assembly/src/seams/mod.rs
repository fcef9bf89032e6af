//! Which incidences to ask for where all of them, in measured data, contradict one another.
//!
//! # The problem
//! Bodies that share points satisfy more equations than they have degrees of freedom: two points that two bodies share are equally far
//! apart in both, so that five of their six equations imply the sixth, and a point of three bodies is brought together by
//! two of three pairs. In measured data what is implied contradicts the rest a little. As many equations as are independent are wanted,
//! among them those by which an incidence tree places its bodies.
//!
//! # How
//! The *seam graph* has a copy of each point for each body that has it. *Point seam edges* join two copies of one point, *line seam
//! edges* the copies, in one body, of two points that another body has as well. A set of point seam edges that holds a cycle of the
//! copies of one point is a *local cycle*: its last edge is implied whole. Along the line through two points that bodies share, what brings
//! one point together brings the other, too: of its three equations one is implied. Edges of which this is so make a *seam cycle*; a
//! *seam tree* is as large as can be without.
//!
//! Selected are three equations for each edge of a seam tree, and two for every other edge that makes no local cycle. They
//! begin with the edges of the incidence tree. The greedy choice never has to be taken back, since both kinds of cycles are those of matroids.
//!
//! # What it costs
//! One elimination of as many vectors as there are point seam edges, over a prime field.
//!
//! Source: M. Sitharam, Y. Zhou, J. Peters, "Reconciling conflicting combinatorial preprocessors for geometric constraint systems"
//! (2010), sections 4 to 6; M. Sitharam, "Characterizing well-formed systems of incidences" (2006).

mod elimination;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;

use crate::collection::Collection;
use crate::tree::IncidenceTree;
use elimination::Elimination;
use petgraph::unionfind::UnionFind;
use std::collections::BTreeMap;

/// Degrees of freedom of a point.
const POINT: i64 = 3;
/// Of two points at a fixed distance.
const PAIR: i64 = 5;

/// A copy of a point: the point and the body that has it.
pub type Copied = (usize, usize);

/// The copies of points, and pairs of points that bodies share.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SeamGraph {
    /// The bodies.
    pub bodies: Vec<usize>,
    /// Copies of points that several of the bodies have: by point, then by body.
    pub copies: Vec<Copied>,
    /// Pairs of points that two of the bodies share, and the bodies that have both.
    pub pairs: BTreeMap<[usize; 2], Vec<usize>>,
}

/// A point seam edge that is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seam {
    /// The point.
    pub point: usize,
    /// The bodies whose copies are brought together.
    pub bodies: [usize; 2],
    /// Equations: three of a seam tree, two of others.
    pub equations: usize,
    /// Whether the incidence tree places a body by it.
    pub of_tree: bool,
}

/// A well-formed selection.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selection {
    /// The edges, those of the incidence tree first.
    pub seams: Vec<Seam>,
    /// Degrees of freedom that sharing points removes, see [`removed_freedoms`].
    pub removed: i64,
}

impl Selection {
    /// How many equations there are.
    #[must_use]
    pub fn equations(&self) -> usize {
        self.seams.iter().map(|s| s.equations).sum()
    }
}

impl SeamGraph {
    /// Of some bodies of a collection.
    #[must_use]
    pub fn of(collection: &Collection, bodies: &[usize]) -> Self {
        let mut holders: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for &body in bodies {
            for &point in &collection.bodies()[body].points {
                holders.entry(point).or_default().push(body);
            }
        }
        let mut pairs: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (i, &one) in bodies.iter().enumerate() {
            for &other in &bodies[i + 1..] {
                let shared = collection.shared(one, other);
                for (k, &a) in shared.iter().enumerate() {
                    for &b in &shared[k + 1..] {
                        let both = pairs.entry([a, b]).or_default();
                        both.extend([one, other]);
                    }
                }
            }
        }
        for both in pairs.values_mut() {
            both.sort_unstable();
            both.dedup();
        }
        let shared = holders.into_iter().filter(|(_, bodies)| bodies.len() > 1);
        let copies = shared.flat_map(|(point, bodies)| bodies.into_iter().map(move |b| (point, b)));
        Self {
            bodies: bodies.to_vec(),
            copies: copies.collect(),
            pairs,
        }
    }

    /// Line seam edges: copies of two points in one body that others have as well.
    pub fn line_edges(&self) -> impl Iterator<Item = [Copied; 2]> {
        let of = |(pair, bodies): (&[usize; 2], &Vec<usize>)| {
            let [a, b] = *pair;
            let edge = move |&body: &usize| [(a, body), (b, body)];
            bodies.iter().map(edge).collect::<Vec<_>>()
        };
        self.pairs.iter().flat_map(of)
    }

    /// Point seam edges: any two copies of a point.
    fn point_edges(&self) -> impl Iterator<Item = (usize, [usize; 2])> {
        let pairs = self
            .copies
            .iter()
            .enumerate()
            .flat_map(|(i, &(point, one))| {
                let others = self.copies[i + 1..].iter();
                let same = others.take_while(move |(p, _)| *p == point);
                same.map(move |&(_, other)| (point, [one, other]))
            });
        pairs.collect::<Vec<_>>().into_iter()
    }

    fn place(&self, copy: Copied) -> usize {
        self.copies.partition_point(|c| *c < copy)
    }
}

/// Degrees of freedom that the points shared by some bodies remove, by inclusion and exclusion: Σ (−1)^|Q| dof(∩Q) over all Q of two
/// bodies or more, where a point has three and two points have five.
///
/// Bodies that share more than two points count as those that share two.
#[must_use]
pub fn removed_freedoms(collection: &Collection, bodies: &[usize]) -> i64 {
    // A point of s bodies is in C(s, k) sets of k of them, so that it counts s − 1 times in all; so does a pair, once less than its points.
    let graph = SeamGraph::of(collection, bodies);
    let mut of_point: BTreeMap<usize, i64> = BTreeMap::new();
    for (point, _) in &graph.copies {
        *of_point.entry(*point).or_insert(-1) += 1;
    }
    let pairs = graph.pairs.values().map(|bodies| bodies.len() as i64 - 1);
    POINT * of_point.values().sum::<i64>() + (PAIR - 2 * POINT) * pairs.sum::<i64>()
}

/// The greedy selection that begins with the edges of an incidence tree, among the bodies of its covering set.
#[must_use]
pub fn well_formed(collection: &Collection, tree: &IncidenceTree) -> Selection {
    let graph = SeamGraph::of(collection, &tree.cover);
    let mut selecting = Selecting::new(&graph);
    // The first point of a shared pair gets three equations, the second two.
    let placed = |k: usize| {
        tree.edges.iter().filter_map(move |edge| {
            let bodies = [edge.parent, edge.child];
            edge.shared.get(k).map(|&point| (point, bodies))
        })
    };
    for (point, bodies) in placed(0) {
        selecting.join_whole(point, bodies, true);
    }
    for (point, bodies) in graph.point_edges() {
        selecting.join_whole(point, bodies, false);
    }
    for (point, bodies) in placed(1) {
        selecting.join(point, bodies, true);
    }
    for (point, bodies) in graph.point_edges() {
        selecting.join(point, bodies, false);
    }
    let mut seams = selecting.seams;
    seams.sort_by_key(|s| (!s.of_tree, s.point, s.bodies));
    Selection {
        seams,
        removed: removed_freedoms(collection, &tree.cover),
    }
}

/// A selection that grows.
struct Selecting<'a> {
    graph: &'a SeamGraph,
    /// Copies that are brought together: without local cycles.
    together: UnionFind<usize>,
    /// Differences of copies, in which the differences along a pair are the same in all bodies.
    seams_of_tree: Elimination,
    seams: Vec<Seam>,
}

impl<'a> Selecting<'a> {
    fn new(graph: &'a SeamGraph) -> Self {
        let mut seams_of_tree = Elimination::default();
        for (index, (pair, bodies)) in graph.pairs.iter().enumerate() {
            for &body in bodies {
                let [a, b] = pair.map(|point| graph.place((point, body)));
                seams_of_tree.add(&[(a, 1), (b, -1), (graph.copies.len() + index, -1)]);
            }
        }
        Self {
            together: UnionFind::new(graph.copies.len()),
            seams_of_tree,
            graph,
            seams: Vec::new(),
        }
    }

    /// Three equations, unless one of them is implied.
    fn join_whole(&mut self, point: usize, bodies: [usize; 2], of_tree: bool) {
        let [one, other] = bodies.map(|body| self.graph.place((point, body)));
        if self.together.find(one) != self.together.find(other)
            && self.seams_of_tree.add(&[(one, 1), (other, -1)])
        {
            self.together.union(one, other);
            self.keep(point, bodies, 3, of_tree);
        }
    }

    /// Two equations, unless they are implied.
    fn join(&mut self, point: usize, bodies: [usize; 2], of_tree: bool) {
        let [one, other] = bodies.map(|body| self.graph.place((point, body)));
        if self.together.union(one, other) {
            self.keep(point, bodies, 2, of_tree);
        }
    }

    fn keep(&mut self, point: usize, bodies: [usize; 2], equations: usize, of_tree: bool) {
        self.seams.push(Seam {
            point,
            bodies,
            equations,
            of_tree,
        });
    }
}
