//! From judged pairs to a mechanism: a spanning tree from the ground, breadth first; every other joint closes a loop.

use super::frame::in_frame_of_most;
use super::gears::{Joined, couple, shortest};
use super::geometry::{Geometry, Taken};
use super::pairs::Judged;
use super::standing::{Agreement, Grid, Position, Standing, standing};
use crate::names::unused;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Direction, Frame, JointBuilder, Mechanism, MechanismBuilder, MechanismError,
};
use kutzbach_step::Assembly;
use nalgebra::Vector3;
use std::collections::{BTreeSet, VecDeque};

/// A joint between two parts.
struct Edge {
    parts: (usize, usize),
    taken: Taken,
    standing: Standing,
    /// As [`Joined::sense`].
    sense: f64,
}

/// A part on the way from the ground.
#[derive(Clone)]
struct Reached {
    /// The origin of its link's frame.
    origin: Position,
    /// The joint that places it, by its index; `None` of the ground and of what floats.
    by: Option<usize>,
}

/// What was made.
pub(super) struct Built {
    pub mechanism: Mechanism,
    /// Parts that no joint connects with the ground, in groups that joints connect.
    pub islands: Vec<Vec<usize>>,
    /// Pairs of gears, by their places in [`Assembly::pairs`], that couple nothing.
    pub uncoupled: Vec<usize>,
}

/// Makes the mechanism of an assembly whose pairs are judged.
///
/// Each link's frame is parallel to the assembly's, the ground part's or that of most joints ([`in_frame_of_most`]), with its origin where the joint
/// is that places the link. Parts that no joint leads to float.
///
/// # Errors
/// What the builder of mechanisms finds wrong.
pub(super) fn build(
    name: &str,
    assembly: &Assembly,
    ground: usize,
    pairs: &[Judged],
    within: Agreement,
    may_be_exact: bool,
) -> Result<Built, MechanismError> {
    let taken: Vec<(&Judged, Taken)> = pairs
        .iter()
        .filter_map(|pair| Some((pair, pair.taken?)))
        .collect();
    let geometry: Vec<(Geometry, Vector3<f64>)> = taken
        .iter()
        .map(|(pair, taken)| (taken.geometry, drawn_at(pair)))
        .collect();
    let geometry = match assembly.parts.get(ground) {
        Some(part) => in_frame_of_most(geometry, &part.pose, within),
        None => geometry,
    };
    let (grid, standings) = standing(&geometry, within, may_be_exact);
    let edges: Vec<Edge> = taken
        .iter()
        .zip(&geometry)
        .zip(standings)
        .map(|(((pair, taken), (there, _)), standing)| Edge {
            parts: pair.parts,
            taken: *taken,
            sense: sense(there, standing.axis.as_ref()),
            standing,
        })
        .collect();
    let (reached, islands) = spread(assembly.parts.len(), ground, &edges);
    let mut builder = MechanismBuilder::new(name);
    for part in &assembly.parts {
        builder.link(&part.name);
    }
    let part_name = |place: usize| assembly.parts.get(place).map_or("", |p| p.name.as_str());
    builder.ground(part_name(ground));
    let mut names = BTreeSet::new();
    let mut joined = Vec::new();
    for (index, edge) in edges.iter().enumerate() {
        if let Some((joint, made)) = joint(index, edge, &grid, &reached, &part_name, &mut names) {
            builder.joint(joint);
            joined.push(made);
        }
    }
    let uncoupled = couple(assembly, &joined, &mut builder);
    for island in &islands {
        if let Some(root) = island.first() {
            let name = own_name(&format!("{} floats", part_name(*root)), &mut names);
            let frame = Frame::identity();
            builder.floating(&name, part_name(ground), part_name(*root), frame);
        }
    }
    Ok(Built {
        mechanism: builder.build()?,
        islands,
        uncoupled,
    })
}

/// Whether a written axis points as the direction that it stands for: 1, or -1 where it points the other way.
fn sense(geometry: &Geometry, axis: Option<&Direction>) -> f64 {
    let numbers = axis.map(|axis| Vector3::from(axis.0.each_ref().map(Number::value)));
    let along = geometry.direction().zip(numbers);
    along.map_or(1.0, |(direction, axis)| direction.dot(&axis).signum())
}

