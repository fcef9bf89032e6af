//! Which cells a map has, and what belongs to each.

use super::answer::{Answer, Said};
use super::grid::{At, Grid};
use super::rows::{Columns, Head, Line, Lines, opening, unreadable};
use super::tones::{Colouring, Tone, legend};
use super::{Map, MapError};
use crate::sweep::csv_cells;
use crate::text::words::counted;
use kutzbach_math::number::Number;
use std::collections::BTreeMap;
use std::io::BufRead;

/// More cells than this are no picture.
const MOST_CELLS: usize = 1_000_000;

/// More cells than this are drawn as shapes of one colour.
pub(super) const MOST_SINGLE: usize = 20_000;

/// What a map is to show.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MapAsked {
    /// The measure along the horizontal axis; the first one, if `None`.
    pub x: Option<String>,
    /// The measure along the vertical axis; the next one, if `None`.
    pub y: Option<String>,
    /// The column that gives cells their colours; what a row says of how the mechanism moves, if `None` or `verdict`.
    pub colour: Option<String>,
}

/// What is known of one place of the map.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    /// The values of both measures.
    pub at: [f64; 2],
    /// The number of the first variant there.
    pub variant: u64,
    /// All measures of that variant, as written.
    pub measures: Vec<String>,
    /// Why there is no answer for it.
    pub reason: String,
    /// How many rows give each answer.
    pub answers: BTreeMap<Answer, u64>,
    /// What analysed rows have in the column of the colour: the first that was read, and whether others differ.
    pub value: Option<String>,
    pub differs: bool,
    /// The least of the numbers in that column.
    pub least: Option<f64>,
}

impl Cell {
    fn new(at: [f64; 2]) -> Self {
        Self {
            at,
            variant: u64::MAX,
            measures: Vec::new(),
            reason: String::new(),
            answers: BTreeMap::new(),
            value: None,
            differs: false,
            least: None,
        }
    }

    /// How many rows belong to it.
    pub fn rows(&self) -> u64 {
        self.answers.values().sum()
    }

    /// What all of its rows say; `None` where they differ.
    pub fn answer(&self) -> Option<Answer> {
        let mut answers = self.answers.keys();
        match (answers.next(), answers.next()) {
            (Some(answer), None) => Some(*answer),
            _ => None,
        }
    }

    fn add(&mut self, answer: Answer, value: Option<&str>) {
        *self.answers.entry(answer).or_default() += 1;
        let Some(value) = value.filter(|_| answer.is_analysed()) else {
            return;
        };
        match &self.value {
            None => self.value = Some(value.to_owned()),
            Some(own) => self.differs |= own != value,
        }
        if let Some(number) = number(value) {
            self.least = Some(self.least.map_or(number, |least| least.min(number)));
        }
    }
}

/// What the rows are of, and which of their columns are looked at.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    pub head: Option<Head>,
    pub columns: Columns,
    pub x: usize,
    pub y: usize,
    colour: Option<usize>,
    status: usize,
    verdict: Option<usize>,
    finite: Option<usize>,
    instantaneous: Option<usize>,
    pose: Option<usize>,
    locked: Option<usize>,
    reason: Option<usize>,
}

