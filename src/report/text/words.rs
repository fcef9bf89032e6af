//! Numbers, counted things and lists of names, as a person writes them.

/// `1 joint`, `2 joints`; the plural is formed with `s`.
#[must_use]
pub fn counted(count: usize, thing: &str) -> String {
    if count == 1 {
        format!("1 {thing}")
    } else {
        format!("{count} {thing}s")
    }
}

/// A clause as a sentence of its own: a capital, and one full stop.
#[must_use]
pub fn capitalised(clause: &str) -> String {
    let mut letters = clause.chars();
    let first: String = letters
        .next()
        .into_iter()
        .flat_map(char::to_uppercase)
        .collect();
    format!("{first}{}.", letters.as_str().trim_end_matches('.'))
}

/// A measured number with three significant digits: `0.3`, `12.5`, `2.5e-13`. Powers of ten from 0.001 to 10,000 are
/// written out.
#[must_use]
pub fn figure(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.2e}");
    let (mantissa, exponent) = scientific
        .split_once('e')
        .unwrap_or((scientific.as_str(), "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-3..4).contains(&exponent) {
        let decimals = usize::try_from(2 - exponent).unwrap_or(0);
        trimmed(&format!("{value:.decimals$}"))
    } else {
        format!("{}e{exponent}", trimmed(mantissa))
    }
}

fn trimmed(digits: &str) -> String {
    if digits.contains('.') {
        digits
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned()
    } else {
        digits.to_owned()
    }
}

/// A time on the clock, in two or three digits and the unit that fits: `3.1 µs`, `12 ms`, `1.4 s`.
#[must_use]
pub fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if !s.is_finite() => return "–".to_owned(),
        s if s < 0.9995e-6 => (s * 1e9, "ns"),
        s if s < 0.9995e-3 => (s * 1e6, "µs"),
        s if s < 0.9995 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    if value < 9.95 {
        format!("{value:.1} {unit}")
    } else {
        format!("{value:.0} {unit}")
    }
}

/// `a`, `a and b`, `a, b and c`; above `most` names, `a, b and 12 more`.
#[must_use]
pub fn names(list: &[String], most: usize) -> String {
    let shown = if list.len() > most { most } else { list.len() };
    let more = list.len() - shown;
    let (last, first) = match (&list[..shown], more) {
        ([], 0) => return "none".to_owned(),
        (all, 0) => (all[shown - 1].clone(), &all[..shown - 1]),
        (all, more) => (format!("{more} more"), all),
    };
    if first.is_empty() {
        last
    } else {
        format!("{} and {last}", first.join(", "))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_three_digits() {
        for (value, text) in [
            (0.3, "0.3"),
            (-12.46, "-12.5"),
            (999.6, "1000"),
            (2.5e-13, "2.5e-13"),
            (0.001_234, "0.00123"),
            (123_456.0, "1.23e5"),
            (0.0, "0"),
            (1.0, "1"),
            (9999.0, "1e4"),
        ] {
            assert_eq!(figure(value), text);
        }
    }

    #[test]
    fn long_lists_are_abridged() {
        let list: Vec<String> = ["a", "b", "c"].iter().map(|n| (*n).to_owned()).collect();
        assert_eq!(names(&list, 3), "a, b and c");
        assert_eq!(names(&list, 2), "a, b and 1 more");
        assert_eq!(names(&list[..1], 2), "a");
        assert_eq!(names(&[], 2), "none");
    }
}
