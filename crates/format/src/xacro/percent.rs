//! Python's `template % values`.

use super::arithmetic::{LONGEST_TEXT, floor_to_int};
use super::budget::Budget;
use super::field::{Field, WIDEST, digits};
use super::text::Text;
use super::value::{Kind, Num, Value};
use super::{Outcome, Trouble};

/// The values behind `%`: a tuple one by one, anything else as one.
struct Values<'v> {
    whole: &'v Value,
    left: &'v [Value],
}

impl<'v> Values<'v> {
    fn of(whole: &'v Value) -> Self {
        let left = match whole {
            Value::Tuple(items) => items,
            other => std::slice::from_ref(other),
        };
        Self { whole, left }
    }

    fn next(&mut self) -> Option<&'v Value> {
        let (first, rest) = self.left.split_first()?;
        self.left = rest;
        Some(first)
    }

    /// The value of a key `%(name)s`.
    fn named(&mut self, name: &str, budget: &mut Budget) -> Outcome<Option<&'v Value>> {
        let Value::Dict(items) = self.whole else {
            return Ok(None);
        };
        self.left = &[];
        let found = items.find(&Value::text(name), budget)?;
        Ok(found.map(|(_, value)| value))
    }

    /// Whether Python takes these as used up: lists and dictionaries may be left alone.
    fn are_used(&self) -> bool {
        self.left.is_empty() || matches!(self.whole, Value::List(_) | Value::Dict(_))
    }
}

/// What stands between `%` and its letter.
struct Specifier<'t> {
    name: Option<&'t str>,
    field: Field,
    letter: char,
    rest: &'t str,
}

impl<'t> Specifier<'t> {
    /// Reads behind `%`: `[(name)][flags][width][.precision][length]letter`, either number a `*` for the next value.
    fn read(text: &'t str, values: &mut Values<'_>) -> Option<Self> {
        let (name, text) = match text.strip_prefix('(') {
            Some(inside) => {
                let (name, rest) = inside.split_once(')')?;
                (Some(name), rest)
            }
            None => (None, text),
        };
        let plain = text.find(|c: char| c.is_ascii_alphabetic() || c == '%')?;
        let chars: Vec<char> = text[..plain].chars().collect();
        let mut field = Field::default();
        let mut at = 0;
        while let Some(flag @ ('-' | '+' | ' ' | '#' | '0')) = chars.get(at) {
            match flag {
                '-' => field.align = Some('<'),
                '+' => field.sign = Some('+'),
                ' ' => field.sign = field.sign.or(Some(' ')),
                '#' => field.alternate = true,
                _ => field.zero = true,
            }
            at += 1;
        }
        let width = number(&chars, &mut at, values)?.unwrap_or(0);
        if width < 0 {
            field.align = Some('<');
        }
        field.width = usize::try_from(width.unsigned_abs()).ok()?;
        if chars.get(at) == Some(&'.') {
            at += 1;
            let precision = number(&chars, &mut at, values)?.unwrap_or(0);
            field.precision = Some(usize::try_from(precision.max(0)).ok()?);
        }
        let rest = text[plain..].trim_start_matches(['h', 'l', 'L']);
        let letter = rest.chars().next()?;
        // Zeros fill from the left only.
        field.zero &= field.align.is_none();
        field.align = field.align.or((!field.zero).then_some('>'));
        (at == chars.len()).then_some(Self {
            name,
            field,
            letter,
            rest: &rest[letter.len_utf8()..],
        })
    }

    /// A value in the form that the letter asks for.
    fn apply(mut self, value: &Value, budget: &mut Budget) -> Outcome<Option<String>> {
        let text = match self.letter {
            's' => budget.text(value)?,
            'r' | 'a' => budget.repr(value)?,
            'c' => match character(value) {
                Some(c) => Text::plain(c.encode_utf8(&mut [0; 4])),
                None => return Ok(None),
            },
            letter => {
                self.field.sort = Some(letter);
                return Ok(value.number().and_then(|number| self.number(&number)));
            }
        };
        if self.letter == 'c' {
            self.field.precision = None;
        }
        self.field.zero = false;
        self.field.align = self.field.align.or(Some('>'));
        Ok(Some(self.field.text(text.as_str())))
    }

