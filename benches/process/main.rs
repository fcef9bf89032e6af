//! The program as a whole: `kutzbach report FILE` as a process, with its memory.
//!
//! ```text
//! cargo bench -p kutzbach-benches --bench process                # prints Markdown tables and the growth exponents
//! ```
//!
//! Writes the families as files into a temporary folder. Peak memory is what GNU time reads from the system; without
//! `/usr/bin/time` that column is empty. Standard output goes to a pipe that is read to its end, as a shell would.

use kutzbach::families::{miura_sheet, scissor_lift};
use kutzbach::mechanism::{Mechanism, MechanismError};
use std::error::Error;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// Runs that count; one more warms up the caches.
const RUNS: usize = 7;

/// Sizes between which growth is measured.
const STAGES: [usize; 5] = [100, 300, 1000, 3000, 10_000];
const PANELS: [usize; 4] = [15, 20, 25, 30];
/// Sizes at which every joint still gets its advice: shown, but no part of the growth.
const FEW_STAGES: [usize; 1] = [30];
const FEW_PANELS: [usize; 2] = [5, 10];

/// Small mechanisms of the repository.
const FILES: [&str; 5] = ["bennett", "sarrus", "stewart", "delta", "peaucellier"];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    // `cargo bench` says so; anything else, such as `cargo test -p kutzbach-benches --benches`, wants to know only that this runs.
    let in_earnest = arguments.iter().any(|argument| argument == "--bench");
    let folder = std::env::temp_dir().join(format!("kutzbach-families-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    build()?;
    let outcome = if in_earnest {
        measure(&folder)
    } else {
        family(&folder, "scissor", &[3], 1, scissor_lift).map(|_| ())
    };
    std::fs::remove_dir_all(&folder)?;
    outcome
}

fn measure(folder: &Path) -> Result<(), Box<dyn Error>> {
    println!("Median of {RUNS} runs, the fastest in brackets.\n");
    println!("| file | joints | text | JSON | peak memory |");
    println!("|---|---|---|---|---|");
    for name in FILES {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../mechanisms/{name}.urdf"));
        let joints = kutzbach::format::read_file(&file, &[])?
            .mechanism
            .joints()
            .len();
        row(&format!("`{name}`"), joints, &file, RUNS)?;
    }
    let sheet = |n| miura_sheet(n, n);
    family(folder, "scissor", &FEW_STAGES, RUNS, scissor_lift)?;
    let scissor = family(folder, "scissor", &STAGES, RUNS, scissor_lift)?;
    family(folder, "miura", &FEW_PANELS, RUNS, sheet)?;
    let miura = family(folder, "miura", &PANELS, RUNS, sheet)?;
    println!();
    println!(
        "| family | from | to | time grows with joints to the power | microseconds per joint |"
    );
    println!("|---|---|---|---|---|");
    for (name, points) in [("scissor", scissor), ("miura", miura)] {
        if let (Some(first), Some(last)) = (points.first(), points.last()) {
            println!(
                "| {name} | {} joints | {} joints | {:.2} | {:.0} … {:.0} |",
                first.0,
                last.0,
                exponent(&points),
                first.1 / first.0 * 1e6,
                last.1 / last.0 * 1e6
            );
        }
    }
    Ok(())
}

/// Writes the members of a family and times them; the numbers of joints and the seconds.
fn family(
    folder: &Path,
    name: &str,
    sizes: &[usize],
    runs: usize,
    member: impl Fn(usize) -> Result<Mechanism, MechanismError>,
) -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
    let mut points = Vec::new();
    for &size in sizes {
        let mechanism = member(size)?;
        let file = folder.join(format!("{name}_{size}.urdf"));
        std::fs::write(&file, kutzbach::format::write(&mechanism))?;
        let joints = mechanism.joints().len();
        let seconds = row(&format!("{name} {size}"), joints, &file, runs)?;
        points.push((joints as f64, seconds));
    }
    Ok(points)
}

