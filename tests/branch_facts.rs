//! What generic poses of a branch tell of the reference mechanisms: locked joints, idle links, classes of motion.

#![allow(clippy::unwrap_used)]

#[path = "support/generic_poses.rs"]
mod generic_poses;
mod support;

use generic_poses::Posed;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{
    JointRole, RelativeMotion, branch_facts, branch_roles, idle_links, motions_to_ground,
    relative_motions,
};
use serde_json::Value;
use std::collections::BTreeSet;
use support::{assert_none, folder, in_parallel, is_locked, zoo, zoo_mechanism};

fn expected() -> Value {
    let text = std::fs::read_to_string(folder("tests/zoo/expected.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn names(value: &Value) -> BTreeSet<String> {
    let names = value.as_array().unwrap().iter();
    names
        .map(|name| name.as_str().unwrap().to_owned())
        .collect()
}

fn locked(mechanism: &Mechanism, roles: &[JointRole]) -> BTreeSet<String> {
    let joints = mechanism.joints().iter().zip(roles);
    joints
        .flat_map(|(joint, role)| {
            let whole = (role.locked == Some(true)).then(|| joint.name.clone());
            whole.into_iter().chain(role.locked_parts.iter().cloned())
        })
        .collect()
}

fn disagreements(name: &str, mechanism: &Mechanism, expected: &Value) -> Vec<String> {
    let mut wrong = Vec::new();
    if expected["pose"] != "regular" {
        return wrong;
    }
    let Posed {
        geometry,
        structure,
        poses,
    } = Posed::of(mechanism);
    let facts = branch_facts(mechanism, &geometry, &structure, &poses);
    let found = locked(mechanism, &facts.roles);
    for (joint, role) in mechanism.joints().iter().zip(&facts.roles) {
        if joint.freedom() > 0 && role.locked.is_none() {
            wrong.push(format!(
                "{name}: whether {} is locked stays open",
                joint.name
            ));
        }
    }
    if expected["locked"] == "all" {
        let all = mechanism
            .joints()
            .iter()
            .filter(|joint| joint.freedom() > 0);
        let all: BTreeSet<String> = all.map(|joint| joint.name.clone()).collect();
        if found != all {
            wrong.push(format!("{name}: locked {found:?}, expected all"));
        }
    } else if expected["locked"].is_array() && expected["finite"] != 0 {
        let expected = names(&expected["locked"]);
        let whole = |names: &BTreeSet<String>| -> BTreeSet<String> {
            names.iter().filter(|n| !n.contains('.')).cloned().collect()
        };
        let parts = expected.iter().filter(|n| n.contains('.'));
        if whole(&found) != whole(&expected)
            || !parts.clone().all(|part| is_locked(part, &found, mechanism))
        {
            wrong.push(format!("{name}: locked {found:?}, expected {expected:?}"));
        }
    }
    if expected["idle"].is_array() {
        let found: BTreeSet<String> = facts
            .idle
            .iter()
            .map(|idle| mechanism.links()[idle.link].name.clone())
            .collect();
        let expected = names(&expected["idle"]);
        if found != expected {
            wrong.push(format!("{name}: idle {found:?}, expected {expected:?}"));
        }
        if facts.idle.iter().any(|idle| idle.freedom != 1) {
            wrong.push(format!("{name}: idle freedoms {:?}", facts.idle));
        }
    }
    let links = mechanism.links().len() - 1;
    if facts.motions.len() != links {
        wrong.push(format!(
            "{name}: motions of {} of {links} links",
            facts.motions.len()
        ));
    }
    // No link can do more than the mechanism.
    let finite = expected["finite"].as_u64().unwrap() as usize;
    for motion in &facts.motions {
        let dimension = motion.class.map(|class| class.dimension());
        if motion.freedom > finite || dimension.is_some_and(|d| d != motion.freedom) {
            wrong.push(format!("{name}: {motion:?}"));
        }
    }
    wrong
}

#[test]
fn locked_joints_and_idle_links_are_the_known_ones() {
    let expected = expected();
    let wrong = in_parallel(&zoo(), |(name, mechanism)| {
        disagreements(name, mechanism, &expected[name])
    });
    assert_none(&wrong.concat());
}

#[test]
#[ignore]
fn show() {
    for name in std::env::var("SHOW").unwrap().split(',') {
        let mechanism = zoo_mechanism(name);
        let Posed {
            geometry,
            structure,
            poses,
        } = Posed::of(&mechanism);
        println!("{name} tangents {}", poses[0].tangents.len());
        for m in motions_to_ground(&mechanism, &geometry, &structure, &poses) {
            println!(
                "  {} f={} r={} t={} {}",
                mechanism.links()[m.link].name,
                m.freedom,
                m.rotations,
                m.translations,
                m.class
                    .map_or("-".into(), |c| format!("{} {c}", c.short_name()))
            );
        }
        println!(
            "  idle {:?}",
            idle_links(&mechanism, &geometry, &structure, &poses)
                .iter()
                .map(|i| mechanism.links()[i.link].name.clone())
                .collect::<Vec<_>>()
        );
        println!(
            "  locked {:?}",
            locked(
                &mechanism,
                &branch_roles(&mechanism, &geometry, &structure, &poses)
            )
        );
    }
}
