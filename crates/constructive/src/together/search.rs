//! Solutions found from the drawing and around it, where exact algebra ends before it has all.
//!
//! Newton's method from many starts finds some. Each is proven: for T(y) = y − A F(y), with A near the inverse of the Jacobian at x, in the ball of
//! radius r around x (largest coordinate) |T(y) − x| ≤ β + (δ + K r) r, where β bounds |A F(x)|, δ is |1 − A J(x)| and K r bounds |A (J(y) − J(x))| by
//! second derivatives. With r = 2β and δ + 2Kβ < ½ the ball is mapped into itself and shrunk, so that there is exactly one
//! solution in it (Kantorovich 1948). Whether there are others is not said.

use crate::samples::Random;

/// Starts around the drawing.
const STARTS: usize = 400;
/// Steps from one start; those that lead somewhere take ten.
const STEPS: usize = 40;
/// Products that all steps together may take: below a second.
const MOST_PRODUCTS: usize = 400_000_000;

/// An unknown where it is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) enum Start {
    /// Its value, and what is far from it.
    At(f64, f64),
    /// One divided by an unknown before it.
    Inverse(usize),
}

/// A polynomial: coefficients and exponents.
pub(super) type Terms = Vec<(f64, Vec<u8>)>;

/// A solution: no other is as near as `within` in every unknown.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub(super) at: Vec<f64>,
    pub(super) within: f64,
}

/// As many equations as unknowns.
pub(super) struct Search<'a> {
    pub(super) equations: &'a [Terms],
    pub(super) starts: &'a [Start],
}

impl Search<'_> {
    /// The solutions, those from starts near the drawing first.
    pub(super) fn solutions(&self) -> Vec<Found> {
        let count = self.starts.len();
        let mut all: Vec<Found> = Vec::new();
        if count == 0 || self.equations.len() != count {
            return all;
        }
        let terms: usize = self.equations.iter().map(Vec::len).sum();
        let step = count.pow(3) + terms * count * 4;
        let tries = (MOST_PRODUCTS / (step * STEPS)).clamp(1, STARTS);
        let mut random = Random::new(1);
        for k in 0..tries {
            // None, then up to three times what is far.
            let spread = 3.0 * k as f64 / STARTS as f64;
            let start = self.start(spread, &mut random);
            let Some(found) = self.newton(start).and_then(|x| self.proven(x)) else {
                continue;
            };
            let apart = |other: &Found| {
                let off = other.at.iter().zip(&found.at).map(|(a, b)| (a - b).abs());
                off.fold(0.0, f64::max) > other.within + found.within
            };
            if all.iter().all(apart) {
                all.push(found);
            }
        }
        all
    }

    fn start(&self, spread: f64, random: &mut Random) -> Vec<f64> {
        let mut x: Vec<f64> = Vec::with_capacity(self.starts.len());
        for start in self.starts {
            x.push(match *start {
                Start::At(value, far) => value + spread * far * (2.0 * random.unit() - 1.0),
                Start::Inverse(of) => 1.0 / x[of],
            });
        }
        x
    }

    fn newton(&self, mut x: Vec<f64>) -> Option<Vec<f64>> {
        let mut off = self.off(&x);
        for _ in 0..STEPS {
            let inverse = inverted(self.jacobian(&x))?;
            let values = self.values(&x);
            let step: Vec<f64> = inverse.iter().map(|row| dot(row, &values)).collect();
            let largest = step.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
            let size = x.iter().fold(1.0, |m: f64, v| m.max(v.abs()));
            if !largest.is_finite() {
                return None;
            }
            let mut share = 1.0;
            let next = loop {
                let pairs = x.iter().zip(&step);
                let next: Vec<f64> = pairs.map(|(v, s)| v - share * s).collect();
                let next_off = self.off(&next);
                if next_off < off || share < 1e-3 {
                    off = next_off;
                    break next;
                }
                share /= 2.0;
            };
            x = next;
            if largest <= 1e-14 * size {
                break;
            }
        }
        Some(x)
    }

    /// Whether there is exactly one solution near, and how near.
    fn proven(&self, at: Vec<f64>) -> Option<Found> {
        let count = at.len();
        let jacobian = self.jacobian(&at);
        let inverse = inverted(jacobian.clone())?;
        let sizes: Vec<f64> = at.iter().map(|x| x.abs()).collect();
        // Every coefficient, power, product and sum is rounded once.
        let rounding = |terms: &Terms| {
            let size: f64 = terms.iter().map(|t| size_of(t, &sizes)).sum();
            (terms.len() + 16) as f64 * f64::EPSILON * size
        };
        let values = self.values(&at);
        let values: Vec<f64> = values
            .iter()
            .zip(self.equations)
            .map(|(v, terms)| v.abs() + rounding(terms))
            .collect();
        let absolute = |row: &[f64]| row.iter().map(|a| a.abs()).collect::<Vec<f64>>();
        let beta = inverse.iter().map(|row| dot(&absolute(row), &values));
        let beta = beta.fold(0.0, f64::max);
        let delta = inverse.iter().enumerate().map(|(i, row)| {
            let off = (0..count).map(|j| {
                let column: Vec<f64> = jacobian.iter().map(|r| r[j]).collect();
                let unit = f64::from(u8::from(i == j));
                let rounded = (count + 16) as f64 * f64::EPSILON;
                (unit - dot(row, &column)).abs() + rounded * dot(&absolute(row), &absolute(&column))
            });
            off.sum::<f64>()
        });
        let delta = delta.fold(0.0, f64::max);
        let within = 2.0 * beta;
        let around: Vec<f64> = sizes.iter().map(|x| x + within).collect();
        let bends: Vec<f64> = self.equations.iter().map(|t| bend(t, &around)).collect();
        let bend = inverse.iter().map(|row| dot(&absolute(row), &bends));
        let bend = bend.fold(0.0, f64::max);
        (delta + bend * within < 0.5).then_some(Found { at, within })
    }

    fn off(&self, x: &[f64]) -> f64 {
        let squares = self.values(x).into_iter().map(|v| v * v);
        squares.sum()
    }

    fn values(&self, x: &[f64]) -> Vec<f64> {
        let value = |terms: &Terms| terms.iter().map(|(c, e)| c * power(e, x)).sum();
        self.equations.iter().map(value).collect()
    }

    fn jacobian(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let row = |terms: &Terms| {
            let mut row = vec![0.0; x.len()];
            for (c, exponents) in terms {
                for j in mentioned(exponents) {
                    let (by, lower) = lowered(exponents, j);
                    row[j] += c * by * power(&lower, x);
                }
            }
            row
        };
        self.equations.iter().map(row).collect()
    }
}

