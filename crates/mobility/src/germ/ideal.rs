//! Equations that follow from the others.
//!
//! A left kernel can give more equations than it takes to describe the germ: a second one is y₁ times the first, say, as
//! where a cycle's centre is not quite the point in which all its axes meet. Such an equation changes no zero, but two
//! equations in two variables are another problem than one. An equation is dropped if, up to the computed degree, it is a
//! combination of multiples x^α f_j of those before it. By Nakayama's lemma what remains generates the same ideal, to the
//! order computed.

use super::effective::Effective;
use super::reduction::order_of;
use super::splitting::dot;
use faer::Mat;
use kutzbach_math::group::{Monomials, Series};
use kutzbach_math::matrix::MatrixError;

/// Unit of the variables: the germ's coefficients grow by about 1/σ per degree, with σ the smallest kept singular value
/// of the Jacobian, which is a few tenths for most mechanisms; so those of high degree do not hide the lowest.
const RADIUS: f64 = 0.25;

/// Systems with more entries than this are left as they are.
const MOST_ENTRIES: usize = 400_000;

/// Drops what follows from the equations before, each of which is known to within `noise` by degree.
pub(super) fn drop_consequences(
    effective: &mut Effective,
    noise: &[f64],
) -> Result<(), MatrixError> {
    let Some(lowest) = effective.equations.iter().filter_map(order_of).min() else {
        return Ok(());
    };
    let mut kept: Vec<usize> = Vec::new();
    for index in 0..effective.equations.len() {
        let equation = &effective.equations[index];
        // Those of the lowest order are independent in that order already.
        if order_of(equation) != Some(lowest) {
            let before: Vec<&Series> = kept.iter().map(|i| &effective.equations[*i]).collect();
            if let Some(rest) = what_remains(equation, &before, noise)? {
                if rest.size <= rest.noise {
                    effective.margins[index] = rest.noise / rest.size.max(f64::MIN_POSITIVE);
                    continue;
                }
                effective.margins[index] = effective.margins[index].min(rest.size / rest.noise);
            }
        }
        kept.push(index);
    }
    effective.margin = effective
        .margins
        .iter()
        .copied()
        .fold(effective.margin, f64::min);
    effective.equations = kept
        .iter()
        .map(|i| effective.equations[*i].clone())
        .collect();
    effective.combinations = kept
        .iter()
        .map(|i| effective.combinations[*i].clone())
        .collect();
    effective.margins = kept.iter().map(|i| effective.margins[*i]).collect();
    Ok(())
}

/// What is left of an equation of unit length beside the multiples of others, and the error of that.
struct Rest {
    size: f64,
    noise: f64,
}

fn what_remains(
    equation: &Series,
    before: &[&Series],
    noise: &[f64],
) -> Result<Option<Rest>, MatrixError> {
    let monomials = equation.monomials();
    let degree = monomials.degree();
    let (target, error) = scaled(equation, noise);
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut row_error = 0.0f64;
    for other in before {
        let order = order_of(other).unwrap_or(degree);
        let (unit, error) = scaled(other, noise);
        row_error = row_error.max(error);
        let shifts = monomials.count_up_to(degree - order);
        if (rows.len() + shifts) * monomials.count() > MOST_ENTRIES {
            return Ok(None);
        }
        rows.extend((0..shifts).map(|shift| multiple(&unit, monomials, shift)));
    }
    let columns = monomials.count();
    let dense = Mat::<f64>::from_fn(columns, rows.len(), |i, j| rows[j][i]);
    let svd = dense.thin_svd().map_err(|_| MatrixError::Decomposition {
        rows: columns,
        columns: rows.len(),
        reason: "the singular value decomposition did not converge",
    })?;
    let (u, values) = (svd.U(), svd.S().column_vector());
    // Directions that errors alone could make.
    let cut = 10.0 * row_error * (rows.len() as f64).sqrt() + 1e-14;
    let mut rest = target.clone();
    let mut factors = 0.0;
    for k in (0..values.nrows()).filter(|k| values[*k] > cut) {
        let along: f64 = target.iter().enumerate().map(|(i, x)| x * u[(i, k)]).sum();
        for (i, x) in rest.iter_mut().enumerate() {
            *x -= along * u[(i, k)];
        }
        factors += (along / values[k]).powi(2);
    }
    // |Σ c_r Δ_r| ≤ |c| √rows · error of a row.
    let noise = error + factors.sqrt() * (rows.len() as f64).sqrt() * row_error;
    Ok(Some(Rest {
        size: dot(&rest, &rest).sqrt(),
        noise: noise.max(f64::MIN_POSITIVE),
    }))
}

