//! The simulated world against what is known of joints, energy, limits, contact and coupling.

#[path = "world/closed_forms.rs"]
mod closed_forms;
#[path = "world/effects.rs"]
mod effects;
#[path = "world/guards.rs"]
mod guards;
#[path = "world/joints.rs"]
mod joints;
#[path = "world/loops.rs"]
mod loops;
#[path = "world/scenes.rs"]
mod scenes;
use crate::support;

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
