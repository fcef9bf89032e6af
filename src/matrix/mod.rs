//! (module essay)
pub mod big;
pub mod error;
pub mod random;
pub mod real;
pub mod sparse;
pub mod frontal;
pub mod ordering;
mod multifrontal;
