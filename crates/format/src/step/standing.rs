//! Where joints stand, as numbers that agree where the geometry does.
//!
//! A mechanism is what it is by coincidences: a pin turns in two bars because their two axes are one line, and four bars move because
//! four axes are parallel. In a STEP file each face has an axis of its own, computed by a kernel and moved by the place of its part, so
//! that what is one line for a designer is several lines to the last digits of doubles. Written into a file as they are, they would be
//! a mechanism that is rigid, or one whose motion has to be defended against noise in every loop. So what agrees is made one *before*
//! numbers are written:
//!
//! - all frames of joints and links are parallel to one frame ([`in_frame_of_most`](super::frame::in_frame_of_most)), in which every axis is worked out once. A frame is a
//!   position and nothing else, and a direction is the same three numbers in whatever link it is written;
//! - directions that agree within [`Agreement::angle`] are one, those of the coordinate axes before all others, and what is at right angles
//!   to a coordinate axis within it has no component along it;
//! - axes of one direction whose distance is within [`Agreement::length`] are one line, with one point;
//! - where axes meet within that accuracy, they pass the same point, that of most of them;
//! - coordinates of points that agree within the accuracy are one number.
//!
//! Positions are whole numbers of units of the last decimal, and positions of joints in links are differences of such: loops close exactly,
//! as the file draws them.
//!
//! The decimals say how well the positions are known: seven (0.1 µm), fewer where the file states or prints them more coarsely. Files state finer
//! accuracies too, but they are those of a kernel's tolerance, and places of parts have passed other programs. Where
//! *every* coordinate is a whole number of [`DESIGN`] within [`ROUND`], the design is one of round numbers: of computed coordinates one in
//! 5000 is so near by chance, and of numbers that are printed in few decimals so many that there have to be more of them ([`SELDOM`]); in hundredths of a millimetre all
//! are. So it is where they are within the accuracy of the file, and so many that chance would do it once in
//! [`CHANCE`] files. These numbers are exact then.

use super::geometry::Geometry;
use kutzbach_math::group::normalised_direction;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Frame};
use nalgebra::Vector3;
use std::collections::BTreeSet;

/// Directions that differ by less (rad) are the same: what the digits of six-digit directions leave, and a thousandth of what a
/// designer would call a tilt.
const SAME_DIRECTION: f64 = 1e-6;

/// Directions that differ by more (rad) are never made the same, however few digits a file has: a tenth of the least tilt that is drawn.
const MOST_TILTED: f64 = 1e-4;

/// Lengths (m) that differ by less are the same: no part is made as exactly.
pub(super) const FINEST: f64 = 1e-7;

/// Lengths (m) that differ by more are never made the same, whatever a file states: what a shaft with the closest fit has as play.
pub(super) const COARSEST: f64 = 1e-5;

/// The unit of round numbers (per metre): hundredths of a millimetre.
const DESIGN: i64 = 100_000;

/// How near a coordinate is to a round number (m) if it is one: the digits of doubles after a few products.
const ROUND: f64 = 1e-9;

/// How often (one in so many files) chance may print all coordinates round.
const SELDOM: f64 = 4e3;

/// How often (one in so many files) chance may make all coordinates as good as round.
const CHANCE: f64 = 1e6;

/// Decimals of directions: half of the last is below what counts as the same.
const DIRECTION_DECIMALS: usize = 7;

/// The most axes among which common points are looked for; the work may grow with the fourth power.
const MOST_AXES: usize = 150;

/// A position in the units of a [`Grid`].
pub(super) type Position = [i128; 3];

/// Where a joint stands in the assembly.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Standing {
    /// The origin of its frame.
    pub position: Position,
    /// Its axis, direction or normal; `None` where it has none.
    pub axis: Option<Direction>,
    /// The second of two axes.
    pub axis2: Option<Direction>,
}

/// What a position is counted in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    /// Units in a metre.
    per_metre: i64,
    /// Decimals of a position in metres; `None` where whole numbers of units are exact.
    decimals: Option<usize>,
}

