//! Rational univariate representation: every coordinate of a zero as a quotient of polynomials in the value of one linear
//! form (Rouillier 1999).
//!
//! All of it comes from traces: the power sums of the values give their polynomial, the traces of a coordinate times the
//! powers of the form give its numerator. Whether the form separates the zeros is proven at the end: a coordinate times the
//! denominator minus the numerator must vanish at every zero, that is, be in the kernel of the trace form.

use super::quotient::{Column, Products, Quotient, Scaled, words};
use crate::engine::{Budget, Stop};
use crate::polynomial::Rational;
use crate::univariate::{Univariate, fraction, integer_gcd};
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// The values of a linear form at the zeros, and the coordinates as functions of the value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Representation {
    /// The coefficients of the linear form, one per variable.
    pub form: Vec<i64>,
    /// The polynomial with the values of the form as its simple roots, irreducible factors with the multiplicities of the
    /// zeros that belong to them.
    pub factors: Vec<(Univariate, u32)>,
    /// Whether the factors are proven irreducible.
    pub complete: bool,
    /// What the numerators are divided by; not zero at any value.
    pub denominator: Univariate,
    /// One per variable.
    pub numerators: Vec<Univariate>,
}

/// Multiplication by the form times a common denominator: a matrix of integers by columns.
struct Multiplication {
    columns: Vec<Vec<BigInt>>,
    denominator: BigInt,
}

impl Multiplication {
    fn by(form: &[i64], quotient: &Quotient) -> Self {
        let n = quotient.dimension();
        let mut denominator = BigInt::one();
        for (&c, table) in form.iter().zip(&quotient.tables) {
            for column in table {
                if let (true, Column::Combination(vector)) = (c != 0, column) {
                    let shared = integer_gcd(&denominator, &vector.denominator);
                    denominator *= &vector.denominator / shared;
                }
            }
        }
        let mut columns = vec![vec![BigInt::zero(); n]; n];
        for (&c, table) in form.iter().zip(&quotient.tables).filter(|(c, _)| **c != 0) {
            for (sum, column) in columns.iter_mut().zip(table) {
                match column {
                    Column::Standard(place) => sum[*place] += &denominator * c,
                    Column::Combination(vector) => {
                        let factor = (&denominator / &vector.denominator) * c;
                        for (entry, v) in sum.iter_mut().zip(&vector.values) {
                            *entry += v * &factor;
                        }
                    }
                }
            }
        }
        Self {
            columns,
            denominator,
        }
    }

    fn times(&self, element: &[BigInt], budget: &Budget) -> Result<Vec<BigInt>, Stop> {
        let mut product = vec![BigInt::zero(); element.len()];
        for (c, column) in element.iter().zip(&self.columns) {
            if c.is_zero() {
                continue;
            }
            budget.multiply(words(c) * words(&self.denominator) * column.len() as u64)?;
            for (entry, v) in product.iter_mut().zip(column) {
                if !v.is_zero() {
                    *entry += c * v;
                }
            }
        }
        Ok(product)
    }
}

/// The representation by a form; `None` where the form does not separate the zeros.
pub(super) fn representation(
    quotient: &Quotient,
    products: &Products,
    traces: &Scaled,
    form: &[i64],
    budget: &Budget,
) -> Result<Option<Representation>, Stop> {
    let n = quotient.dimension();
    let multiplication = Multiplication::by(form, quotient);
    // Powers of the scaled form, as elements.
    let mut powers = vec![vec![BigInt::zero(); n]];
    powers[0][0] = BigInt::one();
    for i in 0..n {
        powers.push(multiplication.times(&powers[i], budget)?);
    }
    let longest = |values: &[BigInt]| values.iter().map(words).max().unwrap_or(1);
    for power in &powers {
        budget.multiply(longest(power) * longest(&traces.values) * n as u64)?;
    }
    // The traces of the powers are integers: those of a matrix of integers.
    let sums: Vec<BigInt> = powers
        .iter()
        .map(|power| product_sum(traces, power) / &traces.denominator)
        .collect();
    let digits = longest(&sums);
    budget.multiply((n * n) as u64 * digits * digits / 4)?;
    let polynomial = from_power_sums(&sums);
    // Values of the form itself, not of its multiple.
    let values = stretched(&polynomial, &multiplication.denominator).primitive();
    let found = values.factors(budget)?;
    let distinct = found
        .factors
        .iter()
        .fold(Univariate::from_integers(&[1]), |p, (f, _)| &p * f);
    let monic = shrunk_monic(&distinct, &multiplication.denominator);

    let mut rows = vec![traces.clone()];
    rows.extend((0..form.len()).map(|variable| trace_row(quotient, variable, traces)));
    // Integers over the denominator of the row.
    let numerators: Vec<Vec<BigInt>> = rows
        .iter()
        .map(|row| {
            let traces = powers[..distinct.degree()].iter();
            let traces: Vec<BigInt> = traces.map(|power| product_sum(row, power)).collect();
            horner_sum(&monic, &traces)
        })
        .collect();
    let common = rows.iter().fold(BigInt::one(), |common, row| {
        let shared = integer_gcd(&common, &row.denominator);
        common * (&row.denominator / shared)
    });
    let numerators: Vec<Vec<BigInt>> = numerators
        .into_iter()
        .zip(&rows)
        .map(|(numerator, row)| {
            let factor = &common / &row.denominator;
            numerator.into_iter().map(|c| c * &factor).collect()
        })
        .collect();
    if distinct.degree() < n {
        let context = Vanishing {
            quotient,
            products,
            traces,
            powers: &powers,
        };
        for (variable, numerator) in numerators[1..].iter().enumerate() {
            if !context.vanishes(variable, &numerators[0], numerator, budget)? {
                return Ok(None);
            }
        }
    }
    // In the variable of the form itself, without common factors.
    let polynomials: Vec<Univariate> = numerators
        .into_iter()
        .map(|numerator| stretched(&Univariate::new(numerator), &multiplication.denominator))
        .collect();
    let content = polynomials
        .iter()
        .fold(BigInt::zero(), |gcd, p| integer_gcd(&gcd, &p.content()));
    let mut polynomials = polynomials.iter().map(|polynomial| {
        let reduced = polynomial.coefficients().iter().map(|c| c / &content);
        Univariate::new(reduced.collect())
    });
    let denominator = polynomials.next().unwrap_or_default();
    Ok(Some(Representation {
        form: form.to_vec(),
        factors: found.factors,
        complete: found.complete,
        denominator,
        numerators: polynomials.collect(),
    }))
}

