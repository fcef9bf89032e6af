//! `kutzbach exact` from outside: what it prints, and how it ends.

use std::process::Output;

fn exact(arguments: &[&str]) -> Output {
    crate::support::program()
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

/// Unknowns are renumbered, since names of joints are no names elsewhere; coefficients are whole numbers.
#[test]
fn the_equations_are_written_for_other_programs() {
    let file = "mechanisms/planar_four_bar.urdf";
    let msolve = text(&[file, "--format", "msolve"]);
    let lines: Vec<&str> = msolve.lines().collect();
    assert_eq!(lines[..2], ["x1,x2,x3,x4,x5,x6,x7,x8", "0"]);
    assert_eq!(lines[2], "x1^2+x2^2-1,");
    assert_eq!(lines.len(), 2 + 8);
    let singular = text(&[file, "--format", "singular"]);
    assert!(
        singular.starts_with("// x1: cos(crank_pivot)\n"),
        "{singular}"
    );
    let ideal = lines[2..].join("\n");
    assert!(
        singular.contains(&format!(
            "ring r = 0,({}),dp;\nideal I =\n{ideal};",
            lines[0]
        )),
        "{singular}"
    );
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
    assert_eq!(
        answer["relations"][3]["because_of"],
        serde_json::json!(["point"])
    );
}

/// All nine relations of the thesis' Cartesian table, the first of which leave dozens of freedoms; and a triangle whose sides hold
/// only together.
#[test]
fn relations_on_open_chains_cost_what_their_loops_cost() {
    for (file, dimensions) in [
        ("tests/thesis/oldham.urdf", vec![13, 8, 3, 1]),
        (
            "mechanisms/cartesian_table.urdf",
            vec![21, 17, 13, 11, 9, 7, 6, 4, 3],
        ),
        ("mechanisms/bennett.urdf", vec![13, 8, 3, 1]),
    ] {
        let answer = json(&[file, "--incremental"]);
        let relations = answer["relations"].as_array().unwrap();
        let found: Vec<u64> = relations
            .iter()
            .map(|relation| relation["dimension"].as_u64().unwrap())
            .collect();
        assert_eq!(found, dimensions, "{file}");
    }
    let answer = json(&["mechanisms/griffis_duffy.urdf", "--incremental"]);
    let last = &answer["relations"][5];
    assert_eq!(last["verdict"], "redundant");
    assert_eq!(last["because_of"].as_array().unwrap().len(), 5);
    let answer = json(&[
        "mechanisms/cartesian_table.urdf",
        "--incremental",
        "--time",
        "0",
    ]);
    assert_eq!(answer["relations"].as_array().unwrap().len(), 9);
    assert_eq!(answer["relations"][8]["verdict"], "not reached");
    // By what it forbids at the drawn pose, without the basis for its dimension.
    let answer = json(&["mechanisms/bennett.urdf", "--incremental", "--time", "0"]);
    for relation in answer["relations"].as_array().unwrap() {
        assert_eq!(relation["verdict"], "accepted");
        assert!(relation["dimension"].is_null());
    }
}

#[test]
fn a_spent_budget_is_an_answer() {
    let answer = json(&["mechanisms/cartesian_table.urdf", "--time", "0"]);
    assert_eq!(answer["outcome"]["word"], "stopped");
    assert!(answer["dimension"].is_null());
}

#[test]
fn angles_without_an_algebraic_cosine_are_refused() {
    let content = r#"<robot name="r"><link name="a"/><link name="b"/>
           <joint name="j" type="revolute"><parent link="a"/><child link="b"/>
             <origin xyz="0 0 0" rpy="0.3 0 0"/><axis xyz="0 0 1"/></joint>
           <loop name="k" type="revolute">
             <predecessor link="a"/><successor link="b"/><axis xyz="0 0 1"/></loop></robot>"#;
    let output = of_file("angle", content, &[]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("joint `j`") && said.contains("0.3 is"),
        "{said}"
    );
}

/// What was found before the time was over is told, with the reason; `--strict` makes a failure of it.
#[test]
fn a_time_limit_is_told() {
    for (strict, code) in [(None, 0), (Some("--strict"), 3)] {
        let output = crate::support::program()
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

/// Two four-bars on a base, with a camera: the angles by which the camera's mount, and both hinges of each loop on the base, are
/// tilted.
fn two_four_bars(camera: &str, first: [&str; 2], second: [&str; 2]) -> String {
    let mut text = format!(
        r#"<robot name="r"><link name="base"/><link name="camera"/>
        <joint name="look" type="fixed"><parent link="base"/><child link="camera"/>
          <origin xyz="0.1 0 0.4" rpy="0 {camera} 0"/></joint>"#
    );
    for (name, [here, there]) in [("a", first), ("b", second)] {
        text += &format!(
            r#"<link name="{name}1"/><link name="{name}2"/><link name="{name}3"/>
            <joint name="{name}_crank" type="continuous"><parent link="base"/><child link="{name}1"/>
              <origin rpy="{here} 0 0"/><axis xyz="0 0 1"/></joint>
            <joint name="{name}_rod" type="continuous"><parent link="{name}1"/><child link="{name}2"/>
              <origin xyz="0.4 0 0" rpy="0 0 0"/><axis xyz="0 0 1"/></joint>
            <joint name="{name}_rocker" type="continuous"><parent link="{name}2"/><child link="{name}3"/>
              <origin xyz="0.9 0 0" rpy="0 0 0"/><axis xyz="0 0 1"/></joint>
            <loop name="{name}_pin" type="revolute"><predecessor link="base"><origin xyz="1 0 0" rpy="{there} 0 0"/></predecessor>
              <successor link="{name}3"><origin xyz="0.7 0 0"/></successor><axis xyz="0 0 1"/></loop>"#
        );
    }
    text + "</robot>"
}

fn of_file(name: &str, content: &str, arguments: &[&str]) -> Output {
    let file = crate::support::empty_folder(&format!("exact_{name}")).join("m.urdf");
    std::fs::write(&file, content).unwrap();
    let mut all = vec![file.to_str().unwrap()];
    all.extend(arguments);
    exact(&all)
}

fn blocks_of(name: &str, content: &str) -> serde_json::Value {
    let output = of_file(name, content, &["--format", "json"]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn an_angle_outside_of_loops_is_in_nobodys_way() {
    let answer = blocks_of(
        "camera",
        &two_four_bars("0.3491234", ["0", "0"], ["0", "0"]),
    );
    assert_eq!(answer["dimension"], 2, "{answer:#}");
    assert_eq!(answer["outcome"]["word"], "done");
    assert_eq!(answer["blocks"][1]["dimension"], 1);
}

#[test]
fn what_one_loop_cannot_say_keeps_no_other_from_it() {
    let content = two_four_bars("0", ["0", "0"], ["${0.35+0.01}", "${0.36}"]);
    let answer = blocks_of("refused", &content);
    assert_eq!(answer["outcome"]["word"], "in part", "{answer:#}");
    assert!(answer["dimension"].is_null());
    assert_eq!(answer["blocks"][0]["answer"], "proved");
    assert_eq!(answer["blocks"][0]["dimension"], 1);
    assert_eq!(answer["blocks"][1]["answer"], "refused");
    let why = answer["blocks"][1]["text"].as_str().unwrap();
    assert!(why.contains("b_crank"), "{why}");
    let strict = of_file("strict", &content, &["--strict"]);
    assert_eq!(strict.status.code(), Some(3));
}

/// Angles are read as rational rotations within their digits: equal ones stay equal, and it is said. Others do not fit
/// together, and that is no statement about the mechanism.
#[test]
fn angles_with_digits_are_read_nearby_and_never_for_a_contradiction() {
    let content = two_four_bars("0", ["0.3491234", "0.3491234"], ["0.3491234", "0.3491235"]);
    let answer = blocks_of("nearby", &content);
    let [a, b] = [&answer["blocks"][0], &answer["blocks"][1]];
    assert!(answer["dimension"].is_null(), "{answer:#}");
    assert_eq!(
        (&a["answer"], &a["dimension"]),
        (&"nearby".into(), &1.into())
    );
    let text = a["text"].as_str().unwrap();
    assert!(
        text.contains("2 angles read as rational rotations"),
        "{text}"
    );
    assert_eq!(b["answer"], "undecided");
    assert!(b["dimension"].is_null());
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
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
}
