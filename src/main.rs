//! The `kutzbach` command line: `kutzbach report FILE` says how a mechanism can move, and why.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
