//! Words of YAML 1.1 without quotes, as PyYAML takes them: `yes` is true, `010` is 8, `1:30` is 90, and a decimal needs a
//! point and the exponent its sign.

use super::text::Text;
use super::value::{Kind, Num, Value};
use kutzbach_math::number::Number;

/// A word without quotes and tag.
pub(super) fn plain(text: &str) -> Value {
    if is_nothing(text) {
        return Value::None;
    }
    if let Some(truth) = truth(text) {
        return Value::Bool(truth);
    }
    let number = match (is_whole(text), is_decimal(text)) {
        (true, _) => whole(text),
        (_, true) => decimal(text),
        _ => None,
    };
    number.map_or_else(|| Value::text(text), Value::Number)
}

/// A word or text with the tag `!!int` and the like; `None` where it is no such thing.
pub(super) fn tagged(text: &str, tag: &str) -> Option<Value> {
    match tag {
        "str" => Some(Value::text(text)),
        "null" => Some(Value::None),
        "bool" => truth(text).map(Value::Bool),
        "int" => whole(text).map(Value::Number),
        "float" => decimal(text).map(Value::Number),
        _ => Some(Value::text(text)),
    }
}

fn is_nothing(text: &str) -> bool {
    matches!(text, "" | "~" | "null" | "Null" | "NULL")
}

fn truth(text: &str) -> Option<bool> {
    match text {
        "true" | "True" | "TRUE" | "yes" | "Yes" | "YES" | "on" | "On" | "ON" => Some(true),
        "false" | "False" | "FALSE" | "no" | "No" | "NO" | "off" | "Off" | "OFF" => Some(false),
        _ => None,
    }
}

fn unsigned(text: &str) -> &str {
    text.strip_prefix(['+', '-']).unwrap_or(text)
}

/// Digits and underscores, the first a digit of those given.
fn digits_from(text: &str, first: &str) -> bool {
    text.starts_with(|c| first.contains(c)) && text.chars().all(|c| c.is_ascii_digit() || c == '_')
}

/// `0` to `59`, with one digit or two.
fn is_sixtieth(text: &str) -> bool {
    match text.as_bytes() {
        [one] => one.is_ascii_digit(),
        [tens, ones] => (b'0'..=b'5').contains(tens) && ones.is_ascii_digit(),
        _ => false,
    }
}

fn is_whole(text: &str) -> bool {
    let text = unsigned(text);
    let all = |text: &str, digits: &str| {
        !text.is_empty() && text.chars().all(|c| c == '_' || digits.contains(c))
    };
    if let Some(binary) = text.strip_prefix("0b") {
        return all(binary, "01");
    }
    if let Some(hexadecimal) = text.strip_prefix("0x") {
        return all(hexadecimal, "0123456789abcdefABCDEF");
    }
    if let Some(octal) = text.strip_prefix('0') {
        return octal.is_empty() || all(octal, "01234567");
    }
    let mut parts = text.split(':');
    parts
        .next()
        .is_some_and(|first| digits_from(first, "123456789"))
        && parts.all(is_sixtieth)
}

fn is_decimal(text: &str) -> bool {
    if matches!(text, ".nan" | ".NaN" | ".NAN") {
        return true;
    }
    let signless = unsigned(text);
    if matches!(signless, ".inf" | ".Inf" | ".INF") {
        return true;
    }
    let any = |text: &str| text.chars().all(|c| c.is_ascii_digit() || c == '_');
    if let Some((first, rest)) = signless.split_once(':') {
        let Some((rest, fraction)) = rest.split_once('.') else {
            return false;
        };
        return digits_from(first, "0123456789")
            && rest.split(':').all(is_sixtieth)
            && any(fraction);
    }
    let (mantissa, exponent) = match signless.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (signless, None),
    };
    let exponent_fits = exponent.is_none_or(|exponent| {
        exponent
            .strip_prefix(['+', '-'])
            .is_some_and(|rest| !rest.is_empty() && rest.bytes().all(|b| b.is_ascii_digit()))
    });
    exponent_fits
        && match mantissa.split_once('.') {
            // Without a digit before the point there is no sign either.
            Some(("", fraction)) => text == signless && digits_from(fraction, "0123456789"),
            Some((whole, fraction)) => digits_from(whole, "0123456789") && any(fraction),
            None => false,
        }
}

fn whole(text: &str) -> Option<Num> {
    let plain = text.replace('_', "");
    let digits = unsigned(&plain);
    let value = if let Some(binary) = digits.strip_prefix("0b") {
        i128::from_str_radix(binary, 2).ok()?
    } else if let Some(hexadecimal) = digits.strip_prefix("0x") {
        i128::from_str_radix(hexadecimal, 16).ok()?
    } else if digits.len() > 1 && digits.starts_with('0') {
        i128::from_str_radix(digits, 8).ok()?
    } else if digits.contains(':') {
        digits.split(':').try_fold(0_i128, |sum, part| {
            sum.checked_mul(60)?.checked_add(part.parse().ok()?)
        })?
    } else {
        return Num::read_int(&Text::plain(&plain));
    };
    Some(Num::int(if plain.starts_with('-') {
        -value
    } else {
        value
    }))
}

