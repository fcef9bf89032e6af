//! A file that appears when it is complete.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// A log being written: a hidden file `.NAME.….part` beside the one asked for, renamed by [`complete`](Self::complete).
///
/// Dropped before that, it leaves nothing behind. A process that is killed leaves the part file, readable up to the last
/// chunk written. Devices and pipes are written to as they are.
#[derive(Debug)]
pub struct LogFile {
    file: BufWriter<File>,
    /// The part file and the name it will bear; `None` for devices.
    part: Option<(PathBuf, PathBuf)>,
}

impl LogFile {
    /// Starts a file. An existing one stays as it is until this one is complete.
    ///
    /// # Errors
    /// What the system says: no such folder, no permission.
    pub fn create(path: &Path) -> io::Result<Self> {
        // A link stays a link: what it points to is replaced.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let existing = fs::metadata(&target).ok();
        if existing.as_ref().is_some_and(|known| !known.is_file()) {
            let device = OpenOptions::new().write(true).open(&target)?;
            return Ok(Self {
                file: BufWriter::new(device),
                part: None,
            });
        }
        let (part, file) = create_beside(&target)?;
        let log = Self {
            file: BufWriter::new(file),
            part: Some((part, target)),
        };
        if let (Some(known), Some((part, _))) = (&existing, &log.part) {
            fs::set_permissions(part, known.permissions())?;
        }
        Ok(log)
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// What the system says; nothing is left behind then.
    pub fn complete(mut self) -> io::Result<()> {
        self.file.flush()?;
        if let Some((part, target)) = &self.part {
            self.file.get_ref().sync_all()?;
            fs::rename(part, target)?;
            self.part = None;
        }
        Ok(())
    }
}

impl Write for LogFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for LogFile {
    fn drop(&mut self) {
        if let Some((part, _)) = &self.part {
            // There is nobody left to tell.
            let _ = fs::remove_file(part);
        }
    }
}

/// A new file in the same folder; another name is tried where one is taken.
fn create_beside(target: &Path) -> io::Result<(PathBuf, File)> {
    let name = target
        .file_name()
        .ok_or_else(|| io::Error::new(ErrorKind::InvalidInput, "this does not name a file"))?;
    let mut attempt = 0;
    loop {
        let mut part = std::ffi::OsString::from(".");
        part.push(name);
        part.push(format!(".{}-{attempt}.part", std::process::id()));
        let path = target.with_file_name(part);
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(file) => return Ok((path, file)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists && attempt < 100 => attempt += 1,
            Err(error) => return Err(error),
        }
    }
}
