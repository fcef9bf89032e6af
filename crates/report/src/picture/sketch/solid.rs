//! A solid seen from infinitely far: its outline on the page and its depth.

use crate::picture::vector::{Vector, cross, difference, dot, norm, sum, times, unit};

/// A solid in view coordinates: right, up, towards the eye.
#[derive(Clone, Copy, Debug)]
pub enum Solid {
    /// A rod with round ends.
    Rod { ends: [Vector; 2], radius: f64 },
    /// A ball.
    Ball { centre: Vector, radius: f64 },
    /// A cylinder with flat ends.
    Cylinder { ends: [Vector; 2], radius: f64 },
    /// A cuboid; the half edges make a right angle with each other.
    Cuboid { centre: Vector, halves: [Vector; 3] },
    /// A line without thickness.
    Line { ends: [Vector; 2] },
}

/// Twice this ratio of length to thickness and a cuboid is drawn as long.
const NO_LENGTH: f64 = 1e-9;

impl Solid {
    /// The solid after `f` on points; lengths are multiplied with `scale`, as `f` does.
    pub fn mapped(&self, scale: f64, f: impl Fn(Vector) -> Vector) -> Self {
        match *self {
            Self::Rod { ends, radius } => Self::Rod {
                ends: ends.map(&f),
                radius: radius * scale,
            },
            Self::Ball { centre, radius } => Self::Ball {
                centre: f(centre),
                radius: radius * scale,
            },
            Self::Cylinder { ends, radius } => Self::Cylinder {
                ends: ends.map(&f),
                radius: radius * scale,
            },
            Self::Cuboid { centre, halves } => Self::Cuboid {
                centre: f(centre),
                halves: halves.map(|h| times(h, scale)),
            },
            Self::Line { ends } => Self::Line { ends: ends.map(f) },
        }
    }

    /// A segment and a radius about it that cover the solid, roughly.
    pub fn core(&self) -> ([Vector; 2], f64) {
        match *self {
            Self::Rod { ends, radius } | Self::Cylinder { ends, radius } => (ends, radius),
            Self::Ball { centre, radius } => ([centre; 2], radius),
            Self::Line { ends } => (ends, 0.0),
            Self::Cuboid { centre, halves } => {
                let mut lengths: Vec<(f64, Vector)> =
                    halves.iter().map(|h| (norm(*h), *h)).collect();
                lengths.sort_by(|a, b| b.0.total_cmp(&a.0));
                let along = times(
                    lengths[0].1,
                    1.0 - lengths[1].0 / lengths[0].0.max(NO_LENGTH),
                );
                (
                    [difference(centre, along), sum(centre, along)],
                    lengths[1].0,
                )
            }
        }
    }

    /// Middle of the solid.
    pub fn centre(&self) -> Vector {
        let ([a, b], _) = self.core();
        times(sum(a, b), 0.5)
    }

    /// Least and greatest coordinates on the page.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        let (points, radius) = match *self {
            Self::Cuboid { centre, halves } => (corners(centre, halves).to_vec(), 0.0),
            Self::Rod { ends, radius } | Self::Cylinder { ends, radius } => (ends.to_vec(), radius),
            Self::Ball { centre, radius } => (vec![centre], radius),
            Self::Line { ends } => (ends.to_vec(), 0.0),
        };
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for point in points {
            for i in 0..2 {
                bounds[0][i] = bounds[0][i].min(point[i] - radius);
                bounds[1][i] = bounds[1][i].max(point[i] + radius);
            }
        }
        bounds
    }

    /// Depth of the surface that is seen at a place of the page on or near the solid.
    pub fn depth_at(&self, at: [f64; 2]) -> f64 {
        match *self {
            Self::Cuboid { centre, halves } => cuboid_depth(centre, halves, at),
            Self::Ball { centre, radius } => centre[2] + radius,
            Self::Line { ends } => segment_depth(ends, 0.0, at),
            Self::Rod { ends, radius } | Self::Cylinder { ends, radius } => {
                radius + segment_depth(ends, radius, at)
            }
        }
    }
}

