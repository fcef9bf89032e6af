//! Scenes moved by Runge-Kutta steps, against closed forms, independent integrations and the physics engine.

use kutzbach::closure::{Arithmetic, Geometry, JointState};
use kutzbach::format::read;
use kutzbach::mechanism::Mechanism;
use kutzbach::simulate::verification::{Moment, Observer, Passage};
use kutzbach::simulate::{
    Effects, Integrator, RUNGE_KUTTA_STEP, Refinement, SERVING, SceneOptions, SceneRun, Trajectory,
    World, WorldOptions, run_scene, run_scene_estimated, scene_drives,
};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;
use std::ops::ControlFlow;

/// The joint variables, and where the links are, at the last moment; the joint variables at all of them.
#[derive(Default)]
struct Last(Vec<f64>, Vec<[f64; 3]>, Vec<Vec<f64>>);

impl Observer for Last {
    fn begin(&mut self, _: &Passage) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        let states = moment.states.iter();
        self.0 = states.flat_map(|state| state.values.clone()).collect();
        self.1 = moment
            .simulated
            .iter()
            .map(|pose| pose.translation)
            .collect();
        self.2.push(self.0.clone());
        ControlFlow::Continue(())
    }
}

/// A scene of a text: elements of a robot.
fn robot(elements: &str) -> Mechanism {
    let text = format!("<robot name=\"scene\"><link name=\"g\"/>{elements}</robot>");
    read(&text, "scene.urdf", &[]).unwrap().mechanism
}

/// A link of a mass (kg) about a point (m) with one moment for all axes (kg m²).
fn link(name: &str, mass: f64, [x, y, z]: [f64; 3], moment: f64) -> String {
    format!(
        "<link name=\"{name}\"><inertial><origin xyz=\"{x} {y} {z}\"/><mass value=\"{mass}\"/>\
         <inertia ixx=\"{moment}\" iyy=\"{moment}\" izz=\"{moment}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>"
    )
}

/// A joint between two links at a place in the first, with more elements.
fn joint(kind: &str, [parent, child]: [&str; 2], at: [f64; 3], axis: &str, more: &str) -> String {
    let [x, y, z] = at;
    format!(
        "<joint name=\"{child}_joint\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <origin xyz=\"{x} {y} {z}\"/><axis xyz=\"{axis}\"/>{more}</joint>"
    )
}

fn options(mechanism: &Mechanism, duration: f64, steps: u32) -> SceneOptions {
    SceneOptions {
        world: WorldOptions {
            effects: Effects::of_scene(mechanism),
            ..WorldOptions::default()
        },
        drives: scene_drives(mechanism),
        duration,
        integrator: None,
        runge_kutta_step: duration / f64::from(steps),
    }
}

/// Runs a scene from the mechanism's configuration `start`, or from home, in so many Runge-Kutta steps.
fn run(mechanism: &Mechanism, duration: f64, steps: u32) -> (SceneRun, Last) {
    let options = options(mechanism, duration, steps);
    let (geometry, start) = at_start(mechanism);
    let mut last = Last::default();
    let run = run_scene(mechanism, &geometry, &start, &options, &mut last).unwrap();
    assert_eq!(run.integrator, Integrator::RungeKutta, "{run:?}");
    assert!(run.closure_error < 1e-10, "{}", run.closure_error);
    (run, last)
}

fn at_start(mechanism: &Mechanism) -> (Geometry<f64>, Vec<JointState<f64>>) {
    let start = mechanism.configuration("start");
    let geometry = Geometry::new(mechanism, start, &Arithmetic::double());
    let states = geometry.states.clone();
    (geometry, states)
}

const GRAVITY: &str = "<scene><gravity xyz=\"0 -9.81 0\"/></scene>";

