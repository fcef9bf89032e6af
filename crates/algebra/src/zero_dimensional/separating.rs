//! A linear form that takes different values at different zeros, searched modulo a prime.
//!
//! What is found here is a good guess; the exact computation proves it or asks for another one.

use super::quotient::{Column, Quotient};
use crate::engine::{Budget, Stop};
use crate::univariate::residues::{
    Primes, Residues, derivative, gcd,
    modp::{add, inv, mul, neg, sub},
    residue,
};

type Matrix = Vec<Residues>;

/// The multiplication tables modulo a prime that divides no denominator.
pub(super) struct Image {
    prime: u64,
    /// For every variable, the products with the standard monomials.
    tables: Vec<Matrix>,
    traces: Residues,
}

impl Image {
    pub(super) fn new(quotient: &Quotient, budget: &Budget) -> Result<Self, Stop> {
        for prime in Primes::new() {
            if let Some(tables) = tables(quotient, prime) {
                let traces = traces(quotient, &tables, prime, budget)?;
                return Ok(Self {
                    prime,
                    tables,
                    traces,
                });
            }
        }
        Err(Stop::Coefficients)
    }

    /// The number of different values that a linear form takes at the zeros, modulo the prime.
    fn values(&self, form: &[i64], budget: &Budget) -> Result<usize, Stop> {
        let (p, n) = (self.prime, self.traces.len());
        let mut matrix = vec![vec![0; n]; n];
        for (&c, table) in form.iter().zip(&self.tables) {
            let c = residue(&c.into(), p);
            if c == 0 {
                continue;
            }
            for (row, products) in matrix.iter_mut().zip(table) {
                for (entry, &value) in row.iter_mut().zip(products) {
                    *entry = add(*entry, mul(c, value, p), p);
                }
            }
        }
        budget.multiply((n * n * n) as u64)?;
        // Power sums of the values, then Newton's identities, then what is not repeated.
        let mut power = vec![0; n];
        power[0] = 1;
        let mut sums = Vec::with_capacity(n + 1);
        for _ in 0..=n {
            sums.push(dot(&power, &self.traces, p));
            power = times(&matrix, &power, p);
        }
        let polynomial = from_power_sums(&sums, p);
        let repeated = gcd(&polynomial, &derivative(&polynomial, p), p);
        Ok(polynomial.len() - repeated.len())
    }

    /// The rank of the trace form modulo the prime: the number of distinct zeros, unless the prime is unlucky.
    fn rank(&self, quotient: &Quotient, budget: &Budget) -> Result<usize, Stop> {
        let (p, n) = (self.prime, self.traces.len());
        let mut form: Matrix = Vec::with_capacity(n);
        for monomial in &quotient.monomials {
            let row = self.multiplication(monomial, budget)?;
            form.push(
                row.iter()
                    .map(|product| dot(product, &self.traces, p))
                    .collect(),
            );
        }
        Ok(rank(form, p))
    }

    /// The products of a monomial with all standard monomials.
    fn multiplication(&self, monomial: &[u32], budget: &Budget) -> Result<Matrix, Stop> {
        let n = self.traces.len();
        let mut products: Matrix = (0..n)
            .map(|i| (0..n).map(|j| u64::from(i == j)).collect())
            .collect();
        for (variable, &exponent) in monomial.iter().enumerate() {
            for _ in 0..exponent {
                budget.multiply((n * n * n) as u64)?;
                for product in &mut products {
                    *product = times(&self.tables[variable], product, self.prime);
                }
            }
        }
        Ok(products)
    }

    /// Forms that seem to separate the zeros, the simplest first; some later one does for certain.
    ///
    /// Single variables and sums of two keep the coefficients of what follows small. The forms x1 + k·x2 + k²·x3 + ... fail
    /// for finitely many k only (Rouillier 1999, lemma 2.1).
    pub(super) fn forms(
        &self,
        quotient: &Quotient,
        skip: usize,
        budget: &Budget,
    ) -> Result<Option<Vec<i64>>, Stop> {
        let variables = self.tables.len();
        let wanted = self.rank(quotient, budget)?;
        let mut skipped = 0;
        let single = (0..variables).rev().map(|i| unit(&[(i, 1)], variables));
        let pairs = (0..variables).rev().flat_map(|j| {
            (0..j)
                .rev()
                .map(move |i| unit(&[(i, 2), (j, 1)], variables))
        });
        let small = (1..40).map(|k| {
            let value = |i: i64| (i * i * k + i + k) % 11 - 5;
            (0..variables as i64).map(value).collect()
        });
        let powers = (2..2000_i64).map(|k| {
            let next = |c: &i64| c.checked_mul(k);
            let mut form: Vec<i64> = std::iter::successors(Some(1), next)
                .take(variables)
                .collect();
            form.resize(variables, 0);
            form
        });
        for form in single.chain(pairs).chain(small).chain(powers) {
            if self.values(&form, budget)? == wanted {
                if skipped == skip {
                    return Ok(Some(form));
                }
                skipped += 1;
            }
        }
        Ok(None)
    }
}

