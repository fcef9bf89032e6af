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

/// A package holds no file from outside its crate; `cp docs/src/definitions.md crates/report/` copies the page again.
#[test]
fn the_definitions_in_the_package_are_those_of_the_book() {
    let read = |path: &str| std::fs::read_to_string(folder(path)).unwrap();
    let (book, package) = (
        read("docs/src/definitions.md"),
        read("crates/report/definitions.md"),
    );
    assert!(
        book == package,
        "docs/src/definitions.md and crates/report/definitions.md differ"
    );
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

/// Words are made from facts and never read for facts: what a sentence says has a kind, or a field, of its own.
#[test]
fn no_code_reads_a_sentence_of_the_report() {
    let sentences = [
        "warning",
        "message",
        "text",
        "certificate",
        "why",
        "note",
        "reason",
    ];
    let readings = [
        "contains",
        "split_once",
        "starts_with",
        "ends_with",
        "strip_prefix",
        "strip_suffix",
    ];
    let read: Vec<String> = sentences
        .iter()
        .flat_map(|sentence| readings.map(|reading| format!("{sentence}.{reading}(")))
        .collect();
    // Paths of files in what a reader of xacro says beside a place; a name at the beginning of a row that has a column for it.
    let known = ["warning.split_once(AT)", "row.text.starts_with(joint)"];
    let reads = |line: &&str| {
        read.iter().any(|way| line.contains(way)) && !known.iter().any(|own| line.contains(own))
    };
    let mut found = Vec::new();
    for path in sources("crates/report/src") {
        let text = std::fs::read_to_string(&path).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        // Whole files of tests, those that cut any text into lines or mark code in it, and messages of other tools.
        if name.ends_with("tests") || ["page", "blocks", "words", "escape"].contains(&name.as_str())
        {
            continue;
        }
        for line in code.lines().filter(reads) {
            found.push(format!("{}: {}", path.display(), line.trim()));
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

fn sources(under: &str) -> Vec<std::path::PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder(under)];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => folders.push(path),
                false if path.extension().is_some_and(|e| e == "rs") => found.push(path),
                false => {}
            }
        }
    }
    found
}

/// The strings between double quotes, in the order of the text.
fn literals(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut open: Option<String> = None;
    let mut characters = text.chars();
    while let Some(c) = characters.next() {
        match (open.take(), c) {
            (None, '"') => open = Some(String::new()),
            (None, _) => {}
            (Some(literal), '"') => found.push(literal),
            (Some(mut literal), '\\') => {
                let escaped = characters.next();
                literal.extend(escaped.map(|e| if e == 'n' { '\n' } else { e }));
                open = Some(literal);
            }
            (Some(mut literal), c) => {
                literal.push(c);
                open = Some(literal);
            }
        }
    }
    found
}

/// What is moved elsewhere would otherwise be missed where the mutations are run next: a name, a file, the text that has to occur once in it,
/// and another one.
#[test]
fn every_mutation_finds_its_text() {
    let script = std::fs::read_to_string(folder("tests/stability/mutations.py")).unwrap();
    let (_, list) = script.split_once("MUTATIONS = [").unwrap();
    let (list, _) = list.split_once("\n]").unwrap();
    let found = literals(list);
    let mutations = found.chunks_exact(4);
    assert!(mutations.len() > 15 && mutations.remainder().is_empty());
    for mutation in mutations {
        let text = std::fs::read_to_string(folder(&mutation[1])).unwrap();
        let count = text.matches(&mutation[2]).count();
        assert_eq!(count, 1, "{}: {}", mutation[0], mutation[1]);
    }
}
