//! Points of rational B-spline curves and surfaces.

use crate::error::StepError;
use crate::part21::{Instance, Record};
use crate::placement::point;
use crate::units::Units;
use nalgebra::{Vector3, Vector4};

/// Higher degrees are not evaluated: kernels stop at 25.
const HIGHEST_DEGREE: usize = 32;

/// A rational B-spline curve.
#[derive(Clone, Debug)]
pub(crate) struct SplineCurve {
    basis: Basis,
    /// Control points times their weights, and the weights.
    poles: Vec<Vector4<f64>>,
}

/// A rational B-spline surface.
#[derive(Clone, Debug)]
pub(crate) struct SplineSurface {
    u: Basis,
    v: Basis,
    /// One row for every control point along u.
    poles: Vec<Vec<Vector4<f64>>>,
}

/// Degree and knots along one parameter.
#[derive(Clone, Debug)]
struct Basis {
    degree: usize,
    knots: Vec<f64>,
}

/// How knots stand that are not written: 0, 1, 2, ... (ISO 10303-42, `default_b_spline_knots`).
#[derive(Clone, Copy)]
enum Spacing {
    /// Each once.
    Uniform,
    /// Each once, the first and the last so often that the curve ends at its control points.
    QuasiUniform,
    /// As often as pieces want that have control points of their own.
    Bezier,
}

/// The leaf of an entity that says its knots, and how these stand where it does not list them.
fn knots_of<'e>(
    instance: Instance<'e>,
    keywords: [&str; 4],
) -> Option<(Record<'e>, Option<Spacing>)> {
    let spacings = [
        None,
        Some(Spacing::Uniform),
        Some(Spacing::QuasiUniform),
        Some(Spacing::Bezier),
    ];
    let mut pairs = keywords.into_iter().zip(spacings);
    pairs.find_map(|(word, spacing)| Some((instance.leaf(word)?, spacing)))
}

impl Basis {
    /// With knots that a kind of curve or surface implies; `None` where degree and control points do not fit together.
    fn implied(spacing: Spacing, degree: f64, poles: usize) -> Option<Self> {
        if !(1.0..=HIGHEST_DEGREE as f64).contains(&degree) {
            return None;
        }
        let whole = degree as usize;
        let (spans, inner, end) = match spacing {
            Spacing::Uniform => (poles + whole, 1, 1),
            Spacing::QuasiUniform => (poles.checked_sub(whole)?, 1, whole + 1),
            Spacing::Bezier => (poles.checked_sub(1)? / whole, whole, whole + 1),
        };
        let knots: Vec<f64> = (0..=spans).map(|knot| knot as f64).collect();
        let often = |knot: usize| {
            if knot == 0 || knot == spans {
                end
            } else {
                inner
            }
        };
        let multiplicities: Vec<f64> = (0..=spans).map(|knot| often(knot) as f64).collect();
        Self::new(degree, &multiplicities, &knots, poles)
    }

    /// `None` where degree, knots and the number of control points do not fit together.
    fn new(degree: f64, multiplicities: &[f64], knots: &[f64], poles: usize) -> Option<Self> {
        let whole = degree >= 1.0 && degree <= HIGHEST_DEGREE as f64 && degree.fract() == 0.0;
        if !whole || multiplicities.len() != knots.len() {
            return None;
        }
        let degree = degree as usize;
        let mut all = Vec::new();
        for (knot, count) in knots.iter().zip(multiplicities) {
            let fits = *count >= 1.0 && *count <= (HIGHEST_DEGREE + 1) as f64;
            if !fits || all.last().is_some_and(|last| knot < last) {
                return None;
            }
            all.extend(std::iter::repeat_n(*knot, *count as usize));
        }
        let basis = Self { degree, knots: all };
        let complete = poles > degree && basis.knots.len() == poles + degree + 1;
        let (first, last) = basis.domain();
        (complete && last > first).then_some(basis)
    }

    /// First and last value of the parameter.
    fn domain(&self) -> (f64, f64) {
        let behind = self.knots.len().saturating_sub(self.degree + 1);
        (self.knot(self.degree), self.knot(behind))
    }

    fn knot(&self, place: usize) -> f64 {
        self.knots.get(place).copied().unwrap_or(0.0)
    }

