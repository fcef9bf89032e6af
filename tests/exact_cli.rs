//! `kutzbach exact` from outside: what it prints, and how it ends.

#![allow(clippy::unwrap_used)]

use std::process::{Command, Output};

fn exact(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_kutzbach"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .arg("exact")
        .args(arguments)
        .output()
        .unwrap()
}

fn text(arguments: &[&str]) -> String {
    let output = exact(arguments);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).unwrap()
}

fn json(arguments: &[&str]) -> serde_json::Value {
    let mut arguments = arguments.to_vec();
    arguments.extend(["--format", "json"]);
    serde_json::from_str(&text(&arguments)).unwrap()
}

#[test]
fn the_same_question_has_the_same_bytes() {
    let question = ["mechanisms/bennett.urdf", "--print", "basis"];
    let first = text(&question);
    assert_eq!(first, text(&question));
    assert!(first.contains("complex dimension 1, degree 4"), "{first}");
}

#[test]
fn methods_agree_on_the_basis() {
    let ask = |method: &str| {
        json(&[
            "mechanisms/cartesian_table.urdf",
            "--print",
            "basis",
            "--method",
            method,
        ])
    };
    let (brute, divided) = (ask("brute"), ask("divide"));
    assert_eq!(brute["basis"], divided["basis"]);
    assert_eq!(brute["dimension"], 3);
    let incremental = ask("incremental");
    assert_eq!(incremental["dimension"], 3);
    // Each of the eight pieces is carried to the end.
    assert_eq!(incremental["cases"][0].as_array().unwrap().len(), 8);
}

#[test]
fn relations_are_judged_one_by_one() {
    let answer = json(&["mechanisms/thomas_torras_assembly.urdf", "--incremental"]);
    let verdicts: Vec<&str> = answer["relations"]
        .as_array()
        .unwrap()
        .iter()
        .map(|relation| relation["verdict"].as_str().unwrap())
        .collect();
    assert_eq!(verdicts.len(), 6);
    assert_eq!(verdicts[0], "accepted");
    assert_eq!(answer["relations"][5]["dimension"], 2);
    let answer = json(&["tests/thesis/plug_lines_and_points.urdf", "--incremental"]);
    assert_eq!(answer["relations"][3]["verdict"], "inconsistent");
}

#[test]
fn a_spent_budget_is_an_answer() {
    let answer = json(&["mechanisms/cartesian_table.urdf", "--time", "0"]);
    assert_eq!(answer["outcome"]["word"], "stopped");
    assert!(answer["dimension"].is_null());
}

#[test]
fn angles_without_an_algebraic_cosine_are_refused() {
    let file = std::env::temp_dir().join(format!("kutzbach-exact-{}.urdf", std::process::id()));
    std::fs::write(
        &file,
        r#"<robot name="r"><link name="a"/><link name="b"/>
           <joint name="j" type="revolute"><parent link="a"/><child link="b"/>
             <origin xyz="0 0 0" rpy="1.5708 0 0"/><axis xyz="0 0 1"/></joint>
           <loop name="k" type="revolute">
             <predecessor link="a"/><successor link="b"/><axis xyz="0 0 1"/></loop></robot>"#,
    )
    .unwrap();
    let output = exact(&[file.to_str().unwrap()]);
    std::fs::remove_file(&file).unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains('j') && said.contains("1.5708"), "{said}");
}

/// What was found before the time was over is told, with the reason; `--strict` makes a failure of it.
#[test]
fn a_time_limit_is_told() {
    for (strict, code) in [(None, 0), (Some("--strict"), 3)] {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_kutzbach"))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(["exact", "mechanisms/delta.urdf", "--time", "0.3"])
            .args(strict)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(code));
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(said.contains("the time limit was reached"), "{said}");
    }
}