fn unit(entries: &[(usize, i64)], variables: usize) -> Vec<i64> {
    let mut form = vec![0; variables];
    for &(i, c) in entries {
        form[i] = c;
    }
    form
}

fn tables(quotient: &Quotient, prime: u64) -> Option<Vec<Matrix>> {
    let n = quotient.dimension();
    let column = |column: &Column| -> Option<Residues> {
        let mut values = vec![0; n];
        match column {
            Column::Standard(place) => values[*place] = 1,
            Column::Combination(vector) => {
                let denominator = residue(&vector.denominator, prime);
                if denominator == 0 {
                    return None;
                }
                let factor = inv(denominator, prime);
                for (value, v) in values.iter_mut().zip(&vector.values) {
                    *value = mul(residue(v, prime), factor, prime);
                }
            }
        }
        Some(values)
    };
    quotient
        .tables
        .iter()
        .map(|table| table.iter().map(column).collect())
        .collect()
}

/// The trace of multiplication by each standard monomial.
fn traces(
    quotient: &Quotient,
    tables: &[Matrix],
    prime: u64,
    budget: &Budget,
) -> Result<Residues, Stop> {
    let n = quotient.dimension();
    let image = Image {
        prime,
        tables: tables.to_vec(),
        traces: vec![0; n],
    };
    let mut traces = Vec::with_capacity(n);
    for monomial in &quotient.monomials {
        let products = image.multiplication(monomial, budget)?;
        let diagonal = products.iter().enumerate().map(|(i, product)| product[i]);
        traces.push(diagonal.fold(0, |sum, entry| add(sum, entry, prime)));
    }
    Ok(traces)
}

fn dot(a: &[u64], b: &[u64], prime: u64) -> u64 {
    a.iter()
        .zip(b)
        .fold(0, |sum, (&x, &y)| add(sum, mul(x, y, prime), prime))
}

/// An element times what a table of products stands for.
fn times(table: &Matrix, element: &[u64], prime: u64) -> Residues {
    let mut product = vec![0; element.len()];
    for (&c, column) in element.iter().zip(table) {
        if c != 0 {
            for (entry, &value) in product.iter_mut().zip(column) {
                *entry = add(*entry, mul(c, value, prime), prime);
            }
        }
    }
    product
}

/// The monic polynomial with given power sums of its roots (the first is the number of roots): Newton's identities.
fn from_power_sums(sums: &[u64], prime: u64) -> Residues {
    let degree = sums.len() - 1;
    let mut polynomial = vec![0; degree + 1];
    polynomial[degree] = 1;
    for k in 1..=degree {
        let sum = (1..=k).fold(0, |sum, i| {
            add(sum, mul(polynomial[degree - k + i], sums[i], prime), prime)
        });
        polynomial[degree - k] = neg(mul(sum, inv(k as u64, prime), prime), prime);
    }
    polynomial
}

fn rank(mut matrix: Matrix, prime: u64) -> usize {
    let n = matrix.len();
    let mut rank = 0;
    for column in 0..n {
        let Some(row) = (rank..n).find(|&row| matrix[row][column] != 0) else {
            continue;
        };
        matrix.swap(rank, row);
        let pivot = matrix[rank].clone();
        let factor = inv(pivot[column], prime);
        for row in &mut matrix[rank + 1..] {
            let multiple = mul(row[column], factor, prime);
            if multiple != 0 {
                for (entry, &p) in row.iter_mut().zip(&pivot) {
                    *entry = sub(*entry, mul(multiple, p, prime), prime);
                }
            }
        }
        rank += 1;
    }
    rank
}
