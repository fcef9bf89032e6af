//! Groebner bases by F4, with a budget that is asked at every step.
//!
//! Faugere (1999). The crate `groebner` has this algorithm too, but cannot be interrupted: on a lexicographic basis it may
//! run for minutes and take all memory between two matrices. So the pairs and the plans of the matrices are made here, and
//! the crate does what costs most, the elimination.

use super::budget::{Budget, Stop};
use super::linear::{Coefficient, Matrix};
use super::monomials::{Monomials, degree, divides, quotient};
use super::order::MonomialOrder;
use super::pairs::{Head, Pair, Pairs};
use super::symbolic::{Plan, Planner, Reducers, Seed};
use super::terms::Terms;
use super::trace::{Round, Stage, Trace};
use groebner::SparseRow;
use std::collections::BTreeMap;

/// A computation in progress.
struct F4<'a, C> {
    order: &'a MonomialOrder,
    budget: &'a Budget,
    table: Monomials,
    columns: Monomials,
    terms: Vec<Vec<u32>>,
    coefficients: Vec<Vec<C>>,
    pairs: Pairs,
    trace: Option<Stage>,
}

/// The reduced Groebner basis of polynomials, smallest leading monomial first, every one monic. With `learn` also the trace
/// that finds the same basis over another field, unless it is too long to be kept.
///
/// In an order that does not compare degrees first, the polynomials of intermediate steps may have degrees far above those of
/// the result. Where that takes more than a little work, the basis is computed from one in degrevlex (a 6R loop
/// lexicographically: half a second in place of minutes). Work is counted, not timed, so that every run decides alike.
///
/// Those polynomials that do not mention the variable `settled` are a reduced basis by themselves, in degrevlex as in this
/// order: the pairs among them are left out.
pub(super) fn reduced_basis<C: Coefficient>(
    polynomials: &[Terms<C>],
    variables: usize,
    order: &MonomialOrder,
    settled: Option<usize>,
    learn: bool,
    budget: &Budget,
) -> Result<(Vec<Terms<C>>, Option<Trace>), Stop> {
    if order.is_graded() {
        return in_orders(polynomials, variables, &[order], settled, learn, budget);
    }
    let little = budget.with_work(LITTLE_WORK);
    let direct = in_orders(polynomials, variables, &[order], settled, learn, &little);
    budget.take_over(&little);
    match direct {
        Err(Stop::Work) => {
            budget.check()?;
            let orders = [&MonomialOrder::Degrevlex, order];
            in_orders(polynomials, variables, &orders, settled, learn, budget)
        }
        other => other,
    }
}

/// Matrix entries spent on an order that does not compare degrees before degrevlex comes first.
const LITTLE_WORK: u64 = 20_000;

/// Matrix entries of the longest trace that is kept: 200 megabytes.
const MOST_TRACED: u64 = 50_000_000;

/// The reduced basis in the last of some orders, each computed from the one before.
fn in_orders<C: Coefficient>(
    polynomials: &[Terms<C>],
    variables: usize,
    orders: &[&MonomialOrder],
    settled: Option<usize>,
    learn: bool,
    budget: &Budget,
) -> Result<(Vec<Terms<C>>, Option<Trace>), Stop> {
    let mut trace = learn.then(Trace::default);
    let mut basis = polynomials.to_vec();
    let mut settled = settled;
    for order in orders {
        let sorted = basis.iter().map(|p| p.reordered(order));
        let (input, places): (Vec<Terms<C>>, Vec<Vec<u32>>) = sorted.unzip();
        let mut f4 = F4::new(variables, order, trace.is_some(), budget);
        f4.start(&input)?;
        if let Some(variable) = settled.take() {
            f4.pairs.settle_without(variable);
        }
        while !f4.pairs.is_empty() {
            f4.round()?;
        }
        basis = f4.finish()?;
        match (&mut trace, f4.trace) {
            (Some(trace), Some(mut stage)) => {
                stage.places = places;
                trace.stages.push(stage);
            }
            _ => trace = None,
        }
    }
    Ok((basis, trace))
}

/// Leading monomials of a Groebner basis, some of them perhaps multiples of others; not all of them where `enough` says after a
/// round that it needs no more.
pub(super) fn leading_monomials_until<C: Coefficient>(
    polynomials: &[Terms<C>],
    variables: usize,
    order: &MonomialOrder,
    enough: impl Fn(&mut dyn Iterator<Item = &[u16]>) -> bool,
    budget: &Budget,
) -> Result<Vec<Box<[u16]>>, Stop> {
    let mut f4 = F4::new(variables, order, false, budget);
    f4.start(polynomials)?;
    let mut known = 0;
    loop {
        let heads = &f4.pairs.heads;
        let new = heads.len() > known;
        known = heads.len();
        if f4.pairs.is_empty() || new && enough(&mut heads.iter().map(|head| &*head.lead)) {
            break;
        }
        f4.round()?;
    }
    Ok(f4.pairs.heads.into_iter().map(|head| head.lead).collect())
}

