//! Kinematic pairs that a STEP file of AP242 says: what each kind becomes, and what is told of those that are not read. The files are
//! written by `tests/step/pairs.py`.

use crate::support::{empty_folder, folder, program};
use kutzbach::format::{Corrections, PairCorrection, PairRule, ReadOptions, Reading, read_with};
use kutzbach::format::{Reason, WarningKind, contact_table};
use kutzbach::mechanism::JointKind;
use kutzbach::mobility::{AnalysisOptions, analyse};

fn text(name: &str) -> String {
    let path = folder("tests/step/pairs").join(format!("{name}.step"));
    std::fs::read_to_string(path).unwrap()
}

fn read_text(text: &str, contacts: Corrections) -> Reading {
    let options = ReadOptions {
        contacts,
        ..ReadOptions::default()
    };
    read_with(text, "pair.step", &options).unwrap_or_else(|error| panic!("{error}"))
}

fn read_file(name: &str) -> Reading {
    read_text(&text(name), Corrections::default())
}

fn finite(reading: &Reading) -> Option<usize> {
    let analysis = analyse(&reading.mechanism, &AnalysisOptions::default()).unwrap();
    analysis.mobility.finite()
}

fn joints(reading: &Reading) -> Vec<String> {
    let joints = reading.mechanism.joints().iter();
    joints.map(|j| format!("{} {}", j.name, j.kind)).collect()
}

fn told(reading: &Reading, kind: WarningKind, words: &str) -> usize {
    let warnings = reading.warnings.iter();
    warnings
        .filter(|w| w.kind == kind && w.message.contains(words))
        .count()
}

#[test]
fn each_kind_of_pair_is_the_joint_that_it_says() {
    for (name, kind, freedom) in [
        ("revolute", "revolute", 1),
        ("revolute_with_range", "revolute", 1),
        ("prismatic", "prismatic", 1),
        ("cylindrical", "cylindrical", 2),
        ("spherical", "spherical", 3),
        ("spherical_with_pin", "universal", 2),
        ("planar", "planar", 3),
        ("universal", "universal", 2),
        ("fully_constrained", "fixed", 0),
        ("low_order", "planar_translation", 2),
        ("screw", "screw", 1),
    ] {
        let reading = read_file(name);
        assert_eq!(joints(&reading), [format!("first-second {kind}")], "{name}");
        assert_eq!(finite(&reading), Some(freedom), "{name}");
        assert_eq!(told(&reading, WarningKind::MayJoin, ""), 0, "{name}");
        // The base of the mechanism is the ground, though the other block is larger.
        let ground = reading.mechanism.link(reading.mechanism.ground());
        assert_eq!(ground.name, "first", "{name}");
    }
}

#[test]
fn pairs_stand_where_their_frames_do() {
    let joint = |name: &str| {
        let reading = read_file(name);
        reading.mechanism.joints()[0].clone()
    };
    let numbers = |name: &str| joint(name).axis.0.each_ref().map(|x| x.value());
    assert_eq!(numbers("prismatic"), [1.0, 0.0, 0.0]);
    assert_eq!(numbers("revolute"), [0.0, 0.0, 1.0]);
    assert_eq!(numbers("universal"), [1.0, 0.0, 0.0]);
    let second = joint("universal").axis2.0.each_ref().map(|x| x.value());
    assert_eq!(second, [0.0, 0.0, 1.0]);
    assert_eq!(joint("screw").lead.as_ref().unwrap().value(), 0.0025);
    // A frame that is elsewhere in the second part is that of no joint.
    let moved = text("revolute").replace("(-16.,4.,-1.)", "(-16.,5.,-1.)");
    let reading = read_text(&moved, Corrections::default());
    assert!(joints(&reading).is_empty());
    assert_eq!(told(&reading, WarningKind::MayJoin, "do not meet"), 1);
    // Nor is one by more than what six digits leave; by less it is the joint that the file says.
    for (beside, count) in [("4.009", 1), ("4.011", 0)] {
        let moved = text("revolute").replace("(-16.,4.,-1.)", &format!("(-16.,{beside},-1.)"));
        let reading = read_text(&moved, Corrections::default());
        assert_eq!(joints(&reading).len(), count, "{beside}");
        let unread = told(&reading, WarningKind::MayJoin, "do not meet");
        assert_eq!(unread, 1 - count, "{beside}");
    }
    // Along its axis a hinge does not slide, and a cylindrical joint does.
    for (name, count) in [("revolute", 0), ("cylindrical", 1)] {
        let moved = text(name).replace("(-16.,4.,-1.)", "(-16.,4.,1.)");
        let reading = read_text(&moved, Corrections::default());
        assert_eq!(joints(&reading).len(), count, "{name}");
    }
}

