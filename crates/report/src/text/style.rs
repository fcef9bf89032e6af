//! Colour, on terminals only.

/// Pages are never narrower than this, whatever the terminal says.
pub const NARROWEST_PAGE: usize = 72;

/// How a page is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Whether to colour; the caller knows whether a terminal reads and whether `NO_COLOR` is set.
    pub color: bool,
    /// Columns of the page; at least [`NARROWEST_PAGE`] are used.
    pub width: usize,
    /// Whether to show every row and every detail.
    pub verbose: bool,
    /// In which units ranges are shown.
    pub units: Units,
}

/// The units of ranges in a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Units {
    /// Degrees and millimetres, as a drawing has them.
    #[default]
    Drawing,
    /// Radians and metres, as the file has them.
    Si,
}

impl Default for Layout {
    /// 100 columns without colour: what a file gets.
    fn default() -> Self {
        Self {
            color: false,
            width: 100,
            verbose: false,
            units: Units::default(),
        }
    }
}

/// What a colour stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tint {
    /// Ordinary text.
    Plain,
    /// A heading or the thing to read first.
    Strong,
    /// Explanation, safe to skip.
    Quiet,
    /// Moves, agrees.
    Good,
    /// Worth a look.
    Notable,
    /// Open or doubtful.
    Doubtful,
    /// Wrong or impossible.
    Bad,
}

impl Tint {
    fn code(self) -> Option<&'static str> {
        match self {
            Self::Plain => None,
            Self::Strong => Some("1"),
            Self::Quiet => Some("2"),
            Self::Good => Some("32"),
            Self::Notable => Some("36"),
            Self::Doubtful => Some("33"),
            Self::Bad => Some("31"),
        }
    }

    /// The text in this tint, if colours are on. The text must be harmless already.
    #[must_use]
    pub fn paint(self, text: &str, color: bool) -> String {
        match self.code() {
            Some(code) if color && !text.is_empty() => format!("\u{1b}[{code}m{text}\u{1b}[0m"),
            _ => text.to_owned(),
        }
    }
}
