//! How far each coefficient of a germ may be from its true value.
//!
//! # The bound
//! A power series in one variable t whose coefficients are at least the sums of the magnitudes of another's, degree by
//! degree, is a majorant of it; sums and products of majorants are majorants of sums and products (Cauchy). With
//! X_i(t) a majorant of joint variable i and |S_i| = |ω| + |v| of its screw, a cycle's product is majorised by
//! M(t) = exp(Σ |S_i| X_i(t)), its six equations by √2 M. An error of the variables by e(t), of the screws by ΔS, and of
//! every operation by rounding changes them to first order by no more than
//!
//! > E(t) = √2 M(t) · ( p u + ‖S‖ e(t) + √2 ‖ΔS‖ ‖X(t)‖ )
//!
//! in the sum of magnitudes over the monomials of each degree, hence in the Frobenius norm of the coefficients too. Here
//! u is the unit roundoff and ‖ΔS‖ = a σ₁ with the accuracy a that the rank was decided with: rounding, stated precision,
//! and how closely an assembled pose is known. A coefficient of degree K of a product of series sums at most 3·2^K
//! products, whose roundings are not systematic: 4·2^{K/2} roundoffs for each of the cycle's exponentials make p.
//!
//! # How errors grow
//! The kernel is known to a σ₁/σ_r per basis vector. Solving for ψ_k divides by the smallest kept singular value σ_r:
//! e_k = (E_k + 2 a σ₁ ‖ψ_k‖) / σ_r, and e_k enters E_{k+1}. So the bound grows by about 1/σ_r per degree, as the
//! coefficients themselves may.

use super::loop_equations::LoopEquations;
use super::splitting::Splitting;
use crate::group::Monomials;

/// What is known beforehand.
pub(super) struct Known<'a> {
    pub equations: &'a LoopEquations,
    pub splitting: &'a Splitting,
    /// Accuracy of the Jacobian relative to its largest singular value.
    pub accuracy: f64,
}

/// Bounds of the errors of κ's coefficients by degree, from 0 to K, in the Frobenius norm over equations and monomials;
/// `variables` are the coefficients of the joint variables, one list each.
pub(super) fn bounds(known: &Known<'_>, monomials: &Monomials, variables: &[Vec<f64>]) -> Vec<f64> {
    let degree = monomials.degree();
    let screws_off = known.accuracy * known.splitting.largest;
    let per_solution = if known.splitting.smallest > 0.0 {
        1.0 / known.splitting.smallest
    } else {
        0.0
    };
    // Majorants of the variables, and of all of them together.
    let majorants: Vec<Vec<f64>> = variables
        .iter()
        .map(|x| {
            let size = |d| -> f64 {
                let range = monomials.of_degree(d);
                x.get(range)
                    .map_or(0.0, |c| c.iter().map(|c| c.abs()).sum())
            };
            (0..=degree).map(size).collect()
        })
        .collect();
    let together: Vec<f64> = (0..=degree)
        .map(|d| majorants.iter().map(|m| m[d] * m[d]).sum::<f64>().sqrt())
        .collect();
    struct Cycle {
        product: Vec<f64>,
        screws: f64,
        rounding: f64,
    }
    let cycles: Vec<Cycle> = known
        .equations
        .sizes()
        .map(|(sizes, exponentials)| {
            let mut exponent = vec![0.0; degree + 1];
            for (column, size) in &sizes {
                for (sum, x) in exponent.iter_mut().zip(&majorants[*column]) {
                    *sum += size * x;
                }
            }
            let per_exponential = 4.0 * (degree as f64 / 2.0).exp2();
            Cycle {
                product: exponential(&exponent),
                screws: sizes.iter().map(|(_, s)| s * s).sum::<f64>().sqrt(),
                rounding: exponentials as f64 * per_exponential * (0.5 * f64::EPSILON),
            }
        })
        .collect();
    let mut error = vec![0.0; degree + 1];
    if degree >= 1 {
        error[1] = monomials.variables() as f64 * screws_off * per_solution;
    }
    let mut bounds = vec![0.0; degree + 1];
    for k in 2..=degree {
        let mut squares = 0.0;
        for cycle in &cycles {
            let mut sum = cycle.product[k] * cycle.rounding;
            for d in 1..=k {
                let off =
                    cycle.screws * error[d] + std::f64::consts::SQRT_2 * screws_off * together[d];
                sum += cycle.product[k - d] * off;
            }
            squares += 2.0 * sum * sum;
        }
        bounds[k] = squares.sqrt();
        error[k] = per_solution * (bounds[k] + 2.0 * screws_off * together[k]);
    }
    bounds
}

/// exp of a series in one variable without constant term: k M_k = Σ j σ_j M_{k−j}.
fn exponential(exponent: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; exponent.len()];
    result[0] = 1.0;
    for k in 1..exponent.len() {
        let sum: f64 = (1..=k)
            .map(|j| j as f64 * exponent[j] * result[k - j])
            .sum();
        result[k] = sum / k as f64;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_of_a_series() {
        // exp(2t + t²) = 1 + 2t + 3t² + (8/6 + 2) t³ + …
        let e = exponential(&[0.0, 2.0, 1.0, 0.0]);
        assert_eq!(e[..3], [1.0, 2.0, 3.0]);
        assert!((e[3] - 10.0 / 3.0).abs() < 1e-15);
    }
}
