//! Singular poses on a curve: where they are, and how the curve passes through them.
//!
//! At a pose where branches meet, the chosen equations lose rank and say nothing about where the curve goes on. Both the
//! place and the passage are found from poses beside it, none of them nearer than a quarter of a window:
//!
//! - with fixed equations B(τ), a chord c and fixed vectors u, v the bordered system
//!   `B x + u g = 0, c·x = 0, v·x = 1` defines a function g(τ), smooth through the singular pose and zero there
//!   (Griewank & Reddien 1984; Govaerts 2000, chapter 4). It changes sign where branches cross, and touches zero where they
//!   touch. Its polynomial through poses on both sides has the root τ*;
//! - the polynomial of the poses themselves gives the pose at τ*.
//!
//! With twelve poses in a window as wide as two steps, interpolation is off by about the twelfth power of the share that
//! the window has in the distance to the next complex singularity of the curve, times the product of the distances of the
//! middle to the poses: below 1e-12 where steps turn by a tenth of a radian.

use super::curve::Shape;
use super::follow::{Cubic, Node, arc_between, dot, finish, length};
use super::solver::{Along, Solver};
use super::system::SystemPose;
use nalgebra::DMatrix;

/// Places of the poses in a window, on either side, in units of its half width.
const PLACES: [f64; 6] = [0.25, 0.38, 0.53, 0.7, 0.86, 1.0];

/// So often a window is narrowed, and the agreement sought, in steps of the curve.
const ROUNDS: usize = 9;
const AGREEMENT: f64 = 1e-11;

/// Where inner and outer poses disagree by more than this about the root, in steps of the curve, none is believed.
const DOUBTFUL: f64 = 1e-6;

/// Nearer to the middle than this, in units of the half width, poses are interpolated and not corrected.
const BESIDE: f64 = 0.3;

/// A polynomial in one variable with vector coefficients, passing through a singular pose.
#[derive(Clone, Debug)]
pub(super) struct Bridge {
    /// The pose whose chart the coefficients are in.
    reference: SystemPose,
    /// Where the window begins and ends, in its own unit; the singular pose is at zero.
    window: (f64, f64),
    /// Coefficients of 1, x, x², …
    coefficients: Vec<Vec<f64>>,
}

impl Bridge {
    fn x(&self, u: f64) -> f64 {
        self.window.0 + u * (self.window.1 - self.window.0)
    }

    /// Whether a place is far enough from the middle for corrections.
    pub fn is_beside(&self, u: f64) -> bool {
        self.x(u).abs() > BESIDE * 0.5 * (self.window.1 - self.window.0)
    }

    /// Where the singular pose is, from 0 to 1.
    pub fn middle(&self) -> f64 {
        -self.window.0 / (self.window.1 - self.window.0)
    }

    fn at(&self, x: f64) -> Vec<f64> {
        horner(&self.coefficients, x)
    }

    pub fn pose(&self, solver: &Solver, u: f64) -> SystemPose {
        let mut pose = self.reference.clone();
        solver.system.advance(&mut pose, &self.at(self.x(u)));
        pose
    }

    /// The same passage, with turns counted on by this much.
    pub fn shift(&mut self, around: &[f64]) {
        for (value, way) in self.reference.values.iter_mut().zip(around) {
            *value += way;
        }
    }

    /// The velocity in the chart of the reference, per unit of `u`.
    pub fn velocity(&self, u: f64) -> Vec<f64> {
        let x = self.x(u);
        let unit = self.window.1 - self.window.0;
        let derivative: Vec<Vec<f64>> = self
            .coefficients
            .iter()
            .enumerate()
            .skip(1)
            .map(|(k, c)| c.iter().map(|v| v * k as f64 * unit).collect())
            .collect();
        horner(&derivative, x)
    }

