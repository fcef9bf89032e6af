//! Rational bases from bases modulo primes: Chinese remainders and rational reconstruction.
//!
//! Arnold, "Modular algorithms for computing Groebner bases" (2003), section 7. The first prime is kept apart: it tests what
//! the others suggest. The second one is computed in full and its trace replayed modulo the following ones. Bases are
//! grouped by their leading monomials; the largest group decides, so that a few unlucky primes are outvoted. Where the test or
//! the trace itself comes from an unlucky prime, test and candidate contradict one another, or the equations do not reduce
//! to zero: then all is forgotten and other primes are taken.

use super::budget::{Budget, Stop};
use super::certificate::Certificate;
use super::dimension::Supports;
use super::f4::{is_basis, normal_forms, reduced_basis};
use super::hilbert::{HilbertSeries, small};
use super::order::MonomialOrder;
use super::terms::Terms;
use super::trace::Trace;
use crate::polynomial::{Polynomial, Rational};
use groebner::Zp;
use num_bigint::BigInt;
use num_traits::{One, Zero};
use polycore::Primes;
use polycore::crt::{WangContext, try_garner};
use polycore::lehmer;

/// Most primes before the coefficients count as too large: about 120 000 bits.
const MOST_PRIMES: usize = 2_000;

/// The monomials of every polynomial of a basis, largest first.
type Layout = Vec<Vec<Box<[u16]>>>;

/// A basis modulo a prime.
struct Image {
    prime: u64,
    basis: Vec<Terms<Zp>>,
}

impl Image {
    /// The dimension of the solutions modulo the prime; `None` where there are none.
    fn dimension(&self, variables: usize) -> Option<usize> {
        let leads = self.leads();
        Supports::new(leads.iter().map(Vec::as_slice), variables).dimension()
    }

    fn leads(&self) -> Vec<Vec<u32>> {
        let leads = self.basis.iter().filter_map(Terms::lead);
        leads
            .map(|m| m.iter().map(|&e| u32::from(e)).collect())
            .collect()
    }
}

/// A basis over the rationals, smallest leading monomial first, every polynomial monic, with what was checked of it. On the
/// way the dimension modulo the first prime is noted. For `settled` see [`reduced_basis`].
pub(super) fn rational_basis(
    equations: &[Polynomial],
    variables: usize,
    order: &MonomialOrder,
    settled: Option<usize>,
    budget: &Budget,
    modulo: &mut Option<(u64, Option<usize>)>,
) -> Result<(Vec<Terms<Rational>>, Certificate), Stop> {
    match Search::new(equations, variables, order, budget)? {
        Some(search) => Search { settled, ..search }.run(modulo),
        None => Ok((Vec::new(), Certificate::over_the_rationals())),
    }
}

/// The leading monomials of a basis modulo a prime that divides no leading coefficient of the equations, smallest first. For
/// `settled` see [`reduced_basis`].
pub(super) fn leads_modulo_a_prime(
    equations: &[Polynomial],
    variables: usize,
    order: &MonomialOrder,
    settled: Option<usize>,
    budget: &Budget,
) -> Result<Vec<Vec<u32>>, Stop> {
    match Search::new(equations, variables, order, budget)? {
        Some(search) => Ok(Search { settled, ..search }.full_image(false)?.leads()),
        None => Ok(Vec::new()),
    }
}

/// Effort of a fraction from its remainder, for every word of the modulus, beside that which grows with their square.
const EFFORT_OF_FRACTION: u64 = 50;

/// Effort of a remainder modulo one prime more, beside that which grows with its words.
const EFFORT_OF_REMAINDER: u64 = 100;

/// Primes modulo which solutions are counted.
const COUNTED: usize = 2;

