//! Quadratic forms in many digits as sums of squares (Lagrange's reduction).

use crate::leftover::{Doubt, power_of_two};
use kutzbach_math::matrix::{Extended, Real, Ring};

/// A symmetric matrix Q with Q(Σ xₖ vₖ) = Σ dₖ xₖ², as far as its entries are known.
pub(super) struct Diagonal {
    /// What is not zero, with its vectors.
    pub squares: Vec<(Extended, Vec<Extended>)>,
    /// Vectors that span the null space.
    pub null: Vec<Vec<Extended>>,
}

impl Diagonal {
    /// Of a matrix whose entries are known to an error.
    ///
    /// # Errors
    /// [`Doubt::Precision`] where an entry is neither zero nor clearly different from it.
    pub fn of(mut form: Vec<Vec<Extended>>, error: &Extended) -> Result<Self, Doubt> {
        let size = form.len();
        let one = error.one_like();
        let unit = |i: usize| -> Vec<Extended> {
            let entry = |j: usize| one.constant(if i == j { 1.0 } else { 0.0 });
            (0..size).map(entry).collect()
        };
        let mut vectors: Vec<Vec<Extended>> = (0..size).map(unit).collect();
        let [zero, clear] = [ZERO, CLEAR].map(|factor| error.clone() * one.constant(factor));
        let mut done = 0;
        while done < size {
            let (row, column, most) = largest(&form, done);
            if !most.is_finite() {
                return Err(Doubt::Arithmetic);
            }
            if most <= zero {
                break;
            }
            if most < clear {
                return Err(Doubt::Precision);
            }
            let quarter = one.constant(0.25) * most;
            let on_diagonal = (done..size).fold(done, |best, i| {
                if form[i][i].abs() > form[best][best].abs() {
                    i
                } else {
                    best
                }
            });
            let pivot = if form[on_diagonal][on_diagonal].abs() >= quarter {
                on_diagonal
            } else {
                // Both are small on the diagonal: their sum is not.
                add(&mut form, &mut vectors, &one, column, row);
                row
            };
            vectors.swap(done, pivot);
            form.swap(done, pivot);
            form.iter_mut()
                .for_each(|entries| entries.swap(done, pivot));
            for other in done + 1..size {
                let share = -(form[done][other].clone() / form[done][done].clone());
                add(&mut form, &mut vectors, &share, done, other);
            }
            done += 1;
        }
        let null = vectors.split_off(done);
        let squares = vectors
            .into_iter()
            .enumerate()
            .map(|(k, vector)| (form[k][k].clone(), vector))
            .collect();
        Ok(Self { squares, null })
    }

    /// The solution x of Q x = b where Q has full rank.
    pub fn solve(&self, right: &[Extended]) -> Vec<Extended> {
        let zero = right[0].zero_like();
        let mut x = vec![zero.clone(); right.len()];
        for (square, vector) in &self.squares {
            let along = zero.dot(vector, right) / square.clone();
            along.add_scaled(vector, &mut x);
        }
        x
    }

    /// How many squares are positive, and how many negative.
    pub fn signature(&self) -> (usize, usize) {
        let plus = |(square, _): &&(Extended, Vec<Extended>)| *square > square.zero_like();
        let plus = self.squares.iter().filter(plus).count();
        (plus, self.squares.len() - plus)
    }

    /// The smallest square has at least 2^−this of the largest.
    pub fn narrow(&self) -> i64 {
        let sizes = || self.squares.iter().map(|(square, _)| square.abs());
        let by = |a: &Extended, b: &Extended| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal);
        let (Some(least), Some(most)) = (sizes().min_by(by), sizes().max_by(by)) else {
            return 0;
        };
        let mut bits = 0;
        while bits < NARROWEST && least.clone() * power_of_two(&least, bits) < most {
            bits += 1;
        }
        bits
    }
}

/// Up to so many times its error a number is zero, from so many times on it is not; in between nothing is said.
pub(super) const ZERO: f64 = 1e6;
pub(super) const CLEAR: f64 = 1e18;

/// Smaller squares are told as small as 2^−this.
const NARROWEST: i64 = 1000;

