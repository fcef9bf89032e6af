//! Where answers change between neighbouring variants, looked for by bisection.

use super::family::{Members, Row};
use super::fraction::Fraction;
use super::outcome::{Outcome, Status};
use super::plan::Plan;
use super::values::Value;
use kutzbach_mobility::Verdict;

/// What has to differ for a border to lie between two variants: whether, and with how many freedoms, they move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    status: Status,
    /// None where nothing beyond the rank was asked.
    verdict: Option<Verdict>,
    /// Finite freedom, or the instantaneous one where nothing beyond the rank was asked.
    freedom: Option<usize>,
}

impl Side {
    /// The side on which an outcome lies.
    #[must_use]
    pub fn of(outcome: &Outcome) -> Self {
        let facts = &outcome.facts;
        Self {
            status: outcome.status,
            verdict: facts.verdict,
            freedom: match facts.verdict {
                Some(_) => facts.finite,
                None => facts.instantaneous,
            },
        }
    }

    /// The same of the columns of a row, by their names; `None` where it is no row.
    pub(super) fn read(column: impl Fn(&str) -> Option<String>) -> Option<Self> {
        let status = Status::from_word(&column("status")?)?;
        let verdict = match column("verdict") {
            Some(word) => Some(Verdict::from_word(&word)?),
            None => None,
        };
        let freedom = match verdict {
            Some(_) => column("finite"),
            None => column("instantaneous"),
        };
        Some(Self {
            status,
            verdict,
            freedom: freedom.and_then(|number| number.parse().ok()),
        })
    }
}

/// Neighbouring variants on different sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Pair {
    /// The number of the first of them.
    index: u64,
    /// The measure in which they differ, counted from 0.
    measure: usize,
    /// Its values in both.
    ends: [Fraction; 2],
    /// The side of the first.
    side: Side,
}

/// All pairs of neighbouring variants whose answers differ. Between those of each, variants are looked at that halve what lies between
/// different answers, so many times. They are rows with numbers after those of the sweep.
///
/// A pair whose values are no fractions of few digits, such as `pi/4`, is left out. Cost: linear in the variants, and a variant for
/// each step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Border {
    pairs: Vec<Pair>,
    steps: u32,
    /// How many variants the sweep has.
    variants: u64,
}

impl Border {
    /// The border of a sweep whose variants lie on these sides, in the order of their numbers; none of a sample.
    #[must_use]
    pub fn new(plan: &Plan, sides: &[Side], steps: u32) -> Self {
        let measures = plan.names().count();
        let mut pairs = Vec::new();
        for (index, side) in (0..).zip(sides) {
            for measure in 0..measures {
                let other = plan.next_along(index, measure);
                let Some(other) = other.filter(|other| {
                    let place = usize::try_from(*other).ok();
                    let across = place.and_then(|place| sides.get(place));
                    across.is_some_and(|across| across != side)
                }) else {
                    continue;
                };
                let [from, to] = [index, other].map(|at| plan.number(at, measure));
                if let (Some(from), Some(to)) = (from, to) {
                    pairs.push(Pair {
                        index,
                        measure,
                        ends: [from, to],
                        side: *side,
                    });
                }
            }
        }
        Self {
            pairs,
            steps,
            variants: plan.count(),
        }
    }

    /// How many pairs there are.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.pairs.len() as u64
    }

    /// The rows between the variants of a pair, counted from 0.
    #[must_use]
    pub fn rows(&self, pair: u64, members: &Members<'_>) -> Vec<Row> {
        let place = usize::try_from(pair).ok();
        let Some(own) = place.and_then(|place| self.pairs.get(place)) else {
            return Vec::new();
        };
        let Some(first) = members.family().plan().values(own.index) else {
            return Vec::new();
        };
        let [mut from, mut to] = own.ends;
        let mut rows = Vec::new();
        for step in 0..self.steps {
            // Where numbers get too long for fractions of integers, the place is known well enough.
            let Some(middle) = Fraction::between(from, to, 1, 2) else {
                break;
            };
            let mut values = first.clone();
            if let Some(value) = values.get_mut(own.measure) {
                *value = Value::exact(middle);
            }
            let outcome = members.verdict(&values);
            match Side::of(&outcome) == own.side {
                true => from = middle,
                false => to = middle,
            }
            let index = self.variants + pair * u64::from(self.steps) + u64::from(step);
            rows.push(Row {
                index,
                values,
                outcome,
            });
        }
        rows
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::family::{Family, MeasuredFile};
    use super::super::plan::Shard;
    use super::super::values::Over;
    use super::*;
    use kutzbach_mobility::{AnalysisOptions, Depth};

    /// A hinge at a place that is a number for lengths of at least 1/3 only.
    const TEXT: &str = r#"<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="a" value="1"/><xacro:property name="b" value="1"/>
  <link name="base"/> <link name="arm"/>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="arm"/><origin xyz="${b*sqrt(a - 1/3)} 0 0"/><axis xyz="0 0 1"/>
  </joint>
</robot>"#;

    #[test]
    fn the_border_is_enclosed_by_halves() {
        let over = ["a=0..1:5", "b=1,2"].map(|one| Over::read(one).unwrap());
        let plan = Plan::new(over.to_vec(), None).unwrap();
        let options = AnalysisOptions {
            depth: Depth::Verdict,
            ..AnalysisOptions::default()
        };
        let family = Family::new(MeasuredFile::of_text(TEXT, "r.urdf"), plan, options).unwrap();
        let rows = family.variants(Shard::default());
        let sides: Vec<Side> = rows.map(|row| Side::of(&row.outcome)).collect();
        let border = Border::new(family.plan(), &sides, 3);
        // Between 1/4 and 1/2, for both values of `b`.
        assert_eq!(border.count(), 2);
        let members = family.members();
        for (pair, index, b) in [(0, 10, "1"), (1, 13, "2")] {
            let rows = border.rows(pair, &members);
            let shown: Vec<[&str; 2]> = rows
                .iter()
                .map(|row| [row.values[0].shown.as_str(), row.values[1].shown.as_str()])
                .collect();
            assert_eq!(shown, [["0.375", b], ["0.3125", b], ["0.34375", b]]);
            let indices: Vec<u64> = rows.iter().map(|row| row.index).collect();
            assert_eq!(indices, [index, index + 1, index + 2]);
            let status: Vec<Status> = rows.iter().map(|row| row.outcome.status).collect();
            let expected = [Status::Analysed, Status::Invalid, Status::Analysed];
            assert_eq!(status, expected);
        }
        assert!(border.rows(2, &members).is_empty());
        assert_eq!(Border::new(family.plan(), &[], 3).count(), 0);
    }
}
