//! The stills of `docs/gallery` are those of `mechanisms/`, and the index says what the program says today.
//!
//! `bash .ci/pictures` makes them anew.

use crate::support;

use std::collections::BTreeMap;
use std::path::Path;
use support::{assert_none, folder};

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

#[test]
fn the_gallery_is_that_of_today() {
    let made = support::empty_folder("gallery_stills");
    let run = support::program()
        .args(["gallery", "mechanisms", "--stills", "--title"])
        .args(["The mechanisms of kutzbach", "-o"])
        .arg(&made)
        .current_dir(folder(""))
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{told}");
    let (today, kept) = (files(&made), files(&folder("docs/gallery")));
    let old = |name: &&String| today.get(*name) != kept.get(*name);
    let names = today.keys().chain(kept.keys());
    let wrong: Vec<String> = names.filter(old).cloned().collect();
    assert_none(&wrong);
    assert!(today.len() > 100);
}