/// The number of complex solutions, multiplicities counted; `None` where they are infinitely many, or too many to be counted, or where
/// primes disagree.
///
/// They are counted modulo two primes of 62 bits, by a basis modulo each. The number over the rationals is another one only where both
/// primes divide a certain integer that the equations determine, unknown here: that is what the completeness of every
/// [`GroebnerBasis`](super::GroebnerBasis) rests on, too. A basis over the rationals, which takes much longer, is not needed for it.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub fn count_solutions(
    equations: &[Polynomial],
    variables: usize,
    budget: &Budget,
) -> Result<Option<usize>, Stop> {
    let order = MonomialOrder::Degrevlex;
    let Some(mut search) = Search::new(equations, variables, &order, budget)? else {
        return Ok(None);
    };
    let mut counts = Vec::new();
    for _ in 0..COUNTED {
        let leads = search.full_image(false)?.leads();
        let supports = Supports::new(leads.iter().map(Vec::as_slice), variables);
        match supports.dimension() {
            None => counts.push(0),
            Some(0) => {
                let series = HilbertSeries::of(leads, variables, budget)?;
                let Some(count) = series.and_then(|series| small(&series.degree())) else {
                    return Ok(None);
                };
                counts.push(count);
            }
            Some(_) => return Ok(None),
        }
    }
    Ok((counts[0] == counts[1]).then_some(counts[0]))
}

struct Search<'a> {
    equations: Vec<Terms<Rational>>,
    variables: usize,
    order: &'a MonomialOrder,
    settled: Option<usize>,
    budget: &'a Budget,
    primes: Primes,
    groups: Vec<Group>,
    /// A computation to be replayed, with the terms of the basis that it finds.
    trace: Option<(Trace, Layout)>,
    /// Whether traces of this computation fit the memory.
    can_learn: bool,
}

impl<'a> Search<'a> {
    /// `None` where there are no equations.
    fn new(
        equations: &[Polynomial],
        variables: usize,
        order: &'a MonomialOrder,
        budget: &'a Budget,
    ) -> Result<Option<Self>, Stop> {
        let equations: Vec<Terms<Rational>> = equations
            .iter()
            .filter(|p| !p.is_zero())
            .map(|p| Terms::of(&p.primitive(), order))
            .collect::<Result<_, Stop>>()?;
        Ok((!equations.is_empty()).then(|| Self {
            equations,
            variables,
            order,
            settled: None,
            budget,
            primes: Primes::new(),
            groups: Vec::new(),
            trace: None,
            can_learn: true,
        }))
    }

    fn run(
        mut self,
        modulo: &mut Option<(u64, Option<usize>)>,
    ) -> Result<(Vec<Terms<Rational>>, Certificate), Stop> {
        let mut test = self.full_image(false)?;
        *modulo = Some((test.prime, test.dimension(self.variables)));
        // Small coefficients can be read off a single prime.
        let mut alone = Group::of(&test);
        alone.add(&test, self.order, self.budget)?;
        if let Some(candidate) = alone.candidate(self.budget)? {
            let second = self.full_image(true)?;
            match self.verdict(&candidate, &second, 2)? {
                Verdict::Accepted(certificate) => return Ok((candidate, certificate)),
                Verdict::TooEarly => self.add(&second)?,
                Verdict::Contradiction => test = self.start_again()?,
            }
        }
        let mut next_attempt = 1;
        for _ in 0..MOST_PRIMES {
            let image = self.image()?;
            self.add(&image)?;
            let Some(best) = self.best() else { continue };
            let count = best.count;
            if count < next_attempt {
                continue;
            }
            next_attempt = count + count.div_ceil(8);
            self.budget
                .phase(|| format!("{count} primes, reconstruction"));
            let Some(candidate) = best.candidate(self.budget)? else {
                continue;
            };
            match self.verdict(&candidate, &test, count + 1)? {
                Verdict::Accepted(certificate) => return Ok((candidate, certificate)),
                Verdict::TooEarly => {}
                Verdict::Contradiction => {
                    test = self.start_again()?;
                    next_attempt = 1;
                }
            }
        }
        Err(Stop::Coefficients)
    }

