//! What is refused, survived, repeated to the bit, and done a million times.

use super::*;

#[test]
fn numbers_that_are_none_are_refused() {
    let placed = pendulum("");
    let plain = options(Solver::Multibody, Effects::default(), 1e-3, 4);
    let mut states = placed.geometry.states.clone();
    states[0].values[0] = f64::NAN;
    assert!(matches!(
        placed.try_world(&states, &plain),
        Err(WorldError::NotFinite { .. })
    ));
    assert!(matches!(
        placed.try_world(&[], &plain),
        Err(WorldError::States {
            wanted: 1,
            given: 0
        })
    ));
    for broken in [
        WorldOptions {
            time_step: f64::NAN,
            ..plain
        },
        WorldOptions {
            time_step: -1.0,
            ..plain
        },
        WorldOptions {
            time_step: f64::INFINITY,
            ..plain
        },
        WorldOptions {
            substeps: 0,
            ..plain
        },
        WorldOptions {
            effects: Effects {
                gravity: Some([0.0, f64::NAN, 0.0]),
                ..Effects::default()
            },
            ..plain
        },
    ] {
        assert!(matches!(
            placed.try_world(&placed.geometry.states, &broken),
            Err(WorldError::Options(_))
        ));
    }
    let mut world = placed.world(&plain);
    let drive = |joint, freedom, velocity, largest_force| Drive {
        joint,
        freedom,
        velocity,
        largest_force,
    };
    for refused in [
        drive(0, 0, f64::NAN, 1.0),
        drive(0, 0, f64::INFINITY, 1.0),
        drive(0, 0, 1.0, f64::NAN),
        drive(0, 0, 1.0, -1.0),
        drive(0, 1, 1.0, 1.0),
        drive(1, 0, 1.0, 1.0),
    ] {
        assert!(matches!(world.drive(refused), Err(WorldError::Command(_))));
    }
    assert!(world.push(1, [f64::NAN; 6]).is_err());
    assert!(world.push(9, [0.0; 6]).is_err());
    assert!(world.set_link_twists(&[[f64::NAN; 6]; 2]).is_err());
    assert!(world.set_link_twists(&[]).is_err());
    assert!(world.set_rates(&[vec![f64::NAN]]).is_err());
    run(&mut world, 3);
}

#[test]
fn what_leaves_the_range_of_numbers_is_an_error_that_names_the_link() {
    let placed = pendulum("");
    for solver in SOLVERS {
        let mut world = placed.world(&options(solver, Effects::default(), 1e-3, 4));
        let failure = (0..1000).find_map(|_| {
            world.push(1, [0.0, 1e50, 0.0, 1e50, 0.0, 0.0]).unwrap();
            world.step().err()
        });
        assert!(
            matches!(&failure, Some(WorldError::Diverged { link, time }) if link == "bob" && *time > 0.0),
            "{solver:?}: {failure:?}"
        );
    }
}

#[test]
fn the_same_input_gives_the_same_bits() {
    let placed = Placed::new(support::zoo_mechanism("planar_4r_general"));
    for solver in SOLVERS {
        let bits = || -> Vec<u64> {
            let mut world = placed.world(&options(solver, gravity(), 1e-3, 2));
            world
                .drive(Drive {
                    joint: 0,
                    freedom: 0,
                    velocity: 1.0,
                    largest_force: 10.0,
                })
                .unwrap();
            run(&mut world, 1000);
            let poses = world.link_poses();
            poses
                .iter()
                .flat_map(|p| p.rotation.iter().flatten().chain(&p.translation))
                .map(|x| x.to_bits())
                .collect()
        };
        assert_eq!(bits(), bits());
    }
}

/// Resident memory in pages, where the system tells.
fn resident() -> Option<usize> {
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    text.split_whitespace().nth(1)?.parse().ok()
}

