//! Planes, cylinders, cones and spheres among surfaces that are written in another way, by sampling and fitting.
//!
//! Fits are closed formulas of three unknowns. Iterative decompositions of the same sums stop short where a few numbers occur again and
//! again, as the coordinates of a half cylinder about an axis of coordinates do.

use crate::shape::Surface;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::FRAC_PI_2;

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

/// The plane, cylinder, sphere or cone that a surface is; `None` where it is none of them.
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
        .or_else(|| sphere(&samples, centre, size, close))
        .or_else(|| cone(&samples, centre, size, close))?;
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
        Surface::Cone {
            apex,
            direction,
            half_angle,
        } => {
            let (away, along) = (
                (p - apex).cross(direction).norm(),
                (p - apex).dot(direction),
            );
            (away * half_angle.cos() - along * half_angle.sin()).abs()
        }
        Surface::Other(_) => f64::INFINITY,
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

/// The direction in which a sum of squares, a symmetric matrix, is smallest: that across both others, which is the largest of the cross
/// products of its rows. It is off by as much of a right angle as the smallest value is of the middle one. `None` where more than one is
/// zero.
fn smallest(matrix: Matrix3<f64>) -> Option<Vector3<f64>> {
    let largest = matrix.amax();
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let row = |place: usize| matrix.row(place).transpose() / largest;
    let products = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| row(i).cross(&row(j)));
    let longest = products
        .into_iter()
        .max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    longest.try_normalize(f64::EPSILON)
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
    let (middle, radius) = ball(samples.iter().map(|s| flat(s.point)), size, Some(direction))?;
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
    let (middle, radius) = ball(samples.iter().map(|s| s.point - centre), size, None)?;
    let middle = centre + middle;
    let outward = |s: &Sample| s.normal.dot(&(s.point - middle));
    let agrees = samples.iter().map(outward).sum::<f64>() > 0.0;
    let surface = Surface::Sphere {
        centre: middle,
        radius,
    };
    on_all(surface, samples, close).map(|surface| (surface, agrees))
}

/// All normals of a cone are as steep to its axis, and all planes that touch it pass its apex.
fn cone(samples: &[Sample], centre: Vector3<f64>, size: f64, close: f64) -> Option<Recognised> {
    let count = samples.len() as f64;
    let mean = samples.iter().map(|s| s.normal).sum::<Vector3<f64>>() / count;
    let spread = samples
        .iter()
        .map(|s| (s.normal - mean) * (s.normal - mean).transpose());
    let axis = smallest(spread.sum::<Matrix3<f64>>())?;
    let touching = samples.iter().map(|s| s.normal * s.normal.transpose());
    let heights = samples
        .iter()
        .map(|s| s.normal * s.normal.dot(&(s.point - centre)));
    let solved = touching.sum::<Matrix3<f64>>().cholesky()?;
    let from_centre = solved.solve(&heights.sum::<Vector3<f64>>());
    if !(from_centre.norm() < FLAT * size) {
        return None;
    }
    let apex = centre + from_centre;
    // From the apex to where it is wide.
    let direction = axis * -axis.dot(&from_centre).signum();
    let steepness = mean.dot(&direction);
    let half_angle = steepness.abs().asin();
    if !(half_angle > CLOSE && half_angle < FRAC_PI_2 - CLOSE) {
        return None;
    }
    let surface = Surface::Cone {
        apex,
        direction,
        half_angle,
    };
    // Away from the axis the normal of a cone that opens upwards points down.
    on_all(surface, samples, close).map(|surface| (surface, steepness < 0.0))
}

