//! Idle motions that a part has at every pose: they are taken out before its singular poses are looked into.
//!
//! A link whose joints are all displacement subgroups may make the motions that all of them allow while everything else
//! stands still. Seen from the link these subgroups never change, and neither does what they have in common: the spin of a
//! rod between two balls, the way of a sleeve on a shaft. A chain of links between two balls can spin about the line through
//! them, whatever its other joints do. Near any pose the configuration space is thus a product of these motions and of the
//! rest, and the rest has fewer variables and no definite forms multiplied by idle freedoms.
//!
//! Cost: links × δ² × unknowns.

use super::chart::Kernel;
use super::one_sided::OneSided;
use super::tracing::orthonormal;
use kutzbach_closure::Part;
use kutzbach_model::mechanism::{JointKind, Mechanism};
use petgraph::unionfind::UnionFind;
use std::collections::{BTreeMap, BTreeSet};

/// A direction of the kernel that moves other joints by less moves none of them; the kernel is known to some 1e-12.
pub(super) const AT_REST: f64 = 1e-9;

/// One that moves them by more is no idle one. Between, nothing is taken out.
const MOVES: f64 = 1e-5;

/// Directions of the kernel along which single links, or chains between two balls, move by themselves at this pose and at all
/// others: orthonormal in the metric.
///
/// Two axes count as one where the kernel, which is known in double precision only, cannot tell them apart. With `by_kind` that is
/// not enough: numbers of many digits may have been written to keep them apart. Then only what the kinds of the joints make
/// idle is taken out, the spin about the line through two balls.
pub(super) fn idle_directions(
    mechanism: &Mechanism,
    part: &Part,
    kernel: &Kernel,
    by_kind: bool,
) -> Vec<Vec<f64>> {
    let bodies = Bodies::of(mechanism, part);
    let mut incident: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &joint in &bodies.joints {
        for body in bodies.ends(joint) {
            incident.entry(body).or_default().push(joint);
        }
    }
    let coupled: BTreeSet<usize> = part
        .couplings
        .iter()
        .flat_map(|&coupling| &mechanism.couplings()[coupling].terms)
        .map(|term| term.joint.0)
        .collect();
    let mut found = Vec::new();
    for (&body, joints) in &incident {
        let groups = joints.iter().all(|&joint| {
            let kind = mechanism.joints()[joint].kind;
            let told = !by_kind || kind == JointKind::Spherical;
            kind.is_subgroup() && told && !coupled.contains(&joint)
        });
        if groups {
            found.extend(moved_alone(&bodies, part, kernel, &[body], joints));
        }
        for &ball in joints {
            if let Some((links, other)) = chain(&bodies, &incident, body, ball) {
                found.extend(moved_alone(&bodies, part, kernel, &links, &[ball, other]));
            }
        }
    }
    orthonormal(found)
}

/// Links of a part that fixed joints make one body are counted as one: each stands for its body by the least index.
struct Bodies<'a> {
    mechanism: &'a Mechanism,
    /// The joints of the part that are not fixed.
    joints: Vec<usize>,
    of_link: BTreeMap<usize, usize>,
}

impl<'a> Bodies<'a> {
    fn of(mechanism: &'a Mechanism, part: &Part) -> Self {
        let ends = |joint: usize| {
            let joint = &mechanism.joints()[joint];
            [joint.predecessor.link.0, joint.successor.link.0]
        };
        let mut links: Vec<usize> = part.joints.iter().flat_map(|&joint| ends(joint)).collect();
        links.sort_unstable();
        links.dedup();
        let mut joined = UnionFind::new(links.len());
        let place = |link: usize| links.partition_point(|&other| other < link);
        let (fixed, joints): (Vec<usize>, Vec<usize>) = part
            .joints
            .iter()
            .partition(|&&joint| mechanism.joints()[joint].kind == JointKind::Fixed);
        for [a, b] in fixed.into_iter().map(ends) {
            joined.union(place(a), place(b));
        }
        let mut first: BTreeMap<usize, usize> = BTreeMap::new();
        let of_link = links
            .iter()
            .enumerate()
            .map(|(index, &link)| (link, *first.entry(joined.find(index)).or_insert(link)))
            .collect();
        Self {
            mechanism,
            joints,
            of_link,
        }
    }

    fn kind(&self, joint: usize) -> JointKind {
        self.mechanism.joints()[joint].kind
    }

    /// The two bodies of a joint of the part.
    fn ends(&self, joint: usize) -> [usize; 2] {
        let joint = &self.mechanism.joints()[joint];
        [joint.predecessor.link.0, joint.successor.link.0].map(|link| self.of_link[&link])
    }
}

