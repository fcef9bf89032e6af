//! Linear algebra on the rows of a matrix: modulo a prime by the crate, over the rationals here.
//!
//! Large eliminations are cut into pieces between which the budget is asked, so that a limit is not passed by more than one
//! piece takes (about half a second).

use super::budget::{Budget, Stop};
use super::fraction_free::{Pivot, Primitive, Reduction};
use crate::polynomial::Rational;
use groebner::{F4Field, Reducers, SparseRow, Zp};
use num_traits::{One, Zero};
use std::cell::OnceCell;

/// Rows that are known to be independent, with leading coefficient 1, and rows to be reduced by them.
pub(super) struct Matrix<C> {
    /// Every polynomial once, with the columns of all its multiples.
    pub(super) pivots: Reducers<C>,
    pub(super) rows: Vec<SparseRow<C>>,
    pub(super) columns: usize,
}

/// Coefficients that matrices can be made of.
pub(super) trait Coefficient: Clone + One + Zero {
    /// What is new in the rows: monic rows with leading columns that no pivot has. With them the numbers of rows that
    /// suffice to find them.
    fn echelon(
        matrix: Matrix<Self>,
        learn: bool,
        budget: &Budget,
    ) -> Result<(Vec<SparseRow<Self>>, Vec<usize>), Stop>;

    /// The rows, each fully reduced by the pivots.
    fn reduce(matrix: Matrix<Self>, budget: &Budget) -> Result<Vec<SparseRow<Self>>, Stop>;
}

/// Products of one piece of an elimination.
const PIECE: usize = 200_000_000;

impl Coefficient for Zp {
    fn echelon(
        mut matrix: Matrix<Self>,
        learn: bool,
        budget: &Budget,
    ) -> Result<(Vec<SparseRow<Self>>, Vec<usize>), Stop> {
        let rows = std::mem::take(&mut matrix.rows);
        let piece = rows_at_once(&matrix);
        let known = matrix.pivots.rows.len();
        let mut found: Vec<SparseRow<Self>> = Vec::new();
        let mut live = Vec::new();
        for (number, rows) in rows.chunks(piece).enumerate() {
            budget.toil(effort(rows.len(), &matrix))?;
            for row in &found[matrix.pivots.rows.len() - known..] {
                let at = matrix.pivots.coefficients.len();
                matrix.pivots.coefficients.push(row.coefficients.clone());
                matrix.pivots.rows.push((at, row.columns.clone()));
            }
            let new = if learn {
                let (new, useful) = Zp::echelonize_traced(&matrix.pivots, rows, matrix.columns);
                live.extend(useful.into_iter().map(|i| number * piece + i));
                new
            } else {
                Zp::echelonize(&matrix.pivots, rows, matrix.columns)
            };
            found.extend(new.into_iter().filter(|row| !row.columns.is_empty()));
        }
        if rows.len() > piece {
            found = reduced_by_each_other(found, matrix.columns, budget)?;
        }
        Ok((found, live))
    }

    fn reduce(matrix: Matrix<Self>, budget: &Budget) -> Result<Vec<SparseRow<Self>>, Stop> {
        let mut reduced = Vec::with_capacity(matrix.rows.len());
        for rows in matrix.rows.chunks(rows_at_once(&matrix)) {
            budget.toil(effort(rows.len(), &matrix))?;
            reduced.extend(Zp::reduce_rows(&matrix.pivots, rows, matrix.columns));
        }
        Ok(reduced)
    }
}

/// Rows with different leading columns, all entries in leading columns of the others removed.
fn reduced_by_each_other(
    rows: Vec<SparseRow<Zp>>,
    columns: usize,
    budget: &Budget,
) -> Result<Vec<SparseRow<Zp>>, Stop> {
    let tails = rows.iter().map(|row| SparseRow {
        columns: row.columns[1..].to_vec(),
        coefficients: row.coefficients[1..].to_vec(),
    });
    let matrix = Matrix {
        rows: tails.collect(),
        pivots: Reducers::from(rows.clone()),
        columns,
    };
    let tails = Zp::reduce(matrix, budget)?;
    let whole = rows.into_iter().zip(tails).map(|(row, mut tail)| {
        tail.columns.insert(0, row.columns[0]);
        tail.coefficients.insert(0, row.coefficients[0]);
        tail
    });
    Ok(whole.collect())
}

/// Reducing one row costs at most the entries of all pivots.
fn rows_at_once<C>(matrix: &Matrix<C>) -> usize {
    (PIECE / most_products(matrix).max(1)).max(1)
}

fn most_products<C>(matrix: &Matrix<C>) -> usize {
    let pivots: usize = matrix.pivots.rows.iter().map(|(_, c)| c.len()).sum();
    pivots + matrix.columns
}

/// Effort of reducing so many rows modulo a prime. Which pivots a row meets is not known before: half of them.
fn effort<C>(rows: usize, matrix: &Matrix<C>) -> u64 {
    rows as u64 * most_products(matrix) as u64 / 2
}