    /// Forgets everything: the prime of the test, or that of the trace and with it all images found by replay, was unlucky.
    fn start_again(&mut self) -> Result<Image, Stop> {
        self.groups.clear();
        self.trace = None;
        self.full_image(false)
    }

    /// The equations modulo the next prime that divides no leading coefficient.
    fn next_input(&mut self) -> Result<(u64, Vec<Vec<Zp>>), Stop> {
        for prime in self.primes.by_ref().take(MOST_PRIMES) {
            let residues: Option<Vec<_>> =
                self.equations.iter().map(|p| p.residues(prime)).collect();
            if let Some(residues) = residues {
                return Ok((prime, residues));
            }
        }
        Err(Stop::Coefficients)
    }

    fn full_image(&mut self, learn: bool) -> Result<Image, Stop> {
        let (prime, input) = self.next_input()?;
        self.compute(prime, input, learn)
    }

    fn compute(&mut self, prime: u64, input: Vec<Vec<Zp>>, learn: bool) -> Result<Image, Stop> {
        let input: Vec<Terms<Zp>> = self
            .equations
            .iter()
            .zip(input)
            .map(|(equation, residues)| Terms::without_zeros(&equation.monomials, residues))
            .collect();
        let (basis, trace) = reduced_basis(
            &input,
            self.variables,
            self.order,
            self.settled,
            learn,
            self.budget,
        )?;
        if let Some(trace) = trace {
            let layout = basis.iter().map(|p| p.monomials.clone()).collect();
            self.trace = Some((trace, layout));
        } else if learn {
            self.can_learn = false;
        }
        Ok(Image { prime, basis })
    }

    /// The basis modulo the next prime, by replay where that succeeds.
    fn image(&mut self) -> Result<Image, Stop> {
        let (prime, input) = self.next_input()?;
        let Some((trace, layout)) = &self.trace else {
            return self.compute(prime, input, self.can_learn);
        };
        let Some(values) = trace.replay(input.clone(), prime, self.budget)? else {
            // A prime that behaves differently, or a trace of one that did: the newer trace replaces the older one, and
            // leading monomials decide which group grows.
            return self.compute(prime, input, true);
        };
        let basis = layout
            .iter()
            .zip(values)
            .map(|(monomials, values)| Terms::without_zeros(monomials, values))
            .collect();
        Ok(Image { prime, basis })
    }

    fn add(&mut self, image: &Image) -> Result<(), Stop> {
        let known = self.groups.iter().position(|group| group.fits(image));
        let at = known.unwrap_or_else(|| {
            self.groups.push(Group::of(image));
            self.groups.len() - 1
        });
        self.groups[at].add(image, self.order, self.budget)
    }

    /// The largest group, the older one of two equal ones.
    fn best(&self) -> Option<&Group> {
        self.groups.iter().rev().max_by_key(|group| group.count)
    }

    /// What a prime that had no part in finding it says about a candidate.
    fn verdict(
        &self,
        candidate: &[Terms<Rational>],
        fresh: &Image,
        primes: usize,
    ) -> Result<Verdict, Stop> {
        if !same_leads(candidate, &fresh.basis) {
            return Ok(Verdict::Contradiction);
        }
        let residues: Option<Vec<Terms<Zp>>> =
            candidate.iter().map(|p| p.modulo(fresh.prime)).collect();
        if residues.is_none_or(|residues| residues != fresh.basis) {
            return Ok(Verdict::TooEarly);
        }
        self.budget.phase(|| "certificate".to_owned());
        let is_basis = is_basis(&fresh.basis, self.variables, self.order, self.budget)?;
        if !is_basis || !self.holds_equations(candidate)? {
            return Ok(Verdict::Contradiction);
        }
        Ok(Verdict::Accepted(Certificate {
            primes,
            fresh_prime: Some(fresh.prime),
            proven: false,
        }))
    }

