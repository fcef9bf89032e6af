//! Why a rank is not plain.

use kutzbach_math::matrix::CLEARANCE;
use std::fmt;

/// What helps where the precision of the numbers leaves something open, whether their digits state it or whoever asks.
pub(crate) const FINER: &str = "numbers known more precisely would decide";

/// The same with how much it takes for the smallest singular value kept to stand clear of the uncertainty, which goes down with that of the
/// numbers.
fn finer(kept: f64, tolerance: f64) -> String {
    let times = (CLEARANCE * tolerance / kept).ceil();
    match times {
        2.0..100.0 => format!("numbers known {times:.0} times as precisely would decide"),
        100.0..f64::INFINITY => {
            format!("numbers known {times:.0e} times as precisely would decide")
        }
        _ => FINER.to_owned(),
    }
}

/// Why the answer about a rank is not plain: the figures, and by `Display` the sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum RankNote {
    /// Singular values below what the stated precision leaves open are read as zeros; taken literally the numbers leave less.
    WithinDigits {
        /// Freedom within the stated precision, and taken literally.
        answer: usize,
        /// The latter.
        literal: usize,
        /// The largest singular value read as zero, relative to the largest of all.
        dropped: f64,
        /// What the stated precision leaves open, likewise.
        tolerance: f64,
    },
    /// The stated precision separates nothing, so that the numbers are taken literally.
    TooCoarse {
        /// Freedom as written.
        answer: usize,
        /// Least and most within the stated precision.
        possible: (usize, usize),
    },
    /// Digits that programs print may be rounded where their last ones look exact.
    RoundedOtherwise {
        /// Freedom as written.
        literal: usize,
        /// Freedom if the coordinates are rounded.
        other: usize,
        /// The power of ten (m, rad) at which, or more coarsely.
        rounded_at: f64,
        /// The largest singular value that is zero then, relative to the largest of all.
        largest: f64,
        /// By what factor it lies below the others.
        gap: f64,
    },
    /// Decided as written, not within the stated precision.
    LiteralOnly {
        /// Freedom as written.
        literal: usize,
        /// Least and most within the stated precision.
        possible: (usize, usize),
        /// The smallest singular value kept, relative to the largest.
        kept: f64,
        /// What the stated precision leaves open.
        tolerance: f64,
    },
    /// In all their digits the numbers do not close the loops.
    StaysOpen {
        /// What is left of the closure (rad, cycle lengths).
        residual: f64,
    },
    /// What is zero in one of two parts that should be copies is not in the other.
    Unlike {
        /// Least and most.
        possible: (usize, usize),
    },
    /// Not separated from the uncertainty, whatever the digits.
    Undecided {
        /// Least and most.
        possible: (usize, usize),
        /// The smallest singular value kept and the largest dropped, relative to the largest.
        values: (f64, f64),
        /// What they are uncertain by.
        uncertainty: f64,
        /// Bits of the arithmetic.
        bits: u32,
    },
}

impl fmt::Display for RankNote {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WithinDigits {
                answer,
                literal,
                dropped,
                tolerance,
            } => write!(
                out,
                "taken literally, the numbers leave {literal} instead of {answer}: the smallest singular values, up to \
                 {dropped:.1e} of the largest, are below what the stated precision leaves open ({tolerance:.1e})"
            ),
            Self::TooCoarse { answer, possible } => write!(
                out,
                "{answer} as written, but the numbers are too coarse to decide: within their stated precision anything \
                 from {} to {} is possible",
                possible.0, possible.1
            ),
            Self::RoundedOtherwise {
                literal,
                other,
                rounded_at,
                largest,
                gap,
            } => write!(
                out,
                "{literal} as written, or {other} if the coordinates are rounded at {rounded_at:e} (m, rad) or more coarsely: \
                 singular values up to {largest:.1e} of the largest stand alone, a factor of {gap:.0e} below the others, and the \
                 file's digits are those that programs print, which does not say how well they are known; `--precision` states it"
            ),
            Self::LiteralOnly {
                literal,
                possible,
                kept,
                tolerance,
            } => write!(
                out,
                "the numbers taken literally leave {literal}; within their stated precision anything from {} to {} is \
                 possible (smallest singular value {kept:.1e} of the largest, uncertainty {tolerance:.1e}): {}",
                possible.0,
                possible.1,
                finer(*kept, *tolerance)
            ),
            Self::StaysOpen { residual } => write!(
                out,
                "in as many digits as the numbers have, the loops stay open by {residual:.1e}: the pose drawn is not closed, and \
                 at a closed one nearby the rank may be another"
            ),
            Self::Unlike { possible } => write!(
                out,
                "undecided between {} and {}: two parts of the mechanism have the same joints and, within the precision of the \
                 numbers, the same singular values, but what is zero in one of them is not in the other",
                possible.0, possible.1
            ),
            Self::Undecided {
                possible,
                values,
                uncertainty,
                bits,
            } => write!(
                out,
                "undecided between {} and {}: singular values {:.1e} and {:.1e} of the largest are not separated from the \
                 uncertainty {uncertainty:.1e}, with {bits} bits",
                possible.0, possible.1, values.0, values.1
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_told_how_much_more_precisely_numbers_have_to_be_known() {
        for (kept, tolerance, told) in [
            (0.12, 0.022, "known 2 times"),
            (1e-9, 5e-4, "known 5e6 times"),
            (0.5, 1e-3, FINER),
            (0.0, 1e-3, FINER),
        ] {
            let note = RankNote::LiteralOnly {
                literal: 1,
                possible: (1, 3),
                kept,
                tolerance,
            };
            assert!(note.to_string().contains(told), "{note}");
        }
    }
}
