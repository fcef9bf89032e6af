//! Numbers that are known to within an error.

use crate::leftover::Doubt;
use kutzbach_math::matrix::Real;

/// Up to so many times its error a number is zero: estimates of errors leave out moderate factors.
const ZERO: f64 = 1024.0;

/// From so many times its error on it is not; in between nothing is said.
const CLEAR: f64 = 1e9;

/// Errors and values below this are none: the range of doubles, in which errors are kept, ends there.
const LEAST: f64 = 1e-300;

/// A number and a bound of its error. Rounding in the arithmetic is taken to be far below the errors that numbers come with.
#[derive(Clone, Debug)]
pub(super) struct Fuzzy<R> {
    pub value: R,
    pub error: f64,
}

impl<R: Real> Fuzzy<R> {
    pub fn exact(value: R) -> Self {
        Self { value, error: 0.0 }
    }

    pub fn zero(like: &R) -> Self {
        Self::exact(like.zero_like())
    }

    /// Magnitude as a double; zero below its range.
    pub fn size(&self) -> f64 {
        self.value.to_f64().abs()
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self {
            value: self.value.clone() + other.value.clone(),
            error: self.error + other.error,
        }
    }

    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    pub fn times(&self, other: &Self) -> Self {
        Self {
            value: self.value.clone() * other.value.clone(),
            error: self.size() * other.error + other.size() * self.error + self.error * other.error,
        }
    }

    pub fn negated(&self) -> Self {
        Self {
            value: -self.value.clone(),
            error: self.error,
        }
    }

    /// Whether it is zero.
    ///
    /// # Errors
    /// [`Doubt::Precision`] where it is neither zero nor clearly different from it.
    pub fn is_zero(&self) -> Result<bool, Doubt> {
        let size = self.size();
        if !size.is_finite() || !self.error.is_finite() {
            return Err(Doubt::Arithmetic);
        }
        if size <= ZERO * self.error.max(LEAST) {
            return Ok(true);
        }
        if size >= CLEAR * self.error {
            return Ok(false);
        }
        Err(Doubt::Precision)
    }
}

/// The value of Σ cᵢ xⁱ at an exact place.
pub(super) fn value_at<R: Real>(polynomial: &[Fuzzy<R>], at: &R) -> Fuzzy<R> {
    let at = Fuzzy::exact(at.clone());
    polynomial
        .iter()
        .rev()
        .fold(Fuzzy::zero(&at.value), |sum, c| sum.times(&at).plus(c))
}

/// The derivative of Σ cᵢ xⁱ.
pub(super) fn derivative<R: Real>(polynomial: &[Fuzzy<R>]) -> Vec<Fuzzy<R>> {
    polynomial
        .iter()
        .enumerate()
        .skip(1)
        .map(|(i, c)| c.times(&Fuzzy::exact(c.value.constant(i as f64))))
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // a test may panic
mod tests {
    use super::*;

    #[test]
    fn errors_add_and_multiply() {
        let number = |value: f64, error: f64| Fuzzy { value, error };
        let sum = number(2.0, 1e-9).minus(&number(2.0, 1e-9));
        assert!(sum.is_zero().unwrap());
        let product = number(3.0, 1e-12).times(&number(-2.0, 1e-10));
        assert!((product.error - 3e-10).abs() < 1e-11);
        assert!(!product.is_zero().unwrap());
        assert_eq!(number(1e-5, 1e-10).is_zero(), Err(Doubt::Precision));
        assert!(number(0.0, 0.0).is_zero().unwrap() && !number(1e-200, 0.0).is_zero().unwrap());
    }
}
