//! The files that an expansion reads: the main one, and those that it includes.

use super::element::{Element, root_of};
use super::{Outcome, Place, Run, Sort, Trouble};
use crate::error::Fault;
use crate::words::quoted;
use crate::{bytes_of, guard, xml};
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Files of one expansion; a robot has dozens.
const MOST_FILES: usize = 1000;
/// Includes inside includes.
pub(super) const MOST_NESTED: usize = 40;

/// A file that was read.
pub(super) struct File {
    /// As messages name it.
    pub(super) name: String,
    path: Option<PathBuf>,
    pub(super) text: String,
}

impl File {
    pub(super) fn new(name: &str, path: Option<&Path>, text: &str) -> Self {
        Self {
            name: name.to_owned(),
            path: path.map(Path::to_path_buf),
            text: text.to_owned(),
        }
    }

    pub(super) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }
}

#[derive(Default)]
pub(super) struct Files {
    all: Vec<(File, Rc<Element>)>,
    /// Prefixes and their addresses; the first declaration holds.
    prefixes: Vec<(String, String)>,
    bytes: usize,
    numbers: HashMap<PathBuf, u32>,
    /// Packages that were looked for.
    pub(super) packages: BTreeMap<String, Option<PathBuf>>,
}

impl Files {
    /// Parses a file and adds it.
    pub(super) fn add(&mut self, file: File) -> Outcome<u32> {
        self.bytes = self.bytes.saturating_add(file.text.len());
        if self.all.len() >= MOST_FILES || self.bytes as u64 > guard::most_bytes() {
            return Err(Trouble::new(
                "the file includes too many or too large files",
            ));
        }
        let index = self.all.len() as u32;
        if let Some(path) = &file.path {
            self.numbers.insert(path.clone(), index);
        }
        let parsed = xml::parse(&file.text).map(|document| root_of(&document, index));
        match parsed {
            Ok((root, prefixes)) => {
                let is_main = self.all.is_empty();
                for (prefix, address) in prefixes {
                    let known = self.prefixes.iter().any(|(own, _)| *own == prefix);
                    // What has no prefix in an included file belongs to the robot, as everywhere in it.
                    if !known && (is_main || !prefix.is_empty()) {
                        self.prefixes.push((prefix, address));
                    }
                }
                self.all.push((file, root));
                Ok(index)
            }
            Err(Fault {
                range,
                message,
                help,
            }) => {
                let place = Place::new(index, range);
                let nothing = Element {
                    name: "robot".into(),
                    attributes: Vec::new(),
                    children: Vec::new(),
                    place,
                    is_xacro: false,
                    call: None,
                };
                self.all.push((file, Rc::new(nothing)));
                Err(Trouble::new(message).maybe_help(help).at(place, None))
            }
        }
    }

    pub(super) fn root(&self, file: u32) -> Rc<Element> {
        self.all[file as usize].1.clone()
    }

    pub(super) fn roots(&self) -> impl Iterator<Item = &Rc<Element>> {
        self.all.iter().map(|(_, root)| root)
    }

    pub(super) fn get(&self, file: u32) -> Option<&File> {
        self.all.get(file as usize).map(|(file, _)| file)
    }

    pub(super) fn prefixes(&self) -> &[(String, String)] {
        &self.prefixes
    }

    /// Names and texts, in the order of their numbers.
    pub(super) fn texts(&self) -> Vec<(String, String)> {
        let named = self
            .all
            .iter()
            .map(|(file, _)| (file.name.clone(), file.text.clone()));
        named.collect()
    }
}

impl Run<'_> {
    /// Reads a file, once.
    pub(super) fn open(&mut self, path: &Path) -> Outcome<u32> {
        if let Some(known) = self.files.numbers.get(path).copied() {
            return Ok(known);
        }
        let text = self.paid_file(path)?;
        let name = path.display().to_string();
        self.files.add(File::new(&name, Some(path), &text))
    }

    /// The text of a file, paid for before it is read: a file that cannot be read may be asked for again and again.
    pub(super) fn paid_file(&mut self, path: &Path) -> Outcome<String> {
        let bytes = std::fs::metadata(path).map_or(0, |known| known.len());
        self.spend(usize::try_from(bytes / 256).unwrap_or(usize::MAX))?;
        read_text(path)
    }

    /// The folder of the file under evaluation.
    pub(super) fn folder(&self) -> Outcome<PathBuf> {
        let file = self
            .file_stack
            .last()
            .and_then(|file| self.files.get(*file));
        match file.and_then(|file| file.path.as_deref()) {
            Some(path) => Ok(folder_of(path)),
            None => Err(Trouble::new(
                "the text was read without a file, so that it has no folder to look for others in",
            )
            .help("read it from a file")),
        }
    }

    /// The path that a file means: packages are found, the rest is relative to the file under evaluation.
    pub(super) fn resolved(&mut self, written: &str) -> Outcome<PathBuf> {
        if let Some(rest) = written.strip_prefix("package://") {
            let (package, inside) = rest.split_once('/').unwrap_or((rest, ""));
            return match self.find_package(package)? {
                Some(folder) => Ok(folder.join(inside)),
                None => Err(
                    Trouble::new(format!("the package {} is not found", quoted(package)))
                        .help(format!("say where it is: --package {package}=PATH"))
                        .sort(Sort::File),
                ),
            };
        }
        let path = Path::new(written.strip_prefix("file://").unwrap_or(written));
        if path.is_absolute() {
            return Ok(path.to_path_buf());
        }
        Ok(self.folder()?.join(path))
    }
}

/// The folder that a file is in, `.` for a bare name.
pub(super) fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

/// The text of a regular file.
pub(super) fn read_text(path: &Path) -> Outcome<String> {
    let named =
        |message: String| Trouble::new(format!("`{}`: {message}", path.display())).sort(Sort::File);
    let metadata = std::fs::metadata(path);
    if let Ok(known) = &metadata
        && !known.is_file()
    {
        return Err(named("is not a file".to_owned()));
    }
    let bytes = bytes_of(path).map_err(|fault| named(fault.message))?;
    match guard::text_of(&bytes) {
        Ok(text) => Ok(text.to_owned()),
        Err((_, fault)) => Err(named(fault.message)),
    }
}
