use super::super::part_samples::{
    Posed, bennett, cylinders, five_bar, fresh, shaky_triangle, stretched,
};
use super::*;
use crate::RankNote;
use crate::engines::part_mobility;
use crate::families::bennett_row;
use kutzbach_closure::samples::{Written, flat_parallelogram, four_bar, general_four, sarrus};

fn found_with(posed: &Posed, change: impl Fn(&mut PartRank)) -> PartFinding {
    let mut rank = posed.rank();
    change(&mut rank);
    part_mobility(
        &posed.pose(),
        &mut fresh(),
        &posed.structure,
        posed.part(),
        &rank,
        Depth::Everything,
    )
    .unwrap()
}

fn found(posed: &Posed) -> PartFinding {
    found_with(posed, |_| ())
}

fn engines(found: &PartFinding) -> Vec<&'static str> {
    found.claims().iter().map(|c| c.engine.word()).collect()
}

/// What a finding has to satisfy whatever it says: no engine contradicts it.
fn check(name: &str, found: &PartFinding) {
    assert!(found.lower() <= found.upper(), "{name}");
    assert_eq!(found.contradictions(), [], "{name}");
    assert!(!found.certificate().is_empty());
    for branch in found.branches().into_iter().flatten() {
        assert!(!branch.poses.is_empty(), "{name}");
    }
}

#[test]
fn engines_are_asked_from_cheap_to_dear_until_one_knows() {
    use CertificateLevel::{Numeric, Subgroup};
    use MobilityClass::{Exceptional, Paradoxical, Trivial};
    let rank = vec!["rank"];
    let subgroup = vec!["rank", "subgroup"];
    let chart = vec!["rank", "subgroup", "chart"];
    let line = vec!["rank", "subgroup", "chart", "chart"];
    let second = vec!["rank", "subgroup", "chart", "second order"];
    let germ = vec!["rank", "subgroup", "chart", "germ"];
    for (name, mechanism, asked, finite, level, class, branches) in [
        ("rigid", general_four(), &rank, 0, Numeric, None, 0),
        (
            "four-bar",
            four_bar(),
            &subgroup,
            1,
            Subgroup,
            Some(Trivial),
            1,
        ),
        (
            "five-bar",
            five_bar(),
            &subgroup,
            2,
            Subgroup,
            Some(Trivial),
            1,
        ),
        (
            "sarrus",
            sarrus(),
            &subgroup,
            1,
            Subgroup,
            Some(Exceptional),
            1,
        ),
        (
            "cylinders",
            cylinders(),
            &subgroup,
            1,
            Subgroup,
            Some(Trivial),
            1,
        ),
        (
            "Bennett",
            bennett_row(1).unwrap(),
            &chart,
            1,
            Numeric,
            Some(Paradoxical),
            1,
        ),
        ("triangle", shaky_triangle(), &line, 0, Numeric, None, 0),
        ("stretched", stretched(), &second, 0, Numeric, None, 0),
        ("flat", flat_parallelogram(), &germ, 1, Numeric, None, 2),
    ] {
        let found = found(&Posed::new(mechanism));
        check(name, &found);
        let mut engines = engines(&found);
        // Asked of every part, it checks and decides nothing.
        engines.retain(|engine| *engine != "closed form");
        assert_eq!(&engines, asked, "{name}");
        assert_eq!((found.lower(), found.upper()), (finite, finite), "{name}");
        assert_eq!((found.level(), found.class()), (level, class), "{name}");
        assert_eq!(
            found.branches().map(<[PartBranch]>::len),
            Some(branches),
            "{name}"
        );
        assert_eq!((found.open(), found.nominal()), (None, None), "{name}");
        let pose = match asked.len() {
            4 => PoseKind::Singular,
            _ => PoseKind::Regular,
        };
        assert_eq!(found.pose(), Some(pose), "{name}");
    }
}

#[test]
fn certificates_say_what_they_rest_on() {
    let says = |mechanism, words: &str| {
        let found = found(&Posed::new(mechanism));
        assert!(
            found.certificate().contains(words),
            "{}",
            found.certificate()
        );
    };
    says(general_four(), "no velocity at all");
    says(cylinders(), "six equations are independent");
    says(bennett_row(1).unwrap(), "close at finite distances");
    says(shaky_triangle(), "one variable");
    says(stretched(), "self-stress");
    says(flat_parallelogram(), "2 branches");
}

