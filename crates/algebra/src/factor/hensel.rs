//! Factors modulo a prime lifted to factors modulo a large power of it.
//!
//! Quadratic lifting along a binary tree of the factors: von zur Gathen and Gerhard, "Modern Computer Algebra", algorithms
//! 15.10 and 15.17.

use crate::engine::{Budget, Stop};
use crate::univariate::Univariate;
use crate::univariate::residues::{self, Residues, modp};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Polynomials modulo a power of a prime: coefficients from zero to the modulus, ascending, without trailing zeros.
type Lifted = Vec<BigInt>;

/// Monic factors modulo `modulus`, a power of the prime.
pub(super) struct LiftedFactors {
    pub(super) factors: Vec<Lifted>,
    pub(super) modulus: BigInt,
}

/// Lifts the monic, pairwise coprime factors of a polynomial modulo a prime until the modulus exceeds `bound`.
///
/// The product of the factors is the polynomial divided by its leading coefficient, which the prime does not divide.
pub(super) fn lift(
    polynomial: &Univariate,
    factors: &[Residues],
    prime: u64,
    bound: &BigInt,
    budget: &Budget,
) -> Result<LiftedFactors, Stop> {
    let mut moduli = vec![BigInt::from(prime)];
    while let Some(last) = moduli.last()
        && last <= bound
    {
        moduli.push(last * last);
    }
    let modulus = moduli[moduli.len() - 1].clone();
    let unit = inverse(&polynomial.leading(), prime, &moduli);
    let monic = reduced(
        polynomial
            .coefficients()
            .iter()
            .map(|c| c * &unit)
            .collect(),
        &modulus,
    );
    let mut lifted = Vec::new();
    lift_tree(&monic, factors, prime, &moduli, budget, &mut lifted)?;
    Ok(LiftedFactors {
        factors: lifted,
        modulus,
    })
}

/// The inverse of an integer modulo the last of the moduli, by Newton's iteration.
fn inverse(value: &BigInt, prime: u64, moduli: &[BigInt]) -> BigInt {
    let mut inverse = BigInt::from(modp::inv(residues::residue(value, prime), prime));
    for modulus in &moduli[1..] {
        let next = &inverse * (BigInt::from(2) - value * &inverse);
        inverse = least(next, modulus);
    }
    inverse
}

fn lift_tree(
    target: &Lifted,
    factors: &[Residues],
    prime: u64,
    moduli: &[BigInt],
    budget: &Budget,
    lifted: &mut Vec<Lifted>,
) -> Result<(), Stop> {
    if factors.len() == 1 {
        lifted.push(target.clone());
        return Ok(());
    }
    let (left, right) = factors.split_at(factors.len() / 2);
    let together = |part: &[Residues]| {
        part.iter()
            .fold(vec![1], |p, factor| residues::product(&p, factor, prime))
    };
    let (g, h) = lift_pair(
        target,
        &together(left),
        &together(right),
        prime,
        moduli,
        budget,
    )?;
    lift_tree(&g, left, prime, moduli, budget, lifted)?;
    lift_tree(&h, right, prime, moduli, budget, lifted)
}

/// Two monic factors from modulo the prime to modulo the last of the moduli.
fn lift_pair(
    target: &Lifted,
    g: &[u64],
    h: &[u64],
    prime: u64,
    moduli: &[BigInt],
    budget: &Budget,
) -> Result<(Lifted, Lifted), Stop> {
    let (s, t) = residues::bezout(g, h, prime);
    let integers = |values: &[u64]| -> Lifted { values.iter().map(|&c| c.into()).collect() };
    let (mut g, mut h) = (integers(g), integers(h));
    let (mut s, mut t) = (integers(&s), integers(&t));
    for (i, m) in moduli.iter().enumerate().skip(1) {
        budget.multiply((target.len() * target.len()) as u64 * m.bits().div_ceil(64))?;
        let error = difference(target, &product(&g, &h, m), m);
        let (q, r) = divided(&product(&s, &error, m), &h, m);
        g = sum(&g, &sum(&product(&t, &error, m), &product(&q, &g, m), m), m);
        h = sum(&h, &r, m);
        if i + 1 < moduli.len() {
            let excess = sum(&product(&s, &g, m), &product(&t, &h, m), m);
            let excess = difference(&excess, &[BigInt::one()], m);
            let (c, d) = divided(&product(&s, &excess, m), &h, m);
            s = difference(&s, &d, m);
            t = difference(
                &t,
                &sum(&product(&t, &excess, m), &product(&c, &g, m), m),
                m,
            );
        }
    }
    Ok((g, h))
}

