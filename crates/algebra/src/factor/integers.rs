//! Factors of a polynomial in one variable over the integers: Zassenhaus 1969.

use super::hensel::{LiftedFactors, coefficient_bound, lift, product};
use super::modulo_prime::factors_modulo_prime;
use crate::engine::{Budget, Stop};
use crate::univariate::Univariate;
use crate::univariate::residues::{self, Primes, Residues, symmetric};
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// Primes tried; the one with the fewest factors is lifted.
const PRIMES: usize = 5;

/// Most sets of factors modulo a prime that are tried: what two seconds allow.
const MOST_SETS: u64 = 1 << 20;

/// The irreducible factors of a polynomial in one variable, primitive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnivariateFactors {
    /// Factors with their multiplicities, by multiplicity, then degree, then coefficients.
    pub factors: Vec<(Univariate, u32)>,
    /// Whether each of them is proven irreducible. Otherwise a factor may fall apart further: too many combinations of its
    /// factors modulo primes had to be tried.
    pub complete: bool,
}

impl Univariate {
    /// Factors over the rationals (which are those over the integers).
    ///
    /// # Errors
    /// [`Stop`] where the budget does not suffice.
    pub fn factors(&self, budget: &Budget) -> Result<UnivariateFactors, Stop> {
        let mut outcome = UnivariateFactors {
            factors: Vec::new(),
            complete: true,
        };
        for (part, multiplicity) in self.squarefree() {
            let (mut factors, complete) = squarefree_factors(&part, budget)?;
            factors.sort_by(|a, b| {
                (a.degree(), a.coefficients()).cmp(&(b.degree(), b.coefficients()))
            });
            outcome.complete &= complete;
            let with_multiplicity = factors.into_iter().map(|f| (f, multiplicity));
            outcome.factors.extend(with_multiplicity);
        }
        Ok(outcome)
    }
}

/// Degrees that a factor can have, as judged by the degrees of the factors modulo primes: bit d of the set.
#[derive(Clone)]
struct Degrees(Vec<bool>);

impl Degrees {
    fn all(degree: usize) -> Self {
        Self(vec![true; degree + 1])
    }

    fn restrict(&mut self, factors: &[Residues]) {
        let mut sums = vec![false; self.0.len()];
        sums[0] = true;
        for factor in factors {
            let degree = factor.len() - 1;
            for i in (degree..sums.len()).rev() {
                sums[i] |= sums[i - degree];
            }
        }
        for (possible, sum) in self.0.iter_mut().zip(sums) {
            *possible &= sum;
        }
    }

    fn only_trivial(&self) -> bool {
        self.0.iter().filter(|&&possible| possible).count() == 2
    }
}

/// The factors of a primitive squarefree polynomial, and whether all are proven irreducible.
fn squarefree_factors(
    polynomial: &Univariate,
    budget: &Budget,
) -> Result<(Vec<Univariate>, bool), Stop> {
    if polynomial.degree() <= 1 {
        return Ok((vec![polynomial.clone()], true));
    }
    if polynomial.coefficients()[0].is_zero() {
        let x = Univariate::from_integers(&[0, 1]);
        let rest = Univariate::new(polynomial.coefficients()[1..].to_vec());
        let (mut factors, complete) = squarefree_factors(&rest, budget)?;
        factors.retain(|f| f.degree() > 0);
        factors.push(x);
        return Ok((factors, complete));
    }
    let mut degrees = Degrees::all(polynomial.degree());
    let mut best: Option<(u64, Vec<Residues>)> = None;
    let mut tried = 0;
    for prime in Primes::new() {
        let image = residues::image(polynomial, prime);
        if image.len() != polynomial.coefficients().len() {
            continue;
        }
        let slope = residues::derivative(&image, prime);
        if residues::gcd(&image, &slope, prime).len() > 1 {
            continue;
        }
        let factors = factors_modulo_prime(&image, prime, budget)?;
        degrees.restrict(&factors);
        if degrees.only_trivial() {
            return Ok((vec![polynomial.clone()], true));
        }
        if best.as_ref().is_none_or(|(_, b)| factors.len() < b.len()) {
            best = Some((prime, factors));
        }
        tried += 1;
        if tried == PRIMES {
            break;
        }
    }
    let Some((prime, factors)) = best else {
        return Ok((vec![polynomial.clone()], false));
    };
    let bound = coefficient_bound(polynomial) * 2;
    let lifted = lift(polynomial, &factors, prime, &bound, budget)?;
    recombine(polynomial, lifted, degrees, budget)
}

