//! Families of mechanisms, for examples, benches and tests.
//!
//! Some have a size (scissor lifts, Miura sheets, Bennett chains) and show how cost grows. The others depend on a small
//! number `epsilon` and come, as it vanishes, to a mechanism or a pose that moves otherwise: these show how close to such
//! a border answers are still given.
//!
//! All are written with exact numbers, frames close to their own joints, and names that tell the place in the family.

mod bennett;
mod continuous;
mod coupled;
mod double_planar;
mod drawn;
mod four_bars;
mod miura;
mod plain;
mod scissor;
mod truth;

pub use bennett::{bennett_chain, bennett_row, spoiled_bennett};
pub use continuous::{Family, continuous_families, negative_power_of_ten};
pub use coupled::{layer_tower, limb_grid};
pub use double_planar::double_planar;
pub use four_bars::{
    flat_change_point, flattening_parallelogram, near_dead_centre, spoiled_parallelogram,
};
pub use miura::miura_sheet;
pub use plain::{
    comb, gear_train, hinge_ring, parallel_hinges, parallelograms, serial_chain, star,
};
pub use scissor::scissor_lift;
pub use truth::{Outcome, Truth};

use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Frame};

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