/// The place and size of the largest entry in rows and columns from `from` on.
fn largest(form: &[Vec<Extended>], from: usize) -> (usize, usize, Extended) {
    let mut most = (from, from, form[from][from].abs());
    for (row, entries) in form.iter().enumerate().skip(from) {
        for (column, entry) in entries.iter().enumerate().skip(from) {
            if entry.abs() > most.2 {
                most = (row, column, entry.abs());
            }
        }
    }
    most
}

/// Adds a share of one vector to another, and what that makes of the matrix.
fn add(
    form: &mut [Vec<Extended>],
    vectors: &mut [Vec<Extended>],
    share: &Extended,
    from: usize,
    to: usize,
) {
    let row = form[from].clone();
    share.add_scaled(&row, &mut form[to]);
    for entries in form.iter_mut() {
        entries[to] = entries[to].clone() + share.clone() * entries[from].clone();
    }
    let vector = vectors[from].clone();
    share.add_scaled(&vector, &mut vectors[to]);
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn diagonal(rows: &[[f64; 3]; 3]) -> Result<Diagonal, Doubt> {
        let one = Extended::new(1.0, 400);
        let form = rows
            .iter()
            .map(|row| row.iter().map(|x| one.constant(*x)).collect())
            .collect();
        Diagonal::of(form, &power_of_two(&one, -300))
    }

    #[test]
    fn signatures_are_found_however_small_the_squares() {
        for (rows, signature) in [
            (
                [[1.0, 0.0, 0.0], [0.0, 1e-30, 0.0], [0.0, 0.0, -1e-60]],
                (2, 1),
            ),
            ([[0.0, 0.5, 0.0], [0.5, 0.0, 0.0], [0.0; 3]], (1, 1)),
            // x (x + 1e-9 (y + z)).
            (
                [[1.0, 5e-10, 5e-10], [5e-10, 0.0, 0.0], [5e-10, 0.0, 0.0]],
                (1, 1),
            ),
            ([[0.0, 1.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.0]], (1, 2)),
            ([[0.0; 3]; 3], (0, 0)),
        ] {
            let found = diagonal(&rows).unwrap();
            assert_eq!(found.signature(), signature, "{rows:?}");
            assert_eq!(found.null.len() + found.squares.len(), 3);
            let one = Extended::new(1.0, 400);
            let image = |vector: &[Extended]| -> Vec<f64> {
                let row = |row: &[f64; 3]| {
                    let row: Vec<Extended> = row.iter().map(|x| one.constant(*x)).collect();
                    one.dot(&row, vector).to_f64()
                };
                rows.iter().map(row).collect()
            };
            for vector in &found.null {
                assert!(image(vector).iter().all(|x| x.abs() < 1e-80), "{rows:?}");
            }
        }
    }

    #[test]
    fn what_is_all_below_the_error_is_zero() {
        let form = [[1e-85, 0.0, 3e-86], [0.0, -2e-85, 0.0], [3e-86, 0.0, 0.0]];
        assert_eq!(diagonal(&form).unwrap().signature(), (0, 0));
    }

    #[test]
    fn what_is_neither_zero_nor_clear_is_not_told() {
        let form = [[1.0, 0.0, 0.0], [0.0, 2f64.powi(-260), 0.0], [0.0; 3]];
        assert_eq!(diagonal(&form).err(), Some(Doubt::Precision));
    }

    #[test]
    fn a_form_of_full_rank_is_solved() {
        let rows = [[0.0, 1.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1e-12]];
        let found = diagonal(&rows).unwrap();
        let one = Extended::new(1.0, 400);
        let right: Vec<Extended> = [1.0, -2.0, 0.25].iter().map(|x| one.constant(*x)).collect();
        let x = found.solve(&right);
        for (row, wanted) in rows.iter().zip(&right) {
            let row: Vec<Extended> = row.iter().map(|x| one.constant(*x)).collect();
            let left = one.dot(&row, &x) - wanted.clone();
            assert!(left.abs().to_f64() < 1e-80);
        }
        assert_eq!(found.narrow(), 2);
    }
}
