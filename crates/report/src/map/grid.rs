//! Cells that touch, and the lines where one answer becomes another.

use std::cmp::Ordering;

/// A value on an axis, in its order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct At(pub f64);

impl Eq for At {}

impl PartialOrd for At {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for At {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// A grid may have no more places than this, with points or without.
const MOST_PLACES: usize = 4_000_000;

/// Values of two measures with all, or many, of their combinations.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Grid {
    /// Borders of the columns, one more than there are.
    pub x: Vec<f64>,
    /// Borders of the rows.
    pub y: Vec<f64>,
    /// Which point lies at each place, row by row.
    places: Vec<Option<usize>>,
}

impl Grid {
    /// The grid of points; `None` where they are none: fewer than half of the combinations of their values, unless they are known to be
    /// part of a whole grid (`is_whole`).
    pub fn new(points: &[[f64; 2]], is_whole: bool) -> Option<Self> {
        let [xs, ys] = [0_usize, 1].map(|axis| {
            let mut values: Vec<f64> = points
                .iter()
                .filter_map(|point| point.get(axis).copied())
                .collect();
            values.sort_by(f64::total_cmp);
            values.dedup();
            values
        });
        let places = xs.len().checked_mul(ys.len())?;
        let is_filled = is_whole || points.len() >= places.div_ceil(2);
        if places == 0 || places > MOST_PLACES || !is_filled {
            return None;
        }
        let mut grid = Self {
            x: borders(&xs),
            y: borders(&ys),
            places: vec![None; places],
        };
        for (index, [x, y]) in points.iter().enumerate() {
            let column = xs.binary_search_by(|own| own.total_cmp(x)).ok()?;
            let row = ys.binary_search_by(|own| own.total_cmp(y)).ok()?;
            let place = grid.places.get_mut(row * xs.len() + column)?;
            *place = Some(index);
        }
        Some(grid)
    }

    /// How many columns.
    pub fn width(&self) -> usize {
        self.x.len().saturating_sub(1)
    }

    /// How many rows.
    pub fn height(&self) -> usize {
        self.y.len().saturating_sub(1)
    }

    /// How many places have no point.
    pub fn empty(&self) -> usize {
        self.places.iter().filter(|place| place.is_none()).count()
    }

    /// The point at a place, counted from the lower left.
    pub fn at(&self, column: usize, row: usize) -> Option<usize> {
        if column >= self.width() {
            return None;
        }
        let place = row.checked_mul(self.width())?.checked_add(column)?;
        self.places.get(place).copied().flatten()
    }

    /// The lines between places whose points are on different sides, each as long as can be. Where there is no point there is no side.
    pub fn border<T: PartialEq>(&self, side: impl Fn(usize) -> T) -> Vec<Line> {
        let differ = |one: Option<usize>, other: Option<usize>| match (one, other) {
            (Some(one), Some(other)) => side(one) != side(other),
            _ => false,
        };
        let mut lines = Vec::new();
        for column in 1..self.width() {
            let between = |row| differ(self.at(column - 1, row), self.at(column, row));
            for (from, to) in runs(self.height(), between) {
                lines.push(Line::Upright { column, from, to });
            }
        }
        for row in 1..self.height() {
            let between = |column| differ(self.at(column, row - 1), self.at(column, row));
            for (from, to) in runs(self.width(), between) {
                lines.push(Line::Level { row, from, to });
            }
        }
        lines
    }
}

/// A line along borders, from one of those across it to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Line {
    /// Along the left border of a column.
    Upright {
        /// Which.
        column: usize,
        /// The row above whose lower border it begins.
        from: usize,
        /// The row at whose lower border it ends.
        to: usize,
    },
    /// Along the lower border of a row.
    Level {
        /// Which.
        row: usize,
        /// The column at whose left border it begins.
        from: usize,
        /// The column at whose left border it ends.
        to: usize,
    },
}

/// Beginnings and ends of runs of what holds.
fn runs(count: usize, holds: impl Fn(usize) -> bool) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut begun = None;
    for place in 0..count {
        match (begun, holds(place)) {
            (None, true) => begun = Some(place),
            (Some(from), false) => {
                found.push((from, place));
                begun = None;
            }
            _ => {}
        }
    }
    found.extend(begun.map(|from| (from, count)));
    found
}

/// Half way between neighbours; the outer ones as far from their value as the inner ones.
fn borders(values: &[f64]) -> Vec<f64> {
    let (Some(first), Some(last)) = (values.first(), values.last()) else {
        return Vec::new();
    };
    // A value without neighbours has a cell as wide as the value is far from zero.
    let alone = match *first == 0.0 {
        true => 0.5,
        false => 0.5 * first.abs(),
    };
    let below = match values {
        [one, two, ..] => 0.5 * (two - one),
        _ => alone,
    };
    let above = match values {
        [.., one, two] => 0.5 * (two - one),
        _ => alone,
    };
    let mut borders = vec![first - below];
    let pairs = values.iter().zip(values.iter().skip(1));
    borders.extend(pairs.map(|(one, two)| one + 0.5 * (two - one)));
    borders.push(last + above);
    borders
}
