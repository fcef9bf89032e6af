//! The second step of a sweep: variants between neighbours whose answers differ.

use super::WINDOW;
use super::sink::Sink;
use crate::cli::DONE;
use crate::cli::failure::Failure;
use crate::cli::files::cannot_read;
use crate::cli::interrupt::{self, INTERRUPTED};
use crate::cli::pool::{Event, in_order};
use crate::cli::progress::Progress;
use kutzbach::sweep::{Border, Members, Side, Table};
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::ops::ControlFlow;
use std::path::Path;

/// Adds the rows between neighbours to a sweep that is complete in its file.
///
/// # Errors
/// Where the file cannot be read again or written.
pub fn refine(
    members: &Members<'_>,
    table: &Table,
    path: &Path,
    steps: u32,
    sink: &mut Sink,
) -> Result<u8, Failure> {
    let plan = members.family().plan();
    let border = Border::new(plan, &sides(path, table, plan.count())?, steps);
    let count = border.count();
    // A pair under way at Ctrl-C has no rows.
    let one = |pair: u64| -> Option<Vec<String>> {
        let rows = interrupt::during(|| border.rows(pair, members))?;
        Some(rows.iter().map(|row| table.line(row)).collect())
    };
    let mut progress = Progress::new("refining");
    let mut failed = None;
    let mut finished = 0;
    in_order(count, WINDOW, one, |done, event| {
        let put = match event {
            Event::Next(Some(lines)) => {
                finished += 1;
                lines.iter().try_for_each(|line| sink.put(line))
            }
            Event::Next(None) | Event::Waiting => sink.keep(),
        };
        if let Err(failure) = put {
            failed = Some(failure);
            return ControlFlow::Break(());
        }
        progress.tick(done, count)
    });
    progress.finish();
    if let Some(failure) = failed {
        return Err(failure);
    }
    sink.flush()?;
    eprintln!("note: neighbours whose answers differ: {count}");
    if finished < count {
        eprintln!(
            "note: stopped between {finished} of {count} neighbours; the same command refines anew"
        );
        return Ok(INTERRUPTED);
    }
    Ok(DONE)
}

/// The sides on which the variants of a complete sweep lie, from its file.
fn sides(path: &Path, table: &Table, count: u64) -> Result<Vec<Side>, Failure> {
    let cannot = |error: std::io::Error| cannot_read(path, &error);
    let other = || Failure::Plain {
        message: format!(
            "`{}` does not have the rows that were written",
            path.display()
        ),
        help: Some("`--refine` reads the rows of the sweep again: name a file".to_owned()),
    };
    // A pipe could be waited for without end.
    if !std::fs::metadata(path).is_ok_and(|known| known.is_file()) {
        return Err(other());
    }
    let opened = File::open(path).map_err(cannot)?;
    let head = table.head().lines().count();
    let mut sides = Vec::new();
    for line in BufReader::new(opened).lines().skip(head) {
        if sides.len() as u64 == count {
            break;
        }
        let line = line.map_err(cannot)?;
        sides.push(table.side(&line).ok_or_else(other)?);
    }
    match sides.len() as u64 == count {
        true => Ok(sides),
        false => Err(other()),
    }
}
