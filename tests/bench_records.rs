//! The scripts of `benches/`, and the record of counted instructions. No time and no count is asserted.
#[allow(dead_code)] // the benches use the rest
#[path = "../benches/stages/cases.rs"]
mod cases;
#[allow(dead_code)]
#[path = "../benches/stages/jobs.rs"]
mod jobs;
#[path = "../benches/instructions/list.rs"]
mod list;
use crate::support;

use serde_json::Value;
use std::fs;
use std::process::Command;
use support::folder;

#[test]
fn the_record_has_a_count_for_every_case() {
    let text = fs::read_to_string(folder("benches/record/instructions.json")).unwrap();
    let record: Value = serde_json::from_str(&text).unwrap();
    let counts = record["instructions"].as_object().unwrap();
    let kept: usize = counts.values().map(|c| c.as_object().unwrap().len()).sum();
    assert_eq!(kept, list::all().len());
    for (stage, case, _) in list::all() {
        let count = record["instructions"][stage][case].as_u64();
        assert!(count.is_some_and(|count| count > 0), "{stage}/{case}");
    }
}

/// What is known of some cases: joints, loops' parts, freedoms, a regular pose, orders and branches of germs, dimensions.
const KNOWN: [(&str, &str, usize); 16] = [
    ("parse", "bennett", 4),
    ("parse", "stewart", 18),
    ("parse", "scissor 100", 304),
    ("graph", "bennett", 1),
    ("assemble", "scissor 100", 1),
    ("rank", "bennett", 1),
    ("rank", "stewart", 6),
    ("rank", "scissor 100", 1),
    ("chart", "goldberg", 1),
    ("germ series", "flat kite", 2),
    ("germ branches", "flat kite", 2),
    ("germ branches", "cusp", 1),
    ("germ branches", "flat miura", 4),
    ("exact answer", "bennett", 1),
    ("exact answer", "oldham", 1),
    ("analyse", "stewart", 6),
];

/// Every case can be made ready and run, and finds something: of those above, what is known.
#[test]
fn every_case_finds_what_is_known() {
    let found = support::in_parallel(&list::all(), |(name, case, stage)| {
        (*name, *case, stage(case)())
    });
    let nothing = found.iter().filter(|(_, _, found)| *found == 0);
    let lost = KNOWN.iter().filter(|known| !found.contains(known));
    let wrong: Vec<String> = nothing.chain(lost).map(|w| format!("{w:?}")).collect();
    support::assert_none(&wrong);
}

/// Members of the families have an answer, each as a row and as a file.
#[test]
fn members_of_the_families_are_analysed() {
    support::in_parallel(&list::sweeps(), |(name, case, stage)| {
        let mut job = stage(case);
        let found: usize = (0..5).map(|_| job()).sum();
        assert_eq!(found, 5, "{name}/{case}");
    });
}

/// What the list says of the two charts.
#[test]
fn one_chart_is_decided_in_double_precision_and_one_is_not() {
    assert_eq!(jobs::CHARTS.map(jobs::chart_bits), [53, 106]);
}

/// The scripts' own checks.
#[test]
#[ignore = "needs Python: KUTZBACH_PYTHON"]
fn the_scripts_do_what_they_say() {
    let python = std::env::var_os("KUTZBACH_PYTHON").filter(|name| !name.is_empty());
    let run = Command::new(python.unwrap_or_else(|| "python3".into()))
        .arg(folder("benches/test_scripts.py"))
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}");
    assert!(said.contains("OK"), "{said}");
}
