//! Residues modulo a prime that watch the budget.
//!
//! The crate that computes Groebner bases cannot be interrupted, but it leaves the elimination of every matrix to the
//! coefficients. So the coefficients here ask the budget before each matrix. Once it is used up they return no new rows:
//! every remaining pair then reduces to nothing, the computation runs out at once, and its result is thrown away.

use super::budget::{Budget, Stop};
use groebner::{F4Field, GroebnerError, Polynomial as Poly, Reducers, SparseRow, Zp};
use num_traits::{One, Zero};
use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A residue modulo a prime below 2^63.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Residue(pub(super) Zp);

struct Watch {
    budget: Budget,
    stop: Option<Stop>,
}

thread_local! {
    static WATCH: RefCell<Option<Watch>> = const { RefCell::new(None) };
}

/// The reduced Groebner basis of polynomials modulo one prime; empty for the zero ideal.
pub(super) fn basis_modulo_prime(
    polynomials: Vec<Poly<Residue>>,
    budget: &Budget,
) -> Result<Vec<Poly<Residue>>, Stop> {
    budget.check()?;
    WATCH.with_borrow_mut(|watch| {
        *watch = Some(Watch {
            budget: budget.clone(),
            stop: None,
        });
    });
    let result = groebner::groebner_basis_f4(polynomials, true);
    let watch = WATCH.with_borrow_mut(Option::take);
    if let Some(watch) = watch {
        budget.take_over(&watch.budget);
        if let Some(stop) = watch.stop {
            return Err(stop);
        }
    }
    match result {
        Ok(basis) => Ok(basis),
        Err(GroebnerError::EmptyInput) => Ok(Vec::new()),
        Err(_) => Err(Stop::Coefficients),
    }
}

/// Whether the matrix may be eliminated.
fn affordable(pivots: &Reducers<Residue>, rows: &[SparseRow<Residue>], columns: usize) -> bool {
    let known: usize = pivots.rows.iter().map(|(_, columns)| columns.len()).sum();
    let entries = known + rows.len() * columns;
    WATCH.with_borrow_mut(|watch| {
        let Some(watch) = watch else {
            return true;
        };
        if watch.stop.is_none() {
            watch.stop = watch.budget.spend_matrix(entries as u64).err();
        }
        watch.stop.is_none()
    })
}

fn bare_row(row: &SparseRow<Residue>) -> SparseRow<Zp> {
    SparseRow {
        columns: row.columns.clone(),
        coefficients: row.coefficients.iter().map(|r| r.0).collect(),
    }
}

fn bare_rows(rows: &[SparseRow<Residue>]) -> Vec<SparseRow<Zp>> {
    rows.iter().map(bare_row).collect()
}

fn bare_pivots(pivots: &Reducers<Residue>) -> Reducers<Zp> {
    Reducers {
        coefficients: pivots
            .coefficients
            .iter()
            .map(|row| row.iter().map(|r| r.0).collect())
            .collect(),
        rows: pivots.rows.clone(),
    }
}

fn watched_rows(rows: Vec<SparseRow<Zp>>) -> Vec<SparseRow<Residue>> {
    rows.into_iter()
        .map(|row| SparseRow {
            columns: row.columns,
            coefficients: row.coefficients.into_iter().map(Residue).collect(),
        })
        .collect()
}

impl F4Field for Residue {
    fn echelonize(
        pivots: &Reducers<Self>,
        rows: &[SparseRow<Self>],
        columns: usize,
    ) -> Vec<SparseRow<Self>> {
        if !affordable(pivots, rows, columns) {
            return Vec::new();
        }
        watched_rows(Zp::echelonize(
            &bare_pivots(pivots),
            &bare_rows(rows),
            columns,
        ))
    }

    fn reduce_rows(
        pivots: &Reducers<Self>,
        rows: &[SparseRow<Self>],
        columns: usize,
    ) -> Vec<SparseRow<Self>> {
        if !affordable(pivots, rows, columns) {
            return rows.to_vec();
        }
        watched_rows(Zp::reduce_rows(
            &bare_pivots(pivots),
            &bare_rows(rows),
            columns,
        ))
    }
}

impl Add for Residue {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Residue {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Residue {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Div for Residue {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl Neg for Residue {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Zero for Residue {
    fn zero() -> Self {
        Self(Zp::zero())
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl One for Residue {
    fn one() -> Self {
        Self(Zp::one())
    }
}