impl Grid {
    /// The grid for points that agree so, of which `points` have to be on it.
    fn new(points: &[Vector3<f64>], within: Agreement, may_be_exact: bool) -> Self {
        if may_be_exact && are_round(points, within) {
            return Self {
                per_metre: DESIGN,
                decimals: None,
            };
        }
        let (decimals, per_metre) = match within.length.max(within.printed) {
            a if a > 3e-4 => (3, 1000),
            a if a > 3e-5 => (4, 10_000),
            a if a > 3e-6 => (5, 100_000),
            a if a > 3e-7 => (6, 1_000_000),
            _ => (7, 10_000_000),
        };
        Self {
            per_metre,
            decimals: Some(decimals),
        }
    }

    /// Whether whole numbers of units are exact.
    pub(super) fn is_exact(&self) -> bool {
        self.decimals.is_none()
    }

    /// The nearest position.
    fn position(&self, point: &Vector3<f64>) -> Position {
        // Points of a STEP file are within 10¹² m, so that nothing is cut off here.
        [point.x, point.y, point.z].map(|x| (x * self.per_metre as f64).round() as i128)
    }

    /// A frame at `position`, seen from a frame at `from`, both parallel to the assembly's.
    pub(super) fn frame(&self, position: &Position, from: &Position) -> Frame {
        let [x, y, z] = position;
        let [a, b, c] = from;
        Frame::at([x - a, y - b, z - c].map(|units| self.number(units)))
    }

    /// So many units in metres: zeros exact, since what agrees was made equal.
    fn number(&self, units: i128) -> Number {
        let exact = i64::try_from(units)
            .ok()
            .and_then(|units| Number::ratio(units, self.per_metre));
        match (self.decimals, exact) {
            _ if units == 0 => Number::zero(),
            (None, Some(exact)) => exact,
            (decimals, _) => self.literal(units, decimals.unwrap_or(5)),
        }
    }

    fn literal(&self, units: i128, decimals: usize) -> Number {
        let sign = if units < 0 { "-" } else { "" };
        let per_metre = u128::from(self.per_metre.unsigned_abs());
        let size = units.unsigned_abs();
        let text = format!("{sign}{}.{:0decimals$}", size / per_metre, size % per_metre);
        Number::decimal(&text).unwrap_or_else(|_| Number::zero())
    }
}

/// Whether all coordinates are round numbers of a design.
fn are_round(points: &[Vector3<f64>], within: Agreement) -> bool {
    let coordinates = || points.iter().flat_map(|point| point.iter());
    let off = |x: &f64| {
        let units = x * DESIGN as f64;
        (units - units.round()).abs() / DESIGN as f64
    };
    let worst = coordinates().map(off).fold(0.0, f64::max);
    // Numbers that agree, or are each other's negatives, are round together: they count once.
    let different: BTreeSet<u64> = coordinates()
        .map(|x| (x * DESIGN as f64).round().abs() as u64)
        .filter(|units| *units > 0)
        .collect();
    let count = different.len().min(1000) as i32;
    let seldom = |off: f64, files: f64| (2.0 * off * DESIGN as f64).powi(count) * files <= 1.0;
    if worst <= ROUND {
        return count == 0 || seldom(within.printed.max(ROUND), SELDOM);
    }
    worst <= within.length && seldom(within.length, CHANCE)
}

/// Within what positions and directions of a file are the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Agreement {
    /// Of points and axes (m).
    pub length: f64,
    /// Of directions (rad).
    pub angle: f64,
    /// How far coordinates may be off by the digits that they are printed with (m), which may be more than `length`.
    pub printed: f64,
}

impl Agreement {
    /// For a file whose points may be off by `accuracy` (m) and whose directions by `tilt` (rad), in the frames of parts and in those of places:
    /// two directions differ by four times as much at most.
    pub fn of(accuracy: f64, tilt: f64) -> Self {
        Self {
            length: accuracy.clamp(FINEST, COARSEST),
            angle: (4.0 * tilt).clamp(SAME_DIRECTION, MOST_TILTED),
            printed: 0.0,
        }
    }
}

