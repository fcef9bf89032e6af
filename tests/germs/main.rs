//! Germs of known branches, built as mechanisms: none may be contradicted, and how many are decided is told by kind.
//!
//! The table is written into `docs/src/mobility.md` and compared with what is found:
//!
//! ```text
//! KUTZBACH_UPDATE=1 cargo corpus germs
//! ```
//!
//! `KUTZBACH_GERMS=192..2000 cargo corpus germs` draws others, and does not compare the table.

mod arm;
mod kinds;
mod polynomial;

use crate::support;
use kinds::{Draw, Germ, KINDS, disguised};
use kutzbach::mobility::Analysis;
use support::{assert_none, folder, in_parallel};

/// The marks between which the table stands.
/// The germs of the table in the documentation.
const OF_THE_TABLE: std::ops::Range<u64> = 0..192;

const MARKS: [&str; 2] = ["<!-- germs: begin -->", "<!-- germs: end -->"];

/// What an analysis says of a germ.
struct Seen {
    seed: u64,
    kind: &'static str,
    seconds: f64,
    decided: bool,
    branches: bool,
    why: String,
    wrong: Vec<String>,
}

fn drawn(seed: u64) -> Germ {
    let mut draw = Draw::new(seed);
    let germ = KINDS[(seed % KINDS.len() as u64) as usize](&mut draw);
    disguised(germ, &mut draw)
}

fn look(seed: u64) -> Seen {
    let germ = drawn(seed);
    let mechanism = arm::mechanism(&format!("germ_{seed}"), &germ.polynomials);
    let start = std::time::Instant::now();
    let analysis = support::analysis(&mechanism);
    let mobility = &analysis.mobility;
    Seen {
        seed,
        kind: germ.kind,
        seconds: start.elapsed().as_secs_f64(),
        decided: mobility.finite().is_some(),
        branches: analysis.branches.is_some(),
        why: mobility.why.join("; "),
        wrong: contradictions(&germ, &analysis)
            .into_iter()
            .map(|text| format!("{} of seed {seed}: {text}", germ.kind))
            .collect(),
    }
}

/// Where an analysis says other than what is true.
fn contradictions(germ: &Germ, analysis: &Analysis) -> Vec<String> {
    let mobility = &analysis.mobility;
    let mut told = Vec::new();
    let finite = germ.branches.first().copied().unwrap_or(0);
    if let (Some(low), Some(high)) = mobility.bounds
        && !(low..=high).contains(&finite)
    {
        told.push(format!("finite mobility {low} … {high}, true {finite}"));
    }
    if let Some(branches) = analysis
        .branches
        .as_ref()
        .filter(|_| mobility.finite().is_some())
    {
        let mut found: Vec<usize> = branches.iter().map(|b| b.dimension).collect();
        found.sort_unstable_by(|a, b| b.cmp(a));
        if found != germ.branches {
            told.push(format!("branches {found:?}, true {:?}", germ.branches));
        }
    }
    if let (Some(found), Some(meeting)) = (mobility.kind, germ.meeting)
        && found != meeting
    {
        told.push(format!("{found:?}, true {meeting:?}"));
    }
    told
}

fn table(seen: &[Seen]) -> String {
    let mut kinds: Vec<&str> = seen.iter().map(|s| s.kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let rows = kinds.iter().map(|kind| {
        let of = || seen.iter().filter(|s| s.kind == *kind);
        format!(
            "| {kind} | {} | {} | {} |",
            of().count(),
            of().filter(|s| s.decided).count(),
            of().filter(|s| s.branches).count()
        )
    });
    let head = "| germ | drawn | mobility decided | branches told |\n|---|---|---|---|".to_owned();
    std::iter::once(head)
        .chain(rows)
        .collect::<Vec<_>>()
        .join("\n")
}

/// One of every kind.
#[test]
fn no_kind_is_contradicted() {
    let seeds: Vec<u64> = (0..KINDS.len() as u64).collect();
    let seen = in_parallel(&seeds, |seed| look(*seed));
    let wrong: Vec<String> = seen.iter().flat_map(|s| s.wrong.clone()).collect();
    assert_none(&wrong);
    assert!(seen.iter().filter(|s| s.decided).count() >= 12);
}

/// Exact equations of this tacnode would multiply two poses of ten thousands of terms each: they are not written, and series decide.
#[test]
fn equations_of_too_many_terms_are_not_written() {
    let seen = look(211);
    assert!(seen.decided && seen.wrong.is_empty(), "{:?}", seen.wrong);
}

/// What double precision does not tell: a cone and planes as narrow as 1e-9, a double line that series in rounded coordinates of the
/// kernel take for two, planes and lines at 1e-9 with small doubles for coefficients.
#[test]
fn narrow_and_double_germs_are_decided() {
    for seed in [13, 17, 140, 1276, 1464] {
        let seen = look(seed);
        let kind = seen.kind;
        assert!(
            seen.decided && seen.wrong.is_empty(),
            "{kind}: {:?}",
            seen.wrong
        );
    }
}

mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn germs_of_known_branches_are_not_contradicted() {
        let seeds = match std::env::var("KUTZBACH_GERMS") {
            Ok(range) => {
                let (first, end) = range.split_once("..").expect("first..end");
                (first.parse().unwrap()..end.parse().unwrap()).collect()
            }
            Err(_) => support::sample(OF_THE_TABLE, 3),
        };
        let seen = in_parallel(&seeds, |seed| look(*seed));
        let found = table(&seen);
        println!("{found}");
        for open in seen.iter().filter(|s| !s.decided) {
            println!("{} of seed {}: {}", open.kind, open.seed, open.why);
        }
        for slow in seen.iter().filter(|s| s.seconds > 5.0) {
            let Seen { kind, seed, .. } = slow;
            println!("{kind} of seed {seed}: {:.0} s", slow.seconds);
        }
        let wrong: Vec<String> = seen.iter().flat_map(|s| s.wrong.clone()).collect();
        assert_none(&wrong);
        if seeds.iter().copied().eq(OF_THE_TABLE) {
            compare_with_the_page(&found);
        }
    }

    /// Of fewer or of other germs there is another table.
    fn compare_with_the_page(found: &str) {
        let path = folder("docs/src/mobility.md");
        let page = std::fs::read_to_string(&path).unwrap();
        let (head, rest) = page
            .split_once(MARKS[0])
            .expect("the page has a place for it");
        let (between, tail) = rest.split_once(MARKS[1]).expect("the place has an end");
        if std::env::var_os("KUTZBACH_UPDATE").is_some() {
            let [begin, end] = MARKS;
            std::fs::write(&path, format!("{head}{begin}\n\n{found}\n\n{end}{tail}")).unwrap();
            return;
        }
        assert_eq!(
            between.trim(),
            found,
            "to write it anew: KUTZBACH_UPDATE=1 bash .ci/on-demand whole"
        );
    }
}
