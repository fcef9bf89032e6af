//! Germs that have no real zero but the origin, proved from their lowest terms.
//!
//! Two arguments, both of which leave what was truncated without influence:
//!
//! - *Leading forms without a common zero.* If at every point z of the unit sphere the leading form of some equation, of
//!   degree m, exceeds a margin, then that equation is at least margin·rᵐ − O(rᵐ⁺¹) at the distance r in that direction: on
//!   small spheres some equation differs from zero everywhere. The sphere is covered by a grid. A form f of degree m changes by
//!   at most m·‖f‖ per unit of arc, ‖f‖ being its Bombieri norm, a bound of it on the sphere (Kellogg 1928): values
//!   on a grid whose cells reach s from their centre bound it everywhere up to m·‖f‖·s.
//! - *Splitting off squares.* If the quadratic form of an equation is semidefinite, its minimum over the variables y that occur in
//!   the form is a power series g in the others x: f(x, y) ≥ g(x) near the origin, equal at one y only (Morse's lemma with
//!   parameters; Thom's splitting lemma). If g is definite in its turn, with the same sign, so is f: y² + x⁴.

use super::slices::composed;
use kutzbach_math::group::{Monomials, Series};
use nalgebra::{DMatrix, SymmetricEigen};

/// What counts as different from zero exceeds its error by this factor.
const CLEARANCE: f64 = 10.0;

/// Grid on the half circle, and on each of the two angles of the half sphere.
const CIRCLE: usize = 2000;
const SPHERE: usize = 300;

/// Whether the origin is the only real zero of some equations near it, because of their lowest terms; `noise` is the error of the
/// coefficients of each degree.
#[must_use]
pub fn isolated_by_leading_terms(equations: &[Series], noise: &[f64]) -> bool {
    no_common_zero(equations, noise) || equations.iter().any(|f| sign(f, noise).is_some())
}

/// The leading form of an equation: its degree and what is known of it.
struct LeadingForm<'a> {
    series: &'a Series,
    degree: usize,
    /// By how much it may change over one unit of arc.
    slope: f64,
    /// What its values may be wrong by.
    error: f64,
}

impl<'a> LeadingForm<'a> {
    /// `None` where no degree stands clear of the noise, or one of lower degree is in doubt.
    fn of(series: &'a Series, noise: &[f64]) -> Option<Self> {
        for degree in 1..=series.monomials().degree() {
            let error = noise.get(degree).copied()?;
            let size = series.size_of_degree(degree);
            if size > CLEARANCE * error {
                return Some(Self {
                    series,
                    degree,
                    slope: degree as f64 * bombieri_norm(series, degree),
                    // The values of a form on the sphere are at most its coefficients' norm times √(number of monomials).
                    error: error * (series.of_degree(degree).len() as f64).sqrt(),
                });
            }
            if size > error {
                return None;
            }
        }
        None
    }

    fn at(&self, z: &[f64]) -> f64 {
        let monomials = self.series.monomials();
        monomials
            .of_degree(self.degree)
            .map(|slot| {
                let powers = monomials.exponents(slot).iter().zip(z);
                let value: f64 = powers.map(|(e, x)| x.powi(i32::from(*e))).product();
                self.series.coefficients()[slot] * value
            })
            .sum()
    }

    /// Whether the form differs from zero within `reach` of a point of the sphere.
    fn differs(&self, z: &[f64], reach: f64) -> bool {
        self.at(z).abs() > self.slope * reach + CLEARANCE * self.error
    }
}

/// √(Σ c_α² α!/|α|!).
fn bombieri_norm(series: &Series, degree: usize) -> f64 {
    let monomials = series.monomials();
    let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
    let squares = monomials.of_degree(degree).map(|slot| {
        let powers = monomials.exponents(slot).iter();
        let weight: f64 = powers.map(|e| factorial(usize::from(*e))).product();
        series.coefficients()[slot].powi(2) * weight / factorial(degree)
    });
    squares.sum::<f64>().sqrt()
}

fn no_common_zero(equations: &[Series], noise: &[f64]) -> bool {
    let forms: Vec<LeadingForm<'_>> = equations
        .iter()
        .filter_map(|f| LeadingForm::of(f, noise))
        .collect();
    let variables = equations.first().map_or(0, |f| f.monomials().variables());
    if forms.is_empty() {
        return false;
    }
    grid(variables).is_some_and(|(points, reach)| {
        points
            .iter()
            .all(|z| forms.iter().any(|form| form.differs(z, reach)))
    })
}

