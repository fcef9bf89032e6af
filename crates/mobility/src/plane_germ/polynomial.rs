//! Real roots of polynomials in one variable with their multiplicities, in any number of bits.
//!
//! Roots of a derivative are known before those of the polynomial: a root of the derivative where the polynomial vanishes too is a
//! multiple one, and between two neighbours the polynomial is monotone and has one simple root where its sign changes. A root of
//! multiplicity m is a simple one of the (m−1)st derivative, so that it is known about as well as the coefficients are.

use super::fuzzy::{Fuzzy, derivative, value_at};
use crate::leftover::Doubt;
use kutzbach_math::matrix::Real;

/// A real root.
#[derive(Clone, Debug)]
pub(super) struct Root<R> {
    pub at: Fuzzy<R>,
    pub multiplicity: usize,
}

/// The real roots of `Σ coefficients[i] xⁱ` in ascending order. The last coefficient is not zero.
///
/// # Errors
/// [`Doubt`] where it cannot be told whether a root is multiple.
pub(super) fn real_roots<R: Real>(coefficients: &[Fuzzy<R>]) -> Result<Vec<Root<R>>, Doubt> {
    let degree = coefficients.len().saturating_sub(1);
    let mut derivatives = vec![coefficients.to_vec()];
    for order in 0..degree {
        let next = derivative(&derivatives[order]);
        derivatives.push(next);
    }
    let mut roots: Vec<Root<R>> = Vec::new();
    // The derivative of as many orders as the degree is a constant and has none.
    for order in (0..degree).rev() {
        roots = next(&derivatives[order], &derivatives[order + 1], &roots)?;
    }
    Ok(roots)
}

/// The roots of a polynomial from those of its derivative.
fn next<R: Real>(
    polynomial: &[Fuzzy<R>],
    slope: &[Fuzzy<R>],
    below: &[Root<R>],
) -> Result<Vec<Root<R>>, Doubt> {
    let bound = bound(polynomial);
    let mut found = Vec::new();
    let mut from = -bound.clone();
    let mut from_value = value_at(polynomial, &from).value;
    for root in below {
        let here = value_at(polynomial, &root.at.value);
        if here.is_zero()? {
            found.push(Root {
                at: root.at.clone(),
                multiplicity: root.multiplicity + 1,
            });
            // It leaves zero one way and does not come back before the next root of the derivative.
            from_value = bound.zero_like();
        } else {
            let to = &root.at.value;
            found.extend(crossing(
                polynomial,
                slope,
                [&from, to],
                [&from_value, &here.value],
            ));
            from_value = here.value;
        }
        from = root.at.value.clone();
    }
    let end = value_at(polynomial, &bound).value;
    found.extend(crossing(
        polynomial,
        slope,
        [&from, &bound],
        [&from_value, &end],
    ));
    Ok(found)
}

/// The simple root between two places where the polynomial is monotone, if its sign changes.
fn crossing<R: Real>(
    polynomial: &[Fuzzy<R>],
    slope: &[Fuzzy<R>],
    [from, to]: [&R; 2],
    [before, after]: [&R; 2],
) -> Option<Root<R>> {
    let zero = from.zero_like();
    if before.is_zero() || after.is_zero() || (*before > zero) == (*after > zero) {
        return None;
    }
    let values: Vec<R> = polynomial.iter().map(|c| c.value.clone()).collect();
    let (mut low, mut high) = (from.clone(), to.clone());
    let rising = *after > zero;
    let half = from.constant(0.5);
    for _ in 0..2 * from.bits() {
        let middle = (low.clone() + high.clone()) * half.clone();
        if middle == low || middle == high {
            break;
        }
        if (value(&values, &middle) > zero) == rising {
            high = middle;
        } else {
            low = middle;
        }
    }
    let at = (low + high) * half;
    let error = value_at(polynomial, &at).error / value_at(slope, &at).size();
    Some(Root {
        at: Fuzzy { value: at, error },
        multiplicity: 1,
    })
}

