//! The stills of `docs/gallery` are those of `mechanisms/`, and the index says what the program says today.
//!
//! `bash .ci/pictures` makes them anew.

use crate::support;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use support::{assert_none, folder, sample};

/// Every file of a folder that git keeps of the gallery.
fn files(folder: &Path) -> BTreeMap<String, String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .filter(|path| path.extension().is_some_and(|e| e == "svg" || e == "md"))
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, std::fs::read_to_string(path).unwrap())
        })
        .collect()
}

/// What a still shows: its parts by name. Lines move by a tenth of a pixel with the last digit of a pose.
fn parts(still: &str) -> BTreeSet<&str> {
    let titles = still.split("<title>").skip(1);
    titles
        .filter_map(|rest| Some(rest.split_once("</title>")?.0))
        .collect()
}

/// What the program makes of these today.
fn made(mechanisms: &[PathBuf], name: &str) -> BTreeMap<String, String> {
    let made = support::empty_folder(name);
    let run = support::program()
        .args(["gallery", "--stills", "--title"])
        .args(["The mechanisms of kutzbach", "-o"])
        .arg(&made)
        .args(mechanisms)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{told}");
    files(&made)
}

#[test]
fn stills_and_sentences_are_those_of_today() {
    let mechanisms = support::mechanism_files(&folder("mechanisms"));
    let kept = files(&folder("docs/gallery"));
    assert_eq!(kept.len(), mechanisms.len() + 1);
    let some: Vec<PathBuf> = sample(mechanisms, 12).into_iter().map(|m| m.1).collect();
    let mut today = made(&some, "gallery_sample");
    let index = today.remove("README.md").unwrap();
    let old = |(name, still): &(&String, &String)| {
        kept.get(*name)
            .is_none_or(|kept| parts(kept) != parts(still))
    };
    let mut wrong: Vec<String> = today.iter().filter(old).map(|(n, _)| n.clone()).collect();
    let rows = index.lines().filter(|line| line.starts_with("<tr>"));
    let old = |row: &&str| !kept["README.md"].contains(*row);
    wrong.extend(rows.filter(old).map(str::to_owned));
    assert_none(&wrong);
}