/// Bars of one metre and one kilogram that hang on one another, each turned by an angle against the one before; gravity against y.
fn chain(angles: &[f64]) -> Mechanism {
    let mut text = String::new();
    let mut configuration = String::new();
    for (index, angle) in angles.iter().enumerate() {
        let (own, before) = (format!("l{index}"), format!("l{}", index.wrapping_sub(1)));
        let (parent, at) = match index {
            0 => ("g", 0.0),
            _ => (before.as_str(), -1.0),
        };
        text += &link(&own, 1.0, [0.0, -0.5, 0.0], 1.0 / 12.0);
        text += &joint("continuous", [parent, &own], [0.0, at, 0.0], "0 0 1", "");
        let _ = write!(
            configuration,
            "<position joint=\"{own}_joint\" value=\"{angle}\"/>"
        );
    }
    robot(&format!(
        "{text}{GRAVITY}<configuration name=\"start\">{configuration}</configuration>"
    ))
}

/// A rod let go when level hangs after K(1/√2) / √(m g l / I), by the complete elliptic integral of the first kind.
const QUARTER: f64 = 1.854_074_677_301_371_9;

#[test]
fn a_pendulum_is_as_its_elliptic_integral_says_and_the_error_falls_with_the_fifth_power() {
    let mechanism = chain(&[FRAC_PI_2]);
    let duration = QUARTER / (9.81f64 * 0.5 * 3.0).sqrt();
    let errors = [4, 8, 16, 32].map(|steps| run(&mechanism, duration, steps).1.0[0].abs());
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 4.7, "{errors:?}");
    }
    assert!(errors[3] < 2e-8, "{errors:?}");
}

/// A hub with a weight on each of many spokes, as one pendulum of one moment about its hinge.
#[test]
fn a_hub_of_many_spokes_swings_as_one_body() {
    let mut text = link("hub", 2.0, [0.0, -0.5, 0.0], 0.1);
    text += &joint("continuous", ["g", "hub"], [0.0; 3], "0 0 1", "");
    let (mut moment, mut pull) = (0.1 + 2.0 * 0.25, 2.0 * 0.5);
    for spoke in 0..40 {
        let name = format!("s{spoke}");
        let at = [
            0.01 * f64::from(spoke % 7 - 3),
            -0.02 * f64::from(spoke),
            0.0,
        ];
        // Balanced across the way down, so that the centre of all hangs below the hinge.
        let across = if spoke % 2 == 0 { 0.2 } else { -0.2 };
        text += &link(&name, 0.1, [across - at[0], 0.0, 0.0], 0.01);
        text += &joint("fixed", ["hub", &name], at, "0 0 1", "");
        moment += 0.01 + 0.1 * (across * across + at[1] * at[1]);
        pull -= 0.1 * at[1];
    }
    let start = format!("<position joint=\"hub_joint\" value=\"{FRAC_PI_2}\"/>");
    let mechanism = robot(&format!(
        "{text}{GRAVITY}<configuration name=\"start\">{start}</configuration>"
    ));
    let duration = QUARTER / (9.81 * pull / moment).sqrt();
    let (run, last) = run(&mechanism, duration, 32);
    assert!(last.0[0].abs() < 2e-8, "{:?}", last.0);
    assert!(run.energy_error().unwrap() < 1e-8);
    assert_eq!(run.pieces.bodies, 41);
}

/// Steps of the classical method of order four (Kutta 1901), for y' = f(y).
fn integrated<const N: usize>(
    start: [f64; N],
    duration: f64,
    steps: u32,
    f: impl Fn(&[f64; N]) -> [f64; N],
) -> [f64; N] {
    let h = duration / f64::from(steps);
    let plus = |a: &[f64; N], b: &[f64; N], s: f64| -> [f64; N] {
        std::array::from_fn(|i| a[i] + s * b[i])
    };
    (0..steps).fold(start, |y, _| {
        let a = f(&y);
        let b = f(&plus(&y, &a, 0.5 * h));
        let c = f(&plus(&y, &b, 0.5 * h));
        let d = f(&plus(&y, &c, h));
        std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
    })
}

