//! The cases whose instructions are counted: those that must not regress.

use super::cases::FAMILIES;
use super::jobs::{self, Job};
use kutzbach::mobility::Depth;

/// What makes a case of a stage ready.
pub type Stage = fn(&str) -> Job;

/// Stage, case, and what makes it ready; in the order in which data flows.
pub fn all() -> Vec<(&'static str, &'static str, Stage)> {
    let stages: [(&str, Stage, &[&str]); 13] = [
        ("parse", jobs::parse, &["bennett", "stewart", "scissor 100"]),
        ("graph", jobs::graph, &["bennett", "stewart", "scissor 100"]),
        (
            "assemble",
            jobs::assemble,
            &["bennett", "stewart", "scissor 100"],
        ),
        (
            "rank",
            jobs::rank,
            &["bennett", "stewart", "steffen", "scissor 100"],
        ),
        ("chart", jobs::chart, &jobs::CHARTS),
        ("germ series", jobs::germ_series, &jobs::GERMS),
        ("germ branches", jobs::germ_branches, &jobs::GERMS),
        ("exact equations", jobs::exact_equations, &jobs::EXACTS),
        ("exact answer", jobs::exact_answers, &jobs::EXACTS),
        (
            "analyse",
            jobs::whole_analysis,
            &["bennett", "sarrus", "stewart"],
        ),
        ("trace", jobs::traced, &["four bar", "bennett"]),
        ("simulate", jobs::simulated, &["four bar", "bennett"]),
        ("report", jobs::written_report, &["bennett", "stewart"]),
    ];
    stages
        .into_iter()
        .flat_map(|(stage, job, cases)| cases.iter().map(move |case| (stage, *case, job)))
        .collect()
}

/// Rows of sweeps, beside files by themselves: a run is of one member. They are counted side by side when asked for, and are in no record.
pub fn sweeps() -> Vec<(&'static str, &'static str, Stage)> {
    let stages: [(&str, Stage); 4] = [
        ("rank of a file", |case| jobs::file(case, Depth::Rank)),
        ("rank of a row", |case| jobs::row(case, Depth::Rank)),
        ("verdict of a file", |case| jobs::file(case, Depth::Verdict)),
        ("verdict of a row", |case| jobs::row(case, Depth::Verdict)),
    ];
    let of_family = |case| stages.map(|(stage, job)| (stage, case, job));
    FAMILIES.into_iter().flat_map(of_family).collect()
}
