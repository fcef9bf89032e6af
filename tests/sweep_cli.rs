//! `kutzbach sweep`: a row for each variant, the same whatever shares the work is done in, and wherever it was cut off.

use crate::support::empty_folder;
use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};

/// Bennett's linkage with its third hinge tilted by `off`: it closes for any, and moves for 0 only.
const SPOILED: &str = "mechanisms/bennett_spoiled.urdf";

/// A four-bar whose coupler reaches from crank to rocker or does not.
const FOUR_BAR: &str = r#"<robot name="four_bar" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="ground"/> <link name="crank"/> <link name="coupler"/> <link name="rocker"/>
  <xacro:property name="bar" value="2"/>
  <joint name="A" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
  <joint name="B" type="revolute"><parent link="crank"/><child link="coupler"/><origin xyz="0 1 0"/><axis xyz="0 0 1"/></joint>
  <joint name="D" type="revolute"><parent link="ground"/><child link="rocker"/><origin xyz="2 0 0"/><axis xyz="0 0 1"/></joint>
  <loop name="C" type="revolute">
    <predecessor link="coupler"><origin xyz="${bar} 0 0"/></predecessor>
    <successor link="rocker"><origin xyz="0 1 0"/></successor>
    <axis xyz="0 0 1"/>
  </loop>
</robot>
"#;

