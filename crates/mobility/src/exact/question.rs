//! The solutions of a polynomial system near the pose drawn: their tangent space and their dimension.

use super::{ExactFinding, stopped};
use crate::judge::PartFinding;
use crate::pose_rank::PartRank;
use kutzbach_algebra::{
    Budget, Limits, ModularSystem, MonomialOrder, Polynomial, PolynomialSystem, Rational, Stop,
    entries_in, groebner_basis, local_dimension_is_at_most, local_dimension_modulo,
};
use kutzbach_math::number::Number;

/// An entry over the rationals costs as much as so many modulo a prime: fractions are long.
const RATIONAL_PRICE: u64 = 20;

/// Up to so many unknowns all entries cost the same, by measurement; beyond, their price grows with the cube.
const CHEAP_VARIABLES: u64 = 10;

/// The first attempt may do so much work, each further one this many times as much.
const FIRST_ATTEMPT: u64 = 2_000;
const NEXT_ATTEMPT: u64 = 4;

/// Systems of more unknowns are asked for their tangent space only.
const MOST_VARIABLES: usize = 60;

/// What one question may take.
#[derive(Clone, Copy)]
pub(super) struct Most {
    /// In matrix entries.
    pub(super) work: u64,
    /// In bytes.
    pub(super) memory: u64,
}

/// A part as a polynomial system, with the drawn pose at the origin modulo a prime.
pub(super) struct Question<'a> {
    pub(super) system: &'a PolynomialSystem,
    pub(super) modular: &'a ModularSystem,
    pub(super) rank: &'a PartRank,
    pub(super) found: &'a PartFinding,
    pub(super) budget: &'a Budget,
    /// The limits of the budget.
    pub(super) most: Most,
}

