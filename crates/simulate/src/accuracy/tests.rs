//! What is measured of small mechanisms.

use super::*;
use kutzbach_closure::samples::{flat_parallelogram, four_bar, general_four};
use kutzbach_mobility::{AnalysisOptions, analyse};
use kutzbach_model::mechanism::Mechanism;
use std::ops::ControlFlow;

fn options() -> AccuracyOptions {
    AccuracyOptions {
        grid: Grid {
            time_steps: vec![1.0 / 60.0],
            substeps: vec![1, 4],
            ..Grid::quick()
        },
        quick: true,
        ..AccuracyOptions::default()
    }
}

fn measured(mechanism: &Mechanism, options: &AccuracyOptions) -> Result<Accuracy, AccuracyError> {
    let analysis = analyse(mechanism, &AnalysisOptions::default()).unwrap();
    measure(mechanism, &analysis, options, &mut |_, _| {
        ControlFlow::Continue(())
    })
}

fn claims<'a>(accuracy: &'a Accuracy, name: &str) -> Vec<(&'a str, Claim)> {
    let ways = accuracy.analysis.iter().filter(|way| way.name == name);
    ways.map(|way| (way.says.as_str(), way.claim)).collect()
}

#[test]
fn a_four_bar_is_measured_all_the_way() {
    let wanted = 1e-3;
    let accuracy = measured(
        &four_bar(),
        &AccuracyOptions {
            wanted: Some(wanted),
            ..options()
        },
    )
    .unwrap();
    assert_eq!(accuracy.finite, Some(1));
    assert_eq!(claims(&accuracy, "count"), [("-2", Claim::Wrong)]);
    assert_eq!(claims(&accuracy, "rank"), [("at most 1", Claim::Bounds); 3]);
    assert_eq!(claims(&accuracy, "chart test"), [("1", Claim::Decides); 3]);
    assert_eq!(claims(&accuracy, "subgroups"), [("1", Claim::Decides)]);
    for waited_for in ["verdict", "whole report"] {
        assert_eq!(claims(&accuracy, waited_for), [("1", Claim::Decides)]);
    }
    assert_eq!(accuracy.motion.rows.len(), 7);
    for pair in accuracy.motion.rows.windows(2) {
        assert!(pair[1].error() <= pair[0].error() + 1e-15);
    }
    assert!(accuracy.motion.rows[6].error() < 1e-13);
    // Four rows of the grid, and those between.
    assert!(accuracy.simulation.rows.len() >= 4);
    for row in &accuracy.simulation.rows {
        assert_eq!(row.state, State::Arrived, "{row:?}");
        assert!(row.error().unwrap() > 0.0);
    }
    let choice = accuracy.choice.as_ref().unwrap();
    assert!(choice.reached && choice.timing.unwrap().error <= wanted);
    assert!(accuracy.scene.is_none() && !accuracy.stopped);
    assert_eq!(accuracy.effects.len(), 7);
    // What is kept is what was measured, to the last digit but one: JSON is read a rounding off.
    let text = serde_json::to_string(&accuracy).unwrap();
    let read: Accuracy = serde_json::from_str(&text).unwrap();
    assert_eq!(read.analysis.len(), accuracy.analysis.len());
    for (kept, row) in read.simulation.rows.iter().zip(&accuracy.simulation.rows) {
        let [kept, row] = [kept, row].map(|row| row.error().unwrap());
        assert!((kept / row - 1.0).abs() < 1e-12);
    }
}

#[test]
fn the_rank_decides_what_cannot_give_way() {
    let accuracy = measured(&general_four(), &options()).unwrap();
    assert_eq!(claims(&accuracy, "rank"), [("0", Claim::Decides); 3]);
    assert!(accuracy.simulation.why_not.unwrap().contains("rigid"));
    assert!(accuracy.motion.still.is_some());
}

