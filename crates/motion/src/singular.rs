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

use super::bridge::{Bridge, interpolate};
use super::cubic::Cubic;
use super::node::{Node, finish};
use super::solver::{Along, Solver};
use super::system::SystemPose;
use super::vectors::{dot, length};

/// Places of the poses in a window, on either side, in units of its half width.
const PLACES: [f64; 6] = [0.25, 0.38, 0.53, 0.7, 0.86, 1.0];

/// So often a window is narrowed, and the agreement sought, in steps of the curve.
const ROUNDS: usize = 9;
const AGREEMENT: f64 = 1e-11;

/// A least value of g that the parabola does not bring below this share of the largest around is not taken for zero. Where g
/// touches zero the parabola is off by the next orders only, which are far smaller.
const NEARLY_ZERO: f64 = 0.5;

/// Where inner and outer poses disagree by more than this about the root, in steps of the curve, none is believed.
const DOUBTFUL: f64 = 1e-6;

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

    /// The value of g at a node.
    fn at_node(&mut self, node: &Node) -> Option<f64> {
        self.solver.linearise(&node.pose).then(|| self.bordered())
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
    let (u, v) = bordering(solver, &reference);
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
        if let Some(g) = probe.at_node(node) {
            seen.push((node.arc, g));
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
            let bridge = Bridge::through(probe.reference.clone(), &shifted, &values);
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

/// Up to so many unknowns singular vectors are computed.
const BORDERED_UNKNOWNS: usize = 150;

/// The fixed vectors u (by equation) and v of the bordered system: singular vectors of the chosen equations for their least
/// singular value, which at the singular pose span what the equations lose (Govaerts 2000, section 3.2). With others g has
/// poles, and one of them may be next to its zero. For large or shaky parts, where the singular vectors are not at hand, u is
/// in general position and v what the equations make of it.
fn bordering(solver: &mut Solver, reference: &SystemPose) -> (Vec<f64>, Vec<f64>) {
    let n = solver.system.unknowns();
    let chosen = solver.chosen();
    let mut u: Vec<f64> = (0..solver.equations())
        .map(|i| 1.0 + 0.3 * ((i * i + 1) as f64).sin())
        .collect();
    let mut v = vec![0.0; n];
    if n <= BORDERED_UNKNOWNS && !solver.is_deflated() && chosen.len() < n {
        let rows = solver.dense_jacobian(reference);
        let matrix = faer::Mat::from_fn(chosen.len(), n, |i, j| rows[chosen[i] * n + j]);
        // Singular values come in descending order; the least is the last.
        if let (Ok(parts), Some(least)) = (matrix.svd(), chosen.len().checked_sub(1)) {
            u.fill(0.0);
            for (i, &equation) in chosen.iter().enumerate() {
                u[equation] = parts.U()[(i, least)];
            }
            v.iter_mut()
                .enumerate()
                .for_each(|(j, x)| *x = parts.V()[(j, least)]);
            return (u, v);
        }
    }
    solver.shortest(&u, &mut v);
    let size = length(&v);
    v.iter_mut().for_each(|x| *x /= size);
    (u, v)
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
        let count = rows.len() / columns.max(1);
        let matrix = faer::Mat::from_fn(count, columns, |i, j| rows[i * columns + j]);
        // Of what is not finite no value is known not to vanish.
        let values = matrix.singular_values().unwrap_or_default();
        let largest = values.iter().fold(0.0f64, |m, s| m.max(*s));
        columns - values.iter().filter(|s| **s > KERNEL * largest).count()
    };
    let with_holds = kernel(&rows);
    let freedom = match held {
        0 => with_holds,
        _ => kernel(&rows[..rows.len() - held * columns]),
    };
    (with_holds, freedom)
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
    let there = y0 + (root - x0) * (d0 + (root - x1) * bend);
    let largest = seen.iter().fold(0.0f64, |m, (_, y)| m.max(y.abs()));
    (root > x0 && root < x2 && there.abs() < NEARLY_ZERO * largest).then_some(root)
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::follow::follow;
    use crate::pieces::bridge_closed;
    use crate::samples::at_home;
    use kutzbach_closure::samples::{CRANK_ROCKER, Written, planar, ring};

    fn met(points: &[[f64; 2]]) -> Vec<Singular> {
        let mechanism = ring(&planar(points), [0.0; 3], Written::Exactly);
        let (mut solver, start) = at_home(&mechanism);
        let (nodes, _) = follow(&mut solver, &start, &start, &[], f64::INFINITY);
        let pieces = bridge_closed(&mut solver, &nodes);
        pieces.into_iter().filter_map(|(_, s)| s).collect()
    }

    #[test]
    fn a_parallelogram_is_singular_where_it_is_flat() {
        let found = met(&[[0.0, 0.0], [1.0, 2.0], [4.0, 2.0], [3.0, 0.0]]);
        assert_eq!(found.len(), 2);
        let crank = 2.0f64.atan2(1.0);
        for singular in &found {
            assert_eq!((singular.freedom, singular.crosses), (2, true));
            let angle = crank + singular.pose.values[0];
            assert!(angle.sin().abs() < 1e-11, "{angle}");
        }
    }

    #[test]
    fn a_crank_and_rocker_is_never_singular() {
        assert!(met(&CRANK_ROCKER).is_empty());
    }

    #[test]
    fn roots_are_those_of_the_polynomial() {
        // (x − 0.1)(x + 3), and a square that touches zero at −0.05.
        assert!((root_near(&[-0.3, 2.9, 1.0], 0.0, true).unwrap() - 0.1).abs() < 1e-15);
        let touching = [0.0025, 0.1, 1.0];
        assert!((root_near(&touching, 0.0, false).unwrap() + 0.05).abs() < 1e-15);
        let seen = [(0.0, 4.0), (1.0, 1.0), (2.0, 0.5), (3.0, 2.0)];
        let least = rough_root(&seen).unwrap();
        assert!(least > 1.0 && least < 3.0);
        assert_eq!(rough_root(&[(0.0, -1.0), (1.0, 3.0)]), Some(0.25));
        assert_eq!(rough_root(&[(0.0, 1.0), (1.0, 2.0)]), None);
    }
}
