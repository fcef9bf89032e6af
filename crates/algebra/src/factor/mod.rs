//! Factors of polynomials over the rationals.
//!
//! A closure equation that factors tells of pieces: `s3·(c4 + 1) = 0` means that one joint stands still or another one lies
//! folded. The factors must be right, and all of them must be found, or it must be said that there may be more.
//!
//! In one variable (`integers.rs`): factors modulo a prime, lifted, and combined in every possible way; irreducibility is
//! proven because the combinations are exhausted or because the degrees modulo several primes leave no choice.
//!
//! In several variables: the polynomial is restricted to a line. If the degree stays and the restriction is irreducible, so
//! is the polynomial. Otherwise the factors of the restriction are lifted to power series around the line and combined in
//! every possible way. By Hilbert's irreducibility theorem nearly every line leaves exactly the true factors, so there is
//! little to combine. The cost is that of the dense polynomials around the line: right for the small polynomials of
//! mechanisms (a few variables, degree up to about ten), wrong for large sparse ones.

mod hensel;
mod integers;
mod line;
mod modulo_prime;
mod series;

pub use integers::UnivariateFactors;

use super::engine::{Budget, Stop};
use super::polynomial::{Polynomial, Rational};
use super::univariate::{Dense, Univariate};
use integers::next_set;
use line::Line;
use num_traits::{One, Zero};
use series::{Series, lift_all, root};
use std::cmp::Reverse;

/// Lines that are tried before the factors of a restriction are combined: the one with the fewest is taken.
const LINES: usize = 4;

/// Lines that may turn out useless (the degree drops, roots coincide) before the attempt is given up. A useless line is a
/// root of a polynomial that is not zero; among so many it does not happen that all of them are.
const MOST_LINES: usize = 60;

/// Most sets of factors on a line that are combined.
const MOST_SETS: usize = 1 << 12;

/// Most terms that a polynomial may have around a line, where it is dense: what a few seconds allow.
const MOST_TERMS: u64 = 20_000;

/// A polynomial as a product.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factorization {
    /// The constant factor.
    pub unit: Rational,
    /// Primitive factors that are no constants, with their multiplicities, in a fixed order.
    pub factors: Vec<(Polynomial, u32)>,
    /// Whether each factor is proven irreducible. Otherwise some may fall apart further.
    pub complete: bool,
}

/// The factors of a polynomial over the rationals. Zero has no factors and the unit zero.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn factor(polynomial: &Polynomial, budget: &Budget) -> Result<Factorization, Stop> {
    let variables = polynomial.variables();
    let mut outcome = Factorization {
        unit: Rational::zero(),
        factors: Vec::new(),
        complete: true,
    };
    let Some((_, head)) = polynomial.terms().next() else {
        return Ok(outcome);
    };
    let primitive = polynomial.primitive();
    if let Some((_, primitive_head)) = primitive.terms().next() {
        outcome.unit = head / primitive_head;
    }
    let rest = split_monomial(&primitive, &mut outcome);
    let used: Vec<usize> = (0..variables).filter(|&v| rest.mentions(v)).collect();
    match used.as_slice() {
        [] => {}
        &[only] => {
            if let Some(one) = Univariate::from_polynomial(&rest, only) {
                let found = one.factors(budget)?;
                outcome.complete &= found.complete;
                let x = Polynomial::variable(only, variables);
                let factors = found.factors.iter().map(|(f, power)| (f.of(&x), *power));
                outcome.factors.extend(factors);
            }
        }
        several => {
            let mut places = vec![0; variables];
            for (new, &old) in several.iter().enumerate() {
                places[old] = new;
            }
            let small = rest.moved(&places, several.len());
            for (part, power) in multivariate(&small, budget, &mut outcome.complete)? {
                outcome
                    .factors
                    .push((part.moved(several, variables).primitive(), power));
            }
        }
    }
    outcome
        .factors
        .sort_by_cached_key(|(f, power)| sort_key(f, *power));
    Ok(outcome)
}

type Terms = Vec<(Vec<u32>, Rational)>;

