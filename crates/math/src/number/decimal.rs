//! Decimal literals: exact value, stated precision, nearest double.

use super::error::{NumberError, Reason};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// The digits a literal was written with: what its author says is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stated {
    /// Places after the decimal point once the exponent is resolved: 4 for `0.0125`, 8 for `1.5e-7`, 3 for `0.500`,
    /// −2 for `3e2`. The last stated place is worth 10^-decimals.
    pub decimals: i32,
    /// Digits from the first one that is not zero to the last one written: 3 for `0.0125`, 3 for `300`, 0 for `0.00`.
    pub significant: u32,
}

/// Message for anything that is not a decimal; [`NumberError::hint`] knows it.
pub(super) const NEEDED: &str = "a decimal number";

/// Largest size of a decimal exponent.
const MAX_EXPONENT: i32 = 1_000;
/// Largest number of digits.
const MAX_DIGITS: usize = 10_000;

/// A literal that was read.
pub(super) struct Decimal {
    pub(super) value: RBig,
    pub(super) nearest: f64,
    pub(super) stated: Stated,
}

/// The parts of a literal, found by one pass over its bytes.
struct Parts<'a> {
    negative: bool,
    whole: &'a str,
    fraction: &'a str,
    exponent: i32,
}

pub(super) fn parse(text: &str) -> Result<Decimal, NumberError> {
    let parts = split(text)?;
    let digits = parts.whole.len() + parts.fraction.len();
    if digits > MAX_DIGITS {
        return Err(Reason::TooLarge {
            needed: "at most 10000 digits",
            found: format!("{digits}"),
        }
        .at(0));
    }
    let leading = parts.whole.bytes().chain(parts.fraction.bytes());
    let zeros = leading.take_while(|&b| b == b'0').count();
    let decimals = parts.fraction.len() as i32 - parts.exponent;
    let stated = Stated {
        decimals,
        significant: (digits - zeros) as u32,
    };
    Ok(Decimal {
        value: value(&parts, decimals),
        // The standard library rounds correctly, whatever the number of digits. Adding zero turns −0 into 0.
        nearest: text.parse::<f64>().unwrap_or(f64::NAN) + 0.0,
        stated,
    })
}

fn split(text: &str) -> Result<Parts<'_>, NumberError> {
    let bytes = text.as_bytes();
    let digits_from = |start: usize| {
        let count = bytes[start..].iter().take_while(|b| b.is_ascii_digit());
        start + count.count()
    };
    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let whole = digits_from(sign);
    let (point, fraction) = match bytes.get(whole) {
        Some(b'.') => (whole + 1, digits_from(whole + 1)),
        _ => (whole, whole),
    };
    if whole == sign && fraction == point {
        return Err(junk(text, point));
    }
    let mut end = fraction;
    let mut exponent = 0;
    if let Some(b'e' | b'E') = bytes.get(end) {
        let signed = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let stop = digits_from(signed);
        if stop == signed {
            return Err(junk(text, stop));
        }
        exponent = text[end + 1..stop]
            .parse::<i32>()
            .ok()
            .filter(|e| e.abs() <= MAX_EXPONENT)
            .ok_or_else(|| {
                Reason::TooLarge {
                    needed: "a decimal exponent between -1000 and 1000",
                    found: excerpt(&text[end + 1..stop]),
                }
                .at(end + 1)
            })?;
        end = stop;
    }
    if end != text.len() {
        return Err(junk(text, end));
    }
    Ok(Parts {
        negative: bytes.first() == Some(&b'-'),
        whole: &text[sign..whole],
        fraction: &text[point..fraction],
        exponent,
    })
}

