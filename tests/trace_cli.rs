//! `kutzbach trace` as a user meets it.
use crate::support;

use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::process::{Output, Stdio};
use support::rewrite::Draft;
use support::zoo_mechanism;

/// A double rocker: the driven bar has no full turn.
const ROCKER: &str = r#"<robot name="rocker"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
  <joint name="O" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
  <joint name="A" type="revolute"><parent link="crank"/><child link="coupler"/><origin xyz="0 3 0"/><axis xyz="0 0 1"/></joint>
  <joint name="C" type="revolute"><parent link="ground"/><child link="rocker"/><origin xyz="3 0 0"/><axis xyz="0 0 1"/></joint>
  <loop name="B" type="revolute"><predecessor link="coupler"><origin xyz="2 0 0"/></predecessor>
  <successor link="rocker"><origin xyz="-1 3 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#;

/// A folder of its own for one test, with a mechanism in it.
fn folder(test: &str, text: &str) -> PathBuf {
    let path = support::empty_folder(&format!("trace_cli_{test}"));
    fs::write(path.join("m.urdf"), text).unwrap();
    path
}

fn zoo_text(name: &str) -> String {
    fs::read_to_string(support::folder("tests/zoo").join(format!("{name}.urdf"))).unwrap()
}

fn traced(folder: &PathBuf, more: &[&str]) -> Output {
    crate::support::program()
        .args(["trace", "m.urdf"])
        .args(more)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn json(output: &Output) -> Value {
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn rows_name_their_columns_and_there_is_one_per_sample() {
    for (name, joints) in [
        ("bennett_generic", vec!["J1", "J4", "J2", "J3"]),
        ("planar_4r_general", vec!["J1", "J2", "J3", "J4"]),
    ] {
        let folder = folder(&format!("csv_{name}"), &zoo_text(name));
        let output = traced(&folder, &["--format", "csv", "--samples", "37"]);
        assert_eq!(output.status.code(), Some(0));
        let page = text(&output.stdout);
        let mut lines = page.lines();
        let header: Vec<&str> = lines.next().unwrap().split(',').collect();
        assert_eq!(header[..3], ["drive", "arclength", "closure"]);
        let mut found = header[3..7].to_vec();
        found.sort_unstable();
        let mut wanted = joints;
        wanted.sort_unstable();
        assert_eq!(found, wanted, "{name}");
        for part in ["x", "y", "z", "qw", "qx", "qy", "qz"] {
            let count = header.iter().filter(|h| h.ends_with(&format!(".{part}")));
            assert_eq!(count.count(), 4, "one per link");
        }
        let rows: Vec<Vec<f64>> = lines
            .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect())
            .collect();
        assert_eq!(rows.len(), 37);
        assert!(
            rows.iter()
                .all(|r| r.len() == header.len() && r[2] <= 1e-12)
        );
        assert!(rows.windows(2).all(|p| p[0][1] < p[1][1]));
    }
}

#[test]
fn json_has_its_schema_and_is_the_same_every_time() {
    for name in ["bennett_generic", "planar_4r_general"] {
        let folder = folder(&format!("json_{name}"), &zoo_text(name));
        let more = ["--format", "json", "--samples", "12"];
        let (once, again) = (traced(&folder, &more), traced(&folder, &more));
        assert_eq!(once.stdout, again.stdout);
        let found = json(&once);
        assert_eq!(found["schema"], "kutzbach-trace-1");
        assert_eq!(found["samples"].as_array().unwrap().len(), 12);
        // In another order of the file: the same motion.
        let mut draft = Draft::of(&zoo_mechanism(name));
        draft.joints.reverse();
        let text = kutzbach::format::write(&draft.build());
        fs::write(folder.join("m.urdf"), text).unwrap();
        let other = json(&traced(&folder, &more));
        for key in ["schema", "branch", "closed"] {
            let (a, b) = (&found[key], &other[key]);
            match (a.as_f64(), b.as_f64()) {
                (Some(a), Some(b)) => assert!((a - b).abs() < 1e-9, "{name} {key}"),
                _ => assert_eq!(a, b, "{name} {key}"),
            }
        }
        let drives = |v: &Value| -> Vec<f64> {
            let samples = v["samples"].as_array().unwrap();
            samples
                .iter()
                .map(|s| s["drive"].as_f64().unwrap())
                .collect()
        };
        let (a, b) = (drives(&found), drives(&other));
        assert!(
            a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-9),
            "{a:?} {b:?}"
        );
    }
}

