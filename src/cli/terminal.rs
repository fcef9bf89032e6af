//! What the terminal can show.

use kutzbach::report::text::Layout;
use std::io::IsTerminal;

/// Columns of a page where the terminal does not say.
const USUAL_WIDTH: usize = 100;

/// The layout for standard output, or for a file.
pub fn layout(to_file: bool, verbose: bool) -> Layout {
    let terminal = !to_file && std::io::stdout().is_terminal();
    Layout {
        color: terminal && color_wanted(),
        width: if terminal { width() } else { USUAL_WIDTH },
        verbose,
        ..Layout::default()
    }
}

/// How errors are laid out.
#[derive(Debug)]
pub struct ErrorLayout {
    /// Whether they are coloured.
    pub color: bool,
    /// The columns at which they are wrapped. None where other programs read them: those look for whole sentences and
    /// names, which a long path would break.
    pub width: Option<usize>,
}

/// The layout of errors for standard error.
pub fn error_layout() -> ErrorLayout {
    let terminal = std::io::stderr().is_terminal();
    ErrorLayout {
        color: terminal && color_wanted(),
        width: terminal.then(width),
    }
}

/// <https://no-color.org>: any value but an empty one forbids colour. A dumb terminal has none.
fn color_wanted() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !set("NO_COLOR") && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

/// The width that the shell states.
fn width() -> usize {
    std::env::var("COLUMNS")
        .ok()
        .and_then(|columns| columns.parse().ok())
        .unwrap_or(USUAL_WIDTH)
}