    pub fn direction(&self, u: f64) -> Vec<f64> {
        let mut v = self.velocity(u);
        let mut size = length(&v);
        if !(size > 1e-12) {
            // At a cusp: as just behind it.
            v = self.velocity(u + 1e-6);
            size = length(&v);
        }
        v.iter_mut().for_each(|x| *x /= size);
        v
    }

    /// Length of the passage in the metric, by Gauss quadrature with three points in ten pieces.
    pub fn arc(&self) -> f64 {
        let root = 0.6f64.sqrt() / 2.0;
        (0..10)
            .flat_map(|piece| {
                [(0.5 - root, 5.0), (0.5, 8.0), (0.5 + root, 5.0)]
                    .map(|(u, weight)| ((f64::from(piece) + u) / 10.0, weight / 180.0))
            })
            .map(|(u, weight)| length(&self.velocity(u)) * weight)
            .sum()
    }

    /// A passage through poses at places in `[−1, 1]`, the singular one at zero.
    pub fn through(reference: SystemPose, places: &[f64], values: &[Vec<f64>]) -> Self {
        Self {
            reference,
            window: (
                places.first().copied().unwrap_or(-1.0),
                places.last().copied().unwrap_or(1.0),
            ),
            coefficients: interpolate(places, values),
        }
    }

    /// The same passage, the other way.
    pub fn reverse(&mut self) {
        self.window = (-self.window.1, -self.window.0);
        for coefficient in self.coefficients.iter_mut().skip(1).step_by(2) {
            coefficient.iter_mut().for_each(|c| *c = -*c);
        }
    }
}

pub(super) fn horner(coefficients: &[Vec<f64>], x: f64) -> Vec<f64> {
    let size = coefficients.first().map_or(0, Vec::len);
    coefficients.iter().rev().fold(vec![0.0; size], |sum, c| {
        sum.iter().zip(c).map(|(s, c)| s * x + c).collect()
    })
}

/// The polynomial through values at places, by divided differences (Higham 2002, section 5.3).
pub(super) fn interpolate(places: &[f64], values: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let count = places.len();
    let mut table = values.to_vec();
    for order in 1..count {
        for i in (order..count).rev() {
            let gap = places[i] - places[i - order];
            let (low, high) = table.split_at_mut(i);
            for (entry, before) in high[0].iter_mut().zip(&low[i - 1]) {
                *entry = (*entry - before) / gap;
            }
        }
    }
    let size = values.first().map_or(0, Vec::len);
    let mut coefficients = vec![vec![0.0; size]; count];
    for i in (0..count).rev() {
        // p ← p (x − xᵢ) + dᵢ
        for k in (1..count).rev() {
            let (low, high) = coefficients.split_at_mut(k);
            for (c, before) in high[0].iter_mut().zip(&low[k - 1]) {
                *c = before - places[i] * *c;
            }
        }
        for (c, d) in coefficients[0].iter_mut().zip(&table[i]) {
            *c = d - places[i] * *c;
        }
    }
    coefficients
}

/// A singular pose of the curve.
#[derive(Clone, Debug)]
pub(super) struct Singular {
    /// The pose.
    pub pose: SystemPose,
    /// Instantaneous freedom of the part there, nothing held.
    pub freedom: usize,
    /// Whether the bordered function changes its sign.
    pub crosses: bool,
    /// Whether the curve turns back there.
    pub cusp: bool,
    /// How to pass.
    pub bridge: Bridge,
    /// The nodes at both ends of the passage.
    pub before: Node,
    pub after: Node,
}

/// Something to measure along a piece of the curve.
struct Probe<'s> {
    solver: &'s mut Solver,
    nodes: &'s [Node],
    cubics: Vec<Cubic>,
    reference: SystemPose,
    chord: Vec<f64>,
    u: Vec<f64>,
    v: Vec<f64>,
}

struct Reading {
    place: f64,
    z: Vec<f64>,
    g: f64,
    pose: SystemPose,
}

