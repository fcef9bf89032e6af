//! The equations as they are solved: independent by degree, without noise, compiled, weighted for a radius.

use std::cell::Cell;
use std::sync::Arc;

use super::small::{dot, rotate_to_orthogonal};
use kutzbach_math::group::{Monomials, Series};
use kutzbach_math::interruption;

/// Operations of a decomposition of the derivatives, over their number times the variables.
const LINEAR_ALGEBRA: usize = 60;

/// Polynomial equations with their leading forms made orthogonal, ready for fast evaluation.
///
/// The equations as given are one basis of a linear space of equations; another basis has the same zeros. The basis kept
/// is chosen degree by degree: combinations whose leading forms of degree 2 are independent, then among the rest those
/// of degree 3, and so on. An equation of higher order is thus never hidden behind one of lower order.
#[derive(Clone, Debug)]
pub(super) struct System {
    monomials: Arc<Monomials>,
    /// Monomial i is monomial `parents[i].0` times variable `parents[i].1`.
    parents: Vec<(u32, u8)>,
    equations: Vec<Equation>,
    /// Radius within which no homogeneous part outweighs the leading one.
    pub(super) radius: f64,
    noise: f64,
    /// Work of one evaluation, about one multiplication each, linear algebra with the derivatives included.
    cost: u64,
    /// Work done, and the most that may be.
    spent: Cell<u64>,
    allowed: Cell<u64>,
}

#[derive(Clone, Debug)]
struct Equation {
    coefficients: Vec<f64>,
    terms: Vec<(u32, f64)>,
    /// (variable, monomial, coefficient) of all partial derivatives.
    gradient: Vec<(u8, u32, f64)>,
    lowest: usize,
    /// Bombieri norm of each homogeneous part: a bound of its values on the unit sphere that does not change under
    /// rotations (Beauzamy, Bombieri, Enflo and Montgomery 1990).
    sizes: Vec<f64>,
}

impl System {
    /// `noise`: absolute accuracy of every coefficient. `None` where there is nothing to solve: no equation, or none
    /// above the noise.
    pub(super) fn new(equations: &[Series], noise: f64, largest_radius: f64) -> Option<Self> {
        let monomials = Arc::clone(equations.first()?.monomials());
        let weights = bombieri_weights(&monomials);
        let mut pending: Vec<Vec<f64>> = equations
            .iter()
            .map(|series| {
                let mut row = series.coefficients().to_vec();
                row[0] = 0.0;
                row.iter_mut()
                    .filter(|c| c.abs() <= noise)
                    .for_each(|c| *c = 0.0);
                row
            })
            .collect();
        // A sum of s errors under a rotation grows at most by √s.
        let noise = noise * (pending.len() as f64).sqrt();
        let mut finished = Vec::new();
        for degree in 1..=monomials.degree() {
            let range = monomials.of_degree(degree);
            let mut leading: Vec<Vec<f64>> = pending
                .iter()
                .map(|row| row[range.clone()].to_vec())
                .collect();
            rotate_to_orthogonal(&mut leading, &mut pending, Some(&weights[range.clone()]));
            // The combinations are no better known than √(number of coefficients) errors.
            let largest = leading
                .iter()
                .map(|form| norm(form, &weights[range.clone()]))
                .fold(0.0, f64::max);
            let smallest_kept =
                (noise * (range.len() as f64).sqrt()).max(64.0 * f64::EPSILON * largest);
            let mut rest = Vec::new();
            for (mut row, form) in pending.into_iter().zip(leading) {
                if norm(&form, &weights[range.clone()]) > smallest_kept {
                    finished.push(row);
                } else {
                    row[range.clone()].fill(0.0);
                    rest.push(row);
                }
            }
            pending = rest;
        }
        if finished.is_empty() {
            return None;
        }
        let equations: Vec<Equation> = finished
            .into_iter()
            .map(|row| Equation::new(row, &monomials, &weights))
            .collect();
        let mut radius = largest_radius;
        for equation in &equations {
            for degree in equation.lowest + 1..=monomials.degree() {
                if equation.sizes[degree] > 0.0 {
                    let ratio = equation.sizes[equation.lowest] / equation.sizes[degree];
                    radius = radius.min(ratio.powf(1.0 / (degree - equation.lowest) as f64));
                }
            }
        }
        let parents = parents(&monomials);
        let terms = equations.iter().map(|e| e.terms.len() + e.gradient.len());
        let dense = equations.len() * monomials.variables().pow(2);
        let cost = parents.len() + terms.sum::<usize>() + LINEAR_ALGEBRA * dense;
        Some(Self {
            monomials,
            parents,
            equations,
            radius,
            noise,
            cost: cost as u64,
            spent: Cell::new(0),
            allowed: Cell::new(u64::MAX),
        })
    }

    /// Allows so much more work.
    pub(super) fn allow(&self, work: u64) {
        self.allowed.set(self.spent.get().saturating_add(work));
    }