    /// De Boor's algorithm. `pole` gives control points by their places.
    fn evaluate(&self, at: f64, pole: impl Fn(usize) -> Vector4<f64>) -> Vector4<f64> {
        let degree = self.degree;
        let (first, last) = self.domain();
        let at = at.clamp(first, last);
        let behind = self.knots.len().saturating_sub(degree + 1);
        // The last span that begins at or before the parameter, and is not empty.
        let mut span = self.knots.partition_point(|knot| *knot <= at);
        span = span.clamp(degree + 1, behind) - 1;
        while span > degree && self.knot(span) >= self.knot(span + 1) {
            span -= 1;
        }
        let mut points: Vec<Vector4<f64>> = (0..=degree).map(|i| pole(span - degree + i)).collect();
        for level in 1..=degree {
            for i in (level..=degree).rev() {
                let (low, high) = (
                    self.knot(span - degree + i),
                    self.knot(span + 1 + i - level),
                );
                let share = if high > low {
                    (at - low) / (high - low)
                } else {
                    0.0
                };
                // Both places are below `degree + 1`, the length of the list.
                points[i] = points[i - 1] * (1.0 - share) + points[i] * share;
            }
        }
        points.last().copied().unwrap_or_else(Vector4::zeros)
    }
}

/// The point of homogeneous coordinates.
fn affine(h: Vector4<f64>) -> Vector3<f64> {
    Vector3::new(h.x, h.y, h.z) / h.w
}

/// A control point with its weight; `None` where the weight is not positive.
fn weighted(p: Vector3<f64>, weight: f64) -> Option<Vector4<f64>> {
    (weight > 0.0).then(|| Vector4::new(p.x * weight, p.y * weight, p.z * weight, weight))
}

impl SplineCurve {
    /// Reads a B-spline curve, rational or not, with its knots or those that a uniform, quasi-uniform or Bézier curve has. `None` where it is
    /// another curve, or its numbers do not fit together.
    ///
    /// # Errors
    /// References to nothing, and parameters of the wrong kind.
    pub fn read(instance: Instance<'_>, units: &Units) -> Result<Option<Self>, StepError> {
        let keywords = [
            "B_SPLINE_CURVE_WITH_KNOTS",
            "UNIFORM_CURVE",
            "QUASI_UNIFORM_CURVE",
            "BEZIER_CURVE",
        ];
        let Some((knots, spacing)) = knots_of(instance, keywords) else {
            return Ok(None);
        };
        // Of several types at once, degree and points stand with the supertype.
        let (curve, degree, first_knots) = match instance.leaf("B_SPLINE_CURVE") {
            Some(curve) => (curve, 0, 0),
            None => (knots, 1, 6),
        };
        let points = curve.entities_at(degree + 1)?;
        let weights = match instance.leaf("RATIONAL_B_SPLINE_CURVE") {
            Some(rational) => rational.numbers_at(rational.len().saturating_sub(1))?,
            None => vec![1.0; points.len()],
        };
        if weights.len() != points.len() {
            return Ok(None);
        }
        let basis = match spacing {
            Some(spacing) => Basis::implied(spacing, curve.number_at(degree)?, points.len()),
            None => Basis::new(
                curve.number_at(degree)?,
                &knots.numbers_at(first_knots)?,
                &knots.numbers_at(first_knots + 1)?,
                points.len(),
            ),
        };
        let mut poles = Vec::with_capacity(points.len());
        for (pole, weight) in points.into_iter().zip(weights) {
            poles.extend(weighted(point(pole, units)?, weight));
        }
        Ok(basis
            .filter(|basis| basis.knots.len() == poles.len() + basis.degree + 1)
            .map(|basis| Self { basis, poles }))
    }

    /// First and last value of the parameter.
    pub fn domain(&self) -> (f64, f64) {
        self.basis.domain()
    }

    /// The point (m) of a value of the parameter.
    pub fn at(&self, parameter: f64) -> Vector3<f64> {
        let pole = |i: usize| self.poles.get(i).copied().unwrap_or_else(Vector4::zeros);
        affine(self.basis.evaluate(parameter, pole))
    }
}

impl SplineSurface {
    /// Reads a B-spline surface, rational or not, with its knots or those that a uniform, quasi-uniform or Bézier surface has. `None` where it
    /// is another surface, or its numbers do not fit together.
    ///
    /// # Errors
    /// References to nothing, and parameters of the wrong kind.
    pub fn read(instance: Instance<'_>, units: &Units) -> Result<Option<Self>, StepError> {
        let keywords = [
            "B_SPLINE_SURFACE_WITH_KNOTS",
            "UNIFORM_SURFACE",
            "QUASI_UNIFORM_SURFACE",
            "BEZIER_SURFACE",
        ];
        let Some((knots, spacing)) = knots_of(instance, keywords) else {
            return Ok(None);
        };
        let (surface, degree, first_knots) = match instance.leaf("B_SPLINE_SURFACE") {
            Some(surface) => (surface, 0, 0),
            None => (knots, 1, 8),
        };
        let Some(points) = grid(surface, degree + 2, units)? else {
            return Ok(None);
        };
        let weights = match instance.leaf("RATIONAL_B_SPLINE_SURFACE") {
            Some(rational) => Some(weights(rational)?),
            None => None,
        };
        let Some(poles) = weigh(&points, weights.as_deref()) else {
            return Ok(None);
        };
        let (rows, columns) = (poles.len(), poles.first().map_or(0, Vec::len));
        let numbers = |place: usize| knots.numbers_at(first_knots + place);
        let basis = |along: usize, poles: usize| {
            let degree = surface.number_at(degree + along)?;
            Ok::<_, StepError>(match spacing {
                Some(spacing) => Basis::implied(spacing, degree, poles),
                None => Basis::new(degree, &numbers(along)?, &numbers(along + 2)?, poles),
            })
        };
        let (u, v) = (basis(0, rows)?, basis(1, columns)?);
        Ok(u.zip(v).map(|(u, v)| Self { u, v, poles }))
    }

