//! Logs in the hands of readers that share nothing with this crate: the Python packages `mcap` and
//! `mcap-protobuf-support`, and the Rerun viewer.
//!
//! `KUTZBACH_PYTHON` names an interpreter that has the packages of `tests/viewers/requirements.txt`; where it is set, a
//! missing package is a failure. Without it, `python3` is tried, and the tests say that they were skipped where it lacks
//! them. The viewer is asked for a picture where `KUTZBACH_VIEWER` is set.

use crate::support;

use kutzbach::closure::{Arithmetic, Geometry, Rigid};
use kutzbach::record::{
    Closure, ClosureError, Gap, Header, JointClosure, Level, Motion, Prediction, Recorder, Roles,
};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use support::folder;

/// The interpreter to use, with the packages.
fn python() -> PathBuf {
    let named = std::env::var_os("KUTZBACH_PYTHON").filter(|name| !name.is_empty());
    let python = PathBuf::from(named.unwrap_or_else(|| "python3".into()));
    let tried = Command::new(&python)
        .args(["-c", "import mcap, mcap_protobuf"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&tried.stderr);
    assert!(tried.status.success(), "{}: {said}", python.display());
    python
}

/// What the independent reader says of a log.
fn read_log(python: &Path, log: &Path) -> Value {
    let run = Command::new(python)
        .arg(folder("tests/viewers/read_log.py"))
        .arg(log)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    serde_json::from_slice(&run.stdout).unwrap()
}

const MOMENTS: usize = 80;

/// What is logged as the poses of a moment: the four-bar carried around as a whole, each link with a drift of its own.
fn poses(home: &[Rigid<f64>], moment: usize, simulated: bool) -> Vec<Rigid<f64>> {
    let angle = 0.05 * moment as f64 + if simulated { 1e-3 } else { 0.0 };
    home.iter()
        .enumerate()
        .map(|(link, pose)| {
            let drift = angle * (1.0 + link as f64);
            Rigid::exponential(&[0.2, -angle, drift], &[angle, 1.0, 0.0]).compose(pose)
        })
        .collect()
}

/// Seconds that decimals say exactly: the reader of JSON here rounds in the last digit.
fn time(moment: usize) -> f64 {
    moment as f64 / 32.0
}

struct Recorded {
    log: PathBuf,
    source: Vec<u8>,
    links: Vec<String>,
    joints: Vec<String>,
    home: Vec<Rigid<f64>>,
}

fn recorded(name: &str) -> Recorded {
    let file = folder("mechanisms/planar_four_bar.urdf");
    let source = std::fs::read(&file).unwrap();
    let mechanism = kutzbach::format::read_file(&file, &[]).unwrap().mechanism;
    let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
    let facts = BTreeMap::from([
        ("verdict".to_owned(), "mobile".to_owned()),
        ("finite".to_owned(), "1".to_owned()),
    ]);
    let header = Header {
        mechanism: &mechanism,
        geometry: &geometry,
        source_name: "planar_four_bar.urdf",
        source: &source,
        report: Some("{\"schema\": \"kutzbach-report-2\"}"),
        facts: &facts,
        roles: &Roles::default(),
        simulated_at: Some([12.5, 0.0, -1.0]),
    };
    let log = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let mut recorder = Recorder::create(&log, &header).unwrap();
    recorder.log(0.0, Level::Warning, "größer als 0").unwrap();
    for moment in 0..MOMENTS {
        let predicted = poses(&geometry.home, moment, false);
        let simulated = poses(&geometry.home, moment, true);
        let values: Vec<Vec<f64>> = (0..4).map(|j| vec![j as f64 + time(moment)]).collect();
        let rates = vec![vec![1.0]; 4];
        let gaps = [Gap {
            joint: 3,
            predecessor: [1.0, 2.0, 3.0],
            successor: [1.0, 2.0, 3.0 + time(moment)],
        }];
        let first = Motion {
            joints: &values,
            ..Motion::of_links(&predicted)
        };
        let second = Motion {
            links: &simulated,
            joints: &values,
            rates: &rates,
            gaps: &gaps,
        };
        recorder
            .moment(time(moment), Some(&first), Some(&second))
            .unwrap();
        let error = ClosureError {
            position: time(moment),
            angle: 1e-9,
            relative: 0.25,
            joints: vec![JointClosure {
                joint: mechanism.joints()[3].name.clone(),
                position: time(moment),
                angle: 0.0,
            }],
        };
        let closure = Closure {
            predicted: None,
            simulated: Some(error),
        };
        recorder.closure(time(moment), &closure).unwrap();
        let prediction = Prediction {
            branch: "A".to_owned(),
            parameter: time(moment),
            drive: mechanism.joints()[0].name.clone(),
            predicted: -time(moment),
            simulated: (moment % 2 == 1).then_some(0.5),
            event: if moment == 40 { "dead centre" } else { "" }.to_owned(),
            ..Prediction::default()
        };
        recorder.prediction(time(moment), &prediction).unwrap();
    }
    recorder.finish().unwrap();
    Recorded {
        log,
        source,
        links: mechanism.links().iter().map(|l| l.name.clone()).collect(),
        joints: mechanism.joints().iter().map(|j| j.name.clone()).collect(),
        home: geometry.home.clone(),
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    let all = value.as_array().unwrap().iter();
    all.map(|x| x.as_f64().unwrap()).collect()
}

/// Where a pose takes the corners of a tetrahedron, from the reader's translation and quaternion.
fn corners(pose: &Value) -> Vec<[f64; 3]> {
    let t = numbers(&pose["translation"]);
    let q = numbers(&pose["rotation"]);
    let [x, y, z, w] = [q[0], q[1], q[2], q[3]];
    let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    points
        .iter()
        .map(|p| {
            // p + 2 v × (v × p + w p)
            let cross = |a: [f64; 3], b: [f64; 3]| {
                [
                    a[1] * b[2] - a[2] * b[1],
                    a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0],
                ]
            };
            let v = [x, y, z];
            let inner = cross(v, *p);
            let inner = [0, 1, 2].map(|i| inner[i] + w * p[i]);
            let outer = cross(v, inner);
            [0, 1, 2].map(|i| p[i] + 2.0 * outer[i] + t[i])
        })
        .collect()
}

#[test]
#[ignore = "needs the packages of tests/viewers/requirements.txt: KUTZBACH_PYTHON"]
fn python_reads_what_was_recorded() {
    let python = python();
    let recorded = recorded("read_by_python.mcap");
    let answer = read_log(&python, &recorded.log);

    let found = answer["poses"].as_array().unwrap();
    assert_eq!(found.len(), 2 * MOMENTS);
    for (index, at) in found.iter().enumerate() {
        let (moment, simulated) = (index / 2, index % 2 == 1);
        assert!((at["time"].as_f64().unwrap() - time(moment)).abs() < 1e-9);
        assert_eq!(
            at["stream"],
            if simulated { "simulated" } else { "predicted" }
        );
        let links = at["links"].as_object().unwrap();
        assert_eq!(links.len(), recorded.links.len());
        for (name, pose) in recorded
            .links
            .iter()
            .zip(poses(&recorded.home, moment, simulated))
        {
            for (corner, point) in corners(&links[name]).iter().zip([
                [0.0; 3],
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, 0.0, 1.0],
            ]) {
                let wanted = pose.apply(&point);
                // Coordinates up to ten through three frames: some tens of roundings of 1e-15.
                let off = (0..3).map(|i| (corner[i] - wanted[i]).abs());
                assert!(off.fold(0.0, f64::max) < 1e-13, "{name} at {moment}");
            }
        }
    }
    assert_eq!(numbers(&answer["offsets"]["predicted"]), [0.0; 3]);
    assert_eq!(numbers(&answer["offsets"]["simulated"]), [12.5, 0.0, -1.0]);

    let states = answer["joint_states"].as_array().unwrap();
    assert_eq!(states.len(), 2 * MOMENTS);
    for (index, at) in states.iter().enumerate() {
        let simulated = at["topic"] == "/simulated/joint_states";
        for (joint, name) in recorded.joints.iter().enumerate() {
            let value = &at["joints"][name];
            assert_eq!(value[0].as_f64(), Some(joint as f64 + time(index / 2)));
            assert_eq!(value[1].as_f64(), simulated.then_some(1.0));
        }
    }

    for (moment, at) in answer["closure"].as_array().unwrap().iter().enumerate() {
        assert!(at.get("predicted").is_none());
        assert_eq!(at["simulated"]["position"].as_f64(), Some(time(moment)));
        assert_eq!(at["simulated"]["relative"].as_f64(), Some(0.25));
        assert_eq!(at["simulated"]["joints"][0]["joint"], recorded.joints[3]);
    }
    for (moment, at) in answer["prediction"].as_array().unwrap().iter().enumerate() {
        assert_eq!(at["branch"], "A");
        assert_eq!(at["predicted"].as_f64(), Some(-time(moment)));
        let simulated = at.get("simulated").and_then(Value::as_f64);
        assert_eq!(simulated, (moment % 2 == 1).then_some(0.5));
        assert_eq!(at["event"], if moment == 40 { "dead centre" } else { "" });
    }
    for (index, at) in answer["gaps"].as_array().unwrap().iter().enumerate() {
        let moment = index / 2;
        let expected = match (index % 2, moment) {
            (0, _) | (_, 0) => serde_json::json!([]),
            _ => serde_json::json!([[[1.0, 2.0, 3.0], [1.0, 2.0, 3.0 + time(moment)]]]),
        };
        assert_eq!(at["segments"], expected);
    }

    let text = String::from_utf8(recorded.source).unwrap();
    assert_eq!(answer["attachments"]["planar_four_bar.urdf"]["text"], text);
    let report = &answer["attachments"]["report.json"];
    assert_eq!(report["text"], "{\"schema\": \"kutzbach-report-2\"}");
    assert_eq!(report["media_type"], "application/json");
    assert_eq!(answer["metadata"]["mobility"]["finite"], "1");
    assert_eq!(answer["log"][0]["message"], "größer als 0");
    assert_eq!(answer["log"][0]["level"], "WARNING");
    assert_eq!(answer["times"]["first"], 0);
    let entities = answer["scene"][0]["entities"].as_object().unwrap();
    for link in &recorded.links {
        for stream in ["predicted", "simulated"] {
            let entity = &entities[&format!("{stream}/link/{link}")];
            assert_eq!(entity["frame"], format!("{stream}/{link}"));
            assert!(entity["shapes"].as_u64().unwrap() >= 1);
        }
    }
    let description = answer["descriptions"]["/robot_description"].as_str();
    let robot = urdf_rs::read_from_string(description.unwrap()).unwrap();
    assert_eq!(robot.links.len(), recorded.links.len() + 1);
    let topic = &answer["topics"]["/tf"];
    assert_eq!(topic["schema"], "foxglove.FrameTransforms");
    assert_eq!(topic["messages"], MOMENTS);
}