/// Points of the unit sphere, one of each pair of opposite ones, such that every other is within the arc given of one of them or of
/// its opposite. `None` in more dimensions than three, where they would be too many.
fn grid(variables: usize) -> Option<(Vec<Vec<f64>>, f64)> {
    use std::f64::consts::PI;
    match variables {
        1 => Some((vec![vec![1.0]], 0.0)),
        2 => {
            let step = PI / CIRCLE as f64;
            let point = |i: usize| {
                let (sine, cosine) = (i as f64 * step).sin_cos();
                vec![cosine, sine]
            };
            // A tenth more than half a step, for rounding.
            Some(((0..CIRCLE).map(point).collect(), 0.55 * step))
        }
        3 => {
            let step = PI / SPHERE as f64;
            let mut points = Vec::with_capacity(SPHERE * (SPHERE + 1));
            for i in 0..SPHERE {
                let (sine, cosine) = (i as f64 * step).sin_cos();
                for j in 0..=SPHERE {
                    let (across, height) = (j as f64 * step).sin_cos();
                    points.push(vec![across * cosine, across * sine, height]);
                }
            }
            // Half a step along each of the two angles.
            Some((points, 1.1 * step))
        }
        _ => None,
    }
}

/// The sign that a series has everywhere near the origin but there, where its lowest terms prove one.
fn sign(series: &Series, noise: &[f64]) -> Option<f64> {
    let form = LeadingForm::of(series, noise)?;
    if form.degree % 2 == 1 {
        return None;
    }
    if form.degree == 2 {
        return sign_by_squares(series, noise);
    }
    let (points, reach) = grid(series.monomials().variables())?;
    let first = form.at(points.first()?).signum();
    points
        .iter()
        .all(|z| form.at(z) * first > 0.0 && form.differs(z, reach))
        .then_some(first)
}

/// [`sign`] of a series that begins with a quadratic form.
fn sign_by_squares(series: &Series, noise: &[f64]) -> Option<f64> {
    let variables = series.monomials().variables();
    let error = noise.get(2).copied()?;
    let eigen = SymmetricEigen::try_new(quadratic_form(series), f64::EPSILON, 1000)?;
    let largest = eigen.eigenvalues.amax();
    let error = error.max(64.0 * f64::EPSILON * largest);
    let mut signs = eigen
        .eigenvalues
        .iter()
        .filter(|value| value.abs() > CLEARANCE * error)
        .map(|value| value.signum());
    let first = signs.next()?;
    let rest = |value: &f64| value.abs() <= CLEARANCE * error;
    if signs.any(|sign| sign != first)
        || eigen
            .eigenvalues
            .iter()
            .any(|value| rest(value) && value.abs() > error)
    {
        return None;
    }
    let flat: Vec<usize> = (0..variables)
        .filter(|&i| rest(&eigen.eigenvalues[i]))
        .collect();
    if flat.is_empty() {
        return Some(first);
    }
    let (least, error) = least_over_squares(series, noise, &eigen, &flat)?;
    sign(&least, &error).filter(|sign| *sign == first)
}

/// The extreme value over the variables of the squares, as a series in the `flat` ones, with the error of its coefficients.
fn least_over_squares(
    series: &Series,
    noise: &[f64],
    eigen: &SymmetricEigen<f64, nalgebra::Dyn>,
    flat: &[usize],
) -> Option<(Series, Vec<f64>)> {
    let variables = series.monomials().variables();
    let degree = series.monomials().degree();
    let target = Monomials::new(flat.len(), degree).ok()?;
    // Along each eigenvector a coordinate: x where flat, elsewhere a series in x that is sought.
    let mut along: Vec<Series> = (0..variables)
        .map(|i| {
            let unit: Vec<f64> = flat.iter().map(|f| f64::from(u8::from(*f == i))).collect();
            Series::linear(&target, &unit)
        })
        .collect();
    let turned = |along: &[Series]| -> Vec<Series> {
        (0..variables)
            .map(|row| {
                let mut sum = Series::zero(&target);
                for (column, coordinate) in along.iter().enumerate() {
                    sum.add_scaled(eigen.eigenvectors[(row, column)], coordinate);
                }
                sum
            })
            .collect()
    };
    let slopes: Vec<Series> = (0..variables).map(|i| series.derivative(i)).collect();
    // Every round makes one more degree right: what is wrong enters the slopes multiplied by a coordinate.
    for _ in 0..degree {
        let gradient = composed(&slopes, &turned(&along))?;
        let mut next = along.clone();
        for i in (0..variables).filter(|i| !flat.contains(i)) {
            let factor = -0.5 / eigen.eigenvalues[i];
            for (part, slope) in gradient.iter().enumerate() {
                next[i].add_scaled(factor * eigen.eigenvectors[(part, i)], slope);
            }
        }
        along = next;
    }
    let point = turned(&along);
    let least = composed(std::slice::from_ref(series), &point)?.pop()?;
    // At an extreme value an error of the function counts, one of the place does not, to first order: the error of the function
    // composed with the place, all signs alike.
    let magnitudes: Vec<Series> = point.iter().map(magnitude).collect();
    let error = composed(&[all_of(series, noise)], &magnitudes)?.pop()?;
    let rounding = composed(&[magnitude(series)], &magnitudes)?.pop()?;
    let errors = (0..=degree)
        .map(|k| error.size_of_degree(k) + 64.0 * f64::EPSILON * rounding.size_of_degree(k))
        .collect();
    Some((least, errors))
}

fn magnitude(series: &Series) -> Series {
    let coefficients = series.coefficients().iter().map(|c| c.abs()).collect();
    Series::from_coefficients(series.monomials(), coefficients)
}