/// The sum of products, without the denominator of the row.
fn product_sum(row: &Scaled, element: &[BigInt]) -> BigInt {
    row.values.iter().zip(element).map(|(a, b)| a * b).sum()
}

/// tr(variable · monomial) for all standard monomials.
fn trace_row(quotient: &Quotient, variable: usize, traces: &Scaled) -> Scaled {
    let values: Vec<Rational> = quotient.tables[variable]
        .iter()
        .map(|column| match column {
            Column::Standard(place) => fraction(traces.values[*place].clone(), &traces.denominator),
            Column::Combination(vector) => traces.dot(vector),
        })
        .collect();
    Scaled::of(&values)
}

/// The monic polynomial whose roots have these power sums, the first being their number, by Newton's identities. Its
/// coefficients are integers: the roots are the eigenvalues of a matrix of integers.
fn from_power_sums(sums: &[BigInt]) -> Univariate {
    let degree = sums.len() - 1;
    let mut coefficients = vec![BigInt::zero(); degree + 1];
    coefficients[degree] = BigInt::one();
    for k in 1..=degree {
        let sum: BigInt = (1..=k)
            .map(|i| &sums[i] * &coefficients[degree - k + i])
            .sum();
        coefficients[degree - k] = -sum / BigInt::from(k);
    }
    Univariate::new(coefficients)
}

/// f(factor·x).
fn stretched(polynomial: &Univariate, factor: &BigInt) -> Univariate {
    let mut power = BigInt::one();
    let mut values = Vec::new();
    for c in polynomial.coefficients() {
        values.push(c * &power);
        power *= factor;
    }
    Univariate::new(values)
}

/// The monic multiple of f(x/factor), by ascending power. It divides the monic polynomial of the eigenvalues of a matrix of
/// integers, so its coefficients are integers, too.
fn shrunk_monic(polynomial: &Univariate, factor: &BigInt) -> Vec<BigInt> {
    let mut power = BigInt::one();
    let mut values: Vec<BigInt> = Vec::new();
    for c in polynomial.coefficients().iter().rev() {
        values.push(c * &power / polynomial.leading());
        power *= factor;
    }
    values.reverse();
    values
}

/// The sum of the traces times the Horner polynomials of a monic polynomial of degree d: Rouillier's formula. The polynomial
/// number i, of degree i, goes with the trace number d - 1 - i.
fn horner_sum(monic: &[BigInt], traces: &[BigInt]) -> Vec<BigInt> {
    let mut sum = vec![BigInt::zero(); traces.len()];
    for (i, trace) in traces.iter().enumerate() {
        // The Horner polynomial of degree d - 1 - i has the coefficients of x^(i+1) and above.
        for (entry, c) in sum.iter_mut().zip(&monic[i + 1..]) {
            *entry += trace * c;
        }
    }
    sum
}

/// What the proof that a form separates the zeros needs.
struct Vanishing<'a> {
    quotient: &'a Quotient,
    products: &'a Products,
    traces: &'a Scaled,
    powers: &'a [Vec<BigInt>],
}

impl Vanishing<'_> {
    /// A polynomial in the scaled form, as an element.
    fn element(&self, coefficients: &[BigInt]) -> Vec<BigInt> {
        let mut sum = vec![BigInt::zero(); self.quotient.dimension()];
        for (c, power) in coefficients.iter().zip(self.powers) {
            for (entry, v) in sum.iter_mut().zip(power) {
                *entry += c * v;
            }
        }
        sum
    }

    /// Whether x·denominator - numerator vanishes at all zeros: whether its product with anything has the trace zero.
    fn vanishes(
        &self,
        variable: usize,
        denominator: &[BigInt],
        numerator: &[BigInt],
        budget: &Budget,
    ) -> Result<bool, Stop> {
        let element = Scaled {
            values: self.element(denominator),
            denominator: BigInt::one(),
        };
        let product = self.quotient.times(variable, &element, budget)?;
        let difference = Scaled {
            values: product
                .values
                .iter()
                .zip(self.element(numerator))
                .map(|(v, w)| v - w * &product.denominator)
                .collect(),
            denominator: product.denominator,
        };
        if difference.values.iter().all(Zero::is_zero) {
            return Ok(true);
        }
        let monomials = &self.quotient.monomials;
        Ok(monomials.iter().all(|a| {
            let row: Vec<Rational> = monomials
                .iter()
                .map(|b| self.traces.dot(self.products.of(a, b)))
                .collect();
            product_sum(&Scaled::of(&row), &difference.values).is_zero()
        }))
    }
}
