//! `<include file>`: the elements of another file in its place, before anything is read.
//!
//! MuJoCo looks for files beside the main one; one that is not there is looked for beside the file that names it. A file can be included
//! once.

use super::attach::attached;
use super::replicate::replicated;
use crate::error::{Fault, FormatError, Outcome, lines_and_columns, located};
use crate::words::quoted;
use crate::{guard, xml};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Files inside files, at most.
const DEEPEST: usize = 30;

/// A file as it was read.
struct Source {
    name: String,
    path: Option<PathBuf>,
    text: String,
    /// The inclusions in their order, where each stands and the file that it names; `None` before they are looked for.
    includes: Option<Vec<(Range<usize>, String)>>,
}

/// A stretch of the whole text.
pub(super) struct Piece {
    /// Where it starts in the whole text.
    start: usize,
    /// Which file it is from, and where it starts there.
    source: usize,
    offset: usize,
    /// Where the main file includes it.
    at: usize,
}

/// A text with everything that it includes, and where each part is from.
pub(crate) struct Whole {
    pub(crate) text: String,
    sources: Vec<Source>,
    pieces: Vec<Piece>,
}

/// A text that is still to be taken in.
struct Part {
    source: usize,
    range: Range<usize>,
    at: Option<usize>,
    depth: usize,
}

/// The text with what it includes and attaches, and with the copies that replicates make.
///
/// # Errors
/// A file that cannot be read, is no XML, or is included twice, models that cannot be attached, and copies that cannot be made.
pub(crate) fn whole(text: &str, file: &str, base: Option<&Path>) -> Result<Whole, FormatError> {
    expanded(text, file, base, 0)
}

/// The same of a text that is attached to others, one to the other.
pub(super) fn expanded(
    text: &str,
    file: &str,
    base: Option<&Path>,
    depth: usize,
) -> Result<Whole, FormatError> {
    if depth >= DEEPEST {
        let message = format!("more than {DEEPEST} models are attached one to another");
        return Err(located(file, text, vec![Fault::new(0..0, message)]));
    }
    let mut whole = Whole {
        text: String::new(),
        sources: vec![Source {
            name: file.to_owned(),
            path: base.map(Path::to_path_buf),
            text: text.to_owned(),
            includes: None,
        }],
        pieces: Vec::new(),
    };
    let mut open = vec![Part {
        source: 0,
        range: 0..text.len(),
        at: None,
        depth: 0,
    }];
    while let Some(part) = open.pop() {
        if let Err((source, fault)) = whole.take(&part, &mut open) {
            let Source { name, text, .. } = &whole.sources[source];
            return Err(located(name, text, vec![fault]));
        }
    }
    replicated(attached(whole, depth)?)
}

impl Piece {
    /// The same, asked for at a place of the main file.
    pub(super) fn asked_for_at(self, at: usize) -> Self {
        Self { at, ..self }
    }

    /// The same, so much later in the whole text.
    pub(super) fn moved(self, by: usize) -> Self {
        Self {
            start: self.start + by,
            ..self
        }
    }
}

impl Whole {
    /// Takes a part up to its first inclusion; what is included and the rest are left open.
    fn take(&mut self, part: &Part, open: &mut Vec<Part>) -> Result<(), (usize, Fault)> {
        let here = part.source;
        if self.sources[here].includes.is_none() {
            let found = self.includes(here).map_err(|fault| (here, fault))?;
            self.sources[here].includes = Some(found);
        }
        let includes = self.sources[here].includes.as_deref().unwrap_or_default();
        let first = includes.partition_point(|(range, _)| range.start < part.range.start);
        let next = includes.get(first).cloned();
        let next = next.filter(|(range, _)| range.end <= part.range.end);
        let end = next
            .as_ref()
            .map_or(part.range.end, |(range, _)| range.start);
        self.add(part, part.range.start..end);
        let Some((range, named)) = next else {
            return Ok(());
        };
        open.push(Part {
            range: range.end..part.range.end,
            ..*part
        });
        let at = part.at.unwrap_or(range.start);
        let failed = |message: String| (here, Fault::new(range.clone(), message));
        if part.depth >= DEEPEST {
            return Err(failed(format!(
                "more than {DEEPEST} files are included one inside another"
            )));
        }
        let source = self.open(here, &named).map_err(failed)?;
        let inner = inner(&self.sources[source].text).map_err(|fault| (source, fault))?;
        open.push(Part {
            source,
            range: inner,
            at: Some(at),
            depth: part.depth + 1,
        });
        Ok(())
    }

    /// The inclusions of a file in their order: where each stands, and the file that it names.
    fn includes(&self, source: usize) -> Outcome<Vec<(Range<usize>, String)>> {
        let text = &self.sources[source].text;
        if !text.contains("<include") {
            return Ok(Vec::new());
        }
        let document = xml::parse(text)?;
        let all = document
            .descendants()
            .filter(|node| node.has_tag_name("include"));
        all.map(|node| match node.attribute("file") {
            Some(file) => Ok((node.range(), file.to_owned())),
            None => Err(Fault::new(
                node.range(),
                "<include> needs the attribute `file`",
            )),
        })
        .collect()
    }

    fn add(&mut self, part: &Part, range: Range<usize>) {
        self.pieces.push(Piece {
            start: self.text.len(),
            source: part.source,
            offset: range.start,
            at: part.at.unwrap_or(range.start),
        });
        let text = self.sources[part.source]
            .text
            .get(range)
            .unwrap_or_default();
        self.text.push_str(text);
    }

