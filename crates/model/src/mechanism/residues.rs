//! Residues: what a program's rounding left of a zero, such as `3e-06` among whole millimetres.
//!
//! A program that rounds to six or eight decimals and prints the shortest form leaves these where another rounding came before. They
//! are read as 0, and told of. In an independent sub-mechanism, among the literals of one kind (lengths, angles, components of
//! directions), a literal `x` is a residue if
//!
//! - it is at most [`SMALL`] of the shortest step between two places (angles: of a radian; directions: of their largest component);
//! - it is below the last decimal that any of the others states, and has fewer significant digits than the longest of them, or two at
//!   most: it belongs to no finer measure (`-6.49546056790647e-06` among full doubles is one);
//! - a program wrote it, with an exponent (`3e-06`, which nobody types for a measure), or it is below [`NOBODYS`];
//! - it is not so small that nothing but somebody's choice writes it in so few digits ([`CHOSEN`]).
//!
//! Or it is what single precision makes of a zero: a single-precision number by its digits, and no larger than the rounding of the
//! largest. Where some other number is an expression, somebody wrote the file by hand: nothing is read as a residue.

use super::joint::Joint;
use super::model::Mechanism;
use super::number_style::is_print_of_single;
use kutzbach_math::number::Number;

/// The largest residue, relative to the shortest step: 25 µm beside five centimetres.
const SMALL: f64 = 5e-4;

/// Programs print numbers below this with an exponent, where they choose the form (m, rad).
const PRINTED: f64 = 1e-4;

/// No measure of a machine is so small (m, rad), however it is written.
const NOBODYS: f64 = 1e-5;

/// Programs round to ten decimals at most before they leave a few digits of a zero.
const CHOSEN: f64 = 1e-10;

/// Residues may have so many significant digits whatever the others have.
const FEW: u32 = 2;

/// The rounding of single precision, twice, relative to the largest number.
const SINGLE: f64 = 1.0 / (1u64 << 23) as f64;

/// The literals of one sub-mechanism that are residues: (joint, place in [`Joint::numbers`]).
pub(super) fn residues(mechanism: &Mechanism, joints: &[usize]) -> Vec<(usize, usize)> {
    let mut kinds: [Vec<Literal<'_>>; 3] = Default::default();
    for &joint in joints {
        let numbers = mechanism.joints()[joint].numbers();
        for (place, number) in numbers.into_iter().enumerate() {
            let Some(number) = number.filter(|number| !number.is_zero()) else {
                continue;
            };
            if number.literal_text().is_none() && number.rational() != Number::one().rational() {
                return Vec::new();
            }
            let value = number.value().abs();
            kinds[Joint::kind_of_number(place)].push(Literal {
                at: (joint, place),
                number,
                value,
            });
        }
    }
    let [lengths, angles, directions] = &kinds;
    let mut found = among(lengths, None);
    found.extend(among(angles, Some(1.0)));
    for at in directions.chunk_by(|a, b| a.at.0 == b.at.0 && a.at.1 / 3 == b.at.1 / 3) {
        let largest = at.iter().map(|literal| literal.value).fold(0.0, f64::max);
        found.extend(among(at, Some(largest)));
    }
    found.sort_unstable();
    found
}

struct Literal<'a> {
    at: (usize, usize),
    number: &'a Number,
    value: f64,
}

/// The residues of some literals, beside measures of a size if that does not come from the others.
fn among(literals: &[Literal<'_>], measure: Option<f64>) -> Vec<(usize, usize)> {
    let (small, others): (Vec<&Literal<'_>>, Vec<&Literal<'_>>) =
        literals.iter().partition(|literal| literal.may_be_one());
    let shortest = shortest(&others);
    let largest = others.iter().map(|o| o.value).fold(0.0, f64::max);
    // A single one among zeros alone is held against what no machine is smaller than.
    let measure = measure.or((others.is_empty() && small.len() == 1).then_some(NOBODYS / SMALL));
    let (shortest, largest) = measure.map_or((shortest, largest), |size| (size, size));
    let stated = || others.iter().filter_map(|other| other.number.stated());
    let decimals = stated().map(|s| s.decimals).max().unwrap_or(0);
    let last_stated = 0.1f64.powi(decimals);
    let significant = stated().map(|s| s.significant).max().unwrap_or(0);
    let is_one = |literal: &&&Literal<'_>| {
        let Some(written) = literal.number.stated() else {
            return false;
        };
        let coarse = written.significant <= FEW || written.significant < significant;
        let no_measure = written.decimals > decimals && literal.value < last_stated && coarse;
        let of_single = literal.value <= SINGLE * largest && is_print_of_single(literal.number);
        shortest.is_finite()
            && literal.value <= SMALL * shortest
            && literal.value >= CHOSEN
            && (no_measure || of_single)
    };
    small
        .iter()
        .filter(is_one)
        .map(|literal| literal.at)
        .collect()
}

