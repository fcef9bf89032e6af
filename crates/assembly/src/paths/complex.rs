//! Complex numbers, and linear equations of them.

use std::ops::{Add, Mul};

/// What polynomials are computed in.
pub(super) trait Arithmetic: Copy {
    fn integer(n: u32) -> Self;
    fn plus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
}

/// A complex number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Complex {
    pub(super) re: f64,
    pub(super) im: f64,
}

impl Complex {
    pub(super) const ZERO: Self = Self::new(0.0, 0.0);

    pub(super) const fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    pub(super) fn minus(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }

    pub(super) fn scaled(self, by: f64) -> Self {
        Self::new(self.re * by, self.im * by)
    }

    pub(super) fn conjugate(self) -> Self {
        Self::new(self.re, -self.im)
    }

    /// The larger of both parts, in magnitude.
    pub(super) fn size(self) -> f64 {
        self.re.abs().max(self.im.abs())
    }

    fn reciprocal(self) -> Self {
        // Scaled, so that no square overflows.
        let size = self.size();
        let z = self.scaled(1.0 / size);
        let square = z.re * z.re + z.im * z.im;
        z.conjugate().scaled(1.0 / (square * size))
    }
}

impl Arithmetic for Complex {
    fn integer(n: u32) -> Self {
        Self::new(f64::from(n), 0.0)
    }

    fn plus(self, other: Self) -> Self {
        Self::new(self.re.add(other.re), self.im.add(other.im))
    }

    fn times(self, other: Self) -> Self {
        Self::new(
            self.re.mul(other.re) - self.im * other.im,
            self.re.mul(other.im) + self.im * other.re,
        )
    }
}

/// The solutions of linear equations for several right sides, by elimination with partial pivoting; `None` where the matrix has no inverse.
pub(super) fn solved(
    mut matrix: Vec<Vec<Complex>>,
    mut right: Vec<Vec<Complex>>,
) -> Option<Vec<Vec<Complex>>> {
    let count = matrix.len();
    for column in 0..count {
        let largest = |&a: &usize, &b: &usize| {
            let [a, b] = [a, b].map(|row: usize| matrix[row][column].size());
            a.total_cmp(&b)
        };
        let pivot = (column..count).max_by(largest)?;
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        let size = matrix[column][column].size();
        if !(size > 0.0) || !size.is_finite() {
            return None;
        }
        let inverse = matrix[column][column].reciprocal();
        let (own, own_right) = (matrix[column].clone(), right[column].clone());
        for row in column + 1..count {
            let factor = matrix[row][column].times(inverse).scaled(-1.0);
            for (x, y) in matrix[row][column..].iter_mut().zip(&own[column..]) {
                *x = x.plus(factor.times(*y));
            }
            for (x, y) in right[row].iter_mut().zip(&own_right) {
                *x = x.plus(factor.times(*y));
            }
        }
    }
    for row in (0..count).rev() {
        let inverse = matrix[row][row].reciprocal();
        for side in 0..right[row].len() {
            let mut value = right[row][side];
            for later in row + 1..count {
                value = value.minus(matrix[row][later].times(right[later][side]));
            }
            right[row][side] = value.times(inverse);
        }
    }
    Some(right)
}
