//! What is drawn before what.

use super::scene::Item;
use super::solid::{Solid, closest};
use crate::picture::vector::{difference, norm};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_scene::Part;
use std::cmp::Ordering;

/// Beyond this number of items, they are sorted by the depth of their middles.
const COMPARED: usize = 2500;
/// Depths closer than this (px) are equal.
const EQUAL: f64 = 0.05;

/// Indices of items, farthest first.
///
/// Items whose outlines overlap are compared where they do; the order agrees with every comparison, unless these go round
/// in a circle. Among those that may come next, one of the link drawn last is taken, so that its parts become one figure,
/// otherwise the farthest.
pub fn back_to_front(mechanism: &Mechanism, items: &[Item]) -> Vec<usize> {
    let depth: Vec<f64> = items.iter().map(|item| item.solid.centre()[2]).collect();
    let farther = |a: &usize, b: &usize| depth[*a].total_cmp(&depth[*b]).then(a.cmp(b));
    let mut by_depth: Vec<usize> = (0..items.len()).collect();
    by_depth.sort_by(farther);
    if items.len() > COMPARED {
        return by_depth;
    }
    let mut nearer: Vec<Vec<usize>> = vec![Vec::new(); items.len()];
    let mut behind = vec![0_usize; items.len()];
    for_overlapping(items, |a, b| {
        let (back, front) = match compare(mechanism, &items[a], &items[b]) {
            Ordering::Less => (a, b),
            Ordering::Greater => (b, a),
            Ordering::Equal => return,
        };
        nearer[back].push(front);
        behind[front] += 1;
    });
    let mut waiting = by_depth;
    let mut order: Vec<usize> = Vec::with_capacity(items.len());
    while !waiting.is_empty() {
        let same = |&i: &usize| {
            order.last().is_some_and(|&last| {
                items[i].part == items[last].part && items[i].link == items[last].link
            })
        };
        let free = |&i: &usize| behind[i] == 0;
        let position = waiting
            .iter()
            .position(|i| free(i) && same(i))
            .or_else(|| waiting.iter().position(free))
            // A circle: the farthest is as good as any.
            .unwrap_or(0);
        let next = waiting.remove(position);
        for &front in &nearer[next] {
            behind[front] = behind[front].saturating_sub(1);
        }
        order.push(next);
    }
    order
}

/// Calls `each` for all pairs whose boxes overlap.
fn for_overlapping(items: &[Item], mut each: impl FnMut(usize, usize)) {
    let boxes: Vec<[[f64; 2]; 2]> = items.iter().map(|item| item.solid.bounds()).collect();
    let mut by_left: Vec<usize> = (0..items.len()).collect();
    by_left.sort_by(|a, b| boxes[*a][0][0].total_cmp(&boxes[*b][0][0]));
    for (position, &a) in by_left.iter().enumerate() {
        for &b in &by_left[position + 1..] {
            if boxes[b][0][0] > boxes[a][1][0] + 1.0 {
                break;
            }
            if boxes[a][0][1] <= boxes[b][1][1] + 1.0 && boxes[b][0][1] <= boxes[a][1][1] + 1.0 {
                each(a.min(b), a.max(b));
            }
        }
    }
}

/// `Less` where `a` lies behind `b`, `Equal` where it does not matter.
fn compare(mechanism: &Mechanism, a: &Item, b: &Item) -> Ordering {
    if a.part == Part::Link && b.part == Part::Link && a.link == b.link {
        let rods = matches!((a.solid, b.solid), (Solid::Rod { .. }, Solid::Rod { .. }));
        if rods {
            return Ordering::Equal;
        }
    }
    if let Some(order) = at_a_joint(mechanism, a, b) {
        return order;
    }
    if let Some(order) = at_a_joint(mechanism, b, a) {
        return order.reverse();
    }
    let ((core_a, radius_a), (core_b, radius_b)) = (a.solid.core(), b.solid.core());
    let (p, q, square) = closest(core_a, core_b);
    let reach = radius_a + radius_b;
    if square > (reach + 1.5) * (reach + 1.5) {
        return Ordering::Equal;
    }
    let between = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
    let apart = |at: [f64; 2]| a.solid.depth_at(at) - b.solid.depth_at(at);
    let mut difference = apart(between);
    if difference.abs() < EQUAL {
        // They meet there; elsewhere along them one may cover the other.
        for (end, core) in core_a
            .iter()
            .map(|end| (end, core_b))
            .chain(core_b.iter().map(|end| (end, core_a)))
        {
            let near = closest([*end; 2], core);
            if near.2 < reach * reach {
                let here = apart([end[0], end[1]]);
                if here.abs() > difference.abs() {
                    difference = here;
                }
            }
        }
    }
    if difference.abs() < EQUAL {
        Ordering::Equal
    } else {
        difference.total_cmp(&0.0)
    }
}

/// How the symbol of a joint lies to what it is mounted on: in front of the rods that end there, and between the halves of
/// its own axis. The order of `symbol` with respect to `other`.
fn at_a_joint(mechanism: &Mechanism, symbol: &Item, other: &Item) -> Option<Ordering> {
    let Part::Joint(index) = symbol.part else {
        return None;
    };
    match (other.part, other.solid) {
        (Part::Axis(of), Solid::Line { ends: [from, to] }) if of == index => {
            Some(from[2].total_cmp(&to[2]))
        }
        (Part::Joint(of), Solid::Rod { .. }) if of == index => Some(Ordering::Greater),
        (Part::Link, Solid::Rod { ends, radius }) => {
            let joint = mechanism.joints().get(index)?;
            if ![joint.predecessor.link.0, joint.successor.link.0].contains(&other.link) {
                return None;
            }
            let centre = symbol.solid.centre();
            let (_, size) = symbol.solid.core();
            let ends_here = |end: &[f64; 3]| norm(difference(*end, centre)) < radius + size;
            ends.iter().any(ends_here).then_some(Ordering::Greater)
        }
        _ => None,
    }
}
