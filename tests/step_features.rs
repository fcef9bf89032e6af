//! `kutzbach features` in STEP files: parts that have a feature with round faces, and parts that nearly have it (`tests/step/features.py`).

use crate::support::folder;
use serde_json::Value;

/// What is found of a feature in a part.
fn found(part: &str, feature: &str) -> Value {
    let output = crate::support::program()
        .args(["features", &format!("tests/step/features/{part}.step")])
        .args([
            "--declared",
            &format!("mechanisms/features/{feature}.features"),
        ])
        .arg("--json")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{part}: {said}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn count(data: &Value) -> usize {
    data["found"][0]["features"].as_array().unwrap().len()
}

#[test]
fn a_part_has_its_feature_and_one_that_nearly_has_it_has_not() {
    for (part, times, ways) in [
        ("pin", 1, 1),
        ("round_hole", 1, 2),
        ("ball", 1, 1),
        ("socket", 1, 1),
        ("counterbore", 1, 1),
        ("countersink", 1, 1),
        ("keyway", 1, 2),
        // From above and from below; the holes in any order.
        ("bolt_circle", 2, 24),
    ] {
        let has = found(part, part);
        assert_eq!(count(&has), times, "{part}: {has}");
        for feature in has["found"][0]["features"].as_array().unwrap() {
            assert_eq!(feature["ways"], ways, "{part}: {has}");
            assert_eq!(feature["holds"], "yes", "{part}: {has}");
        }
        assert_eq!(has["found"][0]["faces_without_type"], 0, "{part}: {has}");
        let near = found(&format!("{part}_near"), part);
        assert_eq!(count(&near), 0, "{part}_near: {near}");
    }
}

#[test]
fn features_are_told_from_those_that_are_like_them() {
    for (part, feature, times) in [
        ("round_hole_near", "blind_hole", 1),
        ("round_hole", "blind_hole", 0),
        // The narrow hole of a counterbore goes from its seat to the bottom.
        ("counterbore", "round_hole", 1),
        ("pin", "blind_hole", 0),
        ("socket", "ball", 0),
        ("ball", "socket", 0),
        ("bolt_circle", "round_hole", 5),
        ("keyway", "slot", 1),
        ("keyway", "pin", 0),
    ] {
        let data = found(part, feature);
        assert_eq!(count(&data), times, "{feature} in {part}: {data}");
    }
}

/// A hole whose wall comes in halves is one hole.
#[test]
fn halves_of_a_wall_are_one() {
    let output = crate::support::program()
        .args(["features", "tests/step/machines/slider_crank_room.step"])
        .args(["--declared", "mechanisms/features/round_hole.features"])
        .args(["--part", "connecting rod", "--json"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let data: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(count(&data), 2, "{data}");
}

#[test]
fn a_step_file_is_not_drawn_and_its_parts_are_named() {
    let run = |more: &[&str]| {
        let output = crate::support::program()
            .args(["features", "tests/step/features/pin.step"])
            .args(["--declared", "mechanisms/features/pin.features"])
            .args(more)
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .unwrap();
        let said = [output.stdout, output.stderr].concat();
        (output.status.code(), String::from_utf8(said).unwrap())
    };
    let (code, said) = run(&["--svg"]);
    assert!(code == Some(2) && said.contains("STEP file"), "{said}");
    let (code, said) = run(&["--part", "plate"]);
    assert!(
        code == Some(2) && said.contains("the file has pin"),
        "{said}"
    );
    let (code, said) = run(&[]);
    assert_eq!(code, Some(0));
    assert!(said.starts_with("PIN in pin: 1\n"), "{said}");
}

#[test]
fn every_part_with_a_feature_is_a_file() {
    let files = std::fs::read_dir(folder("tests/step/features")).unwrap();
    assert_eq!(files.count(), 16);
}
