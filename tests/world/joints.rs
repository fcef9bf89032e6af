//! Every kind of joint: what it allows, what it does not, how it is driven.

use super::*;

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

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
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
}
