use super::super::chart::chart_test;
use super::super::part_samples::{Posed, fresh, shaky_triangle, stretched};
use super::*;
use kutzbach_closure::samples::flat_parallelogram;

/// What is found of a singular pose, its rank changed on the way.
fn found_with(posed: &Posed, lower: usize, change: impl Fn(&mut PartRank)) -> SingularFinding {
    let mut rank = posed.rank();
    let kernel = posed.kernel(&rank);
    let pose = posed.pose();
    let chart = chart_test(&pose, &mut fresh(), posed.part(), &rank, &kernel).unwrap();
    change(&mut rank);
    singular_finding(&pose, posed.part(), &rank, &kernel, &chart, lower).unwrap()
}

fn found(posed: &Posed) -> SingularFinding {
    found_with(posed, 0, |_| ())
}

/// What holds of every finding, whatever it says.
fn check(finding: &SingularFinding, freedom: usize) {
    let found = &finding.found;
    assert_eq!(found.pose, Some(PoseKind::Singular));
    assert_eq!(found.at_rest, freedom);
    assert!(found.lower <= found.upper && found.upper < freedom);
    // Either it is settled, and then all of it, or it says why not.
    assert_eq!(found.branches.is_none(), found.open.is_some());
    if let Some(branches) = &found.branches {
        let top = branches.iter().map(|b| b.dimension).max().unwrap_or(0);
        assert_eq!((found.lower, found.upper), (top, top));
    }
    for evidence in &finding.more_evidence {
        let (low, high) = evidence.bounds;
        assert!(low <= found.upper && high.is_none_or(|high| found.lower <= high));
    }
}

#[test]
fn one_direction_that_fails_is_no_motion() {
    for posed in [
        Posed::new(shaky_triangle()),
        Posed::known("rsc_contact3_shaky"),
        Posed::known("k33_on_conic_shaky"),
    ] {
        let finding = found(&posed);
        check(&finding, 1);
        let found = finding.found;
        assert_eq!((found.lower, found.upper), (0, 0));
        assert_eq!(found.kind, Some(SingularKind::Shaky));
        assert_eq!(found.complex_dimension, Some(0));
        assert!(found.branches.unwrap().is_empty());
        assert!(finding.more_evidence.is_empty(), "no series were needed");
    }
}

#[test]
fn a_definite_form_is_a_certificate() {
    let finding = found(&Posed::new(stretched()));
    check(&finding, 2);
    assert_eq!(finding.more_evidence.len(), 1);
    let evidence = &finding.more_evidence[0];
    assert_eq!(
        (evidence.engine, evidence.bounds),
        ("second order", (0, Some(0)))
    );
    assert!(finding.found.certificate.contains("self-stress"));
    assert_eq!(finding.found.kind, Some(SingularKind::Shaky));
    assert!(finding.found.branches.unwrap().is_empty());
    // x² + y² = 0 has two lines of complex solutions.
    assert_eq!(finding.found.complex_dimension, Some(1));
}

#[test]
fn kinds_of_known_poses() {
    for (name, freedom, dimensions, kind) in [
        (
            "planar_parallelogram_flat",
            2,
            vec![1, 1],
            SingularKind::Bifurcation,
        ),
        ("planar_kite_flat", 2, vec![1, 1], SingularKind::Bifurcation),
        ("csrr_cusp", 2, vec![1], SingularKind::Cusp),
        (
            "csrr_tacnode_outer",
            2,
            vec![1, 1],
            SingularKind::Tangential,
        ),
        (
            "rrsrr_kinematotropic",
            3,
            vec![2, 1],
            SingularKind::Kinematotropic,
        ),
        (
            "permanently_shaky_fourbar",
            2,
            vec![1],
            SingularKind::PermanentlyShaky,
        ),
    ] {
        let finding = found(&Posed::known(name));
        check(&finding, freedom);
        let found = finding.found;
        assert_eq!(found.kind, Some(kind), "{name}");
        let branches = found.branches.unwrap();
        let mut found_dimensions: Vec<usize> = branches.iter().map(|b| b.dimension).collect();
        found_dimensions.sort_unstable_by(|a, b| b.cmp(a));
        let mut expected = dimensions;
        expected.sort_unstable_by(|a, b| b.cmp(a));
        assert_eq!(found_dimensions, expected, "{name}");
        let germ = finding.more_evidence.last().unwrap();
        assert_eq!(
            (germ.engine, germ.bounds),
            ("germ", (0, Some(found.upper))),
            "{name}"
        );
        assert!(!germ.text.contains("not taken"), "{name}: {}", germ.text);
    }
}

#[test]
fn what_the_noise_drowns_stays_open_with_valid_bounds() {
    let flat = Posed::new(flat_parallelogram());
    for lower in [0, 1] {
        // A mechanism stated so coarsely that nothing of its series is above the noise.
        let finding = found_with(&flat, lower, |rank| rank.stated = 10.0);
        check(&finding, 2);
        let found = finding.found;
        assert_eq!((found.lower, found.upper), (lower, 1));
        assert!(found.open.unwrap().contains("higher order"));
        assert_eq!(found.kind, None);
    }
}

#[test]
fn too_many_series_stay_open_with_valid_bounds() {
    let flat = Posed::new(flat_parallelogram());
    // A rank that is not decided has no series at all.
    let finding = found_with(&flat, 1, |rank| rank.instantaneous = None);
    check(&finding, 2);
    assert_eq!((finding.found.lower, finding.found.upper), (1, 1));
    assert!(finding.found.open.unwrap().contains("too many"));
    assert!(finding.more_evidence.is_empty());
}

#[test]
fn the_text_of_a_search_has_its_figures() {
    let finding = found(&Posed::new(flat_parallelogram()));
    let text = &finding.more_evidence[0].text;
    for part in [
        "1 equation of order 2 in 2 variables to degree 4",
        "a branch of dimension 1, a branch of dimension 1",
        "seed 1",
        "complex dimension 1, Hilbert function [1, 2, 2, 2, 2]",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}
