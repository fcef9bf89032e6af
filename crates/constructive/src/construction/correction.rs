//! The drawing corrected: places beside those drawn that have all values.
//!
//! # Why
//! A chain of intersections carries the rounding of its first steps along, and after some hundred of them circles miss that
//! meet in the drawing. All values at once do not: a drawing that has them to rounding is a solution as it is, and one that
//! is a little off is moved onto a solution by Newton's steps for all of them.
//!
//! # The step
//! `min |J x − r|² + µ |x|²`, where J has a row for every constraint and two columns for every element, all in units of length: the
//! two of a line are its turn, times the extent of the drawing, and its offset. Along directions whose singular value is below √µ the
//! values do not say where to go, and second-order terms would carry Newton's step far away; a drawing off by e is off there by √µ e
//! at most, which is rounding already. Solved by the triangle of a sparse QR and seminormal equations (Björck 1996, section 6.6.5).
//!
//! # What is no solution
//! Where the values are not reached to rounding there is no answer: circles that stay apart by more are not made to meet.

use super::shape::{Shape, dot, left, minus, turned};
use crate::sketch::Sketch;
use kutzbach_math::matrix::ordering::plan;
use kutzbach_math::matrix::{Refactoring, SparseMatrix};

/// A coordinate is rounded by half a unit in its last place, a distance to a line by two such and the line's own roundings: sixteen
/// units in the last place of the largest length hold all.
const OPEN: f64 = 16.0 * f64::EPSILON;

/// √µ. The triangle has a condition of some 10⁷ then, whose square times a rounding is 0.02: what every correction leaves.
const DAMPING: f64 = 1e-6;

/// A first solution of the seminormal equations, and corrections of it.
const SOLVES: usize = 4;

/// From six digits two steps lead to all; where many more are needed, they do not lead there.
const MOST_STEPS: usize = 12;

/// Multiplications of one elimination, a second or two: more are not begun.
const MOST_WORK: f64 = 2e9;

/// Whether all values are had to rounding.
#[cfg(test)]
pub(super) fn holds(sketch: &Sketch, shapes: &[Shape]) -> bool {
    Errors::of(sketch, shapes).is_rounding()
}

/// Places that have all values to rounding, by steps from those drawn; the latter, where they have them. `None` where the steps lead
/// to none, or would cost too much.
pub(super) fn corrected(sketch: &Sketch, drawn: &[Shape]) -> Option<Vec<Shape>> {
    let mut places = drawn.to_vec();
    let mut before = f64::INFINITY;
    let mut factors = Refactoring::default();
    for step in 0..=MOST_STEPS {
        let errors = Errors::of(sketch, &places);
        if errors.is_rounding() {
            return Some(places);
        }
        let largest = errors.largest();
        if step == MOST_STEPS || !(largest < before) {
            return None;
        }
        before = largest;
        let matrix = jacobian(sketch, &places, errors.unit)?;
        if step == 0 && work(&matrix) > MOST_WORK {
            return None;
        }
        let mut right = errors.values;
        right.resize(matrix.rows(), 0.0);
        let motion = least(&matrix, &right, &mut factors)?;
        for (place, by) in places.iter_mut().zip(motion.chunks_exact(2)) {
            *place = moved(place, [by[0], by[1]], errors.unit);
        }
    }
    None
}

/// By how much the constraints are missed.
struct Errors {
    /// Value asked for less value had, of every constraint; angles times `unit`.
    values: Vec<f64>,
    /// The largest length: of coordinates, offsets and values.
    unit: f64,
}

impl Errors {
    fn of(sketch: &Sketch, shapes: &[Shape]) -> Self {
        let constraints = sketch.constraints();
        let is_angle = |ends: [usize; 2]| ends.iter().all(|&e| shapes[e].is_line());
        let lengths = constraints.iter().filter(|c| !is_angle(c.ends));
        let lengths = lengths.map(|c| c.value.value().abs());
        let extents = shapes.iter().map(Shape::extent);
        let unit = match extents.chain(lengths).fold(0.0, f64::max) {
            unit if unit > 0.0 => unit,
            _ => 1.0,
        };
        let error = |c: &crate::sketch::Constraint| {
            let [u, v] = c.ends.map(|e| &shapes[e]);
            let off = c.value.value() - super::frame::value_between(u, v);
            match is_angle(c.ends) {
                true => unit * off.sin().atan2(off.cos()),
                false => off,
            }
        };
        Self {
            values: constraints.iter().map(error).collect(),
            unit,
        }
    }

    fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |most, x| most.max(x.abs()))
    }

    fn is_rounding(&self) -> bool {
        self.largest() <= OPEN * self.unit
    }
}

/// J, and √µ times the identity below it; `None` where two points tied to each other coincide.
fn jacobian(sketch: &Sketch, places: &[Shape], unit: f64) -> Option<SparseMatrix<f64>> {
    let (rows, columns) = (sketch.constraints().len(), 2 * places.len());
    let mut entries = Vec::with_capacity(4 * rows + columns);
    for (row, constraint) in sketch.constraints().iter().enumerate() {
        let [u, v] = constraint.ends;
        for (element, by) in [u, v].into_iter().zip(gradients(places, [u, v], unit)?) {
            for (k, derivative) in by.into_iter().enumerate() {
                entries.push((row, 2 * element + k, derivative));
            }
        }
    }
    entries.extend((0..columns).map(|c| (rows + c, c, DAMPING)));
    let matrix = SparseMatrix::from_triplets(rows + columns, columns, 0.0, entries).ok()?;
    let blocks = (0..rows).chain((rows..rows + columns).step_by(2));
    matrix.with_row_blocks(blocks.collect()).ok()
}

/// The derivatives of what is measured between two elements by the two unknowns of either.
fn gradients(places: &[Shape], [u, v]: [usize; 2], unit: f64) -> Option<[[f64; 2]; 2]> {
    let beside = |p: [f64; 2], direction: [f64; 2]| {
        let of_line = [-dot(direction, p) / unit, -1.0];
        (left(direction), of_line)
    };
    Some(match (places[u], places[v]) {
        (Shape::Point(p), Shape::Point(q)) => {
            let across = minus(q, p);
            let length = across[0].hypot(across[1]);
            let unit = (length > 0.0).then(|| across.map(|x| x / length))?;
            [unit.map(|x| -x), unit]
        }
        (Shape::Point(p), Shape::Line { direction, .. }) => {
            let (of_point, of_line) = beside(p, direction);
            [of_point, of_line]
        }
        (Shape::Line { direction, .. }, Shape::Point(p)) => {
            let (of_point, of_line) = beside(p, direction);
            [of_line, of_point]
        }
        (Shape::Line { .. }, Shape::Line { .. }) => [[-1.0, 0.0], [1.0, 0.0]],
    })
}

/// Multiplications that an elimination takes, up to a factor.
fn work(matrix: &SparseMatrix<f64>) -> f64 {
    let block = |b: usize| {
        let rows = matrix.block_rows(b);
        let mut columns: Vec<usize> = rows
            .flat_map(|r| matrix.row(r).iter().map(|e| e.0))
            .collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    };
    let blocks: Vec<Vec<usize>> = (0..matrix.block_count()).map(block).collect();
    let fronts = plan(matrix.columns(), &blocks).fronts;
    let of_front = |pivots: usize, border: usize| {
        let width = (pivots + border) as f64;
        4.0 * pivots as f64 * width * width
    };
    fronts
        .iter()
        .map(|f| of_front(f.pivots.len(), f.border.len()))
        .sum()
}

/// The least-squares solution; `None` where numbers leave their range, or the work was interrupted.
fn least(
    matrix: &SparseMatrix<f64>,
    right: &[f64],
    factors: &mut Refactoring<f64>,
) -> Option<Vec<f64>> {
    let found = factors.factor(matrix, 0.0).ok()?;
    let triangle = (found.exponent == 0).then_some(&found.triangle)?;
    let mut x = vec![0.0; matrix.columns()];
    for _ in 0..SOLVES {
        let image = matrix.multiply(&x).ok()?;
        let open: Vec<f64> = right.iter().zip(&image).map(|(b, y)| b - y).collect();
        let mut more = matrix.multiply_transposed(&open).ok()?;
        triangle.forward_substitute(&mut more);
        triangle.back_substitute(&mut more);
        x.iter_mut().zip(more).for_each(|(x, d)| *x += d);
    }
    x.iter().all(|x| x.is_finite()).then_some(x)
}

fn moved(place: &Shape, by: [f64; 2], unit: f64) -> Shape {
    match *place {
        Shape::Point(p) => Shape::Point([p[0] + by[0], p[1] + by[1]]),
        Shape::Line { direction, offset } => {
            let (sin, cos) = (by[0] / unit).sin_cos();
            Shape::Line {
                direction: turned(direction, [cos, sin]),
                offset: offset + by[1],
            }
        }
    }
}
