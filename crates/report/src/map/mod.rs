//! A sweep as a picture over two of its measures.
//!
//! # The problem
//! A sweep is a table of thousands of rows, and what one asks of it is a place: where it moves, where it locks, where it is
//! singular, where it does not go together, and where one becomes another. Two measures span a plane; a map colours it.
//!
//! # What holds
//! * Values of two measures that form a grid are cells that touch, up to half way to their neighbours; other samples are points.
//! * A map says nothing that no row says: a place without a row stays empty, and nothing is guessed between values. The line where
//!   answers change runs along the borders of cells, so it is as fine as the sweep.
//! * Rows without an answer (they do not assemble, the file is no mechanism with these values) have colours of their own, whatever
//!   the others are coloured by, and every colour is counted.
//! * Where other measures vary too, several rows belong to one cell. It shows what all of them say, or that they differ; of numbers on
//!   a scale the least. The map says so.
//! * Rows of shares may come in any order, from several files: the same rows give the same bytes.
//! * A set that is thinner than the steps of a sweep, such as Bennett's condition, lies between its values. The *margin* falls on the way
//!   there, over many cells: coloured by it, on a logarithmic scale, the map shows where to look.
//!
//! # What it costs
//! Rows are combined while they are read: memory grows with the cells, not with the rows. The picture is linear in the cells; of many,
//! those of one colour beside one another are one shape.
//!
//! | file | what it answers |
//! |---|---|
//! | `rows` | what the text of a sweep says |
//! | `reading` | which cells there are, and what belongs to each |
//! | `answer` | what a row says in a word |
//! | `grid` | whether cells form a grid, and where answers change |
//! | `tones` | which colours there are, and what each means |
//! | `figure` | the picture |
//! | `command` | the command that makes the report of a cell |

mod answer;
mod command;
mod figure;
mod grid;
mod reading;
mod rows;
mod tones;

pub use command::Listed;
pub use reading::{MapAsked, MapReader};

use grid::Grid;
use reading::{Cell, Sweep};
use thiserror::Error;
use tones::{Entry, Tone};

/// What maps add to the style of plots.
pub const STYLE: &str = include_str!("style.css");

/// Why there is no map.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct MapError {
    /// What was needed and what was found.
    pub message: String,
    /// How to mend it.
    pub help: String,
}

impl MapError {
    fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: help.into(),
        }
    }
}

/// A sweep over two of its measures, ready to be drawn.
#[derive(Clone, Debug)]
pub struct Map {
    sweep: Sweep,
    /// In the order of their values of both measures, the horizontal one first; after them places between cells whose answers differ.
    cells: Vec<Cell>,
    /// How many are cells.
    count: usize,
    /// The colour of each.
    tones: Vec<Tone>,
    /// None where the cells are points.
    grid: Option<Grid>,
    legend: Vec<Entry>,
    notes: Vec<String>,
}

impl Map {
    /// What it is called.
    #[must_use]
    pub fn title(&self) -> String {
        let shown = match self.sweep.colour_name() {
            Some(column) => column.to_owned(),
            None => "how it moves".to_owned(),
        };
        let over = format!("{shown} over {} and {}", self.x_name(), self.y_name());
        match self.sweep.file() {
            Some(file) => format!("{file}: {over}"),
            None => over,
        }
    }

    /// What is to be said of how it was made, in sentences.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// What its colours mean, and how many cells have each.
    pub fn legend(&self) -> impl Iterator<Item = (&str, usize)> {
        self.legend
            .iter()
            .map(|entry| (entry.label.as_str(), entry.count))
    }

    /// How many cells, or points, it has.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether the values of both measures form a grid.
    #[must_use]
    pub fn is_grid(&self) -> bool {
        self.grid.is_some()
    }

    fn x_name(&self) -> &str {
        self.sweep.x_name()
    }

    fn y_name(&self) -> &str {
        self.sweep.y_name()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
