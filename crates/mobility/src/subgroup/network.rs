//! Rule 3: a part as a network of chains between links, reduced loop by loop.

use super::chain::{self, Piece, Replaced, enclosing, freedom, span, swept};
use super::one_loop::{Arc, Proof, prove};
use super::parallelogram::circular;
use super::placing::{Placed, ends};
use super::{clear, remainder, words};
use crate::Structure;
use kutzbach_closure::Part;
use kutzbach_math::group::{Gauge, GroupError, Margin, ScrewSystem, Subalgebra};
use kutzbach_model::mechanism::Mechanism;
use std::collections::{BTreeMap, BTreeSet};

/// Chains are not joined to longer ones than this: no loop of them would be looked at.
const LONGEST_CHAIN: usize = 48;

/// A chain between two links, its pieces in order from the first. Links are counted in the order of their names.
#[derive(Clone, Debug)]
pub struct Edge {
    /// The links.
    pub ends: [usize; 2],
    /// What lies between them.
    pub pieces: Vec<Piece>,
}

impl Edge {
    /// The pieces as passed from a link to the other. Backward, every piece does the inverse of what it does forward,
    /// which has the same span and stays in the same subgroup.
    fn from(&self, link: usize) -> Vec<Piece> {
        let mut pieces = self.pieces.clone();
        if self.ends[0] != link {
            pieces.reverse();
        }
        pieces
    }

    fn other(&self, link: usize) -> usize {
        if self.ends[0] == link {
            self.ends[1]
        } else {
            self.ends[0]
        }
    }
}

/// What the reduction of a network found.
pub struct Outcome {
    /// The freedom, where the network was reduced completely or the rest is explained.
    pub freedom: Option<usize>,
    /// Freedoms that are certain.
    pub settled: usize,
    /// The reason, or what is left.
    pub text: String,
    /// Reductions in order.
    pub steps: Vec<String>,
    /// The worst margin.
    pub margin: Margin,
}

/// What can replace two parallel chains.
struct Replacement {
    by: Replaced,
    /// Independent equations of their loop.
    rank: usize,
    /// Whether the loop is a parallelogram, which nothing in terms of subgroups could say any better.
    circular: bool,
    /// The reason.
    step: String,
    /// The margin of the reason.
    margin: Margin,
}

/// A part that is being reduced.
pub struct Network<'a> {
    mechanism: &'a Mechanism,
    gauge: Gauge,
    edges: Vec<Option<Edge>>,
    /// Edges at every link still there, by index.
    at: BTreeMap<usize, BTreeSet<usize>>,
    /// Pairs of edges found to be no loop that can be replaced.
    refused: BTreeSet<(usize, usize)>,
    /// Loops that can be replaced, by rank and pair. They wait until nothing else is to be done; then those of the lowest
    /// rank come first: their subgroups are the smallest and say most about the loops that remain.
    postponed: BTreeMap<(usize, usize, usize), Replacement>,
    /// Edges found not to allow everything.
    constraining: BTreeSet<usize>,
    /// Links around which something has changed.
    changed: BTreeSet<usize>,
    settled: usize,
    steps: Vec<String>,
    margin: Margin,
}

impl<'a> Network<'a> {
    /// The network of a part: one chain for every joint, its pieces between its links.
    pub fn new(
        mechanism: &'a Mechanism,
        structure: &Structure,
        part: &Part,
        placed: &Placed,
    ) -> Result<Self, GroupError> {
        // By name, so that the order in the file changes nothing.
        let mut order: Vec<usize> = (0..part.joints.len()).collect();
        order.sort_by_key(|&i| structure.graph.edge_rank(part.joints[i]));
        let mut network = Self {
            mechanism,
            gauge: placed.gauge,
            edges: Vec::with_capacity(order.len()),
            at: BTreeMap::new(),
            refused: BTreeSet::new(),
            postponed: BTreeMap::new(),
            constraining: BTreeSet::new(),
            changed: BTreeSet::new(),
            settled: 0,
            steps: Vec::new(),
            margin: Margin::CERTAIN,
        };
        for i in order {
            let joint = part.joints[i];
            let kind = mechanism.joints()[joint].kind;
            let pieces = chain::of_joint(joint, kind, &placed.screws[i]);
            network.insert(Edge {
                ends: ends(mechanism, joint).map(|link| structure.graph.node_rank(link)),
                pieces,
            });
        }
        Ok(network)
    }