/// Whether all S-polynomials of monic polynomials reduce to zero, those that Buchberger's criteria dispense with left out.
pub(super) fn is_basis<C: Coefficient>(
    polynomials: &[Terms<C>],
    variables: usize,
    order: &MonomialOrder,
    budget: &Budget,
) -> Result<bool, Stop> {
    let mut f4 = F4::new(variables, order, false, budget);
    for polynomial in polynomials {
        f4.add_terms(polynomial)?;
    }
    while !f4.pairs.is_empty() {
        let before = f4.terms.len();
        f4.round()?;
        if f4.terms.len() > before {
            return Ok(false);
        }
    }
    Ok(true)
}

/// What remains of polynomials modulo monic polynomials.
pub(super) fn normal_forms<C: Coefficient>(
    polynomials: &[Terms<C>],
    basis: &[Terms<C>],
    variables: usize,
    order: &MonomialOrder,
    budget: &Budget,
) -> Result<Vec<Terms<C>>, Stop> {
    let mut f4 = F4::new(variables, order, false, budget);
    for polynomial in basis.iter().chain(polynomials) {
        f4.store(polynomial)?;
    }
    let usable = f4.by_length(|i| i < basis.len());
    let seeds = (basis.len()..f4.terms.len())
        .map(|element| Seed {
            element,
            multiplier: vec![0; variables],
            is_pivot: false,
            tail_only: false,
        })
        .collect();
    let (plan, columns) = f4.plan(seeds, &usable)?;
    budget.spend_matrix(plan.entries())?;
    let matrix = plan.into_matrix(&f4.coefficients, false);
    let rows = C::reduce(matrix, budget)?;
    Ok(rows
        .into_iter()
        .map(|row| f4.decode(row, &columns))
        .collect())
}

impl<'a, C: Coefficient> F4<'a, C> {
    fn new(variables: usize, order: &'a MonomialOrder, learn: bool, budget: &'a Budget) -> Self {
        Self {
            order,
            budget,
            table: Monomials::new(variables),
            columns: Monomials::new(variables),
            terms: Vec::new(),
            coefficients: Vec::new(),
            pairs: Pairs::default(),
            trace: learn.then(Stage::default),
        }
    }

    /// Takes a polynomial into the list, without pairs.
    fn store(&mut self, polynomial: &Terms<C>) -> Result<(), Stop> {
        let terms: Result<Vec<u32>, Stop> = polynomial
            .monomials
            .iter()
            .map(|monomial| self.table.number(monomial))
            .collect();
        self.terms.push(terms?);
        self.coefficients.push(polynomial.coefficients.clone());
        Ok(())
    }

    fn add_terms(&mut self, polynomial: &Terms<C>) -> Result<(), Stop> {
        let Some(lead) = polynomial.monomials.first() else {
            return Ok(());
        };
        let sugar = polynomial.monomials.iter().map(|m| degree(m)).max();
        let head = Head::new(lead, sugar.unwrap_or(0));
        self.store(polynomial)?;
        self.pairs.add(head, self.budget)
    }

    /// Starts with the input, reduced by linear combinations.
    fn start(&mut self, polynomials: &[Terms<C>]) -> Result<(), Stop> {
        for polynomial in polynomials {
            self.store(polynomial)?;
        }
        let seeds = (0..polynomials.len())
            .map(|element| Seed {
                element,
                multiplier: vec![0; self.table.variables()],
                is_pivot: false,
                tail_only: false,
            })
            .collect();
        let (plan, columns) = self.plan(seeds, &[])?;
        let (plan, matrix) = self.matrix(plan, false);
        self.terms.clear();
        self.coefficients.clear();
        self.eliminate(plan, matrix, &columns, None)
    }

    /// Reduces the pairs of the smallest sugar.
    fn round(&mut self) -> Result<(), Stop> {
        let selected = self.pairs.select();
        let sugar = selected.first().map_or(0, |pair| pair.sugar);
        self.budget.phase(|| {
            let (pairs, waiting) = (selected.len(), self.pairs.len());
            format!("{pairs} pairs of degree {sugar}, {waiting} waiting")
        });
        let seeds = self.seeds(&selected);
        let usable = self.by_length(|i| self.pairs.heads[i].active);
        let (plan, columns) = self.plan(seeds, &usable)?;
        self.budget.spend_matrix(plan.entries())?;
        let (plan, matrix) = self.matrix(plan, false);
        self.eliminate(plan, matrix, &columns, Some(sugar))
    }

