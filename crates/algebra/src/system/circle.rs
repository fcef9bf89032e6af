//! Fractions of a turn: all cosines and sines of multiples of 2π/M are polynomials in one number, 2 cos(2π/M).

use super::element::{Element, trim};
use super::field::{Field, FieldLimit};
use super::fraction::{Fraction, fraction, power_modulo, residue, to_f64};
use dashu_int::IBig;
use kutzbach_math::number::Number;

/// Largest M.
const MAX_DENOMINATOR: u32 = 4_000;
/// Largest degree of 2 cos(2π/M).
const MAX_DEGREE: u32 = 12;

/// cos(2π k/n).
pub(super) fn cosine_of_turn(k: i64, n: u32) -> Number {
    let turn = Number::ratio(2 * k, i64::from(n.max(1))).unwrap_or_else(Number::zero);
    (turn * Number::pi()).cos_sin().0
}

pub(super) fn totient(n: u32) -> u32 {
    (1..=n).filter(|&k| gcd(k, n) == 1).count() as u32
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The minimal polynomial of 2 cos(2π/M), lowest coefficient first; `None` where its degree is too high.
///
/// The cyclotomic polynomial is palindromic, Φ(x) = x^m Ψ(x + 1/x) with 2m its degree (Watkins & Zeitlin 1993), and
/// x^j + x^-j is the polynomial of [`multiple`] in x + 1/x.
pub(super) fn minimal_polynomial(denominator: u32) -> Option<Vec<IBig>> {
    if denominator == 0 || denominator > MAX_DENOMINATOR {
        return None;
    }
    if denominator <= 2 {
        let root = if denominator == 1 { -2 } else { 2 };
        return Some(vec![root.into(), IBig::ONE]);
    }
    let half = totient(denominator) / 2;
    if half > MAX_DEGREE {
        return None;
    }
    let cyclotomic = cyclotomic(denominator);
    let half = half as usize;
    let mut result = vec![IBig::ZERO; half + 1];
    for j in 0..=half {
        let coefficient = &cyclotomic[half + j];
        for (power, c) in multiple(j as u32).iter().enumerate() {
            // The constant multiple stands for 2 cos 0 = 2, but occurs once.
            let c = if j == 0 { IBig::ONE } else { c.clone() };
            result[power] += coefficient * c;
        }
    }
    Some(result)
}

/// Φ of x: xⁿ − 1 divided by Φ of every proper divisor.
fn cyclotomic(n: u32) -> Vec<IBig> {
    let mut result = vec![IBig::ZERO; n as usize + 1];
    result[0] = -IBig::ONE;
    result[n as usize] = IBig::ONE;
    for d in (1..n).filter(|d| n.is_multiple_of(*d)) {
        result = divided(&result, &cyclotomic(d));
    }
    result
}

/// The quotient by a monic polynomial that divides.
fn divided(a: &[IBig], b: &[IBig]) -> Vec<IBig> {
    let mut rest = a.to_vec();
    let degree = b.len() - 1;
    let mut quotient = vec![IBig::ZERO; a.len() - degree];
    for place in (0..quotient.len()).rev() {
        let lead = rest[place + degree].clone();
        for (i, c) in b.iter().enumerate() {
            rest[place + i] -= &lead * c;
        }
        quotient[place] = lead;
    }
    quotient
}

/// 2 cos(jθ) as a polynomial in 2 cos θ, lowest coefficient first: C₀ = 2, C₁ = y, Cⱼ₊₁ = y Cⱼ − Cⱼ₋₁.
fn multiple(j: u32) -> Vec<IBig> {
    let mut before = vec![IBig::from(2)];
    if j == 0 {
        return before;
    }
    let mut current = vec![IBig::ZERO, IBig::ONE];
    for _ in 1..j {
        let mut next = vec![IBig::ZERO];
        next.extend(current.iter().cloned());
        for (x, y) in next.iter_mut().zip(&before) {
            *x -= y;
        }
        before = std::mem::replace(&mut current, next);
    }
    current
}

/// cos(2π k/M) in a field whose first generator is 2 cos(2π/M), or in the rationals where that is rational.
pub(super) fn cosine(field: &Field, k: u32, denominator: u32) -> Element {
    let half = fraction(1, 2);
    let base = match field.circle {
        Some(_) => Element::generator(0),
        // 2 cos(2π/M) for M in 1, 2, 3, 4, 6.
        None => Element::integer(match denominator {
            1 => 2,
            2 => -2,
            3 => -1,
            4 => 0,
            _ => 1,
        }),
    };
    let k = k % denominator;
    let k = k.min(denominator - k);
    let (mut before, mut current) = (Element::integer(2), base.clone());
    if k == 0 {
        return Element::integer(1);
    }
    for _ in 1..k {
        let next = field.multiply(&base, &current).minus(&before);
        before = std::mem::replace(&mut current, next);
    }
    current.scaled(&half)
}

/// A square root in the field of 2 cos(2π/M) alone, or a proof that there is none.
///
/// That field is Galois over the rationals with the conjugates 2 cos(2πk/M), all real. A root takes at them the values
/// ±√(conjugates of a), so that some choice of signs interpolates to it; doubles propose its coefficients, and the square
/// is compared exactly. Where no choice succeeds, a prime ≡ ±1 modulo M modulo which some image of `a` is no square
/// proves that there is no root; if no such prime is found the question stays open, which counts as too high a degree.
pub(super) fn square_root(
    field: &Field,
    a: &Element,
    denominator: u32,
) -> Result<Option<Element>, FieldLimit> {
    let coefficients = coefficients(a);
    let conjugates: Vec<f64> = (1..=denominator / 2)
        .filter(|&k| gcd(k, denominator) == 1)
        .map(|k| 2.0 * (f64::from(k) / f64::from(denominator) * std::f64::consts::TAU).cos())
        .collect();
    let size = coefficients.iter().map(|c| to_f64(c).abs()).sum::<f64>();
    let squares: Vec<f64> = conjugates
        .iter()
        .map(|x| {
            coefficients
                .iter()
                .rev()
                .fold(0.0, |sum, c| sum * x + to_f64(c))
        })
        .collect();
    if squares.iter().any(|s| *s < -1e-6 * size) {
        return Ok(None);
    }
    let basis = interpolation(&conjugates);
    for signs in 0..1u32 << (conjugates.len() - 1) {
        let proposed = (0..conjugates.len()).map(|power| {
            let sum: f64 = squares
                .iter()
                .enumerate()
                .map(|(k, s)| {
                    let root = s.max(0.0).sqrt();
                    let signed = if signs >> k & 1 == 1 { -root } else { root };
                    signed * basis[k][power]
                })
                .sum();
            near_fraction(sum)
        });
        let Some(proposed) = proposed.collect::<Option<Vec<Fraction>>>() else {
            continue;
        };
        let mut root = Element::zero();
        for (power, c) in proposed.into_iter().enumerate() {
            let mut exponents = vec![power as u16];
            trim(&mut exponents);
            root.add_term(exponents, c);
        }
        if field.square(&root) == *a {
            return Ok(Some(root));
        }
    }
    if is_no_square(&coefficients, denominator) {
        Ok(None)
    } else {
        Err(FieldLimit::Degree)
    }
}

fn coefficients(a: &Element) -> Vec<Fraction> {
    let degree =
        a.0.keys()
            .map(|e| usize::from(e.first().copied().unwrap_or(0)))
            .max()
            .unwrap_or(0);
    let mut result = vec![Fraction::ZERO; degree + 1];
    for (exponents, c) in &a.0 {
        result[usize::from(exponents.first().copied().unwrap_or(0))] = c.clone();
    }
    result
}

/// Coefficients of the Lagrange polynomials at some points, lowest first.
fn interpolation(points: &[f64]) -> Vec<Vec<f64>> {
    (0..points.len())
        .map(|k| {
            let mut product = vec![1.0];
            for (j, x) in points.iter().enumerate().filter(|(j, _)| *j != k) {
                let scale = 1.0 / (points[k] - points[j]);
                let mut next = vec![0.0; product.len() + 1];
                for (power, c) in product.iter().enumerate() {
                    next[power + 1] += c * scale;
                    next[power] -= c * x * scale;
                }
                product = next;
            }
            product
        })
        .collect()
}

/// A fraction of small denominator within 1e-8.
fn near_fraction(x: f64) -> Option<Fraction> {
    (1..=2_000u64).find_map(|d| {
        let n = (x * d as f64).round();
        ((x * d as f64 - n).abs() < 1e-8 * d as f64 && n.abs() < 1e9).then(|| fraction(n as i64, d))
    })
}

/// Whether some image modulo a prime p ≡ 1 (mod M) has no root.
fn is_no_square(coefficients: &[Fraction], denominator: u32) -> bool {
    let m = u64::from(denominator);
    let mut tried = 0;
    let mut p = m * (1_000_000 / m) + 1;
    while tried < 40 {
        p += m;
        if !is_small_prime(p) {
            continue;
        }
        tried += 1;
        let images: Option<Vec<u64>> = coefficients.iter().map(|c| residue(c, p)).collect();
        let Some(images) = images else { continue };
        let Some(zeta) = (2..p).map(|g| power_modulo(g, (p - 1) / m, p)).find(|&z| {
            (1..=m)
                .filter(|d| m.is_multiple_of(*d) && *d < m)
                .all(|d| power_modulo(z, d, p) != 1)
        }) else {
            continue;
        };
        for k in (1..m).filter(|&k| gcd(k as u32, denominator) == 1) {
            let z = power_modulo(zeta, k, p);
            let y = (z + power_modulo(z, p - 2, p)) % p;
            let image = images.iter().rev().fold(0, |sum, c| (sum * y + c) % p);
            if image != 0 && power_modulo(image, (p - 1) / 2, p) != 1 {
                return true;
            }
        }
    }
    false
}

fn is_small_prime(n: u64) -> bool {
    n > 1
        && (2..)
            .take_while(|d| d * d <= n)
            .all(|d| !n.is_multiple_of(d))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn minimal_polynomials_vanish() {
        for m in [1, 2, 3, 4, 5, 6, 7, 9, 14, 18, 28, 36, 40] {
            let polynomial = minimal_polynomial(m).unwrap();
            let y = 2.0 * (std::f64::consts::TAU / f64::from(m)).cos();
            let value = polynomial
                .iter()
                .rev()
                .fold(0.0, |sum, c| sum * y + c.to_f64().value());
            assert!(value.abs() < 1e-9, "{m}: {value}");
        }
        // y³ + y² − 2y − 1 for the heptagon.
        let seven: Vec<i64> = minimal_polynomial(7)
            .unwrap()
            .iter()
            .map(|c| i64::try_from(c.clone()).unwrap())
            .collect();
        assert_eq!(seven, [-1, -2, 1, 1]);
        assert!(minimal_polynomial(997).is_none());
    }

    #[test]
    fn cosines_of_fractions_of_a_turn() {
        for m in [4, 6, 7, 28, 36] {
            let field = Field::with_circle(m).unwrap();
            for k in 0..m {
                let expected = (f64::from(k) / f64::from(m) * std::f64::consts::TAU).cos();
                let found = field.approximate(&cosine(&field, k, m));
                assert!((found - expected).abs() < 1e-12, "{k}/{m}: {found}");
            }
        }
    }
}
