//! The simulated world against what is known of joints, energy, limits, contact and coupling.

#![allow(clippy::unwrap_used)]

mod support;

use kutzbach::closure::{Arithmetic, Geometry, JointState};
use kutzbach::mechanism::{JointKind, Mechanism};
use kutzbach::simulate::{Drive, Effects, Solver, World, WorldError, WorldOptions};
use std::f64::consts::{PI, TAU};

const SOLVERS: [Solver; 2] = [Solver::Multibody, Solver::Impulse];

fn parse(text: &str) -> Mechanism {
    kutzbach::format::read(text, "test.urdf", &[])
        .unwrap_or_else(|error| panic!("{error}"))
        .mechanism
}

struct Placed {
    mechanism: Mechanism,
    geometry: Geometry<f64>,
}

impl Placed {
    fn new(mechanism: Mechanism) -> Self {
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        Self {
            mechanism,
            geometry,
        }
    }

    fn world(&self, options: &WorldOptions) -> World {
        self.try_world(&self.geometry.states, options).unwrap()
    }

    fn try_world(
        &self,
        states: &[JointState<f64>],
        options: &WorldOptions,
    ) -> Result<World, WorldError> {
        World::new(&self.mechanism, &self.geometry, states, options)
    }
}

fn options(solver: Solver, effects: Effects, time_step: f64, substeps: usize) -> WorldOptions {
    WorldOptions {
        solver,
        effects,
        time_step,
        substeps,
    }
}

fn run(world: &mut World, steps: usize) {
    for _ in 0..steps {
        world.step().unwrap();
    }
}

/// Numbers in (−1, 1) that are the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn wrench(&mut self, size: f64) -> [f64; 6] {
        [0; 6].map(|_| size * self.next())
    }
}

const BRICK: &str = r#"<inertial><origin xyz="0.1 -0.05 0.2" rpy="0.3 0.2 0.1"/><mass value="2"/>
  <inertia ixx="0.02" ixy="0.001" ixz="0" iyy="0.03" iyz="0.002" izz="0.025"/></inertial>"#;

/// One joint of a kind between the ground and a brick, in general position.
fn single(kind: JointKind) -> Placed {
    let (mut axis, mut second) = (String::new(), "");
    if kind.uses_axis() {
        axis = r#"<axis xyz="1 2 -1"/>"#.to_owned();
    }
    if kind.uses_second_axis() {
        second = r#"<axis2 xyz="1 -1 -1"/>"#;
    }
    let lead = if kind.uses_lead() {
        r#"<screw lead="0.3"/>"#
    } else {
        ""
    };
    let distance = if kind == JointKind::Distance {
        r#"<distance value="0.5"/>"#
    } else {
        ""
    };
    Placed::new(parse(&format!(
        r#"<robot name="single"><link name="ground"/><link name="body">{BRICK}</link>
        <joint name="joint" type="{kind}"><parent link="ground"/><child link="body"/>
        <origin xyz="0.3 0.2 -0.1" rpy="0.4 -0.7 1.1"/>{axis}{second}{lead}{distance}</joint></robot>"#
    )))
}

/// Singular values, in the largest, of the twists that pushes of all sorts give a body in one step.
fn response(placed: &Placed, options: &WorldOptions, link: usize) -> Vec<f64> {
    let mut random = Random(7);
    let twists: Vec<[f64; 6]> = (0..9)
        .map(|_| {
            let mut world = placed.world(options);
            world.push(link, random.wrench(0.1)).unwrap();
            world.step().unwrap();
            world.link_twists()[link]
        })
        .collect();
    let matrix = nalgebra::DMatrix::from_fn(9, 6, |i, j| twists[i][j]);
    let mut values: Vec<f64> = matrix.singular_values().iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    // A push of 0.1 N m for a millisecond turns a free brick of 0.02 kg m² at 5e-3 rad/s.
    values.iter().map(|v| v / values[0].max(1e-3)).collect()
}

