//! The plane that a path is drawn in.

use crate::picture::vector::{Vector, cross, difference, dot, sum, times, unit};
use crate::picture::view::facing;
use crate::text::words::figure;
use nalgebra::{Matrix3, Vector3};

/// A path lies in a plane where it leaves it by no more than this share of its size: rounding, and closures of 1e-12.
const FLAT: f64 = 1e-9;

/// A plane with two axes at right angles, seen so that `across` points to the right.
pub(super) struct Plane {
    axes: [Vector; 2],
    /// What the axes are called: `x`, or their direction in the world.
    pub names: [String; 2],
    /// The greatest distance of a point from the plane through the centroid (m); `None` where all lie in it.
    pub off: Option<f64>,
}

impl Plane {
    /// The plane of a path: a coordinate plane where that contains it, otherwise the best in the sense of least squares; for a
    /// skew straight line, one of the planes through it.
    pub fn of(path: &[Vector]) -> Self {
        let share = 1.0 / path.len().max(1) as f64;
        let centre = path
            .iter()
            .fold([0.0; 3], |total, p| sum(total, times(*p, share)));
        let off = |normal: Vector| {
            let distances = path.iter().map(|p| dot(normal, difference(*p, centre)));
            distances.fold(0.0, |most: f64, d| most.max(d.abs()))
        };
        let frame = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let reach = frame.map(off).into_iter().fold(0.0, f64::max);
        let [x, y, z] = frame;
        // Seen from above, from the front, from the right.
        for (normal, axes) in [(z, [x, y]), (y, [x, z]), (x, [y, z])] {
            if off(normal) <= FLAT * reach {
                return Self::with(axes, None);
            }
        }
        let normal = facing(least_spread(path, centre, reach));
        let upward = if normal[2].abs() > 0.999 { y } else { z };
        let up = difference(upward, times(normal, dot(upward, normal)));
        let up = unit(up).unwrap_or(upward);
        let distance = off(normal);
        Self::with(
            [cross(up, normal), up],
            (distance > FLAT * reach).then_some(distance),
        )
    }

    /// Coordinates along the axes, from the origin of the world.
    pub fn project(&self, point: &Vector) -> [f64; 2] {
        self.axes.map(|axis| dot(axis, *point))
    }

    fn with(axes: [Vector; 2], off: Option<f64>) -> Self {
        Self {
            names: axes.map(named),
            axes,
            off,
        }
    }
}

/// `x`, or `0.8 x − 0.6 z`.
fn named(axis: Vector) -> String {
    let mut name = String::new();
    for (part, letter) in axis.into_iter().zip(["x", "y", "z"]) {
        let size = figure(part.abs());
        // Less than the last digit shown.
        if part.abs() < 5e-4 {
            continue;
        }
        name.push_str(match (name.is_empty(), part < 0.0) {
            (true, false) => "",
            (true, true) => "\u{2212}",
            (false, false) => " + ",
            (false, true) => " \u{2212} ",
        });
        if size != "1" {
            name.push_str(&size);
            name.push(' ');
        }
        name.push_str(letter);
    }
    name
}

/// The direction in which the points are spread least: the eigenvector of the least eigenvalue of their covariance.
fn least_spread(path: &[Vector], centre: Vector, reach: f64) -> Vector {
    let mut covariance = Matrix3::zeros();
    for point in path {
        let [x, y, z] = times(difference(*point, centre), 1.0 / reach);
        let d = Vector3::new(x, y, z);
        covariance += d * d.transpose();
    }
    let eigen = covariance.symmetric_eigen();
    let least = eigen.eigenvalues.imin();
    let v = eigen.eigenvectors.column(least);
    unit([v[0], v[1], v[2]]).unwrap_or([0.0, 0.0, 1.0])
}
