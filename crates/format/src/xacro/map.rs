//! From places of the expanded text to places of the files that it was made of.

use super::{Call, Place, Run, Told, Trouble};
use crate::error::{Fault, FormatError, MOST_FAULTS, lines_and_columns, located};
use crate::words::counted;
use std::collections::HashMap;
use std::ffi::OsStr;
use std::ops::Range;
use std::path::Path;

/// Calls inside calls that a message tells.
const MOST_CALLS: usize = 4;

/// A part of the expanded text and where it comes from.
#[derive(Clone, Debug)]
pub(super) struct Span {
    pub(super) out: Range<usize>,
    pub(super) place: Place,
    pub(super) call: Option<u32>,
    /// Whether it is written there byte for byte.
    pub(super) is_verbatim: bool,
}

/// Where all parts come from.
#[derive(Debug)]
pub(crate) struct Map {
    /// In the order of the expanded text.
    spans: Vec<Span>,
    calls: Vec<Call>,
    /// Names and texts.
    files: Vec<(String, String)>,
    warnings: Vec<(Place, Option<u32>, Told)>,
}

impl Map {
    pub(super) fn new(spans: Vec<Span>, run: &Run<'_>) -> Self {
        Self {
            spans,
            calls: run.calls.clone(),
            files: run.files.texts(),
            warnings: run.warnings.clone(),
        }
    }

    /// Where a part of the expanded text comes from, and the call that made it.
    fn origin(&self, range: &Range<usize>) -> (Place, Option<u32>) {
        let index = self
            .spans
            .partition_point(|span| span.out.start <= range.start);
        let Some(span) = index.checked_sub(1).and_then(|index| self.spans.get(index)) else {
            return (Place::new(0, 0..0), None);
        };
        if !span.is_verbatim || range.start > span.out.end {
            return (span.place, span.call);
        }
        let offset = range.start - span.out.start;
        let start = (span.place.start + offset).min(span.place.end);
        let end = (start + range.len()).min(span.place.end).max(start);
        (Place::new(span.place.file, start..end), span.call)
    }

    /// The faults of the expanded text as an error about the files.
    pub(crate) fn located(&self, faults: Vec<Fault>) -> FormatError {
        let mut faults = faults;
        faults.sort_by_key(|fault| fault.range.start);
        // What is wrong in a macro is wrong in each of its calls: told once.
        let mut told: Vec<(Fault, Place, Option<u32>, usize)> = Vec::new();
        for fault in faults {
            let (place, call) = self.origin(&fault.range);
            let known = told
                .iter()
                .position(|(own, there, ..)| *there == place && own.message == fault.message);
            if let Some(index) = known {
                told[index].3 += 1;
            } else if told.len() < MOST_FAULTS {
                told.push((fault, place, call, 0));
            }
        }
        let mut errors = told.into_iter().map(|(fault, place, call, more)| {
            let mut error = error_at(
                &self.files,
                &self.calls,
                place,
                call,
                fault.message,
                fault.help,
            );
            if more > 0 {
                error.message =
                    format!("{} (and in {})", error.message, counted(more, "other call"));
            }
            error
        });
        let first = errors.next().unwrap_or_else(|| located("", "", Vec::new()));
        FormatError {
            others: errors.collect(),
            ..first
        }
    }

    /// Lines and columns of the main file for parts of the expanded text, with what is to be told beside a note there; and
    /// what the file itself said while it was expanded.
    ///
    /// All at once, in one walk over each file.
    pub(crate) fn notes(&self, offsets: &[usize]) -> (Vec<Noted>, Vec<(Noted, Told)>) {
        let of_text = offsets
            .iter()
            .map(|offset| self.origin(&(*offset..*offset)));
        let of_files = self.warnings.iter().map(|(place, call, _)| (*place, *call));
        let origins: Vec<(Place, Place)> = of_text
            .chain(of_files)
            .map(|(place, call)| (self.in_main_file(place, call), place))
            .collect();
        let mut wanted: Vec<(u32, usize)> = origins
            .iter()
            .flat_map(|(outer, inner)| [(outer.file, outer.start), (inner.file, inner.start)])
            .collect();
        wanted.sort_unstable();
        wanted.dedup();
        let mut places = HashMap::new();
        for group in wanted.chunk_by(|a, b| a.0 == b.0) {
            let text = self
                .files
                .get(group[0].0 as usize)
                .map_or("", |(_, text)| text);
            let starts: Vec<usize> = group.iter().map(|(_, start)| *start).collect();
            places.extend(group.iter().copied().zip(lines_and_columns(text, &starts)));
        }
        let place_of = |place: &Place| {
            places
                .get(&(place.file, place.start))
                .copied()
                .unwrap_or((1, 1))
        };
        let mut noted: Vec<Noted> = origins
            .iter()
            .map(|(outer, inner)| {
                let (line, column) = place_of(outer);
                let name = self
                    .files
                    .get(inner.file as usize)
                    .filter(|_| inner.file != 0);
                let beside = name.map_or_else(String::new, |(name, _)| {
                    let (line, column) = place_of(inner);
                    format!(" (at {name}:{line}:{column})")
                });
                Noted {
                    line,
                    column,
                    beside,
                }
            })
            .collect();
        let own = noted.split_off(offsets.len());
        let said = self.warnings.iter().map(|(.., told)| told.clone());
        (noted, own.into_iter().zip(said).collect())
    }

    /// Where in the main file its reader finds the cause: the outermost call, for what stands in another file.
    fn in_main_file(&self, place: Place, call: Option<u32>) -> Place {
        let mut outer = place;
        let mut next = call;
        while outer.file != 0
            && let Some(call) = next.and_then(|call| self.calls.get(call as usize))
        {
            outer = call.place;
            next = call.parent;
        }
        if outer.file == 0 {
            outer
        } else {
            Place::new(0, 0..0)
        }
    }
}

/// Where a note stands in the main file.
pub(crate) struct Noted {
    pub(crate) line: usize,
    pub(crate) column: usize,
    /// The place in another file that it is about.
    pub(crate) beside: String,
}

/// A trouble of an expansion as an error about its file.
pub(super) fn located_trouble(run: &Run<'_>, trouble: Trouble) -> FormatError {
    let place = trouble.place.unwrap_or(Place::new(0, 0..0));
    error_at(
        &run.files.texts(),
        &run.calls,
        place,
        trouble.call,
        trouble.message,
        trouble.help,
    )
}

fn error_at(
    files: &[(String, String)],
    calls: &[Call],
    place: Place,
    call: Option<u32>,
    message: String,
    help: Option<String>,
) -> FormatError {
    let nothing = (String::new(), String::new());
    let (name, text) = files.get(place.file as usize).unwrap_or(&nothing);
    let mut message = message;
    let mut next = call;
    for _ in 0..MOST_CALLS {
        let Some(call) = next.and_then(|call| calls.get(call as usize)) else {
            break;
        };
        let (file, text) = files.get(call.place.file as usize).unwrap_or(&nothing);
        let (line, column) = line_and_column(text, call.place.start);
        // The whole path is in the way where the error itself tells one.
        let file = Path::new(file)
            .file_name()
            .map_or(file.into(), OsStr::to_string_lossy);
        message = format!(
            "{message}; in macro `{}`, called at {file}:{line}:{column}",
            call.name
        );
        next = call.parent;
    }
    let fault = Fault::new(place.start..place.end, message).maybe_help(help);
    located(name, text, vec![fault])
}

fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    lines_and_columns(text, &[offset])
        .first()
        .copied()
        .unwrap_or((1, 1))
}