/// The bodies from a ball to the next one on a way that has no branches, beginning with `link`; `None` where there is no such way,
/// or it is one link.
fn chain(
    bodies: &Bodies<'_>,
    incident: &BTreeMap<usize, Vec<usize>>,
    link: usize,
    ball: usize,
) -> Option<(Vec<usize>, usize)> {
    if bodies.kind(ball) != JointKind::Spherical {
        return None;
    }
    let mut links = vec![link];
    let (mut link, mut before) = (link, ball);
    loop {
        let [a, b] = incident.get(&link)?.as_slice() else {
            return None;
        };
        let next = if *a == before { *b } else { *a };
        if bodies.kind(next) == JointKind::Spherical {
            return (links.len() > 1 && next != ball).then_some((links, next));
        }
        let ends = bodies.ends(next);
        link = if ends[0] == link { ends[1] } else { ends[0] };
        before = next;
        if links.contains(&link) {
            return None;
        }
        links.push(link);
    }
}

/// The directions of the kernel that move the joints named only, if these are all that tie the links to a connected rest.
fn moved_alone(
    bodies: &Bodies<'_>,
    part: &Part,
    kernel: &Kernel,
    links: &[usize],
    joints: &[usize],
) -> Vec<Vec<f64>> {
    if !rest_is_connected(bodies, links) {
        return Vec::new();
    }
    let mut others = Vec::new();
    let mut column = 0;
    for &joint in &part.joints {
        let freedom = bodies.kind(joint).freedom();
        if !joints.contains(&joint) {
            others.extend(column..column + freedom);
        }
        column += freedom;
    }
    let basis = &kernel.basis.vectors;
    let moves = basis
        .iter()
        .map(|vector| others.iter().map(|&column| vector[column]).collect());
    let Some(turned) = OneSided::of(moves.collect()) else {
        return Vec::new();
    };
    if turned.values.iter().any(|v| (AT_REST..MOVES).contains(v)) {
        return Vec::new();
    }
    turned
        .values
        .iter()
        .zip(&turned.combinations)
        .filter(|(value, _)| **value < AT_REST)
        .map(|(_, combination)| {
            let mut direction = vec![0.0; kernel.basis.length];
            for (vector, weight) in basis.iter().zip(combination) {
                direction
                    .iter_mut()
                    .zip(vector)
                    .for_each(|(sum, x)| *sum += weight * x);
            }
            direction
        })
        .collect()
}

/// Whether what is left of a part without some links hangs together, so that it stands still where its joints do.
fn rest_is_connected(bodies: &Bodies<'_>, links: &[usize]) -> bool {
    let mut piece: BTreeMap<usize, usize> = BTreeMap::new();
    for end in bodies.joints.iter().flat_map(|&joint| bodies.ends(joint)) {
        if !links.contains(&end) {
            piece.insert(end, end);
        }
    }
    for &joint in &bodies.joints {
        let [a, b] = bodies.ends(joint).map(|end| piece.get(&end).copied());
        if let (Some(a), Some(b)) = (a, b)
            && a != b
        {
            piece.values_mut().filter(|p| **p == b).for_each(|p| *p = a);
        }
    }
    let distinct: BTreeSet<usize> = piece.values().copied().collect();
    distinct.len() == 1
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::part_samples::Posed;
    use kutzbach_model::mechanism::{JointBuilder, MechanismBuilder};

    /// A rod between two balls, of one link and of two that are fixed to each other, beside a rod that holds the two ends together.
    #[test]
    fn a_body_of_fixed_links_is_idle_as_one_link_is() {
        for links in [1, 2] {
            let mut builder = MechanismBuilder::new("rod");
            builder.link("ground").link("rod");
            let tree = |name, kind, from, to| JointBuilder::tree(name, kind, from, to);
            builder.joint(tree("a", JointKind::Spherical, "ground", "rod"));
            let last = if links == 2 {
                builder.link("end");
                builder.joint(tree("weld", JointKind::Fixed, "rod", "end"));
                "end"
            } else {
                "rod"
            };
            let at = kutzbach_model::mechanism::Frame::at_point([1.0, 0.0, 0.0]).unwrap();
            builder.joint(
                JointBuilder::closing("b", JointKind::Spherical, "ground", last)
                    .origin(at.clone())
                    .successor_origin(at),
            );
            let posed = Posed::new(builder.build().unwrap());
            let kernel = posed.kernel(&posed.rank());
            let idle = idle_directions(&posed.mechanism, posed.part(), &kernel, false);
            assert_eq!(idle.len(), 1, "{links} links");
        }
    }
}
