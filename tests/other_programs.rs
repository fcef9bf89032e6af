//! The page about other programs: every row is held by something that exists, and what it says of this program is so.

use crate::support;

use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::format::read;
use kutzbach::mechanism::{JointKind, Mechanism};
use kutzbach::report::text::{Layout, render};
use kutzbach::report::{Options, report};
use std::f64::consts::FRAC_PI_2;
use std::fs;
use support::{analysis, folder};

const PAGE: &str = include_str!("../docs/src/other_programs.md");
const GUIDE: &str = include_str!("../docs/src/from_your_robot.md");

/// The cells of every row, without those of headings.
fn rows() -> Vec<Vec<&'static str>> {
    PAGE.lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| program"))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect()
}

/// All sources of a module of these tests, or of a crate.
fn sources(module: &str) -> String {
    let tests = folder("tests");
    let mut open = match module.strip_prefix("kutzbach_") {
        Some(name) => vec![folder("crates").join(name).join("src")],
        None => vec![tests.join(format!("{module}.rs")), tests.join(module)],
    };
    let mut text = String::new();
    while let Some(next) = open.pop() {
        if next.is_dir() {
            let entries = fs::read_dir(next).unwrap();
            open.extend(entries.map(|entry| entry.unwrap().path()));
        } else if next.extension().is_some_and(|e| e == "rs") {
            text += &fs::read_to_string(next).unwrap_or_default();
        }
    }
    text
}

#[test]
fn every_row_is_held_by_what_exists() {
    let rows = rows();
    assert!(rows.len() >= 40, "only {} rows", rows.len());
    for row in rows {
        assert_eq!(row.len(), 4, "{row:?}");
        let (program, held) = (row[0], row[3]);
        let names: Vec<&str> = held.split('`').skip(1).step_by(2).collect();
        assert!(!names.is_empty(), "{row:?}");
        let mut scripts = String::new();
        for name in names {
            if name.starts_with("findings/") {
                let script = fs::read_to_string(folder(name));
                scripts += &script.unwrap_or_else(|error| panic!("{name}: {error}"));
                continue;
            }
            let module = name.split("::").next().unwrap();
            let function = name.rsplit("::").next().unwrap();
            let declared = format!("fn {function}(");
            assert!(sources(module).contains(&declared), "there is no {name}");
        }
        // What another version does was not seen.
        let words: Vec<&str> = program.split([' ', ',']).collect();
        for pair in words.windows(2) {
            let [name, version] = [pair[0], pair[1]];
            let is_one = version.starts_with(|c: char| c.is_ascii_digit()) && name != "SDF";
            let installed = scripts.contains(name)
                && ["=", "@"]
                    .iter()
                    .any(|by| scripts.contains(&format!("{by}{version}")));
            assert!(!is_one || installed, "{name} {version}: {row:?}");
        }
    }
}

#[test]
fn the_guide_prints_its_files_in_full() {
    for name in [
        "loader.urdf",
        "loader.urdf.xacro",
        "loader_mjcf.xml",
        "loader_gazebo.sdf",
        "expected.json",
    ] {
        let text = fs::read_to_string(folder("examples/first_robot").join(name)).unwrap();
        assert!(GUIDE.contains(&format!("\n{text}```")), "{name}");
    }
    // Without its loop the robot is the tree of which the guide speaks.
    let text = fs::read_to_string(folder("examples/first_robot/loader.urdf")).unwrap();
    let (before, rest) = text.split_once("<loop ").unwrap();
    let (_, after) = rest.split_once("</loop>").unwrap();
    let tree = read(&format!("{before}{after}"), "tree.urdf", &[]).unwrap();
    assert_eq!(tree.mechanism.freedom(), 3);
    assert_eq!(analysis(&tree.mechanism).mobility.finite(), Some(3));
}

fn mechanism(text: &str) -> Mechanism {
    read(text, "file", &[])
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
        .mechanism
}

/// One joint, a metre along x from the base.
fn one(kind: &str, inside: &str) -> Mechanism {
    mechanism(&format!(
        "<robot name='r'><link name='base'/><link name='body'/><joint name='j' type='{kind}'>\
         <parent link='base'/><child link='body'/><origin xyz='1 0 0'/>{inside}</joint></robot>"
    ))
}

fn about(kind: &str, axis: [f64; 3]) -> Mechanism {
    let [x, y, z] = axis;
    one(kind, &format!("<axis xyz='{x} {y} {z}'/>"))
}

/// Where the first joint, at these values, puts the origin of its body, and where a direction of the body points.
fn moved(mechanism: &Mechanism, values: &[f64], direction: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let joint = &geometry.displacements[0];
    let displacement = joint.displacement(&joint.at(values));
    let pose = geometry.sides[0][0].compose(&displacement);
    (pose.translation, pose.rotate(&direction))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[track_caller]
fn near(found: [f64; 3], expected: [f64; 3]) {
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-12, "{found:?} instead of {expected:?}");
    }
}