/// Which sets of the lifted factors multiply to true factors: all are tried, the small ones first.
///
/// A true factor times the leading coefficient is such a product times the leading coefficient, and its coefficients are
/// the remainders of smallest size. Its constant coefficient divides that of the whole, which rules out nearly all sets.
fn recombine(
    polynomial: &Univariate,
    lifted: LiftedFactors,
    degrees: Degrees,
    budget: &Budget,
) -> Result<(Vec<Univariate>, bool), Stop> {
    let LiftedFactors {
        factors: mut modular,
        modulus,
    } = lifted;
    let mut rest = polynomial.clone();
    let mut found = Vec::new();
    let mut sets_left = MOST_SETS;
    let mut size = 1;
    while 2 * size <= modular.len() {
        let mut set: Vec<usize> = (0..size).collect();
        let mut hit = None;
        loop {
            budget.multiply(size as u64 * modulus.bits().div_ceil(64))?;
            sets_left = sets_left.saturating_sub(1);
            if sets_left == 0 {
                found.push(rest.primitive());
                return Ok((found, false));
            }
            if let Some(factor) = true_factor(&rest, &modular, &set, &modulus, &degrees) {
                hit = Some(factor);
                break;
            }
            if !next_set(&mut set, modular.len()) {
                break;
            }
        }
        match hit {
            Some((factor, quotient)) => {
                found.push(factor);
                rest = quotient;
                let mut index = 0;
                modular.retain(|_| {
                    index += 1;
                    !set.contains(&(index - 1))
                });
            }
            None => size += 1,
        }
    }
    if rest.degree() > 0 {
        found.push(rest.primitive());
    }
    Ok((found, true))
}

/// The next set of the same size in lexicographic order; `false` after the last one.
pub(super) fn next_set(set: &mut [usize], among: usize) -> bool {
    let size = set.len();
    let Some(place) = (0..size).rev().find(|&i| set[i] + size < among + i) else {
        return false;
    };
    set[place] += 1;
    for i in place + 1..size {
        set[i] = set[i - 1] + 1;
    }
    true
}

