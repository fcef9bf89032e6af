//! How far each coefficient of a germ may be from its true value.
//!
//! # What errors do
//! The screws of a part are known to some accuracy a: by rounding, by the file's stated precision, by how closely an
//! assembled pose is known. Roundings of the series themselves act like a change of the screws: a coefficient of degree K
//! sums at most 3·2^K products per exponential, with roundings that are not systematic, so that 4·2^{K/2} roundoffs for
//! each of a cycle's exponentials cover them. Together the screws are off by ΔS with ‖ΔS‖_F ≤ (a + p u) σ₁. How that
//! changes κ depends on the pseudo-inverse, once per degree. Bounds from norms alone (1/σ_r per degree) are too high by
//! a factor of thousands at degree four, which is what separates an equation from noise.
//!
//! # The estimate
//! So the change is measured. To first order κ_k moves by a linear map L_k of ΔS. For random entries of Frobenius norm ε
//! the root mean square of ‖L_k ΔS‖ is ε ‖L_k‖_F / √N with N entries, and the worst case is ε ‖L_k‖₂ ≤ ε ‖L_k‖_F: it is
//! not above √N times the mean. The germ is computed again with [`SAMPLES`] random changes of the screws, in bases of the
//! two kernels that are the projections of the old ones, and √N times the largest difference is taken. If L_k has one
//! direction only, a sample comes out at less than a hundredth of its mean once in 120, and three do once in two million.

use super::loop_equations::LoopEquations;
use super::reduction::{Reduced, reduce};
use super::splitting::{Splitting, dot};
use kutzbach_math::matrix::{MatrixError, SplitMix64};

/// How often the germ is computed with changed screws.
const SAMPLES: usize = 3;

/// Seed of the changes.
const SEED: u64 = 0x6765_726d;

/// Errors of κ's coefficients by degree, from 0 to K, in the Frobenius norm over equations and monomials. `accuracy` is
/// that of the Jacobian relative to its largest singular value. `None` where the table of monomials is too large.
pub(super) fn noise_of(
    equations: &LoopEquations,
    splitting: &Splitting,
    reduced: &Reduced,
    accuracy: f64,
) -> Result<Option<Vec<f64>>, MatrixError> {
    let degree = reduced.monomials.degree();
    let mut noise = vec![0.0f64; degree + 1];
    let entries = equations.entry_count() as f64;
    if reduced.kappa.is_empty() || reduced.monomials.variables() == 0 || entries == 0.0 {
        return Ok(Some(noise));
    }
    let per_exponential = 4.0 * (degree as f64 / 2.0).exp2() * (0.5 * f64::EPSILON);
    let rounding = equations.longest_cycle() as f64 * per_exponential;
    let size = (accuracy + rounding) * splitting.largest;
    // A uniform number in ±1 has root mean square 1/√3.
    let amplitude = size * (3.0 / entries).sqrt();
    let mut random = SplitMix64::new(SEED);
    for _ in 0..SAMPLES {
        let changed = equations.changed(amplitude, &mut random);
        let mut there = Splitting::of(&changed.matrix()?, splitting.rank())?;
        there.align_with(splitting);
        let Some(other) = reduce(&changed, &there, reduced.variables.len(), degree) else {
            return Ok(None);
        };
        for (k, noise) in noise.iter_mut().enumerate().skip(2) {
            let squares = reduced.kappa.iter().zip(&other.kappa).map(|(a, b)| {
                let off: Vec<f64> = a
                    .of_degree(k)
                    .iter()
                    .zip(b.of_degree(k))
                    .map(|(a, b)| a - b)
                    .collect();
                dot(&off, &off)
            });
            *noise = noise.max((entries * squares.sum::<f64>()).sqrt());
        }
    }
    if let Some(row) = noise.iter().position(|n| !n.is_finite()) {
        return Err(MatrixError::NotFinite { row, column: 0 });
    }
    Ok(Some(noise))
}
