//! Bounces, stops in loops, joints of several freedoms and initial speeds, against closed forms.

use super::*;

const G: f64 = 9.81;

/// A ball let fall by a metre is up again by the square of the coefficient of restitution, after as many of the times of its fall.
#[test]
fn a_ball_bounces_as_high_as_its_restitution_says() {
    let scene = |restitution: f64| {
        let text = r#"<robot name="bounce"><link name="ground"><collision><origin xyz="0 0 -0.5"/><geometry><box size="4 4 1"/></geometry></collision></link>
        <link name="ball"><inertial><mass value="3"/><inertia ixx="0.012" ixy="0" ixz="0" iyy="0.012" iyz="0" izz="0.012"/></inertial>
        <collision><geometry><sphere radius="0.1"/></geometry></collision></link>
        <joint name="free" type="floating"><parent link="ground"/><child link="ball"/><origin xyz="0.1 0.2 1.1"/></joint>
        <scene><gravity xyz="0 0 -9.81"/><contact restitution="SHARE"/></scene></robot>"#;
        Placed::new(parse(&text.replace("SHARE", &restitution.to_string())))
    };
    let fall = (2.0 / G).sqrt();
    for solver in SOLVERS {
        for restitution in [0.0, 0.5, 0.8] {
            let placed = scene(restitution);
            let effects = Effects::of_scene(&placed.mechanism);
            let apex = (1.0 + restitution) * fall;
            let off = [500.0, 2000.0].map(|rate: f64| {
                let mut world = placed.world(&options(solver, effects, 1.0 / rate, 1));
                run(&mut world, (apex * rate).round() as usize);
                world.link_poses()[1].translation[2] - (0.1 + restitution * restitution)
            });
            // A step at the speed of the impact may pass before it is felt.
            for (off, step) in off.into_iter().zip([0.002, 0.0005]) {
                let most = 2.0 * (2.0 * G).sqrt() * step;
                assert!(off.abs() <= most, "{solver:?} {restitution}: {off} {most}");
            }
        }
    }
}

/// Two arms of a metre beside one another, one of 2 kg with its centre at its hinge, the other without weight to speak of, and a coupler
/// of a kilogram at their ends. The joint that closes the loop has a limit.
fn parallelogram(limit: &str) -> Placed {
    let inertia = |mass: f64| {
        format!(
            r#"<inertial><mass value="{mass}"/><inertia ixx="{0}" ixy="0" ixz="0" iyy="{0}" iyz="0" izz="{0}"/></inertial>"#,
            0.1 * mass
        )
    };
    let [heavy, light] = [2.0, 1.0].map(inertia);
    Placed::new(parse(&format!(
        r#"<robot name="parallelogram"><link name="ground"/><link name="a">{heavy}</link><link name="b">{light}</link><link name="c">{light}</link>
        <joint name="arm" type="continuous"><parent link="ground"/><child link="a"/><axis xyz="0 1 0"/></joint>
        <joint name="tip" type="continuous"><parent link="a"/><child link="c"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/></joint>
        <joint name="other" type="continuous"><parent link="ground"/><child link="b"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/></joint>
        <loop name="closing" type="revolute"><predecessor link="b"><origin xyz="1 0 0"/></predecessor>
        <successor link="c"><origin xyz="0 0 1"/></successor><axis xyz="0 1 0"/>{limit}</loop></robot>"#
    )))
}

/// The arms' inertias about their hinges and the coupler's mass, which only shifts (kg m²).
const SWUNG: f64 = 0.2 + 0.1 + 1.0;

