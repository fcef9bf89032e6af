//! Text whose structure is its indentation by tabs, as ASMT has it: a line and the lines below it that are further in.

use crate::error::{Fault, Outcome};
use crate::values::decimal;
use crate::words::{counted, quoted};
use kutzbach_math::number::Number;
use std::ops::Range;

/// A line: how far in it is, what it says, and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    depth: usize,
    text: &'a str,
    start: usize,
}

/// All lines up to the results of a simulation, which follow the model and may be a hundred times as long.
pub(super) fn lines(text: &str) -> Vec<Line<'_>> {
    let mut start = 0;
    let mut found = Vec::new();
    for raw in text.split_inclusive('\n') {
        let depth = raw.bytes().take_while(|byte| *byte == b'\t').count();
        let said = raw.trim();
        if said == "TimeSeries" && depth == 0 {
            break;
        }
        if !said.is_empty() {
            found.push(Line {
                depth,
                text: said,
                start: start + raw.len() - raw.trim_start().len(),
            });
        }
        start += raw.len();
    }
    found
}

/// A line with everything below it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block<'a, 't> {
    lines: &'t [Line<'a>],
}

impl<'a, 't> Block<'a, 't> {
    /// The first block of some lines.
    pub(super) fn first(lines: &'t [Line<'a>]) -> Option<Self> {
        let depth = lines.first()?.depth;
        let end = 1 + lines[1..].iter().take_while(|l| l.depth > depth).count();
        Some(Self {
            lines: &lines[..end],
        })
    }

    /// What its first line says.
    pub(super) fn word(&self) -> &'a str {
        self.lines.first().map_or("", |line| line.text)
    }

    /// Where its first line is.
    pub(super) fn range(&self) -> Range<usize> {
        self.lines
            .first()
            .map_or(0..0, |line| line.start..line.start + line.text.len())
    }

    /// The blocks right below it, in order.
    pub(super) fn blocks(&self) -> impl Iterator<Item = Block<'a, 't>> + use<'a, 't> {
        let mut rest = self.lines.get(1..).unwrap_or_default();
        std::iter::from_fn(move || {
            let block = Block::first(rest)?;
            rest = rest.get(block.lines.len()..).unwrap_or_default();
            Some(block)
        })
    }

    /// The first block below it with this word.
    pub(super) fn block(&self, word: &str) -> Option<Block<'a, 't>> {
        self.blocks().find(|block| block.word() == word)
    }

    pub(super) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault::new(self.range(), message)
    }

    /// The single line below the block of this word.
    pub(super) fn said(&self, word: &str) -> Option<Block<'a, 't>> {
        self.block(word)?.blocks().next()
    }

    /// As [`Self::said`], where it has to be there.
    pub(super) fn required(&self, word: &str) -> Outcome<Block<'a, 't>> {
        self.said(word)
            .ok_or_else(|| self.fault(format!("{} lacks {}", quoted(self.word()), quoted(word))))
    }

    /// The numbers of its first line.
    pub(super) fn numbers<const N: usize>(&self) -> Outcome<[Number; N]> {
        let numbers: Vec<Number> = self
            .word()
            .split_ascii_whitespace()
            .map(|word| decimal(word).map_err(|message| self.fault(message)))
            .collect::<Outcome<_>>()?;
        let count = numbers.len();
        numbers
            .try_into()
            .map_err(|_| self.fault(format!("expected {}, found {count}", counted(N, "number"))))
    }

    /// The number below a word, if there is one.
    pub(super) fn number(&self, word: &str) -> Outcome<Option<Number>> {
        let Some(said) = self.said(word) else {
            return Ok(None);
        };
        let [number] = said.numbers()?;
        Ok(Some(number))
    }
}
