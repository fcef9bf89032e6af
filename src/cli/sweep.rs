//! `kutzbach sweep FILE --over a=0..2:401`: the same question of many variants of a file, a row for each.

mod refine;
mod sink;

use super::DONE;
use super::failure::Failure;
use super::interrupt::{self, INTERRUPTED};
use super::load::{self, STANDARD_INPUT};
use super::output;
use super::pool::{Event, in_order};
use super::progress::Progress;
use clap::{Args, ValueEnum};
use kutzbach::format::{file_bytes, within_memory};
use kutzbach::mobility::{self, AnalysisOptions};
use kutzbach::sweep::{
    Family, Form, MeasuredFile, Over, Plan, Sample, Shard, Status, SweepError, Table,
};
use sink::Sink;
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Results that may wait for an earlier one.
const WINDOW: u64 = 4096;

/// Ask the same of many variants of a file: a row for each combination of its measures, on all processors
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: load::Source,
    /// Measure and its values, exact whatever their digits: `a=0..2:401` (from 0 to 2, 401 values) or `b=0.1,pi/4`; may be repeated,
    /// for all combinations
    #[arg(long, value_name = "NAME=VALUES", required = true, value_parser = over)]
    over: Vec<Over>,
    /// Take this many points of the ranges instead of all combinations: `sobol:1000` fills them evenly, `random:1000` does not
    #[arg(long, value_name = "KIND:N", value_parser = sample)]
    sample: Option<Sample>,
    /// How much is asked of each variant
    #[arg(long, value_enum, default_value_t = Asked::Verdict)]
    depth: Asked,
    /// Do one share of the work: `2/5` is the second of five, on machines that need not know one another
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<Shard>,
    /// Form of the rows; as the name of the output ends, or CSV, if not given
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Write to this file instead of standard output; if it has rows of the same sweep, go on after the last complete one
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Then look between neighbours whose answers differ: halve the way from one to the other, so many times, a row for each after those
    /// of the sweep; a sweep that is there already is refined
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=40), requires = "output", conflicts_with_all = ["sample", "shard"])]
    refine: Option<u32>,
    #[command(flatten)]
    closing: load::Closing,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Asked {
    /// Counts, and the instantaneous freedom with its margin
    Rank,
    /// Finite freedom, regular or singular, class
    Verdict,
    /// Branches and locked joints too
    Motions,
    /// What a report shows: stronger certificates by exact algebra too
    Everything,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Comma-separated values, after a line that states what was asked
    Csv,
    /// A JSON object in each line, the first one of what was asked
    Jsonl,
}

impl Arguments {
    /// The file of rows, where there is one.
    fn file(&self) -> Option<&Path> {
        output::named(self.output.as_deref())
    }
}

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read or has no such measure, or the output cannot be written. What is wrong with one variant is told in its
/// row.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    if arguments.refine.is_some() && arguments.file().is_none() {
        return Err(Failure::Plain {
            message: "`--refine` looks at the rows of a file, and there is none".to_owned(),
            help: Some("write the sweep to one: `-o out.csv`".to_owned()),
        });
    }
    let plan = Plan::new(arguments.over.clone(), arguments.sample).map_err(asked_wrongly)?;
    let shard = arguments.shard.unwrap_or_default();
    let family = family(arguments, plan)?;
    let table = Table::new(&family, shard, form(arguments));
    let count = shard.count(family.plan().count());
    interrupt::listen();
    let mut sink = Sink::open(arguments.file(), &table, shard, count)?;
    let before = sink.rows();
    let mut progress = progress_wanted(arguments).then(|| Progress::new("sweeping"));
    let mut tally = Tally::default();
    let mut failed = None;
    let left = count.saturating_sub(before);
    let members = family.members();
    // A variant under way at Ctrl-C has no row.
    let one = |place: u64| {
        let row = interrupt::during(|| members.row(shard.index(before + place)))??;
        Some((table.line(&row), row.outcome.status))
    };
    in_order(left, WINDOW, one, |done, event| {
        let put = match event {
            Event::Next(Some((line, status))) => {
                tally.count(status);
                sink.put(&line)
            }
            Event::Next(None) | Event::Waiting => sink.keep(),
        };
        if let Err(failure) = put {
            failed = Some(failure);
            return ControlFlow::Break(());
        }
        match &mut progress {
            Some(progress) => progress.tick(done, left),
            None if interrupt::asked() => ControlFlow::Break(()),
            None => ControlFlow::Continue(()),
        }
    });
    drop(progress);
    match failed {
        Some(failure) => return Err(failure),
        None => sink.flush()?,
    }
    tally.tell();
    if sink.rows() < count {
        eprintln!(
            "note: stopped after {} of {count} rows{}",
            sink.rows(),
            match arguments.file() {
                Some(_) => "; the same command goes on",
                None => "",
            }
        );
        return Ok(INTERRUPTED);
    }
    match (arguments.refine, arguments.file()) {
        (Some(steps), Some(path)) => refine::refine(&members, &table, path, steps, &mut sink),
        _ => Ok(DONE),
    }
}