/// A point of the pair's contacts, for joints whose place is no part of what they are.
fn drawn_at(pair: &Judged) -> Vector3<f64> {
    let first = pair.contacts.first();
    first.map_or_else(Vector3::zeros, |contact| contact.point)
}

/// A name that nothing has yet, and this has from now on.
fn own_name(wanted: &str, names: &mut BTreeSet<String>) -> String {
    let name = unused(wanted, |name| names.contains(name));
    names.insert(name.clone());
    name
}

/// How every part is reached from the ground, breadth first; and the groups of those that are not, each from its first part.
fn spread(parts: usize, ground: usize, edges: &[Edge]) -> (Vec<Option<Reached>>, Vec<Vec<usize>>) {
    let mut beside: Vec<Vec<(usize, usize)>> = vec![Vec::new(); parts];
    for (index, edge) in edges.iter().enumerate() {
        let (a, b) = edge.parts;
        for (from, to) in [(a, b), (b, a)] {
            if let Some(own) = beside.get_mut(from) {
                own.push((index, to));
            }
        }
    }
    let mut reached: Vec<Option<Reached>> = vec![None; parts];
    let mut islands = Vec::new();
    let others = (0..parts).filter(|part| *part != ground);
    for root in std::iter::once(ground).chain(others) {
        match reached.get_mut(root) {
            Some(place) if place.is_none() => {
                *place = Some(Reached {
                    origin: [0; 3],
                    by: None,
                });
            }
            _ => continue,
        }
        let mut group = vec![root];
        let mut open = VecDeque::from([root]);
        while let Some(part) = open.pop_front() {
            for (index, next) in beside.get(part).into_iter().flatten() {
                let (Some(edge), Some(place)) = (edges.get(*index), reached.get_mut(*next)) else {
                    continue;
                };
                if place.is_none() {
                    *place = Some(Reached {
                        origin: edge.standing.position,
                        by: Some(*index),
                    });
                    group.push(*next);
                    open.push_back(*next);
                }
            }
        }
        if root != ground {
            islands.push(group);
        }
    }
    (reached, islands)
}

/// The joint of an edge, from the part that is nearer to the ground.
fn joint<'n>(
    index: usize,
    edge: &Edge,
    grid: &Grid,
    reached: &[Option<Reached>],
    part_name: &impl Fn(usize) -> &'n str,
    names: &mut BTreeSet<String>,
) -> Option<(JointBuilder, Joined)> {
    let (a, b) = edge.parts;
    let of = |place: usize| reached.get(place).and_then(Option::as_ref);
    let (one, two) = (of(a)?, of(b)?);
    let places = |side: &Reached| side.by == Some(index);
    // The joint that places a part leads to it.
    let ((from, near), (to, far)) = match places(one) {
        true => ((b, two), (a, one)),
        false => ((a, one), (b, two)),
    };
    let kind = edge.taken.kind;
    let name = own_name(&format!("{}-{}", part_name(a), part_name(b)), names);
    let position = &edge.standing.position;
    let origin = grid.frame(position, &near.origin);
    let mut joint = match places(far) {
        true => JointBuilder::tree(&name, kind, part_name(from), part_name(to)).origin(origin),
        false => JointBuilder::closing(&name, kind, part_name(from), part_name(to))
            .origin(origin)
            .successor_origin(grid.frame(position, &far.origin)),
    };
    let axes = [&edge.standing.axis, &edge.standing.axis2]
        .map(|axis| axis.clone().unwrap_or_else(Direction::x));
    let [axis, axis2] = axes;
    // The first axis is that of the first part; the joint may lead from the second.
    let (axis, axis2) = match kind.uses_second_axis() && from == b {
        true => (axis2, axis),
        false => (axis, axis2),
    };
    if kind.uses_axis() {
        joint = joint.axis(axis);
    }
    if kind.uses_second_axis() {
        joint = joint.axis2(axis2);
    }
    if kind.uses_lead() {
        joint = joint.lead(shortest(edge.taken.lead?));
    }
    let made = Joined {
        name,
        kind,
        parts: (from, to),
        geometry: edge.taken.geometry,
        sense: edge.sense,
    };
    Some((joint, made))
}
