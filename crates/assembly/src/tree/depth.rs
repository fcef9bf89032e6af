//! Among the lightest trees the one whose bodies are nearest to its root.
//!
//! In a lightest tree every part that is joined by overlaps of two points hangs together by itself. Once it is known at
//! which body the part is entered, the nearest place for each of its bodies is found by breadth-first search, for all at
//! once; and once the entries of all parts are known, so is the nearest place for every part. So only the entries are tried.

use super::cover::{Cover, Overlaps};
use super::{IncidenceTree, TreeEdge};
use crate::collection::Collection;

/// Trees that are compared before the best so far is taken.
const MOST_TREES: usize = 100_000;

/// The shallowest of the lightest trees of some covering sets.
pub(super) fn shallowest(
    collection: &Collection,
    overlaps: &Overlaps,
    covers: Vec<Cover>,
    exact: bool,
) -> Option<IncidenceTree> {
    let mut best: Option<(usize, usize, Rooted)> = None;
    let mut compared = 0;
    let mut all = true;
    'covers: for (index, cover) in covers.iter().enumerate() {
        let parts = overlaps.parts(&cover.bodies, 2);
        for &root in &cover.bodies {
            let mut entries: Vec<usize> = vec![0; parts.len()];
            let home = parts.iter().position(|p| p.contains(&root))?;
            loop {
                if compared == MOST_TREES {
                    all = false;
                    break 'covers;
                }
                compared += 1;
                let mut starts: Vec<usize> = parts
                    .iter()
                    .zip(&entries)
                    .map(|(part, &e)| part[e])
                    .collect();
                starts[home] = root;
                let tree = Rooted::new(overlaps, &parts, &starts, home);
                if best.as_ref().is_none_or(|(sum, ..)| tree.depth_sum < *sum) {
                    best = Some((tree.depth_sum, index, tree));
                }
                if !advance(&mut entries, &parts, home) {
                    break;
                }
            }
        }
    }
    let (depth_sum, index, tree) = best?;
    let cover = &covers[index];
    let edge = |&(parent, child): &(usize, usize)| TreeEdge {
        parent,
        child,
        shared: collection.shared(parent, child),
        weight: overlaps.weight(parent, child),
    };
    Some(IncidenceTree {
        cover: cover.bodies.clone(),
        root: tree.root,
        edges: tree.edges.iter().map(edge).collect(),
        weight: cover.weight,
        depth_sum,
        exact,
        shallowest: all,
    })
}

/// The next choice of entries; the part of the root is entered at the root.
fn advance(entries: &mut [usize], parts: &[Vec<usize>], home: usize) -> bool {
    for (place, part) in parts.iter().enumerate() {
        if place == home {
            continue;
        }
        entries[place] += 1;
        if entries[place] < part.len() {
            return true;
        }
        entries[place] = 0;
    }
    false
}

/// A tree under construction.
struct Rooted {
    root: usize,
    edges: Vec<(usize, usize)>,
    depth_sum: usize,
}

impl Rooted {
    /// The shallowest tree with given entries of all parts.
    fn new(overlaps: &Overlaps, parts: &[Vec<usize>], starts: &[usize], home: usize) -> Self {
        let mut tree = Self {
            root: starts[home],
            edges: Vec::new(),
            depth_sum: 0,
        };
        let mut placed: Vec<(usize, usize)> = Vec::new();
        tree.place(overlaps, &parts[home], (starts[home], 0), &mut placed);
        let mut waiting: Vec<usize> = (0..parts.len()).filter(|&p| p != home).collect();
        while !waiting.is_empty() {
            // The part whose entry comes nearest to the root: by a shared point, else from the root itself.
            let nearest = |part: usize| {
                let near = placed
                    .iter()
                    .filter(|(b, _)| overlaps.weight(*b, starts[part]) == 3);
                near.min_by_key(|(b, depth)| (*depth, *b)).copied()
            };
            // A part whose entry touches nothing may have another body that does: such a tree would not be a lightest one.
            let touches = |part: usize| {
                let one = |&b: &usize| placed.iter().any(|(p, _)| overlaps.weight(*p, b) == 3);
                parts[part].iter().any(one)
            };
            let next = waiting
                .iter()
                .filter_map(|&part| nearest(part).map(|found| (part, found)))
                .min_by_key(|(part, (_, depth))| (*depth, *part));
            let (part, (parent, depth)) = match next {
                Some(found) => found,
                None => match waiting.iter().find(|&&part| !touches(part)) {
                    Some(&part) => (part, (tree.root, 0)),
                    None => {
                        tree.depth_sum = usize::MAX;
                        return tree;
                    }
                },
            };
            waiting.retain(|&p| p != part);
            tree.edges.push((parent, starts[part]));
            tree.place(
                overlaps,
                &parts[part],
                (starts[part], depth + 1),
                &mut placed,
            );
        }
        tree
    }

    /// Places a part by breadth-first search from its entry, whose depth is known.
    fn place(
        &mut self,
        overlaps: &Overlaps,
        part: &[usize],
        entry: (usize, usize),
        placed: &mut Vec<(usize, usize)>,
    ) {
        let first = placed.len();
        placed.push(entry);
        let mut next = first;
        while let Some(&(body, depth)) = placed.get(next) {
            self.depth_sum += depth;
            for &other in part {
                let new = placed[first..].iter().all(|(b, _)| *b != other);
                if new && overlaps.weight(body, other) == 1 {
                    placed.push((other, depth + 1));
                    self.edges.push((body, other));
                }
            }
            next += 1;
        }
    }
}
