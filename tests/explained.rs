//! Whoever does not know a word of a table asks `kutzbach explain`: it knows the head of every column.

use crate::support::folder;
use kutzbach::report::definitions::find;
use std::path::Path;

/// Heads that mean what they mean anywhere.
const PLAIN: [&str; 24] = [
    "",
    "name",
    "n",
    "file",
    "field",
    "expected",
    "found",
    "right",
    "wrong",
    "open",
    "stage",
    "ms",
    "work",
    "definition",
    "also explains",
    "poses/s",
    "240 poses",
    "steps/s",
    "per step",
    "per simulated second",
    "a step takes",
    "times that without",
    "moved at most",
    "when pushed at",
];

fn sources(folder: &Path, found: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(std::fs::read_to_string(&path).unwrap());
        }
    }
}

#[test]
fn every_head_of_a_column_is_explained() {
    let mut texts = Vec::new();
    for under in [
        "crates/report/src/text",
        "crates/report/src/exact",
        "crates/report/src/accuracy",
        "src/cli",
    ] {
        sources(&folder(under), &mut texts);
    }
    let mut heads: Vec<String> = texts
        .iter()
        .flat_map(|text| text.split(".column(\"").skip(1))
        .map(|rest| rest.split('"').next().unwrap().to_owned())
        .collect();
    assert!(heads.len() > 50, "{} heads", heads.len());
    // Heads that are computed.
    let counts = [
        "Kutzbach",
        "generic",
        "this pose",
        "finite",
        "redundant",
        "rank",
        "pose",
        "margin",
    ];
    let joints = ["range", "in motion", "at this pose"];
    heads.extend(counts.iter().chain(&joints).map(|head| (*head).to_owned()));
    let unknown: Vec<&String> = heads
        .iter()
        .filter(|head| {
            let word = head.split(" (").next().unwrap();
            !PLAIN.contains(&word) && find(word).is_none()
        })
        .collect();
    assert!(unknown.is_empty(), "nothing explains {unknown:?}");
}

/// What a reader brings along from elsewhere.
#[test]
fn synonyms_of_other_books_are_explained() {
    for word in [
        "DOF",
        "degrees of freedom",
        "motor",
        "actuator",
        "wrench",
        "dead centre",
        "mobility",
        "margin",
        "extreme position",
        "statically indeterminate",
        "overconstrained",
        "infinitesimally mobile",
        "motion branch",
        "Grübler",
        "parallel singularity",
        "independent sub-mechanism",
        "irreducible component",
        "crank",
        "rocker",
        "transmission angle",
        "pitch",
        "range",
    ] {
        assert!(find(word).is_some(), "nothing explains `{word}`");
    }
}

/// What `graph`, `exact` and `assemble` print, and what the sources call it.
#[test]
fn words_of_all_commands_are_explained() {
    for word in [
        "Groebner",
        "degrevlex",
        "lex",
        "canonical form",
        "positional form",
        "tree form",
        "brute force",
        "divide and conquer",
        "incremental instancing",
        "case",
        "S-polynomials",
        "unit quaternion",
        "rigid cluster",
        "not settled",
        "conditions",
        "components",
        "block",
        "bridge",
        "height",
        "chord",
        "cord",
        "ring sum",
        "shortest cycle basis",
        "incidence tree",
        "standard collection",
        "implied",
        "weight",
        "covering set",
        "sum of depths",
        "root",
        "placed by",
        "seam graph",
        "well-formed selection",
        "over-constrained",
        "under-constrained",
        "well-constrained",
        "freedoms left",
        "rigid in itself",
        "triconnected",
        "solved at once",
        "s-tree",
        "boxes",
        "multiplicity",
        "closes within rounding",
        "left out",
        "held",
        "travel",
        "turns",
        "arclength",
        "input singularity",
        "characteristic length",
        "residue",
        "carrier",
        "mimic",
        "binds",
    ] {
        assert!(find(word).is_some(), "nothing explains `{word}`");
    }
}