/// What `kutzbach` prints, run in the folder of the package.
fn kutzbach(arguments: &[&str]) -> Vec<u8> {
    let run = crate::support::program()
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{arguments:?}: {}",
        String::from_utf8_lossy(&run.stderr)
    );
    run.stdout
}

/// The log of `kutzbach simulate`, and what it printed as JSON.
fn simulated(file: &str, log: &str) -> (PathBuf, Value) {
    let log = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(log);
    let path = log.to_str().unwrap();
    let words = ["simulate", file, "--mcap", path, "--samples", "50"];
    let printed = kutzbach(&[&words[..], &["--format", "json"]].concat());
    (log, serde_json::from_slice(&printed).unwrap())
}

/// How far two poses are apart, in lengths or rad, whichever is more; quaternions as x, y, z, w.
fn apart(a: (&[f64], &[f64]), b: (&[f64], &[f64]), length: f64) -> f64 {
    let norm = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>().sqrt();
    let way = norm(&mut a.0.iter().zip(b.0).map(|(a, b)| a - b)) / length;
    let [turned, opposite] =
        [1.0, -1.0].map(|sign| norm(&mut a.1.iter().zip(b.1).map(|(a, b)| a - sign * b)));
    way.max(2.0 * turned.min(opposite))
}

/// The poses of all links of an entry of the reader's `poses`.
fn links_of(entry: &Value) -> BTreeMap<String, (Vec<f64>, Vec<f64>)> {
    let links = entry["links"].as_object().unwrap().iter();
    links
        .map(|(name, pose)| {
            let pose = (numbers(&pose["translation"]), numbers(&pose["rotation"]));
            (name.clone(), pose)
        })
        .collect()
}

