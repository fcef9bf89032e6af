//! Truncated power series in several variables with real coefficients.

use std::ops::{Add, Mul, Neg, Sub};
use std::sync::Arc;

use super::monomials::Monomials;

/// A power series Σ c_α y^α in the variables of a [`Monomials`] table, truncated after its degree K.
///
/// Sums and products are those of the ring R\[y\]/(monomials of degree > K): exact up to rounding in every
/// coefficient that is kept. Two series can be combined only if they have as many variables and the same
/// K; mixing others is a programming error and panics.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    monomials: Arc<Monomials>,
    coefficients: Vec<f64>,
}

impl Series {
    /// The zero series.
    pub fn zero(monomials: &Arc<Monomials>) -> Self {
        Self {
            monomials: Arc::clone(monomials),
            coefficients: vec![0.0; monomials.count()],
        }
    }

    /// A constant.
    pub fn constant(monomials: &Arc<Monomials>, value: f64) -> Self {
        let mut series = Self::zero(monomials);
        series.coefficients[0] = value;
        series
    }

    /// The linear form Σ coefficients\[i\]·y_i; missing coefficients count as zero, surplus ones panic.
    /// With K = 0 the result is zero, as the truncation demands.
    pub fn linear(monomials: &Arc<Monomials>, coefficients: &[f64]) -> Self {
        assert!(
            coefficients.len() <= monomials.variables(),
            "a linear form has one coefficient per variable"
        );
        let mut series = Self::zero(monomials);
        if monomials.degree() > 0 {
            for (slot, value) in monomials.of_degree(1).zip(coefficients) {
                series.coefficients[slot] = *value;
            }
        }
        series
    }

    /// A series from its coefficients in the order of [`Monomials`]; their number must match.
    pub fn from_coefficients(monomials: &Arc<Monomials>, coefficients: Vec<f64>) -> Self {
        assert_eq!(
            coefficients.len(),
            monomials.count(),
            "one coefficient per monomial"
        );
        Self {
            monomials: Arc::clone(monomials),
            coefficients,
        }
    }

    /// The numbering of the coefficients.
    pub fn monomials(&self) -> &Arc<Monomials> {
        &self.monomials
    }

    /// Coefficients in the order of [`Series::monomials`].
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// Coefficients for changing in place.
    pub fn coefficients_mut(&mut self) -> &mut [f64] {
        &mut self.coefficients
    }

    /// Coefficients of the homogeneous part of one degree; empty above K.
    pub fn of_degree(&self, degree: usize) -> &[f64] {
        &self.coefficients[self.monomials.of_degree(degree)]
    }

    /// Largest absolute coefficient of the homogeneous part of one degree.
    pub fn size_of_degree(&self, degree: usize) -> f64 {
        self.of_degree(degree)
            .iter()
            .fold(0.0, |m, c| f64::max(m, c.abs()))
    }

    /// Value at a point of one number per variable.
    pub fn evaluate(&self, point: &[f64]) -> f64 {
        values_of_monomials(&self.monomials, point)
            .iter()
            .zip(&self.coefficients)
            .map(|(y, c)| y * c)
            .sum()
    }

    /// Partial derivative by one variable; its part of degree K is unknown and comes out as zero.
    pub fn derivative(&self, variable: usize) -> Self {
        let mut result = Self::zero(&self.monomials);
        for (index, &c) in self.coefficients.iter().enumerate() {
            let exponents = self.monomials.exponents(index);
            let power = exponents[variable];
            if power > 0 && c != 0.0 {
                let mut lower = exponents.to_vec();
                lower[variable] -= 1;
                if let Some(slot) = self.monomials.index_of(&lower) {
                    result.coefficients[slot] += f64::from(power) * c;
                }
            }
        }
        result
    }

    /// This series times a number.
    pub fn scaled(&self, factor: f64) -> Self {
        let mut result = self.clone();
        result.coefficients.iter_mut().for_each(|c| *c *= factor);
        result
    }

    /// Adds `factor`·`other` to this series.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        self.assert_alike(other);
        for (a, b) in self.coefficients.iter_mut().zip(&other.coefficients) {
            *a += factor * b;
        }
    }

    fn assert_alike(&self, other: &Self) {
        assert_alike(&self.monomials, &other.monomials);
    }
}

