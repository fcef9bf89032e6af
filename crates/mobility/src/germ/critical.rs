//! Hypersurface germs with an isolated critical point: they are irreducible.
//!
//! In three variables and more, a hypersurface whose singular points are isolated over the complex numbers is normal, and so it is one
//! piece near each of them (Milnor, *Singular Points of Complex Hypersurfaces*, 1968, theorem 5.2: its link is connected). Real points
//! beside the critical one are smooth, so that real zeros, where there are any, are one branch of one dimension less: z² = x⁴ + y⁴
//! is two bowls that touch, and one branch.

use super::dual_space::complex_dimension;
use kutzbach_math::group::{Monomials, Series};

/// Whether the origin is an isolated critical point over the complex numbers, proved up to the margins of ranks, of a power series in
/// three variables or more that is known to some degree. `noise` is the error of its coefficients of each degree.
#[must_use]
pub fn is_irreducible_hypersurface(equation: &Series, noise: &[f64]) -> bool {
    let table = equation.monomials();
    let (variables, degree) = (table.variables(), table.degree());
    if variables < 3 || degree < 2 || noise.len() <= degree {
        return false;
    }
    let Ok(lower) = Monomials::new(variables, degree - 1) else {
        return false;
    };
    let gradient: Vec<Series> = (0..variables)
        .map(|variable| {
            let mut slope = equation.derivative(variable).coefficients().to_vec();
            slope.truncate(lower.count());
            Series::from_coefficients(&lower, slope)
        })
        .collect();
    // A coefficient of degree k has at most the factor k in each derivative, and in all of them together √(Σ aᵢ²) ≤ k.
    let noise: Vec<f64> = (1..=degree).map(|k| k as f64 * noise[k]).collect();
    complex_dimension(&gradient, variables, &noise).is_some_and(|found| found.dimension == 0)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A polynomial in three variables with noise as from rounding.
    fn told(degree: usize, terms: &[([u8; 3], f64)]) -> bool {
        let table = Monomials::new(3, degree).unwrap();
        let mut coefficients = vec![0.0; table.count()];
        for (exponents, value) in terms {
            coefficients[table.index_of(exponents).unwrap()] = *value;
        }
        let series = Series::from_coefficients(&table, coefficients);
        is_irreducible_hypersurface(&series, &vec![1e-14; degree + 1])
    }

    #[test]
    fn isolated_critical_points_make_one_branch() {
        // Two bowls that touch, the surface D4, and a cone.
        assert!(told(
            6,
            &[([0, 0, 2], 1.0), ([4, 0, 0], -1.0), ([0, 4, 0], -1.0)]
        ));
        assert!(told(
            4,
            &[([2, 1, 0], 1.0), ([0, 3, 0], -1.0), ([0, 0, 2], 1.0)]
        ));
        assert!(told(
            3,
            &[([2, 0, 0], 1.0), ([0, 2, 0], 1.0), ([0, 0, 2], -1.0)]
        ));
    }

    #[test]
    fn planes_that_cross_and_what_is_not_seen_to_end_are_not() {
        assert!(!told(4, &[([1, 1, 0], 1.0)]));
        // Whitney's umbrella is critical along a line.
        assert!(!told(5, &[([2, 0, 0], 1.0), ([0, 2, 1], -1.0)]));
        // To degree 3 the terms x⁴ and y⁴ are not seen; to degree 5 not all of the local algebra.
        assert!(!told(3, &[([0, 0, 2], 1.0)]));
        // A double plane but for a term that is lost in the noise.
        assert!(!told(
            4,
            &[([0, 0, 2], 1.0), ([4, 0, 0], 1e-15), ([0, 4, 0], 1.0)]
        ));
    }
}