#[test]
fn a_stop_in_the_joint_that_closes_a_loop_holds_the_loop_when_its_energy_says() {
    // The arms turn by q from level, the closing joint by −q: half of SWUNG q'² is g sin q. The root of q at the start is substituted away.
    let stop = 0.5f64;
    let count = 20_000;
    let step = stop.sqrt() / f64::from(count);
    let time: f64 = (0..count)
        .map(|i| {
            let s = (f64::from(i) + 0.5) * step;
            2.0 * s * (SWUNG / (2.0 * G * (s * s).sin())).sqrt() * step
        })
        .sum();
    let limit = r#"<limit lower="-0.5" upper="1" effort="1" velocity="1"/>"#;
    for solver in SOLVERS {
        let placed = parallelogram(limit);
        let effects = Effects {
            limits: true,
            ..gravity()
        };
        let passes = |rate: f64, limit: f64| {
            let mut world = placed.world(&options(solver, effects, 1.0 / rate, 4));
            assert_eq!(world.pieces().limits, 1);
            let mut states = placed.geometry.states.clone();
            let mut reached = None;
            for _ in 0..rate as usize {
                world.step().unwrap();
                states = world.states(&states);
                let violations = world.limit_violations();
                let beyond = violations.iter().map(|(_, by)| *by).fold(0.0, f64::max);
                assert!(beyond < limit, "{solver:?}: {beyond}");
                if states[0].values[0] >= stop - 1e-3 {
                    reached = reached.or(Some(world.time()));
                }
            }
            // It rests there.
            assert!(
                (states[0].values[0] - stop).abs() < limit,
                "{solver:?} {states:?}"
            );
            assert!(world.energy().kinetic < 1e-3, "{solver:?}");
            reached.unwrap()
        };
        for (rate, most) in [(1000.0, 0.005), (4000.0, 0.002)] {
            let off = passes(rate, most) - time;
            assert!(off.abs() < most, "{solver:?}: {off}");
        }
    }
}

#[test]
fn a_mechanism_in_motion_keeps_the_speed_it_was_given() {
    // Without gravity nothing changes the speed of a parallelogram: its inertia is the same in every pose.
    let placed = parallelogram("");
    for solver in SOLVERS {
        let off = [240.0, 480.0, 960.0].map(|rate: f64| {
            let effects = Effects::default();
            let mut world = placed.world(&options(solver, effects, 1.0 / rate, 1));
            world
                .set_rates(&[vec![1.0], vec![-1.0], vec![1.0], vec![-1.0]])
                .unwrap();
            assert!((world.energy().kinetic - 0.5 * SWUNG).abs() < 1e-9);
            let mut states = placed.geometry.states.clone();
            for _ in 0..rate as usize {
                world.step().unwrap();
                states = world.states(&states);
            }
            (states[0].values[0] - 1.0).abs()
        });
        assert!(
            off[0] < 0.01 && off[2] < (0.3 * off[0]).max(1e-12),
            "{solver:?}: {off:?}"
        );
    }
}

#[test]
fn of_several_freedoms_one_is_driven_and_the_others_do_as_they_would() {
    // A nut without a thread on an upright rod: it falls by g less friction, and turns as it is driven.
    for (friction, pull) in [(0.0, G), (4.0, G - 4.0 / 2.0)] {
        let placed = Placed::new(parse(&format!(
            r#"<robot name="nut"><link name="ground"/><link name="nut"><inertial><mass value="2"/>
            <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
            <joint name="rod" type="cylindrical"><parent link="ground"/><child link="nut"/><axis xyz="0 0 1"/>
            <dynamics friction="{friction}"/></joint></robot>"#
        )));
        let effects = Effects {
            friction: true,
            ..gravity()
        };
        for solver in SOLVERS {
            let off = [200.0, 400.0].map(|rate: f64| {
                let mut world = placed.world(&options(solver, effects, 1.0 / rate, 1));
                let turn = Drive {
                    joint: 0,
                    freedom: 1,
                    velocity: 2.0,
                    largest_force: 1e4,
                };
                world.drive(turn).unwrap();
                let mut states = placed.geometry.states.clone();
                for _ in 0..rate as usize {
                    world.step().unwrap();
                    states = world.states(&states);
                }
                let [travel, turned] = states[0].values[..] else {
                    panic!("{states:?}")
                };
                assert!((turned - 2.0).abs() < 1e-4, "{solver:?}: {turned}");
                (travel + 0.5 * pull).abs()
            });
            let order = (off[0] / off[1]).log2();
            assert!(off[0] < 0.02 * pull, "{solver:?} {friction}: {off:?}");
            assert!((order - 1.0).abs() < 0.15, "{solver:?} {friction}: {off:?}");
        }
    }
}
