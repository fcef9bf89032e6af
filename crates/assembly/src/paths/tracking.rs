//! Following a solution of F(x) = c while c moves along a straight line.

use super::complex::{Arithmetic, Complex, solved};
use super::equations::Equations;
use kutzbach_algebra::{Budget, Stop};

/// First step, and the smallest one, in parts of the line.
const FIRST: f64 = 1.0 / 16.0;
const SMALLEST: f64 = 1e-9;

/// Steps of one path at most.
const MOST_STEPS: usize = 1_000;

/// A point beyond this is taken to be on its way to infinity.
const FAR: f64 = 1e6;

/// Parts of a point's size by which a step may move it: where slopes are steep, longer ones land anywhere.
const LONGEST: f64 = 0.25;

/// Parts of its size that the first correction of a step may have: larger ones may lead to another path, and the step is made shorter.
const FIRST_CORRECTION: f64 = 1e-3;

/// The same of the last one.
const LAST_CORRECTION: f64 = 1e-8;

/// Corrections of a step; each has twice as many digits as the one before.
const CORRECTIONS: usize = 3;

pub(super) struct Tracker<'a> {
    equations: &'a Equations,
    budget: &'a Budget,
    effort: u64,
}

/// Effort of a term, and of an entry of the elimination for every row.
const EFFORT_OF_TERM: u64 = 40;
const EFFORT_OF_ENTRY: u64 = 4;

impl<'a> Tracker<'a> {
    pub(super) fn new(equations: &'a Equations, budget: &'a Budget) -> Self {
        let entries = EFFORT_OF_ENTRY * equations.count().pow(3) as u64;
        // Four slopes and two corrections.
        Self {
            effort: 6 * (EFFORT_OF_TERM * equations.terms() as u64 + entries),
            equations,
            budget,
        }
    }

    /// Where a solution for `from` arrives at `to`; `None` where it is lost.
    pub(super) fn follow(
        &mut self,
        start: &[Complex],
        from: &[Complex],
        to: &[Complex],
    ) -> Result<Option<Vec<Complex>>, Stop> {
        let way: Vec<Complex> = to.iter().zip(from).map(|(b, a)| b.minus(*a)).collect();
        let mut at = start.to_vec();
        let (mut done, mut step, mut good) = (0.0, FIRST, 0);
        for _ in 0..MOST_STEPS {
            self.budget.toil(self.effort)?;
            let length = step.min(1.0 - done);
            let reached = if length == 1.0 - done {
                1.0
            } else {
                done + length
            };
            let wanted: Vec<Complex> = from
                .iter()
                .zip(&way)
                .map(|(a, w)| a.plus(w.scaled(reached)))
                .collect();
            let next = self
                .predicted(&at, &way, length)
                .and_then(|next| self.corrected(next, &wanted));
            match next {
                Some(next) => {
                    at = next;
                    done = reached;
                    good += 1;
                    if done == 1.0 {
                        return Ok(Some(at));
                    }
                    if at.iter().any(|z| z.size() > FAR) {
                        return Ok(None);
                    }
                    if good == 2 {
                        (step, good) = (2.0 * step, 0);
                    }
                }
                None => {
                    (step, good) = (0.5 * length, 0);
                    if step < SMALLEST {
                        return Ok(None);
                    }
                }
            }
        }
        Ok(None)
    }

    /// One step of Runge and Kutta's method of order four.
    fn predicted(&self, at: &[Complex], way: &[Complex], length: f64) -> Option<Vec<Complex>> {
        let along = |slope: &[Complex], length: f64| -> Vec<Complex> {
            let pairs = at.iter().zip(slope);
            pairs.map(|(x, k)| x.plus(k.scaled(length))).collect()
        };
        let first = self.slope(at, way)?;
        let second = self.slope(&along(&first, 0.5 * length), way)?;
        let third = self.slope(&along(&second, 0.5 * length), way)?;
        let fourth = self.slope(&along(&third, length), way)?;
        let mean: Vec<Complex> = (0..at.len())
            .map(|i| {
                let inner = second[i].plus(third[i]).scaled(2.0);
                first[i].plus(inner).plus(fourth[i]).scaled(1.0 / 6.0)
            })
            .collect();
        let size = |z: &Complex| z.size();
        let [step, here] = [&mean[..], at].map(|x| x.iter().map(size).fold(0.0, f64::max));
        (length * step <= LONGEST * here.max(1.0)).then(|| along(&mean, length))
    }

    fn slope(&self, at: &[Complex], way: &[Complex]) -> Option<Vec<Complex>> {
        let right = way.iter().map(|w| vec![*w]).collect();
        let found = solved(self.equations.at(at).slopes, right)?;
        Some(found.into_iter().map(|row| row[0]).collect())
    }

    fn corrected(&self, mut at: Vec<Complex>, wanted: &[Complex]) -> Option<Vec<Complex>> {
        for number in 0..CORRECTIONS {
            let size = newton(self.equations, &mut at, wanted)?;
            if size > FIRST_CORRECTION {
                return None;
            }
            // The next one would be smaller than rounding.
            if size < LAST_CORRECTION {
                return Some(at);
            }
            if number + 1 == CORRECTIONS {
                return None;
            }
        }
        None
    }
}

/// A coordinate smaller than this part of the largest one is compared with that part: quaternions stand beside lengths.
const SMALL: f64 = 1e-3;

/// One step of Newton's method towards F(x) = c; tells how long it was, the most of any coordinate in parts of it.
fn newton(equations: &Equations, at: &mut [Complex], wanted: &[Complex]) -> Option<f64> {
    let there = equations.at(at);
    let pairs = wanted.iter().zip(&there.values);
    let right = pairs.map(|(c, f)| vec![c.minus(*f)]).collect();
    let step = solved(there.slopes, right)?;
    let least = SMALL * at.iter().map(|z| z.size()).fold(0.0, f64::max);
    let mut longest: f64 = 0.0;
    for (x, step) in at.iter_mut().zip(&step) {
        longest = longest.max(step[0].size() / x.size().max(least).max(f64::MIN_POSITIVE));
        *x = x.plus(step[0]);
    }
    longest.is_finite().then_some(longest)
}

/// A solution of F(x) = 0 as near as doubles tell, by Newton's method; `None` where it does not settle.
pub(super) fn corrected(equations: &Equations, at: &[Complex]) -> Option<Vec<Complex>> {
    /// A correction that is not less than half of the one before is rounding; so small it has to be then.
    const SETTLED: f64 = 1e-9;
    let none = vec![Complex::ZERO; equations.count()];
    let mut at = at.to_vec();
    let mut before = f64::INFINITY;
    for _ in 0..12 {
        let size = newton(equations, &mut at, &none)?;
        if size >= 0.5 * before || size == 0.0 {
            return (size < SETTLED).then_some(at);
        }
        before = size;
    }
    (before < SETTLED).then_some(at)
}
