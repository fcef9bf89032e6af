//! A part's bodies while bounds between them grow smaller.

use super::basis::{MOST_MEMBERS, candidates, root};
use super::bodies::{Between, Bodies, walk};
use super::bounds::Bounds;
use super::chords::Chord;
use super::clear;
use super::groups::{Group, Groups, NOTHING};
use super::parallelogram::plane_of_translation;
use super::placing::Placed;
use kutzbach_closure::{Part, Structure};
use kutzbach_math::group::{Gauge, GroupError, ScrewSystem, Twist};
use kutzbach_model::mechanism::Mechanism;
use std::collections::{BTreeMap, BTreeSet};

/// Cycles of more members are looked at as a whole only.
pub const LONGEST_CYCLE: usize = 24;

/// A part's bodies while bounds grow smaller.
pub struct Network {
    pub groups: Groups,
    pub gauge: Gauge,
    pub bounds: Bounds,
    /// Bodies that are left.
    pub count: usize,
    /// What is left of the joints, and chords.
    pub between: Vec<Between>,
    pub cycles: Vec<Vec<usize>>,
    /// The bodies of the links of each joint, and the joint's own group.
    pub joints: BTreeMap<usize, ([usize; 2], Group)>,
    /// The joints of each coupling.
    pub couplings: Vec<Vec<usize>>,
    /// Two members that are half a parallelogram: the bodies at their ends only translate against one another, in its plane.
    pub translated: BTreeMap<[usize; 2], Group>,
    /// The cycles of these parallelograms.
    pub circles: BTreeSet<Vec<usize>>,
    /// Whether bounds left some members less than they have, or made bodies one.
    pub tightened: bool,
    /// Chords so far.
    pub told: Vec<Chord>,
}

impl Network {
    /// The bodies of a part, its joints as bounds between them.
    pub fn new(
        mechanism: &Mechanism,
        structure: &Structure,
        part: &Part,
        placed: &Placed,
        divided: bool,
    ) -> Result<Self, GroupError> {
        let mut groups = Groups::new(placed.gauge)?;
        let bodies = Bodies::new(mechanism, structure, part, placed, divided, &mut groups)?;
        let mut of_joints: BTreeMap<Option<usize>, BTreeSet<usize>> = BTreeMap::new();
        for member in &bodies.between {
            of_joints
                .entry(member.joint)
                .or_default()
                .extend(member.ends);
        }
        let mut near: Vec<Vec<usize>> = Vec::with_capacity(bodies.cycles.len());
        for cycle in &bodies.cycles {
            let joints: BTreeSet<_> = cycle.iter().map(|i| bodies.between[*i].joint).collect();
            let all = joints.iter().filter_map(|joint| of_joints.get(joint));
            near.push(all.flatten().copied().collect());
        }
        let mut bounds = Bounds::new(bodies.count, &near);
        for member in &bodies.between {
            let [a, b] = member.ends;
            bounds.restrict(&mut groups, a, b, member.group)?;
        }
        let mut joints = BTreeMap::new();
        for (&joint, &links) in &bodies.links {
            let own = bodies.between.iter().filter(|m| m.joint == Some(joint));
            let mut group = NOTHING;
            for member in own {
                group = groups.join(group, member.group)?;
            }
            joints.insert(joint, (links, group));
        }
        let couplings = part.couplings.iter().map(|&coupling| {
            let terms = &mechanism.couplings()[coupling].terms;
            terms.iter().map(|term| term.joint.0).collect()
        });
        Ok(Self {
            groups,
            gauge: placed.gauge,
            bounds,
            count: bodies.count,
            between: bodies.between,
            cycles: bodies.cycles,
            joints,
            couplings: couplings.collect(),
            translated: BTreeMap::new(),
            circles: BTreeSet::new(),
            tightened: false,
            told: Vec::new(),
        })
    }

    /// Freedom without effect. A body between two members A and B only may be displaced by A∩B, whatever else moves: these displacements
    /// act on the configurations. Seen from a body that is left out they act freely, those of all others together, so that the dimensions
    /// add up; where every body is such a one, one of them is left out.
    pub fn idle(&mut self) -> Result<usize, GroupError> {
        let coupled: BTreeSet<usize> = self.couplings.iter().flatten().copied().collect();
        let mut at: Vec<Vec<usize>> = vec![Vec::new(); self.count];
        for (number, member) in self.between.iter().enumerate() {
            for end in member.ends {
                at[end].push(number);
            }
        }
        let mut idle = Vec::with_capacity(self.count);
        for members in at {
            let [one, other] = members[..] else {
                idle.push(0);
                continue;
            };
            let both = [&self.between[one], &self.between[other]];
            let whole = both.iter().all(|member| {
                member.freedom == self.groups.dimension(member.group)
                    && member.joint.is_none_or(|joint| !coupled.contains(&joint))
            });
            idle.push(match whole {
                true => {
                    let common = self.groups.meet(both[0].group, both[1].group)?;
                    self.groups.dimension(common)
                }
                false => 0,
            });
        }
        let least = idle.iter().min().copied().unwrap_or(0);
        Ok(idle.iter().sum::<usize>() - least)
    }

