//! Numbers that were worked out from literals, and how they depend on these.
//!
//! A reader that multiplies frames hands over results, not texts. How far a result may be from the number meant is a matter of the texts
//! behind it and of how their writer rounds, which is known only when all of them have been read. So a derived number keeps its literals,
//! each with the derivative of the result by it. Where a literal `x` is uncertain by `u(x)`, the result is by at most
//!
//! ```text
//! Σ |∂result/∂x| u(x)
//! ```
//!
//! to first order; products of two uncertainties are left out.

use super::Number;
use std::sync::Arc;

/// What a literal measures: programs print each of these with digits of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// In metres.
    Length,
    /// In radians or degrees, or as parts of a quaternion or a matrix of rotation.
    Angle,
    /// A component of a direction.
    Direction,
}

/// A literal that a number was worked out from.
#[derive(Clone, Debug)]
pub struct Input {
    /// What the literal measures.
    pub quantity: Quantity,
    /// The literal.
    pub literal: Number,
    /// Size of the derivative of the number by the literal, in units of the one per unit of the other.
    pub slope: f64,
}

/// The literals that a number was worked out from, as they are found.
#[derive(Clone, Debug, Default)]
pub struct Inputs(Vec<Input>);

impl Input {
    /// Equal texts of one quantity were rounded alike.
    fn key(&self) -> (Quantity, Option<&str>) {
        (self.quantity, self.literal.literal_text())
    }
}

impl Inputs {
    /// Derivatives below this are what rounding leaves of zero: products of a few rotations, known to the rounding of doubles, and of
    /// levers of up to some thousand metres. One that is truly so small is that of a literal in units of a picometre and less. Which
    /// literals a number is known by hangs on it; how far it may be off does not, but for this share of what those left out are.
    const NOTHING: f64 = 4096.0 * f64::EPSILON;

    /// Notes that the result changes by `slope` times what `number` changes by. A number that was derived itself passes its own literals
    /// on, and an exact one has nothing to pass on; slopes that are not finite are left out.
    pub fn add(&mut self, quantity: Quantity, number: &Number, slope: f64) {
        let slope = slope.abs();
        if !(slope > Self::NOTHING && slope.is_finite()) {
            return;
        }
        let passed_on = number.inputs().iter().map(|input| Input {
            slope: slope * input.slope,
            ..input.clone()
        });
        self.0.extend(passed_on);
        if number.inputs().is_empty() && number.stated().is_some() {
            self.0.push(Input {
                quantity,
                literal: number.clone(),
                slope,
            });
        }
    }

    /// Each text once.
    fn merged(mut self) -> Vec<Input> {
        self.0.sort_by(|a, b| a.key().cmp(&b.key()));
        let mut merged: Vec<Input> = Vec::with_capacity(self.0.len());
        for input in self.0 {
            match merged.last_mut().filter(|last| last.key() == input.key()) {
                Some(last) => last.slope += input.slope,
                None => merged.push(input),
            }
        }
        merged
    }
}

impl Number {
    /// The same number, worked out from literals; as it was where there are none.
    ///
    /// ```
    /// # use kutzbach_math as kutzbach;
    /// use kutzbach::number::{Inputs, Number, Quantity};
    /// let degrees = Number::decimal("12.3457")?;
    /// let mut inputs = Inputs::default();
    /// inputs.add(Quantity::Angle, &degrees, std::f64::consts::PI / 180.0);
    /// let angle = degrees.radians().derived_from(inputs);
    /// assert!(angle == degrees.radians() && angle.inputs().len() == 1);
    /// # Ok::<(), kutzbach::number::NumberError>(())
    /// ```
    #[must_use]
    pub fn derived_from(self, inputs: Inputs) -> Self {
        let inputs = inputs.merged();
        match inputs.is_empty() {
            true => self,
            false => self.with_inputs(Some(inputs.into())),
        }
    }

    /// The literals that this number was worked out from, each once; none of a literal itself, and of what is exact.
    #[must_use]
    pub fn inputs(&self) -> &[Input] {
        self.0.inputs.as_deref().unwrap_or_default()
    }

