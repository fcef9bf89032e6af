//! Bodies that share three points not on a line: nothing moves between them, so that they are one body.

use super::nodes::Nodes;
use super::{Exact3, Slack, cross, dot, minus, square};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::ExactPose;
use std::collections::BTreeMap;

/// Two bodies that are one.
pub(super) struct Joined {
    /// The bodies.
    pub(super) groups: [usize; 2],
    /// `first_from_second`.
    pub(super) pose: ExactPose,
    /// How much farther than the three points another point of the second body moves at most.
    pub(super) lever: f64,
}

/// Points of rounded coordinates are on a line if they are off it by so many times what the digits leave open of a length.
const CLEARLY: f64 = 10.0;

/// The first two bodies that share three points not on a line. Where the distances differ, there is no such placement: what
/// checks distances says so.
pub(super) fn joined(nodes: &Nodes, slack: &Slack) -> Option<Joined> {
    // Nodes of both bodies by pair of bodies.
    let mut shared: BTreeMap<[usize; 2], Vec<[usize; 2]>> = BTreeMap::new();
    let mut holders: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for node in 0..nodes.all.len() {
        holders.entry(nodes.class(node)).or_default().push(node);
    }
    for class in holders.values() {
        for (i, &a) in class.iter().enumerate() {
            for &b in &class[i + 1..] {
                let groups = [nodes.all[a].group, nodes.all[b].group];
                let (groups, pair) = match groups[0] < groups[1] {
                    true => (groups, [a, b]),
                    false => ([groups[1], groups[0]], [b, a]),
                };
                if groups[0] != groups[1] {
                    shared.entry(groups).or_default().push(pair);
                }
            }
        }
    }
    let many = shared.iter().filter(|(_, pairs)| pairs.len() > 2);
    many.into_iter()
        .find_map(|(groups, pairs)| by_points(nodes, *groups, pairs, slack))
}

fn by_points(
    nodes: &Nodes,
    groups: [usize; 2],
    pairs: &[[usize; 2]],
    slack: &Slack,
) -> Option<Joined> {
    let sides = [0, 1].map(|side| -> Vec<&Exact3> {
        pairs.iter().map(|pair| &nodes.all[pair[side]].at).collect()
    });
    let three = widest(&sides[0], slack)?;
    let corners = [0, 1].map(|side| three.map(|i| sides[side][i]));
    let lengths =
        corners.map(|[a, b, c]| [(a, b), (a, c), (b, c)].map(|(p, q)| square(&minus(p, q))));
    if lengths[0] != lengths[1] {
        return None;
    }
    let [to, of] = corners.map(basis);
    let squares = of.each_ref().map(square);
    let mut rotation = ExactPose::identity().rotation;
    for (i, row) in rotation.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = Number::zero();
            for k in 0..3 {
                let part = (&to[k][i] * &of[k][j]).checked_div(&squares[k]).ok()?;
                *entry = &*entry + &part;
            }
        }
    }
    let mut pose = ExactPose {
        rotation,
        ..ExactPose::identity()
    };
    pose.translation = minus(corners[0][0], &pose.rotate(corners[1][0]));
    let points = nodes.all.iter().filter(|node| node.group == groups[1]);
    let reach = points.map(|node| far(&node.at, corners[1][0]));
    let reach = reach.fold(0.0, f64::max);
    let [base, height] = [0, 1].map(|k| squares[k].value().sqrt());
    Some(Joined {
        groups,
        pose,
        lever: (reach / base).max(1.0) * (reach / height).max(1.0),
    })
}

fn far(a: &Exact3, b: &Exact3) -> f64 {
    square(&minus(a, b)).value().sqrt()
}

/// Three of some points that span the largest triangle with the first; `None` where all are on a line.
fn widest(points: &[&Exact3], slack: &Slack) -> Option<[usize; 3]> {
    let mut best = (0.0, None);
    for b in 1..points.len() {
        for c in b + 1..points.len() {
            let ways = [b, c].map(|i| minus(points[i], points[0]));
            let normal = cross(&ways[0], &ways[1]);
            if normal.iter().all(Number::is_zero) {
                continue;
            }
            let area = square(&normal).value().sqrt();
            let base = ways.each_ref().map(|way| square(way).value().sqrt());
            let height = area / base[0].max(base[1]);
            if area > best.0 && height > CLEARLY * slack.metres {
                best = (area, Some([0, b, c]));
            }
        }
    }
    best.1
}

/// A side of a triangle, the height on it from the third corner, and their product: perpendicular to each other.
fn basis([a, b, c]: [&Exact3; 3]) -> [Exact3; 3] {
    let side = minus(b, a);
    let way = minus(c, a);
    let long = square(&side);
    let along = dot(&way, &side);
    // Times the square of the side, so that nothing is divided.
    let height = [0, 1, 2].map(|i| &(&way[i] * &long) - &(&side[i] * &along));
    let third = cross(&side, &height);
    [side, height, third]
}
