//! What accuracy costs for eight mechanisms that differ: the measured parts of two pages of the book, and their figures.
//!
//! ```text
//! cargo run --release --example accuracy_page                            # prints the measured parts
//! cargo run --release --example accuracy_page -- --only bennett          # of one mechanism
//! cargo run --release --example accuracy_page -- --update DATE MACHINE
//! cargo run --release --example accuracy_page -- --redraw
//! ```
//!
//! `--update` measures, some minutes, and writes the record `benches/record/accuracy.json`, the figures
//! `docs/src/images/accuracy_….svg` and the parts of the pages between their markers; `--redraw` writes figures and pages again
//! from the record. `tests/accuracy_page.rs` holds all of it against each other and against a fresh measurement.

mod page;
mod record;
mod subjects;

use record::Record;
use std::fs;
use subjects::{Result, SUBJECTS, Subject};

const RECORD: &str = "benches/record/accuracy.json";

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments.as_slice() {
        [] => print(&measured("this day", "this machine", &SUBJECTS)?),
        ["--only", name] => {
            let subject = SUBJECTS.into_iter().find(|subject| subject.name == *name);
            let subject = subject.ok_or("there is no mechanism of that name on the page")?;
            print(&measured("this day", "this machine", &[subject])?);
        }
        ["--update", date, machine] => {
            let record = measured(date, machine, &SUBJECTS)?;
            fs::write(RECORD, serde_json::to_string_pretty(&record)? + "\n")?;
            write(&record)?;
        }
        ["--redraw"] => write(&serde_json::from_str(&fs::read_to_string(RECORD)?)?)?,
        _ => return Err("known are --only NAME, --update DATE MACHINE, and --redraw".into()),
    }
    Ok(())
}

fn measured(date: &str, machine: &str, subjects: &[Subject]) -> Result<Record> {
    let mut record = Record::new(date, machine);
    for subject in subjects {
        eprintln!("{}", subject.name);
        record.add(subject)?;
    }
    Ok(record)
}

fn print(record: &Record) {
    for (_, text) in page::PAGES.iter().flat_map(|page| page.parts(record)) {
        println!("{text}");
    }
}

/// The figures and the page of a record.
fn write(record: &Record) -> Result<()> {
    for row in &record.mechanisms {
        fs::write(page::figure_file(&row.name), page::figure_of(row))?;
    }
    for page in page::PAGES {
        let replaced = page.replaced(&fs::read_to_string(page.file())?, record)?;
        fs::write(page.file(), replaced)?;
    }
    Ok(())
}
