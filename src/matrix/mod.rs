//! (module essay)
pub mod big;
pub mod coloops;
pub mod error;
pub mod estimate;
pub mod frontal;
pub mod jacobi;
pub mod modular;
mod multifrontal;
pub mod null_space;
pub mod ordering;
pub mod random;
pub mod rank;
pub mod real;
pub mod sparse;
mod svd;