/// Stands joints of these geometries, each with a point where it is drawn if its geometry has none, so that what agrees is the same.
/// With `may_be_exact` round numbers are exact.
pub(super) fn standing(
    joints: &[(Geometry, Vector3<f64>)],
    within: Agreement,
    may_be_exact: bool,
) -> (Grid, Vec<Standing>) {
    let mut agreed = Agreed::new(within);
    let places: Vec<([Option<usize>; 2], Place)> = joints
        .iter()
        .map(|(geometry, drawn)| agreed.place(geometry, drawn))
        .collect();
    agreed.meet();
    let mut points: Vec<Vector3<f64>> = agreed.lines.iter().map(|line| line.point).collect();
    let of_lines = points.len();
    points.extend(&agreed.centres);
    agree_by_coordinates(&mut points, within.length);
    let grid = Grid::new(&points, within, may_be_exact);
    let stand = |(directions, place): &([Option<usize>; 2], Place)| {
        let point = match place {
            Place::Line(line) => points.get(*line).copied(),
            Place::Centre(centre) => points.get(of_lines + centre).copied(),
            Place::Drawn(point) => Some(*point),
        };
        let [axis, axis2] = directions.map(|index| {
            let direction = agreed.directions.get(index?)?;
            Some(written_direction(direction))
        });
        Standing {
            position: grid.position(&point.unwrap_or_else(Vector3::zeros)),
            axis,
            axis2,
        }
    };
    let standing = places.iter().map(stand).collect();
    (grid, standing)
}

/// What fixes the position of a joint.
#[derive(Clone, Copy)]
enum Place {
    /// An axis, by its index.
    Line(usize),
    /// A centre, by its index.
    Centre(usize),
    /// Nothing but the drawing.
    Drawn(Vector3<f64>),
}

/// An axis.
#[derive(Clone, Copy)]
struct Line {
    direction: usize,
    point: Vector3<f64>,
}

/// Directions, axes and centres, each of those that agree once.
struct Agreed {
    within: Agreement,
    directions: Vec<Vector3<f64>>,
    lines: Vec<Line>,
    centres: Vec<Vector3<f64>>,
}

impl Agreed {
    fn new(within: Agreement) -> Self {
        Self {
            within,
            // Before all others, so that what is nearly along one of them is along it.
            directions: vec![Vector3::x(), Vector3::y(), Vector3::z()],
            lines: Vec::new(),
            centres: Vec::new(),
        }
    }

    /// The directions, by their indices, and what fixes the position.
    fn place(&mut self, geometry: &Geometry, drawn: &Vector3<f64>) -> ([Option<usize>; 2], Place) {
        match geometry {
            Geometry::Free => ([None; 2], Place::Drawn(*drawn)),
            Geometry::Direction(direction) => {
                ([self.direction(direction), None], Place::Drawn(*drawn))
            }
            Geometry::Point(point) => ([None; 2], Place::Centre(self.centre(point))),
            Geometry::Line { point, direction } => match self.direction(direction) {
                Some(index) => ([Some(index), None], Place::Line(self.line(point, index))),
                None => ([None; 2], Place::Drawn(*point)),
            },
            Geometry::Cross {
                point,
                first,
                second,
            } => {
                let directions = [self.direction(first), self.direction(second)];
                (directions, Place::Centre(self.centre(point)))
            }
        }
    }

    /// The index of a direction, whichever way it points; `None` of none.
    fn direction(&mut self, direction: &Vector3<f64>) -> Option<usize> {
        let unit = normalised_direction(*direction)?;
        let width = self.within.angle;
        let same = |known: &Vector3<f64>| known.cross(&unit).norm() <= width;
        if let Some(index) = self.directions.iter().position(same) {
            return Some(index);
        }
        let square = unit.map(|x| if x.abs() <= width { 0.0 } else { x });
        self.directions.push(square.normalize());
        Some(self.directions.len() - 1)
    }

    fn centre(&mut self, point: &Vector3<f64>) -> usize {
        let width = self.within.length;
        let same = |known: &Vector3<f64>| (known - point).norm() <= width;
        match self.centres.iter().position(same) {
            Some(index) => index,
            None => {
                self.centres.push(*point);
                self.centres.len() - 1
            }
        }
    }

    fn along(&self, index: usize) -> Vector3<f64> {
        self.directions
            .get(index)
            .copied()
            .unwrap_or_else(Vector3::zeros)
    }

    /// The index of the axis through a point.
    fn line(&mut self, point: &Vector3<f64>, direction: usize) -> usize {
        let along = self.along(direction);
        let same = |line: &Line| {
            let between = point - line.point;
            // Points far apart on one axis are as far beside it as its direction is off.
            let width = self.within.length + self.within.angle * between.norm();
            line.direction == direction && between.cross(&along).norm() <= width
        };
        if let Some(index) = self.lines.iter().position(same) {
            return index;
        }
        // The point nearest to the origin: of an axis along z the one with z = 0.
        let point = point - along * along.dot(point);
        self.lines.push(Line { direction, point });
        self.lines.len() - 1
    }

