//! Decimals as text: moving the point and rounding, digit by digit, without any floating-point number in between.
//!
//! Numbers that are no decimals (origins and axes that a file leaves out) are exact and stay as they are.

use kutzbach::number::Number;

/// `± digits · 10^exponent`.
struct Digits {
    negative: bool,
    /// Decimal digits, first to last; none for zero.
    digits: Vec<u8>,
    exponent: i32,
}

impl Digits {
    fn of(number: &Number) -> Self {
        assert!(number.stated().is_some(), "{number:?} is not a decimal");
        let text = number.source();
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa.to_owned(), exponent.parse().unwrap()),
            None => (text, 0i32),
        };
        let negative = mantissa.starts_with('-');
        let mantissa = mantissa.trim_start_matches(['-', '+']);
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = format!("{whole}{fraction}");
        Self {
            negative,
            digits: digits
                .trim_start_matches('0')
                .bytes()
                .map(|b| b - b'0')
                .collect(),
            exponent: exponent - fraction.len() as i32,
        }
    }

    /// Drops the digits below 10^`exponent`, rounding to nearest, ties away from zero.
    fn rounded(mut self, exponent: i32) -> Self {
        if self.exponent >= exponent {
            return self;
        }
        let drop = (exponent - self.exponent) as usize;
        self.exponent = exponent;
        if drop > self.digits.len() {
            self.digits.clear();
            return self;
        }
        let keep = self.digits.len() - drop;
        let up = self.digits[keep] >= 5;
        self.digits.truncate(keep);
        if up {
            let mut position = keep;
            loop {
                if position == 0 {
                    self.digits.insert(0, 1);
                    break;
                }
                position -= 1;
                if self.digits[position] < 9 {
                    self.digits[position] += 1;
                    break;
                }
                self.digits[position] = 0;
            }
        }
        self
    }

    /// Without an exponent, and with all the decimals there are.
    fn text(&self) -> String {
        let mut digits: String = self.digits.iter().map(|d| char::from(b'0' + d)).collect();
        let decimals = (-self.exponent).max(0) as usize;
        if !self.digits.is_empty() {
            digits.push_str(&"0".repeat(self.exponent.max(0) as usize));
        }
        if digits.len() <= decimals {
            digits = "0".repeat(decimals + 1 - digits.len()) + &digits;
        }
        if decimals > 0 {
            digits.insert(digits.len() - decimals, '.');
        }
        let zero = self.digits.iter().all(|d| *d == 0);
        if self.negative && !zero {
            digits.insert(0, '-');
        }
        digits
    }
}

fn stripped(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

fn read(text: &str) -> Number {
    Number::decimal(text).unwrap()
}

/// The sum; of decimals, with all the decimals of both.
pub fn sum(a: &Number, b: &Number) -> Number {
    let total = a + b;
    // Whole numbers need no decimals; two of them, or what is no decimal, have an exact sum.
    let decimals = |n: &Number| match n.stated() {
        Some(stated) => Some(stated.decimals),
        None => n.rational().filter(|r| r.is_int()).map(|_| 0),
    };
    let (Some(x), Some(y)) = (decimals(a), decimals(b)) else {
        return total;
    };
    if a.stated().is_none() && b.stated().is_none() {
        return total;
    }
    finite(&total, x.max(y).max(0))
}

/// A number that so many decimals hold, written with all of them; any other as it is.
pub fn finite(number: &Number, decimals: i32) -> Number {
    let power = Number::integer(10).power(decimals).unwrap();
    let whole = number * &power;
    let Some(whole) = whole.rational().filter(|whole| whole.is_int()) else {
        return number.clone();
    };
    let text = whole.to_string();
    let digits = text.trim_start_matches('-');
    read(
        &Digits {
            negative: text.starts_with('-'),
            digits: digits.bytes().map(|b| b - b'0').collect(),
            exponent: -decimals,
        }
        .text(),
    )
}

/// The negative; of a decimal, with the same digits.
pub fn negated(number: &Number) -> Number {
    if number.stated().is_none() {
        return -number;
    }
    let mut digits = Digits::of(number);
    digits.negative = !digits.negative;
    read(&digits.text())
}

/// The same value as an exact number, without a stated precision.
pub fn exact(number: &Number) -> Number {
    let twice = number * &Number::integer(2);
    &twice * &Number::ratio(1, 2).unwrap()
}

/// Times a power of ten: a decimal keeps its digits, another number its exact value.
pub fn shifted(number: &Number, exponent: i32) -> Number {
    if number.stated().is_none() {
        return number * &Number::integer(10).power(exponent).unwrap();
    }
    let mut digits = Digits::of(number);
    digits.exponent += exponent;
    read(&digits.text())
}

/// With so many decimals, all of them written.
pub fn with_decimals(number: &Number, decimals: i32) -> Number {
    if number.stated().is_none() {
        return number.clone();
    }
    let digits = Digits::of(number).rounded(-decimals);
    let missing = (digits.exponent + decimals).max(0) as usize;
    let mut text = digits.text();
    if missing > 0 && decimals > 0 {
        if !text.contains('.') {
            text.push('.');
        }
        text.push_str(&"0".repeat(missing.min(decimals as usize)));
    }
    read(&text)
}

/// With so many decimals, zeros at the end left out.
pub fn with_decimals_stripped(number: &Number, decimals: i32) -> Number {
    if number.stated().is_none() {
        return number.clone();
    }
    read(stripped(&Digits::of(number).rounded(-decimals).text()))
}

/// With so many significant digits, zeros at the end left out.
pub fn with_significant(number: &Number, significant: i32) -> Number {
    if number.stated().is_none() {
        return number.clone();
    }
    let digits = Digits::of(number);
    let first = digits.exponent + digits.digits.len() as i32;
    read(stripped(&digits.rounded(first - significant).text()))
}

/// The shortest decimal that reads back as the same double, as most programs write one.
pub fn as_a_double(number: &Number) -> Number {
    if number.stated().is_none() {
        return number.clone();
    }
    read(&format!("{:?}", number.value()))
}

/// All digits of the nearest double, as few programs write them.
pub fn as_a_double_in_full(number: &Number) -> Number {
    let decimal = as_a_double(number);
    match decimal.stated() {
        Some(stated) if stated.significant > 2 => read(&format!("{:.60}", number.value())),
        _ => decimal,
    }
}

/// Any number written with so many decimals, all of them: of a decimal, its own digits rounded; of an exact number that is no
/// decimal, its value. Whole numbers stay as they are.
pub fn rounded(number: &Number, decimals: i32) -> Number {
    // Also of a decimal that was read as the constant which it shows.
    if number.written().is_some() {
        return with_decimals(number, decimals);
    }
    if number.rational().is_some_and(|r| r.is_int()) {
        return number.clone();
    }
    let scaled = number * &Number::integer(10).power(decimals).unwrap();
    // The nearest double need not be the nearest whole number; what it misses by is small and so well known.
    let mut whole = scaled.value().round() as i64;
    whole += (&scaled - &Number::integer(whole)).value().round() as i64;
    let digits = whole.unsigned_abs().to_string();
    read(
        &Digits {
            negative: whole < 0,
            digits: digits.bytes().map(|b| b - b'0').collect(),
            exponent: -decimals,
        }
        .text(),
    )
}
