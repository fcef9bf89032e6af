//! Linkages as programs write them: families that move, and look-alikes that do not, in the frames and the digits of many writers.
//!
//! A family draws a linkage in world coordinates to the last digit of doubles (`families.rs`), frames say where links have their own
//! (`frames.rs`), and a writer prints every number in its manner (`printing.rs`). The file is read again, and its verdict has to be that of
//! the linkage drawn: what the digits took away was not meant to be there. Look-alikes are spoiled by far more than any writer rounds.

mod families;
mod frames;
mod known;
mod printing;

use crate::support::{analysis, in_parallel};
use families::{FAMILIES, Family};
use frames::{FRAMES, Setting, written};
use kutzbach::matrix::SplitMix64;
use kutzbach::mobility::Verdict;
use printing::{WRITERS, Writer};
use std::collections::BTreeMap;
use std::time::Instant;

/// One file.
struct Case {
    family: &'static Family,
    writer: &'static Writer,
    setting: Setting,
    seed: u64,
}

/// What came of it.
struct Outcome {
    name: String,
    writer: &'static str,
    said: Option<usize>,
    finite: usize,
    verdict: Verdict,
    seconds: f64,
    text: String,
}

impl Outcome {
    fn right(&self) -> bool {
        self.said == Some(self.finite)
    }

    /// Wrong, and nothing said of doubt.
    fn confident(&self) -> bool {
        self.said.is_some() && !self.right()
    }

    fn line(&self) -> String {
        let Self { name, verdict, .. } = self;
        format!(
            "{name}: {verdict:?} {:?} instead of {}",
            self.said, self.finite
        )
    }
}

/// A look-alike is spoiled by so many times what single numbers are off by: several may share it.
const CLEARLY: f64 = 15.0;

fn tried(case: &Case) -> Outcome {
    let mut random = SplitMix64::new(case.seed);
    let least = CLEARLY * case.writer.off_by();
    let drawn = std::iter::repeat_with(|| (case.family.draw)(&mut random))
        .find(|drawn| drawn.spoiled.is_none_or(|spoiled| spoiled >= least))
        .unwrap();
    let text = written(&drawn, case.setting, case.writer, &mut random);
    let reading = kutzbach::format::read(&text, "written.urdf", &[]).unwrap();
    let started = Instant::now();
    let mobility = analysis(&reading.mechanism).mobility;
    Outcome {
        name: format!(
            "{} {} {} {}",
            case.family.name,
            case.writer.name,
            case.setting.name(),
            case.seed
        ),
        writer: case.writer.name,
        said: mobility.finite(),
        finite: drawn.finite,
        verdict: mobility.verdict,
        seconds: started.elapsed().as_secs_f64(),
        text,
    }
}

fn all_cases(seeds: std::ops::Range<u64>) -> Vec<Case> {
    let mut cases = Vec::new();
    let asked = std::env::var("KUTZBACH_WRITER").unwrap_or_default();
    for writer in WRITERS.iter().filter(|w| w.name.contains(&asked)) {
        for family in &FAMILIES {
            for (index, setting) in FRAMES.into_iter().enumerate() {
                cases.extend(seeds.clone().map(|seed| Case {
                    family,
                    writer,
                    setting,
                    seed: 1000 * seed + index as u64,
                }));
            }
        }
    }
    cases
}

/// Writer, right, undecided, unassembled, wrong and confident, of so many, slowest.
fn table(outcomes: &[Outcome]) -> String {
    let mut rows: BTreeMap<&str, [usize; 5]> = BTreeMap::new();
    let mut slowest: BTreeMap<&str, f64> = BTreeMap::new();
    for outcome in outcomes {
        let row = rows.entry(outcome.writer).or_default();
        row[0] += usize::from(outcome.right());
        row[1] += usize::from(outcome.verdict == Verdict::Undecided);
        row[2] += usize::from(outcome.verdict == Verdict::Unassembled);
        row[3] += usize::from(outcome.confident());
        row[4] += 1;
        let most = slowest.entry(outcome.writer).or_default();
        *most = most.max(outcome.seconds);
    }
    let mut text = String::from("writer: right, undecided, unassembled, wrong, of, slowest (s)\n");
    for (writer, row) in rows {
        text.push_str(&format!("{writer}: {row:?} {:.1}\n", slowest[writer]));
    }
    text
}

/// Cases of the quick tier: each family and writer once, frames in turn.
fn sample() -> Vec<Case> {
    let mut cases = Vec::new();
    for (w, writer) in WRITERS
        .iter()
        .enumerate()
        .filter(|(_, writer)| writer.quick)
    {
        for (f, family) in FAMILIES.iter().enumerate() {
            let index = (w + f) % FRAMES.len();
            let seed = 7000 + index as u64;
            let setting = FRAMES[index];
            cases.push(Case {
                family,
                writer,
                setting,
                seed,
            });
        }
    }
    cases
}

