//! The same file gives the same bytes: run after run, with one thread or four, alone or beside others.

use crate::support;

use std::path::{Path, PathBuf};
use support::{assert_none, folder, in_parallel};

fn files(name: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder(name)).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "urdf"));
    files.sort();
    files
}

fn report(file: &Path, form: &str, threads: &str) -> Vec<u8> {
    let run = crate::support::program()
        .args(["report", "--evidence", "--format", form])
        .arg(file)
        .env("RAYON_NUM_THREADS", threads)
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", file.display());
    run.stdout
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn reports_do_not_depend_on_the_run_or_the_threads() {
        let mut all = files("tests/zoo");
        all.extend(files("mechanisms"));
        let all = crate::support::sample(all, 6);
        let differing = in_parallel(&all, |file| {
            let differs = report(file, "json", "1") != report(file, "json", "4")
                || report(file, "text", "4") != report(file, "text", "1");
            differs.then(|| file.display().to_string())
        });
        assert_none(&differing.into_iter().flatten().collect::<Vec<_>>());
    }
}
