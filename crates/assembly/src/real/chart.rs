//! A reduced system as polynomials on a few boxes.
//!
//! A turn about an axis is a point (q₀ : q₁) of a projective line, the half angle's cosine and sine; one about a point a
//! quaternion (q₀ : … : q₃). Dividing by the component of largest size leaves the others between −1 and 1, so that two or four
//! boxes hold all turns, and nothing is far away. In each of them the equations, times the squared lengths, have degree two in
//! every variable. The boxes are a little larger than that, so that no solution is on an edge.

use super::interval::Interval;
use super::tensor::Tensor;
use crate::reduced::{Poly, ReducedSystem, Unknowns};
use kutzbach_math::number::Number;

/// Half the length of every side of a box. More than one, and a number of few bits.
pub(super) const REACH: f64 = 1.0 + 1.0 / 1024.0;

/// Which component of every turn is the largest.
pub(super) type Chart = Vec<usize>;

/// All charts of a system.
pub(super) fn charts(system: &ReducedSystem) -> Vec<Chart> {
    let mut all: Vec<Chart> = vec![Vec::new()];
    for turn in &system.unknowns {
        all = all
            .into_iter()
            .flat_map(|chart| {
                (0..turn.count()).map(move |largest| {
                    let mut more = chart.clone();
                    more.push(largest);
                    more
                })
            })
            .collect();
    }
    all
}

/// A polynomial in a few variables by powers: 3ᵏ coefficients, the first variable slowest.
#[derive(Clone)]
struct Powers {
    variables: usize,
    coefficients: Vec<Interval>,
}

impl Powers {
    fn constant(value: Interval) -> Self {
        Self {
            variables: 0,
            coefficients: vec![value],
        }
    }

    /// The product of polynomials in different variables.
    fn beside(&self, other: &Self) -> Self {
        let product = |a: &Interval| {
            other
                .coefficients
                .iter()
                .map(|b| a.times(*b))
                .collect::<Vec<_>>()
        };
        Self {
            variables: self.variables + other.variables,
            coefficients: self.coefficients.iter().flat_map(product).collect(),
        }
    }
}

/// Components of a turn in a chart: `None` is the one that is one, `Some(i)` variable i of the turn.
fn components(count: usize, largest: usize) -> Vec<Option<usize>> {
    let mut next = 0;
    (0..count)
        .map(|component| {
            (component != largest).then(|| {
                next += 1;
                next - 1
            })
        })
        .collect()
}

/// The product of two components, as powers of the turn's variables, times a factor.
fn product(turn: &[Option<usize>], i: usize, j: usize, factor: Interval, into: &mut Powers) {
    let mut exponents = vec![0usize; turn.len() - 1];
    for component in [turn[i], turn[j]].into_iter().flatten() {
        exponents[component] += 1;
    }
    let place = exponents.iter().fold(0, |place, e| 3 * place + e);
    into.coefficients[place] = into.coefficients[place].plus(factor);
}

fn zero(variables: usize) -> Powers {
    Powers {
        variables,
        coefficients: vec![Interval::point(0.0); 3usize.pow(variables as u32)],
    }
}

/// The squared length of a turn's components.
fn squared_length(turn: &[Option<usize>]) -> Powers {
    let mut sum = zero(turn.len() - 1);
    for i in 0..turn.len() {
        product(turn, i, i, Interval::point(1.0), &mut sum);
    }
    sum
}

/// The root of a positive number, enclosed.
fn root(number: &Number) -> Interval {
    match number.sqrt() {
        Ok(root) => Interval::rounded(root.value()),
        // Not reached for squares of lengths.
        Err(_) => Interval::new(f64::NEG_INFINITY, f64::INFINITY),
    }
}

