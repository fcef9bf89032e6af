//! Whether a mechanism assembles is decided and not given up: files of exact numbers that are drawn open, and files that a measure makes
//! inconsistent. `report`, `assemble` and `exact` say the same of each.
//!
//! `tests/drawn_open`: twelve families that close by construction once their first hinge is turned back by `turn`. Most are rigid and, for
//! small `e`, nearly singular: the gap rises along a valley whose floor is of the order of `e`.
//! `tests/inconsistent`: twelve mechanisms that close for some values of `measure` only, with the values and what has to be named.

use crate::support::{assert_none, folder, mechanism_files};
use kutzbach::algebra::{Budget, ExactOptions, Limits, exact_answer};
use kutzbach::assembly::modes::{Complete, Question, assembly_modes};
use kutzbach::format::{self, ReadOptions, Reading, property_names, read};
use kutzbach::matrix::SplitMix64;
use kutzbach::mobility::Verdict;
use kutzbach::report::text::{Layout, render};
use kutzbach::report::{Misfit, Options, Report, analysed_report, misfits};

fn read_with(text: &str, name: &str, values: &[(&str, &str)]) -> Reading {
    let settings: Vec<(String, String)> = values
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
        .collect();
    read(text, name, &settings).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn report_on(reading: &Reading, name: &str) -> Report {
    analysed_report(reading, name, &Options::default())
        .unwrap()
        .0
}

/// What `exact` and `assemble` may take on each file: what they do not reach in that time contradicts nothing.
fn limits() -> Limits {
    Limits::seconds(0.5)
}

/// Where what `assemble` and `exact` say contradicts a report.
fn disagreements(reading: &Reading, report: &Report) -> Vec<String> {
    let mechanism = &reading.mechanism;
    let never = report.assembly.proof.is_some();
    let closes = report.assembly.closed == Some(true);
    let mut wrong = Vec::new();
    let question = Question {
        held: Some(Vec::new()),
        limits: limits(),
    };
    let modes = assembly_modes(mechanism, &question).unwrap();
    let proven = modes.complete == Complete::Proven;
    if closes && proven && modes.configurations.is_empty() {
        wrong.push("`assemble` proves that it closes nowhere".to_owned());
    }
    if never && modes.configurations.iter().any(|found| found.proven) {
        wrong.push("`assemble` proves a configuration".to_owned());
    }
    let options = ExactOptions::default();
    let answer = exact_answer(mechanism, &options, &Budget::new(limits()));
    // What has no polynomial equations, `exact` says nothing of.
    let Ok(answer) = answer else { return wrong };
    if !answer.system.is_exact() {
        return wrong;
    }
    let finite = report.mobility.finite;
    match answer.dimension {
        Some(None) if closes => wrong.push("`exact` says that it closes nowhere".to_owned()),
        Some(Some(dimension)) if finite.is_some_and(|finite| finite > dimension) => {
            wrong.push(format!("`exact` says dimension {dimension}"));
        }
        _ => {}
    }
    let real = answer.solutions.map(|solutions| solutions.real.len());
    if never && real.is_some_and(|real| real > 0) {
        wrong.push("`exact` has real solutions".to_owned());
    }
    wrong
}

/// Angles by which the first hinge is drawn turned.
const TURNS: [&str; 5] = [
    "acos(4/5)",
    "-acos(3/5)",
    "acos(-5/13)",
    "acos(7/25)",
    "2*acos(4/5)",
];

/// The finite mobility of a family for all `e` but 0.
fn freedom(family: &str) -> usize {
    usize::from(["slider_crank", "crank_rod_rocker"].contains(&family))
}

struct Member {
    family: String,
    text: String,
    values: [(&'static str, String); 2],
}

/// So many members of each family.
fn drawn_open(each: usize) -> Vec<Member> {
    let mut random = SplitMix64::new(52);
    let mut draw = |below: u64| (random.next_u64() % below) as usize;
    let mut members = Vec::new();
    for (family, path) in mechanism_files(&folder("tests/drawn_open")) {
        let text = std::fs::read_to_string(path).unwrap();
        for index in 0..each {
            let sign = ["", "-"][draw(2)];
            // The sizes of `e` in turn, from a tenth to far below rounding.
            let exponent = 1 + index * 20 / each;
            let digit = 1 + draw(9);
            members.push(Member {
                family: family.clone(),
                text: text.clone(),
                values: [
                    ("e", format!("{sign}{digit}/10**{exponent}")),
                    ("turn", TURNS[draw(TURNS.len() as u64)].to_owned()),
                ],
            });
        }
    }
    members
}

/// None that closes is said not to, at most one in twenty is undecided, and what is decided is right.
fn judge_drawn_open(members: &[Member]) {
    let mut undecided = Vec::new();
    let mut wrong = Vec::new();
    for Member {
        family,
        text,
        values,
    } in members
    {
        let values: Vec<(&str, &str)> = values.iter().map(|(n, v)| (*n, v.as_str())).collect();
        let told = format!("{family} {values:?}");
        let reading = read_with(text, family, &values);
        let report = report_on(&reading, family);
        let (verdict, finite) = (report.mobility.verdict, report.mobility.finite);
        match verdict {
            Verdict::Unassembled => wrong.push(format!("{told}: no closed pose")),
            Verdict::Undecided => undecided.push(told.clone()),
            _ if finite != Some(freedom(family)) => wrong.push(format!("{told}: {finite:?}")),
            _ => {}
        }
        let disagreements = disagreements(&reading, &report);
        wrong.extend(disagreements.iter().map(|why| format!("{told}: {why}")));
    }
    println!(
        "{} of {} undecided: {undecided:?}",
        undecided.len(),
        members.len()
    );
    assert_none(&wrong);
    assert!(20 * undecided.len() <= members.len(), "{undecided:?}");
}

/// A mechanism that closes for some values of its measure only: its file, values for which it does not, values for which it does, and what the
/// first line has to name besides that it does not assemble.
type Inconsistent = (
    &'static str,
    &'static [&'static str],
    &'static [&'static str],
    &'static [&'static str],
);

