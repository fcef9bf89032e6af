//! The common area of two faces in one plane.

use nalgebra::{Vector2, Vector3};

/// The most levels at which the area is measured. With fewer corners and crossings than that it is exact.
const MOST_LEVELS: usize = 2000;

/// The most pairs of edges that are tried for crossings.
const MOST_CROSSINGS: usize = 4_000_000;

/// From one corner to the next.
type Edge = (Vector2<f64>, Vector2<f64>);

/// Polygons in a plane; what is inside an odd number of them counts.
pub(super) struct Flat {
    /// In ascending order of their lower ends.
    edges: Vec<Edge>,
    low: Vector2<f64>,
    high: Vector2<f64>,
}

/// A plane with coordinates.
pub(super) struct Chart {
    origin: Vector3<f64>,
    x: Vector3<f64>,
    y: Vector3<f64>,
}

impl Chart {
    /// Coordinates in the plane through `origin` with this unit normal.
    pub fn new(origin: Vector3<f64>, normal: Vector3<f64>) -> Self {
        let helper = Vector3::ith((normal.iamax() + 1) % 3, 1.0);
        let x = (helper - normal * normal.dot(&helper)).normalize();
        let y = normal.cross(&x);
        Self { origin, x, y }
    }

    /// The point of these coordinates.
    pub fn point(&self, at: Vector2<f64>) -> Vector3<f64> {
        self.origin + self.x * at.x + self.y * at.y
    }

    /// Polygons projected on the plane; `None` where they have no area's worth of corners.
    pub fn flat(&self, outline: &[Vec<Vector3<f64>>]) -> Option<Flat> {
        let project = |p: &Vector3<f64>| {
            let from = p - self.origin;
            Vector2::new(from.dot(&self.x), from.dot(&self.y))
        };
        let mut edges = Vec::new();
        for polygon in outline.iter().filter(|polygon| polygon.len() > 2) {
            let following = polygon.iter().cycle().skip(1);
            for (from, to) in polygon.iter().zip(following) {
                edges.push((project(from), project(to)));
            }
        }
        let first = edges.first()?.0;
        let (low, high) = edges.iter().fold((first, first), |(low, high), (p, _)| {
            (low.inf(p), high.sup(p))
        });
        edges.sort_by(|(a, b), (p, q)| a.y.min(b.y).total_cmp(&p.y.min(q.y)));
        Some(Flat { edges, low, high })
    }
}

/// What two faces have in common.
pub(super) struct Common {
    /// Its area (m²).
    pub area: f64,
    /// Its centroid, as exact as the levels are close.
    pub centroid: Vector2<f64>,
    /// The diagonal of the box around it (m): the area by this is how wide a strip is.
    pub length: f64,
}

/// The area that two faces have in common; `None` where there is none.
pub(super) fn common(a: &Flat, b: &Flat) -> Option<Common> {
    let (low, high) = (a.low.sup(&b.low), a.high.inf(&b.high));
    if !(low.x < high.x && low.y < high.y) {
        return None;
    }
    let levels = levels(a, b, low, high);
    let (mut area, mut moment) = (0.0, Vector2::zeros());
    let (mut least, mut most) = (high, low);
    let (mut one, mut two) = (Sweep::over(a), Sweep::over(b));
    for pair in levels.windows(2) {
        let &[from, to] = pair else {
            continue;
        };
        let (middle, height) = ((from + to) / 2.0, to - from);
        if !(height > 0.0) {
            continue;
        }
        for (left, right) in shared(&one.spans(middle), &two.spans(middle)) {
            let piece = (right - left) * height;
            area += piece;
            least = least.inf(&Vector2::new(left, from));
            most = most.sup(&Vector2::new(right, to));
            moment += Vector2::new((left + right) / 2.0, middle) * piece;
        }
    }
    (area > 0.0).then(|| Common {
        area,
        centroid: moment / area,
        length: (most - least).norm(),
    })
}

/// The heights between which no corner and no crossing lies: there the common width is linear, and its middle gives the area.
fn levels(a: &Flat, b: &Flat, low: Vector2<f64>, high: Vector2<f64>) -> Vec<f64> {
    let inside = |y: &f64| *y > low.y && *y < high.y;
    let corners = a.edges.iter().chain(&b.edges).map(|(p, _)| p.y);
    let mut levels: Vec<f64> = corners.filter(inside).collect();
    let near = |flat: &Flat| -> Vec<Edge> {
        let meets = |(p, q): &&Edge| {
            let (least, most) = (p.inf(q), p.sup(q));
            least.x <= high.x && most.x >= low.x && least.y <= high.y && most.y >= low.y
        };
        flat.edges.iter().filter(meets).copied().collect()
    };
    let (one, two) = (near(a), near(b));
    let few = one.len().saturating_mul(two.len()) <= MOST_CROSSINGS;
    if few {
        for e in &one {
            levels.extend(two.iter().filter_map(|f| crossing(e, f)).filter(inside));
        }
    }
    if !few || levels.len() > MOST_LEVELS {
        let step = (high.y - low.y) / MOST_LEVELS as f64;
        levels = (1..MOST_LEVELS).map(|i| low.y + step * i as f64).collect();
    }
    levels.extend([low.y, high.y]);
    levels.sort_by(f64::total_cmp);
    levels
}

