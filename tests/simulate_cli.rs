//! `kutzbach simulate` as a user meets it: outcomes and exit codes, scenes with an effect more or less, bad numbers,
//! Ctrl-C, and disks that are full.
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Runs `kutzbach simulate` in the folder of the package.
fn simulate(arguments: &[&str]) -> Output {
    crate::support::program()
        .arg("simulate")
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// The JSON of a simulation that goes through.
fn json(arguments: &[&str]) -> Value {
    let output = simulate(&[arguments, &["--format", "json"]].concat());
    assert!(
        matches!(output.status.code(), Some(0 | 1)),
        "{arguments:?}: {}",
        text(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

/// A folder of its own for one test.
fn folder(test: &str) -> PathBuf {
    crate::support::empty_folder(&format!("simulate_{test}"))
}

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn outcome(simulated: &Value) -> &str {
    simulated["verification"]["finding"]["outcome"]
        .as_str()
        .unwrap()
}

#[test]
fn mobile_mechanisms_are_confirmed() {
    for name in ["bennett", "oldham_cylindrical_centre"] {
        let file = format!("mechanisms/{name}.urdf");
        let output = simulate(&[&file]);
        assert_eq!(output.status.code(), Some(0));
        assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
        let page = text(&output.stdout);
        assert!(page.starts_with("Confirmed: "), "{page}");
        for part in [
            "substeps",
            "closure error",
            "off the prediction",
            "wall time",
            "order",
        ] {
            assert!(page.contains(part), "{part} in {page}");
        }
        let simulated = json(&[&file, "--strict"]);
        assert_eq!(simulated["schema"], "kutzbach-simulation-1");
        assert_eq!(outcome(&simulated), "confirmed");
        let branch = &simulated["verification"]["branches"][0];
        let ladder = &branch["ladders"][0];
        let rungs = ladder["rungs"].as_array().unwrap();
        assert!(rungs.len() >= 3);
        let error = |rung: &Value| rung["closure_error"].as_f64().unwrap();
        assert!(error(&rungs[2]) < 0.1 * error(&rungs[0]), "{ladder}");
        assert_eq!(branch["freedoms"]["finding"]["outcome"], "confirmed");
    }
}

#[test]
fn a_spoiled_loop_is_not_confirmed_although_it_turns() {
    let file = "mechanisms/bennett_spoiled.urdf";
    let simulated = json(&[file]);
    assert_ne!(outcome(&simulated), "confirmed");
    let pushing = &simulated["verification"]["pushing"]["rungs"];
    let moved = |rung: &Value| rung["moved"].as_f64().unwrap();
    assert!(
        pushing.as_array().unwrap().iter().all(|r| moved(r) > 0.1),
        "it was to turn: {pushing}"
    );
    // Not decided either: that is what `--strict` is for.
    let short = simulate(&[file, "--substeps", "4,8", "--strict"]);
    let page = text(&short.stdout);
    assert!(page.starts_with("Inconclusive: "), "{page}");
    assert_eq!(short.status.code(), Some(3));
    assert_eq!(
        simulate(&[file, "--substeps", "4,8"]).status.code(),
        Some(0)
    );
}

#[test]
fn what_has_nothing_to_act_on_is_named() {
    let file = "mechanisms/bennett.urdf";
    let still = json(&[file, "--duration", "1", "--integrator", "engine"]);
    assert!(still["scene"].is_null());
    let named = &still["idle_options"];
    let because = "nothing calls for a scene";
    let wanted = ["--integrator", "--duration"]
        .map(|option| serde_json::json!({ "option": option, "because": because }));
    assert_eq!(named, &Value::from(wanted.to_vec()));
    let output = simulate(&[file, "--duration", "1"]);
    let words = text(&output.stdout)
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    assert!(words.contains("`--duration` changes nothing"), "{words}");
    let scene = [
        "--with", "gravity", "--with", "friction", "--with", "limits",
    ];
    let run = json(&[&[file, "--duration", "0.1"][..], &scene].concat());
    assert!(run["idle_options"].is_null());
    let idle = run["scene"]["idle_effects"].as_array().unwrap();
    let idle: Vec<_> = idle
        .iter()
        .map(|row| row["effect"].as_str().unwrap())
        .collect();
    assert_eq!(idle, ["limits", "friction"]);
    assert_eq!(run["scene"]["integrator"], "runge_kutta");
}

/// Options that were given and change nothing, each with a word of the reason.
#[test]
fn every_idle_option_is_named_with_its_reason() {
    let mobile = "mechanisms/bennett.urdf";
    let rigid = "mechanisms/bennett_spoiled.urdf";
    let driven = "mechanisms/four_bar_lifting_box.urdf";
    for (file, words, named) in [
        (mobile, &[][..], &[][..]),
        (
            mobile,
            &["--restitution", "0.5"],
            &[("--restitution", "no contact")],
        ),
        (
            mobile,
            &[
                "--with",
                "gravity",
                "--integrator",
                "engine",
                "--duration",
                "0.1",
            ],
            &[],
        ),
        (
            mobile,
            &["--without", "contact"],
            &[("--without contact", "does not have")],
        ),
        (
            mobile,
            &[
                "--with",
                "gravity",
                "--with",
                "gravity",
                "--duration",
                "0.1",
            ],
            &[("--with gravity", "twice")],
        ),
        (
            driven,
            &[
                "--with",
                "gravity",
                "--without",
                "damping",
                "--duration",
                "0.1",
            ],
            &[
                ("--with gravity", "has it already"),
                ("--without damping", "does not have"),
            ],
        ),
        (
            driven,
            &[
                "--without",
                "contact",
                "--with",
                "limits",
                "--duration",
                "0.1",
            ],
            &[],
        ),
        (
            mobile,
            &["--duration", "0.1"],
            &[("--duration", "nothing calls")],
        ),
        (
            rigid,
            &["--seed", "7", "--whole-ladder"],
            &[("--seed", "no motion"), ("--whole-ladder", "no motion")],
        ),
        (rigid, &["--solver", "impulse", "--substeps", "4,8"], &[]),
        (
            mobile,
            &["--seed", "7", "--whole-ladder", "--substeps", "4,8"],
            &[],
        ),
    ] {
        let simulated = json(&[&[file, "--budget", "1"][..], words].concat());
        let idle = simulated["idle_options"]
            .as_array()
            .cloned()
            .unwrap_or_default();
        assert_eq!(idle.len(), named.len(), "{words:?}: {idle:?}");
        for (found, (option, reason)) in idle.iter().zip(named) {
            assert_eq!(found["option"], *option, "{words:?}");
            let because = found["because"].as_str().unwrap();
            assert!(because.contains(reason), "{words:?}: {because}");
        }
    }
}

#[test]
fn rigid_mechanisms_stay_where_they_are_pushed() {
    let output = simulate(&["tests/zoo/triangle_3r_rigid.urdf", "--strict"]);
    assert_eq!(output.status.code(), Some(0));
    let page = text(&output.stdout);
    assert!(page.starts_with("Confirmed: predicted rigid"), "{page}");
    assert!(page.contains("Every joint pushed in turn"), "{page}");
}

#[test]
fn the_seed_is_heard_and_everything_else_is_the_same_every_time() {
    let arguments = ["mechanisms/bennett.urdf", "--format", "json", "--seed", "7"];
    let once = simulate(&arguments);
    assert_eq!(once.stdout, simulate(&arguments).stdout);
    let words = text(&once.stdout);
    assert!(!words.contains("wall_time") && !words.contains("timing"));
    let timed = json(&["mechanisms/bennett.urdf", "--seed", "7", "--timing"]);
    let rows = timed["timing"].as_array().unwrap();
    assert!(rows.iter().all(|r| r["wall_time"].as_f64().unwrap() > 0.0));
    let mut rest = timed.clone();
    rest.as_object_mut().unwrap().remove("timing");
    assert_eq!(rest, serde_json::from_slice::<Value>(&once.stdout).unwrap());
}

#[test]
fn cost_has_a_row_for_every_effect() {
    let page = text(&simulate(&["mechanisms/slider_hitting_stop.urdf", "--cost"]).stdout);
    let (_, table) = page.split_once("What effects cost").unwrap();
    for effect in [
        "none", "gravity", "contact", "limits", "friction", "damping", "scene",
    ] {
        let row = table.lines().find(|l| l.trim_start().starts_with(effect));
        assert!(row.is_some(), "{effect} in {table}");
    }
    let cost = &json(&["mechanisms/slider_hitting_stop.urdf", "--cost"])["cost"];
    assert_eq!(cost.as_array().unwrap().len(), 7);
}

/// What a scene gives with some words added to the command line.
fn scene(name: &str, words: &[&str]) -> Value {
    let file = format!("mechanisms/{name}.urdf");
    let mut arguments = vec![file.as_str(), "--substeps", "4,8,16"];
    arguments.extend(words);
    json(&arguments)["scene"].take()
}

/// The pieces of the world that differ, with their numbers before and after.
fn changed(before: &Value, after: &Value) -> Vec<(String, u64, u64)> {
    let [a, b] = [before, after].map(|run| run["pieces"].as_object().unwrap());
    assert!(a.keys().eq(b.keys()));
    a.iter()
        .map(|(name, n)| (name.clone(), n.as_u64().unwrap(), b[name].as_u64().unwrap()))
        .filter(|(_, n, m)| n != m)
        .collect()
}

fn number(run: &Value, key: &str) -> f64 {
    run[key].as_f64().unwrap()
}

#[test]
fn the_lifted_box_needs_contact_and_nothing_but_contact_holds_it() {
    let name = "four_bar_lifting_box";
    let whole = scene(name, &[]);
    assert_eq!(whole["effects"], serde_json::json!(["gravity", "contact"]));
    assert!(whole["most_contacts"].as_u64() >= Some(1));
    assert!(number(&whole, "closure_error") < 1e-3);
    // At 0.3 rad/s for two seconds, table (4 kg), box (2 kg) and the cranks' centres (half as high, 2 kg) rise. A crank is
    // 0.5 m long and starts at an angle of asin 0.8 below the level.
    let rise = 0.4 - 0.5 * (0.8f64.asin() - 0.6).sin();
    let lifted = 9.81 * (4.0 + 2.0 + 0.5 * 2.0) * rise;
    let gained = number(&whole, "energy_change");
    assert!((gained / lifted - 1.0).abs() < 0.05, "{gained} of {lifted}");

    let falling = scene(name, &["--without", "contact"]);
    assert_eq!(changed(&whole, &falling), [("colliders".to_owned(), 3, 0)]);
    assert_eq!(falling["most_contacts"], 0);
    // A free fall of two seconds: 2 kg at 19.62 m/s.
    let fall = 0.5 * 2.0 * (2.0 * 9.81f64).powi(2);
    assert!((number(&falling, "kinetic_energy") / fall - 1.0).abs() < 0.02);

    let weightless = scene(name, &["--without", "gravity"]);
    assert_eq!(changed(&whole, &weightless), []);
    assert_eq!(number(&weightless, "potential_energy"), 0.0);

    // Nothing in the file has limits, friction or damping: called for, they add nothing.
    for effect in ["limits", "friction", "damping"] {
        let more = scene(name, &["--with", effect]);
        assert_eq!(changed(&whole, &more), []);
        for key in [
            "energy_change",
            "most_contacts",
            "beyond_limit",
            "closure_error",
        ] {
            assert_eq!(more[key], whole[key], "{effect}: {key}");
        }
    }
}

#[test]
fn the_slider_stops_at_its_limit_and_every_effect_takes_its_share() {
    let name = "slider_hitting_stop";
    let whole = scene(name, &[]);
    let names = ["gravity", "limits", "friction", "damping"];
    assert_eq!(whole["effects"], serde_json::json!(names));
    // It rests at the stop: 2 kg, 0.5 m along a rail that falls 4 in 5.
    let fallen = -2.0 * 9.81 * 0.4;
    assert!((number(&whole, "energy_change") / fallen - 1.0).abs() < 1e-6);
    let beyond = |run: &Value| run["beyond_limit"][1].as_f64().unwrap_or(0.0);
    assert!(beyond(&whole) < 1e-6);

    let one = |piece: &str| vec![(piece.to_owned(), 1, 0)];
    let open = scene(name, &["--without", "limits"]);
    assert_eq!(changed(&whole, &open), one("limits"));
    assert_eq!(open["beyond_limit"][0], "slide");
    // Down the rail with m = 2 kg, F = m g 0.8 − 3 N less v · 1 N s/m for two seconds, less the half metre.
    let (mass, force) = (2.0, 2.0 * 9.81 * 0.8 - 3.0);
    let way = force * (2.0 - mass * (1.0 - (-2.0f64 / mass).exp()));
    assert!((beyond(&open) / (way - 0.5) - 1.0).abs() < 0.02, "{way}");

    let level = scene(name, &["--without", "gravity"]);
    assert_eq!(changed(&whole, &level), []);
    assert_eq!(number(&level, "energy_change"), 0.0);
    assert_eq!(level["beyond_limit"], Value::Null);

    // Without what holds it back it goes farther, as far as the formulas say, and only that piece is gone.
    for (effect, piece, way) in [
        ("friction", "frictions", {
            let force = 2.0 * 9.81 * 0.8;
            force * (2.0 - mass * (1.0 - (-2.0f64 / mass).exp()))
        }),
        ("damping", "dampings", 0.5 * force / mass * 4.0),
    ] {
        let less = scene(name, &["--without", effect]);
        assert_eq!(changed(&whole, &less), one(piece));
        assert!(beyond(&less) < 1e-6, "the limit still holds");
        let free = scene(name, &["--without", effect, "--without", "limits"]);
        let found = beyond(&free);
        assert!(
            (found / (way - 0.5) - 1.0).abs() < 0.02,
            "{effect}: {found}, {way}"
        );
    }
    let more = scene(name, &["--with", "contact"]);
    assert_eq!(changed(&whole, &more), []);
    assert_eq!(more["most_contacts"], 0);
    assert_eq!(more["energy_change"], whole["energy_change"]);
}

#[test]
fn what_cannot_be_simulated_is_refused_with_a_hint() {
    let bennett = "mechanisms/bennett.urdf";
    let folder = folder("refused");
    let log = folder.join("never.mcap");
    let log = log.to_str().unwrap();
    for (words, named) in [
        (&["--branch", "Z"][..], "`Z`"),
        (&["--drive", "nope"], "`nope`"),
        (&["--at", "nope"], "`nope`"),
        (&["--substeps", "0"], "--substeps"),
        (&["--substeps", "8,4"], "--substeps"),
        (&["--substeps", "4,x"], "--substeps"),
        (&["--time-step", "0"], "time step"),
        (&["--time-step", "nan"], "time step"),
        (&["--time-step=-1"], "time step"),
        (&["--duration", "nan"], "NaN"),
        (&["--duration", "inf"], "inf"),
        (&["--duration=-1"], "-1"),
        (&["--samples", "1"], "samples"),
        (&["--with", "magic"], "magic"),
        (
            &["--with", "limits", "--without", "limits"],
            "contradict one another",
        ),
        (&["--accuracy", "1e-3", "--substeps", "4"], "--substeps"),
        (&["--accuracy", "1e-3", "--time-step", "0.1"], "--time-step"),
        (
            &["--whole-ladder", "--substeps", "4"],
            "`--whole-ladder` changes nothing",
        ),
        (
            &["--with", "gravity", "--time-step", "1", "--duration", "0.5"],
            "longer than the scene",
        ),
        (&["--output", log], "the file that `--output` writes"),
    ] {
        let output = simulate(&[&[bennett, "--mcap", log], words].concat());
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words:?}: {message}");
        assert!(message.contains(named), "{words:?}: {message}");
        assert!(message.contains("help"), "{words:?}: {message}");
        assert!(!message.contains("panicked"), "{message}");
        assert!(output.stdout.is_empty());
        assert!(names_in(&folder).is_empty(), "{words:?}");
    }
}

#[test]
fn options_that_change_nothing_are_refused() {
    let file = "mechanisms/planar_four_bar.urdf";
    for (words, idle, with) in [
        (
            &["simulate", file, "--samples", "50"][..],
            "--samples",
            "--mcap",
        ),
        (&["simulate", file, "--timing"], "--timing", "--format json"),
        (
            &["simulate", file, "--verbose", "--format", "json"],
            "--verbose",
            "--format text",
        ),
        (
            &["accuracy", file, "--verbose", "--format", "svg"],
            "--verbose",
            "--format text",
        ),
        (
            &["trace", file, "--units", "rad-m", "--format", "csv"],
            "--units",
            "--format text",
        ),
    ] {
        let output = crate::support::program().args(words).output().unwrap();
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words:?}: {message}");
        assert!(
            message.contains(&format!("`{idle}` changes nothing")),
            "{message}"
        );
        assert!(message.contains(with), "{message}");
        assert!(output.stdout.is_empty());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_a_message_and_no_file() {
    let output = simulate(&["mechanisms/bennett.urdf", "--mcap", "/dev/full"]);
    assert_eq!(output.status.code(), Some(2));
    let message = text(&output.stderr);
    assert!(message.contains("cannot write `/dev/full`"), "{message}");
    assert!(message.contains("No space left"), "{message}");

    // A file that may not grow beyond 200 KiB: full in the middle of the simulation.
    let folder = folder("full");
    let log = folder.join("log.mcap");
    let output = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 400; exec \"$@\"", "sh"])
        .arg(crate::support::PROGRAM)
        .args(["simulate", "mechanisms/bennett.urdf", "--mcap"])
        .arg(&log)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let message = text(&output.stderr);
    assert!(message.contains("log.mcap"), "{message}");
    assert!(names_in(&folder).is_empty(), "{:?}", names_in(&folder));
}

/// What `/log` of a log says.
#[cfg(unix)]
fn told(log: &Path) -> Vec<String> {
    let bytes = fs::read(log).unwrap();
    let messages = mcap::MessageStream::new(&bytes).unwrap();
    messages
        .map(Result::unwrap)
        .filter(|message| message.channel.topic == "/log")
        .map(|message| String::from_utf8_lossy(&message.data).into_owned())
        .collect()
}

/// Times (ns) and, of protobuf messages that begin with a double, that number; of one topic.
fn numbers_in(log: &Path, topic: &str) -> Vec<(u64, f64)> {
    let bytes = fs::read(log).unwrap();
    let messages = mcap::MessageStream::new(&bytes)
        .unwrap()
        .map(Result::unwrap);
    messages
        .filter(|message| message.channel.topic == topic)
        .map(|message| {
            let number = message
                .data
                .get(1..9)
                .map(|bytes| bytes.try_into().unwrap());
            (message.log_time, number.map_or(0.0, f64::from_le_bytes))
        })
        .collect()
}

#[test]
fn a_log_says_how_far_a_scene_is_off_at_each_of_its_moments() {
    let log = folder("error_over_time").join("scene.mcap");
    for integrator in ["auto", "engine"] {
        let simulated = json(&[
            "mechanisms/bennett.urdf",
            "--with",
            "gravity",
            "--duration",
            "0.5",
            "--integrator",
            integrator,
            "--mcap",
            log.to_str().unwrap(),
        ]);
        let errors = numbers_in(&log, "/mobility/error");
        let shown = numbers_in(&log, "/mobility/closure");
        // The scene is the first passage, and begins at 0 s.
        let scene = &shown[..errors.len()];
        for topic in ["/joint_states", "/simulated/joint_states"] {
            let beside = numbers_in(&log, topic);
            let times = |all: &[(u64, f64)]| all.iter().map(|(at, _)| *at).collect::<Vec<u64>>();
            assert_eq!(
                times(&beside[..30]),
                times(&errors),
                "{topic}, {integrator}"
            );
        }
        assert_eq!(errors[0].0, 16_666_667, "{integrator}");
        assert_eq!(errors.len(), 30, "{integrator}");
        for ((at, _), (seen, _)) in errors.iter().zip(scene) {
            assert_eq!(at, seen, "{integrator}");
        }
        let trajectory = &simulated["scene"]["trajectory"];
        let used = trajectory["used"].as_u64().unwrap() as usize;
        let told = trajectory["rows"][used]["error"]["worst"].as_f64().unwrap();
        let worst = errors.iter().map(|(_, error)| *error).fold(0.0, f64::max);
        assert!((worst / told - 1.0).abs() < 1e-12, "{worst} {told}");
        // It begins where it is known to be.
        assert!(errors[0].1 < 0.5 * worst, "{integrator}: {errors:?}");
    }
}

/// Starts a simulation, waits until it has got somewhere, presses Ctrl-C, and waits for the end.
#[cfg(unix)]
fn interrupted(test: &str, words: &[&str], wait: std::time::Duration) -> (Output, Vec<String>) {
    use std::time::{Duration, Instant};
    let folder = folder(test);
    let log = folder.join("log.mcap");
    let mut process = crate::support::program()
        .arg("simulate")
        .args(words)
        .arg("--mcap")
        .arg(&log)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let patience = Instant::now() + Duration::from_secs(60);
    while names_in(&folder).is_empty() && process.try_wait().unwrap().is_none() {
        assert!(Instant::now() < patience, "no log was begun");
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(wait);
    crate::support::press_ctrl_c(&process);
    let asked = Instant::now();
    while process.try_wait().unwrap().is_none() {
        if asked.elapsed() > Duration::from_secs(20) {
            process.kill().unwrap();
            panic!("{words:?} did not end after Ctrl-C");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let output = process.wait_with_output().unwrap();
    assert_eq!(names_in(&folder), ["log.mcap"]);
    (output, told(&log))
}

#[cfg(unix)]
#[test]
fn ctrl_c_in_a_simulation_leaves_a_log_that_says_how_far_it_came() {
    // A scene of an hour: it is still on its way after a second.
    let words = [
        "mechanisms/slider_hitting_stop.urdf",
        "--duration",
        "36000",
        "--time-step",
        "1e-3",
    ];
    let (output, told) = interrupted("ctrl_c", &words, std::time::Duration::from_millis(1500));
    assert_eq!(output.status.code(), Some(130), "{}", text(&output.stderr));
    let page = text(&output.stdout);
    assert!(page.contains("interrupted"), "{page}");
    let alone = |text: &String| text.contains("predicted motion of branch");
    assert!(!told.iter().any(alone), "{told:?}");
    let last = told.last().unwrap();
    assert!(last.contains("stopped early: interrupted"), "{told:?}");
    assert!(last.contains("moments recorded, up to"), "{told:?}");
}

#[cfg(unix)]
#[test]
fn ctrl_c_is_answered_while_a_branch_is_followed_too() {
    // Following this one takes a minute in which nobody is asked.
    let words = ["tests/zoo/wren_platform_6US.urdf"];
    let (output, told) = interrupted("ctrl_c_trace", &words, std::time::Duration::from_secs(1));
    assert_eq!(output.status.code(), Some(130), "{}", text(&output.stderr));
    let last = told.last().unwrap();
    assert!(last.contains("stopped early: interrupted"), "{told:?}");
}