impl Question<'_> {
    pub(super) fn answer(&self) -> Result<ExactFinding, String> {
        let variables = self.modular.variables.len();
        let equations = self.modular.equations.len();
        let tangent = tangent_dimension(self.modular, self.budget).map_err(stopped)?;
        let surplus = self.rank.unknowns() as i64 - self.rank.equations() as i64;
        let whole = self.system.is_exact();
        // With the algebraic numbers and their minimal polynomials, and with any equation that vanishes modulo the prime.
        let count = self.system.variables.len() as i64 - self.system.equations.len() as i64;
        let mut text = format!(
            "{equations} equations in {variables} unknowns{}; modulo the prime {}: tangent space of dimension {tangent}",
            if whole { "" } else { ", some left out" },
            self.modular.prime
        );
        let mut answer = ExactFinding {
            tangent,
            upper: tangent,
            proven: None,
            complex_dimension: None,
            certificate: String::new(),
            text: String::new(),
        };
        if tangent == 0 {
            answer.prove(
                0,
                "no velocity at all satisfies the closure equations at this pose: already modulo one prime their rank is full, \
                 and the true rank is not smaller",
            );
        } else if surplus == tangent as i64 || (whole && count == tangent as i64) {
            answer.prove(
                tangent,
                "the closure equations at this pose are independent, already modulo one prime, so its motions form a manifold \
                 of exactly this dimension (implicit function theorem)",
            );
        } else if variables > MOST_VARIABLES {
            text.push_str("; too many unknowns for more");
        } else if let Err(stop) = self.local(&mut answer, &mut text, count.max(surplus)) {
            text.push_str(&format!("; no more within its budget: {stop}"));
        }
        text.push_str(&format!("; work {}", self.budget.work()));
        answer.text = text;
        Ok(answer)
    }

    /// The dimension of the solution set at the pose: bounded from above modulo a prime; from below by counting (`least`),
    /// or over the rationals.
    fn local(&self, answer: &mut ExactFinding, text: &mut String, least: i64) -> Result<(), Stop> {
        let whole = self.system.is_exact();
        let least = usize::try_from(least).unwrap_or(0);
        // That a bound is not exceeded is known before the dimension is. Where the tangent space is no larger, the dimension
        // itself is worth knowing: it could be less than the others think.
        let expected = self.found.lower().max(least);
        answer.upper = if expected < answer.tangent && self.is_at_most(expected)? {
            expected
        } else {
            self.dimension(self.modular)?
        };
        text.push_str(&format!(
            ", solutions of dimension at most {}",
            answer.upper
        ));
        if answer.upper == 0 {
            answer.prove(
                0,
                "this pose is an isolated solution of the closure equations, over the complex numbers too: their local \
                 dimension is 0 modulo one prime, and the true one is not larger",
            );
            return Ok(());
        }
        if !whole {
            return Ok(());
        }
        if least == answer.upper {
            answer.complex_dimension = Some(least);
            text.push_str(", and no less by the number of equations");
        }
        if answer.upper == answer.tangent
            && let Some(point) = self.rational_point()
        {
            let over_rationals = self.within(RATIONAL_PRICE * self.price(), |budget| {
                self.rational_dimension(&point, budget)
            })?;
            if over_rationals == Some(answer.upper) {
                answer.prove(
                    answer.upper,
                    "at this pose the solutions of the closure equations have as many dimensions as their tangent space, by a \
                     Groebner basis over the rational numbers, so that they form a manifold of exactly this dimension",
                );
            }
            if let Some(dimension) = over_rationals {
                text.push_str(&format!("; over the rationals {dimension}"));
            }
        }
        if answer.complex_dimension.is_none()
            && answer.upper > self.found.lower()
            && let Some(second) = self.system.home_modulo(1, self.most.memory)
        {
            let again = self.dimension(&second)?;
            text.push_str(&format!(", modulo {} at most {again}", second.prime));
            // Were the true dimension smaller than the first bound, the second would be too, but for rare primes.
            answer.complex_dimension = (again == answer.upper).then_some(again);
            answer.upper = answer.upper.min(again);
        }
        Ok(())
    }

    /// Whether the local dimension is shown to be at most this.
    fn is_at_most(&self, bound: usize) -> Result<bool, Stop> {
        let (system, price) = (self.modular, self.price());
        self.within(price, |budget| {
            local_dimension_is_at_most(
                bound,
                &system.equations,
                system.variables.len(),
                system.prime,
                budget,
            )
        })
    }

    /// The local dimension modulo the prime.
    fn dimension(&self, system: &ModularSystem) -> Result<usize, Stop> {
        let ring = self.within(self.price(), |budget| {
            local_dimension_modulo(
                &system.equations,
                system.variables.len(),
                system.prime,
                budget,
            )
        })?;
        // The drawn pose is a solution; `None` cannot be.
        Ok(ring.map_or(0, |ring| ring.dimension))
    }

    /// What an entry costs in a system of so many unknowns, whose monomials are long and whose bases are many.
    fn price(&self) -> u64 {
        let variables = self.modular.variables.len() as u64;
        (variables.pow(3) / CHEAP_VARIABLES.pow(3)).max(1)
    }

    /// Attempts with more and more work, as far as the budget goes. The engine looks at all solutions first, which is
    /// sometimes much quicker and sometimes much slower than looking at the pose alone: with little work it soon does the other.
    fn within<T>(
        &self,
        price: u64,
        attempt: impl Fn(&Budget) -> Result<T, Stop>,
    ) -> Result<T, Stop> {
        let mut share = FIRST_ATTEMPT;
        loop {
            let left = self.most.work.saturating_sub(self.budget.work()) / price;
            let limit = share.min(left);
            let budget = Budget::new(Limits {
                work: Some(limit),
                entries: Some(entries_in(self.most.memory)),
                ..Limits::default()
            });
            let answer = attempt(&budget);
            self.budget.spend(budget.work().min(limit) * price)?;
            match answer {
                Err(Stop::Work) if share < left => share = share.saturating_mul(NEXT_ATTEMPT),
                answer => return answer,
            }
        }
    }

    /// The pose drawn, where all numbers are rational.
    fn rational_point(&self) -> Option<Vec<Rational>> {
        if self.modular.variables.len() != self.system.variables.len() {
            return None;
        }
        self.system.home.exact()?.iter().map(rational).collect()
    }

    /// A lower bound of the local dimension over the rationals, nothing left to primes; `None` where it could not be proved.
    /// Found like the one modulo a prime: homogenised with a variable whose higher powers are larger (Lazard 1983).
    fn rational_dimension(
        &self,
        point: &[Rational],
        budget: &Budget,
    ) -> Result<Option<usize>, Stop> {
        let variables = point.len();
        let shifts: Vec<Polynomial> = point
            .iter()
            .enumerate()
            .map(|(i, value)| {
                &Polynomial::variable(i, variables)
                    + &Polynomial::constant(value.clone(), variables)
            })
            .collect();
        let forms: Vec<Polynomial> = self
            .system
            .equations
            .iter()
            .map(|equation| homogenised(&equation.polynomial.substitute(&shifts)))
            .collect();
        let order = MonomialOrder::Elimination(1);
        // The basis may rest on primes. That every form reduces to zero by it does not (see its certificate): its zeros solve all
        // equations. What else is needed is proved here: it is a basis of what it generates, so that its leading monomials tell the
        // dimension of these zeros.
        let basis = groebner_basis(&forms, variables + 1, &order, budget)?;
        if !basis.polynomials().iter().all(is_form) || !basis.is_basis(budget)? {
            return Ok(None);
        }
        let one = Rational::new(1.into(), 1.into());
        let leads: Vec<Polynomial> = basis
            .leading_monomials()
            .map(|lead| Polynomial::from_terms(vec![(lead[1..].to_vec(), one.clone())], variables))
            .collect();
        // Of monomials: nothing to compute.
        let leads = groebner_basis(&leads, variables, &MonomialOrder::Degrevlex, budget)?;
        Ok(leads.dimension())
    }
}

