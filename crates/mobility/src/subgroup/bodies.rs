//! A part as bodies between which there are subgroups.

use super::groups::{Group, Groups};
use super::placing::{Placed, ends};
use kutzbach_closure::{Part, Structure};
use kutzbach_math::group::{GroupError, Twist};
use kutzbach_model::mechanism::{JointKind, Mechanism};
use std::collections::BTreeMap;

/// What lies between two bodies: a manifold of displacements in a subgroup, all of it unless `freedom` is less than its dimension.
#[derive(Clone, Debug)]
pub struct Between {
    /// The bodies.
    pub ends: [usize; 2],
    /// The joint it belongs to; `None` of what follows from others.
    pub joint: Option<usize>,
    /// Dimension of the manifold.
    pub freedom: usize,
    /// Whether it follows from other members.
    pub again: bool,
    /// The subgroup.
    pub group: Group,
}

/// Links, and bodies within joints.
pub struct Bodies {
    /// Number of bodies.
    pub count: usize,
    /// What lies between them.
    pub between: Vec<Between>,
    /// Independent cycles, in the order of the walk.
    pub cycles: Vec<Vec<usize>>,
    /// The bodies of each joint's two links.
    pub links: BTreeMap<usize, [usize; 2]>,
}

impl Bodies {
    /// The bodies of a part: its links, and one more between the two subgroups of a joint that is a product. `divided` puts bodies also
    /// between the translations and the rotations of joints that are one subgroup, in both orders.
    pub fn new(
        mechanism: &Mechanism,
        structure: &Structure,
        part: &Part,
        placed: &Placed,
        divided: bool,
        groups: &mut Groups,
    ) -> Result<Self, GroupError> {
        let mut numbers = BTreeMap::new();
        let mut links = BTreeMap::new();
        // By name, so that the order in the file changes nothing.
        let mut order: Vec<(usize, &Vec<Twist>)> =
            part.joints.iter().copied().zip(&placed.screws).collect();
        order.sort_by_key(|(joint, _)| structure.graph.edge_rank(*joint));
        for &(joint, _) in &order {
            let both = ends(mechanism, joint).map(|link| {
                let next = numbers.len();
                *numbers.entry(link).or_insert(next)
            });
            links.insert(joint, both);
        }
        let mut bodies = Self {
            count: numbers.len(),
            between: Vec::new(),
            cycles: Vec::new(),
            links,
        };
        let mut of_joints = BTreeMap::new();
        for (joint, screws) in order {
            let kind = mechanism.joints()[joint].kind;
            let factors = factors(kind, screws, divided);
            let first = bodies.between.len();
            let both = bodies.links[&joint];
            let chain = bodies.chain(joint, both, &factors, groups)?;
            bodies.between.extend(chain);
            let own = first..bodies.between.len();
            if divided && factors.len() > 1 && kind.is_subgroup() {
                let turned: Vec<_> = factors.into_iter().rev().collect();
                let mut chain = bodies.chain(joint, both, &turned, groups)?;
                chain.iter_mut().for_each(|member| member.again = true);
                bodies.between.extend(chain);
                // Both orders close a cycle that asks for as much as the second has freedom.
                let again = own.end..bodies.between.len();
                bodies.cycles.push(own.clone().chain(again.rev()).collect());
            }
            of_joints.insert(joint, own);
        }
        for cycle in &part.cycles {
            let mut walk = Vec::new();
            for (joint, forward) in cycle {
                let own = of_joints.get(joint).cloned().unwrap_or_default();
                if *forward {
                    walk.extend(own);
                } else {
                    walk.extend(own.rev());
                }
            }
            bodies.cycles.push(walk);
        }
        Ok(bodies)
    }