    fn insert(&mut self, edge: Edge) {
        for link in edge.ends {
            self.at.entry(link).or_default().insert(self.edges.len());
            self.changed.insert(link);
        }
        self.edges.push(Some(edge));
    }

    fn remove(&mut self, index: usize) -> Option<Edge> {
        let edge = self.edges.get_mut(index)?.take()?;
        for link in edge.ends {
            if let Some(edges) = self.at.get_mut(&link) {
                edges.remove(&index);
            }
            self.changed.insert(link);
        }
        Some(edge)
    }

    fn edge(&self, index: usize) -> Option<&Edge> {
        self.edges.get(index)?.as_ref()
    }

    /// Edges at a link.
    fn around(&self, link: usize) -> Vec<usize> {
        self.at
            .get(&link)
            .map_or_else(Vec::new, |edges| edges.iter().copied().collect())
    }

    /// Replaces what can be replaced.
    pub fn reduce(&mut self) -> Result<(), GroupError> {
        loop {
            while let Some(link) = self.changed.pop_first() {
                if self.reduce_at(link)? {
                    self.changed.insert(link);
                }
            }
            if !(self.remove_free_chain()? || self.replace_postponed()) {
                return Ok(());
            }
        }
    }

    /// One reduction at a link; false where there is none.
    fn reduce_at(&mut self, link: usize) -> Result<bool, GroupError> {
        let around = self.around(link);
        for &index in &around {
            let Some(edge) = self.edge(index) else {
                continue;
            };
            if edge.ends[0] == edge.ends[1] {
                if self.close(index)? {
                    return Ok(true);
                }
            } else if freedom(&edge.pieces) == 0 {
                self.contract(index, link);
                return Ok(true);
            }
        }
        for (i, &first) in around.iter().enumerate() {
            for &second in &around[i + 1..] {
                if self.merge(first, second)? {
                    return Ok(true);
                }
            }
        }
        match around[..] {
            [only] => Ok(self.follow(only, link)),
            [first, second] => Ok(self.join(first, second, link)),
            _ => Ok(false),
        }
    }

    /// A chain from a link to itself closes on its own.
    fn close(&mut self, index: usize) -> Result<bool, GroupError> {
        let Some(edge) = self
            .edge(index)
            .filter(|_| !self.refused.contains(&(index, index)))
        else {
            return Ok(false);
        };
        let pieces: Vec<&Piece> = edge.pieces.iter().collect();
        let free = freedom(&edge.pieces);
        if free == 0 {
            self.remove(index);
            return Ok(true);
        }
        let proof = prove(&pieces, &self.gauge)?.filter(|proof| proof.rank() <= free);
        let Some(proof) = proof else {
            self.refused.insert((index, index));
            return Ok(false);
        };
        let text = words::proof(self.mechanism, &pieces, &proof);
        self.steps.push(text);
        self.margin = self.margin.and(proof.margin());
        self.settled += free - proof.rank();
        self.remove(index);
        Ok(true)
    }

    /// A chain without freedom makes two links one; the one whose turn it is stays.
    fn contract(&mut self, index: usize, kept: usize) {
        let Some(edge) = self.remove(index) else {
            return;
        };
        let gone = edge.other(kept);
        for moved in self.around(gone) {
            if let Some(edge) = self.remove(moved) {
                let ends = edge.ends.map(|link| if link == gone { kept } else { link });
                self.insert(Edge { ends, ..edge });
            }
        }
        self.at.remove(&gone);
        self.changed.remove(&gone);
        self.changed.insert(kept);
    }

    /// A link on a single chain does what the chain does.
    fn follow(&mut self, index: usize, link: usize) -> bool {
        let Some(edge) = self.edge(index).filter(|edge| edge.ends[0] != edge.ends[1]) else {
            return false;
        };
        self.settled += freedom(&edge.pieces);
        self.remove(index);
        self.at.remove(&link);
        self.changed.remove(&link);
        true
    }

