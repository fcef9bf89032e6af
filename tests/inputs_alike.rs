//! One choice of inputs for all commands: what the report names is what trace, simulation, assembly and page drive, or they say why not.

use crate::support;
use kutzbach::algebra::Limits;
use kutzbach::assembly::modes::{Question, assembly_modes};
use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::format::read;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{AnalysisOptions, Depth, Verdict, analyse};
use kutzbach::motion::{Trace, TraceOptions, trace};
use kutzbach::report::{Options, Report, report};
use kutzbach::simulate::verification::{DrivenMotion, VerificationOptions};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn fixture(name: &str, text: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("inputs_alike");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(format!("{name}.urdf"));
    std::fs::write(&path, text).unwrap();
    path
}

fn reported(text: &str) -> Report {
    let reading = read(text, "test.urdf", &[]).unwrap();
    report(&reading, "test.urdf", &Options::default()).unwrap()
}

/// The inputs that a report names: those given, without the dependent ones, and those proposed.
fn named(report: &Report) -> BTreeSet<String> {
    let Some(inputs) = &report.inputs else {
        return BTreeSet::new();
    };
    let dependent: BTreeSet<&String> = inputs.dependent.iter().map(|d| &d.input).collect();
    let given = inputs.given.iter().filter(|name| !dependent.contains(name));
    given.chain(&inputs.proposed).cloned().collect()
}

/// What the page plays of the first branch: the first of its drives, motion by motion.
fn page_drives(file: &Path) -> Vec<String> {
    let run = support::program()
        .args(["report", "--format", "html"])
        .arg(file)
        .output()
        .unwrap();
    let page = String::from_utf8(run.stdout).unwrap();
    let start = "<script type=\"application/json\" id=\"page-data\">";
    let (_, rest) = page.split_once(start).unwrap();
    let data: Value = serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap();
    let joints = data["joints"].as_array().unwrap();
    let names: Vec<&str> = joints
        .iter()
        .flat_map(|joint| joint["variables"].as_array().unwrap())
        .map(|variable| variable["name"].as_str().unwrap())
        .collect();
    let motions = data["motions"].as_array().unwrap().iter();
    motions
        .filter(|motion| motion["branch"] == 0)
        .map(|motion| names[motion["drives"][0].as_u64().unwrap() as usize].to_owned())
        .collect()
}

/// What does not agree with the report's inputs, in words.
fn disagreements(name: &str, text: &str) -> Vec<String> {
    let reading = read(text, name, &[]).unwrap();
    let said = report(&reading, name, &Options::default()).unwrap();
    let named = named(&said);
    let options = AnalysisOptions {
        depth: Depth::Motions,
        ..AnalysisOptions::default()
    };
    let analysis = analyse(&reading.mechanism, &options).unwrap();
    let mechanism = analysis.of(&reading.mechanism);
    if analysis.mobility.verdict != Verdict::Mobile || said.inputs.is_none() {
        return Vec::new();
    }
    let mut wrong = Vec::new();
    let mut tell = |command: &str, driven: &dyn std::fmt::Debug| {
        wrong.push(format!("{name}: {command} {driven:?}, report {named:?}"));
    };
    match trace(mechanism, &analysis, &TraceOptions::default()).unwrap() {
        Trace::Still(still) => assert!(!still.reason.is_empty(), "{name}"),
        Trace::Moving(motion) => {
            let held: BTreeSet<&String> = motion.held.iter().map(|h| &h.variable.name).collect();
            let told = motion.notes.join("; ");
            let told_of =
                |input: &str| told.contains("not decided") || told.contains(&format!("`{input}`"));
            let strange: Vec<_> = held.iter().filter(|h| !named.contains(**h)).collect();
            if !named.contains(&motion.driven.name) && !told_of(&motion.driven.name) {
                tell("trace drives", &motion.driven.name);
            }
            if strange.iter().any(|held| !told_of(held)) {
                tell("trace holds", &strange);
            }
        }
    }
    let branch = &analysis.branches.as_ref().unwrap()[0];
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let options = VerificationOptions::default();
    match DrivenMotion::first_along(mechanism, &geometry, &analysis, branch, &options) {
        Err(why) => assert!(!why.is_empty(), "{name}"),
        Ok(None) => {}
        Ok(Some(motion)) if named.is_empty() || named.contains(&motion.driven().name) => {}
        Ok(Some(motion)) => tell("simulate drives", &motion.driven().name),
    }
    let question = Question {
        held: None,
        limits: Limits {
            effort: Some(0),
            ..Limits::default()
        },
    };
    let modes = assembly_modes(&reading.mechanism, &question).unwrap();
    let held = modes.held.iter();
    let held = held.map(|(joint, _)| reading.mechanism.joint(*joint).name.clone());
    let held: BTreeSet<String> = held.chain(modes.not_held.iter().cloned()).collect();
    if held != named {
        tell("assemble holds", &held);
    }
    let drives = page_drives(&fixture(name, text));
    let first: BTreeSet<String> = drives.iter().take(named.len()).cloned().collect();
    if !named.is_empty() && !drives.is_empty() && !first.is_subset(&named) {
        tell("page plays", &drives);
    }
    wrong
}

