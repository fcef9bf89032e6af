//! Planes, cylinders and spheres among surfaces that are written in another way, by sampling and fitting.

use crate::shape::Surface;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

/// Samples along each parameter to which a surface is fitted, with their normals.
const STEPS: usize = 5;

/// Samples along each parameter on which the fitted surface has to be as well.
const FINE: usize = 12;

/// The largest distance of a sample from a fitted surface, by the size of the samples. Rational B-splines hold quadrics exactly:
/// what is left are the digits of control points and weights, six or more of which every writer gives.
const CLOSE: f64 = 1e-6;

/// The largest component of a normal along the axis of a cylinder. Normals come from differences of points over a thousandth of
/// the domain, whose error is of second order: 10⁻⁶; the fit decides with more digits.
const ACROSS: f64 = 1e-5;

/// A radius of so many sizes is no longer told from a plane.
const FLAT: f64 = 1e4;

/// The largest size (m) of a surface that is looked at: beyond it squares of squares may leave the range of numbers.
const FARTHEST: f64 = 1e9;

/// A surface by its parameters u and v.
pub(crate) type Chart<'c> = &'c dyn Fn(f64, f64) -> Vector3<f64>;

/// From where to where a parameter goes.
pub(crate) type Range = (f64, f64);

/// A surface that was recognised, and whether the normal of its parameters, ∂u × ∂v, points away from its axis or centre, or
/// along its normal.
pub(crate) type Recognised = (Surface, bool);

/// A point of a surface with the unit normal there.
struct Sample {
    point: Vector3<f64>,
    normal: Vector3<f64>,
}

/// The plane, cylinder or sphere that a surface is; `None` where it is none of them.
///
/// `accuracy` is how far points of the file may be off (m).
pub(crate) fn recognised(
    chart: Chart<'_>,
    u: Range,
    v: Range,
    accuracy: f64,
) -> Option<Recognised> {
    let samples = samples(chart, u, v)?;
    let count = samples.len() as f64;
    let centre = samples.iter().map(|s| s.point).sum::<Vector3<f64>>() / count;
    let size = samples
        .iter()
        .map(|s| (s.point - centre).norm())
        .fold(0.0, f64::max);
    if !(size > 0.0 && size < FARTHEST) {
        return None;
    }
    let close = (CLOSE * size).max(accuracy.min(1e-3 * size));
    let found = plane(&samples, centre, close)
        .or_else(|| cylinder(&samples, centre, size, close))
        .or_else(|| sphere(&samples, centre, size, close))?;
    for i in 0..FINE {
        for j in 0..FINE {
            let point = chart(part(u, i, FINE), part(v, j, FINE));
            if !(off(&found.0, point) <= close) {
                return None;
            }
        }
    }
    Some(found)
}

/// The value in the middle of a step of a range.
fn part(range: Range, step: usize, steps: usize) -> f64 {
    range.0 + (range.1 - range.0) * (step as f64 + 0.5) / steps as f64
}

/// How far a point is from a surface (m).
fn off(surface: &Surface, p: Vector3<f64>) -> f64 {
    match surface {
        Surface::Plane { point, normal } => (p - point).dot(normal).abs(),
        Surface::Cylinder {
            point,
            direction,
            radius,
        } => ((p - point).cross(direction).norm() - radius).abs(),
        Surface::Sphere { centre, radius } => ((p - centre).norm() - radius).abs(),
        Surface::Cone { .. } | Surface::Other(_) => f64::INFINITY,
    }
}

/// Points and normals in the middle of a grid of cells, where no seam and no pole is.
fn samples(chart: Chart<'_>, u: Range, v: Range) -> Option<Vec<Sample>> {
    let (wide, high) = (u.1 - u.0, v.1 - v.0);
    let (du, dv) = (wide * 5e-4, high * 5e-4);
    let mut samples = Vec::new();
    for i in 0..STEPS {
        for j in 0..STEPS {
            let (a, b) = (part(u, i, STEPS), part(v, j, STEPS));
            let along = chart(a + du, b) - chart(a - du, b);
            let across = chart(a, b + dv) - chart(a, b - dv);
            let normal = along.cross(&across);
            let length = normal.norm();
            let point = chart(a, b);
            if !(length > 0.0 && length.is_finite() && point.norm().is_finite()) {
                return None;
            }
            samples.push(Sample {
                point,
                normal: normal / length,
            });
        }
    }
    Some(samples)
}

/// The surface, where all samples are on it.
fn on_all(surface: Surface, samples: &[Sample], close: f64) -> Option<Surface> {
    let on = |s: &Sample| off(&surface, s.point) <= close;
    samples.iter().all(on).then_some(surface)
}

/// The direction in which a symmetric matrix is smallest.
fn smallest(matrix: Matrix3<f64>) -> Option<Vector3<f64>> {
    let eigen = matrix.symmetric_eigen();
    let column = eigen.eigenvalues.imin();
    let direction: Vector3<f64> = eigen.eigenvectors.column(column).into_owned();
    let length = direction.norm();
    (length > 0.0 && length.is_finite()).then(|| direction / length)
}