impl Sweep {
    fn new(head: Option<Head>, columns: Columns, asked: &MapAsked) -> Result<Self, MapError> {
        let measure = |name: &str| {
            columns.measure(name).ok_or_else(|| {
                MapError::new(
                    format!("there is no measure `{name}` in the sweep"),
                    format!("it has {}", columns.listed(columns.measures())),
                )
            })
        };
        let x = asked.x.as_deref().map(measure).transpose()?;
        let y = asked.y.as_deref().map(measure).transpose()?;
        // What is not named is the first measure that is not taken.
        let free = |taken: Option<usize>| columns.measures().find(|own| Some(*own) != taken);
        let x = x.or_else(|| free(y));
        let y = y.or_else(|| free(x));
        let (Some(x), Some(y)) = (x, y) else {
            return Err(MapError::new(
                "a map takes two measures, and the sweep has fewer",
                "sweep over two: `--over a=0..2:41 --over b=0..1:41`",
            ));
        };
        if x == y {
            return Err(MapError::new(
                format!("both axes show `{}`", columns.measure_name(x)),
                "give `-x` and `-y` different measures",
            ));
        }
        let asked_colour = asked.colour.as_deref().filter(|name| *name != "verdict");
        let colour = asked_colour
            .map(|name| colour(&columns, name))
            .transpose()?;
        let place = |name: &str| columns.place(name);
        Ok(Self {
            x,
            y,
            colour,
            status: place("status").unwrap_or_default(),
            verdict: place("verdict"),
            finite: place("finite"),
            instantaneous: place("instantaneous"),
            pose: place("pose"),
            locked: place("locked"),
            reason: place("reason"),
            head,
            columns,
        })
    }

    pub fn x_name(&self) -> &str {
        self.columns.measure_name(self.x)
    }

    pub fn y_name(&self) -> &str {
        self.columns.measure_name(self.y)
    }

    /// The column of the colour; `None` where that is the answer.
    pub fn colour_name(&self) -> Option<&str> {
        self.colour.map(|place| self.columns.measure_name(place))
    }

    /// The mechanism's file, where the rows say so.
    pub fn file(&self) -> Option<&str> {
        let head = self.head.as_ref()?;
        Some(head.file.as_str()).filter(|file| !file.is_empty())
    }

    fn answer(&self, row: &[String]) -> Option<Answer> {
        let at = |place: Option<usize>| place.and_then(|place| row.get(place)).map(String::as_str);
        Answer::of(&Said {
            status: at(Some(self.status)).unwrap_or_default(),
            verdict: at(self.verdict),
            finite: at(self.finite).unwrap_or_default(),
            instantaneous: at(self.instantaneous).unwrap_or_default(),
            pose: at(self.pose).unwrap_or_default(),
            locked: at(self.locked).unwrap_or_default(),
        })
    }
}

/// The place of the column that is to give the colours.
fn colour(columns: &Columns, name: &str) -> Result<usize, MapError> {
    let found = columns.place(name).or_else(|| columns.measure(name));
    found.filter(|place| *place > 0).ok_or_else(|| {
        MapError::new(
            format!("there is no column `{name}` in the sweep"),
            format!("it has {}", columns.listed(1..columns.count())),
        )
    })
}

/// The value of a cell: a decimal, a fraction, or an expression such as `pi/4`.
pub(super) fn number(written: &str) -> Option<f64> {
    let decimal = written.parse::<f64>().ok().filter(|x| x.is_finite());
    let value = decimal.or_else(|| {
        let number = Number::expression(written, &mut |_| Ok(None)).ok()?;
        Some(number.value()).filter(|x| x.is_finite())
    })?;
    // There is one zero on an axis.
    Some(value + 0.0)
}

/// Reads the rows of a sweep, from one file or from those of its shares.
#[derive(Clone, Debug)]
pub struct MapReader {
    asked: MapAsked,
    sweep: Option<Sweep>,
    cells: BTreeMap<[At; 2], Cell>,
    /// Where the sweep looked between its values.
    between: BTreeMap<[At; 2], Cell>,
    /// Of each measure the first value, and whether there are others.
    first: Vec<(String, bool)>,
    rows: u64,
    incomplete: usize,
}

impl MapReader {
    /// Without any rows yet.
    #[must_use]
    pub fn new(asked: MapAsked) -> Self {
        Self {
            asked,
            sweep: None,
            cells: BTreeMap::new(),
            between: BTreeMap::new(),
            first: Vec::new(),
            rows: 0,
            incomplete: 0,
        }
    }

