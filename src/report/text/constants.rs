//! The sentence on literals that were read as constants.

use super::super::schema::{Constants, LiteralReading};
use super::words::counted;

/// Readings that a verbose page shows.
const SHOWN: usize = 3;

/// `31 literals read as what they are within their digits: `1.5707963267948966` = π/2, …`; one reading unless everything is
/// asked for, the shortest of those that are more than a rounded decimal.
pub(super) fn sentence(constants: &Constants, verbose: bool) -> String {
    let decimal = |text: &str| text.parse::<f64>().is_ok();
    let mut readings: Vec<&LiteralReading> = constants.readings.iter().collect();
    if !verbose {
        readings.sort_by_key(|reading| (decimal(&reading.read_as), reading.literal.len()));
        readings.truncate(1);
    }
    let shown: Vec<String> = readings
        .iter()
        .take(SHOWN)
        .map(|reading| format!("`{}` = {}", reading.literal, reading.read_as))
        .collect();
    let more = match constants.readings.len() > shown.len() {
        true => ", …",
        false => "",
    };
    format!(
        " {} read as what they are within their digits: {}{more} (`--literal` takes them as written).",
        counted(constants.count, "literal"),
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
        assert!(sentence(&constants, false).contains(": `3.14159265` = π, … ("));
    }
}
