//! Text that remembers the numbers in it: `0 0 1.5707963267948966` knows that its last word is pi/2.
//!
//! xacro makes text of every number it computes, and reads it again. Here each such number leaves a mark, so that the
//! exact value survives joining, cutting and reading; whatever else is done to a text drops its marks.

use kutzbach_math::number::Number;
use std::ops::Range;
use std::rc::Rc;

/// Text with marks, in order, none overlapping.
#[derive(Clone, Debug)]
pub(super) struct Text {
    text: Rc<str>,
    marks: Rc<[Mark]>,
}

/// A number and the part of the text that is written for it.
#[derive(Clone, Debug)]
pub(super) struct Mark {
    pub(super) range: Range<usize>,
    pub(super) number: Number,
}

impl Text {
    pub(super) fn plain(text: &str) -> Self {
        Self {
            text: text.into(),
            marks: Rc::default(),
        }
    }

    /// The text of a number, all of it marked.
    pub(super) fn of_number(text: &str, number: Option<&Number>) -> Self {
        let mark = number.map(|number| Mark {
            range: 0..text.len(),
            number: number.clone(),
        });
        Self {
            text: text.into(),
            marks: mark.into_iter().collect(),
        }
    }

    pub(super) fn as_str(&self) -> &str {
        &self.text
    }

    /// The text without its marks.
    pub(super) fn shared(&self) -> Rc<str> {
        self.text.clone()
    }

    pub(super) fn marks(&self) -> &[Mark] {
        &self.marks
    }

    /// A number in it that is left open.
    pub(super) fn open(&self) -> Option<&Number> {
        let mut numbers = self.marks.iter().map(|mark| &mark.number);
        numbers.find(|number| number.is_open())
    }

    /// The number that all of a part stands for.
    pub(super) fn number_at(&self, part: Range<usize>) -> Option<&Number> {
        let index = self
            .marks
            .binary_search_by_key(&part.start, |mark| mark.range.start)
            .ok()?;
        let mark = self.marks.get(index)?;
        (mark.range == part).then_some(&mark.number)
    }

    /// A part, given at character boundaries.
    pub(super) fn slice(&self, part: Range<usize>) -> Self {
        let Some(text) = self.text.get(part.clone()) else {
            return Self::plain("");
        };
        let first = self
            .marks
            .partition_point(|mark| mark.range.start < part.start);
        let marks = self.marks[first..]
            .iter()
            .take_while(|mark| mark.range.end <= part.end)
            .map(|mark| Mark {
                range: mark.range.start - part.start..mark.range.end - part.start,
                number: mark.number.clone(),
            })
            .collect();
        Self {
            text: text.into(),
            marks,
        }
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Self::plain(text)
    }
}

/// A text put together from parts.
#[derive(Debug, Default)]
pub(super) struct Joined {
    text: String,
    marks: Vec<Mark>,
}

impl Joined {
    pub(super) fn push(&mut self, part: &Text) {
        let offset = self.text.len();
        self.text.push_str(part.as_str());
        self.marks.extend(part.marks().iter().map(|mark| Mark {
            range: mark.range.start + offset..mark.range.end + offset,
            number: mark.number.clone(),
        }));
    }

    pub(super) fn push_str(&mut self, part: &str) {
        self.text.push_str(part);
    }

    pub(super) fn len(&self) -> usize {
        self.text.len()
    }

    pub(super) fn finish(self) -> Text {
        Text {
            text: self.text.into(),
            marks: self.marks.into(),
        }
    }
}
