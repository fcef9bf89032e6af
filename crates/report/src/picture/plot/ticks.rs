//! Round numbers along an axis, written for people.

/// Where lines and numbers stand along an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Ticks {
    /// Values with their text.
    pub major: Vec<(f64, String)>,
    /// Values with a thin line only.
    pub minor: Vec<f64>,
    /// The power of ten that all texts are to be multiplied with; 0 for none.
    pub power: i32,
}

/// 10^exponent, correctly rounded on every machine.
pub fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

/// The exponents of the powers of ten at or below `low` and at or above `high`, both positive.
pub fn decades(low: f64, high: f64) -> (i32, i32) {
    // The logarithm may be off by a rounding; powers of ten are to be found exactly.
    let mut from = low.log10().floor() as i32;
    while power_of_ten(from + 1) <= low {
        from += 1;
    }
    while power_of_ten(from) > low {
        from -= 1;
    }
    let mut to = high.log10().ceil() as i32;
    while power_of_ten(to - 1) >= high {
        to -= 1;
    }
    while power_of_ten(to) < high {
        to += 1;
    }
    (from, to)
}

/// Multiples of 1, 2 or 5 times a power of ten, no more than about `target` of them.
pub fn linear_ticks([low, high]: [f64; 2], target: usize) -> Ticks {
    let least = (high - low) / target.max(1) as f64;
    let (below, _) = decades(least, least);
    // The first of 1, 2, 5, 10 that is large enough; a hair less is large enough too.
    let (step_digit, exponent) = [(1, below), (2, below), (5, below)]
        .into_iter()
        .find(|&(digit, e)| f64::from(digit) * power_of_ten(e) >= least * (1.0 - 1e-9))
        .unwrap_or((1, below + 1));
    // Values are whole multiples of the step, formed by one multiplication or division so that 0.3 is 0.3.
    let value = |k: i64| {
        let whole = (k * i64::from(step_digit)) as f64;
        if exponent < 0 {
            whole / power_of_ten(-exponent)
        } else {
            whole * power_of_ten(exponent)
        }
    };
    let step = value(1);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    let largest = low.abs().max(high.abs());
    let power = common_power(largest, exponent);
    let decimals = usize::try_from(power - exponent).unwrap_or(0);
    let text = |k: i64| {
        let units = (k * i64::from(step_digit)) as f64;
        // Digits before the common power is taken out: units × 10^exponent = shown × 10^power.
        let shown = if power >= exponent {
            units / power_of_ten(power - exponent)
        } else {
            units * power_of_ten(exponent - power)
        };
        signed(&format!("{:.decimals$}", shown.abs()), k < 0)
    };
    Ticks {
        // A range far from zero has more multiples than fit a whole number; then there is nothing to write either.
        major: (first..=last)
            .take(4 * target.max(1))
            .map(|k| (value(k), text(k)))
            .collect(),
        minor: Vec::new(),
        power,
    }
}

/// Numbers of five digits and three decimals are read as they stand; others lose a power of a thousand.
fn common_power(largest: f64, exponent_of_step: i32) -> i32 {
    let (largest_exponent, _) = decades(largest, largest);
    if largest_exponent < 5 && (exponent_of_step >= -3 || largest_exponent >= -1) {
        0
    } else {
        3 * largest_exponent.div_euclid(3)
    }
}

fn signed(digits: &str, negative: bool) -> String {
    if negative {
        format!("\u{2212}{digits}")
    } else {
        digits.to_owned()
    }
}

