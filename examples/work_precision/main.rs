//! Work and precision: what one driven turn of a four-bar and of Bennett's linkage costs, simulated with every number of
//! substeps and traced, and how far the loop comes open.
//!
//! ```text
//! cargo run --release --example work_precision                         # prints the tables
//! cargo run --release --example work_precision -- --json               # the record
//! cargo run --release --example work_precision -- --update DATE MACHINE
//! cargo run --release --example work_precision -- --redraw
//! ```
//!
//! `--update` measures and writes the record `benches/record/work_precision.json`, the figure
//! `docs/src/images/work_precision.svg` and the measured part of `docs/src/work_precision.md`; `--redraw` writes the figure and
//! the page again from the record. `tests/work_precision.rs` holds all three against each other and against a fresh
//! measurement.

mod figure;
mod measure;
mod page;
mod record;
mod rounds;

use measure::Result;
use record::Record;
use std::fs;

const RECORD: &str = "benches/record/work_precision.json";
const FIGURE: &str = "docs/src/images/work_precision.svg";
const PAGE: &str = "docs/src/work_precision.md";

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let tell = |row: &str| eprintln!("{row}");
    match arguments.as_slice() {
        [] => print!(
            "{}",
            page::measured(&rounds::measure("this day", "this machine", tell)?)
        ),
        ["--json"] => {
            let record = rounds::measure("", "", tell)?;
            println!("{}", serde_json::to_string_pretty(&record)?);
        }
        ["--update", date, machine] => {
            let record = rounds::measure(date, machine, tell)?;
            fs::write(RECORD, serde_json::to_string_pretty(&record)? + "\n")?;
            write(&record)?;
        }
        ["--redraw"] => write(&serde_json::from_str(&fs::read_to_string(RECORD)?)?)?,
        _ => return Err("known are --json, --update DATE MACHINE, and --redraw".into()),
    }
    Ok(())
}

/// The figure and the page of a record.
fn write(record: &Record) -> Result<()> {
    fs::write(FIGURE, figure::render(record))?;
    let replaced = page::replaced(&fs::read_to_string(PAGE)?, record)?;
    fs::write(PAGE, replaced)?;
    Ok(())
}
