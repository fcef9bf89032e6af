//! Ctrl-C on the command line: a line, exit code 130, and no answer that is not whole.
#![cfg(unix)]

use crate::support::{empty_folder, folder, press_ctrl_c, program};
use kutzbach::format::ReadOptions;
use kutzbach::mobility::AnalysisOptions;
use kutzbach::sweep::{Family, Form, MeasuredFile, Over, Plan, Shard, Table};
use std::process::{Output, Stdio};
use std::time::{Duration, Instant};

/// A fifth of a second is wanted; the rest is what a machine with much to do may add.
const SOON: Duration = Duration::from_secs(5);

/// What takes some ten seconds to be analysed in a build for tests.
const LONG: &str = "tests/zoo/wren_platform_6US.urdf";

/// Runs the program and presses Ctrl-C a while after something is the case; what it printed.
fn interrupted(words: &[&str], begun: impl Fn() -> bool, after: Duration) -> Output {
    let process = program()
        .args(words)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let patience = Instant::now() + Duration::from_secs(60);
    while !begun() {
        assert!(Instant::now() < patience, "{words:?} did not begin");
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(after);
    press_ctrl_c(&process);
    let pressed = Instant::now();
    let output = process.wait_with_output().unwrap();
    let took = pressed.elapsed();
    assert!(took < SOON, "{words:?} took {took:?}");
    assert_eq!(output.status.code(), Some(130), "{words:?}");
    output
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn an_analysis_and_a_trace_end_with_a_line_and_without_an_answer() {
    for command in ["report", "trace", "simulate"] {
        let output = interrupted(&[command, LONG], || true, Duration::from_millis(400));
        assert!(output.stdout.is_empty(), "{}", text(&output.stdout));
        let said = text(&output.stderr);
        assert!(
            said.contains("interrupted: there is no answer"),
            "{command}: {said}"
        );
    }
}

#[test]
fn an_interrupted_report_leaves_its_file_untouched() {
    let place = empty_folder("interrupted_report");
    let file = place.join("report.txt");
    std::fs::write(&file, "as it was\n").unwrap();
    let name = file.display().to_string();
    let words = ["report", LONG, "-o", &name];
    interrupted(&words, || true, Duration::from_millis(400));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "as it was\n");
    assert_eq!(std::fs::read_dir(&place).unwrap().count(), 1);
}

#[test]
fn a_sweep_keeps_whole_rows() {
    const SWEPT: &str = "mechanisms/bennett_spoiled.urdf";
    // It takes minutes.
    const OVER: &str = "off=0..1:200001";
    let file = empty_folder("interrupted_sweep").join("rows.csv");
    let name = file.display().to_string();
    let words = [
        "sweep",
        SWEPT,
        "--over",
        OVER,
        "--depth",
        "everything",
        "-o",
        &name,
    ];
    let output = interrupted(&words, || file.exists(), Duration::from_millis(400));
    let said = text(&output.stderr);
    assert!(said.contains("interrupted"), "{said}");
    assert!(said.contains("the same command goes on"), "{said}");
    let path = folder(SWEPT);
    let source = MeasuredFile {
        bytes: std::fs::read(&path).unwrap(),
        file: SWEPT.to_owned(),
        base: Some(path),
        options: ReadOptions::default(),
    };
    let plan = Plan::new(vec![Over::read(OVER).unwrap()], None).unwrap();
    let family = Family::new(source, plan, AnalysisOptions::default()).unwrap();
    let table = Table::new(&family, Shard::default(), Form::Csv);
    let written = std::fs::read_to_string(&file).unwrap();
    let rows = written.strip_prefix(&table.head()).unwrap();
    let rows: Vec<&str> = rows.split_inclusive('\n').collect();
    assert!(rows.len() < 200_001);
    // Those under way at the end are the ones that could be broken.
    let last = rows.len().saturating_sub(16);
    for (index, row) in rows.iter().enumerate().skip(last) {
        let own = family.row(index as u64).unwrap();
        assert_eq!(*row, table.line(&own));
    }
}
