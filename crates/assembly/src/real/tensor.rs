//! Polynomials of degree two in every variable, in Bernstein form on a box.
//!
//! On the box that is the unit cube of its own coordinates, a polynomial lies between the least and the largest of its
//! coefficients, and it is a short sum to go from one box to a part of it. Every coefficient is known up to one radius for
//! all, which grows with each step: a combination with weights that sum to one in magnitude keeps the radius, and rounding
//! adds at most eight units of the largest coefficient (three products, two sums, weights that are products of two
//! differences themselves: 2u for a weight, u for its product, 2u for the sums, together below 8u of Σ|w| max|b|).
//!
//! What is unknown of the polynomial itself is another polynomial of this kind, with coefficients below a bound on the first box. Its
//! values stay below that bound on all boxes up to [`BEYOND`] outside of it, and its slopes fall with the length of the box.

/// Unit of rounding.
const UNIT: f64 = f64::EPSILON / 2.0;

/// How far outside of the first box, in parts of it, what is unknown is bounded.
pub(super) const BEYOND: f64 = 1.0 / 32.0;

/// A polynomial of degree at most two in each of some variables.
#[derive(Clone, Debug)]
pub(super) struct Tensor {
    /// The variables, ascending; the first varies slowest.
    pub(super) variables: Vec<usize>,
    /// 3ᵏ coefficients.
    pub(super) coefficients: Vec<f64>,
    /// How far every coefficient may be off by rounding.
    pub(super) radius: f64,
    /// How far the polynomial may be from the one meant, on the box.
    unknown: f64,
    /// The same of its derivative in each variable, the box being as long as one; empty where nothing is unknown.
    unknown_slopes: Vec<f64>,
}

impl Tensor {
    pub(super) fn new(variables: Vec<usize>, coefficients: Vec<f64>, radius: f64) -> Self {
        Self {
            unknown_slopes: Vec::new(),
            variables,
            coefficients,
            radius,
            unknown: 0.0,
        }
    }

    /// Least and largest value on the box that is possible.
    pub(super) fn range(&self) -> (f64, f64) {
        let mut low = f64::INFINITY;
        let mut high = f64::NEG_INFINITY;
        for &c in &self.coefficients {
            low = low.min(c);
            high = high.max(c);
        }
        (
            (low - self.radius - self.unknown).next_down().next_down(),
            (high + self.radius + self.unknown).next_up().next_up(),
        )
    }

    /// Lets every coefficient of the polynomial be off by so much, on the first box.
    pub(super) fn widen(&mut self, by: f64) {
        if by == 0.0 {
            return;
        }
        // The weights at 1 + t are t², 2t (1 + t) and (1 + t)², up to signs.
        const OUTSIDE: f64 = (1.0 + 2.0 * BEYOND) * (1.0 + 2.0 * BEYOND);
        let power = self.variables.iter().fold(1.0, |p, _| p * OUTSIDE);
        self.unknown = by * power * (1.0 + 16.0 * UNIT);
        // Twice the difference of two coefficients.
        self.unknown_slopes = vec![4.0 * self.unknown; self.variables.len()];
    }

    /// Whether something of the polynomial is unknown.
    pub(super) fn is_unknown(&self) -> bool {
        self.unknown > 0.0
    }

    /// The largest coefficient.
    pub(super) fn largest(&self) -> f64 {
        self.coefficients.iter().fold(0.0, |m, c| c.abs().max(m))
    }

    fn stride(&self, place: usize) -> usize {
        3usize.pow((self.variables.len() - 1 - place) as u32)
    }

    /// The same polynomial on the part of the box from `a` to `b` (0 to 1 is all of it) along one variable; beyond the box
    /// too.
    pub(super) fn restrict(&mut self, variable: usize, a: f64, b: f64) {
        let Some(place) = self.variables.iter().position(|&v| v == variable) else {
            return;
        };
        let blossom =
            |s: f64, t: f64| [(1.0 - s) * (1.0 - t), s * (1.0 - t) + t * (1.0 - s), s * t];
        let weights = [blossom(a, a), blossom(a, b), blossom(b, b)];
        let size = weights
            .iter()
            .map(|w| w.iter().map(|x| x.abs()).sum::<f64>())
            .fold(1.0, f64::max);
        // The sum of weights is one up to rounding, which the second term covers.
        self.radius = (self.radius * size * (1.0 + 16.0 * UNIT)
            + 8.0 * UNIT * size * self.largest())
        .next_up();
        if let Some(slope) = self.unknown_slopes.get_mut(place) {
            *slope = (*slope * (b - a).abs().next_up()).next_up();
        }
        let stride = self.stride(place);
        for start in 0..self.coefficients.len() {
            if !(start / stride).is_multiple_of(3) {
                continue;
            }
            let [x, y, z] = [0, 1, 2].map(|k| self.coefficients[start + k * stride]);
            for (k, w) in weights.iter().enumerate() {
                self.coefficients[start + k * stride] = w[0] * x + w[1] * y + w[2] * z;
            }
        }
    }