/// Small factors first; ties by their terms, the first variable before the second.
fn sort_key(factor: &Polynomial, power: u32) -> (u32, usize, Reverse<Terms>, u32) {
    let terms: Terms = factor
        .terms()
        .map(|(exponents, c)| (exponents.to_vec(), c.clone()))
        .collect();
    (factor.degree(), terms.len(), Reverse(terms), power)
}

/// Takes out the variables that divide every term.
fn split_monomial(polynomial: &Polynomial, outcome: &mut Factorization) -> Polynomial {
    let variables = polynomial.variables();
    let mut common: Option<Vec<u32>> = None;
    for (exponents, _) in polynomial.terms() {
        common = Some(match common {
            None => exponents.to_vec(),
            Some(c) => c.iter().zip(exponents).map(|(&a, &b)| a.min(b)).collect(),
        });
    }
    let common = common.unwrap_or_else(|| vec![0; variables]);
    for (variable, &exponent) in common.iter().enumerate() {
        if exponent > 0 {
            let x = Polynomial::variable(variable, variables);
            outcome.factors.push((x, exponent));
        }
    }
    let terms = polynomial
        .terms()
        .map(|(exponents, coefficient)| {
            let rest = exponents.iter().zip(&common).map(|(a, b)| a - b).collect();
            (rest, coefficient.clone())
        })
        .collect();
    Polynomial::from_terms(terms, variables)
}

/// A polynomial on a line on which it keeps its degree.
struct Restricted {
    line: Line,
    /// Irreducible factors with multiplicities.
    factors: Vec<(Univariate, u32)>,
    complete: bool,
}

impl Restricted {
    fn new(polynomial: &Polynomial, number: usize, budget: &Budget) -> Result<Option<Self>, Stop> {
        let line = Line::numbered(number, polynomial.variables());
        let values = line.restrict(polynomial);
        if values.last().is_none_or(Zero::is_zero) {
            return Ok(None);
        }
        let found = Univariate::from_rationals(&values).factors(budget)?;
        Ok(Some(Self {
            line,
            factors: found.factors,
            complete: found.complete,
        }))
    }

    fn is_irreducible(&self) -> bool {
        self.complete && self.factors.len() == 1 && self.factors[0].1 == 1
    }

    /// How much is left to combine, and to tell powers apart: repeated roots weigh more than anything.
    fn trouble(&self) -> (u32, usize) {
        let repeated = self
            .factors
            .iter()
            .map(|(f, power)| u32::try_from(f.degree()).unwrap_or(u32::MAX) * (power - 1));
        (repeated.sum(), self.factors.len())
    }
}

/// The irreducible factors of a polynomial in which every variable occurs and no variable divides all terms.
fn multivariate(
    polynomial: &Polynomial,
    budget: &Budget,
    complete: &mut bool,
) -> Result<Vec<(Polynomial, u32)>, Stop> {
    let too_large = dense_terms(polynomial) > MOST_TERMS;
    let mut best: Option<Restricted> = None;
    let mut useful = 0;
    for number in 0..MOST_LINES {
        let Some(restricted) = Restricted::new(polynomial, number, budget)? else {
            continue;
        };
        if restricted.is_irreducible() {
            return Ok(vec![(polynomial.clone(), 1)]);
        }
        if best
            .as_ref()
            .is_none_or(|b| restricted.trouble() < b.trouble())
        {
            best = Some(restricted);
        }
        useful += 1;
        if too_large && useful >= LINES {
            break;
        }
        if useful >= LINES
            && let Some(restricted) = &best
            && let Some(factors) = combine(polynomial, restricted, budget, complete)?
        {
            return Ok(factors);
        }
    }
    *complete = false;
    Ok(vec![(polynomial.clone(), 1)])
}

/// The number of monomials of at most the degree of a polynomial in its variables.
fn dense_terms(polynomial: &Polynomial) -> u64 {
    let degree = u64::from(polynomial.degree());
    (1..=polynomial.variables() as u64)
        .fold(1, |count: u64, i| count.saturating_mul(degree + i) / i)
}