/// The scales of x and y, or nothing.
pub(super) fn scales(system: &ReducedSystem) -> Vec<[Interval; 2]> {
    let scale = |turn: &Unknowns| match turn {
        Unknowns::Hinge { ratio, axis, .. } => {
            let ratio = system.field.number(ratio);
            let across = ratio
                .checked_div(&system.field.number(axis))
                .unwrap_or_else(|_| Number::zero());
            [root(&ratio), root(&across)]
        }
        Unknowns::Ball { .. } => [Interval::point(1.0); 2],
    };
    system.unknowns.iter().map(scale).collect()
}

/// What a turn contributes to a term, by the exponents of its unknowns; times its squared length.
fn contribution(
    turn: &Unknowns,
    exponents: &[u8],
    chart: &[Option<usize>],
    scales: [Interval; 2],
) -> Powers {
    if exponents.iter().all(|&e| e == 0) {
        return squared_length(chart);
    }
    let mut powers = zero(turn.freedom());
    match turn {
        Unknowns::Hinge { .. } if exponents[0] == 1 => {
            // cos = q₀² − q₁².
            product(chart, 0, 0, scales[0], &mut powers);
            let minus = Interval::new(-scales[0].high, -scales[0].low);
            product(chart, 1, 1, minus, &mut powers);
        }
        Unknowns::Hinge { .. } => {
            // sin = 2 q₀ q₁.
            let twice = Interval::new(2.0 * scales[1].low, 2.0 * scales[1].high);
            product(chart, 0, 1, twice, &mut powers);
        }
        Unknowns::Ball { .. } => {
            let mut factors = exponents
                .iter()
                .enumerate()
                .flat_map(|(i, &e)| std::iter::repeat_n(i, usize::from(e)));
            if let (Some(i), Some(j)) = (factors.next(), factors.next()) {
                product(chart, i, j, Interval::point(1.0), &mut powers);
            }
        }
    }
    powers
}

/// The closures of a system in a chart, on its whole box.
pub(super) fn tensors(
    system: &ReducedSystem,
    scales: &[[Interval; 2]],
    chart: &Chart,
) -> Vec<Tensor> {
    let closure = |polynomial: &Poly| tensor(system, scales, chart, polynomial);
    system
        .closures
        .iter()
        .map(|c| closure(&c.polynomial))
        .collect()
}

/// The size of every closure: the largest coefficient of all of its kind, since one that cancels says little of what it is known to.
pub(super) fn sizes(system: &ReducedSystem, tensors: &[Tensor]) -> Vec<f64> {
    let all = || system.closures.iter().zip(tensors);
    let largest = |square: bool| {
        let of_kind = all().filter(|(closure, _)| closure.is_square() == square);
        of_kind.fold(f64::MIN_POSITIVE, |m, (_, tensor)| m.max(tensor.largest()))
    };
    let of_kind = [false, true].map(largest);
    all()
        .map(|(closure, _)| of_kind[usize::from(closure.is_square())])
        .collect()
}

fn tensor(
    system: &ReducedSystem,
    scales: &[[Interval; 2]],
    chart: &Chart,
    polynomial: &Poly,
) -> Tensor {
    let involved: Vec<usize> = (0..system.unknowns.len())
        .filter(|&t| {
            let turn = &system.unknowns[t];
            let range = turn.first()..turn.first() + turn.count();
            polynomial
                .terms()
                .any(|(e, _)| range.clone().any(|i| e.get(i).is_some_and(|&e| e > 0)))
        })
        .collect();
    let mut first = 0;
    let offsets: Vec<usize> = system
        .unknowns
        .iter()
        .map(|turn| {
            first += turn.freedom();
            first - turn.freedom()
        })
        .collect();
    let variables: Vec<usize> = involved
        .iter()
        .flat_map(|&t| offsets[t]..offsets[t] + system.unknowns[t].freedom())
        .collect();
    let mut sum = zero(variables.len());
    for (exponents, coefficient) in polynomial.terms() {
        let value = Interval::rounded(system.field.number(coefficient).value());
        let mut term = Powers::constant(value);
        for &t in &involved {
            let turn = &system.unknowns[t];
            let own: Vec<u8> = (turn.first()..turn.first() + turn.count())
                .map(|i| exponents.get(i).copied().unwrap_or(0))
                .collect();
            let parts = components(turn.count(), chart[t]);
            term = term.beside(&contribution(turn, &own, &parts, scales[t]));
        }
        for (total, part) in sum.coefficients.iter_mut().zip(&term.coefficients) {
            *total = total.plus(*part);
        }
    }
    bernstein(sum, variables)
}