    /// Lets bounds, couplings, independent groups and parallelograms act on one another until nothing changes.
    pub fn settle(&mut self) -> Result<(), GroupError> {
        self.bounds.settle(&mut self.groups)?;
        let cycles = self.few_cycles();
        loop {
            let mut news = self.couple()?;
            for cycle in &cycles {
                news |= self.hold(cycle)?;
                news |= self.translate(cycle)?;
            }
            if !news {
                return Ok(());
            }
            self.bounds.settle(&mut self.groups)?;
        }
    }

    /// The cycles to be looked at.
    pub fn few_cycles(&self) -> Vec<Vec<usize>> {
        if self.between.len() <= MOST_MEMBERS {
            candidates(&self.between, self.count)
        } else {
            self.cycles.clone()
        }
    }

    /// A coupling of which all joints but one are held holds the last.
    fn couple(&mut self) -> Result<bool, GroupError> {
        let mut news = false;
        for coupling in self.couplings.clone() {
            let mut free = coupling.iter().filter(|joint| self.moves(**joint));
            let (Some(last), None) = (free.next(), free.next()) else {
                continue;
            };
            if let Some(([a, b], _)) = self.joints.get(last).copied() {
                news |= self.bounds.restrict(&mut self.groups, a, b, NOTHING)?;
            }
        }
        Ok(news)
    }

    /// Whether a joint may move.
    pub fn moves(&self, joint: usize) -> bool {
        self.joints.get(&joint).is_some_and(|([a, b], own)| {
            *own != NOTHING && a != b && self.bounds.between(*a, *b) != NOTHING
        })
    }

    /// The group that holds what a member does.
    pub fn left(&self, member: &Between) -> Group {
        let [a, b] = member.ends;
        if a == b {
            NOTHING
        } else {
            self.bounds.between(a, b)
        }
    }