    /// Adds the rows of a file, which errors call `file`. A last row that was cut off is left out, and counted.
    ///
    /// # Errors
    /// [`MapError`] where there is something else, or rows of another sweep; where a value of a measure on an axis is no number;
    /// where there are more cells than a picture has room for.
    pub fn read(&mut self, file: &str, text: impl BufRead) -> Result<(), MapError> {
        let mut lines = Lines::new(text);
        let (head, columns) = opening(file, &mut lines)?;
        if let Some(sweep) = &self.sweep {
            if sweep.head != head || sweep.columns != columns {
                return Err(MapError::new(
                    format!("`{file}` has rows of another sweep than the files before it"),
                    "a map is of one sweep: name the files of its shares",
                ));
            }
        } else {
            self.sweep = Some(Sweep::new(head, columns, &self.asked)?);
        }
        while let Some(line) = lines.read().map_err(|error| unreadable(file, &error))? {
            if !line.content.is_empty() {
                self.add(file, &line)?;
            }
        }
        Ok(())
    }

    /// Adds a row.
    fn add(&mut self, file: &str, line: &Line) -> Result<(), MapError> {
        let Some(sweep) = &self.sweep else {
            return Ok(());
        };
        let wrong = |what: String| {
            MapError::new(
                format!("line {} of `{file}`: {what}", line.number),
                "the same `kutzbach sweep` makes the file anew",
            )
        };
        let row = match csv_cells(&line.content) {
            Some(row) if row.len() == sweep.columns.count() => row,
            // Only the end of a sweep that was broken off has no line break.
            _ if !line.is_complete => {
                self.incomplete += 1;
                return Ok(());
            }
            _ => {
                return Err(wrong(format!("needed {} cells", sweep.columns.count())));
            }
        };
        let cell = |place: usize| row.get(place).map_or("", String::as_str);
        let value = |place: usize| {
            number(cell(place)).ok_or_else(|| {
                MapError::new(
                    format!(
                        "`{}` of `{}` is no number that an axis could show (line {} of `{file}`)",
                        cell(place),
                        sweep.columns.measure_name(place),
                        line.number
                    ),
                    "choose other measures with `-x` and `-y`",
                )
            })
        };
        let at = [value(sweep.x)?, value(sweep.y)?];
        let variant: u64 = cell(0)
            .parse()
            .map_err(|_| wrong(format!("`{}` is no number of a variant", cell(0))))?;
        let answer = sweep
            .answer(&row)
            .ok_or_else(|| wrong("its status or verdict is none that a sweep writes".to_owned()))?;
        // Rows after all variants are those of a refined border.
        let variants = sweep.head.as_ref().map_or(u64::MAX, |head| head.variants);
        let places = match variant < variants {
            true => {
                self.rows += 1;
                notice(&mut self.first, &row, sweep.columns.measures());
                &mut self.cells
            }
            false => &mut self.between,
        };
        let own = places.entry(at.map(At)).or_insert_with(|| Cell::new(at));
        own.add(answer, sweep.colour.map(cell));
        if variant < own.variant {
            own.variant = variant;
            own.measures = sweep
                .columns
                .measures()
                .map(|place| cell(place).to_owned())
                .collect();
            own.reason = sweep.reason.map_or("", cell).to_owned();
        }
        if places.len() > MOST_CELLS {
            return Err(MapError::new(
                format!("there are more than {MOST_CELLS} pairs of values on the axes"),
                "sweep fewer of them, or choose other measures with `-x` and `-y`",
            ));
        }
        Ok(())
    }

