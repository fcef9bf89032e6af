//! Answers do not depend on the clock: a budget is counted in work.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// Files that may look at the clock, and why that decides no answer.
const SHOWN_ONLY: [&str; 16] = [
    // How long steps took, where that is asked for.
    "crates/algebra/src/strategy/divide.rs",
    "crates/report/src/assemble.rs",
    // A bar, or a line, while work goes on.
    "src/cli/progress.rs",
    "src/cli/files.rs",
    "src/cli/graph.rs",
    "src/cli/simulate/log.rs",
    // How often a sweep keeps what is done, and looks for Ctrl-C.
    "src/cli/pool.rs",
    "src/cli/sweep/sink.rs",
    // How long after Ctrl-C work is waited for.
    "src/cli/assemble.rs",
    "src/cli/exact.rs",
    "src/cli/simulate/aside.rs",
    // How long simulated steps took, where that is asked for.
    "crates/simulate/src/accuracy/clock.rs",
    "crates/simulate/src/cost.rs",
    "crates/simulate/src/scene_run.rs",
    "crates/simulate/src/verification/driven_motion.rs",
    "crates/simulate/src/verification/pushing.rs",
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            if name != "tests" && name != "target" {
                sources(&path, found);
            }
        } else if name.ends_with(".rs") && !name.contains("tests") {
            found.push(path);
        }
    }
}

#[test]
fn no_engine_looks_at_the_clock() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    sources(&root.join("src"), &mut files);
    sources(&root.join("crates"), &mut files);
    let mut looking: Vec<String> = files
        .iter()
        .filter(|path| {
            let text = std::fs::read_to_string(path).unwrap();
            let code = text.lines().filter(|l| !l.trim_start().starts_with("//"));
            let clocks = ["Instant", "SystemTime", "recv_timeout", "park_timeout"];
            code.flat_map(|l| l.split(|c: char| !c.is_alphanumeric() && c != '_'))
                .any(|word| clocks.contains(&word))
        })
        .map(|path| {
            let path = path.strip_prefix(root).unwrap().components();
            let parts: Vec<_> = path.map(|c| c.as_os_str().to_string_lossy()).collect();
            parts.join("/")
        })
        .collect();
    looking.sort();
    assert!(files.len() > 400 && !looking.is_empty());
    looking.retain(|path| !SHOWN_ONLY.contains(&path.as_str()));
    assert!(looking.is_empty(), "{looking:?}");
}

/// Budgets that end in the middle of boxes, and of a basis.
const ENDING: [[&str; 4]; 2] = [
    [
        "assemble",
        "tests/zoo/general_6r_rigid.urdf",
        "--budget",
        "0.5",
    ],
    ["exact", "mechanisms/delta.urdf", "--time", "0.5"],
];

fn started(words: &[&str]) -> Child {
    crate::support::program()
        .args(words)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn answer(child: Child) -> String {
    let output = child.wait_with_output().unwrap();
    String::from_utf8(output.stdout).unwrap()
}

#[cfg(unix)]
fn signal(child: &Child, name: &str) {
    let script = format!("kill -{name} \"$1\"");
    let sent = Command::new("sh")
        .args(["-c", &script, "sh", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success(), "it had ended before");
}

#[cfg(unix)]
#[test]
fn a_process_that_is_stopped_for_a_while_answers_the_same() {
    for words in ENDING {
        let usual = answer(started(&words));
        assert!(usual.contains("the time limit was reached"), "{usual}");
        let child = started(&words);
        std::thread::sleep(Duration::from_millis(50));
        signal(&child, "STOP");
        // Longer than the budget, and than what used to be waited for beyond it.
        std::thread::sleep(Duration::from_secs(3));
        signal(&child, "CONT");
        assert_eq!(answer(child), usual);
    }
}
