//! Incidence trees: which bodies to place by which others, so that the fewest unknowns are left.
//!
//! # The problem
//! Some bodies that together have all points, a *covering set*, are joined by a tree of overlaps. Placing each body by its
//! parent leaves as many unknowns as the tree weighs ([`overlap_weight`](crate::collection::overlap_weight)); everything
//! else becomes an equation. Wanted is the lightest tree over **all** covering sets (the smallest set is as a rule not the
//! best), and among these the one whose bodies are nearest to the root: depths make degrees.
//!
//! # What it costs
//! The weight of the lightest tree of a set is a count of components (`cover.rs`), so that all sets of up to
//! [`EXACT_BODIES`] bodies are tried: at worst a second. Beyond that bodies are dropped one by one while that
//! makes the tree lighter, and [`IncidenceTree::exact`] says that it is not known to be the best.
//!
//! Source: Sitharam, Peters, Zhou (2010), section 4.1, part 1.

mod cover;
mod depth;

pub use cover::{Cover, covering_sets};

use crate::collection::Collection;
use cover::{Overlaps, best_covers};

/// Collections of up to so many bodies are solved exactly.
pub const EXACT_BODIES: usize = 20;

/// An edge of an incidence tree: a body placed by another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeEdge {
    /// The body that is placed already.
    pub parent: usize,
    /// The body that is placed by it.
    pub child: usize,
    /// The points that both have.
    pub shared: Vec<usize>,
    /// Unknowns that are left.
    pub weight: usize,
}

/// A rooted tree of overlaps over a covering set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct IncidenceTree {
    /// The bodies, ascending.
    pub cover: Vec<usize>,
    /// The body that stays where it is.
    pub root: usize,
    /// Parents before their children.
    pub edges: Vec<TreeEdge>,
    /// Sum of the weights: the number of unknowns.
    pub weight: usize,
    /// Sum of the depths of all bodies.
    pub depth_sum: usize,
    /// Whether no covering set has a lighter tree: proven by trying all of them.
    pub exact: bool,
    /// Whether no lightest tree has a smaller sum of depths, as far as all of them were compared.
    pub shallowest: bool,
}

/// The best incidence tree among the bodies that may be used, with those that are needed; `None` where these do not have all points of the collection's
/// bodies, or there is no body at all. Ties go to the smaller sum of depths, then to the bodies that come first.
#[must_use]
pub fn optimal_incidence_tree(
    collection: &Collection,
    needed: &[usize],
    may_use: impl Fn(usize) -> bool,
) -> Option<IncidenceTree> {
    let overlaps = Overlaps::new(collection);
    let usable: Vec<usize> = (0..collection.bodies().len())
        .filter(|&b| may_use(b))
        .collect();
    let (covers, exact) = best_covers(&overlaps, needed, &usable)?;
    depth::shallowest(collection, &overlaps, covers, exact)
}

/// Why there is no such tree.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoTree {
    /// A body that two others place, or that places itself, over others or at once.
    #[error("`{0}` would be placed twice or by itself")]
    Twice(String),
    /// Two bodies that nothing joins.
    #[error("`{0}` and `{1}` are not joined: there has to be one body that is not placed")]
    Apart(String, String),
    /// A point that no body of the tree has.
    #[error("no body of the tree has `{0}`")]
    NotCovered(String),
}

