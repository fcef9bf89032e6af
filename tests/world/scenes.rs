//! The scenes of `mechanisms/`, whole and with each effect left out.

use super::*;

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
