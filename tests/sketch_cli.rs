//! `kutzbach graph --constructive` from outside, and what is wrong with sketches.

use kutzbach::format::read_sketch;

const TRUSS: &str = include_str!("../examples/draw_sketch/truss.xml");
const PAGE: &str = include_str!("../docs/src/constructive.md");

fn shown(format: &str) -> String {
    let output = crate::support::program()
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["graph", "examples/draw_sketch/truss.xml", "--constructive"])
        .args(["--format", format])
        .output()
        .unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_page_shows_what_the_program_says() {
    let text = shown("text");
    assert!(PAGE.contains(&text), "{text}");
}

#[test]
fn data_and_pictures_say_the_same() {
    let data: serde_json::Value = serde_json::from_str(&shown("json")).unwrap();
    assert_eq!(data["schema"], "kutzbach-sketch-1");
    assert_eq!(data["solutions"], "8");
    assert_eq!(data["steps"][2]["element"], "d");
    assert_eq!(data["constructive"], true);
    let dot = shown("dot");
    assert_eq!(dot.matches("split at").count(), 3);
    assert_eq!(dot.matches(": without").count(), 3);
    let svg = shown("svg");
    assert!(roxmltree::Document::parse(&svg).is_ok());
}

/// Where a change of the example is refused, and how.
fn told(from: &str, to: &str) -> String {
    assert!(TRUSS.contains(from));
    let text = TRUSS.replacen(from, to, 1);
    read_sketch(&text, "f", &[]).unwrap_err().to_string()
}

#[test]
fn every_mistake_is_told_at_its_place() {
    let extra = |more: &str| told("</sketch>", &format!("{more}</sketch>"));
    assert_eq!(
        told("between=\"a b\"", "between=\"a bb\""),
        "f:12:22: no point or line is named `bb`"
    );
    assert_eq!(
        told("between=\"a b\"", "between=\"a\""),
        "f:12:22: needed two names, found 1"
    );
    assert_eq!(
        told("name=\"b\"", "name=\"a\""),
        "f:6:16: two elements are named `a`"
    );
    assert_eq!(
        told("value=\"5\"", "value=\"0\""),
        "f:13:3: two points at distance zero are one point (`a c`)"
    );
    assert_eq!(
        told("value=\"5\"", "value=\"-5\""),
        "f:13:3: the distance of two points is above zero (`a c`)"
    );
    assert_eq!(
        told("direction=\"1 0\"", "direction=\"0 0\""),
        "f:4:3: the direction of a line cannot be zero"
    );
    assert_eq!(
        told(
            "<incidence between=\"a base\"/>",
            "<incidence between=\"a b\"/>"
        ),
        "f:10:23: an incidence is between a point and a line"
    );
    assert_eq!(
        told("<distance between=\"a b\"", "<distance between=\"a a\""),
        "f:12:3: a constraint is between two different elements (`a a`)"
    );
    assert_eq!(
        extra("<distance between=\"c a\" value=\"5\"/>"),
        "f:19:1: this was said of the same two elements before (`c a`)"
    );
    assert_eq!(
        extra("<distance between=\"c a\" value=\"6\"/>"),
        "f:19:1: another value was stated for the same two elements before (`c a`)"
    );
    assert_eq!(
        extra("<angle between=\"base a\" value=\"1\"/>"),
        "f:19:17: an angle is between two lines"
    );
    assert_eq!(extra("<ellipse/>"), "f:19:1: a <sketch> has no <ellipse>");
}

#[test]
fn a_sketch_is_no_mechanism_and_settings_change_it() {
    let error = kutzbach::format::read(TRUSS, "f", &[]).unwrap_err();
    assert!(error.help.unwrap().contains("--constructive"));
    let inside = |links: &str| {
        let text = format!(
            "<robot name='r'>{links}{}</robot>",
            TRUSS.split_once("?>").map_or(TRUSS, |t| t.1)
        );
        kutzbach::format::read(&text, "f", &[])
    };
    let error = inside("").unwrap_err();
    let root = "<sketch> has to be the root element of a file of its own";
    assert_eq!(error.message, root);
    let beside = inside("<link name='a'/>").unwrap();
    assert!(beside.skipped.iter().any(|s| s.what == root));
    let wider = [("span".to_owned(), "9".to_owned())];
    let named = read_sketch(TRUSS, "f", &wider).unwrap();
    let words = kutzbach::constructive::words::SketchWords::of(&named);
    assert_eq!(words.construction().unwrap().count().value(), Some(0));
    assert!(
        words
            .text()
            .contains("circles do not meet, they are 1 apart")
    );
}

fn said(arguments: &[&str]) -> String {
    let output = crate::support::program()
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .output()
        .unwrap();
    String::from_utf8([output.stdout, output.stderr].concat()).unwrap()
}

