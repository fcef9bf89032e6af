//! Values of measures: lists, and ranges in exact steps.

use super::fraction::Fraction;
use super::points::PARTS;
use thiserror::Error;

/// What is wrong with a sweep as it is asked for.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct SweepError {
    /// What was needed and what was found.
    pub message: String,
    /// How to mend it.
    pub help: String,
}

impl SweepError {
    pub(super) fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: help.into(),
        }
    }
}

/// The value of a measure in one variant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Value {
    /// As it is shown: a short decimal where there is one, as `0.005`.
    pub shown: String,
    /// As the file is given it: exact, as `1/200`.
    pub setting: String,
    /// Whether what is shown is a decimal number.
    pub is_decimal: bool,
}

impl Value {
    pub(super) fn exact(number: Fraction) -> Self {
        Self {
            shown: number.to_string(),
            setting: number.expression(),
            is_decimal: number.decimal().is_some(),
        }
    }

    /// A number is exact; anything else is an expression for the file's reader to judge.
    fn read(written: &str) -> Self {
        match Fraction::read(written) {
            Some(number) => Self::exact(number),
            None => Self {
                shown: written.to_owned(),
                setting: written.to_owned(),
                is_decimal: false,
            },
        }
    }
}

/// Numbers from one to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    from: Fraction,
    to: Fraction,
    /// Steps and one more; none where only samples are taken.
    count: Option<u64>,
}

/// The values that a measure takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Values {
    /// These, in this order.
    List(Vec<Value>),
    /// Those of a range.
    Range(Range),
}

/// Most values of one range; more combinations than that are several measures, or samples.
const MOST_STEPS: u64 = 1_000_000_000;

impl Values {
    /// How many there are; none where they are a range without a count.
    #[must_use]
    pub fn count(&self) -> Option<u64> {
        match self {
            Self::List(values) => Some(values.len() as u64),
            Self::Range(range) => range.count,
        }
    }

    /// One of them, counted from 0.
    pub(super) fn at(&self, index: u64) -> Option<Value> {
        match self {
            Self::List(values) => values.get(usize::try_from(index).ok()?).cloned(),
            Self::Range(range) => range.at(index).map(Value::exact),
        }
    }

    /// One of them as a fraction; `None` where it is none of few digits.
    pub(super) fn number(&self, index: u64) -> Option<Fraction> {
        match self {
            Self::List(values) => {
                let value = values.get(usize::try_from(index).ok()?)?;
                Fraction::read(&value.setting)
            }
            Self::Range(range) => range.at(index),
        }
    }

    /// The value at a coordinate of a sample point, in parts of [`PARTS`]: of a list or of a range with a count one of their values.
    pub(super) fn sampled(&self, part: u64) -> Option<Value> {
        match (self, self.count()) {
            (Self::Range(range), None) => {
                Fraction::between(range.from, range.to, part, PARTS).map(Value::exact)
            }
            (_, count) => {
                let place = u128::from(part) * u128::from(count?) / u128::from(PARTS);
                self.at(u64::try_from(place).ok()?)
            }
        }
    }
}

impl Range {
    fn at(&self, index: u64) -> Option<Fraction> {
        match self.count? {
            1 => (index == 0).then_some(self.from),
            count => Fraction::between(self.from, self.to, index, count - 1),
        }
    }
}

/// A measure and the values that it takes.
///
/// ```
/// # mod kutzbach { pub use kutzbach_report::sweep; }
/// use kutzbach::sweep::Over;
///
/// let over = Over::read("a = 0..2:401")?;
/// assert_eq!((over.name.as_str(), over.values.count()), ("a", Some(401)));
/// // A range without a count is one for samples.
/// assert_eq!(Over::read("a=0..2")?.values.count(), None);
/// assert!(Over::read("a").is_err());
/// # Ok::<(), kutzbach::sweep::SweepError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Over {
    /// The name of the measure.
    pub name: String,
    /// Its values.
    pub values: Values,
    /// As it was written.
    written: String,
}

/// How ranges are written.
pub(super) const WAYS: &str =
    "write it as name=from..to:count or name=value,value, for example `a=0..2:401` or `b=0.1,pi/4`";

