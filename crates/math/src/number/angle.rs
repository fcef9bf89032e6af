//! Angles with algebraic sine and cosine: rational combinations of pi and directions of algebraic points.

use super::ball::{Ball, Bits, Clear};
use super::evaluate::{fraction, near_integer};
use super::surd::fits;
use super::{Exact, Number, circle};
use dashu_base::{BitTest, Gcd};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use std::sync::Arc;

/// Most inverse circular functions in one angle.
const MAX_PARTS: usize = 16;
/// Largest multiple of a direction that is expanded by the addition theorem.
const MAX_MULTIPLE: i64 = 64;
/// Largest expression for a sine or cosine; beyond it `sin(...)` itself is the shorter form.
const MAX_CIRCULAR_NODES: u32 = 500;

/// A point (cos θ, sin θ) of the unit circle with algebraic coordinates and 0 < θ < π/4, θ not a multiple of π/240.
#[derive(Clone, Debug)]
pub struct Direction {
    cos: Number,
    sin: Number,
}

impl Direction {
    /// cos θ.
    #[must_use]
    pub fn cos(&self) -> &Number {
        &self.cos
    }

    /// sin θ.
    #[must_use]
    pub fn sin(&self) -> &Number {
        &self.sin
    }
}

/// r·π + Σ qᵢ·θᵢ with rational r and qᵢ ≠ 0 and different directions θᵢ. An angle that is zero can still be written with
/// directions (`atan(1/2) + atan(1/3) - pi/4`); equality is decided by sine, cosine and size, not by comparing terms.
#[derive(Clone, Debug)]
pub struct Angle {
    pi: RBig,
    parts: Vec<(Arc<Direction>, RBig)>,
}

impl Angle {
    pub(super) fn of_pi(r: RBig) -> Self {
        Self {
            pi: r,
            parts: Vec::new(),
        }
    }

    /// The rational multiple of pi.
    #[must_use]
    pub fn pi_multiple(&self) -> &RBig {
        &self.pi
    }

    /// The directions with their multiples, in the order in which they came in.
    pub fn parts(&self) -> impl ExactSizeIterator<Item = (&Direction, &RBig)> {
        self.parts.iter().map(|(d, q)| (d.as_ref(), q))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.pi.is_zero() && self.parts.is_empty()
    }

    /// The angle in (−π, π] of a point on the unit circle with algebraic coordinates.
    ///
    /// Reflections take it to the first octant, where a fraction of pi is recognized. So `acos(3/5)` and `asin(3/5)` are
    /// expressed by one direction and their sum is found to be π/2.
    pub(super) fn of_point(cos: Number, sin: Number) -> Self {
        if sin.is_zero() {
            let half_turn = i64::from(cos.signum() < 0);
            return Self::of_pi(RBig::from(half_turn));
        }
        if sin.signum() < 0 {
            return Self::of_point(cos, -&sin).scaled(&RBig::from(-1));
        }
        if cos.signum() < 0 {
            return Self::of_point(-&cos, sin).reflected(RBig::ONE);
        }
        match (&cos - &sin).signum() {
            0 => Self::of_pi(fraction(1, 4)),
            -1 => Self::of_point(sin, cos).reflected(fraction(1, 2)),
            _ => Self::in_octant(cos, sin),
        }
    }

    fn in_octant(cos: Number, sin: Number) -> Self {
        let turns = sin.value().atan2(cos.value()) / std::f64::consts::PI * 240.0;
        // The double only proposes; the comparison is exact.
        if let Some(k) = near_integer(turns)
            && let Some((c, _)) = circle::table(&fraction(k, 240))
            && c == cos
        {
            return Self::of_pi(fraction(k, 240));
        }
        Self {
            pi: RBig::ZERO,
            parts: vec![(Arc::new(Direction { cos, sin }), RBig::ONE)],
        }
    }

    /// `fraction·π − self`.
    fn reflected(self, fraction: RBig) -> Self {
        let mut angle = self.scaled(&RBig::from(-1));
        angle.pi += fraction;
        angle
    }

    /// Times a rational.
    pub(super) fn scaled(&self, factor: &RBig) -> Self {
        if factor.is_zero() {
            return Self::of_pi(RBig::ZERO);
        }
        let parts = self.parts.iter();
        Self {
            pi: &self.pi * factor,
            parts: parts.map(|(d, q)| (d.clone(), q * factor)).collect(),
        }
    }

