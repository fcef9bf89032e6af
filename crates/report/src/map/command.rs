//! The command that makes the report of a cell.

use super::reading::Cell;
use super::{Map, tones::Tone};
use crate::sweep::Fraction;

/// More cells than this are not listed.
const LISTED: usize = 2000;

/// A cell in a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listed {
    /// The number of its first variant.
    pub variant: u64,
    /// The values of all measures of that variant, as written.
    pub measures: Vec<String>,
    /// What its colour stands for.
    pub shown: String,
    /// The command that makes the report of that variant.
    pub command: String,
}

impl Map {
    /// All cells with the commands that make their reports; none where there are more than two thousand.
    #[must_use]
    pub fn listed(&self) -> Vec<Listed> {
        if !self.is_listed() {
            return Vec::new();
        }
        let tones = self.cells.iter().zip(&self.tones);
        tones
            .map(|(cell, tone)| Listed {
                variant: cell.variant,
                measures: cell.measures.clone(),
                shown: self.label(*tone).to_owned(),
                command: self.command(cell),
            })
            .collect()
    }

    /// The names of all measures of the sweep, in its order.
    pub fn measure_names(&self) -> impl Iterator<Item = &str> {
        let columns = &self.sweep.columns;
        columns
            .measures()
            .map(move |place| columns.measure_name(place))
    }

    /// Whether a list has all cells.
    pub(super) fn is_listed(&self) -> bool {
        self.cells.len() <= LISTED
    }

    /// What a colour stands for.
    pub(super) fn label(&self, tone: Tone) -> &str {
        let entry = self.legend.iter().find(|entry| entry.tone == tone);
        entry.map_or("", |entry| entry.label.as_str())
    }

    /// The command that makes the report of a cell's first variant.
    pub(super) fn command(&self, cell: &Cell) -> String {
        let mut words = vec!["kutzbach".to_owned(), "report".to_owned()];
        words.push(in_shell(self.sweep.file().unwrap_or("FILE")));
        let mut set = |setting: &str| {
            words.push("--set".to_owned());
            words.push(in_shell(setting));
        };
        let head = self.sweep.head.as_ref();
        if let Some(head) = head {
            for setting in &head.set {
                set(setting);
            }
        }
        for (name, value) in self.measure_names().zip(&cell.measures) {
            set(&format!("{name}={}", exact(value)));
        }
        if let Some(head) = head {
            if head.literal {
                words.push("--literal".to_owned());
            }
            for (option, value) in [
                ("--precision", head.precision),
                ("--closure-tolerance", head.closure_tolerance),
            ] {
                if let Some(value) = value {
                    words.push(option.to_owned());
                    words.push(format!("{value:?}"));
                }
            }
        }
        words.join(" ")
    }
}

/// A value as the sweep gave it to the file's reader: a decimal would say of itself that it is rounded, a fraction does not.
fn exact(shown: &str) -> String {
    match Fraction::read(shown) {
        Some(fraction) => fraction.expression(),
        None => long_decimal(shown).unwrap_or_else(|| shown.to_owned()),
    }
}

/// A decimal of any length as a fraction; `None` where it is something else.
fn long_decimal(shown: &str) -> Option<String> {
    let (sign, size) = match shown.strip_prefix('-') {
        Some(size) => ("-", size),
        None => ("", shown),
    };
    let (whole, places) = size.split_once('.')?;
    let digits = format!("{whole}{places}");
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let significant = match digits.trim_start_matches('0') {
        "" => "0",
        some => some,
    };
    Some(format!("{sign}{significant}/1{}", "0".repeat(places.len())))
}

/// A word as shells read it.
fn in_shell(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_./=+-:,".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_exact() {
        assert_eq!(exact("0.005"), "1/200");
        assert_eq!(exact("-3"), "-3");
        assert_eq!(exact("1/3"), "1/3");
        assert_eq!(exact("pi/4"), "pi/4");
        assert_eq!(exact("-0.0000000000000125"), "-125/10000000000000000");
    }

    #[test]
    fn words_are_what_shells_read() {
        assert_eq!(in_shell("a=1/2"), "a=1/2");
        assert_eq!(in_shell("a=atan2(1, 2)"), "'a=atan2(1, 2)'");
        assert_eq!(in_shell("it's"), r"'it'\''s'");
    }
}
