#![allow(clippy::unwrap_used)]

use super::*;
use crate::Nominal;
use crate::samples::{mobile, rigid, unassembled, undecided};

/// A mobile mechanism at a singular pose with branches of these dimensions.
fn at_singular(kind: Option<SingularKind>, at_pose: usize, dimensions: &[usize]) -> Report {
    let mut report = mobile();
    let branch = report.branches.as_ref().unwrap()[0].clone();
    report.branches = Some(
        dimensions
            .iter()
            .map(|&dimension| Branch {
                dimension,
                ..branch.clone()
            })
            .collect(),
    );
    let finite = dimensions.iter().copied().max();
    report.home.pose = Some(PoseKind::Singular);
    report.home.kind = kind;
    report.home.instantaneous = Some(at_pose);
    report.mobility.finite = finite;
    report.mobility.bounds = [finite, finite];
    report.mobility.class = None;
    report.mobility.complex_dimension = None;
    report
}

#[test]
fn regular_mobile_mechanisms_name_their_class() {
    for (class, redundant, sentence) in [
        (
            Some(MobilityClass::Trivial),
            3,
            "Mobile: 1 degree of freedom, as counting within the displacement subgroup of each loop predicts (trivial, D11).",
        ),
        (
            Some(MobilityClass::Trivial),
            0,
            "Mobile: 1 degree of freedom, as the count predicts (trivial, D11).",
        ),
        (
            Some(MobilityClass::Exceptional),
            3,
            "Mobile: 1 degree of freedom, explained by the displacement subgroups of its chains (exceptional, D11).",
        ),
        (
            Some(MobilityClass::Paradoxical),
            3,
            "Mobile: 1 degree of freedom, due to its dimensions; no displacement group explains it (paradoxical, D11).",
        ),
        (
            None,
            3,
            "Mobile: 1 degree of freedom, for a reason that displacement groups leave open.",
        ),
    ] {
        let mut report = mobile();
        report.mobility.class = class;
        report.home.redundant = Some(redundant);
        assert_eq!(super::sentence(&report), sentence);
    }
    let more = not_more(&mobile(), true).unwrap();
    assert!(more.starts_with("Why not more: rank 3 of 4 variables"));
    assert!(more.contains("(D3)"));
    let less = not_less(&mobile(), true).unwrap();
    assert!(less.starts_with(
        "Why not less: computed numerically, with a margin (numeric, D12): the loop stays"
    ));
}

#[test]
fn singular_mobile_mechanisms_say_what_meets() {
    for (kind, at_pose, dimensions, sentence) in [
        (
            Some(SingularKind::Bifurcation),
            2,
            &[1, 1][..],
            "Mobile: 1 degree of freedom; 2 at this pose: two branches cross here (bifurcation, D7).",
        ),
        (
            Some(SingularKind::Bifurcation),
            3,
            &[1, 1, 1],
            "Mobile: 1 degree of freedom; 3 at this pose: three branches cross here (bifurcation, D7).",
        ),
        (
            Some(SingularKind::Tangential),
            2,
            &[1, 1],
            "Mobile: 1 degree of freedom; 2 at this pose: two branches touch here, with one tangent (tangential, D7).",
        ),
        (
            Some(SingularKind::Cusp),
            2,
            &[1],
            "Mobile: 1 degree of freedom; 2 at this pose: the motion stops here and turns back (cusp, D7).",
        ),
        (
            Some(SingularKind::Kinematotropic),
            3,
            &[2, 1, 1],
            "Mobile: 2 degrees of freedom; 3 at this pose: branches of dimensions 2, 1 and 1 meet here (kinematotropic, D7).",
        ),
        (
            Some(SingularKind::PermanentlyShaky),
            2,
            &[1],
            "Mobile: 1 degree of freedom; 2 at this pose: infinitesimally more mobile than it moves, here and along the \
             whole motion (permanently shaky, D7).",
        ),
        (
            None,
            2,
            &[1],
            "Mobile: 1 degree of freedom; 2 at this pose: not every infinitesimal motion can be continued (singular pose, D6).",
        ),
    ] {
        let report = at_singular(kind, at_pose, dimensions);
        assert_eq!(super::sentence(&report), sentence);
    }
    let mut report = at_singular(Some(SingularKind::Kinematotropic), 3, &[2, 1]);
    report.branches = None;
    assert!(super::sentence(&report).contains("branches of different dimensions meet here"));
    report.home.kind = Some(SingularKind::Bifurcation);
    assert!(super::sentence(&report).contains(": branches cross here"));
}

#[test]
fn singular_poses_say_why_not_more() {
    let mut report = at_singular(Some(SingularKind::Bifurcation), 2, &[1, 1]);
    assert_eq!(
        not_more(&report, true).unwrap(),
        "Why not more: 2 independent velocities are possible at this singular pose, but no finite motion through it has more \
         than 1 (D8)."
    );
    report.mobility.complex_dimension = Some(1);
    assert!(
        not_more(&report, true)
            .unwrap()
            .ends_with("the dimension is 1 too (D20).")
    );
    let report = at_singular(Some(SingularKind::PermanentlyShaky), 2, &[1]);
    assert_eq!(
        not_more(&report, true).unwrap(),
        "Why not more: 1 of the 2 independent velocities cannot be continued, here and at every pose of the motion (D6)."
    );
    assert!(not_less(&report, true).unwrap().contains("(numeric, D12)"));
}

