use super::question::tangent_dimension;
use super::*;
use crate::claim::Answer;
use crate::depth::Depth;
use crate::engines::part_mobility;
use crate::part_samples::{Posed, fresh};
use crate::verdict::judge;
use crate::vocabulary::{PoseKind, SingularKind, Verdict};
use kutzbach_algebra::ModularSystem;
use kutzbach_closure::Structure;
use kutzbach_closure::samples::{CRANK_ROCKER, Written, add_ring, general_four, planar, ring};
use kutzbach_model::mechanism::MechanismBuilder;

fn numeric(posed: &Posed) -> PartFinding {
    part_mobility(
        &posed.pose(),
        &mut fresh(),
        &posed.structure,
        posed.part(),
        &posed.rank(),
        Depth::Everything,
    )
    .unwrap()
}

fn asked(posed: &Posed, mut found: PartFinding) -> PartFinding {
    let mut allowance = ExactAllowance::new(ExactBudget::default());
    ask_exact(
        &posed.pose(),
        posed.part(),
        &posed.rank(),
        &mut found,
        &mut allowance,
    );
    found
}

/// As if the numeric engines had given up, and left these bounds.
fn left_open(posed: &Posed, finite: Bounds) -> PartFinding {
    let rank = posed.rank();
    let mut found = PartFinding::new(rank.unknowns());
    found.take(Claim {
        instantaneous: rank.instantaneous.map_or(Bounds::ANY, Bounds::exactly),
        says: crate::claim::Says::Open("a thin margin".to_owned()),
        ..numeric_claim(finite)
    });
    found
}

fn numeric_claim(finite: Bounds) -> Claim {
    Claim::of(EngineName::Germ, Scope::Neighbourhood, finite, "")
}

fn last(found: &PartFinding) -> &Claim {
    found.claims().last().unwrap()
}

#[test]
fn what_is_proved_gets_the_exact_level() {
    for (name, pose) in [
        ("triangle_3r_rigid", PoseKind::Regular),
        ("collinear_3r_shaky", PoseKind::Singular),
    ] {
        let posed = Posed::known(name);
        let found = asked(&posed, numeric(&posed));
        assert_eq!(
            (found.level(), found.lower(), found.upper(), found.pose()),
            (CertificateLevel::Exact, 0, 0, Some(pose)),
            "{name}"
        );
        assert_eq!(
            (last(&found).engine, last(&found).finite),
            (EngineName::Exact, Bounds::exactly(0))
        );
    }
}

#[test]
fn what_others_leave_open_is_decided() {
    let posed = Posed::known("collinear_3r_shaky");
    let found = asked(&posed, left_open(&posed, Bounds::at_most(1)));
    assert_eq!((found.lower(), found.upper(), found.open()), (0, 0, None));
    assert_eq!(found.kind(), Some(SingularKind::Shaky));
    assert_eq!(found.branches().map(<[_]>::len), Some(0));
    // A motion that is known, and a bound that excludes more: decided, and no more than numeric.
    let posed = Posed::known("double_watt_cusp");
    let found = asked(&posed, left_open(&posed, Bounds::between(1, 2)));
    assert_eq!((found.lower(), found.upper(), found.open()), (1, 1, None));
    assert_eq!(found.level(), CertificateLevel::Numeric);
    // The bound alone.
    let found = asked(&posed, left_open(&posed, Bounds::at_most(2)));
    assert_eq!((found.lower(), found.upper()), (0, 1));
    assert!(found.open().is_some());
}

#[test]
fn a_contradiction_is_said_and_decides_nothing() {
    let posed = Posed::known("planar_4r_stretched_isolated");
    let mut wrong = PartFinding::new(posed.rank().unknowns());
    wrong.take(numeric_claim(Bounds::exactly(2)).decides(Answer::numeric("wrong")));
    let found = asked(&posed, wrong);
    let said: Vec<String> = found
        .contradictions()
        .iter()
        .map(ToString::to_string)
        .collect();
    assert!(
        said[0].contains("2 by engine `germ` and at most 1 by engine `exact`"),
        "{said:?}"
    );
    assert_eq!((found.lower(), found.upper(), found.pose()), (0, 2, None));
    let verdict = judge(&posed.mechanism, &posed.structure, &[found]);
    assert_eq!(verdict.verdict, Verdict::Undecided);
    assert_eq!(verdict.why.len(), 1);
    assert!(verdict.why[0].contains("please report"));
    // A rank that is too small, and a motion where there is none.
    let posed = Posed::known("triangle_3r_rigid");
    let mut found = numeric(&posed);
    let rank = Claim::of(EngineName::Rank, Scope::Pose, Bounds::ANY, "");
    found.take(Claim {
        instantaneous: Bounds::exactly(1),
        ..rank
    });
    let said = found.contradictions()[0].to_string();
    assert!(
        said.contains("the instantaneous freedom is 0 by engine `rank`"),
        "{said}"
    );
}