    /// Both halves of every S-polynomial; the shortest half at each monomial reduces the others.
    fn seeds(&self, selected: &[Pair]) -> Vec<Seed> {
        let mut halves: BTreeMap<&[u16], Vec<usize>> = BTreeMap::new();
        for pair in selected {
            let elements = halves.entry(&pair.lcm).or_default();
            elements.extend([pair.first, pair.second]);
        }
        let mut seeds = Vec::new();
        for (lcm, mut elements) in halves {
            elements.sort_by_key(|&i| (self.terms[i].len(), i));
            elements.dedup();
            for (place, element) in elements.into_iter().enumerate() {
                seeds.push(Seed {
                    element,
                    multiplier: quotient(lcm, &self.pairs.heads[element].lead),
                    is_pivot: place == 0,
                    tail_only: false,
                });
            }
        }
        seeds
    }

    /// Numbers of polynomials, shortest first.
    fn by_length(&self, wanted: impl Fn(usize) -> bool) -> Vec<usize> {
        let mut usable: Vec<usize> = (0..self.terms.len())
            .filter(|&i| wanted(i) && !self.terms[i].is_empty())
            .collect();
        usable.sort_by_key(|&i| (self.terms[i].len(), i));
        usable
    }

    fn plan(&mut self, seeds: Vec<Seed>, usable: &[usize]) -> Result<(Plan, Vec<u32>), Stop> {
        let reducers = Reducers {
            table: &self.table,
            terms: &self.terms,
            usable,
        };
        Planner::new(reducers, &mut self.columns, self.budget).plan(seeds, self.order)
    }

    /// The matrix of a plan, and the plan itself where the trace needs it.
    fn matrix(&self, plan: Plan, tails: bool) -> (Option<Plan>, Matrix<C>) {
        let kept = self.trace.is_some().then(|| plan.clone());
        (kept, plan.into_matrix(&self.coefficients, tails))
    }

    /// Takes what is new in a matrix into the basis.
    fn eliminate(
        &mut self,
        plan: Option<Plan>,
        matrix: Matrix<C>,
        columns: &[u32],
        sugar: Option<u32>,
    ) -> Result<(), Stop> {
        let learn = self.trace.is_some();
        let (mut new, live) = C::echelon(matrix, learn, self.budget)?;
        // Smallest leading monomial first: it may make later ones superfluous.
        new.sort_by_key(|row| std::cmp::Reverse(row.columns[0]));
        if let (Some(trace), Some(plan)) = (&mut self.trace, plan) {
            trace.rounds.push(Round::new(plan, live, &new));
            if trace.entries() > MOST_TRACED {
                self.trace = None;
            }
        }
        for row in new {
            self.budget.check()?;
            let polynomial = self.decode(row, columns);
            let of_terms = polynomial.monomials.iter().map(|m| degree(m)).max();
            // Reducers may have had terms of higher degree than the pairs.
            let head = Head::new(&polynomial.monomials[0], sugar.max(of_terms).unwrap_or(0));
            self.store(&polynomial)?;
            self.pairs.add(head, self.budget)?;
        }
        Ok(())
    }

    fn decode(&self, row: SparseRow<C>, columns: &[u32]) -> Terms<C> {
        let exponents = |&c: &u32| self.columns.exponents(columns[c as usize]).into();
        Terms {
            monomials: row.columns.iter().map(exponents).collect(),
            coefficients: row.coefficients,
        }
    }

    /// Elements whose leading monomial is no multiple of another.
    fn minimal(&self) -> Result<Vec<usize>, Stop> {
        let heads = &self.pairs.heads;
        let active: Vec<usize> = (0..heads.len()).filter(|&i| heads[i].active).collect();
        let mut minimal = Vec::new();
        for &i in &active {
            self.budget.toil(active.len() as u64)?;
            let multiple = active.iter().any(|&k| {
                k != i
                    && heads[k].mask & !heads[i].mask == 0
                    && divides(&heads[k].lead, &heads[i].lead)
            });
            if !multiple {
                minimal.push(i);
            }
        }
        Ok(minimal)
    }