    pub(super) fn add(&self, other: &Self) -> Option<Self> {
        let mut sum = self.clone();
        sum.pi += &other.pi;
        for (direction, q) in &other.parts {
            let same = |d: &Arc<Direction>| Arc::ptr_eq(d, direction) || d.cos == direction.cos;
            match sum.parts.iter().position(|(d, _)| same(d)) {
                Some(index) => {
                    sum.parts[index].1 += q;
                    if sum.parts[index].1.is_zero() {
                        sum.parts.remove(index);
                    }
                }
                None => sum.parts.push((direction.clone(), q.clone())),
            }
        }
        sum.checked()
    }

    pub(super) fn checked(self) -> Option<Self> {
        let fine = self.parts.len() <= MAX_PARTS
            && fits(&self.pi)
            && self.parts.iter().all(|(_, q)| fits(q));
        fine.then_some(self)
    }

    /// `self / other`, where the one is visibly a rational multiple of the other.
    pub(super) fn ratio(&self, other: &Self) -> Option<RBig> {
        let ratio = match other.parts.first() {
            None => &self.pi / &other.pi,
            Some((direction, q)) => {
                let mine = self.parts.iter().find(|(d, _)| d.cos == direction.cos)?;
                &mine.1 / q
            }
        };
        self.add(&other.scaled(&-&ratio))?
            .is_empty()
            .then_some(ratio)
    }

    /// Cosine and sine where they are algebraic and not too long.
    pub(super) fn cos_sin(&self) -> Option<(Number, Number)> {
        let mut point = circle::fraction_of_pi(&self.pi);
        for (direction, q) in &self.parts {
            point = circle::rotate(&point, &direction.multiple(q)?);
        }
        let short = |x: &Number| x.nodes() <= MAX_CIRCULAR_NODES && x.is_algebraic();
        (short(&point.0) && short(&point.1)).then_some(point)
    }

    /// Binary places b such that the angle is zero if it is below 2^-b in size.
    ///
    /// With m the common denominator of the multiples, m·θ has an algebraic sine, and if |m·θ| < 1 the angle is zero
    /// exactly when that sine is. So the bound is that of m where the sine is proven zero. Where it is not zero, any place
    /// is as good as another: more bits will show the sign.
    pub(super) fn zero_below(&self) -> Option<i64> {
        let never = Some(i64::MAX / 4);
        if self.parts.is_empty() {
            return never;
        }
        let m = self.parts.iter().fold(UBig::ONE, |m, (_, q)| {
            let shared = (&m).gcd(q.denominator());
            m / shared * q.denominator()
        });
        let places = m.bit_len() as i64;
        let (_, sin) = self.scaled(&RBig::from(IBig::from(m))).cos_sin()?;
        match sin.zero_test() {
            super::ZeroTest::Zero => Some(places),
            super::ZeroTest::NonZero => never,
            super::ZeroTest::Indistinguishable => None,
        }
    }

    pub(super) fn ball(&self, bits: Bits) -> Clear<Ball> {
        let mut sum = bits.mul(&bits.rational(&self.pi)?, &bits.pi()?)?;
        for (direction, q) in &self.parts {
            let (cos, sin) = (direction.cos.ball(bits.0)?, direction.sin.ball(bits.0)?);
            let angle = bits.atan2(&sin, &cos)?;
            sum = bits.add(&sum, &bits.mul(&bits.rational(q)?, &angle)?)?;
        }
        Ok(sum)
    }
}

impl Direction {
    /// Cosine and sine of a multiple of this angle; halves and quarters by the half-angle formula.
    fn multiple(&self, q: &RBig) -> Option<(Number, Number)> {
        let numerator = i64::try_from(q.numerator().clone()).ok()?;
        let halvings = match u32::try_from(q.denominator().clone()).ok()? {
            1 => 0,
            2 => 1,
            4 => 2,
            _ => return None,
        };
        if numerator.abs() > MAX_MULTIPLE {
            return None;
        }
        let mut square = (self.cos.clone(), self.sin.clone());
        for _ in 0..halvings {
            square = circle::halved(&square.0)?;
        }
        if numerator < 0 {
            square.1 = -square.1;
        }
        let mut result = (Number::one(), Number::zero());
        let mut left = numerator.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                result = circle::rotate(&result, &square);
            }
            left >>= 1;
            if left > 0 {
                square = circle::rotate(&square, &square);
            }
            if result.0.nodes().max(square.0.nodes()) > MAX_CIRCULAR_NODES {
                return None;
            }
        }
        Some(result)
    }
}

impl Number {
    /// The angle this number is, if it is known as one; the number zero is an angle too.
    pub(super) fn as_angle(&self) -> Option<Angle> {
        match self.exact()? {
            Exact::Angle(angle) => Some(angle.clone()),
            Exact::Rational(x) if x.is_zero() => Some(Angle::of_pi(RBig::ZERO)),
            _ => None,
        }
    }
}