#[test]
fn complex_dimensions_are_compared() {
    let posed = Posed::known("planar_4r_stretched_isolated");
    let found = asked(&posed, numeric(&posed));
    assert_eq!((found.complex_dimension(), found.upper()), (Some(1), 0));
    assert_eq!(found.contradictions(), []);
    let mut wrong = numeric(&posed);
    wrong.amend(|claim| claim.complex = Bounds::exactly(0));
    let found = asked(&posed, wrong);
    assert!(found.contradictions().len() == 1 && found.complex_dimension().is_none());
    // The real answer rests on neither.
    assert_eq!((found.lower(), found.upper(), found.open()), (0, 0, None));
}

#[test]
fn only_exact_numbers_are_asked_about() {
    let decimals = Posed::new(ring(
        &planar(&CRANK_ROCKER[..3]),
        [0.0; 3],
        Written::Decimals(6),
    ));
    let found = asked(&decimals, numeric(&decimals));
    assert_eq!(found.level(), CertificateLevel::Numeric);
    assert!(last(&found).text.contains("rounded") && last(&found).finite == Bounds::ANY);
    let posed = Posed::new(general_four());
    let found = asked(&posed, numeric(&posed));
    assert_eq!(found.level(), CertificateLevel::Exact);
    // No budget, no question.
    let mut found = numeric(&posed);
    let evidence = found.claims().len();
    let mut none = ExactAllowance::new(ExactBudget::none());
    ask_exact(
        &posed.pose(),
        posed.part(),
        &posed.rank(),
        &mut found,
        &mut none,
    );
    assert_eq!(found.claims().len(), evidence);
}

#[test]
fn starting_values_state_no_digits() {
    let mut builder = MechanismBuilder::new("two");
    builder.link("ground");
    for name in ["p", "q"] {
        let places = planar(&CRANK_ROCKER);
        add_ring(
            &mut builder,
            name,
            "ground",
            &places,
            [0.0; 3],
            Written::Exactly,
        );
    }
    let at = |text: &str| vec![("p_a".to_owned(), vec![Number::decimal(text).unwrap()])];
    builder.configuration("held", at("0.12345"));
    builder.configuration("hundredths", at("0.12"));
    builder.configuration_with_starts("begun", Vec::new(), at("0.12345"));
    let mechanism = builder.build().unwrap();
    let parts = Structure::new(&mechanism).parts;
    let joint = mechanism.joint_named("p_a").unwrap().0;
    let exact = |name: &str, own: bool| {
        let configuration = mechanism.configuration(name);
        let part = parts.iter().find(|p| p.joints.contains(&joint) == own);
        numbers_are_exact(&mechanism, configuration, part.unwrap())
    };
    // Held, they are digits of the pose, but not of the other part.
    assert!(!exact("held", true) && exact("held", false));
    assert!(exact("hundredths", true) && exact("begun", true));
}

#[test]
fn a_part_is_asked_about_alone() {
    let mut builder = MechanismBuilder::new("two");
    builder.link("ground");
    for (name, joints) in [("p", 4), ("t", 3)] {
        add_ring(
            &mut builder,
            name,
            "ground",
            &planar(&CRANK_ROCKER[..joints]),
            [0.0; 3],
            Written::Exactly,
        );
    }
    let mechanism = builder.build().unwrap();
    let parts = Structure::new(&mechanism).parts;
    let size = |joints: &[usize]| {
        let options = SystemOptions {
            formulation: Formulation::Tree,
            joints: Some(joints.iter().map(|&j| JointId(j)).collect()),
            ..SystemOptions::default()
        };
        let system = polynomial_system(&mechanism, &options).unwrap();
        (system.variables.len(), system.equations.len())
    };
    let mut sizes: Vec<_> = parts.iter().map(|part| size(&part.joints)).collect();
    sizes.sort_unstable();
    assert_eq!(sizes, [(4, 4), (6, 5)]);
}

#[test]
fn tangents_are_counted_modulo_the_prime() {
    let system = |rows: &[[u64; 3]]| ModularSystem {
        prime: 101,
        variables: vec![0, 1, 2],
        equations: rows
            .iter()
            .map(|row| {
                let linear = row.iter().enumerate().filter(|(_, c)| **c != 0);
                let mut terms: Vec<(Vec<u32>, u64)> = linear
                    .map(|(i, &c)| ((0..3).map(|j| u32::from(i == j)).collect(), c))
                    .collect();
                terms.push((vec![1, 1, 0], 7));
                terms
            })
            .collect(),
    };
    let dimension =
        |rows: &[[u64; 3]]| tangent_dimension(&system(rows), &Budget::unlimited()).unwrap();
    assert_eq!(dimension(&[]), 3);
    assert_eq!(dimension(&[[0, 0, 0]]), 3);
    assert_eq!(dimension(&[[1, 2, 3], [2, 4, 6]]), 2);
    assert_eq!(dimension(&[[1, 2, 3], [2, 4, 7], [100, 99, 99]]), 1);
    assert_eq!(dimension(&[[0, 2, 3], [1, 0, 0], [0, 0, 50]]), 0);
}

#[test]
fn seconds_become_work() {
    assert!(ExactBudget::seconds(10.0).work() > 40 * ExactBudget::default().work());
    assert_eq!(ExactBudget::seconds(1e300).work(), u64::MAX);
}
