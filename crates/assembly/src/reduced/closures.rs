//! What the tree does not see to.

use super::{Asks, Closure, ReducedSystem};
use crate::placed::Placed;
use std::collections::BTreeSet;

/// All closures of a tree: points first, then distances. `None` where a number cannot be read.
pub(super) fn closures(system: &ReducedSystem, placed: &Placed) -> Option<Vec<Closure>> {
    let mut found = Vec::new();
    let mut links: Vec<(usize, [usize; 2])> = Vec::new();
    for point in 0..system.collection.points().len() {
        for between in apart(system, point) {
            let has = |other: usize| {
                let holds = |b: usize| system.collection.bodies()[b].points.contains(&other);
                holds(between[0]) && holds(between[1])
            };
            let beside = links
                .iter()
                .find(|(other, pair)| *pair == between && has(*other))
                .map(|(other, _)| *other);
            links.push((point, between));
            let common = common_body(system, between);
            let [a, b] = between.map(|body| system.expressed(point, body, common));
            let (a, b) = (a?, b?);
            for coordinate in 0..3 {
                found.push(Closure {
                    polynomial: a[coordinate].minus(&b[coordinate]),
                    asks: Asks::Point {
                        point,
                        coordinate,
                        between,
                        beside,
                    },
                });
            }
        }
    }
    for [p, q] in distances(system) {
        let holders = |point: usize| {
            let holds = |b: &&usize| system.collection.bodies()[**b].points.contains(&point);
            system
                .tree
                .cover
                .iter()
                .filter(holds)
                .copied()
                .collect::<Vec<usize>>()
        };
        // The two bodies that are nearest in the tree.
        let mut best: Option<(usize, [usize; 2])> = None;
        for &a in &holders(p) {
            for &b in &holders(q) {
                let (way_a, way_b) = (system.way_up(a), system.way_up(b));
                let steps = way_a.len() + way_b.len();
                if best.as_ref().is_none_or(|(least, _)| steps < *least) {
                    best = Some((steps, [a, b]));
                }
            }
        }
        let (_, [a, b]) = best?;
        let square = placed.distance_square(p, q)?;
        let mut field = system.field.clone();
        let wanted = super::Poly::constant(field.read(&square)?);
        // A number that the field does not hold yet would give coefficients of another field.
        if field.generators().len() != system.field.generators().len() {
            return None;
        }
        let common = common_body(system, [a, b]);
        let origin = [0, 1, 2].map(|_| kutzbach_algebra::FieldElement::default());
        let own = |point, body| system.square_from(&origin, point, body, common);
        let (one, other) = (
            system.expressed(p, a, common)?,
            system.expressed(q, b, common)?,
        );
        let body = &system.locals[common];
        let product = body.dot_of(&one, &other, &system.field);
        let two = kutzbach_algebra::FieldElement::integer(2);
        let polynomial = own(p, a)?
            .plus(&own(q, b)?)
            .minus(&product.scaled(&two, &system.field))
            .minus(&wanted);
        found.push(Closure {
            polynomial,
            asks: Asks::Distance { points: [p, q] },
        });
    }
    Some(found)
}

/// Pairs of bodies of the tree that have a point which the tree does not bring together; those that share more points first.
fn apart(system: &ReducedSystem, point: usize) -> Vec<[usize; 2]> {
    let bodies = system.collection.bodies();
    let cover = &system.tree.cover;
    let holders: Vec<usize> = cover
        .iter()
        .copied()
        .filter(|&b| bodies[b].points.contains(&point))
        .collect();
    let mut part: Vec<usize> = (0..holders.len()).collect();
    let place = |body: usize| holders.iter().position(|&h| h == body);
    let merge = |part: &mut Vec<usize>, a: usize, b: usize| {
        let (from, to) = (part[a].max(part[b]), part[a].min(part[b]));
        part.iter_mut()
            .filter(|p| **p == from)
            .for_each(|p| *p = to);
    };
    for edge in system
        .tree
        .edges
        .iter()
        .filter(|e| e.shared.contains(&point))
    {
        if let (Some(a), Some(b)) = (place(edge.parent), place(edge.child)) {
            merge(&mut part, a, b);
        }
    }
    let mut pairs = Vec::new();
    for a in 0..holders.len() {
        for b in a + 1..holders.len() {
            let shared = system.collection.shared(holders[a], holders[b]).len();
            pairs.push((std::cmp::Reverse(shared), a, b));
        }
    }
    pairs.sort_unstable();
    let mut links = Vec::new();
    for (_, a, b) in pairs {
        if part[a] != part[b] {
            merge(&mut part, a, b);
            links.push([holders[a], holders[b]]);
        }
    }
    links
}

/// Distances that are kept, and that no body of the tree keeps.
fn distances(system: &ReducedSystem) -> Vec<[usize; 2]> {
    let bodies = system.collection.bodies();
    let mut kept = BTreeSet::new();
    for &body in &system.tree.cover {
        let points = &bodies[body].points;
        for (i, &p) in points.iter().enumerate() {
            kept.extend(points[i + 1..].iter().map(|&q| [p, q]));
        }
    }
    let all = system.collection.distances();
    all.into_iter()
        .filter(|pair| !kept.contains(pair))
        .collect()
}

/// The nearest body that is above both.
fn common_body(system: &ReducedSystem, [a, b]: [usize; 2]) -> usize {
    let above = system.way_up(b);
    let found = system
        .way_up(a)
        .into_iter()
        .find(|body| above.contains(body));
    found.unwrap_or(system.tree.root)
}
