//! STEP assemblies: what their contacts become, and what moves then.

use crate::support::{empty_folder, folder, program, step_text};
use kutzbach::format::{
    Corrections, PairCorrection, PairRule, ReadOptions, Reading, Reason, WarningKind,
    contact_table, read, read_with,
};
use kutzbach::mechanism::JointKind;
use kutzbach::mobility::{AnalysisOptions, analyse};
use kutzbach::report::{Options, report};
use std::path::Path;

fn read_corrected(text: &str, contacts: Corrections) -> Reading {
    let options = ReadOptions {
        contacts,
        ..ReadOptions::default()
    };
    read_with(text, "machine.step", &options).unwrap_or_else(|error| panic!("{error}"))
}

fn read_plain(text: &str) -> Reading {
    read_corrected(text, Corrections::default())
}

fn pair(first: &str, second: &str, word: &str, lead: Option<f64>) -> Corrections {
    Corrections {
        pairs: vec![PairCorrection {
            parts: [first.to_owned(), second.to_owned()],
            rule: PairRule::from_word(word).unwrap(),
            lead,
        }],
        ..Corrections::default()
    }
}

/// Useful, floating and idle degrees of freedom.
fn freedoms(reading: &Reading) -> [usize; 3] {
    let report = report(reading, "machine.step", &Options::default()).unwrap();
    let freedoms = report.freedoms.expect("its freedoms are known");
    [freedoms.useful, freedoms.floating, freedoms.idle]
}

fn finite(reading: &Reading) -> Option<usize> {
    let analysis = analyse(&reading.mechanism, &AnalysisOptions::default()).unwrap();
    analysis.mobility.finite()
}

/// Names and kinds of joints, in alphabetical order.
fn joints(reading: &Reading) -> Vec<String> {
    let joints = reading.mechanism.joints().iter();
    let mut words: Vec<String> = joints.map(|j| format!("{} {}", j.name, j.kind)).collect();
    words.sort();
    words
}

fn may_join(reading: &Reading) -> Vec<&str> {
    let told = reading.warnings.iter();
    let told = told.filter(|w| w.kind == WarningKind::MayJoin);
    told.map(|w| w.message.as_str()).collect()
}

#[test]
fn a_four_bar_of_bars_and_pins_moves_in_one_way_and_its_pins_turn() {
    // Tight, with 0.05 mm and 0.1 mm of room around each pin, in whole holes and in halves.
    for (room, halves) in [(0.0, false), (0.05, false), (0.1, false), (0.1, true)] {
        let reading = read_plain(&step_text::four_bar(room, halves));
        assert_eq!(reading.format, "step");
        assert_eq!(reading.mechanism.links().len(), 8);
        assert_eq!(
            joints(&reading),
            [
                "coupler-crank planar",
                "coupler-pin (3) cylindrical",
                "coupler-pin (4) cylindrical",
                "coupler-rocker planar",
                "crank-pin (3) cylindrical",
                "crank-pin cylindrical",
                "ground-crank planar",
                "ground-pin (2) cylindrical",
                "ground-pin cylindrical",
                "ground-rocker planar",
                "rocker-pin (2) cylindrical",
                "rocker-pin (4) cylindrical",
            ]
        );
        assert!(may_join(&reading).is_empty(), "{:?}", reading.warnings);
        assert!(reading.mechanism.precision().is_exact());
        // Each pin turns and slides by itself.
        assert_eq!(freedoms(&reading), [1, 0, 8], "room {room}, {halves}");
        assert_eq!(finite(&reading), Some(9));
    }
}

#[test]
fn bars_further_from_their_pins_than_the_clearance_do_not_touch_them() {
    let text = step_text::four_bar(0.3, false);
    let apart = read_plain(&text);
    assert!(joints(&apart).iter().all(|joint| joint.ends_with("planar")));
    assert_eq!(may_join(&apart).len(), 4, "{:?}", apart.warnings);
    let wide = Corrections {
        clearance: Some(0.0004),
        ..Corrections::default()
    };
    assert_eq!(freedoms(&read_corrected(&text, wide)), [1, 0, 8]);
}