impl Probe<'_> {
    /// The pose and the value of g near an arclength.
    fn read(&mut self, arc: f64) -> Option<Reading> {
        let after = self.nodes.partition_point(|n| n.arc <= arc);
        let segment = after
            .saturating_sub(1)
            .min(self.cubics.len().checked_sub(1)?);
        let (from, to) = (&self.nodes[segment], &self.nodes[segment + 1]);
        let u = (arc - from.arc) / (to.arc - from.arc);
        let mut pose = from.pose.clone();
        self.solver
            .system
            .advance(&mut pose, &self.cubics[segment].at(u));
        self.solver.correct(&mut pose, Along::Across(&self.chord))?;
        if !self.solver.linearise(&pose) {
            return None;
        }
        let mut z = vec![0.0; self.chord.len()];
        self.solver.system.way(&self.reference, &pose, &mut z);
        Some(Reading {
            place: dot(&self.chord, &z),
            z,
            g: self.bordered(),
            pose,
        })
    }

    /// g at the last linearised pose: with p the shortest solution of B p = u and t the tangent, x is a combination of both.
    fn bordered(&self) -> f64 {
        let mut p = vec![0.0; self.chord.len()];
        self.solver.shortest(&self.u, &mut p);
        let tangent = self.solver.tangent();
        let along = dot(&self.chord, &p) / dot(&self.chord, tangent);
        1.0 / (dot(&self.v, &p) - along * dot(&self.v, tangent))
    }
}

/// Looks for a singular pose around node `at` (whose margin is the least around), between the nodes beside it and not
/// nearer to `start` than it is. `home` and `end` bound the window by index.
pub(super) fn locate(
    solver: &mut Solver,
    nodes: &[Node],
    at: usize,
    clear: (f64, f64),
) -> Option<Singular> {
    let low = at.saturating_sub(2);
    let high = (at + 2).min(nodes.len() - 1);
    let nodes = &nodes[low..=high];
    let middle = at - low;
    if nodes.len() < 2 {
        return None;
    }
    let found = locate_in(solver, nodes, middle, clear);
    solver.fix(None);
    found
}

