//! The sentence on literals that were read as constants.

use super::super::schema::{Constants, LiteralAt, LiteralReading};
use super::words::counted;

/// Readings that a verbose page shows.
const SHOWN: usize = 3;

/// `31 literals read as what they are within their digits: `1.5707963267948966` = π/2, …`
pub(super) fn sentence(constants: &Constants, verbose: bool) -> String {
    if !verbose {
        return briefly(constants);
    }
    let shown: Vec<String> = constants
        .readings
        .iter()
        .take(SHOWN)
        .map(|reading| format!("`{}` = {}", reading.literal, reading.read_as))
        .collect();
    let more = match constants.readings.len() > SHOWN {
        true => ", …",
        false => "",
    };
    format!(
        " {} read as what they are within their digits: {}{more} (`--literal` takes them as written).",
        counted(constants.count, "literal"),
        shown.join(", ")
    )
}

/// The same with one reading, the shortest of those that are more than a rounded decimal.
fn briefly(constants: &Constants) -> String {
    let decimal = |text: &str| text.parse::<f64>().is_ok();
    let rank = |reading: &&LiteralReading| (decimal(&reading.read_as), reading.literal.len());
    let such_as = constants.readings.iter().min_by_key(rank);
    let such_as = such_as.map_or_else(String::new, |reading| {
        format!(", such as `{}` = {}", reading.literal, reading.read_as)
    });
    format!(
        " {} read as the constants they round{such_as} (`--literal` takes them as written).",
        counted(constants.count, "literal")
    )
}

/// `1 residue of rounding read as 0: `3e-06` in `hinge_2` …`; nothing where there is none.
pub(super) fn residues(found: &[LiteralAt]) -> String {
    if found.is_empty() {
        return String::new();
    }
    let shown = found.iter().take(SHOWN);
    let shown: Vec<String> = shown
        .map(|at| format!("`{}` in `{}`", at.literal, at.owner))
        .collect();
    let more = if found.len() > SHOWN { ", …" } else { "" };
    format!(
        " {} of rounding read as 0: {}{more} (`--literal` takes them as written).",
        counted(found.len(), "residue"),
        shown.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_readings_are_shown() {
        let reading = |literal: &str, read_as: &str| LiteralReading {
            literal: literal.to_owned(),
            read_as: read_as.to_owned(),
        };
        let mut constants = Constants {
            count: 31,
            readings: vec![
                reading("1.5707963267948966", "π/2"),
                reading("6.123e-17", "0"),
            ],
        };
        assert_eq!(
            sentence(&constants, true),
            " 31 literals read as what they are within their digits: `1.5707963267948966` = π/2, `6.123e-17` = 0 (`--literal` \
             takes them as written)."
        );
        constants.readings.extend([
            reading("0.7853981633974483", "π/4"),
            reading("3.14159265", "π"),
        ]);
        assert!(sentence(&constants, true).contains("π/4, … ("));
        assert!(sentence(&constants, false).contains(", such as `3.14159265` = π ("));
    }
}
