//! Boxes around faces and parts, and which of them meet.

use crate::shape::{Face, Surface};
use nalgebra::Vector3;

/// Curved bounds are taken in steps of 15 degrees: between them a circle leaves its chord by 1 − cos(7.5°) of its radius.
const SAGITTA: f64 = 0.01;

/// A box along the axes of the world (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    low: Vector3<f64>,
    high: Vector3<f64>,
}

impl Bounds {
    /// The box around a face; `None` where nothing bounds it, or its surface makes no contact.
    pub fn of_face(face: &Face) -> Option<Self> {
        let outline = || {
            let mut points = face.outline.iter().flatten();
            let first = *points.next()?;
            let start = Self {
                low: first,
                high: first,
            };
            Some(points.fold(start, |bounds, p| Self {
                low: bounds.low.inf(p),
                high: bounds.high.sup(p),
            }))
        };
        match &face.surface {
            Surface::Plane { .. } => outline(),
            Surface::Cylinder { radius, .. } => Some(outline()?.grown(radius * SAGITTA)),
            Surface::Cone {
                apex,
                direction,
                half_angle,
            } => {
                let radius = face.extent.1.abs() * half_angle.tan();
                let bounds = outline()?.grown(radius * SAGITTA);
                // The apex, where it belongs to the face, is no corner of its outline.
                let tip = apex + direction * face.extent.0;
                Some(Self {
                    low: bounds.low.inf(&tip),
                    high: bounds.high.sup(&tip),
                })
            }
            Surface::Sphere { centre, radius } => {
                let point = Self {
                    low: *centre,
                    high: *centre,
                };
                Some(point.grown(*radius))
            }
            Surface::Other(_) => None,
        }
    }

    /// The box around both.
    pub fn union(self, other: Self) -> Self {
        Self {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
        }
    }

    /// A box that is larger by so much (m) on every side.
    pub fn grown(self, margin: f64) -> Self {
        let margin = Vector3::repeat(margin);
        Self {
            low: self.low - margin,
            high: self.high + margin,
        }
    }

    /// True where two boxes have a point in common.
    pub fn meets(&self, other: &Self) -> bool {
        (0..3).all(|i| self.low[i] <= other.high[i] && other.low[i] <= self.high[i])
    }
}

/// The pairs of boxes that meet, in ascending order; the first of each pair is the smaller one. A sweep along the direction in
/// which the boxes are spread most: each is compared with those only that are open when it begins.
pub(super) fn touching(boxes: &[Option<Bounds>]) -> Vec<(usize, usize)> {
    let mut order: Vec<(usize, Bounds)> = boxes
        .iter()
        .enumerate()
        .filter_map(|(place, bounds)| bounds.map(|bounds| (place, bounds)))
        .collect();
    let Some((_, first)) = order.first() else {
        return Vec::new();
    };
    let whole = order.iter().fold(*first, |all, (_, b)| all.union(*b));
    let axis = (whole.high - whole.low).imax();
    order.sort_by(|(_, a), (_, b)| a.low[axis].total_cmp(&b.low[axis]));
    let mut open: Vec<(usize, Bounds)> = Vec::new();
    let mut pairs = Vec::new();
    for (place, bounds) in order {
        open.retain(|(_, other)| other.high[axis] >= bounds.low[axis]);
        for (other, _) in open.iter().filter(|(_, other)| other.meets(&bounds)) {
            pairs.push((place.min(*other), place.max(*other)));
        }
        open.push((place, bounds));
    }
    pairs.sort_unstable();
    pairs
}

/// The pairs of a box of one list and one of another that meet, in ascending order. A sweep as in [`touching`].
pub(super) fn meeting(first: &[Bounds], second: &[Bounds]) -> Vec<(usize, usize)> {
    let mut boxes = first.iter().chain(second);
    let Some(whole) = boxes.next().copied() else {
        return Vec::new();
    };
    let whole = boxes.fold(whole, |all, b| all.union(*b));
    let axis = (whole.high - whole.low).imax();
    let of = |is_first: bool, boxes: &[Bounds]| -> Vec<(bool, usize, Bounds)> {
        let placed = boxes.iter().copied().enumerate();
        placed.map(|(place, b)| (is_first, place, b)).collect()
    };
    let mut order = [of(true, first), of(false, second)].concat();
    order.sort_by(|(.., a), (.., b)| a.low[axis].total_cmp(&b.low[axis]));
    let mut open_first: Vec<(usize, Bounds)> = Vec::new();
    let mut open_second = Vec::new();
    let mut pairs = Vec::new();
    for (is_first, place, bounds) in order {
        let (own, others) = match is_first {
            true => (&mut open_first, &mut open_second),
            false => (&mut open_second, &mut open_first),
        };
        others.retain(|(_, other)| other.high[axis] >= bounds.low[axis]);
        for (other, _) in others.iter().filter(|(_, other)| other.meets(&bounds)) {
            pairs.push(match is_first {
                true => (place, *other),
                false => (*other, place),
            });
        }
        own.push((place, bounds));
    }
    pairs.sort_unstable();
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_finds_what_all_pairs_find() {
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 40) as f64 / (1_u64 << 24) as f64
        };
        let boxes: Vec<Option<Bounds>> = (0..200)
            .map(|i| {
                let low = Vector3::new(random() * 4.0, random(), random());
                let high = low + Vector3::new(random(), random(), random()) * 0.3;
                (i % 17 != 0).then_some(Bounds { low, high })
            })
            .collect();
        let mut all = Vec::new();
        for (i, a) in boxes.iter().enumerate() {
            for (j, b) in boxes.iter().enumerate().skip(i + 1) {
                if let (Some(a), Some(b)) = (a, b)
                    && a.meets(b)
                {
                    all.push((i, j));
                }
            }
        }
        assert!(all.len() > 20);
        assert_eq!(touching(&boxes), all);

        let (first, second) = boxes.split_at(80);
        let some = |boxes: &[Option<Bounds>]| boxes.iter().flatten().copied().collect::<Vec<_>>();
        let (first, second) = (some(first), some(second));
        let mut all = Vec::new();
        for (i, a) in first.iter().enumerate() {
            let own = second.iter().enumerate().filter(|(_, b)| a.meets(b));
            all.extend(own.map(|(j, _)| (i, j)));
        }
        assert!(all.len() > 10);
        assert_eq!(meeting(&first, &second), all);
        assert!(meeting(&[], &second).is_empty() && meeting(&[], &[]).is_empty());
    }
}
