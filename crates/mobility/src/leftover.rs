//! What the equations leave over, as a function of the coordinates along the kernel, in as many bits as asked for.
//!
//! With `B` a basis of the kernel, `C` one of what is across it and `L`, `N` bases of the rows that the Jacobian reaches and does not
//! reach, let `ψ(y)` solve `L F(B y + C ψ) = 0`; left over is `κ(y) = N F(B y + C ψ(y))`. That is an exact reduction wherever `L J C` is
//! regular, however roughly the bases are known, and κ begins with the second degree because the kernel of `L J` is that of `J`.
//! `L` and `N` are doubles taken for exact. `B` is known to many digits, and `C` is orthogonal to it to as many: rounded, they would put
//! terms of 1e-17, and of its square and cube, in place of zeros, of which the smallest ones are lost in the error. The joints'
//! increments are taken from the pose in one step, so that κ is one analytic function; equations are those about the centre and in the
//! length that the cycles have at the pose.

use crate::germ::splitting::Splitting;
use crate::lifting::Start;
use crate::more_digits::MoreDigits;
use kutzbach_closure::{Geometry, JointState, Section, WalkedCycle};
use kutzbach_math::matrix::{Extended, Real, Ring};

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

/// Steps that gain less than this factor do not converge.
const CONVERGES: f64 = 0.01;

/// Steps that do not get smaller below 2^(this − bits), in parts of the distance from the pose, are rounding.
const ROUNDINGS: i64 = 60;

/// Below 2^(this − bits) all steps are rounding, and all values of what is left over are zero.
pub(crate) const ABSOLUTE: i64 = 24;

/// The equations of a part near its pose.
pub(crate) struct Leftover<'a> {
    section: Section<'a, Extended>,
    home: &'a [JointState<Extended>],
    /// Walks at the pose, whose centres and lengths the equations are told in.
    walks: Vec<WalkedCycle<Extended>>,
    /// Length of each coupling's row.
    norms: Vec<Extended>,
    splitting: Splitting,
    kernel: Vec<Vec<Extended>>,
    /// What the Jacobian reaches: left vectors, vectors across the kernel, singular values.
    reached: Vec<(Vec<Extended>, Vec<Extended>, Extended)>,
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
        let walks: Vec<WalkedCycle<Extended>> = part
            .cycles
            .iter()
            .map(|cycle| WalkedCycle::walk(geometry, home, cycle))
            .collect();
        let norms = part
            .couplings
            .iter()
            .map(|&coupling| coupling_norm(geometry, coupling, rank.jacobian.length))
            .collect();
        let exact = |doubles: &[f64]| -> Vec<Extended> {
            doubles.iter().map(|x| one.constant(*x)).collect()
        };
        let directions = splitting.kernel.iter().map(|b| exact(b)).collect();
        let reached = splitting.reached();
        let reached = reached
            .map(|(u, v, s)| (exact(u), exact(v), one.constant(s)))
            .collect();
        let mut leftover = Self {
            section: Section {
                mechanism: pose.mechanism,
                geometry,
                part,
                metric: &kernel.metric,
            },
            home,
            walks,
            norms,
            splitting,
            kernel: directions,
            reached,
            one,
        };
        leftover.refine_kernel();
        leftover.make_orthogonal();
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
                let side = |sign: f64| -> Vec<Extended> {
                    let share = step.clone() * self.one.constant(sign);
                    let z: Vec<Extended> =
                        vector.iter().map(|x| share.clone() * x.clone()).collect();
                    self.residual(&z)
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

    /// What is left over at a place of the kernel, by the rows that are not reached. The places of a row are asked for in equal steps,
    /// the first with a first coordinate of zero: from those before, the solution at the next is extrapolated.
    ///
    /// # Errors
    /// [`Doubt`] where solving the other equations does not converge.
    pub fn evaluate_next(&self, row: &mut Row, y: &[Extended]) -> Result<Vec<Extended>, Doubt> {
        if y[0].is_zero() {
            row.0.clear();
        }
        let across = row.extrapolated(self.section.metric.weights.len(), &self.one);
        let (left, across) = self.evaluate(y, across)?;
        row.0.push(across);
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
        near.resize(self.section.metric.weights.len(), self.one.zero_like());
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
        let start = line.interpolated(self.section.metric.weights.len(), parameter);
        let (left, across) = self.evaluate(y, start)?;
        line.0.push((parameter.clone(), across));
        Ok(left)
    }

    /// What is left over at a place, and what the solution has across the kernel; `across` is where to look for it.
    fn evaluate(
        &self,
        y: &[Extended],
        mut across: Vec<Extended>,
    ) -> Result<(Vec<Extended>, Vec<Extended>), Doubt> {
        let unknowns = self.section.metric.weights.len();
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
        let mut residual = self.residual(&sum(&across));
        let mut before: Option<Extended> = None;
        loop {
            let open: Vec<Extended> = self
                .reached
                .iter()
                .map(|(u, ..)| self.one.dot(u, &residual))
                .collect();
            // Steps are exactly in the span of the right vectors: what is across the kernel has to be one space for all poses.
            let mut step = vec![self.one.zero_like(); unknowns];
            for (open, (_, v, s)) in open.iter().zip(&self.reached) {
                (open.clone() / s.clone()).add_scaled(v, &mut step);
            }
            let moved = largest(&step);
            if !moved.is_finite() {
                return Err(Doubt::Arithmetic);
            }
            if moved <= floor {
                break;
            }
            // Down to rounding each step gains a factor of about the distance from the pose.
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
            residual = self.residual(&sum(&across));
        }
        let left = self
            .splitting
            .left
            .iter()
            .map(|row| self.one.dot(&self.exact(row), &residual))
            .collect();
        Ok((left, across))
    }

    fn exact(&self, doubles: &[f64]) -> Vec<Extended> {
        doubles.iter().map(|x| self.one.constant(*x)).collect()
    }

    fn residual(&self, z: &[Extended]) -> Vec<Extended> {
        let mut states = self.home.to_vec();
        self.section.advance(&mut states, z);
        let geometry = self.section.geometry;
        let mut rows = Vec::with_capacity(6 * self.walks.len() + self.norms.len());
        for (cycle, home) in self.section.part.cycles.iter().zip(&self.walks) {
            let closure = WalkedCycle::around(geometry, &states, cycle);
            rows.extend(
                WalkedCycle {
                    closure,
                    ..home.clone()
                }
                .residual(),
            );
        }
        for (&coupling, norm) in self.section.part.couplings.iter().zip(&self.norms) {
            let (terms, offset) = &geometry.couplings[coupling];
            let mut value = -offset.clone();
            for (joint, factor) in terms {
                if let Some(variable) = states[*joint].values.first() {
                    value = value + factor.clone() * variable.clone();
                }
            }
            rows.push(value / norm.clone());
        }
        rows
    }
}

