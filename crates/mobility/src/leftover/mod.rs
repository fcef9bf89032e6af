//! What the equations leave over, as a function of the coordinates along the kernel, in as many bits as asked for.
//!
//! With `B` a basis of the kernel, `C` one of what is across it and `L`, `N` bases of the rows that the Jacobian reaches and does not
//! reach, let `ψ(y)` solve `L F(B y + C ψ) = 0`; left over is `κ(y) = N F(B y + C ψ(y))`. That is an exact reduction wherever `L J C` is
//! regular, however roughly the bases are known, and κ begins with the second degree because the kernel of `L J` is that of `J`.
//! `L` and `N` are doubles taken for exact. `B` is known to many digits, and `C` is orthogonal to it to as many: rounded, they would put
//! terms of 1e-17, and of its square and cube, in place of zeros, of which the smallest ones are lost in the error. The joints'
//! increments are taken from the pose in one step, so that κ is one analytic function; equations are those about the centre and in the
//! length that the cycles have at the pose.

mod equations;
mod known;
mod turning;

use crate::germ::splitting::Splitting;
use crate::lifting::Start;
use crate::more_digits::MoreDigits;
use equations::Equations;
pub(crate) use known::{Grid, Line};
use kutzbach_closure::Section;
use kutzbach_math::interruption;
use kutzbach_math::matrix::{Extended, Real, Ring};
use turning::{TurnedTo, Turning};

/// Why many digits give no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Doubt {
    /// A number is neither zero nor clearly different from it.
    Precision,
    /// Branches agree in all terms that are known, or one is multiple.
    Multiple,
    /// The equations could not be evaluated.
    Arithmetic,
}

/// What vanishes to this order is taken for zero where values close to the pose are compared with zero.
pub(crate) const ORDERS: i64 = 24;

/// The kernel is refined to so many bits.
const KERNEL: i64 = 500;

/// Bits of the shares of a step in the vectors across the kernel.
const OF_SHARES: u32 = 128;

/// Steps that gain less than this factor do not converge.
const CONVERGES: f64 = 0.01;

/// Steps that do not get smaller below 2^(this − bits), in parts of the distance from the pose, are rounding.
const ROUNDINGS: i64 = 60;

/// Below 2^(this − bits) all steps are rounding, and all values of what is left over are zero.
pub(crate) const ABSOLUTE: i64 = 24;

/// The equations of a part near its pose.
pub(crate) struct Leftover<'a> {
    equations: Equations<'a, Extended>,
    splitting: Splitting,
    kernel: Vec<Vec<Extended>>,
    /// What the Jacobian reaches: left vectors, vectors across the kernel, singular values.
    reached: Vec<(Vec<Extended>, Vec<Extended>, Extended)>,
    /// The vectors across the kernel once more, by unknowns.
    across: Vec<Vec<Extended>>,
    turning: Turning,
    one: Extended,
}

