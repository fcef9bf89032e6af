//! The example on the README's first screen is what the program prints.

#[test]
fn the_report_in_the_readme_is_the_one_printed() {
    let root = env!("CARGO_MANIFEST_DIR");
    let readme = std::fs::read_to_string(format!("{root}/README.md")).unwrap();
    let (_, rest) = readme
        .split_once("```text\n")
        .expect("the README shows a report");
    let (shown, _) = rest.split_once("\n```").expect("the block ends");
    let run = crate::support::program()
        .args(["report", "mechanisms/bennett.urdf"])
        .current_dir(root)
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    assert_eq!(
        shown.trim_end(),
        String::from_utf8(run.stdout).unwrap().trim_end()
    );
}

/// What the program prints of a mechanism of this repository.
fn printed(arguments: &[&str]) -> String {
    let run = crate::support::program()
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(run.status.success(), "{arguments:?}");
    String::from_utf8(run.stdout).unwrap()
}

#[test]
fn first_screens_are_short_and_whole() {
    for (file, most) in [
        ("mechanisms/bennett.urdf", 25),
        ("tests/zoo/sarrus_6r.urdf", 30),
        ("mechanisms/delta.urdf", 40),
    ] {
        let page = printed(&["report", file]);
        assert!(page.lines().count() <= most, "{file}:\n{page}");
        // Neither a cell that is cut nor the number of a definition.
        assert!(page.lines().all(|line| !line.contains("…  ")), "{page}");
        assert!(!page.contains("(D") && !page.contains(", D"), "{page}");
    }
}

/// Links that slide on where they stop turning have no greatest pitch; Steffen's, which stand still altogether there, have one.
#[test]
fn a_pitch_that_goes_to_infinity_is_none_of_the_whole_branch() {
    for (file, link, whole) in [
        ("mechanisms/hexapod_on_conic.urdf", 0, false),
        ("tests/zoo/csrr_cusp.urdf", 0, false),
        ("tests/zoo/steffen_polyhedron.urdf", 1, true),
    ] {
        let json = printed(&["report", file, "--format", "json"]);
        let report: serde_json::Value = serde_json::from_str(&json).unwrap();
        let row = &report["motions"][link];
        assert_eq!(row["whole_branch"] == true, whole, "{file}: {row}");
        let pitches = row["pitches"].as_array().unwrap();
        for pitch in pitches.iter().filter_map(serde_json::Value::as_f64) {
            assert!(pitch.abs() < 10.0, "{file}: {row}");
        }
    }
}

/// Bennett's coupler turns with its crank in a closed cycle; its pitch runs from -1 to -1/2 m/rad.
#[test]
fn pitches_and_ranges_are_those_of_the_whole_cycle() {
    let json = printed(&["report", "mechanisms/bennett.urdf", "--format", "json"]);
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    for joint in report["joints"].as_array().unwrap() {
        let turns = joint["ranges"][0]["turns"].as_i64().unwrap();
        assert_eq!(turns.abs(), 1, "{joint}");
    }
    let mut motions = report["motions"].as_array().unwrap().iter();
    let coupler = motions.find(|row| row["link"] == "coupler").unwrap();
    assert_eq!(coupler["whole_branch"], true);
    for (pitch, expected) in coupler["pitches"]
        .as_array()
        .unwrap()
        .iter()
        .zip([-1.0, -0.5])
    {
        assert!(
            (pitch.as_f64().unwrap() - expected).abs() < 1e-8,
            "{coupler}"
        );
    }
    let metres = printed(&["report", "tests/zoo/sarrus_6r.urdf", "--units", "rad-m"]);
    assert!(
        metres.contains(" rad ") && !metres.contains('°'),
        "{metres}"
    );
}