/// The value of Σ cᵢ xⁱ at a place.
pub(super) fn value<R: Real>(polynomial: &[R], at: &R) -> R {
    polynomial
        .iter()
        .rev()
        .fold(at.zero_like(), |sum, c| sum * at.clone() + c.clone())
}

/// All roots are smaller than this (Cauchy).
fn bound<R: Real>(polynomial: &[Fuzzy<R>]) -> R {
    let last = polynomial[polynomial.len() - 1].value.abs();
    let one = last.one_like();
    let largest = polynomial[..polynomial.len() - 1]
        .iter()
        .map(|c| c.value.abs() / last.clone())
        .fold(one.zero_like(), |a, b| if b > a { b } else { a });
    largest + one
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // a test may panic
mod tests {
    use super::*;
    use kutzbach_math::matrix::Extended;

    fn known(value: Extended) -> Fuzzy<Extended> {
        Fuzzy {
            value,
            error: 1e-70,
        }
    }

    fn numbers(list: &[f64]) -> Vec<Fuzzy<Extended>> {
        let one = Extended::new(1.0, 300);
        list.iter().map(|x| known(one.constant(*x))).collect()
    }

    fn product(roots: &[f64], factor: f64) -> Vec<Fuzzy<Extended>> {
        let one = Extended::new(1.0, 300);
        let mut polynomial = vec![one.constant(factor)];
        for root in roots {
            let mut next = vec![one.constant(0.0)];
            next.extend(polynomial.iter().cloned());
            for (n, p) in next.iter_mut().zip(&polynomial) {
                *n = n.clone() - p.clone() * one.constant(*root);
            }
            polynomial = next;
        }
        polynomial.into_iter().map(known).collect()
    }

    #[test]
    fn roots_and_their_multiplicities_are_found() {
        for (roots, wanted) in [
            (vec![1.5], vec![(1.5, 1)]),
            (vec![2.0, -3.0], vec![(-3.0, 1), (2.0, 1)]),
            (vec![0.5, 0.5], vec![(0.5, 2)]),
            (
                vec![0.25, 1.0, 1.0, 1.0, 7.0, 7.0],
                vec![(0.25, 1), (1.0, 3), (7.0, 2)],
            ),
            (
                vec![1e-9, -1e-9, 4.0],
                vec![(-1e-9, 1), (1e-9, 1), (4.0, 1)],
            ),
            (vec![3e-16, 3e-16, 3e-16], vec![(3e-16, 3)]),
            (vec![0.0, 0.0, 0.0], vec![(0.0, 3)]),
        ] {
            for factor in [1.0, -37.0] {
                let found = real_roots(&product(&roots, factor)).unwrap();
                let found: Vec<(f64, usize)> = found
                    .iter()
                    .map(|root| (root.at.value.to_f64(), root.multiplicity))
                    .collect();
                assert_eq!(found.len(), wanted.len(), "{roots:?} {found:?}");
                for ((at, times), (place, multiplicity)) in found.iter().zip(&wanted) {
                    assert!(
                        (at - place).abs() < 1e-25 && times == multiplicity,
                        "{found:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn what_is_not_real_is_no_root() {
        assert!(real_roots(&numbers(&[1.0, 0.0, 1.0])).unwrap().is_empty());
        // (x² + 1e-12)(x − 1)
        let near = numbers(&[-1e-12, 1e-12, -1.0, 1.0]);
        assert_eq!(real_roots(&near).unwrap().len(), 1);
        // A double root but for 1e-65: neither one nor none.
        let mut between = numbers(&[1.0, -2.0, 1.0]);
        let little = between[0].value.constant(1e-65);
        between[0].value = between[0].value.clone() + little;
        assert_eq!(real_roots(&between).err(), Some(Doubt::Precision));
    }
}
