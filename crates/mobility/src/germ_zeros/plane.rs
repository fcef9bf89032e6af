//! Two variables: candidates for zeros on a small circle, without missing any.
//!
//! Along an edge of the square max(|y₀|, |y₁|) = r each equation is a polynomial in one variable of degree at most K. Its
//! real roots are bracketed by those of its derivative, these by those of the second derivative, and so on up to a
//! constant. The critical points are candidates too: a double root is one.

use super::small::length;
use super::system::{Level, System};
use kutzbach_math::matrix::SplitMix64;

/// Points (radius, unit direction) near which all common zeros on the square of half-width `radius` lie.
pub(super) fn candidates(
    system: &System,
    radius: f64,
    random: &mut SplitMix64,
) -> Vec<(f64, Vec<f64>)> {
    let level = Level::new(system, radius);
    let mut found = Vec::new();
    // A common zero is a zero of every combination; two of them guard against one that happens to be flat there.
    let combinations = if system.count() == 1 { 1 } else { 2 };
    for _ in 0..combinations {
        let weights: Vec<f64> = level
            .weights()
            .iter()
            .map(|w| w * (1.0 + 0.5 * random.symmetric()) * random.symmetric().signum())
            .collect();
        let combination = system.combination(&weights);
        for fixed in 0..2 {
            for sign in [1.0, -1.0] {
                let mut polynomial = vec![0.0; system.degree() + 1];
                for (index, c) in combination.iter().enumerate() {
                    let exponents = system.monomials().exponents(index);
                    let total = i32::from(exponents[0]) + i32::from(exponents[1]);
                    let other = usize::from(exponents[1 - fixed]);
                    let factor = f64::powi(sign, i32::from(exponents[fixed]));
                    polynomial[other] += c * factor * radius.powi(total);
                }
                for t in roots_and_critical_points(&polynomial) {
                    let mut y = [0.0; 2];
                    y[fixed] = sign;
                    y[1 - fixed] = t;
                    let size = length(&y);
                    found.push((radius * size, y.iter().map(|c| c / size).collect()));
                }
            }
        }
    }
    found
}

/// Real roots of Σ c_i tⁱ and of its derivative a little beyond \[−1, 1\].
fn roots_and_critical_points(coefficients: &[f64]) -> Vec<f64> {
    // Zeros at the corners of the square must not fall between two edges.
    const END: f64 = 1.02;
    let largest = coefficients.iter().fold(0.0, |m, c| f64::max(m, c.abs()));
    let degree = coefficients
        .iter()
        .rposition(|c| c.abs() > f64::EPSILON * largest);
    let mut derivatives = vec![coefficients[..=degree.unwrap_or(0)].to_vec()];
    while let Some(last) = derivatives.last()
        && last.len() > 2
    {
        let next = last.iter().enumerate().skip(1).map(|(i, c)| i as f64 * c);
        let next = next.collect();
        derivatives.push(next);
    }
    let mut roots: Vec<f64> = Vec::new();
    let mut critical = Vec::new();
    for polynomial in derivatives.iter().rev() {
        let value = |t: f64| polynomial.iter().rev().fold(0.0, |v, c| v * t + c);
        let mut stops = vec![-END];
        stops.extend(&roots);
        stops.push(END);
        critical = std::mem::take(&mut roots);
        for pair in stops.windows(2) {
            if let Some(root) = bracketed(&value, pair[0], pair[1]) {
                roots.push(root);
            }
        }
    }
    roots.extend(critical);
    roots
}

/// The root between two points of opposite sign where the function is monotone; by bisection, to a few roundings.
fn bracketed(value: &impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> Option<f64> {
    let (at_low, at_high) = (value(low), value(high));
    if at_low == 0.0 {
        return Some(low);
    }
    if at_high == 0.0 || at_low.signum() == at_high.signum() {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if value(middle).signum() == at_low.signum() {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn close_and_double_roots_are_found() {
        // (t − 0.5)(t − 0.5001)(t + 0.3)²(t² + 1)
        let factors: [&[f64]; 4] = [
            &[-0.5, 1.0],
            &[-0.5001, 1.0],
            &[0.09, 0.6, 1.0],
            &[1.0, 0.0, 1.0],
        ];
        let mut product = vec![1.0];
        for factor in factors {
            let mut next = vec![0.0; product.len() + factor.len() - 1];
            for (i, a) in product.iter().enumerate() {
                for (j, b) in factor.iter().enumerate() {
                    next[i + j] += a * b;
                }
            }
            product = next;
        }
        let found = roots_and_critical_points(&product);
        for (root, accuracy) in [(0.5, 1e-10), (0.5001, 1e-10), (-0.3, 1e-6)] {
            assert!(found.iter().any(|t| (t - root).abs() < accuracy), "{root}");
        }
    }
}
