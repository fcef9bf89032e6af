//! What a physics engine says about the predictions for the reference mechanisms.
//!
//! Ways are kept short and ladders end as soon as they decide: the coarsest settings that do. Nothing is ever contradicted
//! that is true, everything regular is confirmed, and what is spoiled is not.

use crate::support;

use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{CertificateLevel, PoseKind, Verdict};
use kutzbach::simulate::verification::{
    Moment, Observer, Outcome, Passage, Unobserved, Verification, VerificationOptions, verify,
};
use std::ops::ControlFlow;
use support::{analysis, assert_none, folder, in_parallel, own_mechanisms, zoo, zoo_mechanism};

/// Predictions that simulation leaves open, and why.
const LEFT_OPEN: [(&str, &str); 3] = [
    (
        "bennett_perturbed_1e-6",
        "rigid because its loop misses by a millionth, which no joint of a simulation feels",
    ),
    (
        "double_watt_tangential",
        "branches part so slowly that velocities after a blow do not settle on one",
    ),
    (
        "upu3_snu_home_equal",
        "of its branches one bends so sharply that the finest rung is not fine enough",
    ),
];

/// Mechanisms of which a rod spins about the line through its balls and nothing else moves.
const UNSEEN: [&str; 1] = ["ss_pair"];

fn short() -> VerificationOptions {
    VerificationOptions {
        longest: 2.0,
        ..VerificationOptions::default()
    }
}

fn verification(mechanism: &Mechanism, options: &VerificationOptions) -> Verification {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    verify(
        mechanism,
        &geometry,
        &analysis(mechanism),
        options,
        &mut Unobserved,
    )
    .unwrap()
}

fn own(name: &str) -> Mechanism {
    let path = folder("mechanisms").join(format!("{name}.urdf"));
    kutzbach::format::read_file(path, &[]).unwrap().mechanism
}

#[test]
fn spoiled_loops_are_not_confirmed_although_they_turn() {
    for name in [
        "bennett_spoiled",
        "bricard_line_symmetric_spoiled",
        "waldron_six_bar_spoiled",
    ] {
        let options = VerificationOptions {
            ladder: vec![4, 8, 16],
            ..VerificationOptions::default()
        };
        let found = verification(&own(name), &options);
        assert_eq!(found.verdict, Verdict::Rigid, "{name}");
        assert_eq!(found.finding.outcome, Outcome::Inconclusive, "{name}");
        let pushing = found.pushing.unwrap();
        assert!(
            pushing.rungs.iter().all(|r| r.moved > 0.05),
            "{name}: {pushing:?}"
        );
    }
}

/// Breaks off after so many moments.
struct Impatient(usize);