#[test]
fn at_a_singular_pose_the_chart_only_bounds_and_the_germ_agrees() {
    let accuracy = measured(&flat_parallelogram(), &options()).unwrap();
    assert_eq!(accuracy.finite, Some(1));
    assert_eq!(claims(&accuracy, "rank")[0], ("at most 2", Claim::Bounds));
    assert_eq!(
        claims(&accuracy, "chart test")[0],
        ("at most 1", Claim::Bounds)
    );
    for germ in claims(&accuracy, "germ") {
        assert_eq!(germ, ("at most 1", Claim::Bounds));
    }
}

#[test]
fn breaking_off_keeps_what_was_measured() {
    let mechanism = four_bar();
    let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
    let mut stages = Vec::new();
    let accuracy = measure(&mechanism, &analysis, &options(), &mut |stage, done| {
        assert!((0.0..=1.0).contains(&done));
        stages.push(stage);
        if stage == Stage::Simulation {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })
    .unwrap();
    assert!(accuracy.stopped);
    assert!(!accuracy.analysis.is_empty() && !accuracy.motion.rows.is_empty());
    let rows = &accuracy.simulation.rows;
    assert!(rows.iter().all(|row| row.state == State::BrokenOff));
    let first = measure(&mechanism, &analysis, &options(), &mut |_, _| {
        ControlFlow::Break(())
    });
    let first = first.unwrap();
    assert!(first.stopped && first.motion.rows.is_empty());
}

#[test]
fn what_makes_no_sense_is_refused() {
    let with = |change: &dyn Fn(&mut AccuracyOptions)| {
        let mut options = options();
        change(&mut options);
        measured(&four_bar(), &options).unwrap_err().to_string()
    };
    assert!(with(&|o| o.wanted = Some(-1.0)).contains("positive"));
    assert!(with(&|o| o.wanted = Some(f64::NAN)).contains("positive"));
    assert!(with(&|o| o.branch = Some("Z".to_owned())).contains("`Z`"));
}

/// A parallelogram of which every hinge follows or is followed, so that the one that closes the loop does.
const FOLLOWERS: &str = r#"<robot name="parallelogram">
    <link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
    <joint name="a" type="continuous"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
    <joint name="b" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="0 1 0"/><axis xyz="0 0 1"/>
        <mimic joint="c" multiplier="-1"/></joint>
    <joint name="d" type="continuous"><parent link="ground"/><child link="rocker"/><origin xyz="2 0 0"/><axis xyz="0 0 1"/>
        <mimic joint="a"/></joint>
    <loop name="c" type="continuous">
        <predecessor link="coupler"><origin xyz="2 0 0"/></predecessor>
        <successor link="rocker"><origin xyz="0 1 0"/></successor>
        <axis xyz="0 0 1"/>
    </loop>
</robot>"#;

#[test]
fn what_the_engine_cannot_hold_is_not_measured_in_its_stead() {
    let read = kutzbach_format::read_bytes(FOLLOWERS.as_bytes(), "a.urdf", &[]).unwrap();
    let accuracy = measured(&read.mechanism, &options()).unwrap();
    assert!(accuracy.simulation.rows.is_empty());
    let why = accuracy.simulation.why_not.unwrap();
    assert!(why.contains("the engine cannot hold "), "{why}");
}

#[test]
fn errors_confirm_only_where_a_verification_would_take_them() {
    let row = |closure: f64, distance: Option<f64>, state: State| Setting {
        solver: crate::Solver::Impulse,
        time_step: 0.01,
        substeps: 1,
        state,
        closure_error: Some(closure),
        distance,
        came: None,
        timing: None,
    };
    for (setting, confirms) in [
        (row(1e-6, Some(2e-5), State::Arrived), true),
        (row(2e-5, Some(1e-4), State::Arrived), true),
        (row(2e-5, None, State::Arrived), true),
        // Held together, and somewhere else.
        (row(4e-15, Some(0.12), State::Arrived), false),
        (row(5e-3, Some(6e-3), State::Arrived), false),
        (row(1e-6, Some(1e-6), State::Stalled), false),
    ] {
        assert_eq!(setting.confirms(), confirms, "{setting:?}");
    }
}
