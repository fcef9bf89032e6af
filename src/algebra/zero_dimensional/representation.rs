//! Rational univariate representation: every coordinate of a zero as a quotient of polynomials in the value of one linear
//! form (Rouillier 1999).
//!
//! All of it comes from traces: the power sums of the values give their polynomial, the traces of a coordinate times the
//! powers of the form give its numerator. Whether the form separates the zeros is proven at the end: a coordinate times the
//! denominator minus the numerator must vanish at every zero, that is, be in the kernel of the trace form.

use super::quotient::{Column, Products, Quotient, Scaled, words};
use crate::algebra::engine::{Budget, Stop};
use crate::algebra::polynomial::Rational;
use crate::algebra::univariate::{Univariate, integer_gcd, integer_multiple};
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
            budget.spend(words(c) * words(&self.denominator) * column.len() as u64)?;
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
    let against = |row: &Scaled, power: &[BigInt]| -> Rational {
        let sum = row.values.iter().zip(power).map(|(a, b)| a * b).sum();
        Rational::new(sum, row.denominator.clone())
    };
    let sums: Vec<Rational> = powers.iter().map(|p| against(traces, p)).collect();
    let Some(polynomial) = from_power_sums(&sums) else {
        return Ok(None);
    };
    // Values of the form itself, not of its multiple.
    let values = stretched(&polynomial, &multiplication.denominator).primitive();
    let found = values.factors(budget)?;
    let distinct = found
        .factors
        .iter()
        .fold(Univariate::from_integers(&[1]), |p, (f, _)| &p * f);
    let scaled_distinct = shrunk_monic(&distinct, &multiplication.denominator);

    let ones = traces.clone();
    let rows: Vec<Scaled> = (0..form.len())
        .map(|variable| trace_row(quotient, variable, traces))
        .collect();
    let numerator = |row: &Scaled| {
        let traces: Vec<Rational> = powers[..distinct.degree()]
            .iter()
            .map(|p| against(row, p))
            .collect();
        horner_sum(&scaled_distinct, &traces)
    };
    let mut all: Vec<Vec<Rational>> = vec![numerator(&ones)];
    all.extend(rows.iter().map(numerator));
    if distinct.degree() < n {
        let zero_everywhere = |variable: usize| {
            vanishes(
                quotient,
                products,
                traces,
                &powers,
                &all[0],
                &all[variable + 1],
                variable,
                budget,
            )
        };
        for variable in 0..form.len() {
            if !zero_everywhere(variable)? {
                return Ok(None);
            }
        }
    }
    // One common integer multiple for the numerators and the denominator, in the variable of the form itself.
    let width = distinct.degree();
    let flat: Vec<Rational> = all.into_iter().flatten().collect();
    let (integers, _) = integer_multiple(&flat);
    let mut polynomials: Vec<Univariate> = integers
        .chunks(width.max(1))
        .map(|chunk| {
            stretched(
                &Univariate::new(chunk.to_vec()),
                &multiplication.denominator,
            )
        })
        .collect();
    let content = polynomials
        .iter()
        .fold(BigInt::zero(), |gcd, p| integer_gcd(&gcd, &p.content()));
    for polynomial in &mut polynomials {
        let reduced = polynomial.coefficients().iter().map(|c| c / &content);
        *polynomial = Univariate::new(reduced.collect());
    }
    let denominator = polynomials.remove(0);
    Ok(Some(Representation {
        form: form.to_vec(),
        factors: found.factors,
        complete: found.complete,
        denominator,
        numerators: polynomials,
    }))
}

/// tr(variable · monomial) for all standard monomials.
fn trace_row(quotient: &Quotient, variable: usize, traces: &Scaled) -> Scaled {
    let values: Vec<Rational> = quotient.tables[variable]
        .iter()
        .map(|column| match column {
            Column::Standard(place) => {
                Rational::new(traces.values[*place].clone(), traces.denominator.clone())
            }
            Column::Combination(vector) => traces.dot(vector),
        })
        .collect();
    let (values, denominator) = integer_multiple(&values);
    Scaled {
        values,
        denominator,
    }
}

/// The monic polynomial whose roots have these power sums, the first being their number, by Newton's identities. Its
/// coefficients are integers: the roots are eigenvalues of a matrix of integers.
fn from_power_sums(sums: &[Rational]) -> Option<Univariate> {
    let degree = sums.len() - 1;
    let mut coefficients = vec![BigInt::zero(); degree + 1];
    coefficients[degree] = BigInt::one();
    for k in 1..=degree {
        let mut sum = Rational::zero();
        for i in 1..=k {
            sum += &sums[i] * &coefficients[degree - k + i];
        }
        let value = -sum / BigInt::from(k);
        if !value.is_integer() {
            return None;
        }
        coefficients[degree - k] = value.to_integer();
    }
    Some(Univariate::new(coefficients))
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

/// The monic multiple of f(x/factor), by ascending power.
fn shrunk_monic(polynomial: &Univariate, factor: &BigInt) -> Vec<Rational> {
    let mut power = BigInt::one();
    let mut values: Vec<Rational> = Vec::new();
    for c in polynomial.coefficients().iter().rev() {
        values.push(Rational::new(c * &power, polynomial.leading()));
        power *= factor;
    }
    values.reverse();
    values
}

/// The sum of the traces times the Horner polynomials of a monic polynomial of degree d: Rouillier's formula. The polynomial
/// number i, of degree i, goes with the trace number d - 1 - i.
fn horner_sum(monic: &[Rational], traces: &[Rational]) -> Vec<Rational> {
    let degree = traces.len();
    let mut sum = vec![Rational::zero(); degree];
    for (i, trace) in traces.iter().enumerate() {
        if trace.is_zero() {
            continue;
        }
        // The Horner polynomial of degree d - 1 - i has the coefficients of x^(i+1) and above.
        for (place, c) in monic[i + 1..].iter().enumerate() {
            sum[place] += trace * c;
        }
    }
    sum
}

/// Whether x·denominator - numerator vanishes at all zeros.
#[allow(clippy::too_many_arguments)]
fn vanishes(
    quotient: &Quotient,
    products: &Products,
    traces: &Scaled,
    powers: &[Vec<BigInt>],
    denominator: &[Rational],
    numerator: &[Rational],
    variable: usize,
    budget: &Budget,
) -> Result<bool, Stop> {
    let element = |coefficients: &[Rational]| {
        let n = quotient.dimension();
        let mut sum = vec![Rational::zero(); n];
        for (c, power) in coefficients.iter().zip(powers) {
            for (entry, v) in sum.iter_mut().zip(power) {
                *entry += c * v;
            }
        }
        sum
    };
    let (values, scale) = integer_multiple(&element(denominator));
    let product = quotient.times(
        variable,
        &Scaled {
            values,
            denominator: scale,
        },
        budget,
    )?;
    let difference: Vec<Rational> = product
        .values
        .iter()
        .zip(element(numerator))
        .map(|(v, w)| Rational::new(v.clone(), product.denominator.clone()) - w)
        .collect();
    let (values, denominator) = integer_multiple(&difference);
    let difference = Scaled {
        values,
        denominator,
    };
    if difference.values.iter().all(Zero::is_zero) {
        return Ok(true);
    }
    Ok(quotient.monomials.iter().all(|a| {
        let row: Vec<Rational> = quotient
            .monomials
            .iter()
            .map(|b| traces.dot(products.of(a, b)))
            .collect();
        let (values, denominator) = integer_multiple(&row);
        let row = Scaled {
            values,
            denominator,
        };
        row.dot(&difference).is_zero()
    }))
}
