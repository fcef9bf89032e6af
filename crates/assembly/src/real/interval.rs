//! Intervals of doubles, rounded outwards.
//!
//! A sum, product or quotient of doubles is off by at most half a unit in the last place, so that the next double on either
//! side encloses it. Nothing here depends on the rounding mode or on a library of functions.

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// The interval between two numbers.
    #[must_use]
    pub fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// One number.
    #[must_use]
    pub fn point(x: f64) -> Self {
        Self::new(x, x)
    }

    /// Everything within a distance of a number.
    #[must_use]
    pub fn about(x: f64, radius: f64) -> Self {
        Self::new((x - radius).next_down(), (x + radius).next_up())
    }

    /// What a correctly rounded double may stand for.
    #[must_use]
    pub fn rounded(x: f64) -> Self {
        Self::new(x.next_down(), x.next_up())
    }

    /// The sum.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self::new(
            (self.low + other.low).next_down(),
            (self.high + other.high).next_up(),
        )
    }

    /// The difference.
    #[must_use]
    pub fn minus(self, other: Self) -> Self {
        Self::new(
            (self.low - other.high).next_down(),
            (self.high - other.low).next_up(),
        )
    }

    /// The product.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        let products = [
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ];
        let low = products.iter().copied().fold(f64::INFINITY, f64::min);
        let high = products.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self::new(low.next_down(), high.next_up())
    }

    /// The quotient; `None` where the divisor holds zero.
    #[must_use]
    pub fn over(self, divisor: Self) -> Option<Self> {
        if divisor.holds(0.0) {
            return None;
        }
        let ends = [
            self.low / divisor.low,
            self.low / divisor.high,
            self.high / divisor.low,
            self.high / divisor.high,
        ];
        let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let high = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Some(Self::new(low.next_down(), high.next_up()))
    }

    /// Whether a number is in it.
    #[must_use]
    pub fn holds(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    /// Whether no number is in both.
    #[must_use]
    pub fn misses(self, other: Self) -> bool {
        self.high < other.low || other.high < self.low
    }

    /// Whether all of it is within the other's open interior.
    #[must_use]
    pub fn inside(self, other: Self) -> bool {
        other.low < self.low && self.high < other.high
    }

    /// Length.
    #[must_use]
    pub fn width(self) -> f64 {
        self.high - self.low
    }

    /// Middle.
    #[must_use]
    pub fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    /// Middle and radius, so that all of it is within the radius.
    #[must_use]
    pub fn ball(self) -> (f64, f64) {
        let middle = self.middle();
        let radius = (middle - self.low).max(self.high - middle);
        (middle, radius.next_up())
    }
}
