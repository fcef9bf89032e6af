//! The pages of eight mechanisms: their record, their figures and their text are one, and the errors are those of the program as it is
//! now. No seconds are asserted.
#[path = "../examples/accuracy_page/page.rs"]
mod page;
#[path = "../examples/accuracy_page/record.rs"]
#[allow(dead_code)] // the example measures anew
mod record;
#[path = "../examples/accuracy_page/subjects.rs"]
mod subjects;
use crate::support;

use kutzbach::accuracy::{Accuracy, AccuracyOptions, Claim, Grid, State};
use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::mobility::{AnalysisOptions, analyse};
use kutzbach::simulate::{Effects, Solver, World, WorldOptions, scene_drives};
use page::{PAGES, Page};
use record::{Record, Row};
use std::fs;
use subjects::SUBJECTS;
use support::folder;

fn kept() -> Record {
    let path = folder("benches/record/accuracy.json");
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn the_record_has_every_mechanism_and_every_way() {
    let record = kept();
    let names: Vec<&str> = record
        .mechanisms
        .iter()
        .map(|row| row.name.as_str())
        .collect();
    assert_eq!(names, SUBJECTS.map(|subject| subject.name));
    for Row { name, accuracy, .. } in &record.mechanisms {
        assert!(!accuracy.stopped);
        let ways: Vec<&str> = accuracy
            .analysis
            .iter()
            .map(|way| way.name.as_str())
            .collect();
        for way in [
            "count",
            "rank",
            "subgroups",
            "chart test",
            "germ",
            "exact algebra",
            "verdict",
            "whole report",
        ] {
            assert!(ways.contains(&way), "{name}: {way}");
        }
        // No engine contradicts the verdict; the counts may.
        for way in accuracy
            .analysis
            .iter()
            .filter(|way| way.claim == Claim::Wrong)
        {
            assert!(
                ["count", "generic rank"].contains(&way.name.as_str()),
                "{name}: {way:?}"
            );
        }
        assert_eq!(accuracy.motion.rows.len(), 7, "{name}");
        let settings = Grid::full();
        let grid = settings.solvers.len() * settings.time_steps.len() * settings.substeps.len();
        assert_eq!(accuracy.simulation.rows.len(), grid, "{name}");
    }
}

/// Page and figures are drawn from the record, every digit of them.
#[test]
fn the_page_and_the_figures_show_the_record() {
    let record = kept();
    let anew = "to write them anew: cargo run --example accuracy_page -- --redraw";
    let read = |page: Page| fs::read_to_string(folder(page.file())).unwrap();
    for page in PAGES {
        let text = read(page);
        assert!(page.replaced(&text, &record).unwrap() == text, "{anew}");
    }
    let page = read(Page::ByMechanism);
    for row in &record.mechanisms {
        let svg = fs::read_to_string(folder(&page::figure_file(&row.name))).unwrap();
        assert!(page::figure_of(row) == svg, "{}: {anew}", row.name);
        roxmltree::Document::parse(&svg).unwrap();
        assert!(page.contains(&format!("images/accuracy_{}.svg", row.name)));
    }
}

#[test]
fn a_page_without_its_markers_is_refused() {
    assert!(PAGES.iter().all(|page| page.replaced("", &kept()).is_err()));
}

/// One coarse setting for each solver.
fn fresh(name: &str) -> Accuracy {
    let subject = SUBJECTS
        .iter()
        .find(|subject| subject.name == name)
        .unwrap();
    let options = AccuracyOptions {
        grid: Grid {
            time_steps: vec![1.0 / 60.0],
            substeps: vec![4],
            ..Grid::full()
        },
        quick: true,
        ..AccuracyOptions::default()
    };
    record::measured(subject, &options).unwrap()
}

/// The gripper of the page does hold its block: gravity pulls, friction does not let it go.
#[test]
fn the_block_is_held() {
    let subject = SUBJECTS
        .iter()
        .find(|subject| subject.name == "gripper")
        .unwrap();
    let mechanism = subject.mechanism().unwrap();
    let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
    let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
    let options = WorldOptions {
        effects: Effects::of_scene(&mechanism),
        substeps: 16,
        ..WorldOptions::default()
    };
    let states = &analysis.assembly.states;
    let mut world = World::new(&mechanism, &geometry, states, &options).unwrap();
    for drive in scene_drives(&mechanism) {
        world.drive(drive).unwrap();
    }
    let links = mechanism.links();
    let block = links.iter().position(|link| link.name == "block").unwrap();
    let before = world.link_poses()[block].translation;
    for _ in 0..240 {
        world.step().unwrap();
    }
    let after = world.link_poses()[block].translation;
    // Free, it would have fallen by five metres.
    let moved = (0..3)
        .map(|i| (after[i] - before[i]).powi(2))
        .sum::<f64>()
        .sqrt();
    assert!(moved < 0.01, "{moved}");
    assert!(world.contacts() >= 2);
}

/// Too long for every commit.
mod corpus {
    use super::*;

    /// The small ones: what the record says of them is what is found now.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn the_record_s_errors_are_found_now() {
        let record = kept();
        for name in ["four_bar", "bennett", "gripper"] {
            let now = fresh(name);
            let then = &record
                .mechanisms
                .iter()
                .find(|row| row.name == name)
                .unwrap()
                .accuracy;
            assert_eq!(now.finite, then.finite, "{name}");
            let says = |accuracy: &Accuracy| -> Vec<(String, String, Claim)> {
                let ways = accuracy.analysis.iter();
                ways.map(|way| (way.name.clone(), way.says.clone(), way.claim))
                    .collect()
            };
            assert_eq!(says(&now), says(then), "{name}");
            for solver in [Solver::Multibody, Solver::Impulse] {
                let error = |accuracy: &Accuracy| {
                    let rows = accuracy.simulation.rows.iter();
                    let row = rows
                        .filter(|row| row.solver == solver && row.substeps == 4)
                        .find(|row| (row.time_step * 60.0 - 1.0).abs() < 1e-9)
                        .unwrap();
                    assert_eq!(row.state, State::Arrived, "{name}");
                    row.error().unwrap()
                };
                let (now, then) = (error(&now), error(then));
                assert!(
                    (now / then - 1.0).abs() < 0.2,
                    "{name}: {then:e} in the record, {now:e} now"
                );
            }
        }
    }
}