impl Observer for Impatient {
    fn begin(&mut self, _: &Passage) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn moment(&mut self, _: &Moment<'_>) -> ControlFlow<()> {
        self.0 -= 1;
        if self.0 == 0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

#[test]
fn what_is_broken_off_is_inconclusive_and_says_so() {
    for mechanism in [own("bennett"), zoo_mechanism("general_6r_rigid")] {
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let found = verify(
            &mechanism,
            &geometry,
            &analysis(&mechanism),
            &short(),
            &mut Impatient(5),
        )
        .unwrap();
        assert!(found.stopped);
        assert_eq!(found.finding.outcome, Outcome::Inconclusive);
    }
}

#[test]
fn the_same_mechanism_gives_the_same_findings() {
    let mechanism = own("oldham");
    let say = || serde_json::to_string(&verification(&mechanism, &short())).unwrap();
    assert_eq!(say(), say());
}

#[test]
fn an_unknown_branch_is_an_error() {
    let mechanism = own("bennett");
    let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
    let options = VerificationOptions {
        branch: Some("Z".to_owned()),
        ..short()
    };
    let error = verify(
        &mechanism,
        &geometry,
        &analysis(&mechanism),
        &options,
        &mut Unobserved,
    )
    .unwrap_err();
    assert_eq!(
        error.to_string(),
        "there is no branch named `Z`; there are A"
    );
    let rigid = zoo_mechanism("general_6r_rigid");
    let geometry = Geometry::new(&rigid, None, &Arithmetic::double());
    let error = verify(
        &rigid,
        &geometry,
        &analysis(&rigid),
        &options,
        &mut Unobserved,
    );
    assert!(error.unwrap_err().to_string().ends_with("there are none"));
}

/// What misses by a part in 10¹² moves in every simulation; its loops do not close on the way.
#[test]
fn loops_that_miss_by_less_than_a_simulation_feels_contradict_nothing() {
    for name in ["isolated_by_1e-12", "three_cranks_one_longer_1e-12"] {
        let file = folder("tests/near").join(format!("{name}.urdf"));
        let mechanism = kutzbach::format::read_file(file, &[]).unwrap().mechanism;
        let mut analysis = analysis(&mechanism);
        assert_eq!(analysis.mobility.verdict, Verdict::Rigid, "{name}");
        // As if nothing had been proved.
        analysis.mobility.level = CertificateLevel::Numeric;
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let found = verify(&mechanism, &geometry, &analysis, &short(), &mut Unobserved).unwrap();
        assert_eq!(found.finding.outcome, Outcome::Inconclusive, "{name}");
        assert!(found.pushing.unwrap().rungs.last().unwrap().moved > 0.2);
    }
}

/// What moves is to be seen: a confirmed spin of a rod would confirm anything.
#[test]
fn the_spin_of_a_rod_between_balls_is_no_evidence() {
    let found = verification(&zoo_mechanism("ss_pair"), &short());
    assert_eq!(found.verdict, Verdict::Mobile);
    assert_eq!(found.finding.outcome, Outcome::Inconclusive);
    assert!(found.finding.why.contains("spin"), "{}", found.finding.why);
}

/// A loop whose closing joint follows another: another joint closes it in the simulation, and the coupling is held.
#[test]
fn a_coupled_joint_that_closes_a_loop_is_simulated() {
    const FILE: &str = r#"<robot name="coupled_loop">
      <link name="base"/><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
      <joint name="j1" type="continuous">
        <parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
      </joint>
      <joint name="j2" type="continuous">
        <parent link="a"/><child link="b"/><origin xyz="0 1 0"/><axis xyz="0 0 1"/>
      </joint>
      <joint name="j3" type="continuous">
        <parent link="b"/><child link="c"/><origin xyz="1 1 0"/><axis xyz="0 0 1"/>
      </joint>
      <joint name="j5" type="continuous">
        <parent link="base"/><child link="d"/><origin xyz="3 0 0"/><axis xyz="0 0 1"/>
      </joint>
      <loop name="j4" type="revolute">
        <predecessor link="c"><origin xyz="2 -1 0"/></predecessor>
        <successor link="d"><origin xyz="0 1 0"/></successor>
        <axis xyz="0 0 1"/>
        <mimic joint="j1" multiplier="-1"/>
      </loop>
    </robot>"#;
    let mechanism = kutzbach::format::read(FILE, "coupled_loop.urdf", &[])
        .unwrap()
        .mechanism;
    let found = verification(&mechanism, &short());
    assert_eq!(found.verdict, Verdict::Mobile);
    assert_eq!(
        found.finding.outcome,
        Outcome::Confirmed,
        "{}",
        found.finding.why
    );
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn every_prediction_for_the_reference_mechanisms_is_confirmed_or_listed() {
        let wrong = in_parallel(&support::sample(zoo(), 3), |(name, mechanism)| {
            let analysis = analysis(mechanism);
            let found = verification(mechanism, &short());
            let outcome = found.finding.outcome;
            let listed = LEFT_OPEN.iter().any(|(open, _)| *open == name);
            let regular = analysis.mobility.pose == Some(PoseKind::Regular);
            if UNSEEN.contains(&name.as_str()) {
                return match outcome {
                    Outcome::Inconclusive => Vec::new(),
                    _ => vec![format!("{name}: {outcome:?}, of a spin that nothing shows")],
                };
            }
            if listed && found.verdict == Verdict::Mobile && regular {
                return vec![format!("{name}: regular, and listed as left open")];
            }
            if outcome == Outcome::Confirmed || listed && outcome == Outcome::Inconclusive {
                return Vec::new();
            }
            vec![format!("{name}: {outcome:?}, {}", found.finding.why)]
        });
        assert_none(&wrong.concat());
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn families_of_overconstrained_mechanisms_are_confirmed() {
        const FAMILIES: [&str; 6] = [
            "bennett", "bricard_", "goldberg", "oldham", "delta", "wohlhart",
        ];
        let files: Vec<_> = own_mechanisms()
            .into_iter()
            .filter(|(name, _)| FAMILIES.iter().any(|family| name.starts_with(family)))
            .filter(|(name, _)| !name.ends_with("_spoiled") && !name.contains("octahedron"))
            .collect();
        assert!(files.len() > 15, "{}", files.len());
        let wrong = in_parallel(&files, |(name, mechanism)| {
            let finding = verification(mechanism, &short()).finding;
            if finding.outcome == Outcome::Confirmed {
                Vec::new()
            } else {
                vec![format!("{name}: {:?}, {}", finding.outcome, finding.why)]
            }
        });
        assert_none(&wrong.concat());
    }

    /// A wrong prediction: the genuine loop's motion claimed of the spoiled loop's links.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn the_motion_of_a_genuine_loop_is_contradicted_by_a_spoiled_one() {
        let genuine = own("bennett");
        let geometry =
            |mechanism: &Mechanism| Geometry::new(mechanism, None, &Arithmetic::double());
        let mut spoiled = geometry(&genuine);
        // A link a thousandth too long.
        let closing = genuine.joints().iter().position(|j| j.closes_loop).unwrap();
        let side = &mut spoiled.sides[closing][1].translation;
        for x in side.iter_mut() {
            *x *= 1.001;
        }
        let moved = spoiled.sides[closing][1].translation
            != geometry(&genuine).sides[closing][1].translation;
        assert!(moved, "the closing joint's frame is at its link's origin");
        let claimed = analysis(&genuine);
        let found = verify(&genuine, &spoiled, &claimed, &short(), &mut Unobserved).unwrap();
        let branch = &found.branches[0];
        assert_ne!(branch.finding.outcome, Outcome::Confirmed, "{branch:?}");
        for ladder in &branch.ladders {
            let last = ladder.rungs.last().unwrap();
            assert!(last.closure_error > 1e-4, "{ladder:?}");
        }
        assert_eq!(found.finding.outcome, Outcome::Contradicted, "{branch:?}");
    }
}
