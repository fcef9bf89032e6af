//! What has no part in a loop has no part in its answer, and independent sub-mechanisms have none in one another's.

use crate::support;

use kutzbach::mechanism::{Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder};
use kutzbach::mobility::{Analysis, AnalysisOptions, Depth, analyse};
use kutzbach::number::Number;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use support::combine::mounted;
use support::rewrite::Draft;
use support::{assert_none, folder, in_parallel, mechanism_files};

fn at_depth(mechanism: &Mechanism, depth: Depth) -> Result<Analysis, String> {
    let options = AnalysisOptions {
        depth,
        ..AnalysisOptions::default()
    };
    analyse(mechanism, &options).map_err(|error| error.to_string())
}

/// Everything that is said of a mechanism's mobility, the figures in its sentences included. The work that exact algebra counts is
/// left out: every link costs some.
fn said(mechanism: &Mechanism, depth: Depth) -> String {
    let analysis = match at_depth(mechanism, depth) {
        Ok(analysis) => analysis,
        Err(error) => return error,
    };
    let mobility = format!("{:?}", analysis.mobility);
    let mut pieces = mobility.split("; work ");
    let mut said = pieces.next().unwrap_or_default().to_owned();
    pieces.for_each(|piece| said.push_str(piece.trim_start_matches(|c: char| c.is_ascii_digit())));
    let _ = writeln!(said, "\n{:?}", analysis.home);
    let branches = analysis.branches.iter().flatten();
    let dimensions: Vec<usize> = branches.map(|branch| branch.dimension).collect();
    let _ = write!(said, "{dimensions:?}");
    for (joint, role) in mechanism.joints().iter().zip(&analysis.roles) {
        if joint.freedom() > 0 {
            let _ = write!(said, "\n{} {:?}", joint.name, role.locked);
        }
    }
    said
}

fn files() -> Vec<PathBuf> {
    ["mechanisms", "tests/zoo", "tests/zoo2", "tests/near"]
        .into_iter()
        .flat_map(|name| mechanism_files(&folder(name)))
        .map(|(_, path)| path)
        .collect()
}

/// A link fixed to another one, at `xyz`.
fn with_camera(text: &str, link: &str, xyz: &str) -> String {
    let camera = format!(
        r#"<link name="a_camera"/><joint name="a_mount" type="fixed"><parent link="{link}"/><child link="a_camera"/><origin xyz="{xyz}"/></joint></robot>"#
    );
    text.replace("</robot>", &camera)
}

/// Holds the answers of files against those with a camera somewhere.
fn check_cameras(files: &[PathBuf], places: &[&str], depth: Depth) {
    let wrong = in_parallel(files, |path| {
        let text = std::fs::read_to_string(path).unwrap();
        let read = |text: &str| {
            kutzbach::format::read(text, &path.to_string_lossy(), &[])
                .unwrap()
                .mechanism
        };
        let plain = read(&text);
        let ground = plain.link(plain.ground()).name.clone();
        let moving = plain.joints().iter().find(|joint| joint.freedom() > 0);
        let moving = moving.map(|joint| plain.link(joint.successor.link).name.clone());
        let expected = said(&plain, depth);
        let mut wrong = Vec::new();
        for (place, link) in places.iter().zip([Some(ground), moving].iter().cycle()) {
            let Some(link) = link else { continue };
            let found = said(&read(&with_camera(&text, link, place)), depth);
            if found != expected {
                let differs = found.lines().zip(expected.lines()).find(|(a, b)| a != b);
                wrong.push(format!("{} at {place}: {differs:?}", path.display()));
            }
        }
        wrong
    });
    assert_none(&wrong.concat());
}

#[test]
fn a_camera_changes_no_answer() {
    let sample: Vec<PathBuf> = files().into_iter().step_by(5).collect();
    check_cameras(&sample, &["0.123 0 0"], Depth::Verdict);
}

/// What a command says of a file, the columns and fields that a camera may not change.
fn answered(command: &str, file: &Path) -> String {
    let more: &[&str] = match command {
        "trace" => &["--samples", "20", "--format", "csv"],
        _ => &["--format", "json"],
    };
    let run = support::program()
        .arg(command)
        .arg(file)
        .args(more)
        .output();
    let told = String::from_utf8(run.unwrap().stdout).unwrap();
    let field = |value: &serde_json::Value, names: &[&str]| {
        let of = |name: &&str| format!("{name} {:?}", value.get(*name));
        names.iter().map(of).collect::<Vec<_>>().join(", ")
    };
    match command {
        // A column more for every number of the camera's pose.
        "trace" => {
            let kept = |head: &str| !head.starts_with("a_camera.");
            let heads: Vec<&str> = told.lines().next().unwrap_or_default().split(',').collect();
            let row = |line: &str| {
                let cells = line.split(',').zip(&heads).filter(|(_, head)| kept(head));
                cells
                    .map(|(cell, _)| format!("{cell},"))
                    .collect::<String>()
            };
            told.lines().map(|line| row(line) + "\n").collect()
        }
        "exact" => field(
            &serde_json::from_str(&told).unwrap(),
            &["dimension", "outcome"],
        ),
        _ => {
            let answer: serde_json::Value = serde_json::from_str(&told).unwrap();
            let joints = answer["solutions"].as_array().into_iter().flatten();
            let joints: Vec<String> = joints.map(|s| s["joints"].to_string()).collect();
            field(&answer, &["complete", "moves"]) + &joints.join("\n")
        }
    }
}

