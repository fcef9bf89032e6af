//! Rational bases from bases modulo primes: Chinese remainders and rational reconstruction.
//!
//! Arnold, "Modular algorithms for computing Groebner bases" (2003), section 7. A basis modulo a prime whose leading
//! monomials disagree with the others comes from an unlucky prime and is outvoted.

use super::basis::Certificate;
use super::budget::{Budget, Stop};
use super::residue::{Residue, basis_modulo_prime};
use crate::algebra::polynomial::{Polynomial, Rational};
use groebner::PolynomialExt;
use polycore::crt::CrtAccumulator;
use polycore::{Fp, Monomial, Order, Poly, Primes};
use std::collections::HashMap;

/// Most primes before the coefficients count as too large: about 120 000 bits.
const MOST_PRIMES: usize = 2_000;

type Layout = Vec<Vec<Monomial>>;

/// Everything known from the primes that found one shape of basis.
struct Images {
    layout: Layout,
    remainders: CrtAccumulator,
}

/// A basis over the rationals, with what was checked of it.
pub(super) fn rational_basis(
    equations: &[Polynomial],
    order: &Order,
    budget: &Budget,
) -> Result<(Vec<Poly<Rational>>, Certificate), Stop> {
    let equations: Vec<Poly<Rational>> = equations
        .iter()
        .filter(|p| !p.is_zero())
        .map(|p| p.primitive().raw().reorder(order.clone()))
        .collect();
    if equations.is_empty() {
        return Ok((Vec::new(), Certificate::default()));
    }
    let mut shapes: HashMap<Layout, Images> = HashMap::new();
    let mut next_attempt = 1;
    for prime in Primes::new().take(MOST_PRIMES) {
        let Some(image) = image(&equations, prime, budget)? else {
            continue;
        };
        if let Some((candidate, primes)) = attempt(&shapes, next_attempt, order) {
            next_attempt = primes + primes.div_ceil(4);
            if agrees(&candidate, &image, prime) && holds_inputs(&candidate, &equations, budget)? {
                let primes = primes + 1;
                return Ok((candidate, Certificate { primes }));
            }
        }
        add(&mut shapes, prime, &image)?;
    }
    Err(Stop::Coefficients)
}

/// The reduced basis modulo a prime; `None` where the prime divides a leading coefficient or a denominator.
fn image(
    equations: &[Poly<Rational>],
    prime: u64,
    budget: &Budget,
) -> Result<Option<Vec<Poly<Residue>>>, Stop> {
    let reduced: Option<Vec<_>> = equations
        .iter()
        .map(|p| {
            let image = p.try_map(|c| Fp::from_rational(c, prime).map(Residue))?;
            (image.lm() == p.lm()).then_some(image)
        })
        .collect();
    reduced
        .map(|equations| basis_modulo_prime(equations, budget))
        .transpose()
}

fn layout(image: &[Poly<Residue>]) -> Layout {
    image.iter().map(Poly::support).collect()
}

/// Adds an image to those of the same shape. A prime that makes a coefficient vanish has a shape of its own.
fn add(
    shapes: &mut HashMap<Layout, Images>,
    prime: u64,
    image: &[Poly<Residue>],
) -> Result<(), Stop> {
    let layout = layout(image);
    let images = shapes.entry(layout.clone()).or_insert_with(|| Images {
        remainders: CrtAccumulator::new(layout.iter().map(Vec::len).sum()),
        layout,
    });
    let values: Vec<u64> = image
        .iter()
        .flat_map(|p| p.terms.iter().map(|(_, c)| c.0.value()))
        .collect();
    images
        .remainders
        .add(prime, &values)
        .map_err(|_| Stop::Coefficients)
}

/// The rational basis that the best supported shape suggests, once it has enough primes for a new attempt.
fn attempt(
    shapes: &HashMap<Layout, Images>,
    at_least: usize,
    order: &Order,
) -> Option<(Vec<Poly<Rational>>, usize)> {
    let images = shapes
        .values()
        .max_by_key(|images| images.remainders.image_count())?;
    let count = images.remainders.image_count();
    if count < at_least {
        return None;
    }
    let mut values = images.remainders.reconstruct()?.into_iter();
    let candidate = images
        .layout
        .iter()
        .map(|monomials| {
            let terms: Vec<_> = monomials.iter().cloned().zip(values.by_ref()).collect();
            let variables = monomials[0].nvars();
            Poly::new(terms, variables, order.clone())
        })
        .collect();
    Some((candidate, count))
}

fn agrees(candidate: &[Poly<Rational>], image: &[Poly<Residue>], prime: u64) -> bool {
    candidate.len() == image.len()
        && candidate.iter().zip(image).all(|(p, residue)| {
            p.try_map(|c| Fp::from_rational(c, prime).map(Residue))
                .is_some_and(|p| p == *residue)
        })
}

/// Whether every equation reduces to zero over the rationals: the ideal of the basis holds the ideal of the equations.
fn holds_inputs(
    candidate: &[Poly<Rational>],
    equations: &[Poly<Rational>],
    budget: &Budget,
) -> Result<bool, Stop> {
    for equation in equations {
        budget.spend(equation.terms.len() as u64)?;
        if !equation.normal_form(candidate).is_zero() {
            return Ok(false);
        }
    }
    Ok(true)
}