    fn number(&self, number: &Num) -> Option<String> {
        match (self.letter, number.kind) {
            ('d' | 'i' | 'u' | 'x' | 'X' | 'o', Kind::Int(value)) => {
                Some(self.field.integer(value))
            }
            ('d' | 'i' | 'u', Kind::Float(value)) => match floor_to_int(value.trunc())?.kind {
                Kind::Int(whole) => Some(self.field.integer(whole)),
                Kind::Float(_) => None,
            },
            ('e' | 'E' | 'f' | 'F' | 'g' | 'G', _) => {
                self.field.double(number.double(), self.letter)
            }
            _ => None,
        }
    }
}

/// A width or precision: digits, or `*` for the next value. The outer `None` where it is too large or none.
fn number(chars: &[char], at: &mut usize, values: &mut Values<'_>) -> Option<Option<i64>> {
    if chars.get(*at) != Some(&'*') {
        return Some(digits(chars, at)?.and_then(|number| i64::try_from(number).ok()));
    }
    *at += 1;
    match values.next()?.number()?.kind {
        Kind::Int(value) if value.unsigned_abs() <= WIDEST as u128 => {
            i64::try_from(value).ok().map(Some)
        }
        _ => None,
    }
}

/// The character that `%c` makes of a text of one, or of its number.
fn character(value: &Value) -> Option<char> {
    if let Value::Text(text) = value {
        let mut chars = text.as_str().chars();
        return chars.next().filter(|_| chars.next().is_none());
    }
    match value.number()?.kind {
        Kind::Int(code) => char::from_u32(u32::try_from(code).ok()?),
        Kind::Float(_) => None,
    }
}