#[test]
fn a_slider_crank_moves_in_one_way() {
    for room in [0.0, 0.1] {
        let reading = read_plain(&step_text::slider_crank(room));
        let found = joints(&reading);
        assert!(
            found.contains(&"base-slider prismatic".to_owned()),
            "{found:?}"
        );
        assert_eq!(found.len(), 10, "{found:?}");
        assert_eq!(freedoms(&reading), [1, 0, 6]);
    }
}

#[test]
fn a_screw_jack_needs_to_be_told_its_thread() {
    for room in [0.0, 0.1] {
        let text = step_text::screw_jack(room);
        let plain = read_plain(&text);
        assert_eq!(
            joints(&plain),
            [
                "frame-lead screw revolute",
                "frame-nut prismatic",
                "nut-lead screw cylindrical"
            ]
        );
        assert_eq!(finite(&plain), Some(2));
        let thread = pair("lead screw", "nut", "thread", Some(0.002));
        let threaded = read_corrected(&text, thread);
        let joint = threaded.mechanism.joint_named("nut-lead screw").unwrap();
        let joint = threaded.mechanism.joint(joint);
        assert_eq!(joint.kind, JointKind::Screw);
        assert_eq!(joint.lead.as_ref().unwrap().value(), 0.002);
        assert_eq!(finite(&threaded), Some(1));
        assert_eq!(freedoms(&threaded), [1, 0, 0]);
    }
}

#[test]
fn a_universal_joint_turns_about_two_axes_that_meet() {
    for (room, tilted) in [(0.0, false), (0.1, false), (0.0, true), (0.1, true)] {
        let reading = read_plain(&step_text::universal_joint(room, tilted));
        assert_eq!(
            joints(&reading),
            ["base fork-cross revolute", "output fork-cross revolute"],
            "tilted {tilted}"
        );
        assert_eq!(finite(&reading), Some(2));
        // Where the axes meet both joints stand, however the whole is turned: in the cross its frame is the second joint's.
        let second = reading.mechanism.joint_named("output fork-cross").unwrap();
        let second = reading.mechanism.joint(second);
        assert!(second.predecessor.frame.is_identity(), "{second:?}");
    }
}

#[test]
fn a_cross_slide_table_slides_in_two_directions() {
    let reading = read_plain(&step_text::cross_slide());
    assert_eq!(
        joints(&reading),
        ["machine bed-saddle prismatic", "saddle-table prismatic"]
    );
    assert_eq!(freedoms(&reading), [2, 0, 0]);
    let ground = reading.mechanism.link(reading.mechanism.ground());
    assert_eq!(ground.name, "machine bed");
}

#[test]
fn fasteners_are_tight_by_name_and_head_and_pins_are_not() {
    for (name, kind) in [
        ("M6x6 bolt", JointKind::Fixed),
        ("DIN 912 - M6", JointKind::Fixed),
        ("pin", JointKind::Revolute),
        ("shoulder bolt", JointKind::Revolute),
        ("lever", JointKind::Revolute),
    ] {
        let text = step_text::plate_and(name, false);
        let reading = read_plain(&text);
        assert_eq!(reading.mechanism.joints()[0].kind, kind, "{name}");
        let told = reading
            .warnings
            .iter()
            .filter(|w| w.kind == WarningKind::Guessed && w.message.contains("taken as tight"));
        assert_eq!(told.count(), usize::from(kind == JointKind::Fixed));
        // Whoever knows better says so, and is told nothing.
        let other = read_corrected(&text, pair("plate", name, "revolute", None));
        assert_eq!(other.mechanism.joints()[0].kind, JointKind::Revolute);
        assert!(!other.warnings.iter().any(|w| w.message.contains("tight")));
        let pressed = read_corrected(&text, pair(name, "plate", "press fit", None));
        assert_eq!(finite(&pressed), Some(0));
        let ignored = read_corrected(&text, pair(name, "plate", "ignore", None));
        assert!(ignored.mechanism.joints().is_empty());
        assert_eq!(may_join(&ignored).len(), 1);
    }
}

