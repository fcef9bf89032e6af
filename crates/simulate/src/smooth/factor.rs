//! The matrix S = G M⁻¹ Gᵀ of all constraints, factored sparsely.
//!
//! A body couples the constraints that act on it, so that S is a sum of one dense block per body, which is what a multifrontal factorization
//! (Duff and Reid 1983, *The multifrontal solution of indefinite sparse symmetric linear equations*) adds up anyway: no sparse matrix is ever
//! formed. In which order constraints are eliminated depends on which bodies they act on and is planned once, by least degree; a row of loops
//! of any length leaves fronts of bounded size, so that a factorization costs time in proportion to its length.
//!
//! Rows that follow from those before them are the rule where bodies move in a plane or a loop is overconstrained. Such a row's pivot is
//! rounding; it is left out, with a multiplier of zero: its constraint is kept by the others.

use kutzbach_math::matrix::ordering;
use std::ops::Range;

/// A pivot below this share of its row's own entry is none. Exact redundancy leaves rounding, some 1e-16 times the number of rows summed;
/// a smallest singular value of σ, relative to its row, leaves σ². So rows count as independent down to σ = 3e-6, where rounding
/// is still 1e-5 of the pivot, which one refinement removes.
const LEAST_PIVOT: f64 = 1e-11;

/// Entries are sums of a few dozen products of numbers near one, in parts of the row's own entry.
const ROUNDING: f64 = 1e-15;

/// Along a row of n bodies the load of all passes through each, so that the rounding of a pivot grows with n²: so many roundings for each
/// pair of rows. A lift of sixty stages leaves 0.05 of it, and pivots of 0.1 of independent rows.
const ADDING_UP: f64 = 1.0;

/// A pivot below this share of its row's own entry magnifies the rounding of what is left below it: some decades below the pivots of a
/// pose that is not singular.
const SMALL: f64 = 1e-4;

/// A pivot that is not clear of what rounding has put it off by is none: next to a singular pose a small pivot magnifies the rounding of
/// those after it.
const CLEAR: f64 = 10.0;

/// Some rows of the constraints and the body that they act on.
#[derive(Clone, Debug)]
pub(super) struct End {
    pub body: usize,
    /// Which constraints.
    pub group: usize,
    /// Where the first of their rows is in the list of all Jacobians.
    pub first: usize,
}

/// One dense step of the elimination.
#[derive(Debug)]
struct Front {
    /// Scalar rows; those eliminated here come first.
    rows: Vec<usize>,
    pivots: usize,
    /// For every body that is merged here, its ends: place of the first row in this front, number of rows, place of the Jacobians.
    bodies: Vec<Vec<(usize, usize, usize)>>,
    /// Fronts whose leftover is merged here, and where each of its rows goes.
    children: Vec<(usize, Vec<usize>)>,
    /// Where its square matrix is, by columns.
    place: usize,
}

/// In which order to eliminate, for one scene.
#[derive(Debug)]
pub(super) struct Elimination {
    fronts: Vec<Front>,
    rows: usize,
    size: usize,
    /// Multiplications of one factorization.
    pub work: f64,
}

/// A factorization S = L D Lᵀ.
#[derive(Clone, Debug, Default)]
pub(super) struct Factor {
    values: Vec<f64>,
    /// 1/D by row; zero for rows that are left out.
    inverse: Vec<f64>,
    diagonal: Vec<f64>,
    /// About how far rounding has put each pivot off: by ε times its row's own entry, and what smaller pivots before have made of theirs.
    noise: Vec<f64>,
}

impl Factor {
    /// How many rows are independent.
    pub fn rank(&self) -> usize {
        self.inverse
            .iter()
            .filter(|inverse| **inverse != 0.0)
            .count()
    }

    /// Whether a row is left out, as one that follows from others.
    pub fn leaves_out(&self, row: usize) -> bool {
        self.inverse[row] == 0.0
    }
}

