//! Families of mechanisms of any size, for examples, benches and tests of growth.
//!
//! All are written with exact numbers, frames close to their own joints, and names that tell the place in the family.

mod miura;
mod scissor;

pub use miura::miura_sheet;
pub use scissor::scissor_lift;

use crate::mechanism::{Direction, Frame};
use crate::number::Number;

/// A number given in hundredths, exactly.
fn hundredths(value: i64) -> Number {
    Number::ratio(value, 100).unwrap_or_else(Number::zero)
}

fn at(x: i64, y: i64, z: i64) -> Frame {
    Frame::at([hundredths(x), hundredths(y), hundredths(z)])
}

fn along(x: i64, y: i64, z: i64) -> Direction {
    Direction([Number::integer(x), Number::integer(y), Number::integer(z)])
}
