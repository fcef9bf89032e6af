//! What several `<connect>`s of the same two bodies hold together: a point, the hinge on a line, or everything.
//!
//! Anchors are compared within the digits that they are written with. A coordinate that was rounded is off by up to half a unit of its last
//! place; one with fewer digits than the longest of them was cut of its trailing zeros by its writer, or fits into them, and is known to the
//! last place of all. Anchors of few decimals were chosen and are exact. One that was worked out from literals is off by what these are, each times its
//! slope. So a difference of two coordinates is off by up to `u + v`, and a minor `a·d − b·c` of two differences by up to the sum of each factor's size times
//! the doubt of the other, and the product of the doubts.
//!
//! The line through two rounded anchors is known no better than they are: its direction is their difference, which knows the literals of both. Where one
//! coordinate alone differs, the line is along an axis, and exactly so.

use crate::frames::difference;
use kutzbach_math::number::{Number, Quantity};
use kutzbach_model::mechanism::{Direction, Precision};
use std::collections::BTreeMap;

/// Anchors nearer to one another than so many times their doubt say no direction that anybody meant: it may be off by a twentieth, three degrees.
const CLEAR: f64 = 20.0;

/// Numbers that were computed in doubles are off by so much of 1 and of their size: some fifty roundings.
const ROUNDING: f64 = 1e-14;

/// Numbers of so many decimals at most are not the print of a double, which has fifteen ([`in_full`](crate::frames::in_full)).
const SHORT: u32 = 14;

/// What anchors hold.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Held {
    /// One point.
    Point,
    /// A line, the axis of a hinge.
    Line(Direction),
    /// Everything: they are not on one line.
    All,
}

/// What anchors hold, and how sure that is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Meaning {
    pub(super) held: Held,
    /// Whether it is so within the digits only: as they are written, anchors differ or are not on a line.
    pub(super) within_digits: bool,
    /// Whether the anchors are so near to one another that their direction may be noise.
    pub(super) is_unclear: bool,
    /// Index of the anchor that is farthest from the first one.
    pub(super) farthest: usize,
}

/// The way from the first anchor to another one, as numbers that know the literals behind them, and how far each part of it may be off.
struct Way {
    numbers: [Number; 3],
    /// The same without the literals.
    plain: [Number; 3],
    off: [f64; 3],
}

