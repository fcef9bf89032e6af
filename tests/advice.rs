//! Repair advice, followed: the joint it names is given the kind it names, the file is written and read again, and the new
//! mechanism moves as before with as many redundant constraints as were promised.

use crate::support;

use kutzbach::mechanism::{Direction, JointKind, Mechanism};
use kutzbach::mobility::{Advice, Analysis, AnalysisOptions, analyse};
use kutzbach::number::Number;
use support::rewrite::Draft;
use support::{assert_none, in_parallel, zoo, zoo_mechanism};

fn at(mechanism: &Mechanism, pose: Option<&str>) -> Analysis {
    let options = AnalysisOptions {
        configuration: pose.map(str::to_owned),
        ..AnalysisOptions::default()
    };
    analyse(mechanism, &options).unwrap()
}

/// The mechanism after the advice, by way of its file.
fn followed(mechanism: &Mechanism, advice: &Advice) -> Mechanism {
    let mut draft = Draft::of(mechanism);
    let joint = &mut draft.joints[advice.joint];
    joint.kind = advice.to;
    if let Some(direction) = advice.second_axis {
        joint.axis2 = Direction(direction.map(|x| Number::from_f64(x).unwrap()));
    }
    if !advice.to.uses_lead() {
        joint.lead = None;
    }
    let text = kutzbach::format::write(&draft.build());
    kutzbach::format::read(&text, "followed", &[])
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
        .mechanism
}

fn broken_promises(name: &str, mechanism: &Mechanism, pose: Option<&str>) -> (usize, Vec<String>) {
    let before = at(mechanism, pose);
    let Some(home) = &before.home else {
        return (0, vec![format!("{name}: does not assemble")]);
    };
    let mut wrong = Vec::new();
    for advice in &before.advice {
        let joint = &mechanism.joints()[advice.joint];
        let told = format!(
            "{name}: {} from {} to {}",
            joint.name, joint.kind, advice.to
        );
        if Some(advice.redundant_before) != home.redundant {
            wrong.push(format!("{told}: starts from {advice:?}, not {home:?}"));
        }
        let gained = advice.to.freedom() - joint.kind.freedom();
        if advice.redundant_before - advice.redundant_after != gained as i64 {
            wrong.push(format!("{told}: promises {advice:?} for {gained} freedoms"));
        }
        let after = at(&followed(mechanism, advice), pose);
        let there = after.home.as_ref().map(|h| (h.instantaneous, h.redundant));
        let promised = (home.instantaneous, Some(advice.redundant_after));
        if there != Some(promised) {
            wrong.push(format!(
                "{told}: promised {promised:?}, came out as {there:?}"
            ));
        }
    }
    (before.advice.len(), wrong)
}

/// What the textbooks say of these: a planar loop has three redundant constraints, a Bennett loop three, a Sarrus loop one,
/// and a planar linkage of two loops six. None of them goes without advice.
#[test]
fn overconstrained_classics_get_advice() {
    for (name, redundant, single) in [
        ("planar_4r_general", 3, JointKind::Spherical),
        ("bennett_generic", 3, JointKind::Spherical),
        ("sarrus_6r", 1, JointKind::Universal),
        ("stephenson_III", 6, JointKind::Spherical),
    ] {
        let mechanism = zoo_mechanism(name);
        let analysis = at(&mechanism, None);
        assert_eq!(analysis.home.as_ref().unwrap().redundant, Some(redundant));
        assert!(
            analysis.advice.iter().any(|advice| advice.to == single),
            "{name}: {:?}",
            analysis.advice
        );
        // Best first.
        let left: Vec<i64> = analysis.advice.iter().map(|a| a.redundant_after).collect();
        assert!(left.is_sorted(), "{name}: {left:?}");
    }
}

/// Away from home, where joints are turned and their two frames differ.
#[test]
fn advice_holds_at_another_pose() {
    let turned = |name: &str, joint: &str, value: &str| {
        let mut draft = Draft::of(&zoo_mechanism(name));
        draft.hold_at("turned", joint, Number::decimal(value).unwrap());
        (name.to_owned(), draft.build())
    };
    let mut wrong = Vec::new();
    for (name, mechanism) in [
        turned("planar_4r_general", "J1", "0.5"),
        turned("bennett_generic", "J1", "0.5"),
        turned("sarrus_6r", "J1", "0.2"),
    ] {
        // A joint that is set to a value keeps its kind, as the value would not fit another.
        let mut followed_here = 0;
        let before = at(&mechanism, Some("turned"));
        assert!(before.assembly.closed && before.assembly.moved > 0.01);
        let home = before.home.as_ref().unwrap();
        for advice in &before.advice {
            let joint = &mechanism.joints()[advice.joint];
            if joint.name == "J1" {
                continue;
            }
            followed_here += 1;
            let after = at(&followed(&mechanism, advice), Some("turned"));
            let there = after.home.as_ref().map(|h| (h.instantaneous, h.redundant));
            let promised = (home.instantaneous, Some(advice.redundant_after));
            if there != Some(promised) {
                wrong.push(format!(
                    "{name}: {} to {}: promised {promised:?}, came out as {there:?}",
                    joint.name, advice.to
                ));
            }
        }
        assert!(followed_here > 0, "{name}");
    }
    assert_none(&wrong);
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn every_advice_for_the_reference_mechanisms_holds() {
        let results = in_parallel(&support::sample(zoo(), 3), |(name, mechanism)| {
            broken_promises(name, mechanism, None)
        });
        let given: usize = results.iter().map(|(given, _)| given).sum();
        assert!(
            given > support::at_least(1000),
            "only {given} pieces of advice"
        );
        let wrong: Vec<String> = results.into_iter().flat_map(|(_, wrong)| wrong).collect();
        assert_none(&wrong);
    }
}