/// The last passage of a log against the samples of `trace`; returns the number of moments it has.
fn assert_predicted_as_traced(file: &str, answer: &Value, trace: &Value) -> usize {
    let length = trace["length_unit"].as_f64().unwrap();
    let names = trace["links"].as_array().unwrap();
    let arclength = |sample: &Value| sample["arclength"].as_f64().unwrap();
    let mut samples: Vec<&Value> = trace["samples"].as_array().unwrap().iter().collect();
    samples.sort_by(|a, b| arclength(a).total_cmp(&arclength(b)));
    assert!(samples.len() >= 49, "{file}: {} samples", samples.len());
    let last_of = |topic: &str| {
        let all = answer[topic].as_array().unwrap();
        all[all.len() - samples.len()..].to_vec()
    };
    let (entries, states) = (last_of("poses"), last_of("joint_states"));
    let told = answer["log"].as_array().unwrap();
    let played = |m: &&Value| m["message"] == "predicted motion of branch A";
    let played = told.iter().find(played).unwrap()["time"].as_f64().unwrap();
    let begins = arclength(samples[0]) - played;
    for (index, sample) in samples.iter().enumerate() {
        let entry = &entries[index];
        assert_eq!(entry["stream"], "predicted", "{file}: moment {index}");
        let time = entry["time"].as_f64().unwrap();
        // Times are whole nanoseconds.
        assert!((time - (arclength(sample) - begins)).abs() < 3e-9);
        let logged = links_of(entry);
        assert_eq!(logged.len(), names.len());
        for (name, pose) in names.iter().zip(sample["links"].as_array().unwrap()) {
            let (t, q) = &logged[name.as_str().unwrap()];
            let traced = numbers(&pose["quaternion"]);
            let traced_q = [traced[1], traced[2], traced[3], traced[0]];
            let off = apart((t, q), (&numbers(&pose["position"]), &traced_q), length);
            assert!(off < 1e-9, "{file}: {name} is {off} off at moment {index}");
        }
        let joints = states[index]["joints"].as_object().unwrap();
        let columns = trace["columns"].as_array().unwrap();
        for (column, value) in columns.iter().zip(numbers(&sample["values"])) {
            let name = column["joint"].as_str().unwrap();
            let logged = joints[name][0].as_f64().unwrap();
            let scale = if column["unit"] == "m" { length } else { 1.0 };
            assert!(
                (logged - value).abs() < 1e-9 * scale,
                "{file}: {name} is {logged} and not {value} at moment {index}"
            );
        }
    }
    samples.len()
}