/// The remainder from zero to the modulus.
fn least(value: BigInt, modulus: &BigInt) -> BigInt {
    let rest = value % modulus;
    if rest.is_negative() {
        rest + modulus
    } else {
        rest
    }
}

fn reduced(values: Lifted, modulus: &BigInt) -> Lifted {
    let mut values: Lifted = values.into_iter().map(|c| least(c, modulus)).collect();
    while values.last().is_some_and(Zero::is_zero) {
        values.pop();
    }
    values
}

pub(super) fn product(a: &Lifted, b: &Lifted, modulus: &BigInt) -> Lifted {
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    let mut values = vec![BigInt::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            values[i + j] += x * y;
        }
    }
    reduced(values, modulus)
}

fn sum(a: &Lifted, b: &Lifted, modulus: &BigInt) -> Lifted {
    let (long, short) = if a.len() < b.len() { (b, a) } else { (a, b) };
    let mut values = long.clone();
    for (x, y) in values.iter_mut().zip(short) {
        *x += y;
    }
    reduced(values, modulus)
}

fn difference(a: &Lifted, b: &[BigInt], modulus: &BigInt) -> Lifted {
    let negative = b.iter().map(|c| -c).collect();
    sum(a, &negative, modulus)
}

/// Quotient and remainder by a monic divisor.
fn divided(a: &Lifted, b: &Lifted, modulus: &BigInt) -> (Lifted, Lifted) {
    let degree = b.len() - 1;
    if a.len() <= degree {
        return (Vec::new(), a.clone());
    }
    let mut rest = a.clone();
    let mut quotient = vec![BigInt::zero(); rest.len() - degree];
    for i in (0..quotient.len()).rev() {
        let q = least(std::mem::take(&mut rest[i + degree]), modulus);
        for (r, c) in rest[i..].iter_mut().zip(&b[..degree]) {
            *r -= &q * c;
        }
        quotient[i] = q;
    }
    rest.truncate(degree);
    (reduced(quotient, modulus), reduced(rest, modulus))
}

/// A bound on every coefficient of every factor of a polynomial times its leading coefficient: Mignotte 1974,
/// 2^degree times the Euclidean norm.
pub(super) fn coefficient_bound(polynomial: &Univariate) -> BigInt {
    let squares: BigInt = polynomial.coefficients().iter().map(|c| c * c).sum();
    ((squares.sqrt() + 1) << polynomial.degree()) * polynomial.leading().abs()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn lifted_factors_multiply_to_the_polynomial() {
        // (2x + 1)(x^2 - 3x + 7)(x + 10)
        let polynomial = &(&Univariate::from_integers(&[1, 2])
            * &Univariate::from_integers(&[7, -3, 1]))
            * &Univariate::from_integers(&[10, 1]);
        let prime = 10_007;
        let factors = super::super::modulo_prime::factors_modulo_prime(
            &residues::image(&polynomial, prime),
            prime,
            &Budget::unlimited(),
        )
        .unwrap();
        let bound = coefficient_bound(&polynomial) * 2;
        let lifted = lift(&polynomial, &factors, prime, &bound, &Budget::unlimited()).unwrap();
        assert!(lifted.modulus > bound);
        let mut whole = vec![polynomial.leading()];
        for factor in &lifted.factors {
            assert_eq!(factor.last(), Some(&BigInt::one()));
            whole = product(&whole, factor, &lifted.modulus);
        }
        let expected = reduced(polynomial.coefficients().to_vec(), &lifted.modulus);
        assert_eq!(whole, expected);
    }
}
