//! What went wrong, told with the place, what was needed, and how to mend it.

use super::excerpt::Excerpt;
use super::load::STANDARD_INPUT;
use super::terminal::{self, ErrorLayout};
use kutzbach::format::FormatError;
use kutzbach::report::text::visible;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};
use std::fmt;
use std::io::Write;

/// Why a command did not do what was asked.
#[derive(Debug)]
pub enum Failure {
    /// A file that is not a mechanism.
    File(Box<FormatError>),
    /// Anything without a place in a file.
    Plain {
        /// What was needed and what was found.
        message: String,
        /// How to mend it.
        help: Option<String>,
    },
    /// The reader of standard output has closed it.
    ReaderGone,
}

impl From<FormatError> for Failure {
    fn from(error: FormatError) -> Self {
        Self::File(Box::new(error))
    }
}

impl Failure {
    /// Tells it on standard error. That standard error is closed is nobody's concern.
    pub fn tell(&self) {
        let _ = std::io::stderr()
            .lock()
            .write_all(self.text(&terminal::error_layout()).as_bytes());
    }

    /// The failure as text: each fault with its excerpt.
    pub fn text(&self, layout: &ErrorLayout) -> String {
        let mut text = String::new();
        match self {
            Self::ReaderGone => {}
            Self::Plain { message, help } => {
                text.push_str(&rendered(&Fault::plain(message, help.as_deref()), layout));
            }
            Self::File(error) => {
                // Faults of a file that includes others may stand in those.
                let mut sources = std::collections::BTreeMap::new();
                for error in std::iter::once(&**error).chain(error.others.iter()) {
                    let source = sources
                        .entry(&error.file)
                        .or_insert_with(|| source_of(&error.file));
                    text.push_str(&rendered(&Fault::located(error, source.as_deref()), layout));
                }
            }
        }
        text
    }

    /// The failure in one line.
    pub fn line(&self) -> String {
        match self {
            Self::File(error) => visible(&error.to_string()).into_owned(),
            Self::Plain { message, .. } => visible(message).into_owned(),
            Self::ReaderGone => String::new(),
        }
    }
}

/// One fault in the shape that miette renders.
#[derive(Debug)]
struct Fault {
    message: String,
    help: Option<String>,
    excerpt: Option<Excerpt>,
}

impl Fault {
    fn plain(message: &str, help: Option<&str>) -> Self {
        Self {
            message: visible(message).into_owned(),
            help: help.map(|help| visible(help).into_owned()),
            excerpt: None,
        }
    }

    fn located(error: &FormatError, source: Option<&str>) -> Self {
        let help = error.help.as_deref();
        match source {
            // What could not be read has no lines.
            None => Self::plain(&format!("{}: {}", error.file, error.message), help),
            Some("") => Self::plain(&error.to_string(), help),
            Some(source) => Self {
                excerpt: Some(Excerpt::new(
                    &error.file,
                    source,
                    &error.span,
                    error.line,
                    error.column,
                )),
                ..Self::plain(&error.to_string(), help)
            },
        }
    }
}

/// The text of a file, for an excerpt; none where it cannot be read, is endless like a device, or too large to look at.
fn source_of(file: &str) -> Option<String> {
    const LARGEST: u64 = 1 << 28;
    // Its lines are gone; the place is told without them.
    if file == STANDARD_INPUT {
        return Some(String::new());
    }
    let known = std::fs::metadata(file).ok()?;
    if !known.is_file() || known.len() > LARGEST {
        return None;
    }
    let bytes = std::fs::read(file).ok()?;
    if bytes.contains(&0) {
        // A zip file has no lines to show.
        return Some(String::new());
    }
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Fault {}

impl Diagnostic for Fault {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let help = self.help.as_ref()?;
        Some(Box::new(help))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        let excerpt = self.excerpt.as_ref()?;
        Some(excerpt)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let excerpt = self.excerpt.as_ref()?;
        let label = LabeledSpan::new_with_span(Some("here".to_owned()), excerpt.span());
        Some(Box::new(std::iter::once(label)))
    }
}

fn rendered(fault: &Fault, layout: &ErrorLayout) -> String {
    let theme = if layout.color {
        GraphicalTheme::unicode()
    } else {
        GraphicalTheme::unicode_nocolor()
    };
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(layout.width.unwrap_or_default())
        .with_wrap_lines(layout.width.is_some())
        .with_context_lines(1)
        .with_links(false)
        .without_syntax_highlighting();
    if handler.render_report(&mut text, fault).is_err() {
        text = format!("error: {fault}\n");
    }
    text
}

/// Refuses options that would change nothing: whether each is given where it is idle, its name, and what it goes with.
///
/// # Errors
/// For the first of them.
pub fn refuse_idle(options: &[(bool, &str, &str)]) -> Result<(), Failure> {
    match options.iter().find(|(idle, _, _)| *idle) {
        None => Ok(()),
        Some((_, option, with)) => Err(Failure::Plain {
            message: format!("`{option}` changes nothing here"),
            help: Some(format!("it goes with {with}")),
        }),
    }
}
