//! Each effect alone: energy, periods, limits, contact, and what it adds to a world.

use super::*;

#[test]
fn a_pendulum_swings_with_the_period_that_its_stated_inertia_gives() {
    let placed = pendulum("");
    for solver in SOLVERS {
        let options = options(solver, gravity(), 1e-3, 4);
        let start = swung(&placed, 0.02);
        let mut world = placed.try_world(&start, &options).unwrap();
        assert!(world.notes().is_empty(), "{:?}", world.notes());
        let mut state = start.clone();
        let mut crossings = Vec::new();
        while crossings.len() < 3 {
            let before = state[0].values[0];
            world.step().unwrap();
            state = world.states(&state);
            let now = state[0].values[0];
            if before > 0.0 && now <= 0.0 {
                crossings.push(world.time() - 1e-3 * now / (now - before));
            }
        }
        let period = (crossings[2] - crossings[0]) / 2.0;
        // 2π √((I + m l²) / (m g l)), and 1 + α²/16 for an amplitude of 0.02.
        let wanted = TAU * (0.6f64 / (2.0 * 9.81 * 0.5)).sqrt() * (1.0 + 0.02 * 0.02 / 16.0);
        assert!(
            (period / wanted - 1.0).abs() < 1e-3,
            "{solver:?}: {period} {wanted}"
        );
    }
}

#[test]
fn energy_is_kept_and_only_taken_by_friction_and_damping() {
    let resisting = r#"<dynamics damping="0.2" friction="0.3"/>"#;
    for solver in SOLVERS {
        let run_with = |effects: Effects, dynamics: &str| -> (Vec<f64>, usize) {
            let placed = pendulum(dynamics);
            let options = options(solver, effects, 1e-3, 4);
            let mut world = placed.try_world(&swung(&placed, 2.0), &options).unwrap();
            let energies = (0..2000)
                .map(|_| {
                    world.step().unwrap();
                    world.energy().total()
                })
                .collect();
            (energies, world.pieces().frictions + world.pieces().dampings)
        };
        // 2 kg 0.5 m below the pivot at 1 m, swung by 2 rad.
        let start = 2.0 * 9.81 * (1.0 - 0.5 * 2.0f64.cos());
        let depth = 2.0 * 9.81 * 0.5;
        // Off, although the file states them.
        let (free, pieces) = run_with(gravity(), resisting);
        assert_eq!(pieces, 0);
        for energy in &free {
            assert!(
                (energy - start).abs() < 1e-2 * depth,
                "{solver:?}: {energy} {start}"
            );
        }
        for effects in [
            Effects {
                friction: true,
                ..gravity()
            },
            Effects {
                damping: true,
                ..gravity()
            },
        ] {
            let (lossy, pieces) = run_with(effects, resisting);
            assert_eq!(pieces, 1);
            let rounding = 1e-4 * depth;
            assert!(lossy.windows(2).all(|pair| pair[1] < pair[0] + rounding));
            assert!(lossy.last().unwrap() < &(start - 0.1 * depth), "{solver:?}");
        }
    }
}