impl<'a> Leftover<'a> {
    /// At a pose polished in some bits, idle directions left out.
    ///
    /// # Errors
    /// [`Doubt`] where the pose cannot be polished or the Jacobian cannot be split.
    pub fn at_pose(start: &Start<'a>, more: &'a mut MoreDigits, bits: u32) -> Result<Self, Doubt> {
        let Start {
            pose,
            part,
            rank,
            kernel,
            idle,
        } = *start;
        let freedom = rank.instantaneous.ok_or(Doubt::Arithmetic)?;
        let kept = rank
            .unknowns()
            .checked_sub(freedom)
            .ok_or(Doubt::Arithmetic)?;
        let mut splitting = Splitting::of(&rank.matrix, kept).map_err(|_| Doubt::Arithmetic)?;
        splitting.leave_out(idle);
        let (geometry, home) = more
            .polished(pose, part, !pose.as_drawn, bits)
            .map_err(|_| Doubt::Arithmetic)?;
        let one = geometry.one.one_like();
        let length = rank.jacobian.length;
        let section = Section {
            mechanism: pose.mechanism,
            geometry,
            part,
            metric: &kernel.metric,
        };
        let equations = Equations::about(section, home, length);
        let turning = Turning::of(&splitting, &equations, &in_doubles(start), &one);
        let exact = |doubles: &[f64]| -> Vec<Extended> {
            doubles.iter().map(|x| one.constant(*x)).collect()
        };
        // Doubles hold no more.
        let short = |doubles: &[f64]| -> Vec<Extended> {
            let one = one.rounded_to(OF_SHARES);
            doubles.iter().map(|x| one.constant(*x)).collect()
        };
        let directions = splitting.kernel.iter().map(|b| exact(b)).collect();
        let reached = splitting.reached();
        let reached = reached
            .map(|(u, v, s)| (short(u), exact(v), one.rounded_to(OF_SHARES).constant(s)))
            .collect();
        let mut leftover = Self {
            equations,
            turning,
            splitting,
            kernel: directions,
            reached,
            across: Vec::new(),
            one,
        };
        leftover.refine_kernel();
        leftover.make_orthogonal();
        let unknown = |index: usize| -> Vec<Extended> {
            let vectors = leftover.reached.iter();
            vectors.map(|(_, v, _)| v[index].clone()).collect()
        };
        leftover.across = (0..leftover.equations.unknowns()).map(unknown).collect();
        Ok(leftover)
    }

    /// Corrects the kernel across itself until it is known to [`KERNEL`] bits: the Jacobian times a vector is a difference.
    fn refine_kernel(&mut self) {
        let bits = i64::from(self.one.bits());
        let step = power_of_two(&self.one, -bits / 3);
        let twice = step.clone() * self.one.constant(2.0);
        let enough = power_of_two(&self.one, -KERNEL.min(2 * bits / 3 - 32));
        let mut kernel = std::mem::take(&mut self.kernel);
        for vector in &mut kernel {
            // Each round gains the digits of a double.
            for _ in 0..bits / 30 {
                if interruption::asked() {
                    break;
                }
                let side = |sign: f64| -> Vec<Extended> {
                    let share = step.clone() * self.one.constant(sign);
                    let z: Vec<Extended> =
                        vector.iter().map(|x| share.clone() * x.clone()).collect();
                    self.equations.residual(&z)
                };
                let image: Vec<Extended> = side(1.0)
                    .into_iter()
                    .zip(side(-1.0))
                    .map(|(plus, minus)| (plus - minus) / twice.clone())
                    .collect();
                let mut most = self.one.zero_like();
                for (u, v, s) in &self.reached {
                    let share = -(self.one.dot(u, &image) / s.clone());
                    share.add_scaled(v, vector);
                    most = larger(most, share.abs());
                }
                if !(most > enough) {
                    break;
                }
            }
        }
        self.kernel = kernel;
    }

    /// Makes the kernel orthonormal and what is across orthogonal to it, by corrections of a rounding in double precision.
    fn make_orthogonal(&mut self) {
        for index in 0..self.kernel.len() {
            let (before, rest) = self.kernel.split_at_mut(index);
            let Some(vector) = rest.first_mut() else {
                break;
            };
            project_out(before, vector, &self.one);
            let length = self.one.norm(vector);
            vector
                .iter_mut()
                .for_each(|x| *x = x.clone() / length.clone());
        }
        for (_, across, _) in &mut self.reached {
            project_out(&self.kernel, across, &self.one);
        }
    }

    /// How many equations are left.
    pub fn equations(&self) -> usize {
        self.splitting.left.len()
    }

    /// How many coordinates the kernel has.
    pub fn freedom(&self) -> usize {
        self.kernel.len()
    }