/// Every passage of the ladder keeps as near to the prediction as its row in the table says.
fn assert_near_the_prediction(file: &str, answer: &Value, result: &Value, length: f64) {
    let branches = result["verification"]["branches"].as_array().unwrap();
    let rungs: Vec<&Value> = branches
        .iter()
        .flat_map(|branch| branch["ladders"].as_array().unwrap())
        .flat_map(|ladder| ladder["rungs"].as_array().unwrap())
        .collect();
    let told = answer["log"].as_array().unwrap();
    let starts: Vec<f64> = told
        .iter()
        .filter(|m| m["message"].as_str().unwrap().ends_with(" substeps"))
        .map(|m| m["time"].as_f64().unwrap())
        .collect();
    assert_eq!(starts.len(), rungs.len(), "{file}: {told:?}");
    let entries = answer["poses"].as_array().unwrap();
    let mut seen = vec![0; rungs.len()];
    for pair in entries.windows(2) {
        let [first, second] = [&pair[0], &pair[1]];
        if second["stream"] != "simulated" || first["time"] != second["time"] {
            continue;
        }
        let time = second["time"].as_f64().unwrap();
        let Some(rung) = starts.iter().rposition(|start| *start <= time) else {
            panic!("{file}: something is simulated before it is announced");
        };
        let error = rungs[rung]["closure_error"].as_f64().unwrap();
        let predicted = links_of(first);
        for (name, (t, q)) in links_of(second) {
            let (u, r) = &predicted[&name];
            let off = apart((&t, &q), (u, r), length);
            assert!(
                off <= 100.0 * error + 1e-9,
                "{file}: {name} is {off} off at {time} s, closure error {error}"
            );
        }
        seen[rung] += 1;
    }
    assert!(seen.iter().all(|moments| *moments > 20), "{file}: {seen:?}");
}