#[test]
fn a_double_pendulum_is_as_lagrange_s_equations_say() {
    let start = [1.5, 0.75];
    // Absolute angles from hanging: M(a − b) (a'', b'') = forces; bars of mass 1, length 1, moment 1/12.
    let equations = |y: &[f64; 4]| {
        let [a, b, u, v] = *y;
        let (sine, cosine) = (a - b).sin_cos();
        let (m, n, k) = (1.0 / 3.0 + 1.0, 1.0 / 3.0, 0.5 * cosine);
        let f = -0.5 * sine * v * v - 9.81 * 1.5 * a.sin();
        let g = 0.5 * sine * u * u - 9.81 * 0.5 * b.sin();
        let determinant = m * n - k * k;
        [
            u,
            v,
            (n * f - k * g) / determinant,
            (m * g - k * f) / determinant,
        ]
    };
    let wanted = integrated(
        [start[0], start[0] + start[1], 0.0, 0.0],
        1.0,
        20_000,
        equations,
    );
    let (run, last) = run(&chain(&start), 1.0, 240);
    let found = [last.0[0], last.0[0] + last.0[1]];
    for (found, wanted) in found.iter().zip(&wanted[..2]) {
        assert!((found - wanted).abs() < 1e-8, "{found} {wanted}");
    }
    assert!(run.energy_error().unwrap() < 1e-9);
}

/// A four-bar that swings fast past poses which steps of 2/15 s take for singular ones.
#[test]
fn a_step_that_is_too_long_does_not_call_for_the_engine() {
    let text = format!(
        "{}{}{}{}{}{}<loop name=\"d\" type=\"revolute\"><predecessor link=\"b\"><origin xyz=\"2 1 0\"/></predecessor>\
         <successor link=\"c\"><origin xyz=\"0 1.5 0\"/></successor><axis xyz=\"0 0 1\"/></loop>{GRAVITY}",
        link("a", 1.0, [0.5, 0.0, 0.0], 0.1),
        link("b", 1.0, [0.5, 0.5, 0.0], 0.1),
        link("c", 1.0, [0.0, 0.5, 0.0], 0.1),
        joint("continuous", ["g", "a"], [0.0; 3], "0 0 1", ""),
        joint("continuous", ["a", "b"], [1.0, 0.0, 0.0], "0 0 1", ""),
        joint("continuous", ["g", "c"], [3.0, -0.5, 0.0], "0 0 1", ""),
    );
    let mechanism = robot(&text);
    let (geometry, start) = at_start(&mechanism);
    let options = options(&mechanism, 2.0, 15);
    let refinement = Refinement {
        wanted: Some(1e-3),
        work: 20.0,
    };
    let how = (refinement, &(|| false) as &dyn Fn() -> bool);
    let (run, trajectory) = run_scene_estimated(
        &mechanism,
        &geometry,
        &start,
        &options,
        how,
        &mut Last::default(),
    )
    .unwrap();
    assert_eq!(run.integrator, Integrator::RungeKutta, "{run:?}");
    assert_eq!(trajectory.reached, Some(true), "{trajectory:?}");
}

#[test]
fn what_lies_within_a_long_step_is_as_close_as_its_ends_and_closed() {
    let pendulum = chain(&[0.6, 0.3]);
    let [coarse, half, fine] = [15, 30, 960].map(|steps| run(&pendulum, 2.0, steps).1.2);
    let apart = |rough: &[Vec<f64>]| {
        assert_eq!((rough.len(), fine.len()), (120, 120));
        let pairs = rough.iter().flatten().zip(fine.iter().flatten());
        pairs.fold(0.0f64, |most, (a, b)| most.max((a - b).abs()))
    };
    let (coarse, half) = (apart(&coarse), apart(&half));
    assert!(coarse < 0.02 && half < coarse / 16.0, "{coarse:e} {half:e}");
}

