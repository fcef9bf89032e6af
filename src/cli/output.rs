//! Where results go: standard output, or a file that is either complete or untouched.

use super::failure::Failure;
use clap::Args;
use std::fs::{self, File, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Where the answer goes.
#[derive(Clone, Debug, Args)]
pub struct Destination {
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Destination {
    /// The file, where one was named.
    #[must_use]
    pub fn file(&self) -> Option<&Path> {
        named(self.output.as_deref())
    }

    /// Writes the answer there.
    ///
    /// # Errors
    /// As [`put`].
    pub fn put(&self, text: &str) -> Result<(), Failure> {
        put(text, self.file())
    }
}

/// The file of that name; none for `-`, which is standard output as it is standard input.
#[must_use]
pub fn named(file: Option<&Path>) -> Option<&Path> {
    file.filter(|file| *file != Path::new("-"))
}

/// Writes a text to the file, or to standard output where there is none.
///
/// # Errors
/// [`Failure::ReaderGone`] where the reader of standard output has closed it; otherwise what the system says.
pub fn put(text: &str, file: Option<&Path>) -> Result<(), Failure> {
    match file {
        Some(file) => write_file(file, text.as_bytes()).map_err(|error| Failure::Plain {
            message: format!("cannot write `{}`: {error}", file.display()),
            help: None,
        }),
        None => {
            let mut out = std::io::stdout().lock();
            out.write_all(text.as_bytes())
                .and_then(|()| out.flush())
                .map_err(|error| match error.kind() {
                    ErrorKind::BrokenPipe => Failure::ReaderGone,
                    _ => Failure::Plain {
                        message: format!("cannot write to standard output: {error}"),
                        help: None,
                    },
                })
        }
    }
}

/// Writes beside the file first and renames, so that nobody ever reads half of it. Devices and pipes are written to as
/// they are.
fn write_file(file: &Path, bytes: &[u8]) -> std::io::Result<()> {
    // A link stays a link: what it points to is replaced.
    let target = fs::canonicalize(file).unwrap_or_else(|_| file.to_owned());
    let existing = fs::metadata(&target).ok();
    if existing.as_ref().is_some_and(|known| !known.is_file()) {
        return OpenOptions::new()
            .write(true)
            .open(&target)?
            .write_all(bytes);
    }
    let (beside, mut draft) = create_beside(&target)?;
    let written = draft
        .write_all(bytes)
        .and_then(|()| draft.sync_all())
        .and_then(|()| match &existing {
            Some(known) => fs::set_permissions(&beside, known.permissions()),
            None => Ok(()),
        })
        .and_then(|()| fs::rename(&beside, &target));
    if written.is_err() {
        // The first error is the one to tell.
        let _ = fs::remove_file(&beside);
    }
    written
}

/// A new file in the same folder; another one is tried where the name is taken.
fn create_beside(target: &Path) -> std::io::Result<(PathBuf, File)> {
    let name = target
        .file_name()
        .ok_or_else(|| std::io::Error::new(ErrorKind::InvalidInput, "this does not name a file"))?;
    let mut attempt = 0;
    loop {
        let mut draft = std::ffi::OsString::from(".");
        draft.push(name);
        draft.push(format!(".{}-{attempt}.part", std::process::id()));
        let path = target.with_file_name(draft);
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(file) => return Ok((path, file)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists && attempt < 100 => attempt += 1,
            Err(error) => return Err(error),
        }
    }
}

/// A value as indented JSON, ending in a line break.
///
/// # Errors
/// Where a value has no JSON form, which would be a fault of this program.
pub fn json(value: &impl serde::Serialize) -> Result<String, Failure> {
    match serde_json::to_string_pretty(value) {
        Ok(mut text) => {
            text.push('\n');
            Ok(text)
        }
        Err(error) => Err(Failure::Plain {
            message: format!("cannot be written as JSON: {error}"),
            help: None,
        }),
    }
}