fn plane(samples: &[Sample], centre: Vector3<f64>, close: f64) -> Option<Recognised> {
    let spread = samples
        .iter()
        .map(|s| (s.point - centre) * (s.point - centre).transpose());
    let normal = smallest(spread.sum::<Matrix3<f64>>())?;
    let agrees = samples.iter().map(|s| s.normal.dot(&normal)).sum::<f64>() > 0.0;
    let surface = Surface::Plane {
        point: centre,
        normal,
    };
    on_all(surface, samples, close).map(|surface| (surface, agrees))
}

fn cylinder(samples: &[Sample], centre: Vector3<f64>, size: f64, close: f64) -> Option<Recognised> {
    let normals = samples.iter().map(|s| s.normal * s.normal.transpose());
    let direction = smallest(normals.sum::<Matrix3<f64>>())?;
    let leans = |s: &Sample| s.normal.dot(&direction).abs() > ACROSS;
    if samples.iter().any(leans) {
        return None;
    }
    let flat = |p: Vector3<f64>| p - centre - direction * direction.dot(&(p - centre));
    let (middle, radius) = ball(samples.iter().map(|s| flat(s.point)), size)?;
    let middle = middle - direction * direction.dot(&middle);
    let outward = |s: &Sample| s.normal.dot(&(flat(s.point) - middle));
    let agrees = samples.iter().map(outward).sum::<f64>() > 0.0;
    let surface = Surface::Cylinder {
        point: centre + middle,
        direction,
        radius,
    };
    on_all(surface, samples, close).map(|surface| (surface, agrees))
}

fn sphere(samples: &[Sample], centre: Vector3<f64>, size: f64, close: f64) -> Option<Recognised> {
    let (middle, radius) = ball(samples.iter().map(|s| s.point - centre), size)?;
    let middle = centre + middle;
    let outward = |s: &Sample| s.normal.dot(&(s.point - middle));
    let agrees = samples.iter().map(outward).sum::<f64>() > 0.0;
    let surface = Surface::Sphere {
        centre: middle,
        radius,
    };
    on_all(surface, samples, close).map(|surface| (surface, agrees))
}

/// The centre and radius for which |p|² − 2 c·p − k is least; of all such centres the one nearest the origin, so that points in
/// a plane give a circle. Lengths are taken by `size`.
fn ball(points: impl Iterator<Item = Vector3<f64>>, size: f64) -> Option<(Vector3<f64>, f64)> {
    let points: Vec<Vector3<f64>> = points.map(|p| p / size).collect();
    let rows = DMatrix::from_fn(points.len(), 4, |i, j| {
        let point = points.get(i).copied().unwrap_or_else(Vector3::zeros);
        if j < 3 { 2.0 * point[j] } else { 1.0 }
    });
    let squares = DVector::from_iterator(points.len(), points.iter().map(|p| p.norm_squared()));
    let solution = rows.svd(true, true).solve(&squares, 1e-9).ok()?;
    let middle = Vector3::new(*solution.get(0)?, *solution.get(1)?, *solution.get(2)?);
    let radius = (*solution.get(3)? + middle.norm_squared()).sqrt();
    (radius.is_finite() && radius > 0.0 && radius < FLAT).then(|| (middle * size, radius * size))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::{Surface, recognised};
    use nalgebra::Vector3;

    #[test]
    fn surfaces_are_what_they_are() {
        let shift = Vector3::new(0.3, -0.2, 1.0);
        let tube = |u: f64, v: f64| shift + Vector3::new(0.01 * u.cos(), 0.01 * u.sin(), v);
        let (surface, outward) = recognised(&tube, (0.0, 3.0), (0.0, 0.05), 0.0).unwrap();
        let Surface::Cylinder {
            point,
            direction,
            radius,
        } = surface
        else {
            panic!("{surface:?}");
        };
        assert!((radius - 0.01).abs() < 1e-9 && outward);
        assert!(direction.cross(&Vector3::z()).norm() < 1e-7);
        assert!((point - shift).cross(&Vector3::z()).norm() < 1e-9);

        let ball = |u: f64, v: f64| {
            shift + Vector3::new(u.cos() * v.cos(), u.sin() * v.cos(), v.sin()) * 0.02
        };
        // The other order of parameters: the normal points inward.
        let turned = |u: f64, v: f64| ball(v, u);
        let (surface, outward) = recognised(&turned, (-1.0, 1.0), (0.0, 6.0), 0.0).unwrap();
        let Surface::Sphere { centre, radius } = surface else {
            panic!("{surface:?}");
        };
        assert!((centre - shift).norm() < 1e-8 && (radius - 0.02).abs() < 1e-8 && !outward);

        let flat = |u: f64, v: f64| shift + Vector3::new(u, v, u + v);
        let found = recognised(&flat, (0.0, 1.0), (0.0, 1.0), 0.0).unwrap();
        assert!(matches!(found, (Surface::Plane { .. }, _)));

        let saddle = |u: f64, v: f64| Vector3::new(u, v, u * v);
        assert!(recognised(&saddle, (0.0, 1.0), (0.0, 1.0), 0.0).is_none());
        let ring = |u: f64, v: f64| {
            let r = 1.0 + 0.2 * v.cos();
            Vector3::new(r * u.cos(), r * u.sin(), 0.2 * v.sin())
        };
        assert!(recognised(&ring, (0.0, 6.0), (0.0, 6.0), 0.0).is_none());
    }
}
