//! `kutzbach assemble` from outside: what it prints, and how it ends.

use std::process::Output;

fn kutzbach(arguments: &[&str]) -> Output {
    crate::support::program()
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .output()
        .unwrap()
}

fn json(arguments: &[&str]) -> serde_json::Value {
    let mut all = vec!["assemble"];
    all.extend(arguments);
    all.extend(["--format", "json", "--budget", "60"]);
    let output = kutzbach(&all);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn refused(arguments: &[&str]) -> String {
    let output = kutzbach(arguments);
    assert_eq!(output.status.code(), Some(2));
    String::from_utf8(output.stderr).unwrap()
}

/// The data of a page's script.
fn page_data(page: &str) -> serde_json::Value {
    let (_, rest) = page.split_once("id=\"page-data\">").unwrap();
    let (data, _) = rest.split_once("</script>").unwrap();
    serde_json::from_str(data).unwrap()
}

/// Numbers of a field in base64.
fn numbers(field: &serde_json::Value) -> Vec<f32> {
    use base64::Engine;
    let bytes = base64::engine::general_purpose::STANDARD
        .decode(field.as_str().unwrap())
        .unwrap();
    let four = bytes.chunks_exact(4);
    four.map(|b| f32::from_le_bytes(b.try_into().unwrap()))
        .collect()
}

/// The crank-rocker closes in two ways at any angle of its crank, on two circuits: each turns fully through its own. Three
/// tetrahedra do not move.
#[test]
fn the_page_shows_configurations_side_by_side_and_moves_through_each() {
    let page = |file: &str| {
        let output = kutzbach(&["assemble", file, "--format", "html"]);
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let text = page("mechanisms/planar_four_bar.urdf");
    assert_eq!(text, page("mechanisms/planar_four_bar.urdf"));
    assert_eq!(text.matches("<li><svg").count(), 2);
    let data = page_data(&text);
    let answer = json(&["mechanisms/planar_four_bar.urdf"]);
    let names: Vec<&str> = data["joints"]
        .as_array()
        .unwrap()
        .iter()
        .map(|joint| joint["name"].as_str().unwrap())
        .collect();
    for (index, branch) in data["branches"].as_array().unwrap().iter().enumerate() {
        // The drawn one comes first, the others in their order.
        let title = branch["name"].as_str().unwrap();
        let number: usize = title
            .strip_prefix("Configuration ")
            .unwrap()
            .parse()
            .unwrap();
        let solution = &answer["solutions"][number - 1];
        assert_eq!(index == 0, solution["drawn"] == true);
        let motion = &data["motions"][branch["motions"][0].as_u64().unwrap() as usize];
        assert_eq!(motion["closed"], true);
        let values = numbers(&motion["values"]);
        let start = motion["start"].as_u64().unwrap() as usize * names.len();
        for (name, value) in names.iter().zip(&values[start..start + names.len()]) {
            let wanted = solution["joints"][name].as_f64().unwrap();
            let off = (f64::from(*value) - wanted).rem_euclid(std::f64::consts::TAU);
            assert!(
                off.min(std::f64::consts::TAU - off) < 1e-5,
                "{title}, {name}: {value}, {wanted}"
            );
        }
    }
    let text = page("mechanisms/tetra_iii.urdf");
    assert_eq!(text.matches("<li><svg").count(), 10);
    let data = page_data(&text);
    let poses: std::collections::BTreeSet<&str> = data["motions"]
        .as_array()
        .unwrap()
        .iter()
        .map(|motion| motion["poses"].as_str().unwrap())
        .collect();
    assert_eq!(poses.len(), 10);
}

/// Three tetrahedra: a rotation about an axis for each, a point of its conic, and three closure equations.
#[test]
fn the_equations_of_the_tree_are_written_for_other_programs() {
    let written = |file: &str, format: &str| {
        let output = kutzbach(&["assemble", file, "--format", format]);
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let text = written("mechanisms/tetra_iii.urdf", "msolve");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[..2], ["x1,x2,x3,x4,x5,x6", "0"]);
    assert_eq!(lines.len(), 2 + 6);
    assert_eq!(lines[5], "x1^2+8*x2^2-1,");
    let text = written("mechanisms/tetra_iii.urdf", "singular");
    assert!(text.starts_with("// x1: x1\n"), "{text}");
    assert!(
        text.ends_with("ideal G = std(I);\ndim(G);\nmult(G);\n"),
        "{text}"
    );
    let error = refused(&["assemble", "mechanisms/delta.urdf", "--format", "msolve"]);
    assert!(
        error.contains("no equations of an incidence tree"),
        "{error}"
    );
}

/// Three tetrahedra around the triangle that they imply: each shares two points with it, which are five equations. Text, data and
/// pictures agree.
#[test]
fn seam_graphs_and_selections_are_shown() {
    let shown = |format: &str| {
        let file = "mechanisms/tetra_iii.urdf";
        let output = kutzbach(&["graph", file, "--seams", "--format", format]);
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let data: serde_json::Value = serde_json::from_str(&shown("json")).unwrap();
    let seams = &data["seams"];
    assert_eq!(
        (&seams["equations"], &seams["removed"]),
        (&15.into(), &15.into())
    );
    assert_eq!(seams["copies"], 9);
    let selected = seams["selected"].as_array().unwrap();
    let text = shown("text");
    assert!(
        text.contains("Well-formed selection: 15 equations, as many as"),
        "{text}"
    );
    assert_eq!(text.matches(" of 3 equations").count(), selected.len());
    // Two copies of two points for each tetrahedron and pair, and the selected edges.
    assert_eq!(shown("dot").matches(" -- ").count(), 6 + selected.len());
    let svg = shown("svg");
    assert!(roxmltree::Document::parse(&svg).is_ok());
    assert!(svg.contains("Seam graph of 9 copies of points"));
    let incidence = kutzbach(&[
        "graph",
        "mechanisms/tetra_iii.urdf",
        "--incidence",
        "--format",
        "svg",
    ]);
    let incidence = String::from_utf8(incidence.stdout).unwrap();
    assert!(
        incidence.contains("Incidence tree of 4 bodies") && !incidence.contains("ground</text>")
    );
    let error = refused(&["graph", "mechanisms/oldham.urdf", "--seams"]);
    assert!(error.contains("no incidence tree"), "{error}");
}

/// The problems of the paper: file, weight of the tree, configurations, how often each counts.
#[test]
fn all_configurations_of_the_papers_problems_are_found() {
    for (name, weight, count, times) in [
        ("tetra_i", 3, 1, 2),
        ("tetra_ii", 3, 4, 1),
        ("tetra_iii", 3, 10, 1),
        ("tetra_20_10_4", 3, 6, 1),
        ("tetra_6_7_8", 3, 8, 1),
        ("pent", 4, 8, 1),
        ("quad_16_17_18_19", 4, 8, 1),
    ] {
        let answer = json(&[&format!("mechanisms/{name}.urdf")]);
        assert_eq!(answer["schema"], "kutzbach-assembly-1");
        assert_eq!(answer["complete"], "proven", "{name}");
        assert_eq!(answer["system"]["tree"]["weight"], weight, "{name}");
        let solutions = answer["solutions"].as_array().unwrap();
        assert_eq!(solutions.len(), count, "{name}");
        assert!(
            solutions.iter().all(|s| s["multiplicity"] == times),
            "{name}"
        );
        assert_eq!(
            solutions.iter().filter(|s| s["drawn"] == true).count(),
            1,
            "{name}"
        );
    }
}

#[test]
fn what_moves_is_told_with_what_to_hold() {
    let answer = json(&["mechanisms/quad.urdf", "--free"]);
    assert_eq!(answer["complete"], "unknown");
    assert_eq!(answer["moves"], 1);
    assert_eq!(answer["propose"].as_array().unwrap().len(), 1);
    let answer = json(&["mechanisms/quad.urdf"]);
    assert_eq!(answer["freedom"], 1);
    assert_eq!(answer["complete"], "proven");
}

/// The configuration that is drawn.
fn drawn(answer: &serde_json::Value) -> &serde_json::Value {
    let solutions = answer["solutions"].as_array().unwrap();
    solutions.iter().find(|s| s["drawn"] == true).unwrap()
}

/// Fewer equations than unknowns, and yet a real solution that is isolated.
#[test]
fn stretched_linkages_are_not_said_to_move() {
    for file in [
        "mechanisms/four_bar_stretched.urdf",
        "mechanisms/five_bar_stretched.urdf",
        "mechanisms/spherical_four_bar_stretched.urdf",
        "mechanisms/four_creases_in_a_corner.urdf",
        "tests/zoo/planar_4r_stretched_isolated.urdf",
    ] {
        let answer = json(&[file]);
        assert_eq!(answer["complete"], "unknown", "{file}");
        assert!(answer["moves"].is_null(), "{file}");
        let why = answer["why"].as_str().unwrap();
        assert!(why.contains("may be isolated"), "{file}: {why}");
        let drawn = drawn(&answer);
        assert_eq!(drawn["finite"], 0, "{file}");
        assert_eq!(drawn["kind"], "unknown", "{file}");
    }
    // The same count of equations where something does move.
    let answer = json(&["mechanisms/planar_four_bar.urdf", "--free"]);
    assert_eq!(
        (&answer["moves"], &drawn(&answer)["finite"]),
        (&1.into(), &1.into())
    );
    assert_eq!(answer["propose"].as_array().unwrap().len(), 1);
}

/// Some configurations form a curve; the drawn one does not lie on it.
#[test]
fn what_moves_elsewhere_is_not_said_of_the_drawn_configuration() {
    for name in [
        "sarrus",
        "miura",
        "torus_in_tube_isolated",
        "peaucellier_tilted_slot",
    ] {
        let file = format!("mechanisms/{name}.urdf");
        let answer = json(&[&file]);
        assert_eq!(answer["moves"], 1, "{name}");
        assert_eq!(drawn(&answer)["finite"], 0, "{name}");
        assert!(answer["propose"].as_array().unwrap().is_empty(), "{name}");
        let output = kutzbach(&["assemble", &file, "--budget", "60"]);
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(
            text.contains(
                "The drawn configuration does not move; others do, with 1 degree of freedom."
            ),
            "{text}"
        );
    }
}

#[test]
fn held_joints_have_their_values() {
    let answer = json(&[
        "mechanisms/planar_four_bar.urdf",
        "--hold",
        "crank_pivot=30deg",
    ]);
    for solution in answer["solutions"].as_array().unwrap() {
        let value = solution["joints"]["crank_pivot"].as_f64().unwrap();
        assert!((value - std::f64::consts::FRAC_PI_6).abs() < 1e-9);
    }
    assert_eq!(answer["complete"], "proven");
}

/// The cosine of 0.5 is not algebraic: a joint is held beside it, and it is said where.
#[test]
fn any_angle_can_be_held() {
    for (name, joint, count) in [
        ("planar_four_bar", "crank_pivot", 2),
        ("rssr", "crank_pivot", 2),
        ("bennett", "hinge_1", 1),
    ] {
        let answer = json(&[
            &format!("mechanisms/{name}.urdf"),
            "--hold",
            &format!("{joint}=0.5"),
        ]);
        assert_eq!(answer["complete"], "proven", "{name}: {}", answer["why"]);
        let solutions = answer["solutions"].as_array().unwrap();
        assert_eq!(solutions.len(), count, "{name}");
        let [p, q] = answer["held_near"][joint]["half_tangent"]
            .as_str()
            .and_then(|fraction| fraction.split_once('/'))
            .map(|(p, q)| [p, q].map(|x| x.parse::<f64>().unwrap()))
            .unwrap();
        assert!((2.0 * (p / q).atan() - 0.5).abs() < 1e-12);
    }
    // What has an algebraic cosine is held as it is.
    let answer = json(&["mechanisms/bennett.urdf", "--hold", "hinge_1=30deg"]);
    assert!(answer["held_near"].as_object().unwrap().is_empty());
}

#[test]
fn the_same_question_has_the_same_bytes() {
    let question = [
        "assemble",
        "mechanisms/tetra_6_7_8.urdf",
        "--format",
        "json",
    ];
    assert_eq!(kutzbach(&question).stdout, kutzbach(&question).stdout);
}

#[test]
fn bad_input_has_its_own_words() {
    let file = "mechanisms/planar_four_bar.urdf";
    let said = refused(&["assemble", file, "--hold", "nobody=1"]);
    assert!(said.contains("no joint named `nobody`"), "{said}");
    let said = refused(&["assemble", file, "--hold", "crank_pivot"]);
    assert!(said.contains("states no value"), "{said}");
    let said = refused(&["assemble", file, "--hold", "crank_pivot=zwei"]);
    assert!(said.contains("is no value"), "{said}");
    let said = refused(&[
        "assemble",
        "mechanisms/tetra_i.urdf",
        "--hold",
        "corner_12=1",
    ]);
    assert!(said.contains("is spherical"), "{said}");
}

#[test]
fn incidence_trees_are_shown_in_every_form() {
    let show = |format: &str| {
        let output = kutzbach(&[
            "graph",
            "mechanisms/tetra_i.urdf",
            "--incidence",
            "--format",
            format,
        ]);
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let text = show("text");
    assert!(
        text.contains(
            "Incidence tree of weight 3 (the least of 36 covering sets), sum of depths 3"
        ),
        "{text}"
    );
    assert!(show("dot").starts_with("graph constraints {"));
    assert!(show("svg").contains("<svg"));
    let said = refused(&["graph", "mechanisms/oldham.urdf", "--incidence"]);
    assert!(said.contains("no incidence tree"), "{said}");
}

/// Two tetrahedra in two pieces each: three whole ones have ten configurations, with one of the three mirrored sixteen, and a reflection turns
/// two mirrored into one.
#[test]
fn bodies_in_pieces_are_put_together_first() {
    let file = "tests/incidence/bodies_in_pieces.urdf";
    let answer = json(&[file]);
    assert_eq!(answer["solutions"].as_array().unwrap().len(), 10 + 3 * 16);
    assert_eq!(answer["complete"], "proven");
    let parts = answer["system"]["parts"].as_array().unwrap();
    let weights = parts
        .iter()
        .map(|p| (p["weight"].as_u64(), p["ways"].as_u64()));
    assert_eq!(weights.collect::<Vec<_>>(), [(Some(1), Some(2)); 2]);
    assert_eq!(answer["system"]["tree"]["weight"], 3);
    let shown = kutzbach(&["graph", file, "--incidence"]);
    let shown = String::from_utf8(shown.stdout).unwrap();
    assert!(shown.contains("put together first, into {"), "{shown}");
}

/// Example 2 of Sitharam, Zhou and Peters: trees of weight 7 and 5 over four bodies, where three leave 4.
#[test]
fn incidence_trees_can_be_asked_for() {
    let file = "tests/incidence/four_in_a_ring.urdf";
    let shown = |more: &[&str]| {
        let mut all = vec!["graph", file, "--incidence"];
        all.extend(more);
        let output = kutzbach(&all);
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let four = [
        "--cover", "a", "--cover", "b", "--cover", "c", "--cover", "d",
    ];
    let lightest = shown(&four);
    let said = "Incidence tree of weight 5 (as asked for; 4 is the least of 7 covering sets)";
    assert!(lightest.contains(said), "{lightest}");
    let heavier = shown(&["--place", "a=d", "--place", "d=c", "--place", "b=c"]);
    assert!(
        heavier.contains("Incidence tree of weight 7 (as asked"),
        "{heavier}"
    );
    let all = shown(&["--covers"]);
    let counts = all
        .lines()
        .filter_map(|line| line.trim().strip_prefix("weight "));
    let counts: Vec<&str> = counts.collect();
    // Any three, all four, and the two pairs that share nothing.
    assert_eq!(counts, ["4: 4", "5: 1", "6: 2"]);
    let refusals: [(&[&str], &str); 3] = [
        (&["--cover", "a"], "do not have all points"),
        (
            &["--place", "a=b", "--place", "a=d"],
            "`a` would be placed twice",
        ),
        (&["--place", "a=x"], "is not of the form CHILD=PARENT"),
    ];
    for (more, sentence) in refusals {
        let mut all = vec!["graph", file, "--incidence"];
        all.extend(more);
        let said = refused(&all);
        assert!(said.contains(sentence), "{said}");
    }
}

/// A planar four-bar and Bennett's loop would be rigid with generic dimensions; nothing is implied of what they are.
#[test]
fn incidence_trees_imply_no_bodies_that_move() {
    for name in ["planar_four_bar", "bennett"] {
        let file = format!("mechanisms/{name}.urdf");
        let output = kutzbach(&["graph", &file, "--incidence", "--format", "json"]);
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(answer["standard"], false, "{name}");
        let bodies = answer["bodies"].as_array().unwrap();
        assert_eq!(bodies.len(), 4, "{name}");
        assert!(bodies.iter().all(|b| b["implied"] == false), "{name}");
        assert_eq!(answer["tree"]["weight"], 2, "{name}");
    }
}

/// The equations of the loops hold √√2 as a variable: solutions with −√√2 belong to no pose.
#[test]
fn the_loops_have_as_many_solutions_as_the_tree() {
    let output = kutzbach(&[
        "exact",
        "mechanisms/quad_16_17_18_19.urdf",
        "--time",
        "60",
        "--format",
        "json",
    ]);
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let solutions = &answer["solutions"];
    assert_eq!(solutions["complex"], 64);
    assert_eq!(solutions["conjugates_of"].as_array().unwrap().len(), 2);
    assert_eq!(solutions["real"].as_array().unwrap().len(), 8);
    assert_eq!(answer["pieces"][0]["real_points"], 8);
}

fn text(file: &str) -> String {
    let output = kutzbach(&["assemble", file, "--budget", "60"]);
    String::from_utf8(output.stdout).unwrap()
}

/// A platform on six bars has no joint values to show; where it is tells the configurations apart.
#[test]
fn links_on_bars_alone_are_shown_by_their_place() {
    let text = text("mechanisms/hexapod_quarter_turn.urdf");
    let places: Vec<&str> = text.lines().filter(|l| l.contains("turned by")).collect();
    assert_eq!(places.len(), 2, "{text}");
    assert!(
        places.iter().all(|l| l.trim().starts_with("platform")),
        "{text}"
    );
    assert_ne!(places[0], places[1], "{text}");
}

#[test]
fn rods_that_spin_are_named() {
    let answer = json(&["mechanisms/rssr.urdf"]);
    assert_eq!(answer["spinning"][0], "rod");
    let text = text("mechanisms/rssr.urdf");
    assert!(
        text.contains(
            "At any angle about the line through its two balls, in every configuration: rod."
        ),
        "{text}"
    );
    let answer = json(&["mechanisms/planar_four_bar.urdf"]);
    assert!(answer["spinning"].as_array().unwrap().is_empty());
}