    /// Work done so far.
    pub(super) fn spent(&self) -> u64 {
        self.spent.get()
    }

    /// Work that is left; none where the search is asked to end.
    pub(super) fn left(&self) -> u64 {
        match interruption::asked() {
            true => 0,
            false => self.allowed.get().saturating_sub(self.spent.get()),
        }
    }

    /// Counts work done elsewhere.
    pub(super) fn spend(&self, work: u64) {
        self.spent.set(self.spent.get().saturating_add(work));
    }

    pub(super) fn variables(&self) -> usize {
        self.monomials.variables()
    }

    pub(super) fn count(&self) -> usize {
        self.equations.len()
    }

    /// Truncation degree.
    pub(super) fn degree(&self) -> usize {
        self.monomials.degree()
    }

    /// Smallest and largest degree of a leading form.
    pub(super) fn lowest(&self) -> (usize, usize) {
        let degrees = self.equations.iter().map(|e| e.lowest);
        (
            degrees.clone().min().unwrap_or(0),
            degrees.max().unwrap_or(0),
        )
    }

    /// Coefficients of the weighted sum Σ weights\[j\]·κ_j.
    pub(super) fn combination(&self, weights: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.monomials.count()];
        for (equation, weight) in self.equations.iter().zip(weights) {
            for (slot, c) in sum.iter_mut().zip(&equation.coefficients) {
                *slot += weight * c;
            }
        }
        sum
    }

    pub(super) fn monomials(&self) -> &Monomials {
        &self.monomials
    }

    /// The equations on the linear space spanned by `basis`, in coordinates along it.
    pub(super) fn restricted(&self, basis: &[Vec<f64>], largest_radius: f64) -> Option<Self> {
        let target = Monomials::new(basis.len(), self.degree()).ok()?;
        let variables: Vec<Series> = (0..self.variables())
            .map(|i| {
                let row: Vec<f64> = basis.iter().map(|b| b[i]).collect();
                Series::linear(&target, &row)
            })
            .collect();
        let mut powers = vec![Series::constant(&target, 1.0)];
        for (parent, variable) in &self.parents[1..] {
            let power = &powers[*parent as usize] * &variables[usize::from(*variable)];
            powers.push(power);
        }
        let series: Vec<Series> = self
            .equations
            .iter()
            .map(|equation| {
                let mut sum = Series::zero(&target);
                for (index, c) in &equation.terms {
                    sum.add_scaled(*c, &powers[*index as usize]);
                }
                sum
            })
            .collect();
        // A rotation mixes at most all coefficients of one degree.
        let noise = self.noise * (self.variables() as f64).powi(2);
        Self::new(&series, noise.max(1e-15), largest_radius)
    }
}

impl Equation {
    fn new(coefficients: Vec<f64>, monomials: &Monomials, weights: &[f64]) -> Self {
        let sizes: Vec<f64> = (0..=monomials.degree())
            .map(|degree| {
                let range = monomials.of_degree(degree);
                norm(&coefficients[range.clone()], &weights[range])
            })
            .collect();
        let lowest = sizes.iter().position(|size| *size > 0.0).unwrap_or(0);
        let mut terms = Vec::new();
        let mut gradient = Vec::new();
        for (index, &c) in coefficients.iter().enumerate() {
            if c == 0.0 {
                continue;
            }
            terms.push((index as u32, c));
            let mut lower = monomials.exponents(index).to_vec();
            for variable in 0..lower.len() {
                let power = lower[variable];
                if power > 0 {
                    lower[variable] -= 1;
                    if let Some(slot) = monomials.index_of(&lower) {
                        gradient.push((variable as u8, slot as u32, f64::from(power) * c));
                    }
                    lower[variable] += 1;
                }
            }
        }
        Self {
            coefficients,
            terms,
            gradient,
            lowest,
            sizes,
        }
    }
}

fn norm(form: &[f64], weights: &[f64]) -> f64 {
    form.iter()
        .zip(weights)
        .map(|(c, w)| c * c * w)
        .sum::<f64>()
        .sqrt()
}

/// α!/|α|! for every monomial.
fn bombieri_weights(monomials: &Monomials) -> Vec<f64> {
    let factorial = |n: u8| (1..=n).map(f64::from).product::<f64>();
    (0..monomials.count())
        .map(|index| {
            let exponents = monomials.exponents(index);
            let total: f64 = (1..=monomials.degree_of(index)).map(|k| k as f64).product();
            exponents.iter().map(|e| factorial(*e)).product::<f64>() / total
        })
        .collect()
}

fn parents(monomials: &Monomials) -> Vec<(u32, u8)> {
    (0..monomials.count())
        .map(|index| {
            let mut lower = monomials.exponents(index).to_vec();
            let variable = lower.iter().position(|e| *e > 0).unwrap_or(0);
            if let Some(e) = lower.get_mut(variable) {
                *e = e.saturating_sub(1);
            }
            let parent = monomials.index_of(&lower).unwrap_or(0);
            (parent as u32, variable as u8)
        })
        .collect()
}