fn decimal(text: &str) -> Option<Num> {
    let plain = text.replace('_', "").to_lowercase();
    let digits = unsigned(&plain);
    let is_negative = plain.starts_with('-');
    match digits {
        ".nan" => return Some(Num::float(f64::NAN)),
        ".inf" if is_negative => return Some(Num::float(f64::NEG_INFINITY)),
        ".inf" => return Some(Num::float(f64::INFINITY)),
        _ if !digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') => return None,
        _ if digits.contains(':') => {}
        _ => return Num::read_float(&Text::plain(&plain)),
    }
    let sign = if is_negative { -1 } else { 1 };
    let mut value = 0.0;
    let mut exact = Some(Number::zero());
    // From the last part on, as Python sums them.
    let mut base = 1_i64;
    for part in digits.rsplit(':') {
        value += part.parse::<f64>().ok()? * base as f64;
        let scaled = Number::decimal(part)
            .ok()
            .map(|part| part * Number::integer(base));
        exact = exact.zip(scaled).map(|(sum, part)| sum + part);
        base = base.checked_mul(60)?;
    }
    Some(Num {
        kind: Kind::Float(f64::from(sign) * value),
        exact: exact.map(|exact| exact * Number::integer(i64::from(sign))),
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn shown(value: &Value) -> String {
        value.repr(1000).unwrap().as_str().to_owned()
    }

    #[test]
    fn words_are_those_of_pyyaml() {
        for (word, value) in [
            ("0", "0"),
            ("00", "0"),
            ("1", "1"),
            ("-1", "-1"),
            ("+1", "1"),
            ("017", "15"),
            ("-017", "-15"),
            ("08", "'08'"),
            ("018", "'018'"),
            ("0_7", "7"),
            ("1_000", "1000"),
            ("1__0", "10"),
            ("_1", "'_1'"),
            ("0b101", "5"),
            ("-0b11", "-3"),
            ("0b", "'0b'"),
            ("0b12", "'0b12'"),
            ("0x1F", "31"),
            ("-0xff", "-255"),
            ("0x", "'0x'"),
            ("0xg", "'0xg'"),
            ("0o17", "'0o17'"),
            ("1:30", "90"),
            ("-1:30", "-90"),
            ("1:3", "63"),
            ("1:60", "'1:60'"),
            ("1:5:9", "3909"),
            ("01:30", "'01:30'"),
            ("0:30", "'0:30'"),
            ("1:30.5", "90.5"),
            ("-1:30.5", "-90.5"),
            ("0:00:30.", "30.0"),
            ("1:30.5e+1", "'1:30.5e+1'"),
            ("1.", "1.0"),
            ("1.5", "1.5"),
            ("-1.5", "-1.5"),
            ("+1.5", "1.5"),
            (".5", "0.5"),
            ("-.5", "'-.5'"),
            ("1_0.2_5", "10.25"),
            ("1e3", "'1e3'"),
            ("1.0e3", "'1.0e3'"),
            ("1.0e+3", "1000.0"),
            ("1.5E-2", "0.015"),
            (".5e+1", "5.0"),
            ("1.e+2", "100.0"),
            ("._5", "'._5'"),
            (".", "'.'"),
            (".inf", "inf"),
            ("-.inf", "-inf"),
            ("+.INF", "inf"),
            (".iNf", "'.iNf'"),
            (".nan", "nan"),
            (".NaN", "nan"),
            ("-.nan", "'-.nan'"),
            ("yes", "True"),
            ("No", "False"),
            ("ON", "True"),
            ("off", "False"),
            ("y", "'y'"),
            ("n", "'n'"),
            ("true", "True"),
            ("TRUE", "True"),
            ("tRue", "'tRue'"),
            ("~", "None"),
            ("null", "None"),
            ("NULL", "None"),
            ("nUll", "'nUll'"),
            ("-", "'-'"),
            ("+", "'+'"),
            ("1-2", "'1-2'"),
            ("12e+3", "'12e+3'"),
            ("190:20:30", "685230"),
            ("1:2:3:4", "223384"),
            ("190:20:30.15", "685230.15"),
            ("0.", "0.0"),
            ("0.0", "0.0"),
            ("-0", "0"),
            ("-0.0", "-0.0"),
            ("0_", "0"),
            ("9999999999999999", "9999999999999999"),
        ] {
            assert_eq!(shown(&plain(word)), value, "{word}");
        }
    }

    #[test]
    fn tags_are_those_of_pyyaml() {
        for (word, tag, value) in [
            ("1", "float", "1.0"),
            ("1e3", "float", "1000.0"),
            ("-1:30", "float", "-90.0"),
            ("1_0", "float", "10.0"),
            ("010", "int", "8"),
            ("0b11", "int", "3"),
            ("7", "str", "'7'"),
            ("yes", "bool", "True"),
            ("yes", "str", "'yes'"),
            ("x", "null", "None"),
            ("12", "int", "12"),
            ("0.5", "float", "0.5"),
            (".inf", "float", "inf"),
        ] {
            assert_eq!(shown(&tagged(word, tag).unwrap()), value, "!!{tag} {word}");
        }
        for (word, tag) in [
            ("a", "int"),
            ("1.5", "int"),
            ("", "int"),
            ("a", "float"),
            ("nan", "float"),
            ("1", "bool"),
        ] {
            assert!(tagged(word, tag).is_none(), "!!{tag} {word}");
        }
    }

    #[test]
    fn parts_of_sixty_are_exact() {
        let exact = |text: &str| plain(text).number().unwrap().exact.unwrap();
        assert_eq!(exact("-1:30.5"), Number::ratio(-181, 2).unwrap());
        assert_eq!(exact("1:30"), Number::integer(90));
    }
}