    /// Two chains that meet in a link of no other are one.
    fn join(&mut self, first: usize, second: usize, link: usize) -> bool {
        let (Some(one), Some(two)) = (self.edge(first), self.edge(second)) else {
            return false;
        };
        let ends = [one.other(link), two.other(link)];
        if ends[0] == ends[1]
            || ends.contains(&link)
            || one.pieces.len() + two.pieces.len() > LONGEST_CHAIN
        {
            return false;
        }
        let mut pieces = one.from(ends[0]);
        pieces.extend(two.from(link));
        self.remove(first);
        self.remove(second);
        self.at.remove(&link);
        self.changed.remove(&link);
        self.insert(Edge { ends, pieces });
        true
    }

    /// Two chains between the same links become one, if their loop's configurations are a manifold.
    fn merge(&mut self, first: usize, second: usize) -> Result<bool, GroupError> {
        if self.refused.contains(&(first, second)) {
            return Ok(false);
        }
        let (Some(one), Some(two)) = (self.edge(first), self.edge(second)) else {
            return Ok(false);
        };
        let ends = one.ends;
        if ends[0] == ends[1] || !(two.ends == ends || two.ends == [ends[1], ends[0]]) {
            return Ok(false);
        }
        let (one, two) = (one.from(ends[0]), two.from(ends[0]));
        let replacement = self.replacement(&one, &two)?;
        self.refused.insert((first, second));
        match replacement {
            Some(replacement) if replacement.circular => {
                self.replace(first, second, replacement);
                Ok(true)
            }
            Some(replacement) => {
                let key = (replacement.rank, first, second);
                self.postponed.insert(key, replacement);
                Ok(false)
            }
            None => Ok(false),
        }
    }

    /// Puts one chain in the place of two.
    fn replace(&mut self, first: usize, second: usize, replacement: Replacement) {
        let Some(ends) = self.edge(first).map(|edge| edge.ends) else {
            return;
        };
        let Replacement {
            mut by,
            step,
            margin,
            ..
        } = replacement;
        self.steps.push(step);
        self.margin = self.margin.and(margin).and(by.margin());
        let dimension = by.span.dimension();
        if dimension == by.algebra.dimension() {
            self.settled += by.freedom - dimension;
            by.freedom = dimension;
        }
        self.remove(first);
        self.remove(second);
        let pieces = vec![Piece::Replaced(Box::new(by))];
        self.insert(Edge { ends, pieces });
    }

    /// Carries out the first of the replacements put off.
    fn replace_postponed(&mut self) -> bool {
        while let Some(((_, first, second), replacement)) = self.postponed.pop_first() {
            if self.edge(first).is_some() && self.edge(second).is_some() {
                self.replace(first, second, replacement);
                return true;
            }
        }
        false
    }

    /// What replaces two parallel chains, and the reason.
    fn replacement(&self, one: &[Piece], two: &[Piece]) -> Result<Option<Replacement>, GroupError> {
        let gauge = self.gauge;
        let around: Vec<&Piece> = one.iter().chain(two.iter().rev()).collect();
        let Some(proof) = prove(&around, &gauge)? else {
            return Ok(None);
        };
        let (first, second) = (span(one, &gauge)?, span(two, &gauge)?);
        let common = first.intersection(&second)?;
        let rank = first.dimension() + second.dimension() - common.dimension();
        let free = freedom(one) + freedom(two);
        if rank != proof.rank() || rank > free || !clear(common.margin()) {
            return Ok(None);
        }
        let mut enclosed = enclosing(one, &gauge)?.intersection(&enclosing(two, &gauge)?)?;
        if let Proof::Held { arcs, .. } = &proof
            && rank < free
        {
            enclosed = enclosed.intersection(&moving_arcs(arcs, one.len(), &gauge)?)?;
        }
        if !clear(enclosed.margin()) {
            return Ok(None);
        }
        let mut step = words::proof(self.mechanism, &around, &proof);
        let mut by = Replaced {
            joints: chain::joints(around.iter().copied()),
            freedom: free - rank,
            span: common,
            algebra: enclosed,
        };
        let mut is_circular = false;
        if by.freedom == 0 {
            // The loop stands still.
            by.span = ScrewSystem::empty(&gauge);
            by.algebra = Subalgebra::generated_by(&[], &gauge)?;
        } else if by.freedom == 1
            && let Some(circular) = circular(one, two, &gauge)?
        {
            by.span = circular.span;
            by.algebra = circular.algebra;
            is_circular = true;
            step.push_str("; it is a parallelogram, whose coupler is translated along a circle");
        }
        Ok(Some(Replacement {
            by,
            rank,
            circular: is_circular,
            step,
            margin: proof.margin(),
        }))
    }