/// The file with a motor at one of its joints that have one freedom, in no particular place.
fn with_motor(text: &str, mechanism: &Mechanism, lot: usize) -> Option<String> {
    let joints = mechanism.joints().iter();
    let able: Vec<&str> = joints
        .filter(|joint| joint.freedom() == 1 && !joint.closes_loop)
        .map(|joint| joint.name.as_str())
        .collect();
    let joint = able.get(lot.checked_rem(able.len())?)?;
    let motor =
        format!("<transmission name=\"t\"><joint name=\"{joint}\"/></transmission></robot>");
    let (body, _) = text.rsplit_once("</robot>")?;
    Some(format!("{body}{motor}"))
}

#[test]
fn every_command_drives_what_the_report_names() {
    let files = support::mechanism_files(&support::folder("mechanisms"));
    let read_text = |path: &PathBuf| std::fs::read_to_string(path).unwrap();
    let mut texts: Vec<(String, String)> = Vec::new();
    for (lot, (name, path)) in files.iter().enumerate() {
        let text = read_text(path);
        let Ok(reading) = read(&text, name, &[]) else {
            continue;
        };
        if reading.mechanism.joints().len() > 30 {
            continue;
        }
        if let Some(driven) = with_motor(&text, &reading.mechanism, lot) {
            texts.push((format!("{name}_driven"), driven));
        }
        texts.push((name.clone(), text));
    }
    let drawn = support::sample(texts, 3);
    assert!(drawn.len() >= 60, "{}", drawn.len());
    let wrong = support::in_parallel(&drawn, |(name, text)| disagreements(name, text));
    support::assert_none(&wrong.concat());
}

/// A crank of 1 and a rocker of √10 on the ground, 4 apart, with a coupler of √13: Grashof holds, and the crank is the shortest.
fn crank_rocker(rocker: &str, crank: &str) -> String {
    format!(
        r#"<robot name="cr"><link name="g"/><link name="r"/><link name="c"/><link name="k"/>
        <joint name="{rocker}" type="continuous"><parent link="g"/><child link="r"/><origin xyz="4 0 0"/><axis xyz="0 0 1"/></joint>
        <joint name="{crank}" type="continuous"><parent link="g"/><child link="c"/><axis xyz="0 0 1"/></joint>
        <joint name="pin" type="continuous"><parent link="c"/><child link="k"/><origin xyz="0 1 0"/><axis xyz="0 0 1"/></joint>
        <loop name="close" type="revolute"><predecessor link="k"><origin xyz="3 2 0"/></predecessor>
        <successor link="r"><origin xyz="-1 3 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#
    )
}

#[test]
fn a_crank_is_driven_and_not_its_rocker() {
    for (rocker, crank) in [("a", "z"), ("z", "a")] {
        let report = reported(&crank_rocker(rocker, crank));
        assert_eq!(report.inputs.unwrap().proposed, [crank]);
    }
}

#[test]
fn a_ram_is_driven_and_not_its_ends() {
    // A boom on the ground, lifted by a cylinder; all names sort the ends of the ram first.
    let text = r#"<robot name="boom"><link name="g"/><link name="boom"/><link name="cylinder"/><link name="rod"/>
        <joint name="pivot" type="continuous"><parent link="g"/><child link="boom"/><origin xyz="0 4 0"/><axis xyz="0 0 1"/></joint>
        <joint name="a_rear" type="continuous"><parent link="g"/><child link="cylinder"/><axis xyz="0 0 1"/></joint>
        <joint name="stroke" type="prismatic"><parent link="cylinder"/><child link="rod"/><origin xyz="2 2 0"/><axis xyz="1 1 0"/>
        <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
        <loop name="head" type="revolute"><predecessor link="rod"><origin xyz="1 2 0"/></predecessor>
        <successor link="boom"><origin xyz="3 0 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#;
    assert_eq!(reported(text).inputs.unwrap().proposed, ["stroke"]);
}

#[test]
fn a_follower_is_not_driven() {
    let text = r#"<robot name="f"><link name="g"/><link name="a"/><link name="b"/>
        <joint name="follower" type="revolute"><parent link="g"/><child link="a"/><axis xyz="0 0 1"/>
        <limit lower="-3" upper="3" effort="1" velocity="1"/><mimic joint="leader" multiplier="4"/></joint>
        <joint name="leader" type="continuous"><parent link="g"/><child link="b"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint></robot>"#;
    assert_eq!(reported(text).inputs.unwrap().proposed, ["leader"]);
    assert_eq!(disagreements("follower", text), Vec::<String>::new());
}