#[test]
fn an_unknown_joint_is_a_mistake_with_advice() {
    let folder = folder("unknown", ROCKER);
    for more in [["--drive", "OO"], ["--hold", "OO"]] {
        let output = traced(&folder, &more);
        assert_eq!(output.status.code(), Some(2));
        let told = text(&output.stderr);
        assert!(
            told.contains("OO") && told.contains("did you mean `O`?"),
            "{told}"
        );
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn a_value_out_of_reach_is_an_answer() {
    let folder = folder("unreached", ROCKER);
    let more = ["--drive", "O=0..6.283"];
    let output = traced(&folder, &more);
    assert_eq!(output.status.code(), Some(0));
    let page = text(&output.stdout);
    assert!(
        page.contains("is not reached") && page.contains("dead centre"),
        "{page}"
    );
    let found = json(&traced(
        &folder,
        &[&more[..], &["--format", "json"]].concat(),
    ));
    let told = found["unreached"].to_string();
    assert!(told.contains("dead centre"), "{told}");
}

#[test]
fn driven_values_are_expressions_and_have_units() {
    let folder = folder("units", ROCKER);
    let poses = |range: &str| {
        let drive = format!("O={range}");
        let output = traced(
            &folder,
            &["--drive", &drive, "--samples", "3", "--format", "csv"],
        );
        (output.status.code(), text(&output.stdout))
    };
    let (code, in_degrees) = poses("0deg..9deg");
    assert_eq!(code, Some(0));
    assert_eq!(in_degrees, poses("0..pi/20").1);
    // A hinge does not slide.
    let refused = traced(&folder, &["--drive", "O=0..5mm"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("this degree of freedom turns"));
}

#[test]
fn what_is_rigid_is_told() {
    let folder = folder("rigid", &zoo_text("triangle_3r_rigid"));
    let output = traced(&folder, &[]);
    assert_eq!(output.status.code(), Some(0));
    assert!(text(&output.stdout).contains("nothing moves: the mechanism is rigid"));
    let found = json(&traced(&folder, &["--format", "json"]));
    assert_eq!(found["schema"], "kutzbach-trace-1");
    assert!(found.to_string().contains("rigid"));
}

#[test]
fn output_goes_to_a_file() {
    let folder = folder("output", ROCKER);
    let shown = traced(&folder, &["--format", "csv"]);
    let written = traced(&folder, &["--format", "csv", "--output", "poses.csv"]);
    assert_eq!(written.status.code(), Some(0));
    assert!(written.stdout.is_empty());
    assert_eq!(fs::read(folder.join("poses.csv")).unwrap(), shown.stdout);
    let missing = traced(&folder, &["--output", "no/such/folder/poses.csv"]);
    assert_ne!(missing.status.code(), Some(0));
}

/// Where the coupler point (2 3 0) of `planar_four_bar` is at a crank angle: the pin between coupler and rocker lies on two
/// circles, to the left of the line from the crank's pin to the rocker's pivot.
fn coupler_point(crank: f64) -> [f64; 2] {
    let pin = [-2.0 * crank.sin(), 2.0 * crank.cos()];
    let (dx, dy) = (4.0 - pin[0], -pin[1]);
    let distance = dx.hypot(dy);
    let height = (25.0 - 0.25 * distance * distance).sqrt();
    let far = [
        0.5 * dx - height * dy / distance,
        0.5 * dy + height * dx / distance,
    ];
    let (s, c) = (far[1].atan2(far[0]) - 3f64.atan2(4.0)).sin_cos();
    [pin[0] + 2.0 * c - 3.0 * s, pin[1] + 2.0 * s + 3.0 * c]
}

/// What is between `before` and the next quotation mark, wherever it stands.
fn quoted<'a>(page: &'a str, before: &str) -> Vec<&'a str> {
    let parts = page.split(before).skip(1);
    parts.map(|rest| rest.split('"').next().unwrap()).collect()
}

#[test]
fn the_path_of_a_coupler_point_is_the_one_of_the_closed_formula() {
    let file = support::folder("mechanisms").join("planar_four_bar.urdf");
    let folder = folder("curve", &fs::read_to_string(file).unwrap());
    let more = ["--samples", "61", "--curve", "coupler:2,3000mm"];
    let page = text(&traced(&folder, &[&more[..], &["--format", "csv"]].concat()).stdout);
    assert!(
        page.lines()
            .next()
            .unwrap()
            .ends_with(",coupler(2 3 0).x,coupler(2 3 0).y,coupler(2 3 0).z")
    );
    let mut expected = Vec::new();
    for row in page.lines().skip(1) {
        let row: Vec<f64> = row.split(',').map(|x| x.parse().unwrap()).collect();
        let [x, y] = coupler_point(row[0]);
        let found = &row[row.len() - 3..];
        assert!((found[0] - x).hypot(found[1] - y) < 1e-11, "{row:?}");
        assert_eq!(found[2], 0.0);
        expected.push([1e3 * x, 1e3 * y]);
    }
    let listed = json(&traced(
        &folder,
        &[&more[..], &["--format", "json"]].concat(),
    ));
    assert_eq!(listed["curves"][0]["path"].as_array().unwrap().len(), 61);

    // The picture holds the same numbers, with as many pixels to a millimetre both ways, and the line is closed.
    let page = text(&traced(&folder, &[&more[..], &["--format", "svg"]].concat()).stdout);
    let ruler = |name: &str| -> [f64; 4] {
        let text = quoted(&page, name)[0];
        let numbers: Vec<f64> = text.split(' ').filter_map(|x| x.parse().ok()).collect();
        numbers.try_into().unwrap()
    };
    let (across, up) = (ruler("data-x=\""), ruler("data-y=\""));
    let scale = |[low, high, from, to]: [f64; 4]| (to - from) / (high - low);
    let ratio = -scale(across) / scale(up);
    assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
    let points: Vec<[f64; 2]> = quoted(&page, "points=\"")[0]
        .split(' ')
        .map(|point| {
            let (x, y) = point.split_once(',').unwrap();
            [x.parse().unwrap(), y.parse().unwrap()]
        })
        .collect();
    assert_eq!(points.len(), 61);
    assert_eq!(points.first(), points.last());
    for (point, wanted) in points.iter().zip(&expected) {
        for (axis, ruler) in [across, up].into_iter().enumerate() {
            let pixel = ruler[2] + scale(ruler) * (wanted[axis] - ruler[0]);
            assert!((point[axis] - pixel).abs() < 0.2, "{point:?} {wanted:?}");
        }
    }
    assert!(page.contains(">start</text>") && page.contains("x (mm)"));
}

#[test]
fn plots_stand_below_one_another_and_show_where_the_motion_ends() {
    let limited = ROCKER.replace(
        r#"<axis xyz="0 0 1"/></joint>
  <joint name="C""#,
        r#"<axis xyz="0 0 1"/><limit lower="-0.5" upper="0.5"/></joint>
  <joint name="C""#,
    );
    let folder = folder("plots", &limited);
    let more = ["--format", "svg", "--plot", "C:O", "--plot", "O:A"];
    let page = text(&traced(&folder, &more).stdout);
    for words in ["C over O", "O over A", "C (°)", "joint limit of A"] {
        assert!(page.contains(words), "{words}");
    }
    assert_eq!(page.matches("<polyline").count(), 2);
    assert_eq!(page.matches("<svg").count(), 1);
    for (wrong, told) in [
        (&["--plot", "C:OO"][..], "no joint variable `OO`"),
        (&["--plot", "C"], "two joints are needed"),
        (&["--curve", "couplr:1,2"], "did you mean `coupler`?"),
        (&["--curve", "coupler:1"], "2 or 3 coordinates"),
        (&["--curve", "coupler:1,2deg"], "`2deg` is no length"),
        (&[], "not told what to draw"),
    ] {
        let output = traced(&folder, &[&["--format", "svg"], wrong].concat());
        assert_ne!(output.status.code(), Some(0), "{wrong:?}");
        let flat = text(&output.stderr)
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ");
        assert!(flat.contains(told), "{flat}");
    }
}

/// A pantograph of two cranks, with two degrees of freedom.
const FIVE_BAR: &str = r#"<robot name="five"><link name="g"/><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
  <joint name="A" type="revolute"><parent link="g"/><child link="a"/><axis xyz="0 0 1"/></joint>
  <joint name="B" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 2 0"/><axis xyz="0 0 1"/></joint>
  <joint name="D" type="revolute"><parent link="g"/><child link="d"/><origin xyz="3 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="C" type="revolute"><parent link="d"/><child link="c"/><origin xyz="0 2 0"/><axis xyz="0 0 1"/></joint>
  <loop name="E" type="revolute"><predecessor link="b"><origin xyz="1.5 2 0"/></predecessor>
  <successor link="c"><origin xyz="-1.5 2 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#;

#[test]
fn what_is_held_is_told_by_what_it_leaves() {
    let folder = folder("held", FIVE_BAR);
    // One degree of freedom is left, and followed.
    for joint in ["A", "B", "C", "D", "E"] {
        let found = json(&traced(&folder, &["--hold", joint, "--format", "json"]));
        assert_eq!(found["moves"], true, "{joint}: {}", found["reason"]);
        assert_eq!(found["held"][0]["joint"], joint);
    }
    let told = |more: &[&str]| {
        let output = traced(&folder, more);
        assert_ne!(output.status.code(), Some(0));
        text(&output.stderr)
    };
    assert!(
        told(&["--hold", "A", "--hold", "D"])
            .contains("holding `D` too leaves no degree of freedom")
    );
    assert!(
        told(&["--hold", "A", "--hold", "D", "--drive", "B"]).contains("holding `D` too leaves")
    );
    // What rests on the branch takes nothing away by being held.
    let cranks =
        fs::read_to_string(support::folder("mechanisms").join("kite_equal_bars.urdf")).unwrap();
    fs::write(folder.join("m.urdf"), cranks).unwrap();
    let found = json(&traced(&folder, &["--hold", "elbow_0", "--format", "json"]));
    assert_eq!(found["moves"], true, "{}", found["reason"]);
}
