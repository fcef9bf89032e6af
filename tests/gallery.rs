//! The gallery in `docs/gallery` is that of `mechanisms/`.
//!
//! ```text
//! cargo run --release -- gallery mechanisms -o docs/gallery --title "The mechanisms of kutzbach"
//! ```

use crate::support;

use std::collections::BTreeSet;
use std::path::Path;
use support::folder;

fn stems(folder: &Path, extension: &str) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .filter(|path| path.extension().is_some_and(|e| e == extension))
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect()
}

#[test]
fn every_mechanism_has_its_page_and_no_page_is_left_over() {
    let mut pages = stems(&folder("docs/gallery"), "html");
    assert!(pages.remove("index"));
    assert_eq!(pages, stems(&folder("mechanisms"), "urdf"));
    let index = std::fs::read_to_string(folder("docs/gallery/index.html")).unwrap();
    for page in &pages {
        assert!(index.contains(&format!("href=\"{page}.html\"")), "{page}");
    }
}

#[test]
fn the_gallery_has_the_script_and_the_style_of_today() {
    let read = |name: &str| std::fs::read_to_string(folder(name)).unwrap();
    let advice = "make it again: see the head of tests/gallery.rs";
    assert!(
        read("docs/gallery/viewer.js") == read("viewer/dist/viewer.js"),
        "{advice}"
    );
    assert!(
        read("docs/gallery/page.css") == kutzbach::report::html::style(),
        "{advice}"
    );
}