impl Elimination {
    /// Plans for groups of rows, given by their ranges, and the ends of all groups.
    pub fn new(groups: &[Range<usize>], ends: &[End], bodies: usize) -> Self {
        let mut of_body: Vec<Vec<&End>> = vec![Vec::new(); bodies];
        for end in ends {
            of_body[end.body].push(end);
        }
        let blocks: Vec<Vec<usize>> = of_body
            .iter()
            .map(|ends| {
                let mut groups: Vec<usize> = ends.iter().map(|end| end.group).collect();
                groups.sort_unstable();
                groups.dedup();
                groups
            })
            .collect();
        let plan = ordering::plan(groups.len(), &blocks);
        let mut fronts: Vec<Front> = Vec::with_capacity(plan.fronts.len());
        let (mut place, mut work) = (0, 0.0);
        let total = groups.last().map_or(0, |last| last.end);
        let mut at = vec![usize::MAX; total];
        for front in &plan.fronts {
            let scalar = |nodes: &[usize]| -> Vec<usize> {
                nodes.iter().flat_map(|&g| groups[g].clone()).collect()
            };
            let mut rows = scalar(&front.pivots);
            let pivots = rows.len();
            rows.extend(scalar(&front.border));
            for (position, &row) in rows.iter().enumerate() {
                at[row] = position;
            }
            let bodies = front.blocks.iter().map(|&body| {
                let ends = of_body[body]
                    .iter()
                    .filter(|end| !groups[end.group].is_empty());
                ends.map(|end| {
                    (
                        at[groups[end.group].start],
                        groups[end.group].len(),
                        end.first,
                    )
                })
                .collect()
            });
            let bodies = bodies.collect();
            let children = front.children.iter().map(|&child| {
                let left: &Front = &fronts[child];
                let goes = left.rows[left.pivots..]
                    .iter()
                    .map(|&row| at[row])
                    .collect();
                (child, goes)
            });
            let children = children.collect();
            let n = rows.len();
            work += (pivots * n * n) as f64;
            fronts.push(Front {
                rows,
                pivots,
                bodies,
                children,
                place,
            });
            place += n * n;
        }
        Self {
            fronts,
            rows: total,
            size: place,
            work,
        }
    }

    /// The share of its row's own entry that a pivot has to have.
    fn least_pivot(&self) -> f64 {
        LEAST_PIVOT.max(ADDING_UP * f64::EPSILON * (self.rows as f64).powi(2))
    }

    /// Factors S for Jacobians that are given in units in which all masses are one.
    pub fn factor(&self, jacobians: &[[f64; 6]], factor: &mut Factor) {
        factor.values.resize(self.size, 0.0);
        factor.values.fill(0.0);
        factor.inverse.resize(self.rows, 0.0);
        factor.inverse.fill(0.0);
        factor.diagonal.resize(self.rows, 0.0);
        factor.diagonal.fill(0.0);
        factor.noise.resize(self.rows, 0.0);
        factor.noise.fill(0.0);
        for front in &self.fronts {
            let (before, here) = factor.values.split_at_mut(front.place);
            let n = front.rows.len();
            let matrix = &mut here[..n * n];
            for body in &front.bodies {
                front.add_body(body, jacobians, matrix, &mut factor.diagonal);
            }
            for (child, goes) in &front.children {
                front.add_child(&self.fronts[*child], goes, before, matrix);
            }
            let rows = (
                &factor.diagonal[..],
                &mut factor.noise[..],
                &mut factor.inverse[..],
            );
            front.eliminate(matrix, rows, self.least_pivot());
        }
    }

    /// Solves S x = b in place; rows that are left out get zero.
    pub fn solve(&self, factor: &Factor, x: &mut [f64]) {
        for front in &self.fronts {
            let n = front.rows.len();
            for k in 0..front.pivots {
                let row = front.rows[k];
                if factor.inverse[row] == 0.0 {
                    x[row] = 0.0;
                    continue;
                }
                let known = x[row];
                let column = &factor.values[front.place + k * n..][..n];
                for (l, &below) in column[k + 1..].iter().zip(&front.rows[k + 1..]) {
                    x[below] -= l * known;
                }
            }
        }
        for front in self.fronts.iter().rev() {
            let n = front.rows.len();
            for k in (0..front.pivots).rev() {
                let row = front.rows[k];
                let column = &factor.values[front.place + k * n..][..n];
                let mut sum = x[row] * factor.inverse[row];
                for (l, &below) in column[k + 1..].iter().zip(&front.rows[k + 1..]) {
                    sum -= l * x[below];
                }
                x[row] = if factor.inverse[row] == 0.0 { 0.0 } else { sum };
            }
        }
    }
}

impl Front {
    /// Adds G Gᵀ of one body.
    fn add_body(
        &self,
        ends: &[(usize, usize, usize)],
        jacobians: &[[f64; 6]],
        matrix: &mut [f64],
        diagonal: &mut [f64],
    ) {
        let n = self.rows.len();
        for &(place, rows, first) in ends {
            for k in 0..rows {
                let own = &jacobians[first + k];
                let column = place + k;
                diagonal[self.rows[column]] += product(own, own);
                for &(other, others, start) in ends {
                    for i in 0..others {
                        let row = other + i;
                        if row >= column {
                            matrix[column * n + row] += product(own, &jacobians[start + i]);
                        }
                    }
                }
            }
        }
    }

