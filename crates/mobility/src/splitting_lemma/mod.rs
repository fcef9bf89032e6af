//! Germs of one equation whose quadratic terms have rank two or more, in as many digits as it takes.
//!
//! By the splitting lemma such an equation is `q(u) + g(w)` in suitable coordinates, with q the quadratic terms as squares and g of order
//! three or more in the coordinates of their null space. What is known of q and g tells the real branches:
//!
//! ```text
//! q indefinite of rank ≥ 3                       irreducible, one branch of one dimension less        forms of rank ≥ 3 are no products
//! q = u₁ u₂, g ≠ 0                               the same                                             a product has two factors of order 1
//! q = u₁ u₂, g = 0                               two smooth sheets that cross
//! q definite, w one variable, q + g = 0          isolated, a line along which the equation vanishes twice, or one branch
//! ```
//!
//! `g(w)` is the value at the point where f is critical in u: it is found by Newton's method with derivatives from differences, at a
//! place so near, in so many digits, that terms up to a stated order would show. Nothing is searched, so that planes that cross at a
//! billionth of a radian differ from one plane. A real branch has its whole dimension because the equation changes its sign along it.
//!
//! Source: the splitting lemma, as in Greuel, Lossen and Shustin, *Introduction to Singularities and Deformations*, §I.2.4; Morse's
//! lemma where q has full rank.

mod diagonal;

use crate::leftover::{ABSOLUTE, Doubt, power_of_two};
use diagonal::{CLEAR, Diagonal, ZERO};
use kutzbach_math::matrix::{Extended, Real, Ring, SplitMix64};

/// g is looked at this near, or nearer where a square is small: 2^−this.
const NEAR: i64 = 30;

/// Places in the null space at which g has to vanish to be zero.
const PLACES: usize = 3;

/// Newton's method doubles the digits: more steps than this do not converge.
const STEPS: usize = 20;

/// An equation near the origin, evaluated in the digits of its argument.
pub(crate) trait Equation {
    /// # Errors
    /// [`Doubt`] where it cannot be evaluated.
    fn value(&mut self, at: &[Extended]) -> Result<Extended, Doubt>;
}

/// The quadratic terms of an equation.
pub(crate) struct Squares {
    /// How many squares are positive, and how many negative.
    pub signature: (usize, usize),
    /// The smallest square has at least 2^−this of the largest.
    pub narrow: i64,
    /// The quadratic terms along the vectors of squares, rounded.
    pub sizes: Vec<f64>,
    /// Vectors of the squares, of unit length, rounded.
    pub across: Vec<Vec<f64>>,
    /// Vectors that span the null space, of unit length, rounded.
    pub null: Vec<Vec<f64>>,
    /// The two directions along which an indefinite form of rank two vanishes.
    pub lines: Option<[Vec<f64>; 2]>,
}

/// What the equation is in the coordinates of the null space: g.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rest {
    /// It vanishes to the order asked for.
    Zero,
    /// Not zero. In one variable, the order of the first term and the signs of g on both sides.
    Some(Option<(u32, [bool; 2])>),
}

/// Bits in which quadratic terms are to be computed; `extra` ones for numbers of many digits.
pub(crate) fn bits_of_squares(extra: i64) -> u32 {
    (4 * STEP + 64 + 2 * extra) as u32
}

/// Quadratic terms are differences over 2^−this.
const STEP: i64 = 160;