/// The tree in which each child is placed by a parent, as pairs of child and parent.
///
/// # Errors
/// [`NoTree`] where these are no tree, or one of bodies that do not have all points.
pub fn tree_along(collection: &Collection, pairs: &[[usize; 2]]) -> Result<IncidenceTree, NoTree> {
    let name = |body: usize| collection.bodies()[body].name.clone();
    for (i, [child, parent]) in pairs.iter().enumerate() {
        if child == parent || pairs[..i].iter().any(|[other, _]| other == child) {
            return Err(NoTree::Twice(name(*child)));
        }
    }
    let mut cover: Vec<usize> = pairs.iter().flatten().copied().collect();
    cover.sort_unstable();
    cover.dedup();
    let placed = |body: &usize| pairs.iter().any(|[child, _]| child == body);
    let mut roots = cover.iter().copied().filter(|b| !placed(b));
    let root = match (roots.next(), cover.first()) {
        (Some(root), _) => root,
        // A circle.
        (None, Some(&first)) => return Err(NoTree::Twice(name(first))),
        (None, None) => return Err(NoTree::NotCovered(String::new())),
    };
    if let Some(other) = roots.next() {
        return Err(NoTree::Apart(name(root), name(other)));
    }
    let overlaps = Overlaps::new(collection);
    let mut depths = vec![(root, 0)];
    let mut edges = Vec::new();
    let mut next = 0;
    while let Some(&(parent, depth)) = depths.get(next) {
        for &[child, _] in pairs.iter().filter(|[_, p]| *p == parent) {
            depths.push((child, depth + 1));
            edges.push(TreeEdge {
                parent,
                child,
                shared: collection.shared(parent, child),
                weight: overlaps.weight(parent, child),
            });
        }
        next += 1;
    }
    if let Some(&circle) = cover.iter().find(|b| !depths.iter().any(|(d, _)| d == *b)) {
        return Err(NoTree::Twice(name(circle)));
    }
    let all = collection.bodies().iter().flat_map(|b| &b.points);
    let has = |p: &usize| {
        cover
            .iter()
            .any(|&b| collection.bodies()[b].points.contains(p))
    };
    if let Some(&point) = all.into_iter().find(|p| !has(p)) {
        return Err(NoTree::NotCovered(collection.points()[point].clone()));
    }
    Ok(IncidenceTree {
        root,
        weight: edges.iter().map(|e| e.weight).sum(),
        depth_sum: depths.iter().map(|(_, depth)| depth).sum(),
        cover,
        edges,
        exact: false,
        shallowest: false,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::collection::{Body, samples};

    fn best(collection: &Collection) -> IncidenceTree {
        let tree = optimal_incidence_tree(collection, &[], |_| true).unwrap();
        assert!(tree.exact && tree.shallowest);
        let sum: usize = tree.edges.iter().map(|e| e.weight).sum();
        assert_eq!(sum, tree.weight);
        assert_eq!(tree.edges.len() + 1, tree.cover.len());
        assert!(collection.is_covering(&tree.cover));
        tree
    }

    fn named(collection: &Collection, bodies: &[usize]) -> Vec<String> {
        bodies
            .iter()
            .map(|&b| collection.bodies()[b].name.clone())
            .collect()
    }

    /// Number of covering sets, and of those that are smallest their number of bodies and least weight.
    fn counts(collection: &Collection) -> (usize, usize, usize) {
        let sets = covering_sets(collection).unwrap();
        let fewest = sets.iter().map(|s| s.bodies.len()).min().unwrap();
        let smallest = sets.iter().filter(|s| s.bodies.len() == fewest);
        (
            sets.len(),
            fewest,
            smallest.map(|s| s.weight).min().unwrap(),
        )
    }

    #[test]
    fn tetra_is_hung_on_the_triangle_that_nobody_wrote() {
        let tetra = samples::tetra_whole();
        let tree = best(&tetra);
        assert_eq!((tree.weight, tree.depth_sum), (3, 3));
        assert_eq!(named(&tetra, &tree.cover), ["c1", "c2", "c3", "c4"]);
        assert_eq!(named(&tetra, &[tree.root]), ["c4"]);
        assert_eq!(counts(&tetra), (36, 3, 6));
        let all = covering_sets(&tetra).unwrap();
        assert_eq!(all.iter().filter(|s| s.weight == 3).count(), 1);
    }

    #[test]
    fn pent_has_four_unknowns() {
        let pent = samples::pent_whole();
        let tree = best(&pent);
        assert_eq!((tree.weight, tree.depth_sum), (4, 6));
        assert_eq!(named(&pent, &tree.cover), ["c1", "c2", "c3", "c4", "c5"]);
        assert_eq!(named(&pent, &[tree.root]), ["c5"]);
        assert_eq!(counts(&pent), (18, 3, 9));
        let all = covering_sets(&pent).unwrap();
        assert_eq!(all.iter().filter(|s| s.weight == 4).count(), 6);
    }

    #[test]
    fn quad_is_hung_on_its_square() {
        let quad = samples::quad_whole();
        let tree = best(&quad);
        assert_eq!((tree.weight, tree.depth_sum), (4, 4));
        assert_eq!(named(&quad, &tree.cover), ["c1", "c2", "c3", "c4", "c5"]);
        assert_eq!(named(&quad, &[tree.root]), ["c5"]);
        assert_eq!(counts(&quad), (292, 3, 6));
        let four = covering_sets(&quad).unwrap();
        let four = four.iter().find(|s| s.bodies == [0, 1, 2, 3]).unwrap();
        assert_eq!(four.weight, 9);
    }

    #[test]
    fn without_a_body_that_is_not_to_be_used_the_tree_is_heavier() {
        let tetra = samples::tetra_whole();
        let tree = optimal_incidence_tree(&tetra, &[], |b| b != 3).unwrap();
        assert!(tree.weight > 3);
        assert!(optimal_incidence_tree(&tetra, &[], |b| b > 4).is_none());
    }

    /// Trees that are not the best: figure 15 of the paper, of weights 4, 8, 9, 6 and 4, the last two levels deep.
    #[test]
    fn trees_as_asked_have_their_weights() {
        let quad = samples::quad_whole();
        let along = |pairs: &[(&str, &str)]| {
            let body = |name: &str| quad.bodies().iter().position(|b| b.name == name).unwrap();
            let pairs: Vec<[usize; 2]> = pairs.iter().map(|(c, p)| [body(c), body(p)]).collect();
            tree_along(&quad, &pairs).map(|tree| (tree.weight, tree.depth_sum))
        };
        let star = [("c1", "c5"), ("c2", "c5"), ("c3", "c5"), ("c4", "c5")];
        assert_eq!(along(&star), Ok((4, 4)));
        assert_eq!(
            along(&[("c2", "c1"), ("c3", "c2"), ("c4", "c3")]),
            Ok((9, 6))
        );
        assert_eq!(along(&[("k1", "c5"), ("k3", "c5")]), Ok((6, 2)));
        let deep = [("c1", "c5"), ("k1", "c1"), ("c3", "c5"), ("k3", "c3")];
        assert_eq!(along(&deep), Ok((4, 6)));
        let twice = [("c1", "c5"), ("c1", "c2")];
        assert_eq!(along(&twice), Err(NoTree::Twice("c1".to_owned())));
        let circle = [("c1", "c5"), ("c2", "c3"), ("c3", "c2")];
        assert_eq!(along(&circle), Err(NoTree::Twice("c2".to_owned())));
        let apart = [("c1", "c5"), ("c2", "k2")];
        assert_eq!(
            along(&apart),
            Err(NoTree::Apart("c5".to_owned(), "k2".to_owned()))
        );
        assert_eq!(
            along(&[("c1", "c5")]),
            Err(NoTree::NotCovered("p2".to_owned()))
        );
    }

    /// A chain of 40 bodies, each sharing two points with the next: more than are tried one by one.
    #[test]
    fn long_chains_are_hung_without_a_claim_that_it_is_the_best() {
        let points = (0..82).map(|i| format!("p{i}")).collect();
        let bodies = (0..40)
            .map(|i| Body {
                name: format!("b{i}"),
                points: vec![2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3],
            })
            .collect();
        let chain = Collection::new(points, bodies, Vec::new()).unwrap();
        let tree = optimal_incidence_tree(&chain, &[], |_| true).unwrap();
        assert!(!tree.exact);
        assert_eq!(tree.weight, 39);
        assert!(covering_sets(&chain).is_none());
    }
}
