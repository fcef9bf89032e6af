//! Symbolic preprocessing: which multiples of which polynomials a matrix needs.
//!
//! Faugere, "A new efficient algorithm for computing Groebner bases (F4)" (1999), section 2.3. It knows no coefficients; the
//! budget is asked while a plan grows, because a plan may become larger than any memory.

use super::budget::{Budget, Stop};
use super::monomials::{Monomials, divides, divisibility_mask, quotient};
use super::order::MonomialOrder;
use std::cmp::Reverse;

/// A multiple of a polynomial as a row of a matrix.
#[derive(Clone, Debug)]
pub(super) struct PlannedRow {
    /// Number of the polynomial.
    pub(super) element: usize,
    /// Column of each of its terms, leading term first.
    pub(super) columns: Vec<u32>,
}

/// A matrix without its coefficients. Columns are numbered from the largest monomial down.
#[derive(Clone, Debug, Default)]
pub(super) struct Plan {
    pub(super) pivots: Vec<PlannedRow>,
    pub(super) rows: Vec<PlannedRow>,
    pub(super) columns: usize,
}

impl Plan {
    /// Entries of all rows.
    pub(super) fn entries(&self) -> u64 {
        let rows = self.pivots.iter().chain(&self.rows);
        rows.map(|row| row.columns.len() as u64).sum()
    }
}

/// The terms of all polynomials, their leading monomials, and which of them may reduce.
pub(super) struct Reducers<'a> {
    pub(super) table: &'a Monomials,
    /// Terms of each polynomial, as numbers in the table.
    pub(super) terms: &'a [Vec<u32>],
    /// Polynomials that may reduce, best first.
    pub(super) usable: &'a [usize],
}

impl<'a> Reducers<'a> {
    fn lead(&self, polynomial: usize) -> &'a [u16] {
        self.table.exponents(self.terms[polynomial][0])
    }
}

/// A multiple that has to be in the matrix.
pub(super) struct Seed {
    pub(super) element: usize,
    pub(super) multiplier: Vec<u16>,
    /// Whether it reduces the other rows.
    pub(super) is_pivot: bool,
    /// Whether its leading term is left out.
    pub(super) tail_only: bool,
}

/// Effort of a planned entry: a product of monomials is looked up, mostly far away in memory.
const EFFORT_OF_ENTRY: u64 = 30;

/// Effort of putting a column in its place among the others.
const EFFORT_OF_COLUMN: u64 = 200;

/// Effort of looking whether a leading monomial divides one.
const EFFORT_OF_MASKS: u64 = 1;

/// A plan under construction.
pub(super) struct Planner<'a> {
    reducers: Reducers<'a>,
    /// Masks of the leading monomials of the usable polynomials.
    masks: Vec<u64>,
    columns: &'a mut Monomials,
    /// Columns that have a pivot.
    covered: Vec<bool>,
    plan: Plan,
    entries: u64,
    budget: &'a Budget,
}

impl<'a> Planner<'a> {
    /// `columns` is memory to be used again.
    pub(super) fn new(
        reducers: Reducers<'a>,
        columns: &'a mut Monomials,
        budget: &'a Budget,
    ) -> Self {
        columns.clear();
        let lead_mask = |&i: &usize| divisibility_mask(reducers.lead(i));
        Self {
            masks: reducers.usable.iter().map(lead_mask).collect(),
            reducers,
            columns,
            covered: Vec::new(),
            plan: Plan::default(),
            entries: 0,
            budget,
        }
    }

    /// The matrix of the seeds with everything that can reduce them, and the monomials of its columns.
    pub(super) fn plan(
        mut self,
        seeds: Vec<Seed>,
        order: &MonomialOrder,
    ) -> Result<(Plan, Vec<u32>), Stop> {
        for seed in &seeds {
            let row = self.row(seed)?;
            if seed.is_pivot {
                self.cover(row.columns[0]);
                self.plan.pivots.push(row);
            } else {
                self.plan.rows.push(row);
            }
        }
        let mut next = 0;
        while next < self.columns.len() {
            if !self.covered.get(next).copied().unwrap_or(false)
                && let Some(seed) = self.reducer(next as u32)
            {
                let row = self.row(&seed)?;
                self.plan.pivots.push(row);
            }
            next += 1;
        }
        self.budget
            .toil(EFFORT_OF_COLUMN * self.columns.len() as u64)?;
        self.sorted(order)
    }

    fn cover(&mut self, column: u32) {
        let column = column as usize;
        if self.covered.len() <= column {
            self.covered.resize(column + 1, false);
        }
        self.covered[column] = true;
    }

    fn row(&mut self, seed: &Seed) -> Result<PlannedRow, Stop> {
        let Reducers { table, terms, .. } = &self.reducers;
        let hash = self.columns.hash_of(&seed.multiplier);
        let terms = &terms[seed.element][usize::from(seed.tail_only)..];
        let mut columns = Vec::with_capacity(terms.len());
        for &term in terms {
            let factor = (table.exponents(term), table.hash(term));
            columns.push(
                self.columns
                    .number_of_product(factor, (&seed.multiplier, hash))?,
            );
        }
        self.entries += columns.len() as u64 + 1;
        self.budget.check_entries(self.entries)?;
        let effort = EFFORT_OF_ENTRY * (columns.len() as u64 + 1);
        self.budget
            .toil(effort + EFFORT_OF_MASKS * self.masks.len() as u64)?;
        Ok(PlannedRow {
            element: seed.element,
            columns,
        })
    }

    /// The multiple that reduces the monomial of a column.
    fn reducer(&self, column: u32) -> Option<Seed> {
        let monomial = self.columns.exponents(column);
        let mask = divisibility_mask(monomial);
        let element = self
            .masks
            .iter()
            .zip(self.reducers.usable)
            .filter(|&(&lead_mask, _)| lead_mask & !mask == 0)
            .find(|&(_, &i)| divides(self.reducers.lead(i), monomial))
            .map(|(_, &i)| i)?;
        Some(Seed {
            element,
            multiplier: quotient(monomial, self.reducers.lead(element)),
            is_pivot: true,
            tail_only: false,
        })
    }

    /// Numbers the columns from the largest monomial down: by their keys, then those of one key among themselves, between which
    /// it can be stopped.
    fn sorted(mut self, order: &MonomialOrder) -> Result<(Plan, Vec<u32>), Stop> {
        let columns = &*self.columns;
        let mut keyed: Vec<(u64, u32)> = (0..columns.len() as u32)
            .map(|number| (order.first_key(columns.exponents(number)), number))
            .collect();
        keyed.sort_unstable_by_key(|&(key, _)| Reverse(key));
        for alike in keyed.chunk_by_mut(|a, b| a.0 == b.0) {
            self.budget.check()?;
            alike.sort_unstable_by(|&(_, a), &(_, b)| {
                order.compare_after_key(columns.exponents(b), columns.exponents(a))
            });
        }
        let by_size: Vec<u32> = keyed.into_iter().map(|(_, number)| number).collect();
        let mut place = vec![0; by_size.len()];
        for (at, &number) in by_size.iter().enumerate() {
            place[number as usize] = at as u32;
        }
        let rows = self.plan.pivots.iter_mut().chain(&mut self.plan.rows);
        for column in rows.flat_map(|row| &mut row.columns) {
            *column = place[*column as usize];
        }
        self.plan.columns = by_size.len();
        Ok((self.plan, by_size))
    }
}
