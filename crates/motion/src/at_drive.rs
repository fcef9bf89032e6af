//! Poses of a curve by the value of the driven variable.

use super::cubic::Cubic;
use super::curve::{Curve, CurvePose, Shape};
use super::solver::Along;
use super::system::SystemPose;
use super::vectors::dot;

/// A driven variable that moves by less than this share of the arclength singles out no pose.
const SLOWEST: f64 = 1e-3;

impl Curve {
    /// The values of the driven variable that the curve reaches without turning back, from its start; infinite where it
    /// goes round.
    #[must_use]
    pub fn drive_range(&self) -> (f64, f64) {
        let (from, to) = self.stretch();
        let goes_on = |value: f64, other: f64| {
            if value > other {
                f64::INFINITY
            } else {
                f64::NEG_INFINITY
            }
        };
        let last = self.milestones.len().saturating_sub(1);
        let (Some(a), Some(b)) = (self.milestones.get(from), self.milestones.get(to)) else {
            return (f64::NAN, f64::NAN);
        };
        if self.closed && from == 0 && to == last {
            let (low, high) = (goes_on(a.1, b.1), goes_on(b.1, a.1));
            return (low.min(high), low.max(high));
        }
        let before = self.stretch_before().map(|begin| {
            let around = self.milestones[last].1 - self.milestones[0].1;
            self.milestones[begin].1 - around
        });
        let begin = before.unwrap_or(a.1);
        (begin.min(b.1), begin.max(b.1))
    }

    /// Where the stretch around the start begins behind the end of a closed curve: the curve is told from its start, which need not
    /// be a place where the driven variable turns back.
    fn stretch_before(&self) -> Option<usize> {
        let m = &self.milestones;
        let (from, to) = self.stretch();
        let last = m.len().saturating_sub(1);
        if !self.closed || from > 0 || to == last {
            return None;
        }
        let rising = m[to].1 > m[from].1;
        let mut begin = last;
        while begin > to && (m[begin].1 > m[begin - 1].1) == rising && m[begin].1 != m[begin - 1].1
        {
            begin -= 1;
        }
        (begin < last).then_some(begin)
    }

    /// The milestones between which the driven variable is monotonic, around the start of the curve.
    pub(super) fn stretch(&self) -> (usize, usize) {
        let m = &self.milestones;
        if m.len() < 2 {
            return (0, 0);
        }
        // The pair that has the start inside; where the start is a dead centre, the one ahead.
        let first = m
            .windows(2)
            .position(|pair| pair[1].0 > 1e-12)
            .unwrap_or(m.len() - 2);
        let rising = m[first + 1].1 > m[first].1;
        let same = |i: usize| (m[i + 1].1 > m[i].1) == rising && m[i + 1].1 != m[i].1;
        let mut from = first;
        while from > 0 && same(from - 1) {
            from -= 1;
        }
        let mut to = first + 1;
        while to + 1 < m.len() && same(to) {
            to += 1;
        }
        (from, to)
    }

    /// The pose at which the driven variable has a value (rad, m), on the stretch around the start on which it does not
    /// turn back; `None` where it is not reached there.
    pub fn pose_at_drive(&mut self, value: f64) -> Option<CurvePose> {
        let (low, high) = self.drive_range();
        if !(value >= low - 1e-12 && value <= high + 1e-12) {
            return None;
        }
        let (mut from, mut to) = self.stretch();
        let (a, b) = (self.milestones[from], self.milestones[to]);
        let mut wanted = value;
        let mut turns = 0.0;
        if self.closed && low.is_infinite() {
            let around = b.1 - a.1;
            turns = ((value - a.1) / around).floor();
            wanted = value - turns * around;
        } else if let Some(begin) = self
            .stretch_before()
            .filter(|_| (value < a.1) == (b.1 > a.1) && value != a.1)
        {
            (from, to) = (begin, self.milestones.len() - 1);
            wanted = value + self.milestones[to].1 - self.milestones[0].1;
            turns = -1.0;
        }
        let inside = &self.milestones[from..=to];
        let rising = inside[inside.len() - 1].1 > inside[0].1;
        let place = inside
            .partition_point(|m| if rising { m.1 <= wanted } else { m.1 >= wanted })
            .clamp(1, inside.len() - 1);
        let (start, end) = (inside[place - 1], inside[place]);
        let mut found = self.solve_drive(start, end, wanted)?;
        let (first, last) = self.arclengths();
        found.arclength += turns * (last - first);
        if turns != 0.0 {
            let around = self.winding();
            for (value, way) in found.pose.values.iter_mut().zip(around) {
                *value += turns * way;
            }
        }
        Some(found)
    }

    /// The pose nearest to the start along the curve at which the driven variable has a value (rad, m), wherever it turns back on the
    /// way; `None` where the curve does not have it.
    pub fn nearest_at_drive(&mut self, value: f64) -> Option<CurvePose> {
        let (first, last) = self.arclengths();
        let around = last - first;
        let distance = |arclength: f64| match self.closed {
            true => arclength.abs().min(around - arclength.abs()),
            false => arclength.abs(),
        };
        let pairs = self.milestones.windows(2).map(|pair| (pair[0], pair[1]));
        let mut holding: Vec<_> = pairs
            .filter(|(a, b)| a.1.min(b.1) <= value && value <= a.1.max(b.1))
            .collect();
        holding.sort_by(|(a, b), (c, d)| {
            let near = |a: f64, b: f64| distance(a).min(distance(b));
            near(a.0, b.0).total_cmp(&near(c.0, d.0))
        });
        holding
            .into_iter()
            .find_map(|(start, end)| self.solve_drive(start, end, value))
    }

