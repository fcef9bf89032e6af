//! Naming the known name that a mistyped one is nearest to.

use strsim::levenshtein;

/// Names that are looked at: a message costs no more than a short moment, however large the mechanism.
const MOST_NAMES: usize = 1000;

/// Letters of a word that are looked at.
const MOST_LETTERS: usize = 64;

/// A hint for a name that is not known: the nearest one by edit distance, if any is near.
pub(super) fn did_you_mean<'a>(name: &str, known: impl Iterator<Item = &'a String>) -> String {
    let best = known
        .take(MOST_NAMES)
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .min();
    match best {
        // Half of the letters wrong is another word.
        Some((distance, candidate)) if distance * 2 <= name.len().max(2) => {
            format!("did you mean `{candidate}`?")
        }
        _ => "names are compared letter by letter, capitals included".to_owned(),
    }
}

/// Levenshtein distance of the first letters.
fn edit_distance(a: &str, b: &str) -> usize {
    let start = |word: &str| -> String { word.chars().take(MOST_LETTERS).collect() };
    levenshtein(&start(a), &start(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hint(name: &str, known: &[&str]) -> String {
        let known: Vec<String> = known.iter().map(|k| (*k).to_owned()).collect();
        did_you_mean(name, known.iter())
    }

    #[test]
    fn distances_of_words() {
        for (a, b, distance) in [
            ("", "", 0),
            ("", "abc", 3),
            ("crank", "crank", 0),
            ("crnak", "crank", 2),
            ("kitten", "sitting", 3),
            ("größe", "grosse", 3),
        ] {
            assert_eq!(edit_distance(a, b), distance, "{a} {b}");
            assert_eq!(edit_distance(b, a), distance, "{b} {a}");
        }
        let long = "a".repeat(10_000);
        assert_eq!(edit_distance(&long, "b"), MOST_LETTERS);
    }

    #[test]
    fn the_nearest_name_is_offered_where_it_is_near() {
        assert_eq!(hint("crnk", &["ground", "crank"]), "did you mean `crank`?");
        // A tie goes to the first in alphabetical order, whatever the order of the names.
        assert_eq!(hint("arm_3", &["arm_2", "arm_1"]), "did you mean `arm_1`?");
        let none = "names are compared letter by letter, capitals included";
        assert_eq!(hint("gear", &["ground", "crank"]), none);
        assert_eq!(hint("GROUND", &["ground"]), none);
        assert_eq!(hint("x", &[]), none);
    }
}
