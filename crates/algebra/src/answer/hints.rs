//! What the meaning of variables tells the decomposition of a solution set.

use crate::{
    AlgebraicNumber, Budget, Hints, Meaning, Polynomial, PolynomialSystem, Rational, Stop,
    Univariate,
};
use kutzbach_math::number::Number;

/// Bits to which roots of minimal polynomials are enclosed.
const BITS: u64 = 64;

/// What the meaning of the variables says: angles and algebraic numbers.
pub(super) fn hints(system: &PolynomialSystem, budget: &Budget) -> Result<Hints, Stop> {
    let mut hints = Hints::default();
    for (index, variable) in system.variables.iter().enumerate() {
        match &variable.meaning {
            Meaning::Sine {
                joint,
                freedom,
                axis_square,
            } if *axis_square == Number::one() => {
                let cosine = system.variables.iter().position(|other| {
                    matches!(&other.meaning, Meaning::Cosine { joint: j, freedom: f }
                        if j == joint && f == freedom)
                });
                if let Some(cosine) = cosine {
                    hints.angles.push((cosine, index));
                }
            }
            Meaning::Algebraic { value } => {
                if let Some(number) = isolated(system, index, value, &hints.numbers, budget)? {
                    hints.numbers.push(number);
                }
            }
            _ => {}
        }
    }
    Ok(hints)
}

/// The interval of an algebraic number that no conjugate shares; `None` where its equation holds variables that may have several
/// values, such as parameters.
fn isolated(
    system: &PolynomialSystem,
    variable: usize,
    value: &Number,
    known: &[AlgebraicNumber],
    budget: &Budget,
) -> Result<Option<AlgebraicNumber>, Stop> {
    let equation = system.equations.iter().find(
        |e| matches!(e.origin, crate::Origin::MinimalPolynomial { variable: v } if v == variable),
    );
    let Some(equation) = equation.map(|e| &e.polynomial) else {
        return Ok(None);
    };
    let Some(univariate) = Univariate::from_polynomial(equation, variable) else {
        return Ok(above(equation, variable, value, known));
    };
    let Some(near) = Rational::from_float(value.value()) else {
        return Ok(None);
    };
    let nearest = univariate
        .real_roots(budget)?
        .into_iter()
        .map(|root| univariate.refine(&root, BITS))
        .min_by_key(|root| {
            let off = root.middle() - &near;
            if off < Rational::from_integer(0.into()) {
                -off
            } else {
                off
            }
        });
    Ok(nearest.map(|root| AlgebraicNumber {
        variable,
        low: root.low,
        high: root.high,
    }))
}

/// The interval of a root of other algebraic numbers, such as √√2. With these in their intervals its equation says what a power
/// of it is, so that only its opposite is real besides.
fn above(
    equation: &Polynomial,
    variable: usize,
    value: &Number,
    known: &[AlgebraicNumber],
) -> Option<AlgebraicNumber> {
    /// Far above the rounding of a double, far below the number itself.
    const MARGIN: f64 = 1.0 / (1u64 << 40) as f64;
    let settled = |v: usize| v == variable || known.iter().any(|number| number.variable == v);
    if (0..equation.variables()).any(|v| equation.mentions(v) && !settled(v)) {
        return None;
    }
    let value = value.value();
    let margin = value.abs() * MARGIN;
    Some(AlgebraicNumber {
        variable,
        low: Rational::from_float(value - margin)?,
        high: Rational::from_float(value + margin)?,
    })
}
