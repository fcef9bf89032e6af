//! Tests on STEP texts that are written here.

mod builder;
mod hostile;
mod pairs;
mod read;
mod solids;
mod touching;