    /// The map of all rows.
    ///
    /// # Errors
    /// [`MapError`] where there is no row, or the colours would be too many to be told apart.
    pub fn finish(self) -> Result<Map, MapError> {
        let Some(sweep) = self.sweep.clone().filter(|_| self.rows > 0) else {
            return Err(MapError::new(
                "there is no row to draw",
                "let the sweep do some of its work first",
            ));
        };
        let mut cells: Vec<Cell> = self.cells.values().cloned().collect();
        let count = cells.len();
        // Those that differ from a cell in measures without an axis lie in its middle, where nothing would be seen.
        let between = self
            .between
            .iter()
            .filter(|(at, _)| !self.cells.contains_key(*at));
        cells.extend(between.map(|(_, cell)| cell.clone()));
        let colouring = Colouring::new(sweep.colour_name(), &cells)?;
        let points: Vec<[f64; 2]> = cells.iter().take(count).map(|cell| cell.at).collect();
        // Combinations are a grid however few of them are there yet.
        let is_whole = sweep
            .head
            .as_ref()
            .is_some_and(|head| head.sample.is_none());
        let grid = Grid::new(&points, is_whole);
        let (own, between) = cells.split_at(count);
        let mut notes = self.notes(&sweep, own, &colouring, grid.as_ref());
        if !between.is_empty() {
            notes.push(format!(
                "The border was looked for between cells: {}, as dots.",
                counted(between.len(), "place")
            ));
        }
        let tones: Vec<Tone> = cells.iter().map(|cell| colouring.tone(cell)).collect();
        let (own, between) = tones.split_at(count);
        let legend = legend(&colouring, own, between);
        Ok(Map {
            sweep,
            cells,
            count,
            tones,
            grid,
            legend,
            notes,
        })
    }

    /// What is to be said of how the map came about.
    fn notes(
        &self,
        sweep: &Sweep,
        cells: &[Cell],
        colouring: &Colouring,
        grid: Option<&Grid>,
    ) -> Vec<String> {
        let mut notes = Vec::new();
        let (x, y) = (sweep.x, sweep.y);
        let others = || {
            let places = sweep.columns.measures().zip(&self.first);
            places.filter(move |(place, _)| *place != x && *place != y)
        };
        let fixed: Vec<String> = others()
            .filter(|(_, (_, varies))| !varies)
            .map(|(place, (value, _))| format!("{} = {value}", sweep.columns.measure_name(place)))
            .collect();
        if !fixed.is_empty() {
            notes.push(format!("Throughout: {}.", fixed.join(", ")));
        }
        let most = cells.iter().map(Cell::rows).max().unwrap_or(0);
        if most > 1 {
            let varied: Vec<&str> = others()
                .filter(|(_, (_, varies))| *varies)
                .map(|(place, _)| sweep.columns.measure_name(place))
                .collect();
            let why = match varied.as_slice() {
                [] => "the same values come again".to_owned(),
                names => format!("{} too", vary(names)),
            };
            notes.push(format!(
                "Up to {most} rows are one cell, since {why}: it shows {}.",
                colouring.combined()
            ));
        }
        notes.extend(colouring.note().map(str::to_owned));
        let variants = sweep.head.as_ref().map_or(0, |head| head.variants);
        if self.rows < variants {
            notes.push(format!("{} of {variants} variants are there.", self.rows));
        }
        let empty = grid.map_or(0, Grid::empty);
        if empty > 0 {
            notes.push(format!(
                "Without a row, and left empty: {}.",
                counted(empty, "place")
            ));
        }
        if self.incomplete > 0 {
            notes.push(format!(
                "Cut off, and left out: {}.",
                counted(self.incomplete, "row")
            ));
        }
        if grid.is_some() && cells.len() > MOST_SINGLE {
            notes.push("Cells of one colour beside one another are one shape.".to_owned());
        }
        notes
    }
}

/// Keeps the first value of each measure, and whether there are others.
fn notice(
    first: &mut Vec<(String, bool)>,
    row: &[String],
    measures: std::ops::RangeInclusive<usize>,
) {
    let values = row.get(measures).unwrap_or_default();
    if first.is_empty() {
        first.extend(values.iter().map(|value| (value.clone(), false)));
        return;
    }
    for ((own, varies), value) in first.iter_mut().zip(values) {
        *varies |= own != value;
    }
}

/// `c varies`, `c and d vary`.
fn vary(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [name] => format!("{name} varies"),
        [all @ .., last] => format!("{} and {last} vary", all.join(", ")),
    }
}
