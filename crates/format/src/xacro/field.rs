//! A field of a format, and Python's `'{:08.3f}'.format(...)`.

use super::arithmetic::LONGEST_TEXT;
use super::budget::Budget;
use super::python_text::{exponent_text, float_text};
use super::value::{Kind, Num, Value};
use super::{Outcome, Trouble};
use std::rc::Rc;

/// Widest field and longest fraction of a format.
pub(super) const WIDEST: usize = 4096;

/// A field of a format: `[[fill]align][sign][#][0][width][,][.precision][type]`.
#[derive(Debug, Default)]
pub(super) struct Field {
    pub(super) fill: Option<char>,
    pub(super) align: Option<char>,
    pub(super) sign: Option<char>,
    /// `#`: a prefix before integers of other bases, a point and zeros in every double.
    pub(super) alternate: bool,
    pub(super) zero: bool,
    pub(super) grouped: bool,
    pub(super) width: usize,
    pub(super) precision: Option<usize>,
    pub(super) sort: Option<char>,
}

impl Field {
    /// Reads what stands behind the colon of `{:...}`.
    fn read(spec: &str) -> Option<Self> {
        let chars: Vec<char> = spec.chars().collect();
        let mut field = Self::default();
        let mut at = 0;
        let is_align = |c: Option<&char>| matches!(c, Some('<' | '>' | '^' | '='));
        if is_align(chars.get(1)) {
            field.fill = chars.first().copied();
            field.align = chars.get(1).copied();
            at = 2;
        } else if is_align(chars.first()) {
            field.align = chars.first().copied();
            at = 1;
        }
        if let Some(sign @ ('+' | '-' | ' ')) = chars.get(at) {
            field.sign = Some(*sign);
            at += 1;
        }
        if chars.get(at) == Some(&'#') {
            field.alternate = true;
            at += 1;
        }
        if chars.get(at) == Some(&'0') {
            field.zero = true;
            at += 1;
        }
        field.width = digits(&chars, &mut at)?.unwrap_or(0);
        if chars.get(at) == Some(&',') {
            field.grouped = true;
            at += 1;
        }
        if chars.get(at) == Some(&'.') {
            at += 1;
            field.precision = Some(digits(&chars, &mut at)??);
        }
        if let Some(sort) = chars.get(at) {
            field.sort = Some(*sort);
            at += 1;
        }
        (at == chars.len()).then_some(field)
    }

    /// The text of a value in this field.
    fn apply(&self, value: &Value, budget: &mut Budget) -> Outcome<Option<String>> {
        if self.sort == Some('s') || self.sort.is_none() && !matches!(value, Value::Number(_)) {
            let text = budget.text(value)?;
            return Ok(Some(self.text(text.as_str())));
        }
        Ok(value.number().and_then(|number| self.number(&number)))
    }

    fn number(&self, number: &Num) -> Option<String> {
        match (self.sort, number.kind) {
            (Some('d' | 'x' | 'X' | 'o' | 'b'), Kind::Int(value)) => Some(self.integer(value)),
            (Some('d' | 'x' | 'X' | 'o' | 'b'), Kind::Float(_)) => None,
            (None, Kind::Int(value)) if self.precision.is_none() => Some(self.integer(value)),
            (None, _) => self.double(number.double(), 'r'),
            (Some(sort), _) => self.double(number.double(), sort),
        }
    }

    /// A text, cut to the precision.
    pub(super) fn text(&self, text: &str) -> String {
        let most = self.precision.unwrap_or(usize::MAX);
        let cut: String = text.chars().take(most).collect();
        self.padded("", &cut, '<')
    }

    /// An integer in the base of the field's type, with as many digits as the precision says, or more.
    pub(super) fn integer(&self, value: i128) -> String {
        let magnitude = value.unsigned_abs();
        let (prefix, digits) = match self.sort {
            Some('x') => ("0x", format!("{magnitude:x}")),
            Some('X') => ("0X", format!("{magnitude:X}")),
            Some('o') => ("0o", format!("{magnitude:o}")),
            Some('b') => ("0b", format!("{magnitude:b}")),
            _ => ("", magnitude.to_string()),
        };
        let least = self.precision.unwrap_or(0);
        let zeros = "0".repeat(least.saturating_sub(digits.len()));
        let prefix = if self.alternate { prefix } else { "" };
        let sign = self.sign_of(value < 0);
        self.padded(&format!("{sign}{prefix}"), &format!("{zeros}{digits}"), '>')
    }