/// The centre and radius for which |p|² − 2 c·p − k is least; of points in a plane across `axis` those of a circle, in the plane of the
/// origin. Lengths are taken by `size`.
fn ball(
    points: impl Iterator<Item = Vector3<f64>>,
    size: f64,
    axis: Option<Vector3<f64>>,
) -> Option<(Vector3<f64>, f64)> {
    let points: Vec<Vector3<f64>> = points.map(|p| p / size).collect();
    let count = points.len() as f64;
    // About the mean of the points k is what their squares are on the average.
    let mean = points.iter().copied().sum::<Vector3<f64>>() / count;
    let arms = || points.iter().map(|p| p - mean);
    let mut spread = arms()
        .map(|arm| arm * arm.transpose())
        .sum::<Matrix3<f64>>();
    if let Some(axis) = axis {
        // Nothing is known along the axis: zero is taken.
        spread += axis * axis.transpose() * count;
    }
    let pull = arms().map(|arm| arm * arm.norm_squared());
    let arm = spread.cholesky()?.solve(&pull.sum::<Vector3<f64>>()) / 2.0;
    let squares = arms().map(|arm| arm.norm_squared()).sum::<f64>() / count;
    let radius = (squares + arm.norm_squared()).sqrt();
    (radius > 0.0 && radius < FLAT).then(|| ((mean + arm) * size, radius * size))
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

        // A countersink, drawn from its wide end down to its narrow one.
        let sunk = |u: f64, v: f64| {
            let r = 0.006 - v;
            shift + Vector3::new(r * u.cos(), r * u.sin(), 0.5 * v)
        };
        let (surface, outward) = recognised(&sunk, (0.0, 6.0), (0.0, 0.004), 0.0).unwrap();
        let Surface::Cone {
            apex,
            direction,
            half_angle,
        } = surface
        else {
            panic!("{surface:?}");
        };
        assert!((apex - shift - Vector3::new(0.0, 0.0, 0.003)).norm() < 1e-8);
        assert!((direction + Vector3::z()).norm() < 1e-7 && outward);
        assert!((half_angle.tan() - 2.0).abs() < 1e-6);
        let back = |u: f64, v: f64| sunk(-u, v);
        let (_, outward) = recognised(&back, (0.0, 6.0), (0.0, 0.004), 0.0).unwrap();
        assert!(!outward);

        let saddle = |u: f64, v: f64| Vector3::new(u, v, u * v);
        assert!(recognised(&saddle, (0.0, 1.0), (0.0, 1.0), 0.0).is_none());
        let ring = |u: f64, v: f64| {
            let r = 1.0 + 0.2 * v.cos();
            Vector3::new(r * u.cos(), r * u.sin(), 0.2 * v.sin())
        };
        assert!(recognised(&ring, (0.0, 6.0), (0.0, 6.0), 0.0).is_none());
    }

    /// Half cylinders about axes of coordinates, as rational curves of degree three with their weights in eleven digits: of 28 in one file an
    /// iterative decomposition missed six, and others where a digit was changed.
    #[test]
    fn half_cylinders_of_few_different_numbers_are_found() {
        for case in 0..400_u32 {
            let radius = f64::from(case % 20 + 1) * 0.5;
            let height = f64::from(case / 20 % 5 + 1) * 1.5;
            let (x, y) = (f64::from(case % 7) * 2.5, f64::from(case % 3) * 7.5);
            let sign = if case % 2 == 0 { 1.0 } else { -1.0 };
            let weights = [1.0, 0.333_333_333_33, 0.333_333_333_33, 1.0];
            let corners = [
                (-radius, 0.0),
                (-radius, 2.0 * radius),
                (radius, 2.0 * radius),
                (radius, 0.0),
            ];
            let axis = case as usize % 3;
            let half = |u: f64, v: f64| {
                let t = v / 30.0;
                let s = 1.0 - t;
                let basis = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
                let (mut sum, mut share) = ([0.0; 2], 0.0);
                for ((corner, weight), value) in corners.iter().zip(weights).zip(basis) {
                    sum[0] += (x + sign * corner.0) * weight * value;
                    sum[1] += (y + sign * corner.1) * weight * value;
                    share += weight * value;
                }
                let mut point = [0.0; 3];
                point[axis] = height * (1.0 - u);
                point[(axis + 1) % 3] = sum[0] / share;
                point[(axis + 2) % 3] = sum[1] / share;
                Vector3::from(point) / 1000.0
            };
            let found = recognised(&half, (0.0, 1.0), (0.0, 30.0), 0.0);
            let Some((Surface::Cylinder { radius: own, .. }, _)) = found else {
                panic!("case {case}: {found:?}");
            };
            assert!((own * 1000.0 / radius - 1.0).abs() < 1e-9, "case {case}");
        }
    }
}
