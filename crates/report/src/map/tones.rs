//! Which colours a map has, and what each means.

use super::MapError;
use super::answer::Answer;
use super::reading::{Cell, number};
use crate::picture::plot::{COLOURS, decades, power_of_ten};
use crate::text::words::figure;
use std::collections::{BTreeMap, BTreeSet};

/// Shades of a scale: classes `step0` to `step8`.
const SHADES: usize = 9;

/// The column whose scale is logarithmic.
const MARGIN: &str = "margin";

/// What a colour stands for; the order is that of the legend.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Tone {
    /// One of the words of a column, by its number.
    Word(usize),
    /// A step of a scale, from the least.
    Step(usize),
    /// An answer, or that there is none.
    Answer(Answer),
    /// Rows of one cell differ.
    Differs,
    /// It was analysed, and the column is empty.
    Nothing,
}

/// A colour with its meaning and how often it is there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Entry {
    pub tone: Tone,
    /// Its class in the style.
    pub class: String,
    pub label: String,
    pub count: usize,
}

/// By what cells are coloured.
#[derive(Clone, Debug, PartialEq)]
enum By {
    Answers,
    /// Few words, or whole numbers.
    Words(Vec<String>),
    /// Bounds of steps, one more than there are; none where there is no number.
    Steps(Vec<f64>),
}

/// How cells get their colours.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Colouring {
    column: String,
    by: By,
}

impl Colouring {
    /// By a column, or by what rows say where there is none.
    ///
    /// # Errors
    /// [`MapError`] where a column has more words than there are colours.
    pub fn new(column: Option<&str>, cells: &[Cell]) -> Result<Self, MapError> {
        let Some(column) = column else {
            return Ok(Self {
                column: String::new(),
                by: By::Answers,
            });
        };
        let values: BTreeSet<&str> = cells
            .iter()
            .filter_map(|cell| cell.value.as_deref())
            .filter(|value| !value.is_empty())
            .collect();
        let numbers: Option<Vec<f64>> = values.iter().map(|value| number(value)).collect();
        let is_scale = |numbers: &Vec<f64>| {
            column == MARGIN || numbers.len() > COLOURS || numbers.iter().any(|x| x.fract() != 0.0)
        };
        let mut words: Vec<String> = values.iter().map(|value| (*value).to_owned()).collect();
        let by = match numbers {
            Some(numbers) if is_scale(&numbers) => By::Steps(bounds(column, cells)),
            Some(_) => {
                let size = |word: &String| number(word).unwrap_or_default();
                words.sort_by(|one, other| size(one).total_cmp(&size(other)));
                By::Words(words)
            }
            None if words.len() > COLOURS => {
                return Err(MapError::new(
                    format!(
                        "the column `{column}` has {} different words, and a map {COLOURS} colours for them",
                        words.len()
                    ),
                    "leave `--colour` out, or colour by `verdict`, `class`, `kind`, `finite` or `margin`",
                ));
            }
            None => By::Words(words),
        };
        Ok(Self {
            column: column.to_owned(),
            by,
        })
    }

    /// The colour of a cell.
    pub fn tone(&self, cell: &Cell) -> Tone {
        let answer = cell.answer().map_or(Tone::Differs, Tone::Answer);
        // Columns have something to say of what was analysed.
        if !cell.answers.keys().any(|answer| answer.is_analysed()) {
            return answer;
        }
        match &self.by {
            By::Answers => answer,
            By::Steps(bounds) => match cell.least.filter(|least| self.is_shown(*least)) {
                Some(least) => Tone::Step(step(bounds, least)),
                None => Tone::Nothing,
            },
            By::Words(words) => {
                if cell.differs || !cell.answers.keys().all(|answer| answer.is_analysed()) {
                    return Tone::Differs;
                }
                let own = |value: &String| words.iter().position(|word| word == value);
                cell.value
                    .as_ref()
                    .and_then(own)
                    .map_or(Tone::Nothing, Tone::Word)
            }
        }
    }

    /// Whether a number has a place on the scale.
    fn is_shown(&self, number: f64) -> bool {
        is_shown(&self.column, number)
    }

    /// What is shown of several rows.
    pub fn combined(&self) -> &'static str {
        match self.by {
            By::Steps(_) => "the least of their values",
            By::Answers | By::Words(_) => "what all of them say, or that they differ",
        }
    }

    /// What is to be said of the column.
    pub fn note(&self) -> Option<&'static str> {
        (self.column == MARGIN).then_some(
            "The margin is how many times its tolerance the rank of the weakest part is away from being another one. It falls towards \
             sets between the values of the sweep where the rank is another one. Where there are redundant constraints throughout, it is what \
             rounding leaves of these, some hundreds.",
        )
    }

    fn class(&self, tone: Tone) -> String {
        match tone {
            Tone::Word(index) => format!("fill s{}", index % COLOURS),
            Tone::Step(index) => {
                let steps = match &self.by {
                    By::Steps(bounds) => bounds.len().saturating_sub(1),
                    By::Answers | By::Words(_) => 0,
                };
                // All shades are used, however few steps there are.
                let shade = index * (SHADES - 1) / steps.saturating_sub(1).max(1);
                format!("step{}", shade.min(SHADES - 1))
            }
            Tone::Answer(answer) => answer.class(),
            Tone::Differs => "differs".to_owned(),
            Tone::Nothing => "nothing".to_owned(),
        }
    }

    fn label(&self, tone: Tone) -> String {
        match (tone, &self.by) {
            (Tone::Word(index), By::Words(words)) => words.get(index).cloned().unwrap_or_default(),
            (Tone::Step(index), By::Steps(bounds)) => {
                let bound = |at: usize| bounds.get(at).copied().map(figure).unwrap_or_default();
                match bounds.get(index + 1) {
                    Some(most) if most.is_infinite() => format!("{} and more", bound(index)),
                    _ => format!("{} … {}", bound(index), bound(index + 1)),
                }
            }
            (Tone::Answer(answer), _) => answer.label(),
            (Tone::Differs, _) => "rows differ".to_owned(),
            (Tone::Nothing, _) if self.column == MARGIN => "no other rank is near".to_owned(),
            _ => "nothing to say".to_owned(),
        }
    }
}