/// Buffers for evaluation.
#[derive(Clone, Debug, Default)]
pub(super) struct Work {
    monomials: Vec<f64>,
    /// Weighted values of the equations.
    pub(super) values: Vec<f64>,
    /// Weighted derivatives by the coordinates on the unit sphere, one row per equation.
    pub(super) jacobian: Vec<Vec<f64>>,
}

/// The equations on the sphere of one radius: y = radius·z with |z| = 1, each equation divided by the size its
/// homogeneous parts can reach there.
#[derive(Clone, Debug)]
pub(super) struct Level<'a> {
    pub(super) system: &'a System,
    pub(super) radius: f64,
    weights: Vec<f64>,
    tolerances: Vec<f64>,
    truncations: Vec<f64>,
}

impl<'a> Level<'a> {
    pub(super) fn new(system: &'a System, radius: f64) -> Self {
        let degree = system.degree();
        let relative = radius / system.radius;
        let spread = (system.variables() as f64).sqrt() * radius;
        let mut level = Self {
            system,
            radius,
            weights: Vec::new(),
            tolerances: Vec::new(),
            truncations: Vec::new(),
        };
        for equation in &system.equations {
            let parts =
                (equation.lowest..=degree).map(|k| equation.sizes[k] * radius.powi(k as i32));
            let scale = parts.clone().fold(0.0, f64::max);
            // |Σ e_α y^α| ≤ e·(Σ|y_i|)^k ≤ e·(√δ·radius)^k for coefficients wrong by e in degree k; a few roundings of
            // every part besides.
            let noise: f64 = (equation.lowest..=degree)
                .map(|k| spread.powi(k as i32))
                .sum();
            let rounding = 16.0 * f64::EPSILON * parts.sum::<f64>();
            level.weights.push(1.0 / scale);
            level
                .tolerances
                .push((system.noise * noise + rounding) / scale);
            // The first part that was cut off, were it as large as the bound on the others allows.
            let order = degree + 1 - equation.lowest;
            level.truncations.push(relative.powi(order as i32));
        }
        level
    }

    /// Values and derivatives at the point radius·z.
    pub(super) fn evaluate(&self, z: &[f64], work: &mut Work) {
        let system = self.system;
        system.spend(system.cost);
        work.monomials.resize(system.parents.len(), 0.0);
        work.monomials[0] = 1.0;
        for (index, (parent, variable)) in system.parents.iter().enumerate().skip(1) {
            work.monomials[index] =
                work.monomials[*parent as usize] * (self.radius * z[usize::from(*variable)]);
        }
        work.values.resize(system.count(), 0.0);
        work.jacobian.resize(system.count(), Vec::new());
        for (j, equation) in system.equations.iter().enumerate() {
            let weight = self.weights[j];
            let value: f64 = equation
                .terms
                .iter()
                .map(|(index, c)| c * work.monomials[*index as usize])
                .sum();
            work.values[j] = weight * value;
            let row = &mut work.jacobian[j];
            row.clear();
            row.resize(z.len(), 0.0);
            for (variable, index, c) in &equation.gradient {
                row[usize::from(*variable)] += c * work.monomials[*index as usize];
            }
            row.iter_mut().for_each(|d| *d *= weight * self.radius);
        }
    }

    /// Largest value in units of what noise and rounding explain: zero as far as can be told where this is at most 1.
    pub(super) fn above_noise(&self, values: &[f64]) -> f64 {
        values
            .iter()
            .zip(&self.tolerances)
            .fold(0.0, |m, (v, t)| f64::max(m, v.abs() / t))
    }

    /// Largest value in units of what noise and the terms beyond the truncation explain.
    pub(super) fn above_truncation(&self, values: &[f64]) -> f64 {
        values
            .iter()
            .zip(self.tolerances.iter().zip(&self.truncations))
            .fold(0.0, |m, (v, (t, c))| f64::max(m, v.abs() / (t + 3.0 * c)))
    }

    /// Largest tolerance of an equation, relative to its size at this radius.
    pub(super) fn tolerance(&self) -> f64 {
        self.tolerances.iter().copied().fold(0.0, f64::max)
    }

    /// |κ|, each equation in units of its size at the system's own radius: comparable between radii.
    pub(super) fn absolute(&self, values: &[f64]) -> f64 {
        let unweighted: Vec<f64> = values
            .iter()
            .enumerate()
            .map(|(j, v)| {
                let equation = &self.system.equations[j];
                let size = equation.sizes[equation.lowest]
                    * self.system.radius.powi(equation.lowest as i32);
                v / self.weights[j] / size
            })
            .collect();
        dot(&unweighted, &unweighted).sqrt()
    }

    /// Weights that bring the equations to comparable size here.
    pub(super) fn weights(&self) -> &[f64] {
        &self.weights
    }
}
