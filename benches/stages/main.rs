//! The stages of an analysis, timed one by one on fixed cases.
//!
//! ```text
//! cargo bench --bench stages                 # everything
//! cargo bench --bench stages -- rank         # names that contain `rank`
//! ```
//!
//! One file per stage, in the order in which data flows; [`cases`] says what is measured. The process as a whole, with its
//! memory, is timed by `--bench process`.

mod analyse;
mod assemble;
mod cases;
mod graph;
mod motion;
mod parse;
mod rank;
mod report;

fn main() {
    divan::main();
}