impl ExactFinding {
    pub(super) fn prove(&mut self, freedom: usize, certificate: &str) {
        self.upper = freedom;
        self.proven = Some(freedom);
        self.complex_dimension = Some(freedom);
        certificate.clone_into(&mut self.certificate);
    }
}

/// Dimension of the tangent space at the origin modulo the prime: unknowns less the rank of the linear terms.
pub(super) fn tangent_dimension(system: &ModularSystem, budget: &Budget) -> Result<usize, Stop> {
    let (columns, p) = (system.variables.len(), system.prime);
    budget.spend((columns * system.equations.len()) as u64)?;
    let mut rows: Vec<Vec<u64>> = system
        .equations
        .iter()
        .map(|equation| {
            let mut row = vec![0; columns];
            for (exponents, coefficient) in equation {
                if exponents.iter().sum::<u32>() == 1
                    && let Some(column) = exponents.iter().position(|e| *e == 1)
                {
                    row[column] = *coefficient;
                }
            }
            row
        })
        .collect();
    let times = |a: u64, b: u64| (u128::from(a) * u128::from(b) % u128::from(p)) as u64;
    let mut rank = 0;
    for column in 0..columns {
        let Some(pivot) = (rank..rows.len()).find(|&row| rows[row][column] != 0) else {
            continue;
        };
        rows.swap(rank, pivot);
        let (above, below) = rows.split_at_mut(rank + 1);
        let pivot = &above[rank];
        for row in below.iter_mut().filter(|row| row[column] != 0) {
            // No inverse: row times the pivot less pivot row times the entry.
            let (a, b) = (pivot[column], p - row[column]);
            for (x, y) in row.iter_mut().zip(pivot) {
                *x = (times(*x, a) + times(*y, b)) % p;
            }
        }
        rank += 1;
    }
    Ok(columns - rank)
}

fn rational(number: &Number) -> Option<Rational> {
    let value = number.rational()?;
    let integer = |text: String| text.parse().ok();
    Some(Rational::new(
        integer(value.numerator().to_string())?,
        integer(value.denominator().to_string())?,
    ))
}

/// Every term filled up to the degree of the polynomial with powers of an additional first variable.
fn homogenised(polynomial: &Polynomial) -> Polynomial {
    let degree = |m: &[u32]| m.iter().sum::<u32>();
    let most = polynomial
        .terms()
        .map(|(m, _)| degree(m))
        .max()
        .unwrap_or(0);
    let terms = polynomial.terms().map(|(m, coefficient)| {
        let mut exponents = vec![most - degree(m)];
        exponents.extend_from_slice(m);
        (exponents, coefficient.clone())
    });
    Polynomial::from_terms(terms.collect(), polynomial.variables() + 1)
}

/// Whether all terms have the same degree.
fn is_form(polynomial: &Polynomial) -> bool {
    let mut degrees = polynomial.terms().map(|(m, _)| m.iter().sum::<u32>());
    let first = degrees.next();
    degrees.all(|degree| Some(degree) == first)
}
