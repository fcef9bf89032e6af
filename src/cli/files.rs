//! Many mechanism files: which ones, and something done with each.

use super::failure::Failure;
use super::pool::{Event, in_order};
use std::collections::BTreeSet;
use std::io::{IsTerminal, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Extensions of mechanism files in a folder.
const EXTENSIONS: [&str; 6] = ["urdf", "sdf", "asmt", "FCStd", "step", "stp"];

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
            message: "there is no mechanism file".to_owned(),
            help: Some(
                "folders are searched for files that end in `.urdf`, `.sdf`, `.asmt`, `.FCStd`, `.step` or `.stp`"
                    .to_owned(),
            ),
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

/// A path cannot be read, and what the system says.
pub fn cannot_read(path: &Path, error: &std::io::Error) -> Failure {
    Failure::Plain {
        message: format!("cannot read `{}`: {error}", path.display()),
        help: None,
    }
}

/// Does something with every file, as many at a time as there are processors; results in the order of files.
pub fn each<T: Send>(files: &[PathBuf], work: impl Fn(&Path) -> T + Sync) -> Vec<T> {
    let mut results = Vec::with_capacity(files.len());
    let mut progress = Progress::new(files.len());
    let one = |index: u64| {
        let file = usize::try_from(index).ok().and_then(|at| files.get(at));
        file.map(|file| work(file))
    };
    // Of all that are done before their turn the results are kept: they are not many.
    in_order(files.len() as u64, u64::MAX, one, |done, event| {
        progress.reached(usize::try_from(done).unwrap_or(usize::MAX));
        if let Event::Next(result) = event {
            results.extend(result);
        }
        ControlFlow::Continue(())
    });
    progress.clear();
    results
}

/// A count on standard error for whoever waits longer than a second; none where standard error is no terminal.
struct Progress {
    all: usize,
    done: usize,
    started: Instant,
    shown: Option<Instant>,
    wanted: bool,
}

impl Progress {
    fn new(all: usize) -> Self {
        Self {
            all,
            done: 0,
            started: Instant::now(),
            shown: None,
            wanted: std::io::stderr().is_terminal(),
        }
    }

    fn reached(&mut self, done: usize) {
        self.done = done;
        let due = self
            .shown
            .is_none_or(|last| last.elapsed() > Duration::from_millis(100));
        if self.wanted && due && self.started.elapsed() > Duration::from_secs(1) {
            let _ = write!(std::io::stderr(), "\r{} of {} files", self.done, self.all);
            self.shown = Some(Instant::now());
        }
    }

    fn clear(&self) {
        if self.shown.is_some() {
            let _ = write!(std::io::stderr(), "\r\u{1b}[K");
        }
    }
}
