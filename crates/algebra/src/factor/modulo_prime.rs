//! Factors of a squarefree polynomial modulo a prime: Cantor and Zassenhaus 1981.

use crate::engine::{Budget, Stop};
use crate::univariate::residues::{
    Residues, difference, divided, gcd, modp, monic, power, product, remainder, trimmed,
};

/// The monic irreducible factors of a squarefree polynomial modulo an odd prime.
pub(super) fn factors_modulo_prime(
    polynomial: &[u64],
    prime: u64,
    budget: &Budget,
) -> Result<Vec<Residues>, Stop> {
    let mut factors = Vec::new();
    let mut rest = monic(polynomial, prime);
    let frobenius = Frobenius::new(&rest, prime, budget)?;
    let identity: Residues = vec![0, 1];
    // x to the power prime^degree.
    let mut power = identity.clone();
    let mut degree = 0;
    while rest.len() > 2 * (degree + 1) {
        degree += 1;
        power = frobenius.of(&power, budget)?;
        let group = gcd(&rest, &difference(&power, &identity, prime), prime);
        if group.len() > 1 {
            rest = divided(&rest, &group, prime).0;
            split_equal_degrees(group, degree, &frobenius, budget, &mut factors)?;
        }
    }
    if rest.len() > 1 {
        factors.push(rest);
    }
    factors.sort();
    Ok(factors)
}

/// Raising to the power of the prime, modulo a polynomial: a linear map, known by the images of the powers of x.
struct Frobenius {
    prime: u64,
    images: Vec<Residues>,
}

impl Frobenius {
    fn new(modulus: &[u64], prime: u64, budget: &Budget) -> Result<Self, Stop> {
        budget.multiply(multiplications(modulus.len()))?;
        let first = power(&[0, 1], prime, modulus, prime);
        let mut images = vec![remainder(&[1], modulus, prime)];
        for i in 0..modulus.len().saturating_sub(2) {
            budget.multiply((modulus.len() * modulus.len()) as u64)?;
            let next = product(&images[i], &first, prime);
            images.push(remainder(&next, modulus, prime));
        }
        Ok(Self { prime, images })
    }

    fn of(&self, argument: &[u64], budget: &Budget) -> Result<Residues, Stop> {
        budget.multiply((self.images.len() * self.images.len()) as u64)?;
        let mut sum = vec![0; self.images.len()];
        for (&c, image) in argument.iter().zip(&self.images) {
            for (entry, &value) in sum.iter_mut().zip(image) {
                *entry = modp::add(*entry, modp::mul(c, value, self.prime), self.prime);
            }
        }
        Ok(trimmed(sum))
    }
}

/// Word operations of one power with an exponent of 62 bits.
fn multiplications(length: usize) -> u64 {
    128 * (length * length) as u64
}

/// Splits a product of distinct irreducible polynomials of one known degree.
///
/// A random residue is a square modulo each factor with probability one half, independently; the power (p^d - 1)/2 tells
/// which. It is taken as the power (p - 1)/2 of the norm.
fn split_equal_degrees(
    whole: Residues,
    degree: usize,
    frobenius: &Frobenius,
    budget: &Budget,
    factors: &mut Vec<Residues>,
) -> Result<(), Stop> {
    let prime = frobenius.prime;
    let mut draws = Draws(prime);
    let mut waiting = vec![whole];
    while let Some(group) = waiting.pop() {
        if group.len() == degree + 1 {
            factors.push(group);
            continue;
        }
        budget.multiply(multiplications(group.len()))?;
        let residue = trimmed((1..group.len()).map(|_| draws.below(prime)).collect());
        let mut conjugate = residue.clone();
        let mut norm = residue;
        for _ in 1..degree {
            conjugate = remainder(&frobenius.of(&conjugate, budget)?, &group, prime);
            norm = remainder(&product(&norm, &conjugate, prime), &group, prime);
        }
        let sign = power(&norm, (prime - 1) / 2, &group, prime);
        let part = gcd(&group, &difference(&sign, &[1], prime), prime);
        if part.len() > 1 && part.len() < group.len() {
            waiting.push(divided(&group, &part, prime).0);
            waiting.push(part);
        } else {
            waiting.push(group);
        }
    }
    Ok(())
}

/// A fixed sequence of numbers without pattern (splitmix64, Steele, Lea and Flood 2014).
struct Draws(u64);

impl Draws {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % bound
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn product_of_the_factors_is_the_polynomial() {
        let prime = 1_000_003;
        // x^12 - 1 modulo a prime with prime = 7 modulo 12: the cyclotomic factors split by the order of the prime.
        let mut polynomial = vec![0; 13];
        polynomial[0] = prime - 1;
        polynomial[12] = 1;
        let factors = factors_modulo_prime(&polynomial, prime, &Budget::unlimited()).unwrap();
        let whole = factors
            .iter()
            .fold(vec![1], |p, factor| product(&p, factor, prime));
        assert_eq!(whole, polynomial);
        let linear = factors.iter().filter(|f| f.len() == 2).count();
        assert_eq!((linear, factors.len()), (6, 9));
    }
}
