//! Where a ROS package is.
//!
//! Looked for in turn: what the caller says; the folders that ROS itself would look in (`ROS_PACKAGE_PATH`,
//! `AMENT_PREFIX_PATH`); and around the file, since published robots lie beside the packages that they need: every folder
//! above the file, and the packages below it, nearest first.

use super::files::folder_of;
use super::{Outcome, Run, files};
use std::collections::VecDeque;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// Folders above a file that are looked at.
pub(super) const HIGHEST: usize = 8;
/// Levels of folders below each of them.
const DEEPEST: usize = 3;
/// Folders that are looked at for one package, each paid for.
const MOST_FOLDERS: usize = 20_000;

impl Run<'_> {
    /// The value of `$(find package)`; where it is not found, its address: a mesh there is of no importance here.
    pub(super) fn package(&mut self, name: &str) -> Outcome<String> {
        Ok(match self.find_package(name)? {
            Some(folder) => folder.to_string_lossy().into_owned(),
            None => format!("package://{name}"),
        })
    }

    pub(super) fn find_package(&mut self, name: &str) -> Outcome<Option<PathBuf>> {
        if name.is_empty() || name.contains(['/', '\\']) || name.starts_with('.') {
            return Ok(None);
        }
        if let Some(known) = self.files.packages.get(name) {
            return Ok(known.clone());
        }
        let mut left = MOST_FOLDERS;
        let found = self.search(name, &mut left);
        self.spend(MOST_FOLDERS - left)?;
        self.files.packages.insert(name.to_owned(), found.clone());
        Ok(found)
    }

    fn search(&self, name: &str, left: &mut usize) -> Option<PathBuf> {
        let given = self
            .options
            .packages
            .iter()
            .rev()
            .find(|(own, _)| own == name);
        if let Some((_, path)) = given {
            return Some(from_here(path));
        }
        for folder in self.folders_of("ROS_PACKAGE_PATH") {
            if let Some(found) = below(&folder, name, DEEPEST, left) {
                return Some(found);
            }
        }
        for prefix in self.folders_of("AMENT_PREFIX_PATH") {
            let share = prefix.join("share").join(name);
            if share.is_dir() {
                return Some(share);
            }
        }
        let main = self.files.get(0).and_then(files::File::path)?;
        let start = std::path::absolute(folder_of(main)).ok()?;
        start.ancestors().take(HIGHEST).find_map(|folder| {
            // The whole disk, or all users' folders, are not searched.
            let levels = DEEPEST.min(folder.ancestors().count() - 1);
            below(folder, name, levels, left).filter(|_| levels > 0)
        })
    }

    fn folders_of(&self, variable: &str) -> Vec<PathBuf> {
        folders_in(&self.variable(variable).unwrap_or_default())
    }

    /// A variable of the environment, where that may be read.
    pub(super) fn variable(&self, name: &str) -> Option<OsString> {
        let readable = !self.options.without_environment;
        readable.then(|| std::env::var_os(name)).flatten()
    }
}

/// A relative path of the user is meant from where the program was started, not from the file that asks for it.
fn from_here(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf())
}

fn folders_in(list: &OsStr) -> Vec<PathBuf> {
    std::env::split_paths(list)
        .filter(|path| !path.as_os_str().is_empty())
        .map(|path| from_here(&path))
        .collect()
}

/// The package in a folder or below it, the highest first.
fn below(folder: &Path, name: &str, levels: usize, left: &mut usize) -> Option<PathBuf> {
    let mut waiting = VecDeque::from([(folder.to_path_buf(), 0)]);
    // A folder of the name that does not say it is a package is taken where none does.
    let mut named = None;
    while let Some((folder, depth)) = waiting.pop_front() {
        *left = left.checked_sub(1)?;
        match declared_name(&folder) {
            Some(own) if own == name => return Some(folder),
            None if named.is_none() && folder.file_name().is_some_and(|own| own == name) => {
                named = Some(folder.clone());
            }
            _ => {}
        }
        if depth >= levels {
            continue;
        }
        let Ok(entries) = std::fs::read_dir(&folder) else {
            continue;
        };
        let mut inner: Vec<PathBuf> = entries
            .flatten()
            .filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()))
            .filter(|entry| !entry.file_name().to_string_lossy().starts_with('.'))
            .map(|entry| entry.path())
            .collect();
        inner.sort_unstable();
        waiting.extend(inner.into_iter().map(|path| (path, depth + 1)));
    }
    named
}

/// The name that `package.xml` of a folder states.
fn declared_name(folder: &Path) -> Option<String> {
    const LARGEST: u64 = 1 << 20;
    let path = folder.join("package.xml");
    let known = std::fs::metadata(&path).ok()?;
    if !known.is_file() || known.len() > LARGEST {
        return None;
    }
    let text = files::read_text(&path).ok()?;
    let start = text.find("<name>")? + "<name>".len();
    let end = text[start..].find("</name>")? + start;
    Some(text[start..end].trim().to_owned())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn relative_folders_are_taken_from_where_the_program_was_started() {
        let here = std::env::current_dir().unwrap();
        let list = std::env::join_paths(["one", "", "./two/three"]).unwrap();
        assert_eq!(
            folders_in(&list),
            [here.join("one"), here.join("two/three")]
        );
    }
}
