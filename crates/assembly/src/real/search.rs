//! Subdivision: boxes are dropped, proven to hold one solution, made smaller, or cut in two.

use super::chart::{self, Chart, REACH};
use super::interval::Interval;
use super::krawczyk::image;
use super::tensor::{BEYOND, Tensor};
use crate::reduced::ReducedSystem;
use kutzbach_algebra::{Budget, Stop};

/// Sides below which a box is left open: coordinates are of size one, known to some 10⁻¹⁴, and a simple solution is
/// proven long before.
const SMALLEST: f64 = 1.0 / (1 << 22) as f64;

/// How far a box is widened on every side, in its own length, before a solution is proven in it: solutions on a face are then
/// inside.
const WIDER: f64 = 0.25;

/// How far rounding may move a box: every cut moves its ends by at most 2⁻⁵², and there are below a hundred.
const SLACK: f64 = 1e-13;

/// A box in a chart.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub(super) chart: usize,
    pub(super) sides: Vec<Interval>,
    tensors: Vec<Tensor>,
}

/// A solution that was proven.
#[derive(Clone, Debug)]
pub(super) struct Proven {
    pub(super) chart: usize,
    /// Where it is.
    pub(super) at: Vec<Interval>,
    /// Where no other one is.
    alone: Vec<Interval>,
    /// The equations that prove it.
    pub(super) used: Vec<usize>,
}

/// What a search found.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub(super) proven: Vec<Proven>,
    /// Boxes that may hold solutions, as chart and sides.
    pub(super) open: Vec<(usize, Vec<Interval>)>,
    /// Boxes looked at.
    pub(super) boxes: usize,
    /// Why it ended early.
    pub(super) stopped: Option<Stop>,
    /// Whether it ended because too many boxes stayed open.
    pub(super) crowded: bool,
}

/// Effort of a box for each coefficient of its equations and each variable: slopes, Krawczyk's operator, and cuts, several times over.
const EFFORT_OF_COEFFICIENT: u64 = 8;

/// Boxes left open after which a search ends: isolated solutions leave a few each, curves thousands.
const MOST_OPEN: usize = 600;

/// Boxes are not made smaller than this, in shares by which coefficients may be off: what these leave open covers some boxes.
const IN_SHARES: f64 = 4.0;

/// The largest box that is made smaller in any case.
const LARGEST: f64 = 1.0 / 32.0;

/// Searches all boxes of all charts. What is found holds for all equations whose coefficients are within a share of the largest
/// one of those given of the same kind: lengths, or squares of lengths.
pub(super) fn search(
    system: &ReducedSystem,
    charts: &[Chart],
    share: f64,
    budget: &Budget,
) -> Found {
    let scales = chart::scales(system);
    let count = system.freedom();
    let mut found = Found::default();
    for (index, chart) in charts.iter().enumerate() {
        let sides = vec![Interval::new(-REACH, REACH); count];
        // What is not looked at any more stays open as it is.
        if found.stopped.is_some() {
            found.boxes += 1;
            found.open.push((index, sides));
            continue;
        }
        let mut tensors = chart::tensors(system, &scales, chart);
        let sizes = chart::sizes(system, &tensors);
        for (tensor, size) in tensors.iter_mut().zip(sizes) {
            tensor.widen(share * size);
        }
        let mut waiting = vec![Cell {
            chart: index,
            sides,
            tensors,
        }];
        while let Some(cell) = waiting.pop() {
            found.boxes += 1;
            let entries = cell
                .tensors
                .iter()
                .map(|t| t.coefficients.len())
                .sum::<usize>() as u64;
            if let Err(stop) = budget
                .toil(EFFORT_OF_COEFFICIENT * count as u64 * entries)
                .and_then(|()| budget.spend(1))
            {
                found.stopped = Some(stop);
            }
            if found.stopped.is_some() || found.crowded {
                found.open.push((cell.chart, cell.sides));
                continue;
            }
            let least = (IN_SHARES * share).clamp(SMALLEST, LARGEST);
            examine(system, charts, cell, least, &mut waiting, &mut found);
            found.crowded = found.open.len() > MOST_OPEN;
        }
    }
    found
}