/// Prints a row of the table; the median of the text report.
fn row(name: &str, joints: usize, file: &Path, runs: usize) -> Result<f64, Box<dyn Error>> {
    let text = times(file, "text", runs)?;
    let json = times(file, "json", runs)?;
    let memory = peak_memory(file)?
        .map_or_else(String::new, |bytes| format!("{:.0} MB", bytes as f64 / 1e6));
    println!(
        "| {name} | {joints} | {} | {} | {memory} |",
        in_brackets(&text),
        in_brackets(&json)
    );
    Ok(median(&text))
}

fn in_brackets(sorted: &[f64]) -> String {
    let fastest = sorted.first().copied().unwrap_or(f64::NAN);
    format!("{} ({})", duration(median(sorted)), duration(fastest))
}

fn duration(seconds: f64) -> String {
    if seconds < 0.1 {
        format!("{:.1} ms", seconds * 1e3)
    } else {
        format!("{seconds:.2} s")
    }
}

fn median(sorted: &[f64]) -> f64 {
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The folder of programs that this one was built into: `target/release`, or `target/debug` when only tried.
fn programs() -> Result<PathBuf, Box<dyn Error>> {
    let own = std::env::current_exe()?;
    let folder = own.ancestors().nth(2);
    Ok(folder.ok_or("a bench lies in `deps`")?.to_path_buf())
}

/// Builds the program beside this one: cargo builds no program of another package for a bench.
fn build() -> Result<(), Box<dyn Error>> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--locked", "--package", "kutzbach"]);
    if programs()?.ends_with("release") {
        cargo.arg("--release");
    }
    let done = cargo.current_dir(env!("CARGO_MANIFEST_DIR")).status()?;
    done.success()
        .then_some(())
        .ok_or_else(|| "the program does not build".into())
}

/// The program with what it is to do.
fn report(file: &Path, format: &str) -> Result<(PathBuf, Vec<OsString>), Box<dyn Error>> {
    let program = programs()?.join(format!("kutzbach{}", std::env::consts::EXE_SUFFIX));
    let arguments = ["report".into(), "--format".into(), format.into()];
    let all = arguments.into_iter().chain([file.as_os_str().to_owned()]);
    Ok((program, all.collect()))
}

/// Wall times of several runs in seconds, sorted.
fn times(file: &Path, format: &str, runs: usize) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut times = Vec::with_capacity(runs);
    for run in 0..=runs {
        let (program, arguments) = report(file, format)?;
        let started = Instant::now();
        let output = Command::new(program).args(arguments).output()?;
        let seconds = started.elapsed().as_secs_f64();
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into());
        }
        if run > 0 {
            times.push(seconds);
        }
    }
    times.sort_by(f64::total_cmp);
    Ok(times)
}

/// Peak resident memory in bytes; `None` without GNU time.
fn peak_memory(file: &Path) -> Result<Option<u64>, Box<dyn Error>> {
    let (program, arguments) = report(file, "text")?;
    let output = Command::new("/usr/bin/time")
        .args(["--format", "%M", "--"])
        .arg(program)
        .args(arguments)
        .stdout(Stdio::null())
        .output();
    let Ok(output) = output else { return Ok(None) };
    let said = String::from_utf8_lossy(&output.stderr);
    let kilobytes: Option<u64> = said
        .lines()
        .last()
        .and_then(|line| line.trim().parse().ok());
    Ok(kilobytes.map(|k| k * 1024))
}

/// The slope of the least-squares line through the points with both axes logarithmic.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let logarithms = || points.iter().map(|(x, y)| (x.ln(), y.ln()));
    let mean_x = logarithms().map(|(x, _)| x).sum::<f64>() / count;
    let mean_y = logarithms().map(|(_, y)| y).sum::<f64>() / count;
    let covariance: f64 = logarithms().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = logarithms().map(|(x, _)| (x - mean_x).powi(2)).sum();
    covariance / variance
}
