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

use super::basis::{MOST_MEMBERS, independent, rank};
use super::bodies::{Bodies, walk};
use super::chords::{Chord, joints};
use super::groups::{Group, NOTHING};
use super::network::Network;
use super::placing::Placed;
use kutzbach_closure::{Part, Structure};
use kutzbach_math::group::{GroupError, Margin, Subalgebra};
use kutzbach_model::mechanism::Mechanism;

/// Times that links which became one give new neighbours to be looked at, and times that chords are looked for.
const ROUNDS: usize = 6;

/// What subgroups leave to a part.
pub struct Counted {
    /// The freedom that independent equations of its cycles would leave, zero at least; never more than the rank leaves.
    pub least: usize,
    /// The freedom of bodies between two joints that may move without any effect on others, which is certain.
    pub idle: usize,
    /// Equations that its cycles ask for in what the joints are left.
    pub equations: usize,
    /// Joints whose two links are one.
    pub held: Vec<usize>,
    /// Joints that are left a smaller group.
    pub confined: Vec<(usize, Subalgebra)>,
    /// Chains whose products are no group, and what they have in common.
    pub chords: Vec<Chord>,
    /// The joints of parallelograms.
    pub parallelograms: Vec<Vec<usize>>,
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
    structure: &Structure,
    part: &Part,
    placed: &Placed,
    freedom: usize,
) -> Result<Counted, GroupError> {
    let whole =
        Network::new(mechanism, structure, part, placed, false)?.counted(structure, freedom)?;
    if whole.least >= freedom || !Bodies::can_be_divided(mechanism, part, placed) {
        return Ok(whole);
    }
    let divided =
        Network::new(mechanism, structure, part, placed, true)?.counted(structure, freedom)?;
    Ok(match divided.least < freedom {
        true => whole,
        false => divided,
    })
}

impl Network {
    fn counted(mut self, structure: &Structure, freedom: usize) -> Result<Counted, GroupError> {
        let idle = self.idle()?;
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
        held.sort_by_key(|joint| structure.graph.edge_rank(*joint));
        confined.sort_by_key(|(joint, _)| structure.graph.edge_rank(*joint));
        let circles = self.circles.iter();
        let parallelograms = circles.map(|cycle| joints(&self.between, cycle)).collect();
        Ok(Counted {
            least: least.freedom,
            idle,
            equations: least.equations,
            by_cycles_alone: least.by_cycles && !self.tightened,
            held,
            confined,
            chords: self.told,
            parallelograms,
            margin: self.groups.margin(),
        })
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
            let again = self.between.iter().filter(|member| member.again);
            let again: usize = again.map(|member| member.freedom).sum();
            let least = Least {
                freedom: free.saturating_sub(equations + coupled),
                equations: equations.saturating_sub(again),
                by_cycles: again == 0 && self.translated.is_empty(),
            };
            if least.freedom >= best.freedom {
                best = least;
            }
            if best.freedom >= freedom || !(self.divide(basis)? || self.divide_another()?) {
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
            if let Some((_, plane)) = self.parallelogram(cycle)? {
                self.circles.insert(cycle.clone());
                for (one, next) in cycle.iter().zip(cycle.iter().cycle().skip(1)) {
                    self.translated
                        .insert([*one.min(next), *one.max(next)], plane);
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
    pub fn equations(&mut self, cycle: &[usize]) -> Result<usize, GroupError> {
        let mut group = NOTHING;
        for (_, step) in self.steps(cycle)? {
            group = self.groups.join(group, step)?;
        }
        Ok(self.groups.dimension(group))
    }

    /// A cycle step by step, each with the body before where the cycle can be walked. Half a parallelogram, which is closed before, is one
    /// step of its coupler.
    pub fn steps(&mut self, cycle: &[usize]) -> Result<Vec<(Option<usize>, Group)>, GroupError> {
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
            let [one, next] = [position, position + 1].map(|place| cycle[place % count]);
            self.translated
                .get(&[one.min(next), one.max(next)])
                .copied()
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
}