    /// What is left over at a place (i h, j h) of the kernel, by the rows that are not reached. Places are asked for row by row, i = 0,
    /// 1, 2, … for each j, and no row is longer than the one before: from those known the solution at the next is extrapolated.
    ///
    /// # Errors
    /// [`Doubt`] where solving the other equations does not converge.
    pub fn evaluate_next(&self, grid: &mut Grid, y: &[Extended]) -> Result<Vec<Extended>, Doubt> {
        if y[0].is_zero() {
            grid.next_row();
        }
        let across = grid.extrapolated(self.equations.unknowns(), &self.one);
        let (left, across) = self.evaluate(y, across)?;
        grid.push(across);
        Ok(left)
    }

    /// What is left over at any place. `near` is the solution across the kernel at a place nearby, or nothing, and becomes the one here.
    ///
    /// # Errors
    /// [`Doubt`] where solving the other equations does not converge.
    pub fn evaluate_near(
        &self,
        near: &mut Vec<Extended>,
        y: &[Extended],
    ) -> Result<Vec<Extended>, Doubt> {
        near.resize(self.equations.unknowns(), self.one.zero_like());
        let (left, across) = self.evaluate(y, std::mem::take(near))?;
        *near = across;
        Ok(left)
    }

    /// What is left over at a place of a line, at a parameter of the line.
    ///
    /// # Errors
    /// [`Doubt`] where solving the other equations does not converge.
    pub fn evaluate_on(
        &self,
        line: &mut Line,
        parameter: &Extended,
        y: &[Extended],
    ) -> Result<Vec<Extended>, Doubt> {
        let start = line.interpolated(self.equations.unknowns(), parameter);
        let (left, across) = self.evaluate(y, start)?;
        line.push(parameter.clone(), across);
        Ok(left)
    }

    /// What is left over at a place, and what the solution has across the kernel; `across` is where to look for it.
    fn evaluate(
        &self,
        y: &[Extended],
        mut across: Vec<Extended>,
    ) -> Result<(Vec<Extended>, Vec<Extended>), Doubt> {
        let unknowns = self.equations.unknowns();
        let mut along = vec![self.one.zero_like(); unknowns];
        for (basis, y) in self.kernel.iter().zip(y) {
            y.add_scaled(basis, &mut along);
        }
        let sum = |across: &[Extended]| -> Vec<Extended> {
            along
                .iter()
                .zip(across)
                .map(|(a, b)| a.clone() + b.clone())
                .collect()
        };
        let largest = |values: &[Extended]| {
            values
                .iter()
                .fold(self.one.zero_like(), |most, x| larger(most, x.abs()))
        };
        let reach = largest(&along);
        if reach.is_zero() {
            return Ok((vec![reach; self.equations()], across));
        }
        let bits = i64::from(self.one.bits());
        let floor = power_of_two(&self.one, 24 - bits) * reach.clone();
        // Equations about links of unit size are rounded as they are, however near the pose.
        let roundings = larger(
            power_of_two(&self.one, ROUNDINGS - bits) * reach,
            power_of_two(&self.one, ABSOLUTE - bits),
        );
        let mut residual = self.equations.residual(&sum(&across));
        let turned = self.turning.to(y);
        let mut before: Option<Extended> = None;
        loop {
            interruption::look().map_err(|_| Doubt::Arithmetic)?;
            let step = self.step(&residual, &turned);
            let moved = largest(&step);
            if !moved.is_finite() {
                return Err(Doubt::Arithmetic);
            }
            if moved <= floor {
                break;
            }
            // Down to rounding each step gains a factor of less than the distance from the pose.
            if before.is_some_and(|before| moved > before * self.one.constant(CONVERGES)) {
                if moved <= roundings {
                    break;
                }
                return Err(Doubt::Arithmetic);
            }
            before = Some(moved);
            for (z, step) in across.iter_mut().zip(step) {
                *z = z.clone() - step;
            }
            residual = self.equations.residual(&sum(&across));
        }
        let left = self
            .splitting
            .left
            .iter()
            .map(|row| self.one.dot(&self.exact(row), &residual))
            .collect();
        Ok((left, across))
    }

