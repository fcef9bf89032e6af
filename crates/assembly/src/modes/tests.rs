//! Whole mechanisms.

use super::*;
use crate::samples;
use std::time::Duration;

fn modes_of(name: &str) -> Modes {
    let question = Question {
        limits: Limits {
            time: Some(Duration::from_secs(60)),
            ..Limits::default()
        },
        held: None,
    };
    assembly_modes(&samples::own(name), &question).unwrap()
}

#[test]
fn the_drawn_configuration_is_among_all() {
    for (name, count) in [
        ("tetra_ii", 4),
        ("tetra_iii", 10),
        ("pent", 8),
        ("quad_16_17_18_19", 8),
    ] {
        let start = std::time::Instant::now();
        let modes = modes_of(name);
        println!("{name} {:?}", start.elapsed());
        assert_eq!(modes.complete, Complete::Proven, "{name}");
        assert_eq!(modes.configurations.len(), count, "{name}");
        let drawn = modes.configurations.iter().filter(|c| c.drawn).count();
        assert_eq!(drawn, 1, "{name}");
    }
}

#[test]
fn double_solutions_and_curves_are_told_as_such() {
    let start = std::time::Instant::now();
    let double = modes_of("tetra_i");
    println!("tetra_i {:?}", start.elapsed());
    assert_eq!(double.complete, Complete::Proven);
    assert_eq!(double.configurations.len(), 1);
    assert_eq!(double.configurations[0].multiplicity, 2);
    assert!(double.configurations[0].drawn);
    let start = std::time::Instant::now();
    let question = Question {
        held: Some(Vec::new()),
        limits: Limits {
            time: Some(Duration::from_secs(60)),
            ..Limits::default()
        },
    };
    let curve = assembly_modes(&samples::own("quad"), &question).unwrap();
    println!("quad {:?} {curve:?}", start.elapsed());
    assert_eq!(curve.moves, Some(1));
    assert!(!curve.proposed.is_empty());
    // With one face held it does not move.
    let start = std::time::Instant::now();
    let held = modes_of("quad");
    println!(
        "quad held {:?} {} {:?}",
        start.elapsed(),
        held.configurations.len(),
        held.complete
    );
    assert_eq!(held.held.len(), 1);
}

#[test]
fn mechanisms_of_other_joints() {
    for name in [
        "planar_four_bar",
        "slider_crank",
        "bennett",
        "rssr",
        "spherical_four_bar",
        "six_hinge_rigid",
        "cardan_shaft",
    ] {
        let start = std::time::Instant::now();
        let modes = modes_of(name);
        println!(
            "{name} {:?} held {} configurations {} {:?} drawn {} {:?}",
            start.elapsed(),
            modes.held.len(),
            modes.configurations.len(),
            modes.complete,
            modes.configurations.iter().filter(|c| c.drawn).count(),
            modes.way
        );
    }
}
