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
            "Mobile: 1 finite freedom, as counting says within the displacement subgroup of each loop (trivial, D11).",
        ),
        (
            Some(MobilityClass::Trivial),
            0,
            "Mobile: 1 finite freedom, as counting says (trivial, D11).",
        ),
        (
            Some(MobilityClass::Exceptional),
            3,
            "Mobile: 1 finite freedom, explained by the displacement subgroups of its chains (exceptional, D11).",
        ),
        (
            Some(MobilityClass::Paradoxical),
            3,
            "Mobile: 1 finite freedom, owed to its special dimensions (paradoxical, D11).",
        ),
        (None, 3, "Mobile: 1 finite freedom."),
    ] {
        let mut report = mobile();
        report.mobility.class = class;
        report.home.redundant = Some(redundant);
        assert_eq!(super::sentence(&report), sentence);
    }
    let more = not_more(&mobile()).unwrap();
    assert!(more.starts_with("Why not more: the rank of the closure equations leaves 1 freedom"));
    assert!(more.contains("(D3)"));
    let less = not_less(&mobile()).unwrap();
    assert!(
        less.starts_with("Why not less: computed with a margin (numeric, D12): the loop stays")
    );
}

#[test]
fn singular_mobile_mechanisms_say_what_meets() {
    for (kind, at_pose, dimensions, sentence) in [
        (
            Some(SingularKind::Bifurcation),
            2,
            &[1, 1][..],
            "Mobile: 1 finite freedom; 2 at this pose: two branches cross here (bifurcation, D7).",
        ),
        (
            Some(SingularKind::Bifurcation),
            3,
            &[1, 1, 1],
            "Mobile: 1 finite freedom; 3 at this pose: three branches cross here (bifurcation, D7).",
        ),
        (
            Some(SingularKind::Tangential),
            2,
            &[1, 1],
            "Mobile: 1 finite freedom; 2 at this pose: two branches touch here, with one tangent (tangential, D7).",
        ),
        (
            Some(SingularKind::Cusp),
            2,
            &[1],
            "Mobile: 1 finite freedom; 2 at this pose: the motion stops here and turns back (cusp, D7).",
        ),
        (
            Some(SingularKind::Kinematotropic),
            3,
            &[2, 1, 1],
            "Mobile: 2 finite freedoms; 3 at this pose: branches of dimensions 2, 1 and 1 meet here (kinematotropic, D7).",
        ),
        (
            Some(SingularKind::PermanentlyShaky),
            2,
            &[1],
            "Mobile: 1 finite freedom; 2 at this pose: it gives way in more directions than it moves, here and all along \
             the motion (permanently shaky, D7).",
        ),
        (
            None,
            2,
            &[1],
            "Mobile: 1 finite freedom; 2 at this pose: not every one of these can be followed (singular pose, D6).",
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
        not_more(&report).unwrap(),
        "Why not more: the pose is singular (D6): its 2 freedoms exist together to first order only, and no branch through it has \
         more than 1 (D8)."
    );
    report.mobility.complex_dimension = Some(1);
    assert!(
        not_more(&report)
            .unwrap()
            .ends_with("the dimension is 1 too (D20).")
    );
    let report = at_singular(Some(SingularKind::PermanentlyShaky), 2, &[1]);
    assert_eq!(
        not_more(&report).unwrap(),
        "Why not more: the pose is singular (D6): 1 of its 2 freedoms lead nowhere, here and at every pose of the motion."
    );
    assert!(not_less(&report).unwrap().contains("(numeric, D12)"));
}

#[test]
fn rigid_by_rank_and_shaky() {
    let mut report = rigid();
    assert_eq!(
        super::sentence(&report),
        "Rigid, but shaky (D7): it gives way in 1 direction at this pose, which leads nowhere."
    );
    assert_eq!(
        not_more(&report).unwrap(),
        "Why not more: proved in exact arithmetic (exact, D12): a self-stress is definite on the instantaneous freedom."
    );
    assert_eq!(not_less(&report), None);
    report.home.instantaneous = Some(2);
    assert!(super::sentence(&report).contains("in 2 directions at this pose, none of which"));
    report.home.instantaneous = Some(0);
    assert_eq!(
        super::sentence(&report),
        "Rigid: nothing can move, not even for an instant (D3)."
    );
    report.home.instantaneous = None;
    assert_eq!(super::sentence(&report), "Rigid: nothing can move (D4).");
}

#[test]
fn undecided_says_what_is_open() {
    let mut report = undecided();
    assert_eq!(
        super::sentence(&report),
        "Undecided: between 0 and 1 finite freedom (D4); 1 at this pose."
    );
    assert!(
        not_more(&report)
            .unwrap()
            .starts_with("Not more than 1: the closure equations")
    );
    assert_eq!(
        not_less(&report).unwrap(),
        "Not less than 0: no motion has been proved (D12)."
    );
    report.home.pose = Some(PoseKind::Singular);
    report.home.instantaneous = Some(3);
    report.mobility.bounds = [Some(1), Some(2)];
    assert_eq!(
        super::sentence(&report),
        "Undecided: between 1 and 2 finite freedoms (D4); 3 at this pose, which is singular (D6)."
    );
    assert_eq!(
        not_more(&report).unwrap(),
        "Not more than 2: of the 3 freedoms at this pose not all can be followed, because the pose is singular (D6)."
    );
    assert!(
        not_less(&report)
            .unwrap()
            .starts_with("Not less than 1: so many remain")
    );
    report.mobility.bounds = [Some(2), Some(2)];
    assert!(super::sentence(&report).contains("2 finite freedoms, as far as is known (D4)"));
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
        within_digits: true,
        changes: Vec::new(),
    });
    report.home.as_written = Some(0);
    assert_eq!(
        super::nominal(&report).unwrap(),
        "Mobile within 3e-7 m of the numbers written (D13): they are probably rounded; taken literally 0 freedoms: rigid."
    );
    report.home.as_written = Some(1);
    assert!(
        super::nominal(&report)
            .unwrap()
            .ends_with("taken literally at most 1 freedom.")
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
            .ends_with("stand for has 1 finite freedom.")
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
        "Mobile: 6 finite freedoms, since there is no loop and every joint is free (D1)."
    );
    assert_eq!(not_more(&report), None);
    report.mobility.verdict = Verdict::Rigid;
    report.mobility.finite = Some(0);
    assert_eq!(
        super::sentence(&report),
        "Rigid: no joint has any freedom (D1)."
    );
}

#[test]
fn what_does_not_assemble_has_no_reasons() {
    let report = unassembled();
    assert!(
        super::sentence(&report)
            .starts_with("Does not assemble (D17): no closing found after 264 starts (nearest: 300 mm and 11.5° at loop `J3`)")
    );
    assert_eq!((not_more(&report), not_less(&report)), (None, None));
}

#[test]
fn every_number_cited_is_a_definition() {
    let known: Vec<&str> = crate::definitions::all().iter().map(|d| d.number).collect();
    let mut sentences = Vec::new();
    for kind in SingularKind::ALL {
        let report = at_singular(Some(*kind), 2, &[1, 1]);
        sentences.push(super::sentence(&report));
        sentences.extend(not_more(&report));
        sentences.extend(not_less(&report));
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