/// `template % values`. `None` where the template and the values do not fit.
pub(super) fn percent(
    template: &str,
    values: &Value,
    budget: &mut Budget,
) -> Outcome<Option<String>> {
    let mut values = Values::of(values);
    let mut out = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once('%') {
        out.push_str(before);
        let Some(specifier) = Specifier::read(after, &mut values) else {
            return Ok(None);
        };
        rest = specifier.rest;
        if specifier.letter == '%' {
            out.push('%');
            continue;
        }
        let value = match specifier.name {
            Some(name) => values.named(name, budget)?,
            None => values.next(),
        };
        let Some(value) = value else {
            return Ok(None);
        };
        match specifier.apply(value, budget)? {
            Some(text) => out.push_str(&text),
            None => return Ok(None),
        }
        if out.len() > LONGEST_TEXT {
            return Err(Trouble::new("the text is too long"));
        }
    }
    out.push_str(rest);
    Ok(values.are_used().then_some(out))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::keyed::Keyed;
    use super::*;

    fn filled(template: &str, values: &[Value]) -> Option<String> {
        let values = match values {
            [one] => one.clone(),
            several => Value::Tuple(several.into()),
        };
        percent(template, &values, &mut Budget::default()).unwrap()
    }

    fn float(value: f64) -> Value {
        Value::Number(Num::float(value))
    }

    #[test]
    fn templates_are_filled_as_in_python() {
        for (template, values, text) in [
            ("%.3s", &[float(3.0708)] as &[Value], "3.0"),
            ("%#x", &[Value::Number(Num::int(30))] as &[Value], "0x1e"),
            (
                "%#08x",
                &[Value::Number(Num::int(30))] as &[Value],
                "0x00001e",
            ),
            ("%#X", &[Value::Number(Num::int(-30))] as &[Value], "-0X1E"),
            ("%#o", &[Value::Number(Num::int(8))] as &[Value], "0o10"),
            ("%G", &[float(7.6e-06)] as &[Value], "7.6E-06"),
            ("%E", &[float(12345.678)] as &[Value], "1.234568E+04"),
            ("%F", &[float(f64::INFINITY)] as &[Value], "INF"),
            ("%g", &[float(-0.0)] as &[Value], "-0"),
            ("%g", &[float(1000000.0)] as &[Value], "1e+06"),
            ("%#g", &[float(1.5)] as &[Value], "1.50000"),
            ("%#.0f", &[float(3.0)] as &[Value], "3."),
            ("%#.0e", &[float(12345.0)] as &[Value], "1.e+04"),
            ("%+d", &[Value::Number(Num::int(5))] as &[Value], "+5"),
            ("%+.2f", &[float(0.5)] as &[Value], "+0.50"),
            ("% d", &[Value::Number(Num::int(7))] as &[Value], " 7"),
            ("%+ d", &[Value::Number(Num::int(7))] as &[Value], "+7"),
            ("%.3d", &[Value::Number(Num::int(5))] as &[Value], "005"),
            (
                "%6.3d|",
                &[Value::Number(Num::int(-5))] as &[Value],
                "  -005|",
            ),
            (
                "%-6d|",
                &[Value::Number(Num::int(5))] as &[Value],
                "5     |",
            ),
            (
                "%-06d|",
                &[Value::Number(Num::int(5))] as &[Value],
                "5     |",
            ),
            ("%06.1f", &[float(-2.5)] as &[Value], "-002.5"),
            ("%05s", &[Value::text("a")] as &[Value], "    a"),
            ("%-5s|", &[Value::text("a")] as &[Value], "a    |"),
            ("%5.1s|", &[Value::text("abc")] as &[Value], "    a|"),
            (
                "%c%c",
                &[Value::text("A"), Value::Number(Num::int(66))] as &[Value],
                "AB",
            ),
            ("%r", &[Value::text("a'")] as &[Value], "\"a'\""),
            ("%.2r", &[Value::text("abc")] as &[Value], "'a"),
            (
                "%*d|%-*d|",
                &[
                    Value::Number(Num::int(4)),
                    Value::Number(Num::int(7)),
                    Value::Number(Num::int(4)),
                    Value::Number(Num::int(7)),
                ] as &[Value],
                "   7|7   |",
            ),
            (
                "%.*f",
                &[Value::Number(Num::int(2)), float(1.2345)] as &[Value],
                "1.23",
            ),
            ("%ld", &[Value::Number(Num::int(3))] as &[Value], "3"),
            ("%d", &[float(2.9)] as &[Value], "2"),
            ("%d", &[float(-2.9)] as &[Value], "-2"),
            (
                "%i%u",
                &[Value::Number(Num::int(1)), Value::Number(Num::int(2))] as &[Value],
                "12",
            ),
            ("%s", &[Value::Bool(true)] as &[Value], "True"),
            ("%d", &[Value::Bool(true)] as &[Value], "1"),
            ("%x", &[Value::Bool(true)] as &[Value], "1"),
            ("%.0e", &[float(5.0)] as &[Value], "5e+00"),
            ("%.10g", &[float(0.1)] as &[Value], "0.1"),
            (
                "%s_%02d%%",
                &[Value::text("a"), Value::Number(Num::int(3))] as &[Value],
                "a_03%",
            ),
            ("%e", &[float(0.0)] as &[Value], "0.000000e+00"),
            ("%010.3e|", &[float(-1.5e-07)] as &[Value], "-1.500e-07|"),
            ("%.0f", &[float(0.5)] as &[Value], "0"),
            ("%05f", &[float(f64::INFINITY)] as &[Value], "00inf"),
            ("%+g", &[float(f64::NAN)] as &[Value], "+nan"),
            ("%g", &[float(123456789.0)] as &[Value], "1.23457e+08"),
            ("%g", &[float(100000.0)] as &[Value], "100000"),
            ("%.3g", &[float(99999.0)] as &[Value], "1e+05"),
        ] {
            assert_eq!(filled(template, values).unwrap(), text, "{template}");
        }
        let named = Keyed::collect([(Value::text("a"), Value::int(1))], &mut Budget::default());
        let named = Value::Dict(named.unwrap());
        assert_eq!(
            filled("%(a)03d%(a)s", std::slice::from_ref(&named)).unwrap(),
            "0011"
        );
        assert_eq!(filled("a", &[named]).unwrap(), "a");
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let text = || Value::text("a");
        for (template, values) in [
            ("%s%s", vec![text()]),
            ("a", vec![text()]),
            ("%d", vec![text()]),
            ("%x", vec![float(1.0)]),
            ("%d", vec![float(f64::NAN)]),
            ("%c", vec![Value::text("ab")]),
            ("%c", vec![Value::int(0x11_0000)]),
            ("%(a)s", vec![text()]),
            ("%(a", vec![text()]),
            ("%*d", vec![text(), text()]),
            ("%99999d", vec![Value::int(1)]),
            ("%", vec![text()]),
            ("%5", vec![text()]),
            ("%y", vec![Value::int(1)]),
            ("%é", vec![Value::int(1)]),
            ("%1-d", vec![Value::int(1)]),
        ] {
            assert!(filled(template, &values).is_none(), "{template}");
        }
    }
}
