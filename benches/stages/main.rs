//! The stages of an analysis, timed one by one on fixed cases.
//!
//! ```text
//! cargo bench -p kutzbach-benches --bench stages                 # everything
//! cargo bench -p kutzbach-benches --bench stages -- rank         # names that contain `rank`
//! ```
//!
//! One file per stage, in the order in which data flows; [`cases`] says what is measured. The process as a whole, with its
//! memory, is timed by `--bench process`; instructions, which are the same on a busy machine, are counted by
//! `benches/instructions.py`. `benches/README.md` says how to keep results and compare them.

mod analyse;
mod assemble;
mod cases;
mod chart;
mod configurations;
mod constructive;
mod exact;
mod germ;
mod graph;
#[allow(dead_code)] // the counted stages use the rest
mod jobs;
mod parse;
mod rank;
mod report;
mod simulate;
mod sweep;
mod trace;

fn main() {
    divan::main();
}