#[test]
fn independent_equations_make_a_manifold_where_groups_are_not_asked() {
    // Decided only with the numbers taken literally, which is not plain enough for subgroups.
    let posed = Posed::new(cylinders());
    let found = found_with(&posed, |rank| {
        rank.as_written = rank.instantaneous;
        rank.note = Some(RankNote::StaysOpen { residual: 0.5 });
    });
    check("cylinders", &found);
    assert_eq!(engines(&found), ["rank", "subgroup", "rank"]);
    assert!(found.certificate().contains("implicit function theorem"));
    assert_eq!((found.lower(), found.upper(), found.open()), (1, 1, None));
    assert_eq!(
        (found.level(), found.class()),
        (CertificateLevel::Numeric, Some(MobilityClass::Trivial))
    );
}

#[test]
fn regular_branches_have_two_ways_where_they_are_curves() {
    for (mechanism, halves) in [(four_bar(), Some(2)), (five_bar(), None)] {
        let found = found(&Posed::new(mechanism));
        let branches = found.branches().unwrap();
        assert_eq!(branches[0].half_branches, halves);
        assert_eq!(branches[0].poses.len(), 3);
        assert_eq!(found.at_rest(), found.upper());
        assert_eq!(found.complex_dimension(), Some(found.upper()));
    }
}

#[test]
fn rounded_numbers_move_as_meant_and_say_how_far_they_miss() {
    let exact = found(&Posed::new(bennett_row(1).unwrap()));
    assert_eq!(exact.nominal(), None);
    let mut before = f64::INFINITY;
    for decimals in [6, 9, 12] {
        let found = found(&Posed::new(bennett(Written::Decimals(decimals))));
        check("rounded Bennett", &found);
        assert_eq!(
            (found.lower(), found.upper(), found.open()),
            (1, 1, None),
            "{decimals}"
        );
        assert_eq!(engines(&found), ["rank", "subgroup", "chart"]);
        // In metres, of sides of 3 m.
        let miss = found.nominal().unwrap();
        assert!(
            miss < 100.0 * 0.1f64.powi(decimals as i32),
            "{decimals}: {miss:e}"
        );
        assert!(miss < 0.1 * before, "{decimals}: {miss:e}");
        before = miss;
    }
    // In a plane nothing has to fit.
    let turned = found(&Posed::new(four_bar()));
    assert_eq!(turned.nominal(), None);
}

#[test]
fn an_open_rank_is_said_to_be_open() {
    let posed = Posed::new(cylinders());
    let found = found_with(&posed, |rank| {
        rank.instantaneous = None;
        rank.candidates = (1, 3);
        rank.note = Some(RankNote::StaysOpen { residual: 0.5 });
    });
    check("open", &found);
    assert_eq!((found.lower(), found.upper()), (0, 3));
    assert!(found.open().unwrap().contains("stay open by 5.0e-1"));
    assert_eq!((found.pose(), found.branches().is_none()), (None, true));
    assert_eq!(engines(&found), ["rank"]);
    // Of rounded numbers the reason is what was left out.
    let found = found_with(&posed, |rank| {
        rank.instantaneous = None;
        rank.candidates = (1, 3);
        rank.reading = Reading::WithinDigits(1e-4);
        rank.note = Some(RankNote::StaysOpen { residual: 0.5 });
    });
    assert!(found.open().unwrap().contains(FINER));
}

#[test]
fn a_rank_that_precision_allows_to_differ_is_open() {
    let posed = Posed::new(cylinders());
    let found = found_with(&posed, |rank| {
        rank.reading = Reading::WithinDigits(1e-4);
        rank.candidates = (1, 2);
        rank.as_written = Some(1);
    });
    check("differs", &found);
    assert_eq!((found.lower(), found.upper()), (0, 2));
    assert!(found.open().unwrap().contains("another rank"));
    // Where the numbers as written have the other one it is known which is meant.
    let found = found_with(&posed, |rank| {
        rank.reading = Reading::WithinDigits(1e-4);
        rank.candidates = (0, 1);
        rank.as_written = Some(0);
    });
    assert_eq!((found.lower(), found.upper(), found.open()), (1, 1, None));
}