#[test]
fn damping_and_friction_are_as_large_as_stated() {
    // A slider of 2 kg pushed along its axis: m v' = F − d v, and nothing below the friction force.
    let text = |dynamics: &str| {
        Placed::new(parse(&format!(
            r#"<robot name="slider"><link name="ground"/><link name="body">
            <inertial><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
            <joint name="slide" type="prismatic"><parent link="ground"/><child link="body"/><axis xyz="1 0 0"/>{dynamics}</joint></robot>"#
        )))
    };
    for solver in SOLVERS {
        let effects = Effects {
            friction: true,
            damping: true,
            ..Effects::default()
        };
        let options = options(solver, effects, 1e-3, 4);
        let speed = |placed: &Placed, force: f64| {
            let mut world = placed.world(&options);
            for _ in 0..1000 {
                world.push(1, [force, 0.0, 0.0, 0.0, 0.0, 0.0]).unwrap();
                world.step().unwrap();
            }
            world.link_twists()[1][3]
        };
        let damped = speed(&text(r#"<dynamics damping="4"/>"#), 3.0);
        let wanted = 0.75 * (1.0 - (-2.0f64).exp());
        assert!(
            (damped - wanted).abs() < 2e-3,
            "{solver:?}: {damped} {wanted}"
        );
        let rough = text(r#"<dynamics friction="1"/>"#);
        assert!(speed(&rough, 0.99).abs() < 1e-9);
        let sliding = speed(&rough, 3.0);
        assert!((sliding - 1.0).abs() < 2e-3, "{solver:?}: {sliding}");
    }
}

/// A block of 2 kg on a rail that falls by 0.6 in its length, from rest: what resists it, and how far it slides in a second.
#[test]
fn a_block_slides_down_a_slope_as_its_equation_says_and_the_error_falls_with_the_step() {
    let pull = 9.81 * 0.6;
    let rate: f64 = 4.0 / 2.0;
    let damped = pull / rate * (1.0 - (1.0 - (-rate).exp()) / rate);
    for (dynamics, wanted) in [
        ("", 0.5 * pull),
        (r#"<dynamics friction="5"/>"#, 0.5 * (pull - 5.0 / 2.0)),
        (r#"<dynamics damping="4"/>"#, damped),
        // More than pulls: it stays.
        (r#"<dynamics friction="12"/>"#, 0.0),
    ] {
        let placed = Placed::new(parse(&format!(
            r#"<robot name="slope"><link name="ground"/><link name="block"><inertial><mass value="2"/>
            <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
            <joint name="rail" type="prismatic"><parent link="ground"/><child link="block"/><axis xyz="0.8 0 -0.6"/>{dynamics}</joint></robot>"#
        )));
        let effects = Effects {
            gravity: Some([0.0, 0.0, -9.81]),
            friction: true,
            damping: true,
            ..Effects::default()
        };
        for solver in SOLVERS {
            let slid = |steps: usize| {
                let options = options(solver, effects, 1.0 / steps as f64, 1);
                let mut world = placed.world(&options);
                for _ in 0..steps {
                    world.step().unwrap();
                }
                world.states(&placed.geometry.states)[0].values[0]
            };
            let off = [100, 200, 400].map(|steps| (slid(steps) - wanted).abs());
            if wanted == 0.0 {
                assert!(off.iter().all(|off| *off < 1e-9), "{solver:?}: {off:?}");
                continue;
            }
            assert!(off[0] < 0.02 * wanted, "{solver:?} {dynamics}: {off:?}");
            for pair in off.windows(2) {
                let order = (pair[0] / pair[1]).log2();
                assert!((order - 1.0).abs() < 0.15, "{solver:?} {dynamics}: {off:?}");
            }
        }
    }
}

#[test]
fn limits_stop_a_joint_only_where_they_are_simulated() {
    let limit = r#"<limit lower="-0.2" upper="0.1" effort="1" velocity="1"/>"#;
    for (kind, start, closes) in [
        ("prismatic", 0.0, false),
        ("revolute", 0.0, false),
        // Limits count from the joint's zero, not from where the world starts.
        ("prismatic", -0.15, false),
        ("revolute", 0.05, false),
    ] {
        let placed = stopped_slider(kind, limit, closes);
        for solver in SOLVERS {
            for limits in [true, false] {
                for speed in [1.0, -1.0] {
                    let effects = Effects {
                        limits,
                        ..Effects::default()
                    };
                    let options = options(solver, effects, 1e-3, 4);
                    let states = swung(&placed, start);
                    let mut world = placed.try_world(&states, &options).unwrap();
                    assert_eq!(world.pieces().limits, usize::from(limits));
                    world.set_rates(&[vec![speed]]).unwrap();
                    let mut worst = 0.0f64;
                    for _ in 0..600 {
                        world.step().unwrap();
                        worst = worst.max(world.limit_violations()[0].1);
                    }
                    if limits {
                        // One substep at full speed may pass before the limit is felt.
                        assert!(worst < 5e-4, "{kind} {solver:?} {speed}: {worst}");
                    } else {
                        assert!(worst > 0.2, "{kind} {solver:?} {speed}: {worst}");
                    }
                }
            }
        }
    }
}

fn box_over_ground() -> Placed {
    Placed::new(parse(
        r#"<robot name="drop"><link name="ground"><collision><origin xyz="0 0 -0.1"/><geometry><box size="4 4 0.2"/></geometry></collision></link>
        <link name="crate"><inertial><mass value="3"/><inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05"/></inertial>
        <collision><geometry><box size="0.4 0.4 0.4"/></geometry></collision></link>
        <link name="far"><collision><origin xyz="0 0 5"/><geometry><mesh filename="far.stl"/></geometry></collision></link>
        <joint name="free" type="floating"><parent link="ground"/><child link="crate"/><origin xyz="0.1 0.2 0.5"/></joint>
        <joint name="held" type="fixed"><parent link="ground"/><child link="far"/></joint></robot>"#,
    ))
}

#[test]
fn a_box_rests_on_the_ground_only_where_contact_is_simulated() {
    let placed = box_over_ground();
    for solver in SOLVERS {
        let with = Effects {
            contact: true,
            ..gravity()
        };
        let mut resting = placed.world(&options(solver, with, 1e-3, 4));
        assert_eq!(resting.pieces().colliders, 2);
        assert!(
            resting
                .not_simulated()
                .iter()
                .any(|what| what.contains("far"))
        );
        run(&mut resting, 2000);
        let height = resting.link_poses()[1].translation[2];
        assert!((height - 0.2).abs() < 0.01, "{solver:?}: {height}");
        assert!(resting.contacts() > 0);
        assert!(resting.energy().kinetic < 1e-6);

        let mut falling = placed.world(&options(solver, gravity(), 1e-3, 4));
        assert_eq!(falling.pieces().colliders, 0);
        run(&mut falling, 2000);
        assert_eq!(falling.contacts(), 0);
        let height = falling.link_poses()[1].translation[2];
        let wanted = 0.5 - 0.5 * 9.81 * 4.0;
        assert!(
            (height - wanted).abs() < 0.02,
            "{solver:?}: {height} {wanted}"
        );
    }
}

#[test]
fn links_that_a_joint_joins_do_not_collide() {
    for kind in ["revolute", "universal"] {
        let placed = Placed::new(parse(&format!(
            r#"<robot name="overlap"><link name="ground"><collision><geometry><sphere radius="0.5"/></geometry></collision></link>
            <link name="body"><collision><geometry><sphere radius="0.5"/></geometry></collision></link>
            <joint name="joint" type="{kind}"><parent link="ground"/><child link="body"/><origin xyz="0.3 0 0"/><axis xyz="1 0 0"/></joint></robot>"#
        ).replace("<axis xyz=\"1 0 0\"/>", if kind == "universal" { "<axis xyz=\"1 0 0\"/><axis2 xyz=\"0 1 0\"/>" } else { "<axis xyz=\"1 0 0\"/>" })));
        for solver in SOLVERS {
            let with = Effects {
                contact: true,
                ..Effects::default()
            };
            let mut world = placed.world(&options(solver, with, 1e-3, 4));
            run(&mut world, 50);
            assert_eq!(world.contacts(), 0);
            assert!(world.energy().kinetic < 1e-20);
        }
    }
}

#[test]
fn each_effect_adds_its_own_pieces_and_nothing_else() {
    let placed = Placed::new(parse(
        r#"<robot name="all"><link name="ground"><collision><geometry><box size="1 1 0.1"/></geometry></collision></link>
        <link name="a"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
        <link name="b"><collision><geometry><capsule radius="0.05" length="0.2"/></geometry></collision></link>
        <joint name="one" type="revolute"><parent link="ground"/><child link="a"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="1" velocity="1"/><dynamics damping="0.1" friction="0.2"/></joint>
        <joint name="two" type="cylindrical"><parent link="a"/><child link="b"/><origin xyz="0.5 0 0"/><axis xyz="0 1 0"/>
        <dynamics friction="0.2"/></joint></robot>"#,
    ));
    for solver in SOLVERS {
        let pieces = |effects: Effects| placed.world(&options(solver, effects, 1e-3, 4)).pieces();
        let none = pieces(Effects::default());
        assert_eq!(
            (
                none.colliders,
                none.limits,
                none.frictions,
                none.dampings,
                none.motors
            ),
            (0, 0, 0, 0, 0)
        );
        assert_eq!(none, pieces(gravity()));
        let with = |change: fn(&mut Effects)| {
            let mut effects = Effects::default();
            change(&mut effects);
            pieces(effects)
        };
        assert_eq!(
            with(|e| e.contact = true),
            kutzbach::simulate::Pieces {
                colliders: 3,
                ..none
            }
        );
        assert_eq!(
            with(|e| e.limits = true),
            kutzbach::simulate::Pieces { limits: 1, ..none }
        );
        assert_eq!(
            with(|e| e.friction = true),
            kutzbach::simulate::Pieces {
                frictions: 3,
                ..none
            }
        );
        assert_eq!(
            with(|e| e.damping = true),
            kutzbach::simulate::Pieces {
                dampings: 1,
                ..none
            }
        );
        let mut driven = placed.world(&options(solver, Effects::default(), 1e-3, 4));
        let drive = Drive {
            joint: 0,
            freedom: 0,
            velocity: 1.0,
            largest_force: 1e3,
        };
        driven.drive(drive).unwrap();
        driven.drive(drive).unwrap();
        assert_eq!(driven.pieces().motors, 1);
        driven.release(0, 0);
        assert_eq!(driven.pieces(), none);
    }
}