fn examine(
    system: &ReducedSystem,
    charts: &[Chart],
    mut cell: Cell,
    least: f64,
    waiting: &mut Vec<Cell>,
    found: &mut Found,
) {
    let count = cell.sides.len();
    let known = |cell: &Cell, found: &Found| {
        found.proven.iter().any(|other| {
            let pairs = cell.sides.iter().zip(&other.alone);
            other.chart == cell.chart && pairs.into_iter().all(|(a, b)| a.inside(*b))
        })
    };
    loop {
        if known(&cell, found) {
            return;
        }
        if cell
            .tensors
            .iter()
            .any(|t| t.range().0 > 0.0 || t.range().1 < 0.0)
        {
            return;
        }
        let Some(first) = image(&cell.tensors, count) else {
            break;
        };
        let cube = Interval::new(0.0, 1.0);
        if first.image.iter().any(|k| k.misses(cube)) {
            return;
        }
        // Where K is shorter than the box there is hope that the wider box holds one solution.
        if first.image.iter().all(|k| k.width() < 1.0)
            && let Some(one) = prove(&cell)
        {
            if let Some(proven) = one {
                add(system, charts, proven, found);
            }
            return;
        }
        // Cut off what K leaves out, at sixty-fourths.
        let mut shrunk = false;
        for (variable, k) in first.image.iter().enumerate() {
            let a = ((k.low.max(0.0) * 64.0).floor() / 64.0).min(1.0);
            let b = ((k.high.min(1.0) * 64.0).ceil() / 64.0).max(0.0);
            if b - a < 0.75 && b > a {
                cell.cut(variable, a, b);
                shrunk = true;
            }
        }
        if !shrunk || cell.longest() < least {
            // What is unknown of the equations may be more than the box: then a larger one around the place holds one solution.
            if cell.tensors.iter().any(Tensor::is_unknown)
                && let Some(Some(proven)) = prove_around(&cell, &first.image)
            {
                add(system, charts, proven, found);
                if known(&cell, found) {
                    return;
                }
            }
            break;
        }
    }
    if cell.longest() < least {
        found.open.push((cell.chart, cell.sides));
        return;
    }
    let variable = cell.steepest();
    let mut upper = cell.clone();
    cell.cut(variable, 0.0, 0.5);
    upper.cut(variable, 0.5, 1.0);
    waiting.push(upper);
    waiting.push(cell);
}

impl Cell {
    fn longest(&self) -> f64 {
        self.sides.iter().fold(0.0, |m: f64, s| m.max(s.width()))
    }

    /// Keeps the part from `a` to `b` along a variable.
    fn cut(&mut self, variable: usize, a: f64, b: f64) {
        let side = self.sides[variable];
        let at = |t: f64| {
            if t == 1.0 {
                side.high
            } else {
                side.low + t * side.width()
            }
        };
        self.sides[variable] = Interval::new(at(a), at(b));
        self.tensors
            .iter_mut()
            .for_each(|t| t.restrict(variable, a, b));
    }

    /// The same, where something of the equations is unknown no farther out than that is bounded.
    fn cut_in_reach(&mut self, variable: usize, a: f64, b: f64) {
        const OUTERMOST: f64 = REACH * (1.0 + 2.0 * BEYOND);
        if !self.tensors.iter().any(Tensor::is_unknown) {
            return self.cut(variable, a, b);
        }
        let side = self.sides[variable];
        let at = |x: f64| (x - side.low) / side.width();
        self.cut(variable, a.max(at(-OUTERMOST)), b.min(at(OUTERMOST)));
    }