#[test]
fn rigid_by_rank_and_shaky() {
    let mut report = rigid();
    assert_eq!(
        super::sentence(&report),
        "Rigid, but infinitesimally mobile (shaky, D7): one infinitesimal motion, which cannot be continued."
    );
    assert_eq!(
        not_more(&report, true).unwrap(),
        "Why not more: proved by exact algebra (exact, D12): a self-stress is definite on the instantaneous freedom."
    );
    assert_eq!(not_less(&report, true), None);
    report.home.instantaneous = Some(2);
    assert!(
        super::sentence(&report).contains("2 independent infinitesimal motions, none of which")
    );
    report.home.instantaneous = Some(0);
    assert_eq!(
        super::sentence(&report),
        "Rigid: 0 degrees of freedom, and no infinitesimal motion (D3)."
    );
    report.home.instantaneous = None;
    assert_eq!(
        super::sentence(&report),
        "Rigid: 0 degrees of freedom (D4)."
    );
}

#[test]
fn undecided_says_what_is_open() {
    let mut report = undecided();
    assert_eq!(
        super::sentence(&report),
        "Undecided: 0 to 1 degrees of freedom (D4); 1 at this pose."
    );
    assert!(
        not_more(&report, true)
            .unwrap()
            .starts_with("Not more than 1: the rank at a pose")
    );
    assert_eq!(
        not_less(&report, true).unwrap(),
        "Not less than 0: no motion has been proved (D12)."
    );
    report.home.pose = Some(PoseKind::Singular);
    report.home.instantaneous = Some(3);
    report.mobility.bounds = [Some(1), Some(2)];
    assert_eq!(
        super::sentence(&report),
        "Undecided: 1 to 2 degrees of freedom (D4); 3 at this pose, which is singular (D6)."
    );
    assert_eq!(
        not_more(&report, true).unwrap(),
        "Not more than 2: the pose is singular, and no finite motion combines its 3 independent velocities (D6)."
    );
    assert!(
        not_less(&report, true)
            .unwrap()
            .starts_with("Not less than 1: joints outside loops")
    );
    report.mobility.bounds = [Some(2), Some(2)];
    assert!(super::sentence(&report).contains("2 degrees of freedom, as far as is known (D4)"));
    let page = crate::text::render(&undecided(), crate::text::Layout::default());
    assert!(
        page.contains("Open: the rank bounds the finite freedom from above only."),
        "{page}"
    );
}

#[test]
fn rounded_numbers_are_told() {
    let mut report = mobile();
    report.mobility.nominal = Some(Nominal {
        finite: 1,
        tolerance: 3e-7,
        distance: None,
        known_to: None,
        within_digits: true,
        noise: false,
        changes: Vec::new(),
        relations: Vec::new(),
    });
    report.home.as_written = Some(0);
    assert_eq!(
        super::nominal(&report).unwrap(),
        "As written its loops miss by up to 300 nm along the motion (D13): the numbers are probably rounded; taken literally they leave it rigid."
    );
    report.home.as_written = Some(1);
    assert!(
        super::nominal(&report)
            .unwrap()
            .ends_with("taken literally they leave at most 1 degree of freedom.")
    );
    report.home.as_written = None;
    assert!(
        super::nominal(&report)
            .unwrap()
            .ends_with("probably rounded.")
    );
    report.mobility.finite = Some(0);
    assert!(
        super::nominal(&report)
            .unwrap()
            .ends_with("stand for has 1 degree of freedom.")
    );
    report.mobility.nominal = None;
    assert_eq!(super::nominal(&report), None);
}

#[test]
fn arms_without_loops_count_their_joints() {
    let mut report = mobile();
    report.size.loops = 0;
    report.mobility.finite = Some(6);
    report.home.instantaneous = Some(6);
    report.mobility.class = Some(MobilityClass::Trivial);
    assert_eq!(
        super::sentence(&report),
        "Mobile: 6 degrees of freedom, since there is no loop and every joint is free (D1)."
    );
    assert_eq!(not_more(&report, true), None);
    report.mobility.verdict = Verdict::Rigid;
    report.mobility.finite = Some(0);
    assert_eq!(super::sentence(&report), "Rigid: no joint can move (D1).");
}

#[test]
fn what_does_not_assemble_has_no_reasons() {
    let report = unassembled();
    assert!(
        super::sentence(&report)
            .starts_with("No closing found (D17) after 264 starts (nearest: 300 mm and 11.5° at loop `J3`): that there is none is not proved.")
    );
    // With a proof it is a theorem.
    let mut report = report;
    report.assembly.proof = Some("no joint of the loop through `J3` may move".to_owned());
    assert!(
        super::sentence(&report)
            .starts_with("Does not assemble (D17): no pose closes it, since no joint")
    );
    assert_eq!(
        (not_more(&report, true), not_less(&report, true)),
        (None, None)
    );
}

#[test]
fn every_number_cited_is_a_definition() {
    let known: Vec<&str> = crate::definitions::all().iter().map(|d| d.number).collect();
    let mut sentences = Vec::new();
    for kind in SingularKind::ALL {
        let report = at_singular(Some(*kind), 2, &[1, 1]);
        sentences.push(super::sentence(&report));
        sentences.extend(not_more(&report, true));
        sentences.extend(not_less(&report, true));
    }
    for text in sentences {
        for cited in text.split(|c: char| !c.is_alphanumeric()) {
            let number = cited.strip_prefix('D').filter(|n| n.parse::<u8>().is_ok());
            assert!(
                number.is_none() || known.contains(&cited),
                "{cited} in {text}"
            );
        }
    }
}