const INCONSISTENT: [Inconsistent; 12] = [
    ("ball_and_hinge", &OFF_ONE, &["1"], &["loop through `ball`"]),
    (
        "bar_between_skew_lines",
        &BELOW_THREE,
        &["3", "7/2"],
        &["`end_1`", "`end_2`", "at least 3 m apart"],
    ),
    (
        "crossed_hinges",
        &ANGLES,
        &["acos(3/5)"],
        &["loop through `two`"],
    ),
    (
        "four_bar",
        &ABOVE_SEVEN,
        &["7", "2"],
        &["`left_pin`", "`right_pin`", "span 7 m"],
    ),
    ("oldham", &OFF_ONE, &["0"], &["loop through `shaft_2`"]),
    (
        "pin_and_plane",
        &ABOVE_ONE,
        &["1", "1/2"],
        &["`plane`", "`pivot`", "span 1 m"],
    ),
    (
        "rod_between_cranks",
        &ABOVE_SEVEN,
        &["5", "6"],
        &["`rod` is", "span 7 m"],
    ),
    (
        "sleeve_and_crank",
        &BELOW_TWO,
        &["2", "3"],
        &["`near`", "`far`"],
    ),
    (
        "slider_crank",
        &BELOW_THREE,
        &["3", "5"],
        &["`rod_pin`", "`pivot`", "at least 4 m apart"],
    ),
    (
        "spherical_four_bar",
        &ANGLES_ABOVE,
        &["pi/3", "pi/2"],
        &["loop through `h4`"],
    ),
    (
        "stepped_four_bar",
        &OFF_ONE,
        &["0"],
        &["loop through `right_pin`"],
    ),
    (
        "two_balls",
        &ABOVE_SEVEN,
        &["2", "4"],
        &["`ball_1`", "`ball_2`", "span 4 m"],
    ),
];
const OFF_ONE: [&str; 9] = [
    "1/3",
    "-1/2",
    "1/7",
    "5/4",
    "3/2",
    "2",
    "-3",
    "1 + 1/10**6",
    "1/10**5",
];
const BELOW_THREE: [&str; 9] = [
    "1",
    "2",
    "5/2",
    "14/5",
    "29/10",
    "299/100",
    "3 - 1/10**5",
    "3 - 1/10**8",
    "sqrt(8)",
];
const BELOW_TWO: [&str; 9] = [
    "1",
    "1/2",
    "3/2",
    "9/5",
    "19/10",
    "199/100",
    "2 - 1/10**5",
    "2 - 1/10**8",
    "sqrt(3)",
];
const ABOVE_SEVEN: [&str; 9] = [
    "15/2",
    "8",
    "9",
    "12",
    "50",
    "71/10",
    "701/100",
    "7 + 1/10**6",
    "sqrt(50)",
];
const ABOVE_ONE: [&str; 9] = [
    "2",
    "3/2",
    "10",
    "-2",
    "-3/2",
    "11/10",
    "101/100",
    "1 + 1/10**6",
    "sqrt(2)",
];
const ANGLES: [&str; 9] = [
    "acos(4/5)",
    "pi/3",
    "pi/2",
    "pi/4",
    "pi/6",
    "acos(5/13)",
    "acos(7/25)",
    "2*acos(4/5)",
    "0",
];
const ANGLES_ABOVE: [&str; 9] = [
    "acos(-1/2)",
    "acos(-3/5)",
    "acos(-4/5)",
    "acos(-5/13)",
    "2*pi/3",
    "3*pi/4",
    "5*pi/6",
    "acos(-7/25)",
    "7*pi/12",
];

