//! The complex dimension of a germ at its pose, by Macaulay matrices.
//!
//! A linear functional on power series that looks at terms up to degree k only and vanishes on the ideal is a vector of
//! the null space of the Macaulay matrix M_k: rows x^α f_j truncated at degree k, columns the monomials of degree up to k
//! (Dayton and Zeng 2005; Krone 2013). H(k) = nullity M_k − nullity M_{k−1} is the local Hilbert function, that of the
//! tangent cone as far as the equations to degree k show it.
//!
//! # What is proved, and what is not
//! - H(k) = 0 for some k ≤ K: the origin is an isolated zero over the complex numbers, of multiplicity Σ H. M_k contains
//!   terms up to degree k only, so that what was truncated cannot change this. Proved, up to the margins of the ranks.
//! - Isolated on a linear subspace of codimension s: the dimension is at most s. Proved alike.
//! - Not isolated up to degree K: nothing. The zero may be isolated with a multiplicity that K does not show, and an
//!   equation may begin beyond K. So a dimension is an upper bound; that it is not smaller holds *to the order computed*,
//!   except that it is never less than the number of variables minus that of all the equations there are.
//!
//! # Scale
//! Ranks are decided with variables in units of a quarter and every equation of unit length, so that coefficients that
//! grow with the degree do not hide those of the lowest. The accuracy of the matrix follows from the equations' noise.

use super::ideal::scaled;
use super::slices::{random_subspace, restricted};
use kutzbach_math::group::{Monomials, Series};
use kutzbach_math::matrix::{SparseMatrix, SplitMix64, decide};

/// Seed of the slices.
const SEED: u64 = 0x6b75_747a_6261_6368;

/// No Macaulay matrix of more columns is ranked.
const MOST_COLUMNS: usize = 400;

/// The complex dimension of {f = 0} at the origin, to the order computed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ComplexDimension {
    /// Proved upper bound of the dimension of the zeros at the origin; the dimension to the order computed.
    pub dimension: usize,
    /// H(0), H(1), … of the equations themselves, up to the first zero or the degree of the series.
    pub hilbert: Vec<usize>,
    /// How many random linear equations make the origin isolated: none where it is so by itself.
    pub isolated_after_slices: usize,
    /// The multiplicity of the origin on that slice: of the germ too where its components have one dimension, and more
    /// than that where smaller ones are added.
    pub multiplicity: usize,
}

impl ComplexDimension {
    /// No equations at all: H(k) counts the monomials of degree k.
    fn of_a_manifold(variables: usize, degree: usize) -> Self {
        let mut hilbert = vec![1usize];
        for k in 1..=degree {
            if hilbert.last() == Some(&0) {
                break;
            }
            hilbert.push(hilbert[k - 1].saturating_mul(variables + k - 1) / k);
        }
        Self {
            dimension: variables,
            hilbert,
            isolated_after_slices: variables,
            multiplicity: 1,
        }
    }
}

/// The complex dimension of the common zeros of some series at the origin, where they vanish.
///
/// `variables` is the number of variables, of use where there are no equations; `noise` the error of the coefficients of
/// each degree, in the norm over all equations and monomials. `None` where a rank cannot be decided by its margin, where
/// the system is too large (400 monomials), or where the series do not vanish at the origin.
#[must_use]
pub fn complex_dimension(
    equations: &[Series],
    variables: usize,
    noise: &[f64],
) -> Option<ComplexDimension> {
    let Some(first) = equations.first() else {
        return Some(ComplexDimension::of_a_manifold(
            variables,
            noise.len().saturating_sub(1),
        ));
    };
    let degree = first.monomials().degree();
    if equations
        .iter()
        .any(|e| e.coefficients()[0] != 0.0 || e.monomials().variables() != variables)
    {
        return None;
    }
    let hilbert = hilbert_function(equations, variables, degree, noise)?;
    let mut random = SplitMix64::new(SEED);
    // With fewer slices the truncated equations, too few for the variables, have no isolated zero.
    let fewest = variables.saturating_sub(equations.len());
    for slices in fewest..=variables {
        let found = if slices == 0 {
            hilbert.clone()
        } else {
            let basis = random_subspace(variables, variables - slices, &mut random);
            let restricted = restricted(equations, &basis)?;
            hilbert_function(&restricted, basis.len(), degree, noise)?
        };
        if found.last() == Some(&0) {
            return Some(ComplexDimension {
                dimension: slices,
                hilbert,
                isolated_after_slices: slices,
                multiplicity: found.iter().sum(),
            });
        }
    }
    None
}

/// H(0), H(1), … up to the first zero or to `degree`.
fn hilbert_function(
    equations: &[Series],
    variables: usize,
    degree: usize,
    noise: &[f64],
) -> Option<Vec<usize>> {
    let mut hilbert = vec![1];
    let mut nullity = 1;
    for k in 1..=degree {
        let table = Monomials::new(variables, k).ok()?;
        if table.count() > MOST_COLUMNS {
            return None;
        }
        let next = table.count() - macaulay_rank(equations, &table, noise)?;
        // Rows of M_{k−1} are those of M_k restricted to fewer columns, so that the nullity cannot fall.
        hilbert.push(next.checked_sub(nullity)?);
        nullity = next;
        if hilbert.last() == Some(&0) {
            break;
        }
    }
    Some(hilbert)
}

