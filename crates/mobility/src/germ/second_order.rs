//! The quadratic forms of a germ, and what a definite one proves.
//!
//! Every self-stress λ gives a quadratic form Q_λ on ker J, the degree-two part of its equation. If some combination is
//! definite, then along any real curve through the pose the closure equations fail at second order of the lowest term: the
//! pose is isolated over the reals, prestress stable in the words of Connelly and Whiteley (1996, section 3). Over the
//! complex numbers it need not be.
//!
//! # Finding a definite combination
//! The largest λ_min(Σ λ_i Q_i) over the unit ball of combinations equals the distance of the origin from the convex set
//! of all (⟨Q_i, X⟩)_i with X positive semidefinite of trace one, by duality; the nearest point is the combination sought,
//! and the set's extreme point against a direction comes from the eigenvector of a smallest eigenvalue. So the search is
//! one for a nearest point ([`super::min_norm_point`]); the combination it ends with is verified by itself.

use super::definite::quadratic_form;
use super::min_norm_point::nearest_to_origin;
use super::reduction::{Germ, order_of};
use super::splitting::dot;
use nalgebra::{DMatrix, SymmetricEigen};

/// The search ends with a combination whose smallest eigenvalue is at least this share of the best possible one.
const GOOD_ENOUGH: f64 = 0.9;

/// The smallest eigenvalue must exceed the bound of its error by this factor.
const CLEARANCE: f64 = 10.0;

/// A definite combination of a germ's quadratic forms: the pose is isolated over the reals.
#[derive(Clone, Debug, PartialEq)]
pub struct PrestressCertificate {
    /// Factors of the equations of [`Germ::equations`], of unit length together; zero for those of higher order.
    pub combination: Vec<f64>,
    /// Smallest eigenvalue of the combined form: κ ≥ this · |y|² to second order.
    pub smallest_eigenvalue: f64,
    /// Bound of the error of the eigenvalue.
    pub noise: f64,
}

/// Looks for a definite combination of the quadratic forms of a germ. `None` where there is none, where its smallest
/// eigenvalue does not exceed ten times its error, or where there are no motions to first order.
///
/// Cost: one eigenvalue decomposition of a δ × δ matrix per step; few steps.
#[must_use]
pub fn prestress_certificate(germ: &Germ) -> Option<PrestressCertificate> {
    certificate(germ, definite_combination)
}

/// [`prestress_certificate`] across so many directions along which all quadratic forms vanish: of a combination that is definite
/// on their complement, with its smallest eigenvalue there. `None` also where the forms vanish along more or fewer directions.
///
/// What it proves: let the equations κ vanish along a branch of dimension `along` at whose poses no more of them are independent
/// than here, so that their derivatives vanish along it too. By the splitting lemma the combination is f(x, t) = |x|² + g(t) near
/// the pose, with as many t. The branch lies where all derivatives of f vanish: where x = 0 and dg = 0, which is an open set of
/// the t. So the analytic g is zero, and where κ = 0 there is x = 0: the branch is all there is over the reals.
#[must_use]
pub fn prestress_across(germ: &Germ, along: usize) -> Option<PrestressCertificate> {
    certificate(germ, |forms, least| {
        definite_across(forms, along, least / CLEARANCE)
    })
}

/// The combination that is found among the forms, whose smallest eigenvalue has to exceed a least one.
fn certificate(
    germ: &Germ,
    found: impl Fn(&[DMatrix<f64>], f64) -> Option<(Vec<f64>, f64)>,
) -> Option<PrestressCertificate> {
    let forms: Vec<DMatrix<f64>> = germ
        .equations()
        .iter()
        .filter(|e| order_of(e) == Some(2))
        .map(quadratic_form)
        .collect();
    // The Frobenius norm of a form is at most that of its coefficients, and the combination is one of unit length.
    let noise = germ.noise(2);
    let (factors, smallest_eigenvalue) = found(&forms, CLEARANCE * noise)?;
    // Equations of second order come first.
    let mut combination = factors;
    combination.resize(germ.equations().len(), 0.0);
    Some(PrestressCertificate {
        combination,
        smallest_eigenvalue,
        noise,
    })
}

/// A combination that is definite across the directions on which all forms vanish, which are so many.
fn definite_across(forms: &[DMatrix<f64>], along: usize, noise: f64) -> Option<(Vec<f64>, f64)> {
    let size = forms.first()?.nrows();
    let stacked = DMatrix::from_fn(forms.len() * size, size, |row, column| {
        forms[row / size][(row % size, column)]
    });
    let decomposed = stacked.try_svd(false, true, f64::EPSILON, 1000)?;
    let directions = decomposed.v_t?;
    let open = noise * (forms.len() as f64).sqrt();
    let mut across = Vec::new();
    for (value, direction) in decomposed.singular_values.iter().zip(directions.row_iter()) {
        if *value > CLEARANCE * open {
            across.push(direction.transpose());
        } else if *value > open {
            return None;
        }
    }
    if across.is_empty() || across.len() + along != size {
        return None;
    }
    let basis = DMatrix::from_columns(&across);
    let restricted: Vec<DMatrix<f64>> = forms
        .iter()
        .map(|form| basis.transpose() * form * &basis)
        .collect();
    definite_combination(&restricted, CLEARANCE * noise)
}

