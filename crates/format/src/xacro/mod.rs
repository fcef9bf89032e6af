//! xacro: files that are programs which write URDF.
//!
//! Published robots come as macros, includes, conditions and properties. A file that uses more of xacro than named numbers
//! is expanded here to plain URDF before it is read. What the expansion must satisfy:
//!
//! - *It is what ROS makes of the file*: order of evaluation, scopes, lazy properties and the printing of numbers follow
//!   xacro 2 (Open Source Robotics Foundation, <https://github.com/ros/xacro>), which evaluates Python expressions.
//! - *Numbers stay exact.* Each number is calculated twice, as Python does and exactly. Names and conditions follow Python;
//!   attributes that are numbers carry the exact one ([`text`], [`arithmetic`], [`output`]).
//! - *Errors keep their place*: every element and attribute knows the file and the range that it was written in, and the
//!   macro call that made it ([`map`]).
//! - *No text harms the reader*: steps, nesting, sizes and files are bounded ([`budget`]).
//!
//! Files with no more than named numbers ([`detect`]) are not expanded: the reader evaluates these itself, in any order.

mod arguments;
mod arithmetic;
mod budget;
mod comparison;
mod detect;
mod element;
mod evaluate;
mod expand;
mod field;
mod files;
mod functions;
mod glob;
mod include;
mod keyed;
mod leftover;
mod macros;
mod map;
mod methods;
mod output;
mod packages;
mod percent;
mod property;
mod python_text;
mod scope;
mod substitute;
mod syntax;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
mod text;
mod token;
mod value;
mod yaml;
mod yaml_scalar;

pub(super) use output::{Expanded, number_named};

use super::error::FormatError;
use super::{ReadOptions, Warning, WarningKind, xml};

use budget::Budget;
use files::Files;
use roxmltree::Document;
use scope::Table;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;
use std::rc::Rc;
use text::Text;

/// Stack of the thread that expands: the deepest nesting that [`budget`] allows needs a tenth of it.
const STACK: usize = 256 << 20;

/// A range of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    file: u32,
    start: usize,
    end: usize,
}

impl Place {
    fn new(file: u32, range: Range<usize>) -> Self {
        Self {
            file,
            start: range.start,
            end: range.end,
        }
    }
}

/// What is wrong, and where.
#[derive(Clone, Debug)]
struct Trouble {
    place: Option<Place>,
    /// The macro call in which it was met.
    call: Option<u32>,
    message: String,
    help: Option<String>,
    kind: Sort,
}

/// What is done about a trouble beyond telling it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sort {
    Usual,
    /// An argument has no value: all such arguments are told together.
    Argument,
    /// A file cannot be read: an optional include is left out.
    File,
}

type Outcome<T> = Result<T, Box<Trouble>>;

impl Trouble {
    fn new(message: impl Into<String>) -> Box<Self> {
        Box::new(Self {
            place: None,
            call: None,
            message: message.into(),
            help: None,
            kind: Sort::Usual,
        })
    }

    fn help(mut self: Box<Self>, help: impl Into<String>) -> Box<Self> {
        self.help = Some(help.into());
        self
    }

    fn maybe_help(mut self: Box<Self>, help: Option<String>) -> Box<Self> {
        self.help = help.or(self.help);
        self
    }

    fn sort(mut self: Box<Self>, kind: Sort) -> Box<Self> {
        self.kind = kind;
        self
    }

    /// With a place, unless it has one.
    fn at(mut self: Box<Self>, place: Place, call: Option<u32>) -> Box<Self> {
        if self.place.is_none() {
            self.place = Some(place);
            self.call = call;
        }
        self
    }
}

impl From<String> for Box<Trouble> {
    fn from(message: String) -> Self {
        Trouble::new(message)
    }
}

/// A macro call that is or was under way.
#[derive(Clone, Debug)]
struct Call {
    name: String,
    place: Place,
    parent: Option<u32>,
}

/// Something told beside the result: its kind and its words.
type Told = (WarningKind, String);

/// One expansion.
struct Run<'o> {
    options: &'o ReadOptions,
    files: Files,
    /// The files under evaluation, outermost first.
    file_stack: Vec<u32>,
    calls: Vec<Call>,
    call: Option<u32>,
    /// The arguments that have values.
    arguments: BTreeMap<String, Text>,
    /// Names that the file gave a value, where a setting or a symbol of that name may be meant.
    met_names: BTreeSet<String>,
    /// Properties under evaluation, outermost first.
    evaluating: Vec<String>,
    namespaces: Vec<Rc<Table>>,
    macros: BTreeSet<String>,
    /// Whether the main file neither defines nor includes macros.
    is_alone: bool,
    warnings: Vec<(Place, Option<u32>, Told)>,
    budget: Budget,
}

/// What is to be read for a text.
pub(super) enum Source<'t> {
    /// The text itself, with these warnings, and what was parsed of it where it had to be looked into.
    Plain(Vec<Warning>, Option<Box<Document<'t>>>),
    Expanded(Box<Expanded>),
}

/// Expands a text if it uses more of xacro than named numbers; `base` is the file that it was read from.
///
/// # Errors
/// What is wrong with this file or with one that it includes.
pub(super) fn expand<'t>(
    text: &'t str,
    file: &str,
    base: Option<&Path>,
    options: &ReadOptions,
) -> Result<Source<'t>, FormatError> {
    if !text.contains("xacro") {
        return Ok(Source::Plain(Vec::new(), None));
    }
    // What cannot be parsed is told by the reader.
    let Ok(document) = xml::parse(text) else {
        return Ok(Source::Plain(Vec::new(), None));
    };
    if !detect::needs_expansion(&document) {
        let warnings = leftover::calls(&document, text, file)?;
        return Ok(Source::Plain(warnings, Some(Box::new(document))));
    }
    drop(document);
    let expanded = on_large_stack(|| Run::new(options).expand(text, file, base))?;
    Ok(Source::Expanded(Box::new(expanded)))
}

/// A text that uses no more of xacro than named numbers, parsed, with what is told of macros that nobody defines; `None` where it uses
/// nothing of xacro or more, or is at fault.
pub(super) fn parsed<'t>(text: &'t str, file: &str) -> Option<(Box<Document<'t>>, Vec<Warning>)> {
    if !text.contains("xacro") {
        return None;
    }
    let document = xml::parse(text).ok()?;
    if detect::needs_expansion(&document) {
        return None;
    }
    let warnings = leftover::calls(&document, text, file).ok()?;
    Some((Box::new(document), warnings))
}

/// Nested macros and long sums are walked recursively, deeper than the stack of an ordinary thread allows.
fn on_large_stack<T: Send>(
    work: impl FnOnce() -> Result<T, FormatError> + Send,
) -> Result<T, FormatError> {
    std::thread::scope(|scope| {
        let failed = || {
            let fault = super::error::Fault::new(0..0, "there is no memory to expand the file in");
            Err(super::error::located("xacro", "", vec![fault]))
        };
        match std::thread::Builder::new()
            .name("xacro".to_owned())
            .stack_size(STACK)
            .spawn_scoped(scope, work)
        {
            Ok(thread) => match thread.join() {
                Ok(result) => result,
                Err(panic) => std::panic::resume_unwind(panic),
            },
            Err(_) => failed(),
        }
    })
}