impl Way {
    fn length(&self) -> f64 {
        self.values().iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    fn values(&self) -> [f64; 3] {
        self.numbers.each_ref().map(Number::value)
    }

    fn is_none_within(&self, times: f64) -> bool {
        let values = self.values();
        (0..3).all(|i| values[i].abs() <= times * self.off[i])
    }

    fn is_none(&self) -> bool {
        self.numbers.iter().all(Number::is_zero)
    }

    /// The direction: known as well as its anchors are, and exactly where they were chosen.
    fn direction(&self) -> Direction {
        let literals = self.numbers.iter().flat_map(literals);
        let mut stated = literals.filter_map(|(_, literal, _)| literal.stated());
        match stated.all(|own| own.decimals <= Precision::EXACT_DECIMALS) {
            true => Direction(self.plain.clone()),
            false => Direction(self.numbers.clone()),
        }
    }

    /// Whether both are on one line: as written, and within their digits.
    fn is_along(&self, other: &Self) -> (bool, bool) {
        let (a, b) = (self.values(), other.values());
        let (u, v) = (self.off, other.off);
        let minors = [(1, 2), (2, 0), (0, 1)];
        let exactly = minors.iter().all(|&(j, k)| {
            let (x, y) = (&self.numbers, &other.numbers);
            (&(&x[j] * &y[k]) - &(&x[k] * &y[j])).is_zero()
        });
        let within = minors.iter().all(|&(j, k)| {
            let doubt = |i: usize, l: usize| a[i].abs() * v[l] + b[l].abs() * u[i] + u[i] * v[l];
            (a[j] * b[k] - a[k] * b[j]).abs() <= doubt(j, k) + doubt(k, j)
        });
        (exactly, exactly || within)
    }
}

/// A coordinate of the way from one anchor to another. One number is rounded once.
fn apart(from: &Number, to: &Number) -> Number {
    match from == to {
        true => Number::zero(),
        false => difference(to, from),
    }
}

/// Most decimals and most significant digits of the literals of one quantity.
type Digits = BTreeMap<Quantity, (i32, u32)>;

/// The literals behind a coordinate: what each measures, the literal, and how much of its doubt the coordinate has.
fn literals(number: &Number) -> Vec<(Quantity, &Number, f64)> {
    match number.inputs() {
        [] => vec![(Quantity::Length, number, 1.0)],
        inputs => {
            let all = inputs.iter();
            all.map(|own| (own.quantity, &own.literal, own.slope))
                .collect()
        }
    }
}

/// How far each coordinate may be off.
pub(super) fn doubts(anchors: &[[Number; 3]]) -> Vec<[f64; 3]> {
    let mut digits = Digits::new();
    for (quantity, literal, _) in anchors.iter().flatten().flat_map(literals) {
        if let Some(own) = literal.stated() {
            let (decimals, significant) = digits.entry(quantity).or_insert((0, 0));
            *decimals = own.decimals.max(*decimals);
            *significant = own.significant.max(*significant);
        }
    }
    let of_literal = |(quantity, literal, slope): (Quantity, &Number, f64)| {
        let finest = digits.get(&quantity);
        let Some((finest, longest)) = finest.filter(|(most, _)| *most > Precision::EXACT_DECIMALS)
        else {
            return 0.0;
        };
        let own = literal.stated().filter(|own| own.significant == *longest);
        slope * 0.5 * 0.1f64.powi(own.map_or(*finest, |own| own.decimals))
    };
    let doubt = |number: &Number| {
        let by_digits: f64 = literals(number).into_iter().map(of_literal).sum();
        match number.decimal_text(SHORT) {
            Some(_) => by_digits,
            None => by_digits.max(ROUNDING * (1.0 + number.value().abs())),
        }
    };
    let of_anchor = |anchor: &[Number; 3]| anchor.each_ref().map(doubt);
    anchors.iter().map(of_anchor).collect()
}

/// What anchors in one body hold together.
pub(super) fn meaning(anchors: &[[Number; 3]]) -> Meaning {
    let off = doubts(anchors);
    let ways: Vec<Way> = (1..anchors.len())
        .map(|i| Way {
            numbers: [0, 1, 2].map(|k| apart(&anchors[0][k], &anchors[i][k])),
            plain: [0, 1, 2].map(|k| &anchors[i][k] - &anchors[0][k]),
            off: [0, 1, 2].map(|k| match anchors[i][k] == anchors[0][k] {
                // One number is rounded once.
                true => 0.0,
                false => off[i][k] + off[0][k],
            }),
        })
        .collect();
    let point = |within_digits: bool| Meaning {
        held: Held::Point,
        within_digits,
        is_unclear: false,
        farthest: 0,
    };
    let longest = ways.iter().enumerate();
    let longest = longest.max_by(|(_, a), (_, b)| a.length().total_cmp(&b.length()));
    let Some((index, longest)) = longest.filter(|(_, way)| !way.is_none()) else {
        return point(false);
    };
    if ways.iter().all(|way| way.is_none_within(1.0)) {
        return point(true);
    }
    let along: Vec<(bool, bool)> = ways.iter().map(|way| longest.is_along(way)).collect();
    let held = match along.iter().all(|(_, within)| *within) {
        true => Held::Line(longest.direction()),
        false => Held::All,
    };
    Meaning {
        within_digits: matches!(held, Held::Line(_)) && along.iter().any(|(exactly, _)| !exactly),
        is_unclear: longest.is_none_within(CLEAR),
        farthest: index + 1,
        held,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(anchors: &[&str]) -> Vec<[Number; 3]> {
        anchors
            .iter()
            .map(|text| {
                let numbers: Vec<Number> = text
                    .split(' ')
                    .map(|word| Number::decimal(word).expect("a number"))
                    .collect();
                numbers.try_into().expect("three numbers")
            })
            .collect()
    }

    fn of(anchors: &[&str]) -> Meaning {
        meaning(&points(anchors))
    }

    fn word(anchors: &[&str]) -> (&'static str, bool) {
        let found = of(anchors);
        let word = match found.held {
            Held::Point => "point",
            Held::Line(_) => "line",
            Held::All => "all",
        };
        (word, found.within_digits)
    }

    #[test]
    fn anchors_are_compared_within_their_digits() {
        for (anchors, expected) in [
            (&["0 0 0"][..], ("point", false)),
            (&["0.1 0 0", "0.1 0 0"], ("point", false)),
            (&["0.123457 0 0", "0.123456 0 0"], ("point", true)),
            (&["0.123457 0 0", "0.123447 0 0"], ("line", false)),
            (&["0 0 -0.05", "0 0 0.05"], ("line", false)),
            (&["0.1 0 0", "0.2 0 0", "0.3 0 0"], ("line", false)),
            // A third of the way, in six decimals.
            (
                &[
                    "0 0 0",
                    "0.100000 0.200000 0.300000",
                    "0.033333 0.066667 0.1",
                ],
                ("line", true),
            ),
            (
                &[
                    "0 0 0",
                    "0.100000 0.200000 0.300000",
                    "0.033333 0.066677 0.1",
                ],
                ("all", false),
            ),
            // Six digits of each number, so fewer decimals of the larger ones.
            (
                &["0 0 0", "1.33333 2.66667 0", "0.666667 1.33333 0"],
                ("line", true),
            ),
            (&["0 0 0", "1 0 0", "0 1 0"], ("all", false)),
            // Few decimals are chosen: a centimetre beside the line is meant.
            (&["0 0 0", "0.1 0 0", "0.2 0.01 0"], ("all", false)),
        ] {
            assert_eq!(word(anchors), expected, "{anchors:?}");
        }
    }

    #[test]
    fn a_direction_is_known_as_well_as_its_anchors() {
        let direction = |anchors: &[&str]| match of(anchors).held {
            Held::Line(direction) => direction.0.map(|part| {
                let inputs = part.inputs().iter();
                let literals = inputs.map(|own| {
                    let text = own.literal.literal_text().unwrap_or_default();
                    assert_eq!((own.quantity, own.slope), (Quantity::Length, 1.0));
                    text.trim_start_matches('-').to_owned()
                });
                (part.value(), literals.collect::<Vec<String>>())
            }),
            other => panic!("{other:?}"),
        };
        let of_literals = |value: f64, literals: &[&str]| {
            let owned = literals.iter().map(|text| (*text).to_owned());
            (value, owned.collect::<Vec<String>>())
        };
        let mut found = direction(&["0.1234 0.2 0.4321", "0.1501 0.2 0.4678"]);
        found.iter_mut().for_each(|(_, literals)| literals.sort());
        let expected = [
            of_literals(0.0267, &["0.1234", "0.1501"]),
            of_literals(0.0, &[]),
            of_literals(0.0357, &["0.4321", "0.4678"]),
        ];
        assert_eq!(found, expected);
        // Numbers that somebody chose are what they are.
        let chosen = [0.0, 0.03, 0.04].map(|value| of_literals(value, &[]));
        assert_eq!(direction(&["0.125 0.25 0", "0.125 0.28 0.04"]), chosen);
        let along = [0.0, 0.0, 0.1].map(|value| of_literals(value, &[]));
        assert_eq!(direction(&["0.123456 0.2 0.3", "0.123456 0.2 0.4"]), along);
    }

    /// A coordinate that is twice a literal, and three times another one, is off by what these are.
    #[test]
    fn coordinates_that_are_worked_out_are_as_doubtful_as_their_literals() {
        let number = |text: &str| Number::decimal(text).expect("a number");
        let worked_out = |angle: &str| {
            let mut inputs = kutzbach_math::number::Inputs::default();
            inputs.add(Quantity::Length, &number("0.1234"), 2.0);
            inputs.add(Quantity::Angle, &number(angle), 3.0);
            number("0.123456789012345").derived_from(inputs)
        };
        let zero = Number::zero;
        for (angle, expected) in [("0.123457", 1e-4 + 1.5e-6), ("0.25", 1e-4)] {
            let anchors = [[worked_out(angle), zero(), zero()]];
            let found = doubts(&anchors)[0];
            // A zero is known to the last place of all.
            let expected = [expected, 0.5e-4, 0.5e-4];
            assert!(
                found
                    .iter()
                    .zip(expected)
                    .all(|(off, own)| (off / own - 1.0).abs() < 1e-9),
                "{found:?}"
            );
        }
    }

    #[test]
    fn computed_doubles_are_off_by_their_roundings() {
        let off = |text: &str| doubts(&points(&[text]))[0][0];
        // Fifteen decimals are the print of a double; fourteen are somebody's digits.
        assert!((off("0.123456789012345 0 0") - 1.123456789012345e-14).abs() < 1e-20);
        assert!((off("0.12345678901234 0 0") - 0.5e-14).abs() < 1e-20);
    }

    #[test]
    fn a_direction_of_a_few_last_places_is_unclear() {
        // Twenty times the doubt of both, a millionth.
        assert!(of(&["0.123457 0 0", "0.123438 0 0"]).is_unclear);
        assert!(!of(&["0.123457 0 0", "0.123436 0 0"]).is_unclear);
        assert!(!of(&["0.123457 0 0", "0.123 0 0"]).is_unclear);
    }
}