    /// Factors one after the other between two links, with new bodies between them.
    fn chain(
        &mut self,
        joint: usize,
        [from, to]: [usize; 2],
        factors: &[Vec<Twist>],
        groups: &mut Groups,
    ) -> Result<Vec<Between>, GroupError> {
        let mut chain = Vec::with_capacity(factors.len());
        let mut at = from;
        for (number, screws) in factors.iter().enumerate() {
            let next = if number + 1 == factors.len() {
                to
            } else {
                self.count += 1;
                self.count - 1
            };
            chain.push(Between {
                ends: [at, next],
                joint: Some(joint),
                freedom: screws.len(),
                again: false,
                group: groups.generated_by(screws)?,
            });
            at = next;
        }
        if factors.is_empty() {
            chain.push(Between {
                ends: [from, to],
                joint: Some(joint),
                freedom: 0,
                again: false,
                group: groups.generated_by(&[])?,
            });
        }
        Ok(chain)
    }

    /// Whether some joint has a motion that can be divided.
    pub fn can_be_divided(mechanism: &Mechanism, part: &Part, placed: &Placed) -> bool {
        part.joints
            .iter()
            .zip(&placed.screws)
            .any(|(&joint, screws)| {
                let kind = mechanism.joints()[joint].kind;
                factors(kind, screws, true).len() > factors(kind, screws, false).len()
            })
    }
}

/// The bodies before the members of a cycle; `None` where it is none that passes each body once.
pub fn walk(between: &[Between], cycle: &[usize]) -> Option<Vec<usize>> {
    let ends = |position: usize| between[cycle[position]].ends;
    if cycle.len() < 2 {
        return None;
    }
    let begins = |start: usize| {
        let mut at = start;
        let mut bodies = Vec::with_capacity(cycle.len());
        for position in 0..cycle.len() {
            if bodies.contains(&at) {
                return None;
            }
            bodies.push(at);
            at = match ends(position) {
                [a, b] if a == at => b,
                [a, b] if b == at => a,
                _ => return None,
            };
        }
        (at == start).then_some(bodies)
    };
    begins(ends(0)[0]).or_else(|| begins(ends(0)[1]))
}

/// Some screws of a joint that are not taken apart.
struct Factor {
    /// Number of the subgroup in the joint's product of subgroups.
    subgroup: usize,
    screws: Vec<Twist>,
}

/// The factors of a joint, from its screws in the order of its variables.
///
/// A joint of [`JointKind::is_subgroup`] is one subgroup, every other a product of two. Planar motions, cylindrical ones and
/// the like are translations times the rotations or screws about an axis, in either order; where the translations end
/// depends on nothing but the joint. How a ball or a plane's translations could be taken apart depends on the choice of
/// axes, and they are left whole.
fn of_joint(kind: JointKind, screws: &[Twist]) -> Vec<Factor> {
    let subgroups: &[&[usize]] = match kind {
        JointKind::Fixed => &[],
        JointKind::Revolute | JointKind::Prismatic | JointKind::Screw => &[&[1]],
        JointKind::Cylindrical => &[&[1, 1]],
        JointKind::Universal => &[&[1], &[1]],
        JointKind::PlanarTranslation => &[&[2]],
        JointKind::Planar | JointKind::TranslatingScrew => &[&[2, 1]],
        JointKind::Spherical | JointKind::Translational => &[&[3]],
        JointKind::Schoenflies => &[&[3, 1]],
        JointKind::PointOnLine => &[&[3], &[1]],
        JointKind::LineOnPlane => &[&[1], &[2, 1]],
        JointKind::PointOnPlane => &[&[3], &[2]],
        // The two swings of the rod turn about its first point.
        JointKind::Distance => &[&[2], &[3]],
    };
    let mut rest = screws.iter().copied();
    let mut factors = Vec::new();
    for (subgroup, numbers) in subgroups.iter().enumerate() {
        for &number in *numbers {
            let screws = rest.by_ref().take(number).collect();
            factors.push(Factor { subgroup, screws });
        }
    }
    factors
}

/// The screws of a joint, those of one subgroup together unless they are to be divided.
fn factors(kind: JointKind, screws: &[Twist], divided: bool) -> Vec<Vec<Twist>> {
    let mut factors: Vec<Vec<Twist>> = Vec::new();
    let mut last = None;
    for factor in of_joint(kind, screws) {
        match factors.last_mut() {
            Some(before) if !divided && last == Some(factor.subgroup) => {
                before.extend(factor.screws);
            }
            _ => factors.push(factor.screws),
        }
        last = Some(factor.subgroup);
    }
    factors
}
