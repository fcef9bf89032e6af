//! What a computation modulo one prime teaches about the others.
//!
//! Traverso, "Groebner trace algorithms" (1988): modulo almost all primes the same matrices appear, with other numbers in
//! them. So the plans are made once and only the rows that brought something new are reduced again. A prime that behaves
//! differently shows it by a leading monomial that is missing or a term that was not there; then nothing is said about it.
//! A trace that was itself learned modulo an unlucky prime leads all others astray alike; only a full computation modulo
//! another prime finds that out.

use super::budget::{Budget, Stop};
use super::linear::{Coefficient, Matrix};
use super::symbolic::{Plan, PlannedRow};
use groebner::{Reducers, SparseRow, Zp};
use num_traits::Zero;

/// One matrix of a computation, and the columns of the rows that came out of it.
#[derive(Debug)]
pub(super) struct Round {
    plan: Plan,
    supports: Vec<Vec<u32>>,
}

impl Round {
    /// Keeps of the plan the rows that suffice.
    pub(super) fn new<C>(mut plan: Plan, mut live: Vec<usize>, new: &[SparseRow<C>]) -> Self {
        live.sort_unstable();
        let mut rows: Vec<Option<PlannedRow>> = plan.rows.into_iter().map(Some).collect();
        plan.rows = live.iter().filter_map(|&i| rows[i].take()).collect();
        Self {
            plan,
            supports: new.iter().map(|row| row.columns.clone()).collect(),
        }
    }

    fn entries(&self) -> u64 {
        let supports: usize = self.supports.iter().map(Vec::len).sum();
        self.plan.entries() + supports as u64
    }

    /// The coefficients of the rows, in the columns that they have in this round; `None` where they have others.
    fn align(&self, rows: Vec<SparseRow<Zp>>) -> Option<Vec<Vec<Zp>>> {
        if rows.len() != self.supports.len() {
            return None;
        }
        rows.iter().zip(&self.supports).map(align).collect()
    }
}

fn align((row, support): (&SparseRow<Zp>, &Vec<u32>)) -> Option<Vec<Zp>> {
    let mut entries = row.columns.iter().zip(&row.coefficients).peekable();
    let aligned = support
        .iter()
        .map(|column| {
            let entry = entries.next_if(|(at, _)| *at == column);
            entry.map_or(Zp::zero(), |(_, &value)| value)
        })
        .collect();
    entries.peek().is_none().then_some(aligned)
}

impl Plan {
    /// The matrix, given the coefficients of all polynomials; with `tails` its rows lack their leading terms.
    pub(super) fn into_matrix<C: Clone>(self, coefficients: &[Vec<C>], tails: bool) -> Matrix<C> {
        let mut number = vec![usize::MAX; coefficients.len()];
        let mut shared = Vec::new();
        let pivots = self
            .pivots
            .into_iter()
            .map(|row| {
                let place = &mut number[row.element];
                if *place == usize::MAX {
                    *place = shared.len();
                    shared.push(coefficients[row.element].clone());
                }
                (*place, row.columns)
            })
            .collect();
        let rows = self.rows.into_iter();
        let rows = rows
            .map(|row| SparseRow {
                coefficients: coefficients[row.element][usize::from(tails)..].to_vec(),
                columns: row.columns,
            })
            .collect();
        Matrix {
            pivots: Reducers {
                coefficients: shared,
                rows: pivots,
            },
            rows,
            columns: self.columns,
        }
    }
}

/// All rounds of a computation in one order.
#[derive(Debug, Default)]
pub(super) struct Stage {
    /// For every polynomial of the input, where its terms were before they were sorted in this order.
    pub(super) places: Vec<Vec<u32>>,
    pub(super) rounds: Vec<Round>,
    pub(super) finish: Option<Round>,
}

/// A computation, in one order after another.
#[derive(Debug, Default)]
pub(super) struct Trace {
    pub(super) stages: Vec<Stage>,
}

impl Trace {
    /// The coefficients of the reduced basis modulo another prime, in the terms of the basis that was learned, given those of
    /// the input; `None` where this prime behaves differently.
    pub(super) fn replay(
        &self,
        mut elements: Vec<Vec<Zp>>,
        prime: u64,
        budget: &Budget,
    ) -> Result<Option<Vec<Vec<Zp>>>, Stop> {
        for stage in &self.stages {
            let Some(mut basis) = stage.replay(&elements, budget)? else {
                return Ok(None);
            };
            for tail in &mut basis {
                tail.insert(0, Zp::from_i64(1, prime));
            }
            elements = basis;
        }
        Ok(Some(elements))
    }
}

impl Stage {
    /// Matrix entries that are kept.
    pub(super) fn entries(&self) -> u64 {
        self.rounds.iter().map(Round::entries).sum()
    }

    /// The tails of the basis, leading coefficients 1 left out.
    fn replay(&self, input: &[Vec<Zp>], budget: &Budget) -> Result<Option<Vec<Vec<Zp>>>, Stop> {
        let sorted = input.iter().zip(&self.places);
        let mut elements: Vec<Vec<Zp>> = sorted
            .map(|(values, places)| places.iter().map(|&i| values[i as usize]).collect())
            .collect();
        for (number, round) in self.rounds.iter().enumerate() {
            budget.spend_matrix(round.plan.entries())?;
            let matrix = round.plan.clone().into_matrix(&elements, false);
            let (mut new, _) = Zp::echelon(matrix, true, budget)?;
            new.sort_by_key(|row| std::cmp::Reverse(row.columns[0]));
            let leads = new.iter().map(|row| row.columns[0]);
            if leads.ne(round.supports.iter().map(|support| support[0])) {
                return Ok(None);
            }
            let Some(new) = round.align(new) else {
                return Ok(None);
            };
            if number == 0 {
                elements.clear();
            }
            elements.extend(new);
        }
        let Some(finish) = &self.finish else {
            return Ok(None);
        };
        budget.spend_matrix(finish.plan.entries())?;
        let tails = Zp::reduce(finish.plan.clone().into_matrix(&elements, true), budget)?;
        Ok(finish.align(tails))
    }
}