    /// First and last values of both parameters: u, v.
    pub fn domain(&self) -> ((f64, f64), (f64, f64)) {
        (self.u.domain(), self.v.domain())
    }

    /// The point (m) of values of the parameters.
    pub fn at(&self, u: f64, v: f64) -> Vector3<f64> {
        let row = |i: usize| {
            let poles = self.poles.get(i);
            let pole = |j: usize| {
                let pole = poles.and_then(|poles| poles.get(j));
                pole.copied().unwrap_or_else(Vector4::zeros)
            };
            self.v.evaluate(v, pole)
        };
        affine(self.u.evaluate(u, row))
    }
}

/// The control points of a surface, row by row; `None` where rows differ in length.
fn grid(
    surface: Record<'_>,
    place: usize,
    units: &Units,
) -> Result<Option<Vec<Vec<Vector3<f64>>>>, StepError> {
    let needed = "a list of lists of references";
    let rows = surface.item(place).and_then(|item| item.list());
    let mut grid: Vec<Vec<Vector3<f64>>> = Vec::new();
    for row in rows.ok_or_else(|| surface.wrong(place, needed))? {
        let mut points = Vec::new();
        for item in row.list().ok_or_else(|| surface.wrong(place, needed))? {
            let number = item.reference();
            let number = number.ok_or_else(|| surface.wrong(place, needed))?;
            points.push(point(surface.resolve(number)?, units)?);
        }
        grid.push(points);
    }
    let length = grid.first().map_or(0, Vec::len);
    Ok(grid.iter().all(|row| row.len() == length).then_some(grid))
}

fn weights(rational: Record<'_>) -> Result<Vec<Vec<f64>>, StepError> {
    let place = rational.len().saturating_sub(1);
    let needed = "a list of lists of numbers";
    let rows = rational.item(place).and_then(|item| item.list());
    let mut weights = Vec::new();
    for row in rows.ok_or_else(|| rational.wrong(place, needed))? {
        let numbers: Option<Vec<f64>> = row
            .list()
            .and_then(|row| row.map(|item| item.number()).collect());
        weights.push(numbers.ok_or_else(|| rational.wrong(place, needed))?);
    }
    Ok(weights)
}

/// Control points with their weights, all one where none are given; `None` where they do not fit together.
fn weigh(
    points: &[Vec<Vector3<f64>>],
    weights: Option<&[Vec<f64>]>,
) -> Option<Vec<Vec<Vector4<f64>>>> {
    if weights.is_some_and(|weights| weights.len() != points.len()) {
        return None;
    }
    let mut rows = Vec::with_capacity(points.len());
    for (place, row) in points.iter().enumerate() {
        let given = match weights {
            Some(weights) => weights.get(place)?.clone(),
            None => vec![1.0; row.len()],
        };
        if given.len() != row.len() {
            return None;
        }
        let pairs = row.iter().zip(given);
        let weighed: Option<Vec<Vector4<f64>>> = pairs.map(|(p, w)| weighted(*p, w)).collect();
        rows.push(weighed?);
    }
    Some(rows)
}

#[cfg(test)]
mod tests {
    use super::{Basis, Spacing};

    #[test]
    fn knots_that_are_not_written_are_those_of_the_standard() {
        let knots =
            |spacing, degree, poles| Basis::implied(spacing, degree, poles).map(|b| b.knots);
        let quasi = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0];
        assert_eq!(knots(Spacing::QuasiUniform, 2.0, 5), Some(quasi.to_vec()));
        let bezier = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0];
        assert_eq!(knots(Spacing::Bezier, 2.0, 5), Some(bezier.to_vec()));
        let uniform = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        assert_eq!(knots(Spacing::Uniform, 2.0, 4), Some(uniform.to_vec()));
        // Two pieces of degree 2 want five control points; a degree wants more control points than it is, and is a small whole number.
        assert_eq!(knots(Spacing::Bezier, 2.0, 4), None);
        assert_eq!(knots(Spacing::QuasiUniform, 3.0, 3), None);
        for degree in [0.0, -1.0, 1.5, 1e300, f64::NAN] {
            assert_eq!(knots(Spacing::Uniform, degree, 4), None, "{degree}");
        }
    }
}
