//! Sparse matrices with rows in blocks, as the loops of a mechanism give them.

use super::error::MatrixError;
use super::real::{Real, Ring};
use crate::interruption;

/// A sparse matrix stored by rows, its rows grouped in consecutive blocks.
///
/// The rows of one block are meant to touch nearly the same columns (the six closure equations of
/// one cycle touch the joints of that cycle); eliminations treat a block as one small dense matrix.
/// The grouping changes speed, never results. Entries are never stored as exact zeros.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseMatrix<T> {
    rows: usize,
    columns: usize,
    zero: T,
    /// Start of each row in `entries`; one more than there are rows.
    row_starts: Vec<usize>,
    /// Column and value, columns increasing inside a row.
    entries: Vec<(usize, T)>,
    /// First row of each block; increasing, starts at 0 unless there are no rows.
    block_starts: Vec<usize>,
}

impl<T: Ring> SparseMatrix<T> {
    /// Builds a matrix from (row, column, value) triplets in any order; repeated positions add up.
    ///
    /// `zero` tells the arithmetic (its precision), which a matrix without entries could not. Each
    /// row starts as a block of its own.
    ///
    /// # Errors
    /// [`MatrixError::OutOfShape`] for an entry outside the shape; [`MatrixError::Interrupted`].
    pub fn from_triplets(
        rows: usize,
        columns: usize,
        zero: T,
        triplets: impl IntoIterator<Item = (usize, usize, T)>,
    ) -> Result<Self, MatrixError> {
        interruption::look()?;
        let mut all: Vec<(usize, usize, T)> = triplets.into_iter().collect();
        if let Some(&(row, column, _)) = all.iter().find(|t| t.0 >= rows || t.1 >= columns) {
            return Err(MatrixError::OutOfShape {
                row,
                column,
                rows,
                columns,
            });
        }
        // Stable, so that repeated positions are added in the order given.
        all.sort_by_key(|t| (t.0, t.1));
        let mut row_starts = vec![0; rows + 1];
        let mut entries: Vec<(usize, T)> = Vec::with_capacity(all.len());
        let mut triplets = all.into_iter().peekable();
        while let Some((row, column, mut value)) = triplets.next() {
            while let Some((_, _, more)) = triplets.next_if(|t| t.0 == row && t.1 == column) {
                value = value + more;
            }
            if !value.is_zero() {
                entries.push((column, value));
                row_starts[row + 1] += 1;
            }
        }
        for row in 0..rows {
            row_starts[row + 1] += row_starts[row];
        }
        Ok(Self {
            rows,
            columns,
            zero: zero.zero_like(),
            row_starts,
            entries,
            block_starts: (0..rows).collect(),
        })
    }

    /// The same matrix with its rows grouped: `starts` are the first rows of the blocks.
    ///
    /// # Errors
    /// [`MatrixError::RowBlocks`] unless the starts begin with 0, increase and are below the
    /// number of rows (an empty list is right for no rows only).
    pub fn with_row_blocks(mut self, starts: Vec<usize>) -> Result<Self, MatrixError> {
        if starts.is_empty() && self.rows > 0 {
            return Err(MatrixError::Length {
                what: "row block starts",
                expected: 1,
                found: 0,
            });
        }
        for (block, &start) in starts.iter().enumerate() {
            let follows = match block {
                0 => start == 0,
                _ => start > starts[block - 1],
            };
            if !follows || start >= self.rows {
                return Err(MatrixError::RowBlocks {
                    block,
                    start,
                    rows: self.rows,
                });
            }
        }
        self.block_starts = starts;
        Ok(self)
    }