pub(super) fn assert_alike(a: &Arc<Monomials>, b: &Arc<Monomials>) {
    assert!(
        Arc::ptr_eq(a, b) || (a.variables() == b.variables() && a.degree() == b.degree()),
        "power series of different shapes cannot be combined"
    );
}

/// y^α for every monomial.
pub(super) fn values_of_monomials(monomials: &Monomials, point: &[f64]) -> Vec<f64> {
    assert_eq!(
        point.len(),
        monomials.variables(),
        "one coordinate per variable"
    );
    (0..monomials.count())
        .map(|index| {
            monomials
                .exponents(index)
                .iter()
                .zip(point)
                .map(|(e, y)| y.powi(i32::from(*e)))
                .product()
        })
        .collect()
}

impl Add for &Series {
    type Output = Series;
    fn add(self, other: Self) -> Series {
        let mut sum = self.clone();
        sum.add_scaled(1.0, other);
        sum
    }
}

impl Sub for &Series {
    type Output = Series;
    fn sub(self, other: Self) -> Series {
        let mut difference = self.clone();
        difference.add_scaled(-1.0, other);
        difference
    }
}

impl Neg for &Series {
    type Output = Series;
    fn neg(self) -> Series {
        self.scaled(-1.0)
    }
}

impl Mul for &Series {
    type Output = Series;
    /// Truncated product; at most C(2m+K, K) multiplications, zero coefficients are skipped.
    fn mul(self, other: Self) -> Series {
        self.assert_alike(other);
        let mut product = Series::zero(&self.monomials);
        for (a, &x) in self.coefficients.iter().enumerate() {
            if x == 0.0 {
                continue;
            }
            let slots = self.monomials.products_with(a);
            for (&slot, &y) in slots.iter().zip(&other.coefficients) {
                product.coefficients[slot as usize] += x * y;
            }
        }
        product
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn binomial_theorem() {
        let m = Monomials::new(2, 5).unwrap();
        let one_plus = &Series::constant(&m, 1.0) + &Series::linear(&m, &[2.0, -1.0]);
        let mut power = Series::constant(&m, 1.0);
        for _ in 0..7 {
            power = &power * &one_plus;
        }
        // Coefficient of x² y³ in (1 + 2x − y)^7 is 7!/(2! 3! 2!)·2²·(−1)³.
        let slot = m.index_of(&[2, 3]).unwrap();
        assert_eq!(power.coefficients()[slot], -210.0 * 4.0);
        assert_eq!(power.size_of_degree(1), 14.0);
        assert_eq!(power.size_of_degree(6), 0.0);
    }

    #[test]
    fn derivative_obeys_the_product_rule_below_the_top_degree() {
        let m = Monomials::new(3, 4).unwrap();
        let coefficients = |seed: usize| {
            let values = (0..m.count()).map(|i| ((i * seed + 3) % 17) as f64 - 8.0);
            Series::from_coefficients(&m, values.collect())
        };
        let (f, g) = (coefficients(5), coefficients(7));
        for variable in 0..3 {
            let left = (&f * &g).derivative(variable);
            let right = &(&f.derivative(variable) * &g) + &(&f * &g.derivative(variable));
            for degree in 0..4 {
                assert_eq!(left.of_degree(degree), right.of_degree(degree));
            }
        }
    }

    #[test]
    fn evaluation_is_a_ring_homomorphism_for_small_degrees() {
        let m = Monomials::new(2, 4).unwrap();
        let f = &Series::constant(&m, 0.5) + &Series::linear(&m, &[1.0, 3.0]);
        let g = &(&f * &f) - &Series::linear(&m, &[0.0, 1.0]);
        let at = [0.3, -0.7];
        let product = (&f * &g).evaluate(&at);
        assert!((product - f.evaluate(&at) * g.evaluate(&at)).abs() < 1e-14);
        assert_eq!((-&f).evaluate(&at), -f.evaluate(&at));
    }

    #[test]
    #[should_panic(expected = "different shapes")]
    fn shapes_do_not_mix() {
        let (a, b) = (Monomials::new(2, 3).unwrap(), Monomials::new(2, 4).unwrap());
        let _ = &Series::zero(&a) * &Series::zero(&b);
    }
}