/// The quadratic terms of an equation in some variables, that are known to the share `stated` of the largest at best.
///
/// # Errors
/// [`Doubt`] where they are neither zero nor clearly different from it.
pub(crate) fn squares(
    equation: &mut impl Equation,
    variables: usize,
    one: &Extended,
    stated: f64,
) -> Result<Squares, Doubt> {
    let h = power_of_two(one, -STEP);
    let mut even = |places: &[usize]| -> Result<Extended, Doubt> {
        let mut sum = one.zero_like();
        for side in [1.0, -1.0] {
            let mut at = vec![one.zero_like(); variables];
            for &place in places {
                at[place] = at[place].clone() + one.constant(side) * h.clone();
            }
            sum = sum + equation.value(&at)?;
        }
        Ok(sum * one.constant(0.5) * power_of_two(one, 2 * STEP))
    };
    let mut form = vec![vec![one.zero_like(); variables]; variables];
    for i in 0..variables {
        form[i][i] = even(&[i])?;
        for j in 0..i {
            let both = even(&[i, j])?;
            let mixed = (both - form[i][i].clone() - form[j][j].clone()) * one.constant(0.5);
            form[i][j] = mixed.clone();
            form[j][i] = mixed;
        }
    }
    // Terms of order four are left, and where nothing is quadratic they are all.
    let known = power_of_two(one, -2 * STEP);
    let most = form
        .iter()
        .flatten()
        .map(Extended::abs)
        .fold(one.zero_like(), |most, x| if x > most { x } else { most });
    let stated = one.constant(stated) * most;
    let diagonal = Diagonal::of(form, if stated > known { &stated } else { &known })?;
    let doubles = |vector: &[Extended]| -> Vec<f64> {
        let vector: Vec<f64> = vector.iter().map(Real::to_f64).collect();
        let length = 0.0.norm(&vector);
        vector.iter().map(|x| x / length).collect()
    };
    let lines = match &diagonal.squares[..] {
        [(a, u), (b, v)] if diagonal.signature() == (1, 1) => {
            let ratio = (-(b.clone() / a.clone())).sqrt();
            Some([1.0, -1.0].map(|side| {
                let mut line = v.clone();
                (ratio.clone() * one.constant(side)).add_scaled(u, &mut line);
                doubles(&line)
            }))
        }
        _ => None,
    };
    Ok(Squares {
        signature: diagonal.signature(),
        narrow: diagonal.narrow(),
        sizes: diagonal
            .squares
            .iter()
            .map(|(square, v)| {
                let length = 0.0.norm(&v.iter().map(Real::to_f64).collect::<Vec<_>>());
                square.to_f64() / (length * length)
            })
            .collect(),
        across: diagonal.squares.iter().map(|(_, v)| doubles(v)).collect(),
        null: diagonal.null.iter().map(|v| doubles(v)).collect(),
        lines,
    })
}

impl Squares {
    fn largest(&self) -> f64 {
        self.sizes.iter().fold(0.0, |most, x| most.max(x.abs()))
    }

    /// Where terms of g up to an order show, whatever the other coefficients are; `extra` bits for numbers of many digits.
    pub fn near(&self, orders: i64, extra: i64) -> Look {
        self.look(NEAR + self.narrow + extra, orders)
    }

    /// The same farther out, where narrow squares need not outweigh what follows them: there Newton's method may fail.
    pub fn farther(&self, orders: i64, extra: i64) -> Look {
        self.look(NEAR + extra, orders)
    }

    fn look(&self, near: i64, orders: i64) -> Look {
        Look {
            near,
            bits: (orders * near + 4 * self.narrow + 256) as u32,
        }
    }
}

/// How near g is looked at, 2^−near, and in how many bits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    near: i64,
    pub bits: u32,
}

/// g of an equation with these squares.
///
/// # Errors
/// [`Doubt`] where it is neither zero nor clearly different from it.
pub(crate) fn rest(
    equation: &mut impl Equation,
    squares: &Squares,
    look: Look,
) -> Result<Rest, Doubt> {
    let one = &Extended::new(1.0, look.bits);
    let near = power_of_two(one, -look.near);
    // What rounding and differences leave of the value.
    let bits = i64::from(look.bits);
    let differences = near.clone()
        * near.clone()
        * power_of_two(one, 64 + 3 * squares.narrow - bits)
        * one.constant(squares.largest());
    let rounding = power_of_two(one, ABSOLUTE - bits);
    let error = if differences > rounding {
        differences
    } else {
        rounding
    };
    let (zero, clear) = (
        error.clone() * one.constant(ZERO),
        error * one.constant(CLEAR),
    );
    let mut at = |place: &[f64], distance: &Extended| -> Result<Option<Extended>, Doubt> {
        let value = critical_value(equation, squares, place, distance)?;
        let size = value.abs();
        if size <= zero {
            Ok(None)
        } else if size >= clear {
            Ok(Some(value))
        } else {
            Err(Doubt::Precision)
        }
    };
    if let [only] = &squares.null[..] {
        let half = near.clone() * one.constant(0.5);
        let mut told: Vec<(u32, bool)> = Vec::new();
        for side in [1.0, -1.0] {
            let place: Vec<f64> = only.iter().map(|x| side * x).collect();
            let Some(far) = at(&place, &near)? else {
                // What vanishes to such an order on one side does on the other.
                return Ok(Rest::Zero);
            };
            let nearer = at(&place, &half)?.ok_or(Doubt::Precision)?;
            let positive = far > far.zero_like();
            let ratio = (far / nearer).to_f64();
            // So near, one term outweighs all others.
            let order = ratio.log2().round();
            if !((ratio.log2() - order).abs() < 1e-3) {
                return Err(Doubt::Precision);
            }
            told.push((order as u32, positive));
        }
        return match told[..] {
            [(a, plus), (b, minus)] if a == b && (plus == minus) == (a % 2 == 0) => {
                Ok(Rest::Some(Some((a, [plus, minus]))))
            }
            _ => Err(Doubt::Precision),
        };
    }
    let mut random = SplitMix64::named("splitting lemma");
    for _ in 0..PLACES {
        let mut place = vec![0.0; squares.null[0].len()];
        for vector in &squares.null {
            random.symmetric().add_scaled(vector, &mut place);
        }
        let length = 0.0.norm(&place);
        place.iter_mut().for_each(|x| *x /= length);
        if at(&place, &near)?.is_some() {
            return Ok(Rest::Some(None));
        }
    }
    Ok(Rest::Zero)
}