#[test]
fn every_kind_of_joint_moves_as_it_should() {
    let mut wrong = Vec::new();
    for kind in JointKind::ALL {
        let placed = single(kind);
        for solver in SOLVERS {
            let options = options(solver, Effects::default(), 1e-3, 8);
            let mut world = placed.world(&options);
            assert!(world.not_simulated().is_empty());
            let mut random = Random(3);
            let mut wrench = [0.0; 6];
            let mut worst = (0.0f64, 0.0f64);
            for step in 0..400 {
                if step % 40 == 0 {
                    wrench = random.wrench(3.0);
                }
                world.push(1, wrench).unwrap();
                world.step().unwrap();
                let gap = world.gaps()[0];
                worst = (worst.0.max(gap.position), worst.1.max(gap.angle));
            }
            // A joint of the tree cannot open; one held by two joints or by impulses opens by what a substep leaves.
            if !(worst.0 < 2e-5 && worst.1 < 2e-5) {
                wrong.push(format!("{kind} {solver:?} opens by {worst:?}"));
            }
            let finer = WorldOptions {
                substeps: 32,
                ..options
            };
            let values = response(&placed, &finer, 1);
            let freedom = kind.freedom();
            let moves = freedom == 0 || values[freedom - 1] > 1e-3;
            let stays = values[freedom..].iter().all(|v| *v < 1e-5);
            if !(moves && stays) {
                wrong.push(format!("{kind} {solver:?} moves by {values:?}"));
            }
        }
    }
    support::assert_none(&wrong);
}

fn gravity() -> Effects {
    Effects {
        gravity: Some([0.0, 0.0, -9.81]),
        ..Effects::default()
    }
}

/// A pendulum on a horizontal axis: 2 kg, centre 0.5 m off the axis, moment 0.1 kg m² about the centre.
fn pendulum(dynamics: &str) -> Placed {
    Placed::new(parse(&format!(
        r#"<robot name="pendulum"><link name="ground"/><link name="bob">
        <inertial><origin xyz="0 0 -0.5"/><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
        </link><joint name="pivot" type="continuous"><parent link="ground"/><child link="bob"/><origin xyz="0.2 0.1 1"/>
        <axis xyz="1 0 0"/>{dynamics}</joint></robot>"#
    )))
}

fn swung(placed: &Placed, angle: f64) -> Vec<JointState<f64>> {
    vec![placed.geometry.displacements[0].at(&[angle])]
}

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

