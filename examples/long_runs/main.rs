//! Long runs: a driven Bennett linkage for a million steps, a scissor that swings under gravity, a Stewart platform that is
//! shaken; closure error, energy, and the distance from the traced motion, window by window.
//!
//! ```text
//! cargo run --release --example long_runs                         # prints the tables
//! cargo run --release --example long_runs -- --update DATE MACHINE
//! cargo run --release --example long_runs -- --redraw
//! ```
//!
//! `--update` measures, some minutes, and writes the record `benches/record/long_runs.json`, the figures
//! `docs/src/images/long_runs_*.svg` and the measured part of `docs/src/long_runs.md`; `--redraw` writes the figures and the
//! page again from the record. `tests/long_runs` holds them against each other and against a fresh measurement.

mod claims;
mod crank;
mod figure;
mod page;
mod record;
mod runs;
mod scissor;
mod stewart;
mod traced;
mod watch;

use record::Record;
use std::fs;
use watch::Result;

const RECORD: &str = "benches/record/long_runs.json";
const FIGURES: &str = "docs/src/images";
const PAGE: &str = "docs/src/long_runs.md";

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let tell = |row: &str| eprintln!("{row}");
    match arguments.as_slice() {
        [] => {
            let record = runs::measure("this day", "this machine", tell)?;
            print!("{}", page::measured(&record));
        }
        ["--update", date, machine] => {
            let record = runs::measure(date, machine, tell)?;
            fs::write(RECORD, serde_json::to_string_pretty(&record)? + "\n")?;
            write(&record)?;
        }
        ["--redraw"] => write(&serde_json::from_str(&fs::read_to_string(RECORD)?)?)?,
        _ => return Err("known are --update DATE MACHINE, and --redraw".into()),
    }
    Ok(())
}

/// The figures and the page of a record.
fn write(record: &Record) -> Result<()> {
    for (name, svg) in figure::figures(record) {
        fs::write(format!("{FIGURES}/{name}.svg"), svg)?;
    }
    let replaced = page::replaced(&fs::read_to_string(PAGE)?, record)?;
    fs::write(PAGE, replaced)?;
    Ok(())
}
