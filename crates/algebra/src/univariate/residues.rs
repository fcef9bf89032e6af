//! Polynomials in one variable modulo a prime, as vectors of residues by ascending power without trailing zeros.

use super::Univariate;
use num_bigint::BigInt;
use polycore::crt;
use polycore::modp::{add, inv, mul, neg, sub};

pub(crate) use polycore::Primes;
pub(crate) use polycore::crt::symmetric;
pub(crate) use polycore::modp;

/// Coefficients modulo a prime.
pub(crate) type Residues = Vec<u64>;

/// An integer modulo a prime.
pub(crate) fn residue(value: &BigInt, prime: u64) -> u64 {
    crt::residue(value, prime)
}

/// Every coefficient modulo a prime.
pub(crate) fn image(polynomial: &Univariate, prime: u64) -> Residues {
    let values = polynomial.coefficients();
    trimmed(values.iter().map(|c| residue(c, prime)).collect())
}

pub(crate) fn trimmed(mut values: Residues) -> Residues {
    while values.last() == Some(&0) {
        values.pop();
    }
    values
}

pub(crate) fn difference(a: &[u64], b: &[u64], prime: u64) -> Residues {
    let longest = a.len().max(b.len());
    let at = |v: &[u64], i: usize| v.get(i).copied().unwrap_or(0);
    trimmed(
        (0..longest)
            .map(|i| sub(at(a, i), at(b, i), prime))
            .collect(),
    )
}

pub(crate) fn product(a: &[u64], b: &[u64], prime: u64) -> Residues {
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    let mut values = vec![0; a.len() + b.len() - 1];
    for (i, &x) in a.iter().enumerate() {
        for (j, &y) in b.iter().enumerate() {
            values[i + j] = add(values[i + j], mul(x, y, prime), prime);
        }
    }
    trimmed(values)
}

/// Quotient and remainder; the divisor is not zero.
pub(crate) fn divided(a: &[u64], b: &[u64], prime: u64) -> (Residues, Residues) {
    let degree = b.len() - 1;
    let mut rest = a.to_vec();
    if rest.len() <= degree {
        return (Vec::new(), rest);
    }
    let head = inv(b[degree], prime);
    let mut quotient = vec![0; rest.len() - degree];
    for i in (0..quotient.len()).rev() {
        let q = mul(rest[i + degree], head, prime);
        quotient[i] = q;
        if q != 0 {
            let minus = neg(q, prime);
            for (r, &c) in rest[i..].iter_mut().zip(b) {
                *r = add(*r, mul(minus, c, prime), prime);
            }
        }
    }
    rest.truncate(degree);
    (trimmed(quotient), trimmed(rest))
}

pub(crate) fn remainder(a: &[u64], b: &[u64], prime: u64) -> Residues {
    divided(a, b, prime).1
}

pub(crate) fn monic(a: &[u64], prime: u64) -> Residues {
    let Some(&head) = a.last() else {
        return Vec::new();
    };
    let factor = inv(head, prime);
    a.iter().map(|&c| mul(c, factor, prime)).collect()
}

/// The monic greatest common divisor.
pub(crate) fn gcd(a: &[u64], b: &[u64], prime: u64) -> Residues {
    let (mut a, mut b) = (a.to_vec(), b.to_vec());
    while !b.is_empty() {
        let rest = remainder(&a, &b, prime);
        a = std::mem::replace(&mut b, rest);
    }
    monic(&a, prime)
}

/// (s, t) with s·a + t·b = 1, for coprime a and b.
pub(crate) fn bezout(a: &[u64], b: &[u64], prime: u64) -> (Residues, Residues) {
    let (mut r0, mut r1) = (a.to_vec(), b.to_vec());
    let (mut s0, mut s1) = (vec![1], Vec::new());
    let (mut t0, mut t1) = (Vec::new(), vec![1]);
    while !r1.is_empty() {
        let (q, r) = divided(&r0, &r1, prime);
        r0 = std::mem::replace(&mut r1, r);
        let s = difference(&s0, &product(&q, &s1, prime), prime);
        s0 = std::mem::replace(&mut s1, s);
        let t = difference(&t0, &product(&q, &t1, prime), prime);
        t0 = std::mem::replace(&mut t1, t);
    }
    let unit = inv(r0[0], prime);
    let scaled = |v: &[u64]| v.iter().map(|&c| mul(c, unit, prime)).collect();
    (scaled(&s0), scaled(&t0))
}

/// `base` to a power, modulo a polynomial.
pub(crate) fn power(base: &[u64], exponent: u64, modulus: &[u64], prime: u64) -> Residues {
    let base = remainder(base, modulus, prime);
    let mut result = remainder(&[1], modulus, prime);
    for bit in (0..u64::BITS - exponent.leading_zeros()).rev() {
        result = remainder(&product(&result, &result, prime), modulus, prime);
        if exponent >> bit & 1 == 1 {
            result = remainder(&product(&result, &base, prime), modulus, prime);
        }
    }
    result
}

/// The derivative.
pub(crate) fn derivative(a: &[u64], prime: u64) -> Residues {
    let terms = a.iter().enumerate().skip(1);
    trimmed(terms.map(|(i, &c)| mul(c, i as u64, prime)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bezout_gives_one() {
        let p = 101;
        let (a, b) = (vec![1, 0, 1], vec![5, 3, 2, 1]);
        let (s, t) = bezout(&a, &b, p);
        let sum = difference(
            &product(&s, &a, p),
            &difference(&[], &product(&t, &b, p), p),
            p,
        );
        assert_eq!(sum, vec![1]);
    }

    #[test]
    fn fermat() {
        let p = 101;
        // x^p = x modulo a product of distinct linear polynomials.
        let f = product(&[p - 3, 1], &product(&[p - 7, 1], &[p - 50, 1], p), p);
        assert_eq!(power(&[0, 1], p, &f, p), vec![0, 1]);
        assert_eq!(gcd(&f, &[p - 7, 1], p), vec![p - 7, 1]);
        assert_eq!(gcd(&f, &derivative(&f, p), p), vec![1]);
    }
}