impl Coefficient for Rational {
    fn echelon(
        matrix: Matrix<Self>,
        _learn: bool,
        budget: &Budget,
    ) -> Result<(Vec<SparseRow<Self>>, Vec<usize>), Stop> {
        let mut order: Vec<usize> = (0..matrix.rows.len())
            .filter(|&i| !matrix.rows[i].columns.is_empty())
            .collect();
        order.sort_by_key(|&i| (matrix.rows[i].columns[0], matrix.rows[i].columns.len()));
        let known = Known::new(&matrix);
        let mut found: Vec<SparseRow<Self>> = Vec::new();
        let mut primitive: Vec<Primitive> = Vec::new();
        let mut found_at = vec![NOWHERE; matrix.columns];
        let mut live = Vec::new();
        for i in order {
            let new = |column: usize| {
                let columns = &*found.get(found_at[column])?.columns;
                let values = &primitive[found_at[column]];
                Some(Pivot { columns, values })
            };
            let row = Reduction {
                pivot: |column| known.pivot(column).or_else(|| new(column)),
                width: matrix.columns,
                monic: true,
                budget,
            }
            .of(&matrix.rows[i])?;
            let Some(&first) = row.columns.first() else {
                continue;
            };
            found_at[first as usize] = found.len();
            primitive.push(Primitive::of(&row.coefficients));
            found.push(row);
            live.push(i);
        }
        Ok((found, live))
    }

    fn reduce(matrix: Matrix<Self>, budget: &Budget) -> Result<Vec<SparseRow<Self>>, Stop> {
        let known = Known::new(&matrix);
        let reduction = Reduction {
            pivot: |column| known.pivot(column),
            width: matrix.columns,
            monic: false,
            budget,
        };
        matrix.rows.iter().map(|row| reduction.of(row)).collect()
    }
}

/// No row has this number.
const NOWHERE: usize = usize::MAX;

/// The pivots of a rational matrix by their leading columns.
struct Known<'a> {
    matrix: &'a Matrix<Rational>,
    at: Vec<usize>,
    /// Their numbers, where they have been asked for.
    primitive: Vec<OnceCell<Primitive>>,
}

impl<'a> Known<'a> {
    fn new(matrix: &'a Matrix<Rational>) -> Self {
        let mut at = vec![NOWHERE; matrix.columns];
        for (i, (_, columns)) in matrix.pivots.rows.iter().enumerate() {
            if let Some(&first) = columns.first() {
                at[first as usize] = i;
            }
        }
        let primitive = matrix.pivots.coefficients.iter().map(|_| OnceCell::new());
        Self {
            matrix,
            at,
            primitive: primitive.collect(),
        }
    }

    fn pivot(&self, column: usize) -> Option<Pivot<'_>> {
        let (number, columns) = self.matrix.pivots.rows.get(self.at[column])?;
        let coefficients = &self.matrix.pivots.coefficients[*number];
        let values = self.primitive[*number].get_or_init(|| Primitive::of(coefficients));
        Some(Pivot { columns, values })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn row<C>(entries: Vec<(u32, C)>) -> SparseRow<C> {
        let (columns, coefficients) = entries.into_iter().unzip();
        SparseRow {
            columns,
            coefficients,
        }
    }

    fn matrix<C: Clone>(number: impl Fn(i64) -> C) -> Matrix<C> {
        let numbers =
            |entries: &[(u32, i64)]| row(entries.iter().map(|&(c, v)| (c, number(v))).collect());
        Matrix {
            pivots: Reducers::from(vec![numbers(&[(0, 1), (1, 2), (3, 1)])]),
            rows: vec![
                numbers(&[(0, 2), (1, 5), (2, 1)]),
                numbers(&[(0, 2), (1, 4), (3, 2)]),
                numbers(&[(1, 3), (2, 3), (3, -6)]),
                numbers(&[(2, 7)]),
            ],
            columns: 4,
        }
    }

    #[test]
    fn both_fields_find_the_same_rows() {
        let p = 1_000_003;
        let budget = Budget::unlimited();
        let modulo = |v: i64| Zp::from_i64(v, p);
        let rational = |v: i64| Rational::from_integer(v.into());
        let (new, live) = Rational::echelon(matrix(rational), true, &budget).unwrap();
        assert_eq!((new.len(), live.len()), (2, 2));
        let (image, useful) = Zp::echelon(matrix(modulo), true, &budget).unwrap();
        assert_eq!((image.len(), useful.len()), (2, 2));
        let (image_again, _) = Zp::echelon(matrix(modulo), false, &budget).unwrap();
        assert_eq!(image_again.len(), 2);
        for (a, b) in new.iter().zip(&image) {
            assert_eq!(a.columns[0], b.columns[0]);
        }
        let reduced = Rational::reduce(matrix(rational), &budget).unwrap();
        let image = Zp::reduce(matrix(modulo), &budget).unwrap();
        for (a, b) in reduced.iter().zip(&image) {
            assert_eq!(a.columns, b.columns);
            for (x, y) in a.coefficients.iter().zip(&b.coefficients) {
                assert_eq!(Zp::from_rational(x, p), Some(*y));
            }
        }
    }
}