/// Powers of ten, every second or third where there are many; 1, 2, 5 within where there are hardly any.
pub fn log_ticks([low, high]: [f64; 2], target: usize) -> Ticks {
    let (below, above) = decades(low, high);
    let inside = |x: f64| x >= low * (1.0 - 1e-9) && x <= high * (1.0 + 1e-9);
    let within = |digits: &'static [i32]| {
        (below..=above)
            .flat_map(move |e| digits.iter().map(move |&d| (d, e)))
            .map(|(digit, e)| (digit, e, f64::from(digit) * power_of_ten(e)))
            .filter(move |&(_, _, x)| inside(x))
    };
    let span = usize::try_from(above - below).unwrap_or(usize::MAX);
    let powers = within(&[1]).count();
    let near_one = below >= -3 && above <= 4;
    let text = |digit: i32, e: i32| match (near_one, digit) {
        (true, _) => match usize::try_from(-e) {
            Ok(decimals) => format!("{:.decimals$}", f64::from(digit) * power_of_ten(e)),
            Err(_) => format!("{:.0}", f64::from(digit) * power_of_ten(e)),
        },
        (false, 1) => format!("10{}", superscript(e)),
        (false, _) => format!("{digit}\u{b7}10{}", superscript(e)),
    };
    let (major, minor) = if powers >= 2 {
        let stride = (powers - 1) / target.max(1) + 1;
        let stride = i32::try_from(stride).unwrap_or(i32::MAX);
        let numbered = |e: i32| e.rem_euclid(stride) == 0;
        let minor: Vec<f64> = if span <= 6 {
            within(&[2, 3, 4, 5, 6, 7, 8, 9])
                .map(|(_, _, x)| x)
                .collect()
        } else {
            within(&[1])
                .filter(|&(_, e, _)| !numbered(e))
                .map(|(_, _, x)| x)
                .collect()
        };
        let major = within(&[1]).filter(|&(_, e, _)| numbered(e)).collect();
        (major, minor)
    } else {
        let major: Vec<_> = within(&[1, 2, 5]).collect();
        (major, Vec::new())
    };
    if major.len() < 2 && powers < 2 {
        // Less than a ratio of two: what is a logarithm here?
        return linear_ticks([low, high], target);
    }
    Ticks {
        major: major
            .into_iter()
            .map(|(digit, e, x): (i32, i32, f64)| (x, text(digit, e)))
            .collect(),
        minor,
        power: 0,
    }
}

/// A whole number as an exponent.
pub fn superscript(number: i32) -> String {
    number
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '\u{207b}',
            '1' => '\u{b9}',
            '2' => '\u{b2}',
            '3' => '\u{b3}',
            c => char::from_u32(0x2070 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(ticks: &Ticks) -> Vec<&str> {
        ticks.major.iter().map(|(_, text)| text.as_str()).collect()
    }

    #[test]
    fn steps_are_one_two_or_five() {
        let ticks = linear_ticks([0.0, 1.0], 5);
        assert_eq!(texts(&ticks), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(ticks.major[3].0, 0.6);
        assert_eq!(texts(&linear_ticks([0.0, 6.3], 6)), ["0", "2", "4", "6"]);
        assert_eq!(
            texts(&linear_ticks([-40.0, 60.0], 5)),
            ["\u{2212}40", "\u{2212}20", "0", "20", "40", "60"]
        );
    }

    #[test]
    fn common_powers_are_taken_out() {
        let ticks = linear_ticks([0.0, 4.2e-7], 5);
        assert_eq!(
            (ticks.power, texts(&ticks)),
            (-9, vec!["0", "100", "200", "300", "400"])
        );
        let ticks = linear_ticks([0.0, 2.5e6], 5);
        assert_eq!(
            (ticks.power, texts(&ticks)),
            (6, vec!["0.0", "0.5", "1.0", "1.5", "2.0", "2.5"])
        );
        let ticks = linear_ticks([0.0, 12000.0], 4);
        assert_eq!(
            (ticks.power, texts(&ticks)),
            (0, vec!["0", "5000", "10000"])
        );
    }

    #[test]
    fn logarithmic_axes_have_decades() {
        let ticks = log_ticks([1e-16, 1.0], 8);
        assert_eq!(texts(&ticks).first(), Some(&"10\u{207b}\u{b9}\u{2075}"));
        assert!(ticks.major.len() <= 8 && ticks.major.len() > 3);
        assert_eq!(
            texts(&log_ticks([0.01, 10.0], 8)),
            ["0.01", "0.1", "1", "10"]
        );
        assert_eq!(texts(&log_ticks([1.5, 8.0], 8)), ["2", "5"]);
        assert_eq!(
            texts(&log_ticks([2.1, 2.4], 3)),
            ["2.1", "2.2", "2.3", "2.4"]
        );
    }

    #[test]
    fn decades_are_exact() {
        for exponent in -300..300 {
            let power = power_of_ten(exponent);
            assert_eq!(decades(power, power), (exponent, exponent));
        }
    }

    #[test]
    fn no_range_makes_endless_ticks() {
        for range in [[1e15, 1e15 + 1.0], [0.0, 1e-300], [-1e299, 1e299]] {
            assert!(linear_ticks(range, 6).major.len() <= 24);
        }
    }
}