#[test]
fn planar_mechanisms_have_as_many_solutions_as_configurations() {
    for (name, hold) in [
        ("slider_crank", "main_bearing=0.3"),
        ("planar_four_bar", "crank_pivot=0.3"),
        ("parallelogram", "left_pivot=0.3"),
    ] {
        let file = format!("mechanisms/{name}.urdf");
        let sketch = said(&["graph", &file, "--constructive", "--hold", hold]);
        let modes = said(&["assemble", &file, "--hold", hold]);
        assert!(sketch.contains("solutions: 2\n"), "{sketch}");
        assert!(modes.contains("2 configurations, and no other"), "{modes}");
    }
}

#[test]
fn what_is_known_of_mechanisms_shows_in_their_sketches() {
    let shown = |name: &str| {
        let file = format!("mechanisms/{name}.urdf");
        said(&["graph", &file, "--constructive"])
    };
    for (name, words) in [
        ("k33_dixon", "triconnected: "),
        ("planar_four_bar", "freedoms left: 1"),
        ("k44_dixon", "over-constrained"),
        ("double_pendulum", "it is free there"),
        ("bennett", "does not move in the plane of the others"),
        ("delta", "planar parts have hinges and sliders"),
    ] {
        let text = shown(name);
        assert!(text.contains(words), "{name}: {text}");
    }
}

/// The middle link slides along both of its neighbours at once.
#[test]
fn a_link_with_parallel_sliders_only_is_refused() {
    let joint = |name: &str, kind: &str, parent: &str, child: &str, frame: &str, axis: &str| {
        format!(
            "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/><origin {frame}/>\
             <axis xyz=\"{axis}\"/></joint>"
        )
    };
    let mechanism = |turned: &str| {
        let text = format!(
            "<robot name=\"x\"><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>{}{}\
             <loop name=\"pin\" type=\"revolute\"><predecessor link=\"c\"><origin xyz=\"1 1 0\"/></predecessor>\
             <successor link=\"a\"><origin xyz=\"2 3 0\"/></successor><axis xyz=\"0 0 1\"/></loop></robot>",
            joint("one", "prismatic", "a", "b", "xyz=\"0 0 0\"", "1 0 0"),
            joint("two", "prismatic", "b", "c", "xyz=\"1 2 0\"", turned),
        );
        let mechanism = kutzbach::format::read(&text, "x.urdf", &[])
            .unwrap()
            .mechanism;
        kutzbach::constructive::planar::sketch(&mechanism).map_err(|why| why.to_string())
    };
    let why = mechanism("1 0 0").unwrap_err();
    assert_eq!(
        why,
        "all sliders of link `b` are parallel, and it has no hinge: it is free along them"
    );
    assert!(mechanism("0 1 0").is_ok());
}

const TRIANGLE: [&str; 3] = ["graph", "mechanisms/sketch_triangle.xml", "--constructive"];

#[test]
fn the_triangle_of_the_slides_makes_four_figures() {
    let text = said(&TRIANGLE);
    let known =
        "sketch_triangle: 7 elements, 11 constraints, well-constrained\nsteps: 5\nsolutions: 4\n";
    assert!(text.starts_with(known), "{text}");
    let text = said(&[&TRIANGLE[..], &["--clusters"]].concat());
    let (_, clusters) = text.split_once("reduction:\n").unwrap();
    let (reduction, tree) = clusters.split_once("ternary tree:\n").unwrap();
    assert_eq!(reduction.lines().count(), 5, "{text}");
    let last = reduction.lines().last().unwrap();
    assert!(
        last.starts_with("cluster 5: A B C D AB AC BC, of "),
        "{text}"
    );
    // Eleven constraints below five splits, and everything above all.
    assert_eq!(tree.lines().count(), 16, "{text}");
    assert!(tree.starts_with("  A B C D AB AC BC, shared: "), "{text}");
    let json = said(&[&TRIANGLE[..], &["--clusters", "--format", "json"]].concat());
    let data: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(data["solutions"], "4");
    assert_eq!(data["clusters"]["reduction"].as_array().unwrap().len(), 5);
    assert_eq!(
        data["clusters"]["ternary_tree"]["sets"]
            .as_array()
            .unwrap()
            .len(),
        5
    );
}

/// Where an element is in what a choice of sides shows.
fn place(text: &str, element: &str) -> [f64; 2] {
    let line = text
        .lines()
        .find_map(|l| l.strip_prefix(&format!("{element} at ")));
    let numbers = line.unwrap_or_else(|| panic!("{text}")).split(' ');
    let numbers: Vec<f64> = numbers.map(|n| n.parse().unwrap()).collect();
    [numbers[0], numbers[1]]
}