/// A mechanism of one freedom: I(q) q'' = −I'(q) q'²/2 − V'(q).
fn one_freedom(
    start: f64,
    duration: f64,
    inertia: impl Fn(f64) -> f64,
    potential: impl Fn(f64) -> f64,
) -> f64 {
    let h = 1e-4;
    let slope = |f: &dyn Fn(f64) -> f64, q: f64| {
        // Of fourth order: some 1e-13 is left.
        (8.0 * (f(q + h) - f(q - h)) - (f(q + 2.0 * h) - f(q - 2.0 * h))) / (12.0 * h)
    };
    let equation = |y: &[f64; 2]| {
        let force = -0.5 * slope(&inertia, y[0]) * y[1] * y[1] - slope(&potential, y[0]);
        [y[1], force / inertia(y[0])]
    };
    integrated([start, 0.0], duration, 4000, equation)[0]
}

#[test]
fn a_slider_crank_falls_as_its_equation_of_one_freedom_says() {
    let (crank, rod) = (0.5, 1.3);
    let lean = |q: f64| (crank * q.sin() / rod).asin();
    let text = link("crank", 1.0, [0.25, 0.0, 0.0], 0.03)
        + &link("rod", 2.0, [0.65, 0.0, 0.0], 0.2)
        + &link("slider", 0.7, [0.0; 3], 0.01)
        + &joint("continuous", ["g", "crank"], [0.0; 3], "0 0 1", "")
        + &joint(
            "continuous",
            ["crank", "rod"],
            [crank, 0.0, 0.0],
            "0 0 1",
            "",
        )
        + &joint(
            "continuous",
            ["rod", "slider"],
            [rod, 0.0, 0.0],
            "0 0 1",
            "",
        )
        + "<loop name=\"guide\" type=\"prismatic\"><predecessor link=\"g\"/><successor link=\"slider\"/><axis xyz=\"1 0 0\"/></loop>";
    let start = 1.2;
    let configuration = format!(
        "<configuration name=\"start\"><position joint=\"crank_joint\" value=\"{start}\"/><position joint=\"rod_joint\" value=\"{}\"/>\
         <position joint=\"slider_joint\" value=\"{}\"/></configuration>",
        -start - lean(start),
        lean(start)
    );
    let mechanism = robot(&(text + GRAVITY + &configuration));
    // By the rates of the crank: the rod turns back by φ' = crank cos q / (rod cos φ).
    let inertia = |q: f64| {
        let phi = lean(q);
        let turn = crank * q.cos() / (rod * phi.cos());
        let middle = [
            -crank * q.sin() - 0.65 * phi.sin() * turn,
            crank * q.cos() - 0.65 * phi.cos() * turn,
        ];
        let slide = -crank * q.sin() - rod * phi.sin() * turn;
        (0.03 + 0.0625)
            + 2.0 * (middle[0] * middle[0] + middle[1] * middle[1])
            + 0.2 * turn * turn
            + 0.7 * slide * slide
    };
    let potential = |q: f64| 9.81 * (0.25 * q.sin() + 2.0 * 0.5 * crank * q.sin());
    let wanted = one_freedom(start, 1.0, inertia, potential);
    let errors = [30, 60, 120].map(|steps| (run(&mechanism, 1.0, steps).1.0[0] - wanted).abs());
    assert!(
        errors[2] < 1e-7 && errors[0] > 16.0 * errors[1],
        "{errors:?}"
    );
}