    /// The literals behind this number: itself, or those that it was worked out from.
    pub fn literals(&self) -> impl Iterator<Item = &Number> {
        let own = self.inputs().is_empty() && self.written().is_some();
        let inputs = self.inputs().iter().map(|input| &input.literal);
        own.then_some(self).into_iter().chain(inputs)
    }

    pub(super) fn with_inputs(self, inputs: Option<Arc<[Input]>>) -> Self {
        if inputs.is_none() {
            return self;
        }
        let mut inner = Self::build(self.0.form.clone(), self.0.coarsest).0;
        // Nobody else has it yet.
        if let Some(fresh) = Arc::get_mut(&mut inner) {
            fresh.literal = self.0.literal.clone();
            fresh.value = self.0.value.clone();
            fresh.inputs = inputs;
        }
        Self(inner)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn slopes(number: &Number) -> Vec<(Quantity, &str, f64)> {
        let inputs = number.inputs().iter();
        inputs
            .map(|input| {
                let text = input.literal.literal_text().unwrap();
                (input.quantity, text, input.slope)
            })
            .collect()
    }

    #[test]
    fn literals_are_passed_on_and_equal_texts_add_up() {
        let [a, b, again] = ["0.125", "-0.5", "0.125"].map(|text| Number::decimal(text).unwrap());
        let mut inputs = Inputs::default();
        inputs.add(Quantity::Length, &a, 2.0);
        inputs.add(Quantity::Angle, &b, -0.25);
        let first = Number::zero().derived_from(inputs);
        let mut inputs = Inputs::default();
        inputs.add(Quantity::Length, &first, -3.0);
        inputs.add(Quantity::Length, &again, 1.0);
        let second = Number::one().derived_from(inputs);
        assert_eq!(
            slopes(&second),
            [
                (Quantity::Length, "0.125", 7.0),
                (Quantity::Angle, "-0.5", 0.75)
            ]
        );
        assert_eq!(slopes(&-&second), slopes(&second));
        assert_eq!(second, Number::one());
        assert_eq!(second.literals().count(), 2);
    }

    /// A zero that rounding left a lever of a kilometre is none of the literal's; a lever of a nanometre is.
    #[test]
    fn what_rounding_leaves_of_a_zero_is_no_slope() {
        let angle = Number::decimal("0.125").unwrap();
        for (slope, known) in [(1e3 * f64::EPSILON, 0), (1e-9, 1)] {
            let mut inputs = Inputs::default();
            inputs.add(Quantity::Angle, &angle, slope);
            let found = Number::one().derived_from(inputs);
            assert_eq!(found.inputs().len(), known, "{slope:e}");
        }
    }

    #[test]
    fn exact_numbers_have_nothing_to_pass_on() {
        let mut inputs = Inputs::default();
        inputs.add(Quantity::Length, &Number::integer(3), 1.0);
        inputs.add(Quantity::Angle, &Number::pi(), 1.0);
        inputs.add(Quantity::Angle, &Number::decimal("0.3").unwrap(), 0.0);
        inputs.add(Quantity::Angle, &Number::decimal("0.3").unwrap(), f64::NAN);
        assert!(Number::one().derived_from(inputs).inputs().is_empty());
        assert_eq!(Number::one().literals().count(), 0);
        assert_eq!(Number::decimal("0.3").unwrap().literals().count(), 1);
    }

    #[test]
    fn a_constant_that_is_recognised_has_no_digits_and_a_shorter_decimal_keeps_them() {
        let mut inputs = Inputs::default();
        inputs.add(Quantity::Angle, &Number::decimal("0.123457").unwrap(), 1.0);
        let derived = Number::decimal("0.300000000000000")
            .unwrap()
            .derived_from(inputs);
        assert_eq!(derived.literal_text(), Some("0.300000000000000"));
        assert!(derived.read_as(&Number::zero()).inputs().is_empty());
        let shorter = derived.read_as(&Number::decimal("0.3").unwrap());
        assert_eq!(shorter.inputs().len(), 1);
    }
}