    /// Whether every equation reduces to zero over the rationals.
    fn holds_equations(&self, candidate: &[Terms<Rational>]) -> Result<bool, Stop> {
        let rest = normal_forms(
            &self.equations,
            candidate,
            self.variables,
            self.order,
            self.budget,
        )?;
        Ok(rest.iter().all(Terms::is_zero))
    }
}

enum Verdict {
    Accepted(Certificate),
    /// More primes are needed.
    TooEarly,
    /// More primes of this kind do not help.
    Contradiction,
}

fn same_leads(candidate: &[Terms<Rational>], image: &[Terms<Zp>]) -> bool {
    let leads = image.iter().map(Terms::lead);
    candidate.iter().map(Terms::lead).eq(leads)
}

/// Everything known from the primes that found the same leading monomials.
struct Group {
    /// The terms of each polynomial that occurred modulo any prime, largest first.
    layout: Layout,
    /// Their coefficients modulo the product of the primes.
    remainders: Vec<BigInt>,
    modulus: BigInt,
    count: usize,
}

impl Group {
    fn of(image: &Image) -> Self {
        let layout: Vec<_> = image.basis.iter().map(|p| p.monomials.clone()).collect();
        Self {
            remainders: vec![BigInt::zero(); layout.iter().map(Vec::len).sum()],
            layout,
            modulus: BigInt::one(),
            count: 0,
        }
    }

    fn fits(&self, image: &Image) -> bool {
        let leads = self.layout.iter().map(|monomials| &*monomials[0]);
        image.basis.iter().map(Terms::lead).eq(leads.map(Some))
    }

    fn add(&mut self, image: &Image, order: &MonomialOrder, budget: &Budget) -> Result<(), Stop> {
        if image
            .basis
            .iter()
            .zip(&self.layout)
            .any(|(p, monomials)| p.monomials != *monomials)
        {
            self.widen(image, order);
        }
        let mut values = Vec::with_capacity(self.remainders.len());
        for (p, monomials) in image.basis.iter().zip(&self.layout) {
            let mut terms = p.monomials.iter().zip(&p.coefficients).peekable();
            for monomial in monomials {
                let term = terms.next_if(|(m, _)| *m == monomial);
                values.push(term.map_or(0, |(_, c)| c.value()));
            }
        }
        let words = self.modulus.bits().div_ceil(64);
        budget.toil(self.remainders.len() as u64 * (EFFORT_OF_REMAINDER + 2 * words))?;
        try_garner(
            &mut self.remainders,
            &mut self.modulus,
            &values,
            image.prime,
        )
        .map_err(|_| Stop::Coefficients)?;
        self.count += 1;
        Ok(())
    }

    /// Makes room for terms that vanished modulo all primes so far.
    fn widen(&mut self, image: &Image, order: &MonomialOrder) {
        let mut old = std::mem::take(&mut self.remainders).into_iter();
        for (monomials, p) in self.layout.iter_mut().zip(&image.basis) {
            let known: Vec<_> = monomials.drain(..).zip(old.by_ref()).collect();
            let mut known = known.into_iter().peekable();
            let mut new = p.monomials.iter().peekable();
            loop {
                let use_known = match (known.peek(), new.peek()) {
                    (Some((a, _)), Some(b)) => order.compare(a, b).is_ge(),
                    (Some(_), None) => true,
                    (None, Some(_)) => false,
                    (None, None) => break,
                };
                if use_known {
                    if let Some((monomial, value)) = known.next() {
                        new.next_if(|m| **m == monomial);
                        monomials.push(monomial);
                        self.remainders.push(value);
                    }
                } else if let Some(monomial) = new.next() {
                    monomials.push(monomial.clone());
                    self.remainders.push(BigInt::zero());
                }
            }
        }
    }