/// Of each file so many values without a pose, nine at most: which of them are not proved, or not named. What closes is never said not to.
fn judge_inconsistent(each: usize) -> (usize, Vec<String>) {
    let mut missed = Vec::new();
    let mut wrong = Vec::new();
    let mut count = 0;
    for (file, without, with, named) in INCONSISTENT {
        let path = folder("tests/inconsistent").join(format!("{file}.urdf"));
        let text = std::fs::read_to_string(path).unwrap();
        let step = without.len() / each;
        let chosen = without
            .iter()
            .step_by(step)
            .take(each)
            .map(|value| (value, false));
        for (value, closes) in chosen.chain(with.iter().map(|value| (value, true))) {
            let told = format!("{file} {value}");
            let reading = read_with(&text, file, &[("measure", value)]);
            let report = report_on(&reading, file);
            let found = report.assembly.closed == Some(true);
            if found != closes {
                wrong.push(format!("{told}: closes is {closes}"));
            }
            let disagreements = disagreements(&reading, &report);
            wrong.extend(disagreements.iter().map(|why| format!("{told}: {why}")));
            if closes {
                continue;
            }
            count += 1;
            let text = render(&report, Layout::default());
            let words: Vec<&str> = text.split_whitespace().collect();
            let first = words.join(" ");
            if report.assembly.proof.is_none() || !named.iter().all(|word| first.contains(word)) {
                missed.push(format!("{told}: {}", &first[..first.len().min(200)]));
            }
        }
    }
    assert_none(&wrong);
    (count, missed)
}

#[test]
fn what_is_drawn_open_is_closed_and_decided() {
    judge_drawn_open(&drawn_open(2));
}

#[test]
fn what_a_measure_makes_inconsistent_is_proved_and_named() {
    let (_, missed) = judge_inconsistent(1);
    assert_none(&missed);
}

/// What has to hold of `measure`, which is left open at a value.
fn misfits_at(file: &str, value: &str) -> Vec<Misfit> {
    let path = folder("tests/inconsistent").join(format!("{file}.urdf"));
    let text = std::fs::read_to_string(path).unwrap();
    assert_eq!(property_names(&text), ["measure"]);
    misfits(&property_names(&text), |name| {
        let options = ReadOptions {
            settings: vec![("measure".to_owned(), value.to_owned())],
            symbolic: vec![name.to_owned()],
            ..ReadOptions::default()
        };
        Some(format::read_with(&text, file, &options).unwrap().mechanism)
    })
}

/// A measure is named where it rules a pose out, and nowhere else. A loop on the sphere and one with a sleeve ask for inequalities of angles and of a
/// distance from an axis, which are not derived.
#[test]
fn measures_that_rule_a_pose_out_are_named() {
    let mut silent = Vec::new();
    for (file, without, with, _) in INCONSISTENT {
        for value in with {
            assert_eq!(misfits_at(file, value), [], "{file} {value}");
        }
        for value in without.iter().step_by(3) {
            match misfits_at(file, value).as_slice() {
                [only] => assert!(!only.needs.is_empty()),
                _ => silent.push(file),
            }
        }
    }
    silent.dedup();
    assert_eq!(silent, ["sleeve_and_crank", "spherical_four_bar"]);
    let [only] = misfits_at("four_bar", "8").try_into().unwrap();
    assert_eq!(
        (only.value, only.needs),
        (Some(8.0), vec!["|measure| <= 2 + 4 + 1".to_owned()])
    );
}

#[test]
fn the_measure_stands_in_the_first_sentence() {
    let output = crate::support::program()
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args([
            "report",
            "mechanisms/oldham_measures.urdf",
            "--set",
            "L12=1/2",
        ])
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let words: Vec<&str> = text.split_whitespace().collect();
    let said = "With the other measures as they are, `L12` is 0.5, and";
    assert!(words.join(" ").contains(said), "{text}");
}

mod corpus {
    use crate::support::whole;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn five_hundred_files_drawn_open_are_decided() {
        super::judge_drawn_open(&super::drawn_open(if whole() { 42 } else { 14 }));
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_hundred_inconsistent_files_are_proved_and_named() {
        let (count, missed) = super::judge_inconsistent(9);
        println!("{} of {count} missed: {missed:#?}", missed.len());
        assert!(10 * missed.len() <= count, "{missed:#?}");
    }
}