    /// Removes one chain that lets its links do everything, if there is one among what is left.
    fn remove_free_chain(&mut self) -> Result<bool, GroupError> {
        for index in 0..self.edges.len() {
            let Some(edge) = self.edge(index) else {
                continue;
            };
            let free = freedom(&edge.pieces);
            if free < 6 || self.constraining.contains(&index) {
                continue;
            }
            let group = swept(&edge.pieces, &self.gauge)?.filter(|g| g.dimension() == 6);
            let Some(group) = group else {
                self.constraining.insert(index);
                continue;
            };
            let step = words::free_chain(self.mechanism, &edge.pieces);
            self.steps.push(step);
            self.margin = self.margin.and(group.margin());
            self.settled += free - 6;
            self.remove(index);
            return Ok(true);
        }
        Ok(false)
    }

    /// Adds up what the reduction found.
    pub fn conclude(mut self) -> Result<Outcome, GroupError> {
        self.settled += 6 * (self.components() - 1);
        let left: Vec<&Edge> = self.edges.iter().flatten().collect();
        if left.is_empty() {
            return Ok(Outcome {
                freedom: Some(self.settled),
                text: words::summary(&self.steps),
                settled: self.settled,
                steps: self.steps,
                margin: self.margin,
            });
        }
        if !self.steps.is_empty()
            && let Some(rest) = remainder::explain(&left, &self.gauge)?
        {
            let all: usize = left.iter().map(|edge| freedom(&edge.pieces)).sum();
            let joints = chain::joints(left.iter().flat_map(|edge| &edge.pieces));
            self.steps
                .push(words::remainder(self.mechanism, &joints, rest.rank));
            return Ok(Outcome {
                freedom: all.checked_sub(rest.rank).map(|free| free + self.settled),
                settled: self.settled,
                text: words::summary(&self.steps),
                steps: self.steps,
                margin: self.margin.and(rest.margin),
            });
        }
        let mut idle = 0;
        for edge in &left {
            idle += chain::without_effect(&edge.pieces, &self.gauge)?;
        }
        let text = words::stuck(left.len(), self.steps.len());
        Ok(Outcome {
            freedom: None,
            settled: self.settled + idle,
            text,
            steps: self.steps,
            margin: self.margin,
        })
    }

    /// Connected pieces of what is left, at least one.
    fn components(&self) -> usize {
        let mut seen = BTreeSet::new();
        let mut components = 0;
        for &start in self.at.keys() {
            if !seen.insert(start) {
                continue;
            }
            components += 1;
            let mut stack = vec![start];
            while let Some(link) = stack.pop() {
                for edge in self.around(link).iter().filter_map(|&e| self.edge(e)) {
                    let next = edge.other(link);
                    if seen.insert(next) {
                        stack.push(next);
                    }
                }
            }
        }
        components.max(1)
    }
}

/// The subgroup that holds the displacements between the ends of the first `count` pieces of a loop that is held: every
/// arc as a whole stays the identity, so that only arcs cut by one of the two ends contribute.
fn moving_arcs(arcs: &[Arc], count: usize, gauge: &Gauge) -> Result<Subalgebra, GroupError> {
    let none = Subalgebra::generated_by(&[], gauge)?;
    arcs.iter()
        .filter(|arc| {
            let inside = arc.pieces.iter().filter(|&&i| i < count).count();
            inside > 0 && inside < arc.pieces.len()
        })
        .try_fold(none, |sum, arc| sum.join(&arc.group))
}