    /// What has to be taken off across the kernel for the equations that are reached to hold.
    fn step(&self, residual: &[Extended], turned: &TurnedTo) -> Vec<Extended> {
        // What is left over is part of the residual and far larger: only the shares may be rounded. A step gains some seventy bits.
        let shares = self.reached.iter();
        let shares =
            shares.map(|(u, _, s)| self.one.dot(u, residual).rounded_to(OF_SHARES) / s.clone());
        let shares = turned.corrected(shares.collect());
        // Steps are exactly in the span of the right vectors: what is across the kernel has to be one space for all poses.
        let unknowns = self.across.iter();
        unknowns.map(|row| self.one.dot(&shares, row)).collect()
    }

    fn exact(&self, doubles: &[f64]) -> Vec<Extended> {
        doubles.iter().map(|x| self.one.constant(*x)).collect()
    }
}

/// The equations about a pose in double precision.
fn in_doubles<'a>(start: &Start<'a>) -> Equations<'a, f64> {
    let Start {
        pose,
        part,
        rank,
        kernel,
        ..
    } = *start;
    let section = Section {
        mechanism: pose.mechanism,
        geometry: pose.geometry,
        part,
        metric: &kernel.metric,
    };
    Equations::about(section, pose.states, rank.jacobian.length)
}

/// Takes the parts along orthonormal vectors out of another.
fn project_out(basis: &[Vec<Extended>], vector: &mut [Extended], one: &Extended) {
    for direction in basis {
        let along = -one.dot(direction, vector);
        along.add_scaled(direction, vector);
    }
}

fn larger<R: Real>(a: R, b: R) -> R {
    if b > a { b } else { a }
}

/// 2ⁿ, beyond the range of doubles too.
pub(crate) fn power_of_two<R: Real>(one: &R, exponent: i64) -> R {
    let base = one.constant(if exponent < 0 { 0.5 } else { 2.0 });
    let mut result = one.one_like();
    let mut square = base;
    let mut left = exponent.unsigned_abs();
    while left > 0 {
        if left % 2 == 1 {
            result = result * square.clone();
        }
        square = square.clone() * square;
        left /= 2;
    }
    result
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::part_samples::{Posed, fresh};

    /// By how many bits the second step is smaller than the first, with the first taken as `corrected` says.
    fn gained(name: &str, corrected: bool) -> f64 {
        let posed = Posed::known(name);
        let rank = posed.rank();
        let kernel = posed.kernel(&rank);
        let pose = posed.pose();
        let start = Start {
            pose: &pose,
            part: posed.part(),
            rank: &rank,
            kernel: &kernel,
            idle: &[],
        };
        let mut more = fresh();
        let leftover = Leftover::at_pose(&start, &mut more, 500).unwrap();
        let one = leftover.one.clone();
        let mut z = vec![one.zero_like(); leftover.equations.unknowns()];
        let y: Vec<Extended> = (0..leftover.freedom())
            .map(|k| one.constant(1.0 + k as f64) * power_of_two(&one, -48))
            .collect();
        for (basis, y) in leftover.kernel.iter().zip(&y) {
            y.add_scaled(basis, &mut z);
        }
        let turned = if corrected {
            leftover.turning.to(&y)
        } else {
            TurnedTo::not_at_all(leftover.reached.len())
        };
        let sizes = [0, 1].map(|_| {
            let step = leftover.step(&leftover.equations.residual(&z), &turned);
            let size = one.norm(&step);
            for (z, step) in z.iter_mut().zip(step) {
                *z = z.clone() - step;
            }
            size
        });
        let [first, second] = sizes;
        -(second / first).to_f64().log2()
    }

    #[test]
    fn corrected_steps_gain_nearly_twice_the_digits() {
        for name in ["planar_kite_flat", "sarrus_6r_flat", "wren_platform_6US"] {
            let plain = gained(name, false);
            assert!((30.0..60.0).contains(&plain), "{name}: {plain}");
            let corrected = gained(name, true);
            assert!(corrected > 75.0, "{name}: {corrected}");
        }
    }
}
