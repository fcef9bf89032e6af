//! The two points of a hinge.

use super::nodes::{Nodes, same};
use super::{Exact3, cross, dot, minus};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::ExactPose;

/// A hinge between two bodies: its origin and axis in both.
#[derive(Debug)]
pub(super) struct Hinge {
    name: String,
    groups: [usize; 2],
    origins: [Exact3; 2],
    axes: [Exact3; 2],
}

impl Hinge {
    pub(super) fn new(
        name: &str,
        one: (usize, ExactPose),
        other: (usize, ExactPose),
        axes: [Exact3; 2],
    ) -> Self {
        Self {
            name: name.to_owned(),
            groups: [one.0, other.0],
            origins: [one.1.translation, other.1.translation],
            axes,
        }
    }

    fn at(&self, side: usize, along: &Number) -> Exact3 {
        [0, 1, 2].map(|i| &self.origins[side][i] + &(&self.axes[side][i] * along))
    }

    /// The power of two of lengths of the axis that is nearest to a size.
    fn end(&self, size: f64) -> Option<Number> {
        let axis = &self.axes[0];
        let length = dot(axis, axis).value().sqrt();
        let power = (size / length).log2().round().clamp(-40.0, 40.0);
        Number::from_f64(power.exp2())
    }

    /// How far along the axis a point of a side's body is, in lengths of the axis; `None` where it is not on it.
    fn along(&self, side: usize, point: &Exact3) -> Option<Number> {
        let way = minus(point, &self.origins[side]);
        let axis = &self.axes[side];
        let off = cross(axis, &way);
        if !off.iter().all(Number::is_zero) {
            return None;
        }
        dot(&way, axis).checked_div(&dot(axis, axis)).ok()
    }
}

/// Where two axes of one body meet, if they do in one point.
fn meeting(one: (&Exact3, &Exact3), other: (&Exact3, &Exact3)) -> Option<Exact3> {
    let (p, a) = one;
    let (q, b) = other;
    let normal = cross(a, b);
    let square = dot(&normal, &normal);
    let way = minus(q, p);
    if square.is_zero() || !dot(&way, &normal).is_zero() {
        return None;
    }
    // p + s a = q + t b: s = ((q − p) × b) · n / n².
    let s = dot(&cross(&way, b), &normal).checked_div(&square).ok()?;
    Some([0, 1, 2].map(|i| &p[i] + &(&a[i] * &s)))
}

/// Gives every hinge two points that its bodies share: those in which other joints are, then the joint's origin, then
/// the end of its axis. Of rounded numbers the end is taken about as far away as the mechanism is large: an axis is off by an angle, which
/// closer points would make more of.
pub(super) fn share_points(hinges: &[Hinge], nodes: &mut Nodes, size: Option<f64>) {
    for (index, hinge) in hinges.iter().enumerate() {
        for other in &hinges[..index] {
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                if hinge.groups[i] != other.groups[j] {
                    continue;
                }
                let here = (&hinge.origins[i], &hinge.axes[i]);
                let there = (&other.origins[j], &other.axes[j]);
                if let Some(point) = meeting(here, there) {
                    nodes.add(
                        hinge.groups[i],
                        point,
                        &format!("{}&{}", other.name, hinge.name),
                    );
                }
            }
        }
    }
    for hinge in hinges {
        // Most used first, so that two hinges of one corner take the same point.
        let mut candidates: Vec<(Number, usize)> = Vec::new();
        for side in [0, 1] {
            for node in 0..nodes.all.len() {
                if nodes.all[node].group != hinge.groups[side] {
                    continue;
                }
                let Some(along) = hinge.along(side, &nodes.all[node].at) else {
                    continue;
                };
                let uses = nodes.users(node);
                match candidates.iter_mut().find(|(known, _)| *known == along) {
                    Some((_, known)) => *known += uses,
                    None => candidates.push((along, uses)),
                }
            }
        }
        candidates.sort_by_key(|(_, uses)| std::cmp::Reverse(*uses));
        let mut chosen: Vec<Number> = candidates
            .into_iter()
            .map(|(along, _)| along)
            .take(2)
            .collect();
        let end = size.and_then(|size| hinge.end(size));
        for along in [Number::zero(), end.unwrap_or_else(Number::one)] {
            if chosen.len() < 2 && !chosen.contains(&along) {
                chosen.push(along);
            }
        }
        for (number, along) in chosen.iter().enumerate() {
            let name = format!("{}.{}", hinge.name, number + 1);
            let [a, b] = [0, 1].map(|side| {
                let at = hinge.at(side, along);
                nodes.add(hinge.groups[side], at, &name)
            });
            nodes.join(a, b);
        }
    }
    debug_assert!(nodes.all.iter().all(|n| same(&n.at, &n.at)));
}