/// The coefficients in units of [`RADIUS`], together of unit length, and the error of that.
pub(super) fn scaled(equation: &Series, noise: &[f64]) -> (Vec<f64>, f64) {
    let monomials = equation.monomials();
    let mut coefficients: Vec<f64> = Vec::with_capacity(monomials.count());
    let mut error = 0.0;
    for degree in 0..=monomials.degree() {
        let weight = RADIUS.powi(degree as i32);
        coefficients.extend(equation.of_degree(degree).iter().map(|c| c * weight));
        error += weight * noise.get(degree).copied().unwrap_or(0.0);
    }
    let norm = dot(&coefficients, &coefficients).sqrt();
    if norm > 0.0 {
        coefficients.iter_mut().for_each(|c| *c /= norm);
        error /= norm;
    }
    (coefficients, error)
}

/// Coefficients of a series times a monomial; what exceeds the degree is cut off.
fn multiple(coefficients: &[f64], monomials: &Monomials, shift: usize) -> Vec<f64> {
    let mut row = vec![0.0; monomials.count()];
    let reach = monomials.count_up_to(monomials.degree() - monomials.degree_of(shift));
    for (slot, c) in coefficients[..reach].iter().enumerate() {
        if *c == 0.0 {
            continue;
        }
        let exponents: Vec<u8> = monomials
            .exponents(shift)
            .iter()
            .zip(monomials.exponents(slot))
            .map(|(a, b)| a + b)
            .collect();
        if let Some(sum) = monomials.index_of(&exponents) {
            row[sum] = *c;
        }
    }
    row
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const NOISE: [f64; 5] = [1e-13; 5];

    fn kept(equations: Vec<Series>) -> (usize, f64) {
        let mut effective = Effective {
            combinations: vec![Vec::new(); equations.len()],
            margins: vec![f64::INFINITY; equations.len()],
            equations,
            margin: f64::INFINITY,
        };
        drop_consequences(&mut effective, &NOISE).unwrap();
        (effective.equations.len(), effective.margin)
    }

    #[test]
    fn multiples_of_an_equation_are_dropped_and_others_kept() {
        let m = Monomials::new(2, 4).unwrap();
        let (x, y) = (
            Series::linear(&m, &[1.0, 0.0]),
            Series::linear(&m, &[0.0, 1.0]),
        );
        let f = &(&x * &y).scaled(0.4) + &(&(&x * &x) * &x).scaled(3.0);
        // (x − 2 y + x²) f, small as where a centre is off by a millionth.
        let factor = &(&x - &y.scaled(2.0)) + &(&x * &x);
        let follows = (&factor * &f).scaled(1e-6);
        let (count, margin) = kept(vec![f.clone(), follows.clone()]);
        assert_eq!(count, 1);
        assert!(margin > 2.0);
        let new = &follows + &(&(&x * &x) * &x).scaled(1e-7);
        assert_eq!(kept(vec![f.clone(), new]).0, 2);
        // Two quadrics are two, whatever they are.
        assert_eq!(kept(vec![f.clone(), &x * &x]).0, 2);
        assert_eq!(kept(vec![f]).0, 1);
        assert_eq!(kept(vec![]).0, 0);
    }
}