/// Solutions across the kernel at equidistant places.
#[derive(Debug, Default)]
pub(crate) struct Row(Vec<Vec<Extended>>);

impl Row {
    /// The polynomial through all of them, at the next place.
    fn extrapolated(&self, unknowns: usize, one: &Extended) -> Vec<Extended> {
        let mut next = vec![one.zero_like(); unknowns];
        let count = self.0.len();
        let mut weight = 1.0;
        for (back, known) in self.0.iter().rev().enumerate() {
            // (−1)^back C(count, back + 1).
            weight *= (count - back) as f64 / (back + 1) as f64;
            let sign = if back % 2 == 0 { weight } else { -weight };
            one.constant(sign).add_scaled(known, &mut next);
        }
        next
    }
}

/// Solutions across the kernel at places of a line, by their parameters.
#[derive(Debug, Default)]
pub(crate) struct Line(Vec<(Extended, Vec<Extended>)>);

impl Line {
    /// So many solutions, the last ones, are interpolated.
    const POINTS: usize = 5;

    /// The polynomial through the last solutions, at a parameter (Lagrange).
    fn interpolated(&self, unknowns: usize, at: &Extended) -> Vec<Extended> {
        let mut solution = vec![at.zero_like(); unknowns];
        let last = &self.0[self.0.len().saturating_sub(Self::POINTS)..];
        for (index, (own, known)) in last.iter().enumerate() {
            let mut weight = at.one_like();
            for (other, (parameter, _)) in last.iter().enumerate() {
                if other != index {
                    let [up, down] = [at, own].map(|x| x.clone() - parameter.clone());
                    weight = weight * up / down;
                }
            }
            weight.add_scaled(known, &mut solution);
        }
        solution
    }
}

/// The length of a coupling's row at a length of the part.
fn coupling_norm(geometry: &Geometry<Extended>, coupling: usize, length: f64) -> Extended {
    let one = &geometry.one;
    let weights: Vec<Extended> = geometry.couplings[coupling]
        .0
        .iter()
        .map(|(joint, factor)| {
            let part = geometry.displacements[*joint]
                .kind()
                .freedoms()
                .first()
                .copied();
            let unit = part.map_or(1.0, |part| kutzbach_closure::variable_unit(part, length));
            factor.clone() * one.constant(unit)
        })
        .collect();
    let norm = one.norm(&weights);
    if norm.is_zero() { one.clone() } else { norm }
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