/// The shortest of the steps that some lengths are coordinates of, which says how small the mechanism is: a coordinate may be short by
/// chance.
fn shortest(literals: &[&Literal<'_>]) -> f64 {
    let steps = literals.chunk_by(|a, b| a.at.0 == b.at.0 && a.at.1 / 3 == b.at.1 / 3);
    let length = |step: &[&Literal<'_>]| step.iter().map(|x| x.value * x.value).sum::<f64>().sqrt();
    steps.map(length).fold(f64::INFINITY, f64::min)
}

impl Literal<'_> {
    /// Whether it looks like a residue, for itself.
    fn may_be_one(&self) -> bool {
        let text = self.number.literal_text().unwrap_or_default();
        let by_program = text.contains("e-0") || text.contains("e-1") || text.contains("E-");
        self.number.stated().is_some()
            && self.value < PRINTED
            && (by_program || self.value < NOBODYS)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::{Frame, JointBuilder, JointKind, MechanismBuilder};

    /// What is read as 0 of the lengths of a loop.
    fn read(texts: &[&str]) -> Vec<String> {
        let mut builder = MechanismBuilder::new("loop");
        builder.link("0");
        let [mut last, mut count] = [0, 0];
        for point in texts.chunks(3) {
            let at = [0, 1, 2].map(|i| match point.get(i) {
                Some(text) => super::Number::decimal(text).unwrap(),
                None => super::Number::zero(),
            });
            (last, count) = (count, count + 1);
            builder.link(&count.to_string());
            let [parent, child] = [last, count].map(|link: usize| link.to_string());
            builder.joint(
                JointBuilder::tree(&format!("j{count}"), JointKind::Fixed, &parent, &child)
                    .origin(Frame::at(at)),
            );
            last = count;
        }
        let end = last.to_string();
        builder.joint(JointBuilder::closing("k", JointKind::Fixed, "0", &end));
        let mechanism = builder.build().unwrap().with_constants();
        let residues = mechanism.recognised().residues.iter();
        residues.map(|residue| residue.text.clone()).collect()
    }

    #[test]
    fn a_residue_among_short_numbers_is_one() {
        for text in [
            "9.000000000000001e-09",
            "3e-06",
            "-7e-06",
            "1.2e-05",
            "1e-09",
            "0.000003",
            "9e-6",
        ] {
            assert_eq!(read(&["0.1", "0.212", text, "0.3"]), [text], "{text}");
        }
        assert_eq!(read(&["0", "3e-06", "0"]), ["3e-06"]);
        let single = "-4.371138828673793e-08";
        assert_eq!(read(&["0.5", single, "1"]), [single]);
        // A short coordinate of a long step.
        assert_eq!(
            read(&["0.567", "-0.008", "5e-06", "0.2", "0.3", "0"]),
            ["5e-06"]
        );
    }

    #[test]
    fn what_may_be_a_measure_is_none() {
        for texts in [
            // Too large beside the shortest; as many decimals as others; with digits of its own; typed; chosen.
            &["0.1", "0", "0", "0.3", "9e-05"][..],
            &["0.123456", "0.3", "3e-06"],
            &["0.1", "0.2", "1.2345e-06"],
            &["0.5", "0.3", "0.00004"],
            &["1", "2", "1e-12"],
            // Full doubles, and a hinge that is 19 µm off.
            &[
                "0.8526965340923640",
                "1.638285576344882",
                "-6.49546056790647e-06",
                "-1.7846131239122066e-05",
                "0.45663720015193987",
            ],
            &["0.12345678", "1.638285576344882", "6.4955e-06"],
            // A mechanism of micrometres.
            &["3e-06", "5e-06", "0", "2e-06"],
        ] {
            assert!(read(texts).is_empty(), "{texts:?}");
        }
    }
}