/// Rows on a terminal show by themselves how far the work has come.
fn progress_wanted(arguments: &Arguments) -> bool {
    arguments.file().is_some() || !std::io::stdout().is_terminal()
}

fn family(arguments: &Arguments, plan: Plan) -> Result<Family, Failure> {
    let source = &arguments.source;
    let options = source.options(&[], false);
    let read = if source.file == Path::new("-") {
        MeasuredFile {
            bytes: load::standard_input(source.memory)?.into_bytes(),
            file: STANDARD_INPUT.to_owned(),
            base: None,
            options,
        }
    } else {
        MeasuredFile {
            bytes: within_memory(source.memory, || file_bytes(&source.file))?,
            file: source.file.display().to_string(),
            base: Some(source.file.clone()),
            options,
        }
    };
    let asked = AnalysisOptions {
        depth: match arguments.depth {
            Asked::Rank => mobility::Depth::Rank,
            Asked::Verdict => mobility::Depth::Verdict,
            Asked::Motions => mobility::Depth::Motions,
            Asked::Everything => mobility::Depth::Everything,
        },
        closure_tolerance: arguments.closing.closure_tolerance,
        ..AnalysisOptions::default()
    };
    Family::new(read, plan, asked).map_err(Failure::File)
}

fn form(arguments: &Arguments) -> Form {
    let ending = arguments.file().and_then(Path::extension);
    match arguments.format {
        Some(Format::Csv) => Form::Csv,
        Some(Format::Jsonl) => Form::JsonLines,
        None if ending.is_some_and(|own| own == "jsonl") => Form::JsonLines,
        None => Form::Csv,
    }
}

/// Variants without an answer.
#[derive(Debug, Default)]
struct Tally {
    invalid: u64,
    unassembled: u64,
}

impl Tally {
    fn count(&mut self, status: Status) {
        match status {
            Status::Analysed => {}
            Status::Invalid => self.invalid += 1,
            Status::Unassembled => self.unassembled += 1,
        }
    }

    fn tell(&self) {
        if self.invalid > 0 {
            eprintln!("note: invalid variants: {}", self.invalid);
        }
        if self.unassembled > 0 {
            eprintln!("note: variants that do not assemble: {}", self.unassembled);
        }
    }
}

fn asked_wrongly(error: SweepError) -> Failure {
    Failure::Plain {
        message: error.message,
        help: Some(error.help),
    }
}

fn told(error: SweepError) -> String {
    format!("{}; {}", error.message, error.help)
}

fn over(written: &str) -> Result<Over, String> {
    Over::read(written).map_err(told)
}

fn sample(written: &str) -> Result<Sample, String> {
    Sample::read(written).map_err(told)
}

fn shard(written: &str) -> Result<Shard, String> {
    Shard::read(written).map_err(told)
}