fn mentioned(exponents: &[u8]) -> impl Iterator<Item = usize> {
    let all = exponents.iter().enumerate();
    all.filter(|(_, e)| **e > 0).map(|(j, _)| j)
}

/// The derivative of a monomial: a factor, and exponents.
fn lowered(exponents: &[u8], j: usize) -> (f64, Vec<u8>) {
    let mut lower = exponents.to_vec();
    lower[j] -= 1;
    (f64::from(exponents[j]), lower)
}

fn power(exponents: &[u8], x: &[f64]) -> f64 {
    let powers = exponents.iter().zip(x).filter(|(e, _)| **e > 0);
    powers.map(|(&e, x)| x.powi(i32::from(e))).product()
}

fn size_of((c, exponents): &(f64, Vec<u8>), sizes: &[f64]) -> f64 {
    c.abs() * power(exponents, sizes)
}

/// What all second derivatives together are at most.
fn bend(terms: &Terms, sizes: &[f64]) -> f64 {
    let mut sum = 0.0;
    for (c, exponents) in terms {
        for j in mentioned(exponents) {
            let (first, lower) = lowered(exponents, j);
            for k in mentioned(&lower) {
                let (second, lowest) = lowered(&lower, k);
                sum += c.abs() * first * second * power(&lowest, sizes);
            }
        }
    }
    sum
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The inverse, by elimination with the largest entry of each column; `None` where there is none to rounding.
fn inverted(mut rows: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let count = rows.len();
    for (i, row) in rows.iter_mut().enumerate() {
        row.extend((0..count).map(|j| f64::from(u8::from(i == j))));
    }
    for column in 0..count {
        let below = (column..count).max_by(|&a, &b| {
            let [a, b] = [a, b].map(|r| rows[r][column].abs());
            a.total_cmp(&b)
        });
        rows.swap(column, below?);
        let pivot = rows[column][column];
        if !pivot.is_normal() {
            return None;
        }
        rows[column].iter_mut().for_each(|x| *x /= pivot);
        let own = rows[column].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[column];
            if i != column && factor != 0.0 {
                row.iter_mut().zip(&own).for_each(|(x, o)| *x -= factor * o);
            }
        }
    }
    Some(
        rows.into_iter()
            .map(|mut row| row.split_off(count))
            .collect(),
    )
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn search(equations: &[Terms], starts: &[Start]) -> Vec<Found> {
        Search { equations, starts }.solutions()
    }

    #[test]
    fn simple_solutions_are_proven_and_double_ones_are_not() {
        // x² + y² = 25 and x y = 12: (±3, ±4) and (±4, ±3).
        let circle = vec![(1.0, vec![2, 0]), (1.0, vec![0, 2]), (-25.0, vec![0, 0])];
        let product = |c: f64| vec![(1.0, vec![1, 1]), (c, vec![0, 0])];
        let starts = [Start::At(3.1, 5.0), Start::At(3.8, 5.0)];
        let found = search(&[circle.clone(), product(-12.0)], &starts);
        assert_eq!(found.len(), 4);
        assert!((found[0].at[0] - 3.0).abs() <= found[0].within);
        assert!(found.iter().all(|f| f.within < 1e-12));
        // x y = 12.5 touches the circle; x y = 13 does not meet it.
        assert!(search(&[circle.clone(), product(-12.5)], &starts).is_empty());
        assert!(search(&[circle.clone(), product(-13.0)], &starts).is_empty());
        // One equation too few says nothing.
        assert!(search(&[circle], &starts).is_empty());
    }

    #[test]
    fn inverses_start_as_such() {
        let of = [Start::At(4.0, 1.0), Start::Inverse(0)];
        let equations = [
            vec![(1.0, vec![1, 0]), (-4.0, vec![0, 0])],
            vec![(1.0, vec![1, 1]), (-1.0, vec![0, 0])],
        ];
        let found = search(&equations, &of);
        assert_eq!((found.len(), found[0].at[1]), (1, 0.25));
    }
}
