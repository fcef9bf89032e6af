//! Singular poses that look like others: nodes far smaller than a search sees at first, branches that touch to a high order, poses
//! that look rigid and are not.
//!
//! All of their answers are proven. None may be contradicted; to leave one open is no error.

use crate::support;

use serde_json::Value;
use support::folder;

#[test]
fn no_known_fact_is_contradicted() {
    let run = crate::support::program()
        .args(["check", "--format", "json", "tests/zoo2"])
        .current_dir(folder(""))
        .output()
        .unwrap();
    let told: Value = serde_json::from_slice(&run.stdout).unwrap();
    let count = |what: &str| told[what].as_u64().unwrap();
    for what in ["without_expectation", "unreadable"] {
        assert_eq!(told[what].as_array().unwrap().len(), 0, "{what}");
    }
    println!(
        "{} facts found, {} left open",
        count("right"),
        count("open")
    );
    assert_eq!(count("wrong"), 0, "{told:#}");
    assert!(count("right") > count("open"), "{told:#}");
}

/// Germs in the plane whose branches show at high order, at a billionth, or not at all.
#[test]
fn plane_germs_of_exact_numbers_are_decided() {
    use kutzbach::mobility::SingularKind::{Bifurcation, Cusp, Shaky, Tangential};
    for (name, finite, kind) in [
        ("a6_cusp", 1, Some(Cusp)),
        ("a7_tacnode", 1, Some(Tangential)),
        ("isolated_1e-6", 0, Some(Shaky)),
        ("puiseux_3_7", 1, None),
        ("x8_minus_y8", 1, Some(Bifurcation)),
        ("unfolded_cusp_1e-2", 1, None),
    ] {
        let file = folder(&format!("tests/zoo2/{name}.urdf"));
        let mechanism = kutzbach::format::read_file(file, &[]).unwrap().mechanism;
        let analysis = support::analysis(&mechanism);
        let found = &analysis.mobility;
        assert_eq!(found.finite(), Some(finite), "{name}: {:?}", found.why);
        assert!(
            kind.is_none() || found.kind == kind,
            "{name}: {:?}",
            found.kind
        );
        let mut claims = analysis.claims();
        let polygon = kutzbach::mobility::EngineName::NewtonPolygon;
        assert!(claims.any(|(_, claim)| claim.engine == polygon), "{name}");
    }
}

/// One quadratic form of full rank in ten and eighteen variables: one branch, by Morse's lemma.
#[test]
fn quadratic_cones_of_many_variables_are_one_branch() {
    for (name, finite) in [("flat_vertex_12", 9), ("folded_polygon_10_10", 17)] {
        let file = folder(&format!("tests/zoo2/{name}.urdf"));
        let mechanism = kutzbach::format::read_file(file, &[]).unwrap().mechanism;
        let analysis = support::analysis(&mechanism);
        assert_eq!(analysis.mobility.finite(), Some(finite), "{name}");
        let [branch] = &analysis.branches.unwrap()[..] else {
            panic!("{name}: one branch")
        };
        assert_eq!(branch.dimension, finite, "{name}");
    }
}

/// Parts with loops that stand still by themselves, on whose branches the equations vanish to second order.
#[test]
fn loops_at_rest_are_fixed() {
    use kutzbach::mobility::SingularKind::PermanentlyShaky;
    for (name, finite, instantaneous) in [
        ("stretched_rod_spins_a", 1, 3),
        ("stretched_rod_spins_b", 1, 3),
        ("stretched_rod_spins_c", 1, 4),
        ("hexagon_with_triangle_a", 3, 4),
        ("spherical_spin_a", 1, 3),
    ] {
        let file = folder(&format!("tests/zoo2/{name}.urdf"));
        let mechanism = kutzbach::format::read_file(file, &[]).unwrap().mechanism;
        let analysis = support::analysis(&mechanism);
        assert_eq!(analysis.mobility.finite(), Some(finite), "{name}");
        assert_eq!(analysis.mobility.kind, Some(PermanentlyShaky), "{name}");
        let [branch] = &analysis.branches.unwrap()[..] else {
            panic!("{name}: one branch")
        };
        assert_eq!(branch.dimension, finite, "{name}");
        assert_eq!(branch.instantaneous, Some(instantaneous), "{name}");
    }
}

/// Quadratic terms that vanish on a few linear spaces, with a common basis or without.
#[test]
fn modes_that_exclude_one_another_are_all_found() {
    for (name, expected) in [
        ("modes_3_2_1", &[3, 2, 1][..]),
        ("modes_six_axes", &[1; 6]),
        ("flat_miura_3x5", &[4, 1, 1, 1]),
    ] {
        let file = folder(&format!("tests/zoo2/{name}.urdf"));
        let mechanism = kutzbach::format::read_file(file, &[]).unwrap().mechanism;
        let analysis = support::analysis(&mechanism);
        let branches = analysis.branches.unwrap();
        let dimensions: Vec<usize> = branches.iter().map(|b| b.dimension).collect();
        assert_eq!(dimensions, expected, "{name}");
    }
}

/// Surfaces with an isolated critical point: one branch, however many pieces meet there.
#[test]
fn normal_surfaces_are_one_branch() {
    for name in ["d4_surface", "two_bowls"] {
        let file = folder(&format!("tests/zoo2/{name}.urdf"));
        let mechanism = kutzbach::format::read_file(file, &[]).unwrap().mechanism;
        let analysis = support::analysis(&mechanism);
        assert_eq!(analysis.mobility.finite(), Some(2), "{name}");
        assert_eq!(analysis.branches.unwrap().len(), 1, "{name}");
    }
}

#[test]
fn where_only_idle_links_move_all_other_joints_are_locked() {
    for (name, locked) in [
        ("crank_slider_tangent", &["j2", "j3"][..]),
        ("spherical_7r_doubled", &["j0", "j3", "j4", "j5", "j6"]),
    ] {
        let file = folder(&format!("tests/zoo2/{name}.urdf"));
        let mechanism = kutzbach::format::read_file(file, &[]).unwrap().mechanism;
        let analysis = support::analysis(&mechanism);
        let [branch] = &analysis.branches.unwrap()[..] else {
            panic!("{name}: one branch")
        };
        let joints = mechanism.joints().iter().zip(&branch.roles);
        let mut found: Vec<&str> = joints
            .filter(|(_, role)| role.locked == Some(true))
            .map(|(joint, _)| joint.name.as_str())
            .collect();
        found.sort_unstable();
        assert_eq!(found, locked, "{name}");
    }
}