#[test]
fn sides_are_chosen_by_the_element_that_has_them() {
    let away = |text: &str, from: &str| {
        let [p, q] = [place(text, "D"), place(text, from)];
        (p[0] - q[0]).hypot(p[1] - q[1])
    };
    let [ahead, behind] = ["ahead", "behind"].map(|side| {
        let choice = format!("--side=D={side}");
        said(&[&TRIANGLE[..], &[&choice]].concat())
    });
    // AC is 5 long and D 2 from C, towards A as drawn or away from it.
    let mut found = [away(&ahead, "A"), away(&behind, "A")];
    found.sort_by(f64::total_cmp);
    assert!(
        (found[0] - 3.0).abs() < 1e-5 && (found[1] - 7.0).abs() < 1e-5,
        "{ahead}{behind}"
    );
    assert!(
        [&ahead, &behind]
            .iter()
            .all(|t| (away(t, "C") - 2.0).abs() < 1e-5)
    );
    assert_eq!(
        ahead.contains("chosen") as u8 + behind.contains("chosen") as u8,
        1
    );
    let wrong = said(&[&TRIANGLE[..], &["--side=D=up"]].concat());
    assert!(
        wrong.contains("a side is `left` or `right`, `ahead` or `behind`, not `up`"),
        "{wrong}"
    );
    let wrong = said(&[&TRIANGLE[..], &["--side=E=left"]].concat());
    assert!(wrong.contains("no step places an element `E`"), "{wrong}");
}

/// Too long for every commit.
mod corpus {
    use super::said;
    use crate::support::{folder, in_parallel, mechanism_files};
    use serde_json::Value;

    /// Joints held, and how many configurations `assemble` proves there are; `None` where it does not.
    fn proven(file: &str) -> Option<(Vec<String>, usize)> {
        let answer: Value =
            serde_json::from_str(&said(&["assemble", file, "--format", "json"])).ok()?;
        let held = answer["held"].as_object()?.iter();
        let held = held.map(|(joint, value)| format!("--hold={joint}={value}"));
        let all = answer["solutions"].as_array()?.len();
        (answer["complete"] == "proven").then(|| (held.collect(), all))
    }

    /// Different solvers on different equations: interval subdivision and exact algebra along an incidence tree, constructions by
    /// circles and lines, exact algebra in coordinates.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn planar_mechanisms_have_as_many_solutions_as_configurations_are_proven() {
        let files: Vec<String> = ["mechanisms", "tests/zoo"]
            .iter()
            .flat_map(|path| mechanism_files(&folder(path)))
            .map(|(_, path)| path.display().to_string())
            .filter(|file| {
                let read = kutzbach::format::read_file(file, &[]).unwrap();
                kutzbach::constructive::planar::sketch(&read.mechanism).is_ok()
            })
            .collect();
        let compared = in_parallel(&files, |file| {
            let (held, configurations) = proven(file)?;
            let mut arguments = vec!["graph", file, "--constructive", "--format", "json"];
            arguments.extend(held.iter().map(String::as_str));
            let sketch: Value = serde_json::from_str(&said(&arguments)).ok()?;
            let solutions: usize = sketch["solutions"].as_str()?.parse().ok()?;
            Some((file.clone(), configurations, solutions))
        });
        let known: Vec<_> = compared.into_iter().flatten().collect();
        assert!(known.len() >= 35, "only {} were compared", known.len());
        for (file, configurations, solutions) in known {
            assert_eq!(configurations, solutions, "{file}");
        }
    }
}

/// A rectangle of lines with a diagonal, by directions alone.
const RECTANGLE: &str = r#"<sketch name="rectangle">
  <point name="a" xy="0 0"/> <point name="b" xy="4 0.1"/> <point name="c" xy="4.1 3"/> <point name="d" xy="0.1 3"/>
  <line name="left" through="0 0" direction="0 1"/> <line name="top" through="0 3" direction="-1 0.1"/>
  <incidence between="a left"/> <incidence between="d left"/> <incidence between="d top"/> <incidence between="c top"/>
  <distance between="a b" value="4"/> <distance between="b c" value="3"/>
  <horizontal of="a b"/> <vertical of="left"/> <horizontal of="top"/> <vertical of="c b"/>
</sketch>"#;

