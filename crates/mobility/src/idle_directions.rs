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
use std::collections::{BTreeMap, BTreeSet};

/// A direction of the kernel that moves other joints by less moves none of them; the kernel is known to some 1e-12.
const AT_REST: f64 = 1e-9;

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
    let mut incident: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &index in &part.joints {
        let joint = &mechanism.joints()[index];
        for link in [joint.predecessor.link.0, joint.successor.link.0] {
            incident.entry(link).or_default().push(index);
        }
    }
    let coupled: BTreeSet<usize> = part
        .couplings
        .iter()
        .flat_map(|&coupling| &mechanism.couplings()[coupling].terms)
        .map(|term| term.joint.0)
        .collect();
    let mut found = Vec::new();
    for (&link, joints) in &incident {
        let groups = joints.iter().all(|&joint| {
            let kind = mechanism.joints()[joint].kind;
            let told = !by_kind || kind == JointKind::Spherical;
            kind.is_subgroup() && told && !coupled.contains(&joint)
        });
        if groups {
            found.extend(moved_alone(mechanism, part, kernel, &[link], joints));
        }
        for &ball in joints {
            if let Some((links, other)) = chain(mechanism, &incident, link, ball) {
                found.extend(moved_alone(mechanism, part, kernel, &links, &[ball, other]));
            }
        }
    }
    orthonormal(found)
}

/// The links from a ball to the next one on a way that has no branches, beginning with `link`; `None` where there is no such way,
/// or it is one link.
fn chain(
    mechanism: &Mechanism,
    incident: &BTreeMap<usize, Vec<usize>>,
    link: usize,
    ball: usize,
) -> Option<(Vec<usize>, usize)> {
    let joints = mechanism.joints();
    if joints[ball].kind != JointKind::Spherical {
        return None;
    }
    let mut links = vec![link];
    let (mut link, mut before) = (link, ball);
    loop {
        let [a, b] = incident.get(&link)?.as_slice() else {
            return None;
        };
        let next = if *a == before { *b } else { *a };
        if joints[next].kind == JointKind::Spherical {
            return (links.len() > 1 && next != ball).then_some((links, next));
        }
        let ends = [
            joints[next].predecessor.link.0,
            joints[next].successor.link.0,
        ];
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
    mechanism: &Mechanism,
    part: &Part,
    kernel: &Kernel,
    links: &[usize],
    joints: &[usize],
) -> Vec<Vec<f64>> {
    if !rest_is_connected(mechanism, part, links) {
        return Vec::new();
    }
    let mut others = Vec::new();
    let mut column = 0;
    for &joint in &part.joints {
        let freedom = mechanism.joints()[joint].freedom();
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
fn rest_is_connected(mechanism: &Mechanism, part: &Part, links: &[usize]) -> bool {
    let mut piece: BTreeMap<usize, usize> = BTreeMap::new();
    let ends = |joint: usize| {
        let joint = &mechanism.joints()[joint];
        [joint.predecessor.link.0, joint.successor.link.0]
    };
    for end in part.joints.iter().flat_map(|&joint| ends(joint)) {
        if !links.contains(&end) {
            piece.insert(end, end);
        }
    }
    for &joint in &part.joints {
        let [a, b] = ends(joint).map(|end| piece.get(&end).copied());
        if let (Some(a), Some(b)) = (a, b)
            && a != b
        {
            piece.values_mut().filter(|p| **p == b).for_each(|p| *p = a);
        }
    }
    let distinct: BTreeSet<usize> = piece.values().copied().collect();
    distinct.len() == 1
}
