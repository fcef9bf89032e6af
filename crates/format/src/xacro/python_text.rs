//! Numbers and texts as Python prints them, and Python's two ways of formatting.

use super::arithmetic::{LONGEST_TEXT, floor_to_int};
use super::budget::Budget;
use super::value::{Kind, Num, Value};
use super::{Outcome, Trouble};

/// Widest field and longest fraction of a format.
const WIDEST: usize = 4096;

/// Python's `repr` of a double: the fewest digits that read back the same.
pub(super) fn float_text(value: f64) -> String {
    if value.is_nan() {
        return "nan".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "inf" } else { "-inf" }.to_owned();
    }
    let scientific = format!("{value:e}");
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..16).contains(&exponent) {
        let plain = format!("{value}");
        if plain.contains('.') {
            plain
        } else {
            format!("{plain}.0")
        }
    } else {
        format!("{mantissa}e{}", exponent_text(exponent))
    }
}

/// At least two digits, with a sign.
fn exponent_text(exponent: i32) -> String {
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{sign}{:02}", exponent.unsigned_abs())
}

/// Python's `repr` of a text.
pub(super) fn quoted_text(text: &str) -> String {
    let quote = if text.contains('\'') && !text.contains('"') {
        '"'
    } else {
        '\''
    };
    let mut out = String::with_capacity(text.len() + 2);
    out.push(quote);
    for c in text.chars() {
        match c {
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            '\r' => out.push_str("\\r"),
            c if c == quote => {
                out.push('\\');
                out.push(c);
            }
            c => out.push(c),
        }
    }
    out.push(quote);
    out
}

/// A field of a format: `[[fill]align][sign][#][0][width][,][.precision][type]`.
#[derive(Debug, Default)]
pub(super) struct Field {
    fill: Option<char>,
    align: Option<char>,
    sign: Option<char>,
    zero: bool,
    grouped: bool,
    width: usize,
    precision: Option<usize>,
    sort: Option<char>,
}

