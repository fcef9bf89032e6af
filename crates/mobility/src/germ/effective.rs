//! Independent equations among the κ's, sorted by their order.
//!
//! Most combinations of the left kernel say nothing: a planar loop written with six equations has three that vanish
//! identically. And a combination that begins at degree three is hidden where it is mixed with one of degree two. So the
//! combinations are taken degree by degree: those whose part of degree two exceeds the noise are kept, the others,
//! orthogonal to them, are asked at degree three, and so on. What remains in the end vanishes as far as was computed.

use super::splitting::dot;
use faer::Mat;
use kutzbach_math::group::Series;
use kutzbach_math::matrix::MatrixError;

/// The effective equations.
pub(super) struct Effective {
    /// Each as an orthonormal combination of the given ones.
    pub combinations: Vec<Vec<f64>>,
    /// The equations; what is below the order of each is exactly zero.
    pub equations: Vec<Series>,
    /// By how much each equation exceeds the noise.
    pub margins: Vec<f64>,
    /// Smallest factor by which what was dropped stays below its bound; infinite where nothing was.
    pub margin: f64,
}

/// Takes the independent equations among `kappa`, of which each degree's coefficients are known to within `noise[degree]`
/// in the Frobenius norm. A singular value of the coefficients of one degree is kept if it exceeds that bound (Weyl).
///
/// To vanish within a noise as large as such coefficients are anyway means nothing, and the margin says so: a joint variable
/// of one moves its cycle by about one, so that terms of degree k are of the size 1/k!, those of the exponential.
pub(super) fn independent(kappa: &[Series], noise: &[f64]) -> Result<Effective, MatrixError> {
    let mut effective = Effective {
        combinations: Vec::new(),
        margins: Vec::new(),
        equations: Vec::new(),
        margin: f64::INFINITY,
    };
    let mut open: Vec<Vec<f64>> = (0..kappa.len())
        .map(|i| {
            (0..kappa.len())
                .map(|j| f64::from(u8::from(i == j)))
                .collect()
        })
        .collect();
    let mut natural = 1.0;
    for (degree, &noise) in noise.iter().enumerate().skip(2) {
        natural /= degree as f64;
        let Some(first) = kappa.first() else {
            break;
        };
        let width = first.of_degree(degree).len();
        if open.is_empty() {
            break;
        }
        let parts: Vec<Vec<f64>> = open
            .iter()
            .map(|combination| {
                let mut part = vec![0.0; width];
                for (factor, series) in combination.iter().zip(kappa) {
                    for (sum, c) in part.iter_mut().zip(series.of_degree(degree)) {
                        *sum += factor * c;
                    }
                }
                part
            })
            .collect();
        let norm = parts.iter().map(|p| dot(p, p)).sum::<f64>().sqrt();
        if !norm.is_finite() {
            return Err(MatrixError::NotFinite { row: 0, column: 0 });
        }
        if norm <= noise {
            effective.below(norm, noise, natural);
            continue;
        }
        let dense = Mat::<f64>::from_fn(open.len(), width, |i, j| parts[i][j]);
        let svd = dense.svd().map_err(|_| MatrixError::Decomposition {
            rows: open.len(),
            columns: width,
            reason: "the singular value decomposition did not converge",
        })?;
        let (u, values) = (svd.U(), svd.S().column_vector());
        let rotated = |k: usize| -> Vec<f64> {
            let mut sum = vec![0.0; kappa.len()];
            for (i, combination) in open.iter().enumerate() {
                for (s, c) in sum.iter_mut().zip(combination) {
                    *s += u[(i, k)] * c;
                }
            }
            sum
        };
        let mut left = Vec::new();
        for k in 0..open.len() {
            let value = if k < values.nrows() { values[k] } else { 0.0 };
            if value > noise {
                effective.margins.push(value / noise);
                effective.keep(kappa, rotated(k), degree);
            } else {
                effective.below(value, noise, natural);
                left.push(rotated(k));
            }
        }
        open = left;
    }
    Ok(effective)
}

impl Effective {
    fn below(&mut self, value: f64, noise: f64, natural: f64) {
        if value > 0.0 {
            self.margin = self.margin.min(noise / value);
        }
        if noise > 0.0 {
            self.margin = self.margin.min(natural / noise);
        }
    }

    /// Adds a combination, with the sign that makes the first large coefficient of its lowest degree positive.
    fn keep(&mut self, kappa: &[Series], mut combination: Vec<f64>, order: usize) {
        let mut equation = Series::zero(kappa[0].monomials());
        for (factor, series) in combination.iter().zip(kappa) {
            equation.add_scaled(*factor, series);
        }
        let below = equation.monomials().count_up_to(order - 1);
        equation.coefficients_mut()[..below].fill(0.0);
        let half = 0.5 * equation.size_of_degree(order);
        if equation
            .of_degree(order)
            .iter()
            .find(|c| c.abs() >= half)
            .is_some_and(|c| *c < 0.0)
        {
            equation = -&equation;
            combination.iter_mut().for_each(|x| *x = -*x);
        }
        self.combinations.push(combination);
        self.equations.push(equation);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_math::group::Monomials;

    #[test]
    fn a_cubic_hidden_behind_a_quadric_is_found() {
        // q = uv, c = u³: given as q + c, 2q + c and 3q + 2c up to 1e-14.
        let m = Monomials::new(2, 3).unwrap();
        let (uv, u3) = (m.index_of(&[1, 1]).unwrap(), m.index_of(&[3, 0]).unwrap());
        let kappa: Vec<Series> = [[1.0, 1.0], [2.0, 1.0], [3.0, 2.0 + 1e-14]]
            .iter()
            .map(|[q, c]| {
                let mut series = Series::zero(&m);
                series.coefficients_mut()[uv] = *q;
                series.coefficients_mut()[u3] = *c;
                series
            })
            .collect();
        let found = independent(&kappa, &[0.0, 0.0, 1e-12, 1e-12]).unwrap();
        assert_eq!(found.equations.len(), 2);
        assert!((found.equations[0].coefficients()[uv] - 14f64.sqrt()).abs() < 1e-14);
        assert_eq!(found.equations[1].coefficients()[uv], 0.0);
        assert!(found.equations[1].coefficients()[u3] > 0.1);
        assert!(found.margin > 10.0 && found.margins.iter().all(|m| *m > 1e10));
        for a in 0..2 {
            for b in 0..2 {
                let product = dot(&found.combinations[a], &found.combinations[b]);
                assert!((product - f64::from(u8::from(a == b))).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn nothing_but_noise_is_no_equation() {
        let m = Monomials::new(2, 3).unwrap();
        let tiny = Series::from_coefficients(&m, vec![1e-16; m.count()]);
        let found = {
            let noise = [0.0, 0.0, 1e-13, 1e-13];
            independent(&[tiny.clone(), tiny.clone()], &noise).unwrap()
        };
        assert!(found.equations.is_empty());
        assert!(found.margin > 100.0 && found.margin.is_finite());
        // Where any coefficient could be noise, its absence is no finding.
        let coarse = independent(&[tiny], &[0.0, 0.0, 0.5, 0.5]).unwrap();
        assert!(coarse.equations.is_empty() && coarse.margin <= 2.0);
        assert!(
            independent(&[], &[0.0, 0.0, 1.0])
                .unwrap()
                .equations
                .is_empty()
        );
    }
}