fn locate_in(
    solver: &mut Solver,
    nodes: &[Node],
    middle: usize,
    clear: (f64, f64),
) -> Option<Singular> {
    let reference = nodes[middle].pose.clone();
    let (first, last) = (nodes.first()?, nodes.last()?);
    let n = first.tangent.len();
    let left = &nodes[middle.saturating_sub(1)];
    let right = &nodes[(middle + 1).min(nodes.len() - 1)];
    let mut chord = vec![0.0; n];
    solver.system.way(&left.pose, &right.pose, &mut chord);
    let size = length(&chord);
    chord.iter_mut().for_each(|c| *c /= size);
    // Equations are chosen where they are told apart best, and the bordering where they are not.
    let best = if first.margin > last.margin {
        first
    } else {
        last
    };
    solver.fix(None);
    if !solver.linearise(&best.pose) {
        return None;
    }
    let chosen = solver.chosen();
    solver.fix(Some(chosen));
    if !solver.linearise(&reference) {
        return None;
    }
    let u: Vec<f64> = (0..solver.equations())
        .map(|i| 1.0 + 0.3 * ((i * i + 1) as f64).sin())
        .collect();
    let mut v = vec![0.0; n];
    solver.shortest(&u, &mut v);
    let size = length(&v);
    v.iter_mut().for_each(|x| *x /= size);
    let cubics: Vec<Cubic> = nodes
        .windows(2)
        .map(|pair| Cubic::between(solver, &pair[0], &pair[1]))
        .collect();
    let mut probe = Probe {
        solver,
        nodes,
        cubics,
        reference,
        chord,
        u,
        v,
    };
    // Where g vanishes, roughly: from readings at the nodes.
    let mut seen: Vec<(f64, f64)> = Vec::new();
    for node in nodes {
        if let Some(reading) = probe.read(node.arc) {
            seen.push((node.arc, reading.g));
        }
    }
    let mut centre = rough_root(&seen)?;
    let (left_clear, right_clear) = (centre - clear.0, clear.1 - centre);
    let step = (last.arc - first.arc) / (nodes.len() - 1) as f64;
    let mut half = (1.2 * step)
        .min(centre - first.arc)
        .min(last.arc - centre)
        .min(left_clear)
        .min(right_clear);
    if !(half > 1e-7 * step) {
        return None;
    }
    // The window is narrowed about the root as long as its inner and outer poses agree better and better on where that is.
    let mut best: Option<(f64, Vec<Reading>, Bridge, bool)> = None;
    for _ in 0..ROUNDS {
        half = half
            .min(centre - first.arc)
            .min(last.arc - centre)
            .min(centre - clear.0)
            .min(clear.1 - centre);
        if !(half > 1e-7 * step) {
            break;
        }
        let Some(readings) = window(&mut probe, centre, half) else {
            break;
        };
        let origin = 0.5 * (readings[5].place + readings[6].place);
        let places: Vec<f64> = readings.iter().map(|r| (r.place - origin) / half).collect();
        if !places.windows(2).all(|p| p[0] < p[1]) {
            break;
        }
        let values: Vec<Vec<f64>> = readings.iter().map(|r| vec![r.g]).collect();
        let largest = readings.iter().fold(0.0f64, |m, r| m.max(r.g.abs()));
        let change = (1..readings.len())
            .filter(|&i| (readings[i - 1].g < 0.0) != (readings[i].g < 0.0))
            .min_by_key(|i| i.abs_diff(6));
        let crosses = change.is_some();
        let guess = change.map_or(0.0, |i| {
            let (a, b) = (&readings[i - 1], &readings[i]);
            places[i - 1] + (places[i] - places[i - 1]) * a.g / (a.g - b.g)
        });
        let through = |range: std::ops::Range<usize>| -> Vec<f64> {
            interpolate(&places[range.clone()], &values[range])
                .iter()
                .map(|c| c[0])
                .collect()
        };
        let g = through(0..12);
        let (Some(root), Some(inner)) = (
            root_near(&g, guess, crosses),
            root_near(&through(1..11), guess, crosses),
        ) else {
            break;
        };
        // What the outer two poses change is far more than what further ones would.
        let disagreement = (root - inner).abs() * half / step;
        let polynomial = |x: f64| g.iter().rev().fold(0.0, |s, c| s * x + c);
        let vanishes = polynomial(root).abs() < 1e-6 * largest;
        if vanishes
            && root.abs() < 0.2
            && best
                .as_ref()
                .is_none_or(|(known, ..)| disagreement < *known)
        {
            let shifted: Vec<f64> = places.iter().map(|p| p - root).collect();
            let values: Vec<Vec<f64>> = readings.iter().map(|r| r.z.clone()).collect();
            let bridge = Bridge {
                reference: probe.reference.clone(),
                window: (shifted[0], shifted[11]),
                coefficients: interpolate(&shifted, &values),
            };
            best = Some((disagreement, readings, bridge, crosses));
            if disagreement < AGREEMENT {
                break;
            }
        }
        // The places of arclength and chord agree to first order.
        centre += root * half;
        half *= 0.6;
    }
    let (_, readings, bridge, crosses) = best.filter(|(d, ..)| *d < DOUBTFUL)?;
    conclude(probe, readings, bridge, crosses)
}

/// Readings on both sides of a place.
fn window(probe: &mut Probe<'_>, centre: f64, half: f64) -> Option<Vec<Reading>> {
    let mut readings = Vec::with_capacity(2 * PLACES.len());
    for place in PLACES.iter().rev() {
        readings.push(probe.read(centre - place * half)?);
    }
    for place in PLACES {
        readings.push(probe.read(centre + place * half)?);
    }
    Some(readings)
}

