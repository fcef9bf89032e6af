//! Frames one after another, in doubles where digits cannot be kept; these know the literals behind them.

use super::quaternion::{angles_of, of_columns};
use kutzbach_math::number::{Inputs, Number, Quantity, Stated};
use kutzbach_math::space::Rigid;
use kutzbach_model::mechanism::{Frame, Precision};

/// A number in full double precision.
pub(super) fn in_full(value: f64) -> Number {
    Number::decimal(&format!("{value:.15}")).unwrap_or_else(|_| Number::zero())
}

/// A sum that keeps the digits of a number to which nothing is added. Another one is known as well as the digits of both say, which are
/// lengths wherever that counts.
pub(super) fn sum(a: &Number, b: &Number) -> Number {
    match (a.is_zero(), b.is_zero()) {
        (true, _) => b.clone(),
        (_, true) => a.clone(),
        _ => added(Quantity::Length, a, b),
    }
}

/// A coordinate less another one (m), known as well as the digits of both say; of whole numbers it is exact.
pub(super) fn difference(a: &Number, b: &Number) -> Number {
    let is_whole = |x: &Number| x.stated().is_none_or(|own| own.decimals <= 0);
    match is_whole(a) && is_whole(b) {
        true => a - b,
        false => added(Quantity::Length, a, &-b),
    }
}

/// A sum that is known as well as the digits of both say.
pub(super) fn added(quantity: Quantity, a: &Number, b: &Number) -> Number {
    let mut inputs = Inputs::default();
    inputs.add(quantity, a, 1.0);
    inputs.add(quantity, b, 1.0);
    (a + b).derived_from(inputs)
}

/// The middle of two coordinates (m), known as well as the digits of both say.
pub(super) fn middle(a: &Number, b: &Number) -> Number {
    let half = Number::ratio(1, 2).unwrap_or_else(Number::one);
    let mut inputs = Inputs::default();
    inputs.add(Quantity::Length, a, 0.5);
    inputs.add(Quantity::Length, b, 0.5);
    (&(a + b) * &half).derived_from(inputs)
}

/// So many times a number, known so many times as badly; of one in few decimals, which was chosen, it is what one would write.
pub(super) fn multiple(quantity: Quantity, number: &Number, times: usize) -> Number {
    let count = Number::integer(i64::try_from(times).unwrap_or(i64::MAX));
    let product = &count * number;
    if times == 1 || number.is_zero() {
        return number.clone();
    }
    if is_chosen(number) {
        let text = product.decimal_text(Precision::EXACT_DECIMALS.unsigned_abs());
        let written = text.and_then(|text| Number::decimal(&text).ok());
        return written.unwrap_or(product);
    }
    let mut inputs = Inputs::default();
    inputs.add(quantity, number, times as f64);
    product.derived_from(inputs)
}

/// Whether a number has so few decimals that somebody chose it, and it is known exactly.
pub(super) fn is_chosen(number: &Number) -> bool {
    let is_few = |own: Stated| own.decimals <= Precision::EXACT_DECIMALS;
    number.stated().is_none_or(is_few) && number.inputs().is_empty()
}

/// Whether a frame is turned.
pub(super) fn is_turned(frame: &Frame) -> bool {
    frame.roll_pitch_yaw.iter().any(|angle| !angle.is_zero())
}

/// An angle in radians of one in degrees. What is no whole number of them was rounded, and is known as well as its digits say.
pub(super) fn radians_of(degrees: &Number) -> Number {
    let mut inputs = Inputs::default();
    if degrees.rational().is_none_or(|x| !x.is_int()) {
        inputs.add(Quantity::Angle, degrees, 1f64.to_radians());
    }
    degrees.radians().derived_from(inputs)
}

/// A frame in doubles as one that is stated in full.
pub(super) fn frame_of(pose: &Rigid<f64>) -> Frame {
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| pose.rotate(&e));
    Frame {
        position: pose.apply(&[0.0; 3]).map(in_full),
        roll_pitch_yaw: angles_of(of_columns(columns))
            .unwrap_or_else(|| Frame::identity().roll_pitch_yaw),
    }
}

/// A frame in another one. Straight ones add up and keep their digits; after a turn the frame is worked out in doubles that know the
/// literals of both.
pub(super) fn one_after_another(first: &Frame, second: &Frame) -> Frame {
    if second.is_identity() {
        return first.clone();
    }
    if is_turned(first) {
        let found = frame_of(&first.to_doubles().compose(&second.to_doubles()));
        return found.derived_from(Frame::inputs_between(&[], &[first, second]));
    }
    Frame {
        position: [0, 1, 2].map(|i| sum(&first.position[i], &second.position[i])),
        roll_pitch_yaw: second.roll_pitch_yaw.clone(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn known(number: &Number) -> (f64, Vec<(&str, f64)>) {
        let inputs = number.inputs().iter();
        let literals = inputs.map(|own| (own.literal.literal_text().unwrap(), own.slope));
        (number.value(), literals.collect())
    }

    #[test]
    fn middles_and_multiples_know_their_literals() {
        let [a, b, few] = ["0.1234", "0.2345", "0.25"].map(|text| Number::decimal(text).unwrap());
        let between = middle(&a, &b);
        let halves = vec![("0.1234", 0.5), ("0.2345", 0.5)];
        assert_eq!(known(&between), (0.17895, halves));
        let thrice = multiple(Quantity::Length, &a, 3);
        assert_eq!(known(&thrice), (0.3702, vec![("0.1234", 3.0)]));
        // Known as well as what it is a multiple of.
        let twice = multiple(Quantity::Length, &between, 2);
        let ones = vec![("0.1234", 1.0), ("0.2345", 1.0)];
        assert_eq!(known(&twice), (0.3579, ones));
        let chosen = multiple(Quantity::Length, &few, 3);
        assert_eq!(
            (known(&chosen), chosen.literal_text()),
            ((0.75, Vec::new()), Some("0.75"))
        );
        assert_eq!(
            multiple(Quantity::Length, &a, 1).literal_text(),
            Some("0.1234")
        );
        assert!(multiple(Quantity::Length, &a, 0).is_zero());
    }
}