/// A combination of unit length whose smallest eigenvalue exceeds `least`, with that eigenvalue.
fn definite_combination(forms: &[DMatrix<f64>], least: f64) -> Option<(Vec<f64>, f64)> {
    let first = forms.first()?;
    let size = first.nrows();
    if size == 0 {
        return None;
    }
    let combined = |factors: &[f64]| {
        let mut sum = DMatrix::zeros(size, size);
        for (factor, form) in factors.iter().zip(forms) {
            sum += form * *factor;
        }
        sum
    };
    let mut extreme = |direction: &[f64]| -> Option<Vec<f64>> {
        let eigen = SymmetricEigen::try_new(combined(direction), f64::EPSILON, 1000)?;
        let lowest = eigen.eigenvalues.imin();
        let x = eigen.eigenvectors.column(lowest);
        Some(forms.iter().map(|form| (form * x).dot(&x)).collect())
    };
    // X = I / δ: the traces.
    let start: Vec<f64> = forms.iter().map(|f| f.trace() / size as f64).collect();
    let nearest = nearest_to_origin(start, &mut extreme, GOOD_ENOUGH, least)?;
    let length = dot(&nearest.point, &nearest.point).sqrt();
    if !(nearest.depth > least) {
        return None;
    }
    let factors: Vec<f64> = nearest.point.iter().map(|x| x / length).collect();
    let smallest = combined(&factors).symmetric_eigenvalues().min();
    (smallest > least).then_some((factors, smallest))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_math::matrix::SplitMix64;

    fn form(rows: &[[f64; 2]; 2]) -> DMatrix<f64> {
        DMatrix::from_fn(2, 2, |i, j| rows[i][j])
    }

    #[test]
    fn one_form_is_definite_or_not() {
        let positive = form(&[[2.0, 0.5], [0.5, 1.0]]);
        let (factors, value) = definite_combination(std::slice::from_ref(&positive), 1e-9).unwrap();
        assert_eq!(factors, [1.0]);
        assert!((value - (1.5 - 0.5f64.sqrt())).abs() < 1e-14);
        let (factors, _) = definite_combination(&[-positive], 1e-9).unwrap();
        assert_eq!(factors, [-1.0]);
        for indefinite in [
            form(&[[1.0, 0.0], [0.0, -1.0]]),
            form(&[[1.0, 0.0], [0.0, 0.0]]),
            form(&[[0.0, 1.0], [1.0, 0.0]]),
        ] {
            assert_eq!(definite_combination(&[indefinite], 1e-9), None);
        }
        assert_eq!(definite_combination(&[], 1e-9), None);
    }

    #[test]
    fn forms_are_definite_across_what_they_vanish_on() {
        // (0.6 x + 0.8 y)² + 2 z² vanishes along one line; beside it a form that is not definite there either.
        let square = |v: [f64; 3]| DMatrix::from_fn(3, 3, |i, j| v[i] * v[j]);
        let semidefinite = square([0.6, 0.8, 0.0]) + square([0.0, 0.0, 2.0f64.sqrt()]);
        let (_, value) = definite_across(std::slice::from_ref(&semidefinite), 1, 1e-12).unwrap();
        assert!((value - 1.0).abs() < 1e-12);
        for along in [0, 2, 3] {
            let found = definite_across(std::slice::from_ref(&semidefinite), along, 1e-12);
            assert_eq!(found, None);
        }
        let indefinite = square([0.6, 0.8, 0.0]) - square([0.0, 0.0, 1.0]);
        assert_eq!(
            definite_across(std::slice::from_ref(&indefinite), 1, 1e-12),
            None
        );
        // Together with another one it is.
        let two = [indefinite, square([0.0, 0.0, 3.0])];
        assert!(definite_across(&two, 1, 1e-12).is_some());
        // A direction of four times the noise is neither zero nor clear of it.
        let thin = square([0.6, 0.8, 0.0]) + square([0.0, 0.0, 2e-6]);
        assert_eq!(definite_across(&[thin], 2, 1e-12), None);
    }

    #[test]
    fn indefinite_forms_with_a_definite_combination() {
        let forms = [
            form(&[[3.0, 0.0], [0.0, -1.0]]),
            form(&[[-1.0, 0.3], [0.3, 3.0]]),
        ];
        let (_, value) = definite_combination(&forms, 1e-9).unwrap();
        assert!(value > 1.0);
        // Of xy and x² − y² every combination is indefinite.
        let none = [
            form(&[[0.0, 0.5], [0.5, 0.0]]),
            form(&[[1.0, 0.0], [0.0, -1.0]]),
        ];
        assert_eq!(definite_combination(&none, 1e-9), None);
    }

    #[test]
    fn hidden_definite_combinations_are_found() {
        // Random forms, the last one such that a known combination is the identity; then such that all vanish on a common
        // vector, so that none can be definite.
        let mut random = SplitMix64::new(11);
        for size in 2..7 {
            let count = 4;
            let mut draw = || {
                let a = DMatrix::from_fn(size, size, |_, _| random.symmetric());
                &a + a.transpose()
            };
            let mut forms: Vec<DMatrix<f64>> = (0..count).map(|_| draw()).collect();
            let rest = &forms[0] * 0.5 - &forms[1] * 0.7 + &forms[2] * 0.2;
            forms[3] = DMatrix::identity(size, size) - rest;
            let (factors, value) = definite_combination(&forms, 1e-9).unwrap();
            let known = 1.0 / (0.25f64 + 0.49 + 0.04 + 1.0).sqrt();
            assert!(value > 0.9 * known, "{size}: {value} {known}");
            assert!((dot(&factors, &factors) - 1.0).abs() < 1e-12);
            for form in &mut forms {
                form[(0, 0)] = 0.0;
            }
            assert_eq!(definite_combination(&forms, 1e-9), None, "{size}");
        }
    }
}