    /// The basis with the smallest fractions that leave these remainders, where there are any.
    fn candidate(&self, budget: &Budget) -> Result<Option<Vec<Terms<Rational>>>, Stop> {
        let Some(context) = WangContext::new(&self.modulus) else {
            return Ok(None);
        };
        let bound = (&self.modulus / 2_u32).sqrt();
        let mut basis = Vec::with_capacity(self.layout.len());
        let mut rest = &self.remainders[..];
        for monomials in &self.layout {
            let words = self.modulus.bits().div_ceil(64);
            budget.toil(monomials.len() as u64 * words * (EFFORT_OF_FRACTION + words))?;
            let (remainders, others) = rest.split_at(monomials.len());
            rest = others;
            let Some(values) = fractions(remainders, &context, &self.modulus, &bound) else {
                return Ok(None);
            };
            let terms = monomials.iter().zip(values);
            let (monomials, coefficients) = terms
                .filter(|(_, c)| !c.is_zero())
                .map(|(m, c)| (m.clone(), c))
                .unzip();
            basis.push(Terms {
                monomials,
                coefficients,
            });
        }
        Ok(Some(basis))
    }
}

/// The fractions with numerators and denominators up to `bound` that leave these remainders. The coefficients of one polynomial
/// mostly share their denominator, so that after the first one a multiplication finds what takes a division algorithm else.
fn fractions(
    remainders: &[BigInt],
    context: &WangContext,
    modulus: &BigInt,
    bound: &BigInt,
) -> Option<Vec<Rational>> {
    let half = modulus / 2_u32;
    let mut denominator = BigInt::one();
    let fraction = |remainder: &BigInt| {
        let mut numerator = remainder * &denominator % modulus;
        if numerator > half {
            numerator -= modulus;
        }
        if numerator.magnitude() <= bound.magnitude() {
            // Both parts are within the bound, and there is only one such fraction.
            return Some(lehmer::fraction(numerator, denominator.magnitude()));
        }
        let found = context.reconstruct(remainder)?;
        let shared = BigInt::from(lehmer::gcd(
            denominator.magnitude(),
            found.denom().magnitude(),
        ));
        let common = &denominator / shared * found.denom();
        denominator = if common <= *bound {
            common
        } else {
            found.denom().clone()
        };
        Some(found)
    };
    remainders.iter().map(fraction).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const ORDER: MonomialOrder = MonomialOrder::Lexicographic;

    fn image(prime: u64, terms: &[(u16, i64)]) -> Image {
        let monomials = terms.iter().map(|&(e, _)| vec![e].into()).collect();
        let coefficients = terms.iter().map(|&(_, c)| Zp::from_i64(c, prime)).collect();
        let basis = vec![Terms {
            monomials,
            coefficients,
        }];
        Image { prime, basis }
    }

    #[test]
    fn a_coefficient_that_vanishes_modulo_one_prime_has_its_place() {
        // x³ + 101 x + 5, of which x disappears modulo 101.
        let first = image(101, &[(3, 1), (0, 5)]);
        let mut group = Group::of(&first);
        group.add(&first, &ORDER, &Budget::unlimited()).unwrap();
        for prime in [1009, 1013, 1019] {
            let next = image(prime, &[(3, 1), (1, 101), (0, 5)]);
            assert!(group.fits(&next));
            group.add(&next, &ORDER, &Budget::unlimited()).unwrap();
        }
        group
            .add(
                &image(103, &[(3, 1), (1, 101), (0, 5)]),
                &ORDER,
                &Budget::unlimited(),
            )
            .unwrap();
        let candidate = group.candidate(&Budget::unlimited()).unwrap().unwrap();
        let expected: Vec<Rational> = [1, 101, 5].map(|c| Rational::from_integer(c.into())).into();
        assert_eq!(candidate[0].coefficients, expected);
        assert_eq!(group.count, 5);
    }

    #[test]
    fn other_leading_monomials_are_another_group() {
        let group = Group::of(&image(101, &[(3, 1), (0, 5)]));
        assert!(!group.fits(&image(103, &[(2, 1), (0, 5)])));
    }
}