#[test]
fn a_nut_falls_on_its_screw_and_a_gear_turns_its_flywheel() {
    // A mass on a screw of 0.3 m per turn: z'' = g m / (m + I/p²).
    let screw = robot(
        &(link("nut", 2.0, [0.0; 3], 0.05)
            + &joint(
                "screw",
                ["g", "nut"],
                [0.0; 3],
                "0 1 0",
                "<screw lead=\"0.3\"/>",
            )
            + GRAVITY),
    );
    let pitch: f64 = 0.3 / (2.0 * PI);
    let fallen = 0.5 * 9.81 * 2.0 / (2.0 + 0.05 / (pitch * pitch));
    // Four steps turn it by half a turn and more each: they are halved.
    for (steps, off) in [(4, 1e-4), (240, 1e-12)] {
        let (_, last) = run(&screw, 1.0, steps);
        let found = last.0[0] * pitch + fallen;
        assert!(found.abs() < off, "{steps}: {found}");
    }

    // The level rod again, with a wheel that turns three times as far the other way.
    let geared = robot(
        &(link("rod", 1.0, [0.0, -0.5, 0.0], 1.0 / 12.0)
            + &link("wheel", 1.0, [0.0; 3], 0.1)
            + &joint("continuous", ["g", "rod"], [0.0; 3], "0 0 1", "")
            + &joint(
                "continuous",
                ["g", "wheel"],
                [1.0, 0.0, 0.0],
                "0 0 1",
                "<mimic joint=\"rod_joint\" multiplier=\"-3\"/>",
            )
            + GRAVITY
            + &format!(
                "<configuration name=\"start\"><position joint=\"rod_joint\" value=\"{FRAC_PI_2}\"/>\
                 <position joint=\"wheel_joint\" value=\"{}\"/></configuration>",
                -3.0 * FRAC_PI_2
            )),
    );
    let duration = QUARTER / (9.81f64 * 0.5 / (1.0 / 3.0 + 9.0 * 0.1)).sqrt();
    let (_, last) = run(&geared, duration, 60);
    assert!(
        last.0[0].abs() < 1e-8 && last.0[1].abs() < 3e-8,
        "{:?}",
        last.0
    );
}

#[test]
fn damping_takes_what_it_should() {
    // Falling on a slide: v = (m g/d)(1 − exp(−d t/m)).
    let text = link("block", 2.0, [0.1, 0.0, 0.0], 0.05)
        + &joint(
            "prismatic",
            ["g", "block"],
            [0.0; 3],
            "0 1 0",
            "<limit lower=\"-100\" upper=\"1\" effort=\"0\" velocity=\"0\"/><dynamics damping=\"3\"/>",
        )
        + "<scene><gravity xyz=\"0 -9.81 0\"/><damping/><limits/></scene>";
    let (run, last) = run(&robot(&text), 1.0, 60);
    let (end, ratio) = (2.0 * 9.81 / 3.0, 1.5f64);
    let fallen = end * (1.0 - (1.0 - (-ratio).exp()) / ratio);
    assert!((last.0[0] + fallen).abs() < 1e-9, "{} {fallen}", last.0[0]);
    assert!(run.energy_error().is_none() && run.engine_because.is_empty());
}

#[test]
fn what_floats_keeps_its_momentum_while_it_is_driven() {
    // The hinge is in the middle of the second body, off that of the first, so that the first turns by −I₂/(I₁ + I₂ + μ d²).
    let text = link("one", 3.0, [0.0; 3], 0.4)
        + &link("two", 2.0, [0.0; 3], 0.3)
        + "<joint name=\"free\" type=\"floating\"><parent link=\"g\"/><child link=\"one\"/></joint>"
        + &joint("continuous", ["one", "two"], [0.6, 0.0, 0.0], "0 0 1", "")
        + "<scene><gravity xyz=\"0 -9.81 0\"/><drive joint=\"two_joint\" velocity=\"2\"/></scene>";
    let (_, last) = run(&robot(&text), 1.0, 60);
    let turned = -2.0 * 0.3 / (0.4 + 0.3 + 3.0 * 2.0 / 5.0 * 0.36);
    let [one, two] = [last.1[1], last.1[2]];
    let apart: [f64; 2] = std::array::from_fn(|i| two[i] - one[i]);
    assert!(
        (apart[1].atan2(apart[0]) - turned).abs() < 1e-8,
        "{apart:?} {turned}"
    );
    assert!((last.0[0] - 2.0).abs() < 1e-11);
    let middle: [f64; 2] = std::array::from_fn(|i| (3.0 * one[i] + 2.0 * two[i]) / 5.0);
    let wanted = [0.24, -0.5 * 9.81];
    assert!(
        (0..2).all(|i| (middle[i] - wanted[i]).abs() < 1e-10),
        "{middle:?}"
    );
}

