//! `kutzbach geometry` and `kutzbach features` from outside.

use crate::support::{empty_folder, folder};
use serde_json::Value;
use std::fs;
use std::process::Output;

const WORLD: &str = "examples/geometry/bracket.txt";
const STEP: &str = "mechanisms/features/step.features";

fn kutzbach(arguments: &[&str]) -> Output {
    crate::support::program()
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn done(arguments: &[&str]) -> String {
    let output = kutzbach(arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    String::from_utf8(output.stdout).unwrap()
}

fn refused(arguments: &[&str]) -> String {
    let output = kutzbach(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn questions_are_answered_in_both_forms() {
    for form in [&[][..], &["--tolerant"]] {
        let asked =
            |question: &str| done(&[&["geometry", WORLD, "--ask", question][..], form].concat());
        assert_eq!(asked("distance(bracket.tread, table)"), "= 1\n");
        assert_eq!(asked("concave(bracket.tread, bracket.riser)"), "yes\n");
        let free = asked("is(?f, face), parallel(?f, bracket.tread), ?f != bracket.tread");
        assert_eq!(free, "?f = bracket.bottom\n?f = bracket.top\n2 answers\n");
    }
    // The pin is where two digits say, and so is its axis; half a unit of the last place decides.
    let question = ["--ask", "contained(point(2.52, 1, 7), axis(pin))"];
    assert_eq!(
        done(&[&["geometry", WORLD][..], &question].concat()),
        "no\n"
    );
    let tolerant = [&["geometry", WORLD, "--tolerant"][..], &question].concat();
    assert_eq!(done(&tolerant), "within the digits\n");
}

#[test]
fn data_say_what_text_says() {
    let questions = [
        "--ask",
        "distance(O, point(1, 1, 0))",
        "--ask",
        "is(?c, cylinder)",
    ];
    let text = done(&[&["geometry", WORLD, "--json"][..], &questions].concat());
    let data: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(data["schema"], "kutzbach-geometry-1");
    let number = data["questions"][0]["answers"][0]["values"][0]["number"].as_f64();
    assert!((number.unwrap() - 2f64.sqrt()).abs() < 1e-15);
    assert_eq!(
        data["questions"][1]["answers"][0]["found"]["c"]["text"],
        "pin"
    );
    assert_eq!(
        data["questions"][1]["answers"][0]["found"]["c"]["kind"],
        "cylinder"
    );
}

#[test]
fn a_transcript_is_run_again_to_the_same_bytes() {
    let place = empty_folder("geometry_transcript");
    let first = place.join("first.ask");
    let first = first.to_str().unwrap();
    done(&[
        "geometry",
        WORLD,
        "--script",
        "examples/geometry/bracket.ask",
        "-o",
        first,
    ]);
    let text = fs::read_to_string(first).unwrap();
    assert!(
        text.contains("classify(foot, bracket.tread)\n#| = inside\n"),
        "{text}"
    );
    assert!(text.contains("#| gap: 1.5\n"), "{text}");
    assert!(
        text.contains("#| ?f = bracket.top\n#| ?f = bracket.tread\n"),
        "{text}"
    );
    assert!(!text.contains("?f = bracket.bottom"), "{text}");
    assert_eq!(done(&["geometry", WORLD, "--script", first]), text);
}

#[test]
fn without_a_question_all_entities_are_listed() {
    let text = done(&["geometry", WORLD]);
    assert!(
        text.contains("bracket: a solid of 8 faces, 18 edges and 12 vertices\n"),
        "{text}"
    );
    assert!(
        text.contains("pin: cylinder(point(2.5, 1, 0), direction(0, 0, 1), 0.5)\n"),
        "{text}"
    );
}

#[test]
fn errors_name_places() {
    let said = refused(&["geometry", WORLD, "--ask", "parallel(bracket.tred, table)"]);
    assert!(
        said.contains("column 10") && said.contains("`bracket.tred`"),
        "{said}"
    );
    let place = empty_folder("geometry_errors");
    let wrong = place.join("wrong.txt");
    fs::write(&wrong, "point A 0 0 0\nline l A through A\n").unwrap();
    // From its own folder, so that the line is not broken.
    let output = crate::support::program()
        .args(["geometry", "wrong.txt"])
        .current_dir(&place)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        said.contains("wrong.txt:2:8") && said.contains("two different points"),
        "{said}"
    );
    let said = refused(&["geometry", "-", "--script", "-"]);
    assert!(said.contains("found two"), "{said}");
    let said = refused(&["features", WORLD, "--declared", WORLD]);
    assert!(
        said.contains("bracket.txt:2:1") && said.contains("`DEFINITION`"),
        "{said}"
    );
    let said = refused(&["features", WORLD, "--declared", STEP, "--part", "plate"]);
    assert!(said.contains("the file has bracket"), "{said}");
}

#[test]
fn the_declared_step_is_found() {
    let text = done(&["features", WORLD, "--declared", STEP]);
    assert!(text.starts_with("STEP in bracket: 1\n"), "{text}");
    assert!(
        text.contains("  bracket.tread  bracket.riser  bracket.edge15\n"),
        "{text}"
    );
    let json = done(&[
        "features",
        WORLD,
        "--declared",
        STEP,
        "--tolerant",
        "--json",
    ]);
    let data: Value = serde_json::from_str(&json).unwrap();
    let found = &data["found"][0];
    assert_eq!(found["feature"], "STEP");
    assert_eq!(found["features"][0]["roles"]["F1"], "bracket.tread");
    assert_eq!(found["features"][0]["ways"], 2);
    assert_eq!(found["plan"][0]["tuples_made"], 18);
}

#[test]
fn every_shipped_declaration_is_one() {
    let mut files = 0;
    for entry in fs::read_dir(folder("mechanisms/features")).unwrap() {
        let path = entry.unwrap().path();
        let text = done(&["features", WORLD, "--declared", path.to_str().unwrap()]);
        assert!(text.contains(" in bracket: "), "{text}");
        files += 1;
    }
    assert!(files >= 4);
}

#[test]
fn features_are_drawn_with_their_faces_marked() {
    let svg = done(&["features", WORLD, "--declared", STEP, "--svg"]);
    assert_eq!(svg, done(&["features", WORLD, "--declared", STEP, "--svg"]));
    let document = roxmltree::Document::parse(&svg).unwrap();
    let texts: Vec<&str> = document
        .descendants()
        .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "text")))
        .filter_map(|node| node.text())
        .collect();
    for word in ["STEP in bracket: 1", "F1", "F2", "E1"] {
        assert!(texts.contains(&word), "{word}: {texts:?}");
    }
    // Two faces and an edge of one step.
    let marked = document
        .descendants()
        .filter(|node| node.attribute("class").is_some_and(|c| c.contains("m0")));
    assert_eq!(marked.count(), 3);
    let both = refused(&["features", WORLD, "--declared", STEP, "--svg", "--json"]);
    assert!(both.contains("--json"), "{both}");
}