/// The series of the shape given whose coefficients are the errors.
fn all_of(series: &Series, noise: &[f64]) -> Series {
    let monomials = series.monomials();
    let coefficients = (0..monomials.count())
        .map(|slot| match monomials.degree_of(slot) {
            0 | 1 => 0.0,
            degree => noise.get(degree).copied().unwrap_or(f64::INFINITY),
        })
        .collect();
    Series::from_coefficients(monomials, coefficients)
}

/// How many positive and negative squares the quadratic form of a series is made of, where it has full rank beyond the error of its
/// coefficients.
#[must_use]
pub fn signature(series: &Series, noise: f64) -> Option<(usize, usize)> {
    let (plus, minus) = inertia(series, noise);
    let variables = series.monomials().variables();
    (variables > 0 && plus + minus == variables).then_some((plus, minus))
}

/// How many eigenvalues of the quadratic form of a series are positive and how many negative, those within its error left out.
#[must_use]
pub fn inertia(series: &Series, noise: f64) -> (usize, usize) {
    let eigen = quadratic_form(series).symmetric_eigenvalues();
    // An eigenvalue is no more wrong than the form in the Frobenius norm.
    let amax = eigen.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let least = CLEARANCE * noise.max(64.0 * f64::EPSILON * amax);
    let plus = eigen.iter().filter(|value| **value > least).count();
    (plus, eigen.iter().filter(|value| **value < -least).count())
}

/// The symmetric matrix of the degree-two part of a series.
pub fn quadratic_form(series: &Series) -> DMatrix<f64> {
    let monomials = series.monomials();
    let mut form = DMatrix::zeros(monomials.variables(), monomials.variables());
    for slot in monomials.of_degree(2) {
        let c = series.coefficients()[slot];
        let present: Vec<usize> = (0..monomials.variables())
            .filter(|i| monomials.exponents(slot)[*i] > 0)
            .collect();
        match present[..] {
            [i] => form[(i, i)] = c,
            [i, j] => {
                form[(i, j)] = 0.5 * c;
                form[(j, i)] = 0.5 * c;
            }
            _ => {}
        }
    }
    form
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const NOISE: [f64; 13] = [1e-13; 13];

    fn series(variables: usize, degree: usize, terms: &[(&[u8], f64)]) -> Series {
        let m = Monomials::new(variables, degree).unwrap();
        let mut f = Series::zero(&m);
        for (exponents, value) in terms {
            f.coefficients_mut()[m.index_of(exponents).unwrap()] += value;
        }
        f
    }

    fn isolated(equations: &[Series]) -> bool {
        isolated_by_leading_terms(equations, &NOISE)
    }

    #[test]
    fn definite_forms_are_seen() {
        assert!(isolated(&[series(2, 6, &[(&[4, 0], 1.0), (&[0, 4], 2.0)])]));
        assert!(isolated(&[series(
            3,
            4,
            &[(&[4, 0, 0], -1.0), (&[0, 4, 0], -2.0), (&[0, 0, 4], -1.0)]
        )]));
        // x y and x² − y² vanish together at the origin only.
        assert!(isolated(&[
            series(2, 4, &[(&[1, 1], 1.0)]),
            series(2, 4, &[(&[2, 0], 1.0), (&[0, 2], -1.0)]),
        ]));
    }

    #[test]
    fn squares_are_split_off() {
        assert!(isolated(&[series(2, 4, &[(&[0, 2], 1.0), (&[4, 0], 1.0)])]));
        // (y − x²)² + x⁸.
        let bent: &[(&[u8], f64)] = &[
            (&[0, 2], 1.0),
            (&[2, 1], -2.0),
            (&[4, 0], 1.0),
            (&[8, 0], 1.0),
        ];
        assert!(isolated(&[series(2, 8, bent)]));
        assert!(!isolated(&[series(2, 6, &bent[..3])]));
        // Turned by a right triangle: (0.6 x + 0.8 y)² + x⁴.
        assert!(isolated(&[series(
            2,
            6,
            &[
                (&[2, 0], 0.36),
                (&[1, 1], 0.96),
                (&[0, 2], 0.64),
                (&[4, 0], 1.0)
            ]
        )]));
    }

    #[test]
    fn what_has_zeros_is_not_called_isolated() {
        for terms in [
            &[(&[0u8, 2][..], 1.0), (&[4, 0], -1.0)][..],
            &[(&[0, 2], 1.0), (&[3, 0], 1.0)],
            &[(&[0, 2], 1.0)],
            &[(&[1, 1], 1.0)],
            &[(&[4, 0], 1.0), (&[2, 2], 1.0)],
            // A thin cone: x² = 1e-8 y².
            &[(&[2, 0], 1.0), (&[0, 2], -1e-8)],
        ] {
            assert!(!isolated(&[series(2, 6, terms)]));
        }
        // (y − x²)² − x⁶ begins like a square.
        let two: &[(&[u8], f64)] = &[
            (&[0, 2], 1.0),
            (&[2, 1], -2.0),
            (&[4, 0], 1.0),
            (&[6, 0], -1.0),
        ];
        assert!(!isolated(&[series(2, 8, two)]));
    }
}