/// The factor that a set stands for and the quotient by it, if it divides.
fn true_factor(
    rest: &Univariate,
    modular: &[Vec<BigInt>],
    set: &[usize],
    modulus: &BigInt,
    degrees: &Degrees,
) -> Option<(Univariate, Univariate)> {
    let degree: usize = set.iter().map(|&i| modular[i].len() - 1).sum();
    if !degrees.0[degree] {
        return None;
    }
    let head = rest.leading();
    let constant = set
        .iter()
        .fold(head.clone(), |c, &i| c * &modular[i][0] % modulus);
    let constant = symmetric(&constant, modulus);
    let whole = &head * &rest.coefficients()[0];
    if constant.is_zero() || !(whole % constant).is_zero() {
        return None;
    }
    let product = set
        .iter()
        .fold(vec![head], |p, &i| product(&p, &modular[i], modulus));
    let candidate = product.iter().map(|c| symmetric(c, modulus)).collect();
    let factor = Univariate::new(candidate).primitive();
    let quotient = rest.divided_by(&factor)?;
    debug_assert!(!factor.leading().is_one() || factor.degree() == degree);
    Some((factor, quotient))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn factors(polynomial: &Univariate) -> UnivariateFactors {
        polynomial.factors(&Budget::unlimited()).unwrap()
    }

    fn degrees(polynomial: &Univariate) -> Vec<usize> {
        let outcome = factors(polynomial);
        assert!(outcome.complete);
        outcome.factors.iter().map(|(f, _)| f.degree()).collect()
    }

    /// The polynomial with the roots ±√2 ± √3 ± √5 ..., by resultants with the numbers in place: f(x - √d)·f(x + √d).
    fn swinnerton_dyer(radicands: &[i64]) -> Univariate {
        let mut polynomial = Univariate::from_integers(&[0, 1]);
        for &d in radicands {
            // f(x + y) = even(x, y²) + y·odd(x, y²); the product over y = ±√d is even² - d·odd².
            let (mut even, mut odd) = (Univariate::default(), Univariate::default());
            for (i, c) in polynomial.coefficients().iter().enumerate() {
                let mut binomial = BigInt::one();
                for j in 0..=i {
                    // binomial(i, j)·x^(i-j)·y^j
                    let mut term = vec![BigInt::zero(); i - j + 1];
                    term[i - j] = c * &binomial * BigInt::from(d).pow((j / 2) as u32);
                    let term = Univariate::new(term);
                    if j % 2 == 0 {
                        even = &even + &term;
                    } else {
                        odd = &odd + &term;
                    }
                    binomial = binomial * (i - j) / (j + 1);
                }
            }
            polynomial = &(&even * &even) - &(&odd * &odd).scaled(&d.into());
        }
        polynomial
    }

    #[test]
    fn cyclotomic_factors() {
        for n in [12_usize, 30, 60] {
            let mut coefficients = vec![0; n + 1];
            coefficients[0] = -1;
            coefficients[n] = 1;
            let mut expected: Vec<usize> = (1..=n)
                .filter(|d| n.is_multiple_of(*d))
                .map(|d| {
                    (1..=d)
                        .filter(|&k| integer_gcd(k as u64, d as u64) == 1)
                        .count()
                })
                .collect();
            expected.sort_unstable();
            assert_eq!(degrees(&Univariate::from_integers(&coefficients)), expected);
        }
    }

    fn integer_gcd(a: u64, b: u64) -> u64 {
        if b == 0 { a } else { integer_gcd(b, a % b) }
    }

    #[test]
    fn swinnerton_dyer_polynomials_are_irreducible() {
        assert_eq!(
            swinnerton_dyer(&[2, 3]),
            Univariate::from_integers(&[1, 0, -10, 0, 1])
        );
        assert_eq!(degrees(&swinnerton_dyer(&[-1, 2, 3])), [8]);
        assert_eq!(degrees(&swinnerton_dyer(&[-1, 2, 3, 5])), [16]);
        // The square root of 6 is the product of two others: the polynomial falls into two.
        assert_eq!(degrees(&swinnerton_dyer(&[2, 3, 6])), [4, 4]);
    }

    #[test]
    fn combinations_are_counted_by_the_budget() {
        let hard = swinnerton_dyer(&[-1, 2, 3, 5, 7]);
        assert_eq!(hard.degree(), 32);
        let outcome = factors(&hard);
        assert_eq!(outcome.factors.len(), 1);
        assert!(outcome.complete);
        let budget = Budget::new(crate::Limits {
            work: Some(100_000),
            ..Default::default()
        });
        assert_eq!(hard.factors(&budget), Err(Stop::Work));
    }

    fn polynomial() -> impl Strategy<Value = Univariate> {
        proptest::collection::vec(-20_i64..20, 2..6)
            .prop_map(|c| Univariate::from_integers(&c))
            .prop_filter("not constant", |p| p.degree() > 0)
    }

    proptest! {
        #[test]
        fn factors_multiply_to_the_whole(parts in proptest::collection::vec(polynomial(), 1..5)) {
            let whole = parts.iter().fold(Univariate::from_integers(&[1]), |p, q| &p * q);
            let outcome = factors(&whole);
            prop_assert!(outcome.complete);
            let product = outcome.factors.iter().fold(
                Univariate::from_integers(&[1]),
                |p, (factor, power)| (0..*power).fold(p, |p, _| &p * factor),
            );
            prop_assert_eq!(product, whole.primitive());
            let count: u32 = outcome.factors.iter().map(|(_, power)| power).sum();
            prop_assert!(count as usize >= parts.len());
            for (factor, _) in &outcome.factors {
                let alone = factors(factor);
                prop_assert_eq!(&alone.factors, &vec![(factor.clone(), 1)]);
            }
        }
    }
}
