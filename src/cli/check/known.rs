//! Which files to check, and what is known of them.

use crate::cli::failure::Failure;
use kutzbach::mechanism::Expectation;
use kutzbach::report::ExpectedFile;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The name of the file that holds what is known of a folder.
const EXPECTED: &str = "expected.json";

/// Extensions of mechanism files in a folder.
const EXTENSIONS: [&str; 1] = ["urdf"];

/// Folders in folders are followed this deep, which ends circles of links too.
const DEEPEST: usize = 16;

/// Files named, and mechanism files of folders named, each once, by path.
///
/// # Errors
/// Where a path does not exist or a folder cannot be read; where there is no file at all.
pub fn mechanism_files(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut files = BTreeSet::new();
    for path in paths {
        if path.is_dir() {
            collect(path, DEEPEST, &mut files).map_err(|error| cannot_read(path, &error))?;
        } else if path.exists() {
            files.insert(path.clone());
        } else {
            return Err(Failure::Plain {
                message: format!("there is no file or folder `{}`", path.display()),
                help: None,
            });
        }
    }
    if files.is_empty() {
        return Err(Failure::Plain {
            message: "there is no mechanism file to check".to_owned(),
            help: Some("folders are searched for files that end in `.urdf`".to_owned()),
        });
    }
    Ok(files.into_iter().collect())
}

fn collect(
    folder: &Path,
    depth: usize,
    files: &mut BTreeSet<PathBuf>,
) -> Result<(), std::io::Error> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            if depth > 0 {
                collect(&path, depth - 1, files)?;
            }
        } else if path
            .extension()
            .is_some_and(|own| EXTENSIONS.iter().any(|known| own == *known))
        {
            files.insert(path);
        }
    }
    Ok(())
}

fn cannot_read(path: &Path, error: &std::io::Error) -> Failure {
    Failure::Plain {
        message: format!("cannot read `{}`: {error}", path.display()),
        help: None,
    }
}

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

fn folder(file: &Path) -> PathBuf {
    file.parent().map_or_else(PathBuf::new, Path::to_owned)
}