fn conclude(
    probe: Probe<'_>,
    mut readings: Vec<Reading>,
    bridge: Bridge,
    crosses: bool,
) -> Option<Singular> {
    let Probe { solver, nodes, .. } = probe;
    solver.fix(None);
    let pose = bridge.pose(solver, bridge.middle());
    let (with_holds, freedom) = kernels(solver, &pose);
    if with_holds < 2 {
        // The chosen equations depend on one another there, all of them together do not.
        return None;
    }
    let last = readings.pop()?;
    let first = readings.into_iter().next()?;
    let base = &nodes[0];
    let before = finish(solver, first.pose, &bridge.direction(0.0), base)?;
    let mut after = finish(solver, last.pose, &bridge.direction(1.0), base)?;
    after.arc = before.arc + bridge.arc();
    Some(Singular {
        pose,
        freedom,
        crosses,
        cusp: false,
        bridge,
        before,
        after,
    })
}

/// Singular values below this share of the largest vanish at a singular pose: the pose is known to about 1e-12, ordinary
/// margins are above 1e-3, and a margin that falls as the square of a distance of 1e-12 is not told from one that vanishes.
const KERNEL: f64 = 1e-8;

/// Dimensions of the kernel at a pose: with what is held, and with nothing held.
pub(super) fn kernels(solver: &mut Solver, pose: &SystemPose) -> (usize, usize) {
    let held = solver.holds().len();
    let rows = solver.dense_jacobian(pose);
    let columns = solver.system.unknowns();
    let kernel = |rows: &[f64]| {
        let matrix = DMatrix::from_row_slice(rows.len() / columns.max(1), columns, rows);
        let values = matrix.singular_values();
        let largest = values.iter().fold(0.0f64, |m, s| m.max(*s));
        columns - values.iter().filter(|s| **s > KERNEL * largest).count()
    };
    (kernel(&rows), kernel(&rows[..rows.len() - held * columns]))
}

/// Where g vanishes between readings, or comes closest to zero.
fn rough_root(seen: &[(f64, f64)]) -> Option<f64> {
    let crossing = seen
        .windows(2)
        .filter(|p| (p[0].1 < 0.0) != (p[1].1 < 0.0))
        .min_by(|a, b| (a[0].1.abs() + a[1].1.abs()).total_cmp(&(b[0].1.abs() + b[1].1.abs())));
    if let Some(pair) = crossing {
        let ((s, a), (t, b)) = (pair[0], pair[1]);
        return Some(s + (t - s) * a / (a - b));
    }
    // The parabola through the least value and its neighbours.
    let least = (0..seen.len()).min_by(|a, b| seen[*a].1.abs().total_cmp(&seen[*b].1.abs()))?;
    if least == 0 || least + 1 >= seen.len() {
        return None;
    }
    let [(x0, y0), (x1, y1), (x2, y2)] = [seen[least - 1], seen[least], seen[least + 1]];
    let (d0, d1) = ((y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1));
    let bend = (d1 - d0) / (x2 - x0);
    let root = 0.5 * (x0 + x1) - 0.5 * d0 / bend;
    (root > x0 && root < x2).then_some(root)
}

/// The root of a polynomial near a guess; where it does not change sign, that of its derivative.
fn root_near(coefficients: &[f64], guess: f64, crosses: bool) -> Option<f64> {
    let derivative = |c: &[f64]| -> Vec<f64> {
        c.iter()
            .enumerate()
            .skip(1)
            .map(|(k, c)| c * k as f64)
            .collect()
    };
    let own = if crosses {
        coefficients.to_vec()
    } else {
        derivative(coefficients)
    };
    let slope = derivative(&own);
    let value = |c: &[f64], x: f64| c.iter().rev().fold(0.0, |s, c| s * x + c);
    let mut x = guess;
    for _ in 0..60 {
        let step = value(&own, x) / value(&slope, x);
        x -= step;
        if !x.is_finite() || x.abs() > 2.0 {
            return None;
        }
        if step.abs() < 1e-15 {
            break;
        }
    }
    Some(x)
}

