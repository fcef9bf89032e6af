//! Which parts are fasteners, and to what they are tight.
//!
//! A bolt in a hole with its head on the plate is, by its faces, a hinge. Whoever tightens it makes it a part of the plate. Shapes do
//! not say which of the two is meant: a shoulder screw that bears a lever has the same faces. So three things have to agree
//! before a pair is taken as tight: the name of one part is that of a fastener, it touches the other with a round face, and with a
//! plane across the axis of that face, as a head or a washer does. Pins are no fasteners: they are what hinges turn about. Neither are
//! the screws and nuts of drives, and parts for which a person has named a thread. Everything else that a fastener touches is left
//! to its faces: a second plate on its shaft turns about it, as a lever on a shoulder screw does.
//!
//! A nut or a washer at the other end of a bolt has no head on it. It is tight on the bolt where that is tight, sits on it with a round face, and
//! with a plane across the axis on a part that the bolt passes: then it holds this part against the head.

use kutzbach_step::{Contact, ContactKind};
use nalgebra::Vector3;

/// Words of fasteners.
const WORDS: [&str; 9] = [
    "bolt", "screw", "capscrew", "setscrew", "nut", "locknut", "washer", "rivet", "stud",
];

/// Words beside them that make them something that moves.
const DRIVES: [&str; 12] = [
    "lead",
    "ball",
    "jack",
    "power",
    "drive",
    "feed",
    "roller",
    "trapezoidal",
    "acme",
    "spindle",
    "shoulder",
    "pivot",
];

/// Standards whose parts are bolts, screws, nuts and washers, by their numbers. Those of pins, such as DIN 7 and ISO 8734, and of
/// rings and keys are not among them.
const STANDARDS: [(&str, &[&str]); 3] = [
    (
        "din",
        &[
            "84", "85", "125", "127", "433", "439", "555", "558", "601", "603", "912", "913",
            "914", "915", "916", "931", "933", "934", "960", "961", "963", "964", "965", "966",
            "980", "982", "985", "6912", "6914", "6916", "6921", "6923", "7349", "7380", "7500",
            "7603", "7980", "7984", "7985", "7991", "9021",
        ],
    ),
    (
        "iso",
        &[
            "1207", "1580", "2009", "2010", "4014", "4016", "4017", "4018", "4026", "4027", "4028",
            "4029", "4032", "4033", "4034", "4035", "4161", "4162", "4762", "7040", "7042", "7045",
            "7046", "7047", "7089", "7090", "7091", "7092", "7093", "7380", "8765", "10511",
            "10642", "15071",
        ],
    ),
    (
        "en",
        &[
            "1661", "1662", "1663", "1664", "1665", "14399", "24014", "24017",
        ],
    ),
];

/// Two directions are parallel within this sine: a head stands square on its shaft, whatever the digits of its faces.
const SQUARE: f64 = 1e-3;

/// Whether a name is that of a fastener.
pub(super) fn is_fastener(name: &str) -> bool {
    let words = words_of(name);
    let has = |list: &[&str]| {
        let known = |word: &String| {
            let singular = word.strip_suffix('s').unwrap_or(word);
            list.contains(&word.as_str()) || list.contains(&singular)
        };
        words.iter().any(known)
    };
    if has(&DRIVES) {
        return false;
    }
    has(&WORDS) || follows_standard(&words)
}

/// Whether a word for a body of standards stands right before the number of one for fasteners.
fn follows_standard(words: &[String]) -> bool {
    words.windows(2).any(|pair| match pair {
        [body, number] => STANDARDS.iter().any(|(own, numbers)| {
            // `DIN EN ISO 4762` and `DIN_912` alike.
            *own == body.as_str() && numbers.contains(&number.as_str())
        }),
        _ => false,
    })
}

/// The words of a name in lower case: runs of letters or of digits, cut where a capital follows a small letter.
pub(super) fn words_of(name: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut before: Option<char> = None;
    for letter in name.chars() {
        let begins = match before {
            None => true,
            Some(last) => {
                let turns = last.is_numeric() && letter.is_alphabetic()
                    || last.is_alphabetic() && letter.is_numeric()
                    || last.is_lowercase() && letter.is_uppercase();
                !last.is_alphanumeric() || turns
            }
        };
        if letter.is_alphanumeric() {
            if begins {
                words.push(String::new());
            }
            if let Some(word) = words.last_mut() {
                word.extend(letter.to_lowercase());
            }
        }
        before = Some(letter);
    }
    words
}

/// Whether the contacts of a pair are a shaft in a hole and a head across it.
pub(super) fn has_shaft_and_head(contacts: &[Contact]) -> bool {
    shafts(contacts).any(|shaft| has_plane_across(contacts, &shaft.axis))
}

/// The contacts that are shafts in holes.
pub(super) fn shafts(contacts: &[Contact]) -> impl Iterator<Item = &Contact> {
    contacts
        .iter()
        .filter(|contact| contact.kind == ContactKind::Cylindrical)
}

/// Whether one of the contacts is a plane across an axis (unit direction).
pub(super) fn has_plane_across(contacts: &[Contact], axis: &Vector3<f64>) -> bool {
    let mut planes = contacts
        .iter()
        .filter(|contact| contact.kind == ContactKind::Planar);
    planes.any(|plane| along(&plane.axis, axis))
}

/// Whether one of the contacts is a shaft along an axis (unit direction).
pub(super) fn has_shaft_along(contacts: &[Contact], axis: &Vector3<f64>) -> bool {
    shafts(contacts).any(|shaft| along(&shaft.axis, axis))
}

fn along(one: &Vector3<f64>, other: &Vector3<f64>) -> bool {
    one.cross(other).norm() <= SQUARE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_fasteners_are_known_and_pins_are_none() {
        for name in [
            "bolt",
            "Bolt (2)",
            "M5x20 bolt",
            "HexBolt",
            "hex_nut_M5",
            "washers",
            "Socket Head Cap Screw",
            "DIN 912 - M6x20",
            "ISO4762_M5",
            "DIN EN ISO 4762",
            "din933-m8",
        ] {
            assert!(is_fastener(name), "{name}: {:?}", words_of(name));
        }
        for name in [
            "pin",
            "dowel pin ISO 8734",
            "DIN 7",
            "lead screw",
            "ball_nut",
            "LeadScrew",
            "shoulder bolt",
            "nutcracker arm",
            "donut",
            "coconut",
            "crank",
            "ISO view",
            "912",
            "",
        ] {
            assert!(!is_fastener(name), "{name}: {:?}", words_of(name));
        }
    }
}
