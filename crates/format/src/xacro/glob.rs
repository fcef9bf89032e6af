//! Files whose names fit a pattern: `*`, `?` and `[abc]`, each within one name.

use super::Outcome;
use super::budget::Budget;
use std::path::{Component, Path, PathBuf};

/// All existing paths that fit, sorted.
pub(super) fn matching(pattern: &Path, budget: &mut Budget) -> Outcome<Vec<PathBuf>> {
    let mut found = vec![PathBuf::new()];
    for component in pattern.components() {
        let name = component.as_os_str().to_string_lossy().into_owned();
        if !matches!(component, Component::Normal(_)) || !name.contains(['*', '?', '[']) {
            found.iter_mut().for_each(|path| path.push(component));
            continue;
        }
        let wanted: Vec<char> = name.chars().collect();
        let mut next = Vec::new();
        for folder in &found {
            let folder_read = match folder.as_os_str().is_empty() {
                true => Path::new("."),
                false => folder,
            };
            let Ok(entries) = std::fs::read_dir(folder_read) else {
                continue;
            };
            for entry in entries.flatten() {
                budget.spend(1)?;
                let own = entry.file_name().to_string_lossy().into_owned();
                let hidden = own.starts_with('.') && !name.starts_with('.');
                if !hidden && fits(&wanted, &own.chars().collect::<Vec<_>>()) {
                    next.push(folder.join(entry.file_name()));
                }
            }
        }
        found = next;
    }
    found.retain(|path| path.exists());
    found.sort_unstable();
    Ok(found)
}

/// Whether a name fits a pattern: one pass, going back to the last `*` where it does not fit.
fn fits(pattern: &[char], name: &[char]) -> bool {
    let (mut p, mut n) = (0, 0);
    let mut back = None;
    while n < name.len() {
        if pattern.get(p) == Some(&'*') {
            back = Some((p + 1, n));
            p += 1;
            continue;
        }
        let one = pattern.get(p..).and_then(|rest| one_fits(rest, name[n]));
        match (one, back) {
            (Some(length), _) => {
                p += length;
                n += 1;
            }
            (None, Some((after, from))) => {
                back = Some((after, from + 1));
                (p, n) = (after, from + 1);
            }
            (None, None) => return false,
        }
    }
    pattern
        .get(p..)
        .is_some_and(|rest| rest.iter().all(|c| *c == '*'))
}

/// How much of a pattern a character fits.
fn one_fits(pattern: &[char], c: char) -> Option<usize> {
    match pattern {
        ['?', ..] => Some(1),
        ['[', rest @ ..] => {
            let end = rest.iter().skip(1).position(|c| *c == ']')? + 1;
            let (set, length) = (&rest[..end], end + 2);
            let (inverted, set) = match set {
                ['!', set @ ..] => (true, set),
                set => (false, set),
            };
            let mut inside = false;
            let mut at = 0;
            while at < set.len() {
                if let [low, '-', high, ..] = set[at..] {
                    inside |= (low..=high).contains(&c);
                    at += 3;
                } else {
                    inside |= set[at] == c;
                    at += 1;
                }
            }
            (inside != inverted).then_some(length)
        }
        [own, ..] => (*own == c).then_some(1),
        [] => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fit_patterns() {
        let check = |pattern: &str, name: &str| {
            fits(
                &pattern.chars().collect::<Vec<_>>(),
                &name.chars().collect::<Vec<_>>(),
            )
        };
        for (pattern, name) in [
            ("*.xacro", "a.xacro"),
            ("a*b*c", "aXbYbZc"),
            ("?[a-c]*", "xb"),
            ("[!a]", "b"),
            ("*", ""),
        ] {
            assert!(check(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in [("*.xacro", "a.urdf"), ("a", "ab"), ("[a", "a"), ("?", "")] {
            assert!(!check(pattern, name), "{pattern} {name}");
        }
    }
}