fn stopped_slider(kind: &str, limit: &str, closes: bool) -> Placed {
    let ends = |joint: &str| {
        if closes {
            format!(
                r#"<joint name="place" type="floating"><parent link="ground"/><child link="body"/></joint>
                <loop name="slide" type="{kind}"><predecessor link="ground"/><successor link="body"/>{joint}</loop>"#
            )
        } else {
            format!(
                r#"<joint name="slide" type="{kind}"><parent link="ground"/><child link="body"/>{joint}</joint>"#
            )
        }
    };
    Placed::new(parse(&format!(
        r#"<robot name="slider"><link name="ground"/><link name="body">
        <inertial><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>{}</robot>"#,
        ends(&format!(r#"<axis xyz="0 0 1"/>{limit}"#))
    )))
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

#[test]
fn a_driven_freedom_turns_at_its_rate_and_no_other() {
    for kind in JointKind::ALL {
        let placed = single(kind);
        for solver in SOLVERS {
            for freedom in 0..kind.freedom() {
                let options = options(solver, Effects::default(), 1e-3, 8);
                let mut world = placed.world(&options);
                // Let all freedoms be driven, so that only the one asked for moves.
                for other in 0..kind.freedom() {
                    world
                        .drive(Drive {
                            joint: 0,
                            freedom: other,
                            velocity: if other == freedom { 0.5 } else { 0.0 },
                            largest_force: 1e6,
                        })
                        .unwrap();
                }
                run(&mut world, 20);
                let twist = world.link_twists()[1];
                let states = world.states(&placed.geometry.states);
                let frame = &placed.geometry.sides[0][0];
                let screws = placed.geometry.displacements[0].screws(&states[0]);
                let (angular, linear) = screws[freedom].moved(frame).about(&[0.0; 3]);
                let wanted = [angular, linear].concat();
                for i in 0..6 {
                    assert!(
                        (twist[i] - 0.5 * wanted[i]).abs() < 0.01,
                        "{kind} {solver:?} freedom {freedom}: {twist:?} {wanted:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_screw_keeps_its_lead_in_the_tree_and_in_a_loop() {
    let text = |closing: bool| {
        let screw = |frame: &str, a: &str, b: &str, name: &str| {
            format!(
                r#"<{frame} name="{name}" type="screw"><{a} link="ground"/><{b} link="nut"/><axis xyz="0 0 1"/><screw lead="0.2"/></{frame}>"#
            )
        };
        // The second of two equal screws closes a loop.
        let second = if closing {
            screw("loop", "predecessor", "successor", "two")
        } else {
            String::new()
        };
        Placed::new(parse(&format!(
            r#"<robot name="screws"><link name="ground"/><link name="nut"/>{}{second}</robot>"#,
            screw("joint", "parent", "child", "one")
        )))
    };
    for closing in [false, true] {
        let placed = text(closing);
        for solver in SOLVERS {
            let mut world = placed.world(&options(solver, Effects::default(), 1e-3, 16));
            assert!(world.not_simulated().is_empty());
            assert_eq!(world.pieces().intermediate_bodies, usize::from(closing));
            world
                .drive(Drive {
                    joint: 0,
                    freedom: 0,
                    velocity: 4.0,
                    largest_force: 1e6,
                })
                .unwrap();
            run(&mut world, 4000);
            let travelled = world.link_poses()[1].translation[2];
            let wanted = 4.0 * 4.0 / TAU * 0.2;
            assert!(
                (travelled - wanted).abs() < 1e-3 * wanted,
                "{solver:?}: {travelled} {wanted}"
            );
            for gap in world.gaps() {
                assert!(
                    gap.position < 1e-6 && gap.angle < 1e-6,
                    "{closing} {solver:?}: {gap:?}"
                );
            }
        }
    }
}

#[test]
fn a_universal_joint_turns_its_shafts_by_the_known_relation() {
    // The shafts enclose 0.6 rad; at zero the first fork stands in their plane: tan(out) = tan(in) / cos(0.6).
    let bend = 0.6f64;
    let (s, c) = bend.sin_cos();
    let placed = Placed::new(parse(&format!(
        r#"<robot name="cardan"><link name="ground"/><link name="first"/><link name="second"/>
        <joint name="in" type="continuous"><parent link="ground"/><child link="first"/><axis xyz="1 0 0"/></joint>
        <joint name="cross" type="universal"><parent link="first"/><child link="second"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/><axis2 xyz="0 0 1"/></joint>
        <loop name="out" type="continuous"><predecessor link="ground"><origin xyz="{} {} 0"/></predecessor>
        <successor link="second"><origin xyz="{c} {s} 0"/></successor><axis xyz="{c} {s} 0"/></loop></robot>"#,
        1.0 + c,
        s
    )));
    let assembly = support::analysis(&placed.mechanism);
    let states = assembly.assembly.states.clone();
    for solver in SOLVERS {
        let mut world = placed
            .try_world(&states, &options(solver, Effects::default(), 1e-3, 16))
            .unwrap();
        world
            .drive(Drive {
                joint: 0,
                freedom: 0,
                velocity: 2.0,
                largest_force: 1e6,
            })
            .unwrap();
        let mut state = states.clone();
        for step in 0..3000 {
            world.step().unwrap();
            state = world.states(&state);
            if step % 100 == 0 {
                let (input, output) = (state[0].values[0], state[2].values[0]);
                let wanted = input.sin().atan2(input.cos() * c);
                let off = ((output - wanted + PI).rem_euclid(TAU) - PI).abs();
                assert!(off < 2e-4, "{solver:?}: {input} {output} {wanted}");
            }
        }
    }
}

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
fn a_start_pose_away_from_home_is_baked_in() {
    for kind in JointKind::ALL {
        let placed = single(kind);
        let values: Vec<f64> = (0..kind.freedom()).map(|i| 0.4 - 0.23 * i as f64).collect();
        let start = vec![placed.geometry.displacements[0].at(&values)];
        for solver in SOLVERS {
            let options = options(solver, Effects::default(), 1e-3, 8);
            let mut world = placed.try_world(&start, &options).unwrap();
            for _ in 0..2 {
                let gap = world.gaps()[0];
                assert!(gap.position < 1e-12 && gap.angle < 1e-12, "{kind} {gap:?}");
                let now = world.states(&start);
                let here = placed.geometry.displacements[0].displacement(&now[0]);
                let there = placed.geometry.displacements[0].displacement(&start[0]);
                let off = there.inverse().compose(&here);
                let turn = off.rotation_vector();
                assert!(off.translation.iter().chain(&turn).all(|x| x.abs() < 1e-12));
                run(&mut world, 5);
            }
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
fn loops_of_the_reference_mechanisms_stay_closed() {
    let zoo = support::zoo();
    let wrong: Vec<String> = support::in_parallel(&zoo, |(name, mechanism)| {
        let analysis = support::analysis(mechanism);
        if !analysis.assembly.closed {
            return None;
        }
        let placed = Placed::new(mechanism.clone());
        let length = placed.geometry.size.max(1e-3);
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

/// Resident memory in pages, where the system tells.
fn resident() -> Option<usize> {
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    text.split_whitespace().nth(1)?.parse().ok()
}

#[test]
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

fn own(name: &str) -> Placed {
    let path = support::folder("mechanisms").join(format!("{name}.urdf"));
    Placed::new(kutzbach::format::read_file(path, &[]).unwrap().mechanism)
}

/// Drives what the scene drives.
fn driven(placed: &Placed, options: &WorldOptions) -> World {
    let mut world = placed.world(options);
    for drive in placed
        .mechanism
        .scene()
        .iter()
        .flat_map(|scene| &scene.drives)
    {
        world
            .drive(Drive {
                joint: drive.joint.0,
                freedom: 0,
                velocity: drive.velocity.value(),
                largest_force: drive.torque.as_ref().map_or(f64::INFINITY, |t| t.value()),
            })
            .unwrap();
    }
    world
}

#[test]
fn a_four_bar_lifts_a_box() {
    let placed = own("four_bar_lifting_box");
    let scene = Effects::of_scene(&placed.mechanism);
    assert!(scene.contact && scene.gravity.is_some() && !scene.limits);
    let (table, crate_) = (2, 4);
    for solver in SOLVERS {
        let heights = |effects: Effects| {
            let mut world = driven(&placed, &options(solver, effects, 1.0 / 480.0, 8));
            let before = world.link_poses()[crate_].translation[2];
            run(&mut world, 960);
            let poses = world.link_poses();
            let gap = world.gaps().iter().fold(0.0f64, |m, g| m.max(g.position));
            let above = poses[crate_].translation[2] - poses[table].translation[2];
            let rise = poses[crate_].translation[2] - before;
            (rise, above, world.contacts(), gap)
        };
        // The cranks turn by 0.6 rad; the pins rise by half a metre times the difference of the sines.
        let from = (-0.8f64).asin();
        let wanted = 0.5 * ((from + 0.6).sin() + 0.8);
        let (rise, above, contacts, gap) = heights(scene);
        // Impulses pass the load on to the drive slowly; it falls behind by a few percent.
        let bound = if solver == Solver::Impulse {
            0.03
        } else {
            0.005
        };
        assert!((rise - wanted).abs() < bound, "{solver:?}: {rise} {wanted}");
        assert!((above - 0.2).abs() < 0.01, "{solver:?}: {above}");
        assert!(contacts > 0 && gap < 1e-4, "{solver:?}: {contacts} {gap}");
        // Without contact the box falls, without gravity and contact it stays where it is.
        let (rise, _, contacts, gap) = heights(Effects {
            contact: false,
            ..scene
        });
        assert!((rise + 0.5 * 9.81 * 4.0).abs() < 0.1, "{solver:?}: {rise}");
        assert!(contacts == 0 && gap < 1e-4);
        let (rise, _, _, gap) = heights(Effects::default());
        assert!(rise.abs() < 1e-9 && gap < 1e-4);
    }
}

#[test]
fn a_slider_hits_its_stop() {
    let placed = own("slider_hitting_stop");
    let scene = Effects::of_scene(&placed.mechanism);
    for solver in SOLVERS {
        let end = |effects: Effects| {
            let mut world = driven(&placed, &options(solver, effects, 1e-3, 4));
            let mut energy = world.energy().total();
            let mut least = true;
            for _ in 0..1500 {
                world.step().unwrap();
                let now = world.energy().total();
                least &= now < energy + 1e-3;
                energy = now;
            }
            let state = world.states(&placed.geometry.states);
            (state[0].values[0], world.limit_violations()[0].1, least)
        };
        let (stopped, violation, falling) = end(scene);
        assert!(
            (stopped - 0.5).abs() < 1e-4 && violation < 1e-4,
            "{solver:?}: {stopped}"
        );
        assert!(falling, "a stop, friction and damping add no energy");
        let (passed, violation, _) = end(Effects {
            limits: false,
            ..scene
        });
        assert!(passed > 1.0 && violation > 0.5, "{solver:?}: {passed}");
        // Nothing resists: 0.8 g down the rail.
        let (free, _, _) = end(Effects {
            limits: false,
            friction: false,
            damping: false,
            ..scene
        });
        let wanted = 0.5 * 0.8 * 9.81 * 1.5 * 1.5;
        assert!((free - wanted).abs() < 0.02, "{solver:?}: {free} {wanted}");
        assert!(passed < free - 1.0);
        let (still, _, _) = end(Effects {
            gravity: None,
            ..scene
        });
        assert!(still.abs() < 1e-12);
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
    assert!(belt.iter().any(|(terms, _)| terms.len() == 3));
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
fn what_the_engine_cannot_hold_is_said() {
    // A coupling with a joint that closes a loop: three hinges on one axis between two links.
    let placed = Placed::new(parse(
        r#"<robot name="loops"><link name="ground"/><link name="a"/>
        <joint name="one" type="continuous"><parent link="ground"/><child link="a"/><axis xyz="0 0 1"/></joint>
        <loop name="two" type="revolute"><predecessor link="ground"/><successor link="a"/><axis xyz="0 0 1"/></loop>
        <joint name="three" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><mimic joint="two" multiplier="1" offset="0"/></joint>
        <link name="b"/></robot>"#,
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

#[test]
fn what_each_effect_costs_is_measured() {
    let placed = own("four_bar_lifting_box");
    let options = options(
        Solver::Multibody,
        Effects::of_scene(&placed.mechanism),
        1e-3,
        2,
    );
    let drive = Drive {
        joint: 0,
        freedom: 0,
        velocity: 0.5,
        largest_force: 200.0,
    };
    let (mechanism, geometry) = (&placed.mechanism, &placed.geometry);
    let table = kutzbach::simulate::cost_table(
        mechanism,
        geometry,
        &geometry.states,
        &options,
        &[drive],
        50,
    )
    .unwrap();
    let names: Vec<_> = table.iter().map(|row| row.effects).collect();
    assert_eq!(
        names,
        [
            "none", "gravity", "contact", "limits", "friction", "damping", "scene"
        ]
    );
    for row in &table {
        assert_eq!(row.steps, 50);
        assert!(row.step_time > 0.0 && row.steps_per_second > 0.0);
        let contact = matches!(row.effects, "contact" | "scene");
        assert_eq!(row.pieces.colliders > 0, contact, "{}", row.effects);
    }
}