#[test]
fn what_digits_left_out_hold_fast_is_not_called_rigid() {
    let posed = Posed::new(general_four());
    let found = found_with(&posed, |rank| rank.reading = Reading::Literal);
    check("held", &found);
    assert_eq!((found.lower(), found.upper()), (0, 3));
    assert!(found.open().unwrap().contains(FINER));
    assert_eq!(found.pose(), None);
}

#[test]
fn a_margin_too_thin_is_open_and_says_what_would_decide() {
    // A flat parallelogram stated so coarsely that one beside it could be meant as well.
    let posed = Posed::new(flat_parallelogram());
    let found = found_with(&posed, |rank| {
        rank.reading = Reading::WithinDigits(0.02);
        rank.as_written = Some(1);
    });
    check("thin", &found);
    assert_eq!((found.lower(), found.upper(), found.pose()), (0, 2, None));
    let why = found.open().unwrap();
    assert!(why.contains("too thin") && why.contains(FINER), "{why}");
    let chart = found.claims().last().unwrap();
    assert_eq!(
        (chart.engine, chart.finite),
        (EngineName::Chart, Bounds::at_most(2))
    );
    assert!(chart.text.contains("margin too thin"), "{}", chart.text);
    // Where both readings have the same rank, the numbers were chosen to be flat.
    let found = found_with(&posed, |rank| rank.reading = Reading::WithinDigits(0.02));
    check("literal", &found);
    assert_eq!((found.lower(), found.upper(), found.open()), (1, 1, None));
    assert!(found.claims()[2].text.contains("taken literally"));
}

#[test]
fn rank_is_evidence_with_its_figures() {
    let posed = Posed::new(four_bar());
    let found = found(&posed);
    let rank = &found.claims()[0];
    assert_eq!(
        (rank.engine, rank.scope, rank.finite),
        (EngineName::Rank, Scope::Pose, Bounds::at_most(1))
    );
    assert!(rank.text.starts_with("6 equations in 4 unknowns") && rank.text.ends_with("53 bits"));
    assert_eq!(found.claims()[2].scope, Scope::EveryPose);
}

#[test]
fn what_cannot_be_followed_far_is_not_called_regular() {
    // A rounded triangle in a line leaves over as much as any singular pose does: not followed at all.
    let posed = Posed::new(shaky_triangle());
    let rank = PartRank {
        reading: Reading::WithinDigits(1e-3),
        ..posed.rank()
    };
    let kernel = posed.kernel(&rank);
    let mut chart = ChartTest {
        followed: 0.0,
        outcome: ChartOutcome::Regular,
        radius: 1e-3,
        leftover: 1e-6,
        noise: 1e-3,
        directions: 2,
        bits: 53,
        literal: false,
    };
    confirm_on_the_way(&posed.pose(), posed.part(), &rank, &kernel, &mut chart).unwrap();
    assert_eq!(chart.outcome, ChartOutcome::Thin);
    // A way that leads on confirms it, as long as the noise would show a leftover there.
    let posed = Posed::new(bennett(Written::Decimals(15)));
    let rank = posed.rank();
    let kernel = posed.kernel(&rank);
    for (noise, outcome) in [(1e-9, ChartOutcome::Regular), (1e-3, ChartOutcome::Thin)] {
        let mut chart = ChartTest {
            outcome: ChartOutcome::Thin,
            noise,
            leftover: 0.0,
            ..chart.clone()
        };
        confirm_on_the_way(&posed.pose(), posed.part(), &rank, &kernel, &mut chart).unwrap();
        assert_eq!(chart.outcome, outcome, "{noise:e}");
    }
    // What was singular stays so.
    let singular = ChartOutcome::Singular { order: 2.0 };
    let mut chart = ChartTest {
        outcome: singular.clone(),
        ..chart
    };
    confirm_on_the_way(&posed.pose(), posed.part(), &rank, &kernel, &mut chart).unwrap();
    assert_eq!(chart.outcome, singular);
}
