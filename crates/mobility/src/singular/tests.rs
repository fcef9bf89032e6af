use super::super::chart::chart_test;
use super::super::part_samples::{Posed, fresh, shaky_triangle, stretched};
use super::super::vocabulary::PoseKind;
use super::*;
use crate::depth::Depth;
use crate::engines::ask_after_chart;
use crate::pose_rank::{PartRank, Reading};
use kutzbach_closure::samples::flat_parallelogram;

/// What is found of a singular pose that so many freedoms are known of, its rank changed on the way.
fn found_with(posed: &Posed, lower: usize, change: impl Fn(&mut PartRank)) -> PartFinding {
    let mut rank = posed.rank();
    let kernel = posed.kernel(&rank);
    let pose = posed.pose();
    let chart = chart_test(&pose, &mut fresh(), posed.part(), &rank, &kernel).unwrap();
    change(&mut rank);
    let freedom = kernel.basis.nullity;
    let mut found = PartFinding::new(rank.unknowns());
    found.take(Claim {
        pose: Some(PoseKind::Singular),
        instantaneous: Bounds::exactly(freedom),
        ..Claim::of(
            EngineName::Chart,
            Scope::Neighbourhood,
            Bounds::between(lower, freedom - 1),
            "",
        )
    });
    let question = Question::new(
        &pose,
        &posed.structure,
        (posed.part(), &rank),
        Depth::Verdict,
    );
    question.freedom.set(Some(freedom));
    assert!(question.chart.set(chart).is_ok() && question.kernel.set(Some(kernel)).is_ok());
    let mut more = fresh();
    let means = &mut Means {
        more: &mut more,
        whole: None,
    };
    ask_after_chart(&question, means, &mut found).unwrap();
    found
}

fn found(posed: &Posed) -> PartFinding {
    found_with(posed, 0, |_| ())
}

/// What holds of every finding, whatever it says.
fn check(found: &PartFinding, freedom: usize) {
    assert_eq!(found.pose(), Some(PoseKind::Singular));
    assert_eq!(found.at_rest(), freedom);
    assert!(found.lower() <= found.upper() && found.upper() < freedom);
    // Either it is settled, and then all of it, or it says why not.
    assert_eq!(found.branches().is_none(), found.open().is_some());
    assert_eq!(found.contradictions(), []);
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
        let found = finding;
        assert_eq!((found.lower(), found.upper()), (0, 0));
        assert_eq!(found.kind(), Some(SingularKind::Shaky));
        assert_eq!(found.complex_dimension(), Some(0));
        assert!(found.branches().unwrap().is_empty());
        assert_eq!(found.claims().len(), 2, "no series were needed");
    }
}

#[test]
fn a_definite_form_is_a_certificate() {
    let finding = found(&Posed::new(stretched()));
    check(&finding, 2);
    assert_eq!(finding.claims().len(), 2);
    let claim = &finding.claims()[1];
    assert_eq!(
        (claim.engine, claim.finite),
        (EngineName::SecondOrder, Bounds::exactly(0))
    );
    assert!(finding.certificate().contains("self-stress"));
    assert_eq!(finding.kind(), Some(SingularKind::Shaky));
    assert!(finding.branches().unwrap().is_empty());
    // x² + y² = 0 has two lines of complex solutions.
    assert_eq!(finding.complex_dimension(), Some(1));
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
        let found = finding;
        assert_eq!(found.kind(), Some(kind), "{name}");
        let branches = found.branches().unwrap();
        let mut found_dimensions: Vec<usize> = branches.iter().map(|b| b.dimension).collect();
        found_dimensions.sort_unstable_by(|a, b| b.cmp(a));
        let mut expected = dimensions;
        expected.sort_unstable_by(|a, b| b.cmp(a));
        assert_eq!(found_dimensions, expected, "{name}");
        let germ = found.claims().last().unwrap();
        assert_eq!(
            (germ.engine, germ.finite),
            (EngineName::Germ, Bounds::exactly(found.upper())),
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
        let finding = found_with(&flat, lower, |rank| {
            rank.reading = Reading::WithinDigits(10.0)
        });
        check(&finding, 2);
        let found = finding;
        assert_eq!((found.lower(), found.upper()), (lower, 1));
        assert!(found.open().unwrap().contains("higher order"));
        assert_eq!(found.kind(), None);
    }
}

#[test]
fn too_many_series_stay_open_with_valid_bounds() {
    let flat = Posed::new(flat_parallelogram());
    // A rank that is not decided has no series at all.
    let finding = found_with(&flat, 1, |rank| rank.instantaneous = None);
    check(&finding, 2);
    assert_eq!((finding.lower(), finding.upper()), (1, 1));
    assert!(finding.open().unwrap().contains("is not settled"));
}

#[test]
fn the_text_of_a_search_has_its_figures() {
    let finding = found(&Posed::new(flat_parallelogram()));
    let text = &finding.claims()[1].text;
    for part in [
        "1 equation of order 2 in 2 variables to degree 4",
        "a branch of dimension 1, a branch of dimension 1",
        "seed 1",
        "complex dimension 1, Hilbert function [1, 2, 2, 2, 2]",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}