fn sweep(arguments: &[&str]) -> Output {
    crate::support::program()
        .arg("sweep")
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn done(arguments: &[&str]) -> String {
    let output = sweep(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Rows of CSV without quotes, by the names of their columns.
fn rows(csv: &str) -> Vec<Vec<(&str, &str)>> {
    let mut lines = csv.lines();
    assert!(lines.next().unwrap().starts_with("# {"), "{csv}");
    let columns: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| columns.iter().copied().zip(line.split(',')).collect())
        .collect()
}

fn column<'a>(rows: &[Vec<(&'a str, &'a str)>], name: &str) -> Vec<&'a str> {
    rows.iter()
        .map(|row| row.iter().find(|(own, _)| *own == name).unwrap().1)
        .collect()
}

#[test]
fn bennetts_condition_is_one_point_of_a_range() {
    let csv = done(&[SPOILED, "--over", "off=-0.002..0.002:5"]);
    let rows = rows(&csv);
    let off = ["-0.002", "-0.001", "0", "0.001", "0.002"];
    assert_eq!(column(&rows, "off"), off);
    assert_eq!(column(&rows, "finite"), ["0", "0", "1", "0", "0"]);
    let verdicts = ["rigid", "rigid", "mobile", "rigid", "rigid"];
    assert_eq!(column(&rows, "verdict"), verdicts);
    assert_eq!(column(&rows, "redundant"), ["2", "2", "3", "2", "2"]);
    assert_eq!(column(&rows, "status"), ["analysed"; 5]);
}

#[test]
fn a_dash_is_standard_output() {
    let asked = [SPOILED, "--over", "off=-1..1:3", "--depth", "rank"];
    let dashed = [&asked[..], &["-o", "-"]].concat();
    assert_eq!(done(&dashed), done(&asked));
    assert!(!Path::new(env!("CARGO_MANIFEST_DIR")).join("-").exists());
}

#[test]
fn the_rank_has_fewer_columns() {
    let csv = done(&[SPOILED, "--over", "off=0,0.001", "--depth", "rank"]);
    let rows = rows(&csv);
    assert_eq!(column(&rows, "instantaneous"), ["1", "0"]);
    assert!(!csv.contains("verdict,"), "{csv}");
}

#[test]
fn shares_are_the_whole() {
    let asked = [SPOILED, "--over", "off=-0.01..0.01:23", "--depth", "rank"];
    let lines = |shard: &str| -> Vec<String> {
        let csv = done(&[&asked[..], &["--shard", shard]].concat());
        csv.lines().skip(2).map(str::to_owned).collect()
    };
    let mut whole = lines("1/1");
    assert_eq!(whole.len(), 23);
    whole.sort();
    for of in [2, 16, 40] {
        let mut shares: Vec<String> = (1..=of)
            .flat_map(|number| lines(&format!("{number}/{of}")))
            .collect();
        shares.sort();
        assert_eq!(shares, whole, "{of}");
    }
}

#[test]
fn a_file_that_was_cut_off_is_continued_to_the_same_bytes() {
    let folder = empty_folder("sweep_resume");
    for name in ["out.csv", "out.jsonl"] {
        let file = folder.join(name);
        let path = file.to_str().unwrap();
        let asked = [SPOILED, "--over", "off=0..0.01:9", "-o", path];
        done(&asked);
        let whole = fs::read(&file).unwrap();
        assert!(!whole.is_empty());
        // In the middle of the first line, of a row, behind a row, and complete.
        let behind_a_row = whole.len() - 1 - position_from_end(&whole);
        for cut in [
            0,
            10,
            whole.len() / 2,
            behind_a_row,
            whole.len() - 3,
            whole.len(),
        ] {
            fs::write(&file, &whole[..cut]).unwrap();
            done(&asked);
            assert_eq!(
                text(&fs::read(&file).unwrap()),
                text(&whole),
                "{name}: {cut}"
            );
        }
        // Rows that are none of this sweep are computed again.
        let mut spoiled = whole.clone();
        spoiled.truncate(behind_a_row);
        spoiled.extend(b"4711,no row of this sweep\n");
        fs::write(&file, &spoiled).unwrap();
        done(&asked);
        assert_eq!(text(&fs::read(&file).unwrap()), text(&whole));
    }
}

/// Killed while it writes, at whatever byte, again and again.
#[test]
fn a_sweep_that_was_killed_goes_on_to_the_same_bytes() {
    let folder = empty_folder("sweep_killed");
    let [whole, torn] = ["whole.csv", "torn.csv"].map(|name| folder.join(name));
    let asked = [SPOILED, "--over", "off=0..0.01:1500", "--depth", "rank"];
    let [into_whole, into_torn] = [&whole, &torn].map(|file| {
        let into = ["-o", file.to_str().unwrap()];
        [&asked[..], &into].concat()
    });
    done(&into_whole);
    let length = |file: &Path| fs::metadata(file).map_or(0, |known| known.len());
    let mut kills = 0;
    for _ in 0..3 {
        let before = length(&torn);
        let mut child = crate::support::program()
            .arg("sweep")
            .args(&into_torn)
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .stdin(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        while length(&torn) <= before && child.try_wait().unwrap().is_none() {
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        child.kill().unwrap();
        kills += usize::from(!child.wait().unwrap().success());
        assert!(
            fs::read(&whole)
                .unwrap()
                .starts_with(&fs::read(&torn).unwrap())
        );
    }
    assert!(kills > 0, "it was done before it could be killed");
    done(&into_torn);
    assert_eq!(
        text(&fs::read(&torn).unwrap()),
        text(&fs::read(&whole).unwrap())
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_disk_without_space_is_told() {
    let asked = [SPOILED, "--over", "off=0..0.01:5", "--depth", "rank"];
    let output = sweep(&[&asked[..], &["-o", "/dev/full"]].concat());
    assert_eq!(output.status.code(), Some(2));
    let stderr = text(&output.stderr);
    assert!(stderr.contains("cannot write `/dev/full`"), "{stderr}");
    let full = fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let output = crate::support::program()
        .arg("sweep")
        .args(asked)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(full)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let stderr = text(&output.stderr);
    assert!(
        stderr.contains("cannot write to standard output"),
        "{stderr}"
    );
}

/// How many bytes the last line has, with its line break, less one.
fn position_from_end(bytes: &[u8]) -> usize {
    let without_last = &bytes[..bytes.len() - 1];
    without_last
        .iter()
        .rev()
        .position(|byte| *byte == b'\n')
        .unwrap()
}

#[test]
fn another_sweep_is_not_continued() {
    let folder = empty_folder("sweep_other");
    let file = folder.join("out.csv");
    let path = file.to_str().unwrap();
    done(&[SPOILED, "--over", "off=0,0.001", "-o", path]);
    let before = fs::read(&file).unwrap();
    for other in [
        &["--over", "off=0,0.002"][..],
        &["--over", "off=0,0.001", "--shard", "1/2"],
        &["--over", "off=0,0.001", "--depth", "rank"],
    ] {
        let output = sweep(&[&[SPOILED, "-o", path][..], other].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(text(&output.stderr).contains("something else"));
        assert_eq!(fs::read(&file).unwrap(), before);
    }
}

#[test]
fn variants_without_an_answer_are_rows_with_a_reason() {
    let json = done(&[SPOILED, "--over", "off=acos(2),0", "--format", "jsonl"]);
    let lines: Vec<serde_json::Value> = json
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(lines.len(), 3);
    assert_eq!(lines[0]["schema"], "kutzbach-sweep-1");
    assert_eq!(lines[1]["status"], "invalid");
    assert_eq!(lines[1]["measures"]["off"], "acos(2)");
    assert!(lines[1]["reason"].as_str().unwrap().contains(SPOILED));
    assert!(lines[1]["verdict"].is_null());
    assert_eq!(lines[2]["status"], "analysed");
    assert_eq!(lines[2]["measures"]["off"], 0);
    assert_eq!(lines[2]["finite"], 1);
}

#[test]
fn a_loop_that_does_not_close_is_told() {
    let folder = empty_folder("sweep_open");
    let file = written(&folder);
    let json = done(&[
        &file, "--over", "bar=2,10", "--format", "jsonl", "--depth", "motions",
    ]);
    let lines: Vec<serde_json::Value> = json
        .lines()
        .skip(1)
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(lines[0]["finite"], 1);
    assert_eq!(lines[0]["branches"], 1);
    assert_eq!(lines[0]["locked"], serde_json::json!([]));
    assert_eq!(lines[1]["status"], "unassembled");
    assert_eq!(lines[1]["verdict"], "unassembled");
    assert!(!lines[1]["reason"].as_str().unwrap().is_empty());
}

fn written(folder: &Path) -> String {
    let file = folder.join("four_bar.urdf");
    fs::write(&file, FOUR_BAR).unwrap();
    file.to_str().unwrap().to_owned()
}

#[test]
fn rows_say_what_reports_of_single_files_say() {
    let csv = done(&[SPOILED, "--over", "off=0,1/1000"]);
    for row in rows(&csv) {
        let value = |name: &str| row.iter().find(|(own, _)| *own == name).unwrap().1;
        let set = format!("off={}", value("off"));
        let output = crate::support::program()
            .args(["report", SPOILED, "--format", "json", "--set", &set])
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .unwrap();
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let mobility = &report["mobility"];
        assert_eq!(mobility["finite"].to_string(), value("finite"));
        assert_eq!(mobility["verdict"], value("verdict"));
        assert_eq!(report["home"]["redundant"].to_string(), value("redundant"));
        assert_eq!(report["home"]["pose"], value("pose"));
        assert_eq!(report["kutzbach"].to_string(), value("kutzbach"));
    }
}

/// The bar of the four-bar reaches where it is no longer than 4: the border is found to a 64th of a step, and again from a file that
/// was cut off in it.
#[test]
fn the_border_is_refined_to_the_same_bytes() {
    let folder = empty_folder("sweep_refined");
    let mechanism = written(&folder);
    for name in ["out.csv", "out.jsonl"] {
        let file = folder.join(name);
        let path = file.to_str().unwrap();
        let asked = [mechanism.as_str(), "--over", "bar=2..5:3", "-o", path];
        done(&asked);
        let plain = fs::read(&file).unwrap();
        let refined = [&asked[..], &["--refine", "6"]].concat();
        done(&refined);
        let whole = fs::read(&file).unwrap();
        assert!(whole.starts_with(&plain));
        let lines: Vec<String> = text(&whole[plain.len()..])
            .lines()
            .map(str::to_owned)
            .collect();
        // 2, 3.5, 5: between 3.5 and 5.
        assert_eq!(lines.len(), 6, "{lines:?}");
        for cut in [plain.len(), plain.len() + 20, whole.len() - 3, whole.len()] {
            fs::write(&file, &whole[..cut]).unwrap();
            done(&refined);
            assert_eq!(text(&fs::read(&file).unwrap()), text(&whole), "{cut}");
        }
        // Without the option, rows after those of the sweep go.
        done(&asked);
        assert_eq!(fs::read(&file).unwrap(), plain);
    }
    let file = folder.join("out.csv");
    let asked = ["--over", "bar=2..5:3", "--refine", "6"];
    let csv_file = file.to_str().unwrap();
    done(&[&[mechanism.as_str()][..], &asked, &["-o", csv_file]].concat());
    let csv = fs::read_to_string(&file).unwrap();
    let (mut reaches, mut misses) = (2.0_f64, 5.0_f64);
    for row in rows(&csv) {
        let value = |name: &str| row.iter().find(|(own, _)| *own == name).unwrap().1;
        let bar: f64 = value("bar").parse().unwrap();
        match value("status") {
            "analysed" => reaches = reaches.max(bar),
            "unassembled" => misses = misses.min(bar),
            other => panic!("{other}"),
        }
    }
    assert!(reaches <= 4.0 && 4.0 < misses, "{reaches} {misses}");
    assert!(misses - reaches <= 1.5 / 64.0, "{reaches} {misses}");
    for wrong in [
        &["--refine", "6"][..],
        &["--refine", "6", "-o", "-"],
        &["--refine", "0", "-o", csv_file],
        &["--refine", "6", "--shard", "1/2", "-o", csv_file],
    ] {
        let start = [mechanism.as_str(), "--over", "bar=2..5:3"];
        let output = sweep(&[&start[..], wrong].concat());
        assert_eq!(output.status.code(), Some(2), "{wrong:?}");
    }
}

#[test]
fn samples_are_always_the_same() {
    for sample in ["sobol:8", "random:8"] {
        let asked = [SPOILED, "--over", "off=0.001..1", "--sample", sample];
        let csv = done(&[&asked[..], &["--depth", "rank"]].concat());
        assert_eq!(rows(&csv).len(), 8);
        assert_eq!(csv, done(&[&asked[..], &["--depth", "rank"]].concat()));
    }
}

#[test]
fn what_cannot_be_asked_is_refused() {
    for (wrong, said) in [
        (&["--over", "of=0,1"][..], "`of`"),
        (&["--over", "off=0..1"][..], "no count"),
        (&["--over", "off=0..1:0"][..], "from 1 to"),
        (&["--over", "off=1", "--over", "off=2"][..], "varied twice"),
        (&["--over", "off=1", "--shard", "3/2"][..], "1/5"),
        (
            &["--over", "off=1", "--sample", "halton:3"][..],
            "sobol:1000",
        ),
        (&[][..], "--over"),
    ] {
        let output = sweep(&[&[SPOILED][..], wrong].concat());
        assert_eq!(output.status.code(), Some(2), "{wrong:?}");
        let stderr = text(&output.stderr);
        assert!(stderr.contains(said), "{wrong:?}: {stderr}");
    }
}