fn estimated(
    mechanism: &Mechanism,
    duration: f64,
    integrator: Option<Integrator>,
    wanted: Option<f64>,
) -> (SceneRun, Trajectory, Last) {
    let (geometry, start) = at_start(mechanism);
    let options = SceneOptions {
        integrator,
        runge_kutta_step: RUNGE_KUTTA_STEP,
        ..options(mechanism, duration, 1)
    };
    let refinement = Refinement { wanted, work: 20.0 };
    let mut last = Last::default();
    let how = (refinement, &(|| false) as &dyn Fn() -> bool);
    let (run, trajectory) =
        run_scene_estimated(mechanism, &geometry, &start, &options, how, &mut last).unwrap();
    (run, trajectory, last)
}

fn file(name: &str) -> Mechanism {
    let path = format!("{}/mechanisms/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
    let mut mechanism = kutzbach::format::read_file(path, &[]).unwrap().mechanism;
    let text = kutzbach::format::write(&mechanism);
    if mechanism.scene().is_none() {
        let text = text.replace("</robot>", &format!("{GRAVITY}</robot>"));
        mechanism = read(&text, name, &[]).unwrap().mechanism;
    }
    mechanism
}

/// How far links are from where they are in another run at most (characteristic lengths).
fn apart(mechanism: &Mechanism, one: &Last, other: &Last) -> f64 {
    let (geometry, start) = at_start(mechanism);
    let world = World::new(mechanism, &geometry, &start, &WorldOptions::default()).unwrap();
    let pairs = one.1.iter().flatten().zip(other.1.iter().flatten());
    let off = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    off / world.scale().0
}

#[test]
fn the_error_wanted_is_the_error_of_the_motion_and_of_its_energy() {
    for (name, mechanism) in [
        ("chain", chain(&[1.5, 0.75])),
        ("bennett", file("bennett")),
        ("bricard_orthogonal", file("bricard_orthogonal")),
        ("peaucellier", file("peaucellier")),
    ] {
        let (_, _, fine) = estimated(&mechanism, 1.0, None, Some(1e-11));
        let mut before = f64::INFINITY;
        for wanted in [1e-3, 1e-4, 1e-6] {
            let (run, trajectory, last) = estimated(&mechanism, 1.0, None, Some(wanted));
            assert_eq!(run.integrator, Integrator::RungeKutta, "{name}");
            assert_eq!(trajectory.reached, Some(true), "{name} {trajectory:?}");
            let off = apart(&mechanism, &last, &fine);
            assert!(off <= 2.0 * wanted, "{name} {wanted}: {off}");
            assert!(run.energy_error().unwrap() <= 2.0 * wanted, "{name}");
            assert!(off <= before, "{name} {wanted}: {off} after {before}");
            before = off.max(1e-9);
        }
    }
}

#[test]
fn the_engine_finds_the_same_motion_as_closely_as_it_says() {
    for name in ["bennett", "sarrus", "rssr", "peaucellier"] {
        let mechanism = file(name);
        let (smooth, _, ours) = estimated(&mechanism, 0.25, None, None);
        assert_eq!(smooth.integrator, Integrator::RungeKutta, "{name}");
        let engine = Some(Integrator::Engine);
        let (run, trajectory, theirs) = estimated(&mechanism, 0.25, engine, Some(1e-3));
        assert_eq!(run.integrator, Integrator::Engine);
        let told = trajectory.error().unwrap().largest().max(run.closure_error);
        let off = apart(&mechanism, &ours, &theirs);
        assert!(told < 0.02 && off < 3.0 * told, "{name}: {off} {told}");
    }
}

#[test]
fn what_is_not_smooth_is_the_engine_s_with_the_reason() {
    let slide = |limits: &str, scene: &str| {
        robot(
            &(link("block", 1.0, [0.0; 3], 0.1)
                + &joint("prismatic", ["g", "block"], [0.0; 3], "0 1 0", limits)
                + &format!("<scene><gravity xyz=\"0 -9.81 0\"/>{scene}</scene>")),
        )
    };
    let near = "<limit lower=\"-0.5\" upper=\"0.5\" effort=\"0\" velocity=\"0\"/>";
    let far = "<limit lower=\"-9\" upper=\"9\" effort=\"0\" velocity=\"0\"/>";
    let dry = "<dynamics friction=\"2\"/>";
    for (limits, scene, because) in [
        (near, "<limits/>", Some("limits that are reached")),
        (near, "", None),
        (far, "<limits/>", None),
        (&format!("{far}{dry}"), "<friction/>", Some("dry friction")),
        (&format!("{far}{dry}"), "", None),
        (far, "<friction/><damping/><contact/>", None),
        (
            far,
            "<drive joint=\"block_joint\" velocity=\"1\" torque=\"3\"/>",
            Some("a drive with a largest force"),
        ),
        (far, "<drive joint=\"block_joint\" velocity=\"1\"/>", None),
    ] {
        let (run, _, _) = estimated(&slide(limits, scene), 0.5, None, None);
        assert_eq!(
            run.engine_because,
            Vec::from_iter(because),
            "{limits} {scene}"
        );
        let by_engine = run.integrator == Integrator::Engine;
        assert_eq!(by_engine, because.is_some());
        assert_eq!(by_engine, run.solver.is_some());
    }
}

#[test]
fn an_integrator_that_cannot_serve_is_refused_where_it_is_asked_for() {
    let text = link("block", 1.0, [0.0; 3], 0.1)
        + &joint(
            "continuous",
            ["g", "block"],
            [0.0; 3],
            "0 0 1",
            "<dynamics friction=\"1\"/>",
        )
        + "<scene><friction/></scene>";
    let mechanism = robot(&text);
    let (geometry, start) = at_start(&mechanism);
    let options = SceneOptions {
        integrator: Some(Integrator::RungeKutta),
        ..options(&mechanism, 0.1, 6)
    };
    let refused = run_scene(
        &mechanism,
        &geometry,
        &start,
        &options,
        &mut Last::default(),
    );
    assert!(refused.unwrap_err().to_string().contains("dry friction"));
}

#[test]
fn what_is_let_go_where_its_motion_is_not_settled_is_no_matter_of_its_equations() {
    // Two branches meet at the pose drawn; a shaky frame moves by its rounding only.
    for name in [
        "four_bar_two_circles",
        "four_dyads_equal_bars",
        "shaky_triangle",
    ] {
        let (run, trajectory, _) = estimated(&file(name), 0.25, None, None);
        assert_eq!(run.integrator, Integrator::Engine, "{name}");
        assert!(run.engine_because[0].contains("independent constraints"));
        // Runs that agree may all have gone another way than those in shorter steps: nothing is claimed.
        assert_eq!(trajectory.error(), None, "{name}");
    }
    // Whoever chose the engine.
    let (engine, wanted) = (Some(Integrator::Engine), Some(1e-3));
    let (_, trajectory, _) = estimated(&file("four_bar_two_circles"), 0.25, engine, wanted);
    assert_eq!(trajectory.reached, Some(false));
    let why = trajectory.not_estimated.unwrap();
    assert!(why.contains("not settled"), "{why}");
}

#[test]
fn a_flat_parallelogram_is_passed_without_a_loss() {
    // It comes down through the pose in which all its bars are in line, where its constraints are dependent.
    let text = link("left", 1.0, [0.0, 0.5, 0.0], 0.1)
        + &link("right", 1.0, [0.0, 0.5, 0.0], 0.1)
        + &link("coupler", 1.0, [1.0, 0.0, 0.0], 0.3)
        + &joint("continuous", ["g", "left"], [0.0; 3], "0 0 1", "")
        + &joint("continuous", ["g", "right"], [2.0, 0.0, 0.0], "0 0 1", "")
        + &joint(
            "continuous",
            ["left", "coupler"],
            [0.0, 1.0, 0.0],
            "0 0 1",
            "",
        )
        + "<loop name=\"pin\" type=\"revolute\"><predecessor link=\"coupler\"><origin xyz=\"2 0 0\"/></predecessor>\
           <successor link=\"right\"><origin xyz=\"0 1 0\"/></successor><axis xyz=\"0 0 1\"/></loop>\
           <scene><gravity xyz=\"4 -9.81 0\"/></scene>";
    // Both bars and the coupler fall as one pendulum: I = 2 (0.1 + 0.25) + 1, of 2 · 0.5 + 1 metres times kilograms.
    let start = 0.0;
    let wanted = one_freedom(
        start,
        1.0,
        |_| 1.7,
        |q| 2.0 * (9.81 * q.cos() + 4.0 * q.sin()),
    );
    let (run, last) = run(&robot(&text), 1.0, 120);
    assert!(
        last.0[0] < -FRAC_PI_2 && (last.0[0] - wanted).abs() < 1e-5,
        "{} {wanted}",
        last.0[0]
    );
    assert!((last.0[1] - last.0[0]).abs() < 1e-9);
    assert!(
        run.energy_error().unwrap() < 1e-5,
        "{:?}",
        run.energy_error()
    );
}

#[test]
fn the_book_s_table_says_which_integrator_serves_which_effect() {
    let page = include_str!("../docs/src/simulation.md");
    for serving in SERVING {
        let by = match serving.integrator {
            Integrator::RungeKutta => "Runge-Kutta",
            Integrator::Engine => "engine",
        };
        let row = format!("| {} | {by} | {} |", serving.effect, serving.because);
        assert!(page.contains(&row), "{row}");
    }
}

/// Which constraints follow from others is decided the same along a lift of any length.
#[test]
fn a_lift_of_a_hundred_stages_falls_without_the_engine() {
    for stages in [10, 100] {
        let lift = kutzbach::families::scissor_lift(stages).unwrap();
        let mut text = kutzbach::format::write(&lift);
        for name in lift.links().iter().map(|link| &link.name) {
            let heavy = link(name, 1.0, [0.5, 0.3, 0.0], 1.0);
            text = text.replace(&format!("<link name=\"{name}\"/>"), &heavy);
        }
        assert_eq!(text.matches("<inertial>").count(), lift.links().len());
        let text = text.replace("</robot>", &format!("{GRAVITY}</robot>"));
        let heavy = read(&text, "lift.urdf", &[]).unwrap().mechanism;
        let (run, _) = run(&heavy, 0.1, 6);
        let lost = run.energy_change.abs();
        assert!(lost < 1e-6 * run.largest_kinetic_energy, "{stages}: {lost}");
    }
}

/// Slides coupled by y = x², let go at x = 1: ẋ² (1 + 4 x²) = 2 g (1 − x²), so that the time to any x is an integral.
#[test]
fn slides_coupled_by_a_parabola_take_the_time_of_their_energy() {
    let slide = |name: &str, axis: &str| {
        link(name, 1.0, [0.0; 3], 1.0) + &joint("prismatic", ["g", name], [0.0; 3], axis, "")
    };
    let mechanism = robot(&format!(
        r#"{}{}<coupling name="cam"><term joint="y_joint" coefficient="1"/><term joint="x_joint" power="2" coefficient="-1"/></coupling>
        {GRAVITY}<configuration name="start"><position joint="x_joint" value="1"/><position joint="y_joint" value="1"/></configuration>"#,
        slide("x", "1 0 0"),
        slide("y", "0 1 0"),
    ));
    let (_, Last(values, ..)) = run(&mechanism, 0.5, 64);
    let [x, y] = values[..] else {
        panic!("{values:?}")
    };
    assert!((y - x * x).abs() < 1e-12, "{x} {y}");
    assert!((0.0..0.9).contains(&x), "{x}");
    // With x = 1 − s² the root at the start goes; the midpoint rule is good to 1e-11 then.
    let slow = |x: f64| ((1.0 + 4.0 * x * x) / (2.0 * 9.81 * (1.0 + x))).sqrt();
    let count = 20_000;
    let step = (1.0 - x).sqrt() / f64::from(count);
    let times = (0..count).map(|i| {
        let s = (f64::from(i) + 0.5) * step;
        2.0 * slow(1.0 - s * s) * step
    });
    let time: f64 = times.sum();
    assert!((time - 0.5).abs() < 1e-8, "{time}");
}