    /// A double in the form of a type: `f`, `e`, `g`, their capitals, `%`, or `r` for none.
    pub(super) fn double(&self, value: f64, sort: char) -> Option<String> {
        let precision = self.precision.unwrap_or(6);
        let magnitude = value.abs();
        let text = match sort.to_ascii_lowercase() {
            _ if !value.is_finite() => float_text(magnitude),
            'f' => with_point(format!("{magnitude:.precision$}"), self.alternate),
            'e' => with_exponent(magnitude, precision, self.alternate),
            'g' => general(magnitude, precision.max(1), self.alternate),
            'r' if self.precision.is_none() => float_text(magnitude),
            'r' => shown(magnitude, precision.max(1)),
            '%' => format!("{:.precision$}%", magnitude * 100.0),
            _ => return None,
        };
        let text = if sort.is_ascii_uppercase() {
            text.to_uppercase()
        } else {
            text
        };
        let is_negative = value.is_sign_negative() && !value.is_nan();
        Some(self.padded(self.sign_of(is_negative), &text, '>'))
    }

    fn sign_of(&self, is_negative: bool) -> &'static str {
        match self.sign {
            _ if is_negative => "-",
            Some('+') => "+",
            Some(' ') => " ",
            _ => "",
        }
    }

    /// Fills the field: numbers, which stand to the right, between sign and digits where zeros do.
    fn padded(&self, sign: &str, digits: &str, usual: char) -> String {
        let mut digits = digits.to_owned();
        let is_number = usual == '>';
        if self.grouped && is_number {
            let mut at = digits.find(['.', 'e']).unwrap_or(digits.len());
            while at > 3 {
                at -= 3;
                digits.insert(at, ',');
            }
        }
        let length = sign.len() + digits.chars().count();
        let missing = self.width.saturating_sub(length);
        let fill = self.fill.unwrap_or(if self.zero { '0' } else { ' ' });
        let align = self.align.unwrap_or(match (self.zero, is_number) {
            (true, true) => '=',
            _ => usual,
        });
        let pad = |count: usize| fill.to_string().repeat(count);
        match align {
            '<' => format!("{sign}{digits}{}", pad(missing)),
            '^' => format!(
                "{}{sign}{digits}{}",
                pad(missing / 2),
                pad(missing - missing / 2)
            ),
            '=' => format!("{sign}{}{digits}", pad(missing)),
            _ => format!("{}{sign}{digits}", pad(missing)),
        }
    }
}

/// A number of at most four digits; the outer `None` where it is too large.
pub(super) fn digits(chars: &[char], at: &mut usize) -> Option<Option<usize>> {
    let start = *at;
    let mut value = 0usize;
    while let Some(digit) = chars.get(*at).and_then(|c| c.to_digit(10)) {
        value = value * 10 + digit as usize;
        if value > WIDEST {
            return None;
        }
        *at += 1;
    }
    Some((*at > start).then_some(value))
}

/// A number with a point, whether digits follow or not, where that is asked for.
fn with_point(text: String, alternate: bool) -> String {
    if alternate && !text.contains('.') {
        return format!("{text}.");
    }
    text
}

fn with_exponent(magnitude: f64, precision: usize, alternate: bool) -> String {
    let (mantissa, exponent) = scientific(magnitude, precision);
    let mantissa = with_point(mantissa, alternate);
    format!("{mantissa}e{}", exponent_text(exponent))
}

