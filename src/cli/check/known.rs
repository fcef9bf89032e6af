//! Which files to check, and what is known of them.

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
    folders: BTreeMap<PathBuf, ExpectedFile>,
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
            known.folders.insert(folder, expected);
        }
        Ok(known)
    }

    /// What the folder's file says of one mechanism file.
    pub fn of(&self, file: &Path) -> Option<Expectation> {
        let stem = file.file_stem()?.to_str()?;
        self.folders.get(&folder(file))?.expectation(stem)
    }

    /// Entries that say nothing: fields that nobody knows, and, where the whole folder is checked, files that are not there.
    pub fn notes(&self, files: &[PathBuf], paths: &[PathBuf]) -> Vec<String> {
        let mut notes = Vec::new();
        for (folder, expected) in &self.folders {
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