    /// The variable along which the equations change most, of those that are not short already.
    fn steepest(&self) -> usize {
        let long = 0.05 * self.longest();
        let change = |v: usize| {
            let slope = |t: &Tensor| {
                let (low, high) = t.slope(v);
                low.abs().max(high.abs())
                    / t.coefficients
                        .iter()
                        .fold(1e-300, |m: f64, c| m.max(c.abs()))
            };
            self.tensors.iter().map(slope).fold(0.0, f64::max)
        };
        (0..self.sides.len())
            .filter(|&v| self.sides[v].width() >= long)
            .max_by(|&a, &b| change(a).total_cmp(&change(b)).then(b.cmp(&a)))
            .unwrap_or(0)
    }
}

/// How many times as long as K the boxes around it are, in which a solution is looked for.
const AROUND: [f64; 2] = [2.5, 5.0];

/// Tries to prove one solution in boxes around K, as long as these are not far larger than the box.
fn prove_around(cell: &Cell, image: &[Interval]) -> Option<Option<Proven>> {
    const MOST: f64 = 64.0;
    if image.iter().any(|k| !(k.width() < MOST)) {
        return None;
    }
    AROUND.into_iter().find_map(|times| {
        let mut around = cell.clone();
        for (variable, k) in image.iter().enumerate() {
            let half = 0.5 * times * k.width();
            around.cut_in_reach(variable, k.middle() - half, k.middle() + half);
        }
        prove_in(around)
    })
}

/// Tries to prove one solution of as many equations as unknowns in a box made a little wider.
fn prove(cell: &Cell) -> Option<Option<Proven>> {
    let mut wider = cell.clone();
    for variable in 0..wider.sides.len() {
        wider.cut_in_reach(variable, -WIDER, 1.0 + WIDER);
    }
    prove_in(wider)
}

/// Tries to prove one solution in a box; then makes it as narrow as rounding allows. Inside, `None` where another equation does not
/// hold there.
fn prove_in(mut cell: Cell) -> Option<Option<Proven>> {
    let count = cell.sides.len();
    let cube = Interval::new(0.0, 1.0);
    let first = image(&cell.tensors, count)?;
    if !first.image.iter().all(|k| k.inside(cube)) {
        return None;
    }
    let alone = cell.sides.clone();
    let used = first.used;
    let mut next = first.image;
    for _ in 0..40 {
        let before = cell.longest();
        for (variable, k) in next.iter().enumerate() {
            // A box of no length has no slopes.
            let (a, b) = (k.low.max(0.0), k.high.min(1.0));
            let margin = if b - a < 1e-6 { 1e-6 } else { 0.0 };
            cell.cut(variable, (a - margin).max(0.0), (b + margin).min(1.0));
        }
        if cell.longest() < 1e-12 || cell.longest() > 0.999 * before {
            break;
        }
        match image(&cell.tensors, count) {
            Some(image) => next = image.image,
            None => break,
        }
    }
    if cell
        .tensors
        .iter()
        .any(|t| t.range().0 > 0.0 || t.range().1 < 0.0)
    {
        return Some(None);
    }
    let widened = |s: &Interval| Interval::new(s.low - SLACK, s.high + SLACK);
    Some(Some(Proven {
        chart: cell.chart,
        at: cell.sides.iter().map(widened).collect(),
        alone: alone
            .iter()
            .map(|s| Interval::new(s.low + SLACK, s.high - SLACK))
            .collect(),
        used,
    }))
}

/// Adds a solution unless it is one that was found in a neighbouring box or chart.
fn add(system: &ReducedSystem, charts: &[Chart], proven: Proven, found: &mut Found) {
    let known = found.proven.iter().any(|other| {
        let here = if other.chart == proven.chart {
            Some(proven.at.clone())
        } else {
            chart::moved(
                system,
                &charts[proven.chart],
                &proven.at,
                &charts[other.chart],
            )
        };
        // The only solution there is in `alone` is the other one.
        here.is_some_and(|at| at.iter().zip(&other.alone).all(|(a, b)| a.inside(*b)))
    });
    if !known {
        found.proven.push(proven);
    }
}