#[test]
fn no_writer_makes_a_verdict_wrong() {
    let outcomes = in_parallel(&sample(), tried);
    let wrong = outcomes.iter().filter(|o| o.confident());
    let wrong: Vec<String> = wrong.map(Outcome::line).collect();
    crate::support::assert_none(&wrong);
    let open: Vec<String> = outcomes
        .iter()
        .filter(|outcome| !outcome.right())
        .map(Outcome::line)
        .collect();
    assert!(
        50 * open.len() <= outcomes.len(),
        "{} of {} are open: {open:?}",
        open.len(),
        outcomes.len()
    );
}

/// From coarse to fine (m, rad).
const PRECISIONS: [f64; 10] = [1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 1e-8, 1e-9, 1e-10];

/// Linkages, and look-alikes, of which verdicts are asked at all [`PRECISIONS`].
const QUICK: [&str; 8] = [
    "four_bar",
    "slider_crank",
    "bennett",
    "spherical",
    "sarrus",
    "four_bar_tilted",
    "bennett_spoiled",
    "sarrus_tilted",
];

/// The mechanisms that numbers may stand for are the more, the less is known of them: what a finer precision allows that a coarser one
/// does not.
fn not_monotone(names: &[&str]) -> Vec<String> {
    let cases: Vec<Case> = names
        .iter()
        .enumerate()
        .map(|(index, name)| Case {
            family: FAMILIES.iter().find(|f| f.name == *name).unwrap(),
            writer: WRITERS.iter().find(|w| w.name == "%.6f").unwrap(),
            setting: FRAMES[1 + index % 3],
            seed: 9000 + index as u64,
        })
        .collect();
    let each = in_parallel(&cases, |case| {
        let mut random = SplitMix64::new(case.seed);
        let drawn = (case.family.draw)(&mut random);
        let text = written(&drawn, case.setting, case.writer, &mut random);
        let reading = kutzbach::format::read(&text, "written.urdf", &[]).unwrap();
        let found = PRECISIONS.map(|precision| {
            let known = reading.mechanism.clone().with_precision(precision);
            analysis(&known).mobility
        });
        let pairs = found.windows(2).zip(&PRECISIONS);
        let less = pairs.filter(|(pair, _)| {
            let [coarse, fine] = [0, 1].map(|k| pair[k].finite().unwrap_or(0));
            pair[0].verdict != Verdict::Undecided && coarse < fine
        });
        less.map(|(pair, precision)| {
            format!(
                "{}: {:?} at {precision:e}, {:?} at a finer one",
                case.family.name,
                (pair[0].verdict, pair[0].finite()),
                pair[1].finite()
            )
        })
        .collect::<Vec<_>>()
    });
    each.concat()
}

#[test]
fn a_coarser_precision_allows_what_a_finer_one_does() {
    crate::support::assert_none(&not_monotone(&QUICK));
}

mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_coarser_precision_allows_what_a_finer_one_does_of_others() {
        let others = FAMILIES.iter().map(|family| family.name);
        let others: Vec<&str> = others.filter(|name| !QUICK.contains(name)).collect();
        crate::support::assert_none(&not_monotone(&crate::support::sample(others, 3)));
    }

    /// Files that are not answered right lie in `KUTZBACH_WRITERS_OUT`, where that names a folder; `KUTZBACH_WRITERS` seeds are tried, of writers
    /// whose name contains `KUTZBACH_WRITER`.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn every_writer_decides() {
        let seeds = std::env::var("KUTZBACH_WRITERS").ok();
        let seeds = seeds.and_then(|n| n.parse().ok()).unwrap_or(1);
        let outcomes = in_parallel(&crate::support::sample(all_cases(0..seeds), 3), tried);
        let told = table(&outcomes);
        println!("{told}");
        if let Some(out) = std::env::var_os("KUTZBACH_WRITERS_OUT") {
            for outcome in outcomes.iter().filter(|o| !o.right()) {
                println!("{}", outcome.line());
                let name = format!("{}.urdf", outcome.name.replace([' ', '%', '.'], "_"));
                std::fs::write(std::path::Path::new(&out).join(name), &outcome.text).unwrap();
            }
        }
        let wrong = outcomes.iter().filter(|o| o.confident());
        let wrong: Vec<String> = wrong.map(Outcome::line).collect();
        crate::support::assert_none(&wrong);
        // A few in a hundred of each writer's files may be left open, or one of a sample.
        for writer in &WRITERS {
            let of_it = || outcomes.iter().filter(|o| o.writer == writer.name);
            let open = of_it().filter(|outcome| !outcome.right()).count();
            let allowed = (of_it().count() * writer.open / 100).max(1);
            assert!(open <= allowed, "{}: {open} open\n{told}", writer.name);
        }
    }
}