/// From powers on −REACH…REACH to Bernstein form: p(−r), p₀ − p₂ r², p(r) along every variable.
fn bernstein(mut powers: Powers, variables: Vec<usize>) -> Tensor {
    let reach = Interval::point(REACH);
    let square = reach.times(reach);
    for place in 0..powers.variables {
        let stride = 3usize.pow((powers.variables - 1 - place) as u32);
        for start in 0..powers.coefficients.len() {
            if !(start / stride).is_multiple_of(3) {
                continue;
            }
            let [p0, p1, p2] = [0, 1, 2].map(|k| powers.coefficients[start + k * stride]);
            let (odd, even) = (p1.times(reach), p2.times(square));
            powers.coefficients[start] = p0.minus(odd).plus(even);
            powers.coefficients[start + stride] = p0.minus(even);
            powers.coefficients[start + 2 * stride] = p0.plus(odd).plus(even);
        }
    }
    let balls: Vec<(f64, f64)> = powers.coefficients.iter().map(|c| c.ball()).collect();
    let radius = balls.iter().fold(0.0, |m: f64, (_, r)| m.max(*r));
    let coefficients = balls.iter().map(|(c, _)| *c).collect();
    Tensor::new(variables, coefficients, radius)
}

/// The components of every turn at a place of a chart.
pub(super) fn homogeneous(
    system: &ReducedSystem,
    chart: &Chart,
    at: &[Interval],
) -> Vec<Vec<Interval>> {
    let mut first = 0;
    let mut all = Vec::new();
    for (turn, &largest) in system.unknowns.iter().zip(chart) {
        let of = components(turn.count(), largest);
        all.push(
            of.iter()
                .map(|c| c.map_or(Interval::point(1.0), |i| at[first + i]))
                .collect(),
        );
        first += turn.freedom();
    }
    all
}

/// The same place in another chart; `None` where it may be outside of all that chart can say.
pub(super) fn moved(
    system: &ReducedSystem,
    from: &Chart,
    at: &[Interval],
    to: &Chart,
) -> Option<Vec<Interval>> {
    let mut result = Vec::new();
    for (turn, &largest) in homogeneous(system, from, at).iter().zip(to) {
        for (component, value) in turn.iter().enumerate() {
            if component != largest {
                result.push(value.over(turn[largest])?);
            }
        }
    }
    Some(result)
}

/// The unknowns at a place of a chart, in doubles.
pub(super) fn unknowns_at(
    system: &ReducedSystem,
    scales: &[[Interval; 2]],
    chart: &Chart,
    at: &[f64],
) -> Vec<f64> {
    let points: Vec<Interval> = at.iter().map(|&x| Interval::point(x)).collect();
    let mut values = Vec::new();
    for ((turn, q), scale) in system
        .unknowns
        .iter()
        .zip(homogeneous(system, chart, &points))
        .zip(scales)
    {
        let q: Vec<f64> = q.iter().map(|c| c.middle()).collect();
        let square: f64 = q.iter().map(|c| c * c).sum();
        match turn {
            Unknowns::Hinge { .. } => {
                values.push(scale[0].middle() * (q[0] * q[0] - q[1] * q[1]) / square);
                values.push(scale[1].middle() * 2.0 * q[0] * q[1] / square);
            }
            Unknowns::Ball { .. } => {
                // The sign that makes the real part positive: a rotation has two quaternions.
                let sign = if q[0] < 0.0 { -1.0 } else { 1.0 };
                values.extend(q.iter().map(|c| sign * c / square.sqrt()));
            }
        }
    }
    values
}
