//! What can go wrong while a log is written.

use std::io;
use thiserror::Error;

/// Why a log could not be written, or not on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The system refused: no such folder, no permission, no space left.
    #[error("the log cannot be written: {0}")]
    Io(#[from] io::Error),
    /// The container refused a record.
    #[error("the log cannot be written: {0}")]
    Container(String),
    /// A number that no viewer can show.
    #[error("{what} is not a finite number")]
    NotFinite {
        /// Whose number.
        what: String,
    },
    /// A time that the format cannot hold: not finite, before zero, or later than 2³² s.
    #[error("a log cannot hold the time {time} s")]
    Time {
        /// Seconds.
        time: f64,
    },
    /// Numbers for another mechanism.
    #[error("{found} {what} given where the mechanism has {expected}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// How many the mechanism has.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// More bytes than a record can hold.
    #[error("{what} is too long for a log")]
    TooLong {
        /// What.
        what: &'static str,
    },
}

impl From<mcap::McapError> for RecordError {
    fn from(error: mcap::McapError) -> Self {
        match error {
            mcap::McapError::Io(error) => Self::Io(error),
            other => Self::Container(other.to_string()),
        }
    }
}
