//! Numbers read from text and written to it, in both forms.

use crate::error::GeometryError;
use crate::measured::Measured;
use crate::scalar::Scalar;
use kutzbach_math::number::{Number, NumberError};
use std::collections::BTreeMap;

/// Longer exact expressions are told by their value.
const LONGEST: usize = 80;

/// Places of a decimal that is written in full.
const PLACES: u32 = 15;

/// A number that text gives, and that is given as text.
pub trait Legible: Scalar {
    /// The number of a literal or an expression.
    ///
    /// # Errors
    /// Beyond the range of the form.
    fn from_number(number: &Number) -> Result<Self, GeometryError>;

    /// The number as text for a person: exact where it is short, otherwise about.
    fn to_text(&self) -> String;
}

impl Legible for Number {
    fn from_number(number: &Number) -> Result<Self, GeometryError> {
        Ok(number.clone())
    }

    fn to_text(&self) -> String {
        if let Some(decimal) = self.decimal_text(PLACES)
            && decimal.len() <= LONGEST
        {
            return decimal;
        }
        let exact = self.source();
        match exact.len() <= LONGEST {
            true => exact,
            false => format!("about {}", double_text(self.value())),
        }
    }
}

impl Legible for Measured {
    fn from_number(number: &Number) -> Result<Self, GeometryError> {
        Self::stated(number)
    }

    fn to_text(&self) -> String {
        let middle = double_text(self.double());
        match self.uncertainty() {
            0.0 => middle,
            uncertainty => format!("{middle} ± {uncertainty:.1e}"),
        }
    }
}

/// A double without a long row of zeros.
pub(crate) fn double_text(x: f64) -> String {
    match x == 0.0 || (1e-5..1e15).contains(&x.abs()) {
        true => format!("{x}"),
        false => format!("{x:e}"),
    }
}

/// A decimal in the form that is asked for.
pub(crate) fn read_number<S: Legible>(text: &str) -> Result<S, String> {
    let number = Number::decimal(text).map_err(|error| error.to_string())?;
    S::from_number(&number).map_err(|error| error.to_string())
}

/// What stands between `${` and `}`; numbers may have names.
///
/// # Errors
/// What is wrong, and its offset in the text.
pub(crate) fn read_expression<S: Legible>(
    text: &str,
    names: &BTreeMap<String, Number>,
) -> Result<(S, Number), (usize, String)> {
    let mut lookup = |name: &str| Ok(names.get(name).cloned());
    let number = Number::expression(text, &mut lookup)
        .map_err(|error: NumberError| (error.offset, error.to_string()))?;
    let own = S::from_number(&number).map_err(|error| (0, error.to_string()))?;
    Ok((own, number))
}