    /// The same matrix with blocks of `height` rows (the last may be shorter); 0 counts as 1.
    #[must_use]
    pub fn with_row_blocks_of(mut self, height: usize) -> Self {
        self.block_starts = (0..self.rows).step_by(height.max(1)).collect();
        self
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of stored entries, all different from zero.
    #[must_use]
    pub fn entry_count(&self) -> usize {
        self.entries.len()
    }

    /// Zero in the arithmetic of the matrix.
    #[must_use]
    pub fn zero(&self) -> &T {
        &self.zero
    }

    /// The entries of one row as (column, value), columns increasing; empty outside the shape.
    #[must_use]
    pub fn row(&self, row: usize) -> &[(usize, T)] {
        match (self.row_starts.get(row), self.row_starts.get(row + 1)) {
            (Some(&start), Some(&end)) => &self.entries[start..end],
            _ => &[],
        }
    }

    /// Number of row blocks.
    #[must_use]
    pub fn block_count(&self) -> usize {
        self.block_starts.len()
    }

    /// The rows of one block; empty outside the list of blocks.
    #[must_use]
    pub fn block_rows(&self, block: usize) -> std::ops::Range<usize> {
        let end = |i: usize| self.block_starts.get(i).copied().unwrap_or(self.rows);
        end(block)..end(block + 1)
    }

    /// All entries as (row, column, value), row by row.
    pub fn triplets(&self) -> impl Iterator<Item = (usize, usize, &T)> {
        (0..self.rows).flat_map(|row| {
            self.row(row)
                .iter()
                .map(move |(column, value)| (row, *column, value))
        })
    }

    /// The transpose. Each of its rows is a block of its own.
    #[must_use]
    pub fn transpose(&self) -> Self {
        let mut row_starts = vec![0; self.columns + 1];
        for (column, _) in &self.entries {
            row_starts[column + 1] += 1;
        }
        for column in 0..self.columns {
            row_starts[column + 1] += row_starts[column];
        }
        let mut next = row_starts.clone();
        let mut entries = vec![(0, self.zero.clone()); self.entries.len()];
        for (row, column, value) in self.triplets() {
            entries[next[column]] = (row, value.clone());
            next[column] += 1;
        }
        Self {
            rows: self.columns,
            columns: self.rows,
            zero: self.zero.clone(),
            row_starts,
            entries,
            block_starts: (0..self.columns).collect(),
        }
    }

    /// A x, of length `rows`.
    ///
    /// # Errors
    /// [`MatrixError::Length`] unless `x` has one element per column.
    pub fn multiply(&self, x: &[T]) -> Result<Vec<T>, MatrixError> {
        check_length("vector multiplied from the right", self.columns, x.len())?;
        let products = (0..self.rows).map(|row| {
            self.row(row)
                .iter()
                .fold(self.zero.clone(), |sum, (column, value)| {
                    sum + value.clone() * x[*column].clone()
                })
        });
        Ok(products.collect())
    }

    /// Aᵀ y, of length `columns`.
    ///
    /// # Errors
    /// [`MatrixError::Length`] unless `y` has one element per row.
    pub fn multiply_transposed(&self, y: &[T]) -> Result<Vec<T>, MatrixError> {
        check_length("vector multiplied from the left", self.rows, y.len())?;
        let mut product = vec![self.zero.clone(); self.columns];
        for (row, column, value) in self.triplets() {
            product[column] = product[column].clone() + value.clone() * y[row].clone();
        }
        Ok(product)
    }

    /// The same pattern with each entry replaced; results that are zero are dropped.
    #[must_use]
    pub fn map<U: Ring>(&self, zero: &U, convert: impl Fn(&T) -> U) -> SparseMatrix<U> {
        let mut row_starts = Vec::with_capacity(self.rows + 1);
        let mut entries = Vec::with_capacity(self.entries.len());
        row_starts.push(0);
        for row in 0..self.rows {
            for (column, value) in self.row(row) {
                let value = convert(value);
                if !value.is_zero() {
                    entries.push((*column, value));
                }
            }
            row_starts.push(entries.len());
        }
        SparseMatrix {
            rows: self.rows,
            columns: self.columns,
            zero: zero.zero_like(),
            row_starts,
            entries,
            block_starts: self.block_starts.clone(),
        }
    }
}

impl<T> SparseMatrix<T> {
    /// Whether shape and blocks are those of another matrix.
    pub(crate) fn has_shape_of<U>(&self, other: &SparseMatrix<U>) -> bool {
        (self.rows, self.columns) == (other.rows, other.columns)
            && self.block_starts == other.block_starts
    }

    /// Whether another matrix of the same shape has entries only where this one has some.
    pub(crate) fn covers<U>(&self, other: &SparseMatrix<U>) -> bool {
        (0..self.rows).all(|row| {
            let own = &self.entries[self.row_starts[row]..self.row_starts[row + 1]];
            let mut own = own.iter().map(|(column, _)| column);
            let others = &other.entries[other.row_starts[row]..other.row_starts[row + 1]];
            others.iter().all(|(column, _)| own.any(|c| c == column))
        })
    }
}

impl<R: Real> SparseMatrix<R> {
    /// The entries of two matrices of the same shape, all one.
    pub(crate) fn united(&self, other: &Self) -> Self {
        let mut both = self.clone();
        both.row_starts = vec![0];
        both.entries.clear();
        for row in 0..self.rows {
            let all = self.row(row).iter().chain(other.row(row));
            let mut columns: Vec<usize> = all.map(|(column, _)| *column).collect();
            columns.sort_unstable();
            columns.dedup();
            let one = self.zero.constant(1.0);
            both.entries
                .extend(columns.into_iter().map(|column| (column, one.clone())));
            both.row_starts.push(both.entries.len());
        }
        both
    }