fn value(parts: &Parts<'_>, decimals: i32) -> RBig {
    let digits: String = [parts.whole, parts.fraction].concat();
    let significant = digits.trim_start_matches('0');
    let stripped = significant.trim_end_matches('0');
    // Only digits are left, at most 10_000 of them: this cannot fail.
    let integer = UBig::from_str_radix(stripped, 10).unwrap_or(UBig::ZERO);
    if integer == UBig::ZERO {
        return RBig::ZERO;
    }
    let decimals = decimals - (significant.len() - stripped.len()) as i32;
    let power = UBig::from(10u8).pow(decimals.unsigned_abs() as usize);
    let (numerator, denominator) = if decimals > 0 {
        (integer, power)
    } else {
        (integer * power, UBig::ONE)
    };
    let numerator = IBig::from(numerator);
    RBig::from_parts(
        if parts.negative {
            -numerator
        } else {
            numerator
        },
        denominator,
    )
}

fn junk(text: &str, offset: usize) -> NumberError {
    Reason::Syntax {
        needed: NEEDED,
        found: match text[offset..].chars().next() {
            None if text.is_empty() => "nothing".to_owned(),
            None => format!("`{}`, which ends too early", excerpt(text)),
            Some(c) => format!("`{}` (stuck at `{}`)", excerpt(text), c.escape_debug()),
        },
    }
    .at(offset)
}

/// The beginning of a text, for a message.
pub(super) fn excerpt(text: &str) -> String {
    let mut start: String = text.chars().take(40).flat_map(char::escape_debug).collect();
    if text.chars().nth(40).is_some() {
        start.push('…');
    }
    start
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> (RBig, i32, u32) {
        let decimal = parse(text).unwrap();
        let Stated {
            decimals,
            significant,
        } = decimal.stated;
        (decimal.value, decimals, significant)
    }

    fn ratio(n: i64, d: u64) -> RBig {
        RBig::from_parts(n.into(), d.into())
    }

    #[test]
    fn values_and_stated_digits() {
        assert_eq!(read("0.0125"), (ratio(1, 80), 4, 3));
        assert_eq!(read("1.5e-7"), (ratio(3, 20_000_000), 8, 2));
        assert_eq!(read("300"), (ratio(300, 1), 0, 3));
        assert_eq!(read("0.500"), (ratio(1, 2), 3, 3));
        assert_eq!(read("-1e-3"), (ratio(-1, 1000), 3, 1));
        assert_eq!(read("+.5"), (ratio(1, 2), 1, 1));
        assert_eq!(read("5."), (ratio(5, 1), 0, 1));
        assert_eq!(read("3E+2"), (ratio(300, 1), -2, 1));
        assert_eq!(read("-0.00"), (ratio(0, 1), 2, 0));
        assert_eq!(read("007"), (ratio(7, 1), 0, 1));
    }

    #[test]
    fn junk_is_refused_where_it_stands() {
        for (text, offset) in [
            ("", 0),
            ("-", 1),
            (".", 1),
            ("nan", 0),
            ("-inf", 1),
            ("0x10", 1),
            ("1e", 2),
            ("1e+", 3),
            ("1_0", 1),
            (" 1", 0),
            ("1 2", 1),
            ("1.2.3", 3),
            ("1e2.5", 3),
            ("0,5", 1),
            ("½", 0),
            ("1e1001", 2),
            ("1e-99999999999999999999", 2),
        ] {
            let error = parse(text).map(|_| ()).unwrap_err();
            assert_eq!(error.offset, offset, "{text}: {error}");
        }
        assert!(parse(&"7".repeat(MAX_DIGITS)).is_ok());
        assert!(parse(&"7".repeat(MAX_DIGITS + 1)).is_err());
    }

    #[test]
    fn nearest_double_beyond_its_range() {
        assert_eq!(parse("1e400").unwrap().nearest, f64::INFINITY);
        assert_eq!(parse("1e-400").unwrap().nearest, 0.0);
        assert!(parse("-0.0").unwrap().nearest.is_sign_positive());
    }

    proptest! {
        #[test]
        fn the_double_is_that_of_the_rational(text in r"[+-]?[0-9]{1,20}\.[0-9]{0,40}(e[+-]?[0-9]{1,2})?") {
            let decimal = parse(&text).unwrap();
            prop_assert_eq!(decimal.nearest, decimal.value.to_f64().value());
        }

        #[test]
        fn nothing_panics(text in ".{0,12}") {
            let _ = parse(&text);
        }
    }
}
