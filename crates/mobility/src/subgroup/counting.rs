//! What displacement subgroups leave to a network of any kind.
//!
//! Bounds between all links ([`Bounds`]) leave each joint a subgroup S' of its own. The part has the same configurations with these for its
//! joints. Around a cycle all displacements then lie in the group K that its members generate, so that closing it asks for dim K equations
//! and no more. Σ dim S' − Σ dim K over a basis of cycles, less one for each coupling, is what independent equations would leave. The
//! rank at the pose never leaves less; where it leaves as much, the equations are independent there, and the configurations are a
//! manifold of that dimension.
//!
//! What always holds between two links may be added as one more member (a *chord*): it makes two cycles of one. Where two chains of a
//! cycle sweep A and B and A B is no group, that asks for dim A + dim B − dim A∩B equations in place of dim ⟨A, B⟩.

use super::basis::{MOST_MEMBERS, candidates, independent, rank, root};
use super::bodies::{Between, Bodies, walk};
use super::bounds::Bounds;
use super::clear;
use super::groups::{EVERYTHING, Group, Groups, NOTHING};
use super::parallelogram::of_cranks;
use super::placing::Placed;
use kutzbach_closure::Part;
use kutzbach_math::group::{Gauge, GroupError, Margin, ScrewSystem, Subalgebra, Twist};
use kutzbach_model::mechanism::Mechanism;
use std::collections::{BTreeMap, BTreeSet};

/// Times that links which became one give new neighbours to be looked at, and times that chords are looked for.
const ROUNDS: usize = 6;

/// Cycles of more members are not divided.
const LONGEST_CYCLE: usize = 24;

/// What subgroups leave to a part.
pub struct Counted {
    /// The freedom that independent equations of its cycles would leave, zero at least; never more than the rank leaves.
    pub least: usize,
    /// Equations that its cycles ask for in what the joints are left.
    pub equations: usize,
    /// Joints whose two links are one.
    pub held: Vec<usize>,
    /// Joints that are left a smaller group.
    pub confined: Vec<(usize, Subalgebra)>,
    /// Whether the cycles alone suffice: no joint is left less than it has, and no chord was needed.
    pub by_cycles_alone: bool,
    /// The worst margin of what it rests on.
    pub margin: Margin,
}

/// The freedom left by some cycles.
#[derive(Clone, Copy, Default)]
struct Least {
    freedom: usize,
    equations: usize,
    by_cycles: bool,
}

/// Counts a part whose rank leaves `freedom`: as it is, and where that does not suffice, with the joints divided that are one subgroup.
pub fn count(
    mechanism: &Mechanism,
    part: &Part,
    placed: &Placed,
    freedom: usize,
) -> Result<Counted, GroupError> {
    let whole = Network::new(mechanism, part, placed, false)?.counted(freedom)?;
    if whole.least >= freedom || !Bodies::can_be_divided(mechanism, part, placed) {
        return Ok(whole);
    }
    let divided = Network::new(mechanism, part, placed, true)?.counted(freedom)?;
    Ok(if divided.least > whole.least {
        divided
    } else {
        whole
    })
}

/// A part's bodies while bounds grow smaller.
struct Network {
    groups: Groups,
    gauge: Gauge,
    bounds: Bounds,
    /// Bodies that are left.
    count: usize,
    /// What is left of the joints, and chords.
    between: Vec<Between>,
    cycles: Vec<Vec<usize>>,
    /// The bodies of the links of each joint, and the joint's own group.
    joints: BTreeMap<usize, ([usize; 2], Group)>,
    /// The joints of each coupling.
    couplings: Vec<Vec<usize>>,
    /// Two bodies of a parallelogram that only translate against one another: in the translations of its plane.
    translated: BTreeMap<(usize, usize), Group>,
    /// The cycles of these parallelograms.
    circles: BTreeSet<Vec<usize>>,
}