#[test]
fn a_planar_joint_moves_in_the_plane_normal_to_its_axis() {
    for axis in [[1.0, 0.0, 0.0], [0.0, 0.6, 0.8]] {
        let table = about("planar", axis);
        assert_eq!(table.freedom(), 3);
        let (place, normal) = moved(&table, &[0.3, -0.2, 0.7], axis);
        near(normal, axis);
        let [x, y, z] = place;
        assert!(dot([x - 1.0, y, z], axis).abs() < 1e-12, "{place:?}");
        // One of the three turns it where it stands, at its own origin; two move it by what they say.
        let mut travels: Vec<f64> = (0..3)
            .map(|variable| {
                let mut values = [0.0; 3];
                values[variable] = FRAC_PI_2;
                let ([x, y, z], _) = moved(&table, &values, axis);
                dot([x - 1.0, y, z], [x - 1.0, y, z]).sqrt()
            })
            .collect();
        travels.sort_by(f64::total_cmp);
        near(
            [travels[0], travels[1], travels[2]],
            [0.0, FRAC_PI_2, FRAC_PI_2],
        );
    }
}

#[test]
fn the_length_of_an_axis_means_nothing() {
    for length in [1.0, 2.0, 0.001] {
        let (_, image) = moved(
            &about("continuous", [0.0, 0.0, length]),
            &[0.5],
            [1.0, 0.0, 0.0],
        );
        near(image, [0.5f64.cos(), 0.5f64.sin(), 0.0]);
        let (place, _) = moved(
            &about("prismatic", [0.0, 0.0, length]),
            &[0.25],
            [1.0, 0.0, 0.0],
        );
        near(place, [1.0, 0.0, 0.25]);
    }
    let diagonal = [1.0, 2.0, 3.0];
    let hinge = about("continuous", diagonal);
    near(moved(&hinge, &[0.5], diagonal).1, diagonal);
    let across = [3.0, 0.0, -1.0];
    let image = moved(&hinge, &[0.5], across).1;
    assert!((dot(image, across) / 10.0 - 0.5f64.cos()).abs() < 1e-12);
    assert!((dot(image, image) - 10.0).abs() < 1e-12);
}

#[test]
fn an_axis_left_out_is_that_of_the_format() {
    let model = "<mujoco><worldbody><body name='b'><joint/></body></worldbody></mujoco>";
    for (mechanism, expected) in [
        (one("revolute", ""), [1.0, 0.0, 0.0]),
        (mechanism(model), [0.0, 0.0, 1.0]),
    ] {
        let joint = &mechanism.joints()[0];
        assert_eq!(joint.kind, JointKind::Revolute);
        assert_eq!(joint.axis.0.each_ref().map(|x| x.value()), expected);
    }
}

#[test]
fn an_axis_is_in_the_frame_of_its_joint() {
    let hinge = mechanism(
        "<robot name='r'><link name='base'/><link name='body'/><joint name='j' type='continuous'><parent link='base'/>\
         <child link='body'/><origin rpy='${-pi/2} 0 0'/><axis xyz='0 0 1'/></joint></robot>",
    );
    near(moved(&hinge, &[0.5], [0.0, 0.0, 1.0]).1, [0.0, 1.0, 0.0]);
}

/// Wheels on one base, each with what stands inside its joint.
fn wheels(joints: &[(&str, &str)]) -> String {
    let parts: String = joints
        .iter()
        .map(|(name, inside)| {
            format!(
                "<link name='of_{name}'/><joint name='{name}' type='revolute'><parent link='base'/>\
                 <child link='of_{name}'/><axis xyz='0 0 1'/>{inside}</joint>"
            )
        })
        .collect();
    format!("<robot name='r'><link name='base'/>{parts}</robot>")
}

#[test]
fn a_follower_may_come_before_its_leader() {
    let mimic = |leader: &str| format!("<mimic joint='{leader}' multiplier='2' offset='0.3'/>");
    for (leader, follower) in [("left", "right"), ("right", "left")] {
        for first in [leader, follower] {
            let second = if first == leader { follower } else { leader };
            let inside = mimic(leader);
            let of = |name: &'static str| {
                (
                    name,
                    if name == follower {
                        inside.as_str()
                    } else {
                        ""
                    },
                )
            };
            let mechanism = mechanism(&wheels(&[of(first), of(second)]));
            let coupling = &mechanism.couplings()[0];
            let factor = |name: &str| {
                let id = mechanism.joint_named(name).unwrap();
                let mut terms = coupling.terms.iter();
                terms
                    .find(|term| term.joint.0 == id.0)
                    .unwrap()
                    .factor
                    .value()
            };
            let own = factor(follower);
            assert_eq!(factor(leader) / own, -2.0, "{leader} leads, {first} first");
            assert_eq!(coupling.offset.value() / own, 0.3);
            assert_eq!(analysis(&mechanism).mobility.finite(), Some(1));
        }
    }
}