#[test]
fn directions_of_lines_and_of_two_points_are_angles_as_drawn() {
    let named = read_sketch(RECTANGLE, "f", &[]).unwrap();
    // The sides without a line of their own get one each; the first direction is no constraint.
    assert_eq!(&named.names[6..], ["a–b", "c–b"]);
    let angles = named.sketch.constraints().iter();
    let is_line = |e: &usize| *e >= 4;
    let angles = angles.filter(|c| c.ends.iter().all(is_line));
    let quarters: Vec<f64> = angles
        .map(|c| c.value.value() / std::f64::consts::FRAC_PI_2)
        .collect();
    assert_eq!(quarters, [1.0, 2.0, -1.0]);
    let words = kutzbach::constructive::words::SketchWords::of(&named);
    let text = words.text();
    assert!(
        text.starts_with("rectangle: 8 elements, 13 constraints, well-constrained"),
        "{text}"
    );
    let one = words
        .construction()
        .unwrap()
        .with_sides(words.construction().unwrap().drawn_left());
    assert!(one.is_ok());
    // Two points that a line of the drawing holds are told on it: the same direction twice.
    let twice = RECTANGLE.replace("<horizontal of=\"a b\"/>", "<vertical of=\"a d\"/>");
    let error = read_sketch(&twice, "f", &[]).unwrap_err();
    assert_eq!(error.message, "this was said of the same line before");
    let error = read_sketch(&RECTANGLE.replace("of=\"a b\"", "of=\"a left\""), "f", &[]);
    assert_eq!(error.unwrap_err().message, "needed a line, or two points");
    let across = RECTANGLE.replace(
        "<vertical of=\"left\"/>",
        "<perpendicular between=\"left top\"/>",
    );
    let named = read_sketch(&across, "f", &[]).unwrap();
    let last = named
        .sketch
        .constraints()
        .iter()
        .find(|c| c.ends == [4, 5])
        .unwrap();
    assert!((last.value.value() - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
}

#[test]
fn a_ring_of_angles_has_one_too_many() {
    let ring = |last: &str| {
        let text = format!(
            "<sketch name='ring'><line name='a' through='0 0' direction='1 0'/><line name='b' through='0 0' direction='1 1'/>\
             <line name='c' through='0 1' direction='0 1'/><point name='p' xy='1 2'/>\
             <angle between='a b' value='${{pi/4}}'/><angle between='b c' value='${{pi/4}}'/><angle between='c a' value='{last}'/>\
             <distance between='p a' value='1'/><distance between='p b' value='2'/><distance between='p c' value='2'/></sketch>"
        );
        let named = read_sketch(&text, "f", &[]).unwrap();
        kutzbach::constructive::words::SketchWords::of(&named).text()
    };
    let agrees = ring("${-pi/2}");
    assert!(
        agrees.starts_with("ring: 4 elements, 6 constraints, over-constrained"),
        "{agrees}"
    );
    assert!(agrees.contains(
        "too many: c a is fixed already by the constraints among a b c, and agrees with them"
    ));
    let turned = ring("${3*pi/2}");
    assert!(
        turned.contains("and agrees with them"),
        "a whole turn is none: {turned}"
    );
    let contradicts = ring("${pi/2}");
    assert!(
        contradicts.contains("and contradicts them"),
        "{contradicts}"
    );
    // 2 · 4 − 3 − 5 independent constraints.
    assert!(
        agrees.contains("\nfreedoms left: 0") || !agrees.contains("freedoms left"),
        "{agrees}"
    );
}

#[test]
fn a_budget_of_nothing_leaves_what_is_solved_at_once_undecided() {
    // The edges of K3,3: no circles and lines construct it.
    let points: [[i32; 2]; 6] = [[0, 0], [5, 1], [2, 6], [1, 3], [7, 5], [4, -3]];
    let named = |i: usize| format!("p{i}");
    let mut text = "<sketch name='k33'>".to_owned();
    for (i, [x, y]) in points.iter().enumerate() {
        text += &format!("<point name='{}' xy='{x} {y}'/>", named(i));
    }
    for (i, p) in points[..3].iter().enumerate() {
        for (j, q) in points[3..].iter().enumerate() {
            let square = (p[0] - q[0]).pow(2) + (p[1] - q[1]).pow(2);
            text += &format!(
                "<distance between='p{i} p{}' value='${{sqrt({square})}}'/>",
                j + 3
            );
        }
    }
    text += "</sketch>";
    let folder = crate::support::empty_folder("sketch_budget");
    let file = folder.join("k33.xml");
    std::fs::write(&file, text).unwrap();
    let file = file.to_str().unwrap();
    let whole = said(&["graph", file, "--constructive"]);
    assert!(whole.contains("and no other, by exact algebra"), "{whole}");
    let none = said(&["graph", file, "--constructive", "--budget", "0"]);
    assert!(
        none.contains("is not decided: the work limit was reached"),
        "{none}"
    );
    assert!(none.contains("budget: about 0 s of work"), "{none}");
    // Some are known all the same, and no more than there are.
    let count = |text: &str, before: &str| -> usize {
        let (_, rest) = text.split_once(before).unwrap();
        let number = rest.split_whitespace().next().unwrap();
        number.parse().unwrap()
    };
    let all = count(&whole, "\nsolutions: ");
    let some = count(&none, "\nsolutions: at least ");
    assert!(0 < some && some <= all, "{some} of {all}");
}
