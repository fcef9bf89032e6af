//! Sparse elimination as a tree of small dense eliminations, in any arithmetic.
//!
//! The driver merges rows as [`super::ordering`] plans; a [`Kernel`] eliminates inside one dense
//! front. Reals use Householder reflections ([`super::frontal`]), prime fields use Gauss
//! ([`super::modular`]). Both leave the rows of a triangular factor, the [`Triangle`].

use std::ops::Div;

use super::error::MatrixError;
use super::ordering::{EliminationPlan, Front, plan};
use super::random::SplitMix64;
use super::real::Ring;
use super::sparse::SparseMatrix;
use crate::interruption;

/// A dense matrix, column-major, with at least one row wherever a kernel sees it.
#[derive(Clone, Debug)]
pub(crate) struct Dense<T> {
    pub rows: usize,
    pub values: Vec<T>,
}

impl<T> Dense<T> {
    /// Entries of `column` from row `top` on.
    pub fn tail(&self, column: usize, top: usize) -> &[T] {
        &self.values[column * self.rows + top..(column + 1) * self.rows]
    }

    pub fn swap_columns(&mut self, a: usize, b: usize) {
        if a != b {
            let (low, high) = (a.min(b), a.max(b));
            let (left, right) = self.values.split_at_mut(high * self.rows);
            left[low * self.rows..(low + 1) * self.rows].swap_with_slice(&mut right[..self.rows]);
        }
    }
}

/// How to eliminate inside one dense front.
pub(crate) trait Kernel<T> {
    /// Makes the first `pivots` columns upper trapezoidal by operations on rows.
    ///
    /// May permute these columns (and `columns`, their names, alike). Returns the number `kept`:
    /// afterwards rows below `kept` count as zero in all pivot columns, the first `kept` columns
    /// are triangular, and the pivot columns after them were dropped.
    fn eliminate_pivots(
        &mut self,
        dense: &mut Dense<T>,
        columns: &mut [usize],
        pivots: usize,
    ) -> usize;

    /// Makes `column` zero below row `top`; false, and nothing done, if it is zero from `top` on.
    fn eliminate_column(&mut self, dense: &mut Dense<T>, column: usize, top: usize) -> bool;
}

/// Rows of the triangular factor that one front produced.
#[derive(Clone, Debug)]
struct FrontRows<T> {
    /// Global columns: kept pivots in the order of elimination, then dropped ones, then the border.
    columns: Vec<usize>,
    /// Number of kept pivots, which is the number of rows.
    kept: usize,
    /// `kept` × `columns.len()`, column-major; upper triangular on the kept pivots.
    values: Vec<T>,
}

impl<T> FrontRows<T> {
    /// The entries of all rows in the column at `position` of `columns`.
    fn column(&self, position: usize) -> &[T] {
        &self.values[position * self.kept..(position + 1) * self.kept]
    }
}

/// The triangular factor \[R₁₁ R₁₂\]: columns ordered as (kept | dropped), R₁₁ nonsingular.
#[derive(Clone, Debug)]
pub struct Triangle<T> {
    columns: usize,
    zero: T,
    fronts: Vec<FrontRows<T>>,
    dropped: Vec<usize>,
    rank: usize,
}

/// The plan for a matrix by its row blocks.
pub(crate) fn prepare<T: Ring>(matrix: &SparseMatrix<T>) -> EliminationPlan {
    let blocks: Vec<Vec<usize>> = (0..matrix.block_count())
        .map(|block| {
            let mut members: Vec<usize> = matrix
                .block_rows(block)
                .flat_map(|row| matrix.row(row).iter().map(|(column, _)| *column))
                .collect();
            members.sort_unstable();
            members.dedup();
            members
        })
        .collect();
    plan(matrix.columns(), &blocks)
}

/// Through how many rows a column passes: the rows of a front, summed over the fronts that contain
/// the column, largest over the columns. At least 1. Bounds the growth of rounding errors.
pub(crate) fn longest_passage<T: Ring>(matrix: &SparseMatrix<T>, plan: &EliminationPlan) -> usize {
    let mut passage = vec![0usize; matrix.columns()];
    let mut left_rows: Vec<usize> = Vec::with_capacity(plan.fronts.len());
    for front in &plan.fronts {
        let own: usize = front
            .blocks
            .iter()
            .map(|&b| matrix.block_rows(b).len())
            .sum();
        let inherited: usize = front.children.iter().map(|&child| left_rows[child]).sum();
        let rows = own + inherited;
        for &column in front.pivots.iter().chain(&front.border) {
            passage[column] += rows;
        }
        left_rows.push(rows.min(front.border.len()));
    }
    passage.into_iter().max().unwrap_or(0).max(1)
}

