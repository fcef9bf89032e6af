//! Which variants a sweep has: all combinations of values or a sample of them, and shares of the work.

use super::fraction::Fraction;
use super::points::{SOBOL_DIMENSIONS, Sobol, random_parts};
use super::values::{Over, SweepError, Value, WAYS};
use serde::Serialize;
use std::fmt;

/// Points instead of all combinations.
///
/// ```
/// # mod kutzbach { pub use kutzbach_report::sweep; }
/// use kutzbach::sweep::Sample;
///
/// assert_eq!(Sample::read("sobol:1000")?, Sample::Sobol(1000));
/// assert_eq!(Sample::Random(50).to_string(), "random:50");
/// assert!(Sample::read("halton:10").is_err());
/// # Ok::<(), kutzbach::sweep::SweepError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sample {
    /// The first points of a Sobol sequence, which fill the ranges evenly; up to eight measures.
    Sobol(u64),
    /// Pseudo-random points, always the same.
    Random(u64),
}

impl Sample {
    /// Reads `sobol:1000` or `random:1000`.
    ///
    /// # Errors
    /// [`SweepError`] where it is written otherwise.
    pub fn read(written: &str) -> Result<Self, SweepError> {
        let wrong = || {
            SweepError::new(
                format!("needed sobol:N or random:N, found `{written}`"),
                "for example `sobol:1000`",
            )
        };
        let (kind, count) = written.split_once(':').ok_or_else(wrong)?;
        let count: u64 = count.trim().parse().map_err(|_| wrong())?;
        match kind.trim() {
            _ if count == 0 => Err(wrong()),
            // Its points repeat then.
            "sobol" if count <= 1 << 32 => Ok(Self::Sobol(count)),
            "random" => Ok(Self::Random(count)),
            _ => Err(wrong()),
        }
    }

    /// How many points.
    #[must_use]
    pub fn count(self) -> u64 {
        match self {
            Self::Sobol(count) | Self::Random(count) => count,
        }
    }
}

impl fmt::Display for Sample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sobol(count) => write!(f, "sobol:{count}"),
            Self::Random(count) => write!(f, "random:{count}"),
        }
    }
}

/// A share of the variants, for one of several machines: every so-manieth of them, so that all shares take about as long.
///
/// ```
/// # mod kutzbach { pub use kutzbach_report::sweep; }
/// use kutzbach::sweep::Shard;
///
/// let second = Shard::read("2/5")?;
/// let variants: Vec<u64> = (0..second.count(12)).map(|place| second.index(place)).collect();
/// assert_eq!(variants, [1, 6, 11]);
/// # Ok::<(), kutzbach::sweep::SweepError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which share, counted from 1.
    number: u64,
    /// How many shares.
    of: u64,
}

impl Default for Shard {
    /// All of it.
    fn default() -> Self {
        Self { number: 1, of: 1 }
    }
}

impl Shard {
    /// Reads `2/5`.
    ///
    /// # Errors
    /// [`SweepError`] where it is written otherwise, or there is no such share.
    pub fn read(written: &str) -> Result<Self, SweepError> {
        let parsed = written
            .split_once('/')
            .and_then(|(number, of)| {
                let number: u64 = number.trim().parse().ok()?;
                Some(Self {
                    number,
                    of: of.trim().parse().ok()?,
                })
            })
            .filter(|shard| (1..=shard.of).contains(&shard.number));
        parsed.ok_or_else(|| {
            SweepError::new(
                format!("needed the number of a share and how many there are, found `{written}`"),
                "the shares of five are 1/5, 2/5, 3/5, 4/5 and 5/5",
            )
        })
    }

    /// How many of so many variants are in it.
    #[must_use]
    pub fn count(&self, all: u64) -> u64 {
        let first = self.number - 1;
        all.saturating_sub(first).div_ceil(self.of)
    }

    /// The number of the variant at a place of this share; both are counted from 0.
    #[must_use]
    pub fn index(&self, place: u64) -> u64 {
        place
            .saturating_mul(self.of)
            .saturating_add(self.number - 1)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

/// All variants of a sweep, in an order that depends on nothing else: of combinations the last measure changes first.
///
/// ```
/// # mod kutzbach { pub use kutzbach_report::sweep; }
/// use kutzbach::sweep::{Over, Plan};
///
/// let plan = Plan::new(vec![Over::read("a=0..1:3")?, Over::read("b=2,pi/4")?], None)?;
/// assert_eq!(plan.count(), 6);
/// let values = plan.values(3).unwrap();
/// assert_eq!((values[0].shown.as_str(), values[1].shown.as_str()), ("0.5", "pi/4"));
/// assert!(plan.values(6).is_none());
/// # Ok::<(), kutzbach::sweep::SweepError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    over: Vec<Over>,
    sample: Option<Sample>,
    sobol: Option<Sobol>,
    count: u64,
}

/// What was asked, as the first line of the results states it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Asked {
    /// The measures and their values as they were written.
    pub over: Vec<String>,
    /// The sample, if one is taken.
    pub sample: Option<String>,
}