#[test]
fn gears_couple_their_hinges() {
    let reading = read_file("gear");
    assert_eq!(
        joints(&reading),
        ["first-second revolute", "first-third revolute"]
    );
    assert_eq!(reading.mechanism.couplings().len(), 1);
    assert_eq!(finite(&reading), Some(1));
    // Where a gear and its hinge are moved together they are coupled all the same.
    let moved = text("gear").replacen("(30.,0.,0.)", "(31.,0.,0.)", 1);
    let moved = moved.replacen("(-1.,-1.,-1.)", "(0.,-1.,-1.)", 1);
    let reading = read_text(&moved, Corrections::default());
    assert_eq!(reading.mechanism.couplings().len(), 1);
    // Without a hinge a gear couples nothing, and that is told.
    let fixed = Corrections {
        pairs: vec![PairCorrection {
            parts: ["first".to_owned(), "third".to_owned()],
            rule: PairRule::Joint(JointKind::Fixed),
            lead: None,
        }],
        ..Corrections::default()
    };
    let reading = read_text(&text("gear"), fixed);
    assert_eq!(reading.mechanism.couplings().len(), 0);
    assert_eq!(told(&reading, WarningKind::MayJoin, "GEAR_PAIR"), 1);
}

#[test]
fn what_is_not_read_of_pairs_is_told() {
    for (name, keyword) in [
        ("homokinetic", "HOMOKINETIC_PAIR"),
        ("rack_and_pinion", "RACK_AND_PINION_PAIR"),
    ] {
        let reading = read_file(name);
        assert!(joints(&reading).is_empty(), "{name}");
        assert_eq!(told(&reading, WarningKind::MayJoin, keyword), 1, "{name}");
    }
    let ranged = read_file("revolute_with_range");
    assert_eq!(told(&ranged, WarningKind::Guessed, "limits"), 1);
    assert_eq!(
        told(
            &read_file("universal"),
            WarningKind::Guessed,
            "UNIVERSAL_PAIR"
        ),
        1
    );
    // Nothing between two parts is something that a file may say.
    let free = read_file("unconstrained");
    assert!(joints(&free).is_empty());
    let skewed = text("universal").replace("*,$);", "*,0.1);");
    let reading = read_text(&skewed, Corrections::default());
    assert_eq!(told(&reading, WarningKind::MayJoin, "skew"), 1);
}

#[test]
fn a_list_of_what_a_file_says_is_read_back() {
    let table = contact_table(
        text("universal").as_bytes(),
        "a.step",
        &Corrections::default(),
    );
    let table = table.unwrap();
    assert_eq!(table.rows[0].reason, Reason::Declared);
    let directory = empty_folder("step_pairs");
    let run = |arguments: &[&str]| {
        let output = program().args(arguments).current_dir(&directory).output();
        let output = output.unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{arguments:?}: {told}");
        String::from_utf8(output.stdout).unwrap()
    };
    for name in ["universal", "screw"] {
        let file = format!("{name}.step");
        std::fs::write(directory.join(&file), text(name)).unwrap();
        let listed = run(&["contacts", &file, "--json"]);
        std::fs::write(directory.join("known.json"), listed).unwrap();
        let plain = run(&["convert", &file, "--to", "native"]);
        let known = [
            "convert",
            &file,
            "--to",
            "native",
            "--contacts",
            "known.json",
        ];
        assert_eq!(run(&known), plain, "{name}");
    }
}