    /// The path of a file that another one names.
    fn path(&self, by: usize, named: &str) -> Result<PathBuf, String> {
        let folders = [&self.sources[0], &self.sources[by]];
        let folders = folders
            .iter()
            .filter_map(|source| source.path.as_deref()?.parent());
        let mut tried: Vec<PathBuf> = folders.map(|folder| folder.join(named)).collect();
        tried.dedup();
        let path = tried.iter().find(|path| path.is_file()).or(tried.first());
        path.cloned()
            .ok_or_else(|| format!("{} is included by a text that has no folder", quoted(named)))
    }

    /// The text of a file that another one names.
    fn text_at(&self, path: &Path, named: &str) -> Result<String, String> {
        let told = |message: String| format!("{}: {message}", quoted(named));
        let bytes = crate::bytes_of(path).map_err(|fault| told(fault.message))?;
        let text = guard::text_of(&bytes).map_err(|(_, fault)| told(fault.message))?;
        let size: usize = self.sources.iter().map(|known| known.text.len()).sum();
        match guard::size_fault((size + text.len()) as u64) {
            Some(fault) => Err(fault.message),
            None => Ok(text.to_owned()),
        }
    }

    /// The path and the text of a model that is named at a place.
    pub(super) fn model(&self, at: usize, named: &str) -> Result<(PathBuf, String), String> {
        let by = self.piece(at).map_or(0, |piece| piece.source);
        let path = self.path(by, named)?;
        let text = self.text_at(&path, named)?;
        Ok((path, text))
    }

    /// Takes the files of another text in; its pieces are of these files then.
    pub(super) fn adopt(&mut self, other: &mut Self) {
        let known = self.sources.len();
        for piece in &mut other.pieces {
            piece.source += known;
        }
        self.sources.append(&mut other.sources);
    }

    /// Reads a file that another one includes.
    fn open(&mut self, by: usize, named: &str) -> Result<usize, String> {
        let path = self.path(by, named)?;
        if self
            .sources
            .iter()
            .any(|known| known.path.as_ref() == Some(&path))
        {
            return Err(format!(
                "{} is included twice, which MuJoCo refuses",
                quoted(named)
            ));
        }
        let text = self.text_at(&path, named)?;
        self.sources.push(Source {
            name: path.display().to_string(),
            path: Some(path),
            text,
            includes: None,
        });
        Ok(self.sources.len() - 1)
    }

    /// The text of the main file.
    pub(crate) fn main(&self) -> &str {
        self.sources.first().map_or("", |main| &main.text)
    }

    /// The same files with another text made of theirs.
    pub(super) fn rewritten(self, text: String, pieces: Vec<Piece>) -> Self {
        Self {
            text,
            pieces,
            sources: self.sources,
        }
    }

    /// Where the stretch after the one at a place begins.
    pub(super) fn next_piece(&self, at: usize) -> Option<usize> {
        let after = self.pieces.partition_point(|piece| piece.start <= at);
        Some(self.pieces.get(after)?.start)
    }

    /// A stretch of another text that starts there and is from this place.
    pub(super) fn piece_of(&self, at: usize, start: usize) -> Option<Piece> {
        let piece = self.piece(at)?;
        Some(Piece {
            start,
            source: piece.source,
            offset: piece.offset + (at - piece.start),
            at: piece.at,
        })
    }

    fn piece(&self, at: usize) -> Option<&Piece> {
        let after = self.pieces.partition_point(|piece| piece.start <= at);
        self.pieces.get(after.checked_sub(1)?)
    }

    /// Where something of the whole text is in the main file, and which file and line it is from where that is another one.
    pub(crate) fn place(&self, at: usize) -> (usize, String) {
        let Some(piece) = self.piece(at) else {
            return (at, String::new());
        };
        let offset = piece.offset + (at - piece.start);
        if piece.source == 0 {
            return (offset, String::new());
        }
        let source = &self.sources[piece.source];
        let lines = lines_and_columns(&source.text, &[offset]);
        let line = lines.first().map_or(1, |(line, _)| *line);
        let name = source.path.as_deref().and_then(Path::file_name);
        let name = name.map_or_else(
            || source.name.clone(),
            |name| name.to_string_lossy().into_owned(),
        );
        (piece.at, format!(" (in {name}, line {line})"))
    }

    /// Faults of the whole text, in the file where the first one is.
    pub(crate) fn located(&self, mut faults: Vec<Fault>) -> FormatError {
        faults.sort_by_key(|fault| fault.range.start);
        let first = faults.first().map_or(0, |fault| fault.range.start);
        let source = self.piece(first).map_or(0, |piece| piece.source);
        let of_source = faults.into_iter().filter_map(|fault| {
            let piece = self
                .piece(fault.range.start)
                .filter(|piece| piece.source == source)?;
            let length = fault.range.len();
            let start = piece.offset + (fault.range.start - piece.start);
            Some(Fault {
                range: start..start + length,
                ..fault
            })
        });
        let of_source = of_source.collect();
        let Source { name, text, .. } = &self.sources[source];
        located(name, text, of_source)
    }
}

/// What is inside the root element of a text.
fn inner(text: &str) -> Outcome<Range<usize>> {
    let document = xml::parse(text)?;
    let root = document.root_element();
    let first = root.first_child().map(|node| node.range().start);
    let last = root.last_child().map(|node| node.range().end);
    Ok(first.unwrap_or(0)..last.unwrap_or(0))
}
