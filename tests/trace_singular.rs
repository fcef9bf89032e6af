//! Singular poses and cusps on the way: where formulas say that they are.
use crate::support;

use kutzbach::mechanism::Mechanism;
use kutzbach::motion::{Event, EventKind, Motion, TraceOptions, trace};
use std::f64::consts::PI;
use support::rewrite::Draft;
use support::{analysis, zoo_mechanism};

/// The motions along all branches.
fn motions(mechanism: &Mechanism) -> Vec<Motion> {
    let known = analysis(mechanism);
    let branches = known.branches.as_ref().unwrap();
    branches
        .iter()
        .map(|branch| {
            let options = TraceOptions {
                branch: Some(branch.name.clone()),
                ..TraceOptions::default()
            };
            let traced = trace(mechanism, &known, &options).unwrap();
            traced.into_motion().unwrap()
        })
        .collect()
}

fn singular(motion: &Motion) -> Vec<&Event> {
    motion
        .events
        .iter()
        .filter(|e| matches!(e.kind, EventKind::Singular { .. }))
        .collect()
}

/// As written, with the joints the other way round, and in other units of length.
fn rewritten(mechanism: &Mechanism) -> Vec<(&'static str, f64, Mechanism)> {
    let mut reversed = Draft::of(mechanism);
    reversed.joints.reverse();
    vec![
        ("as written", 1.0, Draft::of(mechanism).build()),
        ("reversed", 1.0, reversed.build()),
        (
            "in millimetres",
            1e3,
            Draft::of(mechanism).scaled(3).build(),
        ),
        (
            "in kilometres",
            1e-3,
            Draft::of(mechanism).scaled(-3).build(),
        ),
    ]
}

#[test]
fn flat_four_bars_meet_two_flat_poses_on_every_branch() {
    // Parallelogram and antiparallelogram, kite and its spin, rhombus and its two spins: all bars in one line, every hinge
    // folded or stretched, twice once around.
    for name in [
        "planar_parallelogram_flat",
        "planar_kite_flat",
        "planar_rhombus_flat",
    ] {
        for (how, _, mechanism) in rewritten(&zoo_mechanism(name)) {
            let motions = motions(&mechanism);
            assert!(motions.len() >= 2);
            for motion in &motions {
                let place = format!("{name} {how}, branch {}", motion.branch);
                assert!(motion.closed.is_some() && !motion.starts_at_home, "{place}");
                let met = singular(motion);
                assert_eq!(met.len(), 2, "{place}");
                let mut at_home = 0;
                for event in met {
                    let EventKind::Singular {
                        freedom,
                        excess,
                        crosses,
                        home,
                    } = event.kind
                    else {
                        unreachable!()
                    };
                    assert_eq!((freedom, excess, crosses), (2, 1, true), "{place}");
                    at_home += usize::from(home);
                    for value in &event.values {
                        let turns = value / PI;
                        let off = (turns - turns.round()).abs() * PI;
                        assert!(off < 1e-10, "{place}: {value}");
                    }
                }
                assert_eq!(at_home, 1, "{place}");
            }
        }
    }
}

#[test]
fn mechanisms_of_one_smooth_branch_meet_no_singular_pose() {
    for name in ["bennett_generic", "bennett_ratio2", "planar_4r_general"] {
        for (how, _, mechanism) in rewritten(&zoo_mechanism(name)) {
            for motion in motions(&mechanism) {
                assert!(motion.closed.is_some());
                assert_eq!(singular(&motion).len(), 0, "{name} {how}");
            }
        }
    }
}

#[test]
fn cusps_are_passed_and_found() {
    for name in ["double_watt_cusp", "csrr_cusp", "double_watt_cusp__moved"] {
        let mechanism = zoo_mechanism(name);
        for motion in motions(&mechanism) {
            assert!(motion.closed.is_some(), "{name}: {:?}", motion.ends);
            let cusps: Vec<_> = motion
                .events
                .iter()
                .filter(|e| matches!(e.kind, EventKind::Cusp { .. }))
                .collect();
            assert_eq!(cusps.len(), 1, "{name}");
            if !name.ends_with("moved") {
                // The home pose of these files.
                for value in &cusps[0].values {
                    assert!(value.abs() < 1e-9, "{name}: {value:e}");
                }
            }
        }
    }
}

/// Crank and rod of equal length fold onto one another twice a turn, with the block over the crank's pivot: there the pair
/// can turn as one while the block rests. Drawn with the crank along (0.6, 0.8).
#[test]
fn equal_crank_and_rod_fold_twice_a_turn() {
    const FILE: &str = r#"<robot name="equal">
      <link name="ground"/><link name="crank"/><link name="rod"/><link name="block"/>
      <joint name="pivot" type="continuous">
        <parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/>
      </joint>
      <joint name="pin" type="continuous">
        <parent link="crank"/><child link="rod"/><origin xyz="0.6 0.8 0"/><axis xyz="0 0 1"/>
      </joint>
      <joint name="rail" type="prismatic">
        <parent link="ground"/><child link="block"/><origin xyz="1.2 0 0"/><axis xyz="1 0 0"/>
      </joint>
      <loop name="wrist" type="revolute">
        <predecessor link="rod"><origin xyz="0.6 -0.8 0"/></predecessor>
        <successor link="block"/><axis xyz="0 0 1"/>
      </loop>
    </robot>"#;
    let mechanism = kutzbach::format::read(FILE, "equal.urdf", &[])
        .unwrap()
        .mechanism;
    for (what, scale, mechanism) in rewritten(&mechanism) {
        let motion = &motions(&mechanism)[0];
        let met = singular(motion);
        assert_eq!(met.len(), 2, "{what}");
        let value = |event: &Event, name: &str| {
            let at = motion.ranges.iter().position(|r| r.variable.name == name);
            let joint = motion.ranges[at.unwrap()].variable.joint;
            event.values[mechanism.variable_offsets()[joint]]
        };
        for event in met {
            assert!(
                matches!(
                    event.kind,
                    EventKind::Singular {
                        freedom: 2,
                        crosses: true,
                        ..
                    }
                ),
                "{what}: {event:?}"
            );
            // The crank stands upright, or hangs.
            let crank = 0.8f64.atan2(0.6) + value(event, "pivot");
            assert!(crank.cos().abs() < 1e-10, "{what}: {crank}");
            let rail = value(event, "rail") / scale;
            assert!((rail + 1.2).abs() < 1e-10, "{what}: {rail}");
        }
    }
}
