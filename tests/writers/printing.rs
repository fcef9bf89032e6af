//! How programs print numbers.

use kutzbach::matrix::SplitMix64;

/// What a number is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum What {
    Length,
    Angle,
    Direction,
}

/// How one is printed.
#[derive(Clone, Copy)]
pub enum Style {
    /// `%.Nf`.
    Fixed(usize),
    /// Rounded to so many decimals, and printed as short as can be.
    Shortest(usize),
    /// `%.Ng`.
    General(usize),
    /// Every double by its shortest text.
    Double,
    /// Passed through single precision, then as doubles are.
    Single,
    /// Passed through single precision, then `%.9g`.
    SingleShort,
    /// Doubles off by up to so much.
    Noisy(f64),
    /// As [`Shortest`](Self::Shortest), but every other zero is left as three to twelve millionths.
    Residues(usize),
}

/// A program.
pub struct Writer {
    pub name: &'static str,
    /// Of lengths, angles and directions.
    pub styles: [Style; 3],
    /// The same in joints that close loops, where somebody else wrote these.
    pub closing: Option<[Style; 3]>,
    /// Whether the quick tier asks.
    pub quick: bool,
    /// Of a hundred files so many may be left open.
    pub open: usize,
}

const fn alike(name: &'static str, style: Style, quick: bool) -> Writer {
    Writer {
        name,
        styles: [style; 3],
        closing: None,
        quick,
        open: 2,
    }
}

const fn mixed(name: &'static str, styles: [Style; 3]) -> Writer {
    Writer {
        name,
        styles,
        closing: None,
        quick: false,
        open: 2,
    }
}

/// The tree by one program, the joints that close loops by another.
const fn two(name: &'static str, tree: Style, closing: Style) -> Writer {
    Writer {
        closing: Some([closing; 3]),
        ..alike(name, tree, false)
    }
}

pub const WRITERS: [Writer; 21] = [
    alike("%.4f", Style::Fixed(4), false),
    alike("%.5f", Style::Fixed(5), true),
    alike("%.6f", Style::Fixed(6), true),
    alike("%.9f", Style::Fixed(9), false),
    alike("%.12f", Style::Fixed(12), false),
    alike("%.6g", Style::General(6), false),
    alike("%.9g", Style::General(9), false),
    alike("doubles", Style::Double, true),
    alike("noise 1e-12", Style::Noisy(1e-12), true),
    alike("noise 1e-9", Style::Noisy(1e-9), true),
    alike("single", Style::Single, false),
    alike("single %.9g", Style::SingleShort, false),
    alike("round 6", Style::Shortest(6), false),
    mixed(
        "lengths 6, rest full",
        [Style::Fixed(6), Style::Double, Style::Double],
    ),
    Writer {
        // Look-alikes are spoiled by a few tenths of a millimetre only.
        open: 6,
        ..mixed(
            "lengths 4, rest 6",
            [Style::Fixed(4), Style::Fixed(6), Style::Fixed(6)],
        )
    },
    Writer {
        // Look-alikes are spoiled by a few millimetres only.
        open: 12,
        ..mixed(
            "lengths 3 with residues, rest 6",
            [Style::Residues(3), Style::Shortest(6), Style::Shortest(6)],
        )
    },
    mixed(
        "lengths full, rest 5",
        [Style::Double, Style::Fixed(5), Style::Fixed(5)],
    ),
    two("%.6f, loops %.4f", Style::Fixed(6), Style::Fixed(4)),
    two("doubles, loops %.6f", Style::Double, Style::Fixed(6)),
    two("%.9f, loops round 6", Style::Fixed(9), Style::Shortest(6)),
    two("%.5f, loops doubles", Style::Fixed(5), Style::Double),
];

impl Writer {
    /// How far a number may be from the one printed (m, rad; numbers of about 1).
    pub fn off_by(&self) -> f64 {
        let all = [self.styles, self.closing.unwrap_or(self.styles)].concat();
        let each = all.into_iter().map(|style| match style {
            Style::Fixed(n) | Style::Shortest(n) | Style::General(n) | Style::Residues(n) => {
                0.5 * 10f64.powi(-(n as i32))
            }
            Style::Double => 1e-16,
            Style::Single | Style::SingleShort => 6e-8,
            Style::Noisy(size) => size,
        });
        each.fold(0.0, f64::max)
    }

    /// A number, of a joint that closes a loop or not.
    pub fn number(&self, what: What, value: f64, closes: bool, random: &mut SplitMix64) -> String {
        let styles = self.closing.filter(|_| closes).unwrap_or(self.styles);
        let style = match what {
            What::Length => styles[0],
            What::Angle => styles[1],
            What::Direction => styles[2],
        };
        match style {
            Style::Fixed(decimals) => bare_zero(format!("{value:.decimals$}")),
            Style::Residues(_) if value.abs() < NOTHING && random.symmetric() > 0.0 => {
                residue(random)
            }
            Style::Shortest(decimals) | Style::Residues(decimals) => {
                let unit = 10f64.powi(decimals as i32);
                format!("{}", (value * unit).round() / unit + 0.0)
            }
            Style::General(digits) => general(value, digits),
            Style::Double => format!("{}", value + 0.0),
            Style::Single => format!("{}", f64::from(value as f32) + 0.0),
            Style::SingleShort => general(f64::from(value as f32), 9),
            Style::Noisy(size) => format!("{}", value + size * random.symmetric()),
        }
    }
}

/// What is a zero to a program that rounds.
const NOTHING: f64 = 1e-12;

/// What is left of a zero, as it is printed: `3e-06` … `1.2e-05`.
fn residue(random: &mut SplitMix64) -> String {
    let sign = if random.symmetric() < 0.0 { "-" } else { "" };
    match 3 + random.next_u64() % 10 {
        few @ ..10 => format!("{sign}{few}e-06"),
        many => format!("{sign}1.{}e-05", many - 10),
    }
}

/// No sign before a zero.
fn bare_zero(text: String) -> String {
    match text.trim_start_matches(['-', '0', '.']).is_empty() {
        true => text.trim_start_matches('-').to_owned(),
        false => text,
    }
}

/// `%.Ng`.
fn general(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap();
    let exponent: i32 = exponent.parse().unwrap();
    let trimmed = |text: &str| -> String {
        match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text.to_owned(),
        }
    };
    if exponent < -4 || exponent >= digits as i32 {
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap();
    trimmed(&format!("{value:.decimals$}"))
}