/// Eliminates a whole matrix as planned. Columns without entries are dropped last.
pub(crate) fn eliminate<T: Ring>(
    matrix: &SparseMatrix<T>,
    plan: &EliminationPlan,
    kernel: &mut impl Kernel<T>,
) -> Triangle<T> {
    let mut progress = Progress {
        matrix,
        position: vec![0; matrix.columns()],
        leftovers: Vec::with_capacity(plan.fronts.len()),
        fronts: Vec::with_capacity(plan.fronts.len()),
        dropped: Vec::new(),
    };
    for front in &plan.fronts {
        progress.eliminate(front, kernel);
    }
    let Progress {
        fronts,
        mut dropped,
        ..
    } = progress;
    dropped.extend_from_slice(&plan.empty_columns);
    Triangle {
        columns: matrix.columns(),
        zero: matrix.zero().clone(),
        rank: fronts.iter().map(|front| front.kept).sum(),
        fronts,
        dropped,
    }
}

struct Progress<'a, T> {
    matrix: &'a SparseMatrix<T>,
    /// Position of a global column inside the current front.
    position: Vec<usize>,
    /// Rows left by each front over its border, until its successor takes them.
    leftovers: Vec<Option<Dense<T>>>,
    fronts: Vec<FrontRows<T>>,
    dropped: Vec<usize>,
}

impl<T: Ring> Progress<'_, T> {
    fn eliminate(&mut self, front: &Front, kernel: &mut impl Kernel<T>) {
        let mut columns = [&front.pivots[..], &front.border[..]].concat();
        let pivots = front.pivots.len();
        let mut dense = self.assemble(front, &columns);
        let mut kept = 0;
        let mut values = Vec::new();
        if dense.rows > 0 {
            kept = kernel.eliminate_pivots(&mut dense, &mut columns, pivots);
            values.reserve_exact(kept * columns.len());
            for column in dense.values.chunks_exact(dense.rows) {
                values.extend_from_slice(&column[..kept]);
            }
        }
        self.dropped.extend_from_slice(&columns[kept..pivots]);
        self.leftovers
            .push(leftover(dense, kernel, kept, pivots, columns.len()));
        self.fronts.push(FrontRows {
            columns,
            kept,
            values,
        });
    }

    /// Stacks the rows of the blocks and of the leftovers of the children.
    fn assemble(&mut self, front: &Front, columns: &[usize]) -> Dense<T> {
        for (position, &column) in columns.iter().enumerate() {
            self.position[column] = position;
        }
        let block_rows = front
            .blocks
            .iter()
            .flat_map(|&block| self.matrix.block_rows(block))
            .filter(|&row| !self.matrix.row(row).is_empty());
        let child_rows: usize = front
            .children
            .iter()
            .filter_map(|&child| self.leftovers[child].as_ref())
            .map(|left| left.rows)
            .sum();
        let rows = block_rows.clone().count() + child_rows;
        let mut dense = Dense {
            rows,
            values: vec![self.matrix.zero().clone(); rows * columns.len()],
        };
        let mut top = 0;
        for row in block_rows {
            for (column, value) in self.matrix.row(row) {
                dense.values[self.position[*column] * rows + top] = value.clone();
            }
            top += 1;
        }
        for &child in &front.children {
            let Some(left) = self.leftovers[child].take() else {
                continue;
            };
            // The border of a child is the end of its list of columns.
            let names = &self.fronts[child].columns;
            let names = &names[names.len() - left.values.len() / left.rows..];
            for (name, column) in names.iter().zip(left.values.chunks_exact(left.rows)) {
                let start = self.position[*name] * rows + top;
                dense.values[start..start + left.rows].clone_from_slice(column);
            }
            top += left.rows;
        }
        dense
    }
}

/// The rows below the kept ones over the border columns, reduced to at most as many as columns.
fn leftover<T: Ring>(
    mut dense: Dense<T>,
    kernel: &mut impl Kernel<T>,
    kept: usize,
    pivots: usize,
    width: usize,
) -> Option<Dense<T>> {
    let mut bottom = dense.rows;
    if bottom - kept > width - pivots {
        bottom = kept;
        for column in pivots..width {
            if bottom < dense.rows && kernel.eliminate_column(&mut dense, column, bottom) {
                bottom += 1;
            }
        }
    }
    let rows = bottom - kept;
    if rows == 0 || width == pivots {
        return None;
    }
    let mut values = Vec::with_capacity(rows * (width - pivots));
    for column in dense.values[pivots * dense.rows..].chunks_exact(dense.rows) {
        values.extend_from_slice(&column[kept..bottom]);
    }
    Some(Dense { rows, values })
}

