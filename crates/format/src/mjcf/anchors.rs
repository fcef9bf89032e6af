//! What several `<connect>`s of the same two bodies hold together: a point, the hinge on a line, or everything.
//!
//! Anchors are compared within the digits that they are written with. A coordinate that was rounded is off by up to half a unit of its last
//! place; one with fewer digits than the longest of them was cut of its trailing zeros by its writer, or fits into them, and is known to the
//! last place of all. Anchors of few decimals were chosen and are exact. So a difference of two coordinates is off by up to `u + v`, and a
//! minor `a·d − b·c` of two differences by up to the sum of each factor's size times the doubt of the other, and the product of the doubts.

use crate::frames::difference;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Precision};

/// Anchors nearer to one another than so many times their doubt say no direction that anybody meant.
const CLEAR: f64 = 20.0;

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

/// How far each coordinate may be off.
fn doubts(anchors: &[[Number; 3]]) -> Vec<[f64; 3]> {
    let stated: Vec<_> = anchors
        .iter()
        .flatten()
        .filter_map(Number::stated)
        .collect();
    let finest = stated.iter().map(|stated| stated.decimals).max();
    let longest = stated.iter().map(|stated| stated.significant).max();
    let (Some(finest), Some(longest)) = (finest, longest) else {
        return vec![[0.0; 3]; anchors.len()];
    };
    if finest <= Precision::EXACT_DECIMALS {
        return vec![[0.0; 3]; anchors.len()];
    }
    let doubt = |number: &Number| {
        let own = number.stated().filter(|own| own.significant == longest);
        let places = own.map_or(finest, |own| own.decimals);
        0.5 * 0.1f64.powi(places)
    };
    let of_anchor = |anchor: &[Number; 3]| anchor.each_ref().map(doubt);
    anchors.iter().map(of_anchor).collect()
}

/// What anchors in one body hold together.
pub(super) fn meaning(anchors: &[[Number; 3]]) -> Meaning {
    let off = doubts(anchors);
    let ways: Vec<Way> = (1..anchors.len())
        .map(|i| Way {
            numbers: [0, 1, 2].map(|k| difference(&anchors[i][k], &anchors[0][k])),
            off: [0, 1, 2].map(|k| off[i][k] + off[0][k]),
        })
        .collect();
    let point = |within_digits: bool| Meaning {
        held: Held::Point,
        within_digits,
        is_unclear: false,
    };
    let longest = ways.iter().max_by(|a, b| a.length().total_cmp(&b.length()));
    let Some(longest) = longest.filter(|way| !way.is_none()) else {
        return point(false);
    };
    if ways.iter().all(|way| way.is_none_within(1.0)) {
        return point(true);
    }
    let along: Vec<(bool, bool)> = ways.iter().map(|way| longest.is_along(way)).collect();
    let held = match along.iter().all(|(_, within)| *within) {
        true => Held::Line(Direction(longest.numbers.clone())),
        false => Held::All,
    };
    Meaning {
        within_digits: matches!(held, Held::Line(_)) && along.iter().any(|(exactly, _)| !exactly),
        is_unclear: longest.is_none_within(CLEAR),
        held,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(anchors: &[&str]) -> Meaning {
        let anchors: Vec<[Number; 3]> = anchors
            .iter()
            .map(|text| {
                let numbers: Vec<Number> = text
                    .split(' ')
                    .map(|word| Number::decimal(word).expect("a number"))
                    .collect();
                numbers.try_into().expect("three numbers")
            })
            .collect();
        meaning(&anchors)
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
    fn a_direction_of_a_few_last_places_is_unclear() {
        assert!(of(&["0.123457 0 0", "0.123450 0 0"]).is_unclear);
        assert!(!of(&["0.123457 0 0", "0.123 0 0"]).is_unclear);
    }
}
