//! The numbers of the definitions (`docs/src/definitions.md`) that sentences refer to.

use kutzbach_mobility::{CertificateLevel, MobilityClass, SingularKind};

pub(super) const FREEDOM: &str = "D1";
pub(super) const INSTANTANEOUS: &str = "D3";
pub(super) const FINITE: &str = "D4";
pub(super) const REDUNDANT: &str = "D5";
pub(super) const REGULAR: &str = "D6";
pub(super) const KIND: &str = "D7";
pub(super) const BRANCH: &str = "D8";
pub(super) const CLASS: &str = "D11";
pub(super) const CERTIFICATE: &str = "D12";
pub(super) const NOMINAL: &str = "D13";
pub(super) const ASSEMBLED: &str = "D17";
pub(super) const MOTION: &str = "D19";
pub(super) const EVIDENCE: &str = "D20";
pub(super) const IDLE: &str = "D10";
pub(super) const INPUT: &str = "D26";

/// `bifurcation, D7`.
pub(super) fn kind(kind: SingularKind) -> String {
    format!("{}, {KIND}", kind.word().replace('_', " "))
}

/// `paradoxical, D11`.
pub(super) fn class(class: MobilityClass) -> String {
    format!("{class}, {CLASS}")
}

/// `numeric, D12`.
pub(super) fn level(level: CertificateLevel) -> String {
    format!("{level}, {CERTIFICATE}")
}

/// A sentence without its citations, ` (D3)` and `, D3)`: a first screen is read before anything is looked up.
pub(super) fn without(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find([' ', ',']) {
        let (before, here) = rest.split_at(at);
        plain.push_str(before);
        let whole = here.strip_prefix(" (D").and_then(number);
        let part = here.strip_prefix(", D").and_then(number);
        rest = match (whole, part) {
            (Some(after), _) => after,
            (_, Some(after)) => {
                plain.push(')');
                after
            }
            _ => {
                let (one, after) = here.split_at(1);
                plain.push_str(one);
                after
            }
        };
    }
    plain.push_str(rest);
    plain
}

/// What follows `3)`.
fn number(text: &str) -> Option<&str> {
    let after = text.trim_start_matches(|c: char| c.is_ascii_digit());
    (after.len() < text.len()).then_some(())?;
    after.strip_prefix(')')
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::definitions::find;

    #[test]
    fn citations_are_taken_out_and_nothing_else() {
        for (with, without_them) in [
            ("moves (exact, D12): so", "moves (exact): so"),
            ("Singular (D6), `D7` (D8).", "Singular, `D7`."),
            (
                "D1, D2 (Dx) (D3, y), (D, 4) (D5",
                "D1, D2 (Dx) (D3, y), (D, 4) (D5",
            ),
            ("", ""),
        ] {
            assert_eq!(without(with), without_them);
        }
    }

    #[test]
    fn numbers_are_those_of_the_definitions() {
        for (word, number) in [
            ("freedom", FREEDOM),
            ("instantaneous", INSTANTANEOUS),
            ("finite", FINITE),
            ("redundant", REDUNDANT),
            ("regular", REGULAR),
            ("kind", KIND),
            ("branch", BRANCH),
            ("class", CLASS),
            ("certificate", CERTIFICATE),
            ("nominal", NOMINAL),
            ("assembled", ASSEMBLED),
            ("relative motion", MOTION),
            ("evidence", EVIDENCE),
            ("idle", IDLE),
            ("input", INPUT),
        ] {
            assert_eq!(find(word).unwrap().number, number, "{word}");
        }
        for of_kind in SingularKind::ALL {
            assert_eq!(find(of_kind.word()).unwrap().number, KIND);
            assert!(kind(*of_kind).ends_with(KIND));
        }
        for of_class in MobilityClass::ALL {
            assert_eq!(find(of_class.word()).unwrap().number, CLASS);
            assert!(class(*of_class).starts_with(of_class.word()));
        }
        for of_level in CertificateLevel::ALL {
            assert_eq!(find(of_level.word()).unwrap().number, CERTIFICATE);
            assert!(level(*of_level).starts_with(of_level.word()));
        }
    }
}
