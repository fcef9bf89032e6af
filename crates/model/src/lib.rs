//! What a mechanism is, always valid, and its constraint graph.

pub mod graph;
pub mod mechanism;
