//! The answers as text and as data.

mod incidence;
mod modes;
mod seams;

pub use incidence::IncidenceWords;
pub use modes::{SCHEMA, Units, data, note, text};
pub use seams::SeamWords;

/// So many degrees of freedom.
pub(crate) fn degrees_of_freedom(number: usize) -> String {
    format!("{} of freedom", count(number, "degree"))
}

/// A number with its word.
pub(crate) fn count(number: usize, one: &str) -> String {
    match number {
        1 => format!("1 {one}"),
        _ => format!("{number} {one}s"),
    }
}