impl<T> Triangle<T> {
    pub fn rank(&self) -> usize {
        self.rank
    }

    pub fn columns(&self) -> usize {
        self.columns
    }

    pub fn zero(&self) -> &T {
        &self.zero
    }

    pub fn dropped(&self) -> &[usize] {
        &self.dropped
    }

    /// The entries of \[R₁₁ R₁₂\] as (row, global column, value); rows in the order of elimination.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, &T)> {
        self.fronts
            .iter()
            .scan(0, |top, front| {
                let first = *top;
                *top += front.kept;
                Some((first, front))
            })
            .flat_map(|(first, front)| {
                let columns = front.columns.iter().enumerate();
                columns.flat_map(move |(position, &name)| {
                    let values = front.column(position).iter().enumerate();
                    values.map(move |(row, value)| (first + row, name, value))
                })
            })
    }

    /// The kept columns in the order of elimination.
    pub fn kept(&self) -> impl Iterator<Item = usize> {
        self.fronts
            .iter()
            .flat_map(|front| front.columns[..front.kept].iter().copied())
    }

    /// Number of stored entries, the measure of fill.
    pub fn stored(&self) -> usize {
        self.fronts.iter().map(|front| front.values.len()).sum()
    }
}

impl<T: Ring + Div<Output = T>> Triangle<T> {
    /// The null vectors with the given values on the dropped columns.
    pub fn null_vectors(&self, free: &[Vec<T>]) -> Result<Vec<Vec<T>>, MatrixError> {
        free.iter()
            .map(|values| {
                interruption::look()?;
                if values.len() != self.dropped.len() {
                    return Err(MatrixError::Length {
                        what: "values of the dropped columns",
                        expected: self.dropped.len(),
                        found: values.len(),
                    });
                }
                let mut x = vec![self.zero.clone(); self.columns];
                for (&column, value) in self.dropped.iter().zip(values) {
                    x[column] = value.clone();
                }
                self.back_substitute(&mut x);
                Ok(x)
            })
            .collect()
    }

    /// `count` null vectors with random values on the dropped columns.
    pub fn random_null_vectors(
        &self,
        count: usize,
        seed: u64,
        element: impl Fn(&mut SplitMix64) -> T,
    ) -> Vec<Vec<T>> {
        let mut random = SplitMix64::new(seed);
        (0..count)
            .map(|_| {
                let mut x = vec![self.zero.clone(); self.columns];
                for &column in &self.dropped {
                    x[column] = element(&mut random);
                }
                self.back_substitute(&mut x);
                x
            })
            .collect()
    }

    /// Replaces the kept components of `x` so that \[R₁₁ R₁₂\] x equals the kept components given.
    ///
    /// On entry kept components hold the right side (zero for null vectors), dropped components
    /// their values; on return all hold the solution.
    pub fn back_substitute(&self, x: &mut [T]) {
        let mut right = Vec::new();
        for front in self.fronts.iter().rev() {
            right.clear();
            right.extend(
                front.columns[..front.kept]
                    .iter()
                    .map(|&name| x[name].clone()),
            );
            for position in front.kept..front.columns.len() {
                let known = &x[front.columns[position]];
                if !known.is_zero() {
                    (-known.clone()).add_scaled(front.column(position), &mut right);
                }
            }
            for row in (0..front.kept).rev() {
                let column = front.column(row);
                let solved = right[row].clone() / column[row].clone();
                (-solved.clone()).add_scaled(&column[..row], &mut right[..row]);
                right[row] = solved;
            }
            for (&name, solved) in front.columns.iter().zip(right.drain(..)) {
                x[name] = solved;
            }
        }
    }

    /// Replaces the kept components of `x` by the solution y of R₁₁ᵀ y = kept components of `x`.
    ///
    /// Dropped components are neither read nor meaningful afterwards.
    pub fn forward_substitute(&self, x: &mut [T]) {
        let mut solved: Vec<T> = Vec::new();
        for front in &self.fronts {
            solved.clear();
            for row in 0..front.kept {
                let column = front.column(row);
                let known = self.zero.dot(&column[..row], &solved);
                solved.push((x[front.columns[row]].clone() - known) / column[row].clone());
            }
            for position in front.kept..front.columns.len() {
                let name = front.columns[position];
                x[name] = x[name].clone() - self.zero.dot(front.column(position), &solved);
            }
            for (&name, value) in front.columns.iter().zip(solved.drain(..)) {
                x[name] = value;
            }
        }
    }
}