    /// The elements that are needed, each reduced by the others.
    fn finish(&mut self) -> Result<Vec<Terms<C>>, Stop> {
        self.budget.phase(|| "reduction of the basis".to_owned());
        let mut kept = self.minimal()?;
        let heads = &self.pairs.heads;
        kept.sort_by(|&a, &b| self.order.compare(&heads[a].lead, &heads[b].lead));
        let seeds = kept
            .iter()
            .map(|&element| Seed {
                element,
                multiplier: vec![0; self.table.variables()],
                is_pivot: false,
                tail_only: true,
            })
            .collect();
        let mut usable = kept.clone();
        usable.sort_by_key(|&i| (self.terms[i].len(), i));
        let (plan, columns) = self.plan(seeds, &usable)?;
        self.budget.spend_matrix(plan.entries())?;
        let (plan, matrix) = self.matrix(plan, true);
        let tails = C::reduce(matrix, self.budget)?;
        if let (Some(trace), Some(plan)) = (&mut self.trace, plan) {
            let all = (0..kept.len()).collect();
            trace.finish = Some(Round::new(plan, all, &tails));
        }
        let basis = kept.iter().zip(tails).map(|(&element, tail)| {
            let mut terms = self.decode(tail, &columns);
            terms
                .monomials
                .insert(0, self.pairs.heads[element].lead.clone());
            terms.coefficients.insert(0, C::one());
            terms
        });
        Ok(basis.collect())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::polynomial::{Polynomial, Rational};
    use crate::{Limits, Progress, groebner_basis};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};

    /// Cyclic roots: lexicographic bases of order 7 take hours.
    fn cyclic(n: usize) -> Vec<Polynomial> {
        let product = |start: usize, length: usize| {
            let mut exponents = vec![0; n];
            for i in start..start + length {
                exponents[i % n] += 1;
            }
            (exponents, Rational::from_integer(1.into()))
        };
        let sums = (1..n).map(|length| (0..n).map(|start| product(start, length)).collect());
        let mut equations: Vec<Polynomial> =
            sums.map(|terms| Polynomial::from_terms(terms, n)).collect();
        let all = Polynomial::from_terms(vec![product(0, n)], n);
        equations.push(&all - &Polynomial::one(n));
        equations
    }

    fn hard(limits: Limits) -> (Option<Stop>, u64) {
        let budget = Budget::new(limits);
        let order = MonomialOrder::Lexicographic;
        let result = groebner_basis(&cyclic(7), 7, &order, &budget);
        (result.err(), budget.work())
    }

    #[test]
    fn no_matrix_passes_its_limit() {
        let work = Some(300_000);
        let (stop, done) = hard(Limits {
            work,
            ..Limits::default()
        });
        assert_eq!(stop, Some(Stop::Work));
        assert!(done <= 300_000);
        let (stop, _) = hard(Limits {
            entries: Some(10_000),
            ..Limits::default()
        });
        assert_eq!(stop, Some(Stop::Memory));
    }

    #[test]
    fn another_thread_watches_and_stops() {
        let flag = Arc::new(AtomicBool::new(false));
        let progress = Arc::new(Progress::default());
        let limits = Limits {
            cancelled: Some(Arc::clone(&flag)),
            progress: Some(Arc::clone(&progress)),
            ..Limits::seconds(600.0)
        };
        let computation = std::thread::spawn(move || hard(limits).0);
        while progress.work() == 0 || progress.phase().is_empty() {
            std::thread::yield_now();
        }
        assert!(progress.phase().contains("pairs"));
        flag.store(true, Ordering::Relaxed);
        assert_eq!(computation.join().unwrap(), Some(Stop::Cancelled));
    }

    #[test]
    fn the_basis_of_cyclic_5() {
        let budget = Budget::unlimited();
        let degrevlex = groebner_basis(&cyclic(5), 5, &MonomialOrder::Degrevlex, &budget).unwrap();
        assert_eq!(degrevlex.polynomials().len(), 20);
        assert_eq!(degrevlex.degree(), Some(70));
        let lexicographic =
            groebner_basis(&cyclic(5), 5, &MonomialOrder::Lexicographic, &budget).unwrap();
        assert_eq!(lexicographic.polynomials().len(), 11);
        assert_eq!(lexicographic.degree(), Some(70));
        for p in degrevlex.polynomials() {
            assert!(lexicographic.contains(p));
        }
    }

    #[test]
    fn s_polynomials_show_what_is_no_basis() {
        let order = MonomialOrder::Degrevlex;
        let budget = Budget::unlimited();
        let monic = |p: &Polynomial| Terms::of(p, &order).unwrap();
        let equations: Vec<_> = cyclic(4).iter().map(monic).collect();
        assert_eq!(is_basis(&equations, 4, &order, &budget), Ok(false));
        let (basis, _) = reduced_basis(&equations, 4, &order, None, false, &budget).unwrap();
        assert_eq!(is_basis(&basis, 4, &order, &budget), Ok(true));
        assert_eq!(is_basis::<Rational>(&[], 4, &order, &budget), Ok(true));
        let rest = normal_forms(&equations, &basis, 4, &order, &budget).unwrap();
        assert!(rest.iter().all(Terms::is_zero));
    }
}
