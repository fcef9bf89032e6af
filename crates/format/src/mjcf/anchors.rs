//! What several `<connect>`s of the same two bodies hold together: a point, the hinge on a line, or everything.
//!
//! Anchors are compared within the digits that they are written with. A coordinate that was rounded is off by up to half a unit of its last
//! place; one with fewer digits than the longest of them was cut of its trailing zeros by its writer, or fits into them, and is known to the
//! last place of all. Anchors of few decimals were chosen and are exact. So a difference of two coordinates is off by up to `u + v`, and a
//! minor `a·d − b·c` of two differences by up to the sum of each factor's size times the doubt of the other, and the product of the doubts.
//!
//! The line through two rounded anchors is known no better than they are. Its direction is half the difference of the two: what `u + v` is of
//! the whole, half a unit of the last place is of the half. Where one coordinate alone differs, the line is along an axis, and exactly so.

use crate::frames::difference;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Precision};

/// Anchors nearer to one another than so many times their doubt say no direction that anybody meant.
const CLEAR: f64 = 20.0;

/// Directions of so many decimals more than anchors have may be printed by one program.
const NEAR: i32 = 3;

/// Anchors that are off by less than this (m) were not rounded: their digits are those that doubles have.
const ROUNDED: f64 = 1e-13;

/// Numbers that were computed in doubles are off by so much of 1 and of their size.
const ROUNDING: f64 = 1e-14;

/// Numbers of so many decimals at most are not the print of a double.
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

/// The way from the first anchor to another one, and how far each part of it may be off.
struct Way {
    numbers: [Number; 3],
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

    /// The direction, stated as well as its anchors are, in as many decimals as the file's directions have.
    fn direction(&self, of_directions: i32) -> Direction {
        let apart = self.numbers.iter().filter(|part| !part.is_zero()).count();
        let chosen = u32::try_from(Precision::EXACT_DECIMALS).unwrap_or(0);
        let is_chosen = |part: &Number| part.decimal_text(chosen).is_some();
        // What was worked out from literals knows these.
        let is_worked_out = self.numbers.iter().any(|part| !part.inputs().is_empty());
        let is_exact = self.off.iter().all(|off| *off < ROUNDED) || is_worked_out;
        let half = Number::ratio(1, 2).filter(|_| apart > 1 && !is_exact);
        let (Some(half), false) = (half, self.numbers.iter().all(is_chosen)) else {
            return Direction(self.numbers.clone());
        };
        // A difference of this doubt states so many decimals, when it is halved.
        let decimals = self.off.map(|off| {
            let decimals = (1e-9 - off.log10()).floor() as i32;
            (off > 0.0).then_some(decimals)
        });
        let finest = decimals.into_iter().flatten().max().unwrap_or(0);
        // Directions have any length: this one gets that with which it has as many decimals as the others. Much longer ones are by another hand.
        let more = match of_directions.saturating_sub(finest) {
            more if of_directions > Precision::EXACT_DECIMALS && more <= NEAR => more.max(-20),
            _ => 0,
        };
        let scale = Number::decimal(&format!("1e{}", -more)).unwrap_or_else(|_| Number::one());
        let scale = &scale * &half;
        Direction([0, 1, 2].map(|i| {
            let part = &self.numbers[i] * &scale;
            match decimals[i].filter(|_| !part.is_zero()) {
                Some(decimals) => part.stating(decimals + more),
                None => part,
            }
        }))
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

/// A coordinate of the way from one anchor to another. What a frame was composed of keeps the literals behind it.
fn apart(from: &Number, to: &Number) -> Number {
    match from.inputs().is_empty() && to.inputs().is_empty() {
        true => to - from,
        false => difference(to, from),
    }
}

/// How far each coordinate may be off.
pub(super) fn doubts(anchors: &[[Number; 3]]) -> Vec<[f64; 3]> {
    let all = || anchors.iter().flatten();
    let decimals = |number: &Number| match number.stated() {
        Some(stated) => Some(stated.decimals),
        None => number.coarsest_input(),
    };
    let finest = all().filter_map(decimals).max();
    let finest = finest.filter(|most| *most > Precision::EXACT_DECIMALS);
    let longest = all().filter_map(Number::stated).map(|own| own.significant);
    let longest = longest.max().unwrap_or(0);
    let doubt = |number: &Number| {
        let by_digits = finest.map_or(0.0, |finest| {
            let own = number.stated().filter(|own| own.significant == longest);
            0.5 * 0.1f64.powi(own.map_or(finest, |own| own.decimals))
        });
        match number.decimal_text(SHORT) {
            Some(_) => by_digits,
            None => by_digits.max(ROUNDING * (1.0 + number.value().abs())),
        }
    };
    let of_anchor = |anchor: &[Number; 3]| anchor.each_ref().map(doubt);
    anchors.iter().map(of_anchor).collect()
}

/// What anchors in one body hold together, beside directions of the file that have at most so many decimals.
pub(super) fn meaning(anchors: &[[Number; 3]], of_directions: i32) -> Meaning {
    let off = doubts(anchors);
    let ways: Vec<Way> = (1..anchors.len())
        .map(|i| Way {
            numbers: [0, 1, 2].map(|k| apart(&anchors[0][k], &anchors[i][k])),
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
        true => Held::Line(longest.direction(of_directions)),
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

    fn of_all(anchors: &[&str], of_directions: i32) -> Meaning {
        meaning(&points(anchors), of_directions)
    }

    fn of(anchors: &[&str]) -> Meaning {
        of_all(anchors, 0)
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
        let direction =
            |anchors: &[&str], of_directions: i32| match of_all(anchors, of_directions).held {
                Held::Line(direction) => direction.0.map(|part| {
                    let stated = part
                        .stated()
                        .map(|stated| (stated.decimals, stated.significant));
                    (part.value(), stated)
                }),
                other => panic!("{other:?}"),
            };
        let rounded = ["0.1234 0.2 0.4321", "0.1501 0.2 0.4678"];
        let expected = [
            (0.01335, Some((4, 3))),
            (0.0, None),
            (0.01785, Some((4, 3))),
        ];
        assert_eq!(direction(&rounded, 0), expected);
        assert_eq!(direction(&rounded, 4), expected);
        let longer = [
            (0.001335, Some((5, 3))),
            (0.0, None),
            (0.001785, Some((5, 3))),
        ];
        assert_eq!(direction(&rounded, 5), longer);
        let shorter = [(0.1335, Some((3, 3))), (0.0, None), (0.1785, Some((3, 3)))];
        assert_eq!(direction(&rounded, 3), shorter);
        assert_eq!(direction(&rounded, 15), expected);
        let in_full = ["0 0 0", "0.12345678901234 0.3 0"];
        let expected = [(0.12345678901234, None), (0.3, None), (0.0, None)];
        assert_eq!(direction(&in_full, 3), expected);
        // Along an axis, and by numbers that somebody chose, it is what is written.
        let along = ["0.123456 0.2 0.3", "0.123456 0.2 0.4"];
        assert_eq!(
            direction(&along, 6),
            [(0.0, None), (0.0, None), (0.1, None)]
        );
        let chosen = ["0.125 0.25 0", "0.125 0.28 0.04"];
        assert_eq!(
            direction(&chosen, 0),
            [(0.0, None), (0.03, None), (0.04, None)]
        );
    }

    #[test]
    fn a_direction_of_a_few_last_places_is_unclear() {
        assert!(of(&["0.123457 0 0", "0.123450 0 0"]).is_unclear);
        assert!(!of(&["0.123457 0 0", "0.123 0 0"]).is_unclear);
    }
}