#[test]
fn followers_of_followers_follow() {
    let text = wheels(&[
        (
            "third",
            "<mimic joint='second' multiplier='-3' offset='0.1'/>",
        ),
        ("second", "<mimic joint='first' multiplier='-2'/>"),
        ("first", ""),
    ]);
    let mechanism = mechanism(&text);
    assert_eq!(mechanism.couplings().len(), 2);
    assert_eq!(analysis(&mechanism).mobility.finite(), Some(1));
}

/// The report on a file, in lines of one blank between words.
fn told(text: &str) -> String {
    let reading = read(text, "file", &[]).unwrap_or_else(|error| panic!("{error}"));
    let options = Options {
        ranges: true,
        ..Options::default()
    };
    let report = report(&reading, "file", &options).unwrap();
    let page = render(&report, Layout::default());
    page.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_follower_stops_with_its_leader() {
    let limit = "<limit lower='0' upper='1' effort='1' velocity='1'/>";
    let follower = "<limit lower='-4' upper='4' effort='1' velocity='1'/><mimic joint='first' multiplier='2' offset='0.3'/>";
    let page = told(&wheels(&[("first", limit), ("second", follower)]));
    assert!(page.contains("17.2 … 132°"), "{page}");
}

#[test]
fn bars_that_cannot_meet_do_not_assemble() {
    let bars = |apart: &str| {
        format!(
            "<robot name='r'><link name='base'/><link name='a'/><link name='b'/>\
             <joint name='one' type='continuous'><parent link='base'/><child link='a'/><axis xyz='0 0 1'/></joint>\
             <joint name='two' type='continuous'><parent link='base'/><child link='b'/><origin xyz='{apart} 0 0'/>\
             <axis xyz='0 0 1'/></joint>\
             <loop name='pin' type='revolute'><predecessor link='a'><origin xyz='1 0 0'/></predecessor>\
             <successor link='b'><origin xyz='-1 0 0'/></successor><axis xyz='0 0 1'/></loop></robot>"
        )
    };
    for (apart, said) in [
        ("3", "Does not assemble: no pose closes it"),
        ("2", "Rigid, but infinitesimally mobile"),
        ("1.5", "Rigid: 0 degrees of freedom"),
    ] {
        let page = told(&bars(apart));
        assert!(page.contains(said), "{apart}: {page}");
    }
}

#[test]
fn a_body_is_turned_without_a_pos_too() {
    for turned in [
        "euler='0 0 90'",
        "axisangle='0 0 2 90'",
        "quat='2 0 0 2'",
        "xyaxes='0 1 0 -1 1 0'",
    ] {
        for joint in ["<joint/>", "<freejoint/>", ""] {
            let text = format!(
                "<mujoco><worldbody><body name='b' {turned}>{joint}</body></worldbody></mujoco>"
            );
            let mechanism = mechanism(&text);
            let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
            let body = mechanism.link_named("b").unwrap();
            near(
                geometry.home[body.0].rotate(&[1.0, 0.0, 0.0]),
                [0.0, 1.0, 0.0],
            );
        }
    }
}

/// It is the body's joint; as long as it is not read, that is an error.
#[test]
fn a_joint_inside_a_frame_is_not_lost() {
    let text = "<mujoco><worldbody><body name='b'><frame euler='90 0 0'><joint name='j'/></frame></body></worldbody></mujoco>";
    let reading = read(text, "model.xml", &[]).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(reading.mechanism.freedom(), 1);
}

#[test]
fn stages_of_usd_are_refused() {
    let stage = "#usda 1.0\n(\n    metersPerUnit = 0.01\n)\n";
    assert!(read(stage, "stage.usda", &[]).is_err());
}

#[test]
fn expressions_are_those_of_python() {
    let text = "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'><link name='base'/><link name='body'/>\
                <joint name='j' type='fixed'><parent link='base'/><child link='body'/>\
                <origin xyz='${-2**2} ${2 - 1 - 1} ${8/2/2}' rpy='${atan2(1, 2)} 0 0'/></joint></robot>";
    let mechanism = mechanism(text);
    let frame = &mechanism.joints()[0].predecessor.frame;
    assert_eq!(
        frame.position.each_ref().map(|x| x.value()),
        [-4.0, 0.0, 2.0]
    );
    let angle = frame.roll_pitch_yaw[0].value();
    assert!((angle - 1f64.atan2(2.0)).abs() < 1e-15);
}
