//! Half-branches that no known term separates: whether they are one, several times over. Half-branches that hardly differ: whether each
//! is one.
//!
//! Beside m half-branches that agree, y = h(t) + y₁, the equation is c y₁ᵐ but for a factor that is almost constant. So its values at y₁ = −σ,
//! σ, 2σ, … tell, with σ smaller than any difference up to order [`ORDERS`] would be. h(t) is found on the way: values on both sides of it
//! say where between them it lies, the better the nearer they are.

use super::puiseux::{Half, power};
use crate::leftover::{Doubt, power_of_two};
use kutzbach_math::matrix::{Extended, Real, Ring};

/// Half-branches that differ in a term up to this order, in t, are seen to differ. What differs later only has parted a third of a radian
/// away, where branches are followed to.
pub(crate) const ORDERS: i64 = 16;

/// They are looked at where t is 2^−this.
const NEAR: i64 = 16;

/// On the way values are compared at a third place each so many times.
const THOROUGHLY: usize = 3;

/// Half-branches that differ by more than 2^−this are known to.
const CLEARLY: i64 = 40;

/// Values agree with a power to this share, at first and in the end.
const ROUGHLY: f64 = 0.5;
const CLOSELY: f64 = 1e-3;

/// Half-branches on one side that have the same known terms; mostly one.
pub(super) struct Cluster<'a> {
    half: &'a Half<Extended>,
    /// The order of the equation.
    order: usize,
    /// The terms by which others differ from these are above 2^−this.
    apart: i64,
}

impl<'a> Cluster<'a> {
    /// One of all half-branches of an equation of some order.
    pub fn new(half: &'a Half<Extended>, all: &[Half<Extended>], order: usize) -> Self {
        let gaps = all
            .iter()
            .filter(|other| other.positive == half.positive)
            .filter_map(|other| {
                let steps = half.steps.len().max(other.steps.len());
                // What goes on by itself has no term where another has one.
                let gap =
                    (0..steps).find_map(|k| match (half.steps.get(k), other.steps.get(k)) {
                        (Some(a), Some(b)) if a.c.value != b.c.value => {
                            Some(a.c.value.clone() - b.c.value.clone())
                        }
                        (Some(only), None) | (None, Some(only)) => Some(only.c.value.clone()),
                        _ => None,
                    })?;
                let gap = gap.abs().to_f64();
                (gap > 0.0).then(|| (-gap.log2()).ceil().max(0.0) as i64)
            });
        Self {
            half,
            order,
            apart: gaps.max().unwrap_or(0),
        }
    }

    /// Whether values have to confirm what the polygon says: where it is multiple, and where so little separates it from others that a
    /// coefficient smaller than its error may have been taken for zero.
    pub fn is_doubtful(&self) -> bool {
        self.half.multiplicity > 1 || self.apart > CLEARLY
    }

    fn near(&self) -> i64 {
        NEAR + 2 * self.apart
    }

    /// Bits in which values are needed.
    pub fn bits(&self) -> u32 {
        // y is t to this power times what remains of it.
        let exponent = self
            .half
            .steps
            .iter()
            .fold(0, |sum, step| sum * step.q + step.p) as i64;
        let ramification = self.half.ramification() as i64;
        let scales = (self.half.multiplicity + self.order) as i64 * exponent + 2 * ramification;
        let bits = self.near() * (self.half.multiplicity as i64 * ORDERS + scales) + 128;
        bits as u32
    }

