//! How the project is built: what no compiler complains of.
use crate::support::folder;
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// A file that `it.rs` does not name would never be compiled, and its tests never run.
#[test]
fn every_file_of_tests_is_part_of_the_program() {
    let named: BTreeSet<&str> = include_str!("it.rs")
        .lines()
        .filter_map(|line| line.strip_prefix("mod ")?.strip_suffix(';'))
        .collect();
    for entry in std::fs::read_dir(folder("tests")).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap();
        let tests = path.extension().is_some_and(|e| e == "rs") && stem != "it"
            || ["main.rs", "mod.rs"].iter().any(|f| path.join(f).exists());
        assert!(!tests || named.contains(stem), "it.rs has no `mod {stem};`");
    }
}

/// The crates that a build compiles, with their features.
fn crates(edges: &str, more: &[&str]) -> BTreeMap<String, BTreeSet<String>> {
    let run = Command::new(env!("CARGO"))
        .args(["tree", "--locked", "--offline", "--prefix", "none"])
        .args(["--format", "{p}\t{f}", "--edges", edges])
        .args(more)
        .current_dir(folder(""))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}");
    let text = String::from_utf8(run.stdout).unwrap();
    text.lines()
        .filter_map(|line| line.split_once('\t'))
        .map(|(name, features)| {
            let features = features.trim_end_matches(" (*)").split(',');
            (name.to_owned(), features.map(str::to_owned).collect())
        })
        .collect()
}

/// Where a dependency of the tests turned a feature on, `cargo run` and `cargo test` would each compile the whole library.
#[test]
fn the_program_and_its_tests_are_built_with_the_same_features() {
    let program = crates("normal,build", &[]);
    let tests = crates("normal,build,dev", &[]);
    assert!(program.len() > 50);
    for (name, own) in program {
        assert_eq!(own, tests[&name], "{name}");
    }
}

/// Who wants answers and nothing else compiles no physics engine, no writer of logs and no command line.
#[test]
fn the_analysis_alone_needs_few_crates() {
    let alone = ["--package", "kutzbach", "--no-default-features"];
    let found = crates("normal,build", &alone);
    assert!(found.len() <= 110, "{} crates", found.len());
    let names: Vec<&str> = found.keys().filter_map(|k| k.split(' ').next()).collect();
    for dear in ["rapier3d-f64", "mcap", "foxglove", "clap", "miette"] {
        assert!(!names.contains(&dear), "{dear}");
    }
}
