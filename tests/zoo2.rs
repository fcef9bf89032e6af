//! Singular poses that look like others: nodes far smaller than a search sees at first, branches that touch to a high order, poses
//! that look rigid and are not.
//!
//! All of their answers are proven. None may be contradicted; to leave one open is no error.

use crate::support;

use serde_json::Value;
use support::folder;

#[test]
fn no_known_fact_is_contradicted() {
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_kutzbach"))
        .args(["check", "--format", "json", "tests/zoo2"])
        .current_dir(folder(""))
        .output()
        .unwrap();
    let told: Value = serde_json::from_slice(&run.stdout).unwrap();
    let count = |what: &str| told[what].as_u64().unwrap();
    for what in ["without_expectation", "unreadable"] {
        assert_eq!(told[what].as_array().unwrap().len(), 0, "{what}");
    }
    println!(
        "{} facts found, {} left open",
        count("right"),
        count("open")
    );
    assert_eq!(count("wrong"), 0, "{told:#}");
    assert!(count("right") > count("open"), "{told:#}");
}