/// The greatest depth of the part of a segment that is within `reach` of a place on the page.
fn segment_depth([a, b]: [Vector; 2], reach: f64, at: [f64; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let square = way[0] * way[0] + way[1] * way[1];
    let depth = |t: f64| a[2] + t.clamp(0.0, 1.0) * (b[2] - a[2]);
    let length = square.sqrt();
    if !(length > 0.05 * reach && length > 0.0) {
        return a[2].max(b[2]);
    }
    let t = ((at[0] - a[0]) * way[0] + (at[1] - a[1]) * way[1]) / square;
    // Half the reach: what lies right beside the place, not what merely touches it.
    let slack = 0.5 * reach / length;
    depth(t - slack).max(depth(t + slack))
}

/// Where the ray through a place of the page enters a cuboid; at its middle's depth where it does not.
fn cuboid_depth(centre: Vector, halves: [Vector; 3], at: [f64; 2]) -> f64 {
    let start = [at[0] - centre[0], at[1] - centre[1], 0.0];
    let (mut enters, mut leaves) = (f64::INFINITY, f64::NEG_INFINITY);
    for half in halves {
        let square = dot(half, half);
        if !(square > 0.0) {
            continue;
        }
        // |start·half + z half_z| ≤ |half|²
        let (offset, slope) = (dot(start, half), half[2]);
        if slope.abs() < 1e-9 * square.sqrt() {
            if offset.abs() > square * (1.0 + 1e-9) {
                return centre[2];
            }
            continue;
        }
        let one = (square - offset) / slope;
        let other = (-square - offset) / slope;
        enters = enters.min(one.max(other));
        leaves = leaves.max(one.min(other));
    }
    if leaves <= enters && enters.is_finite() {
        centre[2] + enters
    } else {
        centre[2]
    }
}

/// All corners of a cuboid.
fn corners(centre: Vector, halves: [Vector; 3]) -> [Vector; 8] {
    std::array::from_fn(|i| {
        (0..3).fold(centre, |corner, axis| {
            let sign = if i >> axis & 1 == 1 { 1.0 } else { -1.0 };
            sum(corner, times(halves[axis], sign))
        })
    })
}

/// A face of a cuboid that is seen: its corners around, and its outward normal.
pub fn faces(centre: Vector, halves: [Vector; 3]) -> Vec<([Vector; 4], Vector)> {
    let mut faces = Vec::new();
    for axis in 0..3 {
        let (half, u, v) = (halves[axis], halves[(axis + 1) % 3], halves[(axis + 2) % 3]);
        let Some(normal) = unit(half).or_else(|| unit(cross(u, v))) else {
            continue;
        };
        // Edge-on faces are lines, which the faces beside them draw.
        if normal[2].abs() < 0.02 {
            continue;
        }
        let sign = normal[2].signum();
        let middle = sum(centre, times(half, sign));
        let corner = |a: f64, b: f64| sum(middle, sum(times(u, a), times(v, b)));
        faces.push((
            [
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
            ],
            times(normal, sign),
        ));
    }
    faces
}

/// The closest points of two segments of the page, and the square of their distance.
pub fn closest(a: [Vector; 2], b: [Vector; 2]) -> ([f64; 2], [f64; 2], f64) {
    let flat = |p: Vector| [p[0], p[1]];
    let ([a0, a1], [b0, b1]) = (a.map(flat), b.map(flat));
    let minus = |p: [f64; 2], q: [f64; 2]| [p[0] - q[0], p[1] - q[1]];
    let times2 = |p: [f64; 2], q: [f64; 2]| p[0] * q[0] + p[1] * q[1];
    let (u, v, w) = (minus(a1, a0), minus(b1, b0), minus(a0, b0));
    // Where they cross.
    let turn = u[0] * v[1] - u[1] * v[0];
    if turn.abs() > 1e-12 * (times2(u, u) * times2(v, v)).sqrt() {
        let s = (v[0] * w[1] - v[1] * w[0]) / turn;
        let t = (u[0] * w[1] - u[1] * w[0]) / turn;
        if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
            let point = [a0[0] + s * u[0], a0[1] + s * u[1]];
            return (point, point, 0.0);
        }
    }
    // Otherwise an end of one is closest.
    let onto = |p: [f64; 2], from: [f64; 2], way: [f64; 2]| {
        let square = times2(way, way);
        let t = if square > 0.0 {
            (times2(minus(p, from), way) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        [from[0] + t * way[0], from[1] + t * way[1]]
    };
    let pairs = [
        (a0, onto(a0, b0, v)),
        (a1, onto(a1, b0, v)),
        (onto(b0, a0, u), b0),
        (onto(b1, a0, u), b1),
    ];
    let mut best = (pairs[0].0, pairs[0].1, f64::INFINITY);
    for (p, q) in pairs {
        let d = minus(p, q);
        let square = times2(d, d);
        if square < best.2 {
            best = (p, q, square);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cuboid_is_as_deep_as_its_front() {
        let halves = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
        let cuboid = Solid::Cuboid {
            centre: [0.0, 0.0, 10.0],
            halves,
        };
        assert_eq!(cuboid.depth_at([0.5, -1.5]), 13.0);
        assert_eq!(cuboid.depth_at([5.0, 0.0]), 10.0);
        assert_eq!(cuboid.bounds(), [[-1.0, -2.0], [1.0, 2.0]]);
        assert_eq!(faces([0.0; 3], halves).len(), 1);
    }

    #[test]
    fn a_slanted_rod_is_as_deep_as_where_it_is_met() {
        let rod = Solid::Rod {
            ends: [[0.0, 0.0, 0.0], [10.0, 0.0, 10.0]],
            radius: 0.1,
        };
        assert!((rod.depth_at([5.0, 0.0]) - 5.15).abs() < 1e-12);
        let end_on = Solid::Cylinder {
            ends: [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]],
            radius: 0.5,
        };
        assert_eq!(end_on.depth_at([0.3, 0.0]), 1.5);
    }

    #[test]
    fn segments_meet_where_they_cross() {
        let a = [[0.0, 0.0, 5.0], [2.0, 2.0, 5.0]];
        let b = [[0.0, 2.0, 0.0], [2.0, 0.0, 0.0]];
        assert_eq!(closest(a, b), ([1.0, 1.0], [1.0, 1.0], 0.0));
        let c = [[3.0, 0.0, 0.0], [3.0, 4.0, 0.0]];
        assert_eq!(closest(a, c), ([2.0, 2.0], [3.0, 2.0], 1.0));
        assert_eq!(closest([[1.0, 1.0, 0.0]; 2], [[1.0, 3.0, 0.0]; 2]).2, 4.0);
    }
}