/// The true factors from those on a line; `None` where the line hides some of them.
fn combine(
    polynomial: &Polynomial,
    restricted: &Restricted,
    budget: &Budget,
    complete: &mut bool,
) -> Result<Option<Vec<(Polynomial, u32)>>, Stop> {
    let (line, variables) = (&restricted.line, polynomial.variables());
    let moved = line.to_coordinates(polynomial);
    let head = line
        .restrict(polynomial)
        .pop()
        .unwrap_or_else(Rational::one);
    let whole = Series::of(&moved.scaled(&(Rational::one() / head)), line.pivot());
    let monic = |f: &Univariate| Dense::new(f.rationals()).monic();

    // One squarefree part for every multiplicity. Parts of different multiplicity are coprime on the line.
    let mut powers: Vec<u32> = restricted.factors.iter().map(|(_, power)| *power).collect();
    powers.dedup();
    let parts_on_line: Vec<Dense> = powers
        .iter()
        .map(|&power| {
            let part = restricted.factors.iter().filter(|(_, p)| *p == power);
            part.fold(Dense::constant(Rational::one()), |product, (f, _)| {
                &product * &monic(f)
            })
            .pow(power)
        })
        .collect();
    let degree = polynomial.degree();
    let lifted = lift_all(&whole, &parts_on_line, variables, degree, budget)?;
    let mut factors = Vec::new();
    let mut product = Polynomial::one(variables);
    let mut all_proven = restricted.complete;
    for (&power, part) in powers.iter().zip(&lifted) {
        let Some(part) = root(part, power, variables, degree) else {
            return Ok(None);
        };
        let small: Vec<Dense> = restricted
            .factors
            .iter()
            .filter(|(_, p)| *p == power)
            .map(|(f, _)| monic(f))
            .collect();
        for (found, proven) in squarefree_factors(&part, &small, line, variables, budget)? {
            product = &product * &found.power(power);
            all_proven &= proven;
            factors.push((found, power));
        }
    }
    // Only now it is certain that the multiplicities on the line are those of the polynomial.
    if product.primitive() != polynomial.primitive() {
        return Ok(None);
    }
    *complete &= all_proven;
    Ok(Some(factors))
}

/// The factors of a squarefree polynomial, monic along the line, from its factors on the line; each with whether it is
/// proven irreducible.
fn squarefree_factors(
    whole: &Series,
    on_line: &[Dense],
    line: &Line,
    variables: usize,
    budget: &Budget,
) -> Result<Vec<(Polynomial, bool)>, Stop> {
    let degree: usize = on_line.iter().map(Dense::deg).sum();
    let as_polynomial = |series: &Series| {
        line.out_of_coordinates(&series.polynomial(line.pivot(), variables))
            .primitive()
    };
    let mut rest = as_polynomial(whole);
    let mut modular = lift_all(whole, on_line, variables, degree as u32, budget)?;
    let mut degrees: Vec<usize> = on_line.iter().map(Dense::deg).collect();
    let mut found = Vec::new();
    let mut sets = 0;
    let mut size = 1;
    while 2 * size <= modular.len() {
        let mut set: Vec<usize> = (0..size).collect();
        let mut hit = None;
        loop {
            budget.check()?;
            sets += 1;
            if sets > MOST_SETS {
                found.push((rest, false));
                return Ok(found);
            }
            // A factor of degree d has no terms of order above d.
            let own_degree: usize = set.iter().map(|&i| degrees[i]).sum();
            let product = set
                .iter()
                .skip(1)
                .fold(modular[set[0]].clone(), |p, &i| {
                    p.product(&modular[i], own_degree as u32)
                })
                .truncated(own_degree as u32);
            let candidate = as_polynomial(&product);
            if candidate.degree() as usize == own_degree
                && let Some(quotient) = rest.divided_by(&candidate)
            {
                hit = Some((candidate, quotient));
                break;
            }
            if !next_set(&mut set, modular.len()) {
                break;
            }
        }
        match hit {
            Some((factor, quotient)) => {
                found.push((factor, true));
                rest = quotient.primitive();
                for &i in set.iter().rev() {
                    modular.remove(i);
                    degrees.remove(i);
                }
            }
            None => size += 1,
        }
    }
    if rest.degree() > 0 {
        found.push((rest, true));
    }
    Ok(found)
}

#[cfg(test)]
mod tests;
