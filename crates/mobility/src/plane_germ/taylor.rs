//! Power series in two variables of functions that can be evaluated in any number of bits.
//!
//! Values at the points (i h, j h), i + j ≤ K, of a grid so fine that what lies beyond degree K is a tiny share determine the
//! coefficients up to degree K: those of degree k are off by about h^(K+1−k) times coefficients of degree K + 1.

use super::fuzzy::{Fuzzy, value_at};
use crate::leftover::{Doubt, power_of_two};
use kutzbach_math::matrix::Real;

/// A power series in x and y, cut off at a degree.
#[derive(Clone, Debug)]
pub(super) struct Plane<R> {
    /// `by_y[j][i]` is the coefficient of xⁱ yʲ, i + j ≤ degree.
    pub by_y: Vec<Vec<Fuzzy<R>>>,
}

impl<R: Real> Plane<R> {
    pub fn degree(&self) -> usize {
        self.by_y.len().saturating_sub(1)
    }

    /// One in its arithmetic.
    pub fn one(&self) -> R {
        self.by_y[0][0].value.one_like()
    }

    /// The series without what is above a degree.
    pub fn up_to(&self, degree: usize) -> Self {
        Self {
            by_y: (0..=degree.min(self.degree()))
                .map(|j| self.by_y[j][..=degree - j].to_vec())
                .collect(),
        }
    }

    /// The series where every coefficient is known to this share of the largest one only.
    pub fn blurred(mut self, share: f64) -> Self {
        let all = || self.by_y.iter().flatten();
        let error = share * all().map(Fuzzy::size).fold(0.0, f64::max);
        for c in self.by_y.iter_mut().flatten() {
            c.error = c.error.max(error);
        }
        self
    }

    /// The coefficients of xⁱ yʲ with i + j = degree, by j.
    pub fn form(&self, degree: usize) -> Vec<Fuzzy<R>> {
        (0..=degree)
            .map(|j| self.by_y[j][degree - j].clone())
            .collect()
    }

    /// The coefficients of the powers of y at a value of x.
    pub fn at_x(&self, x: &R) -> Vec<Fuzzy<R>> {
        self.by_y.iter().map(|row| value_at(row, x)).collect()
    }

    /// The sum with shares of others.
    pub fn combined(planes: &[Self], shares: &[f64]) -> Option<Self> {
        let mut planes = planes.iter().zip(shares);
        let (first, share) = planes.next()?;
        let scaled = |plane: &Self, share: f64| -> Vec<Vec<Fuzzy<R>>> {
            let share = Fuzzy::exact(plane.one().constant(share));
            let rows = plane.by_y.iter();
            rows.map(|row| row.iter().map(|c| c.times(&share)).collect())
                .collect()
        };
        let mut by_y = scaled(first, *share);
        for (plane, share) in planes {
            for (sum, row) in by_y.iter_mut().zip(scaled(plane, *share)) {
                for (sum, c) in sum.iter_mut().zip(row) {
                    *sum = sum.plus(&c);
                }
            }
        }
        Some(Self { by_y })
    }

    /// With other variables: x = a u − b v, y = b u + a v.
    pub fn turned(&self, a: f64, b: f64) -> Self {
        let degree = self.degree();
        let one = self.one();
        let number = |x: f64| Fuzzy::exact(one.constant(x));
        // Powers of x and y as forms in u and v, by the power of v.
        let powers = |u: Fuzzy<R>, v: Fuzzy<R>| {
            let mut powers = vec![vec![number(1.0)]];
            for k in 1..=degree {
                let last = &powers[k - 1];
                let mut next = vec![number(0.0); k + 1];
                for (j, c) in last.iter().enumerate() {
                    next[j] = next[j].plus(&c.times(&u));
                    next[j + 1] = next[j + 1].plus(&c.times(&v));
                }
                powers.push(next);
            }
            powers
        };
        let xs = powers(number(a), number(-b));
        let ys = powers(number(b), number(a));
        let mut by_y: Vec<Vec<Fuzzy<R>>> = (0..=degree)
            .map(|j| vec![number(0.0); degree - j + 1])
            .collect();
        for (j, row) in self.by_y.iter().enumerate() {
            for (i, c) in row.iter().enumerate() {
                for (p, x) in xs[i].iter().enumerate() {
                    let share = c.times(x);
                    for (q, y) in ys[j].iter().enumerate() {
                        let place = &mut by_y[p + q][i + j - p - q];
                        *place = place.plus(&share.times(y));
                    }
                }
            }
        }
        Self { by_y }
    }
}

