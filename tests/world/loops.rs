//! Loops and couplings: closed, agreed on by both solvers, whatever the unit of length.

use super::*;

#[test]
fn both_solvers_agree() {
    let placed = Placed::new(parse(
        r#"<robot name="chain"><link name="ground"/><link name="a"/><link name="b"/><link name="c"/>
        <joint name="one" type="continuous"><parent link="ground"/><child link="a"/><axis xyz="0 1 0"/></joint>
        <joint name="two" type="spherical"><parent link="a"/><child link="b"/><origin xyz="0.5 0 0"/></joint>
        <joint name="three" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="0.4 0.1 0"/><axis xyz="0 1 0"/></joint></robot>"#,
    ));
    let poses = SOLVERS.map(|solver| {
        let mut world = placed.world(&options(solver, gravity(), 5e-4, 8));
        run(&mut world, 800);
        world.link_poses()
    });
    for (a, b) in poses[0].iter().zip(&poses[1]) {
        for i in 0..3 {
            let off = a.translation[i] - b.translation[i];
            assert!(off.abs() < 5e-3, "{off}");
        }
    }
}

#[test]
fn a_world_set_in_motion_moves_without_a_jolt() {
    let placed = Placed::new(support::zoo_mechanism("bennett_rational"));
    let analysis = support::analysis(&placed.mechanism);
    let states = analysis.assembly.states.clone();
    // The tangent: the response to a drive, at rest after a moment.
    let mut driven = placed
        .try_world(
            &states,
            &options(Solver::Multibody, Effects::default(), 1e-6, 1),
        )
        .unwrap();
    driven
        .drive(Drive {
            joint: 0,
            freedom: 0,
            velocity: 1.0,
            largest_force: 1e9,
        })
        .unwrap();
    run(&mut driven, 20);
    let twists = driven.link_twists();
    for solver in SOLVERS {
        let mut world = placed
            .try_world(&states, &options(solver, Effects::default(), 1e-3, 16))
            .unwrap();
        world.set_link_twists(&twists).unwrap();
        let set = world.link_twists();
        for (a, b) in set.iter().flatten().zip(twists.iter().flatten()) {
            assert!((a - b).abs() < 1e-4, "{solver:?}: {a} {b}");
        }
        run(&mut world, 10);
        let state = world.states(&states);
        let off = state[0].values[0] - states[0].values[0] - 0.01;
        assert!(off.abs() < 1e-4, "{solver:?}: {off}");
    }
}

#[test]
fn the_unit_of_length_changes_nothing() {
    let four_bar = |size: f64| {
        Placed::new(parse(&format!(
            r#"<robot name="four_bar"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
            <joint name="a" type="continuous"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
            <joint name="b" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="0 {} 0"/><axis xyz="0 0 1"/></joint>
            <joint name="c" type="continuous"><parent link="ground"/><child link="rocker"/><origin xyz="{} 0 0"/><axis xyz="0 0 1"/></joint>
            <loop name="d" type="revolute"><predecessor link="coupler"><origin xyz="{} {} 0"/></predecessor>
            <successor link="rocker"><origin xyz="0 {} 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#,
            2.0 * size,
            4.0 * size,
            4.0 * size,
            3.0 * size,
            5.0 * size
        )))
    };
    let angle = |size: f64| {
        let placed = four_bar(size);
        let mut world = placed.world(&options(Solver::Impulse, Effects::default(), 1e-3, 8));
        world
            .set_rates(&[vec![1.0], vec![-1.0], vec![0.0], vec![0.0]])
            .unwrap();
        run(&mut world, 300);
        let gap = world.gaps().iter().fold(0.0f64, |m, g| m.max(g.position));
        assert!(gap < 1e-3 * size, "{size}: {gap}");
        world.states(&placed.geometry.states)[0].values[0]
    };
    let one = angle(1.0);
    for size in [1e-6, 1e3] {
        assert!((angle(size) - one).abs() < 1e-6, "{size}");
    }
}