#[test]
#[ignore = "needs the packages of tests/viewers/requirements.txt: KUTZBACH_PYTHON"]
fn python_sees_the_motion_that_trace_tells() {
    let python = python();
    // One revolute loop out of and one in the plane, one with sliders, one with balls.
    for name in ["bennett", "planar_four_bar", "oldham", "rssr"] {
        let file = format!("mechanisms/{name}.urdf");
        let (log, result) = simulated(&file, &format!("simulated_{name}.mcap"));
        let bytes = std::fs::read(&log).unwrap();
        simulated(&file, &format!("simulated_{name}.mcap"));
        assert_eq!(bytes, std::fs::read(&log).unwrap(), "{file}: other bytes");

        let answer = read_log(&python, &log);
        let trace = kutzbach(&["trace", &file, "--samples", "50", "--format", "json"]);
        let trace: Value = serde_json::from_slice(&trace).unwrap();
        let traced = assert_predicted_as_traced(&file, &answer, &trace);
        let length = trace["length_unit"].as_f64().unwrap();
        assert_near_the_prediction(&file, &answer, &result, length);

        let attached = &answer["attachments"];
        let source = std::fs::read_to_string(folder(&file)).unwrap();
        assert_eq!(attached[format!("{name}.urdf")]["text"], source);
        let report = kutzbach(&["report", &file, "--format", "json"]);
        let report = String::from_utf8(report).unwrap();
        assert_eq!(attached["report.json"]["text"], report);
        let report: Value = serde_json::from_str(&report).unwrap();
        let facts = &answer["metadata"]["mobility"];
        assert_eq!(facts["verdict"], report["mobility"]["verdict"]);
        assert_eq!(facts["finite"], trace["dimension"].to_string());
        assert_eq!(facts["class"], report["mobility"]["class"]);
        assert_eq!(facts["seed"], "1");

        let told = answer["log"].as_array().unwrap();
        assert_eq!(told[0]["time"].as_f64(), Some(0.0));
        let first = told[0]["message"].as_str().unwrap();
        assert!(first.ends_with(" substeps"), "{first}");
        let last = told.last().unwrap()["message"].as_str().unwrap();
        let finding = &result["verification"]["finding"];
        let (outcome, why) = last.split_once(": ").unwrap();
        assert_eq!(finding["outcome"], outcome);
        assert_eq!(finding["why"], why);

        assert_eq!(
            answer["topics"]["/mobility/closure"]["schema"],
            "closure.Closure"
        );
        let closures = answer["closure"].as_array().unwrap();
        assert!(closures.len() > traced + 60);
        for (index, at) in closures.iter().enumerate() {
            let who = if index < closures.len() - traced {
                "simulated"
            } else {
                "predicted"
            };
            for key in ["position", "angle", "relative"] {
                assert!(at[who][key].as_f64().unwrap() < 1e-3, "{file}: {at}");
            }
        }
        let topic = &answer["topics"]["/mobility/prediction"];
        assert_eq!(topic["schema"], "prediction.Prediction");
        assert_eq!(topic["message_encoding"], "protobuf");
        let predictions = answer["prediction"].as_array().unwrap();
        for (index, at) in predictions.iter().enumerate() {
            assert!(at["predicted"].is_f64());
            let beside = index < predictions.len() - traced;
            assert_eq!(at.get("simulated").is_some(), beside, "{at}");
        }

        let topic = &answer["topics"]["/robot_description"];
        assert_eq!(topic["schema"], "std_msgs/msg/String");
        assert_eq!(topic["message_encoding"], "cdr");
        let description = answer["descriptions"]["/robot_description"].as_str();
        let robot = urdf_rs::read_from_string(description.unwrap()).unwrap();
        let links = trace["links"].as_array().unwrap();
        assert_eq!(robot.links.len(), links.len() + 1);
        let scene = answer["scene"].as_array().unwrap().last().unwrap();
        for link in links {
            for stream in ["predicted", "simulated"] {
                let id = format!("{stream}/link/{}", link.as_str().unwrap());
                assert!(scene["entities"][&id]["shapes"].as_u64() >= Some(1), "{id}");
            }
        }
    }
}

#[test]
#[ignore = "needs a viewer: tests/viewers/open_in_rerun.sh"]
fn the_viewer_shows_the_mechanism() {
    let (log, _) = simulated("mechanisms/bennett.urdf", "seen_in_a_viewer.mcap");
    let picture = log.with_extension("png");
    let _ = std::fs::remove_file(&picture);
    let run = Command::new("bash")
        .arg(folder("tests/viewers/open_in_rerun.sh"))
        .args([&log, &picture])
        .arg("--check")
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}\n{}",
        String::from_utf8_lossy(&run.stdout),
        String::from_utf8_lossy(&run.stderr)
    );
    assert!(picture.exists());
}