impl Plan {
    /// The combinations of all values, or a sample.
    ///
    /// # Errors
    /// [`SweepError`] where there is no measure, one stands there twice, or there is no telling how many variants there are.
    pub fn new(over: Vec<Over>, sample: Option<Sample>) -> Result<Self, SweepError> {
        if over.is_empty() {
            return Err(SweepError::new("there is no measure to vary", WAYS));
        }
        for (place, one) in over.iter().enumerate() {
            if over.iter().take(place).any(|other| other.name == one.name) {
                return Err(SweepError::new(
                    format!("the measure `{}` is varied twice", one.name),
                    "give all its values at once",
                ));
            }
        }
        let dimensions = over.len();
        let sobol = match sample {
            Some(Sample::Sobol(_)) => Some(Sobol::new(dimensions).ok_or_else(|| {
                SweepError::new(
                    format!("a Sobol sequence of up to {SOBOL_DIMENSIONS} measures is there, found {dimensions}"),
                    "take `random` for more",
                )
            })?),
            _ => None,
        };
        let count = match sample {
            Some(sample) => sample.count(),
            None => combinations(&over)?,
        };
        Ok(Self {
            over,
            sample,
            sobol,
            count,
        })
    }

    /// How many variants there are.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The names of the measures, in their order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.over.iter().map(|over| over.name.as_str())
    }

    /// The values of all measures in a variant, counted from 0; `None` beyond the last one.
    #[must_use]
    pub fn values(&self, index: u64) -> Option<Vec<Value>> {
        if index >= self.count {
            return None;
        }
        if let Some(sample) = self.sample {
            let parts = match (&self.sobol, sample) {
                (Some(sobol), Sample::Sobol(_)) => sobol.parts(index),
                _ => random_parts(index, self.over.len()),
            };
            let values = self.over.iter().zip(parts);
            return values
                .map(|(over, part)| over.values.sampled(part))
                .collect();
        }
        let mut rest = index;
        let mut values = Vec::with_capacity(self.over.len());
        for over in self.over.iter().rev() {
            let count = over.values.count()?.max(1);
            values.push(over.values.at(rest % count)?);
            rest /= count;
        }
        values.reverse();
        Some(values)
    }

    /// The next variant along a measure, counted from 0, all others being as they are; `None` beyond its last value, and of samples.
    #[must_use]
    pub fn next_along(&self, index: u64, measure: usize) -> Option<u64> {
        let (place, stride) = self.place(index, measure)?;
        let next = self.over.get(measure)?.values.count()? > place + 1;
        let index = index.checked_add(stride).filter(|_| next)?;
        (index < self.count).then_some(index)
    }

    /// The value of a measure in a variant as a fraction; `None` where it is none of few digits, and of samples.
    pub(super) fn number(&self, index: u64, measure: usize) -> Option<Fraction> {
        let (place, _) = self.place(index, measure)?;
        self.over.get(measure)?.values.number(place)
    }

    /// Which of its values a measure has in a combination, and how far apart variants are with neighbouring ones.
    fn place(&self, index: u64, measure: usize) -> Option<(u64, u64)> {
        if self.sample.is_some() {
            return None;
        }
        let count = self.over.get(measure)?.values.count()?.max(1);
        let later = self.over.iter().skip(measure + 1);
        let mut stride = 1_u64;
        for over in later {
            stride = stride.checked_mul(over.values.count()?.max(1))?;
        }
        Some(((index / stride) % count, stride))
    }

    /// What was asked.
    #[must_use]
    pub fn asked(&self) -> Asked {
        Asked {
            over: self
                .over
                .iter()
                .map(|over| over.written().to_owned())
                .collect(),
            sample: self.sample.map(|sample| sample.to_string()),
        }
    }
}