#[test]
fn odd_files_are_survived() {
    let chain = |links: usize| {
        let mut text = String::from(r#"<robot name="chain"><link name="l0"/>"#);
        for i in 1..=links {
            text += &format!(
                r#"<link name="l{i}"/><joint name="j{i}" type="revolute"><parent link="l{}"/><child link="l{i}"/><origin xyz="0.1 0 0"/><axis xyz="0 {} 1"/></joint>"#,
                i - 1,
                i % 2
            );
        }
        text + "</robot>"
    };
    let inertial = |mass: &str, moment: &str| {
        format!(
            r#"<robot name="odd"><link name="ground"/><link name="a"><inertial><mass value="{mass}"/>
            <inertia ixx="{moment}" ixy="0" ixz="0" iyy="{moment}" iyz="0" izz="{moment}"/></inertial></link>
            <joint name="j" type="revolute"><parent link="ground"/><child link="a"/><axis xyz="0 0 1"/></joint></robot>"#
        )
    };
    let texts = [
        r#"<robot name="one"><link name="only"/></robot>"#.to_owned(),
        chain(120),
        inertial("0", "0"),
        inertial("1", "0"),
        inertial("1e-30", "1e-30"),
        inertial("1e30", "1e30"),
        // The ground in the middle, a piece of its own, a link without joints, bodies that coincide.
        r#"<robot name="pieces"><ground link="b"/><link name="a"/><link name="b"/><link name="c"/><link name="d"/><link name="e"/><link name="f"/>
        <joint name="ab" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
        <joint name="bc" type="universal"><parent link="b"/><child link="c"/><axis xyz="0 0 1"/><axis2 xyz="1 0 0"/></joint>
        <joint name="ad" type="floating"><parent link="a"/><child link="d"/></joint>
        <joint name="de" type="spherical"><parent link="d"/><child link="e"/></joint>
        <loop name="ed" type="revolute"><predecessor link="e"/><successor link="d"/><axis xyz="0 0 1"/></loop>
        <joint name="af" type="floating"><parent link="a"/><child link="f"/></joint></robot>"#.to_owned(),
        // Held by points in planes alone.
        r#"<robot name="points"><link name="a"/><link name="b"/>
        <joint name="place" type="floating"><parent link="a"/><child link="b"/></joint>
        <loop name="p1" type="point_on_plane"><predecessor link="a"/><successor link="b"/><axis2 xyz="0 0 1"/></loop>
        <loop name="p2" type="point_on_line"><predecessor link="a"/><successor link="b"/><axis2 xyz="0 0 1"/></loop></robot>"#.to_owned(),
    ];
    // The longest and shortest steps, and time standing nearly still.
    let placed = pendulum("");
    for solver in SOLVERS {
        for step in [1e-12, 1e6] {
            let mut world = placed.world(&options(solver, gravity(), step, 1));
            world
                .drive(Drive {
                    joint: 0,
                    freedom: 0,
                    velocity: 1e9,
                    largest_force: f64::INFINITY,
                })
                .unwrap();
            let _ = (0..3).try_for_each(|_| world.step());
        }
    }
    let all = Effects {
        contact: true,
        limits: true,
        friction: true,
        damping: true,
        ..gravity()
    };
    for text in &texts {
        let placed = Placed::new(parse(text));
        for solver in SOLVERS {
            for effects in [Effects::default(), all] {
                let mut world = placed.world(&options(solver, effects, 1e-3, 1));
                run(&mut world, 3);
                let poses = world.link_poses();
                assert_eq!(poses.len(), placed.mechanism.links().len());
                let ground = placed.mechanism.ground().0;
                assert!(world.link_twists()[ground].iter().all(|x| *x == 0.0));
            }
        }
    }
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn a_million_steps_need_no_more_memory_than_a_thousand() {
        let placed = pendulum("");
        let mut world = placed.world(&options(Solver::Impulse, gravity(), 1e-3, 1));
        run(&mut world, 10_000);
        let before = resident();
        run(&mut world, 1_000_000);
        if let (Some(before), Some(after)) = (before, resident()) {
            // Other tests run beside this one; a leak of a byte a step would be 244 pages of 4096.
            assert!(after < before + 25_000, "{before} {after}");
        }
        assert!((world.time() - 1010.0).abs() < 1e-6);
    }
}