#[test]
fn couplings_of_two_and_of_three_joints_are_kept() {
    let text = |joints: &str| {
        Placed::new(parse(&format!(
            r#"<robot name="gears"><link name="ground"/><link name="a"/><link name="b"/><link name="c"/><link name="d"/>{joints}</robot>"#
        )))
    };
    let hinge = |name: &str, parent: &str, child: &str, more: &str| {
        format!(
            r#"<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/>{more}</joint>"#
        )
    };
    let slide = r#"<joint name="rack" type="prismatic"><parent link="ground"/><child link="c"/><axis xyz="0 1 0"/><mimic joint="one" multiplier="0.25" offset="0"/></joint>"#;
    // a turns b by a mimic, c slides with a; d turns against the sum of a chain by a belt.
    let placed = text(&[
        hinge("one", "ground", "a", ""),
        hinge("two", "a", "b", r#"<mimic joint="one" multiplier="-2" offset="0"/>"#),
        slide.to_owned(),
        hinge("four", "ground", "d", ""),
        r#"<coupling name="belt"><predecessor link="b"/><successor link="d"/><ratio value="3"/></coupling>"#.to_owned(),
    ].concat());
    let belt = &placed.geometry.couplings;
    assert!(belt.iter().any(|coupling| coupling.shares.len() == 3));
    for solver in SOLVERS {
        let mut world = placed.world(&options(solver, Effects::default(), 1e-3, 8));
        assert!(
            world.not_simulated().is_empty(),
            "{:?}",
            world.not_simulated()
        );
        assert_eq!(world.pieces().couplings, 5);
        world
            .drive(Drive {
                joint: 0,
                freedom: 0,
                velocity: 2.0,
                largest_force: 1e4,
            })
            .unwrap();
        let mut states = placed.geometry.states.clone();
        for _ in 0..2000 {
            world.step().unwrap();
            states = world.states(&states);
        }
        let [one, two, rack, four] = [0, 1, 2, 3].map(|i| states[i].values[0]);
        assert!((one - 4.0).abs() < 1e-2, "{one}");
        assert!((two + 2.0 * one).abs() < 1e-6, "{two}");
        assert!((rack - 0.25 * one).abs() < 1e-6, "{rack}");
        assert!(
            (four - 3.0 * (one + two)).abs() < 1e-3,
            "{four} {one} {two}"
        );
    }
}

#[test]
fn what_follows_the_joint_that_closes_a_loop_follows() {
    let hinge = |name: &str, parent: &str, child: &str, at: &str, more: &str| {
        format!(
            r#"<link name="{child}"/><joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/><origin xyz="{at}"/><axis xyz="0 0 1"/>{more}</joint>"#
        )
    };
    let placed = Placed::new(parse(&format!(
        r#"<robot name="parallelogram"><link name="ground"/>{}{}{}{}
        <loop name="closing" type="continuous">
            <predecessor link="coupler"><origin xyz="2 0 0"/></predecessor>
            <successor link="rocker"><origin xyz="0 1 0"/></successor>
            <axis xyz="0 0 1"/>
        </loop></robot>"#,
        hinge("crank_pin", "ground", "crank", "0 0 0", ""),
        hinge("coupler_pin", "crank", "coupler", "0 1 0", ""),
        hinge("rocker_pin", "ground", "rocker", "2 0 0", ""),
        hinge(
            "wheel_pin",
            "ground",
            "wheel",
            "5 0 0",
            r#"<mimic joint="closing" multiplier="2"/>"#
        ),
    )));
    for solver in SOLVERS {
        let mut world = placed.world(&options(solver, Effects::default(), 1e-3, 8));
        assert!(world.not_simulated().is_empty());
        world
            .drive(Drive {
                joint: 0,
                freedom: 0,
                velocity: 0.5,
                largest_force: 1e4,
            })
            .unwrap();
        let mut states = placed.geometry.states.clone();
        for _ in 0..1000 {
            world.step().unwrap();
            states = world.states(&states);
        }
        let [crank, wheel, closing] = [0, 3, 4].map(|joint| states[joint].values[0]);
        assert!((crank - 0.5).abs() < 1e-2, "{crank}");
        assert!((closing - crank).abs() < 1e-3, "{closing} {crank}");
        assert!((wheel - 2.0 * closing).abs() < 1e-3, "{wheel} {closing}");
    }
}

#[test]
fn what_the_engine_cannot_hold_is_said() {
    // Two joints close a loop together and both are coupled: one of them has to close it.
    let placed = Placed::new(parse(
        r#"<robot name="loops"><link name="ground"/><link name="a"/>
        <joint name="one" type="continuous"><parent link="ground"/><child link="a"/><axis xyz="0 0 1"/></joint>
        <loop name="two" type="revolute"><predecessor link="ground"/><successor link="a"/><axis xyz="0 0 1"/></loop>
        <joint name="three" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><mimic joint="two" multiplier="1" offset="0"/></joint>
        <joint name="four" type="continuous"><parent link="a"/><child link="c"/><axis xyz="0 0 1"/><mimic joint="one" multiplier="1" offset="0"/></joint>
        <link name="b"/><link name="c"/></robot>"#,
    ));
    for solver in SOLVERS {
        let world = placed.world(&options(solver, Effects::default(), 1e-3, 4));
        assert_eq!(world.not_simulated().len(), 1);
        let named = &world.not_simulated()[0];
        assert!(world.notes().iter().any(|note| note.about == *named));
    }
    // Limits beyond half a turn: reduced coordinates count turns, impulses cannot.
    let limit = r#"<limit lower="-20" upper="12" effort="1" velocity="1"/>"#;
    let placed = stopped_slider("revolute", limit, false);
    let effects = Effects {
        limits: true,
        ..Effects::default()
    };
    let said = placed.world(&options(Solver::Impulse, effects, 1e-3, 4));
    assert_eq!(said.not_simulated(), ["slide (limits)"]);
    assert_eq!(said.pieces().limits, 0);
    let mut counted = placed.world(&options(Solver::Multibody, effects, 1e-3, 4));
    counted.set_rates(&[vec![20.0]]).unwrap();
    let mut states = placed.geometry.states.clone();
    for _ in 0..1000 {
        counted.step().unwrap();
        states = counted.states(&states);
    }
    assert!(
        (states[0].values[0] - 12.0).abs() < 0.02,
        "{:?}",
        states[0].values
    );
    // In a loop that closes with a limit of less than half a turn, impulses hold it.
    let closing = Placed::new(parse(
        r#"<robot name="loops"><link name="ground"/><link name="a"/>
        <joint name="a_free" type="cylindrical"><parent link="ground"/><child link="a"/><axis xyz="0 0 1"/></joint>
        <loop name="b_slide" type="prismatic"><predecessor link="ground"/><successor link="a"/><axis xyz="0 0 1"/>
        <limit lower="-0.1" upper="0.2" effort="1" velocity="1"/></loop></robot>"#,
    ));
    let mut world = closing.world(&options(Solver::Multibody, effects, 1e-3, 4));
    assert_eq!(world.pieces().limits, 1);
    world.set_rates(&[vec![1.0, 0.0], vec![1.0]]).unwrap();
    run(&mut world, 500);
    assert!(world.limit_violations()[0].1 < 1e-3);
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn loops_of_the_reference_mechanisms_stay_closed() {
        let zoo = support::sample(support::zoo(), 3);
        let wrong: Vec<String> = support::in_parallel(&zoo, |(name, mechanism)| {
            let analysis = support::analysis(mechanism);
            if !analysis.assembly.closed {
                return None;
            }
            let placed = Placed::new(mechanism.clone());
            let length = placed
                .geometry
                .size_of(0..placed.geometry.sides.len())
                .max(1e-3);
            for solver in SOLVERS {
                let options = options(solver, Effects::default(), 1e-3, 8);
                let built = placed.try_world(&analysis.assembly.states, &options);
                let mut world = match built {
                    Ok(world) => world,
                    Err(error) => return Some(format!("{name} {solver:?}: {error}")),
                };
                if !world.not_simulated().is_empty() {
                    return Some(format!("{name}: {:?}", world.not_simulated()));
                }
                let mut worst = 0.0f64;
                for _ in 0..30 {
                    for joint in 0..mechanism.joints().len().min(1) {
                        if mechanism.joints()[joint].freedom() > 0 {
                            let drive = Drive {
                                joint,
                                freedom: 0,
                                velocity: 0.2,
                                largest_force: 1.0,
                            };
                            world.drive(drive).unwrap();
                        }
                    }
                    if let Err(error) = world.step() {
                        return Some(format!("{name} {solver:?}: {error}"));
                    }
                    for gap in world.gaps() {
                        worst = worst.max(gap.position / length).max(gap.angle);
                    }
                }
                if !(worst < 2e-3) {
                    return Some(format!("{name} {solver:?} opens by {worst:e}"));
                }
            }
            None
        })
        .into_iter()
        .flatten()
        .collect();
        support::assert_none(&wrong);
    }
}
