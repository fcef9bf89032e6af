//! Where rows go: standard output, or a file that is continued.

use crate::cli::failure::Failure;
use kutzbach::sweep::{Shard, Table};
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, BufWriter, Error, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What a computer that goes down costs at most.
const KEPT_EVERY: Duration = Duration::from_secs(1);

/// What rows are written to.
pub struct Sink {
    out: BufWriter<Box<dyn Write>>,
    file: Option<PathBuf>,
    rows: u64,
    kept: Instant,
}

impl Sink {
    /// Standard output, or a file: a new one, or one with rows of the same sweep, of which the complete ones stay.
    ///
    /// # Errors
    /// Where the file holds anything else, or cannot be read or written.
    pub fn open(
        path: Option<&Path>,
        table: &Table,
        shard: Shard,
        count: u64,
    ) -> Result<Self, Failure> {
        let (out, rows): (Box<dyn Write>, Option<u64>) = match path {
            None => (Box::new(std::io::stdout()), None),
            Some(path) => {
                let (file, rows) = opened(path, table, shard, count)
                    .map_err(|error| cannot_write(Some(path), &error))?;
                match rows {
                    Found::Other => return Err(another(path)),
                    Found::Nothing => (Box::new(file), None),
                    Found::Rows { rows, .. } => (Box::new(file), Some(rows)),
                }
            }
        };
        let mut sink = Self {
            out: BufWriter::new(out),
            file: path.map(Path::to_owned),
            rows: rows.unwrap_or(0),
            kept: Instant::now(),
        };
        if rows.is_none() {
            sink.write(&table.head())?;
        }
        Ok(sink)
    }

    /// How many rows there are.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Adds a row.
    ///
    /// # Errors
    /// What the system says.
    pub fn put(&mut self, line: &str) -> Result<(), Failure> {
        self.write(line)?;
        self.rows += 1;
        self.keep()
    }

    /// Hands over what has been waiting for long.
    ///
    /// # Errors
    /// What the system says.
    pub fn keep(&mut self) -> Result<(), Failure> {
        if self.kept.elapsed() < KEPT_EVERY {
            return Ok(());
        }
        self.kept = Instant::now();
        self.flush()
    }

    /// Hands over all rows.
    ///
    /// # Errors
    /// What the system says.
    pub fn flush(&mut self) -> Result<(), Failure> {
        self.out
            .flush()
            .map_err(|error| cannot_write(self.file.as_deref(), &error))
    }

    fn write(&mut self, text: &str) -> Result<(), Failure> {
        self.out
            .write_all(text.as_bytes())
            .map_err(|error| cannot_write(self.file.as_deref(), &error))
    }
}

/// What a file holds already.
enum Found {
    /// Nothing, or part of a first line: it begins anew.
    Nothing,
    /// So many complete rows of this sweep, which end after so many bytes.
    Rows { rows: u64, bytes: u64 },
    /// Something else.
    Other,
}

/// Opens a file behind its last complete row.
fn opened(path: &Path, table: &Table, shard: Shard, count: u64) -> Result<(File, Found), Error> {
    // Devices and pipes are written to as they are.
    if std::fs::metadata(path).is_ok_and(|known| !known.is_file()) {
        let file = OpenOptions::new().write(true).open(path)?;
        return Ok((file, Found::Nothing));
    }
    let mut file = OpenOptions::new()
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .open(path)?;
    let found = found(&file, table, shard, count)?;
    let end = match found {
        Found::Nothing => Some(0),
        Found::Rows { bytes, .. } => Some(bytes),
        Found::Other => None,
    };
    if let Some(end) = end {
        file.set_len(end)?;
        file.seek(SeekFrom::Start(end))?;
    }
    Ok((file, found))
}

/// Reads a file up to its last complete row.
fn found(file: &File, table: &Table, shard: Shard, count: u64) -> Result<Found, Error> {
    let head = table.head();
    let mut reader = BufReader::new(file);
    let mut first = Vec::new();
    reader
        .by_ref()
        .take(head.len() as u64)
        .read_to_end(&mut first)?;
    if first.as_slice() != head.as_bytes() {
        return Ok(match head.as_bytes().starts_with(&first) {
            true => Found::Nothing,
            false => Found::Other,
        });
    }
    let (mut bytes, mut rows, mut line) = (head.len() as u64, 0, Vec::new());
    while rows < count {
        line.clear();
        let length = reader.read_until(b'\n', &mut line)?;
        let start = table.start(shard.index(rows));
        if !line.ends_with(b"\n") || !line.starts_with(start.as_bytes()) {
            break;
        }
        bytes += length as u64;
        rows += 1;
    }
    Ok(Found::Rows { rows, bytes })
}

fn another(path: &Path) -> Failure {
    Failure::Plain {
        message: format!("`{}` holds something else than rows of this sweep", path.display()),
        help: Some(
            "name another file, or remove this one; a sweep goes on where the file, the ranges, the share and the depth are the same"
                .to_owned(),
        ),
    }
}

fn cannot_write(path: Option<&Path>, error: &Error) -> Failure {
    match path {
        None if error.kind() == ErrorKind::BrokenPipe => Failure::ReaderGone,
        None => Failure::Plain {
            message: format!("cannot write to standard output: {error}"),
            help: None,
        },
        Some(path) => Failure::Plain {
            message: format!("cannot write `{}`: {error}", path.display()),
            help: Some("rows that it has are kept: the same command goes on".to_owned()),
        },
    }
}
