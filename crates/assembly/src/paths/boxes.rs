//! One solution in a box of complex numbers, and no other: Krawczyk's operator.
//!
//! For f with slopes in the matrix J over a box X with middle m, and any matrix C, K = m − C f(m) + (I − C J)(X − m) holds every solution
//! that X does, and if K lies in the interior of X there is exactly one (Krawczyk 1969). It holds for complex numbers as for real ones:
//! f(x) − f(m) is the integral of the slopes from m to x, and a box, which is convex, holds every mean of its points.
//! The equations are real, so that a solution in a box that is its own conjugate is its own conjugate: it is real.

use super::complex::{Arithmetic, Complex, solved};
use super::equations::Equations;
use crate::real::Interval;

/// All complex numbers of a rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    re: Interval,
    im: Interval,
}

impl Region {
    pub(super) fn real(re: Interval) -> Self {
        let im = Interval::point(0.0);
        Self { re, im }
    }

    fn point(z: Complex) -> Self {
        Self {
            re: Interval::point(z.re),
            im: Interval::point(z.im),
        }
    }

    /// Everything within a distance of a number in both parts; its own conjugate where the number is real.
    fn about(z: Complex, radius: f64) -> Self {
        let around = |x: f64| Interval::about(x, radius);
        Self {
            re: around(z.re),
            im: around(z.im),
        }
    }

    fn minus(self, other: Self) -> Self {
        Self {
            re: self.re.minus(other.re),
            im: self.im.minus(other.im),
        }
    }

    fn inside(self, other: Self) -> bool {
        self.re.inside(other.re) && self.im.inside(other.im)
    }

    fn misses(self, other: Self) -> bool {
        self.re.misses(other.re) || self.im.misses(other.im)
    }

    /// The largest magnitude of a part.
    fn size(self) -> f64 {
        let ends = [self.re.low, self.re.high, self.im.low, self.im.high];
        ends.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
    }
}

impl Arithmetic for Region {
    fn integer(n: u32) -> Self {
        Self::real(Interval::point(f64::from(n)))
    }

    fn plus(self, other: Self) -> Self {
        Self {
            re: self.re.plus(other.re),
            im: self.im.plus(other.im),
        }
    }

    fn times(self, other: Self) -> Self {
        Self {
            re: self.re.times(other.re).minus(self.im.times(other.im)),
            im: self.re.times(other.im).plus(self.im.times(other.re)),
        }
    }
}

/// A box with one solution.
pub(super) struct Proven {
    middle: Vec<Complex>,
    sides: Vec<Region>,
    radius: f64,
}

impl Proven {
    pub(super) fn is_apart_from(&self, other: &Self) -> bool {
        let mut pairs = self.sides.iter().zip(&other.sides);
        pairs.any(|(a, b)| a.misses(*b))
    }

    /// The solution and how far it may be off, where it is real.
    pub(super) fn real(&self) -> Option<(Vec<f64>, f64)> {
        let real = self.middle.iter().all(|z| z.im == 0.0);
        real.then(|| (self.middle.iter().map(|z| z.re).collect(), self.radius))
    }

    /// Whether the solution in it is certainly not real.
    fn is_not_real(&self) -> bool {
        self.sides.iter().any(|side| !side.im.holds(0.0))
    }
}

/// Boxes of these times what a step of Newton's method is off by are tried.
const WIDER: [f64; 4] = [8.0, 64.0, 1024.0, 1e5];

/// A coordinate that is smaller than this part of the largest one is known no better than one of this part.
const SMALL: f64 = 1e-3;

/// The box of a solution that is known to rounding; `None` where it is not proven, or not whether it is real.
pub(super) fn prove(equations: &Equations, at: &[Complex]) -> Option<Proven> {
    let real: Vec<Complex> = at.iter().map(|z| Complex::new(z.re, 0.0)).collect();
    // A solution near a real one is that one, if there is one.
    let size = at.iter().map(|z| z.size()).fold(1.0, f64::max);
    let near = at.iter().all(|z| z.im.abs() <= NEARLY_REAL * size);
    if near && let Some(proven) = proved(equations, &real) {
        return Some(proven);
    }
    proved(equations, at).filter(Proven::is_not_real)
}

/// Imaginary parts up to this, in parts of the size, may be rounding.
const NEARLY_REAL: f64 = 1e-6;

fn proved(equations: &Equations, at: &[Complex]) -> Option<Proven> {
    let count = at.len();
    let unit = |i: usize, j: usize| Complex::new(f64::from(u8::from(i == j)), 0.0);
    let units = (0..count).map(|i| (0..count).map(|j| unit(i, j)).collect());
    let inverse = solved(equations.at(at).slopes, units.collect())?;
    let points: Vec<Region> = at.iter().map(|z| Region::point(*z)).collect();
    let values = equations.on(&points).values;
    let zero = Region::integer(0);
    let step: Vec<Region> = inverse
        .iter()
        .map(|row| {
            let products = row.iter().zip(&values);
            products.fold(zero, |sum, (c, f)| sum.plus(Region::point(*c).times(*f)))
        })
        .collect();
    let size = at.iter().map(|z| z.size()).fold(1.0, f64::max);
    // Coordinates are of different sizes, and so is what they are off by.
    let least: Vec<f64> = step
        .iter()
        .zip(at)
        .map(|(s, z)| s.size().max(f64::EPSILON * z.size().max(SMALL * size)))
        .collect();
    WIDER.iter().find_map(|wider| {
        let radii: Vec<f64> = least.iter().map(|off| wider * off).collect();
        let pairs = at.iter().zip(&radii);
        let sides: Vec<Region> = pairs.map(|(z, r)| Region::about(*z, *r)).collect();
        let slopes = equations.on(&sides).slopes;
        let inside = (0..count).all(|i| {
            let mut image = points[i].minus(step[i]);
            for j in 0..count {
                let products = inverse[i].iter().zip(&slopes);
                let product = products.fold(zero, |sum, (c, row)| {
                    sum.plus(Region::point(*c).times(row[j]))
                });
                let rest = Region::point(unit(i, j)).minus(product);
                image = image.plus(rest.times(sides[j].minus(points[j])));
            }
            image.inside(sides[i])
        });
        inside.then(|| Proven {
            middle: at.to_vec(),
            sides,
            radius: radii.iter().copied().fold(0.0, f64::max),
        })
    })
}
