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
//! - directions that agree within [`SAME_DIRECTION`] are one, those of the coordinate axes before all others;
//! - axes of one direction whose distance is within the accuracy of the file (at least [`FINEST`]) are one line, with one point;
//! - where axes meet within that accuracy, they pass the same point, that of most of them;
//! - coordinates of points that agree within the accuracy are one number.
//!
//! Positions are whole numbers of units of the last decimal, and positions of joints in links are differences of such: loops close exactly,
//! as the file draws them.
//!
//! The decimals say how well the positions are known: seven (0.1 µm), fewer where the file states that it is coarser. Files state finer
//! accuracies too, but they are those of a kernel's tolerance, and places of parts have passed other programs. Where
//! *every* coordinate is a whole number of [`DESIGN`] within [`ROUND`], the design is one of round numbers: of computed coordinates one in
//! 5000 is so near by chance. These numbers are exact then.

use super::geometry::Geometry;
use kutzbach_math::group::normalised_direction;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Frame};
use nalgebra::Vector3;

/// Directions that differ by less (rad) are the same: what the digits of six-digit directions leave, and a thousandth of what a
/// designer would call a tilt.
pub(super) const SAME_DIRECTION: f64 = 1e-6;

/// Lengths (m) that differ by less are the same: no part is made as exactly.
pub(super) const FINEST: f64 = 1e-7;

/// Lengths (m) that differ by more are never made the same, whatever a file states: what a shaft with the closest fit has as play.
const COARSEST: f64 = 1e-5;

/// The unit of round numbers (per metre): hundredths of a millimetre.
const DESIGN: i64 = 100_000;

/// How near a coordinate is to a round number (m) if it is one: the digits of doubles after a few products.
const ROUND: f64 = 1e-9;

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
    /// The grid for points known to `accuracy` (m), of which `points` have to be on it.
    fn new(points: &[Vector3<f64>], accuracy: f64, may_be_exact: bool) -> Self {
        let mut coordinates = points.iter().flat_map(|point| point.iter());
        let is_round = |x: &f64| {
            let units = x * DESIGN as f64;
            (units - units.round()).abs() <= ROUND * DESIGN as f64
        };
        if may_be_exact && coordinates.all(is_round) {
            return Self {
                per_metre: DESIGN,
                decimals: None,
            };
        }
        let (decimals, per_metre) = match accuracy {
            a if a > 3e-6 => (5, 100_000),
            a if a > 3e-7 => (6, 1_000_000),
            _ => (7, 10_000_000),
        };
        Self {
            per_metre,
            decimals: Some(decimals),
        }
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

/// How far points of a file may be from where they should be (m), where it states `stated`.
pub(super) fn accuracy(stated: f64) -> f64 {
    stated.clamp(FINEST, COARSEST)
}

/// Stands joints of these geometries, each with a point where it is drawn if its geometry has none, so that what agrees within `accuracy`
/// (m) is the same. With `may_be_exact` round numbers are exact.
pub(super) fn standing(
    joints: &[(Geometry, Vector3<f64>)],
    accuracy: f64,
    may_be_exact: bool,
) -> (Grid, Vec<Standing>) {
    let mut agreed = Agreed::new(accuracy);
    let places: Vec<([Option<usize>; 2], Place)> = joints
        .iter()
        .map(|(geometry, drawn)| agreed.place(geometry, drawn))
        .collect();
    agreed.meet();
    let mut points: Vec<Vector3<f64>> = agreed.lines.iter().map(|line| line.point).collect();
    let of_lines = points.len();
    points.extend(&agreed.centres);
    agree_by_coordinates(&mut points, accuracy);
    let grid = Grid::new(&points, accuracy, may_be_exact);
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
    accuracy: f64,
    directions: Vec<Vector3<f64>>,
    lines: Vec<Line>,
    centres: Vec<Vector3<f64>>,
}

impl Agreed {
    fn new(accuracy: f64) -> Self {
        Self {
            accuracy,
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
        let same = |known: &Vector3<f64>| known.cross(&unit).norm() <= SAME_DIRECTION;
        Some(match self.directions.iter().position(same) {
            Some(index) => index,
            None => {
                self.directions.push(unit);
                self.directions.len() - 1
            }
        })
    }

    fn centre(&mut self, point: &Vector3<f64>) -> usize {
        let width = self.accuracy;
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
            let width = self.accuracy + SAME_DIRECTION * between.norm();
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
                    (*hub - point).norm() <= 2.0 * self.accuracy
                };
                match hubs.iter_mut().find(near) {
                    Some((_, through)) => through.extend([first, second]),
                    None => hubs.push((point, vec![first, second])),
                }
            }
        }
        for (place, (centre, through)) in hubs.iter_mut().enumerate() {
            if place < self.centres.len() {
                let on = |line: &usize| self.distance(*line, centre) <= self.accuracy;
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
        (gap <= self.accuracy).then(|| one.point + d * along)
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
    let hundredths = |x: &f64| (x * 100.0 - (x * 100.0).round()).abs() <= 1e-7;
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