    fn add_child(&self, child: &Self, goes: &[usize], before: &[f64], matrix: &mut [f64]) {
        let (n, m) = (self.rows.len(), child.rows.len());
        for (j, &to) in goes.iter().enumerate() {
            let column = child.pivots + j;
            let left = &before[child.place + column * m + column..][..m - column];
            for (value, &row) in left.iter().zip(&goes[j..]) {
                let (low, high) = (to.min(row), to.max(row));
                matrix[low * n + high] += value;
            }
        }
    }

    fn eliminate(
        &self,
        matrix: &mut [f64],
        (diagonal, noise, inverse): (&[f64], &mut [f64], &mut [f64]),
        least: f64,
    ) {
        let n = self.rows.len();
        for k in 0..self.pivots {
            let (done, rest) = matrix.split_at_mut((k + 1) * n);
            let column = &mut done[k * n..];
            let (pivot, row) = (column[k], self.rows[k]);
            let off = noise[row] + ROUNDING * diagonal[row];
            if !(pivot > least * diagonal[row] && pivot > CLEAR * off) {
                column[k + 1..].fill(0.0);
                continue;
            }
            inverse[row] = 1.0 / pivot;
            let small = pivot < SMALL * diagonal[row];
            for j in k + 1..n {
                let share = column[j] / pivot;
                if share != 0.0 {
                    let own = &mut rest[(j - k - 1) * n + j..][..n - j];
                    for (entry, l) in own.iter_mut().zip(&column[j..]) {
                        *entry -= share * l;
                    }
                }
            }
            for (entry, &below) in column[k + 1..].iter_mut().zip(&self.rows[k + 1..]) {
                *entry /= pivot;
                // To first order a pivot that is off by δ puts what is left below off by l² δ. Along a row of ordinary pivots these are of
                // either sign and do not add up to more than `least_pivot` allows for.
                let share = *entry * *entry;
                let passed = if small { share } else { share.min(1.0) };
                noise[below] = noise[below].max(passed * off);
            }
        }
    }
}

fn product(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kutzbach_math::matrix::SplitMix64;

    /// A ring of bodies, each held to the next by rows of which the last repeats the sum of two others.
    fn ring(bodies: usize, rows: usize) -> (Vec<Range<usize>>, Vec<End>, Vec<[f64; 6]>) {
        let mut random = SplitMix64::new(7);
        let mut number = move || random.symmetric();
        let groups = (0..bodies).map(|g| g * rows..(g + 1) * rows).collect();
        let mut ends = Vec::new();
        let mut jacobians: Vec<[f64; 6]> = Vec::new();
        for group in 0..bodies {
            for body in [group, (group + 1) % bodies] {
                let first = jacobians.len();
                ends.push(End { body, group, first });
                jacobians.extend((1..rows).map(|_| std::array::from_fn(|_| number())));
                let (a, b) = (jacobians[first], jacobians[first + 1]);
                jacobians.push(std::array::from_fn(|i| a[i] + b[i]));
            }
        }
        (groups, ends, jacobians)
    }

    fn times(groups: &[Range<usize>], ends: &[End], jacobians: &[[f64; 6]], x: &[f64]) -> Vec<f64> {
        let bodies = ends.iter().map(|end| end.body + 1).max().unwrap_or(0);
        let mut pushed = vec![[0.0; 6]; bodies];
        let mut product_of = vec![0.0; x.len()];
        for end in ends {
            for (i, row) in groups[end.group].clone().enumerate() {
                for k in 0..6 {
                    pushed[end.body][k] += jacobians[end.first + i][k] * x[row];
                }
            }
        }
        for end in ends {
            for (i, row) in groups[end.group].clone().enumerate() {
                product_of[row] += product(&jacobians[end.first + i], &pushed[end.body]);
            }
        }
        product_of
    }

    #[test]
    fn redundant_rows_are_left_out_and_the_rest_is_solved() {
        let (groups, ends, jacobians) = ring(9, 4);
        let elimination = Elimination::new(&groups, &ends, 9);
        let mut factor = Factor::default();
        elimination.factor(&jacobians, &mut factor);
        let left_out = (0..36).filter(|&row| factor.leaves_out(row)).count();
        assert_eq!(left_out, 9);
        let wanted: Vec<f64> = (0..36).map(|i| f64::from(i).sin()).collect();
        let right = times(&groups, &ends, &jacobians, &wanted);
        let mut found = right.clone();
        elimination.solve(&factor, &mut found);
        let again = times(&groups, &ends, &jacobians, &found);
        for (a, b) in again.iter().zip(&right) {
            assert!((a - b).abs() < 1e-11, "{a} {b}");
        }
    }

    #[test]
    fn work_is_in_proportion_to_the_length_of_a_ring() {
        let work = |bodies| {
            let (groups, ends, _) = ring(bodies, 4);
            Elimination::new(&groups, &ends, bodies).work
        };
        assert!(work(400) < 11.0 * work(40), "{} {}", work(400), work(40));
    }
}