    /// The pose between two milestones where the driven variable has a value.
    fn solve_drive(&mut self, start: (f64, f64), end: (f64, f64), value: f64) -> Option<CurvePose> {
        let middle = 0.5 * (start.0 + end.0);
        let segment = self.segment_at(middle)?;
        let gap = self.nodes[segment + 1].arc - self.nodes[segment].arc;
        let base = self.nodes[segment].arc;
        let unit = |arc: f64| ((arc - base) / gap).clamp(0.0, 1.0);
        let (mut low, mut high) = (unit(start.0), unit(end.0));
        if let Some(found) = self.between_milestones(segment, (start, end), (low, high), value) {
            return Some(found);
        }
        // Close to a dead centre or a singular pose: halve.
        let rising = end.1 > start.1;
        let mut best = None;
        for _ in 0..60 {
            let u = 0.5 * (low + high);
            let found = self.pose_between(segment, u)?;
            let off = found.pose.values[self.drive] - value;
            if (off < 0.0) == rising {
                low = u;
            } else {
                high = u;
            }
            let done = off.abs() < 1e-15 || high - low < 1e-15;
            best = Some(found);
            if done {
                break;
            }
        }
        best
    }

    /// As [`Self::solve_drive`], away from poses where the driven variable hardly moves: on the polynomial through the segment, or from
    /// the pose that the cubic predicts.
    fn between_milestones(
        &mut self,
        segment: usize,
        (start, end): ((f64, f64), (f64, f64)),
        inside: (f64, f64),
        value: f64,
    ) -> Option<CurvePose> {
        let (base, gap) = (
            self.nodes[segment].arc,
            self.nodes[segment + 1].arc - self.nodes[segment].arc,
        );
        let share = ((value - start.1) / (end.1 - start.1)).clamp(0.0, 1.0);
        let first = inside.0 + (inside.1 - inside.0) * share;
        let scalar = self.solver.system.is_scalar(self.drive);
        let many = scalar && self.dense_through(segment, base + first * gap).is_some();
        let Shape::Cubic(cubic) = &self.shapes[segment] else {
            return None;
        };
        let own = self.nodes[segment].pose.values[self.drive];
        let wanted = (value - own) * self.solver.system.weights()[self.drive];
        let (drive, rising) = (self.drive, end.1 > start.1);
        let dense = self.dense.as_ref().and_then(|(_, found)| found.as_ref());
        if let Some(dense) = dense.filter(|_| many) {
            let u = reached(first, inside, rising, |u| {
                let (at, speed) = dense.component(cubic, drive, u);
                (at - wanted, speed)
            });
            let (_, speed) = dense.component(cubic, drive, u);
            let from = &self.nodes[segment];
            if speed.abs() > SLOWEST * gap
                && let Some((pose, closure)) = dense.pose(&mut self.solver, from, (cubic, u))
            {
                return Some(CurvePose {
                    arclength: base + u * gap,
                    pose,
                    closure,
                });
            }
        }
        let u = reached(first, inside, rising, |u| {
            (cubic.component(drive, u) - wanted, cubic.speed(drive, u))
        });
        if cubic.speed(drive, u).abs() <= SLOWEST * gap {
            return None;
        }
        let mut pose = self.guess(segment, (cubic, u));
        let done = self.solver.correct(&mut pose, Along::Value(drive, value))?;
        let u = self.place_beside(segment, (cubic, u), &pose);
        (done.way < 0.1 * gap).then_some(CurvePose {
            arclength: base + u * gap,
            pose,
            closure: done.closure,
        })
    }

    /// Where the plane across the cubic passes through a pose, from a place nearby.
    fn place_beside(&self, segment: usize, (cubic, u): (&Cubic, f64), pose: &SystemPose) -> f64 {
        let mut z = vec![0.0; self.solver.system.unknowns()];
        let from = &self.nodes[segment].pose;
        self.solver.system.way(from, pose, &mut z);
        (0..3).fold(u, |u, _| {
            let (at, along) = (cubic.at(u), cubic.velocity(u));
            let pairs = z.iter().zip(&at).zip(&along);
            let off: f64 = pairs.map(|((z, a), v)| (z - a) * v).sum();
            u + off / dot(&along, &along)
        })
    }
}

/// Where a function that rises (or falls) between two places vanishes: Newton's steps, kept inside by halving. The function says its
/// value and its slope.
fn reached(
    first: f64,
    (mut low, mut high): (f64, f64),
    rising: bool,
    off: impl Fn(f64) -> (f64, f64),
) -> f64 {
    let mut u = first;
    for _ in 0..12 {
        let (value, slope) = off(u);
        let step = value / slope;
        if step.abs() < 1e-14 {
            break;
        }
        if (value < 0.0) == rising {
            low = u;
        } else {
            high = u;
        }
        let next = u - step;
        u = if next > low && next < high {
            next
        } else {
            0.5 * (low + high)
        };
    }
    u
}