    /// Largest magnitude among the entries as a double, zero for a matrix without entries.
    ///
    /// # Errors
    /// [`MatrixError::NotFinite`] for the first entry that is NaN, infinite, or beyond the range
    /// of doubles; [`MatrixError::Interrupted`], since every decomposition begins here.
    pub fn largest_entry(&self) -> Result<f64, MatrixError> {
        interruption::look()?;
        let mut largest = 0.0f64;
        for row in 0..self.rows {
            for (column, value) in self.row(row) {
                let size = Real::to_f64(&value.abs());
                if !size.is_finite() {
                    let column = *column;
                    return Err(MatrixError::NotFinite { row, column });
                }
                largest = largest.max(size);
            }
        }
        Ok(largest)
    }

    /// Divides each column by its Euclidean length and returns the lengths.
    ///
    /// Columns without entries stay zero and report length zero. Rank is unchanged; null vectors of
    /// the scaled matrix are those of the original with component j multiplied by length j.
    pub fn scale_columns(&mut self) -> Vec<R> {
        let mut by_column: Vec<Vec<R>> = vec![Vec::new(); self.columns];
        for (column, value) in &self.entries {
            by_column[*column].push(value.clone());
        }
        let lengths: Vec<R> = by_column
            .iter()
            .map(|column| self.zero.norm(column))
            .collect();
        for (column, value) in &mut self.entries {
            *value = value.clone() / lengths[*column].clone();
        }
        lengths
    }
}

fn check_length(what: &'static str, expected: usize, found: usize) -> Result<(), MatrixError> {
    if expected == found {
        Ok(())
    } else {
        Err(MatrixError::Length {
            what,
            expected,
            found,
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn example() -> SparseMatrix<f64> {
        // [ 1 0 2 ]
        // [ 0 0 0 ]
        // [ 0 0 3 ]
        // [ 4 0 0 ]
        SparseMatrix::from_triplets(
            4,
            3,
            0.0,
            vec![
                (3, 0, 4.0),
                (0, 2, 2.0),
                (0, 0, 0.25),
                (0, 0, 0.75),
                (2, 2, 3.0),
                (1, 1, 5.0),
                (1, 1, -5.0),
            ],
        )
        .unwrap()
    }

    #[test]
    fn triplets_are_sorted_summed_and_cancelled() {
        let matrix = example();
        assert_eq!(matrix.row(0), &[(0, 1.0), (2, 2.0)]);
        assert_eq!(matrix.row(1), &[]);
        assert_eq!(matrix.entry_count(), 4);
        assert_eq!(matrix.row(99), &[]);
    }

    #[test]
    fn products_with_the_matrix_and_its_transpose() {
        let matrix = example();
        assert_eq!(
            matrix.multiply(&[1.0, 7.0, 2.0]).unwrap(),
            [5.0, 0.0, 6.0, 4.0]
        );
        let y = [1.0, 1.0, 2.0, 3.0];
        let expected = [13.0, 0.0, 8.0];
        assert_eq!(matrix.multiply_transposed(&y).unwrap(), expected);
        assert_eq!(matrix.transpose().multiply(&y).unwrap(), expected);
        assert_eq!(matrix.transpose().transpose(), matrix);
        assert!(matrix.multiply(&y).is_err());
        assert!(matrix.multiply_transposed(&[1.0]).is_err());
    }

    #[test]
    fn columns_become_unit_and_zero_columns_stay() {
        let mut matrix = example();
        let lengths = matrix.scale_columns();
        assert_eq!(lengths[1], 0.0);
        assert!((lengths[0] - 17f64.sqrt()).abs() < 1e-15);
        assert!((matrix.row(2)[0].1 - 3.0 / 13f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn blocks_are_checked() {
        let matrix = example();
        assert!(matrix.clone().with_row_blocks(vec![]).is_err());
        assert!(matrix.clone().with_row_blocks(vec![1]).is_err());
        assert!(matrix.clone().with_row_blocks(vec![0, 2, 2]).is_err());
        assert!(matrix.clone().with_row_blocks(vec![0, 4]).is_err());
        let grouped = matrix.with_row_blocks(vec![0, 3]).unwrap();
        assert_eq!(grouped.block_rows(0), 0..3);
        assert_eq!(grouped.block_rows(1), 3..4);
        assert_eq!(grouped.block_rows(2), 4..4);
        assert_eq!(grouped.with_row_blocks_of(0).block_count(), 4);
    }

    #[test]
    fn entries_outside_the_shape_are_refused() {
        let outside = SparseMatrix::from_triplets(2, 2, 0.0, vec![(0, 2, 1.0)]);
        assert!(matches!(
            outside,
            Err(MatrixError::OutOfShape { column: 2, .. })
        ));
        let empty = SparseMatrix::<f64>::from_triplets(0, 0, 0.0, vec![]).unwrap();
        assert_eq!(empty.multiply(&[]).unwrap(), Vec::<f64>::new());
        assert_eq!(empty.transpose(), empty);
        assert!(empty.with_row_blocks(vec![]).is_ok());
    }
}