    /// Chains around a cycle whose groups are independent all stand still, since only identities multiply to the identity. The cycle is
    /// divided into the chains whose dimensions add up to the least.
    fn hold(&mut self, cycle: &[usize]) -> Result<bool, GroupError> {
        let count = cycle.len();
        let Some(bodies) = walk(&self.between, cycle).filter(|_| count <= LONGEST_CYCLE) else {
            return Ok(false);
        };
        // The groups that chains of each length generate from each body on.
        let mut chains: Vec<Vec<Group>> = Vec::with_capacity(count);
        for start in 0..count {
            let mut longer = NOTHING;
            let mut own = Vec::with_capacity(count);
            for step in 0..count - 1 {
                let next = self.left(&self.between[cycle[(start + step) % count]]);
                longer = self.groups.join(longer, next)?;
                own.push(longer);
            }
            chains.push(own);
        }
        let Some(cuts) = self.cheapest_cuts(&chains) else {
            return Ok(false);
        };
        let all: Vec<Group> = cuts
            .windows(2)
            .map(|pair| chains[pair[0] % count][pair[1] - pair[0] - 1])
            .collect();
        if !self.groups.are_independent(&all)? {
            return Ok(false);
        }
        let mut news = false;
        for pair in cuts.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|cut| bodies[cut % count]);
            news |= self.bounds.restrict(&mut self.groups, a, b, NOTHING)?;
        }
        Ok(news)
    }

    /// Where to cut a cycle into chains whose dimensions add up to the least, six at most: places from the first around to it again.
    fn cheapest_cuts(&self, chains: &[Vec<Group>]) -> Option<Vec<usize>> {
        let count = chains.len();
        let mut best: Option<(usize, Vec<usize>)> = None;
        for start in 0..count {
            // Least sum of dimensions to each place after the start, and the cut before.
            let mut least = vec![(0, start)];
            for to in start + 1..=start + count {
                let from = start.max((to + 1).saturating_sub(count))..to;
                let through = from.map(|from| {
                    let group = chains[from % count][to - from - 1];
                    (least[from - start].0 + self.groups.dimension(group), from)
                });
                least.push(through.min()?);
            }
            let sum = least[count].0;
            if sum == 0 || sum > 6 || best.as_ref().is_some_and(|(other, _)| *other <= sum) {
                continue;
            }
            let mut cuts = vec![start + count];
            let mut place = start + count;
            while place > start {
                place = least[place - start].1;
                cuts.push(place);
            }
            cuts.reverse();
            best = Some((sum, cuts));
        }
        best.map(|(_, cuts)| cuts)
    }

    /// Opposite links of a parallelogram translate.
    fn translate(&mut self, cycle: &[usize]) -> Result<bool, GroupError> {
        let Some((bodies, plane)) = self.parallelogram(cycle)? else {
            return Ok(false);
        };
        let mut news = false;
        for [a, b] in [[bodies[0], bodies[2]], [bodies[1], bodies[3]]] {
            news |= self.bounds.restrict(&mut self.groups, a, b, plane)?;
        }
        Ok(news)
    }

    /// The bodies of a parallelogram of four hinges that is a curve at the pose, and the translations of its plane.
    pub fn parallelogram(
        &mut self,
        cycle: &[usize],
    ) -> Result<Option<([usize; 4], Group)>, GroupError> {
        let [first, second, third, fourth] = *cycle else {
            return Ok(None);
        };
        let mut hinges: Vec<Twist> = Vec::with_capacity(4);
        for member in [first, second, third, fourth] {
            let group = self.left(&self.between[member]);
            let [twist] = self.groups.algebra(group).basis()[..] else {
                return Ok(None);
            };
            hinges.push(twist);
        }
        let Some(bodies) = walk(&self.between, cycle) else {
            return Ok(None);
        };
        let span = ScrewSystem::span(&hinges, &self.gauge)?;
        if span.dimension() != 3 || !clear(span.margin()) {
            return Ok(None);
        }
        let cranks = [[hinges[0], hinges[1]], [hinges[3], hinges[2]]];
        let Some(plane) = plane_of_translation(cranks[0], cranks[1], &self.gauge) else {
            return Ok(None);
        };
        let plane = self.groups.generated_by(&plane)?;
        Ok(Some(([bodies[0], bodies[1], bodies[2], bodies[3]], plane)))
    }

    /// How many bodies there are, those counted once that members without freedom hold together.
    fn solid(&self) -> usize {
        let mut of: Vec<usize> = (0..self.count).collect();
        let mut solid = self.count;
        for member in self.between.iter().filter(|m| m.group == NOTHING) {
            let [a, b] = member.ends.map(|end| root(&mut of, end));
            if a != b {
                of[a] = b;
                solid -= 1;
            }
        }
        solid
    }

    /// Makes links one that do not move against each other, and leaves each joint what the bounds leave it. Whether that brings together
    /// bodies that had not been looked at together.
    pub fn unite(&mut self) -> Result<bool, GroupError> {
        let mut of: Vec<usize> = (0..self.count).collect();
        for ([a, b], group) in self.bounds.all() {
            if group == NOTHING {
                let (a, b) = (root(&mut of, a), root(&mut of, b));
                of[a.max(b)] = a.min(b);
            }
        }
        let mut numbers = BTreeMap::new();
        let names: Vec<usize> = (0..self.count)
            .map(|body| {
                let next = numbers.len();
                *numbers.entry(root(&mut of, body)).or_insert(next)
            })
            .collect();
        self.tightened |= numbers.len() < self.solid();
        let mut kept: Vec<Option<usize>> = Vec::with_capacity(self.between.len());
        let mut between = Vec::new();
        for member in &self.between {
            let ends = member.ends.map(|end| names[end]);
            if ends[0] == ends[1] {
                kept.push(None);
                continue;
            }
            let group = self.left(member);
            let lost = self.groups.dimension(member.group) - self.groups.dimension(group);
            self.tightened |= lost > 0;
            kept.push(Some(between.len()));
            between.push(Between {
                ends,
                freedom: member.freedom.saturating_sub(lost),
                group,
                ..member.clone()
            });
        }
        let united = numbers.len() < self.count;
        self.between = between;
        for cycle in &mut self.cycles {
            *cycle = cycle.iter().filter_map(|member| kept[*member]).collect();
        }
        self.cycles.retain(|cycle| !cycle.is_empty());
        for (links, _) in self.joints.values_mut() {
            *links = links.map(|link| names[link]);
        }
        self.count = numbers.len();
        if united {
            let near: Vec<Vec<usize>> = self
                .cycles
                .iter()
                .map(|cycle| cycle.iter().flat_map(|i| self.between[*i].ends).collect())
                .collect();
            let mut bounds = Bounds::new(self.count, &near);
            for ([a, b], group) in self.bounds.all() {
                bounds.restrict(&mut self.groups, names[a], names[b], group)?;
            }
            self.bounds = bounds;
        }
        Ok(united)
    }
}
