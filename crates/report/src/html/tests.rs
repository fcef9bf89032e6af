use super::motions::{Played, Repertoire, repertoire};
use super::ranges::ranges;
use super::*;
use crate::{Input, Options, analysed_report_on};
use kutzbach_mobility::{AnalysisOptions, analyse};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::EventKind;

fn own(name: &str) -> Mechanism {
    let path = format!(
        "{}/../../mechanisms/{name}.urdf",
        env!("CARGO_MANIFEST_DIR")
    );
    kutzbach_format::read_file(std::path::Path::new(&path), &[])
        .unwrap()
        .mechanism
}

fn played(mechanism: &Mechanism) -> Repertoire {
    let analysis = analyse(mechanism, &AnalysisOptions::default()).unwrap();
    repertoire(mechanism, &analysis, None, 12_000)
}

fn ascending(played: &Played) -> bool {
    played
        .poses
        .windows(2)
        .all(|pair| (pair[0].arclength as f32) < pair[1].arclength as f32)
}

#[test]
fn what_is_met_has_a_sample_of_its_own() {
    let mechanism = own("parallelogram_flat");
    let repertoire = played(&mechanism);
    assert_eq!(repertoire.played.len(), 2);
    for played in &repertoire.played {
        assert!(ascending(played));
        let crossings: Vec<_> = played
            .motion
            .events
            .iter()
            .filter(|event| matches!(event.kind, EventKind::Singular { .. }))
            .collect();
        assert!(!crossings.is_empty());
        for event in crossings {
            let sample = &played.poses[played.nearest(event.arclength)];
            assert!((sample.arclength - event.arclength).abs() < 1e-12);
        }
        assert_eq!(played.poses[played.start].arclength, 0.0);
    }
    // Both branches pass through the pose analysed, so that a page can go over from one to the other.
    let at_home: Vec<Vec<f64>> = repertoire
        .played
        .iter()
        .map(|played| {
            let mut events = played.motion.events.iter();
            let home = events.find(|event| event.kind.is_home()).unwrap();
            played.poses[played.nearest(home.arclength)].values.clone()
        })
        .collect();
    for (a, b) in at_home[0].iter().zip(&at_home[1]) {
        let turns = ((a - b) / std::f64::consts::TAU).round();
        assert!((a - b - turns * std::f64::consts::TAU).abs() < 1e-6);
    }
}

#[test]
fn what_slides_on_and_on_is_shown_for_the_length_of_its_loop() {
    let mechanism = own("cartesian_table");
    let repertoire = played(&mechanism);
    assert!(repertoire.played.len() > 1, "several joints can be driven");
    for played in &repertoire.played {
        assert!(ascending(played));
        let start = &played.poses[played.start].values;
        let variables = kutzbach_motion::Variable::all(&mechanism);
        for pose in &played.poses {
            for ((variable, a), b) in variables.iter().zip(&pose.values).zip(start) {
                if variable.unit(&mechanism) == "m" {
                    assert!((a - b).abs() <= 1.001 * played.motion.length_unit);
                }
            }
        }
    }
    let drives: Vec<&str> = repertoire
        .played
        .iter()
        .map(|played| played.drives[0].name.as_str())
        .collect();
    let mut different = drives.clone();
    different.dedup();
    assert_eq!(drives, different);
}

fn range_texts(mechanism: &Mechanism) -> Vec<String> {
    let input = Input {
        mechanism,
        file: "test.urdf",
        format: "urdf",
        warnings: &[],
        skipped: &[],
    };
    let (report, analysis) = analysed_report_on(&input, &Options::default()).unwrap();
    let facts = Facts {
        mechanism,
        report: &report,
        analysis: &analysis,
        configuration: None,
        verification: None,
        accuracy: None,
    };
    let ranges = ranges(mechanism, &Stage::new(&facts, Assets::Inside.link_poses()));
    ranges.into_values().collect()
}

#[test]
fn ranges_are_those_of_curves() {
    let texts = range_texts(&own("slider_crank"));
    assert!(texts.iter().any(|text| text == "turns fully"), "{texts:?}");
    assert!(texts.iter().any(|text| text.ends_with(" m")), "{texts:?}");
    assert!(texts.iter().any(|text| text.ends_with('°')), "{texts:?}");
}

#[test]
fn how_far_a_motion_without_end_was_followed_is_no_range() {
    let text = r#"<robot name="endless"><link name="rail"/><link name="carriage"/>
        <joint name="slide" type="prismatic"><parent link="rail"/><child link="carriage"/>
        <axis xyz="1 0 0"/></joint></robot>"#;
    let mechanism = kutzbach_format::read(text, "endless.urdf", &[])
        .unwrap()
        .mechanism;
    let texts = range_texts(&mechanism);
    assert_eq!(texts.len(), 1);
    assert!(texts[0].starts_with("at least "), "{texts:?}");
}

#[test]
fn a_rigid_mechanism_says_why_nothing_moves() {
    let repertoire = played(&own("shaky_triangle"));
    assert!(repertoire.played.is_empty());
    assert!(repertoire.nothing.unwrap().contains("rigid"));
}

/// Bennett's linkage to the millimetre, axes to 1e-3: as written it closes nowhere along its motion.
const ROUNDED: &str = r#"<robot name="rounded"><link name="g"/><link name="l1"/><link name="l2"/><link name="l3"/>
<joint name="h1" type="continuous"><parent link="g"/><child link="l1"/><origin xyz="0.100 0.200 0.050"/><axis xyz="0.386 -0.095 0.918"/></joint>
<joint name="h2" type="continuous"><parent link="l1"/><child link="l2"/><origin xyz="0.085 0.180 -0.017"/><axis xyz="0.781 -0.318 0.538"/></joint>
<joint name="h3" type="continuous"><parent link="l2"/><child link="l3"/><origin xyz="-0.186 -0.241 0.128"/><axis xyz="0.032 0.451 0.892"/></joint>
<loop name="h4" type="continuous"><predecessor link="l3"><origin xyz="-0.200 -0.003 0.009"/></predecessor><successor link="g"><origin xyz="-0.201 0.136 0.170"/></successor><axis xyz="0.007 0.876 0.483"/></loop></robot>"#;

#[test]
fn of_rounded_numbers_the_mechanism_meant_is_shown() {
    let mechanism = kutzbach_format::read(ROUNDED, "rounded.urdf", &[])
        .unwrap()
        .mechanism;
    let input = Input {
        mechanism: &mechanism,
        file: "rounded.urdf",
        format: "urdf",
        warnings: &[],
        skipped: &[],
    };
    let (report, analysis) = analysed_report_on(&input, &Options::default()).unwrap();
    let facts = Facts {
        mechanism: &mechanism,
        report: &report,
        analysis: &analysis,
        configuration: None,
        verification: None,
        accuracy: None,
    };
    let prepared = Prepared::new(facts, Assets::Inside);
    let played = &prepared.stage.repertoire.played;
    assert!(!played.is_empty() && played.iter().all(|p| p.poses.len() > 20));
    assert!(prepared.page().unwrap().contains("\"motions\":[{"));
    assert!(!prepared.stage.branches.is_empty());
}