/// The value of an equation where it is critical across the null space, at a distance in a direction of the null space.
fn critical_value(
    equation: &mut impl Equation,
    squares: &Squares,
    place: &[f64],
    distance: &Extended,
) -> Result<Extended, Doubt> {
    let one = distance.one_like();
    let bits = i64::from(one.bits());
    let exact =
        |vector: &[f64]| -> Vec<Extended> { vector.iter().map(|x| one.constant(*x)).collect() };
    let across: Vec<Vec<Extended>> = squares.across.iter().map(|v| exact(v)).collect();
    let h = distance.clone() * power_of_two(&one, -bits / 4);
    let largest = one.constant(squares.largest());
    let mut at: Vec<Extended> = exact(place)
        .into_iter()
        .map(|x| x * distance.clone())
        .collect();
    // Off by so much, the value is off by the square of it.
    let enough = distance.clone() * power_of_two(&one, squares.narrow + 16 - bits / 2);
    for _ in 0..STEPS {
        let here = equation.value(&at)?;
        let mut beside = |steps: &[(usize, f64)]| -> Result<Extended, Doubt> {
            let mut there = at.clone();
            for (direction, side) in steps {
                (h.clone() * one.constant(*side)).add_scaled(&across[*direction], &mut there);
            }
            equation.value(&there)
        };
        let count = across.len();
        let mut slopes = Vec::with_capacity(count);
        let mut form = vec![vec![one.zero_like(); count]; count];
        let mut ahead = Vec::with_capacity(count);
        for i in 0..count {
            let [plus, minus] = [beside(&[(i, 1.0)])?, beside(&[(i, -1.0)])?];
            slopes.push((minus.clone() - plus.clone()) * one.constant(0.5) / h.clone());
            let curved = plus.clone() + minus - one.constant(2.0) * here.clone();
            form[i][i] = curved / (h.clone() * h.clone());
            ahead.push(plus);
            for j in 0..i {
                let both = beside(&[(i, 1.0), (j, 1.0)])?;
                let mixed = both - ahead[i].clone() - ahead[j].clone() + here.clone();
                // One-sided differences are off by terms of order three, which Newton's method does not mind.
                form[i][j] = mixed / (h.clone() * h.clone());
                form[j][i] = form[i][j].clone();
            }
        }
        let hessian = Diagonal::of(form, &(largest.clone() * power_of_two(&one, -bits / 4)))?;
        if !hessian.null.is_empty() {
            return Err(Doubt::Precision);
        }
        let step = hessian.solve(&slopes);
        let moved = step.iter().fold(
            one.zero_like(),
            |most, x| if x.abs() > most { x.abs() } else { most },
        );
        if !moved.is_finite() {
            return Err(Doubt::Arithmetic);
        }
        if moved <= enough {
            return Ok(here);
        }
        for (share, vector) in step.iter().zip(&across) {
            share.add_scaled(vector, &mut at);
        }
    }
    Err(Doubt::Arithmetic)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