/// The nodes of a curve, each with the passage that begins at it.
pub(super) type Pieces = Vec<(Node, Option<Singular>)>;

/// The pieces of a closed curve without cusps, given by its nodes from the start to the start. It is cut open where it is
/// most regular, so that no passage lies across the cut, and put together again.
pub(super) fn bridge_closed(solver: &mut Solver, nodes: &[Node]) -> Pieces {
    let (Some(first), Some(last)) = (nodes.first(), nodes.last()) else {
        return Vec::new();
    };
    let around: Vec<f64> = first
        .pose
        .values
        .iter()
        .zip(&last.pose.values)
        .map(|(a, b)| b - a)
        .collect();
    let cut = (0..nodes.len() - 1)
        .max_by(|a, b| nodes[*a].margin.total_cmp(&nodes[*b].margin).then(b.cmp(a)))
        .unwrap_or(0);
    let span = last.arc - first.arc;
    let mut turned: Vec<Node> = nodes[cut..].to_vec();
    turned.extend(nodes[1..=cut].iter().map(|node| {
        let mut node = node.clone();
        node.arc += span;
        shift(&mut node, &around);
        node
    }));
    let mut start = nodes.len() - 1 - cut;
    let pieces = bridge_open(solver, &turned, &mut start);
    if cut == 0 {
        return pieces;
    }
    // The start first again; what came before it comes last, counted on.
    let back: Vec<f64> = around.iter().map(|x| -x).collect();
    let mut whole: Pieces = Vec::with_capacity(pieces.len());
    for (mut node, singular) in pieces[start..pieces.len() - 1].iter().cloned() {
        shift(&mut node, &back);
        let singular = singular.map(|mut s| {
            s.bridge.shift(&back);
            shift_pose(&mut s.pose, &back);
            s
        });
        whole.push((node, singular));
    }
    whole.extend(pieces[..=start].iter().cloned());
    whole
}

fn shift(node: &mut Node, around: &[f64]) {
    shift_pose(&mut node.pose, around);
}

fn shift_pose(pose: &mut SystemPose, around: &[f64]) {
    for (value, way) in pose.values.iter_mut().zip(around) {
        *value += way;
    }
}