    /// Lets every axis pass the point where most others cross it, or a centre that lies on it.
    fn meet(&mut self) {
        let count = self.lines.len();
        if count > MOST_AXES {
            return;
        }
        let mut hubs: Vec<(Vector3<f64>, Vec<usize>)> = Vec::new();
        for centre in &self.centres {
            hubs.push((*centre, Vec::new()));
        }
        for first in 0..count {
            for second in first + 1..count {
                let Some(point) = self.crossing(first, second) else {
                    continue;
                };
                let near = |(hub, _): &&mut (Vector3<f64>, Vec<usize>)| {
                    (*hub - point).norm() <= 2.0 * self.within.length
                };
                match hubs.iter_mut().find(near) {
                    Some((_, through)) => through.extend([first, second]),
                    None => hubs.push((point, vec![first, second])),
                }
            }
        }
        for (place, (centre, through)) in hubs.iter_mut().enumerate() {
            if place < self.centres.len() {
                let on = |line: &usize| self.distance(*line, centre) <= self.within.length;
                through.extend((0..count).filter(on));
            }
            through.sort_unstable();
            through.dedup();
        }
        // The sort keeps the order of equal ones: centres first.
        hubs.sort_by_key(|(_, through)| std::cmp::Reverse(through.len()));
        let mut settled = vec![false; count];
        for (hub, through) in &hubs {
            for index in through {
                let free = settled.get_mut(*index).filter(|settled| !**settled);
                if let (Some(settled), Some(line)) = (free, self.lines.get_mut(*index)) {
                    line.point = *hub;
                    *settled = true;
                }
            }
        }
    }

    /// How far a point is from an axis (m).
    fn distance(&self, line: usize, point: &Vector3<f64>) -> f64 {
        match self.lines.get(line) {
            Some(line) => (point - line.point)
                .cross(&self.along(line.direction))
                .norm(),
            None => f64::INFINITY,
        }
    }

    /// The point of two axes that meet.
    fn crossing(&self, first: usize, second: usize) -> Option<Vector3<f64>> {
        let (one, two) = (self.lines.get(first)?, self.lines.get(second)?);
        let (d, e) = (self.along(one.direction), self.along(two.direction));
        let across = d.cross(&e);
        // Nearly parallel ones meet at a point that their digits do not know.
        if across.norm() < 1e-3 {
            return None;
        }
        let between = two.point - one.point;
        let gap = between.dot(&across).abs() / across.norm();
        let along = between.cross(&e).dot(&across) / across.norm_squared();
        (gap <= self.within.length).then(|| one.point + d * along)
    }
}

/// Makes coordinates that agree within `width` (m) one number, those along x, y and z by themselves.
fn agree_by_coordinates(points: &mut [Vector3<f64>], width: f64) {
    for axis in 0..3 {
        let mut order: Vec<(usize, f64)> = points
            .iter()
            .enumerate()
            .map(|(place, point)| (place, point[axis]))
            .collect();
        order.sort_by(|(_, a), (_, b)| a.total_cmp(b));
        let mut first = f64::NEG_INFINITY;
        for (place, value) in order {
            // From the first of those that agree, so that a chain of small steps is no one number.
            if value - first > width {
                first = value;
            }
            if let Some(point) = points.get_mut(place) {
                point[axis] = first;
            }
        }
    }
}

/// A direction as numbers: whole ones along the coordinate axes, hundredths where all three are, decimals otherwise.
fn written_direction(direction: &Vector3<f64>) -> Direction {
    // Of directions in general not one in ten thousand has three such components.
    let hundredths = |x: &f64| (x - (x * 100.0).round() / 100.0).abs() <= SAME_DIRECTION;
    let decimals = match direction.iter().all(hundredths) {
        true => 2,
        false => DIRECTION_DECIMALS,
    };
    let number = |x: f64| {
        if x.abs() <= 0.5e-7 {
            return Number::zero();
        }
        if (x.abs() - 1.0).abs() <= 0.5e-7 {
            return Number::integer(if x > 0.0 { 1 } else { -1 });
        }
        Number::decimal(&format!("{x:.decimals$}")).unwrap_or_else(|_| Number::zero())
    };
    Direction([direction.x, direction.y, direction.z].map(number))
}