    /// Least and largest value on the box of the derivative in one variable, the box being as long as one.
    pub(super) fn slope(&self, variable: usize) -> (f64, f64) {
        let Some(place) = self.variables.iter().position(|&v| v == variable) else {
            return (0.0, 0.0);
        };
        let stride = self.stride(place);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for start in 0..self.coefficients.len() {
            if start / stride % 3 == 2 {
                continue;
            }
            let step = self.coefficients[start + stride] - self.coefficients[start];
            low = low.min(step);
            high = high.max(step);
        }
        let margin = 2.0 * self.radius + 2.0 * UNIT * self.largest();
        let unknown = self.unknown_slopes.get(place).copied().unwrap_or(0.0);
        (
            (2.0 * (low - margin).next_down() - unknown).next_down(),
            (2.0 * (high + margin).next_up() + unknown).next_up(),
        )
    }

    /// The value in the middle of the box, and how far it may be off.
    pub(super) fn middle(&self) -> (f64, f64) {
        let mut values = self.coefficients.clone();
        let mut length = values.len();
        let mut steps = 0.0;
        while length > 1 {
            length /= 3;
            for i in 0..length {
                values[i] =
                    0.25 * values[i] + 0.5 * values[i + length] + 0.25 * values[i + 2 * length];
            }
            steps += 1.0;
        }
        // Two sums a step; products by powers of two are exact.
        let radius = self.radius + self.unknown + 2.0 * UNIT * (steps + 1.0) * self.largest();
        (values[0], radius.next_up().next_up())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (x − 1/3)(y − 1/2) on the unit square.
    fn sample() -> Tensor {
        let x = [-1.0 / 3.0, 1.0 / 6.0, 2.0 / 3.0];
        let y = [-0.5, 0.0, 0.5];
        let products = x.iter().flat_map(|a| y.iter().map(move |b| a * b));
        Tensor::new(vec![0, 1], products.collect(), 1e-16)
    }

    #[test]
    fn parts_keep_values_and_enclose_them() {
        let whole = sample();
        for (a, b, c, d) in [
            (0.0, 0.5, 0.0, 1.0),
            (0.25, 0.75, 0.5, 0.625),
            (-0.25, 1.25, -0.5, 2.0),
        ] {
            let mut part = whole.clone();
            part.restrict(0, a, b);
            part.restrict(1, c, d);
            let (x, y) = (0.5 * (a + b), 0.5 * (c + d));
            let value = (x - 1.0 / 3.0) * (y - 0.5);
            let (middle, radius) = part.middle();
            assert!((middle - value).abs() <= radius + 1e-16);
            let (low, high) = part.range();
            for corner in [(a, c), (a, d), (b, c), (b, d)] {
                let value = (corner.0 - 1.0 / 3.0) * (corner.1 - 0.5);
                assert!(low <= value && value <= high);
            }
            let (low, high) = part.slope(0);
            for y in [c, d] {
                let slope = (y - 0.5) * (b - a);
                assert!(low <= slope + 1e-15 && slope - 1e-15 <= high);
            }
            assert!(part.radius < 1e-13);
        }
    }

    /// A polynomial that is off by another one stays within what is said to be unknown of it, on parts of the box and beyond it.
    #[test]
    fn what_is_unknown_covers_another_polynomial() {
        let by = 1e-3;
        let mut random = kutzbach_math::matrix::SplitMix64::new(11);
        let mut sign = || {
            if random.next_u64().is_multiple_of(2) {
                by
            } else {
                -by
            }
        };
        let plain = sample();
        let off = plain.coefficients.iter().map(|c| c + sign()).collect();
        let other = Tensor::new(vec![0, 1], off, 0.0);
        for (a, b) in [(0.0, 0.5), (0.25, 0.3125), (0.5, 0.5 + 1e-3), (-0.03, 1.03)] {
            let (mut wide, mut there) = (plain.clone(), other.clone());
            wide.widen(by);
            for variable in [0, 1] {
                wide.restrict(variable, a, b);
                there.restrict(variable, a, b);
            }
            let (middle, radius) = wide.middle();
            assert!((there.middle().0 - middle).abs() <= radius);
            let (range, inner) = (wide.range(), there.range());
            assert!(range.0 <= inner.0 && inner.1 <= range.1);
            for variable in [0, 1] {
                let (slope, inner) = (wide.slope(variable), there.slope(variable));
                assert!(
                    slope.0 <= inner.0 && inner.1 <= slope.1,
                    "{slope:?} {inner:?}"
                );
                // A thousandth of the box has a thousandth of the slope left open.
                assert!(slope.1 - slope.0 <= (32.0 * by + 1.1) * (b - a));
            }
        }
    }
}
