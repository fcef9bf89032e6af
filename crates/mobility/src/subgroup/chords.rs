//! Chords: what holds between two bodies of a cycle, as one more member.

use super::basis::MOST_MEMBERS;
use super::bodies::{Between, walk};
use super::groups::{EVERYTHING, NOTHING};
use super::network::{LONGEST_CYCLE, Network};
use kutzbach_math::group::{GroupError, Subalgebra};
use std::collections::BTreeSet;

/// Two chains of a cycle, between the same two bodies.
#[derive(Clone)]
pub struct Chord {
    /// The joints of each, with the group that they generate.
    pub chains: [(Vec<usize>, Subalgebra); 2],
    /// The group that bounds what the two bodies do to each other.
    pub common: Subalgebra,
}

impl Network {
    /// Adds chords that make the equations of some cycles fewer. Whether there were any.
    pub fn divide(&mut self, basis: Vec<Vec<usize>>) -> Result<bool, GroupError> {
        let few = self.between.len() <= MOST_MEMBERS;
        let ends = self.between.iter().map(|member| member.ends);
        let mut known: BTreeSet<[usize; 2]> = ends.map(|[a, b]| [a.min(b), a.max(b)]).collect();
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
            let halves = halves(&self.between, &cycle, chord, self.between.len());
            if let [one, other] = &halves[..] {
                let chains = [self.chain(one)?, self.chain(other)?];
                self.told.push(Chord {
                    chains,
                    common: self.groups.algebra(group).clone(),
                });
            }
            cycles.extend(halves);
            self.between.push(Between {
                ends: chord,
                joint: None,
                freedom: self.groups.dimension(group),
                again: true,
                group,
            });
            news = true;
        }
        if !few {
            self.cycles = cycles;
        }
        Ok(news)
    }

    /// Adds a chord to the first cycle, whether of the basis or not, that has one not known yet.
    pub fn divide_another(&mut self) -> Result<bool, GroupError> {
        if self.between.len() >= MOST_MEMBERS {
            return Ok(false);
        }
        for cycle in self.few_cycles() {
            if self.divide(vec![cycle])? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The joints of a chain, and what they generate. The member that follows the last of them closes it.
    fn chain(&mut self, closed: &[usize]) -> Result<(Vec<usize>, Subalgebra), GroupError> {
        let chain = &closed[..closed.len().saturating_sub(1)];
        let mut group = NOTHING;
        for member in chain {
            group = self.groups.join(group, self.between[*member].group)?;
        }
        let algebra = self.groups.algebra(group).clone();
        Ok((joints(&self.between, chain), algebra))
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

/// The joints of some members, each once, in order.
pub fn joints(between: &[Between], members: &[usize]) -> Vec<usize> {
    let mut joints = Vec::new();
    for joint in members.iter().filter_map(|member| between[*member].joint) {
        if !joints.contains(&joint) {
            joints.push(joint);
        }
    }
    joints
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