impl Field {
    /// Reads what stands behind the colon of `{:...}`.
    pub(super) fn read(spec: &str) -> Option<Self> {
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
    pub(super) fn apply(&self, value: &Value, budget: &mut Budget) -> Outcome<Option<String>> {
        if self.sort == Some('s') || self.sort.is_none() && !matches!(value, Value::Number(_)) {
            let text = budget.text(value)?;
            let most = self.precision.unwrap_or(usize::MAX);
            let cut: String = text.as_str().chars().take(most).collect();
            return Ok(Some(self.padded(&cut, false)));
        }
        Ok(self.of_number(value))
    }

    fn of_number(&self, value: &Value) -> Option<String> {
        let number = value.number();
        let (body, is_number) = match (self.sort, &number) {
            (Some('d' | 'x' | 'X' | 'o' | 'b'), Some(number)) => {
                let Kind::Int(value) = number.kind else {
                    return None;
                };
                (self.integer(value), true)
            }
            (None, Some(number)) if self.precision.is_none() => {
                (number.text().as_str().to_owned(), true)
            }
            (sort, Some(number)) => (self.float(number.double(), sort.unwrap_or('g'))?, true),
            _ => return None,
        };
        Some(self.padded(&body, is_number))
    }

    fn integer(&self, value: i128) -> String {
        let magnitude = value.unsigned_abs();
        let digits = match self.sort {
            Some('x') => format!("{magnitude:x}"),
            Some('X') => format!("{magnitude:X}"),
            Some('o') => format!("{magnitude:o}"),
            Some('b') => format!("{magnitude:b}"),
            _ => magnitude.to_string(),
        };
        if value < 0 {
            format!("-{digits}")
        } else {
            digits
        }
    }

    fn float(&self, value: f64, sort: char) -> Option<String> {
        let precision = self.precision.unwrap_or(6);
        if !value.is_finite() {
            return Some(float_text(value));
        }
        Some(match sort {
            'f' | 'F' => format!("{value:.precision$}"),
            'e' | 'E' => {
                let text = with_exponent(value, precision);
                if sort == 'E' {
                    text.to_uppercase()
                } else {
                    text
                }
            }
            'g' | 'G' => general(value, precision.max(1)),
            '%' => format!("{:.precision$}%", value * 100.0),
            _ => return None,
        })
    }

    fn padded(&self, body: &str, is_number: bool) -> String {
        let (sign, digits) = match body.strip_prefix('-') {
            Some(rest) if is_number => ("-", rest),
            _ if is_number && self.sign == Some('+') => ("+", body),
            _ if is_number && self.sign == Some(' ') => (" ", body),
            _ => ("", body),
        };
        let mut digits = digits.to_owned();
        if self.grouped && is_number {
            let whole = digits.find('.').unwrap_or(digits.len());
            let mut at = whole;
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
            (_, true) => '>',
            _ => '<',
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
fn digits(chars: &[char], at: &mut usize) -> Option<Option<usize>> {
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

fn with_exponent(value: f64, precision: usize) -> String {
    let text = format!("{value:.precision$e}");
    match text.split_once('e') {
        Some((mantissa, exponent)) => {
            format!(
                "{mantissa}e{}",
                exponent_text(exponent.parse().unwrap_or(0))
            )
        }
        None => text,
    }
}

fn general(value: f64, precision: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.*e}", precision - 1);
    let exponent: i32 = scientific
        .split_once('e')
        .and_then(|(_, exponent)| exponent.parse().ok())
        .unwrap_or(0);
    let without_zeros = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    if exponent < -4 || exponent >= precision as i32 {
        let mantissa = scientific.split('e').next().unwrap_or_default();
        format!("{}e{}", without_zeros(mantissa), exponent_text(exponent))
    } else {
        let places = (precision as i32 - 1 - exponent).max(0) as usize;
        without_zeros(&format!("{value:.places$}"))
    }
}

/// `template % values`. `None` where the template and the values do not fit.
pub(super) fn percent(
    template: &str,
    values: &Value,
    budget: &mut Budget,
) -> Outcome<Option<String>> {
    let listed = match values {
        Value::Tuple(items) => items.to_vec(),
        other => vec![other.clone()],
    };
    let mut values = listed.iter();
    let mut out = String::new();
    let mut rest = template;
    while let Some(at) = rest.find('%') {
        out.push_str(&rest[..at]);
        rest = &rest[at + 1..];
        let Some(end) = rest.find(|c: char| c.is_ascii_alphabetic() || c == '%') else {
            return Ok(None);
        };
        let sort = char::from(rest.as_bytes()[end]);
        let flags = &rest[..end];
        rest = &rest[end + 1..];
        if sort == '%' {
            out.push('%');
            continue;
        }
        let mut spec = flags.to_owned();
        let mut field_align = '>';
        if let Some(stripped) = spec.strip_prefix('-') {
            field_align = '<';
            spec = stripped.to_owned();
        }
        let (Some(mut field), Some(value)) = (Field::read(&spec), values.next()) else {
            return Ok(None);
        };
        if !field.zero || field_align == '<' {
            field.align = Some(field_align);
        }
        let value = match sort {
            'd' | 'i' | 'u' => {
                field.sort = Some('d');
                match value.number().and_then(whole) {
                    Some(whole) => Value::Number(whole),
                    None => return Ok(None),
                }
            }
            'r' => Value::Text(budget.repr(value)?),
            _ => {
                field.sort = Some(sort);
                value.clone()
            }
        };
        match field.apply(&value, budget)? {
            Some(text) => out.push_str(&text),
            None => return Ok(None),
        }
        if out.len() > LONGEST_TEXT {
            return Err(Trouble::new("the text is too long"));
        }
    }
    out.push_str(rest);
    Ok(values.next().is_none().then_some(out))
}

/// The integer that `%d` makes of a number.
fn whole(number: Num) -> Option<Num> {
    match number.kind {
        Kind::Int(_) => Some(number),
        Kind::Float(double) => floor_to_int(double.trunc()),
    }
}

/// `template.format(values...)`, without nested fields. `None` where the template and the values do not fit.
pub(super) fn braces(
    template: &str,
    values: &[Value],
    named: &[(std::rc::Rc<str>, Value)],
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
    fn doubles_print_as_python_prints_them() {
        for (value, text) in [
            (1.0, "1.0"),
            (-0.0, "-0.0"),
            (0.1 + 0.2, "0.30000000000000004"),
            (1e15, "1000000000000000.0"),
            (1e16, "1e+16"),
            (1.5e-5, "1.5e-05"),
            (0.0001, "0.0001"),
            (1e-7, "1e-07"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(float_text(value), text);
        }
    }

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

    fn filled(template: &str, values: &Value) -> Option<String> {
        percent(template, values, &mut Budget::default()).unwrap()
    }

    #[test]
    fn percent_and_braces_fill_templates() {
        let budget = &mut Budget::default();
        let pair = Value::Tuple([Value::text("a"), Value::int(3)].into());
        assert_eq!(filled("%s_%02d%%", &pair).unwrap(), "a_03%");
        assert_eq!(
            filled("%.2f", &Value::Number(Num::float(0.5))).unwrap(),
            "0.50"
        );
        assert_eq!(filled("%-3s|", &Value::text("a")).unwrap(), "a  |");
        assert_eq!(filled("%r", &Value::text("a")).unwrap(), "'a'");
        assert!(filled("%s%s", &Value::text("a")).is_none());
        assert_eq!(
            braces("{{{}}}{1}", &[Value::int(1), Value::int(2)], &[], budget)
                .unwrap()
                .unwrap(),
            "{1}2"
        );
        assert!(braces("{x}", &[], &[], budget).unwrap().is_none());
    }
}
