//! Which files to check, and what is known of them.

use super::Place;
use crate::cli::failure::Failure;
use crate::cli::files::cannot_read;
use kutzbach::mechanism::Expectation;
use kutzbach::report::ExpectedFile;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The name of the file that holds what is known of a folder.
pub(super) const EXPECTED: &str = "expected.json";

/// The `expected.json` of every folder that holds a file to check.
#[derive(Debug, Default)]
pub struct Known {
    folders: BTreeMap<PathBuf, (ExpectedFile, String)>,
}

impl Known {
    /// Reads them.
    ///
    /// # Errors
    /// Where one exists but cannot be read or is malformed.
    pub fn beside(files: &[PathBuf]) -> Result<Self, Failure> {
        let mut known = Self::default();
        let folders: BTreeSet<PathBuf> = files.iter().map(|file| folder(file)).collect();
        for folder in folders {
            let path = folder.join(EXPECTED);
            if !path.exists() {
                continue;
            }
            let text =
                std::fs::read_to_string(&path).map_err(|error| cannot_read(&path, &error))?;
            let expected = ExpectedFile::parse(&text).map_err(|error| Failure::Plain {
                message: format!(
                    "{}:{}:{}: {}",
                    path.display(),
                    error.line,
                    error.column,
                    error.message
                ),
                help: Some(
                    "one entry per file without its extension, with fields such as \"finite\": 1"
                        .to_owned(),
                ),
            })?;
            known.folders.insert(folder, (expected, text));
        }
        Ok(known)
    }

    /// What the folder's file says of one mechanism file, and where.
    pub fn of(&self, file: &Path) -> Option<(Expectation, Place)> {
        let stem = file.file_stem()?.to_str()?;
        let folder = folder(file);
        let (expected, text) = self.folders.get(&folder)?;
        let place = Place {
            file: folder.join(EXPECTED).display().to_string(),
            line: line_of_entry(text, stem),
        };
        Some((expected.expectation(stem)?, place))
    }

    /// Entries that say nothing: fields that nobody knows, and, where the whole folder is checked, files that are not there.
    pub fn notes(&self, files: &[PathBuf], paths: &[PathBuf]) -> Vec<String> {
        let mut notes = Vec::new();
        for (folder, (expected, _)) in &self.folders {
            let path = folder.join(EXPECTED);
            for field in expected.unknown_fields() {
                notes.push(format!("{}: nothing reads `{field}`", path.display()));
            }
            if !paths.contains(folder) {
                continue;
            }
            let stems: BTreeSet<&str> = files
                .iter()
                .filter(|file| self::folder(file) == *folder)
                .filter_map(|file| file.file_stem()?.to_str())
                .collect();
            for stem in expected.stems().filter(|stem| !stems.contains(stem)) {
                notes.push(format!("{}: there is no file `{stem}`", path.display()));
            }
        }
        notes
    }
}

pub(super) fn folder(file: &Path) -> PathBuf {
    file.parent().map_or_else(PathBuf::new, Path::to_owned)
}

/// The line, counted from 1, on which an entry of a JSON object begins; 1 where there is none.
fn line_of_entry(text: &str, name: &str) -> usize {
    let (mut depth, mut line) = (0_usize, 1);
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let mut length = c.len_utf8();
        match c {
            '"' => {
                length = string_length(rest);
                let is_key = rest[length..].trim_start().starts_with(':');
                let is_it =
                    || serde_json::from_str::<String>(&rest[..length]).is_ok_and(|s| s == name);
                if depth == 1 && is_key && is_it() {
                    return line;
                }
            }
            '{' | '[' => depth += 1,
            '}' | ']' => depth = depth.saturating_sub(1),
            '\n' => line += 1,
            _ => {}
        }
        rest = &rest[length..];
    }
    1
}

/// The length in bytes of the JSON string that a text begins with, quotes included.
fn string_length(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return at + 1,
            _ => {}
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::line_of_entry;

    #[test]
    fn entries_are_found_at_their_own_depth() {
        let text = "{\n  \"a\": {\"b\": 1,\n    \"c\": \"\\\"b\\\": {\"},\n  \"b\" : {},\n  \"\\u0063\": {}\n}";
        for (name, line) in [("a", 2), ("b", 4), ("c", 5), ("d", 1)] {
            assert_eq!(line_of_entry(text, name), line, "{name}");
        }
    }
}