impl Network {
    fn new(
        mechanism: &Mechanism,
        part: &Part,
        placed: &Placed,
        divided: bool,
    ) -> Result<Self, GroupError> {
        let mut groups = Groups::new(placed.gauge)?;
        let bodies = Bodies::new(mechanism, part, placed, divided, &mut groups)?;
        let mut near: Vec<Vec<usize>> = Vec::with_capacity(bodies.cycles.len());
        for cycle in &bodies.cycles {
            let joints: BTreeSet<_> = cycle.iter().map(|i| bodies.between[*i].joint).collect();
            let members = cycle.iter().map(|i| &bodies.between[*i]);
            let otherwise = bodies.otherwise.iter();
            let all = members.chain(otherwise.filter(|other| joints.contains(&other.joint)));
            near.push(all.flat_map(|member| member.ends).collect());
        }
        let mut bounds = Bounds::new(bodies.count, &near);
        for member in bodies.between.iter().chain(&bodies.otherwise) {
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
        })
    }

    fn counted(mut self, freedom: usize) -> Result<Counted, GroupError> {
        for _ in 0..ROUNDS {
            self.settle()?;
            if !self.unite()? {
                break;
            }
        }
        let mut held = Vec::new();
        let mut confined = Vec::new();
        for (&joint, &([a, b], own)) in &self.joints {
            if own == NOTHING {
                continue;
            }
            if a == b {
                held.push(joint);
                continue;
            }
            let left = self.bounds.between(a, b);
            if self.groups.dimension(left) < self.groups.dimension(own) {
                confined.push((joint, self.groups.algebra(left).clone()));
            }
        }
        let least = self.least(freedom)?;
        Ok(Counted {
            least: least.freedom,
            equations: least.equations,
            by_cycles_alone: least.by_cycles && held.is_empty() && confined.is_empty(),
            held,
            confined,
            margin: self.groups.margin(),
        })
    }

    /// Lets bounds, couplings, independent groups and parallelograms act on one another until nothing changes.
    fn settle(&mut self) -> Result<(), GroupError> {
        self.bounds.settle(&mut self.groups)?;
        loop {
            let mut news = self.couple()?;
            for cycle in self.few_cycles() {
                news |= self.hold(&cycle)?;
                news |= self.translate(&cycle)?;
            }
            if !news {
                return Ok(());
            }
            self.bounds.settle(&mut self.groups)?;
        }
    }

    /// The cycles to be looked at.
    fn few_cycles(&self) -> Vec<Vec<usize>> {
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
    fn moves(&self, joint: usize) -> bool {
        self.joints.get(&joint).is_some_and(|([a, b], own)| {
            *own != NOTHING && a != b && self.bounds.between(*a, *b) != NOTHING
        })
    }

    /// The group that holds what a member does.
    fn left(&self, member: &Between) -> Group {
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
        let Some(bodies) = walk(&self.between, cycle) else {
            return Ok(false);
        };
        let count = bodies.len();
        if !(3..=LONGEST_CYCLE).contains(&count) {
            return Ok(false);
        }
        let dimension = |from: usize, to: usize| {
            let (a, b) = (bodies[from], bodies[to % count]);
            self.groups.dimension(self.bounds.between(a, b))
        };
        let mut best: Option<(usize, Vec<usize>)> = None;
        for start in 0..count {
            // Least sum of dimensions to each body after the start, and the body before.
            let mut least = vec![(0, start)];
            for to in start + 1..=start + count {
                let chains = (start..to).filter(|from| to - from < count);
                let through =
                    chains.map(|from| (least[from - start].0 + dimension(from % count, to), from));
                let Some(through) = through.min() else {
                    return Ok(false);
                };
                least.push(through);
            }
            let sum = least[count].0;
            if sum == 0 || sum > 6 || best.as_ref().is_some_and(|(other, _)| *other <= sum) {
                continue;
            }
            let mut cuts = vec![start + count];
            while cuts[cuts.len() - 1] > start {
                cuts.push(least[cuts[cuts.len() - 1] - start].1);
            }
            best = Some((sum, cuts));
        }
        let Some((_, cuts)) = best else {
            return Ok(false);
        };
        let chains: Vec<[usize; 2]> = cuts
            .windows(2)
            .map(|pair| [bodies[pair[1] % count], bodies[pair[0] % count]])
            .collect();
        let all: Vec<Group> = chains
            .iter()
            .map(|[a, b]| self.bounds.between(*a, *b))
            .collect();
        if !self.groups.are_independent(&all)? {
            return Ok(false);
        }
        let mut news = false;
        for [a, b] in chains {
            news |= self.bounds.restrict(&mut self.groups, a, b, NOTHING)?;
        }
        Ok(news)
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
    fn parallelogram(
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
        let Some(circular) = of_cranks(cranks[0], cranks[1], &self.gauge)? else {
            return Ok(None);
        };
        let plane = self.groups.generated_by(&circular.algebra.basis())?;
        Ok(Some(([bodies[0], bodies[1], bodies[2], bodies[3]], plane)))
    }

    /// Makes links one that do not move against each other, and leaves each joint what the bounds leave it. Whether that brings together
    /// bodies that had not been looked at together.
    fn unite(&mut self) -> Result<bool, GroupError> {
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

    /// The least freedom by cycles and chords, looked for until it is that of the rank.
    fn least(&mut self, freedom: usize) -> Result<Least, GroupError> {
        let coupled = self.couplings.iter();
        let coupled = coupled
            .filter(|coupling| coupling.iter().any(|joint| self.moves(*joint)))
            .count();
        let mut best = Least::default();
        for _ in 0..ROUNDS {
            let basis = self.basis()?;
            let mut equations = 0;
            for cycle in &basis {
                equations += self.equations(cycle)?;
            }
            let free: usize = self.between.iter().map(|member| member.freedom).sum();
            let chords = self.between.iter().filter(|member| member.joint.is_none());
            let chords: usize = chords.map(|chord| chord.freedom).sum();
            let least = Least {
                freedom: free.saturating_sub(equations + coupled),
                equations: equations.saturating_sub(chords),
                by_cycles: chords == 0 && self.translated.is_empty(),
            };
            if least.freedom >= best.freedom {
                best = least;
            }
            if best.freedom >= freedom || !self.divide(basis)? {
                break;
            }
        }
        Ok(best)
    }

    /// A basis of cycles: parallelograms first, on which the others may rest, then those of few equations.
    fn basis(&mut self) -> Result<Vec<Vec<usize>>, GroupError> {
        let all = self.few_cycles();
        self.translated.clear();
        self.circles.clear();
        for cycle in &all {
            if let Some((bodies, plane)) = self.parallelogram(cycle)? {
                self.circles.insert(cycle.clone());
                for [a, b] in [[bodies[0], bodies[2]], [bodies[1], bodies[3]]] {
                    self.translated.insert((a.min(b), a.max(b)), plane);
                }
            }
        }
        if self.between.len() > MOST_MEMBERS {
            return Ok(all);
        }
        let mut ranked = Vec::with_capacity(all.len());
        for cycle in all {
            let order = (
                !self.circles.contains(&cycle),
                self.equations(&cycle)?,
                cycle.len(),
            );
            ranked.push((order, cycle));
        }
        ranked.sort_unstable();
        let wanted = rank(&self.between, self.count);
        Ok(independent(
            ranked.into_iter().map(|(_, cycle)| cycle).collect(),
            wanted,
        ))
    }

    /// The equations that closing a cycle asks for at most.
    fn equations(&mut self, cycle: &[usize]) -> Result<usize, GroupError> {
        let mut group = NOTHING;
        for (_, step) in self.steps(cycle)? {
            group = self.groups.join(group, step)?;
        }
        Ok(self.groups.dimension(group))
    }

    /// A cycle step by step, each with the body before where the cycle can be walked. Half a parallelogram, which is closed before, is one
    /// step of its coupler.
    fn steps(&mut self, cycle: &[usize]) -> Result<Vec<(Option<usize>, Group)>, GroupError> {
        let groups: Vec<Group> = cycle.iter().map(|i| self.between[*i].group).collect();
        let Some(bodies) = walk(&self.between, cycle) else {
            return Ok(groups.into_iter().map(|group| (None, group)).collect());
        };
        let plain = bodies.iter().copied().map(Some).zip(groups.iter().copied());
        if self.translated.is_empty() || self.circles.contains(cycle) {
            return Ok(plain.collect());
        }
        let count = cycle.len();
        let coupler = |position: usize| {
            let (a, b) = (bodies[position % count], bodies[(position + 2) % count]);
            self.translated.get(&(a.min(b), a.max(b))).copied()
        };
        // Begin where no parallelogram is cut in two, if two of them do not overlap.
        let start = (0..count)
            .find(|position| coupler((position + count - 1) % count).is_none())
            .unwrap_or(0);
        let mut steps = Vec::with_capacity(count);
        let mut position = start;
        while position < start + count {
            let body = Some(bodies[position % count]);
            match coupler(position) {
                Some(plane) if count > 2 && position + 2 <= start + count => {
                    steps.push((body, plane));
                    position += 2;
                }
                _ => {
                    steps.push((body, groups[position % count]));
                    position += 1;
                }
            }
        }
        Ok(steps)
    }

    /// Adds chords that make the equations of some cycles fewer. Whether there were any.
    fn divide(&mut self, basis: Vec<Vec<usize>>) -> Result<bool, GroupError> {
        let few = self.between.len() <= MOST_MEMBERS;
        let chords = self.between.iter().filter(|member| member.joint.is_none());
        let mut known: BTreeSet<[usize; 2]> = chords.map(|chord| chord.ends).collect();
        let mut cycles = Vec::with_capacity(basis.len());
        let mut news = false;
        for cycle in basis {
            let full = few && self.between.len() == MOST_MEMBERS;
            let chord = match self.chord(&cycle)? {
                Some(chord) if !full && known.insert(chord) => chord,
                _ => {
                    cycles.push(cycle);
                    continue;
                }
            };
            let group = self.bounds.between(chord[0], chord[1]);
            cycles.extend(halves(&self.between, &cycle, chord, self.between.len()));
            self.between.push(Between {
                ends: chord,
                joint: None,
                freedom: self.groups.dimension(group),
                group,
            });
            news = true;
        }
        if !few {
            self.cycles = cycles;
        }
        Ok(news)
    }

    /// Two bodies of a cycle between which a chord makes its equations fewest, if fewer.
    fn chord(&mut self, cycle: &[usize]) -> Result<Option<[usize; 2]>, GroupError> {
        let steps = self.steps(cycle)?;
        let count = steps.len();
        if !(4..=LONGEST_CYCLE).contains(&count) {
            return Ok(None);
        }
        let whole = self.equations(cycle)?;
        let mut best: Option<(usize, [usize; 2])> = None;
        for from in 0..count {
            let mut first = steps[from].1;
            for to in from + 2..count.min(from + count - 1) {
                first = self.groups.join(first, steps[to - 1].1)?;
                let (Some(a), Some(b)) = (steps[from].0, steps[to].0) else {
                    return Ok(None);
                };
                let common = self.bounds.between(a, b);
                if common == EVERYTHING {
                    continue;
                }
                let mut second = NOTHING;
                for (_, step) in steps[to..].iter().chain(&steps[..from]) {
                    second = self.groups.join(second, *step)?;
                }
                let halves = self.groups.dimension(first) + self.groups.dimension(second);
                let gain = (whole + self.groups.dimension(common)).saturating_sub(halves);
                if gain > 0 && best.is_none_or(|(other, _)| gain > other) {
                    best = Some((gain, [a.min(b), a.max(b)]));
                }
            }
        }
        Ok(best.map(|(_, chord)| chord))
    }
}

/// The two cycles that a chord between two bodies makes of one.
fn halves(
    between: &[Between],
    cycle: &[usize],
    chord: [usize; 2],
    number: usize,
) -> Vec<Vec<usize>> {
    let Some(bodies) = walk(between, cycle) else {
        return vec![cycle.to_vec()];
    };
    let mut places: Vec<usize> = (0..cycle.len())
        .filter(|place| chord.contains(&bodies[*place]))
        .collect();
    places.truncate(2);
    let [from, to] = places[..] else {
        return vec![cycle.to_vec()];
    };
    let mut inner = cycle[from..to].to_vec();
    let mut outer = [&cycle[to..], &cycle[..from]].concat();
    inner.push(number);
    outer.push(number);
    vec![inner, outer]
}