/// A bolt through two plates with a nut at its end: the nut neither turns on the bolt nor counts for a freedom of its own.
#[test]
fn nuts_are_tight_on_bolts_that_are() {
    for (bolt, nut, tight) in [
        ("M6 bolt", "M6 nut", true),
        ("M6 bolt", "washer", true),
        // Neither a collar on a bolt nor a nut on what moves.
        ("M6 bolt", "collar", false),
        ("pin", "M6 nut", false),
        ("shoulder bolt", "M6 nut", false),
    ] {
        let text = step_text::two_plates(bolt, nut);
        let reading = read_plain(&text);
        let kind = if tight { "fixed" } else { "cylindrical" };
        let joint = format!("{bolt}-{nut} {kind}");
        assert!(joints(&reading).contains(&joint), "{:?}", joints(&reading));
        let by_seat = "by name and seat";
        let told = reading.warnings.iter();
        let told = told.filter(|w| w.message.contains(by_seat)).count();
        assert_eq!(told, usize::from(tight), "{bolt}, {nut}");
        if tight {
            // The plate turns about its one bolt, with it and the nut.
            assert_eq!(finite(&reading), Some(1));
            let turned = read_corrected(&text, pair(nut, bolt, "cylindrical", None));
            assert!(joints(&turned).contains(&format!("{bolt}-{nut} cylindrical")));
        }
    }
}

#[test]
fn what_touches_nothing_floats_and_is_told() {
    let reading = read_plain(&step_text::plate_and("pin", true));
    let told = may_join(&reading);
    assert!(told.len() == 1 && told[0].contains("`stone`"), "{told:?}");
    let fixed = read_corrected(
        &step_text::plate_and("pin", true),
        pair("stone", "plate", "fixed", None),
    );
    assert!(may_join(&fixed).is_empty());
    assert_eq!(finite(&fixed), Some(1));
}

#[test]
fn corrections_of_what_is_not_there_are_errors() {
    let text = step_text::four_bar(0.0, false);
    let fails = |contacts: Corrections| {
        let options = ReadOptions {
            contacts,
            ..ReadOptions::default()
        };
        let error = read_with(&text, "four_bar.step", &options).unwrap_err();
        (error.message, error.help.unwrap_or_default())
    };
    let (message, help) = fails(pair("cranck", "pin", "fixed", None));
    assert!(
        message.contains("`cranck`") && help.contains("`crank`"),
        "{message} {help}"
    );
    let ground = Corrections {
        ground: Some("gruond".to_owned()),
        ..Corrections::default()
    };
    assert!(fails(ground).1.contains("`ground`"));
    assert!(
        fails(pair("crank", "pin", "thread", None))
            .0
            .contains("lead")
    );
    assert!(
        fails(pair("crank", "pin", "fixed", Some(1.0)))
            .0
            .contains("lead")
    );
    assert!(
        fails(pair("crank", "crank", "fixed", None))
            .0
            .contains("twice")
    );
    // A crank on a rocker that it does not touch has no axis.
    let (message, _) = fails(pair("crank", "rocker", "revolute", None));
    assert!(message.contains("found no contact"), "{message}");
    let robot = "<robot name='a'><link name='b'/></robot>";
    let options = ReadOptions {
        contacts: pair("a", "b", "fixed", None),
        ..ReadOptions::default()
    };
    assert!(read_with(robot, "a.urdf", &options).is_err());
}

#[test]
fn errors_of_a_file_name_their_line_and_entity() {
    let text = step_text::four_bar(0.0, false);
    let broken = text.replacen("CYLINDRICAL_SURFACE('',#", "CYLINDRICAL_SURFACE('',#999", 1);
    let error = read(&broken, "broken.step", &[]).unwrap_err();
    assert!(error.line > 5 && error.message.starts_with('#'), "{error}");
    let told = broken.lines().nth(error.line - 1).unwrap();
    assert_eq!(broken.get(error.span.clone()), Some(told));
    let error = contact_table(b"<robot/>", "a.urdf", &Corrections::default()).unwrap_err();
    assert!(error.message.contains("ISO-10303-21"), "{error}");
}

