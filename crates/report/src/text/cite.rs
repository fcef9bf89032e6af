//! The numbers of the definitions (`docs/src/definitions.md`) that sentences refer to.

use kutzbach_mobility::{CertificateLevel, MobilityClass, SingularKind};

pub(super) const FREEDOM: &str = "D1";
pub(super) const INSTANTANEOUS: &str = "D3";
pub(super) const FINITE: &str = "D4";
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::definitions::find;

    #[test]
    fn numbers_are_those_of_the_definitions() {
        for (word, number) in [
            ("freedom", FREEDOM),
            ("instantaneous", INSTANTANEOUS),
            ("finite", FINITE),
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
