//! What the equations leave over, as a function of the coordinates along the kernel, in as many bits as asked for.
//!
//! With `B` a basis of the kernel, `C` one of what is across it and `L`, `N` bases of the rows that the Jacobian reaches and does not
//! reach, all in double precision and taken for exact, let `ψ(y)` solve `L F(B y + C ψ) = 0`; left over is `κ(y) = N F(B y + C ψ(y))`.
//! That is an exact reduction wherever `L J C` is regular, however roughly the bases are known, and κ begins with the second
//! degree because the kernel of `L J` is that of `J`. The joints' increments are taken from the pose in one step, so that κ is
//! one analytic function; equations are those about the centre and in the length that the cycles have at the pose.

use crate::germ::splitting::Splitting;
use crate::more_digits::MoreDigits;
use crate::pose_rank::{PartRank, Pose};
use kutzbach_closure::{Geometry, JointState, Metric, Part, Section, WalkedCycle};
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

/// Steps that gain less than this factor do not converge.
const CONVERGES: f64 = 0.01;

/// Steps that do not get smaller below 2^(this − bits) are rounding.
const ROUNDINGS: i64 = 60;

/// The equations of a part near its pose.
pub(crate) struct Leftover<'a> {
    section: Section<'a, Extended>,
    home: &'a [JointState<Extended>],
    /// Walks at the pose, whose centres and lengths the equations are told in.
    walks: Vec<WalkedCycle<Extended>>,
    /// Length of each coupling's row.
    norms: Vec<Extended>,
    splitting: Splitting,
    one: Extended,
}

impl<'a> Leftover<'a> {
    /// At a pose polished in some bits. `across` are directions of the kernel that are left out.
    ///
    /// # Errors
    /// [`Doubt`] where the pose cannot be polished or the Jacobian cannot be split.
    pub fn at_pose(
        more: &'a mut MoreDigits,
        pose: &Pose<'a>,
        part: &'a Part,
        rank: &PartRank,
        metric: &'a Metric,
        across: &[Vec<f64>],
        bits: u32,
    ) -> Result<Self, Doubt> {
        let freedom = rank.instantaneous.ok_or(Doubt::Arithmetic)?;
        let kept = rank
            .unknowns()
            .checked_sub(freedom)
            .ok_or(Doubt::Arithmetic)?;
        let mut splitting = Splitting::of(&rank.matrix, kept).map_err(|_| Doubt::Arithmetic)?;
        splitting.leave_out(across);
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
        Ok(Self {
            section: Section {
                mechanism: pose.mechanism,
                geometry,
                part,
                metric,
            },
            home,
            walks,
            norms,
            splitting,
            one,
        })
    }

    /// How many equations are left.
    pub fn equations(&self) -> usize {
        self.splitting.left.len()
    }

    /// How many coordinates the kernel has.
    pub fn freedom(&self) -> usize {
        self.splitting.kernel.len()
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

    /// What is left over at a place, and what the solution has across the kernel; `across` is where to look for it.
    fn evaluate(
        &self,
        y: &[Extended],
        mut across: Vec<Extended>,
    ) -> Result<(Vec<Extended>, Vec<Extended>), Doubt> {
        let unknowns = self.section.metric.weights.len();
        let mut along = vec![self.one.zero_like(); unknowns];
        for (basis, y) in self.splitting.kernel.iter().zip(y) {
            for (z, b) in along.iter_mut().zip(basis) {
                *z = z.clone() + y.clone() * self.one.constant(*b);
            }
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
        let roundings = power_of_two(&self.one, ROUNDINGS - bits) * reach;
        let reached: Vec<(Vec<Extended>, Vec<Extended>, Extended)> = self
            .splitting
            .reached()
            .map(|(u, v, s)| (self.exact(u), self.exact(v), self.one.constant(s)))
            .collect();
        let mut residual = self.residual(&sum(&across));
        let mut before: Option<Extended> = None;
        loop {
            let open: Vec<Extended> = reached
                .iter()
                .map(|(u, ..)| self.one.dot(u, &residual))
                .collect();
            // Steps are exactly in the span of the right vectors: what is across the kernel has to be one space for all poses.
            let mut step = vec![self.one.zero_like(); unknowns];
            for (open, (_, v, s)) in open.iter().zip(&reached) {
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
