//! The tables of Ruiz (1994) beside the same computations now, and the three ways to a basis on families of growing size.
//!
//! ```text
//! cargo run --release --example exact_tables                         # prints the tables
//! cargo run --release --example exact_tables -- --json               # the record
//! cargo run --release --example exact_tables -- --update DATE MACHINE
//! cargo run --release --example exact_tables -- --update-tables DATE
//! cargo run --release --example exact_tables -- --redraw
//! ```
//!
//! `--update-tables` measures the tables of the source only. `--update` measures and writes the record `benches/record/exact_tables.json` and the measured part of
//! `docs/src/exact.md`; `--redraw` writes the page again from the record. `tests/exact_tables.rs` holds the two against each
//! other, and the sizes in them against fresh computations.

mod measure;
mod page;
mod published;
mod record;
mod scenes;

use measure::Result;
use record::Record;
use std::fs;

const RECORD: &str = "benches/record/exact_tables.json";
const PAGE: &str = "docs/src/exact.md";

/// Rounds of which the best time counts.
const ROUNDS: usize = 5;

/// Seconds that one way may take for one member of a family.
const LIMIT: f64 = 20.0;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments.as_slice() {
        [] => print!("{}", page::measured(&measured("this day", "this machine")?)),
        ["--json"] => println!("{}", serde_json::to_string_pretty(&measured("", "")?)?),
        ["--update", date, machine] => {
            let record = measured(date, machine)?;
            fs::write(RECORD, serde_json::to_string_pretty(&record)? + "\n")?;
            write(&record)?;
        }
        ["--update-tables", date] => {
            let mut record: Record = serde_json::from_str(&fs::read_to_string(RECORD)?)?;
            record.tables = measure::tables(ROUNDS, |row| eprintln!("{row}"))?;
            record.tables_date = Some((*date).to_owned());
            fs::write(RECORD, serde_json::to_string_pretty(&record)? + "\n")?;
            write(&record)?;
        }
        ["--redraw"] => write(&serde_json::from_str(&fs::read_to_string(RECORD)?)?)?,
        _ => {
            return Err(
                "known are --json, --update DATE MACHINE, --update-tables DATE, and --redraw"
                    .into(),
            );
        }
    }
    Ok(())
}

fn measured(date: &str, machine: &str) -> Result<Record> {
    let tell = |row: &str| eprintln!("{row}");
    Ok(Record {
        date: date.to_owned(),
        tables_date: None,
        machine: machine.to_owned(),
        tables: measure::tables(ROUNDS, tell)?,
        scenes: measure::scenes(LIMIT, tell)?,
        loops: measure::loops(ROUNDS)?,
    })
}

fn write(record: &Record) -> Result<()> {
    let replaced = page::replaced(&fs::read_to_string(PAGE)?, record)?;
    fs::write(PAGE, replaced)?;
    Ok(())
}
