//! `kutzbach accuracy` and the accuracy options of `simulate`, `report` and `trace`, as a user meets them. No seconds are
//! asserted.
use serde_json::Value;
use std::process::{Output, Stdio};

/// Runs `kutzbach` in the folder of the package.
fn kutzbach(arguments: &[&str]) -> Output {
    crate::support::program()
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// A first impression with hardly any time for simulations.
fn short(file: &str, more: &[&str]) -> Output {
    kutzbach(&[&["accuracy", file, "--quick", "--budget", "0.1"], more].concat())
}

fn said(output: &Output) -> String {
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn refused(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr.clone()).unwrap()
}

const BENNETT: &str = "mechanisms/bennett.urdf";
const FOUR_BAR: &str = "mechanisms/planar_four_bar.urdf";

/// Everything but times.
fn without_times(value: &mut Value) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(without_times),
        Value::Object(fields) => {
            fields.remove("timing");
            fields.values_mut().for_each(without_times);
        }
        _ => {}
    }
}

#[test]
fn a_trace_closes_as_well_as_it_was_asked_to() {
    let output = short(FOUR_BAR, &["--format", "json"]);
    let value: Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows = value["motion"]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 7);
    for row in rows {
        let tolerance = row["tolerance"].as_f64().unwrap();
        let closure = row["closure_error"].as_f64().unwrap();
        // A gap in characteristic lengths and an equation in loop lengths differ by a small factor.
        assert!(closure <= 10.0 * tolerance + 1e-14, "{row}");
    }
    let error = |index: usize| rows[index]["closure_error"].as_f64().unwrap();
    assert!(error(0) > 1e3 * error(6));
}

#[test]
fn what_does_not_move_is_not_simulated() {
    let text = said(&short("mechanisms/six_hinge_rigid.urdf", &[]));
    assert!(
        text.contains("It is rigid: no motion is predicted"),
        "{text}"
    );
    assert!(
        text.contains("Nothing moves: the mechanism is rigid"),
        "{text}"
    );
    let json = short(
        "mechanisms/six_hinge_rigid.urdf",
        &["--format", "json", "--want", "1e-3"],
    );
    let value: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(value["choice"]["reached"], false);
    assert!(value["simulation"]["driven"].is_null());
}

#[test]
fn what_cannot_be_wanted_is_refused() {
    for (arguments, words) in [
        (
            vec!["accuracy", BENNETT, "--want", "0"],
            "a positive number",
        ),
        (vec!["accuracy", BENNETT, "--drive", "hing_1"], "hinge_1"),
        (vec!["accuracy", BENNETT, "--branch", "Z"], "no branch `Z`"),
        (vec!["accuracy", BENNETT, "--at", "open"], "open"),
        (vec!["accuracy", BENNETT, "--budget=-1"], "seconds"),
        (vec!["report", BENNETT, "--accuracy"], "--format html"),
        (
            vec!["simulate", BENNETT, "--accuracy=-1"],
            "a positive number",
        ),
        (
            vec![
                "simulate",
                BENNETT,
                "--accuracy",
                "1e-3",
                "--time-step",
                "0.1",
            ],
            "cannot be used with",
        ),
        (
            vec!["trace", BENNETT, "--tolerance=-1"],
            "cannot be closed to",
        ),
    ] {
        let message = refused(&kutzbach(&arguments));
        assert!(message.contains(words), "{arguments:?}: {message}");
    }
}

