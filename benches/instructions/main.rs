//! Stages as programs of their own, for counting instructions.
//!
//! ```text
//! cargo bench -p kutzbach-benches --bench instructions                      # lists the cases
//! cargo bench -p kutzbach-benches --bench instructions -- sweeps            # lists those of sweeps
//! cargo bench -p kutzbach-benches --bench instructions -- rank/bennett 5    # runs one five times
//! python3 benches/instructions.py --date DATE --machine MACHINE
//! ```
//!
//! The script runs each case under callgrind, without and with repetitions, and takes the difference: what has to be made
//! ready is in both. One thread, and nothing that depends on time or on addresses.

#[path = "../stages/cases.rs"]
#[allow(dead_code)] // the timed stages use the rest
mod cases;
#[path = "../stages/jobs.rs"]
#[allow(dead_code)]
mod jobs;
mod list;

use std::error::Error;
use std::hint::black_box;

fn main() -> Result<(), Box<dyn Error>> {
    // `cargo bench` adds `--bench`, `cargo test -p kutzbach-benches --benches` nothing.
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| !argument.starts_with("--"))
        .collect();
    match arguments.as_slice() {
        [] => print_names(&list::all()),
        [which] if which == "sweeps" => print_names(&list::sweeps()),
        [name, repetitions] => {
            let repetitions: usize = repetitions.parse()?;
            let (_, case, stage) = list::all()
                .into_iter()
                .chain(list::sweeps())
                .find(|(stage, case, _)| format!("{stage}/{case}") == *name)
                .ok_or_else(|| format!("there is no case `{name}`"))?;
            let mut job = stage(case);
            for _ in 0..repetitions {
                black_box(job());
            }
        }
        _ => return Err("needed are a case and how often it is to run".into()),
    }
    Ok(())
}

fn print_names(cases: &[(&str, &str, list::Stage)]) {
    for (stage, case, _) in cases {
        println!("{stage}/{case}");
    }
}
