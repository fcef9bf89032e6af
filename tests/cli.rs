//! The command line as a user meets it: what it prints, what it exits with, what it leaves behind.
use std::fs;
use std::path::PathBuf;
use std::process::{Output, Stdio};

const BAR: &str = r#"<robot name="bar" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="ground"/> <link name="crank"/> <link name="coupler"/> <link name="rocker"/>
  <xacro:property name="length" value="2"/>
  <joint name="A" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
  <joint name="B" type="revolute"><parent link="crank"/><child link="coupler"/><origin xyz="0 1 0"/><axis xyz="0 0 1"/></joint>
  <joint name="D" type="revolute"><parent link="ground"/><child link="rocker"/><origin xyz="${length} 0 0"/><axis xyz="0 0 1"/></joint>
  <loop name="C" type="revolute">
    <predecessor link="coupler"><origin xyz="${length} 0 0"/></predecessor>
    <successor link="rocker"><origin xyz="0 1 0"/></successor>
    <axis xyz="0 0 1"/>
  </loop>
  <expect kutzbach="-2"/>
</robot>
"#;

/// A folder of its own for one test.
fn folder(test: &str) -> PathBuf {
    crate::support::empty_folder(&format!("cli_{test}"))
}

fn kutzbach(folder: &PathBuf, arguments: &[&str]) -> Output {
    crate::support::program()
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn report_prints_a_page_without_colour_into_a_pipe() {
    let folder = folder("page");
    fs::write(folder.join("bar.urdf"), BAR).unwrap();
    let output = kutzbach(&folder, &["report", "bar.urdf"]);
    assert_eq!(output.status.code(), Some(0));
    let page = text(&output.stdout);
    assert!(page.contains("Counts  Kutzbach"), "{page}");
    assert!(page.contains("bar (bar.urdf): 4 links, 4 joints and 1 independent loop"));
    assert!(!page.contains('\u{1b}'));
    assert!(output.stderr.is_empty());
}

#[test]
fn report_writes_json_that_is_the_same_every_time() {
    let folder = folder("json");
    fs::write(folder.join("bar.urdf"), BAR).unwrap();
    let once = kutzbach(&folder, &["report", "bar.urdf", "--format", "json"]);
    let again = kutzbach(&folder, &["report", "bar.urdf", "--format", "json"]);
    assert_eq!(once.stdout, again.stdout);
    let report: serde_json::Value = serde_json::from_slice(&once.stdout).unwrap();
    assert_eq!(report["schema"], "kutzbach-report-2");
    assert_eq!(report["kutzbach"], -2);
    assert_eq!(report["size"]["loops"], 1);
    assert!(report.get("timing").is_none());
}

#[test]
fn strict_exits_with_3_where_anything_asked_is_not_decided() {
    let folder = folder("strict");
    // A frame longer than the three other bars together.
    for (name, frame, code) in [("bar.urdf", "2", 0), ("short.urdf", "7", 3)] {
        let text = BAR.replacen("xyz=\"${length} 0 0\"", &format!("xyz=\"{frame} 0 0\""), 1);
        fs::write(folder.join(name), text).unwrap();
        let arguments = ["report", name, "--format", "json", "--strict"];
        let output = kutzbach(&folder, &arguments);
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let unassembled = report["mobility"]["verdict"] == "unassembled";
        assert_eq!(unassembled, code == 3, "{name}");
        assert_eq!(output.status.code(), Some(code), "{name}");
    }
}

#[test]
fn output_replaces_a_file_as_a_whole_and_leaves_nothing_else() {
    let folder = folder("output");
    fs::write(folder.join("bar.urdf"), BAR).unwrap();
    fs::write(folder.join("out.json"), "x".repeat(1 << 20)).unwrap();
    let arguments = ["report", "bar.urdf", "--format", "json", "-o", "out.json"];
    let output = kutzbach(&folder, &arguments);
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stdout.is_empty());
    let written = fs::read(folder.join("out.json")).unwrap();
    assert!(serde_json::from_slice::<serde_json::Value>(&written).is_ok());
    let mut left: Vec<_> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    left.sort();
    assert_eq!(left, ["bar.urdf", "out.json"]);

    let output = kutzbach(&folder, &["report", "bar.urdf", "-o", "no/such/folder"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("cannot write `no/such/folder`"));
}

#[cfg(unix)]
#[test]
fn a_device_is_written_to_and_not_replaced() {
    let folder = folder("device");
    fs::write(folder.join("bar.urdf"), BAR).unwrap();
    let output = kutzbach(&folder, &["report", "bar.urdf", "-o", "/dev/null"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
}

#[test]
fn bad_input_is_shown_with_line_column_and_hint() {
    let folder = folder("bad");
    fs::write(
        folder.join("bar.urdf"),
        BAR.replace(
            "<loop name=\"C\" type=\"revolute\">",
            "<loop name=\"C\" type=\"revolut\">",
        ),
    )
    .unwrap();
    let output = kutzbach(&folder, &["report", "bar.urdf"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let message = text(&output.stderr);
    for part in ["bar.urdf:7:", "<loop name=\"C\"", "revolut", "help: "] {
        assert!(message.contains(part), "{part} in {message}");
    }
    assert!(!message.contains('\u{1b}'));
}

#[test]
fn settings_reach_the_file_and_bad_ones_are_refused() {
    let folder = folder("set");
    fs::write(folder.join("bar.urdf"), BAR).unwrap();
    for (arguments, code) in [
        (vec!["report", "bar.urdf", "--set", "length=5/2"], 0),
        (vec!["report", "bar.urdf", "--set", "lenght=5/2"], 2),
        (vec!["report", "bar.urdf", "--set", "length=1/0"], 2),
        (vec!["report", "bar.urdf", "--set", "length"], 2),
        (vec!["report", "bar.urdf", "--at", "open"], 2),
        (vec!["report", "missing.urdf"], 2),
        (vec!["report", "."], 2),
        (vec!["fold", "bar.urdf"], 2),
        (vec!["graph", "bar.urdf", "--set", "length=3"], 0),
    ] {
        let output = kutzbach(&folder, &arguments);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}");
        assert_eq!(output.stderr.is_empty(), code == 0, "{arguments:?}");
    }
}

/// A mechanism of the repository through whose pose two branches pass.
const MOVES_BY_ITS_SIZES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms/bennett.urdf");
const DOES_NOT_ASSEMBLE: &str = "long.urdf";
const TWO_BRANCHES: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/mechanisms/parallelogram_flat.urdf"
);

fn json(output: &Output) -> serde_json::Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn evidence_is_told_where_it_is_asked_for() {
    let folder = folder("evidence");
    let page = |more: &[&str]| {
        let arguments = [&["report", TWO_BRANCHES][..], more].concat();
        let output = kutzbach(&folder, &arguments);
        assert_eq!(output.status.code(), Some(0));
        output
    };
    assert!(!text(&page(&[]).stdout).contains("Evidence"));
    let told = text(&page(&["--evidence"]).stdout);
    let (_, told) = told.split_once("Evidence").unwrap();
    for engine in ["rank", "subgroup", "chart", "germ"] {
        assert!(told.contains(&format!("• {engine} (")), "{engine}: {told}");
    }
    assert!(json(&page(&["--format", "json"])).get("evidence").is_none());
    let report = json(&page(&["--format", "json", "--evidence"]));
    let evidence = report["evidence"].as_array().unwrap();
    let rank = &evidence[0];
    assert_eq!(
        (&rank["engine"], &rank["bounds"][1]),
        (&"rank".into(), &2.into())
    );
    let least = evidence
        .iter()
        .filter_map(|e| e["bounds"][1].as_u64())
        .min();
    assert_eq!(least, Some(1));
    assert!(
        evidence
            .iter()
            .all(|e| e["block"] == report["home"]["blocks"][0]["name"])
    );
}

/// Less depth says the same as far as it goes, and what was not asked for is not said.
#[test]
fn a_report_of_less_depth_says_the_same_as_far_as_it_goes() {
    let folder = folder("depth");
    // A frame longer than the three other bars together.
    let long = BAR.replacen("xyz=\"${length} 0 0\"", "xyz=\"7 0 0\"", 1);
    fs::write(folder.join(DOES_NOT_ASSEMBLE), long).unwrap();
    for file in [TWO_BRANCHES, MOVES_BY_ITS_SIZES, DOES_NOT_ASSEMBLE] {
        let at = |depth: &str| {
            let output = kutzbach(
                &folder,
                &["report", file, "--format", "json", "--depth", depth],
            );
            assert_eq!(output.status.code(), Some(0), "{file} {depth}");
            json(&output)
        };
        let [counts, verdict, everything] = ["counts", "verdict", "everything"].map(at);
        assert!(everything.get("depth").is_none());
        for field in ["instantaneous", "rank", "redundant", "kept", "dropped"] {
            assert_eq!(counts["home"][field], everything["home"][field], "{file}");
        }
        for field in ["verdict", "finite", "class", "nominal"] {
            let (one, other) = (&verdict["mobility"], &everything["mobility"]);
            assert_eq!(one[field], other[field], "{file}: {field}");
        }
        for field in ["pose", "kind", "instantaneous"] {
            assert_eq!(verdict["home"][field], everything["home"][field], "{file}");
        }
        for (depth, report) in [("counts", &counts), ("verdict", &verdict)] {
            assert_eq!(report["depth"], depth);
            assert!(report["branches"].is_null() && report["inputs"].is_null());
            assert_eq!(report["advice"], serde_json::json!([]), "{file} {depth}");
            assert_eq!(report["assembly"], everything["assembly"], "{file}");
        }
    }
    let page = |file: &str, depth: &str| {
        text(&kutzbach(&folder, &["report", file, "--depth", depth]).stdout)
    };
    let counts = page(MOVES_BY_ITS_SIZES, "counts");
    assert!(counts.starts_with("At this pose 1 degree of freedom to first order."));
    assert!(!counts.contains("Undecided") && counts.contains("`--depth verdict`"));
    let verdict = page(MOVES_BY_ITS_SIZES, "verdict");
    assert!(verdict.starts_with("Mobile: 1 degree of freedom") && verdict.contains("paradoxical"));
    assert!(!verdict.contains("Joints") && verdict.contains("Without `--depth`"));
    let open = [
        page(DOES_NOT_ASSEMBLE, "counts"),
        page(DOES_NOT_ASSEMBLE, "everything"),
    ];
    let [counts, everything] = open.map(|page| page.lines().next().map(str::to_owned));
    assert_eq!(counts, everything);
}

#[test]
fn what_a_depth_leaves_out_cannot_be_asked_for() {
    let folder = folder("depth_refused");
    for (depth, more) in [
        ("verdict", &["--format", "html"][..]),
        ("verdict", &["--between", "a", "b"]),
        ("verdict", &["--inputs", "a"]),
        ("counts", &["--play"]),
        ("counts", &["--strict"]),
        ("counts", &["--exact", "1"]),
        ("counts", &["--evidence"]),
    ] {
        let arguments = [&["report", TWO_BRANCHES, "--depth", depth][..], more].concat();
        let output = kutzbach(&folder, &arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let told = text(&output.stderr);
        assert!(told.contains("`--depth` leaves out"), "{told}");
    }
}

#[test]
fn motions_between_links_are_told_on_every_branch() {
    let folder = folder("between");
    let arguments = ["report", TWO_BRANCHES, "--between", "coupler", "ground"];
    let page = text(&kutzbach(&folder, &arguments).stdout);
    let (_, asked) = page.split_once("Relative motions asked for").unwrap();
    let (asked, others) = asked.split_once("Motion, seen from").unwrap();
    assert!(asked.contains("translates") && asked.contains("rotates about a moving axis"));
    assert!(
        !others.split_once("Joints").unwrap().0.contains("coupler "),
        "{others}"
    );

    let twice = ["--between", "right_crank", "left_crank", "--format", "json"];
    let report = json(&kutzbach(&folder, &[&arguments[..], &twice].concat()));
    let asked: Vec<(&str, &str, &str, u64)> = report["motions"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|motion| motion["asked"] == true)
        .map(|motion| {
            let word = |field: &str| motion[field].as_str().unwrap();
            let turns = motion["rotations"].as_u64().unwrap();
            (word("link"), word("relative_to"), word("branch"), turns)
        })
        .collect();
    let of = |link: &str, seen_from: &str| -> Vec<u64> {
        let rows = asked
            .iter()
            .filter(|row| (row.0, row.1) == (link, seen_from));
        let mut turns: Vec<u64> = rows.map(|row| row.3).collect();
        turns.sort_unstable();
        turns
    };
    // As a parallelogram the coupler is translated, crossed it turns; and so do the cranks seen from one another.
    assert_eq!(asked.len(), 4, "{asked:?}");
    assert_eq!(of("coupler", "ground"), [0, 1]);
    assert_eq!(of("right_crank", "left_crank"), [0, 1]);
}

#[test]
fn links_that_do_not_exist_are_refused_with_a_hint() {
    let folder = folder("unknown_link");
    fs::write(folder.join("bar.urdf"), BAR).unwrap();
    for (links, help) in [
        (["couple", "ground"], "did you mean `coupler`?"),
        (["coupler", "grond"], "did you mean `ground`?"),
        (
            ["coupler", "quadrant"],
            "`kutzbach graph FILE` lists all links",
        ),
    ] {
        let output = kutzbach(
            &folder,
            &["report", "bar.urdf", "--between", links[0], links[1]],
        );
        assert_eq!(output.status.code(), Some(2));
        assert!(output.stdout.is_empty());
        let message = text(&output.stderr);
        assert!(
            message.contains("there is no link `") && message.contains(help),
            "{message}"
        );
    }
    let output = kutzbach(&folder, &["report", "bar.urdf", "--between", "coupler"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn check_compares_both_sources_and_exits_with_1_on_a_disagreement() {
    let folder = folder("check");
    fs::create_dir(folder.join("inner")).unwrap();
    fs::write(folder.join("inner/bar.urdf"), BAR).unwrap();
    fs::write(
        folder.join("other.urdf"),
        BAR.replace("<expect kutzbach=\"-2\"/>", ""),
    )
    .unwrap();
    let output = kutzbach(&folder, &["check", "."]);
    assert_eq!(output.status.code(), Some(0));
    let page = text(&output.stdout);
    assert!(
        page.contains("2 files: 1 fact right, 0 wrong, 0 open. Nothing is known of 1 file."),
        "{page}"
    );

    fs::write(
        folder.join("expected.json"),
        r#"{"other": {"kutzbach": 1, "idle": null, "colour": "red"}, "gone": {}}"#,
    )
    .unwrap();
    let output = kutzbach(&folder, &["check", "."]);
    assert_eq!(output.status.code(), Some(1));
    let page = text(&output.stdout);
    for part in [
        "1 disagreement",
        "other.urdf",
        "kutzbach",
        "other.colour",
        "`gone`",
    ] {
        assert!(page.contains(part), "{part} in {page}");
    }
    let output = kutzbach(
        &folder,
        &["check", "inner/bar.urdf", "other.urdf", "--format", "json"],
    );
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["disagreements"][0]["what"], "kutzbach");
    assert_eq!(json["disagreements"][0]["expected"], "1");
    assert_eq!(json["disagreements"][0]["found"], "-2");
    assert_eq!(json["right"], 1);
}

/// Nothing known, nothing read, nothing compared: no success where one asks for strictness.
#[test]
fn a_strict_check_fails_where_anything_is_missing_and_an_update_mends_it() {
    let folder = folder("strict");
    let unknown = BAR.replace("<expect kutzbach=\"-2\"/>", "");
    fs::write(folder.join("bar.urdf"), unknown).unwrap();
    let code = |more: &[&str]| {
        let arguments = [&["check", "."], more].concat();
        kutzbach(&folder, &arguments).status.code()
    };
    assert_eq!((code(&[]), code(&["--strict"])), (Some(0), Some(1)));
    assert_eq!(code(&["--update"]), Some(0));
    assert_eq!(code(&["--strict"]), Some(0), "everything is known now");
    let path = folder.join("expected.json");
    let mut known: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    assert_eq!(known["bar"]["kutzbach"], -2);
    // What is wrong is put right; what nothing reads is kept, and no success.
    known["bar"]["kutzbach"] = 7.into();
    known["bar"]["colour"] = "red".into();
    fs::write(&path, known.to_string()).unwrap();
    assert_eq!(code(&["--update"]), Some(1), "it was wrong");
    assert_eq!((code(&[]), code(&["--strict"])), (Some(0), Some(1)));
    let known: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    assert_eq!(
        (&known["bar"]["kutzbach"], &known["bar"]["colour"]),
        (&(-2).into(), &"red".into())
    );
}

#[test]
fn a_dash_reads_standard_input() {
    let run = |text: &str| {
        let mut child = crate::support::program()
            .args(["report", "-", "--format", "json"])
            .stdin(std::process::Stdio::piped())
            .stdout(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        use std::io::Write;
        child
            .stdin
            .take()
            .unwrap()
            .write_all(text.as_bytes())
            .unwrap();
        child.wait_with_output().unwrap()
    };
    let output = run(BAR);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["kutzbach"], -2);
    let output = run("<robot");
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("standard input:1:"));
}

#[test]
fn check_tells_unreadable_files_after_all_others() {
    let folder = folder("unreadable");
    fs::write(folder.join("a.urdf"), "<robot").unwrap();
    fs::write(folder.join("b.urdf"), BAR).unwrap();
    let output = kutzbach(&folder, &["check", "."]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stdout).contains("2 files: 1 fact right"));
    assert!(text(&output.stderr).contains("a.urdf:1:"));
    fs::write(folder.join("expected.json"), "{").unwrap();
    let output = kutzbach(&folder, &["check", "b.urdf"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("expected.json:1:"));
    let output = kutzbach(&folder, &["check", "nowhere"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn graph_has_four_forms() {
    let folder = folder("graph");
    fs::write(folder.join("bar.urdf"), BAR).unwrap();
    for (format, part) in [
        ("text", "ground"),
        ("dot", "graph"),
        ("svg", "<svg"),
        ("json", "\"chords\""),
    ] {
        let output = kutzbach(&folder, &["graph", "bar.urdf", "--format", format]);
        assert_eq!(output.status.code(), Some(0));
        assert!(text(&output.stdout).contains(part), "{format}");
    }
}

#[test]
fn explain_defines_words_and_suggests_near_ones() {
    let folder = folder("explain");
    let output = kutzbach(&folder, &["explain", "permanently", "shaky"]);
    assert!(text(&output.stdout).starts_with("D7 "));
    let output = kutzbach(&folder, &["explain"]);
    assert!(text(&output.stdout).contains("D12"));
    let output = kutzbach(&folder, &["explain", "redundent"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("did you mean `redundant`?"));
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    let folder = folder("pipe");
    let links: String = (0..3000)
        .map(|n| {
            format!(
                "<link name=\"l{}\"/><joint name=\"j{n}\" type=\"revolute\"><parent link=\"l{n}\"/><child link=\"l{}\"/></joint>",
                n + 1,
                n + 1
            )
        })
        .collect();
    let chain = format!("<robot name=\"chain\"><link name=\"l0\"/>{links}</robot>");
    fs::write(folder.join("chain.urdf"), chain).unwrap();
    let mut child = crate::support::program()
        .args(["graph", "chain.urdf", "--format", "dot"])
        .current_dir(&folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(output.stderr.is_empty());
}

#[test]
fn shells_and_manuals_are_told_all_commands() {
    let folder = folder("shells");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let output = kutzbach(&folder, &["completions", shell]);
        assert_eq!(output.status.code(), Some(0), "{shell}");
        let script = text(&output.stdout);
        for word in ["assemble", "write-assembled", "closure-tolerance"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
        // Values of options are completed where the shell lets them be.
        let values = matches!(shell, "bash" | "zsh" | "fish");
        assert!(!values || script.contains("junit"), "{shell}");
    }
    let page = text(&kutzbach(&folder, &["man"]).stdout);
    assert!(
        page.starts_with(".ie") && page.contains("kutzbach\\-report"),
        "{page}"
    );
    let page = text(&kutzbach(&folder, &["man", "report"]).stdout);
    assert!(
        page.contains(".SH \"READING THE FILE\"") && page.contains("\\-\\-literal"),
        "{page}"
    );
    let unknown = kutzbach(&folder, &["man", "reprot"]);
    assert_eq!(unknown.status.code(), Some(2));
}

#[test]
fn everyday_options_stand_before_the_groups_of_others() {
    let folder = folder("help");
    let help = text(&kutzbach(&folder, &["report", "--help"]).stdout);
    let at = |part: &str| help.find(part).unwrap_or_else(|| panic!("{part}: {help}"));
    assert!(at("\nOptions:") < at("--format") && at("--units") < at("\nReading the file:"));
    assert!(at("\nReading the file:") < at("--literal"));
    assert!(at("\nFurther questions:") < at("--between"));
}

#[test]
fn a_check_as_junit_has_a_case_for_every_file_and_the_lines() {
    let folder = folder("junit");
    fs::write(folder.join("right.urdf"), BAR).unwrap();
    fs::write(
        folder.join("wrong.urdf"),
        BAR.replace("kutzbach=\"-2\"", "kutzbach=\"7\""),
    )
    .unwrap();
    fs::write(
        folder.join("beside.urdf"),
        BAR.replace("<expect kutzbach=\"-2\"/>", ""),
    )
    .unwrap();
    fs::write(
        folder.join("unknown.urdf"),
        BAR.replace("<expect kutzbach=\"-2\"/>", ""),
    )
    .unwrap();
    fs::write(folder.join("broken.urdf"), "<robot>").unwrap();
    fs::write(
        folder.join("expected.json"),
        "{\n  \"beside\": {\n    \"finite\": 5}\n}\n",
    )
    .unwrap();
    let output = kutzbach(&folder, &["check", ".", "--format", "junit"]);
    assert_eq!(output.status.code(), Some(2));
    let junit = text(&output.stdout);
    let document = roxmltree::Document::parse(&junit).unwrap();
    let suites = document.root_element();
    let counts = ["tests", "failures", "errors", "skipped"].map(|name| suites.attribute(name));
    assert_eq!(counts, ["5", "2", "1", "1"].map(Some), "{junit}");
    let cases = document
        .descendants()
        .filter(|node| node.has_tag_name("testcase"));
    let said: Vec<_> = cases
        .map(|case| {
            let what = case.first_element_child().map(|inner| {
                let text = inner.text().or(inner.attribute("message"));
                (
                    inner.tag_name().name().to_owned(),
                    text.unwrap_or_default().to_owned(),
                )
            });
            (
                case.attribute("name").unwrap(),
                case.attribute("line"),
                what,
            )
        })
        .collect();
    let what = |tag: &str, text: &str| Some((tag.to_owned(), text.to_owned()));
    let known = "./expected.json:2: finite: expected 5, found 1";
    let own = "./wrong.urdf:12: kutzbach: expected 7, found -2";
    assert_eq!(said[0], ("beside", None, what("failure", known)), "{junit}");
    assert_eq!(said[2], ("right", Some("12"), None));
    assert_eq!(
        said[3],
        ("unknown", None, what("skipped", "nothing is known of it"))
    );
    assert_eq!(said[4], ("wrong", Some("12"), what("failure", own)));
    assert!(matches!(&said[1], ("broken", None, Some((tag, _))) if tag == "error"));
    // The table tells the line too.
    let table = text(&kutzbach(&folder, &["check", "wrong.urdf", "beside.urdf"]).stdout);
    assert!(
        table.contains("wrong.urdf:12") && table.contains("5 (expected.json:2)"),
        "{table}"
    );
}