/// The pieces of a list of nodes: those inside a passage left out, and every passage with the node it begins at. `start` is
/// the index of a node that stays one.
pub(super) fn bridge_open(solver: &mut Solver, nodes: &[Node], start: &mut usize) -> Pieces {
    let margins: Vec<f64> = nodes.iter().map(|n| n.margin).collect();
    let mut candidates: Vec<usize> = (1..nodes.len().saturating_sub(1))
        .filter(|&i| margins[i] <= margins[i - 1] && margins[i] < margins[i + 1])
        .collect();
    // A singular pose close to an end shows as the least margin there.
    if nodes.len() > 3 && margins[0] < margins[1] {
        candidates.insert(0, 1);
    }
    if nodes.len() > 3 && margins[nodes.len() - 1] < margins[nodes.len() - 2] {
        candidates.push(nodes.len() - 2);
    }
    let mut found: Vec<Singular> = Vec::new();
    let begin = nodes[*start].arc;
    for at in candidates {
        let mut clear = (f64::NEG_INFINITY, f64::INFINITY);
        if let Some(last) = found.last() {
            clear.0 = last.after.arc;
        }
        // The start stays outside; where it is the candidate itself, both sides of it are looked at.
        let sides = match nodes[at].arc.total_cmp(&begin) {
            std::cmp::Ordering::Greater if at <= *start + 2 => {
                vec![(begin, clear.1), (clear.0, begin)]
            }
            std::cmp::Ordering::Greater => vec![(clear.0.max(begin), clear.1)],
            std::cmp::Ordering::Less if at + 2 >= *start => {
                vec![(clear.0, begin), (begin, clear.1)]
            }
            std::cmp::Ordering::Less => vec![(clear.0, begin)],
            std::cmp::Ordering::Equal => vec![(clear.0, begin), (begin, clear.1)],
        };
        for side in sides {
            let Some(mut singular) = locate(solver, nodes, at, side) else {
                continue;
            };
            place(solver, nodes, &mut singular);
            if found
                .last()
                .is_none_or(|l| singular.before.arc >= l.after.arc - 1e-12)
            {
                found.push(singular);
                break;
            }
        }
    }
    let mut kept: Vec<(Node, Option<Singular>)> = Vec::new();
    let mut pending = found.into_iter().peekable();
    let mut new_start = 0;
    for (index, node) in nodes.iter().enumerate() {
        while pending
            .peek()
            .is_some_and(|s| s.before.arc <= node.arc - 1e-12)
        {
            if let Some(singular) = pending.next() {
                let after = singular.after.clone();
                kept.push((singular.before.clone(), Some(singular)));
                kept.push((after, None));
            }
        }
        let inside = kept
            .last()
            .is_some_and(|(last, _)| node.arc <= last.arc + 1e-9 * (1.0 + last.arc.abs()));
        if index == *start {
            if inside && kept.len() > 1 && kept.last().is_some_and(|(_, s)| s.is_none()) {
                kept.pop();
            }
            new_start = kept.len();
            kept.push((node.clone(), None));
        } else if !inside {
            kept.push((node.clone(), None));
        }
    }
    *start = new_start;
    kept
}

/// What a curve consists of.
pub(super) struct Assembled {
    pub nodes: Vec<Node>,
    /// Between neighbouring nodes.
    pub shapes: Vec<Shape>,
    /// Singular poses with their arclengths.
    pub singular: Vec<(f64, Singular)>,
}

/// Arclengths along the pieces, counted from the start; shapes between nodes.
pub(super) fn assemble(solver: &Solver, pieces: Pieces, start: usize) -> Assembled {
    let mut shapes = Vec::new();
    let mut singular = Vec::new();
    let mut arc = 0.0;
    let mut arcs = vec![0.0];
    for pair in pieces.windows(2) {
        let (shape, gap) = match &pair[0].1 {
            Some(passed) => {
                let length = passed.bridge.arc();
                singular.push((arc + passed.bridge.middle() * length, passed.clone()));
                (Shape::Bridge(Box::new(passed.bridge.clone())), length)
            }
            None => {
                let (a, b) = (&pair[0].0, &pair[1].0);
                (
                    Shape::Cubic(Cubic::between(solver, a, b)),
                    arc_between(solver, a, b),
                )
            }
        };
        shapes.push(shape);
        arc += gap;
        arcs.push(arc);
    }
    let zero = arcs.get(start).copied().unwrap_or(0.0);
    for entry in &mut singular {
        entry.0 -= zero;
    }
    let nodes = pieces
        .into_iter()
        .zip(&arcs)
        .map(|((mut node, _), arc)| {
            node.arc = arc - zero;
            node
        })
        .collect();
    Assembled {
        nodes,
        shapes,
        singular,
    }
}

/// The arclengths of a passage on the curve it belongs to.
fn place(solver: &Solver, nodes: &[Node], singular: &mut Singular) {
    let nearest = |node: &Node| {
        let mut way = vec![0.0; node.tangent.len()];
        let mut best = nodes[0].arc;
        let mut least = f64::INFINITY;
        for known in nodes {
            solver.system.way(&known.pose, &node.pose, &mut way);
            let far = length(&way);
            if far < least {
                least = far;
                let ahead = dot(&way, &known.tangent);
                best = known.arc + far.copysign(ahead);
            }
        }
        best
    };
    singular.before.arc = nearest(&singular.before);
    singular.after.arc = nearest(&singular.after);
}