/// The rank of the Macaulay matrix whose columns are the monomials of `table`.
fn macaulay_rank(equations: &[Series], table: &Monomials, noise: &[f64]) -> Option<usize> {
    let k = table.degree();
    let mut triplets = Vec::new();
    let mut row = 0;
    let mut error = 0.0;
    for equation in equations {
        let monomials = equation.monomials();
        let (unit, row_error) = scaled(equation, noise);
        for shift in 0..table.count_up_to(k - 1) {
            let alpha = table.exponents(shift);
            let reach = monomials.count_up_to(k - table.degree_of(shift));
            let mut any = false;
            for (slot, value) in unit[..reach].iter().enumerate() {
                if *value == 0.0 {
                    continue;
                }
                let beta = monomials.exponents(slot);
                let sum: Vec<u8> = alpha.iter().zip(beta).map(|(a, b)| a + b).collect();
                triplets.push((row, table.index_of(&sum)?, *value));
                any = true;
            }
            if any {
                row += 1;
                error += row_error * row_error;
            }
        }
    }
    if row == 0 {
        return Some(0);
    }
    let total: f64 = triplets.iter().map(|(_, _, v)| v * v).sum();
    let matrix = SparseMatrix::from_triplets(row, table.count(), 0.0, triplets).ok()?;
    // σ₁ is at least ‖M‖_F / √min(rows, columns).
    let accuracy = (error / total * row.min(table.count()) as f64).sqrt();
    decide(&matrix, accuracy).ok()?.rank
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const NOISE: [f64; 8] = [1e-14; 8];

    fn series(degree: usize, variables: usize, terms: &[(&[u8], f64)]) -> Series {
        let m = Monomials::new(variables, degree).unwrap();
        let mut f = Series::zero(&m);
        for (exponents, value) in terms {
            f.coefficients_mut()[m.index_of(exponents).unwrap()] += value;
        }
        f
    }

    fn of(equations: &[Series]) -> ComplexDimension {
        complex_dimension(equations, equations[0].monomials().variables(), &NOISE).unwrap()
    }

    #[test]
    fn a_cusp_is_a_curve_of_multiplicity_two() {
        let found = of(&[series(4, 2, &[(&[0, 2], -1.0), (&[3, 0], 0.23)])]);
        assert_eq!(found.hilbert, [1, 2, 2, 2, 2]);
        assert_eq!(
            (
                found.dimension,
                found.isolated_after_slices,
                found.multiplicity
            ),
            (1, 1, 2)
        );
    }

    #[test]
    fn a_double_point_on_a_line() {
        let found = of(&[series(4, 1, &[(&[2], 3.0), (&[3], 1.0)])]);
        assert_eq!(found.hilbert, [1, 1, 0]);
        assert_eq!((found.dimension, found.multiplicity), (0, 2));
    }

    #[test]
    fn intersecting_conics_multiply() {
        // x² and y² + x y: multiplicity 4. x² − y³ and y²: 4 as well. x y and x² + y³: 5.
        let f = series(5, 2, &[(&[2, 0], 1.0)]);
        let g = series(5, 2, &[(&[0, 2], 1.0), (&[1, 1], 1.0)]);
        let found = of(&[f, g]);
        assert_eq!((found.hilbert, found.multiplicity), (vec![1, 2, 1, 0], 4));
        let f = series(5, 2, &[(&[1, 1], 1.0)]);
        let g = series(5, 2, &[(&[2, 0], 1.0), (&[0, 3], 1.0)]);
        let found = of(&[f, g]);
        assert_eq!((found.dimension, found.multiplicity), (0, 5));
    }

    #[test]
    fn a_plane_and_a_line_meet_in_three_variables() {
        // x z = y z = 0: the plane z = 0 and the line x = y = 0.
        let f = series(4, 3, &[(&[1, 0, 1], 1.0)]);
        let g = series(4, 3, &[(&[0, 1, 1], 1.0)]);
        let found = of(&[f, g]);
        assert_eq!(found.hilbert, [1, 3, 4, 5, 6]);
        // On a line through the origin both equations are squares: the line that is embedded there counts too.
        assert_eq!((found.dimension, found.multiplicity), (2, 2));
    }

    #[test]
    fn no_equations_leave_all_variables() {
        let found = complex_dimension(&[], 3, &NOISE).unwrap();
        assert_eq!((found.dimension, found.multiplicity), (3, 1));
        assert_eq!(found.hilbert[..5], [1, 3, 6, 10, 15]);
        let found = complex_dimension(&[], 0, &NOISE).unwrap();
        assert_eq!((found.dimension, found.hilbert), (0, vec![1, 0]));
    }

    #[test]
    fn a_multiplicity_beyond_the_order_is_not_seen() {
        let f = |degree| series(degree, 2, &[(&[0, 2], 1.0)]);
        let g = |degree| series(degree, 2, &[(&[3, 0], 1.0)]);
        let seen = of(&[f(5), g(5)]);
        assert_eq!((seen.dimension, seen.multiplicity), (0, 6));
        let unseen = of(&[f(3), g(3)]);
        assert_eq!(unseen.dimension, 1, "an upper bound still");
    }

    #[test]
    fn coefficients_within_the_noise_decide_nothing() {
        let f = series(3, 2, &[(&[0, 2], 1.0), (&[2, 0], 1e-5)]);
        let g = series(3, 2, &[(&[1, 1], 1.0)]);
        assert_eq!(of(&[f.clone(), g.clone()]).dimension, 0);
        assert_eq!(complex_dimension(&[f, g], 2, &[1e-5; 4]), None);
        let constant = series(3, 2, &[(&[0, 0], 1.0)]);
        assert_eq!(complex_dimension(&[constant], 2, &NOISE), None);
    }
}