#[test]
fn a_trace_takes_a_tolerance() {
    let traced = |tolerance: &str| -> Value {
        let output = kutzbach(&[
            "trace",
            BENNETT,
            "--tolerance",
            tolerance,
            "--samples",
            "50",
            "--format",
            "json",
        ]);
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let (coarse, fine) = (traced("1e-3"), traced("0"));
    // What is met on the way is found as well as ever.
    assert_eq!(coarse["events"], fine["events"]);
    let closure = |trace: &Value| trace["largest_closure"].as_f64().unwrap();
    let (coarse, fine) = (closure(&coarse), closure(&fine));
    assert!(coarse > 1e-9 && coarse <= 1e-3, "{coarse}");
    assert!(fine <= 1e-12, "{fine}");
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_simulation_takes_the_cheapest_setting_that_serves() {
        let arguments = [
            "simulate",
            FOUR_BAR,
            "--accuracy",
            "1e-3",
            "--solver",
            "multibody",
            "--format",
            "json",
        ];
        let output = kutzbach(&arguments);
        let value: Value = serde_json::from_slice(&output.stdout).unwrap();
        let choice = &value["accuracy"];
        assert_eq!(choice["reached"], true);
        let setting = &choice["timing"]["setting"];
        let ladder = &value["verification"]["branches"][0]["ladders"][0];
        assert_eq!(ladder["rungs"][0]["substeps"], setting["substeps"]);
        // The verification begins with what was promised.
        let error = ladder["rungs"][0]["closure_error"].as_f64().unwrap();
        assert!(error <= 1e-3, "{error}");
        assert_eq!(value["verification"]["finding"]["outcome"], "confirmed");
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_scene_has_its_own_rows_and_its_effects_their_cost() {
        let output = short(
            "mechanisms/gripper_holding_block.urdf",
            &["--format", "json"],
        );
        let value: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(
            value["scene"]["effects"],
            serde_json::json!(["gravity", "contact"])
        );
        assert!(!value["scene"]["rows"].as_array().unwrap().is_empty());
        let effects = value["effects"].as_array().unwrap();
        let called: Vec<&str> = effects
            .iter()
            .filter(|row| row["called_for"] == true)
            .map(|row| row["effects"].as_str().unwrap())
            .collect();
        assert_eq!(called, ["gravity", "contact", "scene"]);
        let shapes = |name: &str| {
            let row = effects.iter().find(|row| row["effects"] == name).unwrap();
            row["shapes"].as_u64().unwrap()
        };
        assert_eq!((shapes("none"), shapes("contact")), (0, 3));
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn the_page_names_the_cheapest_setting_and_what_was_left_out() {
        let text = said(&short(BENNETT, &["--want", "1e-4"]));
        for wanted in [
            "What accuracy costs for bennett: mobile, finite mobility 1",
            "For an error of 1.0e-4 of the driven motion the cheapest setting is",
            "verdict",
            "whole report",
            "1e-14",
            "★",
            "Left out, since they would take too long",
            "What effects cost",
        ] {
            assert!(text.contains(wanted), "{wanted}:\n{text}");
        }
        let text = said(&short(BENNETT, &["--want", "1e-300"]));
        assert!(
            text.contains(
                "No setting reaches an error of 1.0e-300 of the driven motion; the best is"
            )
        );
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn the_figure_is_xml_and_stands_in_the_page() {
        let svg = said(&short(BENNETT, &["--format", "svg"]));
        let document = roxmltree::Document::parse(&svg).unwrap();
        let texts: Vec<&str> = document
            .descendants()
            .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "text")))
            .filter_map(|node| node.text())
            .collect();
        for wanted in [
            "bennett: what accuracy costs",
            "simulated: multibody",
            "Pareto front of the simulations",
            "time on the clock for one second of motion (s)",
            "chart test, 53 bits",
            "verdict, as needed",
            "1: decided, numeric certificate",
            "whole report, as needed",
        ] {
            assert!(texts.contains(&wanted), "{wanted}: {texts:?}");
        }
        // No style but classes: a page forbids it.
        let html = said(&short(BENNETT, &["--format", "html"]));
        let (_, section) = html.split_once("<section id=\"accuracy\">").unwrap();
        let (section, _) = section.split_once("</section>").unwrap();
        assert!(section.contains("<svg class=\"plot\"") && !section.contains("style="));
        assert!(section.contains("subgroups") && html.contains("id=\"D25\""));
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn two_runs_differ_in_times_only() {
        let [first, second] = [0, 1].map(|_| {
            let output = short(BENNETT, &["--format", "json", "--want", "1e-4"]);
            let mut value: Value = serde_json::from_slice(&output.stdout).unwrap();
            without_times(&mut value);
            value
        });
        assert_eq!(first, second);
        assert_eq!(first["schema"], "kutzbach-accuracy-1");
        assert_eq!(first["finite"], 1);
        assert_eq!(first["choice"]["reached"], true);
        let ways = first["analysis"].as_array().unwrap();
        let claim = |name: &str| -> Vec<&str> {
            let of = ways.iter().filter(|way| way["name"] == name);
            of.map(|way| way["claim"].as_str().unwrap()).collect()
        };
        // The count is wrong of Bennett's linkage; no rank and no germ decides it; the loops close at a distance.
        assert_eq!(claim("count"), ["wrong"]);
        assert_eq!(claim("rank"), ["bounds"; 3]);
        assert_eq!(claim("chart test"), ["decides"; 3]);
        assert_eq!(claim("germ"), ["bounds"; 5]);
        // The verdict comes without exact algebra, which the report asks for a stronger certificate.
        for (name, certificate) in [("verdict", "numeric"), ("whole report", "exact")] {
            assert_eq!(claim(name), ["decides"]);
            let way = ways.iter().find(|way| way["name"] == name).unwrap();
            assert_eq!(way["certificate"], certificate, "{name}");
            assert_eq!(way["says"], "1", "{name}");
            let asked = way["text"].as_str().unwrap();
            assert_eq!(asked.contains("exact"), certificate == "exact", "{asked}");
        }
        assert!(ways.iter().all(|way| way["name"] == "verdict"
            || way["name"] == "whole report"
            || way["certificate"].is_null()));
        // More digits, more margin.
        let margins: Vec<f64> = ways
            .iter()
            .filter(|way| way["name"] == "rank")
            .map(|way| way["decades"].as_f64().unwrap())
            .collect();
        assert!(margins[1] > margins[0] + 10.0 && margins[2] > margins[1] + 20.0);
        // Every setting is there, run or left out.
        let rows = first["simulation"]["rows"].as_array().unwrap();
        let grid = rows
            .iter()
            .filter(|row| [1, 4, 16, 64].contains(&row["substeps"].as_u64().unwrap()));
        assert_eq!(grid.count(), 16);
        for state in ["arrived", "left_out"] {
            assert!(rows.iter().any(|row| row["state"] == state), "{state}");
        }
        for row in rows.iter().filter(|row| row["state"] == "left_out") {
            assert!(row["closure_error"].is_null());
        }
    }
}