#[test]
fn a_camera_changes_neither_traces_nor_configurations_nor_proofs() {
    let folder = support::empty_folder("cameras");
    // Quick enough for all three.
    let names = [
        "bennett",
        "planar_four_bar",
        "sarrus",
        "slider_crank",
        "oldham",
    ];
    let wrong = in_parallel(&names, |name| {
        let text = std::fs::read_to_string(support::folder(&format!("mechanisms/{name}.urdf")));
        let text = text.unwrap();
        let mechanism = kutzbach::format::read(&text, name, &[]).unwrap().mechanism;
        let ground = &mechanism.link(mechanism.ground()).name;
        let [plain, with] =
            ["plain", "camera"].map(|kind| folder.join(format!("{name}_{kind}.urdf")));
        std::fs::write(&plain, &text).unwrap();
        std::fs::write(&with, with_camera(&text, ground, "0.123 0 0")).unwrap();
        let differs = |command: &&str| answered(command, &plain) != answered(command, &with);
        let commands = ["trace", "assemble", "exact"].into_iter().filter(differs);
        commands
            .map(|command| format!("{command} of {name}"))
            .collect::<Vec<_>>()
    });
    assert_none(&wrong.concat());
}

fn upright() -> Direction {
    Direction([0, 0, 1].map(Number::integer))
}

/// A planar four-bar on the ground `0` with a crank and a rocker of one length, the coupler twice as long; three decimals.
fn add_parallelogram(builder: &mut MechanismBuilder, name: &str, millimetres: i64) {
    let at = |x: i64, y: i64| {
        let decimal = |length: i64| {
            let (whole, rest) = (length / 1000, length % 1000);
            Number::decimal(&format!("{whole}.{rest:03}")).unwrap()
        };
        Frame::at([decimal(x), decimal(y), Number::zero()])
    };
    let [crank, coupler, rocker] =
        ["crank", "coupler", "rocker"].map(|link| format!("{name}_{link}"));
    for link in [&crank, &coupler, &rocker] {
        builder.link(link);
    }
    let (short, long) = (millimetres, 2 * millimetres);
    let tree = |number: u32, parent: &str, child: &str, origin: Frame| {
        let joint = format!("{name}_{number}");
        JointBuilder::tree(&joint, JointKind::Revolute, parent, child)
            .axis(upright())
            .origin(origin)
    };
    builder.joint(tree(1, "0", &crank, at(0, 0)));
    builder.joint(tree(2, &crank, &coupler, at(0, short)));
    builder.joint(tree(3, "0", &rocker, at(long, 0)));
    let closing =
        JointBuilder::closing(&format!("{name}_4"), JointKind::Revolute, &coupler, &rocker);
    let closing = closing.axis(upright());
    builder.joint(closing.origin(at(long, 0)).successor_origin(at(0, short)));
}

#[test]
fn a_small_four_bar_beside_a_large_one_keeps_its_mobility() {
    let mut wrong = Vec::new();
    for small in [1, 2, 5, 10, 20, 50, 100] {
        for large in [0, 500, 1234, 10_000, 100_000] {
            // Names decide the order of the parts.
            for [one, other] in [["a", "b"], ["b", "a"]] {
                let mut builder = MechanismBuilder::new("two");
                builder.link("0");
                add_parallelogram(&mut builder, one, small);
                if large > 0 {
                    add_parallelogram(&mut builder, other, large);
                }
                let expected = if large > 0 { 2 } else { 1 };
                let found = at_depth(&builder.build().unwrap(), Depth::Verdict).unwrap();
                let (lower, upper) = found.mobility.bounds;
                let contains = lower <= Some(expected) && upper >= Some(expected);
                // Half a millimetre in one leaves nothing to see.
                if !contains || small > 1 && found.mobility.finite() != Some(expected) {
                    let (verdict, why) = (found.mobility.verdict, &found.mobility.why);
                    wrong.push(format!(
                        "{one}: {small} mm beside {large} mm: {verdict:?} {lower:?} {upper:?} {why:?}"
                    ));
                }
            }
        }
    }
    assert_none(&wrong);
}