/// How many combinations there are.
fn combinations(over: &[Over]) -> Result<u64, SweepError> {
    let mut all = 1_u64;
    for one in over {
        let count = one.values.count().ok_or_else(|| {
            SweepError::new(
                format!("the range of `{}` has no count", one.name),
                format!("write `{}:101`, or take a sample of it", one.written()),
            )
        })?;
        all = all.checked_mul(count).ok_or_else(|| {
            SweepError::new(
                "there are too many combinations to be counted",
                "take a sample of them",
            )
        })?;
    }
    Ok(all)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn plan(over: &[&str], sample: Option<&str>) -> Result<Plan, SweepError> {
        let over = over
            .iter()
            .map(|one| Over::read(one))
            .collect::<Result<_, _>>()?;
        Plan::new(over, sample.map(Sample::read).transpose()?)
    }

    fn shown(plan: &Plan) -> Vec<Vec<String>> {
        (0..plan.count())
            .map(|index| {
                let values = plan.values(index).unwrap();
                values.into_iter().map(|value| value.shown).collect()
            })
            .collect()
    }

    #[test]
    fn the_last_measure_changes_first() {
        let plan = plan(&["a=0..0.01:3", "b=0.1, pi/4"], None).unwrap();
        assert_eq!(
            shown(&plan),
            [
                ["0", "0.1"],
                ["0", "pi/4"],
                ["0.005", "0.1"],
                ["0.005", "pi/4"],
                ["0.01", "0.1"],
                ["0.01", "pi/4"],
            ]
        );
        assert_eq!(plan.values(2).unwrap()[0].setting, "1/200");
        assert_eq!(plan.values(6), None);
        assert_eq!(plan.names().collect::<Vec<_>>(), ["a", "b"]);
    }

    #[test]
    fn neighbours_differ_in_one_measure() {
        let plan = plan(&["a=0..1:2", "b=1,pi,3", "c=0..9:4"], None).unwrap();
        assert_eq!(plan.next_along(0, 2), Some(1));
        assert_eq!(plan.next_along(3, 2), None);
        assert_eq!(plan.next_along(3, 1), Some(7));
        assert_eq!(plan.next_along(8, 1), None);
        assert_eq!(plan.next_along(11, 0), Some(23));
        assert_eq!(plan.next_along(12, 0), None);
        assert_eq!(plan.next_along(0, 3), None);
        for index in 0..plan.count() {
            for measure in 0..3 {
                let Some(next) = plan.next_along(index, measure) else {
                    continue;
                };
                let [one, other] = [index, next].map(|at| plan.values(at).unwrap());
                let differ: Vec<usize> = (0..3).filter(|m| one[*m] != other[*m]).collect();
                assert_eq!(differ, [measure]);
            }
        }
        assert_eq!(plan.number(5, 2), Fraction::read("3"));
        assert_eq!(plan.number(4, 1), None);
        let sampled = super::Plan::new(vec![Over::read("a=0..1").unwrap()], Some(Sample::Sobol(4)));
        assert_eq!(sampled.unwrap().next_along(0, 0), None);
    }

    #[test]
    fn samples_take_ranges_and_lists() {
        let sampled = plan(&["a=1..3", "b=x,y", "c=0..10:11"], Some("sobol:4")).unwrap();
        assert_eq!(
            shown(&sampled),
            [
                ["1", "x", "0"],
                ["2", "y", "5"],
                ["2.5", "x", "2"],
                ["1.5", "y", "8"],
            ]
        );
        let random = plan(&["a=1..3"], Some("random:50")).unwrap();
        let values: Vec<f64> = shown(&random)
            .iter()
            .map(|v| v[0].parse().unwrap())
            .collect();
        assert!(values.iter().all(|x| (1.0..3.0).contains(x)));
        assert_eq!(shown(&random), shown(&random.clone()));
    }

    #[test]
    fn shares_are_the_whole() {
        for of in [1, 2, 5, 40] {
            let mut all: Vec<u64> = (1..=of)
                .flat_map(|number| {
                    let shard = Shard::read(&format!("{number}/{of}")).unwrap();
                    (0..shard.count(17)).map(move |place| shard.index(place))
                })
                .collect();
            all.sort_unstable();
            assert_eq!(all, (0..17).collect::<Vec<u64>>(), "{of}");
        }
    }

    #[test]
    fn what_is_written_otherwise_is_refused() {
        for wrong in ["sobol", "sobol:0", "halton:3", "random:-1"] {
            assert!(Sample::read(wrong).is_err(), "{wrong}");
        }
        for wrong in ["0/2", "3/2", "1", "1/0"] {
            assert!(Shard::read(wrong).is_err(), "{wrong}");
        }
        assert!(plan(&["a=0..1"], None).is_err());
        assert!(plan(&["a=0..1:2", "a=3"], None).is_err());
        assert!(plan(&[], None).is_err());
    }
}
