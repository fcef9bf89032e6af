//! The command line: words in, a call into the library, text out. One file per subcommand; no analysis in any of them.
//!
//! Exit codes: 0 done; 1 an expectation or a verification failed; 2 bad input; 3 undecided where `--strict` was given; 130 interrupted.

mod accuracy;
mod assemble;
mod check;
mod contacts;
mod convert;
mod exact;
mod excerpt;
mod explain;
mod failure;
mod features;
mod features_step;
mod files;
mod gallery;
mod geometry;
mod graph;
mod interrupt;
mod load;
mod map;
mod output;
mod pool;
mod pose;
mod progress;
mod report;
mod shells;
mod simulate;
mod sketch;
mod sweep;
mod terminal;
mod trace;
mod units;

use clap::{CommandFactory, Parser, Subcommand};
use failure::Failure;
use std::process::ExitCode;

/// Exit code of a command that did what was asked.
const DONE: u8 = 0;
/// Exit code where an expectation failed.
const DISAGREEMENT: u8 = 1;
/// Exit code for input that cannot be used.
const BAD_INPUT: u8 = 2;
/// Exit code for an undecided verdict under `--strict`.
const UNDECIDED: u8 = 3;

/// How can this mechanism move, and why?
#[derive(Debug, Parser)]
#[command(name = "kutzbach", version, about, max_term_width = 100)]
#[command(
    after_help = "Exit codes: 0 done, 1 an expectation or a verification failed, 2 bad input, 3 undecided under --strict, 130 interrupted."
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Report(report::Arguments),
    Check(check::Arguments),
    Convert(convert::Arguments),
    Contacts(contacts::Arguments),
    Simulate(Box<simulate::Arguments>),
    Graph(graph::Arguments),
    Exact(exact::Arguments),
    Assemble(assemble::Arguments),
    Trace(trace::Arguments),
    Sweep(sweep::Arguments),
    Map(map::Arguments),
    Accuracy(accuracy::Arguments),
    Gallery(gallery::Arguments),
    Geometry(geometry::Arguments),
    Features(features::Arguments),
    Explain(explain::Arguments),
    Completions(shells::Completions),
    Man(shells::Manual),
}

/// Reads the arguments, runs the command and tells what went wrong.
pub fn run() -> ExitCode {
    let command = Arguments::parse().command;
    interrupt::end_at_once();
    let outcome = match command {
        Command::Report(arguments) => report::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Convert(arguments) => convert::run(&arguments),
        Command::Contacts(arguments) => contacts::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Graph(arguments) => graph::run(&arguments),
        Command::Exact(arguments) => exact::run(&arguments),
        Command::Assemble(arguments) => assemble::run(&arguments),
        Command::Trace(arguments) => trace::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Map(arguments) => map::run(&arguments),
        Command::Accuracy(arguments) => accuracy::run(&arguments),
        Command::Gallery(arguments) => gallery::run(&arguments),
        Command::Geometry(arguments) => geometry::run(&arguments),
        Command::Features(arguments) => features::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Completions(arguments) => shells::completions(&arguments, Arguments::command()),
        Command::Man(arguments) => shells::manual(&arguments, Arguments::command()),
    };
    match outcome {
        Ok(code) => ExitCode::from(code),
        // Whoever read the output has seen enough, as in `kutzbach report … | head`.
        Err(Failure::ReaderGone) => ExitCode::from(DONE),
        Err(failure) => {
            failure.tell();
            ExitCode::from(BAD_INPUT)
        }
    }
}
