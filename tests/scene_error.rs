//! How far a simulated scene is said to be off, against closed forms and runs in much shorter steps.

use kutzbach::closure::{Arithmetic, Geometry, JointState};
use kutzbach::format::read;
use kutzbach::mechanism::Mechanism;
use kutzbach::simulate::verification::{Moment, Observer, Passage};
use kutzbach::simulate::{
    Effects, Integrator, Refinement, SceneOptions, SceneRun, Trajectory, WorldOptions,
    run_scene_estimated,
};
use std::ops::ControlFlow;

/// The joint variables at the last moment, and the time of each moment of each passage.
#[derive(Default)]
struct Last(Vec<f64>, Vec<Vec<f64>>);

impl Observer for Last {
    fn begin(&mut self, _: &Passage) -> ControlFlow<()> {
        self.1.push(Vec::new());
        ControlFlow::Continue(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        if let Some(times) = self.1.last_mut() {
            times.push(moment.time);
        }
        self.0 = moment
            .states
            .iter()
            .flat_map(|s| s.values.clone())
            .collect();
        ControlFlow::Continue(())
    }
}

/// Bars of one metre and one kilogram that hang on one another from a wall, each turned by an angle against the one before, under gravity.
fn chain(angles: &[f64]) -> Mechanism {
    let mut text = String::from("<robot name=\"chain\"><link name=\"l0\"/>");
    for (index, _) in angles.iter().enumerate() {
        let (own, at) = (index + 1, if index == 0 { 0 } else { -1 });
        text += &format!(
            "<link name=\"l{own}\"><inertial><origin xyz=\"0 0 -0.5\"/><mass value=\"1\"/>\
             <inertia ixx=\"${{1/12}}\" iyy=\"${{1/12}}\" izz=\"0.01\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\
             <joint name=\"j{own}\" type=\"continuous\"><parent link=\"l{index}\"/><child link=\"l{own}\"/>\
             <origin xyz=\"0 0 {at}\"/><axis xyz=\"0 1 0\"/></joint>"
        );
    }
    text += "<scene><gravity xyz=\"0 0 -9.81\"/></scene><configuration name=\"raised\">";
    for (index, angle) in angles.iter().enumerate() {
        text += &format!("<position joint=\"j{}\" value=\"{angle}\"/>", index + 1);
    }
    text += "</configuration></robot>";
    read(&text, "chain.urdf", &[]).unwrap().mechanism
}

fn run(
    mechanism: &Mechanism,
    (duration, time_step, substeps): (f64, f64, usize),
    (wanted, work): (Option<f64>, f64),
) -> (SceneRun, Trajectory, Vec<f64>) {
    let raised = mechanism.configuration("raised");
    let geometry = Geometry::new(mechanism, raised, &Arithmetic::double());
    let start: Vec<JointState<f64>> = geometry.states.clone();
    let options = SceneOptions {
        world: WorldOptions {
            effects: Effects::of_scene(mechanism),
            time_step,
            substeps,
            ..WorldOptions::default()
        },
        drives: Vec::new(),
        duration,
        integrator: Some(Integrator::Engine),
        runge_kutta_step: time_step,
    };
    let refinement = Refinement { wanted, work };
    let mut last = Last::default();
    let (run, trajectory) = run_scene_estimated(
        mechanism,
        &geometry,
        &start,
        &options,
        (refinement, &|| false),
        &mut last,
    )
    .unwrap();
    // The run that is told of is shown, once and to its end, and no other.
    assert_eq!(last.1.len(), 1);
    assert!((last.1[0].last().unwrap() - run.time).abs() <= 1e-12 * run.time);
    assert_eq!(run.time_step, trajectory.rows[trajectory.used].time_step);
    assert_eq!(
        trajectory.error().is_none(),
        trajectory.not_estimated.is_some()
    );
    (run, trajectory, last.0)
}

/// A quarter of the period of a rod that is let go when level: K(1/√2) / √(m g l / I), by the complete elliptic integral of the
/// first kind; then it hangs.
const QUARTER: f64 = 1.854_074_677_301_371_9;

#[test]
fn a_pendulum_hangs_after_a_quarter_of_its_period_as_closely_as_was_wanted() {
    let mechanism = chain(&[std::f64::consts::FRAC_PI_2]);
    let duration = QUARTER / (9.81f64 * 0.5 * 3.0).sqrt();
    for wanted in [1e-2, 1e-3] {
        let (run, trajectory, last) = run(
            &mechanism,
            (duration, duration / 16.0, 1),
            (Some(wanted), 10.0),
        );
        assert_eq!(trajectory.reached, Some(true), "{trajectory:?}");
        assert!(last[0].abs() <= wanted, "{wanted}: {}", last[0]);
        // Of first order: what was wanted costs ten times as much for each digit, and the first step is not enough.
        assert!(trajectory.used >= 2);
        assert!(run.conservative);
        let order = trajectory.rows.last().unwrap().order.unwrap();
        assert!((order - 1.0).abs() < 0.1, "{order}");
        let fallen = run.kinetic_energy - 9.81 * 0.5;
        assert!(fallen.abs() <= 9.81 * wanted, "{fallen}");
    }
}

#[test]
fn estimates_are_those_of_runs_in_much_shorter_steps() {
    let turns = [1.5, 0.75, -0.5];
    for links in 1..=3 {
        let mechanism = chain(&turns[..links]);
        let (_, trajectory, coarse) = run(&mechanism, (0.5, 1.0 / 240.0, 4), (None, 10.0));
        let (_, _, fine) = run(&mechanism, (0.5, 1.0 / 240.0 / 64.0, 4), (None, 10.0));
        // In a chain the links turn by the sums of the joints' angles.
        let sums = |values: &[f64]| {
            values
                .iter()
                .scan(0.0, |sum, value| {
                    *sum += value;
                    Some(*sum)
                })
                .collect::<Vec<f64>>()
        };
        let turned = sums(&coarse).into_iter().zip(sums(&fine));
        let off = turned.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let told = trajectory.error().unwrap().end;
        assert!(off > 1e-5, "{links}: {off}");
        assert!(
            (0.7..=1.5).contains(&(told / off)),
            "{links}: told {told}, is {off}"
        );
    }
}

#[test]
fn an_error_that_costs_too_much_is_told_with_its_price() {
    let mechanism = chain(&[1.5, 0.75]);
    let (_, trajectory, _) = run(&mechanism, (0.5, 1.0 / 60.0, 1), (Some(1e-10), 0.2));
    assert_eq!(trajectory.reached, Some(false));
    assert!(trajectory.needed.unwrap() > 60.0, "{trajectory:?}");
    assert_eq!(trajectory.used, trajectory.rows.len() - 1);
}

#[test]
fn where_there_is_no_estimate_a_reason_is_given() {
    let mechanism = chain(&[1.5, 0.75]);
    let (_, trajectory, _) = run(&mechanism, (0.5, 1.0 / 240.0, 4), (None, 1e-9));
    assert_eq!(trajectory.error(), None);
    assert!(trajectory.not_estimated.unwrap().contains("too long"));
}

/// Three hinges on one line, let go across it: a bar has a speed that no motion follows, and an engine finds one all the same. Neither its own
/// choice nor the wish for the engine makes runs that agree an error.
#[test]
fn no_error_is_told_where_a_shaky_mechanism_is_let_go_whichever_integrator_is_asked_for() {
    let bar = |name: &str, at: f64| {
        format!(
            "<link name=\"{name}\"><inertial><origin xyz=\"{at} 0 0\"/><mass value=\"1\"/>\
             <inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>"
        )
    };
    let pin = |name: &str, child: &str, at: f64| {
        format!(
            "<joint name=\"{name}\" type=\"revolute\"><parent link=\"base\"/><child link=\"{child}\"/>\
             <origin xyz=\"{at} 0 0\"/><axis xyz=\"0 0 1\"/></joint>"
        )
    };
    let text = format!(
        "<robot name=\"shaky\"><link name=\"base\"/>{}{}{}{}\
         <loop name=\"middle\" type=\"revolute\"><predecessor link=\"long\"><origin xyz=\"2 0 0\"/></predecessor>\
         <successor link=\"short\"><origin xyz=\"-1 0 0\"/></successor><axis xyz=\"0 0 1\"/></loop>\
         <scene><gravity xyz=\"0 -9.81 0\"/></scene></robot>",
        bar("long", 1.0),
        bar("short", -0.5),
        pin("left", "long", 0.0),
        pin("right", "short", 3.0)
    );
    let mechanism = read(&text, "shaky.urdf", &[]).unwrap().mechanism;
    for wanted in [None, Some(1e-3)] {
        let (_, trajectory, _) = run(&mechanism, (0.25, 1.0 / 240.0, 4), (wanted, 1.0));
        assert_eq!(trajectory.rows.len(), 1, "no run is made to be compared");
        assert!(trajectory.error().is_none());
        assert!(trajectory.reached != Some(true));
        let why = trajectory.not_estimated.unwrap();
        assert!(why.contains("is not settled"), "{why}");
    }
}
