//! Mechanisms next to special ones: an exact offset of 1e-9 or 1e-12, branches that touch to a high order, circles that
//! rounding opens. Each may be left open; none may be taken for its neighbour.

use crate::support;

use kutzbach::format::read_file;
use kutzbach::mobility::{Analysis, AnalysisOptions, PoseKind, SingularKind, Verdict, analyse};
use support::{analysis, folder};

fn near(name: &str) -> Analysis {
    let path = folder("tests/near").join(format!("{name}.urdf"));
    analysis(&read_file(&path, &[]).unwrap().mechanism)
}

fn finite(name: &str) -> Option<usize> {
    near(name).mobility.finite()
}

#[test]
fn lengths_off_by_little_are_rigid() {
    for name in [
        "three_bars_one_longer_1e-9",
        "three_cranks_one_longer_1e-12",
    ] {
        assert_eq!(finite(name), Some(0), "{name}");
    }
}

#[test]
fn an_isolated_contact_is_not_mobile() {
    let found = near("isolated_by_1e-12").mobility;
    assert_ne!(found.verdict, Verdict::Mobile);
    assert_eq!(found.bounds.0, Some(0));
}

#[test]
fn a_four_bar_that_hardly_moves_is_not_rigid() {
    let found = near("four_bar_pin_off_1e-12").mobility;
    assert_ne!(found.verdict, Verdict::Rigid);
    assert_eq!(found.bounds.1, Some(1));
    assert_ne!(found.pose, Some(PoseKind::Singular));
}

#[test]
fn a_pose_beside_a_crossing_is_not_one() {
    let path = folder("tests/near").join("assembled_beside_crossing.urdf");
    let mechanism = read_file(&path, &[]).unwrap().mechanism;
    let options = AnalysisOptions {
        configuration: Some("off".to_owned()),
        ..AnalysisOptions::default()
    };
    let found = analyse(&mechanism, &options).unwrap();
    assert!(found.assembly.closed);
    assert_ne!(found.home.unwrap().instantaneous, Some(2));
    assert_ne!(found.mobility.pose, Some(PoseKind::Singular));
    assert!([None, Some(1)].contains(&found.mobility.finite()));
}

#[test]
fn crossings_at_small_angles_are_not_contacts() {
    let found = near("crossing_at_1e-5");
    assert_eq!(found.mobility.kind, Some(SingularKind::Bifurcation));
    assert_eq!(found.branches.unwrap().len(), 2);
    for name in ["crossing_at_1e-10", "crossing_at_1e-12"] {
        let kind = near(name).mobility.kind;
        assert!(
            [None, Some(SingularKind::Bifurcation)].contains(&kind),
            "{name}: {kind:?}"
        );
    }
}

#[test]
fn branches_that_touch_to_a_high_order_are_two() {
    for name in [
        "fifth_order_contact",
        "fifth_order_contact_b",
        "undulation_contact",
        "touching_circles_6_decimals",
    ] {
        let found = near(name);
        let kind = found.mobility.kind;
        assert!(
            [None, Some(SingularKind::Tangential)].contains(&kind),
            "{name}: {kind:?}"
        );
        if let Some(branches) = &found.branches {
            assert_eq!(branches.len(), 2, "{name}");
        }
        assert!(found.mobility.bounds.1.unwrap() >= 1, "{name}");
    }
}