    /// Whether they are one as far as terms up to [`ORDERS`] tell, by values of the equation at (x, y), where y₁ is given too and x is
    /// always the same.
    ///
    /// # Errors
    /// Those of `value`.
    pub fn is_one(
        &self,
        one: &Extended,
        mut value: impl FnMut([Extended; 2], &Extended) -> Result<Extended, Doubt>,
    ) -> Result<bool, Doubt> {
        let multiplicity = self.half.multiplicity;
        let t = power_of_two(one, -self.near());
        let finest = power_of_two(one, -ORDERS * self.near());
        let mut width = power_of_two(one, -(NEAR / 2 + 2) - self.apart);
        let mut middle = one.zero_like();
        for level in 0.. {
            let mut at = |steps: f64| {
                let rest = middle.clone() + width.clone() * one.constant(steps);
                value(self.half.point_beside(&t, rest.clone()), &rest)
            };
            let [before, unit] = [at(-1.0)?, at(1.0)?];
            let last = width <= finest;
            let (most, share) = match last {
                true => (multiplicity.max(2) + 1, CLOSELY),
                false => (if level % THOROUGHLY == 0 { 2 } else { 1 }, ROUGHLY),
            };
            let sign = if multiplicity.is_multiple_of(2) {
                1.0
            } else {
                -1.0
            };
            let ratio = before.clone() / unit.clone() * one.constant(sign);
            if !((ratio.to_f64() - 1.0).abs() < share) {
                return Ok(false);
            }
            for steps in 2..=most {
                let wanted = one.constant((steps as f64).powi(multiplicity as i32));
                let off = at(steps as f64)? / unit.clone() / wanted;
                if !((off.to_f64() - 1.0).abs() < share) {
                    return Ok(false);
                }
            }
            if last {
                return Ok(true);
            }
            // (σ + a)ᵐ / (σ − a)ᵐ is the ratio where the root lies at a.
            let q = root(&ratio, multiplicity);
            let shift = width.clone() * (q.clone() - one.one_like()) / (q + one.one_like());
            middle = middle + shift;
            let next = width.clone() * width * power_of_two(one, NEAR / 3 + self.apart);
            width = if next > finest { next } else { finest.clone() };
        }
        Ok(false)
    }
}

/// The m-th root of a number near one.
fn root(number: &Extended, m: usize) -> Extended {
    let mut root = number.one_like();
    let mut accurate = 1;
    while accurate < 2 * number.bits() {
        let below = power(&root, m - 1);
        let off = below.clone() * root.clone() - number.clone();
        root = root - off / (below * number.constant(m as f64));
        accurate *= 2;
    }
    root
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::fuzzy::Fuzzy;
    use super::super::puiseux::Step;
    use super::*;

    /// Half-branches y ≈ slope · x of an equation.
    fn along(slopes: &[f64], multiplicity: usize) -> Vec<Half<Extended>> {
        let one = Extended::new(1.0, 300);
        let half = |slope: &f64| Half {
            positive: true,
            steps: vec![Step {
                p: 1,
                q: 1,
                c: Fuzzy::exact(one.constant(*slope)),
            }],
            multiplicity,
        };
        slopes.iter().map(half).collect()
    }

    fn told(
        slopes: &[f64],
        multiplicity: usize,
        order: usize,
        f: impl Fn(Extended, Extended) -> Extended,
    ) -> bool {
        let halves = along(slopes, multiplicity);
        let cluster = Cluster::new(&halves[0], &halves, order);
        let one = Extended::new(1.0, cluster.bits());
        cluster.is_one(&one, |[x, y], _| Ok(f(x, y))).unwrap()
    }

    #[test]
    fn what_agrees_in_all_terms_is_one() {
        // (y − x − x² − x³)ᵐ (1 + y), and with a line beside it at a small angle.
        let bent = |x: &Extended, y: &Extended| y.clone() - x.clone() - power(x, 2) - power(x, 3);
        for m in 2..5 {
            assert!(told(&[1.0], m, m, |x, y| {
                power(&bent(&x, &y), m) * (y.one_like() + y.clone())
            }));
            assert!(told(&[1.0, 1.0 + 1e-6], m, m + 1, |x, y| {
                let beside = y.clone() - x.constant(1.0 + 1e-6) * x.clone();
                power(&bent(&x, &y), m) * beside
            }));
        }
    }

    #[test]
    fn what_differs_in_a_late_term_is_not() {
        for order in [3, 8, 13] {
            for sign in [1.0, -1.0] {
                let f = |x: Extended, y: Extended| {
                    let line = y - x.clone();
                    power(&line, 2) - x.constant(sign * 1e-9) * power(&x, 2 * order)
                };
                assert!(!told(&[1.0], 2, 2, f), "{order} {sign}");
            }
            // Three, the middle one of which is a zero of every derivative of even order.
            let f = |x: Extended, y: Extended| {
                let line = y - x.clone();
                power(&line, 3) - line * power(&x, 2 * order)
            };
            assert!(!told(&[1.0], 3, 3, f), "{order}");
        }
    }
}
