//! What an axis shows, and where on it a value lies.

use super::ticks::{Ticks, decades, linear_ticks, log_ticks, power_of_ten};

/// How values are laid out along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences are equally long.
    Linear,
    /// Equal ratios are equally long. Values of zero or less lie at the lower end and are marked.
    Log,
}

/// One axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it shows, with its unit.
    pub label: String,
    /// How.
    pub scale: Scale,
    /// Least and greatest value shown. A range that is none (not finite, reversed, of no length, not positive on a
    /// logarithmic axis) is replaced by one that is near.
    pub range: [f64; 2],
}

impl Axis {
    /// An axis with the range as given.
    #[must_use]
    pub fn new(label: impl Into<String>, scale: Scale, range: [f64; 2]) -> Self {
        Self {
            label: label.into(),
            scale,
            range,
        }
    }

    /// An axis that has room for all values that are finite (and positive, on a logarithmic axis), and a margin.
    ///
    /// Values that agree to nine digits are taken for one: their differences are rounding, and a picture of rounding says
    /// nothing. Without any values the range is 0 to 1 (0.1 to 1).
    #[must_use]
    pub fn around(
        label: impl Into<String>,
        scale: Scale,
        values: impl IntoIterator<Item = f64>,
    ) -> Self {
        let shown = |x: &f64| x.is_finite() && (scale == Scale::Linear || *x > 0.0);
        let (low, high) = values
            .into_iter()
            .filter(shown)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            });
        let range = match scale {
            _ if low > high => [f64::NAN; 2],
            Scale::Linear => {
                let same = high - low <= 1e-9 * low.abs().max(high.abs());
                let margin = match (same, low == 0.0 && high == 0.0) {
                    (true, true) => 1.0,
                    (true, false) => 0.5 * low.abs().max(high.abs()),
                    (false, _) => 0.06 * (high - low),
                };
                // What is never negative needs no room for it.
                let floor = if low >= 0.0 { 0.0 } else { f64::NEG_INFINITY };
                [(low - margin).max(floor), high + margin]
            }
            Scale::Log => {
                let (from, to) = decades(low, high);
                [power_of_ten(from), power_of_ten(to.max(from + 1))]
            }
        };
        Self::new(label, scale, range)
    }

    /// The range as it is drawn: finite, of positive length, positive on a logarithmic axis.
    #[must_use]
    pub fn drawn_range(&self) -> [f64; 2] {
        let [a, b] = self.range;
        let (mut low, mut high) = (a.min(b), a.max(b));
        // Room for the differences and ratios below.
        let usable = |x: f64| x.is_finite() && x.abs() < 1e300;
        match self.scale {
            Scale::Linear => {
                if !(usable(a) && usable(b)) {
                    return [0.0, 1.0];
                }
                if !(high - low > 1e-12 * low.abs().max(high.abs())) {
                    let margin = if high == 0.0 { 1.0 } else { 0.5 * high.abs() };
                    (low, high) = (low - margin, high + margin);
                }
            }
            Scale::Log => {
                if !(usable(high) && high > 1e-290) {
                    return [0.1, 1.0];
                }
                if !(low > 1e-300) {
                    low = 1e-6 * high;
                }
                if !(high / low > 1.0 + 1e-9) {
                    (low, high) = (0.3 * low, 3.0 * high);
                }
            }
        }
        [low, high]
    }

    pub(super) fn ticks(&self, target: usize) -> Ticks {
        let range = self.drawn_range();
        match self.scale {
            Scale::Linear => linear_ticks(range, target),
            Scale::Log => log_ticks(range, target),
        }
    }

    pub(super) fn word(&self) -> &'static str {
        match self.scale {
            Scale::Linear => "linear",
            Scale::Log => "log",
        }
    }
}

/// Where a value came to lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// In pixels, always within the frame.
    pub at: f64,
    /// −1 where the value lies below the frame, 1 above it, 0 within.
    pub beyond: i8,
}

/// An axis laid onto pixels.
#[derive(Clone, Debug)]
pub(super) struct Ruler {
    range: [f64; 2],
    scale: Scale,
    pixels: [f64; 2],
}

impl Ruler {
    /// `pixels`: where the least and the greatest value lie.
    pub fn new(axis: &Axis, pixels: [f64; 2]) -> Self {
        Self {
            range: axis.drawn_range(),
            scale: axis.scale,
            pixels,
        }
    }

    /// `None` where the value is not a number.
    pub fn place(&self, value: f64) -> Option<Place> {
        if value.is_nan() {
            return None;
        }
        let [low, high] = self.range;
        let share = match self.scale {
            Scale::Linear => (value - low) / (high - low),
            Scale::Log if value > 0.0 => (value / low).log10() / (high / low).log10(),
            Scale::Log => f64::NEG_INFINITY,
        };
        // A hair beyond the end is rounding.
        let beyond = match share {
            s if s < -1e-9 => -1,
            s if s > 1.0 + 1e-9 => 1,
            _ => 0,
        };
        let [from, to] = self.pixels;
        Some(Place {
            at: from + (to - from) * share.clamp(0.0, 1.0),
            beyond,
        })
    }

    /// Where the value lies, or the nearest end.
    pub fn at(&self, value: f64) -> f64 {
        self.place(value).map_or(self.pixels[0], |place| place.at)
    }

    /// Least and greatest value and their pixels, as the page's script wants them.
    pub fn described(&self, word: &str) -> String {
        let ([low, high], [from, to]) = (self.range, self.pixels);
        format!(
            "{low} {high} {word} {} {}",
            crate::picture::markup::px(from),
            crate::picture::markup::px(to)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_that_is_none_becomes_one() {
        let drawn = |scale, range| Axis::new("x", scale, range).drawn_range();
        assert_eq!(drawn(Scale::Linear, [f64::NAN, 1.0]), [0.0, 1.0]);
        assert_eq!(drawn(Scale::Linear, [2.0, 2.0]), [1.0, 3.0]);
        assert_eq!(drawn(Scale::Linear, [3.0, -1.0]), [-1.0, 3.0]);
        assert_eq!(drawn(Scale::Log, [0.0, 1e3]), [1e-3, 1e3]);
        assert_eq!(drawn(Scale::Log, [-5.0, -1.0]), [0.1, 1.0]);
    }

    #[test]
    fn axes_have_room_for_their_values() {
        let axis = Axis::around("x", Scale::Linear, [0.0, f64::NAN, 10.0]);
        assert_eq!(axis.range, [0.0, 10.6]);
        let axis = Axis::around("x", Scale::Log, [3e-9, 0.0, 20.0]);
        assert_eq!(axis.range, [1e-9, 100.0]);
        // Rounding is not shown as if it were a motion.
        let axis = Axis::around("x", Scale::Linear, [2.0, 2.0 + 4e-16]);
        assert!((axis.range[0] - 1.0).abs() < 1e-9 && (axis.range[1] - 3.0).abs() < 1e-9);
        assert_eq!(Axis::around("x", Scale::Log, []).drawn_range(), [0.1, 1.0]);
    }

    #[test]
    fn what_lies_outside_is_at_the_border() {
        let axis = Axis::new("x", Scale::Log, [1e-4, 1.0]);
        let ruler = Ruler::new(&axis, [0.0, 400.0]);
        assert!((ruler.at(1e-3) - 100.0).abs() < 1e-9);
        assert_eq!(
            ruler.place(0.0),
            Some(Place {
                at: 0.0,
                beyond: -1
            })
        );
        assert_eq!(ruler.place(f64::INFINITY).map(|p| p.beyond), Some(1));
        assert_eq!(ruler.place(f64::NAN), None);
    }
}