impl Over {
    /// Reads `a=0..2:401`, `a=0..2` or `b=0.1,pi/4`. Numbers are exact, whatever their digits.
    ///
    /// # Errors
    /// [`SweepError`] where it is written otherwise.
    pub fn read(written: &str) -> Result<Self, SweepError> {
        let wrong = |message: String| SweepError::new(message, WAYS);
        let (name, values) = written
            .split_once('=')
            .map(|(name, values)| (name.trim(), values.trim()))
            .filter(|(name, values)| !name.is_empty() && !values.is_empty())
            .ok_or_else(|| {
                wrong(format!(
                    "needed the name of a measure and its values, found `{written}`"
                ))
            })?;
        let values = match values.split_once("..") {
            Some((from, rest)) => Values::Range(range(from, rest, written)?),
            None => {
                let all: Vec<Value> = split_outside_brackets(values)
                    .into_iter()
                    .map(|value| Value::read(value.trim()))
                    .collect();
                if all.iter().any(|value| value.setting.is_empty()) {
                    return Err(wrong(format!("a value is missing in `{written}`")));
                }
                Values::List(all)
            }
        };
        Ok(Self {
            name: name.to_owned(),
            values,
            written: format!("{name}={}", written_values(written)),
        })
    }

    /// The whole as it was written, without space around its parts.
    #[must_use]
    pub fn written(&self) -> &str {
        &self.written
    }
}

/// What stands after the first `=`, without space around it.
fn written_values(written: &str) -> &str {
    written
        .split_once('=')
        .map_or(written, |(_, values)| values.trim())
}

/// Commas inside brackets belong to a function, as in `atan2(1, 2)`.
fn split_outside_brackets(values: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let (mut depth, mut start) = (0_i64, 0);
    for (at, c) in values.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            ',' if depth <= 0 => {
                pieces.push(values.get(start..at).unwrap_or_default());
                start = at + 1;
            }
            _ => {}
        }
    }
    pieces.push(values.get(start..).unwrap_or_default());
    pieces
}

fn range(from: &str, rest: &str, written: &str) -> Result<Range, SweepError> {
    let wrong = |message: String| SweepError::new(message, WAYS);
    let (to, count) = match rest.rsplit_once(':') {
        Some((to, count)) => (to, Some(count.trim())),
        None => (rest, None),
    };
    let number = |end: &str| {
        Fraction::read(end).ok_or_else(|| {
            wrong(format!(
                "the ends of a range are decimals or fractions of up to twelve digits, found `{}` in `{written}`",
                end.trim()
            ))
        })
    };
    let (from, to) = (number(from)?, number(to)?);
    let count = count
        .map(|count| match count.parse::<u64>() {
            Ok(many) if (1..=MOST_STEPS).contains(&many) => Ok(many),
            _ => Err(wrong(format!(
                "the count of a range is a whole number from 1 to {MOST_STEPS}, found `{count}` in `{written}`"
            ))),
        })
        .transpose()?;
    let range = Range { from, to, count };
    // Its numbers are largest near the ends.
    let whole = count.map_or(PARTS, |count| count.saturating_sub(1).max(1));
    let fits = [0, 1, whole.saturating_sub(1), whole]
        .iter()
        .all(|part| Fraction::between(from, to, *part, whole).is_some());
    if !fits {
        return Err(wrong(format!(
            "`{written}` takes fractions of too many digits"
        )));
    }
    Ok(range)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn functions_keep_their_commas() {
        let over = Over::read("a=atan2(1, 2),1").unwrap();
        assert_eq!(over.values.count(), Some(2));
        assert_eq!(over.values.at(0).unwrap().setting, "atan2(1, 2)");
    }

    #[test]
    fn ranges_and_lists_are_exact() {
        let over = Over::read(" a = 0..2:401 ").unwrap();
        assert_eq!((over.name.as_str(), over.written()), ("a", "a=0..2:401"));
        let value = over.values.at(1).unwrap();
        assert_eq!((&*value.shown, &*value.setting), ("0.005", "1/200"));
        assert!(value.is_decimal && over.values.at(401).is_none());
        let single = Over::read("a=0.125").unwrap();
        assert_eq!(single.values.at(0).unwrap().setting, "1/8");
        assert_eq!(
            Over::read("a=3..4:1").unwrap().values.at(0).unwrap().shown,
            "3"
        );
        assert_eq!(Over::read("a=-1..1").unwrap().values.count(), None);
    }

    #[test]
    fn what_is_written_otherwise_is_refused() {
        for wrong in [
            "a",
            "a=",
            "=1",
            "a=1..",
            "a=1..2:0",
            "a=1..2:x",
            "a=pi..2:3",
            "a=1,,2",
        ] {
            assert!(Over::read(wrong).is_err(), "{wrong}");
        }
    }
}