/// The height at which two edges cross.
fn crossing(e: &Edge, f: &Edge) -> Option<f64> {
    let (d, g) = (e.1 - e.0, f.1 - f.0);
    let across = d.perp(&g);
    if across == 0.0 {
        return None;
    }
    let between = f.0 - e.0;
    let (s, t) = (between.perp(&g) / across, between.perp(&d) / across);
    let on = |share: f64| (0.0..=1.0).contains(&share);
    (on(s) && on(t)).then(|| e.0.y + d.y * s)
}

/// Levels one above the other, and the edges that cross them: each edge is looked at while it does, however many there are.
struct Sweep<'f> {
    left: &'f [Edge],
    open: Vec<&'f Edge>,
}

impl<'f> Sweep<'f> {
    fn over(flat: &'f Flat) -> Self {
        Self {
            left: &flat.edges,
            open: Vec::new(),
        }
    }

    /// From where to where a level is inside; levels are asked for in ascending order.
    fn spans(&mut self, level: f64) -> Vec<(f64, f64)> {
        while let Some((edge, left)) = self.left.split_first()
            && edge.0.y.min(edge.1.y) <= level
        {
            self.open.push(edge);
            self.left = left;
        }
        self.open.retain(|(p, q)| p.y.max(q.y) > level);
        let cuts = self
            .open
            .iter()
            .map(|(p, q)| p.x + (q.x - p.x) * (level - p.y) / (q.y - p.y));
        let mut cuts: Vec<f64> = cuts.collect();
        cuts.sort_by(f64::total_cmp);
        cuts.chunks_exact(2)
            .filter_map(|pair| match pair {
                &[left, right] => Some((left, right)),
                _ => None,
            })
            .collect()
    }
}

/// What two lists of spans have in common. Both are in order.
fn shared(a: &[(f64, f64)], b: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let (mut one, mut two) = (a.iter().peekable(), b.iter().peekable());
    let mut out = Vec::new();
    while let (Some(s), Some(t)) = (one.peek(), two.peek()) {
        let (left, right) = (s.0.max(t.0), s.1.min(t.1));
        if left < right {
            out.push((left, right));
        }
        if s.1 < t.1 {
            one.next();
        } else {
            two.next();
        }
    }
    out
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, size: f64) -> Vec<Vector3<f64>> {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(a, b)| Vector3::new(x + a * size, y + b * size, 0.0))
            .to_vec()
    }

    fn area(a: &[Vec<Vector3<f64>>], b: &[Vec<Vector3<f64>>]) -> f64 {
        let chart = Chart::new(Vector3::zeros(), Vector3::z());
        let (a, b) = (chart.flat(a).unwrap(), chart.flat(b).unwrap());
        common(&a, &b).map_or(0.0, |common| common.area)
    }

    #[test]
    fn areas_are_those_of_the_common_part() {
        let plate = [square(0.0, 0.0, 4.0), square(1.0, 1.0, 2.0)];
        for (other, expected) in [
            (square(0.0, 0.0, 4.0), 12.0),
            (square(1.0, 1.0, 2.0), 0.0),
            (square(1.5, 1.5, 1.0), 0.0),
            (square(0.5, 0.5, 1.0), 0.75),
            (square(4.0, 0.0, 2.0), 0.0),
            (square(3.0, -1.0, 2.0), 1.0),
        ] {
            let found = area(&plate, std::slice::from_ref(&other));
            assert!((found - expected).abs() < 1e-12, "{other:?}: {found}");
        }
        // A square that stands on its corner: no corner of either is in the other.
        let diamond = [(2.0, -1.0), (5.0, 2.0), (2.0, 5.0), (-1.0, 2.0)]
            .map(|(x, y)| Vector3::new(x, y, 0.0))
            .to_vec();
        let found = area(&[square(0.0, 0.0, 4.0)], &[diamond]);
        assert!((found - 14.0).abs() < 1e-12, "{found}");
    }
}