fn scientific(magnitude: f64, precision: usize) -> (String, i32) {
    let text = format!("{magnitude:.precision$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    (mantissa.to_owned(), exponent.parse().unwrap_or(0))
}

/// So many digits, without zeros at the end unless these are asked for.
fn general(magnitude: f64, precision: usize, alternate: bool) -> String {
    let (mantissa, exponent) = scientific(magnitude, precision - 1);
    let ended = |text: String| match alternate {
        true => with_point(text, true),
        false if text.contains('.') => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    };
    if exponent < -4 || exponent >= precision as i32 {
        return format!("{}e{}", ended(mantissa), exponent_text(exponent));
    }
    let places = (precision as i32 - 1 - exponent).max(0) as usize;
    ended(format!("{magnitude:.places$}"))
}

/// So many digits, and one behind the point at least: what a precision without a type means.
fn shown(magnitude: f64, precision: usize) -> String {
    let (_, exponent) = scientific(magnitude, precision - 1);
    let text = general(magnitude, precision, false);
    if exponent >= precision as i32 - 1 && !text.contains('e') {
        // As many digits as there are before the point leave none for behind it.
        let (mantissa, _) = scientific(magnitude, precision - 1);
        let short = mantissa.trim_end_matches('0').trim_end_matches('.');
        let kept = if mantissa.contains('.') {
            short
        } else {
            mantissa.as_str()
        };
        return format!("{kept}e{}", exponent_text(exponent));
    }
    if text.contains(['.', 'e']) {
        return text;
    }
    format!("{text}.0")
}

/// `template.format(values...)`, without nested fields. `None` where the template and the values do not fit.
pub(super) fn braces(
    template: &str,
    values: &[Value],
    named: &[(Rc<str>, Value)],
    budget: &mut Budget,
) -> Outcome<Option<String>> {
    let mut out = String::new();
    let mut next = 0;
    let mut rest = template;
    while let Some(at) = rest.find(['{', '}']) {
        out.push_str(&rest[..at]);
        let doubled = rest.get(at..at + 2);
        if doubled == Some("{{") || doubled == Some("}}") {
            out.push_str(&rest[at..=at]);
            rest = &rest[at + 2..];
            continue;
        }
        let inside = rest[at..].strip_prefix('{');
        let Some((inside, after)) = inside.and_then(|inside| inside.split_once('}')) else {
            return Ok(None);
        };
        rest = after;
        let (name, spec) = inside.split_once(':').unwrap_or((inside, ""));
        let value = if name.is_empty() {
            next += 1;
            values.get(next - 1)
        } else if let Ok(index) = name.parse::<usize>() {
            values.get(index)
        } else {
            named
                .iter()
                .find(|(own, _)| &**own == name)
                .map(|(_, value)| value)
        };
        let (Some(field), Some(value)) = (Field::read(spec), value) else {
            return Ok(None);
        };
        match field.apply(value, budget)? {
            Some(text) => out.push_str(&text),
            None => return Ok(None),
        }
        if out.len() > LONGEST_TEXT {
            return Err(Trouble::new("the text is too long"));
        }
    }
    out.push_str(rest);
    Ok(Some(out))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn fields_format_as_in_python() {
        let budget = &mut Budget::default();
        let float = Value::Number(Num::float(-2.5));
        let int = Value::Number(Num::int(7));
        for (spec, value, text) in [
            ("", &int, "7"),
            ("03d", &int, "007"),
            ("+d", &int, "+7"),
            (">4", &int, "   7"),
            ("<4", &int, "7   "),
            ("*^5", &int, "**7**"),
            (".2f", &float, "-2.50"),
            ("08.3f", &float, "-002.500"),
            ("g", &float, "-2.5"),
            (".1e", &float, "-2.5e+00"),
        ] {
            assert_eq!(
                Field::read(spec)
                    .unwrap()
                    .apply(value, budget)
                    .unwrap()
                    .unwrap(),
                text,
                "{spec}"
            );
        }
        assert!(Field::read("99999d").is_none());
        assert!(Field::read("d!").is_none());
    }

    #[test]
    fn fields_of_braces_are_those_of_python() {
        let budget = &mut Budget::default();
        for (template, value, text) in [
            ("{:+.2f}", Value::Number(Num::float(0.5)), "+0.50"),
            ("{:#x}", Value::Number(Num::int(30)), "0x1e"),
            ("{:#06x}", Value::Number(Num::int(30)), "0x001e"),
            ("{:#b}", Value::Number(Num::int(5)), "0b101"),
            ("{:G}", Value::Number(Num::float(7.6e-06)), "7.6E-06"),
            ("{:E}", Value::Number(Num::float(1234.5)), "1.234500E+03"),
            ("{:.3}", Value::Number(Num::float(3.0708)), "3.07"),
            ("{:.3}", Value::Number(Num::float(3.0)), "3.0"),
            ("{:.3}", Value::Number(Num::float(1234.5)), "1.23e+03"),
            ("{:.3}", Value::Number(Num::float(123.0)), "1.23e+02"),
            ("{:.4}", Value::Number(Num::float(123.0)), "123.0"),
            ("{:.1}", Value::Number(Num::float(0.5)), "0.5"),
            ("{:8.3}|", Value::Number(Num::float(1.234e-05)), "1.23e-05|"),
            ("{:,}", Value::Number(Num::int(1234567)), "1,234,567"),
            (
                "{:,.2f}",
                Value::Number(Num::float(-1234567.0)),
                "-1,234,567.00",
            ),
            ("{: d}", Value::Number(Num::int(7)), " 7"),
            ("{:.2}", Value::Number(Num::float(123.0)), "1.2e+02"),
            ("{:.1}", Value::Number(Num::float(5.0)), "5e+00"),
            ("{:.2}", Value::Number(Num::float(12.5)), "1.2e+01"),
            ("{:g}", Value::Number(Num::float(-0.0)), "-0"),
            ("{:#g}", Value::Number(Num::float(1.5)), "1.50000"),
            ("{:.0%}", Value::Number(Num::float(0.25)), "25%"),
            ("{:+}", Value::Number(Num::float(2.5)), "+2.5"),
            ("{:F}", Value::Number(Num::float(f64::INFINITY)), "INF"),
        ] {
            let filled = braces(template, &[value], &[], budget).unwrap();
            assert_eq!(filled.unwrap(), text, "{template}");
        }
    }

    #[test]
    fn braces_fill_templates() {
        let budget = &mut Budget::default();
        assert_eq!(
            braces("{{{}}}{1}", &[Value::int(1), Value::int(2)], &[], budget)
                .unwrap()
                .unwrap(),
            "{1}2"
        );
        assert!(braces("{x}", &[], &[], budget).unwrap().is_none());
    }
}