/// The power series up to a degree of each component of a function with values at (i h, j h); h = 2^−fineness. It is asked row by row,
/// i = 0, 1, 2, … for each j.
///
/// # Errors
/// [`Doubt`] where the function cannot be evaluated.
pub(super) fn series<R: Real>(
    one: &R,
    degree: usize,
    fineness: i64,
    mut function: impl FnMut(&[R]) -> Result<Vec<R>, Doubt>,
) -> Result<Vec<Plane<R>>, Doubt> {
    let h = power_of_two(one, -fineness);
    let mut tables: Vec<Vec<Vec<R>>> = Vec::new();
    for j in 0..=degree {
        for i in 0..=degree - j {
            let at = [
                one.constant(i as f64) * h.clone(),
                one.constant(j as f64) * h.clone(),
            ];
            let values = function(&at)?;
            tables.resize(values.len(), Vec::new());
            for (table, value) in tables.iter_mut().zip(values) {
                if i == 0 {
                    table.push(Vec::with_capacity(degree - j + 1));
                }
                table[j].push(value);
            }
        }
    }
    let inverse = power_of_two(one, fineness);
    Ok(tables
        .into_iter()
        .map(|mut table| {
            // Newton's form in both directions first: only its coefficients are those of a polynomial of total degree K.
            both_ways(&mut table, divided_differences);
            both_ways(&mut table, powers);
            let mut scale = one.one_like();
            for total in 0..=degree {
                for (j, row) in table.iter_mut().enumerate().take(total + 1) {
                    row[total - j] = row[total - j].clone() * scale.clone();
                }
                scale = scale * inverse.clone();
            }
            let beyond = (degree + 1) as i64;
            let known = |total: usize| 2f64.powi((-fineness * (beyond - total as i64)) as i32);
            Plane {
                by_y: table
                    .into_iter()
                    .enumerate()
                    .map(|(j, row)| {
                        let row = row.into_iter().enumerate();
                        row.map(|(i, value)| Fuzzy {
                            value,
                            error: known(i + j),
                        })
                        .collect()
                    })
                    .collect(),
            }
        })
        .collect())
}

/// Applies a change of one series to every row, then to every column.
fn both_ways<R: Real>(table: &mut [Vec<R>], change: fn(&mut [R])) {
    for row in table.iter_mut() {
        change(row);
    }
    for i in 0..table.len() {
        let mut column: Vec<R> = table.iter().filter_map(|row| row.get(i).cloned()).collect();
        change(&mut column);
        for (row, value) in table.iter_mut().zip(column) {
            row[i] = value;
        }
    }
}

/// From values at 0, 1, 2, … to divided differences.
fn divided_differences<R: Real>(values: &mut [R]) {
    for order in 1..values.len() {
        for place in (order..values.len()).rev() {
            let width = values[place].constant(order as f64);
            values[place] = (values[place].clone() - values[place - 1].clone()) / width;
        }
    }
}

/// From divided differences at 0, 1, 2, … to coefficients of powers: Horner's scheme for Newton's form.
fn powers<R: Real>(values: &mut [R]) {
    for start in (0..values.len().saturating_sub(1)).rev() {
        let node = values[start].constant(start as f64);
        for place in start..values.len() - 1 {
            values[place] = values[place].clone() - node.clone() * values[place + 1].clone();
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // a test may panic
mod tests {
    use super::*;
    use kutzbach_math::matrix::Extended;

    #[test]
    fn the_series_of_a_product_of_sines_is_found() {
        let one = Extended::new(1.0, 700);
        // Of total degree nine exactly: nothing but rounding is left.
        let product = |at: &[Extended]| {
            let sum = at[0].clone() + at[1].clone();
            Ok(vec![super::super::puiseux::power(&sum, 9)])
        };
        let exact = series(&one, 9, 40, product).unwrap();
        for (j, wanted) in [1.0, 9.0, 36.0, 84.0, 126.0, 126.0].into_iter().enumerate() {
            let left = exact[0].by_y[j][9 - j].value.clone() - one.constant(wanted);
            assert!(left.abs().to_f64() < 1e-80, "{j}");
            assert!(exact[0].by_y[j][8 - j].value.abs().to_f64() < 1e-80, "{j}");
        }
        let found = series(&one, 9, 40, |at| {
            let (sine, _) = at[0].sin_cos();
            let (_, cosine) = at[1].sin_cos();
            Ok(vec![sine.clone() * cosine.clone(), sine - at[1].clone()])
        })
        .unwrap();
        let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
        for j in 0..=7 {
            for i in 0..=7 - j {
                let sign = if (i / 2 + j / 2) % 2 == 0 { 1.0 } else { -1.0 };
                let wanted = if i % 2 == 1 && j % 2 == 0 {
                    sign / factorial(i) / factorial(j)
                } else {
                    0.0
                };
                let got = found[0].by_y[j][i].value.to_f64();
                assert!((got - wanted).abs() < 1e-17, "{i} {j} {got} {wanted}");
            }
        }
        assert_eq!(found[1].by_y[1][0].value.to_f64(), -1.0);
    }

    #[test]
    fn turning_there_and_back_changes_nothing() {
        let one = Extended::new(1.0, 200);
        let plane = |rows: &[&[f64]]| Plane {
            by_y: rows
                .iter()
                .map(|row| row.iter().map(|x| Fuzzy::exact(one.constant(*x))).collect())
                .collect(),
        };
        let parabola = plane(&[&[0.0, 2.0, -1.0], &[3.0, 0.5], &[7.0]]);
        let back = parabola.turned(0.6, 0.8).turned(0.6, -0.8);
        for (a, b) in parabola
            .by_y
            .iter()
            .flatten()
            .zip(back.by_y.iter().flatten())
        {
            assert!(a.minus(b).size() < 1e-15);
        }
        // x − y at x = 0.6 u − 0.8 v, y = 0.8 u + 0.6 v.
        let turned = plane(&[&[0.0, 1.0], &[-1.0]]).turned(0.6, 0.8);
        assert!((turned.by_y[0][1].value.to_f64() + 0.2).abs() < 1e-15);
        assert!((turned.by_y[1][0].value.to_f64() + 1.4).abs() < 1e-15);
    }
}