/// Whether a number has a place on the scale of a column.
fn is_shown(column: &str, number: f64) -> bool {
    column != MARGIN || number > 0.0
}

/// All colours that are there, and all steps of a scale. Places between cells are not counted.
pub(super) fn legend(colouring: &Colouring, tones: &[Tone], between: &[Tone]) -> Vec<Entry> {
    let steps = match &colouring.by {
        By::Steps(bounds) => bounds.len().saturating_sub(1),
        By::Answers | By::Words(_) => 0,
    };
    let mut counts: BTreeMap<Tone, usize> = (0..steps).map(|step| (Tone::Step(step), 0)).collect();
    for tone in between {
        counts.entry(*tone).or_default();
    }
    for tone in tones {
        *counts.entry(*tone).or_default() += 1;
    }
    counts
        .into_iter()
        .map(|(tone, count)| Entry {
            tone,
            class: colouring.class(tone),
            label: colouring.label(tone),
            count,
        })
        .collect()
}

/// Bounds of the steps of a column's scale.
fn bounds(column: &str, cells: &[Cell]) -> Vec<f64> {
    let shown = cells.iter().filter_map(|cell| cell.least);
    let mut shown: Vec<f64> = shown.filter(|number| is_shown(column, *number)).collect();
    shown.sort_by(f64::total_cmp);
    let (Some(&least), Some(&most)) = (shown.first(), shown.last()) else {
        return Vec::new();
    };
    if column == MARGIN {
        return margin_bounds(&shown);
    }
    if least == most {
        return vec![least, most];
    }
    (0..=SHADES)
        .map(|k| least + (most - least) * (k as f64 / SHADES as f64))
        .collect()
}

/// Those of margins, which rise. Of many the greatest fiftieth has no scale and is in the last step: constraints that are redundant to the last
/// digit have margins of any size, beside which nothing else could be told apart.
fn margin_bounds(margins: &[f64]) -> Vec<f64> {
    const LEFT_OUT: usize = 50;
    let last = margins.len().saturating_sub(1 + margins.len() / LEFT_OUT);
    let (Some(&least), Some(&scaled), Some(&most)) =
        (margins.first(), margins.get(last), margins.last())
    else {
        return Vec::new();
    };
    let mut bounds = log_bounds(least, scaled);
    if let Some(end) = bounds.last_mut().filter(|end| most > **end) {
        *end = f64::INFINITY;
    }
    bounds
}

/// Whole decades; several at once where there are many, 1, 2 and 5 of each where there are few.
fn log_bounds(least: f64, most: f64) -> Vec<f64> {
    const STEPS: i32 = SHADES as i32;
    let (low, high) = decades(least, most);
    let high = high.max(low + 1);
    let span = high - low;
    if 3 * span <= STEPS {
        let inner = (low..high)
            .flat_map(|exponent| [1.0, 2.0, 5.0].map(|digit| digit * power_of_ten(exponent)));
        return inner.chain([power_of_ten(high)]).collect();
    }
    let stride = (span + STEPS - 1) / STEPS;
    let steps = (span + stride - 1) / stride;
    (0..=steps)
        .map(|step| power_of_ten(low + step * stride))
        .collect()
}

/// The step in which a value lies; the outer ones have no end.
fn step(bounds: &[f64], value: f64) -> usize {
    let inner = bounds.iter().skip(1).rev().skip(1);
    inner.filter(|bound| value >= **bound).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_decades_or_parts_of_them() {
        assert_eq!(
            log_bounds(3.0, 40.0),
            [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]
        );
        assert_eq!(log_bounds(1.0, 1.0), [1.0, 2.0, 5.0, 10.0]);
        let many = log_bounds(1.0, 1e12);
        assert_eq!(many.first(), Some(&1.0));
        assert_eq!((many.get(1), many.last()), (Some(&1e2), Some(&1e12)));
        assert!(many.len() <= SHADES + 1);
        let four = log_bounds(2.0, 3e3);
        assert_eq!(four, [1.0, 1e1, 1e2, 1e3, 1e4]);
    }

    #[test]
    fn a_few_great_margins_do_not_stretch_the_scale() {
        let mut margins = vec![3.0];
        margins.extend((100..198).map(f64::from));
        margins.push(1e12);
        let bounds = margin_bounds(&margins);
        assert_eq!(bounds.first(), Some(&1.0));
        assert_eq!(bounds.get(bounds.len() - 2), Some(&500.0));
        assert_eq!(bounds.last(), Some(&f64::INFINITY));
        assert_eq!(step(&bounds, 1e12), bounds.len() - 2);
        let few = margin_bounds(&[3.0, 1e12]);
        assert_eq!(few.last(), Some(&1e12));
        assert!(margin_bounds(&[]).is_empty());
    }

    #[test]
    fn values_lie_in_their_steps() {
        let bounds = [1.0, 10.0, 100.0, 1000.0];
        let steps = [0.5, 1.0, 9.9, 10.0, 999.0, 1e9].map(|value| step(&bounds, value));
        assert_eq!(steps, [0, 0, 0, 1, 2, 2]);
        assert_eq!(step(&[1.0, 1.0], 1.0), 0);
    }
}
