//! The `kutzbach` command line.

fn main() {}
