//! Which choices a step hangs on.
//!
//! A step needs the measures of three pairs, each within a cluster. A measure that is itself a constraint is the same whatever
//! was chosen; any other hangs on how the parts of its cluster stand to each other. Steps that hang together are a *class*;
//! what is possible in one class is independent of all others, so that solutions multiply.

use crate::analysis::Merge;
use crate::sketch::Sketch;
use std::collections::{BTreeSet, HashMap};

/// Looking at more clusters than this for one sketch, and so many for each constraint, is given up, and all steps are one class: about a tenth of a
/// second. Where classes are small each constraint takes one or two.
const MOST_LOOKS: usize = 100_000;
const LOOKS_EACH: usize = 4;

/// For every step the earlier steps whose choices change its measures; `None` where it takes too long to say.
pub(super) fn dependence(sketch: &Sketch, merges: &[Merge]) -> Option<Vec<BTreeSet<usize>>> {
    let tree = Tree::new(sketch, merges);
    let ends = sketch.by_ends();
    let mut looks = MOST_LOOKS + LOOKS_EACH * sketch.constraints().len();
    merges
        .iter()
        .map(|merge| {
            let [a, b, c] = merge.parts;
            let [x, y, z] = merge.shared;
            let mut on = BTreeSet::new();
            for (cluster, pair) in [(a, [x, z]), (b, [x, y]), (c, [y, z])] {
                if !ends.contains_key(&pair) {
                    tree.shape_of(cluster, pair.to_vec(), &mut on, &mut looks)?;
                }
            }
            Some(on)
        })
        .collect()
}

/// Clusters as a tree over the edges.
struct Tree<'a> {
    merges: &'a [Merge],
    edges: usize,
    /// Of every cluster the first of its edges in the order of the tree, and the one after its last.
    span: Vec<[usize; 2]>,
    /// Of every element the positions of its edges in that order, ascending.
    at: HashMap<usize, Vec<usize>>,
}

impl<'a> Tree<'a> {
    fn new(sketch: &Sketch, merges: &'a [Merge]) -> Self {
        let edges = sketch.constraints().len();
        let count = edges + merges.len();
        let mut size = vec![1; edges];
        for merge in merges {
            size.push(merge.parts.iter().map(|&p| size[p]).sum());
        }
        let mut span = vec![[0; 2]; count];
        if let Some(root) = count.checked_sub(1) {
            span[root] = [0, size[root]];
        }
        for (i, merge) in merges.iter().enumerate().rev() {
            let mut first = span[edges + i][0];
            for &part in &merge.parts {
                span[part] = [first, first + size[part]];
                first += size[part];
            }
        }
        let mut at: HashMap<usize, Vec<usize>> = HashMap::new();
        for (e, constraint) in sketch.constraints().iter().enumerate() {
            for v in constraint.ends {
                at.entry(v).or_default().push(span[e][0]);
            }
        }
        at.values_mut().for_each(|p| p.sort_unstable());
        Self {
            merges,
            edges,
            span,
            at,
        }
    }

    fn holds(&self, cluster: usize, element: usize) -> bool {
        let [first, end] = self.span[cluster];
        let Some(at) = self.at.get(&element) else {
            return false;
        };
        at.get(at.partition_point(|&p| p < first))
            .is_some_and(|&p| p < end)
    }

    /// Adds the steps that the mutual positions of some elements of a cluster hang on.
    fn shape_of(
        &self,
        cluster: usize,
        elements: Vec<usize>,
        on: &mut BTreeSet<usize>,
        looks: &mut usize,
    ) -> Option<()> {
        let mut open = vec![(cluster, elements)];
        while let Some((cluster, elements)) = open.pop() {
            *looks = looks.checked_sub(1)?;
            let Some(step) = cluster.checked_sub(self.edges) else {
                continue;
            };
            if elements.len() < 2 {
                continue;
            }
            let merge = &self.merges[step];
            let whole = merge
                .parts
                .iter()
                .find(|&&p| elements.iter().all(|&v| self.holds(p, v)));
            if let Some(&part) = whole {
                open.push((part, elements));
                continue;
            }
            on.insert(step);
            for (k, &part) in merge.parts.iter().enumerate() {
                let shared = [merge.shared[k], merge.shared[(k + 2) % 3]];
                let others = elements.iter().copied();
                let mut inside: Vec<usize> = others
                    .filter(|v| !shared.contains(v) && self.holds(part, *v))
                    .collect();
                inside.extend(shared);
                open.push((part, inside));
            }
        }
        Some(())
    }
}