#[test]
fn a_table_says_why_each_pair_is_what_it_is() {
    let text = step_text::plate_and("M6 bolt", false);
    let table = contact_table(text.as_bytes(), "a.step", &Corrections::default()).unwrap();
    let row = &table.rows[0];
    assert_eq!(row.rule, Some(PairRule::Joint(JointKind::Fixed)));
    assert_eq!(row.reason, Reason::Fastener);
    assert!(row.margin.unwrap().is_clear());
    let round = row
        .contacts
        .iter()
        .find(|c| c.kind == "cylindrical")
        .unwrap();
    assert!((round.radius.unwrap() - 0.003).abs() < 1e-12);
}

fn run(folder: &Path, arguments: &[&str]) -> (String, String) {
    let output = program()
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let (out, told) = (text(output.stdout), text(output.stderr));
    assert!(output.status.success(), "{arguments:?}: {told}");
    (out, told)
}

#[test]
fn the_list_of_contacts_is_read_back_and_says_the_same() {
    let folder = empty_folder("step_contacts");
    for (name, text) in [
        ("four_bar", step_text::four_bar(0.05, false)),
        ("bolted", step_text::plate_and("M6 bolt", false)),
        ("jack", step_text::screw_jack(0.0)),
    ] {
        let file = format!("{name}.step");
        std::fs::write(folder.join(&file), text).unwrap();
        let (listed, _) = run(&folder, &["contacts", &file, "--json"]);
        std::fs::write(folder.join("known.json"), &listed).unwrap();
        let (page, _) = run(&folder, &["contacts", &file]);
        assert!(page.contains("cylindrical ⌀"), "{page}");
        let plain = run(&folder, &["convert", &file, "--to", "native"]).0;
        let known = [
            "convert",
            &file,
            "--to",
            "native",
            "--contacts",
            "known.json",
        ];
        assert_eq!(run(&folder, &known).0, plain);
        let again = ["contacts", &file, "--json", "--contacts", "known.json"];
        let twice = run(&folder, &again).0;
        let joints = |text: &str| -> Vec<String> {
            let lines = text.lines().filter(|line| line.contains("\"is\""));
            lines.map(str::to_owned).collect()
        };
        assert_eq!(joints(&twice), joints(&listed));
        assert!(!joints(&listed).is_empty());
    }
    std::fs::write(folder.join("slip.json"), "{\"pairs\": [{\"part\": []}]}").unwrap();
    let output = program()
        .args(["contacts", "jack.step", "--contacts", "slip.json"])
        .current_dir(&folder)
        .output()
        .unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(told.contains("unknown field `part`"), "{told}");
}

#[test]
fn a_converted_assembly_reads_back_with_the_same_verdict() {
    for text in [
        step_text::four_bar(0.05, false),
        step_text::slider_crank(0.1),
        step_text::universal_joint(0.0, true),
        step_text::cross_slide(),
    ] {
        let reading = read_plain(&text);
        let written = kutzbach::format::write(&reading.mechanism);
        let again =
            read(&written, "written.urdf", &[]).unwrap_or_else(|e| panic!("{e}\n{written}"));
        assert_eq!(joints(&again), joints(&reading));
        assert_eq!(freedoms(&again), freedoms(&reading));
        assert_eq!(finite(&again), finite(&reading));
    }
}

/// The file of the book's example; `KUTZBACH_WRITE=1` writes it anew.
#[test]
fn the_example_is_the_one_that_is_written_here() {
    let file = folder("examples/step").join("four_bar.step");
    let text = step_text::four_bar(0.05, false);
    if std::env::var_os("KUTZBACH_WRITE").is_some() {
        std::fs::write(&file, &text).unwrap();
    }
    let found = std::fs::read_to_string(&file).unwrap();
    assert!(found == text, "{} is another text", file.display());
}