/// A miss (m) below this is what rounding leaves in fifty digits, and no part's own.
const ROUNDING: f64 = 1e-40;

/// What was found of the parts of a mechanism that have `own` joints, by the names that these have alone.
fn parts_of(mechanism: &Mechanism, own: &dyn Fn(&str) -> Option<String>) -> Vec<String> {
    let Ok(analysis) = at_depth(mechanism, Depth::Verdict) else {
        return vec!["no analysis".to_owned()];
    };
    let mut all = Vec::new();
    for (index, part) in analysis.structure.parts.iter().enumerate() {
        let joints = part
            .joints
            .iter()
            .map(|&joint| &mechanism.joints()[joint].name);
        let Some(mut names) = joints
            .map(|name| own(name))
            .collect::<Option<Vec<String>>>()
        else {
            continue;
        };
        names.sort();
        let mut said = format!("{names:?}");
        if let Some(found) = analysis.findings.get(index) {
            let bounds = (found.lower(), found.upper(), found.open().is_some());
            let branches = found.branches().map(<[_]>::len);
            let _ = write!(
                said,
                " {bounds:?} {:?} {:?} {:?} {branches:?} {:?}",
                found.pose(),
                found.kind(),
                found.class(),
                found
                    .nominal()
                    .map(|miss| if miss < ROUNDING { 0.0 } else { miss })
            );
        }
        if let Some(rank) = analysis.parts.get(index) {
            let _ = write!(
                said,
                " {:?} {:?} {:?}",
                rank.candidates, rank.instantaneous, rank.as_written
            );
        }
        all.push(said);
    }
    all.sort();
    all
}

/// Whether two of the test's mechanisms can be put together by [`mounted`].
fn plain(draft: &Draft) -> bool {
    let couplings = draft.mimics.is_empty() && draft.ratios.is_empty() && draft.sums.is_empty();
    let on_ground = draft
        .placed
        .iter()
        .all(|placed| placed.child != draft.ground);
    couplings && on_ground && draft.poses.is_empty() && !draft.has_fractions()
}

/// Holds pairs of files, the second one scaled, against each file by itself.
fn check_pairs(count: usize) {
    let drafts: Vec<Draft> = files()
        .iter()
        .map(|path| Draft::of(&kutzbach::format::read_file(path, &[]).unwrap().mechanism))
        .filter(plain)
        .collect();
    // Far apart in the list, so that a sample holds many kinds.
    let pairs: Vec<(usize, usize, i32)> = (0..count)
        .map(|index| {
            let first = index * 7 % drafts.len();
            let second = (index * 31 + 11) % drafts.len();
            (first, second, [3, -3, 0][index % 3])
        })
        .collect();
    let wrong = in_parallel(&pairs, |&(first, second, exponent)| {
        let (one, other) = (
            drafts[first].clone(),
            drafts[second].clone().scaled(exponent),
        );
        let alone = |name: &str| Some(name.to_owned());
        let mut expected = parts_of(&one.build(), &alone);
        expected.extend(parts_of(&other.build(), &alone));
        expected.sort();
        let mut wrong = Vec::new();
        for (a, b) in [(&one, &other), (&other, &one)] {
            let names: BTreeSet<&str> = a.joints.iter().map(|joint| joint.name.as_str()).collect();
            let built = mounted(a.clone(), &a.ground, b.clone()).build();
            let of_first = |name: &str| names.contains(name).then(|| name.to_owned());
            let of_second = |name: &str| match names.contains(name) {
                true => None,
                false => name.strip_suffix("_2").map(str::to_owned),
            };
            let mut found = parts_of(&built, &of_first);
            found.extend(parts_of(&built, &of_second));
            found.sort();
            if found != expected {
                wrong.push(format!(
                    "{} on {} by 1e{exponent}: {found:#?} instead of {expected:#?}",
                    b.name, a.name
                ));
            }
        }
        wrong
    });
    assert_none(&wrong.concat());
}

#[test]
fn independent_loops_are_analysed_as_if_each_were_alone() {
    check_pairs(24);
}

mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_camera_changes_no_answer_wherever_it_is() {
        let places = [
            "0.1 0 0.2",
            "0.1 0 0.2",
            "0.001 0 0",
            "0.123 -0.045 0.678",
            "1000 0 0",
            "1000.5 20 3",
            "0.123456 0 0",
            "0.123456 0.000001 12.345678",
            "0.123456789012 0 0",
            "1000.123456789012 0.5 0",
        ];
        check_cameras(&support::sample(files(), 12), &places, Depth::Everything);
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn independent_loops_of_three_hundred_pairs() {
        check_pairs(if support::whole() { 300 } else { 40 });
    }
}
